# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws the convergence measured by examples/freecad/verification.py --converge, and prints its table.

    python3 bench/verification_plot.py docs/verification.json docs/verification.png
"""

import json
import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
from matplotlib.ticker import NullFormatter

STYLES = {"quadrille": ("Quadrille", "#1f5fa8", "o"), "gmsh-quads": ("Gmsh, quads", "#d1751b", "s"),
          "gmsh-triangles": ("Gmsh, triangles", "#6b6b6b", "^"), "grid": ("structured grid", "#3a8f4e", "D")}
LEFT_OUT = {"membrane-patch"}  # exact at every size: nothing to draw


def error(row):
    """The signed error in percent; the absolute value if the reference is 0."""
    return abs(row["value"]) if row["reference"] == 0 else 100 * (row["value"] / row["reference"] - 1)


def cell(row):
    """The text of one result in the table."""
    return f"{row['nodes']}: {error(row):.2g}" if row["reference"] == 0 else f"{row['nodes']}: {error(row):+.2f} %"


def main():
    """Draws the plot and prints the table."""
    rows = json.loads(Path(sys.argv[1]).read_text(encoding="utf-8"))
    cases = [case for case in dict.fromkeys(row["case"] for row in rows) if case not in LEFT_OUT]
    rows_of_plots = len(cases) // 5 + 1  # one more place, for the legend
    figure, axes = plt.subplots(rows_of_plots, 5, figsize=(15, 3 * rows_of_plots), constrained_layout=True)
    for axis, case in zip(axes.flat, cases):
        for mesher, (label, color, marker) in STYLES.items():
            found = sorted((row["nodes"], max(abs(error(row)), 1e-3 if row["reference"] else 0)) for row in rows
                           if (row["case"], row["mesher"]) == (case, mesher))
            if found:
                axis.loglog(*zip(*found), marker=marker, color=color, label=label)
        relative = all(row["reference"] == 0 for row in rows if row["case"] == case)
        axis.axhline(1e-6 if relative else 1, color="0.7", linewidth=0.8)
        axis.set_title(case)
        axis.set_xlabel("nodes")
        axis.xaxis.set_minor_formatter(NullFormatter())  # labels would overlap
        axis.set_ylabel("error over largest" if relative else "error, %")
        axis.grid(True, which="major", alpha=0.3)
    for axis in axes.flat[len(cases):]:
        axis.axis("off")
    axes.flat[-1].legend(*axes.flat[0].get_legend_handles_labels(), loc="center", frameon=False, fontsize=12)
    figure.savefig(sys.argv[2], dpi=90)
    print("| case | reference | " + " | ".join(f"{STYLES[mesher][0]}" for mesher in STYLES) + " |")
    print("| --- | --- |" + " --- |" * len(STYLES))
    for case in dict.fromkeys(row["case"] for row in rows):
        cells = []
        for mesher in STYLES:
            found = [row for row in rows if (row["case"], row["mesher"]) == (case, mesher)]
            cells.append("<br>".join(map(cell, found)))
        reference = next(row["reference"] for row in rows if row["case"] == case)
        print(f"| {case} | {reference:g} | " + " | ".join(cells) + " |")


main()
