# SPDX-License-Identifier: GPL-3.0-or-later
"""The commands of the workbench. What a click does runs through FreeCADGui.doCommand, so that macros record it."""

from pathlib import Path
from typing import Optional

import FreeCAD
import FreeCADGui
from PySide import QtGui

import quadrille_commands

from ..core.errors import Error
from ..core.jobs import find_mesher
from ..core.setting_table import ORDERS, TABLES, default_size
from ..core.units import digits
from ..document import containers, picks, regions
from ..document.groups import analysis_of
from ..document.state import is_quad_mesh, is_surface_mesh, part_of, source_of
from ..features import adaption, middle, surfaces
from ..features import mesh_object as core
from ..features import views as features_views
from . import (QT_TRANSLATE_NOOP, do, icon, links_text, mesh_clicks, middle_search, overlays, path_of, preferences,
               progress_bar, tell, tell_briefly, transaction, translate, views)
from .fem_workbench import FEM
from .length_field import LengthField
from .mesh_clicks import picked

TOOLBAR = ["Quadrille_Middle", "Quadrille_Mesh", "Quadrille_Solve", "Quadrille_Surface", "Quadrille_Refine", "Quadrille_Quality",
           "Quadrille_Normals", "Quadrille_Flip", "Quadrille_Adapt", "Quadrille_Export"]
#: The file formats that the mesher writes, for the file dialog, which shows the first.
FORMATS = {row["name"]: row["ending"][1:] for row in sorted(TABLES["formats"], key=lambda row: bool(row["ending"] != ".inp"))
           if row["written"]}


def mesh_in_question(with_surfaces: bool = False):
    """The selected quad mesh, or the one whose part is selected, or the only one in the document. with_surfaces: includes
    those made of triangle meshes."""
    document = FreeCAD.ActiveDocument
    if document is None:
        raise Error(translate("Quadrille", "open a document first"), "usage")
    meshes = [obj for obj in document.Objects if is_quad_mesh(obj) or with_surfaces and is_surface_mesh(obj)]
    if not meshes:
        raise Error(translate("Quadrille", "the document has no quad mesh: select a part and use Quad mesh from shape first"),
                    "usage")
    selected = picks.parts_of(picked(document))
    for candidates in ([mesh for mesh in meshes if mesh in selected],
                       [mesh for mesh in meshes if source_of(mesh) in selected], meshes):
        if len(candidates) == 1:
            return candidates[0]
    raise Error(translate("Quadrille", "the document has several quad meshes: select one of them"), "usage")


def _meshed_in_question():
    mesh = mesh_in_question(with_surfaces=True)
    if not mesh.FemMesh.FaceCount:
        raise Error(translate("Quadrille", "{}: is not meshed yet: double-click it and press Mesh").format(mesh.Label), "usage",
                    mesh.Name)
    return mesh


def active_analysis(document):
    """The active analysis if it is in this document, else None."""
    try:
        import FemGui
    except ImportError:
        return None
    analysis = FemGui.getActiveAnalysis()
    return analysis if analysis is not None and analysis.Document == document else None


def _one_part(parts: list):
    """The part, or several parts as one: their boolean fragments, joined where they touch."""
    if len(parts) == 1:
        return parts[0]
    do("import quadrille.freecad")
    do(f"quadrille.freecad.fragments([{', '.join(map(path_of, parts))}])")
    return parts[0].Document.Objects[-1]


def _arguments(values: dict, analysis) -> str:
    """The text after the first argument of a call that a macro records."""
    into = f", analysis={path_of(analysis)}" if analysis is not None else ""
    return "".join(f", {name}={value!r}" for name, value in values.items()) + into


