"""Faces, sizes and flips through edits of the part, documents of the first version, and FreeCAD functions that are gone."""

import importlib.util
import os
import shutil
import sys
import tempfile
import unittest
from pathlib import Path
from types import SimpleNamespace
from unittest import mock

sys.path.insert(0, os.environ["QUADRILLE_PYTHON"])

import FreeCAD
import ObjectsFem
import Part
import numpy as np
from FreeCAD import Vector

import quadrille
import quadrille.freecad as core
from quadrille.core import quality
from quadrille.core.setting_table import MeshSettings
from quadrille.document import links, picks, shapes, state
from quadrille.solvers import wrappers

#: FreeCAD 1.1's. Imported now: it imports VTK, which cannot be loaded again once a test has put sys.modules back.
NEWER_TOOLS = importlib.util.find_spec("femsolver.calculix.calculixtools")
if NEWER_TOOLS:
    importlib.import_module("femsolver.calculix.calculixtools")

DATA = Path(__file__).resolve().parent / "data"


def faces_of(mesh):
    """The names of the faces that the mesh has elements on."""
    fem_mesh = mesh.FemMesh
    return {fem_mesh.getGroupName(i) for i in fem_mesh.Groups if fem_mesh.getGroupElementType(i) == "Face"
            and fem_mesh.getGroupName(i).startswith("Face") and fem_mesh.getGroupElements(i)}


