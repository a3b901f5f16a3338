#!/usr/bin/env python3
"""Random small problems of contact end alike in other units, turned by 90 degrees and mirrored: the same end, exit code and broken bonds.

    tools/check_contact.py target/release/ligament                   # some problems
    tools/check_contact.py target/release/ligament --problems 500
    tools/check_contact.py target/release/ligament --first 17 --problems 1 --keep

A problem is two jittered bodies, or one and a rigid one, that come together, just touch or pass each other, with a law, horizon, correction,
criterion, crack and driver (elastic solution, load steps, and motions in equilibria, explicit and implicit steps) drawn from its number, so that it
is the same wherever it is drawn. Its twins have lengths, forces and times in units drawn from 1e-6 to 1e6 times as large.

What is compared follows from what rounding can change. Equilibria of the same bonds are the same to the tolerance of their equations, so that load steps
break the same bonds. Where a body tears itself in a motion, a difference of 1e-16 at the first breakage is one of some bonds a few hundred time steps
later, as it is between two compilers: there the first bond and its time are the same, and the number of bonds to a share.
"""
import argparse
import csv
import itertools
import json
import math
import os
import random
import resource
import shutil
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
SCRATCH = ROOT / "target" / "check-contact"

# Laws with ratios of Poisson at which their stiffness is definite, by dimension.
LAWS = {
    2: {"bbpd": [1 / 3], "pds": [0.0, 0.2], "mppd": [0.0, 0.2], "mppd-beam": [0.0, 0.2], "nhpd": [0.0, 0.2]},
    3: {"bbpd": [1 / 4], "pds": [0.0, 0.1], "mppd": [0.0, 0.1], "nhpd": [0.0, 0.1]},
}

# Problems that once were not alike, beside the first ones: friction that turns round within a small part of a correction (27, 57, 311), softening bonds of a
# body that nothing holds (493), friction in other units (495), and a body that slipped off another one at once (128).
ONCE_DIFFERENT = [27, 57, 128, 311, 493, 495]

# Time of a run, s, and its memory, bytes, beyond which a problem counts as one without an end. Most take a tenth of a second and 50 MB.
PATIENCE = 30
MEMORY = 1 << 30

# Numbers of bonds that broke in twins of a motion may differ by this share of the larger one, or by this number.
CHAOTIC_SHARE, CHAOTIC_BONDS = 0.3, 12

# Works of twins whose bonds are the same: residuals of equilibria go to 1e-8 of the forces, of bonds that soften to 1e-4 of their energies, and what rubs
# depends on its way.
SAME_WORK = 1e-3

# Work over stiffness times the square of the size that is rounding: 1e-16 of forces that act over the whole size.
NO_WORK = 1e-15


class Units:
    """Numbers of a problem in other units of length, force and time."""

    def __init__(self, length=1.0, force=1.0, time=1.0):
        self.length, self.force, self.time = length, force, time

    def __call__(self, value, length=0, force=0, time=0):
        return value * self.length**length * self.force**force * self.time**time


class Frame:
    """Axes of a twin: turned about z by 90 degrees, or mirrored along x. Signs change and numbers do not."""

    def __init__(self, kind="as drawn"):
        self.kind = kind

    def vector(self, values):
        x, y, *rest = values
        return {"as drawn": [x, y], "turned": [-y, x], "mirrored": [-x, y]}[self.kind] + rest

    def size(self, values):
        return [abs(it) for it in self.vector(values)]

    def axes(self, components):
        """A vector of which some components may be open, by axis."""
        names = {"as drawn": "xyz", "turned": "yxz", "mirrored": "xyz"}[self.kind]
        signs = {"as drawn": [1, 1, 1], "turned": [1, -1, 1], "mirrored": [-1, 1, 1]}[self.kind]
        of = {names["xyz".index(axis)]: signs["xyz".index(axis)] * value for axis, value in components.items()}
        return "{ " + ", ".join(f"{axis} = {of[axis] + 0.0!r}" for axis in sorted(of)) + " }"


