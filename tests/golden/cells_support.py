"""What the tests of meshes in cells have in common: which runs are compared, and binary PLY and STL as values."""

import struct

from support import SLOW


def variants(*all_of_them):
    """Runs that are compared; under sanitizers the second of them alone."""
    return all_of_them[1:2] if SLOW else all_of_them


def vertex_size(head):
    """The bytes of a vertex of a binary PLY, x, y and z first."""
    return sum({b"float": 4, b"double": 8}[line.split()[1]] for line in head.split(b"element face")[0].splitlines()
               if line.startswith(b"property"))


def triangles(path):
    """The faces of a binary PLY or STL as places, summed up so that numbers and order do not matter."""
    data = path.read_bytes()
    if path.suffix == ".stl":
        rows = struct.iter_unpack("<12x36s2x", data[84:])
        faces = ([row[0][12 * k:12 * k + 12] for k in range(3)] for row in rows)
    else:
        head, body = data.split(b"end_header\n", 1)
        vertices = next(int(line.split()[2]) for line in head.splitlines() if line.startswith(b"element vertex"))
        more = 4 * sum(line.startswith(b"property") for line in head.split(b"vertex_indices\n")[1].splitlines())
        size = vertex_size(head)
        rows = struct.iter_unpack(f"<B3i{more}x", body[size * vertices:])
        faces = ([body[size * v:size * v + 12] for v in row[1:]] for row in rows)
    count = total = 0
    for face in faces:
        count += 1
        total += hash(b"".join(min(face[k:] + face[:k] for k in range(3))))
    return count, total


def rows(path):
    """The vertices of a binary PLY with all of their attributes, in an order of their own; and the bytes of the file."""
    data = path.read_bytes()
    head, body = data.split(b"end_header\n", 1)
    vertices = next(int(line.split()[2]) for line in head.splitlines() if line.startswith(b"element vertex"))
    size = vertex_size(head)
    return sorted(body[size * v:size * (v + 1)] for v in range(vertices)), len(data)
