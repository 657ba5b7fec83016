"""Clicks what docs/tutorial.md says, in its own words: menus, buttons and values are taken from its text.

    scripts/freecad_gui tests/freecad/gui/tutorial_test.py [FOLDER FOR SCREENSHOTS]
"""

import re
import shutil
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))

import FreeCAD
import FreeCADGui
from PySide import QtCore, QtGui

from case import ROOT, GuiCase, picture, run, type_into
from driver import Boxes, find, process, wait_for, window
from quadrille.state import is_quad_mesh


def read_steps():
    """The numbered steps of the section, as plain lines."""
    text = (ROOT / "docs" / "tutorial.md").read_text(encoding="utf-8")
    text = text.split("## In FreeCAD, to stresses")[1].split("\n## ")[0]
    text = re.sub(r"!\[.*?\]\(.*?\)", "", text.split("A script clicks")[0])
    found = re.split(r"^(\d+)\. ", text, flags=re.MULTILINE)[1:]
    return {int(number): " ".join(step.split()) for number, step in zip(found[::2], found[1::2])}


STEPS = read_steps()


def entry(path):
    """The action of a menu entry such as 'Mesh > Quad mesh from shape'; None where FreeCAD has none."""
    actions, found = window().menuBar().actions(), None
    for word in path.split(" > "):
        found = next((action for action in actions if action.text().replace("&", "").rstrip(".…") == word), None)
        if found is None:
            return None
        actions = found.menu().actions() if found.menu() is not None else []
    return found


def task_dock():
    """The dock in which task panels open."""
    return next(dock for dock in window().findChildren(QtGui.QDockWidget) if dock.isVisible()
                and dock.findChildren(QtGui.QDialogButtonBox))


