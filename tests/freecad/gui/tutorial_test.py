"""Clicks what docs/tutorial.md and README.md say, with the mouse on what is visible, and types with the keyboard: menus,
buttons and values are taken from their text.

    scripts/freecad_gui tests/freecad/gui/tutorial_test.py [FOLDER FOR SCREENSHOTS]
"""

import itertools
import re
import shutil
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))

import FreeCAD
import FreeCADGui
from PySide import QtGui

import hand
from case import MODELS, ROOT, GuiCase, picture, run
from driver import Boxes, find, process, wait_for
from quadrille.document.state import is_quad_mesh
from quadrille.middle import is_middle, thickness_objects


TEXT = (ROOT / "docs" / "tutorial.md").read_text(encoding="utf-8")


def read_steps():
    """The numbered steps of the section, as plain lines."""
    text = TEXT.split("## In FreeCAD, to stresses")[1].split("\n## ")[0]
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
#: Clicks that the way from an open part to its stresses may take.
MOST_CLICKS = 25


def task_dock():
    """The dock of the task panel that is open, or opens now."""
    def found():
        return next((dock for dock in hand.seen(QtGui.QDockWidget) if hand.seen(QtGui.QDialogButtonBox, dock)), None)
    wait_for(found, 30, "a task panel")
    return found()


