# SPDX-License-Identifier: GPL-3.0-or-later
"""The tables of panels: as high as their rows, and with no cell cut in a narrow panel."""

from typing import Sequence

from PySide import QtCore, QtGui

#: The height of a table without a limit.
_ANY_HEIGHT = 10 ** 6


def table(name: str, columns: int, wide: int = 0, most: int = _ANY_HEIGHT):
    """A table without rows. name: its object name. wide: the column whose texts wrap. most: its height at most; it scrolls then."""
    made = QtGui.QTableWidget(0, columns)
    made.setObjectName(name)
    made.setProperty("most", most)
    font = made.font()
    if font.pointSizeF() > 0:
        font.setPointSizeF(0.9 * font.pointSizeF())
        made.setFont(font)
        made.horizontalHeader().setFont(font)
    made.verticalHeader().setVisible(False)
    made.horizontalHeader().setSectionResizeMode(QtGui.QHeaderView.ResizeToContents)
    made.horizontalHeader().setMinimumSectionSize(16)
    made.horizontalHeader().setSectionResizeMode(wide, QtGui.QHeaderView.Stretch)  # words wrap, names and numbers do not
    made.verticalHeader().setMinimumSectionSize(20)
    made.verticalHeader().setSectionResizeMode(QtGui.QHeaderView.ResizeToContents)
    made.verticalHeader().sectionResized.connect(lambda *_: _fit(made))
    made.setEditTriggers(QtGui.QAbstractItemView.NoEditTriggers)
    made.setSizePolicy(QtGui.QSizePolicy.Ignored, QtGui.QSizePolicy.Fixed)
    made.setHorizontalScrollBarPolicy(QtCore.Qt.ScrollBarAlwaysOff)
    made.setVerticalScrollBarPolicy(QtCore.Qt.ScrollBarAlwaysOff if most == _ANY_HEIGHT else QtCore.Qt.ScrollBarAsNeeded)
    return made


def fill(table, rows: Sequence[Sequence[str]]) -> None:
    """Shows these rows and no others."""
    across, down = table.horizontalHeader(), table.verticalHeader()
    modes = [across.sectionResizeMode(column) for column in range(table.columnCount())]
    for head in (across, down):  # else a table in sight measures all rows anew for each cell
        head.setSectionResizeMode(QtGui.QHeaderView.Fixed)
    table.setRowCount(len(rows))
    for row, texts in enumerate(rows):
        for column, text in enumerate(texts):
            table.setItem(row, column, QtGui.QTableWidgetItem(text))
    for column, mode in enumerate(modes):
        across.setSectionResizeMode(column, mode)
    down.setSectionResizeMode(QtGui.QHeaderView.ResizeToContents)
    _fit(table)


def _fit(table) -> None:
    """Makes the table as high as its rows."""
    head = table.horizontalHeader().sizeHint().height() if table.horizontalHeader().isVisibleTo(table) else 0
    table.setFixedHeight(min(table.property("most"), table.verticalHeader().length() + head + 4))
