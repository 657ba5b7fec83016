# SPDX-License-Identifier: GPL-3.0-or-later
"""The quads to expect on each face, in the panel: where most of them go is where a size is worth another look."""

from typing import Mapping

import FreeCADGui
from PySide import QtGui


class FaceCounts(QtGui.QListWidget):
    """A row for each face, those with most quads first; a click selects the face in the 3-D view."""

    def __init__(self, mesh) -> None:
        super().__init__()
        self._mesh = mesh
        self._counts: Mapping[str, float] = {}
        self.setObjectName("QuadrilleFaceCounts")
        self.setMaximumHeight(120)
        self.itemClicked.connect(self._select)

    def show_counts(self, counts: Mapping[str, float]) -> None:
        """Shows these, by face, once the list is in sight: it may have thousands of rows."""
        self._counts = counts
        if self.isVisible():
            self._fill()

    def showEvent(self, event) -> None:
        """Qt calls this when the list comes in sight."""
        self._fill()
        super().showEvent(event)

    def _fill(self) -> None:
        self.clear()
        for name in sorted(self._counts, key=self._counts.get, reverse=True):
            self.addItem(f"{name}: {max(1, round(self._counts[name]))}")

    def _select(self, item) -> None:
        part = self._mesh.Shape
        if part is None:
            return
        FreeCADGui.Selection.clearSelection()
        FreeCADGui.Selection.addSelection(part.Document.Name, part.Name, item.text().partition(":")[0])
