"""Every example runs as it stands, in a copy of the tree, with facetmill found on PATH."""

import os
import pathlib
import shutil
import subprocess
import time

from support import FACETMILL, SOURCE, Case, main, png


class Tree(Case):
    """A copy of the examples."""

    def setUp(self):
        super().setUp()
        shutil.copytree(SOURCE / "examples", self.dir / "examples")
        (self.dir / "bin").mkdir()
        (self.dir / "bin/facetmill").symlink_to(FACETMILL)
        self.env = {**os.environ, "PATH": f"{self.dir / 'bin'}:{os.environ['PATH']}"}
        self.env.pop("FACETMILL", None)  # the Makefile would take it

    def run_in(self, folder, *command):
        run = subprocess.run(command, cwd=self.dir / "examples" / folder, env=self.env, capture_output=True, text=True,
                             timeout=900)
        self.assertEqual(run.returncode, 0, f"{command}\n{run.stdout}\n{run.stderr}")
        return run.stdout + run.stderr

    def made(self, folder):
        return {p.name for p in (self.dir / "examples" / folder).rglob("*") if p.is_file()}

    def name_the_executable(self, build_file):
        path = self.dir / "examples" / build_file
        text = path.read_text()
        self.assertIn("/usr/bin/facetmill", text)
        path.write_text(text.replace("/usr/bin/facetmill", str(self.dir / "bin/facetmill")))


class Examples(Tree):
    def touch_scan(self, later=10):
        at = time.time() + later
        os.utime(self.dir / "examples/data/nefertiti.ply", (at, at))

    def shell(self, shell):
        path = self.need(shell)
        # Stop at the first failure: bash and zsh by -e, fish by a word after every line.
        script = self.dir / "examples/shell/one-liners.sh"
        if shell == "fish":
            lines = script.read_text().splitlines()
            script.write_text("\n".join(l + "; or exit 1" if l and not l.startswith("#") else l for l in lines) + "\n")
            self.run_in("shell", path, "--no-config", script.name)
        else:
            self.run_in("shell", path, "-e", script.name)
        made = self.made("shell")
        for name in ("web.glb", "plus.glb", "bust.stl", "lod0.glb", "lod2.glb", "smooth.ply", "rough.ply", "info.txt",
                     "kept.glb", "kept.yaml"):
            self.assertIn(name, made)
        folder = self.dir / "examples/shell"
        self.assertEqual((folder / "web.glb").read_bytes(), (folder / "plus.glb").read_bytes())

    def test_bash(self):
        self.shell("bash")

    def test_zsh(self):
        self.shell("zsh")

    def test_fish(self):
        self.shell("fish")

    def test_make(self):
        self.run_in("make", "make")
        self.assertLessEqual({"nefertiti.glb", "nefertiti.json", "nefertiti.d"}, self.made("make"))
        self.assertIn("Nothing to be done", self.run_in("make", "make"))
        self.touch_scan()
        self.assertIn("facetmill run", self.run_in("make", "make"))
        self.run_in("make", "make", "-j2", "together")
        folder = self.dir / "examples/make"
        self.assertEqual((folder / "together/nefertiti.glb").read_bytes(), (folder / "nefertiti.glb").read_bytes())

    def test_cmake(self):
        prefix = self.installed()
        for generator, nothing in (("Ninja", "no work to do"), ("Unix Makefiles", "")):
            self.run_in("cmake", "cmake", "-G", generator, "-B", generator, f"-DCMAKE_PREFIX_PATH={prefix}")
            self.assertIn("Processing", self.run_in("cmake", "cmake", "--build", generator))
            self.assertLessEqual({"nefertiti.glb", "nefertiti.json"}, self.made(f"cmake/{generator}"))
            again = self.run_in("cmake", "cmake", "--build", generator)
            self.assertIn(nothing, again)
            self.assertNotIn("Processing", again)
        self.touch_scan()
        for generator in ("Ninja", "Unix Makefiles"):
            self.assertIn("Processing", self.run_in("cmake", "cmake", "--build", generator))

    def test_ninja(self):
        self.name_the_executable("ninja/build.ninja")
        self.run_in("ninja", "ninja")
        self.assertIn("nefertiti.glb", self.made("ninja"))
        self.assertIn("no work to do", self.run_in("ninja", "ninja"))
        self.touch_scan()
        self.assertNotIn("no work to do", self.run_in("ninja", "ninja"))

    def test_meson(self):
        self.need("meson")
        self.need("ninja")
        self.run_in("meson", "meson", "setup", "b")
        self.run_in("meson", "ninja", "-C", "b")
        self.assertLessEqual({"nefertiti.glb", "nefertiti.json"}, self.made("meson/b"))
        self.assertIn("no work to do", self.run_in("meson", "ninja", "-C", "b"))
        self.touch_scan()
        self.assertNotIn("no work to do", self.run_in("meson", "ninja", "-C", "b"))

    def test_snakemake(self):
        self.need("snakemake", in_ci=False)  # 78 packages on Debian 12
        self.run_in("snakemake", "snakemake", "-j1")
        self.assertLessEqual({"nefertiti.glb", "nefertiti.json"}, self.made("snakemake"))
        self.assertIn("Nothing to be done", self.run_in("snakemake", "snakemake", "-j1"))
        self.touch_scan(later=0)  # outputs older than their inputs are taken for broken
        self.assertIn("rule mill", self.run_in("snakemake", "snakemake", "-j1"))

    def test_dvc(self):
        self.need("dvc", in_ci=False)  # not in Debian
        self.name_the_executable("dvc/dvc.yaml")
        self.run_in(".", "git", "init", "-q", ".")
        self.run_in(".", "dvc", "init", "-q", "--subdir")
        self.run_in("dvc", "dvc", "repro")
        self.assertLessEqual({"nefertiti.glb", "nefertiti.json"}, self.made("dvc"))
        self.assertIn("didn't change, skipping", self.run_in("dvc", "dvc", "repro"))

    def test_bazel(self):
        self.need("bazel", in_ci=False)  # a virtual machine for Java comes with it
        build = ("bazel", f"--output_user_root={self.dir}/bazel", "build", f"--action_env=PATH={self.env['PATH']}", ":all")
        self.addCleanup(subprocess.run, ("bazel", f"--output_user_root={self.dir}/bazel", "shutdown"),
                        cwd=self.dir / "examples/bazel", capture_output=True)
        self.assertIn("bazel-bin/nefertiti.glb", self.run_in("bazel", *build))
        self.assertIn("1 total action", self.run_in("bazel", *build))
        with (self.dir / "examples/web.yaml").open("a") as pipeline:
            pipeline.write("x-more: 1\n")
        self.assertIn("2 total actions", self.run_in("bazel", *build))



