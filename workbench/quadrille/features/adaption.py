# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes that follow their results: the error of a solution, and the next mesh with sizes that spread it evenly.

    import quadrille.adaption
    quadrille.adaption.adapt(App.ActiveDocument.QuadMesh, error=0.03)

adapt() takes the result in the mesh's analysis and puts a new mesh into the same mesh object. Loads, supports, thicknesses and
materials refer to the part, so they stay valid. Then solve again. The solver must give results at the surfaces of the shell (its
property BeamShellResultOutput3D). Runs inside FreeCAD."""

import json
import os
from tempfile import TemporaryDirectory
from typing import Any, Dict, List, NamedTuple, Optional, Tuple

import FreeCAD
import numpy as np

from ..core.arrays import nodes_of
from ..core.command import CommandJob, Progress, scratch_folder
from ..core.errors import Error
from ..core.jobs import find_mesher, in_own_words
from ..core.prepared import Prepared
from ..document import groups, state, translate
from ..document.state import ADAPTED, FOLLOWS
from ..solvers import results
from . import mesh_object as core


class Estimate(NamedTuple):
    """The error of a solution, and the mesh that would reach the target error."""

    error: float  #: relative error of the stresses in the energy norm
    quads: int  #: number of quads in the mesh that was solved
    quads_wanted: float  #: approximate number of quads in the next mesh
    size_min: float  #: smallest size in the next mesh, mm
    size_max: float  #: largest size in the next mesh, mm
    met: bool  #: the error is not above the target; the other values are then those of the present mesh
    warnings: List[str]  #: if it is met: where a stress peak has changed since the previous mesh, under the same loads
    peaks: List[Dict[str, Any]]  #: places and sizes of the highest stresses, as the command reports them


class _Round(NamedTuple):
    """A finished round of adaptation that is not yet stored in the document."""

    estimate: Estimate
    folder: TemporaryDirectory  #: scratch folder that holds the sizes
    properties: Dict[str, Any]  #: new property values of the mesh object
    job: Optional[core.ShapeJob]  #: the job that has made the mesh; None if the error is small enough already


def estimate(mesh, result=None, command: Optional[str] = None) -> Estimate:
    """Estimates the error of a result; None = the last one in the mesh object's analysis. The sizes are for an error of 5 %."""
    with scratch_folder() as folder:
        return _estimate(mesh, result, [], folder, None, command)


def adapt(mesh, error: float = 0.05, count: Optional[float] = None, result=None, progress: Optional[Progress] = None,
          command: Optional[str] = None) -> Estimate:
    """Remeshes with sizes that spread the error of the result evenly.

    Args:
        mesh: a mesh object, in an analysis that was solved with this mesh.
        error: wanted relative error of the stresses, in the energy norm.
        count: wanted number of elements, instead of an error.
        result: the result to use; None = the last one in the mesh's analysis.
        progress: called with the stage and the fraction of the work done; returning False cancels.

    Returns:
        the estimate for the mesh that was solved. Without `count`, the mesh stays as it is if its error is not above `error`.

    Raises:
        Error: with one sentence; the document is then unchanged.
    """
    done = _ready.take(_key(mesh)) or _prepare(mesh, error, count, result, progress, command)
    try:
        if done.job is None:
            FreeCAD.Console.PrintMessage(f"{mesh.Label}: the estimated error is {100 * done.estimate.error:.3g} %, below the "
                                         "target: the mesh stays\n")
            for warning in done.estimate.warnings:
                FreeCAD.Console.PrintWarning(f"{mesh.Label}: {warning}\n")
            return done.estimate
        for name, value in done.properties.items():
            setattr(mesh, name, value)
        core.finish(mesh, done.job)
    finally:
        done.folder.cleanup()
    FreeCAD.Console.PrintMessage(f"{mesh.Label}: the estimated error was {100 * done.estimate.error:.3g} % with "
                                 f"{done.estimate.quads} quads; now there are {mesh.QuadCount}: solve again\n")
    return done.estimate


def prepare(mesh, error: float = 0.05, count: Optional[float] = None, progress: Optional[Progress] = None) -> Estimate:
    """Does the work of the adapt() call that follows immediately, while a window shows the progress. The adapt() call itself is
    then quick, and macros can record it. Returns the same as adapt()."""
    return _ready.make(_key(mesh), lambda: _prepare(mesh, error, count, None, progress, None)).estimate


_ready: Prepared[_Round] = Prepared()


def _key(mesh) -> Tuple[str, str]:
    return (mesh.Document.Name, mesh.Name)


