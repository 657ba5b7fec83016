# SPDX-License-Identifier: GPL-3.0-or-later
"""The commands of the workbench. What a click does goes through FreeCADGui.doCommand, so that macros record it."""

from pathlib import Path
from typing import Optional

import FreeCAD
import FreeCADGui
from PySide import QtGui

from .. import freecad as core
from .. import picks
from ..errors import Error
from . import icon, overlays, tell

TOOLBAR = ["Quadrille_Mesh", "Quadrille_Refine", "Quadrille_Quality", "Quadrille_Normals", "Quadrille_Flip",
           "Quadrille_Export"]
#: What the mesher writes, for the file dialog.
FORMATS = {
    "CalculiX, Abaqus": "inp", "Gmsh": "msh", "I-DEAS universal": "unv", "MED (Salome, Code_Aster)": "med",
    "VTK XML (ParaView)": "vtu", "VTK legacy": "vtk", "Nastran": "bdf",
}


def _do(text: str) -> None:
    FreeCADGui.doCommand(text)


def _path(obj) -> str:
    return f"App.getDocument({obj.Document.Name!r}).getObject({obj.Name!r})"


def _references(references) -> str:
    """FEM references in Python's spelling."""
    return "[" + ", ".join(f"({_path(target)}, {names!r})" for target, names in references) + "]"


def picked(document) -> list:
    """What is selected in a document, see picks.py."""
    return picks.picks_of(FreeCADGui.Selection.getSelectionEx(document.Name, 0))


def is_quad_mesh(obj) -> bool:
    """True for the mesh objects of this addon."""
    return getattr(getattr(obj, "Proxy", None), "Type", "") == core.MeshFeature.Type


def mesh_in_question():
    """The selected mesh object, or the one whose part is selected, or the only one in the document."""
    document = FreeCAD.ActiveDocument
    if document is None:
        raise Error("open a document first", "usage")
    meshes = [obj for obj in document.Objects if is_quad_mesh(obj)]
    if not meshes:
        raise Error("the document has no quad mesh: select a part and use Quad mesh from shape first", "usage")
    selected = picks.parts_of(picked(document))
    for candidates in ([mesh for mesh in meshes if mesh in selected],
                       [mesh for mesh in meshes if mesh.Shape in selected], meshes):
        if len(candidates) == 1:
            return candidates[0]
    raise Error("the document has several quad meshes: select one of them", "usage")


def _meshed_in_question():
    mesh = mesh_in_question()
    if not mesh.FemMesh.FaceCount:
        raise Error(f"{mesh.Label}: is not meshed yet: double-click it and press Mesh", "usage", mesh.Name)
    return mesh


def active_analysis(document):
    """The active analysis, when it is in the document."""
    try:
        import FemGui
    except ImportError:
        return None
    analysis = FemGui.getActiveAnalysis()
    return analysis if analysis is not None and analysis.Document == document else None


class _Command:
    """A command: run() does the work; an Error becomes one message and the transaction is taken back."""

    text = tip = pixmap = accelerator = ""
    transaction: Optional[str] = None

    def GetResources(self) -> dict:
        """FreeCAD asks for text and icon."""
        return {"MenuText": self.text, "ToolTip": self.tip, "Pixmap": icon(self.pixmap), "Accel": self.accelerator}

    def IsActive(self) -> bool:
        """A document is open, and no other panel."""
        return FreeCAD.ActiveDocument is not None and not FreeCADGui.Control.activeDialog()

    def Activated(self, _index: int = 0) -> None:
        """A click."""
        document = FreeCAD.ActiveDocument
        if document is None:
            tell("Open a document first.")
            return
        if self.transaction:
            document.openTransaction(self.transaction)
        try:
            self.run()
        except Error as error:
            if self.transaction:
                document.abortTransaction()
            tell(str(error))
            return
        if self.transaction:
            document.commitTransaction()
        self.afterwards()

    def run(self) -> None:
        """The work, inside the transaction."""

    def afterwards(self) -> None:
        """What follows outside of the transaction."""


class MeshCommand(_Command):
    """Quad mesh from shape."""

    text = "Quad mesh from shape"
    tip = "Mesh the selected part with quads"
    pixmap = "quadrille_mesh"
    transaction = "Create quad mesh"

    def run(self) -> None:
        document = FreeCAD.ActiveDocument
        selected = picks.parts_of(picked(document))
        if len(selected) != 1:
            raise Error("select one part to mesh" if not selected else
                        f"{len(selected)} objects are selected: select one part to mesh (to mesh several as one, "
                        "make a compound or a boolean fragment of them)", "usage")
        self._edit = None
        part = selected[0]
        if is_quad_mesh(part):
            self._edit = part
            return
        analysis = active_analysis(document)
        core.check_part(part, analysis)
        core.find_mesher()
        size = core.suggested_size(part)
        _do("import quadrille.freecad")
        into = f", analysis={_path(analysis)}" if analysis is not None else ""
        _do(f"quadrille.freecad.make_mesh({_path(part)}, size={size!r}{into})")
        self._edit = [obj for obj in document.Objects if is_quad_mesh(obj)][-1]

    def afterwards(self) -> None:
        if self._edit is not None:
            _do(f"Gui.getDocument({self._edit.Document.Name!r}).setEdit({self._edit.Name!r})")


