#!/usr/bin/env python3
"""Independent reference calculation of MBB-PD on square lattices.

This is not part of the program.  It is a second, plain implementation of the modified bond-based model of Masoumi, Ravandi
and Salehi (MBB-PD: a bond with a local imaginary element), written from the theory alone, in the form that is free of its
printed inconsistencies:
    - strains of a bond from its imaginary element, eqs 12-15, with undeformed lengths; one-sided where a neighbour is
      missing or the bond to it is broken, and from one corner where the other is missing or both its edges are broken;
    - every bond carries all three components: U = sum w/2 S.c.S, w = (psi_j + psi_k)/2 |xi| V^2, psi = 2/(V sum |xi|) over
      the undamaged family, so that the energy of any uniform strain is that of the continuum;
    - a bond breaks where (S_n/s_I)^2 + (S_xy/g_II)^2 = 1: s_I from eq. C.4, g_II from C.1 with a shear strain.
Bonds that a pre-crack cuts, or touches with an end, are broken from the start.  It is meant to be read, not to be fast.

    pip install -r tools/requirements-reference.txt
    python tools/reference_mbb_pd.py [DIRECTORY]        # default: tests/reference beside this script's folder

writes DIRECTORY/mbb-pd-*.csv and prints what it finds (ten minutes).  SI units, thickness 1 mm.  Unknowns of a point: u_x, u_y.  Points are the centres of square
cells, numbered along x first, from 1 in the files; the origin is in the middle of the grid.
"""
import sys
from pathlib import Path
import numpy as np
import scipy.sparse as sp
from scipy.sparse.linalg import splu
from reference_fem import isotropic_tensor, stiffness_tensor, write

YOUNG, FRACTURE_ENERGY, THICKNESS, SIDE, EXPANSION = 65.8e9, 6137.0, 1e-3, 0.1, 23e-6
TIE = 1e-8                                                      # bonds as near to the largest demand break with it


def plane_strain(E, nu):
    return E / ((1 + nu) * (1 - 2 * nu)) * np.array([[1 - nu, nu, 0], [nu, 1 - nu, 0], [0, 0, 0.5 - nu]])


