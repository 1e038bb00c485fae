#!/usr/bin/env python3
"""solids.py [SCENE ...] --python INTERPRETER: many solids united or taken away at once, beside manifold3d.

Cubes that overlap, as they stand, turned and in a grid; spheres; a plate less drills, also where corners of the holes lie
on the diagonal of its faces to a bit. Processor seconds of whole runs of facetmill with one thread, loading included; of
manifold3d those of making its solids and of the operation on them all. Triangles of the results, and by how much the volumes differ.
"""
import argparse
import json
import math
import pathlib
import random
import struct
import sys
import tempfile

from combine import spent
from many_parts import icosphere
from peers import TIMED, add_common_options, output

MANIFOLD = TIMED + """
import manifold3d, numpy
def solids_of(path):
    raw = open(path, "rb").read(); at = 0
    while at < len(raw):
        v, f = (int(n) for n in numpy.frombuffer(raw, "<i4", 2, at)); at += 8
        points = numpy.frombuffer(raw, "<f8", 3 * v, at).reshape(-1, 3); at += 24 * v
        faces = numpy.frombuffer(raw, "<i4", 3 * f, at).reshape(-1, 3); at += 12 * f
        yield manifold3d.Mesh64(numpy.array(points), numpy.array(faces, "u8"))
meshes = list(solids_of(sys.argv[1]))
def work():
    solids = [manifold3d.Manifold(m) for m in meshes]
    if sys.argv[2] == "union": made = manifold3d.Manifold.batch_boolean(solids, manifold3d.OpType.Add)
    else: made = manifold3d.Manifold.batch_boolean(solids, manifold3d.OpType.Subtract)
    made.num_tri()
    return made
made, wall, cpu = measured(work)
print(json.dumps({"cpu": cpu, "faces": made.num_tri(), "volume": made.volume()}))
"""

CORNERS = [(x, y, z) for z in (0, 1) for y in (0, 1) for x in (0, 1)]
SIDES = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]


def box(low, high):
    points = [tuple(high[k] if c[k] else low[k] for k in range(3)) for c in CORNERS]
    return points, [t for a, b, c, d in SIDES for t in ((a, b, c), (a, c, d))]


def turned(solid, at):
    """By a rotation drawn evenly of all, about the middle of the points."""
    q = [at.gauss(0, 1) for _ in range(4)]
    length = math.sqrt(sum(x * x for x in q))
    w, x, y, z = (c / length for c in q)
    rows = ((1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)),
            (2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)),
            (2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)))
    points, faces = solid
    middle = [sum(p[k] for p in points) / len(points) for k in range(3)]
    return [tuple(middle[i] + sum(rows[i][k] * (p[k] - middle[k]) for k in range(3)) for i in range(3)) for p in points], faces


def sphere(centre, radius, unit=icosphere(2)):
    points, faces = unit
    shares = [radius / math.hypot(*p) for p in points]
    return [tuple(c + share * x for c, x in zip(centre, p)) for p, share in zip(points, shares)], faces


def drill(x, y, radius, sides, low, high):
    angles = [2 * math.pi * k / sides for k in range(sides)]
    ring = [(x + radius * math.cos(a), y + radius * math.sin(a)) for a in angles]
    points = [(*p, low) for p in ring] + [(*p, high) for p in ring]
    faces = [t for k in range(sides) for n in [(k + 1) % sides]
             for t in ((k, n, n + sides), (k, n + sides, k + sides))]
    faces += [(0, k + 1, k) for k in range(1, sides - 1)] + [(sides, sides + k, sides + k + 1) for k in range(1, sides - 1)]
    return points, faces


def cubes(count, side, within, turn=False):
    at = random.Random(7)
    made = []
    for _ in range(count):
        low = [at.uniform(0, within - side) for _ in range(3)]
        made.append(box(low, [x + side for x in low]))
    return [turned(solid, at) for solid in made] if turn else made


