"""The workbench without a window: groups for solvers, mesh regions, flipped normals, stale meshes, export, estimate."""

import io
import os
import shutil
import stat
import subprocess
import sys
import tempfile
import time
import types
import unittest
import unittest.mock
from pathlib import Path

sys.path.insert(0, os.environ["QUADRILLE_PYTHON"])

import FreeCAD
import Fem
import ObjectsFem
import Part
from FreeCAD import Vector

import quadrille
import quadrille.freecad as core
from quadrille.core import command, quality
from quadrille.core.setting_table import MeshSettings
from quadrille.document import groups, shapes
from quadrille.features import sizes
from quadrille.solvers import shell_input, wrappers

MODELS = Path(os.environ["QUADRILLE_MODELS"])


def group(mesh, name, kind=None):
    """The ids in the group of a mesh object that has this name."""
    fem_mesh = mesh.FemMesh
    for number in fem_mesh.Groups:
        if fem_mesh.getGroupName(number) == name and kind in (None, fem_mesh.getGroupElementType(number)):
            return set(fem_mesh.getGroupElements(number))
    return set()


class AddonTest(unittest.TestCase):
    """Each test has a document of its own."""

    def setUp(self):
        self.document = FreeCAD.newDocument("Test")

    def tearDown(self):
        FreeCAD.closeDocument(self.document.Name)

    def box(self, length=10.0):
        """A parametric box of 10 x 10 x length."""
        box = self.document.addObject("Part::Box", "Box")
        box.Height = length
        self.document.recompute()
        return box

    def analysis(self):
        """An analysis with a fixed face and a pressure."""
        analysis = ObjectsFem.makeAnalysis(self.document, "Analysis")
        fixed = ObjectsFem.makeConstraintFixed(self.document, "Fixed")
        pressure = ObjectsFem.makeConstraintPressure(self.document, "Pressure")
        analysis.addObjects([fixed, pressure])
        return analysis, fixed, pressure

    # Groups

    def test_groups_of_constraints_are_what_a_search_finds(self):
        for order in (1, 2):
            with self.subTest(order=order):
                box = self.box()
                analysis, fixed, pressure = self.analysis()
                fixed.References = [(box, ("Face1", "Edge5", "Vertex8"))]
                pressure.References = [(box, "Face6")]
                mesh = core.mesh_object(box, size=2, order=order, analysis=analysis)
                fem_mesh, shape = mesh.FemMesh, box.Shape
                searched = {*fem_mesh.getNodesByFace(shape.Face1), *fem_mesh.getNodesByEdge(shape.Edge5),
                            *fem_mesh.getNodesByVertex(shape.Vertex8)}
                self.assertEqual(group(mesh, f"{fixed.Name}_Nodes", "Node"), searched)
                faces = group(mesh, f"{pressure.Name}_Faces", "Face")
                self.assertEqual(faces, group(mesh, "Face6"))
                self.assertTrue(faces)

    def test_a_constraint_changed_after_meshing_gets_its_nodes(self):
        box = self.box()
        analysis, fixed, _ = self.analysis()
        mesh = core.mesh_object(box, size=2, analysis=analysis)
        self.assertFalse(group(mesh, "Fixed_Nodes"))
        fixed.References = [(box, "Face1")]
        self.assertEqual(group(mesh, "Fixed_Nodes"), set(mesh.FemMesh.getNodesByFace(box.Shape.Face1)))
        fixed.References = [(box, "Face2")]
        self.assertEqual(group(mesh, "Fixed_Nodes"), set(mesh.FemMesh.getNodesByFace(box.Shape.Face2)))
        fixed.References = []
        self.assertFalse(group(mesh, "Fixed_Nodes"))
        self.assertEqual(len(group(mesh, "Face1")), 25)

    def test_a_constraint_added_after_meshing_gets_its_nodes(self):
        box = self.box()
        analysis, _, _ = self.analysis()
        mesh = core.mesh_object(box, size=2, order=1, analysis=analysis)
        late = ObjectsFem.makeConstraintFixed(self.document, "Late")
        late.References = [(box, "Face3")]
        self.assertFalse(group(mesh, "Late_Nodes"))
        analysis.addObject(late)
        self.assertEqual(len(group(mesh, "Late_Nodes")), 36)

    def test_mesh_groups(self):
        box = self.box()
        mesh = core.make_mesh(box, size=2, order=1)
        labeled = ObjectsFem.makeMeshGroup(self.document, mesh, True, "MeshGroup")
        labeled.Label = "Bolts"
        labeled.References = [(box, ("Edge1", "Edge2"))]
        core.remesh(mesh)
        self.assertEqual(group(mesh, "Bolts_Edges", "Edge"), group(mesh, "Edge1") | group(mesh, "Edge2"))
        late = ObjectsFem.makeMeshGroup(self.document, mesh, False, "Late")
        late.References = [(box, "Face1")]
        self.assertEqual(len(group(mesh, "Late_Faces", "Face")), 25)

    def test_references_to_another_object_are_found_by_geometry(self):
        box = self.box()
        copy = self.document.addObject("Part::Feature", "Copy")
        copy.Shape = box.Shape.copy()
        self.assertEqual(shapes.references_to_names(box.Shape, box, [(copy, ("Face4", "Vertex2"))]),
                         ["Face4", "Vertex2"])
        with self.assertRaises(quadrille.Error):
            shapes.references_to_names(box.Shape, box, [(box, "Face7")])

    def test_elements_from_groups_are_those_that_freecad_finds(self):
        from femmesh import meshtools

        box = self.box()
        analysis, _, _ = self.analysis()
        material = analysis.addObject(ObjectsFem.makeMaterialSolid(self.document, "Steel"))[0]
        material.References = [(box, ("Face1", "Face5"))]
        for order in (1, 2):
            mesh = core.mesh_object(box, size=2, order=order, analysis=analysis)
            table = meshtools.get_femelement_faces_table(mesh.FemMesh)
            answers = []
            for fem_mesh in (mesh.FemMesh, mesh.FemMesh.copy()):
                for number in fem_mesh.Groups if answers else ():
                    fem_mesh.removeGroup(number)  # now FreeCAD searches
                rows = [{"Object": material}]
                meshtools.get_femelement_sets(fem_mesh, table, rows)
                answers.append(sorted(rows[0]["FEMElements"]))
            self.assertEqual(answers[0], answers[1])
            self.assertEqual(set(answers[0]), group(mesh, "Face1") | group(mesh, "Face5"))
            self.document.removeObject(mesh.Name)

    def test_forces_on_faces_are_those_that_freecad_finds(self):
        from femmesh import meshtools

        part = self.document.addObject("Part::Feature", "Part")
        part.Shape = Part.makeCylinder(5, 20).fuse(Part.makeBox(20, 4, 4))
        analysis, _, _ = self.analysis()
        force = analysis.addObject(ObjectsFem.makeConstraintForce(self.document, "Force"))[0]
        force.References, force.Force = [(part, ("Face1", "Face4"))], "100 N" if FreeCAD.Version()[0] != "0" else 100.0
        for order in (1, 2):
            mesh = core.mesh_object(part, size=2, order=order, analysis=analysis)
            table, nodes = meshtools.get_femelement_faces_table(mesh.FemMesh), mesh.FemMesh.Nodes
            ours = meshtools.get_force_obj_face_nodeload_table(mesh.FemMesh, table, nodes, force)
            searched = meshtools.get_force_obj_face_nodeload_table.__wrapped__(mesh.FemMesh, table, nodes, force)
            self.assertEqual([name for name, _ in ours], [name for name, _ in searched])
            for (_, one), (_, other) in zip(ours, searched):
                self.assertEqual(set(one), set(other))
                self.assertNotIn(max(other) + 1, one)
                for node, load in other.items():
                    self.assertAlmostEqual(float(one[node]), float(load), 9)
            (cards, loads), (their_cards, their_loads) = (self.written(force, rows) for rows in (ours, searched))
            self.assertEqual(cards, their_cards)
            self.assertEqual(set(loads), set(their_loads))
            for key, load in their_loads.items():
                self.assertAlmostEqual(loads[key], load, 9)
            with unittest.mock.patch.object(meshtools, "get_femelements_by_femnodes_std", side_effect=AssertionError):
                meshtools.get_force_obj_face_nodeload_table(mesh.FemMesh, table, nodes, force)  # nothing is searched
            self.document.removeObject(mesh.Name)

    def test_the_mesh_is_written_as_freecad_writes_it(self):
        from femsolver.calculix import write_mesh
        from femtools import ccxtools

        part = self.document.addObject("Part::Feature", "Part")
        part.Shape = Part.makeCylinder(5, 20).fuse(Part.makeBox(20, 4, 4))
        analysis, fixed, _ = self.analysis()
        make_solver = getattr(ObjectsFem, "makeSolverCalculiXCcxTools", None) or ObjectsFem.makeSolverCalculixCcxTools
        solver = analysis.addObject(make_solver(self.document, "Solver"))[0]
        fixed.References = [(part, "Face2")]
        analysis.addObject(ObjectsFem.makeElementGeometry2D(self.document, 1.0, "Thickness"))
        material = analysis.addObject(ObjectsFem.makeMaterialSolid(self.document, "Steel"))[0]
        material.Material = {"Name": "Steel", "YoungsModulus": "210000 MPa", "PoissonRatio": "0.3"}
        force = analysis.addObject(ObjectsFem.makeConstraintForce(self.document, "Force"))[0]
        force.References, force.Force = [(part, "Face1")], "100 N" if FreeCAD.Version()[0] != "0" else 100.0

        def written():
            with tempfile.TemporaryDirectory() as folder:
                fea = ccxtools.FemToolsCcx(analysis, solver, test_mode=True)
                fea.update_objects()
                fea.setup_working_dir(folder, create=True)
                fea.write_inp_file()
                stamps = (b" time", b"written on")
                return {path.name: [line for line in path.read_bytes().splitlines()
                                    if not any(stamp in line.lower() for stamp in stamps)]
                        for path in Path(folder).glob("*.inp")}

        for order, split, reduced in ((1, False, True), (2, False, True), (2, True, False), (2, True, True)):
            with self.subTest(order=order, split=split, reduced=reduced):
                mesh = core.mesh_object(part, size=2, order=order, analysis=analysis)
                mesh.ReducedShells, solver.SplitInputWriter = reduced, split
                self.document.recompute()
                with unittest.mock.patch.object(shell_input, "text_of", wraps=shell_input.text_of) as used:
                    ours = written()
                self.assertEqual(used.call_count, 1)
                with unittest.mock.patch.object(write_mesh, "write_mesh", write_mesh.write_mesh.__wrapped__):
                    self.assertEqual(ours, written())
                self.assertEqual(len(ours) > 1, split)
                self.document.removeObject(mesh.Name)
        if hasattr(solver, "ModelSpace"):  # from FreeCAD 1.0 on; such elements FreeCAD writes itself
            core.mesh_object(part, size=2, analysis=analysis)
            solver.ModelSpace = "plane stress"
            with unittest.mock.patch.object(shell_input, "text_of") as used:
                texts = written()
            self.assertFalse(used.called)
            self.assertTrue(any(b"TYPE=CPS8" in line for lines in texts.values() for line in lines))

    @staticmethod
    def written(force, table):
        """What FreeCAD's writer makes of loads: cards, and the load of each node along each axis on each face."""
        from femsolver.calculix import write_constraint_force

        text = io.StringIO()
        row = {"Object": types.SimpleNamespace(DirectionVector=FreeCAD.Vector(0.6, 0, -0.8)), "NodeLoadTable": table}
        write_constraint_force.write_meshdata_constraint(text, row, force, None)
        cards, loads = [], {}
        for line in filter(None, text.getvalue().splitlines()):
            if line.startswith("*"):
                cards.append(line)
                continue
            node, axis, value = line.split(",")
            loads[len(cards), int(node), int(axis)] = float(value)
        return cards, loads

    def test_elements_of_nodes_are_gathered_when_they_are_needed(self):
        from femmesh import meshtools
        from femmesh.meshsetsgetter import MeshSetsGetter

        mesh = core.mesh_object(self.box(), size=2)
        elements, nodes = meshtools.get_femelement_faces_table(mesh.FemMesh), mesh.FemMesh.Nodes
        calls = []
        real = meshtools.get_femnodes_ele_table.__wrapped__
        table = wrappers._when_needed(lambda *given: calls.append(1) or real(*given))(nodes, elements)
        self.assertTrue(table)
        self.assertEqual((len(table), calls), (len(nodes), []))
        self.assertEqual(dict(table), real(nodes, elements))
        self.assertEqual(calls, [1])
        if hasattr(MeshSetsGetter, "_load_tables"):  # from FreeCAD 1.1 on
            getter = types.SimpleNamespace(mesh_object=mesh, femmesh=mesh.FemMesh, femnodes_mesh={}, femelement_table={},
                                           femnodes_ele_table={})
            MeshSetsGetter._load_tables(getter)
            self.assertIsInstance(getter.femnodes_mesh, shell_input.Later)
            self.assertEqual(dict(getter.femnodes_mesh), nodes)
            self.assertEqual(list(getter.femnodes_mesh.values()), list(nodes.values()))
            self.assertEqual(dict(getter.femelement_table), dict(elements))

    def test_thickness_and_material_per_face(self):
        from femtools import ccxtools

        box = self.box()
        analysis, fixed, _ = self.analysis()
        fixed.References = [(box, "Face5")]
        make_solver = getattr(ObjectsFem, "makeSolverCalculiXCcxTools", None) or ObjectsFem.makeSolverCalculixCcxTools
        solver = analysis.addObject(make_solver(self.document, "Solver"))[0]
        wanted = {"Thin": ["Face1", "Face2"], "Thick": ["Face3", "Face4", "Face5", "Face6"]}
        for name, faces in wanted.items():
            shell = analysis.addObject(ObjectsFem.makeElementGeometry2D(self.document, 1.0, name))[0]
            shell.References = [(box, tuple(faces))]
            material = analysis.addObject(ObjectsFem.makeMaterialSolid(self.document, f"{name}Steel"))[0]
            material.Material = {"Name": name, "YoungsModulus": "210000 MPa", "PoissonRatio": "0.3"}
            material.References = [(box, tuple(faces))]
        mesh = core.mesh_object(box, size=2, order=2, analysis=analysis)
        self.document.recompute()
        with tempfile.TemporaryDirectory() as folder:
            fea = ccxtools.FemToolsCcx(analysis, solver, test_mode=True)
            fea.update_objects()
            fea.setup_working_dir(folder, create=True)
            fea.write_inp_file()
            text = Path(fea.inp_file_name).read_text()
        for name, faces in wanted.items():
            elements = set().union(*(group(mesh, face) for face in faces))
            header = f"*ELSET,ELSET={name}Steel{name}\n"
            self.assertIn(header, text)
            listed = text.split(header)[1].split("*")[0].replace(",", " ").split()
            self.assertEqual({int(word) for word in listed}, elements)

    @unittest.skipUnless(shutil.which("ccx") and hasattr(ObjectsFem, "makeSolverCalculix"), "no such solver here")
    def test_the_other_calculix_solver_object_solves(self):
        from femsolver import run

        part = self.document.addObject("Part::Feature", "Plate")
        part.Shape = Part.makePlane(40, 10)
        analysis = ObjectsFem.makeAnalysis(self.document, "Analysis")
        material = analysis.addObject(ObjectsFem.makeMaterialSolid(self.document, "Steel"))[0]
        material.Material = {"Name": "Steel", "YoungsModulus": "210000 MPa", "PoissonRatio": "0.3"}
        analysis.addObject(ObjectsFem.makeElementGeometry2D(self.document, 1.0, "Thickness"))
        fixed = analysis.addObject(ObjectsFem.makeConstraintFixed(self.document, "Fixed"))[0]
        fixed.References = [(part, "Edge1")]
        force = analysis.addObject(ObjectsFem.makeConstraintForce(self.document, "Force"))[0]
        force.References, force.Direction = [(part, "Edge3")], (part, ["Edge2"])
        force.Force = "100 N" if hasattr(force.Force, "Unit") else 100.0  # a quantity from FreeCAD 0.21 on
        solver = analysis.addObject(ObjectsFem.makeSolverCalculix(self.document, "Solver"))[0]
        for order in (1, 2):
            with self.subTest(order=order), tempfile.TemporaryDirectory() as folder:
                mesh = core.mesh_object(part, size=2, order=order, analysis=analysis)
                machine = solver.Proxy.createMachine(solver, folder)
                machine.target = run.RESULTS
                machine.start()
                machine.join()
                self.assertFalse(machine.failed)
                result = next(member for member in analysis.Group if member.isDerivedFrom("Fem::FemResultObject"))
                stretch = 100 / 10 / 210000 * 40  # F L / (E A)
                self.assertAlmostEqual(max(abs(vector.x) for vector in result.DisplacementVectors) / stretch, 1, 1)
                for member in (result.Mesh, result, mesh):
                    self.document.removeObject(member.Name)

    # Mesh regions

    def test_mesh_regions_are_honored(self):
        box = self.box()
        mesh = core.make_mesh(box, size=2)
        core.remesh(mesh)
        coarse = len(group(mesh, "Face1"))
        core.refine(mesh, [(box, ("Face1",))], "0.5 mm")
        self.document.recompute()
        self.assertEqual(mesh.Status, "the settings have changed: mesh again")
        core.remesh(mesh)
        self.assertEqual(mesh.Status, core.UP_TO_DATE)
        self.assertGreater(len(group(mesh, "Face1")), 10 * coarse)
        mesh.MeshRegionList[0].CharacteristicLength = 1
        self.document.recompute()
        self.assertEqual(mesh.Status, "the settings have changed: mesh again")

    def test_region_on_a_solid_and_on_a_vertex(self):
        box = self.box()
        mesh = core.make_mesh(box, size=2)
        core.refine(mesh, [(box, ("Vertex1",))], 0.25)
        core.remesh(mesh)
        shortest = min(quality.measure(mesh.FemMesh).lengths)
        self.assertLess(shortest, 0.5)
        self.assertEqual(shapes.references_to_names(box.Shape, box, [(box, "Face1")]), ["Face1"])

    def test_refine_refuses_nonsense(self):
        box = self.box()
        mesh = core.make_mesh(box, size=2)
        for references, size in (([], 1), ([(box, ("Face99",))], 1), ([(box, ("Face1",))], 0),
                                 ([(box, ("Face1",))], -1)):
            with self.subTest(references=references, size=size):
                with self.assertRaises(quadrille.Error):
                    core.refine(mesh, references, size)
                self.assertEqual(mesh.MeshRegionList, [])

    # Normals

    def test_flipped_normals(self):
        for file in ("box.brep", "bracket.step", "tube_with_hole.brep"):
            with self.subTest(file=file):
                part = self.document.addObject("Part::Feature", "Part")
                part.Shape = Part.read(str(MODELS / file))
                mesh = core.mesh_object(part, size=part.Shape.BoundBox.DiagonalLength / 15)
                before = self.normals(mesh)
                core.flip(mesh, ["Face1"])
                after = self.normals(mesh)
                self.assertEqual(set(before), set(after))
                self.assertEqual({name for name in before if before[name] != after[name]}, {"Face1"})
                core.flip(mesh, [1])
                self.assertEqual(mesh.FlippedFaces, [])

    @staticmethod
    def normals(mesh):
        """For each face, 1 where its elements point along its CAD normal, else -1."""
        measured = quality.measure(mesh.FemMesh)
        rows = {int(i): row for row, i in enumerate(measured.ids)}
        found = {}
        for index, face in enumerate(mesh.Shape.Shape.Faces, 1):
            row = rows[min(group(mesh, f"Face{index}"))]
            point = Vector(*measured.centers[row])
            normal = face.normalAt(*face.Surface.parameter(point))
            found[f"Face{index}"] = 1 if normal.dot(Vector(*measured.normals[row])) > 0 else -1
        return found

    def test_flip_of_a_face_that_is_not_there(self):
        mesh = core.mesh_object(self.box(), size=2)
        with self.assertRaises(quadrille.Error):
            core.flip(mesh, ["Face77"])
        self.assertEqual(mesh.FlippedFaces, [])

    # Stale

    def test_status_follows_the_part_and_the_settings(self):
        box = self.box()
        mesh = core.make_mesh(box, size=2)
        self.assertEqual(mesh.Status, "not meshed yet")
        core.remesh(mesh)
        self.assertEqual(mesh.Status, core.UP_TO_DATE)
        box.Height = 11
        self.document.recompute()
        self.assertEqual(mesh.Status, "the part has changed: mesh again")
        box.Height = 10
        self.document.recompute()
        self.assertEqual(mesh.Status, core.UP_TO_DATE)
        box.Placement.Base = Vector(1, 0, 0)
        self.document.recompute()
        self.assertEqual(mesh.Status, "the part has changed: mesh again")
        core.remesh(mesh)
        mesh.ElementOrder = "1st"
        self.document.recompute()
        self.assertEqual(mesh.Status, "the settings have changed: mesh again")
        mesh.ElementOrder = "2nd"
        mesh.Threads = 1  # no other mesh
        self.document.recompute()
        self.assertEqual(mesh.Status, core.UP_TO_DATE)
        self.document.removeObject(box.Name)
        self.document.recompute()
        self.assertEqual(mesh.Status, "the part is gone")
        with self.assertRaises(quadrille.Error):
            core.remesh(mesh)

    def stale_analysis(self):
        """An analysis that could be solved, were its part not changed after meshing; with both solver objects."""
        box = self.box()
        analysis, fixed, pressure = self.analysis()
        fixed.References, pressure.References, pressure.Pressure = [(box, "Face1")], [(box, "Face2")], 1.0
        material = analysis.addObject(ObjectsFem.makeMaterialSolid(self.document, "Steel"))[0]
        material.Material = {"Name": "Steel", "YoungsModulus": "210000 MPa", "PoissonRatio": "0.3"}
        analysis.addObject(ObjectsFem.makeElementGeometry2D(self.document, 1.0, "Thickness"))
        mesh = core.mesh_object(box, size=2, analysis=analysis)
        self.document.recompute()
        return box, analysis, mesh

    def test_the_standard_solver_refuses_a_stale_mesh(self):
        from femtools import ccxtools

        box, analysis, mesh = self.stale_analysis()
        make_solver = getattr(ObjectsFem, "makeSolverCalculiXCcxTools", None) or ObjectsFem.makeSolverCalculixCcxTools
        solver = analysis.addObject(make_solver(self.document, "Solver"))[0]
        with tempfile.TemporaryDirectory() as folder:
            fea = ccxtools.FemToolsCcx(analysis, solver, test_mode=True)
            fea.update_objects()
            fea.setup_working_dir(folder, create=True)
            self.assertEqual(fea.check_prerequisites(), "")
            box.Height = 12  # not even recomputed
            self.assertEqual(fea.check_prerequisites().count("QuadMesh: the part has changed: mesh again"), 1)
            core.remesh(mesh)
            self.assertEqual(fea.check_prerequisites(), "")
            mesh.Size = 3
            self.assertIn("the settings have changed", fea.check_prerequisites())

    def test_the_solvers_of_the_framework_refuse_a_stale_mesh(self):
        from femsolver import run

        box, analysis, mesh = self.stale_analysis()
        names = ["makeSolverZ88", "makeSolverMystran"] + ["makeSolverCalculix"] * hasattr(ObjectsFem, "makeSolverCalculix")
        for name in names:  # CalculiX left the framework with FreeCAD 1.1
            with self.subTest(solver=name), tempfile.TemporaryDirectory() as folder:
                solver = analysis.addObject(getattr(ObjectsFem, name)(self.document, "Solver"))[0]
                for height, refused in ((10, False), (12, True)):
                    box.Height = height
                    machine = solver.Proxy.createMachine(solver, folder)
                    machine.target = run.CHECK
                    machine.start()
                    machine.join()
                    said = " ".join(machine.report.errors)
                    self.assertEqual("the part has changed" in said, refused, said)
                    self.assertEqual(machine.failed, refused, said)
                self.document.removeObject(solver.Name)

    def test_a_script_that_takes_a_stale_mesh_is_told(self):
        from femtools import membertools

        box, analysis, mesh = self.stale_analysis()
        printed = []
        real, wrappers.FreeCAD = wrappers.FreeCAD, types.SimpleNamespace(
            Console=types.SimpleNamespace(PrintError=printed.append))
        try:
            self.assertEqual(membertools.get_mesh_to_solve(analysis), (mesh, ""))
            self.assertEqual(printed, [])
            box.Height = 12
            self.assertEqual(membertools.get_mesh_to_solve(analysis), (mesh, ""))
        finally:
            wrappers.FreeCAD = real
        self.assertEqual(len(printed), 1)
        self.assertIn("QuadMesh: the part has changed", printed[0])

    def test_meshes_of_others_are_left_alone(self):
        analysis, _, _ = self.analysis()
        other = analysis.addObject(ObjectsFem.makeMeshGmsh(self.document, "Gmsh"))[0]
        self.assertEqual(core.complaint(other), "")

    def test_undo_brings_the_mesh_back(self):
        self.document.UndoMode = 1
        mesh = core.mesh_object(self.box(), size=2)
        coarse = mesh.FemMesh.FaceCount
        self.document.openTransaction("finer")
        mesh.Size = 1
        core.remesh(mesh)
        self.document.commitTransaction()
        fine = mesh.FemMesh.FaceCount
        self.assertGreater(fine, coarse)
        self.document.undo()
        self.assertEqual((mesh.FemMesh.FaceCount, mesh.QuadCount, mesh.Size.Value), (coarse, coarse, 2.0))
        self.document.redo()
        self.assertEqual((mesh.FemMesh.FaceCount, mesh.QuadCount, mesh.Size.Value), (fine, fine, 1.0))

    def test_a_new_shape_of_the_same_size_is_seen(self):
        one, other = Part.makeBox(1, 1, 1), Part.makeBox(1, 1, 1)
        self.assertTrue(shapes.same_fingerprint(shapes.fingerprint(one), shapes.fingerprint(other)))
        one.tessellate(0.1)
        one.isValid()
        self.assertTrue(shapes.same_fingerprint(shapes.fingerprint(one), shapes.fingerprint(other)))
        for change in (Part.makeBox(1, 1, 1 + 1e-6), Part.makeBox(1, 1, 1, Vector(0, 0, 1e-6)),
                       Part.makeCylinder(1, 1)):
            self.assertFalse(shapes.same_fingerprint(shapes.fingerprint(one), shapes.fingerprint(change)))

    def test_a_face_that_changes_inside_its_edges_is_seen(self):
        def sheet(height, places):
            surface = Part.BSplineSurface()
            surface.interpolate([[Vector(x, y, places.get((x, y), 0) * height) for y in range(7)] for x in range(7)])
            return surface.toShape()

        for places in ({(3, 3): 1}, {(1, 1): 1}, {(1, 3): 1, (5, 3): -1}):  # the middle stays in the last
            flat, higher = (shapes.fingerprint(sheet(height, places)) for height in (0.5, 0.51))
            self.assertEqual(flat, shapes.fingerprint(sheet(0.5, places)))
            self.assertFalse(shapes.same_fingerprint(flat, higher), places)

    def test_a_curve_that_is_mirrored_between_its_ends_is_seen(self):
        def plate(height):
            curve = Part.BSplineCurve()
            curve.interpolate([Vector(0, 0), Vector(1, height), Vector(2, 0), Vector(3, -height), Vector(4, 0)])
            return Part.Face(Part.Wire([curve.toShape(), Part.makeLine(Vector(4, 0), Vector(4, 5)),
                                        Part.makeLine(Vector(4, 5), Vector(0, 5)), Part.makeLine(Vector(0, 5), Vector(0, 0))]))

        self.assertFalse(shapes.same_fingerprint(shapes.fingerprint(plate(0.5)), shapes.fingerprint(plate(-0.5))))

    # Export, quality, estimate

    def test_export(self):
        mesh = core.mesh_object(self.box(), size=2)
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "box.unv")
            core.export(mesh, path)
            read = Fem.read(path)
            self.assertEqual(read.FaceCount, mesh.QuadCount)
            for axis in range(3):  # in mm, whatever the file says of units
                places = [node[axis] for node in read.Nodes.values()]
                self.assertAlmostEqual(max(places) - min(places), 10)
            with self.assertRaises(quadrille.Error):
                core.export(mesh, os.path.join(folder, "box.doc"))
            with self.assertRaises(quadrille.Error):
                core.export(mesh, os.path.join(folder, "no", "box.unv"))
            mesh.Size = 3
            with self.assertRaises(quadrille.Error):
                core.export(mesh, os.path.join(folder, "stale.unv"))
            self.assertEqual(os.listdir(folder), ["box.unv"])

    def test_quality_is_the_meshers(self):
        part = self.document.addObject("Part::Feature", "Part")
        part.Shape = Part.read(str(MODELS / "bracket.step"))
        for order in (1, 2):
            mesh = core.mesh_object(part, size=3, order=order)
            measured = quality.measure(mesh.FemMesh)
            self.assertEqual(measured.ids.size, mesh.QuadCount)
            self.assertAlmostEqual(measured.q.min(), mesh.WorstQuality, 4)
            self.assertAlmostEqual(measured.q.mean(), mesh.MeanQuality, 4)
            self.assertAlmostEqual(measured.scaled_jacobian.min(), mesh.WorstJacobian, 4)

    def test_estimate_and_suggestion_hold(self):
        for file in ("box.brep", "bracket.step", "cylinder.brep", "torus.brep", "plate_with_holes.brep"):
            with self.subTest(file=file):
                part = self.document.addObject("Part::Feature", "Part")
                part.Shape = Part.read(str(MODELS / file))
                size = core.suggested_size(part)
                mesh = core.mesh_object(part, size=size)
                self.assertLess(abs(mesh.QuadCount / 5000 - 1), 0.25, mesh.QuadCount)

    def test_estimate_follows_sizes_that_grow_from_small_holes(self):
        plate = Part.makePlane(100, 100)
        holes = [Part.Face(Part.Wire(Part.makeCircle(1, Vector(10 + 20 * i, 10 + 20 * j, 0))))
                 for i in range(5) for j in range(5)]
        part = self.document.addObject("Part::Feature", "Part")
        part.Shape = plate.cut(Part.makeCompound(holes)).Faces[0]
        mesh = core.mesh_object(part, size=5)
        self.assertGreater(mesh.QuadCount, 3 * 100 * 100 / 5**2)  # most of them are around the holes
        count = sizes.CountJob(part.Shape, MeshSettings(size=5.0)).start().wait()
        self.assertEqual((count.size, list(count.by_face)), (5, ["Face1"]))
        self.assertLess(abs(mesh.QuadCount / count.quads - 1), 0.3, (mesh.QuadCount, count.quads))

    # Bad use

    def test_a_command_of_another_version(self):
        box = self.box()
        for answer, words in (("echo quadrille 7.3.0", "version 7.3.0"), ("echo hello", "is not the quadrille"),
                              ("exit 3", "is not the quadrille")):
            with tempfile.TemporaryDirectory() as folder, self.subTest(answer=answer):
                path = Path(folder) / "quadrille"
                path.write_text(f"#!/bin/sh\n{answer}\n")
                path.chmod(path.stat().st_mode | stat.S_IXUSR)
                with self.assertRaises(quadrille.Error) as caught:
                    core.mesh_object(box, size=2, command=str(path))
                self.assertIn(words, str(caught.exception))
                self.assertEqual(self.document.Objects, [box])

    # Other builds of FreeCAD

    def test_in_flatpak_the_command_runs_outside_of_the_sandbox(self):
        mesher = os.environ.pop("QUADRILLE_COMMAND")
        before = {name: os.environ.get(name) for name in ("PATH", "XDG_CACHE_HOME")}
        with tempfile.TemporaryDirectory() as folder:
            log, cache, host = Path(folder) / "log", Path(folder) / "cache", Path(folder) / "host"
            host.mkdir()
            (host / "quadrille").symlink_to(mesher)  # on the PATH of the host alone
            spawn = Path(folder) / "flatpak-spawn"
            spawn.write_text(f'#!/bin/sh\necho "$@" >>{log}\n[ "$1" = --host ] && [ "$2" = --watch-bus ] || exit 9\n'
                             f'shift 2\nPATH={host}:/usr/bin:/bin\nexport PATH\nexec "$@"\n')
            spawn.chmod(0o755)
            (Path(folder) / "info").touch()
            real, command.FLATPAK_INFO = command.FLATPAK_INFO, Path(folder) / "info"
            os.environ.update(PATH=folder, XDG_CACHE_HOME=str(cache))
            try:
                mesh = core.mesh_object(self.box(), size=2)
                self.assertEqual(mesh.FemMesh.FaceCount, 150)
                lines = log.read_text().splitlines()
                self.assertTrue(all(line.startswith("--host --watch-bus ") for line in lines), lines)
                self.assertIn(f" {host}/quadrille mesh {cache}/quadrille-", lines[-1])  # not in /tmp of the sandbox
                self.assertEqual(os.listdir(cache), [])
                mesh.Size = 0.01
                job = core.start(mesh)
                time.sleep(0.3)
                self.assertTrue(job.running)
                job.cancel()
                with self.assertRaises(quadrille.Error) as caught:
                    core.finish(mesh, job)
                self.assertEqual(caught.exception.kind, "cancelled")
                with self.assertRaises(quadrille.Error) as caught:
                    core.remesh(mesh, command="/nowhere/quadrille")
                self.assertIn("cannot be run", str(caught.exception))
                spawn.unlink()
                with self.assertRaises(quadrille.Error) as caught:
                    core.remesh(mesh)
                self.assertIn("flatpak override", str(caught.exception))
            finally:
                command.FLATPAK_INFO = real
                os.environ["QUADRILLE_COMMAND"] = mesher
                for name, value in before.items():
                    os.environ.pop(name, None) if value is None else os.environ.update({name: value})

    def test_the_libraries_of_an_appimage_do_not_reach_the_command(self):
        before = dict(os.environ)
        libraries = subprocess.run(["ldd", core.find_mesher()], capture_output=True, text=True, check=True).stdout
        poison = next(word for word in libraries.split() if word.startswith("libTK"))
        with tempfile.TemporaryDirectory() as folder:
            library = Path(folder) / "usr" / "lib" / poison
            library.parent.mkdir(parents=True)
            library.write_text("not a library")
            for variables in ({"APPDIR": folder, "PYTHONHOME": f"{folder}/usr"}, {"PYTHONHOME": f"{folder}/usr"}):
                os.environ.update(variables, LD_LIBRARY_PATH=f"{library.parent}:/opt/of/the/user",
                                  LD_PRELOAD=str(library), PYTHONPATH=f"{folder}/usr/lib/python")
                try:
                    broken = subprocess.run([core.find_mesher(), "--version"], capture_output=True, check=False)
                    self.assertNotEqual(broken.returncode, 0)  # the poison works
                    environment = command.child_environment()
                    self.assertEqual(environment["LD_LIBRARY_PATH"], "/opt/of/the/user")
                    self.assertFalse({"LD_PRELOAD", "PYTHONHOME", "PYTHONPATH"} & set(environment))
                    command._checked.clear()
                    self.assertEqual(core.mesh_object(self.box(), size=2).FemMesh.FaceCount, 150)
                finally:
                    os.environ.clear()
                    os.environ.update(before)

    def test_the_addon_managers_file(self):
        folder = Path(core.__file__).resolve().parents[1]  # the build folder has links
        data = FreeCAD.Metadata(str(folder / "package.xml"))
        self.assertEqual((data.Name, data.Version), ("Quadrille", command.VERSION))
        self.assertTrue(data.Maintainer)
        self.assertTrue(data.License)
        self.assertTrue(data.supportsCurrentFreeCAD())
        workbench = data.Content["workbench"][0]
        self.assertEqual(workbench.Classname, "QuadrilleWorkbench")
        self.assertTrue((folder / workbench.Icon).is_file())

    def test_an_invalid_shape(self):
        points = [Vector(0, 0, 0), Vector(10, 0, 0), Vector(0, 10, 0), Vector(10, 10, 0), Vector(0, 0, 0)]
        bow = self.document.addObject("Part::Feature", "Bow")
        bow.Shape = Part.Face(Part.makePolygon(points))
        self.assertFalse(bow.Shape.isValid())
        with self.assertRaises(quadrille.Error) as caught:
            core.mesh_object(bow, size=1)
        self.assertIn("Face1", str(caught.exception))
        self.assertEqual(self.document.Objects, [bow])

    def test_an_analysis_with_two_meshes(self):
        from femtools import membertools

        box = self.box()
        analysis, fixed, _ = self.analysis()
        fixed.References = [(box, "Face1")]
        meshes = [core.mesh_object(box, size=size) for size in (2, 5)]
        analysis.addObjects(meshes)  # as a user may by drag and drop
        found, message = membertools.get_mesh_to_solve(analysis)
        self.assertIsNone(found)
        self.assertIn("multiple mesh", message)
        with self.assertRaises(quadrille.Error) as caught:
            core.mesh_object(box, size=3, analysis=analysis)
        self.assertIn("one mesh only", str(caught.exception))
        for mesh in meshes:
            core.remesh(mesh)
            self.assertEqual(group(mesh, "Fixed_Nodes"), set(mesh.FemMesh.getNodesByFace(box.Shape.Face1)))

    def test_meshing_while_meshing(self):
        mesh = core.make_mesh(self.box(), size=0.01)
        job = core.start(mesh)
        try:
            with self.assertRaises(quadrille.Error) as caught:
                core.remesh(mesh)
            self.assertIn("already", str(caught.exception))
        finally:
            job.cancel()
        with self.assertRaises(quadrille.Error):
            core.finish(mesh, job)
        mesh.Size = 2
        core.remesh(mesh)
        self.assertEqual(mesh.FemMesh.FaceCount, 150)

    def test_only_part_groups_count_as_such(self):
        self.assertTrue(groups._is_part_group("Face12"))
        self.assertFalse(groups._is_part_group("Face12_Nodes"))
        self.assertFalse(groups._is_part_group("Face"))


if __name__ == "__main__":
    unittest.main(verbosity=2, warnings="ignore")  # FreeCAD and PySide warn by the hundred
