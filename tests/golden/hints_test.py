"""Hints work: each message that can be provoked by a small input is provoked, its hint is followed, and the run gets
further. A message that cannot be provoked here, or whose hint has nothing to type, is listed with the reason. So a new
message needs a row, and a hint that does not help fails."""

import base64
import json
import math
import re
import shlex
import struct

from support import Case, main


def off(*meshes):
    points, faces = [], []
    for more, of in meshes:
        faces += [[i + len(points) for i in face] for face in of]
        points += more
    lines = ["OFF", f"{len(points)} {len(faces)} 0"]
    lines += [" ".join(map(repr, p)) for p in points] + [" ".join(map(str, [len(f), *f])) for f in faces]
    return "\n".join(lines) + "\n"


def box(at=(0, 0, 0), size=(1, 1, 1), faces=6, inward=False):
    points = [tuple(at[i] + size[i] * c[i] for i in range(3)) for c in
              ((x, y, z) for z in (0, 1) for y in (0, 1) for x in (0, 1))]
    sides = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)][:faces]
    return points, [side[::-1] if inward else side for side in sides]


def grid(n, height):
    points = [(float(x), float(y), float(height(x, y))) for y in range(n + 1) for x in range(n + 1)]
    corners = [y * (n + 1) + x for y in range(n) for x in range(n)]
    return points, [face for a in corners for face in ((a, a + 1, a + n + 2), (a, a + n + 2, a + n + 1))]


def moebius(n=12):
    points = []
    for i in range(n):
        angle = 2 * math.pi * i / n
        for side in (-0.3, 0.3):
            r = 1 + side * math.cos(angle / 2)
            points.append((r * math.cos(angle), r * math.sin(angle), side * math.sin(angle / 2)))
    faces = []
    for i in range(n):
        a, b = 2 * i, 2 * i + 1
        c, d = (2 * i + 2, 2 * i + 3) if i < n - 1 else (1, 0)
        faces += [(a, c, d), (a, d, b)]
    return points, faces


def dumbbell():
    """Two boxes and a neck."""
    outline = [(0, 0), (4, 0), (4, 1.5), (6, 1.5), (6, 0), (10, 0), (10, 4), (6, 4), (6, 2.5), (4, 2.5), (4, 4), (0, 4)]
    n = len(outline)
    sides = [[i, (i + 1) % n, n + (i + 1) % n, n + i] for i in range(n)]
    return off(([(x, y, z) for z in (0, 4) for x, y in outline], [list(range(n))[::-1], list(range(n, 2 * n)), *sides]))


def ply(points, faces=(), kind="float"):
    head = f"ply\nformat ascii 1.0\nelement vertex {len(points)}\n" + "".join(f"property {kind} {c}\n" for c in "xyz")
    if faces:
        head += f"element face {len(faces)}\nproperty list uchar int vertex_indices\n"
    return (head + "end_header\n" + "".join(" ".join(map(repr, p)) + "\n" for p in points)
            + "".join(" ".join(map(str, [len(f), *f])) + "\n" for f in faces))


def gltf(uri=None, normals=None, weights=None, **more):
    data = struct.pack("<9f", 0, 0, 0, 1, 0, 0, 0, 1, 0)
    attributes, views, accessors = {"POSITION": 0}, [], []

    def add(name, values, kind, count):
        nonlocal data
        accessors.append({"bufferView": len(views), "componentType": 5126, "count": 3, "type": kind})
        views.append({"buffer": 0, "byteOffset": len(data), "byteLength": 12 * count})
        data += struct.pack(f"<{3 * count}f", *values)
        attributes[name] = len(accessors)

    views.append({"buffer": 0, "byteLength": 36})
    if normals:
        add("NORMAL", normals, "VEC3", 3)
    if weights:
        add("WEIGHTS_0", weights, "VEC4", 4)
        add("JOINTS_0", [0] * 12, "VEC4", 4)
        accessors[-1]["componentType"] = 5123
        accessors[-1]["bufferView"] = len(views) - 1
    document = {
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": attributes}]}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0],
                       "max": [1, 1, 0]}, *accessors],
        "bufferViews": views,
        "buffers": [{"uri": uri or "data:application/octet-stream;base64," + base64.b64encode(data).decode(),
                     "byteLength": len(data)}]}
    if weights:
        document["nodes"] = [{"mesh": 0, "skin": 0}, {"name": "joint"}]
        document["scenes"] = [{"nodes": [0, 1]}]
        document["skins"] = [{"joints": [1]}]
    document.update(more)
    return json.dumps(document)


def morphing(n=4):
    """A flat grid whose only morph target bends it."""
    points, faces = grid(n, lambda x, y: 0)
    data = b"".join(struct.pack("<3f", *p) for p in points) + b"".join(struct.pack("<3f", 0, 0, p[0] ** 2) for p in points)
    data += b"".join(struct.pack("<3H", *face) for face in faces)
    size = 12 * len(points)

    def accessor(view, kind, count, high):
        return {"bufferView": view, "componentType": 5123 if kind == "SCALAR" else 5126, "count": count, "type": kind,
                **({"min": [0, 0, 0], "max": high} if high else {})}

    return json.dumps({
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 2, "targets": [{"POSITION": 1}]}]}],
        "accessors": [accessor(0, "VEC3", len(points), [n, n, 0]), accessor(1, "VEC3", len(points), [0, 0, n * n]),
                      accessor(2, "SCALAR", 3 * len(faces), None)],
        "bufferViews": [{"buffer": 0, "byteOffset": 0, "byteLength": size},
                        {"buffer": 0, "byteOffset": size, "byteLength": size},
                        {"buffer": 0, "byteOffset": 2 * size, "byteLength": 6 * len(faces)}],
        "buffers": [{"uri": "data:application/octet-stream;base64," + base64.b64encode(data).decode(),
                     "byteLength": len(data)}]})


