# SPDX-License-Identifier: GPL-3.0-or-later
"""What the workbench needs from Part shapes: whether a shape has changed, shapes with reversed faces, and the names of
referenced faces, edges and vertices. Runs inside FreeCAD."""

import hashlib
import math
from typing import Any, Dict, Iterable, List, Optional, Sequence, Tuple

import Part

from ..core.errors import Error
from . import translate


def check_size(shape, sizes: Iterable[float]) -> None:
    """Raises Error if an element size is not possible for a shape. The first is the global size, which the mesher refuses if it is
    larger than the model."""
    size, *_ = sizes = list(sizes)
    diagonal, least = shape.BoundBox.DiagonalLength, min(sizes)
    if not least > 1e-9 * diagonal:
        raise Error(translate(
            "Quadrille", "a size of {:.3g} mm is too small for a part of {:.3g} mm").format(least, diagonal), "usage", "Size")
    if size > diagonal:
        raise Error(translate(
            "Quadrille", "a size of {:.3g} mm is larger than the model, whose diagonal is {:.3g} mm").format(size, diagonal), "usage", "Size")


_last_fingerprint: List[Tuple[Any, List[float]]] = []


def fingerprint(shape) -> List[float]:
    """Numbers that change when a shape changes: its vertices, edge lengths, and the areas, centers and orientations of its faces.

    BREP text is not suitable: it contains the display triangulation and flags of checks. The fingerprint of the last shape is
    cached.
    """
    if _last_fingerprint and _last_fingerprint[0][0].isEqual(shape):
        return list(_last_fingerprint[0][1])
    numbers = [float(len(shape.Faces)), float(len(shape.Edges)), float(len(shape.Vertexes))]
    for vertex in shape.Vertexes:
        numbers += tuple(vertex.Point)
    for edge in shape.Edges:
        numbers.append(0.0 if edge.Degenerated else edge.Length)
    for face in shape.Faces:
        numbers += [face.Area, *tuple(face.CenterOfMass), -1.0 if face.Orientation == "Reversed" else 1.0]
    _last_fingerprint[:] = [(shape, list(numbers))]
    return numbers


def same_fingerprint(one: Sequence[float], other: Sequence[float]) -> bool:
    """True if two fingerprints agree except for rounding."""
    if len(one) != len(other):
        return False
    scale = max((abs(number) for number in one), default=1.0)
    return all(abs(a - b) <= 1e-9 * scale for a, b in zip(one, other))


def with_reversed_faces(shape, names: Sequence[str]):
    """A shape with the named faces reversed and the same numbering. The shape itself if there are no names."""
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
        raise Error(translate(
            "Quadrille", "{}: the part has no such face to flip").format(sorted(reverse)[0]), "usage", sorted(reverse)[0])
    compound = Part.makeCompound(faces)
    for kind in ("Faces", "Edges", "Vertexes"):
        before, after = getattr(shape, kind), getattr(compound, kind)
        if len(before) != len(after) or not all(a.isSame(b) for a, b in zip(before, after)):
            raise Error(translate(
                "Quadrille", "the normals cannot be flipped: the part has edges or vertices that belong to no face"),
                        "failure")
    return compound


def pairs(links: Iterable[Tuple]) -> List[Tuple[Any, str]]:
    """Links to elements as pairs (object, name). FreeCAD gives a single name as a text."""
    return [(target, name) for target, names in links for name in ((names,) if isinstance(names, str) else names)]


def references_to_names(shape, owner, references: Sequence[Tuple]) -> List[str]:
    """FEM references as names in the meshed shape ("Face3"). Elements of other objects are found by their geometry; a solid
    gives its faces."""
    names: List[str] = []
    for target, element in pairs(references):
        found = element if target == owner else find_element(shape, _element_in(owner, target, element))
        if found and found.startswith("Solid"):
            names += _faces_of_solid(shape, int(found[5:]))
        elif found and has_element(shape, found):
            names.append(found)
        else:
            raise Error(translate(
                "Quadrille", "{}.{}: is not in the meshed part").format(target.Label, element), "usage", element)
    return names


def _element_in(owner, target, name: str):
    """The shape of another object's element, placed as in the owner's shape; None if there is no such element."""
    try:
        solids = target.Shape.Solids if name.startswith("Solid") else ()
        element = solids[int(name[5:]) - 1] if solids else target.getSubObject(name)
    except (Part.OCCError, AttributeError, IndexError, RuntimeError, ValueError):
        return None
    # A Body's features are in the Body's coordinates, the Body's own shape in those of its container.
    if element is not None and target in getattr(owner, "Group", ()):
        element = element.copy()
        element.Placement = owner.Placement.multiply(element.Placement)
    return element


#: Two shapes are equal except for rounding if lengths differ by less than this share of the shape's diagonal.
_ROUNDING = 1e-7
_KINDS = {"Solid": "Solids", "Face": "Faces", "Edge": "Edges", "Vertex": "Vertexes"}