class Names(Tree):
    """Scans whose names have what shells and build systems give a meaning."""

    NAMES = ("two words", "$5 #1 & 100%", "größe: (x)", '"quoted"', "it's")

    def setUp(self):
        super().setUp()
        shutil.rmtree(self.dir / "examples/data")
        (self.dir / "examples/data").mkdir()
        for name in self.NAMES:
            self.write(f"examples/data/{name}.ply", scan("none", 1).replace("comment TextureFile none.png\n", ""))
        web = self.dir / "examples/web.yaml"
        web.write_text(web.read_text().replace("  - simplify: 10%\n    ensure: {edge_manifold: true}\n", ""))

    def check(self, folder, *command, names=NAMES, nothing):
        self.run_in(folder, *command)
        made = self.made(folder)
        for name in names:
            self.assertLessEqual({f"{name}.glb", f"{name}.json"}, made)
        self.assertIn(nothing, self.run_in(folder, *command))

    def listed(self, build_file, old, spell):
        """Writes the odd names in place of the one that is there."""
        path = self.dir / "examples" / build_file
        text = path.read_text()
        self.assertIn(old, text)
        path.write_text(text.replace(old, "".join(spell(name) for name in self.NAMES)))

    def check_with_ninja(self, folder, *command):
        """Before 1.13 Ninja does not read ' " & in depfiles, and makes what has them again every time."""
        version = subprocess.run(["ninja", "--version"], capture_output=True, text=True).stdout
        old = tuple(map(int, version.split(".")[:2])) < (1, 13)
        self.check(folder, *command, nothing="" if old else "no work to do")
        again = self.run_in(folder, *command)
        for name in self.NAMES:
            if not any(c in name for c in "'\"&"):
                self.assertNotIn(name, again)

    def test_make(self):
        self.check("make", "make", "together", nothing="")

    def test_ninja(self):
        self.name_the_executable("ninja/build.ninja")
        build = self.dir / "examples/ninja/build.ninja"
        head, one = build.read_text().split("\nbuild ")
        spell = lambda name: name.replace("$", "$$").replace(" ", "$ ").replace(":", "$:")
        build.write_text(head + "".join("\nbuild " + one.replace("nefertiti", spell(name)) for name in self.NAMES))
        self.check_with_ninja("ninja", "ninja")

    def test_cmake(self):
        prefix = self.installed()
        path = self.dir / "examples/cmake/CMakeLists.txt"
        path.write_text(path.read_text().replace("PIPELINE model.yaml", "PIPELINE ../web.yaml").replace('  PARAMS "keep=5%"\n', ""))
        names = [name for name in self.NAMES if not any(c in name for c in '":')]
        configured = lambda generator: subprocess.run(
            ["cmake", "-G", generator, "-B", "b", f"-DCMAKE_PREFIX_PATH={prefix}"], cwd=self.dir / "examples/cmake",
            env=self.env, capture_output=True, text=True, timeout=300)
        self.assertIn("cannot work with ; [ ]", configured("Ninja").stderr)
        for name in set(self.NAMES) - set(names):
            (self.dir / f"examples/data/{name}.ply").unlink()
        for generator in ("Ninja", "Unix Makefiles"):
            self.assertEqual(configured(generator).returncode, 0)
            self.check("cmake", "cmake", "--build", "b", names=names, nothing="")
            shutil.rmtree(self.dir / "examples/cmake/b")

    def test_meson(self):
        self.need("meson")
        quoted = lambda name: "'" + name.replace("'", "\\'") + "', "
        self.listed("meson/meson.build", "'nefertiti'", quoted)
        self.run_in("meson", "meson", "setup", "b")
        self.check_with_ninja("meson", "ninja", "-C", "b")

    def test_snakemake(self):
        self.need("snakemake", in_ci=False)  # 78 packages on Debian 12
        self.check("snakemake", "snakemake", "-j1", nothing="Nothing to be done")

    def test_dvc(self):
        self.need("dvc", in_ci=False)  # not in Debian
        self.name_the_executable("dvc/dvc.yaml")
        names = [name for name in self.NAMES if "'" not in name]
        path = self.dir / "examples/dvc/dvc.yaml"
        path.write_text(path.read_text().replace("      - nefertiti\n", "".join(f"      - '{name}'\n" for name in names)))
        self.run_in(".", "git", "init", "-q", ".")
        self.run_in(".", "dvc", "init", "-q", "--subdir")
        self.check("dvc", "dvc", "repro", names=names, nothing="didn't change, skipping")


