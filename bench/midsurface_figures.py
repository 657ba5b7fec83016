#!/usr/bin/env python3
"""Measures middle surfaces: the tables of docs/midsurface.md.

    bench/midsurface_figures.py [--build BUILD] [--beams]

Without --beams: each thin model of tests/models, its area times thickness over its volume, connection, free edges inside
the material, CPU seconds. With --beams: cantilevers under a force at the end, meshed with S8R on the middle surface by
Quadrille, solved by CalculiX (ccx on the PATH), against beam theory.
"""

import argparse
import json
import pathlib
import re
import resource
import subprocess
import tempfile

FORCE, YOUNG = 100.0, 210000.0
# Length; second moment of area with fillets and bends; area that carries shear: the web between the flanges' middles, a
# thin square tube's by Cowper, the legs of the channel by strain energy.
BEAMS = {
    "i_beam_with_fillets": (600, 1859295, 376),
    "square_tube": (500, 194667, 235.5),
    "channel_with_bends": (500, 44157, 136.7),
}


def run(*command, folder):
    """Runs a program to its end; gives its CPU seconds."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
    done = subprocess.run([str(part) for part in command], cwd=folder, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise SystemExit(f"{command[0]}: {done.stderr.strip() or done.stdout.strip()[-500:]}")
    return resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before


def solve(folder, name, mesh_text, nodes):
    """The tip's displacement along y, in the middle of a rigid plate there."""
    far = max(point[2] for point in nodes.values())
    middle = 0.5 * (min(point[0] for point in nodes.values()) + max(point[0] for point in nodes.values()))
    tip = max(nodes) + 1
    held = [number for number, point in nodes.items() if abs(point[2]) < 1e-6]
    moved = [number for number, point in nodes.items() if abs(point[2] - far) < 1e-6]
    lines = [f"*MATERIAL, NAME=Material\n*ELASTIC\n{YOUNG}, 0.3", mesh_text]
    lines += [f"*NODE, NSET=Tip\n{tip}, {middle}, 0, {far}", f"*NODE, NSET=Turn\n{tip + 1}, {middle}, 0, {far}"]
    lines += ["*NSET, NSET=Held"] + [f"{number}," for number in held]
    lines += ["*NSET, NSET=Moved"] + [f"{number}," for number in moved]
    lines += [f"*RIGID BODY, NSET=Moved, REF NODE={tip}, ROT NODE={tip + 1}"]
    lines += [f"*BOUNDARY\nHeld, 1, 6\n*STEP\n*STATIC\n*CLOAD\n{tip}, 2, {FORCE}"]
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
    return solve(folder, "shell_" + name, text.split("\n", 2)[2], nodes), len(re.findall(r"^\d+(, \d+){8}$", text, re.MULTILINE))


def beam_theory(name):
    """Timoshenko's beam."""
    length, second_moment, shear_area = BEAMS[name]
    shear_modulus = YOUNG / (2 * 1.3)
    return FORCE * (length**3 / (3 * YOUNG * second_moment) + length / (shear_modulus * shear_area))


def beams(folder, build):
    print("| cantilever | S8R elements | tip (mm) | beam theory (mm) | off by |\n| --- | --- | --- | --- | --- |")
    for name in BEAMS:
        answer, elements = shell_answer(folder, build, name)
        theory = beam_theory(name)
        print(f"| {name} | {elements} | {answer:.5g} | {theory:.5g} | {100 * (answer / theory - 1):+.2f} % |", flush=True)


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
