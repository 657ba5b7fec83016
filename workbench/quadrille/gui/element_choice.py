# SPDX-License-Identifier: GPL-3.0-or-later
"""The panel's field for the type of the elements in CalculiX's input. What a type's letters and numbers mean stands below it."""

from PySide import QtGui

from ..solvers import element_types
from . import QT_TRANSLATE_NOOP, translate

#: What elements are for, by the letters that their types begin with.
_KINDS = {
    "CPS": QT_TRANSLATE_NOOP("Quadrille", "plane stress"),
    "CPE": QT_TRANSLATE_NOOP("Quadrille", "plane strain"),
    "CAX": QT_TRANSLATE_NOOP("Quadrille", "rotational symmetry"),
    "M3D": QT_TRANSLATE_NOOP("Quadrille", "membrane"),
    "S": QT_TRANSLATE_NOOP("Quadrille", "shell"),
}
_NODES = {"4": QT_TRANSLATE_NOOP("Quadrille", "four nodes"), "8": QT_TRANSLATE_NOOP("Quadrille", "eight nodes")}
_REDUCED, _FULL = QT_TRANSLATE_NOOP("Quadrille", "reduced integration"), QT_TRANSLATE_NOOP("Quadrille", "full integration")
_SHELL = QT_TRANSLATE_NOOP("Quadrille", "S4 at first order; S8R, with reduced integration, at second")


def kind_of(element: str) -> str:
    """What elements of a type are for, in words."""
    return next(translate("Quadrille", text) for letters, text in _KINDS.items() if element.upper().startswith(letters))


def _short(element: str) -> str:
    return kind_of(element) if element == element_types.SHELL else element


def words_of(element: str) -> str:
    """An element type in words: plane stress, eight nodes, reduced integration."""
    if element == element_types.SHELL:
        return translate("Quadrille", _SHELL)
    return ", ".join((kind_of(element), translate("Quadrille", _NODES[element.rstrip("R")[-1]]),
                      translate("Quadrille", _REDUCED if element.endswith("R") else _FULL)))


class _Box(QtGui.QComboBox):
    """Lists the types with words, and shows only the type when closed, so that a narrow panel cuts nothing."""

    def __init__(self) -> None:
        super().__init__()
        for element in (element_types.SHELL, *element_types.OTHERS):
            self.addItem(f"{_short(element)}: {words_of(element)}", element)
        self.view().setMinimumWidth(self.view().sizeHintForColumn(0) + self.view().verticalScrollBar().sizeHint().width())

    def paintEvent(self, _event) -> None:
        """Qt calls this to draw the closed list."""
        option = QtGui.QStyleOptionComboBox()
        self.initStyleOption(option)
        option.currentText = _short(self.itemData(self.currentIndex()))
        painter = QtGui.QStylePainter(self)
        painter.drawComplexControl(QtGui.QStyle.CC_ComboBox, option)
        painter.drawControl(QtGui.QStyle.CE_ComboBoxLabel, option)


class ElementChoice(QtGui.QWidget):
    """A list of the types, and the present one in words."""

    def __init__(self) -> None:
        super().__init__()
        self.box = _Box()
        self.box.setObjectName("QuadrilleElementType")
        self.box.setSizePolicy(QtGui.QSizePolicy.Ignored, QtGui.QSizePolicy.Fixed)
        self.box.setMinimumWidth(70)
        self.box.setToolTip(translate(
            "Quadrille", "Type of the elements for CalculiX; those for planes and rotational symmetry need a part in the plane z = 0"))
        self.text = QtGui.QLabel()
        self.text.setObjectName("QuadrilleElementWords")
        self.text.setWordWrap(True)
        layout = QtGui.QVBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.setSpacing(1)
        layout.addWidget(self.box)
        layout.addWidget(self.text)
        self.box.currentIndexChanged.connect(lambda *_: self.text.setText(words_of(self.element())))
        self.text.setText(words_of(self.element()))

    def element(self) -> str:
        """The type that is shown."""
        return self.box.itemData(self.box.currentIndex())

    def show_element(self, element: str) -> None:
        """Shows a type."""
        self.box.setCurrentIndex(self.box.findData(element))
