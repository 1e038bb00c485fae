"""textures: {format: ktx2}, with a program that stands for ktx: what it is given, what becomes of what it gives, and of its
faults."""

import json
import os
import struct
import subprocess
import sys
import time
import unittest
import zlib

from support import FACETMILL, Case, main

# Writes the header of a KTX2 file of the image's size, and its own arguments into it.
FAKE = r"""#!%s
import json, os, signal, struct, sys, time
how = open(os.path.join(os.path.dirname(os.path.abspath(__file__)), "how")).read()
if sys.argv[1:] == ["--version"]:
    print("ktx version: v4.3.2" if how == "old" else "ktx version: v4.4.2")
    sys.exit(0)
if how == "fail":
    print("ktx create fatal: the image is too blue", file=sys.stderr)
    sys.exit(3)
if how == "signal": os.kill(os.getpid(), signal.SIGSEGV)
if how == "sleep": time.sleep(1000)
source, target = [a for a in sys.argv if a.endswith(".png")][0], [a for a in sys.argv if a.endswith(".ktx2")][0]
png = open(source, "rb").read()
width, height, depth, colour = struct.unpack(">IIBB", png[16:26])
told = json.dumps({"arguments": sys.argv[1:], "colour": colour, "net": 0}).encode()
head = b"\xabKTX 20\xbb\r\n\x1a\n" + struct.pack("<12I", 0, 1, width + (how == "wider"), height, 0, 0, 1, 1, 1, 0, 0, 0)
out = b"something else" if how == "junk" else head + bytes(80 - len(head)) + told
if how == "elsewhere":
    try:
        open(os.path.join(os.path.dirname(os.path.abspath(__file__)), "written"), "w")
    except OSError: pass
if how != "nothing": open(target, "wb").write(out)
""" % sys.executable


def image(width, height, alpha=False):
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    rows = b"".join(b"\0" + b"".join(bytes([x % 256, y % 256, (x * y) % 256] + ([x % 2 * 255] if alpha else []))
                                     for x in range(width)) for y in range(height))
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 6 if alpha else 2, 0, 0, 0))
            + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))


