# SPDX-License-Identifier: GPL-3.0-or-later
"""A panel whose upper part scrolls while its lower part, with the buttons, stays in sight."""

from typing import Optional

from PySide import QtCore, QtGui

#: The upper part is not made lower than this; FreeCAD then scrolls the whole panel, as it does with others.
_LEAST_HEIGHT = 160


class Scrolled(QtGui.QWidget):
    """As high as FreeCAD's task view allows."""

    def __init__(self) -> None:
        super().__init__()
        self.content, self.below = QtGui.QWidget(), QtGui.QWidget()
        self._area = QtGui.QScrollArea()
        self._area.setObjectName("QuadrilleScrolled")
        self._area.setWidgetResizable(True)
        self._area.setFrameShape(QtGui.QFrame.NoFrame)
        self._area.setHorizontalScrollBarPolicy(QtCore.Qt.ScrollBarAlwaysOff)
        self._area.setWidget(self.content)
        # The colors of the panel, not those of a list.
        self._area.viewport().setAutoFillBackground(False)
        self.content.setAutoFillBackground(False)
        self._outer: Optional[QtGui.QScrollArea] = None
        self._timer = QtCore.QTimer(self)
        self._timer.setSingleShot(True)
        self._timer.setInterval(0)
        self._timer.timeout.connect(self._fit)
        self._bringing = QtCore.QTimer(self)  # ends with the panel
        self._bringing.setSingleShot(True)
        self._bringing.setInterval(0)
        self._bringing.timeout.connect(lambda: self._area.ensureWidgetVisible(self._brought, 0, 30))
        self._brought: Optional[QtGui.QWidget] = None
        layout = QtGui.QVBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.addWidget(self._area, 1)
        layout.addWidget(self.below)
        self.content.installEventFilter(self)

    def bring(self, widget) -> None:
        """Scrolls to a widget of the upper part, once it has its place."""
        self._brought = widget
        self._bringing.start()

    def showEvent(self, event) -> None:
        """Qt calls this when the panel is shown."""
        # FreeCAD 0.20 draws its task boxes light whatever the palette, and light text is not seen there.
        self.setAutoFillBackground(self.palette().color(QtGui.QPalette.WindowText).lightness() > 128)
        if self._outer is None:
            around = self.parentWidget()
            while around is not None and not isinstance(around, QtGui.QScrollArea):
                around = around.parentWidget()
            if around is not None:
                self._outer = around
                around.viewport().installEventFilter(self)
        self._timer.start()
        super().showEvent(event)

    def eventFilter(self, watched, event) -> bool:
        """Qt calls this before what is watched gets an event."""
        if event.type() in (QtCore.QEvent.Resize, QtCore.QEvent.LayoutRequest):
            if watched is self.content:
                self._area.setMinimumWidth(self._least_width())
            self._timer.start()
        return False

    def _least_width(self) -> int:
        return self.content.minimumSizeHint().width() + self._area.verticalScrollBar().sizeHint().width()

    def _fit(self) -> None:
        if self._outer is None or self._outer.widget() is None or self._outer.widget().layout() is None:
            return
        room = self._outer.viewport().height()
        others = self._outer.widget().layout().sizeHint().height() - self._area.sizeHint().expandedTo(
            self._area.minimumSize()).boundedTo(self._area.maximumSize()).height()
        height = max(_LEAST_HEIGHT, room - others)
        if height != self._area.minimumHeight() or height != self._area.maximumHeight():
            self._area.setFixedHeight(height)
