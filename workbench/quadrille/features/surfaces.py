# SPDX-License-Identifier: GPL-3.0-or-later
"""Quad meshes of FreeCAD's triangle mesh objects, such as scans and STL files. The triangles go to `quadrille remesh` as a PLY
file, and the mesh comes back as a UNV file with its groups. Runs inside FreeCAD."""

import json
import math
import os
from pathlib import Path
from typing import Dict, List, NamedTuple, Optional, Sequence, Tuple, Union

import FreeCAD

from ..core import observers
from ..core.command import MeshJob, Progress, scratch_folder
from ..core.errors import Error
from ..core.jobs import FemJob, find_mesher, in_own_words
from ..core.prepared import Prepared
from ..core.setting_table import ORDERS, MeshSettings, default_size
from ..document import groups, state, translate, undo
from ..solvers import results, wrappers
from . import views
from . import mesh_object as core


class Asked(NamedTuple):
    """How a surface is to be meshed."""

    size: float = 0  #: mm; 0 = 1/60 of the surface's diagonal
    order: int = 2
    feature_angle: float = 40  #: degrees; 0 = the surface is not split into faces at folds
    merge: float = 0  #: nodes at most this far apart are merged, mm


def is_mesh_object(obj) -> bool:
    """True for FreeCAD's mesh objects, which consist of triangles."""
    return hasattr(obj, "isDerivedFrom") and obj.isDerivedFrom("Mesh::Feature")


def check_surface(surface, analysis=None) -> None:
    """Raises Error if `surface` is not a mesh object that can be meshed, or if the analysis cannot take its mesh."""
    label, name = getattr(surface, "Label", surface), getattr(surface, "Name", "")
    if not is_mesh_object(surface):
        raise Error(translate(
            "Quadrille", "{}: is not a mesh object; select one, such as an STL file that was imported").format(label), "usage", name)
    if not surface.Mesh.CountFacets:
        raise Error(translate("Quadrille", "{}: has no triangles to mesh").format(label), "usage", name)
    core.check_analysis(analysis)


def usual_size(surface) -> float:
    """The default element size for a mesh object, in mm, rounded to two digits."""
    return float(f"{default_size(surface.Mesh.BoundBox.DiagonalLength):.2g}")


def make(surface, asked: Asked, name: str = "QuadMesh", analysis=None, progress: Optional[Progress] = None,
         command: Optional[str] = None):
    """Meshes a mesh object and adds the mesh to its document, see quadrille.freecad.mesh_surface()."""
    check_surface(surface, analysis)
    asked = asked._replace(size=asked.size or usual_size(surface))
    job = _meshed(surface, asked, progress, command)
    fem_mesh, report = job.result()
    mesh = surface.Document.addObject("Fem::FemMeshObjectPython", name)
    SurfaceMesh(mesh)
    mesh.Surface = surface
    window = views.window()
    if window is not None:
        window.show_surface_mesh(mesh)
    _ask(mesh, asked)
    if analysis is not None:
        analysis.addObject(mesh)
    _store(mesh, fem_mesh, report, job)
    return mesh


def prepare(surface, asked: Asked, progress: Optional[Progress] = None) -> None:
    """Makes the mesh for the mesh_surface() or remesh() call that follows immediately. Errors are thus raised before the
    document changes."""
    _prepared.make(_key(surface, asked), lambda: _meshed(surface, asked, progress, None))


def asked_of(mesh) -> Asked:
    """The settings in a mesh object's properties."""
    return Asked(mesh.Size.Value, ORDERS.index(mesh.ElementOrder) + 1, mesh.FeatureAngle.Value, mesh.MergeDistance.Value)


def judge(mesh) -> Tuple[str, str]:
    """The status of a mesh, and a sentence with the reason."""
    surface = mesh.Surface
    if surface is None:
        return state.PART_GONE, state.PART_GONE
    if not mesh.FemMesh.FaceCount:
        return state.NOT_MESHED, state.NOT_MESHED
    if not mesh.MeshedShape:
        return state.OTHER_MEANS, state.OTHER_MEANS
    other_surface = not _same(list(mesh.MeshedShape), fingerprint(surface))
    if _text(asked_of(mesh)) != mesh.MeshedSettings:
        now = state.BOTH_CHANGED if other_surface else state.SETTINGS_CHANGED
    else:
        now = state.PART_CHANGED if other_surface else state.UP_TO_DATE
    return now, now