def islands(n=8):
    points, faces = grid(n, lambda x, y: 0.1 * math.sin(x))
    lines = [f"v {x} {y} {z}" for x, y, z in points]
    lines += [f"vt {0.01 * i} {0.02 * k}" for i in range(len(faces)) for k in range(3)]
    lines += ["f " + " ".join(f"{v + 1}/{3 * i + k + 1}" for k, v in enumerate(face)) for i, face in enumerate(faces)]
    return "\n".join(lines) + "\n"


def far_grid():
    points, faces = grid(4, lambda x, y: 100 + 0.25 * x)
    return [(5e5 + 10.3 * x, 5e6 + 10.3 * y, z) for x, y, z in points], faces


# Height 0.5 closes around hills and around pits.
TERRAIN = grid(16, lambda x, y: 0.5 + math.sin(x * math.pi / 4) * math.sin(y * math.pi / 4))

FILES = {
    "part.off": off(box()), "open.off": off(box(faces=5)), "two.off": off(box(), box((3, 0, 0))),
    "inside.off": off(box(inward=True)), "drill.off": off(box((.25, .25, -1), (.5, .5, 3))),
    "far.off": off(box((9, 9, 9))), "ten.off": off(box(size=(10, 10, 10))), "over.off": off(box((.5, .5, .5))), "big.off": off(box((-1, -1, -1), (3, 3, 3))),
    "terrain.off": off(TERRAIN), "moebius.off": off(moebius()),
    "wavy.off": off(grid(8, lambda x, y: math.sin(x) + math.cos(1.7 * y))),
    "tri.off": off(([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2)])),
    "nan.obj": "v 0 0 0\nv 1 0 0\nv 0 1 0\nv nan 0 0\nf 1 2 3\nf 1 2 4\n",
    "lines.obj": "v 0 0 0\nv 1 0 0\nv 1 1 0\nl 1 2 3\n",
    "more/points.ply": ply([(0, 0, 0), (1, 0, 0), (0, 1, 0)]),
    "points.ply": ply([(0, 0, 0), (1, 0, 0), (0, 1, 0)]),
    "fin.off": off(([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1)], [(0, 1, 2), (1, 0, 3), (0, 1, 4)])),
    "flipped.off": off(([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)], [(0, 1, 2), (0, 3, 2)])),
    "flipped-box.off": off((box()[0], [box()[1][0][::-1], *box()[1][1:]])),
    "stray.off": off(([(99990, 0, 0), (99991, 0, 0), (99990, 1, 0)], [(0, 1, 2)])),
    "wrong.obj": off(box()), "stated.off": "# unit: mm\n" + off(box()), "tiny.off": off(box(size=(1e-120,) * 3)),
    "arrow.off": off(([(0, 0, 0), (2, 0, 0), (.5, .5, 0), (0, 2, 0)], [(0, 1, 2, 3)])),
    "islands.obj": islands(), "utm.ply": ply(*far_grid()),
    "morph.gltf": morphing(),
    "camera.gltf": gltf(cameras=[{"type": "perspective", "perspective": {"yfov": 1, "znear": 1}}]),
    "packets.gltf": gltf(extensionsUsed=["KHR_xmp_json_ld"], extensions={"KHR_xmp_json_ld": {"packets": [{"dc:title": "t"}]}}),
    "moving.gltf": gltf(animations=[{"samplers": [{"input": 0, "output": 0}], "channels": []}]),
    "plane.off": off(grid(3, lambda x, y: 0)), "far.ply": ply(box((1e6 + .13, .13, .17), (.7, .7, .7))[0], box()[1], "double"),
    "flipped-open.off": off((box()[0], [box()[1][0][::-1], *box(faces=5)[1][1:]])),
    "nested.off": off(box((-3, -3, -3), (6, 6, 6)), box((-1, -1, -1), (2, 2, 2))),
    "crossing.off": off(box(), box((.5, .5, .5))),
    "dumbbell.off": dumbbell(),
    "nomtl.obj": "mtllib none.mtl\nusemtl red\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n",
    "no-image.gltf": gltf(materials=[{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}],
                          textures=[{"source": 0}], images=[{"uri": "none.png"}]),
    "sub/escapes.gltf": gltf(uri="../t.bin"),
    "normals.gltf": gltf(normals=[0, 0, 2, 0, 0, 2, 0, 0, 0]),
    "weights.gltf": gltf(weights=[.5, .1, 0, 0] * 3),
    "animated.gltf": gltf(cameras=[{"type": "perspective", "perspective": {"yfov": 1, "znear": 1}}]),
    "plain.gltf": gltf(), "clip.gltf": '{"asset": {"version": "2.0"}, "scenes": [{"nodes": [0]}], "nodes": [{"name": "spawn"}]}',
    "loads.yaml": 'facetmill: 1\nparams: {input: {type: path}}\nstages: [{load: "${input}"}]\n',
    "reports.yaml": 'facetmill: 1\nparams: {input: {type: path}}\nstages: [{load: "${input}"}]\n'
                    'report: "${input.stem}.json"\n',
    "valid.yaml": "facetmill: 1\nstages: [{load: open.off}, {validate: {closed: true}}]\n",
    "baseline.yaml": "facetmill: 1\nstages: [{load: open.off}, {validate: {closed: true, baseline: known.json}}]\n",
}

