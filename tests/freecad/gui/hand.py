"""A user's hand for tests: the display's real mouse and keyboard (XTest). What is hidden, covered or scrolled away is not hit."""

import ctypes
import os

import FreeCADGui
from PySide import QtCore, QtGui

from driver import process, wait_for, window

_X = ctypes.CDLL("libX11.so.6")
_TEST = ctypes.CDLL("libXtst.so.6")
_X.XOpenDisplay.restype = ctypes.c_void_p
_X.XKeysymToKeycode.argtypes = (ctypes.c_void_p, ctypes.c_ulong)
_X.XKeysymToKeycode.restype = ctypes.c_ubyte
_X.XkbKeycodeToKeysym.argtypes = (ctypes.c_void_p, ctypes.c_ubyte, ctypes.c_int, ctypes.c_int)
_X.XkbKeycodeToKeysym.restype = ctypes.c_ulong
_X.XFlush.argtypes = (ctypes.c_void_p,)
_TEST.XTestFakeMotionEvent.argtypes = (ctypes.c_void_p, ctypes.c_int, ctypes.c_int, ctypes.c_int, ctypes.c_ulong)
_TEST.XTestFakeButtonEvent.argtypes = (ctypes.c_void_p, ctypes.c_uint, ctypes.c_int, ctypes.c_ulong)
_TEST.XTestFakeKeyEvent.argtypes = (ctypes.c_void_p, ctypes.c_uint, ctypes.c_int, ctypes.c_ulong)
_DISPLAY = _X.XOpenDisplay(os.environ["DISPLAY"].encode())
LEFT, WHEEL_UP, WHEEL_DOWN = 1, 4, 5
RETURN, TAB, SHIFT, CONTROL = 0xFF0D, 0xFF09, 0xFFE1, 0xFFE3

clicks = 0  #: how often the left button was pressed
_KEPT = []  # PySide2 declares a widget deleted when Python lets go of one above it


def seen(kind, parent=None):
    """The widgets of a kind that are in sight, in the window or a part of it."""
    parent = parent or window()
    found = parent.findChildren(kind)
    _KEPT.append((parent, found))
    return [widget for widget in found if widget.isVisible()]


def _sent(seconds=0.04):
    _X.XFlush(_DISPLAY)
    process(seconds)


def move(point):
    """Moves the pointer to a point of the screen; the second of two small steps is a movement that every widget notices."""
    ratio = window().devicePixelRatioF()
    x, y = round(point.x() * ratio), round(point.y() * ratio)
    for back in (1, 0):
        _TEST.XTestFakeMotionEvent(_DISPLAY, -1, x - back, y, 0)
        _sent()


def press(button=LEFT, times=1):
    """Clicks where the pointer is. All is sent at once, since a busy machine would make two clicks of a double-click."""
    global clicks
    clicks += times if button == LEFT else 0
    for _ in range(times):
        for down in (1, 0):
            _TEST.XTestFakeButtonEvent(_DISPLAY, button, down, 10)
    _sent(0.2)


def key(symbol, *modifiers):
    """Presses a key while others are held."""
    codes = [_X.XKeysymToKeycode(_DISPLAY, symbol) for symbol in (*modifiers, symbol)]
    if _X.XkbKeycodeToKeysym(_DISPLAY, codes[-1], 0, 0) != symbol:
        codes.insert(0, _X.XKeysymToKeycode(_DISPLAY, SHIFT))
    for down, order in ((1, codes), (0, reversed(codes))):
        for code in order:
            _TEST.XTestFakeKeyEvent(_DISPLAY, code, down, 0)
    _sent()


def type_text(text):
    """Types into what has the focus. ASCII only: for it, the key symbols are the characters."""
    for character in text:
        key(ord(character))


def under_pointer():
    """The widget under the pointer."""
    return QtGui.QApplication.widgetAt(QtGui.QCursor.pos())


