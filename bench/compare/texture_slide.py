#!/usr/bin/env python3
"""texture_slide.py MESH...: how far textures slide under simplify, with weights and without.

Points are spread over each result; at each the texture coordinate is compared with that of the nearest point of the
mesh that came in. The difference, times what a unit of texture is long on the surface, is the slide, in percent of
the diagonal, beside the deviation. Points whose nearest place is on another island of the texture differ by anything;
those above 2 % are left out of the root mean square, and their share is told. Needs numpy, scipy, trimesh and rtree.
"""
import argparse
import json
import pathlib
import subprocess
import tempfile

import numpy
import trimesh

ROOT = pathlib.Path(__file__).resolve().parents[2]


def loaded(path):
    mesh = trimesh.load(path, process=False, force="mesh")
    return mesh, numpy.asarray(mesh.visual.uv)


def interpolated(mesh, values, faces, points):
    weights = trimesh.triangles.points_to_barycentric(mesh.triangles[faces], points)
    return (values[mesh.faces[faces]] * weights[:, :, None]).sum(axis=1)


def slide(before, uv_before, after, uv_after, count):
    points, faces = trimesh.sample.sample_surface(after, count, seed=1)
    nearest, _, there = trimesh.proximity.closest_point(before, points)
    off = interpolated(after, uv_after, faces, points) - interpolated(before, uv_before, there, nearest)
    texture = uv_before[before.faces]
    u, v = texture[:, 1] - texture[:, 0], texture[:, 2] - texture[:, 0]
    unit = numpy.sqrt(before.area / (numpy.abs(u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0]).sum() / 2))
    length = numpy.linalg.norm(off, axis=1) * unit / before.scale * 100
    same = length < 2
    return numpy.sqrt((length[same] ** 2).mean()), numpy.percentile(length[same], 99), 1 - same.mean()


def main():
    ask = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    ask.add_argument("meshes", nargs="+")
    ask.add_argument("--build", default=ROOT / "build/release", type=pathlib.Path)
    ask.add_argument("--ratios", default="25%,10%,5%")
    ask.add_argument("--weights", default="0,0.5,1", help="of uv; the other weights are 0")
    ask.add_argument("--samples", default=20000, type=int)
    args = ask.parse_args()
    print("| mesh | to | uv weight | slide RMS % | 99th percentile % | other island | deviation RMS % | max % |")
    print("|---|---|---|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as folder:
        for path in args.meshes:
            before, uv = loaded(path)
            for ratio in args.ratios.split(","):
                for weight in args.weights.split(","):
                    out, report = f"{folder}/out.obj", f"{folder}/report.json"
                    subprocess.run([args.build / "facetmill", "pipe", "--no-cache", "--quiet", "--report", report,
                                    "load", path, "!",
                                    "simplify", ratio, "--weights.uv", weight, "--weights.normal", "0",
                                    "--weights.colour", "0", "--weights.skin", "0", "!", "write", out], check=True)
                    done = json.load(open(report))["stages"][1]["result"]["parts"][0]["deviation"]["percent"]
                    rms, most, other = slide(before, uv, *loaded(out), args.samples)
                    print(f"| {pathlib.Path(path).stem} | {ratio} | {weight} | {rms:.4f} | {most:.4f} | {other:.1%} | "
                          f"{done['rms']:.5f} | {done['maximum']:.4f} |", flush=True)


if __name__ == "__main__":
    main()
