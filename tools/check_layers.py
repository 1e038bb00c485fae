#!/usr/bin/env python3
"""Fails when an include breaks the layers of docs/architecture.md or the privacy of a room, a library is included
outside its place, a type is declared ahead in another room, two headers define types of one name in one namespace
(which no compiler sees, and no program survives), or tests are not named after what they test.

A layer includes itself and those that stand before it in LAYERS, which are those below it in the figure of
docs/architecture.md. A room is a folder in geometry/, io/ or stages/. Others include its header of the same name
(geometry/clip/clip.hpp), or one of PUBLIC; all else in it is private. main.cpp of the command line is no exception;
tests may include everything. tools/check_layers_test.py shows that each kind of fault is found."""

import pathlib
import re
import sys

LAYERS = ["base", "platform", "parallel", "options", "mesh", "geometry", "io", "report", "diff", "cache", "cells", "stage", "stages", "pipeline", "docs", "batch", "cli"]

# A layer that must not include another although that stands below it.
FORBIDDEN = {"pipeline": {"stages"}, "docs": {"stages"}, "batch": {"stages"}, "cli": {"stages"}}

# Layers whose folders are rooms.
ROOMED = ("geometry", "io", "stages")

# What is precompiled is included everywhere in its target, so it may include what the lowest layer there may.
PRECOMPILED = {"precompiled.hpp": "parallel", "precompiled_program.hpp": "stage"}

# What others may include of a room besides the header that is named after it, and why. A folder's name stands for all
# headers in it: such a room is a box of tools, and docs/architecture.md names it as one.
PUBLIC = {
    "geometry/cgal": "bridges to CGAL, each called by the room that needs it",
    "geometry/openmesh": "bridges to OpenMesh",
    "geometry/spatial": "trees, rays, closest points: tools, used one by one",
    "geometry/intersect": "pairs of faces that meet: tools, used one by one",
    "geometry/polygon": "polygons in the plane: tools, used one by one",
    "geometry/edit": "changes of a mesh: tools, used one by one",
    "geometry/cut": "what clip and crop have in common",
    "geometry/triangulate": "triangles of faces, for files, pictures and algorithms: tools, used one by one",
    "geometry/boolean": "unions and Boolean operations, whose steps clean shares",
    "geometry/clean/steps.hpp": "repairs that unions end with",
    "geometry/thicken/extrude.hpp": "solids of terrains, straight along an axis",
    "geometry/deviation/deviation_fields.hpp": "the declared fields of a deviation, which reports show",
    "geometry/hull/convex_parts.hpp": "convex decomposition, which hulls follow",
    "geometry/inspect/connectivity.hpp": "components of a mesh",
    "geometry/inspect/evidence.hpp": "where a property fails",
    "geometry/measure/pieces.hpp": "measures of meshes that come in pieces, for cells",
    "geometry/measure/statistics_fields.hpp": "the declared fields of statistics, which reports show",
    "geometry/normals/tangents.hpp": "tangents for maps of normals",
    "geometry/normals/unit_vectors.hpp": "normals and weights as glTF requires them",
    "geometry/measure/shape_histograms.hpp": "histograms of edges and faces, which pages show",
    "geometry/deviation/signed_deviation.hpp": "signed distances, which pages show as colours",
    "geometry/render/colour_scale.hpp": "the colours of scales, for legends of pages",
    "geometry/render/srgb.hpp": "the curve of sRGB, for images that io makes smaller",
    "geometry/render/texture.hpp": "textures that io decodes",
    "io/threemf/zip.hpp": "zip archives, which batches unpack and write",
    "io/outputs": "files that are written all or none",
    "io/images": "pictures and textures: tools, used one by one",
    "io/drawing/drawing_fields.hpp": "the declared fields of a drawing, which reports show",
    "io/gltf/document/accessor.hpp": "where numbers stand in buffers, for cells, which read them piece by piece",
    "io/gltf/document/container.hpp": "the chunks of a GLB and JSON with its places, for cells and tilesets",
    "io/gltf/document/nodes.hpp": "where meshes stand, for cells",
    "io/gltf/contents/byte_kinds.hpp": "what the bytes of a file are spent on",
    "io/gltf/contents/draw_costs.hpp": "what files cost to draw, for the pages of batches",
    "io/gltf/contents/resolved_materials.hpp": "materials as pictures draw them",
    "io/gltf/read/animation_poses.hpp": "poses in which simplify compares",
    "io/gltf/read/skinned_pose.hpp": "scenes as pictures show them",
    "io/gltf/contents/atlas_material.hpp": "materials that textures merges",
    "io/gltf/contents/textures.hpp": "the images of documents, for textures",
    "io/gltf/optimize/document_optimizer.hpp": "documents without what nothing uses, for optimize and tangents",
    "io/tileset/tiles.hpp": "the files of a tileset, for cells, which write them one by one",
}

