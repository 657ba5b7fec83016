# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes as arrays, CalculiX's input for problems on them, and its results."""

import math
import subprocess
import tempfile
from pathlib import Path

import numpy as np

GAUSS = ((-math.sqrt(0.6), 5 / 9), (0.0, 8 / 9), (math.sqrt(0.6), 5 / 9))


class Mesh:
    """Nodes and second-order elements as arrays. The solver's node i is row i - 1."""

    def __init__(self, nodes, elements):
        """nodes: {number: point}; elements: lists of node numbers, corners first."""
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
        """Makes a mesh from a FEM mesh of FreeCAD."""
        return cls({number: tuple(point) for number, point in fem_mesh.Nodes.items()},
                   [fem_mesh.getElementNodes(element) for element in fem_mesh.Faces])

    @classmethod
    def of_msh(cls, text):
        """Makes a mesh from text in Gmsh's format 2.2, with triangles of 6 nodes and quads of 8."""
        lines = text.splitlines()
        at, nodes = lines.index("$Nodes"), {}
        for line in lines[at + 2:at + 2 + int(lines[at + 1])]:
            number, *point = line.split()
            nodes[int(number)] = [float(word) for word in point]
        at, elements = lines.index("$Elements"), []
        for line in lines[at + 2:at + 2 + int(lines[at + 1])]:
            words = [int(word) for word in line.split()]
            if words[1] in (2, 3, 9, 10, 16):  # surface elements of any order: __init__ refuses the wrong ones
                elements.append(words[3 + words[2]:])
        return cls(nodes, elements)

    def _upwards(self, element):
        """The element counter-clockwise as seen from above. Plane elements must be so, but faces may point down."""
        half = len(element) // 2
        x, y = self.points[element[:half], 0], self.points[element[:half], 1]
        if (x * np.roll(y, -1) - y * np.roll(x, -1)).sum() > 0:
            return element
        return [element[0], *element[half - 1:0:-1], *element[:half - 1:-1]]

    def where(self, distance):
        """The nodes where a function of the points is zero, within the tolerance."""
        return np.flatnonzero(np.abs(distance(self.points)) < self.tolerance)

    def at(self, *point):
        """The node at a point. Raises RuntimeError if there is none."""
        gaps = np.linalg.norm(self.points - np.array(point), axis=1)
        node = int(gaps.argmin())
        if gaps[node] > self.tolerance:
            raise RuntimeError(f"no node at {point}")
        return node

    def edge_load(self, nodes, traction):
        """Nodal loads of a traction on the element edges whose nodes are all in `nodes`. traction: force per length, a function
        of the point and the outward normal in the xy plane."""
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

    def surface_load(self, traction):
        """Nodal loads of a constant traction (force per area) on all elements."""
        loads = {}
        for element in self.elements:
            for (values, slopes), weight in quadrature(len(element)):
                area = np.linalg.norm(np.cross(*(slopes @ self.points[element])))
                for node, value in zip(element, values):
                    loads[node] = loads.get(node, 0.0) + weight * area * value * np.asarray(traction, dtype=float)
        return loads


def quadrature(count):
    """Integration points of an element of 6 or 8 nodes: for each the shape functions (n,) with their derivatives (2, n), and the
    weight."""
    if count == 6:
        return [(triangle_shape(x, y), 1 / 6) for x, y in ((1 / 6, 1 / 6), (2 / 3, 1 / 6), (1 / 6, 2 / 3))]
    return [(quad_shape(x, y), a * b) for x, a in GAUSS for y, b in GAUSS]


def triangle_shape(x, y):
    """Shape functions of the six-node triangle at a point, and their derivatives."""
    area, slope = np.array([1 - x - y, x, y]), np.array([[-1, 1, 0], [-1, 0, 1]])
    after = np.roll(area, -1)
    values = np.concatenate([area * (2 * area - 1), 4 * area * after])
    slopes = np.hstack([slope * (4 * area - 1), 4 * (slope * after + area * np.roll(slope, -1, axis=1))])
    return values, slopes


def quad_shape(x, y):
    """Shape functions of the eight-node quad at a point, and their derivatives."""
    values, slopes = np.empty(8), np.empty((2, 8))
    for i, (u, v) in enumerate(((-1, -1), (1, -1), (1, 1), (-1, 1))):
        values[i] = (1 + u * x) * (1 + v * y) * (u * x + v * y - 1) / 4
        slopes[:, i] = u * (1 + v * y) * (2 * u * x + v * y) / 4, v * (1 + u * x) * (u * x + 2 * v * y) / 4
    for i, v in ((4, -1), (6, 1)):
        values[i] = (1 - x * x) * (1 + v * y) / 2
        slopes[:, i] = -x * (1 + v * y), v * (1 - x * x) / 2
    for i, u in ((5, 1), (7, -1)):
        values[i] = (1 - y * y) * (1 + u * x) / 2
        slopes[:, i] = u * (1 - y * y) / 2, -y * (1 + u * x)
    return values, slopes


