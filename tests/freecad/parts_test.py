"""Parts as FreeCAD's users make them, each meshed: threads, springs, lofts, sweeps, fillets, shells, cut spheres."""

import json
import math
import os
import subprocess
import tempfile
import unittest
from collections import Counter
from pathlib import Path

import FreeCAD
import Part
from FreeCAD import Vector

QUADRILLE = os.environ["QUADRILLE_COMMAND"]
ELEMENTS_PER_DIAGONAL = 20
UP, ALONG, ACROSS = Vector(0, 0, 1), Vector(1, 0, 0), Vector(0, 1, 0)


def polygon(*points):
    return Part.makePolygon([Vector(*p) for p in (*points, points[0])])


def path(*points):
    return Part.makePolygon([Vector(*p) for p in points])


def spline(*points):
    curve = Part.BSplineCurve()
    curve.interpolate([Vector(*p) for p in points])
    return curve.toShape()


def circle(radius, center=(0, 0, 0), normal=UP):
    return Part.Wire(Part.makeCircle(radius, Vector(*center), normal))


def along_helix(helix, profile):
    return Part.Wire(helix.Edges).makePipeShell([profile], True, True)


def drill(radius, at, direction=UP, length=100):
    return Part.makeCylinder(radius, length, Vector(*at), direction)


def stretched(shape, x, y, z):
    matrix = FreeCAD.Matrix()
    matrix.A11, matrix.A22, matrix.A33 = x, y, z
    return shape.transformGeometry(matrix)


def thread():
    return along_helix(Part.makeHelix(2, 20, 10), polygon((9.5, 0, -0.8), (11, 0, 0), (9.5, 0, 0.8)))


def spring(*helix):
    return along_helix(Part.makeHelix(*helix), circle(0.8, (helix[2], 0, 0), ACROSS))


def block(x=20, y=30, z=10):
    return Part.makeBox(x, y, z)


def filleted(*radii, count=12):
    body = block()
    return body.makeFillet(*radii, body.Edges[:count])


def chamfered():
    body = block()
    return body.makeChamfer(1, body.Edges)


def tub():
    body = block()
    body = body.makeFillet(3, [edge for edge in body.Edges if edge.tangentAt(0).isEqual(UP, 1e-9)])
    return body.makeThickness([max(body.Faces, key=lambda face: face.CenterOfMass.z)], -1, 1e-3)


def gear(teeth=24):
    points = []
    for tooth in range(teeth):
        for radius, turn in ((10, -0.3), (12, -0.12), (12, 0.12), (10, 0.3)):
            angle = 2 * math.pi * (tooth + turn) / teeth
            points.append((radius * math.cos(angle), radius * math.sin(angle), 0))
    return Part.Face(polygon(*points)).extrude(Vector(0, 0, 5)).cut(drill(3, (0, 0, -2)))


def perforated():
    holes = [drill(1.5 + 0.2 * j, (6 + 8 * i, 6 + 8 * j, -3)) for i in range(12) for j in range(7)]
    return Part.makeBox(100, 60, 2).cut(holes)


def vase(degrees):
    wall = spline((0, 0, 0), (6, 0, 3), (4, 0, 8), (7, 0, 14), (0, 0, 16))
    section = Part.Face(Part.Wire([wall, Part.makeLine(Vector(0, 0, 16), Vector(0, 0, 0))]))
    return section.revolve(Vector(), UP, degrees)


def corner_pipe(transition):
    return path((0, 0, 0), (0, 0, 20), (20, 0, 20), (20, 20, 20)).makePipeShell([circle(2)], True, False, transition)


def square(half, z=0.0):
    return polygon((-half, -half, z), (half, -half, z), (half, half, z), (-half, half, z))


def cross(radius):
    bar = Part.makeCylinder(5, 30, Vector(0, 0, -15))
    return bar, Part.makeCylinder(radius, 30, Vector(-15, 0, 0), ALONG)


