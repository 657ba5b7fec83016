# SPDX-License-Identifier: GPL-3.0-or-later
"""Quadrille inside FreeCAD: all-quad FEM mesh objects.

    import quadrille.freecad
    mesh = quadrille.freecad.mesh_object(App.ActiveDocument.Part, size=2.0, order=2, analysis=analysis)

The shape goes to the `quadrille` command as a BREP file, and the mesh comes back as a UNV file with its groups. The mesher
runs as a child process: it can neither freeze nor crash FreeCAD, and works with any build of FreeCAD.
"""

from typing import Optional

from .core import freecad_modules

freecad_modules.find()

from . import window  # noqa: E402
from .core.command import Progress  # noqa: E402
from .core.errors import Error  # noqa: E402
from .core.jobs import PREFERENCES, ShapeJob, find_mesher, read_mesh  # noqa: E402
from .core.units import millimeters  # noqa: E402
from .document.regions import refine  # noqa: E402
from .document.state import UP_TO_DATE, complaint  # noqa: E402
from .features import surfaces  # noqa: E402
from .features.mesh_object import (MeshFeature, check_part, export, finish, flip, fragments, make_mesh, mesh_object,  # noqa: E402
                                   remesh, start, suggested_size)
from .solvers.results import make_analysis  # noqa: E402

__all__ = [
    "Error", "MeshFeature", "PREFERENCES", "ShapeJob", "UP_TO_DATE", "check_part", "complaint", "export", "find_mesher",
    "finish", "flip", "fragments", "make_analysis", "make_mesh", "mesh_object", "mesh_surface", "read_mesh", "refine", "remesh", "start",
    "suggested_size",
]

window.join()


def mesh_surface(surface, size: Optional[float] = None, order: int = 2, feature_angle: float = 40, merge: float = 0,
                 name: str = "QuadMesh", analysis=None, progress: Optional[Progress] = None, command: Optional[str] = None):
    """Remeshes a triangle mesh object of FreeCAD, such as a scan or an STL file, with quads (`quadrille remesh`).

    Args:
        surface: a Mesh::Feature.
        size: element length in mm, or with a unit ("2 cm"); None = 1/60 of the surface's diagonal.
        order: 2 for eight-node quads, 1 for four-node quads.
        feature_angle: neighboring triangles whose normals differ by at least this angle belong to different faces, degrees;
            0 = the whole surface is one face.
        merge: nodes at most this far apart are merged, in mm or with a unit; 0 = only coincident nodes.
        name, analysis, progress, command: as for mesh_object().

    Returns:
        a Fem::FemMeshObjectPython whose `Surface` links to the mesh object. Its groups are named Face1..., Edge1...,
        Vertex1.... remesh() and export() accept it.

    Raises:
        Error: with one sentence; the document is then unchanged.
    """
    asked = surfaces.Asked(size=millimeters(size or 0), order=order, feature_angle=feature_angle, merge=millimeters(merge))
    return surfaces.make(surface, asked, name, analysis, progress, command)
