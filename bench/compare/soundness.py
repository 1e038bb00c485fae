#!/usr/bin/env python3
"""Judging and probing a large closed mesh: facetmill's benchmarks beside trimesh (with Embree for rays) and pymeshlab.

soundness.py MESH [--build build/release] [--only FILTER]

MESH is a closed triangle mesh in a file that all can read. CGAL's times come from facetmill_bench, too. Run it by an
interpreter that has numpy, trimesh, embreex and pymeshlab. Prints CPU and wall seconds of each in one run, and what the
others cost relative to facetmill.
"""
import argparse
import json
import os
import pathlib
import subprocess
import time

import numpy as np
import pymeshlab
import trimesh
from trimesh.ray import ray_pyembree

ROOT = pathlib.Path(__file__).resolve().parents[2]
os.environ["FACETMILL_CACHE"] = "off"  # what is timed is done


def timed(work, times=1):
    """CPU and wall seconds of the fastest of some runs."""
    best = (float("inf"), float("inf"))
    for _ in range(times):
        cpu, wall = time.process_time(), time.perf_counter()
        work()
        best = min(best, (time.process_time() - cpu, time.perf_counter() - wall))
    return best


def facetmill(bench, mesh, pattern):
    out = subprocess.run(
        [bench, f"--benchmark_filter={pattern}", "--benchmark_format=json"],
        env=dict(os.environ, FACETMILL_SCAN=mesh), stdout=subprocess.PIPE, check=True).stdout
    return {b["name"].split("/iterations")[0].replace("/process_time", "").replace("/real_time", ""):
            (b["cpu_time"] / 1000, b["real_time"] / 1000) for b in json.loads(out)["benchmarks"]}


def properties(mesh):
    """trimesh: watertight, winding, Euler's number; nothing remembered from before."""
    fresh = trimesh.Trimesh(mesh.vertices, mesh.faces, process=False)
    return fresh.is_watertight, fresh.is_winding_consistent, fresh.euler_number


def random_points(mesh, count):
    random = np.random.default_rng(1)
    low, high = mesh.bounds
    return low + random.random((count, 3)) * (high - low)


def first_hits(mesh, points):
    """trimesh with Embree, of the ray from each point to the next: the first triangle alone, and with the point.

    Both in one thread, as trimesh has it, and without the parameter along the ray, which facetmill gives too.
    """
    rays = ray_pyembree.RayMeshIntersector(mesh)
    ways = np.diff(points, axis=0)
    rays.intersects_first(points[:1], ways[:1])  # builds its tree
    return (timed(lambda: rays.intersects_first(points[:-1], ways)),
            timed(lambda: rays.intersects_location(points[:-1], ways, multiple_hits=False)))


def lab(path):
    """pymeshlab: topological measures, and the faces that intersect others."""
    meshes = pymeshlab.MeshSet()
    meshes.load_new_mesh(path)
    return (timed(meshes.get_topological_measures),
            timed(meshes.compute_selection_by_self_intersections_per_face))


def main():
    ask = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    ask.add_argument("mesh")
    ask.add_argument("--build", default=ROOT / "build/release", type=pathlib.Path)
    ask.add_argument("--only", default="inspect_scan|self_inter|face_tree|probe_points|segments|closest",
                     help="the benchmarks of ours that run, as a pattern")
    args = ask.parse_args()
    path, mesh = args.mesh, trimesh.load(args.mesh, process=False)
    print(f"{len(mesh.faces)} faces; CPU seconds, wall seconds")
    ours = facetmill(args.build / "bench/facetmill_bench", path, args.only)
    for name, (cpu, wall) in ours.items():
        print(f"  {name:<34}{cpu:9.3f}{wall:9.3f}")

    def peer(name, times, ours_name):
        against = ours.get(ours_name)
        ratio = f"   {times[0] / against[0]:.1f}x the CPU of {ours_name}, {times[1] / against[1]:.1f}x its wall time" if against else ""
        print(f"  {name:<34}{times[0]:9.3f}{times[1]:9.3f}{ratio}")

    peer("trimesh properties", timed(lambda: properties(mesh), 2), "inspect_scan")
    measures, crossing = lab(path)
    peer("pymeshlab topology", measures, "inspect_scan")
    peer("pymeshlab self-intersections", crossing, "self_intersections_scan")
    triangles, points = first_hits(mesh, random_points(mesh, 1000001))
    peer("trimesh, Embree: triangle", triangles, "segments/first/0")
    peer("trimesh, Embree: and point", points, "segments/first/0")
    for name, against in (("self_intersections_scan_cgal", "self_intersections_scan"),
                          ("closest_points/near/cgal/1", "closest_points/near/1"),
                          ("segments/any/cgal", "segments/first/0")):
        if name in ours:
            peer(name, ours[name], against)


main()
