"""quadrille.freecad.mesh_surface in real FreeCAD: mesh objects meshed anew, stale when they or the settings change."""

import os
import shutil
import sys
import tempfile
import unittest
from pathlib import Path

sys.path[:0] = [os.environ["QUADRILLE_PYTHON"], str(Path(__file__).resolve().parent)]

import FreeCAD
import Mesh
import ObjectsFem
import Part
from FreeCAD import Placement, Rotation, Vector

import quadrille.freecad as core
import solver_test
from quadrille.core.errors import Error
from quadrille.document import state
from quadrille.features import surfaces


class SurfacesTest(unittest.TestCase):
    """Each test has a document of its own."""

    def setUp(self):
        self.document = FreeCAD.newDocument("Test")
        self.document.UndoMode = 1

    def tearDown(self):
        FreeCAD.closeDocument(self.document.Name)

    def surface(self, mesh, name="Scan"):
        surface = self.document.addObject("Mesh::Feature", name)
        surface.Mesh = mesh
        return surface

    def box(self):
        """A box of 30 x 20 x 10 mm of twelve triangles."""
        return self.surface(Mesh.createBox(30.0, 20.0, 10.0))

    def groups(self, mesh, kind):
        fem = mesh.FemMesh
        return sorted(fem.getGroupName(i) for i in fem.Groups if fem.getGroupElementType(i) == kind)

    def test_a_box_gets_its_faces_and_edges(self):
        box = self.box()
        box.Placement = Placement(Vector(100, 5, 0), Rotation(Vector(0, 0, 1), 30))
        analysis = ObjectsFem.makeAnalysis(self.document, "Analysis")
        mesh = core.mesh_surface(box, size=2, analysis=analysis)
        self.assertEqual(mesh.Status, state.UP_TO_DATE)
        self.assertIn(mesh, analysis.Group)
        self.assertEqual(mesh.Surface, box)
        fem = mesh.FemMesh
        self.assertEqual(fem.FaceCount, fem.QuadrangleCount)
        self.assertGreater(fem.FaceCount, 2200 / 4 / 2)
        self.assertEqual(self.groups(mesh, "Face"), [f"Face{i}" for i in range(1, 7)])
        self.assertEqual(self.groups(mesh, "Edge"), sorted(f"Edge{i}" for i in range(1, 13)))
        self.assertEqual(len(self.groups(mesh, "Node")), 8)
        # Each quad is in the group of one face, and the mesh is where the surface is.
        members = [i for n in fem.Groups if fem.getGroupElementType(n) == "Face" for i in fem.getGroupElements(n)]
        self.assertEqual(sorted(members), sorted(fem.Faces))
        for corner in ("XMin", "YMin", "ZMin", "XMax", "YMax", "ZMax"):
            self.assertAlmostEqual(getattr(fem.BoundBox, corner), getattr(box.Mesh.BoundBox, corner), 4)
        self.assertEqual(len(fem.getElementNodes(fem.Faces[0])), 8)
        self.assertEqual(mesh.QuadCount, fem.FaceCount)
        self.assertLess(mesh.OffSurface, 1e-4)

    def test_order_angle_and_usual_size(self):
        ball = self.surface(Mesh.createSphere(10.0, 40))
        mesh = core.mesh_surface(ball, order=1, feature_angle=0)
        self.assertEqual(len(mesh.FemMesh.getElementNodes(mesh.FemMesh.Faces[0])), 4)
        self.assertEqual(self.groups(mesh, "Face"), ["Face1"])
        self.assertAlmostEqual(mesh.Size.Value, 34.6 / 60, 1)
        coarse = core.mesh_surface(ball, size="0.3 cm", order=1)
        self.assertEqual(coarse.Size.Value, 3)
        self.assertLess(coarse.QuadCount, mesh.QuadCount)

    def test_open_borders_are_closed_where_that_is_asked_for(self):
        gap = 0.001
        halves = Mesh.Mesh([[(0, 0, 0), (10, 0, 0), (0, 10, 0)], [(10, 0, gap), (10, 10, 0), (0, 10, gap)]])
        sheet = self.surface(halves, "Sheet")
        apart = core.mesh_surface(sheet, size=2, order=1)
        joined = core.mesh_surface(sheet, size=2, order=1, merge=2 * gap)
        self.assertGreater(apart.NodeCount, joined.NodeCount)
        self.assertEqual(joined.MergeDistance.Value, 2 * gap)
        self.assertEqual(joined.Status, state.UP_TO_DATE)

    def test_what_changes_makes_it_stale_and_meshing_again_mends_that(self):
        box = self.box()
        mesh = core.mesh_surface(box, size=4, order=1)
        before = mesh.QuadCount
        mesh.Size = 2
        self.document.recompute()
        self.assertEqual(mesh.Status, state.SETTINGS_CHANGED)
        self.assertIn("the settings have changed", state.complaint(mesh))
        core.remesh(mesh)
        self.assertEqual((mesh.Status, state.complaint(mesh)), (state.UP_TO_DATE, ""))
        self.assertGreater(mesh.QuadCount, before)
        box.Placement.Base.x = 7
        self.document.recompute()
        self.assertEqual(mesh.Status, state.PART_CHANGED)
        core.remesh(mesh)
        self.assertAlmostEqual(mesh.FemMesh.BoundBox.XMin, 7 - 15, 4)
        box.Mesh = Mesh.createBox(30.0, 20.0, 10.01)
        self.document.recompute()
        self.assertEqual(mesh.Status, state.PART_CHANGED)
        with self.assertRaisesRegex(Error, "the part has changed.*nothing was exported"):
            core.export(mesh, "never.inp")
        core.remesh(mesh)
        self.document.removeObject(box.Name)
        self.document.recompute()
        self.assertEqual(mesh.Status, state.PART_GONE)
        with self.assertRaisesRegex(Error, "the mesh object that it meshes is gone"):
            core.remesh(mesh)

    def test_undo_brings_the_mesh_back(self):
        box = self.box()
        self.document.openTransaction("make")
        mesh = core.mesh_surface(box, size=4, order=1)
        self.document.commitTransaction()
        coarse = mesh.FemMesh.FaceCount
        self.document.openTransaction("finer")
        mesh.Size = 2
        core.remesh(mesh)
        self.document.commitTransaction()
        fine = mesh.FemMesh.FaceCount
        self.assertGreater(fine, coarse)
        self.document.undo()
        self.assertEqual((mesh.FemMesh.FaceCount, mesh.QuadCount, mesh.Status), (coarse, coarse, state.UP_TO_DATE))
        self.document.redo()
        self.assertEqual((mesh.FemMesh.FaceCount, mesh.QuadCount, mesh.Status), (fine, fine, state.UP_TO_DATE))
        self.document.undo()
        self.document.undo()
        self.assertEqual(len(self.document.Objects), 1)

    def test_documents_keep_it(self):
        mesh = core.mesh_surface(self.box(), size=4)
        name = mesh.Name
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "scan.FCStd")
            self.document.saveAs(path)
            FreeCAD.closeDocument(self.document.Name)
            self.document = FreeCAD.openDocument(path)
        again = self.document.getObject(name)
        self.document.recompute()
        self.assertTrue(state.is_surface_mesh(again))
        self.assertEqual(type(again.Proxy).__module__, "quadrille.surfaces")  # as in documents of older versions
        self.assertEqual(surfaces.judge(again)[0], state.UP_TO_DATE)
        again.FeatureAngle = 100
        core.remesh(again)
        self.assertEqual(self.groups(again, "Face"), ["Face1"])

    def test_export_writes_the_same_mesh(self):
        mesh = core.mesh_surface(self.box(), size=4)
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "scan.inp"
            core.export(mesh, path)
            text = path.read_text(encoding="utf-8")
        self.assertIn("ELSET=Face6", text)
        self.assertIn("S8R", text)

    def test_errors_leave_the_document_as_it_is(self):
        part = self.document.addObject("Part::Box", "Part")
        self.document.recompute()
        empty = self.surface(Mesh.Mesh(), "Empty")
        box = self.box()
        # Three triangles on one side.
        fan = self.surface(Mesh.Mesh(), "Fan")
        fan.Mesh = Mesh.Mesh(([Vector(0, 0, 0), Vector(0, 0, 9), Vector(9, 0, 0), Vector(-9, 0, 0), Vector(0, 9, 0)],
                              [(0, 1, 2), (0, 1, 3), (0, 1, 4)]))
        before = [obj.Name for obj in self.document.Objects]
        for surface, options, sentence in (
                (part, {}, "^Part: is not a mesh object"), (empty, {}, "^Empty: has no triangles to mesh"),
                (box, {"size": -1}, "larger than 0"), (box, {"size": 1e-4}, "million elements.*take a larger Size"),
                (box, {"order": 3}, "[Oo]rder"), (box, {"feature_angle": 400}, "FeatureAngle"),
                (box, {"merge": -2}, "MergeDistance"), (fan, {"size": 2}, "^Fan: ")):
            with self.subTest(sentence), self.assertRaisesRegex(Error, sentence) as raised:
                core.mesh_surface(surface, **options)
            self.assertNotIn("\n", str(raised.exception))
            self.assertNotIn("surface.ply", str(raised.exception))
            self.assertEqual([obj.Name for obj in self.document.Objects], before)

    def test_cancelling(self):
        with self.assertRaises(Error) as raised:
            core.mesh_surface(self.box(), size=0.2, progress=lambda stage, fraction: False)
        self.assertEqual(raised.exception.kind, "cancelled")
        self.assertEqual(len(self.document.Objects), 1)

    @unittest.skipUnless(shutil.which("ccx"), "CalculiX is not installed")
    def test_a_beam_is_solved_with_loads_on_a_part_that_lies_on_it(self):
        length, width, depth, young, force = 40.0, 10.0, 1.0, 210000.0, 2.0
        strip = Mesh.Mesh(([Vector(x, y, 0) for x in (0, length) for y in (0, width)], [(0, 2, 3), (0, 3, 1)]))
        part = self.document.addObject("Part::Feature", "Helper")
        part.Shape = Part.makePlane(length, width)
        across = sorted((edge.CenterOfMass.x, f"Edge{i}") for i, edge in enumerate(part.Shape.Edges, 1)
                        if edge.BoundBox.XLength < 1e-9)
        analysis = ObjectsFem.makeAnalysis(self.document, "Analysis")
        mesh = core.mesh_surface(self.surface(strip), size=2.5, analysis=analysis)
        material = analysis.addObject(ObjectsFem.makeMaterialSolid(self.document, "Material"))[0]
        material.Material = {"Name": "M", "YoungsModulus": f"{young} MPa", "PoissonRatio": "0.0"}
        analysis.addObject(ObjectsFem.makeElementGeometry2D(self.document, depth, "Thickness"))
        fixed = analysis.addObject(ObjectsFem.makeConstraintFixed(self.document, "Fixed"))[0]
        fixed.References = [(part, across[0][1])]
        load = analysis.addObject(ObjectsFem.makeConstraintForce(self.document, "Force"))[0]
        load.References = [(part, across[1][1])]
        load.Force = f"{force} N" if FreeCAD.Version()[0] != "0" else force
        load.Direction, load.Reversed = (part, ["Face1"]), False
        self.document.recompute()
        with tempfile.TemporaryDirectory() as folder:
            solver_test.solve_standard(self.document, analysis, folder)
            written = "".join(path.read_text(encoding="utf-8") for path in Path(folder).glob("*.inp"))
        self.assertIn("TYPE=S8R", written)
        result = next(obj for obj in analysis.Group if obj.isDerivedFrom("Fem::FemResultObject"))
        wanted = force * length**3 / (3 * young * width * depth**3 / 12)
        self.assertAlmostEqual(max(abs(v.z) for v in result.DisplacementVectors) / wanted, 1, 2)
        mesh.Size = 5
        self.document.recompute()
        with self.assertRaisesRegex(AssertionError, "the settings have changed"):
            solver_test.solve_standard(self.document, analysis, tempfile.gettempdir())


if __name__ == "__main__":
    unittest.main()
