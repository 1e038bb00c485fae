#!/usr/bin/env python3
"""Many small assets: `facetmill batch` beside a process for each file, of facetmill, gltfpack and gltf-transform.

Each file, a closed rough surface in a .glb, is simplified to half of its triangles and written as a .glb; facetmill alone
reads back what it wrote. By default it measures the deviation, too; "unmeasured" it does not, as the others. Programs that
take one file are run one after the other, as a shell loop does, and as many at a time as there are cores (xargs -P). The
rounds alternate, so that whatever else the machine does meets all of them; the fastest of each counts. Processor time is
that of all processes, and changes less than wall time when the machine is busy.

npm install gltfpack @gltf-transform/cli     gives the peers; --npm names the folder of node_modules"""

import argparse
import os
import pathlib
import resource
import shutil
import subprocess
import sys
import tempfile
import time

from peers import add_common_options, output

PIPELINE = """facetmill: 1
params: {input: path}
stages: [load: "${input}", simplify: 50%, {write: "${input.stem}.glb"}]
"""
UNMEASURED = PIPELINE.replace("simplify: 50%", "simplify: {ratio: 50%, measure: false}")
MAKE = """facetmill: 1
params: {seed: integer}
stages:
  - generate: {shape: icosphere, subdivisions: 3, noise: 0.01, seed: "${seed}"}
  - write: "${seed}.glb"
"""


def commands(facetmill, npm, cores):
    """By name: the command that makes all files of in/ into files of out/, in a shell."""
    each = "cd in && printf '%s\\0' *.glb | xargs -0 -n1 -P{jobs} sh -c '{one}'"
    one = {f"facetmill{kind}": f'"{facetmill}" run ../{file} -D input=$0 -o ../out -q -j1'
           for kind, file in (("", "p.yaml"), (" unmeasured", "u.yaml"))}
    for name, how in (("gltfpack", '-i $0 -o ../out/$0 -si 0.5 -noq'),
                      ("gltf-transform", 'simplify $0 ../out/$0 --ratio 0.5 --error 1')):
        path = shutil.which(name, path=str(npm / "node_modules/.bin") if npm else None)
        if path:
            one[name] = f'"{path}" {how} >/dev/null'
        else:
            print(f"missing: {name}", file=sys.stderr)
    all_of_them = {f"facetmill batch{kind}": f"'{facetmill}' batch {file} --input 'in/*.glb' -o out -q -j{cores}"
                   for kind, file in (("", "p.yaml"), (" unmeasured", "u.yaml"))}
    for name, command in one.items():
        all_of_them[f"{name}, one by one"] = each.format(jobs=1, one=command)
        all_of_them[f"{name}, {cores} at a time"] = each.format(jobs=cores, one=command)
    return all_of_them


def timed(command, folder, count):
    """Wall and processor seconds."""
    shutil.rmtree(folder / "out", ignore_errors=True)
    (folder / "out").mkdir()
    used = lambda: sum(resource.getrusage(resource.RUSAGE_CHILDREN)[:2])
    wall, cpu = time.perf_counter(), used()
    done = subprocess.run(["sh", "-c", command], cwd=folder, capture_output=True, text=True)
    wall, cpu = time.perf_counter() - wall, used() - cpu
    written = len(list((folder / "out").glob("*.glb")))
    if done.returncode != 0 or written != count:
        raise RuntimeError(f"{command}: {written} of {count} files\n{done.stderr[-500:]}")
    return wall, cpu


def main():
    ask = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    add_common_options(ask, repeat=3)
    ask.add_argument("--npm", type=pathlib.Path, help="the folder that has node_modules")
    ask.add_argument("--count", default=300, type=int)
    options = ask.parse_args()
    facetmill = (options.build / "facetmill").resolve()
    cores = len(os.sched_getaffinity(0))
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        (folder / "p.yaml").write_text(PIPELINE)
        (folder / "u.yaml").write_text(UNMEASURED)
        (folder / "make.yaml").write_text(MAKE)
        (folder / "seeds.csv").write_text("seed\n" + "\n".join(map(str, range(1, options.count + 1))) + "\n")
        output([facetmill, "batch", folder / "make.yaml", "--table", folder / "seeds.csv", "-o", folder / "in", "-q"])
        best = {}
        for _ in range(options.repeat):
            for what, command in commands(facetmill, options.npm and options.npm.resolve(), cores).items():
                wall, cpu = timed(command, folder, options.count)
                print(f"{what}: {wall:.2f} s, {cpu:.2f} CPU s", file=sys.stderr)
                known = best.get(what, (wall, cpu))
                best[what] = (min(known[0], wall), min(known[1], cpu))
    print(f"| {options.count} files of 1,280 triangles to half | seconds | relative | CPU s | relative |\n|---|---|---|---|---|")
    first = next(iter(best.values()))
    for what, (wall, cpu) in best.items():
        print(f"| {what} | {wall:.2f} | {wall / first[0]:.1f} | {cpu:.2f} | {cpu / first[1]:.1f} |")


if __name__ == "__main__":
    main()
