"""Files that promise more than they hold. Memory stays within 4 GiB, the answer comes soon, and the exit code says why."""

import json
import os
import pathlib
import resource
import struct
import subprocess
import unittest
import zipfile
import zlib

from support import FACETMILL, SLOW, Case, main

LIMIT = 4 << 30
SECONDS = 120  # of the processor, of which none of these takes more than a few
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


def gzip_of_zeros(mebibytes):
    """A gzip file of zeros, whose checksum is not right: nothing is to come so far."""
    packer = zlib.compressobj(9, zlib.DEFLATED, -15)
    first = packer.compress(bytes(1 << 20)) + packer.flush(zlib.Z_FULL_FLUSH)
    return b"\x1f\x8b\x08" + bytes(6) + b"\xff" + first * mebibytes + zlib.compressobj(9, zlib.DEFLATED, -15).flush()


def zstd_of_zeros(mebibytes):
    """A zstd file of zeros: a window of 8 MiB, and blocks that say a byte and how often it comes."""
    block = struct.pack("<I", 1 << 1 | (128 << 10) << 3)[:3] + b"\0"
    end = struct.pack("<I", 1 | 1 << 1 | 1 << 3)[:3] + b"\0"
    return b"\x28\xb5\x2f\xfd" + b"\0" + bytes([13 << 3]) + block * (8 * mebibytes) + end


CORE = "http://schemas.microsoft.com/3dmanufacturing/core/2015/02"
TRIANGLE_3MF = ('<object id="1"><mesh><vertices><vertex x="0" y="0" z="0"/><vertex x="1" y="0" z="0"/>'
                '<vertex x="0" y="1" z="0"/></vertices><triangles><triangle v1="0" v2="1" v3="2"/></triangles></mesh>'
                '</object>')


def model_3mf(objects, item):
    return f'<model xmlns="{CORE}"><resources>{objects}</resources><build><item objectid="{item}"/></build></model>'


def ply(elements, rest=b""):
    return b"ply\nformat binary_little_endian 1.0\n" + elements + b"end_header\n" + rest


PLACE = b"property float x\nproperty float y\nproperty float z\n"


