# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes every CAD file in a folder, and continues if one fails.

    scripts/freecad_python examples/freecad/batch.py FOLDER --out FOLDER [--quads 5000]

Writes an .inp file for CalculiX and an .FCStd file for each, and prints a table. The exit code is 1 if one failed.
"""

import argparse
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "workbench"))

import FreeCAD
import Part

import quadrille.freecad

SUFFIXES = {".step", ".stp", ".iges", ".igs", ".brep"}


def main():
    """Writes the files and prints the table."""
    parser = argparse.ArgumentParser()
    parser.add_argument("folder", type=Path)
    parser.add_argument("--out", type=Path, required=True)
    parser.add_argument("--quads", type=int, default=5000, help="elements a part, about")
    arguments = parser.parse_args()
    arguments.out.mkdir(parents=True, exist_ok=True)
    files = sorted(path for path in arguments.folder.iterdir() if path.suffix.lower() in SUFFIXES)
    if not files:
        sys.exit(f"error: {arguments.folder}: holds no CAD files")
    failed, table = 0, []
    for path in files:
        document = FreeCAD.newDocument("Batch")
        try:
            part = document.addObject("Part::Feature", "Part")
            part.Shape = Part.read(str(path))
            size = quadrille.freecad.suggested_size(part, arguments.quads)
            mesh = quadrille.freecad.mesh_object(part, size=size, order=2,
                                                 outputs=[arguments.out / f"{path.stem}.inp"])
            document.saveAs(str(arguments.out / f"{path.stem}.FCStd"))
            table.append(f"{path.name:24} {mesh.QuadCount:7} quads  q {mesh.WorstQuality:.2f} at worst, "
                         f"{mesh.MeanQuality:.2f} mean")
        except (quadrille.Error, RuntimeError) as error:
            failed += 1
            table.append(f"{path.name:24} failed: {error}")
        finally:
            FreeCAD.closeDocument(document.Name)
    print("\n" + "\n".join(table))
    sys.exit(1 if failed else 0)


main()
