# SPDX-License-Identifier: GPL-3.0-or-later
"""The table of what the mesher left out of the part, and of what forces poor quads. A row that is selected is selected, dotted and
named in the 3-D view, and buttons keep what is selected there, or suppress it again."""

import re
from typing import Any, Callable, Dict, Iterable, List, NamedTuple, Sequence, Tuple

import FreeCADGui
from PySide import QtCore, QtGui

from ..core.errors import Error
from ..document import picks
from ..document.findings import findings_of
from ..document.state import source_of
from . import QT_TRANSLATE_NOOP, camera, mesh_clicks, overlays, tell_briefly, translate
from .tables import fill, table

#: The height of the table at most, in pixels: more rows scroll.
_MOST_HEIGHT = 190
#: How many findings of each kind are listed at most.
MOST_ROWS = 200
#: Names and numbers in the mesher's sentences: what differs between sentences with the same translation.
_VARYING = re.compile(r"(?:Face|Edge|Vertex)\d+|\d+(?:\.\d+)?(?:e[+-]?\d+)?")
#: The mesher's sentences, with {} for each name and number.
SENTENCES = (
    QT_TRANSLATE_NOOP("Quadrille", "tiny: replaced by an edge or a node of its neighbors"),
    QT_TRANSLATE_NOOP("Quadrille", "in a filled hole"),
    QT_TRANSLATE_NOOP("Quadrille", "joined with {}: coplanar"),
    QT_TRANSLATE_NOOP("Quadrille", "joined with {}: facets"),
    QT_TRANSLATE_NOOP("Quadrille", "crossed: covered by quads whose centers lie on its neighbors"),
    QT_TRANSLATE_NOOP("Quadrille", "no edge or angle there is too small; the mesh itself is irregular there"),
    QT_TRANSLATE_NOOP("Quadrille", "it is {} long"),
    QT_TRANSLATE_NOOP("Quadrille", "its sides meet at {} degrees at {}"),
    QT_TRANSLATE_NOOP("Quadrille", "{} comes within {} of itself"),
    QT_TRANSLATE_NOOP("Quadrille", "{} and {} come within {} of each other"),
    QT_TRANSLATE_NOOP("Quadrille", "a loop of {} would be too small for elements"),
    QT_TRANSLATE_NOOP("Quadrille", "{} is so narrow that it would lose much of its area"),
    QT_TRANSLATE_NOOP("Quadrille", "two edges of {} would share their nodes"),
    QT_TRANSLATE_NOOP("Quadrille", "a node is placed at its boundary"),
    QT_TRANSLATE_NOOP("Quadrille", "its long sides are not everywhere close together"),
    QT_TRANSLATE_NOOP("Quadrille", "{} has no valid mesh without it"),
)


class Row(NamedTuple):
    """One finding."""

    names: Tuple[str, ...]  #: faces, edges or vertices of the part; none in a row that stands for others
    text: str  #: what happened, and why
    distance: float = 0.0  #: mm; 0 = does not apply
    forces: bool = False  #: whether quads there are poor


def kept_with(kept: Sequence[str], names: Sequence[str], on: bool) -> List[str]:
    """The faces and edges to keep after some were added, or taken away."""
    others = [name for name in kept if name not in names]
    return [*others, *names] if on else others


def rows_of(mesh) -> List[Row]:
    """The findings of a mesh, the most harmful first: what was left out, by its distance; what forces poor quads, by their number;
    what is crossed or joined; and what was kept although it is small."""
    found = findings_of(mesh)
    kept = [Row((entry["name"],), translate("Quadrille", "small, but meshed: {}").format(_told(entry["why"]))) for entry in found["kept"]]
    lists = (sorted(_left_out(found), key=lambda row: -row.distance), list(_poor(found)), list(_crossed(found)), kept)
    return [row for rows in lists for row in _first(rows)]


