# SPDX-License-Identifier: GPL-3.0-or-later
"""Solves and meshes in turn until the estimated error of the stresses reaches the target.

    scripts/freecad_python examples/freecad/adapt_loop.py [DOCUMENT.FCStd] [--error 0.03] [--rounds 6] [--save ADAPTED.FCStd]

DOCUMENT must have an analysis with a quad mesh, a CalculiX solver (CcxTools, or that of FreeCAD 1.1), material, thickness,
supports and loads. Without DOCUMENT, the cantilever plate with a hole of parameter_study.py is used. Loads and supports stay
valid, since they refer to the part.
"""

import argparse
import shutil
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "workbench"))
sys.path.insert(0, str(Path(__file__).resolve().parent))

import FreeCAD

import parameter_study
import quadrille.adaption
import quadrille.freecad
from quadrille.document import groups
from quadrille.document.state import is_quad_mesh
from quadrille.solvers import results


def sample():
    """The plate with a hole, meshed coarsely."""
    document = FreeCAD.newDocument("Plate")
    part, drill = parameter_study.make_part(document)
    drill.Radius = 8
    document.recompute()
    analysis, _, _, fixed, force = parameter_study.make_analysis(document, part)
    fixed.References = [(part, parameter_study.edge_at(part.Shape, 0.0))]
    force.References = [(part, parameter_study.edge_at(part.Shape, parameter_study.LENGTH))]
    quadrille.freecad.mesh_object(part, size=10, analysis=analysis)
    return document


def solve(analysis, folder):
    """Runs CalculiX through FreeCAD's solver object. The results of the last run are removed."""
    for solver in results.solvers_of(analysis):
        if solver.Proxy.Type == "Fem::SolverCalculiX":  # from FreeCAD 1.1 on
            solve_to_pipeline(solver, folder)
            return
    from femtools import ccxtools

    fea = ccxtools.FemToolsCcx(analysis, test_mode=False)
    fea.update_objects()
    fea.setup_working_dir(folder, create=True)
    fea.setup_ccx()
    problems = fea.check_prerequisites()
    if problems:
        raise SystemExit(problems.strip())
    fea.purge_results()
    fea.write_inp_file()
    fea.ccx_run()
    fea.load_results()


def solve_to_pipeline(solver, folder):
    """Runs CalculiX through the solver object whose results are a pipeline."""
    from femsolver.calculix.calculixtools import CalculiXTools

    solver.WorkingDirectory = folder
    tool = CalculiXTools(solver)
    tool.prepare()
    process = tool.compute()
    if not process.waitForFinished(-1) or process.exitCode() != 0:
        raise SystemExit(bytes(process.readAllStandardOutput()).decode(errors="replace"))
    tool.update_properties()


def largest_stress(mesh, analysis):
    """The largest von Mises stress in the result whose error is estimated, MPa."""
    result = quadrille.adaption.last_result(mesh, analysis)
    if result.isDerivedFrom("Fem::FemResultObject"):
        return max(result.vonMises)
    return max(quadrille.adaption.last_step(result).GetPointData().GetArray("von Mises Stress").GetRange())


def main():
    """Command line."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n", 1)[0])
    parser.add_argument("document", nargs="?")
    parser.add_argument("--error", type=float, default=0.03, help="target error, relative (default 0.03)")
    parser.add_argument("--rounds", type=int, default=6, help="at most (default 6)")
    parser.add_argument("--save", help="keep the document with the last mesh and result here")
    arguments = parser.parse_args()
    if not shutil.which("ccx"):
        print("CalculiX (ccx) is not installed: nothing is solved")
        return
    document = FreeCAD.openDocument(arguments.document) if arguments.document else sample()
    meshes = [obj for obj in document.Objects if is_quad_mesh(obj)]
    analysis = groups.analysis_of(meshes[0]) if len(meshes) == 1 else None
    if analysis is None:
        raise SystemExit(f"{document.Label}: must have one quad mesh in an analysis")
    mesh = meshes[0]
    for solver in results.solvers_of(analysis):
        setattr(solver, results.SURFACE_RESULTS, True)
    print("round  quads  error %  largest stress MPa")
    error = 1.0
    with tempfile.TemporaryDirectory() as folder:
        for number in range(arguments.rounds):
            quads = mesh.QuadCount
            solve(analysis, folder)
            last = number + 1 == arguments.rounds
            found = quadrille.adaption.estimate(mesh) if last else quadrille.adaption.adapt(mesh, error=arguments.error)
            error = found.error
            print(f"{number + 1:5d} {quads:6d} {100 * error:8.2f} {largest_stress(mesh, analysis):19.4g}", flush=True)
            if error <= arguments.error:
                for warning in found.warnings:
                    print(f"warning: {warning}")
                break
    if arguments.save:
        document.saveAs(str(Path(arguments.save).absolute()))
    if error > arguments.error:
        raise SystemExit(f"{mesh.Label}: the error is still {100 * error:.2f} % after {arguments.rounds} rounds")


if __name__ == "__main__":
    main()
