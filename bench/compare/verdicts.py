#!/usr/bin/env python3
"""What facetmill, trimesh, pymeshlab and CGAL say of the same meshes, and where they disagree.

verdicts.py FACETMILL [--cgal CGAL_VERDICTS] [--generated FIRST COUNT] FILE_OR_FOLDER...

CGAL_VERDICTS is the program built from cgal_verdicts.cpp; without it CGAL is not asked. --generated takes the broken
meshes of repair.py of these seeds, too.

Every file is brought to triangles in one part by facetmill and written as OFF, so that all judge the same vertices
and faces; what is compared is told by `compare`. Needs numpy, trimesh, pymeshlab. Prints a line for each file, with the
disagreements; those that `explained` knows are named by their reason. Exit code 1 when one is left unexplained.
"""
import argparse
import collections
import itertools
import json
import pathlib
import re
import subprocess
import sys
import tempfile
from fractions import Fraction

import numpy as np
import pymeshlab
import trimesh

import repair

LIMIT = 400000  # faces; larger files take the peers too long


def run(command):
    return subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)


def info(facetmill, path):
    done = run([facetmill, "info", "--json", "--self-intersections", path])
    return json.loads(done.stdout) if done.returncode == 0 else None


def by_trimesh(path):
    mesh = trimesh.load(path, process=False, file_type="off")
    faces = mesh.faces[(mesh.faces[:, 0] != mesh.faces[:, 1]) & (mesh.faces[:, 1] != mesh.faces[:, 2]) &
                       (mesh.faces[:, 0] != mesh.faces[:, 2])]
    bare = trimesh.Trimesh(mesh.vertices, faces, process=False)
    return {"closed": bool(bare.is_watertight), "oriented": bool(bare.is_winding_consistent),
            "euler": int(bare.euler_number), "area": float(bare.area), "volume": float(bare.volume),
            "repeating": len(mesh.faces) - len(faces)}


def by_pymeshlab(path):
    meshes = pymeshlab.MeshSet(verbose=False)
    meshes.load_new_mesh(path)
    m = meshes.get_topological_measures()
    try:
        meshes.compute_selection_by_self_intersections_per_face()
        selected = np.nonzero(meshes.current_mesh().face_selection_array())[0]
    except pymeshlab.PyMeshLabException:  # it refuses meshes whose faces have no area
        selected = None
    return {"boundary_edges": m["boundary_edges"], "components": m["connected_components_number"],
            "edge_manifold": m["non_two_manifold_edges"] == 0, "vertex_manifold": m["non_two_manifold_vertices"] == 0,
            "isolated_vertices": m["unreferenced_vertices"], "edges": m["edges_number"],
            "genus": m["genus"] if m["genus"] >= 0 else None,
            "crossing": None if selected is None else len(selected) > 0, "selected": selected}


def by_cgal(program, path):
    """What CGAL says of a mesh that it takes for one: every edge of at most two faces that agree, every vertex of one
    fan, no face that repeats a vertex. Of others only which faces meet, after it took them apart at the edges and
    vertices where they are no mesh; nothing more when a face repeats a vertex."""
    return json.loads(run([program, path]).stdout)


def is_outward(facetmill, path):
    return run([facetmill, "pipe", "--quiet", "load", path, "!", "validate", "--outward_oriented"]).returncode == 0


def compare_cgal(ours, cgal, facetmill, off):
    """Triples (name, ours, CGAL's) that differ."""
    mesh = ours["edge_manifold"] and ours["vertex_manifold"] and ours["oriented"]
    found = [("CGAL: mesh", mesh, cgal["mesh"])]
    if "pairs" in cgal:
        found.append(("CGAL: self_intersections", ours["self_intersections"] + ours["touching"],
                      cgal["self_intersections"]))
    if cgal["mesh"]:
        found += [("CGAL: " + name, ours[name], cgal[name]) for name in ("closed", "euler")]
        found.append(("CGAL: components", ours["components"], cgal["pieces"]))
        for name in ("area", "volume"):
            a, b = ours[name], cgal.get(name)
            near = a is not None and b is not None and abs(a - b) <= 1e-9 * (abs(b) + ours["area"])
            found.append(("CGAL: " + name, a, a if near else b))
        if "outward" in cgal:
            found.append(("CGAL: outward", is_outward(facetmill, off), cgal["outward"]))
    return [(n, a, b) for n, a, b in found if a != b]


def has_no_area(points, face):
    a, b, c = ([Fraction(x) for x in points[v]] for v in face)
    return all(determinant(minus(b, a), minus(c, a), e) == 0 for e in ((1, 0, 0), (0, 1, 0), (0, 0, 1)))