def fingerprint(surface) -> List[float]:
    """Numbers that change when a triangle mesh changes: counts, bounding box, area, volume, center."""
    mesh = surface.Mesh
    box = mesh.BoundBox
    length = max(box.DiagonalLength, 1e-300)
    center = mesh.CenterOfGravity
    return [float(mesh.CountPoints), float(mesh.CountFacets), box.XMin, box.YMin, box.ZMin, box.XMax, box.YMax, box.ZMax,
            mesh.Area / length, mesh.Volume / length**2, center.x, center.y, center.z]


def _same(one: Sequence[float], other: Sequence[float]) -> bool:
    scale = max((abs(number) for number in one[2:]), default=1.0)
    return len(one) == len(other) and one[:2] == other[:2] and all(
        abs(a - b) <= 1e-6 * scale for a, b in zip(one[2:], other[2:]))


class SurfaceJob(FemJob):
    """The meshing of a mesh object in a child process."""

    def __init__(self, surface, asked: Asked, command: Optional[str] = None,
                 outputs: Sequence[Union[str, Path]] = ()) -> None:
        self.made_of = (fingerprint(surface), _text(asked))
        command = find_mesher(command)
        folder = scratch_folder()
        model, output = (os.path.join(folder.name, name) for name in ("surface.ply", "mesh.unv"))
        surface.Mesh.write(model)  # single precision, like FreeCAD's meshes
        self._told_as = ((model, surface.Label), ("triangles and points counted from 0, as they come in the file",
                                                  "triangles and points counted from 0"),
                         ("the property Force meshes anyway", "take a larger Size"))
        work = ("remesh", "--feature-angle", repr(float(asked.feature_angle)), "--merge", repr(float(asked.merge)))
        settings = MeshSettings(size=float(asked.size), order=int(asked.order))
        super().__init__(command, folder, output, MeshJob(model, [output, *outputs], settings, command, None, work))

    def wait(self, progress: Optional[Progress] = None) -> None:
        """Waits for the end and passes progress on. Errors name the mesh object and its properties, not files and options."""
        try:
            super().wait(progress)
        except Error as error:
            sentence = str(error)
            for theirs, ours in self._told_as:
                sentence = sentence.replace(theirs, ours)
            raise Error(sentence, error.kind, error.subject) from error


def start(mesh, command: Optional[str] = None, outputs: Sequence[Union[str, Path]] = ()) -> SurfaceJob:
    """Starts to mesh the surface of a mesh object with the settings in its properties."""
    if mesh.Surface is None:
        raise Error(translate(
            "Quadrille", "{}: the mesh object that it meshes is gone").format(mesh.Label), "usage", mesh.Name)
    check_surface(mesh.Surface)
    return _start(mesh.Surface, asked_of(mesh), command, outputs)


def _start(surface, asked: Asked, command: Optional[str], outputs: Sequence[Union[str, Path]] = ()) -> SurfaceJob:
    if not (asked.size > 0 and math.isfinite(asked.size)):
        raise Error(translate(
            "Quadrille", "{}: cannot be meshed at size {:g}: it must be larger than 0").format(surface.Label, asked.size), "usage", "Size")
    return SurfaceJob(surface, asked, command, outputs).start()


#: The finished job whose mesh has not been used yet, by surface and settings.
_prepared: Prepared[SurfaceJob] = Prepared()


def _key(surface, asked: Asked) -> Tuple:
    return (surface.Document.Name, surface.Name, _text(asked))


def _text(asked: Asked) -> str:
    return json.dumps({name: float(value) for name, value in asked._asdict().items()})


def _meshed(surface, asked: Asked, progress: Optional[Progress], command: Optional[str]) -> SurfaceJob:
    """A job that has succeeded: the one that prepare() has left, or a new one."""
    job = _prepared.take(_key(surface, asked))
    if job is not None and _same(job.made_of[0], fingerprint(surface)):
        return job
    job = _start(surface, asked, command)
    job.wait(progress)
    job.result()
    return job


def _ask(mesh, asked: Asked) -> None:
    mesh.Size, mesh.FeatureAngle, mesh.MergeDistance = asked.size, asked.feature_angle, asked.merge
    mesh.ElementOrder = ORDERS[asked.order - 1]


