# SPDX-License-Identifier: GPL-3.0-or-later
"""The Scordelis-Lo roof, from CAD to displacement: FreeCAD part, Quadrille mesh, CalculiX through FreeCAD's FEM.

    scripts/freecad_python examples/scordelis_lo.py [--size 1.5] [--save out/roof.FCStd]

A cylindrical roof (radius 25, length 50, 80 degrees, thickness 0.25, E 4.32e8, Poisson's ratio 0) rests on end
diaphragms, which support it in their plane, and carries its own weight of 90 per area. The middle of a free edge moves
down by 0.3024 (MacNeal & Harder 1985).

The problem has no units. Here the unit of length is a millimeter and the unit of force a newton, so E is 4.32e8 MPa, and
FreeCAD's numbers are those of the problem. The weight is FreeCAD's self weight constraint, with the density that makes
it 90 N/mm^2 under FreeCAD's gravity.

FreeCAD writes eight-node quads as S8. The script solves again with S8R, which is better on thin shells.
"""

import argparse
import math
import shutil
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "workbench"))

import FreeCAD
import ObjectsFem
import Part
from FreeCAD import Units, Vector

import quadrille.freecad

RADIUS, LENGTH, HALF_ANGLE, THICKNESS = 25.0, 50.0, math.radians(40), 0.25
YOUNG, WEIGHT, REFERENCE = 4.32e8, 90.0, 0.3024
EDGE = Vector(RADIUS * math.sin(HALF_ANGLE), 0, RADIUS * math.cos(HALF_ANGLE))


def make_roof(document):
    """The roof as a part: one cylindrical face, its axis along y."""
    arc = Part.Arc(Vector(-EDGE.x, 0, EDGE.z), Vector(0, 0, RADIUS), EDGE)
    roof = document.addObject("Part::Feature", "Roof")
    roof.Shape = arc.toShape().extrude(Vector(0, LENGTH, 0))
    return roof


def add_weight(document, analysis, material):
    """Self weight of 90 per area."""
    weight = ObjectsFem.makeConstraintSelfWeight(document, "Weight")
    if hasattr(weight, "GravityAcceleration"):  # FreeCAD 1.0
        gravity = weight.GravityAcceleration.getValueAs("mm/s^2").Value
        weight.GravityDirection = Vector(0, 0, -1)
    else:
        from femtools import constants

        # The writer of FreeCAD 0.20 truncates the decimals.
        gravity = int(Units.Quantity(constants.gravity()).getValueAs("mm/s^2"))
        weight.Gravity_x, weight.Gravity_y, weight.Gravity_z = 0, 0, -1
    values = material.Material
    values["Density"] = f"{1000 * WEIGHT / THICKNESS / gravity!r} kg/mm^3"
    material.Material = values
    analysis.addObject(weight)


def add_support(document, analysis, name, references, axes):
    """Fixes edges or vertices along some axes; rotations stay free."""
    support = ObjectsFem.makeConstraintDisplacement(document, name)
    support.References = references
    for axis in "xyz":
        for name, held in ((axis, axis in axes), (f"rot{axis}", False)):
            setattr(support, f"{name}Free", not held)
            if hasattr(support, f"{name}Fix"):  # FreeCAD 1.0 lacks one of the two
                setattr(support, f"{name}Fix", held)
    analysis.addObject(support)


