# SPDX-License-Identifier: GPL-3.0-or-later
"""Drawings over a mesh in the 3-D view: elements colored by quality, arrows for shell normals, and others.

FreeCAD's own element colors are not used, since FreeCAD 0.20 assigns them to the wrong elements of second-order meshes.
"""

from typing import Dict, Sequence, Tuple

import FreeCAD
import numpy as np

from ..core import quality
from ..document.findings import findings_of
from ..document.shapes import has_element
from . import translate

#: Larger numbers of arrows only blacken the view: larger meshes show some of their normals.
MOST_ARROWS = 3000
QUALITY, NORMALS, ELEMENT, STALE = "QuadrilleQuality", "QuadrilleNormals", "QuadrilleElement", "QuadrilleStale"
FREE, CROSSED, MARKS = "QuadrilleFree", "QuadrilleCrossedEdges", "QuadrilleMarks"
#: Number of points along a dotted edge.
_PIECES = 33
#: The scene nodes shown, by the names of document and mesh object, and by kind.
_shown: Dict[tuple, object] = {}
#: The display modes that meshes had before they were colored.
_modes: Dict[tuple, str] = {}
#: How FreeCAD showed that they are selected.
_styles: Dict[tuple, str] = {}


def is_shown(mesh, kind: str) -> bool:
    """True while this kind of overlay is in the view of a mesh object."""
    node = _shown.get((mesh.Document.Name, mesh.Name, kind))
    return node is not None and mesh.ViewObject.RootNode.findChild(node) >= 0


def hide(mesh, kind: str) -> None:
    """Removes an overlay from the view."""
    key = (mesh.Document.Name, mesh.Name, kind)
    node = _shown.pop(key, None)
    if node is not None and mesh.ViewObject.RootNode.findChild(node) >= 0:
        mesh.ViewObject.RootNode.removeChild(node)
    mode = _modes.pop(key, None)
    if mode is not None:
        mesh.ViewObject.DisplayMode = mode
    style = _styles.pop(key, None)
    if style is not None:
        _selection_style(mesh).set(style)


def _selection_style(mesh):
    """The field of the scene that says how a selected mesh is shown; unlike the view's property, the document does not store it."""
    return mesh.ViewObject.RootNode.getField("selectionStyle")


def _add(mesh, kind: str, node) -> None:
    mesh.ViewObject.RootNode.addChild(node)
    _shown[(mesh.Document.Name, mesh.Name, kind)] = node


def _show(mesh, kind: str, node) -> None:
    _add(mesh, kind, node)
    mesh.ViewObject.show()


def _group(*children):
    from pivy import coin

    node = coin.SoSeparator()
    picking = coin.SoPickStyle()
    picking.style = coin.SoPickStyle.UNPICKABLE
    node.addChild(picking)
    for child in children:
        node.addChild(child)
    return node


def _coordinates(points: np.ndarray):
    from pivy import coin

    node = coin.SoCoordinate3()
    node.point.setValues(0, len(points), points.tolist())
    return node


def show_quality(mesh, measured: quality.ElementQuality, measure: str = "q") -> None:
    """Colors the quads by q or a criterion, from red (worst) through yellow (a criterion's limit) to blue (best). A box shows
    meanwhile that the mesh is selected, since FreeCAD would add the color of selections to the quads."""
    from pivy import coin

    hide(mesh, QUALITY)
    colors = quality.colors(measured.goodness(measure))
    material = coin.SoMaterial()
    material.diffuseColor.setValues(0, len(colors), colors.tolist())
    binding = coin.SoMaterialBinding()
    binding.value = coin.SoMaterialBinding.PER_FACE
    hints = coin.SoShapeHints()
    hints.vertexOrdering = coin.SoShapeHints.COUNTERCLOCKWISE
    hints.shapeType = coin.SoShapeHints.UNKNOWN_SHAPE_TYPE  # lit from both sides
    hints.faceType = coin.SoShapeHints.UNKNOWN_FACE_TYPE
    offset = coin.SoPolygonOffset()  # keeps the mesh lines in front
    faces = coin.SoFaceSet()
    faces.numVertices.setValues(0, len(colors), [4] * len(colors))
    _show(mesh, QUALITY, _group(material, binding, hints, offset, _coordinates(measured.corners.reshape(-1, 3)), faces))
    key = (mesh.Document.Name, mesh.Name, QUALITY)
    _styles[key] = _selection_style(mesh).get().getString()
    _selection_style(mesh).set("Box")
    if mesh.ViewObject.DisplayMode != "Wireframe":
        _modes[key] = mesh.ViewObject.DisplayMode
        mesh.ViewObject.DisplayMode = "Wireframe"


def _plain_color(rgb: Tuple[float, float, float]):
    """Scene nodes that give what follows one color, independent of the light."""
    from pivy import coin

    light = coin.SoLightModel()
    light.model = coin.SoLightModel.BASE_COLOR
    color = coin.SoBaseColor()
    color.rgb = rgb
    return light, color


def frame_element(mesh, measured: quality.ElementQuality, index: int) -> None:
    """Draws a thick line around an element."""
    from pivy import coin

    hide(mesh, ELEMENT)
    lift = 0.02 * measured.lengths[index] * measured.normals[index]
    points = measured.corners[index][[0, 1, 2, 3, 0]]
    light, color = _plain_color((0.9, 0.0, 0.6))
    style = coin.SoDrawStyle()
    style.lineWidth = 5
    lines = coin.SoLineSet()
    lines.numVertices.setValues(0, 2, [5, 5])  # one on each side, so that it is visible from both
    _show(mesh, ELEMENT, _group(light, color, style, _coordinates(np.vstack([points + lift, points - lift])), lines))


