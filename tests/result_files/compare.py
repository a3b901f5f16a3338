"""Compares result files, as VTK, PyVista, meshio and Python's csv read them, with what the program had in memory.

The folder has a folder for each case, with the files in `results` and what they should hold in `expected.tsv` and
`expected.bin` (see expected.rs). Numbers must be equal bit for bit, but any NaN for a NaN.
"""

import csv
import sys
import xml.etree.ElementTree as ElementTree
from collections import defaultdict
from itertools import combinations
from pathlib import Path

import numpy as np
import pyvista
import vtk

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "tools"))
from check_readers import READERS  # noqa: E402

# What a result folder may hold beside the expected files, and why it is not compared with memory.
NOT_COMPARED = {
    "case.resolved.toml": "no result",
    "summary.json": "no table",
    "checkpoint.bin": "for the program alone",
    "timings.csv": "two runs take different times; its form is checked",
    "yield.csv": "statistics of points.vtu, from which they are computed here",
    "distribution.svg": "a drawing",
}
# Components of fields that are the same everywhere in a body, and why.
CONSTANT = {
    ("point", "displacement", 2): "planar",
    ("cell", "displacement", 2): "planar",
    ("point", "reaction", 2): "planar",
    ("cell", "reaction", 2): "planar",
    ("point", "stress_direction", 2): "planar",
    ("cell", "stress_direction", 2): "planar",
    ("point", "stress", 2): "planar",
    ("point", "stress", 4): "planar",
    ("point", "stress", 5): "planar",
    ("point", "stress_effective", 2): "planar",
    ("point", "stress_effective", 4): "planar",
    ("point", "stress_effective", 5): "planar",
    ("point", "stress_virial", 2): "planar",
    ("point", "stress_virial", 4): "planar",
    ("point", "stress_virial", 5): "planar",
    ("cell", "stress", 2): "planar",
    ("cell", "stress", 4): "planar",
    ("cell", "stress", 5): "planar",
    ("cell", "stress_virial", 2): "planar",
    ("cell", "stress_virial", 4): "planar",
    ("cell", "stress_virial", 5): "planar",
    ("point", "held", 0): "no point of a mesh comes loose",
    ("cell", "nearest_distance", 0): "all points of a lattice have the same",
    ("cell", "volume", 0): "all points of a lattice have the same",
    ("cell", "horizon", 0): "all points of a lattice have the same",
}
# Pairs of fields that are equal for a reason.
EQUAL = {
    ("toughness_ratio.mixed-mode-x", "toughness_ratio.mixed-mode-y"): "both have that of the material",
    ("mixed_mode_exponent.mixed-mode-x", "mixed_mode_exponent.mixed-mode-y"): "both have that of the material",
    ("strength_tension_least_strain", "strength_shear_least_strain"): "the largest stretch decides in both",
}
TYPES = {"f8": np.dtype("<f8"), "f4": np.dtype("<f4"), "i8": np.dtype("<i8")}
VTK_TYPES = {1: 1, 2: 3, 3: 5, 4: 9}


def read_expected(folder):
    """Arrays by file, part and name; component names beside them; columns of text as lists."""
    numbers = (folder / "expected.bin").read_bytes()
    found = defaultdict(dict)
    for line in (folder / "expected.tsv").read_text(encoding="utf-8").splitlines():
        file, part, name, kind, components, offset, count = line.split("\t")
        names = components.split(",") if components else []
        if kind == "text":
            values = count.split("|") if count else []
        else:
            values = np.frombuffer(numbers, TYPES[kind], int(count), int(offset))
            values = values.reshape(-1, len(names)) if names else values
        assert (part, name) not in found[file], f"{file} is to have {part} {name} twice"
        found[file][part, name] = values, names
    return found


def same(found, wanted):
    """Equal shapes, types and bits, any NaN for a NaN."""
    found = np.ascontiguousarray(found)
    if (found.shape, found.dtype) != (wanted.shape, wanted.dtype):
        return False
    if found.dtype.kind != "f":
        return np.array_equal(found, wanted)
    bits = f"<u{found.dtype.itemsize}"
    equal = found.view(bits) == np.ascontiguousarray(wanted).view(bits)
    return bool((equal | (np.isnan(found) & np.isnan(wanted))).all())


def cells_of(counted):
    """Types, offsets and corners of cells that stand one after the other, each behind the number of its corners."""
    types, offsets, corners, at = [], [0], [], 0
    while at < len(counted):
        size = int(counted[at])
        types.append(VTK_TYPES[size])
        offsets.append(offsets[-1] + size)
        corners.extend(counted[at + 1 : at + 1 + size].tolist())
        at += 1 + size
    return np.array(types), np.array(offsets), np.array(corners)


