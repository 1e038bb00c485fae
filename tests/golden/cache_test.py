"""facetmill run, pipe and batch with the cache: what a hit gives is what a miss gives, byte for byte, whatever happens to
the cache."""

import base64
import json
import os
import pathlib
import resource
import shutil
import struct
import subprocess
import tempfile
import unittest

from support import FACETMILL, SLOW, SOURCE, Case, main

ALL = ("--cache-everything",)  # cheap stages, too, so that small meshes test what large ones do
SCAN = None  # an ellipsoid of 1,280 faces, for this whole module
PIPELINE = """facetmill: 1
params:
  input: {type: path}
  keep: {type: ratio, default: 50%}
stages:
  - load: "${input}"
  - relax: 1
  - simplify: "${keep}"
  - validate: {closed: false, severity: warn}
  - write: out.ply
report: out.json
"""
# A red pixel.
PNG = base64.b64decode("iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAIAAACQd1PeAAAADElEQVR4nGP4z8AAAAMBAQDJ/pLvAAAAAElFTkSuQmCC")
# Several paths of one scene, a condition and a contract on it, and stages that read and write besides.
WINDING = """facetmill: 1
params:
  input: {type: path}
stages:
  - load: "${input}"
  - clean
  - measure: {path: measures.json}
  - branch:
      near: [{relax: 2}, {write: near.ply}]
      far: [{simplify: 30%, ensure: {deviation: {max: 90%}}}, {write: far.glb}]
  - foreach: {k: [1, 2]}
    join: true
    do: [{relax: "${k}"}, {transform: {translate: [0, 0, "${k}"]}}]
  - orient
    when: {faces: {min: 1}}
  - foreach: {part: "*"}
    do: [{split: midpoint}, {write: "part-${part}.stl"}]
  - render: picture.png
report: [all.json, all.xml]
""".replace("  - orient\n    when", "  - orient:\n    when")


def setUpModule():
    global SCAN
    folder = pathlib.Path(tempfile.mkdtemp(prefix="facetmill-test-"))
    unittest.addModuleCleanup(shutil.rmtree, folder, ignore_errors=True)
    subprocess.run([str(FACETMILL), "pipe", "-q", "-o", str(folder), "generate", "icosphere", "--subdivisions", "3", "!",
                    "transform", "--scale", "[1, 2, 3]", "!", "write", "scan.ply"], check=True, timeout=600)
    SCAN = folder / "scan.ply"


class Cache(Case):
    def setUp(self):
        super().setUp()
        self.cache = self.dir / "cache"
        self.env = {"FACETMILL_CACHE": str(self.cache)}
        self.write("p.yaml", PIPELINE)

    def told(self, *arguments, out="out", expect=0, env=None):
        """What a run says on standard error, without what varies; and all that it writes."""
        shutil.rmtree(self.dir / out, ignore_errors=True)
        run = self.mill(*arguments, "-q", "--output-dir", out, expect=expect, env=env or self.env)
        return run.returncode, run.stderr.replace(f"/{out}/", "/OUT/"), self.files(self.dir / out)

    def run_it(self, *more, out="out", expect=0, env=None, pipeline="p.yaml"):
        return self.told("run", pipeline, "-D", f"input={SCAN}", *ALL, *more, out=out, expect=expect, env=env)

    def explained(self, *more, pipeline="p.yaml", scan=None):
        run = self.mill("run", pipeline, "-D", f"input={scan or SCAN}", *ALL, "--explain", "-o", "out", *more, env=self.env)
        names = ("load", "relax", "simplify", "validate", "write")
        return [line for line in run.stderr.splitlines() if line.startswith(names) and (":" in line)]

    def entries(self, suffix):
        return sorted(self.cache.rglob(f"*{suffix}"))

    def same_thrice(self, *arguments, expect=None, misses=True):
        """Without a cache, with an empty one, and with all in it."""
        without = self.told(*arguments, "--no-cache", out="a", expect=expect)
        cold = self.told(*arguments, *ALL, out="a", expect=expect)
        warm = self.told(*arguments, *ALL, out="a", expect=expect)
        self.assertEqual(cold, without)
        self.assertEqual(warm, without)
        return without


