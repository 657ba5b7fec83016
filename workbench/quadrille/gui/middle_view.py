# SPDX-License-Identifier: GPL-3.0-or-later
"""How a middle surface appears in the tree. Saved documents refer to MiddleViewProvider by name: do not move it."""

from . import icon, progress_bar, translate


def progress_bar_for(part):
    """The progress bar for the search for a part's middle surface."""
    return progress_bar(translate("Quadrille", "Finding the middle surface of {}...").format(part.Label))


class MiddleViewProvider:
    """The view provider of our middle surfaces."""

    def __init__(self, vobj) -> None:
        vobj.Proxy = self

    def attach(self, vobj) -> None:
        """FreeCAD calls this when the object gets its view."""
        self.Object = vobj.Object

    def getIcon(self) -> str:
        """The icon of the command Middle surface."""
        return icon("quadrille_middle")

    def dumps(self):
        """Nothing to save."""
        return None

    def loads(self, _state) -> None:
        """Nothing to restore."""

    __getstate__ = dumps
    __setstate__ = loads
