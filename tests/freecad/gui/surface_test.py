"""The command Quad mesh from mesh in FreeCAD's window: a scan meshed, meshed again, undone; what is wrong is told.

    scripts/freecad_gui tests/freecad/gui/surface_test.py [FOLDER FOR SCREENSHOTS]
"""

import os
import sys
import tempfile
from pathlib import Path
from unittest import mock

sys.path.insert(0, str(Path(__file__).resolve().parent))

import FemGui
import FreeCADGui
import Mesh
import MeshPart
import ObjectsFem
import Part
from PySide import QtCore, QtGui

from case import MODELS, GuiCase, picture, run
from driver import Boxes, cancel_bars, close_panel, process, trigger
from quadrille.document import state
from quadrille.gui import overlays, surface_view


class SurfaceBoxes(Boxes):
    """Fills the box that asks how to mesh, keeps the texts of messages."""

    def __init__(self, values, press):
        super().__init__()
        self._values, self._press = values, press
        self.asked = 0

    def _look(self):
        box = QtGui.QApplication.activeModalWidget()
        if box is None or box.findChild(QtGui.QLineEdit, "QuadrilleSurfaceSize") is None:
            super()._look()
            return
        self._timer.stop()
        self.asked += 1
        for name, value in self._values.items():
            field = box.findChild(QtGui.QWidget, f"QuadrilleSurface{name}")
            set_value = {QtGui.QComboBox: "setCurrentText", QtGui.QDoubleSpinBox: "setValue"}.get(type(field), "setText")
            getattr(field, set_value)(value)
        picture("surface_box")
        box.findChild(QtGui.QDialogButtonBox).button(self._press).click()
        self._timer.start(30)


class SurfaceTest(GuiCase):
    """Each test has a document of its own."""

    def surface(self, mesh=None):
        surface = self.document.addObject("Mesh::Feature", "Scan")
        surface.Mesh = mesh or Mesh.createBox(30.0, 20.0, 10.0)
        self.document.commitTransaction()
        self.show()
        return surface

    def meshes(self):
        return [obj for obj in self.document.Objects if state.is_surface_mesh(obj)]

    def click(self, obj, texts=None, press=QtGui.QDialogButtonBox.Ok):
        """Selects an object, triggers the command, and fills its box; gives the texts of message boxes."""
        FreeCADGui.Selection.clearSelection()
        FreeCADGui.Selection.addSelection(obj)
        with SurfaceBoxes(texts or {}, press) as boxes:
            trigger("Quadrille_Surface")
        self.assertEqual(boxes.asked, 1)
        return boxes.texts

    def test_from_a_scan_to_a_mesh_in_an_analysis(self):
        shape = Part.read(str(MODELS / "bracket.step"))
        surface = self.surface(MeshPart.meshFromShape(Shape=shape, LinearDeflection=0.05, AngularDeflection=0.2))
        analysis = ObjectsFem.makeAnalysis(self.document, "Analysis")
        FemGui.setActiveAnalysis(analysis)
        self.assertEqual(self.click(surface, {"Size": "3 mm"}), [])
        mesh, = self.meshes()
        self.assertEqual((mesh.Status, mesh.Size.Value, mesh.ElementOrder), (state.UP_TO_DATE, 3, "2nd"))
        self.assertIn(mesh, analysis.Group)
        self.assertFalse(surface.ViewObject.Visibility)
        self.show()
        picture("surface_meshed")
        trigger("Quadrille_Normals")
        self.assertTrue(overlays.is_shown(mesh, overlays.NORMALS))
        trigger("Quadrille_Normals")
        trigger("Quadrille_Quality")
        process(0.5)
        picture("surface_quality")
        close_panel()
        self.document.undo()
        self.assertEqual(self.meshes(), [])
        self.document.redo()
        mesh, = self.meshes()
        self.assertEqual((mesh.Status, mesh.FemMesh.FaceCount), (state.UP_TO_DATE, mesh.QuadCount))

    def test_meshed_again_with_other_settings_is_one_step_of_undo(self):
        self.click(self.surface(), {"Size": "4 mm"})
        mesh, = self.meshes()
        coarse = mesh.FemMesh.FaceCount
        self.assertEqual(self.click(mesh, {"Size": "2 mm", "Order": "1st", "Angle": 0}), [])
        self.assertEqual((mesh.Size.Value, mesh.ElementOrder, mesh.FeatureAngle.Value), (2, "1st", 0))
        self.assertEqual(mesh.Status, state.UP_TO_DATE)
        self.assertGreater(mesh.FemMesh.FaceCount, coarse)
        self.document.undo()
        self.assertEqual((mesh.Size.Value, mesh.FemMesh.FaceCount, mesh.Status), (4, coarse, state.UP_TO_DATE))
        mesh.Size = 5
        self.document.recompute()
        process(0.3)
        self.assertTrue(overlays.is_shown(mesh, overlays.STALE))
        picture("surface_stale")

    def test_a_double_click_asks_again(self):
        self.click(self.surface(), {"Size": "4 mm"})
        mesh, = self.meshes()
        with mock.patch.object(surface_view, "ask", return_value=None) as asked:
            mesh.ViewObject.Proxy.doubleClicked(mesh.ViewObject)
        self.assertEqual(asked.call_count, 1)
        self.assertEqual((len(self.meshes()), mesh.Size.Value), (1, 4))

    def test_export(self):
        self.click(self.surface(), {"Size": "4 mm"})
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "scan.med")
            with mock.patch("quadrille.gui.commands.ExportCommand.ask", staticmethod(lambda _: path)), Boxes() as boxes:
                trigger("Quadrille_Export")
            self.assertEqual(boxes.texts, [])
            self.assertTrue(os.path.getsize(path))

    def test_what_is_wrong_is_told_and_nothing_is_left(self):
        FreeCADGui.Selection.addSelection(self.box())
        self.assertIn("select one mesh object", self.message("Quadrille_Surface"))
        surface = self.surface()
        for texts, sentence in (({"Size": "0 mm"}, "larger than 0"), ({"Size": "many"}, "is not a length"),
                                ({"Size": "0.0001 mm"}, "take a larger Size")):
            told = self.click(surface, texts)
            self.assertEqual(len(told), 1, told)
            self.assertIn(sentence, told[0])
            self.assertEqual(self.meshes(), [])
        self.assertEqual(self.click(surface, press=QtGui.QDialogButtonBox.Cancel), [])
        self.assertEqual(self.meshes(), [])
        self.click(surface, {"Size": "4 mm"})
        self.assertIn("flip them there", self.message("Quadrille_Flip"))

    def test_cancelling_leaves_nothing(self):
        surface = self.surface(Mesh.createSphere(10.0, 200))
        QtCore.QTimer.singleShot(1800, cancel_bars)
        self.assertEqual(self.click(surface, {"Size": "0.05 mm"}), [])
        self.assertEqual(self.meshes(), [])
        self.assertEqual([obj.Name for obj in self.document.Objects], [surface.Name])


run(SurfaceTest)
