#!/usr/bin/env python3
"""pictures.py [FOLDER] [--mill FACETMILL]: the pictures of docs/figures.md anew, in FOLDER (docs/figures).

Runs each pipeline of pipelines/figures, renders what it wrote, and puts the tiles beside each other. The same program
gives the same bytes, so on an unchanged tree nothing changes."""

import argparse
import pathlib
import shutil
import struct
import subprocess
import sys
import tempfile
import zlib

SOURCE = pathlib.Path(__file__).resolve().parents[1]
EDGES = ["--edges", "all"]
# The size of a tile, rows of tiles (a file, with stages before render where these are needed), options of render.
FIGURES = {
    "clipped-gaussian": (320, 260, [["gaussian.glb", "gaussian-clipped.glb"]], EDGES),
    "cropped-tiled": (420, 260, [["ball.glb ! transform --translate 2.3,0,0 --only *.inside", "tiles.glb"]],
                      ["--colours", "part", "--edges", "no", "--from", "0.2,1,0.6"]),
    "crumpled-sponge": (280, 280, [["sponge.glb", "sponge-crumpled.glb"]], []),
    "cut-sponge": (420, 400, [["sponge-cut.glb ! separate material"]],
                   ["--colours", "part", "--edges", "no", "--from", "1.1,1,-0.9"]),
    "filled-holes": (1000, 220, [["filled-holes.glb"]], [*EDGES, "--from", "0,0.75,1"]),
    "fractal": (300, 300, [["landscape.glb", "planet.glb"]], ["--edges", "no"]),
    "marked": (360, 360, [["marked.glb"]], EDGES),
    "oriented": (700, 280, [["oriented.glb"]], ["--edges", "no"]),
    "relaxed-gaussian": (200, 170, [[f"{name}.glb" for name in ("noisy", "relaxed-1", "relaxed-2", "relaxed-3",
                                                                 "relaxed-6")]], []),
    "relaxed-scan": (210, 170, [[f"{name}.glb" for name in ("slice", "slice-relaxed-1", "slice-relaxed-2",
                                                            "slice-hc-2")]], ["--edges", "no"]),
    "shading": (340, 270, [["shading.png"]], []),
    "simplified-cube": (170, 170, [[f"cube{name}.glb" for name in ("", f"-{method}-0", f"-{method}-1", f"-{method}-2")]
                                   for method in ("shortest-edge", "quadric")], EDGES),
    "simplified-open": (300, 260, [["open.glb", "open-10.glb"]], EDGES),
    "simplified-scan": (240, 320, [["nefertiti.ply", "nefertiti-0.glb", "nefertiti-1.glb"]], ["--edges", "no"]),
    "simplified-sphere": (190, 190, [[f"sphere-{n}.glb" for n in (4000, 3000, 2000, 1000)]], EDGES),
    "split-quads": (160, 160, [[f"quads-{n}.ply" for n in ("halve", "varignon", "diagonal", "fan", "midpoint")]], EDGES),
    "split-smooth": (150, 150, [[f"smooth-{n}.glb" for n in ("catmull-clark", "loop", "butterfly", "sqrt3",
                                                             "features")]], EDGES),
    "split-targets": (190, 190, [[f"cylinder{n}.ply" for n in ("", "-short", "-budget", "-narrow")]], EDGES),
    "split-triangles": (130, 130, [[f"triangles-{n}.ply" for n in ("midpoint", "bisect", "widest-angle", "notch",
                                                                   "centroid", "core", "quads")]],
                        [*EDGES, "--from", "-0.4,-0.3,1"]),
    "thickened": (900, 300, [["thickened.glb"]], ["--edges", "no"]),
}
SECTIONS = {"cut-sponge": "sponge-section.svg"}  # drawings, as they are
PAGE = "report-page.png"  # the page of quickstart's report in Chromium, for the README


def decoded(path):
    """(width, height, rows of RGB) of a PNG as facetmill writes it: RGBA without interlacing, each row less its left
    neighbour."""
    data, at, pixels = path.read_bytes(), 8, b""
    while at < len(data):
        size, kind = struct.unpack(">I4s", data[at:at + 8])
        body = data[at + 8:at + 8 + size]
        if kind == b"IHDR":
            width, height = struct.unpack(">II", body[:8])
        elif kind == b"IDAT":
            pixels += body
        at += size + 12
    raw, rows = zlib.decompress(pixels), []
    for y in range(height):
        row = bytearray(raw[y * (4 * width + 1) + 1:(y + 1) * (4 * width + 1)])
        for i in range(4, len(row)):
            row[i] = (row[i] + row[i - 4]) & 255
        del row[3::4]
        rows.append(row)
    return width, height, rows


