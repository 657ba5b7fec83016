# SPDX-License-Identifier: GPL-3.0-or-later
"""The search for a part's middle surface before anything is changed, for the command and for the panel's hint."""

from typing import Callable, Dict

import FreeCADGui
from PySide import QtGui

from ..core.errors import Error
from ..features import middle
from . import translate


def ask(question: str) -> bool:
    """Asks a yes-or-no question in a message box."""
    buttons = QtGui.QMessageBox.Yes | QtGui.QMessageBox.No
    return QtGui.QMessageBox.question(FreeCADGui.getMainWindow(), "Quadrille", question, buttons) == QtGui.QMessageBox.Yes


def find(part, options: Dict[str, bool], agreed: Callable[[str], bool] = ask) -> None:
    """Does the long work. Sets options["partial"] if the user agrees to that. What has been found already is not searched again.
    Raises Error if there is no middle surface, or the search is cancelled."""
    if not options and middle.is_prepared(part, partial=True):
        options["partial"] = True
    if middle.is_prepared(part, **options):
        return
    try:
        middle.prepare(part, **options)
    except Error as error:
        if not middle.is_partly_thin(error) or not agreed(
                translate("Quadrille", "{}. Use the walls that could be paired?").format(error)):
            raise
        options["partial"] = True
        middle.prepare(part, **options)
