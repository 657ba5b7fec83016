# SPDX-License-Identifier: GPL-3.0-or-later
"""Mesh objects of documents that older versions wrote. 0.1.0 kept faces, sizes and flips as texts, and the status as any
text. Runs inside FreeCAD."""

from typing import Dict, List

from . import links, state

#: Properties that had another type, and the one they have now.
_TYPES = {"Faces": links.PROPERTY, "FlippedFaces": links.PROPERTY, "Status": "App::PropertyEnumeration"}


def migrate(mesh) -> None:
    """Gives a mesh object that was just read the properties of this version, with the same meaning."""
    # Those that are missing altogether, add_properties() adds.
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


def sizes_of(mesh) -> Dict[float, List[str]]:
    """The faces, edges and vertices by size that a mesh object of 0.1.0 names itself. FreeCAD lets nothing be made while a
    document is read, so they stay until mesh_regions() makes mesh regions of them."""
    by_size: Dict[float, List[str]] = {}
    if "Sizes" in mesh.PropertiesList:
        for element, size in mesh.Sizes.items():
            by_size.setdefault(float(size), []).append(element)
    return by_size


def mesh_regions(mesh) -> None:
    """Makes mesh regions of the sizes that a mesh object of 0.1.0 names itself."""
    from .freecad import refine

    by_size = sizes_of(mesh)
    if "Sizes" in mesh.PropertiesList:
        mesh.removeProperty("Sizes")
    for size, elements in by_size.items():
        refine(mesh, links.link(mesh.Shape, elements), size)
