# SPDX-License-Identifier: GPL-3.0-or-later
"""The type of elements in CalculiX's input: S4 and S8, which FreeCAD writes, are replaced by the type of a mesh object, with
the sections and supports that it needs. Runs inside FreeCAD."""

import re
from pathlib import Path
from typing import List, Optional

import numpy as np

from ..core import arrays
from ..core.errors import translate
from ..core.setting_table import BY_NAME

#: Types with which CalculiX 2.20 finds a strip 3.5 times too soft (M3D8) and singular (M3D8R).
_WRONG = ("M3D8", "M3D8R")
#: The types that a mesh object can have, of those of `--element`. With "shell", quads are S4, at second order S8R or S8.
SHELL, *OTHERS = (name for name in BY_NAME["element"]["choices"] if name not in _WRONG)
#: How far a node may be from the plane z = 0, or behind the axis, as a share of the diagonal.
_TOLERANCE = 1e-5
_OWN_TYPE = re.compile(rb"TYPE=(?:S|M3D|CPS|CPE|CAX)[48]R?,")
_SECTION = re.compile(rb"\*(?:SHELL|SOLID) SECTION,([^\n]*)\n(?:([^*\n][^\n]*)\n)?")
_SUPPORTS = re.compile(rb"(?m)^\*BOUNDARY[^\n]*\n(?:[^*\n][^\n]*\n)+")
_ROTATIONS, _OUT_OF_PLANE = re.compile(rb"(?m)^[^,\n]+,[456](?:,[^\n]*)?\n"), re.compile(rb"(?m)^[^,\n]+,[3456](?:,[^\n]*)?\n")


def element_of(mesh) -> str:
    """The type of a mesh object; "shell" for mesh objects that are not Quadrille's."""
    return mesh.Element if "ReducedShells" in mesh.PropertiesList else SHELL


def is_shell(mesh) -> bool:
    """True for a mesh of shell elements, whose stresses differ through the thickness."""
    return element_of(mesh)[0].upper() == "S"


def lies_in_plane(element: str) -> bool:
    """True for elements that solvers take only in the plane z = 0."""
    return element[:3] in ("CPS", "CPE", "CAX")


def problem_of(mesh) -> str:
    """Why CalculiX cannot use the mesh with its object's element type, as a sentence; empty if it can."""
    element = element_of(mesh)
    if element == SHELL:
        return ""
    shells = arrays.shells_of(mesh.FemMesh)
    if shells is None:
        return ""  # no mesh yet, or not one of quads alone: it stays as FreeCAD writes it
    nodes = int(element.rstrip("R")[-1])
    if shells.corners.shape[1] != nodes:
        needs = translate("Quadrille", "{}: Element {} needs a mesh of second order: set its order, and mesh again") if nodes == 8 else \
            translate("Quadrille", "{}: Element {} needs a mesh of first order: set its order, and mesh again")
        return needs.format(mesh.Label, element)
    return _problem_in_plane(mesh.Label, element, shells) if lies_in_plane(element) else ""


def _problem_in_plane(label: str, element: str, shells: arrays.Shells) -> str:
    points = shells.points
    tolerance = _TOLERANCE * float(np.linalg.norm(points.max(axis=0) - points.min(axis=0)))
    off = float(np.abs(points[:, 2]).max())
    if off > tolerance:
        return translate("Quadrille", "{}: Element {} needs a part in the plane z = 0, and this one leaves it by {} mm: move or rotate it "
                         "there").format(label, element, f"{off:.4g}")
    if element.startswith("CAX") and points[:, 0].min() < -tolerance:
        return translate("Quadrille", "{}: Element {} has the y axis as its axis of symmetry, and the part reaches to x = {} mm: move it to "
                         "positive x").format(label, element, f"{points[:, 0].min():.4g}")
    return ""


def counter_clockwise(shells: arrays.Shells) -> arrays.Shells:
    """The same mesh with elements counter-clockwise as seen from +z, as plane and axisymmetric elements must be."""
    x, y = (shells.points[shells.places(shells.corners[:, :4]), axis] for axis in (0, 1))
    area = (x * np.roll(y, -1, axis=1) - np.roll(x, -1, axis=1) * y).sum(axis=1)
    corners = shells.corners.copy()
    turned = [0, 3, 2, 1, 7, 6, 5, 4][:corners.shape[1]]
    corners[area < 0] = corners[area < 0][:, turned]
    return shells._replace(corners=corners)


def follow(path, element: str, reduced: bool, offset: float) -> List[str]:
    """Edits an input file of CalculiX: the type of quads, and what sections and supports it needs; shell sections get an offset,
    in thicknesses. Returns what was changed, in parts of a sentence.

    Args:
        reduced: with "shell", whether S8 shells become S8R.
    """
    text = before = Path(path).read_bytes()  # as text this would take ten times as long
    told = []
    if element != SHELL:
        text, count = _OWN_TYPE.subn(f"TYPE={element},".encode(), text)
        text = _with_section(text, element)
        told += [translate("Quadrille", "elements are written as {} (its property Element)").format(element)] * bool(count)
    elif reduced and b"TYPE=S8," in text:
        text = text.replace(b"TYPE=S8,", b"TYPE=S8R,")
        told.append(translate("Quadrille", "shells are written as S8R, which is better than S8 where they are thin (its property "
                              "ReducedShells)"))
    if offset and b"*SHELL SECTION," in text:
        text = text.replace(b"*SHELL SECTION,", f"*SHELL SECTION, OFFSET={offset:g},".encode())
        told.append(translate("Quadrille", "shells are written with the offset {} (its property ShellOffset)").format(f"{offset:g}"))
    if text != before:
        Path(path).write_bytes(text)
    return told


def _with_section(text: bytes, element: str) -> bytes:
    """The text with the sections of an element type, and without supports of directions that its nodes do not have."""
    card = _card_of(element)
    if card is None:
        return text
    thick = not element.startswith("CAX")

    def section(found) -> bytes:
        thickness = found.group(2)
        return card + found.group(1) + b"\n" + (thickness + b"\n" if thick and thickness else b"")

    free = _OUT_OF_PLANE if lies_in_plane(element) else _ROTATIONS
    return _SUPPORTS.sub(lambda found: free.sub(b"", found.group(0)), _SECTION.sub(section, text))


def _card_of(element: str) -> Optional[bytes]:
    """The card of a type's section; None for shells, which keep FreeCAD's."""
    if lies_in_plane(element):
        return b"*SOLID SECTION,"
    return b"*MEMBRANE SECTION," if element.startswith("M3D") else None
