"""The repository cloned into FreeCAD's Mod folder is the addon: found by FreeCAD, and finding the mesher."""

import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
SCRIPT = """
import sys
import quadrille, quadrille.freecad, quadrille.core.command
print("RESULT", quadrille.__file__)
print("MESHER", quadrille.core.command.find_command())
"""


class Clone(unittest.TestCase):
    def setUp(self):
        self._folder = tempfile.TemporaryDirectory(prefix="quadrille-clone-")
        self.home = pathlib.Path(self._folder.name)

    def tearDown(self):
        self._folder.cleanup()

    def test_a_clone_is_the_addon(self):
        clone = self.home / "Mod" / "Quadrille"
        # What a clone holds: the files that are in the repository.
        files = subprocess.run(["git", "-C", ROOT, "ls-files", "package.xml", "workbench"], capture_output=True, text=True,
                               check=True).stdout.split()
        self.assertIn("package.xml", files)
        for file in files:
            (clone / file).parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(ROOT / file, clone / file)
        mesher = clone / "build" / "quadrille"
        mesher.parent.mkdir()
        mesher.write_text("#!/bin/sh\n")
        mesher.chmod(0o755)
        script = self.home / "where.py"
        script.write_text(SCRIPT)
        environment = {name: value for name, value in os.environ.items() if not name.startswith(("QUADRILLE", "PYTHONPATH"))}
        environment.update(FREECAD_USER_HOME=str(self.home), PATH="/usr/bin:/bin")
        said = subprocess.run(["freecadcmd", script], stdin=subprocess.DEVNULL, capture_output=True, text=True,
                              timeout=120, env=environment, check=False)
        self.assertIn(f"RESULT {clone}/workbench/quadrille/__init__.py", said.stdout, said.stdout + said.stderr)
        self.assertIn(f"MESHER {mesher}", said.stdout, said.stdout + said.stderr)

    def test_the_script_installs_for_every_freecad(self):
        """FreeCAD 1.1 has a folder of its own, unless an older one has been there before it."""
        data = self.home / "data" / "FreeCAD"
        (data / "v1-1").mkdir(parents=True)
        environment = {**os.environ, "XDG_DATA_HOME": str(data.parent), "HOME": str(self.home)}
        environment.pop("FREECAD_USER_HOME", None)
        addons = [folder / "Mod" / "Quadrille" for folder in (data, data / "v1-1")]
        for arguments in ([], ["--link"]):
            subprocess.run([ROOT / "install-addon.sh", *arguments], env=environment, capture_output=True, check=True)
            for addon in addons:
                self.assertTrue((addon / "package.xml").is_file())
                self.assertEqual(addon.is_symlink(), bool(arguments))
        subprocess.run([ROOT / "install-addon.sh", "--uninstall"], env=environment, capture_output=True, check=True)
        self.assertEqual([addon for addon in addons if addon.exists()], [])

    def test_both_descriptions_are_the_same(self):
        """Of a clone, and of the addon that install-addon.sh and the package install; only the folder differs."""
        of_clone, installed = ((ROOT / name).read_text() for name in ("package.xml", "workbench/package.xml"))
        self.assertEqual(of_clone.replace("<subdirectory>workbench<", "<subdirectory>./<").replace("<icon>workbench/", "<icon>"),
                         installed)


if __name__ == "__main__":
    if shutil.which("freecadcmd") is None:
        print("OK (skipped=1): NOT TESTED: freecadcmd is not installed")
        sys.exit(0)
    unittest.main()
