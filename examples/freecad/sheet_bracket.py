# SPDX-License-Identifier: GPL-3.0-or-later
"""A bracket bent of sheet, from its solid to the stresses of a shell; this is what ./run.sh runs.

    scripts/freecad_python examples/freecad/sheet_bracket.py [--size 2] [--out out/sample]

In FreeCAD: the solid, its middle surface with the thickness, supports and loads that were picked on the solid's faces and move to
the middle surface, a mirror-symmetric mesh of quads, CalculiX. Writes out/sample.FCStd, out/sample.inp (for CalculiX, complete) and
out/sample.png. Four bolts hold the foot; 100 N pull at the four screws in the wall, along the bore.
"""

import argparse
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "workbench"))  # not needed where the addon is installed

import FreeCAD
import numpy as np
import ObjectsFem
import Part

import quadrille.freecad
import quadrille.middle

FORCE, BOLT, SCREW = 100.0, 4.0, 2.75  # N; the radii of the holes, mm


def holes(shape, radius):
    """The names of the cylindrical faces of a radius."""
    return [f"Face{i}" for i, face in enumerate(shape.Faces, 1)
            if isinstance(face.Surface, Part.Cylinder) and abs(face.Surface.Radius - radius) < 1e-6]


def make_analysis(document, part):
    """What a user picks on the solid: bolts, pull, steel."""
    analysis = ObjectsFem.makeAnalysis(document, "Analysis")
    make_solver = getattr(ObjectsFem, "makeSolverCalculiXCcxTools", None) or ObjectsFem.makeSolverCalculixCcxTools
    solver = analysis.addObject(make_solver(document, "CalculiX"))[0]
    solver.AnalysisType, solver.GeometricalNonlinearity = "static", "linear"
    solver.BeamShellResultOutput3D = True  # stresses at the surfaces of the sheet
    material = analysis.addObject(ObjectsFem.makeMaterialSolid(document, "Steel"))[0]
    material.Material = {"Name": "Steel", "YoungsModulus": "210000 MPa", "PoissonRatio": "0.3"}
    bolts = analysis.addObject(ObjectsFem.makeConstraintFixed(document, "Bolts"))[0]
    bolts.References = [(part, holes(part.Shape, BOLT))]
    pull = analysis.addObject(ObjectsFem.makeConstraintForce(document, "Pull"))[0]
    pull.References = [(part, holes(part.Shape, SCREW))]
    pull.Force = f"{FORCE} N" if FreeCAD.Version()[0] != "0" else FORCE
    wall = next(f"Face{i}" for i, face in enumerate(part.Shape.Faces, 1) if face.BoundBox.XMax < 1e-6)
    pull.Direction = (part, [wall])
    pull.Reversed = True
    return analysis, solver


def solve(analysis, solver, inp):
    """Writes CalculiX's input; returns the result object, None where there is no CalculiX."""
    from femtools import ccxtools

    fea = ccxtools.FemToolsCcx(analysis, solver)
    fea.update_objects()
    with tempfile.TemporaryDirectory() as folder:
        fea.setup_working_dir(folder, create=True)
        fea.write_inp_file()
        shutil.copyfile(fea.inp_file_name, inp)
        if not shutil.which("ccx"):
            return None
        fea.setup_ccx()
        problem = fea.check_prerequisites()
        if problem:
            raise SystemExit(f"error: FreeCAD refuses the analysis: {problem}")
        fea.ccx_run()
        fea.load_results()
    return next(member for member in analysis.Group if member.isDerivedFrom("Fem::FemResultObject"))


def as_arrays(fem_mesh):
    """Numbers and points of the nodes; the corners of quads and of hexahedra, as rows of the points."""
    nodes = fem_mesh.Nodes  # a copy each time
    numbers = sorted(nodes)
    rows = {number: row for row, number in enumerate(numbers)}
    corners = [np.array([[rows[node] for node in fem_mesh.getElementNodes(element)[:count]] for element in elements])
               for elements, count in ((fem_mesh.Faces, 4), (fem_mesh.Volumes, 8))]
    return numbers, np.array([tuple(nodes[number]) for number in numbers]), *corners


def outlines(shape):
    """Points on the edges of a shape, and the pairs of them that lines join."""
    points, pairs = [], []
    for edge in shape.Edges:
        run = edge.discretize(Deflection=0.02)
        pairs += [(len(points) + i, len(points) + i + 1) for i in range(len(run) - 1)]
        points += [tuple(point) for point in run]
    return np.array(points), np.array(pairs)