# AddressSanitizer takes terabytes of addresses for itself, so that no such limit can be set beside it.
@unittest.skipIf(SLOW, "sanitizers need more addresses than the limit")
class Bombs(Case):
    def check(self, name, content, code, message, command="info"):
        path = self.dir / name
        path.write_bytes(content if isinstance(content, bytes) else json.dumps(content).encode())
        self.check_run(name, [command, str(path)], code, message)

    def check_run(self, name, arguments, code, message):
        def limited():
            resource.setrlimit(resource.RLIMIT_AS, (LIMIT, LIMIT))
            resource.setrlimit(resource.RLIMIT_CPU, (SECONDS, SECONDS))

        run = subprocess.run([str(FACETMILL), *arguments], capture_output=True, text=True, timeout=1200,
                             preexec_fn=limited, cwd=self.dir)
        self.assertEqual(run.returncode, code, f"{name}\n{run.stderr[:2000]}")
        self.assertIn(message, run.stderr + run.stdout, name)

    def test_accessors_without_the_bytes(self):
        view = [{"buffer": 0, "byteLength": 36}]
        for count in (2**31, 2**32, 2**63 - 1):
            self.check("zeros.glb", glb(document([accessor(count=count)])), BEYOND, "E-LIMIT")
        for count in (2**31, 2**31 + 1, 2**63 - 1):
            self.check("short.glb", glb(document([accessor(count=count, bufferView=0)], views=view, buffer_bytes=36),
                                        bytes(36)), MALFORMED, "E-BUFFER")
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
                self.check("many.drc", draco(method, faces, points, 1 << 22), BEYOND, "E-MEMORY")
            self.check("zeros.drc", draco(method, 5000000, 5000000, 8192), MALFORMED, "E-DRACO")
        cloud = pathlib.Path(__file__).parent.parent / "data/fuzz/drc/points-of-few-bytes.drc"
        self.check("cloud.drc", cloud.read_bytes(), MALFORMED, "cannot hold")
        data = draco(1, 2**31, 2**31, 1 << 22)
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
        self.check("wide.gltf", b'{"asset":{"version":"2.0"},"extras":[' + b"{}," * 1000000 + b"0]}", 0, "faces")
        chain = triangle()
        chain["nodes"] = [{"children": [i + 1]} for i in range(200000)] + [{"mesh": 0}]
        self.check("chain.glb", glb(chain, POINTS), 0, "faces")
        chain["nodes"][-1] = {"mesh": 0, "children": [0]}
        self.check("circle.glb", glb(chain, POINTS), MALFORMED, "E-NODES")

    def test_a_million_positions_that_are_no_numbers(self):
        points = struct.pack("<3f", float("nan"), 0, 0) * 999999
        content = document([accessor(count=999999, bufferView=0)], views=[{"buffer": 0, "byteLength": len(points)}],
                           buffer_bytes=len(points))
        self.check("nan.glb", glb(content, points), MALFORMED, "E-NAN")

    def test_packed_files(self):
        for name, content in (("gzip.stl", gzip_of_zeros(6000)), ("gzip.obj.gz", gzip_of_zeros(6000)),
                              ("zstd.stl", zstd_of_zeros(6000)), ("zstd.ply.zst", zstd_of_zeros(6000))):
            self.check(name, content, BEYOND, "E-SIZE")
        window = b"\x28\xb5\x2f\xfd" + b"\0" + bytes([21 << 3]) + struct.pack("<I", 1 | 1 << 1 | 1 << 3)[:3] + b"\0"
        self.check("window.stl", window, MALFORMED, "too much memory")

    def archive(self, name, files):
        with zipfile.ZipFile(self.dir / name, "w", zipfile.ZIP_DEFLATED) as archive:
            for path, content in files:
                archive.writestr(path, content)
        return (self.dir / name).read_bytes()

    def test_archives(self):
        def check(name, model, code, message):
            self.check(name, self.archive(name, [("3D/3dmodel.model", model)]), code, message)

        check("spaces.3mf", b" " * (300 << 20), BEYOND, "E-SIZE")
        check("deep.3mf", f'<model xmlns="{CORE}">' + "<a>" * 3000000, MALFORMED, "nested deeper")
        check("attribute.3mf", "<model " + "a" * 50000000, MALFORMED, "E-3MF")
        laughs = '<!DOCTYPE a [<!ENTITY a0 "aaaaaaaaaa">' + "".join(
            f'<!ENTITY a{i} "{f"&a{i - 1};" * 10}">' for i in range(1, 12)) + "]>"
        check("laughs.3mf", laughs + f'<model xmlns="{CORE}">&a11;</model>', MALFORMED, "DOCTYPE")
        for name, times, depth, code, message in (("doubling.3mf", 2, 60, MALFORMED, "nested deeper"),
                                                  ("chain.3mf", 1, 100000, MALFORMED, "nested deeper"),
                                                  ("places.3mf", 2, 30, BEYOND, "1000000 objects")):
            parts = [f'<object id="{i}"><components>{f"<component objectid={chr(34)}{i - 1}{chr(34)}/>" * times}'
                     "</components></object>" for i in range(2, depth + 1)]
            check(name, model_3mf(TRIANGLE_3MF + "".join(parts), depth), code, message)
        many = self.archive("many.3mf", [(f"{i}.model", b"") for i in range(60000)])
        self.check("many.3mf", many, MALFORMED, "no model")

    def test_counts_of_plain_formats(self):
        self.check("many.ply", ply(b"element vertex 4000000000\n" + PLACE, bytes(100)), MALFORMED, "hold at most")
        self.check("most.ply", ply(b"element vertex 18446744073709551615\n" + PLACE), MALFORMED, "expected a count")
        self.check("list.ply", ply(b"element vertex 3\n" + PLACE
                                   + b"element face 1\nproperty list uint int vertex_indices\n",
                                   bytes(36) + b"\xff" * 4 + bytes(100)), MALFORMED, "the file ends")
        self.check("none.ply", ply(b"element nothing 4000000000000\nelement vertex 1\n" + PLACE, bytes(12)), 0,
                   "W-SKIPPED")
        self.check("elements.ply", ply(b"element a 0\n" * 300000), MALFORMED, "no element")
        self.check("many.off", b"OFF\n4000000000 4000000000 0\n0 0 0\n", BEYOND, "E-SIZE")
        self.check("binary.off", b"OFF BINARY\n" + b"\x7f\xff\xff\xff" * 3 + bytes(100), MALFORMED, "cannot hold")
        self.check("face.off", b"OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n4000000000 0 1 2\n", MALFORMED, "cannot hold")
        self.check("many.stl", bytes(80) + b"\xfe" * 4 + bytes(200), MALFORMED, "E-STL")
        self.check("no-count.stl", bytes(80) + b"\xff" * 4 + bytes(200), 0, "W-COUNT")
        self.check("name.stl", b"solid " + b"a" * 50000000, MALFORMED, "E-STL")
        self.check("index.obj", b"f 1 2 999999999999999999999\n", MALFORMED, "E-OBJ")
        self.check("libraries.obj", b"mtllib a.mtl\n" * 500000 + b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", 0, "faces")

    def test_pipelines(self):
        def check(name, text, message):
            self.check(name, text.encode(), 2, message, "plan")

        for name, text in (("lists.yaml", "stages: " + "[" * 200000), ("maps.yaml", "a: " + "{a: " * 100000),
                           ("keys.yaml", "? " * 100000), ("items.yaml", "- " * 100000)):
            check(name, text, "E-EXPANSION")
        aliases = "a0: &a0 [x,x,x,x,x,x,x,x,x,x]\n" + "".join(
            f"a{i}: &a{i} [{','.join([f'*a{i - 1}'] * 10)}]\n" for i in range(1, 10))
        check("aliases.yaml", aliases, "E-EXPANSION")
        check("itself.yaml", "a: &a [*a]\n", "an alias inside its own content")
        check("long.yaml", "a: " + "a" * 5000000, "too large")
        head = "facetmill: 1\nstages:\n  - generate: sphere\n"
        check("stages.yaml", head + "  - clean\n" * 60000, "more than 50000 stages")
        for sign, name in (("(", "brackets"), ("-", "signs"), ("1+", "sum")):
            check(f"{name}.yaml", head + "  - relax: ${" + sign * 200000 + "1}\n", "error[E-")

    def test_chains_of_files(self):
        for i in range(3000):
            self.write(f"{i}.yaml", f"facetmill: 1\nstages: [{{include: {i + 1}.yaml}}]\n")
        self.check_run("chain", ["plan", "0.yaml"], 2, "E-INCLUDE")
        for i in range(25):
            self.write(f"d{i}.yaml", "facetmill: 1\nstages: [" + f"{{include: d{i + 1}.yaml}}, " * 2 + "]\n")
        self.write("d25.yaml", "facetmill: 1\nstages: [{generate: sphere}]\n")
        self.check_run("doubling", ["plan", "d0.yaml"], 2, "more than 50000 stages")

    def test_long_one_liners(self):
        self.check_run("stages", ["pipe", "load", "none.ply", *["!", "clean"] * 45000], 3, "none.ply")
        self.check_run("typing errors", ["pipe", "load", "none.ply", *["!", "clen"] * 20000], 2, "E-STAGE")
        for sign in ("(", "[", "{a: ", "@{", "@{-", "1+"):
            value = sign * (120000 // len(sign))
            self.check_run(sign, ["pipe", "load", "none.ply", "!", "relax", value], 2, "error[E-")
        for block in (("branch", "["), ("branch", "a", "["), ("foreach", "a=1", "[")):
            self.check_run(block[0], ["pipe", "generate", "sphere", *["!", *block] * 20000], 2, "error[E-PIPE]")
        for key in ("a.", "holes.", "when.", "ensure."):
            option = "--" + key * (120000 // len(key)) + "a"
            self.check_run(key, ["pipe", "generate", "sphere", "!", "clean", option, "1"], 2, "more than 21 parts")
        params = "--with." + "a." * 60000 + "a"
        self.check_run("with", ["pipe", "include", "a.yaml", params, "1"], 2, "more than 21 parts")


if __name__ == "__main__":
    main()
