# SPDX-License-Identifier: GPL-3.0-or-later
"""Adds Quadrille's commands to FreeCAD. For a recorded macro, FreeCAD writes an import of the file that adds a command, by the
file's bare name. So this file must be importable under its bare name."""


def add(name: str, command) -> None:
    """Registers a command with FreeCAD."""
    import FreeCADGui  # imported here since macros also run without a window

    FreeCADGui.addCommand(name, command)