class HitEqualsMiss(Cache):
    def check(self, pipeline, *more, scan=True):
        scan = ["-D", f"input={SCAN}"] if scan and "\n  input:" in pipeline.read_text() else []
        code, _, files = self.same_thrice("run", pipeline, *scan, *more, expect=0)
        self.assertTrue(files)
        self.assertTrue(self.entries(".memory"))

    def test_winding(self):
        self.check(self.write("w.yaml", WINDING))

    def test_textured(self):
        """Documents of glTF, alone and joined."""
        for name in ("box-textured.glb", "box-draco.glb", "morph-cube/AnimatedMorphCube.gltf")[:1 if SLOW else 3]:
            mesh = SOURCE / "tests/data" / name
            pipeline = self.write("t.yaml", WINDING.replace("- clean\n", "- triangulate\n").replace("all.xml", "all.html"))
            self.check(pipeline, "-D", f"input={mesh}", scan=False)

    def test_pipe(self):
        for out, options in (("none", ("--no-cache",)), ("cold", ALL), ("warm", ALL)):
            self.mill("pipe", *options, "-o", out, "load", SCAN, "!", "relax", "2", "!", "write", "b.ply", env=self.env)
            self.assertEqual(self.files(self.dir / out), self.files(self.dir / "none"))
        self.assertTrue(self.entries(".scene"))

    def test_strict_and_allow(self):
        for more in (("--strict",), ("--strict=W-UNITS",), ("--strict", "--allow", "W-UNITS", "--allow", "W-CHECK"),
                     ("--allow", "W-CHECK")):
            self.write("q.yaml", PIPELINE.replace("out.ply", "out.glb"))
            self.same_thrice("run", "q.yaml", "-D", f"input={SCAN}", *more)

    def test_failing(self):
        self.write("q.yaml", PIPELINE.replace("{closed: false, severity: warn}", "{faces: 7}"))
        code, _, files = self.same_thrice("run", "q.yaml", "-D", f"input={SCAN}")
        self.assertEqual(code, 1)
        self.assertEqual(list(files), ["out.json"])
        self.write("q.yaml", PIPELINE.replace("relax: 1", "crop: {footprint: missing.svg}"))
        self.same_thrice("run", "q.yaml", "-D", f"input={SCAN}")

    def test_batch(self):
        for k in range(6):
            self.write(f"in/{k % 3}/m{k}.off", f"OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 {1 + k // 2}\n"
                                              "3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n")
        self.write("q.yaml", PIPELINE.replace("out.", "${input.stem}."))
        common = ("batch", "q.yaml", "--input", "in/**/*.off", "-j", "3", "--report", "all.json", "--report", "all.html")
        results = []
        for options in (("--no-cache",), ALL, ALL, (*ALL, "--strict")):
            shutil.rmtree(self.dir / "out", ignore_errors=True)  # the journal, too
            run = self.mill(*common, *options, "-q", "-o", "out", env=self.env,
                            expect=None)
            files = {k: v for k, v in self.files(self.dir / "out").items() if not k.startswith(".facetmill-batch")}
            results.append((run.returncode, sorted(run.stderr.splitlines()), files))
        self.assertEqual(results[1], results[0])
        self.assertEqual(results[2], results[0])
        self.assertEqual(results[0][0], 0)
        self.assertEqual(results[3][0], 1)


# Sanitizers watch the code of a hit and of a miss, not each stage in both: three runs of one shipped pipeline serve them.
for path in [SOURCE / "pipelines/quickstart.yaml"] if SLOW else sorted((SOURCE / "pipelines").rglob("*.yaml")):
    def test(self, path=path):
        self.check(path)
    setattr(HitEqualsMiss, "test_" + path.stem.replace("-", "_"), test)


class Corpus(Cache):
    @unittest.skipUnless(os.environ.get("FACETMILL_CORPUS"), "FACETMILL_CORPUS does not name a folder of meshes")
    def test_hit_equals_miss(self):
        """Every file of the corpus: the same outputs, reports, messages and exit code."""
        self.write("w.yaml", WINDING.replace("clean\n", "triangulate\n"))
        done = 0
        for mesh in sorted(pathlib.Path(os.environ["FACETMILL_CORPUS"]).resolve().rglob("*")):
            if mesh.suffix.lower() not in (".ply", ".obj", ".off", ".stl", ".glb", ".gltf", ".drc", ".gz"):
                continue
            if mesh.stat().st_size > int(os.environ.get("FACETMILL_CORPUS_BYTES", 4 << 20)):
                continue
            with self.subTest(mesh=mesh.name):
                self.same_thrice("run", "w.yaml", "-D", f"input={mesh}")
                done += 1
            shutil.rmtree(self.cache, ignore_errors=True)
        print(f"{done} files")
        self.assertGreater(done, 0)