class RefineCommand(_Command):
    """Refine faces, edges or vertices: a FEM mesh region on our mesh."""

    text = "Refine faces, edges, vertices"
    tip = "Give the selected faces, edges or vertices a size of their own (a FEM mesh region)"
    pixmap = "quadrille_refine"
    transaction = "Refine quad mesh"

    def run(self) -> None:
        mesh = mesh_in_question()
        references = [entry for entry in picks.references_on(mesh.Shape, picked(mesh.Document))
                      if not is_quad_mesh(entry[0])]
        if not references:
            raise Error("select faces, edges or vertices of the part first", "usage")
        size = self.ask(mesh)
        if size is None:
            return
        _do("import quadrille.freecad")
        core.check_references(mesh, references)
        _do(f"quadrille.freecad.refine({_path(mesh)}, {_references(references)}, {size!r})")
        mesh.Document.recompute()

    @staticmethod
    def ask(mesh) -> Optional[float]:
        """The size, from a box."""
        usual = mesh.Size.Value or mesh.Shape.Shape.BoundBox.DiagonalLength / 60
        size, accepted = QtGui.QInputDialog.getDouble(FreeCADGui.getMainWindow(), "Refine", "Element size in mm",
                                                      usual / 2, usual * 1e-6, usual * 1e3, 4)
        return size if accepted else None


class QualityCommand(_Command):
    """Mesh quality."""

    text = "Mesh quality"
    tip = "Show the quality of a quad mesh: numbers, histogram, colours, worst elements"
    pixmap = "quadrille_quality"

    def run(self) -> None:
        from .quality_view import QualityPanel

        mesh = _meshed_in_question()
        mesh.ViewObject.show()
        FreeCADGui.Control.showDialog(QualityPanel(mesh))


class NormalsCommand(_Command):
    """Shows or hides the shell normals."""

    text = "Show shell normals"
    tip = "Show the normals of the shell elements as arrows, or hide them again"
    pixmap = "quadrille_normals"

    def run(self) -> None:
        mesh = _meshed_in_question()
        _do("import quadrille.gui.overlays")
        word = "hide" if overlays.is_shown(mesh, overlays.NORMALS) else "show"
        _do(f"quadrille.gui.overlays.{word}_normals({_path(mesh)})")


class FlipCommand(_Command):
    """Flips the shell normals of the selected faces, or of all."""

    text = "Flip shell normals"
    tip = "Turn the shell normals of the selected faces over (of all faces when none is selected); meshes again"
    pixmap = "quadrille_flip"
    transaction = "Flip shell normals"

    def run(self) -> None:
        mesh = _meshed_in_question()
        chosen = [pick for pick in picked(mesh.Document) if pick[1].split(".")[-1]]
        faces = [name for name in picks.elements_of(mesh.Shape, chosen) if name.startswith("Face")]
        if chosen and not faces:
            raise Error(f"none of what is selected is a face of {mesh.Shape.Label}: select its faces, or nothing to flip "
                        "all of them", "usage")
        _do("import quadrille.freecad")
        _do(f"quadrille.freecad.flip({_path(mesh)}, {faces!r})")
        if overlays.is_shown(mesh, overlays.NORMALS):
            overlays.show_normals(mesh)


class ExportCommand(_Command):
    """Exports the mesh."""

    text = "Export quad mesh"
    tip = "Write the mesh to a file for CalculiX, Gmsh, Salome, ParaView or Nastran, with its sets and groups"
    pixmap = "quadrille_export"

    def run(self) -> None:
        mesh = _meshed_in_question()
        path = self.ask(mesh)
        if not path:
            return
        _do("import quadrille.freecad")
        _do(f"quadrille.freecad.export({_path(mesh)}, {path!r})")

    @staticmethod
    def ask(mesh) -> Optional[str]:
        """The path, from a box."""
        filters = ";;".join(f"{name} (*.{suffix})" for name, suffix in FORMATS.items())
        path, chosen = QtGui.QFileDialog.getSaveFileName(FreeCADGui.getMainWindow(), "Export quad mesh",
                                                         f"{mesh.Label}.inp", filters)
        if path and not Path(path).suffix:
            path += next(f".{suffix}" for name, suffix in FORMATS.items() if chosen.startswith(name))
        return path or None


#: The commands by the names that FreeCAD knows them by.
COMMANDS = {
    "Quadrille_Mesh": MeshCommand, "Quadrille_Refine": RefineCommand, "Quadrille_Quality": QualityCommand,
    "Quadrille_Normals": NormalsCommand, "Quadrille_Flip": FlipCommand, "Quadrille_Export": ExportCommand,
}


def register() -> None:
    """Makes the commands known to FreeCAD, once."""
    known = FreeCADGui.listCommands()
    for name, command in COMMANDS.items():
        if name not in known:
            FreeCADGui.addCommand(name, command())