def _prepare(mesh, error, count, result, progress, command) -> _Round:
    """Does everything that can fail, before the document is changed."""
    if mesh.SizeField:
        raise Error(translate(
            "Quadrille", "{}: its SizeField is set, which the sizes from results would replace: clear it first").format(mesh.Label), "usage",
                    "SizeField")
    folder = scratch_folder()
    try:
        aim = ["--count", repr(float(count))] if count is not None else ["--error", repr(float(error))]
        found = _estimate(mesh, result, aim, folder.name, progress, command)
        present, sizes = state.wanted_of(mesh), os.path.join(folder.name, _SIZES)
        new = {"Size": found.size_max, "SizeMin": found.size_min, ADAPTED: sizes, FOLLOWS: True}
        wanted = present._replace(values={**present.values, **new})
        if count is None and found.met:
            return _Round(found, folder, new, None)
        job = core.start(mesh, command, wanted=wanted)
        job.wait(progress)
        return _Round(found, folder, {**new, state.PEAKS: json.dumps({"peaks": found.peaks})}, job)
    except BaseException:
        folder.cleanup()
        raise


_SIZES = "sizes.vdb"


def _estimate(mesh, result, aim: List[str], folder: str, progress: Optional[Progress], command: Optional[str]) -> Estimate:
    analysis = groups.analysis_of(mesh)
    if analysis is None:
        raise Error(translate(
            "Quadrille", "{}: is not in an analysis: add it to one, and solve that first").format(mesh.Label), "usage", mesh.Name)
    solved, displaced, sizes = (os.path.join(folder, name) for name in ("mesh.inp", "result.vtu", _SIZES))
    result = result or last_result(mesh, analysis)
    _write_bricks(displaced, _bricks_of(result, analysis))
    _write_shells(solved, mesh.FemMesh)
    before = getattr(mesh, state.PEAKS, "")
    if before:
        aim = [*aim, "--before", os.path.join(folder, "before.json")]
        with open(aim[-1], "w", encoding="utf-8") as file:
            file.write(before)
    job = CommandJob(["adapt", solved, displaced, "-o", sizes, *aim, "--poisson", repr(_poisson(analysis)),
                      "--growth", repr(mesh.Growth)], find_mesher(command))
    try:
        told = job.start().wait(progress)
    except Error as error:
        sentence = in_own_words(str(error)).replace(displaced, result.Label).replace(solved, mesh.Label)
        raise Error(sentence, error.kind, result.Name) from error
    return Estimate(**{name: told[name] for name in Estimate._fields})


def last_result(mesh, analysis):
    """The last result object in an analysis, or the last pipeline, which FreeCAD 1.1's CalculiX creates instead."""
    listed = [result for solver in results.solvers_of(analysis) for result in getattr(solver, "Results", ())]
    found = [member for member in analysis.Group if member.isDerivedFrom("Fem::FemResultObject")
             and getattr(member, "DisplacementVectors", None) and getattr(member, "Mesh", None) is not None
             or _is_pipeline(member) and member in listed]
    if not found:
        raise Error(translate(
            "Quadrille", "{}: has no result with displacements: solve it with {} first").format(
                analysis.Label, mesh.Label), "usage", analysis.Name)
    return found[-1]


def _is_pipeline(result) -> bool:
    return result.isDerivedFrom("Fem::FemPostPipeline")


def _poisson(analysis) -> float:
    """Poisson's ratio of the first material that has one; 0.3 if none has."""
    for member in analysis.Group:
        text = getattr(member, "Material", None)
        if isinstance(text, dict) and text.get("PoissonRatio"):
            return float(FreeCAD.Units.Quantity(text["PoissonRatio"]).Value)
    return 0.3


def _write_shells(path: str, fem_mesh) -> None:
    """Writes the quads of a mesh as a CalculiX input file."""
    numbers, points = nodes_of(fem_mesh)
    lines = ["*NODE", *(f"{number},{x:.17g},{y:.17g},{z:.17g}" for number, (x, y, z) in zip(numbers, points))]
    elements = [(face, fem_mesh.getElementNodes(face)) for face in sorted(fem_mesh.Faces)]
    for kind, count in (("S8R", 8), ("S4", 4)):
        of_kind = [f"{face}," + ",".join(map(str, nodes)) for face, nodes in elements if len(nodes) == count]
        if of_kind:
            lines += [f"*ELEMENT, TYPE={kind}", *of_kind]
    with open(path, "w", encoding="utf-8") as file:
        file.write("\n".join(lines) + "\n")


#: By the number of nodes of a brick: VTK's cell type, and the positions of VTK's nodes in FreeCAD's list, which has the top
#: first. VTK's order: bottom, top; with twenty nodes also the midside nodes of the bottom, of the top, and of the upright edges.
_BRICKS = {8: (12, [4, 5, 6, 7, 0, 1, 2, 3]),
           20: (25, [4, 5, 6, 7, 0, 1, 2, 3, 12, 13, 14, 15, 8, 9, 10, 11, 16, 17, 18, 19])}