# First path component (or whole name) of a library's headers, and the only places that may include it.
LIBRARIES = {
    "yaml-cpp": ["src/pipeline/document.cpp"],
    "CLI": ["src/cli/"],
    "tiny_gltf.h": ["src/io/gltf/"],
    "draco": ["src/io/gltf/draco/"],
    "meshoptimizer.h": ["src/io/gltf/"],
    "CGAL": ["src/geometry/cgal/"],
    "boost": ["src/geometry/cgal/"],
    "gmpxx.h": ["src/base/math/exact_integer.hpp"],
    "OpenMesh": ["src/geometry/openmesh/"],
    "seccomp.h": ["src/platform/sandbox.cpp"],
    "nettle": ["src/base/", "src/platform/"],
    "zlib.h": ["src/io/"],
    "zstd.h": ["src/io/packing.cpp"],
    "expat.h": ["src/io/threemf/xml.cpp"],
    "png.h": ["src/io/images/pixels.cpp", "src/io/images/encode_image.cpp"],
    "jpeglib.h": ["src/io/images/pixels.cpp", "src/io/images/encode_image.cpp"],
    "webp": ["src/io/images/pixels.cpp", "src/io/images/encode_image.cpp"],
    "avif": ["src/io/images/avif.cpp"],
}

# Libraries that are met anywhere.
ANYWHERE = {"fmt", "nlohmann", "tbb", "Eigen"}

# Headers of the operating system, or their folders: only src/platform/ may include them.
SYSTEM = {"arpa", "asm", "csignal", "dirent.h", "dlfcn.h", "elf.h", "fcntl.h", "glob.h", "grp.h", "link.h", "linux", "malloc.h",
          "net", "netdb.h", "netinet", "poll.h", "pthread.h", "pwd.h", "sched.h", "semaphore.h", "signal.h", "spawn.h", "sys",
          "syslog.h", "termios.h", "ucontext.h", "unistd.h", "utime.h",
          "io.h", "psapi.h", "shellapi.h", "windows.h"}

# The version of a library is no use of it: these headers hold only macros.
VERSION_HEADERS = {"CGAL/version.h", "CLI/Version.hpp", "draco/core/draco_version.h", "OpenMesh/Core/System/config.h"}

# Rooms without a folder or a file of tests that has their name, and where they are tested.
TESTED_IN = {
    "geometry/openmesh": "geometry/simplify/simplify_test.cpp",  # method: constrained
    "geometry/probe": "stages/probe_test.cpp",
    "io/off": "io/round_trip_test.cpp",
    "io/import": "golden/import_test.py",
}

# Tests that are of no one file or folder, and of what.
OF_MANY = {
    "io/corpus_test.cpp": "every codec, on a folder of files",
    "io/lines_test.cpp": "lines of OBJ and of glTF",
    "io/malformed_test.cpp": "every codec, on malformed files",
    "io/mutation_test.cpp": "every codec, on files with random changes",
    "io/round_trip_test.cpp": "every codec, written and read",
}

SUFFIXES = (".hpp", ".cpp", ".h", ".inl", ".ipp", ".tpp")

