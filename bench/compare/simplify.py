#!/usr/bin/env python3
"""simplify.py [SCAN]: the simplifiers side by side, as a table.

Each case runs in a process of its own, in turn, on the same machine: the scan (examples/data by default), refined
by midpoint splits and roughened to about 1.1M and 4.5M faces, to 50, 10 and 1 %. The times are those of the call,
on the clock and of all processors; reading, writing and judging are outside. The memory is the process's peak, for the
faces of the input. All results are judged by the same samples and seed.

Peers: meshoptimizer (Debian's, or the newest by cmake -DMESHOPTIMIZER_SOURCE=its checkout), CGAL, and with
--python INTERPRETER what that one can import of pymeshlab and fast_simplification. Missing ones are named.
"""
import argparse
import json
import pathlib
import tempfile

from peers import ROOT, add_common_options, output, peers_of

PYTHON_PEERS = {
    "pymeshlab": ("pymeshlab", """
import pymeshlab
ms = pymeshlab.MeshSet(verbose=False); ms.load_new_mesh(sys.argv[1])
n = int(ms.current_mesh().face_number() * float(sys.argv[3]))
_, wall, cpu = measured(lambda: ms.meshing_decimation_quadric_edge_collapse(targetfacenum=n))
ms.save_current_mesh(sys.argv[2]); report(wall, cpu, ms.current_mesh().face_number())
"""),
    "fast_simplification": ("fast_simplification", """
import fast_simplification, trimesh
m = trimesh.load(sys.argv[1], process=False)
(p, f), wall, cpu = measured(lambda: fast_simplification.simplify(m.vertices, m.faces, 1 - float(sys.argv[3])))
trimesh.Trimesh(p, f, process=False).export(sys.argv[2]); report(wall, cpu, len(f))
"""),
}


def make_input(facetmill, scan, passes, path):
    """The scan as it is, or with 4^passes times its faces and a roughness that splitting alone would not have."""
    stages = ["!", "split", "midpoint", "--passes", passes, "!", "relax", "2", "!", "crumple", "--grid", "1",
              "--amplitude", "0.01%"] if passes else []
    output([facetmill, "pipe", "--quiet", "load", scan, *stages, "!", "write", path])


def main():
    ask = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    ask.add_argument("scan", nargs="?", default=ROOT / "examples/data/nefertiti.ply")
    ask.add_argument("--passes", default="0,2", help="splits of the scan: 0, 2, 3 (default: 0,2)")
    ask.add_argument("--ratios", default="0.5,0.1,0.01")
    ask.add_argument("--only", default="", help="peers whose name has this")
    add_common_options(ask, repeat=3)
    args = ask.parse_args()
    program = args.build / "bench/simplify_peers"
    peers = peers_of(program, args.python, PYTHON_PEERS)
    print("| faces | to | simplifier | seconds | CPU s | bytes/face | faces out | RMS % | max % | closed | manifold | self-inters. |")
    print("|---|---|---|---|---|---|---|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as folder:
        for passes in args.passes.split(","):
            scan = pathlib.Path(folder) / "in.ply"
            make_input(args.build / "facetmill", args.scan, int(passes), scan)
            for ratio in args.ratios.split(","):
                for name in sorted(n for n in peers if args.only in n):
                    row(program, name, peers[name], scan, pathlib.Path(folder) / "out.ply", ratio, args.repeat)


def row(program, name, command, scan, result, ratio, repeat):
    try:
        runs = [json.loads(output([*command, scan, result, ratio])) for _ in range(repeat)]
        judged = json.loads(output([program, "judge", scan, result]))
    except RuntimeError as problem:
        print(f"| | {float(ratio):.0%} | {name} | {problem} |")
        return
    faces = next(int(line.split()[2]) for line in open(scan, "rb") if line.startswith(b"element face"))
    print(f"| {faces:,} | {float(ratio):.0%} | {name} | {min(r['wall'] for r in runs):.3f} | "
          f"{min(r['cpu'] for r in runs):.3f} | {runs[0].get('peak_bytes', 0) / faces:.0f} | {runs[0]['faces']:,} | "
          f"{judged['rms_percent']:.5f} | {judged['max_percent']:.4f} | {judged['closed']} | {judged['manifold']} | "
          f"{judged['self_intersections']} |", flush=True)


if __name__ == "__main__":
    main()
