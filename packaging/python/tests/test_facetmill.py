"""Run with the wheel installed: python -m unittest discover packaging/python/tests"""

import os
import platform
import tempfile
import unittest
import unittest.mock
from pathlib import Path

import facetmill

CUBE = '''solid cube
''' + ''.join(f'facet normal 0 0 0\nouter loop\n' + ''.join(f'vertex {x} {y} {z}\n' for x, y, z in triangle) + 'endloop\nendfacet\n'
              for triangle in [((0, 0, 0), (0, 1, 0), (1, 1, 0)), ((0, 0, 0), (1, 1, 0), (1, 0, 0)),
                               ((0, 0, 1), (1, 0, 1), (1, 1, 1)), ((0, 0, 1), (1, 1, 1), (0, 1, 1)),
                               ((0, 0, 0), (1, 0, 0), (1, 0, 1)), ((0, 0, 0), (1, 0, 1), (0, 0, 1)),
                               ((1, 0, 0), (1, 1, 0), (1, 1, 1)), ((1, 0, 0), (1, 1, 1), (1, 0, 1)),
                               ((1, 1, 0), (0, 1, 0), (0, 1, 1)), ((1, 1, 0), (0, 1, 1), (1, 1, 1)),
                               ((0, 1, 0), (0, 0, 0), (0, 0, 1)), ((0, 1, 0), (0, 0, 1), (0, 1, 1))]) + 'endsolid cube\n'


