"""facetmill export --keep-cells: one run in cells as jobs of Ninja, Make and Snakemake, whose outputs are those of the run."""

import fcntl
import os
import re
import signal
import subprocess
import time

from support import FACETMILL, LargeCase, main

PIPELINE = """facetmill: 1
allow: W-UNITS
params: {input: {type: path}, keep: {type: integer, default: 9000}}
stages:
  - load: "${input}"
  - transform: {scale: 2}
  - validate: {closed: true}
  - simplify: {faces: "${keep}"}
  - write: "out.ply"
report: "out.json"
"""
MEMORY = ("--memory", "64M", "--partition", "always")
MANIFEST, RECORDS = "facetmill-cells.json", "facetmill-cells.records"


class ExportOfCells(LargeCase):
    def setUp(self):
        super().setUp()
        self.large()
        self.write("p q.yaml", PIPELINE)
        # Each job leaves its process id under the name of the job.
        self.write("bin/facetmill", f'#!/bin/sh\nfor job; do :; done\necho $$ > "pid-$(echo "$job" | tr / -)"\n'
                                    f'exec "{FACETMILL}" "$@"\n').chmod(0o755)
        self.env = {**os.environ, "PATH": f"{self.dir / 'bin'}:{os.environ['PATH']}"}
        self.env.pop("FACETMILL", None)
        self.wanted = self.plain()
        self.kept = self.dir / "kept cells"

    def plain(self, keep=9000):
        self.mill("run", "p q.yaml", "-D", "input=large.ply", "-D", f"keep={keep}", *MEMORY, "-o", "plain")
        return self.files(self.dir / "plain")

    def options(self, keep=9000):
        return ("p q.yaml", "-D", "input=large.ply", "-D", f"keep={keep}", *MEMORY, "--keep-cells", self.kept.name, "-o", "out",
                "--cell-jobs", 3)

    def export(self, engine, name, keep=9000):
        self.write(name, self.mill("export", "--to", engine, *self.options(keep)).stdout)

    def build(self, *command, expect=0):
        run = subprocess.run(command, cwd=self.dir, env=self.env, capture_output=True, text=True, timeout=600)
        self.assertEqual(run.returncode == 0, expect == 0, run.stdout + run.stderr)
        return run.stdout + run.stderr

    def check(self, command, nothing):
        """Makes all, and again only what is missing."""
        told = self.build(*command)
        self.assertEqual(self.files(self.dir / "out"), self.wanted)
        self.assertIn(nothing, self.build(*command), told)

    def simplified(self):
        return sorted(p for p in self.kept.glob("facetmill-simplified.*") if p.suffix != ".part")

    def stamp(self, number):
        return self.kept / f"facetmill-job.{number}-of-3"

    def test_ninja(self):
        self.need("ninja")
        self.export("ninja", "build.ninja")
        told = self.build("ninja", "-v")
        self.assertEqual(told.count("--cells-job"), 4)
        self.assertEqual(self.files(self.dir / "out"), self.wanted)
        self.assertIn("no work to do", self.build("ninja"))
        def made():
            return {name: data for name, data in self.files(self.kept).items() if not name.endswith(".inputs")}

        before = made()
        (self.dir / "large.ply").touch()  # all are due, and find what they would make
        self.check(("ninja",), "no work to do")
        self.assertEqual(made(), before)
        self.wanted = self.plain(keep=8000)
        self.export("ninja", "build.ninja", keep=8000)
        self.check(("ninja",), "no work to do")

    def test_jobs_leave_little_to_the_last(self):
        self.need("ninja")
        self.export("ninja", "build.ninja")
        self.build("ninja", *(f"kept cells/{self.stamp(number).name}" for number in (1, 2, 3)))
        made = {p.name for p in self.simplified()}
        self.assertFalse((self.dir / "out/out.ply").exists())
        self.build("ninja")
        self.assertEqual(self.files(self.dir / "out"), self.wanted)
        left = {p.name for p in self.simplified()} - made
        self.assertGreater(len(made), len(left))

    def test_make(self):
        self.dir.joinpath("kept cells").mkdir()
        self.export("make", "Makefile")
        self.check(("make", "-j2"), "Nothing to be done")

    def test_snakemake(self):
        self.need("snakemake", in_ci=False)
        self.export("snakemake", "Snakefile")
        self.check(("snakemake", "-j2"), "Nothing to be done")
        self.write("braces.yaml", PIPELINE.replace("params: {", "params: {note: {type: text, default: a}, "))
        self.write("Snakefile", self.mill("export", "--to", "snakemake", "braces.yaml", "-D", "note={foo} {", *self.options()[1:]).stdout)
        self.build("snakemake", "-j2")

    def killed(self):
        """A workflow whose first job that simplifies is killed when it has simplified something. False: it was too fast."""
        run = subprocess.Popen(("ninja", "-j1"), cwd=self.dir, env=self.env, stdout=subprocess.PIPE,
                               stderr=subprocess.STDOUT, text=True)
        pid = self.dir / "pid-1-3"
        while run.poll() is None and not (pid.exists() and pid.read_text().endswith("\n") and self.simplified()):
            time.sleep(0.0005)
        if not self.stamp(1).exists():
            try:
                os.kill(int(pid.read_text()), signal.SIGKILL)
            except ProcessLookupError:
                pass
        told = run.communicate()[0]
        return run.returncode != 0 and "FAILED" in told and not self.stamp(1).exists()

    def test_a_killed_job_goes_on_where_it_ended(self):
        self.need("ninja")
        for attempt in range(50):
            self.kept = self.dir / f"kept {attempt}"
            self.export("ninja", "build.ninja")
            rules = (self.dir / "build.ninja").read_text()
            self.write("build.ninja", re.sub("^facetmill = .*", "facetmill = facetmill", rules, flags=re.M))
            (self.dir / "pid-1-3").unlink(missing_ok=True)
            if self.killed():
                break
        else:
            self.fail("no job was slow enough to be killed")
        self.assertFalse((self.dir / "out/out.ply").exists())
        left = {p: p.stat().st_mtime_ns for p in self.simplified()}
        self.assertTrue(left)
        self.check(("ninja",), "no work to do")
        for path, time_ in left.items():
            self.assertEqual(path.stat().st_mtime_ns, time_, "made again")

    def damaged_records(self):
        """Damages the cells, as old as before, and returns what they were."""
        path = self.kept / RECORDS
        written, records = path.stat().st_mtime_ns, path.read_bytes()
        data = bytearray(records)
        data[100::4096] = bytes(255 - b for b in data[100::4096])
        path.write_bytes(data)
        os.utime(path, ns=(written, written))
        return records

    def test_what_is_damaged_is_made_again(self):
        self.need("ninja")
        self.export("ninja", "build.ninja")
        self.check(("ninja",), "no work to do")
        out = self.dir / "out/out.ply"
        for path in self.simplified()[::2]:  # of all jobs
            path.unlink()
        self.simplified()[0].write_bytes(b"no cell")
        out.unlink()
        self.check(("ninja",), "no work to do")
        (self.kept / MANIFEST).unlink()
        self.check(("ninja",), "no work to do")
        # The last run makes the cells anew, and what others made of them is not due.
        for engine, nothing in (("ninja", "no work to do"), ("make", "Nothing to be done")):
            if engine == "make":
                self.export(engine, "Makefile")
            records = self.damaged_records()
            out.unlink()
            self.check((engine,), nothing)
            self.assertEqual((self.kept / RECORDS).read_bytes(), records)
        # A job beside others cannot make the cells anew that all read: the workflow does when it runs again.
        self.damaged_records()
        for path in self.simplified():
            path.unlink()
        self.stamp(1).unlink()
        told = self.build("ninja", expect=1)
        self.assertIn("E-SCRATCH", told)
        self.assertIn("run the workflow again", told)
        self.assertFalse((self.kept / MANIFEST).exists())
        self.check(("ninja",), "no work to do")

    def job(self, job, *more, expect=0):
        return self.mill("run", "p q.yaml", "-D", "input=large.ply", *MEMORY, "--keep-cells", self.kept, "--cells-job", job,
                         "-o", "out", *more, expect=expect)

    def test_jobs_are_beside_each_other_and_no_other_run(self):
        self.assertIn("there are no cells in", self.job("1/2", expect=4).stderr)
        self.job("cells")
        self.assertFalse((self.dir / "out").exists())
        with open(self.kept / "facetmill-cells.lock", "w") as lock:
            fcntl.flock(lock, fcntl.LOCK_SH)  # as of another job
            self.job("1/2")
            self.assertIn("E-BUSY", self.job("cells", expect=4).stderr)
            fcntl.flock(lock, fcntl.LOCK_EX)  # as of a run
            self.assertIn("E-BUSY", self.job("2/2", expect=4).stderr)
        with open(self.kept / "facetmill-job.2-of-2.lock", "w") as lock:
            fcntl.flock(lock, fcntl.LOCK_EX)
            self.assertIn("E-BUSY", self.job("2/2", expect=4).stderr)
        self.job("2/2", "-j", 5)
        self.assertFalse((self.dir / "out").exists())
        data = bytearray((self.dir / "large.ply").read_bytes())
        data[-7] ^= 4  # a corner of the last face
        (self.dir / "large.ply").write_bytes(data)
        self.assertIn("other inputs", self.job("1/2", expect=4).stderr)

    def test_what_is_refused(self):
        def refused(text, *arguments, expect=2):
            run = self.mill("export", "--to", "ninja", *arguments, expect=expect)
            self.assertIn(text, run.stderr)
            self.assertEqual(run.stdout, "")

        here = ("p q.yaml", "-D", "input=large.ply", "-o", "out", "--keep-cells", "k")
        refused("a fixed memory size", *here)
        refused("a fixed memory size", *here, "--memory", "50%")
        refused("the run has no cells: in memory", *here, "--memory", "16G")
        refused("E-CONFLICT", *here, *MEMORY, "--input", "*.ply")
        refused("--keep-cells DIR", "p q.yaml", "-D", "input=large.ply", "-o", "out", "--cell-jobs", 2)
        refused("E-FILE", "p q.yaml", "-D", "input=none.ply", "-o", "out", "--keep-cells", "k", *MEMORY, expect=3)
        self.write("clean.yaml", PIPELINE.replace("transform: {scale: 2}", "clean: {}"))
        refused("each job would do 'clean' again", "clean.yaml", *here[1:], *MEMORY)
        self.write("clip.yaml", PIPELINE.replace('simplify: {faces: "${keep}"}', "clip: {plane: z=50%, keep: back}"))
        refused("'clip' works on cells by itself", "clip.yaml", *here[1:], *MEMORY)
        for job in ("x", "0/3", "4/3", "1.5/3", "/", "1/", "-1/3", "nan/3"):
            self.assertIn("--cells-job needs a job", self.job(job, expect=2).stderr)
        for option in ("--report", "--timings", "--depfile"):
            self.assertIn(f"so {option} cannot be used", self.job("1/2", option, "r.json", expect=2).stderr)
        run = self.mill("run", "p q.yaml", "-D", "input=large.ply", "--memory", "16G", "--keep-cells", self.kept, "--cells-job", "1/2",
                        "-o", "out", expect=2)
        self.assertIn("the run has no cells: in memory", run.stderr)
        run = self.mill("run", "clean.yaml", "-D", "input=large.ply", *MEMORY, "--keep-cells", self.kept, "--cells-job", "1/2",
                        "-o", "out", expect=2)
        self.assertIn("each job would do 'clean' again", run.stderr)
        run = self.mill("run", "p q.yaml", "-D", "input=large.ply", *MEMORY, "--cells-job", "1/2", expect=2)
        self.assertIn("give the folder", run.stderr)
        self.assertFalse(self.kept.exists())


if __name__ == "__main__":
    main()
