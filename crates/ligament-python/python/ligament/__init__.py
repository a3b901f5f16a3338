"""Peridynamics as a finite-element-style toolchain: mesh in, cracks out.

A case says what to compute, with the sections and keys of a case file; a run of it gives a result in memory: the history as a
table, points and bonds and fields as arrays, pictures and crack paths. All values are in SI units.

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

from ligament import examples
from ligament._case import Case, Setup
from ligament._errors import BodyError, CaseError, Interrupted, LigamentError, NotCalibrated, SolutionError
from ligament._native import VERSION as __version__
from ligament._result import CrackLine, Modes, Result
from ligament._studies import Calibration, Sweep, calibrate, modal, run, sweep

__all__ = [
    "BodyError",
    "Calibration",
    "Case",
    "CaseError",
    "CrackLine",
    "Interrupted",
    "LigamentError",
    "Modes",
    "NotCalibrated",
    "Result",
    "Setup",
    "SolutionError",
    "Sweep",
    "__version__",
    "calibrate",
    "examples",
    "modal",
    "run",
    "sweep",
]
