# SPDX-License-Identifier: GPL-3.0-or-later
"""Converts what users pick to parts, and to faces, edges and vertices of the meshed part. Runs inside FreeCAD, also without a
window.

A click on a PartDesign Body picks its topmost feature, and faces are named by feature (`Pocket.Face9`). A click inside a Part
container names the container first. A pick is followed from the outermost object inward: the first object with its own shape
is the part. So a Body stays the part when features are added to it. A container's shape, which holds all that is in it, counts only
if nothing inside was picked. A pick on a mesh means the part's element there, see on_mesh()."""

import re
from typing import Any, Dict, Iterable, List, Sequence, Tuple

import FreeCAD
import numpy as np

from ..core.arrays import faces_of, nodes_of
from ..core.errors import Error
from . import groups, shapes, state, translate

#: The outermost object, and the path inside it of what is picked: (Body, "Pocket.Face9"), or (Box, "") for the whole object.
Pick = Tuple[Any, str]


def picks_of(selection) -> List[Pick]:
    """The picks in a selection returned by FreeCADGui.Selection.getSelectionEx(document, 0)."""
    return [(entry.Object, _plain(name)) for entry in selection for name in (entry.SubElementNames or ("",))]


def _plain(name: str) -> str:
    """The name without the history that FreeCAD 1.0 puts into it: `Pocket.;#16:2;:H8dc,F.Face3` becomes `Pocket.Face3`."""
    return re.sub(r"(^|\.);.*\.", r"\1", name)


def part_of(pick: Pick):
    """The part that a pick lies in."""
    path = along(pick)
    for obj in path:
        inside = obj is not path[-1] and obj.isDerivedFrom("App::Part")
        if state.is_quad_mesh(obj) or not inside and hasattr(getattr(obj, "Shape", None), "Faces"):
            return obj
    return path[-1]


def parts_of(picks: Iterable[Pick]) -> List:
    """The picked parts, each once."""
    parts: List = []
    for pick in picks:
        part = part_of(pick)
        if part not in parts:
            parts.append(part)
    return parts


def elements_of(part, picks: Iterable[Pick]) -> List[str]:
    """The names in a part's shape ("Face3") of the faces, edges and vertices picked on it, each once. Picks on other parts and
    of whole objects are ignored. Raises Error if the part's shape no longer has a picked element."""
    names: List[str] = []
    for pick in picks:
        path = along(pick)
        element = pick[1].split(".")[-1]
        if not element or part not in path and not _is_mesh_of(part, path[-1]):
            continue
        name = element
        if path[-1] != part and part in path:
            inner = ".".join(pick[1].split(".")[path.index(part) - len(path):])
            found = shapes.find_element(part.Shape, part.getSubObject(inner))
            if found is None:
                raise Error(translate(
                    "Quadrille", "{}: {} is no longer on its surface").format(part.Label, pick[1]), "usage", pick[1])
            name = found
        if name not in names:
            names.append(name)
    return names


def points_of(part, picks: Iterable[Pick]) -> Dict[str, Tuple[float, float, float]]:
    """The places of picked vertices, of the part or of other objects, and of picked objects that are points, such as Part's points
    and datum points, in the coordinates of the part's shape. By name: that of the point object, else Node1, Node2, ..."""
    found: Dict[str, Tuple[float, float, float]] = {}
    for pick in picks:
        obj, element = along(pick)[-1], pick[1].split(".")[-1]
        if state.is_quad_mesh(obj) and obj.Shape != part:
            obj = state.part_of(obj)
        shape = getattr(obj, "Shape", None)
        if part in along(pick) or _is_mesh_of(part, obj):
            names = [name for name in elements_of(part, [pick]) if name.startswith("Vertex")]
            points = [part.Shape.getElement(name).Point for name in names]
        elif shape is None:
            continue
        elif element.startswith("Vertex"):
            points = [_moved(shape.getElement(element).Point, obj, part)]
        else:
            points = [_moved(vertex.Point, obj, part) for vertex in getattr(shape, "Vertexes", ())]
            if len(points) != 1 or shape.Edges:
                continue
        for x, y, z in points:
            number = next(number for number in range(1, len(found) + 2) if f"Node{number}" not in found)
            found[f"Node{number}" if element or part in along(pick) else obj.Name] = (x, y, z)
    return found


def _moved(point, obj, part):
    """A point of an object's shape in the coordinates of the part's shape, which may lie in another container."""
    return placement_of(part).inverse().multVec(placement_of(obj).multVec(point))


def placement_of(obj):
    """Where the container of an object lies: takes the coordinates of its shape or mesh to global ones."""
    container = obj.getParentGeoFeatureGroup()
    return container.getGlobalPlacement() if container is not None else FreeCAD.Placement()


