# SPDX-License-Identifier: GPL-3.0-or-later
"""Measures how the exact CAD normals at the nodes (*NORMAL in CalculiX's input) change results on coarse meshes.

    scripts/freecad_python bench/shell_normals.py
"""

import math
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "examples" / "freecad"))

import FreeCAD
import numpy as np
import Part
from FreeCAD import Vector

import verification  # makes quadrille importable
import quadrille.freecad
from known_answers import shells, solver
from known_answers.shapes import joined


class Fillet:
    """A strip with two straight arms and a bend of 90 degrees, clamped at one end and pushed at the other; Poisson's ratio
    is 0. The answer is the displacement of the push over that of a frame of Timoshenko beams."""

    reference, arm, bend, width, thickness, young = 1.0, 5.0, 2.0, 2.0, 0.1, 1e5

    def shape(self):
        end, rise = self.arm + self.bend, self.bend + self.arm
        middle = Vector(self.arm + self.bend * math.sqrt(0.5), 0, self.bend * (1 - math.sqrt(0.5)))
        edges = [Part.makeLine(Vector(), Vector(self.arm, 0, 0)),
                 Part.Arc(Vector(self.arm, 0, 0), middle, Vector(end, 0, self.bend)).toShape(),
                 Part.makeLine(Vector(end, 0, self.bend), Vector(end, 0, rise))]
        return joined([edge.extrude(Vector(0, self.width, 0)) for edge in edges])

    def exact(self):
        area, bending = self.young * self.width * self.thickness, self.young * self.width * self.thickness**3 / 12
        angle = (np.arange(20000) + 0.5) * math.pi / 40000
        step = self.bend * math.pi / 40000
        moment = self.arm + self.bend * np.cos(angle)
        turned = self.arm**3 / 3 + (moment**2).sum() * step + (self.arm + self.bend)**2 * self.arm
        pulled, sheared = self.arm + (np.cos(angle)**2).sum() * step, self.arm + (np.sin(angle)**2).sum() * step
        return turned / bending + pulled / area + sheared / (5 / 6 * area / 2)

    def answer(self, mesh):
        problem = solver.Problem(self.young, 0.0, self.thickness)
        problem.fix(mesh.where(lambda p: p[:, 0]), 1, 2, 3, 4, 5, 6)
        end = mesh.where(lambda p: p[:, 2] - self.bend - self.arm)
        loads = mesh.edge_load(end, lambda point, normal: (1 / self.width, 0, 0))
        problem.load(loads)
        return solver.work(loads, solver.displacements(solver.solve(mesh, problem)[0], len(mesh.points))) / self.exact()


def exact_normals(part, mesh):
    """The lines of *NORMAL: for each node of each element the CAD face's normal, on the side of the element's normal."""
    surfaces = [face.Surface for face in part.Shape.Faces]
    lines = ["*NORMAL"]
    for number, element in enumerate(mesh.elements, 1):
        points, corners = mesh.points[element], len(element) // 2
        own = sum(np.cross(points[i], points[(i + 1) % corners]) for i in range(corners))
        center = Vector(*points.mean(axis=0))
        face = min(range(len(surfaces)), key=lambda i: part.Shape.Faces[i].distToShape(Part.Vertex(center))[0])
        for node, point in zip(element, points):
            normal = np.array(surfaces[face].normal(*surfaces[face].parameter(Vector(*point))))
            normal = normal if own @ normal > 0 else -normal
            lines.append(f"{number}, {node + 1}, " + ", ".join(f"{value:.12g}" for value in normal))
    return "\n".join(lines) + "\n"


def error(case, mesh, normals):
    """The error in percent, with the lines `normals` inserted into CalculiX's input."""
    usual = solver.write_input

    def write_input(path, *arguments):
        usual(path, *arguments)
        path.write_text(path.read_text().replace("*MATERIAL", normals + "*MATERIAL", 1))

    solver.write_input = write_input
    try:
        return 100 * (case.answer(mesh) / case.reference - 1)
    finally:
        solver.write_input = usual


#: Cases, each with its meshes: size and elements per circle.
MESHES = ((Fillet(), ((3.2, 4), (2.0, 12), (1.2, 12))), (shells.PinchedCylinder(), ((150, 12), (70, 12), (35, 12))),
          (shells.CylinderModes(), ((0.5, 12), (0.33, 12))), (shells.ClosedHemisphere(), ((4, 12), (2.5, 12), (1.6, 12))),
          (shells.Hook(), ((30, 4), (20, 12), (6.6, 12))))


def main():
    """Prints a line for each mesh."""
    for case, meshes in MESHES:
        for size, per_circle in meshes:
            document = FreeCAD.newDocument("Normals")
            part = document.addObject("Part::Feature", "Part")
            part.Shape = case.shape()
            made = quadrille.freecad.mesh_object(part, size=size, order=2, elements_per_circle=per_circle)
            mesh = verification.Mesh.of_fem_mesh(made.FemMesh)
            normals = exact_normals(part, mesh)
            usual, exact = error(case, mesh, ""), error(case, mesh, normals)
            print(f"{type(case).__name__:18} {len(mesh.elements):5} elements: CalculiX's normals {usual:+.3f} %, "
                  f"the CAD's {exact:+.3f} %", flush=True)
            FreeCAD.closeDocument(document.Name)


main()
