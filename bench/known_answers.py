# SPDX-License-Identifier: GPL-3.0-or-later
"""Discs, Cook's membrane, an elliptic hole, a shoulder and a buckling cylinder, meshed by the command and by Gmsh, solved by
CalculiX: prints the errors at three sizes.

    scripts/freecad_python bench/known_answers.py [--build build] [--case NAME...]

Gmsh pairs triangles (Blossom) of twice the size and cuts each element into quads, so that all are quads of the requested
size, with the same number of elements on a circle and eight nodes each. Both meshes get the same loads and supports.
"""

import argparse
import math
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / "examples" / "freecad"))

import numpy as np
import Part
from FreeCAD import Vector
from scipy.optimize import brentq
from scipy.special import iv, ivp, jv, jvp

from known_answers.plates import PlateWithHole
from known_answers.shells import CylinderModes
from known_answers.solver import Mesh, Problem, displacements, factors, quad_shape, solve, stresses

THIN = PlateWithHole.thickness


def polygon(*corners):
    """A plane face."""
    return Part.Face(Part.makePolygon([Vector(*corner) for corner in (*corners, corners[0])]))


class Disc:
    """A disc of radius 100 and thickness 1 under pressure: the deflection of its middle over the exact one."""

    reference, sizes = 1.0, (10, 5, 2.5)
    radius, thickness, young, poisson, density, pressure = 100.0, 1.0, 2.1e5, 0.3, 7.85e-9, 1e-3
    stiffness = young * thickness**3 / 12 / (1 - poisson**2)
    held, factor = (3,), (5 + poisson) / (1 + poisson)  # simply supported

    def shape(self):
        return Part.Face(Part.Wire(Part.makeCircle(self.radius)))

    def exact(self):
        """Timoshenko and Woinowsky-Krieger, Theory of Plates and Shells, 16 and 20: bending plus shear deflection."""
        shear = self.young / 2 / (1 + self.poisson) * self.thickness * 5 / 6
        return self.pressure * self.radius**2 * (self.factor * self.radius**2 / 64 / self.stiffness + 1 / 4 / shear)

    def answer(self, mesh):
        problem = Problem(self.young, self.poisson, self.thickness)
        rim = mesh.where(lambda p: np.hypot(p[:, 0], p[:, 1]) - self.radius)
        problem.fix(rim, *self.held)
        problem.fix(mesh.at(self.radius, 0, 0), 1, 2)
        problem.fix(rim[mesh.points[rim, 0].argmin()], 2)
        problem.load(mesh.surface_load((0, 0, self.pressure)))
        return value_at((0, 0), mesh, displacements(solve(mesh, problem)[0], len(mesh.points))[:, 2]) / self.exact()


class ClampedDisc(Disc):
    """The same disc, clamped."""

    held, factor = (1, 2, 3, 4, 5, 6), 1.0


class FreeDisc(Disc):
    """The same disc, free: its first seven frequencies (three of them twice). The answer is their worst ratio to Kirchhoff's."""

    def exact(self):
        """Leissa, Vibration of Plates, NASA SP-160, 1969, equation 2.14."""
        def balance(x, n):
            bend, nu = n * n * (1 - self.poisson), 1 - self.poisson
            j, dj, i, di = jv(n, x), x * jvp(n, x), iv(n, x), x * ivp(n, x)
            return ((x * x * j + nu * dj - bend * j) * (x * x * di - bend * (di - i))
                    - (x * x * i - nu * di + bend * i) * (x * x * dj + bend * (dj - j)))

        roots = {n: brentq(balance, *span, args=(n,)) for n, span in {2: (2, 2.6), 0: (2.8, 3.2), 3: (3.2, 3.8), 1: (4.2, 4.8)}.items()}
        root = math.sqrt(self.stiffness / (self.density * self.thickness)) / self.radius**2 / (2 * math.pi)
        return np.array([roots[n]**2 * root for n in (2, 2, 0, 3, 3, 1, 1)])

    def answer(self, mesh):
        problem = Problem(self.young, self.poisson, self.thickness, density=self.density)
        problem.step = "*FREQUENCY\n14"
        exact = self.exact()
        found = np.array([hertz for hertz in factors(solve(mesh, problem)[0], 3) if hertz > exact[0] / 10])
        ratios = found[:7] / exact
        return float(ratios[np.abs(ratios - 1).argmax()])


