# SPDX-License-Identifier: GPL-3.0-or-later
"""The middle surface of a thin part, for scripts, and under the names that saved documents refer to.

    import quadrille.middle
    middle = quadrille.middle.make_middle(App.ActiveDocument.Body, analysis=App.ActiveDocument.Analysis)
    mesh = quadrille.freecad.mesh_object(middle, size=3.0, analysis=App.ActiveDocument.Analysis)

It is made in features/middle.py. Runs inside FreeCAD."""

from . import window
from .features.middle import (MiddleSurface, add_thicknesses, counterparts, is_middle, is_partly_thin, looks_thin, make_middle,
                              move_references, prepare, referring_to, thickness_objects)

__all__ = ["MiddleSurface", "add_thicknesses", "counterparts", "is_middle", "is_partly_thin", "looks_thin",
           "make_middle", "move_references",
           "prepare", "referring_to", "thickness_objects"]

window.join()
