# SPDX-License-Identifier: GPL-3.0-or-later
"""The middle surface of a thin part as a document object: its faces with their thickness, for a shell analysis.

    import quadrille.middle
    middle = quadrille.middle.make_middle(App.ActiveDocument.Body, analysis=App.ActiveDocument.Analysis)
    mesh = quadrille.freecad.mesh_object(middle, size=3.0, analysis=App.ActiveDocument.Analysis)

When the part is recomputed, the `quadrille` command recomputes the surface in a child process. The thickness objects made
for the surface in an analysis are then updated. Runs inside FreeCAD."""

import contextlib
import os
from typing import Dict, List, NamedTuple, Optional, Sequence, Set, Tuple

import FreeCAD
import Part

from ..core import observers
from ..core.command import CommandJob, scratch_folder
from ..core.errors import QT_TRANSLATE_NOOP, Error
from ..core.jobs import find_mesher, in_own_words
from ..core.prepared import Prepared
from ..document import state, translate
from ..document.shapes import pairs
from . import views

#: The type of the Python side of our middle surfaces.
TYPE = "Part::QuadrilleMiddleSurface"
#: Property of our thickness objects: the name of the middle surface.
_MARK = "MiddleSurface"
#: A part looks thin if its thickness is below this share of its width. The mesher's own limit is a fifth, for each wall.
_THIN = 0.12
#: How an error's sentence continues if a part is thin only in places.
_PARTIAL = "--partial gives"


class _Result(NamedTuple):
    shape: "Part.Shape"
    told: Dict  #: the command's .json file


def make_middle(part, analysis=None, partial: bool = False, join: bool = False, name: str = "MiddleSurface",
                move_loads: bool = False):
    """Adds the middle surface of a thin part to its document.

    Args:
        part: a document object with a solid, or several.
        analysis: a FEM analysis to make thickness objects in.
        partial: if the part is thin only in places, use the walls that could be paired.
        join: treat solids that touch as one, as if welded.
        move_loads: move the analysis' loads and supports from the part's faces to the middle surface, see
            move_references().

    Returns:
        a Part::FeaturePython whose shape has the middle faces, and whose `Source` links to the part.

    Raises:
        Error: with one sentence; the document is then unchanged.
    """
    if analysis is not None and not analysis.isDerivedFrom("Fem::FemAnalysis"):
        raise Error(translate("Quadrille", "{}: is not a FEM analysis").format(analysis.Label), "usage", analysis.Name)
    result = _prepared.take(_key(part, partial, join)) or _compute(part, partial, join)
    middle = part.Document.addObject("Part::FeaturePython", name)
    MiddleSurface(middle)
    middle.Label = f"{part.Label} middle"
    middle.Source, middle.Partial, middle.Join = part, partial, join
    _store(middle, result)
    middle.purgeTouched()  # otherwise it would be computed again
    window = views.window()
    if window is not None:
        window.show_middle(middle)
    if analysis is not None:
        add_thicknesses(middle, analysis)
        for sentence in move_references(middle, analysis) if move_loads else ():
            FreeCAD.Console.PrintWarning(f"{sentence}\n")
    return middle


def prepare(part, partial: bool = False, join: bool = False) -> None:
    """Computes the result for the make_middle() call that follows immediately. Errors are thus raised before the document
    changes."""
    _prepared.make(_key(part, partial, join), lambda: _compute(part, partial, join))


def is_prepared(part, partial: bool = False, join: bool = False) -> bool:
    """Whether prepare() has computed the result for a part as it is."""
    return _prepared.has(_key(part, partial, join))


def is_partly_thin(error: Error) -> bool:
    """Whether `partial` would give a result for the part that raised this error."""
    return in_own_words(_PARTIAL) in str(error)


def is_middle(obj) -> bool:
    """True for the middle surfaces of this addon."""
    return getattr(getattr(obj, "Proxy", None), "Type", "") == TYPE


def looks_thin(shape, area: Optional[float] = None) -> Optional[float]:
    """The approximate wall thickness of a shape in mm if its solids look thin; else None. A quick estimate, only a hint. `area`:
    the total area of the faces if known, which is quicker."""
    if shape.isNull() or not shape.Solids:
        return None
    thickness = 2 * shape.Volume / max(shape.Area if area is None else area, 1e-300)
    box = shape.BoundBox
    width = sorted((box.XLength, box.YLength, box.ZLength))[1]
    return thickness if thickness < _THIN * width else None


