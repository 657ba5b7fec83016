# SPDX-License-Identifier: GPL-3.0-or-later
"""Records what a task panel does to a document, so that Cancel can undo all of it."""

from contextlib import contextmanager
from typing import Any, Dict, List

from ..document import links, state, undo
from ..document.regions import refine
from . import transaction


class Session:
    """The time from the opening of a mesh object's panel to its closing."""

    def __init__(self, mesh, made_by: str = "") -> None:
        """made_by: the name of the undo step that has just made the mesh object; empty if the object existed before."""
        self._mesh, self._name, self._document = mesh, mesh.Name, mesh.Document
        self.made_by = made_by
        self._own: List[str] = [made_by] if made_by else []  # names of the undo steps made, the last one first
        self._whole = bool(self._document.UndoMode)  # whether FreeCAD still has all of these steps
        self._before: Dict[str, Any] = {name: getattr(mesh, name) for name in mesh.PropertiesList if _is_ours(mesh, name)}
        self._regions = state.wanted_of(mesh).refinements
        undo.hold(mesh)

    @contextmanager
    def step(self, name: str):
        """Makes one undo step."""
        count = self._document.UndoCount
        with transaction(self._document, name):
            yield
        self._own.insert(0, name)
        self._whole = self._whole and self._document.UndoCount == count + 1

    def keep(self) -> None:
        """For OK: keeps all changes."""
        undo.release(self._document, self._name)

    def take_back(self) -> None:
        """For Cancel: restores the mesh object as it was before, or removes it if it was just made."""
        undo.release(self._document, self._name)
        if not self._own:
            return
        if self._whole and list(self._document.UndoNames[:len(self._own)]) == self._own:
            for _ in self._own:
                self._document.undo()
            return
        # There was other work in between, which must stay.
        with transaction(self._document, "Cancel quad mesh"):
            self._restore()

    def _restore(self) -> None:
        mesh, document = self._mesh, self._document
        if self.made_by:
            for region in mesh.MeshRegionList:
                document.removeObject(region.Name)
            document.removeObject(mesh.Name)
            return
        for region in list(mesh.MeshRegionList):
            if region.Name not in {entry.region for entry in self._regions}:
                document.removeObject(region.Name)
        links_too = mesh.Shape is not None  # a part that was deleted cannot be linked to
        if links_too:
            self._restore_regions()
        for name, value in self._before.items():
            if name != "MeshRegionList" and (links_too or name not in ("Shape", *links.OWN)):
                setattr(mesh, name, value)
        undo.bring_back(mesh)

    def _restore_regions(self) -> None:
        for name, references, size in self._regions:
            region = self._document.getObject(name)
            if region is None:
                refine(self._mesh, references, size)
            else:
                region.CharacteristicLength = size


def _is_ours(mesh, name: str) -> bool:
    return mesh.getGroupOfProperty(name) in ("Mesh", "Result", "Hidden", "Solve")
