#!/usr/bin/env python3
"""What `clean` promises, over generated meshes that are wrong in every way (those of repair.py).

clean_laws.py [--count 1000] [--first 3001] [--build build/release]

Each mesh is cleaned under several options, and the result is cleaned again. What must hold: the second time changes
nothing, to the byte; edges without exactly one face each way, counted here by exact places, do not become longer; no more
faces that are degenerate, doubled or intersect others, as `validate` counts them; where a face that intersects was divided, so
that more pairs do, no longer lines along which they do. What intersects is not compared where
near vertices were moved together, or where a hole was filled by faces that a union was to resolve and could not. Prints
what does not hold, with the seed, and how many results have no such edge or face. Run it by an interpreter that has numpy
and trimesh.
"""
import argparse
import collections
import json
import os
import pathlib
import subprocess
import sys
import tempfile
from fractions import Fraction

import numpy as np
import trimesh

import repair

OPTIONS = {
    "default": {},
    "stitch": {"weld": "near", "stitch": "near", "t_junctions": "near", "tolerance": "0.1%"},
    "holes": {"holes": {"method": "minimal"}},
    "solid": {"self_intersections": "all", "holes": {"method": "planar"}, "open_components": True,
              "inner_components": True, "precision": "single"},
}
COUNTED = ["degenerate_faces", "duplicate_faces", "self_intersections"]
DIVIDED = []  # results in which more pairs intersect, along lines that are not longer


def wrong_length(path):
    """How long all edges are, by the exact places of their ends, that do not have one face each way; of faces with three
    places. (Not how many: an edge that is wrong may get a vertex that lies on it.)"""
    mesh = trimesh.load_mesh(path, process=False)
    if len(mesh.faces) == 0:
        return 0
    places, place = np.unique(np.asarray(mesh.vertices) + 0.0, axis=0, return_inverse=True)
    faces = place.reshape(-1)[mesh.faces]
    faces = faces[(faces[:, 0] != faces[:, 1]) & (faces[:, 1] != faces[:, 2]) & (faces[:, 2] != faces[:, 0])]
    ways = collections.Counter((int(a), int(b)) for k in range(3) for a, b in faces[:, [k, (k + 1) % 3]])
    return sum(np.linalg.norm(places[a] - places[b]) for a, b in {tuple(sorted(way)) for way in ways}
               if ways[a, b] != 1 or ways[b, a] != 1)


def exact_volume(a, b, c, d):
    a, b, c, d = ([Fraction(float(x)) for x in p] for p in (a, b, c, d))
    (ux, uy, uz), (vx, vy, vz), (wx, wy, wz) = ([x - y for x, y in zip(p, a)] for p in (b, c, d))
    return float(ux * (vy * wz - vz * wy) + uy * (vz * wx - vx * wz) + uz * (vx * wy - vy * wx))


def volumes(a, b, c, d):
    """Of each row, six times: the signs say on which side of a, b, c the point d lies. Rational where rounding could
    have made the sign: 1e-13 of the largest coordinate cubed is many times what it can amount to."""
    u, v, w = b - a, c - a, d - a
    found = np.einsum("ij,ij->i", np.cross(u, v), w)
    largest = np.abs(np.array([a, b, c, d])).max((0, 2))
    for i in np.nonzero(np.abs(found) <= 1e-13 * largest**3)[0]:
        found[i] = exact_volume(a[i], b[i], c[i], d[i])
    return found


def crossing_length(path):
    """How long all lines are along which two triangles pass through each other. (Not how many pairs: of a face that
    intersects others and gets a vertex on its edge both pieces may.)"""
    mesh = trimesh.load_mesh(path, process=False)
    corners = np.asarray(mesh.vertices, dtype=float)[np.asarray(mesh.faces)] + 0.0
    if len(corners) == 0:
        return 0
    low, high = corners.min(1), corners.max(1)
    first, second = np.nonzero(np.triu((low[:, None] <= high[None]).all(2) & (low[None] <= high[:, None]).all(2), 1))
    pairs = corners[first], corners[second]
    points = []  # [pairs, 3] or NaN, for each edge of either triangle
    for one, other in (pairs, pairs[::-1]):
        t = [other[:, k] for k in range(3)]
        for k in range(3):
            p, q = one[:, k], one[:, (k + 1) % 3]
            from_p, from_q = volumes(*t, p), volumes(*t, q)
            sides = np.array([np.sign(volumes(p, q, t[i], t[(i + 1) % 3])) for i in range(3)])
            apart = np.array([(end != corner).any(1) for end in (p, q) for corner in t]).all(0)
            meets = (from_p * from_q < 0) & apart & ((sides >= 0).all(0) | (sides <= 0).all(0))
            points.append(np.full_like(p, np.nan))
            at = from_p[meets] / (from_p[meets] - from_q[meets])
            points[-1][meets] = p[meets] + at[:, None] * (q[meets] - p[meets])
    for k in range(3):  # a corner that both have ends the line, where there is one
        shared = np.array([(pairs[0][:, k] == pairs[1][:, i]).all(1) for i in range(3)]).any(0)
        points.append(np.where(shared[:, None], pairs[0][:, k], np.nan))
    points = np.array(points)
    some = ~np.isnan(points[:6, :, 0]).all(0)
    points = points[:, some]
    if points.shape[1] == 0:
        return 0
    return np.nanmax(np.linalg.norm(points[:, None] - points[None], axis=3), axis=(0, 1)).sum()