def references_on(part, picks: Sequence[Pick]) -> List[Tuple]:
    """Picks as FEM references: those on the part with its own element names, others as they were picked."""
    references: List[Tuple] = []
    names = elements_of(part, picks)
    if names:
        references.append((part, tuple(names)))
    for pick in picks:
        path = along(pick)
        element = pick[1].split(".")[-1]
        if element and part not in path and not _is_mesh_of(part, path[-1]):
            references.append((path[-1], (element,)))
    return references


def along(pick: Pick) -> List:
    """The objects along a pick, from the outermost inward."""
    obj, path = pick
    return list(obj.getSubObjectList(path)) if path else [obj]


def _is_mesh_of(part, obj) -> bool:
    return state.is_quad_mesh(obj) and obj.Shape == part


# Picks on meshes

#: The statuses of a mesh whose faces, edges and vertices may not be those of the part.
OTHER_PART = (state.PART_CHANGED, state.BOTH_CHANGED, state.PART_GONE, state.LOST, state.OTHER_MEANS)
#: How close to a side or a corner of an element a pick means the edge or the vertex there, relative to the mean side length.
_NEAR_EDGE, _NEAR_VERTEX = 0.2, 0.25
#: Elements whose distance to a pick is measured: those with the nearest circumscribed spheres.
_CANDIDATES = 60


def on_mesh(mesh, point: Sequence[float]) -> str:
    """The name of the part's face, edge or vertex that a mesh has at a point, in global coordinates. Empty if it has none there.
    FreeCAD 0.20 names elements other than those that were clicked, so it is found by the point. Raises Error if the part has
    changed since it was meshed."""
    if mesh.Status in OTHER_PART:
        raise Error(translate(
            "Quadrille", "{}: {}; until then, pick its faces, edges and vertices on the part").format(
                mesh.Label, translate("QuadrilleStatus", mesh.Status)), "usage",
                    mesh.Name)
    element, quad, ends, at = _nearest(mesh, point)
    if not element:
        return ""
    unit = float(np.linalg.norm(np.roll(quad, -1, axis=0) - quad, axis=1).mean())
    part_groups = groups.PartGroups(mesh.FemMesh)
    to_corners = np.linalg.norm(quad - at, axis=1)
    if to_corners.min() < _NEAR_VERTEX * unit:
        name = part_groups.vertex_at(int(ends[to_corners.argmin()]))
        if name:
            return name
    for first, last in ((0, 1), (1, 2), (2, 3), (3, 0)):
        if _distance_to_side(quad[first], quad[last], at) < _NEAR_EDGE * unit:
            name = part_groups.edge_along(int(ends[first]), int(ends[last]))
            if name:
                return name
    return part_groups.face_of(element)


def element_at(mesh, point: Sequence[float]) -> int:
    """The id of the quad that a mesh has at a point, in global coordinates; 0 if it has none."""
    return _nearest(mesh, point)[0]


def _nearest(mesh, point: Sequence[float]) -> Tuple[int, np.ndarray, np.ndarray, np.ndarray]:
    """The id of the quad nearest to a point in global coordinates, its corners and their nodes, and the point in the coordinates of
    the mesh. The id is 0 if there are no quads."""
    fem_mesh = mesh.FemMesh
    ids, sizes, flat = faces_of(fem_mesh)
    at = np.array(tuple(placement_of(mesh).inverse().multVec(FreeCAD.Vector(*point))))
    if not ids.size:
        return 0, np.zeros((0, 3)), np.zeros(0, int), at
    numbers, places = nodes_of(fem_mesh)
    points = np.zeros((numbers.max() + 1, 3))
    points[numbers] = places
    nodes = flat[(np.cumsum(sizes) - sizes)[:, None] + np.arange(4)]  # the corners of the quads
    corners = points[nodes]
    centers = corners.mean(axis=1)
    reach = np.linalg.norm(centers - at, axis=1) - np.linalg.norm(corners - centers[:, None], axis=2).max(axis=1)
    near = np.argsort(reach, kind="stable")[:_CANDIDATES]
    element = near[np.argmin([_distance_to_quad(corners[index], at) for index in near])]
    return int(ids[element]), corners[element], nodes[element], at


def _distance_to_quad(quad: np.ndarray, at: np.ndarray) -> float:
    """The distance from a point to a quad, roughly: to the nearest of many points on it."""
    share = np.linspace(0, 1, 9)
    u, v = (grid.reshape(-1, 1) for grid in np.meshgrid(share, share))
    on = (1 - u) * (1 - v) * quad[0] + u * (1 - v) * quad[1] + u * v * quad[2] + (1 - u) * v * quad[3]
    return float(np.linalg.norm(on - at, axis=1).min())


def _distance_to_side(start: np.ndarray, end: np.ndarray, at: np.ndarray) -> float:
    along_side = end - start
    share = np.clip((at - start) @ along_side / max(along_side @ along_side, 1e-300), 0, 1)
    return float(np.linalg.norm(start + share * along_side - at))
