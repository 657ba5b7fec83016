# SPDX-License-Identifier: GPL-3.0-or-later
"""Shows the sizes that a mesh would have, as colors on its part, before meshing. A child process finds them. They are drawn
piece by piece, so that the window stays responsive however large the part is."""

from typing import Callable, Iterator, Optional

import FreeCADGui
import numpy as np
from PySide import QtCore, QtGui

from ..core.errors import Error
from ..core.setting_table import SETTINGS
from ..core.units import digits
from ..document.state import Wanted
from ..features import sizes
from . import translate

_POLL_MILLISECONDS = 50
#: Delay after a change of settings, to wait for further typing.
_SETTLE_MILLISECONDS = 400
#: Number of values handed to the 3-D view at a time, which takes some milliseconds.
_PIECE = 20000
#: Quads this many times as long as wide are worth a line.
_NOTABLY_LONGER = 1.1
#: The properties that have fields in the panel.
_FIELDS = frozenset(setting["property"] for setting in SETTINGS if setting["property"])


class SizePreview(QtGui.QWidget):
    """A button that shows and hides the sizes. While shown, they follow the settings."""

    def __init__(self, mesh, wanted: Callable[[], Wanted], counted: Callable[[float], None]) -> None:
        """wanted: returns the settings to show, or raises Error. counted: called with the expected number of elements."""
        super().__init__()
        self._mesh, self._wanted, self._counted = mesh, wanted, counted
        self._job: Optional[sizes.SizesJob] = None
        self._drawing: Optional[Iterator[None]] = None
        self._drawn: Optional[_Drawn] = None
        self._hidden: list = []  # view providers that were hidden
        self.button = QtGui.QPushButton(translate("Quadrille", "Preview sizes"))
        self.button.setObjectName("QuadrillePreview")
        self.button.setToolTip(translate(
            "Quadrille", "Show the element sizes in colors, and what requests them, before meshing"))
        self.button.setCheckable(True)
        self.text = QtGui.QLabel()
        self.text.setObjectName("QuadrillePreviewText")
        self.text.setWordWrap(True)
        self.bar = QtGui.QLabel()
        self.bar.setObjectName("QuadrillePreviewBar")
        self.bar.setScaledContents(True)
        self.bar.setSizePolicy(QtGui.QSizePolicy.Ignored, QtGui.QSizePolicy.Fixed)
        self.bar.setFixedHeight(14)
        layout = QtGui.QVBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        for widget in (self.button, self.bar, self.text):
            layout.addWidget(widget)
        self._timer, self._settle = QtCore.QTimer(), QtCore.QTimer()  # without the widget as parent, see MeshPanel
        self._timer.setInterval(_POLL_MILLISECONDS)
        self._timer.timeout.connect(self._poll)
        self._settle.setSingleShot(True)
        self._settle.setInterval(_SETTLE_MILLISECONDS)
        self._settle.timeout.connect(self._start)
        self.button.toggled.connect(self._toggle)
        self._show_text("")

    @property
    def busy(self) -> bool:
        """True while the sizes shown do not yet match the settings."""
        return self._settle.isActive() or self._timer.isActive()

    def follow(self) -> None:
        """Called when the settings have changed."""
        if self.button.isChecked():
            self._settle.start()

    def release(self) -> None:
        """Ends the child process and removes the colors from the view."""
        self._settle.stop()
        self._stop()
        self._clear()
        for view in self._hidden:
            try:
                view.show()
            except ReferenceError:  # the object or its document was deleted
                pass
        self._hidden = []

    def _toggle(self, on: bool) -> None:
        if on:
            self._start()
            return
        self.release()
        self._show_text("")

    def _start(self) -> None:
        self._stop()
        try:
            self._job = sizes.start(self._mesh, self._wanted())
        except Error as error:
            self._fail(error)
            return
        self._show_work(translate("Quadrille", "finding sizes"))
        self._timer.setInterval(_POLL_MILLISECONDS)
        self._timer.start()

    def _stop(self) -> None:
        self._timer.stop()
        self._drawing = None
        job, self._job = self._job, None
        if job is not None:
            job.drop()

    def _poll(self) -> None:
        if self._drawing is not None:
            if next(self._drawing, self) is self:
                self._timer.stop()
                self._drawing = None
            return
        if self._job is None:
            self._timer.stop()
            return
        for _, fraction in self._job.poll():
            self._show_work(translate("Quadrille", "finding sizes: {} %").format(round(100 * fraction)))
        if self._job.running:
            return
        job, self._job = self._job, None
        try:
            found = job.result()
        except Error as error:
            self._timer.stop()
            self._fail(error)
            return
        self._clear()
        self._drawing = self._draw(found)
        self._timer.setInterval(0)

    def _fail(self, error: Error) -> None:
        self._clear()
        self._show_text("" if error.subject in _FIELDS else str(error))  # else it stands at the field

    def _clear(self) -> None:
        drawn, self._drawn = self._drawn, None
        if drawn is not None:
            drawn.remove()

    def _draw(self, found: sizes.SizeMap) -> Iterator[None]:
        least, largest = sizes.range_of(found.sizes)
        self._drawn = _Drawn(self._mesh.Document.Name)
        yield from self._drawn.fill(found, sizes.colors(found.sizes, least, largest))
        self._hide_part()
        self._drawn.show()
        self.bar.setPixmap(_color_bar())
        self.bar.setVisible(True)
        self._show_text(summary(found), True)
        self._counted(found.quads)

    def _hide_part(self) -> None:
        """Hides the part and the mesh, which would show through the colors."""
        for obj in (self._mesh.Shape, self._mesh):
            view = getattr(obj, "ViewObject", None)  # the part may have been deleted
            if view is not None and view.Visibility:
                view.hide()
                self._hidden.append(view)

    def _show_work(self, text: str) -> None:
        """Shows what goes on, in the first line; the others stay, so that what is below does not jump."""
        _, *others = self.text.text().split("\n") if self._drawn is not None else [""]
        self._show_text("\n".join((text, *others)), bool(others))

    def _show_text(self, text: str, with_bar: bool = False) -> None:
        self.text.setText(text)
        self.text.setVisible(bool(text))
        self.bar.setVisible(with_bar)


