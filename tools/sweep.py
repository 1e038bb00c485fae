#!/usr/bin/env python3
"""sweep.py FOLDER [--mill FACETMILL] [--seed N] [--only GLOB] [--min_bytes N] [--max_bytes N] [--json FILE] [--threads N N ...]:
every stage on every mesh of a folder.

Each file goes through every stage with its usual options, one run a stage, and through one chain of three stages drawn by
the seed. A run has 20 seconds of processor time, ten times as much in all, and 4 GiB. Exit codes are counted; told one by one
are crashes (a signal, or 70), hangs (no answer in time; with the processor time, which is less than 20 s where other work took
the machine) and surface lost in silence: faces went in and none came out, or less than a tenth of the area, and neither a
warning nor the stage's own options say why. Exit code 1 when there is any of these. A file that does not load is loaded once.
With --threads 1 3 each run is made with one and with three threads, its result written to a GLB where no other file is, and
it is told where exit codes, or bytes of outputs or reports, differ ("differs"); runs that one of them ends for want of time or memory are
counted ("not compared").
"""
import argparse
import collections
import fnmatch
import json
import os
import pathlib
import random
import resource
import shutil
import signal
import subprocess
import sys
import tempfile

os.environ["FACETMILL_CACHE"] = "off"  # what is swept runs
SECONDS, BYTES = 20, 4 << 30
SUFFIXES = {".drc", ".glb", ".gltf", ".gz", ".obj", ".off", ".ply", ".stl"}

# What people ask of each stage. FILE is the file itself. Those that are asked to take surface away may.
STAGES = ["align FILE", "clean", "clean --hidden --smaller_than 1%", "clean --weld exact --holes minimal --self_intersections all", "clip z=50% --cap", "clip x=50%",
          "combine", "crumple 0.5%", "crumple 0.5% --self_intersections avoid", "ensure --faces.min 0", "bake 64", "look --pixels 32", "generate icosphere",
          "hull", "hull --max_parts 8 --max_vertices 32", "hull capsule",
          "measure", "merge", "normals", "normals keep", "optimize", "orient", "probe 0,0,0", "relax 3", "relax --method implicit", "remesh 2%", "remesh --tolerance 1%", "render view.png",
          "section z=50%", "separate", "simplify 50%", "simplify --max_error 1%", "simplify 10% --method cluster",
          "split midpoint", "split --max_edge 5%", "textures 64 --format webp", "thicken 1%", "thicken 1% --mode edges", "tile 50%",
          "transfer FILE", "transform --scale 2", "triangulate", "triangulate quads", "two-sided", "unwrap 512", "validate --faces.min 0", "wrap 5%",
          "write out.glb", "write out.glb --draco", "write out.ply", "write out.stl", "write out.obj", "write out.off"]
# Stages that may leave nothing, or little: a plane may miss the half that has the mesh.
TAKES = {"clip", "combine", "crop", "generate", "hull", "section", "tile", "transform", "wrap"}
# As asked, puts cylinders in the place of the faces.
REPLACES = "thicken 1% --mode edges"


def crops(box):
    """A crop by the middle nine tenths of the box, along z."""
    (x0, y0, _), (x1, y1, _) = box["min"], box["max"]
    dx, dy = (x1 - x0) / 20, (y1 - y0) / 20
    return f"crop [[{x0 + dx},{y0 + dy}],[{x1 - dx},{y0 + dy}],[{x1 - dx},{y1 - dy}],[{x0 + dx},{y1 - dy}]] --axis z"


def spent():
    """Processor time of all runs so far."""
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime


def limited():
    resource.setrlimit(resource.RLIMIT_AS, (BYTES, BYTES))
    resource.setrlimit(resource.RLIMIT_CPU, (SECONDS, SECONDS + 5))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))


