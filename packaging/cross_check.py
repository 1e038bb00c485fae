#!/usr/bin/env python3
"""cross_check.py DIST [MESHES] [--system arm64|windows] [--only REGEX] [--every N] [--jobs N]: runs the arm64 executable of DIST under
qemu-aarch64-static, or the one for Windows under Wine, and compares every output with that of x86-64, byte for byte: exit codes, messages (except times and memory), files and reports.

The commands run the examples of every stage on several meshes, write all formats, read every mesh of the tests, and print
the texts. MESHES is a folder with further meshes (up to 300 kB each). The commands write each of them in two formats.
"""

import argparse
import concurrent.futures
import os
import pathlib
import re
import shlex
import shutil
import subprocess
import sys
import tempfile

TOP = pathlib.Path(__file__).resolve().parent.parent
VERSION = (TOP / 'VERSION').read_text().strip()
MESHES = ('.ply', '.obj', '.off', '.stl', '.3mf', '.glb', '.gltf', '.drc')
WRITTEN = ('o.glb', 'o.gltf', 'o.glb --draco', 'o.glb --meshopt', 'o.ply', 'o.obj', 'o.stl', 'o.off', 'o.3mf', 'o.glb --quantize',
           'o.drc', 'o.ply --ascii', 'o.stl --ascii')
METHODS = {
    'split': 'midpoint bisect notch centroid core quads halve varignon diagonal fan grid loop sqrt3 butterfly catmull-clark',
    'simplify 40% --method': 'quadric quadric-endpoints constrained shortest-edge cluster', 'clean --weld': 'off exact near',
    'generate': 'sphere cube torus menger cylinder cone plane icosphere tetrahedron octahedron dodecahedron sierpinski',
    'thicken 2% --side': 'inward outward centred', 'orient --method': 'outward consistent flip'}
VARYING = re.compile(r' *\b(\d+ min )?\d[\d.,]* ?(ms|s|µs|min|CPU s|[kMG]B|[KMG]iB)\b')
FIXED = {'PATH': '/usr/bin:/bin', 'FACETMILL_CACHE': 'off', 'FACETMILL_JOBS': '2', 'LC_ALL': 'C.UTF-8', 'WINEDEBUG': '-all',
         'WINEPREFIX': os.environ.get('WINEPREFIX', f'{pathlib.Path.home()}/.wine')}
SYSTEMS = {'arm64': ('linux-aarch64', 'qemu-aarch64-static'), 'windows': ('windows-x86_64.exe', 'wine')}


class Runner:
    """Runs a command line in a new folder and returns all that came out."""

    def __init__(self, program, inputs, emulator=()):
        self.program, self.inputs, self.emulator = str(program), inputs, emulator

    def __call__(self, line, pipeline):
        with tempfile.TemporaryDirectory(prefix='facetmill-cross-') as name:
            folder = pathlib.Path(name)
            for link, target in self.inputs.items():
                (folder / link).symlink_to(target)
            if pipeline:
                (folder / 'p.yaml').write_text(pipeline)
            before = set(folder.iterdir())
            try:
                run = subprocess.run([*self.emulator, self.program, *shlex.split(line)], cwd=folder, env={**FIXED, 'HOME': name},
                                     stdin=subprocess.DEVNULL, capture_output=True, timeout=1200)
            except subprocess.TimeoutExpired:
                return {'exit': 'more than 20 minutes'}

            def without_folder(data):  # Wine gives the drive Z: to the root folder
                return data.replace(b'Z:' + name.encode(), b'.').replace(name.encode(), b'.')

            def text(data):
                return VARYING.sub(' _', without_folder(data).decode(errors='replace').replace(self.program, 'facetmill'))

            files = [p for top in set(folder.iterdir()) - before for p in [top, *top.rglob('*')] if p.is_file()]
            return {'exit': run.returncode, 'stdout': text(run.stdout), 'stderr': text(run.stderr),
                    **{str(p.relative_to(folder)): without_folder(p.read_bytes()) for p in files}}


