"""Reads a mesh by the Python package meshio and writes it to standard output for `ligament mesh --via-meshio`.

The output has the sections `remarks`, `nodes`, `cells` and `groups`, each with its number of lines behind its name:

    nodes N     a tag and two coordinates, of a solid three, with as many digits as it takes to read the same bits back
    cells N     three or four corners each, of a solid four, five, six or eight, nodes by their places from 0
    groups N    dimension, number of members and name; then a line with a node, two nodes, the nodes of a face of a solid or the place
                of a cell for each member

and ends in `end`. Where there is no such mesh it is `error`, the kind of the fault and the reason in lines of their own, and the exit
status is 1.
"""

import sys

# Packages come from where Python has them, never from the current folder, which may hold a file called numpy.py.
sys.path = [place for place in sys.path if place not in ("", ".")]

import contextlib
import io
import re
from pathlib import Path

# Distinct values of cell data at most that are taken for the numbers of groups: more are numbers of cells.
MOST_VALUES = 100
# Cell data in which 0 stands for no group.
ZERO_IS_NONE = ("medit:ref", "su2:tag", "ugrid:ref", "cell_tags", "point_tags", "gmsh:physical")
# Cell data that say nothing of groups.
NO_GROUPS = ("gmsh:geometrical", "vtkOriginalCellIds", "vtkGhostType", "vtkOriginalPointIds")
# Elements of the plane and of trusses that Abaqus has and meshio 5.3 does not know: continuum elements by their numbers of nodes.
ABAQUS_ELEMENTS = {"3": "triangle", "4": "quad", "6": "triangle6", "8": "quad8"}
ABAQUS_SOLIDS = {
    "4": "tetra", "5": "pyramid", "6": "wedge", "8": "hexahedron", "10": "tetra10", "15": "wedge15", "20": "hexahedron20",
}
KIND = ("points", "curve", "surface", "volume")
# Cells by the beginning of their names in meshio: dimension and corners, which stand first.
SHAPES = {
    "vertex": (0, 1), "line": (1, 2), "triangle": (2, 3), "quad": (2, 4), "tetra": (3, 4), "pyramid": (3, 5), "wedge": (3, 6),
    "hexahedron": (3, 8), "pixel": (2, 4), "voxel": (3, 8),
}
# Sides of solid cells by their numbers of corners: Abaqus, User's Manual, "Solid elements"; Exodus II manual, "Side sets".
SIDES_OF_ABAQUS = {
    4: ("123", "142", "243", "341"),
    5: ("1234", "152", "253", "354", "451"),
    6: ("123", "465", "1452", "2563", "3641"),
    8: ("1234", "5876", "1562", "2673", "3784", "4851"),
}
SIDES_OF_EXODUS = {
    4: ("124", "234", "143", "132"),
    5: ("125", "235", "345", "154", "1432"),
    6: ("1254", "2365", "1463", "132", "456"),
    8: ("1265", "2376", "3487", "1584", "1432", "5678"),
}
# Corners of the cells of images in the order of quadrangles and hexahedra, and their numbers in VTK.
IMAGE_CELLS = {"pixel": (8, [0, 1, 3, 2]), "voxel": (11, [0, 1, 3, 2, 4, 5, 7, 6])}


class Unfit(Exception):
    """A mesh that cannot be used: the kind of the fault, and its reason."""


class Remarks(list):
    def add(self, text):
        if text not in self:
            self.append(text)


def counted(count, one, several=None):
    return f"{count} {one if count == 1 else several or one + 's'}"


def one_line(text):
    return " ".join(str(text).split())


# Reading


