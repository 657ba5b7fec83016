# SPDX-License-Identifier: GPL-3.0-or-later
"""An input field for lengths with units ("0.5 mm", "1/8 in").

FreeCAD's own fields round to the decimals set in the preferences, or to sixteenths of an inch, whenever they are shown. A
panel with them would change sizes just by opening."""

import math
import sys
from typing import Optional

import FreeCAD
from PySide import QtCore, QtGui

from ..core.errors import Error
from ..core.units import digits
from . import translate
from .placeholders import dim_placeholder


#: The field's smallest width, which grows with its text up to the other, in pixels.
_LEAST_WIDTH, _MOST_WIDTH = 70, 125


class LengthField(QtGui.QLineEdit):
    """Shows a length so that it can be read back exactly. If the length is optional (`otherwise` is given), 0 is shown as an
    empty field with `otherwise` as placeholder."""

    def __init__(self, name: str = "", otherwise: str = "") -> None:
        super().__init__()
        self._otherwise = otherwise
        self.setPlaceholderText(otherwise)
        dim_placeholder(self)
        self.setObjectName(name)
        # It may become narrow in a narrow panel, since its text scrolls.
        self.setMinimumWidth(_LEAST_WIDTH)
        self.setSizePolicy(QtGui.QSizePolicy.Ignored, QtGui.QSizePolicy.Fixed)
        self.editingFinished.connect(self._write_unit)
        self.textChanged.connect(lambda *_: self._make_room())

    def show_length(self, millimeters: float) -> None:
        """Shows a length in the user's units, or in millimeters with all digits if the user's units would round it."""
        if self._otherwise and millimeters == 0:
            self.setText("")
            return
        text = FreeCAD.Units.Quantity(millimeters, FreeCAD.Units.Length).UserString
        try:
            exact = abs(_parsed(text) - millimeters) <= 1e-9 * abs(millimeters)
        except Error:  # FreeCAD cannot read everything that it writes
            exact = False
        self.setText(text if exact else f"{millimeters:.10g} mm")
        self.setCursorPosition(0)

    def _make_room(self) -> None:
        """Keeps the unit in sight: without its last letter, "0.993 mm" would be another length."""
        frame = self.minimumSizeHint().width() - self.fontMetrics().maxWidth()  # of Qt's own hint, which is one letter wide
        text = self.fontMetrics().boundingRect(self.text()).width() + self.fontMetrics().averageCharWidth()
        self.setMinimumWidth(min(max(_LEAST_WIDTH, text + frame), _MOST_WIDTH))

    def show_otherwise(self, millimeters: Optional[float]) -> None:
        """Shows in the placeholder the length that is used while the field is empty."""
        self.setPlaceholderText(self._otherwise if millimeters is None else f"{digits(millimeters)} mm ({self._otherwise})")

    def _write_unit(self) -> None:
        """Appends the current unit to a bare number. So the length does not change when the unit schema changes, as it may with
        another document in FreeCAD 1.0."""
        try:
            if _quantity(self.text()).Unit == FreeCAD.Units.Unit():
                self.show_length(self.length())
        except Error:  # length() reports it when called
            pass

    def length(self, label: str = "") -> float:
        """The length in millimeters. Raises Error if the text is not a length."""
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

    #: Same property as in FreeCAD's own fields.
    rawValue = QtCore.Property(float, _raw, show_length)


def _quantity(text: str):
    try:
        quantity = FreeCAD.Units.Quantity(text)
    except Exception as error:  # the type differs between FreeCAD versions
        raise Error(text, "usage") from error
    if quantity.Value == sys.float_info.min:  # FreeCAD's result for empty text and for unknown digits
        raise Error(text, "usage")
    return quantity


def _parsed(text: str) -> float:
    """A text as a length in millimeters. A bare number is in the unit that the user's schema uses for lengths around 1 mm."""
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
