# SPDX-License-Identifier: GPL-3.0-or-later
"""Quadrille inside FreeCAD: all-quad FEM mesh objects.

    import quadrille.freecad
    mesh = quadrille.freecad.mesh_object(App.ActiveDocument.Part, size=2.0, order=2, analysis=analysis)

The shape goes to the `quadrille` command as a BREP file, the mesh comes back as a MED file with its groups. The
mesher is a child process: it can neither freeze nor crash FreeCAD, and fits any build of it.
"""

import json
import os
from collections import OrderedDict
from pathlib import Path
from typing import Dict, List, Mapping, Optional, Sequence, Tuple, Union

import FreeCAD
import Fem

from . import groups, shapes, solvers, undo
from .command import MeshJob, Progress, check_version, find_command, scratch_folder
from .errors import Error
from .settings import (BY_NAME, SETTINGS, MeshSettings, face_name, from_property, in_words_of_properties, property_help,
                       property_kind, to_property, words)

__all__ = [
    "Error", "MeshFeature", "ShapeJob", "check_part", "export", "find_mesher", "finish", "flip", "make_mesh",
    "mesh_object", "mesh_shape", "refine", "remesh", "start", "suggested_size", "use_reduced_shells",
]

PREFERENCES = "User parameter:BaseApp/Preferences/Mod/Quadrille"
UP_TO_DATE = "up to date"
_OTHER_MEANS = "made by other means: mesh again"


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
        size: target edge length in mm, or with a unit ("2 cm"); None = a sixtieth of the shape's diagonal.
        order: 2 for eight-node quads, which solvers want for shells, 1 for four-node quads.
        name: name wanted for the mesh object.
        analysis: a FEM analysis to add the mesh to.
        progress: called with the stage and the fraction of the work done; returning False cancels.
        command: path of the `quadrille` command; None = found by find_command().
        outputs: mesh files to write besides: .inp, .msh, .unv, .med, .vtu, .vtk, .bdf.
        picture: a .png to draw the mesh into.
        settings: all others of the table, by name: sizes={"Face3": 0.5}, faces=[3], sew=0.01, partial=True; see
            `quadrille settings`.

    Returns:
        a Fem::FemMeshObjectPython (FreeCAD 0.20) or Fem::FemMeshShapeBaseObjectPython (1.0) whose `Shape` links to
        doc_object, with groups named Face1..., Edge1..., Vertex1... as in FreeCAD.

    Raises:
        Error: with one sentence, the document unchanged.
    """
    wanted = _in_millimetres(MeshSettings(size=size, order=order, **settings))
    _check_analysis(analysis)
    shape = _shape_of(doc_object)
    job = ShapeJob(shape, wanted, command, outputs, picture)
    job.made_of = (shapes.fingerprint(shape), "")
    fem_mesh, report = job.start().wait_for_result(progress)
    mesh = _add_mesh(doc_object, name)
    _store_settings(mesh, wanted)
    if analysis is not None:
        analysis.addObject(mesh)
    job.made_of = (job.made_of[0], _settings_key(mesh))
    _store_result(mesh, fem_mesh, report, job)
    return mesh


def make_mesh(doc_object, size: Optional[float] = None, order: int = 2, name: str = "QuadMesh", analysis=None,
              **settings):
    """Adds a mesh object for a document object, without meshing yet: the task panel or remesh() does that."""
    wanted = _in_millimetres(MeshSettings(size=size, order=order, **settings))
    _shape_of(doc_object)
    _check_analysis(analysis)
    mesh = _add_mesh(doc_object, name)
    _store_settings(mesh, wanted)
    mesh.Status = status(mesh)
    if analysis is not None:
        analysis.addObject(mesh)
    return mesh


def check_part(doc_object, analysis=None) -> None:
    """Raises Error when a document object cannot be meshed, or the analysis cannot take its mesh."""
    _shape_of(doc_object)
    _check_analysis(analysis)


def check_references(mesh, references) -> None:
    """Raises Error when references are not in the part of a mesh object."""
    shapes.references_to_names(_shape_of(mesh.Shape), mesh.Shape, references)


def suggested_size(doc_object, quads: int = 5000, elements_per_circle: float = 12) -> float:
    """The size that gives a document object about so many quads, to two digits."""
    return shapes.SizeEstimate(_shape_of(doc_object)).suggested(quads, elements_per_circle)


def _add_mesh(doc_object, name: str):
    mesh = doc_object.Document.addObject(_mesh_type(), name)
    MeshFeature(mesh)
    mesh.Shape = doc_object
    if FreeCAD.GuiUp:
        from .gui.view_provider import MeshViewProvider

        MeshViewProvider(mesh.ViewObject)
    return mesh


def remesh(mesh, progress: Optional[Progress] = None, command: Optional[str] = None) -> None:
    """Meshes a mesh object's shape anew with the settings in its properties; on an Error it keeps its old mesh."""
    job = start(mesh, command)
    job.wait(progress)
    finish(mesh, job)


