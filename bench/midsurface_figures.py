#!/usr/bin/env python3
"""Measures middle surfaces: the tables of docs/midsurface.md.

    bench/midsurface_figures.py [--build BUILD] [--beams]

Without --beams: each thin model of tests/models, its area times thickness over its volume, connection, free edges inside
the material, CPU seconds. With --beams: cantilevers under a force at the end, meshed with S8R on the middle surface by
Quadrille and with C3D20R in the solid by Gmsh, both solved by CalculiX (gmsh and ccx on the PATH).
"""

import argparse
import json
import pathlib
import re
import resource
import subprocess
import tempfile

FORCE, YOUNG = 100.0, 210000.0
LENGTHS = {"i_beam_with_fillets": 600, "square_tube": 500, "channel_with_bends": 500}
# Gmsh's order of the nodes in the middle of the edges of a brick, as Abaqus has them.
BRICK = [0, 1, 2, 3, 4, 5, 6, 7, 8, 11, 13, 9, 16, 18, 19, 17, 10, 12, 14, 15]


def run(*command, folder):
    """Runs a program to its end; gives its CPU seconds."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
    done = subprocess.run([str(part) for part in command], cwd=folder, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise SystemExit(f"{command[0]}: {done.stderr.strip() or done.stdout.strip()[-500:]}")
    return resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before


def solve(folder, name, mesh_text, nodes, section, freedoms):
    """The tip's displacement along y, in the middle of a rigid plate there."""
    far = max(point[2] for point in nodes.values())
    tip = max(nodes) + 1
    held = [number for number, point in nodes.items() if abs(point[2]) < 1e-6]
    moved = [number for number, point in nodes.items() if abs(point[2] - far) < 1e-6]
    lines = [f"*MATERIAL, NAME=Material\n*ELASTIC\n{YOUNG}, 0.3", mesh_text, section]
    lines += [f"*NODE, NSET=Tip\n{tip}, 0, 0, {far}", f"*NODE, NSET=Turn\n{tip + 1}, 0, 0, {far}"]
    lines += ["*NSET, NSET=Held"] + [f"{number}," for number in held]
    lines += ["*NSET, NSET=Moved"] + [f"{number}," for number in moved]
    lines += [f"*RIGID BODY, NSET=Moved, REF NODE={tip}, ROT NODE={tip + 1}"]
    lines += [f"*BOUNDARY\nHeld, 1, {freedoms}\n*STEP\n*STATIC\n*CLOAD\n{tip}, 2, {FORCE}"]
    lines += ["*NODE PRINT, NSET=Tip\nU\n*END STEP\n"]
    (folder / f"{name}.inp").write_text("\n".join(lines))
    run("ccx", name, folder=folder)
    numbers = re.findall(r"^\s+\d+\s+(\S+)\s+(\S+)\s+(\S+)", (folder / f"{name}.dat").read_text(), re.MULTILINE)
    return float(numbers[-1][1])


def shell_answer(folder, build, name):
    run(build / "quadrille", "mesh", folder / f"cantilever_{name}.brep", "--thin", "--order", 2, "--size", 8, "--quiet",
        "-o", folder / "shell.inp", folder=folder)
    text = (folder / "shell.inp").read_text()
    table = text.split("*NODE, NSET=Nall\n")[1].split("*")[0]
    nodes = {int(line.split(",")[0]): tuple(map(float, line.split(",")[1:])) for line in table.splitlines()}
    return solve(folder, "shell_" + name, text.split("\n", 2)[2], nodes, "", 6), text.count("S8R")


def solid_answer(folder, name):
    length = LENGTHS[name]
    (folder / "solid.geo").write_text(
        'SetFactory("OpenCASCADE");\n' f'Merge "section_{name}.brep";\n'
        "Mesh.Algorithm = 8; Mesh.RecombineAll = 1; Mesh.SubdivisionAlgorithm = 1;\n"
        "Mesh.MeshSizeMax = 6; Mesh.MeshSizeFromCurvature = 12;\n"
        f"Extrude {{0, 0, {length}}} {{ Surface{{1}}; Layers{{{length // 15}}}; Recombine; }}\n"
        "Mesh.ElementOrder = 2; Mesh.SecondOrderIncomplete = 1; Mesh.MshFileVersion = 2.2; Mesh.SaveAll = 1;\n")
    run("gmsh", "-3", "solid.geo", "-o", "solid.msh", folder=folder)
    text = (folder / "solid.msh").read_text()
    rows = [line.split() for line in text.split("$Nodes")[1].split("$EndNodes")[0].split("\n")[2:] if line]
    everywhere = {int(row[0]): tuple(map(float, row[1:])) for row in rows}
    elements = [list(map(int, line.split())) for line in text.split("$Elements")[1].split("$EndElements")[0].split("\n")[2:]
                if line]
    bricks = [row[3 + row[2]:] for row in elements if row[1] == 17]
    nodes = {number: everywhere[number] for brick in bricks for number in brick}
    lines = ["*NODE"] + [f"{number}, {x:.9g}, {y:.9g}, {z:.9g}" for number, (x, y, z) in sorted(nodes.items())]
    lines += ["*ELEMENT, TYPE=C3D20R, ELSET=Solid"]
    for i, brick in enumerate(bricks):
        numbers = [str(brick[k]) for k in BRICK]
        lines += [f"{i + 1}, " + ", ".join(numbers[:15]) + ",", ", ".join(numbers[15:])]
    section = "*SOLID SECTION, ELSET=Solid, MATERIAL=Material"
    return solve(folder, "solid_" + name, "\n".join(lines), nodes, section, 3), len(bricks)


def beams(folder, build):
    print("| cantilever | S8R, tip (mm) | C3D20R, tip (mm), bricks | off by |\n| --- | --- | --- | --- |")
    for name in LENGTHS:
        shell, _ = shell_answer(folder, build, name)
        solid, bricks = solid_answer(folder, name)
        print(f"| {name} | {shell:.5g} | {solid:.5g}, {bricks} | {100 * (shell / solid - 1):+.2f} % |", flush=True)


def surfaces(folder, build):
    print("| model | faces | middle | area x thickness / volume | parts | edges inside | CPU (s) |")
    print("| --- | --- | --- | --- | --- | --- | --- |")
    for path in sorted(folder.glob("thin_*.brep")) + [folder / "ribbed_plate_200.brep"]:
        if path.stem in ("thin_annulus", "thin_pin"):  # of the trouble models
            continue
        seconds = run(build / "quadrille", "midsurface", path, "--quiet", "-o", "x.json", "-o", "x.brep", folder=folder)
        told = json.loads((folder / "x.json").read_text())
        faces = subprocess.run([build / "quadrille", "info", path], capture_output=True, text=True, check=True).stdout
        count = re.search(r"faces +(\d+)", faces).group(1)
        print(f"| {path.stem.removeprefix('thin_')} | {count} | {len(told['faces'])} | "
              f"{100 * told['area_times_thickness'] / told['volume']:.2f} % | {told['parts']} | "
              f"{len(told['edges_inside_the_material'])} | {seconds:.2f} |", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", type=pathlib.Path, default=pathlib.Path(__file__).resolve().parent.parent / "build")
    parser.add_argument("--beams", action="store_true")
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        run(arguments.build / "tests" / "write_models", folder, folder=folder)
        (beams if arguments.beams else surfaces)(folder, arguments.build)


if __name__ == "__main__":
    main()
