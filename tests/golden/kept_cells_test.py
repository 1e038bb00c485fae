"""Cells that are kept: runs that are killed, and take up what is there; the real executable."""

import fcntl
import json
import random
import resource
import shutil
import signal
import subprocess
import time

from support import FACETMILL, SLOW, LargeCase, main

MANIFEST, RECORDS, BORDERS = (f"facetmill-cells.{name}" for name in ("json", "records", "borders"))


class KeptCells(LargeCase):
    def setUp(self):
        super().setUp()
        self.scan = self.large()
        self.kept = self.dir / "kept"

    def arguments(self, out="o.ply", faces=9000, load=(), more=()):
        return ("pipe", *more, "--memory", "64M", "--partition", "always", "--keep-cells", self.kept, "load", self.scan, *load,
                "!", "simplify", "--faces", faces, "!", "write", self.dir / out)

    def keep(self, expect=0, **how):
        return self.mill(*self.arguments(**how), expect=expect)

    def begun(self, out="o.ply", preexec_fn=None):
        return subprocess.Popen([FACETMILL, *map(str, self.arguments(out=out))], cwd=self.dir, stdout=subprocess.DEVNULL,
                                stderr=subprocess.PIPE, text=True, preexec_fn=preexec_fn)

    def stopped(self):
        """A run that is stopped when its cells are made, and not yet simplified."""
        for _ in range(50):
            shutil.rmtree(self.kept, ignore_errors=True)
            (self.dir / "o.ply").unlink(missing_ok=True)
            run = self.begun()
            while run.poll() is None and not (self.kept / MANIFEST).exists():
                time.sleep(0.0005)
            run.send_signal(signal.SIGSTOP)
            if run.poll() is None and len(self.simplified()) < 4:
                return run
            run.send_signal(signal.SIGCONT)
            run.communicate()
        return self.fail("no run was slow enough to be stopped")

    def result(self, out="o.ply"):
        return (self.dir / out).read_bytes()

    def without(self, faces=9000):
        """What a run gives that keeps nothing."""
        self.mill("pipe", "--memory", "64M", "--partition", "always", "load", self.scan, "!", "simplify", "--faces", faces, "!",
                  "write", "without.ply")
        return self.result("without.ply")

    def simplified(self):
        return sorted((p for p in self.kept.glob("facetmill-simplified.*") if p.suffix != ".part"),
                      key=lambda p: int(p.name.split(".")[-1]))

    def flip(self, path, at):
        data = bytearray(path.read_bytes())
        data[at] ^= 4
        path.write_bytes(data)

    def killed(self, steps, seconds):
        """A run that is killed after so many steps more, and so long. False when it ended before."""
        wanted = len(self.simplified()) + steps
        run = self.begun()
        while run.poll() is None and len(self.simplified()) < wanted:
            time.sleep(0.001)
        time.sleep(seconds)
        run.kill()
        told = run.communicate()[1]
        if run.returncode == 0:
            return False
        self.assertEqual(run.returncode, -signal.SIGKILL, told)
        self.assertFalse((self.dir / "o.ply").exists())
        return True

    def test_a_killed_run_is_taken_up_where_it_ended(self):
        self.scan = self.large(1 if SLOW else 2)
        expected = self.without()
        chance = random.Random(15)
        for _ in range(3):  # while cells are made, or thereafter
            self.assertTrue(self.killed(0, chance.random() * 0.1))
        done = 0
        for round_ in range(100):
            if not self.killed(chance.randint(1, 5), chance.random() * 0.01):
                break
            self.assertGreater(len(self.simplified()), done)  # nothing is lost
            done = len(self.simplified())
            if round_ == 3:
                break
        self.assertGreater(done, 0)
        run = self.keep()
        self.assertIn(f" cells reused from '{self.kept}'", run.stderr)
        self.assertRegex(run.stderr, rf"\b{done} of \d+ simplified cells reused")
        self.assertEqual(self.result(), expected)

    def test_reports_and_bytes_are_those_of_a_run_without(self):
        expected = self.without()
        reports = []
        for name in ("first", "again"):
            run = self.keep(more=("--report", f"{name}.json", "--report", f"{name}.md"))
            self.assertEqual("reused" in run.stderr, name == "again")
            self.assertEqual(self.result(), expected)
            reports.append([(self.dir / f"{name}.{kind}").read_text().replace(name, "") for kind in ("json", "md")])
        self.assertEqual(*reports)
        for threads in (1, 5):
            self.keep(more=("-j", threads))
            self.assertEqual(self.result(), expected)

    def test_what_is_damaged_is_made_again(self):
        self.keep()
        expected = self.result()
        simplified = self.simplified()
        whole = f"{len(simplified)} of {len(simplified)} simplified cells reused"
        manifest = self.kept / MANIFEST
        for path, at, message in ((self.kept / RECORDS, 100, "1 of the "), (self.kept / BORDERS, -20, "1 of the "),
                                  (manifest, -300, "the manifest of the cells")):
            self.flip(path, at)
            run = self.keep()
            self.assertIn(message, run.stderr)
            self.assertIn("made again", run.stderr)
            self.assertIn(whole, run.stderr)  # they are what such cells give
            self.assertEqual(self.result(), expected)
            self.assertNotIn("made again", self.keep().stderr)
        for at in (3, 40, 150, 5000, -1):
            for path in (simplified[-1], simplified[0]):
                self.flip(path, at)
            run = self.keep()
            self.assertIn("damaged and made again", run.stderr)
            self.assertEqual(self.result(), expected)
            self.keep()  # leaves below those that are there are not looked at
        for path in (self.kept / RECORDS, self.kept / BORDERS, simplified[-1]):
            path.write_bytes(path.read_bytes()[:-1])
            self.assertIn("made again", self.keep().stderr)
            self.assertEqual(self.result(), expected)
            path.unlink()
            run = self.keep()
            self.assertEqual(self.result(), expected)
            self.assertTrue(path.exists())

    def test_other_inputs_and_options_begin_anew(self):
        self.keep()
        cells, simplified = "cells reused", "simplified cells reused"
        run = self.keep(faces=8000)  # of the same cells
        self.assertIn("simplified cells from other inputs or options removed", run.stderr)
        self.assertIn(cells, run.stderr)
        self.assertNotIn(simplified, run.stderr)
        self.assertEqual(self.result(), self.without(8000))
        run = self.keep(faces=8000, load=("--unit", "mm"))
        self.assertIn("belong to other options: they are made again", run.stderr)
        self.assertNotIn("reused", run.stderr)
        self.keep(faces=8000)
        self.flip(self.scan, -7)  # a corner of the last face, or a place
        run = self.keep(faces=8000)
        self.assertIn("belong to other inputs: they are made again", run.stderr)
        self.assertNotIn("reused", run.stderr)
        self.assertEqual(self.result(), self.without(8000))
        manifest = json.loads((self.kept / MANIFEST).read_text())
        (self.kept / MANIFEST).write_text("{}")
        self.assertIn("is damaged: they are made again", self.keep(faces=8000).stderr)
        self.assertEqual(json.loads((self.kept / MANIFEST).read_text()), manifest)

    def test_the_manifest_tells_of_the_cells(self):
        self.keep()
        manifest = json.loads((self.kept / MANIFEST).read_text())
        cells = manifest["cells"]
        self.assertEqual((manifest["format"], manifest["version"]), ("facetmill-cells", 1))
        self.assertEqual(sum(cell["faces"] for cell in cells), manifest["faces"])
        self.assertLess(manifest["vertices"], sum(cell["vertices"] for cell in cells))
        self.assertGreaterEqual(manifest["vertices"],
                                sum(cell["vertices"] - cell["shared_vertices"] for cell in cells))
        for axis in range(3):
            self.assertEqual(min(cell["bounds"]["min"][axis] for cell in cells), manifest["bounds"]["min"][axis])
            self.assertEqual(max(cell["bounds"]["max"][axis] for cell in cells), manifest["bounds"]["max"][axis])
        at = 0
        for cell in cells:
            self.assertEqual(cell["records"]["offset"], at)
            self.assertEqual(cell["records"]["bytes"], cell["faces"] * manifest["record_bytes"])
            at += cell["records"]["bytes"]
        self.assertEqual((self.kept / RECORDS).stat().st_size, at)

    def test_a_folder_is_for_one_run_at_a_time(self):
        self.kept.mkdir()
        with open(self.kept / "facetmill-cells.lock", "w") as lock:
            fcntl.flock(lock, fcntl.LOCK_EX)
            self.assertIn("E-BUSY", self.keep(expect=4).stderr)
        self.assertFalse((self.dir / "o.ply").exists())
        first = self.stopped()
        self.assertIn("another run is using the cells in", self.keep(expect=4).stderr)
        first.send_signal(signal.SIGCONT)
        self.assertIsNotNone(first.communicate())
        self.assertEqual(first.returncode, 0)
        self.keep()
        self.assertEqual(self.result(), self.without())

    def test_what_cannot_be_kept_ends_the_run(self):
        self.assertIn("--memory 2G", self.mill("pipe", "--keep-cells", "k", "load", self.scan, "!", "write", "o.ply",
                                               expect=2).stderr)
        self.write("file", "")
        self.kept = self.dir / "file/kept"
        self.assertIn("E-WRITE", self.keep(expect=4).stderr)
        self.kept = self.dir / "kept"

        def full():
            resource.setrlimit(resource.RLIMIT_FSIZE, (100000, 100000))

        run = self.begun(preexec_fn=full)
        told = run.communicate()[1]
        self.assertEqual(run.returncode, 4, told)
        self.assertIn("E-SPACE", told)
        self.keep()
        expected = self.result()
        (self.dir / "o.ply").unlink()
        last = self.simplified()[-1]
        last.unlink()
        last.with_name(last.name + ".part").mkdir()
        self.assertIn("E-WRITE", self.keep(expect=4).stderr)
        self.assertFalse((self.dir / "o.ply").exists())
        last.with_name(last.name + ".part").rmdir()
        self.keep()
        self.assertEqual(self.result(), expected)

    def test_an_input_that_changes_while_cells_are_simplified_ends_the_run(self):
        run = self.stopped()
        with open(self.scan, "ab") as scan:
            scan.write(b"\1\2")
        run.send_signal(signal.SIGCONT)
        told = run.communicate()[1]
        self.assertEqual(run.returncode, 6, told)
        self.assertIn("E-CHANGED", told)
        self.assertFalse((self.dir / "o.ply").exists())
        run = self.keep()
        self.assertIn("belong to other inputs: they are made again", run.stderr)
        self.assertEqual(self.result(), self.without())

    def test_a_folder_that_goes_away_ends_the_run(self):
        run = self.stopped()
        shutil.rmtree(self.kept)
        run.send_signal(signal.SIGCONT)
        told = run.communicate()[1]
        self.assertEqual(run.returncode, 4, told)
        self.assertIn("E-WRITE", told)
        self.assertFalse((self.dir / "o.ply").exists())


if __name__ == "__main__":
    main()