def component_names(path):
    """Names of the components of each array, which VTK alone of the readers gives."""
    reader = vtk.vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(path))
    reader.Update()
    grid = reader.GetOutput()
    found = {}
    for part, data in (("point", grid.GetPointData()), ("cell", grid.GetCellData())):
        for k in range(data.GetNumberOfArrays()):
            array = data.GetArray(k)
            count = array.GetNumberOfComponents()
            found[part, array.GetName()] = [array.GetComponentName(i) or "" for i in range(count)] if count > 1 else []
    return found


def check_grid(path, expected):
    """Faults of a file of fields."""
    faults = []
    types, offsets, corners = cells_of(expected["cells", ""][0])
    fields = {key: values for key, (values, _) in expected.items() if key[0] in ("point", "cell", "field")}
    for name, read in READERS.items():
        grid = read(path)
        parts = {
            "points": same(grid.points, expected["points", ""][0]),
            "types": np.array_equal(grid.cell_types, types),
            "offsets": np.array_equal(grid.offsets, offsets),
            "connectivity": np.array_equal(grid.connectivity, corners),
        }
        faults += [f"{name}: {part}" for part, is_good in parts.items() if not is_good]
        found = {("point", key): values for key, values in grid.point_fields.items()}
        found |= {("cell", key): values for key, values in grid.cell_fields.items()}
        found |= {("field", key): values for key, values in grid.field_data.items()}
        faults += [f"{name}: no field {part} {key}" for part, key in fields.keys() - found.keys()]
        faults += [f"{name}: field {part} {key} is not expected" for part, key in found.keys() - fields.keys()]
        for part, key in fields.keys() & found.keys():
            if not same(found[part, key], fields[part, key]):
                faults.append(f"{name}: values of {part} {key}")
    for key, names in component_names(path).items():
        if key in expected and names != expected[key][1]:
            faults.append(f"vtk: components of {key} are {names}")
    return faults


def check_collection(path, expected):
    times, files = expected["column", "timestep"][0], expected["column", "file"][0]
    wanted = sorted(zip(times.tolist(), files))
    datasets = ElementTree.parse(path).getroot().findall("Collection/DataSet")
    found = sorted((float(dataset.get("timestep")), dataset.get("file")) for dataset in datasets)
    series = pyvista.get_reader(path)
    by_pyvista = sorted((dataset.time, dataset.path) for dataset in series.datasets)
    faults = [] if found == wanted else [f"lists {found}"]
    return faults + ([] if by_pyvista == wanted else [f"pyvista: {by_pyvista}"])


def check_table(path, expected):
    with open(path, newline="", encoding="utf-8") as file:
        reader = csv.DictReader(file)
        rows = list(reader)
        header = reader.fieldnames
    names = [name for _, name in expected]
    if header != names:
        return [f"columns are {header}"]
    faults, numeric = [], []
    for place, (_, name) in enumerate(expected):
        wanted = expected["column", name][0]
        texts = [row[name] for row in rows]
        if isinstance(wanted, list):
            faults += [] if texts == wanted else [f"csv: column {name}"]
            continue
        read = int if wanted.dtype.kind == "i" else float
        if not same(np.array([read(text) for text in texts], wanted.dtype), wanted):
            faults.append(f"csv: column {name}")
        numeric.append((place, name, wanted))
    if numeric and rows:
        places = [place for place, _, _ in numeric]
        table = np.loadtxt(path, delimiter=",", skiprows=1, usecols=places, quotechar='"', ndmin=2, encoding="utf-8")
        for column, (_, name, wanted) in zip(table.T, numeric):
            if not same(np.array(column), wanted.astype(np.float64)):
                faults.append(f"numpy: column {name}")
    return faults


def check_timings(path, steps):
    table = np.genfromtxt(path, delimiter=",", names=True)
    seconds = np.array([table[name] for name in table.dtype.names[1:]])
    is_good = np.array_equal(table["step"], steps) and np.isfinite(seconds).all() and (seconds >= 0).all()
    return [] if is_good else ["steps or times"]


