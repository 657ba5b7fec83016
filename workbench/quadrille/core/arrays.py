# SPDX-License-Identifier: GPL-3.0-or-later
"""Nodes and elements of FreeCAD's meshes as arrays. Runs inside FreeCAD."""

from itertools import chain
from operator import itemgetter
from typing import Dict, NamedTuple, Optional, Tuple

import numpy as np

_COORDINATES = itemgetter(0, 1, 2)  # of FreeCAD's vectors, which are slow to iterate


def nodes_of(fem_mesh, nodes: Optional[Dict] = None) -> Tuple[np.ndarray, np.ndarray]:
    """The ids (n,) and coordinates (n, 3) of a mesh's nodes. `nodes`: FreeCAD's `fem_mesh.Nodes` if already at hand, which is
    quicker."""
    nodes = fem_mesh.Nodes if nodes is None else nodes
    flat = chain.from_iterable(map(_COORDINATES, nodes.values()))
    return np.fromiter(nodes, int, len(nodes)), np.fromiter(flat, float, 3 * len(nodes)).reshape(-1, 3)


def faces_of(fem_mesh) -> Tuple[np.ndarray, np.ndarray, np.ndarray]:
    """The ids of a mesh's faces, the number of nodes of each, and the nodes of all faces, one face after another."""
    faces = fem_mesh.Faces
    elements = list(map(fem_mesh.getElementNodes, faces))
    sizes = np.fromiter(map(len, elements), int, len(elements))
    return np.array(faces, dtype=int), sizes, np.fromiter(chain.from_iterable(elements), int, int(sizes.sum()))


class Shells(NamedTuple):
    """A mesh whose faces all have four nodes, or all eight."""

    nodes: np.ndarray  #: (n,) ids, ascending
    points: np.ndarray  #: (n, 3) coordinates
    elements: np.ndarray  #: (m,) ids, ascending
    corners: np.ndarray  #: (m, 4 or 8) node ids, with midside nodes at second order

    def places(self, ids: np.ndarray) -> np.ndarray:
        """The positions of node ids in `nodes`."""
        return np.asarray(np.searchsorted(self.nodes, ids))


def shells_of(fem_mesh, nodes: Optional[Dict] = None) -> Optional[Shells]:
    """A mesh as shells; None if it has volumes, no faces, or faces that do not all have four nodes or all eight."""
    if fem_mesh.VolumeCount or not fem_mesh.FaceCount:
        return None
    faces, sizes, flat = faces_of(fem_mesh)
    if sizes[0] not in (4, 8) or (sizes != sizes[0]).any():
        return None
    numbers, points = nodes_of(fem_mesh, nodes)
    by_node, by_face = np.argsort(numbers, kind="stable"), np.argsort(faces, kind="stable")
    return Shells(numbers[by_node], points[by_node], faces[by_face], flat.reshape(-1, sizes[0])[by_face])
