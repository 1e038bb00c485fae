"""Every stage's result, run for run, follows the schema that its declaration gives, and every declared field is seen
in one of the runs: a field that nothing writes, or a key that nothing declares, fails."""

import base64
import json
import shutil
import struct
import unittest
import zlib

from support import Case, SOURCE, main

try:
    import jsonschema
except ImportError:
    jsonschema = None

# Two closed cubes in one OBJ.
CUBES = "".join(
    f"o {name}\n" + "".join(f"v {x + i} {j} {k}\n" for k in (0, 1) for j in (0, 1) for i in (0, 1))
    + "".join("f " + " ".join(str(8 * n + c) for c in face) + "\n"
              for face in ((1, 3, 4, 2), (5, 6, 8, 7), (1, 2, 6, 5), (3, 7, 8, 4), (1, 5, 7, 3), (2, 4, 8, 6)))
    for n, (name, x) in enumerate((("a", 0), ("b", 3))))
OPEN = "OFF\n4 3 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n"
FLIPPED = OPEN.replace("3 2 0 3", "3 0 2 3")  # one face is turned round
STEP = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 1\n3 0 1 2\n"
HOURGLASS = ("OFF\n7 8 0\n0 0 0\n1 0 1\n0 1 1\n-1 -1 1\n1 0 -1\n0 1 -1\n-1 -1 -1\n"
             "3 0 2 1\n3 0 3 2\n3 0 1 3\n3 1 2 3\n3 0 4 5\n3 0 5 6\n3 0 6 4\n3 4 6 5\n")  # they touch at a vertex
CROSSED = "OFF\n8 6 0\n" + "".join(f"{x} {y} {z}\n" for z in (0, 1) for x, y in ((0, 0), (2, 2), (2, 0), (0, 1))) + (
    "4 0 1 5 4\n4 1 2 6 5\n4 2 3 7 6\n4 3 0 4 7\n4 3 2 1 0\n4 4 5 6 7\n")  # a prism over a bow tie



def png(width, height):
    """A PNG in colour, with little noise."""
    def chunk(name, data):
        return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))
    rows = b"".join(b"\0" + bytes((x * x + y * c) % 251 for x in range(width) for c in (3, 5, 7)) for y in range(height))
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0))
            + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))


def data_uri(data):
    return "data:image/png;base64," + base64.b64encode(data).decode()


# A triangle with an image, and one that is broken.
TEXTURED = {
    "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "material": 0}]}],
    "materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}, "normalTexture": {"index": 1}}],
    "textures": [{"source": 0}, {"source": 1}],
    "images": [{"uri": data_uri(data)} for data in (png(24, 16), b"no PNG")],
    "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]}],
    "bufferViews": [{"buffer": 0, "byteLength": 36}],
    "buffers": [{"byteLength": 36, "uri": "data:application/octet-stream;base64,"
                 + base64.b64encode(struct.pack("<9f", 0, 0, 0, 1, 0, 0, 0, 1, 0)).decode()}]}

# A triangle that stays, and one that moves along a line in three keys, of which two are enough.
MOVING = {
    "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 1]}], "nodes": [{"mesh": 0}, {"mesh": 0}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
    "animations": [{"samplers": [{"input": 1, "output": 2}],
                    "channels": [{"sampler": 0, "target": {"node": 1, "path": "translation"}}]}],
    "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]},
                  {"bufferView": 1, "componentType": 5126, "count": 3, "type": "SCALAR", "min": [0], "max": [2]},
                  {"bufferView": 2, "componentType": 5126, "count": 3, "type": "VEC3"}],
    "bufferViews": [{"buffer": 0, "byteLength": 36}, {"buffer": 0, "byteOffset": 36, "byteLength": 12},
                    {"buffer": 0, "byteOffset": 48, "byteLength": 36}],
    "buffers": [{"byteLength": 84, "uri": "data:application/octet-stream;base64,"
                 + base64.b64encode(struct.pack("<21f", 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 1, 2, 0, 0, 0, 1, 0, 0, 2, 0, 0)).decode()}]}

