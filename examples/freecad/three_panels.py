# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws a thin solid, its mesh and its stresses side by side, with VTK.

    xvfb-run -a python3 examples/freecad/three_panels.py DATA.npz PICTURE.png

sheet_bracket.py writes DATA.npz and runs this script. It is a separate process since VTK needs a display."""

import sys

import numpy as np
import vtk
from vtk.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray

WIDTH, HEIGHT, BAR = 610, 700, 110  # panel width, height, and width of the color bar, pixels
INK = (0.10, 0.12, 0.16)


def surface(points, polygons, color=(1, 1, 1), scalars=None, colors=None):
    """An actor of polygons with equal numbers of corners, drawn behind lines on them."""
    cells, places, data = vtk.vtkCellArray(), vtk.vtkPoints(), vtk.vtkPolyData()
    rows = np.hstack([np.full((len(polygons), 1), polygons.shape[1]), polygons]).astype(np.int64)
    cells.SetCells(len(polygons), numpy_to_vtkIdTypeArray(rows.ravel(), deep=True))
    places.SetData(numpy_to_vtk(np.ascontiguousarray(points), deep=True))
    data.SetPoints(places)
    data.SetPolys(cells)
    if scalars is not None:
        data.GetPointData().SetScalars(numpy_to_vtk(np.ascontiguousarray(scalars), deep=True))
    mapper, actor = vtk.vtkPolyDataMapper(), vtk.vtkActor()
    mapper.SetInputData(data)
    if colors is not None:
        mapper.SetLookupTable(colors)
        mapper.UseLookupTableScalarRangeOn()
        mapper.InterpolateScalarsBeforeMappingOn()
    mapper.SetResolveCoincidentTopologyToPolygonOffset()
    mapper.SetRelativeCoincidentTopologyPolygonOffsetParameters(1.5, 2)
    actor.SetMapper(mapper)
    look = actor.GetProperty()
    look.SetColor(*color)
    look.SetInterpolationToFlat()
    look.SetAmbient(0.45 if scalars is None else 0.75)
    look.SetDiffuse(0.6 if scalars is None else 0.3)
    return actor


def lines(points, pairs, width, opacity=1.0, color=INK):
    """An actor of straight lines between points."""
    cells, places, data = vtk.vtkCellArray(), vtk.vtkPoints(), vtk.vtkPolyData()
    rows = np.hstack([np.full((len(pairs), 1), 2), pairs]).astype(np.int64)
    cells.SetCells(len(pairs), numpy_to_vtkIdTypeArray(rows.ravel(), deep=True))
    places.SetData(numpy_to_vtk(np.ascontiguousarray(points), deep=True))
    data.SetPoints(places)
    data.SetLines(cells)
    mapper, actor = vtk.vtkPolyDataMapper(), vtk.vtkActor()
    mapper.SetInputData(data)
    actor.SetMapper(mapper)
    look = actor.GetProperty()
    look.LightingOff()
    look.SetColor(*color)
    look.SetLineWidth(width)
    look.SetOpacity(opacity)
    return actor


def sides(polygons):
    """Each side of the polygons once."""
    pairs = np.concatenate([np.stack([polygons[:, i], np.roll(polygons, -1, axis=1)[:, i]], axis=1)
                            for i in range(polygons.shape[1])])
    return np.unique(np.sort(pairs, axis=1), axis=0)


def rainbow(largest):
    """A color table from dark blue through green and yellow to red, for stresses from 0 to the largest."""
    stops = ((0, 0.16, 0.22, 0.55), (0.2, 0.13, 0.50, 0.72), (0.4, 0.35, 0.73, 0.60), (0.6, 0.78, 0.88, 0.45),
             (0.8, 0.98, 0.68, 0.26), (1, 0.75, 0.05, 0.12))
    table = vtk.vtkLookupTable()
    table.SetNumberOfTableValues(256)
    table.SetRange(0, largest)
    for i in range(256):
        color = [np.interp(i / 255, [stop[0] for stop in stops], [stop[k] for stop in stops]) for k in (1, 2, 3)]
        table.SetTableValue(i, *color)
    table.SetAboveRangeColor(*stops[-1][1:], 1)
    table.UseAboveRangeColorOn()
    return table


def text(words, x, y, size, bold=False, color=INK):
    """An actor of a line of text; x, y: its position as fractions of the panel's width and height."""
    actor = vtk.vtkTextActor()
    actor.SetInput(words)
    actor.GetPositionCoordinate().SetCoordinateSystemToNormalizedViewport()
    actor.SetPosition(x, y)
    look = actor.GetTextProperty()
    look.SetFontSize(size)
    look.SetColor(*color)
    look.SetBold(bold)
    return actor


