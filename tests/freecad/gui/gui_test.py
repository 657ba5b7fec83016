"""The workbench driven in FreeCAD's window: commands triggered, the panel filled, meshed, cancelled, undone, saved.

    scripts/freecad_gui tests/freecad/gui/gui_test.py [FOLDER FOR SCREENSHOTS]
"""

import os
import shutil
import sys
import tempfile
from pathlib import Path
from unittest import mock

sys.path.insert(0, str(Path(__file__).resolve().parent))

import FreeCAD
import FreeCADGui
import Fem
import ObjectsFem
import Part
from PySide import QtCore, QtGui

import hand
import quadrille.core.quality
import quadrille.freecad
from quadrille.gui import background
from case import MODELS, GuiCase, picture, run, type_size
from driver import Boxes, Heartbeat, cancel_bars, click_at, close_panel, find, process, trigger, wait_for, window
from quadrille.core.setting_table import SETTINGS
from quadrille.document.state import is_quad_mesh
from quadrille.gui import commands, overlays, solve
from quadrille.solvers import checklist, results


def fem_entries():
    """What the FEM workbench shows of the addon: the texts in its menus, and of the buttons that can be seen."""
    FreeCADGui.activateWorkbench("FemWorkbench")
    process(0.5)
    ours = {command.text for command in commands.COMMANDS.values()}
    menus = [entry.text().replace("&", "") for entry in window().menuBar().actions() if entry.isVisible()
             and entry.menu() is not None and ours <= {action.text() for action in entry.menu().actions()}]
    bars = [bar.objectName() for bar in window().findChildren(QtGui.QToolBar)
            if bar.isVisible() and ours <= {action.text() for action in bar.actions()}]
    return menus, bars


def shortcut_works():
    """Whether the menu in FEM shows each command's shortcut, and Q, M opens the panel of a selected part."""
    FreeCADGui.activateWorkbench("FemWorkbench")
    entries = window().menuBar().actions()  # they own their menus
    shown = {action.text(): action.shortcut().toString() for entry in entries if entry.menu() is not None and entry.isVisible()
             for action in entry.menu().actions()}
    named = all(shown[command.text] == command.accelerator for command in commands.COMMANDS.values())
    document = FreeCAD.newDocument("Keys")
    FreeCADGui.Selection.addSelection(document.addObject("Part::Box", "Box"))
    document.recompute()
    window().activateWindow()
    window().setFocus()
    process(0.7)  # buttons are enabled by a timer
    hand.type_text("qm")
    for _ in range(40):
        process(0.5)
        opened = bool(FreeCADGui.Control.activeDialog())
        if opened:
            break
    FreeCADGui.Control.closeDialog()
    process(0.2)
    FreeCAD.closeDocument(document.Name)
    return named, opened


#: Before the addon's own workbench was ever chosen.
AT_THE_START = fem_entries(), shortcut_works()


