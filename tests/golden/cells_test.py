"""Meshes larger than the memory that is given: the real executable, in cells on disk."""

import json
import os
import pathlib
import signal
import subprocess
import sys
import unittest

from support import FACETMILL, SCAN, SLOW, Case, main

MEGABYTE = 1 << 20


def memory_group(test, limit):
    """A control group of the kernel whose processes may use so many bytes, cached files among them."""
    for root, most, swap in (("/sys/fs/cgroup/memory", "memory.limit_in_bytes", "memory.memsw.limit_in_bytes"),
                             ("/sys/fs/cgroup", "memory.max", "memory.swap.max")):
        group = pathlib.Path(root, f"facetmill-test-{os.getpid()}")
        try:
            group.mkdir()
        except OSError:
            continue
        test.addCleanup(group.rmdir)
        if (group / most).exists():
            (group / most).write_text(str(limit))
            if (group / swap).exists():
                (group / swap).write_text("0" if swap == "memory.swap.max" else str(limit))
            return group
    print(f"notice: no control group for memory can be made here, skipped {test.id()}", file=sys.stderr)
    return test.skipTest("no control group for memory")


class Cells(Case):
    def large(self, passes=1):
        """A closed scan of 70,000 * 4^passes faces."""
        path = self.dir / "large.ply"
        self.mill("pipe", "load", SCAN, "!", "split", "midpoint", "--passes", passes, "!", "write", path)
        return path

    def test_closed_stays_closed_and_the_bytes_are_the_same(self):
        scan = self.large()
        results = set()
        for threads, memory in ((1, "50M"), (2, "64M"), (5, "1G")):
            out = f"{threads}.ply"
            self.mill("pipe", "-j", threads, "--memory", memory, "--partition", "always", "load", scan, "!", "simplify",
                      "--faces", 9000, "!", "validate", "--closed", "--edge_manifold", "--vertex_manifold", "--faces",
                      9000, "!", "write", out)
            results.add((self.dir / out).read_bytes())
        self.assertEqual(len(results), 1)
        self.assertEqual(sorted(p.name for p in self.dir.iterdir()), ["1.ply", "2.ply", "5.ply", "large.ply"])

    def test_a_run_decides_by_memory_and_says_so(self):
        self.large()
        self.write("p.yaml", "facetmill: 1\nstages:\n  - load: large.ply\n  - simplify: {faces: 9000}\n  - write: o.glb\n")
        self.assertIn("memory: in cells on disk up to 'simplify': about 280,000 faces need about",
                      self.mill("plan", "p.yaml", "--memory", "64M").stdout)
        self.assertIn("memory: in memory", self.mill("plan", "p.yaml", "--memory", "2G").stdout)
        self.assertNotIn("memory:", self.mill("plan", "p.yaml").stdout)
        self.assertIn("in cells on disk", self.mill("run", "p.yaml", "--memory", "64M").stderr)
        self.assertNotIn("in cells", self.mill("run", "p.yaml", "--memory", "2G").stderr)
        self.assertNotIn("in cells", self.mill("run", "p.yaml", "--memory", "64M", "--partition", "never").stderr)

    def test_what_needs_the_whole_mesh_is_refused_with_the_way_out(self):
        self.large()
        cases = (("relax 3 ! simplify 10%", "'relax' cannot work on a mesh in cells", "put it after simplify"),
                 ("simplify 10% --max_error 1%", "max_error is measured on the whole mesh", "leave that option out"),
                 ("simplify 10% --only x", "'simplify' has the key 'only'", "leave it out"),
                 ("simplify --vertices 100", "the target must be faces or a ratio", "leave that option out"),
                 ("measure", "'measure' cannot work", "put it after simplify"))
        for stages, message, way_out in cases:
            run = self.mill("pipe", "--memory", "64M", "load", "large.ply", "!", *stages.split(), "!", "write", "o.ply",
                            expect=2)
            self.assertIn("E-CELLS", run.stderr)
            self.assertIn(message, run.stderr)
            self.assertIn(way_out, run.stderr)
        self.mill("pipe", "load", "large.ply", "!", "write", "small.drc")
        self.assertIn("not read in pieces", self.mill("pipe", "--memory", "1M", "load", "small.drc", "!", "simplify", "10%",
                                                      "!", "write", "o.ply", expect=2).stderr)
        self.assertIn("E-MEMORY", self.mill("pipe", "--memory", "30M", "load", "large.ply", "!", "simplify", "90%", "!",
                                            "write", "o.ply", expect=7).stderr)
        self.assertIn("E-ARGUMENT", self.mill("pipe", "--memory", "much", "load", "large.ply", "!", "write", "o.ply",
                                              expect=2).stderr)

    def test_the_limit_holds_where_the_kernel_enforces_it(self):
        scan = self.large()
        group = memory_group(self, 50 * MEGABYTE)

        def run(*arguments):
            join = f"echo $$ > {group}/cgroup.procs && exec \"$@\""
            return subprocess.run(["sh", "-c", join, "sh", FACETMILL, "pipe", *arguments, "load", scan, "!", "simplify",
                                   "--faces", "9000", "!", "write", "inside.ply"], cwd=self.dir, capture_output=True, text=True)

        outside = ("pipe", "--memory", "50M", "load", scan, "!", "simplify", "--faces", 9000, "!", "write", "outside.ply")
        self.mill(*outside)
        inside = run("--memory", "50M")
        self.assertEqual(inside.returncode, 0, inside.stderr)
        self.assertEqual((self.dir / "inside.ply").read_bytes(), (self.dir / "outside.ply").read_bytes())
        self.assertEqual(run("--partition", "never").returncode, -signal.SIGKILL)  # so the limit is one

    def test_several_files_of_any_format_are_one_mesh(self):
        self.mill("pipe", "load", SCAN, "!", "split", "midpoint", "!", "write", "low.obj")
        self.mill("pipe", "load", SCAN, "!", "split", "midpoint", "!", "transform", "--translate", "100%,0,0", "!", "write",
                  "high.ply", "--ascii")
        self.write("p.yaml", "facetmill: 1\nstages:\n  - load: [high.ply, low.obj]\n  - simplify: {faces: 9000}\n"
                             "  - validate: {closed: true, components: 2}\n  - write: o.ply\n")
        results = set()
        for threads, memory in ((1, "50M"), (2, "64M")):
            run = self.mill("run", "p.yaml", "-j", threads, "--memory", memory, "--partition", "always")
            results.add((self.dir / "o.ply").read_bytes())
            self.assertIn("2 parts, which become one", run.stderr)
        self.assertEqual(len(results), 1)

    def test_broken_input_and_scratch(self):
        scan = self.large()
        whole = scan.read_bytes()
        (self.dir / "short.ply").write_bytes(whole[:-7])
        run = ("!", "simplify", "10%", "!", "write", "o.ply")
        self.assertIn("E-PLY", self.mill("pipe", "--memory", "64M", "load", "short.ply", *run, expect=6).stderr)
        self.assertIn("E-FILE", self.mill("pipe", "--memory", "64M", "load", "none.ply", *run, expect=3).stderr)
        self.assertIn("E-WRITE", self.mill("pipe", "--no-sandbox", "--memory", "64M", "--scratch", "nowhere", "load", scan, *run,
                                           expect=4).stderr)
        self.assertFalse((self.dir / "o.ply").exists())

    def test_the_report_tells_of_cells(self):
        self.large()
        self.mill("pipe", "--memory", "64M", "--report", "r.json", "load", "large.ply", "!", "simplify", "--faces", 5000, "!",
                  "write", "o.ply")
        report = json.loads((self.dir / "r.json").read_text())
        load, simplify = report["stages"][:2]
        self.assertEqual(load["after"]["faces"], 280000)
        part = simplify["result"]["parts"][0]
        self.assertEqual((part["triangles_before"], part["triangles_after"]), (280000, 5000))
        self.assertGreater(part["largest_error"], 0)
        self.assertEqual(report["inputs"][0]["path"], "large.ply")

    @unittest.skipIf(SLOW, "sanitizers take memory of their own")
    def test_four_million_faces_in_64_megabytes(self):
        scan = self.large(3)
        run = subprocess.Popen([str(FACETMILL), "pipe", "-q", "--memory", "64M", "load", scan, "!", "simplify", "--faces",
                                "40000", "!", "validate", "--closed", "--edge_manifold", "!", "write", "o.ply"],
                               cwd=self.dir)
        _, status, usage = os.wait4(run.pid, 0)
        run.returncode = os.waitstatus_to_exitcode(status)
        self.assertEqual(run.returncode, 0)
        self.assertLess(usage.ru_maxrss * 1024, 64 * MEGABYTE)


if __name__ == "__main__":
    main()