def show_normals(mesh) -> int:
    """Draws arrows along the normals of the elements. Returns the number of arrows."""
    from pivy import coin

    hide(mesh, NORMALS)
    measured = quality.measure(mesh.FemMesh)
    step = max(1, -(-measured.ids.size // MOST_ARROWS))
    feet, normals = measured.centers[::step], measured.normals[::step]
    length = float(np.median(measured.lengths)) * step**0.5
    tips = feet + normals * length
    # Two barbs make the line an arrow, in any direction perpendicular to the normal.
    across = np.cross(normals, np.where(np.abs(normals[:, :1]) < 0.7, [[1.0, 0.0, 0.0]], [[0.0, 1.0, 0.0]]))
    across *= 0.15 * length / np.linalg.norm(across, axis=1, keepdims=True)
    barbs = tips - 0.3 * length * normals
    points = np.stack([feet, tips, barbs + across, tips, barbs - across], axis=1).reshape(-1, 3)
    light, color = _plain_color((0.85, 0.1, 0.1))
    style = coin.SoDrawStyle()
    style.lineWidth = 2
    lines = coin.SoLineSet()
    lines.numVertices.setValues(0, len(feet), [5] * len(feet))
    _show(mesh, NORMALS, _group(light, color, style, _coordinates(points), lines))
    return len(feet)


def show_stale(mesh) -> None:
    """Writes the status of a stale mesh above it."""
    from pivy import coin

    hide(mesh, STALE)
    box = mesh.FemMesh.BoundBox
    place = (box.Center.x, box.Center.y, box.ZMax + 0.1 * box.DiagonalLength)
    text = f"{mesh.Label}: {translate('QuadrilleStatus', mesh.Status)}"
    in_front = coin.SoAnnotation()
    for node in (*_plain_color((1.0, 1.0, 1.0)), *_label(place, text)):
        in_front.addChild(node)
    _add(mesh, STALE, _group(in_front))


def show_free(mesh, measured: quality.ElementQuality) -> None:
    """Draws the sides that belong to only one element, and the places where nodes coincide."""
    from pivy import coin

    hide(mesh, FREE)
    sides, doubles = measured.free_sides(), measured.double_nodes()
    light, color = _plain_color((0.9, 0.0, 0.0))
    style = coin.SoDrawStyle()
    style.lineWidth = 4
    style.pointSize = 9
    lines = coin.SoLineSet()
    lines.numVertices.setValues(0, len(sides), [2] * len(sides))
    nodes = [light, color, style]
    if len(sides):
        nodes += [_coordinates(sides.reshape(-1, 3)), lines]
    if len(doubles):
        nodes += [_coordinates(doubles), coin.SoPointSet()]
    _show(mesh, FREE, _group(*nodes))


def show_crossed(mesh) -> None:
    """Dots the smooth edges that quads cross."""
    hide(mesh, CROSSED)
    edges = len(findings_of(mesh)["crossed_edges"])
    if not edges or len(mesh.CrossedLines) % edges:
        return
    points = np.array([tuple(point) for point in mesh.CrossedLines])
    _add(mesh, CROSSED, _group(*_dotted(points, [len(points) // edges] * edges, 3)))


def _dotted(points: np.ndarray, counts: Sequence[int], width: int) -> list:
    """Dotted lines through so many points each."""
    from pivy import coin

    light, color = _plain_color((0.9, 0.0, 0.6))
    style = coin.SoDrawStyle()
    style.lineWidth = width
    style.linePattern = 0x0F0F
    lines = coin.SoLineSet()
    lines.numVertices.setValues(0, len(counts), list(counts))
    return [light, color, style, _coordinates(points), lines]


def _label(place, text: str, beside: bool = False) -> list:
    """A text at a place, as large from near as from far: centered there, or to the right of it."""
    from pivy import coin

    shift, font, words = coin.SoTranslation(), coin.SoFont(), coin.SoText2()
    shift.translation.setValue(*place)
    font.size = 20
    words.string.setValue(text)
    words.justification = coin.SoText2.LEFT if beside else coin.SoText2.CENTER
    return [shift, font, words]


def mark(mesh, shape, names: Sequence[str]):
    """Dots faces, edges and vertices of the shape that was meshed, in front of everything, and names them. Returns the box around
    them; None if the shape has none of them."""
    from pivy import coin

    hide(mesh, MARKS)
    elements = {name: shape.getElement(name) for name in names if has_element(shape, name)}
    if not elements:
        return None
    lines = [[tuple(point) for point in (edge.discretize(_PIECES) if edge.Length > 0 else [])]
             for element in elements.values() for edge in element.Edges]
    dots = coin.SoDrawStyle()
    dots.pointSize = 9
    in_front = coin.SoAnnotation()
    box = FreeCAD.BoundBox()
    points = np.array([point for line in lines for point in line]).reshape(-1, 3)
    for node in (*_dotted(points, [len(line) for line in lines if line], 5), dots):
        in_front.addChild(node)
    for name, element in elements.items():
        box.add(element.BoundBox)
        one = coin.SoSeparator()
        if name.startswith("Vertex"):
            one.addChild(_coordinates(np.array([tuple(element.Point)])))
            one.addChild(coin.SoPointSet())
        for node in _label(element.BoundBox.Center, f"  {name}", True):
            one.addChild(node)
        in_front.addChild(one)
    _add(mesh, MARKS, _group(in_front))
    return box


def hide_normals(mesh) -> None:
    """Removes the arrows."""
    hide(mesh, NORMALS)