def bezier():
    surface = Part.BezierSurface()
    for i, j, z in ((1, 1, 0), (1, 2, 0), (2, 1, 0), (2, 2, 8)):
        surface.setPole(i, j, Vector(10 * (i - 1), 10 * (j - 1), z))
    return surface.toShape()


PARTS = {
    "thread": thread,
    "bolt": lambda: Part.makeCylinder(10, 24, Vector(0, 0, -2)).fuse(thread()),
    "cut thread": lambda: Part.makeCylinder(10.4, 18, Vector(0, 0, 1)).cut(thread()),
    "spring": lambda: spring(6, 30, 10),
    "conical spring": lambda: spring(4, 20, 10, 15),
    "loft of circle and square": lambda: Part.makeLoft([circle(10), square(5, 20)], True),
    "loft of three circles": lambda: Part.makeLoft(
        [circle(10), circle(4, (3, 0, 15)), circle(8, (0, 0, 30))], True),
    "loft to a point": lambda: Part.makeLoft([Part.Vertex(0, 0, 20), square(5)], True),
    "all fillets": lambda: filleted(2),
    "largest fillets": lambda: filleted(4.999),
    "variable fillets": lambda: filleted(0.5, 3, count=4),
    "all chamfers": chamfered,
    "tub": tub,
    "offset torus": lambda: Part.makeTorus(10, 3).makeOffsetShape(1, 1e-3),
    "offset box": lambda: block().makeOffsetShape(3, 1e-3, join=0),
    "ellipsoid": lambda: stretched(Part.makeSphere(10), 1, 2, 0.5),
    "stretched and drilled": lambda: stretched(
        Part.makeCylinder(5, 20).cut(drill(2, (-10, 0, 10), ALONG)), 1, 3, 1),
    "equal cross": lambda: cross(5)[0].fuse(cross(5)[1]),
    "Steinmetz solid": lambda: cross(5)[0].common(cross(5)[1]),
    "nearly equal cross": lambda: cross(4.999)[0].fuse(cross(4.999)[1]),
    "sphere without an eighth": lambda: Part.makeSphere(10).cut(block(20, 20, 20)),
    "drilled sphere": lambda: Part.makeSphere(10).cut(drill(3, (0, 0, -50))),
    "Viviani": lambda: Part.makeSphere(10).cut(drill(5, (5, 0, -50))),
    "bubbles": lambda: Part.makeSphere(10).fuse(
        [Part.makeSphere(8, Vector(10, 0, 0)), Part.makeSphere(6, Vector(0, 11, 3))]),
    "hemisphere": lambda: Part.makeSphere(10, Vector(), UP, 0, 90, 360),
    "sector of a spherical zone": lambda: Part.makeSphere(10, Vector(), UP, -30, 60, 270),
    "drilled cone": lambda: Part.makeCone(10, 0, 20).cut(drill(2, (-50, 0, 6), ALONG)),
    "half a cone": lambda: Part.makeCone(10, 0, 20).cut(Part.makeBox(20, 20, 40, Vector(0, -10, -5))),
    "sector of a cone": lambda: Part.makeCone(10, 0, 20, Vector(), UP, 70),
    "sector of a torus": lambda: Part.makeTorus(10, 3, Vector(), UP, -60, 100, 200),
    "drilled torus": lambda: Part.makeTorus(10, 3).cut(drill(1, (10, 0, -50))),
    "revolved to its axis": lambda: Part.Face(
        polygon((0, 0, 0), (8, 0, 0), (8, 0, 2), (3, 0, 4), (0, 0, 10))).revolve(Vector(), UP, 360),
    "vase": lambda: vase(360),
    "half a vase": lambda: vase(170),
    "swept circle": lambda: Part.Wire(
        spline((0, 0, 0), (0, 0, 10), (10, 0, 20), (20, 10, 20), (30, 10, 30))).makePipeShell([circle(2)], True, False),
    "pipe with round corners": lambda: corner_pipe(2),
    "pipe with mitred corners": lambda: corner_pipe(1),
    "gear": gear,
    "perforated plate": perforated,
    "wedge": lambda: Part.makeWedge(0, 0, 0, 2, 2, 10, 10, 10, 8, 8),
    "ruled surface": lambda: Part.makeRuledSurface(
        Part.makeCircle(10), Part.makeCircle(5, Vector(0, 0, 10), Vector(0, 0.3, 1))),
    "helicoid": lambda: Part.Wire(Part.makeHelix(5, 10, 10).Edges).makePipeShell(
        [path((4, 0, 0), (10, 0, 0))], False, True),
    # As a wire, since OpenCASCADE 7.8 leaves out edges that share no vertex.
    "filled face": lambda: Part.makeFilledFace(
        Part.Wire([Part.makeCircle(10, Vector(), UP, 0, 180), spline((-10, 0, 0), (0, 0, 6), (10, 0, 0))]).Edges),
    "Bezier patch": bezier,
    "thin slot": lambda: block(30, 20, 5).cut(Part.makeBox(10, 0.05, 5, Vector(10, 10, 0))),
    "foil": lambda: block(30, 20, 0.02),
    "tiny hole": lambda: block(100, 100, 10).cut(drill(0.1, (50, 50, -5))),
    "tangent hole": lambda: block(20, 20, 10).cut(drill(5, (5, 10, -5))),
    "tangent boss": lambda: block(20, 20, 10).fuse(Part.makeCylinder(5, 10, Vector(5, 5, 0))),
    "hole close to a side": lambda: block(20, 20, 10).cut(drill(5, (5.001, 10, -5))),
    "hole barely through a side": lambda: block(20, 20, 10).cut(drill(5, (4.999, 10, -5))),
    "mould of a spring": lambda: Part.makeBox(30, 30, 40, Vector(-15, -15, -2)).cut(spring(6, 30, 10)),
}