def _first(rows: List[Row]) -> List[Row]:
    """Thousands of rows would make the panel slow."""
    more = translate("Quadrille", "{} more that do less harm").format(len(rows) - MOST_ROWS)
    return rows if len(rows) <= MOST_ROWS else [*rows[:MOST_ROWS], Row((), more)]


def _left_out(found: Dict[str, List[Any]]) -> Iterable[Row]:
    for hole in found["filled_holes"]:
        text = translate("Quadrille", "boss on {} that is left out") if hole["kind"] == "boss" else translate(
            "Quadrille", "hole in {} that is filled")
        yield Row(tuple(hole["faces"] or hole["in"]), text.format(", ".join(hole["in"])), hole["diameter"])
    for feature in found["suppressed_features"]:
        yield Row((feature["name"],), translate("Quadrille", "too small: {} stands for it").format(feature["to"]),
                  feature["distance"])


def _poor(found: Dict[str, List[Any]]) -> Iterable[Row]:
    for poor in found["poor_quads"]:
        text = translate("Quadrille", "poor quads: {}; {}").format(poor["quads"], _told(poor["why"]))
        yield Row((poor["name"],), text, poor["shortest"], True)


def _crossed(found: Dict[str, List[Any]]) -> Iterable[Row]:
    for edge in found["crossed_edges"]:
        faces = ", ".join(dict.fromkeys(edge["faces"]))
        text = translate("Quadrille", "smooth edge that quads cross; on {}").format(faces)
        yield Row((edge["name"],), text, edge.get("distance", 0.0))  # documents of older versions have none
    for face in found["merged_faces"]:
        yield Row((face["name"],), _told(face["note"]))


def _told(sentence: str) -> str:
    """A sentence of the mesher in the user's language, if that is known."""
    return translate("Quadrille", _VARYING.sub("{}", sentence)).format(*_VARYING.findall(sentence))


