# SPDX-License-Identifier: GPL-3.0-or-later
"""Quad meshes of parts as document objects: made, remeshed, flipped and exported; scripts use them through quadrille.freecad.

The shape goes to the `quadrille` command as a BREP file, and the mesh comes back as a UNV file with its groups. The mesher
runs as a child process: it can neither freeze nor crash FreeCAD, and works with any build of FreeCAD. Runs inside FreeCAD."""

import os
from collections import OrderedDict
from pathlib import Path
from typing import Dict, List, Mapping, Optional, Sequence, Tuple, Union

import FreeCAD

from ..core.command import Progress, scratch_folder
from ..core.errors import Error
from ..core.jobs import ShapeJob
from ..core.prepared import Prepared
from ..core.setting_table import BY_NAME, SETTINGS, MeshSettings, face_name, property_help, property_kind, to_property, words
from ..core.units import millimeters
from ..document import containers, findings, groups, links, old_documents, shapes, state, translate, undo
from ..document.regions import refine
from ..document.state import UP_TO_DATE, Wanted, complaint, shape_of
from ..solvers import element_types, results, wrappers
from . import views
from .sizes import CountJob


def mesh_object(
    doc_object,
    size: Optional[float] = None,
    order: int = 2,
    name: str = "QuadMesh",
    analysis=None,
    progress: Optional[Progress] = None,
    command: Optional[str] = None,
    outputs: Sequence[Union[str, Path]] = (),
    picture: Optional[Union[str, Path]] = None,
    **settings,
):
    """Meshes the faces of a document object with quads and adds the mesh to its document.

    Args:
        doc_object: a document object with a shape.
        size: target edge length in mm, or with a unit ("2 cm"); None = 1/60 of the shape's diagonal.
        order: 2 for eight-node quads, which solvers need for shells; 1 for four-node quads.
        name: preferred name of the mesh object.
        analysis: a FEM analysis to add the mesh to.
        progress: called with the stage and the fraction of the work done; returning False cancels.
        command: path of the `quadrille` command; None = found by find_command().
        outputs: mesh files to write as well: .inp, .msh, .unv, .med, .vtu, .vtk, .bdf, .xdmf, .su2.
        picture: a .png file for a picture of the mesh.
        settings: any other setting of the table, by name: sizes={"Face3": 0.5}, faces=[3], sew=0.01, partial=True; see
            `quadrille settings`.

    Returns:
        a Fem::FemMeshObjectPython (FreeCAD 0.20) or Fem::FemMeshShapeBaseObjectPython (1.0) whose `Shape` links to
        doc_object. Its groups are named Face1..., Edge1..., Vertex1... as in FreeCAD.

    Raises:
        Error: with one sentence; the document is then unchanged.
    """
    wanted = _in_millimeters(MeshSettings(size=size, order=order, **settings))
    check_analysis(analysis)
    shape = shape_of(doc_object)
    job = ShapeJob(shape, wanted, command, outputs, picture)
    measured = shapes.fingerprint(shape)
    fem_mesh, report = job.start().wait_for_result(progress)
    mesh = _add_mesh(doc_object, name, wanted, analysis)
    job.made_of = (measured, state.settings_key(mesh, state.wanted_of(mesh), {}))
    _store_result(mesh, fem_mesh, report, job)
    return mesh


def make_mesh(doc_object, size: Optional[float] = None, order: int = 2, name: str = "QuadMesh", analysis=None,
              **settings):
    """Adds a mesh object for a document object without meshing it. The task panel or remesh() makes the mesh later."""
    wanted = _in_millimeters(MeshSettings(size=size, order=order, **settings))
    shape = shape_of(doc_object)
    check_analysis(analysis)
    names = [*map(face_name, wanted.get("faces", ())), *wanted.get("sizes", ())]
    shapes.references_to_names(shape, doc_object, links.link(doc_object, names))  # raises before anything is made
    return _add_mesh(doc_object, name, wanted, analysis)


def check_part(doc_object, analysis=None) -> None:
    """Raises Error if a document object cannot be meshed, or the analysis cannot take its mesh."""
    shape_of(doc_object)
    check_analysis(analysis)


def suggested_size(doc_object, quads: int = 5000, elements_per_circle: float = 12, **settings) -> float:
    """The size in mm that gives a document object about this many quads, rounded to three digits.

    Args:
        settings: other settings of the mesh, by name.
    """
    wanted = _in_millimeters(MeshSettings(elements_per_circle=elements_per_circle, **settings))
    return CountJob(shape_of(doc_object), wanted, wanted=quads).start().wait().size