def read_quads(mesh):
    """Nodes by number, and the corners of each quad, of a .msh file of version 2.2."""
    lines = mesh.read_text().split("\n")
    start = lines.index("$Nodes") + 2
    nodes = {}
    for line in lines[start:start + int(lines[start - 1])]:
        number, *place = line.split()
        nodes[int(number)] = Vector(*map(float, place))
    start = lines.index("$Elements") + 2
    elements = [list(map(int, line.split())) for line in lines[start:start + int(lines[start - 1])]]
    return nodes, [element[-4:] for element in elements if element[1] == 3]


class PartsTest(unittest.TestCase):
    def check(self, shape, file):
        """Meshes a file, and holds the mesh against the shape."""
        mesh, report = file.with_suffix(".msh"), file.with_suffix(".json")
        command = [QUADRILLE, "mesh", file, "-o", mesh, "--report", report, "--quiet",
                   "--elements-per-diagonal", str(ELEMENTS_PER_DIAGONAL)]
        result = subprocess.run(command, capture_output=True, text=True, timeout=120)
        self.assertEqual(result.returncode, 0, result.stderr)
        faces = json.loads(report.read_text())["faces"]
        self.assertEqual(len(faces), len(shape.Faces))
        # Slivers far below the least size are suppressed: an edge takes their place.
        self.assertLessEqual({face["status"] for face in faces}, {"meshed", "merged"})
        nodes, quads = read_quads(mesh)
        area = 0
        sides = Counter()
        for a, b, c, d in quads:
            area += 0.5 * (nodes[c] - nodes[a]).cross(nodes[d] - nodes[b]).Length
            sides.update(frozenset(side) for side in ((a, b), (b, c), (c, d), (d, a)))
        self.assertAlmostEqual(area / shape.Area, 1, delta=0.03)
        if shape.Solids:  # watertight; four meet where a hole touches a side from within
            self.assertEqual({uses % 2 for uses in sides.values()}, {0})

    def test_parts(self):
        with tempfile.TemporaryDirectory() as folder:
            for name, make in PARTS.items():
                with self.subTest(part=name):
                    shape = make()
                    file = Path(folder) / (name.replace(" ", "_") + ".brep")
                    shape.exportBrep(str(file))
                    self.check(shape, file)


if __name__ == "__main__":
    unittest.main(verbosity=2, warnings="ignore")
