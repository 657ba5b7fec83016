# SPDX-License-Identifier: GPL-3.0-or-later
"""Known answers of shell and plane problems, with meshes of Quadrille and of Gmsh, in CalculiX.

    scripts/freecad_python examples/freecad/verification.py                       # every case, checked
    scripts/freecad_python examples/freecad/verification.py --case hemisphere     # one case
    scripts/freecad_python examples/freecad/verification.py --converge out.json   # all meshers, several sizes

The CAD is made in FreeCAD, Quadrille's mesh is a FEM mesh object of second order, the loads are exact ones: points, or
edge tractions integrated over the curved element edges. Supports and loads are found by position, so that all meshers
get the same problem. Shells are S8R (triangles S6), plane stress is CPS8R (CPS6). Units are the problem's own.

Gmsh is run by its command, its quads with Blossom, which leaves some triangles: its full-quad mode refuses surfaces of
revolution, its frontal points for quads crash version 4.8.4, and FreeCAD 0.20's Gmsh object gives four-node quads
beside six-node triangles when it is asked for quads of second order.
"""

import argparse
import json
import math
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "workbench"))

import FreeCAD
import numpy as np
import Part
from FreeCAD import Vector

import quadrille.freecad

MESHERS = ("quadrille", "gmsh-quads", "gmsh-triangles")
GAUSS = ((-math.sqrt(0.6), 5 / 9), (0.0, 8 / 9), (math.sqrt(0.6), 5 / 9))


class Mesh:
    """Nodes and second-order elements as arrays. Node i of the solver is row i - 1."""

    def __init__(self, nodes, elements):
        """nodes: {number: point}; elements: lists of numbers, corners first."""
        wrong = [element for element in elements if len(element) not in (6, 8)]
        if wrong or not elements:
            raise RuntimeError(f"{len(wrong)} of {len(elements)} elements are not of second order")
        used = sorted({node for element in elements for node in element})
        rows = {node: row for row, node in enumerate(used)}
        self.points = np.array([nodes[node] for node in used], dtype=float)
        self.elements = [[rows[node] for node in element] for element in elements]
        if np.ptp(self.points[:, 2]) == 0:
            self.elements = [self._upwards(element) for element in self.elements]
        self.tolerance = 1e-6 * np.ptp(self.points, axis=0).max()

    @classmethod
    def of_fem_mesh(cls, fem_mesh):
        """From FreeCAD's FEM mesh."""
        return cls({number: tuple(point) for number, point in fem_mesh.Nodes.items()},
                   [fem_mesh.getElementNodes(element) for element in fem_mesh.Faces])

    @classmethod
    def of_msh(cls, text):
        """From Gmsh's format 2.2: triangles of 6 nodes and quads of 8."""
        lines = text.splitlines()
        at, nodes = lines.index("$Nodes"), {}
        for line in lines[at + 2:at + 2 + int(lines[at + 1])]:
            number, *point = line.split()
            nodes[int(number)] = [float(word) for word in point]
        at, elements = lines.index("$Elements"), []
        for line in lines[at + 2:at + 2 + int(lines[at + 1])]:
            words = [int(word) for word in line.split()]
            if words[1] in (2, 3, 9, 10, 16):  # surface elements of any order: the wrong ones are refused
                elements.append(words[3 + words[2]:])
        return cls(nodes, elements)

    def _upwards(self, element):
        """Counter-clockwise as seen from above, as plane elements must be; faces may look down."""
        half = len(element) // 2
        x, y = self.points[element[:half], 0], self.points[element[:half], 1]
        if (x * np.roll(y, -1) - y * np.roll(x, -1)).sum() > 0:
            return element
        return [element[0], *element[half - 1:0:-1], *element[:half - 1:-1]]

    def where(self, distance):
        """The nodes where a function of the points is zero."""
        return np.flatnonzero(np.abs(distance(self.points)) < self.tolerance)

    def at(self, *point):
        """The node at a point."""
        gaps = np.linalg.norm(self.points - np.array(point), axis=1)
        node = int(gaps.argmin())
        if gaps[node] > self.tolerance:
            raise RuntimeError(f"no node at {point}")
        return node

    def edge_load(self, nodes, traction):
        """Loads of a traction (force per length, a function of point and outward normal) on the free edges there."""
        on_edge = set(int(node) for node in nodes)
        loads = {}
        for element in self.elements:
            corners = len(element) // 2
            center = self.points[element[:corners]].mean(axis=0)
            for i in range(corners):
                edge = [element[i], element[(i + 1) % corners], element[corners + i]]
                if not on_edge.issuperset(edge):
                    continue
                for s, weight in GAUSS:
                    shape = np.array([s * (s - 1) / 2, s * (s + 1) / 2, 1 - s * s])
                    slope = np.array([s - 0.5, s + 0.5, -2 * s])
                    point, tangent = shape @ self.points[edge], slope @ self.points[edge]
                    normal = np.array([tangent[1], -tangent[0], 0.0])
                    length = np.linalg.norm(tangent)
                    normal /= length
                    if normal @ (point - center) < 0:
                        normal = -normal
                    force = np.asarray(traction(point, normal))
                    for node, value in zip(edge, shape):
                        loads[node] = loads.get(node, 0.0) + weight * length * value * force
        return loads


