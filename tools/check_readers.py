#!/usr/bin/env python3
"""Checks that the files of a result folder mean the same to VTK, PyVista and meshio.

Prints one line per check and exits with status 1 if one failed. What a complete result folder holds must be there
unless --allow-missing names it.
"""

import argparse
import csv
import json
import math
import re
import sys
import xml.etree.ElementTree as ElementTree
from dataclasses import dataclass
from pathlib import Path

import meshio
import numpy as np
import pyvista
import vtk
from vtk.util.numpy_support import vtk_to_numpy

# Fields of every fields_NNNN.vtu and their numbers of components.
REQUIRED_FIELDS = {"displacement": 3, "rotation": 1, "damage": 1, "volume": 1, "horizon": 1}
# VTK's numbers for meshio's names of the cells that Ligament writes.
VTK_TYPES = {"vertex": 1, "line": 3, "triangle": 5, "quad": 9}
OPTIONAL_PARTS = ("fields", "bonds", "pvd", "history", "summary")


@dataclass
class Grid:
    """What one reader found in a VTU file."""

    points: np.ndarray
    cell_types: np.ndarray
    offsets: np.ndarray
    connectivity: np.ndarray
    point_fields: dict
    cell_fields: dict


class Report:
    """Prints and counts the checks."""

    def __init__(self):
        self.n_passed = self.n_failed = 0

    def check(self, what, passed, detail=""):
        self.n_passed += bool(passed)
        self.n_failed += not passed
        print(f"{'ok    ' if passed else 'FAILED'} {what}" + (f": {detail}" if detail else ""))
        return passed


def read_vtk(path):
    errors = []
    reader = vtk.vtkXMLUnstructuredGridReader()
    reader.AddObserver("ErrorEvent", lambda *_: errors.append("VTK reported an error"))
    reader.SetFileName(str(path))
    reader.Update()
    if errors or reader.GetErrorCode() != 0:
        raise ValueError(errors[0] if errors else f"VTK error code {reader.GetErrorCode()}")
    grid = reader.GetOutput()
    cells = grid.GetCells()

    def fields(data):
        arrays = [data.GetArray(i) for i in range(data.GetNumberOfArrays())]
        return {array.GetName(): vtk_to_numpy(array) for array in arrays}

    return Grid(
        vtk_to_numpy(grid.GetPoints().GetData()),
        np.array([grid.GetCellType(i) for i in range(grid.GetNumberOfCells())]),
        vtk_to_numpy(cells.GetOffsetsArray()),
        vtk_to_numpy(cells.GetConnectivityArray()),
        fields(grid.GetPointData()),
        fields(grid.GetCellData()),
    )


def read_pyvista(path):
    grid = pyvista.read(path)
    fields = dict(grid.point_data), dict(grid.cell_data)
    return Grid(grid.points, grid.celltypes, grid.cell_offsets, grid.cell_connectivity, *fields)


def read_meshio(path):
    mesh = meshio.read(path)
    sizes = [size for block in mesh.cells for size in [block.data.shape[1]] * len(block.data)]
    types = [VTK_TYPES[block.type] for block in mesh.cells for _ in block.data]
    return Grid(
        mesh.points,
        np.array(types),
        np.cumsum([0, *sizes]),
        np.concatenate([block.data.ravel() for block in mesh.cells]),
        mesh.point_data,
        {name: np.concatenate(blocks) for name, blocks in mesh.cell_data.items()},
    )


READERS = {"vtk": read_vtk, "pyvista": read_pyvista, "meshio": read_meshio}


def same(one, other):
    """Equal shapes and values, a NaN equal to a NaN."""
    one, other = np.asarray(one), np.asarray(other)
    return one.shape == other.shape and np.array_equal(one, other, equal_nan=one.dtype.kind == "f")


def differences(one, other):
    """Names of what two readers do not agree on."""
    found = [
        part
        for part in ("points", "cell_types", "offsets", "connectivity")
        if not same(getattr(one, part), getattr(other, part))
    ]
    for kind in ("point_fields", "cell_fields"):
        ours, theirs = getattr(one, kind), getattr(other, kind)
        found += [f"{kind} {name}" for name in ours.keys() ^ theirs.keys()]
        found += [f"{kind} {name}" for name in ours.keys() & theirs.keys() if not same(ours[name], theirs[name])]
    return found


def parse_xml(report, path):
    """The root element, or None if the file is not XML."""
    try:
        return ElementTree.parse(path).getroot()
    except ElementTree.ParseError as error:
        report.check(f"{path.name} is XML", False, str(error))
        return None


def check_grid(report, path):
    """Reads a VTU file with every reader; returns what VTK found, or None."""
    root = parse_xml(report, path)
    if root is None:
        return None
    formats = {array.get("format") for array in root.iter("DataArray")}
    compressed = root.get("compressor") == "vtkZLibDataCompressor" and formats == {"binary"}
    report.check(f"{path.name} is binary and compressed by zlib", compressed)
    grids = {}
    for name, read in READERS.items():
        try:
            grids[name] = read(path)
        except Exception as error:  # A reader may raise anything on a bad file; all of it is a failed check.
            report.check(f"{path.name} is read by {name}", False, repr(error))
    if len(grids) < len(READERS):
        return grids.get("vtk")
    grid = grids["vtk"]
    found = {name: differences(grid, other) for name, other in grids.items() if name != "vtk"}
    detail = "; ".join(f"{name} differs from vtk in {', '.join(parts)}" for name, parts in found.items() if parts)
    n_fields = len(grid.point_fields) + len(grid.cell_fields)
    size = f"{len(grid.points)} points, {len(grid.cell_types)} cells, {n_fields} arrays"
    report.check(f"{path.name} is the same to {', '.join(READERS)}", not detail, detail or size)
    return grid


