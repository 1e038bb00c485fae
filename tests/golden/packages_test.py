"""The Python module, the npm package and the review of packaging/, with the program under test."""

import os
import pathlib
import shutil
import subprocess
import sys
import unittest

from support import FACETMILL, SLOW, SOURCE, STRICT, Case, main

PACKAGING = SOURCE / "packaging"


@unittest.skipIf(SLOW, "the packages start facetmill as others do; the release build tests them")
class Packages(Case):
    def run_ok(self, *command, expect=0, cwd=None, **env):
        run = subprocess.run([str(c) for c in command], cwd=cwd or self.dir, capture_output=True, text=True, timeout=600,
                             env={**os.environ, "FACETMILL": str(FACETMILL), **env})
        self.assertEqual(run.returncode, expect, run.stdout + run.stderr)
        return run

    def test_the_python_module(self):
        shutil.copytree(PACKAGING / "python/facetmill", self.dir / "facetmill", ignore=shutil.ignore_patterns("__pycache__", "reports.py"))
        self.run_ok(sys.executable, PACKAGING / "python/dataclasses_from_schema.py", self.dir / "facetmill/reports.py", FACETMILL)
        self.run_ok(sys.executable, "-m", "unittest", "discover", PACKAGING / "python/tests", PYTHONPATH=str(self.dir))

    def test_the_npm_package(self):
        if not shutil.which("npm"):
            self.assertFalse(STRICT, "npm is missing")
            self.skipTest("npm is missing")
        self.run_ok("node", PACKAGING / "npm/pack.mjs", self.dir, FACETMILL, "linux-x64")
        project = self.dir / "project"
        project.mkdir()
        shutil.copy(PACKAGING / "npm/tests/test.mjs", project)
        self.run_ok("npm", "init", "-y", cwd=project)
        self.run_ok("npm", "install", "--offline", "--no-audit", *sorted(self.dir.glob("*.tgz")), cwd=project)
        self.assertIn("all passed", self.run_ok("node", "test.mjs", cwd=project).stdout)

    def test_a_review_names_what_changed(self):
        def git(*arguments):
            self.run_ok("git", "-c", "user.name=n", "-c", "user.email=n@localhost", "-c", "init.defaultBranch=main", *arguments)

        def commit():
            git("add", "-A")
            git("commit", "-qm", "change")

        name = "my assets/cube (1).glb"
        (self.dir / "my assets").mkdir()
        git("init", "-q")
        self.mill("pipe", "-q", "generate", "cube", "!", "write", name)
        self.mill("pipe", "-q", "generate", "cube", "!", "write", "old.stl")
        commit()
        self.mill("pipe", "-q", "generate", "cube", "!", "transform", "--scale", "2", "!", "write", name)
        (self.dir / "old.stl").rename(self.dir / "new.stl")
        commit()
        review = PACKAGING / "ci/review.sh"
        shown = self.run_ok(review, "HEAD~1", LINK="https://example.org/x").stdout
        self.assertIn("| removed | old.stl |", shown)
        self.assertIn("| added | new.stl |", shown)
        self.assertIn("| differs | [my assets/cube (1).glb](https://example.org/x/my%20assets/cube%20%281%29.glb.html) |", shown)
        summary = (self.dir / "facetmill-review/summary.md").read_text()
        self.assertIn("(https://example.org/x/my%20assets/cube%20%281%29.glb.png)", summary)
        for suffix in (".html", ".png"):
            self.assertTrue(pathlib.Path(self.dir, "facetmill-review", name + suffix).exists())
        self.run_ok(review, "HEAD~1", expect=1, LIMITS="--max 0.5%")
        self.write("bad.glb", "broken")
        commit()
        self.assertIn("| cannot be read | bad.glb |", self.run_ok(review, "HEAD~1", expect=6).stdout)
        self.run_ok(review, "nothing", expect=2)


if __name__ == "__main__":
    main()
