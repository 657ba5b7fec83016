# SPDX-License-Identifier: GPL-3.0-or-later
"""A STEP file as a quad mesh, in three lines.

    scripts/freecad_python examples/freecad/three_lines.py [PART.step]
"""

import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "workbench"))  # not needed where the addon is installed

import FreeCAD as App
import Part

path = sys.argv[1] if len(sys.argv) > 1 else str(ROOT / "examples/models/bracket.step")

import quadrille.freecad
part = Part.show(Part.read(path)) or App.ActiveDocument.ActiveObject
mesh = quadrille.freecad.mesh_object(part, size=quadrille.freecad.suggested_size(part), order=2)

print(f"{mesh.QuadCount} quads, {mesh.NodeCount} nodes, q {mesh.WorstQuality:.2f} at worst, {mesh.MeanQuality:.2f} mean")
