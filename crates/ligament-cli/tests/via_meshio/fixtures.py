"""Writes a Gmsh mesh of triangles with its groups in formats of other programs: by hand where meshio's writers lose groups.

Beside the groups of the mesh there is `half`, the triangles whose middle has x below that of the whole.
"""

import sys
from pathlib import Path

import meshio
import netCDF4
import numpy as np

CURVES = ("left", "right", "bottom", "top")


class Plate:
    def __init__(self, path):
        mesh = meshio.read(path)
        self.points = mesh.points
        self.triangles = mesh.cells_dict["triangle"]
        self.corner = int(mesh.cells_dict["vertex"][0][0])
        lines = mesh.cells_dict["line"]
        numbers = np.concatenate([d for b, d in zip(mesh.cells, mesh.cell_data["gmsh:physical"]) if b.type == "line"])
        self.lines = {name: lines[numbers == mesh.field_data[name][0]] for name in CURVES}
        middle = self.points[self.triangles].mean(axis=1)[:, 0]
        self.half = np.flatnonzero(middle < self.points[:, 0].mean())

    def sides_at_top(self):
        """Triangles and numbers of their sides (from 1) that are edges of the top."""
        edges = {frozenset(edge) for edge in self.lines["top"].tolist()}
        found = []
        for k, cell in enumerate(self.triangles.tolist()):
            found += [(k, side + 1) for side in range(3) if frozenset((cell[side], cell[(side + 1) % 3])) in edges]
        return found

    def meshio_mesh(self):
        """Lines and triangles with a number for each part: 1 the half, 2 the rest, 3 to 6 the curves."""
        lines = np.concatenate([self.lines[name] for name in CURVES])
        of_lines = np.concatenate([np.full(len(self.lines[name]), 3 + k) for k, name in enumerate(CURVES)])
        of_triangles = np.full(len(self.triangles), 2)
        of_triangles[self.half] = 1
        cells = [("line", lines), ("triangle", self.triangles)]
        return meshio.Mesh(self.points, cells, cell_data={"part": [of_lines, of_triangles]})


def abaqus(plate, path):
    """Numbers of nodes as in the Gmsh file; sets by lists, GENERATE, at *ELEMENT and of sets; a surface by sides of elements.

    A part, and an assembly with one instance of it, as Abaqus/CAE writes them.
    """
    out = ["*Heading", "** made by hand", "*Part, name=plate", "*Node, nset=all-nodes"]
    out += [f"{k}, {x!r}, {y!r}, 0." for k, (x, y, _) in enumerate(plate.points.tolist(), 1)]
    number, first = 1, {}
    out.append("*Element, type=T2D2")
    for name in CURVES:
        first[name] = number
        for a, b in plate.lines[name].tolist():
            out.append(f"{number}, {a + 1}, {b + 1}")
            number += 1
        first[name + " end"] = number - 1
    # Two blocks of one set, of which the second is the larger.
    triangles = number
    for block in (plate.triangles[:5], plate.triangles[5:]):
        out.append("*ELEMENT, TYPE=CPE3, ELSET=plate")
        for corners in block.tolist():
            out.append(", ".join(str(it) for it in [number, *(corner + 1 for corner in corners)]))
            number += 1
    out += ["*End Part", "*Assembly, name=all", "*Instance, name=plate-1, part=plate", "*End Instance"]
    out += ["*Nset, nset=corner, instance=plate-1", f"{plate.corner + 1},"]
    out += ["*Nset, nset=NODES-OF-LEFT", *(f"{node + 1}," for node in sorted({*plate.lines["left"].ravel().tolist()}))]
    for name in ("left", "bottom", "top"):
        out += [f"*Elset, elset={name}, generate", f"{first[name]}, {first[name + ' end']}, 1"]
    out.append("*Elset, elset=right")
    ids = list(range(first["right"], first["right end"] + 1))
    out += [", ".join(str(it) for it in ids[k : k + 4]) + "," for k in range(0, len(ids), 4)]
    out += ["*Elset, elset=ends", "LEFT, right"]
    out += ["*Elset, elset=half", *(f"{triangles + k}" for k in plate.half.tolist())]
    out.append("*Surface, type=ELEMENT, name=top-of-cells")
    out += [f"{triangles + k}, S{side}" for k, side in plate.sides_at_top()]
    out += ["*End Assembly", "*Material, name=rock", "*Elastic", "15e9, 0.21"]
    path.write_text("\n".join(out) + "\n")


def nastran(plate, path):
    mesh = plate.meshio_mesh()
    out = ["CEND", "BEGIN BULK"]
    out += [f"GRID,{10 * k + 7},,{x!r},{y!r},0.0" for k, (x, y, _) in enumerate(plate.points.tolist())]
    number = 0
    for block, parts in zip(mesh.cells, mesh.cell_data["part"]):
        kind = "CROD" if block.type == "line" else "CTRIA3"
        for nodes, part in zip(block.data.tolist(), parts.tolist()):
            number += 1
            out.append(",".join(str(it) for it in [kind, number, part, *(10 * node + 7 for node in nodes)]))
    path.write_text("\n".join([*out, "ENDDATA"]) + "\n")


def medit(plate, path):
    mesh = plate.meshio_mesh()
    out = ["MeshVersionFormatted 2", "Dimension", "2", "Vertices", str(len(plate.points))]
    out += [f"{x!r} {y!r} {9 if k == plate.corner else 0}" for k, (x, y, _) in enumerate(plate.points.tolist())]
    for block, parts, name in zip(mesh.cells, mesh.cell_data["part"], ("Edges", "Triangles")):
        out += [name, str(len(parts))]
        out += [" ".join(str(it) for it in [*(n + 1 for n in nodes), part]) for nodes, part in zip(block.data.tolist(), parts.tolist())]
    path.write_text("\n".join([*out, "End"]) + "\n")


