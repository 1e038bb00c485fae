"""facetmill export: workflows for Ninja, Make and Snakemake, whose outputs are those of facetmill batch."""

import os
import shutil
import subprocess
import time

from support import FACETMILL, Case, main

PIPELINE = """facetmill: 1
allow: W-UNITS
params:
  input: {type: path}
  height: {type: number, default: 1}
stages:
  - load: "${input}"
  - transform: {scale: "${height}"}
  - write: "${input.stem}.ply"
report: "${input.stem}.json"
"""
TETRAHEDRON = "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n"


class Export(Case):
    NAMES = ("a", "sub/b", "sub/two words", "sub/it's $5 #1 & 100%", 'sub/größe: "x"')

    def setUp(self):
        super().setUp()
        self.write("p q.yaml", PIPELINE)
        for name in self.NAMES:
            self.write(f"in/{name}.off", TETRAHEDRON)
        (self.dir / "bin").mkdir()
        (self.dir / "bin/facetmill").symlink_to(FACETMILL)
        self.env = {**os.environ, "PATH": f"{self.dir / 'bin'}:{os.environ['PATH']}"}
        self.env.pop("FACETMILL", None)
        self.mill("batch", *self.options("batch"))
        self.wanted = {n: s for n, s in self.files(self.dir / "batch").items() if not n.startswith(".facetmill-batch")}
        self.assertEqual(len(self.wanted), 2 * len(self.NAMES))

    def options(self, folder):
        return ("p q.yaml", "--input", "in/**/*.off", "-D", "height=2", "--set", "transform.scale=3", "-o", folder)

    def export(self, engine, name):
        self.write(name, self.mill("export", "--to", engine, *self.options("out")).stdout)

    def build(self, *command, expect=0):
        run = subprocess.run(command, cwd=self.dir, env=self.env, capture_output=True, text=True, timeout=300)
        self.assertEqual(run.returncode == 0, expect == 0, run.stdout + run.stderr)
        return run.stdout + run.stderr

    def check(self, command, nothing):
        self.build(*command)
        self.assertEqual(self.files(self.dir / "out"), self.wanted)
        self.assertIn(nothing, self.build(*command))
        for name in (self.NAMES[0], self.NAMES[-1]):  # one that changes is made again, and no other
            before = {p: p.stat().st_mtime_ns for p in (self.dir / "out").rglob("*.ply")}
            time.sleep(0.02)
            self.write(f"in/{name}.off", TETRAHEDRON.replace("0 0 1", "0 0 5"))
            self.build(*command)
            changed = {p.relative_to(self.dir / "out").as_posix() for p, t in before.items() if p.stat().st_mtime_ns != t}
            self.assertEqual(changed, {f"{name}.ply"})
        self.write("in/a.off", "no mesh")
        self.build(*command, expect=1)
        self.write("in/a.off", TETRAHEDRON)
        self.build(*command)
        self.assertIn(nothing, self.build(*command))

    def test_ninja(self):
        self.need("ninja")
        self.export("ninja", "build.ninja")
        self.check(("ninja",), "no work to do")

    def test_make(self):
        self.export("make", "Makefile")
        self.check(("make", "-j2"), "Nothing to be done")

    def test_snakemake(self):
        self.need("snakemake", in_ci=False)  # 78 packages on Debian 12
        self.export("snakemake", "Snakefile")
        self.check(("snakemake", "-j2"), "Nothing to be done")

    def test_a_missing_library_of_materials_stops_no_build(self):
        self.write("in/m.obj", "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl red\nf 1 2 3\n")
        for engine, name, command in (("make", "Makefile", ("make",)), ("ninja", "build.ninja", ("ninja",))):
            self.need(engine)
            (self.dir / "in/m.mtl").unlink(missing_ok=True)
            self.write(name, self.mill("export", "--to", engine, "p q.yaml", "--input", "in/m.obj", "-o", engine).stdout)
            written = self.dir / engine / "m.ply"
            times = []
            for change in ("", "in/other.txt", "in/m.mtl"):
                time.sleep(0.02)
                if change:
                    self.write(change, "newmtl red\nKd 1 0 0\n")
                self.build(*command)
                times.append(written.stat().st_mtime_ns)
            self.assertEqual(times[0], times[1], engine)
            self.assertEqual(times[2] != times[1], engine == "make")  # Ninja has no optional inputs

    def check_changes(self, engine, name, *command):
        """What depends on a change is made again, and nothing else. The executable is one of its own."""
        mill = self.dir / "own/facetmill"
        mill.parent.mkdir()
        shutil.copy2(FACETMILL, mill)
        env = {**self.env, "PATH": f"{mill.parent}:{os.environ['PATH']}"}
        source = self.dir / "models"
        self.write("m.yaml", PIPELINE.replace(".ply", ".glb"))

        def built(*again):
            """The outputs that a build makes anew, after another export."""
            text = subprocess.run([mill, "export", "--to", engine, "m.yaml", "--input", "models/*", "-o", "made"], cwd=self.dir,
                                  capture_output=True, text=True, timeout=300)
            self.assertEqual(text.returncode, 0, text.stderr)
            self.write(name, text.stdout)
            before = {p.name: p.stat().st_mtime_ns for p in (self.dir / "made").glob("*.glb")}
            time.sleep(0.02)
            run = subprocess.run(command, cwd=self.dir, env=env, capture_output=True, text=True, timeout=300)
            self.assertEqual(run.returncode, 0, run.stdout + run.stderr)
            return sorted(p.stem for p in (self.dir / "made").glob("*.glb") if before.get(p.name) != p.stat().st_mtime_ns)

        def due(names):
            self.assertEqual([built(), built()], [sorted(names), []])
            time.sleep(0.02)

        def touch(path):
            time.sleep(0.02)
            os.utime(path)

        for asset in ("b", "it's", "d"):
            self.write(f"models/{asset}.off", TETRAHEDRON)
        due(["b", "it's", "d"])
        self.write("models/a.off", TETRAHEDRON)
        due(["a"])
        (source / "b.off").unlink()
        due([])
        (source / "d.off").rename(source / "c.off")
        due(["c"])
        touch(source / "it's.off")
        due(["it's"])
        touch(mill)
        due(["a", "c", "it's"])
        touch(self.dir / "m.yaml")
        due(["a", "c", "it's"])

    def test_changes_with_ninja(self):
        self.need("ninja")
        self.check_changes("ninja", "build.ninja", "ninja")

    def test_changes_with_make(self):
        self.check_changes("make", "Makefile", "make")

    def test_changes_with_snakemake(self):
        self.need("snakemake", in_ci=False)
        self.check_changes("snakemake", "Snakefile", "snakemake", "-j2")

    def test_files_that_only_a_run_knows_are_dependencies(self):
        """A texture that an asset names since its last run, and a missing one that appears."""
        for engine, name, command in (("make", "Makefile", ("make",)), ("ninja", "build.ninja", ("ninja",))):
            with self.subTest(engine):
                self.need(engine)
                folder = self.dir / f"of-{engine}"
                folder.mkdir()
                self.gltf_with_neighbours(folder)
                picture = (folder / "tex.png").read_bytes()
                (folder / "tex.png").unlink()
                self.write("g.yaml", PIPELINE.replace(".ply", ".glb"))
                self.write(name, self.mill("export", "--to", engine, "g.yaml", "--input", f"of-{engine}/t.gltf", "-o", engine).stdout)
                made = self.dir / engine / "t.glb"

                def is_due():
                    before = made.stat().st_mtime_ns if made.exists() else 0
                    time.sleep(0.02)
                    self.build(*command)
                    return made.stat().st_mtime_ns != before

                self.assertEqual([is_due(), is_due()], [True, False], "the texture is missing")
                time.sleep(0.02)
                (folder / "tex.png").write_bytes(picture)
                self.assertEqual([is_due(), is_due()], [engine == "make", False], "it appeared")
                os.utime(folder / "t.gltf")  # Ninja has no optional inputs
                self.assertEqual([is_due(), is_due()], [True, False], "its asset changed")
                time.sleep(0.02)
                os.utime(folder / "tex.png")
                self.assertEqual([is_due(), is_due()], [True, False], "it changed")

    def test_shards(self):
        for engine, name, command, nothing in (("ninja", "build.ninja", ("ninja",), "no work to do"),
                                               ("make", "Makefile", ("make", "-j2"), "Nothing to be done"),
                                               ("snakemake", "Snakefile", ("snakemake", "-j2"), "Nothing to be done")):
            with self.subTest(engine):
                self.need(engine, in_ci=engine != "snakemake")
                written = self.mill("export", "--to", engine, *self.options(engine), "--shard", 3).stdout
                self.write(name, written)
                self.build(*command)
                self.assertEqual(self.files(self.dir / engine), self.wanted)
                self.assertIn(nothing, self.build(*command))
                # The first of the first shard fails: the others of it are made all the same, and it is due again.
                self.write("in/a.off", "no mesh")
                if engine != "snakemake":  # which removes what a failed job wrote
                    before = (self.dir / engine / "sub/b.ply").stat().st_ino
                    self.build(*command, expect=1)
                    self.assertNotEqual((self.dir / engine / "sub/b.ply").stat().st_ino, before)
                self.build(*command, expect=1)
                self.write("in/a.off", TETRAHEDRON)
                self.build(*command)
                self.assertEqual(self.files(self.dir / engine), self.wanted)
                self.assertIn(nothing, self.build(*command))

    def test_a_failed_check_is_due_again(self):
        self.write("gate.yaml", "facetmill: 1\nallow: W-UNITS\nparams: {input: {type: path}}\n"
                                "stages: [load: '${input}', validate: {closed: true}]\nreport: '${input.stem}.json'\n")
        self.write("in/a.off", TETRAHEDRON.replace("4 4 0", "4 3 0").rsplit("3 2 0 3\n")[0])
        for engine, name, command in (("make", "Makefile", ("make",)), ("ninja", "build.ninja", ("ninja",))):
            self.need(engine)
            self.write(name, self.mill("export", "--to", engine, "gate.yaml", "--input", "in/a.off", "-o", engine).stdout)
            for _ in range(2):
                self.assertIn("E-CHECK", self.build(*command, expect=1))
            self.assertTrue((self.dir / engine / "a.json").exists(), "the report tells what failed")

    def test_what_is_refused(self):
        def refused(identity, *arguments, expect=2):
            run = self.mill("export", *arguments, expect=expect)
            self.assertIn(identity, run.stderr)
            self.assertEqual(run.stdout, "")

        refused("E-ARGUMENT", "--to", "ninja", "p q.yaml", "-o", "out")
        refused("slurm", "--to", "slurm", *self.options("out"))
        refused("E-FILE", "--to", "ninja", "p q.yaml", "--input", "none/*.off", "-o", "out", expect=3)
        self.write("gate.yaml", "facetmill: 1\nparams: {input: {type: path}}\nstages: [load: '${input}', validate: {closed: true}]\n")
        refused("E-EXPORT", "--to", "make", "gate.yaml", "--input", "in/*.off", "-o", "out")
        for name in ("a|b", "c|d"):
            self.write(f"odd/{name}.off", TETRAHEDRON)
        odd = self.mill("export", "--to", "ninja", "p q.yaml", "--input", "odd/*.off", "-o", "out", expect=2).stderr
        self.assertEqual([line.split("'")[-2] for line in odd.splitlines() if "error[E-EXPORT]" in line],
                         ["odd/a|b.off", "odd/c|d.off"])
        rows = "".join(f"in/a.off,{'1' * 900},{i}\n" for i in range(200))
        self.write("long.csv", "input,text,n\n" + rows)
        self.write("long.yaml", PIPELINE.replace("params:", "params:\n  text: text\n  n: integer").replace("input.stem", "n"))
        refused("but a shell accepts", "--to", "ninja", "long.yaml", "--table", "long.csv", "-o", "out", "--shard", 200)
        self.mill("export", "--to", "ninja", "long.yaml", "--table", "long.csv", "-o", "out", "--shard", 100)
        # Make's recipe names the outputs once more.
        rows = "".join(f"in/a.off,{'1' * 560},{i:0>200}\n" for i in range(120))
        self.write("names.csv", "input,text,n\n" + rows)
        self.write("names.yaml", PIPELINE.replace("params:", "params:\n  text: text\n  n: text").replace("input.stem", "n"))
        names = ("names.yaml", "--table", "names.csv", "-o", "out", "--shard", 120)
        self.mill("export", "--to", "ninja", *names)
        refused("but a shell accepts", "--to", "make", *names)
        self.write("one.csv", f"input,text,n\nin/a.off,{'1' * 140000},1\n")
        refused("put long params into a --preset", "--to", "ninja", "long.yaml", "--table", "one.csv", "-o", "out")
        self.write("same.yaml", PIPELINE.replace("${input.stem}", "one"))
        refused("E-DUPLICATE-OUTPUT", "--to", "make", "same.yaml", "--input", "in/**/*.off", "--base", "in", "-o", "out")
        self.write("in/a{b}.off", TETRAHEDRON)
        refused("E-EXPORT", "--to", "snakemake", *self.options("out"))
        (self.dir / "in/a{b}.off").unlink()
        for name, engine in (("a|b", "ninja"), ("a|b", "make"), ("a=b", "make"), ("a[b]", "make")):
            path = self.write(f"in/{name}.off", TETRAHEDRON)
            refused("E-EXPORT", "--to", engine, *self.options("out"))
            path.unlink()
        self.write("in/line\nbreak.off", TETRAHEDRON)
        refused("E-DEPFILE", "--to", "make", *self.options("out"), expect=4)


if __name__ == "__main__":
    main()
