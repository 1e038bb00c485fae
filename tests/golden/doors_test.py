"""facetmill convert, view and fix: built-in pipelines as commands. And what new, docs and run say about built-in pipelines."""

import os
import time

from first_use_test import CUBE
from support import Case, main


class Doors(Case):
    def setUp(self):
        super().setUp()
        self.write("part.off", CUBE)
        self.write("open.off", CUBE.replace("8 6 0", "8 5 0").replace("4 3 0 4 7\n", ""))

    def test_convert(self):
        self.mill("convert", "part.off", "out.ply")
        self.mill("pipe", "load", "part.off", "!", "write", "piped.ply")
        files = self.files()
        self.assertEqual(sorted(files), ["open.off", "out.ply", "part.off", "piped.ply"])
        self.assertEqual(files["out.ply"], files["piped.ply"])
        self.mill("convert", "part.off", "small.glb", "--unit", "mm", "--up", "z", "--meshopt")
        self.assertTrue(b"KHR_mesh_quantization" in (self.dir / "small.glb").read_bytes())
        self.assertIn("did you mean 'mm'", self.mill("convert", "part.off", "a.glb", "--unit", "mn", expect=2).stderr)
        self.assertIn("not with ply", self.mill("convert", "part.off", "a.ply", "--draco", expect=2).stderr)
        self.assertIn("OUT is required", self.mill("convert", "part.off", expect=2).stderr)
        self.assertIn("no file 'none.stl'", self.mill("convert", "none.stl", "a.glb", expect=3).stderr)

    def test_saved_doors_run_again(self):
        (self.dir / "saved").mkdir()
        self.mill("convert", "part.off", "a.glb", "--unit", "mm", "--save", "saved/convert.yaml")
        self.mill("fix", "open.off", "a.ply", "--save", "saved/fix.yaml")
        first = self.files()
        for name in ("a.glb", "a.ply"):
            (self.dir / name).unlink()
        self.mill("run", "saved/convert.yaml")
        self.mill("run", "saved/fix.yaml")
        again = self.files()
        for name in ("a.glb", "a.ply"):
            self.assertEqual(first[name], again[name], name)
        self.mill("run", "saved/convert.yaml", "open.off", "-D", "output=b.glb")
        self.assertNotEqual(self.files()["b.glb"], first["a.glb"])
        self.assertIn("A mesh file becomes another file", self.mill("convert", "part.off", "c.glb", "--save", "-").stdout)

    def test_view(self):
        self.write("bin/xdg-open", f'#!/bin/sh\necho "$1" > "{self.dir}/opened"\n').chmod(0o755)
        desktop = {"PATH": f"{self.dir}/bin:{os.environ['PATH']}", "DISPLAY": ":0", "BROWSER": ""}
        said = self.mill("view", "part.off", env=desktop).stderr
        page = str(self.dir / "part.html")
        self.assertIn(f"opened {page}", said)
        for _ in range(100):
            if (self.dir / "opened").exists() and (self.dir / "opened").read_text():
                break
            time.sleep(0.1)
        self.assertEqual((self.dir / "opened").read_text(), page + "\n")
        self.assertTrue('class="viewer"' in (self.dir / "part.html").read_text())
        (self.dir / "opened").unlink()
        said = self.mill("view", "part.off", "--no-open", "-o", "other.html", env=desktop).stderr
        self.assertIn(f"open {self.dir / 'other.html'} in a browser", said)
        none = {"PATH": desktop["PATH"], "DISPLAY": "", "WAYLAND_DISPLAY": "", "BROWSER": ""}
        self.assertIn(f"open {page} in a browser", self.mill("view", "part.off", env=none).stderr)
        time.sleep(0.3)
        self.assertFalse((self.dir / "opened").exists())
        self.assertIn("E-REPORT", self.mill("view", "part.off", "-o", "x.json", expect=2).stderr)
        self.mill("view", "none.off", env=desktop, expect=3)

    def test_fix(self):
        self.mill("fix", "open.off")
        self.assertIn("closed              yes", self.mill("info", "open.repaired.stl").stdout)
        self.mill("fix", "open.off", "solid.3mf", "--unit", "cm")
        self.assertIn("closed              yes", self.mill("info", "solid.3mf").stdout)
        self.mill("fix", "open.off", "--format", "ply")
        self.assertTrue((self.dir / "open.repaired.ply").exists())

    def test_ready_pipelines_are_described(self):
        text = self.mill("new").stdout
        for name in ("convert", "game-ready", "lod-chain", "quickstart", "repair", "scan-to-web", "view", "web"):
            self.assertIn(f"\n{name}: ", text)
        web = self.mill("new", "--from", "web").stdout
        for word in ("web: ", "max_size", "integer", "2048", "needed", "(meshopt, draco, none)", "facetmill run web MESH"):
            self.assertIn(word, web)
        self.assertIn("did you mean 'web'", self.mill("new", "--from", "wbe", expect=2).stderr)
        self.assertIn("facetmill new --from web", self.mill("docs", "web", expect=2).stderr)

    def test_all_missing_params_are_named_at_once(self):
        self.write("p.yaml", "facetmill: 1\nparams: {input: path, keep: ratio, name: text}\n"
                             "stages: [load: '${input}', simplify: '${keep}', write: '${name}']\n")
        text = self.mill("run", "p.yaml", expect=2).stderr
        for name in ("input", "keep", "name"):
            self.assertIn(f"-D {name}=...", text)

    def test_render_warns_of_another_unit_or_axis(self):
        size = ["--width", "40", "--height", "40", "-o", "p.png"]
        for name, changes in (("ten", ["--scale", "10"]), ("tenth", ["--scale", "0.1"]), ("lying", ["--rotate.angle", "90", "--rotate.axis", "1,0,0"])):
            self.mill("pipe", "load", "part.off", "!", "transform", *changes, "!", "write", f"{name}.off")
            said = self.mill("render", "part.off", f"{name}.off", *size).stderr
            self.assertIn("W-CONVENTION", said, name)
        self.assertNotIn("W-", self.mill("render", "part.off", "part.off", *size).stderr.replace("W-UP", ""))
        # Both files state one unit, and one is wrong.
        self.mill("convert", "part.off", "a.glb", "--unit", "mm", "--up", "y")
        self.mill("convert", "ten.off", "b.glb", "--unit", "mm", "--up", "y")
        self.assertIn("W-CONVENTION", self.mill("render", "a.glb", "b.glb", *size).stderr)
        # The hint works.
        self.assertIn("--unit cm,mm", self.mill("render", "part.off", "ten.off", *size).stderr)
        self.assertNotIn("W-CONVENTION", self.mill("render", "part.off", "ten.off", *size, "--unit", "cm,mm").stderr)


if __name__ == "__main__":
    main()
