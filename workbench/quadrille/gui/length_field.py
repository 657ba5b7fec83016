# SPDX-License-Identifier: GPL-3.0-or-later
"""A field for lengths with units ("0.5 mm", "1/8 in").

FreeCAD's own boxes round to the decimals of the preferences, or to sixteenths of an inch, whenever they are shown: a panel
with them changes sizes by opening."""

import math
import sys

import FreeCAD
from PySide import QtCore, QtGui

from ..errors import Error
from . import translate


class LengthField(QtGui.QLineEdit):
    """Shows a length so that it can be read back exactly. Where it may be left out, 0 is an empty field that says what
    holds then."""

    def __init__(self, name: str = "", otherwise: str = "") -> None:
        super().__init__()
        self._otherwise = otherwise
        self.setPlaceholderText(otherwise)
        self.setObjectName(name)
        # Narrow panels may make it narrow: it scrolls.
        self.setMinimumWidth(70)
        self.setSizePolicy(QtGui.QSizePolicy.Ignored, QtGui.QSizePolicy.Fixed)
        self.editingFinished.connect(self._write_unit)

    def show_length(self, millimeters: float) -> None:
        """Shows a length in the user's units; in millimeters and in full where those would round it."""
        if self._otherwise and millimeters == 0:
            self.setText("")
            return
        text = FreeCAD.Units.Quantity(millimeters, FreeCAD.Units.Length).UserString
        try:
            exact = abs(_parsed(text) - millimeters) <= 1e-9 * abs(millimeters)
        except Error:  # FreeCAD does not read all that it writes
            exact = False
        self.setText(text if exact else f"{millimeters:.10g} mm")
        self.setCursorPosition(0)

    def _write_unit(self) -> None:
        """A bare number is in the user's unit of now: with the unit it stays that length when another schema comes, as with
        another document in FreeCAD 1.0."""
        try:
            if _quantity(self.text()).Unit == FreeCAD.Units.Unit():
                self.show_length(self.length())
        except Error:  # of which those tell who ask for the length
            pass

    def length(self, label: str = "") -> float:
        """The length in millimeters; raises Error when it is none."""
        if self._otherwise and not self.text().strip():
            return 0.0
        try:
            return _parsed(self.text())
        except Error:
            raise Error(translate("Quadrille", "{}: '{}' is not a length, such as 0.5 mm or 1/8 in").format(
                label, self.text()), "usage") from None

    def _raw(self) -> float:
        try:
            return self.length()
        except Error:
            return 0.0

    #: As FreeCAD's boxes have it.
    rawValue = QtCore.Property(float, _raw, show_length)


def _quantity(text: str):
    try:
        quantity = FreeCAD.Units.Quantity(text)
    except Exception as error:  # FreeCAD versions raise different ones
        raise Error(text, "usage") from error
    if quantity.Value == sys.float_info.min:  # what FreeCAD makes of no text, and of digits that it does not know
        raise Error(text, "usage")
    return quantity


def _parsed(text: str) -> float:
    """A length in millimeters; a bare number is in the unit that the user's schema has for lengths of about a millimeter."""
    quantity = _quantity(text)
    if quantity.Unit == FreeCAD.Units.Unit():
        factor = FreeCAD.Units.schemaTranslate(FreeCAD.Units.Quantity("1 mm"), FreeCAD.Units.getSchema())[1]
        value = quantity.Value * factor
    elif quantity.Unit == FreeCAD.Units.Length:
        value = quantity.Value
    else:
        raise Error(text, "usage")
    if not 0 <= value < math.inf:
        raise Error(text, "usage")
    return float(value)