class LinksTest(unittest.TestCase):
    """Each test has a document of its own."""

    def setUp(self):
        self.document = FreeCAD.newDocument("Test")
        self.part = self.document.addObject("Part::Feature", "Part")
        self.part.Shape = Part.makeBox(20, 20, 20)

    def tearDown(self):
        FreeCAD.closeDocument(self.document.Name)

    def edit(self, shape):
        """The part is edited."""
        self.part.Shape = shape
        self.document.recompute()

    @staticmethod
    def renumbered(shape, order):
        """The same shape, its faces in another order."""
        return Part.makeCompound([shape.Faces[index] for index in order])

    def test_links_are_kept(self):
        mesh = core.mesh_object(self.part, size=5, faces=[6, "Face1"])
        self.assertEqual(mesh.Faces, [(self.part, ("Face6", "Face1"))])
        core.flip(mesh, [1])
        self.assertEqual(mesh.FlippedFaces, [(self.part, ("Face1",))])
        self.assertIn("Links", mesh.getTypeIdOfProperty("Faces").replace("LinkSubList", "Links"))

    def test_faces_that_have_moved_or_grown_keep_their_names(self):
        mesh = core.mesh_object(self.part, size=5, faces=[6])
        self.edit(Part.makeBox(20, 30, 25))
        self.assertEqual(mesh.Status, state.PART_CHANGED)
        core.remesh(mesh)
        self.assertEqual(links.names_in(mesh.Faces), ["Face6"])
        self.assertAlmostEqual(mesh.FemMesh.BoundBox.ZMin, 25)

    def test_faces_numbered_anew_are_followed(self):
        self.edit(self.renumbered(Part.makeBox(20, 20, 20), range(6)))
        mesh = core.mesh_object(self.part, size=5, faces=[6])
        core.refine(mesh, [(self.part, ("Face6",))], 1)
        core.flip(mesh, [6])
        shape = Part.makeBox(20, 20, 20).cut(Part.makeCylinder(3, 5, Vector(10, 10, 0)))  # a hole in the bottom: other numbers
        top = next(i for i, face in enumerate(shape.Faces, 1) if face.CenterOfMass.z > 19.9)
        self.assertNotEqual(top, 6)
        self.edit(shape)
        self.assertEqual(mesh.Status, state.PART_CHANGED)
        core.remesh(mesh)
        self.assertEqual(mesh.Status, state.UP_TO_DATE)
        self.assertEqual(faces_of(mesh), {f"Face{top}"})
        for found in (mesh.Faces, mesh.FlippedFaces, mesh.MeshRegionList[0].References):
            self.assertEqual(found, [(self.part, (f"Face{top}",))])
        self.assertAlmostEqual(mesh.FemMesh.BoundBox.ZMin, 20)
        self.assertLess(quality.measure(mesh.FemMesh).normals[:, 2].max(), 0)  # still turned over

    def test_a_face_that_cannot_be_told_is_asked_for(self):
        mesh = core.mesh_object(self.part, size=5, faces=[6])
        before = mesh.FemMesh.FaceCount
        with mock.patch("FreeCAD.Console.PrintWarning") as told:
            self.edit(Part.makeBox(20, 20, 20).cut(Part.makeCylinder(3, 30, Vector(10, 10, 0))))  # through: the top is another
        self.assertEqual(mesh.Status, state.LOST)
        self.assertEqual([call.args[0].count(mesh.Label) for call in told.call_args_list], [1])  # names it, once
        for call in (lambda: core.remesh(mesh), lambda: core.export(mesh, "/tmp/never.inp"), lambda: core.flip(mesh, [1])):
            with self.assertRaises(quadrille.Error) as caught:
                call()
            self.assertIn("Face6", str(caught.exception))
        self.assertIn("Face6", core.complaint(mesh))
        self.assertEqual(mesh.FemMesh.FaceCount, before)
        top = next(i for i, face in enumerate(self.part.Shape.Faces, 1) if face.CenterOfMass.z > 19.9)
        mesh.Faces = [(self.part, (f"Face{top}",))]
        self.document.recompute()
        self.assertEqual(mesh.Status, state.PART_CHANGED)
        core.remesh(mesh)
        self.assertEqual(faces_of(mesh), {f"Face{top}"})

    def test_the_same_name_chosen_again_counts_as_chosen(self):
        mesh = core.mesh_object(self.part, size=5, faces=[6])
        self.edit(Part.makeBox(20, 20, 20).cut(Part.makeCylinder(3, 30, Vector(10, 10, 0))))
        self.assertEqual(mesh.Status, state.LOST)
        mesh.Faces = [(self.part, ("Face6",))]
        core.remesh(mesh)
        self.assertEqual(faces_of(mesh), {"Face6"})

    def test_picks_are_known_with_and_without_their_history(self):
        """FreeCAD 1.0 names what is picked by its history too."""
        picked = SimpleNamespace(Object=self.part, SubElementNames=("Face3", ";#1c:2;:H8dc,E.Edge5", "Body.Pad.;#16:2;:G,F.Face2",
                                                                    "Body.Pad.", "Body.Pad.Vertex1"))
        self.assertEqual([name for _, name in picks.picks_of([picked])],
                         ["Face3", "Edge5", "Body.Pad.Face2", "Body.Pad.", "Body.Pad.Vertex1"])
        self.assertEqual(picks.elements_of(self.part, picks.picks_of([picked])[:2]), ["Face3", "Edge5"])

    def test_a_vertex_picked_on_the_mesh_of_another_part_is_a_point(self):
        other = self.document.addObject("Part::Box", "Other")
        other.Placement.Base.x = 100
        self.document.recompute()
        mesh = core.mesh_object(other, size=5)
        self.assertEqual(picks.points_of(self.part, [(mesh, "Vertex1"), (mesh, "")]), {"Node1": tuple(other.Shape.Vertexes[0].Point)})

    def test_two_faces_that_have_changed_places_are_asked_for(self):
        self.edit(self.renumbered(Part.makeBox(20, 20, 20), range(6)))
        mesh = core.make_mesh(self.part, size=5, faces=[1])
        record = shapes.topology(self.part.Shape)
        with mock.patch.object(shapes, "topology", lambda _shape: record):  # put together as before, say
            self.edit(self.renumbered(Part.makeBox(20, 20, 20), (1, 0, 2, 3, 4, 5)))
            with self.assertRaises(quadrille.Error):
                links.follow(mesh)

    def test_a_refinement_of_a_lost_edge_is_asked_for(self):
        mesh = core.mesh_object(self.part, size=5, sizes={"Edge1": 1.0})
        self.edit(Part.makeCylinder(5, 10))
        self.assertEqual(mesh.Status, state.LOST)
        self.assertIn("Edge1", core.complaint(mesh))

    def test_records_are_saved(self):
        mesh = core.mesh_object(self.part, size=5, faces=[6])
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "saved.FCStd")
            self.document.saveAs(path)
            FreeCAD.closeDocument(self.document.Name)
            self.document = FreeCAD.openDocument(path)
        mesh, self.part = self.document.QuadMesh, self.document.Part
        self.document.recompute(None, True)
        self.assertEqual(mesh.Status, state.UP_TO_DATE)
        self.edit(Part.makeBox(20, 20, 20).cut(Part.makeCylinder(3, 30, Vector(10, 10, 0))))
        self.assertEqual(mesh.Status, state.LOST)

    def test_topology_does_not_depend_on_measures(self):
        one, other = Part.makeBox(1, 2, 3), Part.makeBox(3, 2, 1)
        self.assertEqual(shapes.topology(one), shapes.topology(other))
        self.assertNotEqual(shapes.topology(one), shapes.topology(Part.makeCylinder(1, 2)))

    def test_status_is_an_enumeration(self):
        mesh = core.make_mesh(self.part, size=5)
        self.assertEqual(mesh.getEnumerationsOfProperty("Status"), list(state.STATUSES))
        self.assertEqual(mesh.Status, state.NOT_MESHED)
        region = core.refine(mesh, [(self.part, ("Face1",))], 1)
        core.remesh(mesh)
        region.CharacteristicLength = 0
        self.document.recompute()
        self.assertEqual(mesh.Status, state.SENSELESS)

    def test_several_parts_share_their_nodes(self):
        other = self.document.addObject("Part::Feature", "Other")
        other.Shape = Part.makeBox(20, 20, 20, Vector(20, 0, 0))
        joined = core.fragments([self.part, other])
        self.assertEqual(len(joined.Shape.Faces), 11)
        mesh = core.mesh_object(joined, size=5)
        self.assertEqual(len(quality.measure(mesh.FemMesh).double_nodes()), 0)

    def test_free_sides_and_double_nodes(self):
        closed = quality.measure(core.mesh_object(self.part, size=5).FemMesh)
        self.assertEqual((len(closed.free_sides()), len(closed.double_nodes())), (0, 0))
        sheet = self.document.addObject("Part::Feature", "Sheet")
        sheet.Shape = Part.makeCompound([Part.makePlane(10, 10), Part.makePlane(10, 10, Vector(10, 0, 0))])
        measured = quality.measure(core.mesh_object(sheet, size=5, order=1).FemMesh)
        self.assertEqual((len(measured.free_sides()), len(measured.double_nodes())), (16, 3))

    def test_nodes_that_round_apart_are_double_nodes(self):
        left, right, out = 1.000001 - 1e-9, 1.000001 + 1e-9, 2.0
        corners = np.array([[(x, y, 0) for x, y in ((low, 0), (high, 0), (high, 1), (low, 1))]
                            for low, high in ((0, left), (right, out))])
        measured = quality.measure_quads(np.arange(2), np.arange(8).reshape(2, 4), corners)
        self.assertEqual(measured.double_nodes().round(3).tolist(), [[1, 0, 0], [1, 1, 0]])

    def test_criteria_are_the_meshers(self):
        part = self.document.addObject("Part::Feature", "Cone")
        part.Shape = Part.makeCone(10, 0.5, 6).fuse(Part.makeBox(13, 2, 4))
        fem_mesh, report = core.ShapeJob(part.Shape, MeshSettings(size=2.5, order=1)).start().wait_for_result()
        measured = quality.measure(fem_mesh, least_size=2.5 / 8)
        counted = {name: int(measured.fails(name).sum()) for name in quality.CRITERIA}
        wanted = {name: entry["failing"] for name, entry in report["criteria"]["by_criterion"].items()}
        limits = {name: entry["limit"] for name, entry in report["criteria"]["by_criterion"].items()}
        self.assertEqual(counted, wanted)
        self.assertEqual({name: limit for name, (_, limit) in measured.limits.items()}, limits)
        self.assertGreater(sum(counted.values()), 0)


