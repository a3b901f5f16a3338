"""Reads the sample written by python_readers.rs with each reader and compares it with the same formulas."""

import csv
import sys
from pathlib import Path

import meshio
import numpy as np
import pyvista
import vtk
from vtk.util.numpy_support import vtk_to_numpy

N_ROW = 64


def expected():
    index = np.arange(N_ROW * N_ROW)
    x, y = (index % N_ROW) * 0.1, (index // N_ROW) / 3.0
    zero = np.zeros_like(x)
    damage = x / (1.0 + y)
    damage[1:4] = np.nan, -np.inf, -0.0
    first = (np.arange(N_ROW - 1)[:, None] * N_ROW + np.arange(N_ROW - 1)).ravel()
    quads = np.column_stack([first, first + 1, first + N_ROW + 1, first + N_ROW])
    cells = [*quads.tolist(), [0, 1, 64], [0, 4095], [7]]
    cells += [[0, 1, 64, 4095], [0, 1, 65, 64, 128, 129, 193, 192], [0, 1, 64, 128, 129, 192], [0, 1, 65, 64, 4095]]
    material = np.arange(len(cells))
    limits = np.iinfo(np.int64)
    material[:2] = limits.max, limits.min
    displacement = np.column_stack([x * y, -x, zero])
    point_fields = {"damage": damage, "displacement": displacement, "n_bonds <&>": index - 5}
    point_fields["single"] = damage.astype(np.float32)
    point_fields["stress"] = np.column_stack([x, y, x - y])
    return np.column_stack([x, y, x * y - 1.0]), cells, point_fields, {"material": material}


def cells_from_offsets(connectivity, offsets):
    return [cell.tolist() for cell in np.split(np.asarray(connectivity), np.asarray(offsets)[1:-1])]


def read_vtk(path):
    errors = []
    reader = vtk.vtkXMLUnstructuredGridReader()
    reader.AddObserver("ErrorEvent", lambda *_: errors.append("VTK reported an error"))
    reader.SetFileName(str(path))
    reader.Update()
    assert not errors and reader.GetErrorCode() == 0, errors
    grid = reader.GetOutput()
    array = grid.GetCells()
    cells = cells_from_offsets(vtk_to_numpy(array.GetConnectivityArray()), vtk_to_numpy(array.GetOffsetsArray()))

    def fields(data):
        arrays = [data.GetArray(i) for i in range(data.GetNumberOfArrays())]
        return {array.GetName(): vtk_to_numpy(array) for array in arrays}

    return vtk_to_numpy(grid.GetPoints().GetData()), cells, fields(grid.GetPointData()), fields(grid.GetCellData())


def read_pyvista(path):
    grid = pyvista.read(path)
    cells = cells_from_offsets(grid.cell_connectivity, grid.cell_offsets)
    return grid.points, cells, dict(grid.point_data), dict(grid.cell_data)


def in_vtk_order(block):
    """The corners of cells as they stand in the file: meshio turns the triangles of a prism round."""
    return block.data[:, [0, 2, 1, 3, 5, 4]] if block.type == "wedge" else block.data


def read_meshio(path):
    mesh = meshio.read(path)
    cells = [cell for block in mesh.cells for cell in in_vtk_order(block).tolist()]
    cell_data = {name: np.concatenate(blocks) for name, blocks in mesh.cell_data.items()}
    return mesh.points, cells, mesh.point_data, cell_data


def assert_same(found, wanted, what):
    """Same shape, type and bits, but any NaN for a NaN."""
    found = np.ascontiguousarray(found)
    assert (found.shape, found.dtype) == (wanted.shape, wanted.dtype), (what, found.shape, found.dtype)
    same = (found == wanted) & (np.signbit(found) == np.signbit(wanted)) | (found != found) & (wanted != wanted)
    assert same.all(), (what, np.argwhere(~same)[:5])


def check_series(folder):
    times = [0.0, 1e-7, 0.1 + 0.2]
    series = pyvista.get_reader(folder / "fields.pvd")
    assert series.time_values == sorted(times), series.time_values
    listed = sorted((dataset.time, dataset.path) for dataset in series.datasets)
    wanted = sorted((time, f"fields & {step:04}.vtu") for step, time in enumerate(times))
    assert listed == wanted, listed
    return [folder / file for _, file in listed]


def check_grid(path, points, cells, fields):
    for read in (read_vtk, read_pyvista, read_meshio):
        found_points, found_cells, *found_fields = read(path)
        assert_same(found_points, points, (read.__name__, "points"))
        assert found_cells == cells, (read.__name__, "cells")
        for found, wanted in zip(found_fields, fields, strict=True):
            assert found.keys() == wanted.keys(), (read.__name__, found.keys())
            for name, values in wanted.items():
                assert_same(found[name], values, (read.__name__, name))


def check_history(path, reactions):
    with open(path, newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    assert [int(row["step"]) for row in rows] == list(range(len(reactions)))
    assert_same(np.array([float(row["reaction, kN"]) for row in rows]), reactions, "csv")
    assert {row["status"] for row in rows} == {'a "quoted", text\nin two lines'}


def main(folder):
    points, cells, *fields = expected()
    for path in check_series(folder):
        check_grid(path, points, cells, fields)
    check_history(folder / "history.csv", fields[0]["damage"])
    print("all readers agree")


main(Path(sys.argv[1]))
