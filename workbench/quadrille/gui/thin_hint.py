# SPDX-License-Identifier: GPL-3.0-or-later
"""The panel's hint for a part that looks like a thin solid: its skin can be meshed, but a shell needs its middle surface."""

from typing import Callable, Optional

import FreeCADGui
from PySide import QtCore, QtGui

from ..core.errors import Error
from ..features.middle import looks_thin
from . import middle_search, tell, translate


class _Hint(QtGui.QLabel):
    """A sentence with a link in the color of the text, which can be read in any theme."""

    def __init__(self, text: str, offer: str) -> None:
        super().__init__()
        self._parts = text, offer
        self._color = ""
        self.setObjectName("QuadrilleThinHint")
        self.setWordWrap(True)
        self._write()

    def _write(self) -> None:
        color = self.palette().color(QtGui.QPalette.WindowText).name()
        if color != self._color:
            self._color = color
            text, offer = self._parts
            self.setText(f'{text} <a href="middle" style="color: {color}">{offer}</a>')

    def changeEvent(self, event) -> None:
        """Qt calls this when the theme has changed, too."""
        super().changeEvent(event)
        if event.type() in (QtCore.QEvent.PaletteChange, QtCore.QEvent.StyleChange):
            self._write()

    def showEvent(self, event) -> None:
        """Qt calls this when the hint is shown."""
        self._write()
        super().showEvent(event)


def thin_hint(part, close: Callable[[], object]) -> Optional[QtGui.QLabel]:
    """A label with a link that finds the middle surface, closes the panel and runs the command Middle surface; None if the part does
    not look thin. If there is no middle surface, or the search is cancelled, the panel stays as it is."""
    shape = part.Shape
    thickness = looks_thin(shape, shape.Area)
    if thickness is None:
        return None
    text = translate(
        "Quadrille", "{} may be a thin solid, of about {} mm: a mesh of its skin is a hollow box, and shell stresses on it are meaningless."
    ).format(part.Label, f"{thickness:.2g}")
    offer = translate("Quadrille", "Make its middle surface")
    label = _Hint(text, offer)

    def make(_link: str) -> None:
        try:
            middle_search.find(part, {})
        except Error as error:
            if error.kind != "cancelled":
                tell(str(error))
            return
        close()
        FreeCADGui.Selection.clearSelection()
        FreeCADGui.Selection.addSelection(part)
        QtCore.QTimer.singleShot(0, lambda: FreeCADGui.runCommand("Quadrille_Middle"))  # after the panel is closed

    label.linkActivated.connect(make)
    return label
