#!/usr/bin/env python3
"""CONTRIBUTING.md and docs/architecture.md keep true: what they name exists, and the walks compile."""

import json
import os
import pathlib
import re
import shlex
import subprocess
import unittest

import support

PAGES = ["CONTRIBUTING.md", "docs/architecture.md", "SECURITY.md", "README.md", "docs/pipelines.md"]
BUILD = pathlib.Path(os.environ.get("FACETMILL_BUILD", support.FACETMILL.parent))


def page(name):
    return (support.SOURCE / name).read_text(encoding="utf-8")


def walks():
    """(path, anchor or None, code) of each block that a sentence assigns to a file. An anchor is the text before
    which the code goes; without one the file is new."""
    found, path = [], None
    text = page("CONTRIBUTING.md")
    for match in re.finditer(r"```cpp\n(.*?)```", text, re.S):
        before = " ".join(text[:match.start()].split("```")[-1].split())
        named = re.findall(r"`((?:src|tests)/[\w/.-]+\.[ch]pp)`", before)
        anchor = re.search(r"before `([^`]+)`:$", " ".join(text[:match.start()].rstrip().split("\n")[-1:]))
        path = named[-1] if named else path
        found.append((path, anchor.group(1) if anchor else None, match.group(1)))
    return found


class Named(unittest.TestCase):
    def test_every_file_named_exists(self):
        new = {path for path, anchor, _ in walks() if anchor is None}
        pattern = r"(?:src|tests|tools|cmake|docs|examples|pipelines|bench|man)/[\w/.-]*\w|\.ci/run"
        for name in PAGES:
            for path in re.findall(rf"[`(]({pattern})/?[`)]", page(name)):
                if path not in new:
                    self.assertTrue((support.SOURCE / path).exists(), f"{name} names {path}")

    def test_every_target_of_make_exists(self):
        makefile = page("Makefile")
        for name in PAGES:
            for target in re.findall(r"(?:^|`)make ([a-z][\w-]*)", page(name), re.M):
                self.assertRegex(makefile, rf"(?m)^{re.escape(target)}:", f"{name}: make {target}")

    def test_every_preset_exists(self):
        presets = json.loads(page("CMakePresets.json"))
        known = {p["name"] for p in presets["configurePresets"]} & {p["name"] for p in presets["buildPresets"]}
        for name in re.findall(r"(?:--preset |PRESET=)(\w+)", page("CONTRIBUTING.md") + page("README.md")):
            self.assertIn(name, known)

    def test_every_selection_of_tests_selects_some(self):
        for arguments in re.findall(r"^ctest (-[RL] \w+)", page("CONTRIBUTING.md"), re.M):
            listed = subprocess.run(["ctest", "-N", *arguments.split()], cwd=BUILD, capture_output=True, text=True,
                                    check=True).stdout
            self.assertNotRegex(listed, r"Total Tests: 0\b", arguments)

    def test_every_command_of_facetmill_exists(self):
        commands = subprocess.run([str(support.FACETMILL), "--help"], capture_output=True, text=True, check=True).stdout
        for name in PAGES:
            for command in re.findall(r"`facetmill ([a-z]+)", page(name)):
                self.assertRegex(commands, rf"(?m)^\s+{command}\b", f"{name}: facetmill {command}")

    def test_the_figure_has_every_room(self):
        figure = re.search(r"```text\n(.*?)```", page("docs/architecture.md"), re.S).group(1)
        rooms = {p.name for p in (support.SOURCE / "src").iterdir() if p.is_dir()}
        for room in sorted(rooms):
            self.assertIn(f" {room}/ ", figure)
        for parent in ("stages", "geometry", "io"):
            for room in sorted(p.name for p in (support.SOURCE / "src" / parent).iterdir() if p.is_dir()):
                self.assertRegex(figure, rf"(?<![\w-]){re.escape(room)}(?![\w-])", f"the figure lacks {parent}/{room}")


class Walks(support.Case):
    def test_there_are_the_promised_walks(self):
        paths = [path for path, _, _ in walks()]
        for start in ("src/stages/merge/", "src/stages/drop/", "tests/stages/", "src/io/", "src/geometry/inspect/", "src/batch/"):
            self.assertTrue(any(path.startswith(start) for path in paths), start)

    def flags(self, like):
        """How the build compiles such a file, without the file, the output and the precompiled header."""
        commands = json.loads((BUILD / "compile_commands.json").read_text(encoding="utf-8"))
        entry = next(c for c in commands if re.search(like, c["command"]))
        words, kept = iter(shlex.split(entry["command"])[1:]), []
        for word in words:
            if word in ("-o", "-c", "-include"):
                next(words)
            elif not word.endswith((".cpp", ".cxx", ".o")):
                kept.append(word)
        compiler = next(w for w in shlex.split(entry["command"]) if re.search(r"(c|g|clang)\+\+", w))
        return entry["directory"], compiler, [w for w in kept if w != compiler and "ccache" not in w]

    def test_every_walk_compiles(self):
        # Without a warning, as in CI, whatever this build allows.
        texts = {}
        for path, anchor, code in walks():
            if anchor is None:
                self.assertFalse((support.SOURCE / path).exists(), f"{path} is there already")
                texts[path] = code
            else:
                text = texts.get(path) or page(path)
                self.assertEqual(text.count(anchor), 1, f"{path} has '{anchor}' once")
                texts[path] = text.replace(anchor, code + anchor)
        for path, text in texts.items():
            self.write(path, text)
        for path in texts:
            if not path.endswith(".cpp"):
                continue
            is_test = path.startswith("tests/")
            directory, compiler, flags = self.flags("facetmill_tests.dir" if is_test else r"facetmill_(core|program)\.dir")
            run = subprocess.run([compiler, "-I", str(self.dir / "src"), *flags, "-O0", "-Werror", "-fsyntax-only",
                                  str(self.dir / path)], cwd=directory, capture_output=True, text=True, timeout=600)
            self.assertEqual(run.returncode, 0, f"{path}\n{run.stderr}")


if __name__ == "__main__":
    support.main()
