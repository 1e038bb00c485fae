#!/usr/bin/env python3
"""many_parts.py [--parts N] [--instances N] [--repeat N] [STAGE...]: what a part costs each stage.

Runs every stage on a scene of N parts of twelve triangles, on a tenth of it, and on nodes that share one mesh of 20,480
triangles. From the report: the seconds of the stage alone, the microseconds per part, and how the time grows from a tenth
to the whole (10: linear, 100: quadratic). The smallest of several runs.
"""
import argparse
import json
import pathlib
import struct
import subprocess
import tempfile

from peers import ROOT

# Every stage as it is usually asked; ensure and validate judge, generate and load are there for all.
STAGES = {
    "clean": "clean",
    "clip": "clip z=50% --cap",
    "crop": "crop [[0.1,0.1],[90.3,0.2],[90.3,90.3],[0.2,90.1]] --axis z",
    "crumple": "crumple 1%",
    "ensure": "ensure --faces.min 1",
    "load": "",
    "measure": "measure",
    "merge": "merge",
    "orient": "orient",
    "probe": "probe 0.5,0.5,0.5",
    "relax": "relax 3",
    "render": "render view.png",
    "section": "section z=50%",
    "separate": "separate",
    "simplify": "simplify 50%",
    "split": "split midpoint",
    "thicken": "thicken 0.01",
    "tile": "tile 50%",
    "transform": "transform --scale 2",
    "triangulate": "triangulate",
    "two-sided": "two-sided",
    "validate": "validate --faces.min 1",
    "write": "write out.glb",
    "write ply": "write out.ply",
    "write draco": "write out.glb --draco",
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
    binary, views, accessors, parts = b"", [], [], []
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
    """Every cube a mesh of its own, in a square of rows, apart from the others."""
    row = max(1, round(count**0.5))
    return scene(path, [CUBE] * count, [(i, [1.5 * (i % row), 1.5 * (i // row), 0]) for i in range(count)])


def instances(path, count):
    return scene(path, [icosphere(5)], [(0, [8 * i, 0, 0]) for i in range(count)])


def seconds(mill, file, stage, folder, repeat):
    """Of the last stage alone, the smallest of several runs; or why there is none."""
    command = [mill, "pipe", "--report", "run.json", "load", str(file)] + (["!"] + stage.split() if stage else [])
    least = None
    for _ in range(repeat):
        try:
            done = subprocess.run(list(map(str, command)), cwd=folder, capture_output=True, text=True, timeout=300)
        except subprocess.TimeoutExpired:
            return "over 300 s"
        if done.returncode not in (0, 1):
            return done.stderr.strip().splitlines()[0][:80]
        run = json.loads((folder / "run.json").read_text())["run"]
        spent = run["stages"][-1]["seconds"]
        least = spent if least is None else min(least, spent)
    return least


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("stages", nargs="*")
    parser.add_argument("--mill", default=ROOT / "build/release/facetmill")
    parser.add_argument("--parts", type=int, default=10000)
    parser.add_argument("--instances", type=int, default=100)
    parser.add_argument("--repeat", type=int, default=2)
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        files = [cubes(folder / "tenth.glb", options.parts // 10), cubes(folder / "parts.glb", options.parts),
                 instances(folder / "instances.glb", options.instances), instances(folder / "one.glb", 1)]
        print(f"| stage | {options.parts} parts, s | us a part | growth | {options.instances} instances, s | of one |")
        print("|---|---|---|---|---|---|")
        for stage, line in STAGES.items():
            if options.stages and stage not in options.stages:
                continue
            tenth, whole, shared, one = (seconds(options.mill, f, line, folder, options.repeat) for f in files)
            failed = next((x for x in (tenth, whole, shared, one) if isinstance(x, str)), None)
            if failed:
                print(f"| `{stage}` | {failed} | | | | |", flush=True)
                continue
            print(f"| `{stage}` | {whole:.3f} | {whole / options.parts * 1e6:.1f} | {whole / max(tenth, 1e-6):.1f} | "
                  f"{shared:.3f} | {shared / max(one, 1e-6):.1f} |", flush=True)


if __name__ == "__main__":
    main()
