#!/usr/bin/env python3
"""Fails when an include breaks the layers of the house, a library is included outside its place, or two headers
define types of one name in one namespace (which no compiler sees, and no program survives).

A layer includes itself and the layers above it in LAYERS, never one below. main.cpp of the command line is no
exception; tests may include everything."""

import pathlib
import re
import sys

LAYERS = ["base", "options", "mesh", "geometry", "io", "report", "diff", "stage", "stages", "pipeline", "docs", "cli"]

# A layer that must not include another although it stands below it.
FORBIDDEN = {"pipeline": {"stages"}, "docs": {"stages"}, "cli": {"stages"}}

# First path component (or whole name) of a library's headers, and the only places that may include it.
LIBRARIES = {
    "yaml-cpp": ["src/pipeline/document.cpp"],
    "CLI": ["src/cli/"],
    "tiny_gltf.h": ["src/io/gltf/"],
    "draco": ["src/io/gltf/draco/"],
    "CGAL": ["src/geometry/cgal/"],
    "OpenMesh": ["src/geometry/openmesh/"],
    "boost": ["src/geometry/cgal/"],
}

# The version of a library is no use of it: these headers hold only macros.
VERSION_HEADERS = {"CGAL/version.h", "CLI/Version.hpp", "draco/core/draco_version.h", "OpenMesh/Core/System/config.h"}

INCLUDE = re.compile(r'^\s*#\s*include\s*[<"]([^">]+)[">]', re.M)


NAMESPACE = re.compile(r"^namespace ([\w:]+) \{", re.M)
TYPE = re.compile(r"^(?:struct|class|enum class|enum) (\w+)(?: final)?(?: :[^:;{]*)? \{", re.M)


def types_in(text):
    """(namespace, name, line) of each type that is defined at the outermost level of a namespace."""
    spaces = [(m.start(), m.group(1)) for m in NAMESPACE.finditer(text)]
    for match in TYPE.finditer(text):
        around = [space for start, space in spaces if start < match.start()]
        yield around[-1] if around else "", match.group(1), text.count("\n", 0, match.start()) + 1


def problems_in(path, name, text):
    layer = name.split("/")[1]
    for match in INCLUDE.finditer(text):
        header, line = match.group(1), text.count("\n", 0, match.start()) + 1
        top = header.split("/")[0]
        if top in LAYERS and layer in LAYERS and (path.parents[len(name.split("/")) - 2] / header).exists():
            if LAYERS.index(top) > LAYERS.index(layer) or top in FORBIDDEN.get(layer, ()):
                yield f"{name}:{line}: {layer}/ must not include {header}: {top}/ is a layer below it"
        allowed = LIBRARIES.get(top)
        if allowed is None or header in VERSION_HEADERS:
            continue
        if not any(name.startswith(place) for place in allowed):
            yield f"{name}:{line}: {header} may be included only in {', '.join(allowed)}"


def main():
    root = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else pathlib.Path(__file__).parent.parent).resolve()
    files = sorted(p for p in (root / "src").rglob("*") if p.suffix in (".hpp", ".cpp", ".h"))
    found, types = [], {}
    for path in files:
        name = path.relative_to(root).as_posix()
        if name.count("/") < 2:
            continue  # src/precompiled.hpp
        if name.split("/")[1] not in LAYERS:
            found.append(f"{name}: {name.split('/')[1]}/ is no layer")
        text = path.read_text(encoding="utf-8")
        found.extend(problems_in(path, name, text))
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
    for problem in found:
        print(problem)
    print(f"layers: {len(files)} files, {len(found)} problems")
    return 1 if found or not files else 0


if __name__ == "__main__":
    sys.exit(main())
