# SPDX-License-Identifier: GPL-3.0-or-later
"""Quality of a mesh for the eye: table, histogram, colours in the 3-D view, the worst elements to jump to."""

from typing import Optional

import FreeCADGui
import numpy as np
from PySide import QtCore, QtGui

from .. import quality
from . import icon, overlays

WORST = 20
BINS = 20
#: Histogram and worst elements follow this much later, so that the mesh itself is drawn first.
MEASURE_AFTER_MILLISECONDS = 100


class QualityWidget(QtGui.QWidget):
    """The quality of one mesh object: numbers are the mesher's, elements are measured here."""

    def __init__(self, mesh, parent=None) -> None:
        super().__init__(parent)
        self.mesh = mesh
        self._measured: Optional[quality.ElementQuality] = None
        self._timer = QtCore.QTimer(self)
        self._timer.setSingleShot(True)
        self._timer.setInterval(MEASURE_AFTER_MILLISECONDS)
        self._timer.timeout.connect(self.fill_elements)
        self.table = QtGui.QTableWidget(0, 2)
        self.table.setObjectName("QuadrilleQualityTable")
        self.table.horizontalHeader().setVisible(False)
        self.table.verticalHeader().setVisible(False)
        self.table.horizontalHeader().setStretchLastSection(True)
        self.table.setEditTriggers(QtGui.QAbstractItemView.NoEditTriggers)
        self.histogram = QtGui.QLabel()
        self.histogram.setObjectName("QuadrilleHistogram")
        self.colour = QtGui.QCheckBox("Colour the mesh by quality")
        self.colour.setObjectName("QuadrilleColour")
        self.colour.toggled.connect(self._colour)
        self.worst = QtGui.QListWidget()
        self.worst.setObjectName("QuadrilleWorst")
        self.worst.currentRowChanged.connect(self._show_element)
        layout = QtGui.QVBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.addWidget(self.table)
        layout.addWidget(self.histogram)
        layout.addWidget(self.colour)
        layout.addWidget(QtGui.QLabel(f"Worst {WORST} elements (click to see one)"))
        layout.addWidget(self.worst)
        self.refresh()

    def refresh(self) -> None:
        """Fills the table at once and the rest a moment later; hides itself when there is no mesh."""
        self._measured = None
        self._timer.stop()
        self.worst.clear()
        self.setVisible(self.mesh.FemMesh.FaceCount > 0)
        if not self.mesh.FemMesh.FaceCount:
            return
        overlays.hide(self.mesh, overlays.ELEMENT)
        self._fill_table()
        self._timer.start()
        if self.colour.isChecked():
            self._colour(True)

    def measured(self) -> quality.ElementQuality:
        """The quality of each element, measured when first asked for."""
        if self._measured is None:
            self._measured = quality.measure(self.mesh.FemMesh)
        return self._measured

    def _fill_table(self) -> None:
        mesh = self.mesh
        rows = (
            ("Quads", f"{mesh.QuadCount}"),
            ("Nodes", f"{mesh.NodeCount}"),
            ("q, least and mean", f"{mesh.WorstQuality:.3f}, {mesh.MeanQuality:.3f}"),
            ("Jacobian, least and mean", f"{mesh.WorstJacobian:.3f}, {mesh.MeanJacobian:.3f}"),
            ("Aspect, largest", f"{mesh.LargestAspect:.2f}"),
            ("Irregular nodes", f"{mesh.IrregularPercent:.2f} %"),
            ("Outside the limits", f"{mesh.OutsidePercent:.2f} %"),
            ("Mesher's time", f"{mesh.Seconds:.2f} s"),
            ("Status", mesh.Status),
        )
        self.table.setRowCount(len(rows))
        for row, (name, text) in enumerate(rows):
            self.table.setItem(row, 0, QtGui.QTableWidgetItem(name))
            self.table.setItem(row, 1, QtGui.QTableWidgetItem(text))
            self.table.setRowHeight(row, 20)
        self.table.resizeColumnToContents(0)
        self.table.setFixedHeight(20 * len(rows) + 4)

    def fill_elements(self) -> None:
        """Measures each element, for the histogram and the worst ones."""
        try:
            measured = self.measured()
        except ReferenceError:  # the object or its document is gone
            return
        self.histogram.setPixmap(histogram_pixmap(np.histogram(measured.q, bins=BINS, range=(0.0, 1.0))[0]))
        self.worst.blockSignals(True)
        self.worst.clear()
        for index in measured.worst(WORST):
            self.worst.addItem(f"element {measured.ids[index]}: q {measured.q[index]:.3f}, "
                               f"scaled Jacobian {measured.scaled_jacobian[index]:.3f}")
        self.worst.blockSignals(False)
        self.worst.setMaximumHeight(120)

    def _colour(self, on: bool) -> None:
        if self.mesh.ViewObject is None:
            return
        if on and self.mesh.FemMesh.FaceCount:
            overlays.show_quality(self.mesh, self.measured())
        else:
            overlays.hide(self.mesh, overlays.QUALITY)

    def _show_element(self, row: int) -> None:
        if row < 0 or not self.mesh.FemMesh.FaceCount:
            return
        show_element(self.mesh, self.measured(), int(self.measured().worst(WORST)[row]))

    def release(self) -> None:
        """Takes colours and highlights out of the view; nothing is measured any more."""
        self._timer.stop()
        try:
            if self.mesh.ViewObject is not None:
                overlays.hide(self.mesh, overlays.QUALITY)
                overlays.hide(self.mesh, overlays.ELEMENT)
        except ReferenceError:  # the object or its document is gone
            pass


