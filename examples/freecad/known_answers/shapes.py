# SPDX-License-Identifier: GPL-3.0-or-later
"""Shapes that several problems make."""

import Part


def joined(faces):
    """Faces as one shell, their common edges shared."""
    return Part.makeShell(faces[0].generalFuse(faces[1:], 1e-6)[0].Faces)
