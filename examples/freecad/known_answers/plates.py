# SPDX-License-Identifier: GPL-3.0-or-later
"""Plates: plane stress, bending, vibration and buckling."""

import math

import numpy as np
import Part
from FreeCAD import Vector

from .shapes import joined
from .solver import SURFACES, Problem, factors, solve, stress_at, stresses


class EllipticMembrane:
    """NAFEMS LE1: a quarter of an elliptic ring under outward pressure. The answer is the stress at its inner end (MPa)."""

    reference, sizes, size, tolerance = 92.7, (0.5, 0.3, 0.2, 0.12, 0.07), 0.07, 1.0

    def shape(self):
        def quarter(a, b):
            along_x, along_y = (Vector(), a, b), (Vector(0, b, 0), Vector(-a, 0, 0), Vector())
            ellipse = Part.Ellipse(*(along_x if a > b else along_y))
            start = 0 if a > b else -math.pi / 2
            return ellipse.toShape(start, start + math.pi / 2)

        inner, outer = quarter(2.0, 1.0), quarter(3.25, 2.75)
        lines = [Part.makeLine(Vector(2, 0, 0), Vector(3.25, 0, 0)), Part.makeLine(Vector(0, 1, 0), Vector(0, 2.75, 0))]
        return Part.Face(Part.Wire(Part.__sortEdges__([inner, outer, *lines])))

    def problem(self, mesh):
        problem = Problem(210e3, 0.3, 0.1, plane=True)
        problem.fix(mesh.where(lambda p: p[:, 0]), 1)
        problem.fix(mesh.where(lambda p: p[:, 1]), 2)
        outer = mesh.where(lambda p: (p[:, 0] / 3.25) ** 2 + (p[:, 1] / 2.75) ** 2 - 1)
        problem.load(mesh.edge_load(outer, lambda point, normal: 10 * 0.1 * normal))
        return problem

    def answer(self, mesh):
        return stresses(solve(mesh, self.problem(mesh))[1], len(mesh.points))[mesh.at(2, 0, 0), 1]


class PlateWithHole:
    """A hole in an infinite plate under tension: the stress at its flank is 3.0. A quarter is meshed, with Kirsch's tractions
    on its outer sides."""

    reference, sizes, size, tolerance = 3.0, (0.6, 0.4, 0.25, 0.15, 0.1), 0.1, 1.0
    side = 4.0
    thickness = 0.01  # small, since CalculiX's plane elements have a stiffness across the thickness where strains vary
    corners = ((1, 0, 0), (4, 0, 0), (0, 4, 0), (0, 1, 0))

    def shape(self):
        square = Part.makePlane(self.side, self.side)
        return square.cut(Part.Face(Part.Wire(Part.makeCircle(1.0)))).Faces[0]

    @staticmethod
    def kirsch(point):
        """The exact stresses for tension 1 along x and radius 1."""
        r, t = math.hypot(point[0], point[1]), math.atan2(point[1], point[0])
        a2, a4 = 1 / r**2, 1 / r**4
        xx = 1 - a2 * (1.5 * math.cos(2 * t) + math.cos(4 * t)) + 1.5 * a4 * math.cos(4 * t)
        yy = -a2 * (0.5 * math.cos(2 * t) - math.cos(4 * t)) - 1.5 * a4 * math.cos(4 * t)
        xy = -a2 * (0.5 * math.sin(2 * t) + math.sin(4 * t)) + 1.5 * a4 * math.sin(4 * t)
        return xx, yy, xy

    def problem(self, mesh):
        def traction(point, normal):
            xx, yy, xy = self.kirsch(point)
            return self.thickness * np.array((xx * normal[0] + xy * normal[1], xy * normal[0] + yy * normal[1], 0.0))

        problem = Problem(1000.0, 0.3, self.thickness, plane=True)
        problem.fix(mesh.where(lambda p: p[:, 0]), 1)
        problem.fix(mesh.where(lambda p: p[:, 1]), 2)
        for axis in (0, 1):
            problem.load(mesh.edge_load(mesh.where(lambda p, axis=axis: p[:, axis] - self.side), traction))
        return problem

    def answer(self, mesh):
        return stresses(solve(mesh, self.problem(mesh))[1], len(mesh.points))[mesh.at(0, 1, 0), 0]


