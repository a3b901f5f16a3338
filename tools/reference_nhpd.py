#!/usr/bin/env python3
"""Independent reference calculation of NHPD, the micropolar peridynamics with non-unified horizon.

This is not part of the program.  It is a second, plain implementation, written from the published theory alone
(Zhang, Yang, Zhuang: "A micropolar peridynamics model with non-unified horizon for damage of solids with
different non-local effects"), and the program's results are compared with the numbers it writes.
It is meant to be read, not to be fast.  Where the paper is garbled it takes these readings:
counter-clockwise point rotations (shear = transverse stretch - mean rotation); the numerator of the domain
correction (eq. 13) is the target energy density e; the trial density (eq. 12) is divided by V_A once.

    pip install numpy scipy meshio
    python tools/reference_nhpd.py [DIRECTORY]       # default: tests/reference beside this script's folder

reads DIRECTORY/square.msh and disk.msh (Gmsh 4.1 ASCII), writes the CSV files there and prints checks.  SI units.
Unknowns of a point: u_x, u_y, rotation.  Points keep the order of the nodes in the mesh file.
"""
import sys
from pathlib import Path
import meshio
import numpy as np
import scipy.sparse as sp
from scipy.linalg import qr
from scipy.sparse.csgraph import connected_components
from scipy.sparse.linalg import splu
from scipy.spatial import cKDTree


