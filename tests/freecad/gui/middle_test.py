"""The command Middle surface in FreeCAD's window: from a solid to a shell analysis, loads moved, the panel's hint.

    scripts/freecad_gui tests/freecad/gui/middle_test.py [FOLDER FOR SCREENSHOTS]
"""

import os
import sys
import tempfile
from pathlib import Path
from unittest import mock

sys.path.insert(0, str(Path(__file__).resolve().parent))

import FemGui
import FreeCADGui
import ObjectsFem
import Part
from PySide import QtCore

from case import GuiCase, picture, run
from driver import Boxes, cancel_bars, close_panel, find, process, trigger, wait_for, window
from quadrille.core.command import VERSION
from quadrille.core.errors import Error
from quadrille.document.state import is_quad_mesh
from quadrille.features import middle
from quadrille.gui.commands import MiddleCommand
from quadrille.solvers import results


class MiddleTest(GuiCase):
    """Each test has a document of its own."""

    def part(self, shape, name="Sheet"):
        part = self.document.addObject("Part::Feature", name)
        part.Shape = shape
        self.show()
        return part

    def sheet(self):
        """A plate of 80 x 50 x 2 mm with a rib of 3 mm."""
        return self.part(Part.makeBox(80, 50, 2).fuse(Part.makeBox(3, 50, 22)).removeSplitter())

    def surfaces(self):
        return [obj for obj in self.document.Objects if middle.is_middle(obj)]

    def make(self, *parts, answer=True):
        """Selects parts, triggers the command; gives the questions that it asked."""
        FreeCADGui.Selection.clearSelection()
        for part in parts:
            FreeCADGui.Selection.addSelection(part)
        questions = []
        ask = staticmethod(lambda question: questions.append(question) or answer)
        with mock.patch.object(MiddleCommand, "ask", ask), Boxes() as boxes:
            trigger("Quadrille_Middle")
        self.assertEqual(boxes.texts, [])
        self.assertEqual(len(self.surfaces()), 1)
        return questions

    def test_from_a_solid_to_a_shell_analysis(self):
        part = self.sheet()
        analysis = ObjectsFem.makeAnalysis(self.document, "Analysis")
        FemGui.setActiveAnalysis(analysis)
        fixed = ObjectsFem.makeConstraintFixed(self.document, "Fixed")
        fixed.References = [(part, ("Face1",))]
        analysis.addObject(fixed)
        self.document.recompute()
        questions = self.make(part)
        self.assertEqual(len(questions), 1)
        self.assertIn("Fixed", questions[0])
        surface, = self.surfaces()
        self.assertFalse(part.ViewObject.Visibility)
        self.assertEqual(fixed.References[0][0], surface)
        self.assertEqual(sorted(round(obj.Thickness.getValueAs("mm").Value, 6) for obj in middle.thickness_objects(surface)),
                         [2, 3])
        self.assertTrue(all(obj in analysis.Group for obj in middle.thickness_objects(surface)))
        picture("middle_surface")
        self.document.undo()
        self.assertEqual(self.surfaces(), [])
        self.assertEqual(fixed.References[0][0], part)
        self.document.redo()
        self.assertEqual(len(self.surfaces()), 1)

    def test_an_analysis_is_offered_in_fem(self):
        part = self.sheet()
        FreeCADGui.activateWorkbench("FemWorkbench")

        def analyses():
            return [obj for obj in self.document.Objects if obj.isDerivedFrom("Fem::FemAnalysis")]

        questions = self.make(part, answer=False)
        self.assertEqual((len(questions), analyses()), (1, []))
        self.document.undo()
        questions = self.make(part)
        self.assertIn("steel", questions[0])
        (analysis,), (surface,) = analyses(), self.surfaces()
        self.assertEqual(FemGui.getActiveAnalysis(), analysis)
        self.assertEqual(len(results.solvers_of(analysis)), 1)
        self.assertEqual(len([obj for obj in analysis.Group if obj.isDerivedFrom("App::MaterialObject")]), 1)
        self.assertEqual(len(middle.thickness_objects(surface)), 2)
        FreeCADGui.Selection.clearSelection()
        trigger("Quadrille_Mesh")  # takes the only middle surface
        close_panel()
        mesh, = (obj for obj in analysis.Group if is_quad_mesh(obj))
        self.assertEqual(mesh.Shape, surface)

    def test_loads_stay_where_that_is_wanted(self):
        part = self.sheet()
        analysis = ObjectsFem.makeAnalysis(self.document, "Analysis")
        FemGui.setActiveAnalysis(analysis)
        fixed = ObjectsFem.makeConstraintFixed(self.document, "Fixed")
        fixed.References = [(part, ("Face1",))]
        analysis.addObject(fixed)
        self.assertEqual(len(self.make(part, answer=False)), 1)
        self.assertEqual(fixed.References[0][0], part)

    def test_the_panel_offers_it(self):
        part = self.sheet()
        self.open_panel(part)
        hint = find("QuadrilleThinHint")
        self.assertIn("may be a thin solid", hint.text())
        picture("thin_hint")
        hint.linkActivated.emit("middle")
        wait_for(self.surfaces, what="the middle surface")
        process(0.3)
        self.assertFalse(FreeCADGui.Control.activeDialog())
        self.assertEqual([obj.Name for obj in self.document.Objects if hasattr(obj, "FemMesh")], [])
        self.open_panel(self.surfaces()[0])
        self.press_mesh()
        close_panel()
        self.open_panel(self.part(Part.makeBox(10, 10, 10), "Block"))
        self.assertEqual(window().findChildren(type(hint), "QuadrilleThinHint"), [])

    def test_nothing_is_lost_where_there_is_no_middle(self):
        mesh = self.open_panel(self.sheet())
        self.press_mesh()
        quads = mesh.FemMesh.FaceCount
        refused = Error("Sheet: is not a thin solid", "failure")
        with mock.patch.object(middle, "prepare", side_effect=refused), Boxes() as boxes:
            find("QuadrilleThinHint").linkActivated.emit("middle")
            process(0.3)
        self.assertEqual(boxes.texts, [str(refused)])
        self.assertTrue(FreeCADGui.Control.activeDialog())
        self.assertEqual((self.surfaces(), mesh.FemMesh.FaceCount), ([], quads))
        close_panel()

    def test_what_is_wrong_is_told(self):
        block = self.part(Part.makeBox(10, 10, 10))
        FreeCADGui.Selection.addSelection(block)
        self.assertIn("is not a thin solid", self.message("Quadrille_Middle"))

    def test_thin_in_places_asks(self):
        part = self.part(Part.makeBox(40, 40, 40).fuse(Part.makeBox(3, 40, 100)).removeSplitter())
        questions = self.make(part)
        self.assertEqual(len(questions), 1)
        self.assertIn("thin only in places", questions[0])
        self.assertTrue(self.surfaces()[0].Problems[0].startswith("Sheet is thin only in places"))

    def test_what_takes_long_can_be_cancelled(self):
        part = self.sheet()
        self.make(part)
        surface, = self.surfaces()
        with tempfile.TemporaryDirectory() as folder:
            slow = Path(folder) / "quadrille"
            slow.write_text(f"#!/bin/sh\n[ $1 = --version ] && exec echo quadrille {VERSION}\nexec sleep 3000\n")
            slow.chmod(0o755)
            with mock.patch.dict(os.environ, QUADRILLE_COMMAND=str(slow)), Boxes() as boxes:
                for work in (lambda: trigger("Quadrille_Middle"), lambda: (surface.touch(), self.document.recompute())):
                    FreeCADGui.Selection.clearSelection()
                    FreeCADGui.Selection.addSelection(part)
                    QtCore.QTimer.singleShot(1500, cancel_bars)
                    work()
        self.assertEqual((boxes.texts, self.surfaces()), ([], [surface]))
        self.assertFalse(surface.isValid())
        surface.touch()
        self.document.recompute()
        self.assertTrue(surface.isValid())

    def test_several_parts_are_joined(self):
        post = self.part(Part.makeBox(3, 40, 60), "Post")
        arm = self.part(Part.makeBox(60, 40, 2), "Arm")
        arm.Placement.Base.x, arm.Placement.Base.z = 3, 30
        self.document.recompute()
        self.make(post, arm)
        surface, = self.surfaces()
        self.assertTrue(surface.Join)
        self.assertAlmostEqual(surface.Shape.Area, 40 * 60 + 40 * 61.5, 6)
        shared = [edge for edge in surface.Shape.Edges if len(surface.Shape.ancestorsOfType(edge, Part.Face)) > 2]
        self.assertEqual(len(shared), 1)


run(MiddleTest)
