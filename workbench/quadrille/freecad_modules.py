# SPDX-License-Identifier: GPL-3.0-or-later
"""Puts FreeCAD's modules within reach of a Python that FreeCAD has not started."""

import shutil
import sys
from pathlib import Path


def find() -> None:
    """Makes FreeCAD's modules importable where FreeCAD is installed for this Python: they lie beside freecadcmd. Raises
    ImportError that tells what is missing."""
    try:
        import FreeCAD as _
        return
    except ImportError as error:
        reason: Exception = error
    before = list(sys.path)
    for program in filter(None, map(shutil.which, ("freecadcmd", "FreeCADCmd"))):
        home = Path(program).resolve().parent.parent
        sys.path.append(str(home / "lib"))
        sys.path += [str(folder) for folder in sorted((home / "Mod").glob("*")) if folder.is_dir()]
        try:
            import FreeCAD as _
            import numpy as _  # noqa: F811
            return
        except ImportError as error:  # of another Python, or without NumPy
            sys.path[:] = before
            reason = error
    raise ImportError(f"quadrille.freecad needs FreeCAD and NumPy for this Python ({reason}): install them so that freecadcmd is on "
                      "PATH, or run the script in FreeCAD; the command does without") from reason
