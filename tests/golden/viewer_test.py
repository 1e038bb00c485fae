#!/usr/bin/env python3
"""The 3D view of pages in a real browser (Chromium, where there is one): it draws, its switches and keys change what is
seen, and it asks for nothing."""

import base64
import json
import struct
import unittest

from browser import Browser, require
from support import SCAN, SLOW, Case, png

# What the canvas shows, drawn again: how many pixels are covered, the sum of their colours, and a hash.
SHOWN = """new Promise((done) => {
  const canvas = document.querySelector(".viewer canvas");
  dispatchEvent(new Event("resize"));
  document.querySelector(".viewer [name=wireframe]").dispatchEvent(new Event("change"));
  requestAnimationFrame(() => {
    const flat = Object.assign(document.createElement("canvas"), { width: canvas.width, height: canvas.height });
    const context = flat.getContext("2d");
    context.drawImage(canvas, 0, 0);
    const pixels = context.getImageData(0, 0, flat.width, flat.height).data;
    let covered = 0, red = 0, blue = 0, hash = 7;
    for (let i = 0; i < pixels.length; i += 4) {
      if (pixels[i + 3] < 128) continue;
      ++covered;
      red += pixels[i];
      blue += pixels[i + 2];
      hash = (hash * 31 + i * 7 + pixels[i] * 5 + pixels[i + 1] * 3 + pixels[i + 2]) % 1000000007;
    }
    done({ covered: covered / (flat.width * flat.height), red: red / covered, blue: blue / covered, hash });
  });
})"""


