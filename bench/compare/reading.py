#!/usr/bin/env python3
"""reading.py [MESH] [--python INTERPRETER]: reading each format beside the fastest readers of others, in one run.

One mesh (a rough closed sphere of 1,310,720 faces unless a file is given) is written as PLY, STL, OBJ, GLB, Draco and
meshopt. Each peer reads it inside its own process, so that no start of an interpreter is counted; the rounds alternate,
the fastest read of each counts. Wall and processor seconds, as times of the reader named first in the row's format.

What the peers leave out: trimesh reads PLY and GLB unprocessed, and STL with its own weld; VTK welds STL exactly; fast_obj
and rapidobj make no mesh of what they read; Draco and meshoptimizer only decode. facetmill checks every number of the file.

Of C++: Draco and meshoptimizer; fast_obj and rapidobj where the build knows them:
  cmake --preset release -DFACETMILL_BENCH=ON -DFAST_OBJ_SOURCE=its checkout -DRAPIDOBJ_SOURCE=its checkout
Of Python, where the interpreter has them: trimesh, VTK.
"""
import argparse
import json
import pathlib
import sys
import tempfile

from peers import ROOT, TIMED, add_common_options, crumpled_sphere, output

TRIMESH = "import trimesh; load = lambda: trimesh.load(sys.argv[1], process={process}, force='mesh')"
VTK = """
from vtkmodules.vtkIOGeometry import vtkSTLReader, vtkOBJReader
from vtkmodules.vtkIOPLY import vtkPLYReader
def load():
    reader = {reader}(); reader.SetFileName(sys.argv[1]); reader.Update()
    class Faces: faces = range(reader.GetOutput().GetNumberOfPolys())
    return Faces
"""
IN_PYTHON = """
best = (1e9, 1e9)
for _ in range(int(sys.argv[2])):
    mesh, *taken = measured(load)
    best = tuple(map(min, best, taken))
report(*best, len(mesh.faces))
"""
# Format: how facetmill writes it, and who else reads it.
FORMATS = {
    "PLY": ("ply", [], ["trimesh", "VTK"]),
    "STL": ("stl", [], ["trimesh", "VTK"]),
    "OBJ": ("obj", [], ["fast_obj", "rapidobj", "trimesh", "VTK"]),
    "GLB": ("glb", [], ["trimesh"]),
    "Draco": ("drc", [], ["draco"]),
    "meshopt": ("meshopt.glb", ["--meshopt"], ["meshoptimizer"]),
}


def python_code(peer, file_format):
    if peer == "trimesh":
        return TIMED + TRIMESH.format(process=file_format == "STL") + IN_PYTHON
    return TIMED + VTK.format(reader=f"vtk{file_format}Reader") + IN_PYTHON


def commands(given, folder):
    """By format the command of each reader, facetmill's first."""
    program = given.build / "bench/read_peers"
    own = output([program]).split()
    module = {"trimesh": "trimesh", "VTK": "vtkmodules"}
    there = set(own)
    for peer, name in module.items():
        try:
            output([given.python or "false", "-c", f"import {name}"])
            there.add(peer)
        except (RuntimeError, OSError):
            print(f"missing: {peer}", file=sys.stderr)
    for file_format, (ending, _, peers) in FORMATS.items():
        path = f"{folder}/mesh.{ending}"
        yield file_format, {
            peer: [program, peer, path] if peer in own else
                  [given.python, "-c", python_code(peer, file_format), path]
            for peer in ["facetmill", *peers] if peer in there}


def main():
    ask = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    ask.add_argument("mesh", nargs="?")
    ask.add_argument("--rounds", default=3, type=int)
    add_common_options(ask, repeat=3)
    given = ask.parse_args()
    facetmill = given.build / "facetmill"
    with tempfile.TemporaryDirectory() as folder:
        mesh = given.mesh or pathlib.Path(folder) / "in.ply"
        if not given.mesh:
            crumpled_sphere(facetmill, 8, mesh)
        for ending, options, _ in FORMATS.values():
            output([facetmill, "pipe", "--quiet", "load", mesh, "!", "write", f"{folder}/mesh.{ending}", *options])
        print("| format | reader | faces | seconds | CPU s | facetmill's CPU is | peak over the mesh |\n"
              "|---|---|---|---|---|---|---|")
        for file_format, readers in commands(given, folder):
            taken = {}
            for _ in range(given.rounds):
                for name, command in readers.items():
                    run = json.loads(output([*command, str(given.repeat)]).splitlines()[-1])
                    best = taken.setdefault(name, run)
                    best.update({key: min(best[key], run[key]) for key in ("wall", "cpu")})
            for name, run in taken.items():
                ratio = "" if name == "facetmill" else f"{taken['facetmill']['cpu'] / run['cpu']:.2f}"
                peak = f"{run['peak'] / run['bytes']:.2f}" if run.get("bytes") else ""
                print(f"| {file_format} | {name} | {run['faces']:,} | {run['wall']:.3f} | {run['cpu']:.3f} | {ratio} | {peak} |",
                      flush=True)


if __name__ == "__main__":
    main()
