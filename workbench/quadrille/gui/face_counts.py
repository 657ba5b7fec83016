# SPDX-License-Identifier: GPL-3.0-or-later
"""The expected number of quads on each face, in the panel. It is worth checking the size on the faces with the most quads."""

from typing import Mapping

from PySide import QtGui

from . import mesh_clicks


class FaceCounts(QtGui.QListWidget):
    """One row per face, those with the most quads first. A click selects the face in the 3-D view."""

    def __init__(self, mesh) -> None:
        super().__init__()
        self._mesh = mesh
        self._counts: Mapping[str, float] = {}
        self.setObjectName("QuadrilleFaceCounts")
        self.setMaximumHeight(120)
        self.itemClicked.connect(self._select)
        self._open = False

    def show_counts(self, counts: Mapping[str, float]) -> None:
        """Shows counts by face, but fills the list only when it is visible, since it may have thousands of rows."""
        self._counts = counts
        if not counts:
            self.clear()
        self.open(self._open)

    def open(self, is_open: bool) -> None:
        """Called when the section around the list opens or closes. A list without rows is no use: it takes no room."""
        self._open = is_open
        self.setVisible(is_open and bool(self._counts))
        if self.isVisible():
            self._fill()

    def showEvent(self, event) -> None:
        """Qt calls this when the list becomes visible."""
        self._fill()
        super().showEvent(event)

    def _fill(self) -> None:
        self.clear()
        for name in sorted(self._counts, key=self._counts.__getitem__, reverse=True):
            self.addItem(f"{name}: {max(1, round(self._counts[name]))}")

    def _select(self, item) -> None:
        if self._mesh.Shape is not None:
            mesh_clicks.select(self._mesh.Shape, [item.text().partition(":")[0]])
