"""quadrille.core.command: finding the command, running it as a child, cancelling it, its errors."""

import json
import os
import stat
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path
from unittest import mock

import quadrille.core.command
from quadrille import Error
from quadrille.core.command import MeshJob, MeshSettings, find_command

from quadrille.core.setting_table import SETTINGS, TABLES, from_property, to_property

MODELS = Path(os.environ["QUADRILLE_MODELS"])


class CommandTest(unittest.TestCase):
    """Each test has a folder of its own."""

    def setUp(self):
        self._folder = tempfile.TemporaryDirectory()
        self.folder = Path(self._folder.name)

    def tearDown(self):
        self._folder.cleanup()

    def script(self, text):
        """A stand-in for the command."""
        path = self.folder / "quadrille"
        path.write_text("#!/bin/sh\n" + text)
        path.chmod(path.stat().st_mode | stat.S_IXUSR)
        return str(path)

    def test_settings_as_arguments(self):
        settings = MeshSettings(size=2.0, order=2, faces=(3, "Face7"), sizes={"Edge4": 0.5}, partial=True)
        self.assertEqual(
            settings.arguments(),
            ["--size", "2.0", "--order", "2", "--faces", "Face3,Face7", "--size-on", "Edge4=0.5", "--partial"],
        )
        self.assertEqual(MeshSettings(segments={"Edge4": 20}, size_in=["sphere:0,0,0,5=1,9"]).arguments(),
                         ["--size-in", "sphere:0,0,0,5=1,9", "--segments", "Edge4=20"])
        with self.assertRaises(TypeError):
            MeshSettings(seed=1)

    def test_a_mesher_stands_by_for_the_place_where_it_was_started(self):
        self.addCleanup(quadrille.core.command.dismiss)
        self.addCleanup(os.chdir, os.getcwd())
        quadrille.core.command.stand_by(find_command())
        first = quadrille.core.command._standby[1]
        box = MeshJob(MODELS.resolve() / "box.brep", [self.folder / "a.msh"], MeshSettings(size=5.0)).start()
        self.assertIs(box._process, first)
        self.assertGreater(box.wait()["counts"]["quads"], 0)
        quadrille.core.command.stand_by(find_command())
        second = quadrille.core.command._standby[1]
        os.chdir(self.folder)
        elsewhere = MeshJob(MODELS / "box.brep", ["b.msh"], MeshSettings(size=5.0)).start()
        self.assertIsNot(elsewhere._process, second)
        elsewhere.wait()
        self.assertEqual(sorted(os.listdir(self.folder)), ["a.msh", "b.msh"])
        self.assertIsNone(second.poll())
        quadrille.core.command.dismiss()
        self.assertIsNotNone(second.poll())

    def test_no_display_is_told_once(self):
        """Neither a display nor Xvfb, as where nothing but the package is installed."""
        with tempfile.TemporaryDirectory() as folder:
            said = subprocess.run([os.environ["QUADRILLE_COMMAND"], "mesh", MODELS / "box.brep", "-o", "a.msh", "--picture", "a.png",
                                   "--quiet"], cwd=folder, capture_output=True, text=True, check=False,
                                  env={"PATH": "/nowhere"})
            self.assertEqual(said.returncode, 1)
            self.assertEqual(said.stderr, "quadrille: a.png: the picture cannot be drawn (there is no display, and Xvfb (package "
                                          "xvfb) cannot be started)\n")
            self.assertEqual(os.listdir(folder), ["a.msh"])

    def test_table_is_the_commands(self):
        answer = subprocess.run([find_command(), "settings", "--json"], capture_output=True, text=True, check=True)
        self.assertEqual(json.loads(answer.stdout), SETTINGS,
                         "write it anew: build/quadrille settings --json > workbench/quadrille/settings.json")
        answer = subprocess.run([find_command(), "settings", "--tables"], capture_output=True, text=True, check=True)
        self.assertEqual(json.loads(answer.stdout), TABLES,
                         "write it anew: build/quadrille settings --tables > workbench/quadrille/tables.json")

    def test_every_setting_reaches_the_mesher(self):
        values = {"number": 7.5, "count": 2, "flag": True, "names": ["Face1"], "sizes": {"Face1": 3.0}}
        for setting in SETTINGS:
            value = values.get(setting["kind"], setting["choices"][-1] if setting["choices"] else None)
            value = {"nodes": 9, "groups": ["faces"], "chord_error": "0.5", "size_in": ["sphere:0,0,0,5=1,9"],
                     "segments": ["Edge4=6"], "bias": ["Edge4=1.2"], "bias_both": ["Edge4=1.2"]}.get(setting["name"], value)
            value = {"mm": 0.5, "s": 100.0}.get(setting["unit"], value) if setting["kind"] == "number" else value
            if value is None:
                continue  # files
            with self.subTest(setting=setting["name"]):
                job = MeshJob(MODELS / "box.brep", [self.folder / "box.msh"], MeshSettings(**{setting["name"]: value}))
                self.assertGreater(job.start().wait()["counts"]["quads"], 0)
                if setting["property"]:
                    there = to_property(setting, value)
                    self.assertEqual(from_property(setting, there), value)
                    self.assertEqual(from_property(setting, to_property(setting, None)),
                                     2 if setting["name"] == "order" else setting["default"] or
                                     (setting["default"] if setting["kind"] in ("flag", "count", "number") else None))

    def test_progress_is_of_the_whole_and_never_falls(self):
        seen = []
        settings = MeshSettings(elements_per_diagonal=600.0, threads=1)
        MeshJob(MODELS / "bracket.step", [self.folder / "bracket.msh"], settings).start().wait(
            lambda stage, fraction: seen.append((stage, fraction)))
        fractions = [fraction for stage, fraction in seen if stage != "start"]
        self.assertEqual(fractions, sorted(fractions))
        self.assertTrue({stage for stage, _ in seen} <= {"start", "read", "size", "sample", "mesh", "slide", "assemble", "write"})
        meshing = {fraction for stage, fraction in seen if stage == "mesh"}
        self.assertGreater(max(meshing), 0.15, "the faces move it")

    def test_found_in_order(self):
        given = self.script("exit 0\n")
        self.assertEqual(find_command(given), given)
        with mock.patch.dict(os.environ, QUADRILLE_COMMAND=given):
            self.assertEqual(find_command(), given)
        with mock.patch.dict(os.environ, PATH=str(self.folder)):
            os.environ.pop("QUADRILLE_COMMAND", None)
            self.assertEqual(find_command(preference=given), given)
            self.assertEqual(find_command(), given)
        with self.assertRaises(Error) as caught:
            find_command("/nowhere/quadrille")
        self.assertEqual(caught.exception.kind, "usage")

    def test_mesh_and_report(self):
        output = self.folder / "box.msh"
        report = MeshJob(MODELS / "box.brep", [output], MeshSettings(size=5.0)).start().wait()
        self.assertTrue(output.stat().st_size)
        self.assertGreater(report["counts"]["quads"], 20)
        self.assertEqual(report["counts"]["triangles"], 0)
        self.assertEqual([face["note"] for face in report["faces"]], 6 * ["grid"])

    def test_error_has_the_commands_sentence(self):
        with self.assertRaises(Error) as caught:
            MeshJob(MODELS / "box.brep", [self.folder / "box.msh"], MeshSettings(size=-1.0)).start().wait()
        self.assertEqual(caught.exception.kind, "usage")
        self.assertIn("--size", str(caught.exception))
        self.assertFalse(str(caught.exception).startswith("quadrille:"))

    def test_progress_lines(self):
        command = self.script("echo 'progress: sample 40 %' >&2; echo 'a remark' >&2; sleep 0.1; exit 3\n")
        seen = []
        job = MeshJob("x.brep", ["x.msh"], command=command).start()
        with self.assertRaises(Error) as caught:
            job.wait(lambda stage, fraction: seen.append((stage, fraction)))
        self.assertIn(("sample", 0.4), seen)
        self.assertEqual(str(caught.exception), "a remark")

    def test_cancel_ends_the_child(self):
        command = self.script("trap '' TERM; echo 'progress: sample 1 %' >&2; sleep 60 & wait; wait\n")
        job = MeshJob("x.brep", ["x.msh"], command=command).start()
        with mock.patch("quadrille.core.command.KILL_AFTER_SECONDS", 0.2), self.assertRaises(Error) as caught:
            job.wait(lambda stage, fraction: stage != "sample")
        self.assertEqual(caught.exception.kind, "cancelled")
        self.assertFalse(job.running)
        self.assertEqual(job._process.returncode, -9)  # it did not end by itself

    def test_killed_child(self):
        with self.assertRaises(Error) as caught:
            MeshJob("x.brep", ["x.msh"], command=self.script("kill -9 $$\n")).start().wait()
        self.assertIn("signal 9", str(caught.exception))

    def test_the_child_ends_with_a_killed_parent(self):
        code = ("import sys; sys.path.insert(0, sys.argv[1])\n"
                "from quadrille.core.command import MeshJob, MeshSettings\n"
                "job = MeshJob(sys.argv[2], [sys.argv[3]], MeshSettings(size=0.01, force=True)).start()\n"
                "print(job._process.pid, job._folder.name, flush=True)\n"
                "job.wait()\n")
        package = str(Path(quadrille.core.command.__file__).parents[2])
        place = self.folder / "temporary"
        place.mkdir()
        parent = subprocess.Popen([sys.executable, "-c", code, package, str(MODELS / "box.brep"),
                                   str(self.folder / "box.msh")], stdout=subprocess.PIPE, text=True, env={**os.environ, "TMPDIR": str(place)})
        child, folder = parent.stdout.readline().split()
        time.sleep(0.3)
        parent.kill()
        parent.wait()
        parent.stdout.close()
        end = time.monotonic() + 120
        while (os.path.exists(f"/proc/{child}") or os.path.isdir(folder)) and time.monotonic() < end:
            time.sleep(0.05)
        self.assertFalse(os.path.exists(f"/proc/{child}"))
        self.assertEqual(list(self.folder.iterdir()), [place])
        self.assertEqual(list(place.iterdir()), [])

    def test_no_place_for_temporary_files(self):
        with mock.patch("tempfile.gettempdir", return_value=str(self.folder / "gone")), \
                self.assertRaises(Error) as caught:
            MeshJob("x.brep", ["x.msh"], command="/bin/true")
        self.assertIn("TMPDIR", str(caught.exception))

    def test_many_messages_do_not_block(self):
        command = self.script("i=0; while [ $i -lt 5000 ]; do echo line$i >&2; i=$((i+1)); done; exit 1\n")
        with self.assertRaises(Error) as caught:
            MeshJob("x.brep", ["x.msh"], command=command).start().wait()
        self.assertEqual(str(caught.exception), "line4999")


if __name__ == "__main__":
    unittest.main(verbosity=2)