def block(draw, counts, sizes, corner, first):
    """Nodes of a jittered grid with cells and sides by name; nodes are numbered from `first` on."""
    number, nodes = {}, []
    for place in itertools.product(*(range(count + 1) for count in reversed(counts))):
        place = place[::-1]
        number[place] = first + len(nodes)
        inner = all(0 < at < count for at, count in zip(place, counts))
        moved = [size / count * (at + draw.uniform(-0.2, 0.2) * inner) for at, size, count in zip(place, sizes, counts)]
        nodes.append([low + it for low, it in zip(corner, moved)])
    ring = [(0, 0), (1, 0), (1, 1), (0, 1)]
    corners = ring if len(counts) == 2 else [(*corner, up) for up in (0, 1) for corner in ring]
    cells = [[number[tuple(at + step for at, step in zip(place, corner))] for corner in corners]
             for place in itertools.product(*(range(count) for count in counts))]
    sides = {}
    for name, axis, end in [("left", 0, 0), ("right", 0, 1), ("bottom", 1, 0), ("top", 1, 1)]:
        others = [it for it in range(len(counts)) if it != axis]
        faces = []
        for place in itertools.product(*(range(counts[it]) for it in others)):
            def at(steps):
                spot = [0] * len(counts)
                spot[axis] = end * counts[axis]
                for it, start, step in zip(others, place, steps):
                    spot[it] = start + step
                return number[tuple(spot)]
            faces.append([at((0,)), at((1,))] if len(counts) == 2 else [at(step) for step in ring])
        sides[name] = faces
    return nodes, cells, sides


def split(cell):
    """Triangles of a quadrangle."""
    a, b, c, d = cell
    return [[a, b, c], [a, c, d]]


def mesh(bodies, kind, units, frame):
    """Text of the mesh (Gmsh 2.2) of some bodies of a kind of cell."""
    dimensions = len(bodies[0][0][0])
    names, elements, nodes = [], [], []
    cell_type = {"quadrangle": 3, "triangle": 2, "hexahedron": 5}[kind]
    for index, (points, cells, sides) in enumerate(bodies):
        prefix = "ab"[index]
        nodes += [frame.vector([units(it, length=1) for it in point]) for point in points]
        for side, faces in sides.items():
            names.append((dimensions - 1, len(names) + 1, prefix + side))
            elements += [(1 if dimensions == 2 else 3, names[-1][1], face) for face in faces]
        names.append((dimensions, len(names) + 1, prefix + "body"))
        if kind == "triangle":
            cells = [half for cell in cells for half in split(cell)]
        if frame.kind == "mirrored":
            # In the order that gives a mirrored cell a positive size.
            cells = [cell[::-1] if dimensions == 2 else cell[4:] + cell[:4] for cell in cells]
        elements += [(cell_type, names[-1][1], cell) for cell in cells]
    lines = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$PhysicalNames", str(len(names)), *(f'{dim} {tag} "{name}"' for dim, tag, name in names),
             "$EndPhysicalNames", "$Nodes", str(len(nodes))]
    lines += [" ".join([str(number), *(repr(it + 0.0) for it in point + [0.0] * (3 - dimensions))]) for number, point in enumerate(nodes, 1)]
    lines += ["$EndNodes", "$Elements", str(len(elements))]
    lines += [f"{number} {kind} 2 {tag} {tag} {' '.join(map(str, of))}" for number, (kind, tag, of) in enumerate(elements, 1)]
    return "\n".join([*lines, "$EndElements", ""])


