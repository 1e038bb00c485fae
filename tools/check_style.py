#!/usr/bin/env python3
"""check_style.py [BUILD]: clang-format over all sources, and clang's warning about statements separated by commas, which
read as one.

Versions of clang-format differ in what they make, so only the one of Debian 12 judges; elsewhere the script says that it
is skipped. BUILD is a configured build directory (build/release), whose list of compilations is used; files of CGAL and
OpenMesh are left out, because clang takes minutes for them."""

import concurrent.futures
import json
import os
import pathlib
import re
import shlex
import shutil
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
VERSION = "14"


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
    """(directory, arguments for clang, file) of what the build compiles without CGAL and OpenMesh."""
    for entry in json.loads((build / "compile_commands.json").read_text(encoding="utf-8")):
        made = re.search(r" -o (\S+)", entry["command"]).group(1)
        if re.search(r"facetmill_(cgal|openmesh|oracle)\.dir/|cmake_pch", made):
            continue
        words, kept = iter(shlex.split(entry["command"])[1:]), []
        for word in words:
            if word in ("-o", "-c"):
                next(words)
            elif word == "-include":  # a header precompiled by another compiler; its text will do
                header = pathlib.Path(next(words)).read_text(encoding="utf-8")
                kept += ["-include", re.search(r'#include "(.*)"', header).group(1)]
            elif word.startswith(("-I", "-D", "-isystem", "-std")):
                kept.append(word)
                if word == "-isystem":
                    kept.append(next(words))
        yield entry["directory"], kept, entry["file"]


def commas(clang, work):
    directory, arguments, file = work
    run = subprocess.run([clang, *arguments, "-w", "-Wcomma", "-fsyntax-only", file], cwd=directory,
                         capture_output=True, text=True)
    if run.returncode != 0:
        return [f"{file}: {run.stderr.strip()}"]
    return [line for line in run.stderr.splitlines() if "-Wcomma" in line]


def main():
    build = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else "build/release").resolve()
    clang_format, clang = tool("clang-format"), tool("clang++")
    if not clang_format or not clang:
        print(f"style: skipped, clang and clang-format of version {VERSION} are missing")
        return 1 if os.environ.get("FACETMILL_REQUIRE_STYLE") == "1" else 0
    found = [f"{name}: not formatted (make format)" for name in unformatted(clang_format)]
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        for warnings in pool.map(lambda work: commas(clang, work), compilations(build)):
            found += warnings
    for problem in sorted(set(found)):
        print(problem)
    print(f"style: {len(set(found))} problems")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
