#!/usr/bin/env python3
"""Cohesive cracks on prescribed paths in plane bodies: what the measured tests of concrete are compared with.

This is not part of the program.  Triangles with six nodes (plane stress); nodes along notches and the path of the crack are doubled, and
across the path the stress falls with the opening by a law of softening.  The elastic body is condensed to the jumps across its path, and the
opening at the root of the path grows in steps, so that the path past the peak is followed.  Where the path closes again it unloads to the
origin.  Data of the bodies are those of crates/ligament-verify/experiments/experiments.toml and of the cases it names.

    pip install -r tools/requirements-reference.txt
    python tools/reference_cohesive.py [NAME ...]       # default: all bodies, two and a half minutes

prints the peak of each body with its place and the area under the curve, as numbers and over the measured values, and writes
tests/reference/cohesive-NAME.csv with the reading that the test compares (opening of gauges or displacement of the load, m) and the load (N).
For Petersson's beam 30, 60 and 100 elements along the path give peaks of 753.4, 753.3 and 753.3 N.
"""
import sys
import tomllib
from dataclasses import dataclass, replace
from itertools import combinations
from math import factorial
from pathlib import Path

import gmsh
import numpy as np
from scipy.sparse import coo_matrix, diags
from scipy.sparse.linalg import splu

REPOSITORY = Path(__file__).resolve().parent.parent
EXPERIMENTS = REPOSITORY / "crates" / "ligament-verify" / "experiments"
CLOSED = 5e-4                  # opening over G/f_t at which the path gets to its strength; with none the springs would be rigid
NEAR = 1e-9                    # m
ROWS = 80                      # of a stored curve


def corners(softening):
    """Corners of a law: openings over G/f_t and stresses over f_t."""
    if softening == "cornelissen":
        x = np.linspace(0, 1, 401)
        fall = lambda x: (1 + (3 * x)**3) * np.exp(-6.93 * x)
        y = fall(x) - x * fall(1.0)
        return x / np.trapezoid(y, x), y
    if softening == "exponential":
        x = np.linspace(0, 12, 1201)
        return x, np.exp(-x)
    x, y = {
        "linear": ((0, 2), (1, 0)),
        "two-branch": ((0, 0.8, 3.6), (1, 1 / 3, 0)),
        "ceb-fip": ((0, 2 - 0.15 * 7, 7), (1, 0.15, 0)),
        "model-code-2010": ((0, 1, 5), (1, 0.2, 0)),
    }[softening]
    return np.array(x, float), np.array(y, float)


class Cohesion:
    """Forces of the path at its points. A jump has the component along the normal first; sliding counts with the weight beta."""

    def __init__(self, softening, strength, energy, sliding, area, axes):
        x, y = corners(softening)
        self.x, self.y = x * energy / strength, y * strength
        self.closed = CLOSED * energy / strength
        self.stiff = strength / self.closed
        self.area = area
        self.weight = np.array([1.0] + [sliding**2] * (axes - 1))[:, None]

    def springs(self):
        """Stiffness of the closed path, shape (axes, points)."""
        return self.weight * self.area * self.stiff

    def opening(self, jump):
        """sqrt(w_n^2 + beta^2 w_t^2), in which w_n counts where it opens."""
        return np.sqrt(np.maximum(jump[0], 0)**2 + (self.weight[1:] * jump[1:]**2).sum(0))

    def stress(self, opening):
        """Stress at an opening, and its slope."""
        past = opening - self.closed
        k = np.clip(np.searchsorted(self.x, past, side="right") - 1, 0, len(self.x) - 2)
        slope = np.where(past >= self.x[-1], 0.0, (self.y[k + 1] - self.y[k]) / (self.x[k + 1] - self.x[k]))
        after = np.interp(past, self.x, self.y, right=0.0)
        return np.where(past < 0, self.stiff * opening, after), np.where(past < 0, self.stiff, slope)

    def forces(self, jump, largest, follows):
        """Forces (axes, points) and their tangent; a point follows the law, or the line from the origin to its largest opening so far."""
        kappa = np.maximum(np.where(follows, self.opening(jump), largest), 1e-12 * self.closed)
        stress, slope = self.stress(kappa)
        secant = self.weight * stress / kappa
        secant[0] = np.where(jump[0] > 0, secant[0], self.stiff)
        change = np.where(follows, (slope - stress / kappa) / kappa**2, 0)
        toward = self.weight * np.concatenate([np.maximum(jump[:1], 0), jump[1:]])
        tangent = self.area * change * toward[:, None] * toward
        for axis, own in enumerate(secant):
            tangent[axis, axis] += self.area * own
        return self.area * secant * jump, tangent


