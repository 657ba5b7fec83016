"""quadrille.middle in real FreeCAD: middle surfaces that follow their part, thickness objects, loads that move along."""

import os
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, os.environ["QUADRILLE_PYTHON"])

import FreeCAD
import ObjectsFem
import Part
from FreeCAD import Vector

import quadrille.freecad
from quadrille.core.errors import Error
from quadrille.features import middle


def angle(thickness, other=None):
    """An angle of 40 x 60 mm, 100 mm long: its legs lie on x and on y."""
    other = other or thickness
    points = [(0, 0), (40, 0), (40, thickness), (other, thickness), (other, 60), (0, 60), (0, 0)]
    return Part.Face(Part.makePolygon([Vector(x, y, 0) for x, y in points])).extrude(Vector(0, 0, 100))


def face_at(shape, *point):
    """The name of the face that a point lies on."""
    vertex = Part.Vertex(*point)
    return next(f"Face{i}" for i, face in enumerate(shape.Faces, 1) if face.distToShape(vertex)[0] < 1e-9)


class MiddleTest(unittest.TestCase):
    """Each test has a document of its own."""

    def setUp(self):
        self.document = FreeCAD.newDocument("Test")
        self.analysis = ObjectsFem.makeAnalysis(self.document, "Analysis")

    def tearDown(self):
        FreeCAD.closeDocument(self.document.Name)

    def part(self, shape):
        part = self.document.addObject("Part::Feature", "Bracket")
        part.Shape = shape
        return part

    def thicknesses(self, surface):
        """(mm, faces) of each thickness object of the analysis."""
        members = [obj for obj in self.analysis.Group if obj in middle.thickness_objects(surface)]
        return sorted((round(obj.Thickness.getValueAs("mm").Value, 6), obj.References[0][1]) for obj in members)

    def test_thicknesses_follow_the_part(self):
        part = self.part(angle(2))
        surface = middle.make_middle(part, analysis=self.analysis)
        self.assertEqual(len(surface.Shape.Faces), 2)
        self.assertAlmostEqual(surface.Shape.Area, 100 * (39 + 59), 6)
        self.assertEqual(self.thicknesses(surface), [(2, ("Face1", "Face2"))])
        part.Shape = angle(3)
        self.document.recompute()
        self.assertEqual(self.thicknesses(surface), [(3, ("Face1", "Face2"))])
        part.Shape = angle(3, 2)
        self.document.recompute()
        self.assertEqual([mm for mm, _ in self.thicknesses(surface)], [2, 3])
        self.assertEqual(sorted(name for _, names in self.thicknesses(surface) for name in names), ["Face1", "Face2"])

    def test_a_part_that_is_not_thin_any_more_is_an_error(self):
        part = self.part(angle(2))
        surface = middle.make_middle(part)
        part.Shape = Part.makeBox(30, 20, 10)
        self.document.recompute()
        self.assertFalse(surface.isValid())
        part.Shape = angle(2)
        self.document.recompute()
        self.assertTrue(surface.isValid())

    def test_errors_leave_the_document_as_it_is(self):
        before = len(self.document.Objects)
        block = self.part(Part.makeBox(30, 20, 10))
        with self.assertRaisesRegex(Error, "Bracket is not a thin solid"):
            middle.make_middle(block, analysis=self.analysis)
        block.Shape = Part.makePlane(10, 10)
        with self.assertRaisesRegex(Error, "no solid"):
            middle.make_middle(block)
        self.assertEqual(len(self.document.Objects), before + 1)

    def test_loads_move_to_the_middle(self):
        shape = angle(2)
        part = self.part(shape)
        fixed = ObjectsFem.makeConstraintFixed(self.document, "Fixed")
        fixed.References = [(part, (face_at(shape, 20, 1, 0),))]
        inside, outside = (ObjectsFem.makeConstraintPressure(self.document, name) for name in ("Inside", "Outside"))
        inside.References = [(part, (face_at(shape, 20, 2, 50),))]
        outside.References = [(part, (face_at(shape, 20, 0, 50),))]
        lost = ObjectsFem.makeConstraintForce(self.document, "Lost")
        lost.References = [(part, ("Vertex1",))]
        for member in (fixed, inside, outside, lost):
            self.analysis.addObject(member)
        self.document.recompute()
        self.assertEqual(len(middle.referring_to(part, self.analysis)), 4)
        surface = middle.make_middle(part, analysis=self.analysis)
        left = middle.move_references(surface, self.analysis)
        self.assertEqual(len(left), 1)
        self.assertIn("Lost: Vertex1 of Bracket", left[0])
        (target, names), = fixed.References
        self.assertEqual(target, surface)
        self.assertEqual(len(names), 2)  # both legs end there
        for name in names:
            edge = surface.Shape.getElement(name)
            self.assertAlmostEqual(edge.BoundBox.ZMax, 0, 9)
        leg = face_at(surface.Shape, 20, 1, 50)
        self.assertEqual(inside.References, [(surface, (leg,))])
        self.assertEqual(outside.References, [(surface, (leg,))])
        self.assertNotEqual(inside.Reversed, outside.Reversed)
        # A pressure that is not reversed acts against the normal.
        face = surface.Shape.getElement(leg)
        up = face.normalAt(*face.Surface.parameter(Vector(20, 1, 50))).y > 0
        self.assertEqual(inside.Reversed, not up)

    def test_it_is_meshed_and_survives_saving(self):
        part = self.part(angle(2))
        surface = middle.make_middle(part, analysis=self.analysis)
        mesh = quadrille.freecad.mesh_object(surface, size=10, analysis=self.analysis)
        self.assertGreater(mesh.QuadCount, 80)
        with tempfile.TemporaryDirectory() as folder:
            path = str(Path(folder) / "middle.FCStd")
            self.document.saveAs(path)
            FreeCAD.closeDocument(self.document.Name)
            self.document = FreeCAD.openDocument(path)
        self.analysis = self.document.Analysis
        surface, part = self.document.MiddleSurface, self.document.Bracket
        self.assertTrue(middle.is_middle(surface))
        self.assertEqual(type(surface.Proxy).__module__, "quadrille.middle")  # as in documents of older versions
        part.Shape = angle(4)
        self.document.recompute()
        self.assertEqual(self.thicknesses(surface), [(4, ("Face1", "Face2"))])

    def test_what_is_known_of_it_is_told(self):
        stud = Part.makeCylinder(5, 5, Vector(20, 4, 50), Vector(0, 1, 0))
        surface = middle.make_middle(self.part(angle(4).fuse(stud).removeSplitter()))
        self.assertEqual((surface.Parts, surface.Solids, surface.FreeEdges), (1, 1, 6))
        self.assertAlmostEqual(sum(surface.Areas), surface.Shape.Area, 6)
        held = sum(area * thickness for area, thickness in zip(surface.Areas, surface.Thicknesses))
        self.assertAlmostEqual(surface.AreaTimesThickness, held, 6)
        self.assertAlmostEqual(surface.VolumeShare, held / surface.Source.Shape.Volume, 6)
        self.assertAlmostEqual(surface.VolumeShareOnce, surface.VolumeShare, 6)  # two walls count no corner twice
        self.assertEqual(len(surface.LeftOut), 2)  # the stud's side and end

    def test_parts_that_touch_are_joined(self):
        post = Part.makeBox(40, 40, 200).cut(Part.makeBox(34, 34, 202, Vector(3, 3, -1)))
        arm = Part.makeBox(160, 30, 30, Vector(40, 5, 85)).cut(Part.makeBox(162, 26, 26, Vector(39, 7, 87)))
        part = self.part(Part.makeCompound([post, arm]))
        self.assertEqual(len(middle.make_middle(part).Shape.Shells), 2)
        joined = middle.make_middle(part, join=True)
        mesh = quadrille.freecad.mesh_object(joined, size=15)
        self.assertGreater(mesh.QuadCount, 200)
        self.assertAlmostEqual(joined.Shape.Area, 4 * 37 * 200 + 4 * 28 * 161.5, 3)

    def test_thin_looks_are_told(self):
        self.assertAlmostEqual(middle.looks_thin(angle(2)), 2, delta=0.1)
        self.assertIsNone(middle.looks_thin(Part.makeBox(30, 20, 10)))
        self.assertIsNone(middle.looks_thin(Part.makeBox(10, 10, 200)))
        self.assertIsNone(middle.looks_thin(Part.makePlane(10, 10)))


if __name__ == "__main__":
    unittest.main()
