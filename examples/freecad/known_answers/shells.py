# SPDX-License-Identifier: GPL-3.0-or-later
"""Curved shells."""

import math

import numpy as np
import Part
from FreeCAD import Vector

from .shapes import joined
from .solver import Problem, displacements, factors, solve, work


class PinchedCylinder:
    """A cylinder between diaphragms, pinched by two forces of 1 (MacNeal and Harder 1985)."""

    reference, sizes, size, tolerance = 1.8248e-5, (50, 35, 25, 15), 8, 1.0
    radius, half = 300.0, 300.0

    def shape(self):
        arc = Part.Arc(Vector(self.radius, 0, 0), Vector(self.radius / math.sqrt(2), self.radius / math.sqrt(2), 0),
                       Vector(0, self.radius, 0))
        faces = []
        for quarter in range(4):
            edge = arc.toShape()
            edge.rotate(Vector(), Vector(0, 0, 1), 90 * quarter)
            faces += [edge.extrude(Vector(0, 0, side * self.half)) for side in (-1, 1)]
        return joined(faces)

    def pinched(self, mesh):
        return mesh.at(0, self.radius, 0), mesh.at(0, -self.radius, 0)

    def problem(self, mesh):
        problem = Problem(3e6, 0.3, 3.0)
        for end in (-self.half, self.half):
            problem.fix(mesh.where(lambda p, end=end: p[:, 2] - end), 1, 2)
        top, bottom = self.pinched(mesh)
        problem.fix(np.array([top, bottom]), 3)
        problem.load({top: (0, -1, 0), bottom: (0, 1, 0)})
        return problem

    def answer(self, mesh):
        top, bottom = self.pinched(mesh)
        found = displacements(solve(mesh, self.problem(mesh))[0], len(mesh.points))
        return (found[bottom, 1] - found[top, 1]) / 2


class GradedPinchedCylinder(PinchedCylinder):
    """The same with a tenth of the size at the forces, from where it grows."""

    sizes, size = (80, 60, 40, 30), 30
    refined, share = ((0.0, 300.0, 0.0), (0.0, -300.0, 0.0)), 0.1


class Hemisphere:
    """A hemisphere with a hole of 18 degrees, pulled and pushed at its equator (MacNeal and Harder 1985)."""

    reference, sizes, size, tolerance = 0.0940, (2.5, 1.6, 1.0, 0.65, 0.45), 0.65, 1.0
    radius = 10.0

    def shape(self):
        top = math.radians(72)
        arc = Part.Arc(Vector(self.radius, 0, 0),
                       Vector(self.radius * math.cos(top / 2), 0, self.radius * math.sin(top / 2)),
                       Vector(self.radius * math.cos(top), 0, self.radius * math.sin(top)))
        faces = []
        for quarter in range(4):
            edge = arc.toShape()
            edge.rotate(Vector(), Vector(0, 0, 1), 90 * quarter)
            faces.append(edge.revolve(Vector(), Vector(0, 0, 1), 90))
        return joined(faces)

    def answer(self, mesh):
        problem = Problem(6.825e7, 0.3, 0.04)
        r, top = self.radius, math.radians(72)
        pulled, pushed = (mesh.at(r, 0, 0), mesh.at(-r, 0, 0)), (mesh.at(0, r, 0), mesh.at(0, -r, 0))
        # The supports fix displacements that are zero by symmetry, so they have no reaction forces.
        problem.fix(np.array([*pulled, mesh.at(r * math.cos(top), 0, r * math.sin(top))]), 2)
        problem.fix(np.array([pushed[0], mesh.at(0, r * math.cos(top), r * math.sin(top))]), 1)
        problem.fix(pulled[0], 3)
        problem.load({pulled[0]: (2, 0, 0), pulled[1]: (-2, 0, 0), pushed[0]: (0, -2, 0), pushed[1]: (0, 2, 0)})
        found = displacements(solve(mesh, problem)[0], len(mesh.points))
        return (found[pulled[0], 0] - found[pulled[1], 0]) / 2


class ClosedHemisphere:
    """NAFEMS LE3: a hemisphere without a hole, pulled and pushed at its equator. The answer is the displacement (m)."""

    reference, sizes, size, tolerance = 0.185, (2.5, 1.6, 1.0, 0.7), 1.0, 1.0
    radius = 10.0

    def shape(self):
        arc = Part.Arc(Vector(self.radius, 0, 0), Vector(self.radius / math.sqrt(2), 0, self.radius / math.sqrt(2)),
                       Vector(0, 0, self.radius))
        faces = []
        for quarter in range(4):
            edge = arc.toShape()
            edge.rotate(Vector(), Vector(0, 0, 1), 90 * quarter)
            faces.append(edge.revolve(Vector(), Vector(0, 0, 1), 90))
        return joined(faces)

    def answer(self, mesh):
        problem = Problem(68.25e3, 0.3, 0.04)  # MN and m
        r, force = self.radius, 4e-3  # twice the force of the quarter model
        pulled, pushed = (mesh.at(r, 0, 0), mesh.at(-r, 0, 0)), (mesh.at(0, r, 0), mesh.at(0, -r, 0))
        pole = mesh.at(0, 0, r)
        problem.fix(np.array([*pulled, pole]), 2)
        problem.fix(np.array([pushed[0], pole]), 1)
        problem.fix(pole, 3)
        problem.load({pulled[0]: (force, 0, 0), pulled[1]: (-force, 0, 0),
                      pushed[0]: (0, -force, 0), pushed[1]: (0, force, 0)})
        found = displacements(solve(mesh, problem)[0], len(mesh.points))
        return (found[pulled[0], 0] - found[pulled[1], 0]) / 2