def read(meshio, path, file_format):
    """The mesh, from a path or an open file, and what meshio said on the way."""
    said = io.StringIO()
    try:
        with contextlib.redirect_stdout(said), contextlib.redirect_stderr(said):
            mesh = meshio.read(path, file_format)
    except (Exception, SystemExit) as error:  # A reader may raise anything on a file it does not understand.
        kind = "unknown-format" if "deduce file format" in str(error) else "unreadable"
        if isinstance(error, ModuleNotFoundError):
            raise Unfit("no-package", error.name) from error
        lines = [line for line in said.getvalue().splitlines() if line.strip()]
        if not isinstance(error, SystemExit):
            is_of_meshio = isinstance(error, meshio.ReadError)
            lines.append(str(error) if is_of_meshio and str(error) else f"{type(error).__name__}: {error}")
        raise Unfit(kind, "\n".join(lines)) from error
    lines = (one_line(line) for line in said.getvalue().splitlines())
    return mesh, [f"meshio: {line}" for line in lines if line]


def know_more_elements_of_abaqus(meshio):
    """CPS, CPE, CAX and the like of all sizes and variants, beside the few that meshio knows."""
    known = getattr(getattr(meshio.abaqus, "_abaqus", None), "abaqus_to_meshio_type", None)
    if known is None:
        return
    for family in ("CPS", "CPE", "CPEG", "CAX", "M3D", "S", "STRI", "SFM3D"):
        for nodes, kind in ABAQUS_ELEMENTS.items():
            for variant in ("", "R", "H", "I", "M", "T", "P", "RH", "IH", "MH", "RT", "RS", "5", "R5"):
                known.setdefault(f"{family}{nodes}{variant}", kind)
    for nodes, kind in ABAQUS_SOLIDS.items():
        for variant in ("", "R", "H", "I", "M", "T", "P", "S", "RH", "IH", "MH", "RT", "RS", "HT", "MT", "RP", "IS"):
            known.setdefault(f"C3D{nodes}{variant}", kind)


def know_cells_of_images(meshio):
    """Pixels and voxels of VTK, which meshio names but cannot read."""
    for name, (number, corners) in IMAGE_CELLS.items():
        meshio._vtk_common.vtk_to_meshio_type[number] = name
        meshio._common.num_nodes_per_cell.setdefault(name, len(corners))
        meshio._mesh.topological_dimension.setdefault(name, SHAPES[name][0])


class Elements:
    """The elements of a mesh by dimension: corners, and where they stand in the blocks of meshio."""

    def __init__(self, mesh, remarks):
        self.nodes = ([], [], [], [])
        # For each block its dimension, and the place of each of its elements among those of that dimension.
        self.places = []
        shapes = [shape_of(block) for block in mesh.cells]
        # Of cells: a solid where there is a solid cell, else in the plane.
        self.top = 3 if any(shape is not None and shape[0] == 3 for shape in shapes) else 2
        higher, foreign = 0, {}
        for block, shape in zip(mesh.cells, shapes):
            if shape is None:
                foreign[block.type] = foreign.get(block.type, 0) + len(block.data)
                self.places.append((None, []))
                continue
            dimension, corners = shape
            if dimension == self.top and block.data.shape[1] > corners:
                higher += len(block.data)
            into = self.nodes[dimension]
            self.places.append((dimension, range(len(into), len(into) + len(block.data))))
            _, order = IMAGE_CELLS.get(block.type, (None, slice(corners)))
            into.extend(block.data[:, order].tolist())
        if foreign:
            kinds = ", ".join(f"{counted(count, kind)}" for kind, count in foreign.items())
            raise Unfit("foreign-cells", kinds)
        if not self.nodes[self.top]:
            found = ", ".join(f"{counted(len(block.data), block.type)}" for block in mesh.cells)
            raise Unfit("no-cells", found or "no cells at all")
        if higher:
            what = counted(higher, "cell of higher order was", "cells of higher order were")
            remarks.add(f"{what} read by the corner nodes alone")

    def of(self, members):
        """Elements by dimension, of places in each block of meshio."""
        found = ([], [], [], [])
        for (dimension, places), inside in zip(self.places, members):
            if dimension is not None and inside is not None:
                found[dimension].extend(places[int(k)] for k in inside)
        return found


