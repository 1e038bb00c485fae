#!/usr/bin/env python3
"""Makes calls of the system fail, one in each run of facetmill, and judges what is left.

    faults.py [--scenarios NAME...] [--classes CLASS...] [--points N] [--kill | --stages]

Each scenario runs once to count its calls; then once for each call that fails (at most --points a class, evenly spread).
What must hold: no crash, no hang; an exit code that fits; a message that names the file; outputs all new or all as they
were; inputs untouched; no temporary left; and the next run without faults succeeds and leaves exactly what a run in a
fresh folder leaves. With --kill the process is killed just before each call instead; between the renames that give
several outputs their names, some may be new then and the others old. FACETMILL and FACETMILL_INJECTOR
name the executable and the shared library of inject.c.
"""

import argparse
import collections
import errno
import fnmatch
import functools
import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import tempfile

import scenarios

SOURCE = pathlib.Path(__file__).resolve().parents[2]
FACETMILL = os.environ.get("FACETMILL", str(SOURCE / "build/release/facetmill"))
INJECTOR = os.environ.get("FACETMILL_INJECTOR", str(SOURCE / "build/release/tests/libfacetmill_inject.so"))

# Of each class: the errors that it fails with, and the exit codes that may follow. 0 is right where a call was not
# needed (a hint of the system, the cache, a close of what was read); the outputs then are those of a good run. What is
# read again after it was written fails with 4. Where the folder of a document cannot be looked into, what it names is
# not known to be inside: a buffer is refused (6), a texture is left out with a warning.
ERRORS = {
    "open": (errno.EMFILE, errno.EACCES), "read": (errno.EIO,), "write": (errno.ENOSPC, errno.EIO),
    "sync": (errno.EIO,), "rename": (errno.EIO,), "link": (errno.EMLINK,), "unlink": (errno.EROFS,),
    "mkdir": (errno.ENOSPC,), "stat": (errno.EIO,), "mmap": (errno.ENOMEM,), "close": (errno.EIO,),
    "malloc": (errno.ENOMEM,)}
CODES = {"open": {0, 3, 4}, "read": {0, 3, 4}, "write": {0, 4}, "sync": {0, 4}, "rename": {0, 4}, "link": {0, 4},
         "unlink": {0}, "mkdir": {0, 4}, "stat": {0, 3, 4, 6}, "mmap": {0, 3, 7}, "close": {0, 4}, "malloc": {0, 7}}
TEMPORARY = re.compile(r"^\.(?P<of>.*)\.facetmill-\d+(-\d+)?~$")
TIMEOUT = 120


def environment(cache="off", **more):
    """What a run sees: nothing that would change facetmill but what is given."""
    plain = {k: v for k, v in os.environ.items() if not k.startswith("FACETMILL_") and k != "CI"}
    return {**plain, "FACETMILL_CACHE": cache, **more}


def matches(name, patterns):
    return any(fnmatch.fnmatch(name, pattern) for pattern in patterns)


