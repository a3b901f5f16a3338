#!/usr/bin/env python3
"""Random small problems end alike with the factor and with solvers that iterate: the same end, exit code and largest load.

    tools/check_solvers.py target/release/ligament             # some problems of each law, in the plane and in space
    tools/check_solvers.py target/release/ligament --problems 500
    tools/check_solvers.py target/ranks/ligament --processes 1 2 --problems 40

With --processes the program, built with the feature petsc, runs under `mpirun` instead of with its own iteration. A problem is a jittered grid
of quadrilaterals or hexahedra with a law, horizon, correction, support, load, criterion, crack and driver drawn from its number, so that
it is the same wherever it is drawn. Bodies that hang together by little, and loads that they cannot carry, are what it is about: many
of them end as mechanisms.
"""
import argparse
import itertools
import json
import os
import random
import shutil
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
SCRATCH = ROOT / "target" / "check-solvers"

# Laws whose stiffness is definite below these ratios of Poisson, by dimension; a ratio that stands alone is that of the law.
LAWS = {
    2: {"bbpd": [1 / 3], "bbpd-conical": [1 / 3], "pds": [0.0, 0.2, 0.3], "mppd": [0.0, 0.2, 0.3], "nhpd": [0.0, 0.2, 0.3]},
    3: {"bbpd": [1 / 4], "pds": [0.0, 0.1, 0.2], "mppd": [0.0, 0.1, 0.2], "mppd-beam": [0.0, 0.1, 0.2], "nhpd": [0.0, 0.1, 0.2]},
}

# Largest loads of two runs that broke the same bonds: the iteration goes to 1e-8 of the forces at a point, and what hangs together by
# little has a condition of 1e3 between both.
SAME_LOAD = 1e-5

# Largest loads below this, N, are rounding: all problems prescribe forces above 1e4 N, or motions that would cost as much, and 1e-9 of a load is
# none to the program either. A body whose first load step breaks it has no other largest load.
NO_LOAD = 1e-5

# Problems that are always drawn, by dimension, law and number: after its last bond 105 has two motions without stiffness, whose pivots vanish where one of
# them is small; the bonds that are left of 494 are stretched by what the iteration leaves alone.
ALWAYS = [(3, "bbpd", 105), (2, "bbpd-conical", 494)]

# More processes than processors run at a time: those that wait let others go on.
ENVIRONMENT = {**os.environ, "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1", "OMPI_MCA_rmaps_base_oversubscribe": "1",
               "OMPI_MCA_mpi_yield_when_idle": "1"}


def mesh(draw, counts, sizes):
    """A grid of quadrilaterals or hexahedra as Gmsh 2.2, its inner nodes moved by up to a quarter of a cell."""
    spacing = [size / count for size, count in zip(sizes, counts)]
    number, lines = {}, []
    for place in itertools.product(*(range(count + 1) for count in reversed(counts))):
        place = place[::-1]
        number[place] = len(number) + 1
        moved = [
            step * (at + draw.uniform(-0.25, 0.25) * (0 < at < count)) for at, step, count in zip(place, spacing, counts)
        ]
        lines.append(" ".join([str(number[place]), *(repr(it) for it in moved + [0.0] * (3 - len(moved)))]))
    ring = [(0, 0), (1, 0), (1, 1), (0, 1)]
    corners = ring if len(counts) == 2 else [(*corner, up) for up in (0, 1) for corner in ring]
    kind = 3 if len(counts) == 2 else 5
    cells = []
    for place in itertools.product(*(range(count) for count in counts)):
        nodes = [number[tuple(at + step for at, step in zip(place, corner))] for corner in corners]
        cells.append(f"{len(cells) + 1} {kind} 2 1 1 {' '.join(map(str, nodes))}")
    blocks = ["$MeshFormat\n2.2 0 8\n$EndMeshFormat", f'$PhysicalNames\n1\n{len(counts)} 1 "body"\n$EndPhysicalNames',
              f"$Nodes\n{len(lines)}", *lines, f"$EndNodes\n$Elements\n{len(cells)}", *cells, "$EndElements\n"]
    return "\n".join(blocks)


def vector(components):
    return "{ " + ", ".join(f"{axis} = {value!r}" for axis, value in components.items()) + " }"


