# SPDX-License-Identifier: GPL-3.0-or-later
"""Shows the quality of a mesh: table, histogram, criteria, colors in the 3-D view, and a list of the worst elements."""

from typing import Callable, Optional, Sequence

import FemGui
import FreeCADGui
import numpy as np
from PySide import QtCore, QtGui

from ..core import quality
from ..core.units import digits
from ..document import groups
from ..solvers import checklist
from . import QT_TRANSLATE_NOOP, camera, do, drawn_icon, overlays, path_of, standard_buttons, transaction, translate
from .element_view import Ball, ElementView
from .findings_table import FindingsTable, kept_with
from .histogram import Histogram
from .tables import fill, table
from .wheel import calm

#: What is missing before a mesh can be solved, by the names of the checks.
MISSING = {
    "analysis": QT_TRANSLATE_NOOP("Quadrille", "the mesh is not in an analysis: drag it into one in the tree"),
    "active": QT_TRANSLATE_NOOP("Quadrille", "its analysis is not the active one: double-click it"),
    "material": QT_TRANSLATE_NOOP("Quadrille", "the analysis has no material"),
    "thickness": QT_TRANSLATE_NOOP("Quadrille", "the analysis has no shell thickness (Model > Element geometry)"),
    "pieces": QT_TRANSLATE_NOOP("Quadrille", "the mesh is in pieces that share no nodes: Imprint or Sew joins parts that touch"),
    "surfaces": QT_TRANSLATE_NOOP("Quadrille", "stresses come from the middle of the shell only: tick Stresses at the surfaces"),
}
WORST = 20
BINS = 20
#: Delay before the elements are measured for histogram, criteria and worst elements, so that the mesh is drawn first.
MEASURE_AFTER_MILLISECONDS = 100


#: The names of the quality measures, for users.
MEASURES = {
    "q": QT_TRANSLATE_NOOP("Quadrille", "q"),
    "aspect": QT_TRANSLATE_NOOP("Quadrille", "Aspect"),
    "warp": QT_TRANSLATE_NOOP("Quadrille", "Warp"),
    "skew": QT_TRANSLATE_NOOP("Quadrille", "Skew"),
    "angle_min": QT_TRANSLATE_NOOP("Quadrille", "Smallest angle"),
    "angle_max": QT_TRANSLATE_NOOP("Quadrille", "Largest angle"),
    "jacobian_ratio": QT_TRANSLATE_NOOP("Quadrille", "Jacobian ratio"),
    "taper": QT_TRANSLATE_NOOP("Quadrille", "Taper"),
    "min_length": QT_TRANSLATE_NOOP("Quadrille", "Shortest side"),
}


