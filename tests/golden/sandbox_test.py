"""The sandbox: a reader that tries more than to read gets nothing, and what a plan names still works."""

import errno
import json
import os
import pathlib
import shutil
import stat
import subprocess
import tempfile
import threading
import unittest

from support import FACETMILL, SCAN, Case, main

OBJ = "mtllib t.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl red\nf 1 2 3\n"
MTL = "newmtl red\nKd 1 0 0\n"
OFF = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"
PROBE = os.environ.get("FACETMILL_PROBE")
FILES = ["read-passwd", "read-secret", "write-secret", "list-outside", "make-file", "truncate", "make-folder", "make-link",
         "remove", "rename"]
CALLS = ["execve", "clone", "fork", "spawn", "socket-inet", "socket-unix", "ptrace", "unshare", "bpf", "keyctl", "io_uring",
         "mount"]


def offered():
    run = subprocess.run([str(FACETMILL), "--version", "--json"], capture_output=True, text=True, check=True)
    return json.loads(run.stdout)["sandbox"]


HAS = offered()
needs_files = unittest.skipUnless(HAS["landlock"], "this kernel, or this build, has no Landlock")
needs_calls = unittest.skipUnless(HAS["seccomp"], "this kernel, or this build, has no seccomp")
needs_probe = unittest.skipUnless(PROBE, "no tests/faults/probe.c in this build")


