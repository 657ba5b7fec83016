#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Measures how well meshes of CAD models keep the requested sizes: one run of the command per model, with `--report`.

    bench/size_fidelity.py --quadrille build/quadrille MODEL... [-- --growth 0.2]

The size is the diagonal over --div, with --proximity elements across gaps; arguments after -- go to `quadrille mesh`. A model keeps its
sizes if the median of length over requested size is in [0.9, 1.1] and 95 % of the sides are between 0.55 and 1.6 times the requested size."""

import argparse
import json
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Any, Dict, List, Optional

MEDIANS, LEAST_PERCENT = (0.9, 1.1), 95


def measure(command: str, model: str, options: List[str]) -> Optional[Dict[str, Any]]:
    """The report of one model; None if meshing fails."""
    with tempfile.TemporaryDirectory() as folder:
        report = Path(folder) / "report.json"
        done = subprocess.run([command, "mesh", model, "-o", str(Path(folder) / "mesh.msh"), "--report", str(report), "--threads", "1",
                               "--quiet", *options], capture_output=True, text=True, check=False)
        if done.returncode != 0:
            print(f"{Path(model).name}: {done.stderr.strip()}", file=sys.stderr)
            return None
        return json.loads(report.read_text())


def main() -> None:
    """Command line."""
    arguments = sys.argv[1:]
    at = arguments.index("--") if "--" in arguments else len(arguments)
    parser = argparse.ArgumentParser(description=__doc__.split("\n", 1)[0])
    parser.add_argument("models", nargs="+")
    parser.add_argument("--quadrille", default="build/quadrille")
    parser.add_argument("--div", default="60")
    parser.add_argument("--proximity", default="3")
    options = parser.parse_args(arguments[:at])
    extra = ["--elements-per-diagonal", options.div, "--proximity", options.proximity, *arguments[at + 1:]]
    rows = []
    print("| model | quads | median | below 0.55 | within | above 1.6 |\n| --- | --- | --- | --- | --- | --- |")
    for model in options.models:
        report = measure(options.quadrille, model, extra)
        if report is None:
            continue
        sizes, quads = report["sizes"], report["counts"]["quads"]
        median, within = sizes["median"], sizes["within_percent"]
        low, high = sizes["below_percent"], sizes["above_percent"]
        rows.append((quads, median, within))
        print(f"| {Path(model).stem} | {quads} | {median:.2f} | {low:.1f} % | {within:.1f} % | {high:.1f} % |", flush=True)
    good = [MEDIANS[0] <= median <= MEDIANS[1] for _, median, _ in rows]
    kept = [fits and within >= LEAST_PERCENT for fits, (_, _, within) in zip(good, rows)]
    print(f"{len(rows)} models, {sum(quads for quads, _, _ in rows)} quads; median in {list(MEDIANS)}: {sum(good)}; "
          f"and {LEAST_PERCENT} % within: {sum(kept)}; within in the mean: {sum(row[2] for row in rows) / max(1, len(rows)):.1f} %")


if __name__ == "__main__":
    main()