def explained_cgal(name, ours, cgal, off):
    """Of CGAL's pairs those count not that have a face without area, and those that meet only in vertices or edges they
    share (CGAL doubled them to take apart what is no mesh). The others must be as many as facetmill's."""
    if name != "CGAL: self_intersections":
        return None
    mesh = trimesh.load(off, process=False)
    points, faces = mesh.vertices, [list(f) for f in mesh.faces]
    flat = {f for f in {f for pair in cgal["pairs"] for f in pair} if has_no_area(points, faces[f])}
    rest = [pair for pair in cgal["pairs"] if not flat & set(pair)]
    true = [(f, g) for f, g in rest if pair_meets(points, faces[f], faces[g])[0]]
    apart = [(f, g) for f, g in rest if not set(faces[f]) & set(faces[g]) and (f, g) not in true]
    if len(true) != ours["self_intersections"] + ours["touching"] or apart or (cgal["mesh"] and len(true) != len(rest)):
        return None
    reasons = []
    if len(rest) < len(cgal["pairs"]):
        reasons.append(f"{len(cgal['pairs']) - len(rest)} pairs of CGAL's have one of {len(flat)} faces without area")
    if len(true) < len(rest):
        reasons.append(f"{len(rest) - len(true)} meet only in what they share, where CGAL took them apart")
    return " and ".join(reasons) + "; the others are as many as here, and true in rational numbers"


def compare(ours, tri, lab):
    """Pairs (name, ours, theirs) that differ."""
    pairs = [
        # watertight is: every edge has two faces. Of an edge-manifold mesh that is closed, but for orientation.
        ("closed", ours["closed"], tri["closed"] and tri["oriented"]),
        ("oriented", ours["oriented"], tri["oriented"]),
        ("euler", ours["euler"], tri["euler"]),
        ("area", round(ours["area"], 9), ours["area"] if abs(tri["area"] - ours["area"]) <= 1e-9 * ours["area"] else tri["area"]),
        ("edge_manifold", ours["edge_manifold"], lab["edge_manifold"]),
        ("vertex_manifold", ours["vertex_manifold"], lab["vertex_manifold"]),
        ("boundary_edges", ours["boundary_edges"], lab["boundary_edges"]),
        ("components", ours["components"], lab["components"]),
        ("isolated_vertices", ours["isolated_vertices"], lab["isolated_vertices"]),
        ("genus", ours["genus"], lab["genus"]),
        ("self_intersections", ours["self_intersections"] > 0,
         ours["self_intersections"] > 0 if lab["crossing"] is None else lab["crossing"]),
    ]
    if ours["volume"] is not None:
        near = abs(tri["volume"] - ours["volume"]) <= 1e-9 * (abs(ours["volume"]) + ours["area"])
        pairs.append(("volume", ours["volume"], ours["volume"] if near else tri["volume"]))
    return [(n, a, b) for n, a, b in pairs if a != b and not (n == "area" and abs(a - b) <= 1e-9 * max(1, abs(b)))]


def determinant(a, b, c):
    return (a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) + a[2] * (b[0] * c[1] - b[1] * c[0]))


def minus(a, b):
    return [x - y for x, y in zip(a, b)]


def side(a, b, c, d):
    value = determinant(minus(b, a), minus(c, a), minus(d, a))
    return (value > 0) - (value < 0)


def turn(a, b, c):
    value = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
    return (value > 0) - (value < 0)


def segment_meets_flat(p, q, t):
    """In the plane: a segment and a triangle."""
    turns = [turn(t[i], t[(i + 1) % 3], r) for r in (p, q) for i in range(3)]
    for inside in (turns[:3], turns[3:]):
        if min(inside) >= 0 or max(inside) <= 0:
            return True
    for i in range(3):
        a, b = t[i], t[(i + 1) % 3]
        if turn(p, q, a) * turn(p, q, b) <= 0 and turn(a, b, p) * turn(a, b, q) <= 0:
            if turn(p, q, a) or turn(p, q, b) or any(min(a[k], b[k]) <= max(p[k], q[k]) and min(p[k], q[k]) <= max(a[k], b[k]) for k in (0, 1)):
                return True
    return False