def scroll_to(widget, at):
    """Turns the wheel above the scroll area around a widget until a point of it shows. Returns the point on the screen."""
    area = next((area for area in reversed(seen(QtGui.QScrollArea)) if area.isAncestorOf(widget)), None)
    for _ in range(100 if area is not None else 0):
        port = area.viewport()
        height = widget.mapTo(port, at).y()
        if 8 <= height < port.height() - 8:
            break
        before = area.verticalScrollBar().value()
        move(port.mapToGlobal(QtCore.QPoint(3, port.height() // 2)))
        press(WHEEL_UP if height < 8 else WHEEL_DOWN)
        if area.verticalScrollBar().value() == before:
            break
    return widget.mapToGlobal(at)


def click(widget, at=None, times=1):
    """Clicks on a widget that the user sees, by default on its middle; a check box on its box."""
    wait_for(widget.isVisible, 20, f"{widget.objectName()} in sight")
    if at is None:
        check = isinstance(widget, (QtGui.QCheckBox, QtGui.QRadioButton, QtGui.QGroupBox))
        at = QtCore.QPoint(10, 10 if isinstance(widget, QtGui.QGroupBox) else widget.height() // 2) if check else widget.rect().center()
    for _ in range(5):  # what has just opened may still move
        move(scroll_to(widget, at))
        there = under_pointer()
        hit = there is not None and (there is widget or widget.isAncestorOf(there))
        if hit:
            break
        process(0.3)
    assert hit, f"{widget.objectName()} {getattr(widget, 'text', str)()}: the pointer is on {there} {there and there.objectName()}"
    press(times=times)


def click_item(view, index, times=1):
    """Clicks on an item of a list or tree."""
    view.scrollTo(index)
    process(0.1)
    place = view.visualRect(index)
    assert place.isValid() and view.viewport().rect().contains(place.center()), index.data()
    click(view.viewport(), QtCore.QPoint(min(place.left() + 30, place.center().x()), place.center().y()), times)


def choose_entry(path):
    """Takes an entry of a menu, such as 'Mesh > Quad mesh from shape'. False where FreeCAD has none."""
    menu = window().menuBar()
    for word in path.split(" > "):
        _KEPT.append((menu, menu.actions()))
        found = next((action for action in _KEPT[-1][1] if action.isVisible()
                      and action.text().replace("&", "").rstrip(".…") == word), None)
        if found is None:
            _close_menus()
            return False
        wait_for(found.isEnabled, 20, word)
        click(menu, menu.actionGeometry(found).center())
        menu = found.menu()
        if menu is not None:
            wait_for(menu.isVisible, 20, word)
    process(0.5)
    return True


def press_tool(text):
    """Presses the button of a toolbar by the text of its command."""
    def found():
        return [button for bar in seen(QtGui.QToolBar) for button in seen(QtGui.QToolButton, bar)
                if button.defaultAction() is not None and button.defaultAction().text().replace("&", "").rstrip(".…") == text]
    assert len(found()) == 1, f"{text}: {len(found())} buttons"
    wait_for(lambda: found()[0].isEnabled(), 20, text)
    click(found()[0])
    process(0.5)


def _close_menus():
    while QtGui.QApplication.activePopupWidget() is not None:
        key(0xFF1B)  # escape


def use_fem():
    """Switches to the FEM workbench in FreeCAD's list of workbenches."""
    choose_in(next(box for box in seen(QtGui.QComboBox) if box.findText("FEM") >= 0), "FEM")
    wait_for(lambda: FreeCADGui.activeWorkbench().name() == "FemWorkbench", what="the workbench")


def choose_in(box, text):
    """Takes an item of a combo box."""
    click(box)
    view = box.view()
    wait_for(view.isVisible, 20, "the list")
    click_item(view, view.model().index(box.findText(text), box.modelColumn(), view.rootIndex()))
    process(0.3)


def write(field, text, leave=TAB):
    """Clicks into a field, replaces what stands there, and leaves it with a key."""
    line = field if isinstance(field, QtGui.QLineEdit) else field.findChild(QtGui.QLineEdit)
    click(line)
    key(ord("a"), CONTROL)
    type_text(text)
    key(leave)
    process(0.2)


def click_in_tree(tree, text, times=1, match=QtCore.Qt.MatchExactly):
    """Clicks on an item of a tree by its text, after a click on the arrows of the branches that are closed above it."""
    model = tree.model()
    found = model.match(model.index(0, 0), QtCore.Qt.DisplayRole, text, 1, match | QtCore.Qt.MatchRecursive)
    assert found, text
    branches, branch = [], found[0].parent()
    while branch.isValid():
        branches.insert(0, branch)
        branch = branch.parent()
    for branch in branches:
        if not tree.isExpanded(branch):
            tree.scrollTo(branch)
            place = tree.visualRect(branch)
            click(tree.viewport(), QtCore.QPoint(place.left() - tree.indentation() // 2, place.center().y()))
            assert tree.isExpanded(branch), branch.data()
    click_item(tree, found[0], times)


def click_object(obj, times=1):
    """Clicks on an object in FreeCAD's tree; twice opens its panel."""
    tree = next(tree for tree in seen(QtGui.QTreeWidget) if tree.metaObject().className() == "Gui::TreeWidget")
    click_in_tree(tree, obj.Label, times)
    process(0.5)


def move_to(point):
    """Moves the pointer to a point of the model in the 3-D view. False where that is out of view."""
    view = FreeCADGui.activeDocument().activeView()
    canvas = view.graphicsView().viewport()
    across, up = view.getPointOnScreen(point)
    ratio = canvas.devicePixelRatioF()
    at = QtCore.QPoint(round(across / ratio), round(canvas.height() - 1 - up / ratio))
    if not canvas.rect().contains(at):
        return False
    move(canvas.mapToGlobal(at))
    return True


def highlighted(point):
    """The names of the object and of its element that FreeCAD highlights when the pointer is on a point of the model."""
    if not move_to(point):
        return "", ""
    process(0.1)
    under = FreeCADGui.Selection.getPreselection()
    return under.ObjectName, "".join(under.SubElementNames)


def click_model(point):
    """Clicks on a point of the model in the 3-D view."""
    assert move_to(point), f"{point} is out of view"
    press()