def summary(found: sizes.SizeMap) -> str:
    """A text that explains the colors and lists the sources of the sizes."""
    lines = [translate("Quadrille", "dark {} mm, light {} mm").format(
        digits(found.sizes.min()), digits(found.sizes.max()))]
    longest = (found.along / found.sizes).max()
    if longest > _NOTABLY_LONGER:
        lines.append(translate("Quadrille", "bends: size across them; quads are up to {} times as long").format(digits(longest)))
    area = sum(source.area for source in found.sources)
    for source in sorted(found.sources, key=lambda entry: -entry.quads):
        lines.append(translate("Quadrille", "{}: {:.0f} quads on {} % of the area").format(
            source.name, source.quads, digits(100 * source.area / area)))
    return "\n".join(lines)


def _color_bar():
    """A picture of the colors from the smallest to the largest size."""
    rgb = np.round(255 * sizes.colors(np.geomspace(1.0, 2.0, 256), 1.0, 2.0)).astype(np.uint8)
    data = np.ascontiguousarray(rgb[None]).tobytes()
    return QtGui.QPixmap.fromImage(QtGui.QImage(data, 256, 1, 768, QtGui.QImage.Format_RGB888).copy())


class _Drawn:
    """Colored triangles in the 3-D view of a document."""

    def __init__(self, document_name: str) -> None:
        from pivy import coin

        self._view = FreeCADGui.getDocument(document_name).ActiveView
        self._shown = False
        self.node = coin.SoSeparator()
        picking, hints, offset = coin.SoPickStyle(), coin.SoShapeHints(), coin.SoPolygonOffset()
        picking.style = coin.SoPickStyle.UNPICKABLE
        hints.vertexOrdering = coin.SoShapeHints.COUNTERCLOCKWISE
        hints.shapeType = coin.SoShapeHints.UNKNOWN_SHAPE_TYPE  # lit from both sides
        binding = coin.SoMaterialBinding()
        binding.value = coin.SoMaterialBinding.PER_VERTEX_INDEXED
        self._material, self._points = coin.SoMaterial(), coin.SoCoordinate3()
        self._faces, self._lines = coin.SoIndexedFaceSet(), coin.SoIndexedLineSet()
        black, plain, overall = coin.SoBaseColor(), coin.SoLightModel(), coin.SoMaterialBinding()
        black.rgb = (0.0, 0.0, 0.0)
        plain.model = coin.SoLightModel.BASE_COLOR
        overall.value = coin.SoMaterialBinding.OVERALL
        for node in (picking, hints, offset, self._material, binding, self._points, self._faces, plain, black, overall, self._lines):
            self.node.addChild(node)

    def fill(self, found: sizes.SizeMap, colors: np.ndarray) -> Iterator[None]:
        """Hands the map to the scene nodes, one piece per step."""
        triangles, lines = (np.hstack([ends, np.full((len(ends), 1), -1, dtype=np.int32)]).ravel()
                            for ends in (found.triangles, found.lines))
        for field, values in ((self._points.point, found.points), (self._material.diffuseColor, colors),
                              (self._faces.coordIndex, triangles), (self._lines.coordIndex, lines)):
            field.setNum(len(values))
            for start in range(0, len(values), _PIECE):
                piece = values[start:start + _PIECE]
                field.setValues(start, len(piece), piece.tolist())
                yield

    def show(self) -> None:
        """Adds the triangles to the view; does nothing if it is not a 3-D view."""
        if hasattr(self._view, "getSceneGraph"):
            self._view.getSceneGraph().addChild(self.node)
            self._shown = True

    def remove(self) -> None:
        """Removes the triangles from the view."""
        if not self._shown:
            return
        self._shown = False
        try:
            graph = self._view.getSceneGraph()
        except (RuntimeError, ReferenceError):  # the view is closed
            return
        if graph.findChild(self.node) >= 0:
            graph.removeChild(self.node)
