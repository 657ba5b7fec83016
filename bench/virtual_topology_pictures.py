#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws four parts with features below the minimum size, meshed with and without virtual topology and by Gmsh.

    scripts/freecad_python bench/virtual_topology_pictures.py parts FOLDER
    PYTHONPATH=build/python bench/virtual_topology_pictures.py draw FOLDER --quadrille build/quadrille --gmsh gmsh -o OUT.png

The first command makes the parts. Gmsh gets twice the size and subdivides, once as the faces are and once with the faces that meet
smoothly as one compound surface. Quads outside the industry limits (without warp) are red, others with a side under half the
minimum size orange. The table is printed to standard output as Markdown."""

import argparse
import subprocess
import tempfile
from pathlib import Path
from typing import Callable, Dict, NamedTuple, Optional, Sequence, Tuple


class Case(NamedTuple):
    """A part and how it is meshed and looked at."""

    title: str
    size: float  #: mm; the minimum size is an eighth
    compound: str  #: numbers of the faces that meet smoothly, for Gmsh
    center: Tuple[float, float, float]  #: of the detail that is drawn
    eye: Tuple[float, float, float]  #: towards the eye
    half: float  #: half the width of the detail, mm


CASES: Dict[str, Case] = {
    "split_plate": Case("plane split at 4 degrees", 3, "1,2", (6, 1, 0), (0, 0, 1), 8),
    "missed_walls": Case("walls that miss each other by 0.02", 4, "", (20, 10, 5), (0.6, -1, 0.8), 8),
    "tangent_strip": Case("strip of 0.1 beside a fillet", 4, "3,6,7", (37, 10, 10), (1, -0.7, 0.8), 6),
    "split_cylinder": Case("cylinder with a cut that nearly meets its rim", 5, "1,2", (-10, 0, 3), (-1, -0.4, 0.3), 6),
}


def make_parts(folder: Path) -> None:
    """Writes the parts as BREP files. Runs in FreeCAD's Python."""
    import Part
    from FreeCAD import Vector

    def polygon(*places: Sequence[float]):
        return Part.Face(Part.makePolygon([Vector(*place) for place in (*places, places[0])]))

    folder.mkdir(parents=True, exist_ok=True)
    split = Part.makeShell([polygon((0, 0, 0), (40, 0, 0), (40, 2.8, 0)), polygon((0, 0, 0), (40, 2.8, 0), (40, 20, 0), (0, 20, 0))])
    split.sewShape()
    split.exportBrep(str(folder / "split_plate.brep"))
    walls = Part.makeBox(20, 20, 10).fuse(Part.makeBox(20, 20, 10, Vector(20, 0.02, 0)))
    walls.exportBrep(str(folder / "missed_walls.brep"))
    block = Part.makeBox(40, 20, 10)
    edge = next(e for e in block.Edges if e.CenterOfMass.isEqual(Vector(40, 10, 10), 1e-6))
    rounded = block.makeFillet(3, [edge])
    cut = Part.makePlane(0.1, 20, Vector(36.9, 0, 10))
    rounded.generalFuse([cut])[0].Solids[0].exportBrep(str(folder / "tangent_strip.brep"))
    tube = Part.makeCylinder(10, 20).Faces[0]
    knife = Part.Face(Part.Wire(Part.makeCircle(30, Vector(0, 0, 0.55), Vector(-0.05, 0, 1))))
    pieces = [face for face in tube.generalFuse([knife])[0].Faces if isinstance(face.Surface, Part.Cylinder)]
    Part.makeShell(pieces).exportBrep(str(folder / "split_cylinder.brep"))