# Comments, literals (kept empty) and lines of the preprocessor (blanked): what is left is structure.
NOT_CODE = re.compile(r"""//[^\n]*|/\*.*?\*/|R"(?P<d>[^(\s]*)\(.*?\)(?P=d)"|"(?:\\.|[^"\\\n])*"|'(?:\\.|[^'\\\n])+'"""
                      r"""|^[ \t]*\#(?:[^\n]*\\\n)*[^\n]*""", re.S | re.M)
INCLUDE = re.compile(r'^[ \t]*#[ \t]*include[ \t]*(?:(?P<close>[<"])(?P<name>[^">]+)[">]|(?P<macro>\w+))', re.M)
HEAD = r"(?P<kind>struct|class|union|enum(?: class| struct)?)\b(?:\s*\[\[.*?\]\]|\s*alignas\(.*?\))*\s*"
AHEAD = re.compile(rf"^{HEAD}(?P<name>[\w:]+)(?:\s*:\s*[\w:]+)?$")
DEFINITION = re.compile(rf"^{HEAD}(?P<name>\w+(?:::\w+)*)(?:\s+final)?(?:\s*:(?!:).*)?$", re.S)
NAMESPACE = re.compile(r"^(?:inline )?namespace\b\s*(?P<name>[\w:]*)")
ELABORATED = re.compile(r"\b(?:struct|class) (?P<name>[\w:]+)\s*[*&]")


def code_of(text):
    """The text with comments, literals and the preprocessor's lines blanked; lines stay where they are."""
    def blank(match):
        quotes = '""' if match[0][0] in "\"'R" else ""
        return quotes + "\n" * match[0].count("\n")
    return NOT_CODE.sub(blank, text)


def without_template(statement):
    """The declaration without "template <...>" and "requires" in front of it."""
    while statement.startswith("template"):
        depth, at = 0, statement.find("<")
        for at in range(at, len(statement)):
            depth += {"<": 1, ">": -1}.get(statement[at], 0)
            if depth == 0:
                break
        statement = statement[at + 1:].strip()
    return statement


class Types:
    """The types of a file: (namespace, name, line) of those that it defines, and of those that it declares ahead or
    names only by "struct X*", outside of any type or function (ahead) and anywhere (named)."""

    def __init__(self, text):
        self.defined, self.ahead, self.named = [], [], []
        code = code_of(text)
        scopes, begin = [], 0  # of each open brace: the namespace, or None for whatever else
        for match in re.finditer(r"[{};]", code):
            raw = code[begin:match.start()]
            statement = without_template(" ".join(raw.split()))
            line = code.count("\n", 0, begin + len(raw) - len(raw.lstrip())) + 1
            outermost = None not in scopes
            space = "::".join(s for s in scopes if s)
            self.named += [(space, m["name"], line) for m in ELABORATED.finditer(statement)]
            if match[0] == "{":
                inner = NAMESPACE.match(statement)
                if inner or statement == 'extern ""':
                    scopes.append((inner["name"] or "(anonymous)") if inner else "")
                else:
                    type_ = DEFINITION.match(statement)
                    if type_ and outermost:
                        self.defined.append((space, type_["name"], line))
                    scopes.append(None)
            elif match[0] == "}":
                if scopes:
                    scopes.pop()
            elif outermost and (type_ := AHEAD.match(statement)):
                self.ahead.append((space, type_["name"], line))
            begin = match.end()


def layer_of(name):
    """Of src/base/math/vec.hpp: base."""
    parts = name.split("/")
    return PRECOMPILED.get(parts[1]) if len(parts) == 2 else parts[1]


def room_of(name):
    """("geometry", "clip") of geometry/clip/walls.hpp; none for what lies in no room."""
    parts = name.split("/")
    return parts[:2] if len(parts) > 2 and parts[0] in ROOMED else None