def drawn(number):
    """What a problem is, in its own units: bodies of one metre and 10 GPa."""
    draw = random.Random(f"contact {number}")
    dimensions = draw.choice([2, 2, 2, 3])
    law = draw.choice(sorted(LAWS[dimensions]))
    driver = draw.choice(["elastic", "steps", "steps", "auto", "auto", "explicit", "explicit", "implicit"])
    meets = draw.choice(["contact", "contact", "rigid"])
    kind = "hexahedron" if dimensions == 3 else draw.choice(["quadrangle", "triangle"])
    counts = [draw.randint(4, 7), draw.randint(3, 6)] if dimensions == 2 else [draw.randint(2, 3), 2, 2]
    height = counts[1] / counts[0]
    sizes = [1.0, height] + [2 / counts[0]] * (dimensions - 2)
    # Two meshes without a gap are one body, whose bonds pass from one to the other.
    gap = draw.choice([1e-5, 1e-4, 1e-3, 2.5e-3] if meets == "contact" else [0.0, 1e-4, 1e-3, 2.5e-3])
    bodies = [block(draw, counts, sizes, [0.0] * dimensions, 1)]
    if meets == "contact":
        share = draw.choice([1.0, 0.6])
        other = [draw.randint(3, 5), draw.randint(2, 4)] if dimensions == 2 else [2, 2, 2]
        of_other = [0.6, share * height, *sizes[2:]]
        # Nodes face no nodes, as they seldom do.
        beside = [(0.5 * (1 - share) + 0.0371) * height, *(0.0271 for _ in sizes[2:])]
        bodies.append(block(draw, other, of_other, [1.0 + gap, *beside], len(bodies[0][0]) + 1))
    return {
        "draw": draw, "dimensions": dimensions, "law": law, "driver": driver, "meets": meets, "kind": kind, "sizes": sizes, "gap": gap,
        "bodies": bodies, "poisson": draw.choice(LAWS[dimensions][law]),
        "horizon": draw.choice([2.5, 3.0]), "surface": draw.choice(["none", "volume"]),
        "plane": draw.choice(["stress", "strain"]) if law == "pds" else "stress",
        "friction": draw.choice([0.0, 0.0, 0.3]), "push": draw.choice(["displacement", "displacement", "force", "thrown"]),
        "criterion": draw.choice(["strength", "bond-rankine", "tension", "mohr-coulomb", "critical-stretch", None]),
        "softens": draw.random() < 0.2, "precrack": draw.random() < 0.4, "at": draw.uniform(0.4, 0.6), "depth": draw.uniform(0.2, 0.7),
        "cracks": draw.random() < 0.3, "between": draw.random() < 0.5, "touches": draw.random() < 0.2, "slanted": draw.choice([0.0, 0.0, 0.2]), "beyond": draw.choice([1.0, 1.25, 4.0]),
        "shape": draw.choice(["wall", "box", "circle"]), "mass": draw.random() < 0.3, "damped": draw.choice([0.0, 500.0]),
        "amplitude": draw.choice(["ramp", "smooth-ramp", "triangle"]),
    }


