# SPDX-License-Identifier: GPL-3.0-or-later
"""Lengths as users give them. Runs inside FreeCAD."""

import FreeCAD


def millimeters(value) -> float:
    """Converts a number, a quantity, or a text with a unit ("2 cm") to millimeters."""
    if isinstance(value, str):
        value = FreeCAD.Units.Quantity(value)
    return float(getattr(value, "Value", value))
