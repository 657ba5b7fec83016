# SPDX-License-Identifier: GPL-3.0-or-later
"""Quad meshes of triangle meshes, under the names that saved documents refer to. See features/surfaces.py; scripts use
quadrille.freecad.mesh_surface()."""

from . import window
from .features.surfaces import Asked, SurfaceMesh, asked_of

__all__ = ["Asked", "SurfaceMesh", "asked_of"]

window.join()
