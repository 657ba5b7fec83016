# SPDX-License-Identifier: GPL-3.0-or-later
"""The commands inside FreeCAD's FEM workbench: in its Mesh menu, in a toolbar, and in the context menu of a mesh.

FreeCAD makes a command's button when a workbench that lists the command is first activated, and addons cannot add to the FEM
workbench's lists. So the entries here are separate actions that run the commands; they exist from the start."""

from typing import Any, Dict, Mapping, Optional, Sequence

import FreeCAD
import FreeCADGui
from PySide import QtCore, QtGui

from ..core.errors import Error
from ..document.state import UP_TO_DATE, is_quad_mesh
from ..features import mesh_object
from . import do, drawn_icon, path_of, progress_bar, tell, transaction, translate

FEM = "FemWorkbench"
#: Milliseconds between two checks of which commands are active, the same as FreeCAD's.
_INTERVAL = 300
#: The commands in a mesh's context menu: those that need no selected faces, edges or vertices.
_CONTEXT = ["Quadrille_Mesh", "Quadrille_Quality", "Quadrille_Normals", "Quadrille_Export"]
#: The commands by name, as join() gets them.
_commands: Dict[str, Any] = {}


class _FemEntries:
    """The toolbar; also the menu entries if FreeCAD has no workbench manipulators (0.20)."""

    def __init__(self, toolbar: Sequence[str]) -> None:
        window = FreeCADGui.getMainWindow()
        self._actions: Dict[str, QtGui.QAction] = {name: _action(name, window) for name in toolbar}
        self._toolbar = window.addToolBar("Quadrille in FEM")
        self._toolbar.setObjectName("QuadrilleInFem")
        self._toolbar.addActions(list(self._actions.values()))
        self._timer = QtCore.QTimer(window)
        self._timer.timeout.connect(self._enable)
        self._is_placed = False  # behind FreeCAD's own, which exist once its workbench has been activated
        self._has_menu = hasattr(FreeCADGui, "addWorkbenchManipulator")
        if self._has_menu:
            FreeCADGui.addWorkbenchManipulator(_Manipulator(toolbar))
        window.workbenchActivated.connect(self.show)

    def show(self, workbench: str) -> None:
        """Called when FreeCAD has activated a workbench and rebuilt its menus."""
        fem = workbench == FEM
        if fem and not self._is_placed:
            self._is_placed = True
            window = FreeCADGui.getMainWindow()
            window.removeToolBar(self._toolbar)
            window.addToolBar(self._toolbar)
        self._toolbar.setVisible(fem)
        for name, action in self._actions.items():
            # FreeCAD's own action has the shortcut once it exists; two actions with the same one would block each other.
            action.setShortcut(_shortcut(name) if fem and not _own_actions(name) else "")
        if not fem:
            self._timer.stop()
            return
        for name, action in self._actions.items():
            _name(action, name)
        if not self._has_menu:
            self._fill_menu()
        self._enable()
        self._timer.start(_INTERVAL)

    def _enable(self) -> None:
        for name, action in self._actions.items():
            action.setEnabled(FreeCADGui.Command.get(name).isActive())

    def _fill_menu(self) -> None:
        """Adds the actions, or FreeCAD's own where they exist, to the menu that contains FEM's own mesh command."""
        shown = [(_own_actions(name) or [action])[0] for name, action in self._actions.items()]
        gmsh = FreeCADGui.Command.get("FEM_MeshGmshFromShape")
        theirs = gmsh.getAction() if gmsh is not None else []
        for entry in FreeCADGui.getMainWindow().menuBar().actions():
            menu = entry.menu()
            if menu is None or not any(action in menu.actions() for action in theirs):
                continue
            if not any(action in menu.actions() for action in shown):
                menu.addSeparator()
                menu.addActions(shown)
            return


class _Manipulator:
    """Adds the commands to the FEM workbench's menu, if FreeCAD lets addons do so (1.0)."""

    def __init__(self, toolbar: Sequence[str]) -> None:
        self._toolbar = toolbar

    def modifyMenuBar(self) -> list:
        """FreeCAD calls this for the entries to insert: all below FEM's own mesh command."""
        return [{"insert": name, "menuItem": "FEM_MeshGmshFromShape", "after": ""} for name in reversed(self._toolbar)]


