"""The Python package over the compiled module: models, arrays, files, progress, errors."""

import gc
import json
import os
import pickle
import random
import re
import signal
import sys
import tempfile
import unittest
from pathlib import Path

import numpy as np

import quadrille

MODELS = Path(os.environ["QUADRILLE_MODELS"])
#: A folder beside the source tree with the definitions of the criteria, where it exists.
REFERENCE = Path(__file__).resolve().parents[3] / "shared"


class PackageTest(unittest.TestCase):
    """What the README shows to Python users."""

    @classmethod
    def setUpClass(cls):
        cls.model = quadrille.read(MODELS / "bracket.step")
        cls.mesh = quadrille.mesh(cls.model, size=4)

    def test_model(self):
        model = quadrille.read(str(MODELS / "two_solids.brep"))
        self.assertEqual((model.face_count, model.edge_count, model.vertex_count), (9, 15, 10))
        self.assertEqual(model.solid_count, 2)
        self.assertAlmostEqual(model.area, 5286.371579, 3)  # the shared face counts once
        self.assertGreater(model.diagonal, 50)
        self.assertIn("9 faces", repr(model))

    def test_brep_text(self):
        model = quadrille.read_brep((MODELS / "box.brep").read_text())
        self.assertEqual(model.face_count, 6)
        (low, high) = model.box
        np.testing.assert_allclose(low, (0, 0, 0), atol=1e-6)
        np.testing.assert_allclose(high, (30, 20, 10), atol=1e-6)

    def test_midsurface(self):
        with self.assertRaisesRegex(quadrille.Error, "not a thin solid"):
            quadrille.midsurface(quadrille.read(MODELS / "box.brep"))
        middle = quadrille.midsurface(quadrille.read(MODELS / "bracket.step"), partial=True)
        self.assertTrue(middle.problems or abs(middle.shell_volume / middle.volume - 1) < 0.05)
        self.assertTrue(all(face["thickness"] > 0 and len(face["solid_faces"]) >= 2 for face in middle.faces))
        self.assertTrue(0 < len(middle.rims) <= middle.free_edges)
        self.assertTrue(all(edge > 0 and faces for edge, faces in middle.rims))
        # Without the thicknesses, quads might cross edges where these change.
        mesh = quadrille.mesh(middle.model, size=4, keep_features=True)
        self.assertEqual(set(mesh.face_ids), set(range(1, len(middle.faces) + 1)))
        thick = quadrille.mesh(middle, size=4, keep_features=True)  # the same, and it knows how thick
        np.testing.assert_array_equal(thick.points, mesh.points)
        with tempfile.TemporaryDirectory() as folder:
            for made, sections in ((mesh, False), (pickle.loads(pickle.dumps(thick)), True)):
                made.write(Path(folder) / "thin.inp")
                deck = (Path(folder) / "thin.inp").read_text()
                self.assertEqual(("*SHELL SECTION" in deck, "ELSET=SolidFace" in deck), (sections, sections))

    def test_nodes_at_places(self):
        model = quadrille.read(MODELS / "plate_with_holes.brep")
        tip = (29.875, 70.0, 0.0)
        for given, name in (({"Tip": tip}, "Tip"), ([tip], "Node1"), (["29.875,70,0"], "Node1"), ({"Tip": np.array(tip)}, "Tip")):
            mesh = pickle.loads(pickle.dumps(quadrille.mesh(model, size=5, nodes_at=given)))
            self.assertLess(np.linalg.norm(mesh.points - tip, axis=1).min(), 1e-9)
            with tempfile.TemporaryDirectory() as folder:
                mesh.write(Path(folder) / "mesh.inp")
                self.assertIn(f"*NSET, NSET={name}\n", (Path(folder) / "mesh.inp").read_text())
        with self.assertRaisesRegex(quadrille.Error, "nodes_at Node1 at .* lies 3 mm from Face1"):
            quadrille.mesh(model, size=5, nodes_at=[(29.875, 60, 3)])

    def test_signals_are_heard_while_it_works(self):
        """Ctrl-C is one; before, it waited for the end."""
        heard = []
        self.addCleanup(signal.signal, signal.SIGALRM, signal.signal(signal.SIGALRM, lambda *_: heard.append(1)))
        for work in (lambda: quadrille.midsurface(self.model, partial=True),
                     lambda: quadrille.suggested_size(self.model, 30000000)):
            heard.clear()
            signal.setitimer(signal.ITIMER_REAL, 0.002, 0.002)
            try:
                work()
            finally:
                signal.setitimer(signal.ITIMER_REAL, 0)
            self.assertGreater(len(heard), 2)

    def test_arrays(self):
        mesh = self.mesh
        self.assertEqual((mesh.points.dtype, mesh.points.shape[1]), (np.float64, 3))
        self.assertEqual((mesh.quads.dtype, mesh.quads.shape[1]), (np.int32, 4))
        self.assertEqual(mesh.face_ids.shape, (len(mesh.quads),))
        self.assertEqual(set(mesh.face_ids), set(range(1, self.model.face_count + 1)))
        self.assertEqual(mesh.segments.shape[1], 4)
        self.assertEqual(sorted(mesh.corners[:, 1]), list(range(1, self.model.vertex_count + 1)))
        self.assertEqual(np.unique(mesh.quads).size, len(mesh.points))
        sides = np.sort(np.stack([mesh.quads, np.roll(mesh.quads, -1, 1)], 2).reshape(-1, 2), 1)
        _, counts = np.unique(sides, axis=0, return_counts=True)
        self.assertEqual(set(counts), {2}, "a solid's skin is watertight")

    def test_area_is_kept(self):
        a, b, c, d = (self.mesh.points[self.mesh.quads[:, i]] for i in range(4))
        area = 0.5 * np.linalg.norm(np.cross(c - a, d - b), axis=1).sum()
        self.assertAlmostEqual(area / self.model.area, 1, delta=0.01)

    def test_arrays_are_views_that_keep_the_mesh_alive(self):
        mesh = quadrille.mesh(self.model, size=8)
        self.assertEqual(mesh.points.__array_interface__["data"], mesh.points.__array_interface__["data"])
        points = mesh.points
        copy = points.copy()
        self.assertFalse(points.flags.writeable)
        del mesh
        gc.collect()
        np.testing.assert_array_equal(points, copy)

    def test_second_order(self):
        mesh = quadrille.mesh(quadrille.read(MODELS / "cylinder.brep"), size=4, order=2)
        self.assertEqual(mesh.quads.shape[1], 8)
        points = mesh.points[mesh.quads[mesh.face_ids == 1]]  # the cylinder itself comes first
        np.testing.assert_allclose(np.hypot(points[..., 0], points[..., 1]), 10, atol=1e-5)
        self.assertTrue((mesh.segments[:, 2] >= 0).all())

    def test_quality(self):
        quality = self.mesh.quality()
        self.assertEqual(quality["quads"], len(self.mesh.quads))
        self.assertEqual(quality["triangles"], 0)
        self.assertEqual(quality["inverted"], 0)
        values = self.mesh.qualities()
        self.assertAlmostEqual(values.mean(), quality["q_mean"])
        self.assertAlmostEqual(values.min(), quality["q_min"])
        self.assertEqual(sum(quality["histogram"]), len(values))

    def test_criteria(self):
        criteria = self.mesh.quality()["criteria"]
        self.assertEqual(criteria["quads"], len(self.mesh.quads))
        self.assertEqual(criteria["by_criterion"]["aspect"]["limit"], 5)
        with tempfile.TemporaryDirectory() as folder:
            limits = Path(folder) / "limits.json"
            limits.write_text('{"angle_min": 89.999999, "warp": null}')
            strict = self.mesh.quality(limits)["criteria"]
        self.assertIsNone(strict["by_criterion"]["warp"]["limit"])
        self.assertGreater(strict["failing"], criteria["failing"])
        worst = strict["worst"][0]
        points = self.mesh.points[self.mesh.quads[worst["quad"] - 1]]
        np.testing.assert_allclose(points.mean(axis=0), worst["center"])
        self.assertEqual(worst["face"], f"Face{self.mesh.face_ids[worst['quad'] - 1]}")
        faces = sum(face["failing"] for face in strict["by_face"].values())
        self.assertEqual(faces, strict["failing"])

    @unittest.skipUnless(REFERENCE.is_dir(), "the reference of the criteria is not there")
    def test_criteria_are_those_of_the_reference(self):
        sys.path.insert(0, str(REFERENCE / "tools"))
        import criteria as reference

        parts = sorted((REFERENCE / "corpus_parts").glob("*.st*p"))[:3]
        self.assertEqual(len(parts), 3)
        for part in parts:
            with self.subTest(part=part.name), tempfile.TemporaryDirectory() as folder:
                path = Path(folder) / "mesh.msh"
                mesh = quadrille.mesh(quadrille.read(part))
                mesh.write(path)
                usual = {name: entry["limit"] for name, entry in mesh.quality()["criteria"]["by_criterion"].items()}
                self.assertGreater(usual.pop("min_length"), 0)  # which the reference does not measure
                limits = Path(folder) / "limits.json"
                limits.write_text(json.dumps(usual))
                theirs, ours = reference.criteria(str(path)), mesh.quality(limits)["criteria"]
                self.assertGreater(theirs["fail_pct"], 0)
                self.assertAlmostEqual(theirs["fail_pct"], ours["failing_percent"], delta=1e-9)
                self.assertAlmostEqual(theirs["fail_but_warp_pct"], ours["outside_percent"], delta=1e-9)
                for name, values in ours["by_criterion"].items():
                    if name == "min_length":
                        continue
                    name = {"jacobian_ratio": "jac"}.get(name, name)
                    self.assertAlmostEqual(theirs[name + "_pct"], values["failing_percent"], delta=1e-9, msg=name)
                quads = [worst["quad"] - 1 for worst in ours["worst"]]
                measured = reference.measure(mesh.points[mesh.quads[quads]])
                for i, worst in enumerate(ours["worst"]):
                    name = {"jacobian_ratio": "jac"}.get(worst["criterion"], worst["criterion"])
                    self.assertAlmostEqual(measured[name][i] / worst["value"], 1, delta=1e-9, msg=name)

    def test_files(self):
        with tempfile.TemporaryDirectory() as folder:
            for ending in ("msh", "inp", "unv", "med", "vtu", "bdf"):
                path = Path(folder) / f"mesh.{ending}"
                self.mesh.write(path)
                self.assertGreater(path.stat().st_size, 1000, ending)
            self.mesh.picture(Path(folder) / "mesh.png", width=400, height=300)
            self.assertTrue((Path(folder) / "mesh.png").read_bytes().startswith(b"\x89PNG"))

    def test_sizes_and_faces(self):
        box = quadrille.read(MODELS / "box.brep")
        coarse = quadrille.mesh(box, size=4)
        fine = quadrille.mesh(box, size=4, sizes={"Face1": 1})
        self.assertGreater((fine.face_ids == 1).sum(), 4 * (coarse.face_ids == 1).sum())
        part = quadrille.mesh(box, size=4, faces=["Face2", 5])
        self.assertEqual(set(part.face_ids), {2, 5})

    def test_same_result_for_any_thread_count(self):
        one = quadrille.mesh(self.model, size=6, threads=1)
        two = quadrille.mesh(self.model, size=6, threads=2)
        np.testing.assert_array_equal(one.points, two.points)
        np.testing.assert_array_equal(one.quads, two.quads)

    def test_progress(self):
        calls = []
        quadrille.mesh(self.model, size=8, progress=lambda stage, fraction: calls.append((stage, fraction)))
        self.assertTrue(calls)
        self.assertTrue(all(isinstance(stage, str) and 0 <= fraction <= 1 for stage, fraction in calls))
        fractions = [fraction for _, fraction in calls]
        self.assertEqual(fractions, sorted(fractions), "never runs backward")

    def test_settings_are_those_of_the_table(self):
        for setting in quadrille.settings():
            function = {"read": quadrille.read, "mesh": quadrille.mesh, "write": quadrille.Mesh.write}[setting["use"]]
            self.assertIn(f"{setting['name']}: ", function.__doc__)
        with self.assertRaises(TypeError):
            quadrille.mesh(self.model, seed=1)

    def test_files_hold_what_is_asked_for(self):
        mesh = quadrille.mesh(self.model, size=8, order=2)
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "a.msh"
            mesh.write(path, msh_version="4.1", nodes=9, groups=["faces"], title="a")
            text = path.read_text()
            self.assertIn("4.1 0 8", text)
            self.assertIn('"Face1"', text)
            self.assertNotIn('"Edge1"', text)
            self.assertIn(f"\n{len(mesh.points) + len(mesh.quads)}\n", text)
            for wrong in ({"groups": ["sides"]}, {"groups": "faces"}, {"nodes": 7}, {"msh_version": "3"}, {"element": "S9"}, {"scale": 0}):
                with self.assertRaises(quadrille.Error) as caught:
                    mesh.write(path, **wrong)
                self.assertEqual(caught.exception.kind, "usage")
            mesh.write(path, scale=0.001)
            meters = quadrille.read_mesh(path).points
            np.testing.assert_allclose(np.ptp(meters, axis=0), 0.001 * np.ptp(mesh.points, axis=0), rtol=1e-12)
            with self.assertRaisesRegex(quadrille.Error, "element CPS4 needs order 1, not 2"):
                mesh.write(Path(folder) / "a.inp", element="CPS4")
            mesh.write(Path(folder) / "a.inp", element="M3D8R")
            self.assertIn("TYPE=M3D8R", (Path(folder) / "a.inp").read_text())
            with self.assertRaises(TypeError):
                mesh.write(path, size=2)

    def test_reading_survives_files_that_crash_the_reader(self):
        # References that lead to entities of the wrong kind: OpenCASCADE 7.6 crashes on some of them, and on
        # some never ends, by what its memory held before; the time limit is what ends those.
        text = (MODELS / "bracket.step").read_text()
        told = 0
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "damaged.step"
            for seed in range(12):
                rng = random.Random(seed)
                path.write_text(re.sub(r"#\d+(?! *=)", lambda match: rng.choice([match[0]] * 30 + ["#17", "#20"]), text))
                try:
                    quadrille.read(path, read_time_limit=2)
                except quadrille.Error as error:
                    self.assertEqual(error.kind, "failure")
                    self.assertNotIn("\n", str(error))
                    told += 1
        self.assertGreater(told, 0)

    def test_reading_here_or_in_a_child(self):
        for isolated in (True, False):
            self.assertEqual(quadrille.read(MODELS / "bracket.step", isolated=isolated).box, self.model.box)

    def test_imprint(self):
        model = quadrille.read(MODELS / "bracket.step", imprint=True)
        self.assertEqual(model.pieces, [[face] for face in range(1, model.face_count + 1)])
        self.assertEqual(self.model.pieces, [])
        with self.assertRaises(quadrille.Error):
            quadrille.read(MODELS / "bracket.step", imprint=1)

    def test_cancelled_between_reports(self):
        """All of the work takes minutes; it is asked whether to go on while it has nothing new to report."""
        asked = []

        def go_on(stage, fraction):
            asked.append((stage, fraction))
            return asked.count(asked[-1]) < 3

        with self.assertRaises(quadrille.Error) as caught:
            quadrille.mesh(self.model, elements_per_diagonal=1000, force=True, progress=go_on)
        self.assertEqual(caught.exception.kind, "cancelled")
        self.assertEqual(asked.count(asked[-1]), 3)  # and not asked again

    def test_cancel(self):
        with self.assertRaises(quadrille.Error) as caught:
            quadrille.mesh(self.model, size=2, progress=lambda stage, fraction: False)
        self.assertEqual(caught.exception.kind, "cancelled")

    def test_exception_in_progress_comes_out(self):
        def fail(_stage, _fraction):
            raise KeyError("mine")

        with self.assertRaises(KeyError):
            quadrille.mesh(self.model, size=4, progress=fail)

    def test_errors(self):
        for kind, call in (
            ("failure", lambda: quadrille.read("/nowhere/part.step")),
            ("failure", lambda: quadrille.read_brep("not a shape")),
            ("usage", lambda: quadrille.mesh(self.model, size=-1)),
            ("usage", lambda: quadrille.mesh(self.model, size=float("nan"))),
            ("usage", lambda: quadrille.mesh(self.model, size=4, order=3)),
            ("usage", lambda: quadrille.mesh(self.model, size=4, faces=[99])),
            ("usage", lambda: quadrille.mesh(self.model, size=4, strategy="magic")),
            ("usage", lambda: quadrille.mesh(self.model, size=4, sizes={"Side1": 2})),
            ("usage", lambda: quadrille.mesh(self.model, size=4, sizes={"Face1": float("nan")})),
            ("usage", lambda: quadrille.mesh(self.model, elements_per_diagonal=0)),
            ("usage", lambda: quadrille.mesh(self.model, elements_per_diagonal=float("nan"))),
            ("usage", lambda: quadrille.mesh(self.model, elements_per_diagonal=-3)),
            ("usage", lambda: quadrille.mesh(self.model, size=2, size_min=4)),
            ("usage", lambda: quadrille.mesh(self.model, size_min=30)),
            ("usage", lambda: quadrille.mesh(self.model, threads=-1)),
            ("usage", lambda: quadrille.mesh(self.model, threads=1.5)),
            ("usage", lambda: quadrille.mesh(self.model, faces=[1.5])),
            ("usage", lambda: quadrille.mesh(self.model, faces="Face1")),
            ("usage", lambda: quadrille.mesh(self.model, faces=1)),
            ("usage", lambda: quadrille.mesh(self.model, faces=[True])),
            ("usage", lambda: quadrille.mesh(self.model, sizes=[1])),
            ("usage", lambda: quadrille.mesh(self.model, partial=2)),
            ("usage", lambda: quadrille.mesh(self.model, size="4")),
            ("usage", lambda: quadrille.mesh(self.model, time_limit=0)),
            ("usage", lambda: quadrille.mesh(self.model, merge_tiny=50)),
            ("failure", lambda: quadrille.mesh(self.model, time_limit=1e-6)),
            ("usage", lambda: quadrille.read(MODELS / "box.brep", sew=1e6)),
            ("usage", lambda: quadrille.read(MODELS / "box.brep", read_time_limit=-1)),
            ("usage", lambda: self.mesh.write("/tmp/mesh.xyz")),
            ("failure", lambda: self.mesh.write("/nowhere/mesh.msh")),
        ):
            with self.assertRaises(quadrille.Error) as caught:
                call()
            self.assertEqual(caught.exception.kind, kind, caught.exception)
            self.assertTrue(str(caught.exception))
            self.assertNotIn("--", str(caught.exception))
            self.assertNotIn("`", str(caught.exception))
        with self.assertRaises(TypeError):
            quadrille.mesh(self.model, sise=4)


if __name__ == "__main__":
    unittest.main(verbosity=2)