def start(mesh, command: Optional[str] = None, outputs: Sequence[Union[str, Path]] = ()) -> "ShapeJob":
    """Starts to mesh a mesh object's shape in a child process; finish() takes the mesh when it has ended."""
    key = (mesh.Document.Name, mesh.Name)
    running = _running.get(key)
    if running is not None and running.running:
        raise Error(f"{mesh.Label}: is being meshed already; wait for it, or cancel it first", "usage", mesh.Name)
    job = ShapeJob(_shape_to_mesh(mesh), _settings_to_use(mesh), command, outputs, brep=_brep_as_meshed(mesh))
    # What is changed while the child works makes the mesh stale when it comes.
    job.made_of = (shapes.fingerprint(mesh.Shape.Shape), _settings_key(mesh))
    _running[key] = job.start()
    return job


def finish(mesh, job: "ShapeJob") -> None:
    """Puts the mesh of a job that has ended into its mesh object; on an Error the object keeps its old mesh."""
    _running.pop((mesh.Document.Name, mesh.Name), None)
    _store_result(mesh, *job.result(), job)


def forget(document_name: str, name: str) -> None:
    """Drops the job of a mesh object that is gone."""
    _running.pop((document_name, name), None)


def refine(mesh, references, size, name: str = "Refinement"):
    """Adds FreeCAD's own mesh region to a mesh object: faces, edges or vertices to mesh at a size of their own.

    Args:
        mesh: a mesh object of ours.
        references: [(document object, ("Face3", "Edge4"))...], as FEM's References.
        size: element size there, in mm or with a unit.
    """
    import ObjectsFem

    if not references or not any(names for _, names in references):
        raise Error("select the faces, edges or vertices to refine", "usage", mesh.Name)
    length = _millimetres(size)
    if not length > 0:
        raise Error(f"a refinement of size {size} makes no sense: it must be larger than 0", "usage", mesh.Name)
    check_references(mesh, references)  # an error now, not when meshing
    region = ObjectsFem.makeMeshRegion(mesh.Document, mesh, length, name)
    region.References = references
    return region


def flip(mesh, faces: Sequence[Union[int, str]] = ()) -> None:
    """Turns the shell normals of faces over (all faces when none is named) and meshes again.

    The faces go to the mesher reversed, so that files, solvers and views all see the same normals.
    """
    shape = _shape_of(mesh.Shape)
    names = [face_name(face) for face in faces] or [f"Face{i}" for i in range(1, len(shape.Faces) + 1)]
    unknown = sorted(set(names) - {f"Face{i}" for i in range(1, len(shape.Faces) + 1)})
    if unknown:
        raise Error(f"{mesh.Label}: has no face {unknown[0]} to flip", "usage", unknown[0])
    before = list(mesh.FlippedFaces)
    mesh.FlippedFaces = sorted(set(before) ^ set(names), key=lambda text: int(text[4:]))
    try:
        remesh(mesh)
    except Error:
        mesh.FlippedFaces = before
        raise


def export(mesh, path: Union[str, Path]) -> None:
    """Writes the mesh of a mesh object to a file; the suffix tells the format (.inp .msh .unv .med .vtu .vtk .bdf).

    The mesher writes the file, with all sets and groups: the same shape and settings give the same mesh.
    """
    reason = status(mesh)
    if reason != UP_TO_DATE:
        raise Error(f"{mesh.Label}: {reason}; nothing was exported", "usage", mesh.Name)
    with scratch_folder() as folder:
        written = os.path.join(folder, "export" + Path(path).suffix.lower())
        job = start(mesh, outputs=[written])
        fem_mesh, _ = job.wait_for_result()
        if (fem_mesh.FaceCount, fem_mesh.NodeCount) != (mesh.FemMesh.FaceCount, mesh.FemMesh.NodeCount):
            raise Error(f"{mesh.Label}: the mesher gives another mesh now (it is of another version, or the part was computed "
                        "anew and differs by rounding): mesh again, then export", "failure", mesh.Name)
        try:
            Path(path).write_bytes(Path(written).read_bytes())
        except OSError as error:
            raise Error(f"{path}: cannot be written: {error.strerror}", "failure", str(path)) from error


