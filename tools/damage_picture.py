#!/usr/bin/env python3
"""Draws a field on the deformed mesh or lattice of a result folder."""

import argparse
import csv
import re
from pathlib import Path

import matplotlib

matplotlib.use("Agg")

import matplotlib.pyplot as plt
import meshio
import numpy as np
from matplotlib.collections import PolyCollection


def find_outputs(folder):
    """The path of fields_NNNN.vtu for each step, in order."""
    matches = [(re.fullmatch(r"fields_(\d+)\.vtu", path.name), path) for path in folder.glob("fields_*.vtu")]
    outputs = {int(match.group(1)): path for match, path in matches if match}
    if not outputs:
        raise SystemExit(f"{folder} has no fields_NNNN.vtu")
    return dict(sorted(outputs.items()))


def choose_steps(outputs, arguments):
    if arguments.step is not None:
        missing = [str(step) for step in arguments.step if step not in outputs]
        if missing:
            raise SystemExit(f"no output at step {', '.join(missing)}; there are {', '.join(map(str, outputs))}")
        return arguments.step
    steps = list(outputs)
    if arguments.strip is None:
        return steps[-1:]
    spread = np.linspace(0, len(steps) - 1, min(arguments.strip, len(steps)))
    return [steps[i] for i in spread.round().astype(int)]


def read_displacements(folder):
    """The applied displacement of each step, or change of temperature where nothing else loads the body; empty without a history."""
    path = folder / "history.csv"
    if not path.is_file():
        return {}
    with open(path, newline="", encoding="utf-8") as file:
        return {int(row["step"]): float(row["displacement"]) for row in csv.DictReader(file) if row.get("displacement")}


def is_heated_alone(folder):
    """Whether the case has a change of temperature and no load."""
    path = folder / "case.resolved.toml"
    text = path.read_text(encoding="utf-8") if path.is_file() else ""
    return "[[temperature]]" in text and "[[load]]" not in text


def triangles_of(mesh):
    """All planar cells as triangles, quads split along a diagonal."""
    triangles = [block.data for block in mesh.cells if block.type == "triangle"]
    for block in mesh.cells:
        if block.type == "quad":
            triangles += [block.data[:, [0, 1, 2]], block.data[:, [0, 2, 3]]]
    if not triangles:
        raise SystemExit("the output has neither triangles nor quads")
    return np.concatenate(triangles)


def values_of(mesh, name):
    """A field at the points of a mesh, or at the cells of a lattice; of a vector the norm."""
    cell_data = {field: np.concatenate(blocks) for field, blocks in mesh.cell_data.items()}
    fields = {**mesh.point_data, **cell_data}
    if name not in fields:
        raise SystemExit(f"no field {name}; there are {', '.join(fields)}")
    values = fields[name]
    return values if values.ndim == 1 else np.linalg.norm(values, axis=1)


def draw(axes, mesh, values, scale, limits):
    points = mesh.points + scale * mesh.point_data["displacement"]
    colours = {"cmap": "cividis", "vmin": limits[0], "vmax": limits[1]}
    if len(values) == len(points):
        picture = axes.tripcolor(
            points[:, 0], points[:, 1], triangles_of(mesh), values, shading="gouraud", **colours
        )
    else:
        # The squares of a lattice stand apart where the body opens; each has its own value.
        squares = np.concatenate([block.data for block in mesh.cells])
        picture = PolyCollection(
            points[squares, :2], array=values, cmap=colours["cmap"], clim=limits, edgecolors="face", linewidths=1.0
        )
        axes.add_collection(picture)
        axes.autoscale_view()
    axes.set_aspect("equal")
    axes.set_axis_off()
    return picture


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", type=Path, metavar="RESULT_FOLDER")
    which = parser.add_mutually_exclusive_group()
    which.add_argument("--step", type=int, nargs="+", metavar="N", help="steps to draw (default: the last output)")
    which.add_argument("--strip", type=int, metavar="COUNT", help="draw so many outputs, evenly spread, side by side")
    parser.add_argument("--field", default="damage", help="field; of a vector the norm (default: %(default)s)")
    parser.add_argument("--scale", type=float, default=1.0, help="factor on the displacement (default: %(default)s)")
    parser.add_argument("--out", type=Path, metavar="PNG", help="picture (default: RESULT_FOLDER/FIELD.png)")
    arguments = parser.parse_args()
    if arguments.strip is not None and arguments.strip < 1:
        parser.error("--strip needs a count of at least 1")

    outputs = find_outputs(arguments.folder)
    steps = choose_steps(outputs, arguments)
    displacements = read_displacements(arguments.folder)
    scale, unit = (1.0, "K") if is_heated_alone(arguments.folder) else (1e3, "mm")
    meshes = [meshio.read(outputs[step]) for step in steps]
    fields = [values_of(mesh, arguments.field) for mesh in meshes]
    lowest, highest = min(np.nanmin(values) for values in fields), max(np.nanmax(values) for values in fields)
    limits = lowest, highest if highest > lowest else lowest + 1.0
    figure, all_axes = plt.subplots(1, len(steps), figsize=(1 + 5 * len(steps), 5), layout="constrained", squeeze=False)
    for axes, step, mesh, values in zip(all_axes[0], steps, meshes, fields):
        picture = draw(axes, mesh, values, arguments.scale, limits)
        applied = f"at {scale * displacements[step]:.4g} {unit}" if step in displacements else f"in step {step}"
        axes.set_title(f"{arguments.field} {applied}")
    figure.colorbar(picture, ax=all_axes[0].tolist(), shrink=0.8)
    out = arguments.out or arguments.folder / f"{arguments.field}.png"
    figure.savefig(out, dpi=90)
    print(out)


if __name__ == "__main__":
    main()
