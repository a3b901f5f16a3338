#!/usr/bin/env python3
"""Checks that the files of a result folder mean the same to VTK, PyVista and meshio.

Prints one line per check and exits with status 1 if one failed. What a complete result folder holds must be there
unless --allow-missing names it. Times of every series must grow, and be those of its files, whose field data are the numbers
of the history. Of a solid the files of `ligament crack` (crack.vtu, opened.vtu, iso.vtu, and those of all
steps) are checked where they are, or must be there with --with-surfaces.
"""

import argparse
import csv
import json
import math
import re
import sys
import xml.etree.ElementTree as ElementTree
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path

import meshio
import numpy as np
import pyvista
import vtk
from vtk.util.numpy_support import vtk_to_numpy

# Fields of every fields_NNNN.vtu and their numbers of components; a point of a solid turns about three axes.
REQUIRED_FIELDS = {"displacement": 3, "damage": 1, "volume": 1, "horizon": 1}
# VTK's numbers for meshio's names of the cells that Ligament writes.
VTK_TYPES = {"vertex": 1, "line": 3, "triangle": 5, "quad": 9, "tetra": 10, "hexahedron": 12, "wedge": 13, "pyramid": 14}
# The cells of solids, and their corners.
SOLID_CORNERS = {10: 4, 12: 8, 13: 6, 14: 5}
# Fields of the files of `ligament crack` on points and cells, of a solid.
SURFACE_FIELDS = {
    "crack": ({"opening", "sliding", "load_factor", "step"}, {"part", "precrack"}),
    "opened": ({"displacement", "damage", "strain_energy_density"}, {"cell_of_mesh"}),
    "iso": ({"displacement", "damage", "volume", "horizon"}, set()),
}
# Field data of the states of a run, and their columns in history.csv.
STATE_NUMBERS = {"load_factor": "load_factor", "load_displacement": "displacement", "load_reaction": "reaction"}
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
    field_data: dict


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
        fields(grid.GetFieldData()),
    )


def read_pyvista(path):
    grid = pyvista.read(path)
    fields = dict(grid.point_data), dict(grid.cell_data), dict(grid.field_data)
    return Grid(grid.points, grid.celltypes, grid.cell_offsets, grid.cell_connectivity, *fields)


def corners_of(block):
    """The corners of meshio's cells in the order of the file: it turns both triangles of a wedge round when it reads one."""
    return block.data[:, [0, 2, 1, 3, 5, 4]] if block.type == "wedge" else block.data


def read_meshio(path):
    mesh = meshio.read(path)
    sizes = [size for block in mesh.cells for size in [block.data.shape[1]] * len(block.data)]
    types = [VTK_TYPES[block.type] for block in mesh.cells for _ in block.data]
    return Grid(
        mesh.points,
        np.array(types),
        np.cumsum([0, *sizes]),
        np.concatenate([corners_of(block).ravel() for block in mesh.cells]),
        mesh.point_data,
        {name: np.concatenate(blocks) for name, blocks in mesh.cell_data.items()},
        mesh.field_data,
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
    for kind in ("point_fields", "cell_fields", "field_data"):
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
    is_solid = set(grid.cell_types) <= SOLID_CORNERS.keys()
    if is_solid:
        check_solid_cells(report, path, grid, volume)
    for name, n_components in (REQUIRED_FIELDS | {"rotation": 3 if is_solid else 1}).items():
        shape = (size,) if n_components == 1 else (size, n_components)
        found = fields.get(name)
        detail = "missing" if found is None else f"shape {found.shape}"
        report.check(f"{path.name} has {name}", found is not None and found.shape == shape, detail)
    if volume is not None and "volume" in fields:
        total = math.fsum(fields["volume"])
        agrees = math.isclose(total, volume, rel_tol=1e-12)
        report.check(f"{path.name} volume sums to that of summary.json", agrees, f"{total!r} and {volume!r}")


def check_solid_cells(report, path, grid, volume):
    """The cells of a solid have the corners of their kind, positive volumes to VTK, and the volume of the body together."""
    corners = [SOLID_CORNERS[kind] for kind in grid.cell_types]
    report.check(f"{path.name} has the corners of its cells", np.array_equal(np.diff(grid.offsets), corners))
    sizes = pyvista.read(path).compute_cell_sizes(length=False, area=False, volume=True).cell_data["Volume"]
    report.check(f"{path.name} has no inverted cell", min(sizes) > 0.0, f"smallest volume {min(sizes):.3g}")
    if volume is not None:
        total = math.fsum(sizes)
        # VTK parts cells that are no tetrahedra by itself.
        report.check(f"{path.name} cells fill the volume", math.isclose(total, volume, rel_tol=1e-6), f"{total!r} and {volume!r}")


def check_corners(report, path, grid):
    """Each cell of a lattice has four corners of its own, in space eight, which move as it does."""
    n_cells = len(grid.cell_types)
    count, kind = (4, VTK_TYPES["quad"]) if VTK_TYPES["quad"] in grid.cell_types else (8, VTK_TYPES["hexahedron"])
    own = np.array_equal(grid.connectivity, np.arange(count * n_cells))
    report.check(f"{path.name} has {count} corners a cell", own and set(grid.cell_types) == {kind})
    report.check(f"{path.name} has only the displacement on corners", set(grid.point_fields) == {"displacement"})
    moved = np.repeat(grid.cell_fields["displacement"], count, axis=0)
    report.check(f"{path.name} moves corners with cells", np.array_equal(grid.point_fields["displacement"], moved))


def check_surface(report, path):
    """A file of `ligament crack`: triangles of a crack or of a value of a field, or cells that open."""
    grid = check_grid(report, path)
    if grid is None:
        return
    kind = re.match("[a-z]+", path.name)[0]
    on_points, on_cells = SURFACE_FIELDS[kind]
    missing = (on_points - grid.point_fields.keys()) | (on_cells - grid.cell_fields.keys())
    report.check(f"{path.name} has its fields", not missing, ", ".join(sorted(missing)))
    known = SOLID_CORNERS.keys() if kind == "opened" else {VTK_TYPES["triangle"]}
    report.check(f"{path.name} has the right cells", set(grid.cell_types) <= known, str(set(grid.cell_types)))
    used = np.unique(grid.connectivity)
    report.check(f"{path.name} uses all of its points", kind == "opened" or len(used) == len(grid.points))
    finite = [name for name, values in grid.point_fields.items() if not np.isfinite(values).all() and name != "load_factor"]
    report.check(f"{path.name} has finite values", not finite, ", ".join(finite))


def check_stl(report, path):
    """The crack as STL has the triangles of crack.vtu, at their places to single precision."""
    surface, solid = pyvista.read(path.with_suffix(".vtu")), meshio.read(path)
    triangles = surface.points[surface.cells.reshape(-1, 4)[:, 1:]]
    found = solid.points[solid.cells_dict["triangle"]]
    same_places = found.shape == triangles.shape and np.allclose(found, triangles, rtol=1e-6, atol=1e-7 * np.abs(triangles).max())
    report.check(f"{path.name} has the triangles of crack.vtu", same_places, f"{len(found)} triangles")


def check_surfaces(report, folder, required):
    """The files of `ligament crack` on a solid."""
    for name in ("crack", "opened", "iso"):
        paths = [path for path in sorted(folder.glob(f"{name}*.vtu")) if set(pyvista.read(path).celltypes) != {VTK_TYPES["line"]}]
        if required and not paths and not (name == "opened" and is_of_boxes(folder)):
            report.check(f"{folder} has {name}.vtu", False)
        for path in paths:
            check_surface(report, path)
    for path in folder.glob("crack.stl"):
        check_stl(report, path)


def is_of_boxes(folder):
    """Whether the cells of the body are boxes of one point each, which move apart as they are."""
    paths = sorted(folder.glob("fields_*.vtu"))
    return bool(paths) and "damage" in pyvista.read(paths[0]).cell_data


def step_of(file):
    match = re.fullmatch(r"[a-z]+_(\d+)\.p?vtu", file)
    return int(match.group(1)) if match else None


def read_history(path):
    """The last row of each step."""
    with open(path, newline="", encoding="utf-8") as file:
        return {int(row["step"]): row for row in csv.DictReader(file)}


def times_to_vtk(path):
    """The times that VTK finds in a file."""
    reader = vtk.vtkXMLPUnstructuredGridReader() if path.suffix == ".pvtu" else vtk.vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(path))
    reader.UpdateInformation()
    information, key = reader.GetOutputInformation(0), vtk.vtkStreamingDemandDrivenPipeline.TIME_STEPS()
    return [information.Get(key, place) for place in range(information.Length(key))] if information.Has(key) else []


