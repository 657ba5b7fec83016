# SPDX-License-Identifier: GPL-3.0-or-later
"""One element of a mesh, clicked in the 3-D view or chosen from a list: its face, its measures, and the cause of its shape."""

from typing import Callable, NamedTuple, Optional

import numpy as np
from PySide import QtGui

from ..core import quality
from ..core.units import digits
from ..document import groups, picks
from ..document.findings import findings_of
from . import mesh_clicks, overlays, translate


#: The width of the ball that *Refine here* makes finer, in sides of the element.
_BALL = 3


class Ball(NamedTuple):
    """A place to refine: an entry of SizeIn."""

    place: str  #: such as "sphere:1,2,3,0.5": center and radius
    size: float


class ElementView(QtGui.QWidget):
    """Describes an element, and offers to refine there. Follows clicks on the mesh until release() is called."""

    def __init__(self, mesh, measured: Callable[[], quality.ElementQuality], refine: Callable[[Ball], None]) -> None:
        super().__init__()
        self._mesh, self._measured = mesh, measured
        self._ball = Ball("", 0.0)
        self._groups: Optional[groups.PartGroups] = None
        self.text = QtGui.QLabel()
        self.text.setObjectName("QuadrilleElement")
        self.text.setWordWrap(True)
        self.refine = QtGui.QPushButton(translate("Quadrille", "Refine here"))
        self.refine.setObjectName("QuadrilleRefineHere")
        self.refine.setToolTip(translate("Quadrille", "Half the size of the element, in a ball three elements wide around it"))
        self.refine.clicked.connect(lambda *_: refine(self._ball))
        layout = QtGui.QVBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.addWidget(self.text)
        layout.addWidget(self.refine)
        self.forget()
        mesh_clicks.listeners.append(self._clicked)

    def forget(self) -> None:
        """Describes no element, as when the mesh has changed."""
        self._groups = None
        self.setVisible(False)

    def release(self) -> None:
        """Ends following clicks."""
        if self._clicked in mesh_clicks.listeners:
            mesh_clicks.listeners.remove(self._clicked)

    def face_of(self, index: int) -> str:
        """The face that an element lies on, by its index in the measures."""
        return self._part_groups().face_of(int(self._measured().ids[index]))

    def forced_by(self, index: int) -> str:
        """The vertex, edge or face of the part that forces the shape of an element; empty if there is none."""
        measured, part_groups = self._measured(), self._part_groups()
        nodes = [int(node) for node in measured.nodes[index]]
        corner = int(np.argmin(_angles(measured.corners[index])))
        vertex = part_groups.vertex_at(nodes[corner])
        if measured.criteria["angle_min"][index] < measured.limits["angle_min"][1] and vertex:
            if all(part_groups.edge_along(nodes[corner], nodes[(corner + step) % 4]) for step in (1, 3)):
                return vertex
        if any(measured.fails(name)[index] for name in measured.limits if name != "warp"):
            forcing = {name for name, cause in self._poor() if cause != "none"}
            for start in range(4):
                edge = part_groups.edge_along(nodes[start], nodes[(start + 1) % 4]) if forcing else ""
                if edge in forcing:
                    return edge
            face = self.face_of(index)
            if (face, "narrow") in self._poor():
                return face
        return ""

    def _poor(self):
        """The edges and faces whose quads are outside the limits, and the cause."""
        return [(found["name"], found["cause"]) for found in findings_of(self._mesh)["poor_quads"]]

    def show_element(self, index: int) -> None:
        """Describes an element, by its index in the measures."""
        measured = self._measured()
        length = float(measured.lengths[index])
        sphere = (*measured.centers[index], 0.5 * _BALL * length)
        self._ball = Ball("sphere:" + ",".join(f"{float(value):.6g}" for value in sphere), float(digits(0.5 * length)))
        criteria = measured.criteria
        text = translate("Quadrille", "Element {} on {}: q {}, aspect {}, angles {} to {} degrees").format(
            measured.ids[index], self.face_of(index) or "?", digits(round(float(measured.q[index]), 3)), digits(float(measured.aspect[index])),
            digits(round(float(criteria["angle_min"][index]), 1)), digits(round(float(criteria["angle_max"][index]), 1)))
        forced = self.forced_by(index)
        if forced:
            text += "; " + translate("Quadrille", "forced by {}").format(forced)
        self.text.setText(text)
        self.setVisible(True)

    def _part_groups(self) -> groups.PartGroups:
        if self._groups is None:
            self._groups = groups.PartGroups(self._mesh.FemMesh)
        return self._groups

    def _clicked(self, document: str, name: str, point) -> None:
        try:
            if (document, name) != (self._mesh.Document.Name, self._mesh.Name) or not self._mesh.FemMesh.FaceCount:
                return
        except ReferenceError:  # the object or its document was deleted
            self.release()
            return
        found = np.flatnonzero(self._measured().ids == picks.element_at(self._mesh, point))
        if found.size:
            overlays.frame_element(self._mesh, self._measured(), int(found[0]))
            self.show_element(int(found[0]))


def _angles(corners: np.ndarray) -> np.ndarray:
    """The angles at the corners of a quad, (4, 3), in radians."""
    out, back = np.roll(corners, -1, axis=0) - corners, np.roll(corners, 1, axis=0) - corners
    lengths = np.linalg.norm(out, axis=1) * np.linalg.norm(back, axis=1)
    return np.arccos(np.clip((out * back).sum(axis=1) / np.maximum(lengths, 1e-300), -1, 1))
