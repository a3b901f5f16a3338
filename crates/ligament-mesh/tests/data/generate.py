"""Makes the meshes of this folder and `expected.tsv`, by Gmsh and meshio (see README.md).

Run in this folder: python generate.py
"""

import gmsh
import meshio
import numpy as np

# meshio writes numbers by their repr, which Gmsh reads in this style only.
np.set_printoptions(legacy="1.25")

EXPECTED = []


def start(size):
    gmsh.initialize()
    gmsh.option.setNumber("General.Terminal", 0)
    gmsh.option.setNumber("General.NumThreads", 1)
    gmsh.option.setNumber("Mesh.MeshSizeMin", size)
    gmsh.option.setNumber("Mesh.MeshSizeMax", size)


def rectangles(size=0.25):
    """Two rectangles side by side: surfaces 1 (0.6 x 0.5) and 2 (0.4 x 0.5), interface curve 7."""
    start(size)
    geo = gmsh.model.geo
    for x, y in [(0, 0), (0.6, 0), (1, 0), (1, 0.5), (0.6, 0.5), (0, 0.5)]:
        geo.addPoint(x, y, 0)
    for a, b in [(1, 2), (2, 3), (3, 4), (4, 5), (5, 6), (6, 1), (2, 5)]:
        geo.addLine(a, b)
    geo.addPlaneSurface([geo.addCurveLoop([1, 7, 5, 6])])
    geo.addPlaneSurface([geo.addCurveLoop([2, 3, 4, -7])])
    geo.synchronize()


def groups():
    """Named and unnamed groups; both surfaces are in two groups, one of them reversed."""
    add = gmsh.model.addPhysicalGroup
    add(0, [1], 10, "corner")
    add(0, [3, 4], 11)
    add(1, [6], 20, "left side")
    add(1, [3], 21, "right side")
    add(1, [1, 2], 42)
    add(2, [1, 2], 30, "all")
    add(2, [1], 31, "left half")
    add(2, [-2], 77)


def expect(name, only_grouped=True, with_groups=True):
    """Notes what the model in memory holds, for the file `name`."""
    tags, coordinates, _ = gmsh.model.mesh.getNodes()
    position = dict(zip(tags.tolist(), coordinates.reshape(-1, 3)))
    physical = gmsh.model.getPhysicalGroups()
    grouped = {
        (dim, abs(entity))
        for dim, number in physical
        for entity in gmsh.model.getEntitiesForPhysicalGroup(dim, number)
    }

    def elements(dim, entity):
        """Corner tags of the elements of an entity."""
        for kind, _, nodes in zip(*gmsh.model.mesh.getElements(dim, entity)):
            _, _, _, count, _, corners = gmsh.model.mesh.getElementProperties(kind)
            yield from nodes.reshape(-1, count)[:, :corners].astype(int).tolist()

    def area(cell):
        x, y, _ = np.array([position[tag] for tag in cell]).T
        return abs(0.5 * np.sum(x * np.roll(y, -1) - y * np.roll(x, -1)))

    def length(edge):
        return np.linalg.norm(position[edge[0]] - position[edge[1]])

    surfaces = [
        entity
        for entity in gmsh.model.getEntities(2)
        if not only_grouped or entity in grouped
    ]
    cells = [cell for entity in surfaces for cell in elements(*entity)]
    used = sorted({tag for cell in cells for tag in cell})
    x, y = sum(position[tag][0] for tag in used), sum(position[tag][1] for tag in used)
    EXPECTED.append(
        ["mesh", name, len(used), sum(used), x, y]
        + [sum(len(cell) == corners for cell in cells) for corners in (3, 4)]
        + [sum(map(area, cells))]
    )
    for dim, number in sorted(physical) if with_groups else []:
        label = gmsh.model.getPhysicalName(dim, number) or str(number)
        inside = [
            element
            for entity in gmsh.model.getEntitiesForPhysicalGroup(dim, number)
            for element in elements(dim, abs(entity))
        ]
        nodes = {tag for element in inside for tag in element} & set(used)
        if not nodes:
            continue
        # An edge off the mesh is no edge of the group.
        inside = [element for element in inside if set(element) <= set(used)]
        measure = [area, length][dim == 1]
        EXPECTED.append(
            ["group", dim, number, label, len(nodes), sum(nodes)]
            + [len(inside) if dim > 0 else 0, sum(map(measure, inside)) if dim > 0 else 0.0]
        )