def segment_meets(p, q, t):
    """In rational numbers: a closed segment and a closed triangle with area."""
    sp, sq = side(*t, p), side(*t, q)
    if sp * sq > 0:
        return False
    if sp == sq == 0:
        normal = [determinant(minus(t[1], t[0]), minus(t[2], t[0]), e) for e in ((1, 0, 0), (0, 1, 0), (0, 0, 1))]
        drop = max(range(3), key=lambda k: abs(normal[k]))
        flat = lambda r: [r[k] for k in range(3) if k != drop]
        return segment_meets_flat(flat(p), flat(q), [flat(c) for c in t])
    signs = {side(p, q, t[i], t[(i + 1) % 3]) for i in range(3)}
    return not {-1, 1} <= signs


def pair_meets(points, f, g):
    """Whether two triangles meet elsewhere than in the vertices and edges they share, decided in rational numbers;
    and how many vertices they share."""
    shared = [v for v in f if v in g]
    at = lambda face: [[Fraction(x) for x in points[v]] for v in face]
    a, b = at(f), at(g)
    if len(shared) == 3:
        return True, 3
    if len(shared) == 2:
        u, v = at(shared)
        p, q = at([next(w for w in f if w not in shared)])[0], at([next(w for w in g if w not in shared)])[0]
        if side(u, v, p, q) != 0:
            return False, 2
        along, across = minus(v, u), lambda r: minus(r, u)
        flat = [[x * sum(c * c for c in along) - sum(m * n for m, n in zip(across(r), along)) * y for x, y in zip(across(r), along)] for r in (p, q)]
        return sum(x * y for x, y in zip(*flat)) > 0, 2
    if len(shared) == 1:
        opposite = lambda face: at([v for v in face if v not in shared])
        return segment_meets(*opposite(f), b) or segment_meets(*opposite(g), a), 1
    edges = lambda t: [(t[i], t[(i + 1) % 3]) for i in range(3)]
    return any(segment_meets(p, q, b) for p, q in edges(a)) or any(segment_meets(p, q, a) for p, q in edges(b)), 0


def crosses(points, f, g):
    """Whether an edge of one of two triangles runs through the inside of the other."""
    at = lambda face: [[Fraction(x) for x in points[v]] for v in face]
    a, b = at(f), at(g)
    through = lambda p, q, t: (side(*t, p) * side(*t, q) < 0
                               and {side(p, q, t[i], t[(i + 1) % 3]) for i in range(3)} in ({1}, {-1}))
    edges = lambda t: [(t[i], t[(i + 1) % 3]) for i in range(3)]
    return any(through(p, q, b) for p, q in edges(a)) or any(through(p, q, a) for p, q in edges(b))


def rounding_reason(off, selected):
    """Nothing when one of the faces that MeshLab selects does meet another, elsewhere than in what they share."""
    mesh = trimesh.load(off, process=False)
    low, high = mesh.vertices[mesh.faces].min(1), mesh.vertices[mesh.faces].max(1)
    for f in selected:
        near = np.nonzero(((low <= high[f]) & (low[f] <= high)).all(1))[0]
        if any(pair_meets(mesh.vertices, list(mesh.faces[f]), list(mesh.faces[g]))[0] for g in near if g != f):
            return None
    return "no face that MeshLab selects meets another in rational numbers"


def crowded_reason(off):
    """Nothing when a vertex of several fans is at no edge of more than two faces."""
    faces = [list(map(int, f)) for f in trimesh.load(off, process=False).faces]
    edges = collections.Counter(frozenset((f[i], f[(i + 1) % 3])) for f in faces for i in range(3))
    crowded = {v for edge, count in edges.items() if count > 2 for v in edge}
    around = collections.defaultdict(list)  # of each vertex not at such an edge, the edges across from it
    for f in faces:
        for v in set(f) - crowded:
            around[v].append(set(f) - {v})
    for fan in around.values():
        reached, rest = set(fan[0]), fan[1:]
        while any(reached & ends for ends in rest):
            reached |= set().union(*(ends for ends in rest if reached & ends))
            rest = [ends for ends in rest if not reached >= ends]
        if rest:
            return None
    return "MeshLab does not look at vertices on edges of more than two faces"


def crossing_reason(facetmill, off, scratch):
    """What the pairs are that facetmill finds and MeshLab does not; nothing when one is not true."""
    report = scratch / "report.json"
    run([facetmill, "pipe", "--quiet", "--report", str(report), "load", off, "!", "validate", "--self_intersections", "0"])
    places = json.loads(report.read_text())["checks"][0]["evidence"]
    mesh = trimesh.load(off, process=False)
    shares = set()
    for place in places:
        pair = list(mesh.faces[place["face"]]), list(mesh.faces[place["with"]])
        true, shared = pair_meets(mesh.vertices, *pair)
        if not true or (shared == 0 and crosses(mesh.vertices, *pair)):
            return None
        shares.add(shared)
    names = {0: "that only touch", 1: "with a common vertex", 2: "folded on a common edge", 3: "of the same vertices"}
    return "MeshLab leaves out faces " + " or ".join(names[s] for s in sorted(shares)) + "; checked in rational numbers"


