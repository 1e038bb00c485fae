"""The executable among other processes: signals, full disks, unwritable targets, streams. All outputs or none."""

import errno
import gzip
import json
import os
import pathlib
import pty
import re
import resource
import select
import shutil
import signal
import struct
import subprocess
import threading
import time
import unittest

from support import FACETMILL, SCAN, SLOW, Case, main, png

# Writes early and works long, so that a signal finds a temporary.
LONG = """facetmill: 1
stages:
  - load: {scan}
  - write: early.ply
  - split: midpoint
  - relax: 100000
  - write: late.ply
"""
TRIANGLE = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"


class Process(Case):
    def start_long_run(self):
        pipeline = self.write("long.yaml", LONG.format(scan=SCAN))
        out = self.dir / "out"
        out.mkdir()
        (out / "early.ply").write_text("older")
        run = subprocess.Popen([str(FACETMILL), "run", str(pipeline), "--output-dir", str(out)],
                               stderr=subprocess.PIPE, text=True)
        self.addCleanup(run.stderr.close)
        deadline = time.monotonic() + 120
        while not self.temporaries(out):
            self.assertIsNone(run.poll(), "it ended before anything was written")
            self.assertLess(time.monotonic(), deadline, "no temporary appeared")
            time.sleep(0.01)
        return run, out

    def temporaries(self, folder):
        return [p.name for p in folder.iterdir() if p.name.endswith("~")]

    def test_an_interrupted_run_leaves_nothing(self):
        for number in (signal.SIGINT, signal.SIGTERM):
            run, out = self.start_long_run()
            run.send_signal(number)
            run.wait(60)
            self.assertEqual(run.returncode, -number)  # a shell says 128 + n
            self.assertEqual([p.name for p in out.iterdir()], ["early.ply"])
            self.assertEqual((out / "early.ply").read_text(), "older")
            (out / "early.ply").unlink()
            out.rmdir()

    def watch(self, *arguments):
        """A watched run of p.yaml in the folder, and a function that waits for the next time it has ended."""
        run = subprocess.Popen([str(FACETMILL), "run", "p.yaml", "--watch", "--log", "json", *arguments], cwd=self.dir,
                               stderr=subprocess.PIPE, text=True)
        self.addCleanup(run.stderr.close)
        self.addCleanup(run.wait)
        self.addCleanup(run.kill)

        def next_end():
            lines = []
            hung = threading.Timer(60, run.kill)
            hung.start()
            self.addCleanup(hung.cancel)
            for line in run.stderr:
                lines.append(json.loads(line))
                if lines[-1].get("event") == "watch":
                    hung.cancel()
                    return lines[-1]["exit_code"], lines
            self.fail(f"it ended: {lines}")
        return run, next_end

    def test_a_watched_run_is_run_again(self):
        self.write("in.off", TRIANGLE)
        self.write("a.yaml", "facetmill: 1\nstages: [split: midpoint]\n")
        self.write("p.yaml", "facetmill: 1\nallow: W-UNITS\nstages: [load: in.off, include: a.yaml, write: o.off]\n")
        run, next_end = self.watch()
        self.assertEqual(next_end()[0], 0)
        out = self.dir / "o.off"
        made = [out.read_text()]
        for name, text in (("in.off", TRIANGLE.replace("1 0 0", "2 0 0")),
                           ("a.yaml", "facetmill: 1\nstages: [{split: midpoint}, {split: midpoint}]\n"),
                           ("p.yaml", (self.dir / "p.yaml").read_text().replace("include: a.yaml", "relax: 1"))):
            time.sleep(0.05)  # file systems count time in steps
            self.write(name, text)
            code, lines = next_end()
            self.assertEqual(code, 0, lines)
            self.assertIn(f"{name} has changed", [line.get("message") for line in lines])
            made.append(out.read_text())
        self.assertEqual(len(set(made)), 4)
        # What fails is watched on, and so is what is gone.
        for name, code in (("in.off", 6), ("p.yaml", 2)):
            good = (self.dir / name).read_text()
            self.write(name, "no mesh, no pipeline")
            self.assertEqual(next_end()[0], code)
            (self.dir / name).unlink()
            self.assertEqual(next_end()[0], 3)
            self.write(name, good)
            self.assertEqual(next_end()[0], 0)
        self.assertEqual(out.read_text(), made[-1])
        self.assertIsNone(run.poll())
        run.send_signal(signal.SIGINT)
        self.assertEqual(run.wait(60), -signal.SIGINT)
        self.assertEqual(sorted(p.name for p in self.dir.iterdir()), ["a.yaml", "in.off", "o.off", "p.yaml"])
        said = self.mill("run", "-", "--watch", stdin="", expect=2).stderr
        self.assertIn("--watch cannot read", said)

    def test_what_a_watched_run_writes_is_no_reason_to_run_again(self):
        self.write("in.off", TRIANGLE)
        self.write("p.yaml", "facetmill: 1\nallow: W-UNITS\nstages: [load: in.off, split: midpoint, write: o.off]\n")
        self.write("q.yaml", "facetmill: 1\nallow: W-UNITS\nstages: [load: '*.off', split: midpoint, write: r.ply]\n")
        run, next_end = self.watch("q.yaml")
        self.assertEqual(next_end()[0], 0)
        self.assertEqual(select.select([run.stderr], [], [], 2)[0], [], "it runs again by itself")
        self.write("in.off", TRIANGLE.replace("1 0 0", "2 0 0"))
        code, lines = next_end()
        self.assertEqual(code, 0)
        self.assertIn("in.off has changed", [line.get("message") for line in lines])
        self.assertEqual(select.select([run.stderr], [], [], 2)[0], [])

    def test_what_a_watched_run_names_after_parts_is_no_reason_to_run_again(self):
        parts = "".join(f"o {name}\nv {i} 0 0\nv {i} 1 0\nv {i} 0 1\nf -3 -2 -1\n" for i, name in enumerate(("left", "right")))
        self.write("in.obj", parts)
        self.write("left.off", TRIANGLE)
        self.write("p.yaml", "facetmill: 1\nallow: W-UNITS\nstages:\n  - load: in.obj\n  - foreach: {part: '*'}\n"
                             "    do: [write: '${part}.off']\n")
        self.write("q.yaml", "facetmill: 1\nallow: W-UNITS\nstages: [load: left.off, load: 'r*.off', write: r.ply]\n")
        self.write("right.off", TRIANGLE)
        run, next_end = self.watch("q.yaml")
        self.assertEqual(next_end()[0], 0)
        self.assertEqual(select.select([run.stderr], [], [], 2)[0], [], "it runs again by itself")
        self.write("in.obj", parts.replace("v 1 1", "v 1 2"))
        code, lines = next_end()
        self.assertEqual(code, 0)
        self.assertIn("in.obj has changed", [line.get("message") for line in lines])
        self.assertEqual(select.select([run.stderr], [], [], 2)[0], [])

    def test_a_pattern_that_matches_nothing_is_refused_before_the_run(self):
        self.write("p.yaml", "facetmill: 1\nparams: {folder: {type: text}}\nstages: [load: 'in/*.off', load: '${folder}/*.off', write: o.ply]\n")
        self.write("q.yaml", "facetmill: 1\nstages: [load: in.off, write: q.ply]\n")
        for command in (("check", "p.yaml", "q.yaml"), ("plan", "p.yaml", "-D", "folder=more")):
            said = self.mill(*command, expect=3).stderr
            self.assertIn("p.yaml:3:16: error[E-FILE]: no file matches", said)
            self.assertEqual("more/*.off" in said, "plan" in command)
        self.assertIn("in/*.off", self.mill("plan", "p.yaml", "-D", "folder=more", "--inputs").stdout)
        self.write("in/a.off", TRIANGLE)
        self.mill("check", "p.yaml", "q.yaml")

    def test_a_watched_run_sees_what_comes(self):
        self.write("parts/a.off", TRIANGLE)
        self.write("p.yaml", "facetmill: 1\nallow: W-UNITS\nstages: [load: 'parts/*.off', include: a.yaml, write: o.off]\n")
        _, next_end = self.watch()
        self.assertEqual(next_end()[0], 3, "there is no a.yaml")
        fragment = "facetmill: 1\nstages: [split: midpoint]\n"
        for _ in range(2):
            self.write("a.yaml", fragment)
            self.assertEqual(next_end()[0], 0)
            (self.dir / "a.yaml").unlink()
            self.assertEqual(next_end()[0], 3)
        self.write("parts/a.off", TRIANGLE.replace("1 0 0", "2 0 0"))  # which the last plan read
        self.assertEqual(next_end()[0], 3)
        self.write("a.yaml", fragment)
        self.assertEqual(next_end()[0], 0)
        self.write("parts/b.off", TRIANGLE.replace("1 0 0", "3 0 0"))
        code, lines = next_end()
        self.assertEqual(code, 0)
        self.assertIn("parts/b.off has changed", [line.get("message") for line in lines])
        self.write("p.yaml", "facetmill: 1\nparams: {input: path}\nstages: [load: '${input}', write: o.off]\n")
        said = self.mill("run", "p.yaml", "-D", "input=-", "--watch", stdin="", expect=2).stderr
        self.assertIn("--watch cannot read", said)

    def test_a_watched_run_sees_what_changes_while_it_is_planned(self):
        self.write("in.off", TRIANGLE)
        self.write("a.yaml", "facetmill: 1\nstages: [split: midpoint]\n")
        self.write("p.yaml", "facetmill: 1\nallow: W-UNITS\nstages: [load: in.off, include: a.yaml, include: b.yaml, write: o.off]\n")
        os.mkfifo(self.dir / "b.yaml")

        def opened_for_reading():
            deadline = time.monotonic() + 60
            while True:
                try:
                    return os.fdopen(os.open(self.dir / "b.yaml", os.O_WRONLY | os.O_NONBLOCK), "w")
                except OSError:
                    self.assertLess(time.monotonic(), deadline, "b.yaml is not read")
                    time.sleep(0.01)

        _, next_end = self.watch()
        with opened_for_reading() as pipe:  # a.yaml was read
            time.sleep(0.05)
            self.write("a.yaml", "facetmill: 1\nstages: [{split: midpoint}, {split: midpoint}]\n")
            pipe.write("facetmill: 1\nstages: [relax: 1]\n")
        self.assertEqual(next_end()[0], 0)
        with opened_for_reading() as pipe:
            pipe.write("facetmill: 1\nstages: [relax: 1]\n")
        code, lines = next_end()
        self.assertEqual(code, 0)
        self.assertIn("a.yaml has changed", [line.get("message") for line in lines])

    def on_a_terminal(self, *arguments):
        """A run whose messages go to a terminal, and the end to read them at."""
        terminal, other = pty.openpty()
        self.addCleanup(os.close, terminal)
        run = subprocess.Popen([str(FACETMILL), *arguments], cwd=self.dir, stderr=other, stdout=subprocess.DEVNULL,
                               env={**os.environ, "TERM": "xterm"})
        os.close(other)
        return run, terminal

    def all_said(self, terminal):
        """What a run that has ended sent to its terminal; the kernel may hand it over in several pieces."""
        said = b""
        while True:
            try:
                more = os.read(terminal, 65536)
            except OSError as error:  # how Linux says that nobody writes there any more
                self.assertEqual(error.errno, errno.EIO)
                more = b""
            if not more:
                return said.decode()
            said += more

    def test_a_terminal_sees_how_far_a_stage_is(self):
        self.write("p.yaml", f"facetmill: 1\nallow: W-UNITS\nstages:\n  - load: {SCAN}\n  - relax: 100000\n  - write: o.ply\n")
        run, terminal = self.on_a_terminal("run", "p.yaml")
        self.addCleanup(run.wait)
        self.addCleanup(run.kill)
        said, deadline = "", time.monotonic() + 120
        while not re.search(r"\[#{8}[#.]{16}\] 2/3 relax \d+ %, about \d[\d mins]* left", said):
            self.assertLess(time.monotonic(), deadline, said)
            self.assertTrue(select.select([terminal], [], [], 60)[0], said)
            said += os.read(terminal, 4096).decode()

    def test_a_terminal_sees_which_report_is_rendered(self):
        self.write("in.off", TRIANGLE)
        self.write("p.yaml", "facetmill: 1\nallow: W-UNITS\nstages: [load: in.off, split: midpoint, write: o.off]\nreport: r.html\n")
        run, terminal = self.on_a_terminal("run", "p.yaml")
        self.assertEqual(run.wait(60), 0)
        said = self.all_said(terminal)
        self.assertLess(said.index("3/3 write"), said.index("[########################] r.html"))

    def test_a_terminal_sees_how_far_info_and_diff_are(self):
        for folder in ("a", "b"):
            self.write(f"{folder}/t.off", TRIANGLE)
            self.write(f"{folder}/u.off", TRIANGLE)
        for arguments, code, expected in (
                (("info", "a/t.off", "b/u.off"), 0, ("] 1/2 a/t.off", "[############............] 2/2 b/u.off")),
                (("diff", "a/t.off", "b/t.off", "--report", "r.md"), 0, ("] 1/1 compare", "] 1/1 r.md")),
                (("diff", "a", "b"), 0, ("] 1/2 t.off", "] 2/2 u.off")),
                (("info", "none.off"), 3, ("] 1/1 none.off", "there is no file"))):
            run, terminal = self.on_a_terminal(*arguments)
            self.assertEqual(run.wait(60), code)
            said = self.all_said(terminal)
            for text in expected:
                self.assertIn(text, said)
            self.assertTrue(said.rstrip("\r\n").endswith("\033[K") or code, said)  # nothing of it stays

    def test_events(self):
        self.write("in.off", TRIANGLE)
        self.write("p.yaml", "facetmill: 1\nallow: W-UNITS\nparams: {input: path}\n"
                             "stages: [load: '${input}', split: midpoint, validate: {closed: true}, write: o.off]\n")
        for arguments, asset in ((("run", "p.yaml", "-D", "input=in.off"), None),
                                 (("batch", "p.yaml", "--input", "in.off", "-o", "."), "in.off")):
            said = self.mill(*arguments, "--log", "json", expect=1).stderr
            stages = [e for e in map(json.loads, said.splitlines()) if e.get("event") == "stage"]
            self.assertEqual([(e["name"], e["faces_before"], e["faces_after"], e.get("asset")) for e in stages],
                             [("load", 0, 1, asset), ("split", 1, 4, asset), ("validate", 4, 4, asset)])
            self.assertTrue(all(e["seconds"] >= 0 and e["done"] for e in stages))

    def test_a_shell_sees_130(self):
        self.write("long.yaml", LONG.format(scan=SCAN))
        script = f"""sh -c 'echo $$ >pid; exec "{FACETMILL}" run long.yaml --output-dir shell'; echo $?"""
        shell = subprocess.Popen(["bash", "-c", script], cwd=self.dir, stdout=subprocess.PIPE,
                                 stderr=subprocess.DEVNULL, text=True)
        out = self.dir / "shell"
        while not (out.exists() and self.temporaries(out)):
            time.sleep(0.01)
        os.kill(int((self.dir / "pid").read_text()), signal.SIGINT)
        self.assertEqual(shell.communicate(timeout=60)[0].strip(), "130")
        self.assertFalse(out.exists(), "a folder made for the run is left")

    def test_what_a_killed_run_leaves_the_next_one_removes(self):
        run, out = self.start_long_run()
        run.kill()
        run.wait()
        left = self.temporaries(out)
        self.assertEqual(sorted(p.name for p in out.iterdir()), sorted(["early.ply", *left]))
        self.assertEqual((out / "early.ply").read_text(), "older")
        self.write("t.off", TRIANGLE)
        self.mill("pipe", "--output-dir", out, "load", "t.off", "!", "write", "early.ply")
        self.assertEqual([p.name for p in out.iterdir()], ["early.ply"])

    def test_a_failed_check_leaves_older_outputs(self):
        self.write("t.off", TRIANGLE)
        self.write("t.ply", "older")
        self.mill("pipe", "--report", "r.json", "load", "t.off", "!", "write", "t.ply", "!", "validate", "--closed",
                  expect=1)
        self.assertEqual((self.dir / "t.ply").read_text(), "older")
        self.assertTrue((self.dir / "r.json").exists(), "a report is always written")

    def test_a_full_disk(self):
        disk = self.dir / "disk"
        disk.mkdir()
        mount = subprocess.run(["mount", "-t", "tmpfs", "-o", "size=64k", "tmpfs", str(disk)], capture_output=True)
        if mount.returncode:
            self.mill("pipe", "load", SCAN, "!", "write", "--path", "/dev/full", "--format", "ply", expect=4)
            return
        self.addCleanup(subprocess.run, ["umount", str(disk)], check=False)
        (disk / "scan.ply").write_text("older")
        run = self.mill("pipe", "--output-dir", disk, "load", SCAN, "!", "write", "scan.ply", expect=4)
        self.assertIn("E-SPACE", run.stderr)
        self.assertEqual([p.name for p in disk.iterdir()], ["scan.ply"])
        self.assertEqual((disk / "scan.ply").read_text(), "older")

    def test_full_standard_output_is_no_success(self):
        with open("/dev/full", "w") as full:
            run = subprocess.run([str(FACETMILL), "stages"], stdout=full, stderr=subprocess.PIPE, text=True)
        self.assertEqual(run.returncode, 4)
        self.assertIn("E-WRITE", run.stderr)

    def test_unwritable_targets(self):
        self.write("t.off", TRIANGLE)
        self.write("file", "a file")
        (self.dir / "folder.ply").mkdir()
        self.mill("pipe", "load", "t.off", "!", "write", "file/t.ply", expect=4)
        self.mill("pipe", "load", "t.off", "!", "write", "folder.ply", expect=4)
        self.assertEqual(sorted(p.name for p in self.dir.iterdir()), ["file", "folder.ply", "t.off"])

    def test_diff_does_not_take_for_the_same_what_was_not_read(self):
        points = "v 0 0 0\nv 1 0 0\nv 0 1 0\n"
        self.write("lines.obj", points + "curv2 1 2 3\n")
        self.write("others.obj", points + "curv2 1 3\n")
        done = self.mill("diff", "lines.obj", "others.obj")
        self.assertTrue(done.stdout.startswith("lines.obj and others.obj agree in everything that was compared\n"
                                               "  not compared: lines.obj: "), done.stdout)
        found = json.loads(self.mill("diff", "--json", "lines.obj", "others.obj").stdout)
        self.assertEqual((found["same"], found["complete"]), (True, False))
        self.assertEqual([left["file"] for left in found["left_out"]], ["a", "b"])
        self.write("moved.obj", points.replace("0 1 0", "0 9 0"))
        self.mill("diff", "lines.obj", "moved.obj", expect=1)

    def test_the_hint_of_diff_can_be_followed(self):
        corners = ((0, 0, 0), (1, 0, 0), (0, 2, 0), (0, 0, 3))
        for name, size in (("mm.obj", 1000), ("m.obj", 1)):
            self.write(name, "".join(f"v {x * size} {y * size} {z * size}\n" for x, y, z in corners) + "f 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n")
        for given in ((), ("--unit", "mm"), ("--unit", "m,mm")):
            self.assertIn("use --unit mm,m, because neither file states a unit", self.mill("diff", "mm.obj", "m.obj", *given, expect=1).stdout)
        self.mill("diff", "mm.obj", "m.obj", "--unit", "mm,m")
        self.assertIn("if the first file is read without --unit", self.mill("diff", "m.obj", "m.obj", "--unit", "mm,m", expect=1).stdout)

    def test_diff_compares_lines(self):
        points = "v 0 0 0\nv 1 0 0\nv 0 1 0\n"
        self.write("lines.obj", points + "l 1 2 3\n")
        self.write("same.obj", "v 0 1 0\nv 1 0 0\nv 0 0 0\nl 1 2\nl 3 2\n")
        self.write("others.obj", points + "l 2 1 3\n")
        self.mill("diff", "lines.obj", "same.obj")
        done = self.mill("diff", "lines.obj", "others.obj", expect=1)
        self.assertIn("lines maximum", done.stdout)
        self.write("more.obj", points + "l 1 2 3 1\n")
        self.mill("diff", "lines.obj", "more.obj", expect=1)

    def test_a_contract_on_the_deviation_holds_points_too(self):
        self.write("cloud.ply", "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\n"
                                "property float z\nend_header\n0 0 0\n1 0 0\n")
        for limit, code in (("--ensure.deviation=10%", 1), ("--ensure.deviation=600%", 0)):
            self.mill("pipe", "load", "cloud.ply", "!", "transform", "--translate=0,5,0", limit, expect=code)

    def test_bad_inputs_have_their_exit_codes(self):
        self.write("cut.ply", "ply\nformat binary_little_endian 1.0\nelement vertex 9\nproperty float x\n"
                              "property float y\nproperty float z\nend_header\n")
        self.write("t.off", TRIANGLE)
        self.mill("pipe", "load", "none.ply", "!", "write", "a.glb", expect=3)
        self.mill("pipe", "load", "cut.ply", "!", "write", "a.glb", expect=6)
        self.mill("pipe", "load", "t.off", "!", "write", "a.xyz123", expect=2)
        self.mill("info", "none.ply", expect=3)
        self.mill("info", "cut.ply", expect=6)
        self.mill("pipe", "load", "t.off", "!", "write", "named-otherwise.off")
        self.mill("diff", "t.off", "named-otherwise.off")  # formats without names: the file's name is none
        self.mill("diff", "none.ply", "t.off", expect=3)
        self.mill("diff", "t.off", "cut.ply", expect=6)
        self.mill("diff", "t.off", "t.off", "--max", "2mm", expect=2)
        self.mill("diff", "t.off", "t.off", "--max", "-1", expect=2)
        for option, value in (("--unit", "m,"), ("--unit", ",m"), ("--unit", "mm,,m"), ("--unit", ""), ("--up", "y,"), ("--up", "z,x")):
            self.mill("diff", "t.off", "t.off", option, value, expect=2)
        self.mill("diff", "t.off", "t.off", "--unit", "m,m", "--up=z")
        self.mill("diff", "t.off", "t.off", "--values", "nan", expect=2)
        self.mill("diff", "t.off", "t.off", "--samples", "-1", expect=2)
        self.mill("run", "none.yaml", expect=3)
        self.mill("stages", "relux", expect=2)
        self.mill("pipe", "load", "t.off", "!", "relux", expect=2)
        self.assertEqual(self.mill(expect=2).stdout, "")

    @unittest.skipIf(SLOW, "sanitizers need more addresses than the limit")
    def test_hardly_any_memory(self):
        """From where the libraries just fit, and where there is too little for the stack of a thread."""
        self.write("p.yaml", "facetmill: 1\nparams: {input: path}\nstages: [{load: '${input}'}, {relax: 1}, "
                             "{write: '${input.stem}.ply'}]\n")
        self.mill("pipe", "generate", "icosphere", "--subdivisions", "5", "!", "write", "a.off")
        shutil.copy(self.dir / "a.off", self.dir / "b.off")
        run = ("run", "p.yaml", "-D", "input=a.off", "-o", "out")
        seen = set()
        for command in ((*run, "-j1"), (*run, "-j3"), (*run, "-j64"), ("batch", "p.yaml", "--input", "*.off", "-j2", "-o", "out2")):
            before_main = range(26000, 32000, 150) if "-j1" in command else ()
            many = range(90000, 900000, 15000) if "-j64" in command else ()
            for kib in (*before_main, *range(32000, 90000, 3000), *many):
                limit = kib << 10
                limited = lambda *arguments: subprocess.run(
                    [str(FACETMILL), *arguments], cwd=self.dir, capture_output=True, text=True, timeout=600,
                    preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, (limit, limit)))
                done = limited(*command)
                # 127 is the loader's: without its libraries the program does not begin. Nor does it when they
                # have no room to begin, not even for an exception: then it cannot tell its version either.
                if done.returncode in (-signal.SIGABRT, -signal.SIGSEGV):
                    self.assertEqual(limited("--version").returncode, done.returncode, f"{kib} KiB, {command}")
                    continue
                self.assertIn(done.returncode, (0, 7, 127), f"{kib} KiB, {command}\n{done.stderr}")
                if done.returncode == 7:
                    self.assertIn("E-MEMORY", done.stderr)
                seen.add(done.returncode)
        self.assertLessEqual({0, 7}, seen)

    def test_standard_input_and_output(self):
        run = self.mill("pipe", "load", "-", "!", "write", "-", "--format", "ply", stdin=TRIANGLE.encode(), text=False)
        self.assertTrue(run.stdout.startswith(b"ply\n"))
        again = self.mill("info", "--json", "-", stdin=run.stdout, text=False)
        self.assertIn(b'"faces": 1', again.stdout)
        pipeline = "facetmill: 1\nstages: [{load: t.off}, {write: out.ply}]\n"
        self.write("t.off", TRIANGLE)
        self.mill("run", "-", stdin=pipeline)
        self.assertTrue((self.dir / "out.ply").exists())

    def test_standard_input_is_read_once(self):
        twice = self.mill("pipe", "load", "-", "!", "load", "-", stdin=TRIANGLE, expect=2)
        self.assertIn("error[E-DUPLICATE-INPUT]: standard input can be read only once", twice.stderr)
        pipeline = 'facetmill: 1\nstages: [{load: "-"}]\n'
        both = self.mill("run", "-", stdin=pipeline, expect=2)
        self.assertIn("error[E-DUPLICATE-INPUT]: standard input holds the pipeline", both.stderr)

    def test_no_output_replaces_what_is_read_or_written_besides(self):
        scan = self.write("t.off", TRIANGLE)
        for arguments in (["pipe", "--save", "t.off", "load", "t.off"],
                          ["pipe", "--depfile", "t.off", "load", "t.off"],
                          ["pipe", "--save", "p.ply", "load", "t.off", "!", "write", "p.ply"],
                          ["pipe", "--depfile", "p.ply", "load", "t.off", "!", "write", "p.ply"],
                          ["pipe", "--report", "r.json", "--depfile", "r.json", "load", "t.off"],
                          ["pipe", "--save", "-", "load", "t.off", "!", "write", "-", "--format", "ply"]):
            run = self.mill(*arguments, expect=2)
            self.assertTrue("E-OVERWRITE" in run.stderr or "E-DUPLICATE-OUTPUT" in run.stderr, run.stderr)
        for name, text in {"self.yaml": "facetmill: 1\nstages: [{load: t.off}, {write: {path: self.yaml, format: ply}}]\n",
                           "self.json": "facetmill: 1\nstages: [{load: t.off}]\nreport: self.json\n",
                           "dep.yaml": "facetmill: 1\nstages: [{load: t.off}]\n"}.items():
            self.write(name, text)
            extra = ["--depfile", name] if name == "dep.yaml" else []
            self.assertIn("it is the pipeline itself", self.mill("run", name, *extra, expect=2).stderr)
            self.assertEqual((self.dir / name).read_text(), text)
        self.assertEqual((self.dir / "t.off").read_text(), TRIANGLE)

    def test_files_beside_an_output_replace_no_input(self):
        self.write("t.off", TRIANGLE)
        self.mill("pipe", "load", "t.off", "!", "write", "a.gltf")
        (self.dir / "a.bin").rename(self.dir / "b.bin")
        self.write("a.gltf", (self.dir / "a.gltf").read_text().replace("a.bin", "b.bin"))
        before = (self.dir / "b.bin").read_bytes()
        run = self.mill("pipe", "load", "a.gltf", "!", "split", "midpoint", "!", "write", "b.gltf", expect=4)
        self.assertIn("'b.bin' would overwrite an input", run.stderr)
        self.assertEqual((self.dir / "b.bin").read_bytes(), before)
        self.mill("pipe", "load", "t.off", "!", "write", "c.gltf", "!", "write", "c.bin", "--format", "ply", expect=2)

    def test_names_of_parts_lead_nowhere_else(self):
        self.write("evil.obj", "o ../evil.ply\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"
                   "o /tmp/facetmill-evil.ply\nv 0 0 1\nv 1 0 1\nv 0 1 1\nf 4 5 6\n")
        pipeline = ("facetmill: 1\nstages: [{load: evil.obj}, {foreach: {part: '*'}, do: [{write: '${part}'}, "
                    "{write: '${part.dir}${part.index}${part.ext}'}]}]\n")
        self.write("p.yaml", pipeline)
        self.mill("run", "p.yaml", "--output-dir", "o")
        self.assertFalse((self.dir / "evil.ply").exists())
        import pathlib
        self.assertFalse(pathlib.Path("/tmp/facetmill-evil.ply").exists())
        self.assertEqual(len(list((self.dir / "o").iterdir())), 4)

    def test_a_stream_that_fails_takes_the_files_back(self):
        self.write("t.off", TRIANGLE)
        self.write("old.ply", "old")
        self.mill("pipe", "load", "t.off", "!", "write", "new.ply", "!", "write", "old.ply", "!", "write", "/dev/full",
                  "--format", "ply", expect=4)
        self.assertFalse((self.dir / "new.ply").exists())
        self.assertEqual((self.dir / "old.ply").read_text(), "old")

    def test_a_refused_pipeline_has_a_report_too(self):
        import json
        self.write("t.off", TRIANGLE)
        self.write("p.yaml", "facetmill: 1\nstages: [{load: t.off}, {relax: -3}]\nreport: r.json\n")
        self.mill("run", "p.yaml", "--report", "r.xml", expect=2)
        report = json.loads((self.dir / "r.json").read_text())
        self.assertEqual(report["errors"][0]["id"], "E-RANGE")
        self.assertIn("E-RANGE", (self.dir / "r.xml").read_text())
        self.write("q.yaml", "facetmill: 1\nstages: [{load: t.off]\n")
        self.mill("run", "q.yaml", "--report", "q.json", expect=2)
        self.assertEqual(json.loads((self.dir / "q.json").read_text())["errors"][0]["id"], "E-YAML")

    def test_every_pipeline_is_checked(self):
        self.write("bad.yaml", "facetmill: 1\nstages: [{load: t.off}, {relux: 3}]\n")
        run = self.mill("check", "none.yaml", "bad.yaml", expect=2)
        self.assertIn("E-STAGE", run.stderr)
        self.assertIn("pipeline 'none.yaml' does not exist", run.stderr)

    def test_draco_files_and_options_of_other_formats(self):
        self.write("t.off", TRIANGLE)
        self.mill("pipe", "load", "t.off", "!", "write", "t.drc")
        for bad in (["a.ply", "--draco"], ["a.glb", "--ascii"], ["a.stl", "--mesh_manifold"], ["a.glb", "--big_endian"],
                    ["a.stl", "--precision", "full"]):
            self.assertIn("E-CONFLICT", self.mill("pipe", "load", "t.off", "!", "write", *bad, expect=2).stderr)
        self.assertIn("format: glb", self.mill("pipe", "load", "t.off", "!", "write", "-", "--format", "gltf", expect=2).stderr)

    def test_messages_as_json_and_quiet(self):
        import json
        self.write("t.off", TRIANGLE)
        run = self.mill("pipe", "--log", "json", "-v", "load", "t.off", "!", "write", "a.ply")
        for line in run.stderr.splitlines():
            self.assertIn("level", json.loads(line))
        self.assertEqual(self.mill("pipe", "--quiet", "load", "t.off", "!", "write", "a.ply").stderr, "")
        self.assertNotIn("\033", self.mill("pipe", "load", "t.off", "!", "write", "a.ply").stderr)

    def test_several_pipelines(self):
        self.write("t.off", TRIANGLE)
        for name in "ab":
            self.write(f"{name}.yaml", f"facetmill: 1\nstages: [{{load: t.off}}, {{write: {name}.ply}}]\n")
        self.mill("run", "a.yaml", "b.yaml")
        self.assertTrue((self.dir / "a.ply").exists() and (self.dir / "b.ply").exists())
        self.write("c.yaml", "facetmill: 1\nstages: [{load: t.off}, {write: a.ply}]\n")
        run = self.mill("run", "a.yaml", "c.yaml", expect=2)
        self.assertIn("E-DUPLICATE-OUTPUT", run.stderr)
        for name in "fg":
            self.write(f"{name}.yaml", "facetmill: 1\nstages: [{load: t.off}]\nreport: r.json\n")
        self.assertIn("another pipeline of this run also writes 'r.json'", self.mill("run", "f.yaml", "g.yaml", expect=2).stderr)
        self.write("d.yaml", "facetmill: 1\nstages: [{laod: t.off}]\n")
        self.write("e.yaml", "facetmill: 1\nstages: [{load: t.off}, {wirte: a.ply}]\n")
        run = self.mill("check", "d.yaml", "e.yaml", expect=2)
        self.assertIn("laod", run.stderr)
        self.assertIn("wirte", run.stderr)

    def test_a_gate_is_introduced_by_updating_its_baseline(self):
        self.write("t.off", TRIANGLE)
        self.write("p.yaml", "facetmill: 1\nstages: [{load: t.off}, {validate: {closed: true, baseline: k.json}}]\n")
        self.assertIn("k.json", self.mill("run", "p.yaml", expect=3).stderr)
        self.mill("run", "p.yaml", "--update-baseline")
        self.assertTrue((self.dir / "k.json").exists())
        self.mill("run", "p.yaml")
        self.mill("pipe", "load", "t.off", "!", "validate", "--closed", "--baseline", "l.json", "--update-baseline")
        self.assertEqual((self.dir / "k.json").read_bytes(), (self.dir / "l.json").read_bytes())
        self.write("q.yaml", "facetmill: 1\nstages: [{load: t.off}, {validate: {faces: 1}}]\n")
        self.assertIn("E-BASELINE", self.mill("run", "q.yaml", "--update-baseline", expect=2).stderr)

    def test_a_depfile_is_good_for_make(self):
        self.write("my scan.off", TRIANGLE)
        self.write("p.yaml", 'facetmill: 1\nstages: [{load: "my scan.off"}, {write: out.ply}]\n')
        self.mill("run", "p.yaml", "--depfile", "p.d", "--report", "r.json")
        text = (self.dir / "p.d").read_text()
        self.assertEqual(text.split(":")[0], "out.ply")
        self.assertIn("my\\ scan.off", text)
        self.write("Makefile", "out.ply:\n\tfalse\n-include p.d\n")
        make = ["make", "-q", "out.ply"]
        self.assertEqual(subprocess.run(make, cwd=self.dir).returncode, 0, text)
        later = time.time() + 10
        os.utime(self.dir / "my scan.off", (later, later))
        self.assertEqual(subprocess.run(make, cwd=self.dir).returncode, 1, text)
        self.mill("run", "p.yaml", "--depfile", "p.d", "--depfile-target", "stamp")
        self.assertEqual((self.dir / "p.d").read_text().split(":")[0], "stamp")

    def test_the_plan_knows_neighbours_and_reports(self):
        self.gltf_with_neighbours()
        self.write("p.yaml", "facetmill: 1\nstages: [{load: t.gltf}, {write: o.glb}]\nreport: r.json\n")
        self.assertEqual(self.mill("plan", "p.yaml", "--inputs").stdout.split(), ["t.gltf", "t.bin", "tex.png"])
        planned = self.mill("plan", "p.yaml", "--outputs", "-o", "out").stdout.split()
        self.assertEqual(planned, ["out/o.glb", "out/r.json"])
        self.assertEqual(json.loads(self.mill("plan", "p.yaml", "--json", "-o", "out").stdout)["reports"], ["out/r.json"])
        self.mill("run", "p.yaml", "-o", "out", "--report", "more.txt")
        self.assertEqual(sorted(self.files(self.dir / "out")), ["more.txt", "o.glb", "r.json"])
        self.write("q.yaml", "facetmill: 1\nstages: [{load: t.gltf}, {write: o.gltf}]\n")
        planned = self.mill("plan", "q.yaml", "--outputs", "-o", "beside").stdout.split()
        self.assertEqual(planned, ["beside/o.gltf", "beside/o.bin", "beside/o.tex.png"])
        self.mill("run", "q.yaml", "-o", "beside")
        self.assertEqual(sorted(self.files(self.dir / "beside")), ["o.bin", "o.gltf", "o.tex.png"])
        # Textures of PLY and of the libraries of OBJ, there or not; nothing from elsewhere.
        self.write("t.ply", "ply\nformat ascii 1.0\ncomment TextureFile tex.png\ncomment TextureFile ../no.png\nelement vertex 0\n"
                            "property float x\nproperty float y\nproperty float z\nend_header\n")
        self.write("t.obj", "mtllib more/t.mtl\nmtllib none.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nusemtl a\nf 1/1 2/1 3/1\n")
        self.write("more/t.mtl", "newmtl a\nmap_Kd -s 2 2 a.png\nmap_Bump ..\\\\tex.png\nnewmtl b\nmap_Kd a.png\nmap_Ks ../../no.png\n")
        for mesh, inputs in (("t.ply", ["t.ply", "tex.png"]), ("t.obj", ["t.obj", "more/t.mtl", "none.mtl", "tex.png", "more/a.png"])):
            self.write("q.yaml", f"facetmill: 1\nstages: [{{load: {mesh}}}, {{write: o.glb}}]\n")
            self.assertEqual(sorted(self.mill("plan", "q.yaml", "--inputs").stdout.split()), sorted(inputs))

    def test_the_plan_lists_what_a_run_writes(self):
        """The same files, whatever the input names its images by, and the same image once."""
        for name, colour in (("a", (200, 30, 30)), ("b", (90, 90, 90)), ("c", (90, 90, 90)), ("d", (10, 20, 30)), ("e", (200, 30, 30))):
            self.write("in/tex/x", "")
            (self.dir / f"in/tex/{name}.png").write_bytes(png(*colour))
        faces = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nvt 0 0\nvt 1 0\nvt 0 1\n"
        self.write("in/m.mtl", "newmtl one\nmap_Kd tex/a.png\nmap_d tex/b.png\nmap_bump tex/b.png\nmap_Ke tex/e.png\n"
                               "newmtl two\nmap_Kd tex/a.png\nmap_Pr tex/b.png\nmap_Pm tex/d.png\nmap_Ke tex/c.png\n"
                               "newmtl unused\nmap_Kd tex/d.png\nnewmtl broken\nmap_Kd tex/x\nmap_Ke tex/none.png\n")
        self.write("in/m.obj", "mtllib m.mtl\n" + faces + "usemtl one\nf 1/1 2/2 3/3\nusemtl two\nf 1/1 2/2 4/3\n"
                               "usemtl broken\nf 2/1 3/2 4/3\n")
        self.write("in/untextured.obj", "mtllib m.mtl\n" + faces + "usemtl one\nf 1 2 3\n")
        self.write("in/plain.obj", "mtllib m.mtl\n" + faces + "f 1/1 2/2 3/3\n")
        self.write("in/late.obj", "mtllib m.mtl\n" + faces + "v 1 2 3\n" * 200000 + "usemtl two\nf 1/1 2/2 3/3\n")
        ply = ("ply\nformat ascii 1.0\n{}element vertex 3\nproperty float x\nproperty float y\nproperty float z\n{}element face 1\n"
               "property list uchar int vertex_indices\nend_header\n{}3 0 1 2\n")
        one = "comment TextureFile tex/a.png\n"
        uv = "property float s\nproperty float t\n"
        self.write("in/p.ply", ply.format(one, uv, "0 0 0 0 0\n1 0 0 1 0\n0 1 0 0 1\n"))
        self.write("in/two.ply", ply.format(one + one.replace("a.", "d."), uv, "0 0 0 0 0\n1 0 0 1 0\n0 1 0 0 1\n"))
        self.write("in/none.ply", ply.format(one, "", "0 0 0\n1 0 0\n0 1 0\n"))
        self.gltf_with_neighbours(self.dir / "in")
        inputs = sorted(p.name for p in (self.dir / "in").iterdir() if p.suffix in (".obj", ".ply", ".gltf"))
        self.assertEqual(len(inputs), 8)
        counts = {}
        for name in inputs:
            for how in ("", ", textures: copy", ", textures: embed", ", textures: reference"):
                self.write("q.yaml", f"facetmill: 1\nstages:\n  - load: in/{name}\n  - write: {{path: new/o.gltf{how}}}\n"
                                     "  - write: o.obj\n")
                planned = self.mill("plan", "q.yaml", "--outputs", "-o", "out").stdout.splitlines()
                self.mill("run", "q.yaml", "-o", "out")
                written = sorted("out/" + n for n in self.files(self.dir / "out"))
                self.assertEqual(sorted(planned), written, f"{name}{how}")
                counts[name, how] = len(written)
                shutil.rmtree(self.dir / "out")
        self.assertEqual(counts["m.obj", ", textures: copy"], 4 + 2 * 5)  # two plain ones, three made of others, beside each
        self.assertEqual(counts["p.ply", ""], counts["two.ply", ""])
        self.assertGreater(counts["late.obj", ""], counts["late.obj", ", textures: embed"])

    def test_warnings_name_their_input_and_can_be_allowed(self):
        self.write("t.off", TRIANGLE)
        line = ["load", "t.off", "!", "write", "o.glb"]
        self.assertIn("warning[W-UNITS]: t.off: ", self.mill("pipe", "--quiet", *line).stderr)
        for allow in (["--allow", "W-UNITS"], ["--quiet=W-UNITS"], ["--allow=W-UNITS", "--strict"]):
            self.assertNotIn("W-UNITS", self.mill("pipe", *allow, *line).stderr)
        self.write("p.yaml", "facetmill: 1\nallow: W-UNITS\nstages: [{load: t.off}, {write: o.glb}]\nreport: r.txt\n")
        run = self.mill("run", "p.yaml", "--strict")
        self.assertNotIn("warning[", run.stderr)
        self.assertIn("report r.txt", run.stderr)
        self.assertIn("did you mean 'W-UNITS'?", self.mill("pipe", "--allow", "W-UNIT", *line, expect=2).stderr)
        self.write("q.yaml", "facetmill: 1\nallow: [W-UNIT]\nstages: [{load: t.off}]\nreport: r.txt\n")
        run = self.mill("run", "q.yaml", expect=2)
        self.assertIn("did you mean 'W-UNITS'?", run.stderr)
        self.assertIn("report r.txt", run.stderr)
        self.assertNotIn("W-SIMPLIFY", self.mill("pipe", "load", "t.off", "!", "simplify", "100%").stderr)

    def test_every_output_is_a_function_of_the_inputs(self):
        self.write("p.yaml", f"facetmill: 1\nstages: [{{load: {SCAN}}}, {{clip: {{plane: z=50%, cap: true}}}}, {{simplify: 20%}}, "
                             "{measure: {path: m.json}}, {render: v.png}, {validate: {closed: true, severity: warn}}, "
                             "{write: {path: sub/o.glb, draco: {position_bits: 4}}}]\n"
                             "report: [r.json, r.html, r.txt, r.xml]\n")
        for folder, threads in (("one", "1"), ("two/deep", "2")):
            self.mill("run", "p.yaml", "-o", folder, "-j", threads, "--timings", f"{self.dir}/{threads}.json")
            self.assertEqual(json.loads((self.dir / f"{threads}.json").read_text())["threads"], int(threads))
        one = self.files(self.dir / "one")
        self.assertEqual(len(one), 7)
        self.assertEqual(one, self.files(self.dir / "two/deep"))

    def test_reports_name_outputs_from_their_folder(self):
        self.gltf_with_neighbours()
        self.mill("pipe", "-o", "out", "--report", "r.json", "load", "t.gltf", "!", "write", "sub/../o.gltf")
        report = json.loads((self.dir / "out/r.json").read_text())
        self.assertEqual([file["path"] for file in report["outputs"]], ["o.gltf", "o.bin", "o.tex.png"])

    def test_an_unknown_stage_in_a_one_liner_is_pointed_out(self):
        said = self.mill("pipe", "load", "a.stl", "!", "simpilfy", "10%", expect=2).stderr
        self.assertIn("command line:1:29: error[E-STAGE]: ", said)
        self.assertIn("did you mean 'simplify'?", said)

    def test_one_error_is_told_once(self):
        self.write("t.off", TRIANGLE)
        run = self.mill("pipe", "load", "t.off", "!", "validate", "--closed", expect=1)
        self.assertEqual(run.stderr.count("closed' must be"), 1, run.stderr)
        self.assertIn("3 locations, first: face 0 of 't'", run.stderr)
        self.assertTrue(run.stderr.endswith("failed; no output was written; exit code 1\n"), run.stderr)
        run = self.mill("pipe", "load", "none.off", "!", "write", "a.ply", expect=3)
        self.assertEqual(run.stderr.count("none.off'"), 1, run.stderr)

    def test_a_pipeline_that_leaves_nothing_says_so(self):
        self.write("t.off", TRIANGLE)
        self.assertIn("W-NOTHING", self.mill("pipe", "--quiet", "load", "t.off", "!", "relax", "3").stderr)
        self.mill("pipe", "--strict=W-NOTHING", "load", "t.off", "!", "relax", "3", expect=1)
        self.write("p.yaml", "facetmill: 1\nstages: [{load: t.off}, {relax: 3}]\n")
        self.assertIn("W-NOTHING", self.mill("check", "p.yaml").stderr)
        self.assertIn("W-NOTHING", self.mill("plan", "p.yaml").stderr)
        for line in (["measure"], ["validate", "--faces", "1"], ["write", "a.ply"], ["relax", "--ensure.faces", "1"]):
            self.assertNotIn("W-NOTHING", self.mill("pipe", "load", "t.off", "!", *line).stderr)

    def test_many_quiet_runs(self):
        """A log of 30 assets: every line says which one it is about, and what is allowed is not said."""
        log = ""
        for i in range(30):
            self.write(f"scan{i}.off", TRIANGLE)
            self.write("p.yaml", "facetmill: 1\nparams: {input: path}\n"
                                 "stages: [{load: '${input}'}, {simplify: 100%}, {write: '${input.stem}.glb'}]\n")
            log += self.mill("run", "p.yaml", "--quiet", "-D", f"input=scan{i}.off").stderr
            self.assertEqual(self.mill("run", "p.yaml", "--quiet", "--allow", "W-UNITS", "-D", f"input=scan{i}.off").stderr, "")
        warnings = [line for line in log.splitlines() if "warning[" in line]
        self.assertEqual(len(warnings), 30, log)
        for i, line in enumerate(warnings):
            self.assertIn(f"scan{i}.off", line)

    def test_input_that_never_ends_ends_quickly(self):
        (self.dir / "bomb.stl.gz").write_bytes(gzip.compress(bytes(80 << 20), 6))
        for name in ("bomb.stl.gz", "/dev/zero"):
            self.assertIn("E-SIZE", self.mill("info", name, expect=7).stderr)
        with open("/dev/zero", "rb") as zero:
            run = subprocess.run([str(FACETMILL), "info", "-"], stdin=zero, capture_output=True, text=True, timeout=60)
        self.assertEqual(run.returncode, 7, run.stderr)

    def test_many_messages_that_are_alike_are_told_as_ten(self):
        corners = [(x, y, z) for z in (0, 1) for y in (0, 1) for x in (0, 1)]
        sides = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
        text = ""
        for i in range(30):
            text += f"o box{i}\n" + "".join(f"v {x + 2 * i} {y} {z}\n" for x, y, z in corners)
            text += "".join("f " + " ".join(str(8 * i + k + 1) for k in side) + "\n" for side in sides)
        scene = self.write("boxes.obj", text)
        words = ["load", scene, "!", "simplify", "--faces", "100000", "--share", "equal", "!", "thicken", "0.1", "!", "write", "o.ply"]
        told = self.mill("pipe", "--report", "r.json", *words).stderr
        self.assertEqual(told.count("at or below the target"), 10)
        self.assertIn("warning[W-SIMPLIFY-NOTHING]: 20 more like these", told)
        self.assertIn("and 10 more lines (--report run.txt lists all)", told)
        stages = {s["name"]: s for s in json.loads((self.dir / "r.json").read_text())["stages"]}
        self.assertEqual(len(stages["simplify"]["warnings"]), 30)
        lines = self.mill("pipe", "--log", "json", *words).stderr.splitlines()
        self.assertEqual(sum("W-SIMPLIFY-NOTHING" in line for line in lines), 30)
        # The line that says how many more there are takes as much room as one.
        first = self.write("eleven.obj", text[:text.index("o box11\n")])
        told = self.mill("pipe", "load", first, *words[2:]).stderr
        self.assertEqual(told.count("at or below the target"), 11)
        self.assertNotIn("more like these", told)

    def test_info_of_a_cloud_tells_what_it_has(self):
        self.write("c.ply", "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
                            "property float quality\nend_header\n0 0 0 nan\n1 0 0 1\n0 1 0 2\n")
        rows = [line.split()[0] for line in self.mill("info", "c.ply").stdout.splitlines()[1:]]
        self.assertEqual(rows[:4], ["vertices", "wedges", "faces", "isolated_vertices"])
        self.assertNotIn("closed", rows)
        self.assertNotIn("face_kinds", rows)
        self.assertIn("quality", rows)
        self.assertIs(json.loads(self.mill("info", "--json", "c.ply").stdout)["closed"], True)
        # The value that is none stays in PLY, and is told where it cannot.
        self.assertNotIn("W-NAN", self.mill("pipe", "load", "c.ply", "!", "write", "d.ply", "--ascii").stderr)
        self.assertIn("0 0 0 nan\n", (self.dir / "d.ply").read_text())
        told = self.mill("pipe", "load", "c.ply", "!", "write", "d.drc", expect=None).stderr
        self.assertIn("1 value of 'quality' is no number (nan), which Draco cannot hold: it is 0 in the file", told)

    def test_standard_input_is_read_once(self):
        for words in (("diff", "-", "-"), ("info", "-", "-")):
            told = self.mill(*words, stdin=TRIANGLE, expect=2).stderr
            self.assertIn("E-DUPLICATE-INPUT]: standard input can be read only once", told)

    def test_control_characters_of_names_do_not_reach_the_terminal(self):
        name = "a\x1b[31m\x07\x9b5m"
        self.write("t.off", TRIANGLE)
        self.write("in/" + name + ".off", TRIANGLE)
        self.write("p.yaml", "facetmill: 1\nparams: {input: {type: path}}\nstages:\n"
                             "  - {load: '${input}'}\n  - {write: '${input.stem}.ply'}\n")
        for words in (["new", name + ".yaml"],
                      ["pipe", "-v", "--report", name + ".json", "load", "t.off", "!", "write", name + ".ply"],
                      ["run", "-v", "p.yaml", "-D", f"input=in/{name}.off", "-o", "out"],
                      ["plan", "p.yaml", "-D", f"input=in/{name}.off"],
                      ["info", f"in/{name}.off"],
                      ["check", "p.yaml", name + ".yaml"],
                      ["diff", f"in/{name}.off", "t.off"],
                      ["diff", "in", "in"],
                      ["batch", "-v", "p.yaml", "--input", "in/*.off", "-o", "many", "--report", name + ".html"]):
            run = self.mill(*words, expect=None)
            self.assertIn(run.returncode, (0, 1), (words, run.stderr))
            for c in "\x1b\x07\x9b":
                self.assertNotIn(c, run.stderr + run.stdout, words)
        self.assertIn("wrote a?[31m", self.mill("new", name + "2.yaml").stderr)


