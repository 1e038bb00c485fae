"""Runs of facetmill in which calls of the system are made to fail: what is there before, the command, and what it leaves."""

import dataclasses
import gzip
import json
import struct
import zlib

CUBE = """OFF
8 6 0
0 0 0
1 0 0
1 1 0
0 1 0
0 0 1
1 0 1
1 1 1
0 1 1
4 3 2 1 0
4 4 5 6 7
4 0 1 5 4
4 1 2 6 5
4 2 3 7 6
4 3 0 4 7
"""
GENERATE = ["pipe", "-j", "1", "generate", "sphere", "--faces", "320", "!", "write", "in.ply"]
TRIANGLE = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"


@dataclasses.dataclass
class Scenario:
    name: str
    files: dict  # by relative name, their bytes or text, before any run
    command: list  # the arguments of the run in which something fails
    groups: list  # of outputs: each all new, or all as they were
    before: list = dataclasses.field(default_factory=list)  # arguments of runs that succeed first
    reports: tuple = ()  # whole, or as they were; what is in them depends on what failed
    state: tuple = ()  # patterns of files that say nothing to users: a cache, a journal
    stdin: bytes = None


def png(red, green, blue):
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", 1, 1, 8, 2, 0, 0, 0))
            + chunk(b"IDAT", zlib.compress(bytes([0, red, green, blue]))) + chunk(b"IEND", b""))


def textured():
    """A glTF file with its buffer and its texture beside it."""
    document = {
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "material": 0}]}],
        "materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}], "textures": [{"source": 0}],
        "images": [{"uri": "tex.png"}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0],
                       "max": [1, 1, 0]}],
        "bufferViews": [{"buffer": 0, "byteLength": 36}], "buffers": [{"uri": "t.bin", "byteLength": 36}]}
    return {"t.gltf": json.dumps(document), "t.bin": struct.pack("<9f", 0, 0, 0, 1, 0, 0, 0, 1, 0),
            "tex.png": png(200, 30, 30)}


def pipeline(stages, more=""):
    return f"facetmill: 1\nstages: [{stages}]\n{more}"