class Model:
    """Points, horizons, bonds, stiffness densities and corrected factors of a plane triangle mesh."""

    def __init__(self, path, lam, E, nu, Ft, plane="stress", t=1.0, sweep_limit=10000):
        mesh = meshio.read(path)
        tri = mesh.cells_dict["triangle"]
        used = np.unique(tri)                                   # nodes of 2-D cells, in file order
        self.tags, self.x, self.n = node_tags(path)[used], mesh.points[used, :2], len(used)
        index = np.full(len(mesh.points), -1)
        index[used] = np.arange(self.n)
        self.groups = {}                                        # physical name -> point indices
        for name, (number, dim) in mesh.field_data.items():
            members = [block.data[phys == number].ravel() for block, phys
                       in zip(mesh.cells, mesh.cell_data["gmsh:physical"]) if block.dim == dim]
            nodes = index[np.unique(np.concatenate(members))]
            self.groups[name] = nodes[nodes >= 0]

        # volumes: a third of each triangle's area times the thickness to each corner
        e1, e2 = (mesh.points[tri[:, k], :2] - mesh.points[tri[:, 0], :2] for k in (1, 2))
        area = 0.5 * np.abs(e1[:, 0] * e2[:, 1] - e1[:, 1] * e2[:, 0])
        self.V, self.area = np.bincount(index[tri].ravel(), np.repeat(area * t / 3, 3), self.n), area.sum()

        # horizons and bonds: one per unordered pair, l <= max(h_A, h_B), inclusive to what single precision of the size leaves open
        tree = cKDTree(self.x)
        nearest = tree.query(self.x, k=2)[0][:, 1]
        self.h = h = lam * nearest
        size = 2 * np.linalg.norm(self.x - self.x.mean(axis=0), axis=1).max()
        slack = 1e-9 + np.minimum(8 * 2.0**-24 * size / nearest, 1e-3)
        pairs = np.sort(tree.query_pairs(h.max() * (1 + slack.max()), output_type="ndarray"), axis=1)
        pairs = pairs[np.lexsort((pairs[:, 1], pairs[:, 0]))]   # ordered by (A, B), A < B
        dx = self.x[pairs[:, 1]] - self.x[pairs[:, 0]]
        l = np.hypot(dx[:, 0], dx[:, 1])
        in_a, in_b = (l <= h[end] * (1 + slack[end]) for end in pairs.T)      # B in the horizon of A, A in that of B
        keep = in_a | in_b
        self.A, self.B = A, B = pairs[keep].T
        self.l, in_a, in_b, dx = l[keep], in_a[keep], in_b[keep], dx[keep]
        l, self.nb = self.l, keep.sum()
        self.a, self.b = a, b = dx.T / l
        self.H = H = np.where(in_a & in_b, (h[A] + h[B]) / 2, np.where(in_a, h[A], h[B]))

        # stiffness densities (eq. 6), target density (eq. 11 per eps^2), limit density (eq. 14)
        if plane == "stress":
            fc, fd, e0 = 1 / (1 - nu), (1 - 3 * nu) / (1 - nu**2), Ft**2 / (2 * E * (1 - nu**2))
            self.e, self.e_biaxial = E / (2 * (1 - nu**2)), E / (1 - nu)
        else:
            q = (1 - 2 * nu) * (1 + nu)
            fc, fd, e0 = 1 / q, (1 - 4 * nu) / q, Ft**2 * (1 - nu**2) * (1 - nu)**2 / (2 * E * (1 - 2 * nu))
            self.e, self.e_biaxial = E * (1 - nu) / (2 * q), E / q
        c, d = 6 * E * fc / (np.pi * t * H**3), E * fd / (6 * np.pi * t * H)
        self.e_shear = E / (4 * (1 + nu))                       # G gamma^2 / 2, per gamma^2
        self.kn, self.kt, self.kr = c, 12 * d / l**2, d / l

        # length factor (eq. 7)
        lmin, lmax = np.full(self.n, np.inf), np.zeros(self.n)
        np.minimum.at(lmin, np.r_[A, B], np.r_[l, l])
        np.maximum.at(lmax, np.r_[A, B], np.r_[l, l])

        def term(p):
            width = lmax[p] - lmin[p]
            one = width <= 1e-12 * lmax[p]                      # all bonds of p have one length
            return np.where(one, 1.0, np.exp((lmin[p] - l) / np.where(one, 1.0, width)))
        self.alpha = 0.5 * (term(A) + term(B))

        # iterative domain correction (eqs 11-13), sum rule
        self.omega, self.changes = np.ones(self.nb), []
        while len(self.changes) < sweep_limit:
            px, py = (0.5 * (self.e / et[A] + self.e / et[B])
                      for et in (self.density([[1, 0], [0, 0]]), self.density([[0, 0], [0, 1]])))
            new = self.omega / np.sqrt((a / px)**2 + (b / py)**2)
            self.changes.append(np.abs(new - self.omega).sum())
            self.omega = new
            if self.changes[-1] < 1e-3:
                break
        self.w = self.omega * self.alpha * self.V[A] * self.V[B]
        self.s0 = np.sqrt(e0 * (self.V[A] + self.V[B]) / (self.w * c * l))    # eq. 16

        # deformation matrices: (s, gamma, theta_rel) = T @ (uA, uB), and element matrices (eq. 9)
        T = np.zeros((self.nb, 3, 6))
        T[:, 0, 0], T[:, 0, 1], T[:, 0, 3], T[:, 0, 4] = -a / l, -b / l, a / l, b / l
        T[:, 1, 0], T[:, 1, 1], T[:, 1, 3], T[:, 1, 4] = b / l, -a / l, -b / l, a / l
        T[:, 1, 2] = T[:, 1, 5] = -0.5
        T[:, 2, 2], T[:, 2, 5] = -1, 1
        D = self.w[:, None] * np.column_stack([self.kn * l, self.kt * l, self.kr])
        self.T, self.Ke = T, np.einsum("nki,nk,nkj->nij", T, D, T)
        self.dofs = np.concatenate([3 * A[:, None] + np.arange(3), 3 * B[:, None] + np.arange(3)], axis=1)

    def density(self, G):
        """Energy density of every point for displacements u = G x with all rotations zero."""
        du = np.asarray(G, float) @ np.array([self.a, self.b])                     # (u_B - u_A) / l
        s, g = self.a * du[0] + self.b * du[1], -self.b * du[0] + self.a * du[1]
        q = 0.25 * self.omega * self.alpha * (self.kn * s**2 + self.kt * g**2) * self.l
        return np.bincount(self.A, q * self.V[self.B], self.n) + np.bincount(self.B, q * self.V[self.A], self.n)

    def matrix(self, alive):
        rows, cols = np.repeat(self.dofs[alive], 6, axis=1), np.tile(self.dofs[alive], (1, 6))
        return sp.csc_matrix((self.Ke[alive].ravel(), (rows.ravel(), cols.ravel())), (3 * self.n, 3 * self.n))

    def stretch(self, u):
        return np.einsum("ni,ni->n", self.T[:, 0], u[self.dofs])

    def loose(self, alive, held):
        """Unknowns to hold besides `held`: for every component the rigid motions nothing holds."""
        graph = sp.coo_matrix((np.ones(alive.sum()), (self.A[alive], self.B[alive])), (self.n, self.n))
        count, label = connected_components(graph, directed=False)
        extra = []
        for k in range(count):
            pts = np.flatnonzero(label == k)
            y = self.x[pts] - self.x[pts].mean(axis=0)
            y /= np.abs(y).max() if len(pts) > 1 else 1.0
            rigid = np.tile(np.eye(3), (len(pts), 1, 1))        # point, unknown, motion
            rigid[:, 0, 2], rigid[:, 1, 2] = -y[:, 1], y[:, 0]
            rows = rigid[held[3 * pts[:, None] + np.arange(3)]]  # what the held unknowns see of the motions
            _, sv, vt = np.linalg.svd(np.vstack([rows, np.zeros((3, 3))]), full_matrices=False)
            free = vt[np.sum(sv > 1e-9 * max(sv[0], 1)):].T     # rigid motions not held
            if free.shape[1]:
                _, _, order = qr((rigid[0] @ free).T, pivoting=True)
                extra.extend(3 * pts[0] + order[:free.shape[1]])
        return np.array(extra, int)

    def solve(self, alive, held, value, last):
        """Equilibrium for the held unknowns; loose parts keep one point at `last`. Returns u, forces."""
        extra = self.loose(alive, held)
        fixed, u = held.copy(), np.where(held, value, 0.0)
        fixed[extra], u[extra] = True, last[extra]
        K, free = self.matrix(alive), ~fixed
        lu = splu(K[free][:, free].tocsc())
        u[free] = lu.solve(-(K @ u)[free])
        u[free] -= lu.solve((K @ u)[free])                      # one refinement
        return u, K @ u, len(extra)