def _store(mesh, fem_mesh, report: Dict, job: SurfaceJob) -> None:
    undo.put(mesh, fem_mesh)
    mesh.MeshedShape, mesh.MeshedSettings = job.made_of
    mesh.Status = judge(mesh)[0]
    core.store_quality(mesh, fem_mesh, report)
    fidelity = report.get("fidelity", {})
    mesh.OffSurface = fidelity.get("mesh_from_surface", {}).get("distance", 0.0)
    for note in report.get("warnings", ()):
        FreeCAD.Console.PrintWarning(f"{mesh.Label}: {in_own_words(note)}\n")


class SurfaceMesh:
    """The Python side of a mesh made of a mesh object: its properties."""

    __module__ = "quadrille.surfaces"  # saved documents refer to the class by this name: do not change it
    Type = state.SURFACE_TYPE
    BaseType = "Fem::BaseFemPythonObject"

    judge = staticmethod(judge)
    start = staticmethod(start)

    def __init__(self, obj) -> None:
        obj.Proxy = self
        self.add_properties(obj)
        self._watch()

    @staticmethod
    def _watch() -> None:
        groups.watch(results.hint_at_surfaces)  # drops the meshes of closed documents
        observers.watch(_Watcher)
        wrappers.wrap_solvers(state.complaint)

    @staticmethod
    def add_properties(obj) -> None:
        """Adds missing properties, so that documents of older versions gain new ones."""
        for kind, name, group, text in (
            ("App::PropertyLinkGlobal", "Surface", "Mesh", "The mesh object that is remeshed"),
            ("App::PropertyLength", "Size", "Mesh", "Length of elements"),
            ("App::PropertyEnumeration", "ElementOrder", "Mesh", "2nd: eight-node quads, 1st: four-node quads"),
            ("App::PropertyAngle", "FeatureAngle", "Mesh", "Smallest angle between neighboring triangles of two different "
             "faces; 0 = the whole surface is one face"),
            ("App::PropertyLength", "MergeDistance", "Mesh", "Nodes at most this far apart are merged; 0 = only coincident nodes"),
            ("App::PropertyFloat", "OffSurface", "Result", "Largest distance of the mesh from the surface, mm"),
            *core.RESULT_PROPERTIES,
        ):
            if name in obj.PropertiesList:
                continue
            obj.addProperty(kind, name, group, text)
            if name == "ElementOrder":
                obj.ElementOrder = list(reversed(ORDERS))
            core.set_default(obj, name)
            if group in ("Result", "Hidden"):
                obj.setEditorMode(name, 1 if group == "Result" else 2)
        state.name_statuses(obj)

    def execute(self, obj) -> None:
        """FreeCAD calls this when the surface or a setting has changed. Reports the change and leaves the mesh as it is."""
        state.tell_change(obj)

    @staticmethod
    def remesh(obj, progress: Optional[Progress] = None, command: Optional[str] = None) -> None:
        """Meshes the surface again with the settings in the properties. On an Error the object keeps its old mesh."""
        if obj.Surface is None:
            raise Error(translate(
                "Quadrille", "{}: the mesh object that it meshes is gone").format(obj.Label), "usage", obj.Name)
        check_surface(obj.Surface)
        job = _meshed(obj.Surface, asked_of(obj), progress, command)
        fem_mesh, report = job.result()
        _store(obj, fem_mesh, report, job)

    def onDocumentRestored(self, obj) -> None:
        """FreeCAD calls this after a document was read."""
        self.add_properties(obj)
        self._watch()

    # All state is in the document's properties. FreeCAD 0.20 calls the second pair, 1.0 the first.
    def dumps(self):
        """Nothing to save."""
        return None

    def loads(self, _state) -> None:
        """Nothing to restore."""

    __getstate__ = dumps
    __setstate__ = loads


class _Watcher:
    """A document observer. It restores meshes after an undo, since FreeCAD restores everything but the mesh, see undo.py."""

    def slotUndoDocument(self, document) -> None:
        """FreeCAD calls this after an undo."""
        for obj in document.Objects:
            if state.is_surface_mesh(obj) and "MeshToken" in obj.PropertiesList:
                undo.bring_back(obj)
                obj.Proxy.execute(obj)

    slotRedoDocument = slotUndoDocument