def problem(dimensions, law, number):
    """The case and the mesh of a problem."""
    draw = random.Random(f"{dimensions} {law} {number}")
    counts = [draw.randint(5, 9), draw.randint(4, 7)] if dimensions == 2 else [draw.randint(3, 6), draw.randint(2, 4), draw.randint(2, 3)]
    sizes = [1.0] + [counts[axis] / counts[0] for axis in range(1, dimensions)]
    axes = "xyz"[:dimensions]
    slack = 1e-6

    def box(lower, upper):
        return f"box = [{[it - slack for it in lower]}, {[it + slack for it in upper]}]"

    left = box([0.0] * dimensions, [0.0, *sizes[1:]])
    right = box([1.0, *[0.0] * (dimensions - 1)], sizes)
    section = 0.01 * sizes[1] if dimensions == 2 else sizes[1] * sizes[2]
    case = ["[mesh]", 'file = "body.msh"', *(["thickness = 0.01", f'plane = "{draw.choice(["stress", "strain"] if law == "bbpd" else ["stress"])}"'] if dimensions == 2 else [])]
    poisson = draw.choice(LAWS[dimensions][law])
    if law == "bbpd" and 'plane = "strain"' in case:
        poisson = 0.25
    case += ["[material]", "young = 1e10", f"poisson = {poisson!r}", "tensile_strength = 2e6", "compressive_strength = 8e6",
             "fracture_energy = 20.0"]
    case += ["[model]", f'law = "{law}"', f"horizon_factor = {draw.choice([1.6, 1.8, 2.0, 2.5, 3.0])}"]
    # Beams in space have the surfaces in their constants.
    case += ["[correction]", f'surface = "{draw.choice(["none", "volume"] if law != "mppd-beam" else ["none"])}"']
    if draw.random() < 0.6:
        at, depth = 0.5 + draw.uniform(-0.03, 0.03), draw.uniform(0.2, 0.8) * sizes[1]
        if dimensions == 2:
            case += ["[[precrack]]", f"points = [[{at!r}, -0.1], [{at!r}, {depth!r}]]"]
        else:
            high = 2 * sizes[2]
            case += ["[[precrack]]", f"points = [[{at!r}, -0.1, -0.1], [{at!r}, {depth!r}, -0.1], [{at!r}, {depth!r}, {high!r}], [{at!r}, -0.1, {high!r}]]"]
    kind = draw.choice(["roller", "springs", "clamped"])
    if kind == "clamped":
        case += ["[[support]]", left, f"displacement = {vector(dict.fromkeys(axes, 0.0))}"]
    elif kind == "springs":
        stiffness = 10 ** draw.uniform(8, 10) * section
        case += ["[[support]]", left, f"stiffness = {vector({axis: stiffness / (1 + 2 * (axis != 'x')) for axis in axes})}"]
    else:
        case += ["[[support]]", left, "displacement = { x = 0.0 }"]
        case += ["[[support]]", box([0.0] * dimensions, [0.0] * dimensions), f"displacement = {vector(dict.fromkeys(axes[1:], 0.0))}"]
        if dimensions == 3:
            case += ["[[support]]", box([0.0, sizes[1], 0.0], [0.0, sizes[1], 0.0]), "displacement = { z = 0.0 }"]
    # Twice what the whole body carries, so that most of them fail on the way.
    force = draw.choice([-1, 1, 1]) * 4e6 * section
    if draw.random() < 0.7:
        case += ["[[load]]", right, f"force = {vector({'x': force, 'y': draw.choice([0.0, 0.05, 0.2]) * force})}"]
    else:
        case += ["[[load]]", right, f"displacement = {vector({'x': 8e-4 * force / abs(force)})}"]
    case += ["[solver]", 'method = "direct"']
    control = 'control = "event"\nstop = { bonds = 150 }' if draw.random() < 0.4 else "steps = 8"
    # What is tied for one solver must be for the other: both take ties of 1e-6.
    case += ["[fracture]", control, "tie_tolerance = 1e-6", "[[fracture.criterion]]", f'kind = "{draw.choice(["tension", "critical-stretch"])}"']
    case += ["[output]", "model = false", "fields_every = 0"]
    return "\n".join(case) + "\n", mesh(draw, counts, sizes)


