# SPDX-License-Identifier: GPL-3.0-or-later
"""What the workbench needs from Part shapes: the number of quads at a size, whether a shape has changed, shapes with reversed
faces, and the names of referenced faces, edges and vertices. Runs inside FreeCAD."""

import hashlib
import math
from typing import Any, Dict, Iterable, Iterator, List, Mapping, Optional, Sequence, Tuple

import Part
import numpy as np

from ..core.errors import Error

#: Curvature samples per face and parameter direction; fewer for shapes with more than _MANY_FACES faces.
_SAMPLES, _FEW_SAMPLES, _MANY_FACES = 8, 4, 300
#: Number of faces or edges measured per step.
_STEP = 25


class SizeEstimate:
    """Estimates how many quads the faces of a shape get at a size. Measures faces and edges once; each estimate is then quick.

    Where an edge is finer than an adjacent face, the size grows from the edge into the face. Curvature is sampled on faces:
    in a strip narrower than an eighth of its face (a quarter if there are many faces), such as a wing's nose, it is missed.
    """

    def __init__(self, shape) -> None:
        for _ in self._measure(shape):
            pass

    @classmethod
    def in_steps(cls, shape) -> Iterator["SizeEstimate"]:
        """Yields the same estimate after every few milliseconds of measuring. It can be used after the last yield."""
        estimate = cls.__new__(cls)
        yield estimate
        for _ in estimate._measure(shape):
            yield estimate

    def _measure(self, shape) -> Iterator[None]:
        faces = shape.Faces
        yield
        edges = shape.Edges
        samples = _SAMPLES if len(faces) <= _MANY_FACES else _FEW_SAMPLES
        self._diagonal = shape.BoundBox.DiagonalLength
        numbers: Dict[int, List[Tuple[object, int]]] = {}
        lengths, bends = [], []
        for index, edge in enumerate(edges):
            point = edge.Degenerated
            lengths.append(0.0 if point else edge.Length)
            bends.append(0.0 if point else _curvature_of_edge(edge))
            if not point:
                numbers.setdefault(edge.hashCode(), []).append((edge, index))
            if index % _STEP == 0:
                yield
        areas, pieces, sides = [], [], []
        for index, face in enumerate(faces):
            areas.append(face.Area)
            pieces += [(index, *piece) for piece in _curvatures(face, areas[-1], samples)]
            for wire, widening in _wires(face):
                sides += [(index, number, widening) for edge in wire.Edges
                          for same, number in numbers.get(edge.hashCode(), ()) if same.isSame(edge)]
            if index % _STEP == 0:
                yield
        self._areas, self._lengths, self._edge_curvatures = np.array(areas), np.array(lengths), np.array(bends)
        self._pieces = _columns(pieces, 3)  # face, area, curvature
        self._sides = _columns(sides, 3)  # face, edge, how much the margin along it widens per length and distance
        # A neighboring face is as fine at the edge as its curvature requires.
        typical = self._typical_curvatures()[self._column(self._sides, 0)]
        np.maximum.at(self._edge_curvatures, self._column(self._sides, 1), typical)
        self._reaches = self._reach()

    @property
    def area(self) -> float:
        """The total area of all faces."""
        return float(self._areas.sum())

    @staticmethod
    def _column(table, index: int):
        return table[:, index].astype(int)

    def _typical_curvatures(self):
        """The root mean square curvature over each face's area: the average for its elements."""
        total = np.bincount(self._column(self._pieces, 0), self._pieces[:, 1] * self._pieces[:, 2] ** 2, self._areas.size)
        return np.sqrt(total / np.maximum(self._areas, 1e-300))

    def _reach(self):
        """For each face, the width at which margins of equal width along all its edges fill it."""
        face, length = self._column(self._sides, 0), self._lengths[self._column(self._sides, 1)]
        border = np.bincount(face, length, self._areas.size)
        widening = np.bincount(face, length * self._sides[:, 2], self._areas.size) / 2
        return 2 * self._areas / np.maximum(border + np.sqrt(border**2 + 4 * widening * self._areas), 1e-300)

    def quads(self, *asked, **named) -> int:
        """The expected number of quads, see quads_by_face()."""
        return round(sum(self.quads_by_face(*asked, **named).values()))

    def quads_by_face(
        self,
        size: float,
        size_min: Optional[float] = None,
        elements_per_circle: float = 12,
        sizes: Optional[Mapping[str, float]] = None,
        faces: Sequence[str] = (),
        growth: float = 0.3,
    ) -> Dict[str, float]:
        """The expected number of quads on each face that is meshed. Raises Error if a size makes no sense for this shape."""
        smallest = size_min or size / 8
        sizes = sizes or {}
        least = min([size, *sizes.values()])
        if not least > 1e-9 * self._diagonal:
            raise Error(f"a size of {least:.3g} mm is too small for a part of {self._diagonal:.3g} mm", "usage",
                        "Size")
        if size > self._diagonal:  # the mesher refuses it
            raise Error(f"a size of {size:.3g} mm is larger than the model, whose diagonal is {self._diagonal:.3g} mm", "usage",
                        "Size")

        def caps(kind: str, count: int):
            return np.array([min(size, sizes.get(f"{kind}{index}", size)) for index in range(1, count + 1)]) if sizes else \
                np.full(count, size)

        def size_of(cap, curvature):
            if not elements_per_circle:
                return cap
            by_curvature = 2 * math.pi / (np.maximum(curvature, 1e-300) * elements_per_circle)
            return np.where(curvature > 0, np.minimum(cap, np.maximum(smallest, by_curvature)), cap)

        count, face = self._areas.size, self._column(self._pieces, 0)
        inside = np.bincount(face, self._pieces[:, 1] / size_of(caps("Face", count)[face], self._pieces[:, 2]) ** 2, count)
        coarse = np.where(inside > 0, np.sqrt(self._areas / np.where(inside > 0, inside, 1)), size)
        face, edge, widening = self._column(self._sides, 0), self._column(self._sides, 1), self._sides[:, 2]
        length = self._lengths[edge]
        fine = size_of(caps("Edge", self._lengths.size), self._edge_curvatures)[edge]
        fine = np.minimum(fine, np.maximum(length, smallest))
        margins = length * _margins(fine, coarse[face], self._reaches[face], growth, widening)
        border = np.bincount(face, length / np.minimum(fine, coarse[face]), count)
        inside += np.bincount(face, margins, count)
        counts = np.maximum(4.0, np.maximum(border, inside))  # at least two rows of quads even on the narrowest strip
        names = {f"Face{index + 1}": float(quads) for index, quads in enumerate(counts)}
        return {name: names[name] for name in names if name in faces} if faces else names

    def suggested(self, quads: int = 5000, elements_per_circle: float = 12) -> float:
        """The size that gives about this many quads, rounded to two digits."""
        low, high = self._diagonal * 1e-5, self._diagonal / 2
        for _ in range(30):
            middle = math.sqrt(low * high)
            if self.quads(middle, None, elements_per_circle) > quads:
                low = middle
            else:
                high = middle
        digits = 1 - math.floor(math.log10(high))
        return round(high, digits)


