# SPDX-License-Identifier: GPL-3.0-or-later
"""Mesh objects in documents of older versions. 0.1.0 stored faces, sizes and flips as text, and the status as free text.
Runs inside FreeCAD."""

from . import links, state
from .regions import refine

#: Properties that used to have another type, and their type now.
_TYPES = {"Faces": links.PROPERTY, "FlippedFaces": links.PROPERTY, "Status": "App::PropertyEnumeration"}


def migrate(mesh) -> None:
    """Converts the properties of a mesh object that was just read to this version's types, with the same meaning."""
    for name in ("Match", "Layers", "ProximityWalls"):  # options that the mesher no longer has
        if name in mesh.PropertiesList:
            mesh.removeProperty(name)
    # add_properties() adds those that are missing altogether.
    for name, kind in _TYPES.items():
        if name not in mesh.PropertiesList or mesh.getTypeIdOfProperty(name) == kind:
            continue
        value, group = getattr(mesh, name), mesh.getGroupOfProperty(name)
        text = mesh.getDocumentationOfProperty(name)
        mesh.removeProperty(name)
        mesh.addProperty(kind, name, group, text)
        if name == "Status":
            mesh.Status = list(state.STATUSES)
            mesh.Status = value if value in state.STATUSES else state.SENSELESS
        elif mesh.Shape is not None:
            setattr(mesh, name, links.link(mesh.Shape, value))


def mesh_regions(mesh) -> None:
    """Converts the sizes that a mesh object of 0.1.0 holds itself to mesh regions."""
    by_size = state.sizes_of(mesh)
    if "Sizes" in mesh.PropertiesList:
        mesh.removeProperty("Sizes")
    for size, elements in by_size.items():
        refine(mesh, links.link(mesh.Shape, elements), size)
