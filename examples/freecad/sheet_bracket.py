# SPDX-License-Identifier: GPL-3.0-or-later
"""A bracket bent of sheet, from its solid to the stresses of a shell; this is what ./run.sh runs.

    scripts/freecad_python examples/freecad/sheet_bracket.py [--size 3] [--out out/sample]

Steps in FreeCAD: the solid; its middle surface with the thickness; supports and loads, picked on the solid's faces and moved
to the middle surface; an all-quad mesh; CalculiX. Writes out/sample.FCStd, out/sample.inp (the complete input for
CalculiX) and out/sample.png. Four bolts hold the foot. 100 N pull at the four screws in the wall, along the bore.
"""

import argparse
import re
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
    """The names of the cylindrical faces with this radius."""
    return [f"Face{i}" for i, face in enumerate(shape.Faces, 1)
            if isinstance(face.Surface, Part.Cylinder) and abs(face.Surface.Radius - radius) < 1e-6]


def make_analysis(document, part):
    """An analysis as a user would set it up on the solid: bolts, pull, steel."""
    analysis = quadrille.freecad.make_analysis(document)
    solver = next(member for member in analysis.Group if hasattr(member, "AnalysisType"))
    solver.AnalysisType, solver.GeometricalNonlinearity = "static", "linear"
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
    """Writes CalculiX's input and solves. Returns the result object and the force that the bolts hold, in N; (None, None) if
    CalculiX is not installed."""
    from femtools import ccxtools

    fea = ccxtools.FemToolsCcx(analysis, solver)
    fea.update_objects()
    with tempfile.TemporaryDirectory() as folder:
        fea.setup_working_dir(folder, create=True)
        fea.write_inp_file()
        shutil.copyfile(fea.inp_file_name, inp)
        if not shutil.which("ccx"):
            return None, None
        fea.setup_ccx()
        problem = fea.check_prerequisites()
        if problem:
            raise SystemExit(f"error: FreeCAD refuses the analysis: {problem}")
        fea.ccx_run()
        fea.load_results()
        text = Path(fea.inp_file_name).with_suffix(".dat").read_text(encoding="ascii")
    held = re.search(r"total force .*for set BOLTS.*\n\s*(\S+)\s+(\S+)\s+(\S+)", text)
    result = next(member for member in analysis.Group if member.isDerivedFrom("Fem::FemResultObject"))
    return result, np.array([float(word) for word in held.groups()])


def as_arrays(fem_mesh):
    """The node numbers and points, and the corners of quads and of hexahedra, as row indices into the points."""
    nodes = fem_mesh.Nodes  # each access makes a copy
    numbers = sorted(nodes)
    rows = {number: row for row, number in enumerate(numbers)}
    corners = [np.array([[rows[node] for node in fem_mesh.getElementNodes(element)[:count]] for element in elements])
               for elements, count in ((fem_mesh.Faces, 4), (fem_mesh.Volumes, 8))]
    return numbers, np.array([tuple(nodes[number]) for number in numbers]), *corners


def outlines(shape):
    """Points on the edges of a shape, and the pairs of points that are joined by lines."""
    points, pairs = [], []
    for edge in shape.Edges:
        run = edge.discretize(Deflection=0.02)
        pairs += [(len(points) + i, len(points) + i + 1) for i in range(len(run) - 1)]
        points += [tuple(point) for point in run]
    return np.array(points), np.array(pairs)


def skin_of(hexahedra):
    """The sides of hexahedra that belong to only one of them."""
    faces = np.concatenate([hexahedra[:, side] for side in
                            ([0, 1, 2, 3], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7])])
    _, first, count = np.unique(np.sort(faces, axis=1), axis=0, return_index=True, return_counts=True)
    return faces[first[count == 1]]