def scan(name, size):
    return (f"ply\nformat ascii 1.0\ncomment TextureFile {name}.png\nelement vertex 4\nproperty float x\nproperty float y\n"
            "property float z\nproperty float s\nproperty float t\nelement face 4\nproperty list uchar int vertex_indices\n"
            f"end_header\n0 0 0 0 0\n{size} 0 0 1 0\n0 1 0 0 1\n0 0 1 1 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n")


class Incremental(Tree):
    """Each example with two small textured scans and a pipeline that includes another: what changes is made again, and nothing
    else."""

    def setUp(self):
        super().setUp()
        shutil.rmtree(self.dir / "examples/data")
        (self.dir / "examples/data").mkdir()
        for number, name in enumerate(("one", "two"), 1):
            self.write(f"examples/data/{name}.ply", scan(name, number))
            (self.dir / f"examples/data/{name}.png").write_bytes(png(number, 2, 3))
        self.replace("web.yaml", "  - simplify: 10%\n    ensure: {edge_manifold: true}\n", "  - include: more.yaml\n")
        self.write("examples/more.yaml", "facetmill: 1\nstages: [split: midpoint]\n")
        self.wrap(self.dir / "bin/facetmill", FACETMILL)
        self.write("runs", "")

    def wrap(self, path, executable):
        """An executable that notes what it mills, and may be changed."""
        path.unlink()
        path.write_text(f"""#!/bin/sh
if [ "$1" = run ]; then for a; do case $a in input=*) basename "$a" .ply >>"{self.dir}/runs";; esac; done; fi
exec "{executable}" "$@"
""")
        path.chmod(0o755)
        self.executable = path

    def replace(self, name, old, new):
        path = self.dir / "examples" / name
        text = path.read_text()
        self.assertIn(old, text)
        path.write_text(text.replace(old, new))

    def due(self, folder, command, good=True):
        """Which scans are processed."""
        (self.dir / "runs").write_text("")
        run = subprocess.run(command, cwd=self.dir / "examples" / folder, env=self.env, capture_output=True, text=True, timeout=900)
        self.said = run.stdout + run.stderr
        self.assertEqual(run.returncode == 0, good, self.said)
        if log := os.environ.get("FACETMILL_BUILD_LOGS"):
            with open(pathlib.Path(log) / f"{self.id().split('.')[-1]}.log", "a") as file:
                file.write(f"$ {' '.join(map(str, command))}\n{self.said}exit code {run.returncode}\n\n")
        return sorted((self.dir / "runs").read_text().split())

    def change(self, path, content=None):
        time.sleep(0.05)  # file systems count time in steps
        if content is None:
            with path.open("a") as file:
                file.write("# more\n")
        else:
            path.write_bytes(content)

    def check(self, folder, command, *keep_going):
        both, data = ["one", "two"], self.dir / "examples/data"
        self.assertEqual(self.due(folder, command), both, self.said)
        self.assertEqual(self.due(folder, command), [], self.said)
        for path, content, due in ((data / "one.png", png(9, 9, 9), ["one"]), (data / "two.ply", scan("two", 3).encode(), ["two"]),
                                   (self.dir / "examples/web.yaml", None, both), (self.dir / "examples/more.yaml", None, both),
                                   (self.executable, None, both)):
            self.change(path, content)
            self.assertEqual(self.due(folder, command), due, f"{path.name}: {self.said}")
            self.assertEqual(self.due(folder, command), [], f"{path.name}: {self.said}")
        self.change(data / "two.ply", b"no mesh")
        self.change(data / "one.ply", scan("one", 5).encode())
        self.assertEqual(self.due(folder, (*command, *keep_going), good=False), both, self.said)
        self.assertIn("two.ply", self.said)
        self.change(data / "two.ply", scan("two", 4).encode())
        self.assertEqual(self.due(folder, command), ["two"], self.said)
        self.assertEqual(self.due(folder, command), [], self.said)

    def test_make(self):
        self.check("make", ("make",), "-k")

    def test_ninja(self):
        self.name_the_executable("ninja/build.ninja")
        build = self.dir / "examples/ninja/build.ninja"
        head, one = build.read_text().split("\nbuild ")
        build.write_text(head + "".join("\nbuild " + one.replace("nefertiti", name) for name in ("one", "two")))
        self.check("ninja", ("ninja",), "-k0")

    def cmake(self, generator, keep_going):
        prefix = self.installed()
        executable = prefix / "bin/facetmill"
        shutil.copy(executable, prefix / "bin/mill")
        self.wrap(executable, prefix / "bin/mill")
        self.replace("cmake/CMakeLists.txt", "PIPELINE model.yaml", "PIPELINE ../web.yaml")
        self.replace("cmake/CMakeLists.txt", '  PARAMS "keep=5%"\n', "")
        self.run_in("cmake", "cmake", "-G", generator, "-B", "b", f"-DCMAKE_PREFIX_PATH={prefix}")
        self.check("cmake", ("cmake", "--build", "b"), "--", keep_going)

    def test_cmake(self):
        self.cmake("Ninja", "-k0")

    def test_cmake_with_make(self):
        self.cmake("Unix Makefiles", "-k")

    def test_meson(self):
        self.need("meson")
        self.replace("meson/meson.build", "['nefertiti']", "['one', 'two']")
        self.run_in("meson", "meson", "setup", "b")
        self.check("meson", ("ninja", "-C", "b"), "-k0")

    def test_snakemake(self):
        self.need("snakemake", in_ci=False)  # 78 packages on Debian 12
        self.check("snakemake", ("snakemake", "-j1"), "--keep-going")

    def test_dvc(self):
        self.need("dvc", in_ci=False)  # not in Debian
        self.name_the_executable("dvc/dvc.yaml")
        self.replace("dvc/dvc.yaml", "      - nefertiti\n", "      - one\n      - two\n")
        self.replace("dvc/dvc.yaml", "        - ../web.yaml\n", "        - ../web.yaml\n        - ../more.yaml\n        - ../data/${item}.png\n")
        self.run_in(".", "git", "init", "-q", ".")
        self.run_in(".", "dvc", "init", "-q", "--subdir")
        self.check("dvc", ("dvc", "repro"), "--keep-going")

    def test_bazel(self):
        self.need("bazel", in_ci=False)  # a virtual machine for Java comes with it
        self.replace("bazel/BUILD.bazel", '["nefertiti"]', '["one", "two"]')
        self.replace("bazel/BUILD.bazel", '        "@assets//:web.yaml",\n',
                     '        "@assets//:web.yaml",\n        "@assets//:more.yaml",\n        "@assets//:data/%s.png" % scan,\n')
        self.replace("bazel/WORKSPACE", "['web.yaml']", "['web.yaml', 'more.yaml']")
        command = ("bazel", f"--output_user_root={self.dir}/bazel")
        self.addCleanup(subprocess.run, (*command, "shutdown"), cwd=self.dir / "examples/bazel", capture_output=True)
        self.check("bazel", (*command, "build", f"--action_env=PATH={self.env['PATH']}", f"--sandbox_writable_path={self.dir}", ":all"),
                   "--keep_going")


if __name__ == "__main__":
    main()