def save(name, version, binary=False, save_all=False, parametric=False):
    gmsh.option.setNumber("Mesh.MshFileVersion", version)
    gmsh.option.setNumber("Mesh.Binary", binary)
    gmsh.option.setNumber("Mesh.SaveAll", save_all)
    gmsh.option.setNumber("Mesh.SaveParametric", parametric)
    gmsh.write(name)
    # In 2.2, all elements are saved without the numbers of their groups.
    expect(name, only_grouped=not save_all, with_groups=not (save_all and version == 2.2))


def save_variants(stem):
    for version, label in [(2.2, "22"), (4.1, "41")]:
        save(f"{stem}-{label}.msh", version)
        save(f"{stem}-{label}-binary.msh", version, binary=True)


def by_gmsh():
    rectangles()
    groups()
    gmsh.model.mesh.generate(2)
    save_variants("triangles")
    for version, label in [(2.2, "22"), (4.1, "41")]:
        save(f"save-all-{label}.msh", version, save_all=True)
    for version in (1.0, 4.0):
        gmsh.option.setNumber("Mesh.MshFileVersion", version)
        gmsh.write(f"refused-version-{int(version)}.msh")
    gmsh.finalize()

    # One surface of triangles, one of quadrangles.
    rectangles()
    groups()
    gmsh.model.mesh.setTransfiniteSurface(2)
    gmsh.model.mesh.setRecombine(2, 2)
    gmsh.model.mesh.generate(2)
    save_variants("mixed")
    gmsh.model.mesh.setOrder(2)
    save_variants("second-order")
    gmsh.model.mesh.setOrder(3)
    save("third-order-41.msh", 4.1)
    gmsh.finalize()

    # Eight-node quadrangles.
    rectangles()
    groups()
    gmsh.option.setNumber("Mesh.SecondOrderIncomplete", 1)
    gmsh.option.setNumber("Mesh.RecombineAll", 1)
    gmsh.model.mesh.generate(2)
    gmsh.model.mesh.setOrder(2)
    save("quadrangles-8-node-22.msh", 2.2)
    save("quadrangles-8-node-41-binary.msh", 4.1, binary=True)
    gmsh.finalize()

    # A surface without a group is not saved: gaps in the numbers; points of a group off the mesh.
    rectangles()
    gmsh.model.addPhysicalGroup(2, [2], 5, "right half")
    gmsh.model.addPhysicalGroup(0, [1, 2], 6, "points")
    gmsh.model.addPhysicalGroup(0, [6], 7, "off the mesh")
    gmsh.model.addPhysicalGroup(1, [1, 2, 7], 8, "curves")
    gmsh.model.mesh.generate(2)
    save_variants("gaps")
    gmsh.finalize()

    # Parametric nodes, on curved boundaries; in the plane z = 0.25.
    start(0.4)
    disk = gmsh.model.occ.addDisk(0, 0, 0.25, 1, 1)
    gmsh.model.occ.synchronize()
    gmsh.model.addPhysicalGroup(2, [disk], name="disk")
    gmsh.model.addPhysicalGroup(1, [1], name="rim")
    gmsh.model.mesh.generate(2)
    save("parametric-41.msh", 4.1, parametric=True)
    save("parametric-41-binary.msh", 4.1, binary=True, parametric=True)
    gmsh.finalize()

    # Periodic left and right side, in a clockwise surface, with data on nodes and cells.
    start(0.25)
    rectangle = gmsh.model.geo
    for x, y in [(0, 0), (0, 1), (1, 1), (1, 0)]:
        rectangle.addPoint(x, y, 0)
    for a, b in [(1, 2), (2, 3), (3, 4), (4, 1)]:
        rectangle.addLine(a, b)
    rectangle.addPlaneSurface([rectangle.addCurveLoop([1, 2, 3, 4])])
    rectangle.synchronize()
    shift = [1, 0, 0, 1, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]
    gmsh.model.mesh.setPeriodic(1, [3], [1], shift)
    gmsh.model.addPhysicalGroup(2, [1], 1, "plate")
    gmsh.model.addPhysicalGroup(1, [1, 3], 1, "plate")
    gmsh.model.mesh.generate(2)
    view = gmsh.view.add("x")
    tags, coordinates, _ = gmsh.model.mesh.getNodes()
    gmsh.view.addHomogeneousModelData(view, 0, "", "NodeData", tags, coordinates[::3])
    for version, label in [(2.2, "22"), (4.1, "41")]:
        for binary, ending in [(False, ""), (True, "-binary")]:
            name = f"periodic-{label}{ending}.msh"
            save(name, version, binary=binary)
            gmsh.option.setNumber("PostProcessing.SaveMesh", 0)
            gmsh.view.write(view, name, append=True)
    gmsh.finalize()

    rectangles()
    groups()
    gmsh.model.mesh.generate(2)
    gmsh.option.setNumber("Mesh.PartitionCreateTopology", 1)
    gmsh.option.setNumber("Mesh.PartitionCreateGhostCells", 1)
    gmsh.option.setNumber("Mesh.PartitionCreatePhysicals", 0)
    gmsh.model.mesh.partition(2)
    save("partitioned-41.msh", 4.1)
    save("partitioned-41-binary.msh", 4.1, binary=True)
    gmsh.finalize()

    start(1)
    box = gmsh.model.occ.addBox(0, 0, 0, 1, 1, 1)
    gmsh.model.occ.synchronize()
    gmsh.model.mesh.generate(3)
    gmsh.option.setNumber("Mesh.MshFileVersion", 4.1)
    gmsh.write("refused-volume.msh")
    gmsh.finalize()