_last_estimate: List[Tuple[object, SizeEstimate]] = []


def estimate_of(shape) -> SizeEstimate:
    """The estimate of a shape. The estimate of the last shape is cached."""
    for _ in estimate_in_steps(shape):
        pass
    return _last_estimate[0][1]


def estimate_in_steps(shape) -> Iterator[None]:
    """Makes the estimate of a shape in steps of a few milliseconds. After the last step, estimate_of() returns it at once."""
    if _last_estimate and _last_estimate[0][0].isSame(shape):
        return
    for estimate in SizeEstimate.in_steps(shape):
        yield
    _last_estimate[:] = [(shape, estimate)]


def _wires(face) -> List[Tuple[object, float]]:
    """The wires of a face, and how much a margin along each widens: around a hole it gets longer with distance. For a face
    with one wire, the face itself stands for the wire."""
    if face.countElement("Wire") == 1:
        return [(face, 0.0)]
    outer = face.OuterWire
    return [(wire, 0.0 if wire.isSame(outer) else 2 * math.pi / max(wire.Length, 1e-300)) for wire in face.Wires]


def _columns(rows: Sequence[Tuple], width: int):
    return np.array(rows, dtype=float).reshape(-1, width)


def _curvature_of_edge(edge) -> float:
    curve = edge.Curve
    if isinstance(curve, Part.Line):
        return 0.0
    if isinstance(curve, Part.Circle):
        return 1 / curve.Radius
    first, last = edge.ParameterRange
    curvature = 0.0
    for share in (0.1, 0.5, 0.9):
        try:
            curvature = max(curvature, edge.curvatureAt(first + share * (last - first)))
        except (Part.OCCError, RuntimeError):  # a kink has no curvature
            continue
    return curvature


def _margins(fine, coarse, width, growth: float, widening):
    """Additional quads per length of an edge where the size grows from `fine` at the edge to `coarse` inside. Around a hole the
    margin widens with the distance. All arguments but `growth` are arrays with one entry per edge of a face."""
    width = np.minimum(width, (coarse - fine) / growth)
    far = fine + growth * np.maximum(width, 0)
    wider = (np.log(far / fine) + fine / far - 1) / growth**2
    return np.where(width > 0, (1 / fine - 1 / far) / growth + widening * wider
                    - (width + widening * width**2 / 2) / coarse**2, 0.0)


def _curvatures(face, area: float, samples: int) -> List[Tuple[float, float]]:
    """A face as pieces: the area of each piece and the larger principal curvature there."""
    surface = face.Surface
    if isinstance(surface, Part.Plane):
        return [(area, 0.0)]
    if isinstance(surface, (Part.Cylinder, Part.Sphere)):
        return [(area, 1 / surface.Radius)]
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


_last_fingerprint: List[Tuple[object, List[float]]] = []


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
        raise Error(f"{sorted(reverse)[0]}: the part has no such face to flip", "usage", sorted(reverse)[0])
    compound = Part.makeCompound(faces)
    for kind in ("Faces", "Edges", "Vertexes"):
        before, after = getattr(shape, kind), getattr(compound, kind)
        if len(before) != len(after) or not all(a.isSame(b) for a, b in zip(before, after)):
            raise Error("the normals cannot be flipped: the part has edges or vertices that belong to no face",
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
        elif found and _exists(shape, found):
            names.append(found)
        else:
            raise Error(f"{target.Label}.{element}: is not in the meshed part", "usage", element)
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
    known: Dict[int, List[Tuple[object, int]]] = {}
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


def _exists(shape, name: str) -> bool:
    kind = name.rstrip("0123456789")
    return kind in _KINDS and 1 <= int(name[len(kind):] or 0) <= len(getattr(shape, _KINDS[kind]))


def _faces_of_solid(shape, number: int) -> List[str]:
    if not 1 <= number <= len(shape.Solids):
        raise Error(f"Solid{number}: is not in the meshed part", "usage", f"Solid{number}")
    faces = shape.Solids[number - 1].Faces
    return [f"Face{i}" for i, face in enumerate(shape.Faces, 1) if any(face.isSame(other) for other in faces)]