class _Command:
    """A command. run() does the work. An Error becomes one message. After any exception, the transaction is rolled back."""

    name = text = tip = pixmap = accelerator = ""
    step = ""  #: name of the undo step; empty = none
    selects = False  #: whether it needs a selection

    def GetResources(self) -> dict:
        """FreeCAD asks for text and icon, and translates the texts by the command's name."""
        return {"MenuText": self.text, "ToolTip": self.tip, "StatusTip": self.tip, "Pixmap": icon(self.pixmap),
                "Accel": self.accelerator}

    def IsActive(self) -> bool:
        """True if a document is open, and no task panel; and something is selected, if the command needs that."""
        return FreeCAD.ActiveDocument is not None and not FreeCADGui.Control.activeDialog() and (
            not self.selects or bool(FreeCADGui.Selection.getSelection()))

    def Activated(self, _index: int = 0) -> None:
        """FreeCAD calls this when the command is clicked."""
        document = FreeCAD.ActiveDocument
        if document is None:
            tell(translate("Quadrille", "Open a document first."))
            return
        try:
            if self.step:
                with transaction(document, self.step):
                    self.run()
            else:
                self.run()
        except Error as error:
            if error.kind != "cancelled":
                tell(str(error))
            return
        self.afterwards()

    def run(self) -> None:
        """The work, inside the transaction."""

    def afterwards(self) -> None:
        """What follows outside the transaction."""


def _only_middle() -> list:
    """The middle surface of the document, in a list; an empty list if there are none or several, or if it has a mesh."""
    objects = FreeCAD.ActiveDocument.Objects
    found = [obj for obj in objects if middle.is_middle(obj)]
    return found if len(found) == 1 and not any(is_quad_mesh(obj) for obj in objects) else []


class MeshCommand(_Command):
    """Quad mesh from shape."""

    name = "Quadrille_Mesh"
    text = QT_TRANSLATE_NOOP("Quadrille_Mesh", "Quad mesh from shape")
    tip = QT_TRANSLATE_NOOP("Quadrille_Mesh", "Mesh the selected part with quads; several parts are joined where they touch")
    pixmap = "quadrille_mesh"
    accelerator = "Q, M"
    step = "Create quad mesh"

    def IsActive(self) -> bool:
        """Also without a selection, where there is one middle surface to mesh."""
        return super().IsActive() and bool(FreeCADGui.Selection.getSelection() or _only_middle())

    def run(self) -> None:
        document = FreeCAD.ActiveDocument
        selected = picks.parts_of(picked(document)) or _only_middle()
        if not selected:
            raise Error(translate("Quadrille", "select one part to mesh, or several"), "usage")
        self._edit, self._made = None, False
        if len(selected) == 1 and is_quad_mesh(selected[0]):
            self._edit = selected[0]
            return
        analysis = active_analysis(document)
        there = [obj for obj in document.Objects if len(selected) == 1 and is_quad_mesh(obj) and obj.Shape == selected[0]
                 and (analysis is None or analysis_of(obj) in (None, analysis))]
        if there:
            self._edit = there[-1]
            return
        for part in selected:
            core.check_part(part, analysis)
        find_mesher()
        do("import quadrille.freecad")
        settings = dict(preferences.settings())
        if len(selected) == 1 and self._joins(selected[0]):
            settings["imprint"] = True
        part = _one_part(selected)
        # The mesh object's panel finds a size.
        do(f"quadrille.freecad.make_mesh({path_of(part)}{_arguments(settings, analysis)})")
        self._edit, self._made = [obj for obj in document.Objects if is_quad_mesh(obj)][-1], True

    def _joins(self, part) -> bool:
        """Asks whether to join the solids of a container or compound where they touch. Tells which ones in it are hidden."""
        hidden = ", ".join(obj.Label for obj in containers.hidden_solids(part))
        told = translate("Quadrille", "Hidden in it, and not meshed: {}").format(hidden) if hidden else ""
        touching = containers.touching_solids(part.Shape)
        if touching:
            question = translate("Quadrille", "{} has {} solids that touch or cross. Join them there (Imprint), so that they share "
                                 "nodes?").format(part.Label, touching)
            return self.ask("\n\n".join(filter(None, (question, told))))
        if told:
            text = f"{part.Label}: {told}"
            FreeCAD.Console.PrintWarning(text + "\n")
            tell_briefly(text)
        return False

    #: Asks a yes-or-no question in a message box.
    ask = staticmethod(middle_search.ask)

    def afterwards(self) -> None:
        if self._edit is None:
            return
        if self._made:
            self._edit.ViewObject.Proxy.made_by = self.step
        FreeCADGui.getDocument(self._edit.Document.Name).setEdit(self._edit.Name)