def commands(program, folder, meshes):
    """Pairs of a command line and the pipeline that it runs, or ''."""
    def output(*arguments):
        return subprocess.run([program, *arguments], check=True, capture_output=True, text=True).stdout

    def make(name, line):
        subprocess.run([program, 'pipe', '-q', *shlex.split(line), '!', 'write', folder / name], check=True, stderr=subprocess.DEVNULL)

    make('scan.ply', f'load {TOP}/examples/data/nefertiti.ply --unit mm --up y ! simplify --faces 3000')
    make('torus.stl', 'generate torus')
    make('quads.obj', 'generate menger --quads')
    own = {'scan': 'made/scan.ply', 'torus': 'made/torus.stl', 'quads': 'made/quads.obj', 'textured': 'tests/box-textured.glb'}

    yield from ((line, '') for line in ('--help', 'formats', 'formats --json', 'docs', 'schema report', 'explain E-WRITE'))
    yield from ((f'schema {kind}', '') for kind in ('pipeline', 'info', 'diff'))
    for stage in [line.split()[0] for line in output('stages').splitlines()]:
        yield f'stages {stage}', ''
        if stage == 'load':
            continue
        for example in re.findall(r'^  - (.*)$', output('stages', stage).partition('\nExamples')[2], re.M):
            for mesh in own.values():
                yield ('run --report r.json --report r.html p.yaml --output-dir out',
                       f'facetmill: 1\nstages:\n  - load: {{path: {mesh}, unit: m, up: z}}\n  - {example}\n  - write: o.glb\n')
    for stage, methods in METHODS.items():
        for method in methods.split():
            if stage == 'generate':
                yield f'pipe generate {method} ! write o.glb ! write o.obj', ''
                continue
            for mesh in ('scan', 'quads'):
                yield f'pipe --report r.json load {own[mesh]} ! {stage} {method} ! write o.ply', ''
    for mesh in own.values():
        yield from ((f'pipe --report r.json load {mesh} ! write {written}', '') for written in WRITTEN)
    for operation in ('union', 'difference', 'intersection'):
        yield f'pipe generate torus ! combine {operation} --with {own["quads"]} ! write o.stl', ''
    for name in ('convert', 'game-ready', 'lod-chain', 'quickstart', 'repair', 'scan-to-web', 'view', 'web'):
        yield f'run {name} -D input={own["scan"]} -D unit=mm -D up=z --output-dir out', ''
    yield f'diff --json {own["scan"]} {own["torus"]}', ''
    yield f'render {own["textured"]} o.png', ''
    for size in ('4', '3'):
        yield f'pipe load {own["textured"]} ! textures --max_size {size} ! write o.gltf', ''

    known = [f'tests/{p.relative_to(TOP / "tests/data")}' for p in sorted((TOP / 'tests/data').rglob('*')) if p.suffix in MESHES]
    if meshes:
        known += [f'meshes/{p.relative_to(meshes)}' for p in sorted(meshes.rglob('*')) if p.suffix in MESHES and p.stat().st_size < 300_000]
    for i, mesh in enumerate(known):
        yield f'info --json {mesh}', ''
        for k in (2 * i, 2 * i + 5):
            yield f'pipe --report r.json load {mesh} ! write {WRITTEN[k % len(WRITTEN)]}', ''


def main():
    parser = argparse.ArgumentParser(description=__doc__.partition('\n')[0])
    parser.add_argument('dist', type=pathlib.Path)
    parser.add_argument('meshes', type=pathlib.Path, nargs='?')
    parser.add_argument('--system', choices=SYSTEMS, default='arm64')
    parser.add_argument('--only', default='', help='run only commands that match this regular expression')
    parser.add_argument('--every', type=int, default=1, help='run only every Nth command')
    parser.add_argument('--jobs', type=int, default=2)
    options = parser.parse_args()
    name, emulator = SYSTEMS[options.system]
    native, foreign = (options.dist.resolve() / f'facetmill-{VERSION}-{n}' for n in ('linux-x86_64', name))
    emulator = shutil.which(emulator) or sys.exit(f'{emulator} is missing: tools/deps.sh --{options.system}')
    with tempfile.TemporaryDirectory(prefix='facetmill-made-') as made:
        inputs = {'made': made, 'tests': TOP / 'tests/data'}
        if options.meshes:
            inputs['meshes'] = options.meshes.resolve()
        runs = Runner(native, inputs), Runner(foreign, inputs, (emulator,))
        todo = [c for c in dict.fromkeys(commands(native, pathlib.Path(made), inputs.get('meshes'))) if re.search(options.only, ' '.join(c))]
        todo = todo[::options.every]

        def compare(command):
            first, second = (run(*command) for run in runs)
            return first, [name for name in sorted({*first, *second}) if first.get(name) != second.get(name)]

        outputs = passed = different = 0
        with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
            for (line, pipeline), (result, wrong) in zip(todo, pool.map(compare, todo)):
                outputs += len(result)
                passed += result['exit'] == 0
                different += len(wrong)
                if wrong:
                    example = pipeline.splitlines()[3].strip() if pipeline else ''
                    print(f'different: {", ".join(wrong)}: {line} {example}', flush=True)
    print(f'{len(todo)} commands ({passed} of them end with 0), {outputs} outputs compared, {different} different')
    sys.exit(different > 0)


main()
