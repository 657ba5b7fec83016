# SPDX-License-Identifier: GPL-3.0-or-later
"""The windows of the workbench: commands, task panels, view provider. Loaded only when FreeCAD has a window."""

from contextlib import contextmanager
from pathlib import Path

import FreeCAD
import FreeCADGui
from PySide import QtGui

_FOLDER = Path(__file__).resolve().parents[2]
ICONS = _FOLDER / "icons"
TRANSLATIONS = _FOLDER / "translations"

translate = FreeCAD.Qt.translate


def QT_TRANSLATE_NOOP(_context: str, text: str) -> str:  # the name that Qt's tools look for
    """Marks a text for translation, and gives it as it is."""
    return text


def icon(name: str) -> str:
    """The path of an icon of ours."""
    return str(ICONS / f"{name}.svg")


def tell(text: str, title: str = "Quadrille") -> None:
    """Tells the user what went wrong, in a box and in the report view."""
    FreeCAD.Console.PrintError(f"{title}: {text}\n")
    QtGui.QMessageBox.warning(FreeCADGui.getMainWindow(), title, text)


def standard_buttons(*names: str):
    """Buttons of a task panel by their names in Qt: FreeCAD takes a number with PySide2, flags with PySide6, where flags are
    no numbers."""
    flags = QtGui.QDialogButtonBox.NoButton
    for name in names:
        flags |= getattr(QtGui.QDialogButtonBox, name)
    try:
        return int(flags)
    except TypeError:
        return flags


def do(text: str) -> None:
    """Runs a line of Python so that macros record it."""
    FreeCADGui.doCommand(text)


def path_of(obj) -> str:
    """A document object in Python's spelling."""
    return f"App.getDocument({obj.Document.Name!r}).getObject({obj.Name!r})"


def links_text(links) -> str:
    """Links to faces, edges, vertices in Python's spelling."""
    return "[" + ", ".join(f"({path_of(target)}, {tuple(names) if not isinstance(names, str) else (names,)!r})"
                           for target, names in links) + "]"


@contextmanager
def transaction(document, name: str):
    """One step of undo; whatever is raised inside takes it back."""
    document.openTransaction(name)
    try:
        yield
    except BaseException:
        document.abortTransaction()
        raise
    document.commitTransaction()
