"""facetmill batch: the table of models with a row per asset, and measure with a row per part."""

import csv
import io
import json
import tarfile
import zipfile

from support import SCAN, Case, main

PIPELINE = """facetmill: 1
allow: W-UNITS
params:
  input: {type: path}
stages:
  - load: "${input}"
  - validate: {closed: true}
  - write: "${input.stem}.ply"
"""
TETRAHEDRON = "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 {}\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n"


class Rows(Case):
    def setUp(self):
        super().setUp()
        self.write("p.yaml", PIPELINE)
        self.write("in/a.off", TETRAHEDRON.format(6))
        self.write("in/b,\"c\".off", TETRAHEDRON.format(3))
        self.write("in/open.off", TETRAHEDRON.format(1).replace("4 4 0", "4 3 0").replace("3 2 0 3\n", ""))
        self.write("in/bad.off", "no mesh")

    def batch(self, *arguments, expect=6):
        return self.mill("batch", "p.yaml", "--input", "in/*.off", "-o", "out", "-k", *arguments, expect=expect)

    def rows(self, name="out/m.csv"):
        with (self.dir / name).open(newline="", encoding="utf-8") as file:
            return {row["asset"]: row for row in csv.DictReader(file)}

    def test_a_row_of_each_model_rejected_ones_too(self):
        self.batch("--table-out", "m.csv", "--table-out", "m.jsonl", "--report", "b.json")
        rows = self.rows()
        self.assertEqual(list(rows), ["in/a.off", "in/b,\"c\".off", "in/bad.off", "in/open.off"], "as the inputs")
        a, bad, hole = rows["in/a.off"], rows["in/bad.off"], rows["in/open.off"]
        self.assertEqual((a["verdict"], a["error"], a["customer"], a["path"]), ("ok", "", "", "in/a.off"))
        self.assertAlmostEqual(float(a["volume"]), 1)
        self.assertEqual([float(a[k]) for k in ("bounds_min_x", "bounds_max_z", "height")], [0, 6, 6])
        self.assertEqual((a["triangles"], a["parts"]), ("4", "1"))
        self.assertEqual(int(a["bytes"]), (self.dir / "out/a.ply").stat().st_size)
        self.assertEqual((bad["verdict"], bad["error"], bad["volume"]), ("failed", "E-OFF", ""))
        self.assertIn("damaged", bad["customer"])
        self.assertEqual((hole["verdict"], hole["error"], hole["volume"], hole["triangles"]), ("failed", "E-CHECK", "", "3"))
        self.assertIn("The model has a hole near (", hole["customer"])
        lines = [json.loads(line) for line in (self.dir / "out/m.jsonl").read_text().splitlines()]
        self.assertEqual([line["asset"] for line in lines], list(rows))
        self.assertEqual(lines[0]["triangles"], 4)
        self.assertIsNone(lines[3]["volume"])
        report = {entry["asset"]: entry for entry in json.loads((self.dir / "out/b.json").read_text())["assets"]}
        for line in lines:
            self.assertEqual(line, {k: v for k, v in report[line["asset"]].items() if not isinstance(v, list)})

    def test_the_same_bytes_for_any_number_of_jobs_and_for_kept_assets(self):
        self.batch("--table-out", "m.csv", "-j1")
        first = (self.dir / "out/m.csv").read_bytes()
        self.batch("--table-out", "m.csv", "-j3")
        self.assertEqual((self.dir / "out/m.csv").read_bytes(), first, "kept")
        self.mill("batch", "p.yaml", "--input", "in/*.off", "-o", "other", "-k", "-j3", "--table-out", "m.csv", expect=6)
        self.assertEqual((self.dir / "other/m.csv").read_bytes(), first)

    def test_assets_done_without_measures_are_measured(self):
        self.write("in/down.off", "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 -1\n3 0 1 2\n3 0 3 1\n3 1 3 2\n3 2 3 0\n")
        self.batch()
        self.batch("--table-out", "m.csv")
        self.assertEqual(self.rows()["in/a.off"]["volume"], "1")
        self.assertEqual(self.rows()["in/down.off"]["overhang_area"], "0", "its slope is 54.7 degrees")
        self.batch("--table-out", "m.csv", "--overhang-angle", "80")
        self.assertAlmostEqual(float(self.rows()["in/down.off"]["overhang_area"]), 3 ** 0.5 / 2)

    def test_names_are_no_formulas(self):
        self.write("=1+2.off", TETRAHEDRON.format(1))
        self.mill("batch", "p.yaml", "--input", "*.off", "-o", "out", "--table-out", "m.csv", "--table-out", "m.jsonl")
        self.assertIn("'=1+2.off", self.rows())
        self.assertEqual(json.loads((self.dir / "out/m.jsonl").read_text())["asset"], "=1+2.off")

    def test_what_is_refused(self):
        self.assertIn("E-FORMAT", self.batch("--table-out", "m.parquet", expect=2).stderr)
        self.assertIn("E-RANGE", self.batch("--table-out", "m.csv", "--overhang-angle", "91", expect=2).stderr)
        self.assertIn("E-DUPLICATE-OUTPUT", self.batch("--table-out", "m.csv", "--table-out", "m.csv", expect=2).stderr)

    def test_measure_per_part_and_scene(self):
        load = ("pipe", "load", "in/a.off", "in/b,\"c\".off", "--unit", "mm", "!")
        self.mill(*load, "measure", "--per", "part", "--path", "parts.csv")
        with (self.dir / "parts.csv").open(newline="") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual([(r["part"], round(float(r["volume"]), 9), r["unit"]) for r in rows],
                         [("a", 1, "mm"), ("b,\"c\"", 0.5, "mm")])
        self.mill(*load, "measure", "--per", "scene", "--path", "one.jsonl")
        one = json.loads((self.dir / "one.jsonl").read_text())
        self.assertAlmostEqual(one["volume"], 1.5)
        self.assertEqual((one["parts"], one["triangles"]), (2, 8))
        self.assertIn("'per' needs a path", self.mill(*load, "measure", "--per", "part", expect=2).stderr)
        self.assertIn("a table of faces", self.mill(*load, "measure", "--path", "x.jsonl", expect=2).stderr)

    def test_a_failed_run_keeps_what_was_measured(self):
        self.mill("run", "p.yaml", "-D", "input=in/open.off", "--report", "r.json", expect=1)
        properties = json.loads((self.dir / "r.json").read_text())["properties"]
        self.assertEqual((properties["faces"], properties["boundary_loops"]), (3, 1))

    def test_a_time_limit_stops_one_asset(self):
        self.write("slow.yaml", PIPELINE.replace("- validate: {closed: true}", "- relax: \"${n}\"")
                   .replace("  input: {type: path}", "  input: {type: path}\n  n: {type: integer}"))
        self.write("t.csv", f"input,n\nin/a.off,1\n{SCAN},100000\nin/open.off,1\n")
        run = self.mill("batch", "slow.yaml", "--table", "t.csv", "-o", "out", "-k", "--time-limit", "5s", "--report", "b.json",
                        "--table-out", "m.csv", expect=7)
        self.assertIn("E-TIME", run.stderr)
        rows = self.rows()
        self.assertEqual([r["verdict"] for r in rows.values()], ["ok", "failed", "ok"])
        self.assertEqual(rows[str(SCAN)]["error"], "E-TIME")
        self.assertIn("takes longer", rows[str(SCAN)]["customer"])
        self.assertFalse((self.dir / "out/nefertiti.ply").exists())
        self.assertFalse(list((self.dir / "out").rglob("*~")), "no temporary is left")
        for wrong in ("fast", "-1s", "0", "5 parsecs"):
            self.assertIn("--time-limit needs a time", self.batch(f"--time-limit={wrong}", expect=2).stderr)

    def test_fifty_failures_in_ten_lines(self):
        for number in range(50):
            self.write(f"many/{number}.off", (TETRAHEDRON.format(1), "no mesh", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n")[number % 3])
        many = ("batch", "p.yaml", "--input", "many/*.off", "-o", "many-out", "-k", "--summary", "by-id")
        run = self.mill(*many, "--report", "b.json", "--report", "b.md", "--report", "b.txt", "--report", "b.html", expect=6)
        said = [line for line in run.stderr.splitlines() if not line.startswith("wrote")]
        self.assertLessEqual(len(said), 10, run.stderr)
        self.assertRegex(run.stderr, r"error +E-OFF +17 assets, first many/1.off")
        self.assertRegex(run.stderr, r"error +E-CHECK closed +16 assets, first many/11.off")
        report = json.loads((self.dir / "many-out/b.json").read_text())
        self.assertNotIn("assets", report)
        self.assertEqual([(c["id"], c["about"], c["assets"]) for c in report["causes"]],
                         [("E-OFF", "", 17), ("E-CHECK", "closed", 16)])
        for name in ("b.md", "b.txt"):
            text = (self.dir / "many-out" / name).read_text()
            self.assertIn("E-CHECK closed", text)
            self.assertLess(len(text.splitlines()), 20)
        self.assertIn("E-CHECK closed", (self.dir / "many-out/b.html").read_text())

    def test_a_report_on_standard_output_and_nothing_else(self):
        run = self.batch("--report", "-")
        self.assertEqual(json.loads(run.stdout)["counts"]["assets"], 4)
        run = self.mill("run", "p.yaml", "-D", "input=in/a.off", "-o", "out", "--report", "-")
        self.assertTrue(json.loads(run.stdout)["passed"])
        run = self.mill("pipe", "--report", "-", "load", "in/a.off", "!", "write", "-", "--format", "ply", expect=2)
        self.assertIn("E-DUPLICATE-OUTPUT", run.stderr)

    def test_the_page_and_markdown_link_to_reports_and_files(self):
        self.write("p.yaml", PIPELINE + 'report: "${input.stem}.report.html"\n')
        self.batch("--report", "pages/b.html", "--report", "pages/b.md", "--report", "b.json", "--pictures", "pictures")
        page, text = (self.dir / "out/pages/b.html").read_text(), (self.dir / "out/pages/b.md").read_text()
        self.assertIn("<h1>in</h1>", page)
        self.assertIn('href="../a.report.html"', page)
        self.assertIn('href="../a.ply"', page)
        self.assertIn("](../a.report.html)", text)
        self.assertIn("![in/a.off](../pictures/a.png)", text.replace("\\", ""))
        self.assertTrue((self.dir / "out/pictures/a.png").read_bytes().startswith(b"\x89PNG"))
        assets = {a["asset"]: a for a in json.loads((self.dir / "out/b.json").read_text())["assets"]}
        self.assertEqual(assets["in/a.off"]["reports"], ["a.report.html"])
        self.assertEqual(assets["in/open.off"]["reports"], ["open.report.html"])
        self.assertEqual(assets["in/a.off"]["files"][0]["bytes"], (self.dir / "out/a.ply").stat().st_size)
        self.batch("--report", "pages/b.md", "--pictures", "pictures", "--link-base", "https://ci.example/7")
        self.assertIn("(https://ci.example/7/pictures/a.png)", (self.dir / "out/pages/b.md").read_text())

    def archives(self, files):
        """m.tar, m.tar.gz and m.zip with these files."""
        for name, mode in (("m.tar", "w"), ("m.tar.gz", "w:gz")):
            with tarfile.open(self.dir / name, mode) as tar:
                for path, text in files.items():
                    entry = tarfile.TarInfo(path)
                    entry.size = len(text)
                    tar.addfile(entry, io.BytesIO(text.encode()))
        with zipfile.ZipFile(self.dir / "m.zip", "w", zipfile.ZIP_DEFLATED) as archive:
            for path, text in files.items():
                archive.writestr(path, text)

    def test_archives_as_inputs_and_outputs(self):
        self.archives({"a.off": TETRAHEDRON.format(6), "sub/" + 120 * "b" + ".off": TETRAHEDRON.format(3), "readme.txt": "no mesh"})
        for name in ("m.tar", "m.tar.gz", "m.zip"):
            out = "out-" + name
            self.mill("batch", "p.yaml", "--archive", name, "-o", out, "--table-out", "m.csv", "--archive-out", "all.tar")
            self.assertEqual(list(self.rows(f"{out}/m.csv")), [f"{name}/a.off", f"{name}/sub/{120 * 'b'}.off"])
            self.assertEqual(self.rows(f"{out}/m.csv")[f"{name}/a.off"]["path"], f"{name}/a.off")
            with tarfile.open(self.dir / out / "all.tar") as tar:
                self.assertEqual(tar.getnames(), ["a.ply", f"sub/{120 * 'b'}.ply"])
                self.assertEqual(tar.extractfile("a.ply").read(), (self.dir / out / "a.ply").read_bytes())
            self.assertFalse(list((self.dir / out).glob(".facetmill-unpacked*")))
        self.mill("batch", "p.yaml", "--archive", "m.zip", "-o", "z", "--archive-out", "all.zip")
        with zipfile.ZipFile(self.dir / "z/all.zip") as archive:
            self.assertIsNone(archive.testzip())
            self.assertEqual(archive.namelist(), ["a.ply", f"sub/{120 * 'b'}.ply"])
        stream = self.mill("batch", "p.yaml", "--archive", "-", "-o", "s", "--archive-out", "-", text=False,
                           stdin=(self.dir / "m.tar").read_bytes()).stdout
        with tarfile.open(fileobj=io.BytesIO(stream)) as tar:
            self.assertEqual(tar.getnames(), ["a.ply", f"sub/{120 * 'b'}.ply"])

    def test_archives_that_are_refused(self):
        for path in ("../a.off", "/a.off", "b/../../a.off", "a\\b.off"):
            self.archives({path: TETRAHEDRON.format(6)})
            for name in ("m.tar", "m.zip"):
                run = self.mill("batch", "p.yaml", "--archive", name, "-o", "out", expect=6)
                self.assertIn("E-ARCHIVE", run.stderr, (name, path))
        self.assertFalse((self.dir / "a.off").exists())
        self.archives({"a.off": TETRAHEDRON.format(6), "A.off": TETRAHEDRON.format(6)})
        self.assertIn("E-ARCHIVE", self.mill("batch", "p.yaml", "--archive", "m.tar", "-o", "out", expect=6).stderr)
        self.archives({"a.off": TETRAHEDRON.format(6) + " " * (100 << 20)})
        for name in ("m.tar.gz", "m.zip"):
            self.assertIn("E-SIZE", self.mill("batch", "p.yaml", "--archive", name, "-o", "out", expect=7).stderr)
        (self.dir / "m.tar").write_bytes((self.dir / "m.tar").read_bytes()[:600])
        self.assertIn("E-TAR", self.mill("batch", "p.yaml", "--archive", "m.tar", "-o", "out", expect=6).stderr)
        self.archives({"readme.txt": "no mesh"})
        self.assertIn("holds no meshes", self.mill("batch", "p.yaml", "--archive", "m.tar", "-o", "out", expect=3).stderr)
        self.assertIn("E-FORMAT", self.batch("--archive-out", "a.rar", expect=2).stderr)
        self.assertIn("E-DUPLICATE-OUTPUT", self.batch("--archive-out", "-", "--report", "-", expect=2).stderr)


if __name__ == "__main__":
    main()
