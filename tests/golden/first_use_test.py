"""Commands that people type first: they work, or the message has the text to type."""

import base64
import json
import re
import struct

from support import Case, main

CUBE = """OFF
8 6 0
0 0 0
1 0 0
1 1 0
0 1 0
0 0 3
1 0 3
1 1 3
0 1 3
4 3 2 1 0
4 4 5 6 7
4 0 1 5 4
4 1 2 6 5
4 2 3 7 6
4 3 0 4 7
"""


class FirstUse(Case):
    def setUp(self):
        super().setUp()
        self.write("part.off", CUBE)

    def test_a_folder_does_not_hide_a_ready_pipeline(self):
        self.mill("run", "web", "-D", "input=part.off", "-o", "web")
        first = self.files(self.dir / "web")
        self.mill("run", "web", "-D", "input=part.off", "-o", "web")
        self.assertEqual(self.files(self.dir / "web"), first)
        (self.dir / "repair").mkdir()
        self.mill("check", "repair")
        self.mill("plan", "repair", "part.off")
        self.mill("batch", "repair", "--input", "part.off", "-o", "repair")

    def test_a_mesh_after_the_pipeline_is_its_input(self):
        self.mill("run", "web", "part.off", "-o", "a")
        self.mill("run", "web", "-D", "input=part.off", "-o", "b")
        self.assertEqual(self.files(self.dir / "a"), self.files(self.dir / "b"))
        self.assertIn("input = part.off", self.mill("plan", "web", "part.off").stdout)
        self.mill("check", "web", "part.off")
        self.assertIn("no file 'none.stl'", self.mill("run", "web", "none.stl", expect=3).stderr)
        hint = self.mill("run", "web", "part.off", "b.off", expect=2).stderr
        self.assertIn("facetmill batch web --input part.off --input b.off -o out", hint)
        self.assertIn("facetmill run web part.off", self.mill("run", "part.off", expect=2).stderr)
        self.assertIn("is given twice", self.mill("run", "web", "part.off", "-D", "input=part.off", expect=2).stderr)

    def test_a_binary_file_is_not_printed(self):
        (self.dir / "data").write_bytes(b"some header" + bytes(range(256)))
        for command in (["run", "data"], ["run", "web", "data"], ["check", "data"]):
            text = self.mill(*command, expect=2).stderr
            self.assertIn("E-YAML", text)
            self.assertNotIn("some header", text)

    def test_info_of_many_shows_the_readable_files(self):
        self.write("b.off", CUBE)
        self.write("bad.off", "OFF\n3 1 0\n0 0 0\n")
        run = self.mill("info", "--json", "part.off", "bad.off", "none.off", "b.off", expect=6)
        self.assertEqual([(r["file"], r.get("volume")) for r in json.loads(run.stdout)],
                         [("part.off", 3), ("bad.off", None), ("none.off", None), ("b.off", 3)])
        self.assertIn("bad.off", run.stderr)
        self.assertIn("none.off", run.stderr)
        self.assertEqual(self.mill("info", "part.off", "bad.off", expect=6).stdout.count("volume"), 1)
        self.assertEqual(json.loads(self.mill("info", "--json", "part.off").stdout)["file"], "part.off")

    def test_info_of_a_skinned_mesh_has_the_area_that_is_drawn(self):
        # A triangle of area 0.5, whose joint is 100 times as large.
        data = struct.pack("<9f", 0, 0, 0, 1, 0, 0, 0, 1, 0) + bytes(12) + struct.pack("<12f", *(1, 0, 0, 0) * 3)
        accessor = {"count": 3, "type": "VEC4"}
        self.write("skin.gltf", json.dumps({
            "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 1]}],
            "nodes": [{"mesh": 0, "skin": 0}, {"scale": [100, 100, 100]}], "skins": [{"joints": [1]}],
            "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "JOINTS_0": 1, "WEIGHTS_0": 2}}]}],
            "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0],
                           "max": [1, 1, 0]},
                          {"bufferView": 1, "componentType": 5121, **accessor},
                          {"bufferView": 2, "componentType": 5126, **accessor}],
            "bufferViews": [{"buffer": 0, "byteOffset": at, "byteLength": size} for at, size in ((0, 36), (36, 12), (48, 48))],
            "buffers": [{"byteLength": len(data),
                         "uri": "data:application/octet-stream;base64," + base64.b64encode(data).decode()}]}))
        info = json.loads(self.mill("info", "--json", "skin.gltf").stdout)
        self.assertEqual((info["area"], info["drawn_area"]), (.5, 5000))
        self.assertRegex(self.mill("info", "skin.gltf").stdout, r"drawn_area +5000")
        info = json.loads(self.mill("info", "--json", "part.off").stdout)
        self.assertEqual(info["area"], info["drawn_area"])

    def test_foreach_over_one_part(self):
        self.mill("pipe", "load", "part.off", "!", "foreach", "part=*", "[", "write", "one.ply", "]")
        self.assertTrue((self.dir / "one.ply").exists())
        self.write("b.off", CUBE)
        run = self.mill("pipe", "load", "{part,b}.off", "!", "foreach", "part=*", "[", "write", "two.ply", "]", expect=2)
        self.assertIn("two.@{part}.ply", run.stderr)
        self.assertFalse((self.dir / "two.ply").exists())

    def test_a_report_in_the_output_folder(self):
        folder = str(self.dir / "checked")
        for output, report in (("checked", "checked/j.xml"), ("checked/", "./checked/j.xml"), ("./checked", "j.xml"),
                               (folder, "checked/j.xml"), ("checked", folder + "/j.xml")):
            self.mill("pipe", "-o", output, "--report", report, "--timings", report.replace(".xml", ".json"), "load",
                      "part.off", "!", "write", "x.ply")
            self.assertEqual(sorted(self.files(self.dir / "checked")), ["j.json", "j.xml", "x.ply"], (output, report))
            for file in (self.dir / "checked").iterdir():
                file.unlink()

    def test_a_wrong_option_writes_no_report_of_the_pipeline(self):
        for wrong in ("size=3", "max_size=many"):
            self.mill("run", "web", "part.off", "-D", wrong, expect=2)
            self.assertEqual(sorted(self.files()), ["part.off"])
        self.mill("run", "web", "part.off", "-D", "size=3", "--report", "asked.json", expect=2)
        self.assertEqual(sorted(self.files()), ["asked.json", "part.off"])

    def test_alternatives_in_patterns(self):
        self.mill("pipe", "load", "part.off", "!", "write", "p.stl")
        self.mill("batch", "web", "--input", "*.{off,obj,stl}", "-o", "out")
        self.assertEqual(sorted(p.name for p in (self.dir / "out").glob("*.glb")), ["p.glb", "part.glb"])
        self.mill("batch", "web", "--input", "**/{p,none}.{st{l,p},obj}", "-o", "two")
        self.assertEqual(sorted(p.name for p in (self.dir / "two").glob("*.glb")), ["p.glb"])
        self.assertIn("--input '**/*.obj'", self.mill("batch", "web", "--input", "*.obj", "-o", "out", expect=3).stderr)
        self.assertIn("no folder 'x'", self.mill("batch", "web", "--input", "x/*.obj", "-o", "out", expect=3).stderr)

    def test_export_lists_only_existing_files(self):
        self.write("m.obj", "mtllib none.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
        for engine in ("ninja", "make", "snakemake"):
            text = self.mill("export", "--to", engine, "web", "--input", "m.obj", "-o", "out").stdout
            self.assertIn("m.obj", text)
            optional = r'\$\(wildcard none\.mtl\)|"absent": \[\s*"none\.mtl"\s*\]'  # rerun when it appears
            self.assertNotIn("none.mtl", re.sub(optional, "", text))

    def test_render_takes_the_conventions_of_files(self):
        size = ["--width", "60", "--height", "60", "--view", "front"]
        for name, up in (("z", ["--up", "z"]), ("y", ["--up=y"]), ("load", [])):
            self.mill("render", *up, "part.off", "-o", f"{name}.png", *size)
        self.mill("pipe", "load", "part.off", "--up", "z", "!", "render", "piped.png", *size)
        files = self.files()
        self.assertEqual(files["z.png"], files["piped.png"])
        self.assertNotEqual(files["z.png"], files["y.png"])
        # The same box in metres and in millimetres, once as the first file and once as the second.
        self.mill("pipe", "load", "part.off", "--unit", "m", "!", "write", "metres.glb")
        self.mill("pipe", "load", "part.off", "--unit", "m", "!", "transform", "--unit", "mm", "!", "write", "mm.stl")
        self.mill("pipe", "load", "part.off", "--unit", "m", "--up", "y", "!", "write", "both.glb")
        pairs = {"a": ("mm.stl", "metres.glb"), "b": ("metres.glb", "mm.stl"), "c": ("both.glb", "metres.glb")}
        for name, pair in pairs.items():
            self.mill("render", *pair, "-o", f"{name}.png", *size, "--unit", "mm", "--up", "y", "-q")
        files = self.files()
        self.assertEqual(len({files[f"{name}.png"] for name in pairs}), 1)
        self.mill("render", "part.off", "--up", "x", "-o", "x.png", expect=2)
        self.mill("render", "part.off", "--unit", "K", "-o", "k.png", *size)  # of an attribute, not of the file


if __name__ == "__main__":
    main()
