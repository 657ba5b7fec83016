# SPDX-License-Identifier: GPL-3.0-or-later
"""What is wrong with a field of a panel, in red below that field."""

from typing import Iterable, List, Optional

from PySide import QtGui

from . import translate

#: Reds that can be read on light and on dark windows.
_ON_LIGHT, _ON_DARK = "#b00020", "#ff8a80"


class FieldError(QtGui.QLabel):
    """A line of text that takes no room while there is nothing to say."""

    def __init__(self, name: str) -> None:
        """name: that of the field."""
        super().__init__()
        self.setObjectName(f"Quadrille{name}Error")
        self.setWordWrap(True)
        self.setSizePolicy(QtGui.QSizePolicy.Ignored, QtGui.QSizePolicy.Preferred)
        self.hide()

    def tell(self, text: str) -> None:
        """Shows a sentence; hides the line if it is empty."""
        if text:
            self.setStyleSheet(f"color: {self._red()}")
        if text != self.text():
            self.setText(text)
        self.setVisible(bool(text))

    def _red(self) -> str:
        around = self.parentWidget() or self
        text = around.palette().color(QtGui.QPalette.WindowText)  # a theme's style sheet sets this one too
        return _ON_DARK if text.lightness() > 128 else _ON_LIGHT


def below(field, error: FieldError):
    """A field with the line for its error below."""
    both = QtGui.QWidget()
    layout = QtGui.QVBoxLayout(both)
    layout.setContentsMargins(0, 0, 0, 0)
    layout.setSpacing(1)
    layout.addWidget(field)
    layout.addWidget(error)
    return both


def unknown_names(part, names: Iterable[str], kinds: Iterable[str]) -> Optional[str]:
    """A sentence with the names that no face or edge of a part has; None if there is none.

    Args:
        kinds: what may be named, such as "Face" and "Edge".
    """
    shape = part.Shape
    counts = {kind: shape.countElement(kind) for kind in kinds}

    def is_there(name: str) -> bool:
        kind = name.rstrip("0123456789")
        number = name[len(kind):]
        return kind in counts and number.isascii() and number[:1] not in ("", "0") and int(number) <= counts[kind]

    unknown: List[str] = [name for name in names if not is_there(name)]
    return translate("Quadrille", "{} has no {}").format(part.Label, ", ".join(unknown)) if unknown else None
