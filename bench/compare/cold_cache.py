#!/usr/bin/env python3
"""What a cache costs where it has nothing yet: runs over three meshes of a million triangles without one, and with one that is
empty. Storing may take a tenth of the time of the stages that it saves; that the scenes are known by their contents costs
besides. The rounds alternate, so that whatever else the machine does meets both; the fastest of each counts. Processor time
changes less than wall time when the machine is busy. Warm: all is there, and what writes or judges runs."""

import argparse
import os
import pathlib
import resource
import shutil
import subprocess
import tempfile
import time

from peers import ROOT, add_common_options, output

CONVERT = 'facetmill: 1\nparams: {input: path}\nstages: [load: "${input}", write: out.ply]\n'
REFINE = ('facetmill: 1\nparams: {input: path}\nstages: [load: "${input}", relax: 3, crumple: {grid: 1, amplitude: 0.05%, seed: 7}, '
          'write: out.ply]\n')
MESHES = {"sphere": "generate icosphere --subdivisions 8 --noise 0.002",
          "torus": "generate torus --segments 1000 --rings 500 --noise 0.0005",
          "scan": f"load {ROOT}/examples/data/nefertiti.ply ! split midpoint ! split midpoint"}


def timed(command, folder, cache):
    """Wall and processor seconds."""
    shutil.rmtree(folder / "out", ignore_errors=True)
    used = lambda: sum(resource.getrusage(resource.RUSAGE_CHILDREN)[:2])
    wall, cpu = time.perf_counter(), used()
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True, env={**os.environ, "FACETMILL_CACHE": cache})
    wall, cpu = time.perf_counter() - wall, used() - cpu
    if done.returncode:
        raise RuntimeError(f"{command}\n{done.stderr[-500:]}")
    return wall, cpu


def main():
    ask = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    add_common_options(ask, repeat=5)
    options = ask.parse_args()
    facetmill = str((options.build / "facetmill").resolve())
    print("| | without, s | empty cache, s | full, s | without, CPU s | empty, CPU s | full, CPU s | cost | stored, MB |\n"
          "|---|---|---|---|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        (folder / "convert.yaml").write_text(CONVERT)
        (folder / "refine.yaml").write_text(REFINE)
        for mesh, stages in MESHES.items():
            output([facetmill, "pipe", "-q", "-o", folder, *stages.split(), "!", "write", f"{mesh}.ply"])
            for pipeline in ("convert.yaml", "refine.yaml", "scan-to-web"):
                command = [facetmill, "run", pipeline, "-D", f"input={mesh}.ply", "-q", "-o", "out"]
                best = {}
                for _ in range(options.repeat):
                    shutil.rmtree(folder / "cache", ignore_errors=True)
                    for state, cache in (("without", "off"), ("empty", "cache"), ("full", "cache")):
                        took = timed(command, folder, cache)
                        best[state] = tuple(map(min, best.get(state, took), took))
                    stored = sum(p.stat().st_size for p in (folder / "cache").rglob("*") if p.is_file()) / 1e6
                cost = best["empty"][1] / best["without"][1] - 1
                print(f"| {mesh}, {pipeline} |", " | ".join(f"{best[s][0]:.2f}" for s in ("without", "empty", "full")), "|",
                      " | ".join(f"{best[s][1]:.2f}" for s in ("without", "empty", "full")), f"| {100 * cost:.0f} % | {stored:.0f} |",
                      flush=True)


if __name__ == "__main__":
    main()
