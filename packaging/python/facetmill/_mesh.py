"""Meshes as numpy arrays, through binary PLY on the program's standard output and input."""

from __future__ import annotations

import os
import subprocess
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, Dict, List, Optional, Tuple

from ._program import PathLike, error_of, events, start

if TYPE_CHECKING:
    import numpy
    import numpy.typing
    Array = numpy.typing.NDArray[Any]

_KINDS = {'char': 'i1', 'int8': 'i1', 'uchar': 'u1', 'uint8': 'u1', 'short': 'i2', 'int16': 'i2', 'ushort': 'u2',
          'uint16': 'u2', 'int': 'i4', 'int32': 'i4', 'uint': 'u4', 'uint32': 'u4', 'float': 'f4', 'float32': 'f4',
          'double': 'f8', 'float64': 'f8'}
_NAMES = {'i1': 'char', 'u1': 'uchar', 'i2': 'short', 'u2': 'ushort', 'i4': 'int', 'u4': 'uint', 'f4': 'float', 'f8': 'double'}


@dataclass
class Mesh:
    """A mesh of triangles. The arrays of a loaded mesh are views of the bytes that the program wrote.

    `vertices` is n x 3, `faces` m x 3 with indices of vertices. Attributes are arrays with one value per vertex or
    face, by their names in PLY: nx, ny, nz, red, green, blue, s, t and others.
    """

    vertices: 'Array'
    faces: 'Array'
    vertex_attributes: Dict[str, 'Array'] = field(default_factory=dict)
    face_attributes: Dict[str, 'Array'] = field(default_factory=dict)


def _program(arguments: List[str], data: Optional[bytes]) -> bytes:
    """Runs the program on bytes: what it writes to standard output."""
    process = start(['pipe', '-q', '--log', 'json', *arguments], stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                    stderr=subprocess.PIPE)
    with process:
        output, said = process.communicate(data)
    if process.returncode != 0:
        errors, others = events(said.decode('utf8', 'replace').splitlines())
        raise error_of(errors, others, process.returncode)
    return bytes(output)


def load(path: PathLike, stages: str = '', *, unit: Optional[str] = None, up: Optional[str] = None) -> Mesh:
    """Reads any file that facetmill reads. All parts are merged; larger faces become triangles.

    `stages` run in between: load('scan.ply', 'clean ! simplify 10%'). unit and up apply where the file states none.
    """
    import shlex
    words = ['load', os.fspath(path)]
    words += (['--unit', unit] if unit else []) + (['--up', up] if up else [])
    words += (['!', *shlex.split(stages)] if stages else [])
    return _from_ply(_program([*words, '!', 'write', '-', '--format', 'ply', '--triangulate'], None))


def save(mesh: Mesh, path: PathLike, *, unit: Optional[str] = None, up: Optional[str] = None) -> None:
    """Writes the mesh in the format of the path's suffix. unit and up say how the numbers are meant."""
    words = ['load', '-', '--format', 'ply']
    words += (['--unit', unit] if unit else []) + (['--up', up] if up else [])
    _program([*words, '!', 'write', os.fspath(path)], _to_ply(mesh))


def _header(data: bytes) -> Tuple[List[Tuple[str, int, List[List[str]]]], int]:
    end = data.index(b'end_header\n') + len(b'end_header\n')
    elements: List[Tuple[str, int, List[List[str]]]] = []
    for line in data[:end].decode('utf8').splitlines():
        words = line.split()
        if words[:1] == ['element']:
            elements.append((words[1], int(words[2]), []))
        elif words[:1] == ['property']:
            elements[-1][2].append(words[1:])
    return elements, end


def _positions(vertices: 'Array') -> 'Array':
    """x, y and z as one array: a view where they follow each other in one type, as facetmill writes them."""
    import numpy
    fields: Any = vertices.dtype.fields
    kinds = [fields[axis] for axis in 'xyz']
    (kind, start), size = kinds[0][:2], kinds[0][0].itemsize
    if [k[:2] for k in kinds] != [(kind, start + axis * size) for axis in range(3)]:
        return numpy.stack([vertices[axis] for axis in 'xyz'], axis=1)
    return numpy.ndarray((len(vertices), 3), kind, vertices.data, start, (vertices.dtype.itemsize, size))


def _from_ply(ply: bytes) -> Mesh:
    import numpy
    data = bytearray(ply)  # the arrays are views of it, and can be changed
    elements, at = _header(ply)
    found: Dict[str, Any] = {}
    for name, count, properties in elements:
        row = []
        for words in properties:
            if words[0] == 'list':  # triangles: every list has three entries
                row += [('#' + words[3], '<' + _KINDS[words[1]]), (words[3], '<' + _KINDS[words[2]], (3,))]
            else:
                row.append((words[1], '<' + _KINDS[words[0]]))
        kind = numpy.dtype(row)
        found[name] = numpy.frombuffer(data, kind, count, at)
        at += count * kind.itemsize
    vertices = found['vertex']
    faces = found.get('face')
    corners = next((n for n in faces.dtype.names if n in ('vertex_indices', 'vertex_index')), '') if faces is not None else ''
    return Mesh(
        _positions(vertices),
        numpy.zeros((0, 3), 'i4') if faces is None else faces[corners],
        {n: vertices[n] for n in vertices.dtype.names if n not in ('x', 'y', 'z')},
        {} if faces is None else {n: faces[n] for n in faces.dtype.names if n != corners and not n.startswith('#')})


def _to_ply(mesh: Mesh) -> bytes:
    import numpy

    def column(values: Any, count: int) -> Any:
        values = numpy.asarray(values)
        if len(values) != count:
            raise ValueError(f'an attribute has {len(values)} values for {count} elements')
        kind = values.dtype.newbyteorder('=').str[1:]
        return values.astype('<' + (kind if kind in _NAMES else 'f8' if values.dtype.kind == 'f' else 'i4'))

    vertices, faces = numpy.asarray(mesh.vertices), numpy.asarray(mesh.faces)
    if vertices.ndim != 2 or vertices.shape[1] != 3 or faces.ndim != 2 or faces.shape[1] != 3:
        raise ValueError('vertices must be n x 3, and faces m x 3')
    if len(faces) and not (0 <= faces.min() and faces.max() < len(vertices)):
        raise ValueError('faces name vertices that do not exist')
    columns = {axis: column(vertices[:, k], len(vertices)) for k, axis in enumerate('xyz')}
    columns.update({name: column(values, len(vertices)) for name, values in mesh.vertex_attributes.items()})
    face_columns = {name: column(values, len(faces)) for name, values in mesh.face_attributes.items()}
    points = numpy.empty(len(vertices), [(name, values.dtype) for name, values in columns.items()])
    for name, values in columns.items():
        points[name] = values
    kind: List[Any] = [('#', 'u1'), ('corners', '<i4', (3,))] + [(name, values.dtype) for name, values in face_columns.items()]
    rows = numpy.empty(len(faces), kind)
    rows['#'], rows['corners'] = 3, faces
    for name, values in face_columns.items():
        rows[name] = values
    header = ['ply', 'format binary_little_endian 1.0', f'element vertex {len(vertices)}']
    header += [f'property {_NAMES[values.dtype.str[1:]]} {name}' for name, values in columns.items()]
    header += [f'element face {len(faces)}', 'property list uchar int vertex_indices']
    header += [f'property {_NAMES[values.dtype.str[1:]]} {name}' for name, values in face_columns.items()]
    return ('\n'.join([*header, 'end_header']) + '\n').encode() + points.tobytes() + rows.tobytes()
