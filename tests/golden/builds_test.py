"""facetmill as a rule of Make, Ninja and CMake: a second build does nothing, and what a mesh depends on rebuilds it."""

import json
import os
import re
import subprocess
import time

from support import FACETMILL, Case, main

TRIANGLE = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"


def for_ninja(name):
    return re.sub(r"([$ :])", r"$\1", name)


def for_make(name):
    return re.sub(r"([ #:])", r"\\\1", name.replace("$", "$$"))


class Builds(Case):
    """src/ has t.gltf with t.bin and tex.png, and p.yaml with a report; bin/mill notes each of its runs."""

    def setUp(self):
        super().setUp()
        for folder in ("src", "bin", "out"):
            (self.dir / folder).mkdir()
        self.gltf_with_neighbours(self.dir / "src")
        self.write("src/p.yaml", "facetmill: 1\nparams: {input: {type: path}}\n"
                                 "stages: [{load: '${input}'}, {write: o.glb}]\nreport: r.json\n")
        self.write("bin/mill", f'#!/bin/sh\necho run >>"{self.dir}/runs"\nexec "{FACETMILL}" "$@"\n').chmod(0o755)
        self.write("runs", "")
        self.mill_line = f"{self.dir}/bin/mill run ../src/p.yaml -D input=../src/t.gltf --depfile o.d --quiet"

    def runs(self):
        return (self.dir / "runs").read_text().count("run")

    def build(self, *command, expect=None):
        """Builds in out/ and returns how often facetmill ran."""
        before = self.runs()
        build = subprocess.run(command, cwd=self.dir / "out", capture_output=True, text=True, timeout=300)
        self.assertEqual(build.returncode, 0, build.stdout + build.stderr)
        self.said = build.stdout + build.stderr
        return self.runs() - before

    def touch(self, name):
        time.sleep(0.02)  # file systems count time in steps
        os.utime(self.dir / "src" / name)

    def check_incremental(self, *command, forgets=True):
        """forgets: the build system no longer asks for what the last run did not name."""
        texture = self.dir / "src/tex.png"
        picture = texture.read_bytes()
        texture.unlink()
        self.check_due("no texture: ", *command, warned=True)
        self.write("src/unrelated.txt", "")
        self.assertEqual(self.build(*command), 0, "another file in the folder: " + self.said)
        texture.write_bytes(picture)
        self.touch("t.gltf")
        self.check_due("the texture appeared: ", *command, warned=False)
        for name in ("t.gltf", "t.bin", "tex.png", "p.yaml"):
            self.touch(name)
            self.check_due(name, *command, warned=False)
        texture.unlink()
        self.assertEqual(self.build(*command), 1, self.said)
        if forgets:
            self.assertEqual(self.build(*command), 0, "the texture is gone: " + self.said)
        texture.write_bytes(picture)
        self.touch("t.gltf")
        self.check_due("the texture is back: ", *command, warned=False)

    def check_due(self, why, *command, warned):
        """One run is due, then none."""
        self.assertEqual(self.build(*command), 1, why + self.said)
        self.assertEqual("W-IMAGE" in self.said, warned)
        self.assertEqual(self.build(*command), 0, why + self.said)
        time.sleep(0.02)

    def ninja_file(self, deps=""):
        self.write("out/build.ninja", f"rule mill\n  command = {self.mill_line}\n  depfile = o.d\n{deps}"
                                      "build o.glb | r.json: mill\n")

    def test_ninja(self):
        self.need("ninja")
        self.ninja_file()
        self.check_incremental("ninja")

    def test_ninja_that_keeps_the_dependencies_itself(self):
        self.need("ninja")
        self.ninja_file("  deps = gcc\n")
        self.check_incremental("ninja")

    def test_make(self):
        self.write("out/Makefile", f"o.glb:\n\t{self.mill_line}\n-include o.d\n")
        self.check_incremental("make", "o.glb")

    def check_cmake(self, generator, **how):
        self.need("cmake")
        self.write("src/CMakeLists.txt",
                   "cmake_minimum_required(VERSION 3.21)\nproject(assets LANGUAGES NONE)\n"
                   "set(mill ${CMAKE_CURRENT_SOURCE_DIR}/../bin/mill)\n"
                   "add_custom_command(OUTPUT o.glb r.json DEPFILE ${CMAKE_CURRENT_BINARY_DIR}/o.d\n"
                   "  COMMAND ${mill} run ${CMAKE_CURRENT_SOURCE_DIR}/p.yaml -D input=${CMAKE_CURRENT_SOURCE_DIR}/t.gltf\n"
                   "          --output-dir ${CMAKE_CURRENT_BINARY_DIR} --depfile ${CMAKE_CURRENT_BINARY_DIR}/o.d --quiet)\n"
                   "add_custom_target(models ALL DEPENDS o.glb)\n")
        self.build("cmake", "-G", generator, "../src")
        self.check_incremental("cmake", "--build", ".", **how)

    def test_cmake_with_ninja(self):
        self.need("ninja")
        self.check_cmake("Ninja")

    def test_cmake_with_make(self):
        self.check_cmake("Unix Makefiles", forgets=False)  # it asks for all that any run named

    def test_a_missing_texture_beside_the_output(self):
        (self.dir / "src/tex.png").unlink()
        line = self.mill_line.replace("--depfile o.d", "--depfile o.d -o ../src")
        self.write("out/Makefile", f"../src/o.glb:\n\t{line}\n-include o.d\n")
        self.assertEqual(self.build("make", "../src/o.glb"), 1)
        self.assertEqual(self.build("make", "../src/o.glb"), 0, "the folder is not newer than what was written: " + self.said)

    def test_an_output_beside_its_input(self):
        line = self.mill_line.replace("--depfile o.d", "--depfile o.d -o ../src")
        self.write("out/Makefile", f"../src/o.glb:\n\t{line}\n-include o.d\n")
        self.assertEqual([self.build("make", "../src/o.glb") for _ in range(2)], [1, 0], self.said)

    def test_a_missing_library_of_materials(self):
        self.write("src/m.obj", "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl red\nf 1 2 3\n")
        self.write("out/Makefile", "o.glb:\n\t" + self.mill_line.replace("t.gltf", "m.obj") + "\n-include o.d\n")
        self.assertEqual([self.build("make", "o.glb") for _ in range(2)], [1, 0])
        depfile = (self.dir / "out/o.d").read_text().split()
        self.assertEqual(sorted(n.rstrip(":") for n in depfile[1:] if n != "\\"), ["../src/m.obj"] * 2 + ["../src/p.yaml"] * 2)
        self.write("src/m.mtl", "newmtl red\nKd 1 0 0\n")
        self.assertEqual(self.build("make", "o.glb"), 0)
        self.touch("m.obj")
        self.assertEqual([self.build("make", "o.glb") for _ in range(2)], [1, 0])
        time.sleep(0.02)
        self.write("src/m.mtl", "newmtl red\nKd 0 1 0\n")
        self.assertEqual([self.build("make", "o.glb") for _ in range(2)], [1, 0])

    def test_a_missing_buffer_fails_until_it_is_there(self):
        self.write("out/Makefile", f"o.glb:\n\t{self.mill_line}\n-include o.d\n")
        self.assertEqual(self.build("make", "o.glb"), 1)
        buffer = self.dir / "src/t.bin"
        data = buffer.read_bytes()
        buffer.unlink()
        make = subprocess.run(["make", "o.glb"], cwd=self.dir / "out", capture_output=True, text=True)
        self.assertIn("t.bin", make.stderr)
        self.assertEqual(make.returncode, 2)
        buffer.write_bytes(data)
        self.assertEqual([self.build("make", "o.glb") for _ in range(2)], [1, 0])

    def test_a_baseline_is_read_too(self):
        self.write("src/t.off", TRIANGLE)
        self.write("src/p.yaml", "facetmill: 1\nstages: [{load: t.off}, {validate: {closed: true, baseline: k.json}}, {write: o.ply}]\n")
        self.mill("run", "src/p.yaml", "--update-baseline", "-o", "src")
        self.mill("run", "src/p.yaml", "--depfile", "o.d")
        self.assertIn("src/k.json", (self.dir / "o.d").read_text())

    def test_names_that_make_and_ninja_read_differently(self):
        self.need("ninja")
        for name in ("a b", "a#b", "a$b", "a%b", "a:b", "grün", "a(b)", "a@b"):
            self.write(f"src/{name}.off", TRIANGLE)
            self.write("src/p.yaml", f"facetmill: 1\nstages: [{{load: '{name}.off'}}, {{write: 'o.ply'}}]\n")
            line = f"{self.dir}/bin/mill run ../src/p.yaml --depfile o.d --quiet"
            self.write("out/Makefile", f"o.ply:\n\t{line}\n-include o.d\n")
            self.write("out/build.ninja", f"rule mill\n  command = {line}\n  depfile = o.d\nbuild o.ply: mill\n")
            for command in (("make", "o.ply"), ("ninja",)):
                (self.dir / "out/o.ply").unlink(missing_ok=True)
                self.assertEqual([self.build(*command) for _ in range(2)], [1, 0], (command, name, self.said))
                self.touch(f"{name}.off")
                self.assertEqual([self.build(*command) for _ in range(2)], [1, 0], (command, name, self.said))

    def test_names_of_targets(self):
        self.need("ninja")
        self.write("src/t.off", TRIANGLE)
        for name in ("a b", "a#b", "a$b", "grün"):
            self.write("src/p.yaml", f"facetmill: 1\nstages: [{{load: t.off}}, {{write: '{name}.ply'}}]\n")
            line = f"{self.dir}/bin/mill run ../src/p.yaml --depfile o.d --quiet"
            self.write("out/Makefile", f"{for_make(name)}.ply:\n\t{line}\n-include o.d\n")
            self.write("out/build.ninja", f"rule mill\n  command = {line}\n  depfile = o.d\nbuild {for_ninja(name)}.ply: mill\n")
            for command in (("make",), ("ninja",)):
                (self.dir / f"out/{name}.ply").unlink(missing_ok=True)
                self.assertEqual([self.build(*command) for _ in range(2)], [1, 0], (command, name, self.said))
                self.touch("t.off")
                self.assertEqual([self.build(*command) for _ in range(2)], [1, 0], (command, name, self.said))

    def test_the_target_of_the_depfile(self):
        self.mill("run", "src/p.yaml", "-D", "input=src/t.gltf", "--depfile", "o.d")
        self.assertEqual((self.dir / "o.d").read_text().split(":")[0], "o.glb")
        self.mill("run", "src/p.yaml", "-D", "input=src/t.gltf", "--depfile", "o.d", "--depfile-target", "stamp")
        self.assertEqual((self.dir / "o.d").read_text().split(":")[0], "stamp")


