#!/usr/bin/env python3
"""Isotropic remeshing beside CGAL's and pymeshlab's: remesh.py MILL MESH.ply LENGTH [CGAL_PROGRAM]

CGAL_PROGRAM reads IN OUT LENGTH ITERATIONS, calls isotropic_remeshing and prints its processor time; pymeshlab runs
if Python has it. Shapes are computed here from the written files, deviations by `facetmill diff`."""

import json
import os
import pathlib
import resource
import subprocess
import sys
import tempfile
import time

import numpy
import trimesh


os.environ["FACETMILL_CACHE"] = "off"


def shapes(path):
    """Smallest angle, share of angles below 30 degrees, mean aspect, share of six edges, closed, manifold."""
    mesh = trimesh.load(path, process=False)
    points, faces = numpy.asarray(mesh.vertices), numpy.asarray(mesh.faces)
    a, b, c = (points[faces[:, k]] for k in range(3))

    def angle(p, q, r):
        u, v = q - p, r - p
        return numpy.degrees(numpy.arctan2(numpy.linalg.norm(numpy.cross(u, v), axis=1), (u * v).sum(1)))
    angles = numpy.stack([angle(a, b, c), angle(b, c, a), angle(c, a, b)])
    sides = numpy.stack([numpy.linalg.norm(q - p, axis=1) for p, q in ((a, b), (b, c), (c, a))])
    height = numpy.linalg.norm(numpy.cross(b - a, c - a), axis=1) / sides.max(0)
    aspect = sides.max(0) * numpy.sqrt(3) / 2 / height  # 1 for an equilateral triangle
    directed = numpy.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]])
    low, high = directed.min(1).astype(numpy.int64), directed.max(1).astype(numpy.int64)
    _, uses = numpy.unique(low * len(points) + high, return_counts=True)
    edges = numpy.unique(numpy.stack([low, high], 1), axis=0)
    valence = numpy.bincount(edges.ravel(), minlength=len(points))
    valence = valence[valence > 0]
    return {"faces": len(faces), "smallest": angles.min(), "below30": (angles.min(0) < 30).mean() * 100,
            "mean_smallest": angles.min(0).mean(), "aspect": aspect[numpy.isfinite(aspect)].mean(), "six": (valence == 6).mean() * 100,
            "closed": bool((uses == 2).all()), "manifold": bool((uses <= 2).all())}


def timed(call):
    before, start = resource.getrusage(resource.RUSAGE_CHILDREN), time.time()
    said = call()
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime, time.time() - start, said


def deviation(mill, before, after):
    said = subprocess.run([mill, "diff", before, after, "--json"], capture_output=True, text=True).stdout
    found = json.loads(said)
    return found["deviation"]["forward"]["maximum"], found["deviation"]["backward"]["maximum"], found["deviation"]["diagonal"]


def main():
    mill, mesh, length = sys.argv[1], sys.argv[2], float(sys.argv[3])
    cgal = sys.argv[4] if len(sys.argv) > 4 else None
    pymeshlab = ("import pymeshlab,sys; s=pymeshlab.MeshSet(); s.load_new_mesh(sys.argv[1]); "
                 "s.meshing_isotropic_explicit_remeshing(targetlen=pymeshlab.PureValue(float(sys.argv[3])), "
                 "iterations=int(sys.argv[4])); s.save_current_mesh(sys.argv[2])")
    with tempfile.TemporaryDirectory() as folder:
        out = str(pathlib.Path(folder) / "out.ply")
        own = [mill, "pipe", "-q", "load", mesh, "!", "remesh", str(length), "--measure", "false"]
        rows = [(f"facetmill, {n} iterations", [*own, "--iterations", str(n), "!", "write", out]) for n in (3, 6)]
        if cgal:
            rows += [(f"CGAL, {n} iterations", [cgal, mesh, out, str(length), str(n)]) for n in (3, 6)]
        rows += [(f"pymeshlab, {n} iterations", [sys.executable, "-c", pymeshlab, mesh, out, str(length), str(n)])
                 for n in (3, 6, 10)]
        print("| program | faces | smallest angle | faces below 30° | mean smallest angle | mean aspect | six edges | closed | manifold | "
              "farthest from input | processor time | wall time |\n|" + "---|" * 12)
        for name, command in [("input", None), *rows]:
            cpu = wall = None
            if command:
                cpu, wall, _ = timed(lambda command=command: subprocess.run(command, check=True, capture_output=True))
            s = shapes(out if command else mesh)
            far = max(deviation(mill, mesh, out)[:2]) if command else 0
            print(f"| {name} | {s['faces']:,} | {s['smallest']:.2f}° | {s['below30']:.2f} % | {s['mean_smallest']:.1f}° | {s['aspect']:.3f} | {s['six']:.1f} % | "
                  f"{'yes' if s['closed'] else 'no'} | {'yes' if s['manifold'] else 'no'} | {far:.4g} | "
                  + (f"{cpu:.1f} s | {wall:.1f} s |" if command else "| |"), flush=True)


if __name__ == "__main__":
    main()
