"""Hands and eyes for tests in FreeCAD's window: clicks, waits, boxes that pop up, screenshots."""

import time
from pathlib import Path

import FreeCADGui
from PySide import QtCore, QtGui


def window():
    """FreeCAD's main window."""
    return FreeCADGui.getMainWindow()


def prepare(width=1500, height=940):
    """A window that fits the screen, with room for the task panel and none for the Python console."""
    main = window()
    main.showNormal()
    main.setGeometry(0, 0, width, height)
    docks = main.findChildren(QtGui.QDockWidget)
    for dock in docks:
        if dock.objectName() in ("Python console", "Report view"):
            dock.hide()
        elif dock.objectName() == "Combo View":
            dock.show()  # FreeCAD 0.20 without settings hides it until a panel opens
    # The tree and the task panel: one dock in FreeCAD 0.20, two from 1.0 on.
    left = [dock for dock in docks if dock.objectName() in ("Combo View", "Model", "Tasks") and dock.isVisible()]
    main.resizeDocks(left, [430] * len(left), QtCore.Qt.Horizontal)
    process(0.3)


#: Seconds until something that should happen counts as missing: many, for busy machines.
PATIENCE = 300


def process(seconds=0.05):
    """Lets the window live for a while."""
    end = time.monotonic() + seconds
    while True:
        QtCore.QCoreApplication.processEvents()
        if time.monotonic() >= end:
            return
        time.sleep(0.005)


def wait_for(condition, seconds=PATIENCE, what="the condition"):
    """Lets the window live until a condition holds."""
    end = time.monotonic() + seconds
    while not condition():
        if time.monotonic() > end:
            raise AssertionError(f"{what}: not within {seconds} s")
        process(0.02)


class Heartbeat:
    """Measures, inside a `with`, the longest time in seconds during which the window did not live."""

    def __init__(self):
        self.longest, self._last = 0.0, 0.0
        self._timer = QtCore.QTimer()
        self._timer.timeout.connect(self._beat)

    def __enter__(self):
        process()
        self._last = time.monotonic()
        self._timer.start(5)
        return self

    def __exit__(self, *_):
        process(0.1)
        self._timer.stop()

    def _beat(self):
        now = time.monotonic()
        self.longest, self._last = max(self.longest, now - self._last), now


def trigger(command):
    """Triggers the action of a command, as its button and its menu entry do."""
    action = FreeCADGui.Command.get(command).getAction()[0]
    process(0.3)  # FreeCAD updates what is enabled by a timer
    action.trigger()
    process()


def find(name):
    """A widget of ours by its object name, in the task panel."""
    found = [widget for widget in window().findChildren(QtGui.QWidget, name)]
    assert len(found) == 1, f"{name}: {len(found)} widgets"
    return found[0]


def turn_wheel(widget, clicks=-1):
    """Turns the mouse wheel above a widget. Returns whether it took the event; else Qt passes it on to what scrolls."""
    at = QtCore.QPointF(widget.rect().center())
    event = QtGui.QWheelEvent(at, QtCore.QPointF(widget.mapToGlobal(at.toPoint())), QtCore.QPoint(), QtCore.QPoint(0, 120 * clicks),
                              QtCore.Qt.NoButton, QtCore.Qt.NoModifier, QtCore.Qt.NoScrollPhase, False)
    QtCore.QCoreApplication.sendEvent(widget, event)
    process()
    return event.isAccepted()


def click_at(point):
    """Clicks with the mouse on a point of the model in the 3-D view."""
    view = FreeCADGui.activeDocument().activeView()
    canvas = view.graphicsView().viewport()
    across, up = view.getPointOnScreen(point)
    ratio = canvas.devicePixelRatioF()
    click(canvas, QtCore.QPointF(across / ratio, canvas.height() - 1 - up / ratio))


def click(widget, at):
    """Clicks with the mouse on a point of a widget."""
    for kind, button, buttons in ((QtCore.QEvent.MouseMove, QtCore.Qt.NoButton, QtCore.Qt.NoButton),
                                  (QtCore.QEvent.MouseButtonPress, QtCore.Qt.LeftButton, QtCore.Qt.LeftButton),
                                  (QtCore.QEvent.MouseButtonRelease, QtCore.Qt.LeftButton, QtCore.Qt.NoButton)):
        place = QtCore.QPointF(widget.mapToGlobal(at.toPoint()))
        event = QtGui.QMouseEvent(kind, at, place, button, buttons, QtCore.Qt.NoModifier)
        QtCore.QCoreApplication.sendEvent(widget, event)
        process(0.1)


def close_panel(button=None):
    """Presses OK in the task panel (Close where there is no OK), or another button; FreeCAD 1.1 slides the panel in."""
    wanted = [button] if button is not None else [QtGui.QDialogButtonBox.Ok, QtGui.QDialogButtonBox.Close]

    def there():
        found = [box.button(kind) for box in window().findChildren(QtGui.QDialogButtonBox) for kind in wanted]
        return next((one for one in found if one is not None and one.isVisible()), None)

    wait_for(there, what="the panel's button")
    there().click()
    process(0.2)


def cancel_bars():
    """Presses Cancel of the progress bars that are shown."""
    for bar in window().findChildren(QtGui.QProgressDialog):
        bar.cancel()


class Boxes:
    """Answers the modal boxes that come up inside a `with` and keeps their texts; leaves progress bars alone.

    answer: fills in a box that is no message, and returns True where it closed the box too.
    question: answers a box with Yes and No.
    patience: seconds that a box is shown before it is answered."""

    def __init__(self, answer=None, patience=0, question=None):
        self.texts = []
        self._answer, self._question = answer, question
        self._patience = patience
        self._answering = False  # true while `answer` lets the window live
        self._shown, self._since = None, 0.0  # the box looked at last, and since when it is there
        self._timer = QtCore.QTimer()
        self._timer.timeout.connect(self._look)

    def __enter__(self):
        self._timer.start(30)
        return self

    def __exit__(self, *_):
        process(0.1)
        self._timer.stop()

    def _look(self):
        if self._answering:
            return
        box = QtGui.QApplication.activeModalWidget()
        if box is not self._shown:
            self._shown, self._since = box, time.monotonic()
        if box is None or isinstance(box, QtGui.QProgressDialog) or time.monotonic() - self._since < self._patience:
            return
        if isinstance(box, QtGui.QMessageBox):
            self.texts.append(box.text())
            if self._question is not None and box.standardButtons() & QtGui.QMessageBox.Yes:
                self._answering = True
                try:
                    self._question(box)
                finally:
                    self._answering = False
                return
            box.button(box.standardButtons() and QtGui.QMessageBox.Ok).click()
        elif self._answer is not None:
            self._answering = True
            try:
                closed = self._answer(box)
            finally:
                self._answering = False
            if not closed:
                box.accept()
        else:
            self.texts.append(f"unexpected {type(box).__name__}")
            box.reject()


def screenshot(path):
    """The whole window as a picture."""
    process(0.5)
    screen = QtGui.QGuiApplication.primaryScreen() if hasattr(QtGui, "QGuiApplication") else \
        QtGui.QApplication.primaryScreen()
    picture = screen.grabWindow(int(window().winId()))
    Path(path).parent.mkdir(parents=True, exist_ok=True)
    assert picture.save(str(path)), path
