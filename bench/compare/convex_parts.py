#!/usr/bin/env python3
"""Compares hull: {max_parts: N} with CoACD and V-HACD: parts, distance of the hulls from the solid, surface that no hull
contains, volume and processor seconds. Prints a Markdown table.

    pip install coacd vhacdx trimesh scipy
    bench/compare/convex_parts.py build/release/facetmill mesh.obj ...

CoACD gets the same largest number of parts, and the threshold 0.05 of its manual. V-HACD gets the number of parts and
its defaults. Every tool reads the same PLY file, merged and welded, and uses its own number of threads.
"""

import argparse
import os
import pathlib
import subprocess
import tempfile

import numpy as np
import trimesh
from scipy.spatial import ConvexHull, cKDTree

SAMPLES = 100000


def cpu_seconds():
    """Processor time of this process and of its children."""
    times = os.times()
    return times.user + times.system + times.children_user + times.children_system


def facetmill(exe, mesh, parts, concavity, folder):
    out = folder / "hulls.glb"
    begin = cpu_seconds()
    subprocess.run([exe, "pipe", "load", mesh, "!", "hull", "--max_parts", str(parts), "--concavity", concavity, "!", "write", out],
                   check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    seconds = cpu_seconds() - begin
    scene = trimesh.load(out)
    return [np.asarray(m.vertices) for m in scene.dump()], seconds


def coacd_parts(mesh, parts):
    import coacd
    coacd.set_log_level("error")
    begin = cpu_seconds()
    hulls = coacd.run_coacd(coacd.Mesh(mesh.vertices, mesh.faces), threshold=0.05, max_convex_hull=parts)
    return [np.asarray(v) for v, _ in hulls], cpu_seconds() - begin


def vhacd_parts(mesh, parts):
    import vhacdx
    begin = cpu_seconds()
    faces = np.column_stack([np.full(len(mesh.faces), 3), mesh.faces]).ravel().astype(np.uint32)
    hulls = vhacdx.compute_vhacd(np.asarray(mesh.vertices, dtype=np.float64), faces, maxConvexHulls=parts)
    return [np.asarray(v) for v, _ in hulls], cpu_seconds() - begin


def judge(mesh, hulls):
    """Distances in percent of the diagonal: of the hulls from the solid, and of the surface from the hulls."""
    rng = np.random.default_rng(1)
    diagonal = np.linalg.norm(mesh.extents)
    surface, face = trimesh.sample.sample_surface(mesh, SAMPLES, seed=1)
    surface = np.vstack([surface, mesh.vertices])
    normals = np.vstack([mesh.face_normals[face], mesh.vertex_normals])
    tree = cKDTree(surface)
    solids = [ConvexHull(v, qhull_options="QJ") for v in hulls]
    far = 0.0
    for hull in solids:
        corners = hull.points[hull.simplices]
        weights = rng.dirichlet((1, 1, 1), 20)
        points = np.vstack([np.einsum("wk,tkd->twd", weights, corners).reshape(-1, 3), hull.points[hull.vertices]])
        distance, nearest = tree.query(points)
        outside = np.einsum("ij,ij->i", points - surface[nearest], normals[nearest]) > 0
        far = max(far, distance[outside].max(initial=0))
    left = np.full(len(surface), np.inf)
    for hull in solids:
        beyond = np.full(len(surface), -np.inf)
        for plane in np.unique(hull.equations, axis=0):
            beyond = np.maximum(beyond, surface @ plane[:3] + plane[3])
        left = np.minimum(left, beyond)
    volume = sum(h.volume for h in solids) / mesh.volume if mesh.is_volume else float("nan")
    return 100 * far / diagonal, 100 * max(left.max(), 0) / diagonal, volume


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("exe")
    parser.add_argument("meshes", nargs="+")
    parser.add_argument("--parts", type=int, default=16)
    parser.add_argument("--concavity", default="2%")
    args = parser.parse_args()
    print("| mesh | faces | tool | parts | hulls from solid, % | surface outside hulls, % | volume ratio | CPU s |")
    print("|---|---|---|---|---|---|---|---|")
    for name in args.meshes:
        with tempfile.TemporaryDirectory() as folder:
            folder = pathlib.Path(folder)
            ply = folder / "mesh.ply"
            subprocess.run([args.exe, "pipe", "load", name, "!", "triangulate", "!", "merge", "--weld", "!", "write", ply],
                           check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            mesh = trimesh.load(ply, process=False)
            tools = {"facetmill": lambda: facetmill(args.exe, ply, args.parts, args.concavity, folder),
                     "CoACD": lambda: coacd_parts(mesh, args.parts), "V-HACD": lambda: vhacd_parts(mesh, args.parts)}
            for tool, run in tools.items():
                hulls, seconds = run()
                far, left, volume = judge(mesh, hulls)
                print(f"| {pathlib.Path(name).name} | {len(mesh.faces):,} | {tool} | {len(hulls)} | {far:.2f} | {left:.2g} "
                      f"| {volume:.2f} | {seconds:.1f} |", flush=True)


if __name__ == "__main__":
    main()
