#!/usr/bin/env python3
"""Fails when an include breaks the layers of the house or the privacy of a room, a library is included outside its
place, two headers define types of one name in one namespace (which no compiler sees, and no program survives), or a
folder of tests has no folder of sources that it tests.

A layer includes itself and the layers above it in LAYERS, never one below; nor does it declare their types ahead.
A room is a folder in geometry/, io/ or stages/. Others include its header of the same name (geometry/clip/clip.hpp),
or one of PUBLIC; all else in it is private. main.cpp of the command line is no exception; tests may include
everything."""

import pathlib
import re
import sys

LAYERS = ["base", "options", "mesh", "geometry", "io", "report", "diff", "cache", "stage", "stages", "pipeline", "docs", "batch", "cli"]

# A layer that must not include another although it stands below it.
FORBIDDEN = {"pipeline": {"stages"}, "docs": {"stages"}, "batch": {"stages"}, "cli": {"stages"}}

# Layers whose folders are rooms.
ROOMED = ("geometry", "io", "stages")

# What others may include of a room besides the header that is named after it, and why. A folder's name stands for all
# headers in it.
PUBLIC = {
    "geometry/cgal": "bridges to CGAL, each called by the room that needs it",
    "geometry/openmesh": "bridges to OpenMesh",
    "geometry/spatial": "trees, rays, closest points: tools, used one by one",
    "geometry/intersect": "pairs of faces that meet: tools, used one by one",
    "geometry/polygon": "polygons in the plane: tools, used one by one",
    "geometry/edit": "changes of a mesh: tools, used one by one",
    "geometry/cut": "what clip and crop have in common",
    "geometry/clean/solid_pieces.hpp": "the solids of a part, for separate and validate",
    "geometry/clean/steps.hpp": "single repairs, which others make, too",
    "geometry/inspect/connectivity.hpp": "components of a mesh",
    "geometry/inspect/evidence.hpp": "where a property fails",
    "geometry/measure/statistics.hpp": "least, most, mean of numbers",
    "geometry/normals/give_normals.hpp": "normals for a file",
    "geometry/normals/normal_seams.hpp": "where normals part, for simplify",
    "geometry/relax/neighbours.hpp": "the neighbours of a vertex, for crumple",
    "geometry/render/texture.hpp": "textures that io decodes",
    "geometry/section/stack.hpp": "the planes of a stack of sections",
    "geometry/simplify/joint.hpp": "several parts simplified together",
    "geometry/simplify/work.hpp": "the state that OpenMesh's decimater works on",
    "geometry/triangulate/crossing_faces.hpp": "the triangles that files and pictures show",
    "geometry/triangulate/pair_triangles.hpp": "the other way round",
    "io/gltf/looks.hpp": "materials as pictures draw them",
    "stages/measure/report.hpp": "measures in a report, for probe",
}

# First path component (or whole name) of a library's headers, and the only places that may include it.
LIBRARIES = {
    "yaml-cpp": ["src/pipeline/document.cpp"],
    "CLI": ["src/cli/"],
    "tiny_gltf.h": ["src/io/gltf/"],
    "draco": ["src/io/gltf/draco/"],
    "CGAL": ["src/geometry/cgal/"],
    "OpenMesh": ["src/geometry/openmesh/"],
    "boost": ["src/geometry/cgal/"],
    "png.h": ["src/io/pixels.cpp"],
    "jpeglib.h": ["src/io/pixels.cpp"],
    "webp": ["src/io/pixels.cpp"],
}

# The version of a library is no use of it: these headers hold only macros.
VERSION_HEADERS = {"CGAL/version.h", "CLI/Version.hpp", "draco/core/draco_version.h", "OpenMesh/Core/System/config.h"}

AHEAD = re.compile(r"^\s*(?:struct|class|enum class) (\w+);", re.M)
INCLUDE = re.compile(r'^\s*#\s*include\s*[<"]([^">]+)[">]', re.M)


NAMESPACE = re.compile(r"^namespace ([\w:]+) \{", re.M)
TYPE = re.compile(r"^(?:struct|class|enum class|enum) (\w+)(?: final)?(?: :[^:;{]*)? \{", re.M)


