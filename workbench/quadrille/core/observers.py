# SPDX-License-Identifier: GPL-3.0-or-later
"""Document observers. Each class is registered with FreeCAD only once."""

from typing import Set

import FreeCAD

_watching: Set[type] = set()


def watch(observer: type, *arguments) -> None:
    """Registers an observer of this class, made with these arguments, for all documents. Further calls do nothing."""
    if observer not in _watching:
        _watching.add(observer)
        FreeCAD.addDocumentObserver(observer(*arguments))
