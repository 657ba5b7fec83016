"""Times FreeCAD's CalculiX writer for a force on two whole faces of a large mesh, with or without the workbench's
wrappers.

    scripts/freecad_python bench/freecad_force.py [--quads 100000] [--order 1] [--without]
"""

import argparse
import sys
import tempfile
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "workbench"))

import FreeCAD
import ObjectsFem
import Part

import quadrille.freecad
from quadrille.solvers import wrappers


def main():
    """Prints the wall-clock and CPU seconds."""
    from femtools import ccxtools

    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--quads", type=int, default=100000)
    parser.add_argument("--order", type=int, default=1)
    parser.add_argument("--without", action="store_true", help="as FreeCAD does it alone")
    options = parser.parse_args()
    if options.without:
        wrappers.WRAPPED = ()
    document = FreeCAD.newDocument("Force")
    part = document.addObject("Part::Feature", "Part")
    part.Shape = Part.makeBox(100, 100, 10)
    analysis = ObjectsFem.makeAnalysis(document, "Analysis")
    make_solver = getattr(ObjectsFem, "makeSolverCalculiXCcxTools", None) or ObjectsFem.makeSolverCalculixCcxTools
    solver = analysis.addObject(make_solver(document, "Solver"))[0]
    material = analysis.addObject(ObjectsFem.makeMaterialSolid(document, "Steel"))[0]
    material.Material = {"Name": "Steel", "YoungsModulus": "210000 MPa", "PoissonRatio": "0.3"}
    analysis.addObject(ObjectsFem.makeElementGeometry2D(document, 1.0, "Thickness"))
    fixed = analysis.addObject(ObjectsFem.makeConstraintFixed(document, "Fixed"))[0]
    fixed.References = [(part, "Face1")]
    force = analysis.addObject(ObjectsFem.makeConstraintForce(document, "Force"))[0]
    force.References = [(part, ("Face5", "Face6"))]
    force.Force = "100 N" if FreeCAD.Version()[0] != "0" else 100.0
    force.Direction = (part, ["Face6"])
    mesh = quadrille.freecad.mesh_object(part, size=(part.Shape.Area / options.quads) ** 0.5, order=options.order,
                                         analysis=analysis)
    document.recompute()
    with tempfile.TemporaryDirectory() as folder:
        fea = ccxtools.FemToolsCcx(analysis, solver, test_mode=True)
        fea.update_objects()
        fea.setup_working_dir(folder, create=True)
        wall, cpu = time.perf_counter(), time.process_time()
        fea.write_inp_file()
        print(f"{mesh.FemMesh.FaceCount} quads of order {options.order}, a force on two faces: input written in "
              f"{time.perf_counter() - wall:.2f} s, CPU {time.process_time() - cpu:.2f} s")


main()
