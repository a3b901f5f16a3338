"""Writes a block of hexahedra, prisms, pyramids and tetrahedra with groups of all kinds in formats that meshio and people write.

The block goes from x = 0 to 4 with two cells of size 1 along y and z: a layer of hexahedra, one of prisms, one of pyramids (of which the
last faces are split in two for tetrahedra) and one of tetrahedra. Its groups are the volumes `first` (x < 2) and `second`, the surfaces
`left` (four quadrangles) and `right` (eight triangles), the curve `edge` (y = z = 0) and the point `corner` (the origin).
"""

import sys
from pathlib import Path

import meshio
import netCDF4
import numpy as np

ORDER = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)]
SIZES = (4, 2, 2)


class Block:
    def __init__(self):
        axes = [np.arange(count + 1.0) for count in SIZES]
        points = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, 3).tolist()
        number = {tuple(point): place for place, point in enumerate(points)}
        # Kind of cell to cells, each with the layer that it is of.
        self.cells = {"hexahedron": [], "wedge": [], "pyramid": [], "tetra": []}
        self.left, self.right = [], []
        for layer in range(4):
            for y in range(2):
                for z in range(2):
                    c = [number[layer + i, y + j, z + k] for i, j, k in ORDER]
                    if layer == 0:
                        self.left.append([c[0], c[4], c[7], c[3]])
                        self.add(layer, "hexahedron", c)
                    elif layer == 1:
                        self.add(layer, "wedge", [c[k] for k in (0, 1, 2, 4, 5, 6)], [c[k] for k in (0, 2, 3, 4, 6, 7)])
                    elif layer == 2:
                        apex = len(points)
                        points.append([layer + 0.5, y + 0.5, z + 0.5])
                        sides = [(0, 1, 2, 3), (4, 7, 6, 5), (0, 4, 5, 1), (3, 2, 6, 7), (0, 3, 7, 4)]
                        self.add(layer, "pyramid", *([*(c[k] for k in side), apex] for side in sides))
                        self.add(layer, "tetra", [c[1], c[2], c[6], apex], [c[1], c[6], c[5], apex])
                    else:
                        splits = [(0, 1, 2, 6), (0, 2, 3, 6), (0, 3, 7, 6), (0, 7, 4, 6), (0, 4, 5, 6), (0, 5, 1, 6)]
                        self.add(layer, "tetra", *([c[k] for k in split] for split in splits))
                        self.right += [[c[1], c[2], c[6]], [c[1], c[6], c[5]]]
        self.points = np.array(points)
        self.edge = [[number[x, 0, 0], number[x + 1, 0, 0]] for x in range(4)]
        self.corner = number[0, 0, 0]

    def add(self, layer, kind, *cells):
        self.cells[kind] += [(layer, cell) for cell in cells]

    def mesh(self, is_grouped=True):
        """Blocks of one part each, as the writer of Gmsh's 4.1 wants them, with a number for each part and one for each entity."""
        blocks, parts = [("vertex", [[self.corner]]), ("line", self.edge), ("quad", self.left), ("triangle", self.right)], [6, 5, 3, 4]
        dimensions = [0, 1, 2, 2]
        for kind, cells in self.cells.items():
            for part in (1, 2):
                rows = [cell for layer, cell in cells if (layer < 2) == (part == 1)]
                if rows:
                    blocks.append((kind, rows))
                    parts.append(part)
                    dimensions.append(3)
        numbers = [np.full(len(rows), part) for (_, rows), part in zip(blocks, parts)]
        if not is_grouped:
            return meshio.Mesh(self.points, blocks, cell_data={"part": numbers})
        names = {"first": (1, 3), "second": (2, 3), "left": (3, 2), "right": (4, 2), "edge": (5, 1), "corner": (6, 0)}
        # Each node lies on an entity, and the writer describes those of nodes alone: the last four are the apexes of pyramids.
        on = np.zeros((len(self.points), 2), dtype=int)
        entities = range(1, 1 + len(blocks))
        of_blocks = [it for it in zip(blocks, entities, dimensions) if it[0][0] != "pyramid"]
        for (_, rows), entity, dimension in reversed(of_blocks):
            on[np.unique(rows)] = [dimension, entity]
        on[-4:] = [3, 1 + [kind for kind, _ in blocks].index("pyramid")]
        return meshio.Mesh(
            self.points,
            blocks,
            point_data={"gmsh:dim_tags": on},
            cell_data={"gmsh:physical": numbers, "gmsh:geometrical": [0 * it + k for it, k in zip(numbers, entities)]},
            field_data={name: np.array(it) for name, it in names.items()},
        )


def abaqus(block, path):
    """Sets at *ELEMENT, of nodes, and surfaces by sides of elements as Abaqus numbers them."""
    out = ["*Heading", "*Node"]
    out += [f"{k}, {x!r}, {y!r}, {z!r}" for k, (x, y, z) in enumerate(block.points.tolist(), 1)]
    kinds = {"hexahedron": "C3D8R", "wedge": "C3D6", "pyramid": "C3D5", "tetra": "C3D4"}
    number, numbers, sets = 0, {}, {"first": [], "second": []}
    for kind, cells in block.cells.items():
        out.append(f"*Element, type={kinds[kind]}")
        for layer, cell in cells:
            number += 1
            numbers[number] = (kind, layer, cell)
            sets["first" if layer < 2 else "second"].append(number)
            out.append(", ".join(str(it) for it in [number, *(node + 1 for node in cell)]))
    for name, members in sets.items():
        out += [f"*Elset, elset={name}", *(f"{member}," for member in members)]
    out += ["*Nset, nset=corner", f"{block.corner + 1},"]
    # The left face of a hexahedron is that of its corners 1, 5, 8 and 4, S6 (4-8-5-1); of tetrahedra that of three of theirs.
    sides = {(1, 2, 3): 1, (1, 2, 4): 2, (2, 3, 4): 3, (1, 3, 4): 4}
    out.append("*Surface, type=ELEMENT, name=left")
    out += [f"{k}, S6" for k, (kind, layer, _) in numbers.items() if kind == "hexahedron" and layer == 0]
    out.append("*Surface, type=ELEMENT, name=right")
    wanted = {frozenset(face) for face in block.right}
    for k, (kind, _, cell) in numbers.items():
        for corners, side in sides.items() if kind == "tetra" else ():
            if frozenset(cell[corner - 1] for corner in corners) in wanted:
                out.append(f"{k}, S{side}")
    path.write_text("\n".join(out) + "\n")