class Problem:
    """The solver's input besides the mesh."""

    def __init__(self, young, poisson, thickness, plane=False, density=None):
        self.young, self.poisson, self.thickness, self.density = young, poisson, thickness, density
        self.plane = plane
        self.fixed = []  # (nodes, degree of freedom, value)
        self.loads = {}  # node: force
        self.step = "*STATIC"
        self.increments = None  # for large displacements: (first, smallest, largest) share of the load

    def fix(self, nodes, *freedoms, value=0.0):
        """Prescribes the value of degrees of freedom (1 to 6) at nodes."""
        for freedom in freedoms:
            self.fixed.append((np.atleast_1d(nodes), freedom, value))

    def load(self, loads):
        """Adds nodal forces."""
        for node, force in loads.items():
            self.loads[node] = self.loads.get(node, 0.0) + np.asarray(force, dtype=float)


MIDDLE = "*NODE PRINT, NSET=Nall\nU\n*EL FILE, OUTPUT=2D\nS\n"
SURFACES = "*NODE PRINT, NSET=Nall\nU\n*EL FILE, OUTPUT=3D\nS\n"


def write_input(path, mesh, problem, solver_shells="S8R", output=MIDDLE):
    """Writes CalculiX's input. CalculiX reads 20 characters of a number, so numbers have no more digits than fit."""
    names = {6: "CPS6", 8: "CPS8R"} if problem.plane else {6: "S6", 8: solver_shells}
    corners_only = solver_shells in ("S4", "S4R")  # then no element has the midside nodes
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
        if problem.increments:
            first, smallest, largest = problem.increments
            file.write(f"*STEP, NLGEOM, INC=1000\n*STATIC\n{first}, 1, {smallest}, {largest}\n")
        else:
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


def solve(mesh, problem, solver_shells="S8R", output=MIDDLE):
    """Runs CalculiX. Returns the text of its .dat and .frd files."""
    with tempfile.TemporaryDirectory() as folder:
        base = Path(folder) / "case"
        write_input(base.with_suffix(".inp"), mesh, problem, solver_shells, output)
        done = subprocess.run(["ccx", str(base)], capture_output=True, text=True, timeout=900, check=False,
                              cwd=folder)
        if done.returncode != 0 or not base.with_suffix(".dat").exists():
            raise RuntimeError(f"CalculiX failed: {done.stdout[-500:]}")
        frd = base.with_suffix(".frd")
        return base.with_suffix(".dat").read_text(), frd.read_text() if frd.exists() else ""


def displacements(dat, count):
    """The displacements of all nodes, (n, 3); of the last increment if there are several."""
    found = np.full((count, 3), np.nan)
    for line in dat.splitlines():
        words = line.split()
        if len(words) == 4 and words[0].isdigit():
            found[int(words[0]) - 1] = [float(word) for word in words[1:]]
    return found


def stresses(frd, count):
    """The stresses at the nodes, (n, 6): xx yy zz xy yz zx. NaN for nodes without stresses."""
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


def stress_at(frd, point):
    """The stress (6,), xx yy zz xy yz zx, at the node nearest to a point, in the solid that CalculiX makes of a shell (output
    SURFACES). Raises RuntimeError if no node is there."""
    nodes, block, nearest, found = True, False, None, None
    for line in frd.splitlines():
        if line.startswith("    2C"):
            block, nodes = True, True
        elif line.startswith(" -4"):
            block, nodes = line.split()[1] == "STRESS", False
        elif line.startswith(" -3"):
            block = False
        elif block and line.startswith(" -1"):
            node, values = int(line[3:13]), [float(line[k:k + 12]) for k in range(13, len(line) - 11, 12)]
            if nodes:
                gap = float(np.linalg.norm(np.subtract(values, point)))
                nearest = min(nearest or (math.inf, 0), (gap, node))
            elif node == nearest[1]:
                found = np.array(values)
    if found is None or nearest[0] > 1e-4 * max(1.0, np.linalg.norm(point)):
        raise RuntimeError(f"no stress at {point}")
    return found


def work(loads, found):
    """The work of loads {node: force} on displacements. If the forces sum to 1, this is their mean displacement."""
    return sum(float(np.dot(force, found[node])) for node, force in loads.items())


def factors(dat, column):
    """A column of the table of eigenvalues or buckling factors."""
    found = []
    for line in dat.splitlines():
        words = line.split()
        if len(words) > column and words[0].isdigit() and int(words[0]) == len(found) + 1:
            found.append(float(words[column]))
    return found


def border_nodes(mesh):
    """The nodes on edges that belong to only one element."""
    counts = {}
    for element in mesh.elements:
        corners = len(element) // 2
        for i in range(corners):
            ends = frozenset((element[i], element[(i + 1) % corners]))
            counts.setdefault(ends, []).append(element[corners + i])
    return np.array(sorted({node for ends, middles in counts.items() if len(middles) == 1
                            for node in (*ends, *middles)}))