def scenarios():
    """Each with one thread, so that calls have an order. FACETMILL_CACHE is `cache` where that is among the state, else off."""
    yield Scenario("run", {"c.off": CUBE, "o/a.ply": "old", "p.yaml": pipeline("{load: c.off}, {write: a.ply}")},
                   ["run", "p.yaml", "-o", "o", "-j", "1"], [["o/a.ply"]])
    yield Scenario("pipe", {"c.off": CUBE},
                   ["pipe", "-j", "1", "load", "c.off", "!", "triangulate", "!", "write", "deep/new/a.glb"],
                   [["deep/new/a.glb"]])
    yield Scenario("textures", {**textured(), "o/o.gltf": "old", "o/o.bin": "old", "o/o.tex.png": "old"},
                   ["pipe", "-j", "1", "-o", "o", "load", "t.gltf", "!", "write", "o.gltf"],
                   [["o/o.gltf", "o/o.bin", "o/o.tex.png"]])
    yield Scenario("several", {"c.off": CUBE, "a.ply": "old", "b.stl": "old", "p.yaml": pipeline(
        "{load: c.off}, {write: a.ply}, {triangulate: {}}, {write: b.stl}, {write: sub/c.obj}, {write: sub/d.glb}")},
                   ["run", "p.yaml", "-j", "1"], [["a.ply", "b.stl", "sub/c.obj", "sub/d.glb"]])
    yield Scenario("reports", {"c.off": CUBE, "a.ply": "old", "r.json": "{}", "p.yaml": pipeline(
        "{load: c.off}, {validate: {closed: true}}, {write: a.ply}",
        "report: [r.json, r.html, r.txt, r.xml]\n")},
                   ["run", "p.yaml", "-j", "1", "--depfile", "p.d"], [["a.ply"]],
                   reports=("r.json", "r.html", "r.txt", "r.xml", "p.d"))
    yield Scenario("measured", {"c.off": CUBE, "m.json": "old", "p.yaml": pipeline(
        "{load: c.off}, {triangulate: {}}, {measure: {path: m.json}}, {render: {path: v.png, width: 32, height: 32}}, "
        "{write: {path: o.glb, draco: true}}")},
                   ["run", "p.yaml", "-j", "1"], [["m.json", "v.png", "o.glb"]])
    yield Scenario("in place", {"c.off": CUBE, "p.yaml": pipeline("{load: c.off}, {write: a.ply}, {write: b.off}")},
                   ["run", "p.yaml", "-j", "1", "--restat"], [["a.ply", "b.off"]],
                   before=[["run", "p.yaml", "-j", "1"],
                           ["pipe", "-j", "1", "load", "c.off", "!", "triangulate", "!", "write", "a.ply"]])
    yield Scenario("stream", {"c.off.gz": gzip.compress(CUBE.encode(), mtime=0), "a.ply": "old"},
                   ["pipe", "-j", "1", "load", "c.off.gz", "!", "load", "-", "!", "write", "a.ply", "!", "write", "-",
                    "--format", "ply"], [["a.ply"]], stdin=TRIANGLE.encode())
    yield Scenario("batch", {"in/c.off": CUBE, "in/t.off": TRIANGLE, "o/c.ply": "old", "p.yaml": pipeline(
        "{load: '${input}'}, {triangulate: {}}, {write: '${input.stem}.ply'}, {write: '${input.stem}.stl'}",
        "params: {input: path}\nreport: '${input.stem}.json'\n")},
                   ["batch", "p.yaml", "--input", "in/*.off", "-o", "o", "-j", "1"],
                   [["o/c.ply", "o/c.stl"], ["o/t.ply", "o/t.stl"]], reports=("o/c.json", "o/t.json"),
                   state=("o/.facetmill-batch.*.jsonl",))
    chain = pipeline("{load: c.off}, {triangulate: {}}, {split: midpoint}, {relax: 3}, {write: a.ply}")
    yield Scenario("cache, cold", {"c.off": CUBE, "a.ply": "old", "p.yaml": chain},
                   ["run", "p.yaml", "-j", "1", "--cache-everything"], [["a.ply"]], state=("cache/*",))
    yield Scenario("cache, warm", {"c.off": CUBE, "p.yaml": chain},
                   ["run", "p.yaml", "-j", "1", "--cache-everything", "-o", "o"], [["o/a.ply"]],
                   before=[["run", "p.yaml", "-j", "1", "--cache-everything"]], state=("cache/*",))


# Of each stage that works on a mesh, one line that it does something for.
STAGES = {
    "clean": "clean", "clip": "clip z=50% --cap", "crop": "crop [[0.2,0.2],[0.8,0.2],[0.8,0.8]]",
    "crumple": "crumple 1%", "ensure": "ensure --closed", "measure": "measure", "merge": "merge",
    "nest": "nest 100", "optimize": "optimize", "orient": "orient",
    "probe": "probe [0.5,0.5,0.5]", "relax": "relax 2", "section": "section z=50% --path cut.svg",
    "separate": "separate", "simplify": "simplify 50%", "split": "split midpoint", "thicken": "thicken 5%",
    "tile": "tile 0.6", "transform": "transform --scale 2", "triangulate": "triangulate", "two-sided": "two-sided",
    "validate": "validate --closed", "render": "render v.png --width 64 --height 64"}


def stage_scenarios():
    """A run of each stage, most on a small closed mesh; the first loads and writes only."""
    mesh = "in.ply"
    yield Scenario("load and write", {}, ["pipe", "-j", "1", "load", mesh, "!", "write", "a.ply"], [["a.ply"]],
                   before=[GENERATE])
    yield Scenario("generate", {}, ["pipe", "-j", "1", "generate", "icosphere", "--subdivisions", "1", "!", "write", "a.ply"], [["a.ply"]])
    yield Scenario("textures", textured(), ["pipe", "-j", "1", "load", "t.gltf", "!", "textures", "--format", "webp", "!",
                                            "write", "a.glb"], [["a.glb"]])
    for name, line in STAGES.items():
        beside = [word for word in line.split() if word.endswith((".svg", ".png"))]
        yield Scenario(name, {}, ["pipe", "-j", "1", "load", mesh, "!", *line.split(), "!", "write", "a.glb"],
                       [["a.glb", *beside]], before=[GENERATE])