@unittest.skipIf(SLOW, "a browser waits for the release build")
class Viewer(Case):
    def setUp(self):
        super().setUp()
        require(self)

    def page(self, browser, path):
        browser.open(path)
        browser.wait("!document.querySelector('.viewer').hidden")

    def choose(self, browser, name, value):
        browser.do(f"(() => {{ const c = document.querySelector('.viewer [name={name}]'); "
                   f"c[c.type === 'checkbox' ? 'checked' : 'value'] = {json.dumps(value)}; "
                   f"c.dispatchEvent(new Event('change')); }})()")

    def clean(self, browser):
        self.assertEqual(browser.problems, [])
        self.assertEqual(browser.requests, [])

    def test_switches_and_keys(self):
        self.mill("pipe", "-q", "load", SCAN, "!", "simplify", "20%", "!", "write", "small.ply")
        self.mill("diff", SCAN, "small.ply", "--report", "page.html", expect=1)
        with Browser() as browser:
            browser.size(900, 700)
            self.page(browser, self.dir / "page.html")
            first = browser.do(SHOWN)
            self.assertGreater(first["covered"], 0.05)
            self.assertLess(first["covered"], 0.9)
            self.assertEqual(browser.do(SHOWN), first)
            seen = {first["hash"]}

            def differs(what):
                shown = browser.do(SHOWN)
                self.assertGreater(shown["covered"], 0.02, what)
                self.assertNotIn(shown["hash"], seen, what)
                seen.add(shown["hash"])

            self.choose(browser, "wireframe", True)
            differs("wireframe")
            self.choose(browser, "wireframe", False)
            self.choose(browser, "shading", "flat")
            differs("flat")
            self.choose(browser, "shading", "smooth")
            self.choose(browser, "colours", "deviation")
            differs("deviation")
            self.assertFalse(browser.do("document.querySelector('.viewer .scale').hidden"))
            self.choose(browser, "colours", "plain")
            self.assertTrue(browser.do("document.querySelector('.viewer .scale').hidden"))
            browser.do("document.querySelector('.viewer canvas').focus()")
            for key, shift in (("ArrowLeft", False), ("ArrowUp", False), ("ArrowRight", True), ("+", False)):
                browser.press(key, shift)
                differs(key)
            browser.press("0")
            self.choose(browser, "colours", "material")
            self.assertEqual(browser.do(SHOWN), first)  # back where it was
            browser.do("document.querySelector('.viewer [type=radio]').click()")
            browser.wait("document.querySelector('.viewer .caption').textContent.startsWith('Before')")
            differs("before")
            self.assertRegex(browser.do("document.querySelector('.viewer .caption').textContent"),
                             r"shown with [34]\d,\d+ of 70,000 triangles|shown with all [\d,]+ triangles")
            browser.size(390, 800)
            self.assertLessEqual(browser.do("document.documentElement.scrollWidth"), 390)
            self.assertGreater(browser.do(SHOWN)["covered"], 0.05)
            self.clean(browser)

    def test_report(self):
        self.write("p.yaml", f"""facetmill: 1
stages:
  - load: {{path: {SCAN}, unit: mm}}
  - simplify: 20%
    ensure: {{deviation: 5%}}
  - write: small.glb
  - write: small.ply
  - simplify: 20%
  - write: smaller.ply
report: page.html
""")
        self.mill("run", "p.yaml", "-q", "-j", "1")
        text = (self.dir / "page.html").read_bytes()
        self.mill("run", "p.yaml", "-q", "-j", "3")
        self.assertEqual((self.dir / "page.html").read_bytes(), text)
        self.assertLess(len(text), 3 << 20)
        with Browser() as browser:
            self.page(browser, self.dir / "page.html")
            self.assertGreater(browser.do(SHOWN)["covered"], 0.05)
            labels = browser.do("[...document.querySelectorAll('.viewer fieldset label')].map((l) => l.textContent.trim())")
            self.assertEqual(labels, ["before: the input", "small.glb, small.ply", "smaller.ply"])
            self.choose(browser, "colours", "deviation")
            self.assertRegex(browser.do("document.querySelector('.viewer .scale').textContent"), r"largest [\d.]+ mm")
            browser.size(1400, 900)  # the distances of a stage are below its picture and its words, as wide as both
            self.assertEqual(browser.do("[...document.querySelectorAll('.stage.pictured > .wide')].map("
                                        "(wide) => wide.offsetWidth === wide.parentElement.offsetWidth)"), [True, True])
            self.clean(browser)

    def test_report_without_output(self):
        self.mill("pipe", "-q", "--report", "page.html", "generate", "sphere", "!", "validate", "--closed")
        with Browser() as browser:
            self.page(browser, self.dir / "page.html")
            self.assertGreater(browser.do(SHOWN)["covered"], 0.05)
            self.assertTrue(browser.do("document.querySelector('.viewer fieldset').hidden"))
            self.clean(browser)

    def test_what_closes_a_cut_is_grey(self):
        """Seen onto the cap of half a ball, where nothing but the cap is seen."""
        self.mill("pipe", "-q", "--report", "page.html", "generate", "icosphere", "--subdivisions", "4", "!", "clip", "z=0.3",
                  "--cap", "--keep", "back", "!", "split", "midpoint", "--passes", "2", "!", "write", "half.ply")
        with Browser() as browser:
            browser.size(600, 600)
            self.page(browser, self.dir / "page.html")
            self.assertNotIn("caps", browser.do("document.querySelector('.viewer .caption').textContent"))
            self.choose(browser, "colours", "deviation")
            self.assertIn("faces that close cuts (caps) are grey", browser.do("document.querySelector('.viewer .caption').textContent"))
            shown = browser.do(SHOWN)
            self.assertGreater(shown["covered"], 0.02)
            self.assertLess(abs(shown["red"] - shown["blue"]), 12, shown)  # neither is far off
            self.assertRegex(browser.do("document.querySelector('.viewer .scale').textContent"), r"largest [\d.]+e-1\d")
            self.clean(browser)

    def test_textures_and_colours(self):
        self.write("red.obj", "mtllib red.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nusemtl red\n"
                   "f 1/1 2/2 3/3 4/4\n")
        self.write("red.mtl", "newmtl red\nmap_Kd red.png\n")
        (self.dir / "red.png").write_bytes(png(255, 0, 0))
        self.write("blue.ply", "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
                   "property uchar red\nproperty uchar green\nproperty uchar blue\nelement face 1\n"
                   "property list uchar int vertex_indices\nend_header\n0 0 0 0 0 255\n1 0 0 0 0 255\n0 0 1 0 0 255\n3 0 1 2\n")
        with Browser() as browser:
            for name, is_red in (("red.obj", True), ("blue.ply", False)):
                self.mill("diff", name, name, "--report", "page.html")
                self.page(browser, self.dir / "page.html")
                for _ in range(100):  # an image takes its time
                    shown = browser.do(SHOWN)
                    if abs(shown["red"] - shown["blue"]) > 20:
                        break
                self.assertGreater(shown["covered"], 0.05)
                self.assertEqual(shown["red"] > 100 > 60 > shown["blue"], is_red, shown)
                self.assertEqual(shown["blue"] > 100 > 60 > shown["red"], not is_red, shown)
                self.clean(browser)

    def test_points_and_names(self):
        name = "<script>alert(1)<.ply"
        self.write(name, "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
                   "end_header\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n")
        self.mill("diff", name, name, "--report", "page.html")
        with Browser() as browser:
            self.page(browser, self.dir / "page.html")
            self.assertGreater(browser.do(SHOWN)["covered"], 0)
            self.assertEqual(browser.do("document.querySelector('.viewer .caption').textContent"),
                             f"{name}, shown with all 4 points.")
            self.clean(browser)

    def test_lines_and_points_beside_faces(self):
        self.write("all.gltf", json.dumps({
            "asset": {"version": "2.0"}, "scenes": [{"nodes": [0, 1]}], "scene": 0, "nodes": [{"mesh": 0}, {"mesh": 1}],
            "meshes": [{"primitives": [{"mode": mode, "attributes": {"POSITION": at}}]} for mode, at in ((4, 0), (3, 1))],
            "accessors": [{"bufferView": 0, "byteOffset": 36 * at, "componentType": 5126, "count": 3, "type": "VEC3",
                           "min": [0, 0, at], "max": [1, 1, at]} for at in (0, 1)],
            "bufferViews": [{"buffer": 0, "byteLength": 72}],
            "buffers": [{"byteLength": 72, "uri": "data:application/octet-stream;base64," + base64.b64encode(struct.pack(
                "<18f", 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 0, 1, 0, 1, 1)).decode()}]}))
        self.write("cloud.ply", "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\n"
                                "property float z\nend_header\n2 0 0\n2 1 0\n")
        self.mill("pipe", "-q", "--report", "page.html", "load", "all.gltf", "!", "load", "cloud.ply", "--unit", "m", "--up", "y",
                  "!", "validate", "--parts", "3")
        with Browser() as browser:
            self.page(browser, self.dir / "page.html")
            self.assertIn("shown with all 1 triangles, all 2 lines, all 2 points.",
                          browser.do("document.querySelector('.viewer .caption').textContent"))
            first = browser.do(SHOWN)
            for number in ("LINES", "POINTS"):  # what is not drawn is missed
                browser.do(f"WebGL2RenderingContext.prototype.drawArrays = (f => function(kind, ...all) "
                           f"{{ if (kind !== this.{number}) f.call(this, kind, ...all); }})"
                           f"(WebGL2RenderingContext.prototype.drawArrays)")
                second = browser.do(SHOWN)
                self.assertLess(second["covered"], first["covered"], number)
                first = second
            self.clean(browser)

    def test_without_webgl_the_pictures_are_there(self):
        self.mill("diff", SCAN, SCAN, "--report", "page.html")
        with Browser("--disable-gpu", "--disable-3d-apis") as browser:
            browser.open(self.dir / "page.html")
            self.assertTrue(browser.do("document.querySelector('.viewer').hidden"))
            self.assertGreater(browser.do("document.querySelector('figure img').naturalWidth"), 100)
            self.clean(browser)


if __name__ == "__main__":
    unittest.main()
