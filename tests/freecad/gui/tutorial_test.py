"""Clicks what docs/tutorial.md says, in its own words: menus, buttons and values are taken from its text.

    scripts/freecad_gui tests/freecad/gui/tutorial_test.py [FOLDER FOR SCREENSHOTS]
"""

import re
import shutil
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))

import FreeCAD
import FreeCADGui
from PySide import QtCore, QtGui

from case import ROOT, GuiCase, picture, run, type_into
from driver import Boxes, find, process, wait_for, window
from quadrille.document.state import is_quad_mesh
from quadrille.middle import is_middle, thickness_objects


def read_steps():
    """The numbered steps of the section, as plain lines."""
    text = (ROOT / "docs" / "tutorial.md").read_text(encoding="utf-8")
    text = text.split("## In FreeCAD, to stresses")[1].split("\n## ")[0]
    text = re.sub(r"!\[.*?\]\(.*?\)", "", text.split("A script clicks")[0])
    steps, table = text.split("| FreeCAD ")
    found = re.split(r"^(\d+)\. ", steps, flags=re.MULTILINE)[1:]
    return ({int(number): " ".join(step.split()) for number, step in zip(found[::2], found[1::2])},
            read_names("| FreeCAD " + table))


def read_names(table):
    """What the FreeCAD that runs calls the things that the steps name otherwise, from the table below them."""
    rows = [[cell.strip() for cell in line.strip("| ").split("|")] for line in table.splitlines() if line.startswith("|")]
    version = ".".join(FreeCAD.Version()[:2])
    versions = [cell.replace("FreeCAD ", "") for cell in rows[0]]
    if version not in versions:
        raise unittest.SkipTest(f"the tutorial does not speak of FreeCAD {version}")
    return {row[0]: row[versions.index(version)] for row in rows[2:]}


