# SPDX-License-Identifier: GPL-3.0-or-later
"""Document observers, each of which FreeCAD gets once."""

from functools import lru_cache

import FreeCAD


@lru_cache(maxsize=None)
def watch(observer: type) -> None:
    """Lets an observer of this class, made without arguments, watch all documents from now on."""
    FreeCAD.addDocumentObserver(observer())
