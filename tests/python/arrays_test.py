"""Meshes from arrays, read, recombined, pickled, shown in notebooks; and the stubs that editors read."""

import ast
import inspect
import os
import pickle
import tempfile
import unittest
from pathlib import Path

import numpy as np

import quadrille
from quadrille.core.setting_table import SETTINGS, MeshSettings

MODELS = Path(os.environ["QUADRILLE_MODELS"])
#: A square of 2 x 2 with a point in its middle at (1, 1).
POINTS = np.array([(0, 0, 0), (2, 0, 0), (2, 2, 0), (0, 2, 0), (1, 1, 0)], float)


def grid(n):
    """Points and triangles of the unit square, two a cell."""
    points = [(i / n, j / n, 0) for j in range(n + 1) for i in range(n + 1)]
    at = lambda i, j: j * (n + 1) + i
    triangles = []
    for j in range(n):
        for i in range(n):
            triangles += [(at(i, j), at(i + 1, j), at(i + 1, j + 1)), (at(i, j), at(i + 1, j + 1), at(i, j + 1))]
    return np.array(points), np.array(triangles)


class ArraysTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.model = quadrille.read(MODELS / "bracket.step")

    def same(self, one, two):
        for name in ("points", "quads", "face_ids", "triangles", "triangle_face_ids", "segments", "corners"):
            np.testing.assert_array_equal(getattr(one, name), getattr(two, name), name)
        self.assertEqual(one.order, two.order)

    def test_mesh_of_arrays_is_the_mesh(self):
        for order in (1, 2):
            mesh = quadrille.mesh(self.model, size=8, order=order)
            again = quadrille.Mesh(mesh.points, mesh.quads, face_ids=mesh.face_ids, segments=mesh.segments,
                                   corners=mesh.corners)
            self.same(mesh, again)
            qualities = [mesh.quality(), again.quality()]
        shortest = [quality["criteria"]["by_criterion"].pop("min_length")["limit"] for quality in qualities]
        self.assertEqual(shortest, [0.5, None])  # arrays do not say what size the mesh was made with
        self.assertEqual(*qualities)

    def test_quality_of_arrays(self):
        mesh = quadrille.Mesh(POINTS, [[0, 1, 2, 3]])
        self.assertEqual(mesh.quality()["quads"], 1)
        self.assertAlmostEqual(mesh.qualities()[0], 1)
        self.assertEqual(list(mesh.face_ids), [0])

    def test_wrong_arrays_are_named(self):
        for arguments, part in (
            (dict(points=POINTS[:, :2], quads=[[0, 1, 2, 3]]), "points must be an array of the shape (any, 3)"),
            (dict(points=POINTS * np.nan, quads=[[0, 1, 2, 3]]), "points[0] is not finite"),
            (dict(points=POINTS, quads=[[0, 1, 2]]), "quads must be"),
            (dict(points=POINTS, quads=[[0, 1, 2, 5]]), "quads[0] has the node 5, but there are 5 points"),
            (dict(points=POINTS, quads=[[0, 1, 2, -1]]), "quads[0] has the node -1"),
            (dict(points=POINTS, quads=[[0.0, 1, 2, 3]]), "quads must hold whole numbers"),
            (dict(points=POINTS, quads=[[0, 1, 2, 3]], face_ids=[1, 2]), "face_ids must be"),
            (dict(points=POINTS, quads=[[0, 1, 2, 3]], face_ids=[-1]), "face_ids[0] is -1"),
            (dict(points=POINTS, quads=[[0, 1, 2, 3]], face_ids=[1.7]), "face_ids must hold whole numbers"),
            (dict(points=POINTS, quads=[[0, 1, 2, 3]], face_ids=[2**32 + 1]), "face_ids[0] has the number 4294967297"),
            (dict(points=POINTS, quads=[[0, 1, 2, 3]], corners=[[0, 2**32 + 1]]), "corners[0] has the number 4294967297"),
            (dict(points=POINTS, quads=[[0, 1, 2, 3]], segments=[[0, 1, 9, 1]]), "midside node 9"),
            (dict(points=POINTS, quads=[[0, 1, 2, 3]], segments=[[0, 1, -2, 1]]), "midside node -2"),
        ):
            with self.subTest(part=part), self.assertRaises(quadrille.Error) as caught:
                quadrille.Mesh(**arguments)
            self.assertIn(part, str(caught.exception))
            self.assertEqual(caught.exception.kind, "usage")

    def test_pickle(self):
        for order in (1, 2):
            mesh = quadrille.mesh(self.model, size=8, order=order)
            again = pickle.loads(pickle.dumps(mesh))
            self.same(mesh, again)
            self.assertEqual(mesh.faces, again.faces)
            self.assertEqual(mesh.quality()["criteria"], again.quality()["criteria"])

    def test_read_mesh(self):
        mesh = quadrille.mesh(self.model, size=8, order=2)
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "a.msh"
            mesh.write(path)
            self.same(mesh, quadrille.read_mesh(path))
            with self.assertRaises(quadrille.Error):
                quadrille.read_mesh(Path(folder) / "missing.msh")

    def test_recombine(self):
        points, triangles = grid(8)
        for improve in (True, False):
            mesh = quadrille.recombine(points, triangles, improve=improve)
            self.assertEqual(len(mesh.quads), 64)
            self.assertEqual(len(mesh.triangles), 0)
            self.assertGreater(mesh.quality()["sj_min"], 0)
        np.testing.assert_array_equal(mesh.points, points)
        tags = np.where(np.arange(128) % 16 < 8, 1, 2)  # the left half, the right half
        mesh = quadrille.recombine(points, triangles, tags=tags)
        self.assertEqual({int(tag): int((mesh.face_ids == tag).sum()) for tag in set(mesh.face_ids)}, {1: 32, 2: 32})
        left = mesh.points[mesh.quads[mesh.face_ids == 1]][:, :, 0]
        self.assertLessEqual(left.max(), 0.5 + 1e-12)
        with self.assertRaisesRegex(quadrille.Error, "no triangles"):
            quadrille.recombine(points, np.empty((0, 3), int))

    def test_remeshes_a_surface(self):
        points, triangles = grid(12)
        surface = quadrille.Mesh(10 * points, np.empty((0, 4), int), triangles=triangles)
        mesh = quadrille.remesh(surface, size=1.0)
        self.assertEqual(len(mesh.triangles), 0)
        self.assertGreater(len(mesh.quads), 70)
        self.assertLess(len(mesh.quads), 140)
        self.assertAlmostEqual(mesh.fidelity["mesh_area"], 100, 9)
        self.assertLess(mesh.fidelity["mesh_from_surface"]["distance"], 1e-9)
        self.assertEqual(len(mesh.corners), 4)
        self.assertIsNone(surface.fidelity)
        self.assertEqual(quadrille.remesh(surface, size=1.0, order=2, threads=1).order, 2)
        stages = []
        quadrille.remesh(surface, size=1.0, progress=lambda stage, fraction: stages.append(stage))
        self.assertIn("triangulate", stages)
        for wrong in ({"size": 0}, {"size": 100}, {"size": 1, "order": 3}, {"size": 1, "merge": -1},
                      {"size": 1, "feature_angle": 181}):
            with self.assertRaises(quadrille.Error) as caught:
                quadrille.remesh(surface, **wrong)
            self.assertEqual(caught.exception.kind, "usage")
        with self.assertRaises(TypeError):
            quadrille.remesh(surface, size=1, growth=0.2)
        with self.assertRaises(quadrille.Error) as caught:
            quadrille.remesh(surface, size=0.05, progress=lambda stage, fraction: False)
        self.assertEqual(caught.exception.kind, "cancelled")

    def test_recombined_keeps_groups(self):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "two.inp"
            path.write_text("*NODE\n1,0,0\n2,1,0\n3,2,0\n4,0,1\n5,1,1\n6,2,1\n*ELEMENT,TYPE=S3,ELSET=Left\n1,1,2,5\n"
                            "2,1,4,5\n*ELEMENT,TYPE=S3,ELSET=Right\n3,2,3,6\n4,2,6,5\n")
            with self.assertWarnsRegex(UserWarning, "1 triangles were reversed"):
                mesh = quadrille.read_mesh(path).recombined()
        self.assertEqual(len(mesh.quads), 2)
        self.assertEqual([group[:3] for group in mesh.groups], [("Left", 2, 0), ("Right", 2, 0)])
        self.assertEqual(pickle.loads(pickle.dumps(mesh)).groups, mesh.groups)
        left = mesh.points[mesh.quads[mesh.face_ids == mesh.groups[0][3][0]]]
        self.assertLessEqual(left[..., 0].max(), 1)
        apart = quadrille.Mesh(np.tile(POINTS, (2, 1)), np.empty((0, 4), int),
                               triangles=[(0, 1, 4), (1, 2, 4), (5, 7, 8), (5, 8, 9), (7, 8, 9)])
        with self.assertRaisesRegex(quadrille.Error, "are at the same position, 0 0 0: merge them with merge 0$"):
            apart.recombined()
        for wrong in ({"feature_angle": 200}, {"feature_angle": -1}, {"merge": -1.0}):
            with self.assertRaises(quadrille.Error) as raised:
                mesh.recombined(**wrong)
            self.assertEqual(raised.exception.kind, "usage")

    def test_faces_by_numpy_numbers(self):
        mesh = quadrille.mesh(self.model, size=8, faces=np.array([1, 3]))
        self.assertEqual(set(mesh.face_ids), {1, 3})
        self.assertEqual(MeshSettings(faces=np.array([1, 3]), sizes={"Face1": np.float32(0.5)}).arguments(),
                         ["--faces", "Face1,Face3", "--size-on", "Face1=0.5"])

    def test_notebooks_show_a_picture(self):
        text = quadrille.mesh(self.model, size=8)._repr_html_()
        self.assertIn('src="data:image/png;base64,iVBOR', text)
        self.assertIn("&lt;quadrille.Mesh: ", text)

    def test_signatures_are_those_of_the_stubs(self):
        tree = ast.parse(Path(quadrille.__file__).with_name("__init__.pyi").read_text())
        stubs = {node.name: node for node in tree.body if isinstance(node, ast.FunctionDef)}
        for node in (node for node in tree.body if isinstance(node, ast.ClassDef)):
            for item in node.body:
                if isinstance(item, ast.FunctionDef) and not any(decorator.id == "property" for decorator in item.decorator_list):
                    stubs[node.name if item.name == "__init__" else f"{node.name}.{item.name}"] = item
        self.assertGreater(len(stubs), 15)
        for name, stub in stubs.items():
            function = quadrille
            for part in name.split("."):
                function = getattr(function, part)
            with self.subTest(name=name):
                self.assertGreater(len(function.__doc__), 15)
                kinds = {inspect.Parameter.POSITIONAL_OR_KEYWORD: [], inspect.Parameter.KEYWORD_ONLY: []}
                for parameter in inspect.signature(function).parameters.values():
                    kinds[parameter.kind].append((parameter.name, parameter.default))
                arguments = stub.args
                positional = [argument.arg for argument in arguments.args]
                if name == "Mesh":  # what calling it takes
                    positional.remove("self")
                given = [inspect.Parameter.empty] * (len(positional) - len(arguments.defaults))
                given += [ast.literal_eval(default) for default in arguments.defaults]
                self.assertEqual(kinds[inspect.Parameter.POSITIONAL_OR_KEYWORD], list(zip(positional, given)))
                named = {argument.arg: inspect.Parameter.empty if default is None else ast.literal_eval(default)
                         for argument, default in zip(arguments.kwonlyargs, arguments.kw_defaults)}
                self.assertEqual(dict(kinds[inspect.Parameter.KEYWORD_ONLY]), named)
        for kind in (quadrille.Mesh, quadrille.Model, quadrille.MidSurface):
            for name, member in vars(kind).items():
                if not name.startswith("_"):
                    self.assertTrue(member.__doc__, f"{kind.__name__}.{name}")

    def test_no_module_hides_a_function(self):
        """A module of the package that is imported becomes an attribute of the package."""
        modules = {path.stem for path in Path(quadrille.__file__).parent.iterdir() if path.suffix == ".py" or path.is_dir()}
        self.assertLess({"freecad", "core", "gui"}, modules)
        self.assertEqual(modules & set(quadrille.__all__), set())
        self.assertEqual(quadrille.__version__, quadrille._quadrille.__version__)
        self.assertEqual([entry["name"] for entry in quadrille.settings()], [entry["name"] for entry in SETTINGS])

    def test_stubs_are_of_what_there_is(self):
        tree = ast.parse(Path(quadrille.__file__).with_name("__init__.pyi").read_text())
        functions = {node.name: node for node in tree.body if isinstance(node, ast.FunctionDef)}
        classes = {node.name: node for node in tree.body if isinstance(node, ast.ClassDef)}
        self.assertEqual(set(functions) | set(classes) | {"Error", "__version__"}, set(quadrille.__all__))
        for name, node in classes.items():
            stubbed = {item.name if isinstance(item, ast.FunctionDef) else item.target.id for item in node.body}
            there = {item for item in vars(getattr(quadrille, name)) if not item.startswith("_")}
            self.assertEqual({item for item in stubbed if not item.startswith("_")}, there, name)
        for use, node in (("read", functions["read"]), ("mesh", functions["mesh"]),
                          ("write", next(item for item in classes["Mesh"].body if getattr(item, "name", "") == "write"))):
            stubbed = {argument.arg for argument in node.args.kwonlyargs} - {"progress", "isolated", "title"}
            self.assertEqual(stubbed, {setting["name"] for setting in SETTINGS if setting["use"] == use})


if __name__ == "__main__":
    unittest.main()
