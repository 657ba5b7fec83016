# SPDX-License-Identifier: GPL-3.0-or-later
"""What the first panel needs is read from disk when a workbench is chosen, not when the panel opens: modules of FreeCAD's
solvers, which take some tenths of a second."""

import importlib
from typing import List

import FreeCADGui
from PySide import QtCore

from .. import solvers

_WORKBENCHES = ("FemWorkbench", "QuadrilleWorkbench")


class _Reader:
    """Imports a module whenever the window has nothing else to do."""

    def __init__(self) -> None:
        self._modules: List[str] = ["quadrille.gui.task_panel", *dict.fromkeys(module for module, _, _ in solvers.WRAPPED)]
        self._timer = QtCore.QTimer()
        self._timer.setInterval(0)
        self._timer.timeout.connect(self._next)
        FreeCADGui.getMainWindow().workbenchActivated.connect(self._begin)

    def _begin(self, workbench: str) -> None:
        if workbench in _WORKBENCHES and self._modules:
            self._timer.start()

    def _next(self) -> None:
        if not self._modules:
            self._timer.stop()
            return
        try:
            importlib.import_module(self._modules.pop(0))
        except ImportError:  # wrap_solvers() tells what is missing without it
            pass


_reader = None


def join() -> None:
    """From now on, once."""
    global _reader
    if _reader is None:
        _reader = _Reader()
