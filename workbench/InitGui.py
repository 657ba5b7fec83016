# SPDX-License-Identifier: GPL-3.0-or-later
"""Run by FreeCAD at the start of its window. Commands and task panels are registered here."""
