# SPDX-License-Identifier: GPL-3.0-or-later
"""What FreeCAD's window adds to the document objects. The user interface registers it here, since this package does not depend on
the user interface and works without a window."""

from typing import Any, Callable, Optional

import FreeCAD

_load: Optional[Callable[[], Any]] = None


def use(load: Callable[[], Any]) -> None:
    """Registers the function that gives gui/views.py. It is called when an object is made while FreeCAD has a window."""
    global _load
    _load = load


def window() -> Any:
    """The functions of gui/views.py; None without a window."""
    return _load() if FreeCAD.GuiUp and _load is not None else None
