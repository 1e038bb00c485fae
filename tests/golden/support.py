"""What the tests of the real executable share. Only the standard library."""

import hashlib
import json
import os
import pathlib
import shutil
import struct
import subprocess
import sys
import tempfile
import unittest
import zlib

SOURCE = pathlib.Path(__file__).resolve().parents[2]
FACETMILL = pathlib.Path(os.environ.get("FACETMILL", SOURCE / "build/release/facetmill")).resolve()
os.environ["FACETMILL_CACHE"] = "off"  # a user's cache is none of the tests'; those of the cache have their own
SCAN = SOURCE / "examples/data/nefertiti.ply"
# CI sets it: nothing may be skipped there for want of a tool.
STRICT = os.environ.get("FACETMILL_REQUIRE_VALIDATOR") == "1"
# Under sanitizers everything is ten times slower; the variants of a run are compared in the release build.
SLOW = os.environ.get("FACETMILL_SLOW") == "1"


def png(red, green, blue):
    """A picture of one pixel."""
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", 1, 1, 8, 2, 0, 0, 0))
            + chunk(b"IDAT", zlib.compress(bytes([0, red, green, blue]))) + chunk(b"IEND", b""))


class Case(unittest.TestCase):
    """A test in a folder of its own."""

    def setUp(self):
        self.dir = pathlib.Path(tempfile.mkdtemp(prefix="facetmill-test-"))
        self.addCleanup(shutil.rmtree, self.dir, ignore_errors=True)

    def mill(self, *arguments, expect=0, cwd=None, env=None, stdin=None, text=True):
        """Runs facetmill and checks its exit code (None: any)."""
        run = subprocess.run([str(FACETMILL), *map(str, arguments)], cwd=cwd or self.dir, capture_output=True,
                             input=stdin, text=text, env={**os.environ, **(env or {})}, timeout=600)
        if expect is not None:
            self.assertEqual(run.returncode, expect, f"facetmill {' '.join(map(str, arguments))}\n{run.stderr}")
        return run

    def write(self, name, text):
        path = self.dir / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
        return path

    def files(self, folder=None):
        """Every file under the folder, by relative name, with its SHA-256."""
        folder = folder or self.dir
        return {p.relative_to(folder).as_posix(): hashlib.sha256(p.read_bytes()).hexdigest()
                for p in sorted(folder.rglob("*")) if p.is_file()}

    def gltf_with_neighbours(self, folder=None):
        """t.gltf with t.bin and tex.png beside it."""
        folder = folder or self.dir
        (folder / "t.bin").write_bytes(struct.pack("<9f", 0, 0, 0, 1, 0, 0, 0, 1, 0))
        (folder / "tex.png").write_bytes(png(200, 30, 30))
        (folder / "t.gltf").write_text(json.dumps({
            "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
            "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "material": 0}]}],
            "materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}],
            "textures": [{"source": 0}], "images": [{"uri": "tex.png"}],
            "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0],
                           "max": [1, 1, 0]}],
            "bufferViews": [{"buffer": 0, "byteLength": 36}], "buffers": [{"uri": "t.bin", "byteLength": 36}]}))

    def installed(self):
        """Where facetmill is installed as `make install` does it: what find_package(facetmill) looks for."""
        prefix = self.dir / "prefix"
        run = subprocess.run([self.need("cmake"), "--install", os.environ.get("FACETMILL_BUILD", FACETMILL.parent),
                              "--prefix", prefix], capture_output=True, text=True, timeout=600)
        self.assertEqual(run.returncode, 0, run.stderr)
        return prefix

    def need(self, tool, in_ci=True):
        """The path of an optional tool. Without it the test is skipped, with a notice, unless CI has to have it."""
        path = shutil.which(tool)
        if path is None:
            if STRICT and in_ci:
                self.fail(f"{tool} is missing (tools/deps.sh --all installs it)")
            print(f"notice: {tool} is missing, skipped {self.id()}", file=sys.stderr)
            self.skipTest(f"{tool} is missing")
        return path


class LargeCase(Case):
    """With a mesh that is made once."""

    @classmethod
    def setUpClass(cls):
        cls.meshes = pathlib.Path(tempfile.mkdtemp(prefix="facetmill-test-"))
        cls.addClassCleanup(shutil.rmtree, cls.meshes, ignore_errors=True)

    def large(self, passes=1):
        """A closed scan of 70,000 * 4^passes faces, in the test's folder."""
        made = self.meshes / f"{passes}.ply"
        if not made.exists():
            self.mill("pipe", "load", SCAN, "!", "split", "midpoint", "--passes", passes, "!", "write", made)
        return pathlib.Path(shutil.copy(made, self.dir / "large.ply"))


def main():
    unittest.main(verbosity=2)
