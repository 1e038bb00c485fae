"""Meshes larger than the memory that is given: the real executable, in cells on disk."""

import errno
import json
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import time
import unittest

from cells_support import triangles, variants
from support import FACETMILL, SCAN, SLOW, LargeCase, main

MEGABYTE = 1 << 20


def remove_group(group):
    """The kernel lets go of a group a moment after its last process has ended."""
    for _ in range(100):
        try:
            return group.rmdir()
        except OSError as error:
            if error.errno != errno.EBUSY:
                raise
        time.sleep(0.1)
    group.rmdir()


def memory_group(test, limit):
    """A control group of the kernel whose processes may use so many bytes, cached files among them."""
    for root, most, swap in (("/sys/fs/cgroup/memory", "memory.limit_in_bytes", "memory.memsw.limit_in_bytes"),
                             ("/sys/fs/cgroup", "memory.max", "memory.swap.max")):
        group = pathlib.Path(root, f"facetmill-test-{os.getpid()}")
        try:
            group.mkdir()
        except OSError:
            continue
        test.addCleanup(remove_group, group)
        if (group / most).exists():
            (group / most).write_text(str(limit))
            if (group / swap).exists():
                (group / swap).write_text("0" if swap == "memory.swap.max" else str(limit))
            return group
    print(f"notice: no control group for memory can be made here, skipped {test.id()}", file=sys.stderr)
    return test.skipTest("no control group for memory")


