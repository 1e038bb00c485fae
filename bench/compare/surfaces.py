#!/usr/bin/env python3
"""Runs wrap, remesh, hull or other stages on every mesh below a folder, and counts the properties of the results.

    bench/compare/surfaces.py build/release/facetmill MESHES [--faces 50000] [--jobs 2] [--stages wrap 'remesh 2%' hull]

validate judges the scene in memory, with exact predicates. Remesh and similar stages keep the faults of their input, so
each result counts beside its input. Prints a Markdown table, then the files that are refused or have faults.
"""

import argparse
import concurrent.futures
import json
import pathlib
import subprocess
import tempfile
import time

SUFFIXES = {".stl", ".obj", ".ply", ".off", ".glb", ".gltf", ".drc", ".3mf"}
CHECKS = ("closed", "edge_manifold", "vertex_manifold", "self_intersections")
LIMIT = 300  # seconds


def judged(exe, mesh, stages):
    """The checks that hold after the stages, or the reason why there are none, and the seconds."""
    with tempfile.TemporaryDirectory() as folder:
        report = pathlib.Path(folder) / "r.json"
        command = [exe, "pipe", "--report", report, "load", mesh]
        for stage in stages:
            command += ["!", *stage.split()]
        command += ["!", "validate", "--closed", "--edge_manifold", "--vertex_manifold", "--self_intersections", "0"]
        begin = time.perf_counter()
        try:
            run = subprocess.run(command, capture_output=True, text=True, timeout=LIMIT, check=False)
        except subprocess.TimeoutExpired:
            return f"more than {LIMIT} s", LIMIT
        seconds = time.perf_counter() - begin
        if run.returncode not in (0, 1):
            first = next((line for line in run.stderr.splitlines() if "error" in line), f"exit {run.returncode}")
            return first[:160], seconds
        checks = json.loads(report.read_text())["checks"]
        return {name for name in CHECKS if all(c["passed"] for c in checks if c["name"].endswith(name))}, seconds


def faces_of(exe, mesh):
    run = subprocess.run([exe, "info", "--json", mesh], capture_output=True, text=True, check=False)
    try:
        files = json.loads(run.stdout)
        one = files[0] if isinstance(files, list) else files
        return one.get("faces", one.get("summary", {}).get("faces"))
    except (ValueError, IndexError, AttributeError):
        return None


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("exe")
    parser.add_argument("meshes", type=pathlib.Path)
    parser.add_argument("--faces", type=int, default=50000)
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--stages", nargs="+", default=["wrap", "remesh 2%", "hull"])
    args = parser.parse_args()
    files = sorted(p for p in args.meshes.rglob("*") if p.suffix.lower() in SUFFIXES)
    sizes = {p: faces_of(args.exe, p) for p in files}
    files = [p for p in files if sizes[p] and sizes[p] <= args.faces]
    faults = []
    print("| stage | results | refused | closed | manifold | no self-intersection | all three | slowest, s |")
    print("|---|---|---|---|---|---|---|---|")
    for stage in [None, *args.stages]:
        with concurrent.futures.ThreadPoolExecutor(args.jobs) as pool:
            results = list(pool.map(lambda p, s=stage: judged(args.exe, p, [s] if s else []), files))
        held = [r for r, _ in results if not isinstance(r, str)]
        manifold = {"edge_manifold", "vertex_manifold"}
        print(f"| {stage or 'input'} | {len(held)} | {len(results) - len(held)} | {sum('closed' in r for r in held)} | "
              f"{sum(manifold <= r for r in held)} | {sum('self_intersections' in r for r in held)} | "
              f"{sum(set(CHECKS) <= r for r in held)} | {max(s for _, s in results):.0f} |", flush=True)
        for path, (result, seconds) in zip(files, results):
            what = result if isinstance(result, str) else ", ".join(sorted(set(CHECKS) - result))
            if what:
                faults.append(f"{stage or 'input'}: {path.relative_to(args.meshes)}: {what} ({seconds:.1f} s)")
    print()
    print("\n".join(faults))


if __name__ == "__main__":
    main()
