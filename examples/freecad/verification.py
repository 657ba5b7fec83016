# SPDX-License-Identifier: GPL-3.0-or-later
"""Solves shell and plane problems with known answers in CalculiX, on meshes of Quadrille and of Gmsh and on structured grids.

    scripts/freecad_python examples/freecad/verification.py                       # every case, checked
    scripts/freecad_python examples/freecad/verification.py --case hemisphere     # one case
    scripts/freecad_python examples/freecad/verification.py --case modes --mesher grid
    scripts/freecad_python examples/freecad/verification.py --converge out.json   # all meshers, several sizes

The CAD is made in FreeCAD, and Quadrille's mesh is a second-order FEM mesh object. The loads are exact: point forces, or
edge tractions integrated over the curved element edges. Supports and loads are found by position, so all meshers get the
same problem. Shells are S8R (triangles S6), plane stress is CPS8R (CPS6). Each problem has its own units.

Gmsh runs as a command, with Blossom for quads, which leaves some triangles. Its full-quad mode refuses surfaces of
revolution, its frontal points for quads crash version 4.8.4, and FreeCAD 0.20's Gmsh object gives four-node quads and
six-node triangles when asked for second-order quads.
"""

import argparse
import json
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "workbench"))

import FreeCAD
from FreeCAD import Vector

import quadrille.freecad
from known_answers.beams import (CurvedBeamInPlane, CurvedBeamOutOfPlane, TJoint, TwistedBeamInPlane,
                                 TwistedBeamOutOfPlane, ZSection)
from known_answers.grid import grid
from known_answers.large import EndShear, PulledCylinder, SlitAnnulus
from known_answers.patches import BendingPatch, CutBendingPatch, MembranePatch, QuadrangleBendingPatch, SkewBendingPatch
from known_answers.plates import Buckling, EllipticMembrane, Modes, PlateWithHole, SkewPlate
from known_answers.shells import (ClosedHemisphere, CylinderModes, GradedPinchedCylinder, Hemisphere, Hook,
                                  PinchedCylinder)
from known_answers.solver import Mesh, Problem, displacements, write_input  # noqa: F401 (adapt_study.py takes them from here)

MESHERS = ("quadrille", "gmsh-quads", "gmsh-triangles", "grid")
CASES = {
    "pinched-cylinder": PinchedCylinder, "pinched-cylinder-graded": GradedPinchedCylinder, "hemisphere": Hemisphere,
    "nafems-le3": ClosedHemisphere, "raasch-hook": Hook, "cylinder-modes": CylinderModes,
    "twisted-beam-in-plane": TwistedBeamInPlane, "twisted-beam-out-of-plane": TwistedBeamOutOfPlane,
    "curved-beam-in-plane": CurvedBeamInPlane, "curved-beam-out-of-plane": CurvedBeamOutOfPlane,
    "nafems-le5": ZSection, "t-joint": TJoint,
    "nafems-le1": EllipticMembrane, "nafems-le6": SkewPlate, "plate-with-hole": PlateWithHole, "modes": Modes,
    "buckling": Buckling, "end-shear": EndShear, "slit-annulus": SlitAnnulus, "pulled-cylinder": PulledCylinder,
    "membrane-patch": MembranePatch,
    "bending-patch-skew": SkewBendingPatch, "bending-patch-quadrangle": QuadrangleBendingPatch,
    "bending-patch": BendingPatch,
}


def mesh_with(mesher, part, size, refined=(), share=1.0, strips=False):
    """A second-order mesh of a part. At the points `refined`, the size is `share` times `size`. With `strips`, no
    quad of Quadrille crosses the smooth edges between faces."""
    if mesher == "quadrille":
        names = {f"Vertex{i}": share * size for i, vertex in enumerate(part.Shape.Vertexes, 1)
                 if any(vertex.Point.isEqual(Vector(*point), 1e-6) for point in refined)}
        return Mesh.of_fem_mesh(quadrille.freecad.mesh_object(part, size=size, order=2, sizes=names,
                                                              keep_features=strips).FemMesh)
    with tempfile.TemporaryDirectory() as folder:
        model, result = Path(folder) / "part.brep", Path(folder) / "part.msh"
        part.Shape.exportBrep(str(model))
        options = {"Mesh.ElementOrder": 2, "Mesh.SecondOrderIncomplete": 1, "Mesh.MeshSizeMax": size,
                   "Mesh.MeshSizeMin": size}
        if mesher == "gmsh-quads":
            options.update({"Mesh.RecombineAll": 1, "Mesh.RecombinationAlgorithm": 1, "Mesh.Algorithm": 6})
        if refined:
            script = Path(folder) / "part.geo"
            script.write_text(graded_script(model, size, refined, share))
            model = script
            options.update({"Mesh.MeshSizeMin": share * size, "Mesh.MeshSizeExtendFromBoundary": 0})
        settings = [word for name, value in options.items() for word in ("-setnumber", name, str(value))]
        done = subprocess.run(["gmsh", "-2", str(model), "-format", "msh2", "-o", str(result), *settings],
                              capture_output=True, text=True, timeout=300, check=False)
        if done.returncode != 0 or not result.exists():
            raise RuntimeError(f"Gmsh made no mesh: {done.stderr[-300:]}")
        return Mesh.of_msh(result.read_text())


