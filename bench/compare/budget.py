#!/usr/bin/env python3
"""`run web -D budget` and `-D look` beside gltfpack and gltf-transform: pictures at equal bytes, bytes at equal pictures.

For each asset and peer: the peer makes a file. `budget` gets the bytes of that file, and `look` its difference. All
files are judged alike: facetmill decodes and renders them from five sides, with ambient occlusion; three of them are
not among the six of `fit`. `rms` is the root mean square difference from the asset's pictures over the pixels that either
covers, on black and white, in percent; `ssim` is the structural similarity of their luminance (Wang et al., 2004).

Renderings of facetmill show an instanced mesh once, so gltf-transform makes no instances. npm's gltfpack has no WebP: for
-tw, gltf-transform makes the images WebP at quality 80 first, as gltfpack -tq 8 does.

bench/compare/budget.py --exe build/release/facetmill --npm FOLDER ASSET.glb...      needs numpy and Pillow"""

import argparse
import json
import math
import pathlib
import subprocess
import tempfile

import numpy
from PIL import Image

VIEWS = ("corner", "front", "back", "left", "top")


def coverings(picture):
    """The picture on black and on white, as shares of the full range, and where it covers anything."""
    rgb, alpha = picture[..., :3] / 255.0, picture[..., 3:] / 255.0
    return rgb * alpha, rgb * alpha + 1 - alpha, alpha[..., 0] > 0


def structural_similarity(a, b, covered):
    """The mean over covered pixels, with windows of 7 x 7."""
    def mean(x):
        sums = numpy.pad(x, ((4, 3), (4, 3)), mode="edge").cumsum(0).cumsum(1)
        return (sums[7:, 7:] - sums[:-7, 7:] - sums[7:, :-7] + sums[:-7, :-7]) / 49
    ma, mb = mean(a), mean(b)
    va, vb, vab = mean(a * a) - ma * ma, mean(b * b) - mb * mb, mean(a * b) - ma * mb
    c1, c2 = 0.01 ** 2, 0.03 ** 2
    similarity = (2 * ma * mb + c1) * (2 * vab + c2) / ((ma ** 2 + mb ** 2 + c1) * (va + vb + c2))
    return similarity[covered].mean()