def pipeline(options):
    counts = {"validate": {name: {"min": 0} for name in COUNTED}}
    return {"facetmill": 1, "report": ["r.json"], "allow": ["W-CLEAN", "W-UNITS", "W-SURFACE-LOST", "W-FANS"], "stages": [
        {"load": {"path": "a.ply", "weld": "exact"}}, counts, {"clean": options}, counts, {"write": {"path": "b.ply", "precision": "full"}},
        {"clean": options}, {"write": {"path": "c.ply", "precision": "full"}}]}  # not rounded: what was counted


def judged(program, folder, options):
    """What does not hold, and whether the result is sound."""
    (folder / "p.yaml").write_text(json.dumps(pipeline(options)))
    run = subprocess.run([program, "run", "p.yaml", "-q", "-j", "1"], cwd=folder, capture_output=True, text=True,
                         timeout=repair.LIMIT)
    if run.returncode != 0:
        if "E-EMPTY" in run.stderr:
            return [], False  # nothing is left: no solid was there
        return [f"exit code {run.returncode}: {run.stderr[:300]}"], False
    report = json.loads((folder / "r.json").read_text())
    before, after = ({check["name"]: check["found"] for check in report["checks"] if check["stage"] == name}
                     for name in ("validate", "validate-2"))
    filled = sum(part["filled_holes"] for stage in report["stages"] if stage["name"] == "clean"
                 for part in stage["result"]["parts"])
    may_intersect = "near" in options.values() or (filled and "self_intersections" in options)
    problems = [f"{name}: {before[name]} became {after[name]}" for name in COUNTED[:2] if after[name] > before[name]]
    if after["self_intersections"] > before["self_intersections"] and not may_intersect:
        long_before, long_after = crossing_length(folder / "a.ply"), crossing_length(folder / "b.ply")
        if long_after > long_before + 1e-6 or long_before == long_after == 0:
            problems.append(f"self_intersections: {before['self_intersections']} became {after['self_intersections']}, "
                            f"a length of {long_before:.6g} became {long_after:.6g}")
        else:
            DIVIDED.append(folder)
    wrong_before, wrong_after = wrong_length(folder / "a.ply"), wrong_length(folder / "b.ply")
    if wrong_after > wrong_before + 1e-6:
        problems.append(f"wrong edges: a length of {wrong_before:.6g} became {wrong_after:.6g}")
    if (folder / "b.ply").read_bytes() != (folder / "c.ply").read_bytes():
        problems.append("cleaning again changes it")
    return problems, wrong_after == 0 and not any(after.values())


def main():
    ask = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    ask.add_argument("--count", type=int, default=1000)
    ask.add_argument("--first", type=int, default=3001)
    ask.add_argument("--build", type=pathlib.Path, default=repair.ROOT / "build/release")
    given = ask.parse_args()
    program = given.build.resolve() / "facetmill"
    sound, findings = collections.Counter(), 0
    for seed in range(given.first, given.first + given.count):
        vertices, faces, _ = repair.generated(seed)
        with tempfile.TemporaryDirectory() as folder:
            folder = pathlib.Path(folder)
            trimesh.Trimesh(vertices, faces, process=False).export(folder / "a.ply")
            for name, options in OPTIONS.items():
                problems, good = judged(program, folder, options)
                sound[name] += good
                findings += bool(problems)
                for problem in problems:
                    print(f"seed {seed}, {name}: {problem}", flush=True)
    print(f"{given.count} meshes: {findings} findings; without a wrong edge or face: "
          + ", ".join(f"{name} {sound[name]}" for name in OPTIONS)
          + f"; {len(DIVIDED)} with more pairs that intersect, but no longer lines along which they do")
    return findings > 0


if __name__ == "__main__":
    os.environ["FACETMILL_CACHE"] = "off"
    sys.exit(main())