def case(it, units, frame):
    """Text of the case of a problem in some units and axes."""
    pressure = dict(force=1, length=-2)
    dimensions, driver, sizes = it["dimensions"], it["driver"], it["sizes"]
    is_motion = driver in ("auto", "explicit", "implicit")
    # Quasi-static drivers get no body that is thrown; what nothing holds is for motions and for load steps that end at once.
    push = "displacement" if it["push"] == "thrown" and not is_motion or driver == "auto" and it["push"] == "thrown" else it["push"]
    # Ways of which load steps are a part that just closes the gap, as people write them, and others.
    way = 1.2 * it["gap"] if it["touches"] and it["gap"] > 1e-4 else it["gap"] + it["beyond"] * 4e-4
    duration = 1.2e-3
    text = [f'analysis = "{"motion" if is_motion else "static" if driver == "elastic" else "fracture"}"', "[mesh]", 'file = "body.msh"']
    if dimensions == 2:
        text += [f"thickness = {units(0.01, length=1)!r}", f'plane = "{it["plane"]}"']
    poisson = 0.25 if it["law"] == "bbpd" and it["plane"] == "strain" else it["poisson"]
    text += ["[material]", f"young = {units(1e10, **pressure)!r}", f"poisson = {poisson!r}",
             f"density = {units(2500.0, force=1, time=2, length=-4)!r}", f"tensile_strength = {units(2e6, **pressure)!r}",
             f"compressive_strength = {units(1.6e7, **pressure)!r}", f"fracture_energy = {units(20.0, force=1, length=-1)!r}"]
    text += ["[model]", f'law = "{it["law"]}"', f"horizon_factor = {it['horizon']!r}", "[correction]", f'surface = "{"none" if it["law"] == "mppd-beam" else it["surface"]}"']
    has_fracture = driver != "elastic" and it["criterion"]
    soft = it["softens"] and driver != "explicit"
    if it["precrack"]:
        at, depth = it["at"], it["depth"] * sizes[1]
        line = [[at, -0.1], [at, depth]] if dimensions == 2 else [[at, -0.1, -0.1], [at, depth, -0.1], [at, depth, 2 * sizes[2]], [at, -0.1, 2 * sizes[2]]]
        text += ["[[precrack]]", f"points = {[frame.vector([units(x, length=1) for x in point]) for point in line]}"]
    axes = "xyz"[:dimensions]
    amplitude = f'amplitude = {{ shape = "{it["amplitude"]}", duration = {units(0.6 * duration, time=1)!r} }}'
    section = sizes[1] * (0.01 if dimensions == 2 else sizes[2])
    direction = {"x": 1.0, **({"y": it["slanted"]} if it["slanted"] else {})}
    fixed = "bright" if it["meets"] == "contact" else "aleft"
    text += ["[[support]]", f'group = "{fixed}"', f"displacement = {frame.axes(dict.fromkeys(axes, 0.0))}"]
    if it["meets"] == "contact":
        if push == "thrown":
            text += ["[[initial_velocity]]", 'group = "abody"', f"velocity = {frame.axes({axis: units(4.0 * value, length=1, time=-1) for axis, value in direction.items()})}"]
        elif push == "force":
            text += ["[[load]]", 'name = "push"', 'group = "aleft"', f"force = {frame.axes({axis: units(4e6 * section * value, force=1) for axis, value in direction.items()})}"]
            text += [amplitude] * is_motion
        else:
            text += ["[[load]]", 'name = "push"', 'group = "aleft"', f"displacement = {frame.axes({axis: units(way * value, length=1) for axis, value in direction.items()})}"]
            text += [amplitude] * is_motion
        text += ["[[contact]]", f"friction = {it['friction']!r}"]
        text += ['between = ["aright", "bleft"]'] * it["between"]
        text += ["cracks = true"] * (it["cracks"] and driver == "explicit" and not it["between"])
    else:
        middle = [0.5 * size for size in sizes]
        shape = it["shape"] if dimensions == 2 or it["shape"] != "circle" else "sphere"
        half = 0.2
        centre = [1.0 + it["gap"] + (0.0 if shape == "wall" else half), *middle[1:]]
        text += ["[[rigid]]", 'name = "r"', f'shape = "{shape}"', f"centre = {frame.vector([units(x, length=1) for x in centre])}", f"friction = {it['friction']!r}"]
        if shape == "wall":
            text += [f"normal = {frame.vector([-1.0] + [0.0] * (dimensions - 1))}"]
        elif shape == "box":
            text += [f"size = {frame.size([units(x, length=1) for x in [2 * half, *(0.6 * size for size in sizes[1:])]])}"]
        else:
            text += [f"radius = {units(half, length=1)!r}"]
        towards = {axis: -value for axis, value in direction.items()}
        if is_motion:
            speed = 4.0 if driver != "auto" else 2 * way / duration
            text += [f"velocity = {frame.axes({axis: units(speed * value, length=1, time=-1) for axis, value in towards.items()})}"]
            # A wall does not fly, and equilibria move no body with a mass.
            flies = it["mass"] and shape != "wall" and driver == "explicit"
            text += [f"mass = {units(5.0 * section, force=1, time=2, length=-1)!r}"] if flies else [amplitude]
            if driver == "auto":
                text[-1:] = [f'amplitude = {{ shape = "rectangle", duration = {units(duration, time=1)!r} }}']
        else:
            text += [f"displacement = {frame.axes({axis: units(way * value, length=1) for axis, value in towards.items()})}"]
    if is_motion:
        text += ["[motion]", f"duration = {units(duration, time=1)!r}", "rows = 8", f'scheme = "{driver}"', "stop = { bonds = 200 }"]
        text += [f"step = {units(1.5e-5, time=1)!r}"] * (driver != "explicit")
        text += [f"damping = {{ mass = {units(it['damped'], time=-1)!r} }}"] * (it["damped"] > 0)
    if has_fracture:
        text += ["[fracture]", *(["steps = 6", "stop = { bonds = 200 }"] if not is_motion else []), "[[fracture.criterion]]"]
        text += ['kind = "rankine"', 'after = "linear"'] if soft else [f'kind = "{it["criterion"]}"']
    elif driver == "steps":
        # Bonds that never break: equilibria alone.
        text += ["[fracture]", "steps = 6", "[[fracture.criterion]]", 'kind = "tension"', "limit = 1.0"]
    text += ["[output]", "model = false", "fields_every = 0"]
    return "\n".join(text) + "\n"