ROLES = {"colour": {"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}},
         "covering": {"alphaMode": "BLEND", "pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}},
         "normals": {"normalTexture": {"index": 0}},
         "data": {"pbrMetallicRoughness": {"metallicRoughnessTexture": {"index": 0}}},
         "mixed": {"occlusionTexture": {"index": 0}, "emissiveTexture": {"index": 0}}}


class Ktx2(Case):
    def setUp(self):
        super().setUp()
        self.tool("ktx")
        self.asset("colour", image(8, 8))

    def tool(self, name, how=""):
        folder = self.dir / "bin"
        self.write(f"bin/{name}", FAKE).chmod(0o755)
        self.write("bin/how", how)
        self.env = {"PATH": f"{folder}:{os.environ['PATH']}", "TMPDIR": str(self.dir / "tmp")}
        (self.dir / "tmp").mkdir(exist_ok=True)
        return folder / name

    def asset(self, role, png, name="t.gltf"):
        (self.dir / "t.bin").write_bytes(struct.pack("<9f", 0, 0, 0, 1, 0, 0, 0, 1, 0))
        (self.dir / "tex.png").write_bytes(png)
        (self.dir / name).write_text(json.dumps({
            "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
            "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "material": 0}]}],
            "materials": [ROLES[role]], "textures": [{"source": 0}], "images": [{"uri": "tex.png"}],
            "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0],
                           "max": [1, 1, 0]}],
            "bufferViews": [{"buffer": 0, "byteLength": 36}], "buffers": [{"uri": "t.bin", "byteLength": 36}]}))

    def run_it(self, *options, expect=0, output="out.glb", env=None):
        return self.mill("pipe", "load", "t.gltf", "!", "textures", "--format", "ktx2", *options, "!", "write", output,
                         expect=expect, env={**self.env, **(env or {})})

    def document(self, name="out.glb"):
        data = (self.dir / name).read_bytes()
        size = struct.unpack("<I", data[12:16])[0]
        return json.loads(data[20:20 + size]), data[20 + size + 8:]

    def told(self, name="out.glb"):
        """What the program was given, and the size that it wrote."""
        document, binary = self.document(name)
        view = document["bufferViews"][document["images"][0]["bufferView"]]
        begin = view.get("byteOffset", 0)
        ktx = binary[begin:begin + view["byteLength"]]
        self.assertTrue(ktx.startswith(b"\xabKTX 20"))
        return {**json.loads(ktx[80:].rstrip(b"\0")), "size": struct.unpack("<2I", ktx[20:28])}

    def given(self, *options):
        self.run_it(*options)
        return " ".join(self.told()["arguments"])

    def test_the_texture_names_it_by_the_extension(self):
        self.run_it()
        document, _ = self.document()
        self.assertEqual(document["images"][0]["mimeType"], "image/ktx2")
        self.assertEqual(document["textures"], [{"extensions": {"KHR_texture_basisu": {"source": 0}}}])
        for names in ("extensionsUsed", "extensionsRequired"):
            self.assertEqual(document[names], ["KHR_texture_basisu"])

    def test_colour_spaces_and_codecs(self):
        first = "create --generate-mipmap --threads 1 --encode "
        for role, alpha, expected in (
                ("colour", False, "basis-lz --clevel 2 --qlevel 204 --format R8G8B8_SRGB --assign-tf srgb --assign-primaries bt709"),
                ("colour", True, "basis-lz --clevel 2 --qlevel 204 --format R8G8B8_SRGB --assign-tf srgb --assign-primaries bt709"),
                ("covering", True, "basis-lz --clevel 2 --qlevel 204 --format R8G8B8A8_SRGB --assign-tf srgb --assign-primaries bt709"),
                ("data", False, "basis-lz --clevel 2 --qlevel 229 --format R8G8B8_UNORM --assign-tf linear --assign-primaries none"),
                ("normals", False, "uastc --uastc-quality 2 --zstd 18 --format R8G8B8_UNORM --assign-tf linear --assign-primaries none")):
            with self.subTest(role=role, alpha=alpha):
                self.asset(role, image(8, 8, alpha))
                self.assertEqual(self.given(), first + expected + " in.png out.ktx2")
                self.assertEqual(self.told()["colour"], 6 if "A8" in expected else 2)

    def test_older_programs(self):
        self.tool("ktx", "old")
        self.assertIn("--assign-oetf srgb", self.given())
        (self.dir / "bin/ktx").unlink()
        self.tool("toktx")
        if subprocess.run(["sh", "-c", "command -v ktx"], env={**os.environ, **self.env}, capture_output=True).returncode:
            self.assertEqual(self.given("--quality", "50"), "--t2 --genmipmap --threads 1 --encode etc1s --clevel 2 --qlevel 127 "
                             "--assign_oetf srgb --assign_primaries bt709 --target_type RGB out.ktx2 in.png")

    def test_sides_are_multiples_of_four_and_never_larger(self):
        for given, options, size in (((23, 8), (), (20, 8)), ((64, 64), ("--max-size", "30"), (28, 28)),
                                     ((40, 40), ("--power-of-two",), (32, 32))):
            self.asset("colour", image(*given))
            self.run_it(*options)
            self.assertEqual(self.told()["size"], size)

    def test_images_that_stay(self):
        for role, png, why in (("colour", image(3, 8), "multiples of 4"), ("mixed", image(8, 8), "as colours and as numbers")):
            with self.subTest(role=role):
                self.asset(role, png)
                told = self.run_it().stderr
                self.assertIn("W-TEXTURE-KEPT", told)
                self.assertIn(why, told)
                self.assertEqual(self.document()[0]["images"][0]["mimeType"], "image/png")

    def test_faults_are_errors_and_leave_nothing(self):
        for how, said in (("fail", "failed with exit code 3: ktx create fatal: the image is too blue"),
                          ("signal", "was ended by signal 11"), ("junk", "wrote no KTX2"), ("wider", "wrote no KTX2"),
                          ("nothing", "wrote no file")):
            with self.subTest(how=how):
                self.write("bin/how", how)
                told = self.run_it(expect=5).stderr
                self.assertIn("E-KTX", told)
                self.assertIn("for the image 'tex.png' ktx " + said, told)
                self.assertFalse((self.dir / "out.glb").exists())
        self.gone()

    def gone(self):
        """Nothing is left of the folders that the program worked in, soon after."""
        for _ in range(100):
            if not list((self.dir / "tmp").iterdir()):
                return
            time.sleep(0.05)
        self.fail(f"left: {list((self.dir / 'tmp').rglob('*'))}")

    def test_one_that_never_ends(self):
        self.write("bin/how", "sleep")
        began = time.monotonic()
        self.assertIn("took longer than 1 s", self.run_it("--timeout", "1", expect=5).stderr)
        self.assertLess(time.monotonic() - began, 60)
        self.gone()

    def test_a_run_that_is_killed_takes_it_along(self):
        self.write("bin/how", "sleep")
        run = subprocess.Popen([str(FACETMILL), "pipe", "load", "t.gltf", "!", "textures", "--format", "ktx2", "!", "write",
                                "out.glb"], cwd=self.dir, env={**os.environ, **self.env}, stderr=subprocess.DEVNULL)
        while not list((self.dir / "tmp").rglob("log")):
            time.sleep(0.02)
        run.kill()
        run.wait()
        self.gone()

    def test_without_the_program(self):
        for env in ({"FACETMILL_KTX": "nowhere/ktx"}, {"FACETMILL_KTX": str(self.dir / "t.bin")}):
            told = self.run_it(expect=2, env=env).stderr
            self.assertIn("E-KTX", told)
            self.assertIn("FACETMILL_KTX is not the path of a program", told)
        told = self.run_it(expect=2, env={"PATH": "/nowhere"}).stderr
        self.assertIn("neither is in PATH", told)
        self.assertIn("KTX-Software", told)
        self.run_it(env={"PATH": "/nowhere", "FACETMILL_KTX": str(self.dir / "bin/ktx")})

    def test_it_may_write_nowhere_else(self):
        version = json.loads(self.mill("--version", "--json").stdout)["sandbox"]
        self.write("bin/how", "elsewhere")
        self.run_it()
        self.assertEqual((self.dir / "bin/written").exists(), version["landlock"] == 0)

    def test_the_same_bytes_for_any_threads_and_in_a_batch(self):
        for threads in ("1", "3"):
            self.mill("pipe", "-j", threads, "-o", threads, "load", "t.gltf", "!", "textures", "--format", "ktx2", "!", "write",
                      "out.glb", env=self.env)
        self.write("b.yaml", "facetmill: 1\nparams: {input: path}\nstages:\n  - load: ${input}\n  - textures: {format: ktx2}\n"
                             "  - write: out.glb\n")
        self.mill("batch", "b.yaml", "--input", "t.gltf", "-o", "b", env=self.env)
        self.mill("pipe", "--no-sandbox", "-o", "n", "load", "t.gltf", "!", "textures", "--format", "ktx2", "!", "write",
                  "out.glb", env=self.env)
        files = self.files()
        self.assertEqual(len({files[f"{folder}/out.glb"] for folder in ("1", "3", "b", "n")}), 1)

    def test_what_is_ktx2_already_passes_through(self):
        self.run_it(output="one.glb")
        self.mill("pipe", "load", "one.glb", "!", "textures", "--format", "ktx2", "--max-size", "4", "!", "write", "two.glb",
                  env=self.env)
        self.assertEqual(self.told("one.glb"), self.told("two.glb"))
        self.assertEqual(self.document("two.glb")[0]["extensionsRequired"], ["KHR_texture_basisu"])
        self.mill("pipe", "load", "one.glb", "!", "split", "midpoint", "!", "write", "three.gltf")
        self.assertEqual(self.mill("pipe", "load", "three.gltf", "!", "write", "four.glb").returncode, 0)
        self.assertEqual(self.told("one.glb"), self.told("four.glb"))

    def test_textures_of_other_formats(self):
        """The document of an OBJ's materials is not the one that is written: what it requires comes along."""
        self.write("t.mtl", "newmtl m\nmap_Kd tex.png\n")
        self.write("t.obj", "mtllib t.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nusemtl m\nf 1/1 2/2 3/3\n")
        for kind, extension in (("ktx2", "KHR_texture_basisu"), ("webp", "EXT_texture_webp")):
            (self.dir / "tex.png").write_bytes(image(64, 64))
            self.mill("pipe", "load", "t.obj", "!", "textures", "--format", kind, "!", "write", "o.glb", env=self.env)
            document, _ = self.document("o.glb")
            self.assertEqual(document["textures"][0]["extensions"], {extension: {"source": 0}})
            self.assertEqual(document["extensionsRequired"], [extension])

    def test_a_gltf_has_it_beside(self):
        self.run_it(output="o/out.gltf")
        self.assertEqual(sorted(self.files(self.dir / "o")), ["out.bin", "out.gltf", "out.tex.ktx2"])


if __name__ == "__main__":
    main()