class QualityWidget(QtGui.QWidget):
    """The quality of one mesh object. The first table shows the mesher's numbers; the rest is measured here."""

    def __init__(self, mesh, refine: Callable[[Ball], None], keep: Callable[[Sequence[str], bool], Sequence[str]]) -> None:
        """refine: called with a place that the user wants finer. keep: adds faces and edges to those to keep, or takes them away, and
        returns all of them."""
        super().__init__()
        self.mesh = mesh
        self._measured: Optional[quality.ElementQuality] = None
        self._timer = QtCore.QTimer(self)
        self._timer.setSingleShot(True)
        self._timer.setInterval(MEASURE_AFTER_MILLISECONDS)
        self._timer.timeout.connect(self.fill_elements)
        self.status = QtGui.QLabel()
        self.status.setObjectName("QuadrilleStatus")
        self.status.setWordWrap(True)
        self.ready = QtGui.QLabel()
        self.ready.setObjectName("QuadrilleReady")
        self.ready.setWordWrap(True)
        self.findings = FindingsTable(mesh, self._show_poor, lambda names, on: self.findings.show_kept(keep(names, on)))
        self.table = table("QuadrilleQualityTable", 2)
        self.table.horizontalHeader().setVisible(False)
        self.criteria = table("QuadrilleCriteria", 4)
        self.criteria.setHorizontalHeaderLabels([
            translate("Quadrille", "Criterion"), translate("Quadrille", "Fail"), translate("Quadrille", "Worst"),
            translate("Quadrille", "Mean")])
        self.histogram = Histogram(self.criteria)
        self.measure = QtGui.QComboBox()
        self.measure.setObjectName("QuadrilleMeasure")
        self.measure.setSizePolicy(QtGui.QSizePolicy.Ignored, QtGui.QSizePolicy.Fixed)
        for name, text in MEASURES.items():
            self.measure.addItem(translate("Quadrille", text), name)
        self.measure.currentIndexChanged.connect(self._another_measure)
        self.color = QtGui.QCheckBox(translate("Quadrille", "Color the mesh"))
        self.color.setObjectName("QuadrilleColor")
        self.color.setToolTip(translate("Quadrille", "Blue is good, red is bad; for a criterion, yellow is at its limit"))
        self.color.toggled.connect(self._color)
        self.free = QtGui.QCheckBox(translate("Quadrille", "Show free sides"))
        self.free.setObjectName("QuadrilleFree")
        self.free.setToolTip(translate("Quadrille", "Sides of one element only, and nodes at the same place"))
        self.free.toggled.connect(self._show_free)
        self.worst_title = QtGui.QLabel(translate("Quadrille", "Worst elements (click on one)"))
        self.worst = QtGui.QListWidget()
        self.worst.setWordWrap(True)
        self.worst.setHorizontalScrollBarPolicy(QtCore.Qt.ScrollBarAlwaysOff)
        self.worst.setObjectName("QuadrilleWorst")
        self.worst.setMaximumHeight(120)
        self.worst.currentRowChanged.connect(self._show_element)
        self.element = ElementView(mesh, self.measured, refine)
        self.criteria.cellClicked.connect(self._show_criterion)
        layout = QtGui.QVBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        by = QtGui.QHBoxLayout()
        by.addWidget(self.color)
        by.addWidget(self.measure, 1)
        layout.addWidget(self.status)
        layout.addWidget(self.findings)
        layout.addWidget(self.ready)
        layout.addWidget(self.table)
        layout.addWidget(self.histogram)
        layout.addWidget(self.criteria)
        layout.addLayout(by)
        layout.addWidget(self.free)
        layout.addWidget(self.worst_title)
        layout.addWidget(self.worst)
        layout.addWidget(self.element)
        self.refresh()

    def refresh(self) -> None:
        """Fills the table at once and the rest a moment later. Hides the widget if there is no mesh."""
        self._measured = None
        self._timer.stop()
        self.worst.clear()
        self.element.forget()
        self.criteria.setRowCount(0)
        self.ready.setVisible(False)
        self.setVisible(self.mesh.FemMesh.FaceCount > 0)
        for widget in (self.histogram, self.criteria, self.worst_title, self.worst):  # until they have something to show
            widget.setVisible(False)
        if not self.mesh.FemMesh.FaceCount:
            return
        overlays.hide(self.mesh, overlays.ELEMENT)
        self._filltable()
        self._timer.start()
        if self.color.isChecked():
            self._color(True)
        if self.free.isChecked():
            self._show_free(True)

    def measured(self) -> quality.ElementQuality:
        """The quality of each element, measured at the first call."""
        if self._measured is None:
            self._measured = quality.measure(self.mesh.FemMesh, self.mesh.LeastSize, self.mesh.FinerQuads)
        return self._measured

    def _filltable(self) -> None:
        mesh = self.mesh
        fill(self.table, (
            (translate("Quadrille", "Quads"), f"{mesh.QuadCount}"),
            (translate("Quadrille", "Nodes"), f"{mesh.NodeCount}"),
            (translate("Quadrille", "q: smallest, mean"), f"{mesh.WorstQuality:.3f}, {mesh.MeanQuality:.3f}"),
            (translate("Quadrille", "Jacobian"), f"{mesh.WorstJacobian:.3f}, {mesh.MeanJacobian:.3f}"),
            (translate("Quadrille", "Irregular nodes"), f"{digits(round(mesh.IrregularPercent, 2))} %"),
            (translate("Quadrille", "Outside limits"), f"{digits(round(mesh.OutsidePercent, 2))} %"),
            (translate("Quadrille", "Mesher's time"), f"{digits(round(mesh.Seconds, 2))} s"),
        ))
        outside = 5  # row
        self.table.item(outside, 0).setToolTip(translate("Quadrille", "Without warp and short sides, which the table below counts"))
        self.show_status(mesh.Status)
        self.findings.refresh()
        if self.mesh.ViewObject is not None:
            overlays.show_crossed(self.mesh)

    def show_status(self, status: str) -> None:
        """Shows a status, one of those that the property Status has."""
        self.status.setText(translate("QuadrilleStatus", status))

    def _show_poor(self, name: str) -> bool:
        """Zooms to the worst quad on an edge or face. False if there is none."""
        measured, nodes = self.measured(), np.array(sorted(groups.PartGroups(self.mesh.FemMesh).nodes(name)), int)
        there = np.flatnonzero(np.isin(measured.nodes, nodes).sum(axis=1) >= (2 if name.startswith("Edge") else 4))
        if not there.size:
            return False
        goodness = np.min([measured.goodness(criterion)[there] for criterion in measured.limits if criterion != "warp"], axis=0)
        self._show_index(int(there[goodness.argmin()]))
        return True

    def _show_index(self, index: int) -> None:
        show_element(self.mesh, self.measured(), index)
        self.element.show_element(index)

    def fill_elements(self) -> None:
        """Measures each element, for the histogram, the criteria and the worst ones."""
        try:
            measured = self.measured()
        except ReferenceError:  # the object or its document was deleted
            return
        if not measured.ids.size:  # the mesh has been undone
            return
        for widget in (self.histogram, self.criteria, self.worst_title, self.worst):
            widget.setVisible(True)
        self.histogram.show_values(measured.q, BINS)
        rows = []
        for name, (ideal, limit) in measured.limits.items():
            values = measured.criteria[name]
            worst = values.max() if limit > ideal else values.min()
            told = f"{limit:.2g}" if name == "min_length" else f"{limit:g}"
            rows.append((f"{translate('Quadrille', MEASURES[name])} {'≤' if limit > ideal else '≥'} {told}",
                         f"{int(measured.fails(name).sum())}", f"{worst:.3g}", f"{values.mean():.2g}"))
        fill(self.criteria, rows)
        self._tell_what_is_missing()
        self._list_worst()

    def _tell_what_is_missing(self) -> None:
        """Shows what is missing in a document with an analysis before this mesh can be solved."""
        self.ready.setVisible(any(obj.isDerivedFrom("Fem::FemAnalysis") for obj in self.mesh.Document.Objects))
        if not self.ready.isVisibleTo(self):
            return
        missing = [translate("Quadrille", MISSING[check.name]) for check in checklist.checks(self.mesh, FemGui.getActiveAnalysis())
                   if not check.passed]
        self.ready.setText(translate("Quadrille", "Missing before solving: {}").format("; ".join(missing)) if missing
                           else translate("Quadrille", "Nothing is missing before solving"))

    def _list_worst(self) -> None:
        measured, measure = self.measured(), self.measure.itemData(self.measure.currentIndex())
        values = measured.q if measure == "q" else measured.criteria[measure]
        self.worst.blockSignals(True)
        self.worst.clear()
        for index in measured.worst(WORST, measure):
            forced = self.element.forced_by(index)
            text = f"{measured.ids[index]}, {self.element.face_of(index)}: {translate('Quadrille', MEASURES[measure])} {digits(values[index])}"
            self.worst.addItem(f"{text}, {translate('Quadrille', 'forced by {}').format(forced)}" if forced else text)
        self.worst.blockSignals(False)

    def _another_measure(self, _index: int) -> None:
        if not self.mesh.FemMesh.FaceCount:
            return
        self._list_worst()
        if self.color.isChecked():
            self._color(True)

    def _color(self, on: bool) -> None:
        if self.mesh.ViewObject is None:
            return
        if on and self.mesh.FemMesh.FaceCount:
            overlays.show_quality(self.mesh, self.measured(), self.measure.itemData(self.measure.currentIndex()))
        else:
            overlays.hide(self.mesh, overlays.QUALITY)

    def _show_free(self, on: bool) -> None:
        if on and self.mesh.FemMesh.FaceCount:
            overlays.show_free(self.mesh, self.measured())
        else:
            overlays.hide(self.mesh, overlays.FREE)

    def _show_element(self, row: int) -> None:
        if row < 0 or not self.mesh.FemMesh.FaceCount:
            return
        worst = self.measured().worst(WORST, self.measure.itemData(self.measure.currentIndex()))
        self._show_index(int(worst[row]))

    def _show_criterion(self, row: int, _column: int = 0) -> None:
        """Lists and colors the elements by the criterion that was clicked."""
        self.measure.setCurrentIndex(self.measure.findData(list(self.measured().limits)[row]))
        self.color.setChecked(True)

    def release(self) -> None:
        """Removes colors and highlights from the view, and stops measuring."""
        self._timer.stop()
        self.element.release()
        self.findings.release()
        try:
            if self.mesh.ViewObject is not None:
                for kind in (overlays.QUALITY, overlays.ELEMENT, overlays.FREE, overlays.CROSSED, overlays.MARKS):
                    overlays.hide(self.mesh, kind)
        except ReferenceError:  # the object or its document was deleted
            pass