class Folders(Case):
    """A folder that cannot take the outputs is found before the work."""

    def setUp(self):
        super().setUp()
        self.write("t.off", TRIANGLE)
        self.write("p.yaml", "facetmill: 1\nstages: [{load: t.off}, {relax: 3}, {write: a.ply}, {write: b.ply}]\n")

    def check_refused(self, folder, message):
        run = self.mill("run", "p.yaml", "--log", "json", "-v", "-o", folder, "--report", f"{self.dir}/r.json",
                        "--report", "in.json", "--timings", "times.json", "--depfile", "o.d", expect=4)
        lines = [json.loads(line) for line in run.stderr.splitlines()]
        errors = [line for line in lines if line["level"] == "error"]
        self.assertEqual(len(errors), 1, run.stderr)
        self.assertIn(message, errors[0]["message"])
        self.assertFalse([line for line in lines if "stage" in line], "a stage ran")
        self.assertEqual(json.loads((self.dir / "r.json").read_text())["stages"], [])
        self.assertEqual(lines[-1]["reports"], [f"{self.dir}/r.json"])
        self.assertFalse((self.dir / "o.d").exists())

    def mount(self, *options):
        folder = self.dir / "disk"
        folder.mkdir()
        mount = subprocess.run(["mount", "-t", "tmpfs", *options, "tmpfs", str(folder)], capture_output=True)
        if mount.returncode:
            self.skipTest("only root may mount")
        self.addCleanup(subprocess.run, ["umount", str(folder)], check=False)
        return folder

    def test_a_read_only_folder(self):
        if os.geteuid() == 0:
            folder = self.mount("-o", "ro")
        else:
            folder = self.dir / "disk"
            folder.mkdir(0o555)
        self.check_refused(folder, "cannot be written")
        self.check_refused(folder / "new/sub", "cannot be made")

    def test_a_full_folder(self):
        folder = self.mount("-o", "size=64k")
        with open(folder / "filler", "wb", buffering=0) as filler:
            try:
                while filler.write(bytes(4096)):
                    pass
            except OSError:
                pass
        self.check_refused(folder, "no space left")
        self.assertEqual([p.name for p in folder.iterdir()], ["filler"])

    def test_a_folder_where_a_file_should_be(self):
        (self.dir / "out/a.ply").mkdir(parents=True)
        run = self.mill("run", "p.yaml", "-v", "-o", "out", expect=4)
        self.assertIn("is a directory", run.stderr)
        self.assertNotIn(" faces", run.stderr, "a stage ran")
        self.assertEqual([p.name for p in (self.dir / "out").iterdir()], ["a.ply"])

    def test_trying_leaves_nothing(self):
        self.write("q.yaml", "facetmill: 1\nstages: [{load: t.off}, {validate: {closed: true}}, {write: a.ply}]\n")
        (self.dir / "out").mkdir()
        (self.dir / "out/a.ply").write_text("older")
        self.mill("run", "q.yaml", "-o", "out", expect=1)
        self.mill("run", "q.yaml", "-o", "new/sub", expect=1)
        self.assertEqual({p.name for p in self.dir.iterdir()}, {"t.off", "p.yaml", "q.yaml", "out"})
        self.assertEqual([p.read_text() for p in (self.dir / "out").iterdir()], ["older"])


