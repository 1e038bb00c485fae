"""Every example runs as it stands, in a copy of the tree, with facetmill found on PATH."""

import os
import pathlib
import shutil
import subprocess
import time

from support import FACETMILL, SOURCE, Case, main


class Examples(Case):
    def setUp(self):
        super().setUp()
        shutil.copytree(SOURCE / "examples", self.dir / "examples")
        (self.dir / "bin").mkdir()
        (self.dir / "bin/facetmill").symlink_to(FACETMILL)
        self.env = {**os.environ, "PATH": f"{self.dir / 'bin'}:{os.environ['PATH']}"}

    def run_in(self, folder, *command):
        run = subprocess.run(command, cwd=self.dir / "examples" / folder, env=self.env, capture_output=True, text=True,
                             timeout=900)
        self.assertEqual(run.returncode, 0, f"{command}\n{run.stdout}\n{run.stderr}")
        return run.stdout + run.stderr

    def made(self, folder):
        return {p.name for p in (self.dir / "examples" / folder).rglob("*") if p.is_file()}

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


if __name__ == "__main__":
    main()
