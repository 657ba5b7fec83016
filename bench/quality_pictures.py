#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws parts meshed by Quadrille and by Gmsh side by side, colored by each quad's worst criterion, with a histogram.

    PYTHONPATH=build/python xvfb-run -a bench/quality_pictures.py --quadrille build/quadrille --gmsh "Gmsh 4.8.4=gmsh" -o parts.png PART...

Every mesher gets the diagonal over --div as size, an eighth of it as minimum size, twelve elements per circle, one thread. Gmsh recombines
at twice the size and subdivides, its best all-quad mode. The table is printed to standard output as Markdown."""

import argparse
import subprocess
import tempfile
from pathlib import Path
from typing import Dict, List, NamedTuple, Optional

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
import vtk
from matplotlib.colors import LinearSegmentedColormap
from vtk.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy

import quadrille
from quadrille.core.quality import CRITERIA, measure_quads

#: Colors for shares of the limit from 0 to 2: green to yellow inside the limits, red beyond.
COLORS = LinearSegmentedColormap.from_list("limits", [(0, "#1a9850"), (0.3, "#91cf60"), (0.499, "#fee08b"), (0.5, "#f46d43"), (1, "#a50026")])


class Meshed(NamedTuple):
    """The mesh of one part by one mesher."""

    points: np.ndarray  #: (n, 3)
    quads: np.ndarray  #: (m, 4) indices of points
    shares: np.ndarray  #: (m,) worst criterion of each quad, 0 = ideal, 1 = at its limit; without warp, which curvature forces
    q: np.ndarray  #: (m,)


def shares_of(points: np.ndarray, quads: np.ndarray) -> Meshed:
    """Measures quads."""
    quality = measure_quads(np.arange(len(quads)), quads, points[quads])
    shares = [(quality.criteria[name] - ideal) / (limit - ideal) for name, (ideal, limit) in CRITERIA.items()
              if name not in ("warp", "min_length")]
    return Meshed(points, quads, np.max(shares, axis=0), quality.q)


def mesh_by_quadrille(command: str, part: Path, size: float, folder: Path, options: List[str]) -> Optional[Meshed]:
    """Meshes with the command, as in the README, and with further options."""
    out = folder / "quadrille.msh"
    subprocess.run([command, "mesh", str(part), "-o", str(out), "--size", repr(size), "--size-min", repr(size / 8), "--threads", "1",
                    "--quiet", *options], check=True)
    return read(out)


def mesh_by_gmsh(command: str, part: Path, size: float, folder: Path) -> Optional[Meshed]:
    """Meshes with Gmsh; None if that gives no mesh with quads within five minutes."""
    out = folder / "gmsh.msh"
    out.unlink(missing_ok=True)
    settings = {"Mesh.MeshSizeFromCurvature": 6, "Mesh.Algorithm": 6, "Mesh.RecombineAll": 1, "Mesh.RecombinationAlgorithm": 1,
                "Mesh.SubdivisionAlgorithm": 1, "General.AbortOnError": 0}
    arguments = [text for name, value in settings.items() for text in ("-setnumber", name, str(value))]
    try:
        subprocess.run([command, str(part), "-2", "-nt", "1", "-format", "msh22", "-clmax", repr(2 * size), "-clmin", repr(size / 4),
                        *arguments, "-o", str(out)], check=False, timeout=300, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    except subprocess.TimeoutExpired:
        return None
    return read(out) if out.exists() else None


def read(path: Path) -> Optional[Meshed]:
    mesh = quadrille.read_mesh(str(path))
    quads = np.asarray(mesh.quads)[:, :4]
    return shares_of(np.asarray(mesh.points), quads) if len(quads) else None


def picture(meshed: Meshed, width: int, height: int) -> np.ndarray:
    """The picture as (height, width, 3) bytes, viewed from above toward a corner."""
    cells = np.hstack([np.full((len(meshed.quads), 1), 4), meshed.quads]).astype(np.int64).ravel()
    polygons, points, data = vtk.vtkCellArray(), vtk.vtkPoints(), vtk.vtkPolyData()
    polygons.SetCells(len(meshed.quads), numpy_to_vtkIdTypeArray(cells, deep=True))
    points.SetData(numpy_to_vtk(np.ascontiguousarray(meshed.points), deep=True))
    data.SetPoints(points)
    data.SetPolys(polygons)
    colors = (COLORS(np.clip(meshed.shares / 2, 0, 1))[:, :3] * 255).astype(np.uint8)
    data.GetCellData().SetScalars(numpy_to_vtk(colors, deep=True))
    mapper, actor, renderer, window = vtk.vtkPolyDataMapper(), vtk.vtkActor(), vtk.vtkRenderer(), vtk.vtkRenderWindow()
    mapper.SetInputData(data)
    actor.SetMapper(mapper)
    actor.GetProperty().EdgeVisibilityOn()
    actor.GetProperty().SetEdgeColor(0.2, 0.2, 0.2)
    actor.GetProperty().SetLineWidth(0.5)
    actor.GetProperty().LightingOff()
    renderer.AddActor(actor)
    renderer.SetBackground(1, 1, 1)
    camera = renderer.GetActiveCamera()
    camera.ParallelProjectionOn()
    camera.SetPosition(1, -1.4, 1.1)
    camera.SetViewUp(0, 0, 1)
    renderer.ResetCamera()
    camera.Zoom(1.15)
    window.SetOffScreenRendering(1)
    window.SetMultiSamples(8)
    window.SetSize(width, height)
    window.AddRenderer(renderer)
    window.Render()
    grab = vtk.vtkWindowToImageFilter()
    grab.SetInput(window)
    grab.ReadFrontBufferOff()
    grab.Update()
    image = grab.GetOutput()
    return vtk_to_numpy(image.GetPointData().GetScalars()).reshape(height, width, 3)[::-1]


def draw(rows: Dict[str, Dict[str, Optional[Meshed]]], out: Path) -> None:
    """Draws a row for each part: its meshes and their histograms."""
    names = list(next(iter(rows.values())))
    figure, axes = plt.subplots(len(rows), len(names) + 1, figsize=(4.2 * (len(names) + 1), 3 * len(rows)), squeeze=False)
    edges = np.linspace(0, 2, 41)
    for line, (part, meshes) in zip(axes, rows.items()):
        for axis, name in zip(line, names):
            axis.set_axis_off()
            meshed = meshes[name]
            if meshed is None:
                axis.set_title(f"{name}: no mesh", fontsize=9)
                continue
            axis.imshow(picture(meshed, 560, 400))
            axis.set_title(f"{name}: {len(meshed.quads)} quads, q {meshed.q.mean():.3f}, {100 * (meshed.shares > 1).mean():.1f} % outside",
                           fontsize=9)
            line[-1].hist(np.clip(meshed.shares, 0, 2), edges, weights=np.full(len(meshed.shares), 100 / len(meshed.shares)),
                          histtype="step", label=name)
        line[-1].axvline(1, color="#a50026", linewidth=0.8)
        line[-1].set_title(part, fontsize=9)
        line[-1].tick_params(labelsize=7)
    axes[0, -1].legend(fontsize=7)
    axes[-1, -1].set_xlabel("worst criterion, share of its limit; % of quads", fontsize=8)
    figure.tight_layout()
    figure.savefig(out, dpi=80, pil_kwargs={"optimize": True})


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("parts", nargs="+", type=Path)
    parser.add_argument("--quadrille", default="quadrille", help="the command")
    parser.add_argument("--also", action="append", default=[], help='NAME=OPTIONS: Quadrille with these, as "squares=--aspect 1"')
    parser.add_argument("--gmsh", action="append", default=[], help="NAME=COMMAND, once for each version")
    parser.add_argument("--div", type=float, default=60, help="the size is the diagonal over this")
    parser.add_argument("-o", "--out", type=Path, required=True, help=".png")
    arguments = parser.parse_args()
    peers: List[List[str]] = [text.split("=", 1) for text in arguments.gmsh]
    ways: List[List[str]] = [["Quadrille", ""], *(text.split("=", 1) for text in arguments.also)]
    rows: Dict[str, Dict[str, Optional[Meshed]]] = {}
    with tempfile.TemporaryDirectory() as folder:
        for part in arguments.parts:
            size = quadrille.read(str(part)).diagonal / arguments.div
            meshes = {name: mesh_by_quadrille(arguments.quadrille, part, size, Path(folder), options.split()) for name, options in ways}
            for name, command in peers:
                meshes[name] = mesh_by_gmsh(command, part, size, Path(folder))
            rows[part.stem] = meshes
    print("| part | " + " | ".join(f"{name}: quads, q, outside" for name in next(iter(rows.values()))) + " |")
    print("| --- |" + " --- |" * (len(ways) + len(peers)))
    for part, meshes in rows.items():
        cells = ["no mesh" if m is None else f"{len(m.quads)}, {m.q.mean():.3f}, {100 * (m.shares > 1).mean():.2f} %" for m in meshes.values()]
        print(f"| {part} | " + " | ".join(cells) + " |")
    draw(rows, arguments.out)


if __name__ == "__main__":
    main()
