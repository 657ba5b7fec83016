# SPDX-License-Identifier: GPL-3.0-or-later
"""What the workbench asks of Part shapes: how many quads a size gives, whether a shape has changed, faces reversed,
and the names of referenced faces, edges and vertices. Runs inside FreeCAD."""

import math
from typing import List, Mapping, Optional, Sequence, Tuple

import Part

from .errors import Error

#: Samples a face and direction, for its curvature; fewer where there are many faces.
_SAMPLES, _FEW_SAMPLES, _MANY_FACES = 8, 4, 300


class SizeEstimate:
    """How many quads the faces of a shape get at a size. Measures faces and edges once; each question is then quick.

    Where an edge is finer than the face beside it, the size grows from the edge. Curvature is sampled on faces: that of a
    strip narrower than an eighth of its face, such as a wing's nose, is missed.
    """

    def __init__(self, shape) -> None:
        samples = _SAMPLES if len(shape.Faces) <= _MANY_FACES else _FEW_SAMPLES
        self._diagonal = shape.BoundBox.DiagonalLength
        edges = {}
        for index, edge in enumerate(shape.Edges, 1):
            if not edge.Degenerated:
                edges.setdefault(edge.hashCode(), []).append((edge, _Edge(f"Edge{index}", edge)))
        self._faces = []
        for index, face in enumerate(shape.Faces, 1):
            measured = _Face(f"Face{index}", face, samples)
            outer = face.OuterWire
            for wire in face.Wires:
                widening = 0.0 if wire.isSame(outer) else 2 * math.pi / max(wire.Length, 1e-300)
                for edge in wire.Edges:
                    for same, of_edge in edges.get(edge.hashCode(), ()):
                        if same.isSame(edge):
                            measured.edges.append((of_edge, widening))
                            # The neighbour is as fine as its curvature wants, up to the edge.
                            of_edge.curvature = max(of_edge.curvature, measured.typical_curvature())
            self._faces.append(measured)

    def quads(
        self,
        size: float,
        size_min: Optional[float] = None,
        elements_per_circle: float = 12,
        sizes: Optional[Mapping[str, float]] = None,
        faces: Sequence[str] = (),
        growth: float = 0.3,
    ) -> int:
        """The number of quads to expect."""
        smallest = size_min or size / 8
        sizes = sizes or {}

        def size_of(name: str, curvature: float, cap: float) -> float:
            cap = min(cap, sizes.get(name, cap))
            if elements_per_circle and curvature > 0:
                return min(cap, max(smallest, 2 * math.pi / (curvature * elements_per_circle)))
            return cap

        count = 0.0
        for face in self._faces:
            if faces and face.name not in faces:
                continue
            inside = sum(area / size_of(face.name, curvature, size) ** 2 for area, curvature in face.pieces)
            coarse = math.sqrt(face.area / inside) if inside else size
            margins = border = 0.0
            reach = face.reach()
            for edge, widening in face.edges:
                fine = min(size_of(edge.name, edge.curvature, size), max(edge.length, smallest))
                border += edge.length / min(fine, coarse)
                if fine < coarse:
                    margins += edge.length * _margin(fine, coarse, reach, growth, widening)
            count += max(4.0, border, inside + margins)  # two rows of quads on the narrowest strip
        return round(count)

    def suggested(self, quads: int = 5000, elements_per_circle: float = 12) -> float:
        """The size that gives about so many quads, to two digits."""
        low, high = self._diagonal * 1e-5, self._diagonal / 2
        for _ in range(30):
            middle = math.sqrt(low * high)
            if self.quads(middle, None, elements_per_circle) > quads:
                low = middle
            else:
                high = middle
        digits = 1 - math.floor(math.log10(high))
        return round(high, digits)


class _Edge:
    """What counts of an edge."""

    def __init__(self, name: str, edge) -> None:
        self.name, self.length, self.curvature = name, edge.Length, 0.0
        if isinstance(edge.Curve, Part.Line):
            return
        first, last = edge.ParameterRange
        for share in (0.1, 0.5, 0.9):
            try:
                self.curvature = max(self.curvature, edge.curvatureAt(first + share * (last - first)))
            except (Part.OCCError, RuntimeError):  # a kink has no curvature
                continue