class Lattice:
    """Points of a grid about the origin where `keep` (of the centres) says so, with their bonds.

    The family of a point: all others within m d, inclusive to 1e-9.  A bond j-k has the offset (p, q) in spacings, upwards
    or, on a row, to the right.  `across` (of the ends) says which bonds do not exist.
    """

    def __init__(self, nx, ny, d, m, c, keep=None, across=None):
        self.nx, self.ny, self.d, self.m, self.c, self.V = nx, ny, d, m, c, d * d * THICKNESS
        row, column = (index.ravel() for index in np.mgrid[:ny, :nx])
        x = np.column_stack([(2 * column - nx + 1) * d / 2, (2 * row - ny + 1) * d / 2])
        kept = np.ones(len(x), bool) if keep is None else keep(x)
        self.x, self.row, self.column, self.n = x[kept], row[kept], column[kept], kept.sum()
        self.frame = int(m) + 1                                 # of missing points around the grid
        self.number = np.full((ny + 2 * self.frame, nx + 2 * self.frame), -1)
        self.number[self.row + self.frame, self.column + self.frame] = np.arange(self.n)
        reach = range(-int(m), int(m) + 1)
        self.offsets = [(p, q) for q in reach for p in reach
                        if (q > 0 or (q == 0 and p > 0)) and np.hypot(p, q) <= m * (1 + 1e-9)]
        bonds = []
        for p, q in self.offsets:
            k = self.neighbour(p, q)
            bonds.append([(j, k[j], p, q) for j in np.flatnonzero(k >= 0)])
        bonds = np.concatenate([of for of in bonds if of])
        if across is not None:
            bonds = bonds[~across(self.x[bonds[:, 0]], self.x[bonds[:, 1]])]
        self.j, self.k, self.p, self.q = bonds[np.lexsort((bonds[:, 1], bonds[:, 0]))].T
        self.count, self.length = len(self.j), d * np.hypot(self.p, self.q)
        self.bond_at = {offset: np.full(self.n, -1) for offset in self.offsets}
        for offset in self.offsets:
            these = self.of_offset(*offset)
            self.bond_at[offset][self.j[these]] = these
        sums = np.bincount(self.j, self.length, self.n) + np.bincount(self.k, self.length, self.n)
        self.psi = 2 / (self.V * sums)
        self.weight = 0.5 * (self.psi[self.j] + self.psi[self.k]) * self.length * self.V**2
        self.intact = np.ones(self.count, bool)

    def of_offset(self, p, q):
        return np.flatnonzero((self.p == p) & (self.q == q))

    def neighbour(self, p, q):
        """The point with offset (p, q) from each point, -1 where there is none."""
        return self.number[self.row + q + self.frame, self.column + p + self.frame]

    def link(self, p, q):
        """Whether each point has an intact bond with offset (p, q)."""
        if (p, q) in self.bond_at:
            bond = self.bond_at[p, q]
        else:                                                   # it belongs to the other end
            other = self.neighbour(p, q)
            bond = np.where(other >= 0, self.bond_at[-p, -q][other], -1)
        return (bond >= 0) & self.intact[bond]

    def precrack(self, *cracks):
        """Breaks the bonds that meet segments, ends included: exactly, as tips are rounded to d/20.  Returns their number."""
        at = 10 * np.column_stack([2 * self.column - self.nx + 1, 2 * self.row - self.ny + 1])
        j, k, before = at[self.j], at[self.k], self.intact.sum()

        def turn(a, b, c):
            return np.sign((b - a)[..., 0] * (c - a)[..., 1] - (b - a)[..., 1] * (c - a)[..., 0])
        for crack in cracks:
            tips = np.round(20 * np.array(crack) / self.d).astype(int)
            turns = turn(j, k, tips[0]), turn(j, k, tips[1]), turn(*tips, j), turn(*tips, k)
            assert not np.all(np.array(turns) == 0, axis=0).any(), "no bond lies along a crack"
            self.intact &= ~((turns[0] * turns[1] <= 0) & (turns[2] * turns[3] <= 0))
        return before - self.intact.sum()

    def strains(self):
        """Matrix (3, bonds, 2n) of S_xx, S_yy, S_xy, blocks u_x and u_y, and which intact bonds have them."""
        entries, carries, d = [], self.intact.copy(), self.d

        def difference(component, displacement, bonds, plus, minus, factor):
            """Adds factor (phi(plus) - phi(minus)) to a component of bonds."""
            rows = component * self.count + bonds
            entries.append((rows, displacement * self.n + plus, factor))
            entries.append((rows, displacement * self.n + minus, -factor))

        here = np.arange(self.n)
        for axis in (0, 1):                                     # H bonds (eqs 12, 13), V bonds the other way round
            bonds = np.flatnonzero((self.q if axis == 0 else self.p) == 0)
            other, along, side = 1 - axis, 1 / self.length[bonds], (0, 1) if axis == 0 else (1, 0)
            difference(axis, axis, bonds, self.k[bonds], self.j[bonds], along)
            difference(2, other, bonds, self.k[bonds], self.j[bonds], along)
            ahead, behind = self.link(*side), self.link(-side[0], -side[1])
            plus = np.where(ahead, self.neighbour(*side), here)
            minus = np.where(behind, self.neighbour(-side[0], -side[1]), here)
            sides = ahead.astype(int) + behind
            ends = (sides[self.j[bonds]] > 0).astype(int) + (sides[self.k[bonds]] > 0)
            carries[bonds] &= ends > 0
            for end in (self.j[bonds], self.k[bonds]):
                has = sides[end] > 0
                point, factor = end[has], 1 / (ends[has] * sides[end[has]] * d)
                difference(other, other, bonds[has], plus[point], minus[point], factor)
                difference(2, axis, bonds[has], plus[point], minus[point], factor)
        for p, q in self.offsets:                               # S bonds, eqs 14, 15
            if p == 0 or q == 0:
                continue
            bonds = self.of_offset(p, q)
            j, k = self.j[bonds], self.k[bonds]
            a, b = self.neighbour(0, q)[j], self.neighbour(p, 0)[j]
            has_a = (a >= 0) & (self.link(0, q)[j] | self.link(-p, 0)[k])
            has_b = (b >= 0) & (self.link(p, 0)[j] | self.link(0, -q)[k])
            corners = has_a.astype(int) + has_b
            carries[bonds] &= corners > 0
            for has, component, displacement, plus, minus, length in (
                    (has_b, 0, 0, b, j, p * d), (has_a, 0, 0, k, a, p * d),
                    (has_a, 1, 1, a, j, q * d), (has_b, 1, 1, k, b, q * d),
                    (has_a, 2, 0, a, j, q * d), (has_b, 2, 0, k, b, q * d),
                    (has_b, 2, 1, b, j, p * d), (has_a, 2, 1, k, a, p * d)):
                difference(component, displacement, bonds[has], plus[has], minus[has], 1 / (corners[has] * length))
        rows, columns, values = (np.concatenate(part) for part in zip(*entries))
        return sp.csr_matrix((values, (rows, columns)), shape=(3 * self.count, 2 * self.n)), carries