def check_statistics(path, grid):
    """yield.csv against the errors of the points (NaN where nothing yields) that it sums up."""
    fields = {name: values for (part, name), (values, _) in grid.items() if part in ("point", "cell")}
    tags = fields.get("node", fields.get("cell"))
    faults, n_rows = [], 0
    with open(path, newline="", encoding="utf-8") as file:
        for row in csv.DictReader(file):
            n_rows += 1
            name = f"{row['criterion'].replace(' ', '_')}_{row['strain']}"
            # Where some orientation never yields the error is infinite, which the field shows as NaN.
            errors, never = fields[f"{name}_error"], np.isnan(fields[f"{name}_least_strain"])
            errors = np.where(np.isnan(errors) & ~never, np.inf, errors)
            counts = ~np.isnan(errors) & ((fields["interior"] == 1) | (row["points"] == "all"))
            # The mean is summed in another order.
            mean = np.isclose(float(row["mean"]), errors[counts].mean(), rtol=1e-12, atol=0)
            worst = np.flatnonzero(counts)[errors[counts].argmax()]
            exact = (
                int(row["count"]) == counts.sum()
                and float(row["worst"]) == errors[worst]
                and int(row["worst_point"]) == tags[worst]
                and float(row["worst_orientation_deg"]) == fields[f"{name}_worst_orientation"][worst]
            )
            faults += [] if mean and exact else [f"{row['criterion']} {row['strain']} {row['points']}"]
    return faults + ([] if n_rows else ["no rows"])


def kind_of(file):
    """fields_NNNN.vtu and the like are of one kind."""
    return file.translate(str.maketrans("", "", "0123456789"))


class Variety:
    """Which numbers could be exchanged without a comparison noticing."""

    def __init__(self):
        self.varies = {}
        self.differ = {}
        # Of fields with one value a file.
        self.values = defaultdict(set)

    def see(self, file, expected):
        columns = defaultdict(list)
        for (part, name), (values, _) in expected.items():
            if isinstance(values, list) or part in ("points", "cells"):
                continue
            table = values.reshape(len(values), -1)
            for component, column in enumerate(table.T):
                key = kind_of(file), part, name, component
                numbers = column[~np.isnan(column)] if column.dtype.kind == "f" else column
                if len(numbers) == 1:
                    self.values[key].update(numbers.tolist())
                varies = len(np.unique(numbers)) > 1 or len(self.values[key]) > 1
                self.varies[key] = self.varies.get(key, False) or varies
                columns[part, values.dtype].append((key, column))
        for group in columns.values():
            for (one, first), (other, second) in combinations(group, 2):
                self.differ[one, other] = self.differ.get((one, other), False) or not same(first, second)

    def faults(self):
        faults, used = [], set()
        for (kind, part, name, component), varies in self.varies.items():
            key = part, name, component
            if varies or part == "column":
                continue
            used.add(key)
            if key not in CONSTANT:
                faults.append(f"{kind}: {part} {name} {component} is the same everywhere in all cases")
        for (one, other), differ in self.differ.items():
            if differ or one[1] == "column" or any(key[1:] in CONSTANT for key in (one, other)):
                continue
            pair = one[2], other[2]
            used.add(pair)
            if pair not in EQUAL:
                faults.append(f"{one} and {other} are the same in all cases: exchanged, nobody would notice")
        # An exception that is none any more hides what it should show.
        faults += [f"{key} is listed as an exception and is none" for key in (CONSTANT.keys() | EQUAL.keys()) - used]
        return faults


def main(root):
    variety = Variety()
    n_files = n_arrays = 0
    faults = []
    for folder in sorted(path for path in root.iterdir() if path.is_dir()):
        expected = read_expected(folder)
        present = {path.name for path in (folder / "results").iterdir()}
        faults += [f"{folder.name}: {file} is missing" for file in expected.keys() - present]
        faults += [f"{folder.name}: {file} is not expected" for file in present - expected.keys() - NOT_COMPARED.keys()]
        checks = {".vtu": check_grid, ".pvd": check_collection, ".csv": check_table}
        for file in sorted(expected.keys() & present):
            path = folder / "results" / file
            found = checks[path.suffix](path, expected[file])
            faults += [f"{folder.name}/{file}: {fault}" for fault in found]
            variety.see(file, expected[file])
            n_files, n_arrays = n_files + 1, n_arrays + len(expected[file])
        for file, check, on in (("timings.csv", check_timings, "history.csv"), ("yield.csv", check_statistics, "points.vtu")):
            if file in present:
                wanted = expected[on]["column", "step"][0] if on == "history.csv" else expected[on]
                found = check(folder / "results" / file, wanted)
                faults += [f"{folder.name}/{file}: {fault}" for fault in found]
    faults += variety.faults()
    if faults or n_files == 0:
        print("\n".join(faults))
        return 1
    fields = {key[:3] for key in variety.varies if key[1] in ("point", "cell")}
    print(f"all files hold what the program had in memory: {n_files} files, {n_arrays} arrays, {len(fields)} fields")
    return 0


sys.exit(main(Path(sys.argv[1])))
