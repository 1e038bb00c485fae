#!/usr/bin/env python3
"""check_style.py [BUILD]: clang-format over all sources, clang-tidy (.clang-tidy) over src, and over the tests clang's warning
about statements separated by commas, which read as one.

Versions of these tools differ in what they say, so only the ones of Debian 12 judge; elsewhere the script says that it
is skipped. BUILD is a configured build directory (build/release), whose list of compilations is used, rooms together as
it compiles them; files of CGAL and OpenMesh are left out, because clang takes minutes for them, and C."""

import concurrent.futures
import json
import os
import pathlib
import re
import shlex
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
VERSION = "14"
COMMAS = ["-Wno-everything", "-Wcomma"]  # not -w, which silences the second one, too


def tool(name):
    """The path of the tool in Debian 12's version, or None."""
    for candidate in (f"{name}-{VERSION}", name):
        path = shutil.which(candidate)
        if path and re.search(rf"version {VERSION}\.", subprocess.run([path, "--version"], capture_output=True,
                                                                      text=True, check=True).stdout):
            return path
    return None


def unformatted(clang_format):
    files = subprocess.run(["git", "ls-files", "src/*.[ch]pp", "tests/*.[ch]pp", "bench/*.[ch]pp"], cwd=ROOT,
                           capture_output=True, text=True, check=True).stdout.split()
    run = subprocess.run([clang_format, "--dry-run", "-Werror", *files], cwd=ROOT, capture_output=True, text=True)
    return sorted({line.split(":")[0] for line in run.stderr.splitlines() if "error:" in line})


def compilations(build):
    """(directory, arguments for clang, precompiled header, file) of what the build compiles without CGAL and OpenMesh."""
    for entry in json.loads((build / "compile_commands.json").read_text(encoding="utf-8")):
        made = re.search(r" -o (\S+)", entry["command"]).group(1)
        if re.search(r"facetmill_(cgal|hulls|openmesh|oracle)\.dir/|cmake_pch|\.c\.o$", made):
            continue
        words, kept, header = iter(shlex.split(entry["command"])[1:]), [], None
        for word in words:
            if word in ("-o", "-c"):
                next(words)
            elif word == "-include":  # precompiled by another compiler
                text = pathlib.Path(next(words)).read_text(encoding="utf-8")
                header = re.search(r'#include "(.*)"', text).group(1)
            elif word.startswith(("-I", "-D", "-isystem", "-std")):
                kept.append(word)
                if word == "-isystem":
                    kept.append(next(words))
        yield entry["directory"], kept, header, entry["file"]


def precompile(clang, work, folder):
    """Compiles the headers that the compilations begin with, each once: {header: arguments that use it}."""
    made = {None: []}
    for directory, arguments, header, _ in work:
        if header not in made:
            path = str(pathlib.Path(folder) / f"{len(made)}.pch")
            subprocess.run([clang, *arguments, "-w", "-x", "c++-header", header, "-o", path], cwd=directory, check=True)
            made[header] = ["-include-pch", path]
    return made


def judge(clang, clang_tidy, arguments, directory, file):
    """What the tools say about one compilation: clang-tidy of the program, clang alone of tests and benchmarks."""
    if "/tests/" in file or "/bench/" in file:
        command = [clang, *arguments, *COMMAS, "-fsyntax-only", file]
    else:
        command = [clang_tidy, "--quiet", f"--config-file={ROOT}/.clang-tidy", f"--header-filter={ROOT}/src/.*", file,
                   "--", *arguments, *COMMAS]
    run = subprocess.run(command, cwd=directory, capture_output=True, text=True)
    said = run.stdout + run.stderr
    if run.returncode != 0 and " error: " not in said:
        return [f"{file}: {said.strip()}"]
    return [line for line in said.splitlines() if re.search(r": (warning|error): ", line)]


def can_fail(clang, clang_tidy, folder):
    """Whether the tools find what they are there to find: a check that says nothing may have looked at nothing."""
    for room, wanted in (("src", ["comma", "readability-identifier-naming"]), ("tests", ["comma"])):
        file = pathlib.Path(folder) / room / "wrong.cpp"
        file.parent.mkdir()
        file.write_text("int f() { int aB = 1, b = 0; aB = 2, b = 3; return aB + b; }\n", encoding="utf-8")
        said = "\n".join(judge(clang, clang_tidy, ["-std=c++20"], folder, str(file)))
        if not all(word in said for word in wanted):
            return False
    return True


def main():
    build = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else "build/release").resolve()
    clang_format, clang, clang_tidy = tool("clang-format"), tool("clang++"), tool("clang-tidy")
    if not clang_format or not clang or not clang_tidy:
        print(f"style: skipped, clang, clang-format and clang-tidy of version {VERSION} are not all there")
        return 1 if os.environ.get("FACETMILL_REQUIRE_STYLE") == "1" else 0
    found = [f"{name}: not formatted (make format)" for name in unformatted(clang_format)]
    work = list(compilations(build))
    with tempfile.TemporaryDirectory() as folder, concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        if not can_fail(clang, clang_tidy, folder):
            found.append("clang or clang-tidy does not find what is wrong on purpose")
        headers = precompile(clang, work, folder)
        for warnings in pool.map(lambda w: judge(clang, clang_tidy, w[1] + headers[w[2]], w[0], w[3]), work):
            found += warnings
    for problem in sorted(set(found)):
        print(problem)
    print(f"style: {len(set(found))} problems")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