# id: what provokes it, its hint, and the line after the hint was followed. YAML is a text with a line break.
FOLLOWED = [
    ("E-ARGUMENT", "render part.off", "facetmill render part.off -o part.png", "render part.off -o part.png"),
    ("E-ARGUMENT", "run part.off", "facetmill run web part.off", "run web part.off"),
    ("E-ASSET-ROOT", "pipe load part.off --asset_root none ! validate", "give the folder",
     "pipe load part.off --asset_root . ! validate --closed true"),
    ("E-ATTRIBUTE", "pipe load part.off ! render r.png --attribute nonesuch", "area",
     "pipe load part.off ! render r.png --attribute area"),
    ("E-BASELINE", "run valid.yaml --update-baseline", "validate: {baseline: known.json}",
     "run baseline.yaml --update-baseline"),
    ("E-BOX", "pipe load part.off ! clip --box.min 0,0,0", "min and max",
     "pipe load part.off ! clip --box.min 0,0,0 --box.max 1,1,.5 ! write o.ply"),
    ("E-CELLS", "pipe --partition always load part.off ! relax 1 ! write o.ply", "--partition auto",
     "pipe --partition auto load part.off ! relax 1 ! write o.ply"),
    ("E-CHECK", "pipe load open.off ! validate --closed true", "clean --holes minimal",
     "pipe load open.off ! clean --holes minimal ! validate --closed true"),
    ("E-CHECK", "pipe load normals.gltf ! validate --unit_normals true", "clean --unit_vectors",
     "pipe load normals.gltf ! clean --unit_vectors ! validate --unit_normals true"),
    ("E-CHECK", "pipe load normals.gltf ! write n.glb ! validate --unit_normals true",
     "clean --unit_vectors", "pipe load normals.gltf ! clean --unit_vectors ! write n.glb ! validate --unit_normals true"),
    ("E-CHECK", "pipe load weights.gltf ! validate --weights_normalized true", "clean --unit_vectors",
     "pipe load weights.gltf ! clean --unit_vectors ! validate --weights_normalized true"),
    ("E-CHOICE", "pipe load part.off ! relax --method laplacean", "'laplacian'",
     "pipe load wavy.off ! relax 1 --method laplacian ! write o.ply"),
    ("E-COMBINE", "pipe load '{open,drill}.off' ! combine --operation difference --with drill ! write o.ply",
     "clean --holes minimal",
     "pipe load '{open,drill}.off' ! clean --holes minimal ! combine --operation difference --with drill ! write o.ply"),
    ("E-COMMAND", "part.off o.ply", "facetmill convert IN OUT", "convert part.off o.ply"),
    ("E-COMMAND", "repair part.off", "facetmill run repair -D input=FILE", "run repair -D input=part.off"),
    ("E-CONFLICT", "pipe load part.off ! clean --tolerance 1 ! write o.ply", "--weld near",
     "pipe load part.off ! clean --tolerance .1 --weld near ! write o.ply"),
    ("E-DIRECTION", "pipe load part.off ! render r.png --from 0,0,0", "--from '[1, -2, 1]'",
     "pipe load part.off ! render r.png --from '[1, -2, 1]'"),
    ("E-DIRECTORY", "pipe load more ! write o.ply", "'more/*.ply'", "pipe load 'more/*.ply' ! write o.ply"),
    ("E-DRAWING", "pipe load part.off ! section z=.5 --path x.pdf", ".svg", "pipe load part.off ! section z=.5 --path x.svg"),
    ("E-DUPLICATE", "facetmill: 1\nstages: [{load: part.off, load: open.off}]", "the first is at t.yaml:2:11",
     "facetmill: 1\nstages: [{load: part.off}]"),
    ("E-DUPLICATE-INPUT", "info - -", "give - only once", "info part.off"),
    ("E-DUPLICATE-OUTPUT", "pipe load part.off ! foreach x=1,2 [ write one.ply ]", "one.@{x.index}.ply",
     "pipe load part.off ! foreach x=1,2 [ write 'one.@{x.index}.ply' ]"),
    ("E-EMPTY", "pipe load part.off ! clip z=9 --keep front ! write o.ply", "--when.vertices.min 1",
     "pipe load part.off ! clip z=9 --keep front ! write o.ply --when.vertices.min 1"),
    ("E-EXISTS", "new loads.yaml", "- to print", "new -"),
    ("E-EXPORT", "export --to ninja loads.yaml --input part.off -o out", 'report: "${input.stem}.json"',
     "export --to ninja reports.yaml --input part.off -o out"),
    ("E-EXPRESSION", 'facetmill: 1\nstages: [{load: part.off}, {write: "${a"}]', "$${",
     'facetmill: 1\nstages: [{load: part.off}, {write: "$${a.ply"}]'),
    ("E-FACE", "pipe load part.off ! probe --segments 0,0,9,0,0,-9 --face 99", "from 0 to 5",
     "pipe load part.off ! probe --segments 0,0,9,0,0,-9 --face 5"),
    ("E-FILE", "pipe load prat.off ! write o.ply", "'part.off'", "pipe load part.off ! write o.ply"),
    ("E-FILE", "run wbe -D input=part.off", "'web'", "run web -D input=part.off"),
    ("E-FILE", "batch web --input '*.gltx' -o out", "'**/*.gltx'", None),
    ("E-FOREACH", "facetmill: 1\nstages: [{load: part.off}, {foreach: {x: []}, do: [relax: 1]}]",
     "foreach: {x: [50%, 25%]}",
     'facetmill: 1\nstages: [{load: wavy.off}, {foreach: {x: [50%, 25%]}, do: [{simplify: "${x}"}]}]'),
    ("E-FORMAT", "pipe load part.off ! write o.fbx", "write .glb", "pipe load part.off ! write o.glb"),
    ("E-FORMAT-VERSION", "stages: [{load: part.off}]", "facetmill: 1", "facetmill: 1\nstages: [{load: part.off}]"),
    ("E-GROUP", "pipe load part.off ! separate --by group ! write o.glb", "merge creates 'group'",
     "pipe load part.off ! merge ! separate --by group ! write o.glb"),
    ("E-HATCH", "pipe load part.off ! section z=.5 --path x.svg --hatch 1e-12", "larger spacing",
     "pipe load part.off ! section z=.5 --path x.svg --hatch .1"),
    ("E-INCLUDE", "facetmill: 1\nstages: [{load: part.off}, {include: t.yaml}]", "t.yaml -> t.yaml",
     "facetmill: 1\nstages: [{load: part.off}]"),
    ("E-INTERSECTS", "pipe load wavy.off ! split --max_edge 1 ! crumple --amplitude 5 --self_intersections forbid ! write o.ply",
     "--self_intersections avoid",
     "pipe load wavy.off ! split --max_edge 1 ! crumple --amplitude 5 --self_intersections avoid ! write o.ply"),
    ("E-KEY", "pipe load part.off ! relax --iteration 3", "'iterations'", "pipe load wavy.off ! relax --iterations 1 ! write o.ply"),
    ("E-LIMITS", "pipe load part.off ! validate --limits.bytes 10kB ! write o.ply", "put write out.glb before validate",
     "pipe load part.off ! write out.glb ! validate --limits.bytes 10kB"),
    ("E-MANIFOLD", "pipe load fin.off ! split loop ! write o.ply", "midpoint", "pipe load fin.off ! split midpoint ! write o.ply"),
    ("E-MANIFOLD", "pipe load fin.off ! split loop ! write o.ply", "clean", "pipe load fin.off ! clean ! split loop ! write o.ply"),
    ("E-MISSING", "pipe load part.off ! clean --weld near ! write o.ply", "--tolerance 0.01%",
     "pipe load part.off ! clean --weld near --tolerance 0.01% ! write o.ply"),
    ("E-NAN", "pipe load nan.obj ! write o.ply", "load --not_finite drop", "pipe load nan.obj --not_finite drop ! write o.ply"),
    ("E-OPTION", "run loads.yaml --ouput-dir x", "'--output-dir'", "run loads.yaml --output-dir x -D input=part.off"),
    ("E-ORDER", "pipe relax 3", "load FILE", "pipe load wavy.off ! relax 1 ! write o.ply"),
    ("E-OVERWRITE", "pipe load part.off ! write part.off", "another name", "pipe load part.off ! write other.off"),
    ("E-PARAM", "run loads.yaml", "-D input=", "run loads.yaml -D input=part.off"),
    ("E-PART", "pipe load '{part,drill}.off' ! combine --operation difference --with dril ! write o.ply", "'drill'",
     "pipe load '{part,drill}.off' ! combine --operation difference --with drill ! write o.ply"),
    ("E-PARTS", "pipe load two.off ! separate --max_parts 1 ! write o.glb", "raise max_parts",
     "pipe load two.off ! separate --max_parts 2 ! write o.glb"),
    ("E-PICTURE", "pipe load part.off ! render r.jpg", "view.png", "pipe load part.off ! render view.png"),
    ("E-PIPE", "pipe load part.off ! write o.ply -o out", "facetmill pipe -o ... load", "pipe -o out load part.off ! write o.ply"),
    ("E-PLANE", "pipe load part.off ! clip --plane.normal 0,0,0 ! write o.ply", "--plane.normal '[0, 0, 1]'",
     "pipe load part.off ! clip --plane.normal '[0, 0, 1]' --plane.through centre ! write o.ply"),
    ("E-POLYGON", "pipe load part.off ! split loop ! write o.ply", "triangulate",
     "pipe load part.off ! triangulate ! split loop ! write o.ply"),
    ("E-RANGE", "pipe load tiny.off ! write o.ply", "transform --scale 1e120",
     "pipe load tiny.off ! transform --scale 1e120 ! write o.ply"),
    ("E-RAY", "pipe load part.off ! probe --rays 0,0,9,0,0,0", "use segments", "pipe load part.off ! probe --segments 0,0,9,0,0,0"),
    ("E-REPORT", "pipe --report r.pdf load part.off ! write o.ply", "r.html", "pipe --report r.html load part.off ! write o.ply"),
    ("E-SECTION", "pipe load part.off ! section z=.5 --spacing 1e-12", "larger spacing", "pipe load part.off ! section z=.5 --spacing .1"),
    ("E-SET", "run loads.yaml -D input=part.off --set laod.unit=mm", "'load'", "run loads.yaml -D input=part.off --set load.path=part.off"),
    ("E-STAGE", "pipe load part.off ! simplfy 10%", "'simplify'", "pipe load wavy.off ! simplify 50% ! write o.ply"),
    ("E-STRICT", "pipe --strict=W-UNIT load part.off", "'W-UNITS'", "pipe --strict=W-UNITS load part.off ! write o.ply"),
    ("E-NEST", "pipe load part.off ! nest .5 ! write o.glb", "--shrink_only",
     "pipe load part.off ! transform --fit .4 --shrink_only ! nest .5 ! write o.glb"),
    ("E-TILE", "pipe load part.off ! tile 1e-12 ! write o.glb", "larger size", "pipe load part.off ! tile .5 ! write o.glb"),
    ("E-UNIT", "pipe load part.off ! clip z=2mm ! write o.ply", "load --unit mm", "pipe load part.off --unit mm ! clip z=.5mm ! write o.ply"),
    ("E-UNQUOTED", "facetmill: 1\nparams: {x: {type: path, default: part.off}}\nstages: [{load: ${x}}]", '"${x}"',
     'facetmill: 1\nparams: {x: {type: path, default: part.off}}\nstages: [{load: "${x}"}]'),
    ("E-UP", "pipe load part.off ! write o.stl --up z", "load ... --up z", "pipe load part.off --up y ! write o.stl --up z"),
    ("E-URI", "pipe load sub/escapes.gltf ! write o.ply", "--asset_root .", "pipe load sub/escapes.gltf --asset_root . ! write o.ply"),
    ("E-URI", "pipe load sub/escapes.gltf ! write o.ply", "--asset-root", "pipe --asset-root . load sub/escapes.gltf ! write o.ply"),
    ("E-VALUE", "pipe load part.off ! optimize 3 ! write o.glb", "dedup", "pipe load part.off ! optimize --dedup ! write o.glb"),
    ("E-VARIABLE", 'facetmill: 1\nstages: [{load: "${x}"}]', "params",
     'facetmill: 1\nparams: {x: {type: path, default: part.off}}\nstages: [{load: "${x}"}]'),
    ("E-WHEN", "facetmill: 1\nstages: [{load: part.off}, {relax: 1, when: maybe}]", "when: {closed: false}",
     "facetmill: 1\nstages: [{load: part.off}, {relax: 1, when: {closed: false}}]"),
    ("W-AMPLITUDE", "pipe load part.off ! crumple --amplitude 5 ! write o.ply", "--self_intersections avoid",
     "pipe load part.off ! crumple --amplitude 5 --self_intersections avoid ! write o.ply"),
    ("W-BLANK", "pipe load clip.gltf ! render r.png", "when", "pipe load clip.gltf ! render r.png --when.vertices.min 1"),
    ("W-CAP-OPEN", "pipe load open.off ! clip z=.5 --cap ! write o.ply", "clean --holes minimal",
     "pipe load open.off ! clean --holes minimal ! clip z=.5 --cap ! write o.ply"),
    ("E-BAKE-UV", "pipe load part.off ! bake 16 ! write o.ply", "use unwrap before bake",
     "pipe load part.off ! unwrap 64 ! bake 16 ! write o.ply"),
    ("E-UNWRAP-SET", "pipe generate cube ! unwrap --set 1", "--set 0", "pipe generate cube ! unwrap --set 0"),
    ("W-CHECK", "pipe load open.off ! validate --closed true --severity warn", "clean --holes minimal",
     "pipe load open.off ! clean --holes minimal ! validate --closed true --severity warn"),
    ("W-CLIP-ALL", "pipe load part.off ! clip z=9 --keep back ! write o.ply", "info prints the bounds",
     "pipe load part.off ! clip z=.5 --keep back ! write o.ply"),
    ("W-CLIP-NOTHING", "pipe load part.off ! clip z=9 --keep front", "--keep back", "pipe load part.off ! clip z=9 --keep back ! write o.ply"),
    ("W-COMBINE-IDLE", "pipe load '{part,far}.off' ! combine --operation difference --with far ! write o.ply", "transform --only",
     "pipe load '{part,far}.off' ! transform --only far --translate -9.5,-9.5,-9.5 ! combine --operation difference --with far ! write o.ply"),
    ("W-COMBINE-NOTHING", "pipe load '{part,far}.off' ! combine --operation intersection --with far", "overlap",
     "pipe load '{part,over}.off' ! combine --operation intersection --with over ! write o.ply"),
    ("W-CONVENTION", "render part.off ten.off -o p.png", "use --unit cm,mm", "render part.off ten.off -o p.png --unit cm,mm"),
    ("E-EXTRUDE", "pipe load terrain.off ! extrude 0.2 ! write o.ply", "give a level below -0.5",
     "pipe load terrain.off ! extrude -1 ! write o.ply"),
    ("E-VOLUME", "pipe load terrain.off ! volume", "give a level", "pipe load terrain.off ! volume .5"),
    ("W-VOLUME-MISSING", "pipe load terrain.off ! volume .5 --footprint 'POLYGON ((9 9, 20 9, 20 12))'", "use a smaller footprint",
     "pipe load terrain.off ! volume .5 --footprint 'POLYGON ((9 9, 15 9, 15 12))'"),
    ("W-CROP-ALL", "pipe load part.off ! crop 'POLYGON ((-9 -9, 9 -9, 9 9, -9 9))' ! write o.ply", "info prints the bounds",
     "pipe load part.off ! crop 'POLYGON ((-9 -9, .5 -9, .5 9, -9 9))' ! write o.ply"),
    ("W-CROP-NOTHING", "pipe load part.off ! crop 'POLYGON ((7 7, 9 7, 9 9))'", "info prints the bounds",
     "pipe load part.off ! crop 'POLYGON ((-9 -9, .5 -9, .5 9, -9 9))' ! write o.ply"),
    ("W-CRUMPLE-PARTS", "pipe load '{part,over}.off' ! crumple --amplitude .01 --self_intersections avoid ! write o.ply", "merge first",
     "pipe load '{part,over}.off' ! merge ! crumple --amplitude .01 --self_intersections avoid ! write o.ply"),
    ("W-CRUMPLE-ROUNDED", "pipe load part.off ! transform --translate 1e6,0,0 --bake ! crumple --amplitude .01 --self_intersections avoid ! write o.ply",
     "--self_intersections allow",
     "pipe load part.off ! transform --translate 1e6,0,0 --bake ! crumple --amplitude .01 --self_intersections allow ! write o.ply"),
    ("W-INSIDE-OUT", "pipe load inside.off ! measure --path m.json", "use orient", "pipe load inside.off ! orient ! measure --path m.json"),
    ("W-INSIDE-OUT", "pipe load inside.off ! section z=.5 --path s.svg", "use orient", "pipe load inside.off ! orient ! section z=.5 --path s.svg"),
    ("W-LINES", "pipe load lines.obj ! relax 1 ! write o.ply", "load --lines 1%", "pipe load lines.obj --lines 1% ! relax 1 ! write o.ply"),
    ("W-LINES", "pipe load part.off --lines 1% ! write o.ply", "leave lines out", "pipe load part.off ! write o.ply"),
    ("W-LODS", "pipe load wavy.off ! write o.glb --lods", "simplify --lods '[100%, 25%, 5%]'",
     "pipe load wavy.off ! simplify --lods '[100%, 25%, 5%]' ! write o.glb --lods"),
    ("W-NO-VALUE", "pipe load wavy.off ! render r.png --attribute wall_thickness", "thicken",
     "pipe load wavy.off ! thicken 1% ! render r.png --attribute wall_thickness"),
    ("W-NOTHING", "pipe load part.off", "write FILE", "pipe load part.off ! write o.ply"),
    ("W-ONLY", "pipe load part.off ! transform --scale 2 --only none ! write o.ply", "part",
     "pipe load part.off ! transform --scale 2 --only part ! write o.ply"),
    ("W-OPEN-SECTION", "pipe load open.off ! section z=.5 --path s.svg", "clean --holes minimal",
     "pipe load open.off ! clean --holes minimal ! section z=.5 --path s.svg"),
    ("W-OPEN-SECTION", "pipe load wavy.off ! section z=.5 --path s.svg", "thicken",
     "pipe load wavy.off ! thicken .1 ! section z=.5 --path s.svg"),
    ("W-ORIENT", "pipe load moebius.off ! orient ! write o.ply", "two-sided", "pipe load moebius.off ! two-sided ! orient ! write o.ply"),
    ("W-OVERRIDDEN", "pipe load stated.off --unit m ! write o.ply", "transform --unit m", "pipe load stated.off ! transform --unit m ! write o.ply"),
    ("W-PARTS", "pipe load '{part,far}.off' ! write o.ply", "write .glb", "pipe load '{part,far}.off' ! write o.glb"),
    ("W-PLACEHOLDER", "pipe load part.off ! foreach x=1 [ write 'o.{x.index}.ply' ]", "@{x.index}",
     "pipe load part.off ! foreach x=1 [ write 'o.@{x.index}.ply' ]"),
    ("W-POINTS", "pipe load points.ply ! relax 1 ! write o.ply", "only", "pipe load points.ply ! relax 1 --only '!points' ! write o.ply"),
    ("W-PROBE-OPEN", "pipe load open.off ! probe 0,0,0", "clean --holes minimal", "pipe load open.off ! clean --holes minimal ! probe 0,0,0"),
    ("W-RELAX-STOPPED", "pipe load wavy.off ! relax 1 --until 1e-3 ! write o.ply", "larger until", "pipe load wavy.off ! relax 1 --until 9 ! write o.ply"),
    ("W-SIMPLIFY-LIMIT", "pipe load wavy.off ! simplify 5% ! write o.ply", "--max_quadric_error off",
     "pipe load wavy.off ! simplify 5% --max_quadric_error off ! write o.ply"),
    ("W-SIMPLIFY-STOPPED", "pipe load islands.obj ! simplify 10% --max_quadric_error off ! write o.ply", "--method cluster",
     "pipe load islands.obj ! simplify 10% --method cluster ! write o.ply"),
    ("W-SIZE", "pipe load tiny.off ! probe 0,0,0", "transform --scale 1e120", None),
    ("W-SHELLS", "pipe load nested.off ! measure", "use orient", "pipe load nested.off ! orient ! measure"),
    ("W-SHELLS", "pipe load crossing.off ! measure", "clean --self_intersections union",
     "pipe load crossing.off ! orient ! clean --self_intersections union ! measure"),
    ("W-GEOCENTRIC", "pipe load utm.ply --unit m --up z ! write t/tileset.json", "transform --crs",
     "pipe load utm.ply --unit m --up z ! transform --crs EPSG:25832 ! write t/tileset.json"),
    ("E-CRS", "pipe load terrain.off --unit m --up z ! transform --crs EPSG:25832 ! write t.ply", "use place",
     "pipe load terrain.off --unit m --up z ! transform --place.lat 48.86 --place.lon 2.29 ! write t.ply"),
    ("W-MERGED", "pipe load '{animated,packets}.gltf' ! write o.glb", "load 'packets.gltf' alone", "pipe load packets.gltf ! write o.glb"),
    ("W-REST-POSE", "pipe load morph.gltf ! simplify --max_error 5% ! write o.glb", "simplify 50%",
     "pipe load morph.gltf ! simplify 50% ! write o.glb"),
    ("W-ROUNDED", "pipe load far.ply ! write o.stl", "PLY, OBJ or OFF with --precision full", "pipe load far.ply ! write o.ply --precision full"),
    ("W-DRACO", "pipe load points.ply ! write o.glb --draco", "meshopt", "pipe load points.ply ! write o.glb --meshopt"),
    ("W-FAR", "pipe load '{two,stray}.off' ! merge ! render r.png", "clean --components.keep 1",
     "pipe load '{two,stray}.off' ! merge ! clean --components.keep 1 ! render r.png"),
    ("W-ORIENT-OPEN", "pipe load plane.off ! orient ! write o.ply", "--method flip", "pipe load plane.off ! orient --method flip ! write o.ply"),
    ("W-MANIFOLD", "pipe load open.off ! write o.glb --mesh_manifold", "clean --holes minimal",
     "pipe load open.off ! clean --holes minimal ! write o.glb --mesh_manifold"),
    ("W-CLEAN", "pipe load flipped-open.off ! clean --holes minimal ! write o.ply", "use orient first",
     "pipe load flipped-open.off ! orient ! clean --holes minimal ! write o.ply"),
    ("W-ORIGIN", "pipe load weights.gltf ! write o.glb --origin 1,0,0", "use merge", "pipe --allow W-SKIN load weights.gltf ! merge ! write o.glb --origin 1,0,0"),
    ("W-SKIN", "pipe load weights.gltf ! merge ! write o.glb", "only", "pipe load '{weights.gltf,plain.gltf}' ! merge --only '!mesh_0_2' ! write o.glb"),
    ("W-ANIMATION", "pipe load moving.gltf ! write o.stl", "write .glb", "pipe load moving.gltf ! write o.glb"),
    ("W-SNAPPED", "pipe load utm.ply ! clip y=5000010.3 ! write o.ply", "--snap 0", "pipe load utm.ply ! clip y=5000010.3 --snap 0 ! write o.ply"),
    ("W-SPLIT-NOTHING", "pipe load wavy.off ! split diagonal ! write o.ply", "midpoint", "pipe load wavy.off ! split midpoint ! write o.ply"),
    ("W-SPLIT-STOPPED", "pipe load wavy.off ! split --max_edge .2 --passes 1 ! write o.ply", "more passes",
     "pipe load wavy.off ! split --max_edge .2 --passes 20 ! write o.ply"),
    ("W-THICKEN", "pipe load wavy.off ! thicken 5 ! write o.ply", "smaller thickness", "pipe load wavy.off ! thicken .1 ! write o.ply"),
    ("W-THICKEN-TOPOLOGY", "pipe load dumbbell.off ! triangulate ! thicken .6 --self_intersections resolve", "smaller thickness",
     "pipe load dumbbell.off ! triangulate ! thicken .2 --self_intersections resolve ! write o.ply"),
    ("W-LOST", "pipe load camera.gltf ! write o.stl", "write .glb", "pipe load camera.gltf ! write o.glb"),
    ("W-THICKEN-DRAIN", "pipe load part.off ! thicken .1 --drain .9 ! write o.ply", "smaller diameter",
     "pipe load part.off ! thicken .1 --drain .2 ! write o.ply"),
    ("W-THICKEN-THIN", "pipe load wavy.off ! thicken 5 ! write o.ply", "smaller thickness", "pipe load wavy.off ! thicken .1 ! write o.ply"),
    ("W-THICKEN-OPEN", "pipe load flipped.off ! thicken .1 ! write o.ply", "orient first", "pipe load flipped.off ! orient ! thicken .1 ! write o.ply"),
    ("W-TILE-PEGS", "pipe load part.off ! tile --fit .6 --pegs .4 ! write o.glb", "smaller diameter",
     "pipe load part.off ! tile --fit .6 --pegs .1 ! write o.glb"),
    ("W-UNITS", "pipe load part.off ! write o.glb", "load ... --unit mm --up z", "pipe load part.off --unit mm --up z ! write o.glb"),
    ("W-UNORIENTED", "pipe load flipped-box.off ! section x=.5 --path s.svg", "use orient", "pipe load flipped-box.off ! orient ! section x=.5 --path s.svg"),
    ("W-UP", "pipe load part.off ! transform --up z ! write o.ply", "load --up z", "pipe load part.off --up y ! transform --up z ! write o.ply"),
]

