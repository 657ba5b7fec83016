# SPDX-License-Identifier: GPL-3.0-or-later
"""Converts what users pick to parts, and to faces, edges and vertices of the meshed part. Runs inside FreeCAD, also without a
window.

A click on a PartDesign Body picks its topmost feature, and faces are named by feature (`Pocket.Face9`). A click inside a Part
container names the container first. A pick is followed from the outermost object inward: the first object with its own shape
is the part. So a Body stays the part when features are added to it."""

import re
from typing import Iterable, List, Sequence, Tuple

from ..core.errors import Error
from . import shapes

#: The outermost object, and the path inside it of what is picked: (Body, "Pocket.Face9"), or (Box, "") for the whole object.
Pick = Tuple[object, str]


def picks_of(selection) -> List[Pick]:
    """The picks in a selection returned by FreeCADGui.Selection.getSelectionEx(document, 0)."""
    return [(entry.Object, _plain(name)) for entry in selection for name in (entry.SubElementNames or ("",))]


def _plain(name: str) -> str:
    """The name without the history that FreeCAD 1.0 puts into it: `Pocket.;#16:2;:H8dc,F.Face3` becomes `Pocket.Face3`."""
    return re.sub(r"(^|\.);.*\.", r"\1", name)


def part_of(pick: Pick):
    """The part that a pick lies in."""
    for obj in along(pick):
        if hasattr(getattr(obj, "Shape", None), "Faces"):
            return obj
    return pick[0]


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
        if part not in path or not element:
            continue
        name = element
        if path[-1] != part:
            inner = ".".join(pick[1].split(".")[path.index(part) - len(path):])
            name = shapes.find_element(part.Shape, part.getSubObject(inner))
            if name is None:
                raise Error(f"{part.Label}: {pick[1]} is not on its surface any more", "usage", pick[1])
        if name not in names:
            names.append(name)
    return names


def references_on(part, picks: Sequence[Pick]) -> List[Tuple]:
    """Picks as FEM references: those on the part with its own element names, others as they were picked."""
    references: List[Tuple] = []
    names = elements_of(part, picks)
    if names:
        references.append((part, tuple(names)))
    for pick in picks:
        path = along(pick)
        element = pick[1].split(".")[-1]
        if element and part not in path:
            references.append((path[-1], (element,)))
    return references


def along(pick: Pick) -> List:
    """The objects along a pick, from the outermost inward."""
    obj, path = pick
    return list(obj.getSubObjectList(path)) if path else [obj]