class Body:
    """Energy and stiffness of a lattice with the bonds that are intact now."""

    def __init__(self, lattice, fold=None):
        self.lattice = lattice
        self.B, carries = lattice.strains()
        self.w = lattice.weight * carries
        self.C = sp.kron(sp.csr_matrix(lattice.c), sp.diags(self.w), format="csr")
        B = self.B if fold is None else self.B @ fold
        self.K = (B.T @ self.C @ B).tocsc()

    def thermal(self, strain):
        """Strains (3 bonds) that a temperature gives to bonds, the mean of the ends of S_T (n, 3)."""
        mean = 0.5 * (strain[self.lattice.j] + strain[self.lattice.k])
        return mean.T.ravel()

    def solve(self, held, value, force=None, thermal=None):
        """Displacements (2n) with some held at values; forces (2n) and strains of the temperature (3 bonds) may act."""
        u, free = np.where(held, value, 0.0), ~held
        load = np.zeros(len(u)) if force is None else force.copy()
        if thermal is not None:
            load += self.B.T @ (self.C @ thermal)
        matrix = self.K[free][:, free]
        solver = splu(matrix.tocsc(), permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0.0, options={"SymmetricMode": True})
        for _ in range(2):                                      # the second pass refines
            u[free] += solver.solve((load - self.K @ u)[free])
        return u

    def energy(self, u, thermal=0.0):
        S = self.B @ u - thermal
        return 0.5 * S @ (self.C @ S)


def limits(lattice, nu, G_c=FRACTURE_ENERGY):
    """s_I (eq. C.4) and g_II: each bond that crosses a crack of a spacing, counted once."""
    c, V, d = lattice.c, lattice.V, lattice.d
    psi = 2 / (V * 2 * d * sum(np.hypot(p, q) for p, q in lattice.offsets))
    K_1, K_2, K_6 = psi * c.sum(axis=1)
    opened, slid = 0.0, 0.0
    for p, q in lattice.offsets:
        if q == 0:
            continue
        slid += q * np.hypot(p, q) * d
        if p == 0:
            opened += q * K_2 * q * d
        else:
            t = np.arctan2(q, abs(p))
            opened += q * ((nu**2 * K_1 + 0.5 * np.tan(t) * np.sin(t)**2 * K_6) * abs(p) * d
                           + (K_2 + 0.5 / np.tan(t) * np.sin(t)**2 * K_6) * q * d)
    crack = 2 * G_c * d * THICKNESS / V**2
    return np.sqrt(crack / opened), np.sqrt(crack / (psi * c[2, 2] * slid))


def demand(lattice, S, s_I, g_II):
    """r of each bond: it breaks where r = 1."""
    xx, yy, xy = S.reshape(3, -1)
    normal = np.where(lattice.q == 0, xx, np.where(lattice.p == 0, yy, np.maximum(xx, yy)))
    return np.hypot(np.maximum(normal, 0) / s_I, xy / g_II)


