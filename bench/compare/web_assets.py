#!/usr/bin/env python3
"""Assets for the web, beside gltf-transform, gltfpack and gltf-pipeline: bytes, triangles, deviation, seconds.

Each asset becomes a .glb: its geometry compressed by Draco or meshopt with the same numbers of bits, or optimised as a
whole, with images as WebP. `deviation` is the largest distance between the surfaces before and after, both ways, in
millionths of the diagonal (`facetmill diff`); `picture` is the root mean square difference of two renderings, of 255.
Seconds are processor time, with all processes of a tool. Ratios are geometric means over the assets that both made.

npm install gltfpack @gltf-transform/cli gltf-pipeline gltf-validator     gives the peers; --npm names the folder of
node_modules. A gltfpack in the PATH is taken where npm's is missing. Pictures need Pillow and numpy (--python)."""

import argparse
import json
import math
import os
import pathlib
import resource
import shutil
import struct
import subprocess
import sys
import tempfile

from peers import add_common_options

ROOT = pathlib.Path(__file__).resolve().parents[2]
BITS = {"position": 14, "normal": 10, "uv": 12, "colour": 8, "generic": 12}
PICTURES = """
import sys, numpy; from PIL import Image
a, b = (numpy.asarray(Image.open(f).convert("RGB"), float) for f in sys.argv[1:])
print(((a - b) ** 2).mean() ** 0.5)
"""
VALIDATE = """
const [modules, file] = process.argv.slice(1), fs = require('fs');
require(modules + '/gltf-validator').validateBytes(new Uint8Array(fs.readFileSync(file)))
  .then((r) => console.log(r.issues.numErrors));
"""


def tools(facetmill, npm):
    """By group and name: the command that makes OUT of IN; the peers that are there."""
    def where(name):
        found = shutil.which(name, path=str(npm / "node_modules/.bin")) if npm else None
        return found or (shutil.which(name) if name == "gltfpack" else None)
    own = [str(facetmill), "pipe", "-q", "load", "IN", "!"]
    # What the pipeline web does with images=keep: their pixels stay.
    optimize = ["clean", "--weld", "exact", "--non_manifold", "false", "!",
                "optimize", "--drop_attributes", "--drop_own", "--flatten", "!"]
    repack = ["textures", "--repack", "!"]
    position = str(BITS["position"])
    web = ["textures", "2048", "--format", "webp", "!"]
    draco_bits = ["--quantize-position", BITS["position"], "--quantize-normal", BITS["normal"], "--quantize-texcoord",
                  BITS["uv"], "--quantize-color", BITS["colour"], "--quantize-generic", BITS["generic"]]
    pipeline_bits = [f"--draco.quantize{name}Bits={BITS[bits]}" for name, bits in
                     (("Position", "position"), ("Normal", "normal"), ("Texcoord", "uv"), ("Color", "colour"),
                      ("Generic", "generic"))]
    whole = ["--texture-compress", "webp", "--simplify", "false", "--compress"]
    all_of_them = {
        "draco": {"facetmill": [*own, "write", "OUT", "--draco"],
                  "facetmill web": [*own, *optimize, *repack, "write", "OUT", "--drop_names", "--draco.grid", "even",
                                    "--draco.position_bits", position],
                  "gltf-transform draco": ["gltf-transform", "draco", "IN", "OUT", *draco_bits],
                  "gltf-pipeline -d": ["gltf-pipeline", "-i", "IN", "-o", "OUT", "-d", *pipeline_bits]},
        "meshopt": {"facetmill": [*own, "write", "OUT", "--meshopt"],
                    "facetmill web": [*own, *optimize, *repack, "write", "OUT", "--drop_names", "--meshopt",
                                      "--quantize.grid", "even", "--quantize.position", position],
                    "gltf-transform meshopt": ["gltf-transform", "meshopt", "IN", "OUT"],
                    "gltfpack -cc": ["gltfpack", "-cc", "-i", "IN", "-o", "OUT"],
                    "gltfpack -cc -kn -km -ke": ["gltfpack", "-cc", "-kn", "-km", "-ke", "-i", "IN", "-o", "OUT"]},
        "meshopt, version 1": {
            "facetmill web, KHR": [*own, *optimize, *repack, "write", "OUT", "--drop_names", "--meshopt.extension",
                                   "KHR", "--quantize.grid", "even", "--quantize.position", position],
            "gltfpack -cz": ["gltfpack", "-cz", "-i", "IN", "-o", "OUT"]},
        "whole, draco": {"facetmill": [*own, *optimize, *web, "write", "OUT", "--draco"],
                         "gltf-transform optimize": ["gltf-transform", "optimize", "IN", "OUT", *whole, "draco"]},
        "whole, meshopt": {"facetmill": [*own, *optimize, *web, "write", "OUT", "--meshopt"],
                           "gltf-transform optimize": ["gltf-transform", "optimize", "IN", "OUT", *whole, "meshopt"]},
        "half of the triangles": {
            "facetmill": [*own, "simplify", "50%", "--measure", "false", "!", "write", "OUT", "--meshopt"],
            "gltfpack -cc -si 0.5": ["gltfpack", "-cc", "-si", "0.5", "-i", "IN", "-o", "OUT"]},
    }
    for group in all_of_them.values():
        for name, command in list(group.items()):
            if command[0] == own[0]:
                continue
            command[0] = where(command[0])
            if not command[0]:
                print(f"missing: {name}", file=sys.stderr)
                del group[name]
    return all_of_them