def shape_of(block):
    """Dimension and number of corners of the cells of a block, whose corners stand first; None of those that are not read."""
    if block.type == "polygon":
        return (2, block.data.shape[1]) if block.data.shape[1] in (3, 4) else None
    match = re.fullmatch(r"([a-z]+)\d*", block.type)
    return SHAPES.get(match[1]) if match else None


# Groups


class Groups:
    """Named groups: by name and dimension, with their members."""

    def __init__(self, elements, remarks):
        self.members = {}
        self.remarks = remarks
        self.elements = elements

    def add(self, name, dimension, members, source):
        """Members of dimension 0 are nodes, else places of elements."""
        name = one_line(name).replace('"', "'")
        members = list(dict.fromkeys(int(member) for member in members))
        if not name:
            name = f"unnamed-{KIND[dimension]}"
        nodes = self.nodes(dimension, members)
        clash = next((key for key in self.members if key[0] == name), None)
        # A case takes all groups of a name together: groups that only happen to share it must not.
        if clash is not None and self.nodes(clash[1], self.members[clash]) != nodes:
            new = f"{name}-{KIND[dimension]}"
            while any(key[0] == new for key in self.members):
                new += "-2"
            kind, other = KIND[dimension], KIND[clash[1]]
            self.remarks.add(f"{source} and another group ({other}) have the name `{name}`: the {kind} is now `{new}`")
            name = new
        self.members[name, dimension] = list(dict.fromkeys([*self.members.get((name, dimension), []), *members]))

    def add_elements(self, name, by_dimension, source):
        """What is one group in the file keeps its name in all dimensions."""
        held = [k for k in (3, 2, 1, 0) if by_dimension[k]]
        name = one_line(name).replace('"', "'")
        if not held:
            self.remarks.add(f"{source} has no elements that are read, and was left out")
            return
        if len(held) == 1 or any(key[0] == name for key in self.members):
            for k in held:
                self.add(name, k, self.points(by_dimension[0]) if k == 0 else by_dimension[k], source)
            return
        for k in held:
            self.members[name, k] = self.points(by_dimension[0]) if k == 0 else list(dict.fromkeys(by_dimension[k]))

    def points(self, places):
        return [self.elements.nodes[0][place][0] for place in places]

    def nodes(self, dimension, members):
        if dimension == 0:
            return set(members)
        return {node for member in members for node in self.elements.nodes[dimension][member]}


def add_sets(mesh, groups, numpy):
    """Named sets of points and cells."""
    for name, points in mesh.point_sets.items():
        groups.add(name, 0, numpy.asarray(points).ravel(), f"the point set `{name}`")
    for name, members in mesh.cell_sets.items():
        if name.startswith("gmsh:"):
            continue
        if len(members) != len(mesh.cells):
            raise Unfit("unreadable", f"the cell set {name} has {len(members)} parts for {len(mesh.cells)} blocks of cells")
        groups.add_elements(name, groups.elements.of(members), f"the cell set `{name}`")


def names_of(key, value, dimension, mesh):
    """Names of the groups that a value of cell data (or of point data, for dimension None) stands for."""
    families = {"cell_tags": getattr(mesh, "cell_tags", {}), "point_tags": getattr(mesh, "point_tags", {})}
    if key in families:
        return families[key].get(value, [f"family-{value}"])
    for name, numbers in mesh.field_data.items():
        try:
            if [int(number) for number in numbers][:2] == [value, dimension]:
                return [name]
        except (TypeError, ValueError):
            continue
    return [f"{key.rpartition(':')[2]}-{value}"]


