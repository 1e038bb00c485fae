"""What `facetmill stages` says of every stage is a golden file: a change of an option's name, default or help is seen
in review. tools/update_golden.sh writes them anew."""

import json
import pathlib
import re
import subprocess
import sys
import tempfile

from support import SOURCE, Case, main

sys.path.insert(0, str(SOURCE / "tools"))
import check_layers  # noqa: E402

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
        for command in ("run", "batch", "export", "plan", "pipe", "new", "check", "info", "diff", "stages", "schema", "formats", "cache", "explain",
                        "docs", "completions"):
            text = self.mill(command, "--help").stdout
            self.assertIn("Examples", text, command)
            self.assertIn(f"facetmill {command}", text)
            self.assertLessEqual(max(map(len, text.splitlines())), 120, command)
        for command, what in (("render", "MESH [MESH] [OPTIONS OF THE STAGE]"), ("pipe", "STAGE ... ! STAGE ..."),
                              ("diff", "A B"), ("info", "MESH...")):
            self.assertRegex(self.mill(command, "--help").stdout, rf"\nUsage: facetmill {command} \[OPTIONS\] {re.escape(what)}")
        self.assertTrue(self.mill("pipe", "load", "a.stl", "!", "clip", "--help").stdout.startswith("clip: "))

    def test_a_new_pipeline_runs_as_it_is(self):
        mesh = SOURCE / "examples/data/nefertiti.ply"
        for options in ([], ["--from", "scan-to-web"]):
            with tempfile.TemporaryDirectory() as folder:
                file = pathlib.Path(folder) / "new.yaml"
                self.mill("new", str(file), *options)
                self.assertEqual(self.mill("new", "-", *options).stdout, file.read_text())
                self.mill("check", str(file))
                self.mill("run", str(file), "-D", f"input={mesh}", "-D", "unit=mm", "-D", "up=z", "--output-dir", folder,
                          "--strict")
                self.assertTrue(list(pathlib.Path(folder).glob("*.glb")))
                file.write_text("mine")
                again = self.mill("new", str(file), *options, expect=2)
                self.assertIn("E-EXISTS", again.stderr)
                self.assertEqual(file.read_text(), "mine")
        self.assertIn("scan-to-web", self.mill("new", "x.yaml", "--from", "scan-to-wep", expect=2).stderr)

    def test_the_docs_list_every_stage(self):
        table = (SOURCE / "docs/stages.md").read_text()
        for line in self.mill("stages").stdout.splitlines():
            self.assertIn(f"| `{line.split()[0]}` |", table, "the table of stages: facetmill stages --markdown")

    def test_every_message_is_known(self):
        """The ids in the source are those that `facetmill explain` knows, with the exit codes that they come with."""
        codes = {"check": 1, "usage": 2, "missing": 3, "output": 4, "stage": 5, "malformed": 6, "limit": 7, "bug": 70}
        known = {m["id"]: m for m in json.loads(self.mill("explain", "--json").stdout)}
        self.assertEqual(list(known), sorted(known))
        used = set()
        for path in (SOURCE / "src").rglob("*.[ch]pp"):
            text = path.read_text()
            if "const RegisterMessages " in text:
                continue
            used |= set(re.findall(r'"([EW]-[A-Z0-9-]+)"', text))
            for kind, message in re.findall(r'\bErrorKind::(\w+),\s*"(E-[A-Z0-9-]+)"', text):
                self.assertIn(codes[kind], known.get(message, {}).get("exit_codes", []), f"{path}: {message}")
            for message in re.findall(r"\b[EW]-[A-Z][A-Z0-9-]*[A-Z]\b", text):
                self.assertIn(message, known, f"{path}: add it to messages.cpp of the folder")
        self.assertEqual(sorted(used), list(known))

    def test_every_message_is_registered_where_it_is_raised(self):
        """In messages.cpp of the room that raises it, or of the lowest layer of these rooms."""
        raised, registered = {}, {}
        for path in (SOURCE / "src").rglob("*.[ch]pp"):
            name, text = path.relative_to(SOURCE).as_posix(), path.read_text()
            rooms = registered if "const RegisterMessages " in text else raised
            if name.startswith("src/docs/"):  # ids in examples
                continue
            for message in re.findall(r'"([EW]-[A-Z0-9-]+)"', re.sub(r"//.*", "", text)):
                rooms.setdefault(message, set()).add(check_layers.home_of(name))
        for message, rooms in raised.items():
            layer = min((room.partition("/")[0] for room in rooms), key=check_layers.LAYERS.index)
            lowest = {room for room in rooms if room.partition("/")[0] == layer}
            self.assertEqual(registered.get(message), lowest if len(lowest) == 1 else {layer}, message)

    def test_explain(self):
        self.assertIn("exit code 2", self.mill("explain", "E-KEY").stdout)
        self.assertIn("--strict=W-UNITS", self.mill("explain", "w-units").stdout)
        self.assertEqual(len(self.mill("explain").stdout.splitlines()),
                         self.mill("explain", "--markdown").stdout.count("\n## "))
        self.assertIn("did you mean 'W-UNITS'?", self.mill("explain", "W-UNIT", expect=2).stderr)
        run = self.mill("run", "quickstart", "-D", "input=a.ply", "--strict=W-UNIT", expect=2)
        self.assertIn("did you mean 'W-UNITS'?", run.stderr)

    def test_docs(self):
        listed = self.mill("docs").stdout
        topics = re.findall(r"^  (\S+)  ", listed, flags=re.M)
        pages = {path.stem: path for path in (SOURCE / "docs").rglob("*.md")}
        self.assertLessEqual(set(pages), set(topics))
        for name, path in pages.items():
            self.assertEqual(self.mill("docs", name).stdout, path.read_text(), name)
        for stage in json.loads(self.mill("stages", "--json").stdout):
            self.assertIn(stage["name"], topics)
        for name in topics:
            self.assertTrue(self.mill("docs", name).stdout, name)
        self.assertEqual(self.mill("docs", "simplify").stdout, self.mill("stages", "simplify").stdout)
        self.assertEqual(self.mill("docs", "Diff").stdout, self.mill("diff", "--help").stdout)
        self.assertEqual(self.mill("docs", "w-units").stdout, self.mill("explain", "W-UNITS").stdout)
        self.assertIn("did you mean 'simplify'?", self.mill("docs", "simplfy", expect=2).stderr)
        for words, choices, hint in ((["schema", "reprot"], "WHAT must be one of pipeline, report, batch, ", "did you mean 'report'?"),
                                     (["schema", "qqqq"], "diff-folders, found 'qqqq'", "see facetmill schema --help"),
                                     (["export", "--to=nin", "p.yaml"], "--to must be one of ninja, make, snakemake, found 'nin'",
                                      "did you mean 'ninja'?")):
            said = self.mill(*words, expect=2).stderr
            self.assertIn(choices, said)
            self.assertTrue(said.endswith("hint: " + hint + "\n"), said)
        for words in (["help", "simplify"], ["simplify", "--help"], ["--help", "simplify"]):
            self.assertEqual(self.mill(*words).stdout, self.mill("stages", "simplify").stdout)
        self.assertEqual(self.mill("help", "run").stdout, self.mill("run", "--help").stdout)
        self.assertEqual(self.mill("help", "checks").stdout, self.mill("docs", "checks").stdout)
        self.assertEqual(self.mill("help").stdout, self.mill("--help").stdout)
        self.assertRegex(self.mill("docs", "draco", expect=2).stderr, r"it occurs in: .*\bscan-to-web\b.*\bwrite\b")
        self.assertIn("facetmill docs lists the topics", self.mill("docs", "xyzzy-12", expect=2).stderr)

    def test_manual_pages_are_clean(self):
        mandoc = self.need("mandoc")
        page = self.write("facetmill-stages.7", self.mill("stages", "--man").stdout)
        messages = self.write("facetmill-messages.7", self.mill("explain", "--man").stdout)
        for path in (page, messages, SOURCE / "man/facetmill.1", SOURCE / "man/facetmill-pipeline.5"):
            run = subprocess.run([mandoc, "-T", "lint", "-W", "warning", str(path)], capture_output=True, text=True)
            self.assertEqual(run.stdout, "", path)


if __name__ == "__main__":
    main()
