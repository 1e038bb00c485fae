"""--asset-root and load: {asset_root: ...}: what a mesh file names outside of its own folder."""

import json
import os
import struct

from support import Case, main, png

PIPELINE = "facetmill: 1\nstages:\n  - load: assets/models/t.gltf\n  - write: t.glb\n"
OPTION = ("--asset-root", "assets")


class AssetRoot(Case):
    def setUp(self):
        super().setUp()
        for folder in ("assets/models", "assets/shared", "outside"):
            (self.dir / folder).mkdir(parents=True)
        self.gltf_with_neighbours(self.dir / "assets/models")
        models = self.dir / "assets/models"
        (models / "t.bin").rename(self.dir / "assets/shared/t.bin")
        (models / "tex.png").rename(self.dir / "assets/shared/tex.png")
        (self.dir / "outside/tex.png").write_bytes(png(1, 2, 3))
        self.gltf(buffers="../shared/t.bin", images="../shared/tex.png")
        self.write("p.yaml", PIPELINE)

    def gltf(self, **uris):
        path = self.dir / "assets/models/t.gltf"
        document = json.loads(path.read_text())
        for kind, uri in uris.items():
            document[kind][0]["uri"] = uri
        path.write_text(json.dumps(document))

    def written(self, name="t.glb"):
        data = (self.dir / name).read_bytes()
        return json.loads(data[20:20 + struct.unpack("<I", data[12:16])[0]])

    def textured(self, name="t.glb"):
        return "bufferView" in self.written(name).get("images", [{}])[0]

    def test_without_it_the_way_out_is_told(self):
        told = self.mill("run", "p.yaml", expect=6).stderr
        self.assertIn("E-URI", told)
        self.assertIn("--asset-root assets,", told)
        self.mill("run", "p.yaml", *OPTION)
        self.assertTrue(self.textured())

    def test_each_command(self):
        model = "assets/models/t.gltf"
        self.write("q.yaml", PIPELINE.replace("load: assets/models/t.gltf", "load: {path: assets/models/t.gltf, asset_root: assets}"))
        self.mill("run", "q.yaml", "-o", "q")
        self.mill("pipe", "load", model, "--asset-root", "assets", "!", "write", "p.glb")
        self.assertTrue(self.textured("q/t.glb") and self.textured("p.glb"))
        for command in (["info", model], ["diff", model, model], ["render", model, "-o", "t.png"]):
            with self.subTest(command=command):
                self.mill(*command, expect=6)
                self.mill(*command, *OPTION)
        self.mill("check", "p.yaml", *OPTION)

    def test_a_saved_pipeline_and_an_include(self):
        self.mill("pipe", "--save", "assets/p.yaml", "load", "assets/models/t.gltf", "--asset-root", "assets", "!", "write", "t.glb")
        before = self.files()["t.glb"]
        self.mill("run", "assets/p.yaml", "-o", "again")
        self.assertEqual(self.files()["again/t.glb"], before)
        self.write("all.yaml", "facetmill: 1\nstages:\n  - include: assets/p.yaml\n")
        self.mill("run", "all.yaml", "-o", "included")
        self.assertEqual(self.files()["included/t.glb"], before)

    def test_plans_and_depfiles_name_the_files(self):
        inputs = self.mill("plan", "p.yaml", *OPTION, "--inputs").stdout.split()
        self.assertEqual(sorted(inputs), ["assets/models/t.gltf", "assets/shared/t.bin", "assets/shared/tex.png"])
        self.assertEqual(self.mill("plan", "p.yaml", "--inputs").stdout.split(), ["assets/models/t.gltf"])
        self.mill("run", "p.yaml", *OPTION, "--depfile", "t.d")
        rule = (self.dir / "t.d").read_text()
        for name in ("assets/shared/t.bin", "assets/shared/tex.png"):
            self.assertIn(name, rule)
            self.assertNotIn("..", rule)

    def test_a_gltf_keeps_its_images_in_the_output_folder(self):
        planned = self.mill("plan", "p.yaml", *OPTION, "--set", "write.path=out/t.gltf", "--outputs").stdout.split()
        self.mill("run", "p.yaml", *OPTION, "--set", "write.path=out/t.gltf")
        self.assertEqual(sorted(self.files(self.dir / "out")), ["shared/t.tex.png", "t.bin", "t.gltf"])
        self.assertEqual(sorted(planned), ["out/shared/t.tex.png", "out/t.bin", "out/t.gltf"])

    def test_obj_and_ply(self):
        self.write("assets/shared/m.mtl", "newmtl m\nmap_Kd tex.png\n")
        self.write("assets/models/t.obj", "mtllib ../shared/m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\n"
                                          "usemtl m\nf 1/1 2/2 3/3\n")
        self.write("assets/models/t.ply", "ply\nformat ascii 1.0\ncomment TextureFile ../shared/tex.png\nelement vertex 3\n"
                   "property float x\nproperty float y\nproperty float z\nproperty float s\nproperty float t\n"
                   "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
                   "0 0 0 0 0\n1 0 0 1 0\n0 1 0 0 1\n3 0 1 2\n")
        for kind, warning in (("obj", "W-MTL"), ("ply", "W-IMAGE")):
            model = f"assets/models/t.{kind}"
            told = self.mill("pipe", "load", model, "!", "write", f"{kind}.glb").stderr
            self.assertIn(warning, told)
            self.assertIn("--asset-root assets,", told)
            told = self.mill("pipe", "load", model, "--asset-root", "assets", "!", "write", f"{kind}.glb").stderr
            self.assertNotIn(warning, told)
            self.assertTrue(self.textured(f"{kind}.glb"))

    def test_what_stays_refused(self):
        (self.dir / "assets/shared/link.png").symlink_to(self.dir / "outside/tex.png")
        for uri in ("../shared/link.png", "../../outside/tex.png", str(self.dir / "outside/tex.png"),
                    "file:///etc/passwd", "https://example.org/tex.png", "..%2F..%2Foutside/tex.png"):
            with self.subTest(uri=uri):
                self.gltf(images=uri)
                told = self.mill("run", "p.yaml", *OPTION).stderr
                self.assertIn("W-IMAGE", told)
                self.assertFalse(self.textured())
        self.gltf(images="../shared/tex.png", buffers="../../outside/t.bin")
        self.assertIn("E-URI", self.mill("run", "p.yaml", *OPTION, expect=6).stderr)

    def test_links_within_it_and_several_folders(self):
        (self.dir / "assets/shared/link.png").symlink_to("tex.png")
        self.gltf(images="../shared/link.png")
        self.mill("run", "p.yaml", *OPTION)
        self.assertTrue(self.textured())
        self.gltf(images="../../outside/tex.png")
        self.mill("run", "p.yaml", *OPTION, "--asset-root", "outside")
        self.assertTrue(self.textured())

    def test_what_is_no_folder(self):
        for name in ("nowhere", "p.yaml"):
            self.assertIn("E-ASSET-ROOT", self.mill("run", "p.yaml", "--asset-root", name, expect=3).stderr)

    def test_the_cache_knows_it(self):
        self.gltf(buffers="t.bin")
        os.rename(self.dir / "assets/shared/t.bin", self.dir / "assets/models/t.bin")
        self.write("p.yaml", PIPELINE.replace("  - write", "  - relax: 1\n  - write"))
        for options, expected in (((), False), (OPTION, True), ((), False), (OPTION, True)):
            self.mill("run", "p.yaml", *options, "--cache", "--cache-everything", env={"FACETMILL_CACHE": str(self.dir / "cache")})
            self.assertEqual(self.textured(), expected, options)
        (self.dir / "assets/shared/tex.png").write_bytes(png(9, 9, 9))
        before = self.files()["t.glb"]
        self.mill("run", "p.yaml", *OPTION, "--cache", "--cache-everything", env={"FACETMILL_CACHE": str(self.dir / "cache")})
        self.assertNotEqual(self.files()["t.glb"], before)

    def test_a_batch_and_a_workflow(self):
        self.write("b.yaml", "facetmill: 1\nparams: {input: path}\nstages:\n  - load: ${input}\n  - write: ${input.stem}.glb\n")
        batch = ("batch", "b.yaml", "--input", "assets/models/*.gltf", "-o", "out")
        self.mill(*batch, *OPTION)
        self.assertTrue(self.textured("out/t.glb"))
        (self.dir / "assets/shared/tex.png").write_bytes(png(9, 9, 9))  # what lies there is an input
        before = self.files()["out/t.glb"]
        self.mill(*batch, *OPTION)
        self.assertNotEqual(self.files()["out/t.glb"], before)
        ninja = self.mill("export", "--to", "ninja", *batch[1:], *OPTION).stdout
        self.assertIn("--asset-root assets", ninja)
        self.assertIn("assets/shared/tex.png", ninja)

    def test_cells(self):
        self.mill("run", "p.yaml", "--partition", "always", "--set", "write.path=t.ply", expect=6)
        self.mill("run", "p.yaml", "--partition", "always", "--set", "write.path=t.ply", *OPTION)


if __name__ == "__main__":
    main()