def mesh_shape(
    shape,
    settings: MeshSettings,
    progress: Optional[Progress] = None,
    command: Optional[str] = None,
    outputs: Sequence[Union[str, Path]] = (),
    picture: Optional[Union[str, Path]] = None,
) -> Tuple["Fem.FemMesh", Dict]:
    """Meshes a Part shape; returns the mesh with its groups, and the mesher's report (see `quadrille --report`)."""
    return ShapeJob(shape, settings, command, outputs, picture).start().wait_for_result(progress)


def find_mesher(command: Optional[str] = None) -> str:
    """The path of the `quadrille` command, after a check that it is of the version of this addon."""
    preference = FreeCAD.ParamGet(PREFERENCES).GetString("Command", "")
    path = find_command(command, preference or None)
    check_version(path)
    return path


class ShapeJob:
    """The meshing of a shape in a child process. Start it, then wait(), or poll() it from a timer until it has ended;
    result() gives the mesh."""

    def __init__(
        self,
        shape,
        settings: MeshSettings,
        command: Optional[str] = None,
        outputs: Sequence[Union[str, Path]] = (),
        picture: Optional[Union[str, Path]] = None,
        brep: Optional[bytes] = None,
    ) -> None:
        if shape.isNull() or not shape.Faces:
            raise Error("the shape has no faces to mesh", "usage")
        self._command = find_mesher(command)
        self._folder = scratch_folder()
        model = os.path.join(self._folder.name, "shape.brep")
        self._output = os.path.join(self._folder.name, "mesh.med")
        if brep is None:
            shape.exportBrep(model)
            brep = Path(model).read_bytes()
        else:
            Path(model).write_bytes(brep)
        self.brep = brep  #: the shape as the mesher sees it
        self.made_of: Tuple[List[float], str] = ([], "")  #: fingerprint of the part, and settings, when it was started
        self._job = MeshJob(model, [self._output, *outputs], settings, self._command, picture)
        self._report: Optional[Dict] = None

    def start(self) -> "ShapeJob":
        """Starts the child process."""
        try:
            self._job.start()
        except Error:
            self._folder.cleanup()
            raise
        return self

    @property
    def running(self) -> bool:
        """True while the child process lives."""
        return self._job.running

    @property
    def messages(self) -> Sequence[str]:
        """What the mesher has said besides its progress."""
        return self._job.messages

    def poll(self) -> Sequence[Tuple[str, float]]:
        """The progress since the last call, as (stage, fraction) pairs; never waits."""
        return self._job.poll()

    def cancel(self) -> None:
        """Ends the child process; result() then raises the Error of kind "cancelled"."""
        self._job.cancel()

    def wait(self, progress: Optional[Progress] = None) -> None:
        """Waits for the end, passing progress on."""
        try:
            self._report = self._job.wait(progress)
        except Error as error:
            self._folder.cleanup()
            raise _in_own_words(error) from error
        except BaseException:
            self._folder.cleanup()
            raise

    def result(self) -> Tuple["Fem.FemMesh", Dict]:
        """The mesh and the mesher's report, once the child has ended; raises Error when it failed."""
        try:
            report = self._report if self._report is not None else self._job.result()
            fem_mesh = read_mesh(self._output)
        except Error as error:
            raise _in_own_words(error) from error
        finally:
            self._folder.cleanup()
        # FreeCAD's reader gives an empty mesh when it does not understand a file.
        wanted = report.get("counts", {}).get("quads", 0)
        if fem_mesh.FaceCount != wanted or not wanted:
            raise Error(f"FreeCAD read {fem_mesh.FaceCount} of the {wanted} quads that {self._command} wrote",
                        "failure", self._command)
        return fem_mesh, report

    def wait_for_result(self, progress: Optional[Progress] = None) -> Tuple["Fem.FemMesh", Dict]:
        """wait(), then result()."""
        self.wait(progress)
        return self.result()


