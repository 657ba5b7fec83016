# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes the sample part, examples/freecad/sheet_bracket.step, and the models in examples/models/.

    freecadcmd examples/make_samples.py < /dev/null

Lengths are millimeters. Each model has a property that is difficult for meshers; tests/support/sample_models.hpp lists them
by property.
"""

import math
import os
import re
import sys
import traceback
from pathlib import Path

import Part
from FreeCAD import Placement, Rotation, Vector

MODELS = Path(__file__).resolve().parent / "models"
X, Y, Z = Vector(1, 0, 0), Vector(0, 1, 0), Vector(0, 0, 1)


def box():
    """A box: six planes, closed."""
    return Part.makeBox(30, 20, 10)


def cylinder():
    """A solid cylinder: a seam, and two discs, each bounded by one closed edge."""
    return Part.makeCylinder(10, 30)


def cone():
    """A solid cone with its apex: a degenerate edge."""
    return Part.makeCone(10, 0, 25)


def sphere():
    """A ball: one face, two poles, one seam."""
    return Part.makeSphere(15)


def torus():
    """A solid torus: one face bounded only by its two seams."""
    return Part.makeTorus(20, 6)


def disc():
    """A plane face bounded by a single closed edge with one vertex."""
    return Part.Face(Part.Wire(Part.makeCircle(12)))


def plate_with_holes():
    """A plane face with three round holes and a slot."""
    plate = Part.makePlane(120, 70)
    for x, y, radius in ((22, 20, 9), (60, 45, 14), (98, 18, 6)):
        plate = plate.cut(Part.Face(Part.Wire(Part.makeCircle(radius, Vector(x, y, 0)))))
    slot = Part.makePlane(20, 8, Vector(80, 46, 0)).fuse(
        [Part.Face(Part.Wire(Part.makeCircle(4, Vector(x, 50, 0)))) for x in (80, 100)]
    )
    return plate.cut(slot.removeSplitter()).Faces[0]


def bracket():
    """An L-bracket: fillets at the bend, rounded corners, four bolt holes, one of them countersunk, and a rib."""
    width, foot, height, thickness = 60.0, 70.0, 60.0, 8.0
    base = Part.makeBox(foot, width, thickness)
    wall = Part.makeBox(thickness, width, height)
    shape = base.fuse(wall).removeSplitter()
    inner = [e for e in shape.Edges if is_along(e, Y) and passes(e, thickness, thickness)]
    shape = shape.makeFillet(10.0, inner)
    outer = [e for e in shape.Edges if is_along(e, Y) and passes(e, 0, 0)]
    shape = shape.makeFillet(12.0, outer)
    corners = [
        e
        for e in shape.Edges
        if (is_along(e, Z) and abs(e.CenterOfMass.x - foot) < 1e-6)
        or (is_along(e, X) and abs(e.CenterOfMass.z - height) < 1e-6)
    ]
    shape = shape.makeFillet(12.0, corners)
    rib = Part.Face(
        Part.makePolygon(
            [Vector(x, 0, z) for x, z in ((4, 4), (50, 4), (50, 8), (8, 45), (4, 45), (4, 4))]
        )
    ).extrude(Vector(0, 6, 0))
    rib.translate(Vector(0, width / 2 - 3, 0))
    shape = shape.fuse(rib).removeSplitter()
    for y in (15.0, width - 15.0):
        shape = shape.cut(Part.makeCylinder(5.0, 40, Vector(52, y, -20)))
        shape = shape.cut(Part.makeCylinder(4.0, 40, Vector(-20, y, 42), X))
    shape = shape.cut(Part.makeCone(4.0, 7.0, 3.0, Vector(5.0, 15.0, 42), X))
    return shape.removeSplitter().Solids[0]


def is_along(edge, direction):
    """True if the edge is a straight line along the direction."""
    return isinstance(edge.Curve, Part.Line) and abs(abs(edge.Curve.Direction * direction) - 1) < 1e-9


def passes(edge, x, z):
    """True if the middle of the edge lies at x and z."""
    middle = edge.CenterOfMass
    return abs(middle.x - x) < 1e-6 and abs(middle.z - z) < 1e-6


def bezier_patch():
    """A bicubic Bezier face, warped."""
    surface = Part.BezierSurface()
    surface.increase(3, 3)
    heights = ((0, 6, -4, 2), (4, 14, 2, -6), (-2, 8, 16, 0), (6, -4, 4, 8))
    for i in range(4):
        for j in range(4):
            surface.setPole(i + 1, j + 1, Vector(12 * i, 10 * j, heights[i][j]))
    return surface.toShape()


def wing():
    """A tapered, swept, twisted wing of B-spline surfaces, with a sharp trailing edge and a plane face at each end."""

    def section(chord, shift, span, twist_degrees):
        # NACA 4412 with a closed trailing edge, from the trailing edge over the upper side and back along the lower side.
        upper, lower = [], []
        for i in range(25):
            x = 0.5 * (1 - math.cos(math.pi * i / 24))
            half = 0.6 * (0.2969 * math.sqrt(x) - 0.126 * x - 0.3516 * x**2 + 0.2843 * x**3 - 0.1036 * x**4)
            camber = 0.25 * (0.8 * x - x**2) if x < 0.4 else (0.04 / 0.36) * (0.2 + 0.8 * x - x**2)
            upper.append((x, camber + half))
            lower.append((x, camber - half))
        turn = Rotation(Y, twist_degrees)
        edges = []
        for points in (upper[::-1], lower):
            curve = Part.BSplineCurve()
            curve.interpolate([turn * Vector(chord * x, 0, chord * z) + Vector(shift, span, 0) for x, z in points])
            edges.append(curve.toShape())
        return Part.Wire(edges)

    loft = Part.makeLoft([section(80, 0, 0, 0), section(60, 22, 100, 2), section(35, 48, 180, 4)], True)
    return loft.Solids[0]


def t_junction():
    """Three plane faces that share one edge."""
    faces = [Part.makePlane(30, 40)]
    for angle in (100.0, 230.0):
        face = Part.makePlane(30, 40)
        face.Placement = Placement(Vector(0, 0, 0), Rotation(Y, -angle))
        faces.append(face)
    return Part.Shell(faces[0].generalFuse(faces[1:])[0].Faces)


def two_solids():
    """A cylinder standing on a block, as two solids that share the disc between them."""
    block = Part.makeBox(40, 30, 12)
    pin = Part.makeCylinder(8, 20, Vector(18, 14, 12))
    return block.generalFuse([pin])[0]


def tube_with_hole():
    """A cylindrical face with a round hole across its seam."""
    tube = Part.makeCylinder(12, 40).Faces[0]
    seam = tube.Edges[1] if tube.Edges[1].isSeam(tube) else next(e for e in tube.Edges if e.isSeam(tube))
    side = seam.CenterOfMass
    drill = Part.makeCylinder(5, 20, Vector(0, 0, 20), Vector(side.x, side.y, 0))
    return tube.cut(drill).Faces[0]


def bent(corner, first, second, lengths, width, thickness=2.0, inside=3.0):
    """Two legs of sheet metal that meet in a bend: from the outer corner along two directions, extruded along `width`."""
    outside, flat = inside + thickness, 1 - math.sqrt(0.5)

    def at(a, b):
        return corner + first * a + second * b

    (a, b), t, middle = lengths, thickness, (outside * flat, thickness + inside * flat)
    edges = [Part.makeLine(at(outside, 0), at(a, 0)), Part.makeLine(at(a, 0), at(a, t)), Part.makeLine(at(a, t), at(outside, t)),
             Part.Arc(at(outside, t), at(middle[1], middle[1]), at(t, outside)).toShape(), Part.makeLine(at(t, outside), at(t, b)),
             Part.makeLine(at(t, b), at(0, b)), Part.makeLine(at(0, b), at(0, outside)),
             Part.Arc(at(0, outside), at(middle[0], middle[0]), at(outside, 0)).toShape()]
    return Part.Face(Part.Wire(edges)).extrude(width)


def sheet_bracket():
    """A bracket bent from 2 mm sheet: a foot with four bolt holes and two flanges, a wall with a bore and four screw holes."""
    half = 35.0
    shape = bent(Vector(0, -half, 0), X, Z, (74, 80), Y * 2 * half)
    for side in (-1, 1):  # the flange's bend starts at the edge of the foot
        shape = shape.fuse(bent(Vector(20, side * (half + 5), 0), Y * -side, Z, (6, 16), X * 54))
    shape = shape.removeSplitter()

    def drill(point, axis, radius):
        return Part.makeCylinder(radius, 20, point - axis * 10, axis)

    sides = (-1, 1)
    holes = [drill(Vector(0, 0, 47), X, 14)]
    holes += [drill(Vector(0, y * 20, 47 + z * 20), X, 2.75) for y in sides for z in sides]
    holes += [drill(Vector(x, y * 21, 0), Z, 4) for x in (26, 60) for y in sides]
    holes += [drill(Vector(18, y * half, 0), Z, 2) for y in sides]  # reliefs where the flanges end
    for hole in holes:
        shape = shape.cut(hole)
    for direction, height, radius in ((X, 79, 12), (Y, 15, 9)):
        shape = shape.makeFillet(radius, [edge for edge in shape.Edges
                                          if is_along(edge, direction) and edge.Length < 3 and edge.CenterOfMass.z > height])
    return shape.Solids[0]


def write(name, shape, ending, folder=MODELS):
    """Checks a shape and writes it to a folder."""
    if not shape.isValid() or not shape.Faces:
        raise RuntimeError(f"{name} is not a valid shape")
    path = folder / (name + ending)
    if ending == ".step":
        shape.exportStep(str(path))
        text = path.read_text()
        # Remove date and versions, so that the file has the same bytes each time.
        text = re.sub(r"FILE_NAME\(.*?\);", f"FILE_NAME('{name}','2026-01-01T00:00:00',(''),(''),'','','');", text,
                      count=1, flags=re.S)
        text = re.sub(r"'Open CASCADE STEP translator [^']*'", f"'{name}'", text)
        path.write_text(text)
    else:
        shape.exportBrep(str(path))
    print(f"{path.name:24} {len(shape.Solids)} solids {len(shape.Faces):3} faces {len(shape.Edges):3} edges "
          f"{len(shape.Vertexes):3} vertices  area {shape.Area:.2f}")


def main():
    """Makes all models."""
    MODELS.mkdir(exist_ok=True)
    write("bracket", bracket(), ".step")
    write("sheet_bracket", sheet_bracket(), ".step", Path(__file__).resolve().parent / "freecad")
    for make in (box, cylinder, cone, sphere, torus, disc, plate_with_holes, bezier_patch, wing, t_junction,
                 two_solids, tube_with_hole):
        write(make.__name__, make(), ".brep")


# freecadcmd swallows exceptions: turn them into the exit code.
try:
    main()
    status = 0
except BaseException:
    traceback.print_exc()
    status = 1
sys.stdout.flush()
sys.stderr.flush()
os._exit(status)