RUNS = [
    "load moving.gltf ! optimize --max_motion 1% --resample 2 ! merge",
    "load cubes.obj ! thicken 0.1 ! section z=0.5",
    "load crossed.off ! section z=0.5",
    "load cubes.obj --unit mm --up z ! write o.3mf --origin 1,2,3",
    "load flipped.off ! clean --holes minimal",
    "load hourglass.off ! clean --precision single",
    "load cubes.obj ! transform --unit mm --fit 12 ! merge ! separate ! two-sided ! two-sided material",
    "load cubes.obj ! merge body --weld ! orient ! triangulate quads ! triangulate ! ensure --closed",
    "load cubes.obj ! relax 2 ! relax --until 1% ! crumple 1% --self_intersections avoid ! crumple --grid 1",
    "load cubes.obj ! triangulate ! split ! split --max_edge 0.4 ! split --min_angle 40deg ! split --max_faces 300",
    "load cubes.obj ! thicken 0.1 ! thicken 0.1 --self_intersections false",
    "load cubes.obj ! thicken 0.05 --mode edges",
    "load cubes.obj ! clip z=0.5 --cap ! clip x=0.25 --space local ! clean --holes minimal --self_intersections all",
    "load cubes.obj ! crop [[0,0],[4,0],[4,0.7],[0,0.7]] --cap ! tile 0.4 --axes xyz",
    "load cubes.obj ! tile 0.4",
    "load cubes.obj ! generate icosphere ! combine difference --with icosphere ! combine",
    "load open.off ! clip z=0.5 --cap ! clean --holes minimal ! measure ! probe 0,0,0",
    "load cubes.obj ! section z=0.5 --hatch 10% ! section --count 4 ! section z=9",
    "load open.off ! section z=0.5 ! section --count 3",
    "load cubes.obj ! volume 0.5",
    "load step.off ! extrude -1 ! transform --place.lat 48 --place.lon 2 ! write p.ply",
    "load step.off ! volume 0.25 --footprint [[0,0],[1,0],[0,1]] ! volume --with step.off",
    "load cubes.obj ! measure --density 2 ! measure --path m.json ! probe 0.5,0.5,0.5 ! probe --points_of a",
    "load cubes.obj ! probe --segments 0.5,0.5,-1,0.5,0.5,2 ! probe --rays 0.5,0.5,-1,0,0,1 ! probe --along NORMAL",
    "load cubes.obj ! probe --segments 0.5,0.5,-1,0.5,0.5,2 --face 0 ! probe --rays 9,9,9,0,0,1 --face 0",
    "load cubes.obj ! render --path p.png ! measure --attributes mean_curvature ! render --path q.png --attribute mean_curvature",
    "load cubes.obj ! triangulate ! render --path p.png --attribute deviation ! measure --attributes deviation,wall_thickness",
    "load cubes.obj --unit mm --up z ! write a.glb ! write b.glb --draco true ! write q.glb --quantize true ! write c.stl --unit m",
    "load cubes.obj ! validate --closed ! validate --closed --baseline known.json --update_baseline",
    "generate sphere ! simplify 50% ! simplify --faces 600 --topology allow ! simplify --max_error 1%",
    "generate sphere ! simplify --ratio 50% --self_intersections count ! simplify 50% --method cluster",
    "generate sphere ! simplify --vertices 500 --method shortest-edge --certify ! simplify --lods 50%,20%",
    "generate sphere ! simplify --ratio 50% --ensure.deviation 10% ! ensure --deviation 10%",
    "load touching.obj ! simplify 50%",
    "load flipped.off ! split ! simplify 60%",
    "generate icosphere --subdivisions 4 ! write tileset.json --tiles.faces 500 --draco",
    "load textured.gltf ! optimize ! textures 8 --format webp ! write t.glb",
    "load atlas.gltf ! textures 128 --atlas ! optimize ! write at.glb",
    "load cubes.obj ! optimize",
    "load cubes.obj ! normals --with open.off ! remesh 0.3",
    "load cubes.obj ! clean --hidden --components.min_size 1",
    "load open.off ! align cubes.obj ! transfer cubes.obj",
    "generate sphere ! hull box ! hull sphere ! hull capsule ! hull --max_vertices 20 --engine unreal",
    "generate torus ! hull --max_parts 2",
    "generate torus ! wrap 10%",
    "load textured.gltf ! unwrap 64 ! bake 16 --samples 2 --height h.png --thickness t.png ! look 50% --pixels 32 --path l.png",
    "generate cube --unit mm ! unwrap --texels_per_m 20000",
    "load AnimatedMorphCube.gltf ! split ! simplify 50%",
    "load mapped.gltf ! fit f.glb --look 20% --pixels 64",
    "generate cube --unit mm ! tile --fit .6mm --pegs .1mm ! nest 20mm",
    "generate sphere --unit mm ! thicken .1mm --drain .2mm ! transform --orient_for printing --fit 1mm --shrink_only",
    "generate cube --name a ! generate sphere --name b ! transform --scale 0.01 --only b ! write d.glb --draco.grid scene ! write e.glb --quantize.grid scene ! validate --for web ! write f.glb",
]


def seen(schema, value, prefix, names):
    """Adds the dotted names of the keys in the value, with [] behind those of lists."""
    for key, one in value.items():
        name = prefix + key
        if isinstance(one, list) and one and isinstance(one[0], dict):
            names.add(name + "[]")
            for item in one:
                seen(schema, item, name + "[].", names)
        else:
            names.add(name + ("[]" if isinstance(one, list) else ""))
            if isinstance(one, dict):
                seen(schema, one, name + ".", names)


