# SPDX-License-Identifier: GPL-3.0-or-later
"""The user interface of the workbench: commands, task panels, view providers. Loaded only if FreeCAD has a window."""

from contextlib import contextmanager
from pathlib import Path

import FreeCAD
import FreeCADGui
from PySide import QtGui

from ..core.errors import QT_TRANSLATE_NOOP, translate  # noqa: F401
from ..document.shapes import pairs

_FOLDER = Path(__file__).resolve().parents[2]
ICONS = _FOLDER / "icons"
TRANSLATIONS = _FOLDER / "translations"


def icon(name: str) -> str:
    """The path of an icon of this addon."""
    return str(ICONS / f"{name}.svg")


def drawn_icon(name: str) -> QtGui.QIcon:
    """An icon of this addon for Qt's widgets. FreeCAD draws it, since Qt's own plugin for SVG may not be installed."""
    return FreeCADGui.getIcon(icon(name))


def tell(text: str, title: str = "Quadrille") -> None:
    """Shows an error in a message box and in the report view."""
    FreeCAD.Console.PrintError(f"{title}: {text}\n")
    QtGui.QMessageBox.warning(FreeCADGui.getMainWindow(), title, text)


def tell_briefly(text: str) -> None:
    """Shows a message in FreeCAD's status line for ten seconds."""
    FreeCADGui.getMainWindow().statusBar().showMessage(text, 10000)


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
    return "[" + ", ".join(f"({path_of(entry[0])}, {tuple(name for _, name in pairs([entry]))!r})" for entry in links) + "]"


@contextmanager
def progress_bar(text: str, busy: bool = False):
    """Shows a progress bar with a Cancel button. Yields the function that a job calls with its progress. busy: the progress is not known,
    and the bar only moves."""
    bar = QtGui.QProgressDialog(text, translate("Quadrille", "Cancel"), 0, 0 if busy else 100, FreeCADGui.getMainWindow())
    bar.setWindowTitle("Quadrille")
    bar.setModal(True)  # only the bar accepts clicks meanwhile
    bar.setMinimumDuration(500)
    if busy:
        bar.show()  # otherwise a value would show it

    def show(_stage: str, fraction: float) -> bool:
        if not busy:
            bar.setValue(min(99, int(100 * fraction)))  # at 100 the bar would close
        QtGui.QApplication.processEvents()
        return not bar.wasCanceled()

    try:
        yield show
    finally:
        bar.close()
        bar.deleteLater()


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
