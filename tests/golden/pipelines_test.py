"""Golden runs of every file in pipelines/ through the real executable: it runs, its report follows the published
schema, and its bytes depend neither on the number of threads nor on the processor."""

import json
import unittest

from support import SCAN, SLOW, SOURCE, Case, main

try:
    import jsonschema
except ImportError:  # the notice is printed by the test that needs it
    jsonschema = None

PIPELINES = sorted((SOURCE / "pipelines").glob("*.yaml"))
FIGURES = sorted((SOURCE / "pipelines/figures").glob("*.yaml"))
# Hides what libm would choose by the processor. Names differ between releases of glibc; unknown ones are ignored.
OLD_PROCESSOR = {"GLIBC_TUNABLES": "glibc.cpu.hwcaps=-FMA,-AVX2,-FMA4,-AVX2_Usable,-FMA_Usable"}
# What varies from run to run stands under these keys of a report, and nowhere else.
VARYING = {"run"}


def stable(report):
    return {key: value for key, value in report.items() if key not in VARYING}


class Golden(Case):
    def run_pipeline(self, pipeline, out, *arguments, env=None):
        folder = self.dir / out
        scan = ["-D", f"input={SCAN}"] if "\n  input:" in pipeline.read_text() else []
        self.mill("run", pipeline, *scan, "--output-dir", folder, "--quiet", *arguments, env=env)
        files = self.files(folder)
        reports = {name for name in files if name.endswith((".json", ".html"))}
        self.assertTrue(files.keys() - reports, "the pipeline wrote nothing")
        self.assertFalse([name for name in files if name.endswith("~")], "a temporary is left")
        same = {name: digest for name, digest in files.items() if name not in reports}
        contents = {name: json.loads((folder / name).read_text()) for name in reports if name.endswith(".json")}
        return same, contents

    def check_report(self, report, files):
        self.assertTrue(all(check["passed"] or check["severity"] == "warning" for check in report["checks"]))
        for output in report["outputs"]:
            name = output["path"].rsplit("/", 1)[-1]
            self.assertEqual(output["sha256"], files[name], name)
        if jsonschema is None:
            self.fail("python3-jsonschema is missing (make deps installs it)")
        schema = json.loads(self.mill("schema", "report").stdout)
        jsonschema.Draft202012Validator.check_schema(schema)
        jsonschema.Draft202012Validator(schema).validate(report)

    def check_pipeline(self, pipeline):
        files, reports = self.run_pipeline(pipeline, "j1", "-j", "1")
        self.assertTrue(reports, "the pipeline wrote no report")
        for report in reports.values():
            self.check_report(report, files)
        variants = [] if SLOW else [("j2", ("-j", "2"), None), ("j3", ("-j", "3"), None), ("old", (), OLD_PROCESSOR)]
        for name, arguments, env in variants:
            other, other_reports = self.run_pipeline(pipeline, name, *arguments, env=env)
            self.assertEqual(other, files, f"{name} gives other bytes than j1")
            for report in reports:
                mine, theirs = stable(reports[report]), stable(other_reports[report])
                text = json.dumps(theirs).replace(f"{self.dir}/{name}/", f"{self.dir}/j1/")
                self.assertEqual(json.loads(text), mine, f"{name} gives another report than j1")

    def test_web_holds_a_budget_or_names_what_would_fit(self):
        self.mill("pipe", "generate", "--shape", "torus", "!", "write", "ring.ply")
        web = ["run", "web", "-D", "input=ring.ply", "-D", "pixels=32"]
        written = []
        for threads in (1, 2):
            self.mill(*web, "-D", "budget=4kB", "-j", threads, "--output-dir", f"j{threads}")
            file = self.dir / f"j{threads}/ring.glb"
            self.assertLessEqual(file.stat().st_size, 4000)
            written.append(file.read_bytes())
            self.check_report(json.loads((self.dir / f"j{threads}/ring.report.json").read_text()),
                              self.files(self.dir / f"j{threads}"))
        self.assertEqual(*written)
        said = self.mill(*web, "-D", "budget=500", "--output-dir", "none", expect=1).stderr
        self.assertFalse((self.dir / "none/ring.glb").exists())
        fits = said.split("use budget: ")[1].split()[0]
        self.mill(*web, "-D", f"budget={fits}", "--output-dir", "fits")
        self.mill(*web, "-D", "look=2%", "--output-dir", "look")
        self.assertLess((self.dir / "look/ring.glb").stat().st_size, 12000)


