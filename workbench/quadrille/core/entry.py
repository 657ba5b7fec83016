# SPDX-License-Identifier: GPL-3.0-or-later
"""How a program of this package begins: it runs nothing from the current folder, and Ctrl-C ends it with one sentence.

Programs import this before anything else. `python3 -m` searches the current folder first, where a json.py may lie beside the
CAD files of strangers.
"""

import _signal  # built in: the module signal would import others, during which Ctrl-C ended with a traceback
import os
import sys


def _is_current_folder(path: str) -> bool:
    try:
        return os.path.samefile(path or os.curdir, os.curdir)
    except OSError:
        return False


def begin(stopped: str) -> None:
    """Takes the current folder out of sys.path, unless this package or Python lies there. On Ctrl-C the process prints the sentence and
    ends with exit code 130; its children end with it, since their input closes."""

    def stop(*_) -> None:
        os.write(2, f"{stopped}\n".encode())
        os._exit(130)

    if _signal.getsignal(_signal.SIGINT) is not _signal.SIG_IGN:  # as in the background of a shell
        _signal.signal(_signal.SIGINT, stop)
    package = os.path.dirname(os.path.dirname(__file__))
    if not any(_is_current_folder(os.path.dirname(path)) for path in (package, os.__file__)):
        sys.path[:] = [path for path in sys.path if not _is_current_folder(path)]
