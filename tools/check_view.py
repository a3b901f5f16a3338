#!/usr/bin/env python3
"""Checks the picture that view.py makes of a result folder: its size, that the body is seen, and the values that it prints.

The point's values must be those that VTK finds, the displacement and damage of the probes of history.csv beside them.
"""

import csv
import subprocess
import sys
from pathlib import Path

import matplotlib.image
import numpy as np
import pyvista

from view import SIZE, steps


def main(folder, picture):
    step, file = list(steps(folder).items())[-1]
    grid = pyvista.read(file)
    # A place away from any point by a part of a spacing, in a corner where nothing is symmetric.
    x0, x1, y0, y1, *_ = grid.bounds
    x, y = x0 + 0.31 * (x1 - x0), y0 + 0.23 * (y1 - y0)
    script = Path(__file__).with_name("view.py")
    command = [sys.executable, script, folder, "--screenshot", picture, f"--point={x!r},{y!r}"]
    said = subprocess.run(command, check=True, capture_output=True, text=True).stdout.splitlines()

    on_points = "damage" in grid.point_data
    fields = grid.point_data if on_points else grid.cell_data
    places = grid.points if on_points else grid.points.reshape(-1, 4, 3).mean(axis=1)
    nearest = ((places[:, 0] - x) ** 2 + (places[:, 1] - y) ** 2).argmin()
    printed = {line.partition(",")[0]: [float(word) for word in line.split(",")[1:]] for line in said[1:-1]}
    assert printed.keys() == set(fields.keys()), printed.keys()
    for name, values in printed.items():
        assert values == np.atleast_1d(fields[name][nearest]).tolist(), name

    # The displacement of the loaded edge in the fields is that of the last row of the history.
    with open(folder / "history.csv", newline="", encoding="utf-8") as file:
        row = list(csv.DictReader(file))[-1]
    assert row["step"] == step and any(abs(it) == abs(float(row["displacement"])) for it in fields["displacement"].ravel())

    image = matplotlib.image.imread(picture)[:, :, :3]
    assert image.shape[:2] == SIZE[::-1], image.shape
    seen = (image < 0.95).any(axis=2).mean()
    assert 0.1 < seen < 0.9, f"{seen:.0%} of the picture are not white"
    print(f"{picture}: {seen:.0%} of the picture are not white, {len(printed)} values as in the files")


main(Path(sys.argv[1]), Path(sys.argv[2]))
