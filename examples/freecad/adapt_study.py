# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes that follow their own results, compared with uniform ones: `quadrille adapt` in a loop with CalculiX.

    scripts/freecad_python examples/freecad/adapt_study.py --out study.json [--case le1]

Each round meshes, solves, estimates the error of the stresses by patch recovery, and writes the sizes for the next round.
The cases are some of verification.py, and an L-shaped plate with infinite stress at its inner corner.
"""

import argparse
import json
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))

import numpy as np
import Part
from FreeCAD import Vector

import verification  # puts quadrille on sys.path
import quadrille.core.command
from verification import Mesh, Problem, displacements, write_input

MOST_ROUNDS = 10  #: limit on rounds of meshing and solving for each target error
OUTPUT = "*NODE PRINT, NSET=Nall\nU\n*NODE FILE, OUTPUT=3D\nU\n*EL FILE, OUTPUT=3D\nS\n"


class Membrane(verification.EllipticMembrane):
    """NAFEMS LE1. The answer is the stress at the inner end."""

    start, goals = 0.5, (0.02, 0.01, 0.005)
    uniform = (0.5, 0.35, 0.25, 0.17, 0.12, 0.08)


class Hole(verification.PlateWithHole):
    """The plate with a hole. The answer is the stress at the hole's flank."""

    start, goals = 0.8, (0.02, 0.01, 0.005)
    uniform = (0.8, 0.55, 0.4, 0.28, 0.2, 0.14, 0.1)


class Corner:
    """An L of three squares, held at one end and pulled at the other. The stress at its inner corner is infinite."""

    start, goals, reference = 0.25, (0.05, 0.02, 0.01), None
    uniform = (0.25, 0.17, 0.12, 0.08, 0.05, 0.035)

    def shape(self):
        points = [(0, 0), (2, 0), (2, 1), (1, 1), (1, 2), (0, 2), (0, 0)]
        return Part.Face(Part.makePolygon([Vector(x, y, 0) for x, y in points]))

    def problem(self, mesh):
        problem = Problem(1000.0, 0.3, 0.1, plane=True)
        problem.fix(mesh.where(lambda p: p[:, 0] - 2), 1, 2)
        problem.load(mesh.edge_load(mesh.where(lambda p: p[:, 1] - 2), lambda point, normal: 0.1 * normal))
        return problem


class Cylinder(verification.PinchedCylinder):
    """The pinched cylinder as a shell: membrane and bending."""

    start, goals = 60, (0.1, 0.05, 0.02, 0.01)
    uniform = (60, 40, 25, 18, 12)


class FromFile:
    """A shell from a CAD file, clamped in one plane and pulled along (1, 0, 1) at its edges in another."""

    goals, reference = (0.05, 0.02, 0.01), None
    arguments = None  #: the parsed command line

    def __init__(self):
        self._shape = Part.read(self.arguments.part)
        diagonal = self._shape.BoundBox.DiagonalLength
        self.start = diagonal / 15
        self.uniform = tuple(diagonal / n for n in (15, 22, 32, 47, 70, 100))

    def shape(self):
        return self._shape

    @staticmethod
    def plane(text):
        """A function that returns the distances of points from a plane such as x=20."""
        axis, value = text.split("=")
        return lambda points: points[:, "xyz".index(axis)] - float(value)

    def problem(self, mesh):
        problem = Problem(210000.0, 0.3, self.arguments.thickness)
        problem.fix(mesh.where(self.plane(self.arguments.hold)), 1, 2, 3, 4, 5, 6)
        problem.load(mesh.edge_load(mesh.where(self.plane(self.arguments.pull)), lambda point, normal: np.array([10.0, 0.0, 10.0])))
        if not problem.loads:
            raise SystemExit(f"no edge lies in {self.arguments.pull}")
        return problem


CASES = {"le1": Membrane, "hole": Hole, "corner": Corner, "cylinder": Cylinder}


def run(*arguments):
    """Runs the quadrille command. Returns its output."""
    done = subprocess.run([str(quadrille.core.command.find_command()), *map(str, arguments)], capture_output=True, text=True,
                          timeout=600, check=False)
    if done.returncode != 0:
        raise RuntimeError(done.stderr.strip())
    return done.stdout


class Study:
    """One case, with its files in a folder."""

    def __init__(self, case, folder):
        self.case, self.folder = case, Path(folder)
        self.part = self.folder / "part.brep"
        case.shape().exportBrep(str(self.part))

    def solve(self, *options):
        """Meshes and solves. Returns the number of quads, the work of the loads, and the answer if the case has one."""
        run("mesh", self.part, "-o", self.folder / "mesh.msh", "--order", 2, "--quiet", *options)
        mesh = Mesh.of_msh((self.folder / "mesh.msh").read_text())
        problem = self.case.problem(mesh)
        write_input(self.folder / "case.inp", mesh, problem, output=OUTPUT)
        done = subprocess.run(["ccx", "case"], capture_output=True, text=True, timeout=900, check=False, cwd=self.folder)
        if done.returncode != 0:
            raise RuntimeError(done.stdout[-300:])
        moved = displacements((self.folder / "case.dat").read_text(), len(mesh.points))
        energy = sum(float(np.dot(force, moved[node])) for node, force in problem.loads.items())
        return {"quads": len(mesh.elements), "energy": energy, **self.answer(mesh, moved)}

    def answer(self, mesh, moved):
        """The quantity that the case is judged by; empty if that is the energy."""
        if isinstance(self.case, (Corner, FromFile)):
            return {}
        if isinstance(self.case, Cylinder):
            top, bottom = mesh.at(0, 300, 0), mesh.at(0, -300, 0)
            return {"answer": (moved[bottom, 1] - moved[top, 1]) / 2}
        # Our nodes come first in the .frd file. The results of bricks are at later nodes, two or three for each of ours.
        frd = (self.folder / "case.frd").read_text()
        place, axis = ((2, 0, 0), 1) if isinstance(self.case, Membrane) else ((0, 1, 0), 0)
        return {"answer": stress_at(frd, np.array(place, dtype=float), axis)}

    def estimate(self, *options):
        """Estimates the error of the last solution, and writes sizes for the next round. Returns the report."""
        report = self.folder / "adapt.json"
        run("adapt", self.folder / "mesh.msh", self.folder / "case.frd", "-o", self.folder / "sizes.vdb", "--quiet",
            "--report", report, *options)
        return json.loads(report.read_text())


