#!/usr/bin/env python3
"""Shows that check_layers.py finds each kind of fault: each case plants one in a small tree that has none."""

import pathlib
import tempfile
import unittest

import check_layers

FILES = {
    "src/precompiled.hpp": '#include "base/math/vec.hpp"\n#include <vector>\n',
    "src/precompiled_program.hpp": '#include "stage/stage.hpp"\n',
    "src/base/math/vec.hpp": "namespace facetmill { struct Vec { int x; }; }\n",
    "src/mesh/mesh.hpp": '#include "base/math/vec.hpp"\nnamespace facetmill {\nstruct Mesh {\n    Vec at;\n};\n}\n',
    "src/geometry/clip/clip.hpp": '#include "mesh/mesh.hpp"\nnamespace facetmill {\nMesh clip(const Mesh&);\n}\n',
    "src/geometry/clip/walls.hpp": "namespace facetmill {\ntemplate <class T>\nclass Walls {\n};\nstruct Mesh2 {};\n}\n",
    "src/geometry/clip/clip.cpp": '#include "geometry/clip/clip.hpp"\n#include "geometry/clip/walls.hpp"\n',
    "src/geometry/crop/crop.hpp": '#include "geometry/clip/clip.hpp"\n#include "geometry/spatial/tree.hpp"\n',
    "src/geometry/crop/crop.cpp": '#include "geometry/crop/crop.hpp"\n#include "geometry/inspect/evidence.hpp"\n',
    "src/geometry/spatial/tree.hpp": "namespace facetmill { class Tree; }\nnamespace facetmill { class Tree {}; }\n",
    "src/geometry/inspect/evidence.hpp": "#include <optional>\n",
    "src/io/bytes.cpp": "#include <zlib.h>\n",
    "src/stage/stage.hpp": '#include "mesh/mesh.hpp"\n',
    "src/stages/clip/run.cpp": '#include "geometry/clip/clip.hpp"\n#include "stage/stage.hpp"\n',
    "src/stages/clip/clip.hpp": "// nothing\n",
    "src/pipeline/plan.cpp": '#include "stage/stage.hpp"\n',
    "tests/base/math/vec_test.cpp": "",
    "tests/mesh/mesh_test.cpp": "",
    "tests/geometry/clip/clip_test.cpp": '#include "geometry/clip/walls.hpp"\n',
    "tests/geometry/clip/walls_thin_test.cpp": "",
    "tests/geometry/crop/crop_test.cpp": "",
    "tests/geometry/spatial/tree_test.cpp": "",
    "tests/stages/clip_test.cpp": "",
    "tests/stage/stage_test.cpp": "",
    "tests/pipeline/plan_test.cpp": "",
    "tests/property/law_test.cpp": "",
    "tests/support/meshes.hpp": "namespace facetmill::test {\nstruct Mesh {};\n}\n",
    "docs/architecture.md": "`spatial` is a box of tools.\n\nNothing else is.\n",
}

PUBLIC = {"geometry/spatial": "tools", "geometry/inspect/evidence.hpp": "where a property fails"}


