#!/usr/bin/env python3
"""combine.py [SCAN] [OTHER] --python INTERPRETER: Boolean operations on two scans, beside manifold3d.

The scans (the example twice, turned, unless others are given) are split once and overlap. Ours is the time of stage
combine alone, which also finds self-intersections of each scan and of the result; manifold3d does not. Wall and CPU
seconds, the fastest of several runs, each in a process of its own, and the volumes, which must agree.
"""
import argparse
import json
import pathlib
import resource
import sys
import tempfile

from peers import ROOT, TIMED, add_common_options, output

MANIFOLD = TIMED + """
import manifold3d, numpy, trimesh
def solid(path):
    mesh = trimesh.load(path, process=False)
    return manifold3d.Manifold(manifold3d.Mesh64(numpy.asarray(mesh.vertices, 'f8'), numpy.asarray(mesh.faces, 'u8')))
a, b = solid(sys.argv[1]), solid(sys.argv[2]); a.num_tri(); b.num_tri()
def work():
    made = {"union": lambda: a + b, "difference": lambda: a - b, "intersection": lambda: a ^ b}[sys.argv[3]]()
    made.num_tri()
    return made
made, wall, cpu = measured(work)
print(json.dumps({"wall": wall, "cpu": cpu, "faces": made.num_tri(), "volume": made.volume()}))
"""


def prepared(mill, scan, path, *moves):
    output([mill, "pipe", "--quiet", "load", scan, "!", "transform", "--centre", "--bake", *moves, "!", "split", "midpoint",
            "!", "write", path])


def spent():
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime


def ours(mill, a, b, operation, folder):
    """The stage's wall seconds; CPU seconds of the run, less those of one that loads only."""
    both = ["load", a, "!", "load", b]
    before = spent()
    output([mill, "pipe", "--quiet", *both])
    loaded = spent()
    times = folder / "times.json"
    output([mill, "pipe", "--quiet", "--timings", times, *both, "!", "combine", operation, "--with", b.stem])
    cpu = spent() - loaded - (loaded - before)
    told = json.loads(output([mill, "pipe", "--quiet", *both, "!", "combine", operation, "--with", b.stem, "!", "measure", "--path", "-"]))
    stage = next(s for s in json.loads(times.read_text())["stages"] if s["name"] == "combine")
    return {"wall": stage["seconds"], "cpu": cpu, "volume": told["total"]["solid"]["volume"]}


def main():
    ask = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    ask.add_argument("scan", nargs="?", default=ROOT / "examples/data/nefertiti.ply")
    ask.add_argument("other", nargs="?")
    add_common_options(ask, repeat=3)
    args = ask.parse_args()
    mill = args.build / "facetmill"
    print("| operation | facetmill, s | CPU s | manifold3d, s | CPU s | relative, CPU | volumes differ by |")
    print("|---|---|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        a, b = folder / "a.ply", folder / "b.ply"
        prepared(mill, args.scan, a)
        turn = [] if args.other else ["--rotate.angle", "37", "--rotate.axis", "1,2,3"]
        prepared(mill, args.other or args.scan, b, *turn)
        for operation in ("union", "difference", "intersection"):
            own = [ours(mill, a, b, operation, folder) for _ in range(args.repeat)]
            peer = [json.loads(output([args.python, "-c", MANIFOLD, a, b, operation])) for _ in range(args.repeat)]
            least = lambda runs, key: min(run[key] for run in runs)
            x, y = own[0]["volume"], peer[0]["volume"]
            print(f"| {operation} | {least(own, 'wall'):.3f} | {least(own, 'cpu'):.3f} | {least(peer, 'wall'):.3f} | "
                  f"{least(peer, 'cpu'):.3f} | {least(own, 'cpu') / least(peer, 'cpu'):.2f} | {abs(x - y) / abs(y):.0e} |", flush=True)


if __name__ == "__main__":
    sys.exit(main())