# The thickness objects

def add_thicknesses(middle, analysis) -> List:
    """Makes one thickness object in an analysis for each thickness of a middle surface, and removes the surface's old ones."""
    import ObjectsFem

    for old in thickness_objects(middle):
        middle.Document.removeObject(old.Name)
    made = []
    for thickness, faces in _faces_by_thickness(middle):
        obj = ObjectsFem.makeElementGeometry2D(middle.Document, thickness, "Thickness")
        obj.addProperty("App::PropertyString", _MARK, "Quadrille", "The middle surface that it belongs to")
        setattr(obj, _MARK, middle.Name)
        obj.setEditorMode(_MARK, 1)
        obj.Label = f"{middle.Label}: {thickness:.6g} mm"
        obj.References = [(middle, tuple(faces))]
        analysis.addObject(obj)
        made.append(obj)
    return made


def thickness_objects(middle) -> List:
    """The thickness objects that were made for a middle surface."""
    return [obj for obj in middle.Document.Objects if getattr(obj, _MARK, None) == middle.Name]


def _faces_by_thickness(middle) -> List[Tuple[float, List[str]]]:
    groups: Dict[str, List[str]] = {}
    for number, thickness in enumerate(middle.Thicknesses, 1):
        groups.setdefault(f"{thickness:.6g}", []).append(f"Face{number}")
    return sorted((float(thickness), faces) for thickness, faces in groups.items())


def _update_thicknesses(middle) -> None:
    """Updates the thickness objects of a middle surface, if it has any."""
    present = thickness_objects(middle)
    if not present:
        return
    wanted = _faces_by_thickness(middle)
    now = sorted((float(obj.Thickness.getValueAs("mm")), [str(name) for _, names in obj.References for name in names])
                 for obj in present)
    if now == wanted:
        return
    analyses = [parent for obj in present for parent in obj.InList if parent.isDerivedFrom("Fem::FemAnalysis")]
    if len(present) == len(wanted):
        for obj, (thickness, faces) in zip(sorted(present, key=lambda obj: obj.Thickness.Value), wanted):
            obj.Thickness = f"{thickness!r} mm"
            obj.References = [(middle, tuple(faces))]
            obj.Label = f"{middle.Label}: {thickness:.6g} mm"
    elif analyses:
        add_thicknesses(middle, analyses[0])


# Loads and supports

def counterparts(middle, name: str) -> List[str]:
    """The elements of a middle surface that correspond to a face or solid of its part. For a solid: all middle faces. For a face:
    the middle faces between it and another face, or, if it is a rim, the free edges on it. Empty if there are none."""
    if name.startswith("Solid"):
        return [f"Face{i}" for i in range(1, len(middle.Thicknesses) + 1)]
    faces = [f"Face{i}" for i, between in enumerate(middle.Between, 1) if name in between.split(",")]
    if faces:
        return faces
    rims = (entry.split(":") for entry in middle.Rims)
    return [edge for edge, on in rims if name in on.split(",")]


def referring_to(part, analysis) -> List:
    """The members of an analysis that refer to a part, or to its faces, edges or vertices."""
    return [member for member in analysis.Group if hasattr(member, "References")
            and any(target == part for target, _ in pairs(member.References))]


def move_references(middle, analysis) -> List[str]:
    """Moves loads, supports and the like from a thin part's faces to its middle surface.

    A pressure keeps its direction. A member without a counterpart, such as a load on an edge of the part, is not changed.

    Returns:
        a sentence for each member that could not be moved.
    """
    left = []
    for member in referring_to(middle.Source, analysis):
        references: List[Tuple[object, str]] = []
        missing = []
        for target, name in pairs(member.References):
            if target != middle.Source:
                references.append((target, name))
                continue
            found = counterparts(middle, name)
            references += [(middle, element) for element in found]
            if not found:
                missing.append(name)
        turned = _turned(member, middle)
        if missing:
            left.append(f"{member.Label}: {', '.join(missing)} of {middle.Source.Label} has no counterpart on {middle.Label}")
        elif turned is None:
            left.append(f"{member.Label}: would act on the middle surface from both sides: create a pressure for each side")
        else:
            member.References = list(dict.fromkeys(references))
            if turned:
                member.Reversed = not member.Reversed
    return left


