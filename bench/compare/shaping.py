#!/usr/bin/env python3
"""shaping.py [SCAN]: midpoint splits and ten rounds of relaxation side by side, as a table.

Each case runs in a process of its own, in turn: wall and CPU seconds of the call alone, the fastest of some runs
taken in rounds over all peers, and how many times ours that is. Reading and a library's own structure are outside;
ours finds its neighbours while the clock runs. Without SCAN a crumpled sphere of 1.3M faces is made.

--curve LEVELS (8,9,10) splits and relaxes icospheres of 20 * 4^LEVEL faces instead: the time for a face.

Peers: OpenMesh, PMP (cmake -DPMP_SOURCE=its checkout), and with --python INTERPRETER what that one can import of
vtk, trimesh and pymeshlab. Missing ones are named.
"""
import argparse
import json
import pathlib
import sys
import tempfile

from peers import add_common_options, crumpled_sphere, output, peers_of

VTK = """
import vtk
reader = vtk.vtkPLYReader(); reader.SetFileName(sys.argv[1]); reader.Update()
f = %s; f.SetInputConnection(reader.GetOutputPort()); %s
_, wall, cpu = measured(f.Update)
report(wall, cpu, f.GetOutput().GetNumberOfPolys())
"""
TRIMESH = """
import trimesh
m = trimesh.load(sys.argv[1], process=False)
out, wall, cpu = measured(lambda: %s)
report(wall, cpu, len(out.faces))
"""
PYMESHLAB = """
import pymeshlab
ms = pymeshlab.MeshSet(verbose=False); ms.load_new_mesh(sys.argv[1])
_, wall, cpu = measured(lambda: ms.%s)
report(wall, cpu, ms.current_mesh().face_number())
"""
PYTHON_PEERS = {
    "split: VTK linear": ("vtk", VTK % ("vtk.vtkLinearSubdivisionFilter()", "f.SetNumberOfSubdivisions(1)")),
    "relax: VTK windowed sinc": ("vtk", VTK % ("vtk.vtkWindowedSincPolyDataFilter()", "f.SetNumberOfIterations(10)")),
    "split: trimesh": ("trimesh", TRIMESH % "m.subdivide()"),
    "relax: trimesh Laplacian": ("trimesh", TRIMESH % "trimesh.smoothing.filter_laplacian(m, iterations=10)"),
    "split: pymeshlab": ("pymeshlab", PYMESHLAB % "meshing_surface_subdivision_midpoint(iterations=1, "
                         "threshold=pymeshlab.PercentageValue(0))"),
    "relax: pymeshlab Laplacian": ("pymeshlab", PYMESHLAB % "apply_coord_laplacian_smoothing(stepsmoothnum=10)"),
}


def fastest(peers, scan, repeat):
    """The least wall and CPU seconds of each peer; a peer that fails is printed and left out."""
    best = {}
    for _ in range(repeat):
        for name in list(peers):
            try:
                run = json.loads(output([*peers[name], scan]))
            except RuntimeError as problem:
                print(f"| {name} | {problem} |", flush=True)
                del peers[name]
                continue
            last = best.setdefault(name, run)
            last.update(wall=min(last["wall"], run["wall"]), cpu=min(last["cpu"], run["cpu"]))
    return best


def table(peers, scan, repeat):
    print("| | wall s | x ours | CPU s | x ours | faces out |\n|---|---|---|---|---|---|")
    best = fastest(peers, scan, repeat)
    for what in ("split", "relax"):
        ours = best[f"{what}: facetmill"]
        for name, run in sorted(best.items(), key=lambda item: item[1]["wall"]):
            if name.startswith(what):
                print(f"| {name} | {run['wall']:.3f} | {run['wall'] / ours['wall']:.1f} | {run['cpu']:.3f} | "
                      f"{run['cpu'] / ours['cpu']:.1f} | {run['faces']:,} |")


def curve(program, facetmill, levels, repeat, folder):
    print("| faces | | wall s | ns/face | CPU s | ns/face |\n|---|---|---|---|---|---|")
    ours = {name: [program, "run", name] for name in ("split: facetmill", "relax: facetmill")}
    for level in levels.split(","):
        faces, path = 20 * 4 ** int(level), pathlib.Path(folder) / "sphere.ply"
        crumpled_sphere(facetmill, level, path)
        for name, run in fastest(dict(ours), path, repeat).items():
            print(f"| {faces:,} | {name} | {run['wall']:.3f} | {run['wall'] / faces * 1e9:.0f} | {run['cpu']:.3f} | "
                  f"{run['cpu'] / faces * 1e9:.0f} |", flush=True)


def main():
    ask = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    ask.add_argument("scan", nargs="?", help="a closed triangle mesh, PLY")
    add_common_options(ask, repeat=5)
    ask.add_argument("--curve", help="levels of icospheres, with commas")
    args = ask.parse_args()
    program = args.build / "bench/shaping_peers"
    peers = peers_of(program, args.python, PYTHON_PEERS)
    if "split: PMP" not in peers:
        print("missing: PMP", file=sys.stderr)
    with tempfile.TemporaryDirectory() as folder:
        if args.curve:
            return curve(program, args.build / "facetmill", args.curve, args.repeat, folder)
        scan = args.scan
        if not scan:
            scan = pathlib.Path(folder) / "in.ply"
            crumpled_sphere(args.build / "facetmill", "8", scan)
        table(peers, scan, args.repeat)


if __name__ == "__main__":
    main()
