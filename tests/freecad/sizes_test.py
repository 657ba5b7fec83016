"""The sizes that a mesh object's mesh would have, before it is made, in real FreeCAD without a window."""

import os
import sys
import unittest
from pathlib import Path

sys.path.insert(0, os.environ["QUADRILLE_PYTHON"])

import FreeCAD
import numpy as np
import Part

import quadrille.freecad as core
from quadrille.document import state
from quadrille.features import sizes


class SizesTest(unittest.TestCase):
    """Each test has a document of its own."""

    def setUp(self):
        self.document = FreeCAD.newDocument("Test")
        self.part = self.document.addObject("Part::Feature", "Part")
        self.part.Shape = Part.makeBox(10, 10, 10)

    def tearDown(self):
        FreeCAD.closeDocument(self.document.Name)

    def test_the_map_covers_the_part(self):
        found = sizes.start(core.make_mesh(self.part, size=2, sizes={"Face1": 0.5})).wait()
        a, b, c = (found.points[found.triangles[:, k]] for k in range(3))
        area = 0.5 * np.linalg.norm(np.cross(b - a, c - a), axis=1).sum()
        self.assertAlmostEqual(area, 600, 3)
        self.assertAlmostEqual(float(found.sizes.min()), 0.5, 6)
        self.assertAlmostEqual(float(found.sizes.max()), 2, 2)
        on_face = found.points[:, 0] < 1e-9  # Face1 of a box
        self.assertTrue(np.allclose(found.sizes[on_face].min(), 0.5))
        self.assertEqual({source.name for source in found.sources}, {"size", "size-on"})
        ends = found.points[found.lines]
        self.assertTrue(np.all(np.sum(np.isclose(ends, 0) | np.isclose(ends, 10), axis=2) >= 2))  # on the box's edges

    def test_settings_not_yet_stored_count(self):
        mesh = core.make_mesh(self.part, size=2)
        wanted = state.wanted_of(mesh)
        found = sizes.start(mesh, wanted._replace(values=dict(wanted.values, Size=1.0))).wait()
        self.assertEqual(round(found.quads), 600)

    def test_errors_are_in_words_of_the_panel(self):
        mesh = core.make_mesh(self.part, size=2, size_min=1)
        mesh.SizeMin = 3
        with self.assertRaises(core.Error) as caught:
            sizes.start(mesh).wait()
        self.assertIn('"Minimum"', str(caught.exception))
        self.assertNotIn("--", str(caught.exception))

    def test_dropped_work_leaves_nothing(self):
        job = sizes.start(core.make_mesh(self.part, size=0.01, force=True))
        folder = Path(job._folder.name)
        self.assertTrue(folder.exists())
        job.drop()
        self.assertFalse(job.running)
        self.assertFalse(folder.exists())

    def test_colors_run_from_the_least_to_the_largest(self):
        values = np.array([0.1, 1.0, 10.0])
        rgb = sizes.colors(values, *sizes.range_of(values))
        self.assertTrue(np.allclose(rgb[0], (0.267, 0.005, 0.329)))
        self.assertTrue(np.allclose(rgb[1], (0.128, 0.567, 0.551)))  # the middle by the logarithm
        self.assertTrue(np.allclose(rgb[2], (0.993, 0.906, 0.144)))
        self.assertTrue(np.all(np.isfinite(sizes.colors(np.ones(3), *sizes.range_of(np.ones(3))))))


if __name__ == "__main__":
    unittest.main(verbosity=2, warnings="ignore")
