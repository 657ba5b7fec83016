# SPDX-License-Identifier: GPL-3.0-or-later
"""How a mesh made of a mesh object appears in the tree, and the box that asks how to mesh it. Documents name
SurfaceViewProvider: do not move it."""

from typing import Optional

import FreeCADGui
from PySide import QtGui

from .. import surfaces
from ..errors import Error
from . import fem_workbench, translate
from .length_field import LengthField
from .view_provider import MeshViewProvider


class SurfaceViewProvider(MeshViewProvider):
    """The view provider of meshes made of mesh objects."""

    def claimChildren(self) -> list:
        """Nothing hangs below."""
        return []

    def setupContextMenu(self, vobj, menu) -> None:
        """The commands for a mesh, when it is clicked in the tree."""
        fem_workbench.fill_context_menu(
            vobj.Object, menu, ("Quadrille_Surface", "Quadrille_Quality", "Quadrille_Normals", "Quadrille_Export"))

    def setEdit(self, vobj, _mode=0) -> bool:
        """The command asks anew, outside of any edit mode."""
        FreeCADGui.Selection.clearSelection()
        FreeCADGui.Selection.addSelection(vobj.Object)
        FreeCADGui.runCommand("Quadrille_Surface")
        return False

    def doubleClicked(self, vobj) -> bool:
        """A double click edits."""
        self.setEdit(vobj)
        return True


def ask(asked: surfaces.Asked, title: str) -> Optional[surfaces.Asked]:
    """How to mesh, from a box that starts with what is given; None when it is cancelled."""
    dialog = QtGui.QDialog(FreeCADGui.getMainWindow())
    dialog.setWindowTitle(title)
    size, merge = LengthField("QuadrilleSurfaceSize"), LengthField("QuadrilleSurfaceMerge")
    size.show_length(asked.size)
    merge.show_length(asked.merge)
    order = QtGui.QComboBox()
    order.setObjectName("QuadrilleSurfaceOrder")
    order.addItems(["1st", "2nd"])
    order.setCurrentIndex(asked.order - 1)
    angle = QtGui.QDoubleSpinBox()
    angle.setObjectName("QuadrilleSurfaceAngle")
    angle.setRange(0, 180)
    angle.setSuffix(" °")
    angle.setSpecialValueText(translate("Quadrille", "none: one face"))
    angle.setValue(asked.feature_angle)
    buttons = QtGui.QDialogButtonBox(QtGui.QDialogButtonBox.Ok | QtGui.QDialogButtonBox.Cancel)
    buttons.accepted.connect(dialog.accept)
    buttons.rejected.connect(dialog.reject)
    labels = (translate("Quadrille", "Element size"), translate("Quadrille", "Element order"),
              translate("Quadrille", "New face from a fold of"), translate("Quadrille", "Merge nodes closer than"))
    layout = QtGui.QFormLayout(dialog)
    for label, field in zip(labels, (size, order, angle, merge)):
        layout.addRow(label, field)
    layout.addRow(buttons)
    if not dialog.exec_():
        return None
    return surfaces.Asked(size.length(labels[0]), order.currentIndex() + 1, angle.value(), merge.length(labels[3]))


def mesh_with_bar(surface, asked: surfaces.Asked) -> None:
    """Makes the mesh that the next command takes, behind a bar with a button to cancel."""
    bar = QtGui.QProgressDialog(translate("Quadrille", "Meshing {}...").format(surface.Label),
                                translate("Quadrille", "Cancel"), 0, 100, FreeCADGui.getMainWindow())
    bar.setWindowTitle("Quadrille")
    bar.setModal(True)  # what is shown takes the clicks meanwhile
    bar.setMinimumDuration(500)

    def show(_stage: str, fraction: float) -> bool:
        bar.setValue(min(99, int(100 * fraction)))
        QtGui.QApplication.processEvents()
        return not bar.wasCanceled()

    try:
        surfaces.prepare(surface, asked, show)
    finally:
        bar.close()
        bar.deleteLater()


def check(asked: surfaces.Asked) -> None:
    """Raises Error for a size that makes no sense."""
    if not asked.size > 0:
        raise Error(translate("Quadrille", "the element size must be larger than 0"), "usage")