class SolveCommand(_Command):
    """Solves with CalculiX."""

    name = "Quadrille_Solve"
    text = QT_TRANSLATE_NOOP("Quadrille_Solve", "Solve")
    tip = QT_TRANSLATE_NOOP("Quadrille_Solve", "Solve the analysis of a quad mesh with CalculiX, and show the stresses")
    pixmap = "quadrille_solve"
    accelerator = "Q, V"
    step = "Solve"

    def IsActive(self) -> bool:
        """Also while a mesh's panel is open, which needs no OK then."""
        return FreeCAD.ActiveDocument is not None and (self._panel() is not None or super().IsActive())

    def Activated(self, _index: int = 0) -> None:
        """FreeCAD calls this when the command is clicked. What an open panel did is kept."""
        panel = self._panel()
        if panel is not None:
            if not panel.accept():
                return
            FreeCADGui.Selection.clearSelection()
            FreeCADGui.Selection.addSelection(panel.mesh)
        super().Activated()

    @staticmethod
    def _panel():
        """The panel of a mesh, if it is open."""
        edited = FreeCADGui.ActiveDocument.getInEdit()
        return getattr(getattr(edited, "Proxy", None), "panel", None)

    def run(self) -> None:
        self._mesh = path_of(_meshed_in_question())
        do("import quadrille.gui.solve")
        do(f"quadrille.gui.solve.solve({self._mesh})")

    def afterwards(self) -> None:
        do(f"quadrille.gui.solve.show({self._mesh})")


class MiddleCommand(_Command):
    """Middle surface."""

    name = "Quadrille_Middle"
    text = QT_TRANSLATE_NOOP("Quadrille_Middle", "Middle surface")
    tip = QT_TRANSLATE_NOOP(
        "Quadrille_Middle", "Turn a thin part into the surface in its middle, with its thickness in the active analysis; several "
        "parts are joined where they touch")
    pixmap = "quadrille_middle"
    accelerator = "Q, I"
    step = "Create middle surface"
    selects = True

    def run(self) -> None:
        document = FreeCAD.ActiveDocument
        selected = picks.parts_of(picked(document))
        if not selected:
            raise Error(translate("Quadrille", "select one thin part, or several that touch"), "usage")
        options = {"join": True} if len(selected) > 1 else {}
        part = _one_part(selected)
        middle_search.find(part, options, self.ask)
        analysis = active_analysis(document) or self._new_analysis(document)
        if analysis is not None:
            loads = middle.referring_to(part, analysis)
            if loads and self.ask(translate("Quadrille", "{} are on {}. Move them to its middle surface?").format(
                    ", ".join(member.Label for member in loads), part.Label)):
                options["move_loads"] = True
        do("import quadrille.middle")
        do(f"quadrille.middle.make_middle({path_of(part)}{_arguments(options, analysis)})")
        made = [obj for obj in document.Objects if middle.is_middle(obj)][-1]
        FreeCADGui.Selection.clearSelection()
        FreeCADGui.Selection.addSelection(made)

    def _new_analysis(self, document):
        """In the FEM workbench, offers an analysis where there is none. None if the user does not want one."""
        if FreeCADGui.activeWorkbench().name() != FEM or any(obj.isDerivedFrom("Fem::FemAnalysis") for obj in document.Objects) \
                or not self.ask(translate("Quadrille", "There is no analysis. Make one, with CalculiX as its solver, stresses at the "
                                          "surfaces, and steel as its material (to be changed in the tree)?")):
            return None
        do("import quadrille.freecad")
        do(f"quadrille.freecad.make_analysis(App.getDocument({document.Name!r}))")
        return active_analysis(document)

    #: Asks a yes-or-no question in a message box.
    ask = staticmethod(middle_search.ask)