def document(glb):
    data = glb.read_bytes()
    return json.loads(data[20:20 + struct.unpack("<I", data[12:16])[0]])


def triangles(glb):
    """Those of all primitives, wherever they are placed."""
    found = document(glb)
    accessors = found.get("accessors", [])
    primitives = [p for mesh in found.get("meshes", []) for p in mesh["primitives"]]
    return sum(accessors[p.get("indices", p["attributes"]["POSITION"])]["count"] // 3 for p in primitives)


class Comparison:
    def __init__(self, options):
        self.facetmill = (options.build / "facetmill").resolve()
        self.npm = options.npm and options.npm.resolve()
        self.python, self.repeat, self.pictures = options.python, options.repeat, not options.no_pictures
        self.folder = pathlib.Path(options.keep or tempfile.mkdtemp())
        self.folder.mkdir(parents=True, exist_ok=True)

    def text(self, *command):
        return subprocess.run([str(c) for c in command], capture_output=True, text=True).stdout

    def prepared(self, asset):
        """The asset as one .glb, as it is."""
        glb = self.folder / f"{asset.stem}.in.glb"
        self.text(self.facetmill, "pipe", "-q", "load", asset, "!", "write", glb, "--order", "keep")
        return glb if glb.exists() else None

    def run(self, command, before, after):
        """Processor seconds; None when nothing was made."""
        after.unlink(missing_ok=True)
        used = lambda: sum(resource.getrusage(resource.RUSAGE_CHILDREN)[:2])
        begin = used()
        subprocess.run([{"IN": str(before), "OUT": str(after)}.get(c, str(c)) for c in command], capture_output=True,
                       cwd=self.folder, stdin=subprocess.DEVNULL, timeout=600)
        return used() - begin if after.exists() else None

    def deviation(self, before, after):
        """The largest, both ways, in millionths of the diagonal."""
        found = self.text(self.facetmill, "diff", "--json", "--samples", 20000, before, after)
        measured = json.loads(found)["deviation"] if found else None
        return measured and 1e4 * measured["percent"]["maximum"]

    def picture(self, before, after):
        if not self.pictures:
            return math.nan
        files = [before.with_suffix(".png"), after.with_suffix(".png")]
        for glb, png in zip((before, after), files):
            if glb is after or not png.exists():
                self.text(self.facetmill, "render", glb, "-q", "-o", png, "--no-occlusion")
        return float(self.text(self.python or sys.executable, "-c", PICTURES, *files) or "nan")

    def errors(self, glb):
        """Of the validator; None when it is not there."""
        return int(self.text("node", "-e", VALIDATE, self.npm / "node_modules", glb) or -1) if self.npm else None

    def row(self, command, before, after):
        """What one tool makes of one asset; None when it makes nothing."""
        seconds = [self.run(command, before, after) for _ in range(self.repeat)]
        if None in seconds:
            return None
        return {"bytes": after.stat().st_size, "seconds": min(seconds), "triangles": triangles(after),
                "deviation": self.deviation(before, after), "picture": self.picture(before, after),
                "errors": self.errors(after)}


def mean(numbers):
    """The geometric mean; numbers below a hundredth count as that."""
    logarithms = [math.log(max(n, 0.01)) for n in numbers]
    return math.exp(sum(logarithms) / len(logarithms)) if logarithms else math.nan


def told(made):
    """Bytes, and in brackets what was measured."""
    measured = [f"{made[key]:.{digits}f}" for key, digits in (("deviation", 0), ("picture", 2))
                if made[key] is not None and not math.isnan(made[key])]
    return f"{made['bytes']:,}" + (f" ({', '.join(measured)})" if measured else "")


def print_assets(group, rows):
    """A line for each asset: bytes, deviation and picture of each tool."""
    names = list(rows)
    print(f"\n| {group}: bytes (deviation, picture) | before | " + " | ".join(names) + " |")
    print("|---" * (len(names) + 2) + "|")
    for asset in rows[names[0]]:
        cells = []
        for name in names:
            made = rows[name][asset]["made"]
            cells.append(told(made) if made else "none")
        print(f"| {asset} | {rows[names[0]][asset]['before']:,} | " + " | ".join(cells) + " |")


def print_means(group, rows):
    """A line for each tool, over the assets that all of them made; relative to the first one."""
    names = list(rows)
    common = [asset for asset in rows[names[0]] if all(rows[name][asset]["made"] for name in names)]
    print(f"\n| {group}, {len(common)} assets | bytes | relative | deviation | picture | CPU s | broken |")
    print("|---|---|---|---|---|---|---|")
    first = mean(rows[names[0]][asset]["made"]["bytes"] for asset in common)
    for name in names:
        made = [rows[name][asset]["made"] for asset in common]
        of = lambda key: mean([m[key] for m in made if m[key] is not None])
        every = [rows[name][asset] for asset in rows[name]]
        broken = sum(not r["made"] or (r["made"]["errors"] or 0) > (r["errors"] or 0) for r in every)
        print(f"| {name} | {of('bytes'):,.0f} | {of('bytes') / first:.3f} | {of('deviation'):.0f} | {of('picture'):.2f} "
              f"| {sum(m['seconds'] for m in made):.2f} | {broken} of {len(every)} |")


def main():
    ask = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    add_common_options(ask, repeat=1)
    ask.add_argument("--npm", type=pathlib.Path, help="the folder that has node_modules")
    ask.add_argument("--keep", help="a folder for all files that are made")
    ask.add_argument("--no-pictures", action="store_true", help="does not render what was made")
    ask.add_argument("--group", action="append", help="only these comparisons")
    ask.add_argument("assets", nargs="+", type=pathlib.Path)
    options = ask.parse_args()
    comparison = Comparison(options)
    groups = {name: group for name, group in tools(comparison.facetmill, comparison.npm).items()
              if not options.group or name in options.group}
    rows = {group: {name: {} for name in groups[group]} for group in groups}
    for asset in options.assets:
        before = comparison.prepared(asset.resolve())
        if not before:
            print(f"{asset}: cannot be read", file=sys.stderr)
            continue
        errors = comparison.errors(before)
        for group, commands in groups.items():
            for name, command in commands.items():
                after = comparison.folder / f"{asset.stem}.{group}.{name}.glb".replace(" ", "_").replace(",", "")
                rows[group][name][asset.stem] = {"before": before.stat().st_size, "errors": errors,
                                                 "made": comparison.row(command, before, after)}
        print(asset.stem, file=sys.stderr)
    for group in groups:
        print_assets(group, rows[group])
        print_means(group, rows[group])
    if not options.keep:
        shutil.rmtree(comparison.folder)


if __name__ == "__main__":
    main()