def skin_of(hexahedra):
    """The sides of hexahedra that only one of them has."""
    faces = np.concatenate([hexahedra[:, side] for side in
                            ([0, 1, 2, 3], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7])])
    _, first, count = np.unique(np.sort(faces, axis=1), axis=0, return_index=True, return_counts=True)
    return faces[first[count == 1]]


def draw(part, surface, mesh, result, path):
    """The solid, the middle surface with its mesh and the stresses, side by side."""
    data = {}
    data["edge_points"], data["edge_pairs"] = outlines(part.Shape)
    points, triangles = part.Shape.tessellate(0.02)
    data["solid_points"], data["solid_triangles"] = np.array([tuple(point) for point in points]), np.array(triangles)
    data["solid_title"], data["solid_text"] = "A solid of sheet metal", f"{len(part.Shape.Faces)} faces"
    data["rim_points"], data["rim_pairs"] = outlines(surface.Shape)
    _, data["mesh_points"], data["mesh_quads"], _ = as_arrays(mesh.FemMesh)
    data["mesh_title"] = "Its middle surface, meshed"
    thicknesses = sorted({f"{thickness:g}" for thickness in surface.Thicknesses}, key=float)
    data["mesh_text"] = f"{mesh.QuadCount} quads, {' and '.join(thicknesses)} mm thick"
    if result is not None:
        numbers, points, _, hexahedra = as_arrays(result.Mesh.FemMesh)
        rows = {number: row for row, number in enumerate(result.NodeNumbers)}
        order = [rows[number] for number in numbers]
        moves = np.array([tuple(vector) for vector in result.DisplacementVectors])[order]
        scale = 0.1 * part.Shape.BoundBox.DiagonalLength / np.linalg.norm(moves, axis=1).max()
        scale = float(f"{scale:.1g}")
        data["moved_points"], data["skin"] = points + scale * moves, skin_of(hexahedra)
        data["stress"] = np.array(result.vonMises)[order]
        data["largest"] = data["stress"].max()
        data["stress_title"] = "Stresses in the shell, by CalculiX"
        data["stress_text"] = f"von Mises, deformed {scale:g} times; {FORCE:g} N pull at the wall"
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "panels.npz"
        np.savez(file, **data)
        subprocess.run(["xvfb-run", "-a", str(Path(sys.prefix) / "bin" / "python3"), str(Path(__file__).with_name("three_panels.py")),
                        str(file), str(path)], check=True)


def reaction(dat):
    """The sum of the forces at the supports that CalculiX wrote, N."""


def main():
    """Solid in, stresses out."""
    parser = argparse.ArgumentParser(prog="./run.sh", description=__doc__.split("\n", 1)[0])
    parser.add_argument("--size", type=float, default=2.0, help="target edge length in mm (2)")
    parser.add_argument("--out", default="out/sample", help=argparse.SUPPRESS)
    parser.add_argument("--part", default=str(ROOT / "examples/models/sheet_bracket.step"))
    arguments = parser.parse_args()
    out = Path(arguments.out)
    out.parent.mkdir(parents=True, exist_ok=True)
    document = FreeCAD.newDocument("Bracket")
    part = document.addObject("Part::Feature", "Bracket")
    part.Shape = Part.read(arguments.part)
    analysis, solver = make_analysis(document, part)
    document.recompute()
    surface = quadrille.middle.make_middle(part, analysis=analysis, move_loads=True)
    mesh = quadrille.freecad.mesh_object(surface, size=arguments.size, order=2, symmetry=True, elements_per_circle=20, analysis=analysis)
    document.recompute()
    result = solve(analysis, solver, f"{out}.inp")
    document.saveAs(f"{out}.FCStd")
    draw(part, surface, mesh, result, f"{out}.png")
    print(f"{mesh.QuadCount} quads, {mesh.NodeCount} nodes, q {mesh.WorstQuality:.2f} at worst, {mesh.MeanQuality:.2f} mean")
    if result is None:
        print("CalculiX (ccx) is not installed: nothing is solved")
    else:
        print(f"largest stress {max(result.vonMises):.1f} MPa")


if __name__ == "__main__":
    main()
