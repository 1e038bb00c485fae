#!/usr/bin/env python3
"""Repairing meshes that are wrong in every way, for printing: facetmill beside admesh, MeshFix, pymeshlab and manifold3d.

repair.py [--count 300] [--first 1] [--build build/release] [--peers NAME ...] [--without_reports] [MESH ...]

Without MESH the meshes are generated: spheres, boxes and tori of some hundred faces, alone or several that pass through
each other, with faces left out, doubled, turned or degenerate, unwelded and slightly moved corners, T-junctions, fins and
isolated vertices, one to four of these at a time. Run it by an interpreter that has numpy, trimesh and pymeshlab;
pymeshfix, manifold3d and the program admesh are used where they are there.

A repair counts when others than facetmill say so: trimesh finds it watertight, wound consistently and of positive volume,
and pymeshlab finds no edge and no vertex that is not manifold and no face that intersects another. `validate --for
printing` is told beside it. Of each tool: the share of good results; among them the share of the input's faces (by
the places of their corners) that are still there; how far the volume is from that of the shapes without damage; seconds.
"""
import argparse
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import time

import numpy as np
import pymeshlab
import trimesh

ROOT = pathlib.Path(__file__).resolve().parents[2]
os.environ.update(FACETMILL_CACHE="off", OMP_NUM_THREADS="1")
LIMIT = 60  # seconds for one mesh


# --- meshes

def shape(random):
    kind = random.integers(3)
    if kind == 0:
        mesh = trimesh.creation.icosphere(subdivisions=int(random.integers(1, 4)))
    elif kind == 1:
        mesh = trimesh.creation.box().subdivide().subdivide()
    else:
        mesh = trimesh.creation.torus(1, 0.4, major_sections=24, minor_sections=12)
    mesh.apply_transform(trimesh.transformations.random_rotation_matrix(random.random(3)))
    mesh.apply_translation(random.random(3) * 0.8)
    return np.array(mesh.vertices), np.array(mesh.faces)


def hole(random, v, f):
    center = v[f[random.integers(len(f))]].mean(0)
    near = np.argsort(((v[f].mean(1) - center) ** 2).sum(1))[:random.integers(1, 12)]
    return v, np.delete(f, near, 0)


def doubled(random, v, f):
    return v, np.vstack([f, f[random.choice(len(f), 3)]])


