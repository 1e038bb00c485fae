"""USDZ files as OpenUSD reads them (pip install usd-core): the rules of phones, and the same contents as the glTF."""

import json
import struct
import sys
import unittest

from support import Case, main, png

try:
    from pxr import Gf, Usd, UsdGeom, UsdShade, UsdUtils
except ImportError:
    Usd = None


def problems(path):
    """What usdchecker --arkit reports."""
    if hasattr(UsdUtils, "ComplianceChecker"):
        checker = UsdUtils.ComplianceChecker(arkit=True)
        checker.CheckCompliance(str(path))
        # Wheels of these releases lack the definitions of shaders.
        return [p for p in checker.GetErrors() + checker.GetFailedChecks() if "has invalid shader node" not in p]
    from pxr import UsdValidation
    stage = Usd.Stage.Open(str(path))
    registry = UsdValidation.ValidationRegistry()
    context = UsdValidation.ValidationContext(registry.GetOrLoadAllValidators())
    return [e.GetMessage() for e in context.Validate(stage) if e.GetType() == UsdValidation.ValidationErrorType.Error]


POINTS = [(0, 0, 0), (1, 0, 0), (0, 2, 0), (0, 0, 3)]
FACES = [(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)]


def model(images):
    """Two nodes below a turned one show the same tetrahedron, in a material with all textures."""
    data, views, accessors = b"", [], []

    def view(part):
        nonlocal data
        data += b"\0" * (-len(data) % 4)
        views.append({"buffer": 0, "byteOffset": len(data), "byteLength": len(part)})
        data += part
        return len(views) - 1

    def add(numbers, kind, component=5126):
        width = len(numbers[0])
        flat = [x for item in numbers for x in item]
        accessors.append({"bufferView": view(struct.pack(f"<{len(flat)}{'f' if component == 5126 else 'H'}", *flat)),
                          "componentType": component, "count": len(numbers), "type": kind})
        if kind == "VEC3":
            accessors[-1].update(min=[min(n[k] for n in numbers) for k in range(width)],
                                 max=[max(n[k] for n in numbers) for k in range(width)])
        return len(accessors) - 1

    document = {
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
        "nodes": [{"name": "top", "rotation": [0, 0.6, 0, 0.8], "translation": [0.1, 0, 0], "children": [1, 2]},
                  {"name": "left", "mesh": 0, "scale": [1, 2, 1]},
                  {"name": "1 right", "mesh": 0, "matrix": [-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 5, 6, 7, 1]}],
        "meshes": [{"name": "tetra", "primitives": [{"attributes": {
            "POSITION": add(POINTS, "VEC3"), "NORMAL": add([(0, 0, 1)] * 4, "VEC3"),
            "TEXCOORD_0": add([(0, 0), (1, 0), (0, 0.25), (0.5, 1)], "VEC2")},
            "indices": add([(i,) for f in FACES for i in f], "SCALAR", 5123), "material": 0}]}],
        "materials": [{"name": "all", "doubleSided": True, "alphaMode": "MASK", "alphaCutoff": 0.25,
                       "pbrMetallicRoughness": {"baseColorFactor": [1, 0.5, 0.25, 1], "baseColorTexture": {"index": 0},
                                                "metallicFactor": 0.5, "roughnessFactor": 0.75,
                                                "metallicRoughnessTexture": {"index": 1}},
                       "normalTexture": {"index": 2}, "occlusionTexture": {"index": 1, "strength": 0.5},
                       "emissiveFactor": [0.5, 0.5, 0.5], "emissiveTexture": {
                           "index": 0, "extensions": {"KHR_texture_transform": {"offset": [0.5, 0], "scale": [2, 2]}}}}],
        "extensionsUsed": ["KHR_texture_transform"],
        "textures": [{"source": i, "sampler": 0} for i in range(len(images))],
        "samplers": [{"wrapS": 33071, "wrapT": 33648}],
        "images": [{"name": f"image {i}", "mimeType": "image/png", "bufferView": view(image)}
                   for i, image in enumerate(images)]}
    document.update(bufferViews=views, accessors=accessors, buffers=[{"byteLength": len(data)}])
    text = json.dumps(document).encode()
    text += b" " * (-len(text) % 4)
    data += b"\0" * (-len(data) % 4)
    chunks = struct.pack("<II", len(text), 0x4E4F534A) + text + struct.pack("<II", len(data), 0x004E4942) + data
    return b"glTF" + struct.pack("<II", 2, 12 + len(chunks)) + chunks


