"""Files that promise more than they hold. Memory stays within 4 GiB, the answer comes soon, and the exit code says why."""

import json
import os
import resource
import struct
import subprocess
import unittest

from support import FACETMILL, SLOW, Case, main

LIMIT = 4 << 30
MALFORMED, BEYOND = 6, 7


def varint(n):
    out = b""
    while n > 127:
        out += bytes([n & 127 | 128])
        n >>= 7
    return out + bytes([n])


def accessor(**more):
    return {"componentType": 5126, "count": 3, "type": "VEC3", **more}


def document(accessors, primitives=None, views=(), buffer_bytes=0, **more):
    return {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
            "meshes": [{"primitives": primitives or [{"attributes": {"POSITION": 0}}]}],
            "accessors": accessors, "bufferViews": list(views), "buffers": [{"byteLength": buffer_bytes}], **more}


def glb(content, binary=b"", total=None, json_length=None, binary_length=None):
    text = json.dumps(content).encode()
    text += b" " * (-len(text) % 4)
    binary += bytes(-len(binary) % 4)
    body = struct.pack("<I4s", len(text) if json_length is None else json_length, b"JSON") + text
    body += struct.pack("<I4s", len(binary) if binary_length is None else binary_length, b"BIN\0") + binary
    return struct.pack("<4sII", b"glTF", 2, 12 + len(body) if total is None else total) + body


def triangle(**more):
    return document([accessor(bufferView=0)], views=[{"buffer": 0, "byteLength": 36}], buffer_bytes=36, **more)


POINTS = struct.pack("<9f", 0, 0, 0, 1, 0, 0, 0, 1, 0)


def draco(method, faces, points, padding):
    """The header of Draco data, edgebreaker (1) or sequential (0), and bytes that are no mesh."""
    counts = [varint(faces), varint(points)] if method == 0 else [b"\0", varint(points), varint(faces)]
    return b"DRACO" + bytes([2, 2, 1, method, 0, 0]) + b"".join(counts) + bytes(padding)


