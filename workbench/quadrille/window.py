# SPDX-License-Identifier: GPL-3.0-or-later
"""Registers the user interface with the features, for scripts that import the facades while FreeCAD has a window."""

from .features import views


def join() -> None:
    """Registers the views of the user interface, which is loaded when they are first needed."""
    views.use(_views)


def _views():
    from .gui import views as of_window

    return of_window