def run(program, folder, name, it, units, frame):
    """How a twin ended: exit code, end, broken bonds in order by their nodes, time of the first and work in the units of the problem."""
    where = folder / name
    where.mkdir(parents=True)
    (where / "case.toml").write_text(case(it, units, frame))
    (where / "body.msh").write_text(mesh(it["bodies"], it["kind"], units, frame))
    arguments = ["run", "case.toml", "--out", "results", "--quiet"]
    environment = {**os.environ, "RAYON_NUM_THREADS": "1"}

    def limited():
        resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
        resource.setrlimit(resource.RLIMIT_CPU, (PATIENCE, PATIENCE + 5))

    try:
        done = subprocess.run([str(program), *arguments], cwd=where, env=environment, capture_output=True, text=True, timeout=PATIENCE, preexec_fn=limited)
    except subprocess.TimeoutExpired:
        return {"exit": None, "end": f"no end within {PATIENCE} s", "bonds": [], "first": None, "work": 0.0}
    out = where / "results"
    if not (out / "summary.json").exists():
        # Places in the words of an error are those of the twin.
        said = next((line for line in done.stderr.splitlines() if line.startswith("error")), "no result: " + done.stderr.strip()[-300:])[:40]
        return {"exit": done.returncode, "end": said, "bonds": [], "first": None, "work": 0.0}
    summary = json.loads((out / "summary.json").read_text())
    broken = list(csv.DictReader(open(out / "breaks.csv"))) if (out / "breaks.csv").exists() else []
    ends = [name for name in (broken[0] if broken else {}) if name.startswith(("node", "point"))][:2]
    rows = list(csv.DictReader(open(out / "history.csv")))
    work = float(rows[-1].get("external_work") or 0.0) if rows else 0.0
    return {"exit": done.returncode, "end": summary["termination"], "bonds": [tuple(sorted(row[it] for it in ends)) for row in broken],
            "first": float(broken[0]["load_factor"]) / units.time if broken and it["driver"] in ("auto", "explicit", "implicit") else None,
            "work": work / (units.force * units.length)}