class SurfaceCommand(_Command):
    """Quad mesh from a triangle mesh, such as a scan or an STL file."""

    name = "Quadrille_Surface"
    text = QT_TRANSLATE_NOOP("Quadrille_Surface", "Quad mesh from mesh")
    tip = QT_TRANSLATE_NOOP("Quadrille_Surface", "Remesh the selected mesh object, such as a scan or an STL file, with quads")
    pixmap = "quadrille_surface"
    accelerator = "Q, S"
    step = "Create quad mesh from mesh"
    selects = True

    def run(self) -> None:
        document = FreeCAD.ActiveDocument
        chosen = list(dict.fromkeys(found for found in map(_mesh_picked, picked(document)) if found is not None))
        if len(chosen) != 1:
            raise Error(translate("Quadrille", "select one mesh object, such as an STL file that was imported"), "usage")
        if is_surface_mesh(chosen[0]):
            self._again(chosen[0])
            return
        surface, analysis = chosen[0], active_analysis(document)
        surfaces.check_surface(surface, analysis)
        find_mesher()
        asked = self._asked(surface, surfaces.Asked(size=surfaces.usual_size(surface)))
        if asked is not None:
            do("import quadrille.freecad")
            do(f"quadrille.freecad.mesh_surface({path_of(surface)}{_arguments(asked._asdict(), analysis)})")

    def _again(self, mesh) -> None:
        """Meshes again, with other settings."""
        if mesh.Surface is None:
            raise Error(translate("Quadrille", "{}: the mesh object that it meshes is gone").format(mesh.Label), "usage", mesh.Name)
        surfaces.check_surface(mesh.Surface)
        asked = self._asked(mesh.Surface, surfaces.asked_of(mesh))
        if asked is None:
            return
        do("import quadrille.freecad")
        for name, value in (("Size", asked.size), ("ElementOrder", ORDERS[asked.order - 1]),
                            ("FeatureAngle", asked.feature_angle), ("MergeDistance", asked.merge)):
            do(f"{path_of(mesh)}.{name} = {value!r}")
        do(f"quadrille.freecad.remesh({path_of(mesh)})")

    def _asked(self, surface, before: surfaces.Asked) -> Optional[surfaces.Asked]:
        """Asks the user for settings and makes the mesh with them. None if the dialog was cancelled."""
        from . import surface_view

        asked = surface_view.ask(before, translate("Quadrille", "Quad mesh of {}").format(surface.Label))
        if asked is not None:
            surface_view.check(asked)
            surface_view.mesh_with_bar(surface, asked)
        return asked


def _mesh_picked(pick):
    """The triangle mesh that a pick lies in, or a quad mesh made of one; None for anything else."""
    inward = picks.along(pick)
    return next((obj for obj in reversed(inward) if surfaces.is_mesh_object(obj) or is_surface_mesh(obj)), None)


class RefineCommand(_Command):
    """Refines faces, edges or vertices: adds a FEM mesh region to the quad mesh."""

    name = "Quadrille_Refine"
    text = QT_TRANSLATE_NOOP("Quadrille_Refine", "Refine faces, edges, vertices")
    tip = QT_TRANSLATE_NOOP(
        "Quadrille_Refine", "Give the selected faces, edges or vertices a size of their own (a FEM mesh region)")
    accelerator = "Q, R"
    pixmap = "quadrille_refine"
    step = "Refine quad mesh"
    selects = True

    def run(self) -> None:
        mesh = mesh_in_question()
        references = [entry for entry in picks.references_on(part_of(mesh), picked(mesh.Document))
                      if not is_quad_mesh(entry[0])]
        if not references:
            raise Error(translate("Quadrille", "select faces, edges or vertices of the part first"), "usage")
        size = self.ask(mesh)
        if size is None:
            return
        do("import quadrille.freecad")
        regions.check_references(mesh, references)
        do(f"quadrille.freecad.refine({path_of(mesh)}, {links_text(references)}, {size!r})")
        mesh.Document.recompute()

    @staticmethod
    def ask(mesh) -> Optional[float]:
        """Asks for the size in a dialog; None if it is cancelled."""
        usual = mesh.Size.Value or default_size(mesh.Shape.Shape.BoundBox.DiagonalLength)
        dialog = QtGui.QDialog(FreeCADGui.getMainWindow())
        dialog.setWindowTitle(translate("Quadrille", "Refine"))
        label = translate("Quadrille", "Element size")
        box = LengthField("QuadrilleRefineSize")
        box.show_length(float(digits(usual / 2)))
        buttons = QtGui.QDialogButtonBox(QtGui.QDialogButtonBox.Ok | QtGui.QDialogButtonBox.Cancel)
        buttons.accepted.connect(dialog.accept)
        buttons.rejected.connect(dialog.reject)
        layout = QtGui.QFormLayout(dialog)
        layout.addRow(label, box)
        layout.addRow(buttons)
        return box.length(label) if dialog.exec_() else None


