"""Rough use of the panel: what an analyst does to documents, parts, refinements and units while the mesher works.

    scripts/freecad_gui tests/freecad/gui/rough_test.py
"""

import os
import sys
import tempfile
from pathlib import Path
from unittest import mock

sys.path.insert(0, str(Path(__file__).resolve().parent))

import FreeCAD
import FreeCADGui
import ObjectsFem
from PySide import QtCore, QtGui

import quadrille.freecad
from case import GuiCase, run, type_into
from driver import Boxes, close_panel, find, process, wait_for, window
from quadrille.core.jobs import find_mesher
from quadrille.document import undo
from quadrille.document.state import NOT_MESHED, PART_CHANGED, PART_GONE, SETTINGS_CHANGED, UP_TO_DATE
from quadrille.gui import background

CANCEL = QtGui.QDialogButtonBox.Cancel
_MESHER_AT_A_GATE = """#!/usr/bin/env python3
import json, os, sys, time
arguments = sys.argv[1:]
if arguments == ["standby"]:
    arguments = json.loads(sys.stdin.readline() or "[]")
while arguments[:1] == ["mesh"] and os.path.exists({gate!r}):
    time.sleep(0.02)
if arguments:
    os.execv({mesher!r}, [{mesher!r}, *arguments])
"""


def report():
    """What the report view has, where FreeCAD tells of errors in Python that nobody caught."""
    dock = next(dock for dock in window().findChildren(QtGui.QDockWidget) if dock.objectName() == "Report view")
    return "\n".join(text.toPlainText() for text in dock.findChildren(QtGui.QTextEdit))


