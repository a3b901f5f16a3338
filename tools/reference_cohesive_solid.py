#!/usr/bin/env python3
"""A cohesive crack in Brokenshire's torsion test, in space: the calculation of reference_cohesive.py for a solid.

This is not part of the program.  Tetrahedra with ten nodes; the nodes of the plane ahead of the notch, at 45 degrees to the axis of the beam, are
doubled.  The crack of the test was curved, so that the torques are upper estimates.  Beam, notch and frames are those of
meshes/solids/brokenshire-frames.geo, supports and materials those of cases/brokenshire/frames.toml; the arm moves so that the notch opens.

    pip install -r tools/requirements-reference.txt
    python tools/reference_cohesive_solid.py            # three and a half minutes

prints largest load and torque for two weights of sliding, three laws of softening and two sizes of elements, and writes
tests/reference/cohesive-brokenshire-*.csv with the displacement of the arm (m) and the load on it (N).
"""
from math import pi

import gmsh
import numpy as np

from reference_cohesive import Cohesion, Condensed, PathPoint, elasticity, follow, motions, report, stiffness, store

LENGTH, SIDE, DEPTH, WIDTH = 0.4, 0.1, 0.05, 0.005         # of the beam and its notch, m
FRAME, BAR, REACH = 0.125, 0.025, 0.1                      # outer side and width of a frame, end of an arm from the axis, m
ARM = (LENGTH - BAR) / 2
SUPPORTS = {(-ARM, -REACH, -BAR / 2): (0, 1, 2), (-ARM, REACH, -BAR / 2): (0, 2), (ARM, -REACH, -BAR / 2): (2,)}
LOADED = (ARM, REACH, -BAR / 2)
CONCRETE, STEEL = (35e9, 0.2), (210e9, 0.2)
STRENGTH, ENERGY = 2.3e6, 80.0
LEVER = 0.2                                                # m
LAST = 5e-5                                                # opening at the root of the notch where it ends, past the peak, m
STEPS = 50


def solids():
    """Volumes of the beam cut by its notch, and of the frames; the surface ahead of the notch."""
    occ = gmsh.model.occ
    beam = occ.addBox(-LENGTH / 2, -SIDE / 2, -SIDE / 2, LENGTH, SIDE, SIDE)
    notch = occ.addBox(-SIDE, -WIDTH / 2, SIDE / 2 - DEPTH, 2 * SIDE, WIDTH, 2 * DEPTH)
    occ.rotate([(3, notch)], 0, 0, 0, 0, 0, 1, pi / 4)
    beam = occ.cut([(3, beam)], [(3, notch)])[0]
    frames = []
    for x in (-ARM - BAR / 2, ARM - BAR / 2):
        outside = occ.addBox(x, -FRAME / 2, -FRAME / 2, BAR, FRAME, FRAME)
        arm = occ.addBox(x, -REACH, -BAR / 2, BAR, 2 * REACH, BAR)
        inside = occ.addBox(x, -SIDE / 2, -SIDE / 2, BAR, SIDE, SIDE)
        frames += occ.cut(occ.fuse([(3, outside)], [(3, arm)])[0], [(3, inside)])[0]
    low, high = -SIDE / 2, SIDE / 2
    ends = [occ.addPoint(*p) for p in ((low, low, low), (high, high, low), (high, high, high - DEPTH), (low, low, high - DEPTH))]
    ligament = occ.addPlaneSurface([occ.addCurveLoop([occ.addLine(*pair) for pair in zip(ends, ends[1:] + ends[:1])])])
    points = [(0, occ.addPoint(*p)) for p in (*SUPPORTS, LOADED)]
    _, found = occ.fragment(beam + frames, [(2, ligament), *points])
    occ.synchronize()
    volumes = [[tag for _, tag in part] for part in found]
    return volumes[:len(beam)], volumes[len(beam):len(beam) + len(frames)], volumes[len(beam) + len(frames)]


