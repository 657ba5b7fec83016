"""The cells of examples/notebook.ipynb, one after the other, with what each shows."""

import ast
import json
import os
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]


def run(source, names):
    """Runs a cell; gives the value of its last line where that is an expression, as notebooks do."""
    tree = ast.parse(source)
    last = tree.body.pop() if isinstance(tree.body[-1], ast.Expr) else None
    exec(compile(tree, "cell", "exec"), names)
    return None if last is None else eval(compile(ast.Expression(last.value), "cell", "eval"), names)


class Notebook(unittest.TestCase):
    def test_cells_run(self):
        notebook = json.loads((ROOT / "examples" / "notebook.ipynb").read_text(encoding="utf-8"))
        cells = ["".join(cell["source"]) for cell in notebook["cells"] if cell["cell_type"] == "code"]
        self.assertGreater(len(cells), 5)
        names, pictures = {}, 0
        with tempfile.TemporaryDirectory() as folder:
            os.symlink(ROOT / "examples" / "models", Path(folder) / "models")
            here = os.getcwd()
            os.chdir(folder)
            self.addCleanup(os.chdir, here)
            for cell in cells:
                value = run(cell, names)
                if hasattr(value, "_repr_html_"):
                    pictures += "data:image/png" in value._repr_html_()
            self.assertTrue((Path(folder) / "bracket.inp").is_file())
            os.chdir(here)
        self.assertEqual(pictures, 3)
        self.assertGreater(len(names["mesh"].quads), 1500)
        self.assertEqual(names["fine"].quads.shape[1], 8)


if __name__ == "__main__":
    unittest.main()
