#!/usr/bin/env python3
"""Finite-element solutions (plane stress, biquadratic elements) that peridynamic results are compared with.

This is not part of the program.  Classical elasticity is the local limit of the peridynamic models, so the FEM
solution of the same problem says how far a lattice is from the continuum:
    - the orthotropic lamina with a hole of OMPPD (Diana, Casolo: "A full orthotropic micropolar peridynamic formulation
      for linearly elastic solids"), section 3: tension, and the frequencies of its tables 3-5;
    - the square plate of MPPD (Diana, Casolo: "A bond-based micropolar peridynamic model with shear deformability"),
      tables 4-6: frequencies.

    pip install -r tools/requirements-reference.txt
    python tools/reference_fem.py [DIRECTORY]           # default: tests/reference beside this script's folder

writes DIRECTORY/fem-*.csv, reads DIRECTORY/lattice-hole-edge.csv if it is there, and prints what it compares (about 3
minutes).  SI units; thickness 1 mm.  The lamina is held as the lattice is: in whole layers of cells, not at edges.
"""
import sys
from pathlib import Path
import numpy as np
from scipy.sparse.linalg import eigsh, splu
from skfem import Basis, BilinearForm, ElementQuad2, ElementVector, MeshQuad, MeshQuad2
from skfem.helpers import dot, sym_grad

LENGTH, HEIGHT, RADIUS, THICKNESS = 0.4, 0.2, 0.04, 1e-3
LAMINA = {"E1": 15e9, "E2": 5e9, "nu12": 0.25, "G": 4.8e9}     # OMPPD table 2
ANGLES = (0, 30, 45, 60, 90)                                    # zeta in degrees, OMPPD Fig. 10
DENSITY = 2500.0


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
    """Quadrilaterals with curved edges, in which points are found as if the edges were straight (they are, but at the hole)."""

    def element_finder(self, mapping=None):
        return MeshQuad(self.doflocs[:, :self.nvertices], self.t).element_finder()


def lamina_mesh(n, clamp):
    """Quadrilaterals around the hole, `n` along an eighth of it, with a mesh line at a distance `clamp` from both ends.

    The square |x| < HEIGHT/2 is cut into rays of the hole; rectangles continue it to both ends.  Edges on the hole are curved.
    """
    half, end = HEIGHT / 2, LENGTH / 2
    side = np.linspace(-half, half, 2 * n + 1)
    border = np.concatenate([np.column_stack([half + 0 * side, side])[:-1], np.column_stack([-side, half + 0 * side])[:-1],
                             np.column_stack([-half + 0 * side, -side])[:-1], np.column_stack([side, -half + 0 * side])[:-1]])
    ring = RADIUS * border / np.hypot(*border.T)[:, None]
    depth = np.linspace(0, 1, n + 1)**1.3                       # finer at the hole
    points = (ring[None] + depth[:, None, None] * (border - ring)[None]).reshape(-1, 2)
    around = len(border)
    quads = [(k * around + j, k * around + (j + 1) % around, (k + 1) * around + (j + 1) % around, (k + 1) * around + j)
             for k in range(n) for j in range(around)]
    mesh = MeshQuad(points.T, np.array(quads).T)
    long = np.unique(np.r_[np.linspace(half, end - clamp, n), np.linspace(end - clamp, end, max(2, n // 6))])
    right = MeshQuad.init_tensor(long, side)
    mesh = mesh + right + MeshQuad.init_tensor(-long[::-1], side)
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
