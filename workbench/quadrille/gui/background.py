# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs of the mesher that go on after OK in their panel: a bar and Stop in the status line.

The mesh is stored when no panel is open and no undo step is being made, which storing it would end. A panel that is opened
again takes its run back."""

from typing import Dict, Optional, Tuple

import FreeCAD
import FreeCADGui
from PySide import QtCore, QtGui

from ..core.errors import Error
from ..features import mesh_object as core
from . import do, path_of, tell, tell_briefly, transaction, translate
from .stages import words_of

_POLL_MILLISECONDS = 50
#: The runs, by the names of document and mesh object.
_runs: Dict[Tuple[str, str], "_Run"] = {}


def go_on(mesh, job: core.ShapeJob) -> None:
    """Lets a run go on without its panel; the document has its settings."""
    _runs[mesh.Document.Name, mesh.Name] = _Run(mesh, job)


def take_back(mesh) -> Optional[core.ShapeJob]:
    """The run of a mesh object, which then belongs to the caller; None if there is none."""
    run = _runs.get((mesh.Document.Name, mesh.Name))
    return run.leave() if run is not None else None


def store(mesh, job: core.ShapeJob) -> None:
    """Stores the mesh of a run that has succeeded, so that macros record it."""
    core.hand_over(mesh, job)
    do("import quadrille.freecad")
    do(f"quadrille.freecad.remesh({path_of(mesh)})")


def show(mesh) -> None:
    """Shows a mesh instead of its part."""
    mesh.ViewObject.show()
    if mesh.Shape is not None:  # None if it was deleted while the mesher worked
        mesh.Shape.ViewObject.hide()


class _Run:
    """One run, with its part of the status line."""

    def __init__(self, mesh, job: core.ShapeJob) -> None:
        self._mesh, self._job = mesh, job
        self._key = (mesh.Document.Name, mesh.Name)
        self._line = QtGui.QWidget()
        self._bar = QtGui.QProgressBar()
        self._bar.setObjectName("QuadrilleBackground")
        self._bar.setMinimumWidth(260)
        stop = QtGui.QPushButton(translate("Quadrille", "Stop"))
        stop.setObjectName("QuadrilleBackgroundStop")
        stop.clicked.connect(self._stop)
        row = QtGui.QHBoxLayout(self._line)
        row.setContentsMargins(0, 0, 0, 0)
        row.addWidget(self._bar)
        row.addWidget(stop)
        FreeCADGui.getMainWindow().statusBar().addPermanentWidget(self._line)
        self._show(translate("Quadrille", "meshing"), 0)
        self._timer = QtCore.QTimer()
        self._timer.setInterval(_POLL_MILLISECONDS)
        self._timer.timeout.connect(self._poll)
        self._timer.start()
        FreeCAD.addDocumentObserver(self)

    def leave(self) -> core.ShapeJob:
        """Clears the status line; the job goes on."""
        del _runs[self._key]
        self._timer.stop()
        FreeCAD.removeDocumentObserver(self)
        FreeCADGui.getMainWindow().statusBar().removeWidget(self._line)
        self._line.setParent(None)
        self._line.deleteLater()
        return self._job

    def _show(self, stage: str, fraction: float) -> None:
        self._bar.setValue(round(100 * fraction))
        self._bar.setFormat(f"{self._mesh.Label}: {words_of(stage)} %p %")

    def _stop(self, *_) -> None:
        if self._job.running:
            self._job.cancel()  # the next poll finds it ended
        else:
            self._abandon()  # its mesh waits to be stored

    def _poll(self) -> None:
        for stage, fraction in self._job.poll():
            self._show(stage, fraction)
        if self._job.running:
            return
        document = self._mesh.Document
        if FreeCADGui.Control.activeDialog() or document.HasPendingTransaction or document.Recomputing:
            self._show(translate("Quadrille", "waits until the open panel or command has ended"), 1)
            return
        self.leave()
        try:
            self._job.result()
            with transaction(document, "Quad mesh"):
                store(self._mesh, self._job)
        except Error as error:
            core.forget(*self._key)
            if error.kind != "cancelled":
                tell(f"{self._mesh.Label}: {error}")
            return
        show(self._mesh)
        text = translate("Quadrille", "{}: {} quads").format(self._mesh.Label, self._mesh.QuadCount)
        FreeCAD.Console.PrintMessage("\n".join((text, *self._job.messages)) + "\n")
        tell_briefly(text)

    def _abandon(self) -> None:
        """Ends the run, without a result."""
        self.leave().cancel()
        core.forget(*self._key)

    def slotDeletedObject(self, obj) -> None:
        """FreeCAD calls this before an object is deleted (or its creation is undone)."""
        if (obj.Document.Name, obj.Name) == self._key:
            self._abandon()

    def slotDeletedDocument(self, document) -> None:
        """FreeCAD calls this before a document closes."""
        if document.Name == self._key[0]:
            self._abandon()
