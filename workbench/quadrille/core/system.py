# SPDX-License-Identifier: GPL-3.0-or-later
"""What differs between operating systems for a program that starts others. Independent of FreeCAD."""

import contextlib
import os
import shutil
import subprocess
import threading
import time
import uuid
from pathlib import Path
from typing import Any, Dict, Optional, Tuple

WINDOWS = os.name == "nt"

#: Waits until its input closes, which happens when the process at the other end ends. Then removes all paths that begin with
#: $1. It does so more than once, since a mesher that is ending at the same time may still create a file.
_REMOVE_AT_END = 'cat; for i in 1 2 3; do rm -rf -- "$1"*; sleep 1; done'
#: By process id and parent folder: the prefix of scratch folders, and the shell that removes them when this process ends.
_scratch: Dict[Tuple[int, str], Tuple[str, Optional[subprocess.Popen]]] = {}
_scratch_lock = threading.Lock()  # a second shell for a folder would end the first, which removes what is in use
#: On Windows, which has no such shell, folders that a killed process left are removed when they are this old.
_STALE_SECONDS = 2 * 24 * 3600


def program(name: str) -> str:
    """The file name of a program."""
    return f"{name}.exe" if WINDOWS else name


def start_options() -> Dict[str, Any]:
    """Arguments of subprocess.Popen and run() with which no console window flashes."""
    return {"creationflags": getattr(subprocess, "CREATE_NO_WINDOW", 0x08000000)} if WINDOWS else {}


def scratch_prefix(place: str, environment: Dict[str, str]) -> str:
    """How the names of this process's temporary folders in a folder begin; they are removed when it ends, even if it is
    killed (on Windows, in two days)."""
    key = (os.getpid(), place)
    with _scratch_lock:
        if key not in _scratch:
            prefix = f"quadrille-{os.getpid()}-{uuid.uuid4().hex[:8]}-"
            shell = None
            if WINDOWS:
                remove_stale(place)
            else:
                shell = subprocess.Popen(["/bin/sh", "-c", _REMOVE_AT_END, "sh", os.path.join(place, prefix)],
                                         stdin=subprocess.PIPE, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                                         env=environment, start_new_session=True)
            _scratch[key] = (prefix, shell)
        return _scratch[key][0]


def remove_stale(place: str, seconds: float = _STALE_SECONDS) -> None:
    """Removes temporary folders of ended processes that are older than so many seconds. What cannot be removed stays."""
    for folder in Path(place).glob("quadrille-*-*-*"):
        with contextlib.suppress(OSError):
            if folder.is_dir() and time.time() - folder.stat().st_mtime > seconds:
                shutil.rmtree(folder, ignore_errors=True)
