"""Makes the meshes of this folder and `expected.tsv`, by Gmsh and meshio (see README.md).

Run in this folder: python generate.py
"""

import itertools

import gmsh
import meshio
import numpy as np

np.set_printoptions(legacy="1.25")

EXPECTED = []


def start(size):
    gmsh.initialize()
    gmsh.option.setNumber("General.Terminal", 0)
    gmsh.option.setNumber("General.NumThreads", 1)
    gmsh.option.setNumber("Mesh.MeshSizeMin", size)
    gmsh.option.setNumber("Mesh.MeshSizeMax", size)


def boxes():
    """Two boxes side by side, volumes 1 and 2, with their common surface, and groups of every dimension."""
    gmsh.model.occ.addBox(0, 0, 0, 1, 0.7, 0.5)
    gmsh.model.occ.addBox(1, 0, 0, 0.5, 0.7, 0.5)
    gmsh.model.occ.fragment([(3, 1)], [(3, 2)])
    gmsh.model.occ.synchronize()
    groups()


def entities_at(dim, **where):
    """Entities of a dimension whose bounding box is flat at x, y or z."""
    found = []
    for _, tag in gmsh.model.getEntities(dim):
        box = gmsh.model.getBoundingBox(dim, tag)
        at = {"x": (box[0], box[3]), "y": (box[1], box[4]), "z": (box[2], box[5])}
        if all(max(abs(v - value) for v in at[axis]) < 1e-3 for axis, value in where.items()):
            found.append(tag)
    return found


def groups():
    add = gmsh.model.addPhysicalGroup
    add(0, entities_at(0, x=0, y=0, z=0), 10, "corner")
    add(1, entities_at(1, x=0, y=0), 20, "edge")
    add(1, entities_at(1, x=1.5), 21)
    add(2, entities_at(2, x=0), 30, "left")
    add(2, entities_at(2, x=1.5), 31, "right")
    add(2, entities_at(2, x=1), 32, "interface")
    add(2, entities_at(2, x=0) + entities_at(2, z=0), 33)
    add(3, [1, 2], 40, "all")
    add(3, [2], 41, "small box")


def volume(points):
    """Volume of a cell: of the pyramids over the middles of its faces, Gmsh's order of corners."""
    faces = {
        4: [(0, 2, 1), (0, 1, 3), (1, 2, 3), (2, 0, 3)],
        5: [(0, 3, 2, 1), (0, 1, 4), (1, 2, 4), (2, 3, 4), (3, 0, 4)],
        6: [(0, 2, 1), (3, 4, 5), (0, 1, 4, 3), (1, 2, 5, 4), (2, 0, 3, 5)],
        8: [(0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)],
    }[len(points)]
    middle = points.mean(axis=0)
    total = 0.0
    for face in faces:
        corners = points[list(face)]
        centre = corners.mean(axis=0)
        for a, b in zip(corners, np.roll(corners, -1, axis=0)):
            total += np.dot(centre - middle, np.cross(a - centre, b - centre)) / 6
    return abs(total)


def area(points):
    centre = points.mean(axis=0)
    rolled = np.roll(points, -1, axis=0)
    parts = zip(points, rolled)
    return sum(0.5 * np.linalg.norm(np.cross(a - centre, b - centre)) for a, b in parts)


def measure(dim, points):
    if dim == 0:
        return 1.0
    if dim == 1:
        return np.linalg.norm(points[1] - points[0])
    return area(points) if dim == 2 else volume(points)


def expect(name):
    """Notes what the model in memory holds, for the file `name`."""
    tags, coordinates, _ = gmsh.model.mesh.getNodes()
    position = dict(zip(tags.tolist(), coordinates.reshape(-1, 3)))

    def elements(dim, entity):
        for kind, _, nodes in zip(*gmsh.model.mesh.getElements(dim, entity)):
            _, _, _, count, _, corners = gmsh.model.mesh.getElementProperties(kind)
            yield from nodes.reshape(-1, count)[:, :corners].astype(int).tolist()

    def at(cell):
        return np.array([position[tag] for tag in cell])

    cells = [cell for _, volume_tag in gmsh.model.getEntities(3) for cell in elements(3, volume_tag)]
    used = sorted({tag for cell in cells for tag in cell})
    kinds = [sum(len(cell) == corners for cell in cells) for corners in (4, 8, 6, 5)]
    sums = [float(sum(position[tag][axis] for tag in used)) for axis in range(3)]
    total = float(sum(measure(3, at(cell)) for cell in cells))
    EXPECTED.append(["mesh", name, len(used), sum(used), *sums, *kinds, total])
    for dim, number in sorted(gmsh.model.getPhysicalGroups()):
        label = gmsh.model.getPhysicalName(dim, number) or str(number)
        members = [
            cell
            for entity in gmsh.model.getEntitiesForPhysicalGroup(dim, number)
            for cell in elements(dim, entity)
        ]
        nodes = sorted({tag for cell in members for tag in cell} & set(used))
        size = float(sum(measure(dim, at(cell)) for cell in members))
        EXPECTED.append(["group", dim, number, label, len(nodes), sum(nodes), len(members), size])


