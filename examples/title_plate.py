# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes the plate of the title picture: a plane face, 100 by 80 mm, with four holes of diameter 12 mm.

    scripts/freecad_python examples/title_plate.py plate.brep
    build/quadrille mesh plate.brep -o plate.msh --size 3 --picture plate.png
"""

import sys

import Part
from FreeCAD import Vector


def title_plate():
    """The face. The holes are at x = 25 and 75, y = 20 and 60."""
    holes = [Part.Face(Part.Wire(Part.makeCircle(6, Vector(x, y, 0)))) for x in (25, 75) for y in (20, 60)]
    return Part.makePlane(100, 80).cut(holes)


if __name__ == "__main__" or "FreeCAD" in sys.modules:
    title_plate().exportBrep(sys.argv[-1])
