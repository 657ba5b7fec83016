# SPDX-License-Identifier: GPL-3.0-or-later
"""What the mesher reports about single faces, edges and vertices: what it left out, what it kept, what forces poor quads. The mesh
object stores these lists of the report as text. Runs inside FreeCAD."""

import json
from functools import lru_cache
from typing import Any, Dict, List, Sequence, Set, Tuple

import numpy as np

from ..core import quality
from .groups import PartGroups

#: A row of quads counts as one of the layers if its height is at most this far from the one asked for, as a factor.
_ALIKE = 1.5
#: The lists of the report that are stored, without the points along crossed edges.
_LISTS = ("suppressed_features", "filled_holes", "crossed_edges", "poor_quads", "kept")


def as_text(report: Dict[str, Any], layers: Sequence[Dict[str, Any]] = ()) -> str:
    """The lists of a report, for the property Findings. layers: from layers_in()."""
    lists = {name: [{key: value for key, value in entry.items() if key != "line"} for entry in report.get(name, ())] for name in _LISTS}
    lists["merged_faces"] = [{key: face[key] for key in ("name", "note")} for face in report.get("faces", ())
                             if face.get("status") == "merged"]
    lists["layers"] = list(layers)
    return json.dumps(lists)


def layers_in(fem_mesh, entries: Sequence[str]) -> List[Dict[str, Any]]:
    """For each entry of Layers along an edge: how many rows it asks for, and how many of the quads along the edge are the first of
    so many rows."""
    asked = [(name, text.split(",")) for name, _, text in (entry.partition("=") for entry in entries) if name.startswith("Edge")]
    if not asked:
        return []
    measured, groups = quality.measure(fem_mesh), PartGroups(fem_mesh)
    sides: Dict[Tuple[int, int], List[Tuple[int, int]]] = {}
    quads: Any = measured.nodes.tolist()  # text, say the types of NumPy 2.2
    for quad, nodes in enumerate(quads):
        for k in range(4):
            a, b = nodes[k], nodes[k - 3]
            sides.setdefault((min(a, b), max(a, b)), []).append((quad, k))
    found = []
    for name, (first, ratio, count) in asked:
        on_edge, heights = groups.nodes(name), float(first) * float(ratio) ** np.arange(int(count))
        rows = [_rows_from(measured, sides, start, heights) for side, users in sides.items() if on_edge.issuperset(side) for start in users]
        found.append({"name": name, "asked": len(heights), "full": rows.count(len(heights)), "quads": len(rows)})
    return found


def _rows_from(measured: quality.ElementQuality, sides: Dict, start: Tuple[int, int], heights: np.ndarray) -> int:
    """The number of quads, one behind the other from a side of a quad, that have these heights."""
    passed: Set[int] = set()
    for row, height in enumerate(heights):
        quad, k = start
        corners, nodes = np.roll(measured.corners[quad], -k, axis=0), np.roll(measured.nodes[quad], -k)
        share = 0.5 * np.linalg.norm(corners[2] + corners[3] - corners[0] - corners[1]) / height
        if not 1 / _ALIKE < share < _ALIKE:
            return row
        passed.add(quad)
        behind = [user for user in sides[min(nodes[2:]), max(nodes[2:])] if user[0] not in passed]
        if len(behind) != 1:
            return row + 1
        start = behind[0]
    return len(heights)


def findings_of(mesh) -> Dict[str, List[Dict[str, Any]]]:
    """The lists by their names in reports, and `merged_faces`; empty ones if the mesh object has none."""
    return _read(mesh.Findings or as_text({}))


@lru_cache(maxsize=4)
def _read(text: str) -> Dict[str, List[Dict[str, Any]]]:
    return json.loads(text)
