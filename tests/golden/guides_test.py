"""The guides are true as printed: each of their commands runs, with exit code 0, on the bust of the examples."""

import os
import re
import shutil
import subprocess
import sys
import unittest

from support import FACETMILL, SCAN, SLOW, SOURCE, STRICT, Case

GUIDES = sorted((SOURCE / "docs/guides").glob("*.md"))


class Guides(Case):
    def commands(self, page):
        for block in re.findall(r"^```sh\n(.*?)^```", page.read_text(), flags=re.M | re.S):
            yield from block.splitlines()

    def python_with_yaml(self):
        """This Python, or Debian's, which has its package."""
        for python in (sys.executable, "/usr/bin/python3"):
            if subprocess.run([python, "-c", "import yaml"], capture_output=True).returncode == 0:
                return python
        if STRICT:
            self.fail("python3-yaml is missing")
        self.skipTest("python3-yaml is missing")

    @unittest.skipIf(SLOW, "the same commands on the same scan, ten times slower")
    def test_every_command_of_the_guides_runs(self):
        (self.dir / "bin").mkdir()
        (self.dir / "bin/facetmill").symlink_to(FACETMILL)
        path = f"{self.dir / 'bin'}:{os.environ['PATH']}"
        for page in GUIDES:
            folder = self.dir / page.stem
            folder.mkdir()
            shutil.copy(SCAN, folder / "scan.ply")
            commands = list(self.commands(page))
            self.assertTrue(commands, page)
            for command in commands:
                with self.subTest(page=page.name, command=command):
                    run = subprocess.run(command, shell=True, cwd=folder, capture_output=True, text=True, timeout=600,
                                         env={**os.environ, "PATH": path})
                    self.assertEqual(run.returncode, 0, run.stderr)
                    self.assertNotIn("error[", run.stderr)
        self.assertIn("<h3>clean", (self.dir / "scan-to-web/out/page.html").read_text())

    @unittest.skipIf(SLOW, "pictures of the same scenes, ten times slower")
    def test_the_pages_of_the_manual_can_be_made(self):
        python = self.python_with_yaml()
        run = subprocess.run([python, SOURCE / "tools/site/site.py", self.dir / "site", "--mill", FACETMILL,
                              "--pages"], capture_output=True, text=True, timeout=600)
        self.assertEqual(run.returncode, 0, run.stderr)
        pages = self.dir / "site/pages"
        stages = [line.split()[0] for line in self.mill("stages").stdout.splitlines()]
        self.assertEqual(sorted(p.stem for p in (pages / "stages").glob("*.md")), sorted(stages + ["index"]))
        for page in pages.rglob("*.md"):
            for target in re.findall(r"\]\((?!https?:|#)([^)#]+)", page.read_text()):
                self.assertTrue((page.parent / target).exists(), f"{page.relative_to(pages)} links to {target}")
        self.assertEqual({p.stem for p in (pages / "guides").glob("*.md")}, {p.stem for p in GUIDES})


if __name__ == "__main__":
    unittest.main()