def end_of(program, folder, name, launcher, method):
    """How a run ended: its exit code, end, largest load and broken bonds in order."""
    out = folder / name
    arguments = ["run", str(folder / "case.toml"), "--out", str(out), "--force", "--quiet", "--set", f"solver.method={method}"]
    environment = {**ENVIRONMENT, "RAYON_NUM_THREADS": "1"}
    done = subprocess.run([*launcher, str(program), *arguments], cwd=folder, env=environment, capture_output=True, text=True, timeout=300)
    if not (out / "summary.json").exists():
        # `mpirun` says more about a program that refused its input than the program itself.
        said = next((line for line in done.stderr.splitlines() if line.startswith("error")), done.stderr.strip()[-300:])
        return {"exit": done.returncode, "end": said, "peak": None, "bonds": []}
    summary = json.loads((out / "summary.json").read_text())
    bonds = (out / "breaks.csv").read_text().splitlines()[1:] if (out / "breaks.csv").exists() else []
    ends = [line.split(",")[0:1] + [it for it in line.split(",") if it.isdigit()] for line in bonds]
    return {"exit": done.returncode, "end": summary["termination"], "message": summary.get("termination_message"),
            "peak": (summary.get("peak") or {}).get("reaction"), "bonds": ends}


def difference(one, other):
    """In what two ends differ; none if they are alike."""
    for fact in ("exit", "end"):
        if one[fact] != other[fact]:
            ends = "" if fact == "end" else f", {one['end']!r} and {other['end']!r}"
            return f"{fact} {one[fact]!r} and {other[fact]!r}{ends} ({len(one['bonds'])} and {len(other['bonds'])} bonds broken)"
    if (one["peak"] is None) != (other["peak"] is None):
        return f"largest load {one['peak']} and {other['peak']}"
    if one["peak"] is not None and abs(one["peak"] - other["peak"]) > max(SAME_LOAD * max(abs(one["peak"]), abs(other["peak"])), NO_LOAD):
        return f"largest load {one['peak']!r} and {other['peak']!r} ({len(one['bonds'])} and {len(other['bonds'])} bonds broken)"
    return None


def compare(program, dimensions, law, number, processes):
    """The end of a problem with the factor, and the differences of the others from it."""
    folder = SCRATCH / f"{dimensions}d-{law}-{number}"
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    case, body = problem(dimensions, law, number)
    (folder / "case.toml").write_text(case)
    (folder / "body.msh").write_text(body)
    direct = end_of(program, folder, "direct", [], "direct")
    others = [([], "iterative")] if not processes else [(["mpirun", "-np", str(it)], "iterative") for it in processes]
    differences = []
    for launcher, method in others:
        name = method if not launcher else f"{launcher[-1]}-processes"
        off = difference(direct, end_of(program, folder, name, launcher, method))
        if off:
            differences.append(f"{folder.name}, {name}: {off}")
    if not differences:
        shutil.rmtree(folder)
    return direct["end"], differences


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=Path)
    parser.add_argument("--problems", type=int, default=8, help="problems of each law and dimension")
    parser.add_argument("--first", type=int, default=0, help="number of the first of them")
    parser.add_argument("--processes", type=int, nargs="*", default=[], help="run on so many processes with PETSc")
    parser.add_argument("--law", help="this law alone")
    options = parser.parse_args()
    tasks = [(dimensions, law, number) for dimensions, laws in LAWS.items() for law in laws if options.law in (None, law)
             for number in range(options.first, options.first + options.problems)]
    tasks += [it for it in ALWAYS if options.law in (None, it[1]) and it not in tasks]
    program = options.program.resolve()
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        found = list(pool.map(lambda task: compare(program, *task, options.processes), tasks))
    ends = {}
    for end, _ in found:
        ends[end] = ends.get(end, 0) + 1
    print(f"{len(tasks)} problems, ends with the factor: " + ", ".join(f"{end} {count}" for end, count in sorted(ends.items())))
    differences = [it for _, several in found for it in several]
    print("\n".join(differences))
    if differences:
        sys.exit(f"{len(differences)} ends differ; the cases are in {SCRATCH}")


if __name__ == "__main__":
    main()