def make_analysis(document, roof, size):
    """The whole analysis, with its mesh."""
    analysis = ObjectsFem.makeAnalysis(document, "Analysis")
    # FreeCAD 1.0 spells it with a capital X.
    make_solver = getattr(ObjectsFem, "makeSolverCalculiXCcxTools", None) or ObjectsFem.makeSolverCalculixCcxTools
    solver = make_solver(document, "CalculiX")
    solver.AnalysisType = "static"
    solver.GeometricalNonlinearity = "linear"
    solver.ThermoMechSteadyState = False
    solver.IterationsControlParameterTimeUse = False
    solver.SplitInputWriter = False
    solver.BeamShellResultOutput3D = False  # results at the nodes of the mesh
    analysis.addObject(solver)
    material = ObjectsFem.makeMaterialSolid(document, "Material")
    material.Material = {"Name": "Roof", "YoungsModulus": f"{YOUNG} MPa", "PoissonRatio": "0"}
    analysis.addObject(material)
    analysis.addObject(ObjectsFem.makeElementGeometry2D(document, THICKNESS, "Thickness"))
    add_weight(document, analysis, material)
    arcs = [f"Edge{i}" for i, edge in enumerate(roof.Shape.Edges, 1) if not isinstance(edge.Curve, Part.Line)]
    add_support(document, analysis, "Diaphragms", [(roof, name) for name in arcs], "xz")
    # The load has no component along the axis, so one corner is enough to hold the roof in that direction.
    add_support(document, analysis, "AxialStop", [(roof, "Vertex1")], "y")
    mesh = quadrille.freecad.mesh_object(roof, size=size, order=2, elements_per_circle=0, analysis=analysis)
    document.recompute()
    return analysis, solver, mesh


def solve(analysis, solver, folder):
    """Solves with FreeCAD's CalculiX tools. Returns the result object."""
    from femtools import ccxtools

    fea = ccxtools.FemToolsCcx(analysis, solver)
    fea.purge_results()
    fea.update_objects()
    fea.setup_working_dir(str(folder), create=True)
    fea.setup_ccx()
    problem = fea.check_prerequisites()
    if problem:
        raise RuntimeError(f"FreeCAD refuses the analysis: {problem}")
    fea.write_inp_file()
    fea.ccx_run()
    fea.load_results()
    for member in analysis.Group:
        if member.isDerivedFrom("Fem::FemResultObject"):
            return member
    raise RuntimeError("CalculiX gave no result")


def sinking(mesh, result):
    """The downward displacement of the middles of the two free edges, averaged."""
    displacements = dict(zip(result.NodeNumbers, result.DisplacementVectors))
    nodes = mesh.FemMesh.Nodes
    found = []
    for side in (-1, 1):
        middle = Vector(side * EDGE.x, LENGTH / 2, EDGE.z)
        node = min(nodes, key=lambda i: (nodes[i] - middle).Length)
        found.append(-displacements[node].z)
    return sum(found) / 2


def main():
    """Builds, meshes, solves, prints."""
    parser = argparse.ArgumentParser(description="The Scordelis-Lo roof in FreeCAD, with Quadrille and CalculiX.")
    parser.add_argument("--size", type=float, default=1.5, help="element size (1.5)")
    parser.add_argument("--tolerance", type=float, help="fail when a result is off by more than this, in percent")
    parser.add_argument("--save", help="save the document here")
    arguments = parser.parse_args()
    if not shutil.which("ccx"):
        print("CalculiX (ccx) is not installed: nothing is solved")
        sys.exit(77)
    document = FreeCAD.newDocument("ScordelisLo")
    roof = make_roof(document)
    analysis, solver, mesh = make_analysis(document, roof, arguments.size)
    lines = [f"\n{mesh.QuadCount} quads, {mesh.NodeCount} nodes"]
    worst = 0.0
    for element, reduced in (("S8 (FreeCAD's choice)", False), ("S8R", True)):
        with tempfile.TemporaryDirectory() as folder:
            mesh.ReducedShells = reduced
            value = sinking(mesh, solve(analysis, solver, folder))
        off = 100 * (value / REFERENCE - 1)
        worst = max(worst, abs(off))
        lines.append(f"{element:22} sinks by {value:.4f}   reference {REFERENCE}   off by {off:+.2f} %")
    print("\n".join(lines))  # after FreeCAD's own output
    if arguments.save:
        document.saveAs(arguments.save)
    if arguments.tolerance is not None and worst > arguments.tolerance:
        sys.exit(f"off by more than {arguments.tolerance} %")


main()