class Problem:
    """What goes into the solver besides the mesh."""

    def __init__(self, young, poisson, thickness, plane=False, density=None):
        self.young, self.poisson, self.thickness, self.density = young, poisson, thickness, density
        self.plane = plane
        self.fixed = []  # (nodes, first degree of freedom, last, value)
        self.loads = {}  # node: force
        self.step = "*STATIC"

    def fix(self, nodes, *freedoms, value=0.0):
        """Holds degrees of freedom (1..6) of nodes."""
        for freedom in freedoms:
            self.fixed.append((np.atleast_1d(nodes), freedom, value))

    def load(self, loads):
        """Adds nodal forces."""
        for node, force in loads.items():
            self.loads[node] = self.loads.get(node, 0.0) + np.asarray(force, dtype=float)


def write_input(path, mesh, problem, solver_shells="S8R", output="*NODE PRINT, NSET=Nall\nU\n*EL FILE, OUTPUT=2D\nS\n"):
    """Writes CalculiX's input. It reads 20 characters of a number: no more digits than fit."""
    names = {6: "CPS6", 8: "CPS8R"} if problem.plane else {6: "S6", 8: solver_shells}
    corners_only = solver_shells in ("S4", "S4R")  # the midside nodes are then in no element
    with open(path, "w", encoding="ascii") as file:
        file.write("*NODE, NSET=Nall\n")
        for i, (x, y, z) in enumerate(mesh.points, 1):
            file.write(f"{i}, {x:.12g}, {y:.12g}, {z:.12g}\n")
        for size, name in names.items():
            rows = [(i, nodes) for i, nodes in enumerate(mesh.elements, 1) if len(nodes) == size]
            if rows:
                file.write(f"*ELEMENT, TYPE={name}, ELSET=Eall\n")
                for i, nodes in rows:
                    nodes = nodes[:4] if corners_only else nodes
                    file.write(f"{i}, " + ", ".join(str(node + 1) for node in nodes) + "\n")
        file.write(f"*MATERIAL, NAME=M\n*ELASTIC\n{problem.young:.15g}, {problem.poisson:.15g}\n")
        if problem.density is not None:
            file.write(f"*DENSITY\n{problem.density:.15g}\n")
        section = "SOLID" if problem.plane else "SHELL"
        file.write(f"*{section} SECTION, MATERIAL=M, ELSET=Eall\n{problem.thickness:.15g}\n*BOUNDARY\n")
        for nodes, freedom, value in problem.fixed:
            values = np.broadcast_to(value, nodes.shape)
            for node, number in zip(nodes, values):
                file.write(f"{node + 1}, {freedom}, {freedom}, {number:.12g}\n")
        file.write(f"*STEP\n{problem.step}\n")
        if problem.loads:
            file.write("*CLOAD\n")
            for node, force in problem.loads.items():
                for freedom, value in enumerate(force, 1):
                    if value:
                        file.write(f"{node + 1}, {freedom}, {value:.12g}\n")
        if problem.step == "*STATIC":
            file.write(output)
        file.write("*END STEP\n")


