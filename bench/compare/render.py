#!/usr/bin/env python3
"""A picture of a rough closed surface of 1,310,720 faces, 1200 x 900 pixels: `facetmill render`, with and without
occlusion, beside F3D in software GL.

The rounds alternate, so that whatever else the
machine does meets all of them; the fastest of each counts. Both read the same binary PLY and write a PNG.

apt-get install f3d xvfb     gives the peer, and a display for it to draw on"""

import argparse
import os
import pathlib
import resource
import shutil
import subprocess
import sys
import tempfile
import time

from peers import add_common_options, crumpled_sphere


def commands(facetmill):
    own = [str(facetmill), "render", "big.ply", "-q", "-o"]
    all_of_them = {"facetmill, without occlusion": [*own, "a.png", "--no-occlusion"], "facetmill": [*own, "b.png"]}
    if shutil.which("f3d") and shutil.which("xvfb-run"):
        all_of_them["F3D"] = ["f3d", "big.ply", "--output=c.png", "--resolution=1200,900"]
    else:
        print("missing: f3d, xvfb-run", file=sys.stderr)
    return all_of_them


def timed(command, folder):
    """Wall and processor seconds."""
    used = lambda: sum(resource.getrusage(resource.RUSAGE_CHILDREN)[:2])
    wall, cpu = time.perf_counter(), used()
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True,
                          env={**os.environ, "LIBGL_ALWAYS_SOFTWARE": "1"})
    if done.returncode:
        sys.exit(f"{command[0]}: {done.stderr}")
    return time.perf_counter() - wall, used() - cpu


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    add_common_options(parser, repeat=5)
    given = parser.parse_args()
    facetmill = (given.build / "facetmill").resolve()
    if "DISPLAY" not in os.environ and shutil.which("xvfb-run"):  # once, since its start takes time
        os.execvp("xvfb-run", ["xvfb-run", "-a", sys.executable, *sys.argv])
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        crumpled_sphere(facetmill, 8, folder / "big.ply")
        best = {}
        for _ in range(given.repeat):
            for what, command in commands(facetmill).items():
                best[what] = min(best.get(what, (1e9, 1e9)), timed(command, folder))
    print("| picture | seconds | CPU s |\n|---|---|---|")
    for what, (wall, cpu) in best.items():
        print(f"| {what} | {wall:.2f} | {cpu:.2f} |")


if __name__ == "__main__":
    main()
