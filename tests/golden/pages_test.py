"""Pages for people: reports and comparisons as HTML. A browser (Chromium, without a window) opens them from disk: nothing
is fetched, nothing is said on its console, and nothing sticks out at the widths of a phone, a tablet and a desk, in light
and dark."""

import html
import json
import re
import shlex
import struct
import subprocess
import unittest

import browser
from support import SCAN, SLOW, Case, main, png

try:
    import jsonschema
except ImportError:
    jsonschema = None

OPEN = "OFF\n4 3 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n"
CLOSED = OPEN.replace("4 3 0", "4 4 0") + "3 0 2 1\n"

# The page in frames of several widths; each tells how wide it became.
FRAMES = """<!DOCTYPE html><html><body><pre id="told"></pre><script>
const told = [];
addEventListener("message", event => {{ told.push(event.data); told.sort();
  document.getElementById("told").textContent = "TOLD" + JSON.stringify(told) + "END"; }});
</script>{}</body></html>"""
TELL = """<script>addEventListener("load", () => {
  const hidden = innerWidth > 400 ? [] : [...document.querySelectorAll(".scroll")]
    .filter(e => e.scrollWidth > e.clientWidth).map(e => "columns of " + e.ariaLabel);
  for (const part of document.querySelectorAll("details")) part.open = true;
  const slider = document.querySelector("input[type=range]:not([hidden])");
  if (slider) { slider.value = 80; slider.dispatchEvent(new Event("input")); }
  const wide = [...document.querySelectorAll("body *")].filter(e => !e.closest(".scroll") && !e.closest("pre") &&
    !e.closest("svg") && e.getBoundingClientRect().right > innerWidth + 1).map(e => e.tagName + "." + e.className)
    .concat(hidden);
  parent.postMessage([innerWidth, document.documentElement.scrollWidth, matchMedia("(prefers-color-scheme: dark)").matches,
    slider ? slider.closest("figure").style.getPropertyValue("--at") : "", wide.slice(0, 5).join(" ")], "*");
});</script></body>"""
WIDTHS = (390, 800, 1400)


def shown(page):
    """The text of a page, as people read it: without its style, its scripts and its tags."""
    page = re.sub(r"<(style|script)>.*?</\1>", " ", page, flags=re.S)
    page = re.sub(r' src="data:[^"]*"', "", page)
    return html.unescape(re.sub(r"<[^>]+>", " ", page))


def numbers(text):
    return re.findall(r"(?<![\w.])-?\d[\d,]*(?:\.\d+)?(?:e[+-]?\d+)?", text)


