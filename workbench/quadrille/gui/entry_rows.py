# SPDX-License-Identifier: GPL-3.0-or-later
"""The part of the panel with sizes that are entries in list properties: sizes in space, numbers of segments and their
bias, places of nodes. Each row shows where an entry applies, and its numbers, which are edited in place. Numbers of segments on
edges and places of nodes are added here, other new entries in the property editor."""

from typing import Any, Callable, Dict, List, Mapping, NamedTuple, Sequence

from PySide import QtGui

from ..core.errors import Error
from ..core.setting_table import SETTINGS
from . import QT_TRANSLATE_NOOP, translate
from .findings_table import kept_with
from .row_list import RowList

#: The one whose entries are only names: they share a row.
NAMES = "Keep"
#: Properties whose value is a list of texts such as "Edge4=20".
PROPERTIES = tuple(setting["property"] for setting in SETTINGS if setting["property"] and setting["kind"] == "entries")
#: What the rows call them.
_WORDS = {
    "SizeIn": QT_TRANSLATE_NOOP("Quadrille", "Size in"),
    "Segments": QT_TRANSLATE_NOOP("Quadrille", "Segments"),
    "Bias": QT_TRANSLATE_NOOP("Quadrille", "Bias"),
    "BiasBoth": QT_TRANSLATE_NOOP("Quadrille", "Bias from both ends"),
    "NodesAt": QT_TRANSLATE_NOOP("Quadrille", "Node"),
    "Keep": QT_TRANSLATE_NOOP("Quadrille", "Keep"),
}


class _Row(NamedTuple):
    """One entry as it is shown."""

    property: str
    place: str  #: the text before the equals sign; empty for NAMES and for nodes without a name
    box: Any  #: the field with the text after it, or with the names

    def entries(self) -> List[str]:
        """The entries as texts."""
        text = self.box.text().strip()
        if self.property == NAMES:
            return [name.strip() for name in text.split(",") if name.strip()]
        return [f"{self.place}={text}" if self.place else text]


class EntryRows(RowList):
    """A row for each entry."""

    def __init__(self, divide: Callable[[], None], place: Callable[[], None], changed: Callable[[], None]) -> None:
        """divide, place: called to add numbers for the selected edges, and nodes at the selected points, with add()."""
        super().__init__(translate("Quadrille", "Divide selected edges"),
                         translate("Quadrille", "Set the number of elements on the selected edges"), "QuadrilleDivide", divide, changed)
        self.place = QtGui.QPushButton(translate("Quadrille", "Nodes at selected points"))
        self.place.setObjectName("QuadrillePlace")
        self.place.setToolTip(translate("Quadrille", "Put a node, with a group of its own, at each selected vertex or point object"))
        self.place.clicked.connect(lambda *_: place())
        self.layout().addWidget(self.place)

    def values(self) -> Dict[str, List[str]]:
        """The entries shown, by property. Raises Error if one has no number."""
        found: Dict[str, List[str]] = {name: [] for name in PROPERTIES}
        for row in self._rows:
            if row.property != NAMES and not row.box.text().strip():
                raise Error(translate("Quadrille", "{} of {}: give its numbers, or remove it").format(row.property, row.place),
                            "usage", row.property)
            found[row.property] += row.entries()
        return found

    def show_all(self, values: Mapping[str, Sequence[str]]) -> None:
        """Shows these entries, by property, and no others."""
        self._clear()
        for name in PROPERTIES:
            if name == NAMES:
                if values[name]:
                    self._add_row(name, "", ", ".join(values[name]))
                continue
            for entry in values[name]:
                place, _, text = entry.rpartition("=")
                self._add_row(name, place, text)

    def names(self) -> List[str]:
        """The faces and edges to keep that are shown."""
        return [name for row in self._rows if row.property == NAMES for name in row.entries()]

    def _add_row(self, name: str, place: str, text: str) -> None:
        box = QtGui.QLineEdit(text)
        box.setObjectName(f"QuadrilleEntry{len(self._rows)}")
        shown = f"{translate('Quadrille', _WORDS[name])} {place}".rstrip()
        self._show_row(_Row(name, place, box), shown, f"{name}: {place}={text}" if place else name, box, "QuadrilleEntry")

    def add(self, name: str, entries: Dict[str, str]) -> None:
        """Adds entries of a property, by place. They replace existing entries with the same place."""
        self._show_changed([row for row in self._rows if row.property != name or row.place not in entries], name,
                           [f"{place}={text}" for place, text in entries.items()])

    def keep(self, names: Sequence[str], on: bool) -> None:
        """Adds faces and edges to those to keep, or takes them away."""
        self._show_changed([row for row in self._rows if row.property != NAMES], NAMES, kept_with(self.names(), names, on))

    def select(self, name: str, place: str):
        """Selects the numbers of an entry, for typing others. Returns their field."""
        row = next(row for row in self._rows if (row.property, row.place) == (name, place))
        row.box.setFocus()
        row.box.selectAll()
        return row.box

    def _remove(self, number: int) -> None:
        self._show_changed([row for index, row in enumerate(self._rows) if index != number])

    def _show_changed(self, rows: Sequence[_Row], name: str = NAMES, more: Sequence[str] = ()) -> None:
        """Shows these rows only, and more entries of a property."""
        shown: Dict[str, List[str]] = {other: [] for other in PROPERTIES}
        for row in rows:
            shown[row.property] += row.entries()
        shown[name] += more
        self.show_all(shown)
        self._changed()
