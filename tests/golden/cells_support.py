"""What the tests of meshes in cells have in common: which runs are compared, and binary PLY and STL as values."""

import struct

from support import SLOW


def variants(*all_of_them):
    """Runs that are compared; under sanitizers the second of them alone."""
    return all_of_them[1:2] if SLOW else all_of_them


def parted_ply(path):
    """The header of a binary PLY, the bytes of each vertex (x, y and z first), and those of the faces."""
    head, body = path.read_bytes().split(b"end_header\n", 1)
    before = head.split(b"element face")[0].splitlines()
    count = next(int(line.split()[2]) for line in before if line.startswith(b"element vertex"))
    size = sum({b"float": 4, b"double": 8}[line.split()[1]] for line in before if line.startswith(b"property"))
    return head, [body[size * v:size * (v + 1)] for v in range(count)], body[size * count:]


def triangles(path):
    """The faces of a binary PLY or STL as places, summed up so that numbers and order do not matter."""
    if path.suffix == ".stl":
        rows = struct.iter_unpack("<12x36s2x", path.read_bytes()[84:])
        faces = ([row[0][12 * k:12 * k + 12] for k in range(3)] for row in rows)
    else:
        head, points, rest = parted_ply(path)
        more = 4 * sum(line.startswith(b"property") for line in head.split(b"vertex_indices\n")[1].splitlines())
        faces = ([points[v][:12] for v in row[1:]] for row in struct.iter_unpack(f"<B3i{more}x", rest))
    count = total = 0
    for face in faces:
        count += 1
        total += hash(b"".join(min(face[k:] + face[:k] for k in range(3))))
    return count, total


def rows(path):
    """The vertices of a binary PLY with all of their attributes, in an order of their own; and the bytes of the file."""
    return sorted(parted_ply(path)[1]), path.stat().st_size