def read_mesh(path: Union[str, Path]) -> "Fem.FemMesh":
    """A mesh file as a FEM mesh, as Fem.read() gives it, in less time.

    A mesh made by Fem.read() keeps a log of each command that built it, which nobody reads: a quarter of the time to read,
    half of that to copy it once more than one was made. A copy, even of an empty mesh, keeps none.
    """
    fem_mesh = Fem.FemMesh(Fem.FemMesh())
    fem_mesh.read(str(path))
    return fem_mesh


#: The jobs under way, by the names of document and mesh object.
_running: Dict[Tuple[str, str], ShapeJob] = {}


def use_reduced_shells(input_file: Union[str, Path]) -> int:
    """Turns the S8 shells of a CalculiX input file into S8R, and returns how many element blocks were changed.

    FreeCAD 0.20 writes eight-node quads as S8. S8R, with reduced integration, is far better on thin curved shells:
    call this between FreeCAD's write_inp_file() and ccx_run().
    """
    path = Path(input_file)
    text = path.read_text(encoding="utf-8")
    count = text.count("TYPE=S8,")
    if count:
        path.write_text(text.replace("TYPE=S8,", "TYPE=S8R,"), encoding="utf-8")
    return count


class MeshFeature:
    """The Python side of a mesh object: its properties. Documents name this class: do not move it."""

    Type = "Fem::FemMeshQuadrille"
    BaseType = "Fem::BaseFemPythonObject"

    def __init__(self, obj) -> None:
        obj.Proxy = self
        self.add_properties(obj)
        groups.watch()
        solvers.wrap_solvers(complaint)

    def add_properties(self, obj) -> None:
        """Adds what is missing, so that documents of older versions gain new properties."""
        for setting in SETTINGS:
            name = setting["property"]
            if not name or name in obj.PropertiesList:
                continue
            kind = property_kind(setting)
            obj.addProperty(kind, name, "Mesh", property_help(setting))
            if kind == "App::PropertyEnumeration":
                setattr(obj, name, words(setting))
            setattr(obj, name, to_property(setting, None))
        for kind, name, group, text in (
            ("App::PropertyLink", "Shape", "Mesh", "The part that is meshed"),
            ("App::PropertyStringList", "FlippedFaces", "Mesh", "Faces whose shell normals are turned over"),
            ("App::PropertyLinkList", "MeshRegionList", "Mesh", "FEM mesh regions: sizes on faces, edges, vertices"),
            ("App::PropertyLinkList", "MeshGroupList", "Mesh", "FEM mesh groups to make"),
            ("App::PropertyString", "Status", "Result", "Whether the mesh is that of the part and the settings"),
            ("App::PropertyInteger", "QuadCount", "Result", "Number of quads"),
            ("App::PropertyInteger", "NodeCount", "Result", "Number of nodes"),
            ("App::PropertyFloat", "WorstQuality", "Result", "Least q (1 = all corners right-angled, 0 = useless)"),
            ("App::PropertyFloat", "MeanQuality", "Result", "Mean q"),
            ("App::PropertyFloat", "WorstJacobian", "Result", "Least scaled Jacobian"),
            ("App::PropertyFloat", "MeanJacobian", "Result", "Mean scaled Jacobian"),
            ("App::PropertyFloat", "LargestAspect", "Result", "Largest ratio of longest to shortest edge of a quad"),
            ("App::PropertyFloat", "IrregularPercent", "Result", "Inner nodes with other than four quads, percent"),
            ("App::PropertyFloat", "OutsidePercent", "Result", "Quads outside the limits of industry, percent"),
            ("App::PropertyFloat", "Seconds", "Result", "Seconds that the mesher took, all threads together"),
            ("App::PropertyFloatList", "MeshedShape", "Hidden", "Measures of the part when it was meshed"),
            ("App::PropertyString", "MeshedSettings", "Hidden", "Settings that the mesh was made with"),
            ("App::PropertyString", "MeshToken", "Hidden", "Name of the mesh, for undo"),
        ):
            if name not in obj.PropertiesList:
                obj.addProperty(kind, name, group, text)
        self._set_editor_modes(obj)

    @staticmethod
    def _set_editor_modes(obj) -> None:
        for name in obj.PropertiesList:
            group = obj.getGroupOfProperty(name)
            if group in ("Result", "Hidden"):
                obj.setEditorMode(name, 1 if group == "Result" else 2)

    def execute(self, obj) -> None:
        """FreeCAD calls this when the part or a setting has changed: says so, and leaves the mesh as it is."""
        before, now = obj.Status, status(obj)
        if before == now:
            return
        obj.Status = now
        if before == UP_TO_DATE:
            FreeCAD.Console.PrintWarning(f"{obj.Label}: {now}\n")

    def onDocumentRestored(self, obj) -> None:
        """FreeCAD calls this after a document was read."""
        self.add_properties(obj)
        groups.watch()
        solvers.wrap_solvers(complaint)

    # The state is all in the document's properties; 0.20 calls the second pair, 1.0 the first.
    def dumps(self):
        """Nothing to save."""
        return None

    def loads(self, _state) -> None:
        """Nothing to restore."""

    __getstate__ = dumps
    __setstate__ = loads


