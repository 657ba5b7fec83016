# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes FreeCAD's solvers refuse a mesh that is not that of its part and settings.

FreeCAD asks no mesh object whether it is current. Three functions of its FEM workbench, through which all solvers get
their mesh, are wrapped: the two checks before a run add a reason to refuse, and whatever takes the mesh without a check,
as scripts do, puts an error into the report view. Other mesh objects pass as before. Runs inside FreeCAD."""

import functools
from typing import Callable, Optional

import FreeCAD

#: Tells why a mesh object's mesh must not be solved with; empty for a current one, and for objects not ours.
Complaint = Callable[[object], str]
_complaint: Optional[Complaint] = None


def guard_solvers(complaint: Complaint) -> None:
    """Wraps FreeCAD's functions, once."""
    global _complaint
    if _complaint is not None:
        return
    from femsolver import run
    from femtools import checksanalysis, membertools

    _complaint = complaint
    run.Check.check_mesh_exists = _checked_in_framework(run.Check.check_mesh_exists, membertools.get_mesh_to_solve)
    checksanalysis.check_member_for_solver_calculix = _checked_by_ccxtools(
        checksanalysis.check_member_for_solver_calculix)
    membertools.get_mesh_to_solve = _announced(membertools.get_mesh_to_solve)


def _checked_in_framework(function, mesh_of_analysis):
    """For solver objects of the framework: CalculiX, Elmer, Mystran, Z88."""

    @functools.wraps(function)
    def check_mesh_exists(self):
        if not function(self):
            return False
        mesh, _ = mesh_of_analysis(self.analysis)
        problem = _complaint(mesh) if mesh is not None else ""
        if not problem:
            return True
        self.report.error(problem)
        self.fail()
        return False

    return check_mesh_exists


def _checked_by_ccxtools(function):
    """For FreeCAD's standard CalculiX solver object."""

    @functools.wraps(function)
    def check_member_for_solver_calculix(analysis, solver, mesh, member):
        message = function(analysis, solver, mesh, member)
        problem = _complaint(mesh) if mesh else ""
        return f"{message}{problem}\n" if problem else message

    return check_member_for_solver_calculix


def _announced(function):
    """For scripts that write the solver's input without a check."""

    @functools.wraps(function)
    def get_mesh_to_solve(analysis):
        mesh, message = function(analysis)
        problem = _complaint(mesh) if mesh is not None else ""
        if problem:
            FreeCAD.Console.PrintError(f"{problem}\n")
        return mesh, message

    return get_mesh_to_solve