def mesh(size):
    """Nodes, tetrahedra of beam and frames, and six-node triangles of the surface ahead of the notch, where they have a size."""
    gmsh.initialize()
    gmsh.option.setNumber("General.Terminal", 0)
    for option in ("MeshSizeExtendFromBoundary", "MeshSizeFromPoints", "MeshSizeFromCurvature"):
        gmsh.option.setNumber(f"Mesh.{option}", 0)
    beam, frames, ligament = solids()
    distance, wanted = gmsh.model.mesh.field.add("Distance"), gmsh.model.mesh.field.add("MathEval")
    gmsh.model.mesh.field.setNumbers(distance, "SurfacesList", ligament)
    gmsh.model.mesh.field.setNumber(distance, "Sampling", 40)
    gmsh.model.mesh.field.setString(wanted, "F", f"Min({size} + 0.25*F{distance}, {BAR})")
    gmsh.model.mesh.field.setAsBackgroundMesh(wanted)
    gmsh.model.mesh.generate(3)
    gmsh.model.mesh.setOrder(2)
    tags, where, _ = gmsh.model.mesh.getNodes()
    number = np.zeros(int(tags.max()) + 1, int)
    number[tags] = np.arange(len(tags))
    read = lambda dimension, entities, count: np.concatenate(
        [number[gmsh.model.mesh.getElements(dimension, tag)[2][0]].reshape(-1, count) for tag in entities])
    found = where.reshape(-1, 3), read(3, sum(beam, []), 10), read(3, sum(frames, []), 10), read(2, ligament, 6)
    gmsh.finalize()
    return found


def cut(nodes, tetrahedra, faces):
    """Doubles the nodes of the faces for the tetrahedra on the side y > x of them; gives also the double of each node."""
    on_faces = np.unique(faces)
    double = np.arange(len(nodes))
    double[on_faces] = len(nodes) + np.arange(len(on_faces))
    middles = nodes[tetrahedra[:, :4]].mean(1)
    beyond = middles[:, 1] > middles[:, 0]
    return np.vstack([nodes, nodes[on_faces]]), np.where(beyond[:, None], double[tetrahedra], tetrahedra), double


def path_points(nodes, faces, double):
    """Points of the faces: their nodes and middles, by the rule of seven points; those at the root of the notch are controlled."""
    axes = np.array([(-1, 1, 0), (1, 1, 0), (0, 0, 2**0.5)]) / 2**0.5
    sides = nodes[faces[:, 1:3]] - nodes[faces[:, :1]]
    areas = np.linalg.norm(np.cross(sides[:, 0], sides[:, 1]), axis=1) / 2
    of_nodes = np.zeros(len(nodes))
    np.add.at(of_nodes, faces, areas[:, None] * np.repeat((1 / 20, 2 / 15), 3))
    at_root = np.abs(nodes[:, 2] - (SIDE / 2 - DEPTH)) < 1e-9
    points = [PathPoint([(double[n], n, 1.0)], axes, of_nodes[n], at_root[n]) for n in np.unique(faces)]
    middle = np.repeat((-1 / 9, 4 / 9), 3)
    return points + [PathPoint([(double[n], n, share) for n, share in zip(face, middle)], axes, 9 / 20 * area, False)
                     for face, area in zip(faces, areas)]


def curve(size, softening, sliding):
    """Displacements of the arm and loads on it, shape (n, 2)."""
    nodes, beam, frames, faces = mesh(size)
    nodes, beam, double = cut(nodes, beam, faces)
    points = path_points(nodes, faces, double)
    held = [(place, axis) for place, axes in SUPPORTS.items() for axis in axes]
    tetrahedra = np.vstack([beam, frames])
    motion = motions(nodes, tetrahedra, held, (LOADED, 2, 1.0))
    whole = stiffness(nodes, beam, elasticity(*CONCRETE, 3)) + stiffness(nodes, frames, elasticity(*STEEL, 3))
    reading = np.zeros(nodes.size)
    reading[3 * np.argmin(np.linalg.norm(nodes - LOADED, axis=1)) + 2] = 1.0
    cohesion = Cohesion(softening, STRENGTH, ENERGY, sliding, np.array([point.area for point in points]), 3)
    return follow(Condensed(whole, motion, points, reading, cohesion), cohesion, LAST, STEPS)


def main():
    print("peak, its place, area; each over the measured value")
    for softening, sliding in (("two-branch", 1.0), ("two-branch", 0.5), ("linear", 1.0), ("cornelissen", 1.0)):
        name = f"brokenshire-{softening}" + (f"-beta-{sliding}" if sliding != 1 else "")
        for size in (0.016, 0.0115):
            found = curve(size, softening, sliding)
            report(f"{name}, {1e3 * size:.1f} mm", found)
            print(f"    torque {LEVER * found[:, 1].max():.1f} N m; {1e-6 * found[1, 1] / found[1, 0]:.2f} kN/mm at first", flush=True)
        store(name, found)


if __name__ == "__main__":
    main()