def types_in(text):
    """(namespace, name, line) of each type that is defined at the outermost level of a namespace."""
    spaces = [(m.start(), m.group(1)) for m in NAMESPACE.finditer(text)]
    for match in TYPE.finditer(text):
        around = [space for start, space in spaces if start < match.start()]
        yield around[-1] if around else "", match.group(1), text.count("\n", 0, match.start()) + 1


def room_of(name):
    """("geometry", "clip") of geometry/clip/walls.hpp; none for what lies in no room."""
    parts = name.split("/")
    return parts[:2] if len(parts) > 2 and parts[0] in ROOMED else None


def is_private(header, includer):
    """Whether the header is private to a room that the includer is not in. Both without src/."""
    room = room_of(header)
    if room is None or room_of(includer) == room:
        return False
    if header.endswith("_fields.hpp"):  # the declared fields of a result, which reports read
        return False
    return header not in PUBLIC and "/".join(room) not in PUBLIC and header != "/".join([*room, room[1] + ".hpp"])


def types_ahead(name, text, layers_of):
    """Types that are declared ahead although another layer defines them, and which."""
    layer = name.split("/")[1]
    for match in AHEAD.finditer(text):
        layers = layers_of.get(match.group(1), set())
        if layers and layer not in layers:
            yield (f"{name}:{text.count(chr(10), 0, match.start(1)) + 1}: {match.group(1)} is of "
                   f"{', '.join(sorted(layers))}/: include its header, or move it")


def problems_in(path, name, text):
    layer = name.split("/")[1]
    for match in INCLUDE.finditer(text):
        header, line = match.group(1), text.count("\n", 0, match.start()) + 1
        top = header.split("/")[0]
        if top in LAYERS and layer in LAYERS and (path.parents[len(name.split("/")) - 2] / header).exists():
            if LAYERS.index(top) > LAYERS.index(layer) or top in FORBIDDEN.get(layer, ()):
                yield f"{name}:{line}: {layer}/ must not include {header}: {top}/ is a layer below it"
        if is_private(header, name.removeprefix("src/")):
            yield f"{name}:{line}: {header} is private to its room (PUBLIC in tools/check_layers.py lists exceptions)"
        allowed = LIBRARIES.get(top)
        if allowed is None or header in VERSION_HEADERS:
            continue
        if not any(name.startswith(place) for place in allowed):
            yield f"{name}:{line}: {header} may be included only in {', '.join(allowed)}"


def main():
    root = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else pathlib.Path(__file__).parent.parent).resolve()
    files = sorted(p for p in (root / "src").rglob("*") if p.suffix in (".hpp", ".cpp", ".h"))
    found, types, layers_of = [], {}, {}
    for path in files:
        for _, type_name, _ in types_in(path.read_text(encoding="utf-8")) if path.suffix != ".cpp" else ():
            layers_of.setdefault(type_name, set()).add(path.relative_to(root).parts[1])
    for path in files:
        name = path.relative_to(root).as_posix()
        if name.count("/") < 2:
            continue  # src/precompiled.hpp
        if name.split("/")[1] not in LAYERS:
            found.append(f"{name}: {name.split('/')[1]}/ is no layer")
        text = path.read_text(encoding="utf-8")
        found.extend(problems_in(path, name, text))
        found.extend(types_ahead(name, text, layers_of))
        for space, type_name, line in types_in(text) if path.suffix != ".cpp" else ():
            first = types.setdefault((space, type_name), f"{name}:{line}")
            if first != f"{name}:{line}":
                found.append(f"{name}:{line}: {space}::{type_name} is also defined at {first}")
    for path in sorted((root / "tests").rglob("*.hpp")):
        name = path.relative_to(root).as_posix()
        for space, type_name, line in types_in(path.read_text(encoding="utf-8")):
            first = types.setdefault((space, type_name), f"{name}:{line}")
            if first != f"{name}:{line}":
                found.append(f"{name}:{line}: {space}::{type_name} is also defined at {first}")
    for path in sorted({p.parent for p in (root / "tests").rglob("*_test.cpp")}):
        folder = path.relative_to(root / "tests").as_posix()
        if folder.split("/")[0] in LAYERS and not (root / "src" / folder).is_dir():
            found.append(f"tests/{folder}: there is no src/{folder}")
    for problem in found:
        print(problem)
    print(f"layers: {len(files)} files, {len(found)} problems")
    return 1 if found or not files else 0


if __name__ == "__main__":
    sys.exit(main())
