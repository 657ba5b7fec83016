"""Known answers through FreeCAD's two CalculiX solver objects: thicknesses and materials of their own on each face, forces
on edges and faces, pressure. A strip of two faces, 40 by 10, held at one end; Poisson's ratio is 0."""

import importlib.util
import os
import shutil
import sys
import tempfile
import unittest
from types import SimpleNamespace
from unittest import mock

sys.path.insert(0, os.environ["QUADRILLE_PYTHON"])

import FreeCAD
import ObjectsFem
import Part
from FreeCAD import Vector

import quadrille.freecad as core
from quadrille.solvers import results

LENGTH, WIDTH = 40.0, 10.0
STEEL = 210000.0


def solve_standard(document, analysis, folder):
    """FreeCAD's standard solver object (ccxtools)."""
    from femtools import ccxtools

    make = getattr(ObjectsFem, "makeSolverCalculiXCcxTools", None) or ObjectsFem.makeSolverCalculixCcxTools
    fea = ccxtools.FemToolsCcx(analysis, analysis.addObject(make(document, "Solver"))[0], test_mode=False)
    fea.update_objects()
    fea.setup_working_dir(folder, create=True)
    fea.setup_ccx()
    problems = fea.check_prerequisites()
    if problems:
        raise AssertionError(problems)
    fea.write_inp_file()
    fea.ccx_run()
    fea.load_results()


def solve_framework(document, analysis, folder):
    """FreeCAD's other one: of the solver framework, or, from 1.1 on, with tools of its own."""
    if importlib.util.find_spec("femsolver.calculix.calculixtools"):
        solve_with_tools(document, analysis, folder)
        return
    from femsolver import run

    make = getattr(ObjectsFem, "makeSolverCalculiX", None) or ObjectsFem.makeSolverCalculix
    solver = analysis.addObject(make(document, "Solver"))[0]
    machine = solver.Proxy.createMachine(solver, folder)
    machine.target = run.RESULTS
    machine.start()
    machine.join()
    if machine.failed:
        raise AssertionError(machine.report.errors)


def solve_with_tools(document, analysis, folder):
    """As FreeCAD 1.1 does, whose results are a pipeline: they are read again as the result object that older ones make."""
    from feminout import importCcxFrdResults
    from femsolver.calculix.calculixtools import CalculiXTools

    solver = analysis.addObject(ObjectsFem.makeSolverCalculiX(document, "Solver"))[0]
    solver.WorkingDirectory = folder
    tool = CalculiXTools(solver)
    tool.prepare()
    process = tool.compute()
    process.waitForFinished(-1)
    if process.exitCode() != 0:
        raise AssertionError(bytes(process.readAllStandardOutput()).decode())
    importCcxFrdResults.importFrd(os.path.join(folder, f"{tool.input_deck}.frd"), analysis)