class _Face:
    """What counts of a face: its area in pieces, each with the larger curvature there, and its edges."""

    def __init__(self, name: str, face, samples: int) -> None:
        self.name, self.area = name, face.Area
        self.pieces = _curvatures(face, self.area, samples)
        self.edges: List[Tuple[_Edge, float]] = []  # with what the margin of each widens by, per length and distance

    def typical_curvature(self) -> float:
        """The root mean square over the area: what its elements have on average."""
        total = sum(area * curvature**2 for area, curvature in self.pieces)
        return math.sqrt(total / self.area) if self.area > 0 else 0.0


    def reach(self) -> float:
        """How far margins of equal width along all edges reach until they fill the face."""
        length = sum(edge.length for edge, _ in self.edges)
        widening = sum(edge.length * widening for edge, widening in self.edges) / 2
        if length <= 0:
            return 0.0
        return 2 * self.area / (length + math.sqrt(length**2 + 4 * widening * self.area))


def _margin(fine: float, coarse: float, width: float, growth: float, widening: float) -> float:
    """Quads to add per length of an edge, where the size grows from `fine` at the edge to `coarse` inside. Around a hole
    the margin widens with the distance."""
    width = min(width, (coarse - fine) / growth)
    if width <= 0:
        return 0.0
    far = fine + growth * width
    wider = (math.log(far / fine) + fine / far - 1) / growth**2
    return ((1 / fine - 1 / far) / growth + widening * wider
            - (width + widening * width**2 / 2) / coarse**2)


def _curvatures(face, area: float, samples: int) -> List[Tuple[float, float]]:
    """A face in pieces: the area of each and the larger curvature there."""
    if isinstance(face.Surface, Part.Plane):
        return [(area, 0.0)]
    u_min, u_max, v_min, v_max = face.ParameterRange
    found = []
    for i in range(samples):
        for j in range(samples):
            u = u_min + (u_max - u_min) * (i + 0.5) / samples
            v = v_min + (v_max - v_min) * (j + 0.5) / samples
            try:
                along_u, along_v = face.derivative1At(u, v)
                curvature = max(abs(value) for value in face.curvatureAt(u, v))
            except (Part.OCCError, RuntimeError):  # a pole or a kink has no curvature
                continue
            found.append((along_u.cross(along_v).Length, curvature))
    total = sum(weight for weight, _ in found)
    if not total > 0:
        return [(area, 0.0)]
    return [(area * weight / total, curvature) for weight, curvature in found]


def fingerprint(shape) -> List[float]:
    """Numbers that change when a shape does: its corners, the lengths of its edges, areas and centres of its faces.

    BREP text would not do: it holds the triangulation for the screen and flags of checks.
    """
    numbers = [float(len(shape.Faces)), float(len(shape.Edges)), float(len(shape.Vertexes))]
    for vertex in shape.Vertexes:
        numbers += tuple(vertex.Point)
    for edge in shape.Edges:
        numbers.append(0.0 if edge.Degenerated else edge.Length)
    for face in shape.Faces:
        numbers += [face.Area, *tuple(face.CenterOfMass), -1.0 if face.Orientation == "Reversed" else 1.0]
    return numbers


def same_fingerprint(one: Sequence[float], other: Sequence[float]) -> bool:
    """True when two fingerprints agree but for rounding."""
    if len(one) != len(other):
        return False
    scale = max((abs(number) for number in one), default=1.0)
    return all(abs(a - b) <= 1e-9 * scale for a, b in zip(one, other))


