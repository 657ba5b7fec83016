# SPDX-License-Identifier: GPL-3.0-or-later
"""Operations on shapes that several problems share."""

import Part


def joined(faces):
    """Joins faces into one shell with shared edges."""
    return Part.makeShell(faces[0].generalFuse(faces[1:], 1e-6)[0].Faces)
