# SPDX-License-Identifier: GPL-3.0-or-later
"""The mesher's table of settings. The command's options, and the properties and panel of mesh objects, are made from it.
settings.json holds the output of `quadrille settings --json`, tables.json that of `quadrille settings --tables`; a test
compares them.

Independent of FreeCAD; needs only the standard library.
"""

import json
import operator
import re
from pathlib import Path
from typing import Any, Callable, Dict, List, Optional, SupportsIndex, Union

#: One dict per setting, with the keys name, option, property, label, kind, use, unit, default, low, high, above_low,
#: choices, otherwise, help.
SETTINGS: List[Dict[str, Any]] = json.loads((Path(__file__).parent.parent / "settings.json").read_text(encoding="utf-8"))
#: The mesher's mesh formats (ending, name, read, written, for_solvers, quad_nodes) and quality criteria (name, unit, ideal,
#: limit), under the keys "formats" and "criteria".
TABLES: Dict[str, List[Dict[str, Any]]] = json.loads(
    (Path(__file__).parent.parent / "tables.json").read_text(encoding="utf-8"))
BY_NAME = {setting["name"]: setting for setting in SETTINGS}

#: Settings that do not change the mesh.
_WITHOUT_EFFECT_ON_THE_MESH = frozenset(("threads", "time_limit", "read_time_limit", *(
    setting["name"] for setting in SETTINGS if setting["use"] == "write")))
#: FreeCAD's own words for the order of elements.
ORDERS = ("1st", "2nd")


class MeshSettings(Dict[str, Any]):
    """What to mesh, and how: values by the names of the table. A setting that is missing or None has the command's default."""

    def __init__(self, **values: Any) -> None:
        unknown = sorted(set(values) - set(BY_NAME))
        if unknown:
            raise TypeError(f"there is no setting '{unknown[0]}' (see quadrille.core.setting_table.SETTINGS)")
        super().__init__({name: value for name, value in values.items() if value is not None})

    def arguments(self) -> List[str]:
        """The settings as arguments of `quadrille mesh`."""
        arguments: List[str] = []
        for setting in SETTINGS:
            value = self.get(setting["name"])
            if value is None or (setting["kind"] in ("names", "sizes", "entries") and len(value) == 0) or (
                    setting["kind"] in ("flag", "file", "text") and not value):
                continue
            if setting["kind"] == "entries":
                for entry in entry_texts(value):
                    arguments += [setting["option"], entry]
                continue
            arguments.append(setting["option"])
            if setting["kind"] != "flag":
                arguments.append(_text(setting["kind"], value))
        return arguments

    def of_the_mesh(self) -> Dict[str, Any]:
        """The settings that a mesh depends on."""
        return {name: value for name, value in self.items() if name not in _WITHOUT_EFFECT_ON_THE_MESH}


def default_size(diagonal: float) -> float:
    """The element size where none is given, for a model whose bounding box has this diagonal, mm."""
    return diagonal / BY_NAME["elements_per_diagonal"]["default"]


def face_name(face: Union[int, str, SupportsIndex]) -> str:
    """The name "Face3" of a face that is given as 3 (Python's or NumPy's integer) or as "Face3"."""
    return face if isinstance(face, str) else f"Face{operator.index(face)}"


def entry_texts(value: Any) -> List[str]:
    """Entries as texts for the command. They are given as texts or sequences of numbers, or as a dict that maps names to
    one or more numbers."""
    if isinstance(value, dict):
        return [f"{name}={_joined(own)}" for name, own in value.items()]
    return [_joined(entry) for entry in value]


def _joined(entry: Any) -> str:
    """One number or text, or several numbers, as the command takes them."""
    if isinstance(entry, str) or not hasattr(entry, "__iter__"):
        return str(entry)
    return ",".join(str(float(number)) if isinstance(number, float) else str(number) for number in entry)


def _text(kind: str, value: Any) -> str:
    if kind == "names":
        return ",".join(face_name(face) for face in value)
    if kind == "words":
        return ",".join(value)
    if kind == "sizes":
        return ",".join(f"{name}={float(size)!r}" for name, size in value.items())
    return repr(float(value)) if isinstance(value, float) else str(value)


