"""A folder of parts meshed by Dask: what fails or crashes stops nothing, what is done is not done again."""

import csv
import io
import os
import shutil
import socket
import stat
import tempfile
import unittest
from contextlib import redirect_stderr, redirect_stdout, suppress
from pathlib import Path

from quadrille import batch
from quadrille.core.command import find_command

try:
    import distributed
except ImportError:
    distributed = None

MODELS = Path(os.environ["QUADRILLE_MODELS"])
# A mesher that crashes on parts of one name, ends without a word on others, and passes on the rest.
WRAPPER = """#!/bin/sh
case "$*" in *--version*) ;; *crash*) kill -SEGV $$ ;; *silent*) exit 1 ;; esac
exec '{command}' "$@"
"""


@unittest.skipIf(distributed is None, "Dask is not installed")
class BatchTest(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder, self.out = Path(scratch.name) / "parts", Path(scratch.name) / "out"
        (self.folder / "deep").mkdir(parents=True)
        for name, target in (("box", "box"), ("cylinder", "deep/b <&> c"), ("box", "crash"), ("box", "silent")):
            shutil.copy(MODELS / f"{name}.brep", self.folder / f"{target}.brep")
        (self.folder / "bad.step").write_text("nonsense")
        (self.folder / "readme.txt").write_text("no CAD")
        self.command = Path(scratch.name) / "mesher"
        self.command.write_text(WRAPPER.format(command=find_command()))
        self.command.chmod(self.command.stat().st_mode | stat.S_IXUSR)

    def run_batch(self, *arguments, folder=None):
        out, err = io.StringIO(), io.StringIO()
        with redirect_stdout(out), redirect_stderr(err):
            code = batch.run([str(folder or self.folder), "-o", str(self.out), "--workers", "2", "--command",
                              str(self.command), "--elements-per-diagonal", "12", *arguments])
        return code, out.getvalue(), err.getvalue()

    def records(self):
        with (self.out / "report.csv").open(encoding="utf-8", newline="") as file:
            return {row["part"]: row for row in csv.DictReader(file)}

    def test_failures_and_crashes_stop_nothing_and_runs_resume(self):
        code, out, err = self.run_batch()
        self.assertEqual(code, 1)
        self.assertIn("2 of 5 parts meshed", out)
        self.assertIn("5 of 5", err)
        rows = self.records()
        self.assertEqual({part: row["status"] for part, row in rows.items()},
                         {"bad.step": "failed", "box.brep": "meshed", "crash.brep": "failed", "silent.brep": "failed",
                          "deep/b <&> c.brep": "meshed"})
        self.assertIn("signal 11", rows["crash.brep"]["reason"])
        self.assertIn("exit code 1", rows["silent.brep"]["reason"])
        self.assertIn("bad.step", rows["bad.step"]["reason"])
        self.assertGreater(int(rows["box.brep"]["quads"]), 10)
        self.assertGreater(float(rows["box.brep"]["q_mean"]), 0.9)
        page = (self.out / "report.html").read_text(encoding="utf-8")
        self.assertEqual(page.count("<tr class="), 5)
        self.assertIn("b &lt;&amp;&gt; c.brep", page)
        self.assertNotIn("b <&> c", page)
        meshes = [self.out / "meshes" / f"{part}.msh" for part in ("box.brep", "deep/b <&> c.brep")]
        for picture in ("box.brep", "deep/b <&> c.brep"):
            self.assertTrue((self.out / "pictures" / f"{picture}.png").is_file())
        before = [path.stat().st_mtime_ns for path in meshes]

        # Nothing is done again but what has changed, and what lost its mesh.
        os.utime(self.folder / "box.brep")
        code, out, err = self.run_batch()
        self.assertIn("1 of 1", err)
        after = [path.stat().st_mtime_ns for path in meshes]
        self.assertGreater(after[0], before[0])
        self.assertEqual(after[1], before[1])
        meshes[1].unlink()
        self.run_batch()
        self.assertTrue(meshes[1].is_file())
        self.assertEqual(meshes[0].stat().st_mtime_ns, after[0])
        # Other options make other meshes.
        _, _, err = self.run_batch("--order", "2", "--quiet")
        self.assertEqual(err, "")
        self.assertGreater(meshes[0].stat().st_mtime_ns, after[0])

    def test_another_dask_may_run_here(self):
        """Dask's own port is taken: nothing is said of it."""
        with socket.socket() as other:
            with suppress(OSError):  # taken by a real one
                other.bind(("", 8787))
                other.listen()
            code, _, err = self.run_batch("--quiet")
        self.assertEqual((code, err), (1, ""))

    def test_bad_use_is_one_sentence(self):
        for arguments, part, expected in (
                (("--scheduler", "tcp://127.0.0.1:1", "--scheduler-timeout", "1"), "no Dask scheduler", 1),
                (("--scheduler", "nonsense"), "no Dask scheduler", 1)):
            code, _, err = self.run_batch(*arguments)
            self.assertEqual(code, expected)
            self.assertIn(part, err)
            self.assertEqual(len(err.strip().splitlines()), 1, err)
        for folder in (self.folder / "missing", self.folder / "readme.txt", self.out.parent / "empty"):
            (self.out.parent / "empty").mkdir(exist_ok=True)
            code, _, err = self.run_batch(folder=folder)
            self.assertEqual(code, 2)
            self.assertEqual(len(err.strip().splitlines()), 1, err)

    def test_options_are_those_of_the_table(self):
        options = batch.parser().parse_args(["f", "-o", "o", "--size", "2", "--size-in", "sphere:0,0,0,1=1", "--size-in",
                                             "box:0,0,0,1,1,1=1", "--partial"])
        self.assertEqual(batch.setting_arguments(options)[:2], ["--size", "2"])
        arguments = " ".join(batch.setting_arguments(options))
        self.assertIn("--size-in sphere:0,0,0,1=1 --size-in box:0,0,0,1,1,1=1", arguments)
        self.assertIn("--partial", arguments)
        self.assertIn(f" --time-limit {batch.TIME_LIMIT} --read-time-limit {batch.TIME_LIMIT}", arguments)
        options = batch.parser().parse_args(["f", "-o", "o", "--read-time-limit", "9"])
        self.assertEqual(batch.setting_arguments(options), ["--read-time-limit", "9", "--time-limit", str(batch.TIME_LIMIT)])


if __name__ == "__main__":
    unittest.main(verbosity=2)
