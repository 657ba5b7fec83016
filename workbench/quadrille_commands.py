# SPDX-License-Identifier: GPL-3.0-or-later
"""What FreeCAD's macros import for the commands of Quadrille: FreeCAD records the import of the file that adds a command, by
its bare name, so that one must be found by it."""


def add(name: str, command) -> None:
    """Makes a command known to FreeCAD."""
    import FreeCADGui  # macros run without a window too

    FreeCADGui.addCommand(name, command)
