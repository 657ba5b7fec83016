# SPDX-License-Identifier: GPL-3.0-or-later
"""Keeps the mouse wheel from changing settings while a panel is scrolled."""

from PySide import QtCore, QtGui


class _Filter(QtCore.QObject):
    """Passes the wheel on to what scrolls, unless the field has the focus."""

    def eventFilter(self, field, event) -> bool:
        """Qt calls this before a field gets an event."""
        if event.type() == QtCore.QEvent.Wheel and not field.hasFocus():
            event.ignore()
            return True
        return False


def calm(panel) -> None:
    """Makes the spin boxes, combo boxes and text fields in a panel ignore the wheel while they do not have the focus."""
    passing = _Filter(panel)
    for kind in (QtGui.QAbstractSpinBox, QtGui.QComboBox, QtGui.QLineEdit):
        for field in panel.findChildren(kind):
            field.installEventFilter(passing)
            if field.focusPolicy() == QtCore.Qt.WheelFocus:  # the wheel would give it the focus
                field.setFocusPolicy(QtCore.Qt.StrongFocus)
