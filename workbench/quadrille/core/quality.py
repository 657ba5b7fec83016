# SPDX-License-Identifier: GPL-3.0-or-later
"""The quality of each quad of a FEM mesh, computed with NumPy. Runs inside FreeCAD."""

from typing import Dict, NamedTuple, Sequence, Tuple

import numpy as np

from .arrays import faces_of, nodes_of
from .setting_table import TABLES

#: The industry criteria of the mesher: the value of a perfect square, and the usual limit. min_length has no usual limit, and
#: longer sides are never worse: see limits().
CRITERIA = {row["name"]: (np.inf, 0.0) if row["limit"] is None else (row["ideal"], row["limit"]) for row in TABLES["criteria"]}
#: A direction unrelated to any mesh, of at most unit length: along it, few separate nodes are close together.
_SLANTED = np.array([0.5271, 0.3817, 0.7590])


def limits(least_size: float = 0.0) -> Dict[str, Tuple[float, float]]:
    """CRITERIA for a mesh with this minimum size, in mm; 0 = not known, no side is too short."""
    return {**CRITERIA, "min_length": (np.inf, 0.5 * least_size)}


class ElementQuality(NamedTuple):
    """Measures of the quads of a mesh. Index i of each array belongs to the same quad."""

    ids: np.ndarray  #: element ids
    q: np.ndarray  #: 1 = all corners right-angled, 0 = useless
    scaled_jacobian: np.ndarray  #: smallest value at the corners
    aspect: np.ndarray  #: longest edge / shortest edge
    corners: np.ndarray  #: (n, 4, 3) coordinates of the corner nodes
    centers: np.ndarray  #: (n, 3)
    normals: np.ndarray  #: (n, 3) unit vectors
    lengths: np.ndarray  #: mean edge length
    criteria: Dict[str, np.ndarray]  #: values of the industry criteria, by name
    nodes: np.ndarray  #: (n, 4) ids of the corner nodes
    limits: Dict[str, Tuple[float, float]]  #: see limits()

    def free_sides(self) -> np.ndarray:
        """The end points of the sides that belong to only one element, (m, 2, 3)."""
        sides = np.stack([self.nodes, np.roll(self.nodes, -1, axis=1)], axis=2).reshape(-1, 2)
        ends = np.stack([self.corners, np.roll(self.corners, -1, axis=1)], axis=2).reshape(-1, 2, 3)
        _, first, counts = np.unique(np.sort(sides, axis=1), axis=0, return_index=True, return_counts=True)
        return ends[first[counts == 1]]

    def double_nodes(self) -> np.ndarray:
        """The places where two or more nodes coincide, (m, 3)."""
        if not self.nodes.size:
            return np.zeros((0, 3))
        points = self.corners.reshape(-1, 3)[np.unique(self.nodes, return_index=True)[1]]
        near = 1e-6 * float(np.ptp(points, axis=0).max())
        points = points[np.argsort(points @ _SLANTED)]
        along = points @ _SLANTED
        before, after = np.zeros(len(points), bool), np.zeros(len(points), bool)  # whether one coincides with another
        left, step = np.arange(len(points)), 0
        while left.size:  # those that may coincide with the one so many steps further along
            step += 1
            left = left[left + step < len(points)]
            left = left[along[left + step] - along[left] <= near]
            same = left[np.linalg.norm(points[left + step] - points[left], axis=1) <= near]
            after[same], before[same + step] = True, True
        return points[after & ~before]

    def goodness(self, measure: str = "q") -> np.ndarray:
        """A measure scaled for colors: q itself; for a criterion 1 at the ideal, 0.5 at the limit, 0 twice as far from the
        ideal."""
        if measure == "q":
            return self.q
        ideal, limit = self.limits[measure]
        if np.isinf(ideal):
            return np.clip(0.5 * self.criteria[measure] / max(limit, 1e-300), 0.0, 1.0)
        return np.clip(1 - 0.5 * (self.criteria[measure] - ideal) / (limit - ideal), 0.0, 1.0)

    def fails(self, criterion: str) -> np.ndarray:
        """A mask of the elements that are beyond the limit of a criterion."""
        ideal, limit = self.limits[criterion]
        values = self.criteria[criterion]
        return values > limit if limit > ideal else values < limit

    def worst(self, count: int = 20, measure: str = "q") -> np.ndarray:
        """The indices of the worst elements by a measure, the worst first."""
        values = self.q if measure == "q" else self.criteria[measure]
        if measure != "q" and self.limits[measure][1] > self.limits[measure][0]:
            values = -values
        return np.argsort(values, kind="stable")[:count]