def _turned(member, middle) -> Optional[bool]:
    """Whether a pressure must be reversed on the middle surface, since the normals there are opposite. None if they are
    opposite on some of the faces only. False for other members."""
    if not member.isDerivedFrom("Fem::ConstraintPressure"):
        return False
    part, shell = middle.Source.Shape, middle.Shape
    turned: Set[bool] = set()
    for target, name in pairs(member.References):
        if target != middle.Source or not name.startswith("Face"):
            continue
        outer = part.getElement(name)
        for other in counterparts(middle, name):
            if other.startswith("Face"):
                face = shell.getElement(other)
                at = face.valueAt(*_inside(face))
                normal = face.normalAt(*face.Surface.parameter(at))
                turned.add(normal.dot(outer.normalAt(*outer.Surface.parameter(at))) < 0)
    return None if len(turned) > 1 else bool(turned and turned.pop())


def _inside(face) -> Tuple[float, float]:
    """The parameters (u, v) of a point inside a face."""
    low_u, high_u, low_v, high_v = face.ParameterRange
    for count in (2, 5, 12, 30):
        for i in range(1, count):
            for j in range(1, count):
                u, v = low_u + (high_u - low_u) * i / count, low_v + (high_v - low_v) * j / count
                if face.isPartOfDomain(u, v):
                    return u, v
    return 0.5 * (low_u + high_u), 0.5 * (low_v + high_v)


# The surface

_prepared: Prepared[_Result] = Prepared()


def _key(part, partial: bool, join: bool) -> Tuple[str, str, int, bool, bool]:
    hash_code = getattr(getattr(part, "Shape", None), "hashCode", None)
    number = hash_code() if hash_code is not None else 0  # another one after the part was recomputed
    return (part.Document.Name, part.Name, number, partial, join)


def _compute(part, partial: bool, join: bool) -> _Result:
    """Runs the command. Raises Error with the command's sentence if it fails."""
    shape, label = state.shape_of(part), part.Label
    if not shape.Solids:
        raise Error(translate(
            "Quadrille", "{}: has no solid; a middle surface is made of solids").format(label), "usage", part.Name)
    with scratch_folder() as folder:
        model, surface = (os.path.join(folder, file) for file in ("part.brep", "middle.brep"))
        shape.exportBrep(model)
        options = ["--partial"] * partial + ["--join"] * join
        job = _MiddleJob(["midsurface", model, "-o", surface, *options], find_mesher())
        try:
            with _progress(part) as progress:
                told = job.start().wait(progress)
        except Error as error:
            raise Error(_of_part(str(error), model, label), error.kind) from error
        middle = Part.Shape()
        middle.importBrep(surface)
        told["problems"] = [_of_part(problem, model, label) for problem in told["problems"] + told["warnings"]]
        return _Result(middle, told)


class _MiddleJob(CommandJob):
    """One run of `quadrille midsurface`, whose report is its .json file."""

    _cancelled_sentence = QT_TRANSLATE_NOOP("Quadrille", "the search for the middle surface was cancelled")
    _report_option = "-o"


def _progress(part):
    """Yields the function to call with the progress: in FreeCAD's window that of a bar with a Cancel button."""
    window = views.window()
    return window.progress_bar_for(part) if window is not None else contextlib.nullcontext()


def _of_part(sentence: str, model: str, label: str) -> str:
    """A sentence of the command, with the part's label instead of the file name, and in FreeCAD's words."""
    return in_own_words(sentence).replace(model, label).replace(os.path.basename(model), label)


def _store(obj, result: _Result) -> None:
    faces = result.told["faces"]
    obj.Shape = result.shape
    obj.Thicknesses = [face["thickness"] for face in faces]
    obj.Thinnest = [face["thickness_min"] for face in faces]
    obj.Thickest = [face["thickness_max"] for face in faces]
    obj.Between = [_names(face["solid_faces"]) for face in faces]
    obj.Rims = [f"{rim['name']}:{_names(rim['solid_faces'])}" for rim in result.told["rims"]]
    volume, held = max(result.told["volume"], 1e-300), result.told["area_times_thickness"]
    obj.Areas = [face["area"] for face in faces]
    obj.AreaTimesThickness, obj.VolumeShare = held, held / volume
    obj.VolumeShareOnce = (held - result.told["counted_twice"]) / volume
    obj.Parts, obj.Solids, obj.FreeEdges = (result.told[name] for name in ("parts", "solids", "free_edges"))
    obj.LeftOut = [f"Face{number}" for number in result.told["unpaired_solid_faces"]]
    obj.Problems = result.told["problems"]
    for sentence in obj.Problems:
        FreeCAD.Console.PrintWarning(f"{obj.Label}: {sentence}\n")