def printed_stretches(lattice, nu, mode, G_c=FRACTURE_ENERGY):
    """s_c of the points as printed (C.4 in mode "I", C.9 in mode "M"): half the sum over the bonds that a point has left.

    The micro-modulus of a bond has the mean psi of its ends; cot(90 degrees) is 0.
    """
    K_1, K_2, K_6 = lattice.c.sum(axis=1)
    x, y = np.abs(lattice.p) * lattice.d, np.abs(lattice.q) * lattice.d
    shear, sine = (lattice.p != 0) & (lattice.q != 0), y / np.hypot(x, y)
    tan, cot = np.divide(y, x, out=np.zeros(len(x)), where=shear), np.divide(x, y, out=np.zeros(len(x)), where=shear)
    of_1, of_6, of_V = (nu**2, sine**2, K_2) if mode == "I" else ((tan - nu)**2, (1 + sine)**2, K_1)
    sums = np.where(shear, (of_1 * K_1 + 0.5 * tan * of_6 * K_6) * x + (K_2 + 0.5 * cot * of_6 * K_6) * y, of_V * y)
    sums = sums * np.abs(lattice.q) * lattice.intact * 0.5 * (lattice.psi[lattice.j] + lattice.psi[lattice.k])
    of_points = 0.5 * (np.bincount(lattice.j, sums, lattice.n) + np.bincount(lattice.k, sums, lattice.n))
    with np.errstate(divide="ignore"):
        return np.sqrt(2 * G_c * lattice.d * THICKNESS / lattice.V**2 / of_points)


def printed_demand(lattice, S, nu, mode):
    """r of each bond as printed: own stretch of H and V bonds, angle (A.6) of S bonds over s_c sin(t) or s_c (1 +- sin(t))."""
    xx, yy, xy = S.reshape(3, -1)
    s_c = printed_stretches(lattice, nu, mode)
    s_c = np.minimum(s_c[lattice.j], s_c[lattice.k])
    shear = (lattice.p != 0) & (lattice.q != 0)
    tan = np.divide(lattice.q, lattice.p, out=np.ones(len(xx)), where=shear)
    angle, sine = (xy + xx / tan + yy * tan) * np.sign(tan), np.abs(lattice.q) / np.hypot(lattice.p, lattice.q)
    sine = np.where(shear, sine, 0.5)
    of_angle = angle / sine if mode == "I" else np.abs(angle) / (1 + np.where(angle * yy < 0, -1, 1) * sine)
    return np.maximum(np.where(lattice.q == 0, xx, np.where(lattice.p == 0, yy, of_angle)) / s_c, 0)


def exact_path(lattice, held, value, nu, safe, events, fold=None, stop=0.0, tie=TIE, mode=None):
    """The exact path, with the criterion as printed in a `mode`, "I" or "M", if one is given: a row an event (load factor, force work-conjugate to `value`, energy, bonds, gap to the next bond).

    `safe` points keep their bonds.  With `fold` (2n, unknowns) displacements are those of a symmetric body.
    """
    limit = limits(lattice, nu)
    breakable = ~(safe[lattice.j] | safe[lattice.k])
    rows, peak, start = [], 0.0, None
    while len(rows) < events:
        body = Body(lattice, fold)
        u = body.solve(held, value)
        force = value @ (body.K @ u)                            # twice the energy at load factor one, per unit of `value`
        start = start or force
        if force < max(1e-3 * start, 0.0):                      # it is in parts
            break
        S = body.B @ (u if fold is None else fold @ u)
        r = demand(lattice, S, *limit) if mode is None else printed_demand(lattice, S, nu, mode)
        r = r * (breakable & (body.w > 0))
        largest = r.max()
        bonds = np.flatnonzero(r >= largest * (1 - tie))
        rest = np.delete(r, bonds).max()
        rows.append((1 / largest, force / largest, 0.5 * force / largest**2, bonds, 1 - rest / largest))
        peak = max(peak, force / largest)
        if force / largest < stop * peak:
            break
        lattice.intact[bonds] = False
    return rows


