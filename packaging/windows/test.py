#!/usr/bin/env python3
"""test.py EXECUTABLE [OTHER]: checks what differs on Windows, with the executable of 64-bit Windows. On Linux it runs under
Wine. OTHER is an executable of Linux, whose outputs must have the same bytes.
"""

import json
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest

TOP = pathlib.Path(__file__).resolve().parents[2]
SCAN = TOP / 'examples/data/nefertiti.ply'
ON_WINDOWS = os.name == 'nt'
PROGRAM, *OTHER = [str(pathlib.Path(p).resolve()) for p in sys.argv[1:]]
OWN = [PROGRAM] if ON_WINDOWS else ['wine', PROGRAM]
PIPELINE = 'facetmill: 1\nparams: {input: {type: path}}\nstages:\n  - load: {path: "${input}", unit: mm}\n  - write: "${stem}.glb"\n'


class Case(unittest.TestCase):
    def setUp(self):
        self.dir = pathlib.Path(tempfile.mkdtemp(prefix='facetmill-windows-'))
        self.addCleanup(shutil.rmtree, self.dir, ignore_errors=True)

    def mill(self, *arguments, expect=0, env=None, stdin=b'', program=OWN):
        run = subprocess.run([*program, *map(str, arguments)], cwd=self.dir, input=stdin, capture_output=True, timeout=1800,
                             env={**os.environ, 'FACETMILL_CACHE': 'off', 'WINEDEBUG': '-all', **(env or {})})
        self.assertEqual(run.returncode, expect, f'{arguments}\n{run.stderr.decode(errors="replace")}')
        return run

    def generate(self, *names, shape='cube', **options):
        writes = [word for name in names for word in ('!', 'write', name)]
        return self.mill('pipe', '-q', 'generate', shape, *writes, **options)

    def bytes_of(self, name):
        return (self.dir / name).read_bytes()

    def names(self):
        return sorted(p.relative_to(self.dir).as_posix() for p in self.dir.rglob('*') if p.is_file())


class Names(Case):
    def test_version(self):
        about = json.loads(self.mill('--version', '--json').stdout)
        self.assertEqual(about['sandbox'], {'landlock': 0, 'seccomp': False, 'mitigations': True})
        self.assertIn('cgal', about['sources'])

    def test_both_slashes_blanks_and_other_letters(self):
        name = 'Größe 漢字 𝄞'
        self.generate(f'out\\{name}\\a b.glb', f'out/{name}/c.obj')
        self.assertEqual([n for n in self.names() if n.endswith('glb')], [f'out/{name}/a b.glb'])
        self.assertEqual(json.loads(self.mill('info', '--json', f'out\\{name}\\c.obj').stdout)['faces'], 1200)

    def test_drive_letters(self):
        self.generate('cube.stl')
        drive = ('' if ON_WINDOWS else 'Z:') + str(self.dir / 'cube.stl').replace('/', '\\')
        self.mill('convert', drive, drive.replace('cube.stl', 'b.ply'))
        self.assertEqual(self.names(), ['b.ply', 'cube.stl'])

    def test_long_paths(self):
        path = '/'.join(['a' * 100] * 4) + '/cube.glb'
        self.generate(path)
        self.mill('info', path)

    def test_reserved_names(self):
        for name in ('NUL.glb', 'aux.glb', 'Com1.ply', 'ab:c.glb', 'a?.glb', 'out/lpt9.stl', 'a|b.glb', 'con .glb'):
            with self.subTest(name):
                self.assertIn(b'Windows does not allow this file name', self.generate(name, expect=4).stderr)
        self.assertEqual(self.names(), [])

    def test_names_without_case(self):
        self.assertIn(b'E-DUPLICATE-OUTPUT', self.generate('A.glb', 'a.glb', expect=2).stderr)
        self.generate('cube.glb')
        self.assertIn(b'E-OVERWRITE', self.mill('pipe', 'load', 'cube.glb', '!', 'write', 'CUBE.GLB', expect=2).stderr)

    def test_references_stay_in_the_folder(self):
        (self.dir / 'x.obj').write_text('mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nusemtl m\nf 1/1 2/1 3/1\n')
        for path in ('/windows/win.ini', 'C:/windows/win.ini', 'C:win.ini', '..\\secret.png', '//server/share/a.png'):
            with self.subTest(path):
                (self.dir / 'm.mtl').write_text(f'newmtl m\nmap_Kd {path}\n')
                run = self.mill('pipe', 'load', 'x.obj', '--unit', 'mm', '--up', 'z', '!', 'write', 'x.glb')
                self.assertIn(b'W-IMAGE', run.stderr)


