# SPDX-License-Identifier: GPL-3.0-or-later
"""scripts/freecad_gui makes freecad run this file. It runs the script named in the environment once the window is open."""

import os
import sys
import traceback

from PySide import QtCore


def run_script():
    """Runs the script as `__main__` and ends the process with its exit code."""
    os.dup2(9, 1)
    sys.stdout = os.fdopen(1, "w", buffering=1, encoding="utf-8", errors="replace", closefd=False)
    sys.stderr = os.fdopen(2, "w", buffering=1, encoding="utf-8", errors="replace", closefd=False)
    arguments = os.environ["QUADRILLE_SCRIPT_ARGUMENTS"].split("\x1f")[:-1]
    sys.argv = arguments
    sys.path.insert(0, os.path.dirname(os.path.abspath(arguments[0])))
    status = 1
    try:
        # Run it in FreeCAD's own __main__, like a macro: recorded commands need the names App and Gui, which exist there.
        namespace = sys.modules["__main__"].__dict__
        namespace["__file__"] = os.path.abspath(arguments[0])
        with open(arguments[0], encoding="utf-8") as file:
            exec(compile(file.read(), arguments[0], "exec"), namespace)
        status = 0
    except SystemExit as stop:
        status = stop.code if isinstance(stop.code, int) else 0 if stop.code is None else 1
        if isinstance(stop.code, str):
            print(stop.code, file=sys.stderr)
    except BaseException:  # even KeyboardInterrupt must end the process here
        traceback.print_exc()
    sys.stdout.flush()
    sys.stderr.flush()
    os._exit(status)


QtCore.QTimer.singleShot(500, run_script)
