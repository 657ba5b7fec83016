# SPDX-License-Identifier: GPL-3.0-or-later
"""The data of a mesh in a FreeCAD document: its part, links, sizes, groups, and whether the mesh is up to date."""

from ..core.errors import translate  # noqa: F401
