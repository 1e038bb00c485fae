"""The JSON Schemas, as editors and strict validators read them; and what shells complete."""

import json
import os
import subprocess
import unittest
from xml.etree import ElementTree

from support import SOURCE, Case, main

try:
    import jsonschema
    import yaml
except ImportError:
    jsonschema = None


@unittest.skipIf(jsonschema is None, "python3-jsonschema or python3-yaml is missing")
class Schema(Case):
    def setUp(self):
        super().setUp()
        self.schema = json.loads(self.mill("schema").stdout)
        self.validator = jsonschema.Draft202012Validator(self.schema)

    def accepts(self, stages):
        return not list(self.validator.iter_errors({"facetmill": 1, "stages": [{"load": "a.ply"}, *yaml.safe_load(stages)]}))

    def test_what_check_refuses_without_a_mesh_is_refused(self):
        for stages in ("[simplify: 1]", "[simplify: {}]", "[simplify: {rato: 10%}]", "[simplify: {faces: 20k}]", "[simplify: {faces: 0}]",
                       "[clip: {plane: z=0, box: [0, 0, 0, 1, 1, 1]}]", "[clip: {cap: true}]", "[clip: {normal: [0, 0, 1]}]", "[clip]",
                       "[{clip: z=0, relax: 3}]", "[render: {path: a.png, view: front, from: [1, 1, 1]}]", "[{name: x}]",
                       "[write: {path: a.glb, draco: 'yes'}]"):
            self.assertFalse(self.accepts(stages), stages)
            self.write("p.yaml", f"facetmill: 1\nstages: [load: a.ply, {stages[1:]}\n")
            self.mill("check", "p.yaml", expect=2)

    def test_what_check_accepts_is_accepted(self):
        for stages in ("[simplify: 10%]", "[simplify: {ratio: 0.5, max_error: 1%}]", "[clip: z=0]", "[clip: {plane: {normal: [0, 0, 1]}}]",
                       "[relax]", "[{relax: 3, name: smooth, only: [a], when: {closed: true}, ensure: {closed: true}}]", "[validate]",
                       "[{ensure: {closed: true}}]", "[{foreach: {lod: [50%, 25%]}, do: [{simplify: '${lod}'}]}]",
                       "[branch: {a: [{write: a.glb}], b: [relax]}]", "[write: {path: a.glb, draco: true}]"):
            self.assertTrue(self.accepts(stages), stages)
            self.write("p.yaml", f"facetmill: 1\nstages: [load: a.ply, {stages[1:]}\n")
            self.mill("check", "p.yaml")

    def test_an_include_is_accepted(self):
        self.write("a.yaml", "facetmill: 1\nparams: {keep: ratio}\nstages: [{simplify: '${keep}'}]\n")
        for stages, right in (("[{include: a.yaml, with: {keep: 10%}}]", True), ("[{include: 1}]", False),
                              ("[{include: a.yaml, with: {keep: 10%}, when: true}]", False)):
            self.assertEqual(self.accepts(stages), right, stages)
            self.write("p.yaml", f"facetmill: 1\nstages: [load: a.ply, {stages[1:]}\n")
            self.mill("check", "p.yaml", expect=0 if right else 3 if "include: 1" in stages else 2)

    def test_ready_pipelines_and_examples_follow_it(self):
        for path in (*SOURCE.glob("pipelines/*.yaml"), *SOURCE.glob("examples/**/*.yaml")):
            if path.name == "dvc.yaml":
                continue  # a file of DVC
            self.assertEqual(list(self.validator.iter_errors(yaml.safe_load(path.read_text()))), [], path)

    def test_strict_validators_take_all_of_them(self):
        """As ajv in its strict mode: known keywords only, one type a form, only names that are declared are required."""
        known = {"$schema", "$ref", "$defs", "title", "description", "default", "type", "enum", "const", "anyOf", "oneOf", "allOf", "if",
                 "then", "properties", "required", "additionalProperties", "patternProperties", "dependentSchemas", "minProperties",
                 "items", "minItems", "maxItems", "minLength", "pattern", "minimum", "maximum", "exclusiveMinimum", "exclusiveMaximum"}

        def walk(schema, names):
            if not isinstance(schema, dict):
                return
            self.assertLessEqual(set(schema), known)
            self.assertNotIsInstance(schema.get("type"), list, schema)
            names = names | set(schema.get("properties", {}))
            self.assertLessEqual(set(schema.get("required", [])), set(schema.get("properties", {})), schema)
            for key in ("properties", "$defs", "dependentSchemas", "patternProperties"):
                for one in schema.get(key, {}).values():
                    walk(one, names)
            for key in ("items", "additionalProperties", "if", "then"):
                walk(schema.get(key), names)
            for key in ("anyOf", "oneOf", "allOf"):
                for one in schema.get(key, []):
                    walk(one, names)

        for what in ("pipeline", "report", "batch", "timings", "info", "diff"):
            schema = json.loads(self.mill("schema", what).stdout)
            jsonschema.Draft202012Validator.check_schema(schema)
            walk(schema, set())

    def test_every_step_has_a_title(self):
        titles = [form["title"] for form in self.schema["$defs"]["step"]["anyOf"]]
        self.assertEqual(len(titles), len(set(titles)))
        self.assertIn("simplify", titles)