@unittest.skipIf(jsonschema is None, "python3-jsonschema is missing")
class Results(Case):
    def setUp(self):
        super().setUp()
        self.write("cubes.obj", CUBES)
        self.write("open.off", OPEN)
        self.write("flipped.off", FLIPPED)
        self.write("step.off", STEP)
        self.write("hourglass.off", HOURGLASS)
        self.write("crossed.off", CROSSED)
        self.write("textured.gltf", json.dumps(TEXTURED))
        self.write("moving.gltf", json.dumps(MOVING))
        for file in (SOURCE / "tests/data/morph-cube").iterdir():
            shutil.copy(file, self.dir)
        # The same triangle with texture coordinates, a normal map and larger images, which fit makes smaller.
        mapped = json.loads(json.dumps(TEXTURED))
        mapped["images"] = [{"uri": data_uri(png(200, 160))}, {"uri": data_uri(png(160, 200))}]
        mapped["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_0"] = 1
        mapped["accessors"].append({"bufferView": 1, "componentType": 5126, "count": 3, "type": "VEC2"})
        mapped["bufferViews"].append({"buffer": 1, "byteLength": 24})
        uvs = base64.b64encode(struct.pack("<6f", 0, 0, 1, 0, 0, 1)).decode()
        mapped["buffers"].append({"byteLength": 24, "uri": "data:application/octet-stream;base64," + uvs})
        self.write("mapped.gltf", json.dumps(mapped))
        # The same triangle with three materials, of which two can be merged.
        first, second = mapped["materials"][0], {
            "pbrMetallicRoughness": {"baseColorTexture": {"index": 1}}, "normalTexture": {"index": 0}}
        mapped["materials"] = [first, second, first | {"alphaMode": "BLEND"}]
        mapped["meshes"][0]["primitives"] = [mapped["meshes"][0]["primitives"][0] | {"material": m} for m in range(3)]
        self.write("atlas.gltf", json.dumps(mapped))
        # Two grids of 4 x 4 quads that share an edge.
        grid = "".join(f"o {n}\n" + "".join(f"v {4 * k + i} {j} 0\n" for j in range(5) for i in range(5))
                       + "".join(f"f {b} {b + 1} {b + 6} {b + 5}\n" for j in range(4) for i in range(4)
                                 for b in [25 * k + 5 * j + i + 1]) for k, n in enumerate("ab"))
        self.write("touching.obj", grid)

    def test_every_result_follows_its_schema_and_every_field_is_seen(self):
        schema = json.loads(self.mill("schema", "report").stdout)
        jsonschema.Draft202012Validator.check_schema(schema)
        validator = jsonschema.Draft202012Validator(schema)
        declared = {s["name"]: {row["name"] for row in s["result"]}
                    for s in json.loads(self.mill("stages", "--json").stdout)}
        found = {name: set() for name in declared}
        for name in declared:
            self.assertIn(f"result.{name}", schema["$defs"])
            self.assertFalse(schema["$defs"][f"result.{name}"]["additionalProperties"], name)
        for line in RUNS:
            self.mill("pipe", "--report", "r.json", "--quiet", *line.split())
            report = json.loads((self.dir / "r.json").read_text())
            validator.validate(report)
            for stage in report["stages"]:
                seen(schema, stage["result"], "", found[stage["stage"]])
        ran = {word for line in RUNS for word in line.replace("!", " ").split()} & declared.keys()
        self.assertEqual(ran, declared.keys(), "a stage that no run has")
        for name, fields in declared.items():
            names = {n.removesuffix("[]") for n in found[name]}
            missing = sorted(n for n in fields if n.removesuffix("[]") not in names)
            self.assertEqual(missing, [], f"{name}: fields that no run shows")

    def test_images_are_the_same_for_any_number_of_threads(self):
        images = [{"uri": data_uri(png(300, 200))}, {"uri": data_uri(png(160, 160))}]
        self.write("two.gltf", json.dumps(TEXTURED | {"images": images}))
        for threads in ("1", "3"):
            self.mill("pipe", "-q", "-j", threads, "-o", threads, "load", "two.gltf", "!", "textures", "100", "--format",
                      "webp", "!", "write", "o.glb")
        self.assertEqual(self.files(self.dir / "1"), self.files(self.dir / "3"))
        for threads in ("1", "2"):
            self.mill("pipe", "-q", "-j", threads, "-o", "atlas" + threads, "load", "atlas.gltf", "!", "textures", "128",
                      "--atlas", "!", "write", "o.glb")
        self.assertEqual(self.files(self.dir / "atlas1"), self.files(self.dir / "atlas2"))

    def test_an_undeclared_key_is_refused(self):
        schema = json.loads(self.mill("schema", "report").stdout)
        self.mill("pipe", "--report", "r.json", "--quiet", "load", "cubes.obj", "!", "merge")
        report = json.loads((self.dir / "r.json").read_text())
        report["stages"][1]["result"]["surprise"] = 1
        self.assertTrue(list(jsonschema.Draft202012Validator(schema).iter_errors(report)))


if __name__ == "__main__":
    main()
