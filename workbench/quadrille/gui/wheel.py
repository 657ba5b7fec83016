# SPDX-License-Identifier: GPL-3.0-or-later
"""Keeps the mouse wheel from changing settings, and from scrolling lists, while a panel is scrolled."""

from PySide import QtCore, QtGui


class _Filter(QtCore.QObject):
    """Passes the wheel on to what scrolls, unless the field or list has the focus."""

    def eventFilter(self, watched, event) -> bool:
        """Qt calls this before a field, or the inside of a list, gets an event."""
        if event.type() != QtCore.QEvent.Wheel:
            return False
        around = watched.parentWidget()
        if watched.hasFocus() or isinstance(around, _LISTS) and around.hasFocus():
            return False
        event.ignore()
        return True


#: What scrolls by itself.
_LISTS = (QtGui.QAbstractItemView, QtGui.QPlainTextEdit)


def calm(panel) -> None:
    """Makes the spin boxes, combo boxes, text fields and lists in a panel ignore the wheel while they do not have the focus."""
    passing = _Filter(panel)
    for kind in (QtGui.QAbstractSpinBox, QtGui.QComboBox, QtGui.QLineEdit):
        for field in panel.findChildren(kind):
            field.installEventFilter(passing)
            if field.focusPolicy() == QtCore.Qt.WheelFocus:  # the wheel would give it the focus
                field.setFocusPolicy(QtCore.Qt.StrongFocus)
    for kind in _LISTS:
        for found in panel.findChildren(kind):
            found.viewport().installEventFilter(passing)
            if found.focusPolicy() == QtCore.Qt.WheelFocus:
                found.setFocusPolicy(QtCore.Qt.StrongFocus)