def with_reversed_faces(shape, names: Sequence[str]):
    """The faces of a shape, those with these names reversed; numbered as before. The shape itself when none is."""
    if not names:
        return shape
    reverse = set(names)
    faces = []
    for index, face in enumerate(shape.Faces, 1):
        if f"Face{index}" in reverse:
            face = face.reversed()
            reverse.discard(f"Face{index}")
        faces.append(face)
    if reverse:
        raise Error(f"{sorted(reverse)[0]}: the part has no such face to flip", "usage", sorted(reverse)[0])
    compound = Part.makeCompound(faces)
    for kind in ("Faces", "Edges", "Vertexes"):
        before, after = getattr(shape, kind), getattr(compound, kind)
        if len(before) != len(after) or not all(a.isSame(b) for a, b in zip(before, after)):
            raise Error("the normals cannot be flipped: the part has edges or vertices that belong to no face",
                        "failure")
    return compound


def references_to_names(shape, owner, references: Sequence[Tuple]) -> List[str]:
    """FEM references as names in the meshed shape ("Face3"): those of other objects are found by their geometry."""
    names: List[str] = []
    for target, elements in references:
        for element in [elements] if isinstance(elements, str) else elements:
            found = element if target == owner else find_element(shape, _element_in(owner, target, element))
            if found and found.startswith("Solid"):
                names += _faces_of_solid(shape, int(found[5:]))
            elif found and _exists(shape, found):
                names.append(found)
            else:
                raise Error(f"{target.Label}.{element}: is not in the meshed part", "usage", element)
    return names


def _element_in(owner, target, name: str):
    """The shape of an element of another object, where the owner's shape has it; None when there is none."""
    try:
        solids = target.Shape.Solids if name.startswith("Solid") else ()
        element = solids[int(name[5:]) - 1] if solids else target.getSubObject(name)
    except (Part.OCCError, AttributeError, IndexError, RuntimeError, ValueError):
        return None
    # The features of a Body have its coordinates, the Body's own shape those of what holds it.
    if element is not None and target in getattr(owner, "Group", ()):
        element = element.copy()
        element.Placement = owner.Placement.multiply(element.Placement)
    return element


#: Lengths differ by less than this share of the shape's diagonal where two shapes are equal but for rounding.
_ROUNDING = 1e-7
_KINDS = {"Solid": "Solids", "Face": "Faces", "Edge": "Edges", "Vertex": "Vertexes"}


def find_element(shape, element) -> Optional[str]:
    """The name of the solid, face, edge or vertex of a shape that an element of an equal shape is, or None. By geometry
    where it is not the same one: shapes are computed anew, and then differ by rounding."""
    kind = getattr(element, "ShapeType", "")
    if kind not in _KINDS:
        return None
    candidates = getattr(shape, _KINDS[kind])
    for index, candidate in enumerate(candidates, 1):
        if candidate.isSame(element):
            return f"{kind}{index}"
    tolerance = _ROUNDING * max(shape.BoundBox.DiagonalLength, 1e-300)
    wanted = _measures(element)
    for index, candidate in enumerate(candidates, 1):
        if all(abs(a - b) <= tolerance for a, b in zip(_measures(candidate), wanted)):
            return f"{kind}{index}"
    return None


def _measures(element) -> List[float]:
    """Lengths that tell an element from the others of its shape."""
    if element.ShapeType == "Vertex":
        return list(element.Point)
    box = element.BoundBox
    measures = [*element.CenterOfMass, box.XMin, box.XMax, box.YMin, box.YMax, box.ZMin, box.ZMax]
    return [*measures, element.Length if element.ShapeType == "Edge" else math.sqrt(abs(element.Area))]


def _exists(shape, name: str) -> bool:
    kind = name.rstrip("0123456789")
    return kind in _KINDS and 1 <= int(name[len(kind):] or 0) <= len(getattr(shape, _KINDS[kind]))


def _faces_of_solid(shape, number: int) -> List[str]:
    if not 1 <= number <= len(shape.Solids):
        raise Error(f"Solid{number}: is not in the meshed part", "usage", f"Solid{number}")
    faces = shape.Solids[number - 1].Faces
    return [f"Face{i}" for i, face in enumerate(shape.Faces, 1) if any(face.isSame(other) for other in faces)]
