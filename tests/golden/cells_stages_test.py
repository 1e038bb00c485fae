"""Stages on meshes larger than the memory that is given: equal to memory, with the same bytes for any threads and memory."""

import json
import struct
import unittest

from cells_support import parted_ply, rows, triangles, variants
from support import SCAN, SLOW, LargeCase, main


def write_ply(path, head, points, faces):
    """A binary PLY with the header of another, but for the counts, and triangles."""
    lines = [b"element %s %d" % (line.split()[1], len(points if b"vertex" in line else faces))
             if line.startswith(b"element") else line for line in head.splitlines()]
    path.write_bytes(b"\n".join(lines) + b"\nend_header\n" + b"".join(points)
                     + b"".join(struct.pack("<B3i", 3, *face) for face in faces))


def scarred(path, scarred_path):
    """A binary PLY with some faces left out, some twice, some with vertices of their own."""
    head, points, rest = parted_ply(path)
    faces = []
    for number, (_, *face) in enumerate(struct.iter_unpack("<B3i", rest)):
        if number % 5000 == 17:
            continue
        faces.append(face)
        if number % 7001 == 99:
            faces.append(face[1:] + face[:1])
        if number % 4001 == 55:
            points += [points[v] for v in face]
            faces[-1] = [len(points) - 3, len(points) - 2, len(points) - 1]
    write_ply(scarred_path, head, points, faces)


def soup(path):
    """An STL-like PLY beside a binary PLY: each face with vertices of its own."""
    head, points, rest = parted_ply(path)
    corners = [points[v] for _, *face in struct.iter_unpack("<B3i", rest) for v in face]
    apart = path.with_name("soup.ply")
    write_ply(apart, head, corners, [(v, v + 1, v + 2) for v in range(0, len(corners), 3)])
    return apart


def spikes(path, side):
    """A square of so many points a side, each second one of them far above the others: most of the area is theirs."""
    points = [struct.pack("<3f", x, y, 4 * ((x * 7 + y * 13) % 5)) for y in range(side) for x in range(side)]
    faces = []
    for y in range(side - 1):
        for x in range(side - 1):
            v = y * side + x
            faces += [(v, v + 1, v + side), (v + 1, v + side + 1, v + side)]
    head = "ply\nformat binary_little_endian 1.0\nelement vertex {}\nproperty float x\nproperty float y\nproperty float z\n" \
           "element face {}\nproperty list uchar int vertex_indices\nend_header\n".format(len(points), len(faces))
    path.write_bytes(head.encode() + b"".join(points) + b"".join(struct.pack("<B3i", 3, *face) for face in faces))


