#!/usr/bin/env python3
"""Each format gives each element of a thin mesh the thickness that the solid has there.

thicknesses_test.py --quadrille build/quadrille --models FOLDER (of tests/write_models)

The files are read by parsers of this test and by meshio; what they say of an element is held against where it lies.
"""

import argparse
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

import meshio
import numpy


def blocks(text, keyword):
    """The lines behind each line of an .inp file that begins with the keyword, and that line."""
    return re.findall(rf"^\*{keyword}([^\n]*)\n((?:[^*\n][^\n]*\n)*)", text, re.MULTILINE)


def read_inp(path):
    """Nodes by number, elements as lists of nodes by number, names of sets of elements, and the thickness of each."""
    text = path.read_text()
    nodes = {int(f[0]): tuple(map(float, f[1:])) for _, body in blocks(text, "NODE,") for f in (line.split(",") for line in body.splitlines())}
    elements, sets = {}, {}
    for head, body in blocks(text, "ELEMENT,"):
        found = re.search(r"ELSET=(\w+)", head)
        name = found.group(1) if found else "without a set"
        for line in body.splitlines():
            number, *own = map(int, line.split(","))
            elements[number] = own
            sets.setdefault(name, []).append(number)
    for head, body in blocks(text, "ELSET,"):
        members = [word for word in re.split(r"[,\s]+", body) if word]
        sets[re.search(r"ELSET=(\S+)", head).group(1)] = [n for word in members for n in (sets[word] if word in sets else [int(word)])]
    sections = {re.search(r"ELSET=([^,\s]+)", head).group(1): (float(body), "NODAL THICKNESS" in head)
                for head, body in blocks(text, "SHELL SECTION,")}
    nodal = {int(line.split(",")[0]): float(line.split(",")[1]) for _, body in blocks(text, "NODAL THICKNESS") for line in body.splitlines()}
    return nodes, elements, sets, sections, nodal


def read_unv(path):
    """Nodes, shells and groups of elements by name, of datasets 2411, 2412 and 2467."""
    datasets = dict(re.findall(r"    -1\n +(\d+)\n(.*?)\n    -1\n", path.read_text(), re.DOTALL))
    lines = datasets["2411"].splitlines()
    nodes = {int(a.split()[0]): tuple(float(x.replace("D", "E")) for x in b.split()) for a, b in zip(lines[::2], lines[1::2])}
    elements, lines = {}, datasets["2412"].splitlines()
    while lines:
        number, kind, *_, count = map(int, lines[0].split())
        beam = kind in (11, 21, 22, 24)
        rows = (count + 7) // 8
        first = 2 if beam else 1
        own = [int(n) for line in lines[first:first + rows] for n in line.split()]
        if not beam:
            elements[number] = own
        lines = lines[first + rows:]
    groups, lines = {}, datasets["2467"].splitlines()
    while lines:
        count, name = int(lines[0].split()[-1]), lines[1].strip()
        rows = (count + 1) // 2
        numbers = [int(n) for line in lines[2:2 + rows] for n in line.split()]
        groups[name] = [entity for kind, entity in zip(numbers[::4], numbers[1::4]) if kind == 8]
        lines = lines[2 + rows:]
    return nodes, elements, groups