class QualityCommand(_Command):
    """Shows the quality of a mesh."""

    name = "Quadrille_Quality"
    text = QT_TRANSLATE_NOOP("Quadrille_Quality", "Mesh quality")
    tip = QT_TRANSLATE_NOOP("Quadrille_Quality", "Show the quality of a quad mesh: numbers, histogram, colors, worst elements")
    accelerator = "Q, Q"
    pixmap = "quadrille_quality"

    def run(self) -> None:
        from .quality_view import QualityPanel

        mesh = _meshed_in_question()
        mesh.ViewObject.show()
        FreeCADGui.Control.showDialog(QualityPanel(mesh))


class NormalsCommand(_Command):
    """Shows or hides the shell normals."""

    name = "Quadrille_Normals"
    text = QT_TRANSLATE_NOOP("Quadrille_Normals", "Show shell normals")
    tip = QT_TRANSLATE_NOOP("Quadrille_Normals", "Show the normals of the shell elements as arrows, or hide them again")
    accelerator = "Q, N"
    pixmap = "quadrille_normals"

    def run(self) -> None:
        mesh = _meshed_in_question()
        do("import quadrille.gui.overlays")
        word = "hide" if overlays.is_shown(mesh, overlays.NORMALS) else "show"
        do(f"quadrille.gui.overlays.{word}_normals({path_of(mesh)})")


class FlipCommand(_Command):
    """Flips the shell normals of the selected faces, or of all."""

    name = "Quadrille_Flip"
    text = QT_TRANSLATE_NOOP("Quadrille_Flip", "Flip shell normals")
    tip = QT_TRANSLATE_NOOP(
        "Quadrille_Flip", "Flip the shell normals of the selected faces (of all faces if none is selected) and mesh again")
    accelerator = "Q, F"
    pixmap = "quadrille_flip"
    step = "Flip shell normals"

    def run(self) -> None:
        mesh = _meshed_in_question()
        if is_surface_mesh(mesh):
            raise Error(translate("Quadrille", "{}: its normals are those of {}: flip them there (Meshes, Flip normals), and mesh "
                                  "again").format(mesh.Label, mesh.Surface.Label if mesh.Surface else "its surface"), "usage",
                        mesh.Name)
        chosen = [pick for pick in picked(mesh.Document) if pick[1].split(".")[-1]]
        faces = [name for name in picks.elements_of(part_of(mesh), chosen) if name.startswith("Face")]
        if chosen and not faces:
            raise Error(translate("Quadrille", "no face of {} is selected: select its faces, or nothing "
                                  "to flip all of them").format(mesh.Shape.Label), "usage")
        do("import quadrille.freecad")
        do(f"quadrille.freecad.flip({path_of(mesh)}, {faces!r})")
        if overlays.is_shown(mesh, overlays.NORMALS):
            overlays.show_normals(mesh)


