# SPDX-License-Identifier: GPL-3.0-or-later
"""Patch tests: a constant strain or curvature on the border must be reproduced inside."""

import numpy as np
import Part
from FreeCAD import Vector

from .shapes import joined
from .solver import Problem, border_nodes, displacements, solve


class MembranePatch:
    """The membrane patch test: a constant strain on the border must be reproduced inside, on any mesh. The answer is the largest
    displacement error, relative to the largest displacement."""

    reference, sizes, size, tolerance = 0.0, (3, 2, 1.3, 0.9, 0.6), 1.3, None
    absolute = 1e-6

    def shape(self):
        points = [Vector(0, 0, 0), Vector(10, 1, 0), Vector(12, 7, 0), Vector(2, 9, 0), Vector(0, 0, 0)]
        return Part.Face(Part.makePolygon(points))

    def answer(self, mesh):
        def field(points):
            return 1e-3 * np.stack([points[:, 0] + 0.5 * points[:, 1], 0.5 * points[:, 0] + points[:, 1]], axis=1)

        problem = Problem(1e6, 0.25, 0.1, plane=True)
        border = border_nodes(mesh)
        exact = field(mesh.points)
        for axis in (0, 1):
            problem.fix(border, axis + 1, value=exact[border, axis])
        found = displacements(solve(mesh, problem)[0], len(mesh.points))[:, :2]
        return float(np.abs(found - exact).max() / np.abs(exact).max())


class SkewBendingPatch:
    """The bending patch test: constant curvatures along x, along y and in twist, prescribed on the border by deflection and
    rotations, must be reproduced inside. Poisson's ratio is 0, because CalculiX keeps a shell's thickness constant at nodes
    with prescribed rotations. There are three skew strips of different widths, so the elements are parallelograms of three
    shapes. The answer is the largest error over three shell elements, relative to the largest deflection."""

    reference, sizes, size, tolerance = 0.0, (3, 2, 1.3, 0.9, 0.6), 1.3, None
    absolute = 1e-6
    strips = True
    shells = ("S8R", "S8", "S4")
    curvatures = (1e-3, 0.4e-3, 0.6e-3)  # xx, yy, xy

    def shape(self):
        along, across = Vector(10, 1, 0), Vector(3, 6, 0)
        ends = (0.0, 0.3, 0.45, 1.0)
        return joined([Part.Face(Part.makePolygon([along * a, along * b, along * b + across, along * a + across,
                                                   along * a])) for a, b in zip(ends, ends[1:])])

    def answer(self, mesh):
        quads = all(len(element) == 8 for element in mesh.elements)
        return max(self.error(mesh, shell) for shell in self.shells if quads or shell != "S4")

    def error(self, mesh, shell):
        """The largest error of the deflection inside, with one kind of shell element."""
        xx, yy, xy = self.curvatures
        x, y = mesh.points[:, 0], mesh.points[:, 1]
        exact = (xx * x * x + yy * y * y) / 2 + xy * x * y
        nodes = {node for element in mesh.elements for node in (element[:4] if shell in ("S4", "S4R") else element)}
        border = np.array([node for node in border_nodes(mesh) if node in nodes])
        problem = Problem(1e6, 0.0, 0.2)
        for freedom, value in ((3, exact), (4, yy * y + xy * x), (5, -(xx * x + xy * y))):
            problem.fix(border, freedom, value=value[border])
        problem.fix(border[0], 1, 2)
        problem.fix(border[len(border) // 2], 2)
        found = displacements(solve(mesh, problem, shell)[0], len(mesh.points))
        inside = np.array(sorted(nodes - set(border)))
        return float(np.abs(found[inside, 2] - exact[inside]).max() / np.abs(exact).max())


class QuadrangleBendingPatch(SkewBendingPatch):
    """The same on a quadrangle without parallel sides: its mapped elements are parallelograms to within 5 %."""

    shells = ("S8R", "S8")

    def shape(self):
        return MembranePatch().shape()


class CutBendingPatch(SkewBendingPatch):
    """The same on a rectangle cut by three lines, whose elements are far from parallelograms."""

    def shape(self):
        plate = Part.makePlane(10, 4)
        cuts = [Part.makeLine(Vector(*a), Vector(*b))
                for a, b in (((4, 0), (6, 4)), ((0, 1), (10, 2.8)), ((8, 0), (7, 4)))]
        return Part.makeShell(plate.generalFuse(cuts, 0.0)[0].Faces)


class BendingPatch:
    """A plate strip in four-line bending, with Poisson's ratio 0: the curvature between the supports is constant. Skew lines
    distort the mesh. The answer is the worst ratio of a node's deflection between the supports to the exact one."""

    reference, sizes, size, tolerance = 1.0, (2.5, 1.6, 1.0, 0.7, 0.4), 0.4, 0.1
    length, width, thickness, arm = 10.0, 4.0, 0.2, 2.0

    def shape(self):
        plate = Part.makePlane(self.length, self.width)
        cuts = [Part.makeLine(Vector(x, 0, 0), Vector(x + skew, self.width, 0))
                for x, skew in ((self.arm, 0), (self.length - self.arm, 0), (4.0, 2.0))]
        parts, _ = plate.generalFuse(cuts, 0.0)
        return Part.makeShell(parts.Faces)

    def answer(self, mesh):
        force, young = 1e-3, 1e6
        problem = Problem(young, 0.0, self.thickness)
        supports = [mesh.where(lambda p, x=x: p[:, 0] - x) for x in (self.arm, self.length - self.arm)]
        for support in supports:
            problem.fix(support, 3)
        problem.fix(mesh.at(self.arm, 0, 0), 1, 2)
        problem.fix(mesh.at(self.length - self.arm, 0, 0), 2)
        for x in (0.0, self.length):
            problem.load(mesh.edge_load(mesh.where(lambda p, x=x: p[:, 0] - x), lambda point, normal: (0, 0, -force)))
        span = self.length - 2 * self.arm
        curvature = force * self.arm / (young * self.thickness**3 / 12)
        found = displacements(solve(mesh, problem)[0], len(mesh.points))
        inside = (mesh.points[:, 0] > self.arm + 0.5) & (mesh.points[:, 0] < self.length - self.arm - 0.5)
        x = mesh.points[inside, 0] - self.arm
        ratios = found[inside, 2] / (curvature * x * (span - x) / 2)
        return float(ratios[np.argmax(np.abs(ratios - 1))])  # the worst node