class Pages(Case):
    def report(self, *line, expect=0, name="r.html", before=()):
        run = self.mill("pipe", "--report", name, *before, *line, expect=expect)
        return (self.dir / name).read_text(), run.stderr

    def in_browser(self, name):
        """[width, scrollable width, dark, slider, what sticks out] of each frame, light and dark."""
        browser.require(self)
        page = (self.dir / name).read_text()
        self.write("framed.html", page.replace("</body>", TELL))
        self.write("frames.html", FRAMES.format("".join(
            f'<iframe src="framed.html" width="{w}" height="900" style="border:0"></iframe>' for w in WIDTHS)))
        told = []
        for dark in (0, 1):
            run = subprocess.run(
                [browser.CHROMIUM, "--headless", "--no-sandbox", "--disable-gpu", "--enable-unsafe-swiftshader", "--enable-logging=stderr",
                 "--virtual-time-budget=10000", "--window-size=1500,1000", f"--user-data-dir={self.dir / 'profile'}",
                 f"--blink-settings=preferredColorScheme={1 - dark}", "--dump-dom", f"file://{self.dir}/frames.html"],
                capture_output=True, text=True, timeout=300)
            # What the browser says of its own drawing in software is no fault of the page.
            console = [line for line in run.stderr.splitlines()
                       if "CONSOLE" in line and "GL Driver Message" not in line and "software WebGL" not in line]
            self.assertEqual(console, [], name)
            found = re.search(r"TOLD(.*?)END", run.stdout, re.S)
            self.assertIsNotNone(found, f"{name}: the browser said nothing\n{run.stderr[-2000:]}")
            frames = json.loads(html.unescape(found[1]))
            self.assertEqual(sorted(f[0] for f in frames), sorted(WIDTHS), name)
            for width, scroll, is_dark, _, wide in frames:
                self.assertEqual(is_dark, bool(dark))
                self.assertLessEqual(scroll, width, f"{name} at {width}: {wide}")
                self.assertEqual(wide, "", f"{name} at {width}")
            told += frames
        return told

    def fetches_nothing(self, page):
        self.assertNotRegex(page, r'(?:src|href)="(?!data:)(?!\w[\w./-]*\.html")')
        self.assertNotIn("http://", re.sub(r"<pre.*?</pre>", "", page, flags=re.S))
        self.assertNotIn("@import", page)

    @unittest.skipIf(SLOW, "a browser waits for the release build")
    def test_a_browser_opens_reports(self):
        self.write("o.off", OPEN)
        page, _ = self.report("load", "o.off", "!", "validate", "--closed", "--edges", "6", "!", "write", "x.ply", expect=1)
        self.fetches_nothing(page)
        self.in_browser("r.html")
        page, _ = self.report("generate", "sphere", "!", "relax", "2", "!", "simplify", "30%", "!", "write",
                              "a-rather-long-name-of-a-file-that-does-not-fit-a-phone-" + "x" * 60 + ".glb",
                              before=("--timings", "t.html"))
        self.fetches_nothing(page)
        self.in_browser("t.html")
        frames = self.in_browser("r.html")
        self.assertTrue(all(f[3] == "80%" for f in frames), "the slider moves the pictures")

    @unittest.skipIf(SLOW, "a browser waits for the release build")
    def test_a_browser_opens_comparisons(self):
        for folder, ratio in (("a", "50%"), ("b", "40%")):
            (self.dir / folder).mkdir()
            self.mill("pipe", "generate", "sphere", "!", "simplify", ratio, "!", "write", f"{folder}/sphere.glb")
        self.write("a/gone.off", OPEN)
        self.write("b/new.off", OPEN)
        self.mill("diff", "a", "b", "--report", "i.html", expect=1)
        for name in ("i.html", "i/sphere.glb.html"):
            self.fetches_nothing((self.dir / name).read_text())
            self.in_browser(name)

    def test_the_page_has_every_number_of_the_terminal(self):
        self.write("o.off", CLOSED)
        for line in ("load o.off ! measure --density 2 --attributes mean_curvature ! section z=0.2 ! probe 0.1,0.1,0.1 ! write o.ply",
                     "generate sphere ! simplify 50% --certify ! write s.glb",
                     "load o.off ! split ! clip z=0.25 --cap ! clean ! validate --closed --area.max 1 ! write o.stl"):
            for timings in ((), ("--timings", "t.html")):
                page, terminal = self.report(*line.split(), before=timings, expect=None)
                text = shown((self.dir / "t.html").read_text() if timings else page)
                terminal = terminal[terminal.index("\npipe\n"):] if "\npipe\n" in terminal else terminal
                if not timings:  # times differ from run to run, and so does memory
                    terminal = re.sub(r"[\d.]+ s\b|peak memory [\d.]+ \w+", "", terminal)
                there = set(numbers(text))
                self.assertGreater(len(numbers(terminal)), 5)
                missing = [n for n in numbers(terminal) if n not in there]
                self.assertEqual(missing, [], f"{line}\n{terminal}")

    def test_the_page_of_a_comparison_has_every_number_of_the_terminal(self):
        self.write("o.off", CLOSED)
        self.mill("pipe", "load", "o.off", "!", "split", "!", "crumple", "5%", "!", "write", "p.off")
        run = self.mill("diff", "o.off", "p.off", "--html", "d.html", "--markdown", "d.md", expect=1)
        self.assertGreater(len(numbers(run.stdout)), 30)
        for text in (shown((self.dir / "d.html").read_text()), (self.dir / "d.md").read_text()):
            self.assertEqual([n for n in numbers(run.stdout) if n not in set(numbers(text))], [])

    def test_what_closes_a_cut_is_no_deviation(self):
        page, _ = self.report(*"generate icosphere --subdivisions 4 ! clip z=0 --cap ! write half.ply".split())
        text = " ".join(shown(page).split())
        self.assertRegex(text, r"deviation from the input: [\d.e-]+ % of the diagonal.* \(caps and removed parts not counted\)")
        self.assertRegex(text, r"The \d+ faces that close cuts \(caps\) are grey and not measured")
        self.assertLess(float(re.search(r"deviation from the input: ([\d.e-]+) % of the diagonal", text)[1]), 0.001)

    def test_what_a_difference_leaves_of_its_tool_is_no_cap(self):
        page, _ = self.report(*"generate cube ! generate icosphere ! transform --only icosphere --scale 1.25 ! combine difference"
                               " --with icosphere ! write drilled.ply".split())
        text = shown(page)
        self.assertNotRegex(text, r"\(caps\)|caps and removed")  # the scene that it is compared with has the ball's surface
        self.assertLess(float(re.search(r"deviation\s+from [^:]+: ([\d.e-]+) % of the diagonal", text)[1]), 1e-9)
        self.assertNotIn('"cap":true', page)
        # Nor where it is of several, whose faces have the numbers of their groups.
        page, _ = self.report(*"generate cube ! generate icosphere ! generate icosphere --name second ! transform --only icosphere"
                               " --scale 1.25 ! transform --only second --translate 1,1,1 ! combine union --only icosphere,second !"
                               " combine difference --with icosphere ! write drilled.ply".split())
        self.assertNotRegex(shown(page), r"\(caps\)|caps and removed")
        self.assertNotIn('"cap":true', page)

    def test_distances_are_those_in_the_pose_that_is_seen(self):
        """A ball that a morph target makes twice as large is compared as it is seen: at about twice the distances."""
        self.mill("pipe", "generate", "icosphere", "!", "write", "ball.gltf")
        scene = json.loads((self.dir / "ball.gltf").read_text())
        primitive = scene["meshes"][0]["primitives"][0]
        primitive["targets"] = [{"POSITION": primitive["attributes"]["POSITION"]}]
        farthest, said = {}, "Both surfaces are in the pose of the pictures"
        for weight in (0, 1):
            scene["meshes"][0]["weights"] = [weight]
            self.write("ball.gltf", json.dumps(scene))
            page, _ = self.report("load", "ball.gltf", "!", "simplify", "30%", "!", "write", "o.glb")
            self.assertRegex(page, r'<th scope="row">deviation</th><td>from the scene before [^:]+: [\d.e-]+ % of the diagonal')
            farthest[weight] = float(re.search(r"farthest inside\s+(-[\d.]+)", shown(page))[1])
            self.assertEqual(said in page, weight == 1)
            self.assertIn('"deviation":', page, "the 3D view has the distances, too")
            self.mill("diff", "ball.gltf", "o.glb", "--html", "d.html", expect=1)
            self.assertEqual(said in (self.dir / "d.html").read_text(), weight == 1)
        self.assertGreater(farthest[1] / farthest[0], 1.5)

    def ball_of_broken_texture(self):
        self.mill("pipe", "generate", "icosphere", "!", "write", "ball.gltf")
        scene = json.loads((self.dir / "ball.gltf").read_text())
        scene.update(images=[{"uri": "broken.png"}], textures=[{"source": 0}],
                     materials=[{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}])
        scene["meshes"][0]["primitives"][0]["material"] = 0
        self.write("ball.gltf", json.dumps(scene))
        self.write("broken.png", "no picture")

    def test_a_texture_that_is_not_drawn_is_told(self):
        self.ball_of_broken_texture()
        page, _ = self.report("load", "ball.gltf", "!", "relax", "1", "!", "write", "o.glb", expect=None)
        self.assertEqual(page.count("not drawn: it is broken"), 1)
        self.assertIn("the plain colour is drawn instead", page)

    def test_a_comparison_tells_what_it_does_not_draw(self):
        self.ball_of_broken_texture()
        self.mill("pipe", "generate", "icosphere", "!", "write", "plain.glb")
        for files in (("ball.gltf", "plain.glb"), ("plain.glb", "ball.gltf")):
            run = self.mill("diff", *files, "--html", "d.html", "--report", "again.html", expect=1)
            self.assertEqual(run.stderr.count("ball.gltf: warning[W-TEXTURE]: images[0] (broken.png): not drawn: it is broken"), 1, run.stderr)
            page = (self.dir / "d.html").read_text()
            self.assertEqual(page.count("not drawn: it is broken"), 1)
            self.assertIn("the plain colour is drawn instead", page)
        self.assertNotIn("not drawn", self.mill("diff", *files, expect=1).stderr)  # there are no pictures
        for folder in ("x", "y"):
            (self.dir / folder).mkdir()
        for name in ("ball.gltf", "broken.png", "ball.bin"):
            (self.dir / "x" / name).write_bytes((self.dir / name).read_bytes())
        for other in (None, "plain.glb"):  # a file alone, and one of a pair
            if other:
                (self.dir / "y/ball.glb").write_bytes((self.dir / other).read_bytes())
            run = self.mill("diff", "x", "y", "--html", "i.html", expect=1)
            self.assertEqual(run.stderr.count("x/ball.gltf: warning[W-TEXTURE]"), 1, run.stderr)
            self.assertEqual((self.dir / "i.html").read_text().count("not drawn: it is broken"), 1)

    def test_headings_have_short_names(self):
        for folder in ("old/assets/props", "new/assets/props"):
            self.write(f"{folder}/part_with_a_name.off", OPEN)
        files = [f"{folder}/assets/props/part_with_a_name.off" for folder in ("old", "new")]
        self.mill("diff", *files, "--html", "d.html", "--markdown", "d.md")
        page = (self.dir / "d.html").read_text()
        heading = re.search(r"<h1 title=\"(.*?)\">(.*?)</h1>", page)
        self.assertEqual(heading[1], " and ".join(files))
        self.assertEqual(heading[2].replace("<wbr>", ""), "old/.../part_with_a_name.off and new/.../part_with_a_name.off")
        self.assertIn("old/<wbr>", heading[2])
        for path in files:  # in full below it
            self.assertIn(path, page.replace("<wbr>", "").split("</dl>")[0])
        self.assertIn("<figcaption>old/.../part_with_a_name.off</figcaption>", page)
        lines = (self.dir / "d.md").read_text().splitlines()
        self.assertEqual(lines[0].replace("\\", ""), "## old/.../part_with_a_name.off and new/.../part_with_a_name.off")
        self.assertEqual(lines[2].replace("\\", ""), " and ".join(files))
        self.mill("diff", "old/assets/", "new/assets/", "--html", "i.html", "--markdown", "i.md")
        self.assertIn("old/<wbr>assets and new/<wbr>assets</h1>", (self.dir / "i.html").read_text())
        self.assertTrue((self.dir / "i.md").read_text().startswith("## old/assets and new/assets\n\nold/assets/ and new/assets/\n"))
        self.write("some/folder/of_pipelines/p.yaml",
                   "facetmill: 1\nstages:\n  - generate: cube\n  - write: x.ply\nreport: r.html\n")
        self.mill("run", "some/folder/of_pipelines/p.yaml")
        self.assertIn('<h1 title="some/folder/of_pipelines/p.yaml">p.yaml</h1>', (self.dir / "r.html").read_text())

    def test_headings_go_down_one_by_one(self):
        self.write("o.off", OPEN)
        self.report("load", "o.off", "!", "relax", "2", "!", "validate", "--closed", "!", "write", "x.ply", expect=1)
        self.report("generate", "sphere", "!", "simplify", "30%", "!", "write", "s.glb", name="s.html")
        self.mill("diff", "o.off", "s.glb", "--html", "d.html", expect=1)
        for name in ("r.html", "s.html", "d.html"):
            levels = [int(n) for n in re.findall(r"<h([1-6])[ >]", (self.dir / name).read_text())]
            self.assertEqual(levels[0], 1, name)
            self.assertTrue(all(b <= a + 1 for a, b in zip(levels, levels[1:])), f"{name}: {levels}")

    def test_times_are_told_where_they_are_asked_for(self):
        self.write("o.off", CLOSED)
        line = ("load", "o.off", "!", "split", "!", "write", "o.ply")
        first, _ = self.report(*line)
        again, _ = self.report(*line, before=("-j", "1"))
        self.assertEqual(first, again)
        self.assertNotIn("Time and memory", first)
        beside, _ = self.report(*line, before=("--timings", "t.html"))
        self.assertEqual(first, beside)
        timed = (self.dir / "t.html").read_text()
        # The same page otherwise, with the 3D view and the properties at the end, with a report or without.
        self.mill("pipe", "--timings", "alone.html", *line)
        for page in (timed, (self.dir / "alone.html").read_text()):
            titles = re.findall(r"<h2>(.*?)</h2>", page)
            self.assertEqual([t for t in titles if t != "Time and memory"], re.findall(r"<h2>(.*?)</h2>", first))
            self.assertIn("3D view", titles)
        section = timed[timed.index("<h2>Time and memory"):]
        for name in ("load", "split", "write"):
            self.assertIn(f"<td>{name}</td>", section)
        self.mill("pipe", "--timings", "t.json", *line)
        self.assertGreater(json.loads((self.dir / "t.json").read_text())["stages"][0]["peak_memory"], 0)

    def test_a_failing_check_says_how_to_go_on(self):
        self.write("o.off", OPEN)
        page, _ = self.report("load", "o.off", "!", "validate", "--closed", "--faces.max", "2", expect=1)
        text = shown(page)
        for words in ("expected", "true", "found", "false", "margin", "1 too many (50 % above the limit)", "evidence",
                      "clean: {holes: minimal}"):
            self.assertIn(words, text)
        self.assertIn('id="check-1" src="data:image/png', page)  # where it fails
        commands = [html.unescape(c) for c in re.findall(r"<dt>(?:try|reproduce)</dt><dd><pre[^>]*>(.*?)</pre>", page)]
        self.assertEqual(commands[1], "facetmill pipe load o.off ! validate --closed --faces.max 2")
        for command, code in zip(commands, (0, 1)):
            self.mill(*shlex.split(command)[1:], expect=code)

    def test_a_page_has_distances_histograms_files_and_the_pipeline(self):
        page, _ = self.report("generate", "sphere", "!", "simplify", "25%", "!", "write", "s.glb")
        self.assertEqual(page.count('role="img"'), 4)  # distances, edges, angles, aspect ratios
        for title in ("Distances from", "Edge length", "Smallest angle of faces", "Aspect ratio of faces"):
            self.assertRegex(page, f"<title[^>]*>{title}")
        for id in re.findall(r'aria-labelledby="([^"]+)"', page):
            for one in id.split():
                self.assertEqual(page.count(f'id="{one}"'), 1)
        self.assertIn("-worst\"", page)
        self.assertIn("<h2>Pipeline</h2>", page)
        self.assertIn("simplify: 25%", shown(page))
        report = json.loads(self.mill("pipe", "--report", "r.json", "generate", "sphere", "!", "write", "s.glb") and
                            (self.dir / "r.json").read_text())
        contents = report["outputs"][0]["contents"]
        self.assertEqual(sum(contents.values()), report["outputs"][0]["bytes"])
        self.assertGreater(contents["json"], 100)

    def test_what_is_up_stays_so_while_stages_cut(self):
        """A scan that does not say what is up, cut such that by itself it would be taken to lie."""
        page, _ = self.report("load", SCAN, "!", "clip", "y=-100", "!", "validate", "--closed", expect=1)
        text = shown(page)
        self.assertIn("left of the slider: after load", text)  # by one camera
        viewed = json.loads(re.search(r'<script type="application/json">(.*?)</script>', page, re.S)[1])
        self.assertEqual([s["name"] for s in viewed["scenes"]], ["the input", "the scene at 'validate'"])
        self.assertEqual(viewed["scenes"][0]["up"], viewed["scenes"][1]["up"])
        # A cut moves nothing: what rounding loses, some 1e-14, is no scale.
        ticks = re.findall(r">([+-][\d.e-]+)</text>", page)
        self.assertIn("+0.000658", ticks)

    def test_names_are_text(self):
        name = "<script>alert(1)</script>"
        self.write("s.obj", f"o {name}\n" + "".join(f"v {x}\n" for x in ("0 0 0", "1 0 0", "0 1 0", "0 0 1")) +
                   "f 1 2 4\nf 2 3 4\nf 3 1 4\n")
        page, _ = self.report("load", "s.obj", "!", "validate", "--closed", expect=1)
        self.mill("diff", "s.obj", "s.obj", "--report", "d.html")
        self.mill("pipe", "load", "s.obj", "!", "separate", "!", "write", "t.obj")
        (self.dir / "x").mkdir()
        (self.dir / "y").mkdir()
        self.write("x/<img src=x>.obj", (self.dir / "s.obj").read_text())
        self.write("y/other.obj", (self.dir / "s.obj").read_text())
        self.mill("diff", "x", "y", "--report", "i.html", "--report", "i.md", expect=1)
        for text in (page, (self.dir / "d.html").read_text(), (self.dir / "i.html").read_text()):
            self.assertNotIn("<script>alert", text)
            self.assertNotIn("<img src=x", text)
        self.assertIn("&lt;script&gt;alert", page)

    def test_nasty_scenes_have_pages(self):
        self.write("empty.obj", "# nothing\n")
        self.write("point.obj", "v 1 2 3\n")
        self.write("line.off", "OFF\n3 1 0\n0 0 0\n0 0 0\n0 0 0\n3 0 1 2\n")
        self.write("broken.ply", "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
                   "property float quality\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
                   "0 0 0 nan\n1 0 0 inf\n0 1 0 2\n3 0 1 2\n")
        self.write("far.off", OPEN.replace("1 0 0", "1e300 0 0"))
        for name in ("empty.obj", "point.obj", "line.off", "broken.ply", "far.off"):
            run = self.mill("pipe", "--report", "r.html", "load", name, "!", "clean", "!", "simplify", "50%", "!",
                            "write", "o.ply", expect=None)
            self.assertIn(run.returncode, (0, 1, 5, 6), f"{name}\n{run.stderr}")
            page = (self.dir / "r.html").read_text()
            self.assertTrue(page.endswith("</html>\n"), name)
            self.assertNotRegex(shown(page), r"\bnan\b|-nan", name)
            run = self.mill("diff", name, "broken.ply", "--report", "d.html", expect=None)
            self.assertIn(run.returncode, (0, 1, 6), f"{name}\n{run.stderr}")

    def test_pictures_are_the_same_for_any_number_of_threads(self):
        """PNG files, byte for byte: shading, occlusion, wireframe, textures, transparency, a heat map, several views."""
        self.mill("pipe", "-q", "generate", "icosphere", "--subdivisions", "4", "!", "write", "ball.gltf")
        scene = json.loads((self.dir / "ball.gltf").read_text())
        scene.update(images=[{"uri": "colours.png"}], textures=[{"source": 0}],
                     materials=[{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}, "baseColorFactor": [1, 1, 1, 0.5]},
                                 "alphaMode": "BLEND"}])
        primitive = scene["meshes"][0]["primitives"][0]
        primitive["material"] = 0
        primitive["attributes"]["TEXCOORD_0"] = len(scene["accessors"])
        count = scene["accessors"][primitive["attributes"]["POSITION"]]["count"]
        uv = b"".join(struct.pack("<2f", i % 7 / 7, i % 11 / 11) for i in range(count))
        scene["accessors"].append({"bufferView": len(scene["bufferViews"]), "componentType": 5126, "count": count, "type": "VEC2"})
        scene["bufferViews"].append({"buffer": len(scene["buffers"]), "byteLength": len(uv)})
        scene["buffers"].append({"byteLength": len(uv), "uri": "uv.bin"})
        (self.dir / "uv.bin").write_bytes(uv)
        (self.dir / "colours.png").write_bytes(png(200, 30, 120))
        self.write("ball.gltf", json.dumps(scene))
        modes = {"plain": (), "absolute": ("--shading", "absolute", "--normals", "smooth"), "bare": ("--no-occlusion",),
                 "wires": ("--edges", "all", "--silhouettes"), "beside": ("--shading", "beside"),
                 "curved": ("--attribute", "mean_curvature"), "around": ("--views", "turntable"), "deep": ("--perspective", "40")}
        line = [word for name, options in modes.items()
                for word in ("!", "render", f"{name}.png", "--width", "200", "--height", "150", *options)]
        seen = []
        for threads in (1, 2, 3):
            for source, before in ((SCAN, ("!", "simplify", "20%", "!", "measure", "--attributes", "mean_curvature,gaussian_curvature")), ("ball.gltf", ())):
                there = [*line] if before else line[:line.index("curved.png") - 2] + line[line.index("around.png") - 2:]
                self.mill("pipe", "-q", "-j", threads, "-o", f"{threads}/{'scan' if before else 'ball'}", "load", source, *before, *there)
            seen.append({name: digest for name, digest in self.files(self.dir / str(threads)).items()})
        self.assertEqual(len(seen[0]), 2 * len(modes) - 1)
        self.assertEqual(len({digest for name, digest in seen[0].items() if name.startswith("scan/")}), len(modes))  # all differ
        self.assertEqual(seen[0], seen[1])
        self.assertEqual(seen[0], seen[2])

    def test_a_page_that_cannot_be_written(self):
        self.write("o.off", OPEN)
        (self.dir / "closed").mkdir()
        (self.dir / "file").write_text("")
        run = self.mill("pipe", "--report", "file/r.html", "load", "o.off", "!", "write", "x.ply", expect=4)
        self.assertIn("file", run.stderr)
        run = self.mill("diff", "o.off", "o.off", "--html", "file/d.html", expect=4)
        self.assertIn("hint: write elsewhere: under another path", run.stderr)
        (self.dir / "m").mkdir()
        self.write("m/o.off", OPEN)
        self.mill("diff", "m", "m", "--report", "file/i.html", expect=4)
        self.assertEqual((self.dir / "file").read_text(), "")

    def test_a_page_stays_small(self):
        stages = []
        for i in range(40):
            stages += ["!", "crumple", "0.5%", "--seed", str(i), "--grid", "1"]
        page, _ = self.report("generate", "sphere", *stages, "!", "write", "s.glb")
        self.assertLess(len(page.encode()), 3_000_000)
        self.assertIn("Later pictures are smaller", page)
        self.assertRegex(page, r"<h3>crumple\D*40")

    # --- folders

    def folders(self):
        for folder in ("a/sub", "b/sub"):
            (self.dir / folder).mkdir(parents=True)
        self.write("a/same.off", OPEN)
        self.write("b/same.off", OPEN)
        self.write("a/sub/moved.off", OPEN)
        self.write("b/sub/moved.off", OPEN.replace("0 0 1", "0 0 1.5"))
        self.write("a/little.off", OPEN)
        self.write("b/little.off", OPEN.replace("0 0 1", "0 0 1.01"))
        self.write("a/gone.off", OPEN)
        self.write("b/new.off", OPEN)
        self.write("b/readme.txt", "no mesh")

    def test_folders_are_compared_worst_first(self):
        self.folders()
        run = self.mill("diff", "a", "b", expect=1)
        order = [line.split()[:2] for line in run.stdout.splitlines()[1:]]
        self.assertEqual(order, [["differs", "sub/moved.off"], ["differs", "little.off"], ["removed", "gone.off"],
                                 ["added", "new.off"]])
        self.mill("diff", "a", "b", "--report", "out/i.html", "--report", "out/i.md", expect=1)
        self.assertEqual(sorted(p for p in self.files(self.dir / "out")),
                         ["i.html", "i.md", "i/little.off.html", "i/same.off.html", "i/sub/moved.off.html"])
        index = (self.dir / "out/i.html").read_text()
        self.assertIn('<a href="i/sub/moved.off.html">', index)
        self.assertLess(index.index("sub/moved.off"), index.index("little.off"))
        self.assertIn("| sub/moved.off |", (self.dir / "out/i.md").read_text())
        first = self.files(self.dir / "out")
        self.mill("diff", "a", "b", "--report", "out/i.html", "--report", "out/i.md", "-j", "1", expect=1)
        self.assertEqual(first, self.files(self.dir / "out"))

    def test_files_of_folders_are_paired_without_suffixes(self):
        def put(*names):
            for name in names:
                (self.dir / name).parent.mkdir(parents=True, exist_ok=True)
                self.mill("pipe", "-q", "generate", "cube", "!", "write", name)
        put("a/cube.ply", "b/cube.glb", "a/sub/same.ply", "b/sub/same.ply", "b/sub/same.obj", "a/two.ply", "a/two.obj", "b/two.glb",
            "a/one/x.ply", "b/other/x.ply", "a/gone.ply")
        run = self.mill("diff", "a", "b", "--ignore", "attributes,topology,counts,document,materials", "--all", "--html", "i.html",
                        "--markdown", "i.md", expect=1)
        lines = [" ".join(line.split()) for line in run.stdout.splitlines()]
        self.assertEqual(lines[0], "a and b differ: 4 removed, 3 added, 2 same")
        self.assertEqual(sorted(lines[1:]), sorted([
            "removed gone.ply", "removed one/x.ply", "added other/x.ply", "added sub/same.obj",
            "removed two.obj not paired, because several files share this name: the second folder has two.glb",
            "removed two.ply not paired, because several files share this name: the second folder has two.glb",
            "added two.glb not paired, because several files share this name: the first folder has two.obj, two.ply",
            "same cube.ply and cube.glb deviation 0 %", "same sub/same.ply deviation 0 %"]))
        index = (self.dir / "i.html").read_text()
        self.assertIn('<a href="i/cube.ply.html"><code>cube.ply and cube.glb</code></a>', index)
        self.assertIn("the first folder has two.obj, two.ply", index)
        self.assertIn("<h1>cube.ply and cube.glb</h1>", re.sub(r'<h1 title=".*?">', "<h1>", (self.dir / "i/cube.ply.html").read_text()))
        self.assertIn("not paired, because several", (self.dir / "i.md").read_text())
        files = json.loads(self.mill("diff", "a", "b", "--json", expect=1).stdout)["files"]
        paths = {f["path"]: f["paths"] for f in files}
        self.assertEqual(paths["cube.ply"], {"a": "cube.ply", "b": "cube.glb"})
        self.assertEqual(paths["gone.ply"], {"a": "gone.ply", "b": None})
        self.assertEqual(paths["two.glb"], {"a": None, "b": "two.glb"})

    def test_exit_codes_of_folders(self):
        self.folders()
        self.mill("diff", "a", "a")
        self.mill("diff", "a", "b", "--max", "90%", expect=1)  # files came and went
        self.write("b/little.off", "OFF\nbroken")
        run = self.mill("diff", "a", "b", "--report", "i.html", expect=6)
        self.assertIn("failed   little.off", run.stdout)
        row = re.search(r"<tr>.*little\.off.*</tr>", (self.dir / "i.html").read_text())[0]
        self.assertEqual(row.count('<td class="number"></td>'), 3, row)  # nothing is known of it, not even that it has no faces
        self.assertIn("little.off", (self.dir / "i.html").read_text())
        self.mill("diff", "a", "a/same.off", expect=2)
        self.mill("diff", "a", "nowhere", expect=None)
        (self.dir / "none").mkdir()
        self.assertIn("no mesh files", self.mill("diff", "none", "none").stdout)

    @unittest.skipIf(jsonschema is None, "python3-jsonschema is missing")
    def test_comparisons_follow_their_schemas(self):
        self.folders()
        schema = json.loads(self.mill("schema", "diff-folders").stdout)
        jsonschema.Draft202012Validator.check_schema(schema)
        jsonschema.validate(json.loads(self.mill("diff", "a", "b", "--json", expect=1).stdout), schema)
        schema = json.loads(self.mill("schema", "diff").stdout)
        found = json.loads(self.mill("diff", "a/little.off", "b/little.off", "--json", expect=1).stdout)
        jsonschema.validate(found, schema)
        self.assertEqual(found["changes"], [{"of": "part", "name": "little", "change": "changed", "note": "moved by up to 0.01"}])
        self.assertEqual(found["bytes"]["a"]["all"], len(OPEN))

    def test_a_comparison_tells_parts_and_materials(self):
        def obj(parts):
            return "".join(f"o {n}\nusemtl {m}\n" + "".join(f"v {x + dx} {y} {z}\n" for x, y, z in ((0, 0, 0), (1, 0, 0), (0, 1, 0)))
                           + f"f {3 * i + 1} {3 * i + 2} {3 * i + 3}\n" for i, (n, m, dx) in enumerate(parts))
        self.write("a.obj", obj([("body", "red", 0), ("left", "blue", 3), ("right", "blue", 6)]))
        self.write("b.obj", obj([("body", "red", 0), ("right", "blue", 7), ("top", "green", 9)]))
        self.mill("diff", "a.obj", "b.obj", "--report", "d.html", "--report", "d.md", expect=1)
        text = shown((self.dir / "d.html").read_text())
        for words in (r"removed\s+left", r"changed\s+right", r"added\s+top", r"moved by up to 1\b", r"added\s+green",
                      r"soundness\s+\d+ of \d+ checks passed", r"of geometry"):
            self.assertRegex(text, words)
        self.assertIn("| removed | left |", (self.dir / "d.md").read_text())

    def test_a_comparison_tells_what_materials_are_from_where_they_are(self):
        def obj(height):
            return (f"v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 {height}\nusemtl red\nf 1 2 3\nusemtl blue\nf 2 4 3\n"
                    "usemtl red\nf 1 3 2\n" + ("f 1 2 4\n" if height else ""))
        self.write("a.obj", obj(0))
        self.write("b.obj", obj(1))
        for other, words in (("b.obj", "2 same; 2 of them cover different areas"), ("a.obj", "2 same ")):
            self.mill("diff", "a.obj", other, "--html", "d.html", expect=1 if other == "b.obj" else 0)
            page = (self.dir / "d.html").read_text()
            self.assertRegex(" ".join(shown(page).split()), "Materials by name " + words)
            self.assertIn('<th scope="row">edge_manifold</th>', page)  # which a phone does not break
            self.assertNotIn("_<wbr>", page)

    def test_a_comparison_says_how_a_material_differs(self):
        self.mill("pipe", "generate", "icosphere", "!", "write", "a.gltf")
        scene = json.loads((self.dir / "a.gltf").read_text())
        scene["meshes"][0]["primitives"][0]["material"] = 0
        for name, colour, roughness, image in (("a", [0, 0, 0], 0.5, png(1, 2, 3)), ("b", [1, 0, 0], 0.25, png(4, 5, 6))):
            (self.dir / f"{name}.png").write_bytes(image)
            scene.update(images=[{"uri": f"{name}.png"}], textures=[{"source": 0}],
                         materials=[{"name": "paint", "emissiveFactor": colour, "normalTexture": {"index": 0},
                                     "pbrMetallicRoughness": {"roughnessFactor": roughness, "metallicFactor": 0}}])
            self.write(f"{name}.gltf", json.dumps(scene))
        run = self.mill("diff", "a.gltf", "b.gltf", "--html", "d.html", "--markdown", "d.md", expect=1)
        digests = re.findall(r"0/normalTexture/index/source +([0-9a-f]{12}\.\.\.) +([0-9a-f]{12}\.\.\.) ", run.stdout)
        self.assertEqual(len(digests), 1, run.stdout)
        for name in ("d.html", "d.md"):
            text = (self.dir / name).read_text()
            self.assertIn("different emissiveFactor, normalTexture, roughnessFactor", text)
            self.assertIn(digests[0][0], text)
            self.assertNotRegex(text, r"\b[0-9a-f]{64}\b")
        self.assertIn("<code>0/<wbr>normalTexture/<wbr>index/<wbr>source</code>", (self.dir / "d.html").read_text())
        self.assertRegex(run.stdout, r"100,000 and 100,000 samples")

    def test_markdown_has_bytes_and_the_deviation_of_the_page(self):
        line = ["generate", "icosphere", "--subdivisions", "4", "!", "simplify", "25%", "!", "write", "small.glb"]
        page, _ = self.report(*line)
        self.mill("pipe", "-q", "--report", "alone.md", *line)
        self.mill("pipe", "-q", "--report", "beside.md", "--report", "beside.html", *line)
        text = (self.dir / "alone.md").read_text()
        deviation = re.search(r"\nDeviation from the input: (\S+) % of the diagonal \(removed parts not counted\)\n", text)
        self.assertGreater(float(deviation[1]), 0.1)
        self.assertRegex(" ".join(shown(page).split()), rf"deviation from the scene before 'simplify': {deviation[1]} % of the diagonal ")
        self.assertRegex((self.dir / "beside.md").read_text(), f"Deviation from the scene before .*simplify.*: {deviation[1]} %")
        self.assertIn("| faces | 5,120 | 1,280 | 25 % |\n", text)
        size = (self.dir / "small.glb").stat().st_size
        self.assertIn(f"| bytes | - | {size / 1000:.1f} kB | - |\n", text)
        self.assertRegex(text, r"\| bytes of geometry \| - \| [\d.]+ kB \| - \|\n\| bytes of JSON \|")
        # Where a check fails nothing is written, and the scene there is measured.
        self.write("o.off", CLOSED)
        for check, place in ((["!", "validate", "--faces.max", "9"], "validate"), (["--ensure", "{faces: {max: 9}}"], "crumple")):
            failing = ["load", "o.off", "!", "split", "!", "crumple", "5%", *check]
            self.mill("pipe", "-q", "--report", "failed.md", *failing, expect=1)
            failed = (self.dir / "failed.md").read_text()
            self.assertRegex(failed, rf"\| bytes \| {len(CLOSED)} bytes \| - \| - \|")
            page, _ = self.report(*failing, expect=1)
            deviation = re.search(r"\nDeviation from the input: (\S+) % of the diagonal", failed)
            self.assertIn(f"deviation from the input: {deviation[1]} % of the diagonal", " ".join(shown(page).split()), place)
        # The scene as loaded is taken from the cache, too.
        cached = {"FACETMILL_CACHE": str(self.dir / "cache")}
        for _ in range(2):
            self.mill("pipe", "-q", "--cache", "--report", "cached.md", *line, env=cached)
            self.assertEqual((self.dir / "cached.md").read_text(), text)

    def test_diff_names_its_reports_by_kind(self):
        self.write("a.off", OPEN)
        self.write("b.off", OPEN)
        self.mill("diff", "--report", "r.html", "a.off", "b.off", "--report", "r.md")
        self.mill("diff", "--html", "h.html", "--markdown", "h.md", "a.off", "b.off")
        for kind in ("html", "md"):
            self.assertEqual((self.dir / f"h.{kind}").read_text(), (self.dir / f"r.{kind}").read_text())
        self.mill("diff", "--html", "i.html", "--markdown", "i.md", "--report", "j.html", "a.off", "b.off")
        self.assertTrue(all((self.dir / name).exists() for name in ("i.html", "i.md", "j.html")))
        # What follows the option is never taken for the page: a mesh would be overwritten.
        for words in (("--html", "a.off", "b.off"), ("--html", "a.off", "b.off", "b.off"), ("--markdown", "a.off", "b.off")):
            run = self.mill("diff", *words, expect=2)
            ending = "html" if words[0] == "--html" else "md"
            self.assertIn(f"{words[0]} is followed by the .{ending} file to write, found 'a.off'", run.stderr)
            self.assertIn(f"facetmill diff A B {words[0]} changes.", run.stderr)
        self.assertEqual((self.dir / "a.off").read_text(), OPEN)


if __name__ == "__main__":
    main()
