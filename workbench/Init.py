# SPDX-License-Identifier: GPL-3.0-or-later
"""Run by FreeCAD at its start, with a window or without. FreeCAD has put this folder on sys.path: scripts and the
Python console can `import quadrille.freecad`."""

import FreeCAD

# `freecadcmd -t quadrille.selftest` runs them, and so does FreeCAD's Test workbench.
FreeCAD.__unit_test__ += ["quadrille.selftest"]
