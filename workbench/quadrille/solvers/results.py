# SPDX-License-Identifier: GPL-3.0-or-later
"""Results at the surfaces of shells: which solvers can give them, an analysis with one, and a hint where they are missing. Runs inside
FreeCAD."""

from typing import Any, List

import FreeCAD

from ..core.errors import translate
from . import element_types

#: Property of FreeCAD's CalculiX solver objects: results at the shell's surfaces, not only at its middle.
SURFACE_RESULTS = "BeamShellResultOutput3D"


def solvers_of(analysis) -> List[Any]:
    """The solver objects of an analysis that can give results at the surfaces of shells."""
    members = analysis.Group if analysis is not None else ()
    return [member for member in members if SURFACE_RESULTS in member.PropertiesList]


def make_analysis(document):
    """Makes the active analysis of a document: a CalculiX solver that gives results at the surfaces of shells, and steel."""
    import ObjectsFem

    analysis = ObjectsFem.makeAnalysis(document, "Analysis")
    make_solver = getattr(ObjectsFem, "makeSolverCalculiXCcxTools", None) or ObjectsFem.makeSolverCalculixCcxTools
    setattr(analysis.addObject(make_solver(document))[0], SURFACE_RESULTS, True)
    material = analysis.addObject(ObjectsFem.makeMaterialSolid(document, "Steel"))[0]
    material.Material = {"Name": "CalculiX-Steel", "YoungsModulus": "210000 MPa", "PoissonRatio": "0.30", "Density": "7900 kg/m^3"}
    if FreeCAD.GuiUp:
        import FemGui

        FemGui.setActiveAnalysis(analysis)
    return analysis


def hint_at_surfaces(result, analysis) -> None:
    """Warns in the report view if a result is for the middle of the shell only. Its stresses are the mean through the
    thickness, which in bending is almost zero. Other elements than shells have one stress through the thickness."""
    if not all(map(element_types.is_shell, analysis.Group)):
        return
    for solver in solvers_of(analysis):
        if not getattr(solver, SURFACE_RESULTS):
            FreeCAD.Console.PrintWarning(translate(
                "Quadrille", "{}: shows stresses at the middle of the shell; those of bending are at its surfaces: set {} of {} to true, and "
                "solve again").format(result.Label, SURFACE_RESULTS, solver.Label) + "\n")
            return
