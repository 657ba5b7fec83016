# SPDX-License-Identifier: GPL-3.0-or-later
"""Placeholders that look like placeholders. Style sheets, such as those of FreeCAD's dark themes, may give them the color of text that
was typed, or one that cannot be read."""

from PySide import QtCore, QtGui

_EVENTS = (QtCore.QEvent.Show, QtCore.QEvent.StyleChange, QtCore.QEvent.PaletteChange)
#: Share of the text's own opacity.
_OPACITY = 0.5


class _Filter(QtCore.QObject):
    """Takes the color from the field's text, whenever that may have changed."""

    def __init__(self, field) -> None:
        super().__init__(field)
        self._after = QtCore.QTimer(self)  # after the style has set its own colors; not after the field has gone
        self._after.setSingleShot(True)
        self._after.timeout.connect(self._dim)

    def eventFilter(self, field, event) -> bool:
        """Qt calls this before a field gets an event."""
        if event.type() in _EVENTS:
            self._after.start(0)
        return False

    def _dim(self) -> None:
        field = self.parent()
        palette = field.palette()
        color = palette.color(QtGui.QPalette.Text)
        color.setAlphaF(_OPACITY * color.alphaF())
        if palette.color(QtGui.QPalette.PlaceholderText) != color:
            palette.setColor(QtGui.QPalette.PlaceholderText, color)
            field.setPalette(palette)


def dim_placeholder(field) -> None:
    """Shows the placeholder of a text field in the color of its text, but half transparent."""
    field.installEventFilter(_Filter(field))
