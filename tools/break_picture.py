#!/usr/bin/env python3
"""Draws the broken bonds of a result folder, coloured by the criterion that broke them."""

import argparse
import csv
from collections import Counter
from pathlib import Path

import matplotlib

matplotlib.use("Agg")

import matplotlib.pyplot as plt
import meshio
import numpy as np
from matplotlib.collections import LineCollection

# Told apart with any colour vision (Okabe and Ito).
COLOURS = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9"]


def read_places(folder):
    """The places of nodes or cells by their tags, before the load."""
    mesh = meshio.read(sorted(folder.glob("fields_*.vtu"))[0])
    if "node" in mesh.point_data:
        return "node", dict(zip(mesh.point_data["node"].astype(int).tolist(), mesh.points[:, :2]))
    squares = np.concatenate([block.data for block in mesh.cells])
    tags = np.concatenate(mesh.cell_data["cell"]).astype(int).tolist()
    return "cell", dict(zip(tags, mesh.points[squares, :2].mean(axis=1)))


def read_breaks(folder):
    with open(folder / "breaks.csv", newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def draw(axes, folder, until, box):
    tag, places = read_places(folder)
    breaks = [row for row in read_breaks(folder) if until is None or int(row["step"]) <= until]
    points = np.array(list(places.values()))
    axes.plot(points[:, 0], points[:, 1], ".", color="#c8c8c8", markersize=1.0, zorder=0)
    counts = Counter(row["criterion"] for row in breaks)
    for colour, criterion in zip(COLOURS, sorted(counts)):
        own = [row for row in breaks if row["criterion"] == criterion]
        lines = [[places[int(row[f"{tag}_{end}"])] for end in "ab"] for row in own]
        axes.add_collection(LineCollection(lines, colors=colour, linewidths=0.7, label=f"{criterion} ({len(own)})"))
    axes.set_aspect("equal")
    axes.set_axis_off()
    if box:
        axes.set_xlim(box[0], box[2])
        axes.set_ylim(box[1], box[3])
    if counts:
        axes.legend(loc="upper center", bbox_to_anchor=(0.5, 0.0), ncol=2, frameon=False)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", type=Path, nargs="+", metavar="RESULT_FOLDER", help="drawn side by side")
    until_help = "leave out what broke after this step (one for each folder)"
    parser.add_argument("--until", type=int, metavar="STEP", nargs="+", help=until_help)
    parser.add_argument("--box", type=float, nargs=4, metavar=("X0", "Y0", "X1", "Y1"), help="part of the body, m")
    parser.add_argument("--title", nargs="+", help="titles (default: names of the folders)")
    parser.add_argument("--out", type=Path, metavar="PNG", help="picture (default: breaks.png in the first folder)")
    arguments = parser.parse_args()
    titles = arguments.title or [folder.name for folder in arguments.folder]
    until = arguments.until or [None] * len(arguments.folder)
    if len(titles) != len(arguments.folder) or len(until) != len(arguments.folder):
        parser.error("--title and --until need a value for each folder")

    count = len(arguments.folder)
    height = 5.6
    if arguments.box:
        x0, y0, x1, y1 = arguments.box
        height = 0.8 + 5.2 * (y1 - y0) / (x1 - x0)
    figure, all_axes = plt.subplots(1, count, figsize=(5.2 * count, height), layout="constrained", squeeze=False)
    for axes, folder, step, title in zip(all_axes[0], arguments.folder, until, titles):
        draw(axes, folder, step, arguments.box)
        axes.set_title(title)
    out = arguments.out or arguments.folder[0] / "breaks.png"
    figure.savefig(out, dpi=90)
    print(out)


if __name__ == "__main__":
    main()
