#!/usr/bin/env python3
"""Finite-element solutions (plane stress, biquadratic elements) that peridynamic results are compared with.

This is not part of the program.  Classical elasticity is the local limit of the peridynamic models, so the FEM
solution of the same problem says how far a lattice is from the continuum:
    - the orthotropic lamina with a hole of OMPPD (Diana, Casolo: "A full orthotropic micropolar peridynamic formulation
      for linearly elastic solids"), section 3: tension, and the frequencies of its tables 3-5;
    - the square plate of MPPD (Diana, Casolo: "A bond-based micropolar peridynamic model with shear deformability"),
      tables 4-6: frequencies;
    - straight cracks of linear elastic fracture mechanics in the notched plate of cases/steel-plate and the double
      cantilever of cases/double-cantilever: load and displacement at which each crack grows, by the energy of the body.

    pip install -r tools/requirements-reference.txt
    python tools/reference_fem.py [DIRECTORY]           # default: tests/reference beside this script's folder

writes DIRECTORY/fem-*.csv, reads DIRECTORY/lattice-hole-edge.csv if it is there, and prints what it compares (about
a minute).  SI units; thickness 1 mm, of the double cantilever 3 mm.  Lattices are held, and so are the plates that are
compared with them, in whole rows of cells, not at edges.
"""
import logging
import sys
from pathlib import Path
import numpy as np
from scipy.optimize import brentq
from scipy.sparse.linalg import eigsh, splu
from skfem import Basis, BilinearForm, ElementQuad2, ElementVector, MeshQuad, MeshQuad2
from skfem.helpers import dot, sym_grad

logging.getLogger("skfem").setLevel(logging.ERROR)            # it reports every copy of an array
LENGTH, HEIGHT, RADIUS, THICKNESS = 0.4, 0.2, 0.04, 1e-3
LAMINA = {"E1": 15e9, "E2": 5e9, "nu12": 0.25, "G": 4.8e9}     # OMPPD table 2
ANGLES = (0, 30, 45, 60, 90)                                    # zeta in degrees, OMPPD Fig. 10
DENSITY = 2500.0
NUS = {"-0.5": -0.5, "0": 0.0, "0.1": 0.1, "0.25": 0.25, "1/3": 1 / 3}
# Published FEM frequencies in Hz: OMPPD tables 3-5, MPPD tables 4-6
PUBLISHED = [(400.85, 1403.00, 1625.10), (365.65, 1261.22, 1490.44), (330.69, 1099.10, 1390.65), (296.61, 959.49, 1292.50),
             (263.76, 848.18, 1191.32)]
SQUARE_PUBLISHED = [(1195.0, 2400.2, 3245.3), (1047.2, 2320.0, 2771.2), (1027.9, 2322.6, 2712.0), (1002.5, 2330.4, 2635.9),
                    (989.89, 2336.3, 2590.0)]


def stiffness_tensor(E1, E2, nu12, G, zeta=0.0):
    """Plane stress C_ij (OMPPD eq. 25) in Voigt notation (engineering shear), material axis 1 at zeta to x."""
    scale = 1 / (1 - nu12**2 * E2 / E1)
    C = np.array([[E1 * scale, nu12 * E2 * scale, 0], [nu12 * E2 * scale, E2 * scale, 0], [0, 0, G]])
    c, s = np.cos(zeta), np.sin(zeta)
    to_material = np.array([[c * c, s * s, c * s], [s * s, c * c, -c * s], [-2 * c * s, 2 * c * s, c * c - s * s]])
    return to_material.T @ C @ to_material


def isotropic_tensor(E, nu):
    return stiffness_tensor(E, E, nu, E / (2 * (1 + nu)))


class CurvedMesh(MeshQuad2):
    """Quadrilaterals with curved edges; points are found as if edges were straight, which they are but at the hole."""

    def element_finder(self, mapping=None):
        return MeshQuad(self.doflocs[:, :self.nvertices], self.t).element_finder()