def explained(name, ours, tri, lab, off, find_crossings):
    """The reason for a disagreement, from what the words mean; or nothing."""
    repeats = tri["repeating"] > 0
    if repeats and (name in ("edge_manifold", "vertex_manifold", "boundary_edges", "oriented", "components",
                             "isolated_vertices")
                    or name == "euler"):
        return "a face that repeats a vertex is a face here; the peers drop it"
    if name == "genus" and not (ours["closed"] and ours["edge_manifold"] and ours["vertex_manifold"] and ours["oriented"]):
        return "genus applies to closed oriented manifolds; MeshLab gives it for others"
    if name == "closed" and ours["closed"] and not ours["edge_manifold"]:
        return "closed means that directions cancel, also where four faces meet; watertight means two faces"
    if name == "oriented" and not ours["edge_manifold"]:
        return "trimesh looks only at edges of two faces"
    if name == "vertex_manifold" and not ours["vertex_manifold"] and not ours["edge_manifold"]:
        return crowded_reason(off)
    if name == "components" and lab["components"] > ours["components"]:
        return "components hang together by vertices; MeshLab's by edges"
    if name == "self_intersections" and ours["self_intersections"] > 0:
        return find_crossings()
    if name == "self_intersections" and ours["touching"] > 0:
        return "pairs that only touch are `touching` here; MeshLab counts some of them"
    if name == "self_intersections" and lab["crossing"]:
        return rounding_reason(off, lab["selected"])
    return None


def judge(facetmill, cgal, path, scratch):
    off = str(scratch / "mesh.off")
    done = run([facetmill, "pipe", "--quiet", "load", str(path), "!", "merge", "!", "triangulate", "!", "write", off])
    if done.returncode != 0:
        return "not read: " + (done.stderr.strip().splitlines() or ["?"])[0][:100], []
    ours = info(facetmill, off)
    if ours is None or ours["faces"] == 0:
        return "nothing to judge", []
    if ours["faces"] > LIMIT:
        return "too large", []
    try:
        tri, lab = by_trimesh(off), by_pymeshlab(off)
    except Exception as error:  # a peer that gives up is an answer, too
        return f"a peer gave up: {str(error)[:80]}", []
    reason = lambda: crossing_reason(facetmill, off, scratch)
    found = [(n, a, b, explained(n, ours, tri, lab, off, reason)) for n, a, b in compare(ours, tri, lab)]
    if cgal:
        answer = by_cgal(cgal, off)
        found += [(n, a, b, explained_cgal(n, ours, answer, off)) for n, a, b in compare_cgal(ours, answer, facetmill, off)]
    return "agree" if not found else "differ", found


def generated(first, count, scratch):
    for seed in range(first, first + count):
        vertices, faces, _ = repair.generated(seed)
        path = scratch / f"{seed}.ply"
        trimesh.Trimesh(vertices, faces, process=False).export(path)
        yield path
        path.unlink()


def main():
    ask = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    ask.add_argument("facetmill")
    ask.add_argument("--cgal")
    ask.add_argument("--generated", nargs=2, type=int, metavar=("FIRST", "COUNT"), default=(0, 0))
    ask.add_argument("roots", nargs="*", type=pathlib.Path)
    given = ask.parse_intermixed_args()
    files = sorted(f for r in given.roots for f in ([r] if r.is_file() else r.rglob("*"))
                   if f.is_file() and f.suffix != ".tsv")
    reasons, left = collections.Counter(), 0
    with tempfile.TemporaryDirectory() as folder:
        scratch = pathlib.Path(folder)
        for path in itertools.chain(files, generated(*given.generated, scratch)):
            verdict, found = judge(given.facetmill, given.cgal, path, scratch)
            reasons[verdict.split(":")[0]] += 1
            if verdict != "agree" or path in files:
                print(f"{path}: {verdict}", flush=True)
            for name, ours, theirs, why in found:
                print(f"    {name}: {ours}, theirs {theirs}{'  (' + why + ')' if why else '  UNEXPLAINED'}", flush=True)
                reasons[re.sub("[0-9]+", "N", why) if why else "unexplained"] += 1
                left += not why
    for reason, count in reasons.most_common():
        print(f"{count:6} {reason}")
    return left > 0


if __name__ == "__main__":
    sys.exit(main())