class CheckLayers(unittest.TestCase):
    def problems(self, **changes):
        """What is said of the tree with these files added, replaced or, as None, removed."""
        with tempfile.TemporaryDirectory() as folder:
            root = pathlib.Path(folder).resolve()
            for name, text in {**FILES, **changes.get("files", {})}.items():
                if text is None:
                    continue
                (root / name).parent.mkdir(parents=True, exist_ok=True)
                (root / name).write_text(text, encoding="utf-8")
            constants = {"PUBLIC": PUBLIC, "OF_MANY": {}, "TESTED_IN": {"geometry/inspect": "geometry/clip/clip_test.cpp"}}
            constants.update({k: v for k, v in changes.items() if k != "files"})
            kept = {name: getattr(check_layers, name) for name in constants}
            try:
                for name, value in constants.items():
                    setattr(check_layers, name, value)
                return check_layers.Tree(root).check()
            finally:
                for name, value in kept.items():
                    setattr(check_layers, name, value)

    def finds(self, said, **changes):
        found = self.problems(**changes)
        self.assertTrue(found, f"not found: {said}")
        self.assertEqual([p for p in found if said not in p], [])

    def adds(self, name, text, said):
        """A file, or lines at the end of one."""
        self.finds(said, files={name: FILES.get(name, "") + text})

    def test_the_tree_itself_has_no_faults(self):
        self.assertEqual(self.problems(), [])

    def test_layers(self):
        self.adds("src/base/math/vec.hpp", '#include "mesh/mesh.hpp"\n', "mesh/ stands above it")
        self.adds("src/mesh/mesh.hpp", '  #  include <stage/stage.hpp>\n', "stage/ stands above it")
        self.adds("src/mesh/part.inl", '#include "stage/stage.hpp"\n', "stage/ stands above it")
        self.adds("src/mesh/part.ipp", '#include "stage/stage.hpp"\n', "stage/ stands above it")
        self.adds("src/pipeline/plan.cpp", '#include "stages/clip/clip.hpp"\n', "never a stage")
        self.adds("src/other/file.hpp", "", "stands in no layer")
        self.adds("src/more.hpp", "", "stands in no layer")

    def test_private_headers(self):
        walls = '#include "geometry/clip/walls.hpp"\n'
        private = "geometry/clip/walls.hpp is private to its room"
        for name in ("src/geometry/crop/crop.cpp", "src/stages/clip/run.cpp", "src/geometry/crop/crop.inl"):
            self.adds(name, walls, private)
        found = self.problems(files={
            "src/geometry/clip/count_fields.hpp": "",
            "src/geometry/crop/crop.cpp": FILES["src/geometry/crop/crop.cpp"]
                                          + '#include "geometry/clip/count_fields.hpp"\n'})
        self.assertIn("geometry/clip/count_fields.hpp is private", found[0])

    def test_paths_of_includes(self):
        for include in ("../clip/walls.hpp", "../../geometry/clip/walls.hpp", "geometry/./clip/walls.hpp",
                        "geometry//clip/walls.hpp"):
            found = self.problems(files={"src/geometry/crop/crop.cpp": FILES["src/geometry/crop/crop.cpp"]
                                                                       + f'#include "{include}"\n'})
            self.assertTrue(any("by its path from src/" in p for p in found), include)
            self.assertTrue(any("private to its room" in p for p in found), include)
        found = self.problems(files={"src/mesh/mesh.hpp": '#include "../geometry/clip/walls.hpp"\n'})
        self.assertTrue(any("geometry/ stands above it" in p for p in found))
        self.adds("src/geometry/clip/clip.cpp", '#include "walls.hpp"\n', "name it by its path from src/")
        self.adds("src/geometry/clip/clip.cpp", '#define W "x"\n#include W\n', "included by a macro")

    def test_precompiled_headers(self):
        self.adds("src/precompiled.hpp", '#include "mesh/mesh.hpp"\n', "mesh/ stands above it")
        self.adds("src/precompiled.hpp", "#include <CGAL/Surface_mesh.h>\n", "only in src/geometry/cgal/")
        self.adds("src/precompiled_program.hpp", '#include "geometry/clip/walls.hpp"\n', "private to its room")
        self.adds("src/precompiled_program.hpp", '#include "stages/clip/clip.hpp"\n', "stages/ stands above it")

    def test_types_declared_ahead(self):
        said = "include its header, or move it"
        for text in ("namespace facetmill { class Walls; }\n",
                     "namespace facetmill {\ntemplate <class T>\nclass Walls;\n}\n",
                     "namespace facetmill { template <class T> class Walls; }\n",
                     "namespace facetmill {\n  struct Mesh2 ;\n}\n",
                     "struct facetmill::Mesh2;\n",
                     "namespace facetmill {\nvoid f(const struct Mesh2& of);\n}\n"):
            self.adds("src/geometry/crop/crop.hpp", text, said)
        self.adds("src/base/math/vec.hpp", "namespace facetmill { struct Mesh; }\n", said)
        self.assertEqual(self.problems(files={  # of another namespace, within a type, in a comment or a literal, at home
            "src/geometry/clip/more.hpp": "namespace facetmill { struct Mesh2; }\n",
            "src/geometry/crop/more.hpp": "namespace other { struct Mesh2; }\nnamespace facetmill {\n"
                                          "struct Own {\n    struct Mesh2;\n};\n// struct Mesh2;\n"
                                          'inline const char* text = R"(\nstruct Mesh2;\n)";\n}\n'}), [])

    def test_types_defined_twice(self):
        self.adds("src/geometry/crop/more.hpp", "namespace facetmill { struct Mesh2 : Vec {}; }\n", "is also defined at")
        self.adds("tests/support/more.hpp", "namespace facetmill::test {\nstruct Mesh final {};\n}\n", "is also defined at")

    def test_libraries(self):
        for library, header in (("cgal", "CGAL/Surface_mesh.h"), ("openmesh", "OpenMesh/Core/Mesh.hh"),
                                ("", "seccomp.h"), ("", "nettle/sha2.h"), ("", "meshoptimizer.h"), ("", "png.h"), ("", "jpeglib.h"),
                                ("", "webp/decode.h"), ("", "yaml-cpp/yaml.h"), ("", "CLI/CLI.hpp"), ("", "zlib.h"),
                                ("", "tiny_gltf.h"), ("", "draco/core/decoder.h"), ("", "gmpxx.h")):
            with self.subTest(header):
                self.adds("src/geometry/clip/clip.cpp", f"#include <{header}>\n", "may be included only in")
        self.adds("src/io/bytes.cpp", "#include <mystery/all.hpp>\n", "of a library that")
        self.assertEqual(self.problems(files={"src/io/bytes.cpp": "#include <CGAL/version.h>\n"}), [])

    def test_headers_of_the_system(self):
        for header in ("unistd.h", "fcntl.h", "sys/stat.h", "linux/seccomp.h", "csignal", "signal.h", "poll.h"):
            with self.subTest(header):
                self.adds("src/io/bytes.cpp", f"#include <{header}>\n", "go through src/platform/")
        self.assertEqual(self.problems(files={"src/io/bytes.cpp": "#include <cerrno>\n"}), [])

    def test_exceptions_that_are_none(self):
        self.finds("gone.hpp of PUBLIC does not exist", PUBLIC={**PUBLIC, "geometry/clip/gone.hpp": ""})
        self.finds("includes geometry/clip/walls.hpp of PUBLIC", PUBLIC={**PUBLIC, "geometry/clip/walls.hpp": ""})
        self.finds("it does not name geometry/clip", PUBLIC={**PUBLIC, "geometry/clip": ""})
        self.finds("there is no tests/io/gone_test.cpp", OF_MANY={"io/gone_test.cpp": ""})

    def test_names_of_tests(self):
        self.adds("tests/geometry/gone/gone_test.cpp", "", "there is no src/geometry/gone")
        self.adds("tests/geometry/crop/give_test.cpp", "", "has nothing of that name")
        self.adds("src/geometry/tile/tile.hpp", "", "tests/geometry/tile: there are no tests")
        self.finds("TESTED_IN need not name it",
                   TESTED_IN={"geometry/inspect": "geometry/clip/clip_test.cpp",
                              "geometry/crop": "geometry/clip/clip_test.cpp"})


if __name__ == "__main__":
    unittest.main()