class FindingsTable(QtGui.QWidget):
    """The table and its buttons. Follows clicks in the view until release() is called."""

    def __init__(self, mesh, show_poor: Callable[[str], bool], keep: Callable[[Sequence[str], bool], None]) -> None:
        """show_poor: shows the worst quad on a face or edge; False if there is none. keep: adds names to those to keep, or takes
        them away."""
        super().__init__()
        self._mesh, self._show_poor = mesh, show_poor
        self._findings: List[Row] = []
        self._rows: List[Row] = []  # these, and what is only to be kept
        self._kept: Sequence[str] = ()
        self.table = table("QuadrilleFindings", 3, 1, _MOST_HEIGHT)
        self.table.setHorizontalHeaderLabels([translate("Quadrille", "Where"), translate("Quadrille", "What"), "mm"])
        self.table.horizontalHeaderItem(2).setToolTip(translate(
            "Quadrille", "Of what is suppressed: how far it lies from what stands for it; of an edge that quads cross: how far it lies from "
            "them; of a filled hole: its width; of poor quads: their shortest side"))
        self.table.setSelectionBehavior(QtGui.QAbstractItemView.SelectRows)
        self.table.itemSelectionChanged.connect(self._show)
        self._buttons = QtGui.QWidget()
        buttons = QtGui.QHBoxLayout(self._buttons)
        buttons.setContentsMargins(0, 0, 0, 0)
        for name, text, tip, on in (
                ("QuadrilleKeep", translate("Quadrille", "Keep"),
                 translate("Quadrille", "In the next mesh, the faces and edges selected here or in the 3-D view keep nodes of their own"),
                 True),
                ("QuadrilleSuppress", translate("Quadrille", "Suppress"),
                 translate("Quadrille", "The selected faces and edges are no longer kept: where they are small, they may be suppressed "
                           "or crossed in the next mesh"), False)):
            button = QtGui.QPushButton(text)
            button.setObjectName(name)
            button.setToolTip(tip)
            button.clicked.connect(lambda *_, on=on: self._keep(keep, on))
            buttons.addWidget(button)
        layout = QtGui.QVBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.addWidget(self.table)
        layout.addWidget(self._buttons)
        mesh_clicks.listeners.append(self._clicked)

    def refresh(self) -> None:
        """Shows the findings of the mesh that is there now."""
        self._hide_marks()
        self._findings = rows_of(self._mesh)
        self.show_kept(getattr(self._mesh, "Keep", ()))

    def show_kept(self, names: Sequence[str]) -> None:
        """Says which faces and edges are to be kept: those of the settings that the panel shows."""
        selected = self._selected()
        self._kept = names
        found = {name for row in self._findings for name in row.names}
        self._rows = [*self._findings, *(Row((name,), "") for name in names if name not in found)]
        self.table.blockSignals(True)
        fill(self.table, [self._texts(row) for row in self._rows])
        self.table.blockSignals(False)
        self._select(selected)
        self._buttons.setVisible("Keep" in self._mesh.PropertiesList)
        self.table.setVisible(bool(self._rows))

    def _texts(self, row: Row) -> Tuple[str, str, str]:
        more = f" (+{len(row.names) - 1})" if len(row.names) > 1 else ""
        kept = [translate("Quadrille", "to be kept")] if set(row.names) & set(self._kept) else []
        return "".join(row.names[:1]) + more, "; ".join(kept + [row.text] * bool(row.text)), f"{row.distance:.3g}" if row.distance else ""

    def _selected(self) -> List[str]:
        return [name for index in self.table.selectionModel().selectedRows() for name in self._rows[index.row()].names]

    def _select(self, names: Iterable[str]) -> None:
        """Selects the rows of these names, and nothing in the view."""
        self.table.blockSignals(True)
        self.table.clearSelection()
        for number, row in enumerate(self._rows):
            if set(names) & set(row.names):
                self.table.selectionModel().select(self.table.model().index(number, 0),
                                                   QtCore.QItemSelectionModel.Select | QtCore.QItemSelectionModel.Rows)
                self.table.scrollTo(self.table.model().index(number, 0))
        self.table.blockSignals(False)

    def _show(self) -> None:
        """Selects in the view what is selected in the table, and moves the camera there if it cannot be seen. Zooms to poor quads."""
        names, part = self._selected(), source_of(self._mesh)
        if not names or not hasattr(getattr(part, "Shape", None), "getElement") or self._mesh.Status in picks.OTHER_PART:
            self._hide_marks()
            return
        mesh_clicks.select(part, names)
        box = overlays.mark(self._mesh, part.Shape, names)
        rows = self.table.selectionModel().selectedRows()
        if len(rows) == 1 and self._rows[rows[0].row()].forces and self._show_poor(names[0]):
            return
        if box is not None and not camera.is_in_sight(self._mesh, box.Center, box.DiagonalLength):
            camera.look_at(self._mesh, box.Center, 8 * box.DiagonalLength or 20 * self._mesh.LeastSize or 1.0)

    def _keep(self, keep: Callable[[Sequence[str], bool], None], on: bool) -> None:
        names = mesh_clicks.picked_on(self._mesh, "Face", "Edge")
        if names and not on and not set(names) & set(self._kept):
            tell_briefly(translate("Quadrille", "{}: not on the list of what is to be kept; the table says why the mesher itself keeps "
                                   "an edge").format(", ".join(names)))
        elif names:
            keep(names, on)

    def _clicked(self, document: str, _name: str, _point) -> None:
        """Selects the rows of what was clicked in the view."""
        try:
            if document != self._mesh.Document.Name:
                return
            names = picks.elements_of(source_of(self._mesh), mesh_clicks.picked(self._mesh.Document))
        except ReferenceError:  # the object or its document was deleted
            self.release()
            return
        except Error:  # the part has changed: its names are not those in the table
            names = []
        self._select(names)

    def _hide_marks(self) -> None:
        if self._mesh.ViewObject is not None and FreeCADGui.activeDocument() is not None:
            overlays.hide(self._mesh, overlays.MARKS)

    def release(self) -> None:
        """Ends following clicks."""
        if self._clicked in mesh_clicks.listeners:
            mesh_clicks.listeners.remove(self._clicked)
