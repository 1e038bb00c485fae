#!/usr/bin/env python3
"""chain.py [SCAN] --python INTERPRETER: a whole job as one process, beside the same steps by peers.

A scan of about 1.1M faces (the example, split and roughened, unless one is given): clip with cap, midpoint split,
relax 3, simplify 25 %, validate, write. Ours writes a Draco GLB and reads it back; the peers,
pymeshlab and a chain of the fastest of each step (manifold3d, scipy, fast_simplification), write a PLY, which is less
work. Ours runs without and with the measured deviation, and without reading its output back. Wall and CPU seconds, peak memory; the results are then judged
by `facetmill info`, and the times told as shares of the fastest peer's.
"""
import argparse
import json
import pathlib
import resource
import subprocess
import sys
import tempfile
import time

from peers import ROOT, output
from simplify import make_input

PYMESHLAB = """
import pymeshlab, sys
ms = pymeshlab.MeshSet(verbose=False); ms.load_new_mesh(sys.argv[1])
ms.generate_polyline_from_planar_section(planeaxis='Z Axis', relativeto='Bounding box center', splitsurfacewithsection=True)
ms.set_current_mesh(max(range(ms.mesh_number()), key=lambda i: ms.mesh(i).bounding_box().max()[2] * (ms.mesh(i).face_number() > 0 and i > 0)))
ms.meshing_close_holes(maxholesize=1000000, newfaceselected=False)
ms.meshing_surface_subdivision_midpoint(iterations=1, threshold=pymeshlab.PercentageValue(0))
ms.apply_coord_laplacian_smoothing(stepsmoothnum=3)
ms.meshing_decimation_quadric_edge_collapse(targetperc=0.25)
ms.get_topological_measures()
ms.save_current_mesh(sys.argv[2])
"""

FASTEST = """
import fast_simplification, manifold3d, numpy, scipy.sparse, sys, trimesh
scan = trimesh.load(sys.argv[1], process=False)
solid = manifold3d.Manifold(manifold3d.Mesh(numpy.asarray(scan.vertices, 'f4'), numpy.asarray(scan.faces, 'u4')))
solid = solid.trim_by_plane((0, 0, 1), scan.bounds[:, 2].mean()).refine(2)
mesh = solid.to_mesh()
points, faces = numpy.array(mesh.vert_properties[:, :3], 'f8'), numpy.array(mesh.tri_verts)
edges = numpy.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]])
ones = numpy.ones(2 * len(edges))
near = scipy.sparse.csr_matrix((ones, (edges.ravel('F'), edges[:, ::-1].ravel('F'))), (len(points), len(points)))
near.data[:] = 1
degree = numpy.asarray(near.sum(axis=1)).ravel()
for _ in range(3): points = near @ points / degree[:, None]
points, faces = fast_simplification.simplify(points.astype('f4'), faces.astype('i4'), 0.75)
result = trimesh.Trimesh(points, faces, process=False); result.is_watertight; result.export(sys.argv[2])
"""


def timed(command):
    before, start = resource.getrusage(resource.RUSAGE_CHILDREN), time.perf_counter()
    # The peak of this child alone: GNU time, as RUSAGE_CHILDREN keeps the largest of all.
    done = subprocess.run(["/usr/bin/env", "time", "-f", "%M", *map(str, command)], capture_output=True, text=True)
    if done.returncode != 0:
        raise RuntimeError(done.stderr)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    cpu = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return time.perf_counter() - start, cpu, int(done.stderr.split()[-1]) / 1024


def main():
    ask = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    ask.add_argument("scan", nargs="?")
    ask.add_argument("--build", default=ROOT / "build/release", type=pathlib.Path)
    ask.add_argument("--python", help="an interpreter that has pymeshlab")
    args = ask.parse_args()
    facetmill = args.build / "facetmill"
    with tempfile.TemporaryDirectory() as folder:
        scan = args.scan or f"{folder}/in.ply"
        if not args.scan:
            make_input(facetmill, ROOT / "examples/data/nefertiti.ply", 2, scan)
        def ours(measure, *more):
            return [facetmill, "pipe", "--quiet", *more, "load", scan, "--unit", "mm", "!", "clip", "--plane.normal=0,0,1",
                    "--plane.through=centre", "--cap", "!", "split", "midpoint", "!", "relax", "3", "!", "simplify",
                    "25%", "--measure", measure, "!", "validate", "--closed", "--edge_manifold", "--vertex_manifold",
                    "!", "write", f"{folder}/{measure}.glb", "--draco"]

        output(ours("false", "--save", f"{folder}/chain.yaml"))
        jobs = {"facetmill, not measured, not read back": ([args.build / "bench/chain_own", f"{folder}/chain.yaml"],
                                                          "false.glb"),
                "facetmill, not measured": (ours("false"), "false.glb"),
                "facetmill": (ours("true"), "true.glb")}
        peers = {"pymeshlab": PYMESHLAB, "manifold3d, scipy, fast_simplification": FASTEST} if args.python else {}
        for name, script in peers.items():
            jobs[name] = ([args.python, "-c", script, scan, f"{folder}/peer.ply"], "peer.ply")
        taken = {}
        print("| chain | seconds | CPU s | peak MiB | faces out | closed | edge manifold |\n|---|---|---|---|---|---|---|")
        for name, (command, result) in jobs.items():
            try:
                wall, cpu, peak = timed(command)
            except RuntimeError as problem:
                print(f"{name}: {problem}", file=sys.stderr)
                continue
            taken[name] = wall
            info = json.loads(output([facetmill, "info", "--json", f"{folder}/{result}"]))
            print(f"| {name} | {wall:.2f} | {cpu:.2f} | {peak:.0f} | {info['faces']:,} | {info['closed']} | "
                  f"{info['edge_manifold']} |", flush=True)
        best = min((taken[name] for name in peers if name in taken), default=None)
        for name in taken if best else []:
            print(f"{name}: {100 * taken[name] / best:.0f} % of the fastest peer's time")


if __name__ == "__main__":
    main()