def write_by_meshio(mesh, name, file_format, binary):
    meshio.write(name, mesh, file_format=file_format, binary=binary)


def expect_as_read_by_gmsh(name):
    start(1)
    gmsh.open(name)
    expect(name, only_grouped=False)
    gmsh.finalize()


def by_meshio():
    # 2.2 keeps all groups: the expectation is that of the file it was read from.
    source = [row for row in EXPECTED]
    begin = next(i for i, row in enumerate(source) if row[:2] == ["mesh", "mixed-22.msh"])
    end = next(i for i, row in enumerate(source) if row[:2] == ["mesh", "mixed-22-binary.msh"])
    for binary, ending in [(False, ""), (True, "-binary")]:
        name = f"meshio-22{ending}.msh"
        write_by_meshio(meshio.read("mixed-22.msh"), name, "gmsh22", binary)
        EXPECTED.append(["mesh", name] + source[begin][2:])
        EXPECTED.extend(source[begin + 1 : end])
    # 4.1 keeps the first group of an entity.
    for binary, ending in [(False, ""), (True, "-binary")]:
        name = f"meshio-41{ending}.msh"
        write_by_meshio(meshio.read("mixed-41.msh"), name, "gmsh", binary)
        expect_as_read_by_gmsh(name)
    # A mesh that never saw Gmsh: 4.1 has no $Entities.
    points = np.array([[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [0.0, 1.0], [1.0, 0.5]])
    cells = [("triangle", np.array([[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]]))]
    plain = meshio.Mesh(
        points,
        cells,
        point_data={"temperature": points[:, 0]},
        cell_data={
            "gmsh:physical": [np.array([1, 1, 2, 2])],
            "gmsh:geometrical": [np.array([1, 1, 2, 2])],
        },
        field_data={"lower right": np.array([1, 2]), "upper left": np.array([2, 2])},
    )
    for file_format, label in [("gmsh22", "22"), ("gmsh", "41")]:
        for binary, ending in [(False, ""), (True, "-binary")]:
            name = f"meshio-plain-{label}{ending}.msh"
            write_by_meshio(plain, name, file_format, binary)
            if file_format == "gmsh22":
                expect_as_read_by_gmsh(name)
            else:
                # Gmsh does not read an element without an entity: counts and area of the rectangle.
                EXPECTED.append(["mesh", name, 5, 15, 5.0, 2.5, 4, 0, 2.0])


by_gmsh()
by_meshio()
with open("expected.tsv", "w") as file:
    for row in EXPECTED:
        texts = (f"{value:.15g}" if isinstance(value, float) else str(value) for value in row)
        file.write("\t".join(texts) + "\n")