def node_tags(path):
    """Node tags in file order (meshio keeps the order but not the tags)."""
    lines = iter(Path(path).read_text().split("$Nodes\n")[1].split("\n"))
    blocks, tags = int(next(lines).split()[0]), []
    for _ in range(blocks):
        count = int(next(lines).split()[3])
        rows = [next(lines) for _ in range(2 * count)]          # the tags, then the coordinates
        tags += [int(row) for row in rows[:count]]
    return np.array(tags)


def supports(m, entries):
    """entries: (group, unknown 0/1/2, value) -> mask of held unknowns, their values."""
    held, value = np.zeros(3 * m.n, bool), np.zeros(3 * m.n)
    for group, unknown, v in entries:
        held[3 * m.groups[group] + unknown], value[3 * m.groups[group] + unknown] = True, v
    return held, value


def write(path, header, rows):
    def text(v):
        return v if isinstance(v, str) else repr(v.item() if hasattr(v, "item") else v)
    path.write_text("".join(",".join(map(text, row)) + "\n" for row in [header.split(","), *rows]))


def report_model(name, m):
    """Prints what the correction achieved and the inertia of the intact free body."""
    ex, ey, bi, sh = (m.density(G) / e for G, e in (([[1, 0], [0, 0]], m.e), ([[0, 0], [0, 1]], m.e),
                                                    ([[1, 0], [0, 1]], m.e_biaxial), ([[0, .5], [.5, 0]], m.e_shear)))
    ev = np.linalg.eigvalsh(m.matrix(np.ones(m.nb, bool)).toarray())
    small = 1e-11 * np.abs(ev).max()
    negative, zero = int((ev < -small).sum()), int((np.abs(ev) <= small).sum())
    print(f"{name}: {m.n} points, {m.nb} bonds, volume error {m.V.sum() / m.area - 1:.1e}, {len(m.changes)} sweeps "
          f"(sums {m.changes[-2]:.4e}, {m.changes[-1]:.4e}), Omega {m.omega.min():.4f} to {m.omega.max():.4f}\n"
          f"   max |e_x/e - 1| {abs(ex - 1).max():.2e}, |e_y/e - 1| {abs(ey - 1).max():.2e}; biaxial mean {bi.mean():.4f}"
          f" ({bi.min():.4f} to {bi.max():.4f}), shear mean {sh.mean():.4f} ({sh.min():.4f} to {sh.max():.4f})\n"
          f"   free body: {negative} negative, {zero} zero eigenvalues")
    return len(m.changes), negative, zero, bi.mean(), sh.mean()