def defaults() -> Dict[str, object]:
    """The settings of a new mesh object, by property."""
    return {setting["property"]: to_property(setting, None) for setting in SETTINGS if setting["property"]}


def fragments(parts: Sequence):
    """Joins several parts into one: FreeCAD's boolean fragments, which share faces, edges and vertices where parts touch."""
    from BOPTools import SplitFeatures

    for part in parts:
        shape_of(part)
    container = containers.common_container(parts)
    joined = SplitFeatures.makeBooleanFragments(name="Parts")
    if container is not None:  # else its links would go out of their scope, and its place would be another
        container.addObject(joined)
    joined.Objects = list(parts)
    joined.Document.recompute([joined])
    shape_of(joined)
    for part in parts:
        if part.ViewObject is not None:
            part.ViewObject.hide()
    return joined


def _add_mesh(doc_object, name: str, settings: MeshSettings, analysis):
    """Adds a mesh object with these settings, without a mesh."""
    mesh = doc_object.Document.addObject(_mesh_type(), name)
    MeshFeature(mesh)
    mesh.Shape = doc_object
    window = views.window()
    if window is not None:
        window.show_mesh(mesh)
    for setting in SETTINGS:
        if setting["property"]:
            value = to_property(setting, settings.get(setting["name"]))
            setattr(mesh, setting["property"], links.link(doc_object, value) if setting["kind"] == "names" else value)
    by_size: Dict[float, List[str]] = {}
    for element, size in settings.get("sizes", {}).items():
        by_size.setdefault(size, []).append(element)
    for size, elements in by_size.items():
        refine(mesh, links.link(doc_object, elements), size)
    if analysis is not None:
        analysis.addObject(mesh)
    return mesh


def remesh(mesh, progress: Optional[Progress] = None, command: Optional[str] = None) -> None:
    """Remeshes a mesh object's shape with the settings in its properties. On an Error it keeps its old mesh.

    If hand_over() has left a job, its mesh is used instead of meshing again. So macros can record the panel's work."""
    if state.is_surface_mesh(mesh):
        mesh.Proxy.remesh(mesh, progress, command)
        return
    job = _handed_over.take(_key(mesh))
    if job is None:
        job = start(mesh, command)
        job.wait(progress)
    finish(mesh, job)


def hand_over(mesh, job: ShapeJob) -> None:
    """Leaves a job that has succeeded to the remesh() call that follows immediately."""
    _handed_over.put(_key(mesh), job)


def start(mesh, command: Optional[str] = None, outputs: Sequence[Union[str, Path]] = (),
          wanted: Optional[Wanted] = None) -> ShapeJob:
    """Starts to mesh a mesh object's shape in a child process; finish() stores the mesh when the process has ended.

    Args:
        wanted: settings to use instead of the object's own; the caller stores them before finish().
    """
    running = _running.get(_key(mesh))
    if running is not None and running.running:
        raise Error(translate(
            "Quadrille", "{}: is being meshed already; wait for it, or cancel it first").format(mesh.Label), "usage", mesh.Name)
    part = state.part_of(mesh)
    old_documents.mesh_regions(mesh)
    wanted = wanted or state.wanted_of(mesh)
    found = links.follow(mesh, wanted.anew)
    flipped = state.flipped(mesh, found)
    shape = shapes.with_reversed_faces(shape_of(part), flipped)
    # Elements that the analysis refers to keep their nodes, and so their groups. A file gets the existing mesh.
    kept = list(mesh.KeptForAnalysis) if outputs else groups.referenced(mesh)
    used = state.settings_to_use(mesh, wanted, found)
    if kept:
        used["keep"] = [*(used.get("keep") or ()), *kept]
    job = ShapeJob(shape, used, command, outputs, brep=_brep_as_meshed(mesh, flipped))
    job.kept = kept
    settings = state.settings_key(mesh, wanted, found)
    job.found = found
    _running[_key(mesh)] = job.start()
    # Changes made from now on, while the child works, make the new mesh stale.
    job.made_of = (shapes.fingerprint(part.Shape), settings)
    return job


def finish(mesh, job: ShapeJob) -> None:
    """Stores the mesh of a job that has ended in its mesh object. On an Error the object keeps its old mesh."""
    _running.pop(_key(mesh), None)
    fem_mesh, report = job.result()
    for sentence in links.rename(mesh, job.found):
        FreeCAD.Console.PrintMessage(f"{sentence}\n")
    _store_result(mesh, fem_mesh, report, job)


def forget(document_name: str, name: str) -> None:
    """Drops the job of a mesh object that was deleted, or whose result is not wanted."""
    _running.pop((document_name, name), None)