class TutorialTest(GuiCase):
    """One test: the steps build on each other."""

    def values(self, step):
        """What stands in a step as `code`."""
        return re.findall(r"`([^`]+)`", STEPS[step])

    def choose(self, step):
        """Takes the menu entry that a step names."""
        named = re.findall(r"\*([^*]+ > [^*]+)\*", STEPS[step])[0]
        self.assertTrue(hand.choose_entry(named), f"step {step}: no menu entry {named}")

    def press_tool(self, step):
        """Presses the toolbar's button for the command that a step names first, by the name that this FreeCAD has for it."""
        named = re.findall(r"(?<!\*)\*([^*]+)\*(?!\*)", STEPS[step])[0]
        hand.press_tool(NAMES.get(named, named).split(" > ")[-1])

    def press(self, step, text):
        """Presses a button that a step names."""
        self.assertIn(f"**{text}**", STEPS[step])
        self.press_button(NAMES.get(text, text))

    def press_button(self, text):
        """Presses a button of the task panel."""
        buttons = [button for button in hand.seen(QtGui.QAbstractButton, task_dock())
                   if button.text().replace("&", "") == text]
        self.assertEqual(len(buttons), 1, f"{text}: {self.buttons()}")
        self.assertTrue(buttons[0].isEnabled(), text)
        hand.click(buttons[0])
        process(0.5)

    @staticmethod
    def buttons():
        """What the buttons in view say."""
        return [button.text() for button in hand.seen(QtGui.QAbstractButton, task_dock())]

    def click(self, part, *names):
        """Clicks edges or faces in the view, where they show."""
        for name in names:
            self.assertTrue(self.point_at(part, name), f"{part.Name}.{name} cannot be clicked in this view")
            hand.press()

    @staticmethod
    def point_at(part, name):
        """Moves the pointer to an edge or face until FreeCAD highlights it; False where other things cover it everywhere."""
        element = part.Shape.getElement(name)
        if name.startswith("Edge"):
            first, last = element.ParameterRange
            points = [element.valueAt(first + (last - first) * i / 36) for i in range(1, 36)]
        else:
            low_u, high_u, low_v, high_v = element.ParameterRange
            places = [(low_u + (high_u - low_u) * i / 10, low_v + (high_v - low_v) * j / 10)
                      for i, j in itertools.product((5, 4, 6, 3, 7, 2, 8, 1, 9), repeat=2)]
            points = [element.valueAt(*place) for place in places if element.isPartOfDomain(*place)]
        return any(hand.highlighted(point) == (part.Name, name) for point in points)

    def click_part(self, part):
        """Clicks on the largest of its faces that show."""
        faces = sorted(range(1, len(part.Shape.Faces) + 1), key=lambda i: -part.Shape.Faces[i - 1].Area)
        self.assertTrue(any(self.point_at(part, f"Face{i}") for i in faces), part.Name)
        hand.press()

    def fill_in(self, widgets, text):
        """Types into a field of FreeCAD's that can be seen; its name in the one or the other version."""
        found = [field for field in hand.seen(QtGui.QWidget, task_dock()) if field.objectName() in widgets]
        self.assertEqual(len(found), 1, widgets)
        hand.write(found[0], text)

    def rims(self, part, radius):
        """The names of the circles of a radius."""
        return [f"Edge{i}" for i, edge in enumerate(part.Shape.Edges, 1)
                if getattr(edge.Curve, "Radius", 0) and abs(edge.Curve.Radius - radius) < 1e-6 and edge.isClosed()]

    def test_from_an_empty_freecad_to_stresses(self):
        if not shutil.which("ccx"):
            self.skipTest("CalculiX is not installed")
        part = self.open_the_part()
        before = hand.clicks
        surface = self.make_analysis(part)
        mesh = self.mesh(surface)
        needed = hand.clicks - before
        self.look_and_refine(surface, mesh)
        before = hand.clicks
        largest = self.solve(mesh)
        needed += hand.clicks - before
        self.assertLessEqual(needed, MOST_CLICKS)
        self.assertEqual(needed, int(re.search(r"these are (\d+) clicks", TEXT).group(1)))
        named = float(re.search(r"about (\d+) MPa", STEPS[8]).group(1))
        self.assertLess(abs(largest / named - 1), 0.03, (largest, named))

    def open_the_part(self):
        """Step 1."""
        FreeCAD.closeDocument(self.document.Name)
        self.document = self.open_file(str(ROOT / self.values(1)[0]), lambda: self.choose(1))
        self.assertEqual(len(self.document.Objects), 1)
        self.assertIn("**FEM** workbench", STEPS[1])
        hand.use_fem()
        hand.type_text(self.values(1)[1])
        process(0.5)
        picture("tutorial_1")
        return self.document.Objects[0]

    def open_file(self, path, choose):
        """The document of a file, opened through the boxes that come up."""
        FreeCADGui.activateWorkbench("PartWorkbench")

        def answer(box):
            if isinstance(box, QtGui.QFileDialog):
                hand.write(box.findChild(QtGui.QLineEdit, "fileNameEdit"), path, hand.RETURN)
            else:
                hand.click(box.findChild(QtGui.QDialogButtonBox).button(QtGui.QDialogButtonBox.Ok))
            return True

        with Boxes(answer) as boxes:
            choose()
            wait_for(lambda: FreeCAD.ActiveDocument is not None and FreeCAD.ActiveDocument.Objects, what="the part")
        self.assertEqual(boxes.texts, [])
        process(0.5)
        return FreeCAD.ActiveDocument

    def make_analysis(self, part):
        """Steps 2 to 4; returns the middle surface."""
        def agree(box):
            self.assertIn("**Yes**", STEPS[2])
            hand.click(box.button(QtGui.QMessageBox.Yes))

        self.click_part(part)
        with Boxes(question=agree) as boxes:
            self.press_tool(2)
        self.assertEqual(len(boxes.texts), 1)
        surface, = (obj for obj in self.document.Objects if is_middle(obj))
        self.assertFalse(part.ViewObject.Visibility)
        picture("tutorial_2")
        sheet, = thickness_objects(surface)
        self.assertIn(f"{sheet.Thickness.getValueAs('mm').Value:g} mm", STEPS[2])
        holes = self.rims(surface, 4)
        self.assertEqual(len(holes), 4)
        self.press_tool(3)
        self.press(3, "Add")
        self.click(surface, *holes)
        self.check_references("Fem::ConstraintFixed", holes)
        picture("tutorial_3")
        self.press(3, "OK")
        self.press_tool(4)
        unit, bare = self.values(4)
        shown = task_dock().findChild(QtGui.QAbstractSpinBox, "spinForce").text()
        self.fill_in(("spinForce",), unit if "N" in shown else bare)
        wall = next(f"Face{i}" for i, face in enumerate(surface.Shape.Faces, 1) if face.BoundBox.XLength < 1e-6)
        self.click(surface, wall)
        self.press(4, "Direction")
        self.press(4, "Add")
        self.click(surface, *self.rims(surface, 2.75))
        self.check_references("Fem::ConstraintForce", self.rims(surface, 2.75))
        picture("tutorial_4")
        self.press(4, "OK")
        return surface

    def check_references(self, kind, names):
        """That a constraint has all that was clicked."""
        constraint, = (obj for obj in self.document.Objects if obj.isDerivedFrom(kind))
        self.assertEqual(sorted(name for _, found in constraint.References for name in found), sorted(names))

    def mesh(self, surface):
        """Step 5; returns the mesh object."""
        self.press_tool(5)
        mesh, = (obj for obj in self.document.Objects if is_quad_mesh(obj))
        self.assertEqual(mesh.Shape, surface)
        hand.write(find("QuadrilleSize"), self.values(5)[0])
        self.assertIn(f"*{find('QuadrilleSurfaces').text()}* is ticked", STEPS[5])
        self.assertTrue(find("QuadrilleSurfaces").isChecked())
        picture("tutorial_5")
        self.press_mesh_of(5)
        return mesh

    def look_and_refine(self, surface, mesh):
        """Steps 6 and 7."""
        before = mesh.QuadCount
        worst = find("QuadrilleWorst")
        hand.click_item(worst, worst.model().index(0, 0))
        for key in self.values(6):
            hand.type_text(key)
        self.tick(6, "QuadrilleColor")
        picture("tutorial_6")
        self.tick(6, "QuadrilleColor", False)
        bend = next(face for face in surface.Shape.Faces if face.BoundBox.XMax < 6 and face.BoundBox.ZMax < 6)
        hand.click_model(on_bend(bend))
        hand.click(find("QuadrilleRefinements"))
        self.press(7, "Refine selection")
        hand.write(find("QuadrilleRefinedSize0"), self.values(7)[0])
        self.press_mesh_of(7)
        self.assertGreater(mesh.QuadCount, before)
        region, = mesh.MeshRegionList
        (_, (name,)), = region.References
        self.assertTrue(surface.Shape.getElement(name).isSame(bend), name)
        picture("tutorial_7")

    def press_mesh_of(self, step):
        """Presses Mesh and waits for the end."""
        self.press(step, "Mesh")
        wait_for(lambda: find("QuadrilleMesh").isEnabled(), what="meshing")
        process(0.3)

    def tick(self, step, name, ticked=True):
        """Clicks on a check box of ours that a step names, where it is not as wanted."""
        box = find(name)
        self.assertIn(f"*{box.text()}*", STEPS[step])
        if box.isChecked() != ticked:
            hand.click(box)
        self.assertEqual(box.isChecked(), ticked)

    def solve(self, mesh):
        """Step 8; returns the largest stress."""
        self.press_tool(8)
        result, = (obj for obj in self.document.Objects if obj.isDerivedFrom("Fem::FemResultObject"))
        chosen = [button.text() for button in hand.seen(QtGui.QRadioButton, task_dock()) if button.isChecked()]
        self.assertIn("von mises stress", [text.lower() for text in chosen])
        kinds = ("Part::Feature", "Fem::FemMeshObject", "Fem::FemPostObject")
        seen = [obj for obj in self.document.Objects if obj.ViewObject.Visibility and any(map(obj.isDerivedFrom, kinds))]
        self.assertEqual(seen, [result.Mesh], [obj.Name for obj in seen])
        self.assertIn(mesh, self.document.Objects)
        picture("tutorial_8")
        return max(result.vonMises)

    def test_a_mesh_as_the_readme_says(self):
        FreeCAD.closeDocument(self.document.Name)
        text = " ".join((ROOT / "README.md").read_text(encoding="utf-8").split("## In FreeCAD\n")[1].split("\n## ")[0].split())
        self.document = self.open_file(str(MODELS / "bracket.step"), lambda: hand.choose_entry("File > Open"))
        part, = self.document.Objects
        self.assertIn("in the FEM workbench: click the part", text)
        hand.use_fem()
        self.click_part(part)
        self.assertTrue(hand.choose_entry(re.findall(r"\*([^*]+ > [^*]+)\*", text)[0]))
        self.press_button(re.findall(r"\*\*([^*]+)\*\*", text)[0])
        wait_for(lambda: find("QuadrilleMesh").isEnabled(), what="meshing")
        mesh, = (obj for obj in self.document.Objects if is_quad_mesh(obj))
        self.assertGreater(mesh.QuadCount, 1000)
        self.press_button("OK")


def on_bend(face):
    """The middle of a curved face, on it."""
    first_u, last_u, first_v, last_v = face.ParameterRange
    return face.valueAt((first_u + last_u) / 2, (first_v + last_v) / 2)


run(TutorialTest)