def find_element(shape, element) -> Optional[str]:
    """The name in a shape of an element (solid, face, edge or vertex) of an equal shape, or None. If the very same element is
    not found, it is found by geometry, since recomputed shapes differ by rounding."""
    kind = getattr(element, "ShapeType", "")
    if kind not in _KINDS:
        return None
    candidates = getattr(shape, _KINDS[kind])
    for index, candidate in enumerate(candidates, 1):
        if candidate.isSame(element):
            return f"{kind}{index}"
    found = Elements(shape).find(kind, measures(element))
    return found[0] if found else None


class Elements:
    """The solids, faces, edges and vertices of a shape, by name and by their measures. FreeCAD makes new lists at each access;
    here they are cached."""

    def __init__(self, shape) -> None:
        self._shape = shape
        self._lists: Dict[str, List] = {}
        self._tolerance = _ROUNDING * max(shape.BoundBox.DiagonalLength, 1e-300)

    def all(self, kind: str) -> List:
        """All elements of a kind ("Face")."""
        if kind not in self._lists:
            self._lists[kind] = getattr(self._shape, _KINDS[kind])
        return self._lists[kind]

    def measures_of(self, name: str) -> List[float]:
        """The measures of an element; empty if there is none of that name."""
        kind = name.rstrip("0123456789")
        if kind not in _KINDS or not 1 <= int(name[len(kind):] or 0) <= len(self.all(kind)):
            return []
        return measures(self.all(kind)[int(name[len(kind):]) - 1])

    def is_as_measured(self, name: str, wanted: Sequence[float]) -> bool:
        """True if an element has these measures except for rounding."""
        return _alike(self.measures_of(name), wanted, self._tolerance)

    def find(self, kind: str, wanted: Sequence[float]) -> List[str]:
        """The names of the elements of a kind that have these measures except for rounding."""
        return [f"{kind}{index}" for index, candidate in enumerate(self.all(kind), 1)
                if _alike(measures(candidate), wanted, self._tolerance)]


def _alike(one: Sequence[float], other: Sequence[float], tolerance: float) -> bool:
    return len(one) == len(other) > 0 and all(abs(a - b) <= tolerance for a, b in zip(one, other))


def topology(shape) -> str:
    """A digest of a shape's topology: the edges of each face and the vertices of each edge, by number, the orientation of faces,
    and the types of surfaces and curves. Equal for two shapes that differ only in measures."""
    known: Dict[int, List[Tuple[Any, int]]] = {}
    count = 0

    def number(part) -> int:
        nonlocal count
        alike = known.setdefault(part.hashCode(), [])
        for other, index in alike:
            if other.isSame(part):
                return index
        count += 1
        alike.append((part, count))
        return count

    digest = hashlib.sha1()
    for edge in shape.Edges:
        kind = "none" if edge.Degenerated else edge.Curve.TypeId
        digest.update(f"{kind} {[number(vertex) for vertex in edge.Vertexes]} {number(edge)};".encode())
    for face in shape.Faces:
        digest.update(f"{face.Surface.TypeId} {face.Orientation} {[number(edge) for edge in face.Edges]};".encode())
    return digest.hexdigest()


def measures(element) -> List[float]:
    """Numbers, all lengths, that distinguish an element from the others of its shape."""
    if element.ShapeType == "Vertex":
        return list(element.Point)
    if element.ShapeType == "Edge" and element.Degenerated:
        return []
    size = element.Length if element.ShapeType == "Edge" else math.sqrt(abs(element.Area))
    # Not the bounding box: for a curved face it depends on whether the face has been drawn already.
    scale = max(abs(element.Mass) * size, 1e-300)
    inertia = element.MatrixOfInertia
    spread = [value / scale for value in (inertia.A11, inertia.A22, inertia.A33, inertia.A12, inertia.A13, inertia.A23)]
    return [*element.CenterOfMass, size, *spread]


def has_element(shape, name: str) -> bool:
    """Whether a shape has the face, edge or vertex of this name."""
    kind = name.rstrip("0123456789")
    return kind in _KINDS and 1 <= int(name[len(kind):] or 0) <= len(getattr(shape, _KINDS[kind]))


def _faces_of_solid(shape, number: int) -> List[str]:
    if not 1 <= number <= len(shape.Solids):
        raise Error(translate(
            "Quadrille", "Solid{}: is not in the meshed part").format(number), "usage", f"Solid{number}")
    return faces_of_solids(shape)[number - 1]


def faces_of_solids(shape) -> List[List[str]]:
    """The faces ("Face3") of each solid of a shape."""
    faces = shape.Faces
    numbers: Dict[int, List[int]] = {}  # by hash: equal faces have equal ones, and a few others may
    for number, face in enumerate(faces, 1):
        numbers.setdefault(face.hashCode(), []).append(number)
    return [[f"Face{number}" for face in solid.Faces for number in numbers.get(face.hashCode(), ()) if faces[number - 1].isSame(face)]
            for solid in shape.Solids]