class StagesInCells(LargeCase):
    def test_simplify_tells_of_lost_surface_as_in_memory(self):
        spikes(self.dir / "spikes.ply", 200)  # two cells
        tell = {}
        for way in ("never", "always"):
            for keep in ("", "kept", "kept") if way == "always" else ("",):
                run = self.mill("pipe", "--memory", "128M", "--partition", way, *(("--keep-cells", keep) if keep else ()), "load",
                                "spikes.ply", "--unit", "m", "--up", "z", "!", "transform", "--scale", "1,1,2", "!", "simplify",
                                "--faces", 400, "!", "write", "o.ply")
                lost = [line for line in run.stderr.splitlines() if "warning[W-SURFACE-LOST]" in line]
                self.assertEqual(len(lost), 1, run.stderr)
                before = lost[0].split(" of ")[-1].split()[0]
                tell.setdefault((before, "lost surface of part 'spikes'" in lost[0]), []).append(lost[0])
            self.mill("pipe", "--memory", "128M", "--partition", way, "--strict=W-SURFACE-LOST", "load", "spikes.ply", "--unit", "m",
                      "--up", "z", "!", "simplify", "--faces", 400, "!", "write", "strict.ply", expect=1)
            self.assertFalse((self.dir / "strict.ply").exists())
            run = self.mill("pipe", "--memory", "128M", "--partition", way, "load", "spikes.ply", "--unit", "m", "--up", "z", "!",
                            "simplify", "--faces", 79000, "!", "write", "o.ply")
            self.assertNotIn("W-SURFACE-LOST", run.stderr)
        self.assertEqual(list(map(len, tell.values())), [4])  # the area before is the same
        self.assertTrue(next(iter(tell))[1])

    def test_a_large_mesh_is_measured_in_cells(self):
        self.large()
        results = set()
        for threads, memory in variants((1, "32M"), (2, "64M"), (5, "1G")):
            self.mill("pipe", "-j", threads, "--memory", memory, "--partition", "always", "load", "large.ply", "!", "measure",
                      "--path", "o.json")
            results.add((self.dir / "o.json").read_bytes())
        self.assertEqual(len(results), 1)
        self.mill("pipe", "load", "large.ply", "!", "measure", "--path", "whole.json")
        found, whole = (json.loads((self.dir / name).read_text())["parts"][0] for name in ("o.json", "whole.json"))
        for group, name in (("faces", "angle"), ("faces", "area"), ("edges", "length"), ("edges", "turn")):
            for key in ("count", "minimum", "median", "maximum"):
                self.assertEqual(found[group][name][key], whole[group][name][key])
        for key in ("convex", "concave", "flat", "feature", "boundary", "non_manifold"):
            self.assertEqual(found["edges"][key], whole["edges"][key])
        self.assertAlmostEqual(found["solid"]["volume"] / whole["solid"]["volume"], 1, 12)

    def test_a_large_mesh_is_split_in_cells(self):
        scan = self.dir / "scan.ply"
        self.mill("pipe", "load", SCAN, "!", "measure", "--attributes", "mean_curvature,gaussian_curvature", "!", "write", scan)
        for passes in variants(1, 2):
            results = set()
            for threads, memory in variants((1, "32M"), (2, "64M"), (5, "1G")):
                self.mill("pipe", "-j", threads, "--memory", memory, "--partition", "always", "--report", "o.json", "load",
                          scan, "!", "split", "midpoint", "--passes", passes, "!", "validate", "--closed",
                          "--vertex_manifold", "!", "write", "o.ply")
                results.add((self.dir / "o.ply").read_bytes())
            self.assertEqual(len(results), 1)
            self.mill("pipe", "--report", "whole.json", "load", scan, "!", "split", "midpoint", "--passes", passes, "!",
                      "write", "whole.ply")
            found, whole = (json.loads((self.dir / name).read_text())["stages"][1]["result"]["parts"][0]
                            for name in ("o.json", "whole.json"))
            self.assertEqual(found, whole)
            self.assertEqual(*(rows(self.dir / n) for n in ("o.ply", "whole.ply")))
        self.assertIn("E-LIMIT", self.mill("pipe", "--partition", "always", "load", scan, "!", "split", "midpoint",
                                           "--passes", 9, "!", "write", "o.ply", expect=7).stderr)

    def test_a_large_mesh_is_crumpled_in_cells(self):
        scan = self.dir / "scan.ply"
        self.mill("pipe", "load", SCAN, "!", "measure", "--attributes", "mean_curvature,gaussian_curvature", "!", "write", scan)
        turn = ("transform", "--rotate.axis", "1,2,3", "--rotate.angle", "30deg", "!")  # percentages are of the world's box
        for chain in variants((*turn, "crumple", "0.05%"), ("crumple", "0.1% of load", "--grid", 1, "--seed", 7),
                              (*turn, "split", "midpoint", "!", "crumple", "0.5%", "--grid", 1, "--frequency", 3, "--octaves", 3)):
            results = set()
            for threads, memory in variants((1, "40M"), (2, "64M"), (5, "1G")):
                self.mill("pipe", "-j", threads, "--memory", memory, "--partition", "always", "--report", "o.json", "load",
                          scan, "!", *chain, "!", "validate", "--closed", "--vertex_manifold", "!", "write", "o.ply")
                results.add((self.dir / "o.ply").read_bytes())
            self.assertEqual(len(results), 1)
            self.mill("pipe", "--report", "whole.json", "load", scan, "!", *chain, "!", "validate", "--closed",
                      "--vertex_manifold", "!", "write", "whole.ply")
            found, whole = (json.loads((self.dir / name).read_text()) for name in ("o.json", "whole.json"))
            found, whole = (next(stage for stage in report["stages"] if stage["stage"] == "crumple")
                            for report in (found, whole))
            self.assertEqual(found["resolved"], whole["resolved"])
            found, whole = (stage["result"]["parts"][0] for stage in (found, whole))
            self.assertAlmostEqual(found.pop("root_mean_square_move") / whole.pop("root_mean_square_move"), 1, 12)
            self.assertEqual(found, whole)
            self.assertEqual(*(triangles(self.dir / n) for n in ("o.ply", "whole.ply")))
            self.assertEqual(*(rows(self.dir / n) for n in ("o.ply", "whole.ply")))

    def test_a_large_mesh_is_cleaned_in_cells(self):
        scarred(self.large(), self.dir / "scarred.ply")
        for options in variants(("--t_junctions", "off"), ()):
            results = set()
            for threads, memory in variants((1, "48M"), (2, "64M"), (5, "1G")):
                self.mill("pipe", "-j", threads, "--memory", memory, "--partition", "always", "--report", "o.json", "load",
                          "scarred.ply", "!", "clean", *options, "!", "write", "o.ply")
                results.add((self.dir / "o.ply").read_bytes())
            self.assertEqual(len(results), 1)
            self.mill("pipe", "--report", "whole.json", "load", "scarred.ply", "!", "clean", *options, "!", "write", "whole.ply")
            found, whole = (json.loads((self.dir / name).read_text())["stages"][1] for name in ("o.json", "whole.json"))
            self.assertEqual(found["result"], whole["result"])
            self.assertGreater(found["result"]["parts"][0]["welded_vertices"], 100)
            self.assertEqual(found["after"]["bounds"], whole["after"]["bounds"])
            self.assertEqual(*(triangles(self.dir / n) for n in ("o.ply", "whole.ply")))
            self.assertEqual(*(rows(self.dir / n) for n in ("o.ply", "whole.ply")))

    def test_clean_tells_of_lost_surface_as_in_memory(self):
        spikes(self.dir / "spikes.ply", 200)  # two cells
        head, points, rest = parted_ply(self.dir / "spikes.ply")
        faces = [face for _, *face in struct.iter_unpack("<B3i", rest)]
        n = len(points)
        points += [struct.pack("<3f", *p) for p in ((0, 0, 500), (90, 0, 500), (0, 90, 500))]
        for copies, lost in ((300, True), (3, False)):
            write_ply(self.dir / "repeated.ply", head, points, faces + copies * [(n, n + 1, n + 2)])
            told = []
            for way in ("never", "always"):
                chain = ("load", "repeated.ply", "--unit", "m", "--up", "z", "!", "transform", "--scale", "1,1,2", "!", "clean", "!")
                run = self.mill("pipe", "--memory", "128M", "--partition", way, *chain, "write", "o.ply")
                told.append([line.split("W-SURFACE-LOST]")[1] for line in run.stderr.splitlines() if "[W-SURFACE-LOST]" in line])
                self.mill("pipe", "--memory", "128M", "--partition", way, "--strict=W-SURFACE-LOST", *chain, "write",
                          f"{way}-{copies}.ply", expect=1 if lost else 0)
                self.assertEqual((self.dir / f"{way}-{copies}.ply").exists(), not lost)
            self.assertEqual(told[0], told[1])  # the numbers, too
            self.assertEqual(len(told[0]), int(lost))

    @unittest.skipIf(SLOW, "the same code with other data takes minutes under sanitizers")
    def test_clean_in_cells_keeps_attributes_apart_and_is_bounded(self):
        self.large()
        self.mill("pipe", "load", "large.ply", "!", "measure", "--attributes", "mean_curvature,gaussian_curvature", "!", "write", "attributes.ply")
        scarred(self.dir / "attributes.ply", self.dir / "scarred.ply")
        run = self.mill("pipe", "--partition", "always", "load", "scarred.ply", "!", "clean", "!", "write", "o.ply", expect=2)
        self.assertIn("vertices at the same position have different attributes", run.stderr)
        self.mill("pipe", "--partition", "always", "load", "scarred.ply", "!", "clean", "--weld", "off",
                  "--non_manifold=false", "!", "write", "o.ply")
        self.mill("pipe", "load", "scarred.ply", "!", "clean", "--weld", "off", "--non_manifold=false", "!", "write",
                  "whole.ply")
        self.assertEqual(*(rows(self.dir / n) for n in ("o.ply", "whole.ply")))
        self.assertIn("places have defects", self.mill(
            "pipe", "--memory", "32M", "--partition", "always", "load", soup(self.dir / "large.ply"), "!", "clean", "--weld",
            "off", "!", "write", "o.ply", expect=7).stderr)

    def test_a_large_mesh_is_cut_by_planes_in_cells(self):
        self.large()
        turn = ("transform", "--rotate.axis", "1,2,3", "--rotate.angle", "30deg", "!")
        for chain in variants(("section", "z=50%", "--hatch", "2%"), (*turn, "section", "--count", 5), (*turn, "section", "x=40%")):
            results = set()
            for threads, memory in variants((1, "32M"), (2, "64M"), (5, "1G")):
                self.mill("pipe", "-j", threads, "--memory", memory, "--partition", "always", "--report", "o.json", "load",
                          "large.ply", "!", *chain, "--path", "o.cut.json", "--path", "o.svg", "!", "validate", "--closed")
                results.add((self.dir / "o.svg").read_bytes())
            self.assertEqual(len(results), 1)
            self.mill("pipe", "--report", "whole.json", "load", "large.ply", "!", *chain, "--path", "whole.cut.json", "--path",
                      "whole.svg")
            for suffix in (".cut.json", ".svg"):
                self.assertEqual(*((self.dir / (n + suffix)).read_bytes() for n in ("o", "whole")))
            found, whole = (next(stage["result"] for stage in json.loads((self.dir / name).read_text())["stages"]
                                 if stage["stage"] == "section") for name in ("o.json", "whole.json"))
            if "volume" in whole:  # a sum in another order
                self.assertAlmostEqual(found.pop("volume") / whole.pop("volume"), 1, 12)
                self.assertAlmostEqual(found.pop("ratio") / whole.pop("ratio"), 1, 12)
            self.assertEqual(found, whole)
        for how, out in (("always", "o.ply"), ("never", "whole.ply")):  # the box is that of what was turned
            self.mill("pipe", "--partition", how, "load", "large.ply", "!", *turn, "clip", "z=60%", "--triangulate", "!",
                      "write", out)
        self.assertEqual(*(triangles(self.dir / n) for n in ("o.ply", "whole.ply")))
        self.assertIn("E-MEMORY", self.mill("pipe", "--memory", "32M", "--partition", "always", "load", "large.ply", "!",
                                            "section", "--count", 500, expect=7).stderr)

    def test_crumple_in_cells_leaves_normals_out_and_says_so(self):
        self.mill("pipe", "load", SCAN, "!", "write", "normals.ply", "--normals", "smooth")
        run = self.mill("pipe", "--partition", "always", "load", "normals.ply", "!", "crumple", "!", "write", "o.ply")
        self.assertIn("W-CELLS", run.stderr)
        self.assertIn("lose NORMAL", run.stderr)
        self.assertNotIn(b"property float nx", (self.dir / "o.ply").read_bytes()[:999])


if __name__ == "__main__":
    main()
