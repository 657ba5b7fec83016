# SPDX-License-Identifier: GPL-3.0-or-later
"""FreeCAD runs this file when its window starts. Adds the workbench, its commands, and their entries in the FEM workbench."""

import FreeCADGui


class QuadrilleWorkbench(FreeCADGui.Workbench):
    """All-quad shell meshes for FEM."""

    MenuText = "Quadrille"
    ToolTip = "All-quad shell meshes of CAD parts, for FEM"

    def __init__(self):
        # FreeCAD runs this file without setting __file__.
        from quadrille.gui import icon

        self.__class__.Icon = icon("quadrille")

    def Initialize(self):
        """FreeCAD calls this when the workbench is first activated."""
        from quadrille.gui import commands

        commands.register()
        self.appendToolbar("Quadrille", commands.TOOLBAR)
        self.appendMenu("Quadrille", commands.TOOLBAR)

    def GetClassName(self):
        """The type by which FreeCAD recognizes a workbench written in Python."""
        return "Gui::PythonWorkbench"


def _start():
    """Registers the commands at startup, so that the FEM workbench and macros can use them too."""
    from quadrille.gui import TRANSLATIONS, ahead, commands, fem_workbench, preferences

    FreeCADGui.addLanguagePath(str(TRANSLATIONS))
    FreeCADGui.updateLocale()
    preferences.add_page()
    commands.register()
    fem_workbench.join(commands.COMMANDS, commands.TOOLBAR)
    ahead.join()


FreeCADGui.addWorkbench(QuadrilleWorkbench())
_start()
