#!/usr/bin/env python3
"""stages.py [STAGE...]: what a second core gives each stage, and how far each is from what memory allows.

Runs each stage on a closed, slightly rough sphere of 5.2 million faces (--level 9; each level less has a quarter), with
one thread and with two, in turn. Told are the seconds of the stage alone (--timings), the fastest of several runs, the
speed-up, and the share of the work that must be serial for it: none would give 2.00. The floor is the time in which one
core copies as many bytes as the stage must read and write at least: positions and corners of the mesh before and after
it, and the files, for whose disk nobody waits (--no-sync). Wall times: they mean something only on a machine that has
nothing else to do, which the load of the machine before and after the table tells.
"""
import argparse
import json
import os
import pathlib
import tempfile
import time

from peers import ROOT, add_common_options, crumpled_sphere, output

STAGES = {
    "load": "",
    "clean": "clean",
    "clip": "clip z=50% --cap",
    "crop": "crop [[-0.5,-0.5],[0.6,-0.4],[0.5,0.6],[-0.6,0.5]] --axis z",
    "crumple": "crumple 0.1%",
    "measure": "measure",
    "optimize": "optimize",
    "orient": "orient",
    "relax": "relax 3",
    "render": "render view.png",
    "section": "section z=50%",
    "separate": "separate",
    "simplify, not measured": "simplify 10% --measure false",
    "simplify": "simplify 10%",
    "simplify, cluster": "simplify 10% --method cluster --measure false",
    "split": "split midpoint",
    "tile": "tile 50%",
    "validate": "validate --closed",
    "validate, crossings": "validate --self_intersections 0",
    "write, STL": "write out.stl",
    "write, PLY": "write out.ply",
    "write, OBJ": "write out.obj",
    "write, GLB": "write out.glb",
    "write, Draco": "write out.glb --draco",
}


def bytes_a_second():
    """Read and written by one core that copies."""
    block = memoryview(bytearray(os.urandom(1 << 20)) * 256)
    copy = memoryview(bytearray(len(block)))
    best = 0
    for _ in range(5):
        begin = time.perf_counter()
        copy[:] = block
        best = max(best, 2 * len(block) / (time.perf_counter() - begin))
    return best


def mesh_bytes(told):
    return 24 * told["vertices"] + 12 * told["faces"]


def run(mill, mesh, line, threads, folder):
    """The record of the stage and its seconds."""
    words = ["!", *line.split()] if line else []
    output([mill, "pipe", "--quiet", "--no-sync", "-j", threads, "--report", folder / "run.json", "--timings", folder / "times.json",
            "load", mesh, *words], before=lambda: os.chdir(folder))
    record = json.loads((folder / "run.json").read_text())["stages"][1 if line else 0]
    return record, json.loads((folder / "times.json").read_text())["stages"][1 if line else 0]["seconds"]


def row(mill, mesh, name, folder, repeat, bandwidth):
    line = STAGES[name]
    least = {1: float("inf"), 2: float("inf")}
    for _ in range(repeat):
        for threads in least:
            record, seconds = run(mill, mesh, line, threads, folder)
            least[threads] = min(least[threads], seconds)
    files = mesh.stat().st_size if not line else sum(f.stat().st_size for f in folder.glob("out.*"))
    for file in folder.glob("out.*"):
        file.unlink()
    touched = mesh_bytes(record["before"]) + mesh_bytes(record["after"]) + files
    if record["before"] == record["after"] and line:
        touched -= mesh_bytes(record["after"])  # what only looks at the mesh writes none
    floor = touched / bandwidth
    serial = max(0.0, 2 * least[2] / least[1] - 1)
    return (f"| {name} | {least[1]:.3f} | {least[2]:.3f} | {least[1] / least[2]:.2f} | {100 * serial:.0f} | {touched / 1e6:.0f} | "
            f"{floor:.3f} | {least[1] / floor:.1f} |")


def main():
    ask = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    ask.add_argument("stages", nargs="*", help="of: " + ", ".join(STAGES))
    ask.add_argument("--level", type=int, default=9)
    add_common_options(ask, repeat=3)
    args = ask.parse_args()
    mill = (args.build / "facetmill").resolve()
    unknown = [name for name in args.stages if name not in STAGES]
    if unknown:
        ask.error(f"no such stage: {unknown[0]}")
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        mesh = folder / "mesh.ply"
        crumpled_sphere(mill, args.level, mesh)
        bandwidth = bytes_a_second()
        print(f"load of the machine before: {os.getloadavg()[0]:.1f}; one core copies {bandwidth / 1e9:.1f} GB/s\n")
        print("| stage | 1 thread, s | 2 threads, s | speed-up | serial, % | MB | floor, s | 1 thread / floor |")
        print("|---|---|---|---|---|---|---|---|")
        for stage in args.stages or STAGES:
            try:
                print(row(mill, mesh, stage, folder, args.repeat, bandwidth), flush=True)
            except RuntimeError as error:
                print(f"| {stage} | {error} | | | | | | |", flush=True)
        print(f"\nload of the machine after: {os.getloadavg()[0]:.1f}")


if __name__ == "__main__":
    main()
