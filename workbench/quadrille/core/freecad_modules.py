# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes FreeCAD's modules importable in a Python that was not started by FreeCAD."""

import shutil
import sys
from pathlib import Path


def find() -> None:
    """Makes FreeCAD's modules importable if FreeCAD is installed for this Python. Searches them next to freecadcmd. Raises
    ImportError, which says what is missing."""
    try:
        import FreeCAD as _
        return
    except ImportError as error:
        reason: Exception = error
    before = list(sys.path)
    for program in filter(None, [shutil.which(name) for name in ("freecadcmd", "FreeCADCmd")]):
        home = Path(program).resolve().parent.parent
        sys.path.append(str(home / "lib"))
        sys.path += [str(folder) for folder in sorted((home / "Mod").glob("*")) if folder.is_dir()]
        try:
            import FreeCAD as _  # noqa: F811
            import numpy as _  # noqa: F401, F811
            return
        except ImportError as error:  # FreeCAD is for another Python, or NumPy is missing
            sys.path[:] = before
            reason = error
    raise ImportError(f"quadrille.freecad needs FreeCAD and NumPy for this Python ({reason}): install them so that freecadcmd is on "
                      "PATH, or run the script in FreeCAD; the command does without") from reason
