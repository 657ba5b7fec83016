# SPDX-License-Identifier: GPL-3.0-or-later
"""Structured grids on CAD whose faces have three or four sides, as one would make them by hand, for comparison."""

import math

import numpy as np
from FreeCAD import Vector

from .solver import Mesh


def grid(shape, size, corners=()):
    """A grid of eight-node quads, as a Mesh.

    The nodes of a face are blended between its sides (Coons patch) and projected to its surface. Opposite sides have the same
    number of elements, about length / `size`. A face with three sides is made of three grids that meet in its middle.
    `corners`: for a shape of one face with more edges, the points that count as its corners. Raises RuntimeError if a face
    has another number of sides."""
    sides = [_sides(face, corners) for face in shape.Faces]
    counts = _counts(shape.Edges, sides, size)
    nodes, elements = _Nodes(1e-5 * size), []
    for face, around in zip(shape.Faces, sides):
        lines = [_line(side, counts) for side in around]
        for patch in _patches(face, lines):
            points = _blend(face, patch)
            elements += _elements(nodes.numbers(points), not _along(face, points))
    return Mesh({number: point for number, point in enumerate(nodes.points, 1)}, elements)


def _sides(face, corners):
    """The edges of each side, in boundary order: lists of (edge, whether it runs against the boundary)."""
    wire = face.OuterWire
    around = [(edge, edge.Orientation == "Reversed") for edge in wire.OrderedEdges if not edge.Degenerated]
    if corners:
        starts = [i for i, (edge, _) in enumerate(around)
                  if any(_start(around[i]).isEqual(Vector(*corner), 1e-6) for corner in corners)]
        around = around[starts[0]:] + around[:starts[0]]
        starts = [start - starts[0] for start in starts] + [len(around)]
        found = [around[a:b] for a, b in zip(starts, starts[1:])]
    else:
        found = [[step] for step in around]
    if len(face.Wires) != 1 or len(found) not in (3, 4):
        raise RuntimeError(f"a face has {len(found)} sides; a grid needs three or four")
    return found


def _start(step):
    edge, against = step
    return edge.valueAt(edge.LastParameter if against else edge.FirstParameter)


def _counts(edges, sides, size):
    """The number of elements on each edge, by the edge's hash code: the largest number among the edges tied to it."""
    edges = list(edges)
    place = {edge.hashCode(): i for i, edge in enumerate(edges)}
    ties = list(range(len(edges)))

    def root(i):
        while ties[i] != i:
            i = ties[i]
        return i

    longest = max(len(side) for around in sides for side in around)
    for around in sides:
        for one, other in ([(around[0], around[2]), (around[1], around[3])] if len(around) == 4
                           else [(around[0], around[1]), (around[1], around[2])]):
            for edge, _ in one + other:
                ties[root(place[edge.hashCode()])] = root(place[one[0][0].hashCode()])
    halves = longest if longest > 1 else 2 if any(len(around) == 3 for around in sides) else 1
    wanted = {}
    for i, edge in enumerate(edges):
        wanted[root(i)] = max(wanted.get(root(i), 1), math.ceil(edge.Length / size - 0.2))
    return {code: halves * math.ceil(wanted[root(i)] / halves) for code, i in place.items()}


def _line(side, counts):
    """The points of a side with n elements, including midside nodes: (2 n + 1, 3). A side's elements are divided evenly among
    its edges."""
    points = []
    for edge, against in side:
        share = counts[edge.hashCode()] if len(side) == 1 else max(1, max(counts[e.hashCode()] for e, _ in side) // len(side))
        found = [tuple(point) for point in edge.discretize(2 * share + 1)]
        head = Vector(*found[0]).distanceToPoint(_start((edge, against)))
        tail = Vector(*found[-1]).distanceToPoint(_start((edge, against)))
        points += (found[::-1] if tail < head else found)[1 if points else 0:]
    return np.array(points)


def _patches(face, lines):
    """Four-sided patches, each as four lines: bottom, right, top and left. They run from left to right, or from bottom to top."""
    if len(lines) == 4:
        return [(lines[0], lines[1], lines[2][::-1], lines[3][::-1])]
    middles = [len(line) // 2 for line in lines]
    center = _on(face, np.mean([line[0] for line in lines], axis=0))
    spokes = [np.array([_on(face, line[middle] + (center - line[middle]) * t) for t in np.linspace(0, 1, middle + 1)])
              for line, middle in zip(lines, middles)]
    return [(lines[i][:middles[i] + 1], spokes[i], spokes[i - 1], lines[i - 1][middles[i - 1]:][::-1])
            for i in range(3)]


def _on(face, point):
    """The point of a face's surface nearest to a point."""
    surface = face.Surface
    return np.array(surface.value(*surface.parameter(Vector(*point))))


def _blend(face, patch):
    """The Coons patch between four lines, with its inner points on the surface: (m, n, 3)."""
    bottom, right, top, left = patch
    s = np.linspace(0, 1, len(bottom))[None, :, None]
    t = np.linspace(0, 1, len(left))[:, None, None]
    points = ((1 - t) * bottom[None] + t * top[None] + (1 - s) * left[:, None] + s * right[:, None]
              - (1 - s) * (1 - t) * bottom[0] - s * (1 - t) * bottom[-1] - (1 - s) * t * top[0] - s * t * top[-1])
    for i in range(1, points.shape[0] - 1):
        for j in range(1, points.shape[1] - 1):
            points[i, j] = _on(face, points[i, j])
    return points


def _along(face, points):
    """Whether the normals of a grid's elements point in the same direction as the face's."""
    i, j = (points.shape[0] // 4) * 2, (points.shape[1] // 4) * 2
    normal = np.cross(points[i, j + 1] - points[i, j], points[i + 1, j] - points[i, j])
    return float(normal @ np.array(face.normalAt(*face.Surface.parameter(Vector(*points[i, j]))))) > 0


class _Nodes:
    """A list of points without duplicates."""

    def __init__(self, tolerance):
        self.points, self._known, self._tolerance = [], {}, tolerance

    def numbers(self, points):
        """The node numbers, from 1, of a grid of points; 0 for the points in the middle of elements, which have no node."""
        found = np.zeros(points.shape[:2], dtype=int)
        for i, j in np.ndindex(*found.shape):
            if not (i % 2 and j % 2):
                found[i, j] = self._number(points[i, j])
        return found

    def _number(self, point):
        cell = tuple(np.floor(point / (4 * self._tolerance)).astype(int))
        for step in np.ndindex(3, 3, 3):
            for number in self._known.get(tuple(np.add(cell, step) - 1), ()):
                if np.linalg.norm(self.points[number - 1] - point) < self._tolerance:
                    return number
        self.points.append(np.array(point))
        self._known.setdefault(cell, []).append(len(self.points))
        return len(self.points)


def _elements(numbers, turned):
    """The eight-node quads of a grid of node numbers: corners, then midside nodes. turned: reverses their orientation."""
    ring = ((0, 0), (0, 2), (2, 2), (2, 0), (0, 1), (1, 2), (2, 1), (1, 0))
    if turned:
        ring = ((0, 0), (2, 0), (2, 2), (0, 2), (1, 0), (2, 1), (1, 2), (0, 1))
    return [[int(numbers[i + a, j + b]) for a, b in ring]
            for i in range(0, numbers.shape[0] - 2, 2) for j in range(0, numbers.shape[1] - 2, 2)]
