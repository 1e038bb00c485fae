"""facetmill batch: the table of models with a row per asset, and measure with a row per part."""

import csv
import json

from support import Case, main

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
        self.batch()
        self.batch("--table-out", "m.csv")
        self.assertEqual(self.rows()["in/a.off"]["volume"], "1")
        self.batch("--table-out", "m.csv", "--overhang-angle", "80")
        self.assertNotEqual(self.rows()["in/a.off"]["overhang_area"], "0")

    def test_names_are_no_formulas(self):
        self.write("=1+2.off", TETRAHEDRON.format(1))
        self.mill("batch", "p.yaml", "--input", "*.off", "-o", "out", "--table-out", "m.csv", "--table-out", "m.jsonl")
        self.assertIn("'=1+2.off", self.rows())
        self.assertEqual(json.loads((self.dir / "out/m.jsonl").read_text())["asset"], "=1+2.off")

    def test_what_is_refused(self):
        self.assertIn("E-FORMAT", self.batch("--table-out", "m.parquet", expect=2).stderr)
        self.assertIn("E-RANGE", self.batch("--table-out", "m.csv", "--overhang-angle", "91", expect=2).stderr)
        self.assertIn("E-DUPLICATE-OUTPUT", self.batch("--table-out", "a.ply", "--table-out", "m.csv", "--report", "m.csv",
                                                       expect=2).stderr)

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


if __name__ == "__main__":
    main()
