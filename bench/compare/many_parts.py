#!/usr/bin/env python3
"""many_parts.py [--parts N] [--instances N] [--repeat N] [STAGE...]: what a part costs each stage.

Runs every stage on a scene of N parts of twelve triangles, on a tenth of it, and on nodes that share one mesh of 20,480
triangles. Told is the processor time of a whole run, less that of a run that only loads: for each part in
microseconds, which are the same for both numbers of parts when the work is linear, and for all instances beside one. The
smallest of several runs.
"""
import argparse
import json
import os
import pathlib
import resource
import struct
import subprocess
import tempfile

from peers import ROOT

# Every stage as it is usually asked, and options of the run; ensure and validate judge, generate and load are there for all.
STAGES = {
    "clean": "clean",
    "clip": "clip z=50% --cap",
    "combine": "combine",
    "crop": "crop [[0.1,0.1],[90.3,0.2],[90.3,90.3],[0.2,90.1]] --axis z",
    "crumple": "crumple 0.004",
    "crumple, no crossings": "crumple 0.004 --self_intersections avoid",
    "ensure": "ensure --faces.min 1",
    "load": "",
    "measure": "measure",
    "merge": "merge",
    "optimize": "optimize",
    "orient": "orient",
    "probe": "probe 0.5,0.5,0.5",
    "relax": "relax 3",
    "render": "render view.png",
    "section": "section z=50%",
    "separate": "separate",
    "simplify": "simplify 50%",
    "simplify by error": "simplify --max_error 1%",
    "split": "split midpoint",
    "textures": "textures 64",
    "thicken": "thicken 0.01",
    "tile": "tile 50%",
    "transform": "transform --scale 2",
    "triangulate": "triangulate",
    "two-sided": "two-sided",
    "validate": "validate --faces.min 1",
    "write": "write out.glb",
    "write ply": "write out.ply",
    "write draco": "write out.glb --draco",
    "write meshopt": "write out.glb --meshopt",
    "report json": "--report run.json",
    "report html": "--report run.html",
}

CUBE = ([(x, y, z) for z in (0, 1) for y in (0, 1) for x in (0, 1)],
        [(0, 2, 1), (1, 2, 3), (4, 5, 6), (5, 7, 6), (0, 1, 4), (1, 5, 4), (2, 6, 3), (3, 6, 7), (0, 4, 2), (2, 4, 6),
         (1, 3, 5), (3, 7, 5)])


def icosphere(levels):
    """Vertices and triangles of a sphere of 20 * 4^levels triangles."""
    g = (1 + 5**0.5) / 2
    points = [(-1, g, 0), (1, g, 0), (-1, -g, 0), (1, -g, 0), (0, -1, g), (0, 1, g), (0, -1, -g), (0, 1, -g), (g, 0, -1),
              (g, 0, 1), (-g, 0, -1), (-g, 0, 1)]
    faces = [(0, 11, 5), (0, 5, 1), (0, 1, 7), (0, 7, 10), (0, 10, 11), (1, 5, 9), (5, 11, 4), (11, 10, 2), (10, 7, 6),
             (7, 1, 8), (3, 9, 4), (3, 4, 2), (3, 2, 6), (3, 6, 8), (3, 8, 9), (4, 9, 5), (2, 4, 11), (6, 2, 10), (8, 6, 7),
             (9, 8, 1)]
    for _ in range(levels):
        middles = {}

        def middle(a, b):
            key = min(a, b), max(a, b)
            if key not in middles:
                middles[key] = len(points)
                points.append(tuple((p + q) / 2 for p, q in zip(points[a], points[b])))
            return middles[key]

        faces = [t for a, b, c in faces for ab, bc, ca in [(middle(a, b), middle(b, c), middle(c, a))]
                 for t in ((a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca))]
    return points, faces