AT_THE_FILE = "the input is broken or lacks something: its maker mends it, at the place that the message names"
ENVIRONMENT = "needs a full disk, other permissions, another process or no memory; golden_faults and golden_bombs do that"
ITS_VALUES = "the message has the wrong value and the valid ones: there is no command"
NOT_A_FAULT = "the hint says when the message can be ignored, or how to keep what is lost: by another format"
ELSEWHERE = "a larger input provokes it: the tests of the stage, of io or of cells do"

NOT_FOLLOWED = {
    AT_THE_FILE: """E-3MF E-BUFFER E-CSV E-DXF E-ENCODING E-EXTENSION E-FOOTPRINT E-GEOJSON E-GLB E-GLTF E-GZIP E-INDEX
        E-JSON E-MESHOPT E-MTL E-NODES E-OBJ E-OFF E-PLY E-STL E-TABLE E-TILESET E-VERSION E-WKT E-ZIP E-ZSTD W-FORMAT
        W-IMAGE W-INCOMPLETE W-INDEX W-MTL W-NODES W-OPTIMIZE W-TEXTURE W-TRAILING W-3MF W-COUNT
        W-FOOTPRINT W-GLTF W-SPLATS E-ARCHIVE E-TAR E-REFERENCE E-MASS E-HULL
        E-IMPORT E-USDZ""",
    ENVIRONMENT: """E-AVIF E-BUG E-BUSY E-CHANGED E-INVARIANT E-KTX E-MEMORY E-PERMISSION E-READBACK E-SCRATCH E-SIZE E-SPACE
        E-WRITE W-CACHE W-PRUNE W-STATE""",
    ITS_VALUES: """E-CROP-CAP E-DEPFILE E-DRACO E-EXPANSION E-LIMIT E-LINES E-MASK E-NAME E-REQUIRES E-SAVE E-SOLVE
        E-THICKEN E-UNWRAP-FULL E-TRANSFORM E-TYPE E-YAML W-MASK E-WRAP E-WRAP-LARGE E-TIME""",
    NOT_A_FAULT: """W-ATTRIBUTE W-EXTENSION W-FACES W-GROUPS W-INSTANCES W-INSTANCING W-MATERIAL W-MESHOPT W-MORPH W-NAME
        W-MERGE-STAYS W-NAN W-NOT-FINITE W-SCENES W-SIMPLIFY-NOTHING W-SKIPPED W-TEXTURE-KEPT W-TEXTURES W-TILE-NOTHING
        W-VOLUME W-ALIGN W-HULL-FLAT W-NO-TANGENTS W-REMESH-NO-AREA W-REMESH-TOLERANCE W-TRANSFER-NONE W-TRANSFER-SEAMS
        W-TRANSFER-SKIN
        W-BAKE-FAR W-IMPORT W-OBJECTS W-UNWRAP-TEXTURES""",
    ELSEWHERE: """W-BASELINE W-BIND-POSE W-CELLS W-CRUMPLE-COARSE W-FANS W-PALETTE W-SECTION-CROSSES W-SIMPLIFY-VANISHED
        W-SPLIT-FOLDED W-SPLIT-SHARED W-SURFACE-LOST W-TRANSFORM
        E-BAKE-SOURCE E-LOOK E-UNWRAP-FINE W-BAKE-OVERLAP W-REMESH-INTERSECTS W-TEXTURE-ATLAS""",
}