def turned(random, v, f):
    f = f.copy()
    some = random.choice(len(f), max(1, len(f) // 20), replace=False)
    f[some] = f[some, ::-1]
    return v, f


def inside_out(random, v, f):
    return v, f[:, ::-1]


def unwelded(random, v, f):
    return v[f].reshape(-1, 3), np.arange(3 * len(f)).reshape(-1, 3)


def degenerate(random, v, f):
    some = f[random.choice(len(f), 3)].copy()
    some[:, 2] = some[:, 1]
    return v, np.vstack([f, some])


def t_junction(random, v, f):
    """One side of an edge is cut in the middle, the other is not."""
    a, b, c = f[random.integers(len(f))]
    i = int(np.flatnonzero((f == [a, b, c]).all(1))[0])
    v = np.vstack([v, (v[a] + v[b]) / 2])
    return v, np.vstack([np.delete(f, i, 0), [[a, len(v) - 1, c], [len(v) - 1, b, c]]])


def fin(random, v, f):
    a, b, _ = f[random.integers(len(f))]
    v = np.vstack([v, (v[a] + v[b]) / 2 + 0.3 * random.normal(size=3)])
    return v, np.vstack([f, [[a, b, len(v) - 1]]])


def isolated(random, v, f):
    return np.vstack([v, random.normal(size=(5, 3))]), f


def moved(random, v, f):
    v = v.copy()
    some = random.choice(len(v), max(1, len(v) // 30), replace=False)
    v[some] += 0.05 * random.normal(size=(len(some), 3))
    return v, f


def sliver(random, v, f):
    """A corner that all but lies on the opposite edge."""
    v = v.copy()
    a, b, c = f[random.integers(len(f))]
    v[c] = (v[a] + v[b]) / 2 + 1e-9 * random.normal(size=3)
    return v, f


DAMAGES = [hole, doubled, turned, inside_out, unwelded, degenerate, t_junction, fin, isolated, moved, sliver]


def generated(seed):
    """Vertices, faces, and the volume of the union of the shapes where it is known, else None."""
    random = np.random.default_rng(seed)
    parts = [shape(random) for _ in range(random.choice([1, 1, 1, 2, 3]))]
    v, f = parts[0]
    for w, g in parts[1:]:
        v, f = np.vstack([v, w]), np.vstack([f, g + len(v)])
    volume = trimesh.Trimesh(v, f, process=False).volume if len(parts) == 1 else None
    for damage in random.choice(DAMAGES, random.integers(1, 5)):
        v, f = damage(random, v, f)
    return v, f, volume


# --- tools: the file of a mesh -> vertices and faces, None when the tool gives up

def by_facetmill(program_and_pipeline, source, target):
    program, pipeline = program_and_pipeline
    subprocess.run([program, "run", pipeline, "-q", "-D", f"input={source}", "-D", "format=ply", "-o", source.parent],
                   capture_output=True, timeout=LIMIT)
    made = source.with_name(f"{source.stem}.repaired.ply")
    if made.exists():
        made.rename(target)


def by_admesh(program, source, target):
    stl = str(source) + ".stl"
    trimesh.load_mesh(source, process=False).export(stl)
    subprocess.run([program, "-b", stl + ".fixed", stl], capture_output=True, timeout=LIMIT)
    fixed = trimesh.load_mesh(stl + ".fixed", file_type="stl", process=False)
    fixed.merge_vertices(merge_tex=False)
    fixed.export(target)


def by_meshfix(_, source, target):
    import pymeshfix
    mesh = trimesh.load_mesh(source, process=False)
    fix = pymeshfix.MeshFix(np.array(mesh.vertices), np.array(mesh.faces, dtype=np.int32))
    fix.repair()
    points = fix.points if hasattr(fix, "points") else fix.v
    trimesh.Trimesh(points, fix.faces if hasattr(fix, "faces") else fix.f, process=False).export(target)


def by_pymeshlab(_, source, target):
    meshes = pymeshlab.MeshSet(verbose=False)
    meshes.load_new_mesh(str(source))
    for step in ("meshing_remove_duplicate_vertices", "meshing_remove_duplicate_faces", "meshing_remove_null_faces",
                 "meshing_remove_unreferenced_vertices", "meshing_repair_non_manifold_edges",
                 "meshing_repair_non_manifold_vertices", "meshing_close_holes", "meshing_re_orient_faces_coherently",
                 "meshing_re_orient_faces_by_geometry"):
        try:
            getattr(meshes, step)()
        except pymeshlab.PyMeshLabException:
            pass  # closing holes refuses what is not manifold; what comes after may help
    meshes.save_current_mesh(str(target))


def by_manifold(_, source, target):
    import manifold3d
    mesh = trimesh.load_mesh(source, process=False)
    soup = manifold3d.Mesh(np.array(mesh.vertices, np.float32), np.array(mesh.faces, np.uint32))
    soup.merge()
    solid = manifold3d.Manifold(soup)
    if solid.status() != manifold3d.Error.NoError or solid.is_empty():
        return
    result = solid.to_mesh()
    trimesh.Trimesh(result.vert_properties[:, :3], result.tri_verts, process=False).export(target)


TOOLS = {"admesh": by_admesh, "MeshFix": by_meshfix, "pymeshlab": by_pymeshlab, "manifold3d": by_manifold}


def in_a_child(work, *arguments):
    """A library that crashes or hangs ends its child; seconds."""
    start, child = time.perf_counter(), os.fork()
    if child == 0:
        os.dup2(os.open(os.devnull, os.O_WRONLY), 1)
        os.dup2(1, 2)
        try:
            work(*arguments)
        finally:
            os._exit(0)
    while os.waitpid(child, os.WNOHANG) == (0, 0):
        if time.perf_counter() - start > LIMIT:
            os.kill(child, 9)
        time.sleep(0.001)
    return time.perf_counter() - start


# --- judgement

def is_sound(path):
    """As trimesh and pymeshlab see it."""
    mesh = trimesh.load_mesh(path, process=False)
    if len(mesh.faces) == 0 or not mesh.is_watertight or not mesh.is_winding_consistent or not mesh.volume > 0:
        return False
    meshes = pymeshlab.MeshSet(verbose=False)
    meshes.load_new_mesh(str(path))
    topology = meshes.get_topological_measures()
    if topology["non_two_manifold_edges"] or topology["non_two_manifold_vertices"]:
        return False
    meshes.compute_selection_by_self_intersections_per_face()
    return meshes.current_mesh().selected_face_number() == 0


def is_printable(program, path):
    return subprocess.run([program, "pipe", "-q", "load", path, "!", "validate", "--for", "printing"],
                          capture_output=True).returncode == 0


def corners(v, f):
    """Faces by the places of their corners in single precision, wherever they begin and whichever way they go."""
    places = np.asarray(v, np.float32)[f]
    return {tuple(sorted(map(tuple, face))) for face in places.tolist()}


def kept(source, target):
    before, after = (corners(m.vertices, m.faces) for m in (trimesh.load_mesh(p, process=False) for p in (source, target)))
    return len(before & after) / max(1, len(before))


def main():
    ask = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    ask.add_argument("--count", type=int, default=300)
    ask.add_argument("--first", type=int, default=1)
    ask.add_argument("--build", type=pathlib.Path, default=ROOT / "build/release")
    ask.add_argument("--peers", nargs="*", default=list(TOOLS))
    ask.add_argument("--without_reports", action="store_true", help="of facetmill's pipeline, most of its time")
    ask.add_argument("meshes", nargs="*", type=pathlib.Path)
    given = ask.parse_args()
    program = given.build / "facetmill"
    tools = {}
    for name in given.peers:
        there = shutil.which("admesh") if name == "admesh" else __import__("importlib.util").util.find_spec(
            {"MeshFix": "pymeshfix"}.get(name, name))
        if there:
            tools[name] = (TOOLS[name], there)
        else:
            print(f"missing: {name}", file=sys.stderr)
    with tempfile.TemporaryDirectory() as room:
        pipeline = "repair"
        if given.without_reports:
            lines = (ROOT / "pipelines/repair.yaml").read_text().splitlines(keepends=True)
            pipeline = pathlib.Path(room) / "repair.yaml"
            pipeline.write_text("".join(line for line in lines if not line.startswith("report:")))
        tools = {"facetmill": (by_facetmill, (program, pipeline)), **tools}
        results = {name: [] for name in tools}
        for case in given.meshes or range(given.first, given.first + given.count):
            volume, source = None, pathlib.Path(room) / "in.ply"
            if isinstance(case, int):
                v, f, volume = generated(case)
                trimesh.Trimesh(v, f, process=False).export(source)
            else:
                trimesh.load_mesh(case, process=False).export(source)
            for name, (work, tool) in tools.items():
                target = pathlib.Path(room) / "out.ply"
                target.unlink(missing_ok=True)
                seconds = in_a_child(work, tool, source, target)
                there = target.exists() and target.stat().st_size > 0
                sound = there and is_sound(target)
                printable = there and is_printable(program, target)
                share = kept(source, target) if sound else None
                far = abs(trimesh.load_mesh(target, process=False).volume / volume - 1) if sound and volume else None
                results[name].append((sound, printable, share, far, seconds))
                if name == "facetmill" and not (sound and printable):
                    print(f"facetmill: {case}: sound {bool(sound)}, printable {bool(printable)}", file=sys.stderr)
    print("| tool | sound | `--for printing` | faces kept, mean | volume off by more than 5 % | seconds |\n|---|---|---|---|---|---|")
    for name, rows in results.items():
        sound = [row for row in rows if row[0]]
        shares = [row[2] for row in sound]
        known = [row[3] for row in sound if row[3] is not None]
        print(f"| {name} | {100 * len(sound) / len(rows):.1f} % | {100 * sum(r[1] for r in rows) / len(rows):.1f} % | "
              f"{100 * np.mean(shares) if shares else 0:.1f} % | "
              f"{100 * sum(x > 0.05 for x in known) / max(1, len(known)):.1f} % | {sum(r[4] for r in rows):.1f} |")


if __name__ == "__main__":
    main()