class Sweep:
    def __init__(self, options, folder):
        self.options, self.folder = options, folder
        self.codes, self.told, self.slowest = collections.Counter(), [], []
        self.compared = collections.Counter()

    def run(self, file, stages, threads=None):
        """The exit code (None: no answer in time) and the report of the file through these stages."""
        for old in self.folder.iterdir():
            shutil.rmtree(old) if old.is_dir() else old.unlink()
        report = self.folder / "run.json"
        line = ["load", str(file)]
        for stage in stages:
            line += ["!", *(str(file) if word == "FILE" else word for word in stage.split())]
        if threads:
            line[:0] = ["-j", str(threads)]
            if not stages[-1].startswith("write "):
                line += ["!", "write", "result.glb"]
        start = spent()
        try:
            done = subprocess.run([str(self.options.mill), "pipe", "--report", "run.json", *line], cwd=self.folder,
                                  capture_output=True, timeout=10 * SECONDS, preexec_fn=limited)
            code = None if done.returncode in (-signal.SIGXCPU, -signal.SIGKILL) else done.returncode
        except subprocess.TimeoutExpired:
            code = None
        self.slowest.append((spent() - start, f"{file.name}: {' ! '.join(stages)}"))
        try:
            return code, json.loads(report.read_text())
        except (OSError, ValueError):
            return code, None

    def files(self):
        """What the last run wrote."""
        return {str(f.relative_to(self.folder)): f.read_bytes() for f in self.folder.rglob("*") if f.is_file()}

    def run_with_threads(self, file, stages):
        """The same of the first number of threads; what the others give differently is told."""
        first, *others = self.options.threads
        code, report = self.run(file, stages, first)
        wrote = self.files()
        for threads in others:
            other_code = self.run(file, stages, threads)[0]
            if {code, other_code} & {None, 7}:
                self.compared["not compared"] += 1
                continue
            self.compared["compared"] += 1
            others_wrote = self.files()
            unlike = sorted(name for name in wrote.keys() | others_wrote.keys() if wrote.get(name) != others_wrote.get(name))
            if code != other_code or unlike:
                self.told.append(("differs", f"{file.name}: {' ! '.join(stages)} (-j {first} and {threads}: exit codes {code}, "
                                             f"{other_code}; {', '.join(unlike)})"))
        return code, report

    def judge(self, file, stages, area=None):
        """area: of the file as it is loaded."""
        code, report = self.run_with_threads(file, stages) if self.options.threads else self.run(file, stages)
        self.codes["hang" if code is None else code] += 1
        name = f"{file.relative_to(self.options.folder)}: {' ! '.join(stages) or 'load'}"
        if code is None:
            self.told.append(("hang", f"{name} ({self.slowest[-1][0]:.1f} CPU s)"))
        elif code < 0 or code == 70:
            self.told.append(("crash", f"{name} ({code})"))
        elif code in (0, 1) and report:
            self.told += [("lost", f"{name} ({why})") for why in self.lost(report, stages, area)]
        return code, report

    @staticmethod
    def lost(report, lines, area):
        """What a finished run of the stages in these lines lost of the surface without a word."""
        stages = report["stages"][1:]
        for stage in stages:
            before, after = stage.get("before") or {}, stage.get("after") or {}
            if stage["stage"] in TAKES or stage["warnings"] or not before.get("faces"):
                continue
            if not after.get("faces"):
                yield f"{stage['stage']}: {before['faces']} faces, then none"
        said = REPLACES in lines or any(stage["stage"] in TAKES or stage["warnings"] for stage in stages)
        left = (report.get("properties") or {}).get("area")
        if area and left is not None and not said and left < area / 10:
            yield f"area {area:.6g}, then {left:.6g}"

    def sweep(self, files):
        draw = random.Random(self.options.seed)
        for file in files:
            chain = draw.sample(STAGES, 3)  # drawn for every file, so that the draw does not depend on what loads
            code, report = self.judge(file, ["measure"])
            if code not in (0, 1) or not report:
                continue
            properties = report.get("properties") or {}
            box, area = properties.get("bounds"), properties.get("area")
            for stage in [s for s in STAGES if s != "measure"] + ([crops(box)] if box else []):
                self.judge(file, [stage], area)
            self.judge(file, chain, area)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--mill", type=pathlib.Path,
                        default=pathlib.Path(__file__).resolve().parents[1] / "build/release/facetmill")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--only", default="*", help="a glob of file names")
    parser.add_argument("--min_bytes", type=int, default=0, help="of a file; smaller ones are left out")
    parser.add_argument("--max_bytes", type=int, default=1 << 40, help="of a file; larger ones are left out")
    parser.add_argument("--json", type=pathlib.Path, help="where the result goes as well")
    parser.add_argument("--threads", type=int, nargs="+", metavar="N", help="each run with each of these numbers of threads")
    options = parser.parse_args()
    options.folder, options.mill = options.folder.resolve(), options.mill.resolve()
    files = sorted(f for f in options.folder.rglob("*") if f.suffix.lower() in SUFFIXES and f.is_file() and
                   fnmatch.fnmatch(f.name, options.only) and
                   options.min_bytes <= f.stat().st_size <= options.max_bytes)
    with tempfile.TemporaryDirectory() as folder:
        sweep = Sweep(options, pathlib.Path(folder))
        sweep.sweep(files)
    codes = {str(k): n for k, n in sorted(sweep.codes.items(), key=lambda item: str(item[0]))}
    print(f"{len(files)} files, {sum(sweep.codes.values())} runs; exit codes: " +
          ", ".join(f"{code}: {n}" for code, n in codes.items()))
    if options.threads:
        print(", ".join(f"{what}: {n}" for what, n in sorted(sweep.compared.items())))
    for kind, what in sweep.told:
        print(f"{kind}: {what}")
    for seconds, what in sorted(sweep.slowest, reverse=True)[:10]:
        print(f"{seconds:.1f} CPU s: {what}")
    if options.json:
        options.json.write_text(json.dumps({"codes": codes, "told": sweep.told}, indent=1) + "\n")
    sys.exit(1 if sweep.told else 0)


if __name__ == "__main__":
    main()