def read_bdf(path):
    """Nodes, elements, thickness of each element at its corners, and the sets of elements by name."""
    nodes, elements, properties, sets, thickness = {}, {}, {}, {}, {}
    cards, name = [], None
    for line in path.read_text().splitlines():
        if found := re.match(r"\$ (\S+): (elements|grids)", line):
            name = found.group(1) if found.group(2) == "elements" else None
        elif name and line.startswith("SET "):
            sets[name] = line.split("=")[1]
        elif name and line[:1] in (" ", ",") or (name and re.match(r"[\d ,THRU]+$", line)):
            sets[name] += line
        elif re.match(r"GRID|CQUAD|CTRIA|PSHELL", line):
            name = None
            cards.append(line)
        elif line[:1] in ("+", "*") and cards:
            cards[-1] += "\n" + line
    for card in cards:
        lines = card.split("\n")
        if card.startswith("GRID*"):
            fields = [lines[0][8 + 16 * i:24 + 16 * i] for i in range(4)] + [lines[1][8:24]]
            nodes[int(fields[0])] = tuple(float(f) for f in fields[2:])
            continue
        fields = [line[8 + 8 * i:16 + 8 * i].strip() for line in lines for i in range(8)]
        if card.startswith("PSHELL"):
            properties[int(fields[0])] = float(fields[2])
        else:
            count = int(card[5])
            elements[int(fields[0])] = [int(f) for f in fields[2:2 + count]]
            # CQUAD4: T1 to T4 behind two blanks on the second line; CQUAD8: behind the nodes.
            own = fields[10:14]
            thickness[int(fields[0])] = [float(f) for f in own] if len(own) == 4 and all(own) else int(fields[1])
    for number, own in thickness.items():
        if isinstance(own, int):
            thickness[number] = [properties[own]] * 4
    numbers = {}
    for name, text in sets.items():
        numbers[name] = []
        for word in text.replace(" ", "").split(","):
            if "THRU" in word:
                first, last = map(int, word.split("THRU"))
                numbers[name] += range(first, last + 1)
            elif word:
                numbers[name].append(int(word))
    return nodes, elements, thickness, numbers


def middle(nodes, own):
    return numpy.mean([nodes[n] for n in own[:4]], axis=0)