def lamina_mesh(n, clamp):
    """Quadrilaterals around the hole, `n` along an eighth of it, with a mesh line at a distance `clamp` from both ends.

    The square |x| < HEIGHT/2 is cut along rays from the hole; rectangles continue it to both ends.  Edges on the hole are
    curved.
    """
    half, end = HEIGHT / 2, LENGTH / 2
    side = np.linspace(-half, half, 2 * n + 1)
    right = np.column_stack([half + 0 * side, side])[:-1]
    border = np.concatenate([right, right[:, ::-1] * [-1, 1], -right, right[:, ::-1] * [1, -1]])
    ring = RADIUS * border / np.hypot(*border.T)[:, None]
    depth = np.linspace(0, 1, n + 1)**1.3                       # finer at the hole
    points = (ring[None] + depth[:, None, None] * (border - ring)[None]).reshape(-1, 2)
    around = len(border)
    quads = [(k * around + j, k * around + (j + 1) % around, (k + 1) * around + (j + 1) % around, (k + 1) * around + j)
             for k in range(n) for j in range(around)]
    mesh = MeshQuad(points.T, np.array(quads).T)
    long = np.unique(np.r_[np.linspace(half, end - clamp, n), np.linspace(end - clamp, end, max(2, n // 6))])
    mesh = mesh + MeshQuad.init_tensor(long, side) + MeshQuad.init_tensor(-long[::-1], side)
    curved = CurvedMesh.from_mesh(mesh)
    radius = np.hypot(*curved.doflocs)
    on_hole = radius < RADIUS * (1 + 1e-6)
    curved.doflocs[:, on_hole] *= RADIUS / radius[on_hole]
    return curved


class Continuum:
    """Stiffness and mass matrices of a mesh."""

    def __init__(self, mesh, C):
        self.basis = basis = Basis(mesh, ElementVector(ElementQuad2()), intorder=5)

        @BilinearForm
        def stiffness(u, v, _):
            e, d = sym_grad(u), sym_grad(v)
            strain, virtual = np.array([e[0, 0], e[1, 1], 2 * e[0, 1]]), np.array([d[0, 0], d[1, 1], 2 * d[0, 1]])
            return THICKNESS * np.einsum("i...,ij,j...->...", virtual, C, strain)

        @BilinearForm
        def mass(u, v, _):
            return THICKNESS * DENSITY * dot(u, v)
        self.K, self.M, self.x = stiffness.assemble(basis).tocsc(), mass.assemble(basis).tocsc(), basis.doflocs
        self.horizontal = np.zeros(basis.N, bool)
        for group in (basis.nodal_dofs[0], basis.facet_dofs[0], basis.interior_dofs[0]):
            self.horizontal[group] = True

    def solve(self, held, value):
        u, free = np.where(held, value, 0.0), ~held
        u[free] = splu(self.K[free][:, free].tocsc()).solve(-(self.K @ u)[free])
        return u

    def frequencies(self, held, count=4):
        free = ~held
        v0 = np.random.default_rng(1).standard_normal(free.sum())
        value = eigsh(self.K[free][:, free].tocsc(), count, self.M[free][:, free].tocsc(), sigma=0.0, v0=v0)[0]
        return np.sqrt(np.sort(value)) / (2 * np.pi)

    def at(self, points, u):
        """Displacements (n, 2) at points (n, 2)."""
        values = self.basis.probes(points.T) @ u
        return values.reshape(2, -1).T


def tension(n, zeta, layer):
    """The lamina with u_x = -0.5 and 0.5 mm in layers at its ends, u_y free; u_y has mean zero over a half turn."""
    body = Continuum(lamina_mesh(n, layer), stiffness_tensor(**LAMINA, zeta=np.radians(zeta)))
    held = body.horizontal & (np.abs(body.x[0]) > LENGTH / 2 - layer - 1e-9)
    value = np.where(held, 5e-4 * np.sign(body.x[0]), 0.0)
    held[np.flatnonzero(~body.horizontal)[0]] = True            # one vertical displacement
    return body, body.solve(held, value)


def along_edge(n, zeta, layer, points):
    """Displacements at points along the edge.  The body is symmetric under a half turn, and so is the solution made."""
    body, u = tension(n, zeta, layer)
    here, opposite = body.at(points, u), body.at(-points, u)
    return here - 0.5 * (here + opposite).mean(axis=0) * [0, 1]


def lamina_edge(folder):
    """OMPPD Figs 16, 17 on the upper edge, read at the height of the lattice's last row of points."""
    x = (np.arange(80) - 39.5) * 0.005
    points, rows = np.column_stack([x, 0.0975 + 0 * x]), []
    lattice = folder / "lattice-hole-edge.csv"
    other = np.loadtxt(lattice, delimiter=",", skiprows=1).reshape(len(ANGLES), 80, -1) if lattice.exists() else None
    print("Edge of the lamina: largest |u|, mm; differences in % of it: n = 6 to 12, layer 16 to 15 mm, lattice to FEM")
    for k, zeta in enumerate(ANGLES):
        fine, coarse, thick = (along_edge(n, zeta, layer, points) for n, layer in ((12, 0.015), (6, 0.015), (12, 0.016)))
        largest = np.abs(fine).max(axis=0)
        differences = [coarse, thick] + ([other[k, :, 3:5]] if other is not None else [])
        print(f"   {zeta:3}  ", np.round(1e3 * largest, 5),
              *(np.round(100 * np.abs(d - fine).max(axis=0) / largest, 3) for d in differences))
        rows += [(zeta, *point, *u) for point, u in zip(points, fine)]
    write(folder / "fem-hole-edge.csv", "zeta,x,y,ux,uy", rows)


def lamina_frequencies(folder):
    """OMPPD tables 3-5: 10 mm (two columns of the lattice) at one end held."""
    rows = []
    print("Frequencies of the lamina, Hz: n = 6 and 12; % off the published FEM values")
    for zeta, published in zip(ANGLES, PUBLISHED):
        both = []
        for n in (6, 12):
            body = Continuum(lamina_mesh(n, 0.01), stiffness_tensor(**LAMINA, zeta=np.radians(zeta)))
            both.append(body.frequencies(body.x[0] < -LENGTH / 2 + 0.01 + 1e-9)[:3])
        print(f"   {zeta:3}  ", np.round(both, 2).tolist(), np.round(100 * (both[1] / published - 1), 2))
        rows.append((zeta, *both[1]))
    write(folder / "fem-hole-frequencies.csv", "zeta,f1,f2,f3", rows)


def square_frequencies(folder):
    """MPPD tables 4-6: 0.6 x 0.6 m, of which 30 mm (three rows of the lattice) are held."""
    rows = []
    print("Frequencies of the square plate, Hz: 20 and 40 elements; % off the published FEM values")
    for (label, nu), published in zip(NUS.items(), SQUARE_PUBLISHED):
        both = []
        for n in (20, 40):
            mesh = MeshQuad2.from_mesh(MeshQuad.init_tensor(np.linspace(0, 0.6, n + 1), np.linspace(0.03, 0.6, n + 1)))
            body = Continuum(mesh, isotropic_tensor(70e9, nu))
            both.append(body.frequencies(body.x[1] < 0.03 + 1e-9)[:3])
        print(f"   {label:>4}  ", np.round(both, 2).tolist(), np.round(100 * (both[1] / published - 1), 2))
        rows.append((label, *both[1]))
    write(folder / "fem-square-frequencies.csv", "nu,f1,f2,f3", rows)


def graded(length, first, count):
    """Lines of a mesh from 0 to `length`, the first of `count` parts `first` long, each longer than the one before by a factor."""
    factor = brentq(lambda it: first * np.sum(it**np.arange(count)) - length, 1, 3)
    return np.concatenate([[0], np.cumsum(first * factor**np.arange(count))])


def stiffnesses(body, held, value, lengths):
    """Force per displacement of a body whose middle line is held across beyond a crack of each length; half of it is meshed.

    `value` is a displacement of 1/2.  The half is factored once, with a free line; holding the line takes the forces that close it.
    """
    free = ~held
    factor = splu(body.K[free][:, free].tocsc(), permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0.0, options={"SymmetricMode": True})
    u = np.where(held, value, 0.0)
    u[free] = factor.solve(-(body.K @ u)[free])
    line = np.flatnonzero(free & ~body.horizontal & (body.x[1] < 1e-12))
    at = (np.cumsum(free) - 1)[line]
    forces = np.zeros((free.sum(), len(line)))
    forces[at, np.arange(len(line))] = 1
    flexibility = factor.solve(forces)[at]
    found = []
    for length in lengths:
        closed = body.x[0][line] > length - 1e-9
        opening = u[line][closed]
        found.append(2 * (u @ (body.K @ u) + opening @ np.linalg.solve(flexibility[np.ix_(closed, closed)], opening)))
    return np.array(found)


def growth(lengths, stiffness, thickness, energy, first):
    """Displacements and loads at which a straight crack grows: first that of length `first`, then those between the lengths beyond it."""
    slope = -np.diff(stiffness) / np.diff(lengths)
    start = np.abs(lengths - first).argmin()
    at = np.concatenate([[(slope[start - 1] + slope[start]) / 2], slope[start:]])
    stiff = np.concatenate([[stiffness[start]], np.sqrt(stiffness[start:-1] * stiffness[start + 1:])])
    displacement = np.sqrt(2 * energy * thickness / at)
    return np.column_stack([displacement, stiff * displacement]), stiffness[start]


def notched_plate(n):
    """Half of cases/steel-plate in tension, plane strain, `n` elements along it; lengths of the crack and stiffnesses."""
    side, young, nu = 1e-3, 210e9, 0.3
    x = np.linspace(0, side, n + 1)
    mesh = MeshQuad2.from_mesh(MeshQuad.init_tensor(x, graded(side / 2, side / n, n // 3)))
    body = Continuum(mesh, isotropic_tensor(young / (1 - nu**2), nu / (1 - nu)))
    top = body.x[1] > side / 2 - 1e-9
    lengths = x[n // 2 - 1:int(0.92 * n)]
    return lengths, stiffnesses(body, top, np.where(body.horizontal, 0.0, 0.5), lengths)


def double_cantilever(n):
    """Half of cases/double-cantilever, plane stress, `n` elements along it; lengths of the crack and stiffnesses."""
    length, half_height, grip = 50e-3, 10e-3, 1e-3
    x = np.linspace(0, length, n + 1)
    mesh = MeshQuad2.from_mesh(MeshQuad.init_tensor(x, graded(half_height, length / n, n // 8)))
    body = Continuum(mesh, isotropic_tensor(2.1e9, 0.3))
    held = ~body.horizontal & (body.x[0] < grip + 1e-9)
    value = np.where(held, 0.5, 0.0)
    held |= body.horizontal & (body.x[0] > length - 1e-9) & (body.x[1] < 1e-12)
    lengths = x[(x > 4.2e-3) & (x < 21e-3)]
    return lengths, stiffnesses(body, held, value, lengths) * 3e-3 / THICKNESS


def straight_cracks(folder):
    """Loads at which the cracks of two cases grow straight, while they grow at rising displacements."""
    print("Straight cracks: elements, stiffness in N/m, displacement in m and load in N at the first growth")
    for name, body, thickness, energy, first, counts in (("notched-plate", notched_plate, 1e-3, 2700.0, 0.5e-3, (60, 120)),
                                                         ("double-cantilever", double_cantilever, 3e-3, 12.0, 5e-3, (100, 200))):
        for n in counts:
            found, stiffness = growth(*body(n), thickness, energy, first)
            print(f"   {name}  {n:4} {stiffness:.5g} {found[0, 0]:.5g} {found[0, 1]:.5g}")
        found = found[:found[:, 0].argmax() + 1]
        write(folder / f"fem-{name}-growth.csv", "reading,load", [(0.0, 0.0), *(map(float, (f"{x:.6g}", f"{y:.6g}")) for x, y in found)])


def write(path, header, rows):
    def text(v):
        return v if isinstance(v, str) else repr(v.item() if hasattr(v, "item") else v)
    path.write_text("".join(",".join(map(text, row)) + "\n" for row in [header.split(","), *rows]))


def main(folder):
    for part in lamina_edge, lamina_frequencies, square_frequencies, straight_cracks:
        part(folder)


if __name__ == "__main__":
    main(Path(sys.argv[1]) if len(sys.argv) > 1 else Path(__file__).resolve().parent.parent / "tests" / "reference")
