"""quadrille.freecad.mesh_object in real FreeCAD: meshes, groups, saving, solver objects, errors."""

import math
import os
import shutil
import sys
import tempfile
import unittest
from unittest import mock
from pathlib import Path

sys.path.insert(0, os.environ["QUADRILLE_PYTHON"])

import FreeCAD
import ObjectsFem
import Part
from FreeCAD import Vector

import quadrille
import quadrille.freecad
from quadrille.freecad import mesh_object, remesh
from quadrille.solvers import element_types

MODELS = Path(os.environ["QUADRILLE_MODELS"])


def group(mesh, name, kind):
    """The ids in the group of a mesh that has this name and kind."""
    fem_mesh = mesh.FemMesh
    for number in fem_mesh.Groups:
        if fem_mesh.getGroupName(number) == name and fem_mesh.getGroupElementType(number) == kind:
            return fem_mesh.getGroupElements(number)
    return ()


class MeshObjectTest(unittest.TestCase):
    """Each test has a document of its own."""

    def setUp(self):
        self.document = FreeCAD.newDocument("Test")

    def tearDown(self):
        FreeCAD.closeDocument(self.document.Name)

    def part(self, shape, name="Part"):
        """A document object with a shape."""
        part = self.document.addObject("Part::Feature", name)
        part.Shape = shape
        return part

    def model(self, file):
        """A sample model as a document object."""
        return self.part(Part.read(str(MODELS / file)))

    def check_mesh(self, mesh, order):
        """All quads of the order; nodes and elements in the groups of their faces, edges and vertices."""
        fem_mesh, shape = mesh.FemMesh, mesh.Shape.Shape
        self.assertGreater(fem_mesh.FaceCount, 0)
        self.assertEqual(fem_mesh.TriangleCount, 0)
        self.assertEqual(fem_mesh.FaceCount, fem_mesh.QuadrangleCount)
        self.assertEqual({len(fem_mesh.getElementNodes(i)) for i in fem_mesh.Faces}, {4 if order == 1 else 8})
        elements = [group(mesh, f"Face{i}", "Face") for i in range(1, len(shape.Faces) + 1)]
        self.assertTrue(all(elements))
        self.assertEqual(sorted(i for ids in elements for i in ids), sorted(fem_mesh.Faces))
        edge_elements = {i: group(mesh, f"Edge{i}", "Edge") for i in range(1, len(shape.Edges) + 1)}
        nodes = fem_mesh.Nodes
        for i, edge in enumerate(shape.Edges, 1):
            if edge.Degenerated:
                continue
            self.assertTrue(edge_elements[i], f"Edge{i}")
            for element in list(edge_elements[i])[:5]:
                for node in fem_mesh.getElementNodes(element):
                    self.assertLess(edge.distToShape(Part.Vertex(nodes[node]))[0], 1e-5, f"Edge{i}")
        for i, face in enumerate(shape.Faces, 1):
            for element in list(elements[i - 1])[:5]:
                for node in fem_mesh.getElementNodes(element):
                    self.assertLess(face.distToShape(Part.Vertex(nodes[node]))[0], 1e-5, f"Face{i}")
        for i, vertex in enumerate(shape.Vertexes, 1):
            ids = group(mesh, f"Vertex{i}", "Node")
            self.assertEqual(len(ids), 1, f"Vertex{i}")
            self.assertLess((nodes[ids[0]] - vertex.Point).Length, 1e-6)

    def test_meshes_of_both_orders_with_groups(self):
        for order in (1, 2):
            for file, size in (("box.brep", 4), ("cylinder.brep", 4), ("two_solids.brep", 5), ("t_junction.brep", 6)):
                with self.subTest(file=file, order=order):
                    self.check_mesh(mesh_object(self.model(file), size=size, order=order), order)

    def test_bracket(self):
        mesh = mesh_object(self.model("bracket.step"), size=3, order=2)
        self.check_mesh(mesh, 2)
        self.assertGreater(mesh.MeanQuality, 0.8)
        self.assertGreater(mesh.WorstJacobian, 0)
        self.assertEqual(mesh.QuadCount, mesh.FemMesh.FaceCount)

    def test_type_is_one_that_fem_accepts(self):
        mesh = mesh_object(self.part(Part.makeBox(10, 10, 10)), size=5)
        self.assertTrue(mesh.isDerivedFrom("Fem::FemMeshObject"))
        old = FreeCAD.Version()[0] == "0"
        self.assertEqual(mesh.TypeId,
                         "Fem::FemMeshObjectPython" if old else "Fem::FemMeshShapeBaseObjectPython")

    def test_normals_point_out_of_a_solid(self):
        mesh = mesh_object(self.part(Part.makeBox(10, 10, 10)), size=5, order=1).FemMesh
        nodes = mesh.Nodes
        for element in mesh.Faces:
            a, b, c, d = (nodes[i] for i in mesh.getElementNodes(element))
            self.assertGreater((c - a).cross(d - b) * ((a + c) / 2 - Vector(5, 5, 5)), 0)

    def test_placement_of_the_part_counts(self):
        part = self.part(Part.makeBox(10, 10, 10))
        part.Placement.Base = Vector(100, 0, 0)
        mesh = mesh_object(part, size=5)
        self.assertAlmostEqual(mesh.FemMesh.BoundBox.XMin, 100, 6)

    def test_faces_and_sizes(self):
        part = self.part(Part.makeBox(20, 20, 20))
        top = mesh_object(part, size=5, faces=[6])
        self.assertFalse(group(top, "Face1", "Face"))
        self.assertTrue(group(top, "Face6", "Face"))
        coarse = mesh_object(part, size=5)
        fine = mesh_object(part, size=5, sizes={"Face6": 1.0})
        self.assertGreater(len(group(fine, "Face6", "Face")), 4 * len(group(coarse, "Face6", "Face")))

    def stacked(self):
        """A box of 10, and one of 4 that stands on the middle of its top, in one compound."""
        return self.part(Part.makeCompound([Part.makeBox(10, 10, 10), Part.makeBox(4, 4, 6, Vector(3, 3, 10))]))

    def test_imprint(self):
        part = self.stacked()
        self.assertFalse(mesh_object(part, size=2, order=1).Imprint)
        mesh = mesh_object(part, size=2, order=1, imprint=True)
        self.assertTrue(mesh.Imprint)
        self.assertEqual(mesh.Status, "up to date")
        fem_mesh, shape = mesh.FemMesh, part.Shape
        nodes = fem_mesh.Nodes
        self.assertEqual(len({tuple(round(x, 6) for x in point) for point in nodes.values()}), len(nodes))

        def corners(element):
            return [nodes[node] for node in fem_mesh.getElementNodes(element)]

        # The groups are those of FreeCAD's faces, edges and vertices, also of those that were cut or became one.
        for i, face in enumerate(shape.Faces, 1):
            area = 0.0
            for element in group(mesh, f"Face{i}", "Face"):
                a, b, c, d = corners(element)
                area += (c - a).cross(d - b).Length / 2
            self.assertAlmostEqual(area, face.Area, 6, f"Face{i}")
        for i, edge in enumerate(shape.Edges, 1):
            length = sum((b - a).Length for a, b in map(corners, group(mesh, f"Edge{i}", "Edge")))
            self.assertAlmostEqual(length, edge.Length, 6, f"Edge{i}")
        for i, vertex in enumerate(shape.Vertexes, 1):
            node, = group(mesh, f"Vertex{i}", "Node")
            self.assertLess((nodes[node] - vertex.Point).Length, 1e-6, f"Vertex{i}")
        names = [fem_mesh.getGroupName(number) for number in fem_mesh.Groups]
        self.assertEqual(len(names), len(set(names)))
        self.assertEqual(len(names), len(shape.Faces) + len(shape.Edges) + len(shape.Vertexes))

    def test_imprint_takes_the_names_of_the_part(self):
        part = self.stacked()
        shape = part.Shape
        top = next(i for i, face in enumerate(shape.Faces, 1) if abs(face.Area - 100) < 1e-6 and face.CenterOfMass.z > 9)
        foot = next(i for i, edge in enumerate(shape.Edges, 1) if abs(edge.Length - 4) < 1e-6 and abs(edge.CenterOfMass.z - 10) < 1e-6)
        upright = next(i for i, edge in enumerate(shape.Edges, 1) if abs(edge.Length - 6) < 1e-6)
        coarse = mesh_object(part, size=2, order=1, imprint=True)
        fine = mesh_object(part, size=2, order=1, imprint=True, sizes={f"Face{top}": 0.5, f"Edge{upright}": 0.25})
        self.assertGreater(len(group(fine, f"Face{top}", "Face")), 8 * len(group(coarse, f"Face{top}", "Face")))
        self.assertGreaterEqual(len(group(fine, f"Edge{upright}", "Edge")), 20)
        divided = mesh_object(part, size=2, order=1, imprint=True, segments=[f"Edge{foot}=10"])
        self.assertEqual(len(group(divided, f"Edge{foot}", "Edge")), 10)
        only = mesh_object(part, size=2, order=1, imprint=True, faces=[top])
        self.assertEqual(only.FemMesh.FaceCount, len(group(only, f"Face{top}", "Face")))

    def test_imprint_of_a_single_part_changes_nothing(self):
        box = self.part(Part.makeBox(10, 10, 10))
        plain, mesh = (mesh_object(box, size=2, imprint=imprint) for imprint in (False, True))
        self.check_mesh(mesh, 2)
        self.assertEqual(mesh.FemMesh.FaceCount, plain.FemMesh.FaceCount)

    def test_strict(self):
        box = self.part(Part.makeBox(10, 10, 10))
        mesh = mesh_object(box, size=2, strict=True)
        self.assertTrue(mesh.Strict)
        job = quadrille.freecad.start(mesh)
        self.assertIn("--strict", job._job._arguments)
        quadrille.freecad.finish(mesh, job)
        mesh.Strict = False
        self.document.recompute()
        self.assertEqual(mesh.Status, "the settings have changed: mesh again")
        self.assertNotIn("strict", [name for name, value in quadrille.features.mesh_object.defaults().items() if value])

    def test_lengths_with_units(self):
        part = self.part(Part.makeBox(20, 20, 20))
        millimeters = mesh_object(part, size=5).FemMesh
        self.assertEqual(mesh_object(part, size="0.5 cm").FemMesh.FaceCount, millimeters.FaceCount)
        self.assertEqual(mesh_object(part, size=FreeCAD.Units.Quantity("5 mm")).FemMesh.FaceCount,
                         millimeters.FaceCount)

    def test_saved_and_reopened(self):
        part = self.model("bracket.step")
        mesh = mesh_object(part, name="Quads", size=6, order=2, sizes={"Face3": 3.0}, faces=())
        quads, groups = mesh.FemMesh.FaceCount, mesh.FemMesh.GroupCount
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "saved.FCStd")
            self.document.saveAs(path)
            FreeCAD.closeDocument(self.document.Name)
            self.document = FreeCAD.openDocument(path)
        mesh = self.document.Quads
        self.assertIsInstance(mesh.Proxy, quadrille.freecad.MeshFeature)
        self.assertEqual(type(mesh.Proxy).__module__, "quadrille.freecad")  # as in documents of older versions
        self.assertEqual(mesh.Shape.Name, "Part")
        self.assertEqual((mesh.FemMesh.FaceCount, mesh.FemMesh.GroupCount), (quads, groups))
        self.assertEqual((mesh.Size.Value, mesh.ElementOrder), (6.0, "2nd"))
        self.assertEqual([(region.References, region.CharacteristicLength) for region in mesh.MeshRegionList],
                         [([(self.document.Part, ("Face3",))], 3.0)])
        remesh(mesh)
        self.assertEqual(mesh.FemMesh.FaceCount, quads)

    def test_remesh_after_a_change(self):
        box = self.document.addObject("Part::Box", "Box")
        self.document.recompute()
        mesh = mesh_object(box, size=2)
        before = mesh.FemMesh.FaceCount
        box.Length = 40
        self.document.recompute()
        remesh(mesh)
        self.assertGreater(mesh.FemMesh.FaceCount, before)
        self.assertAlmostEqual(mesh.FemMesh.BoundBox.XMax, 40, 6)

    def test_solver_accepts_the_mesh(self):
        from femtools import ccxtools, membertools

        part = self.part(Part.makePlane(40, 20))
        analysis = ObjectsFem.makeAnalysis(self.document, "Analysis")
        make_solver = getattr(ObjectsFem, "makeSolverCalculiXCcxTools", None) or ObjectsFem.makeSolverCalculixCcxTools
        solver = analysis.addObject(make_solver(self.document, "Solver"))[0]
        material = analysis.addObject(ObjectsFem.makeMaterialSolid(self.document, "Steel"))[0]
        material.Material = {"Name": "Steel", "YoungsModulus": "210000 MPa", "PoissonRatio": "0.3"}
        analysis.addObject(ObjectsFem.makeElementGeometry2D(self.document, 1.0, "Thickness"))
        fixed = analysis.addObject(ObjectsFem.makeConstraintFixed(self.document, "Fixed"))[0]
        fixed.References = [(part, "Edge1")]
        force = analysis.addObject(ObjectsFem.makeConstraintForce(self.document, "Force"))[0]
        force.References = [(part, "Edge3")]
        force.Force = "10 N" if FreeCAD.Version()[0] != "0" else 10.0
        force.Direction = (part, ["Edge2"])
        mesh = mesh_object(part, size=5, order=2, analysis=analysis)
        self.document.recompute()
        self.assertEqual(membertools.get_mesh_to_solve(analysis), (mesh, ""))
        with tempfile.TemporaryDirectory() as folder:
            fea = ccxtools.FemToolsCcx(analysis, solver, test_mode=True)
            fea.update_objects()
            fea.setup_working_dir(folder, create=True)
            problems = fea.check_prerequisites()
            self.assertFalse(problems)
            for reduced, offset, element, section in ((True, 0, "S8R", "*SHELL SECTION, ELSET"),
                                                      (False, 0.5, "S8", "*SHELL SECTION, OFFSET=0.5, ELSET")):
                mesh.ReducedShells, mesh.ShellOffset = reduced, offset
                with mock.patch("FreeCAD.Console.PrintMessage") as told:
                    fea.write_inp_file()
                text = Path(fea.inp_file_name).read_text()
                self.assertIn(f"TYPE={element}, ELSET=Efaces", text)
                self.assertIn(section, text)
                said = " ".join(call.args[0] for call in told.call_args_list)
                self.assertEqual("S8R" in said, reduced)
                self.assertEqual("offset 0.5" in said, bool(offset))

    def solved(self, part, mesh, supports, loaded, force):
        """The displacements by node that CalculiX finds. `supports`: edges, and directions in which they stay; `force`: N and
        the edge whose direction it has, on the edge `loaded`."""
        from femtools import ccxtools

        analysis = ObjectsFem.makeAnalysis(self.document, "Analysis")
        make_solver = getattr(ObjectsFem, "makeSolverCalculiXCcxTools", None) or ObjectsFem.makeSolverCalculixCcxTools
        solver = analysis.addObject(make_solver(self.document, "Solver"))[0]
        solver.BeamShellResultOutput3D = False  # the nodes of the mesh; FreeCAD 1.0 asks for those of the thick elements
        material = analysis.addObject(ObjectsFem.makeMaterialSolid(self.document, "Steel"))[0]
        material.Material = {"Name": "Steel", "YoungsModulus": "210000 MPa", "PoissonRatio": "0.3"}
        analysis.addObject(ObjectsFem.makeElementGeometry2D(self.document, 2.0, "Thickness"))
        for edge, axes in supports.items():
            support = analysis.addObject(ObjectsFem.makeConstraintDisplacement(self.document, "Support"))[0]
            support.References = [(part, edge)]
            for axis in axes:
                if hasattr(support, f"{axis}Fix"):  # FreeCAD 0.20
                    setattr(support, f"{axis}Fix", True)
                setattr(support, f"{axis}Free", False)
        load = analysis.addObject(ObjectsFem.makeConstraintForce(self.document, "Force"))[0]
        load.References, load.Direction = [(part, loaded)], (part, [force[1]])
        load.Force = f"{force[0]} N" if FreeCAD.Version()[0] != "0" else float(force[0])
        analysis.addObject(mesh)
        self.document.recompute()
        with tempfile.TemporaryDirectory() as folder:
            fea = ccxtools.FemToolsCcx(analysis, solver, test_mode=False)
            fea.update_objects()
            fea.setup_working_dir(folder, create=True)
            self.assertFalse(fea.check_prerequisites())
            fea.write_inp_file()
            self.assertIn(f"TYPE={mesh.Element},", Path(fea.inp_file_name).read_text())
            fea.setup_ccx()
            fea.ccx_run()
            fea.load_results()
        result = next(member for member in analysis.Group if member.isDerivedFrom("Fem::FemResultObject"))
        self.assertEqual(len(result.NodeNumbers), mesh.FemMesh.NodeCount)
        return dict(zip(result.NodeNumbers, result.DisplacementVectors))

    @unittest.skipUnless(shutil.which("ccx"), "CalculiX is not installed")
    def test_plane_and_membrane_elements_solve(self):
        """A strip of 40 mm x 10 mm x 2 mm is pulled by 1000 N, whichever way its face looks."""
        stretch = 1000 * 40 / (210000 * 10 * 2)
        for element, order, wanted, down in (("CPS8R", 2, stretch, True), ("CPS8", 2, stretch, False),
                                             ("CPS4", 1, stretch, True), ("CPE8", 2, stretch * (1 - 0.3**2), True),
                                             ("M3D4", 1, stretch, False), ("S4R", 1, stretch, False)):
            with self.subTest(element=element):
                face = Part.makePlane(40, 10)
                part = self.part(face.reversed() if down else face, "Strip")
                mesh = mesh_object(part, size=2, order=order)
                mesh.Element = element
                supports = {"Edge1": ("x",), "Edge4": ("y",)}
                if element[:3] not in ("CPS", "CPE"):
                    supports["Face1"] = ("z",)
                moves = self.solved(part, mesh, supports, "Edge3", (1000, "Edge2"))
                self.assertAlmostEqual(max(abs(move.x) for move in moves.values()) / wanted, 1, 3)

    @unittest.skipUnless(shutil.which("ccx"), "CalculiX is not installed")
    def test_axisymmetric_elements_solve(self):
        """A pipe of the radii 10 and 20 mm under pressure inside, by Lame's formula in plane strain."""
        pressure, inner, outer, height, modulus, ratio = 50.0, 10.0, 20.0, 5.0, 210000.0, 0.3
        part = self.part(Part.makePlane(outer - inner, height, Vector(inner, 0, 0)), "Pipe")
        mesh = mesh_object(part, size=1, order=2)
        mesh.Element = "CAX8R"
        edges = list(enumerate(part.Shape.Edges, 1))
        bore = next(i for i, edge in edges if abs(edge.CenterOfMass.x - inner) < 1e-6)
        ends = {f"Edge{i}": ("y",) for i, edge in edges if abs(edge.CenterOfMass.y - height / 2) > 1}
        moves = self.solved(part, mesh, ends, f"Edge{bore}",
                            (pressure * 2 * math.pi * inner * height, next(iter(ends))))
        k = pressure * inner**2 / (outer**2 - inner**2)
        wanted = (1 + ratio) / modulus * k * ((1 - 2 * ratio) * inner + outer**2 / inner)
        nodes = mesh.FemMesh.Nodes
        found = [move.x for node, move in moves.items() if abs(nodes[node].x - inner) < 1e-6]
        self.assertTrue(found)
        for value in found:
            self.assertAlmostEqual(abs(value) / wanted, 1, 2)

    def test_elements_that_do_not_suit_the_mesh(self):
        """CalculiX is not run, and a sentence says why."""
        flat = self.part(Part.makePlane(10, 5, Vector(-2, 0, 0)), "Flat")
        box = self.part(Part.makeBox(10, 10, 10), "Box")
        for part, order, element, words in ((flat, 2, "CPS4", "first order"), (flat, 1, "CPE8R", "second order"),
                                            (flat, 2, "CAX8", "x = -2"), (box, 2, "CPS8", "z = 0, and this one leaves it by 10"),
                                            (box, 1, "M3D4", ""), (flat, 2, "CPS8", ""), (box, 1, "shell", "")):
            with self.subTest(element=element, part=part.Label):
                mesh = mesh_object(part, size=2, order=order)
                mesh.Element = element
                said = element_types.problem_of(mesh)
                self.assertIn(words, said)
                self.assertEqual(bool(words), bool(said))

    def check_error(self, kind, words, *arguments, **options):
        """mesh_object fails with one sentence, and the document stays as it was."""
        before = len(self.document.Objects)
        with self.assertRaises(quadrille.Error) as caught:
            mesh_object(*arguments, **options)
        self.assertEqual(caught.exception.kind, kind)
        self.assertIn(words, str(caught.exception))
        self.assertNotIn("\n", str(caught.exception))
        self.assertEqual(len(self.document.Objects), before)

    def test_errors(self):
        box = self.part(Part.makeBox(10, 10, 10), "Box")
        line = self.part(Part.makeLine(Vector(), Vector(1, 0, 0)), "Line")
        empty = self.document.addObject("Part::Feature", "Empty")
        note = self.document.addObject("App::TextDocument", "Note")
        self.check_error("usage", "no faces", line)
        self.check_error("usage", "no faces", empty)
        self.check_error("usage", "no shape", note)
        self.check_error("usage", '"Size" must be', box, size=-1.0)
        self.check_error("usage", '"Size" must be', box, size=float("nan"))
        self.check_error("usage", "larger than the model", box, size=1000.0)
        self.check_error("usage", '"Order"', box, size=2.0, order=3)
        self.check_error("usage", "Face77", box, size=2.0, faces=[77])
        self.check_error("usage", '"Strategy"', box, size=2.0, strategy="magic")
        self.check_error("usage", "is not a FEM analysis", box, size=2.0, analysis=line)
        self.check_error("usage", "cannot be run", box, size=2.0, command="/nowhere/quadrille")
        analysis = ObjectsFem.makeAnalysis(self.document, "Analysis")
        mesh_object(box, size=5, analysis=analysis)
        self.check_error("usage", "one mesh only", box, size=2.0, analysis=analysis)

    def test_cancelled_by_progress(self):
        box = self.part(Part.makeBox(10, 10, 10), "Box")
        self.check_error("cancelled", "cancelled", box, size=0.02, progress=lambda stage, fraction: False)

    def test_progress_exception_comes_out(self):
        def fail(_stage, _fraction):
            raise ZeroDivisionError("in progress")

        box = self.part(Part.makeBox(10, 10, 10), "Box")
        with self.assertRaises(ZeroDivisionError):
            mesh_object(box, size=0.05, progress=fail)

    def test_failed_remesh_keeps_the_mesh(self):
        mesh = mesh_object(self.part(Part.makeBox(10, 10, 10), "Box"), size=5)
        quads = mesh.FemMesh.FaceCount
        mesh.Size = 500
        with self.assertRaises(quadrille.Error):
            remesh(mesh)
        self.assertEqual(mesh.FemMesh.FaceCount, quads)


if __name__ == "__main__":
    unittest.main(verbosity=2, warnings="ignore")  # FreeCAD and PySide warn by the hundred