class Thicknesses(unittest.TestCase):
    quadrille = models = None
    groups = ()

    def setUp(self):
        self._folder = tempfile.TemporaryDirectory(prefix="quadrille-thicknesses-")
        self.addCleanup(self._folder.cleanup)
        self.folder = pathlib.Path(self._folder.name)

    def mesh(self, model, endings, *more):
        outputs = [word for ending in endings for word in ("-o", str(self.folder / f"m.{ending}"))]
        more = (*more, *self.groups)
        subprocess.run([self.quadrille, "mesh", self.models / f"{model}.brep", "--thin", "--quiet", *more, *outputs], check=True)
        return [self.folder / f"m.{ending}" for ending in endings]

    def check_step(self, element_middle, thickness):
        """A sheet of 3 up to x = 50, with its middle at z = 1.5, and of 2 beyond, at z = 1; between them as the thinner."""
        x, _, z = element_middle
        self.assertAlmostEqual(thickness, 3 if x < 50 - 1e-6 and abs(z - 1.5) < 1e-6 else 2, 6, f"at {element_middle}")

    def check_groups(self, groups, elements, nodes):
        """Groups of elements by the name of the thickness, each element in one of them."""
        named = [(name, number) for name, numbers in groups.items() if name.startswith("Thickness") for number in numbers]
        self.assertEqual(sorted(number for _, number in named), sorted(elements))
        self.assertEqual({name for name, _ in named}, {"Thickness2", "Thickness3"})
        for name, number in named:
            self.check_step(middle(nodes, elements[number]), float(name.removeprefix("Thickness")))
        self.check_solid_faces({name: [middle(nodes, elements[number]) for number in numbers if number in elements]
                                for name, numbers in groups.items()},
                               [middle(nodes, own) for own in elements.values()])

    def check_solid_faces(self, groups, every):
        """The bottom of the sheet is one face, what is above it two; what stands across between them belongs to none.
        Both arguments tell the middles of elements."""
        def rounded(points):
            return sorted(tuple(round(float(x), 6) for x in point) for point in points)
        flat = [point for point in every if abs(point[0] - 50) > 1e-6]
        parts = [flat, [point for point in flat if point[0] < 50], [point for point in flat if point[0] > 50]]
        found = [rounded(points) for name, points in groups.items() if re.fullmatch(r"SolidFace\d+", name)]
        self.assertEqual(sorted(found), sorted(map(rounded, parts)) if not self.groups else [])

    def test_sections_and_sets_of_abaqus(self):
        for order in ("1", "2"):
            nodes, elements, sets, sections, nodal = read_inp(*self.mesh("thin_stepped_sheet", ["inp"], "--size", "8", "--order", order))
            self.check_groups(sets, elements, nodes)
            self.assertEqual(sections, {"Thickness3": (3, False), "Thickness2": (2, False)})
            self.assertEqual(nodal, {})

    def test_rims_on_faces_of_the_solid(self):
        inp, = self.mesh("thin_stepped_sheet", ["inp"], "--size", "8", "--order", "2")
        nodes, on = read_inp(inp)[0], {"x": set(), "y": set()}
        rims = [body for head, body in blocks(inp.read_text(), "NSET") if re.search(r"NSET=SolidFace\d+Rim$", head)]
        for body in rims:
            points = numpy.array([nodes[int(word)] for word in re.split(r"[,\s]+", body) if word])
            self.assertGreater(len(points), 10)
            axis = int(numpy.ptp(points[:, 0]) > 1e-6)
            self.assertLess(numpy.ptp(points[:, axis]), 1e-6)
            on["xy"[axis]].add(round(float(points[0, axis]), 6))
        self.assertEqual(on, {"x": {0, 100}, "y": {0, 50}} if not self.groups else {"x": set(), "y": set()})

    def test_groups_of_universal_files(self):
        nodes, elements, named = read_unv(*self.mesh("thin_stepped_sheet", ["unv"], "--size", "8"))
        self.check_groups(named, elements, nodes)

    def test_sets_and_properties_of_nastran(self):
        for order in ("1", "2"):
            nodes, elements, thickness, sets = read_bdf(*self.mesh("thin_stepped_sheet", ["bdf"], "--size", "8", "--order", order))
            self.check_groups(sets, elements, nodes)
            for number, own in elements.items():
                for value in thickness[number]:
                    self.check_step(middle(nodes, own), value)

    def test_physical_groups_of_gmsh(self):
        text = self.mesh("thin_stepped_sheet", ["msh"], "--size", "8", "--msh-version", "4.1")[0].read_text()
        names = {int(n): name for n, name in re.findall(r'^2 (\d+) "(\w+)"$', text, re.MULTILINE)}
        entities = text.split("$Entities\n")[1].splitlines()
        points, curves, surfaces, _ = map(int, entities[0].split())
        of_surface = {}
        for line in entities[1 + points + curves:1 + points + curves + surfaces]:
            fields = line.split()
            of_surface[int(fields[0])] = [names[int(n)] for n in fields[8:8 + int(fields[7])]]
        nodes, lines = {}, text.split("$Nodes\n")[1].splitlines()
        at = 1
        while not lines[at].startswith("$"):
            count = int(lines[at].split()[3])
            for i in range(count):
                nodes[int(lines[at + 1 + i])] = tuple(map(float, lines[at + 1 + count + i].split()[:3]))
            at += 1 + 2 * count
        groups, elements, at = {}, {}, 1
        lines = text.split("$Elements\n")[1].splitlines()
        while not lines[at].startswith("$"):
            dimension, tag, _, count = map(int, lines[at].split())
            for line in lines[at + 1:at + 1 + count] if dimension == 2 else []:
                number, *own = map(int, line.split())
                elements[number] = own
                for name in of_surface[tag]:
                    groups.setdefault(name, []).append(number)
            at += 1 + count
        self.check_groups(groups, elements, nodes)

    def test_families_of_med(self):
        mesh = meshio.read(*self.mesh("thin_stepped_sheet", ["med"], "--size", "8"))
        checked, groups, every = 0, {}, []
        for block, families in zip(mesh.cells, mesh.cell_data["cell_tags"]):
            if len(block.data[0]) < 4:
                continue
            for own, family in zip(block.data, families):
                thickness = [name for name in mesh.cell_tags[family] if name.startswith("Thickness")]
                self.assertEqual(len(thickness), 1)
                self.check_step(mesh.points[own[:4]].mean(axis=0), float(thickness[0].removeprefix("Thickness")))
                every.append(mesh.points[own[:4]].mean(axis=0))
                for name in mesh.cell_tags[family]:
                    groups.setdefault(name, []).append(every[-1])
                checked += 1
        self.assertGreater(checked, 50)
        self.check_solid_faces(groups, every)

    def test_arrays_of_vtk(self):
        for path in self.mesh("thin_stepped_sheet", ["vtu", "vtk"], "--size", "8"):
            mesh, checked = meshio.read(path), 0
            for block, thicknesses in zip(mesh.cells, mesh.cell_data["thickness"]):
                for own, thickness in zip(block.data, thicknesses):
                    if len(own) < 4:
                        continue
                    self.check_step(mesh.points[own[:4]].mean(axis=0), float(numpy.ravel(thickness)[0]))
                    checked += 1
            self.assertGreater(checked, 50, path)
            groups, every = {}, []
            for i, block in enumerate(mesh.cells):
                for k, own in enumerate(block.data):
                    if len(own) < 4:
                        continue
                    every.append(mesh.points[own[:4]].mean(axis=0))
                    for name, values in mesh.cell_data.items():
                        if name.startswith("SolidFace") and float(numpy.ravel(values[i][k])[0]) == 1:
                            groups.setdefault(name, []).append(every[-1])
            self.check_solid_faces(groups, every)

    def test_thickness_that_varies(self):
        """From 4 at x = 0 evenly to 2 at x = 100, measured across the middle, which leans by half of the sides' angle."""
        inp, bdf = self.mesh("thin_tapering_web", ["inp", "bdf"], "--size", "8", "--order", "2")
        nodes, elements, sets, sections, nodal = read_inp(inp)
        self.assertEqual(len(sections), 1)
        (name, (_, varies)), = sections.items()
        self.assertTrue(varies)
        self.assertEqual(sorted(sets[name]), sorted(elements))
        self.assertEqual(set(nodal), {node for own in elements.values() for node in own})
        for node, thickness in nodal.items():
            self.assertAlmostEqual(thickness, 4 - 0.02 * nodes[node][0], delta=2e-3)
        for order in ("1", "2"):
            if order == "1":
                bdf, = self.mesh("thin_tapering_web", ["bdf"], "--size", "8", "--order", "1")
            nodes, elements, thickness, _ = read_bdf(bdf)
            for number, own in elements.items():
                self.assertEqual(len(thickness[number]), 4)
                for node, value in zip(own[:4], thickness[number]):
                    self.assertAlmostEqual(value, 4 - 0.02 * nodes[node][0], delta=2e-3)
        for path in self.mesh("thin_tapering_web", ["vtu", "vtk"], "--size", "8"):
            mesh = meshio.read(path)
            for block, thicknesses in zip(mesh.cells, mesh.cell_data["thickness"]):
                for own, value in zip(block.data, thicknesses):
                    x = mesh.points[own[:4]].mean(axis=0)[0]
                    if len(own) >= 4:
                        self.assertAlmostEqual(float(numpy.ravel(value)[0]), 4 - 0.02 * x, delta=2e-3)


class WithoutGroupsOfFaces(Thicknesses):
    """Thicknesses are written whatever other groups are asked for."""

    groups = ("--groups", "none")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--quadrille", type=pathlib.Path, required=True)
    parser.add_argument("--models", type=pathlib.Path, required=True)
    arguments, rest = parser.parse_known_args()
    Thicknesses.quadrille, Thicknesses.models = arguments.quadrille.resolve(), arguments.models.resolve()
    unittest.main(argv=[sys.argv[0], *rest])


if __name__ == "__main__":
    main()
