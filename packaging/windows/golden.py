#!/usr/bin/env python3
"""golden.py EXECUTABLE [--only REGEX] [--jobs N]: runs the golden tests of tests/golden with the executable of Windows, under Wine.
Tests of what Windows does not have are left out, each with its reason. The end counts and names all of them.
"""

import argparse
import concurrent.futures
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

TOP = pathlib.Path(__file__).resolve().parents[2]
GOLDEN = TOP / 'tests/golden'

# Patterns of names of tests, and why these make no sense under Wine.
LEFT_OUT = {
    'accessibility_test|pages_test.*browser|viewer_test': 'opens pages in a browser of Linux',
    'contributing_test': 'reads the source, and runs nothing of the executable that differs',
    'packages_test': 'makes packages for Linux',
    'sandbox_test': 'has the sandbox of Linux',
    'faults_test': 'needs a library that makes calls of Linux fail',
    'ktx2_test': 'needs processes that run ktx, which Windows has not',
    'import_test': 'needs import helpers, which Windows has not',
}


def name_of(test):
    return '.'.join(test.id().split('.')[-3:])


def tests_in(suite):
    for test in suite:
        yield from tests_in(test) if isinstance(test, unittest.TestSuite) else (test,)


def reason_to_leave_out(name):
    return next((reason for pattern, reason in LEFT_OUT.items() if re.match(pattern, name)), '')


def run(name, wrapper):
    """'', or why the test was skipped, and whether it failed with its output."""
    try:
        done = subprocess.run([sys.executable, '-m', 'unittest', '-v', name], cwd=GOLDEN, capture_output=True, text=True, timeout=1800,
                              errors='replace', env={**os.environ, 'FACETMILL': str(wrapper), 'PYTHONDONTWRITEBYTECODE': '1'})
    except subprocess.TimeoutExpired:
        return '', 'it took more than 30 minutes'
    skipped = re.search(r"\.\.\. skipped ['\"](.*)['\"]$", done.stderr, re.M)
    return skipped[1] if skipped else '', done.stderr if done.returncode else ''


def main():
    parser = argparse.ArgumentParser(description=__doc__.partition('\n')[0])
    parser.add_argument('executable', type=pathlib.Path)
    parser.add_argument('--only', default='', help='run only tests whose names match this regular expression')
    parser.add_argument('--jobs', type=int, default=2)
    options = parser.parse_args()
    with tempfile.TemporaryDirectory(prefix='facetmill-golden-') as folder:
        wrapper = pathlib.Path(folder) / 'facetmill'
        prefix = os.environ.get('WINEPREFIX', f'{folder}/wine')
        wrapper.write_text(f'#!/bin/sh\nexport WINEPREFIX="{prefix}" WINEDEBUG=-all\n'
                           f'exec wine "{options.executable.resolve()}" "$@"\n')
        wrapper.chmod(0o755)
        subprocess.run([wrapper, '--version'], check=True, capture_output=True)
        os.environ['FACETMILL'] = str(wrapper)
        sys.path.insert(0, str(GOLDEN))
        names = [n for n in map(name_of, tests_in(unittest.TestLoader().discover(str(GOLDEN), '*_test.py'))) if re.search(options.only, n)]
        left_out = {n: reason for n in names if (reason := reason_to_leave_out(n))}
        todo = [n for n in names if n not in left_out]
        passed, failed = 0, []
        with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
            for name, (skipped, output) in zip(todo, pool.map(lambda n: run(n, wrapper), todo)):
                if output:
                    failed.append(name)
                    print(f'failed: {name}\n{output}', flush=True)
                elif skipped:
                    left_out[name] = skipped
                else:
                    passed += 1
    for name, reason in left_out.items():
        print(f'left out: {name}: {reason}')
    for name in failed:
        print(f'failed: {name}')
    print(f'{len(names)} golden tests: {passed} passed, {len(failed)} failed, {len(left_out)} left out')
    sys.exit(bool(failed))


main()