class RoughTest(GuiCase):
    """The mesher waits at a gate, so that what is done meanwhile is done meanwhile. Nothing may be raised, nothing left."""

    def setUp(self):
        super().setUp()
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder, self.gate = Path(folder.name), Path(folder.name) / "gate"
        command = self.folder / "quadrille"
        command.write_text(_MESHER_AT_A_GATE.format(gate=str(self.gate), mesher=find_mesher()))
        command.chmod(0o755)
        self.raised, self.reported = [], len(report())
        for patch in (mock.patch.dict(os.environ, QUADRILLE_COMMAND=str(command)),
                      mock.patch.object(sys, "excepthook", lambda _kind, error, _trace: self.raised.append(repr(error)))):
            patch.start()
            self.addCleanup(patch.stop)
        self.addCleanup(FreeCAD.Units.setSchema, 0)
        self.boxes = Boxes()
        self.boxes.__enter__()
        self.addCleanup(self.boxes.__exit__)

    def tearDown(self):
        self.gate.unlink(missing_ok=True)
        super().tearDown()
        process(0.2)
        self.assertEqual(self.raised, [])
        self.assertNotIn("Traceback", report()[self.reported:])
        self.assertEqual((quadrille.features.mesh_object._running, undo._held), ({}, {}))
        self.assertFalse(FreeCADGui.Control.activeDialog())

    def edit(self, mesh):
        """Opens the panel of a mesh object that is there."""
        FreeCADGui.getDocument(mesh.Document.Name).setEdit(mesh.Name)
        process(0.2)

    def begin(self):
        """Presses Mesh; the mesher waits."""
        self.gate.touch()
        find("QuadrilleMesh").click()
        process(0.1)
        self.assertFalse(find("QuadrilleMesh").isEnabled())

    def let_go(self):
        """The mesher goes on to its end, of which no box tells."""
        told = len(self.boxes.texts)
        self.gate.unlink()
        wait_for(lambda: find("QuadrilleMesh").isEnabled(), what="meshing")
        process(0.2)
        self.assertEqual(self.boxes.texts[told:], [])

    def told(self, name):
        """Presses a button that a box answers."""
        told = len(self.boxes.texts)
        find(name).click()
        process(0.2)
        self.assertEqual(len(self.boxes.texts), told + 1, name)
        return self.boxes.texts[-1]

    def delete(self, *names):
        """One step of undo."""
        self.document.openTransaction("Delete")
        for name in names:
            self.document.removeObject(name)
        self.document.commitTransaction()
        process(0.2)

    def assert_sound(self, mesh, status):
        """The numbers are those of the mesh, and nothing is half done."""
        self.assertEqual((mesh.QuadCount, mesh.Status), (mesh.FemMesh.FaceCount, status))
        self.assertFalse(mesh.Document.HasPendingTransaction)

    # Undo

    def test_other_work_is_undone(self):
        box = self.box()
        mesh = self.open_panel(box)
        self.press_mesh()
        close_panel()
        self.document.openTransaction("Longer")
        box.Length = 20
        self.document.commitTransaction()
        self.document.recompute()
        self.edit(mesh)
        self.begin()
        self.document.undo()
        self.let_go()
        self.assert_sound(mesh, PART_CHANGED)
        close_panel()

    def test_the_mesh_before_is_undone_and_redone(self):
        mesh = self.open_panel(self.box())
        self.press_mesh()
        quads = mesh.QuadCount
        type_into("QuadrilleSize", "3 mm")
        self.begin()
        FreeCADGui.runCommand("Std_Undo")
        process(0.2)
        self.assertEqual(mesh.FemMesh.FaceCount, 0)
        FreeCADGui.runCommand("Std_Redo")
        process(0.2)
        self.assertEqual(mesh.FemMesh.FaceCount, quads)
        self.document.undo()
        self.let_go()
        self.assert_sound(mesh, UP_TO_DATE)
        self.assertEqual((mesh.Size.Value, self.document.RedoCount), (3, 0))
        for step in (self.document.undo, self.document.redo):
            step()
            process(0.2)
        self.assert_sound(mesh, UP_TO_DATE)
        self.assertEqual(mesh.Size.Value, 3)
        close_panel(CANCEL)
        self.assertEqual([obj.Name for obj in self.document.Objects], ["Box"])

    # What the panel shows is deleted

    def test_the_part_is_deleted(self):
        mesh = self.open_panel(self.box())
        self.begin()
        self.delete("Box")
        self.let_go()
        self.assert_sound(mesh, PART_GONE)
        self.assertIn("is gone", find("QuadrilleEstimateError").text())
        find("QuadrilleRefinements").setChecked(True)
        for name in ("QuadrilleMesh", "QuadrilleSuggest", "QuadrilleTakeSelection", "QuadrilleAddRefinement", "QuadrilleDivide"):
            self.assertIn("the part that it meshes is gone", self.told(name))
        find("QuadrillePreview").click()
        self.assertIn("is gone", find("QuadrillePreviewText").text())
        close_panel(CANCEL)
        self.assertEqual(self.document.Objects, [])

    def test_ok_without_a_part(self):
        mesh = self.open_panel(self.box())
        self.press_mesh()
        self.delete("Box")
        close_panel()
        self.assert_sound(mesh, PART_GONE)

    def test_the_part_of_a_mesh_that_was_there_is_deleted(self):
        mesh = quadrille.freecad.mesh_object(self.box(), size=2, faces=[1, 2], sizes={"Face1": 1.0})
        quads = mesh.QuadCount
        self.edit(mesh)
        type_into("QuadrilleSize", "3 mm")
        self.press_mesh()
        self.delete("Box")
        self.document.openTransaction("Another")
        self.document.addObject("Part::Sphere", "Sphere")
        self.document.commitTransaction()
        close_panel(CANCEL)
        self.assert_sound(mesh, PART_GONE)
        self.assertEqual((mesh.QuadCount, mesh.Size.Value), (quads, 2))

    def test_a_refinement_is_deleted(self):
        mesh = quadrille.freecad.mesh_object(self.box(), size=2, sizes={"Face1": 1.0, "Face2": 1.5})
        first, second = (region.Name for region in mesh.MeshRegionList)
        self.edit(mesh)
        type_into("QuadrilleRefinedSize0", "0.7 mm")
        type_into("QuadrilleRefinedSize1", "1.2 mm")
        self.begin()
        self.delete(first)
        self.assertEqual(find("QuadrilleRefinedSize0").text(), "1.2 mm")  # what was typed stays, in its row
        self.let_go()
        self.assert_sound(mesh, SETTINGS_CHANGED)
        self.assertEqual([(region.Name, float(region.CharacteristicLength)) for region in mesh.MeshRegionList], [(second, 1.2)])
        self.press_mesh()
        close_panel()
        self.assert_sound(mesh, UP_TO_DATE)

    def test_a_refinement_that_cannot_be_read_is_removed(self):
        mesh = quadrille.freecad.mesh_object(self.box(), size=2, sizes={"Face1": 1.0, "Face2": 1.5})
        self.edit(mesh)
        find("QuadrilleRefinedSize0").setText("nonsense")
        find("QuadrilleRefinedRemove0").click()
        self.assertEqual(find("QuadrilleRefinedSize0").property("rawValue"), 1.5)
        self.press_mesh()
        close_panel()
        self.assertEqual([float(region.CharacteristicLength) for region in mesh.MeshRegionList], [1.5])

    def test_analysis_and_solver_are_deleted(self):
        import FemGui

        part = self.box()
        analysis = ObjectsFem.makeAnalysis(self.document, "Analysis")
        make = getattr(ObjectsFem, "makeSolverCalculiXCcxTools", None) or ObjectsFem.makeSolverCalculixCcxTools
        solver = analysis.addObject(make(self.document))[0]
        FemGui.setActiveAnalysis(analysis)
        mesh = self.open_panel(part)
        find("QuadrilleSurfaces").setChecked(True)
        self.begin()
        self.delete(solver.Name, analysis.Name)
        self.let_go()
        close_panel()
        self.assert_sound(mesh, UP_TO_DATE)

    # Documents

    def test_units_change(self):
        """A bare number is in the unit that held when it was typed."""
        mesh = self.open_panel(self.box())
        type_into("QuadrilleSize", "2")
        FreeCAD.Units.setSchema(3)  # inches
        self.press_mesh()
        self.assertEqual(mesh.Size.Value, 2)
        type_into("QuadrilleSize", "0.1")
        self.begin()
        FreeCAD.Units.setSchema(0)
        self.let_go()
        self.assert_sound(mesh, UP_TO_DATE)
        self.assertAlmostEqual(mesh.Size.Value, 2.54, 9)
        type_into("QuadrilleSize", "3")
        if hasattr(self.document, "UnitSystem"):  # FreeCAD 1.0: each document has units
            self.document.UnitSystem = 3
        close_panel()
        self.assertEqual(mesh.Size.Value, 3)

    def test_two_documents(self):
        mesh = self.open_panel(self.box())
        self.begin()
        other = FreeCAD.newDocument("Other")
        other.UndoMode = 1
        FreeCAD.setActiveDocument("Other")
        process(0.5)
        self.assertFalse(FreeCADGui.Command.get("Quadrille_Mesh").getAction()[0].isEnabled())
        other.openTransaction("Another")
        other.addObject("Part::Sphere", "Sphere")
        self.let_go()
        other.commitTransaction()
        self.assert_sound(mesh, UP_TO_DATE)
        other.undo()
        FreeCAD.closeDocument("Other")
        process(0.2)
        self.assert_sound(mesh, UP_TO_DATE)
        close_panel(CANCEL)
        self.assertEqual([obj.Name for obj in self.document.Objects], ["Box"])

    def test_closed_and_opened_again(self):
        mesh = self.open_panel(self.box())
        self.press_mesh()
        quads = mesh.QuadCount
        type_into("QuadrilleSize", "3 mm")
        self.begin()
        path = str(self.folder / "part.FCStd")
        self.document.saveAs(path)
        FreeCAD.closeDocument(self.document.Name)
        process(0.2)
        self.assertFalse(FreeCADGui.Control.activeDialog())
        self.gate.unlink()
        self.document = FreeCAD.openDocument(path)
        mesh = self.document.QuadMesh
        self.assert_sound(mesh, UP_TO_DATE)
        self.assertEqual(mesh.QuadCount, quads)
        self.edit(mesh)
        type_into("QuadrilleSize", "3 mm")
        self.begin()
        self.document.save()
        self.document.restore()  # File > Revert
        process(0.2)
        self.assertFalse(FreeCADGui.Control.activeDialog())
        self.gate.unlink()
        self.assert_sound(self.document.QuadMesh, UP_TO_DATE)
        self.assertEqual(self.document.QuadMesh.QuadCount, quads)

    def test_meshes_of_two_documents_one_panel(self):
        """FreeCAD has one panel at a time: it ends the one that is open when another object is edited."""
        other = FreeCAD.newDocument("Other")
        cylinder = other.addObject("Part::Cylinder", "Cylinder")
        other.recompute()
        there = quadrille.freecad.make_mesh(cylinder, size=1)
        FreeCAD.setActiveDocument(self.document.Name)
        mesh = self.open_panel(self.box())
        self.begin()
        there.ViewObject.Proxy.doubleClicked(there.ViewObject)
        self.assertIn("Another task panel is open", self.boxes.texts[-1])
        mesh.ViewObject.Proxy.doubleClicked(mesh.ViewObject)  # the one that is open
        self.let_go()
        self.assert_sound(mesh, UP_TO_DATE)
        self.begin()
        self.edit(there)  # by a script
        self.assertEqual(list(undo._held), [(other.Uid, there.Name)])
        self.gate.unlink()
        self.press_mesh()
        close_panel()
        self.assert_sound(mesh, UP_TO_DATE)
        self.assert_sound(there, UP_TO_DATE)

    # Runs that go on after OK

    def go_on(self):
        """A mesh object whose mesher waits, without its panel."""
        mesh = self.open_panel(self.box())
        type_into("QuadrilleSize", "2 mm")
        self.begin()
        close_panel()
        self.assertFalse(FreeCADGui.Control.activeDialog())
        self.assertTrue(find("QuadrilleBackground").isVisible())
        return mesh

    def let_it_wait(self):
        """The mesher of go_on() ends, and its mesh waits until it can be stored."""
        self.gate.unlink()
        bar = find("QuadrilleBackground")
        wait_for(lambda: "waits" in bar.format(), what="the end")

    def come_to_its_end(self):
        """The mesher of go_on() goes on, and its mesh is stored."""
        self.gate.unlink()
        wait_for(lambda: not background._runs, what="meshing")
        process(0.2)
        self.assert_no_bar()

    def assert_no_bar(self):
        """Nothing is left of a run."""
        process(0.2)
        self.assertEqual((background._runs, quadrille.features.mesh_object._running), ({}, {}))
        self.assertEqual(window().findChildren(QtGui.QWidget, "QuadrilleBackground"), [])
        self.assertEqual(self.boxes.texts, [])

    def test_the_document_of_a_run_is_closed(self):
        self.go_on()
        FreeCAD.closeDocument(self.document.Name)
        self.assert_no_bar()

    def test_the_document_of_a_run_is_reverted(self):
        mesh = self.go_on()
        self.document.saveAs(str(self.folder / "part.FCStd"))
        self.document.restore()
        self.gate.unlink()
        process(1)
        wait_for(lambda: not background._runs, what="the end")
        self.assert_no_bar()
        mesh = self.document.QuadMesh
        self.assertEqual(mesh.QuadCount, mesh.FemMesh.FaceCount)

    def test_the_part_of_a_run_is_deleted(self):
        mesh = self.go_on()
        self.delete("Box")
        self.come_to_its_end()
        self.assert_sound(mesh, PART_GONE)
        self.assertGreater(mesh.QuadCount, 0)

    def test_the_settings_of_a_run_are_undone(self):
        mesh = self.go_on()
        self.document.undo()
        self.assertNotEqual(mesh.Size.Value, 2)
        self.come_to_its_end()
        self.assert_sound(mesh, SETTINGS_CHANGED)
        self.document.undo()
        self.assertEqual(mesh.FemMesh.FaceCount, 0)
        self.document.redo()
        self.assert_sound(mesh, SETTINGS_CHANGED)

    def test_all_of_a_run_is_undone(self):
        self.go_on()
        self.document.undo()
        self.document.undo()
        self.assertEqual([obj.Name for obj in self.document.Objects], ["Box"])
        self.assert_no_bar()
        self.document.redo()
        self.document.redo()
        self.assert_sound(self.document.QuadMesh, NOT_MESHED)

    def test_the_part_of_a_run_changes(self):
        mesh = self.go_on()
        self.document.Box.Length = 20
        self.document.recompute()
        self.come_to_its_end()
        self.assert_sound(mesh, PART_CHANGED)

    def test_a_run_that_was_taken_back_is_cancelled(self):
        mesh = self.go_on()
        self.edit(mesh)
        self.assertEqual(background._runs, {})
        type_into("QuadrilleSize", "3 mm")
        close_panel(CANCEL)
        self.assertEqual((mesh.Size.Value, mesh.FemMesh.FaceCount), (2, 0))
        self.assert_no_bar()

    def test_a_run_that_was_taken_back_ends_in_the_panel(self):
        mesh = self.go_on()
        self.edit(mesh)
        self.assertFalse(find("QuadrilleMesh").isEnabled())
        self.let_go()
        self.assert_sound(mesh, UP_TO_DATE)
        self.assertIn(f"{mesh.QuadCount} quads: mesher", find("QuadrilleLog").toPlainText())
        close_panel(CANCEL)  # undoes what was done since the panel was opened again
        self.assertEqual((mesh.Size.Value, mesh.FemMesh.FaceCount), (2, 0))

    def test_a_run_ends_while_another_panel_is_open(self):
        mesh = self.go_on()
        cylinder = self.document.addObject("Part::Cylinder", "Cylinder")
        self.document.recompute()
        self.open_panel(cylinder)
        self.let_it_wait()
        self.assertEqual(mesh.FemMesh.FaceCount, 0)
        close_panel(CANCEL)
        wait_for(lambda: not background._runs, what="the mesh")
        self.assert_sound(mesh, UP_TO_DATE)
        self.assertIsNotNone(self.document.getObject("Cylinder"))

    def test_a_run_ends_while_an_undo_step_is_made(self):
        mesh = self.go_on()
        self.document.openTransaction("Another")
        self.document.Box.Label = "Renamed"
        self.let_it_wait()
        self.assertEqual(mesh.FemMesh.FaceCount, 0)
        self.document.abortTransaction()
        wait_for(lambda: not background._runs, what="the mesh")
        self.assert_sound(mesh, UP_TO_DATE)
        self.assertEqual(self.document.Box.Label, "Box")
        self.assert_no_bar()

    def test_a_mesh_that_waits_is_stopped(self):
        mesh = self.go_on()
        self.document.openTransaction("Another")
        self.document.Box.Label = "Renamed"
        self.let_it_wait()
        find("QuadrilleBackgroundStop").click()
        self.assert_no_bar()
        self.document.commitTransaction()
        self.assert_sound(mesh, NOT_MESHED)

    def test_two_runs(self):
        first = self.go_on()
        cylinder = self.document.addObject("Part::Cylinder", "Cylinder")
        self.document.recompute()
        second = self.open_panel(cylinder)
        type_into("QuadrilleSize", "2 mm")
        self.begin()
        close_panel()
        self.assertEqual(len(background._runs), 2)
        self.come_to_its_end()
        self.assert_sound(first, UP_TO_DATE)
        self.assert_sound(second, UP_TO_DATE)
        self.document.undo()
        self.document.undo()
        self.assertEqual((first.FemMesh.FaceCount, second.FemMesh.FaceCount), (0, 0))

    # Buttons and keys

    def test_impatience(self):
        mesh = self.open_panel(self.box())
        self.begin()
        for _ in range(3):
            find("QuadrilleMesh").click()
            find("QuadrilleStop").click()
        wait_for(lambda: find("QuadrilleMesh").isEnabled(), what="stopping")
        self.begin()
        for workbench in ("PartWorkbench", "FemWorkbench"):
            FreeCADGui.activateWorkbench(workbench)
            process(0.2)
        find("QuadrilleStop").click()
        close_panel()
        self.assertEqual(mesh.FemMesh.FaceCount, 0)

    def test_escape_is_cancel(self):
        self.open_panel(self.box())
        self.begin()
        escape = QtGui.QKeyEvent(QtCore.QEvent.KeyPress, QtCore.Qt.Key_Escape, QtCore.Qt.NoModifier)
        QtGui.QApplication.sendEvent(find("QuadrilleScrolled"), escape)
        process(0.2)
        self.assertEqual([obj.Name for obj in self.document.Objects], ["Box"])

    def test_a_copy_has_a_life_of_its_own(self):
        mesh = quadrille.freecad.mesh_object(self.box(), size=2)
        copy = self.document.copyObject(mesh, False)
        self.document.recompute()
        self.edit(copy)
        type_into("QuadrilleSize", "3 mm")
        self.press_mesh()
        close_panel()
        self.assert_sound(mesh, UP_TO_DATE)
        self.assert_sound(copy, UP_TO_DATE)
        self.assertLess(copy.QuadCount, mesh.QuadCount)


run(RoughTest)
