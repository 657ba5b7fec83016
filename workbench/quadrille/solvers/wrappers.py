# SPDX-License-Identifier: GPL-3.0-or-later
"""Wraps functions of FreeCAD's FEM workbench, so that solvers refuse a stale mesh and take elements from groups.

FreeCAD does not ask a mesh object whether it is up to date. The functions through which all solvers get their mesh are
wrapped: the checks before a run get another reason to refuse. If the mesh is taken without a check, as scripts do, an error
is written to the report view.

With several materials or thicknesses, FreeCAD looks up each element's nodes in a list of the nodes on a face, and searches
all volumes for the faces that belong to none. Both take quadratic time in the number of elements: many minutes for 100 000.
If the mesh has the group of elements that groups.py makes for a material or thickness, that group is used. Otherwise the
list is turned into a set, and if there are no volumes, all faces count as belonging to none.

Meshes without such groups, and mesh objects that are not Quadrille's, give the same results as before. Runs inside FreeCAD."""

import functools
import importlib.util
import os
from typing import Any, Callable, List, Optional

import FreeCAD

from ..document import groups
from . import element_types, forces, shell_input
from .shell_input import Later

#: Returns why a mesh object's mesh must not be used; empty if it is up to date, and for objects that are not Quadrille's.
Complaint = Callable[[object], str]
_complaint: Optional[Complaint] = None
#: The materials or thicknesses whose elements FreeCAD is gathering.
_asked_for: List[Any] = []


def wrap_solvers(complaint: Complaint) -> None:
    """Wraps FreeCAD's functions; further calls do nothing."""
    global _complaint
    if _complaint is not None:
        return
    _complaint = complaint
    newer = NEWER if importlib.util.find_spec(NEWER[0][0]) is not None else ()
    for module, name, wrapper in (*newer, *WRAPPED):
        _wrap(module, name, wrapper)


def _problem_of(mesh) -> str:
    """Why a mesh object's mesh must not be used; empty if it may, and if there is no mesh object."""
    if not mesh or _complaint is None:
        return ""
    return _complaint(mesh) or element_types.problem_of(mesh)


def _wrap(module: str, name: str, wrapper) -> None:
    """Wraps one function of FreeCAD. These functions are internal to FreeCAD and may disappear: then one feature is missing,
    with a warning, and everything else works."""
    try:
        owner = importlib.import_module(module)
        *outer, last = name.split(".")
        for part in outer:
            owner = getattr(owner, part)
        setattr(owner, last, wrapper(getattr(owner, last)))
    except (ImportError, AttributeError) as error:
        FreeCAD.Console.PrintWarning(f"Quadrille: this FreeCAD has no {module}.{name} ({error}): "
                                     f"{_LOST[wrapper.__name__]}\n")


#: What is lost if FreeCAD's function is missing, by the name of the wrapper.
_LOST = {
    "_checked_in_framework": "solvers of the framework do not refuse a mesh that is out of date",
    "_checked_by_ccxtools": "CalculiX does not refuse a mesh that is out of date",
    "_prepared": "CalculiX does not refuse a mesh that is out of date",
    "_announced": "scripts get no error message when a mesh is out of date",
    "_of_shells": "large meshes take long to write for solvers",
    "_noting_objects": "several materials or thicknesses take long to write for solvers",
    "_from_groups": "several materials or thicknesses take long to write for solvers",
    "_when_needed": "large meshes take long to write for solvers",
    "_with_set": "several materials or thicknesses take long to write for solvers",
    "of_shells": "forces on faces take long to write for CalculiX",
    "nodes_later": "large meshes take long to write for CalculiX",
    "at_once": "large meshes take long to write for CalculiX",
    "from_groups": "forces on faces take long to write for CalculiX",
    "in_one_go": "forces on faces take long to write for CalculiX",
    "_followed": "the input for CalculiX has S4 or S8 and no offset of shells, whatever the mesh object says",
}


def _checked_in_framework(function):
    """Wraps the check for solver objects of FreeCAD's framework: CalculiX, Elmer, Mystran, Z88."""
    problem_of = _problems()

    @functools.wraps(function)
    def check_mesh_exists(self):
        if not function(self):
            return False
        problem = problem_of(self.analysis)
        if not problem:
            return True
        self.report.error(problem)
        self.fail()
        return False

    return check_mesh_exists


def _problems() -> Callable[[object], str]:
    """A function that returns why the mesh of an analysis must not be used; empty if it may. Must be called before
    get_mesh_to_solve is wrapped, which would otherwise report the problem again."""
    mesh_of_analysis = importlib.import_module("femtools.membertools").get_mesh_to_solve

    def problem_of(analysis) -> str:
        mesh, _ = mesh_of_analysis(analysis)
        return _problem_of(mesh)

    return problem_of


def _prepared(function):
    """Wraps the preparation for the CalculiX solver object of FreeCAD 1.1, which ignores the result of the check."""
    problem_of = _problems()

    @functools.wraps(function)
    def prepare(self):
        problem = problem_of(self.analysis)
        if problem:
            raise RuntimeError(problem)
        function(self)

    return prepare


