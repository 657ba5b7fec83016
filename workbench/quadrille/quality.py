# SPDX-License-Identifier: GPL-3.0-or-later
"""The quality of each quad of a FEM mesh, by NumPy. Runs inside FreeCAD."""

from itertools import chain
from typing import Dict, NamedTuple

import numpy as np


class ElementQuality(NamedTuple):
    """Measures of the quads of a mesh; the arrays run in step."""

    ids: np.ndarray  #: element ids
    q: np.ndarray  #: 1 = all corners right-angled, 0 = useless
    scaled_jacobian: np.ndarray  #: least of the corners
    aspect: np.ndarray  #: longest edge / shortest edge
    corners: np.ndarray  #: (n, 4, 3)
    centres: np.ndarray  #: (n, 3)
    normals: np.ndarray  #: (n, 3), of length 1
    lengths: np.ndarray  #: mean edge length

    def worst(self, count: int = 20) -> np.ndarray:
        """Indices of the elements with the least q, the worst first."""
        return np.argsort(self.q, kind="stable")[:count]

    def summary(self) -> Dict[str, float]:
        """What the result table shows."""
        return {
            "quads": int(self.ids.size),
            "q_min": float(self.q.min()),
            "q_mean": float(self.q.mean()),
            "sj_min": float(self.scaled_jacobian.min()),
            "sj_mean": float(self.scaled_jacobian.mean()),
            "aspect_max": float(self.aspect.max()),
        }


def measure(fem_mesh) -> ElementQuality:
    """Measures the corner quads of a FEM mesh; midside nodes are left out."""
    nodes = fem_mesh.Nodes
    points = np.zeros((max(nodes, default=0) + 1, 3))
    coordinates = chain.from_iterable(map(tuple, nodes.values()))
    points[list(nodes)] = np.fromiter(coordinates, float, 3 * len(nodes)).reshape(-1, 3)
    ids = np.array(fem_mesh.Faces, dtype=int)
    elements = list(map(fem_mesh.getElementNodes, fem_mesh.Faces))
    sizes = np.fromiter(map(len, elements), int, len(elements))
    flat = np.fromiter(chain.from_iterable(elements), int, int(sizes.sum()))
    quads = np.isin(sizes, (4, 8))
    starts = (np.cumsum(sizes) - sizes)[quads]
    return _measure(ids[quads], points[flat[starts[:, None] + np.arange(4)]])


def _measure(ids: np.ndarray, corners: np.ndarray) -> ElementQuality:
    """corners: (n, 4, 3)."""
    out = np.roll(corners, -1, axis=1) - corners  # edge from each corner to the next
    back = np.roll(corners, 1, axis=1) - corners
    lengths = np.linalg.norm(out, axis=2)
    safe = np.maximum(lengths, 1e-300)
    products = safe * np.roll(safe, 1, axis=1)
    normals = np.cross(corners[:, 2] - corners[:, 0], corners[:, 3] - corners[:, 1])
    normals /= np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-300)
    crosses = np.cross(out, back)
    sines = np.einsum("nij,nj->ni", crosses, normals) / products
    cosines = np.einsum("nij,nij->ni", out, back) / products
    angles = np.arccos(np.clip(cosines, -1.0, 1.0))
    angles = np.where(sines < 0, 2 * np.pi - angles, angles)  # a concave corner
    q = np.maximum(0.0, 1.0 - 2.0 / np.pi * np.abs(np.pi / 2 - angles).max(axis=1))
    centres = corners.mean(axis=1)
    aspect = lengths.max(axis=1) / np.maximum(lengths.min(axis=1), 1e-300)
    return ElementQuality(ids, q, sines.min(axis=1), aspect, corners, centres, normals,
                          lengths.mean(axis=1))


def colours(values: np.ndarray) -> np.ndarray:
    """Quality in [0, 1] as (n, 3) red, green and blue: red through yellow to blue."""
    stops = np.array([0.0, 0.25, 0.5, 0.75, 1.0])
    table = np.array([(0.84, 0.10, 0.11), (0.99, 0.68, 0.38), (1.0, 1.0, 0.75), (0.67, 0.85, 0.91), (0.17, 0.48, 0.71)])
    return np.stack([np.interp(values, stops, table[:, k]) for k in range(3)], axis=1)
