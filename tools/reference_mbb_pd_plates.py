#!/usr/bin/env python3
"""The elastic plates and the thick cylinder of the MBB-PD paper: finite elements, and the lattice of reference_mbb_pd.py.

This is not part of the program.  Masoumi, Ravandi and Salehi (MBB-PD), sections 4.1 and 4.2: a square plate of 100 mm in
tension, sheared and heated, and a thick cylinder under pressure.  Finite elements say what the continuum does, the lattice
how far from it the model should be.  The bodies of the elements end where the prescribed points of the lattice stand.

    pip install -r tools/requirements-reference.txt
    python tools/reference_mbb_pd_plates.py [DIRECTORY]     # default: tests/reference beside this script's folder

writes DIRECTORY/mbb-pd-elements.csv (mm and um) and mbb-pd-lattice.csv (SI), and prints the sheared plate at all ratios; six minutes.
"""
import sys
from pathlib import Path
import numpy as np
from scipy.sparse.linalg import splu
from skfem import LinearForm, MeshQuad
from skfem.helpers import sym_grad
from reference_fem import Continuum, CurvedMesh, isotropic_tensor, write
from reference_mbb_pd import SIDE, EXPANSION, THICKNESS, YOUNG, Body, Lattice, held_rows, plane_strain, square, through_circle


PROBLEMS = ("shear", "thermal", "thermal-left")


def conditions(problem, x, y, bottom, top, left):
    """Prescribed displacements of section 4.1 as pairs for `held_rows`; `bottom`, ... are masks."""
    if problem == "shear":
        return [(bottom, (0.0, 0.0)), (top, (1e-3, 0.0))]
    return [(bottom | top | (left if problem == "thermal-left" else False), (0.0, 0.0))]


def material(problem, nu=0.3):
    """Plane stress, `nu` in shear, 0.4 in the thermal problems; and the strain that the temperature gives."""
    if problem == "shear":
        return isotropic_tensor(YOUNG, nu), np.zeros(3)
    return isotropic_tensor(YOUNG, 0.4), EXPANSION * 50.0 * np.array([1.0, 1.0, 0.0])


def finite_elements(problem, d, n, nu=0.3):
    """Displacements (n, 2) of the continuum at points, and the force along x on the top, as a function.

    The body ends where the prescribed points of the lattice stand, d/2 inside of its sides; n x n biquadratic elements,
    finer towards the corners.
    """
    half, graded = SIDE / 2, 0.5 * (1 - np.cos(np.pi * np.linspace(0, 1, n + 1)))
    low_x, low_y, high_y = -half + (d / 2 if problem == "thermal-left" else 0.0), -half + d / 2, half - d / 2
    axes = low_x + (half - low_x) * graded, low_y + (high_y - low_y) * graded
    C, expansion = material(problem, nu)
    body = Continuum(CurvedMesh.from_mesh(MeshQuad.init_tensor(*axes)), C)
    stress = C @ expansion

    @LinearForm
    def thermal(v, _):
        e = sym_grad(v)
        return THICKNESS * (stress[0] * e[0, 0] + stress[1] * e[1, 1] + 2 * stress[2] * e[0, 1])
    x, y = body.x
    near = lambda one, other: np.abs(one - other) < 1e-9
    held, value = np.zeros(len(x), bool), np.zeros(len(x))
    for points, motion in conditions(problem, x, y, near(y, low_y), near(y, high_y), near(x, low_x)):
        held |= points
        value = np.where(points & body.horizontal, motion[0], np.where(points, motion[1], value))
    u, load = np.where(held, value, 0.0), thermal.assemble(body.basis)
    u[~held] = splu(body.K[~held][:, ~held].tocsc()).solve((load - body.K @ u)[~held])
    force = (body.K @ u - load)[near(y, high_y) & body.horizontal].sum()
    return lambda points: body.at(points, u), force


def lattice_solution(problem, d, nu=0.3):
    """The same on the lattice: (n, 2) and the force along x on the top row."""
    C, expansion = material(problem, nu)
    plate = square(d, c=C)
    last = plate.ny - 1
    held, value = held_rows(plate, conditions(problem, *plate.x.T, plate.row == 0, plate.row == last, plate.column == 0))
    body = Body(plate)
    thermal = body.thermal(np.tile(expansion, (plate.n, 1)))
    u = body.solve(held, value, thermal=thermal)
    force = body.K @ u - body.B.T @ (body.C @ thermal)
    return plate, u.reshape(2, -1).T, force[:plate.n][plate.row == last].sum()