class Facetmill(unittest.TestCase):
    def setUp(self) -> None:
        folder = tempfile.TemporaryDirectory(prefix='a folder with blanks ')
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.cube = self.folder / 'cube.stl'
        self.cube.write_text(CUBE)

    def test_pipe_returns_the_report(self) -> None:
        seen = []
        report = facetmill.pipe(['load', str(self.cube), '--unit', 'mm', '!', 'split', 'midpoint', '!', 'write',
                                 str(self.folder / 'cube.glb')], on_progress=seen.append)
        self.assertTrue(report.passed)
        self.assertEqual(report.stages[1].after.faces, 48)
        self.assertEqual([(p.name, p.number, p.of) for p in seen if not p.done], [('load', 1, 3), ('split', 2, 3), ('write', 3, 3)])
        self.assertEqual([p.faces for p in seen if p.done], [12, 48, 48])
        self.assertTrue((self.folder / 'cube.glb').exists())

    def test_run_takes_a_dict_and_params(self) -> None:
        pipeline = {'facetmill': 1, 'params': {'input': {'type': 'path'}, 'n': {'type': 'integer', 'default': 1}},
                    'stages': [{'load': {'path': '${input}', 'unit': 'mm'}}, {'measure': {}}]}
        report = facetmill.run(pipeline, input=self.cube)
        self.assertAlmostEqual(report.stages[1].result.total.solid.volume, 1)
        self.assertEqual(report.raw['stages'][1]['stage'], 'measure')

    def test_errors_have_id_place_and_hint(self) -> None:
        with self.assertRaises(facetmill.Error) as caught:
            facetmill.pipe(f"load '{self.cube}' ! simplfy 10% ! write x.glb")
        self.assertEqual((caught.exception.id, caught.exception.exit_code), ('E-STAGE', 2))
        self.assertIn('simplify', caught.exception.hint)
        with self.assertRaises(facetmill.Error) as caught:
            facetmill.pipe(['load', str(self.cube), '--unit', 'mm', '!', 'validate', '--euler', '0'])
        self.assertEqual((caught.exception.id, caught.exception.exit_code), ('E-CHECK', 1))
        self.assertFalse(caught.exception.report.passed)
        report = facetmill.pipe(['load', str(self.cube), '--unit', 'mm', '!', 'validate', '--euler', '0'], check=False)
        self.assertEqual(report.exit_code, 1)

    def test_info_diff_batch_and_stages(self) -> None:
        self.assertEqual(facetmill.info(self.cube).volume, 1)
        self.assertTrue(facetmill.diff(self.cube, self.cube).same)
        simplify = next(stage for stage in facetmill.stages() if stage.name == 'simplify')
        self.assertIn('method', [option.name for option in simplify.options])
        pipeline = self.folder / 'p.yaml'
        pipeline.write_text('facetmill: 1\nparams: {input: {type: path}}\nstages:\n  - load: {path: "${input}", unit: mm}\n'
                            '  - write: "${input.stem}.glb"\n')
        seen = []
        summary = facetmill.batch(pipeline, [self.cube], output_dir=self.folder / 'out', on_progress=seen.append)
        self.assertEqual((summary.counts.ok, summary.assets[0].faces_in), (1, 12))
        self.assertEqual([(p.number, p.of, p.done) for p in seen], [(1, 1, True)])

    def test_arrays_there_and_back(self) -> None:
        try:
            import numpy
        except ImportError:
            self.skipTest('numpy is not installed')
        mesh = facetmill.load(self.cube, 'split midpoint')
        self.assertEqual((mesh.vertices.shape, mesh.faces.shape), ((26, 3), (48, 3)))
        self.assertFalse(mesh.vertices.flags.owndata)
        mesh.vertices *= 2
        mesh.vertex_attributes['quality'] = numpy.arange(26, dtype='f4')
        facetmill.save(mesh, self.folder / 'twice.ply', unit='mm')
        self.assertEqual(facetmill.info(self.folder / 'twice.ply').volume, 8)
        again = facetmill.load(self.folder / 'twice.ply')
        self.assertEqual(again.vertex_attributes['quality'].tolist(), list(range(26)))
        mesh.faces = mesh.faces + 1
        self.assertRaises(ValueError, facetmill.save, mesh, self.folder / 'bad.ply')

    def test_arrays_fail_with_id_and_hint(self) -> None:
        with self.assertRaises(facetmill.Error) as caught:
            facetmill.load(self.folder / 'cuba.stl')
        self.assertEqual((caught.exception.id, caught.exception.exit_code), ('E-FILE', 3))
        with self.assertRaises(facetmill.Error) as caught:
            facetmill.load(self.cube, 'simplfy 10%')
        self.assertIn('simplify', caught.exception.hint)

    def test_show_is_a_frame(self) -> None:
        self.assertTrue(facetmill.show(self.cube)._repr_html_().startswith('<iframe'))

    def test_to_pandas_has_flat_columns(self) -> None:
        try:
            import pandas  # noqa: F401
        except ImportError:
            self.skipTest('pandas is not installed')
        report = facetmill.pipe(['load', str(self.cube), '--unit', 'mm', '!', 'measure'])
        self.assertEqual(list(facetmill.to_pandas(report)['after.faces']), [12, 12])
        self.assertEqual(list(report.to_pandas()['stage']), ['load', 'measure'])
        self.assertEqual(list(facetmill.info(self.cube).to_pandas()['volume']), [1])

    def start(self, program: Path) -> str:
        """What is said when another program is started."""
        with unittest.mock.patch.dict(os.environ, FACETMILL=str(program)), self.assertRaises(OSError) as caught:
            facetmill.version()
        return str(caught.exception)

    def test_the_program_of_the_environment_comes_first(self) -> None:
        self.assertIn('/nowhere/facetmill', self.start(Path('/nowhere/facetmill')))

    def test_a_program_that_cannot_start_says_why(self) -> None:
        program = self.folder / 'facetmill'
        program.write_bytes(b'\x7fELF\x02\x01\x01' + bytes(9) + b'\x02\x00\x16\x00' + bytes(108))  # IBM z
        self.assertIn('chmod +x', self.start(program))
        program.chmod(0o755)
        self.assertIn('this is the file for another system', self.start(program))
        program.write_bytes(b'\x7fELF\x02\x01\x01' + bytes(9) + b'\x02\x00\xb7\x00' + bytes(108))
        if platform.machine() == 'x86_64' and not Path('/proc/sys/fs/binfmt_misc/qemu-aarch64').exists():
            self.assertIn('this is the file for aarch64, and this machine is x86_64', self.start(program))

    def test_temporary_files_need_a_folder(self) -> None:
        with unittest.mock.patch('tempfile._candidate_tempdir_list', lambda: ['/nowhere']), \
                unittest.mock.patch('tempfile.tempdir', None), self.assertRaises(facetmill.Error) as caught:
            facetmill.info(self.cube)
        self.assertIn('TMPDIR', caught.exception.hint)

    def test_a_long_path_is_read_and_written(self) -> None:
        folder = self.folder / ('a' * 150) / ('b' * 150)
        folder.mkdir(parents=True)
        report = facetmill.pipe(['load', str(self.cube), '--unit', 'mm', '!', 'write', str(folder / 'c.glb')])
        self.assertTrue(report.passed)
        self.assertEqual(facetmill.info(folder / 'c.glb').faces, 12)


if __name__ == '__main__':
    unittest.main()
