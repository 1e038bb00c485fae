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

    @unittest.skipIf(SLOW, "the same commands on the same scan, ten times slower")
    def test_the_one_liners_of_the_readme_run(self):
        readme = (SOURCE / "README.md").read_text()
        block = re.search(r"## In one line\n\n```sh\n(.*?)^```", readme, flags=re.M | re.S)[1]
        shutil.copy(SCAN, self.dir / "scan.ply")
        self.mill("pipe", "-q", "load", "scan.ply", "!", "write", "part.stl")
        (self.dir / "bin").mkdir()
        (self.dir / "bin/facetmill").symlink_to(FACETMILL)
        self.assertEqual(len(block.splitlines()), 8)
        for line in block.splitlines():
            command, _, says = line.partition("  #")
            if not shutil.which("jq"):
                command = command.partition(" | jq")[0]
            with self.subTest(command=command):
                run = subprocess.run(command, shell=True, cwd=self.dir, capture_output=True, text=True, timeout=600,
                                     env={**os.environ, "PATH": f"{self.dir / 'bin'}:{os.environ['PATH']}", "DISPLAY": "",
                                          "WAYLAND_DISPLAY": "", "BROWSER": ""})
                self.assertIn(run.returncode, (0, 1) if "exit code" in says else (0,), run.stderr)
                self.assertNotIn("error[E-", run.stderr.replace("error[E-CHECK", ""))
        for made in ("web.glb", "changes.html", "part.png", "part.glb", "part.html", "part.repaired.stl"):
            self.assertTrue((self.dir / made).stat().st_size > 1000, made)

    def test_the_pipeline_of_the_docs_runs(self):
        page = (SOURCE / "docs/pipelines.md").read_text()
        (self.dir / "scan.yaml").write_text(re.search(r"^```yaml\n(.*?)^```", page, flags=re.M | re.S)[1])
        self.mill("check", "scan.yaml")
        self.mill("run", "scan.yaml", "-q", "-D", f"input={SCAN}", "--output-dir", "out")
        for made in ("nefertiti.0.glb", "nefertiti.1.glb", "nefertiti.html", "nefertiti.json"):
            self.assertTrue((self.dir / "out" / made).stat().st_size > 1000, made)

    @unittest.skipIf(SLOW, "pictures of the same scenes, ten times slower")
    def test_the_stored_pictures_are_what_the_command_makes(self):
        """One of them, byte for byte; the others are as deterministic."""
        subprocess.run([sys.executable, SOURCE / "tools/pictures.py", self.dir, "--mill", FACETMILL, "--only", "marked"],
                       check=True, timeout=600)
        self.assertEqual((self.dir / "marked.png").read_bytes(), (SOURCE / "docs/figures/marked.png").read_bytes(),
                         "make pictures, and look at them")

    def test_one_command_makes_all_pictures(self):
        """Each picture that a page of the manual shows is stored by tools/pictures.py or made with the site, and `make
        pictures` runs both."""
        sys.path.insert(0, str(SOURCE / "tools"))
        import pictures
        made = {f"docs/figures/{name}.png" for name in pictures.FIGURES}
        made |= {f"docs/figures/{name}" for name in [*pictures.SECTIONS.values(), pictures.PAGE]}
        shown = set()
        for page in [*SOURCE.glob("*.md"), *(SOURCE / "docs").rglob("*.md")]:
            for target in re.findall(r"!\[[^\]]*\]\(([^)]+)\)", page.read_text()):
                shown.add((page.parent / target).resolve().relative_to(SOURCE).as_posix())
        self.assertEqual(shown, made)
        self.assertEqual({f"docs/figures/{path.name}" for path in (SOURCE / "docs/figures").iterdir()}, made)
        rule = re.search(r"^pictures: build\n((?:\t.*\n)+)", (SOURCE / "Makefile").read_text(), flags=re.M)[1]
        self.assertIn("tools/pictures.py", rule)
        self.assertRegex(rule, r"\$\(MAKE\).* site\n")

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
        gallery = (pages / "gallery.md").read_text()
        for picture in (pages / "stages").glob("*.png"):
            self.assertIn(f"](stages/{picture.name})", gallery)
        self.assertEqual({p.stem for p in (pages / "guides").glob("*.md")}, {p.stem for p in GUIDES})


if __name__ == "__main__":
    unittest.main()