def _own_actions(name: str) -> list:
    """FreeCAD's own action for a command, in a list; none before the first workbench that lists the command."""
    return FreeCADGui.Command.get(name).getAction()


def _shortcut(name: str) -> str:
    """The user's shortcut for a command, or the command's own."""
    return FreeCAD.ParamGet("User parameter:BaseApp/Preferences/Shortcut").GetString(name, _commands[name].accelerator)


def _action(name: str, parent) -> QtGui.QAction:
    """An action that runs a command."""
    action = QtGui.QAction(drawn_icon(_commands[name].pixmap), "", parent)
    _name(action, name)
    action.triggered.connect(lambda *_: FreeCADGui.runCommand(name))
    return action


def _name(action, name: str) -> None:
    """Sets an action's texts in FreeCAD's language."""
    command = _commands[name]
    action.setText(translate(name, command.text))
    action.setToolTip(translate(name, command.tip))
    action.setStatusTip(translate(name, command.tip))


def fill_context_menu(mesh, menu, names: Sequence[str] = _CONTEXT) -> None:
    """Adds commands for a mesh object to its context menu."""

    def run(name: str) -> None:
        FreeCADGui.Selection.clearSelection()
        FreeCADGui.Selection.addSelection(mesh)
        FreeCADGui.runCommand(name)

    for name in names:
        action = _action(name, menu)
        action.triggered.disconnect()
        action.triggered.connect(lambda *_, name=name: run(name))
        menu.addAction(action)
    if is_quad_mesh(mesh):
        _offer_meshing_again(mesh, menu)


def _offer_meshing_again(mesh, menu) -> None:
    """Adds what meshes this mesh again with its settings, and what does so with all stale meshes of the document."""

    def entry(name: str, text: str, meshes: list) -> None:
        action = QtGui.QAction(drawn_icon("quadrille_mesh"), text, menu)
        action.setObjectName(name)
        action.setEnabled(bool(meshes))
        action.triggered.connect(lambda *_: mesh_again(meshes))
        menu.addAction(action)

    stale = [obj for obj in mesh.Document.Objects if is_quad_mesh(obj) and obj.Shape is not None and obj.FemMesh.FaceCount
             and obj.Status != UP_TO_DATE]
    entry("QuadrilleAgain", translate("Quadrille", "Mesh again"), [mesh] if mesh.Shape is not None else [])
    entry("QuadrilleAllAgain", translate("Quadrille", "Mesh all stale meshes again"), stale)


def mesh_again(meshes: Sequence[Any]) -> None:
    """Meshes again with the settings of the meshes, each as one undo step. Failures are reported; such meshes stay as they are."""
    if FreeCADGui.Control.activeDialog():
        tell(translate("Quadrille", "Another task panel is open: close it first."))
        return
    for mesh in meshes:
        try:
            with progress_bar(translate("Quadrille", "Meshing {}...").format(mesh.Label)) as progress:
                job = mesh_object.start(mesh)
                try:
                    job.wait(progress)
                except Error:
                    mesh_object.forget(mesh.Document.Name, mesh.Name)
                    raise
            with transaction(mesh.Document, "Quad mesh"):
                do("import quadrille.freecad")
                mesh_object.hand_over(mesh, job)
                do(f"quadrille.freecad.remesh({path_of(mesh)})")
        except Error as error:
            if error.kind == "cancelled":
                return
            tell(str(error))


_entries: Optional[_FemEntries] = None


def join(commands: Mapping[str, Any], toolbar: Sequence[str]) -> None:
    """Adds the commands, by name, to the FEM workbench: those of the toolbar. Further calls do nothing."""
    global _entries
    if _entries is None:
        _commands.update(commands)
        _entries = _FemEntries(toolbar)
        # If FreeCAD starts with the FEM workbench, it activates it later than this.
        _entries.show("")