class Cells(LargeCase):
    def test_closed_stays_closed_and_the_bytes_are_the_same(self):
        scan = self.large()
        results = set()
        for threads, memory in variants((1, "50M"), (2, "64M"), (5, "1G")):
            out = f"{threads}.ply"
            self.mill("pipe", "-j", threads, "--memory", memory, "--partition", "always", "load", scan, "!", "simplify",
                      "--faces", 9000, "!", "validate", "--closed", "--edge_manifold", "--vertex_manifold", "--faces",
                      9000, "!", "write", out)
            results.add((self.dir / out).read_bytes())
        self.assertEqual(len(results), 1)
        outputs = {f"{threads}.ply" for threads, _ in variants((1, ""), (2, ""), (5, ""))}
        self.assertEqual({p.name for p in self.dir.iterdir()}, {*outputs, "large.ply"})

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

    def test_a_run_decides_by_what_the_mesh_becomes_on_the_way(self):
        self.large()
        for grows, factor in (("split: {method: midpoint, passes: 2}", 16), ("crumple: {amplitude: 0.001%, grid: 5}", 25)):
            self.write("p.yaml", f"facetmill: 1\nstages:\n  - load: large.ply\n  - {grows}\n  - simplify: {{faces: 9000}}\n"
                                 "  - write: o.glb\n")
            self.assertIn(f"in cells on disk up to 'simplify': about 280,000 faces, and the {280_000 * factor:,} they become, "
                          "need about", self.mill("plan", "p.yaml", "--memory", "256M").stdout)
            self.assertIn("memory: in memory", self.mill("plan", "p.yaml", "--memory", "2G").stdout)
        for last in ("simplify: {faces: 9000}\n  - split: {method: midpoint, passes: 3}",
                     "crumple: {amplitude: 0.001%, grid: 5, self_intersections: avoid}"):  # not on cells: not counted
            self.write("p.yaml", f"facetmill: 1\nstages:\n  - load: large.ply\n  - {last}\n  - write: o.glb\n")
            self.assertIn("memory: in memory: about 280,000 faces need", self.mill("plan", "p.yaml", "--memory", "256M").stdout)

    def test_what_needs_the_whole_mesh_is_refused_with_the_way_out(self):
        self.large()
        cases = (("relax 3 ! simplify 10%", "'relax' cannot work on a mesh in cells", "put it after simplify or clip"),
                 ("simplify 10% --max_error 1%", "max_error needs the whole mesh in memory", "remove that option"),
                 ("simplify 10% --only x", "'simplify' has the key 'only'", "leave it out"),
                 ("simplify --vertices 100", "on cells the target must be faces or ratio", "remove that option"),
                 ("measure --attributes area", "measure: attributes need the whole mesh in memory",
                  "remove that option"),
                 ("measure --path o.csv", "cells do not keep the order of faces", "remove that option"),
                 ("split bisect", "split: the method bisect needs the whole mesh", "remove that option"),
                 ("split --max_edge 1%", "the target max_edge needs the whole mesh", "remove that option"),
                 ("crumple --grid 17", "crumple: grid: above 16", "use split midpoint first to make faces smaller"),
                 ("crumple --direction normal", "crumple: direction: normals need all faces of a vertex", "free works"),
                 ("crumple --boundary fixed", "crumple: boundary: fixed needs all faces", "remove that option"),
                 ("crumple --self_intersections avoid", "crumple: self_intersections other than allow need the whole mesh",
                  "remove that option"),
                 ("crumple --mask.material x", "crumple: mask: cells do not contain", "remove that option"),
                 ("clean --weld near --tolerance 1%", "clean: weld: near moves vertices", "exact does not"),
                 ("clean --t_junctions near --tolerance 1%", "clean: t_junctions: near moves vertices", "remove that option"),
                 ("clean --holes minimal", "clean: holes: a patch may meet any other face", "remove that option"),
                 ("clean --self_intersections union", "clean: self_intersections needs the whole mesh", "remove that option"),
                 ("clean --components.keep 1", "clean: components: connected components", "remove that option"),
                 ("clean --inner_components", "clean: inner_components: connected components", "remove that option"),
                 ("clean --precision single", "clean: precision: single moves vertices", "remove that option"),
                 ("orient", "'orient' cannot work", "(clean, clip, crumple, load, measure, section, simplify, split, transform, validate, write can)"))
        for stages, message, way_out in cases:
            run = self.mill("pipe", "--memory", "64M", "load", "large.ply", "!", *stages.split(), "!", "write", "o.ply",
                            expect=2)
            self.assertIn("E-CELLS", run.stderr)
            self.assertIn(message, run.stderr)
            self.assertIn(way_out, run.stderr)
        self.mill("pipe", "load", "large.ply", "!", "write", "small.drc")
        self.assertIn("cannot be read in pieces", self.mill("pipe", "--memory", "1M", "load", "small.drc", "!", "simplify", "10%",
                                                      "!", "write", "o.ply", expect=2).stderr)
        self.assertIn("E-MEMORY", self.mill("pipe", "--memory", "30M", "load", "large.ply", "!", "simplify", "90%", "!",
                                            "write", "o.ply", expect=7).stderr)
        self.assertIn("E-ARGUMENT", self.mill("pipe", "--memory", "much", "load", "large.ply", "!", "write", "o.ply",
                                              expect=2).stderr)

    @unittest.skipIf(SLOW, "sanitizers take memory of their own")
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
        for threads, memory in variants((1, "50M"), (2, "64M")):
            run = self.mill("run", "p.yaml", "-j", threads, "--memory", memory, "--partition", "always")
            results.add((self.dir / "o.ply").read_bytes())
            self.assertIn("2 parts, which become one", run.stderr)
        self.assertEqual(len(results), 1)

    def test_a_unit_that_the_file_states_is_not_overridden_without_a_word(self):
        for name in ("scan.ply", "scan.stl", "scan.obj", "scan.glb"):
            self.mill("pipe", "load", SCAN, "--unit", "m", "--up", "y", "!", "write", name)
            load = ("pipe", "--memory", "1M", "--partition", "always", "load", name)
            told = self.mill(*load, "--unit", "mm", "--up", "z", "!", "write", "o.ply").stderr
            self.assertIn(f"'{name}' states unit m, but mm is used instead, without a conversion", told)
            self.assertIn(f"'{name}' states up y, but z is used instead, without a conversion", told)
            self.assertIn(b"comment unit: mm\ncomment up: z\n", (self.dir / "o.ply").read_bytes()[:200])
            self.assertNotIn("W-OVERRIDDEN", self.mill(*load, "--unit", "m", "!", "write", "o.ply").stderr)
            self.assertIn(b"comment unit: m\ncomment up: y\n", (self.dir / "o.ply").read_bytes()[:200])

    def test_files_without_a_unit_are_joined_with_those_that_state_one(self):
        self.mill("pipe", "load", SCAN, "!", "write", "none.ply")
        self.mill("pipe", "load", SCAN, "--unit", "mm", "!", "write", "mm.ply")
        self.mill("pipe", "load", SCAN, "--unit", "m", "!", "write", "m.ply")
        for cells in ((), ("--memory", "1M", "--partition", "always")):
            for files, said in ((("none.ply", "mm.ply"), " no unit, so the numbers are read as mm"),
                                (("mm.ply", "none.ply"), "'none.ply' has no unit, so the numbers are read as mm")):
                self.assertIn(said, self.mill("pipe", *cells, "load", *files, "!", "write", "o.ply").stderr)
                self.assertIn(b"comment unit: mm\n", (self.dir / "o.ply").read_bytes()[:200])
        self.assertIn("E-CELLS", self.mill("pipe", *cells, "load", "mm.ply", "m.ply", "!", "write", "o.ply", expect=2).stderr)

    def test_a_large_mesh_is_moved_checked_and_written_in_cells(self):
        self.large()
        chain = ("!", "transform", "--scale", 2, "--rotate.axis", "1,2,3", "--rotate.angle", "30deg", "--centre",
                 "!", "validate", "--closed", "--euler", 2, "--components", 1, "--faces", 280000, "!", "write")
        for name in ("o.ply", "o.stl"):
            results = set()
            for threads, memory in variants((1, "50M"), (2, "64M"), (5, "1G")):
                run = self.mill("pipe", "-j", threads, "--memory", memory, "--partition", "always", "load", "large.ply",
                                *chain, name)
                results.add((self.dir / name).read_bytes())
                self.assertIn("in cells on disk: ", run.stderr)
            self.assertEqual(len(results), 1)
            self.mill("pipe", "load", "large.ply", *chain, f"whole-{name}")
            self.assertEqual(*(triangles(self.dir / n) for n in (name, f"whole-{name}")))
        self.assertIn("'components' must be 3, found 1", self.mill(
            "pipe", "--memory", "64M", "load", "large.ply", "!", "validate", "--components", 3, expect=1).stderr)
        self.assertIn("'outward_oriented' needs the whole mesh", self.mill(
            "pipe", "--memory", "64M", "load", "large.ply", "!", "validate", "--for", "printing", expect=2).stderr)
        for name, why in (("o.obj", "obj cannot be written from cells"), ("o.ply --ascii", "text cannot be written"),
                          ("o.glb --draco", "compression needs the whole mesh")):
            self.assertIn(why, self.mill("pipe", "--memory", "64M", "load", "large.ply", "!", "write", *name.split(),
                                         expect=2).stderr)
        self.assertIn("E-OVERWRITE", self.mill("pipe", "--memory", "64M", "load", "large.ply", "!", "write", "large.ply",
                                               expect=2).stderr)

    def test_a_glb_is_written_in_cells(self):
        self.large()
        self.mill("pipe", "--partition", "always", "load", "large.ply", "--unit", "m", "--up", "z", "!", "transform",
                  "--scale", 2, "!", "write", "o.glb")
        self.mill("pipe", "load", "o.glb", "!", "validate", "--closed", "--euler", 2, "--faces", 280000, "!", "transform",
                  "--bake", "!", "write", "o.ply")
        self.mill("pipe", "load", "large.ply", "--unit", "m", "--up", "z", "!", "transform", "--scale", 2, "!", "write",
                  "whole.glb")
        self.mill("pipe", "load", "whole.glb", "!", "transform", "--bake", "!", "write", "whole.ply")
        self.assertEqual(*(triangles(self.dir / n) for n in ("o.ply", "whole.ply")))

    def test_a_glb_from_cells_is_told_to_lack_attributes(self):
        self.write("c.ply", "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
                            "property uchar red\nproperty uchar green\nproperty uchar blue\nproperty float quality\n"
                            "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
                            "0 0 0 9 9 9 1\n1 0 0 9 9 9 1\n0 1 0 9 9 9 1\n3 0 1 2\n")
        told = [self.mill("pipe", "--partition", "always", "load", "c.ply", "--unit", "m", "--up", "z", "!", "write",
                          name).stderr for name in ("c.glb", "d.ply")]
        self.assertIn("warning[W-CELLS]: c.ply: 'c.glb': a GLB written from cells contains only positions, "
                      "without COLOR_0, quality", told[0])
        self.assertNotIn("W-CELLS", told[1])

    def test_tiles_are_written_in_cells(self):
        self.large()
        load = ("load", "large.ply", "--unit", "m", "--up", "z", "!", "write")
        for more in ((), ("--draco",), ("--meshopt",), ("--tiles.tiling", "implicit"))[:1 if SLOW else 4]:
            results = set()
            for threads, memory in variants((1, "64M"), (2, "128M"), (5, "1G")):
                shutil.rmtree(self.dir / "o", ignore_errors=True)
                run = self.mill("pipe", "-j", threads, "--memory", memory, "--partition", "always", *load, "o/tileset.json",
                                "--tiles.faces", 5000, *more)
                self.assertIn("in cells on disk: ", run.stderr)
                results.add(tuple((p.name, p.read_bytes()) for p in sorted(self.dir.glob("o/**/*.*"))))
            self.assertEqual(len(results), 1)
            names = [name for name, _ in results.pop()]
            self.assertGreater(len(names), 80)
            self.assertEqual(names.count("tileset.json"), 1)
            self.mill("pipe", "load", "o/tileset.json", "!", "validate", "--closed", "--edge_manifold", "--euler", 2,
                      "--faces", 280000)
        self.assertIn("normals and tangents need the whole mesh", self.mill(
            "pipe", "--memory", "64M", *load, "p/tileset.json", "--normals", "smooth", expect=2).stderr)
        self.assertIn("a smaller tiles.faces", self.mill("pipe", "--memory", "50M", *load, "p/tileset.json",
                                                            expect=7).stderr)
        self.write("q/tileset/r.glb/taken", "")  # a tile cannot have its name
        self.assertIn("E-DIRECTORY", self.mill("pipe", "--memory", "64M", *load, "q/tileset.json", expect=4).stderr)
        self.assertEqual([p.name for p in self.dir.glob("q/**/*") if p.is_file()], ["taken"])
        self.assertFalse((self.dir / "p").exists())

    def test_a_clip_brings_what_it_keeps_into_memory(self):
        self.large()
        for clip in variants(("z=60%",), ("--planes", "[x=60%,y=60%]", "--cap"), ("z=60%", "--cap"),
                             ("z=40%", "--keep", "back", "--cap"), ("--planes", "[x=60%,y=60%]")):
            results = set()
            for threads, memory in variants((1, "70M"), (2, "1G")):
                self.mill("pipe", "-j", threads, "--memory", memory, "--partition", "always", "load", "large.ply", "!", "clip",
                          *clip, "!", "write", "o.ply")
                results.add((self.dir / "o.ply").read_bytes())
            self.assertEqual(len(results), 1)
            self.mill("pipe", "load", "large.ply", "!", "clip", *clip, "--triangulate", "!", "write", "whole.ply")
            self.mill("pipe", "--partition", "always", "load", "large.ply", "!", "clip", *clip, "--triangulate", "!", "write",
                      "o.ply")
            self.assertEqual(*(triangles(self.dir / n) for n in ("o.ply", "whole.ply")))
        self.assertIn("E-MEMORY", self.mill("pipe", "--memory", "40M", "load", "large.ply", "!", "clip", "z=10%", "!", "write",
                                            "o.ply", expect=7).stderr)
        self.assertIn("keep: both", self.mill("pipe", "--memory", "40M", "load", "large.ply", "!", "clip", "z=10%", "--keep",
                                              "both", "!", "write", "o.ply", expect=2).stderr)

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
        self.assertIn("E-PLY", self.mill("pipe", "--no-sandbox", "--memory", "64M", "-o", "new/out", "load", "short.ply", *run,
                                         expect=6).stderr)
        self.assertFalse((self.dir / "new").exists())
        self.mill("pipe", "--no-sandbox", "--memory", "64M", "-o", "new/out", "load", scan, *run)
        self.assertTrue((self.dir / "new/out/o.ply").exists())

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
        self.assertLess(self.peak("load", scan, "!", "simplify", "--faces", "40000", "!", "validate", "--closed",
                                  "--edge_manifold", "!", "write", "o.ply"), 64 * MEGABYTE)

    @unittest.skipIf(SLOW, "sanitizers take memory of their own")
    def test_a_tileset_of_a_million_faces_in_64_megabytes(self):
        self.assertLess(self.peak("load", self.large(2), "--unit", "m", "--up", "z", "!", "write", "o/tileset.json"),
                        64 * MEGABYTE)

    def peak(self, *stages):
        """Bytes that a run takes with a limit of 64 MB."""
        # By a process of its own: what it starts counts the memory that it had itself.
        code = ("import os, subprocess, sys\n"
                "run = subprocess.Popen(sys.argv[1:])\n"
                "_, status, usage = os.wait4(run.pid, 0)\n"
                "run.returncode = os.waitstatus_to_exitcode(status)\n"
                "print(run.returncode, usage.ru_maxrss * 1024)")
        run = subprocess.run([sys.executable, "-c", code, str(FACETMILL), "pipe", "-q", "--memory", "64M", *stages],
                             cwd=self.dir, capture_output=True, text=True)
        code, peak = map(int, run.stdout.split()[-2:])
        self.assertEqual(code, 0, run.stderr)
        return peak


if __name__ == "__main__":
    main()