class Keys(Cache):
    CACHED = ["load: from the cache", "relax: from the cache", "simplify: from the cache"]

    def test_what_does_not_matter(self):
        self.run_it("-j", "1")
        before = self.entries(".scene")
        self.write("p.yaml", "# a comment\n" + PIPELINE.replace("  - relax: 1", "\n  -   relax:   1   # once"))
        self.assertEqual(self.explained("-j", "3")[:3], self.CACHED)
        self.write("p.yaml", PIPELINE.replace("relax: 1", "relax: {iterations: 1}"))
        self.assertEqual(self.explained()[:3], self.CACHED)
        self.write("p.yaml", PIPELINE.replace("relax: 1", "relax: {iterations: 1, boundary: fixed}"))
        self.assertEqual(self.explained()[:3], self.CACHED)
        self.write("p.yaml", PIPELINE.replace("relax: 1", "{name: relax-it, relax: 1}"))
        self.assertEqual(self.explained()[:3], [line.replace("relax", "relax-it") for line in self.CACHED])
        self.write("other.yaml", PIPELINE.replace("out.ply", "another.ply"))
        self.assertEqual(self.explained(pipeline="other.yaml")[:3], self.CACHED)
        self.assertEqual(self.entries(".scene"), before)

    def test_a_run_says_that_it_used_the_cache(self):
        run = ("run", "p.yaml", "-D", f"input={SCAN}", *ALL, "-o", "out")
        self.assertNotIn("from the cache", self.mill(*run, env=self.env).stderr)
        self.assertIn("3 of 5 stages from the cache", self.mill(*run, env=self.env).stderr)
        self.assertNotIn("from the cache", self.mill(*run, "-q", env=self.env).stderr)
        self.assertNotIn("from the cache", self.mill(*run, "--no-cache", env=self.env).stderr)

    def test_another_folder(self):
        """The file is read, since reports name it; what comes of it is known."""
        self.run_it()
        (self.dir / "moved").mkdir()
        shutil.copy(SCAN, self.dir / "moved" / SCAN.name)
        lines = self.explained(scan=self.dir / "moved" / SCAN.name)
        self.assertIn("is read now", lines[0])
        self.assertEqual(lines[1:3], self.CACHED[1:])

    def test_a_failed_run_does_not_forget_what_it_did_not_reach(self):
        self.explained("-D", "keep=40%")
        self.write("p.yaml", PIPELINE.replace("relax: 1", "crop: {footprint: missing.svg}"))
        self.run_it(expect=None)
        self.write("p.yaml", PIPELINE)
        self.assertEqual(self.explained()[2], "simplify reruns: ratio 40% -> 50%")

    def test_what_matters(self):
        scan = self.dir / "scan.ply"
        shutil.copy(SCAN, scan)
        lines = self.explained(scan=scan)
        self.assertEqual(lines[0], "load runs: no earlier run wrote these outputs")
        self.assertEqual(lines[3:], ["validate: runs every time", "write: runs every time"])
        self.assertEqual(self.explained("-D", "keep=40%", scan=scan)[:3],
                         [*self.CACHED[:2], "simplify reruns: ratio 50% -> 40%"])
        self.write("p.yaml", PIPELINE.replace("relax: 1", "relax: {iterations: 2, lambda: 0.5}"))
        lines = self.explained("-D", "keep=40%", scan=scan)
        self.assertIn("relax reruns: iterations 1 -> 2", lines[1])
        self.assertIn("lambda", lines[1])
        self.write("p.yaml", PIPELINE.replace("relax: 1", "relax: {iterations: 0x2, lambda: 0.5}"))
        self.assertEqual(self.explained("-D", "keep=40%", scan=scan)[1], "relax reruns: its options are written differently")
        self.assertEqual(lines[2], "simplify reruns: the scene before it changed")
        data = bytearray(scan.read_bytes())
        data[data.index(b"end_header\n") + 11] ^= 1  # the last bit of a coordinate
        scan.write_bytes(data)
        lines = self.explained("-D", "keep=40%", scan=scan)
        self.assertTrue(lines[0].startswith("load reruns: ") and lines[0].endswith("scan.ply changed"), lines[0])

    def test_a_texture_that_was_refused(self):
        """Neither its bytes nor its absence tell that it may be read the next time."""
        (self.dir / "in").mkdir()
        (self.dir / "elsewhere.png").write_bytes(PNG)
        self.write("in/quad.obj", "mtllib quad.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nusemtl a\n"
                                  "f 1/1 2/2 3/3\n")
        self.write("in/quad.mtl", "newmtl a\nmap_Kd red.png\n")
        (self.dir / "in/red.png").symlink_to(self.dir / "elsewhere.png")
        run = ("pipe", *ALL, "-o", "out", "load", "in/quad.obj", "!", "write", "quad.glb")
        self.assertIn("W-IMAGE", self.mill(*run, env=self.env).stderr)
        refused = self.files(self.dir / "out")
        (self.dir / "in/red.png").unlink()
        (self.dir / "in/red.png").write_bytes(PNG)
        self.assertNotIn("W-IMAGE", self.mill(*run, env=self.env).stderr)
        self.assertNotEqual(self.files(self.dir / "out"), refused)

    def test_an_input_that_changes_is_stored_again(self):
        scan = self.dir / "scan.ply"
        shutil.copy(SCAN, scan)
        self.explained(scan=scan)
        data = bytearray(scan.read_bytes())
        data[data.index(b"end_header\n") + 11] ^= 1
        scan.write_bytes(data)
        self.assertIn("load reruns", self.explained(scan=scan)[0])
        self.assertEqual(self.explained(scan=scan)[:3], self.CACHED)

    def test_off(self):
        home = self.home()
        self.run_it(env={**home, "FACETMILL_CACHE": "off"})
        self.run_it("--no-cache", env=home)
        self.run_it(env={**home, "CI": "true"})
        self.assertEqual(list((self.dir / "home").iterdir()), [])
        self.run_it("--no-cache")
        self.assertFalse(self.cache.exists())
        run = self.mill("run", "p.yaml", "-D", f"input={SCAN}", "--cache", "--no-cache", expect=2)
        self.assertIn("exclude each other", run.stderr)


    def home(self):
        """The environment of a user who says nothing about a cache, in a home of his own."""
        (self.dir / "home").mkdir()
        return {"FACETMILL_CACHE": "", "CI": "", "XDG_CACHE_HOME": "", "HOME": str(self.dir / "home")}

    def test_usual_places(self):
        home = self.home()
        self.run_it(env={**home, "XDG_CACHE_HOME": str(self.dir / "xdg")})
        self.assertTrue(list((self.dir / "xdg/facetmill").rglob("*.scene")))
        self.assertEqual(list((self.dir / "home").iterdir()), [])
        self.run_it(env=home)
        usual = self.dir / "home/.cache/facetmill"
        self.assertTrue(list(usual.rglob("*.scene")))
        self.assertEqual(usual.stat().st_mode & 0o777, 0o700)
        self.assertIn(str(usual), self.mill("cache", "stats", env=home).stdout)
        self.assertEqual(self.mill("cache", "stats", env=home).stdout, self.mill("cache", env=home).stdout)
        for env in ({**home, "XDG_CACHE_HOME": "relative"}, {**home, "CI": "false"}):
            run = self.mill("run", "p.yaml", "-D", f"input={SCAN}", *ALL, "--explain", "-o", "out", env=env)
            self.assertIn("relax: from the cache", run.stderr)
        shutil.rmtree(usual)
        self.run_it("--cache", env={**home, "CI": "true"})
        self.assertTrue(list(usual.rglob("*.scene")))
        self.run_it(env={**self.env, "CI": "true"})
        self.assertTrue(self.entries(".scene"))

    def test_who_did_not_ask_is_not_bothered(self):
        """No home, one of another user, one that cannot be written: nothing is said, and the run is as without a cache."""
        home = self.home()
        expected = self.run_it("--no-cache", env=home)
        for nowhere in ("", "relative", str(self.dir / "none"), "/proc/none"):
            self.assertEqual(self.run_it(env={**home, "HOME": nowhere}), expected)
            self.assertFalse((self.dir / "none").exists())
            self.assertIn("the cache has no folder", self.mill("cache", "stats", env={**home, "HOME": nowhere}, expect=2).stderr)
            self.run_it("--cache", env={**home, "HOME": nowhere}, expect=2)
        (self.dir / "home/.cache").write_text("a file")
        self.assertEqual(self.run_it(env=home), expected)
        for asked in ("--cache", "--explain", "-v"):
            run = self.mill("run", "p.yaml", "-D", f"input={SCAN}", *ALL, asked, "-o", "out", env=home)
            self.assertEqual(run.stderr.count("warning[W-CACHE]"), 1, run.stderr)
        self.assertIn("cannot be written", self.mill("cache", "stats", env=home).stdout)
        self.assertFalse(json.loads(self.mill("cache", "stats", "--json", env=home).stdout)["writable"])
        (self.dir / "home/.cache").unlink()
        if os.geteuid() == 0:
            os.chown(self.dir / "home", 65534, 65534)
            self.assertEqual(self.run_it(env=home), expected)
            self.assertEqual(list((self.dir / "home").iterdir()), [])

    def test_what_ran_is_known_whatever_was_stored(self):
        run = ("run", "p.yaml", "-D", f"input={SCAN}", "-o", "out", "--explain")
        self.mill(*run, env=self.env)
        self.assertEqual(len(self.entries(".last")), 1)
        said = self.mill(*run, "-D", "keep=40%", env=self.env).stderr
        self.assertIn("simplify reruns: ratio 50% -> 40%", said)