def check_fields(report, path, volume):
    grid = check_grid(report, path)
    if grid is None:
        return
    # The fields of a mesh are on its points; those of a lattice on its cells, and the displacement on their corners too.
    on_cells = "damage" in grid.cell_fields
    fields, size = (grid.cell_fields, len(grid.cell_types)) if on_cells else (grid.point_fields, len(grid.points))
    if on_cells:
        check_corners(report, path, grid)
    for name, n_components in REQUIRED_FIELDS.items():
        shape = (size,) if n_components == 1 else (size, n_components)
        found = fields.get(name)
        detail = "missing" if found is None else f"shape {found.shape}"
        report.check(f"{path.name} has {name}", found is not None and found.shape == shape, detail)
    if volume is not None and "volume" in fields:
        total = math.fsum(fields["volume"])
        agrees = math.isclose(total, volume, rel_tol=1e-12)
        report.check(f"{path.name} volume sums to that of summary.json", agrees, f"{total!r} and {volume!r}")


def check_corners(report, path, grid):
    """Each cell of a lattice has four corners of its own, which move as it does."""
    n_cells = len(grid.cell_types)
    own = np.array_equal(grid.connectivity, np.arange(4 * n_cells))
    report.check(f"{path.name} has four corners a cell", own and set(grid.cell_types) == {VTK_TYPES["quad"]})
    report.check(f"{path.name} has only the displacement on corners", set(grid.point_fields) == {"displacement"})
    moved = np.repeat(grid.cell_fields["displacement"], 4, axis=0)
    report.check(f"{path.name} moves corners with cells", np.array_equal(grid.point_fields["displacement"], moved))


def step_of(file):
    match = re.fullmatch(r"fields_(\d+)\.vtu", file)
    return int(match.group(1)) if match else None


def read_history(path):
    """The last row of each step."""
    with open(path, newline="", encoding="utf-8") as file:
        return {int(row["step"]): row for row in csv.DictReader(file)}


def check_collection(report, path, history):
    root = parse_xml(report, path)
    if root is None:
        return
    datasets = root.findall("Collection/DataSet")
    listed = [(float(dataset.get("timestep")), dataset.get("file")) for dataset in datasets]
    series = pyvista.get_reader(path)
    same_list = sorted((dataset.time, dataset.path) for dataset in series.datasets) == sorted(listed)
    report.check(f"{path.name} is read by pyvista", same_list, f"{len(listed)} outputs")
    times = [time for time, _ in listed]
    report.check(f"{path.name} has no time twice", len(set(times)) == len(times))
    present = {file.name for file in path.parent.glob("fields_*.vtu")}
    stray = present ^ {file for _, file in listed}
    report.check(f"{path.name} lists each fields_NNNN.vtu", not stray, ", ".join(sorted(stray)))
    if history is None:
        return
    steps = [step_of(file) for _, file in listed]
    unknown = [file for step, (_, file) in zip(steps, listed) if step not in history]
    if not report.check(f"{path.name} lists steps of history.csv", not unknown, ", ".join(unknown)):
        return
    columns = [name for name in ("displacement", "reaction", "step") if all(name in history[step] for step in steps)]
    matching = [name for name in columns if all(float(history[step][name]) == time for step, time in zip(steps, times))]
    detail = f"column {matching[0]}" if matching else f"compared with {columns or 'no column'}"
    report.check(f"{path.name} has the times of history.csv", matching, detail)


def read_volume(path):
    return float(json.loads(path.read_text(encoding="utf-8"))["volume"])


def check_folder(report, folder, allowed):
    def find(part, pattern):
        paths = sorted(folder.glob(pattern))
        if not paths and part in allowed:
            print(f"absent {pattern}, as allowed")
        elif not paths:
            report.check(f"{folder} has {pattern}", False)
        return paths

    def load(part, name, read):
        """The content of a file, or None if it is missing or unreadable."""
        for path in find(part, name):
            try:
                return read(path)
            except (KeyError, ValueError, TypeError) as error:
                report.check(f"{name} is read", False, repr(error))
        return None

    volume = load("summary", "summary.json", read_volume)
    history = load("history", "history.csv", read_history)
    for path in find("fields", "fields_*.vtu"):
        check_fields(report, path, volume)
    for path in find("bonds", "bonds_*.vtu"):
        check_grid(report, path)
    for path in find("pvd", "fields.pvd"):
        check_collection(report, path, history)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=Path, metavar="RESULT_FOLDER")
    parser.add_argument(
        "--allow-missing",
        choices=OPTIONAL_PARTS,
        action="append",
        default=[],
        metavar="PART",
        help=f"do not fail if this part is absent: one of {', '.join(OPTIONAL_PARTS)}; may be repeated",
    )
    arguments = parser.parse_args()
    if not arguments.folder.is_dir():
        parser.error(f"{arguments.folder} is not a folder")
    report = Report()
    check_folder(report, arguments.folder, arguments.allow_missing)
    print(f"{report.n_passed} passed, {report.n_failed} failed")
    return 1 if report.n_failed else 0


if __name__ == "__main__":
    sys.exit(main())
