# SPDX-License-Identifier: GPL-3.0-or-later
"""Measures the time from the click to the visible mesh in FreeCAD's window, for Quadrille's panel and for FreeCAD's own
Gmsh object on the same part, and the writing of CalculiX's input for both.

    scripts/freecad_gui bench/freecad_speed.py [--part examples/models/bracket.step] [--quads 100000] [--order 1st]

Times are wall-clock seconds. "visible" is from the click on Mesh until the 3-D view has drawn the mesh for the first
time. Parts of it: in "read" FreeCAD reads the mesher's file. In "copy" it copies the mesh into the object's property
(timed by one more copy, since FreeCAD copies and builds the picture in one step); "picture" is the rest of that step.
"draw" is the 3-D view. "filled" is from the click until the panel also shows its histogram and worst elements. Gmsh
runs as FreeCAD 0.20's Gmsh object runs it with quads on, at the same size.
"""

import argparse
import statistics
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / "tests" / "freecad" / "gui"))

import FreeCAD
import FreeCADGui
import Fem
import ObjectsFem
import Part
from pivy import coin
from PySide import QtCore, QtGui

import quadrille.freecad
from quadrille.core import jobs
from quadrille.document import undo
from quadrille.gui import quality_view
from driver import Boxes, close_panel, find, prepare, process, trigger, wait_for


class Stopwatch:
    """Adds up the seconds that a module's function takes inside a `with` block."""

    def __init__(self, module, name):
        self._module, self._name, self._function = module, name, getattr(module, name)
        self.seconds, self.ended = 0.0, 0.0

    def __enter__(self):
        def timed(*arguments):
            started = time.perf_counter()
            try:
                return self._function(*arguments)
            finally:
                self.ended = time.perf_counter()
                self.seconds += self.ended - started

        setattr(self._module, self._name, timed)
        return self

    def __exit__(self, *_):
        setattr(self._module, self._name, self._function)


class Frames:
    """Records when the 3-D view shows frames: the scene is traversed, then drawn, then the buffers are swapped."""

    def __init__(self):
        self._begun, self._frames = 0.0, []
        self._node = coin.SoCallback()
        self._node.setCallback(self._drawing)
        FreeCADGui.activeDocument().activeView().getSceneGraph().addChild(self._node)
        for canvas in FreeCADGui.getMainWindow().findChildren(QtGui.QWidget):
            if canvas.inherits("QOpenGLWidget"):
                QtCore.QObject.connect(canvas, QtCore.SIGNAL("frameSwapped()"), self._swapped)

    def _drawing(self, _data, action):
        if action.isOfType(coin.SoGLRenderAction.getClassTypeId()):
            self._begun = time.perf_counter()

    def _swapped(self):
        self._frames.append((self._begun, time.perf_counter()))

    def first_after(self, moment, seconds=60):
        """Processes events until a frame begun after `moment` has been shown; returns when the first was shown."""
        def shown():
            return [end for begun, end in self._frames if begun > moment]

        wait_for(shown, seconds, "a frame of the 3-D view")
        return shown()[0]


def quadrille_run(document, part, size, order, frames):
    """Meshes with Quadrille's panel; returns the mesh object and the seconds of each step."""
    FreeCADGui.Selection.clearSelection()
    FreeCADGui.Selection.addSelection(part)
    with Boxes():
        trigger("Quadrille_Mesh")
    find("QuadrilleSize").setProperty("rawValue", size)
    find("QuadrilleElementOrder").setCurrentText(order)
    process(2)  # no user presses Mesh sooner; by then a mesher is on standby
    mesh, button = document.Objects[-1], find("QuadrilleMesh")
    started = time.perf_counter()
    with Stopwatch(jobs, "read_mesh") as read, Stopwatch(undo, "put") as put:
        button.click()
        while not button.isEnabled():  # as FreeCAD's own loop waits
            if time.perf_counter() - started > 300:
                raise AssertionError("meshing: not within 300 s")
            QtCore.QCoreApplication.processEvents(QtCore.QEventLoop.WaitForMoreEvents)
    stored = time.perf_counter()
    drawn = frames.first_after(put.ended)
    find("QuadrilleWorst").parent().fill_elements()
    filled = time.perf_counter()
    fem_mesh = mesh.FemMesh
    again = time.perf_counter()
    Fem.FemMesh(fem_mesh)  # as the property does it
    copied = time.perf_counter() - again
    close_panel()
    return mesh, {"visible": drawn - started, "mesher": stored - started - read.seconds - put.seconds,
                  "read": read.seconds, "copy": copied, "picture": put.seconds - copied,
                  "draw": drawn - stored, "filled": filled - started}


