"""Calls of the system that fail and threads that are stopped, in a few runs; `make faults` and `make schedules` take more."""

import dataclasses
import errno
import os
import pathlib
import sys
import tempfile
import unittest
import unittest.mock

from support import main

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "faults"))
import faults  # noqa: E402
import power  # noqa: E402
import scenarios  # noqa: E402
import schedules  # noqa: E402


@unittest.skipUnless(os.environ.get("FACETMILL_INJECTOR"),
                     "no tests/faults/inject.c in this build: sanitizers replace the same calls, and it needs GCC on Linux")
class Faults(unittest.TestCase):
    def trial(self, scenario):
        room = tempfile.TemporaryDirectory(prefix="facetmill-faults-")
        self.addCleanup(room.cleanup)
        return faults.Trial(scenario, room.name)

    def check(self, runs, findings, least):
        self.assertEqual(findings, [], "\n".join(findings))
        self.assertGreaterEqual(sum(runs.values()), least, runs)

    def test_a_call_fails(self):
        self.check(*faults.run(["several"], points=3, malloc_points=4), least=35)

    def test_the_process_is_killed(self):
        self.check(*faults.run(["several"], points=12, kill=True), least=12)

    def test_a_neighbour_that_cannot_be_read(self):
        """Neither is a buffer malformed nor a texture left out because the disk has a fault."""
        trial = self.trial(next(s for s in scenarios.scenarios() if s.name == "textures"))
        judged = set()
        for name, error in (("open", errno.EMFILE), ("read", errno.EIO)):
            for number, path in enumerate(trial.calls(name), 1):
                neighbour = pathlib.Path(path).name
                if neighbour in ("t.bin", "tex.png"):
                    self.assertEqual(trial.judge(f"{name} {number} {error}")[0], [])
                    judged.add((name, neighbour))
        self.assertEqual(len(judged), 4, judged)

    def test_a_temporary_that_cannot_be_removed(self):
        """The next batch removes it, though it writes nothing."""
        trial = self.trial(next(s for s in scenarios.scenarios() if s.name == "batch"))
        temporaries = [number for number, path in enumerate(trial.calls("unlink"), 1) if ".facetmill-" in path]
        self.assertGreater(len(temporaries), 0)
        self.assertEqual(trial.judge(f"unlink {temporaries[0]} {errno.EROFS}")[0], [])

    def test_a_pipeline_that_cannot_be_looked_at(self):
        """It is among the inputs of a depfile, or the run tells that it cannot be read."""
        trial = self.trial(next(s for s in scenarios.scenarios() if s.name == "reports"))
        looks = [number for number, path in enumerate(trial.calls("stat"), 1) if pathlib.Path(path).name == "p.yaml"]
        self.assertGreater(len(looks), 1)
        for number in looks:
            self.assertEqual(trial.judge(f"stat {number} {errno.EIO}")[0], [])

    def test_the_power_fails(self):
        """Each file is as it was or whole, whenever the power fails; without waiting for the disk it is not."""
        for scenario in scenarios.scenarios():
            if scenario.name not in ("run", "pipe", "textures", "several", "reports", "batch"):
                continue
            with self.subTest(scenario.name):
                trial = self.trial(scenario)
                folder, state = str(trial.room / "work"), scenario.state
                self.assertEqual(power.problems(trial.trace(), folder, state), [])
                asynchronous = [*scenario.command[:1], "--no-sync", *scenario.command[1:]]
                trial.scenario = dataclasses.replace(scenario, command=asynchronous)
                told = power.problems(trial.trace(), folder, state)
                for name in (name for group in scenario.groups for name in group):
                    self.assertTrue(any(name in line for line in told), (name, told))

    def test_what_is_wrong_is_found(self):
        """What the judgement is worth: half of the outputs, a changed input, a temporary that stays."""
        trial = self.trial(scenarios.Scenario("broken", {"c.off": scenarios.CUBE},
                                              ["pipe", "load", "c.off", "!", "write", "a.ply"], [["a.ply", "b.ply"]]))
        self.assertEqual(list(trial.group_problems({"a.ply": trial.new["a.ply"], "b.ply": b""})),
                         ["neither old nor new: a.ply, b.ply"])
        self.assertEqual(list(trial.left_problems({"c.off": b"", ".a.ply.facetmill-1~": b""}, False)),
                         ["changed: c.off", "left: .a.ply.facetmill-1~"])


@unittest.skipUnless(os.environ.get("FACETMILL_PERTURBER"), "no tests/faults/perturb.c in this build, as above")
class Schedules(unittest.TestCase):
    CHOSEN = ("scan", "many parts", "render", "cells")

    def test_the_bytes_are_those_of_one_thread(self):
        counts, names, findings = schedules.run(8, chosen=self.CHOSEN)
        self.assertEqual(findings, [], "\n".join(findings))
        self.assertEqual(names, set(self.CHOSEN))
        self.assertGreater(counts["threads"], counts["runs"])
        self.assertGreater(counts["stops"], counts["runs"])

    def test_what_differs_is_found(self):
        line = ["--timings", "t.json", "generate", "sphere", "!", "write", "o.ply"]
        with unittest.mock.patch.object(schedules, "commands", lambda: [("with times", line)]):
            _, _, findings = schedules.run(1)
        self.assertEqual(len(findings), 1)
        self.assertTrue(findings[0].endswith("seed 1: t.json"), findings)


if __name__ == "__main__":
    main()