class TutorialTest(GuiCase):
    """One test: the steps build on each other."""

    def values(self, step):
        """What stands in a step as `code`."""
        return re.findall(r"`([^`]+)`", STEPS[step])

    def choose(self, step, number=0):
        """Takes the menu entry that a step names; of alternatives for other versions the one that is there."""
        named = [path for path in re.findall(r"\*([^*]+ > [^*]+)\*", STEPS[step])]
        there = [action for action in map(entry, named) if action is not None]
        self.assertTrue(there, f"step {step}: there is no menu entry {named}")
        wait_for(there[number].isEnabled, 5, named[number])
        there[number].trigger()
        process(0.5)

    def press(self, step, text):
        """Presses a button that a step names."""
        self.assertIn(f"**{text}**", STEPS[step])
        buttons = [button for button in task_dock().findChildren(QtGui.QAbstractButton)
                   if button.isVisible() and button.text().replace("&", "") == text]
        self.assertEqual(len(buttons), 1, f"step {step}: {text}")
        self.assertTrue(buttons[0].isEnabled(), f"step {step}: {text}")
        buttons[0].click()
        process(0.5)

    def click(self, part, *names):
        """Selects edges or faces, as clicks in the view do."""
        FreeCADGui.Selection.clearSelection()
        for name in names:
            FreeCADGui.Selection.addSelection(part.Document.Name, part.Name, name)
        process(0.3)

    def fill_in(self, widget, text):
        """Writes into a field of FreeCAD's that can be seen."""
        found = [field for field in task_dock().findChildren(QtGui.QWidget, widget) if field.isVisible()]
        self.assertEqual(len(found), 1, widget)
        line = found[0] if isinstance(found[0], QtGui.QLineEdit) else found[0].findChild(QtGui.QLineEdit)
        line.setText(text)
        process(0.3)

    def rims(self, part, radius):
        """The names of the circles of a radius."""
        return [f"Edge{i}" for i, edge in enumerate(part.Shape.Edges, 1)
                if getattr(edge.Curve, "Radius", 0) and abs(edge.Curve.Radius - radius) < 1e-6 and edge.isClosed()]

    def test_from_an_empty_freecad_to_stresses(self):
        if not shutil.which("ccx"):
            self.skipTest("CalculiX is not installed")
        part = self.open_the_part()
        solver = self.make_analysis(part)
        mesh = self.mesh(part)
        result = self.solve(solver)
        named = float(re.search(r"about (\d+) MPa", STEPS[11]).group(1))
        self.assertLess(abs(max(result.vonMises) / named - 1), 0.03, (max(result.vonMises), named))
        mesh.ViewObject.hide()

    def open_the_part(self):
        """Step 1."""
        FreeCAD.closeDocument(self.document.Name)
        FreeCADGui.activateWorkbench("PartWorkbench")
        def answer(box):
            if isinstance(box, QtGui.QFileDialog):
                box.selectFile(str(ROOT / self.values(1)[0]))

        with Boxes(answer) as boxes:
            self.choose(1)
            wait_for(lambda: FreeCAD.ActiveDocument is not None and FreeCAD.ActiveDocument.Objects, 30, "the part")
        self.assertEqual(boxes.texts, [])
        self.document = FreeCAD.ActiveDocument
        self.assertEqual(len(self.document.Objects), 1)
        FreeCADGui.activateWorkbench("FemWorkbench")
        self.show()
        picture("tutorial_1")
        return self.document.Objects[0]

    def make_analysis(self, part):
        """Steps 2 to 6; returns the solver."""
        self.choose(2)
        solvers = [obj for obj in self.document.Objects if obj.isDerivedFrom("Fem::FemSolverObject")]
        if not solvers:
            self.choose(2, 1)
            solvers = [obj for obj in self.document.Objects if obj.isDerivedFrom("Fem::FemSolverObject")]
        self.assertEqual(len(solvers), 1)
        self.choose(3)
        self.choose_card(re.findall(r"card \*([^*]+)\*", STEPS[3])[0])
        self.press(3, "OK")
        self.choose(4)
        self.fill_in("if_thickness", self.values(4)[0])
        self.press(4, "OK")
        self.choose(5)
        self.press(5, "Add")
        holes = self.rims(part, 4)
        self.assertEqual(len(holes), 2)
        self.click(part, *holes)
        picture("tutorial_5")
        self.press(5, "OK")
        self.choose(6)
        bare, unit = self.values(6)
        shown = task_dock().findChild(QtGui.QAbstractSpinBox, "spinForce").text()
        self.fill_in("spinForce", unit if "N" in shown else bare)
        self.press(6, "Add")
        self.click(part, *self.rims(part, 6))
        self.press(6, "Add")
        wall = next(f"Face{i}" for i, face in enumerate(part.Shape.Faces, 1) if face.CenterOfMass.x > 55.9)
        self.click(part, wall)
        self.press(6, "Direction")
        picture("tutorial_6")
        self.press(6, "OK")
        return solvers[0]

    def choose_card(self, card):
        """In the panel for materials: a list in 0.20, a tree behind an arrow in 1.0."""
        for box in task_dock().findChildren(QtGui.QComboBox):
            if box.findText(card) >= 0:
                box.setCurrentIndex(box.findText(card))
                box.activated[int].emit(box.currentIndex())
                return
        buttons = task_dock().findChildren(QtGui.QPushButton)
        arrow = next(button for button in buttons if button.isVisible() and not button.text())
        arrow.click()
        process(0.5)
        tree = next(tree for tree in task_dock().findChildren(QtGui.QTreeView) if tree.isVisible())
        model = tree.model()
        found = model.match(model.index(0, 0), QtCore.Qt.DisplayRole, card, 1,
                            QtCore.Qt.MatchStartsWith | QtCore.Qt.MatchRecursive)
        self.assertEqual(len(found), 1, card)
        tree.setCurrentIndex(found[0])
        process(0.5)

    def mesh(self, part):
        """Steps 7 to 9; returns the mesh object."""
        FreeCADGui.Selection.clearSelection()
        FreeCADGui.Selection.addSelection(part)
        self.choose(7)
        mesh = [obj for obj in self.document.Objects if is_quad_mesh(obj)][-1]
        type_into("QuadrilleSize", self.values(7)[0])
        find("QuadrilleSurfaces").setChecked(True)
        self.assertIn(f"*{find('QuadrilleSurfaces').text()}*", STEPS[8])
        self.press(8, "Mesh")
        wait_for(lambda: find("QuadrilleMesh").isEnabled(), 60, "meshing")
        before = mesh.QuadCount
        self.assertIn(f"*{find('QuadrilleColor').text()}*", STEPS[8])
        find("QuadrilleColor").setChecked(True)
        picture("tutorial_8")
        find("QuadrilleColor").setChecked(False)
        bend = next(f"Face{i}" for i, face in enumerate(part.Shape.Faces, 1) if "Cylinder" in str(face.Surface))
        self.click(part, bend)
        find("QuadrilleRefinements").setChecked(True)
        self.press(9, "Refine selection")
        type_into("QuadrilleRefinedSize0", self.values(9)[0])
        self.press(9, "Mesh")
        wait_for(lambda: find("QuadrilleMesh").isEnabled(), 60, "meshing")
        self.assertGreater(mesh.QuadCount, before)
        picture("tutorial_9")
        self.press(9, "OK")
        return mesh

    def solve(self, solver):
        """Steps 10 and 11; returns the result."""
        FreeCADGui.activeDocument().setEdit(solver.Name)
        process(0.5)
        self.press(10, "Write .inp file")
        self.press(10, "Run CalculiX")

        def results():
            return [obj for obj in self.document.Objects if obj.isDerivedFrom("Fem::FemResultObject")]

        wait_for(results, 120, "CalculiX")
        process(1)
        self.press(10, "Close")
        result = results()[0]
        FreeCADGui.activeDocument().setEdit(result.Name)
        process(0.5)
        named = re.findall(r"choose \*([^*]+)\*", STEPS[11])[0]
        buttons = [button for button in task_dock().findChildren(QtGui.QRadioButton)
                   if button.isVisible() and button.text().lower() == named.lower()]
        self.assertEqual(len(buttons), 1, named)
        buttons[0].click()
        process(0.5)
        picture("tutorial_11")
        return result


run(TutorialTest)
