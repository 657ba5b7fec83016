# SPDX-License-Identifier: GPL-3.0-or-later
"""FreeCAD's solvers: the check of a mesh before a run, fast input for CalculiX, and results of shells."""