def difference(it, one, other):
    """In what two twins differ; none if they are alike."""
    counts = [len(twin["bonds"]) for twin in (one, other)]
    is_motion = it["driver"] in ("auto", "explicit", "implicit")
    # The rule that stops at a number of bonds is met or missed by one of them.
    near = is_motion and max(counts) >= 200 - CHAOTIC_BONDS
    for fact in ("exit", "end"):
        if one[fact] != other[fact] and not (near and {one["end"], other["end"]} == {"time-reached", "bonds-broken"}):
            return f"{fact} {one[fact]!r} and {other[fact]!r} ({counts[0]} and {counts[1]} bonds broken)"
    if not is_motion or max(counts) == 0:
        if set(one["bonds"]) != set(other["bonds"]):
            return f"{len(set(one['bonds']) ^ set(other['bonds']))} bonds of {counts[0]} and {counts[1]}"
        scale = max(abs(one["work"]), abs(other["work"]))
        if not abs(one["work"] - other["work"]) <= SAME_WORK * scale + NO_WORK * 1e10:
            return f"work {one['work']:.6g} and {other['work']:.6g} J, with {counts[0]} bonds broken in both"
        return None
    if abs(counts[0] - counts[1]) > max(CHAOTIC_BONDS, CHAOTIC_SHARE * max(counts)):
        return f"{counts[0]} and {counts[1]} bonds broken"
    if one["first"] is None or other["first"] is None:
        return f"{counts[0]} and {counts[1]} bonds broken" if min(counts) == 0 and max(counts) > 2 else None
    if not math.isclose(one["first"], other["first"], rel_tol=0.02):
        return f"first bond {one['bonds'][0]} at {one['first']:.6g} s and {other['bonds'][0]} at {other['first']:.6g} s"
    return None


def compare(program, number, keep):
    """The end of a problem, and the differences of its twins from it."""
    folder = SCRATCH / str(number)
    shutil.rmtree(folder, ignore_errors=True)
    it = drawn(number)
    draw = random.Random(f"units {number}")
    units = Units(*(10 ** draw.uniform(-6, 6) for _ in range(3)))
    twins = {"units": (units, Frame()), "turned": (Units(), Frame("turned")), "mirrored": (Units(), Frame("mirrored"))}
    own = run(program, folder, "own", it, Units(), Frame())
    differences = []
    for name, (of_twin, frame) in twins.items():
        off = difference(it, own, run(program, folder, name, it, of_twin, frame))
        if off:
            differences.append(f"{number} ({it['driver']}, {it['law']}, {it['meets']}, {it['kind']}), {name}: {off}")
    if not differences and not keep:
        shutil.rmtree(folder)
    return (it["driver"], own["end"], len(own["bonds"])), differences


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=Path)
    parser.add_argument("--problems", type=int, default=20, help="number of problems")
    parser.add_argument("--first", type=int, default=0, help="number of the first of them")
    parser.add_argument("--keep", action="store_true", help="keep the folders of all problems")
    parser.add_argument("--jobs", type=int, default=os.cpu_count(), help="problems at once")
    options = parser.parse_args()
    program = options.program.resolve()
    numbers = list(range(options.first, options.first + options.problems))
    if options.problems > 1:
        numbers += [number for number in ONCE_DIFFERENT if number not in numbers]
    with ThreadPoolExecutor(options.jobs) as pool:
        found = []
        for one in pool.map(lambda number: compare(program, number, options.keep), numbers):
            found.append(one)
            print("\n".join(one[1]), end="\n" if one[1] else "", flush=True)
    ends = {}
    for (driver, end, bonds), _ in found:
        key = (driver, end, "bonds broke" if bonds else "none broke")
        ends[key] = ends.get(key, 0) + 1
    print(f"{len(numbers)} problems, each with {3} twins: " + "; ".join(f"{', '.join(key)}: {count}" for key, count in sorted(ends.items())))
    differences = sum(len(several) for _, several in found)
    if differences:
        sys.exit(f"{differences} twins differ; the cases are in {SCRATCH}")


if __name__ == "__main__":
    main()
