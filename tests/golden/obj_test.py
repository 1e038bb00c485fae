"""OBJ with its materials and the images of their textures: as outputs of a run among others."""

import json

from support import Case, main, png

OBJ = "mtllib t.mtl\no t\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nusemtl m\nf 1/1 2/2 3/3\n"


class Obj(Case):
    def setUp(self):
        super().setUp()
        self.write("in/t.obj", OBJ)
        self.write("in/t.mtl", "newmtl m\nmap_Kd maps/tex.png\n")
        (self.dir / "in/maps").mkdir()
        (self.dir / "in/maps/tex.png").write_bytes(png(255, 0, 0))

    def both(self, *arguments, allow=("W-UNITS",)):
        """What a plan says that it writes, and what it writes."""
        self.write("p.yaml", "facetmill: 1\nstages:\n  - load: in/t.obj\n  - write: t.obj\n")
        planned = self.mill("plan", "p.yaml", *arguments, "-o", "out", "--outputs").stdout.split()
        allowed = [f"--allow={message}" for message in allow]
        self.mill("run", "p.yaml", *arguments, "-o", "out", "--strict", *allowed)
        return planned, [f"out/{name}" for name in self.files(self.dir / "out")]

    def test_the_plan_names_the_images(self):
        self.mill("pipe", "load", "in/t.obj", "!", "write", "t.glb")
        self.mill("pipe", "load", "in/t.obj", "!", "write", "g/t.gltf")
        expected = {"in/t.obj": "maps/t.tex.png", "t.glb": "t.tex.png", "g/t.gltf": "maps/t.tex.png"}
        for source, image in expected.items():
            with self.subTest(source=source):
                planned, written = self.both("--set", f"load.path={source}")
                self.assertEqual(written, sorted(["out/t.obj", "out/t.mtl", f"out/{image}"]))
                self.assertEqual(sorted(planned), written)
                self.assertEqual((self.dir / "out" / image).read_bytes(), png(255, 0, 0))
                for path in written:
                    (self.dir / path).unlink()

    def test_the_plan_names_images_that_the_library_does_not(self):
        self.mill("pipe", "load", "in/t.obj", "!", "write", "t.gltf")
        document = json.loads((self.dir / "t.gltf").read_text())
        document["images"].append({"uri": "in/maps/tex-2.png"})
        document["textures"].append({"source": len(document["images"]) - 1})
        document["materials"][0]["occlusionTexture"] = {"index": len(document["textures"]) - 1}
        self.write("u.gltf", json.dumps(document))
        (self.dir / "in/maps/tex-2.png").write_bytes(png(0, 0, 255))
        planned, written = self.both("--set", "load.path=u.gltf", allow=("W-UNITS", "W-TEXTURES"))
        self.assertEqual(sorted(planned), written)
        self.assertIn("out/in/maps/t.tex-2.png", written)
        # Without a material there is no library, and so there are no images.
        del document["meshes"][0]["primitives"][0]["material"], document["materials"]
        self.write("u.gltf", json.dumps(document))
        for path in written:
            (self.dir / path).unlink()
        planned, written = self.both("--set", "load.path=u.gltf")
        self.assertEqual((sorted(planned), written), (["out/t.obj"], ["out/t.obj"]))

    def test_the_plan_leaves_out_images_of_materials_that_nothing_has(self):
        self.mill("pipe", "load", "in/t.obj", "!", "write", "t.gltf")
        document = json.loads((self.dir / "t.gltf").read_text())
        blue, green = png(0, 0, 255), png(0, 255, 0)
        (self.dir / "in/blue.png").write_bytes(blue)
        (self.dir / "in/green.png").write_bytes(green)
        document["images"] += [{"uri": "in/blue.png"}, {"uri": "in/green.png"}]
        document["textures"].append({"source": len(document["images"]) - 1})
        idle = {"baseColorTexture": {"index": len(document["textures"]) - 1}}
        document["materials"].append({"name": "idle", "pbrMetallicRoughness": idle})
        self.write("u.gltf", json.dumps(document))
        planned, written = self.both("--set", "load.path=u.gltf")
        self.assertEqual(sorted(planned), written)
        self.assertEqual(written, ["out/maps/t.tex.png", "out/t.mtl", "out/t.obj"])
        # The same as images of a GLB.
        self.mill("pipe", "load", "u.gltf", "!", "write", "u.glb")
        for path in written:
            (self.dir / path).unlink()
        planned, written = self.both("--set", "load.path=u.glb")
        self.assertEqual(sorted(planned), written)
        self.assertEqual(len(written), 3)
        # Where faces have none of the materials there is no library.
        del document["meshes"][0]["primitives"][0]["material"]
        self.write("u.gltf", json.dumps(document))
        for path in written:
            (self.dir / path).unlink()
        planned, written = self.both("--set", "load.path=u.gltf")
        self.assertEqual((planned, written), (["out/t.obj"], ["out/t.obj"]))

    def test_images_are_outputs_like_others(self):
        self.mill("pipe", "-o", "out", "--depfile", "t.d", "--report", "t.json", "load", "in/t.obj", "!", "write", "t.obj")
        names = {"out/t.obj", "out/t.mtl", "out/maps/t.tex.png"}
        targets, inputs = (self.dir / "t.d").read_text().replace("\\\n", " ").split("\n")[0].split(":", 1)
        self.assertIn("in/maps/tex.png", inputs)
        record = json.loads((self.dir / "out/t.json").read_text())
        self.assertEqual({f"out/{output['path']}" for output in record["outputs"]}, names)
        self.assertGreater(record["outputs"][-1]["contents"]["textures"], 0)

    def test_what_an_obj_cannot_hold_is_an_error(self):
        said = self.mill("pipe", "load", "in/t.obj", "!", "write", "t.obj", "--textures", "embed", expect=2).stderr
        self.assertIn("obj cannot contain images", said)
        self.assertIn("use write --textures copy, or write a .glb", said)
        self.mill("pipe", "load", "in/t.obj", "!", "write", "o/t.obj", "--textures", "reference")
        self.assertIn("map_Kd ../in/maps/tex.png\n", (self.dir / "o/t.mtl").read_text())
        self.assertEqual(sorted(self.files(self.dir / "o")), ["t.mtl", "t.obj"])
        said = self.mill("pipe", "load", "in/t.obj", "!", "write", "t.obj", "--tangents", "new", expect=2).stderr
        self.assertIn("'tangents' works with", said)


if __name__ == "__main__":
    main()
