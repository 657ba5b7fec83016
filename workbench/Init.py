# SPDX-License-Identifier: GPL-3.0-or-later
"""FreeCAD runs this file when it starts, with or without a window. FreeCAD has put this folder on sys.path, so scripts
and the Python console can `import quadrille.freecad`."""

import FreeCAD

# `freecadcmd -t quadrille.selftest` and FreeCAD's Test workbench run these tests.
FreeCAD.__unit_test__ += ["quadrille.selftest"]