#: The running jobs, by the names of document and mesh object.
_running: Dict[Tuple[str, str], ShapeJob] = {}
_handed_over: Prepared[ShapeJob] = Prepared()


def _key(mesh) -> Tuple[str, str]:
    return (mesh.Document.Name, mesh.Name)


def flip(mesh, faces: Sequence[Union[int, str]] = ()) -> None:
    """Flips the shell normals of faces (of all faces if none is named) and meshes again.

    The mesher gets the faces reversed, so that files, solvers and views all see the same normals.
    """
    shape = shape_of(mesh.Shape)
    names = [face_name(face) for face in faces] or [f"Face{i}" for i in range(1, len(shape.Faces) + 1)]
    unknown = sorted(set(names) - {f"Face{i}" for i in range(1, len(shape.Faces) + 1)})
    if unknown:
        raise Error(translate(
            "Quadrille", "{}: has no face {} to flip").format(mesh.Label, unknown[0]), "usage", unknown[0])
    before = list(mesh.FlippedFaces)
    flipped = set(state.flipped(mesh, links.follow(mesh))) ^ set(names)
    mesh.FlippedFaces = links.link(mesh.Shape, sorted(flipped, key=lambda text: int(text[4:])))
    try:
        remesh(mesh)
    except Error:
        mesh.FlippedFaces = before
        raise


def export(mesh, path: Union[str, Path]) -> None:
    """Writes the mesh of a mesh object to a file; the suffix gives the format (.inp .msh .unv .med .vtu .vtk .bdf .xdmf .su2).

    The mesher runs again and writes the file with all sets and groups. The same shape and settings give the same mesh.
    """
    now, sentence = mesh.Proxy.judge(mesh)
    if now != UP_TO_DATE:
        raise Error(translate(
            "Quadrille", "{}: {}; nothing was exported").format(mesh.Label, sentence), "usage", mesh.Name)
    with scratch_folder() as folder:
        written = os.path.join(folder, "export" + Path(path).suffix.lower())
        job = mesh.Proxy.start(mesh, outputs=[written])
        fem_mesh, _ = job.wait_for_result()
        if (fem_mesh.FaceCount, fem_mesh.NodeCount) != (mesh.FemMesh.FaceCount, mesh.FemMesh.NodeCount):
            raise Error(translate(
                "Quadrille", "{}: the mesher now gives another mesh (its version has changed, or the part was recomputed and "
                "differs by rounding): mesh again, then export").format(mesh.Label), "failure", mesh.Name)
        try:
            Path(path).write_bytes(Path(written).read_bytes())
        except OSError as error:
            raise Error(translate(
                "Quadrille", "{}: cannot be written: {}").format(path, error.strerror), "failure", str(path)) from error


#: The properties of every mesh object besides its settings: type, name, group and description.
RESULT_PROPERTIES = (
    ("App::PropertyEnumeration", "Status", "Result", "Whether the mesh is up to date with the part and the settings"),
    ("App::PropertyEnumeration", "Element", "Solve", "Type of the elements for CalculiX. Plane stress (CPS), plane strain (CPE) and "
     "rotational symmetry about the y axis (CAX) need a part in the plane z = 0; M3D are membranes"),
    ("App::PropertyBool", "ReducedShells", "Solve", "Second-order shells are written for CalculiX as S8R, not S8"),
    ("App::PropertyFloat", "ShellOffset", "Solve", "Where the middle of the shell lies, in thicknesses from the mesh along "
     "its normals: 0.5 = the mesh is the bottom surface, -0.5 = the top (CalculiX)"),
    ("App::PropertyInteger", "QuadCount", "Result", "Number of quads"),
    ("App::PropertyInteger", "NodeCount", "Result", "Number of nodes"),
    ("App::PropertyFloat", "WorstQuality", "Result", "Smallest q (1 = all corners right-angled, 0 = useless)"),
    ("App::PropertyFloat", "MeanQuality", "Result", "Mean q"),
    ("App::PropertyFloat", "WorstJacobian", "Result", "Smallest scaled Jacobian"),
    ("App::PropertyFloat", "MeanJacobian", "Result", "Mean scaled Jacobian"),
    ("App::PropertyFloat", "LargestAspect", "Result", "Largest ratio of longest to shortest edge of a quad"),
    ("App::PropertyFloat", "IrregularPercent", "Result", "Inner nodes with more or fewer than four quads, percent"),
    ("App::PropertyFloat", "OutsidePercent", "Result", "Quads outside the industry limits, percent; not for warp or short sides"),
    ("App::PropertyString", "Findings", "Hidden", "What is left out, crossed or kept, and what forces poor quads, as in reports (JSON)"),
    ("App::PropertyVectorList", "CrossedLines", "Result", "Points along each smooth edge that quads cross, as many on each"),
    ("App::PropertyIntegerList", "FinerQuads", "Hidden", "Numbers of the quads whose sides may be short, as asked for"),
    ("App::PropertyFloat", "LeastSize", "Result", "Minimum size of the mesh, mm; sides under half of it count as short"),
    ("App::PropertyFloat", "Seconds", "Result", "Seconds that the mesher took, all threads together"),
    ("App::PropertyFloatList", "MeshedShape", "Hidden", "Measures of the part when it was meshed"),
    ("App::PropertyString", "MeshedSettings", "Hidden", "Settings that the mesh was made with"),
    ("App::PropertyString", "MeshToken", "Hidden", "Name of the mesh, for undo"),
)


