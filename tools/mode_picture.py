#!/usr/bin/env python3
"""Draws the first modes of a modal result folder, coloured by the density of their strain energy."""

import argparse
import csv
from pathlib import Path

import matplotlib

matplotlib.use("Agg")

import matplotlib.pyplot as plt
import meshio
import numpy as np
from damage_picture import draw, values_of


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", type=Path, metavar="RESULT_FOLDER")
    parser.add_argument("--modes", type=int, default=6, help="modes to draw (default: %(default)s)")
    size_help = "largest displacement over the size of the body (default: %(default)s)"
    parser.add_argument("--size", type=float, default=0.1, help=size_help)
    parser.add_argument("--out", type=Path, metavar="PNG", help="picture (default: RESULT_FOLDER/modes.png)")
    arguments = parser.parse_args()
    with open(arguments.folder / "modes.csv", newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))[: arguments.modes]
    columns = min(3, len(rows))
    lines = -(-len(rows) // columns)
    figure, axes = plt.subplots(lines, columns, figsize=(4 * columns, 3 * lines), layout="constrained", squeeze=False)
    for place in axes.flat[len(rows) :]:
        place.set_axis_off()
    for place, row in zip(axes.flat, rows):
        mesh = meshio.read(arguments.folder / f"mode_{int(row['mode']):04d}.vtu")
        extent = np.ptp(mesh.points, axis=0).max()
        scale = arguments.size * extent / np.abs(mesh.point_data["displacement"]).max()
        values = values_of(mesh, "strain_energy_density")
        # The corners of a clamp outshine all else.
        draw(place, mesh, values, scale, (0.0, np.quantile(values, 0.995)))
        place.set_title(f"{row['mode']}: {float(row['frequency_hz']):.0f} Hz")
    path = arguments.out or arguments.folder / "modes.png"
    figure.savefig(path, dpi=80)
    print(path)


if __name__ == "__main__":
    main()