def med(plate, path):
    mesh = plate.meshio_mesh()
    families = {-1: ["plate", "half"], -2: ["plate"], -3: ["left"], -4: ["right"], -5: ["bottom"], -6: ["top"]}
    points = np.zeros(len(plate.points), dtype=int)
    points[plate.corner] = 4
    tags = [-parts for parts in mesh.cell_data["part"]]
    out = meshio.Mesh(plate.points[:, :2], mesh.cells, cell_data={"cell_tags": tags}, point_data={"point_tags": points})
    out.cell_tags, out.point_tags = families, {4: ["corner"]}
    out.write(path)


def exodus(plate, path):
    """Two blocks of triangles, node sets, one without a name, and a side set."""
    rest = np.setdiff1d(np.arange(len(plate.triangles)), plate.half)
    order = np.concatenate([plate.half, rest])
    number = {int(k): place + 1 for place, k in enumerate(order)}
    with netCDF4.Dataset(path, "w", format="NETCDF3_64BIT_OFFSET") as file:
        for name, size in [("len_name", 33), ("num_dim", 2), ("num_nodes", len(plate.points)), ("num_el_blk", 2),
                           ("num_node_sets", 2), ("num_side_sets", 1), ("num_elem", len(order))]:
            file.createDimension(name, size)

        def put(name, kind, dimensions, values):
            variable = file.createVariable(name, kind, dimensions)
            variable[:] = values
            return variable

        def texts(name, dimension, words):
            rows = [[c.encode() for c in word.ljust(33, "\0")] for word in words]
            put(name, "S1", (dimension, "len_name"), np.array(rows, dtype="S1"))

        put("coordx", "f8", ("num_nodes",), plate.points[:, 0])
        put("coordy", "f8", ("num_nodes",), plate.points[:, 1])
        put("eb_prop1", "i4", ("num_el_blk",), [10, 20])
        texts("eb_names", "num_el_blk", ["half", ""])
        for k, cells in ((1, plate.half), (2, rest)):
            file.createDimension(f"num_el_in_blk{k}", len(cells))
            file.createDimension(f"num_nod_per_el{k}", 3)
            variable = put(f"connect{k}", "i4", (f"num_el_in_blk{k}", f"num_nod_per_el{k}"), plate.triangles[cells] + 1)
            variable.elem_type = "TRI3"
        put("ns_prop1", "i4", ("num_node_sets",), [5, 7])
        texts("ns_names", "num_node_sets", ["corner", ""])
        for k, nodes in ((1, [plate.corner]), (2, sorted({*plate.lines["left"].ravel().tolist()}))):
            file.createDimension(f"num_nod_ns{k}", len(nodes))
            put(f"node_ns{k}", "i4", (f"num_nod_ns{k}",), np.array(nodes) + 1)
        sides = plate.sides_at_top()
        put("ss_prop1", "i4", ("num_side_sets",), [3])
        texts("ss_names", "num_side_sets", ["top"])
        file.createDimension("num_side_ss1", len(sides))
        put("elem_ss1", "i4", ("num_side_ss1",), [number[k] for k, _ in sides])
        put("side_ss1", "i4", ("num_side_ss1",), [side for _, side in sides])


def unfit(plate, folder):
    """Meshes that are to be refused, or of which part is left out."""
    points, triangles = plate.points, plate.triangles
    tilted = points.copy()
    tilted[:, 2] = points[:, 1]
    tilted[:, 1] = 0.0
    meshio.Mesh(tilted, [("triangle", triangles)]).write(folder / "upright.vtu")
    meshio.Mesh(points, [("line", plate.lines["left"])]).write(folder / "lines.vtu")
    (folder / "broken.vtu").write_text("<VTKFile")
    (folder / "moved.inp").write_text("*Node\n1, 0, 0\n*Instance, name=one, part=plate\n1., 0., 0.\n*End Instance\n")
    (folder / "two.inp").write_text("*Node\n1, 0, 0\n*Node\n2, 0, 0\n")
    (folder / "set.inp").write_text("*Node\n1, 0, 0\n2, 1, 0\n3, 0, 1\n*Element, type=CPS3\n1, 1, 2, 3\n*Elset, elset=a\n7\n")
    (folder / "unknown.xyz").write_text("1 2 3\n")
    # Six nodes a triangle, numbers of cells, and a name that a curve and a surface have by chance.
    second = meshio.Mesh(
        [[0, 0, 0], [2, 0, 0], [0, 2, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [5, 5, 0]],
        [("triangle6", [[0, 1, 2, 3, 4, 5]]), ("line", [[0, 1]])],
        cell_data={"side": [np.array([1]), np.array([1])]},
    )
    second.write(folder / "second-order.vtu")


def main(source, folder):
    plate = Plate(source)
    abaqus(plate, folder / "plate.inp")
    nastran(plate, folder / "plate.bdf")
    medit(plate, folder / "plate.mesh")
    med(plate, folder / "plate.med")
    exodus(plate, folder / "plate.e")
    for name in ("plate.vtu", "plate.vtk", "plate.xdmf"):
        plate.meshio_mesh().write(folder / name)
    unfit(plate, folder)


main(Path(sys.argv[1]), Path(sys.argv[2]))
