# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs the `quadrille` command: for `python -m quadrille mesh part.step -o part.inp`, and as the wheel's console script."""

if __name__ == "__main__":
    from .core import entry

    entry.begin("quadrille: stopped")

import os
import sys

from .core.command import find_command
from .core.errors import Error, printable


def main() -> None:
    """Replaces this process with the command, keeping the arguments."""
    try:
        command = find_command()
    except Error as error:
        sys.exit(printable(f"quadrille: {error}"))
    os.execv(command, [command, *sys.argv[1:]])


if __name__ == "__main__":
    main()
