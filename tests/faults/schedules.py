#!/usr/bin/env python3
"""Runs of facetmill whose threads are stopped at random instructions: the bytes must be those of one thread.

    schedules.py [--runs 1000] [--first SEED] [--scenarios NAME...]

Each scenario runs once with one thread and in peace; then the scenarios in turn, with two to eight threads, drawn by the
seed, and perturb.c. Outputs and reports must be the same, but for what a report says under `run`. FACETMILL
and FACETMILL_PERTURBER name the executable and the shared library of perturb.c.
"""

import argparse
import collections
import functools
import json
import os
import pathlib
import random
import shutil
import subprocess
import sys
import tempfile

import faults
import scenarios
from faults import FACETMILL, SOURCE

PERTURBER = os.environ.get("FACETMILL_PERTURBER", str(SOURCE / "build/release/tests/libfacetmill_perturb.so"))
TIMEOUT = 600
BALL, SCAN, MANY, PAIR = "ball.ply", str(SOURCE / "examples/data/nefertiti.ply"), "many.glb", "pair.glb"
KNOWN = ["--unit", "mm", "--up", "z"]  # of the scan, so that nothing has to be said about it
BEFORE = [f"pipe generate sphere --faces 20000 ! write {BALL}",
          f"pipe generate sphere --faces 20000 ! crumple 1% ! tile 0.3 ! write {MANY}",
          f"pipe load {BALL} ! transform --translate 0.3,0.2,0.1 ! load {BALL} ! write {PAIR}"]


def commands():
    """Of each scenario its name and its arguments without `pipe` and its options."""
    for name, line in scenarios.STAGES.items():
        yield name, f"load {BALL} ! {line} ! write o.glb".split()
    yield "scan", ["load", SCAN, *KNOWN, *"! simplify 10% ! write o.glb --draco".split()]
    yield "scan, clip and relax", ["load", SCAN, *KNOWN, *"! clip z=50% --cap ! relax 3 ! write o.ply".split()]
    yield "meshopt", ["load", SCAN, *KNOWN, *"! optimize ! write o.glb --meshopt".split()]
    yield "many parts", f"load {MANY} ! simplify 30% ! write o.glb --draco".split()
    yield "many parts, merged", f"load {MANY} ! merge ! clean ! write o.stl".split()
    yield "many parts, drawn", f"load {MANY} ! render v.png --width 200 --height 200 ! write o.obj".split()
    yield "union", f"load {PAIR} ! merge ! clean --self-intersections all ! write o.glb".split()
    yield "page", ["--report", "o.html", "load", SCAN, *KNOWN, *"! simplify 5% ! validate ! write o.glb".split()]
    cells = ["--memory", "64M", "--partition", "always"]
    yield "cells", [*cells, "load", SCAN, *KNOWN, *"! clean ! simplify 10% ! write o.ply".split()]


class Scenario:
    def __init__(self, name, arguments, base, room):
        self.name, self.arguments, self.base, self.room = name, arguments, base, room
        self.expected, _, _ = self.run(1)

    def run(self, threads, seed=None):
        """What the run leaves; how often a thread was stopped, and how many there were."""
        folder, log = self.room / "work", self.room / "log"
        shutil.rmtree(folder, ignore_errors=True)
        shutil.copytree(self.base, folder)
        log.unlink(missing_ok=True)
        perturbed = {} if seed is None else dict(
            LD_PRELOAD=PERTURBER, FACETMILL_SCHEDULE=str(seed), FACETMILL_SCHEDULE_LOG=str(log))
        done = subprocess.run([FACETMILL, "pipe", "-j", str(threads), "--report", "o.json", *self.arguments], cwd=folder,
                              env=faults.environment(**perturbed), timeout=TIMEOUT, capture_output=True)
        left = faults.Trial.files(folder)
        if "o.json" in left:
            report = json.loads(left["o.json"])
            report.pop("run", None)
            left["o.json"] = json.dumps(report, sort_keys=True).encode()
        if done.returncode != 0:
            raise RuntimeError(f"{self.name}, {threads} threads, seed {seed}: {done.returncode}\n{done.stderr.decode()}")
        stops, begun = map(int, log.read_text().split()) if seed is not None else (0, 0)
        return left, stops, begun


def run(runs, first=1, chosen=None, tell=lambda text: None):
    """Counts of runs, stops and threads, the names of scenarios that ran, and the findings as text."""
    counts, names, findings = collections.Counter(), set(), []
    with tempfile.TemporaryDirectory(prefix="facetmill-schedules-") as temporary:
        room = pathlib.Path(temporary)
        (room / "base").mkdir()
        for line in BEFORE:
            subprocess.run([FACETMILL, *line.split()], cwd=room / "base", check=True, capture_output=True,
                           env=faults.environment())
        every = [Scenario(name, arguments, room / "base", room) for name, arguments in commands()
                 if not chosen or name in chosen]
        for seed in range(first, first + runs):
            scenario, threads = every[seed % len(every)], random.Random(seed).randint(2, 8)
            left, stops, begun = scenario.run(threads, seed)
            counts.update(runs=1, stops=stops, threads=begun)
            names.add(scenario.name)
            differ = sorted(n for n in {**left, **scenario.expected} if left.get(n) != scenario.expected.get(n))
            if differ:
                findings.append(f"{scenario.name}, {threads} threads, seed {seed}: {', '.join(differ)}")
                tell(findings[-1])
            if (seed - first + 1) % 100 == 0:
                tell(f"{seed - first + 1} runs, {counts['stops']} stops, {len(findings)} findings")
    return counts, names, findings


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("--runs", type=int, default=1000)
    arguments.add_argument("--first", type=int, default=1)
    arguments.add_argument("--scenarios", nargs="*")
    given = arguments.parse_args()
    counts, names, findings = run(given.runs, given.first, given.scenarios, functools.partial(print, flush=True))
    print(f"{counts['runs']} runs of {len(names)} scenarios, {counts['stops']} stops of {counts['threads']} threads: "
          f"{len(findings)} findings")
    return 1 if findings else 0


if __name__ == "__main__":
    sys.exit(main())
