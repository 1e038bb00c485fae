"""facetmill batch: many assets in one process. What is written, what is left alone, what is refused, what a signal leaves."""

import json
import os
import signal
import subprocess
import time

from support import FACETMILL, SCAN, Case, main

PIPELINE = """facetmill: 1
allow: W-UNITS
params:
  input: {type: path}
  n: {type: integer, default: 1}
stages:
  - load: "${input}"
  - relax: "${n}"
  - write: "${input.stem}.ply"
report: "${input.stem}.json"
"""


def tetrahedron(height=1):
    return f"OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 {height}\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n"


class Batch(Case):
    def setUp(self):
        super().setUp()
        self.write("p.yaml", PIPELINE)
        for number, name in enumerate(("a.off", "sub/b.off", "sub/deep/c.off"), 1):
            self.write(f"in/{name}", tetrahedron(number))

    def batch(self, *arguments, expect=0, **how):
        if not any(a in arguments for a in ("--input", "--inputs-from", "--table")):
            arguments = ("--input", "in/**/*.off", *arguments)
        return self.mill("batch", "p.yaml", "-o", "out", *arguments, expect=expect, **how)

    def written(self, folder="out"):
        return {n: s for n, s in self.files(self.dir / folder).items() if not n.startswith(".facetmill-batch")}

    def state(self):
        """What the batch has noted so far."""
        return "".join(p.read_text() for p in (self.dir / "out").glob(".facetmill-batch.p-*.jsonl"))

    def done_anew(self, *arguments, expect=0):
        """The assets that this batch did not leave alone."""
        self.batch("--timings", "t.json", *arguments, expect=expect)
        path = self.dir / "out/t.json"
        timings = json.loads(path.read_text())
        path.unlink()
        return [a["asset"] for a in timings["assets"] if not a["kept"]]

    def test_as_a_run_of_each(self):
        self.batch()
        for name in ("a", "sub/b", "sub/deep/c"):
            self.mill("run", "p.yaml", "-D", f"input=in/{name}.off", "-o", self.dir / "each" / os.path.dirname(name))
        self.assertEqual(self.written(), self.written("each"))
        self.assertEqual(len(self.written()), 6)

    def test_any_number_of_jobs(self):
        for number in range(12):
            self.write(f"in/{number}.off", tetrahedron(number + 1))
        for jobs in (1, 3):
            self.mill("batch", "p.yaml", "--input", "in/**/*.off", "--input", SCAN, "-D", "n=3", "-o", f"out{jobs}",
                      "-j", jobs, "--report", "s.json", "--report", "s.html", "--report", "s.xml", "--report", "s.txt")
        self.assertEqual(self.written("out1"), self.written("out3"))
        self.assertEqual(len(self.written("out1")), 2 * 16 + 4)
        self.assertIn("data:image/png", (self.dir / "out1/s.html").read_text())

    def test_what_is_done_is_left_alone(self):
        self.assertEqual(len(self.done_anew()), 3)
        first = self.written()
        self.assertEqual(self.done_anew(), [])
        os.utime(self.dir / "in/a.off")
        self.assertEqual(self.done_anew(), [], "its content is the same")
        self.write("in/a.off", tetrahedron(7))
        self.assertEqual(self.done_anew(), ["in/a.off"])
        self.assertNotEqual(self.written()["a.ply"], first["a.ply"])
        (self.dir / "out/sub/b.ply").unlink()
        self.assertEqual(self.done_anew(), ["in/sub/b.off"])
        (self.dir / "out/sub/b.ply").write_text("something else")
        self.assertEqual(self.done_anew(), ["in/sub/b.off"])
        self.assertEqual(self.written()["sub/b.ply"], first["sub/b.ply"])
        self.write("p.yaml", "# a comment\n" + PIPELINE.replace("\nstages", "\n\nstages"))
        self.assertEqual(self.done_anew(), [], "comments and blanks do not matter")
        self.assertEqual(len(self.done_anew("-D", "n=2")), 3)

    def test_a_file_that_is_missing_beside_an_input(self):
        """It may stay missing; when it comes, the asset is made anew."""
        self.write("in/a.obj", "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl red\nf 1 2 3\n")
        obj = ("--input", "in/*.obj", "--allow", "W-MTL")
        self.assertEqual(self.done_anew(*obj), ["in/a.obj"])
        self.assertEqual(self.done_anew(*obj), [])
        self.write("in/a.mtl", "newmtl red\nKd 1 0 0\n")
        self.assertEqual(self.done_anew(*obj), ["in/a.obj"])
        self.assertEqual(self.done_anew(*obj), [])
        (self.dir / "in/a.mtl").unlink()
        self.assertEqual(self.done_anew(*obj), ["in/a.obj"])

    def test_a_report_of_what_was_kept(self):
        self.write("in/bad.off", "bad")
        reports = ("--report", "s.json", "--report", "s.xml", "--report", "s.txt", "-k")
        self.batch(*reports, expect=6)
        first = self.written()
        self.batch(*reports, expect=6)
        self.assertEqual(self.written(), first)

    def test_pictures_of_what_was_kept(self):
        """A batch that wants pictures runs assets again that were done without."""
        self.assertEqual(len(self.done_anew()), 3)
        pictured = ("--report", "review.md", "--pictures", "png", "--link-base", "https://ci.example/7")
        for anew in (3, 0):
            self.assertEqual(len(self.done_anew(*pictured)), anew)
            text = (self.dir / "out/review.md").read_text()
            pictures = [p.relative_to(self.dir / "out") for p in (self.dir / "out/png").rglob("*.png")]
            self.assertEqual(len(pictures), 3)
            for picture in pictures:
                self.assertIn(f"](https://ci.example/7/{picture})", text)

    def test_kill_and_resume(self):
        self.write("t.csv", "input,n\nin/a.off,1\nin/sub/b.off,1\n" + f"{SCAN},100000\n")
        run = subprocess.Popen([str(FACETMILL), "batch", "p.yaml", "--table", "t.csv", "-o", "out", "-j1"], cwd=self.dir,
                               stderr=subprocess.DEVNULL)
        deadline = time.monotonic() + 120
        while self.state().count("\n") < 2:
            self.assertIsNone(run.poll(), "it ended early")
            self.assertLess(time.monotonic(), deadline)
            time.sleep(0.01)
        run.kill()
        run.wait()
        with next((self.dir / "out").glob(".facetmill-batch.p-*.jsonl")).open("a") as torn:
            torn.write('{"asset": "torn')
        self.write("t.csv", "input,n\nin/a.off,1\nin/sub/b.off,1\n" + f"{SCAN},1\n")
        self.assertEqual(self.done_anew("--table", "t.csv"), [str(SCAN)])
        left = self.dir / f"out/in/.a.ply.facetmill-{run.pid}~"
        left.write_text("a temporary of the killed process, whose asset was done")
        self.assertEqual(self.done_anew("--table", "t.csv"), [])
        self.assertFalse(left.exists())
        self.assertEqual(sorted(self.written()), ["in/a.json", "in/a.ply", "in/sub/b.json", "in/sub/b.ply",
                                                  "nefertiti.json", "nefertiti.ply"])

    def test_failures(self):
        self.write("in/0.off", "bad")
        self.write("in/gone.off", tetrahedron())
        run = self.batch("-j1", "--report", "s.json", expect=6)
        self.assertIn("1 failed, 4 not run", run.stderr)
        self.assertNotIn("a.ply", self.written())
        self.batch("-k", "--report", "s.json", "--report", "s.xml", "--report", "s.txt", expect=6)
        summary = json.loads((self.dir / "out/s.json").read_text())
        self.assertEqual(summary["counts"], {"assets": 5, "ok": 4, "failed": 1, "interrupted": 0, "not_run": 0})
        self.assertEqual([a["asset"] for a in summary["assets"]][0], "in/0.off", "the worst is first")
        self.assertFalse(summary["passed"])
        self.assertIn('errors="1"', (self.dir / "out/s.xml").read_text())
        self.assertIn("4 ok, 1 failed", (self.dir / "out/s.txt").read_text())

    def test_the_report_follows_its_schema(self):
        try:
            import jsonschema
        except ImportError:
            self.skipTest("python3-jsonschema is missing")
        schema = json.loads(self.mill("schema", "batch").stdout)
        jsonschema.Draft202012Validator.check_schema(schema)
        self.write("in/0.off", "bad")
        for arguments, code in ((("-k",), 6), (("-j1",), 6), (("--input", "none/*.off"), 3), (("-D", "n=x"), 2)):
            self.batch(*arguments, "--report", "s.json", expect=code)
            if (self.dir / "out/s.json").exists():
                jsonschema.validate(json.loads((self.dir / "out/s.json").read_text()), schema)
        self.assertTrue((self.dir / "out/s.json").exists())

    def test_the_most_severe_exit_code(self):
        self.write("p.yaml", PIPELINE.replace('- write', '- validate: {faces: 4}\n  - write'))
        self.write("in/check.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n")
        self.batch("-k", expect=1)
        self.write("in/zz.off", "bad")
        self.batch("-k", expect=6)

    def test_what_is_missing_is_found_first(self):
        self.write("list", "in/a.off\nin/none.off\n")
        run = self.batch("--inputs-from", "list", expect=3)
        self.assertIn("in/none.off", run.stderr)
        self.assertFalse((self.dir / "out").exists())
        self.batch("--inputs-from", "list", "--report", "s.json", "--report", "s.xml", expect=3)
        summary = json.loads((self.dir / "out/s.json").read_text())
        self.assertEqual((summary["exit_code"], summary["errors"][0]["id"]), (3, "E-FILE"))
        self.assertEqual(summary["counts"]["not_run"], 2)
        self.assertIn('name="E-FILE"', (self.dir / "out/s.xml").read_text())
        self.batch("--inputs-from", "list", "-k", expect=3)
        self.assertIn("in/a.ply", self.written())

    def test_collisions_are_found_first(self):
        self.write("in/A.off", tetrahedron())
        run = self.batch(expect=2)
        self.assertIn("E-DUPLICATE-OUTPUT", run.stderr)
        self.assertIn("the same file if case is ignored", run.stderr)
        self.assertIn("differ only in case", run.stderr)
        (self.dir / "in/A.off").rename(self.dir / "in/a.ply")
        run = self.batch("--input", "in/**/*", expect=2)
        self.assertIn("is written for in/a.off and for in/a.ply", run.stderr)
        self.assertIn("${input.name}.glb", run.stderr)
        (self.dir / "in/a.ply").unlink()
        self.write("p.yaml", PIPELINE.replace('"${input.stem}.ply"', "one.ply"))
        run = self.batch("--base", "nowhere", expect=2)
        self.assertIn("'out/one.ply' is written for in/a.off and for in/sub/b.off", run.stderr)
        self.assertFalse((self.dir / "out").exists())
        self.write("p.yaml", PIPELINE.replace(".ply", ".off").replace("report", "x-report"))
        run = self.mill("batch", "p.yaml", "--input", "in/*.off", "-o", "in", expect=2)
        self.assertIn("E-OVERWRITE", run.stderr)
        self.write("p.yaml", PIPELINE)
        self.assertIn("E-DUPLICATE-OUTPUT", self.batch("--report", "a.json", expect=2).stderr)
        names = self.write("out/list.txt", "in/a.off\n")
        run = self.batch("--inputs-from", names, "--report", "list.txt", expect=2)
        self.assertIn("E-OVERWRITE", run.stderr)
        self.assertEqual(names.read_text(), "in/a.off\n")

    def test_nothing_matches(self):
        run = self.batch("--input", "in/**/*.stl", expect=3)
        self.assertIn("no file matches 'in/**/*.stl'", run.stderr)
        self.assertIn("^~~", run.stderr)
        self.assertIn("give --input, --inputs-from or --table", self.mill("batch", "p.yaml", "-o", "out", expect=2).stderr)

    def test_odd_names(self):
        names = ["blank s", "$HOME", "#1", "100%", "'q'\"", "ünïcode", "[a]", "new\nline", "${input}", "a&b;c", "-dash"]
        for name in names:
            (self.dir / "odd").mkdir(exist_ok=True)
            (self.dir / "odd" / f"{name}.off").write_text(tetrahedron())
        self.mill("batch", "p.yaml", "--input", "odd/*.off", "-o", "glob")
        found = b"\0".join(os.fsencode(f"odd/{name}.off") for name in names)
        run = self.mill("batch", "p.yaml", "--inputs-from", "-", "-o", "list", "--base", "odd", stdin=found, text=False)
        self.assertIn(b"new\\x0aline", run.stderr)
        self.assertEqual(self.written("glob"), self.written("list"))
        self.assertEqual(len(self.written("glob")), 2 * len(names))
        run = self.mill("batch", "p.yaml", "--input", "odd/[[]a].off", "--input", "odd/[a].off", "-o", "one")
        self.assertIn("1 asset: 1 ok", run.stderr)

    def test_prune(self):
        self.batch()
        (self.dir / "in/sub/deep/c.off").unlink()
        self.write("in/d.off", tetrahedron())
        self.write("out/mine.txt", "not of a batch")
        self.batch()
        self.assertIn("sub/deep/c.ply", self.written(), "only --prune removes")
        self.batch("--input", "in/sub/*.off", "--prune")
        self.assertEqual(sorted(self.written()), ["a.json", "a.ply", "b.json", "b.ply", "d.json", "d.ply", "mine.txt"],
                         "c has no source, b is at another place, a and d are not of this batch")
        self.assertFalse((self.dir / "out/sub").exists())
        (self.dir / "in/d.off").unlink()
        (self.dir / "out/d.ply").write_text("changed by hand")
        self.batch("--prune")
        self.assertIn("d.ply", self.written())
        self.assertNotIn("d.json", self.written())

    def test_prune_when_nothing_is_left(self):
        self.batch()
        for name in ("a.off", "sub/b.off", "sub/deep/c.off"):
            (self.dir / "in" / name).unlink()
        self.assertIn("no file matches", self.batch(expect=3).stderr)
        self.assertIn("no file matches", self.batch("--input", "im/**/*.off", "--prune", expect=3).stderr)
        self.assertEqual(len(self.written()), 6)
        self.assertIn("0 assets", self.batch("--prune").stderr)
        self.assertEqual(self.written(), {})

    def test_prune_removes_nothing_of_what_is_out_of_reach(self):
        self.batch()
        self.write("list", "")
        self.assertIn("lists no files", self.batch("--inputs-from", "list", "--prune", expect=3).stderr)
        (self.dir / "in").rename(self.dir / "elsewhere")  # as a disk that is not mounted
        self.assertIn("mount its disk if it has one", self.batch("--prune", expect=3).stderr)
        self.assertIn("'in' is missing", self.batch("--input", "in/a.off", "--prune", expect=3).stderr)
        (self.dir / "in").mkdir()  # its mount point
        self.assertIn("mount its disk if it has one", self.batch("--prune", expect=3).stderr)
        self.assertEqual(len(self.written()), 6)
        (self.dir / "in").rmdir()
        (self.dir / "elsewhere").rename(self.dir / "in")
        self.assertEqual(self.done_anew("--prune"), [])

    def test_prune_of_several_folders_of_which_one_is_out_of_reach(self):
        self.write("disk/d.off", tetrahedron(4))
        (self.dir / "in/link").symlink_to(self.dir / "disk")
        pattern = ("--input", "in/*/*.off", "--prune")
        self.batch(*pattern)
        self.assertIn("link/d.ply", self.written())
        (self.dir / "disk").rename(self.dir / "elsewhere")
        said = self.batch(*pattern).stderr
        self.assertIn("W-PRUNE", said)
        self.assertIn("in/link/d.off", said)
        self.assertIn("link/d.ply", self.written())
        (self.dir / "elsewhere").rename(self.dir / "disk")
        self.assertEqual(self.done_anew(*pattern), [])
        (self.dir / "disk/d.off").unlink()
        self.assertNotIn("W-PRUNE", self.batch(*pattern).stderr)
        self.assertNotIn("link/d.ply", self.written())

    def test_prune_of_several_folders_of_which_one_is_not_mounted(self):
        (self.dir / "in/disk").mkdir()
        mount = ["mount", "-t", "tmpfs", "tmpfs", str(self.dir / "in/disk")]
        if subprocess.run(mount, capture_output=True).returncode:
            self.skipTest("only root may mount")
        unmount = ["umount", str(self.dir / "in/disk")]
        self.addCleanup(subprocess.run, unmount, check=False, capture_output=True)
        self.write("in/disk/d.off", tetrahedron(4))
        self.batch("--prune")
        subprocess.run(unmount, check=True)
        self.assertIn("in/disk/d.off", self.batch("--prune").stderr)
        (self.dir / "in/disk").rmdir()
        self.assertIn("W-PRUNE", self.batch("--prune").stderr)
        self.assertIn("disk/d.ply", self.written())

    def test_the_pipeline_allows_what_the_cache_tells(self):
        self.write("file", "")
        no_cache = {"env": {"FACETMILL_CACHE": str(self.dir / "file/cache")}}
        everything = ("--cache-everything", "--input", "in/a.off")
        self.assertIn("W-CACHE", self.batch(*everything, **no_cache).stderr)
        self.write("p.yaml", PIPELINE.replace("allow: W-UNITS", "allow: [W-UNITS, W-CACHE]"))
        self.assertEqual(self.done_anew(*everything, "-q"), ["in/a.off"])
        self.write("p.yaml", PIPELINE.replace("allow: W-UNITS", "allow: [W-CACHE, W-UNITS]").replace("ply", "stl"))
        self.assertNotIn("W-CACHE", self.batch(*everything, **no_cache).stderr)

    def test_prune_takes_the_reports_of_what_failed(self):
        self.write("in/junk.off", "no mesh")
        self.batch("-k", expect=6)
        self.assertIn("junk.json", self.written())
        (self.dir / "in/junk.off").unlink()
        self.write("in/a.off", "no mesh")
        self.batch("-k", expect=6)
        self.assertIn("a.ply", self.written(), "an output of before stays")
        self.write("in/a.off", tetrahedron())
        self.assertEqual(self.done_anew("--prune"), ["in/a.off"])
        self.assertEqual(sorted(self.written()), ["a.json", "a.ply", "sub/b.json", "sub/b.ply", "sub/deep/c.json",
                                                  "sub/deep/c.ply"])

    def test_warnings_of_the_batch_itself(self):
        self.write("in/junk.off", "no mesh")
        self.assertIn("W-PRUNE", self.batch("-k", "--prune", expect=6).stderr)
        self.assertNotIn("W-PRUNE", self.batch("-k", "--prune", "--allow", "W-PRUNE", expect=6).stderr)
        self.write("p.yaml", PIPELINE.replace("allow: W-UNITS", "allow: [W-UNITS, W-PRUNE]"))
        self.assertNotIn("W-PRUNE", self.batch("-k", "--prune", expect=6).stderr)
        self.write("p.yaml", PIPELINE.replace('- relax: "${n}"', "- validate: {faces: 5}"))
        for strict in ("--strict", "--strict=W-PRUNE"):
            run = self.batch("-k", "--prune", strict, "--report", "s.json", expect=6)
            self.assertIn("--strict makes W-PRUNE fail", run.stderr)
            self.assertIn("E-STRICT", [e["id"] for e in json.loads((self.dir / "out/s.json").read_text())["errors"]])
        (self.dir / "in/junk.off").unlink()
        self.assertNotIn("E-STRICT", self.batch("-k", "--prune", "--strict=W-STATE", expect=1).stderr)

    def test_prune_leaves_what_it_does_not_know(self):
        self.batch()
        # Another pipeline of the same name, whose outputs are its own.
        other = self.write("other/p.yaml", PIPELINE.replace(".ply", ".stl"))
        self.mill("batch", other, "--input", "in/**/*.off", "-o", "out", "--prune")
        self.mill("batch", other, "--input", "in/**/*.off", "-o", "out", "--prune")
        self.assertIn("a.ply", self.written())
        (self.dir / "in/sub/b.off").unlink()
        self.write("p.yaml", PIPELINE.replace(".ply", ".obj"))
        self.batch("--prune")
        self.assertIn("sub/b.stl", self.written())
        self.assertNotIn("sub/b.ply", self.written())
        self.assertNotIn("a.ply", self.written())
        self.assertIn("a.json", self.written(), "both write it")
        # One that fails: what it would write is not known.
        (self.dir / "in/a.off").unlink()
        self.write("in/junk.off", "no mesh")
        self.assertIn("W-PRUNE", self.batch("--prune", "-k", expect=6).stderr)
        self.assertIn("a.obj", self.written())
        # A source that cannot be looked at is not gone.
        (self.dir / "in/junk.off").unlink()
        if os.getuid() != 0:
            (self.dir / "in/sub/deep").chmod(0)
            self.batch("--input", "in/sub", "--prune", expect=None)
            (self.dir / "in/sub/deep").chmod(0o755)
            self.assertIn("sub/deep/c.obj", self.written())

    def test_an_error_is_told_once(self):
        self.write("in/junk.off", "no mesh")
        run = self.batch("-k", "-j1", "--report", "s.txt", expect=6)
        self.assertEqual(run.stderr.count("error[E-"), 1, run.stderr)
        message = next(line for line in run.stderr.splitlines() if "error[E-" in line).split("]: ")[1]
        self.assertEqual(run.stderr.count(message), 1, run.stderr)
        self.assertRegex(run.stderr, r"  failed       in/junk.off  exit code 6  E-[A-Z]+  ")
        self.assertIn(message, (self.dir / "out/s.txt").read_text())

    def test_names_of_parts_collide(self):
        parts = "".join(f"o {name}\nv {i} 0 0\nv {i} 1 0\nv {i} 0 1\nf -3 -2 -1\n" for i, name in enumerate(("left", "right")))
        self.write("v/z.obj", parts)
        self.write("v/left.obj", "# mine\n" + parts)
        self.write("p.yaml", "facetmill: 1\nallow: W-UNITS\nparams: {input: {type: path}}\nstages:\n  - load: '${input}'\n"
                             "  - foreach: {part: '*'}\n    do: [{write: '${part}.obj'}]\n")
        before = (self.dir / "v/left.obj").read_text()
        said = self.mill("batch", "p.yaml", "--input", "v/*.obj", "-o", "v", "-j1", "-k", expect=2).stderr
        self.assertIn("would overwrite an input of v/left.obj", said)
        self.assertEqual((self.dir / "v/left.obj").read_text(), before)
        # Of two assets the second fails, before it has written; also when the first is left alone.
        self.write("w/a.obj", parts)
        self.mill("batch", "p.yaml", "--input", "w/*.obj", "-o", "out", "-j1")
        first = self.written()
        self.write("w/b.obj", parts.replace("v 1", "v 2"))
        for _ in range(2):
            said = self.mill("batch", "p.yaml", "--input", "w/*.obj", "-o", "out", "-j1", "-k", expect=4).stderr
            self.assertIn("E-DUPLICATE-OUTPUT", said)
            self.assertEqual(self.written(), first)

    def test_what_the_batch_itself_reads_and_writes(self):
        self.write("t.csv", "input,n\nin/a.off,1\n")
        for arguments in (("--table", "t.csv", "--report", "s.json", "--timings", "s.json"),
                          ("--table", "t.csv", "--timings", "../t.csv"), ("--timings", "../p.yaml"),
                          ("--table", "t.csv", "-D", "n=x", "--timings", "../in/a.off")):
            before = self.files()
            self.batch(*arguments, expect=2)
            self.assertEqual(self.files(), before, arguments)
        self.assertIn("E-ARGUMENT", self.batch("--memory", "0G", expect=2).stderr)
        self.assertIn("at most", self.batch("--memory", "1e15T", expect=2).stderr)
        self.assertIn("8GB (1000000000 bytes each) or 8GiB", self.batch("--memory", "8gb", expect=2).stderr)
        for size in ("8G", "8GB", "8GiB", "8g", "50%", "100000000"):
            self.batch("--memory", size)

    def test_prune_of_outputs_that_have_another_name_now(self):
        self.batch()
        self.write("p.yaml", PIPELINE.replace(".ply", ".stl"))
        self.batch("--prune")
        self.assertEqual(sorted(self.written()), ["a.json", "a.stl", "sub/b.json", "sub/b.stl", "sub/deep/c.json",
                                                  "sub/deep/c.stl"])

    def test_an_include_and_a_preset_are_inputs(self):
        self.write("more/a.yaml", "facetmill: 1\nparams: {n: integer}\nstages: [{relax: '${n}'}]\n")
        self.write("set.yaml", "n: 2\n")
        self.write("p.yaml", PIPELINE.replace('- relax: "${n}"', "- {include: more/a.yaml, with: {n: '${n}'}}"))
        one = ("--input", "in/a.off", "-p", "set.yaml")
        self.assertEqual(self.done_anew(*one), ["in/a.off"])
        self.assertEqual(self.done_anew(*one), [])
        self.write("more/a.yaml", "facetmill: 1\nparams: {n: integer}\nstages: [{relax: '${n}'}, {split: midpoint}]\n")
        self.assertEqual(self.done_anew(*one), ["in/a.off"])
        self.write("set.yaml", "n: 3\n")
        self.assertEqual(self.done_anew(*one), ["in/a.off"])
        arguments = ("p.yaml", "-D", "input=in/a.off", "-p", "set.yaml")
        self.assertEqual(self.mill("plan", *arguments, "--inputs").stdout.split(), ["in/a.off", "set.yaml", "more/a.yaml"])
        self.mill("run", *arguments, "-o", "run", "--depfile", "run.d")
        for name in ("p.yaml", "in/a.off", "set.yaml", "more/a.yaml"):
            self.assertIn(f"\n{name}:", (self.dir / "run.d").read_text())
        for engine in ("ninja", "make", "snakemake"):
            self.assertIn("more/a.yaml", self.mill("export", "--to", engine, "p.yaml", *one, "-o", "out").stdout)

    def test_lists_in_tables(self):
        self.write("p.yaml", """facetmill: 1
allow: W-UNITS
params:
  input: path
  rounds: {type: list, of: integer, default: [1], max: 9}
stages:
  - load: "${input}"
  - foreach: {round: "${rounds}"}
    do: [{relax: "${round}"}, {write: "${input.stem}.${round}.ply"}]
""")
        wanted = ["in/a.1.ply", "in/a.3.ply", "in/sub/b.1.ply"]
        self.write("t.csv", 'input,rounds\nin/a.off,"1,3"\nin/sub/b.off,\n')
        self.write("t.yaml", "- {input: in/a.off, rounds: [1, 3]}\n- {input: in/sub/b.off}\n")
        for table in ("t.csv", "t.yaml"):
            self.mill("batch", "p.yaml", "--table", table, "-o", table[2:])
            self.assertEqual(sorted(self.written(table[2:])), wanted)
        self.assertEqual(self.written("csv"), self.written("yaml"))
        self.mill("run", "p.yaml", "-D", "input=in/a.off", "-D", "rounds=[1, 3]", "-o", "run/in")
        self.assertEqual(self.written("run").items() - self.written("csv").items(), set())
        self.write("t.csv", 'input,rounds\nin/a.off,"1,30"\n')
        self.write("t.yaml", "- input: in/a.off\n  rounds: [1, 30]\n")
        self.assertIn("t.csv:2:13: error[E-RANGE]", self.batch("--table", "t.csv", expect=2).stderr)
        self.assertIn("t.yaml:2:15: error[E-RANGE]", self.batch("--table", "t.yaml", expect=2).stderr)

    def test_tables(self):
        self.write("t.csv", 'input,n\r\n"in/a.off",2\r\n\r\nin/sub/b.off,\r\n')
        self.batch("--table", "t.csv", "-D", "n=3")
        self.write("t.yaml", "- {input: in/a.off, n: 2}\n- {input: in/sub/b.off, n: 3}\n")
        self.mill("batch", "p.yaml", "--table", "t.yaml", "-o", "yaml")
        self.assertEqual(self.written(), self.written("yaml"))
        self.assertEqual(json.loads((self.dir / "out/in/a.json").read_text())["params"]["n"], 2)
        for text, said, code in (("input,n\nin/a.off,x\n", "t.csv:2:10", 2), ("input,n\nin/a.off\n", "t.csv:2:1", 6),
                                 ('input,n\n"in/a.off,1\n', "a quote is not closed", 6), ("", "is empty", 6),
                                 ("input,m\nin/a.off,1\n", "t.csv:2:10", 2), ("input,input\na,b\n", "t.csv:1:7", 6)):
            self.write("t.csv", text)
            self.assertIn(said, self.batch("--table", "t.csv", expect=code).stderr)

    def test_an_interrupted_batch(self):
        for number in (signal.SIGINT, signal.SIGTERM):
            self.write("t.csv", f"input,n\nin/a.off,1\n{SCAN},100000\nin/sub/b.off,1\n")
            run = subprocess.Popen([str(FACETMILL), "batch", "p.yaml", "--table", "t.csv", "-o", "out", "-j1", "--report",
                                    "s.json"], cwd=self.dir, stderr=subprocess.PIPE, text=True)
            deadline = time.monotonic() + 120
            while not self.state():
                self.assertIsNone(run.poll(), "it ended early")
                self.assertLess(time.monotonic(), deadline)
                time.sleep(0.01)
            time.sleep(0.2)
            run.send_signal(number)
            said = run.communicate(timeout=60)[1]
            self.assertEqual(run.returncode, -number)
            self.assertIn("1 ok, 1 interrupted, 1 not run", said)
            summary = json.loads((self.dir / "out/s.json").read_text())
            self.assertEqual([a["verdict"] for a in summary["assets"]], ["interrupted", "not run", "ok"])
            self.assertEqual(sorted(self.written()), ["in/a.json", "in/a.ply", "s.json"])
            for path in (self.dir / "out").rglob("*"):
                if path.is_file():
                    path.unlink()

    def test_two_batches_over_one_folder(self):
        self.write("t.csv", f"input,n\nin/a.off,1\n{SCAN},100000\n")
        first = subprocess.Popen([str(FACETMILL), "batch", "p.yaml", "--table", "t.csv", "-o", "out", "-j1"],
                                 cwd=self.dir, stderr=subprocess.DEVNULL)
        try:
            while not self.state():
                self.assertIsNone(first.poll(), "it ended early")
                time.sleep(0.01)
            self.assertIn("E-BUSY", self.batch(expect=4).stderr)
        finally:
            first.kill()
            first.wait()
        self.batch()

    def test_a_jobserver(self):
        fifo = self.dir / "fifo"
        os.mkfifo(fifo)
        both = os.open(fifo, os.O_RDWR | os.O_NONBLOCK)
        self.addCleanup(os.close, both)
        into = os.dup(both)
        self.addCleanup(os.close, into)
        os.set_inheritable(both, True)
        os.set_inheritable(into, True)
        for auth in (f"fifo:{fifo}", f"{both},{into}"):
            os.write(both, b"xy")
            run = subprocess.run([str(FACETMILL), "batch", "p.yaml", "--input", "in/**/*.off", "-o", "out" + auth[:1]],
                                 cwd=self.dir, env={**os.environ, "MAKEFLAGS": f" -j3 --jobserver-auth={auth}"},
                                 capture_output=True, text=True, pass_fds=(both, into), timeout=300)
            self.assertEqual(run.returncode, 0, run.stderr)
            self.assertEqual(sorted(os.read(both, 9)), sorted(b"xy"), "the tokens are back as they were")

    def test_under_make(self):
        self.write("Makefile", f"all:\n\t+{FACETMILL} batch p.yaml --input 'in/**/*.off' -o out\n")
        subprocess.run(["make", "-j2"], cwd=self.dir, check=True, capture_output=True, timeout=300)
        self.assertEqual(len(self.written()), 6)

    def test_arguments(self):
        for arguments, said in ((("--memory", "much"), "--memory needs a size"), (("--report", "r.pdf"), "E-REPORT"),
                                (("--set", "relax.x=1"), "E-"), (("-j", "0"), "E-ARGUMENT")):
            self.assertIn(said, self.batch(*arguments, expect=2).stderr)
        self.assertIn("FACETMILL_JOBS", self.batch(env={"FACETMILL_JOBS": "many", "MAKEFLAGS": ""}, expect=2).stderr)
        self.batch("--memory", "1K", "-j3", env={"FACETMILL_JOBS": "2"})
        self.assertEqual(len(self.written()), 6, "each alone")

    def test_the_pipeline_from_standard_input(self):
        self.mill("batch", "-", "--input", "in/**/*.off", "-o", "out", stdin=PIPELINE)
        self.assertEqual(len(self.written()), 6)
        self.write("p.yaml", PIPELINE.replace('load: "${input}"', "load: '-'"))
        self.assertIn("E-DUPLICATE-INPUT", self.batch(expect=2).stderr)
        run = self.mill("batch", "-", "--inputs-from", "-", "-o", "out", stdin=PIPELINE, expect=2)
        self.assertIn("E-DUPLICATE-INPUT", run.stderr)


if __name__ == "__main__":
    main()
