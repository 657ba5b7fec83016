# SPDX-License-Identifier: GPL-3.0-or-later
"""Quadrille inside FreeCAD: all-quad FEM mesh objects.

    import quadrille.freecad
    mesh = quadrille.freecad.mesh_object(App.ActiveDocument.Part, size=2.0, order=2, analysis=analysis)

The shape goes to the `quadrille` command as a BREP file, the mesh comes back as a MED file with its groups. The
mesher is a child process: it can neither freeze nor crash FreeCAD, and fits any build of it.
"""

import os
import tempfile
from pathlib import Path
from typing import Dict, Mapping, Optional, Sequence, Tuple, Union

import FreeCAD
import Fem

from .command import MeshJob, MeshSettings, Progress, face_name, find_command
from .errors import Error

__all__ = ["Error", "MeshFeature", "mesh_object", "mesh_shape", "remesh", "use_reduced_shells"]

PREFERENCES = "User parameter:BaseApp/Preferences/Mod/Quadrille"
_DEFAULT_STRATEGY = "default"


def mesh_object(
    doc_object,
    size: Optional[float] = None,
    order: int = 1,
    name: str = "QuadMesh",
    faces: Sequence[Union[int, str]] = (),
    size_min: Optional[float] = None,
    elements_per_circle: float = 12,
    growth: float = 0.3,
    strategy: Optional[str] = None,
    sizes: Optional[Mapping[str, float]] = None,
    analysis=None,
    threads: int = 0,
    seed: int = 1,
    partial: bool = False,
    progress: Optional[Progress] = None,
    command: Optional[str] = None,
    outputs: Sequence[Union[str, Path]] = (),
    picture: Optional[Union[str, Path]] = None,
):
    """Meshes the faces of a document object with quads and adds the mesh to its document.

    Args:
        doc_object: a document object with a shape.
        size: target edge length in mm; None = a sixtieth of the shape's diagonal.
        order: 1 for four-node quads, 2 for eight-node quads (what CalculiX wants for shells).
        name: name wanted for the mesh object.
        faces: the faces to mesh, as 3 or "Face3"; empty = all.
        size_min: no size goes below this, in mm; None = size / 8.
        elements_per_circle: elements per 2 pi of curvature; 0 = curvature is ignored.
        growth: largest growth of the size per length.
        strategy: "direct" or "subdivide"; None = the mesher's own choice.
        sizes: sizes on faces, edges or vertices: {"Face3": 0.5}.
        analysis: a FEM analysis to add the mesh to.
        threads: 0 = all cores.
        seed: of random choices.
        partial: deliver what could be meshed when a face fails.
        progress: called with (stage, fraction) now and then; returning False cancels.
        command: path of the `quadrille` command; None = found by find_command().
        outputs: mesh files to write besides: .inp, .msh, .unv, .med, .vtu, .vtk, .bdf.
        picture: a .png to draw the mesh into.

    Returns:
        a Fem::FemMeshObjectPython (FreeCAD 0.20) or Fem::FemMeshShapeBaseObjectPython (1.0) whose `Shape` links to
        doc_object, with groups named Face1..., Edge1..., Vertex1... as in FreeCAD.

    Raises:
        Error: with one sentence, the document unchanged.
    """
    settings = MeshSettings(
        size=None if size is None else _millimetres(size),
        size_min=None if size_min is None else _millimetres(size_min),
        elements_per_circle=float(elements_per_circle),
        growth=float(growth),
        order=order,
        strategy=strategy,
        faces=tuple(face_name(face) for face in faces or ()),
        sizes={str(key): _millimetres(value) for key, value in (sizes or {}).items()},
        seed=seed,
        threads=threads,
        partial=partial,
    )
    _check_analysis(analysis)
    fem_mesh, report = mesh_shape(_shape_of(doc_object), settings, progress, command, outputs, picture)
    mesh = doc_object.Document.addObject(_mesh_type(), name)
    MeshFeature(mesh)
    mesh.Shape = doc_object
    _store_settings(mesh, settings)
    _store_result(mesh, fem_mesh, report)
    if FreeCAD.GuiUp:
        mesh.ViewObject.Proxy = 0
    if analysis is not None:
        analysis.addObject(mesh)
    return mesh


def remesh(mesh, progress: Optional[Progress] = None, command: Optional[str] = None) -> None:
    """Meshes a mesh object's shape anew with the settings in its properties; on an Error it keeps its old mesh."""
    if mesh.Shape is None:
        raise Error(f"{mesh.Label}: the part that it meshes is gone", "usage", mesh.Name)
    fem_mesh, report = mesh_shape(_shape_of(mesh.Shape), _load_settings(mesh), progress, command)
    _store_result(mesh, fem_mesh, report)