def released(m, group, before, after):
    """1/2 u^T K_b u' summed over the bonds broken at fixed held displacements."""
    return 0.5 * np.einsum("ni,nij,nj->", before[m.dofs[group]], m.Ke[group], after[m.dofs[group]])


def stepped_path(m, held, value, top, steps=100, per_iteration=5, tie=1e-8, stop=0.5):
    """Newton-Raphson with ordered breaking: uniform factors 1/steps ... 1, `per_iteration` bonds at a time."""
    alive, u, f, work, lost, peak, worst = np.ones(m.nb, bool), np.zeros(3 * m.n), np.zeros(3 * m.n), 0.0, 0.0, 0.0, 0.0
    margin, path, breaks, most_loose = [np.inf, np.inf, np.inf], [], [], 0
    for step in range(1, steps + 1):
        target = value * step / steps
        old, fold, (u, f, loose) = u, f, m.solve(alive, held, target, u)
        work += 0.5 * ((f + fold) * (u - old))[held].sum()
        while True:
            s, excess = m.stretch(u), m.stretch(u) - m.s0
            margin[0] = min(margin[0], np.abs(s / m.s0 - 1)[alive].min())
            listed = np.flatnonzero(alive & (s >= m.s0))
            if len(listed) == 0:
                break
            listed = listed[np.lexsort((listed, -excess[listed]))]
            lead = listed[0]                                    # bonds tied with it break together
            tied = np.flatnonzero(alive & (excess >= excess[lead] - tie * s[lead]))
            group = np.concatenate([listed[:per_iteration], np.setdiff1d(tied, listed[:per_iteration])])
            gaps = -np.diff(excess[listed]) / s[lead]
            margin[1] = min(margin[1], gaps.min(initial=np.inf))
            margin[2] = min([margin[2], *gaps[per_iteration - 1:per_iteration]])
            for k in group:
                breaks.append((len(breaks) + 1, step, m.tags[m.A[k]], m.tags[m.B[k]], s[k] / m.s0[k]))
            alive[group] = False
            old, (u, f, loose) = u, m.solve(alive, held, target, u)
            lost += released(m, group, old, u)
        stored, reaction = 0.5 * u @ f, abs(f[top].sum())
        path.append((step, abs(target[top[0]]), reaction, stored, work, lost, len(breaks), loose))
        worst = max(worst, abs(work - stored - lost) / abs(work))
        peak, most_loose = max(peak, reaction), max(most_loose, loose)
        if reaction <= stop * peak:
            break
    print(f"stepped: {step} steps, {len(breaks)} breaks, peak {peak:.6e}, work {work:.9e} = stored {stored:.6e} + released "
          f"{lost:.6e}, worst relative gap {worst:.1e}\n   smallest |s/s0 - 1| of any decision {margin[0]:.1e}; smallest gap "
          f"between listed bonds {margin[1]:.1e}, at the cut {margin[2]:.1e} (of the leader's stretch); most unknowns held in "
          f"loose parts {most_loose}")
    return path, breaks


