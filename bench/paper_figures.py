#!/usr/bin/env python3
"""Draws the figures of docs/notes/paper.md from the results of bench/paper.

    paper_figures.py FOLDER... -o docs/pictures

Each FOLDER contains a paper.json; domains of later ones replace those of earlier ones.
"""

import argparse
import json
import pathlib

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt


def load(folders):
    domains, colorings = {}, []
    for folder in folders:
        results = json.loads((folder / "paper.json").read_text())
        domains.update({domain["name"]: domain for domain in results["domains"]})
        colorings = results.get("colorings", colorings)
    return domains, colorings


def draw_histogram(domain, path):
    """Draws the shares of quads by q before and after improvement, like figures 12 and 14 of the paper."""
    methods = [
        ("coloring", "coloring"),
        ("default", "default"),
        ("blossom", "Blossom"),
    ]
    figure, axes = plt.subplots(1, 2, figsize=(9, 3.2), sharey=True)
    for axis, when in zip(axes, ("before moving nodes", "after improvement")):
        for key, label in methods:
            if key not in domain:
                continue
            entry = domain[key] if axis is axes[0] else domain[key]["improved"]
            counts = entry["histogram"]
            shares = [100 * count / sum(counts) for count in counts]
            centers = [(k + 0.5) / len(counts) for k in range(len(counts))]
            axis.plot(centers, shares, drawstyle="steps-mid", label=label)
        axis.set_title(f"{domain['name']}, {when}", fontsize=9)
        axis.set_xlabel("q")
    axes[0].set_ylabel("quads, %")
    axes[0].legend(fontsize=8)
    figure.tight_layout()
    figure.savefig(path, metadata={"Date": None})


def draw_colorings(means, path):
    """Draws the distribution of mean q over many colorings, like figure 10 of the paper."""
    figure, axis = plt.subplots(figsize=(5, 3))
    axis.hist(means, bins=60)
    axis.axvspan(0.505, 0.522, alpha=0.2, label="range in the paper, its mesh")
    axis.set_xlabel("mean q of a coloring")
    axis.set_ylabel(f"of {len(means)} colorings")
    axis.legend(fontsize=8)
    figure.tight_layout()
    figure.savefig(path, metadata={"Date": None})


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folders", nargs="+", type=pathlib.Path)
    parser.add_argument("-o", "--output", type=pathlib.Path, required=True)
    arguments = parser.parse_args()
    arguments.output.mkdir(parents=True, exist_ok=True)
    plt.rcParams["svg.hashsalt"] = "quadrille"
    domains, colorings = load(arguments.folders)
    for name in ("rectangle 1", "Lake Ontario 1"):
        if name in domains:
            file = "paper_" + name.lower().replace(" ", "_") + ".svg"
            draw_histogram(domains[name], arguments.output / file)
    if colorings:
        draw_colorings(colorings, arguments.output / "paper_colorings.svg")


if __name__ == "__main__":
    main()
