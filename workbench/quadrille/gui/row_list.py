# SPDX-License-Identifier: GPL-3.0-or-later
"""Base of the panel's lists: rows with a name, a field and a button that removes the row, and a button below that adds rows."""

from typing import Any, Callable, List

from PySide import QtGui

from . import translate

#: Characters of a name that a narrow panel shows beside its field.
_LONGEST_BESIDE = 14


class RowList(QtGui.QWidget):
    """A list whose rows are edited in place."""

    def __init__(self, text: str, tip: str, name: str, pressed: Callable[[], None], changed: Callable[[], None]) -> None:
        """text, tip, name: label, tool tip and object name of the button below. pressed: called when it is clicked. changed:
        called when a row is edited, added or removed."""
        super().__init__()
        self._rows: List[Any] = []
        self._changed = changed
        self._grid = QtGui.QGridLayout()
        self._grid.setColumnStretch(0, 3)
        self._grid.setColumnStretch(1, 2)
        self.button = QtGui.QPushButton(text)
        self.button.setObjectName(name)
        self.button.setToolTip(tip)
        self.button.clicked.connect(lambda *_: pressed())
        layout = QtGui.QVBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.addLayout(self._grid)
        layout.addWidget(self.button)

    def _clear(self) -> None:
        while self._grid.count():
            widget = self._grid.takeAt(0).widget()
            widget.hide()
            widget.setParent(None)
            widget.deleteLater()
        self._rows = []

    def _show_row(self, row: Any, text: str, tip: str, box: Any, name: str) -> None:
        """Adds a row below the others. name: prefix of the object names of its text and of its remove button."""
        number = len(self._rows)
        shown = QtGui.QLineEdit(text)  # scrolls if the text is long
        shown.setObjectName(f"{name}Name{number}")
        shown.setReadOnly(True)
        shown.setCursorPosition(0)
        shown.setToolTip(tip)
        remove = QtGui.QToolButton()
        remove.setText("×")
        remove.setObjectName(f"{name}Remove{number}")
        remove.setToolTip(translate("Quadrille", "Remove this refinement"))
        is_long = len(text) > _LONGEST_BESIDE
        self._grid.addWidget(shown, 2 * number, 0, 1, 3 if is_long else 1)  # above its field if it would be cut
        self._grid.addWidget(box, 2 * number + is_long, 0 if is_long else 1, 1, 2 if is_long else 1)
        self._grid.addWidget(remove, 2 * number + is_long, 2)
        for widget in (shown, box):
            widget.setSizePolicy(QtGui.QSizePolicy.Ignored, QtGui.QSizePolicy.Fixed)
        self._rows.append(row)
        box.textChanged.connect(lambda *_: self._changed())
        remove.clicked.connect(lambda *_: self._remove(number))

    def _remove(self, number: int) -> None:
        raise NotImplementedError
