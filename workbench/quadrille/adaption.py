# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes that follow their results, for scripts.

    import quadrille.adaption
    quadrille.adaption.adapt(App.ActiveDocument.QuadMesh, error=0.03)

See features/adaption.py. Runs inside FreeCAD."""

from . import window
from .features.adaption import Estimate, adapt, estimate, last_result, last_step, prepare

__all__ = ["Estimate", "adapt", "estimate", "last_result", "last_step", "prepare"]

window.join()