class Trial:
    """A scenario with what a good run of it leaves."""

    def __init__(self, scenario, room):
        self.scenario = scenario
        self.room = pathlib.Path(room)
        self.base = self.room / "base"
        self.base.mkdir(parents=True)
        for name, content in scenario.files.items():
            path = self.base / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_bytes(content if isinstance(content, bytes) else content.encode())
        for command in scenario.before:
            self.must_run(self.base, command)
        self.old = self.files(self.base)
        good = self.fresh()
        self.must_run(good, scenario.command)
        self.new = self.files(good)
        again = self.fresh("again")
        self.must_run(again, scenario.command)
        self.must_run(again, scenario.command)
        assert self.lasting(self.files(again)) == self.lasting(self.new), f"{scenario.name}: not the same twice"

    def fresh(self, name="work"):
        folder = self.room / name
        shutil.rmtree(folder, ignore_errors=True)
        shutil.copytree(self.base, folder)
        return folder

    def run(self, folder, command, fault=None):
        log = self.room / "log"
        log.unlink(missing_ok=True)
        injected = dict(LD_PRELOAD=INJECTOR, FACETMILL_FAULT=fault, FACETMILL_FAULT_LOG=str(log)) if fault else {}
        seen = environment("cache" if matches("cache/x", self.scenario.state) else "off", **injected)
        try:
            done = subprocess.run([FACETMILL, *command], cwd=folder, env=seen, timeout=TIMEOUT,
                                  input=self.scenario.stdin or b"", capture_output=True)
        except subprocess.TimeoutExpired:
            return None, "", []
        lines = [line.split(" ", 3) for line in log.read_text(errors="replace").splitlines()] if log.exists() else []
        return done.returncode, done.stderr.decode(errors="replace"), lines

    def must_run(self, folder, command):
        code, said, _ = self.run(folder, command)
        if code != 0:
            raise RuntimeError(f"{self.scenario.name}: {' '.join(command)} ends with {code}\n{said}")

    @staticmethod
    def files(folder):
        return {p.relative_to(folder).as_posix(): p.read_bytes() for p in sorted(folder.rglob("*")) if p.is_file()}

    def lasting(self, files):
        return {name: data for name, data in files.items() if not matches(name, self.scenario.state)}

    def count(self):
        _, _, lines = self.run(self.fresh(), self.scenario.command, "any 0 0")
        return {line[0]: int(line[1]) for line in lines}

    def calls(self, name):
        """What the calls of a class in a good run are about, in their order."""
        _, _, lines = self.run(self.fresh(), self.scenario.command, f"{name} -1 0")
        return [line[3] for line in lines if line[0] == name and line[2]]

    def trace(self, *options):
        """All calls of a good run but those for memory, in their order: (name, absolute path)."""
        folder = self.fresh()
        code, said, lines = self.run(folder, [*self.scenario.command, *options], "any -1 0")
        assert code == 0, said
        return [(line[2], os.path.normpath(folder / line[3])) for line in lines if line[2]]

    @functools.cached_property
    def naming(self):
        """The numbers of the calls after the first of the renames that give outputs their names, up to the last one."""
        outputs = {os.path.normpath(self.room / "work" / name) for group in self.scenario.groups for name in group}
        renames = [n for n, (call, path) in enumerate(self.trace(), 1)
                   if call.startswith("rename") and path in outputs]
        return range(renames[0] + 1, renames[-1] + 1) if renames else range(0)

    def group_problems(self, there, singly=False):
        """singly: each file may be old or new."""
        groups = self.scenario.groups
        for group in ([name] for names in groups for name in names) if singly else groups:
            is_old = all(there.get(name) == self.old.get(name) for name in group)
            is_new = all(there.get(name) == self.new.get(name) for name in group)
            if not (is_old or is_new):
                yield f"neither old nor new: {', '.join(group)}"

    def left_problems(self, there, killed):
        outputs = {name for group in self.scenario.groups for name in group} | set(self.scenario.reports)
        for name in {**self.old, **there}:
            if name in outputs or matches(name, self.scenario.state):
                continue
            temporary = TEMPORARY.match(name.rsplit("/", 1)[-1])
            if name not in self.old and not (killed and temporary):
                yield f"left: {name}"
            elif name in self.old and there.get(name) != self.old[name]:
                yield f"changed: {name}"
        if not killed:
            for name in there:
                if name.endswith(".part"):
                    yield f"left: {name}"

    def message_problems(self, code, said, failed):
        if code == 0 or failed[0] in ("malloc", "stat", "mmap"):  # a folder above the file may be what failed
            if code != 0 and "error[" not in said:
                yield "no message"
            return
        path = failed[3] if len(failed) > 3 else ""
        name = pathlib.Path(path).name
        temporary = TEMPORARY.match(name)
        name = temporary["of"] if temporary else name
        name = {"0": "standard input"}.get(name, name)
        if path.startswith("pipe:"):
            name = "standard"
        if "error[" not in said or name not in said:
            yield f"the message does not name {name}"

    def judge(self, fault, expect_kill=False):
        """What is wrong after a run with that fault, and the call that failed."""
        naming = self.naming if expect_kill else ()  # before the folder is made, since it takes a run
        folder = self.fresh()
        code, said, lines = self.run(folder, self.scenario.command, fault)
        failed = lines[0] if lines else None
        problems = []
        if code is None:
            return ["hangs"], failed
        there = self.files(folder)
        if failed is None or failed[2] == "":
            return [], None  # the run did not come to that call
        killed = code == -signal.SIGKILL
        codes = {-signal.SIGKILL} if expect_kill else CODES[failed[0]]
        if code not in codes:
            problems.append(f"exit code {code}")
        told_loss = code == 0 and failed[0] == "stat" and "warning[W-IMAGE]" in said
        if not told_loss:
            problems += self.group_problems(there, killed and int(fault.split()[1]) in naming)
        if failed[0] != "unlink" or expect_kill:
            problems += self.left_problems(there, killed)
        if not expect_kill:
            problems += self.message_problems(code, said, failed)
        if code == 0 and self.lasting(there) != self.lasting(self.new) and failed[0] != "unlink" and not told_loss:
            problems.append("exit code 0, but not what a good run leaves")
        problems += self.next_run_problems(folder)
        if problems and not expect_kill:
            problems.append("said: " + said.strip().replace("\n", " | ")[-400:])
        return problems, failed

    def next_run_problems(self, folder):
        code, said, _ = self.run(folder, self.scenario.command)
        if code != 0:
            return [f"the next run ends with {code}: {said.strip()[-200:]}"]
        there, wanted = self.lasting(self.files(folder)), self.lasting(self.new)
        return [f"after the next run: {name}" for name in sorted({**there, **wanted})
                if there.get(name) != wanted.get(name)]