def scene(path, meshes, nodes):
    """A GLB of these meshes; a node is a mesh's number and where it stands."""
    binary, views, accessors, parts = bytearray(), [], [], []
    for points, faces in meshes:
        for data, kind, name, count, extra in (
                (b"".join(struct.pack("<3f", *p) for p in points), 5126, "VEC3", len(points),
                 {"min": [min(p[i] for p in points) for i in range(3)], "max": [max(p[i] for p in points) for i in range(3)]}),
                (b"".join(struct.pack("<3I", *f) for f in faces), 5125, "SCALAR", 3 * len(faces), {})):
            views.append({"buffer": 0, "byteOffset": len(binary), "byteLength": len(data)})
            accessors.append({"bufferView": len(views) - 1, "componentType": kind, "count": count, "type": name, **extra})
            binary += data
        parts.append({"primitives": [{"attributes": {"POSITION": len(accessors) - 2}, "indices": len(accessors) - 1}]})
    text = json.dumps({
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": list(range(len(nodes)))}],
        "nodes": [{"name": f"part{i}", "mesh": m, "translation": at} for i, (m, at) in enumerate(nodes)], "meshes": parts,
        "accessors": accessors, "bufferViews": views, "buffers": [{"byteLength": len(binary)}]}).encode()
    text += b" " * (-len(text) % 4)
    binary += bytes(-len(binary) % 4)
    path.write_bytes(struct.pack("<4sII", b"glTF", 2, 28 + len(text) + len(binary)) +
                     struct.pack("<I4s", len(text), b"JSON") + text + struct.pack("<I4s", len(binary), b"BIN\0") + binary)
    return path


def cubes(path, count):
    """Every cube a mesh of its own points, in a square of rows, apart from the others."""
    row = max(1, round(count**0.5))
    points, faces = CUBE
    return scene(path, [([(x + 1.5 * (i % row), y + 1.5 * (i // row), z) for x, y, z in points], faces) for i in range(count)],
                 [(i, [0, 0, 0]) for i in range(count)])


def instances(path, count):
    return scene(path, [icosphere(5)], [(0, [8 * i, 0, 0]) for i in range(count)])


def spent():
    """Processor time of all finished runs so far."""
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime


def seconds(mill, file, stage, folder, repeat):
    """Processor time of a whole run, the smallest of several; or why there is none."""
    load = ["load", str(file)]
    words = [*stage.split(), *load] if stage.startswith("--") else [*load, "!", *stage.split()] if stage else load
    command = [mill, "pipe", *words]
    least = None
    for _ in range(repeat):
        start = spent()
        try:
            done = subprocess.run(list(map(str, command)), cwd=folder, capture_output=True, text=True, timeout=300)
        except subprocess.TimeoutExpired:
            return "over 300 s"
        if done.returncode not in (0, 1):
            return done.stderr.strip().splitlines()[0][:80]
        took = spent() - start
        least = took if least is None else min(least, took)
    return least


def compared(mill, files, line, folder, repeat, loading):
    """Of each scene what the stage adds to loading; or the first reason why there is none."""
    whole = [seconds(mill, f, line, folder, repeat) for f in files]
    if reason := next((x for x in whole if isinstance(x, str)), None):
        return [reason]
    return [w - l for w, l in zip(whole, loading)]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("stages", nargs="*")
    parser.add_argument("--mill", default=ROOT / "build/release/facetmill", type=lambda path: pathlib.Path(path).resolve())
    parser.add_argument("--parts", type=int, default=10000)
    parser.add_argument("--instances", type=int, default=100)
    parser.add_argument("--repeat", type=int, default=2)
    options = parser.parse_args()
    os.environ["FACETMILL_CACHE"] = "off"  # for the runs below
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        files = [cubes(folder / "tenth.glb", options.parts // 10), cubes(folder / "parts.glb", options.parts),
                 instances(folder / "instances.glb", options.instances), instances(folder / "one.glb", 1)]
        loading = [seconds(options.mill, f, "", folder, options.repeat) for f in files]
        if reason := next((x for x in loading if isinstance(x, str)), None):
            raise SystemExit(reason)
        print(f"| stage | {options.parts} parts, CPU s | us a part | us a part of {options.parts // 10} | "
              f"{options.instances} instances, CPU s | of one |")
        print("|---|---|---|---|---|---|")
        for stage, line in STAGES.items():
            if options.stages and stage not in options.stages:
                continue
            took = loading if not line else compared(options.mill, files, line, folder, options.repeat, loading)
            if len(took) == 1:
                print(f"| `{stage}` | {took[0]} | | | | |", flush=True)
                continue
            tenth, whole, shared, one = took
            print(f"| `{stage}` | {whole:.3f} | {whole / options.parts * 1e6:.1f} | {tenth / options.parts * 1e7:.1f} | "
                  f"{shared:.3f} | {one:.3f} |", flush=True)


if __name__ == "__main__":
    main()