#: What FreeCAD calls the command's options that are not in the table, or that the panel offers in another way.
_WORDS_ELSEWHERE = {
    "--size-on": '"Refinements"',
    "--elements-per-diagonal": '"Size"',
    "--feature-angle": "the property FeatureAngle",
    "--merge": "the property MergeDistance",
    "--join": "the property Join",
    "--report": "the table of Mesh quality",
}
_OPTION = re.compile(r"(?<![\w-])--[a-z]+(?:-[a-z]+)*")


def words_for(option: str, translate: Callable[[str], str] = str) -> Optional[str]:
    """What FreeCAD calls an option: the panel's label in quotes, or the property that the panel does not show, or the argument
    of mesh_object(). None if it is not an option for meshing."""
    if option in _WORDS_ELSEWHERE:
        return _WORDS_ELSEWHERE[option]
    for setting in SETTINGS:
        if setting["option"] == option:
            if setting["label"]:
                return f'"{translate(setting["label"])}"'
            return f"the property {setting['property']}" if setting["property"] else f"the argument {setting['name']}"
    return None


def in_words_of_panel(sentence: str, translate: Callable[[str], str] = str) -> str:
    """A sentence of the command in FreeCAD's words: `--size-min` becomes "Minimum"."""
    return _OPTION.sub(lambda found: words_for(found.group(), translate) or found.group(), sentence)


def subject_of(sentence: str) -> str:
    """The property of the setting that a sentence of the command begins with; "Refinements" for sizes on faces, edges and
    vertices; empty if it begins with no setting."""
    found = _OPTION.match(sentence)
    if found is None:
        return ""
    if found.group() == BY_NAME["sizes"]["option"]:
        return "Refinements"
    return next((setting["property"] for setting in SETTINGS if setting["option"] == found.group()), "")


# Properties of mesh objects


def property_kind(setting: Dict[str, Any]) -> str:
    """FreeCAD's type of property for a setting."""
    if setting["kind"] == "number":
        return "App::PropertyLength" if setting["unit"] == "mm" else "App::PropertyFloat"
    if setting["name"] == "order":
        return "App::PropertyEnumeration"
    return {"count": "App::PropertyInteger", "flag": "App::PropertyBool", "choice": "App::PropertyEnumeration",
            "file": "App::PropertyFile", "names": "App::PropertyStringList",
            "entries": "App::PropertyStringList", "text": "App::PropertyString"}[setting["kind"]]


def property_help(setting: Dict[str, Any]) -> str:
    """The description of a property."""
    text = setting["help"][0].upper() + setting["help"][1:]
    if setting["kind"] == "number" and setting["otherwise"]:
        return f"{text}; 0 = {setting['otherwise']}"
    if setting["kind"] in ("names", "sizes", "entries", "text") and setting["otherwise"]:
        return f"{text}; empty = {setting['otherwise']}"
    return text


def words(setting: Dict[str, Any]) -> List[str]:
    """The values of an enumeration; a new object starts with the first one."""
    return list(reversed(ORDERS)) if setting["name"] == "order" else list(setting["choices"])


def to_property(setting: Dict[str, Any], value: Any) -> Any:
    """Converts a setting's value to the property's value; None gives the value of a new object."""
    kind, default = setting["kind"], setting["default"]
    if kind == "names":
        return [face_name(face) for face in value or ()]
    if kind == "entries":
        return entry_texts(value or ())
    if value is None:
        value = default
    if setting["name"] == "order":
        return ORDERS[int(value or 2) - 1]
    if value is None:
        return "" if kind in ("file", "text") else 0
    return int(value) if kind == "count" else value


def from_property(setting: Dict[str, Any], value: Any) -> Optional[Any]:
    """Converts a property's value to the setting's value; None = the setting is not passed to the command."""
    value = getattr(value, "Value", value)
    kind = setting["kind"]
    if setting["name"] == "order":
        return ORDERS.index(value) + 1
    if kind in ("names", "entries"):
        return list(value) or None
    if kind == "choice":
        return value if value in setting["choices"] else None
    if kind in ("file", "text"):
        return value or None
    if kind == "number" and value == 0 and setting["default"] is None:
        return None
    return value
