#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Compares the number of quads that `quadrille sizes` expects with that of the mesh: at the sizes that `quadrille info` suggests, with
elements across gaps at the middle size, and with default settings.

    bench/expected_counts.py --quadrille build/quadrille MODEL..."""

import argparse
import json
import math
import re
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from typing import List, Optional, Tuple

ALLOWED = 1.25  # factor between expected and real


def run(command: List[str], limit: float) -> Optional[Tuple[str, float]]:
    """What a command writes, and its seconds; None if it fails."""
    start = time.monotonic()
    try:
        done = subprocess.run(command, capture_output=True, text=True, check=False, timeout=limit)
    except subprocess.TimeoutExpired:
        print(f"{' '.join(command)}: more than {limit:g} s", file=sys.stderr)
        return None
    if done.returncode != 0:
        print(f"{' '.join(command)}: {done.stderr.strip()}", file=sys.stderr)
        return None
    return done.stdout, time.monotonic() - start


def compare(quadrille: str, model: str, options: List[str], limit: float) -> Optional[Tuple[float, int, float, float]]:
    """Expected and real number of quads, and the seconds of each."""
    with tempfile.TemporaryDirectory() as folder:
        reports = [Path(folder) / name for name in ("sizes.json", "mesh.json")]
        commands = [["sizes", model, "--count-only"], ["mesh", model, "-o", str(Path(folder) / "mesh.msh")]]
        seconds = []
        for command, report in zip(commands, reports):
            done = run([quadrille, *command, "--report", str(report), "--threads", "1", "--quiet", *options], limit)
            if done is None:
                return None
            seconds.append(done[1])
        expected, real = (json.loads(report.read_text()) for report in reports)
        return expected["quads"], real["counts"]["quads"], seconds[0], seconds[1]


def cases(quadrille: str, model: str, limit: float) -> List[Tuple[str, List[str]]]:
    """The settings to compare: a name and the options of each."""
    info = run([quadrille, "info", model], limit)
    sizes = re.findall(r"--size (\S+) for", info[0]) if info else []
    found = [(f"size {size}", ["--size", size]) for size in sizes]
    if sizes:
        middle = sizes[len(sizes) // 2]
        found.append((f"size {middle}, gaps", ["--size", middle, "--proximity", "3"]))
    return found + [("default", [])]


def main() -> None:
    """Command line."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n", 1)[0])
    parser.add_argument("models", nargs="+")
    parser.add_argument("--quadrille", default="build/quadrille")
    parser.add_argument("--limit", type=float, default=300, help="seconds for each run")
    options = parser.parse_args()
    ratios, shares = [], []
    print("| model | settings | expected | mesh | ratio | share of time |\n| --- | --- | --- | --- | --- | --- |")
    for model in options.models:
        for name, settings in cases(options.quadrille, model, options.limit):
            found = compare(options.quadrille, model, settings, options.limit)
            if found is None:
                continue
            expected, real, quick, slow = found
            ratios.append(expected / max(1, real))
            shares.append(quick / slow)
            mark = "" if 1 / ALLOWED <= ratios[-1] <= ALLOWED else " !"
            print(f"| {Path(model).stem} | {name} | {expected:.0f} | {real} | {ratios[-1]:.2f}{mark} | {shares[-1]:.2f} |", flush=True)
    within = sum(1 / ALLOWED <= ratio <= ALLOWED for ratio in ratios)
    if ratios:
        print(f"{len(ratios)} runs, {within} within a quarter; ratio {min(ratios):.2f} to {max(ratios):.2f}, "
              f"mean of logarithms {math.exp(sum(map(math.log, ratios)) / len(ratios)):.2f}; "
              f"share of time {sorted(shares)[len(shares) // 2]:.2f} in the median")


if __name__ == "__main__":
    main()