def check_collection(report, path, history):
    """A series: times that grow, and files of its own with these times and the numbers of the history."""
    root = parse_xml(report, path)
    if root is None:
        return
    datasets = root.findall("Collection/DataSet")
    listed = [(float(dataset.get("timestep")), dataset.get("file")) for dataset in datasets]
    series = pyvista.get_reader(path)
    same_list = [(dataset.time, dataset.path) for dataset in series.datasets] == listed
    report.check(f"{path.name} is read by pyvista", same_list, f"{len(listed)} outputs")
    times = [time for time, _ in listed]
    report.check(f"{path.name} has times that grow", all(before < after for before, after in pairwise(times)), str(times))
    present = {file.name for ending in ("vtu", "pvtu") for file in path.parent.glob(f"{path.stem}_????.{ending}")}
    stray = present ^ {file for _, file in listed}
    if not report.check(f"{path.name} lists each {path.stem}_NNNN", not stray, ", ".join(sorted(stray))):
        return
    for time, file in listed:
        found = pyvista.read(path.with_name(file)).field_data
        expected = {"TimeValue": time}
        if history is not None:
            row = history[step_of(file)]
            expected |= {name: float(row[column]) for name, column in STATE_NUMBERS.items()}
            expected["TimeValue"] = float(row.get("time", row["step"]))
        is_same = all(name in found and list(found[name]) == [number] for name, number in expected.items())
        report.check(f"{file} has the time of {path.name} and the numbers of the history", is_same, f"{dict(found)} for {expected}")
        report.check(f"{file} has its time to VTK", times_to_vtk(path.with_name(file)) == [time])


def read_volume(path):
    return float(json.loads(path.read_text(encoding="utf-8"))["volume"])


def check_folder(report, folder, allowed, with_surfaces):
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
    find("pvd", "fields.pvd")
    for path in sorted(folder.glob("*.pvd")):
        check_collection(report, path, history if path.stem != "modes" else None)
    check_surfaces(report, folder, with_surfaces)


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
    parser.add_argument("--with-surfaces", action="store_true", help="fail if the files of `ligament crack` of a solid are absent")
    arguments = parser.parse_args()
    if not arguments.folder.is_dir():
        parser.error(f"{arguments.folder} is not a folder")
    report = Report()
    check_folder(report, arguments.folder, arguments.allow_missing, arguments.with_surfaces)
    print(f"{report.n_passed} passed, {report.n_failed} failed")
    return 1 if report.n_failed else 0


if __name__ == "__main__":
    sys.exit(main())
