"""Each format is read back by the programs that it is for: counts, places, groups.

A program that is not installed is named and left out: scripts/install_dependencies.sh installs the light ones,
scripts/install_consumers.sh the others. `consumers_test.py --quadrille build/quadrille --table` prints what was read as
the table of docs/formats.md.
"""

import argparse
import json
import pathlib
import re
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent / "consumers"))
from readers import READERS, package_version, run  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parents[2]
BOX = ROOT / "examples/models/box.brep"  # 30 x 20 x 10
AREA = 2200.0
NAMES = {"Face": 6, "Edge": 12, "Vertex": 8}

#: program: {file: (nodes of a quad that it takes, groups that it must be given)}; None = all, the default.
CASES = {
    "Gmsh": {".msh 2.2": ((4, 8, 9), None), ".msh 4.1": ((4, 8, 9), None), ".unv": ((4, 8), None), ".bdf": ((4, 8), None),
             ".vtk": ((4, 8, 9), None)},
    "meshio": {".msh 2.2": ((4, 8, 9), None), ".msh 4.1": ((4, 8, 9), "faces"), ".inp": ((4, 8), None),
               ".bdf": ((4, 8), None), ".med": ((4, 8), None), ".vtu": ((4, 8, 9), None), ".vtk": ((4, 8, 9), None),
               ".xdmf": ((4, 8, 9), None), ".su2": ((4,), None)},
    "VTK": {".vtu": ((4, 8, 9), None), ".vtk": ((4, 8, 9), None)},
    "FreeCAD": {".med": ((4, 8, 9), None), ".unv": ((4, 8), None), ".inp": ((4, 8), None), ".vtu": ((4, 8), None),
                ".vtk": ((4, 8), None)},
    "cgx": {".inp": ((4, 8), None)},
    "libmed's tools": {".med": ((4, 8, 9), None)},
    "dolfinx": {".msh 2.2": ((4, 9), None), ".msh 4.1": ((4, 9), None), ".xdmf": ((4, 9), None)},
    "deal.II": {".msh 2.2": ((4,), "faces"), ".msh 4.1": ((4,), "faces")},
    "MFEM": {".msh 2.2": ((4, 9), None), ".vtk": ((4, 9), None)},
    "SfePy": {".msh 2.2": ((4,), "faces"), ".msh 4.1": ((4,), "none"), ".med": ((4,), "faces"), ".vtk": ((4,), None)},
    "GetFEM": {".msh 2.2": ((4, 8, 9), None)},
}


