# SPDX-License-Identifier: GPL-3.0-or-later
"""From click to visible mesh in FreeCAD's window: Quadrille's panel beside FreeCAD's own Gmsh object, same part, and
the time to write CalculiX's input for both.

    scripts/freecad_gui bench/freecad_speed.py [--part examples/models/bracket.step] [--quads 100000]

Times are wall-clock, from the click on Mesh until the 3-D view has drawn the mesh. Gmsh runs as FreeCAD 0.20's Gmsh
object runs it with its quads on (first order), at the size that gives about as many elements.
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
import ObjectsFem
import Part

import quadrille.freecad
from driver import Boxes, close_panel, find, prepare, process, trigger, wait_for


def quadrille_run(document, part, size):
    """The panel's way; returns seconds until the mesher ended, until all was in FreeCAD, until it was drawn."""
    FreeCADGui.Selection.clearSelection()
    FreeCADGui.Selection.addSelection(part)
    with Boxes():
        trigger("Quadrille_Mesh")
    find("QuadrilleSize").setProperty("rawValue", size)
    find("QuadrilleOrder").setCurrentText("1st")
    process(0.3)
    mesh = document.Objects[-1]
    started = time.perf_counter()
    find("QuadrilleMesh").click()
    wait_for(lambda: find("QuadrilleMesh").isEnabled(), 300, "meshing")
    process(0)
    FreeCADGui.activeDocument().activeView().redraw()
    process(0)
    drawn = time.perf_counter() - started
    log = find("QuadrilleLog").toPlainText()
    close_panel()
    return mesh, drawn, log


def gmsh_run(document, part, size):
    """FreeCAD's Gmsh object, without its panel, as its panel does it."""
    from femmesh import gmshtools

    mesh = ObjectsFem.makeMeshGmsh(document, "Gmsh")
    setattr(mesh, "Shape" if "Shape" in mesh.PropertiesList else "Part", part)
    mesh.CharacteristicLengthMax = size
    mesh.ElementOrder = "1st"
    mesh.ElementDimension = "2D"
    mesh.RecombineAll = True
    process(0.3)
    started = time.perf_counter()
    gmshtools.GmshTools(mesh).create_mesh()
    process(0)
    FreeCADGui.activeDocument().activeView().redraw()
    process(0)
    return mesh, time.perf_counter() - started


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
    parser.add_argument("--runs", type=int, default=3)
    arguments = parser.parse_args()
    prepare()
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
        mesh, seconds, log = quadrille_run(document, part, size)
        ours.append((seconds, mesh.QuadCount, log.splitlines()[-1]))
        print(f"Quadrille  {mesh.QuadCount} quads  {seconds:.2f} s   {log.splitlines()[-1]}", flush=True)
    print(f"Quadrille  input for CalculiX {input_seconds(document, part, mesh):.2f} s", flush=True)
    document.removeObject(mesh.Name)
    for _ in range(arguments.runs):
        mesh, seconds = gmsh_run(document, part, size)
        theirs.append((seconds, mesh.FemMesh.FaceCount))
        print(f"Gmsh       {mesh.FemMesh.FaceCount} elements ({mesh.FemMesh.TriangleCount} triangles)  {seconds:.2f} s",
              flush=True)
    print(f"Gmsh       input for CalculiX {input_seconds(document, part, mesh):.2f} s", flush=True)
    best, other = min(ours), min(theirs)
    print(f"least: {best[0]:.2f} s against {other[0]:.2f} s; per element {other[0] / other[1] / (best[0] / best[1]):.1f} "
          "times faster")


main()