# AddressSanitizer takes terabytes of addresses for itself, so that no such limit can be set beside it.
@unittest.skipIf(SLOW, "the limit of addresses does not go with AddressSanitizer")
class Bombs(Case):
    def check(self, name, content, code, message):
        path = self.dir / name
        path.write_bytes(content if isinstance(content, bytes) else json.dumps(content).encode())

        def limited():
            resource.setrlimit(resource.RLIMIT_AS, (LIMIT, LIMIT))

        run = subprocess.run([str(FACETMILL), "info", str(path)], capture_output=True, text=True, timeout=300,
                             preexec_fn=limited, cwd=self.dir)
        self.assertEqual(run.returncode, code, f"{name}\n{run.stderr}")
        self.assertIn(message, run.stderr + run.stdout, name)

    def test_accessors_without_the_bytes(self):
        view = [{"buffer": 0, "byteLength": 36}]
        for count in (2**31, 2**32, 2**63 - 1):
            self.check("zeros.glb", glb(document([accessor(count=count)])), BEYOND, "E-LIMIT")
        for count, code, message in ((2**31, MALFORMED, "E-BUFFER"), (2**31 + 1, BEYOND, "E-LIMIT"),
                                     (2**63 - 1, BEYOND, "E-LIMIT")):
            self.check("short.glb", glb(document([accessor(count=count, bufferView=0)], views=view, buffer_bytes=36),
                                        bytes(36)), code, message)
        self.check("real.glb", glb(document([accessor(count=1e300)])), MALFORMED, "E-GLTF")
        self.check("stride.glb", glb(document([accessor(bufferView=0, count=2**31)], buffer_bytes=36,
                                              views=[{"buffer": 0, "byteLength": 36, "byteStride": 0}]), bytes(36)),
                   MALFORMED, "byteStride")

    def test_sparse_accessors(self):
        views = [{"buffer": 0, "byteLength": 36}]
        part = {"bufferView": 0, "componentType": 5125}
        for count, sparse, code, message in ((2**31, 1, BEYOND, "E-LIMIT"), (3, 2**31, MALFORMED, "E-GLTF"),
                                             (1000000, 1000000, MALFORMED, "E-BUFFER")):
            content = document([accessor(count=count, sparse={"count": sparse, "indices": part, "values": part})],
                               views=views, buffer_bytes=36)
            self.check("sparse.glb", glb(content, b"\xff" * 36), code, message)
        content = document([accessor(count=8, sparse={"count": 2, "indices": part, "values": part})], views=views,
                           buffer_bytes=36)
        self.check("beyond.glb", glb(content, b"\xff" * 36), MALFORMED, "E-INDEX")

    def test_few_bytes_that_are_used_again_and_again(self):
        many = [accessor(count=20000000) for _ in range(200)]
        self.check("zeros.glb", glb(document(many, [{"attributes": {"POSITION": i}} for i in range(200)])), BEYOND,
                   "E-MEMORY")
        points = bytes(12 * 60000)
        views = [{"buffer": 0, "byteLength": len(points)}]
        one = [accessor(count=60000, bufferView=0)]
        primitives = [{"attributes": {"POSITION": 0, f"_{i}": 0}} for i in range(20000)]
        self.check("again.glb", glb(document(one, primitives, views, len(points)), points), BEYOND, "E-MEMORY")
        nodes = document(one, None, views, len(points))
        nodes["nodes"] = [{"mesh": 0}] * 100000
        nodes["scenes"] = [{"nodes": list(range(100000))}]
        points = struct.pack("<180000f", *range(180000))
        self.check("nodes.glb", glb(nodes, points), BEYOND, "E-MEMORY")

    def test_compressed_views(self):
        blocks = 8192  # of 32 vertices of 256 bytes, all zero: 32 bytes out for one in
        data = b"\xa0" + bytes(blocks * 256 + 256)
        meshopt = {"buffer": 0, "byteLength": len(data), "byteStride": 256, "count": blocks * 32, "mode": "ATTRIBUTES"}
        view = {"buffer": 0, "byteLength": 64 << 20, "byteStride": 256, "extensions": {"EXT_meshopt_compression": meshopt}}
        count = 100
        content = document([accessor(bufferView=i, count=1000) for i in range(count)],
                           [{"attributes": {"POSITION": i}} for i in range(count)], [view] * count, len(data))
        self.check("meshopt.glb", glb(content, data), BEYOND, "E-MEMORY")
        for wrong in (2**31, 2**62):
            meshopt["count"] = wrong
            self.check("count.glb", glb(content, data), MALFORMED, "cannot hold")

    def test_draco_headers(self):
        for method in (0, 1):
            for faces, points in ((2**32 - 1, 3), (2**31, 2**31), (1, 2**32 - 1)):
                self.check("few.drc", draco(method, faces, points, 100), MALFORMED, "E-DRACO")
                self.check("many.drc", draco(method, faces, points, 1 << 20), BEYOND, "E-MEMORY")
            self.check("zeros.drc", draco(method, 5000000, 5000000, 4096), MALFORMED, "E-DRACO")
        data = draco(1, 2**31, 2**31, 1 << 20)
        compressed = {"KHR_draco_mesh_compression": {"bufferView": 0, "attributes": {"POSITION": 0}}}
        content = document([accessor()], [{"attributes": {"POSITION": 0}, "extensions": compressed}],
                           [{"buffer": 0, "byteLength": len(data)}], len(data))
        self.check("draco.glb", glb(content, data), BEYOND, "E-MEMORY")

    def test_glb_lengths(self):
        for more in ({"total": 2**32 - 1}, {"total": 13}, {"json_length": 2**32 - 1}, {"json_length": 0},
                     {"binary_length": 2**32 - 4}):
            self.check("lengths.glb", glb(triangle(), POINTS, **more), MALFORMED, "E-GLB")
        content = triangle()
        content["buffers"][0]["byteLength"] = 2**62
        self.check("buffer.glb", glb(content, POINTS), MALFORMED, "E-BUFFER")

    def test_files_beside_that_are_endless(self):
        with open(self.dir / "endless.bin", "wb") as file:
            os.truncate(file.fileno(), 1 << 40)
        self.check("image.glb", glb(triangle(images=[{"uri": "endless.bin"}]), POINTS), BEYOND, "E-MEMORY")
        content = triangle()
        content["buffers"] = [{"byteLength": 1 << 40, "uri": "endless.bin"}]
        self.check("buffer.gltf", content, BEYOND, "E-MEMORY")

    def test_images_are_not_unpacked(self):
        head = struct.pack(">IIBBBBB", 2**31 - 1, 2**31 - 1, 16, 6, 0, 0, 0)
        png = b"\x89PNG\r\n\x1a\n" + struct.pack(">I", 13) + b"IHDR" + head[:13] + bytes(4)
        content = triangle(images=[{"bufferView": 1, "mimeType": "image/png"}])
        content["bufferViews"].append({"buffer": 0, "byteOffset": 36, "byteLength": len(png)})
        content["buffers"][0]["byteLength"] = 36 + len(png)
        self.check("image.glb", glb(content, POINTS + png), 0, "faces")
        self.mill("pipe", "load", "image.glb", "!", "write", "out.glb")

    def test_deep_and_long_json(self):
        self.check("deep.gltf", b'{"asset":' + b"[" * 5000000, MALFORMED, "E-JSON")
        self.check("wide.gltf", b'{"asset":{"version":"2.0"},"extras":[' + b"{}," * 1000000 + b"0]}", MALFORMED, "E-EMPTY")
        chain = triangle()
        chain["nodes"] = [{"children": [i + 1]} for i in range(200000)] + [{"mesh": 0}]
        self.check("chain.glb", glb(chain, POINTS), 0, "faces")
        chain["nodes"][-1] = {"mesh": 0, "children": [0]}
        self.check("circle.glb", glb(chain, POINTS), MALFORMED, "E-NODES")


if __name__ == "__main__":
    main()
