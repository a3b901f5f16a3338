#!/usr/bin/env python3
"""Baseline: the same fracture by SuiteSparse's CHOLMOD, and a check that it breaks the same bonds as the program.

    apt-get install libsuitesparse-dev libopenblas0-pthread     # a fast BLAS matters: see what the script prints
    pip install -r tools/requirements-bench.txt
    tools/bench disk-10k-3000 --bonds 20                        # the program's run, one bond at a time
    python tools/bench_cholmod.py target/bench/runs/disk-10k-3000

takes mesh and settings from case.resolved.toml in the result folder, and the bonds, rigidities and critical stretches
from tools/reference_nhpd.py, which shares no code with the program.  After every breakage the values of the matrix
change in place and it is factorised by CHOLMOD over a symbolic analysis done once (`--method refactor`), or its factor
is downdated by CHOLMOD (`--method downdate`).  It stops where the program stopped, or after `--bonds`.

Only supports and displacements on groups, one material and intact bodies; no bond may hang loose: such a body is
refused, or the run ends before.
"""
import argparse
import csv
import json
import os
import sys
import time
import tomllib
from pathlib import Path

# Before NumPy and CHOLMOD load their BLAS.
THREADS = argparse.ArgumentParser(add_help=False)
THREADS.add_argument("--threads", type=int, default=1, metavar="N", help="threads of the BLAS [1]")
for variable in "OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS":
    os.environ[variable] = str(THREADS.parse_known_args()[0].threads)

import numpy as np  # noqa: E402
import scipy.sparse as sp  # noqa: E402
from sksparse import cholmod  # noqa: E402

from reference_nhpd import Model, supports  # noqa: E402

COMPONENTS = {"x": 0, "y": 1, "rotation": 2}


class Clock:
    """Seconds spent, by what they were spent on."""

    def __init__(self):
        self.seconds = {}

    def time(self, name, work, *arguments):
        start = time.perf_counter()
        result = work(*arguments)
        self.seconds[name] = self.seconds.get(name, 0.0) + time.perf_counter() - start
        return result


class Stiffness:
    """The stiffness of the free unknowns: its pattern made once, its values changed in place."""

    def __init__(self, model, held):
        self.number = np.full(3 * model.n, -1)
        self.number[~held] = np.arange((~held).sum())
        n = (~held).sum()
        dofs = self.number[model.dofs]
        rows, columns = np.repeat(dofs, 6, axis=1), np.tile(dofs, (1, 6))
        lower = (rows >= columns) & (columns >= 0)              # CHOLMOD reads the lower triangle
        key = np.where(lower, columns * n + rows, -1)
        places, place = np.unique(key, return_inverse=True)
        skipped = int(places[0] == -1)
        self.place = place.reshape(key.shape) - skipped         # of each entry of each element, -1: none
        places = places[skipped:]
        starts = np.searchsorted(places, np.arange(n + 1) * n)
        self.elements = model.Ke.reshape(-1, 36)
        values = np.bincount(self.place[lower], self.elements[lower], len(places))
        self.matrix = sp.csc_matrix((values, places % n, starts), (n, n))

    def remove(self, bonds):
        for bond in bonds:
            inside = self.place[bond] >= 0
            np.subtract.at(self.matrix.data, self.place[bond][inside], self.elements[bond][inside])

    def vectors(self, model, bonds):
        """Columns w with sum w w^T = the stiffness of the bonds, over the free unknowns."""
        rigidities = np.column_stack([model.kn * model.l, model.kt * model.l, model.kr])[bonds] * model.w[bonds, None]
        w = (model.T[bonds] * np.sqrt(rigidities)[:, :, None]).reshape(-1, 6)           # bonds x 3, 6
        rows = np.repeat(self.number[model.dofs[bonds]], 3, axis=0)
        columns = np.repeat(np.arange(len(w))[:, None], 6, axis=1)
        inside = rows >= 0
        return sp.csc_matrix((w[inside], (rows[inside], columns[inside])), (self.matrix.shape[0], len(w)))


