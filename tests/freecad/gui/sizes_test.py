"""Sizes on the part in FreeCAD's window, before it is meshed, and meshes that follow their results.

    scripts/freecad_gui tests/freecad/gui/sizes_test.py [FOLDER FOR SCREENSHOTS]
"""

import shutil
import sys
import tempfile
import unittest
from pathlib import Path
from unittest import mock

sys.path.insert(0, str(Path(__file__).resolve().parent))
sys.path.append(str(Path(__file__).resolve().parents[3] / "examples" / "freecad"))

import FreeCAD
import FreeCADGui
import numpy as np
import Part
from PySide import QtCore, QtGui

import quadrille.freecad
from case import GuiCase, picture, run, type_into
from driver import Boxes, close_panel, find, process, trigger, wait_for
from quadrille.document import state
from quadrille.features import sizes
from quadrille.gui import size_preview
from quadrille.solvers import results

CANCEL = QtGui.QDialogButtonBox.Cancel


def count_shown():
    """The number of elements to expect, as the panel tells it."""
    return int(find("QuadrilleEstimate").text().replace("about", "").replace("quads", "").replace(" ", ""))


class SizesTest(GuiCase):
    """Each test has a document of its own."""

    def open_and_show(self, part):
        """The panel with sizes shown; the mesh object."""
        mesh = self.open_panel(part)
        find("QuadrillePreview").click()
        self.wait()
        return mesh

    @staticmethod
    def wait():
        """Until the sizes are those of the settings."""
        preview = find("QuadrillePreview").parentWidget()
        wait_for(lambda: not preview.busy, what="the sizes")
        process(0.1)

    @staticmethod
    def drawn():
        """What is drawn over the part: triangles, lines and colors; None where nothing is."""
        from pivy import coin

        search = coin.SoSearchAction()
        search.setType(coin.SoIndexedFaceSet.getClassTypeId())
        search.setInterest(coin.SoSearchAction.ALL)
        search.apply(FreeCADGui.activeDocument().activeView().getSceneGraph())
        for path in search.getPaths():
            siblings = path.getNodeFromTail(1)
            kinds = [node.getTypeId().getName().getString() for node in siblings.getChildren()]
            if "PolygonOffset" in kinds and "IndexedLineSet" in kinds:
                faces, colors = path.getTail(), siblings.getChild(kinds.index("Material"))
                return faces.coordIndex.getNum() // 4, np.array([list(value) for value in colors.diffuseColor.getValues()])
        return None

    def test_colors_count_and_who_rules(self):
        part = self.bracket()
        self.open_and_show(part)
        self.assertIn("on 100 % of the area", find("QuadrillePreviewText").text())
        few = count_shown()
        count, colors = self.drawn()
        self.assertGreater(count, 1000)
        self.assertFalse(part.ViewObject.Visibility)
        picture("sizes")
        # A refinement: dark there, and the count grows at once.
        FreeCADGui.Selection.addSelection(part, "Face3")
        find("QuadrilleRefinements").setChecked(True)
        find("QuadrilleAddRefinement").click()
        self.wait()
        self.assertIn("size-on", find("QuadrillePreviewText").text())
        refined = self.drawn()[1]
        self.assertLess(refined.sum(axis=1).min(), 0.8)  # the dark end
        self.assertGreater((refined.sum(axis=1) < 1).sum(), (colors.sum(axis=1) < 1).sum())
        type_into("QuadrilleRefinedSize0", "0.3 mm")
        self.wait()
        self.assertIn("dark 0.3 mm", find("QuadrillePreviewText").text())
        self.assertGreater(count_shown(), 4 * few)
        picture("sizes_refined")
        find("QuadrillePreview").click()
        process(0.2)
        self.assertIsNone(self.drawn())
        self.assertTrue(part.ViewObject.Visibility)
        close_panel(CANCEL)

    def test_bends_show_the_size_across(self):
        part = self.document.addObject("Part::Feature", "Angle")
        box = Part.makeBox(60, 20, 20)
        part.Shape = box.makeFillet(1, [box.Edges[11]])
        self.show()
        mesh = self.open_and_show(part)
        text = find("QuadrillePreviewText").text()
        self.assertIn("bends: size across them", text)
        found = sizes.start(mesh).wait()
        on_bend = found.sizes < 0.9 * found.along
        self.assertTrue(on_bend.any() and not on_bend.all())
        close_panel(CANCEL)

    def test_the_count_is_near_the_mesh(self):
        mesh = self.open_and_show(self.bracket())
        expected = count_shown()
        self.press_mesh()
        self.assertIsNone(self.drawn())  # the mesh is shown in their place
        self.assertTrue(mesh.ViewObject.Visibility)
        self.assertLess(abs(expected / mesh.QuadCount - 1), 0.3)
        close_panel()

    def test_every_refinement_is_listed_with_its_size(self):
        mesh = quadrille.freecad.make_mesh(self.box(), size=2, size_in=["sphere:0,0,0,3=0.5"], segments={"Edge4": 20})
        quadrille.freecad.refine(mesh, [(self.document.Box, ("Face1",))], 1.0)
        FreeCADGui.activeDocument().setEdit(mesh.Name)
        process(0.2)
        self.assertEqual([find(f"QuadrilleEntry{i}").text() for i in range(2)], ["0.5", "20"])
        self.assertEqual(find("QuadrilleRefinedSize0").text(), "1.00 mm")
        find("QuadrilleEntry0").setText("0.25")
        find("QuadrilleEntryRemove1").click()
        process(0.1)
        find("QuadrillePreview").click()
        self.wait()
        self.assertIn("dark 0.25 mm", find("QuadrillePreviewText").text())
        picture("sizes_listed")
        find("QuadrilleEntry0").clear()
        self.wait()
        self.assertIn("give its numbers", find("QuadrilleEntriesError").text())
        find("QuadrilleEntry0").setText("0.2,5")
        close_panel()
        self.assertEqual((mesh.SizeIn, mesh.Segments), (["sphere:0,0,0,3=0.2,5"], []))

    def test_selected_edges_are_divided(self):
        box = self.box()
        mesh = self.open_panel(box)
        find("QuadrilleSize").setProperty("rawValue", 2.0)
        with Boxes() as boxes:
            find("QuadrilleDivide").click()  # nothing is selected
        self.assertIn("Select them on", boxes.texts[0])
        for name in ("Edge4", "Edge2", "Face1"):
            FreeCADGui.Selection.addSelection(self.document.Name, box.Name, name)
        find("QuadrilleDivide").click()
        self.assertEqual([find(f"QuadrilleEntry{i}").text() for i in range(2)], ["5", "5"])
        find("QuadrilleEntry0").setText("13")
        find("QuadrilleDivide").click()  # once more: in place of what was there
        self.assertEqual([find(f"QuadrilleEntry{i}").text() for i in range(2)], ["5", "5"])
        for number in range(2):
            find(f"QuadrilleEntry{number}").setText("13")
        with Boxes() as boxes:
            self.press_mesh()
        self.assertEqual(boxes.texts, [])
        close_panel()
        self.assertEqual(sorted(mesh.Segments), ["Edge2=13", "Edge4=13"])
        fem_mesh = mesh.FemMesh
        counts = {fem_mesh.getGroupName(i): len(fem_mesh.getGroupElements(i)) for i in fem_mesh.Groups
                  if fem_mesh.getGroupElementType(i) == "Edge"}
        self.assertEqual((counts["Edge2"], counts["Edge4"]), (13, 13))

    def test_nodes_at_selected_points(self):
        box = self.box()
        point = self.document.addObject("Part::Vertex", "Load")
        size = box.Shape.BoundBox
        point.X, point.Y, point.Z = size.XMin + 3.3, size.YMin + 4.1, size.ZMax
        self.document.recompute()
        mesh = self.open_panel(box)
        find("QuadrilleSize").setProperty("rawValue", 2.0)
        with Boxes() as boxes:
            find("QuadrillePlace").click()  # nothing is selected
        self.assertIn("Select vertices or points", boxes.texts[0])
        FreeCADGui.Selection.addSelection(self.document.Name, box.Name, "Vertex2")
        FreeCADGui.Selection.addSelection(self.document.Name, point.Name)
        find("QuadrillePlace").click()
        with Boxes() as boxes:
            self.press_mesh()
        self.assertEqual(boxes.texts, [])
        close_panel()
        self.assertEqual([entry.split("=")[0] for entry in mesh.NodesAt], ["Node1", "Load"])
        fem_mesh = mesh.FemMesh
        groups = {fem_mesh.getGroupName(i): fem_mesh.getGroupElements(i) for i in fem_mesh.Groups}
        for name, wanted in (("Node1", box.Shape.getElement("Vertex2").Point), ("Load", point.Shape.Vertexes[0].Point)):
            node, = groups[name]
            self.assertLess((fem_mesh.getNodeById(node) - wanted).Length, 1e-9)

    def test_errors_are_a_sentence(self):
        self.open_and_show(self.box())
        type_into("QuadrilleSize", "5 kg")
        self.wait()
        self.assertEqual(find("QuadrillePreviewText").text(), "")
        self.assertIn("not a length", find("QuadrilleSizeError").text())
        self.assertIsNone(self.drawn())
        type_into("QuadrilleSize", "2 mm")
        self.wait()
        self.assertEqual(count_shown(), 150)
        with mock.patch.object(sizes.SizesJob, "result", side_effect=quadrille.freecad.Error("no luck")):
            type_into("QuadrilleSize", "3 mm")
            self.wait()
        self.assertEqual(find("QuadrillePreviewText").text(), "no luck")
        self.assertIsNone(self.drawn())
        close_panel(CANCEL)

    def test_the_window_stays_alive(self):
        """Other events come in while the child works, and between the pieces that are drawn."""
        self.open_panel(self.bracket())
        beats = {"child": 0, "drawing": 0}
        widget = find("QuadrillePreview").parentWidget()
        timer = QtCore.QTimer()
        timer.timeout.connect(lambda: beats.update(
            child=beats["child"] + (widget._job is not None), drawing=beats["drawing"] + (widget._drawing is not None)))
        timer.start(1)
        with mock.patch.object(size_preview, "_PIECE", 500):
            find("QuadrillePreview").click()
            self.wait()
        timer.stop()
        self.assertGreater(beats["child"], 5)
        self.assertGreater(beats["drawing"], 5)

    def solved(self):
        """A plate that was solved; its mesh and analysis."""
        import adapt_loop
        import parameter_study

        part, drill = parameter_study.make_part(self.document)
        drill.Radius = 8
        self.document.recompute()
        analysis, _, _, fixed, force = parameter_study.make_analysis(self.document, part)
        fixed.References = [(part, parameter_study.edge_at(part.Shape, 0.0))]
        force.References = [(part, parameter_study.edge_at(part.Shape, parameter_study.LENGTH))]
        for solver in results.solvers_of(analysis):
            setattr(solver, results.SURFACE_RESULTS, True)
        mesh = quadrille.freecad.mesh_object(part, size=10, analysis=analysis)
        with tempfile.TemporaryDirectory() as folder:
            adapt_loop.solve(analysis, folder)
        self.show()
        return mesh, analysis

    @unittest.skipUnless(shutil.which("ccx"), "CalculiX is not installed")
    def test_one_command_adapts(self):
        mesh, _ = self.solved()
        quads, size, steps = mesh.QuadCount, mesh.Size.Value, self.document.UndoCount
        with mock.patch.object(QtGui.QInputDialog, "getDouble", return_value=(2.0, True)):
            with Boxes() as boxes:
                trigger("Quadrille_Adapt")
        self.assertEqual(len(boxes.texts), 1, boxes.texts)
        self.assertIn(f"now there are {mesh.QuadCount} quads: solve again", boxes.texts[0])
        self.assertTrue(mesh.ViewObject.Visibility)
        self.assertFalse(mesh.Shape.ViewObject.Visibility)
        self.assertGreater(mesh.QuadCount, 2 * quads)
        self.assertEqual(mesh.Status, state.UP_TO_DATE)
        self.assertEqual(self.document.UndoCount, steps + 1)
        adapted = mesh.QuadCount
        self.document.undo()
        process(0.2)
        self.assertEqual((mesh.QuadCount, mesh.Size.Value, mesh.FollowResults), (quads, size, False))
        self.document.redo()
        process(0.2)
        self.assertEqual((mesh.QuadCount, mesh.FollowResults, mesh.Status), (adapted, True, state.UP_TO_DATE))
        # The panel lists where the sizes come from, and takes them away.
        FreeCADGui.activeDocument().setEdit(mesh.Name)
        process(0.2)
        find("QuadrillePreview").click()
        self.wait()
        self.assertIn("size-field", find("QuadrillePreviewText").text())
        picture("sizes_adapted")
        find("QuadrilleFollows").click()
        self.wait()
        self.assertNotIn("size-field", find("QuadrillePreviewText").text())
        close_panel()
        self.assertFalse(mesh.FollowResults)

    def test_without_a_result_one_sentence(self):
        self.meshed(self.box())
        with mock.patch.object(QtGui.QInputDialog, "getDouble", return_value=(2.0, True)):
            with Boxes() as boxes:
                trigger("Quadrille_Adapt")
        self.assertTrue(any("is not in an analysis" in text for text in boxes.texts), boxes.texts)
        with mock.patch.object(QtGui.QInputDialog, "getDouble", return_value=(2.0, False)):
            trigger("Quadrille_Adapt")

    def test_closing_ends_the_work(self):
        part = self.bracket()
        self.open_panel(part)
        begin, started = sizes.SizesJob.start, []
        with mock.patch.object(sizes.SizesJob, "start", autospec=True, side_effect=lambda job: (started.append(job), begin(job))[1]):
            type_into("QuadrilleSize", "0.2 mm")
            find("QuadrillePreview").click()
            # Those of the preview and of the panel.
            wait_for(lambda: {type(job) for job in started} == {sizes.SizesJob, sizes.CountJob}, what="both jobs")
        close_panel(CANCEL)
        self.assertFalse(any(job.running for job in started))
        self.assertTrue(part.ViewObject.Visibility)

    def test_a_closed_document_ends_the_work(self):
        self.open_panel(self.bracket())
        type_into("QuadrilleSize", "0.2 mm")  # takes longer than the wait below
        find("QuadrillePreview").click()
        process(0.05)
        FreeCAD.closeDocument(self.document.Name)
        process(0.5)
        self.assertFalse(FreeCADGui.Control.activeDialog())


if __name__ == "__main__":
    run(SizesTest)
