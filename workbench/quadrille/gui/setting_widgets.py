# SPDX-License-Identifier: GPL-3.0-or-later
"""One widget a setting of the panel, made from the table of settings. It shows and gives the value of a mesh object's
property of that name."""

from typing import Any, Callable, Dict

import FreeCADGui
from PySide import QtGui

from ..settings import SETTINGS, property_help, property_kind

_MAX_DEAD_WRAPPERS = 16


class SettingWidget:
    """A widget for one setting of a mesh object."""

    def __init__(self, setting: Dict[str, Any], mesh) -> None:
        self.property, self.label = setting["property"], setting["label"]
        self._kind = property_kind(setting)
        self.widget = self._make(setting, mesh)
        if self._kind != "App::PropertyLength":  # which has it already
            self.widget.setObjectName(f"Quadrille{self.property}")
        self.widget.setToolTip(property_help(setting))

    def _make(self, setting: Dict[str, Any], mesh):
        if self._kind == "App::PropertyLength":
            return _length_box(f"Quadrille{self.property}")
        if self._kind == "App::PropertyEnumeration":
            box = QtGui.QComboBox()
            box.addItems(mesh.getEnumerationsOfProperty(self.property))
            return box
        if self._kind == "App::PropertyBool":
            return QtGui.QCheckBox()
        if self._kind == "App::PropertyStringList":
            line = QtGui.QLineEdit()
            line.setPlaceholderText(setting["otherwise"])
            return line
        box = QtGui.QDoubleSpinBox()
        whole = setting["default"] is None or float(setting["default"]).is_integer()
        box.setDecimals(0 if whole else 2)
        box.setSingleStep(1 if whole else 0.1)
        box.setRange(0.01 if setting["above_low"] and setting["default"] is not None else setting["low"],
                     min(setting["high"] or 1e6, 1e6))
        return box

    def value(self) -> Any:
        """The value, as the property has it."""
        if self._kind == "App::PropertyLength":
            return float(self.widget.property("rawValue"))
        if self._kind == "App::PropertyEnumeration":
            return self.widget.currentText()
        if self._kind == "App::PropertyBool":
            return self.widget.isChecked()
        if self._kind == "App::PropertyStringList":
            return [name.strip() for name in self.widget.text().split(",") if name.strip()]
        return self.widget.value()

    def show(self, value: Any) -> None:
        """Shows a property's value."""
        value = getattr(value, "Value", value)
        if self._kind == "App::PropertyLength":
            self.widget.setProperty("rawValue", value)
        elif self._kind == "App::PropertyEnumeration":
            self.widget.setCurrentText(value)
        elif self._kind == "App::PropertyBool":
            self.widget.setChecked(value)
        elif self._kind == "App::PropertyStringList":
            self.widget.setText(", ".join(value))
        else:
            self.widget.setValue(value)

    def when_changed(self, call: Callable[[], None]) -> None:
        """Calls that whenever the user changes the value."""
        for signal in ("valueChanged", "currentIndexChanged", "stateChanged", "textChanged"):
            if hasattr(self.widget, signal):
                getattr(self.widget, signal).connect(lambda *_: call())
                return


def setting_widgets(mesh) -> Dict[str, SettingWidget]:
    """The widgets of the panel by the names of their properties, in the order of the table."""
    return {setting["property"]: SettingWidget(setting, mesh) for setting in SETTINGS if setting["label"]}


def _length_box(name: str):
    # FreeCAD may make the widget at the address of one that is gone, and PySide then gives that one's dead wrapper:
    # another widget has another address.
    loader = FreeCADGui.UiLoader()
    for attempt in range(_MAX_DEAD_WRAPPERS + 1):
        box = loader.createWidget("Gui::QuantitySpinBox")
        try:
            box.setObjectName(name)
            break
        except RuntimeError:
            if attempt == _MAX_DEAD_WRAPPERS:
                raise
    box.setProperty("unit", "mm")
    box.setProperty("minimum", 0.0)
    return box
