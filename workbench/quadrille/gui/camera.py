# SPDX-License-Identifier: GPL-3.0-or-later
"""Moves the camera of the 3-D view to places on a mesh."""

import math

import FreeCAD
import FreeCADGui
import numpy as np

from ..document.picks import placement_of

#: What takes a smaller share of the window's height cannot be recognized.
_LEAST_SHARE = 0.04


def _view_of(mesh):
    view = FreeCADGui.getDocument(mesh.Document.Name).ActiveView
    return view if hasattr(view, "getCameraNode") else None


def look_at(mesh, center, reach: float, normal=None) -> None:
    """Shows a place of a mesh so that the window is about as high as `reach`, in the mesh's coordinates.

    Args:
        normal: where to look from; None = the direction of the view stays.
    """
    view = _view_of(mesh)
    if view is None:
        return
    from pivy import coin

    camera, placed = view.getCameraNode(), placement_of(mesh)
    center = np.array(placed.multVec(FreeCAD.Vector(*center)))
    if normal is None:
        camera.position.setValue(coin.SbVec3f(*(center - reach * np.array(view.getViewDirection()))))
    else:
        normal = np.array(placed.Rotation.multVec(FreeCAD.Vector(*normal)))
        camera.position.setValue(coin.SbVec3f(*(center + reach * normal)))
        camera.pointAt(coin.SbVec3f(*center), coin.SbVec3f(0, 0, 1) if abs(normal[2]) < 0.9 else coin.SbVec3f(0, 1, 0))
    camera.focalDistance.setValue(reach)
    if hasattr(camera, "height"):
        camera.height.setValue(reach)


def is_in_sight(mesh, center, length: float) -> bool:
    """Whether a place is in the window, and something of this length there is not far smaller than the window."""
    view = _view_of(mesh)
    if view is None:
        return True
    camera = view.getCameraNode()
    at = placement_of(mesh).multVec(FreeCAD.Vector(*center))
    across, up = view.getPointOnScreen(at)
    width, height = view.getSize()
    if not (0 <= across < width and 0 <= up < height):
        return False
    if hasattr(camera, "height"):
        seen = camera.height.getValue()
    else:
        distance = (at - FreeCAD.Vector(*camera.position.getValue().getValue())).Length
        seen = 2 * distance * math.tan(camera.heightAngle.getValue() / 2)
    return length > _LEAST_SHARE * seen
