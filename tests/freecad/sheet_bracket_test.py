"""The sample's job, which ./run.sh runs: a bracket's solid, its middle surface, quads, CalculiX, a picture."""

import os
import re
import shutil
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, os.environ["QUADRILLE_PYTHON"])
sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "examples" / "freecad"))

import FreeCAD
import numpy as np

import sheet_bracket

#: By `bench/midsurface_figures.py --bracket`: the solid as 10936 C3D20R. Movement in mm, stresses in MPa.
SOLID_MOVES, SOLID_BEND, SOLID_LARGEST = 1.5685, 108.4, 203.1


class SheetBracketTest(unittest.TestCase):
    """One run; each test looks at another part of it."""

    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.out = Path(cls.folder.name) / "sample"
        cls.surface, cls.mesh, cls.result, cls.held = sheet_bracket.job(cls.out, 3.0)

    @classmethod
    def tearDownClass(cls):
        FreeCAD.closeDocument("Bracket")
        cls.folder.cleanup()

    def test_the_middle_surface_is_that_of_the_sheet(self):
        self.assertEqual(sheet_bracket.thicknesses(self.surface), [2])
        self.assertEqual(len(self.surface.Shape.Faces), 7)  # foot, wall, two flanges, three bends
        self.assertAlmostEqual(self.surface.VolumeShare, 1, 6)
        sheet, = (obj for obj in FreeCAD.ActiveDocument.Analysis.Group if hasattr(obj, "Thickness"))
        self.assertEqual(sheet.Thickness.getValueAs("mm"), 2)
        self.assertEqual(len(sheet.References[0][1]), 7)

    def test_bolts_and_pull_moved_to_its_rims(self):
        for name, radius in (("Bolts", sheet_bracket.BOLT), ("Pull", sheet_bracket.SCREW)):
            (target, names), = FreeCAD.ActiveDocument.getObject(name).References
            self.assertEqual(target, self.surface)
            rims = [self.surface.Shape.getElement(edge) for edge in names]
            self.assertAlmostEqual(sum(rim.Length for rim in rims), 4 * 2 * np.pi * radius, 6)

    def test_the_mesh_is_of_quads(self):
        mesh = self.mesh.FemMesh
        self.assertEqual(mesh.QuadrangleCount, mesh.FaceCount)

    def test_files(self):
        for ending in (".FCStd", ".inp", ".png"):
            self.assertGreater(self.out.with_suffix(ending).stat().st_size, 20000)
        text = self.out.with_suffix(".inp").read_text(encoding="utf-8")
        self.assertEqual(len(re.findall(r"TYPE=S8R,", text)), 1)
        self.assertEqual(text.count("*SHELL SECTION"), 1)

    @unittest.skipUnless(shutil.which("ccx"), "CalculiX is not installed")
    def test_it_moves_and_is_stressed_as_the_solid(self):
        # FreeCAD shares a force on an edge out by chords: on circles of 20 elements 0.1 % is lost.
        np.testing.assert_allclose(np.abs(self.held), (sheet_bracket.FORCE, 0, 0), atol=0.2)
        moves = max(vector.Length for vector in self.result.DisplacementVectors)
        self.assertLess(abs(moves / SOLID_MOVES - 1), 0.01)
        nodes = self.result.Mesh.FemMesh.Nodes
        bend = [stress for node, stress in zip(self.result.NodeNumbers, self.result.vonMises)
                if nodes[node].x < 5 and nodes[node].z < 5 and abs(nodes[node].y) < 25]
        # In so narrow a bend the solid's stress is highest at its inner side, by more than a shell tells.
        self.assertLess(abs(max(bend) / SOLID_BEND - 1), 0.08)
        self.assertLess(abs(max(self.result.vonMises) / SOLID_LARGEST - 1), 0.1)


if __name__ == "__main__":
    unittest.main()
