#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Counts the causes of quads outside the limits, over many parts, and draws the face where each cause forces most.

    PYTHONPATH=build/python bench/poor_quads.py --quadrille build/quadrille [--div 60] [-o OUT.png] PART...

Each part gets its diagonal over --div as size, an eighth of it as minimum size, twelve elements per circle, one thread. The table of
causes is printed to standard output as Markdown; the criterion of the shortest side counts, warp does not."""

import argparse
import json
import re
import subprocess
import tempfile
from pathlib import Path
from typing import Dict, NamedTuple, Tuple

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

import quadrille
from quadrille.core.quality import measure_quads

#: The causes, by what the report's sentences begin with.
CAUSES = {"it is": "an edge shorter than the least size", "its sides meet": "a corner of under 40 degrees",
          "Edge": "edges closer than the least size", "nothing": "nothing that small: rows end there, or pass on from a neighbor"}


class Worst(NamedTuple):
    """The face of a part where a cause forces most quads."""

    quads: int = 0
    part: str = ""
    corners: np.ndarray = np.zeros((0, 4, 3))  #: of the quads of the face
    poor: np.ndarray = np.zeros(0, bool)  #: outside the limits


def cause_of(why: str) -> str:
    """The cause in a sentence of the report."""
    return next(cause for start, cause in CAUSES.items() if why.startswith(start))


def faces_with_poor_quads(report: Dict, mesh, least: float, worst: Dict[str, Worst], part: str) -> None:
    """Keeps, for each cause, the face, or the quads at an edge, where it forces more quads than anywhere before."""
    for entry in report["poor_quads"]:
        cause, number = cause_of(entry["why"]), int(re.sub(r"\D", "", entry["name"]))
        if entry["quads"] <= worst[cause].quads:
            continue
        on_edge = np.unique(mesh.segments[mesh.segments[:, -1] == number][:, :2])
        faces = [number] if entry["name"].startswith("Face") else mesh.face_ids[np.isin(mesh.quads[:, :4], on_edge).any(axis=1)]
        quads = mesh.quads[np.isin(mesh.face_ids, faces)][:, :4]
        measured = measure_quads(np.arange(len(quads)), quads, mesh.points[quads], least)
        poor = np.any([measured.fails(name) for name in measured.limits if name != "warp"], axis=0)
        worst[cause] = Worst(entry["quads"], part, mesh.points[quads], poor)


def draw(axes, cause: str, worst: Worst) -> None:
    """Draws the quads around the middle of those outside the limits, seen along the mean normal."""
    axes.set_title(f"{cause}\n{worst.part}: {worst.quads} quads", fontsize=8)
    axes.set_axis_off()
    if not worst.poor.any():
        return
    poor = worst.corners[worst.poor]
    center = poor[len(poor) // 2].mean(axis=0)
    normals = np.cross(poor[:, 2] - poor[:, 0], poor[:, 3] - poor[:, 1])
    across, up = np.linalg.svd(normals[len(poor) // 2][None])[2][1:]
    half = 8 * float(np.median(np.linalg.norm(worst.corners[:, 1] - worst.corners[:, 0], axis=1)))
    for quad, is_poor in zip(worst.corners, worst.poor):
        flat = (quad - center) @ np.stack([across, up], axis=1)
        if np.abs(flat).max() < 3 * half:
            axes.fill(*flat.T, facecolor="#d73027" if is_poor else "#d9ef8b", edgecolor="#333333", linewidth=0.4)
    axes.set_xlim(-half, half)
    axes.set_ylim(-half, half)
    axes.set_aspect("equal")


def main() -> None:
    """Meshes, counts and draws."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("parts", nargs="+", type=Path)
    parser.add_argument("--quadrille", default="quadrille")
    parser.add_argument("--div", type=float, default=60)
    parser.add_argument("-o", "--output", type=Path)
    options = parser.parse_args()
    counts: Dict[str, Tuple[int, int]] = dict.fromkeys(CAUSES.values(), (0, 0))
    worst = {cause: Worst() for cause in CAUSES.values()}
    quads = 0
    with tempfile.TemporaryDirectory() as folder:
        out, told = Path(folder) / "a.msh", Path(folder) / "a.json"
        for part in options.parts:
            size = quadrille.read(part).diagonal / options.div
            subprocess.run([options.quadrille, "mesh", str(part), "-o", str(out), "--size", repr(size), "--size-min", repr(size / 8),
                            "--threads", "1", "--quiet", "--report", str(told)], check=True)
            report = json.loads(told.read_text())
            quads += report["counts"]["quads"]
            for entry in report["poor_quads"]:
                one, places = counts[cause_of(entry["why"])]
                counts[cause_of(entry["why"])] = (one + entry["quads"], places + 1)
            if options.output:
                faces_with_poor_quads(report, quadrille.read_mesh(out), size / 8, worst, part.stem)
    print("| cause | quads | of all | places |\n| --- | ---: | ---: | ---: |")
    for cause, (one, places) in counts.items():
        print(f"| {cause} | {one} | {100 * one / quads:.3f} % | {places} |")
    if options.output:
        figure, axes = plt.subplots(1, len(CAUSES), figsize=(14, 4))
        for place, (cause, found) in zip(axes, worst.items()):
            draw(place, cause, found)
        figure.tight_layout()
        figure.savefig(options.output, dpi=80)


if __name__ == "__main__":
    main()
