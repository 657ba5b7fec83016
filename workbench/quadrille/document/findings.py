# SPDX-License-Identifier: GPL-3.0-or-later
"""What the mesher reports about single faces, edges and vertices: what it left out, what it kept, what forces poor quads. The mesh
object stores these lists of the report as text. Runs inside FreeCAD."""

import json
from functools import lru_cache
from typing import Any, Dict, List

#: The lists of the report that are stored, without the points along crossed edges.
_LISTS = ("suppressed_features", "filled_holes", "crossed_edges", "poor_quads", "kept")


def as_text(report: Dict[str, Any]) -> str:
    """The lists of a report, for the property Findings."""
    lists = {name: [{key: value for key, value in entry.items() if key != "line"} for entry in report.get(name, ())] for name in _LISTS}
    lists["merged_faces"] = [{key: face[key] for key in ("name", "note")} for face in report.get("faces", ())
                             if face.get("status") == "merged"]
    return json.dumps(lists)


def findings_of(mesh) -> Dict[str, List[Dict[str, Any]]]:
    """The lists by their names in reports, and `merged_faces`; empty ones if the mesh object has none."""
    return _read(mesh.Findings or as_text({}))


@lru_cache(maxsize=4)
def _read(text: str) -> Dict[str, List[Dict[str, Any]]]:
    return json.loads(text)