class Completions(Case):
    """What is offered for the last word of a line, whose other words stand before it."""

    def candidates(self, shell, line):
        words = line.split(" ")
        if shell == "fish":
            run = subprocess.run(["fish", "--no-config", "-c", "source script; complete -C $argv[1]", line], cwd=self.dir,
                                 capture_output=True, text=True, timeout=60, env={**os.environ, "HOME": str(self.dir)})
        elif shell == "bash":
            run = subprocess.run(["bash", "--norc", "-c", 'source ./script; COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); _facetmill; '
                                  'printf "%s\\n" "${COMPREPLY[@]}"', "bash", *words], cwd=self.dir, capture_output=True, text=True, timeout=60)
        else:
            run = subprocess.run(["zsh", "-f", "-c", 'compdef() { : }; source ./script; _facetmill_candidates "$@"', "zsh", words[-1],
                                  *words[1:-1]], cwd=self.dir, capture_output=True, text=True, timeout=60)
        self.assertEqual(run.stderr, "")
        found = [line.split("\t")[0] for line in run.stdout.splitlines()]
        return [word for word in found if word.startswith(words[-1])]

    def check_shell(self, shell):
        self.need(shell)
        (self.dir / "script").write_text(self.mill("completions", shell).stdout)
        self.assertEqual(self.candidates(shell, "facetmill sch"), ["schema"])
        self.assertEqual(self.candidates(shell, "facetmill run --dep"), ["--depfile", "--depfile-target"])
        self.assertIn("quickstart", self.candidates(shell, "facetmill run qui"))
        self.assertEqual(self.candidates(shell, "facetmill schema p"), ["pipeline"])
        self.assertLessEqual({"text", "json"}, set(self.candidates(shell, "facetmill run --log ")))
        self.assertEqual(self.candidates(shell, "facetmill pipe load a.ply ! simp"), ["simplify"])
        self.assertEqual(self.candidates(shell, "facetmill pipe load a.ply ! simplify --max"),
                         ["--max_error", "--max_quadric_error"])
        self.assertIn("quadric", self.candidates(shell, "facetmill pipe load a.ply ! simplify --method q"))
        self.assertIn("--plane.normal", self.candidates(shell, "facetmill pipe load a.ply + clip --plane"))
        self.assertIn("--ensure.closed", self.candidates(shell, "facetmill pipe load a.ply ! relax 3 --ensure.clos"))
        self.assertIn("relax", self.candidates(shell, "facetmill pipe load a ! foreach n=1,2 [ rel"))
        self.assertIn("--report", self.candidates(shell, "facetmill pipe --rep"))
        self.assertIn("load", self.candidates(shell, "facetmill pipe -j 2 lo"))
        self.assertIn("W-UNITS", self.candidates(shell, "facetmill explain W-UN"))
        self.assertEqual(self.candidates(shell, "facetmill new a.yaml --from scan-to-w"), ["scan-to-web"])
        self.assertIn("quickstart", self.candidates(shell, "facetmill export qui"))
        self.assertIn("W-UNITS", self.candidates(shell, "facetmill run --allow W-UN"))
        (self.dir / "quick one.yaml").touch()
        beside = {"bash": ["quickstart", "quick one.yaml"], "zsh": ["quickstart"], "fish": ["quick one.yaml", "quickstart"]}
        self.assertEqual(self.candidates(shell, "facetmill run quick"), beside[shell])
        self.assertNotIn("script", self.candidates(shell, "facetmill cache "))
        for stage in json.loads(self.mill("stages", "--json").stdout):
            name = stage["name"]
            offered = self.candidates(shell, f"facetmill pipe load a ! {name} --")
            for option in stage["options"]:
                self.assertIn("--" + option["name"], offered, name)

    def test_bash(self):
        self.check_shell("bash")

    def test_zsh(self):
        self.check_shell("zsh")

    def test_fish(self):
        self.check_shell("fish")