class Consumers(unittest.TestCase):
    quadrille = None
    rows = []

    @classmethod
    def setUpClass(cls):
        cls._folder = tempfile.TemporaryDirectory(prefix="quadrille-consumers-")
        cls.folder = pathlib.Path(cls._folder.name)

    @classmethod
    def tearDownClass(cls):
        cls._folder.cleanup()

    def write(self, file, nodes, groups):
        """The path of the box's mesh in that format, and the number of its quads."""
        ending, _, version = file[1:].partition(" ")
        arguments = ["--msh-version", version] if version else []
        name = re.sub(r"\W+", "_", f"box{file}_{nodes}_{groups}")
        path, report = self.folder / f"{name}.{ending}", self.folder / f"{name}.json"
        order = ["--order", "1"] if nodes == 4 else ["--nodes", str(nodes)] if nodes == 9 else ["--order", "2"]
        if groups:
            order += ["--groups", groups]
        if not path.exists():
            run(self.quadrille, "mesh", BOX, "-o", path, "--report", report, "--elements-per-diagonal", "8", "--quiet",
                *order, *arguments)
        return path, json.loads(report.read_text())["counts"]["quads"]

    def check(self, seen, quads, nodes):
        self.assertEqual(seen.quads, quads)
        # A closed surface has two nodes more than quads, and twice as many sides.
        self.assertEqual(seen.nodes, {4: quads + 2, 8: 3 * quads + 2, 9: 4 * quads + 2}[nodes])
        if seen.nodes_of_quad is not None:
            self.assertEqual(seen.nodes_of_quad, nodes)
        if seen.corners is not None:
            self.check_places(seen, nodes)

    def check_places(self, seen, nodes):
        """The quads cover the box, and midside nodes lie where their place in the element says."""
        import numpy

        points, quads = numpy.asarray(seen.points)[:, :3], numpy.asarray(seen.corners)
        a, b, c, d = (points[quads[:, k]] for k in range(4))
        area = numpy.linalg.norm(numpy.cross(c - a, d - b), axis=1).sum() / 2
        self.assertAlmostEqual(area, AREA, delta=1e-6 * AREA)
        for k in range(4, nodes if seen.nodes_of_quad == nodes else 4):
            middle = (points[quads[:, k - 4]] + points[quads[:, (k - 3) % 4]]) / 2 if k < 8 else (a + b + c + d) / 4
            if k < 8:
                numpy.testing.assert_allclose(points[quads[:, k]], middle, atol=1e-9)
            else:
                numpy.testing.assert_allclose(points[quads[:, k]], middle, atol=0.1)

    def check_groups(self, seen, quads):
        """Those that the program tells of are all there."""
        if seen.groups:
            told = {re.match(r"[A-Z][a-z]+", name).group() for name in seen.groups}
            self.assertIn("Face", told)
            self.assertEqual(set(seen.groups), {f"{kind}{i + 1}" for kind in told for i in range(NAMES[kind])})
            self.assertEqual(sum(count for name, count in seen.groups.items() if name.startswith("Face")), quads)
            for name, count in seen.groups.items():
                self.assertGreater(count, 0, name)
                self.assertTrue(count == 1 or not name.startswith("Vertex"), name)

    def test_programs(self):
        for program, cases in CASES.items():
            read, package, light = READERS[program]
            version = package_version(package)
            if version is None:
                script = "scripts/install_dependencies.sh --tests" if light else "scripts/install_consumers.sh"
                print(f"SKIPPED: NOT TESTED: {program} is not installed ({script})", file=sys.stderr)
                continue
            for file, (takes, groups) in cases.items():
                for nodes in takes:
                    with self.subTest(program=program, file=file, nodes=nodes):
                        path, quads = self.write(file, nodes, groups)
                        seen = read(path)
                        self.check(seen, quads, nodes)
                        self.check_groups(seen, quads)
                        self.check_group_count(program, file, seen)
                self.rows.append((program, version, file, takes, groups))

    def check_group_count(self, program, file, seen):
        """Groups of one number would be one."""
        if seen.group_count is None:
            return
        wanted = {"GetFEM": 6 + 12, "libmed's tools": 6 + 12 + 8}.get(program, 12 if file == ".su2" else 6)
        self.assertEqual(seen.group_count, wanted, file)

    def test_names_of_groups_reach_those_who_read_them(self):
        """A reader that finds no group at all would pass check_groups()."""
        for program, file in (("Gmsh", ".msh 2.2"), ("Gmsh", ".msh 4.1"), ("meshio", ".msh 2.2"), ("meshio", ".med"),
                              ("meshio", ".vtu"), ("meshio", ".xdmf"), ("VTK", ".vtu"), ("FreeCAD", ".med"),
                              ("FreeCAD", ".unv"), ("cgx", ".inp"), ("dolfinx", ".msh 2.2"), ("dolfinx", ".xdmf")):
            read, package, _ = READERS[program]
            if package_version(package) is None:
                continue
            with self.subTest(program=program, file=file):
                path, _ = self.write(file, 4, None)
                seen = read(path)
                told = {"cgx": ["Face"], "dolfinx": ["Face", "Edge"]}.get(program, list(NAMES))
                wanted = ["Face"] if file == ".xdmf" else told
                for kind in wanted:
                    self.assertEqual(sum(name.startswith(kind) for name in seen.groups), NAMES[kind], kind)

    def test_boundaries_of_entities(self):
        """Gmsh knows from a .msh 4.1 which edges bound a face, and which vertices an edge."""
        if package_version("gmsh") is None:
            self.skipTest("NOT TESTED: gmsh is not installed")
        path, _ = self.write(".msh 4.1", 4, None)
        script = self.folder / "boundaries.geo"
        script.write_text(f'Merge "{path}";\nFor f In {{1:6}}\n  b() = Boundary{{ Surface{{f}}; }};\n'
                          '  Printf("face %g: %g edges", f, #b());\nEndFor\n'
                          'For e In {1:12}\n  v() = Boundary{ Curve{e}; };\n  Printf("edge %g: %g vertices", e, #v());\n'
                          'EndFor\n', encoding="utf-8")
        said = run("gmsh", "-", "-v", "4", script)
        for face in range(1, 7):
            self.assertIn(f"face {face}: 4 edges", said)
        for edge in range(1, 13):
            self.assertIn(f"edge {edge}: 2 vertices", said)


def table(rows):
    """Markdown: a line a program and file."""
    lines = ["| program | file | quads of | groups to ask for |", "| --- | --- | --- | --- |"]
    for program, version, file, takes, groups in rows:
        lines.append(f"| {program} {version} | {file} | {', '.join(map(str, takes))} nodes | "
                     f"{'all (the default)' if groups is None else f'`--groups {groups}`'} |")
    return "\n".join(lines)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--quadrille", required=True)
    parser.add_argument("--table", action="store_true")
    options, rest = parser.parse_known_args()
    Consumers.quadrille = options.quadrille
    program = unittest.main(argv=[sys.argv[0], *rest], exit=False)
    if options.table and program.result.wasSuccessful():
        print(table(Consumers.rows))
    sys.exit(not program.result.wasSuccessful())
