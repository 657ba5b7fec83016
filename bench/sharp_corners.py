#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Counts the quads outside the industry limits that sharp corners of CAD faces force there.

    PYTHONPATH=build/python bench/sharp_corners.py DIVISIONS PART.step...

Each part is meshed at its diagonal over DIVISIONS, with an eighth of that as the minimum size. The quad in a corner below 40 degrees is
outside the limits whatever the mesher does, and its q is at most the corner over 90 degrees."""

import sys
from pathlib import Path
from typing import Any, List

import numpy as np

import quadrille

LIMIT = 40  # least corner angle inside the limits, degrees


def sharp_corners(mesh: Any) -> Any:
    """The corners of faces below LIMIT, in degrees."""
    quads = np.asarray(mesh.quads)[:, :4]
    nodes = np.asarray(mesh.points)[quads]
    following, previous = np.roll(nodes, -1, 1) - nodes, np.roll(nodes, 1, 1) - nodes
    lengths = np.linalg.norm(following, axis=2) * np.linalg.norm(previous, axis=2)
    angles = np.degrees(np.arccos(np.clip((following * previous).sum(2) / lengths, -1, 1))).ravel()
    # A node that has one quad of a face is a corner of that face.
    pairs = np.stack([np.repeat(mesh.face_ids, 4), quads.ravel()], axis=1)
    _, place, uses = np.unique(pairs, axis=0, return_inverse=True, return_counts=True)
    return angles[(uses[place.ravel()] == 1) & (angles < LIMIT)]


def main(divisions: float, parts: List[str]) -> None:
    """Meshes and counts."""
    total = np.zeros(3, int)
    for part in parts:
        model = quadrille.read(part)
        size = model.diagonal / divisions
        mesh = quadrille.mesh(model, size=size, size_min=size / 8, order=1, threads=1)
        quality, sharp = mesh.quality(), sharp_corners(mesh)
        counts = len(mesh.quads), quality["criteria"]["outside"], len(sharp)
        total += counts
        bound = f", at most {sharp.min() / 90:.3f}" if len(sharp) else ""
        print(f"{Path(part).stem}: {counts[0]} quads, {counts[1]} outside, {counts[2]} in sharp corners; "
              f"worst q {quality['q_min']:.3f}{bound}", flush=True)
    print(f"{total[0]} quads, {total[1]} outside ({100 * total[1] / total[0]:.3f} %), "
          f"{total[2]} in sharp corners ({100 * total[2] / total[0]:.3f} %)")


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    main(float(sys.argv[1]), sys.argv[2:])
