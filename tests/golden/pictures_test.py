#!/usr/bin/env python3
"""facetmill render draws what it measures: colours read back from the PNG, the same bytes for any number of threads."""
import json
import struct
import unittest
import zlib

from support import Case


def pixels(data):
    """Width, height and the rows of RGBA of a PNG as facetmill writes them (8 bits, not interlaced)."""
    at, stream = 8, b""
    while at < len(data):
        length, kind = struct.unpack(">I4s", data[at:at + 8])
        body = data[at + 8:at + 8 + length]
        if kind == b"IHDR":
            width, height, bits, colours = struct.unpack(">IIBB", body[:10])
            assert bits == 8 and colours in (2, 6)
        if kind == b"IDAT":
            stream += body
        at += length + 12
    size = {2: 3, 6: 4}[colours]
    raw, row, rows = zlib.decompress(stream), bytearray(size * width), []
    for y in range(height):
        line = raw[y * (size * width + 1):(y + 1) * (size * width + 1)]
        method, new = line[0], bytearray(line[1:])
        for x in range(len(new)):
            left = new[x - size] if x >= size else 0
            corner = row[x - size] if x >= size else 0
            up = row[x]
            if method == 4:
                p = left + up - corner
                guess = min((abs(p - left), 0, left), (abs(p - up), 1, up), (abs(p - corner), 2, corner))[2]
            else:
                guess = (0, left, up, (left + up) // 2)[method]
            new[x] = (new[x] + guess) & 255
        row = new
        rows.append([tuple(row[size * x:size * x + size]) for x in range(width)])
    return width, height, rows


class Pictures(Case):
    SIZE = ("--width", "300", "--height", "200", "--background", "white", "--no-occlusion")

    def picture(self, *words):
        data = self.mill("render", *words, "-o", "-", *self.SIZE, text=False).stdout
        self.assertEqual(data, self.mill("render", *words, "-o", "-", *self.SIZE, "-j", "1", text=False).stdout)
        return pixels(data)

    def test_deviation_is_red_outside_and_blue_inside(self):
        self.mill("pipe", "generate", "icosphere", "!", "write", "ball.off")
        self.mill("pipe", "generate", "icosphere", "--radius", "1.5", "!", "write", "large.off")
        width, height, rows = self.picture("large.off", "ball.off", "--attribute", "deviation")
        self.assertEqual((width, height), (600, 200))
        large, small = rows[100][99], rows[100][399]  # beside each legend, in the middle of each ball
        self.assertGreater(large[0], large[2] + 60)
        self.assertGreater(small[2], small[0] + 60)

    def test_a_stage_is_seen_against_what_was_loaded(self):
        self.mill("pipe", "generate", "icosphere", "!", "write", "ball.off")
        said = self.mill("pipe", "load", "ball.off", "!", "transform", "--scale", "1.5", "!", "render", "d.png", "--attribute",
                         "deviation", "--range", "all", *self.SIZE, "!", "measure", "--attributes", "deviation", "--path", "m.json").stderr
        self.assertRegex(said, r"deviation from -0\.5\d* \(blue\) to 0\.5\d* \(red\)")
        self.assertIn("deviation 0.5", said)
        values = json.loads((self.dir / "m.json").read_text())["parts"][0]["attributes"][0]["values"]
        self.assertAlmostEqual(values["minimum"], 0.5, delta=0.01)

    def test_a_sheet_has_no_thickness(self):
        self.mill("pipe", "generate", "grid", "!", "write", "sheet.off")
        _, _, rows = self.picture("sheet.off", "--attribute", "thickness", "--view", "top")
        middle = rows[100][150]
        self.assertGreater(middle[0], max(120, middle[1] + 60))
        self.assertGreater(middle[2], middle[1] + 40)

    def test_what_cannot_be_drawn_is_told(self):
        self.mill("pipe", "generate", "cube", "!", "write", "a.off")
        alone = self.mill("render", "a.off", "-o", "a.png", "--attribute", "deviation", expect=2).stderr
        self.assertIn("deviation needs another mesh", alone)
        unknown = self.mill("render", "a.off", "-o", "a.png", "--attribute", "warmth", expect=5).stderr
        self.assertIn("render can measure min_angle, max_angle", unknown)


if __name__ == "__main__":
    unittest.main()
