#!/usr/bin/env python3
"""Runs small cases on one and two processes with PETSc against the factor of one process, kills a process, and goes on with other numbers.

    tools/check_ranks.py target/ranks/ligament

The program must be built with the feature petsc. Needs `mpirun` beside it; without any of them it says so and fails. Needs NumPy and PyVista.
"""
import csv
import json
import os
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pyvista

import check_solvers

ROOT = Path(__file__).resolve().parent.parent
SCRATCH = ROOT / "target" / "check-ranks"

# What an iteration to 1e-8 may change in a load after up to 100 breakages; it is measured to be 3e-9. A factor leaves rounding: 1e-14.
ITERATED, FACTORISED = 1e-7, 1e-10

# Fields at a point beside a crack follow the last breakage: their iteration leaves some ten times more of them than of the load.
FIELDS = 1e-6

# The 3-D body from a crack on, the disk in load steps with one bond after another, and a body whose stiffness is indefinite.
BLOCK = ["cases/split-block/case.toml", "--set", "fracture.stop.bonds=40", "--set", "fracture.tie_tolerance=1e-6"]
DISK = ["cases/brazilian-disk/case.toml", "--set", "fracture.stop.bonds=25", "--set", "fracture.tie_tolerance=1e-6",
        "--set", "fracture.bonds_per_iteration=1"]
INDEFINITE = ["cases/split-block/case.toml", "--set", "fracture.stop.bonds=4", "--set", "material.poisson=0.3"]
LATTICE = ["cases/lattice-plate/case.toml", "--set", "fracture.stop.bonds=20", "--set", "fracture.tie_tolerance=1e-6"]
CLOSING = ["cases/closing-crack/case.toml"]

# Problems of tools/check_solvers.py by dimension, law and number that end as mechanisms, on the exact path and in load steps, the second of
# them a mechanism from the start; and two that go on where few bonds hold a point, which an estimated smoother makes indefinite.
MECHANISMS = [(2, "bbpd", 12), (2, "bbpd", 8), (2, "bbpd-conical", 75), (3, "bbpd", 34)]
WEAK = [(2, "pds", 2), (3, "pds", 0)]

# Long enough for a checkpoint to come and a process to be killed.
LONG = ["cases/split-block/case.toml", "--set", "fracture.stop.bonds=100", "--set", "fracture.tie_tolerance=1e-6",
        "--set", "output.checkpoint_every=0.1"]

ENVIRONMENT = {**os.environ, "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1", "OMPI_MCA_rmaps_base_oversubscribe": "1"}


def command(program, ranks, arguments):
    """The command for a number of processes; None is one without a launcher."""
    launcher = [] if ranks is None else ["mpirun", "-np", str(ranks)]
    return [*launcher, str(program), *arguments]


def call(program, ranks, arguments, fails=False):
    """Runs the program and gives what it said."""
    done = subprocess.run(command(program, ranks, arguments), cwd=ROOT, env=ENVIRONMENT, capture_output=True, text=True, timeout=600)
    assert fails == (done.returncode != 0), f"{arguments}: {done.returncode}\n{done.stdout}\n{done.stderr}"
    return done.stdout + done.stderr


def broken(folder):
    """Bonds in the order of breaking, with the loads."""
    with open(folder / "breaks.csv", newline="") as file:
        rows = list(csv.DictReader(file))
    ends = [column for column in rows[0] if column in ("node_a", "node_b", "cell_a", "cell_b")]
    return [(row["step"], *(row[end] for end in ends)) for row in rows], [float(row["reaction"]) for row in rows]


def compare(name, folder, reference, tolerance):
    """Two runs broke the same bonds in the same order at the same loads."""
    (bonds, loads), (wanted, at) = broken(folder), broken(reference)
    assert bonds == wanted, f"{name}: other bonds, or in another order"
    off = max(abs(load - other) / abs(other) for load, other in zip(loads, at))
    assert off <= tolerance, f"{name}: loads differ by {off:.1e}"
    print(f"  {name}: the same {len(bonds)} bonds, loads within {off:.1e}")


def solver(folder):
    return json.loads((folder / "summary.json").read_text())["solver"]


def check_case(program, name, case, tolerance):
    """One and two processes against the program without a launcher, which has its own factor."""
    alone = SCRATCH / f"{name}-alone"
    call(program, None, ["run", *case, "--out", str(alone), "--force", "--quiet"])
    assert solver(alone)["method"] == "direct"
    for ranks in (1, 2):
        out = SCRATCH / f"{name}-{ranks}"
        said = call(program, ranks, ["run", *case, "--out", str(out), "--force", "--quiet"])
        assert said.count("ended because") == 1, f"{name}: one message, from the first process\n{said}"
        assert (solver(out)["method"], solver(out)["ranks"]) == ("distributed", ranks)
        assert ("iterations" in solver(out)) == (tolerance == ITERATED)
        compare(f"{name}, {ranks} processes", out, alone, tolerance)