STEPS, NAMES = read_steps()
#: The test after which FreeCAD ends.
LAST = "test_from_an_empty_freecad_to_stresses"


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
        """Takes a menu entry that a step names, by the name that this FreeCAD has for it."""
        named = re.findall(r"\*([^*]+ > [^*]+)\*", STEPS[step])[number]
        action = entry(NAMES.get(named, named))
        self.assertIsNotNone(action, f"step {step}: there is no menu entry {NAMES.get(named, named)}")
        wait_for(action.isEnabled, what=named)
        action.trigger()
        process(0.5)

    def press(self, step, text):
        """Presses a button that a step names."""
        self.assertIn(f"**{text}**", STEPS[step])
        text = NAMES.get(text, text)
        buttons = [button for button in task_dock().findChildren(QtGui.QAbstractButton)
                   if button.isVisible() and button.text().replace("&", "") == text]
        self.assertEqual(len(buttons), 1, f"step {step}: {text}: {self.buttons()}")
        self.assertTrue(buttons[0].isEnabled(), f"step {step}: {text}")
        buttons[0].click()
        process(0.5)

    @staticmethod
    def buttons():
        """What the buttons in view say."""
        return [button.text() for button in task_dock().findChildren(QtGui.QAbstractButton) if button.isVisible()]

    def click(self, part, *names):
        """Selects edges or faces, as clicks in the view do."""
        FreeCADGui.Selection.clearSelection()
        for name in names:
            FreeCADGui.Selection.addSelection(part.Document.Name, part.Name, name)
        process(0.3)

    def fill_in(self, widgets, text):
        """Writes into a field of FreeCAD's that can be seen; its name in the one or the other version."""
        found = [field for field in task_dock().findChildren(QtGui.QWidget)
                 if field.isVisible() and field.objectName() in widgets]
        self.assertEqual(len(found), 1, widgets)
        line = found[0] if isinstance(found[0], QtGui.QLineEdit) else found[0].findChild(QtGui.QLineEdit)
        line.setText(text)
        process(0.3)

    def rims(self, part, radius):
        """The names of the circles of a radius."""
        return [f"Edge{i}" for i, edge in enumerate(part.Shape.Edges, 1)
                if getattr(edge.Curve, "Radius", 0) and abs(edge.Curve.Radius - radius) < 1e-6 and edge.isClosed()]

    def tearDown(self):
        """Leaves the document open where a result was shown: FreeCAD 1.1.3 crashes on closing it, and the process ends now."""
        if self._testMethodName != LAST:
            super().tearDown()

    def test_a_pipeline_as_results(self):
        if not self.newer():
            self.skipTest("results as a pipeline are of FreeCAD 1.1")
        settings = FreeCAD.ParamGet("User parameter:BaseApp/Preferences/Mod/Fem")
        settings.GetGroup("General").SetBool("UseTempDirectory", True)  # what OK in the preferences writes; else no folder
        settings.GetGroup("Ccx").SetBool("ResultAsPipeline", True)
        try:
            self.follow()
        finally:
            settings.GetGroup("Ccx").SetBool("ResultAsPipeline", False)

    def test_from_an_empty_freecad_to_stresses(self):
        self.follow()

    @staticmethod
    def newer():
        """True from FreeCAD 1.1 on."""
        return tuple(map(int, FreeCAD.Version()[:2])) >= (1, 1)

    def follow(self):
        """All steps."""
        if not shutil.which("ccx"):
            self.skipTest("CalculiX is not installed")
        part = self.open_the_part()
        solver, surface = self.make_analysis(part)
        mesh = self.mesh(surface)
        mesh.ViewObject.hide()
        largest = self.solve(solver)
        named = float(re.search(r"about (\d+) MPa", STEPS[11]).group(1))
        self.assertLess(abs(largest / named - 1), 0.03, (largest, named))

    def open_the_part(self):
        """Step 1."""
        FreeCAD.closeDocument(self.document.Name)
        FreeCADGui.activateWorkbench("PartWorkbench")

        def answer(box):
            if isinstance(box, QtGui.QFileDialog):
                # selectFile() waits for the folder to be listed, which may come after the box is accepted.
                box.findChild(QtGui.QLineEdit, "fileNameEdit").setText(str(ROOT / self.values(1)[0]))

        with Boxes(answer) as boxes:
            self.choose(1)
            wait_for(lambda: FreeCAD.ActiveDocument is not None and FreeCAD.ActiveDocument.Objects, what="the part")
        self.assertEqual(boxes.texts, [])
        self.document = FreeCAD.ActiveDocument
        self.assertEqual(len(self.document.Objects), 1)
        FreeCADGui.activateWorkbench("FemWorkbench")
        self.show()
        picture("tutorial_1")
        return self.document.Objects[0]

    def make_analysis(self, part):
        """Steps 2 to 6; returns the solver and the middle surface."""
        self.choose(2)
        solvers = [obj for obj in self.document.Objects if obj.isDerivedFrom("Fem::FemSolverObject")]
        if not solvers:
            self.choose(2, 1)
            solvers = [obj for obj in self.document.Objects if obj.isDerivedFrom("Fem::FemSolverObject")]
        self.assertEqual(len(solvers), 1)
        picture("tutorial_2")
        self.choose(3)
        self.choose_card(re.findall(r"card \*([^*]+)\*", STEPS[3])[0])
        picture("tutorial_3")
        self.press(3, "OK")
        FreeCADGui.Selection.clearSelection()
        FreeCADGui.Selection.addSelection(part)
        self.choose(4)
        surface, = (obj for obj in self.document.Objects if is_middle(obj))
        self.assertFalse(part.ViewObject.Visibility)
        picture("tutorial_4")
        sheet, = thickness_objects(surface)
        self.assertIn(f"{sheet.Thickness.getValueAs('mm').Value:g} mm", STEPS[4])
        self.choose(5)
        self.press(5, "Add")
        holes = self.rims(surface, 4)
        self.assertEqual(len(holes), 4)
        self.click(surface, *holes)
        picture("tutorial_5")
        self.press(5, "OK")
        self.choose(6)
        unit, bare = self.values(6)
        shown = task_dock().findChild(QtGui.QAbstractSpinBox, "spinForce").text()
        self.fill_in(("spinForce",), unit if "N" in shown else bare)
        self.press(6, "Add")
        self.click(surface, *self.rims(surface, 2.75))
        self.press(6, "Add")
        wall = next(f"Face{i}" for i, face in enumerate(surface.Shape.Faces, 1) if face.BoundBox.XLength < 1e-6)
        self.click(surface, wall)
        self.press(6, "Direction")
        picture("tutorial_6")
        self.press(6, "OK")
        return solvers[0], surface

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

    def mesh(self, surface):
        """Steps 7 to 9; returns the mesh object."""
        FreeCADGui.Selection.clearSelection()
        FreeCADGui.Selection.addSelection(surface)
        self.choose(7)
        mesh = [obj for obj in self.document.Objects if is_quad_mesh(obj)][-1]
        type_into("QuadrilleSize", self.values(7)[0])
        picture("tutorial_7")
        find("QuadrilleSurfaces").setChecked(True)
        self.assertIn(f"*{find('QuadrilleSurfaces').text()}*", STEPS[8])
        self.press(8, "Mesh")
        wait_for(lambda: find("QuadrilleMesh").isEnabled(), what="meshing")
        before = mesh.QuadCount
        self.assertIn(f"*{find('QuadrilleColor').text()}*", STEPS[8])
        find("QuadrilleColor").setChecked(True)
        picture("tutorial_8")
        find("QuadrilleColor").setChecked(False)
        bend = next(f"Face{i}" for i, face in enumerate(surface.Shape.Faces, 1) if face.BoundBox.XMax < 6 and face.BoundBox.ZMax < 6)
        self.click(surface, bend)
        find("QuadrilleRefinements").setChecked(True)
        self.press(9, "Refine selection")
        type_into("QuadrilleRefinedSize0", self.values(9)[0])
        self.press(9, "Mesh")
        wait_for(lambda: find("QuadrilleMesh").isEnabled(), what="meshing")
        self.assertGreater(mesh.QuadCount, before)
        picture("tutorial_9")
        self.press(9, "OK")
        return mesh

    def solve(self, solver):
        """Steps 10 and 11; returns the largest stress that FreeCAD shows."""
        FreeCADGui.activeDocument().setEdit(solver.Name)
        process(0.5)
        newer = "Apply" in self.buttons()
        for text in ("Apply",) if newer else ("Write .inp File", "Run CalculiX"):
            self.press(10, text)

        def results():
            return [obj for obj in self.document.Objects
                    if obj.isDerivedFrom("Fem::FemPostPipeline" if newer else "Fem::FemResultObject")]

        said = re.findall(r"\*([^*]+)\*, \*\*OK", STEPS[10])[0]
        wait_for(lambda: results() and (not newer or said in task_dock().findChild(QtGui.QTextEdit).toPlainText()), 120,
                 "CalculiX")
        process(1)
        picture("tutorial_10")
        self.press(10, "OK" if newer else "Close")
        result = results()[0]
        FreeCADGui.activeDocument().setEdit(result.Name)
        process(0.5)
        self.choose_stress(re.findall(r"choose \*([^*]+)\*", STEPS[11])[0])
        self.hide_others(result, self.values(11))
        picture("tutorial_11")
        return max(von_mises(result))

    def hide_others(self, result, names):
        """Hides what a step names; then nothing but the result covers the part."""
        for name in names:
            other = self.document.getObject(name)
            if other is not None:
                other.ViewObject.hide()
        process(0.3)
        kinds = ("Part::Feature", "Fem::FemMeshObject", "Fem::FemPostObject")
        seen = [obj for obj in self.document.Objects if obj.ViewObject.Visibility and any(map(obj.isDerivedFrom, kinds))]
        self.assertEqual(seen, [getattr(result, "Mesh", None) or result], [obj.Name for obj in seen])

    def choose_stress(self, named):
        """In the panel of the result: buttons in 0.20 and 1.0, a list of fields in 1.1."""
        for box in task_dock().findChildren(QtGui.QComboBox):
            if box.isVisible() and box.findText(named) >= 0:
                box.setCurrentIndex(box.findText(named))
                box.activated[int].emit(box.currentIndex())
                process(0.5)
                return
        buttons = [button for button in task_dock().findChildren(QtGui.QRadioButton)
                   if button.isVisible() and button.text().lower() == named.lower()]
        self.assertEqual(len(buttons), 1, named)
        buttons[0].click()
        process(0.5)


def von_mises(result):
    """The stresses of a result object, or of 1.1's pipeline."""
    if hasattr(result, "vonMises"):
        return result.vonMises
    from vtkmodules.util.numpy_support import vtk_to_numpy

    blocks = result.Data
    return vtk_to_numpy(blocks.GetBlock(0).GetPointData().GetArray("von Mises Stress"))


run(TutorialTest)
