# SPDX-License-Identifier: GPL-3.0-or-later
"""The sizes of a mesh that are entries of its properties (in space, layers, numbers of segments and their bias) in its panel:
what each is on, and its numbers, edited in place. Numbers on edges are added here, other new ones in the property editor."""

from typing import Any, Callable, Dict, List, NamedTuple, Sequence

from PySide import QtGui

from ..errors import Error
from ..setting_table import SETTINGS
from . import translate

#: Properties whose value is a list of texts such as "Edge4=20".
PROPERTIES = tuple(setting["property"] for setting in SETTINGS if setting["property"] and setting["kind"] == "entries")


class _Row(NamedTuple):
    """One entry as it is shown."""

    property: str
    place: str  #: before the equals sign
    box: Any  #: what follows


class EntryRows(QtGui.QWidget):
    """A row for each entry."""

    def __init__(self, divide: Callable[[], None], changed: Callable[[], None]) -> None:
        """divide: adds numbers for the edges that are selected, by add()."""
        super().__init__()
        self._rows: List[_Row] = []
        self._changed = changed
        self._grid = QtGui.QGridLayout()
        self._grid.setColumnStretch(0, 3)
        self._grid.setColumnStretch(1, 2)
        self.divide_button = QtGui.QPushButton(translate("Quadrille", "Divide selected edges"))
        self.divide_button.setObjectName("QuadrilleDivide")
        self.divide_button.setToolTip(translate("Quadrille", "Say how many elements the selected edges get"))
        self.divide_button.clicked.connect(lambda *_: divide())
        layout = QtGui.QVBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.addLayout(self._grid)
        layout.addWidget(self.divide_button)

    def values(self) -> Dict[str, List[str]]:
        """The entries shown, by property. Raises Error where one has no number."""
        found: Dict[str, List[str]] = {name: [] for name in PROPERTIES}
        for row in self._rows:
            text = row.box.text().strip()
            if not text:
                raise Error(translate("Quadrille", "{} of {}: give its numbers, or remove it").format(row.property, row.place),
                            "usage", row.property)
            found[row.property].append(f"{row.place}={text}")
        return found

    def show_all(self, values: Dict[str, Sequence[str]]) -> None:
        """Shows the entries of these properties and no others."""
        while self._grid.count():
            widget = self._grid.takeAt(0).widget()
            widget.hide()
            widget.setParent(None)
            widget.deleteLater()
        self._rows = []
        for name in PROPERTIES:
            for entry in values[name]:
                self._add_row(name, entry)

    def _add_row(self, name: str, entry: str) -> None:
        number, (place, _, text) = len(self._rows), entry.rpartition("=")
        shown = QtGui.QLineEdit(f"{name} {place}")
        shown.setReadOnly(True)
        shown.setCursorPosition(0)
        shown.setToolTip(f"{name}: {entry}")
        shown.setSizePolicy(QtGui.QSizePolicy.Ignored, QtGui.QSizePolicy.Fixed)
        box = QtGui.QLineEdit(text)
        box.setObjectName(f"QuadrilleEntry{number}")
        box.setSizePolicy(QtGui.QSizePolicy.Ignored, QtGui.QSizePolicy.Fixed)
        remove = QtGui.QToolButton()
        remove.setText("×")
        remove.setObjectName(f"QuadrilleEntryRemove{number}")
        remove.setToolTip(translate("Quadrille", "Remove this refinement"))
        for column, widget in enumerate((shown, box, remove)):
            self._grid.addWidget(widget, number, column)
        self._rows.append(_Row(name, place, box))
        box.textChanged.connect(lambda *_: self._changed())
        remove.clicked.connect(lambda *_: self._remove(number))

    def add(self, name: str, entries: Dict[str, str]) -> None:
        """Entries of a property, by their places; those of places that are there already give way."""
        shown: Dict[str, List[str]] = {other: [] for other in PROPERTIES}
        for row in self._rows:
            if row.property != name or row.place not in entries:
                shown[row.property].append(f"{row.place}={row.box.text()}")
        shown[name] += [f"{place}={text}" for place, text in entries.items()]
        self.show_all(shown)
        self._changed()

    def _remove(self, number: int) -> None:
        rest: Dict[str, List[str]] = {name: [] for name in PROPERTIES}
        for index, row in enumerate(self._rows):
            if index != number:
                rest[row.property].append(f"{row.place}={row.box.text()}")
        self.show_all(rest)
        self._changed()