def add_data(mesh, groups, remarks, numpy):
    """Integers at cells that stand for groups."""
    for key, blocks in mesh.cell_data.items():
        if key in NO_GROUPS or any(block.dtype.kind not in "iu" or block.ndim != 1 for block in blocks):
            continue
        values = numpy.unique(numpy.concatenate(blocks)) if blocks else []
        if len(values) > MOST_VALUES:
            remarks.add(f"the cell data `{key}` have {len(values)} different values: no groups were made of them")
            continue
        # Several values may share the name of a group, as families of MED do; several dimensions never a value.
        members = {}
        for value in values:
            if value == 0 and key in ZERO_IS_NONE:
                continue
            found = groups.elements.of([numpy.flatnonzero(block == value) for block in blocks])
            for dimension in (3, 2, 1, 0):
                if found[dimension]:
                    for name in names_of(key, int(value), dimension, mesh):
                        members.setdefault((name, dimension), []).extend(found[dimension])
        of_families = key == "cell_tags"
        by_name = {}
        for (name, dimension), inside in members.items():
            by_name.setdefault(name, [[], [], [], []])[dimension] = inside
        for name, by_dimension in by_name.items():
            source = f"the cell data `{key}`"
            if of_families:
                groups.add_elements(name, by_dimension, source)
                continue
            for dimension in (3, 2, 1, 0):
                if by_dimension[dimension]:
                    inside = by_dimension[dimension]
                    groups.add(name, dimension, groups.points(inside) if dimension == 0 else inside, source)


def add_point_data(mesh, groups, numpy):
    """Families of nodes of MED and reference numbers of vertices; other point data are values, not groups."""
    for key in ("point_tags", "medit:ref"):
        values = mesh.point_data.get(key)
        if values is None:
            continue
        members = {}
        for value in numpy.unique(values):
            if value != 0:
                for name in names_of(key, int(value), None, mesh):
                    members.setdefault(name, []).extend(numpy.flatnonzero(values == value))
        for name, nodes in members.items():
            groups.add(name, 0, nodes, f"the point data `{key}`")


# Abaqus: meshio 5.3 gives the set of an *ELEMENT line to the block of the wrong number, and stumbles over sets of sets: it gets nodes
# and elements alone.


class Abaqus:
    """Numbers of nodes and elements and the sets of an input file, and its lines with nodes and elements."""

    def __init__(self, path):
        self.geometry = []
        self.nodes, self.elements = [], []
        self.node_sets, self.element_sets, self.surfaces = {}, {}, {}
        self.blocks_of_nodes = self.instances = 0
        self.keyword, self.parameters, self.rest = "", {}, []
        with open(path, encoding="utf-8", errors="replace") as file:
            for line in file:
                line = line.strip()
                if line.startswith("**") or not line:
                    continue
                if line.startswith("*"):
                    self.begin(line)
                else:
                    if self.keyword in ("NODE", "ELEMENT"):
                        self.geometry.append(line.rstrip(","))
                    self.take([word.strip() for word in line.rstrip(",").split(",")], line.endswith(","))

    def begin(self, line):
        words = [word.strip() for word in line[1:].split(",")]
        self.keyword = words[0].upper()
        pairs = [word.partition("=") for word in words[1:]]
        self.parameters = {key.strip().upper(): value.strip().strip('"') for key, _, value in pairs}
        self.rest = []
        if self.keyword == "NODE":
            self.blocks_of_nodes += 1
            self.geometry.append("*NODE")
        if self.keyword == "ELEMENT":
            self.geometry.append(f"*ELEMENT, TYPE={self.parameters.get('TYPE', '').upper()}")
        self.instances += self.keyword == "INSTANCE"
        if self.blocks_of_nodes > 1 or self.instances > 1 or self.keyword == "INCLUDE":
            what = "several *NODE blocks" if self.blocks_of_nodes > 1 else "several instances" if self.instances > 1 else "*INCLUDE"
            raise Unfit("unreadable", f"the file has {what}, which are not put together: write an input file of one part")
        for keyword, sets in (("NSET", self.node_sets), ("ELSET", self.element_sets)):
            if self.keyword in ("NODE", "ELEMENT", keyword) and keyword in self.parameters:
                if (self.keyword == "NODE") == (keyword == "NSET") or self.keyword == keyword:
                    self.into = sets.setdefault(self.parameters[keyword], [])
        if self.keyword == "SURFACE":
            self.into = self.surfaces.setdefault(self.parameters.get("NAME", ""), [])

    def take(self, words, is_continued):
        if self.keyword == "NODE":
            self.nodes.append(int(words[0]))
            if "NSET" in self.parameters:
                self.into.append(int(words[0]))
        elif self.keyword == "ELEMENT":
            # The nodes of an element may go on in the next line.
            if not self.rest:
                self.elements.append(int(words[0]))
                if "ELSET" in self.parameters:
                    self.into.append(int(words[0]))
            self.rest = words if is_continued else []
        elif self.keyword in ("NSET", "ELSET") and self.keyword in self.parameters:
            words = [word for word in words if word]
            if "GENERATE" in self.parameters:
                first, last, step = (int(word) for word in (words + ["1"])[:3])
                self.into.extend(range(first, last + 1, step))
            else:
                self.into.extend(int(word) if word.isdigit() else word for word in words)
        elif self.keyword == "SURFACE" and len(words) == 2:
            self.into.append(tuple(words))
        elif self.keyword == "INSTANCE":
            raise Unfit("unreadable", "the file has an instance of a part that is moved: write an input file of the part alone")

    def resolved(self, sets, name, above=()):
        """The numbers of a set, with those of the sets that it names."""
        key = next((key for key in sets if key.upper() == name.upper()), None)
        if key is None or key in above:
            raise Unfit("unreadable", f"the set {name} is not in the file" if key is None else f"the set {name} contains itself")
        numbers = []
        for member in sets[key]:
            numbers.extend([member] if isinstance(member, int) else self.resolved(sets, member, (*above, key)))
        return numbers