def measure(fem_mesh, least_size: float = 0.0, finer: Sequence[int] = ()) -> ElementQuality:
    """Measures the quads of a FEM mesh by their corners; midside nodes are ignored. least_size: see limits(). finer: numbers,
    from 1, of the quads whose sides may be shorter, as the user asked."""
    numbers, places = nodes_of(fem_mesh)
    points = np.zeros((max(numbers, default=0) + 1, 3))
    points[numbers] = places
    ids, sizes, flat = faces_of(fem_mesh)
    quads = np.isin(sizes, (4, 8))
    starts = (np.cumsum(sizes) - sizes)[quads]
    corners = flat[starts[:, None] + np.arange(4)]
    measured = measure_quads(ids[quads], corners, points[corners], least_size)
    places = np.asarray(finer, int) - 1
    measured.criteria["min_length"][places[places < len(measured.ids)]] = np.inf
    return measured


def measure_quads(ids: np.ndarray, nodes: np.ndarray, corners: np.ndarray, least_size: float = 0.0) -> ElementQuality:
    """Measures quads. ids: (n,) element ids; nodes: (n, 4) ids of the corner nodes; corners: (n, 4, 3) their coordinates."""
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
    centers = corners.mean(axis=1)
    aspect = lengths.max(axis=1) / np.maximum(lengths.min(axis=1), 1e-300)
    return ElementQuality(ids, q, sines.min(axis=1), aspect, corners, centers, normals,
                          lengths.mean(axis=1), _criteria(corners, out, aspect), nodes, limits(least_size))


def _criteria(corners: np.ndarray, sides: np.ndarray, aspect: np.ndarray) -> Dict[str, np.ndarray]:
    """The values of CRITERIA, computed as in the mesher. corners, sides: (n, 4, 3); sides run from each corner to the next."""
    before = np.roll(sides, 1, axis=1)
    crosses = np.cross(before, sides)  # at each corner: twice the area vector of the corner's triangle
    normal = _unit(crosses.sum(axis=1))
    angles = np.degrees(np.arctan2(np.einsum("nij,nj->ni", crosses, normal), -np.einsum("nij,nij->ni", before, sides)))
    angles = np.where(angles < 0, angles + 360, angles)
    areas = np.linalg.norm(crosses, axis=2)
    a, b, c, d = np.moveaxis(corners, 1, 0)
    skew = _angle(c + d - a - b, d + a - b - c)
    facing = _unit(crosses[:, 1] + crosses[:, 3])
    gauss = 1 / np.sqrt(3.0)
    jacobians = np.stack([
        np.einsum("ni,ni->n", np.cross((1 - y) * sides[:, 0] - (1 + y) * sides[:, 2],
                                       (1 + x) * sides[:, 1] - (1 - x) * sides[:, 3]), facing)
        for x in (-gauss, gauss) for y in (-gauss, gauss)], axis=1)
    return {
        "aspect": aspect,
        "warp": np.maximum(_angle(crosses[:, 1], crosses[:, 3]), _angle(crosses[:, 0], crosses[:, 2])),
        "skew": 90 - np.minimum(skew, 180 - skew),
        "angle_min": angles.min(axis=1),
        "angle_max": angles.max(axis=1),
        "jacobian_ratio": jacobians.min(axis=1) / np.maximum(jacobians.max(axis=1), 1e-300),
        "taper": 1 - areas.min(axis=1) / np.maximum(areas.mean(axis=1), 1e-300),
        "min_length": np.linalg.norm(sides, axis=2).min(axis=1),
    }


def _unit(vectors: np.ndarray) -> np.ndarray:
    return vectors / np.maximum(np.linalg.norm(vectors, axis=1, keepdims=True), 1e-300)


def _angle(one: np.ndarray, other: np.ndarray) -> np.ndarray:
    """The angle between vectors, in degrees."""
    across = np.linalg.norm(np.cross(one, other), axis=1)
    return np.degrees(np.arctan2(across, np.einsum("ni,ni->n", one, other)))


def colors(values: np.ndarray) -> np.ndarray:
    """The colors of quality values in [0, 1], from red through yellow to blue: (n, 3) red, green and blue."""
    stops = np.array([0.0, 0.25, 0.5, 0.75, 1.0])
    table = np.array([(0.84, 0.10, 0.11), (0.99, 0.68, 0.38), (1.0, 1.0, 0.75), (0.67, 0.85, 0.91), (0.17, 0.48, 0.71)])
    return np.stack([np.interp(values, stops, table[:, k]) for k in range(3)], axis=1)
