"""The package calls nothing that Windows lacks, outside of core/system.py, and cleans up there after killed processes."""

import ast
import os
import tempfile
import time
import unittest
from pathlib import Path
from unittest import mock

from quadrille.core import command, system

PACKAGE = Path(__file__).resolve().parents[2] / "workbench" / "quadrille"
#: Names that Python has on POSIX alone, and places of POSIX.
LACKING = {"fork", "setsid", "getpgid", "killpg", "getuid", "geteuid", "mkfifo", "preexec_fn", "start_new_session", "SIGKILL",
           "SIGALRM", "setitimer", "fcntl", "pwd", "grp", "resource", "pty", "termios"}
PLACES = ("/tmp", "/proc", "/dev/", "/bin/", "/usr/", "/etc/")


def calls_of_posix(text):
    """The names and places in a source that Windows lacks. Comments and docstrings do not count."""
    tree = ast.parse(text)
    found = []
    for node in ast.walk(tree):
        if isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant):
            node.value.value = ""
    for node in ast.walk(tree):
        names = {"attr": getattr(node, "attr", None), "arg": getattr(node, "arg", None)}
        found += [name for name in names.values() if isinstance(name, str) and name in LACKING]
        if isinstance(node, (ast.Import, ast.ImportFrom)):
            found += [alias.name for alias in node.names if alias.name in LACKING]
        if isinstance(node, ast.Constant) and isinstance(node.value, str):
            found += [place for place in PLACES if node.value.startswith(place)]
        if isinstance(node, ast.Call) and ast.unparse(node.func) == "os.kill":
            found.append("os.kill")
    return found


class System(unittest.TestCase):
    def test_nothing_that_windows_lacks(self):
        files = [path for path in sorted(PACKAGE.rglob("*.py")) if path.name != "system.py"]
        self.assertGreater(len(files), 50)
        self.assertEqual([(path.name, found) for path in files for found in calls_of_posix(path.read_text("utf-8"))], [])

    def test_such_calls_are_found(self):
        for text in ("import os\nos.fork()", "import os\nos.kill(1, 9)", "subprocess.run(x, preexec_fn=f)", "import fcntl",
                     "open('/proc/self/maps')"):
            self.assertEqual(len(calls_of_posix(text)), 1, text)
        self.assertEqual(calls_of_posix('def f():\n    """/tmp is not named."""\n    return tempfile.gettempdir()'), [])

    def test_old_scratch_folders_go(self):
        with tempfile.TemporaryDirectory() as place:
            names = ["quadrille-1-abc-x", "quadrille-2-abc-y", "other"]
            for name in names:
                (Path(place) / name).mkdir()
                (Path(place) / name / "mesh.inp").touch()
            past = time.time() - 3 * 24 * 3600
            for name in ("quadrille-1-abc-x", "other"):
                os.utime(Path(place) / name, (past, past))
            system.remove_stale(place)
            self.assertEqual(sorted(os.listdir(place)), ["other", "quadrille-2-abc-y"])

    def test_programs_end_in_exe_on_windows(self):
        with mock.patch.object(system, "WINDOWS", True):
            self.assertEqual(system.program("quadrille"), "quadrille.exe")
            self.assertNotEqual(system.start_options()["creationflags"], 0)
        with mock.patch.object(system, "WINDOWS", False):
            self.assertEqual((system.program("quadrille"), system.start_options()), ("quadrille", {}))

    def test_the_mesher_in_the_addon_is_found(self):
        with tempfile.TemporaryDirectory() as place:
            package = Path(place) / "Quadrille" / "quadrille"
            (package.parent / "bin").mkdir(parents=True)
            mesher = package.parent / "bin" / system.program("quadrille")
            mesher.touch(mode=0o755)
            self.assertEqual(command._own(package), str(mesher))


if __name__ == "__main__":
    unittest.main()
