# SPDX-License-Identifier: GPL-3.0-or-later
"""The user interface of the workbench: commands, task panels, view providers. Loaded only if FreeCAD has a window."""

from contextlib import contextmanager
from pathlib import Path

import FreeCAD
import FreeCADGui
from PySide import QtGui

_FOLDER = Path(__file__).resolve().parents[2]
ICONS = _FOLDER / "icons"
TRANSLATIONS = _FOLDER / "translations"

translate = FreeCAD.Qt.translate


def QT_TRANSLATE_NOOP(_context: str, text: str) -> str:  # Qt's tools look for this name
    """Marks a text for translation and returns it unchanged."""
    return text


def icon(name: str) -> str:
    """The path of an icon of this addon."""
    return str(ICONS / f"{name}.svg")


def tell(text: str, title: str = "Quadrille") -> None:
    """Tells the user what went wrong, in a message box and in the report view."""
    FreeCAD.Console.PrintError(f"{title}: {text}\n")
    QtGui.QMessageBox.warning(FreeCADGui.getMainWindow(), title, text)


def standard_buttons(*names: str):
    """Buttons of a task panel, by their names in Qt. FreeCAD expects a number with PySide2, and flags with PySide6, where flags
    cannot be converted to numbers."""
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
    """A Python expression for a document object."""
    return f"App.getDocument({obj.Document.Name!r}).getObject({obj.Name!r})"


def links_text(links) -> str:
    """A Python expression for links to faces, edges and vertices."""
    return "[" + ", ".join(f"({path_of(target)}, {tuple(names) if not isinstance(names, str) else (names,)!r})"
                           for target, names in links) + "]"


@contextmanager
def transaction(document, name: str):
    """Makes one undo step; an exception inside takes it back."""
    document.openTransaction(name)
    try:
        yield
    except BaseException:
        document.abortTransaction()
        raise
    document.commitTransaction()