def spheres():
    at = random.Random(7)
    return [sphere([at.uniform(0, 7) for _ in range(3)], 0.6) for _ in range(1000)]


def grid():
    return [box((x, y, z), (x + 1.1, y + 1.1, z + 1.1)) for x in range(22) for y in range(22) for z in range(22)]


def plate(shift):
    """A plate of 20 by 20, and a hundred drills; shift: of their centres from the diagonals, along x."""
    return [box((0, 0, 0), (20, 20, 2))] + [drill(2 * x + 1 + shift, 2 * y + 1, 0.75, 64, -1, 3) for x in range(10) for y in range(10)]


SCENES = {
    "cubes": ("union", lambda: cubes(1000, 1, 8)),
    "turned": ("union", lambda: cubes(1000, 1, 8, True)),
    "large": ("union", lambda: cubes(200, 1.5, 6, True)),
    "spheres": ("union", spheres),
    "grid": ("union", grid),
    "plate": ("difference", lambda: plate(0.0123)),
    "diagonal": ("difference", lambda: plate(0)),
}


def write_ply(path, solids):
    points = [p for solid in solids for p in solid[0]]
    faces, first = [], 0
    for own, triangles in solids:
        faces += [tuple(first + i for i in t) for t in triangles]
        first += len(own)
    head = (f"ply\nformat binary_little_endian 1.0\nelement vertex {len(points)}\nproperty double x\nproperty double y\n"
            f"property double z\nelement face {len(faces)}\nproperty list uchar int vertex_indices\nend_header\n")
    path.write_bytes(head.encode() + b"".join(struct.pack("<3d", *p) for p in points) +
                     b"".join(struct.pack("<B3i", 3, *t) for t in faces))


def write_for_peer(path, solids):
    path.write_bytes(b"".join(struct.pack("<2i", len(p), len(f)) + b"".join(struct.pack("<3d", *x) for x in p) +
                              b"".join(struct.pack("<3i", *t) for t in f) for p, f in solids))


def ours(mill, operation, folder):
    words = ["load", folder / "a.ply", *(["!", "load", folder / "b.ply"] if operation == "difference" else []), "!", "combine",
             operation, *(["--with", "b"] if operation == "difference" else [])]
    before = spent()
    output([mill, "pipe", "--quiet", "-j", "1", *words])
    cpu = spent() - before
    output([mill, "pipe", "--quiet", *words, "!", "write", folder / "made.ply", "--precision", "full"])
    told = json.loads(output([mill, "info", "--json", folder / "made.ply"]))
    return {"cpu": cpu, "faces": told["faces"], "volume": told["volume"]}


def main():
    ask = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    ask.add_argument("scenes", nargs="*", help="of: " + ", ".join(SCENES))
    add_common_options(ask, repeat=3)
    args = ask.parse_args()
    print("| scene | facetmill, CPU s | manifold3d, CPU s | ratio | triangles | manifold3d's | volumes differ by |")
    print("|---|---|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        for scene in args.scenes or SCENES:
            operation, make = SCENES[scene]
            solids = make()
            write_ply(folder / "a.ply", solids if operation == "union" else solids[:1])
            write_ply(folder / "b.ply", solids[1:])
            write_for_peer(folder / "all", solids)
            runs = [(ours(args.build / "facetmill", operation, folder),
                     json.loads(output([args.python, "-c", MANIFOLD, folder / "all", operation]))) for _ in range(args.repeat)]
            own, peer = (min(run[i]["cpu"] for run in runs) for i in (0, 1))
            (a, b), *_ = runs
            print(f"| {scene} | {own:.2f} | {peer:.2f} | {own / peer:.1f} | {a['faces']:,} | {b['faces']:,} | "
                  f"{abs(a['volume'] - b['volume']) / abs(b['volume']):.0e} |", flush=True)


if __name__ == "__main__":
    sys.exit(main())
