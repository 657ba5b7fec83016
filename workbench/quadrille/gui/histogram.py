# SPDX-License-Identifier: GPL-3.0-or-later
"""A histogram of the quality q of elements. Qt draws it: it is there at once and has the colors of the window's theme."""

from typing import Optional

import numpy as np
from PySide import QtCore, QtGui

from ..core import quality
from . import translate

_HEIGHT = 130
#: Room between the bars and the edge of the widget, besides that for the numbers.
_MARGIN = 4


class Histogram(QtGui.QWidget):
    """Bars over q from 0 to 1. Their heights are logarithmic, so that a few bad elements among many good ones are seen."""

    def __init__(self, like) -> None:
        """like: a table whose ground the bars have: a theme's style sheet may not give other widgets one."""
        super().__init__()
        self.setObjectName("QuadrilleHistogram")
        self.setMinimumSize(100, _HEIGHT)
        self.setSizePolicy(QtGui.QSizePolicy.Ignored, QtGui.QSizePolicy.Fixed)
        self._like = like
        self._counts: Optional[np.ndarray] = None

    def show_values(self, values: np.ndarray, bins: int) -> None:
        """Shows how many values lie in each of equal intervals from 0 to 1."""
        self._counts = np.histogram(values, bins=bins, range=(0.0, 1.0))[0]
        self.update()

    def paintEvent(self, _event) -> None:
        """Qt calls this to draw the widget."""
        if self._counts is None:
            return
        painter = QtGui.QPainter(self)
        font = painter.font()
        font.setPointSizeF(0.85 * font.pointSizeF() if font.pointSizeF() > 0 else 8)
        painter.setFont(font)
        most = max(1, int(self._counts.max()))
        marks = [1, *(10**power for power in range(1, 12) if 10**power <= most)]
        line = painter.fontMetrics().height()
        left = _MARGIN + line + max(painter.fontMetrics().boundingRect(str(mark)).width() for mark in marks) + 6
        area = QtCore.QRectF(left, _MARGIN + line / 2, self.width() - left - 3 * _MARGIN, self.height() - 2 * _MARGIN - 2.5 * line)
        self._draw_axes(painter, area, marks, most, line)
        edges = np.linspace(area.left(), area.right(), len(self._counts) + 1)
        middles = (np.arange(len(self._counts)) + 0.5) / len(self._counts)
        painter.setPen(self.palette().color(QtGui.QPalette.Mid))
        for x, wide, count, (red, green, blue) in zip(edges, np.diff(edges), self._counts, quality.colors(middles)):
            height = area.height() * _level(int(count), most)
            painter.setBrush(QtGui.QColor.fromRgbF(float(red), float(green), float(blue)))
            if count:
                painter.drawRect(QtCore.QRectF(float(x), area.bottom() - height, float(wide), height))
        painter.end()

    def _draw_axes(self, painter, area, marks, most: int, line: int) -> None:
        painter.fillRect(area, self._like.palette().color(QtGui.QPalette.Base))
        painter.setPen(self.palette().color(QtGui.QPalette.WindowText))
        painter.drawRect(area)
        for mark in marks:
            y = area.bottom() - area.height() * _level(mark, most)
            painter.drawLine(QtCore.QPointF(area.left() - 3, y), QtCore.QPointF(area.left(), y))
            painter.drawText(QtCore.QRectF(0, y - line / 2, area.left() - 5, line), QtCore.Qt.AlignRight | QtCore.Qt.AlignVCenter,
                             str(mark))
        for number in range(6):
            x = area.left() + area.width() * number / 5
            painter.drawLine(QtCore.QPointF(x, area.bottom()), QtCore.QPointF(x, area.bottom() + 3))
            painter.drawText(QtCore.QRectF(x - 20, area.bottom() + 3, 40, line), QtCore.Qt.AlignHCenter, f"{number / 5:g}")
        painter.drawText(QtCore.QRectF(area.left(), area.bottom() + 3 + line, area.width(), line), QtCore.Qt.AlignHCenter, "q")
        painter.save()
        painter.translate(_MARGIN, area.bottom())
        painter.rotate(-90)
        painter.drawText(QtCore.QRectF(0, 0, area.height(), line), QtCore.Qt.AlignHCenter, translate("Quadrille", "Quads"))
        painter.restore()


def _level(count: int, most: int) -> float:
    """The height of a bar, of 1 at most: 0 for no element; one element and ten give different heights."""
    return float(np.log10(1 + count) / np.log10(1 + most))
