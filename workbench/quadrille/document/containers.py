# SPDX-License-Identifier: GPL-3.0-or-later
"""Containers and compounds of several solids: whether these touch, and which of them are hidden. Runs inside FreeCAD, also without a
window."""

import time
from itertools import combinations
from typing import Dict, List, Set

from . import shapes

#: Seconds after which looking for solids that touch ends.
_PATIENCE = 2.0
#: Distance of solids that count as touching, as a share of the diagonal.
_TOUCH = 1e-7


def touching_solids(shape) -> int:
    """The number of solids of a shape that touch or cross others with which they share no face."""
    solids = shape.Solids
    if len(solids) < 2:
        return 0
    reach, end = _TOUCH * shape.BoundBox.DiagonalLength, time.monotonic() + _PATIENCE
    boxes = [solid.BoundBox for solid in solids]
    for box in boxes:
        box.enlarge(reach)
    faces = [{face.hashCode() for face in solid.Faces} for solid in solids]
    found: Set[int] = set()
    for one, other in combinations(range(len(solids)), 2):
        if {one, other} <= found or not boxes[one].intersect(boxes[other]) or faces[one] & faces[other]:
            continue
        if time.monotonic() > end:
            break
        if solids[one].distToShape(solids[other])[0] <= reach:
            found |= {one, other}
    return len(found)


def hidden_solids(container) -> List:
    """The hidden solids in a container, at any depth, which its shape leaves out; not those of which others are made."""
    found = []
    for child in getattr(container, "Group", ()) if container.isDerivedFrom("App::Part") else ():
        is_used = any(hasattr(user, "Shape") and not user.isDerivedFrom("App::Part") and not user.isDerivedFrom("Fem::FemMeshObject")
                      for user in child.InList)
        if child.isDerivedFrom("App::Part"):
            found += hidden_solids(child)
        elif not is_used and not child.Visibility and getattr(getattr(child, "Shape", None), "Solids", None):
            found.append(child)
    return found


def common_container(parts):
    """The container (App::Part) that all parts are in; None if there is none, or not the same."""
    around = {part.getParentGeoFeatureGroup() for part in parts}
    container = around.pop()
    return container if not around and container is not None and container.isDerivedFrom("App::Part") else None


def faces_by_part(whole) -> Dict[str, List[str]]:
    """The faces ("Face3") of each object in a container or compound, by its label; empty for other objects and None, and where the
    solids are not those of its objects one after the other."""
    if whole is None:
        return {}
    is_container = whole.isDerivedFrom("App::Part")
    children = [child for child in (whole.Group if is_container else getattr(whole, "Links", ()))
                if (child.Visibility or not is_container) and getattr(getattr(child, "Shape", None), "Solids", None)]
    owners = [child.Label for child in children for _ in child.Shape.Solids]
    solids = shapes.faces_of_solids(whole.Shape) if len(children) > 1 else []
    found: Dict[str, List[str]] = {}
    for label, faces in zip(owners, solids) if len(owners) == len(solids) else ():
        found.setdefault(label, []).extend(faces)
    return found
