# SPDX-License-Identifier: GPL-3.0-or-later
"""Document observers. Each class is registered with FreeCAD only once."""

from functools import lru_cache

import FreeCAD


@lru_cache(maxsize=None)
def watch(observer: type) -> None:
    """Registers an observer of this class, made without arguments, for all documents. Further calls do nothing."""
    FreeCAD.addDocumentObserver(observer())
