# SPDX-License-Identifier: GPL-3.0-or-later
"""Forces on whole faces, for FreeCAD's CalculiX writer. FreeCAD finds the elements of a face by the distance of every node,
sums areas element by element, and writes node by node (from 1.0 on with a Quantity for each). This takes 20 s for 100 000
quads. Where the mesh has the groups of the faces, this module takes the elements from them, and computes areas and lines
with NumPy. Runs inside FreeCAD."""

import functools
from collections.abc import Mapping
from typing import Dict, List, Optional, Tuple

import numpy as np

from FreeCAD import Units

from ..core import arrays
from ..core.arrays import Shells
from ..core.errors import Error
from ..document import groups, shapes, state
from .shell_input import ElementTable, rows


class Loads(Mapping):
    """The force on each node of a face. FreeCAD uses a dictionary for it; here it is kept as arrays.

    `newtons[i]` is the force on the node `nodes[i]`; node ids ascend. `unit` is the factor that FreeCAD applies to loads, 1.0
    or a Quantity of 1. `shells` is the mesh, which the writer of the mesh uses later."""

    def __init__(self, nodes: np.ndarray, newtons: np.ndarray, unit, shells: Shells) -> None:
        self.nodes, self.newtons, self._unit, self.shells = nodes, newtons, unit, shells

    def __getitem__(self, node):
        place = np.searchsorted(self.nodes, node)
        if place == len(self.nodes) or self.nodes[place] != node:
            raise KeyError(node)
        return float(self.newtons[place]) * self._unit

    def __iter__(self):
        return iter(self.nodes.tolist())

    def __len__(self):
        return len(self.nodes)

    def lines(self, direction) -> str:
        """CalculiX's input lines for a force along a direction, axis by axis as FreeCAD writes them."""
        return "".join(rows(f"%d,{axis},%.13G\n", self.nodes, share * self.newtons)
                       for axis, share in enumerate(direction, 1) if abs(share) > 1e-15)  # FreeCAD's own limit


def from_groups(function):
    """Wraps FreeCAD's function for the loads of a force on faces: takes them from the faces' groups, or by FreeCAD's search
    if there are no groups."""

    @functools.wraps(function)
    def get_force_obj_face_nodeload_table(femmesh, femelement_table, femnodes_mesh, frc_obj):
        table = _table(femmesh, femelement_table, femnodes_mesh, frc_obj)
        return function(femmesh, femelement_table, femnodes_mesh, frc_obj) if table is None else table

    return get_force_obj_face_nodeload_table


def in_one_go(function):
    """Wraps FreeCAD's writer of forces: writes such loads in one go, and all others as FreeCAD does."""

    @functools.wraps(function)
    def write_meshdata_constraint(f, femobj, force_obj, ccxwriter):
        table = femobj["NodeLoadTable"]
        if not all(isinstance(loads, Loads) for _, loads in table):
            function(f, femobj, force_obj, ccxwriter)
            return
        # The text before the loads differs between versions, so FreeCAD writes it.
        function(f, {**femobj, "NodeLoadTable": []}, force_obj, ccxwriter)
        for name, loads in table:
            f.write(f"** {name}\n{loads.lines(femobj['Object'].DirectionVector)}\n")

    return write_meshdata_constraint


def _table(femmesh, femelement_table: Mapping, femnodes_mesh: Dict, force) -> Optional[List[Tuple[str, Loads]]]:
    """FreeCAD's table of loads; None if a face has no group, if its elements' area is not that of the face within 1 %, or if
    the force is on something else than faces of the meshed part."""
    analysis = groups.analysis_of(force)
    mesh = next((member for member in analysis.Group if state.is_quad_mesh(member)), None) if analysis is not None else None
    if mesh is None or mesh.Shape is None or not femnodes_mesh:
        return None
    asked = shapes.pairs(force.References)
    try:
        names = shapes.references_to_names(mesh.Shape.Shape, mesh.Shape, force.References)
    except Error:
        return None
    if len(names) != len(asked) or not names or not all(name.startswith("Face") for name in names):
        return None
    shells = (femelement_table.shells(femnodes_mesh) if isinstance(femelement_table, ElementTable)
              else arrays.shells_of(femmesh, femnodes_mesh))
    if shells is None:
        return None
    areas = [mesh.Shape.Shape.getElement(name).Area for name in names]
    quantity = hasattr(force.Force, "getValueAs")  # from FreeCAD 0.21 on
    newtons = float(force.Force.getValueAs("N")) if quantity else force.Force
    table = []
    for name, area, (obj, asked_name) in zip(names, areas, asked):
        found = np.array(groups.elements_in(femmesh, name), dtype=int)
        if not found.size or not np.isin(found, shells.elements).all():
            return None
        nodes, shares = _areas(shells, np.asarray(np.searchsorted(shells.elements, found)))
        if not 0.99 < shares.sum() / area < 1.01:
            return None
        table.append((f"node loads on shape: {obj.Name}:{asked_name}",
                      Loads(nodes, shares * (newtons / sum(areas)), Units.Quantity(1.0) if quantity else 1.0, shells)))
    return table


#: The triangles whose areas FreeCAD sums for an element, as positions in its list of nodes, by its number of nodes.
_TRIANGLES = {4: ((0, 1, 2), (0, 2, 3)),
              8: ((0, 4, 7), (4, 1, 5), (5, 2, 6), (6, 3, 7), (4, 6, 7), (4, 5, 6))}
#: The share of an element's area that each node has.
_SHARES = {4: (1 / 4,) * 4, 8: (-1 / 12,) * 4 + (1 / 3,) * 4}


def _areas(shells: Shells, elements: np.ndarray) -> Tuple[np.ndarray, np.ndarray]:
    """The nodes of elements (ids, ascending), and the part of the elements' area that belongs to each node."""
    places = shells.places(shells.corners[elements])
    size = places.shape[1]
    area = sum((_triangle(shells.points, places[:, triangle]) for triangle in _TRIANGLES[size]), np.zeros(len(places)))
    shares = np.bincount(places.ravel(), (area[:, None] * np.array(_SHARES[size])).ravel(), len(shells.nodes))
    used = np.zeros(len(shells.nodes), dtype=bool)
    used[places] = True
    return shells.nodes[used], shares[used]


def _triangle(points: np.ndarray, corners: np.ndarray) -> np.ndarray:
    a, b, c = (points[corners[:, position]] for position in range(3))
    return np.linalg.norm(np.cross(b - a, c - a), axis=1) / 2
