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

#: The stages in their order, with their share of the time.
_STAGES = {"read": 5, "size": 5, "sample": 5, "triangulate": 20, "color": 5, "recombine": 10, "improve": 35,
           "assemble": 10, "write": 5}
_POLL_MILLISECONDS = 50
SUGGESTED_QUADS = 5000


_MAX_DEAD_WRAPPERS = 16


def _length_box(name: str, tip: str):
    # FreeCAD may make the widget at the address of one that is gone, and PySide then gives that one's dead wrapper:
    # another widget has another address.
    loader = FreeCADGui.UiLoader()
    for attempt in range(_MAX_DEAD_WRAPPERS + 1):
        box = loader.createWidget("Gui::QuantitySpinBox")
        try:
            box.setObjectName(name)
            break
        except RuntimeError:
            if attempt == _MAX_DEAD_WRAPPERS:
                raise
    box.setProperty("unit", "mm")
    box.setProperty("minimum", 0.0)
    box.setToolTip(tip)
    return box


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
        self.size = _length_box("QuadrilleSize", "Target edge length; 0 = a sixtieth of the part's diagonal")
        self.suggest = QtGui.QPushButton("Suggest")
        self.suggest.setObjectName("QuadrilleSuggest")
        self.suggest.setToolTip(f"The size that gives about {SUGGESTED_QUADS} elements")
        self.size_min = _length_box("QuadrilleSizeMin", "No size goes below this; 0 = size / 8")
        self.per_circle = QtGui.QDoubleSpinBox()
        self.per_circle.setRange(0, 1000)
        self.per_circle.setDecimals(0)
        self.per_circle.setToolTip("Elements on a full circle of curvature; 0 = curvature is ignored")
        self.growth = QtGui.QDoubleSpinBox()
        self.growth.setRange(0.01, 10)
        self.growth.setSingleStep(0.1)
        self.growth.setToolTip("Largest growth of the size per length")
        self.order = QtGui.QComboBox()
        self.order.setObjectName("QuadrilleOrder")
        self.order.addItems(self.mesh.getEnumerationsOfProperty("ElementOrder"))
        self.order.setToolTip("1st: four-node quads (S4); 2nd: eight-node quads (S8), better for shells")
        self.strategy = QtGui.QComboBox()
        self.strategy.addItems(self.mesh.getEnumerationsOfProperty("Strategy"))
        self.strategy.setToolTip("How triangles become quads")
        self.faces = QtGui.QLineEdit()
        self.faces.setObjectName("QuadrilleFaces")
        self.faces.setPlaceholderText("all faces")
        self.faces.setToolTip("Faces to mesh, such as Face1, Face7; empty = all")
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
        settings.addRow("Size", _beside(self.size, self.suggest))
        settings.addRow("Minimum", self.size_min)
        settings.addRow("Per circle", self.per_circle)
        settings.addRow("Growth", self.growth)
        settings.addRow("Order", self.order)
        settings.addRow("Strategy", self.strategy)
        settings.addRow("Faces", _beside(self.faces, self.take_selection))
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
        self.size.valueChanged.connect(lambda *_: self._update_estimate())
        self.size_min.valueChanged.connect(lambda *_: self._update_estimate())
        self.per_circle.valueChanged.connect(lambda *_: self._update_estimate())
        self.growth.valueChanged.connect(lambda *_: self._update_estimate())
        self.faces.textChanged.connect(lambda *_: self._update_estimate())

    def _load(self) -> None:
        self.size.setProperty("rawValue", self.mesh.Size.Value)
        self.size_min.setProperty("rawValue", self.mesh.SizeMin.Value)
        self.per_circle.setValue(self.mesh.ElementsPerCircle)
        self.growth.setValue(self.mesh.Growth)
        self.order.setCurrentText(self.mesh.ElementOrder)
        self.strategy.setCurrentText(self.mesh.Strategy)
        self.faces.setText(", ".join(self.mesh.Faces))
        self.surfaces.setChecked(all(getattr(solver, solvers.SURFACE_RESULTS) for solver in self._solvers()))

    def _solvers(self) -> list:
        return solvers.solvers_of(groups.analysis_of(self.mesh))

    def _face_names(self) -> list:
        return [name.strip() for name in self.faces.text().split(",") if name.strip()]

    def _store(self) -> None:
        """Writes the settings that were changed into the object, as one step of undo."""
        mesh = self.mesh
        wanted = {
            "Size": float(self.size.property("rawValue")),
            "SizeMin": float(self.size_min.property("rawValue")),
            "ElementsPerCircle": self.per_circle.value(),
            "Growth": self.growth.value(),
            "ElementOrder": self.order.currentText(),
            "Strategy": self.strategy.currentText(),
            "Faces": self._face_names(),
        }
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
        size = float(self.size.property("rawValue")) or self.mesh.Shape.Shape.BoundBox.DiagonalLength / 60
        try:
            sizes = core.sizes_wanted(self.mesh)
        except Error as error:
            self.estimate.setText(str(error))
            return
        count = self._estimate.quads(size, float(self.size_min.property("rawValue")) or None,
                                     self.per_circle.value(), sizes, self._face_names(), self.growth.value())
        self.estimate.setText(f"about {_rounded(count)} quads")

    def _suggest(self) -> None:
        if self._estimate is not None:
            self.size.setProperty("rawValue", self._estimate.suggested(SUGGESTED_QUADS, self.per_circle.value()))

    def _take_selection(self) -> None:
        selection = FreeCADGui.Selection.getSelectionEx(self._document_name, 0)
        names = [name for name in picks.elements_of(self.mesh.Shape, picks.picks_of(selection))
                 if name.startswith("Face")]
        if not names:
            tell(f"Select faces of {self.mesh.Shape.Label} in the 3-D view first.")
            return
        self.faces.setText(", ".join(names))

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
            self.bar.setValue(_percent(stage, fraction))
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


def _percent(stage: str, fraction: float) -> int:
    done = 0.0
    for name, share in _STAGES.items():
        if name == stage:
            return round(done + share * fraction)
        done += share
    return 0


def _rounded(count: int) -> str:
    if count < 100:
        return str(count)
    digits = len(str(count)) - 2
    return f"{round(count, -digits):,}".replace(",", " ")
