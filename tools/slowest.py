#!/usr/bin/env python3
"""slowest.py [BUILD] [COUNT]: the dearest steps of the last build from nothing, as ninja's log has them.

BUILD is the build directory (build/release), COUNT how many are printed (10). The log keeps the last time of each
output, so after incremental builds it mixes several runs; a step's seconds are wall time, shared with whatever else
ran. With ccache most steps cost nothing: build with CCACHE_DISABLE=1 to measure."""

import pathlib
import sys


def steps(log):
    """{output: seconds}; the last line of an output counts. Outputs of one command count once."""
    lines = log.read_text(encoding="utf-8").splitlines()
    if not lines or not lines[0].startswith("# ninja log v"):
        raise SystemExit(f"{log} is no log of ninja")
    last = {}
    for line in lines[1:]:
        start, end, _, output, command = line.split("\t")
        last[output] = (command, (int(end) - int(start)) / 1000)
    by_command = {}
    for output, (command, seconds) in last.items():
        by_command.setdefault(command, (output, seconds))
    return dict(by_command.values())


def main():
    build = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else "build/release")
    count = int(sys.argv[2]) if len(sys.argv) > 2 else 10
    log = build / ".ninja_log"
    if not log.exists():
        raise SystemExit(f"{log} is missing: nothing was built there with ninja")
    all_steps = steps(log)
    for output, seconds in sorted(all_steps.items(), key=lambda step: (-step[1], step[0]))[:count]:
        print(f"{seconds:7.1f} s  {output}")
    print(f"{sum(all_steps.values()):7.1f} s  in {len(all_steps)} steps")


if __name__ == "__main__":
    main()
