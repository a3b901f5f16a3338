#!/usr/bin/env python3
"""Shows a field of a result folder on the deformed body, with the broken bonds if the run wrote them, by PyVista.

    tools/view.py results/brazilian-disk
    tools/view.py results/brazilian-disk --step 45 --screenshot disk.png --point 0,0.02

Without --screenshot a window opens. --point prints the values of the point nearest to a position.
"""

import argparse
import sys
from pathlib import Path

import numpy as np
import pyvista

SIZE = (1000, 900)


def parse():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=Path, metavar="RESULT_FOLDER")
    parser.add_argument("--step", help="the step of a fields_NNNN.vtu, or 45:120 of fields_0045_0120.vtu [default: the last]")
    parser.add_argument("--field", default="damage", metavar="NAME", help="[default: damage]")
    parser.add_argument("--range", type=float, nargs=2, metavar=("LEAST", "LARGEST"), help="of the colours [default: 0 1 for damage]")
    parser.add_argument("--factor", type=float, help="times the displacement [default: such that it is 5 %% of the body]")
    parser.add_argument("--screenshot", type=Path, metavar="FILE.png")
    parser.add_argument("--point", metavar="X,Y", help="prints the values of the point nearest to this position, m")
    return parser, parser.parse_args()


def steps(folder):
    """Files of fields by their states in order: "45", or between breakages "45:120" before it."""
    numbers = lambda path: [int(it) for it in path.stem.removeprefix("fields_").split("_")]
    ordered = sorted(folder.glob("fields_*.vtu"), key=lambda path: (*numbers(path), float("inf")))
    return {":".join(map(str, numbers(path))): path for path in ordered}


def time_of(folder, file):
    series = pyvista.get_reader(folder / "fields.pvd")
    return next((dataset.time for dataset in series.datasets if dataset.path == file.name), None)


def is_mesh(grid):
    """The fields of a mesh are on its points, those of a lattice on its cells."""
    return "damage" in grid.point_data


def fields_of(grid):
    return grid.point_data if is_mesh(grid) else grid.cell_data


def default_factor(grid):
    largest = np.linalg.norm(grid.point_data["displacement"], axis=1).max()
    x0, x1, y0, y1, *_ = grid.bounds
    return float(f"{0.05 * max(x1 - x0, y1 - y0) / largest:.1g}") if largest > 0 else 1.0


def print_point(grid, position):
    fields = fields_of(grid)
    places = grid.points if is_mesh(grid) else grid.cell_centers().points
    nearest = int(np.linalg.norm(places[:, :2] - position, axis=1).argmin())
    x, y, _ = places[nearest]
    print(f"point at ({x:.9g}, {y:.9g})")
    for name in fields:
        values = np.atleast_1d(fields[name][nearest])
        print(f"{name},{','.join(repr(value.item()) for value in values)}")


def main():
    parser, arguments = parse()
    found = steps(arguments.folder)
    if not found:
        parser.error(f"{arguments.folder} has no fields_NNNN.vtu: it is no result folder of a run with loads")
    step = list(found)[-1] if arguments.step is None else arguments.step
    if step not in found:
        parser.error(f"there are no fields of step {step}, but of {', '.join(found)}")
    grid = pyvista.read(found[step])
    if arguments.field not in fields_of(grid):
        parser.error(f"there is no {arguments.field}, but {', '.join(fields_of(grid).keys())}")
    if arguments.point is not None:
        print_point(grid, [float(word) for word in arguments.point.split(",")])
    factor = default_factor(grid) if arguments.factor is None else arguments.factor
    limits = arguments.range or ((0, 1) if arguments.field.startswith("damage") else None)

    plotter = pyvista.Plotter(off_screen=arguments.screenshot is not None, window_size=SIZE)
    plotter.set_background("white")
    bar = {"title": arguments.field, "color": "black", "vertical": True, "fmt": "%.3g"}
    deformed = grid.warp_by_vector("displacement", factor=factor)
    plotter.add_mesh(deformed, scalars=arguments.field, clim=limits, cmap="cividis", scalar_bar_args=bar, lighting=False)
    bonds = found[step].with_name(found[step].name.replace("fields", "bonds", 1))
    if bonds.is_file():
        lines = pyvista.read(bonds).warp_by_vector("displacement", factor=factor)
        broken = lines.extract_cells(np.flatnonzero(lines.cell_data["intact"] == 0))
        if broken.n_cells:
            plotter.add_mesh(broken, color="#d55e00", opacity=0.3, line_width=1)
    time = time_of(arguments.folder, found[step])
    title = f"step {step}" + ("" if time is None else f", time {time:.4g}") + f", displacement times {factor:g}"
    plotter.add_text(title, font_size=10, color="black")
    plotter.view_xy()
    if arguments.screenshot is None:
        plotter.show()
    else:
        plotter.screenshot(arguments.screenshot)
        print(arguments.screenshot)
    return 0


if __name__ == "__main__":
    sys.exit(main())
