"""quadrille.freecad in a Python that FreeCAD has not started, such as that of a virtual environment."""

import ast
import os
import shutil
import subprocess
import sys
import unittest
from pathlib import Path

import quadrille

SCRIPT = """
import quadrille.freecad
import FreeCAD, Part
document = FreeCAD.newDocument()
box = document.addObject("Part::Box", "Box")
document.recompute()
mesh = quadrille.freecad.mesh_object(box, size=2.0)
print("QUADS", mesh.FemMesh.QuadrangleCount)
"""


def run(script, path):
    return subprocess.run([sys.executable, "-c", script], stdin=subprocess.DEVNULL, capture_output=True, text=True, timeout=200,
                          env={**os.environ, "PATH": path}, check=False)


class OutsideFreeCAD(unittest.TestCase):
    @unittest.skipUnless(shutil.which("freecadcmd"), "NOT TESTED: freecadcmd is not installed")
    def test_meshes_a_part(self):
        said = run(SCRIPT, os.environ["PATH"])
        self.assertIn("QUADS 150\n", said.stdout, said.stderr)

    def test_python_3_8_imports_every_module(self):
        """As scripts/make_wheel.py promises: annotations like list[int] and int | None need a later Python."""
        files = sorted(Path(quadrille.__file__).resolve().parent.rglob("*.py"))
        self.assertGreater(len(files), 40)
        for file in files:
            for node in ast.walk(ast.parse(file.read_text(), feature_version=(3, 8))):
                given = [getattr(node, name, None) for name in ("annotation", "returns")]
                inside = [part for one in given if one for part in ast.walk(one)]
                wrong = [part for part in inside if isinstance(part, ast.BinOp) or isinstance(part, ast.Subscript)
                         and getattr(part.value, "id", "") in ("dict", "frozenset", "list", "set", "tuple", "type")]
                self.assertEqual([ast.unparse(part) for part in wrong], [], file)

    def test_without_freecad_says_what_is_missing(self):
        said = run("import quadrille.freecad", "/nowhere")
        self.assertEqual(said.returncode, 1)
        self.assertRegex(said.stderr.splitlines()[-1], "^ImportError: quadrille.freecad needs FreeCAD and NumPy for this Python .*on PATH")


if __name__ == "__main__":
    unittest.main()