class Cook:
    """Cook's membrane (Journal of the Structural Division ASCE 100, 1974, 1851-1863), sheared at its right end: how far the
    middle of that end moves up."""

    reference, sizes = 23.96, (4, 2, 1)

    def shape(self):
        return polygon((0, 0), (48, 44), (48, 60), (0, 44))

    def answer(self, mesh):
        problem = Problem(1.0, 1 / 3, THIN, plane=True)
        problem.fix(mesh.where(lambda p: p[:, 0]), 1, 2)
        problem.load(mesh.edge_load(mesh.where(lambda p: p[:, 0] - 48), lambda point, normal: (0, THIN / 16, 0)))
        return value_at((48, 52), mesh, displacements(solve(mesh, problem)[0], len(mesh.points))[:, 1])


class EllipticHole(PlateWithHole):
    """A hole with half axes 2 and 1 in an infinite plate, pulled across the long one: the stress at its end is 1 + 2 a/b. A
    quarter is meshed, with the exact tractions on its outer sides."""

    reference, sizes = 5.0, (0.5, 0.25, 0.125)
    long, short, side = 2.0, 1.0, 8.0

    def shape(self):
        ellipse = Part.Face(Part.Wire(Part.Ellipse(Vector(), self.long, self.short).toShape()))
        return Part.makePlane(self.side, self.side).cut(ellipse).Faces[0]

    def kirsch(self, point):
        """The exact stresses by Muskhelishvili's potentials on the outside of the unit circle, z = r (s + m/s):
        phi = r/4 (s - (2 + m)/s), psi = r/2 (s + 1/(m s) - (1 + m^2)(1 + m) s / (m (s^2 - m)))."""
        r, m = (self.long + self.short) / 2, (self.long - self.short) / (self.long + self.short)
        z = complex(point[0], point[1])
        s = (z + np.sqrt(z - 2 * r * math.sqrt(m)) * np.sqrt(z + 2 * r * math.sqrt(m))) / (2 * r)
        slope, second = r * (1 - m / s**2), 2 * r * m / s**3
        phi1, phi2 = r / 4 * (1 + (2 + m) / s**2), -r / 2 * (2 + m) / s**3
        psi1 = r / 2 * (1 - 1 / (m * s**2) + (1 + m * m) * (1 + m) / m * (s**2 + m) / (s**2 - m)**2)
        phi, turn = phi1 / slope, (phi2 * slope - phi1 * second) / slope**3
        total, other = 4 * phi.real, 2 * (z.conjugate() * turn + psi1 / slope)
        return (total - other.real) / 2, (total + other.real) / 2, other.imag / 2

    def answer(self, mesh):
        return stresses(solve(mesh, self.problem(mesh))[1], len(mesh.points))[mesh.at(self.long, 0, 0), 1]


class Shoulder:
    """A flat bar, 40 wide and then 20, with fillets of 4, under tension: the largest stress over the mean one in the narrow part."""

    reference, sizes = 1.999, (4, 2, 1)
    wide, narrow, radius, length = 20.0, 10.0, 4.0, 60.0  # half widths: one half is meshed

    def shape(self):
        r, x = self.radius, self.length
        arc = Part.Arc(Vector(x, self.narrow + r), Vector(x + r * (1 - math.sqrt(0.5)), self.narrow + r * (1 - math.sqrt(0.5))),
                       Vector(x + r, self.narrow)).toShape()
        corners = [(x + r, self.narrow), (2 * x, self.narrow), (2 * x, 0), (0, 0), (0, self.wide), (x, self.wide), (x, self.narrow + r)]
        lines = [Part.makeLine(Vector(*a), Vector(*b)) for a, b in zip(corners, corners[1:])]
        return Part.Face(Part.Wire(Part.__sortEdges__([arc, *lines])))

    def answer(self, mesh):
        problem = Problem(2.1e5, 0.3, THIN, plane=True)
        problem.fix(mesh.where(lambda p: p[:, 1]), 2)
        problem.fix(mesh.where(lambda p: p[:, 0]), 1)
        problem.load(mesh.edge_load(mesh.where(lambda p: p[:, 0] - 2 * self.length), lambda point, normal: THIN * normal))
        found = stresses(solve(mesh, problem)[1], len(mesh.points))
        center = (self.length + self.radius, self.narrow + self.radius)
        fillet = mesh.where(lambda p: np.hypot(p[:, 0] - center[0], p[:, 1] - center[1]) - self.radius)
        xx, yy, _, xy, _, _ = found[fillet].T
        return float(((xx + yy) / 2 + np.hypot((xx - yy) / 2, xy)).max())


