# SPDX-License-Identifier: GPL-3.0-or-later
"""Beams made of shells."""

import math

import numpy as np
import Part
from FreeCAD import Vector

from .shapes import joined
from .solver import Problem, displacements, solve, stresses, work


class TwistedBeamInPlane:
    """A strip twisted by 90 degrees, clamped, with a force of 1 at its tip along its width (MacNeal and Harder 1985)."""

    reference, sizes, size, tolerance = 5.424e-3, (1.0, 0.55, 0.37, 0.275), 0.37, 1.0
    length, width, thickness = 12.0, 1.1, 0.32
    direction = (0, 0, 1)

    def shape(self):
        def side(sign):
            points = []
            for i in range(25):
                x, angle = self.length * i / 24, math.pi / 2 * i / 24
                points.append(Vector(x, sign * self.width / 2 * math.cos(angle),
                                     sign * self.width / 2 * math.sin(angle)))
            curve = Part.BSplineCurve()
            curve.interpolate(points)
            return curve.toShape()

        return Part.makeRuledSurface(side(-1), side(1))

    def answer(self, mesh):
        problem = Problem(29e6, 0.22, self.thickness)
        problem.fix(mesh.where(lambda p: p[:, 0]), 1, 2, 3, 4, 5, 6)
        tip = mesh.where(lambda p: p[:, 0] - self.length)
        loads = mesh.edge_load(tip, lambda point, normal: np.array(self.direction) / self.width)
        problem.load(loads)
        return work(loads, displacements(solve(mesh, problem)[0], len(mesh.points)))


class TwistedBeamOutOfPlane(TwistedBeamInPlane):
    """The same beam, loaded along the thickness at its tip."""

    reference, direction = 1.754e-3, (0, 1, 0)


class CurvedBeamInPlane:
    """A quarter of a ring, clamped, with a shear force of 1 at its tip in its plane (MacNeal and Harder 1985: 0.08734).
    The reference is the exact displacement of plane stress (Timoshenko and Goodier, Theory of Elasticity, 33)."""

    sizes, size, tolerance = (0.2, 0.1, 0.067, 0.05), 0.1, 1.0
    inner, outer, thickness, young = 4.12, 4.32, 0.1, 1e7
    direction = (1, 0, 0)

    @property
    def reference(self):
        a2, b2 = self.inner**2, self.outer**2
        slope = a2 - b2 + (a2 + b2) * math.log(self.outer / self.inner)
        return math.pi * (a2 + b2) / (self.young * self.thickness * slope)

    def shape(self):
        def arc(radius):
            return Part.Arc(Vector(radius, 0, 0), Vector(radius / math.sqrt(2), radius / math.sqrt(2), 0),
                            Vector(0, radius, 0)).toShape()

        lines = [Part.makeLine(Vector(self.inner, 0, 0), Vector(self.outer, 0, 0)),
                 Part.makeLine(Vector(0, self.inner, 0), Vector(0, self.outer, 0))]
        return Part.Face(Part.Wire(Part.__sortEdges__([arc(self.inner), arc(self.outer), *lines])))

    def answer(self, mesh):
        problem = Problem(self.young, 0.25, self.thickness)
        problem.fix(mesh.where(lambda p: p[:, 0]), 1, 2, 3, 4, 5, 6)
        share = np.array(self.direction) / (self.outer - self.inner)
        loads = mesh.edge_load(mesh.where(lambda p: p[:, 1]), lambda point, normal: share)
        problem.load(loads)
        return work(loads, displacements(solve(mesh, problem)[0], len(mesh.points)))


class CurvedBeamOutOfPlane(CurvedBeamInPlane):
    """The same beam, with the shear force out of its plane: bending and torsion."""

    reference, tolerance, direction = 0.5022, 2.5, (0, 0, 1)


class ZSection:
    """NAFEMS LE5: a clamped Z section, twisted by shears on its flanges. The answer is the axial stress at a flange (MPa)."""

    reference, sizes, size, tolerance = -108.0, (1.0, 0.5, 0.33, 0.25), 0.33, 3.0
    length, half, flange, thickness = 10.0, 1.0, 1.0, 0.1
    station = 2.5

    def shape(self):
        outline = [Vector(0, -self.flange, -self.half), Vector(0, 0, -self.half), Vector(0, 0, self.half),
                   Vector(0, self.flange, self.half)]
        faces = []
        for a, b in zip(outline, outline[1:]):
            edge = Part.makeLine(a, b)
            faces.append(edge.extrude(Vector(self.station, 0, 0)))
            edge.translate(Vector(self.station, 0, 0))
            faces.append(edge.extrude(Vector(self.length - self.station, 0, 0)))
        return joined(faces)

    def answer(self, mesh):
        problem = Problem(210e3, 0.3, self.thickness)  # MN and m
        problem.fix(mesh.where(lambda p: p[:, 0]), 1, 2, 3)
        for side in (-1, 1):
            end = mesh.where(lambda p, side=side: np.abs(p[:, 0] - self.length) + np.abs(p[:, 2] - side * self.half))
            problem.load(mesh.edge_load(end, lambda point, normal, side=side: (0, side * 0.6 / self.flange, 0)))
        found = stresses(solve(mesh, problem)[1], len(mesh.points))
        return found[mesh.at(self.station, self.flange, self.half), 0]


class TJoint:
    """A sheet clamped at both ends, with a stem on its middle that is pushed sideways. The answer is the displacement at the
    force, as a ratio to that of a frame of Timoshenko beams. Poisson's ratio is 0, so that a wide sheet bends like a beam."""

    reference, sizes, size, tolerance = 1.0, (2.0, 1.0, 0.67, 0.5), 0.5, 1.0
    arm, height, width, thickness, young = 4.0, 3.0, 2.0, 0.1, 1e5

    def shape(self):
        across = Vector(0, self.width, 0)
        ends = (Vector(-self.arm, 0, 0), Vector(self.arm, 0, 0), Vector(0, 0, self.height))
        return joined([Part.makeLine(Vector(), end).extrude(across) for end in ends])

    def exact(self):
        """The displacement of the frame under a force of 1."""
        area, bending = self.young * self.width * self.thickness, self.young * self.width * self.thickness**3 / 12
        shear = 5 / 6 * area / 2
        slip = 12 * bending / (shear * self.arm**2)
        turning = 2 * 4 * bending / self.arm * (1 + slip / 4) / (1 + slip)
        return (self.height**3 / (3 * bending) + self.height / shear + self.height**2 / turning
                + self.arm / (2 * area))

    def answer(self, mesh):
        problem = Problem(self.young, 0.0, self.thickness)
        problem.fix(mesh.where(lambda p: np.abs(p[:, 0]) - self.arm), 1, 2, 3, 4, 5, 6)
        loads = mesh.edge_load(mesh.where(lambda p: p[:, 2] - self.height),
                               lambda point, normal: (1 / self.width, 0, 0))
        problem.load(loads)
        return work(loads, displacements(solve(mesh, problem)[0], len(mesh.points))) / self.exact()
