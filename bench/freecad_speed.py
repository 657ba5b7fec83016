# SPDX-License-Identifier: GPL-3.0-or-later
"""From click to visible mesh in FreeCAD's window: Quadrille's panel beside FreeCAD's own Gmsh object, same part, and
the time to write CalculiX's input for both.

    scripts/freecad_gui bench/freecad_speed.py [--part examples/models/bracket.step] [--quads 100000] [--order 1st]

Times are wall-clock, from the click on Mesh until the 3-D view has drawn the mesh. Of these, "read" is FreeCAD reading
the mesher's file, "copy" its copying of the mesh into the object's property (timed as one more copy, since FreeCAD does
it in one go with building the picture), "picture" the rest of that, "draw" the 3-D view, "filled" is when the panel has
its histogram and worst elements too. Gmsh runs as FreeCAD 0.20's Gmsh object runs it with its quads on, at the same
size.
"""

import argparse
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
from PySide import QtCore

import quadrille.freecad
from quadrille import jobs, undo
from quadrille.gui import quality_view
from driver import Boxes, close_panel, find, prepare, process, trigger


class Stopwatch:
    """Adds up the seconds that a function of a module takes inside a `with`."""

    def __init__(self, module, name):
        self._module, self._name, self._function = module, name, getattr(module, name)
        self.seconds = 0.0

    def __enter__(self):
        def timed(*arguments):
            started = time.perf_counter()
            try:
                return self._function(*arguments)
            finally:
                self.seconds += time.perf_counter() - started

        setattr(self._module, self._name, timed)
        return self

    def __exit__(self, *_):
        setattr(self._module, self._name, self._function)


def quadrille_run(document, part, size, order):
    """The panel's way; returns the mesh object and the seconds of each step."""
    FreeCADGui.Selection.clearSelection()
    FreeCADGui.Selection.addSelection(part)
    with Boxes():
        trigger("Quadrille_Mesh")
    find("QuadrilleSize").setProperty("rawValue", size)
    find("QuadrilleElementOrder").setCurrentText(order)
    process(0.3)
    mesh, button = document.Objects[-1], find("QuadrilleMesh")
    started = time.perf_counter()
    with Stopwatch(jobs, "read_mesh") as read, Stopwatch(undo, "put") as put:
        button.click()
        while not button.isEnabled():  # as FreeCAD's own loop waits
            if time.perf_counter() - started > 300:
                raise AssertionError("meshing: not within 300 s")
            QtCore.QCoreApplication.processEvents(QtCore.QEventLoop.WaitForMoreEvents)
    stored = time.perf_counter()
    process(0)
    FreeCADGui.activeDocument().activeView().redraw()
    process(0)
    drawn = time.perf_counter()
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


def gmsh_run(document, part, size, order):
    """FreeCAD's Gmsh object, without its panel, as its panel does it."""
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
    process(0)
    FreeCADGui.activeDocument().activeView().redraw()
    process(0)
    return mesh, time.perf_counter() - started


def transfer_percent(seconds):
    """The share of reading and copying in the time until the mesh is visible."""
    return 100 * (seconds["read"] + seconds["copy"]) / seconds["visible"]


def input_seconds(document, part, mesh):
    """Seconds to write CalculiX's input for a plate of this mesh: a fixed face and a force on a face."""
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
    """Measures, three times each, and prints the least."""
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
    ours, theirs = [], []
    for _ in range(arguments.runs):
        for mesh in [obj for obj in document.Objects if obj.isDerivedFrom("Fem::FemMeshObject")]:
            document.removeObject(mesh.Name)
        mesh, seconds = quadrille_run(document, part, size, arguments.order)
        ours.append((seconds["visible"], mesh.QuadCount, seconds))
        print(f"Quadrille  {mesh.QuadCount} quads  " + "  ".join(f"{name} {value:.2f}" for name, value in seconds.items())
              + f"   transfer {transfer_percent(seconds):.0f} %", flush=True)
    print(f"Quadrille  input for CalculiX {input_seconds(document, part, mesh):.2f} s", flush=True)
    document.removeObject(mesh.Name)
    if arguments.without_gmsh:
        return
    for _ in range(arguments.runs):
        mesh, seconds = gmsh_run(document, part, size, arguments.order)
        theirs.append((seconds, mesh.FemMesh.FaceCount))
        print(f"Gmsh       {mesh.FemMesh.FaceCount} elements ({mesh.FemMesh.TriangleCount} triangles)  {seconds:.2f} s",
              flush=True)
    print(f"Gmsh       input for CalculiX {input_seconds(document, part, mesh):.2f} s", flush=True)
    best, other = min(ours, key=lambda row: row[0]), min(theirs)
    print(f"least: {best[0]:.2f} s against {other[0]:.2f} s; per element {other[0] / other[1] / (best[0] / best[1]):.1f} "
          "times faster")


main()