def show_element(mesh, measured: quality.ElementQuality, index: int) -> None:
    """Draws a frame around an element and moves the camera in front of it."""
    overlays.frame_element(mesh, measured, index)
    camera.look_at(mesh, measured.centers[index], 12 * float(measured.lengths[index]), measured.normals[index])


class QualityPanel:
    """The task panel of the command Mesh quality."""

    def __init__(self, mesh) -> None:
        self.quality = QualityWidget(mesh, self._refine, self._keep)
        self._mesh = mesh
        self.form = self.quality
        calm(self.form)
        self.form.setWindowTitle(translate("Quadrille", "Quality of {}").format(mesh.Label))
        self.form.setWindowIcon(drawn_icon("quadrille_quality"))
        self.quality.color.setChecked(True)

    def _refine(self, ball: Ball) -> None:
        """Adds a size at a place, which the next meshing follows."""
        others = [entry for entry in self._mesh.SizeIn if entry.rpartition("=")[0] != ball.place]
        self._set("Refine quad mesh", "SizeIn", [*others, f"{ball.place}={digits(ball.size)}"])

    def _keep(self, names: Sequence[str], on: bool) -> Sequence[str]:
        """Adds faces and edges to those that the next meshing keeps, or takes them away."""
        self._set("Keep features", "Keep", kept_with(self._mesh.Keep, names, on))
        return self._mesh.Keep

    def _set(self, step: str, name: str, entries: Sequence[str]) -> None:
        with transaction(self._mesh.Document, step):
            do(f"{path_of(self._mesh)}.{name} = {entries!r}")
            self._mesh.Document.recompute()

    def getStandardButtons(self):
        """Only Close."""
        return standard_buttons("Close")

    def reject(self) -> bool:
        """Called on Close."""
        self.quality.release()
        FreeCADGui.Control.closeDialog()
        return True
