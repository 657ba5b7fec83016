# SPDX-License-Identifier: GPL-3.0-or-later
"""The panel's widgets, one for each setting, made from the table of settings. A widget shows and returns the value of a mesh
object's property. A value that the user has not changed is returned exactly, even if it was rounded for display."""

from typing import Any, Callable, Dict, Tuple

from PySide import QtGui

from ..core.errors import Error
from ..core.setting_table import SETTINGS, property_help, property_kind, words
from . import translate
from .field_errors import FieldError
from .length_field import LengthField
from .placeholders import dim_placeholder


class SettingWidget:
    """A widget for one setting of a mesh object."""

    def __init__(self, setting: Dict[str, Any]) -> None:
        self.property = setting["property"]
        self.label = translate("QuadrilleSettings", setting["label"]) if setting["label"] else ""
        self._kind = property_kind(setting)
        self.widget = self._make(setting)
        self.widget.setObjectName(f"Quadrille{self.property}")
        self.widget.setToolTip(translate("QuadrilleSettings", property_help(setting)))
        self.error = FieldError(self.property)
        self._shown: Tuple[Any, Any] = (None, None)  # the value, and what the widget returned for it right after showing it

    def _make(self, setting: Dict[str, Any]):
        if self._kind == "App::PropertyLength":
            return LengthField(otherwise=translate("QuadrilleSettings", setting["otherwise"]))
        if self._kind == "App::PropertyEnumeration":
            box = QtGui.QComboBox()
            for word in words(setting):
                box.addItem(translate("QuadrilleSettings", word), word)
            return box
        if self._kind == "App::PropertyBool":
            return QtGui.QCheckBox()
        # Entries contain commas themselves.
        self._between = ";" if setting["kind"] == "entries" else ","
        if self._kind in ("App::PropertyStringList", "App::PropertyString", "App::PropertyFile"):
            line = QtGui.QLineEdit()
            line.setPlaceholderText(translate("QuadrilleSettings", setting["otherwise"]))
            dim_placeholder(line)
            return line
        box = QtGui.QDoubleSpinBox()
        whole = setting["default"] is None or float(setting["default"]).is_integer()
        box.setDecimals(0 if whole else 2)
        box.setSingleStep(1 if whole else 0.1)
        box.setRange(0.01 if setting["above_low"] and setting["default"] is not None else setting["low"],
                     min(setting["high"] or 1e6, 1e6))
        return box

    def value(self) -> Any:
        """The value in the property's form (names for links). Raises Error if it cannot be read."""
        try:
            raw = self._raw()
        except Error as error:
            raise Error(str(error), error.kind, self.property) from None
        if raw == self._shown[1]:
            return self._shown[0]
        return int(raw) if self._kind == "App::PropertyInteger" else raw

    def _raw(self) -> Any:
        if self._kind == "App::PropertyLength":
            return self.widget.length(self.label)
        if self._kind == "App::PropertyEnumeration":
            return self.widget.itemData(self.widget.currentIndex())
        if self._kind == "App::PropertyBool":
            return self.widget.isChecked()
        if self._kind == "App::PropertyStringList":
            return [name.strip() for name in self.widget.text().split(self._between) if name.strip()]
        if self._kind in ("App::PropertyString", "App::PropertyFile"):
            return self.widget.text().strip()
        return self.widget.value()

    def show(self, value: Any) -> None:
        """Shows a property's value."""
        value = getattr(value, "Value", value)
        if self._kind == "App::PropertyLength":
            self.widget.show_length(value)
        elif self._kind == "App::PropertyEnumeration":
            self.widget.setCurrentIndex(self.widget.findData(value))
        elif self._kind == "App::PropertyBool":
            self.widget.setChecked(value)
        elif self._kind == "App::PropertyStringList":
            self.widget.setText(f"{self._between} ".join(value))
        elif self._kind in ("App::PropertyString", "App::PropertyFile"):
            self.widget.setText(value)
        else:
            self.widget.setValue(value)
        self._shown = (value, self._raw())

    def when_changed(self, call: Callable[[], None]) -> None:
        """Calls `call` whenever the value changes."""
        for signal in ("valueChanged", "currentIndexChanged", "stateChanged", "textChanged"):
            if hasattr(self.widget, signal):
                getattr(self.widget, signal).connect(lambda *_: call())
                return


def setting_widgets() -> Dict[str, SettingWidget]:
    """The widgets of all settings that have a label, by property, in the order of the table."""
    return {setting["property"]: SettingWidget(setting) for setting in SETTINGS if setting["label"]}