def solve(mesh, problem, solver_shells="S8R"):
    """Runs CalculiX; returns the text of its .dat and .frd files."""
    with tempfile.TemporaryDirectory() as folder:
        base = Path(folder) / "case"
        write_input(base.with_suffix(".inp"), mesh, problem, solver_shells)
        done = subprocess.run(["ccx", str(base)], capture_output=True, text=True, timeout=900, check=False,
                              cwd=folder)
        if done.returncode != 0 or not base.with_suffix(".dat").exists():
            raise RuntimeError(f"CalculiX failed: {done.stdout[-500:]}")
        frd = base.with_suffix(".frd")
        return base.with_suffix(".dat").read_text(), frd.read_text() if frd.exists() else ""


def displacements(dat, count):
    """The displacements of all nodes, (n, 3)."""
    found = np.full((count, 3), np.nan)
    for line in dat.splitlines():
        words = line.split()
        if len(words) == 4 and words[0].isdigit():
            found[int(words[0]) - 1] = [float(word) for word in words[1:]]
    return found


def stresses(frd, count):
    """Nodal stresses, (n, 6): xx yy zz xy yz zx."""
    found = np.full((count, 6), np.nan)
    inside = False
    for line in frd.splitlines():
        if line.startswith(" -4"):
            inside = line.split()[1] == "STRESS"
        elif line.startswith(" -3"):
            inside = False
        elif inside and line.startswith(" -1"):
            node = int(line[3:13])
            if node <= count:
                found[node - 1] = [float(line[13 + 12 * k:25 + 12 * k]) for k in range(6)]
    return found


def factors(dat, column):
    """Numbers of the table of eigenvalues or buckling factors."""
    found = []
    for line in dat.splitlines():
        words = line.split()
        if len(words) > column and words[0].isdigit() and int(words[0]) == len(found) + 1:
            found.append(float(words[column]))
    return found


# The cases. Each has a shape, a way to its answer, the reference, sizes for convergence, and the size of the check.

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
    """The same with a tenth of the size at the forces, growing from there."""

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
        # What symmetry keeps at zero holds the body: no force comes from these supports.
        problem.fix(np.array([*pulled, mesh.at(r * math.cos(top), 0, r * math.sin(top))]), 2)
        problem.fix(np.array([pushed[0], mesh.at(0, r * math.cos(top), r * math.sin(top))]), 1)
        problem.fix(pulled[0], 3)
        problem.load({pulled[0]: (2, 0, 0), pulled[1]: (-2, 0, 0), pushed[0]: (0, -2, 0), pushed[1]: (0, 2, 0)})
        found = displacements(solve(mesh, problem)[0], len(mesh.points))
        return (found[pulled[0], 0] - found[pulled[1], 0]) / 2


