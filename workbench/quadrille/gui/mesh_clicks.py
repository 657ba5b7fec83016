# SPDX-License-Identifier: GPL-3.0-or-later
"""What is selected, for commands and panels: a click on a quad mesh counts as one on the face, edge or vertex of its part there.

FreeCAD gives observers the position of a click even if it selects the whole mesh, as at the second click on it; the selection
itself does not contain it."""

from typing import Callable, Dict, List, Optional, Sequence, Tuple

import FreeCADGui

from ..core.errors import Error
from ..document import picks, state
from . import tell, translate

#: Where selected objects were clicked, by the names of document and object as FreeCAD passes them.
_clicks: Dict[Tuple[str, str], List[Sequence[float]]] = {}
#: Called with the names of document and object, and with the point, at each click that selects something.
listeners: List[Callable[[str, str, Sequence[float]], None]] = []


class _Observer:
    """Records the clicks on selected objects."""

    def addSelection(self, document: str, obj: str, _path: str, point) -> None:
        """FreeCAD calls this when something is selected; scripts and the tree give no point."""
        if any(point):
            _clicks.setdefault((document, obj), []).append(tuple(point))
            for listener in tuple(listeners):
                listener(document, obj, point)

    def removeSelection(self, document: str, obj: str, _path: str) -> None:
        """FreeCAD calls this when something is no longer selected."""
        _clicks.pop((document, obj), None)

    def clearSelection(self, _document: str) -> None:
        """FreeCAD calls this when nothing is selected any more."""
        _clicks.clear()

    def setSelection(self, _document: str) -> None:
        """FreeCAD calls this when another selection replaces all."""
        _clicks.clear()


_observer: Optional[_Observer] = None


def watch() -> None:
    """Starts to record clicks. Further calls do nothing."""
    global _observer
    if _observer is None:
        _observer = _Observer()
        FreeCADGui.Selection.addObserver(_observer)


def picked(document) -> List[picks.Pick]:
    """The selection in a document as picks, see picks.py."""
    found: List[picks.Pick] = []
    for pick in picks.picks_of(FreeCADGui.Selection.getSelectionEx(document.Name, 0)):
        mesh = picks.along(pick)[-1]
        if not state.is_quad_mesh(mesh):
            found.append(pick)
            continue
        inner = pick[1][:pick[1].rfind(".") + 1]
        points = _clicks.get((document.Name, pick[0].Name)) or _clicks.get((document.Name, mesh.Name)) or []
        names = [name for name in (picks.on_mesh(mesh, point) for point in points) if name]
        found += [(pick[0], inner + name) for name in dict.fromkeys(names)] or [(pick[0], inner)]
    return list(dict.fromkeys(found))


def picked_on(mesh, *kinds: str) -> List[str]:
    """The names of the selected elements of these kinds on the part of a mesh. Shows a message if there are none."""
    try:
        part = state.part_of(mesh)
        names = picks.elements_of(part, picked(mesh.Document))
    except Error as error:
        tell(str(error))
        return []
    found = [name for name in names if name.startswith(kinds)]
    if not found:
        tell(translate("Quadrille", "Select them on {} in the 3-D view first.").format(part.Label))
    return found


def select(part, names: Sequence[str]) -> None:
    """Selects faces, edges or vertices of a part, and nothing else."""
    FreeCADGui.Selection.clearSelection()
    for name in names:
        FreeCADGui.Selection.addSelection(part.Document.Name, part.Name, name)


def toggle(mesh) -> None:
    """Shows a mesh instead of its part, or the part instead of the mesh."""
    part = mesh.Shape
    to_part = mesh.ViewObject.Visibility
    mesh.ViewObject.Visibility = not to_part
    if part is not None:
        part.ViewObject.Visibility = to_part