def _mesh_type() -> str:
    """The type of mesh object that this FreeCAD has."""
    version = tuple(int(part) for part in FreeCAD.Version()[:2])
    return "Fem::FemMeshShapeBaseObjectPython" if version >= (1, 0) else "Fem::FemMeshObjectPython"


def _millimetres(value) -> float:
    """A number, or a quantity or text with a unit ("2 cm"), in millimetres."""
    if isinstance(value, str):
        value = FreeCAD.Units.Quantity(value)
    return float(getattr(value, "Value", value))


def _in_own_words(error: Error) -> Error:
    """What the command says of its options, said of properties."""
    return Error(in_words_of_properties(str(error)), error.kind, error.subject)


def _in_millimetres(settings: MeshSettings) -> MeshSettings:
    """Lengths may come with a unit."""
    for name, value in settings.items():
        if BY_NAME[name]["unit"] != "mm":
            continue
        if isinstance(value, Mapping):
            settings[name] = {str(key): _millimetres(size) for key, size in value.items()}
        else:
            settings[name] = _millimetres(value)
    return settings


def _shape_of(doc_object):
    shape = getattr(doc_object, "Shape", None)
    if shape is None or not hasattr(shape, "Faces"):
        label = getattr(doc_object, "Label", doc_object)
        raise Error(f"{label}: has no shape to mesh", "usage", getattr(doc_object, "Name", ""))
    if shape.isNull() or not shape.Faces:
        raise Error(f"{doc_object.Label}: its shape has no faces to mesh", "usage", doc_object.Name)
    return shape


def _shape_to_mesh(mesh):
    """The shape of a mesh object's part, with the faces reversed that are to be flipped."""
    if mesh.Shape is None:
        raise Error(f"{mesh.Label}: the part that it meshes is gone", "usage", mesh.Name)
    return shapes.with_reversed_faces(_shape_of(mesh.Shape), mesh.FlippedFaces)


def status(mesh) -> str:
    """Whether a mesh object's mesh is that of its part and its settings, as a sentence."""
    if mesh.Shape is None:
        return "the part is gone"
    if mesh.FemMesh.FaceCount == 0:
        return "not meshed yet"
    if not mesh.MeshedShape:
        return _OTHER_MEANS
    shape = getattr(mesh.Shape, "Shape", None)
    if shape is None or shape.isNull() or not shapes.same_fingerprint(list(mesh.MeshedShape),
                                                                     shapes.fingerprint(shape)):
        return "the part has changed: mesh again"
    try:
        if _settings_key(mesh) != mesh.MeshedSettings:
            return "the settings have changed: mesh again"
    except Error as error:
        return f"{error}: mesh again"
    return UP_TO_DATE


def complaint(mesh) -> str:
    """Why nothing should be solved with the mesh of a mesh object, as a sentence; empty when nothing is known to be wrong,
    and for mesh objects that are not ours."""
    if getattr(getattr(mesh, "Proxy", None), "Type", "") != MeshFeature.Type:
        return ""
    reason = status(mesh)
    if reason == _OTHER_MEANS:
        return ""
    if reason == UP_TO_DATE:
        return "; ".join(groups.left_out(mesh))
    return f"{mesh.Label}: {reason}; what is solved with the mesh as it is would not be right"