def square(d, m=3, c=None, **parts):
    """The plate of the paper: 100 x 100 x 1 mm."""
    cells = round(SIDE / d)
    return Lattice(cells, cells, d, m, isotropic_tensor(YOUNG, 0.3) if c is None else c, **parts)


def held_rows(lattice, prescribed):
    """Arrays `held`, `value` (2n) from pairs of points (mask) and (u_x, u_y), None for free."""
    held, value = np.zeros((2, lattice.n), bool), np.zeros((2, lattice.n))
    for points, motion in prescribed:
        for component, wanted in enumerate(motion):
            if wanted is not None:
                held[component, points], value[component, points] = True, wanted
    return held.ravel(), value.ravel()


def unit_values():
    """Numbers that need no solution: sums of lengths over d, psi, weights, diagonal of K, limits."""
    plate = square(1e-3)
    at = lambda row, column: row * plate.nx + column
    sums = 2 / (plate.V * plate.psi) / plate.d
    K = Body(plate).K
    bond = lambda p, q: plate.weight[plate.bond_at[p, q][at(50, 50)]]
    rows = [("bonds", plate.count), ("horizontal", (plate.q == 0).sum()), ("vertical", (plate.p == 0).sum()),
            ("inclined", ((plate.p != 0) & (plate.q != 0)).sum()),
            ("lengths-interior", sums[at(50, 50)]), ("lengths-edge", sums[at(0, 50)]), ("lengths-corner", sums[0]),
            ("lengths-second-row", sums[at(1, 50)]), ("psi-interior", plate.psi[at(50, 50)]),
            ("weight-1-0", bond(1, 0)), ("weight-0-2", bond(0, 2)), ("weight-1-1", bond(1, 1)), ("weight-2-1", bond(2, 1)),
            ("diagonal-interior", K[at(50, 50), at(50, 50)]), ("diagonal-edge-x", K[at(0, 50), at(0, 50)]),
            ("diagonal-edge-y", K[plate.n + at(0, 50), plate.n + at(0, 50)])]
    for m, d in ((3, 5e-4), (3, 1e-3), (3, 2e-3), (2, 1e-3), (4, 1e-3)):
        s_I, g_II = limits(square(d, m), 0.3)
        rows += [(f"s_I-m{m}-{1e3 * d:g}mm", s_I), (f"g_II-m{m}-{1e3 * d:g}mm", g_II)]
    return rows


def quarter(plate):
    """The unknowns of a quarter x, y > 0 of a body that is symmetric about both axes: (2n, unknowns)."""
    quarter = np.flatnonzero((plate.x > 0).all(axis=1))
    place = np.full(plate.n, -1)
    place[quarter] = np.arange(len(quarter))
    image = np.abs(np.column_stack([2 * plate.column - plate.nx + 1, 2 * plate.row - plate.ny + 1]))
    column, row = (image[:, 0] + plate.nx - 1) // 2, (image[:, 1] + plate.ny - 1) // 2
    of = place[plate.number[row + plate.frame, column + plate.frame]]
    sign, points = np.sign(plate.x), np.arange(plate.n)
    blocks = [sp.csr_matrix((sign[:, axis], (points, of)), shape=(plate.n, len(quarter))) for axis in (0, 1)]
    return sp.block_diag(blocks).tocsr(), quarter


def through_square(half):
    """Whether bonds cross the inside of the square |x|, |y| < half."""
    def across(one, other):
        enter, leave = np.zeros(len(one)), np.ones(len(one))
        for axis in (0, 1):
            with np.errstate(divide="ignore", invalid="ignore"):
                ends = (np.array([[-half], [half]]) - one[:, axis]) / (other - one)[:, axis]
            still = np.abs(other - one)[:, axis] < 1e-12
            inside = np.where(np.abs(one[:, axis]) < half - 1e-9, 1.0, -1.0) * np.inf
            enter = np.maximum(enter, np.where(still, -inside, ends.min(axis=0)))
            leave = np.minimum(leave, np.where(still, inside, ends.max(axis=0)))
        return leave - enter > 1e-9
    return across