def home_of(name):
    """The room of src/geometry/clip/walls.hpp (geometry/clip), else the layer."""
    room = room_of(name.removeprefix("src/"))
    return "/".join(room) if room else layer_of(name)


def is_private(header, includer):
    """Whether the header is private to a room that the includer is not in. Both without src/."""
    room = room_of(header)
    if room is None or room_of(includer) == room:
        return False
    return header not in PUBLIC and "/".join(room) not in PUBLIC and header != "/".join([*room, room[1] + ".hpp"])


class Tree:
    """What is read of a checkout, and what is wrong with it."""

    def __init__(self, root):
        self.root, self.found, self.used = root, [], set()
        paths = sorted(p for p in (root / "src").rglob("*") if p.suffix in SUFFIXES)
        self.texts = {p.relative_to(root).as_posix(): p.read_text(encoding="utf-8") for p in paths}
        self.types = {name: Types(text) for name, text in self.texts.items()}

    def check(self):
        for name, text in self.texts.items():
            if layer_of(name) not in LAYERS:
                self.found.append(f"{name}: it stands in no layer (LAYERS and PRECOMPILED in tools/check_layers.py)")
                continue
            for match in INCLUDE.finditer(text):
                at = f"{name}:{text.count(chr(10), 0, match.start()) + 1}"
                self.found.extend(f"{at}: {problem}" for problem in self.include(name, match))
        self.public()
        self.ahead()
        self.twice()
        self.tests()
        return self.found

    def include(self, name, match):
        """What is wrong with an include of src/NAME."""
        if match["macro"]:
            yield f"{match['macro']} is included by a macro: name the header"
            return
        header, folder = match["name"], pathlib.PurePosixPath(name).parent.as_posix()
        if header.startswith("/") or any(part in ("", ".", "..") for part in header.split("/")):
            yield f"{header}: name it by its path from src/, without ."
        resolved = self.resolved(header, folder)
        if resolved is not None and resolved != header:
            yield f"{header} is {resolved}: name it by its path from src/"
        if resolved is not None:
            yield from self.own(name, resolved)
        else:
            yield from self.library(name, header)

    def resolved(self, header, folder):
        """The path from src/ of the file that the header is; none when it is none of ours."""
        for place in (folder, "src"):
            path = (self.root / place / header).resolve()
            if path.is_file() and path.is_relative_to(self.root / "src"):
                return path.relative_to(self.root / "src").as_posix()
        return None

    def own(self, name, header):
        layer, top = layer_of(name), layer_of("src/" + header)
        if top not in LAYERS:
            return
        if LAYERS.index(top) > LAYERS.index(layer):
            yield f"{layer}/ must not include {header}: {top}/ stands above it"
        elif top in FORBIDDEN.get(layer, ()):
            yield f"{layer}/ must not include {header}: it knows stage/, never a stage"
        if is_private(header, name.removeprefix("src/")):
            yield f"{header} is private to its room (PUBLIC in tools/check_layers.py lists exceptions)"
        elif room_of(header) and room_of(header) != room_of(name.removeprefix("src/")):
            self.used |= {header, "/".join(room_of(header))}

    def library(self, name, header):
        top = header.split("/")[0]
        if header in VERSION_HEADERS:
            return
        if top in SYSTEM:
            if not name.startswith("src/platform/"):
                yield f"{header} is of the operating system, whose calls go through src/platform/"
        elif top in LIBRARIES:
            if not any(name.startswith(place) for place in LIBRARIES[top]):
                yield f"{header} may be included only in {', '.join(LIBRARIES[top])}"
        elif "/" in header and top not in ANYWHERE:
            yield f"{header} is of a library that tools/check_layers.py does not know (LIBRARIES, ANYWHERE)"

    def public(self):
        """Exceptions that are none."""
        for entry in PUBLIC:
            if not (self.root / "src" / entry).exists():
                self.found.append(f"tools/check_layers.py: {entry} of PUBLIC does not exist")
            elif entry not in self.used:
                self.found.append(f"tools/check_layers.py: nothing outside its room includes {entry} of PUBLIC")
        page = self.root / "docs/architecture.md"
        paragraphs = page.read_text(encoding="utf-8").split("\n\n") if page.exists() else []
        boxes = "".join(p for p in paragraphs if "boxes of tools" in p or "box of tools" in p)
        for entry in PUBLIC:
            if not entry.endswith(".hpp") and f"`{entry.split('/')[1]}`" not in boxes:
                self.found.append(f"docs/architecture.md: it does not name {entry} as a box of tools")

    def ahead(self):
        """Types that are declared ahead although another room or layer defines them: their use would be an include
        that nobody sees."""
        homes = {}
        for name, types in self.types.items():
            for space, type_, _ in types.defined:
                homes.setdefault((space, type_), set()).add(home_of(name))
        for name, types in self.types.items():
            for space, type_, line in sorted(set(types.ahead + types.named)):
                full = f"{space}::{type_}".split("::")
                inner = full[:-1] if "::" not in type_ else full[:full.index(type_.split("::")[0])]
                of = set()
                for depth in range(len(inner), -1, -1):
                    rest = full[len(inner):]
                    of = of or homes.get(("::".join(inner[:depth] + rest[:-1]), rest[-1]), set())
                if of and home_of(name) not in of:
                    self.found.append(f"{name}:{line}: {type_} is of {', '.join(sorted(of))}/: include its header, "
                                      "or move it")

    def twice(self):
        """Types of one name in one namespace, in two headers of the sources and the tests."""
        headers = {name: types for name, types in self.types.items() if not name.endswith(".cpp")}
        for path in sorted((self.root / "tests").rglob("*.hpp")):
            headers[path.relative_to(self.root).as_posix()] = Types(path.read_text(encoding="utf-8"))
        first = {}
        for name, types in headers.items():
            for space, type_, line in types.defined:
                if "(anonymous)" in space:
                    continue
                there = first.setdefault((space, type_), f"{name}:{line}")
                if there != f"{name}:{line}":
                    self.found.append(f"{name}:{line}: {space}::{type_} is also defined at {there}")

    def tests(self):
        """Tests are named after the file or the room that they test (clip_test.cpp, clip_box_test.cpp), and every room
        has some."""
        src, tests = self.root / "src", self.root / "tests"
        files = {p.relative_to(tests).as_posix() for p in tests.rglob("*_test.cpp")}
        for name in sorted(files):
            folder, _, file = name.rpartition("/")
            if folder.split("/")[0] not in LAYERS or name in OF_MANY:
                continue
            if not (src / folder).is_dir():
                self.found.append(f"tests/{name}: there is no src/{folder}")
                continue
            stems = {p.stem for p in (src / folder).iterdir()} | {folder.rpartition("/")[2]}
            if not any(file.startswith(stem + "_") for stem in stems):
                self.found.append(f"tests/{name}: src/{folder} has nothing of that name (OF_MANY has exceptions)")
        rooms = {"/".join(r) for r in (room_of(n.removeprefix("src/")) for n in self.texts) if r}
        layers = {layer_of(n) for n in self.texts if n.count("/") > 1} & set(LAYERS) - set(ROOMED)
        for room in sorted(rooms | layers):
            tested = f"{room}_test.cpp" in files or any(f.startswith(room + "/") for f in files)
            if tested == (room in TESTED_IN):
                self.found.append(f"tests/{room}: " + ("TESTED_IN need not name it" if tested else "there are no tests"))
        for entry in [*OF_MANY, *TESTED_IN.values()]:
            if not (tests / entry).exists():
                self.found.append(f"tools/check_layers.py: there is no tests/{entry}")


def main():
    root = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else pathlib.Path(__file__).parent.parent).resolve()
    tree = Tree(root)
    for problem in tree.check():
        print(problem)
    print(f"layers: {len(tree.texts)} files, {len(tree.found)} problems")
    return 1 if tree.found or not tree.texts else 0


if __name__ == "__main__":
    sys.exit(main())
