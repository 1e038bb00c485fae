"""What the comparisons share: running a program, timing a call, and finding out who is there to compare with."""
import os
import pathlib
import subprocess
import sys

os.environ["FACETMILL_CACHE"] = "off"  # what is timed is done
ROOT = pathlib.Path(__file__).resolve().parents[2]

# Before the code of a Python peer: measured(call) gives its result, wall and CPU seconds; report prints them as JSON.
TIMED = """
import json, sys, time
def measured(call):
    wall, cpu = time.perf_counter(), time.process_time(); result = call()
    return result, time.perf_counter() - wall, time.process_time() - cpu
def report(wall, cpu, faces): print(json.dumps({"wall": wall, "cpu": cpu, "faces": int(faces)}))
"""


def output(command, before=None):
    """The standard output of a command; RuntimeError with the last line it complained with when it fails. `before` is
    called in its process first."""
    done = subprocess.run([str(c) for c in command], capture_output=True, text=True, preexec_fn=before)
    if done.returncode != 0:
        raise RuntimeError((done.stderr.strip() or "it failed").splitlines()[-1])
    return done.stdout


def peers_of(program, python, python_peers):
    """The command of each peer by name: those that `program list` names, and of python_peers (name: module and code)
    those whose module the interpreter can import. The others are named on standard error."""
    peers = {name: [program, "run", name] for name in output([program, "list"]).splitlines()}
    for name, (module, code) in python_peers.items():
        try:
            output([python or "false", "-c", f"import {module}"])
            peers[name] = [python, "-c", TIMED + code]
        except (RuntimeError, OSError):
            print(f"missing: {name}", file=sys.stderr)
    return peers


def add_common_options(ask, repeat):
    ask.add_argument("--build", default=ROOT / "build/release", type=pathlib.Path)
    ask.add_argument("--repeat", default=repeat, type=int, help="the fastest of so many runs counts")
    ask.add_argument("--python", help="an interpreter that has Python peers")


def crumpled_sphere(facetmill, level, path):
    """Writes a closed, slightly rough sphere of 20 * 4^level faces."""
    output([facetmill, "pipe", "--quiet", "generate", "icosphere", "--subdivisions", level, "!", "crumple",
            "--grid", "1", "--amplitude", "0.01%", "!", "write", path])