def next_to_break(stretch, model, alive, order, tie):
    """The bond that leads among those beyond their limits, and the bonds tied with it; none: empty."""
    rank = stretch - model.s0 if order == "excess" else stretch / model.s0
    rank = np.where(alive & (stretch >= model.s0), rank, -np.inf)
    lead = rank.argmax()
    if rank[lead] == -np.inf:
        return np.array([], int)
    tied = rank[lead] - tie * (stretch[lead] if order == "excess" else rank[lead])
    every = stretch - model.s0 if order == "excess" else stretch / model.s0
    return np.flatnonzero(alive & (stretch > 0) & (every >= tied))


def solver(method, factor, stiffness, model):
    """A function that takes bonds out of the matrix and its factor."""
    def refactor(clock, bonds):
        clock.time("matrix", stiffness.remove, bonds)
        clock.time("factorisation", factor.cholesky_inplace, stiffness.matrix)

    def downdate(clock, bonds):
        stiffness.remove(bonds)                                 # for the residual at the end alone
        vectors = clock.time("matrix", stiffness.vectors, model, bonds)
        clock.time("downdate", factor.update_inplace, vectors, True)

    return {"refactor": refactor, "downdate": downdate}[method]


def follow(model, case, method, ordering, limit):
    """Breaks up to `limit` bonds; the bonds in order with their load steps, and what it cost."""
    fracture = case["fracture"]
    if fracture.get("control", "stepped") != "stepped" or fracture["bonds_per_iteration"] != 1:
        sys.exit("bench_cholmod.py: only stepped loading with fracture.bonds_per_iteration = 1")
    steps = fracture["steps"]
    factors = [k / steps for k in range(1, steps + 1)] if isinstance(steps, int) else steps
    entries = [(place["group"], COMPONENTS[component], value) for place in [*case["support"], *case["load"]]
               for component, value in place["displacement"].items()]
    held, value = supports(model, entries)
    setup, clock = Clock(), Clock()
    stiffness = setup.time("pattern and assembly", Stiffness, model, held)
    mode = "simplicial" if method == "downdate" else "supernodal"
    factor = setup.time("symbolic analysis", lambda: cholmod.analyze(stiffness.matrix, mode, ordering))
    setup.time("first factorisation", factor.cholesky_inplace, stiffness.matrix)
    remove = solver(method, factor, stiffness, model)

    # Loads are displacements, so that every force and every displacement grows with the load factor.
    def force(bonds):
        """Forces of the held displacements at load factor 1, carried by these bonds."""
        ends = np.einsum("nij,nj->ni", model.Ke[bonds], value[model.dofs[bonds]])
        return np.bincount(model.dofs[bonds].ravel(), ends.ravel(), 3 * model.n)[~held]

    displacement, alive = value.copy(), np.ones(model.nb, bool)
    right_hand_side = -force(np.arange(model.nb))
    displacement[~held] = setup.time("first solve", factor, right_hand_side)
    survivors = np.bincount(np.r_[model.A, model.B], minlength=model.n)
    stretch, breaks = model.stretch(displacement), []
    start, processor_start = time.perf_counter(), time.process_time()
    for step, load_factor in enumerate(factors, 1):
        while len(breaks) < limit:
            bonds = clock.time("choice", next_to_break, load_factor * stretch, model, alive, fracture["order"],
                               fracture["tie_tolerance"])
            if len(bonds) == 0:
                break
            np.subtract.at(survivors, np.r_[model.A[bonds], model.B[bonds]], 1)
            if survivors.min() == 0:
                print("a point would hang loose: ended before")
                limit = len(breaks)
                break
            breaks += [(step, bond) for bond in bonds]
            alive[bonds] = False
            remove(clock, bonds)
            right_hand_side += force(bonds)
            displacement[~held] = clock.time("solve", factor, right_hand_side)
            stretch = clock.time("bonds", model.stretch, displacement)
        if len(breaks) >= limit:
            break
    loop, processor = time.perf_counter() - start, time.process_time() - processor_start
    lower = stiffness.matrix
    full = lower + sp.tril(lower, -1).T
    residual = np.abs(full @ displacement[~held] - right_hand_side).max() / np.abs(right_hand_side).max()
    return breaks, {"unknowns": int((~held).sum()), "breakages": len(breaks), "setup_seconds": setup.seconds,
                    "loop_seconds": loop, "processors": processor / loop, "residual": float(residual),
                    "breakage_seconds": {key: each / max(len(breaks), 1) for key, each in clock.seconds.items()}}