def color_bar(colors):
    """The color bar at the right of the picture."""
    bar = vtk.vtkScalarBarActor()
    bar.SetLookupTable(colors)
    bar.SetTitle("MPa")
    bar.SetLabelFormat("%.0f")
    bar.SetNumberOfLabels(6)
    bar.SetUnconstrainedFontSize(True)
    bar.SetPosition(0.15, 0.15)
    bar.SetWidth(0.8)
    bar.SetHeight(0.6)
    bar.SetBarRatio(0.3)
    for look in (bar.GetTitleTextProperty(), bar.GetLabelTextProperty()):
        look.SetColor(*INK)
        look.SetFontSize(21)
        look.ItalicOff()
        look.BoldOff()
        look.ShadowOff()
    return bar


def panels(data):
    """A list with each panel's actors, title, and second line."""
    points, triangles = data["solid_points"], data["solid_triangles"]
    solid = [surface(points, triangles, (0.66, 0.74, 0.83)), lines(data["edge_points"], data["edge_pairs"], 2)]
    points, quads = data["mesh_points"], data["mesh_quads"]
    shell = [surface(points, quads, (0.98, 0.84, 0.55)), lines(points, sides(quads), 1.5, 0.9),
             lines(data["rim_points"], data["rim_pairs"], 2.6)]
    found = [(solid, str(data["solid_title"]), str(data["solid_text"])), (shell, str(data["mesh_title"]), str(data["mesh_text"]))]
    if "stress" in data:
        points, skin, stress = data["moved_points"], data["skin"], data["stress"]
        colors = rainbow(data["stress"].max())
        found.append(([surface(points, skin, scalars=stress, colors=colors), lines(points, sides(skin), 1.2, 0.4)],
                      str(data["stress_title"]), str(data["stress_text"])))
    return found


def aimed(camera, points, aspect):
    """Places the camera above a corner, as near as possible so that all points fit below the title."""
    towards = np.array([1.0, -0.78, 0.82])
    towards /= np.linalg.norm(towards)
    right = np.cross([0, 0, 1], towards)
    right /= np.linalg.norm(right)
    up = np.cross(towards, right)
    across, along = points @ right, points @ up
    half = max(0.5 * np.ptp(across) / aspect / 0.93, 0.5 * np.ptp(along) / 0.86)
    center = points.mean(axis=0)
    center = center + (0.5 * (across.min() + across.max()) - center @ right) * right
    center = center + (0.5 * (along.min() + along.max()) + 0.1 * half - center @ up) * up
    camera.ParallelProjectionOn()
    camera.SetFocalPoint(*center)
    camera.SetPosition(*(center + 10 * half * towards))
    camera.SetViewUp(0, 0, 1)
    camera.SetParallelScale(half)


def viewport(window, first, last, props):
    """Adds a renderer between two pixel columns of the window, with its props."""
    width = window.GetSize()[0]
    renderer = vtk.vtkRenderer()
    renderer.SetViewport(first / width, 0, last / width, 1)
    renderer.SetBackground(1, 1, 1)
    for prop in props:
        renderer.AddViewProp(prop)
    window.AddRenderer(renderer)
    return renderer


def main():
    data = np.load(sys.argv[1])
    found = panels(data)
    window = vtk.vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetMultiSamples(8)
    end = WIDTH * len(found)
    window.SetSize(end + (BAR if "stress" in data else 0), HEIGHT)
    points = np.concatenate([data[name] for name in ("solid_points", "moved_points") if name in data])
    for number, (actors, title, words) in enumerate(found):
        titles = text(title, 0.05, 0.93, 27, bold=True), text(words, 0.05, 0.882, 20, color=(0.35, 0.38, 0.43))
        renderer = viewport(window, number * WIDTH, (number + 1) * WIDTH, (*actors, *titles))
        aimed(renderer.GetActiveCamera(), points, WIDTH / HEIGHT)
        renderer.ResetCameraClippingRange()
    if "stress" in data:
        viewport(window, end, end + BAR, [color_bar(rainbow(data["stress"].max()))])
    window.Render()
    grab, writer = vtk.vtkWindowToImageFilter(), vtk.vtkPNGWriter()
    grab.SetInput(window)
    grab.ReadFrontBufferOff()
    writer.SetInputConnection(grab.GetOutputPort())
    writer.SetFileName(sys.argv[2])
    writer.Write()


main()