class _Bricks(NamedTuple):
    """The bricks that CalculiX made of the shells, and their displacements."""

    points: np.ndarray  #: (n, 3) node coordinates
    moved: np.ndarray  #: (n, 3) node displacements
    nodes: np.ndarray  #: the nodes of all bricks, one brick after another, in VTK's order
    ends: np.ndarray  #: where the nodes of each brick end in `nodes`
    kinds: np.ndarray  #: VTK's cell type of each brick


def _bricks_of(result, analysis) -> _Bricks:
    for solver in results.solvers_of(analysis):
        if _is_pipeline(result) and result in getattr(solver, "Results", ()) and getattr(solver, "DisplaceMesh", False):
            raise Error(translate(
                "Quadrille", "{}: its nodes are displaced: set DisplaceMesh of {} to false, and solve again").format(
                    result.Label, solver.Label), "usage",
                        result.Name)
    bricks = _bricks_of_pipeline(result) if _is_pipeline(result) else _bricks_of_object(result)
    if not bricks.kinds.size or not np.isin(bricks.kinds, [kind for kind, _ in _BRICKS.values()]).all():
        solver = next((solver.Label for solver in results.solvers_of(analysis)), "the solver")
        raise Error(translate(
            "Quadrille", "{}: has results at the middle of the shell only: set {} of {} to true, and solve again").format(
                result.Label, results.SURFACE_RESULTS, solver), "usage", result.Name)
    return bricks


def _bricks_of_object(result) -> _Bricks:
    bricks = result.Mesh.FemMesh
    numbers, points = nodes_of(bricks)
    index = np.zeros(numbers.max() + 1, dtype=int)
    index[numbers] = np.arange(len(numbers))
    moved = np.zeros_like(points)
    moved[index[list(result.NodeNumbers)]] = np.array([tuple(vector) for vector in result.DisplacementVectors])
    cells, kinds = [], []
    for volume in sorted(bricks.Volumes):
        nodes = bricks.getElementNodes(volume)
        if len(nodes) not in _BRICKS:
            raise Error(translate(
                "Quadrille", "{}: has no shell elements: an element has {} nodes").format(result.Label, len(nodes)), "usage", result.Name)
        kind, places = _BRICKS[len(nodes)]
        kinds.append(kind)
        cells.append(index[[nodes[place] for place in places]])
    flat = np.concatenate(cells) if cells else np.zeros(0, dtype=int)
    return _Bricks(points, moved, flat, np.cumsum([len(cell) for cell in cells], dtype=int), np.array(kinds, dtype=int))


def last_step(pipeline):
    """VTK's grid with the results of a pipeline, of the last of several steps; None if it has none."""
    grid = pipeline.Data
    while hasattr(grid, "GetNumberOfBlocks"):
        blocks = [grid.GetBlock(number) for number in range(grid.GetNumberOfBlocks())]
        grid = next((block for block in reversed(blocks) if block is not None), None)
    return grid


def _bricks_of_pipeline(pipeline) -> _Bricks:
    from vtkmodules.util.numpy_support import vtk_to_numpy

    grid = last_step(pipeline)
    moved = grid.GetPointData().GetArray("Displacement") if grid is not None else None
    if moved is None:
        raise Error(translate(
            "Quadrille", "{}: has no displacements: solve again").format(pipeline.Label), "usage", pipeline.Name)
    cells = grid.GetCells()
    points, displacements, nodes, ends, kinds = map(vtk_to_numpy, (
        grid.GetPoints().GetData(), moved, cells.GetConnectivityArray(), cells.GetOffsetsArray(), grid.GetCellTypesArray()))
    return _Bricks(points, displacements, nodes, ends[1:], kinds)


def _write_bricks(path: str, bricks: _Bricks) -> None:
    """Writes the bricks and their displacements as a .vtu file."""
    with open(path, "w", encoding="ascii") as file:
        file.write('<?xml version="1.0"?>\n<VTKFile type="UnstructuredGrid" version="0.1" byte_order="LittleEndian">\n'
                   f'<UnstructuredGrid><Piece NumberOfPoints="{len(bricks.points)}" NumberOfCells="{len(bricks.kinds)}">\n')
        for head, arrays in (("PointData", [("U", 3, bricks.moved)]), ("Points", [("Points", 3, bricks.points)]),
                             ("Cells", [("connectivity", 1, bricks.nodes), ("offsets", 1, bricks.ends),
                                        ("types", 1, bricks.kinds)])):
            file.write(f"<{head}>\n")
            for name, width, values in arrays:
                kind = "Float64" if values.dtype.kind == "f" else "Int64"
                file.write(f'<DataArray type="{kind}" Name="{name}" NumberOfComponents="{width}" format="ascii">\n')
                np.savetxt(file, values, fmt="%.17g" if kind == "Float64" else "%d")
                file.write("</DataArray>\n")
            file.write(f"</{head}>\n")
        file.write("</Piece></UnstructuredGrid></VTKFile>\n")
