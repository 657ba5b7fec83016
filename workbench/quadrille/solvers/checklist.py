# SPDX-License-Identifier: GPL-3.0-or-later
"""What is still missing before a mesh can be solved. Runs inside FreeCAD."""

from typing import List, NamedTuple

import numpy as np

from ..core.arrays import faces_of
from ..document import groups
from . import element_types, results


class Check(NamedTuple):
    """One point of the list."""

    name: str  #: what is checked, one of NAMES
    passed: bool


NAMES = ("analysis", "active", "material", "thickness", "pieces", "surfaces")


def checks(mesh, active=None) -> List[Check]:
    """What a shell analysis of a mesh needs, in the order of NAMES. active: the active analysis. What depends on a point that is not
    met is left out, and so is "surfaces" without a solver of CalculiX or without shells."""
    analysis = groups.analysis_of(mesh)
    found = [Check("analysis", analysis is not None)]
    if analysis is not None:
        members = analysis.Group
        found.append(Check("active", active is None or active == analysis))
        found.append(Check("material", any(obj.isDerivedFrom("App::MaterialObject") for obj in members)))
        found.append(Check("thickness", any(_is_thickness(obj) for obj in members)))
    found.append(Check("pieces", pieces(mesh.FemMesh) <= 1))
    solvers = results.solvers_of(analysis)
    if solvers and element_types.is_shell(mesh):
        found.append(Check("surfaces", all(getattr(solver, results.SURFACE_RESULTS) for solver in solvers)))
    return found


def _is_thickness(obj) -> bool:
    return getattr(getattr(obj, "Proxy", None), "Type", "").startswith("Fem::ElementGeometry2D")


def pieces(fem_mesh) -> int:
    """The number of parts of a mesh that have no node in common."""
    _, sizes, flat = faces_of(fem_mesh)
    if not sizes.size:
        return 0
    nodes, flat = np.unique(flat, return_inverse=True)
    element = np.repeat(np.arange(sizes.size), sizes)
    label = np.arange(nodes.size)
    while True:  # each element and each node takes the lowest label around it; labels are followed to their roots
        lowest = np.full(sizes.size, nodes.size)
        np.minimum.at(lowest, element, label[flat])
        below = label.copy()
        np.minimum.at(below, flat, lowest[element])
        np.minimum.at(below, label, below)  # what was joined stays joined
        below = below[below]
        if np.array_equal(below, label):
            return int(np.unique(label).size)
        label = below
