# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes nodes and elements of CalculiX's input as FreeCAD does, in a third of the time: FreeCAD passes each line to the system
separately, 400 000 lines for 100 000 quads. Runs inside FreeCAD."""

import functools
from collections.abc import Mapping
from itertools import chain
from typing import Any, Callable, Dict, Optional

import numpy as np

from ..core import arrays
from . import element_types

#: Number of lines formatted at once.
_PIECE = 2000


def rows(line: str, *columns: np.ndarray) -> str:
    """Formats one line of text per row. `line`: a %-format for one row; `columns`: arrays of equal length."""
    text = []
    for start in range(0, len(columns[0]), _PIECE):
        piece = [column[start:start + _PIECE].tolist() for column in columns]
        text.append(line * len(piece[0]) % tuple(chain.from_iterable(zip(*piece))))
    return "".join(text)


class Later(Mapping):
    """A dictionary that is made when it is first accessed; its length is known before."""

    def __init__(self, make: Callable[[], dict], length: int) -> None:
        self._make, self._length = make, length

    @functools.cached_property
    def _table(self) -> dict:
        return self._make()

    def __getitem__(self, key):
        return self._table[key]

    def __iter__(self):
        return iter(self._table)

    def __len__(self):
        return self._length

    def values(self):
        """The values; quicker than Mapping's, which looks up each key."""
        return self._table.values()


class ElementTable(Later):
    """FreeCAD's table of each element's nodes, for a shell mesh, and the same data as arrays."""

    def __init__(self, make: Callable[[], dict], fem_mesh) -> None:
        super().__init__(make, fem_mesh.FaceCount)
        self._fem_mesh = fem_mesh
        self._shells: Optional[arrays.Shells] = None

    def shells(self, nodes: Dict) -> Optional[arrays.Shells]:
        """The mesh as arrays; None if it has other elements than quads. `nodes`: its nodes in FreeCAD's form."""
        if self._shells is None:
            self._shells = arrays.shells_of(self._fem_mesh, nodes)
        return self._shells


def nodes_later(function):
    """Wraps FreeCAD's maker of the table of nodes: for a shell mesh the table is made when it is needed. FreeCAD 1.1 makes it
    twice for each input."""

    @functools.wraps(function)
    def _load_tables(self):
        fem_mesh: Any = getattr(self, "femmesh", None)
        if fem_mesh is not None and not self.femnodes_mesh and fem_mesh.FaceCount and not fem_mesh.VolumeCount:
            self.femnodes_mesh = Later(lambda: fem_mesh.Nodes, fem_mesh.NodeCount)
        function(self)

    return _load_tables


def of_shells(function):
    """Wraps FreeCAD's maker of the table of elements: for a shell mesh the table is made when it is needed."""

    @functools.wraps(function)
    def get_femelement_table(femmesh):
        if femmesh.VolumeCount or not femmesh.FaceCount:
            return function(femmesh)
        return ElementTable(lambda: function(femmesh), femmesh)

    return get_femelement_table


def at_once(function):
    """Wraps FreeCAD's writer of the mesh in CalculiX's input: a mesh object of this addon is written fast."""

    @functools.wraps(function)
    def write_mesh(ccxwriter):
        mesh = getattr(ccxwriter, "mesh_object", None)
        if mesh is None or "ReducedShells" not in mesh.PropertiesList:
            return function(ccxwriter)
        own = ccxwriter.femmesh
        ccxwriter.femmesh = _Written(own, _shells_of_loads(ccxwriter), element_types.element_of(mesh))
        try:
            return function(ccxwriter)
        finally:
            ccxwriter.femmesh = own

    return write_mesh


def _shells_of_loads(ccxwriter) -> Optional[arrays.Shells]:
    """The mesh as arrays, if it was already made to find the loads of forces; else None."""
    for entry in ccxwriter.member.cons_force:
        for _, loads in entry.get("NodeLoadTable", ()):
            if hasattr(loads, "shells"):
                return loads.shells
    return None


class _Written:
    """A FEM mesh that is written fast if possible, otherwise by FreeCAD."""

    def __init__(self, fem_mesh, shells: Optional[arrays.Shells], element: str) -> None:
        self._fem_mesh, self._shells, self._element = fem_mesh, shells, element

    def __getattr__(self, name):
        return getattr(self._fem_mesh, name)

    def writeABAQUS(self, path, element_param, group_param, *variants, **options) -> None:
        """Replaces FreeCAD's function, which is called for other kinds of elements. FreeCAD 1.0 and later passes options."""
        shells = None
        as_shells = not variants and options.get("faceVariant", "shell") == "shell"
        if (element_param, group_param) == (1, False) and (as_shells or self._element != element_types.SHELL):
            shells = self._shells or arrays.shells_of(self._fem_mesh)
        if shells is None:
            self._fem_mesh.writeABAQUS(path, element_param, group_param, *variants, **options)
            return
        if element_types.lies_in_plane(self._element):
            shells = element_types.counter_clockwise(shells)
        with open(path, "w", encoding="ascii", newline="\n") as file:
            file.write(text_of(shells))


def text_of(shells: arrays.Shells) -> str:
    """The text that FreeCAD writes for a mesh of shells."""
    count = shells.corners.shape[1]
    return "".join((
        "** written by FreeCAD inp file writer for CalculiX,Abaqus meshes\n** highest dimension mesh elements only.\n\n"
        "** Nodes\n*Node, NSET=Nall\n", rows("%d, %.13g, %.13g, %.13g\n", shells.nodes, *shells.points.T),
        f"\n\n** Face elements\n*Element, TYPE=S{count}, ELSET=Efaces\n",
        rows(", ".join(["%d"] * (count + 1)) + "\n", shells.elements, *shells.corners.T),
        "\n** Define element set Eall\n*ELSET, ELSET=Eall\nEfaces\n"))
