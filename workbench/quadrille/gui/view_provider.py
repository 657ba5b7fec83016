# SPDX-License-Identifier: GPL-3.0-or-later
"""How a mesh object appears in the tree and opens its panel. Documents name MeshViewProvider: do not move it."""

import FreeCADGui

from ..freecad import UP_TO_DATE
from . import icon, overlays, preferences, tell, translate


class MeshViewProvider:
    """The view provider of our mesh objects."""

    #: The step of undo that has just made the object, for the panel that opens next.
    made_by = ""

    def __init__(self, vobj) -> None:
        vobj.Proxy = self
        vobj.LineWidth = preferences.line_width()
        # An open shell is seen from behind too.
        vobj.BackfaceCulling = False
        vobj.PointSize = 2.0
        # A shell has no inner faces. Looking for them, FreeCAD compares each with each other, 3 s for 46 000 quads; above
        # MaxFacesShowInner those nearby are compared even where inner ones are to be shown.
        vobj.ShowInner = True
        vobj.MaxFacesShowInner = 2**31 - 1

    def attach(self, vobj) -> None:
        """FreeCAD calls this when the object gets its view."""
        self.Object = vobj.Object

    def getIcon(self) -> str:
        """Another icon while the mesh is not that of the part and its settings."""
        current = getattr(self.Object, "Status", "") == UP_TO_DATE
        return icon("quadrille_mesh" if current else "quadrille_stale")

    def updateData(self, obj, name: str) -> None:
        """Icon and view follow the status."""
        if name != "Status":
            return
        obj.ViewObject.signalChangeIcon()
        if obj.Status == UP_TO_DATE or not obj.FemMesh.FaceCount:
            overlays.hide(obj, overlays.STALE)
        else:
            overlays.show_stale(obj)

    def claimChildren(self) -> list:
        """Mesh regions and groups hang below the mesh."""
        return [*self.Object.MeshRegionList, *self.Object.MeshGroupList]

    def setupContextMenu(self, vobj, menu) -> None:
        """The commands for a mesh, when it is clicked in the tree."""
        from . import fem_workbench

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
        FreeCADGui.Control.showDialog(MeshPanel(vobj.Object, made_by))
        return True

    def unsetEdit(self, _vobj, _mode=0) -> bool:
        """Closes the task panel."""
        FreeCADGui.Control.closeDialog()
        return True

    def doubleClicked(self, vobj) -> bool:
        """A double click edits. FreeCAD would end the panel that is open, with what it has not stored and its mesher."""
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
