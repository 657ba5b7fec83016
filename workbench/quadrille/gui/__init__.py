# SPDX-License-Identifier: GPL-3.0-or-later
"""The windows of the workbench: commands, task panels, view provider. Loaded only when FreeCAD has a window."""

from pathlib import Path

import FreeCAD
import FreeCADGui
from PySide import QtGui

ICONS = Path(__file__).resolve().parents[2] / "icons"


def icon(name: str) -> str:
    """The path of an icon of ours."""
    return str(ICONS / f"{name}.svg")


def tell(text: str, title: str = "Quadrille") -> None:
    """Tells the user what went wrong, in a box and in the report view."""
    FreeCAD.Console.PrintError(f"{title}: {text}\n")
    QtGui.QMessageBox.warning(FreeCADGui.getMainWindow(), title, text)