def add_abaqus(file, mesh, groups, remarks):
    """The sets of an Abaqus file."""
    if len(file.nodes) != len(mesh.points) or len(file.elements) != sum(len(block.data) for block in mesh.cells):
        raise Unfit("unreadable", "meshio and the lines of the file differ in their numbers of nodes or elements")
    node_of = {number: place for place, number in enumerate(file.nodes)}
    flat = [(dimension, place) for dimension, places in groups.elements.places for place in places]
    element_of = dict(zip(file.elements, flat))

    def element(number, name):
        if number not in element_of:
            raise Unfit("unreadable", f"{name} has the element {number}, which the file does not have")
        return element_of[number]

    for name in file.element_sets:
        by_dimension = ([], [], [], [])
        for number in file.resolved(file.element_sets, name):
            dimension, place = element(number, name)
            by_dimension[dimension].append(place)
        groups.add_elements(name, by_dimension, f"the element set `{name}`")
    for name in file.node_sets:
        numbers = file.resolved(file.node_sets, name)
        unknown = [number for number in numbers if number not in node_of]
        if unknown:
            raise Unfit("unreadable", f"{name} has the node {unknown[0]}, which the file does not have")
        groups.add(name, 0, [node_of[number] for number in numbers], f"the node set `{name}`")
    for name, sides in file.surfaces.items():
        found = []
        for where, side in sides:
            numbers = [int(where)] if where.isdigit() else file.resolved(file.element_sets, where)
            match = re.fullmatch(r"[SE](\d)", side.upper())
            if match is None:
                remarks.add(f"the surface `{name}` has the side {side}, and was left out")
                found = []
                break
            found += [side_of(*element(number, name), int(match[1]), groups, SIDES_OF_ABAQUS) for number in numbers]
        add_sides(name, found, groups, f"the surface `{name}`")


def side_of(dimension, place, side, groups, sides_of_solids):
    """The corners of a side of a cell: of one in the plane numbered from 1 at its first corner, of a solid one by a table."""
    corners = groups.elements.nodes[dimension][place]
    sides = sides_of_solids[len(corners)] if dimension == 3 else corners
    if dimension < 2 or not 1 <= side <= len(sides):
        raise Unfit("unreadable", f"there is no side {side} of an element with {len(corners)} corners")
    if dimension == 3:
        return [corners[int(corner) - 1] for corner in sides[side - 1]]
    return [corners[side - 1], corners[side % len(corners)]]