for path in PIPELINES:
    if path.stem in ("convert", "view"):  # no report, no output but the report: doors_test.py
        continue

    def test(self, path=path):
        self.check_pipeline(path)
    setattr(Golden, "test_" + path.stem.replace("-", "_"), test)


class Figures(Golden):
    """The figures after Bourke: without a warning, each file one of its own, and a picture of it in the docs."""

    def check_figure(self, path):
        # A figure of what does not hold, or of what stops with a warning, which it names.
        fails = "severity: warn" in path.read_text()
        warns = "# warns: " in path.read_text()
        strict = [] if fails or warns else ["--strict"]
        files, reports = self.run_pipeline(path, "j1", "-j", "1", *strict)
        for report in reports.values():
            self.check_report(report, files)
        self.assertEqual(len(set(files.values())), len(files), "two files of a figure are the same")
        if not SLOW:
            self.assertEqual(self.run_pipeline(path, "j2", "-j", "2", *strict)[0], files)
        self.assertEqual(fails, any(not c["passed"] for report in reports.values() for c in report["checks"]))
        picture = SOURCE / f"docs/figures/{path.stem}.png"
        self.assertLess(picture.stat().st_size, 60000)
        self.assertIn(f"figures/{path.name}", (SOURCE / "docs/figures.md").read_text())


for path in FIGURES:
    def test(self, path=path):
        self.check_figure(path)
    setattr(Figures, "test_figure_" + path.stem.replace("-", "_"), test)
Figures.test_web_holds_a_budget_or_names_what_would_fit = None  # those are Golden's
for path in PIPELINES:
    setattr(Figures, "test_" + path.stem.replace("-", "_"), None)