class SkewPlate:
    """NAFEMS LE6: a rhombus of 30 degrees under pressure, simply supported. The answer is the largest principal stress at the
    bottom of its middle (MPa). At the obtuse corners the moments are infinite, so the answer converges slowly."""

    reference, sizes, size, tolerance = 0.802, (0.125, 0.0833, 0.0625, 0.0417, 0.03), 0.03, 2.0
    thickness = 0.01

    def shape(self):
        along, across = Vector(1, 0, 0), Vector(math.cos(math.pi / 6), 0.5, 0)

        def rhombus(start):
            corners = [start, start + along * 0.5, start + (along + across) * 0.5, start + across * 0.5, start]
            return Part.Face(Part.makePolygon(corners))

        return joined([rhombus(along * a + across * b) for a in (0, 0.5) for b in (0, 0.5)])

    def answer(self, mesh):
        problem = Problem(210e3, 0.3, self.thickness)
        edges = mesh.where(lambda p: np.minimum(np.abs(p[:, 1]), np.abs(p[:, 1] - 0.5)))
        slant = mesh.where(lambda p: np.minimum(np.abs(p[:, 0] - p[:, 1] * math.sqrt(3)),
                                                np.abs(p[:, 0] - 1 - p[:, 1] * math.sqrt(3))))
        problem.fix(np.union1d(edges, slant), 3)
        problem.fix(mesh.at(0, 0, 0), 1, 2)
        problem.fix(mesh.at(1, 0, 0), 2)
        problem.load(mesh.surface_load((0, 0, -0.7e-3)))
        middle = ((1 + math.cos(math.pi / 6)) / 2, 0.25)
        xx, yy, _, xy, _, _ = stress_at(solve(mesh, problem, output=SURFACES)[1], (*middle, -self.thickness / 2))
        return (xx + yy) / 2 + math.hypot((xx - yy) / 2, xy)


class SupportedPlate:
    """A simply supported rectangular plate."""

    a, b, thickness, young, poisson, density = 10.0, 8.0, 0.05, 2e5, 0.3, 8e-9

    def stiffness(self):
        """The bending stiffness of the plate."""
        return self.young * self.thickness**3 / 12 / (1 - self.poisson**2)

    def shape(self):
        return Part.makePlane(self.a, self.b)

    def problem(self, mesh):
        problem = Problem(self.young, self.poisson, self.thickness, density=self.density)
        for distance in (lambda p: p[:, 0], lambda p: p[:, 0] - self.a, lambda p: p[:, 1],
                         lambda p: p[:, 1] - self.b):
            problem.fix(mesh.where(distance), 3)
        return problem


class Modes(SupportedPlate):
    """The first four frequencies of the plate. The answer is their worst ratio to Kirchhoff's (1 is exact)."""

    reference, sizes, size, tolerance = 1.0, (2.5, 1.6, 1.0, 0.7, 0.5), 0.5, 1.0

    def exact(self):
        """Kirchhoff's first four frequencies in Hz."""
        root = math.sqrt(self.stiffness() / (self.density * self.thickness))
        return sorted(math.pi / 2 * (m * m / self.a**2 + n * n / self.b**2) * root
                      for m in range(1, 6) for n in range(1, 6))[:4]

    def frequencies(self, mesh):
        """CalculiX's first four frequencies in Hz."""
        problem = self.problem(mesh)
        problem.fix(mesh.at(0, 0, 0), 1, 2)
        problem.fix(mesh.at(self.a, 0, 0), 2)
        problem.step = "*FREQUENCY\n4"
        return factors(solve(mesh, problem)[0], 3)[:4]

    def answer(self, mesh):
        ratios = np.array(self.frequencies(mesh)) / self.exact()
        return 1 + float(ratios[np.argmax(np.abs(ratios - 1))] - 1)  # the worst of the four


class Buckling(SupportedPlate):
    """The buckling load of the plate under compression along x, as a ratio to Kirchhoff's."""

    reference, sizes, size, tolerance = 1.0, (2.5, 1.6, 1.0, 0.7, 0.5), 0.5, 1.0

    def answer(self, mesh):
        problem = self.problem(mesh)
        middle = 1  # half waves along x
        ratio = self.a / self.b
        exact = min((m / ratio + ratio / m) ** 2 for m in range(middle, 6)) * math.pi**2 * self.stiffness() / self.b**2
        problem.fix(mesh.at(0, 0, 0), 1, 2)
        problem.fix(mesh.at(self.a, 0, 0), 2)
        for x in (0.0, self.a):
            problem.load(mesh.edge_load(mesh.where(lambda p, x=x: p[:, 0] - x), lambda point, normal: -normal))
        problem.step = "*BUCKLE\n1"
        return factors(solve(mesh, problem)[0], 1)[0] / exact