class EllipticMembrane:
    """NAFEMS LE1: a quarter of an elliptic ring under outward pressure; the stress at its inner end (MPa)."""

    reference, sizes, size, tolerance = 92.7, (0.5, 0.3, 0.2, 0.12, 0.07), 0.07, 1.0

    def shape(self):
        def quarter(a, b):
            ellipse = Part.Ellipse(Vector(), a, b) if a > b else Part.Ellipse(Vector(0, b, 0), Vector(-a, 0, 0),
                                                                               Vector())
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
    """A hole in an infinite plate under tension: 3.0 at its flank. A quarter, with Kirsch's tractions outside."""

    reference, sizes, size, tolerance = 3.0, (0.6, 0.4, 0.25, 0.15, 0.1), 0.1, 1.0
    side = 4.0

    def shape(self):
        square = Part.makePlane(self.side, self.side)
        return square.cut(Part.Face(Part.Wire(Part.makeCircle(1.0)))).Faces[0]

    @staticmethod
    def kirsch(point):
        """The exact stresses, tension 1 along x, radius 1."""
        r, t = math.hypot(point[0], point[1]), math.atan2(point[1], point[0])
        a2, a4 = 1 / r**2, 1 / r**4
        xx = 1 - a2 * (1.5 * math.cos(2 * t) + math.cos(4 * t)) + 1.5 * a4 * math.cos(4 * t)
        yy = -a2 * (0.5 * math.cos(2 * t) - math.cos(4 * t)) - 1.5 * a4 * math.cos(4 * t)
        xy = -a2 * (0.5 * math.sin(2 * t) + math.sin(4 * t)) + 1.5 * a4 * math.sin(4 * t)
        return xx, yy, xy

    def problem(self, mesh):
        def traction(point, normal):
            xx, yy, xy = self.kirsch(point)
            return (xx * normal[0] + xy * normal[1], xy * normal[0] + yy * normal[1], 0.0)

        problem = Problem(1000.0, 0.3, 1.0, plane=True)
        problem.fix(mesh.where(lambda p: p[:, 0]), 1)
        problem.fix(mesh.where(lambda p: p[:, 1]), 2)
        for axis in (0, 1):
            problem.load(mesh.edge_load(mesh.where(lambda p, axis=axis: p[:, axis] - self.side), traction))
        return problem

    def answer(self, mesh):
        return stresses(solve(mesh, self.problem(mesh))[1], len(mesh.points))[mesh.at(0, 1, 0), 0]


class SupportedPlate:
    """A simply supported rectangular plate."""

    a, b, thickness, young, poisson, density = 10.0, 8.0, 0.05, 2e5, 0.3, 8e-9

    def stiffness(self):
        """Of the plate in bending."""
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
    """The first four frequencies of the plate, as their mean ratio to Kirchhoff's (1 is exact)."""

    reference, sizes, size, tolerance = 1.0, (2.5, 1.6, 1.0, 0.7, 0.5), 0.5, 1.0

    def exact(self):
        """Kirchhoff's first four frequencies in Hz."""
        root = math.sqrt(self.stiffness() / (self.density * self.thickness))
        return sorted(math.pi / 2 * (m * m / self.a**2 + n * n / self.b**2) * root
                      for m in range(1, 6) for n in range(1, 6))[:4]

    def frequencies(self, mesh):
        """CalculiX's first four."""
        problem = self.problem(mesh)
        problem.fix(mesh.at(0, 0, 0), 1, 2)
        problem.fix(mesh.at(self.a, 0, 0), 2)
        problem.step = "*FREQUENCY\n4"
        return factors(solve(mesh, problem)[0], 3)[:4]

    def answer(self, mesh):
        ratios = np.array(self.frequencies(mesh)) / self.exact()
        return 1 + float(ratios[np.argmax(np.abs(ratios - 1))] - 1)  # the worst of the four


class Buckling(SupportedPlate):
    """The load that buckles the plate, pressed along x, as a ratio to Kirchhoff's."""

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


class MembranePatch:
    """The membrane patch test: constant strain on the border must come out inside, on any mesh. The largest error."""

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
    """The bending patch test: constant curvature along x, along y and in twist, given at the border by deflection and
    rotations, must come out inside. Poisson's ratio is 0, because CalculiX keeps the thickness of a shell at nodes
    whose rotation is given. Three skew strips of other widths, so that the elements are parallelograms of three forms.
    The largest error of three shell elements, over the largest deflection."""

    reference, sizes, size, tolerance = 0.0, (3, 2, 1.3, 0.9, 0.6), 1.3, None
    absolute = 1e-6
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
    """The same on a quadrangle without parallel sides: its mapped elements are parallelograms but for 5 %."""

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
    """A plate strip bent by four lines of force, Poisson's ratio 0: between the supports the curvature is constant.
    The mesh is distorted by skew lines. The rise of the middle, as a ratio to the exact one."""

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