def through_circle(radius):
    """Whether bonds cross the inside of a circle about the origin."""
    def across(one, other):
        step = other - one
        along = np.clip(-(one * step).sum(1) / (step**2).sum(1), 0, 1)
        return np.hypot(*(one + along[:, None] * step).T) < radius * (1 - 1e-9)
    return across


CRACKS = {"central": [[(-0.005, 0.0), (0.005, 0.0)]], "hole": [],
          "three": [[(-0.06, 0.0), (-0.04, 0.0)], [(0.04, 0.0), (0.06, 0.0)], [(0.0, 0.04), (0.0, 0.06)]]}


def fracture(case, d, stop=0.8, tie=TIE, mode=None):
    """Section 4.3: the exact path of a plate, with the criterion as printed in a `mode` if one is given.  The central crack and the square hole by quarters."""
    hole = 0.005
    parts = {} if case != "hole" else {"keep": lambda x: np.abs(x).max(axis=1) > hole, "across": through_square(hole)}
    plate = square(d, **parts)
    plate.precrack(*CRACKS[case])
    last, safe = plate.ny - 1, (plate.row < 3) | (plate.row >= plate.ny - 3)
    if case == "three":
        held, value = held_rows(plate, [(plate.row == 0, (None, 0.0)), (plate.row == last, (None, 1.0))])
        held[0] = True                                          # the whole may move along x
        return plate, exact_path(plate, held, value, 0.3, safe, 10**6, None, stop, tie, mode)
    fold, part = quarter(plate)
    top = plate.row[part] == last
    held, value = np.r_[np.zeros(len(part), bool), top], np.r_[np.zeros(len(part)), 0.5 * top]
    return plate, exact_path(plate, held, value, 0.3, safe, 10**6, fold, stop, tie, mode)


# 14 x 11 points 2 mm apart: lower row held, upper row moved by (10, 20) um where a set says nothing else.
PLATE_CRACKS = [[(-0.016, 0.001), (-0.005, 0.001)], [(0.004, -0.007), (0.0093, 0.0061)], [(0.010, -0.002), (0.010, 0.013)]]
LAMINA = {"E1": 120e9, "E2": 10e9, "nu12": 0.3, "G": 5e9}
SETS = {"stress": {}, "m2": {"m": 2}, "m4": {"m": 4}, "strain": {"c": plane_strain(YOUNG, 0.45)},
        "auxetic": {"c": isotropic_tensor(YOUNG, -0.4)}, "cracks": {"cracks": True}, "cracks-m2": {"cracks": True, "m": 2},
        "lamina": {"c": stiffness_tensor(**LAMINA, zeta=np.radians(30)), "cracks": True},
        "hole": {"hole": True}, "force": {"force": True, "cracks": True}, "thermal": {"thermal": True}}


