# SPDX-License-Identifier: GPL-3.0-or-later
"""Forces on whole faces, for FreeCAD's CalculiX writer. FreeCAD looks for the elements of a face by the distance of every
node, and adds up areas element by element: 20 s for 100 000 quads. Where the mesh has the group of the face, its elements
are taken, and the areas are added up by NumPy. Runs inside FreeCAD."""

import functools
from typing import Dict, List, Sequence, Tuple

import numpy as np

from . import groups, shapes, state
from .errors import Error

#: The names in the meshed part of the faces that FreeCAD is about to ask for, in its order.
_asked_for: List[str] = []


def noting_faces(function):
    """Remembers which faces a force is on: the function that searches gets their shapes alone."""

    @functools.wraps(function)
    def get_force_obj_face_nodeload_table(femmesh, femelement_table, femnodes_mesh, frc_obj):
        _asked_for[:] = _names(frc_obj)
        try:
            return function(femmesh, femelement_table, femnodes_mesh, frc_obj)
        finally:
            _asked_for.clear()

    return get_force_obj_face_nodeload_table


def _names(force) -> List[str]:
    """The names, one for each reference; none where they cannot all be told."""
    analysis = groups.analysis_of(force)
    mesh = next((member for member in analysis.Group if state.is_quad_mesh(member)), None) if analysis is not None else None
    if mesh is None or mesh.Shape is None:
        return []
    try:
        names = shapes.references_to_names(mesh.Shape.Shape, mesh.Shape, force.References)
    except Error:
        return []
    wanted = sum(1 if isinstance(elements, str) else len(elements) for _, elements in force.References)
    return names if len(names) == wanted else []


def from_group(function):
    """The elements of a face with their nodes, from the face's group, or by a search."""

    @functools.wraps(function)
    def get_ref_facenodes_table(femmesh, femelement_table, ref_face):
        name = _asked_for.pop(0) if _asked_for else ""
        found = groups.elements_in(femmesh, name) if name and not femmesh.VolumeCount else ()
        if not found:
            return function(femmesh, femelement_table, ref_face)
        return {element: femelement_table[element] for element in sorted(found)}

    return get_ref_facenodes_table


def by_numpy(function):
    """The same areas for meshes of quads, one entry a node."""

    @functools.wraps(function)
    def get_ref_facenodes_areas(femnodes_mesh, face_table):
        sizes = set(map(len, face_table.values()))
        if not femnodes_mesh or len(sizes) != 1 or not sizes <= {4, 8}:
            return function(femnodes_mesh, face_table)
        return _areas(femnodes_mesh, face_table, sizes.pop())

    return get_ref_facenodes_areas


#: The triangles whose areas FreeCAD adds up, as positions in an element, by its number of nodes.
_TRIANGLES = {4: ((0, 1, 2), (0, 2, 3)),
              8: ((0, 4, 7), (4, 1, 5), (5, 2, 6), (6, 3, 7), (4, 6, 7), (4, 5, 6))}
#: The share of an element's area that each node has.
_SHARES = {4: (1 / 4,) * 4, 8: (-1 / 12,) * 4 + (1 / 3,) * 4}


def _areas(femnodes_mesh: Dict, face_table: Dict, size: int) -> List[Tuple[int, float]]:
    elements = np.array(list(face_table.values()), dtype=int).reshape(-1, size)
    ids, places = np.unique(elements, return_inverse=True)
    points = np.array([tuple(femnodes_mesh[node]) for node in ids.tolist()])
    places = places.reshape(-1, size)
    corners = points[places]
    area = sum(_triangle(corners, triangle) for triangle in _TRIANGLES[size])
    shares = (area[:, None] * np.array(_SHARES[size])).ravel()
    return list(zip(ids.tolist(), np.bincount(places.ravel(), shares).tolist()))


def _triangle(corners, triangle: Sequence[int]):
    a, b, c = (corners[:, position] for position in triangle)
    return np.linalg.norm(np.cross(b - a, c - a), axis=1) / 2