class Save(Case):
    def check_saved(self, target, *line):
        self.write("t.off", TRIANGLE)
        (self.dir / "sub").mkdir(exist_ok=True)
        self.mill("pipe", "--save", target, "--output-dir", "one", *line)
        self.mill("run", target, "--output-dir", "two")
        self.assertEqual(self.files(self.dir / "one"), self.files(self.dir / "two"))
        self.assertTrue(self.files(self.dir / "one"))
        return (self.dir / target).read_text()

    def test_a_saved_one_liner_gives_the_same_bytes(self):
        text = self.check_saved("p.yaml", "load", "t.off", "!", "split", "midpoint", "!", "clip", "--plane.normal=1,0,0",
                                "--plane.through=0.3,0,0", "--name", "cut", "!", "write", "a.glb", "--draco", "!",
                                "foreach", "n=1,2", "[", "relax", "@{n}", "!", "write", "o@{n.index}.ply", "]")
        self.assertTrue(text.startswith("facetmill: 1\n"))

    def test_a_pipeline_saved_elsewhere_reads_the_same_files(self):
        text = self.check_saved("sub/p.yaml", "load", "t.off", "!", "write", "a.ply")
        self.assertIn("../t.off", text)

    def test_a_real_scan(self):
        self.check_saved("p.yaml", "load", SCAN, "--unit", "mm", "!", "clip", "y=-150", "--cap", "!", "simplify", "10pct",
                         "!", "write", "a.glb", "--draco")


if __name__ == "__main__":
    main()
