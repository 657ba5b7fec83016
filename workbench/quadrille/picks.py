# SPDX-License-Identifier: GPL-3.0-or-later
"""What users pick, as parts and as faces, edges and vertices of the meshed part. Runs inside FreeCAD, without a window too.

A click on a PartDesign Body picks the feature on top of it, and names its faces by the features that made them
(`Pocket.Face9`); a click on something inside a Part container names the container first. What is picked is followed from
the outermost object inward: the first one with a shape of its own is the part, so that a Body stays the part when
features are added to it."""

import re
from typing import Iterable, List, Sequence, Tuple

from . import shapes
from .errors import Error

#: An outermost object and the path of what is picked in it, such as (Body, "Pocket.Face9"), or (Box, "") for all of it.
Pick = Tuple[object, str]


def picks_of(selection) -> List[Pick]:
    """The picks of a selection that FreeCADGui.Selection.getSelectionEx(document, 0) gave."""
    return [(entry.Object, _plain(name)) for entry in selection for name in (entry.SubElementNames or ("",))]


def _plain(name: str) -> str:
    """Without what FreeCAD 1.0 calls an element by its history: `Pocket.;#16:2;:H8dc,F.Face3` is `Pocket.Face3`."""
    return re.sub(r"(^|\.);.*\.", r"\1", name)


def part_of(pick: Pick):
    """The part that a pick lies in."""
    for obj in along(pick):
        if hasattr(getattr(obj, "Shape", None), "Faces"):
            return obj
    return pick[0]


def parts_of(picks: Iterable[Pick]) -> List:
    """The parts that are picked, each once."""
    parts: List = []
    for pick in picks:
        part = part_of(pick)
        if part not in parts:
            parts.append(part)
    return parts


def elements_of(part, picks: Iterable[Pick]) -> List[str]:
    """The names in a part's shape ("Face3") of the faces, edges and vertices that are picked on it, each once. Picks on
    other parts and of whole objects are passed over. Raises Error when the part's shape has no such element any more."""
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
    """FEM references: those on the part by its own names, others as they were picked."""
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
    """The objects from the outermost inward."""
    obj, path = pick
    return list(obj.getSubObjectList(path)) if path else [obj]
