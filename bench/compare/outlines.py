#!/usr/bin/env python3
"""outlines.py [--corners N]: crop by outlines of many corners, through both sides of a sphere.

Coast is ragged at all scales, smooth a rosette, zigzag all teeth, needles the same with teeth 40 times as long. Whole
runs (load, crop, write), on spheres of 81,920 and of 1.3 million faces: processor seconds with one thread and wall
seconds with all, the least of several runs; --other is a second build to compare with, in turn, whose output must have
the same bytes.
"""
import argparse
import hashlib
import math
import pathlib
import random
import tempfile
import time

from peers import add_common_options, output
from combine import spent


def coast():
    at = random.Random(5)
    waves = [(2**k, 0.12 * 2 ** (-0.9 * k), at.random() * 2 * math.pi) for k in range(17)]
    return lambda i, a: 0.6 + sum(height * math.sin(f * a + phase) for f, height, phase in waves)


OUTLINES = {
    "coast": coast(),
    "smooth": lambda i, a: 0.55 + 0.35 * math.sin(40 * a),
    "zigzag": lambda i, a: 0.6 + 0.0005 * (i % 2),
    "needles": lambda i, a: 0.6 + 0.02 * (i % 2),
}


def write_outline(path, radius, corners):
    angles = [2 * math.pi * i / corners for i in range(corners)]
    points = [(radius(i, a) * math.cos(a), radius(i, a) * math.sin(a)) for i, a in enumerate(angles)]
    path.write_text("POLYGON ((" + ", ".join(f"{x!r} {y!r}" for x, y in points + points[:1]) + "))")


def run(mill, words, made, threads):
    """Processor and wall seconds, and the digest of the output."""
    cpu, wall = spent(), time.perf_counter()
    output([mill, "pipe", "--quiet", *threads, *words, "!", "write", made, "--precision", "full"])
    return spent() - cpu, time.perf_counter() - wall, hashlib.sha256(made.read_bytes()).hexdigest()


def main():
    ask = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    ask.add_argument("outlines", nargs="*", help="of: " + ", ".join(OUTLINES))
    ask.add_argument("--corners", type=int, default=100_000)
    ask.add_argument("--other", type=pathlib.Path)
    add_common_options(ask, repeat=3)
    args = ask.parse_args()
    builds = [args.build, *([args.other] if args.other else [])]
    print("| outline | faces | faces after |" + "".join(f" {b}: CPU s | wall s |" for b in builds))
    print("|---|---|---|" + "---|---|" * len(builds))
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        made = folder / "made.ply"
        for level in (6, 8):
            mesh = folder / f"{level}.ply"
            output([args.build / "facetmill", "pipe", "--quiet", "generate", "icosphere", "--subdivisions", level, "!", "write", mesh])
            for outline in args.outlines or OUTLINES:
                footprint = folder / f"{outline}.wkt"
                write_outline(footprint, OUTLINES[outline], args.corners)
                words = ["load", mesh, "!", "crop", footprint, "--axis", "z"]
                least = [[float("inf"), float("inf")] for _ in builds]
                digests = set()
                for _ in range(args.repeat):
                    for build, best in zip(builds, least):
                        for place, threads in enumerate((["-j", "1"], [])):
                            *took, digest = run(build / "facetmill", words, made, threads)
                            best[place] = min(best[place], took[place])
                            digests.add(digest)
                if len(digests) != 1:
                    raise SystemExit(f"{outline}: the outputs differ")
                faces = made.read_bytes().split(b"element face ")[1].split(b"\n")[0].decode()
                print(f"| {outline} | {20 * 4**level:,} | {int(faces):,} |" +
                      "".join(f" {cpu:.2f} | {wall:.2f} |" for cpu, wall in least), flush=True)


if __name__ == "__main__":
    main()