class GuiTest(GuiCase):
    """The way of a user, the other commands, bad use."""

    # The way of a user

    def test_from_click_to_quads(self):
        part = self.bracket()
        mesh = self.open_panel(part)
        expected = int("".join(filter(str.isdigit, find("QuadrilleEstimate").text())))
        self.assertTrue(4000 <= expected <= 6000, expected)
        self.press_mesh()
        self.assertEqual(mesh.FemMesh.FaceCount, mesh.FemMesh.QuadrangleCount)
        self.assertLess(abs(mesh.QuadCount / expected - 1), 0.25)
        self.assertEqual(mesh.Status, "up to date")
        self.assertTrue(mesh.ViewObject.Visibility)
        # Or FreeCAD compares all pairs of faces, or those near each other.
        self.assertTrue(mesh.ViewObject.ShowInner)
        self.assertGreater(mesh.ViewObject.MaxFacesShowInner, 10**9)
        self.assertFalse(part.ViewObject.Visibility)
        table = find("QuadrilleQualityTable")
        self.assertEqual(table.item(0, 1).text(), str(mesh.QuadCount))
        wait_for(lambda: find("QuadrilleWorst").count(), what="the worst elements")
        self.assertGreater(find("QuadrilleHistogram").width(), 100)
        find("QuadrilleColor").setChecked(True)
        self.assertTrue(overlays.is_shown(mesh, overlays.QUALITY))
        picture("panel_quality")
        worst = find("QuadrilleWorst")
        self.assertEqual(worst.count(), 20)
        camera = FreeCADGui.activeDocument().activeView().getCameraNode()
        before = camera.position.getValue().getValue()
        worst.setCurrentRow(0)
        self.assertNotEqual(camera.position.getValue().getValue(), before)
        self.assertTrue(overlays.is_shown(mesh, overlays.ELEMENT))
        picture("worst_element")
        close_panel()
        self.assertFalse(overlays.is_shown(mesh, overlays.QUALITY))
        self.assertFalse(FreeCADGui.Control.activeDialog())

    def test_settings_of_the_panel_reach_the_mesh(self):
        mesh = self.open_panel(self.box())
        find("QuadrilleSize").setProperty("rawValue", 2.0)
        find("QuadrilleElementOrder").setCurrentIndex(find("QuadrilleElementOrder").findData("1st"))
        wait_for(lambda: "150" in find("QuadrilleEstimate").text(), what="the count")
        self.press_mesh()
        self.assertEqual((mesh.Size.Value, mesh.ElementOrder), (2.0, "1st"))
        self.assertEqual(len(mesh.FemMesh.getElementNodes(mesh.FemMesh.Faces[0])), 4)
        find("QuadrilleSuggest").click()
        wait_for(lambda: not find("QuadrilleEstimate").text().endswith("..."), what="the size")
        self.assertTrue(4000 < 600 / find("QuadrilleSize").property("rawValue") ** 2 < 6500)
        close_panel()

    def test_panel_has_the_settings_of_the_table(self):
        mesh = self.open_panel(self.box())
        for setting in SETTINGS:
            if setting["property"]:
                self.assertIn(setting["property"], mesh.PropertiesList)
            if setting["label"]:
                self.assertIsNotNone(find(f"Quadrille{setting['property']}"), setting["name"])
        self.assertNotIn("Seed", mesh.PropertiesList)
        find("QuadrilleSize").setProperty("rawValue", 2.0)
        find("QuadrilleSew").setProperty("rawValue", 0.01)
        find("QuadrilleMergeTiny").setProperty("rawValue", 0.02)
        find("QuadrillePartial").setChecked(True)
        find("QuadrilleTimeLimit").setValue(100)
        self.press_mesh()
        self.assertEqual((mesh.Sew.Value, mesh.MergeTiny.Value, mesh.Partial, mesh.TimeLimit), (0.01, 0.02, True, 100))
        self.assertEqual(mesh.ElementOrder, "2nd")
        self.assertEqual(mesh.Status, "up to date")
        close_panel()

    def test_cancelled_while_freecad_stays_usable(self):
        mesh = self.open_panel(self.box())
        find("QuadrilleSize").setProperty("rawValue", 0.008)
        find("QuadrilleMesh").click()
        bar = [0]

        def many_events() -> bool:
            FreeCADGui.activeDocument().activeView().viewTop()
            bar.append(find("QuadrilleProgress").value())
            return len(bar) > 20 and bar[-1] >= 10

        wait_for(many_events, what="the bar")
        self.assertEqual(bar, sorted(bar), "the bar never runs backward")
        self.assertFalse(find("QuadrilleMesh").isEnabled(), "all this happened while the mesher worked")
        find("QuadrilleStop").click()
        wait_for(lambda: find("QuadrilleMesh").isEnabled(), what="cancelling")
        self.assertIn("cancelled", find("QuadrilleLog").toPlainText())
        self.assertEqual((mesh.FemMesh.FaceCount, mesh.Status), (0, "not meshed yet"))
        find("QuadrilleSize").setProperty("rawValue", 1.0)
        self.press_mesh()
        self.assertEqual(mesh.QuadCount, mesh.FemMesh.FaceCount)
        self.assertGreater(mesh.QuadCount, 0)
        close_panel()

    def test_undone_and_redone(self):
        box = self.box()
        mesh = self.open_panel(box)
        name = mesh.Name
        self.press_mesh()
        quads = mesh.FemMesh.FaceCount
        close_panel()
        self.document.undo()
        self.assertEqual(mesh.FemMesh.FaceCount, 0)
        self.document.redo()
        self.assertEqual(mesh.FemMesh.FaceCount, quads)
        while self.document.UndoCount:
            self.document.undo()
        self.assertIsNone(self.document.getObject(name))
        while self.document.RedoCount:
            self.document.redo()
        self.assertEqual(self.document.getObject(name).FemMesh.FaceCount, quads)

    def test_saved_and_reopened(self):
        mesh = self.meshed(self.bracket())
        quads, groups = mesh.FemMesh.FaceCount, mesh.FemMesh.GroupCount
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "saved.FCStd")
            self.document.saveAs(path)
            FreeCAD.closeDocument(self.document.Name)
            self.document = FreeCAD.openDocument(path)
        mesh = self.document.QuadMesh
        self.assertEqual((mesh.FemMesh.FaceCount, mesh.FemMesh.GroupCount), (quads, groups))
        self.document.recompute(None, True)
        self.assertEqual(mesh.Status, "up to date")
        self.assertTrue(mesh.ViewObject.Proxy.getIcon().endswith("quadrille_mesh.svg"))
        FreeCADGui.activeDocument().setEdit(mesh.Name)
        process(0.2)
        self.press_mesh()
        self.assertEqual(mesh.FemMesh.FaceCount, quads)
        close_panel()

    def test_stale_when_the_part_changes(self):
        box = self.box()
        mesh = self.meshed(box)
        box.Length = 12
        self.document.recompute()
        self.assertEqual(mesh.Status, "the part has changed: mesh again")
        self.assertTrue(mesh.ViewObject.Proxy.getIcon().endswith("quadrille_stale.svg"))
        self.assertTrue(overlays.is_shown(mesh, overlays.STALE))
        self.show()
        picture("stale")
        box.Length = 10
        self.document.recompute()
        self.assertEqual(mesh.Status, "up to date")
        self.assertFalse(overlays.is_shown(mesh, overlays.STALE))

    def loaded_tube(self):
        """A part with an analysis that needs only a mesh: part, analysis, solver."""
        plate = self.document.addObject("Part::Feature", "Tube")
        plate.Shape = Part.read(str(MODELS / "tube_with_hole.brep"))
        self.show()
        analysis = quadrille.freecad.make_analysis(self.document)
        solver, = results.solvers_of(analysis)
        solver.BeamShellResultOutput3D = False  # as it is at first in 0.20
        analysis.addObject(ObjectsFem.makeElementGeometry2D(self.document, 1.0, "Thickness"))
        ends = sorted((edge.CenterOfMass.z, f"Edge{i}") for i, edge in enumerate(plate.Shape.Edges, 1)
                      if edge.isClosed() and edge.BoundBox.ZLength < 1e-6)
        fixed = analysis.addObject(ObjectsFem.makeConstraintFixed(self.document, "Fixed"))[0]
        fixed.References = [(plate, ends[0][1])]
        force = analysis.addObject(ObjectsFem.makeConstraintForce(self.document, "Force"))[0]
        force.References = [(plate, ends[-1][1])]
        force.Force = "100 N" if FreeCAD.Version()[0] != "0" else 100.0
        self.document.recompute()
        return plate, analysis, solver

    def test_to_the_stresses(self):
        """What docs/freecad.md tells, step by step."""
        if not shutil.which("ccx"):
            self.skipTest("CalculiX is not installed")
        from femtools import ccxtools

        plate, analysis, solver = self.loaded_tube()
        mesh = self.open_panel(plate)
        find("QuadrilleSurfaces").setChecked(True)
        self.press_mesh()
        close_panel()
        self.assertTrue(solver.BeamShellResultOutput3D)
        self.assertIn(mesh, analysis.Group)
        with tempfile.TemporaryDirectory() as folder:
            fea = ccxtools.FemToolsCcx(analysis, solver)
            fea.update_objects()
            fea.setup_working_dir(folder, create=True)
            fea.setup_ccx()
            self.assertEqual(fea.check_prerequisites(), "")
            fea.write_inp_file()
            fea.ccx_run()
            fea.load_results()
        result = next(member for member in analysis.Group if member.isDerivedFrom("Fem::FemResultObject"))
        self.assertGreater(max(result.vonMises), 0)
        mesh.ViewObject.hide()
        result.Mesh.ViewObject.show()
        result.Mesh.ViewObject.setNodeColorByScalars(list(result.NodeNumbers), list(result.vonMises))
        self.show()

    def solve(self, script):
        """Presses Solve with another program as CalculiX, and Cancel a second later; returns the messages and the number of results."""
        def use(tools):
            tools.ccx_binary, tools.ccx_binary_present = str(program), True

        plate, analysis, _ = self.loaded_tube()
        quadrille.freecad.mesh_object(plate, size=4, analysis=analysis)
        with tempfile.TemporaryDirectory() as folder:
            program, pid = Path(folder) / "ccx", Path(folder) / "pid"
            program.write_text(f"#!/bin/sh\necho $$ >{pid}\n{script}\n")
            program.chmod(0o755)
            from femtools.ccxtools import FemToolsCcx

            with mock.patch.object(FemToolsCcx, "setup_ccx", use), Boxes() as boxes, Heartbeat() as heart:
                QtCore.QTimer.singleShot(1000, cancel_bars)
                trigger("Quadrille_Solve")
            self.assertLess(heart.longest, 1)
            with self.assertRaises(ProcessLookupError):
                os.kill(int(pid.read_text()), 0)
        return boxes.texts, sum(obj.isDerivedFrom("Fem::FemResultObject") for obj in analysis.Group)

    def test_solving_stops(self):
        self.assertEqual(self.solve("exec sleep 3000"), ([], 0))

    def test_a_solver_that_fails_is_told(self):
        (text,), results = self.solve("echo '*ERROR in gauss: singular'; exit 201")
        self.assertIn("*ERROR in gauss: singular", text)
        self.assertEqual(results, 0)

    def test_solves_with_the_other_solver_object(self):
        """That of FreeCAD's framework; from 1.1 on, that which gives pipelines in its own panel."""
        if not shutil.which("ccx"):
            self.skipTest("CalculiX is not installed")
        plate, analysis, solver = self.loaded_tube()
        self.document.removeObject(solver.Name)
        make = getattr(ObjectsFem, "makeSolverCalculiX", None) or ObjectsFem.makeSolverCalculix
        solver = analysis.addObject(make(self.document))[0]
        solver.BeamShellResultOutput3D = True
        mesh = quadrille.freecad.mesh_object(plate, size=4, analysis=analysis)
        for _ in range(2):  # the second replaces the first
            solve.solve(mesh)
            result, = (obj for obj in analysis.Group if obj.isDerivedFrom("Fem::FemResultObject"))
            self.assertGreater(max(result.vonMises), 0)

    def test_without_calculix(self):
        plate, analysis, _ = self.loaded_tube()
        quadrille.freecad.mesh_object(plate, size=4, analysis=analysis)
        with mock.patch.dict(os.environ, PATH=""), Boxes() as boxes:
            trigger("Quadrille_Solve")
        self.assertIn("CalculiX is not installed", boxes.texts[-1])

    # In the FEM workbench

    def test_fem_has_the_commands_from_the_start(self):
        entries, keys = (["Mesh"], ["QuadrilleInFem"]), (True, True)
        self.assertEqual(AT_THE_START, (entries, keys))
        self.assertEqual((fem_entries(), shortcut_works()), (entries, keys))  # where FreeCAD has made its own actions
        box = self.box()
        FreeCADGui.Selection.addSelection(box)
        bar = window().findChild(QtGui.QToolBar, "QuadrilleInFem")
        self.assertEqual([action.text() for action in bar.actions() if action.icon().pixmap(24, 24).isNull()], [])
        button = next(action for action in bar.actions() if action.text() == "Quad mesh from shape")
        wait_for(button.isEnabled, what="the button")
        button.trigger()
        process(0.3)
        self.assertTrue(FreeCADGui.Control.activeDialog())
        self.assertFalse(find("QuadrilleMesh").icon().pixmap(16, 16).isNull())
        wait_for(lambda: not button.isEnabled(), what="the button while a panel is open")
        close_panel()
        FreeCADGui.activateWorkbench("PartWorkbench")
        process(0.2)
        self.assertFalse(bar.isVisible())

    def test_context_menu_of_a_mesh(self):
        mesh = self.meshed(self.box())
        menu = QtGui.QMenu()
        mesh.ViewObject.Proxy.setupContextMenu(mesh.ViewObject, menu)
        next(action for action in menu.actions() if action.text() == "Show shell normals").trigger()
        self.assertTrue(overlays.is_shown(mesh, overlays.NORMALS))

    def test_seen_from_both_sides(self):
        view = self.meshed(self.box()).ViewObject
        self.assertEqual((view.BackfaceCulling, view.LineWidth), (False, 2.0))

    # Picked on a Body

    def body(self):
        """A plate with a round pocket through it, made in PartDesign, in its container's own place."""
        body = self.document.addObject("PartDesign::Body", "Body")
        attachment = "Support" if hasattr(body.newObject("Sketcher::SketchObject", "Outline"), "Support") else \
            "AttachmentSupport"
        outline = self.document.Outline
        setattr(outline, attachment, (body.Origin.OriginFeatures[3], [""]))
        outline.MapMode = "FlatFace"
        corners = [(0, 0), (20, 0), (20, 10), (0, 10)]
        for a, b in zip(corners, corners[1:] + corners[:1]):
            outline.addGeometry(Part.LineSegment(FreeCAD.Vector(*a, 0), FreeCAD.Vector(*b, 0)))
        pad = body.newObject("PartDesign::Pad", "Pad")
        pad.Profile, pad.Length = outline, 5
        self.document.recompute()
        top = max(range(len(pad.Shape.Faces)), key=lambda i: pad.Shape.Faces[i].CenterOfMass.z)
        circle = body.newObject("Sketcher::SketchObject", "Circle")
        setattr(circle, attachment, (pad, [f"Face{top + 1}"]))
        circle.MapMode = "FlatFace"
        circle.addGeometry(Part.Circle(FreeCAD.Vector(10, 5, 0), FreeCAD.Vector(0, 0, 1), 2))
        pocket = body.newObject("PartDesign::Pocket", "Pocket")
        pocket.Profile, pocket.Type = circle, 1
        body.Placement.Base = FreeCAD.Vector(7, -3, 1)
        self.document.recompute()
        self.show()
        return body, pocket

    def select(self, body, *names):
        FreeCADGui.Selection.clearSelection()
        for name in names:
            FreeCADGui.Selection.addSelection(self.document.Name, body.Name, name)

    def test_a_click_on_a_body_meshes_the_body(self):
        body, pocket = self.body()
        FreeCADGui.Selection.clearSelection()
        FreeCADGui.Selection.addSelection(self.document.Name, body.Name, "Pocket.Face2")
        with Boxes() as boxes:
            trigger("Quadrille_Mesh")
        self.assertEqual(boxes.texts, [])
        mesh = next(obj for obj in self.document.Objects if is_quad_mesh(obj))
        self.assertEqual(mesh.Shape, body)
        self.press_mesh()
        self.select(body, "Pocket.Face3", "Pocket.Face5")
        find("QuadrilleTakeSelection").click()
        self.assertEqual(find("QuadrilleFaces").text(), "Face3, Face5")
        find("QuadrilleFaces").setText("")
        close_panel()
        pocket.Type, pocket.Length = 0, 2  # no more through all
        self.document.recompute()
        self.assertIn("changed", mesh.Status)

    def test_a_body_in_a_container_is_meshed_alone(self):
        container = self.document.addObject("App::Part", "Container")
        body = self.document.addObject("PartDesign::Body", "Body")
        container.addObject(body)
        other = self.document.addObject("Part::Box", "Other")
        other.Placement.Base.x = 30
        container.addObject(other)
        block = body.newObject("PartDesign::AdditiveBox", "Block")
        block.Length = block.Width = block.Height = 10
        self.document.recompute()
        self.show()
        click_at(FreeCAD.Vector(5, 5, 10))
        with Boxes() as boxes:
            trigger("Quadrille_Mesh")
        self.assertEqual(boxes.texts, [])
        mesh = next(obj for obj in self.document.Objects if is_quad_mesh(obj))
        self.assertEqual(mesh.Shape, body)
        close_panel()

    def container(self):
        """A container, moved, of two boxes that touch, and of a third one that is hidden."""
        container = self.document.addObject("App::Part", "Container")
        container.Placement.Base = FreeCAD.Vector(0, 0, 50)
        for number in range(3):
            box = self.document.addObject("Part::Box", f"Solid{number}")
            box.Placement.Base.x = 10 * number
            container.addObject(box)
        box.ViewObject.hide()
        self.document.recompute()
        self.show()
        return container

    def mesh_of(self, answer=None):
        """Triggers the command for the selection; the mesh object, and the questions that were asked."""
        asked = []
        with mock.patch.object(commands.MeshCommand, "ask", staticmethod(lambda text: asked.append(text) or answer)):
            with Boxes() as boxes:
                trigger("Quadrille_Mesh")
        self.assertEqual(boxes.texts, [])
        return [obj for obj in self.document.Objects if is_quad_mesh(obj)][-1], asked

    def test_touching_solids_of_a_container_are_joined(self):
        container = self.container()
        compound = self.document.addObject("Part::Compound", "Compound")
        compound.Links = [self.document.addObject("Part::Box", f"Box{number}") for number in range(2)]
        compound.Links[1].Placement.Base.x = 10
        self.document.recompute()
        for part, is_hidden in ((container, True), (compound, False)):
            for answer, pieces in ((True, 1), (False, 2)):
                with self.subTest(part=part.Name, answer=answer):
                    FreeCADGui.Selection.clearSelection()
                    FreeCADGui.Selection.addSelection(part)
                    mesh, asked = self.mesh_of(answer)
                    self.assertEqual(len(asked), 1)
                    self.assertIn(f"{part.Label} has 2 solids that touch", asked[0])
                    self.assertEqual("not meshed: Solid2" in asked[0], is_hidden)
                    self.press_mesh()
                    self.assertEqual(checklist.pieces(mesh.FemMesh), pieces)
                    # A group for each object: joined boxes share the face between them.
                    groups = {mesh.FemMesh.getGroupName(i): set(mesh.FemMesh.getGroupElements(i)) for i in mesh.FemMesh.Groups}
                    labels = [child.Label for child in (part.Group if part == container else part.Links)][:2]
                    one, other = (groups[f"{label}_Faces"] for label in labels)
                    self.assertEqual(len(one), len(other))
                    self.assertEqual(bool(one & other), answer)
                    self.assertFalse(quadrille.document.groups.refresh(mesh), "they stay when constraints change")
                    close_panel(QtGui.QDialogButtonBox.Cancel)
        container.Group[-2].Placement.Base.x = 15
        self.document.recompute()
        FreeCADGui.Selection.clearSelection()
        FreeCADGui.Selection.addSelection(container)
        self.assertEqual(self.mesh_of()[1], [])
        self.assertIn("not meshed: Solid2", window().statusBar().currentMessage())
        close_panel(QtGui.QDialogButtonBox.Cancel)

    def test_solids_of_a_container_stay_in_its_scope(self):
        container = self.container()
        report = next(view for view in window().findChildren(QtGui.QTextEdit) if "ReportOutput" in view.metaObject().className())
        report.clear()
        for name in ("Solid0.", "Solid1."):
            FreeCADGui.Selection.addSelection(self.document.Name, "Container", name)
        mesh, asked = self.mesh_of()
        self.assertEqual(asked, [])
        self.press_mesh()
        close_panel()
        self.document.recompute()
        process(0.5)
        self.assertNotIn("scope", report.toPlainText())
        self.assertIn(mesh.Shape, container.Group)
        self.assertEqual(checklist.pieces(mesh.FemMesh), 1)

    def test_a_click_on_the_mesh_means_the_part(self):
        box = self.box()
        mesh = self.open_panel(box)
        find("QuadrilleSize").setText("2 mm")
        self.press_mesh()
        self.assertFalse(box.ViewObject.Visibility)
        self.show()
        find("QuadrilleRefinements").setChecked(True)
        # The second click on a face selects the whole mesh in FreeCAD.
        for point, name in (((5.3, 5.4, 10), "Face6"), ((3.2, 3.1, 10), "Face6"), ((10, 5, 5), "Face2"), ((10, 5, 10), "Edge6"),
                            ((10, 0, 10), "Vertex5")):
            click_at(FreeCAD.Vector(*point))
            find("QuadrilleAddRefinement").click()
            row = len(window().findChildren(QtGui.QLineEdit, QtCore.QRegularExpression("^QuadrilleRefinedName")))
            self.assertEqual(find(f"QuadrilleRefinedName{row - 1}").text(), name)
        find("QuadrilleShowOther").click()
        self.assertEqual((box.ViewObject.Visibility, mesh.ViewObject.Visibility), (True, False))
        find("QuadrilleShowOther").click()
        self.assertEqual((box.ViewObject.Visibility, mesh.ViewObject.Visibility), (False, True))
        close_panel()

    def test_every_face_of_a_body_is_known(self):
        body, _ = self.body()
        mesh = quadrille.freecad.mesh_object(body, size=2)
        for count in (1, 2):
            for index in range(1, len(body.Shape.Faces) + 1):
                self.select(body, f"Pocket.Face{index}")
                with Boxes(lambda dialog: type_size(dialog, 1.0)) as boxes:
                    trigger("Quadrille_Refine")
                self.assertEqual(boxes.texts, [])
                self.assertEqual(mesh.MeshRegionList[-1].References, [(body, (f"Face{index}",))])
            self.assertEqual(len(mesh.MeshRegionList), count * len(body.Shape.Faces))
            body.touch()
            body.Tip.touch()
            self.document.recompute()
        self.select(body, "Pocket.Face1")
        with Boxes() as boxes:
            trigger("Quadrille_Flip")
        self.assertEqual(boxes.texts, [])
        self.assertEqual(mesh.FlippedFaces, [(body, ("Face1",))])
        self.select(body, "Pocket.Edge1")
        self.assertIn("face", self.message("Quadrille_Flip"))

    def test_loads_on_a_feature_of_a_body_get_groups(self):
        body, pocket = self.body()
        analysis = ObjectsFem.makeAnalysis(self.document, "Analysis")
        fixed = analysis.addObject(ObjectsFem.makeConstraintFixed(self.document, "Fixed"))[0]
        fixed.References = [(pocket, "Face2")]
        mesh = quadrille.freecad.mesh_object(body, size=2, analysis=analysis)
        self.assertGreater(len(self.group(mesh, "Fixed_Nodes")), 4)

    def test_a_load_on_a_face_left_out_is_refused(self):
        box = self.box()
        analysis = ObjectsFem.makeAnalysis(self.document, "Analysis")
        load = analysis.addObject(ObjectsFem.makeConstraintPressure(self.document, "Load"))[0]
        load.References = [(box, "Face2")]
        mesh = quadrille.freecad.mesh_object(box, size=2, analysis=analysis, faces=["Face1"])
        self.assertIn("Load is on Face2", quadrille.freecad.complaint(mesh))
        load.References = [(box, "Face1")]
        self.assertEqual(quadrille.freecad.complaint(mesh), "")

    # Changes meanwhile

    def test_a_part_changed_while_meshing_makes_the_mesh_stale(self):
        box = self.box()
        mesh = self.open_panel(box)
        find("QuadrilleSize").setProperty("rawValue", 0.05)
        find("QuadrilleMesh").click()
        box.Length = 12
        self.document.recompute()
        wait_for(lambda: find("QuadrilleMesh").isEnabled(), what="meshing")
        self.assertGreater(mesh.FemMesh.FaceCount, 0)
        self.assertEqual(mesh.Status, "the part has changed: mesh again")
        close_panel()

    def test_a_part_equal_but_for_rounding_gives_the_same_mesh(self):
        part = self.bracket()
        mesh = self.meshed(part)
        points = mesh.FemMesh.Nodes
        shape = part.Shape.copy()
        shape.translate(FreeCAD.Vector(1.1e-14, 0, 0))
        shape.rotate(FreeCAD.Vector(0, 0, 0), FreeCAD.Vector(0, 0, 1), 1e-13)
        part.Shape = shape
        self.document.recompute()
        self.assertEqual(mesh.Status, "up to date")
        with tempfile.TemporaryDirectory() as folder:
            quadrille.freecad.export(mesh, os.path.join(folder, "out.inp"))
        quadrille.freecad.remesh(mesh)
        self.assertEqual(mesh.FemMesh.Nodes, points)

    def test_a_result_of_the_middle_says_so(self):
        box = self.box()
        analysis = ObjectsFem.makeAnalysis(self.document, "Analysis")
        make_solver = getattr(ObjectsFem, "makeSolverCalculiXCcxTools", None) or ObjectsFem.makeSolverCalculixCcxTools
        solver = analysis.addObject(make_solver(self.document, "CalculiX"))[0]
        quadrille.freecad.mesh_object(box, size=5, analysis=analysis)
        with mock.patch("FreeCAD.Console.PrintWarning") as told:
            for flat in (True, False):
                solver.BeamShellResultOutput3D = not flat
                analysis.addObject(ObjectsFem.makeResultMechanical(self.document, f"Result{flat}"))
        warnings = [call.args[0] for call in told.call_args_list if "middle of the shell" in call.args[0]]
        self.assertEqual(len(warnings), 1, warnings)
        self.assertIn("ResultTrue", warnings[0])

    # The other commands

    def test_refine(self):
        mesh = self.meshed(self.box())
        face_quads = len(self.group(mesh, "Face1"))
        FreeCADGui.Selection.clearSelection()
        FreeCADGui.Selection.addSelection(self.document.Name, "Box", "Face1")
        with Boxes(lambda dialog: type_size(dialog, mesh.Size.Value / 3)) as boxes:
            trigger("Quadrille_Refine")
        self.assertEqual(boxes.texts, [])
        self.assertEqual(len(mesh.MeshRegionList), 1)
        self.assertIn("changed", mesh.Status)
        FreeCADGui.activeDocument().setEdit(mesh.Name)
        process(0.2)
        self.press_mesh()
        close_panel()
        self.assertGreater(len(self.group(mesh, "Face1")), 5 * face_quads)
        self.assertIn(mesh.MeshRegionList[0], mesh.ViewObject.Proxy.claimChildren())

    @staticmethod
    def group(mesh, name):
        """The elements of a group."""
        for number in mesh.FemMesh.Groups:
            if mesh.FemMesh.getGroupName(number) == name:
                return mesh.FemMesh.getGroupElements(number)
        return ()

    def test_quality_panel(self):
        mesh = self.meshed(self.bracket())
        trigger("Quadrille_Quality")
        self.assertTrue(overlays.is_shown(mesh, overlays.QUALITY))
        self.assertEqual(find("QuadrilleQualityTable").item(0, 1).text(), str(mesh.QuadCount))
        close_panel()
        self.assertFalse(overlays.is_shown(mesh, overlays.QUALITY))

    def test_normals_shown_and_flipped(self):
        mesh = self.meshed(self.bracket())
        trigger("Quadrille_Normals")
        self.assertTrue(overlays.is_shown(mesh, overlays.NORMALS))
        self.show()
        picture("normals")
        before = quadrille.core.quality.measure(mesh.FemMesh)
        FreeCADGui.Selection.clearSelection()
        trigger("Quadrille_Flip")
        self.assertEqual(len(mesh.FlippedFaces[0][1]), len(mesh.Shape.Shape.Faces))
        after = quadrille.core.quality.measure(mesh.FemMesh)
        self.assertEqual(len(before.ids), len(after.ids))
        trigger("Quadrille_Normals")
        self.assertFalse(overlays.is_shown(mesh, overlays.NORMALS))

    def test_export(self):
        mesh = self.meshed(self.box())
        with tempfile.TemporaryDirectory() as folder:
            for suffix in ("inp", "msh", "unv", "med", "vtu", "bdf"):
                path = os.path.join(folder, f"mesh.{suffix}")
                asked = commands.ExportCommand.ask
                commands.ExportCommand.ask = staticmethod(lambda _mesh, path=path: path)
                try:
                    with Boxes() as boxes:
                        trigger("Quadrille_Export")
                finally:
                    commands.ExportCommand.ask = asked
                self.assertEqual(boxes.texts, [])
                self.assertGreater(os.path.getsize(path), 1000)
            self.assertEqual(Fem.read(os.path.join(folder, "mesh.unv")).FaceCount, mesh.QuadCount)

    def test_commands_are_in_the_fem_workbench(self):
        FreeCADGui.activateWorkbench("FemWorkbench")
        process(0.5)
        ours = FreeCADGui.Command.get("Quadrille_Mesh").getAction()[0]
        found = []
        for entry in window().menuBar().actions():
            menu = entry.menu()
            if menu is not None:
                found += [action.text() for action in menu.actions()]
        self.assertIn(ours.text(), found)

    # Bad use: one clear message, the document unharmed

    def test_nothing_selected(self):
        box = self.box()
        names = ("Quadrille_Mesh", "Quadrille_Middle", "Quadrille_Surface", "Quadrille_Refine")

        def enabled(wanted):
            process(0.5)  # FreeCAD updates what is enabled by a timer
            return all(FreeCADGui.Command.get(name).getAction()[0].isEnabled() == wanted for name in names)

        FreeCADGui.Selection.clearSelection()
        wait_for(lambda: enabled(False), 20, "gray buttons")
        FreeCADGui.Selection.addSelection(box)
        wait_for(lambda: enabled(True), 20, "buttons")

    def test_the_toolbar_in_fem_is_the_last(self):
        def bars():
            process(0.5)
            return [bar.objectName() for bar in sorted((bar for bar in window().findChildren(QtGui.QToolBar) if bar.isVisible()),
                                                       key=lambda bar: (bar.y(), bar.x()))]

        for workbench, ours in (("FemWorkbench", "QuadrilleInFem"), ("PartWorkbench", ""), ("QuadrilleWorkbench", "Quadrille"),
                                ("FemWorkbench", "QuadrilleInFem")):
            FreeCADGui.activateWorkbench(workbench)
            found = bars()
            self.assertEqual([name for name in found if "Quadrille" in name], [ours] if ours else [], workbench)
            if ours:
                self.assertEqual(found[-1], ours, workbench)
        picture("toolbar_in_fem")

    def test_a_part_without_faces(self):
        line = self.document.addObject("Part::Feature", "Line")
        line.Shape = Part.makeLine((0, 0, 0), (1, 0, 0))
        FreeCADGui.Selection.addSelection(line)
        self.assertIn("no faces", self.message("Quadrille_Mesh"))

    def test_no_mesh_yet(self):
        self.box()
        self.assertIn("no quad mesh", self.message("Quadrille_Quality"))
        self.assertIn("no quad mesh", self.message("Quadrille_Normals"))
        self.assertIn("no quad mesh", self.message("Quadrille_Export"))

    def test_an_analysis_with_a_mesh_already(self):
        import FemGui

        box = self.box()
        analysis = ObjectsFem.makeAnalysis(self.document, "Analysis")
        FemGui.setActiveAnalysis(analysis)
        mesh = self.meshed(box)
        self.assertIn(mesh, analysis.Group)
        other = self.document.addObject("Part::Box", "Other")
        self.document.recompute()
        FreeCADGui.Selection.clearSelection()
        FreeCADGui.Selection.addSelection(other)
        self.assertIn("one mesh only", self.message("Quadrille_Mesh"))

    def test_the_part_is_deleted(self):
        box = self.box()
        mesh = self.meshed(box)
        quads = mesh.FemMesh.FaceCount
        self.document.removeObject(box.Name)
        self.document.recompute()
        self.assertEqual((mesh.Status, mesh.FemMesh.FaceCount), ("the part is gone", quads))
        with Boxes() as boxes:
            FreeCADGui.activeDocument().setEdit(mesh.Name)
            process(0.2)
        self.assertIn("gone", boxes.texts[0])

    def test_a_child_that_is_killed(self):
        mesh = self.open_panel(self.box())
        find("QuadrilleSize").setProperty("rawValue", 0.008)
        with Boxes() as boxes:
            find("QuadrilleMesh").click()
            process(0.3)
            job = quadrille.features.mesh_object._running[(self.document.Name, mesh.Name)]
            job._job._process.kill()
            wait_for(lambda: find("QuadrilleMesh").isEnabled(), what="the end")
        self.assertEqual(len(boxes.texts), 1)
        self.assertIn("killed by signal 9", boxes.texts[0])
        self.assertEqual(mesh.FemMesh.FaceCount, 0)
        close_panel()

    def test_an_invalid_part(self):
        bow = self.document.addObject("Part::Feature", "Bow")
        bow.Shape = Part.Face(Part.makePolygon([(0, 0, 0), (10, 0, 0), (0, 10, 0), (10, 10, 0), (0, 0, 0)]))
        self.assertFalse(bow.Shape.isValid())
        before = self.document.UndoCount
        mesh = self.open_panel(bow)
        name = mesh.Name
        find("QuadrilleSize").setProperty("rawValue", 1.0)
        with Boxes() as boxes:
            find("QuadrilleMesh").click()
            wait_for(lambda: boxes.texts, what="the message")
        self.assertEqual(len(boxes.texts), 1)
        self.assertIn("Face1", boxes.texts[0])
        self.assertEqual((mesh.FemMesh.FaceCount, mesh.Status), (0, "not meshed yet"))
        close_panel()
        while self.document.UndoCount > before:
            self.document.undo()
        self.assertIsNone(self.document.getObject(name))
        self.assertEqual(bow.Shape.Edges[0].Length, 10)

    def test_a_failure_leaves_the_mesh_and_undo(self):
        mesh = self.meshed(self.box())
        quads, size, steps = mesh.FemMesh.FaceCount, mesh.Size.Value, self.document.UndoCount
        FreeCADGui.activeDocument().setEdit(mesh.Name)
        process(0.2)
        find("QuadrilleSize").setProperty("rawValue", 500.0)
        find("QuadrilleMesh").click()
        wait_for(lambda: find("QuadrilleMesh").isEnabled() and find("QuadrilleSizeError").isVisible(), what="the message")
        self.assertEqual(mesh.FemMesh.FaceCount, quads)
        close_panel()
        self.assertEqual(mesh.Status, "the settings have changed: mesh again")
        self.assertEqual(self.document.UndoCount, steps + 1)  # the size that was set; nothing of the failure
        self.document.undo()
        self.document.recompute()
        self.assertEqual((mesh.Size.Value, mesh.FemMesh.FaceCount, mesh.Status), (size, quads, "up to date"))

    def test_meshing_while_meshing(self):
        mesh = self.open_panel(self.box())
        find("QuadrilleSize").setProperty("rawValue", 0.008)
        find("QuadrilleMesh").click()
        process(0.2)
        with self.assertRaises(quadrille.Error) as caught:
            quadrille.freecad.remesh(mesh)
        self.assertIn("already", str(caught.exception))
        close_panel()
        find("QuadrilleBackgroundStop").click()
        wait_for(lambda: not background._runs, what="stopping")
        self.assertEqual(quadrille.features.mesh_object._running, {})

    def test_the_document_is_closed_while_meshing(self):
        mesh = self.open_panel(self.box())
        find("QuadrilleSize").setProperty("rawValue", 0.008)
        find("QuadrilleMesh").click()
        process(0.3)
        process_of_mesher = quadrille.features.mesh_object._running[(self.document.Name, mesh.Name)]._job._process
        FreeCAD.closeDocument(self.document.Name)
        process(0.5)
        self.assertIsNotNone(process_of_mesher.poll())
        self.assertFalse(FreeCADGui.Control.activeDialog())
        self.assertEqual(quadrille.features.mesh_object._running, {})

    def test_the_mesh_object_is_undone_while_meshing(self):
        mesh = self.open_panel(self.box())
        name = mesh.Name
        find("QuadrilleSize").setProperty("rawValue", 0.008)
        find("QuadrilleMesh").click()
        process(0.3)
        self.document.removeObject(name)
        process(0.5)
        self.assertFalse(FreeCADGui.Control.activeDialog())
        self.assertEqual(quadrille.features.mesh_object._running, {})

    def test_the_mesher_refuses(self):
        mesh = self.open_panel(self.box())
        find("QuadrilleSize").setProperty("rawValue", 500.0)
        find("QuadrilleMesh").click()
        wait_for(lambda: find("QuadrilleMesh").isEnabled() and find("QuadrilleSizeError").isVisible(), what="the message")
        self.assertIn("larger than the model", find("QuadrilleSizeError").text())
        self.assertEqual(mesh.FemMesh.FaceCount, 0)
        close_panel()


run(GuiTest)