def save(stem, versions=((2.2, 0), (2.2, 1), (4.1, 0), (4.1, 1))):
    for version, binary in versions:
        gmsh.option.setNumber("Mesh.MshFileVersion", version)
        gmsh.option.setNumber("Mesh.Binary", binary)
        name = f"{stem}-{str(version).replace('.', '')}{'-binary' if binary else ''}.msh"
        gmsh.write(name)
        expect(name)


def tetrahedra():
    start(0.35)
    boxes()
    gmsh.model.mesh.generate(3)
    save("tetrahedra")
    gmsh.model.mesh.setOrder(2)
    save("tetrahedra-10-node", ((2.2, 1), (4.1, 0)))
    gmsh.finalize()


def hexahedra():
    start(0.5)
    boxes()
    for _, curve in gmsh.model.getEntities(1):
        gmsh.model.mesh.setTransfiniteCurve(curve, 3)
    for _, surface in gmsh.model.getEntities(2):
        gmsh.model.mesh.setTransfiniteSurface(surface)
        gmsh.model.mesh.setRecombine(2, surface)
    for _, tag in gmsh.model.getEntities(3):
        gmsh.model.mesh.setTransfiniteVolume(tag)
    gmsh.model.mesh.generate(3)
    save("hexahedra", ((2.2, 0), (4.1, 1)))
    gmsh.finalize()


def prisms():
    """Triangles drawn out in layers."""
    start(0.3)
    occ = gmsh.model.occ
    surface = occ.addRectangle(0, 0, 0, 1, 0.7)
    occ.extrude([(2, surface)], 0, 0, 0.5, numElements=[2], recombine=True)
    occ.synchronize()
    gmsh.model.addPhysicalGroup(3, [1], 1, "body")
    gmsh.model.addPhysicalGroup(2, entities_at(2, z=0.5), 2, "top")
    gmsh.model.addPhysicalGroup(2, entities_at(2, x=1), 3, "side")
    gmsh.model.mesh.generate(3)
    save("prisms", ((2.2, 0), (4.1, 1)))
    gmsh.finalize()


def pyramids():
    """A box of hexahedra beside one of tetrahedra: Gmsh puts pyramids between them."""
    start(0.5)
    boxes()
    first = {abs(tag) for _, tag in gmsh.model.getBoundary([(3, 1)], combined=False)}
    curves = {
        abs(tag) for face in first for _, tag in gmsh.model.getBoundary([(2, face)], combined=False)
    }
    for curve in curves:
        gmsh.model.mesh.setTransfiniteCurve(curve, 3)
    for face in first:
        gmsh.model.mesh.setTransfiniteSurface(face)
        gmsh.model.mesh.setRecombine(2, face)
    gmsh.model.mesh.setTransfiniteVolume(1)
    gmsh.model.mesh.generate(3)
    save("pyramids", ((2.2, 1), (4.1, 0)))
    gmsh.finalize()


def through_meshio():
    """meshio's writer of 4.1 wants data that its reader does not give."""
    mesh = meshio.read("pyramids-41.msh")
    mesh.write("meshio-pyramids-22.msh", file_format="gmsh22", binary=True)


def refused():
    """A surface in space, without its volume."""
    start(0.5)
    gmsh.model.occ.addBox(0, 0, 0, 1, 1, 1)
    gmsh.model.occ.synchronize()
    gmsh.model.addPhysicalGroup(2, [1, 2, 3], 1, "skin")
    gmsh.model.mesh.generate(2)
    gmsh.option.setNumber("Mesh.MshFileVersion", 4.1)
    gmsh.option.setNumber("Mesh.Binary", 0)
    gmsh.write("refused-skin.msh")
    gmsh.finalize()


tetrahedra()
hexahedra()
prisms()
pyramids()
through_meshio()
refused()
with open("expected.tsv", "w") as file:
    for row in EXPECTED:
        file.write("\t".join(str(value) for value in row) + "\n")