def small_plates(folder):
    """Elastic plates: displacements, energy; strains of the bonds and a part of the stiffness of some."""
    rows, summary, strains, stiffness = [], [], [], []
    for name, of in SETS.items():
        parts = {} if "hole" not in of else {"keep": lambda x: np.hypot(*x.T) > 0.003, "across": through_circle(0.003)}
        plate = Lattice(14, 11, 2e-3, of.get("m", 3), of.get("c", isotropic_tensor(YOUNG, 0.3)), **parts)
        cut = plate.precrack(*PLATE_CRACKS) if "cracks" in of else 0
        body, last = Body(plate), plate.row == plate.ny - 1
        ends = [(plate.row == 0, (0.0, 0.0))]
        force, thermal = np.zeros((2, plate.n)), np.zeros(3 * plate.count)
        if "force" in of:
            force[:, last] = [[50.0], [100.0]]
        elif "thermal" in of:
            dT = 40 + plate.x @ [1000.0, -500.0]
            thermal = body.thermal(EXPANSION * dT[:, None] * [1.0, 1.0, 0.0])
        else:
            ends.append((last, (1e-5, 2e-5)))
        u = body.solve(*held_rows(plate, ends), force.ravel(), thermal)
        rows += [(name, p + 1, *plate.x[p], u[p], u[plate.n + p]) for p in range(plate.n)]
        summary.append((name, plate.n, plate.count, cut, body.energy(u, thermal)))
        if name == "cracks-m2":
            S = (body.B @ u).reshape(3, -1).T
            strains += [(plate.j[b] + 1, plate.k[b] + 1, *S[b]) for b in range(plate.count) if body.w[b] > 0]
        if name == "cracks":
            K, tips = body.K.tocsr(), [0, 5 * 14 + 4, 6 * 14 + 11]
            for p, a in ((p, a) for p in tips for a in (0, 1)):
                row = K[a * plate.n + p]
                stiffness += [(p + 1, "xy"[a], q % plate.n + 1, "xy"[q // plate.n], value)
                              for q, value in sorted(zip(row.indices, row.data)) if value]
    write(folder / "mbb-pd-plate.csv", "set,point,x,y,ux,uy", rows)
    write(folder / "mbb-pd-plate-summary.csv", "set,points,bonds,cut,energy", summary)
    write(folder / "mbb-pd-bonds.csv", "a,b,xx,yy,xy", strains)
    write(folder / "mbb-pd-stiffness.csv", "a,i,b,j,stiffness", stiffness)


def small_breaks(folder):
    """20 x 20 points 1 mm apart with two cracks, pulled aslant: the first 50 events of the exact path."""
    rows = []
    for m in (3, 2):
        plate = Lattice(20, 20, 1e-3, m, isotropic_tensor(YOUNG, 0.3))
        plate.precrack([(-0.011, -0.0013), (-0.0031, 0.00045)], [(0.0022, 0.003), (0.0061, 0.0052)])
        ends = [(plate.row == 0, (0.0, 0.0)), (plate.row == 19, (3e-4, 1e-3))]
        safe = (plate.row < 3) | (plate.row > 16)
        path = exact_path(plate, *held_rows(plate, ends), 0.3, safe, 50)
        print(f"m = {m}: peak {max(row[1] for row in path):.6g}, closest decision {min(row[4] for row in path):.1e}")
        for event, (factor, force, energy, bonds, _) in enumerate(path):
            rows += [(m, event + 1, factor, energy, plate.j[bond] + 1, plate.k[bond] + 1) for bond in bonds]
    write(folder / "mbb-pd-breaks.csv", "m,event,factor,energy,a,b", rows)


def peaks(folder):
    """First breakage and peak of the fracture plates: stress on 100 x 1 mm, strain on 100 mm, bonds broken to the peak."""
    rows = []
    for case, d in (("central", 2e-3), ("central", 1e-3), ("three", 2e-3), ("three", 1e-3), ("hole", 1e-3)):
        plate, path = fracture(case, d)
        stress = [row[1] / (SIDE * THICKNESS) for row in path]
        peak = int(np.argmax(stress))
        rows.append((case, d, stress[0], path[0][0] / SIDE, stress[peak], path[peak][0] / SIDE, sum(len(row[3]) for row in path[:peak])))
        print(*rows[-1])
    write(folder / "mbb-pd-peaks.csv", "case,d,first,first_strain,peak,peak_strain,broken", rows)


def printed(_):
    """Prints first breakage and peak of the plates with the criterion as printed, and the bonds broken beside the line y = 0."""
    for case in ("central", "three", "hole"):
        for mode in "IM":
            plate, path = fracture(case, 2e-3, 0.5, TIE, mode)
            stress, broken = [row[1] / (SIDE * THICKNESS) for row in path], np.concatenate([row[3] for row in path[:-1]])
            beside = (plate.x[plate.j[broken], 1] * plate.x[plate.k[broken], 1] > 0).sum()
            print(case, "as printed,", mode, stress[0], max(stress), f"{beside} of {len(broken)} beside")


def units(folder):
    write(folder / "mbb-pd-units.csv", "name,value", unit_values())


def main(folder):
    for part in units, small_plates, small_breaks, peaks, printed:
        part(folder)


if __name__ == "__main__":
    main(Path(sys.argv[1]) if len(sys.argv) > 1 else Path(__file__).resolve().parent.parent / "tests" / "reference")