def graded_script(model, size, refined, share, growth=0.3):
    """A Gmsh script for sizes that grow away from points, like Quadrille's."""
    boxes = [", ".join(str(value + side) for side in (-1e-6, 1e-6) for value in point) for point in refined]
    found = "\n".join(f"found() += Point In BoundingBox {{{box}}};" for box in boxes)
    return (f'SetFactory("OpenCASCADE");\nMerge "{model}";\nfound() = {{}};\n{found}\n'
            "Field[1] = Distance;\nField[1].PointsList = {found()};\n"
            f"Field[2] = Threshold;\nField[2].InField = 1;\nField[2].SizeMin = {share * size};\n"
            f"Field[2].SizeMax = {size};\nField[2].DistMin = 0;\nField[2].DistMax = {(1 - share) * size / growth};\n"
            "Background Field = 2;\n")


def run(name, mesher, size):
    """Solves one case. Returns a dictionary for the table. Raises RuntimeError if there is no mesh or no answer."""
    case = CASES[name]()
    document = FreeCAD.newDocument("Verification")
    try:
        part = document.addObject("Part::Feature", "Part")
        part.Shape = case.shape()
        if mesher == "grid":
            if hasattr(case, "refined"):
                raise RuntimeError("a grid has one size")
            mesh = grid(part.Shape, size, getattr(case, "corners", ()))
        else:
            mesh = mesh_with(mesher, part, size, getattr(case, "refined", ()), getattr(case, "share", 1.0),
                             getattr(case, "strips", False))
    finally:
        FreeCAD.closeDocument(document.Name)
    started = time.monotonic()
    value = float(case.answer(mesh))
    triangles = sum(1 for element in mesh.elements if len(element) == 6)
    return {"case": name, "mesher": mesher, "size": size, "elements": len(mesh.elements), "triangles": triangles,
            "nodes": len(mesh.points), "value": value, "reference": case.reference,
            "solver_seconds": round(time.monotonic() - started, 2)}


def print_shells():
    """Prints the error of each of CalculiX's shell elements in the bending patch tests."""
    for case in (SkewBendingPatch(), QuadrangleBendingPatch(), CutBendingPatch()):
        document = FreeCAD.newDocument("Verification")
        part = document.addObject("Part::Feature", "Part")
        part.Shape = case.shape()
        mesh = mesh_with("quadrille", part, case.size, strips=getattr(case, "strips", False))
        FreeCAD.closeDocument(document.Name)
        for shell in ("S4", "S4R", "S8", "S8R"):
            print(f"{type(case).__name__:22} {len(mesh.elements):4} {shell:4} off by {case.error(mesh, shell):.2g}")


def error_of(row):
    """The error in percent, or the absolute error if the reference is 0."""
    return abs(row["value"]) if row["reference"] == 0 else 100 * (row["value"] / row["reference"] - 1)


def keep_rows(path, rows):
    """Writes rows to a file, sorted by case and mesher. They replace its rows of the same cases and meshers."""
    present = json.loads(path.read_text(encoding="utf-8")) if path.exists() else []
    made = {(row["case"], row["mesher"]) for row in rows}
    rows = [row for row in present if (row["case"], row["mesher"]) not in made] + rows
    rows.sort(key=lambda row: (list(CASES).index(row["case"]), MESHERS.index(row["mesher"])))
    path.write_text(json.dumps(rows, indent=1) + "\n", encoding="utf-8")


def main():
    """Checks the cases, or runs convergence studies."""
    parser = argparse.ArgumentParser(description="Known answers, with Quadrille and CalculiX.")
    parser.add_argument("--case", choices=sorted(CASES), action="append")
    parser.add_argument("--converge", help="run meshers over several sizes; their rows in this .json are replaced")
    parser.add_argument("--mesher", choices=MESHERS, action="append", help="with --converge not all of them, else not Quadrille")
    parser.add_argument("--shells", action="store_true", help="the bending patch tests with each kind of shell")
    parser.add_argument("--size", type=float, help="another size than the case's own")
    arguments = parser.parse_args()
    if not shutil.which("ccx"):
        print("CalculiX (ccx) is not installed: nothing is solved")
        sys.exit(77)
    if arguments.shells:
        print_shells()
        return
    rows, wrong = [], []
    for name in arguments.case or CASES:
        case = CASES[name]
        sizes = case.sizes if arguments.converge else (arguments.size or case.size,)
        meshers = arguments.mesher or (MESHERS if arguments.converge else ("quadrille",))
        runs = [(mesher, size) for mesher in meshers for size in sizes]
        for mesher, size in runs:
            try:
                row = run(name, mesher, size)
            except (RuntimeError, subprocess.TimeoutExpired) as problem:
                if not arguments.converge:
                    raise
                print(f"{name:17} {mesher:15} size {size:<6g} failed: {problem}", flush=True)
                continue
            rows.append(row)
            off = error_of(row)
            unit = "" if row["reference"] == 0 else " %"
            print(f"{name:17} {mesher:15} size {size:<6g} {row['elements']:6} elements  {row['value']:.5g}"
                  f"   reference {row['reference']:g}   off by {off:+.3g}{unit}", flush=True)
            limit = case.absolute if case.tolerance is None else case.tolerance
            if not arguments.converge and not abs(off) <= limit:
                wrong.append(name)
    if arguments.converge:
        keep_rows(Path(arguments.converge), rows)
    if wrong:
        sys.exit(f"off by more than allowed: {', '.join(wrong)}")


if __name__ == "__main__":
    main()