class Trouble(Cache):
    def test_corrupt_entries(self):
        expected = self.run_it()
        for suffix in (".scene", ".memory", ".last"):
            for change in ("flip", "cut", "empty", "longer", "other"):
                for number, entry in enumerate(self.entries(suffix)):
                    data = bytearray(entry.read_bytes())
                    at = (number * 7919 + len(change) * 104729) % len(data)
                    if change == "flip":
                        data[at] ^= 1 << (number % 8)
                    elif change == "cut":
                        del data[at:]
                    elif change == "empty":
                        data = b""
                    elif change == "longer":
                        data += b"x"
                    else:
                        data = self.entries(suffix)[number - 1].read_bytes()
                    entry.write_bytes(data)
                code, said, files = self.run_it("--cache-everything")
                self.assertEqual((code, files), (expected[0], expected[2]), f"{suffix} {change}")
                notes = self.mill("run", "p.yaml", "-D", f"input={SCAN}", *ALL, "-o", "out", env=self.env).stderr
                self.assertNotIn("W-CACHE", notes, "the entries are whole again")

    def test_a_corrupt_entry_is_told(self):
        self.run_it()
        for entry in self.entries(".memory"):
            entry.write_bytes(b"nonsense")
        run = self.mill("run", "p.yaml", "-D", f"input={SCAN}", *ALL, "-o", "out", "--strict", "--allow", "W-CHECK",
                        env=self.env)
        self.assertIn("note[W-CACHE]", run.stderr)

    def test_unwritable(self):
        expected = self.run_it()
        self.write("file", "")
        for options in ((), ("--strict", "--allow", "W-CHECK")):
            code, said, files = self.run_it(*options, env={"FACETMILL_CACHE": str(self.dir / "file/cache")})
            self.assertEqual((code, files), (0, expected[2]))
            self.assertEqual(said.count("warning[W-CACHE]"), 1, said)
        said = self.run_it("--allow", "W-CACHE", env={"FACETMILL_CACHE": str(self.dir / "file/cache")})[1]
        self.assertNotIn("W-CACHE", said)

    def test_only_the_limit_is_kept(self):
        expected = self.run_it()
        size = max(entry.stat().st_size for entry in self.entries(".scene"))
        shutil.rmtree(self.cache)
        limit = 2 * size
        for keep in ("50%", "40%", "30%", "20%", "50%"):
            got = self.run_it("-D", f"keep={keep}", env={**self.env, "FACETMILL_CACHE_SIZE": str(limit)})
            there = sum(p.stat().st_size for p in self.cache.rglob("*") if p.is_file())
            self.assertLessEqual(there, limit)
        self.assertEqual(got[2], expected[2])
        self.run_it(env={**self.env, "FACETMILL_CACHE_SIZE": "1"})
        self.mill("run", "p.yaml", "-D", f"input={SCAN}", expect=2, env={**self.env, "FACETMILL_CACHE_SIZE": "much"})

    def test_only_plain_files_are_read(self):
        """What somebody else may have put there: pipes, links, a file that says it is huge."""
        expected = self.run_it()
        for entry in self.entries(".memory"):
            entry.unlink()
            os.mkfifo(entry)
        self.assertEqual(self.run_it(), expected)
        for entry in self.entries(".scene"):
            whole = entry.with_name("whole")
            entry.rename(whole)
            entry.symlink_to(whole)
        os.utime(whole, (1000, 1000))
        self.assertEqual(self.run_it(), expected)
        self.assertEqual(whole.stat().st_mtime, 1000, "nothing is done by way of links")
        for entry in self.entries(".memory"):
            os.truncate(entry, 1 << 40)
        code, said, files = self.run_it()
        self.assertEqual((code, files), (expected[0], expected[2]))
        self.assertTrue(all(entry.stat().st_size < 1 << 20 for entry in self.entries(".memory")))
        for folder in [self.cache, *(p for p in self.cache.iterdir())]:
            self.assertEqual(folder.stat().st_mode & 0o777, 0o700)

    @unittest.skipIf(SLOW, "sanitizers need more addresses than the limit")
    def test_a_union_that_was_refused_for_memory(self):
        """It is done when there is enough."""
        sphere = "generate: {shape: icosphere, subdivisions: 4, noise: 0.01, seed: %d}"
        self.write("u.yaml", "facetmill: 1\nstages:\n  - foreach: {seed: [1, 2]}\n    join: true\n    do:\n      - "
                   + sphere.replace("%d", '"${seed}"')
                   + "\n  - merge\n  - clean: {self_intersections: union}\n  - write: u.ply\n")
        self.write("v.yaml", (self.dir / "u.yaml").read_text().replace("  - clean: {self_intersections: union}\n", ""))
        expected = self.told("run", "u.yaml", "--no-cache")
        self.assertNotIn("not enough memory", expected[1])
        least = self.least_memory("run", "v.yaml", "--no-cache")
        refused = self.limited(least + (8 << 20), "run", "u.yaml", *ALL, "-q", "-j1", "-o", "out")
        self.assertIn("there is not enough memory to cut", refused.stderr)
        self.assertEqual(refused.returncode, 0)
        self.assertEqual(self.told("run", "u.yaml", *ALL), expected)
        self.write("c.yaml", (self.dir / "u.yaml").read_text()
                   .replace("  - merge\n  - clean: {self_intersections: union}\n", "  - combine\n"))
        refused = self.limited(least + (8 << 20), "run", "c.yaml", *ALL, "-q", "-j1", "-o", "out")
        self.assertEqual(refused.returncode, 7)
        self.assertIn("there is not enough memory to cut", refused.stderr)
        self.assertIn("combine fewer parts at a time", refused.stderr)
        self.assertEqual(self.told("run", "c.yaml", *ALL)[0], 0)

    @unittest.skipIf(SLOW, "sanitizers need more addresses than the limit")
    def test_without_memory(self):
        """Exit code 7, or all as it should be, whatever the cache has when memory ends."""
        self.write("p.yaml", PIPELINE.replace("relax: 1", "split: midpoint"))  # much more than the libraries take
        scan = SOURCE / "examples/data/nefertiti.ply"
        command = ("run", "p.yaml", "-D", f"input={scan}")
        expected = self.told(*command, *ALL, "-j1")
        run = (*command, *ALL, "-q", "-j1", "-o", "out")
        least = self.least_memory(*command, "--no-cache")
        codes = set()
        for suffix in ("", ".scene"):
            for entry in self.entries(suffix) if suffix else ():
                entry.unlink()
            for part in (0.7, 0.9):
                code = self.limited(int(part * least), *run).returncode
                codes.add(code)
                self.assertIn(code, (0, 7))
                self.assertFalse([p for p in self.cache.rglob("*.part")])
        self.assertIn(7, codes)
        self.assertEqual(self.told(*command, *ALL, "-j1"), expected)

    def limited(self, addresses, *arguments):
        """A run that may take so many bytes of addresses."""
        return subprocess.run([str(FACETMILL), *arguments], cwd=self.dir, env={**os.environ, **self.env}, capture_output=True,
                              text=True, timeout=300,
                              preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, (addresses, addresses)))

    def least_memory(self, *arguments):
        """About how many bytes of addresses a run takes."""
        low, high = 40 << 20, 640 << 20  # with less not even the threads begin
        while high - low > high // 16:
            middle = (low + high) // 2
            done = self.limited(middle, *arguments, "-q", "-j1", "-o", "least").returncode == 0
            low, high = (low, middle) if done else (middle, high)
        return high

    def test_a_disk_that_is_nearly_full(self):
        """It keeps its last 64 MiB, and says so once, since the folder was named."""
        self.cache.mkdir()
        mount = subprocess.run(["mount", "-t", "tmpfs", "-o", "size=48m", "tmpfs", str(self.cache)], capture_output=True)
        if mount.returncode:
            self.skipTest("only root may mount")
        self.addCleanup(subprocess.run, ["umount", str(self.cache)], check=False)
        code, said, _ = self.run_it()
        self.assertEqual((code, said.count("W-CACHE")), (0, 1), said)
        self.assertEqual([p for p in self.cache.rglob("*") if p.is_file()], [])

    def test_names_that_another_process_has_taken(self):
        """Two of one number in two containers, or one that was killed."""
        self.run_it()
        entries = self.entries(".scene") + self.entries(".memory")
        for entry in entries:
            entry.unlink()

        def taken():
            for entry in entries:
                for number in range(40):
                    (entry.parent / f".{os.getpid()}-{number}.part").touch()

        run = subprocess.run([str(FACETMILL), "run", "p.yaml", "-D", f"input={SCAN}", *ALL, "-q", "-o", "out"], cwd=self.dir,
                             env={**os.environ, **self.env}, capture_output=True, text=True, preexec_fn=taken, timeout=600)
        self.assertEqual((run.returncode, "W-CACHE" in run.stderr), (0, False), run.stderr)
        self.assertEqual(self.entries(".scene") + self.entries(".memory"), entries)

    def test_a_mapped_file_that_changes_while_it_is_loaded(self):
        """Nobody knows which bytes were read."""
        mesh = self.dir / "large.ply"
        rows = 1 << 20
        with mesh.open("wb") as file:
            file.write(b"ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
                       b"property float z\nelement face 1\nproperty list uchar uint vertex_indices\nelement padding %d\n"
                       % rows + b"".join(b"property double p%d\n" % k for k in range(8)) + b"end_header\n"
                       + struct.pack("<9fB3I", 0, 0, 0, 1, 0, 0, 0, 1, 0, 3, 0, 1, 2))
            file.truncate(file.tell() + 64 * rows)
        self.write("m.yaml", f"facetmill: 1\nstages: [load: {mesh}, split: midpoint, write: o.ply]\n")
        run = ("run", "m.yaml", *ALL, "--explain", "-o", "out")
        changing = subprocess.Popen([str(FACETMILL), *run], cwd=self.dir, env={**os.environ, **self.env},
                                    stderr=subprocess.DEVNULL)
        while changing.poll() is None:
            os.utime(mesh)
        self.assertEqual(changing.returncode, 0)
        for way in ("load reruns: its result was not stored", "load: from the cache"):
            self.assertIn(way, self.mill(*run, env=self.env).stderr)

    def test_processes_share_it(self):
        expected = self.run_it("--no-cache")[2]
        for _ in range(2):
            runs = [subprocess.Popen([str(FACETMILL), "run", "p.yaml", "-D", f"input={SCAN}", *ALL, "-q", "-j", "1", "-o",
                                      f"out{k}"], cwd=self.dir, env={**os.environ, **self.env},
                                     stderr=subprocess.PIPE, text=True) for k in range(4)]
            for k, run in enumerate(runs):
                said = run.communicate(timeout=600)[1]
                self.assertEqual((run.returncode, "W-CACHE" in said), (0, False), said)
                self.assertEqual(self.files(self.dir / f"out{k}"), expected)
        self.assertEqual([p for p in self.cache.rglob("*.part")], [])

    def test_clear_while_it_runs(self):
        expected = self.run_it("--no-cache")[2]
        runs = [subprocess.Popen([str(FACETMILL), "run", "p.yaml", "-D", f"input={SCAN}", *ALL, "-q", "-j", "1", "-o",
                                  f"out{k}"], cwd=self.dir, env={**os.environ, **self.env}, stderr=subprocess.DEVNULL) for k in range(2)]
        while any(run.poll() is None for run in runs):
            self.mill("cache", "clear", env=self.env)
        for k, run in enumerate(runs):
            self.assertEqual((run.returncode, self.files(self.dir / f"out{k}")), (0, expected))


