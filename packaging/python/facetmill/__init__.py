"""facetmill from Python: runs mesh pipelines and returns their reports.

    import facetmill
    report = facetmill.pipe('load scan.ply --unit mm ! simplify 25% ! write web.glb --draco')
    print(report.stages[-1].after.faces)

The program itself does the work; see `facetmill docs`.
"""

from ._frames import to_pandas
from ._mesh import Mesh, load, save
from ._program import Error, Progress, batch, diff, executable, info, pipe, run, stages, version
from ._show import show
from ._stages import FieldDescription, OptionDescription, StageDescription
from .reports import Batch, Diff, Info, Report

__all__ = ['Batch', 'Diff', 'Error', 'FieldDescription', 'Info', 'Mesh', 'OptionDescription', 'Progress', 'Report',
           'StageDescription', 'batch', 'diff', 'executable', 'info', 'load', 'pipe', 'run', 'save', 'show', 'stages',
           'to_pandas', 'version']
