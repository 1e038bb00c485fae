"""What `facetmill stages` says of every stage is a golden file: a change of an option's name, default or help is seen
in review. tools/update_golden.sh writes them anew."""

import pathlib
import re
import subprocess

from support import SOURCE, Case, main

GOLDEN = SOURCE / "tests/golden/stages"


class Text(Case):
    def test_the_list_and_every_page(self):
        names = [line.split()[0] for line in self.mill("stages").stdout.splitlines()]
        self.assertTrue(names)
        self.assertEqual(sorted(p.stem for p in GOLDEN.glob("*.txt")), names, "run tools/update_golden.sh")
        self.maxDiff = None
        for name in names:
            self.assertEqual(self.mill("stages", name).stdout, (GOLDEN / f"{name}.txt").read_text(),
                             f"{name}: if this is meant, run tools/update_golden.sh")

    def test_help_everywhere(self):
        self.assertIn("Examples", self.mill("--help").stdout)
        for command in ("run", "plan", "pipe", "check", "info", "diff", "stages", "schema", "formats"):
            text = self.mill(command, "--help").stdout
            self.assertIn("Examples", text, command)
            self.assertIn(f"facetmill {command}", text)
            self.assertLessEqual(max(map(len, text.splitlines())), 120, command)
        self.assertTrue(self.mill("pipe", "load", "a.stl", "!", "clip", "--help").stdout.startswith("clip: "))

    def test_the_readme_lists_every_stage(self):
        readme = (SOURCE / "README.md").read_text()
        for line in self.mill("stages").stdout.splitlines():
            self.assertIn(f"| `{line.split()[0]}` |", readme, "the table of stages: facetmill stages --markdown")

    def test_every_warning_is_known(self):
        """A warning that is not in the list could not be made to fail by --strict=ID."""
        used = set()
        for path in (SOURCE / "src").rglob("*.cpp"):
            if path.name != "warnings.cpp":
                used |= set(re.findall(r'"(W-[A-Z0-9-]+)"', path.read_text()))
        table = re.findall(r'\{"(W-[A-Z0-9-]+)"', (SOURCE / "src/report/warnings.cpp").read_text())
        self.assertEqual(table, sorted(used), "src/report/warnings.cpp")
        run = self.mill("run", "quickstart", "-D", "input=a.ply", "--strict=W-UNIT", expect=2)
        self.assertIn("did you mean 'W-UNITS'?", run.stderr)

    def test_manual_pages_are_clean(self):
        mandoc = self.need("mandoc")
        page = self.write("facetmill-stages.7", self.mill("stages", "--man").stdout)
        for path in (page, SOURCE / "man/facetmill.1", SOURCE / "man/facetmill-pipeline.5"):
            run = subprocess.run([mandoc, "-T", "lint", "-W", "warning", str(path)], capture_output=True, text=True)
            self.assertEqual(run.stdout, "", path)


if __name__ == "__main__":
    main()