def draw(part, surface, mesh, result, path):
    """Draws the solid, the middle surface with its mesh, and the stresses side by side."""
    data = {"solid_title": "A solid of sheet metal", "solid_text": f"{len(part.Shape.Faces)} faces",
            "mesh_title": "Its middle surface, meshed",
            "mesh_text": f"{mesh.QuadCount} quads, {' and '.join(f'{mm:g}' for mm in thicknesses(surface))} mm thick"}
    points, triangles = part.Shape.tessellate(0.02)
    data["solid_points"], data["solid_triangles"] = np.array([tuple(point) for point in points]), np.array(triangles)
    data["edge_points"], data["edge_pairs"] = outlines(part.Shape)
    data["rim_points"], data["rim_pairs"] = outlines(surface.Shape)
    _, data["mesh_points"], data["mesh_quads"], _ = as_arrays(mesh.FemMesh)
    if result is not None:
        numbers, points, _, hexahedra = as_arrays(result.Mesh.FemMesh)
        rows = {number: row for row, number in enumerate(result.NodeNumbers)}
        order = [rows[number] for number in numbers]
        moves = np.array([tuple(vector) for vector in result.DisplacementVectors])[order]
        scale = float(f"{0.1 * part.Shape.BoundBox.DiagonalLength / np.linalg.norm(moves, axis=1).max():.1g}")
        data["moved_points"], data["skin"] = points + scale * moves, skin_of(hexahedra)
        data["stress"] = np.array(result.vonMises)[order]
        data["stress_title"] = "Stresses in the shell, by CalculiX"
        data["stress_text"] = f"von Mises, deformed {scale:g} times; {FORCE:g} N pull at the wall"
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "panels.npz"
        np.savez(file, **data)
        subprocess.run(["xvfb-run", "-a", str(Path(sys.prefix) / "bin" / "python3"), str(Path(__file__).with_name("three_panels.py")),
                        str(file), str(path)], check=True)


def thicknesses(surface):
    """The different thicknesses of a middle surface, mm, ascending."""
    return sorted({float(f"{thickness:.6g}") for thickness in surface.Thicknesses})


def job(out, size):
    """Does all steps from the solid to the picture. Returns the middle surface, the mesh, the result and the bolts' force."""
    document = FreeCAD.newDocument("Bracket")
    part = document.addObject("Part::Feature", "Bracket")
    part.Shape = Part.read(str(Path(__file__).with_suffix(".step")))
    analysis, solver = make_analysis(document, part)
    document.recompute()
    surface = quadrille.middle.make_middle(part, analysis=analysis, move_loads=True)
    mesh = quadrille.freecad.mesh_object(surface, size=size, elements_per_circle=20, analysis=analysis)
    document.recompute()
    result, held = solve(analysis, solver, f"{out}.inp")
    document.saveAs(f"{out}.FCStd")
    draw(part, surface, mesh, result, f"{out}.png")
    return surface, mesh, result, held


def main():
    """Command line."""
    parser = argparse.ArgumentParser(prog="./run.sh", description=__doc__.split("\n", 1)[0])
    parser.add_argument("--size", type=float, default=3.0, help="target edge length in mm (3)")
    parser.add_argument("--out", default="out/sample", help=argparse.SUPPRESS)
    arguments = parser.parse_args()
    Path(arguments.out).parent.mkdir(parents=True, exist_ok=True)
    try:
        surface, mesh, result, held = job(arguments.out, arguments.size)
    except quadrille.Error as error:
        sys.exit(f"error: {error}")
    sheet = " and ".join(f"{mm:g}" for mm in thicknesses(surface))
    print(f"\nThe middle surface: {len(surface.Shape.Faces)} faces, {sheet} mm thick; area x thickness "
          f"{100 * surface.VolumeShare:.2f} % of the volume")
    print(f"Its mesh: {mesh.QuadCount} quads, {mesh.NodeCount} nodes, q {mesh.WorstQuality:.2f} at worst, {mesh.MeanQuality:.2f} mean")
    if result is None:
        print("CalculiX (ccx) is not installed: the input is written, nothing is solved")
    else:
        print(f"CalculiX: the bolts hold {np.linalg.norm(held):.1f} N of {FORCE:g} N; the wall moves by "
              f"{max(vector.Length for vector in result.DisplacementVectors):.4f} mm; largest stress {max(result.vonMises):.1f} MPa")


if __name__ == "__main__":
    main()