def spread(count, points):
    """Numbers of calls, all or evenly spread."""
    if points <= 0 or count <= points:
        return list(range(1, count + 1))
    return sorted({1 + i * (count - 1) // (points - 1) for i in range(points)} if points > 1 else {count // 2 + 1})


def run_stages(points, tell=lambda text: None):
    """Memory ends at `points` places in runs of all stages; those of starting, which all share, are taken once."""
    runs, findings = collections.Counter(), []
    all_of_them = list(scenarios.stage_scenarios())
    start = 0
    for scenario in all_of_them:
        with tempfile.TemporaryDirectory(prefix="facetmill-faults-") as room:
            trial = Trial(scenario, room)
            count = trial.count()["malloc"]
            first = 1 if start == 0 else min(start, count) * 9 // 10
            start = start or count
            share = max(2, -(-points // len(all_of_them)))
            for n in sorted({first + i * (count - first) // (share - 1) for i in range(share)}):
                problems, failed = trial.judge(f"malloc {n} {errno.ENOMEM}")
                runs["malloc"] += failed is not None
                if problems:
                    findings.append(f"{scenario.name}: malloc {n}: " + "; ".join(problems))
                    tell(findings[-1])
        tell(f"{scenario.name}: {count} requests, {len(findings)} findings so far")
    return runs, findings


def run(chosen=None, classes=None, points=0, malloc_points=100, kill=False, tell=lambda text: None):
    """Returns how many runs had a fault, by class, and the findings as text."""
    runs, findings = collections.Counter(), []
    for scenario in scenarios.scenarios():
        if chosen and scenario.name not in chosen:
            continue
        with tempfile.TemporaryDirectory(prefix="facetmill-faults-") as room:
            trial = Trial(scenario, room)
            counts = trial.count()
            tell(f"{scenario.name}: {', '.join(f'{k} {v}' for k, v in counts.items() if v)}")
            if not counts:
                raise RuntimeError(f"{INJECTOR} is not loaded")
            faults = [f"any {n} -9" for n in spread(counts["any"], points)] if kill else [
                f"{name} {n} {error}" for name, errors in ERRORS.items() if not classes or name in classes
                for error in errors
                for n in spread(counts[name], malloc_points if name == "malloc" else points)]
            for fault in faults:
                problems, failed = trial.judge(fault, kill)
                if failed:
                    runs["killed" if kill else failed[0]] += 1
                if problems:
                    findings.append(f"{scenario.name}: {fault} ({' '.join(failed[2:]) if failed else ''}): "
                                    + "; ".join(problems))
                    tell(findings[-1])
    return runs, findings


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("--scenarios", nargs="*")
    arguments.add_argument("--classes", nargs="*")
    arguments.add_argument("--points", type=int, default=0, help="calls of a class that fail; 0: all")
    arguments.add_argument("--malloc-points", type=int, default=100)
    arguments.add_argument("--kill", action="store_true")
    arguments.add_argument("--stages", action="store_true", help="memory ends, 1,000 times over all stages")
    given = arguments.parse_args()
    tell = functools.partial(print, flush=True)
    if given.stages:
        runs, findings = run_stages(1000, tell)
    else:
        runs, findings = run(given.scenarios, given.classes, given.points, given.malloc_points, given.kill, tell)
    print(f"{sum(runs.values())} runs with a fault: " + ", ".join(f"{k} {v}" for k, v in sorted(runs.items())))
    print(f"{len(findings)} findings")
    return 1 if findings else 0


if __name__ == "__main__":
    sys.exit(main())
