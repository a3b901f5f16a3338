"""Deflections of a cantilever and of Cook's membrane over Poisson's ratio, by biquadratic finite elements in plane strain.

Prints the mean deflection of the loaded side, um, on two meshes, for E = 1 GPa and 1 kN over a thickness of 1 m: the known values of
crates/ligament-verify/src/published/incompressible-bodies.csv are those of the finer one. Run with the packages of requirements-reference.txt:

    python tools/reference_sheared_bodies.py
"""

import numpy as np
import scipy.sparse as sparse
from scipy.sparse.linalg import spsolve

YOUNG = 1e9
FORCE = 1e3
RATIOS = [0.25, 0.3, 0.4, 0.45, 0.49, 0.4999]


def cantilever(s, t):
    """Positions in the cantilever of 0.4 x 0.1 m for s and t from 0 to 1."""
    return 0.4 * s, 0.1 * t


def cooks_membrane(s, t):
    """Positions in Cook's membrane, 48 mm wide, from 44 mm high at the left to 16 mm at the right."""
    return 0.048 * s, 0.044 * s * (1 - t) + (0.044 + 0.016 * s) * t


def shape(s):
    """Quadratic shape functions of the nodes at -1, 0 and 1."""
    return np.array([s * (s - 1) / 2, 1 - s * s, s * (s + 1) / 2])


def slope(s):
    """Their derivatives."""
    return np.array([s - 0.5, -2 * s, s + 0.5])


def stiffnesses(places, elasticity):
    """Stiffness of each quadrilateral from the places of its nine nodes, shape (n_cells, 18, 18), by nine Gauss points."""
    gauss = zip([-np.sqrt(0.6), 0.0, np.sqrt(0.6)], np.array([5, 8, 5]) / 9)
    gauss = list(gauss)
    total = np.zeros((len(places), 18, 18))
    for s, weight_s in gauss:
        for t, weight_t in gauss:
            slopes = np.array([np.outer(slope(s), shape(t)).ravel(), np.outer(shape(s), slope(t)).ravel()])
            jacobian = np.einsum("kn,enx->ekx", slopes, places)
            gradients = np.linalg.solve(jacobian, np.broadcast_to(slopes, (len(places), 2, 9)))
            strains = np.zeros((len(places), 3, 18))
            strains[:, 0, 0::2] = strains[:, 2, 1::2] = gradients[:, 0]
            strains[:, 1, 1::2] = strains[:, 2, 0::2] = gradients[:, 1]
            weights = weight_s * weight_t * np.linalg.det(jacobian)
            total += weights[:, None, None] * np.einsum("eki,kl,elj->eij", strains, elasticity, strains)
    return total


def deflection(place, n, m, poisson):
    """Mean deflection of the right side of n x m quadrilaterals, m, held at the left, under a uniform shear traction at the right."""
    rows, columns = 2 * n + 1, 2 * m + 1
    i, j = np.meshgrid(np.arange(rows), np.arange(columns), indexing="ij")
    positions = np.stack(place(i / (rows - 1), j / (columns - 1)), -1).reshape(-1, 2)
    first = YOUNG * poisson / ((1 + poisson) * (1 - 2 * poisson))
    shear = YOUNG / (2 * (1 + poisson))
    elasticity = np.array([[first + 2 * shear, first, 0], [first, first + 2 * shear, 0], [0, 0, shear]])
    a, b = (it.ravel() for it in np.meshgrid(np.arange(n), np.arange(m), indexing="ij"))
    nodes = np.stack([(2 * a + k) * columns + 2 * b + l for k in range(3) for l in range(3)], -1)
    values = stiffnesses(positions[nodes], elasticity)
    unknowns = np.stack([2 * nodes, 2 * nodes + 1], -1).reshape(len(nodes), 18)
    entries = (np.repeat(unknowns, 18, 1).ravel(), np.tile(unknowns, (1, 18)).ravel())
    stiffness = sparse.csr_matrix((values.ravel(), entries))
    force = np.zeros(2 * rows * columns)
    for side in range(m):
        for k, share in enumerate([1 / 6, 4 / 6, 1 / 6]):
            force[2 * ((rows - 1) * columns + 2 * side + k) + 1] += FORCE * share / m
    free = np.arange(2 * columns, 2 * rows * columns)
    motion = spsolve(stiffness[free][:, free].tocsc(), force[free])
    return force[free] @ motion / FORCE


if __name__ == "__main__":
    for name, place, meshes in [
        ("cantilever", cantilever, [(96, 24), (192, 48)]),
        ("Cook's membrane", cooks_membrane, [(48, 48), (96, 96)]),
    ]:
        for poisson in RATIOS:
            found = [1e6 * deflection(place, *mesh, poisson) for mesh in meshes]
            print(name, poisson, *[f"{it:.3f}" for it in found], flush=True)