@dataclass
class PathPoint:
    """A point of the path: pairs of nodes with their shares in its jump, the axes of the jump (the normal first) and its area."""
    pairs: list
    axes: np.ndarray
    area: float
    is_root: bool              # whether its opening is controlled


def between(nodes, place):
    """Whether the nodes are at a place: a point, or two for all nodes between."""
    p, q = (np.array(it) for it in (place if np.ndim(place) == 2 else (place, place)))
    along = q - p
    share = np.clip((nodes - p) @ along / max(along @ along, 1e-300), 0, 1)
    return np.linalg.norm(nodes - p - share[:, None] * along, axis=1) < NEAR


def elasticity(young, poisson, dimensions):
    """Stresses by strains: plane stress, or in space."""
    shear = young / (2 * (1 + poisson))
    if dimensions == 2:
        return young / (1 - poisson**2) * np.array([[1, poisson, 0], [poisson, 1, 0], [0, 0, (1 - poisson) / 2]])
    elastic = np.diag([2 * shear] * 3 + [shear] * 3)
    elastic[:3, :3] += young * poisson / (1 + poisson) / (1 - 2 * poisson)
    return elastic


def stiffness(nodes, elements, elastic):
    """Stiffness of quadratic triangles or tetrahedra, each with its elasticity, by as many points as an element has corners."""
    d = nodes.shape[1]
    ends = ((0, 1), (1, 2), (2, 0), (3, 0), (3, 2), (3, 1))[:3 if d == 2 else 6]
    strains = [(i, i) for i in range(d)] + list(reversed(list(combinations(range(d), 2))))
    x, total = nodes[elements], np.zeros((len(elements), *[d * elements.shape[1]] * 2))
    slopes = np.vstack([-np.ones(d), np.eye(d)])        # of the shares of the corners
    near, far = (2 / 3, 1 / 6) if d == 2 else ((5 + 3 * 5**0.5) / 20, (5 - 5**0.5) / 20)
    for corner in range(d + 1):
        share = np.where(np.arange(d + 1) == corner, near, far)
        shapes = np.vstack([(4 * share[:, None] - 1) * slopes, [4 * (share[a] * slopes[b] + share[b] * slopes[a]) for a, b in ends]])
        jacobian = np.einsum("ni,enk->eik", shapes, x)
        gradient = np.linalg.solve(jacobian, np.broadcast_to(shapes.T, (len(x), *shapes.T.shape)))
        b = np.zeros((len(x), len(strains), total.shape[1]))
        for row, (i, j) in enumerate(strains):
            b[:, row, i::d] = gradient[:, j]
            b[:, row, j::d] = gradient[:, i]
        weight = np.abs(np.linalg.det(jacobian)) / factorial(d) / (d + 1)
        total += b.transpose(0, 2, 1) @ (weight[:, None, None] * elastic) @ b
    dofs = (d * elements[:, :, None] + np.arange(d)).reshape(len(elements), -1)
    places = np.repeat(dofs, dofs.shape[1], 1).ravel(), np.tile(dofs, (1, dofs.shape[1])).ravel()
    return coo_matrix((total.ravel(), places), shape=(nodes.size,) * 2).tocsr()