def set_default(obj, name: str) -> None:
    """Gives a property that was just added the values that it can have, and its default."""
    if name == "Element":
        obj.Element = [element_types.SHELL, *element_types.OTHERS]
    elif name == "ReducedShells":
        obj.ReducedShells = True


class MeshFeature:
    """The Python side of a mesh object: its properties."""

    __module__ = "quadrille.freecad"  # saved documents refer to the class by this name: do not change it
    Type = state.TYPE
    BaseType = "Fem::BaseFemPythonObject"

    def __init__(self, obj) -> None:
        obj.Proxy = self
        self.add_properties(obj)
        groups.watch(results.hint_at_surfaces)
        wrappers.wrap_solvers(complaint)

    def add_properties(self, obj) -> None:
        """Adds missing properties, so that documents of older versions gain new ones."""
        for setting in SETTINGS:
            name = setting["property"]
            if not name or name in obj.PropertiesList:
                continue
            kind = property_kind(setting)
            obj.addProperty(links.PROPERTY if setting["kind"] == "names" else kind, name, "Mesh", property_help(setting))
            if kind == "App::PropertyEnumeration":
                setattr(obj, name, words(setting))
            setattr(obj, name, to_property(setting, None))
        for kind, name, group, text in (
            ("App::PropertyLinkGlobal", "Shape", "Mesh", "The part that is meshed"),  # which may be in a container
            (links.PROPERTY, "FlippedFaces", "Mesh", "Faces whose shell normals are flipped"),
            ("App::PropertyBool", state.FOLLOWS, "Mesh", "Use the sizes of the last round of adaptation"),
            ("App::PropertyFileIncluded", state.ADAPTED, "Hidden", "Sizes of the last round of adaptation"),
            ("App::PropertyString", state.PEAKS, "Hidden", "Stress peaks on the mesh before the last round of adaptation"),
            ("App::PropertyLinkList", "MeshRegionList", "Mesh", "FEM mesh regions: sizes on faces, edges, vertices"),
            ("App::PropertyLinkList", "MeshGroupList", "Mesh", "FEM mesh groups to make"),
            *RESULT_PROPERTIES,
            ("App::PropertyStringList", "KeptForAnalysis", "Hidden", "Faces and edges that the analysis referred to"),
            ("App::PropertyString", "ChosenElements", "Hidden", "Measures of the named faces, edges and vertices"),
        ):
            if name not in obj.PropertiesList:
                obj.addProperty(kind, name, group, text)
                set_default(obj, name)
        state.name_statuses(obj)
        self._set_editor_modes(obj)

    @staticmethod
    def _set_editor_modes(obj) -> None:
        for name in obj.PropertiesList:
            group = obj.getGroupOfProperty(name)
            if group in ("Result", "Hidden"):
                obj.setEditorMode(name, 1 if group == "Result" else 2)

    #: The functions that judge and start a mesh of a part; SurfaceMesh in surfaces.py has its own.
    judge = staticmethod(state.judge)
    start = staticmethod(start)

    def execute(self, obj) -> None:
        """FreeCAD calls this when the part or a setting has changed. Reports the change and leaves the mesh as it is."""
        state.tell_change(obj)

    def onChanged(self, obj, name: str) -> None:
        """FreeCAD calls this after a property was set. Records what the named faces are now."""
        if name in links.OWN and "ChosenElements" in obj.PropertiesList and "Restore" not in obj.State:
            if not obj.Document.Transacting:
                links.note(obj, {name})

    def onDocumentRestored(self, obj) -> None:
        """FreeCAD calls this after a document was read."""
        old_documents.migrate(obj)
        self.add_properties(obj)
        groups.watch(results.hint_at_surfaces)
        wrappers.wrap_solvers(complaint)

    # All state is in the document's properties. FreeCAD 0.20 calls the second pair, 1.0 the first.
    def dumps(self):
        """Nothing to save."""
        return None

    def loads(self, _state) -> None:
        """Nothing to restore."""

    __getstate__ = dumps
    __setstate__ = loads