def stress_at(frd, place, axis):
    """A stress component at a place in the xy plane, averaged over all nodes of the bricks there."""
    points, values, block = {}, {}, ""
    for line in frd.splitlines():
        if line.startswith("    2C"):
            block = "nodes"
        elif line.startswith(" -4"):
            block = line.split()[1]
        elif line.startswith(" -3"):
            block = ""
        elif line.startswith(" -1") and block in ("nodes", "STRESS"):
            node = int(line[3:13])
            if block == "nodes":
                points[node] = [float(line[13 + 12 * k:25 + 12 * k]) for k in range(3)]
            else:
                values[node] = float(line[13 + 12 * axis:25 + 12 * axis])
    near = [node for node in values if np.hypot(*(np.array(points[node][:2]) - place[:2])) < 1e-6]
    return float(np.mean([values[node] for node in near]))


def study(name):
    """Solves one case with uniform and with adapted meshes."""
    case, rows = CASES.get(name, FromFile)(), []
    with tempfile.TemporaryDirectory() as folder:
        this = Study(case, folder)
        for size in case.uniform:
            found = this.solve("--size", size)
            rows.append({"kind": "uniform", "size": size, **found, "estimate": this.estimate()["error"]})
            print(name, rows[-1], flush=True)
        this.solve("--size", case.start)
        for goal in case.goals:
            sizes = this.estimate("--error", goal)
            for rounds in range(1, MOST_ROUNDS + 1):
                found = this.solve("--size", sizes["size_max"], "--size-min", sizes["size_min"], "--curvature", 0,
                                   "--size-field", this.folder / "sizes.vdb")
                sizes = this.estimate("--error", goal)
                if sizes["error"] <= goal:
                    break
            rows.append({"kind": "adapted", "goal": goal, "rounds": rounds, **found, "estimate": sizes["error"]})
            rows[-1]["over_uniform"] = found["quads"] / uniform_quads(rows, sizes["error"])
            print(name, rows[-1], flush=True)
    return rows


def plot(rows, path):
    """Plots the estimated errors over the numbers of elements."""
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot

    figure, axes = pyplot.subplots(1, len(rows), figsize=(4 * len(rows), 3.4), squeeze=False)
    for axis, (name, found) in zip(axes[0], rows.items()):
        for kind, style in (("uniform", "o-"), ("adapted", "s-")):
            mine = [row for row in found if row["kind"] == kind]
            axis.loglog([row["quads"] for row in mine], [100 * row["estimate"] for row in mine], style, label=kind)
        axis.set(title=name, xlabel="quads", ylabel="estimated error, %")
        axis.grid(True, which="both", alpha=0.3)
        axis.legend()
    figure.tight_layout()
    figure.savefig(path, dpi=90)


def uniform_quads(rows, error):
    """The number of quads that uniform meshes need for an error, inter- or extrapolated from the two nearest solved meshes."""
    points = np.log([(row["estimate"], row["quads"]) for row in rows if row["kind"] == "uniform"])
    points = points[np.argsort(points[:, 0])]
    at = int(np.clip(np.searchsorted(points[:, 0], np.log(error)), 1, len(points) - 1))
    (low, few), (high, many) = points[at - 1], points[at]
    return float(np.exp(few + (np.log(error) - low) / (high - low) * (many - few)))


def main():
    """Command line."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n", 1)[0])
    parser.add_argument("--case", choices=CASES, action="append")
    parser.add_argument("--out", default="study.json")
    parser.add_argument("--plot", help="draw the errors into this .png")
    parser.add_argument("--check", action="store_true",
                        help="fail unless the last adapted mesh has the target error with a third of the uniform elements")
    parser.add_argument("--part", help="a shell of your own (.brep, .step) instead of the cases")
    parser.add_argument("--hold", metavar="x=0", help="of the part: the plane where it is clamped")
    parser.add_argument("--pull", metavar="y=100", help="of the part: the plane with the edges that are pulled")
    parser.add_argument("--thickness", type=float, default=1.0, help="of the part (default 1)")
    arguments = parser.parse_args()
    if arguments.part and not (arguments.hold and arguments.pull):
        parser.error("--part needs --hold and --pull")
    FromFile.arguments = arguments
    if not shutil.which("ccx"):
        print("CalculiX (ccx) is not installed: nothing is solved")
        return
    rows = {name: study(name) for name in ([Path(arguments.part).stem] if arguments.part else arguments.case or CASES)}
    Path(arguments.out).write_text(json.dumps(rows, indent=1) + "\n")
    if arguments.plot:
        plot(rows, arguments.plot)
    for name, found in rows.items():
        last = found[-1]
        if arguments.check and not (last["estimate"] <= last["goal"] and last["over_uniform"] < 1 / 3):
            sys.exit(f"{name}: {last['quads']} adapted quads have an error of {last['estimate']:.3g}, "
                     f"{last['over_uniform']:.2g} times as many as uniform ones")


if __name__ == "__main__":
    main()