class AdaptCommand(_Command):
    """Remeshes according to the error of the result."""

    name = "Quadrille_Adapt"
    text = QT_TRANSLATE_NOOP("Quadrille_Adapt", "Adapt mesh to results")
    tip = QT_TRANSLATE_NOOP(
        "Quadrille_Adapt", "Estimate the error of the stresses in the result of the analysis, and mesh again with sizes that spread it "
        "evenly; then solve again")
    accelerator = "Q, A"
    pixmap = "quadrille_adapt"
    step = "Adapt mesh to results"
    _word = ""  #: what has been done, for a box

    def run(self) -> None:
        mesh = _meshed_in_question()
        percent = self.ask(mesh)
        if percent is None:
            return
        with progress_bar(translate("Quadrille", "Adapting {}").format(mesh.Label)) as progress:
            estimate = adaption.prepare(mesh, error=percent / 100, progress=progress)
        token = mesh.MeshToken
        do("import quadrille.adaption")
        do(f"quadrille.adaption.adapt({path_of(mesh)}, error={percent / 100!r})")
        error = f"{100 * estimate.error:.3g}"
        if mesh.MeshToken == token:
            self._word = translate("Quadrille", "{}: the estimated error is {} %, below the target: the mesh stays.").format(
                mesh.Label, error)
            self._word = "\n\n".join((self._word, *estimate.warnings))
        else:
            self._word = translate("Quadrille", "{}: the estimated error was {} %; now there are {} quads: solve again.").format(
                mesh.Label, error, mesh.QuadCount)
        mesh.ViewObject.show()
        if mesh.Shape is not None:
            mesh.Shape.ViewObject.hide()

    def afterwards(self) -> None:
        word, self._word = self._word, ""
        if word:
            QtGui.QMessageBox.information(FreeCADGui.getMainWindow(), "Quadrille", word)

    @staticmethod
    def ask(mesh) -> Optional[float]:
        """Asks for the target error, in percent, in a dialog; None if it is cancelled."""
        percent, agreed = QtGui.QInputDialog.getDouble(
            FreeCADGui.getMainWindow(), translate("Quadrille", "Adapt {} to results").format(mesh.Label),
            translate("Quadrille", "Target error of the stresses, percent"), 5.0, 0.01, 99.0, 2)
        return percent if agreed else None


class ExportCommand(_Command):
    """Exports the mesh."""

    name = "Quadrille_Export"
    text = QT_TRANSLATE_NOOP("Quadrille_Export", "Export quad mesh")
    tip = QT_TRANSLATE_NOOP(
        "Quadrille_Export", "Write the mesh to a file for CalculiX, Gmsh, Salome, ParaView or Nastran, with its sets and groups")
    accelerator = "Q, E"
    pixmap = "quadrille_export"

    def run(self) -> None:
        mesh = _meshed_in_question()
        path = self.ask(mesh)
        if not path:
            return
        do("import quadrille.freecad")
        do(f"quadrille.freecad.export({path_of(mesh)}, {path!r})")

    @staticmethod
    def ask(mesh) -> Optional[str]:
        """Asks for the path in a dialog; None if it is cancelled."""
        filters = ";;".join(f"{name} (*.{suffix})" for name, suffix in FORMATS.items())
        path, chosen = QtGui.QFileDialog.getSaveFileName(FreeCADGui.getMainWindow(), "Export quad mesh",
                                                         f"{mesh.Label}.inp", filters)
        if path and not Path(path).suffix:
            path += next(f".{suffix}" for name, suffix in FORMATS.items() if chosen.startswith(name))
        return path or None


#: The commands by the names under which FreeCAD knows them.
COMMANDS = {command.name: command for command in (MiddleCommand, MeshCommand, SolveCommand, SurfaceCommand, RefineCommand, QualityCommand,
                                                  NormalsCommand, FlipCommand, AdaptCommand, ExportCommand)}


def register() -> None:
    """Registers the commands with FreeCAD, unless it knows them already, and the views of the objects that they make."""
    features_views.use(lambda: views)
    mesh_clicks.watch()
    known = FreeCADGui.listCommands()
    for name, command in COMMANDS.items():
        if name not in known:
            quadrille_commands.add(name, command())