def mesh_shape(
    shape,
    settings: MeshSettings,
    progress: Optional[Progress] = None,
    command: Optional[str] = None,
    outputs: Sequence[Union[str, Path]] = (),
    picture: Optional[Union[str, Path]] = None,
) -> Tuple["Fem.FemMesh", Dict]:
    """Meshes a Part shape; returns the mesh with its groups, and the mesher's report (see `quadrille --report`)."""
    if shape.isNull() or not shape.Faces:
        raise Error("the shape has no faces to mesh", "usage")
    preference = FreeCAD.ParamGet(PREFERENCES).GetString("Command", "")
    path = find_command(command, preference or None)
    with tempfile.TemporaryDirectory(prefix="quadrille-") as folder:
        model, output = os.path.join(folder, "shape.brep"), os.path.join(folder, "mesh.med")
        shape.exportBrep(model)
        report = MeshJob(model, [output, *outputs], settings, path, picture).start().wait(progress)
        fem_mesh = Fem.read(output)
    # FreeCAD's reader gives an empty mesh when it does not understand a file.
    wanted = report.get("counts", {}).get("quads", 0)
    if fem_mesh.FaceCount != wanted or not wanted:
        raise Error(f"FreeCAD read {fem_mesh.FaceCount} of the {wanted} quads that {path} wrote", "failure", path)
    return fem_mesh, report


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

    def add_properties(self, obj) -> None:
        """Adds what is missing, so that documents of older versions gain new properties."""
        for kind, name, group, text in (
            ("App::PropertyLink", "Shape", "Mesh", "The part that is meshed"),
            ("App::PropertyLength", "Size", "Mesh", "Target edge length; 0 = a sixtieth of the part's diagonal"),
            ("App::PropertyLength", "SizeMin", "Mesh", "No size goes below this; 0 = size / 8"),
            ("App::PropertyFloat", "ElementsPerCircle", "Mesh", "Elements per full circle of curvature; 0 = off"),
            ("App::PropertyFloat", "Growth", "Mesh", "Largest growth of the size per length"),
            ("App::PropertyEnumeration", "ElementOrder", "Mesh", "1st: four-node quads; 2nd: eight-node quads"),
            ("App::PropertyEnumeration", "Strategy", "Mesh", "How triangles become quads"),
            ("App::PropertyStringList", "Faces", "Mesh", "The faces to mesh, such as Face3; empty = all"),
            ("App::PropertyMap", "Sizes", "Mesh", "Sizes on faces, edges and vertices in mm: Face3 = 0.5"),
            ("App::PropertyInteger", "Seed", "Mesh", "Seed of random choices"),
            ("App::PropertyInteger", "Threads", "Mesh", "Threads to use; 0 = all cores"),
            ("App::PropertyBool", "Partial", "Mesh", "Keep what could be meshed when a face fails"),
            ("App::PropertyInteger", "QuadCount", "Result", "Number of quads"),
            ("App::PropertyInteger", "NodeCount", "Result", "Number of nodes"),
            ("App::PropertyFloat", "WorstQuality", "Result", "Least q (1 = all corners right-angled, 0 = useless)"),
            ("App::PropertyFloat", "MeanQuality", "Result", "Mean q"),
            ("App::PropertyFloat", "WorstJacobian", "Result", "Least scaled Jacobian"),
            ("App::PropertyFloat", "IrregularPercent", "Result", "Inner nodes with other than four quads, percent"),
            ("App::PropertyFloat", "Seconds", "Result", "Seconds that the mesher took, all threads together"),
        ):
            if name in obj.PropertiesList:
                continue
            obj.addProperty(kind, name, group, text)
            if name == "ElementOrder":
                obj.ElementOrder = ["1st", "2nd"]
            elif name == "Strategy":
                obj.Strategy = [_DEFAULT_STRATEGY, "direct", "subdivide"]
            elif name == "ElementsPerCircle":
                obj.ElementsPerCircle = 12.0
            elif name == "Growth":
                obj.Growth = 0.3
            elif name == "Seed":
                obj.Seed = 1
            if group == "Result":
                obj.setEditorMode(name, 1)

    def onDocumentRestored(self, obj) -> None:
        """FreeCAD calls this after a document was read."""
        self.add_properties(obj)
        for name in obj.PropertiesList:
            if obj.getGroupOfProperty(name) == "Result":
                obj.setEditorMode(name, 1)

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


def _shape_of(doc_object):
    shape = getattr(doc_object, "Shape", None)
    if shape is None or not hasattr(shape, "Faces"):
        label = getattr(doc_object, "Label", doc_object)
        raise Error(f"{label}: has no shape to mesh", "usage", getattr(doc_object, "Name", ""))
    if shape.isNull() or not shape.Faces:
        raise Error(f"{doc_object.Label}: its shape has no faces to mesh", "usage", doc_object.Name)
    return shape


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
    mesh.Size = settings.size or 0
    mesh.SizeMin = settings.size_min or 0
    mesh.ElementsPerCircle = settings.elements_per_circle
    mesh.Growth = settings.growth
    mesh.ElementOrder = "2nd" if settings.order == 2 else "1st"
    mesh.Strategy = settings.strategy or _DEFAULT_STRATEGY
    mesh.Faces = list(settings.faces)
    mesh.Sizes = {name: repr(size) for name, size in settings.sizes.items()}
    mesh.Seed = settings.seed
    mesh.Threads = settings.threads
    mesh.Partial = settings.partial


def _load_settings(mesh) -> MeshSettings:
    return MeshSettings(
        size=mesh.Size.Value or None,
        size_min=mesh.SizeMin.Value or None,
        elements_per_circle=mesh.ElementsPerCircle,
        growth=mesh.Growth,
        order=2 if mesh.ElementOrder == "2nd" else 1,
        strategy=None if mesh.Strategy == _DEFAULT_STRATEGY else mesh.Strategy,
        faces=tuple(mesh.Faces),
        sizes={name: float(size) for name, size in mesh.Sizes.items()},
        seed=mesh.Seed,
        threads=mesh.Threads,
        partial=mesh.Partial,
    )


def _store_result(mesh, fem_mesh, report: Dict) -> None:
    mesh.FemMesh = fem_mesh
    quality = report.get("quality", {})
    mesh.QuadCount = fem_mesh.FaceCount
    mesh.NodeCount = fem_mesh.NodeCount
    mesh.WorstQuality = quality.get("q_min", 0.0)
    mesh.MeanQuality = quality.get("q_mean", 0.0)
    mesh.WorstJacobian = quality.get("sj_min", 0.0)
    mesh.IrregularPercent = quality.get("irregular_percent", 0.0)
    mesh.Seconds = sum(report.get("seconds", {}).values())