class Command(Cache):
    def test_stats_gc_clear(self):
        self.run_it()
        stats = self.mill("cache", "stats", env=self.env).stdout
        self.assertIn(str(self.cache), stats)
        self.assertIn("3 of them scenes", stats)
        stranger = self.cache / "ab" / "mine.txt"
        stranger.parent.mkdir(exist_ok=True)
        stranger.write_text("not of the cache")
        left = stranger.with_name(".1-0.part")
        left.write_text("of a process that was killed")
        os.utime(left, (1, 1))
        self.mill("cache", "gc", env=self.env)
        self.assertFalse(left.exists())
        self.assertEqual(len(self.entries(".scene")), 3)
        self.mill("cache", "gc", env={**self.env, "FACETMILL_CACHE_SIZE": "1K"})
        self.assertEqual(self.entries(".scene"), [])
        self.run_it()
        self.assertIn("removed", self.mill("cache", "clear", env=self.env).stdout)
        self.assertEqual([p for p in self.cache.rglob("*") if p.is_file()], [stranger])
        left.write_text("of a process that has just been killed")
        self.assertIn("0 entries", self.mill("cache", "stats", env=self.env).stdout)
        self.assertEqual(json.loads(self.mill("cache", "stats", "--json", env=self.env).stdout)["bytes"], 0)
        self.mill("cache", "gc", env=self.env)
        self.assertTrue(left.exists())
        self.mill("cache", "clear", env=self.env)
        self.assertFalse(left.exists())
        self.mill("cache", "empty", expect=2)

    def test_restat(self):
        self.run_it()
        outputs = [self.dir / "out/out.ply", self.dir / "out/out.json"]
        run = ("run", "p.yaml", "-D", f"input={SCAN}", *ALL, "-q", "-o", "out")
        for path in outputs:
            os.utime(path, (1000, 1000))
        self.mill(*run, "--restat", env=self.env)
        self.assertEqual([path.stat().st_mtime for path in outputs], [1000, 1000])
        self.write("tri.obj", "mtllib missing.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
        self.mill("pipe", *ALL, "-o", "out", "load", "tri.obj", "!", "write", "tri.ply", env=self.env)
        os.utime(self.dir / "out/tri.ply", (1000, 1000))
        self.mill("pipe", *ALL, "-o", "out", "--restat", "--depfile", "tri.d", "load", "tri.obj", "!", "write", "tri.ply",
                  env=self.env)
        self.assertEqual((self.dir / "out/tri.ply").stat().st_mtime, 1000)
        (self.dir / "out/tri.ply").unlink()
        self.mill(*run, "--restat", "-D", "keep=40%", env=self.env)
        self.assertTrue(all(path.stat().st_mtime > 1000 for path in outputs))
        for path in outputs:
            os.utime(path, (1000, 1000))
        self.mill(*run, "-D", "keep=40%", env=self.env)
        self.assertTrue(all(path.stat().st_mtime > 1000 for path in outputs))
        self.assertEqual([p.name for p in (self.dir / "out").iterdir() if p.name not in ("out.ply", "out.json")], [])


class FullDisk(Case):
    def test_a_full_disk_is_told_once_and_the_run_goes_on(self):
        (self.dir / "disk").mkdir()
        if subprocess.run(["mount", "-t", "tmpfs", "-o", "size=60m", "tmpfs", str(self.dir / "disk")], capture_output=True).returncode:
            self.skipTest("only root may mount")
        self.addCleanup(subprocess.run, ["umount", str(self.dir / "disk")], check=False, capture_output=True)
        self.write("p.yaml", PIPELINE.replace("  - load: \"${input}\"\n", "  - load: \"${input}\"\n  - relax: 2\n"))
        env = {**os.environ, "FACETMILL_CACHE": str(self.dir / "disk/cache")}
        run = subprocess.run([str(FACETMILL), "run", "p.yaml", "-D", f"input={SCAN}", "--cache-everything", "--allow", "W-UNITS"],
                             cwd=self.dir, env=env, capture_output=True, text=True, timeout=60)
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertEqual(run.stderr.count("W-CACHE"), 1, run.stderr)
        self.assertIn("is nearly full", run.stderr)
        self.assertTrue((self.dir / "out.ply").exists())


if __name__ == "__main__":
    main()