def _checked_by_ccxtools(function):
    """Wraps the check for FreeCAD's standard CalculiX solver object."""

    @functools.wraps(function)
    def check_member_for_solver_calculix(analysis, solver, mesh, member):
        message = function(analysis, solver, mesh, member)
        problem = _problem_of(mesh)
        return f"{message}{problem}\n" if problem else message

    return check_member_for_solver_calculix


def _announced(function):
    """Wraps the function that gets the mesh, for scripts that write the solver's input without a check."""

    @functools.wraps(function)
    def get_mesh_to_solve(analysis):
        mesh, message = function(analysis)
        problem = _problem_of(mesh)
        if problem:
            FreeCAD.Console.PrintError(f"{problem}\n")
        return mesh, message

    return get_mesh_to_solve


def _noting_objects(function):
    """Remembers the objects whose elements are requested, since the search function gets only their references."""

    @functools.wraps(function)
    def get_femelement_sets(femmesh, femelement_table, fem_objects, *arguments, **options):
        _asked_for[:] = [entry["Object"] for entry in fem_objects]
        try:
            return function(femmesh, femelement_table, fem_objects, *arguments, **options)
        finally:
            _asked_for.clear()

    return get_femelement_sets


def _from_groups(function):
    """Takes the elements from the group that groups.py has made for the object with these references; otherwise searches."""

    @functools.wraps(function)
    def get_femelements_by_references(femmesh, femelement_table, references, *arguments, **options):
        for obj in _asked_for:
            if obj.References == references:
                found = groups.elements_in(femmesh, f"{obj.Name}_Faces")
                if found:
                    return sorted(found)
        return function(femmesh, femelement_table, references, *arguments, **options)

    return get_femelements_by_references


def _of_shells(function):
    """Same result, without a search if there are no volumes."""

    @functools.wraps(function)
    def get_femelement_faces_table(femmesh, faces_only=None):
        return function(femmesh, faces_only or (femmesh.Faces if not femmesh.VolumeCount else None))

    return get_femelement_faces_table


def _with_set(function):
    """Same result, without a search through a list for each node."""

    @functools.wraps(function)
    def get_femelements_by_femnodes_std(femelement_table, node_list):
        return function(femelement_table, set(node_list))

    return get_femelements_by_femnodes_std


def _when_needed(function):
    """Same table of each node's elements, made only when needed. FreeCAD 1.1 makes it for each input, and a text of it for its
    log, but uses it only to search elements by their nodes."""

    @functools.wraps(function)
    def get_femnodes_ele_table(femnodes_mesh, femelement_table):
        return Later(lambda: function(femnodes_mesh, femelement_table), len(femnodes_mesh))

    return get_femnodes_ele_table


# The type of elements, and the sections of shells


def _followed(function):
    """Writes CalculiX's input with the element type and the shell offset of the mesh object."""

    @functools.wraps(function)
    def write_solver_input(self, *arguments, **options):
        name = function(self, *arguments, **options)
        mesh = getattr(self, "mesh_object", None)
        if name and mesh is not None and "ReducedShells" in mesh.PropertiesList:
            files = {path for path in (getattr(self, "femmesh_file", ""), self.file_name) if path and os.path.isfile(path)}
            told = [line for path in sorted(files) for line in
                    element_types.follow(path, element_types.element_of(mesh), mesh.ReducedShells, mesh.ShellOffset)]
            for line in dict.fromkeys(told):
                FreeCAD.Console.PrintMessage(f"{mesh.Label}: {line}\n")
        return name

    return write_solver_input


#: Further functions to wrap in FreeCAD 1.1 and later; skipped if the first module does not exist. Same form as WRAPPED.
NEWER = (
    ("femsolver.calculix.calculixtools", "CalculiXTools.prepare", _prepared),
    ("femmesh.meshsetsgetter", "MeshSetsGetter._load_tables", shell_input.nodes_later),
)
#: The functions of FreeCAD to wrap: module, name, and wrapper.
WRAPPED = (
    ("femsolver.run", "Check.check_mesh_exists", _checked_in_framework),
    ("femtools.checksanalysis", "check_member_for_solver_calculix", _checked_by_ccxtools),
    ("femtools.membertools", "get_mesh_to_solve", _announced),
    ("femmesh.meshtools", "get_femelement_table", shell_input.of_shells),
    ("femmesh.meshtools", "get_femelement_faces_table", _of_shells),
    ("femmesh.meshtools", "get_femelement_sets", _noting_objects),
    ("femmesh.meshtools", "get_femelements_by_references", _from_groups),
    ("femmesh.meshtools", "get_femelements_by_femnodes_std", _with_set),
    ("femmesh.meshtools", "get_femnodes_ele_table", _when_needed),
    ("femmesh.meshtools", "get_force_obj_face_nodeload_table", forces.from_groups),
    ("femsolver.calculix.write_mesh", "write_mesh", shell_input.at_once),
    ("femsolver.calculix.write_constraint_force", "write_meshdata_constraint", forces.in_one_go),
    ("femsolver.calculix.writer", "FemInputWriterCcx.write_solver_input", _followed),
)