def blas():
    """The libraries that CHOLMOD's BLAS comes from (NumPy brings its own); known on Linux."""
    maps = Path("/proc/self/maps")
    paths = {line.split()[-1] for line in maps.read_text().splitlines() if "blas" in line} if maps.exists() else set()
    names = {Path(path).resolve().name for path in paths if "site-packages" not in path}
    return ", ".join(sorted(names)) or "unknown"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter,
                                     parents=[THREADS])
    parser.add_argument("folder", type=Path, help="result folder of the program's run")
    parser.add_argument("--bonds", type=int, metavar="N", help="break at most so many bonds [as many as the program]")
    parser.add_argument("--method", choices=["refactor", "downdate"], default="refactor")
    parser.add_argument("--ordering", default="metis", help="of CHOLMOD: metis, nesdis, amd, best, ... [metis]")
    parser.add_argument("--json", type=Path, metavar="FILE", help="write the numbers here as well")
    options = parser.parse_args()
    case = tomllib.loads((options.folder / "case.resolved.toml").read_text())
    material = case["material"]
    if "precrack" in case or "no_fail" in case or not isinstance(material.get("young"), float):
        sys.exit("bench_cholmod.py: only intact bodies of one material")
    with open(options.folder / "breaks.csv", newline="") as file:
        expected = [(int(row["step"]), int(row["node_a"]), int(row["node_b"])) for row in csv.DictReader(file)]
    start = time.perf_counter()
    model = Model(Path(case["mesh"]["file"]), case["model"]["horizon_factor"], material["young"], material["poisson"],
                  material["tensile_strength"], case["mesh"]["plane"], case["mesh"]["thickness"])
    if min(model.kt) <= 0:
        sys.exit("bench_cholmod.py: CHOLMOD needs a positive shear stiffness")
    print(f"{model.n} points, {model.nb} bonds in {time.perf_counter() - start:.1f} s (Python)")
    limit = min(options.bonds or len(expected), len(expected))
    breaks, numbers = follow(model, case, options.method, options.ordering, limit)
    found = [(step, int(model.tags[model.A[bond]]), int(model.tags[model.B[bond]])) for step, bond in breaks]
    agrees = next((k for k, (one, other) in enumerate(zip(found, expected)) if one != other), len(found))
    total = sum(numbers["breakage_seconds"].values())
    numbers |= {"method": options.method, "ordering": options.ordering, "threads": options.threads,
                "points": model.n, "bonds": int(model.nb), "same_bonds_as_the_program": agrees,
                "breakage_total_seconds": total, "blas": blas()}
    print(f"CHOLMOD, {options.method}, {options.ordering}: {len(found)} breakages, {1e3 * total:.2f} ms each ("
          + ", ".join(f"{key} {1e3 * each:.2f}" for key, each in numbers["breakage_seconds"].items())
          + f"), residual {numbers['residual']:.1e}, {numbers['processors']:.2f} processors, BLAS {numbers['blas']}")
    print("before: " + ", ".join(f"{key} {each:.3f} s" for key, each in numbers["setup_seconds"].items()))
    if options.json:
        options.json.write_text(json.dumps(numbers, indent=1) + "\n")
    if agrees < len(found):
        sys.exit(f"breakage {agrees + 1} differs: {found[agrees]} here, {expected[agrees]} there (step, nodes)")
    print(f"the same {agrees} bonds in the same order and load steps as the program")


if __name__ == "__main__":
    main()