CASES = {
    "pinched-cylinder": PinchedCylinder, "pinched-cylinder-graded": GradedPinchedCylinder, "hemisphere": Hemisphere,
    "nafems-le1": EllipticMembrane, "plate-with-hole": PlateWithHole, "modes": Modes, "buckling": Buckling, "membrane-patch": MembranePatch,
    "bending-patch-skew": SkewBendingPatch, "bending-patch-quadrangle": QuadrangleBendingPatch,
    "bending-patch": BendingPatch,
}


def joined(faces):
    """Faces as one shell, their common edges shared."""
    return Part.makeShell(faces[0].generalFuse(faces[1:], 1e-6)[0].Faces)


def border_nodes(mesh):
    """The nodes on edges that only one element has."""
    counts = {}
    for element in mesh.elements:
        corners = len(element) // 2
        for i in range(corners):
            ends = frozenset((element[i], element[(i + 1) % corners]))
            counts.setdefault(ends, []).append(element[corners + i])
    return np.array(sorted({node for ends, middles in counts.items() if len(middles) == 1
                            for node in (*ends, *middles)}))


def mesh_with(mesher, part, size, refined=(), share=1.0):
    """A second-order mesh of a part; at the points `refined` of that share of the size."""
    if mesher == "quadrille":
        names = {f"Vertex{i}": share * size for i, vertex in enumerate(part.Shape.Vertexes, 1)
                 if any(vertex.Point.isEqual(Vector(*point), 1e-6) for point in refined)}
        return Mesh.of_fem_mesh(quadrille.freecad.mesh_object(part, size=size, order=2, sizes=names).FemMesh)
    with tempfile.TemporaryDirectory() as folder:
        model, result = Path(folder) / "part.brep", Path(folder) / "part.msh"
        part.Shape.exportBrep(str(model))
        options = {"Mesh.ElementOrder": 2, "Mesh.SecondOrderIncomplete": 1, "Mesh.MeshSizeMax": size,
                   "Mesh.MeshSizeMin": size}
        if mesher == "gmsh-quads":
            options.update({"Mesh.RecombineAll": 1, "Mesh.RecombinationAlgorithm": 1, "Mesh.Algorithm": 6})
        if refined:
            script = Path(folder) / "part.geo"
            script.write_text(graded_script(model, size, refined, share))
            model = script
            options.update({"Mesh.MeshSizeMin": share * size, "Mesh.MeshSizeExtendFromBoundary": 0})
        settings = [word for name, value in options.items() for word in ("-setnumber", name, str(value))]
        done = subprocess.run(["gmsh", "-2", str(model), "-format", "msh2", "-o", str(result), *settings],
                              capture_output=True, text=True, timeout=300, check=False)
        if done.returncode != 0 or not result.exists():
            raise RuntimeError(f"Gmsh made no mesh: {done.stderr[-300:]}")
        return Mesh.of_msh(result.read_text())


def graded_script(model, size, refined, share, growth=0.3):
    """Gmsh's script for sizes that grow from points, as Quadrille's do."""
    boxes = [", ".join(str(value + side) for side in (-1e-6, 1e-6) for value in point) for point in refined]
    found = "\n".join(f"found() += Point In BoundingBox {{{box}}};" for box in boxes)
    return (f'SetFactory("OpenCASCADE");\nMerge "{model}";\nfound() = {{}};\n{found}\n'
            "Field[1] = Distance;\nField[1].PointsList = {found()};\n"
            f"Field[2] = Threshold;\nField[2].InField = 1;\nField[2].SizeMin = {share * size};\n"
            f"Field[2].SizeMax = {size};\nField[2].DistMin = 0;\nField[2].DistMax = {(1 - share) * size / growth};\n"
            "Background Field = 2;\n")