class Hints(Case):
    def setUp(self):
        super().setUp()
        for name, text in FILES.items():
            self.write(name, text)
        (self.dir / "t.bin").write_bytes(struct.pack("<9f", 0, 0, 0, 1, 0, 0, 0, 1, 0))

    def typed(self, line):
        """A line of the command line, or a pipeline."""
        if re.match(r"(facetmill|stages): ", line):
            self.write("t.yaml", line + "\n")
            line = "run t.yaml"
        return self.mill(*shlex.split(line), expect=None)

    def test_hints_help(self):
        for message, provoking, hint, followed in FOLLOWED:
            with self.subTest(message=message, line=provoking):
                run = self.typed(provoking)
                self.assertIn(f"[{message}]", run.stderr)
                self.assertIn(hint, run.stderr[run.stderr.index(f"[{message}]"):])
                if followed:
                    run = self.typed(followed)
                    self.assertEqual(run.returncode, 0, f"{followed}\n{run.stderr}")
                    self.assertNotIn(f"[{message}]", run.stderr)

    def test_every_message_is_followed_or_has_a_reason(self):
        rows = [row[0] for row in FOLLOWED] + [name for names in NOT_FOLLOWED.values() for name in names.split()]
        known = [line.split()[0] for line in self.mill("explain").stdout.splitlines() if re.match(r"[EW]-", line)]
        self.assertEqual(sorted(set(rows)), sorted(known))
        self.assertEqual(sorted(set(row[0] for row in FOLLOWED) & set(rows[len(FOLLOWED):])), [])

    def test_hints_for_terrain_do_not_repair_it(self):
        run = self.typed("pipe load terrain.off ! section z=.25 --path s.json")
        self.assertIn("W-OPEN-SECTION", run.stderr)
        self.assertNotIn("W-INSIDE-OUT", run.stderr)
        self.assertIn("use only the lines of a terrain", run.stderr)
        self.assertNotIn("use clean first", run.stderr)


if __name__ == "__main__":
    main()