class Comparison:
    def __init__(self, options):
        self.exe, self.bin = options.exe.resolve(), options.npm.resolve() / "node_modules/.bin"
        self.pixels, self.limit = options.pixels, options.time_limit
        self.folder = pathlib.Path(options.keep or tempfile.mkdtemp()).resolve()
        self.folder.mkdir(parents=True, exist_ok=True)

    def call(self, *command):
        try:
            return subprocess.run([str(c) for c in command], capture_output=True, text=True, cwd=self.folder,
                                  stdin=subprocess.DEVNULL, timeout=self.limit)
        except subprocess.TimeoutExpired:
            return None

    def pictures(self, asset, file):
        """Those of the asset and of the file, by the same cameras, one above the other."""
        rows = []
        for view in VIEWS:
            pair = self.folder / "judge.png"
            pair.unlink(missing_ok=True)
            self.call(self.exe, "pipe", "-q", "load", asset, "!", "render", pair, "--with", file, "--view", view,
                      "--width", self.pixels, "--height", self.pixels, "--edges", "no")
            if not pair.exists():
                return None
            rows.append(numpy.asarray(Image.open(pair).convert("RGBA"), float))
        both = numpy.concatenate(rows)
        return both[:, :both.shape[1] // 2], both[:, both.shape[1] // 2:]

    def judged(self, asset, file):
        """(rms, ssim) of the file's pictures."""
        pictures = self.pictures(asset, file)
        if pictures is None:
            return None
        (black_a, white_a, in_a), (black_b, white_b, in_b) = (coverings(p) for p in pictures)
        covered = in_a | in_b
        squares = ((black_a - black_b) ** 2 + (white_a - white_b) ** 2)[covered].mean() / 2
        luminance = numpy.array([0.2126, 0.7152, 0.0722])
        ssim = [structural_similarity(a @ luminance, b @ luminance, covered)
                for a, b in ((black_a, black_b), (white_a, white_b))]
        return 100 * math.sqrt(squares), sum(ssim) / 2

    def peers(self, asset):
        """By name: the file of each peer that made one."""
        webp, made = self.folder / "webp.glb", {}
        webp.unlink(missing_ok=True)
        self.call(self.bin / "gltf-transform", "webp", asset, webp, "--quality", 80)
        source = webp if webp.exists() else asset
        packed = {f"gltfpack -cc -si {how} -tw":
                  lambda out, how=how: [self.bin / "gltfpack", "-cc", "-si", *how.split(), "-i", source, "-o", out]
                  for how in ("0.5", "0.2 -se 0.1")}
        optimize = {"gltf-transform optimize":
                    lambda out: [self.bin / "gltf-transform", "optimize", asset, out, "--texture-compress", "webp",
                                 "--compress", "meshopt", "--instance", "false"]}
        for name, command in {**packed, **optimize}.items():
            out = self.folder / f"peer{len(made)}.glb"
            out.unlink(missing_ok=True)
            self.call(*command(out))
            if out.exists():
                made[name] = out
        return made

    def fitted(self, asset, name, **limits):
        """The file of `run web` with these limits; none if nothing fits."""
        out = self.folder / name
        out.mkdir(exist_ok=True)
        file = out / f"{asset.stem}.glb"
        file.unlink(missing_ok=True)
        self.call(self.exe, "run", "-q", "web", "-D", f"input={asset}", "-D", f"pixels={self.pixels}",
                  "--output-dir", out, *(word for k, v in limits.items() for word in ("-D", f"{k}={v}")))
        return file if file.exists() else None

    def as_alike(self, asset, rms, best=None):
        """The smallest file found that the judge finds as much alike: its bytes. best: of a known one."""
        look = rms
        for _ in range(4):
            file = self.fitted(asset, "look", look=f"{look:.4f}%")
            found = file and self.judged(asset, file)
            if not found:
                return best
            if found[0] <= rms and (best is None or file.stat().st_size < best):
                best = file.stat().st_size
            if found[0] <= rms and found[0] > 0.93 * rms:
                break
            look *= (1 if found[0] <= rms else 0.97) * rms / max(found[0], 1e-6)
        return best


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("assets", nargs="+", type=pathlib.Path)
    parser.add_argument("--exe", type=pathlib.Path, required=True)
    parser.add_argument("--npm", type=pathlib.Path, required=True)
    parser.add_argument("--pixels", type=int, default=256)
    parser.add_argument("--time-limit", type=float, default=600, help="seconds for each command")
    parser.add_argument("--keep", help="a folder for the files")
    parser.add_argument("--no-look", action="store_true", help="only compare at equal bytes")
    options = parser.parse_args()
    work = Comparison(options)
    print("| asset | peer | bytes | rms | rms, budget | ssim | ssim, budget | bytes, look / bytes |")
    print("| --- | --- | ---: | ---: | ---: | ---: | ---: | ---: |")
    rows = []
    for asset in (a.resolve() for a in options.assets):
        for peer, file in work.peers(asset).items():
            judged, size = work.judged(asset, file), file.stat().st_size
            own = work.fitted(asset, "budget", budget=f"{size}B")
            if own and own.stat().st_size > size:
                raise SystemExit(f"{asset}: {own.stat().st_size} bytes for a budget of {size}")
            found = own and work.judged(asset, own)
            known = own.stat().st_size if found and judged and found[0] <= judged[0] else None
            alike = None if options.no_look or not judged else work.as_alike(asset, judged[0], known)
            rows.append((peer, judged, found, alike and alike / size))
            cells = [asset.stem, peer, f"{size:,}"]
            for i, digits in ((0, 2), (1, 4)):
                cells += [f"{x[i]:.{digits}f}" if x else "-" for x in (judged, found)]
            print("| " + " | ".join([*cells, f"{alike / size:.3f}" if alike else "-"]) + " |", flush=True)
    for peer in dict.fromkeys(row[0] for row in rows):
        pairs = [(j, f) for p, j, f, _ in rows if p == peer and j and f]
        ratios = [r for p, _, _, r in rows if p == peer and r]
        print(f"\n{peer}: {len(pairs)} assets at equal bytes, less rms in {sum(f[0] < j[0] for j, f in pairs)}, "
              f"more ssim in {sum(f[1] > j[1] for j, f in pairs)}")
        if ratios:
            print(f"at equal rms: geometric mean of bytes {math.exp(sum(map(math.log, ratios)) / len(ratios)):.3f} of "
                  f"{len(ratios)} assets")


if __name__ == "__main__":
    main()