class Usdz(Case):
    def setUp(self):
        super().setUp()
        if Usd is None:
            print(f"notice: usd-core is missing (pip install usd-core), skipped {self.id()}", file=sys.stderr)
            self.skipTest("usd-core is missing")

    def written(self, name, *stages):
        self.mill("pipe", "load", name, *stages, "!", "write", "out.usdz")
        self.assertEqual(problems(self.dir / "out.usdz"), [])
        return Usd.Stage.Open(str(self.dir / "out.usdz"))

    @staticmethod
    def meshes(stage):
        cache = UsdGeom.XformCache()
        for prim in stage.Traverse(Usd.TraverseInstanceProxies()):
            if prim.IsA(UsdGeom.Mesh):
                place = cache.GetLocalToWorldTransform(prim)
                yield prim, [place.Transform(Gf.Vec3d(p)) for p in UsdGeom.Mesh(prim).GetPointsAttr().Get()]

    def test_the_contents_of_a_gltf(self):
        images = [png(200, 100, 50), png(10, 20, 30), png(128, 128, 255)]
        (self.dir / "a.glb").write_bytes(model(images))
        stage = self.written("a.glb")
        self.assertEqual((UsdGeom.GetStageMetersPerUnit(stage), UsdGeom.GetStageUpAxis(stage)), (1, "Y"))
        self.assertEqual(stage.GetDefaultPrim().GetName(), "out")
        meshes = list(self.meshes(stage))
        self.assertEqual([p.GetPath().pathString for p, _ in meshes], ["/out/top/left/tetra/tetra", "/out/top/_1_right/tetra/tetra"])
        # A rotation about y whose half has the sine 0.6.
        turned = [lambda x, y, z: (0.28 * x + 0.96 * z + 0.1, y, -0.96 * x + 0.28 * z)] * 2
        places = [lambda x, y, z: (x, 2 * y, z), lambda x, y, z: (5 - x, 6 + y, 7 + z)]
        for (_, points), turn, place in zip(meshes, turned, places):
            for found, p in zip(points, POINTS):
                for a, b in zip(found, turn(*place(*p))):
                    self.assertAlmostEqual(a, b, places=6)
        mesh = UsdGeom.Mesh(meshes[0][0])
        self.assertEqual(list(mesh.GetFaceVertexIndicesAttr().Get()), [i for f in FACES for i in f])
        self.assertTrue(mesh.GetDoubleSidedAttr().Get())
        st = UsdGeom.PrimvarsAPI(mesh).GetPrimvar("st").Get()
        self.assertEqual([tuple(x) for x in st], [(0, 1), (1, 1), (0, 0.75), (0.5, 0)])
        material = UsdShade.MaterialBindingAPI(mesh).ComputeBoundMaterial()[0]
        self.assertEqual(material.GetPrim().GetName(), "all")
        self.check_material(material, images)

    def check_material(self, material, images):
        surface = material.ComputeSurfaceSource()[0]
        self.assertEqual(surface.GetInput("opacityThreshold").Get(), 0.25)
        expected = {"diffuseColor": (0, "rgb", (1, 0.5, 0.25, 1), None, "sRGB"),
                    "opacity": (0, "a", (1, 0.5, 0.25, 1), None, "sRGB"),
                    "metallic": (1, "b", (1, 0.75, 0.5, 1), None, "raw"),
                    "roughness": (1, "g", (1, 0.75, 0.5, 1), None, "raw"),
                    "occlusion": (1, "r", (0.5, 0.5, 0.5, 1), (0.5, 0.5, 0.5, 0), "raw"),
                    "normal": (2, "rgb", (2, 2, 2, 1), (-1, -1, -1, 0), "raw"),
                    "emissiveColor": (0, "rgb", (0.5, 0.5, 0.5, 1), None, "sRGB")}
        for name, (image, channel, scale, bias, space) in expected.items():
            with self.subTest(input=name):
                source, output, _ = surface.GetInput(name).GetConnectedSource()
                texture = UsdShade.Shader(source.GetPrim())
                self.assertEqual(output, channel)
                self.assertEqual(tuple(texture.GetInput("scale").Get()), scale)
                shift = texture.GetInput("bias")
                self.assertEqual(tuple(shift.Get()) if shift else None, bias)
                self.assertEqual(texture.GetInput("sourceColorSpace").Get(), space)
                self.assertEqual((texture.GetInput("wrapS").Get(), texture.GetInput("wrapT").Get()), ("clamp", "mirror"))
                with open_asset(texture.GetInput("file").Get()) as stored:
                    self.assertEqual(stored, images[image])
        source = surface.GetInput("emissiveColor").GetConnectedSource()[0]
        place = UsdShade.Shader(UsdShade.Shader(source.GetPrim()).GetInput("st").GetConnectedSource()[0].GetPrim())
        self.assertEqual((tuple(place.GetInput("scale").Get()), tuple(place.GetInput("translation").Get())), ((2, 2), (0.5, -1)))

    def test_units_and_vertex_colours(self):
        self.write("a.ply", "ply\nformat ascii 1.0\nelement vertex 3\n" + "".join(f"property float {a}\n" for a in "xyz") +
                   "".join(f"property uchar {c}\n" for c in ("red", "green", "blue")) +
                   "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
                   "0 0 0 255 0 0\n10 0 0 0 255 0\n0 0 20 0 0 255\n3 0 1 2\n")
        stage = self.written("a.ply", "--unit", "mm", "--up", "z")
        (prim, points), = self.meshes(stage)
        self.assertEqual([[round(x, 6) for x in p] for p in points], [[0, 0, 0], [0.01, 0, 0], [0, 0.02, 0]])
        colours = UsdGeom.PrimvarsAPI(prim).GetPrimvar("displayColor").Get()
        self.assertEqual([tuple(c) for c in colours], [(1, 0, 0), (0, 1, 0), (0, 0, 1)])


class open_asset:
    """The bytes of a file in a package."""

    def __init__(self, asset):
        from pxr import Ar
        self.asset = Ar.GetResolver().OpenAsset(Ar.ResolvedPath(asset.resolvedPath))

    def __enter__(self):
        return bytes(self.asset.GetBuffer())[:self.asset.GetSize()]

    def __exit__(self, *_):
        self.asset = None


if __name__ == "__main__":
    main()