def motions(nodes, elements, held, load):
    """Degrees of freedom by those that are free and, in the last column, the one that all nodes under the load share."""
    d = nodes.shape[1]
    free = np.zeros(nodes.size, bool)
    free[(d * np.unique(elements)[:, None] + np.arange(d)).ravel()] = True
    for place, axis in held:
        free[d * np.flatnonzero(between(nodes, place)) + axis] = False
    place, axis, sign = load
    loaded = d * np.flatnonzero(between(nodes, place)) + axis
    loaded = loaded[free[loaded]]
    free[loaded] = False
    rows = np.concatenate([np.flatnonzero(free), loaded])
    columns = np.minimum(np.arange(len(rows)), free.sum())
    signs = np.where(columns < free.sum(), 1.0, sign)
    return coo_matrix((signs, (rows, columns)), shape=(nodes.size, free.sum() + 1)).tocsc()


def jumps(points, n_dofs):
    """Jumps at the points of the path by the degrees of freedom, ordered by axes and then points."""
    values, rows, columns = [], [], []
    for k, point in enumerate(points):
        d = len(point.axes)
        for one, other, share in point.pairs:
            for axis, direction in enumerate(point.axes):
                values += [*(share * direction), *(-share * direction)]
                rows += [axis * len(points) + k] * 2 * d
                columns += [*(d * one + np.arange(d)), *(d * other + np.arange(d))]
    return coo_matrix((values, (rows, columns)), shape=(len(points[0].axes) * len(points), n_dofs)).tocsr()


