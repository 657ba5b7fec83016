# SPDX-License-Identifier: GPL-3.0-or-later
"""How a quad mesh made of a triangle mesh appears in the tree, and the dialog that asks how to mesh it. Saved documents refer
to SurfaceViewProvider by name: do not move it."""

from typing import Optional

import FreeCADGui
from PySide import QtGui

from ..core.errors import Error
from ..core.setting_table import ORDERS
from ..features import surfaces
from . import fem_workbench, progress_bar, translate
from .length_field import LengthField
from .view_provider import MeshViewProvider


class SurfaceViewProvider(MeshViewProvider):
    """The view provider of quad meshes made of triangle meshes."""

    def claimChildren(self) -> list:
        """No children in the tree."""
        return []

    def setupContextMenu(self, vobj, menu) -> None:
        """Adds the commands for the mesh to its context menu in the tree."""
        fem_workbench.fill_context_menu(
            vobj.Object, menu, ("Quadrille_Surface", "Quadrille_Quality", "Quadrille_Normals", "Quadrille_Export"))

    def setEdit(self, vobj, _mode=0) -> bool:
        """Runs the command, which asks for settings again; there is no edit mode."""
        FreeCADGui.Selection.clearSelection()
        FreeCADGui.Selection.addSelection(vobj.Object)
        FreeCADGui.runCommand("Quadrille_Surface")
        return False

    def doubleClicked(self, vobj) -> bool:
        """A double click starts setEdit()."""
        self.setEdit(vobj)
        return True


def ask(asked: surfaces.Asked, title: str) -> Optional[surfaces.Asked]:
    """Asks how to mesh in a dialog that starts with the given settings; None if it is cancelled."""
    dialog = QtGui.QDialog(FreeCADGui.getMainWindow())
    dialog.setWindowTitle(title)
    size, merge = LengthField("QuadrilleSurfaceSize"), LengthField("QuadrilleSurfaceMerge")
    size.show_length(asked.size)
    merge.show_length(asked.merge)
    order = QtGui.QComboBox()
    order.setObjectName("QuadrilleSurfaceOrder")
    order.addItems(ORDERS)
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
    """Makes the mesh that the next command uses, and shows a progress bar with a Cancel button."""
    with progress_bar(translate("Quadrille", "Meshing {}...").format(surface.Label)) as progress:
        surfaces.prepare(surface, asked, progress)


def check(asked: surfaces.Asked) -> None:
    """Raises Error if the size is not larger than 0."""
    if not asked.size > 0:
        raise Error(translate("Quadrille", "the element size must be larger than 0"), "usage")