class Assets(Case):
    """facetmill_add_assets of find_package(facetmill): many inputs, two pipelines of which one only checks."""

    TETRAHEDRON = "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n"
    LISTS = """cmake_minimum_required(VERSION 3.21)
project(assets LANGUAGES NONE)
find_package(facetmill REQUIRED)
file(GLOB_RECURSE scans CONFIGURE_DEPENDS scans/*)
facetmill_add_assets(models PIPELINE web.yaml INPUTS ${scans} BASE scans PARAMS "unit=cm" OUTPUT_DIR web
                     THREADS 1 DESTINATION share/models)
facetmill_add_assets(checks PIPELINE check.yaml INPUTS ${scans})
message(STATUS "outputs: ${models_OUTPUTS}")
"""

    def setUp(self):
        super().setUp()
        self.prefix = self.installed()
        self.write("src/CMakeLists.txt", self.LISTS)
        self.write("src/web.yaml", "facetmill: 1\nparams: {input: {type: path}, unit: {type: text}}\nstages:\n"
                                   "  - load: {path: '${input}', unit: '${unit}'}\n  - write: '${input.stem}.glb'\n"
                                   "report: '${input.stem}.json'\n")
        self.write("src/check.yaml", "facetmill: 1\nparams: {input: {type: path}}\n"
                                     "stages: [{load: '${input}'}, {validate: {closed: true}}]\n")

    def scan(self, name, text=TETRAHEDRON):
        return self.write(f"src/scans/{name}.off", text)

    def cmake(self, *arguments, expect=0):
        run = subprocess.run(["cmake", *map(str, arguments)], cwd=self.dir, capture_output=True, text=True, timeout=300)
        said = " ".join((run.stdout + run.stderr).split())  # CMake breaks lines where it likes
        self.assertEqual(run.returncode == 0, expect == 0, said)
        return said

    def configure(self, generator, expect=0):
        return self.cmake("-G", generator, "-S", "src", "-B", "b", f"-DCMAKE_PREFIX_PATH={self.prefix}", expect=expect)

    def build(self, *arguments, expect=0):
        """How often facetmill ran."""
        self.said = self.cmake("--build", "b", *arguments, expect=expect)
        return self.said.count("Processing")

    def touch(self, path):
        time.sleep(0.02)
        os.utime(path)

    def check(self, generator, keep_going):
        odd = ["two words", "it's", "Zürich $5 #1 & 100%", "(x) *y?"]
        for name in ("a/one", "b/one", *odd):
            self.scan(name)
        self.assertIn("web/a/one.glb", self.configure(generator))
        runs = 2 * (2 + len(odd))
        self.assertEqual([self.build(), self.build()], [runs, 0], self.said)
        made = self.files(self.dir / "b/web")
        self.assertEqual(set(made), {f"{n}.{s}" for n in ("a/one", "b/one", *odd) for s in ("glb", "json")})
        for path, due in (("src/scans/a/one.off", 2), ("src/scans/Zürich $5 #1 & 100%.off", 2), ("src/check.yaml", runs // 2),
                          ("prefix/bin/facetmill", runs)):
            self.touch(self.dir / path)
            self.assertEqual([self.build(), self.build()], [due, 0], path + self.said)
        self.cmake("--install", "b", "--prefix", "installed")
        self.assertEqual(self.files(self.dir / "installed/share/models"), made)
        # One broken input stops itself only.
        good = (self.dir / "src/scans/b/one.off").read_text()
        self.scan("b/one", "no mesh")
        self.scan("a/one", good.replace("1 0 0", "2 0 0"))
        self.build("--", keep_going, expect=1)
        self.assertNotEqual(self.files(self.dir / "b/web")["a/one.glb"], made["a/one.glb"])
        self.scan("b/one", good)
        self.assertEqual([self.build(), self.build()], [2, 0], self.said)

    def test_ninja(self):
        self.need("ninja")
        self.check("Ninja", "-k0")

    def test_make(self):
        self.check("Unix Makefiles", "-k")

    def check_changes(self, generator):
        """What depends on a change is made again, and nothing else."""
        for name in ("b", "m/d", "m/f", "z"):
            self.scan(name)
        self.write("src/scans/m/f.off", self.TETRAHEDRON.replace("0 0 1\n3", "0 0 2\n3"))
        self.configure(generator)
        self.assertEqual([self.build(), self.build()], [8, 0], self.said)
        for name in ("a", "m/e", "zz"):  # before all, between them, and after all
            self.scan(name)
            self.assertEqual([self.build(), self.build()], [2, 0], name + self.said)
        (self.dir / "src/scans/b.off").unlink()
        self.assertEqual([self.build(), self.build()], [0, 0], "removed: " + self.said)
        (self.dir / "src/scans/m/d.off").rename(self.dir / "src/scans/m/c.off")
        self.assertEqual([self.build(), self.build()], [2, 0], "renamed: " + self.said)
        self.touch(self.dir / "src/scans/m/f.off")
        self.assertEqual([self.build(), self.build()], [2, 0], "touched: " + self.said)
        self.touch(self.prefix / "bin/facetmill")
        self.assertEqual([self.build(), self.build()], [2 * 6, 0], "another release: " + self.said)

    def test_changes_with_ninja(self):
        self.need("ninja")
        self.check_changes("Ninja")

    def test_changes_with_make(self):
        self.check_changes("Unix Makefiles")

    def test_changes_with_meson(self):
        self.need("meson", in_ci=False)
        self.need("ninja")

        def project(*names):
            self.write("src/meson.build", "project('assets')\nmill = find_program('" + str(self.prefix / "bin/facetmill") + "')\n"
                       f"foreach name : {list(names)}\n"
                       "  custom_target(name, input: 'scans' / name + '.off', output: [name + '.glb', name + '.json'],\n"
                       "    depfile: name + '.d', build_by_default: true, command: [mill, 'run', files('web.yaml'), '-D',\n"
                       "    'input=@INPUT@', '-D', 'unit=cm', '-o', '@OUTDIR@', '--depfile', '@DEPFILE@', '--depfile-target',\n"
                       "    '@OUTPUT0@', '--quiet'])\nendforeach\n")

        def built():
            """The outputs that a build made anew."""
            before = {p.name: p.stat().st_mtime_ns for p in (self.dir / "m").glob("*.glb")}
            time.sleep(0.02)
            run = subprocess.run(["ninja", "-C", "m"], cwd=self.dir, capture_output=True, text=True, timeout=300)
            self.assertEqual(run.returncode, 0, run.stdout + run.stderr)
            return sorted(p.stem for p in (self.dir / "m").glob("*.glb") if before.get(p.name) != p.stat().st_mtime_ns)

        for name in ("b", "d"):
            self.scan(name)
        project("b", "d")
        setup = subprocess.run(["meson", "setup", "m", "src"], cwd=self.dir, capture_output=True, text=True, timeout=300)
        self.assertEqual(setup.returncode, 0, setup.stdout + setup.stderr)
        self.assertEqual([built(), built()], [["b", "d"], []])
        self.scan("a")
        project("a", "b", "d")
        self.assertEqual([built(), built()], [["a"], []])
        project("a", "d")
        self.assertEqual(built(), [])
        (self.dir / "src/scans/d.off").rename(self.dir / "src/scans/c.off")
        project("a", "c")
        self.assertEqual([built(), built()], [["c"], []])
        self.touch(self.dir / "src/scans/c.off")
        self.assertEqual([built(), built()], [["c"], []])
        self.touch(self.prefix / "bin/facetmill")
        self.assertEqual([built(), built()], [["a", "c"], []])

    def test_each_input_is_planned_once(self):
        executable = self.prefix / "bin/facetmill"
        executable.rename(self.prefix / "bin/mill")
        self.write("prefix/bin/facetmill", f'#!/bin/sh\necho "$1" >>"{self.dir}/asked"\nexec "{self.prefix}/bin/mill" "$@"\n')
        executable.chmod(0o755)
        for name in ("a/one", "two words"):
            self.scan(name)
        self.write("src/CMakeLists.txt", "".join(line for line in self.LISTS.splitlines(True) if "checks" not in line))
        said = self.configure("Unix Makefiles")
        self.assertEqual((self.dir / "asked").read_text().split(), ["plan"] * 2)
        for name in ("web/a/one.glb", "web/a/one.json", "web/two words.glb"):
            self.assertIn(name, said)

    def test_what_is_refused_says_why(self):
        for name in ("x|y", 'x"y', "$(x)"):
            scan = self.scan(name)
            self.assertIn("cannot work with", self.configure("Unix Makefiles", expect=1))
            scan.unlink()
        self.scan("a/one")
        self.scan("b/one")
        self.write("src/CMakeLists.txt", self.LISTS.replace(" BASE scans", ""))
        self.assertIn("BASE to keep the folders", self.configure("Unix Makefiles", expect=1))
        self.write("src/CMakeLists.txt", self.LISTS.replace("PIPELINE web.yaml", "PIPELINE wbe.yaml"))
        self.assertIn("wbe.yaml", self.configure("Unix Makefiles", expect=1))
        self.write("src/CMakeLists.txt", self.LISTS.replace("BASE scans", "BAES scans"))
        self.assertIn("BAES", self.configure("Unix Makefiles", expect=1))


if __name__ == "__main__":
    main()