def _settings_to_use(mesh) -> MeshSettings:
    """The settings in the properties, with the sizes of the mesh regions."""
    settings = _load_settings(mesh)
    sizes = sizes_wanted(mesh)
    if sizes:
        settings["sizes"] = sizes
    return settings


def sizes_wanted(mesh) -> Dict[str, float]:
    """The sizes on faces, edges and vertices, of the property Sizes and of the mesh regions."""
    sizes = {name: float(size) for name, size in mesh.Sizes.items()}
    shape = _shape_of(mesh.Shape)
    for region in mesh.MeshRegionList:
        length = region.CharacteristicLength
        length = float(getattr(length, "Value", length))
        if not length > 0:
            raise Error(f"{region.Label}: a mesh region needs a length larger than 0", "usage", region.Name)
        for name in shapes.references_to_names(shape, mesh.Shape, region.References):
            sizes[name] = min(length, sizes.get(name, length))
    return sizes


def _settings_key(mesh) -> str:
    settings = _settings_to_use(mesh).of_the_mesh()
    settings["flipped"] = list(mesh.FlippedFaces)
    return json.dumps(settings, sort_keys=True, default=list)


def _check_analysis(analysis) -> None:
    if analysis is None:
        return
    if not analysis.isDerivedFrom("Fem::FemAnalysis"):
        raise Error(f"{analysis.Label}: is not a FEM analysis", "usage", analysis.Name)
    for member in analysis.Group:
        if member.isDerivedFrom("Fem::FemMeshObject") and not _is_result_mesh(member):
            raise Error(
                f"{analysis.Label}: already holds the mesh {member.Label}, and FreeCAD solves with one mesh only",
                "usage",
                member.Name,
            )


def _is_result_mesh(member) -> bool:
    return getattr(getattr(member, "Proxy", None), "Type", "") == "Fem::MeshResult"


def _store_settings(mesh, settings: MeshSettings) -> None:
    for setting in SETTINGS:
        if setting["property"]:
            setattr(mesh, setting["property"], to_property(setting, settings.get(setting["name"])))


def _load_settings(mesh) -> MeshSettings:
    return MeshSettings(**{setting["name"]: from_property(setting, getattr(mesh, setting["property"]))
                           for setting in SETTINGS if setting["property"]})


#: The shapes that meshes were made of, by the mesh objects' tokens: the faces that were flipped, and the BREP.
_breps: "OrderedDict[str, Tuple[List[str], bytes]]" = OrderedDict()
_KEPT_BREPS = 20


def _brep_as_meshed(mesh) -> Optional[bytes]:
    """The BREP that a mesh object's mesh was made of, where the part is still equal to it but for rounding: a part that is
    computed anew comes out a little different, and the mesh need not. None where it is not known."""
    flipped, brep = _breps.get(mesh.MeshToken, (None, None))
    if brep is None or flipped != list(mesh.FlippedFaces):
        return None
    same = shapes.same_fingerprint(list(mesh.MeshedShape), shapes.fingerprint(mesh.Shape.Shape))
    return brep if same else None


def _store_result(mesh, fem_mesh, report: Dict, job: ShapeJob) -> None:
    groups.add_groups(mesh, fem_mesh)
    undo.put(mesh, fem_mesh)
    _breps[mesh.MeshToken] = (list(mesh.FlippedFaces), job.brep)
    while len(_breps) > _KEPT_BREPS:
        _breps.popitem(last=False)
    mesh.MeshedShape, mesh.MeshedSettings = job.made_of
    mesh.Status = status(mesh)
    quality = report.get("quality", {})
    mesh.QuadCount = fem_mesh.FaceCount
    mesh.NodeCount = fem_mesh.NodeCount
    mesh.WorstQuality = quality.get("q_min", 0.0)
    mesh.MeanQuality = quality.get("q_mean", 0.0)
    mesh.WorstJacobian = quality.get("sj_min", 0.0)
    mesh.MeanJacobian = quality.get("sj_mean", 0.0)
    mesh.LargestAspect = quality.get("aspect_max", 0.0)
    mesh.IrregularPercent = quality.get("irregular_percent", 0.0)
    mesh.OutsidePercent = report.get("criteria", {}).get("failing_percent", 0.0)
    mesh.Seconds = sum(report.get("seconds", {}).values())
