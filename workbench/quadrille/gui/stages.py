# SPDX-License-Identifier: GPL-3.0-or-later
"""What the mesher does at each stage, in words for users."""

from . import QT_TRANSLATE_NOOP, translate

#: By the names under which the mesher reports its stages.
STAGES = {
    "read": QT_TRANSLATE_NOOP("Quadrille", "reading the part"),
    "midsurface": QT_TRANSLATE_NOOP("Quadrille", "finding the middle surface"),
    "size": QT_TRANSLATE_NOOP("Quadrille", "finding sizes"),
    "sample": QT_TRANSLATE_NOOP("Quadrille", "dividing edges"),
    "mesh": QT_TRANSLATE_NOOP("Quadrille", "meshing faces"),
    "triangulate": QT_TRANSLATE_NOOP("Quadrille", "making triangles"),
    "color": QT_TRANSLATE_NOOP("Quadrille", "pairing triangles"),
    "recombine": QT_TRANSLATE_NOOP("Quadrille", "making quads"),
    "improve": QT_TRANSLATE_NOOP("Quadrille", "improving quads"),
    "slide": QT_TRANSLATE_NOOP("Quadrille", "moving nodes"),
    "assemble": QT_TRANSLATE_NOOP("Quadrille", "joining faces"),
    "write": QT_TRANSLATE_NOOP("Quadrille", "writing the mesh"),
}


def words_of(stage: str) -> str:
    """What the mesher does at a stage; the name itself if it is not known."""
    return translate("Quadrille", STAGES[stage]) if stage in STAGES else stage