class OldDocumentTest(unittest.TestCase):
    """A document that version 0.1.0 wrote, see data/make_old_document.py."""

    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        path = os.path.join(self.folder.name, "old.FCStd")
        shutil.copy(DATA / "version-0.1.0.FCStd", path)
        self.document = FreeCAD.openDocument(path)

    def tearDown(self):
        FreeCAD.closeDocument(self.document.Name)
        self.folder.cleanup()

    def test_it_opens_with_all_that_it_had(self):
        document = self.document
        whole, part, stale, box = document.Whole, document.Part, document.Stale, document.Box
        self.assertEqual([mesh.QuadCount for mesh in (whole, part, stale)], [170, 234, 150])
        self.assertEqual(part.Faces, [(box, ("Face1", "Face5"))])
        self.assertEqual(whole.FlippedFaces, [(box, ("Face2",))])
        self.assertEqual([mesh.Status for mesh in (whole, part, stale)],
                         [state.UP_TO_DATE, state.UP_TO_DATE, state.SETTINGS_CHANGED])
        document.recompute(None, True)
        self.assertEqual([mesh.Status for mesh in (whole, part, stale)],
                         [state.UP_TO_DATE, state.UP_TO_DATE, state.SETTINGS_CHANGED])
        # FreeCAD 0.20 does not ask them again in a recompute.
        self.assertEqual([state.judge(mesh)[0] for mesh in (whole, part, stale)],
                         [state.UP_TO_DATE, state.UP_TO_DATE, state.SETTINGS_CHANGED])

    def test_it_is_meshed_again(self):
        for mesh in (self.document.Part, self.document.Stale):
            core.remesh(mesh)
            self.assertEqual(mesh.Status, state.UP_TO_DATE)
        part = self.document.Part
        self.assertEqual(part.QuadCount, 234)
        self.assertEqual(faces_of(part), {"Face1", "Face5"})
        sizes = {names: region.CharacteristicLength for region in part.MeshRegionList for _, names in region.References}
        self.assertEqual(sizes, {("Face5",): 1.0, ("Edge2",): 0.5})
        self.assertNotIn("Sizes", part.PropertiesList)

    def test_options_that_are_gone_are_left_behind(self):
        path = self.document.FileName
        self.document.Part.addProperty("App::PropertyStringList", "Layers", "Mesh").Layers = ["Edge1=0.1,1.2,6"]
        self.document.Part.addProperty("App::PropertyStringList", "Match", "Mesh").Match = ["Face1=Face5"]
        self.document.Part.addProperty("App::PropertyFloat", "ProximityWalls", "Mesh").ProximityWalls = 2
        self.document.save()
        FreeCAD.closeDocument(self.document.Name)
        self.document = FreeCAD.openDocument(path)
        for name in ("Layers", "Match", "ProximityWalls"):
            self.assertNotIn(name, self.document.Part.PropertiesList)
        self.assertEqual(self.document.Part.Status, state.UP_TO_DATE)