def shear(d, nu):
    """Force on the top, N, and u_y at the right end of the row above the middle, um: by finite elements, then of the lattice."""
    (at, force), (plate, u, lattice_force) = finite_elements("shear", d, 60, nu), lattice_solution("shear", d, nu)
    side = np.flatnonzero((plate.column == plate.nx - 1) & (plate.row == plate.ny // 2))
    return force, 1e6 * at(plate.x[side])[0, 1], lattice_force, 1e6 * u[side[0], 1]


def tension(d, nu, axis, stress=200e6):
    """u across the load at the middle of a free side, m, less -nu s/E (L - d)/2; `stress` on the outer rows of points."""
    plate = square(d, c=isotropic_tensor(YOUNG, nu))
    line = plate.row if axis == 1 else plate.column
    force = np.zeros((2, plate.n))
    force[axis, line == plate.ny - 1], force[axis, line == 0] = stress * d * THICKNESS, -stress * d * THICKNESS
    middle = plate.number[plate.frame:-plate.frame, plate.frame:-plate.frame][plate.ny // 2 - 1:, plate.nx // 2 - 1:]
    held = np.zeros((2, plate.n), bool)
    held[0, middle[0, 0]] = held[1, middle[0, 0]] = held[1 - axis, middle[(1, 0) if axis == 1 else (0, 1)]] = True
    u = Body(plate).solve(held.ravel(), np.zeros(2 * plate.n), force.ravel()).reshape(2, -1)
    across, cross = 1 - axis, plate.column if axis == 1 else plate.row
    side = lambda at: u[across, (cross == at) & ((line == plate.ny // 2) | (line == plate.ny // 2 - 1))].mean()
    return 0.5 * (side(plate.nx - 1) - side(0)) + nu * stress / YOUNG * 0.5 * (SIDE - d)


def cylinder(d, nu, inner=1.5, outer=2.2, pressure=400e6):
    """Section 4.2, plane strain: relative L2 error of u_r against Lame's solution.

    The pressure pushes each face of a cell towards a removed cell of the hole, p d h.
    """
    cells = 2 * round(outer / d)
    keep = lambda x: (np.hypot(*x.T) >= inner) & (np.hypot(*x.T) <= outer)
    body = Lattice(cells, cells, d, 3, plane_strain(YOUNG, nu), keep, through_circle(inner))
    force, here = np.zeros((2, body.n)), np.hypot(*body.x.T) < 0.5 * (inner + outer)
    for axis, (p, q) in ((0, (1, 0)), (0, (-1, 0)), (1, (0, 1)), (1, (0, -1))):
        force[axis] -= (p + q) * pressure * d * THICKNESS * (here & (body.neighbour(p, q) < 0))
    half, far = cells // 2, lambda row, column: body.number[row + body.frame, column + body.frame]
    held = np.zeros((2, body.n), bool)
    held[:, far(half, cells - 1)] = held[1, far(half, 0)] = True
    u = Body(body).solve(held.ravel(), np.zeros(2 * body.n), force.ravel()).reshape(2, -1).T
    rigid = np.column_stack([np.r_[np.ones(body.n), np.zeros(body.n)], np.r_[np.zeros(body.n), np.ones(body.n)],
                             np.r_[-body.x[:, 1], body.x[:, 0]]])
    motion = np.linalg.lstsq(rigid, u.T.ravel(), rcond=None)[0]
    u = u - (rigid @ motion).reshape(2, -1).T
    r = np.hypot(*body.x.T)
    A = pressure * inner**2 / (outer**2 - inner**2)
    exact = (1 + nu) / YOUNG * A * ((1 - 2 * nu) * r + outer**2 / r)
    return np.linalg.norm((u * body.x).sum(1) / r - exact) / np.linalg.norm(exact)


def griffith(crack, a, G_c=6137.0):
    """Stress on the whole section (Pa) at which G = G_c: the plate of section 4.3 with a central crack of 2a, or edge cracks of a.

    A quarter, pulled by its upper side (u_y alone) as the lattice is; G from the energies of two lengths, each tip h to
    either side.  The error of the energy goes with the size h of the elements, and is extrapolated to h = 0.
    """
    found = []
    for n in (100, 200):
        half, h = SIDE / 2, SIDE / 2 / n
        side = np.linspace(0, half, n + 1)
        body = Continuum(CurvedMesh.from_mesh(MeshQuad.init_tensor(side, side)), isotropic_tensor(YOUNG, 0.3))
        x, y = body.x
        top = (y > half - 1e-9) & ~body.horizontal

        def energy(a):                                          # of the quarter at 1/2 m of displacement
            is_open = (x < a - 1e-9) if crack == "central" else (x > half - a + 1e-9)
            held = ((x < 1e-9) & body.horizontal) | ((y < 1e-9) & ~is_open & ~body.horizontal) | top
            u = body.solve(held, 0.5 * top)
            return 0.5 * u @ (body.K @ u), (body.K @ u)[top].sum()
        G = (energy(a - 2 * h)[0] - energy(a + 2 * h)[0]) / (2 * h * THICKNESS)
        found.append(np.sqrt(G_c / G) * energy(a)[1] / (half * THICKNESS))
    return 2 * found[1] - found[0]


def plates(folder):
    """Finite elements at points of a quarter (`thermal`) or a half of the plate: all (2 mm) or every second (1 mm)."""
    elements, lattice = [], []
    for problem in PROBLEMS:
        for d, every in ((2e-3, 1), (1e-3, 2)):
            (at, force), (plate, u, lattice_force) = finite_elements(problem, d, 60), lattice_solution(problem, d)
            exact = at(plate.x)
            # The heated plates are symmetric about their middle row, one of them and the sheared plate about x = 0.
            some = (plate.row % every == 0) & (plate.column % every == 0)
            some &= ((plate.x[:, 0] > 0) | (problem == "thermal-left")) & ((plate.x[:, 1] > 0) | (problem == "shear"))
            relative = lambda of: np.linalg.norm((u - exact)[of], axis=0) / np.linalg.norm(exact[of], axis=0)
            error, error_written = relative(slice(None)), relative(some)
            middle = np.flatnonzero((plate.column == plate.nx - 1) & (plate.row == plate.ny // 2))[0]
            lattice += [(problem, d, "", "error_x", error[0]), (problem, d, "", "error_y", error[1]),
                        (problem, d, "", "error_written_x", error_written[0]), (problem, d, "", "error_written_y", error_written[1]),
                        (problem, d, "", "ux_middle", u[middle, 0]), (problem, d, "", "ux_middle_elements", exact[middle, 0])]
            if problem == "shear":
                lattice += [(problem, d, "", "force", lattice_force), (problem, d, "", "force_elements", force)]
            elements += [(problem, d * 1e3, *np.round(1e3 * plate.x[p], 1), *(float(f"{1e6 * v:.3f}") for v in exact[p]))
                         for p in np.flatnonzero(some)]
    for d in (2e-3, 1e-3):
        for nu in (-0.4, -0.2, 0.0, 0.2, 0.4):
            lattice += [("tension-" + "xy"[axis], d, nu, "difference", tension(d, nu, axis)) for axis in (1, 0)]
    for d in (0.1, 0.05, 0.025):
        lattice += [("cylinder", d, nu, "error", cylinder(d, nu)) for nu in (0.1, -0.1)]
    lattice += [("griffith-central", "", 0.3, "stress", griffith("central", 0.005)),
                ("griffith-edges", "", 0.3, "stress", griffith("edges", 0.01))]
    write(folder / "mbb-pd-elements.csv", "problem,d_mm,x_mm,y_mm,ux_um,uy_um", elements)
    write(folder / "mbb-pd-lattice.csv", "problem,d,nu,quantity,value", lattice)
    for row in lattice:
        print(*row)
    for d in (2e-3, 1e-3, 5e-4):
        for nu in (-0.4, -0.2, 0.0, 0.2, 0.4):
            print("shear", d, nu, *shear(d, nu))


if __name__ == "__main__":
    plates(Path(sys.argv[1]) if len(sys.argv) > 1 else Path(__file__).resolve().parent.parent / "tests" / "reference")
