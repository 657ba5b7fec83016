# SPDX-License-Identifier: GPL-3.0-or-later
"""The refinements of a mesh in its panel: what each is on, and its size, edited in place. Nothing reaches the document
before the panel stores it."""

from typing import Any, Callable, List, NamedTuple, Tuple

from PySide import QtGui

from ..links import Links, names_in
from ..state import Refinement
from . import translate
from .length_field import LengthField


class _Row(NamedTuple):
    """One refinement as it is shown."""

    region: Any
    references: Links
    box: Any  #: of the size
    shown: Tuple[float, float]  #: the size, and what the box made of it


class RefinementList(QtGui.QWidget):
    """A row for each refinement, and a button that adds what is selected."""

    def __init__(self, add: Callable[[], None], changed: Callable[[], None]) -> None:
        super().__init__()
        self._rows: List[_Row] = []
        self._changed = changed
        self._grid = QtGui.QGridLayout()
        self._grid.setColumnStretch(0, 3)
        self._grid.setColumnStretch(1, 2)
        self.add_button = QtGui.QPushButton(translate("Quadrille", "Refine selection"))
        self.add_button.setObjectName("QuadrilleAddRefinement")
        self.add_button.setToolTip(translate("Quadrille", "Give the selected faces, edges or vertices a size of their own"))
        self.add_button.clicked.connect(lambda *_: add())
        layout = QtGui.QVBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.addLayout(self._grid)
        layout.addWidget(self.add_button)

    def refinements(self) -> Tuple[Refinement, ...]:
        """What is shown. Raises Error where a size cannot be read."""
        found = []
        for row in self._rows:
            size = row.box.length(translate("Quadrille", "Refinement"))
            found.append(Refinement(row.region, row.references, row.shown[0] if size == row.shown[1] else size))
        return tuple(found)

    def show_all(self, refinements: Tuple[Refinement, ...]) -> None:
        """Shows these and no others."""
        while self._grid.count():
            widget = self._grid.takeAt(0).widget()
            widget.hide()
            widget.setParent(None)
            widget.deleteLater()
        self._rows = []
        for refinement in refinements:
            self._add_row(refinement)

    def _add_row(self, refinement: Refinement) -> None:
        number = len(self._rows)
        text = ", ".join(names_in(refinement.references))
        name = QtGui.QLineEdit(text)  # scrolls where the names are many
        name.setReadOnly(True)
        name.setCursorPosition(0)
        name.setToolTip(text if refinement.region is None else f"{refinement.region.Label}: {text}")
        name.setObjectName(f"QuadrilleRefined{number}")
        name.setSizePolicy(QtGui.QSizePolicy.Ignored, QtGui.QSizePolicy.Fixed)
        box = LengthField(f"QuadrilleRefinedSize{number}")
        box.show_length(refinement.size)
        remove = QtGui.QToolButton()
        remove.setText("×")
        remove.setObjectName(f"QuadrilleRefinedRemove{number}")
        remove.setToolTip(translate("Quadrille", "Remove this refinement"))
        self._grid.addWidget(name, number, 0)
        self._grid.addWidget(box, number, 1)
        self._grid.addWidget(remove, number, 2)
        self._rows.append(_Row(refinement.region, refinement.references, box, (refinement.size, box.length())))
        box.textChanged.connect(lambda *_: self._changed())
        remove.clicked.connect(lambda *_: self._remove(number))

    def add(self, references: Links, size: float) -> None:
        """One more."""
        self._add_row(Refinement(None, references, size))
        self._changed()

    def _remove(self, number: int) -> None:
        rest = [refinement for index, refinement in enumerate(self.refinements()) if index != number]
        self.show_all(tuple(rest))
        self._changed()
