# SPDX-License-Identifier: GPL-3.0-or-later
"""Nodes and elements in the input of CalculiX, as FreeCAD writes them, in a third of the time: FreeCAD hands each line to the
system on its own, 400 000 for 100 000 quads. Runs inside FreeCAD."""

import functools
from collections.abc import Mapping
from itertools import chain
from typing import Callable, Dict, Optional

import numpy as np

from . import arrays

#: Lines that are made at once.
_PIECE = 2000


def rows(line: str, *columns: np.ndarray) -> str:
    """A line of text for each row of columns."""
    text = []
    for start in range(0, len(columns[0]), _PIECE):
        piece = [column[start:start + _PIECE].tolist() for column in columns]
        text.append(line * len(piece[0]) % tuple(chain.from_iterable(zip(*piece))))
    return "".join(text)


class Later(Mapping):
    """A table that is made when it is first looked into."""

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
        """Quicker than one by one."""
        return self._table.values()


class ElementTable(Later):
    """FreeCAD's table of the nodes of each element of a shell mesh, and the same as arrays."""

    def __init__(self, make: Callable[[], dict], fem_mesh) -> None:
        super().__init__(make, fem_mesh.FaceCount)
        self._fem_mesh = fem_mesh
        self._shells: Optional[arrays.Shells] = None

    def shells(self, nodes: Dict) -> Optional[arrays.Shells]:
        """The mesh, whose nodes are given as FreeCAD has them; None where it has other elements than quads."""
        if self._shells is None:
            self._shells = arrays.shells_of(self._fem_mesh, nodes)
        return self._shells


def nodes_later(function):
    """FreeCAD's table of nodes; of a shell mesh one that is made where it is needed. FreeCAD 1.1 makes it twice for each input."""

    @functools.wraps(function)
    def _load_tables(self):
        fem_mesh = getattr(self, "femmesh", None)
        if fem_mesh is not None and not self.femnodes_mesh and fem_mesh.FaceCount and not fem_mesh.VolumeCount:
            self.femnodes_mesh = Later(lambda: fem_mesh.Nodes, fem_mesh.NodeCount)
        function(self)

    return _load_tables


def of_shells(function):
    """FreeCAD's table of elements; of a shell mesh one that is made where it is needed."""

    @functools.wraps(function)
    def get_femelement_table(femmesh):
        if femmesh.VolumeCount or not femmesh.FaceCount:
            return function(femmesh)
        return ElementTable(lambda: function(femmesh), femmesh)

    return get_femelement_table


def at_once(function):
    """The mesh of a mesh object of ours, in the input of CalculiX."""

    @functools.wraps(function)
    def write_mesh(ccxwriter):
        mesh = getattr(ccxwriter, "mesh_object", None)
        if mesh is None or "ReducedShells" not in mesh.PropertiesList:
            return function(ccxwriter)
        own = ccxwriter.femmesh
        ccxwriter.femmesh = _Written(own, _shells_of_loads(ccxwriter))
        try:
            return function(ccxwriter)
        finally:
            ccxwriter.femmesh = own

    return write_mesh


def _shells_of_loads(ccxwriter) -> Optional[arrays.Shells]:
    """The mesh that forces were found on just before."""
    for entry in ccxwriter.member.cons_force:
        for _, loads in entry.get("NodeLoadTable", ()):
            if hasattr(loads, "shells"):
                return loads.shells
    return None


class _Written:
    """A FEM mesh that is written fast where it can be, and else as FreeCAD does."""

    def __init__(self, fem_mesh, shells: Optional[arrays.Shells]) -> None:
        self._fem_mesh, self._shells = fem_mesh, shells

    def __getattr__(self, name):
        return getattr(self._fem_mesh, name)

    def writeABAQUS(self, path, element_param, group_param, *variants, **options) -> None:
        """FreeCAD's, which knows other kinds of elements too; options are of 1.0 and later."""
        shells = None
        if (element_param, group_param) == (1, False) and not variants and options.get("faceVariant", "shell") == "shell":
            shells = self._shells or arrays.shells_of(self._fem_mesh)
        if shells is None:
            self._fem_mesh.writeABAQUS(path, element_param, group_param, *variants, **options)
            return
        with open(path, "w", encoding="ascii", newline="\n") as file:
            file.write(text_of(shells))


def text_of(shells: arrays.Shells) -> str:
    """What FreeCAD writes for a mesh of shells."""
    count = shells.corners.shape[1]
    return "".join((
        "** written by FreeCAD inp file writer for CalculiX,Abaqus meshes\n** highest dimension mesh elements only.\n\n"
        "** Nodes\n*Node, NSET=Nall\n", rows("%d, %.13g, %.13g, %.13g\n", shells.nodes, *shells.points.T),
        f"\n\n** Face elements\n*Element, TYPE=S{count}, ELSET=Efaces\n",
        rows(", ".join(["%d"] * (count + 1)) + "\n", shells.elements, *shells.corners.T),
        "\n** Define element set Eall\n*ELSET, ELSET=Eall\nEfaces\n"))
