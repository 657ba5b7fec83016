"""How the panel looks: narrow and wide, in light and dark themes, while it works and when something is wrong."""

import re
import unittest.mock
from pathlib import Path

import FreeCAD
import FreeCADGui
import Part
from PySide import QtCore, QtGui

import quadrille.freecad
from case import PICTURES, GuiCase, run, type_into
from driver import close_panel, find, process, turn_wheel, wait_for, window
from quadrille.gui import stages
from quadrille.gui.task_panel import MeshPanel

CANCEL = QtGui.QDialogButtonBox.Cancel
SECTIONS = ("QuadrilleByFace", "QuadrilleRefinements", "QuadrilleMore")
DARK = {"Window": "#303030", "WindowText": "#e0e0e0", "Base": "#202020", "Text": "#e0e0e0", "Button": "#404040", "ButtonText": "#e0e0e0",
        "AlternateBase": "#282828", "Mid": "#606060", "Highlight": "#2060a0", "Light": "#505050", "Dark": "#181818"}


def dark():
    """The colors of a dark theme."""
    palette = QtGui.QPalette()
    for role, color in DARK.items():
        palette.setColor(getattr(QtGui.QPalette, role), QtGui.QColor(color))
    return palette


def dark_sheet():
    """FreeCAD's own dark style sheet: that of 0.20, or that of 1.0, whose accents have names. None in 1.1, where all colors have names."""
    sheets = [Path(FreeCAD.getResourceDir()) / "Gui" / "Stylesheets" / name for name in ("Behave-dark.qss", "FreeCAD Dark.qss")]
    text = next((sheet.read_text(encoding="utf-8") for sheet in sheets if sheet.is_file()), None)
    return re.sub(r"@ThemeAccentColor\d", "#5680c0", text) if text else None


