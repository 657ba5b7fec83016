# SPDX-License-Identifier: GPL-3.0-or-later
"""Imports the modules that the first panel needs when a workbench is activated, not when the panel opens: the panel's own, and
those of FreeCAD's solvers, which take some tenths of a second."""

import importlib
from typing import List

import FreeCADGui
from PySide import QtCore

from ..solvers import wrappers

_WORKBENCHES = ("FemWorkbench", "QuadrilleWorkbench")


class _Reader:
    """Imports one module at a time whenever the window is idle."""

    def __init__(self) -> None:
        self._modules: List[str] = ["quadrille.gui.task_panel", *dict.fromkeys(module for module, _, _ in wrappers.WRAPPED)]
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
        except ImportError:  # wrap_solvers() reports what is missing
            pass


_reader = None


def join() -> None:
    """Starts this; further calls do nothing."""
    global _reader
    if _reader is None:
        _reader = _Reader()
