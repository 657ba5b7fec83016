# SPDX-License-Identifier: GPL-3.0-or-later
"""A parameter study: the deflection of a cantilever plate with a hole, for several thicknesses and hole diameters.

    scripts/freecad_python examples/freecad/parameter_study.py [--out study.csv]

The part is parametric. When the hole changes, the mesh object reports that it is stale, and remesh() meshes it again. The
groups of the constraints are updated. FreeCAD's solver object runs CalculiX.
"""

import argparse
import csv
import shutil
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "workbench"))

import FreeCAD
import ObjectsFem
from FreeCAD import Vector

import quadrille.freecad

LENGTH, WIDTH, FORCE, YOUNG = 100.0, 40.0, 10.0, 210000.0


def make_part(document):
    """A plate with a hole: a face cut by a cylinder, both parametric."""
    plate = document.addObject("Part::Plane", "Plate")
    plate.Length, plate.Width = LENGTH, WIDTH
    drill = document.addObject("Part::Cylinder", "Drill")
    drill.Height = 2
    drill.Placement.Base = Vector(LENGTH / 2, WIDTH / 2, -1)
    part = document.addObject("Part::Cut", "Part")
    part.Base, part.Tool = plate, drill
    return part, drill


def edge_at(shape, x):
    """The name of the straight edge at x."""
    for i, edge in enumerate(shape.Edges, 1):
        box = edge.BoundBox
        if abs(box.XMin - x) < 1e-6 and abs(box.XMax - x) < 1e-6:
            return f"Edge{i}"
    raise RuntimeError(f"no edge at x = {x}")


def make_analysis(document, part):
    """An analysis of the plate, clamped on the left and pushed down on the right."""
    analysis = ObjectsFem.makeAnalysis(document, "Analysis")
    make_solver = getattr(ObjectsFem, "makeSolverCalculiXCcxTools", None) or ObjectsFem.makeSolverCalculixCcxTools
    solver = analysis.addObject(make_solver(document, "CalculiX"))[0]
    solver.AnalysisType = "static"
    solver.GeometricalNonlinearity = "linear"
    material = analysis.addObject(ObjectsFem.makeMaterialSolid(document, "Steel"))[0]
    material.Material = {"Name": "Steel", "YoungsModulus": f"{YOUNG} MPa", "PoissonRatio": "0.3"}
    thickness = analysis.addObject(ObjectsFem.makeElementGeometry2D(document, 1.0, "Thickness"))[0]
    fixed = analysis.addObject(ObjectsFem.makeConstraintFixed(document, "Fixed"))[0]
    force = analysis.addObject(ObjectsFem.makeConstraintForce(document, "Force"))[0]
    force.Force = f"{FORCE} N" if FreeCAD.Version()[0] != "0" else FORCE
    force.Direction = (part, [f"Face{1}"])
    return analysis, solver, thickness, fixed, force


def sag(analysis, solver):
    """The largest vertical displacement that CalculiX finds."""
    from femtools import ccxtools

    fea = ccxtools.FemToolsCcx(analysis, solver)
    fea.purge_results()
    fea.update_objects()
    with tempfile.TemporaryDirectory() as folder:
        fea.setup_working_dir(folder, create=True)
        fea.setup_ccx()
        problem = fea.check_prerequisites()
        if problem:
            raise RuntimeError(f"FreeCAD refuses the analysis: {problem}")
        fea.write_inp_file()
        fea.ccx_run()
        fea.load_results()
    result = next(member for member in analysis.Group if member.isDerivedFrom("Fem::FemResultObject"))
    return max(abs(vector.z) for vector in result.DisplacementVectors)


def main():
    """Runs the study and prints the table."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--out", help="write the table as .csv")
    arguments = parser.parse_args()
    if not shutil.which("ccx"):
        print("CalculiX (ccx) is not installed: nothing is solved")
        sys.exit(77)
    document = FreeCAD.newDocument("Study")
    part, drill = make_part(document)
    drill.Radius = 5
    document.recompute()
    analysis, solver, thickness, fixed, force = make_analysis(document, part)
    mesh = quadrille.freecad.make_mesh(part, size=4, order=2, analysis=analysis)
    rows = []
    for diameter in (8.0, 16.0, 24.0):
        drill.Radius = diameter / 2
        document.recompute()
        fixed.References = [(part, edge_at(part.Shape, 0.0))]
        force.References = [(part, edge_at(part.Shape, LENGTH))]
        quadrille.freecad.remesh(mesh)
        for height in (1.0, 2.0):
            thickness.Thickness = height
            document.recompute()
            rows.append({"diameter": diameter, "thickness": height, "quads": mesh.QuadCount,
                         "sag": round(sag(analysis, solver), 4)})
    print("\ndiameter  thickness  quads   sag")
    for row in rows:
        print(f"{row['diameter']:8g} {row['thickness']:10g} {row['quads']:6} {row['sag']:8.4f}")
    if arguments.out:
        with open(arguments.out, "w", newline="", encoding="utf-8") as file:
            writer = csv.DictWriter(file, fieldnames=list(rows[0]))
            writer.writeheader()
            writer.writerows(rows)
    # A strip without a hole deflects by F L^3 / (3 E I). A hole increases this; twice the thickness gives an eighth.
    solid = FORCE * LENGTH**3 / (3 * YOUNG * WIDTH / 12)
    if not 0.9 * solid < rows[0]["sag"] < 1.2 * solid or not rows[0]["sag"] < rows[2]["sag"] < rows[4]["sag"]:
        sys.exit(f"the deflections are implausible compared with {solid:.4f} of a strip without a hole")
    if abs(rows[0]["sag"] / rows[1]["sag"] / 8 - 1) > 0.02:
        sys.exit("twice the thickness must give an eighth of the deflection")


if __name__ == "__main__":
    main()
