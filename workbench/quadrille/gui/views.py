# SPDX-License-Identifier: GPL-3.0-or-later
"""How the document objects get their views and their progress bar in FreeCAD's window, see features/views.py."""


def show_mesh(mesh) -> None:
    """Gives a mesh of a part its view."""
    from .view_provider import MeshViewProvider

    MeshViewProvider(mesh.ViewObject)


def show_surface_mesh(mesh) -> None:
    """Gives a mesh of a mesh object its view, and hides the mesh object."""
    from .surface_view import SurfaceViewProvider

    SurfaceViewProvider(mesh.ViewObject)
    mesh.Surface.ViewObject.hide()


def show_middle(middle) -> None:
    """Gives a middle surface its view, and hides its part."""
    from .middle_view import MiddleViewProvider

    MiddleViewProvider(middle.ViewObject)
    middle.Source.ViewObject.hide()


def progress_bar_for(part):
    """The progress bar for the search for a part's middle surface."""
    from . import middle_view

    return middle_view.progress_bar_for(part)