def show_element(mesh, measured: quality.ElementQuality, index: int) -> None:
    """Frames an element and moves the camera before it."""
    overlays.frame_element(mesh, measured, index)
    view = FreeCADGui.getDocument(mesh.Document.Name).ActiveView
    if not hasattr(view, "getCameraNode"):
        return
    from pivy import coin

    camera = view.getCameraNode()
    reach = 12 * float(measured.lengths[index])
    centre, normal = measured.centres[index], measured.normals[index]
    place = coin.SbVec3f(*(centre + reach * normal))
    camera.position.setValue(place)
    up = coin.SbVec3f(0, 0, 1) if abs(normal[2]) < 0.9 else coin.SbVec3f(0, 1, 0)
    camera.pointAt(coin.SbVec3f(*centre), up)
    camera.focalDistance.setValue(reach)
    if hasattr(camera, "height"):
        camera.height.setValue(reach)


def histogram_pixmap(counts: np.ndarray, width: int = 340, height: int = 150):
    """A histogram of q, counts in equal steps from 0 to 1, as a picture.

    Drawn by matplotlib without its Qt side, which need not fit FreeCAD's Qt.
    """
    try:
        from matplotlib.backends.backend_agg import FigureCanvasAgg
        from matplotlib.figure import Figure
    except ImportError:
        return QtGui.QPixmap()
    figure = Figure(figsize=(width / 100, height / 100), dpi=100)
    canvas = FigureCanvasAgg(figure)
    axes = figure.add_axes((0.14, 0.26, 0.83, 0.68))
    middles = (np.arange(len(counts)) + 0.5) / len(counts)
    axes.bar(middles, counts, width=1.0 / len(counts), color=quality.colours(middles), edgecolor="0.4", linewidth=0.5)
    axes.set_xlim(0, 1)
    axes.set_xlabel("q", fontsize=8)
    axes.set_ylabel("quads", fontsize=8)
    axes.tick_params(labelsize=7)
    if counts.max() > 0:
        axes.set_yscale("symlog")
    canvas.draw()
    buffer = bytes(canvas.buffer_rgba())
    columns, rows = canvas.get_width_height()
    image = QtGui.QImage(buffer, columns, rows, 4 * columns, QtGui.QImage.Format_RGBA8888)
    return QtGui.QPixmap.fromImage(image.copy())


class QualityPanel:
    """The task panel of the command Mesh quality."""

    def __init__(self, mesh) -> None:
        self.quality = QualityWidget(mesh)
        self.form = self.quality
        self.form.setWindowTitle(f"Quality of {mesh.Label}")
        self.form.setWindowIcon(QtGui.QIcon(icon("quadrille_quality")))
        self.quality.colour.setChecked(True)

    def getStandardButtons(self) -> int:
        """Close alone."""
        return int(QtGui.QDialogButtonBox.Close)

    def reject(self) -> bool:
        """Close."""
        self.quality.release()
        FreeCADGui.Control.closeDialog()
        return True