def _names(faces: Sequence[int]) -> str:
    return ",".join(f"Face{number}" for number in faces)


class MiddleSurface:
    """The Python side of a middle surface."""

    __module__ = "quadrille.middle"  # saved documents refer to the class by this name: do not change it
    Type = TYPE

    def __init__(self, obj) -> None:
        obj.Proxy = self
        self.add_properties(obj)
        observers.watch(_Watcher)

    @staticmethod
    def add_properties(obj) -> None:
        """Adds missing properties, so that documents of older versions gain new ones."""
        for kind, name, group, text in (
            ("App::PropertyLinkGlobal", "Source", "Middle surface", "The thin part"),
            ("App::PropertyBool", "Partial", "Middle surface", "Use the walls that could be paired if the part is thin in places only"),
            ("App::PropertyBool", "Join", "Middle surface", "Treat solids that touch as one part, as if welded"),
            ("App::PropertyFloatList", "Thicknesses", "Result", "Mean thickness of each face, mm"),
            ("App::PropertyFloatList", "Thinnest", "Result", "Smallest thickness of each face, mm"),
            ("App::PropertyFloatList", "Thickest", "Result", "Largest thickness of each face, mm"),
            ("App::PropertyStringList", "Between", "Result", "The faces of the part that each face lies between"),
            ("App::PropertyStringList", "Rims", "Result", "The faces of the part that free edges lie on"),
            ("App::PropertyFloatList", "Areas", "Result", "Area of each face, mm2"),
            ("App::PropertyFloat", "AreaTimesThickness", "Result", "Sum of area times thickness, mm3"),
            ("App::PropertyFloat", "VolumeShare", "Result", "Sum of area times thickness over the volume of the part"),
            ("App::PropertyFloat", "VolumeShareOnce", "Result", "The same, without volume counted twice where walls meet"),
            ("App::PropertyInteger", "Parts", "Result", "Number of connected parts of the surface"),
            ("App::PropertyInteger", "Solids", "Result", "Number of solids that have a middle surface"),
            ("App::PropertyInteger", "FreeEdges", "Result", "Number of free edges"),
            ("App::PropertyStringList", "LeftOut", "Result", "The faces of the part that are neither side nor rim of a wall"),
            ("App::PropertyStringList", "Problems", "Result", "Omissions, inaccuracies and errors, one sentence each"),
        ):
            if name not in obj.PropertiesList:
                obj.addProperty(kind, name, group, text)
                if group == "Result":
                    obj.setEditorMode(name, 1)

    def execute(self, obj) -> None:
        """FreeCAD calls this when the part or a property has changed."""
        if obj.Source is None:
            raise RuntimeError(f"{obj.Label}: the part is gone")
        try:
            _store(obj, _compute(obj.Source, obj.Partial, obj.Join))
        except Error as error:
            raise RuntimeError(str(error)) from error  # FreeCAD marks the object and shows the sentence
        _recomputed.add((obj.Document.Name, obj.Name))

    def onDocumentRestored(self, obj) -> None:
        """FreeCAD calls this after a document was read."""
        self.add_properties(obj)
        observers.watch(_Watcher)

    # All state is in the document's properties. FreeCAD 0.20 calls the second pair, 1.0 the first.
    def dumps(self):
        """Nothing to save."""
        return None

    def loads(self, _state) -> None:
        """Nothing to restore."""

    __getstate__ = dumps
    __setstate__ = loads


#: The middle surfaces that were recomputed, by the names of document and object.
_recomputed: Set[Tuple[str, str]] = set()


class _Watcher:
    """A document observer. It updates thickness objects after FreeCAD has recomputed, not during that."""

    def slotRecomputedDocument(self, document) -> None:
        """FreeCAD calls this when a document has been recomputed."""
        names = sorted(name for where, name in _recomputed if where == document.Name)
        for name in names:
            _recomputed.discard((document.Name, name))
            middle = document.getObject(name)
            if middle is not None:
                _update_thicknesses(middle)