class Text(Case):
    def test_lines_end_with_carriage_returns(self):
        (self.dir / 'p.yaml').write_bytes(PIPELINE.replace('\n', '\r\n').replace('${stem}', '${name}')
                                          .replace('input: {type: path}', 'input: {type: path}, name: {type: text}').encode())
        (self.dir / 'a.obj').write_bytes(b'v 0 0 0\r\nv 1 0 0\r\nv 0 1 0\r\nf 1 2 3\r\n')
        (self.dir / 'b.obj').write_bytes(b'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n')
        (self.dir / 'rows.csv').write_bytes(b'input,name\r\na.obj,one\r\nb.obj,two\r\n')
        self.mill('batch', 'p.yaml', '--table', 'rows.csv', '--output-dir', 'out')
        one, two = (next((self.dir / 'out').rglob(f'{name}.glb')).read_bytes() for name in ('one', 'two'))
        self.assertEqual(len(one), len(two))

    def test_streams_keep_bytes(self):
        self.generate('t.stl', shape='torus')
        load = ('--unit', 'mm', '--up', 'z', '!', 'write')
        out = self.mill('pipe', '-q', 'load', '-', *load, '-', '--format', 'ply', stdin=self.bytes_of('t.stl')).stdout
        self.mill('pipe', '-q', 'load', 't.stl', *load, 't.ply')
        self.assertEqual(out, self.bytes_of('t.ply'))
        self.assertNotIn(b'\r', self.mill('--help').stdout)


class Files(Case):
    def test_outputs_replace_open_files(self):
        self.generate('a.glb')
        before = self.bytes_of('a.glb')
        # Python on Windows lets no other program replace an open file: then nothing may change.
        with open(self.dir / 'a.glb', 'rb'):
            self.generate('a.glb', 'b.glb', shape='torus', expect=4 if ON_WINDOWS else 0)
        self.assertEqual(self.names(), ['a.glb'] if ON_WINDOWS else ['a.glb', 'b.glb'])
        self.assertEqual(self.bytes_of('a.glb') == before, ON_WINDOWS)

    def test_all_outputs_or_none(self):
        self.mill('pipe', '-q', 'generate', 'cube', '!', 'write', 'a.ply', '!', 'validate', '--euler', '0', expect=1)
        self.assertEqual(self.names(), [])

    def test_cache(self):
        shutil.copy(SCAN, self.dir / 'scan.ply')
        for name in ('a.glb', 'b.glb'):
            run = self.mill('pipe', '--explain', 'load', 'scan.ply', '--unit', 'mm', '--up', 'y', '!', 'clean', '!', 'simplify', '20%',
                            '!', 'write', name, env={'FACETMILL_CACHE': 'cache', 'CI': ''})
        self.assertIn(b'cache', run.stderr)
        self.assertTrue([n for n in self.names() if n.startswith('cache/')])
        self.assertEqual(self.bytes_of('a.glb'), self.bytes_of('b.glb'))

    def test_cells_on_disk(self):
        shutil.copy(SCAN, self.dir / 'scan.ply')
        self.mill('pipe', '-q', '--partition', 'always', 'load', 'scan.ply', '--unit', 'mm', '--up', 'y', '!', 'simplify', '20%', '!',
                  'write', 'a.glb')
        self.assertEqual(self.names(), ['a.glb', 'scan.ply'])

    def test_batch_skips_what_it_has_done(self):
        for name in ('a', 'b', 'c'):
            self.generate(f'in/{name}.stl', shape='torus')
        (self.dir / 'p.yaml').write_text(PIPELINE)
        for _ in range(2):
            run = self.mill('batch', 'p.yaml', '--input', 'in/*.stl', '--output-dir', 'out')
        self.assertIn(b'unchanged', run.stdout + run.stderr)
        self.assertEqual([n for n in self.names() if n.endswith('.glb')], ['out/a.glb', 'out/b.glb', 'out/c.glb'])

    def test_depfile(self):
        self.generate('in a.stl')
        (self.dir / 'p.yaml').write_text('facetmill: 1\nstages:\n  - load: {path: in a.stl, unit: mm}\n  - write: out\\a.glb\n')
        self.mill('run', '-q', 'p.yaml', '--depfile', 'a.d')
        self.assertEqual((self.dir / 'a.d').read_text().replace('\\\n ', '').splitlines()[0], 'out/a.glb: p.yaml in\\ a.stl')


class Ends(Case):
    @unittest.skipUnless(ON_WINDOWS, 'Wine passes no Ctrl-Break to a program without a console')
    def test_control_break_leaves_nothing(self):
        shutil.copy(SCAN, self.dir / 'scan.ply')
        run = subprocess.Popen([PROGRAM, 'pipe', 'load', 'scan.ply', '--unit', 'mm', '--up', 'y', '!', 'split', 'midpoint', '!',
                                'write', 'a.glb', '!', 'split', 'midpoint', '!', 'write', 'b.glb'], cwd=self.dir,
                               creationflags=subprocess.CREATE_NEW_PROCESS_GROUP)
        time.sleep(1)
        run.send_signal(signal.CTRL_BREAK_EVENT)
        self.assertEqual(run.wait(60), 128 + 15)
        self.assertEqual(self.names(), ['scan.ply'])


class Bytes(Case):
    @unittest.skipUnless(OTHER, 'no executable of Linux is given')
    def test_same_bytes(self):
        shutil.copy(SCAN, self.dir / 'scan.ply')
        results = []
        for program in (OWN, OTHER):
            self.mill('run', '-q', 'quickstart', '-D', 'input=scan.ply', '-D', 'unit=mm', '-D', 'up=y', '--output-dir', 'out',
                      program=program)
            results.append({p.name: p.read_bytes() for p in (self.dir / 'out').iterdir()})
            shutil.rmtree(self.dir / 'out')
        self.assertEqual([*results[0]], [*results[1]])
        for name in results[0]:
            with self.subTest(name):
                self.assertEqual(results[0][name], results[1][name])


unittest.main(argv=[sys.argv[0]], verbosity=2)