def last_fields(folder):
    """The fields of the last step by PyVista, in the order of the body: in pieces, points on borders come several times."""
    path = sorted(it for it in folder.glob("fields_*.*vtu") if ".piece_" not in it.name)[-1]
    grid = pyvista.read(path)
    of_points, of_cells = ({name: np.asarray(data[name]) for name in data.keys()} for data in (grid.point_data, grid.cell_data))
    for fields in (of_points, of_cells):
        place = fields.pop("point_number" if fields is of_points else "cell_number", None)
        if place is None:
            continue
        for name, values in fields.items():
            whole = np.full((place.max() + 1, *values.shape[1:]), np.iinfo(values.dtype).max if values.dtype.kind == "i" else np.nan,
                            values.dtype)
            whole[place] = values
            assert np.array_equal(whole[place], values), f"{path}: {name} differs between pieces"
            fields[name] = whole
    return path, {**of_cells, **of_points}


def check_pieces(program, name, tolerance):
    """What two processes wrote in pieces reads like what one wrote, also for the commands that look at results."""
    (path, pieces), (_, whole) = (last_fields(SCRATCH / f"{name}-{it}") for it in (2, "alone"))
    assert path.suffix == ".pvtu" and len(list(path.parent.glob(f"{path.stem}.piece_*.vtu"))) == 2, path
    assert pieces.keys() == whole.keys(), pieces.keys() ^ whole.keys()
    for field, values in whole.items():
        assert pieces[field].shape == values.shape, field
        off = np.abs(pieces[field] - values).max()
        # Displacements of all bodies are far below a metre, and other fields are judged by their own size.
        assert off <= tolerance * max(np.abs(values).max(), 1e-6), f"{name}: {field} is off by {off:.1e}"
    for arguments in (["plot"], ["crack"], ["report"]):
        call(program, None, [arguments[0], str(path.parent), *arguments[1:]])
    print(f"  {name}: {len(whole)} fields in two pieces are those of one process")


def processes_of(parent):
    """The processes that one has started."""
    found = []
    for entry in Path("/proc").iterdir():
        if entry.name.isdigit():
            try:
                text = (entry / "stat").read_text()
            except OSError:
                continue
            if int(text.rsplit(")", 1)[1].split()[1]) == parent:
                found.append(int(entry.name))
    return sorted(found)


def check_killed(program):
    """The second process is killed: the run ends with a message, and any number of processes goes on from its checkpoint."""
    reference = SCRATCH / "whole"
    call(program, None, ["run", *LONG, "--out", str(reference), "--force", "--quiet"])
    killed = SCRATCH / "killed"
    shutil.rmtree(killed, ignore_errors=True)
    arguments = ["run", *LONG, "--out", str(killed), "--quiet"]
    run = subprocess.Popen(command(program, 2, arguments), cwd=ROOT, env=ENVIRONMENT, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                           text=True)
    until = time.monotonic() + 120
    while not (killed / "checkpoint.bin").exists():
        assert run.poll() is None and time.monotonic() < until, "no checkpoint came"
        time.sleep(0.02)
    os.kill(processes_of(run.pid)[-1], signal.SIGKILL)
    said, _ = run.communicate(timeout=60)
    assert run.returncode != 0 and "killed" in said.lower(), said
    assert not (killed / "summary.json").exists(), "the run was over before its process was killed"
    print("  a killed process ends the run, with a message")
    for ranks in (None, 1, 2):
        copy = SCRATCH / f"killed-{ranks}"
        shutil.rmtree(copy, ignore_errors=True)
        shutil.copytree(killed, copy)
        call(program, ranks, ["resume", str(copy), "--quiet"])
        words = "no launcher" if ranks is None else f"{ranks} processes"
        compare(f"gone on with, {words}", copy, reference, ITERATED)


def check_mechanisms(program):
    """Bodies of which broken bonds make mechanisms, or nearly, end as with the factor: the same end and exit code."""
    for problem in MECHANISMS + WEAK:
        end, differences = check_solvers.compare(program, *problem, [1, 2])
        assert end == ("collapsed" if problem in MECHANISMS else "steps-done") and not differences, (problem, end, differences)
    print(f"  {len(MECHANISMS)} mechanisms and {len(WEAK)} bodies near to one end as with the factor")


def check_errors(program):
    """What all processes meet is told once, and what they cannot solve is refused by name."""
    said = call(program, 2, ["run", "cases/no-such-case.toml"], fails=True)
    assert said.count("error:") == 1, said
    said = call(program, 2, ["run", *CLOSING, "--out", str(SCRATCH / "closing"), "--force", "--quiet"], fails=True)
    assert said.count("several processes cannot solve these equations") == 1, said
    print("  errors are told once")


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    if shutil.which("mpirun") is None:
        sys.exit("mpirun was not found: tools/install-petsc installs it")
    program = Path(sys.argv[1]).resolve()
    SCRATCH.mkdir(parents=True, exist_ok=True)
    check_errors(program)
    check_case(program, "block", BLOCK, ITERATED)
    check_case(program, "disk", DISK, ITERATED)
    check_case(program, "indefinite", INDEFINITE, FACTORISED)
    check_case(program, "lattice", LATTICE, ITERATED)
    for name in ("block", "disk", "lattice"):
        check_pieces(program, name, FIELDS)
    check_mechanisms(program)
    check_killed(program)
    print("several processes: all is as with one")


if __name__ == "__main__":
    main()
