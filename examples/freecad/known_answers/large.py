# SPDX-License-Identifier: GPL-3.0-or-later
"""Problems with large displacements (Sze, Liu and Lo 2004, Finite Elements in Analysis and Design 40, 1551-1569)."""

import math

import numpy as np
import Part
from FreeCAD import Vector

from .shapes import joined
from .solver import Problem, displacements, solve, work


class EndShear:
    """A clamped strip with a shear force of 2 at its end, which raises the end by half the strip's length."""

    reference, sizes, size, tolerance = 4.933, (0.5, 0.33, 0.25, 0.2), 0.5, 1.0
    length, width = 10.0, 1.0

    def shape(self):
        return Part.makePlane(self.length, self.width)

    def answer(self, mesh):
        problem = Problem(1.2e6, 0.0, 0.1)
        problem.fix(mesh.where(lambda p: p[:, 0]), 1, 2, 3, 4, 5, 6)
        end = mesh.where(lambda p: p[:, 0] - self.length)
        loads = mesh.edge_load(end, lambda point, normal: (0, 0, 1 / self.width))
        problem.load({node: 2 * force for node, force in loads.items()})
        problem.increments = (0.1, 1e-5, 0.2)
        return work(loads, displacements(solve(mesh, problem)[0], len(mesh.points)))


class SlitAnnulus:
    """A slit annular plate: one lip is clamped, the other lifted by a line load. The answer is the rise of the lip's outer end
    under a tenth of the paper's largest load. The lips are a hundredth of a degree apart, so that their nodes can be
    distinguished."""

    reference, sizes, size, tolerance = 5.876, (2.0, 1.6, 1.33, 1.0), 1.33, 1.0
    inner, outer, gap = 6.0, 10.0, 0.01
    force = 0.8 / 10

    def shape(self):
        faces = []
        for quarter in range(4):
            line = Part.makeLine(Vector(self.inner, 0, 0), Vector(self.outer, 0, 0))
            line.rotate(Vector(), Vector(0, 0, 1), quarter * (360 - self.gap) / 4)
            faces.append(line.revolve(Vector(), Vector(0, 0, 1), (360 - self.gap) / 4))
        return joined(faces)

    def answer(self, mesh):
        problem = Problem(21e6, 0.0, 0.03)
        angle = -math.radians(self.gap)
        clamped = mesh.where(lambda p: p[:, 1] + 1e3 * (p[:, 0] < 0))
        lifted = mesh.where(lambda p: p[:, 1] * math.cos(angle) - p[:, 0] * math.sin(angle) + 1e3 * (p[:, 0] < 0))
        problem.fix(clamped, 1, 2, 3, 4, 5, 6)
        problem.load(mesh.edge_load(lifted, lambda point, normal: (0, 0, self.force)))
        problem.increments = (0.1, 1e-6, 1)
        found = displacements(solve(mesh, problem)[0], len(mesh.points))
        return found[mesh.at(self.outer * math.cos(angle), self.outer * math.sin(angle), 0), 2]


class PulledCylinder:
    """An open cylinder, pulled apart by two forces at mid-length. The answer is the displacement at one of them, under a tenth
    of the paper's largest force."""

    reference, sizes, size, tolerance = 1.707, (1.6, 1.3, 1.0, 0.8), 1.3, 2.5
    radius, half = 4.953, 10.35 / 2
    force = 40000 / 10

    def shape(self):
        r, s = self.radius, self.radius / math.sqrt(2)
        faces = []
        for quarter in range(4):
            edge = Part.Arc(Vector(r, 0, 0), Vector(s, s, 0), Vector(0, r, 0)).toShape()
            edge.rotate(Vector(), Vector(0, 0, 1), 90 * quarter)
            faces += [edge.extrude(Vector(0, 0, side * self.half)) for side in (-1, 1)]
        return joined(faces)

    def answer(self, mesh):
        problem = Problem(10.5e6, 0.3125, 0.094)
        r = self.radius
        top, bottom, right, left = (mesh.at(*point) for point in ((0, r, 0), (0, -r, 0), (r, 0, 0), (-r, 0, 0)))
        # The supports fix displacements that are zero by symmetry, so they have no reaction forces.
        problem.fix(np.array([top, bottom]), 1)
        problem.fix(np.array([right, left]), 2)
        problem.fix(np.array([top, bottom, right, left]), 3)
        problem.load({top: (0, self.force, 0), bottom: (0, -self.force, 0)})
        problem.increments = (0.05, 1e-6, 0.2)
        found = displacements(solve(mesh, problem)[0], len(mesh.points))
        return (found[top, 1] - found[bottom, 1]) / 2
