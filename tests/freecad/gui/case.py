"""What tests in FreeCAD's window have in common: a document, parts, the panel."""

import os
import sys
import unittest
from pathlib import Path

import FreeCAD
import FreeCADGui
import Part
from PySide import QtGui

from driver import Boxes, close_panel, find, prepare, process, screenshot, trigger, wait_for
from quadrille.document.state import is_quad_mesh

ROOT = Path(__file__).resolve().parents[3]
MODELS = ROOT / "examples" / "models"
PICTURES = Path(sys.argv[1]) if len(sys.argv) > 1 else None


def picture(name):
    """A screenshot, where they are wanted."""
    if PICTURES is not None:
        screenshot(PICTURES / f"{name}.png")


def type_size(dialog, size):
    """Types into the box of Refine."""
    dialog.findChild(QtGui.QLineEdit, "QuadrilleRefineSize").setText(f"{size!r} mm")


def type_into(name, text):
    """Types into a box for lengths, and leaves it."""
    line = find(name)
    line.setFocus()
    line.selectAll()
    line.insert(text)
    process(0.1)
    find("QuadrilleScrolled").setFocus()
    process(0.1)


class GuiCase(unittest.TestCase):
    """Each test has a document of its own."""

    def setUp(self):
        unexpected = Boxes(patience=20)  # a box that no test answers would stay until ctest's limit
        unexpected.__enter__()
        self.addCleanup(lambda: self.assertEqual(unexpected.texts, [], "boxes that the test did not answer"))
        self.addCleanup(unexpected.__exit__)
        prepare()
        self.document = FreeCAD.newDocument("Test")
        self.document.UndoMode = 1
        FreeCADGui.activateWorkbench("QuadrilleWorkbench")
        FreeCADGui.Selection.clearSelection()

    def tearDown(self):
        FreeCADGui.Control.closeDialog()
        process(0.2)
        for name in list(FreeCAD.listDocuments()):
            FreeCAD.closeDocument(name)
        process(0.1)

    def bracket(self):
        """The sample part."""
        part = self.document.addObject("Part::Feature", "Bracket")
        part.Shape = Part.read(str(MODELS / "bracket.step"))
        self.show()
        return part

    def box(self, length=10.0):
        """A parametric part."""
        box = self.document.addObject("Part::Box", "Box")
        box.Length = length
        self.document.recompute()
        self.show()
        return box

    @staticmethod
    def show():
        """Everything in view."""
        FreeCADGui.activeDocument().activeView().viewIsometric()
        FreeCADGui.SendMsgToActiveView("ViewFit")
        process(0.3)

    def open_panel(self, part):
        """Selects a part and triggers the command; returns the mesh object."""
        FreeCADGui.Selection.clearSelection()
        FreeCADGui.Selection.addSelection(part)
        with Boxes() as boxes:
            trigger("Quadrille_Mesh")
        self.assertEqual(boxes.texts, [])
        self.assertTrue(FreeCADGui.Control.activeDialog())
        estimate = find("QuadrilleEstimate")
        wait_for(lambda: not estimate.text().endswith("..."), what="the estimate")
        return [obj for obj in self.document.Objects if is_quad_mesh(obj)][-1]

    def press_mesh(self):
        """Presses Mesh and waits for the end."""
        find("QuadrilleMesh").click()
        self.assertFalse(find("QuadrilleMesh").isEnabled())
        wait_for(lambda: find("QuadrilleMesh").isEnabled(), what="meshing")

    def meshed(self, part):
        """A mesh made through the panel."""
        mesh = self.open_panel(part)
        self.press_mesh()
        close_panel()
        return mesh

    def message(self, command):
        """The one message that a command gives; nothing else may happen."""
        before = [obj.Name for obj in self.document.Objects]
        with Boxes() as boxes:
            trigger(command)
        self.assertEqual(len(boxes.texts), 1, boxes.texts)
        self.assertEqual([obj.Name for obj in self.document.Objects], before)
        self.assertFalse(FreeCADGui.Control.activeDialog())
        return boxes.texts[0]


def run(case):
    """Runs the tests of a class, or the one that the environment names; ends the process."""
    suite = unittest.defaultTestLoader.loadTestsFromTestCase(case)
    only = os.environ.get("QUADRILLE_GUI_TEST")
    if only:
        suite = unittest.TestSuite([case(name) for name in only.split(",")])
    result = unittest.TextTestRunner(stream=sys.stderr, verbosity=2, warnings="ignore").run(suite)
    sys.exit(0 if result.wasSuccessful() and result.testsRun else 1)