class JUnit(Case):
    """The rules that build servers hold JUnit files to: those of the schema junit-10.xsd of Jenkins' xUnit plugin, and what
    Jenkins, GitLab and GitHub rely on beside them (counts that agree, names that are unique)."""

    ATTRIBUTES = {  # of each element: those that it needs, and others that it may have
        "testsuites": (set(), {"name", "time", "tests", "failures", "errors"}),
        "testsuite": ({"name", "tests", "failures", "errors"}, {"group", "time", "skipped", "timestamp", "hostname", "id", "package",
                                                               "file", "log", "url"}),
        "testcase": ({"name"}, {"time", "classname", "group"}),
        "failure": (set(), {"type", "message"}), "error": (set(), {"type", "message"}), "skipped": (set(), {"type", "message"}),
        "system-out": (set(), set()), "system-err": (set(), set())}
    CHILDREN = {"testsuites": {"testsuite"}, "testsuite": {"testcase", "properties", "system-out", "system-err"},
                "testcase": {"skipped", "error", "failure", "system-out", "system-err"}}
    OPEN = "OFF\n4 3 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n"

    def holds(self, element):
        needed, allowed = self.ATTRIBUTES[element.tag]
        self.assertLessEqual(needed, set(element.attrib), element.tag)
        self.assertLessEqual(set(element.attrib), needed | allowed, element.tag)
        self.assertLessEqual({child.tag for child in element}, self.CHILDREN.get(element.tag, set()), element.tag)
        if element.tag in self.CHILDREN:  # no text between elements
            for text in (element.text, *(child.tail for child in element)):
                self.assertEqual((text or "").strip(), "")
        for child in element:
            self.holds(child)

    def follows(self, name):
        """The cases of a report, by class and name: what became of each."""
        root = ElementTree.parse(self.dir / name).getroot()
        self.assertEqual(root.tag, "testsuites")
        self.holds(root)
        suite, = root
        cases = {}
        for case in suite:
            key = case.get("classname"), case.get("name")
            self.assertNotIn(key, cases)
            kinds = [child.tag for child in case if child.tag in ("failure", "error", "skipped")]
            self.assertLessEqual(len(kinds), 1)
            cases[key] = kinds[0] if kinds else case[0].tag if len(case) else "passed"
        self.assertEqual(int(suite.get("tests")), len(cases))
        for attribute, kind in (("failures", "failure"), ("errors", "error"), ("skipped", "skipped")):
            self.assertEqual(int(suite.get(attribute, 0)), list(cases.values()).count(kind), attribute)
        return cases

    def test_runs(self):
        name = 'a<script>&"\x01'
        self.write("t.off", self.OPEN)
        self.write("s.obj", f"o {name}\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
        self.mill("pipe", "--report", "ok.xml", "load", "t.off", "!", "write", "t.ply")
        self.assertEqual(self.follows("ok.xml"), {("run", "done"): "passed"})
        self.mill("pipe", "--report", "checks.xml", "load", "s.obj", "!", "validate", "--closed", "--edges", "3", "--per", "part", "!",
                  "validate", "--closed", "--severity", "warn", expect=1)
        cases = self.follows("checks.xml")
        self.assertEqual(sorted(cases.values()), ["failure", "passed", "system-out"])
        self.assertTrue(any("a<script>&\"" in case for _, case in cases), cases)
        self.mill("pipe", "--report", "error.xml", "load", "t.off", "!", "simplify", "--method", "quadric", "--faces", "1", "!",
                  "thicken", "1", "!", "combine", "union", "!", "write", "t.ply", expect=None)
        self.follows("error.xml")
        self.write("bad.off", "OFF\nbroken")
        self.mill("pipe", "--report", "bad.xml", "load", "bad.off", "!", "write", "t.ply", expect=6)
        self.assertEqual(list(self.follows("bad.xml").values()), ["error"])
        self.write("p.yaml", "facetmill: 1\nstages: [{load: t.off}, {validate: {closed: true, baseline: k.json}}]\n"
                             "report: known.xml\n")
        self.mill("run", "p.yaml", "--update-baseline")
        self.mill("run", "p.yaml")
        self.assertEqual(list(self.follows("known.xml").values()), ["system-out"])

    def test_batches(self):
        self.write("in/t.off", self.OPEN)
        self.write("in/bad.off", "OFF\nbroken")
        self.write("in/u.off", self.OPEN.replace("4 3 0", "4 4 0") + "3 0 2 1\n")
        self.write("p.yaml", "facetmill: 1\nparams: {input: path}\n"
                             "stages: [{load: '${input}'}, {validate: {closed: true}}, {write: '${input.stem}.ply'}]\n")
        self.mill("batch", "p.yaml", "--input", "in/*.off", "-o", "out", "--keep-going", "--report", "all.xml", expect=None)
        self.assertEqual(self.follows("out/all.xml"), {("asset", "in/t.off"): "failure", ("asset", "in/bad.off"): "error",
                                                   ("asset", "in/u.off"): "passed"})


if __name__ == "__main__":
    main()
