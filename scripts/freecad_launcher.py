# SPDX-License-Identifier: GPL-3.0-or-later
"""scripts/freecad_python makes freecadcmd run this file. It runs the script named in the environment as `__main__`."""

import os
import runpy
import sys
import traceback


def run(arguments):
    """Runs the script arguments[0] with the other arguments. Returns the exit code that python3 would have."""
    sys.argv = arguments
    sys.path.insert(0, os.path.dirname(os.path.abspath(arguments[0])))
    try:
        runpy.run_path(arguments[0], run_name="__main__")
        return 0
    except SystemExit as stop:
        if stop.code is None or isinstance(stop.code, int):
            return stop.code or 0
        print(stop.code, file=sys.stderr)
        return 1
    except BaseException:  # even KeyboardInterrupt must end the process here
        traceback.print_exc()
        return 1


# The wrapper discards FreeCAD's greeting. The script's output goes to the real standard output, which is descriptor 3.
sys.stdout.flush()
os.dup2(3, 1)
# FreeCAD replaces these streams with its own console, whose output is lost when the process ends at once.
sys.stdout = os.fdopen(1, "w", buffering=1, encoding="utf-8", errors="replace", closefd=False)
sys.stderr = os.fdopen(2, "w", buffering=1, encoding="utf-8", errors="replace", closefd=False)
status = run(os.environ["QUADRILLE_SCRIPT_ARGUMENTS"].split("\x1f")[:-1])
sys.stdout.flush()
sys.stderr.flush()
os._exit(status)