def exodus(block, path):
    """Element blocks by the kind of cells in a part, a node set, and side sets with the sides as Exodus numbers them."""
    kinds = {"hexahedron": "HEX8", "wedge": "WEDGE", "pyramid": "PYRAMID", "tetra": "TETRA"}
    blocks = [(kind, part, [it for it in cells if (it[0] < 2) == (part == 1)]) for kind, cells in block.cells.items() for part in (1, 2)]
    blocks = [it for it in blocks if it[2]]
    order = [(kind, layer, cell) for kind, _, cells in blocks for layer, cell in cells]
    # The left face of a hexahedron has its corners 1, 5, 8 and 4: side 4.
    left = [(k, 4) for k, (kind, layer, _) in enumerate(order, 1) if kind == "hexahedron" and layer == 0]
    sides, wanted = {(1, 2, 4): 1, (2, 3, 4): 2, (1, 3, 4): 3, (1, 2, 3): 4}, {frozenset(face) for face in block.right}
    right = [
        (k, side) for k, (kind, _, cell) in enumerate(order, 1) if kind == "tetra"
        for corners, side in sides.items() if frozenset(cell[corner - 1] for corner in corners) in wanted
    ]
    with netCDF4.Dataset(path, "w", format="NETCDF3_64BIT_OFFSET") as file:
        sizes = {"len_name": 33, "num_dim": 3, "num_nodes": len(block.points), "num_el_blk": len(blocks), "num_node_sets": 1,
                 "num_side_sets": 2, "num_elem": len(order), "num_nod_ns1": 1}
        for name, size in sizes.items():
            file.createDimension(name, size)

        def put(name, kind, dimensions, values):
            variable = file.createVariable(name, kind, dimensions)
            variable[:] = values
            return variable

        def texts(name, dimension, words):
            put(name, "S1", (dimension, "len_name"), np.array([[c.encode() for c in word.ljust(33, "\0")] for word in words], dtype="S1"))

        for axis in range(3):
            put("coord" + "xyz"[axis], "f8", ("num_nodes",), block.points[:, axis])
        put("eb_prop1", "i4", ("num_el_blk",), np.arange(1, 1 + len(blocks)))
        texts("eb_names", "num_el_blk", [f"{kind}-{part}" for kind, part, _ in blocks])
        for k, (kind, _, cells) in enumerate(blocks, 1):
            rows = np.array([cell for _, cell in cells])
            file.createDimension(f"num_el_in_blk{k}", len(rows))
            file.createDimension(f"num_nod_per_el{k}", rows.shape[1])
            put(f"connect{k}", "i4", (f"num_el_in_blk{k}", f"num_nod_per_el{k}"), rows + 1).elem_type = kinds[kind]
        put("ns_prop1", "i4", ("num_node_sets",), [1])
        texts("ns_names", "num_node_sets", ["corner"])
        put("node_ns1", "i4", ("num_nod_ns1",), [block.corner + 1])
        put("ss_prop1", "i4", ("num_side_sets",), [1, 2])
        texts("ss_names", "num_side_sets", ["left", "right"])
        for k, members in ((1, left), (2, right)):
            file.createDimension(f"num_side_ss{k}", len(members))
            put(f"elem_ss{k}", "i4", (f"num_side_ss{k}",), [number for number, _ in members])
            put(f"side_ss{k}", "i4", (f"num_side_ss{k}",), [side for _, side in members])


def unfit(block, folder):
    """Solids that are to be refused."""
    shell = [[0.0, 0, 0], [1, 0, 0], [1, 1, 1], [0, 1, 1]]
    meshio.Mesh(shell, [("quad", [[0, 1, 2, 3]])]).write(folder / "surface.vtu")
    mesh = block.mesh(is_grouped=False)
    mesh.points = np.vstack([mesh.points, [[9.0, 0, 0], [9, 1, 0], [9, 0, 1]]])
    n = len(mesh.points)
    loose = meshio.Mesh(mesh.points, [*mesh.cells, ("triangle", [[n - 3, n - 2, n - 1]])], cell_data={
        "part": [*mesh.cell_data["part"], np.array([9])]})
    loose.write(folder / "mixed.vtu")
    flat = meshio.Mesh([[0.0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 1e-9]], [("tetra", [[0, 1, 2, 3]])])
    flat.write(folder / "flat.vtu")


def main(folder):
    block = Block()
    for name, binary in (("ascii", False), ("binary", True)):
        meshio.write(folder / f"{name}-2.2.msh", block.mesh(), file_format="gmsh22", binary=binary)
        meshio.write(folder / f"{name}-4.1.msh", block.mesh(), file_format="gmsh", binary=binary)
    abaqus(block, folder / "block.inp")
    exodus(block, folder / "block.e")
    for name in ("block.vtu", "block.vtk"):
        block.mesh(is_grouped=False).write(folder / name)
    unfit(block, folder)


main(Path(sys.argv[1]))