def add_sides(name, sides, groups, source):
    """A curve or surface whose edges or faces are no elements of the file."""
    if sides:
        dimension = 1 if len(sides[0]) == 2 else 2
        elements = groups.elements.nodes[dimension]
        elements.extend(sides)
        groups.add(name, dimension, range(len(elements) - len(sides), len(elements)), source)


# Exodus: meshio 5.3 leaves out blocks, side sets and node sets without names.


def add_exodus(path, groups, remarks):
    import netCDF4

    with netCDF4.Dataset(path) as file:
        file.set_auto_mask(False)

        def names(key, ids, kind):
            stored = file.variables.get(key)
            texts = [b"".join(row).decode("utf-8").strip("\x00 ") for row in stored[:]] if stored is not None else []
            numbers = file.variables[ids][:].tolist() if ids in file.variables else range(1, 1 + len(texts))
            texts += [""] * (len(numbers) - len(texts))
            return [text or f"{kind}-{number}" for text, number in zip(texts, numbers)]

        # Places of all elements in the order of the file, which is that of their numbers.
        flat = []
        blocks = [key for key in file.variables if re.fullmatch(r"connect\d+", key)]
        order = sorted(range(len(blocks)), key=lambda k: int(blocks[k][7:]))
        for k, name in zip(order, names("eb_names", "eb_prop1", "block")):
            dimension, places = groups.elements.places[k]
            flat += [(dimension, place) for place in places]
            by_dimension = ([], [], [], [])
            by_dimension[dimension].extend(places)
            groups.add_elements(name, by_dimension, f"the element block `{name}`")
        for k, name in enumerate(names("ns_names", "ns_prop1", "node-set"), 1):
            if f"node_ns{k}" in file.variables:
                groups.add(name, 0, file.variables[f"node_ns{k}"][:] - 1, f"the node set `{name}`")
        for k, name in enumerate(names("ss_names", "ss_prop1", "side-set"), 1):
            if f"elem_ss{k}" not in file.variables:
                continue
            elements = file.variables[f"elem_ss{k}"][:].tolist()
            if len(file.dimensions["num_dim"]) != 2 and any(flat[number - 1][0] != 3 for number in elements):
                remarks.add(f"the side set `{name}` was left out: sides of shells in space are numbered otherwise")
                continue
            sides = zip(elements, file.variables[f"side_ss{k}"][:].tolist())
            found = [side_of(*flat[number - 1], side, groups, SIDES_OF_EXODUS) for number, side in sides]
            add_sides(name, found, groups, f"the side set `{name}`")


def is_exodus(path):
    with open(path, "rb") as file:
        begin = file.read(8)
    return path.suffix.lower() in (".e", ".exo", ".ex2") or begin[:3] == b"CDF"


# Writing


def planar(mesh, used, plane):
    """Coordinates in the plane of the used nodes, which must be the given one."""
    points = mesh.points
    if points.shape[1] < 3:
        return points
    axes = [*map("xyz".index, plane)]
    axes.append(3 - sum(axes))
    points = points[:, axes]
    spans = [float(points[used, axis].max() - points[used, axis].min()) for axis in range(3)]
    # The same as for nodes of a Gmsh file.
    if spans[2] > 1e-9 * max(spans):
        flat = [axis for axis, span in zip(axes, spans) if span <= 1e-9 * max(spans)]
        own = flat and "xyz".replace("xyz"[flat[0]], "")
        hint = f"{'xyz'[flat[0]]} is the same everywhere: give `--plane {own}`" if flat else "it is curved or inclined"
        raise Unfit("not-planar", f"{'xyz'[axes[2]]} goes from {points[used, 2].min():.6g} to {points[used, 2].max():.6g}; {hint}")
    return points