def gmsh_run(document, part, size, order, frames):
    """Meshes with FreeCAD's Gmsh object as its panel does, but without the panel; returns the mesh and the seconds."""
    from femmesh import gmshtools

    mesh = ObjectsFem.makeMeshGmsh(document, "Gmsh")
    setattr(mesh, "Shape" if "Shape" in mesh.PropertiesList else "Part", part)
    mesh.CharacteristicLengthMax = size
    mesh.ElementOrder = order
    mesh.ElementDimension = "2D"
    mesh.RecombineAll = True
    process(0.3)
    started = time.perf_counter()
    gmshtools.GmshTools(mesh).create_mesh()
    return mesh, frames.first_after(time.perf_counter()) - started


def transfer_percent(seconds):
    """Reading and copying as a percentage of the time until the mesh is visible."""
    return 100 * (seconds["read"] + seconds["copy"]) / seconds["visible"]


def input_seconds(document, part, mesh):
    """Seconds to write CalculiX's input for shells of this mesh with a fixed face."""
    from femtools import ccxtools

    analysis = ObjectsFem.makeAnalysis(document, "Analysis")
    make = getattr(ObjectsFem, "makeSolverCalculiXCcxTools", None) or ObjectsFem.makeSolverCalculixCcxTools
    solver = analysis.addObject(make(document, "Solver"))[0]
    material = analysis.addObject(ObjectsFem.makeMaterialSolid(document, "Steel"))[0]
    material.Material = {"Name": "Steel", "YoungsModulus": "210000 MPa", "PoissonRatio": "0.3"}
    analysis.addObject(ObjectsFem.makeElementGeometry2D(document, 1.0, "Thickness"))
    fixed = analysis.addObject(ObjectsFem.makeConstraintFixed(document, "Fixed"))[0]
    analysis.addObject(mesh)
    fixed.References = [(part, "Face1")]
    document.recompute()
    with tempfile.TemporaryDirectory() as folder:
        fea = ccxtools.FemToolsCcx(analysis, solver, test_mode=True)
        fea.update_objects()
        fea.setup_working_dir(folder, create=True)
        started = time.perf_counter()
        fea.write_inp_file()
        seconds = time.perf_counter() - started
    analysis.removeObject(mesh)
    return seconds


def main():
    """Measures Quadrille and Gmsh in turn; prints each run and the ratios."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--part", default=str(ROOT / "examples/models/bracket.step"))
    parser.add_argument("--quads", type=int, default=100000)
    parser.add_argument("--order", choices=("1st", "2nd"), default="1st")
    parser.add_argument("--runs", type=int, default=3)
    parser.add_argument("--without-gmsh", action="store_true", help="only Quadrille")
    arguments = parser.parse_args()
    prepare()
    quality_view.MEASURE_AFTER_MILLISECONDS = 60000  # measured below, apart from the drawing
    document = FreeCAD.newDocument("Speed")
    FreeCADGui.activateWorkbench("QuadrilleWorkbench")
    part = document.addObject("Part::Feature", "Part")
    part.Shape = Part.read(arguments.part)
    FreeCADGui.SendMsgToActiveView("ViewFit")
    size = quadrille.freecad.suggested_size(part, arguments.quads)
    frames = Frames()
    rows = []
    for _ in range(arguments.runs):
        for mesh in [obj for obj in document.Objects if obj.isDerivedFrom("Fem::FemMeshObject")]:
            document.removeObject(mesh.Name)
        ours, seconds = quadrille_run(document, part, size, arguments.order, frames)
        print(f"Quadrille  {ours.QuadCount} quads  " + "  ".join(f"{name} {value:.2f}" for name, value in seconds.items())
              + f"   transfer {transfer_percent(seconds):.0f} %", flush=True)
        if not arguments.without_gmsh:
            try:
                theirs, other = gmsh_run(document, part, size, arguments.order, frames)
            except RuntimeError as error:  # Gmsh 4.8.4 crashes now and then
                print(f"Gmsh       {error}", flush=True)
                continue
            elements = theirs.FemMesh.FaceCount
            print(f"Gmsh       {elements} elements ({theirs.FemMesh.TriangleCount} triangles)  {other:.2f} s", flush=True)
            rows.append((other / seconds["visible"], other / elements / (seconds["visible"] / ours.QuadCount)))
    print(f"Quadrille  input for CalculiX {input_seconds(document, part, ours):.2f} s", flush=True)
    if rows:
        middle, of_element = (statistics.median(column) for column in zip(*rows))
        print(f"by turns: {', '.join(f'{row[0]:.1f}' for row in sorted(rows))} times faster, {middle:.1f} the middle one; "
              f"{of_element:.1f} an element")
        print(f"Gmsh       input for CalculiX {input_seconds(document, part, theirs):.2f} s", flush=True)


main()