class GuardTest(unittest.TestCase):
    """FreeCAD's private functions may go: each costs one feature and a warning."""

    FUNCTIONS = [
        ("femsolver.run", "Check.check_mesh_exists"), ("femtools.checksanalysis", "check_member_for_solver_calculix"),
        ("femtools.membertools", "get_mesh_to_solve"),
        ("femmesh.meshtools", "get_femelement_table"), ("femmesh.meshtools", "get_femelement_faces_table"),
        ("femmesh.meshtools", "get_femelement_sets"), ("femmesh.meshtools", "get_femelements_by_references"),
        ("femmesh.meshtools", "get_femelements_by_femnodes_std"),
        ("femmesh.meshtools", "get_femnodes_ele_table"), ("femmesh.meshtools", "get_force_obj_face_nodeload_table"),
        ("femsolver.calculix.write_mesh", "write_mesh"),
        ("femsolver.calculix.write_constraint_force", "write_meshdata_constraint"),
        ("femsolver.calculix.writer", "FemInputWriterCcx.write_solver_input"),
    ]

    def setUp(self):
        self.document = FreeCAD.newDocument("Test")
        self.part = self.document.addObject("Part::Feature", "Part")
        self.part.Shape = Part.makeBox(10, 10, 10)

    def tearDown(self):
        FreeCAD.closeDocument(self.document.Name)

    def wrapped_without(self, module, name):
        """Wraps FreeCAD's functions, one of which is missing; gives the warnings."""
        owner = importlib.import_module(module)
        *outer, last = name.split(".")
        for attribute in outer:
            owner = getattr(owner, attribute)
        kept = getattr(owner, last)
        delattr(owner, last)
        try:
            with mock.patch.object(wrappers, "_complaint", None), mock.patch("FreeCAD.Console.PrintWarning") as told:
                wrappers.wrap_solvers(core.complaint)
                mesh = core.mesh_object(self.part, size=5)
            self.assertEqual(mesh.Status, state.UP_TO_DATE)
            self.document.removeObject(mesh.Name)
            return [call.args[0] for call in told.call_args_list]
        finally:
            setattr(owner, last, kept)

    def test_each_may_be_missing(self):
        self.assertEqual(len(self.FUNCTIONS), len(wrappers.WRAPPED))
        for module, name in self.FUNCTIONS:
            with self.subTest(name=name):
                warnings = self.wrapped_without(module, name)
                self.assertEqual(len([text for text in warnings if f"{module}.{name}" in text]), 1, warnings)

    def test_a_module_may_be_missing(self):
        with mock.patch.dict(sys.modules, {"femmesh.meshtools": None}), mock.patch.object(wrappers, "_complaint", None), \
                mock.patch("FreeCAD.Console.PrintWarning") as told:
            wrappers.wrap_solvers(core.complaint)
            mesh = core.mesh_object(self.part, size=5)
        self.assertEqual(mesh.Status, state.UP_TO_DATE)
        self.assertEqual(len([call for call in told.call_args_list if "no femmesh.meshtools." in call.args[0]]), 7)

    if NEWER_TOOLS:  # older versions have no such solver object, and lack no test

        def test_a_stale_mesh_is_refused_where_a_check_is_dropped(self):
            """As CalculiXTools.prepare() of FreeCAD 1.1 does."""
            from femsolver.calculix.calculixtools import CalculiXTools

            analysis = ObjectsFem.makeAnalysis(self.document, "Analysis")
            material = analysis.addObject(ObjectsFem.makeMaterialSolid(self.document, "Steel"))[0]
            material.Material = {"Name": "Steel", "YoungsModulus": "210000 MPa", "PoissonRatio": "0.3"}
            analysis.addObject(ObjectsFem.makeElementGeometry2D(self.document, 1.0, "Thickness"))
            solver = analysis.addObject(ObjectsFem.makeSolverCalculiX(self.document, "Solver"))[0]
            mesh = core.mesh_object(self.part, size=5, analysis=analysis)
            with tempfile.TemporaryDirectory() as folder:
                solver.WorkingDirectory = folder
                tool = CalculiXTools(solver)
                self.part.Shape = Part.makeBox(10, 10, 12)
                self.assertRaisesRegex(RuntimeError, "the part has changed", tool.prepare)
                self.assertEqual(os.listdir(folder), [])
                core.remesh(mesh)
                tool.prepare()
                self.assertTrue(os.path.isfile(tool.model_file))


result = unittest.main(argv=[sys.argv[0], "-v"], exit=False).result
sys.exit(0 if result.wasSuccessful() and result.testsRun else 1)
