"""Peridynamics as a finite-element-style toolchain: mesh in, cracks out.

A case says what to compute, with the sections and keys of a case file, which ``ligament.keys()`` lists; a run of it gives a result: the
history as a table, points and bonds and fields as arrays, pictures, cracks and explanations. The result is a folder of the program, which
can be kept and opened later. All values are in SI units.

>>> import ligament
>>> result = ligament.run({
...     "lattice": {
...         "cells": [30, 10], "spacing": 0.01, "thickness": 0.1,
...         "set": {"left": {"left": 2}, "right": {"right": 2}},
...     },
...     "material": {"young": 30e9, "poisson": 0.2, "tensile_strength": 3e6},
...     "model": {"law": "nhpd", "horizon_factor": 3.0},
...     "support": [{"group": "left", "displacement": {"x": 0.0, "y": 0.0}}],
...     "load": [{"group": "right", "displacement": {"x": 1e-4}}],
...     "fracture": {"steps": 10},
... }, progress=False)
>>> result.termination
'steps-done'
"""

from typing import TYPE_CHECKING, Any

from ligament import examples
from ligament._by_hand import Rows, begin
from ligament._case import Case, Setup
from ligament._convergence import Convergence, Interval, converge
from ligament._ensemble import Ensemble, Weibull, ensemble
from ligament._errors import BodyError, CaseError, Interrupted, LigamentError, NotCalibrated, SolutionError
from ligament._keys import Key, Keys, keys
from ligament._modes import Modes
from ligament._native import VERSION as __version__
from ligament._result import CrackLine, CrackOpening, CrackSurface, Result, State, open, report
from ligament._studies import Calibration, Sweep, calibrate, modal, run, sweep

if TYPE_CHECKING:
    from ligament._sections import Sections


def __getattr__(name: str) -> Any:
    """The types of the sections of a case, which are imported when they are asked for."""
    if name == "Sections":
        from ligament._sections import Sections

        return Sections
    raise AttributeError(f"module 'ligament' has no attribute {name!r}")


__all__ = [
    "BodyError",
    "Calibration",
    "Case",
    "CaseError",
    "Convergence",
    "CrackLine",
    "CrackOpening",
    "CrackSurface",
    "Ensemble",
    "Interrupted",
    "Interval",
    "Key",
    "Keys",
    "LigamentError",
    "Modes",
    "NotCalibrated",
    "Result",
    "Rows",
    "Sections",
    "Setup",
    "SolutionError",
    "State",
    "Sweep",
    "Weibull",
    "__version__",
    "begin",
    "calibrate",
    "converge",
    "ensemble",
    "examples",
    "keys",
    "modal",
    "open",
    "report",
    "run",
    "sweep",
]
