# SPDX-License-Identifier: GPL-3.0-or-later
"""The task panel of a mesh object: settings, estimate, Mesh and Stop, progress, result.

The mesher is a child process that a timer looks after: FreeCAD stays usable meanwhile. The process class is that of
scripts (command.MeshJob), so that windows and scripts cannot differ in what they run.
"""

import time
from typing import Optional

import FreeCAD
import FreeCADGui
from PySide import QtCore, QtGui

from .. import freecad as core
from .. import groups, picks, shapes, solvers
from ..errors import Error
from . import icon, tell
from .quality_view import QualityWidget
from .setting_widgets import setting_widgets

_POLL_MILLISECONDS = 50
SUGGESTED_QUADS = 5000


class MeshPanel:
    """Edits and meshes one mesh object."""

    def __init__(self, mesh) -> None:
        self.mesh = mesh
        self._document_name, self._name = mesh.Document.Name, mesh.Name
        self._job: Optional[core.ShapeJob] = None
        self._started = 0.0
        self._estimate: Optional[shapes.SizeEstimate] = None
        self._build()
        self._load()
        self._timer = QtCore.QTimer()  # not the form's: it must outlive a form that FreeCAD deletes
        self._timer.setInterval(_POLL_MILLISECONDS)
        self._timer.timeout.connect(self._poll)
        self.form.destroyed.connect(self._form_gone)
        FreeCAD.addDocumentObserver(self)
        self._observing = True
        try:
            self._estimate = shapes.SizeEstimate(mesh.Shape.Shape)
        except (AttributeError, RuntimeError) as error:  # a part without a shape, or one that cannot be measured
            self.estimate.setText(f"no estimate: {error}")
        self._update_estimate()

    # What the panel is made of

    def _build(self) -> None:
        self.form = QtGui.QWidget()
        self.form.setWindowTitle("Quad mesh")
        self.form.setWindowIcon(QtGui.QIcon(icon("quadrille_mesh")))
        self.settings = setting_widgets(self.mesh)
        self.suggest = QtGui.QPushButton("Suggest")
        self.suggest.setObjectName("QuadrilleSuggest")
        self.suggest.setToolTip(f"The size that gives about {SUGGESTED_QUADS} elements")
        self.take_selection = QtGui.QPushButton("Take selection")
        self.take_selection.setObjectName("QuadrilleTakeSelection")
        self.take_selection.setToolTip("Mesh only the faces that are selected in the 3-D view")
        self.surfaces = QtGui.QCheckBox("Stresses at the shell's surfaces")
        self.surfaces.setObjectName("QuadrilleSurfaces")
        self.surfaces.setToolTip("CalculiX then gives results at the top and bottom of the shell, where bending stresses are, "
                                 "and not at its middle alone (the solver's property Beam Shell Result Output 3D)")
        self.estimate = QtGui.QLabel()
        self.estimate.setObjectName("QuadrilleEstimate")
        self.mesh_button = QtGui.QPushButton(QtGui.QIcon(icon("quadrille_mesh")), "Mesh")
        self.mesh_button.setObjectName("QuadrilleMesh")
        self.stop_button = QtGui.QPushButton("Cancel")
        self.stop_button.setObjectName("QuadrilleStop")
        self.stop_button.setEnabled(False)
        self.bar = QtGui.QProgressBar()
        self.bar.setObjectName("QuadrilleProgress")
        self.log = QtGui.QPlainTextEdit()
        self.log.setObjectName("QuadrilleLog")
        self.log.setReadOnly(True)
        self.log.setMaximumHeight(80)
        self.quality = QualityWidget(self.mesh)

        settings = QtGui.QFormLayout()
        settings.addRow("Part", QtGui.QLabel(self.mesh.Shape.Label))
        beside = {"Size": self.suggest, "Faces": self.take_selection}
        for name, setting in self.settings.items():
            settings.addRow(setting.label, _beside(setting.widget, beside[name]) if name in beside else setting.widget)
        if self._solvers():
            settings.addRow("Results", self.surfaces)
        settings.addRow("Expected", self.estimate)
        layout = QtGui.QVBoxLayout(self.form)
        layout.addLayout(settings)
        layout.addWidget(_beside(self.mesh_button, self.stop_button))
        layout.addWidget(self.bar)
        layout.addWidget(self.log)
        layout.addWidget(self.quality)
        layout.addStretch()
        self.suggest.clicked.connect(self._suggest)
        self.take_selection.clicked.connect(self._take_selection)
        self.mesh_button.clicked.connect(self._start)
        self.stop_button.clicked.connect(self._stop)
        for setting in self.settings.values():
            setting.when_changed(self._update_estimate)

    def _load(self) -> None:
        for name, setting in self.settings.items():
            setting.show(getattr(self.mesh, name))
        self.surfaces.setChecked(all(getattr(solver, solvers.SURFACE_RESULTS) for solver in self._solvers()))

    def _solvers(self) -> list:
        return solvers.solvers_of(groups.analysis_of(self.mesh))

    def _store(self) -> None:
        """Writes the settings that were changed into the object, as one step of undo."""
        mesh = self.mesh
        wanted = {name: setting.value() for name, setting in self.settings.items()}
        changes = {name: value for name, value in wanted.items()
                   if getattr(getattr(mesh, name), "Value", getattr(mesh, name)) != value}
        surfaces = self.surfaces.isChecked()
        others = [solver for solver in self._solvers() if getattr(solver, solvers.SURFACE_RESULTS) != surfaces]
        if not changes and not others:
            return
        mesh.Document.openTransaction("Quad mesh settings")
        for name, value in changes.items():
            FreeCADGui.doCommand(f"{_path(mesh)}.{name} = {value!r}")
        for solver in others:
            FreeCADGui.doCommand(f"{_path(solver)}.{solvers.SURFACE_RESULTS} = {surfaces!r}")
        mesh.Document.commitTransaction()

    # Estimate

    def _update_estimate(self) -> None:
        if self._estimate is None:
            return
        wanted = {name: setting.value() for name, setting in self.settings.items()}
        size = wanted["Size"] or self.mesh.Shape.Shape.BoundBox.DiagonalLength / 60
        try:
            sizes = core.sizes_wanted(self.mesh)
        except Error as error:
            self.estimate.setText(str(error))
            return
        count = self._estimate.quads(size, wanted["SizeMin"] or None, wanted["ElementsPerCircle"], sizes, wanted["Faces"],
                                     wanted["Growth"])
        self.estimate.setText(f"about {_rounded(count)} quads")

    def _suggest(self) -> None:
        if self._estimate is not None:
            per_circle = self.settings["ElementsPerCircle"].value()
            self.settings["Size"].show(self._estimate.suggested(SUGGESTED_QUADS, per_circle))

    def _take_selection(self) -> None:
        selection = FreeCADGui.Selection.getSelectionEx(self._document_name, 0)
        names = [name for name in picks.elements_of(self.mesh.Shape, picks.picks_of(selection))
                 if name.startswith("Face")]
        if not names:
            tell(f"Select faces of {self.mesh.Shape.Label} in the 3-D view first.")
            return
        self.settings["Faces"].show(names)

    # Meshing

    def _start(self) -> None:
        if self._job is not None:
            return
        self.log.clear()
        try:
            self._store()
            self._job = core.start(self.mesh)
        except Error as error:
            self._say(f"error: {error}")
            tell(str(error))
            return
        self._started = time.monotonic()
        self.bar.setValue(0)
        self.mesh_button.setEnabled(False)
        self.stop_button.setEnabled(True)
        self._say("meshing")
        self._timer.start()

    def _poll(self) -> None:
        if self._job is None:
            self._timer.stop()
            return
        for stage, fraction in self._job.poll():
            self.bar.setValue(round(100 * fraction))
            self.bar.setFormat(f"{stage} %p %")
        if self._job.running:
            return
        self._end()

    def _end(self) -> None:
        """Takes the result of a job that has ended."""
        job, self._job = self._job, None
        self._timer.stop()
        self.mesh_button.setEnabled(True)
        self.stop_button.setEnabled(False)
        document = self.mesh.Document
        ended = time.monotonic()
        document.openTransaction("Quad mesh")
        try:
            core.finish(self.mesh, job)
        except Error as error:
            document.abortTransaction()
            self.bar.setValue(0)
            self._say(f"error: {error}" if error.kind != "cancelled" else str(error))
            if error.kind != "cancelled":
                tell(str(error))
            return
        document.commitTransaction()
        for line in job.messages:
            self._say(line)
        self.bar.setFormat("%p %")
        self.bar.setValue(100)
        self._say(f"{self.mesh.QuadCount} quads: mesher {ended - self._started:.2f} s, "
                  f"into FreeCAD {time.monotonic() - ended:.2f} s")
        self.mesh.ViewObject.show()
        self.mesh.Shape.ViewObject.hide()
        self.quality.refresh()

    def _stop(self) -> None:
        if self._job is not None:
            self._job.cancel()

    def _say(self, text: str) -> None:
        self.log.appendPlainText(text)

    # The panel's own life

    def getStandardButtons(self) -> int:
        """Close alone: Mesh and Cancel are in the panel."""
        return int(QtGui.QDialogButtonBox.Close)

    def reject(self) -> bool:
        """Close: keeps the settings, ends the mesher."""
        if self._job is not None:
            self._stop()
            self._end()
        self._store()
        self.quality.release()
        self._leave()
        FreeCADGui.getDocument(self._document_name).resetEdit()
        self.mesh.Document.recompute()
        return True

    def _leave(self) -> None:
        self._timer.stop()
        if self._observing:
            self._observing = False
            FreeCAD.removeDocumentObserver(self)

    def _abandon(self) -> None:
        """The mesh object or its document goes away: ends the mesher and the panel."""
        job, self._job = self._job, None
        if job is not None:
            job.cancel()
            core.forget(self._document_name, self._name)
        self._leave()
        # Not from inside FreeCAD's notification.
        QtCore.QTimer.singleShot(0, FreeCADGui.Control.closeDialog)

    def _form_gone(self, *_) -> None:
        """FreeCAD has closed the panel by itself: nobody is left to take the mesh."""
        job, self._job = self._job, None
        if job is not None:
            job.cancel()
            core.forget(self._document_name, self._name)
        self._leave()

    def slotDeletedDocument(self, document) -> None:
        """FreeCAD calls this before a document closes."""
        if document.Name == self._document_name:
            self._abandon()

    def slotDeletedObject(self, obj) -> None:
        """FreeCAD calls this before an object is deleted (or its making undone)."""
        if obj.Name == self._name and obj.Document.Name == self._document_name:
            self._abandon()


def _beside(*widgets):
    row = QtGui.QWidget()
    layout = QtGui.QHBoxLayout(row)
    layout.setContentsMargins(0, 0, 0, 0)
    for widget in widgets:
        layout.addWidget(widget)
    return row


def _path(obj) -> str:
    return f"App.getDocument({obj.Document.Name!r}).getObject({obj.Name!r})"


def _rounded(count: int) -> str:
    if count < 100:
        return str(count)
    digits = len(str(count)) - 2
    return f"{round(count, -digits):,}".replace(",", " ")