class Hook:
    """Raasch's hook: a strip of two arcs, clamped at one end, with a shear force along its width at the other. The reference was
    computed with solid elements (Knight 1997, AIAA Journal 35, 375-381)."""

    reference, sizes, size, tolerance = 4.9352, (10, 6.6, 5, 3.3, 2), 5, 1.5
    small, large, width = 14.0, 46.0, 20.0

    def shape(self):
        """The small arc runs upward from the clamped end at the origin; the large arc continues it, bent the other way."""
        def arc(center, radius, start, end):
            points = [center + Vector(math.cos(a), math.sin(a), 0) * radius
                      for a in (math.radians(start), math.radians((start + end) / 2), math.radians(end))]
            return Part.Arc(*points).toShape()

        first = Vector(self.small, 0, 0)
        joint = first + Vector(-math.cos(math.pi / 3), math.sin(math.pi / 3), 0) * self.small
        outward = (joint - first).normalize()
        second = joint + outward * self.large
        edges = [arc(first, self.small, 180, 120), arc(second, self.large, 300, 450)]
        return joined([edge.extrude(Vector(0, 0, self.width)) for edge in edges])

    def answer(self, mesh):
        problem = Problem(3300.0, 0.35, 2.0)
        problem.fix(mesh.where(lambda p: np.hypot(p[:, 0], p[:, 1])), 1, 2, 3, 4, 5, 6)
        away = Vector(self.small, 0, 0) + Vector(-0.5, math.sin(math.pi / 3), 0) * (self.small + self.large)
        tip = mesh.where(lambda p: np.hypot(p[:, 0] - away.x, p[:, 1] - away.y - self.large))
        loads = mesh.edge_load(tip, lambda point, normal: (0, 0, 1 / self.width))
        problem.load(loads)
        return work(loads, displacements(solve(mesh, problem)[0], len(mesh.points)))


class CylinderModes:
    """The first eight frequencies of a cylinder between diaphragms. The answer is their worst ratio to thin-shell theory."""

    reference, sizes, size, tolerance = 1.0, (0.5, 0.33, 0.25, 0.17, 0.125), 0.125, 1.0
    radius, length, thickness, young, poisson, density = 1.0, 2.0, 0.01, 1e6, 0.3, 1.0

    def shape(self):
        edges = []
        for quarter in range(4):
            edge = Part.Arc(Vector(1, 0, 0), Vector(math.sqrt(0.5), math.sqrt(0.5), 0), Vector(0, 1, 0)).toShape()
            edge.rotate(Vector(), Vector(0, 0, 1), 90 * quarter)
            edges.append(edge)
        return joined([edge.extrude(Vector(0, 0, side * self.length / 2)) for edge in edges for side in (-1, 1)])

    def stiffness(self, m, n):
        """The stiffness (3, 3) against u = U cos(ax) cos(ny), v = V sin(ax) sin(ny), w = W sin(ax) cos(ny), m half waves along and
        n waves around, over the area; and a."""
        r, nu = self.radius, self.poisson
        plane = np.array([[1, nu, 0], [nu, 1, 0], [0, 0, (1 - nu) / 2]]) * self.young * self.thickness / (1 - nu * nu)
        a = m * math.pi / self.length
        strain = np.array([[-a, 0, 0], [0, n / r, 1 / r], [-n / r, a, 0]])
        bend = np.array([[0, 0, a * a], [0, n / r**2, n * n / r**2], [n / (2 * r * r), 1.5 * a / r, 2 * a * n / r]])
        return strain.T @ plane @ strain + self.thickness**2 / 12 * bend.T @ plane @ bend, a

    def exact(self):
        """The frequencies in Hz by Sanders' theory (Leissa, Vibration of Shells, NASA SP-288, 1973): energies are quadratic in
        (U, V, W)."""
        mass = self.density * self.thickness
        found = [math.sqrt(np.linalg.eigvalsh(self.stiffness(m, n)[0])[0] / mass) / (2 * math.pi)
                 for m in (1, 2, 3) for n in range(1, 12)]
        return np.repeat(sorted(found)[:4], 2)  # each occurs twice, rotated by a quarter wave

    def answer(self, mesh):
        problem = Problem(self.young, self.poisson, self.thickness, density=self.density)
        for end in (-self.length / 2, self.length / 2):
            problem.fix(mesh.where(lambda p, end=end: p[:, 2] - end), 1, 2)
        problem.fix(mesh.at(self.radius, 0, 0), 3)  # a mode with one half wave does not move axially here
        problem.step = "*FREQUENCY\n8"
        ratios = np.array(factors(solve(mesh, problem)[0], 3)[:8]) / self.exact()
        return float(ratios[np.argmax(np.abs(ratios - 1))])