class Condensed:
    """The elastic body, its path closed by springs: jumps and reading by forces across the path and by the load."""

    def __init__(self, whole, motion, points, reading, cohesion):
        jump = jumps(points, motion.shape[0]) @ motion
        self.springs = cohesion.springs()
        matrix = motion.T @ whole @ motion + jump.T @ diags(self.springs.ravel()) @ jump
        factor = splu(matrix.tocsc(), permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0.0, options={"SymmetricMode": True})
        by_load = factor.solve(np.eye(1, motion.shape[1], motion.shape[1] - 1)[0])
        read = motion.T @ reading
        blocks = np.array_split(np.arange(jump.shape[0]), jump.shape[0] // 100 + 1)
        self.jump_by_force = np.hstack([jump @ factor.solve(jump[block].T.toarray()) for block in blocks])
        self.jump_by_load = jump @ by_load
        self.reading_by_force = jump @ factor.solve(read)
        self.reading_by_load = read @ by_load
        is_root = np.array([point.is_root for point in points], float)
        self.control = np.concatenate([is_root / is_root.sum(), np.zeros(jump.shape[0] - len(points))])


@dataclass
class State:
    """Equilibrium: jumps (axes, points), load, and of each point the largest opening and whether it follows the law of softening."""
    jump: np.ndarray
    load: float
    largest: np.ndarray
    follows: np.ndarray


def newton(body, cohesion, state, goal):
    """Jumps and load at an opening of the roots; none where the iteration does not end."""
    jump, load = state.jump, state.load
    shape = jump.shape
    for _ in range(40):
        force, tangent = cohesion.forces(jump, state.largest, state.follows)
        residual = jump.ravel() - load * body.jump_by_load + body.jump_by_force @ (force - body.springs * jump).ravel()
        if max(np.abs(residual).max(), abs(body.control @ jump.ravel() - goal)) < 1e-10 * goal:
            return jump, load
        for axis in range(shape[0]):
            tangent[axis, axis] -= body.springs[axis]
        change_of_residual = np.einsum("njp,jkp->nkp", body.jump_by_force.reshape(-1, *shape), tangent).reshape(jump.size, -1)
        change_of_residual[np.diag_indices(jump.size)] += 1
        change, by_load = np.linalg.solve(change_of_residual, np.stack([-residual, body.jump_by_load], 1)).T
        more = (goal - body.control @ (jump.ravel() + change)) / (body.control @ by_load)
        jump, load = jump + (change + more * by_load).reshape(shape), load + more
    return None


def equilibrium(body, cohesion, state, goal):
    """The state at an opening of the roots: points that would close along the law unload instead."""
    largest, follows = state.largest, state.follows
    for _ in range(40):
        found = newton(body, cohesion, replace(state, follows=follows), goal)
        if found is None:
            return None
        opening = cohesion.opening(found[0])
        closes = follows & (largest > cohesion.closed) & (opening < largest * (1 - 1e-9))
        opens = ~follows & (opening > largest * (1 + 1e-9))
        if not (closes | opens).any():
            return State(*found, np.maximum(largest, opening), follows)
        follows = (follows & ~closes) | opens
    return None


def follow(body, cohesion, last, steps):
    """Readings and loads while the roots open up to `last` or the body splits, shape (n, 2)."""
    n_points = len(cohesion.area)
    state = State(np.zeros((len(cohesion.weight), n_points)), 0.0, np.zeros(n_points), np.ones(n_points, bool))
    found, reached = [(0.0, 0.0)], 0.0
    for goal in last * (np.arange(1, steps + 1) / steps)**2:
        step = goal - reached
        while reached < goal * (1 - 1e-12):
            new = equilibrium(body, cohesion, state, min(goal, reached + step))
            if new is None:
                step /= 2
                if step < 1e-8 * last:
                    raise RuntimeError(f"no equilibrium beyond an opening of {reached:.3e} m")
                continue
            state, reached = new, min(goal, reached + step)
            across = (cohesion.forces(state.jump, state.largest, state.follows)[0] - body.springs * state.jump).ravel()
            found.append((body.reading_by_load * state.load - body.reading_by_force @ across, state.load))
            step *= 1.5
        # A body that is split takes no load, and its parts have no place.
        if state.load < 1e-4 * max(load for _, load in found):
            break
    return np.array(found)


@dataclass
class Body:
    """A plane body with the path of its crack; a place is a point or a pair of points, for all nodes between."""
    outline: list              # corners, m
    path: list                 # corners of the path, m
    held: list                 # (place, axis) without motion
    load: tuple                # (place, axis, sign): its nodes move alike along an axis
    reading: list              # (point, axis, weight): motions whose sum the test reads, m
    last: float                # opening at the roots of the path up to which it is followed, m
    thickness: float
    young: float
    poisson: float
    strength: float
    energy: float
    softening: str = "two-branch"
    notch: tuple = ()          # corners of a notch without width, m
    roots: tuple = (0,)        # corners of the path whose openings are controlled
    coarse: float = 0.0        # largest size of triangles, m; 0: ten along the longest side
    elements: int = 60         # along the path
    sliding: float = 1.0       # weight of sliding in the opening
    steps: int = 300


def mesh(body):
    """Nodes and six-node triangles, with the edges of notch and path, by Gmsh."""
    gmsh.initialize()
    gmsh.option.setNumber("General.Terminal", 0)
    for option in ("MeshSizeExtendFromBoundary", "MeshSizeFromPoints", "MeshSizeFromCurvature"):
        gmsh.option.setNumber(f"Mesh.{option}", 0)
    model, points = gmsh.model.geo, {}

    def lines(corners):
        for place in corners:
            if place not in points:
                points[place] = model.addPoint(*place, 0)
        return [model.addLine(points[p], points[q]) for p, q in zip(corners, corners[1:])]

    model.addPlaneSurface([model.addCurveLoop(lines([*body.outline, body.outline[0]]))], 1)
    inner = {"notch": lines(body.notch), "path": lines(body.path)}
    model.synchronize()
    gmsh.model.mesh.embed(1, inner["notch"] + inner["path"], 2, 1)
    length = sum(np.hypot(*np.subtract(p, q)) for p, q in zip(body.path, body.path[1:]))
    coarse = body.coarse or np.ptp(np.array(body.outline), axis=0).max() / 10
    distance, size = gmsh.model.mesh.field.add("Distance"), gmsh.model.mesh.field.add("MathEval")
    gmsh.model.mesh.field.setNumbers(distance, "CurvesList", inner["path"])
    gmsh.model.mesh.field.setNumber(distance, "Sampling", 400)
    gmsh.model.mesh.field.setString(size, "F", f"Min({length / body.elements} + 0.25*F{distance}, {coarse})")
    gmsh.model.mesh.field.setAsBackgroundMesh(size)
    gmsh.model.mesh.generate(2)
    gmsh.model.mesh.setOrder(2)
    tags, where, _ = gmsh.model.mesh.getNodes()
    number = {tag: k for k, tag in enumerate(tags)}
    numbers = lambda tags, count: np.array([number[tag] for tag in tags]).reshape(-1, count)
    triangles = numbers(gmsh.model.mesh.getElements(2)[2][0], 6)
    edges = {name: np.concatenate([numbers(gmsh.model.mesh.getElements(1, line)[2][0], 3) for line in found] or [np.zeros((0, 3), int)])
             for name, found in inner.items()}
    gmsh.finalize()
    return where.reshape(-1, 3)[:, :2], triangles, edges


def cut(nodes, triangles, edges):
    """Doubles the nodes between triangles that only cut edges connect; gives nodes, triangles and the pairs of nodes of each edge of the path."""
    sides = ((0, 1, 3), (1, 2, 4), (2, 0, 5))
    is_cut = {frozenset(edge[:2]) for name in edges for edge in edges[name].tolist()}
    around = {n: [] for name in edges for n in edges[name].ravel().tolist()}
    for t, corners_of in enumerate(triangles.tolist()):
        for n in around.keys() & set(corners_of):
            around[n].append(t)
    new, where = triangles.copy(), list(map(tuple, nodes))
    for n, at in around.items():
        groups = []
        for t in at:
            whole = {frozenset((triangles[t, a], triangles[t, b])) for a, b, m in sides
                     if n in triangles[t, [a, b, m]]} - is_cut
            joined = [g for g in groups if g[0] & whole]
            groups = [g for g in groups if g not in joined] + [
                (whole.union(*(g[0] for g in joined)), [t, *(i for g in joined for i in g[1])])]
        for _, group in groups[1:]:
            where.append(where[n])
            for t in group:
                new[t][triangles[t] == n] = len(where) - 1
    beside = {}
    for t, of_triangle in enumerate(triangles.tolist()):
        for a, b, m in sides:
            key = frozenset((of_triangle[a], of_triangle[b]))
            if key in is_cut:
                beside.setdefault(key, []).append((t, {of_triangle[k]: new[t, k] for k in (a, b, m)}))
    pairs = []
    for edge in edges["path"].tolist():
        (t, one), (_, other) = beside[frozenset(edge[:2])]
        normal = nodes[triangles[t, :3]].mean(0) - nodes[edge[2]]
        pairs.append(([(one[n], other[n]) for n in edge], normal))
    return np.array(where), new, pairs


def path_points(body, nodes, pairs):
    """Points of the path: the nodes of its edges, with the areas of Simpson's rule."""
    points = []
    for of_edge, towards_first in pairs:
        along = nodes[of_edge[1][0]] - nodes[of_edge[0][0]]
        length = np.hypot(*along)
        normal = np.array([-along[1], along[0]]) / length
        normal *= np.sign(normal @ towards_first)
        for (one, other), share in zip(of_edge, (1 / 6, 1 / 6, 4 / 6)):
            is_root = any(between(nodes[one][None], body.path[root])[0] for root in body.roots)
            axes = np.array([normal, (normal[1], -normal[0])])
            points.append(PathPoint([(one, other, 1.0)], axes, share * length * body.thickness, is_root))
    return points


def inside(nodes, triangles, point):
    """Nodes of the triangle around a point, with their shares in its motion."""
    corner, *others = nodes[triangles[:, :3]].transpose(1, 0, 2)
    sides = np.stack([it - corner for it in others], 2)
    of_others = np.linalg.solve(sides, (point - corner)[:, :, None])[:, :, 0]
    shares = np.column_stack([1 - of_others.sum(1), of_others])
    found = shares.min(1).argmax()
    r, s, t = shares[found]
    return triangles[found], np.array([r * (2 * r - 1), s * (2 * s - 1), t * (2 * t - 1), 4 * r * s, 4 * s * t, 4 * t * r])


def curve(body):
    """Readings and loads of a plane body, shape (n, 2)."""
    nodes, triangles, pairs = cut(*mesh(body))
    points = path_points(body, nodes, pairs)
    elastic = body.thickness * elasticity(body.young, body.poisson, 2)
    motion = motions(nodes, triangles, body.held, body.load)
    reading = np.zeros(nodes.size)
    for point, axis, weight in body.reading:
        at, shares = inside(nodes, triangles, point)
        reading[2 * at + axis] += weight * shares
    area = np.array([point.area for point in points])
    cohesion = Cohesion(body.softening, body.strength, body.energy, body.sliding, area, 2)
    condensed = Condensed(stiffness(nodes, triangles, elastic), motion, points, reading, cohesion)
    return follow(condensed, cohesion, body.last, body.steps)


def beam(depth, half_span, notch, last, gauge=None, at=0.0, path=None, **material):
    """A notched beam under three-point bending that ends at its supports; it is read by a gauge across the notch, or by the load."""
    left, right = (-half_span, 0.0), (half_span, 0.0)
    top, root = (0.0, depth), (at, notch)
    path = path or [root, top]
    reading = [(top, 1, -1.0)] if gauge is None else [((at + gauge, 0.0), 0, 1.0), ((at - gauge, 0.0), 0, -1.0)]
    corners_above = [top] if path[-1] == top else [top, path[-1]]
    return Body(outline=[left, (at, 0.0), right, (half_span, depth), *corners_above, (-half_span, depth)], notch=((at, 0.0), root),
                path=path, held=[(left, 0), (left, 1), (right, 1)], load=(top, 1, -1.0), reading=reading, last=last,
                coarse=depth / 6, **material)


def l_panel():
    """The panel held at its foot; the path is the measured one, by hand beyond x = 0.2 m."""
    load = (0.47, 0.25)
    return Body(outline=[(0.0, 0.0), (0.25, 0.0), (0.25, 0.25), load, (0.5, 0.25), (0.5, 0.5), (0.0, 0.5), (0.0, 0.32)],
                path=[(0.25, 0.25), (0.2, 0.2735), (0.15, 0.292), (0.1, 0.305), (0.05, 0.314), (0.0, 0.32)],
                held=[(((0.0, 0.0), (0.25, 0.0)), axis) for axis in (0, 1)], load=(load, 1, 1.0), reading=[(load, 1, 1.0)],
                last=5e-4, thickness=0.1, young=25.85e9, poisson=0.18, strength=2.7e6, energy=65.0)


def notched_plate():
    """The double-edge-notched plate between its frames, read by the mean of nine gauges of 65 mm across the ligament."""
    side, depth, low, high = 0.2, 0.025, 0.0975, 0.1025
    left, right = (depth, 0.1), (side - depth, 0.1)
    return Body(outline=[(0.0, 0.0), (side, 0.0), (side, low), (side - depth, low), right, (side - depth, high), (side, high),
                         (side, side), (0.0, side), (0.0, high), (depth, high), left, (depth, low), (0.0, low)],
                path=[left, right], held=[(((0.0, 0.0), (side, 0.0)), 1), (((side, 0.0), (side, low)), 0)],
                load=(((0.0, side), (side, side)), 1, 1.0), reading=mean_opening(np.linspace(0.03, 0.17, 9)), last=1.1e-4, roots=(0, 1),
                thickness=0.05, young=30e9, poisson=0.2, strength=3e6, energy=110.0)


def mean_opening(x):
    """Reading of gauges of 65 mm across the plate's ligament."""
    return [((at, y), 1, sign / len(x)) for at in x for y, sign in ((0.1325, 1.0), (0.0675, -1.0))]


def bodies():
    """All bodies by name: the test, where it has one the size, and the law of softening."""
    concrete = dict(thickness=0.05, poisson=0.2)
    up_first = [(-0.05, 0.02), (-0.042, 0.035), (-0.028, 0.053), (-0.013, 0.068), (-0.003, 0.08)]
    # The last opening of Petersson's beam is that at which its notch has opened by 1.2 mm, where the test ends.
    tests = {
        "petersson-beam": beam(0.2, 1.0, 0.1, 5.95e-4, young=30e9, strength=3.33e6, energy=124.0, **concrete),
        "half-notched-beam": beam(0.05, 0.0625, 0.025, 1.2e-4, 0.01, young=37e9, strength=3.9e6, energy=143.2, **concrete),
        "eccentric-beam": beam(0.08, 0.1, 0.02, 1e-4, 0.01, -0.05, up_first, young=33.8e9, strength=3.5e6, energy=125.2, **concrete),
        "l-panel": l_panel(),
        "nooru-mohamed-tension": notched_plate(),
        "nooru-mohamed-tension-edges": replace(notched_plate(), reading=mean_opening([0.0, 0.2])),
    }
    laws = ("two-branch", "linear", "exponential", "cornelissen")
    more_laws = {"petersson-beam": (*laws, "ceb-fip", "model-code-2010")}
    found = {f"{name}-{law}": replace(body, softening=law) for name, body in tests.items() for law in more_laws.get(name, laws)}
    # Strengths, energies and laws with which others model two of the tests.
    as_modelled = {
        "l-panel": ("cornelissen", dict(young=20e9, strength=2.4e6, energy=113.0)),
        "half-notched-beam": ("exponential", dict(strength=3.5e6, energy=90.0)),
    }
    for name, (law, material) in as_modelled.items():
        found[f"{name}-as-modelled-{law}"] = replace(tests[name], softening=law, **material)
    for size in (0.05, 0.1, 0.2, 0.4):
        found[f"size-effect-{1000 * size:.0f}mm"] = beam(size, 2 * size, 0.3 * size, 8e-4 * size, 0.1 * size, thickness=0.1, young=30e9,
                                                         poisson=0.2, strength=3e6, energy=100.0, softening="linear")
    return found


def area(x, y, end):
    """Area under a curve up to where it first passes `end`; parts that run back count as negative."""
    past = np.flatnonzero(x >= end)
    if len(past):
        k = past[0]
        y = np.append(y[:k], np.interp(end, x[k - 1:k + 1], y[k - 1:k + 1]))
        x = np.append(x[:k], end)
    return np.trapezoid(y, x)


def measured(name):
    """Peak (N), its place (m), area (N m) and end (m) of the test that a body belongs to, where they are known; means over its specimens."""
    tests = tomllib.loads((EXPERIMENTS / "experiments.toml").read_text())["test"]
    test = next(it for it in tests if name.startswith(it["name"]))
    if isinstance(test.get("measured"), str):
        x, *loads = np.loadtxt(EXPERIMENTS / test["measured"], delimiter=",", skiprows=1).T
        x = 1e-3 * x
        return *np.mean([(y.max(), x[y.argmax()], area(x, y, x[-1])) for y in loads], axis=0), x[-1]
    known = {band["of"]: band.get("measured", np.nan) for band in test["band"]}
    # The torsion test is measured by its torque.
    return known.get("peak", np.nan) / test["y"].get("factor", 1.0), np.nan, 1e-3 * known.get("area", np.nan), np.inf


def report(name, found):
    """Prints peak, its place and the area to the end of the measured curve, then each over what was measured."""
    *known, end = measured(name)
    x, load = found.T
    peak = load.argmax()
    values = load[peak], x[peak], area(x, load, end)
    ratios = " ".join("    -" if np.isnan(it) else f"{value / it:5.3f}" for value, it in zip(values, known))
    print(f"{name:46} {values[0]:9.1f} N {1e6 * values[1]:7.2f} um {values[2]:9.4g} N m   {ratios}", flush=True)


def store(name, found):
    """Writes a curve, thinned evenly; its peak stays."""
    kept = np.union1d(np.linspace(0, len(found) - 1, ROWS - 1).round().astype(int), found[:, 1].argmax())
    path = REPOSITORY / "tests" / "reference" / f"cohesive-{name}.csv"
    np.savetxt(path, found[kept], delimiter=",", header="reading,load", comments="", fmt="%.6g")


def convergence(name):
    """Prints the body with other numbers of elements along its path."""
    for elements in (30, 60, 100):
        report(f"{name}, {elements} elements", curve(replace(bodies()[name], elements=elements)))


def main(names):
    print("peak, its place, area; each over the measured value")
    for name, body in bodies().items():
        if not names or any(it in name for it in names):
            found = curve(body)
            report(name, found)
            store(name, found)
    if not names:
        convergence("petersson-beam-two-branch")
        convergence("nooru-mohamed-tension-two-branch")


if __name__ == "__main__":
    main(sys.argv[1:])
