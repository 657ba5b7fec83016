# SPDX-License-Identifier: GPL-3.0-or-later
"""Lengths as users give them, and numbers as they read them. Runs inside FreeCAD."""

import FreeCAD


def millimeters(value) -> float:
    """Converts a number, a quantity, or a text with a unit ("2 cm") to millimeters."""
    if isinstance(value, str):
        value = FreeCAD.Units.Quantity(value)
    return float(getattr(value, "Value", value))


def digits(value) -> str:
    """A number for users, with at most four significant digits and no more than the digits before the point if it is large."""
    text = f"{float(value):.4g}"
    return f"{float(text):.0f}" if "e+" in text and abs(float(value)) < 1e15 else text