def encoded(width, rows):
    """A PNG of fewer than 60,000 bytes: where it would be larger, of at most 256 colours, which are coarser."""
    def chunk(kind, body):
        return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))

    def png(kind, raw, *before):
        header = chunk(b"IHDR", struct.pack(">IIBBBBB", width, len(rows), 8, kind, 0, 0, 0))
        return b"".join([b"\x89PNG\r\n\x1a\n", header, *before, chunk(b"IDAT", zlib.compress(raw, 9)), chunk(b"IEND", b"")])
    whole = png(2, b"".join(b"\1" + bytes((row[i] - (row[i - 3] if i > 2 else 0)) & 255 for i in range(len(row)))
                            for row in rows))
    if len(whole) < 60000:
        return whole
    for step in range(1, 52, 2):
        level = bytes(min(255, round(255 * round(i / step) / round(255 / step))) for i in range(256))
        coarse = [row.translate(level) for row in rows]
        colours = sorted({row[i:i + 3] for row in map(bytes, coarse) for i in range(0, len(row), 3)})
        if len(colours) <= 256:
            break
    number = {colour: i for i, colour in enumerate(colours)}
    raw = b"".join(b"\0" + bytes(number[row[i:i + 3]] for i in range(0, len(row), 3)) for row in map(bytes, coarse))
    return png(3, raw, chunk(b"PLTE", b"".join(colours)))


def tile(mill, scratch, scene, size, options):
    """The picture of a scene, or one that the pipeline made."""
    file, *stages = scene.split(" ")
    if file.endswith(".png"):
        return decoded(scratch / file)
    subprocess.run([mill, "pipe", "-q", "load", file, *stages, "!", "render", "tile.png", "--background", "white", "--width",
                    str(size[0]), "--height", str(size[1]), *options], cwd=scratch, check=True)
    return decoded(scratch / "tile.png")


def figure(mill, name, folder):
    width, height, table, options = FIGURES[name]
    with tempfile.TemporaryDirectory() as scratch:
        scratch = pathlib.Path(scratch)
        shutil.copy(SOURCE / "examples/data/nefertiti.ply", scratch)
        run = subprocess.run([mill, "run", "-q", SOURCE / f"pipelines/figures/{name}.yaml", "--output-dir", scratch],
                             capture_output=True, text=True)
        if run.returncode not in (0, 1):  # 1: of what does not hold
            sys.exit(f"{name}: {run.stderr}")
        rows = []
        for scenes in table:
            tiles = [tile(mill, scratch, scene, (width, height), options) for scene in scenes]
            rows += [b"".join(parts) for parts in zip(*(rows for _, _, rows in tiles))]
        (folder / f"{name}.png").write_bytes(encoded(len(rows[0]) // 3, rows))
        if name in SECTIONS:
            shutil.copy(scratch / SECTIONS[name], folder)


def page(mill, browser, folder):
    with tempfile.TemporaryDirectory() as scratch:
        subprocess.run([mill, "run", "-q", "quickstart", "-D", f"input={SOURCE}/examples/data/nefertiti.ply", "-D", "unit=mm",
                        "-D", "up=y", "--output-dir", scratch], check=True)
        subprocess.run([browser, "--headless=new", "--no-sandbox", "--hide-scrollbars", "--window-size=1000,1680", "--force-device-scale-factor=0.65",
                        "--virtual-time-budget=8000", f"--screenshot={folder / PAGE}", f"file://{scratch}/nefertiti.html"],
                       check=True, capture_output=True, timeout=120)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", nargs="?", type=pathlib.Path, default=SOURCE / "docs/figures")
    parser.add_argument("--mill", type=pathlib.Path, default=SOURCE / "build/release/facetmill")
    parser.add_argument("--only", choices=FIGURES, help="one of them")
    options = parser.parse_args()
    known = {path.stem for path in (SOURCE / "pipelines/figures").glob("*.yaml")}
    if known != set(FIGURES):
        sys.exit(f"FIGURES and pipelines/figures differ: {', '.join(sorted(known ^ set(FIGURES)))}")
    for name in [options.only] if options.only else FIGURES:
        figure(options.mill.resolve(), name, options.folder.resolve())
    browser = shutil.which("chromium")
    if not options.only and browser:
        page(options.mill.resolve(), browser, options.folder.resolve())
    elif not options.only:
        print(f"{PAGE} stays as it is: chromium is not installed (tools/deps.sh --browser)", file=sys.stderr)


if __name__ == "__main__":
    main()
