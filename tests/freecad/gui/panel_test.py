"""The task panel in FreeCAD's window: sizes with units, OK and Cancel, undo, macros, refinements, quality.

    scripts/freecad_gui tests/freecad/gui/panel_test.py [FOLDER FOR SCREENSHOTS]
"""

import os
import sys
import tempfile
import time
from pathlib import Path
from types import SimpleNamespace
from unittest import mock
from xml.etree import ElementTree

sys.path.insert(0, str(Path(__file__).resolve().parent))

import FreeCAD
import FreeCADGui
import numpy as np
import Part
from PySide import QtCore, QtGui

import quadrille.freecad
from case import MODELS, GuiCase, picture, run, type_into
from driver import Boxes, Heartbeat, click, click_at, close_panel, find, process, trigger, turn_wheel, wait_for, window
from quadrille.core import command, quality
from quadrille.core.setting_table import SETTINGS, MeshSettings
from quadrille.document import findings, links, state
from quadrille.document.state import is_quad_mesh
from quadrille.features import mesh_object as core
from quadrille.features import sizes
from quadrille.gui import background, commands, drawn_icon, findings_table, overlays, preferences
from quadrille.gui.task_panel import MeshPanel

CANCEL = QtGui.QDialogButtonBox.Cancel


class PanelTest(GuiCase):
    """Each test has a document of its own."""

    def setUp(self):
        super().setUp()
        FreeCAD.Units.setSchema(0)

    def tearDown(self):
        FreeCAD.Units.setSchema(0)
        super().tearDown()

    def edit(self, mesh):
        """Opens the panel of a mesh object that is there."""
        FreeCADGui.activeDocument().setEdit(mesh.Name)
        process(0.2)

    def select(self, part, *names):
        """Selects elements of a part."""
        FreeCADGui.Selection.clearSelection()
        for name in names:
            FreeCADGui.Selection.addSelection(self.document.Name, part.Name, name)

    # Sizes

    def test_opening_changes_no_size(self):
        """Whatever the units: inches round to sixteenths, others to two decimals."""
        mesh = quadrille.freecad.make_mesh(self.box(), size=1.234567, size_min=0.0123456, merge_tiny=0.0004, growth=0.1234)
        region = quadrille.freecad.refine(mesh, [(self.document.Box, ("Face1",))], 0.0123457)
        values = (1.234567, 0.0123456, 0.0004, 0.1234, 0.0123457)
        for schema in (0, 2, 3, 5, 7):
            with self.subTest(schema=schema):
                FreeCAD.Units.setSchema(schema)
                steps = self.document.UndoCount
                self.edit(mesh)
                find("QuadrilleSize").setFocus()
                process(0.1)
                find("QuadrilleSizeMin").setFocus()
                process(0.1)
                close_panel()
                self.assertEqual((mesh.Size.Value, mesh.SizeMin.Value, mesh.MergeTiny.Value, mesh.Growth,
                                  float(region.CharacteristicLength)), values)
                self.assertEqual(self.document.UndoCount, steps)

    def test_every_size_takes_units(self):
        mesh = self.open_panel(self.box())
        type_into("QuadrilleSize", "1e400 mm")
        self.assertIn("is not a length", self.error_of("Size"))
        for text in ("\u0662", "\u0662 mm", "2 mm^2"):  # a two in Arabic, of which FreeCAD makes 2e-308
            type_into("QuadrilleSize", text)
            self.assertIn("is not a length", self.error_of("Size"))
        type_into("QuadrilleSize", "1e-300 mm")
        self.assertIn("too small for a part of", self.error_of("Size"))
        type_into("QuadrilleSize", "1e300 mm")
        self.assertIn("larger than the model", self.error_of("Size"))
        self.select(self.document.Box, "Face1")
        find("QuadrilleRefinements").setChecked(True)
        find("QuadrilleMore").setChecked(True)
        find("QuadrilleAddRefinement").click()
        process(0.2)
        type_into("QuadrilleSize", "1/8 in")
        type_into("QuadrilleSizeMin", "0.05 cm")
        type_into("QuadrilleSew", "1 um")
        type_into("QuadrilleMergeTiny", "0.0123456 mm")
        find("QuadrilleRefinedSize0").clear()  # as on the way to another size
        self.assertIn("'' is not a length", self.error_of("Refinements"))
        type_into("QuadrilleRefinedSize0", "1/16 in")
        close_panel()
        self.assertAlmostEqual(mesh.Size.Value, 3.175, 9)
        self.assertAlmostEqual(mesh.SizeMin.Value, 0.5, 9)
        self.assertAlmostEqual(mesh.Sew.Value, 0.001, 9)
        self.assertAlmostEqual(mesh.MergeTiny.Value, 0.0123456, 9)
        self.assertAlmostEqual(float(mesh.MeshRegionList[0].CharacteristicLength), 1.5875, 9)
        self.assertEqual(mesh.MeshRegionList[0].References, [(self.document.Box, ("Face1",))])
        FreeCAD.Units.setSchema(3)
        self.edit(mesh)
        type_into("QuadrilleSize", "0.25")  # inches now
        close_panel()
        self.assertAlmostEqual(mesh.Size.Value, 6.35, 9)

    def test_the_wheel_changes_nothing(self):
        self.open_panel(self.box())
        for name in ("QuadrilleRefinements", "QuadrilleMore"):
            find(name).setChecked(True)
        process(0.3)
        find("QuadrilleScrolled").setFocus()
        fields = [field for kind in (QtGui.QAbstractSpinBox, QtGui.QComboBox) for name in core.defaults()
                  for field in window().findChildren(kind, f"Quadrille{name}")]
        self.assertGreater(len(fields), 5)
        for field in fields:
            shown = field.currentIndex() if isinstance(field, QtGui.QComboBox) else field.value()
            for clicks in (-1, 1):
                self.assertFalse(turn_wheel(field, clicks), field.objectName())
                self.assertEqual(field.currentIndex() if isinstance(field, QtGui.QComboBox) else field.value(), shown)
        field = find("QuadrilleElementsPerCircle")
        field.setFocus()
        before = field.value()
        turn_wheel(field, 1)
        self.assertNotEqual(field.value(), before)  # a field with the focus follows the wheel

    def test_status_follows_the_fields(self):
        mesh = self.open_panel(self.box())
        type_into("QuadrilleSize", "2 mm")
        self.press_mesh()
        self.assertEqual(find("QuadrilleStatus").text(), state.UP_TO_DATE)
        type_into("QuadrilleSize", "3 mm")
        self.assertEqual(find("QuadrilleStatus").text(), state.SETTINGS_CHANGED)
        type_into("QuadrilleSize", "2 mm")
        self.assertEqual(find("QuadrilleStatus").text(), state.UP_TO_DATE)
        close_panel()
        self.assertEqual(mesh.Status, state.UP_TO_DATE)

    def test_status_names_part_and_settings(self):
        box = self.box()
        mesh = quadrille.freecad.mesh_object(box, size=2, faces=[1])
        box.Length = 12
        self.document.recompute()
        self.assertEqual(mesh.Status, state.PART_CHANGED)
        self.edit(mesh)
        self.assertEqual(find("QuadrilleStatus").text(), state.PART_CHANGED)
        type_into("QuadrilleSize", "3 mm")
        self.assertEqual(find("QuadrilleStatus").text(), state.BOTH_CHANGED)
        close_panel()
        self.assertEqual(mesh.Status, state.BOTH_CHANGED)
        mesh.Size = 2
        self.document.recompute()
        self.assertEqual(mesh.Status, state.PART_CHANGED)

    def test_the_minimum_follows_the_size(self):
        self.open_panel(self.box())
        find("QuadrilleMore").setChecked(True)
        field = find("QuadrilleSizeMin")
        for size, minimum in (("2 mm", "0.25 mm"), ("1.23456 mm", "0.1543 mm"), ("", "0.03608 mm"), ("nonsense", "")):
            type_into("QuadrilleSize", size)
            self.assertEqual(field.placeholderText(), f"{minimum} (size / 8)" if minimum else "size / 8")
            self.assertEqual(field.text(), "")
        for line in (field, find("QuadrilleFaces")):
            palette = line.palette()
            self.assertLess(palette.color(QtGui.QPalette.PlaceholderText).alpha(), palette.color(QtGui.QPalette.Text).alpha())

    # What is wrong

    def error_of(self, name):
        """What stands below a field, empty if nothing does."""
        line = find(f"Quadrille{name}Error")
        return line.text() if line.isVisible() else ""

    def test_errors_stand_below_their_fields(self):
        mesh = self.open_panel(self.box())
        find("QuadrilleMore").setChecked(True)
        type_into("QuadrilleSize", "5 kg")
        type_into("QuadrilleSew", "much")
        self.assertIn("5 kg", self.error_of("Size"))
        self.assertIn("much", self.error_of("Sew"))
        picture("errors")
        type_into("QuadrilleSew", "")
        type_into("QuadrilleSize", "300 mm")  # which can be read
        self.assertIn("larger than the model", self.error_of("Size"))
        type_into("QuadrilleSize", "2 mm")
        self.assertEqual((self.error_of("Size"), self.error_of("Sew")), ("", ""))
        faces = find("QuadrilleFaces")
        for text, unknown in (("Face1, Face7", "Face7"), ("Face1, Edge2, Fac", "Edge2, Fac"), ("Face0", "Face0"), ("Face1, Face6", "")):
            faces.setText(text)
            self.assertEqual(self.error_of("Faces"), f"Box has no {unknown}" if unknown else "")
        type_into("QuadrilleSizeMin", "5 mm")
        find("QuadrilleMore").setChecked(False)
        find("QuadrilleMesh").click()
        wait_for(lambda: find("QuadrilleMesh").isEnabled(), what="the mesher's refusal")
        process(0.2)
        line = find("QuadrilleSizeMinError")
        self.assertEqual(line.visibleRegion().boundingRect(), line.rect())  # its section is open, and scrolled there
        self.assertFalse(find("QuadrilleLog").isVisible())
        self.assertIn('"Minimum"', self.error_of("SizeMin"))
        self.assertEqual(self.error_of("Size"), "")
        type_into("QuadrilleSizeMin", "0.5 mm")
        self.assertEqual(self.error_of("SizeMin"), "")
        self.press_mesh()
        close_panel()
        self.assertEqual(links.names_in(mesh.Faces), ["Face1", "Face6"])

    def test_what_is_kept_is_named(self):
        mesh = quadrille.freecad.make_mesh(self.box(), size=2, keep=["Edge7", "Face3"])
        self.edit(mesh)
        find("QuadrilleRefinements").setChecked(True)
        self.assertEqual(find("QuadrilleEntry0").text(), "Edge7, Face3")
        close_panel()
        self.assertEqual(mesh.Keep, ["Edge7", "Face3"])
        self.edit(mesh)
        find("QuadrilleEntry0").setText("Edge7, Edge13")
        self.assertEqual(self.error_of("Entries"), "Box has no Edge13")
        find("QuadrilleEntry0").setText("Edge7, Edge12")
        self.assertEqual(self.error_of("Entries"), "")
        close_panel()
        self.assertEqual(mesh.Keep, ["Edge7", "Edge12"])

    def found(self):
        """The texts in the table of findings, by name."""
        table = find("QuadrilleFindings")
        rows = range(table.rowCount() if table.isVisible() else 0)
        return {table.item(row, 0).text(): (table.item(row, 1).text(), table.item(row, 2).text()) for row in rows}

    @staticmethod
    def click_finding(name):
        """Clicks on a row of the table of findings."""
        table = find("QuadrilleFindings")
        item = table.findItems(name, QtCore.Qt.MatchExactly)[0]
        find("QuadrilleScrolled").ensureWidgetVisible(table)
        table.scrollToItem(item)
        process(0.2)
        click(table.viewport(), QtCore.QPointF(table.visualItemRect(item).center()))

    def selected(self):
        """The names selected in the 3-D view."""
        return [name for entry in FreeCADGui.Selection.getSelectionEx(self.document.Name) for name in entry.SubElementNames]

    def test_smooth_edges_that_quads_cross_are_told_once(self):
        part = self.document.addObject("Part::Feature", "Cone")
        part.Shape = Part.read(str(MODELS / "cone.brep"))
        self.show()
        mesh = self.open_panel(part)
        self.press_mesh()
        self.assertIn("Edge2", self.found())
        self.assertNotIn("cross", find("QuadrilleLog").toPlainText())
        self.assertTrue(overlays.is_shown(mesh, overlays.CROSSED))
        picture("crossed")
        close_panel()
        self.assertFalse(overlays.is_shown(mesh, overlays.CROSSED))
        self.edit(mesh)
        told, distance = self.found()["Edge2"]  # told when the panel opens again
        self.assertEqual(told, "smooth edge that quads cross; on Face1")
        self.assertTrue(0 < float(distance) < part.Shape.BoundBox.DiagonalLength / 60, distance)
        find("QuadrilleMore").setChecked(True)
        find("QuadrilleKeepFeatures").setChecked(True)
        self.press_mesh()
        self.assertNotIn("Edge2", self.found())
        close_panel()

    def stepped(self):
        """A box with a step along one edge that is too small for its mesh."""
        part = self.document.addObject("Part::Feature", "Stepped")
        part.Shape = Part.makeBox(100, 60, 40).cut(Part.makeBox(0.1, 0.1, 40))
        self.show()
        return part

    def test_what_went_is_selected_and_kept_by_clicks(self):
        part = self.stepped()
        mesh = self.open_panel(part)
        type_into("QuadrilleSize", "5 mm")
        self.press_mesh()
        found = self.found()
        groups = {mesh.FemMesh.getGroupName(number) for number in mesh.FemMesh.Groups}
        gone = [name for name in found if name.startswith("Edge") and name not in groups and part.Shape.getElement(name).Length > 30]
        self.assertTrue(gone, found)
        self.assertIn("too small: ", found[gone[0]][0])
        self.assertGreater(float(found[gone[0]][1]), 0)
        distances = [float(entry[1]) for entry in found.values() if entry[1] and "too small" in entry[0]]
        self.assertEqual(distances, sorted(distances, reverse=True))
        self.click_finding(gone[0])
        self.assertEqual(self.selected(), [gone[0]])
        self.assertTrue(overlays.is_shown(mesh, overlays.MARKS))
        picture("finding")
        short = next(name for name in found if name.startswith("Edge") and part.Shape.getElement(name).Length < 1)
        camera = FreeCADGui.activeDocument().activeView().getCameraNode()
        self.click_finding(short)
        self.assertEqual(self.selected(), [short])
        self.assertLess(camera.height.getValue(), 20)  # it was too small to be seen
        picture("finding_zoomed")
        self.click_finding(gone[0])
        find("QuadrilleKeep").click()
        process(0.2)
        self.assertIn("to be kept", self.found()[gone[0]][0])
        wait_for(lambda: find("QuadrilleStatus").text() == state.SETTINGS_CHANGED, what="the status")
        self.press_mesh()
        self.assertEqual(mesh.Keep, [gone[0]])
        self.assertIn(gone[0], {mesh.FemMesh.getGroupName(number) for number in mesh.FemMesh.Groups})
        self.assertEqual(self.found()[gone[0]][0].partition(";")[0], "to be kept")
        picture("finding_kept")
        # What is clicked on the model is kept as well, and suppressed again.
        self.select(part, "Face1")
        find("QuadrilleKeep").click()
        self.assertEqual(self.found()["Face1"][0].partition(";")[0], "to be kept")
        self.select(part, "Face1", gone[0])
        find("QuadrilleSuppress").click()
        self.press_mesh()
        self.assertEqual(mesh.Keep, [])
        self.assertNotIn(gone[0], {mesh.FemMesh.getGroupName(number) for number in mesh.FemMesh.Groups})
        FreeCADGui.Selection.clearSelection()
        with Boxes() as boxes:
            find("QuadrilleKeep").click()
        self.assertEqual(boxes.texts, ["Select them on Stepped in the 3-D view first."])
        close_panel()
        self.assertFalse(overlays.is_shown(mesh, overlays.MARKS))
        # The command Mesh quality has the same table.
        FreeCADGui.Selection.clearSelection()
        FreeCADGui.Selection.addSelection(mesh)
        trigger("Quadrille_Quality")
        self.select(part, short, gone[0])
        find("QuadrilleKeep").click()
        self.assertEqual((mesh.Keep, mesh.Status), ([short, gone[0]], state.SETTINGS_CHANGED))
        self.select(part, short)
        find("QuadrilleSuppress").click()
        self.assertEqual(mesh.Keep, [gone[0]])
        self.document.undo()
        self.assertEqual(mesh.Keep, [short, gone[0]])
        close_panel()

    def test_what_is_not_kept_cannot_be_suppressed(self):
        part = self.document.addObject("Part::Box", "Plate")
        self.document.recompute()
        self.show()
        mesh = quadrille.freecad.mesh_object(part, size=2)
        self.edit(mesh)
        self.select(part, "Face1")
        find("QuadrilleSuppress").click()
        self.assertIn("Face1: not on the list", window().statusBar().currentMessage())
        self.assertEqual(find("QuadrilleStatus").text(), state.UP_TO_DATE)
        close_panel()

    def test_long_lists_of_findings_are_cut(self):
        small = [{"name": f"Edge{number}", "to": "Vertex1", "distance": 0.001 * number} for number in range(1, 1001)]
        poor = {"name": "Face1", "quads": 2, "shortest": 0.1, "forced": True, "cause": "short edge", "why": "it is 0.1 long"}
        text = findings.as_text({"suppressed_features": small, "poor_quads": [poor]})
        rows = findings_table.rows_of(SimpleNamespace(Findings=text))
        self.assertEqual(len(rows), findings_table.MOST_ROWS + 2)
        self.assertEqual((rows[0].names, rows[-2].text), (("Edge1000",), "800 more that do less harm"))
        self.assertEqual(rows[-1], findings_table.Row(("Face1",), "poor quads: 2; it is 0.1 long", 0.1, True))
        mesh = quadrille.freecad.mesh_object(self.box(), size=5)
        mesh.Findings = text
        self.edit(mesh)
        self.assertEqual(find("QuadrilleFindings").rowCount(), len(rows))
        find("QuadrilleFindings").selectRow(len(rows) - 2)
        self.assertEqual(self.selected(), [])
        close_panel()

    def test_keep_is_quick_in_a_long_list(self):
        kinds = ("suppressed_features", "crossed_edges")
        mesh = quadrille.freecad.mesh_object(self.box(), size=5)
        mesh.Findings = findings.as_text({kind: [{"name": f"Edge{1 + number % 12}", "to": "Vertex1", "faces": ["Face1"], "distance": 0.1}
                                                 for number in range(findings_table.MOST_ROWS)] for kind in kinds})
        self.edit(mesh)
        self.assertEqual(find("QuadrilleFindings").rowCount(), 2 * findings_table.MOST_ROWS)
        self.click_finding("Edge1")
        start = time.monotonic()
        find("QuadrilleKeep").click()
        self.assertLess(time.monotonic() - start, 1)
        self.assertIn("to be kept", self.found()["Edge1"][0])
        close_panel()

    def test_a_click_on_the_model_selects_its_row(self):
        part = self.stepped()
        mesh = self.open_panel(part)
        type_into("QuadrilleSize", "5 mm")
        self.select(part, "Face6")
        self.press_mesh()
        find("QuadrilleKeep").click()
        mesh.ViewObject.hide()
        part.ViewObject.show()
        self.show()
        find("QuadrilleFindings").clearSelection()
        face = next(name for name in (f"Face{k}" for k in range(1, 9)) if abs(part.Shape.getElement(name).CenterOfMass.z - 40) < 1e-6)
        self.select(part, face)
        find("QuadrilleKeep").click()
        FreeCADGui.Selection.clearSelection()
        find("QuadrilleFindings").clearSelection()
        click_at(FreeCAD.Vector(55, 30, 40))
        table = find("QuadrilleFindings")
        self.assertEqual([table.item(index.row(), 0).text() for index in table.selectionModel().selectedRows()], [face])
        close_panel(CANCEL)

    def test_a_click_on_a_cause_of_poor_quads_zooms_there(self):
        part = self.document.addObject("Part::Feature", "Wedge")
        corners = [FreeCAD.Vector(*point) for point in ((0, 0), (100, 0), (100, 8))]
        part.Shape = Part.Face(Part.makePolygon([*corners, corners[0]]))
        self.show()
        mesh = self.open_panel(part)
        type_into("QuadrilleSize", "4 mm")
        self.press_mesh()
        cause = next(name for name, (text, _) in self.found().items() if "poor quads" in text)

        def height():  # getCameraNode() would load what the addon needs
            return float(FreeCADGui.activeDocument().activeView().getCamera().split("height ")[1].split()[0])

        before = height()
        self.click_finding(cause)
        self.assertEqual(self.selected(), [cause])
        self.assertLess(height(), before / 2)
        self.assertTrue(overlays.is_shown(mesh, overlays.ELEMENT))
        self.assertIn(" on Face1: q ", find("QuadrilleElement").text())
        picture("cause")
        close_panel()

    def test_buttons_stay_in_sight(self):
        self.open_panel(self.bracket())
        self.press_mesh()
        for name in ("QuadrilleByFace", "QuadrilleRefinements", "QuadrilleMore"):
            find(name).setChecked(True)
        bar = find("QuadrilleScrolled").verticalScrollBar()
        wait_for(lambda: bar.maximum() > 0, what="more rows than fit")
        for height in (940, 700):
            window().resize(1500, height)
            for at_end in (False, True):
                bar.setValue(bar.maximum() if at_end else bar.minimum())
                for name in ("QuadrilleMesh", "QuadrilleStop", "QuadrilleProgress"):
                    button = find(name)
                    wait_for(lambda: button.visibleRegion().boundingRect() == button.rect(), what=f"{name} in sight at height {height}")
        picture("buttons")
        close_panel()

    def test_stale_meshes_are_meshed_again_from_the_menu(self):
        box = self.box()
        other = self.document.addObject("Part::Box", "Other")
        self.document.recompute()
        meshes = [quadrille.freecad.mesh_object(part, size=2) for part in (box, other)]
        box.Length = other.Length = 12
        self.document.recompute()
        for name, count in (("QuadrilleAgain", 1), ("QuadrilleAllAgain", 2)):
            menu = QtGui.QMenu()
            meshes[0].ViewObject.Proxy.setupContextMenu(meshes[0].ViewObject, menu)
            next(action for action in menu.actions() if action.objectName() == name).trigger()
            process(0.2)
            self.assertEqual([mesh.Status for mesh in meshes].count(state.UP_TO_DATE), count)

    def test_a_second_mesh_of_a_part_opens_the_first(self):
        box = self.box()
        mesh = self.meshed(box)
        box.ViewObject.show()
        self.assertEqual(self.open_panel(box), mesh)
        close_panel()
        self.assertEqual([obj for obj in self.document.Objects if is_quad_mesh(obj)], [mesh])

    def test_nonsense_for_a_size(self):
        self.open_panel(self.box())
        type_into("QuadrilleSize", "5 kg")
        self.assertIn("5 kg", self.error_of("Size"))
        with Boxes() as boxes:
            find("QuadrilleMesh").click()
            process(0.3)
            close_panel()
        self.assertEqual(boxes.texts, [])  # the error stands at its field, and there only
        self.assertFalse(find("QuadrilleLog").isVisible())
        self.assertIn("5 kg", self.error_of("Size"))
        self.assertTrue(FreeCADGui.Control.activeDialog())
        close_panel(CANCEL)

    def test_nothing_is_cut_off_when_narrow(self):
        mesh = self.open_panel(self.bracket())
        self.press_mesh()
        self.select(self.document.Bracket, "Face1", "Face2")
        for name in ("QuadrilleByFace", "QuadrilleRefinements", "QuadrilleMore"):
            find(name).setChecked(True)
        find("QuadrilleAddRefinement").click()
        close_panel()
        panel = MeshPanel(mesh)
        form = panel.form
        for name in ("QuadrilleByFace", "QuadrilleRefinements", "QuadrilleMore"):
            form.findChild(QtGui.QToolButton, name).setChecked(True)
        self.assertLessEqual(form.minimumSizeHint().width(), 250)
        outside = QtGui.QWidget()
        layout = QtGui.QVBoxLayout(outside)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.addWidget(form)
        outside.resize(250, 1400)
        outside.show()
        wait_for(panel.quality.worst.count, what="the worst elements")
        if os.environ.get("QUADRILLE_NARROW"):
            outside.grab().save(os.environ["QUADRILLE_NARROW"])
        for widget in outside.findChildren(QtGui.QWidget):
            if not widget.isVisible() or isinstance(widget.parentWidget(), (QtGui.QAbstractItemView, QtGui.QAbstractSpinBox)):
                continue
            with self.subTest(widget=widget.objectName() or type(widget).__name__):
                right = widget.mapTo(outside, QtCore.QPoint(widget.width(), 0)).x()
                self.assertLessEqual(right, 250)
                if isinstance(widget, QtGui.QTableWidget):
                    self.assertLessEqual(widget.horizontalHeader().length(), widget.viewport().width())
                    for column in range(widget.columnCount()):
                        if widget.horizontalHeader().sectionResizeMode(column) != QtGui.QHeaderView.Stretch:
                            self.assertLessEqual(widget.sizeHintForColumn(column), widget.columnWidth(column))
                            continue
                        for row in range(widget.rowCount()):  # texts wrap
                            self.assertLessEqual(widget.sizeHintForRow(row), widget.rowHeight(row))
                            for word in widget.item(row, column).text().split():
                                self.assertLess(widget.fontMetrics().boundingRect(word).width(), widget.columnWidth(column) - 4, word)
                if isinstance(widget, (QtGui.QLabel, QtGui.QAbstractButton)) and widget.text() and \
                        not getattr(widget, "wordWrap", lambda: False)():
                    self.assertGreaterEqual(widget.width(), widget.minimumSizeHint().width(), widget.text())
        panel.quality.release()
        panel._leave()
        outside.deleteLater()
        self.assertGreater(mesh.QuadCount, 0)

    # OK and Cancel

    def state_of(self):
        """All that Cancel must leave as it was."""
        names = sorted(obj.Name for obj in self.document.Objects)
        meshes = {obj.Name: (obj.Size.Value, obj.ElementOrder, obj.Faces, obj.FemMesh.FaceCount, obj.Status, obj.QuadCount,
                             [(region.References, float(region.CharacteristicLength)) for region in obj.MeshRegionList])
                  for obj in self.document.Objects if is_quad_mesh(obj)}
        return names, meshes, self.document.UndoCount, self.document.Box.ViewObject.Visibility

    def change_all(self):
        """Uses everything in the panel that leaves something."""
        self.select(self.document.Box, "Face1", "Face2")
        find("QuadrilleTakeSelection").click()
        find("QuadrilleAddRefinement").click()
        type_into("QuadrilleSize", "1.5 mm")
        self.press_mesh()
        type_into("QuadrilleSize", "2.5 mm")
        self.press_mesh()

    def test_cancel_of_a_new_mesh_leaves_nothing(self):
        self.box()
        before = self.state_of()
        self.open_panel(self.document.Box)
        close_panel(CANCEL)
        self.assertEqual(self.state_of(), before)
        self.open_panel(self.document.Box)
        self.change_all()
        close_panel(CANCEL)
        self.assertEqual(self.state_of(), before)
        self.assertFalse(FreeCADGui.Control.activeDialog())

    def test_cancel_of_a_mesh_that_was_there_leaves_it(self):
        mesh = quadrille.freecad.mesh_object(self.box(), size=2)
        quadrille.freecad.refine(mesh, [(self.document.Box, ("Edge1",))], 1)
        quadrille.freecad.remesh(mesh)
        self.document.recompute()
        before = self.state_of()
        self.edit(mesh)
        self.change_all()
        find("QuadrilleRefinedRemove0").click()
        self.press_mesh()
        close_panel(CANCEL)
        self.assertEqual(self.state_of(), before)
        self.document.recompute(None, True)
        self.assertEqual(self.state_of(), before)

    def test_cancel_keeps_what_else_was_done_meanwhile(self):
        mesh = quadrille.freecad.mesh_object(self.box(), size=2)
        quadrille.freecad.refine(mesh, [(self.document.Box, ("Edge1",))], 1)
        quadrille.freecad.remesh(mesh)
        before = self.state_of()
        self.edit(mesh)
        self.press_mesh()
        self.document.openTransaction("Another")
        self.document.addObject("Part::Cylinder", "Cylinder")
        self.document.commitTransaction()
        self.change_all()
        find("QuadrilleRefinedRemove0").click()
        self.press_mesh()
        close_panel(CANCEL)
        after = self.state_of()
        self.assertEqual(after[1], before[1])
        self.assertIsNotNone(self.document.getObject("Cylinder"))
        self.assertEqual(set(after[0]) - {"Cylinder"}, set(before[0]))

    def test_cancel_of_a_new_mesh_keeps_what_else_was_done(self):
        self.open_panel(self.box())
        self.press_mesh()
        self.document.openTransaction("Another")
        self.document.addObject("Part::Cylinder", "Cylinder")
        self.document.commitTransaction()
        close_panel(CANCEL)
        self.assertEqual(sorted(obj.Name for obj in self.document.Objects), ["Box", "Cylinder"])

    def test_cancel_ends_the_mesher(self):
        self.open_panel(self.box())
        type_into("QuadrilleSize", "0.008 mm")
        find("QuadrilleMesh").click()
        process(0.2)
        close_panel(CANCEL)
        self.assertEqual([obj.Name for obj in self.document.Objects], ["Box"])
        self.assertEqual(quadrille.features.mesh_object._running, {})

    def test_ok_while_meshing_goes_on(self):
        mesh = self.open_panel(self.box())
        type_into("QuadrilleSize", "0.03 mm")
        find("QuadrilleMesh").click()
        process(0.1)
        close_panel()
        self.assertFalse(FreeCADGui.Control.activeDialog())
        bar = find("QuadrilleBackground")
        self.assertTrue(bar.isVisible())
        wait_for(lambda: bar.value() > 0, what="the bar")
        picture("background")
        wait_for(lambda: not background._runs, what="the mesh")
        self.assertEqual((mesh.Status, mesh.Size.Value), ("up to date", 0.03))
        self.assertEqual(mesh.QuadCount, mesh.FemMesh.FaceCount)
        self.assertTrue(mesh.ViewObject.Visibility)
        self.assertEqual(window().findChildren(QtGui.QWidget, "QuadrilleBackground"), [])
        self.document.undo()
        self.assertEqual((mesh.FemMesh.FaceCount, mesh.Size.Value), (0, 0.03))

    def test_ok_while_the_size_is_sought_meshes(self):
        FreeCADGui.Selection.addSelection(self.box())
        trigger("Quadrille_Mesh")
        find("QuadrilleMesh").click()
        self.assertFalse(find("QuadrilleMesh").isEnabled(), "it waits for the size")
        close_panel()
        wait_for(lambda: not background._runs, what="the mesh")
        mesh = next(obj for obj in self.document.Objects if is_quad_mesh(obj))
        self.assertEqual(mesh.Status, "up to date")
        self.assertGreater(mesh.Size.Value, 0)

    def test_a_run_in_the_background_stops(self):
        mesh = self.open_panel(self.box())
        type_into("QuadrilleSize", "0.008 mm")
        find("QuadrilleMesh").click()
        close_panel()
        for seconds in (0.1, 0.5):
            process(seconds)
            self.edit(mesh)  # takes the run back
            self.assertEqual(background._runs, {})
            self.assertTrue(find("QuadrilleStop").isEnabled())
            close_panel()
        began = time.monotonic()
        find("QuadrilleBackgroundStop").click()
        wait_for(lambda: not background._runs, what="stopping")
        self.assertLess(time.monotonic() - began, 0.5)
        self.assertEqual((mesh.FemMesh.FaceCount, core._running), (0, {}))

    def test_a_run_in_the_background_ends_with_its_mesh(self):
        mesh = self.open_panel(self.box())
        type_into("QuadrilleSize", "0.008 mm")
        find("QuadrilleMesh").click()
        close_panel()
        self.document.removeObject(mesh.Name)
        self.assertEqual((background._runs, core._running), ({}, {}))

    def test_a_failure_in_the_background_is_told(self):
        mesh = self.open_panel(self.box())
        type_into("QuadrilleSize", "0.05 mm")
        find("QuadrilleMesh").click()
        close_panel()
        with Boxes() as boxes:
            core._running[self.document.Name, mesh.Name]._job._process.kill()
            wait_for(lambda: boxes.texts, what="the message")
        self.assertEqual(len(boxes.texts), 1)
        self.assertEqual((background._runs, core._running), ({}, {}))

    def test_a_mesher_stands_by(self):
        self.open_panel(self.box())
        wait_for(lambda: command._standby, what="a mesher that stands by")
        first = command._standby[1]
        self.press_mesh()
        self.assertEqual(first.wait(), 0, "it has meshed")
        wait_for(lambda: command._standby, what="the next mesher")
        second = command._standby[1]
        self.assertIsNone(second.poll())
        close_panel()
        self.assertIsNotNone(second.poll(), "nobody needs it any more")
        self.assertIsNone(command._standby)

    def test_a_mesher_that_stood_by_and_died_is_no_loss(self):
        mesh = self.open_panel(self.box())
        wait_for(lambda: command._standby, what="a mesher that stands by")
        command._standby[1].kill()
        command._standby[1].wait()  # it may take a while to die
        self.press_mesh()
        self.assertEqual(mesh.Status, "up to date")

    def test_ok_keeps_all(self):
        mesh = self.open_panel(self.box())
        self.change_all()
        type_into("QuadrilleSize", "3 mm")
        close_panel()
        self.assertEqual(mesh.Size.Value, 3)
        self.assertEqual(mesh.Faces, [(self.document.Box, ("Face1", "Face2"))])
        self.assertEqual(mesh.Status, "the settings have changed: mesh again")

    # Undo, macros, exceptions

    def test_mesh_is_one_step_of_undo(self):
        mesh = self.open_panel(self.box())
        type_into("QuadrilleSize", "1.5 mm")
        self.select(self.document.Box, "Face1")
        find("QuadrilleAddRefinement").click()
        steps = self.document.UndoCount
        self.press_mesh()
        self.assertEqual(self.document.UndoCount, steps + 1)
        quads = mesh.FemMesh.FaceCount
        close_panel()
        self.assertEqual(self.document.UndoCount, steps + 1)
        self.document.undo()
        self.assertEqual((mesh.FemMesh.FaceCount, mesh.MeshRegionList), (0, []))
        self.assertNotEqual(mesh.Size.Value, 1.5)
        self.document.redo()
        self.assertEqual((mesh.FemMesh.FaceCount, mesh.Size.Value, len(mesh.MeshRegionList)), (quads, 1.5, 1))

    def test_an_undo_shows_in_the_panel(self):
        box = self.box()
        mesh = self.open_panel(box)
        before = find("QuadrilleSize").text()
        type_into("QuadrilleSize", "1.5 mm")
        self.press_mesh()
        wait_for(lambda: find("QuadrilleWorst").isVisible(), what="the worst elements")
        self.document.undo()
        process(2)  # longer than the histogram takes to come
        self.assertFalse(find("QuadrilleWorst").isVisible())
        self.assertEqual(find("QuadrilleSize").text(), before)
        self.document.redo()
        wait_for(lambda: find("QuadrilleWorst").isVisible(), what="the worst elements")
        self.assertEqual(find("QuadrilleQualityTable").item(0, 1).text(), str(mesh.QuadCount))
        self.document.undo()
        process(0.5)
        close_panel(CANCEL)
        self.assertEqual(self.document.Objects, [box])

    def test_recorded_in_a_macro_that_replays(self):
        """With FreeCAD's own recorder."""
        box = self.box()

        def start(dialog):
            dialog.findChild(QtGui.QLineEdit, "lineEditPath").setText("recorded")
            dialog.findChild(QtGui.QPushButton, "buttonStart").click()

        with Boxes(start):
            FreeCADGui.runCommand("Std_DlgMacroRecord")
        mesh = self.open_panel(box)
        type_into("QuadrilleSize", "1.25 mm")
        self.select(box, "Face3")
        find("QuadrilleAddRefinement").click()
        type_into("QuadrilleRefinedSize0", "0.5 mm")
        self.press_mesh()
        close_panel()
        # FreeCAD 1.0 stops with the command that starts.
        stop = {"Std_MacroStopRecord", "Std_DlgMacroRecord"} & set(FreeCADGui.listCommands())
        FreeCADGui.runCommand(max(stop))
        recorded = (Path(FreeCAD.getUserMacroDir(True)) / "recorded.FCMacro").read_text()
        self.assertEqual(recorded.count("quadrille.freecad.remesh("), 1)
        quads, name = mesh.FemMesh.FaceCount, self.document.Name
        FreeCAD.closeDocument(name)
        self.document = FreeCAD.newDocument(name)
        box = self.document.addObject("Part::Box", "Box")
        self.document.recompute()
        exec(compile(recorded, "recorded", "exec"), {"App": FreeCAD, "Gui": FreeCADGui, "FreeCAD": FreeCAD,
                                                     "FreeCADGui": FreeCADGui})
        self.document.recompute()
        mesh = self.document.QuadMesh
        self.assertEqual((mesh.FemMesh.FaceCount, mesh.Size.Value, mesh.Status), (quads, 1.25, "up to date"))

    def test_transactions_end_on_every_exception(self):
        box = self.box()
        mesh = quadrille.freecad.mesh_object(box, size=2)
        for name, function in (("Quadrille_Mesh", "make_mesh"), ("Quadrille_Flip", "flip"), ("Quadrille_Refine", "refine")):
            with self.subTest(command=name):
                self.select(box, "Face1")
                if name == "Quadrille_Mesh":
                    self.select(box, "")
                steps, objects = self.document.UndoCount, len(self.document.Objects)
                with mock.patch.object(quadrille.freecad, function, side_effect=ZeroDivisionError), \
                        mock.patch.object(commands.RefineCommand, "ask", lambda *_: 1.0):
                    trigger(name)
                self.assertFalse(self.document.HasPendingTransaction)
                self.assertEqual((self.document.UndoCount, len(self.document.Objects)), (steps, objects))
        self.edit(mesh)
        with mock.patch.object(quadrille.features.mesh_object.undo, "put", side_effect=ZeroDivisionError):
            find("QuadrilleMesh").click()
            wait_for(lambda: find("QuadrilleMesh").isEnabled(), what="the end")
        self.assertFalse(self.document.HasPendingTransaction)
        self.assertEqual(quadrille.features.mesh_object._running, {})
        self.press_mesh()
        close_panel()
        self.assertEqual(mesh.Status, "up to date")

    # Refinements, several parts

    def test_refinements_are_listed_and_edited_in_place(self):
        box = self.box()
        mesh = quadrille.freecad.mesh_object(box, size=2, sizes={"Face1": 1.0, "Edge12": 0.5})
        first, second = mesh.MeshRegionList
        before = mesh.QuadCount
        self.edit(mesh)
        self.assertEqual([find(f"QuadrilleRefinedName{i}").text() for i in (0, 1)], ["Face1", "Edge12"])
        type_into("QuadrilleRefinedSize0", "0.5 mm")
        find("QuadrilleRefinedRemove1").click()
        self.press_mesh()
        picture("refinements")
        close_panel()
        self.assertEqual(float(first.CharacteristicLength), 0.5)
        self.assertEqual(mesh.MeshRegionList, [first])
        self.assertGreater(mesh.QuadCount, before)
        self.assertEqual(mesh.Status, "up to date")

    def test_the_estimate_by_face(self):
        mesh = quadrille.freecad.make_mesh(self.box(), size=2, sizes={"Face3": 0.5})
        self.edit(mesh)
        self.assertFalse(find("QuadrilleFaceCounts").isVisible())
        find("QuadrilleByFace").setChecked(True)
        rows = self.expected_rows()
        self.assertEqual(set(rows), {f"Face{number}" for number in range(1, 7)})
        self.assertEqual(next(iter(rows)), "Face3")  # the finest face is the first row
        count = sizes.CountJob(self.document.Box.Shape, MeshSettings(size=2.0, sizes={"Face3": 0.5})).start().wait()
        self.assertAlmostEqual(sum(rows.values()), count.quads, delta=len(rows))
        picture("by_face")
        FreeCADGui.Selection.clearSelection()
        counts = find("QuadrilleFaceCounts")
        counts.itemClicked.emit(counts.item(0))
        self.assertEqual(FreeCADGui.Selection.getSelectionEx()[0].SubElementNames, ("Face3",))
        find("QuadrilleTakeSelection").click()
        self.assertEqual(list(self.expected_rows()), ["Face3"])
        type_into("QuadrilleSize", "nonsense")
        self.assertEqual(self.expected_rows(), {})
        type_into("QuadrilleSize", "2 mm")
        self.press_mesh()
        self.assertAlmostEqual(mesh.QuadCount / rows["Face3"], 1, delta=0.3)
        close_panel()

    def expected_rows(self):
        """The quads to expect that the panel lists, by face."""
        estimate = find("QuadrilleEstimate")
        wait_for(lambda: not estimate.text().endswith("..."), what="the estimate")
        counts = find("QuadrilleFaceCounts")
        rows = (counts.item(row).text().split(": ") for row in range(counts.count()))
        return {name: int(quads) for name, quads in rows}

    def test_a_lost_face_is_taken_again(self):
        part = self.document.addObject("Part::Feature", "Part")
        part.Shape = Part.makeBox(20, 20, 20)
        mesh = quadrille.freecad.mesh_object(part, size=5, faces=[6])
        part.Shape = Part.makeBox(20, 20, 20).cut(Part.makeCylinder(3, 30, FreeCAD.Vector(10, 10, 0)))
        self.document.recompute()
        self.edit(mesh)
        wait_for(lambda: "Face6" in find("QuadrilleEstimateError").text(), what="the name of the face")
        self.select(part, "Face6")  # the same name, of another face: that is for the user to say
        find("QuadrilleTakeSelection").click()
        self.press_mesh()
        close_panel()
        self.assertEqual((mesh.Status, links.names_in(mesh.Faces)), ("up to date", ["Face6"]))

    def test_several_parts_in_one_go(self):
        box = self.box()
        other = self.document.addObject("Part::Box", "Other")
        other.Placement.Base = FreeCAD.Vector(10, 0, 0)
        self.document.recompute()
        before, steps = sorted(obj.Name for obj in self.document.Objects), self.document.UndoCount
        FreeCADGui.Selection.addSelection(box)
        FreeCADGui.Selection.addSelection(other)
        trigger("Quadrille_Mesh")
        mesh = next(obj for obj in self.document.Objects if is_quad_mesh(obj))
        self.press_mesh()
        self.assertEqual(len(mesh.Shape.Shape.Faces), 11)
        self.assertEqual(len(quality.measure(mesh.FemMesh).double_nodes()), 0)
        close_panel(CANCEL)
        self.assertEqual((sorted(obj.Name for obj in self.document.Objects), self.document.UndoCount), (before, steps))

    # Quality

    def test_criteria_colors_and_worst(self):
        part = self.document.addObject("Part::Feature", "Cone")
        part.Shape = Part.makeCone(10, 0.5, 6).fuse(Part.makeBox(13, 2, 4))
        self.show()
        mesh = quadrille.freecad.mesh_object(part, size=2.5, order=1)
        self.edit(mesh)
        wait_for(lambda: find("QuadrilleWorst").count(), what="the worst elements")
        table, measured = find("QuadrilleCriteria"), quality.measure(mesh.FemMesh, mesh.LeastSize)
        counts = [int(table.item(row, 1).text()) for row in range(table.rowCount())]
        self.assertEqual(counts, [int(measured.fails(name).sum()) for name in quality.CRITERIA])
        self.assertGreater(sum(counts), 0)
        find("QuadrilleColor").setChecked(True)
        measure = find("QuadrilleMeasure")
        measure.setCurrentIndex(measure.findData("warp"))
        worst = int(measured.ids[measured.criteria["warp"].argmax()])
        self.assertTrue(find("QuadrilleWorst").item(0).text().startswith(f"{worst}, Face"))
        self.assertTrue(overlays.is_shown(mesh, overlays.QUALITY))
        find("QuadrilleFree").setChecked(True)
        self.assertTrue(overlays.is_shown(mesh, overlays.FREE))
        picture("criteria")
        close_panel()
        self.assertFalse(overlays.is_shown(mesh, overlays.FREE))
        self.assertFalse(overlays.is_shown(mesh, overlays.QUALITY))

    def test_the_window_lives_while_16_000_quads_are_colored(self):
        part = self.document.addObject("Part::Plane", "Plane")
        part.Length = part.Width = 128
        self.document.recompute()
        self.show()
        mesh = quadrille.freecad.mesh_object(part, size=1)
        self.assertGreater(mesh.QuadCount, 16000)
        self.edit(mesh)
        with Heartbeat() as heart:
            find("QuadrilleColor").setChecked(True)  # before the elements are measured for the lists
            process(1)
            measure = find("QuadrilleMeasure")
            measure.setCurrentIndex(measure.findData("warp"))
            process(1)
        self.assertTrue(overlays.is_shown(mesh, overlays.QUALITY))
        self.assertLess(heart.longest, 1)
        close_panel()

    def test_an_element_is_told_and_refined(self):
        part = self.document.addObject("Part::Feature", "Wedge")
        part.Shape = Part.makeWedge(0, 0, 0, 0, 0, 20, 8, 20, 0, 20)  # two corners of 22 degrees: sharper ones are divided
        self.show()
        mesh = quadrille.freecad.mesh_object(part, size=3, order=1)
        part.ViewObject.Visibility = False  # as after Mesh
        self.edit(mesh)
        worst, told = find("QuadrilleWorst"), find("QuadrilleElement")
        wait_for(worst.count, what="the worst elements")
        self.assertFalse(told.isVisible())
        self.assertRegex(worst.item(0).text(), r"^\d+, Face\d+: q 0\.\d+, forced by Vertex\d+$")
        worst.setCurrentRow(0)
        self.assertRegex(told.text(), r"^Element \d+ on Face\d+: q 0\.\d+, aspect .*, angles .* degrees; forced by Vertex\d+$")
        view = FreeCADGui.getDocument(self.document.Name).ActiveView
        view.viewIsometric()
        view.fitAll()
        process(0.5)
        measured = quality.measure(mesh.FemMesh, mesh.LeastSize)
        facing = measured.normals @ np.array([1, -1, 1])
        candidates = np.flatnonzero(facing > facing.max() - 1e-6)
        index = int(candidates[candidates.size // 2])
        click_at(FreeCAD.Vector(*measured.centers[index]))
        self.assertTrue(told.text().startswith(f"Element {measured.ids[index]} on Face"), told.text())
        self.assertNotIn("forced", told.text())
        picture("element")
        find("QuadrilleRefinements").setChecked(False)
        find("QuadrilleRefineHere").click()
        process(0.3)
        name, box = find("QuadrilleEntryName0"), find("QuadrilleEntry0")
        self.assertTrue(name.text().startswith("Size in sphere:"))
        x, y, z, radius = map(float, name.text().split(":")[1].split(","))
        np.testing.assert_allclose((x, y, z), measured.centers[index], atol=1e-4)
        self.assertAlmostEqual(radius, 1.5 * measured.lengths[index], 4)
        self.assertAlmostEqual(float(box.text()), measured.lengths[index] / 2, 2)
        self.assertEqual((box.hasFocus(), box.selectedText()), (True, box.text()))
        self.assertEqual(box.visibleRegion().boundingRect(), box.rect())
        picture("refined_here")
        row = list(quality.CRITERIA).index("angle_min")
        table = find("QuadrilleCriteria")
        click(table.viewport(), QtCore.QPointF(table.visualItemRect(table.item(row, 0)).center()))
        self.assertEqual(find("QuadrilleMeasure").currentData(), "angle_min")
        self.assertTrue(overlays.is_shown(mesh, overlays.QUALITY))
        close_panel()
        self.assertEqual((len(mesh.SizeIn), mesh.MeshRegionList), (1, []))
        view.viewFront()
        click_at(FreeCAD.Vector(*measured.centers[index]))  # nobody listens any more

    def test_a_refinement_that_lowers_the_worst_q_says_so(self):
        part = self.document.addObject("Part::Feature", "Cube")
        part.Shape = Part.makeBox(40, 40, 40)
        mesh = quadrille.freecad.mesh_object(part, size=5, order=1)
        self.assertGreater(mesh.WorstQuality, 0.99)  # squares
        self.edit(mesh)
        wait_for(lambda: find("QuadrilleWorst").count(), what="the worst elements")
        find("QuadrilleWorst").setCurrentRow(0)
        find("QuadrilleRefineHere").click()
        self.press_mesh()
        text = f"the smallest q fell from 1.000 to {mesh.WorstQuality:.3f}"
        self.assertIn(text, window().statusBar().currentMessage())
        self.assertIn(text, find("QuadrilleLog").toPlainText())
        self.press_mesh()
        self.assertNotIn("fell", find("QuadrilleLog").toPlainText())
        close_panel()

    def test_what_is_missing_before_solving(self):
        import FemGui
        import ObjectsFem
        mesh = quadrille.freecad.mesh_object(self.box(), size=3)

        def told():
            self.edit(mesh)
            wait_for(find("QuadrilleWorst").count, what="the worst elements")
            text = find("QuadrilleReady").text() if find("QuadrilleReady").isVisible() else ""
            close_panel()
            return text

        self.assertEqual(told(), "")  # no analysis in the document
        analysis = ObjectsFem.makeAnalysis(self.document, "Analysis")
        self.assertIn("the mesh is not in an analysis", told())
        analysis.addObject(mesh)
        FemGui.setActiveAnalysis(analysis)
        text = told()
        self.assertRegex(text, "^Missing before solving: .*no material.*no shell thickness")
        self.assertNotIn("pieces", text)
        make_solver = getattr(ObjectsFem, "makeSolverCalculiXCcxTools", None) or ObjectsFem.makeSolverCalculixCcxTools
        solver = make_solver(self.document)
        for obj in (ObjectsFem.makeMaterialSolid(self.document), ObjectsFem.makeElementGeometry2D(self.document, 2), solver):
            analysis.addObject(obj)
        solver.BeamShellResultOutput3D = False
        self.assertRegex(told(), "^Missing before solving: stresses come from the middle")
        mesh.Element = "CPS8"  # has one stress through the thickness
        self.assertEqual(told(), "Nothing is missing before solving")
        self.edit(mesh)
        self.assertEqual(window().findChildren(QtGui.QWidget, "QuadrilleSurfaces"), [])
        close_panel()
        mesh.Element = "S8R"
        solver.BeamShellResultOutput3D = True
        self.assertEqual(told(), "Nothing is missing before solving")

    def test_the_histogram_needs_no_other_library(self):
        """Importing matplotlib blocks the window for seconds."""
        self.open_panel(self.box())
        self.press_mesh()
        wait_for(lambda: find("QuadrilleWorst").count(), what="the worst elements")
        self.assertNotIn("matplotlib", sys.modules)
        histogram = find("QuadrilleHistogram")
        for base in (QtCore.Qt.white, QtCore.Qt.black):
            table = find("QuadrilleCriteria")  # whose ground it has
            palette = table.palette()
            palette.setColor(QtGui.QPalette.Base, base)
            table.setPalette(palette)
            image = histogram.grab().toImage()
            colors = [image.pixelColor(x, y).name() for x in range(image.width()) for y in range(0, image.height(), 3)]
            self.assertEqual(max(set(colors), key=colors.count) if base == QtCore.Qt.black else "#000000", "#000000")
            self.assertGreater(len(set(colors)), 4)

    def test_colors_are_true_while_the_mesh_is_selected(self):
        mesh = quadrille.freecad.mesh_object(self.box(), size=2)
        self.document.Box.ViewObject.hide()
        view = FreeCADGui.activeDocument().activeView()

        def frequent_color():
            """The one that the quads of the cube, all alike, have."""
            process(0.2)
            with tempfile.TemporaryDirectory() as folder:
                path = os.path.join(folder, "view.png")
                view.saveImage(path, 200, 200, "White")
                image = QtGui.QImage(path)
            colors = [image.pixelColor(x, y).name() for x in range(0, 200, 3) for y in range(0, 200, 3)]
            return max(set(colors) - {"#ffffff", "#000000"}, key=colors.count)

        overlays.show_quality(mesh, quality.measure(mesh.FemMesh))
        self.show()
        plain = frequent_color()
        FreeCADGui.Selection.addSelection(mesh)
        self.assertEqual(frequent_color(), plain)
        overlays.show_quality(mesh, quality.measure(mesh.FemMesh), "aspect")
        overlays.hide(mesh, overlays.QUALITY)
        FreeCADGui.Selection.clearSelection()
        grey = frequent_color()
        FreeCADGui.Selection.addSelection(mesh)
        self.assertNotEqual(frequent_color(), grey)

    # Preferences, languages, commands

    def test_preferences(self):
        group = FreeCAD.ParamGet(quadrille.freecad.PREFERENCES)
        pages = []

        def look(dialog):
            pages.append(dialog.findChild(QtGui.QWidget, "QuadrillePrefCommand") is not None)

        page = preferences.PreferencesPage()
        page.loadSettings()
        self.assertIn("quadrille", page.found.text())
        with mock.patch.dict(os.environ):
            os.environ.pop("QUADRILLE_COMMAND", None)
            page.command.setText("/nowhere/quadrille")
        self.assertIn("cannot be run", page.found.text())
        page.command.setText("")
        page.suggested.setValue(1000)
        page.line_width.setValue(3)
        page.color.setChecked(True)
        page.settings["order"].show("1st")
        page.settings["elements_per_circle"].show(24.0)
        page.settings["threads"].show(1)
        page.saveSettings()
        again = preferences.PreferencesPage()
        again.loadSettings()
        self.assertEqual((again.suggested.value(), again.settings["order"].value()), (1000, "1st"))
        try:
            mesh = self.open_panel(self.box())
            self.assertEqual((mesh.ElementOrder, mesh.ElementsPerCircle, mesh.Threads), ("1st", 24.0, 1))
            self.assertTrue(700 < 600 / mesh.Size.Value**2 < 1300)
            self.assertEqual(mesh.ViewObject.LineWidth, 3)
            self.press_mesh()
            self.assertTrue(overlays.is_shown(mesh, overlays.QUALITY))
            close_panel()
            other = quadrille.freecad.make_mesh(self.document.Box)  # scripts give the same everywhere
            self.assertEqual((other.ElementOrder, other.ElementsPerCircle), ("2nd", 12.0))
        finally:
            group.Clear()
        with Boxes(look):
            FreeCADGui.runCommand("Std_DlgPreferences")
            process(1.0)
        self.assertTrue(pages and pages[0], "the page is in FreeCAD's dialog")

    def test_languages(self):
        for language, mesh_word, command_word, status, error, words in (
                ("German", "Vernetzen", "Vierecknetz aus Form", "aktuell", "größer als das Modell",
                 ("Aus Auswahl", "Größenvorschau", "Ärgste")),
                ("French", "Mailler", "Maillage de quadrangles", "à jour", "dépasse le modèle", ("Sélection", "Aperçu des tailles", "Pire"))):
            with self.subTest(language=language):
                FreeCADGui.setLocale(language)
                try:
                    process(0.3)
                    mesh = quadrille.freecad.mesh_object(self.box(), size=5)
                    self.edit(mesh)
                    self.assertEqual(find("QuadrilleMesh").text(), mesh_word)
                    self.assertEqual(find("QuadrilleStatus").text(), status)
                    self.assertEqual((find("QuadrilleTakeSelection").text(), find("QuadrillePreview").text(),
                                      find("QuadrilleCriteria").horizontalHeaderItem(2).text()), words)
                    self.assertEqual(mesh.Status, "up to date")  # for scripts, whatever the language
                    picture(f"panel_{language}")
                    type_into("QuadrilleSize", "1e300 mm")
                    self.assertIn(error, self.error_of("Size"))
                    type_into("QuadrilleSize", "2,5 mm")
                    close_panel()
                    self.assertEqual(mesh.Size.Value, 2.5)
                    action = FreeCADGui.Command.get("Quadrille_Mesh").getAction()[0]
                    self.assertEqual(action.text().replace("&", ""), command_word)
                finally:
                    FreeCADGui.setLocale("English")
                    process(0.2)

    def test_errors_are_in_the_language(self):
        for language, stopped, refused in (("German", "das Vernetzen wurde abgebrochen", "lässt sich nicht ausführen"),
                                           ("French", "le maillage a été annulé", "ne peut pas être exécuté")):
            with self.subTest(language=language):
                self.addCleanup(FreeCADGui.setLocale, "English")
                self.open_panel(self.bracket())
                FreeCADGui.setLocale(language)
                type_into("QuadrilleSize", "0,4 mm")
                find("QuadrilleMesh").click()
                find("QuadrilleStop").click()
                wait_for(lambda: find("QuadrilleMesh").isEnabled(), what="the end")
                self.assertIn(stopped, find("QuadrilleLog").toPlainText())
                with mock.patch.dict(os.environ, QUADRILLE_COMMAND="/nowhere/quadrille"), Boxes() as boxes:
                    find("QuadrilleMesh").click()
                    process(0.3)
                self.assertEqual(len(boxes.texts), 1)
                self.assertIn(refused, boxes.texts[0])
                close_panel(CANCEL)
                FreeCADGui.setLocale("English")

    def test_what_meshing_tells_is_in_the_language(self):
        self.addCleanup(FreeCADGui.setLocale, "English")
        FreeCADGui.setLocale("German")
        part = self.document.addObject("Part::Feature", "Wedge")
        part.Shape = Part.makeWedge(0, 0, 0, 0, 0, 20, 8, 20, 0, 20)
        self.show()
        self.open_panel(part)
        type_into("QuadrilleSize", "3 mm")
        self.press_mesh()
        self.assertTrue(any("schlechte Vierecke" in told for told, _ in self.found().values()), self.found())
        self.assertRegex(find("QuadrilleLog").toPlainText(), r"^vernetze\n\d+ Vierecke: [^\n]*$")
        head = find("QuadrilleFindings").horizontalHeader()
        for column in range(3):
            self.assertLessEqual(head.sectionSizeHint(column), head.sectionSize(column))
        worst = find("QuadrilleWorst")
        wait_for(worst.count, what="the worst elements")
        find("QuadrilleScrolled").ensureWidgetVisible(worst)
        click(worst.viewport(), QtCore.QPointF(worst.visualItemRect(worst.item(0)).center()))
        click(find("QuadrilleRefineHere"), QtCore.QPointF(find("QuadrilleRefineHere").rect().center()))
        self.assertTrue(find("QuadrilleEntryName0").text().startswith("Größe in sphere:"), find("QuadrilleEntryName0").text())
        close_panel()

    def test_languages_are_complete(self):
        folder = Path(quadrille.freecad.__file__).resolve().parents[1] / "translations"
        files = sorted(folder.glob("*.ts"))
        self.assertEqual([file.name for file in files], ["Quadrille_de.ts", "Quadrille_fr.ts"])
        for file in files:
            compiled = QtCore.QTranslator()
            self.assertTrue(compiled.load(str(file.with_suffix(".qm"))), f"{file.name}: scripts/translations.sh compiles it")
            for context in ElementTree.parse(file).getroot().iter("context"):
                for message in context.iter("message"):
                    translation = message.find("translation")
                    source = message.find("source").text
                    self.assertTrue(translation.text and translation.get("type") is None, f"{file.name}: {source}")
                    self.assertEqual(source.count("{}"), translation.text.count("{}"), source)
                    self.assertEqual(compiled.translate(context.find("name").text, source), translation.text,
                                     f"{file.name} has changed: scripts/translations.sh compiles it")
        for room in ("core", "document", "solvers", "features", "gui"):
            for source in (folder.parent / "quadrille" / room).glob("*.py"):
                self.assertNotRegex(source.read_text(encoding="utf-8"), r'[ (]Error\(\s*f?"', f"{source}: translate errors")
        marked = {message.find("source").text for message in ElementTree.parse(files[0]).getroot().iter("message")}
        for entry in commands.COMMANDS.values():
            self.assertLessEqual({entry.text, entry.tip}, marked)
        self.assertLessEqual(set(state.STATUSES) | set(findings_table.SENTENCES), marked)
        self.assertLessEqual({setting["label"] for setting in SETTINGS if setting["label"]}, marked)

    def test_each_command_has_icon_tip_and_shortcut(self):
        icons, shortcuts = set(), {}
        for name in FreeCADGui.listCommands():
            shortcut = FreeCADGui.Command.get(name).getShortcut()
            if shortcut:
                shortcuts.setdefault(shortcut, []).append(name)
        for name in commands.COMMANDS:
            info = FreeCADGui.Command.get(name).getInfo()
            self.assertTrue(Path(info["pixmap"]).is_file())
            icons.add(Path(info["pixmap"]).read_text())
            self.assertTrue(info["statusTip"], name)
            self.assertEqual(shortcuts[info["shortcut"]], [name])
        self.assertEqual(len(icons), len(commands.COMMANDS))

    def test_icons_differ_without_color(self):
        def gray(name):
            picture = drawn_icon(commands.COMMANDS[name].pixmap).pixmap(24, 24).toImage()
            return np.array([[QtGui.qGray(picture.pixel(x, y)) * QtGui.qAlpha(picture.pixel(x, y)) / 255 for x in range(24)]
                             for y in range(24)])

        names = sorted(commands.COMMANDS)
        pictures = {name: gray(name) for name in names}
        apart = {(one, other): np.abs(pictures[one] - pictures[other]).mean() for one in names for other in names if one < other}
        self.assertGreater(min(apart.values()), 6, min(apart, key=apart.get))  # 6.9 with Debian 13's Qt

    # Figures

    def opened_at_once(self, part):
        """Opens the panel of a new mesh, and nothing more happens."""
        FreeCADGui.Selection.clearSelection()
        FreeCADGui.Selection.addSelection(part)  # the first click
        process(0.5)
        action = FreeCADGui.Command.get("Quadrille_Mesh").getAction()[0]
        action.trigger()  # the second
        find("QuadrilleSize")

    def test_quads_are_counted_when_the_panel_is_open(self):
        part = self.bracket()
        self.opened_at_once(part)
        self.assertEqual(find("QuadrilleEstimate").text(), "...")
        find("QuadrilleSize").setProperty("rawValue", 3.25)  # the user is faster
        wait_for(lambda: "about" in find("QuadrilleEstimate").text(), what="the estimate")
        self.assertEqual(find("QuadrilleSize").property("rawValue"), 3.25)
        close_panel(CANCEL)
        suggested = quadrille.freecad.suggested_size(part)
        self.opened_at_once(part)
        self.assertEqual(find("QuadrilleEstimate").text(), "...")
        self.press_mesh()  # before its size is found
        mesh = next(obj for obj in self.document.Objects if is_quad_mesh(obj))
        self.assertEqual(mesh.Size.Value, suggested)
        close_panel()

    def test_a_number_that_cannot_be_reached_is_told(self):
        wanted = FreeCAD.ParamGet("User parameter:BaseApp/Preferences/Mod/Quadrille")
        wanted.SetInt("Elements", 100)
        self.addCleanup(wanted.RemInt, "Elements")
        mesh = self.open_panel(self.box())
        label = find("QuadrilleEstimate")
        told = label.text()
        self.assertRegex(told, r"^about \d+ quads: its 6 faces need more than 100, unless elements are larger than a tenth of the part$")
        self.press_mesh()
        self.assertLess(abs(int(told.split()[1]) / mesh.QuadCount - 1), 0.25)
        type_into("QuadrilleSize", "5 mm")
        wait_for(lambda: not label.text().endswith("..."), what="the count")
        self.assertEqual(label.text(), "about 24 quads")
        find("QuadrilleSuggest").click()
        wait_for(lambda: not label.text().endswith("..."), what="the size")
        self.assertEqual(label.text(), told)
        wanted.SetInt("Elements", 1000)
        find("QuadrilleSuggest").click()
        wait_for(lambda: not label.text().endswith("..."), what="the size")
        self.assertRegex(label.text(), r"^about \d[ \d]+ quads$")
        close_panel(CANCEL)

    def test_four_clicks_and_a_quick_panel(self):
        """The part, the command, Mesh, OK: four clicks. The panel of a part of 700 faces opens before its quads are counted."""
        plate = Part.makeBox(400, 400, 10)
        for tools in ([Part.makeCylinder(8, 6, FreeCAD.Vector(20 + 28 * i, 20 + 28 * j, 4)) for i in range(14)
                       for j in range(14)],):
            plate = plate.cut(tools)
        plate = plate.fuse([Part.makeCylinder(3, 12, FreeCAD.Vector(20 + 28 * i, 20 + 28 * j, 2)) for i in range(14)
                            for j in range(14)])
        part = self.document.addObject("Part::Feature", "Plate")
        part.Shape = plate
        self.assertGreater(len(plate.Faces), 700)
        self.show()
        self.opened_at_once(part)
        label = find("QuadrilleEstimate")
        self.assertEqual(label.text(), "...")
        wait_for(lambda: "about" in label.text(), what="the estimate")
        close_panel(CANCEL)


run(PanelTest)
