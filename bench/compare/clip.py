#!/usr/bin/env python3
"""clip.py [SCAN]: capped clips by one oblique plane through the centre, side by side, as a table.

Each case runs in a process of its own, in turn, on one core and on all: CPU and wall seconds of the call alone, the
fastest of some runs, and how many times ours that is. Reading, building a library's structure (named where it is
part of the price) and writing are outside. Without SCAN a crumpled sphere of 1.3M faces is made.

Memory is what the call adds at its peak to what was there, the input included; the mark is twice the input plus the
output, so that the call may add input + output.

Peers: CGAL, and with --python INTERPRETER what that one can import of vtk, manifold3d and trimesh.
"""
import argparse
import json
import os
import pathlib
import tempfile

from peers import add_common_options, crumpled_sphere, output, peers_of

PLANE = """
import numpy
def plane(points): return numpy.array([1, 0.7, 0.3]), (points.min(axis=0) + points.max(axis=0)) / 2
"""

PYTHON_PEERS = {
    "vtkClipClosedSurface": ("vtk", """
import vtk
from vtkmodules.util.numpy_support import vtk_to_numpy
reader = vtk.vtkPLYReader(); reader.SetFileName(sys.argv[1]); reader.Update()
n, c = plane(vtk_to_numpy(reader.GetOutput().GetPoints().GetData()).astype(float))
p = vtk.vtkPlane(); p.SetNormal(n); p.SetOrigin(c); planes = vtk.vtkPlaneCollection(); planes.AddItem(p)
clip = vtk.vtkClipClosedSurface(); clip.SetInputConnection(reader.GetOutputPort()); clip.SetClippingPlanes(planes)
_, wall, cpu = measured(clip.Update)
report(wall, cpu, clip.GetOutput().GetNumberOfPolys())
"""),
    "manifold3d trim_by_plane": ("manifold3d", """
import manifold3d, trimesh
m = trimesh.load(sys.argv[1], process=False); n, c = plane(m.vertices); n = n / numpy.linalg.norm(n)
body = manifold3d.Manifold(manifold3d.Mesh64(numpy.array(m.vertices), numpy.array(m.faces, dtype=numpy.uint64)))
body.num_tri()
def call():
    cut = body.trim_by_plane(list(n), float(n @ c)); cut.num_tri(); return cut
cut, wall, cpu = measured(call)
report(wall, cpu, cut.num_tri())
"""),
    "manifold3d with construction": ("manifold3d", """
import manifold3d, trimesh
m = trimesh.load(sys.argv[1], process=False); n, c = plane(m.vertices); n = n / numpy.linalg.norm(n)
points, faces = numpy.array(m.vertices), numpy.array(m.faces, dtype=numpy.uint64)
def call():
    cut = manifold3d.Manifold(manifold3d.Mesh64(points, faces)).trim_by_plane(list(n), float(n @ c)); cut.num_tri()
    return cut
cut, wall, cpu = measured(call)
report(wall, cpu, cut.num_tri())
"""),
    "trimesh slice_mesh_plane": ("trimesh", """
import trimesh
m = trimesh.load(sys.argv[1], process=False); n, c = plane(m.vertices)
cut, wall, cpu = measured(lambda: trimesh.intersections.slice_mesh_plane(m, n, c, cap=True, engine='earcut'))
report(wall, cpu, len(cut.faces))
"""),
}


def measure(command, cores, repeat):
    runs = [json.loads(output(command, cores and (lambda: os.sched_setaffinity(0, cores)))) for _ in range(repeat)]
    best = dict(runs[0])
    for key in ("wall", "cpu", "above"):
        if key in best:
            best[key] = min(r[key] for r in runs)
    return best


def row(name, one, all_cores, ours):
    memory = "-"
    if one.get("out"):
        mark = one["in"] + one["out"]
        memory = f"{one['above'] / 1e6:.0f} of {mark / 1e6:.0f} MB ({one['above'] / mark:.2f})"
    print(f"| {name} | {one['cpu']:.3f} | {one['cpu'] / ours[0]:.1f} | {all_cores['wall']:.3f} | "
          f"{all_cores['wall'] / ours[1]:.1f} | {one['faces']:,} | {memory} |", flush=True)


def main():
    ask = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    ask.add_argument("scan", nargs="?", help="a closed triangle mesh, PLY")
    add_common_options(ask, repeat=5)
    args = ask.parse_args()
    peers = peers_of(args.build / "bench/clip_peers", args.python,
                     {name: (module, PLANE + code) for name, (module, code) in PYTHON_PEERS.items()})
    with tempfile.TemporaryDirectory() as folder:
        scan = args.scan
        if not scan:
            scan = pathlib.Path(folder) / "in.ply"
            crumpled_sphere(args.build / "facetmill", "8", scan)
        core = {min(os.sched_getaffinity(0))}
        first = "facetmill clip, capped"
        print("| | CPU s, one core | x ours | wall s, all cores | x ours | faces | memory added (1 = 2x input + output) |")
        print("|---|---|---|---|---|---|---|")
        ours = None
        for name in sorted(peers, key=lambda n: (n != first, n)):
            try:
                one, many = (measure([*peers[name], scan], c, args.repeat) for c in (core, None))
                ours = ours or (one["cpu"], many["wall"])
                row(name, one, many, ours)
            except RuntimeError as problem:
                print(f"| {name} | {problem} |", flush=True)


if __name__ == "__main__":
    main()
