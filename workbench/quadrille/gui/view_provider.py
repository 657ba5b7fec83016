# SPDX-License-Identifier: GPL-3.0-or-later
"""How a mesh object appears in the tree and opens its panel. Saved documents refer to MeshViewProvider by name: do not move
it."""

import FreeCADGui

from ..document.state import UP_TO_DATE
from . import fem_workbench, icon, overlays, preferences, tell, translate


class MeshViewProvider:
    """The view provider of our mesh objects."""

    #: The undo step that has just made the object, for the panel that opens next.
    made_by = ""
    #: The task panel while it is open.
    panel = None

    def __init__(self, vobj) -> None:
        vobj.Proxy = self
        vobj.LineWidth = preferences.line_width()
        # An open shell must be visible from behind too.
        vobj.BackfaceCulling = False
        vobj.PointSize = 2.0
        # A shell has no inner faces. To find them, FreeCAD compares each face with each other, 3 s for 46 000 quads. Above
        # MaxFacesShowInner it compares nearby faces even if inner ones are to be shown.
        vobj.ShowInner = True
        vobj.MaxFacesShowInner = 2**31 - 1

    def attach(self, vobj) -> None:
        """FreeCAD calls this when the object gets its view."""
        self.Object = vobj.Object

    def getIcon(self) -> str:
        """The icon; another one while the mesh is not up to date."""
        current = getattr(self.Object, "Status", "") == UP_TO_DATE
        return icon("quadrille_mesh" if current else "quadrille_stale")

    def updateData(self, obj, name: str) -> None:
        """FreeCAD calls this when a property has changed. Updates icon and view to the status."""
        if name != "Status":
            return
        obj.ViewObject.signalChangeIcon()
        if obj.Status == UP_TO_DATE or not obj.FemMesh.FaceCount:
            overlays.hide(obj, overlays.STALE)
        else:
            overlays.show_stale(obj)

    def claimChildren(self) -> list:
        """Mesh regions and groups are the mesh's children in the tree."""
        return [*self.Object.MeshRegionList, *self.Object.MeshGroupList]

    def setupContextMenu(self, vobj, menu) -> None:
        """Adds the commands for the mesh to its context menu in the tree."""
        fem_workbench.fill_context_menu(vobj.Object, menu)

    def setEdit(self, vobj, _mode=0) -> bool:
        """Opens the task panel."""
        from .task_panel import MeshPanel

        made_by, self.made_by = self.made_by, ""
        if FreeCADGui.Control.activeDialog():
            tell(translate("Quadrille", "Another task panel is open: close it first."))
            return False
        if vobj.Object.Shape is None:
            tell(translate("Quadrille", "{}: the part that it meshes is gone.").format(vobj.Object.Label))
            return False
        self.panel = MeshPanel(vobj.Object, made_by)
        FreeCADGui.Control.showDialog(self.panel)
        return True

    def unsetEdit(self, _vobj, _mode=0) -> bool:
        """Closes the task panel."""
        self.panel = None
        FreeCADGui.Control.closeDialog()
        return True

    def doubleClicked(self, vobj) -> bool:
        """A double click opens the panel, but only if no panel is open: FreeCAD would close that one, with its unsaved input and
        its mesher."""
        if FreeCADGui.Control.activeDialog():
            if vobj.Document.getInEdit() != vobj:
                tell(translate("Quadrille", "Another task panel is open: close it first."))
            return True
        vobj.Document.setEdit(vobj.Object.Name)
        return True

    def dumps(self):
        """Nothing to save."""
        return None

    def loads(self, _state) -> None:
        """Nothing to restore."""

    __getstate__ = dumps
    __setstate__ = loads