class Ready(Case):
    """By name, from a folder that holds nothing but the scan."""

    def test_ready_pipelines_run_by_name(self):
        (self.dir / "scan.ply").write_bytes(SCAN.read_bytes())
        for path in PIPELINES:
            self.assertIn("-D input=", self.mill("run", path.stem, expect=2).stderr)
            if not SLOW:  # the files of the same names have run
                self.mill("run", path.stem, "-D", "input=scan.ply", "--quiet")

    def test_game_ready_refuses_what_has_no_faces(self):
        # A cloud, and a face without area, which clean removes.
        for name, text, hint in (("cloud.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n", "points but no faces"),
                                 ("line.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n", "no faces are left")):
            self.write(name, text)
            said = self.mill("run", "game-ready", "-q", "-D", f"input={name}", "-D", "texture=64", expect=1).stderr
            self.assertIn("'faces' must be at least 1, found 0", said)
            self.assertIn(hint, said)

    def test_repair_makes_a_solid_of_what_overlaps_and_has_holes_and_fins(self):
        def cube(low, high, first):
            corners = [(x, y, z) for x in (low, high) for y in (low, high) for z in (low, high)]
            faces = ((0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3))
            return corners, [[first + i for i in face] for face in faces]

        a, faces_a = cube(0, 1, 0)
        b, faces_b = cube(0.5, 1.7, 8)
        faces_b[2].reverse()
        corners, faces = [*a, *b, (0, 0, 9)], [*faces_a[1:], *faces_b, [14, 15, 16]]  # a hole, a turned face and a fin
        (self.dir / "broken.off").write_text(
            f"OFF\n{len(corners)} {len(faces)} 0\n" + "".join("%r %r %r\n" % p for p in corners)
            + "".join(f"{len(f)} {' '.join(map(str, f))}\n" for f in faces))
        self.mill("pipe", "load", "broken.off", "!", "validate", "--for", "printing", expect=1)
        self.mill("run", "repair", "-D", "input=broken.off")
        found = json.loads(self.mill("info", "--json", "broken.repaired.stl").stdout)
        self.assertAlmostEqual(found["volume"], 1 + 1.2 ** 3 - 0.5 ** 3, places=6)
        self.mill("pipe", "load", "broken.repaired.stl", "!", "validate", "--for", "printing")
        (self.dir / "sheet.off").write_text("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n")
        refused = self.mill("run", "repair", "-D", "input=sheet.off", expect=1)
        self.assertIn("'closed' must be true", refused.stderr)
        self.assertFalse((self.dir / "sheet.repaired.stl").exists())

    def test_repair_takes_corners_a_rounding_apart_for_one(self):
        corners = [(x, y, z) for x in (0, 1) for y in (0, 1) for z in (0, 1)]
        quads = ((0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3))
        faces = [f for a, b, c, d in quads for f in ((a, b, c), (a, c, d))]
        lines = ["solid cube"]
        for face in faces:  # a zero is never the same zero, as of a sine of pi
            lines += ["facet normal 0 0 0", "outer loop"]
            lines += ["vertex " + " ".join(str(x or len(lines) * 1e-17) for x in corners[i]) for i in face]
            lines += ["endloop", "endfacet"]
        (self.dir / "noisy.stl").write_text("\n".join([*lines, "endsolid cube", ""]))
        self.mill("pipe", "load", "noisy.stl", "!", "validate", "--closed", expect=1)
        self.mill("run", "repair", "-D", "input=noisy.stl")
        found = json.loads(self.mill("info", "--json", "noisy.repaired.stl").stdout)
        self.assertEqual((found["faces"], found["closed"], found["euler"]), (12, True, 2))

    def test_a_gltf_is_written_where_nothing_is(self):
        self.mill("pipe", "--quiet", "load", SCAN, "--unit", "mm", "!", "simplify", "--faces=100", "!",
                  "write", "a.gltf")
        self.assertEqual(sorted(self.files()), ["a.bin", "a.gltf"])


def nodes_of(path):
    """The nodes of a GLB."""
    data = path.read_bytes()
    return json.loads(data[20:20 + int.from_bytes(data[12:16], "little")])["nodes"]


