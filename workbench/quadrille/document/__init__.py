# SPDX-License-Identifier: GPL-3.0-or-later
"""What a FreeCAD document says about a mesh: its part, links, sizes, groups, and whether the mesh is up to date."""