class Sandbox(Case):
    def setUp(self):
        super().setUp()
        self.inputs = self.dir / "in"
        self.outside = pathlib.Path(tempfile.mkdtemp(prefix="facetmill-outside-"))
        self.addCleanup(shutil.rmtree, self.outside)
        self.write("in/t.obj", OBJ)
        self.write("in/t.mtl", MTL)
        for name in ("secret", "victim", "here"):
            (self.outside / name).write_text("a secret")

    def probed(self, *arguments, at="t.obj", env=None, expect=0):
        """What a reader could do: the error of each try, 0 for success."""
        read, write = os.pipe()
        variables = {"LD_PRELOAD": PROBE, "FACETMILL_PROBE_AT": at, "FACETMILL_PROBE_LOG": str(write),
                     "FACETMILL_PROBE_SECRET": str(self.outside / "secret"), "FACETMILL_PROBE_OUTSIDE": str(self.outside),
                     "FACETMILL_PROBE_VICTIM": str(self.outside / "victim"),
                     "FACETMILL_PROBE_BESIDE": str(self.inputs / "t.mtl"), **(env or {})}
        run = subprocess.run([str(FACETMILL), *map(str, arguments)], cwd=self.dir, capture_output=True, text=True,
                             env={**os.environ, **variables}, pass_fds=[write], timeout=600)
        os.close(write)
        with os.fdopen(read) as log:
            found = dict(line.split() for line in log)
        self.assertEqual(run.returncode, expect, run.stderr)
        self.assertTrue(found, "nothing was tried")
        return {name: int(error) for name, error in found.items()}

    def refused(self, found):
        for name in FILES if HAS["landlock"] else []:
            for who in ("", "thread-"):
                self.assertIn(found[who + name], (errno.EACCES, errno.EXDEV), who + name)
        for name in CALLS if HAS["seccomp"] else []:
            self.assertEqual(found[name], errno.EPERM, name)
        if HAS["landlock"]:
            self.assertEqual(found["threads"], 1)  # others would keep their access
        self.assertEqual(found["read-beside"], 0)
        self.assertEqual(sorted(p.name for p in self.outside.iterdir()), ["here", "secret", "victim"])
        self.assertEqual((self.outside / "secret").read_text(), "a secret")

    @needs_probe
    def test_a_reader_that_tries_more(self):
        self.write("p.yaml", "facetmill: 1\nstages:\n  - load: in/t.obj\n  - write: t.glb\n")
        for command in (["pipe", "load", "in/t.obj", "!", "write", "out/t.glb"], ["run", "p.yaml", "--output-dir", "out"],
                        ["render", "in/t.obj", "-o", "out/t.png"], ["info", "in/t.obj"],
                        ["diff", "in/t.obj", "in/t.obj"]):
            with self.subTest(command=command[0]):
                self.refused(self.probed(*command))

    @needs_probe
    def test_a_batch(self):
        """When it opens its journal, the headers have been read; then only the files of its assets are left."""
        self.write("p.yaml", "facetmill: 1\nparams: {input: path}\nstages:\n  - load: ${input}\n  - write: t.glb\n")
        self.refused(self.probed("batch", "p.yaml", "--input", "in/*.obj", "-o", "out", at="out/.facetmill-batch"))

    @needs_probe
    def test_checks_and_plans_write_nothing(self):
        self.write("p.yaml", "facetmill: 1\nstages:\n  - load: in/t.obj\n  - write: t.glb\n")
        for command in (["plan", "p.yaml"], ["check", "p.yaml"]):
            found = self.probed(*command)
            for name in FILES if HAS["landlock"] else []:
                self.assertEqual(found[name] == 0, name in ("read-passwd", "read-secret", "list-outside"), name)
            for name in CALLS if HAS["seccomp"] else []:
                self.assertEqual(found[name], errno.EPERM, name)

    @needs_probe
    def test_without_it_the_same_tries_succeed(self):
        """So the test above can fail."""
        found = self.probed("pipe", "--no-sandbox", "load", "in/t.obj", "!", "write", "t.glb")
        self.assertEqual([name for name in FILES if found[name] != 0], [])
        self.assertEqual([name for name in ("clone", "fork", "spawn", "socket-inet", "socket-unix") if found[name] != 0], [])
        self.assertEqual(found["execve"], errno.ENOENT)

    @needs_probe
    def test_where_the_kernel_has_neither(self):
        env = {"LD_PRELOAD": PROBE, "FACETMILL_PROBE_OLD_KERNEL": "1"}
        told = self.mill("pipe", "-v", "load", "in/t.obj", "!", "write", "new/t.glb", env=env).stderr
        self.assertIn("there is no sandbox", told)
        none = json.loads(self.mill("--version", "--json", env=env).stdout)["sandbox"]
        self.assertEqual(none, {"landlock": 0, "seccomp": False})

    # --- what a plan names works

    def test_outputs_in_folders_that_are_not_there_yet(self):
        self.mill("pipe", "load", "in/t.obj", "!", "write", "a/b/c/t.gltf")
        self.assertTrue((self.dir / "a/b/c/t.gltf").exists())
        self.mill("pipe", "--report", "r/t.html", "--timings", "m/t.json", "--depfile", "d/t.d", "-o", "new/out",
                  "load", "in/t.obj", "!", "write", "t.ply")
        for name in ("new/out/t.ply", "new/out/r/t.html", "new/out/m/t.json", "d/t.d"):
            self.assertTrue((self.dir / name).exists(), name)

    def test_the_copy_of_what_fails(self):
        """It is no output of the plan, and nothing else is written there."""
        self.write("p.yaml", "facetmill: 1\nstages:\n- load: in/t.obj\n- validate: {closed: true, mark: failed/a.ply}\n")
        (self.dir / "failed").mkdir()
        run = self.mill("run", "p.yaml", expect=1)
        self.assertNotIn("E-WRITE", run.stderr)
        self.assertTrue((self.dir / "failed/a.ply").is_file())

    def test_links(self):
        (self.dir / "link.off").symlink_to(self.dir / "far/t.off")
        self.write("far/t.off", OFF)
        (self.dir / "target").mkdir()
        (self.dir / "out.ply").symlink_to(self.dir / "target/out.ply")
        self.mill("pipe", "load", "link.off", "!", "write", "out.ply")
        self.assertTrue((self.dir / "target/out.ply").exists())
        self.assertTrue((self.dir / "out.ply").is_symlink())

    def test_streams(self):
        self.write("t.off", OFF)
        self.mill("pipe", "load", "/dev/stdin", "!", "measure", stdin=OFF)
        self.assertTrue(self.mill("render", "t.off", "-o", "-", text=False).stdout.startswith(b"\x89PNG"))
        with open(self.dir / "t.off", "rb") as file:  # a file as standard input, by its name
            run = subprocess.run([str(FACETMILL), "info", "/dev/stdin"], stdin=file, capture_output=True, cwd="/")
        self.assertEqual(run.returncode, 0, run.stderr)
        fifo = self.dir / "fifo"
        os.mkfifo(fifo)
        feeder = threading.Thread(target=lambda: fifo.write_text(OFF))
        feeder.start()
        self.mill("info", fifo)
        feeder.join()

    def test_patterns(self):
        for name in ("s/a/1.off", "s/b/c/2.off", "s/3.off"):
            self.write(name, OFF)
        self.mill("pipe", "load", "s/**/*.off", "!", "write", "all.ply")
        self.mill("batch", "quickstart", "--inputs-from", "-", "-o", "out", "--report", "index.html", "--cache",
                  stdin="s/a/1.off\ns/b/c/2.off\n", env={"FACETMILL_CACHE": str(self.dir / "new/cache")}, expect=None)
        self.assertTrue((self.dir / "out/index.html").exists())

    def test_names_that_only_the_run_knows(self):
        self.write("p.yaml", """facetmill: 1
stages:
  - load: in/t.obj
  - foreach: {part: '*'}
    do:
      - write: ../parts/${part}.ply
""")
        self.mill("run", "p.yaml", "--output-dir", "out")
        self.assertEqual(len(list((self.dir / "parts").iterdir())), 1)

    def test_the_cache(self):
        env = {"FACETMILL_CACHE": str(self.dir / "deep/cache")}
        line = ["pipe", "--cache", "--cache-everything", "--log", "json", "load", "in/t.obj", "!", "split", "midpoint", "!",
                "write", "t.ply"]
        self.mill(*line, env=env)
        self.assertTrue(any(p.suffix == ".scene" for p in (self.dir / "deep/cache").rglob("*")))
        self.assertEqual(stat.S_IMODE((self.dir / "deep/cache").stat().st_mode), 0o700)
        self.assertNotIn("W-CACHE", self.mill(*line, env=env).stderr)

    # --- what it says

    def test_it_says_what_is_on(self):
        told = self.mill("pipe", "-v", "load", "in/t.obj", "!", "measure").stderr
        self.assertEqual("Landlock" in told, bool(HAS["landlock"]))
        self.assertEqual("seccomp" in told, HAS["seccomp"])
        self.assertNotIn("sandbox", self.mill("pipe", "-v", "--no-sandbox", "load", "in/t.obj", "!", "measure").stderr)

    def test_folders_go_when_nothing_is_written(self):
        self.mill("pipe", "load", "in/none.obj", "!", "write", "a/b/t.ply", expect=3)
        self.assertFalse((self.dir / "a").exists())

    def test_the_same_bytes(self):
        for name, more in (("on.glb", []), ("off.glb", ["--no-sandbox"])):
            self.mill("pipe", *more, "load", SCAN, "!", "simplify", "20%", "!", "write", name)
        self.assertEqual((self.dir / "on.glb").read_bytes(), (self.dir / "off.glb").read_bytes())


if __name__ == "__main__":
    main()