def run(name, mesher, size):
    """One answer; returns a dictionary for the table."""
    case = CASES[name]()
    document = FreeCAD.newDocument("Verification")
    try:
        part = document.addObject("Part::Feature", "Part")
        part.Shape = case.shape()
        mesh = mesh_with(mesher, part, size, getattr(case, "refined", ()), getattr(case, "share", 1.0))
    finally:
        FreeCAD.closeDocument(document.Name)
    started = time.monotonic()
    value = float(case.answer(mesh))
    triangles = sum(1 for element in mesh.elements if len(element) == 6)
    return {"case": name, "mesher": mesher, "size": size, "elements": len(mesh.elements), "triangles": triangles,
            "nodes": len(mesh.points), "value": value, "reference": case.reference,
            "solver_seconds": round(time.monotonic() - started, 2)}


def print_shells():
    """The error of each of CalculiX's shell elements in the bending patch tests."""
    for case in (SkewBendingPatch(), QuadrangleBendingPatch(), CutBendingPatch()):
        document = FreeCAD.newDocument("Verification")
        part = document.addObject("Part::Feature", "Part")
        part.Shape = case.shape()
        mesh = mesh_with("quadrille", part, case.size)
        FreeCAD.closeDocument(document.Name)
        for shell in ("S4", "S4R", "S8", "S8R"):
            print(f"{type(case).__name__:22} {len(mesh.elements):4} {shell:4} off by {case.error(mesh, shell):.2g}")


def error_of(row):
    """The error: in percent, or absolute where the reference is 0."""
    return abs(row["value"]) if row["reference"] == 0 else 100 * (row["value"] / row["reference"] - 1)


def main():
    """Checks the cases, or follows their convergence."""
    parser = argparse.ArgumentParser(description="Known answers, with Quadrille and CalculiX.")
    parser.add_argument("--case", choices=sorted(CASES), action="append")
    parser.add_argument("--converge", help="follow all meshers over several sizes; rows go to this .json")
    parser.add_argument("--shells", action="store_true", help="the bending patch tests with each kind of shell")
    parser.add_argument("--size", type=float, help="another size than the case's own")
    arguments = parser.parse_args()
    if not shutil.which("ccx"):
        print("CalculiX (ccx) is not installed: nothing is solved")
        sys.exit(77)
    if arguments.shells:
        print_shells()
        return
    rows, wrong = [], []
    for name in arguments.case or CASES:
        case = CASES[name]
        runs = [("quadrille", arguments.size or case.size)]
        if arguments.converge:
            runs = [(mesher, size) for mesher in MESHERS for size in case.sizes]
        for mesher, size in runs:
            try:
                row = run(name, mesher, size)
            except (RuntimeError, subprocess.TimeoutExpired) as problem:
                if not arguments.converge:
                    raise
                print(f"{name:17} {mesher:15} size {size:<6g} failed: {problem}", flush=True)
                continue
            rows.append(row)
            off = error_of(row)
            unit = "" if row["reference"] == 0 else " %"
            print(f"{name:17} {mesher:15} size {size:<6g} {row['elements']:6} elements  {row['value']:.5g}"
                  f"   reference {row['reference']:g}   off by {off:+.3g}{unit}", flush=True)
            limit = case.absolute if case.tolerance is None else case.tolerance
            if not arguments.converge and not abs(off) <= limit:
                wrong.append(name)
    if arguments.converge:
        Path(arguments.converge).write_text(json.dumps(rows, indent=1) + "\n", encoding="utf-8")
    if wrong:
        sys.exit(f"off by more than allowed: {', '.join(wrong)}")


if __name__ == "__main__":
    main()