def draw(arguments: argparse.Namespace) -> None:
    """Meshes the parts and draws the details."""
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    import numpy as np
    from matplotlib.collections import PolyCollection

    import quadrille
    from quadrille.core.quality import measure_quads

    def read(path: Path):
        mesh = quadrille.read_mesh(str(path))
        return np.asarray(mesh.points), np.asarray(mesh.quads)[:, :4]

    def by_quadrille(case: Case, part: Path, out: Path, *options: str) -> None:
        subprocess.run([arguments.quadrille, "mesh", str(part), "-o", str(out), "--size", str(case.size), "--quiet", *options], check=True)

    def by_gmsh(case: Case, part: Path, out: Path, compound: str = "") -> None:
        script = out.with_suffix(".geo")
        script.write_text(f'Merge "{part.resolve()}";\n' + (f"Compound Surface{{{compound}}};\n" if compound else ""))
        settings = {"Mesh.MeshSizeFromCurvature": 6, "Mesh.Algorithm": 6, "Mesh.RecombineAll": 1, "Mesh.RecombinationAlgorithm": 1,
                    "Mesh.SubdivisionAlgorithm": 1, "General.AbortOnError": 0}
        options = [text for name, value in settings.items() for text in ("-setnumber", name, str(value))]
        subprocess.run([arguments.gmsh, str(script), "-2", "-nt", "1", "-format", "msh22", "-clmax", str(2 * case.size), "-clmin",
                        str(case.size / 4), *options, "-o", str(out)], check=False, timeout=100, stdout=subprocess.DEVNULL,
                       stderr=subprocess.DEVNULL)

    columns: Dict[str, Callable[[Case, Path, Path], None]] = {
        "Quadrille, every edge kept": lambda case, part, out: by_quadrille(case, part, out, "--keep-features"),
        "Quadrille": by_quadrille,
        "Gmsh": by_gmsh,
        "Gmsh, compound surface": lambda case, part, out: by_gmsh(case, part, out, case.compound),
    }
    figure, axes = plt.subplots(len(CASES), len(columns), figsize=(4 * len(columns), 3.2 * len(CASES)))
    print("| | " + " | ".join(columns) + " |\n| --- |" + " ---: |" * len(columns))
    with tempfile.TemporaryDirectory() as folder:
        for row, (name, case) in zip(axes, CASES.items()):
            cells = []
            for axis, (title, mesher) in zip(row, columns.items()):
                axis.set_axis_off()
                out = Path(folder) / f"{name}.msh"
                out.unlink(missing_ok=True)
                if "compound" in title and not case.compound:
                    cells.append("no faces that meet smoothly")
                    continue
                mesher(case, arguments.folder / f"{name}.brep", out)
                if not out.exists():
                    cells.append("no mesh")
                    continue
                points, quads = read(out)
                measured = measure_quads(np.arange(len(quads)), quads, points[quads], case.size / 8)
                outside = np.any([measured.fails(criterion) for criterion in measured.criteria
                                  if criterion not in ("warp", "min_length")], axis=0)
                short = measured.fails("min_length")
                cells.append(f"{len(quads)} quads, {outside.sum()} outside, {short.sum()} short")
                detail(axis, case, measured, outside, short, np, PolyCollection)
                axis.set_title(f"{title}\n{cells[-1]}", fontsize=9)
            print(f"| {case.title} | " + " | ".join(cells) + " |")
    figure.tight_layout()
    figure.savefig(arguments.output, dpi=80)


def detail(axis, case: Case, measured, outside, short, np, poly_collection) -> None:
    """Draws the quads that face the eye near the center of the detail, the nearest last."""
    eye = np.array(case.eye, float) / np.linalg.norm(case.eye)
    right = np.cross((0, 1, 0) if abs(eye[2]) > 0.99 else (0, 0, 1), eye)
    right /= np.linalg.norm(right)
    places = measured.corners - np.array(case.center)
    flat = np.stack([places @ right, places @ np.cross(eye, right)], axis=2)
    near = (np.abs(flat) < 1.5 * case.half).all(axis=2).any(axis=1) & (measured.normals @ eye > 0.02)
    order = np.flatnonzero(near)[np.argsort((measured.centers[near] @ eye))]
    colors = np.where(outside, "#e34a33", np.where(short, "#fdbb84", "#deebf7"))
    axis.add_collection(poly_collection(flat[order], facecolors=colors[order], edgecolors="#333333", linewidths=0.6))
    axis.set_xlim(-case.half, case.half)
    axis.set_ylim(-0.7 * case.half, 0.7 * case.half)
    axis.set_aspect("equal")


def main(words: Optional[Sequence[str]] = None) -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("action", choices=("parts", "draw"))
    parser.add_argument("folder", type=Path)
    parser.add_argument("--quadrille", default="build/quadrille")
    parser.add_argument("--gmsh", default="gmsh")
    parser.add_argument("-o", "--output", type=Path, default=Path("virtual_topology.png"))
    arguments = parser.parse_args(words)
    if arguments.action == "parts":
        make_parts(arguments.folder)
    else:
        draw(arguments)


if __name__ == "__main__":
    main()