class LookTest(GuiCase):
    """Each test has a document of its own."""

    def meshed_part(self):
        """A mesh with all that the panel can show."""
        part = self.document.addObject("Part::Feature", "Cone")
        part.Shape = Part.makeCone(10, 0.5, 6).fuse(Part.makeBox(13, 2, 4)).cut(Part.makeBox(0.05, 0.05, 4, FreeCAD.Vector(12.95, 0, 0)))
        self.show()
        return quadrille.freecad.mesh_object(part, size=2.5, order=1, size_in=["sphere:1,2,3,4=0.5"], sizes={"Face1": 0.993})

    def assert_whole(self, outside, width):
        """Nothing is cut, nor empty."""
        for widget in outside.findChildren(QtGui.QWidget):
            if not widget.isVisible() or isinstance(widget.parentWidget(), (QtGui.QAbstractItemView, QtGui.QAbstractSpinBox)):
                continue
            name = widget.objectName() or type(widget).__name__
            self.assertLessEqual(widget.mapTo(outside, QtCore.QPoint(widget.width(), 0)).x(), width, name)
            if isinstance(widget, QtGui.QTableWidget):
                self.assertLessEqual(widget.horizontalHeader().length(), widget.viewport().width(), name)
                for column in range(widget.columnCount()):
                    if widget.horizontalHeader().sectionResizeMode(column) == QtGui.QHeaderView.Stretch:
                        continue  # it wraps
                    self.assertLessEqual(widget.sizeHintForColumn(column), widget.columnWidth(column), name)
                head = widget.horizontalHeader()
                for column in range(widget.columnCount() if head.isVisible() else 0):
                    self.assertLessEqual(head.sectionSizeHint(column), head.sectionSize(column), f"{name}: title {column}")
                for row in range(widget.rowCount()):
                    for column in range(widget.columnCount()):
                        for word in widget.item(row, column).text().split():
                            self.assertLess(widget.fontMetrics().boundingRect(word).width(), widget.columnWidth(column) - 4, word)
                    self.assertLessEqual(widget.sizeHintForRow(row), widget.rowHeight(row), name)
            elif isinstance(widget, (QtGui.QListWidget, QtGui.QPlainTextEdit)):
                self.assertGreater(widget.count() if isinstance(widget, QtGui.QListWidget) else len(widget.toPlainText()), 0, name)
                self.assertEqual(widget.horizontalScrollBar().maximum(), 0, name)
            elif isinstance(widget, QtGui.QLineEdit) and widget.text().endswith(" mm"):
                room = widget.fontMetrics().boundingRect(widget.text()).width()
                self.assertGreaterEqual(widget.contentsRect().width(), room + 4, f"{name}: {widget.text()}")
            elif isinstance(widget, (QtGui.QLabel, QtGui.QAbstractButton)) and not getattr(widget, "wordWrap", lambda: False)():
                self.assertGreaterEqual(widget.width(), widget.minimumSizeHint().width(), f"{name}: {widget.text()}")

    def test_whole_at_every_width_in_every_theme(self):
        mesh = self.meshed_part()
        app = QtGui.QApplication.instance()
        light, sheet = app.palette(), app.styleSheet()
        self.addCleanup(lambda: (app.setPalette(light), app.setStyleSheet(sheet)))
        for theme, language in (("light", "English"), ("dark", "German"), ("sheet", "French")):
            if theme == "sheet" and dark_sheet() is None:
                continue
            app.setPalette(dark() if theme == "dark" else light)
            app.setStyleSheet(dark_sheet() if theme == "sheet" else sheet)
            for width in (275, 300, 400):
                FreeCADGui.setLocale(language)
                panel = MeshPanel(mesh)
                panel.element.show_element("CPS8R")
                for name in SECTIONS:
                    panel.form.findChild(QtGui.QToolButton, name).setChecked(True)
                outside = QtGui.QWidget()
                layout = QtGui.QVBoxLayout(outside)
                layout.setContentsMargins(0, 0, 0, 0)
                layout.addWidget(panel.form)
                outside.resize(width, 2100)
                outside.show()
                wait_for(panel.quality.worst.count, what="the worst elements")
                wait_for(lambda: panel.by_face.count(), what="the counts")
                panel.quality.worst.setCurrentRow(0)
                process(0.5)
                picture = outside.grab()
                if PICTURES is not None:
                    picture.save(str(PICTURES / f"look_{theme}_{width}.png"))
                try:
                    with self.subTest(theme=theme, width=width):
                        self.assert_whole(outside, width)
                        self.assertEqual(panel.quality.criteria.columnCount(), 4)
                        self.assertTrue(panel.quality.criteria.item(0, 3).text())
                        self.assert_colors(panel, theme != "light")
                finally:
                    panel.quality.release()
                    panel._leave()
                    outside.deleteLater()
                    process(0.1)
                    FreeCADGui.setLocale("English")

    def assert_colors(self, panel, is_dark):
        """Tables, histogram and the link have the colors of the theme."""
        self.assertEqual(panel.estimate.palette().color(QtGui.QPalette.WindowText).lightness() > 128, is_dark)
        histogram, table = panel.quality.histogram, panel.quality.table
        image = histogram.grab().toImage()
        self.assertEqual(image.pixelColor(image.width() // 3, 20).lightness() < 128, is_dark, "the histogram's ground")
        image = table.viewport().grab().toImage()
        self.assertEqual(image.pixelColor(image.width() - 3, 4).lightness() < 128, is_dark, "the table's ground")
        hint = panel.form.findChild(QtGui.QLabel, "QuadrilleThinHint")
        self.assertEqual(QtGui.QColor(hint.text().split("color: ")[1][:7]).lightness() > 128, is_dark, "the link")

    def test_its_ground_is_dark_under_a_dark_palette(self):
        app = QtGui.QApplication.instance()
        light = app.palette()
        self.addCleanup(lambda: app.setPalette(light))
        app.setPalette(dark())
        mesh = self.meshed_part()
        mesh.SizeIn = ["sphere:-9.351,2.142,5.25,0.857=0.2857"]
        self.edit(mesh)
        find("QuadrilleRefinements").setChecked(True)
        process(0.5)
        scrolled = find("QuadrilleScrolled")
        corner = scrolled.mapTo(window(), QtCore.QPoint(2, 2))
        picture = window().grab()
        if PICTURES is not None:
            picture.save(str(PICTURES / "look_dark_task_box.png"))
        self.assertLess(picture.toImage().pixelColor(corner).lightness(), 128)
        name, box = find("QuadrilleEntryName0"), find("QuadrilleEntry0")
        self.assertGreater(box.mapTo(window(), QtCore.QPoint(0, 0)).y(), name.mapTo(window(), QtCore.QPoint(0, 0)).y(), "one above the other")

    def test_lists_let_the_wheel_pass(self):
        mesh = self.meshed_part()
        mesh.ViewObject.Proxy.made_by = ""
        self.edit(mesh)
        for name in SECTIONS:
            find(name).setChecked(True)
        wait_for(lambda: find("QuadrilleWorst").count() and find("QuadrilleFaceCounts").count(), what="the lists")
        find("QuadrilleScrolled").setFocus()
        for name in ("QuadrilleWorst", "QuadrilleFaceCounts", "QuadrilleCriteria"):
            self.assertFalse(turn_wheel(find(name).viewport()), name)
            self.assertEqual(find(name).verticalScrollBar().value(), 0)
        find("QuadrilleWorst").setFocus()
        self.assertTrue(turn_wheel(find("QuadrilleWorst").viewport()))
        close_panel()

    def edit(self, mesh):
        """Opens the panel of a mesh."""
        FreeCADGui.activeDocument().setEdit(mesh.Name)
        process(0.2)

    def test_nothing_empty_nor_jumping_before_the_mesh(self):
        self.open_panel(self.box())
        for name in ("QuadrilleLog", "QuadrilleProgress", "QuadrilleCriteria", "QuadrilleHistogram"):
            self.assertFalse(find(name).isVisible(), name)
        place, button = find("QuadrilleByFace").mapToGlobal(QtCore.QPoint()), find("QuadrilleMesh").mapToGlobal(QtCore.QPoint())
        type_into("QuadrilleSize", "1.5 mm")
        self.assertRegex(find("QuadrilleEstimate").text(), r"\d quads( \.\.\.)?$")  # the last number stays
        self.assertEqual(find("QuadrilleByFace").mapToGlobal(QtCore.QPoint()), place)
        find("QuadrilleByFace").setChecked(True)
        type_into("QuadrilleSize", "5 kg")
        self.assertFalse(find("QuadrilleFaceCounts").isVisible())
        self.assertEqual(find("QuadrilleEstimate").text(), "–")
        self.assertIn("5 kg", find("QuadrilleSizeError").text())
        said = [label for label in window().findChildren(QtGui.QLabel) if label.isVisible() and "5 kg" in label.text()]
        self.assertEqual(len(said), 1)
        type_into("QuadrilleSize", "1.5 mm")
        stages_seen = set()
        with unittest.mock.patch("quadrille.gui.task_panel.words_of", side_effect=lambda stage: stages_seen.add(stage) or stage):
            self.press_mesh()
        self.assertLessEqual(stages_seen - {""}, set(stages.STAGES))
        self.assertEqual(stages.words_of("slide"), "moving nodes")
        self.assertEqual(find("QuadrilleMesh").mapToGlobal(QtCore.QPoint()), button)
        close_panel()

    def test_elements_have_words(self):
        mesh = self.open_panel(self.box())
        find("QuadrilleMore").setChecked(True)
        box = find("QuadrilleElementType")
        self.assertIn("S8R, with reduced integration", find("QuadrilleElementWords").text())
        box.setCurrentIndex(box.findData("CPS8R"))
        self.assertEqual(box.currentText(), "CPS8R: plane stress, eight nodes, reduced integration")
        self.assertEqual(find("QuadrilleElementWords").text(), "plane stress, eight nodes, reduced integration")
        close_panel()
        self.assertEqual(mesh.Element, "CPS8R")
        self.document.undo()


run(LookTest)