class Tilesets(Case):
    def tiled(self, threads, *more, expect=0):
        out = self.dir / f"{threads}"
        run = self.mill("pipe", "-j", threads, "-o", out, "--no-cache", "load", SCAN, "--unit", "mm", "--up", "z", "!",
                        "write", "tileset.json", "--tiles.faces", 4000, *more, expect=expect)
        return run, self.files(out) if out.is_dir() else {}

    def test_the_same_files_from_any_number_of_threads_and_no_others(self):
        run, files = self.tiled(1, "--draco")
        self.assertEqual(files, self.tiled(3, "--draco")[1])
        named = set()
        tiles = [json.loads((self.dir / "1/tileset.json").read_text())["root"]]
        while tiles:
            tile = tiles.pop()
            named.add(tile["content"]["uri"])
            tiles += tile.get("children", [])
        self.assertEqual(set(files), named | {"tileset.json"})
        self.assertRegex(run.stderr, rf"wrote {len(named)} files in .*/tileset/: r\.glb \.\.\. ")
        self.mill("pipe", "load", "1/tileset.json", "!", "validate", "--closed", "--edge_manifold", "--vertex_manifold")

    def test_the_grid_is_no_finer_than_keeps_vertices_apart_in_memory_or_in_cells(self):
        # 1.9 long: 14 bits are steps of 1.9 / 16,383, rounded down to the power of two 2^-14, which 9.5e-5 exceeds.
        points = [f"{x:.7f} {y} 0" for n in range(200) for x in (n * 0.0095, n * 0.0095 + 9.5e-5) for y in (0, 1)]
        points += ["1.9 0 0", "1.9 1 0"]
        strip = [f"3 {k} {k + 2} {k + 1}\n3 {k + 1} {k + 2} {k + 3}" for k in range(0, len(points) - 2, 2)]
        faces = 2 * len(strip)
        header = (f"ply\nformat ascii 1.0\nelement vertex {len(points)}\nproperty double x\nproperty double y\n"
                  f"property double z\nelement face {faces}\nproperty list uchar int vertex_indices\nend_header\n")
        self.write("strip.ply", header + "\n".join(points + strip) + "\n")
        for place in ((), ("--memory", "64M", "--partition", "always")):
            for compressed in ("--draco", "--quantize"):
                self.mill("pipe", *place, "load", "strip.ply", "--unit", "m", "--up", "z", "!", "write", "o/tileset.json",
                          compressed)
                self.assertEqual(nodes_of(self.dir / "o/tileset/r.glb")[0]["scale"], [2**-14] * 3)
                self.mill("pipe", "load", "o/tileset.json", "!", "validate", "--vertices", len(points), "--faces", faces)

    def test_an_implicit_tileset_is_read_with_the_files_that_say_what_it_has(self):
        files = self.tiled(1, "--tiles.tiling", "implicit")[1]
        self.assertEqual(files, self.tiled(2, "--tiles.tiling", "implicit")[1])
        self.assertLess(len(files["tileset.json"]), 2000)
        subtrees = [name for name in files if name.endswith(".subtree")]
        self.write("check.yaml", "facetmill: 1\nstages: [{load: 1/tileset.json}, {validate: {closed: true, faces: 70000}}]\n")
        inputs = self.mill("plan", "check.yaml", "--inputs").stdout.split()
        self.assertTrue(subtrees)
        for name in subtrees:
            self.assertIn(f"1/{name}", inputs)
        self.mill("run", "check.yaml")
        (self.dir / "1" / subtrees[0]).write_bytes(b"subt")
        self.assertIn(f"{subtrees[0]}: error[E-TILESET]", self.mill("run", "check.yaml", expect=6).stderr)

    def test_what_cannot_be_tiled_is_refused_by_name_and_leaves_nothing(self):
        self.write("points.off", "OFF\n2 0 0\n0 0 0\n1 0 0\n")
        for stages, expected in ((("load", "points.off", "!", "write", "o/tileset.json"), "E-EMPTY"),
                                 (("load", SCAN, "!", "write", "o/a.glb", "--tiles", "3d"), "a path that ends in .json"),
                                 (("load", SCAN, "!", "write", "o/a.json", "--tiles", "2d"), "3d"),
                                 (("load", SCAN, "!", "write", "-", "--tiles", "3d"), "a path that ends in .json"),
                                 (("load", SCAN, "!", "write", "o/a.ply", "--format", "ply", "--tiles", "3d"), "3d-tiles")):
            self.assertIn(expected, self.mill("pipe", *stages, expect=None).stderr)
            self.assertFalse((self.dir / "o").exists())


