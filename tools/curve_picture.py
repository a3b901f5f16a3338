#!/usr/bin/env python3
"""Draws the force-displacement curves of result folders over each other."""

import argparse
import csv
from pathlib import Path

import matplotlib

matplotlib.use("Agg")

import matplotlib.pyplot as plt


def read_curve(folder):
    """The columns displacement and reaction of history.csv."""
    path = folder / "history.csv"
    try:
        with open(path, newline="", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        return [float(row["displacement"]) for row in rows], [float(row["reaction"]) for row in rows]
    except FileNotFoundError:
        raise SystemExit(f"{path} does not exist") from None
    except KeyError as column:
        raise SystemExit(f"{path} has no column {column}") from None


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folders", type=Path, nargs="+", metavar="RESULT_FOLDER")
    parser.add_argument("--out", type=Path, metavar="PNG", required=True, help="picture to write")
    arguments = parser.parse_args()

    figure, axes = plt.subplots(figsize=(7, 5), layout="constrained")
    for folder in arguments.folders:
        axes.plot(*read_curve(folder), marker=".", markersize=3, linewidth=1.2, label=folder.resolve().name)
    axes.set_xlabel("displacement (m)")
    axes.set_ylabel("reaction (N)")
    axes.grid(alpha=0.3)
    axes.legend()
    figure.savefig(arguments.out, dpi=150)
    print(arguments.out)


if __name__ == "__main__":
    main()