def event_path(m, held, value, top, count=200):
    """Exact path: the next bond is the minimum of s_0/s over the stretched bonds at unit load."""
    alive, events, work, lost, factor, worst, gap = np.ones(m.nb, bool), [], 0.0, 0.0, 0.0, 0.0, np.inf
    u, f, _ = m.solve(alive, held, value, np.zeros(3 * m.n))
    for n in range(1, count + 1):
        s = m.stretch(u)
        ratio = np.where(alive & (s > 0), m.s0 / np.where(s > 0, s, 1.0), np.inf)
        k, gap = ratio.argmin(), min(gap, np.partition(ratio, 1)[1] / ratio.min() - 1)
        work += 0.5 * (f * value)[held].sum() * (ratio[k]**2 - factor**2)
        factor = ratio[k]
        events.append((n, factor, factor * abs(value[top[0]]), factor * abs(f[top].sum()), m.tags[m.A[k]], m.tags[m.B[k]]))
        alive[k] = False
        old, (u, f, _) = u, m.solve(alive, held, value, u)
        lost += factor**2 * released(m, np.array([k]), old, u)
        worst = max(worst, abs(work - lost - factor**2 * 0.5 * u @ f) / abs(work))
    print(f"events: {count} breakages, peak load {max(e[3] for e in events):.6e}, balance of work, worst relative gap {worst:.1e}, "
          f"gap to the second bond {gap:.1e}")
    return events


SETS = {"lambda3": (3, 0.21, "stress"), "lambda2": (2, 0.21, "stress"), "nu038": (3, 0.38, "stress"),
        "strain027": (3, 0.27, "strain"), "strain030": (3, 0.30, "strain")}
PATH = "step,displacement,reaction,stored_energy,external_work,released_energy,broken,loose_unknowns_held"
BREAKS = "order,step,a,b,s_over_s0"


def main(folder):
    summary = []
    for name, (lam, nu, plane) in SETS.items():
        m = Model(folder / "square.msh", lam, 15e9, nu, 3.81e6, plane)
        stats = report_model(f"square {name}", m)
        write(folder / f"square-bonds-{name}.csv", "a,b,length,horizon,alpha,omega,s0",
              zip(m.tags[m.A], m.tags[m.B], m.l, m.H, m.alpha, m.omega, m.s0))
        held, value = supports(m, [("bottom", 1, 0.0), ("corner", 0, 0.0), ("top", 1, 1e-5)])
        u, f, _ = m.solve(np.ones(m.nb, bool), held, value, np.zeros(3 * m.n))
        write(folder / f"square-displacement-{name}.csv", "node,ux,uy,theta", zip(m.tags, *u.reshape(-1, 3).T))
        reaction, energy, worst = f[3 * m.groups["top"] + 1].sum(), 0.5 * u @ f, np.max(m.stretch(u) / m.s0)
        print(f"   reaction {reaction:.9e}, energy {energy:.9e}, energy / work - 1 = {energy / (reaction * 0.5e-5) - 1:.1e}, "
              f"free residual {np.abs(f[~held]).max() / np.abs(f[held]).max():.1e}, largest s/s0 {worst:.6f}")
        summary.append((name, lam, nu, plane, m.n, m.nb, reaction, energy, worst, *stats))
        if name == "lambda3":
            for file, times, steps in ("square", 5, 50), ("square-separation", 100, 5):
                path, breaks = stepped_path(m, held, times * value, 3 * m.groups["top"] + 1, steps, stop=-1.0)
                write(folder / f"{file}-path.csv", PATH, path)
                write(folder / f"{file}-breaks.csv", BREAKS, breaks)
    write(folder / "square-summary.csv", "set,lambda,nu,plane,points,bonds,reaction_top,energy,largest_s_over_s0,sweeps,"
          "negative_eigenvalues,zero_eigenvalues,biaxial_mean,shear_mean", summary)

    m = Model(folder / "disk.msh", 3, 15e9, 0.21, 3.81e6)
    report_model("disk lambda3", m)
    held, value = supports(m, [("platen-bottom", 1, 0), ("platen-top", 1, -4e-4), ("pole-top", 0, 0), ("pole-bottom", 0, 0)])
    top = 3 * m.groups["platen-top"] + 1
    path, breaks = stepped_path(m, held, value, top)
    write(folder / "disk-path.csv", PATH, path)
    write(folder / "disk-breaks.csv", BREAKS, breaks)
    write(folder / "disk-event.csv", "order,factor,displacement,load,a,b", event_path(m, held, value, top))


if __name__ == "__main__":
    main(Path(sys.argv[1]) if len(sys.argv) > 1 else Path(__file__).resolve().parent.parent / "tests" / "reference")