class Language(Case):
    def test_every_pipeline_passes_check(self):
        self.mill("check", *PIPELINES, *FIGURES)

    @unittest.skipIf(jsonschema is None, "python3-jsonschema is missing")
    def test_the_schema_of_pipelines_is_a_schema(self):
        schema = json.loads(self.mill("schema").stdout)
        jsonschema.Draft202012Validator.check_schema(schema)
        validator = jsonschema.Draft202012Validator(schema)
        good = {"facetmill": 1, "x-anchors": 3, "params": {"keep": {"type": "ratio", "default": "10%"}},
                "stages": [{"load": "a.ply"}, "relax", {"relax": None}, {"relax": {"iterations": "${n}"}, "name": "soft"},
                           {"foreach": {"lod": ["50%", "10%"]}, "do": [{"simplify": "${lod}"}]},
                           {"branch": {"near": [{"write": "n.glb"}]}, "when": "${a} == b"}]}
        validator.validate(good)
        for wrong in ({"stages": []}, {"facetmill": 2, "stages": []}, {"facetmill": 1, "stages": ["relux"]},
                      {"facetmill": 1, "stages": [{"relax": {"iteratons": 2}}]},
                      {"facetmill": 1, "stages": [], "stagse": []}):
            self.assertTrue(list(validator.iter_errors(wrong)), wrong)

    @unittest.skipIf(jsonschema is None, "python3-jsonschema is missing")
    def test_info_follows_its_schema(self):
        schema = json.loads(self.mill("schema", "info").stdout)
        info = json.loads(self.mill("info", "--json", SCAN).stdout)
        jsonschema.Draft202012Validator(schema).validate(info)
        self.assertEqual((info["vertices"], info["faces"], info["euler"], info["closed"]), (35002, 70000, 2, True))

    @unittest.skipIf(jsonschema is None, "python3-jsonschema is missing")
    def test_info_tells_of_each_component(self):
        # A tetrahedron, twelve single triangles, and a square.
        points = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]
        faces = [(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)]
        for i in range(12):
            points += [(5 + i, 0, 0), (5.5 + i, 0, 0), (5 + i, 1, 0)]
            faces.append(tuple(range(len(points) - 3, len(points))))
        points += [(0, 9, 0), (1, 9, 0), (1, 10, 0), (0, 10, 0)]
        n = len(points)
        faces += [(n - 4, n - 3, n - 2), (n - 4, n - 2, n - 1)]
        self.write("many.off", "\n".join(["OFF", f"{n} {len(faces)} 0"] + [" ".join(map(str, p)) for p in points]
                                        + [" ".join(map(str, (3, *f))) for f in faces]) + "\n")
        info = json.loads(self.mill("info", "--json", "many.off").stdout)
        jsonschema.Draft202012Validator(json.loads(self.mill("schema", "info").stdout)).validate(info)
        detail = [tuple(c[key] for key in ("faces", "euler", "boundary_loops", "closed", "genus"))
                  for c in info["components_detail"]]
        self.assertEqual(detail[:3], [(4, 2, 0, True, 0), (2, 1, 1, False, None), (1, 1, 1, False, None)])
        self.assertEqual((len(detail), info["components_omitted"]), (14, 0))
        self.assertEqual(sum(c[1] for c in detail), info["euler"])
        text = self.mill("info", "many.off").stdout
        self.assertIn("4 faces, euler 2, closed, genus 0", text)
        self.assertIn("and 4 more", text)

    @unittest.skipIf(jsonschema is None, "python3-jsonschema is missing")
    def test_a_failed_check_has_a_value_and_a_hint(self):
        self.mill("pipe", "--quiet", "--report", "r.json", "generate", "cube", "!", "validate", "--faces", "3",
                  "--closed", "false", "--longest_edge.max", "1.5", expect=1)
        report = json.loads((self.dir / "r.json").read_text())
        jsonschema.Draft202012Validator(json.loads(self.mill("schema", "report").stdout)).validate(report)
        found = {check["name"]: check["found"] for check in report["checks"]}
        after = report["stages"][-1]["after"]
        self.assertEqual((found["faces"], found["closed"]), (after["faces"], True))
        self.assertIsInstance(found["longest_edge"], float)
        hints = {check["name"]: check["hint"] for check in report["checks"]}
        self.assertIn("simplify", hints["faces"])

    @unittest.skipIf(jsonschema is None, "python3-jsonschema is missing")
    def test_each_can_be_included_by_name(self):
        for pipeline in PIPELINES:
            with self.subTest(pipeline=pipeline.name):
                self.write("mine.yaml", f"facetmill: 1\nallow: W-UNITS\nstages:\n  - include: {pipeline.stem}\n"
                                        f"    with: {{input: '{SCAN}'}}\n  - measure\n")
                if "\n  input:" in pipeline.read_text():
                    self.mill("plan", "mine.yaml")

    def test_diff_follows_its_schema(self):
        schema = json.loads(self.mill("schema", "diff").stdout)
        self.write("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n")
        self.write("b.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0.5\n3 0 1 2\n")
        for b, code in (("a.off", 0), ("b.off", 1)):
            diff = json.loads(self.mill("diff", "--json", "a.off", b, expect=code).stdout)
            jsonschema.Draft202012Validator(schema).validate(diff)
            self.assertEqual(diff["same"], code == 0)


if __name__ == "__main__":
    main()