def _mesh_type() -> str:
    """The type of mesh object in this version of FreeCAD."""
    version = tuple(int(part) for part in FreeCAD.Version()[:2])
    return "Fem::FemMeshShapeBaseObjectPython" if version >= (1, 0) else "Fem::FemMeshObjectPython"


def _in_millimeters(settings: MeshSettings) -> MeshSettings:
    """Converts lengths, which may have a unit, to millimeters; changes and returns the settings."""
    for name, value in settings.items():
        if BY_NAME[name]["unit"] != "mm":
            continue
        if isinstance(value, Mapping):
            settings[name] = {str(key): millimeters(size) for key, size in value.items()}
        else:
            settings[name] = millimeters(value)
    return settings


def check_analysis(analysis) -> None:
    """Raises Error if an object is not an analysis, or already holds a mesh other than a result mesh."""
    if analysis is None:
        return
    if not analysis.isDerivedFrom("Fem::FemAnalysis"):
        raise Error(translate("Quadrille", "{}: is not a FEM analysis").format(analysis.Label), "usage", analysis.Name)
    for member in analysis.Group:
        if member.isDerivedFrom("Fem::FemMeshObject") and not _is_result_mesh(member):
            raise Error(
                translate(
                    "Quadrille", "{}: already holds the mesh {}, and FreeCAD solves with one mesh only").format(analysis.Label, member.Label),
                "usage",
                member.Name,
            )


def _is_result_mesh(member) -> bool:
    return getattr(getattr(member, "Proxy", None), "Type", "") == "Fem::MeshResult"


#: What meshes were made of, by the mesh objects' tokens: the names of the flipped faces, and the BREP of the shape.
_breps: "OrderedDict[str, Tuple[List[str], bytes]]" = OrderedDict()
_KEPT_BREPS = 20


def _brep_as_meshed(mesh, flipped: List[str]) -> Optional[bytes]:
    """The BREP that a mesh object's mesh was made of, if the part still equals it except for rounding. A recomputed part
    differs slightly, but the mesh should not. None if no such BREP is known."""
    flipped_then, brep = _breps.get(mesh.MeshToken, (None, None))
    if brep is None or flipped_then != flipped:
        return None
    same = shapes.same_fingerprint(list(mesh.MeshedShape), shapes.fingerprint(mesh.Shape.Shape))
    return brep if same else None


def _store_result(mesh, fem_mesh, report: Dict, job: ShapeJob) -> None:
    groups.add_groups(mesh, fem_mesh)
    undo.put(mesh, fem_mesh)
    _breps[mesh.MeshToken] = (state.flipped(mesh, {}), job.brep)
    while len(_breps) > _KEPT_BREPS:
        _breps.popitem(last=False)
    mesh.MeshedShape, mesh.MeshedSettings = job.made_of
    mesh.KeptForAnalysis = job.kept
    mesh.Status = state.judge(mesh)[0]
    store_quality(mesh, fem_mesh, report)


def store_quality(mesh, fem_mesh, report: Dict) -> None:
    """Stores the mesh quality from the mesher's report in the properties of the mesh object."""
    quality = report.get("quality", {})
    mesh.QuadCount = fem_mesh.FaceCount
    mesh.NodeCount = fem_mesh.NodeCount
    mesh.WorstQuality = quality.get("q_min", 0.0)
    mesh.MeanQuality = quality.get("q_mean", 0.0)
    mesh.WorstJacobian = quality.get("sj_min", 0.0)
    mesh.MeanJacobian = quality.get("sj_mean", 0.0)
    mesh.LargestAspect = quality.get("aspect_max", 0.0)
    mesh.IrregularPercent = quality.get("irregular_percent", 0.0)
    criteria = report.get("criteria", {})
    mesh.OutsidePercent = criteria.get("outside_percent", 0.0)
    shortest = criteria.get("by_criterion", {}).get("min_length", {}).get("limit")
    mesh.LeastSize = 2 * shortest if shortest else 0.0
    mesh.Findings = findings.as_text(report)
    mesh.CrossedLines = [FreeCAD.Vector(*point) for edge in report.get("crossed_edges", ()) for point in edge["line"]]
    mesh.FinerQuads = report.get("finer_quads", [])
    mesh.Seconds = sum(report.get("seconds", {}).values())