def tags_of(mesh, abaqus):
    """The numbers of the nodes in their program where they are known and good, else 1, 2, 3."""
    found = getattr(mesh, "points_id", None) if abaqus is None else abaqus.nodes
    if found is not None and len(found) == len(mesh.points):
        tags = [int(tag) for tag in found]
        if min(tags) > 0 and len(set(tags)) == len(tags):
            return tags
    return list(range(1, 1 + len(mesh.points)))


def hand_over(mesh, plane, elements, groups, tags, remarks, out):
    cells, is_solid = elements.nodes[elements.top], elements.top == 3
    used = sorted({node for cell in cells for node in cell})
    points = mesh.points if is_solid else planar(mesh, used, plane)
    place = {node: k for k, node in enumerate(used)}
    unused = len(mesh.points) - len(used)
    if unused:
        corner = "corner of a solid cell" if is_solid else "corner of a triangle or quadrangle"
        what = counted(unused, f"node that no {corner} uses was", f"nodes that no {corner} uses were")
        remarks.add(f"{what} dropped")
    lines, n_groups = [], 0
    for (name, dimension), members in groups.members.items():
        if dimension == elements.top:
            rows = [str(member) for member in members]
        else:
            nodes = [[member] if dimension == 0 else elements.nodes[dimension][member] for member in members]
            rows = [" ".join(str(place[node]) for node in ends) for ends in nodes if all(node in place for node in ends)]
        if len(rows) < len(members):
            lost = counted(len(members) - len(rows), "member")
            remarks.add(f"{lost} of the group `{name}` ({KIND[dimension]}) on no corner of a cell dropped")
        if rows:
            n_groups += 1
            lines += [f"{dimension} {len(rows)} {name}", *rows]
    print(f"remarks {len(remarks)}", *remarks, sep="\n", file=out)
    print(f"nodes {len(used)}", file=out)
    for node in used:
        print(tags[node], *(repr(float(it)) for it in points[node, : elements.top]), file=out)
    print(f"cells {len(cells)}", file=out)
    for cell in cells:
        print(*(place[node] for node in cell), file=out)
    print(f"groups {n_groups}", *lines, "end", sep="\n", file=out)


def main(path, plane, file_format):
    try:
        import meshio
        import numpy
    except ModuleNotFoundError as error:
        raise Unfit("no-package", error.name) from error
    with open(path, "rb") as file:
        if file.read(11) == b"$MeshFormat":
            raise Unfit("is-gmsh", "")
    if file_format and file_format not in meshio._helpers.reader_map:
        raise Unfit("unknown-format", ", ".join(sorted(meshio._helpers.reader_map)))
    abaqus = None
    if file_format == "abaqus" or not file_format and path.suffix.lower() == ".inp":
        abaqus = Abaqus(path)
        know_more_elements_of_abaqus(meshio)
        mesh, said = read(meshio, io.StringIO("\n".join(abaqus.geometry)), "abaqus")
    else:
        know_cells_of_images(meshio)
        mesh, said = read(meshio, path, file_format)
    remarks = Remarks(said)
    elements = Elements(mesh, remarks)
    groups = Groups(elements, remarks)
    if abaqus is not None:
        add_abaqus(abaqus, mesh, groups, remarks)
    elif file_format == "exodus" or not file_format and is_exodus(path):
        add_exodus(path, groups, remarks)
    else:
        add_sets(mesh, groups, numpy)
    add_data(mesh, groups, remarks, numpy)
    add_point_data(mesh, groups, numpy)
    out = io.StringIO()
    hand_over(mesh, plane, elements, groups, tags_of(mesh, abaqus), remarks, out)
    sys.stdout.write(out.getvalue())


try:
    sys.stdout.reconfigure(encoding="utf-8", newline="\n")
    main(Path(sys.argv[1]), sys.argv[2], sys.argv[3] if len(sys.argv) > 3 else None)
except Unfit as fault:
    print("error", *fault.args, sep="\n")
    sys.exit(1)
