# SPDX-License-Identifier: GPL-3.0-or-later
"""FreeCAD's mesh regions: faces, edges or vertices of a part to mesh at their own size. Runs inside FreeCAD."""

from ..core.errors import Error
from ..core.units import millimeters
from . import shapes, translate
from .state import shape_of


def check_references(mesh, references) -> None:
    """Raises Error if references are not in the part of a mesh object."""
    shapes.references_to_names(shape_of(mesh.Shape), mesh.Shape, references)


def refine(mesh, references, size, name: str = "Refinement"):
    """Adds one of FreeCAD's mesh regions to a mesh object: faces, edges or vertices to mesh at their own size.

    Args:
        mesh: a mesh object of this addon.
        references: [(document object, ("Face3", "Edge4"))...], in the form of FEM's References.
        size: element size there, in mm or with a unit.
    """
    import ObjectsFem

    if not references or not any(names for _, names in references):
        raise Error(translate("Quadrille", "select the faces, edges or vertices to refine"), "usage", mesh.Name)
    length = millimeters(size)
    if not length > 0:
        raise Error(translate(
            "Quadrille", "a refinement needs a size larger than 0, not {}").format(size), "usage", mesh.Name)
    check_references(mesh, references)  # raises now, not when meshing
    region = ObjectsFem.makeMeshRegion(mesh.Document, mesh, length, name)
    region.References = references
    return region
