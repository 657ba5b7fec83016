# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes a CAD file inside FreeCAD; ./run.sh PART.step runs this script.

    scripts/freecad_python examples/mesh_part.py PART.step --size 2 --out out/part

Writes out/part.FCStd (an analysis with the part and its FEM mesh), out/part.inp and out/part.png. With --thin it meshes the
middle surface of a thin solid, with its thicknesses in the analysis.
"""

import argparse
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "workbench"))

import FreeCAD
import ObjectsFem
import Part

import quadrille.freecad
from quadrille import middle


def size_on(text):
    """Parses "Face3=0.5" into a pair."""
    name, equals, size = text.partition("=")
    if not equals:
        raise argparse.ArgumentTypeError(f"{text}: write it as Face3=0.5")
    return name, float(size)


def parse():
    """The arguments of the script."""
    parser = argparse.ArgumentParser(prog="./run.sh", description="Mesh a CAD file with quads inside FreeCAD.")
    parser.add_argument("part", help=".step, .iges or .brep")
    parser.add_argument("--out", required=True, help=argparse.SUPPRESS)
    parser.add_argument("--size", type=float, help="target edge length in mm (default: diagonal / 60)")
    parser.add_argument("--size-min", type=float, help="no size goes below this")
    parser.add_argument("--curvature", type=float, default=12, help="elements per full circle (12; 0 = off)")
    parser.add_argument("--growth", type=float, default=0.3, help="growth of the size per length (0.3)")
    parser.add_argument("--order", type=int, choices=(1, 2), default=2, help="1: S4, 2: S8R (default)")
    parser.add_argument("--strategy", choices=("direct", "subdivide"))
    parser.add_argument("--faces", default="", help="mesh these faces only: Face1,Face7")
    parser.add_argument("--size-on", type=size_on, action="append", default=[], help="Face3=0.5; may be repeated")
    parser.add_argument("--threads", type=int, default=0, help="0 = all cores")
    parser.add_argument("--thin", action="store_true", help="mesh the middle surface of a thin solid, with its thicknesses")
    parser.add_argument("--partial", action="store_true", help="keep what could be meshed when a face fails")
    return parser.parse_args()


def read(path, document):
    """The CAD file as one document object."""
    if not path.is_file():
        sys.exit(f"error: {path}: no such file")
    try:
        shape = Part.read(str(path))
    except Exception as error:
        sys.exit(f"error: {path}: FreeCAD cannot read it as CAD ({error})")
    part = document.addObject("Part::Feature", "Part")
    part.Label = path.stem
    part.Shape = shape
    return part


def main():
    """Reads, meshes, saves."""
    arguments = parse()
    out = Path(arguments.out)
    out.parent.mkdir(parents=True, exist_ok=True)
    document = FreeCAD.newDocument("Quadrille")
    part = read(Path(arguments.part), document)
    analysis = ObjectsFem.makeAnalysis(document, "Analysis")
    thickness = None if arguments.thin else middle.looks_thin(part.Shape)
    try:
        if arguments.thin:
            part = middle.make_middle(part, analysis=analysis)
        mesh = quadrille.freecad.mesh_object(
            part,
            size=arguments.size,
            size_min=arguments.size_min,
            elements_per_circle=arguments.curvature,
            growth=arguments.growth,
            order=arguments.order,
            strategy=arguments.strategy,
            faces=[name for name in arguments.faces.split(",") if name],
            sizes=dict(arguments.size_on),
            threads=arguments.threads,
            partial=arguments.partial,
            analysis=analysis,
            outputs=[f"{out}.inp"],
            picture=f"{out}.png",
        )
    except quadrille.Error as error:
        sys.exit(f"error: {error}")
    document.recompute()
    document.saveAs(f"{out}.FCStd")
    groups = mesh.FemMesh.GroupCount
    print(f"\nFreeCAD {'.'.join(FreeCAD.Version()[:2])}: {mesh.TypeId} with {mesh.FemMesh.FaceCount} quads, "
          f"{mesh.FemMesh.NodeCount} nodes and {groups} groups, in {document.Name}/{analysis.Label}")
    if thickness:
        print(f"{part.Label} looks like a thin solid, of about {thickness:.2g} mm: its skin, meshed here, is a hollow box, and shell "
              "stresses on it are meaningless; --thin meshes its middle surface")


main()