@unittest.skipUnless(shutil.which("ccx"), "CalculiX is not installed")
class SolverTest(unittest.TestCase):
    """Each case with both orders and both solver objects."""

    def strip(self, young, thickness):
        """The strip and its analysis; two of each, for the faces along x."""
        self.document = FreeCAD.newDocument("Test")
        self.addCleanup(lambda name: name in FreeCAD.listDocuments() and FreeCAD.closeDocument(name),
                        self.document.Name)
        half = LENGTH / 2
        faces = [Part.makePlane(half, WIDTH), Part.makePlane(half, WIDTH, Vector(half, 0, 0))]
        part = self.document.addObject("Part::Feature", "Strip")
        part.Shape = Part.makeShell(faces[0].generalFuse([faces[1]], 0.0)[0].Faces)
        analysis = ObjectsFem.makeAnalysis(self.document, "Analysis")
        names = sorted((face.CenterOfMass.x, f"Face{i}") for i, face in enumerate(part.Shape.Faces, 1))
        for (_, name), modulus, depth in zip(names, young, thickness):
            material = analysis.addObject(ObjectsFem.makeMaterialSolid(self.document, "Material"))[0]
            material.Material = {"Name": "M", "YoungsModulus": f"{modulus} MPa", "PoissonRatio": "0.0"}
            material.References = [(part, (name,))]
            shell = analysis.addObject(ObjectsFem.makeElementGeometry2D(self.document, depth, "Thickness"))[0]
            shell.References = [(part, (name,))]
        fixed = analysis.addObject(ObjectsFem.makeConstraintFixed(self.document, "Fixed"))[0]
        fixed.References = [(part, self.ends(part)[0])]
        return part, analysis

    @staticmethod
    def ends(part):
        """The names of the edges across the strip, along x."""
        across = [(edge.CenterOfMass.x, f"Edge{i}") for i, edge in enumerate(part.Shape.Edges, 1)
                  if edge.BoundBox.XLength < 1e-9]
        return [name for _, name in sorted(across)]

    def force(self, analysis, value, references):
        """A force in N."""
        force = analysis.addObject(ObjectsFem.makeConstraintForce(self.document, "Force"))[0]
        force.References = references
        force.Force = f"{value} N" if FreeCAD.Version()[0] != "0" else value
        return force

    def check(self, young, thickness, load, axis, exact, tolerance):
        """Solves each way and compares the largest displacement along an axis."""
        for order in (1, 2):
            for solve in (solve_standard, solve_framework):
                with self.subTest(order=order, solver=solve.__name__), tempfile.TemporaryDirectory() as folder:
                    part, analysis = self.strip(young, thickness)
                    load(part, analysis)
                    core.mesh_object(part, size=2, order=order, analysis=analysis)
                    self.document.recompute()
                    solve(self.document, analysis, folder)
                    result = next(member for member in analysis.Group
                                  if member.isDerivedFrom("Fem::FemResultObject"))
                    largest = max(abs(getattr(vector, axis)) for vector in result.DisplacementVectors)
                    self.assertLess(abs(largest / exact - 1), tolerance)
                    FreeCAD.closeDocument(self.document.Name)

    def test_two_materials_and_two_thicknesses_under_a_force_on_an_edge(self):
        def load(part, analysis):
            long = next(f"Edge{i}" for i, edge in enumerate(part.Shape.Edges, 1) if edge.BoundBox.XLength > 1)
            self.force(analysis, 100.0, [(part, self.ends(part)[-1])]).Direction = (part, [long])

        young, thickness = (STEEL, 70000.0), (1.0, 2.0)
        stretch = sum(100.0 / WIDTH * LENGTH / 2 / (modulus * depth) for modulus, depth in zip(young, thickness))
        self.check(young, thickness, load, "x", stretch, 1e-4)

    def test_pressure(self):
        def load(part, analysis):
            pressure = analysis.addObject(ObjectsFem.makeConstraintPressure(self.document, "Pressure"))[0]
            pressure.References = [(part, ("Face1", "Face2"))]
            pressure.Pressure = "0.001 MPa" if FreeCAD.Version()[0] != "0" else 0.001

        self.check((STEEL, STEEL), (1.0, 1.0), load, "z", 0.001 * LENGTH**4 / (8 * STEEL / 12), 1e-3)

    def test_force_on_faces(self):
        def load(part, analysis):
            self.force(analysis, 0.4, [(part, ("Face1", "Face2"))])

        self.check((STEEL, STEEL), (1.0, 1.0), load, "z", 0.4 / WIDTH / LENGTH * LENGTH**4 / (8 * STEEL / 12), 1e-3)

    def test_only_shells_get_a_hint_at_their_surfaces(self):
        solver = SimpleNamespace(Label="Solver", PropertiesList=[results.SURFACE_RESULTS], **{results.SURFACE_RESULTS: False})
        for element, told in (("shell", 1), ("S8", 1), ("S4R", 1), ("CPS8", 0), ("CAX8R", 0), ("M3D4", 0)):
            mesh = SimpleNamespace(Element=element, PropertiesList=["ReducedShells"])
            with self.subTest(element), mock.patch.object(results, "FreeCAD") as window:
                results.hint_at_surfaces(SimpleNamespace(Label="Result"), SimpleNamespace(Group=[mesh, solver]))
                self.assertEqual(window.Console.PrintWarning.call_count, told)


if __name__ == "__main__":
    unittest.main(verbosity=2, warnings="ignore")  # FreeCAD and PySide warn by the hundred
