# SPDX-License-Identifier: GPL-3.0-or-later
"""Quadrille's preferences in FreeCAD, and the page that edits them: the command, defaults of new meshes, and appearance."""

import json
from typing import Any, Dict

import FreeCAD
import FreeCADGui
from PySide import QtGui

from ..core.command import check_version, find_command
from ..core.errors import Error
from ..core.jobs import PREFERENCES
from ..core.setting_table import BY_NAME, from_property, to_property
from . import ICONS, drawn_icon, translate
from .mesher_choice import MesherChoice
from .setting_widgets import SettingWidget

#: The settings that new meshes take from the preferences.
_DEFAULTS = ("order", "elements_per_circle", "growth", "strategy", "threads")
_SUGGESTED = ("Elements", 5000)
_LINE_WIDTH = ("LineWidth", 2.0)
_COLOR = ("ColorAfterMeshing", False)


def _group():
    return FreeCAD.ParamGet(PREFERENCES)


def suggested_quads() -> int:
    """The wanted number of elements in a new mesh."""
    return max(1, _group().GetInt(*_SUGGESTED))


def line_width() -> float:
    """The width of mesh lines, in pixels."""
    return _group().GetFloat(*_LINE_WIDTH)


def color_after_meshing() -> bool:
    """Whether a mesh is colored by quality as soon as it is made."""
    return _group().GetBool(*_COLOR)


def defaults() -> Dict[str, Any]:
    """The settings stored as defaults for new meshes, by property. They replace the table's defaults."""
    found = {}
    for name in _DEFAULTS:
        prop = BY_NAME[name]["property"]
        text = _group().GetString(f"Default{prop}", "")
        if text:
            found[prop] = json.loads(text)
    return found


def settings() -> Dict[str, Any]:
    """The defaults of new meshes that differ from the table's, by the names that scripts use."""
    values = {name: from_property(BY_NAME[name], defaults().get(BY_NAME[name]["property"], to_property(BY_NAME[name], None)))
              for name in _DEFAULTS}
    usual = {name: from_property(BY_NAME[name], to_property(BY_NAME[name], None)) for name in _DEFAULTS}
    return {name: value for name, value in values.items() if value != usual[name]}


class PreferencesPage:
    """The preferences page. FreeCAD makes a new one whenever its dialog opens."""

    def __init__(self, _parent=None) -> None:
        self.form = QtGui.QWidget()
        self.form.setWindowTitle(translate("Quadrille", "General"))
        self.form.setWindowIcon(drawn_icon("quadrille"))
        layout = QtGui.QVBoxLayout(self.form)
        layout.addWidget(self._mesher())
        layout.addWidget(self._new_meshes())
        layout.addWidget(self._look())
        layout.addStretch()

    def _mesher(self):
        box = QtGui.QGroupBox(translate("Quadrille", "Mesher"))
        self.command = QtGui.QLineEdit()
        self.command.setObjectName("QuadrillePrefCommand")
        self.command.setPlaceholderText(translate("Quadrille", "found automatically"))
        self.command.setToolTip(translate("Quadrille", "Path of the quadrille command if it is not on PATH"))
        browse = QtGui.QPushButton("...")
        browse.clicked.connect(self._browse)
        self.found = QtGui.QLabel()
        self.found.setObjectName("QuadrillePrefFound")
        self.found.setWordWrap(True)
        self.command.textChanged.connect(self._try)
        row = QtGui.QHBoxLayout()
        row.addWidget(self.command)
        row.addWidget(browse)
        form = QtGui.QFormLayout(box)
        form.addRow(translate("Quadrille", "Command"), row)
        form.addRow(self.found)
        self.choice = MesherChoice(self.command.setText)
        form.addRow(self.choice)
        return box

    def _new_meshes(self):
        box = QtGui.QGroupBox(translate("Quadrille", "Settings of new meshes"))
        form = QtGui.QFormLayout(box)
        self.suggested = QtGui.QSpinBox()
        self.suggested.setObjectName("QuadrillePrefElements")
        self.suggested.setRange(1, 10000000)
        self.suggested.setSingleStep(1000)
        form.addRow(translate("Quadrille", "Elements, about"), self.suggested)
        self.settings = {}
        for name in _DEFAULTS:
            widget = SettingWidget(BY_NAME[name])
            widget.widget.setObjectName(f"QuadrillePref{widget.property}")
            form.addRow(widget.label or translate("Quadrille", "Threads"), widget.widget)
            self.settings[name] = widget
        return box

    def _look(self):
        box = QtGui.QGroupBox(translate("Quadrille", "Look"))
        form = QtGui.QFormLayout(box)
        self.line_width = QtGui.QDoubleSpinBox()
        self.line_width.setObjectName("QuadrillePrefLineWidth")
        self.line_width.setRange(1, 10)
        self.color = QtGui.QCheckBox(translate("Quadrille", "Color a mesh by quality when it is made"))
        self.color.setObjectName("QuadrillePrefColor")
        form.addRow(translate("Quadrille", "Width of lines"), self.line_width)
        form.addRow(self.color)
        return box

    def _browse(self) -> None:
        path, _ = QtGui.QFileDialog.getOpenFileName(self.form, translate("Quadrille", "The quadrille command"))
        if path:
            self.command.setText(path)

    def _try(self, *_) -> None:
        """Shows which command would be used, or why none can be."""
        try:
            path = find_command(None, self.command.text().strip() or None)
            check_version(path)
            self.found.setText(translate("Quadrille", "uses {}").format(path))
        except Error as error:
            self.found.setText(str(error))

    def loadSettings(self) -> None:
        """FreeCAD calls this when the dialog opens."""
        self.command.setText(_group().GetString("Command", ""))
        self._try()
        self.suggested.setValue(suggested_quads())
        self.line_width.setValue(line_width())
        self.color.setChecked(color_after_meshing())
        stored = defaults()
        for name, widget in self.settings.items():
            widget.show(stored.get(widget.property, to_property(BY_NAME[name], None)))

    def saveSettings(self) -> None:
        """FreeCAD calls this on OK and Apply."""
        _group().SetString("Command", self.command.text().strip())
        _group().SetInt(_SUGGESTED[0], self.suggested.value())
        _group().SetFloat(_LINE_WIDTH[0], self.line_width.value())
        _group().SetBool(_COLOR[0], self.color.isChecked())
        for widget in self.settings.values():
            _group().SetString(f"Default{widget.property}", json.dumps(widget.value()))


def add_page() -> None:
    """Adds the page to FreeCAD's preferences."""
    FreeCADGui.addIconPath(str(ICONS))
    FreeCADGui.addPreferencePage(PreferencesPage, "Quadrille")