class Column(CylinderModes):
    """A cylinder between diaphragms under axial compression: the buckling load over that of Sanders' theory. Poisson's ratio is
    0, so that the state before buckling is uniform."""

    sizes = (0.1, 0.07, 0.05)
    length, thickness, poisson = 1.0, 0.01, 0.0

    def exact(self):
        """The least load per length over half waves m and waves n: the stress works on the slopes along the axis."""
        waves = [self.stiffness(m, n) for m in range(1, 12) for n in range(25)]
        return min(np.linalg.eigvalsh(stiffness)[0] / a**2 for stiffness, a in waves)

    def answer(self, mesh):
        problem = Problem(self.young, self.poisson, self.thickness)
        for end in (-self.length / 2, self.length / 2):
            rim = mesh.where(lambda p, end=end: p[:, 2] - end)
            problem.fix(rim, 1, 2)
            problem.load(mesh.edge_load(rim, lambda point, normal, end=end: (0, 0, -math.copysign(1, end))))
        problem.fix(mesh.at(self.radius, 0, 0), 3)
        problem.step = "*BUCKLE\n4, 1e-4"
        return factors(solve(mesh, problem)[0], 1)[0] / self.exact()


def value_at(point, mesh, values):
    """The value at a point of a plane mesh, interpolated in the element that contains it."""
    gaps = [np.linalg.norm(mesh.points[element[:4], :2].mean(axis=0) - point) for element in mesh.elements]
    for place in np.argsort(gaps)[:8]:
        element, local = mesh.elements[place], np.zeros(2)
        for _ in range(20):
            shape, slopes = quad_shape(*local)
            local -= np.linalg.solve((slopes @ mesh.points[element, :2]).T, shape @ mesh.points[element, :2] - point)
        if np.abs(local).max() <= 1 + 1e-6:
            return quad_shape(*local)[0] @ values[element]
    raise RuntimeError(f"no element at {point}")


def mesh_with(mesher, shape, size, build):
    """A mesh of eight-node quads."""
    with tempfile.TemporaryDirectory() as folder:
        model, result = Path(folder) / "part.brep", Path(folder) / "part.msh"
        shape.exportBrep(str(model))
        if mesher == "Gmsh":
            options = {"Mesh.ElementOrder": 2, "Mesh.SecondOrderIncomplete": 1, "Mesh.RecombineAll": 1, "Mesh.RecombinationAlgorithm": 1,
                       "Mesh.SubdivisionAlgorithm": 1, "Mesh.MeshSizeMax": 2 * size, "Mesh.MeshSizeMin": size / 4}
            command = ["gmsh", "-2", model, "-format", "msh2", "-clcurv", "6"]
            command += [word for name, value in options.items() for word in ("-setnumber", name, value)]
        else:
            command = [build / "quadrille", "mesh", model, "--size", size, "--order", "2", "--quiet"]
        done = subprocess.run([str(word) for word in (*command, "-o", result)], capture_output=True, text=True, timeout=300, check=False)
        if done.returncode != 0:
            raise RuntimeError(f"{mesher} made no mesh: {done.stderr[-300:]}")
        mesh = Mesh.of_msh(result.read_text())
    if any(len(element) != 8 for element in mesh.elements):
        raise RuntimeError(f"{mesher} left triangles")
    return mesh


CASES = {"disc, simply supported": Disc, "disc, clamped": ClampedDisc, "disc, free, seven frequencies": FreeDisc, "Cook's membrane": Cook,
         "elliptic hole": EllipticHole, "shoulder": Shoulder, "cylinder, axial buckling": Column}


def main():
    """Prints the table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", type=Path, default=ROOT / "build")
    parser.add_argument("--case", nargs="*", choices=CASES, default=list(CASES))
    arguments = parser.parse_args()
    print("| problem | reference | size | Quadrille: quads | answer | off by | Gmsh: quads | answer | off by |")
    print("| --- | --- | --- | --- | --- | --- | --- | --- | --- |")
    for name in arguments.case:
        case = CASES[name]()
        for size in case.sizes:
            cells = [name, f"{case.reference:g}", f"{size:g}"]
            for mesher in ("Quadrille", "Gmsh"):
                try:
                    mesh = mesh_with(mesher, case.shape(), size, arguments.build)
                    value = case.answer(mesh)
                    cells += [str(len(mesh.elements)), f"{value:.5g}", f"{100 * (value / case.reference - 1):+.2f} %"]
                except RuntimeError as problem:
                    cells += [str(problem), "", ""]
            print("| " + " | ".join(cells) + " |", flush=True)


if __name__ == "__main__":
    main()
