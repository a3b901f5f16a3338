"""Runs that go on row by row."""

from __future__ import annotations

from collections import deque
from collections.abc import Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ligament import _native
from ligament._case import Source, case_of
from ligament._errors import LigamentError


class Rows:
    """A run that goes on when it is asked for its next row: `begin` makes one.

    It is an iterator over the rows of the history, as `Result.history` has them: load steps, events of the exact path or times of a
    motion. Between two rows the body can be looked at, load steps can be given another load, and the run can be left.
    """

    def __init__(self, native: _native.Rows) -> None:
        self._native = native
        self._waiting: deque[dict[str, Any]] = deque()
        self._end: tuple[str, str] | None = None

    def __iter__(self) -> Iterator[dict[str, Any]]:
        return self

    def __next__(self) -> dict[str, Any]:
        while not self._waiting and self._end is None:
            rows, end = self._native.advance()
            self._waiting.extend(rows)
            self._end = None if end is None else (end[0], end[1])
        if not self._waiting:
            raise StopIteration
        return self._waiting.popleft()

    @property
    def termination(self) -> str | None:
        """Word for the end of the run, as `Result.termination`; None as long as it goes on."""
        return None if self._end is None else self._end[0]

    @property
    def termination_message(self) -> str | None:
        """Sentence on the end of the run; None as long as it goes on."""
        return None if self._end is None else self._end[1]

    @property
    def displacement(self) -> NDArray[np.float64]:
        """Displacements of the points at present, in the order of the body's file: (n, 2) or (n, 3), m."""
        return self._native.displacement()

    @property
    def damage(self) -> NDArray[np.float64]:
        """Shares of the bonds of the points that are broken at present, in the order of the body's file: (n)."""
        return self._native.damage()

    def set_next_load_factor(self, load_factor: float) -> None:
        """Gives the next load step another load factor, or another share of the motion or energy that controls its stage."""
        if not self._native.set_next_load_factor(load_factor):
            hint = "`fracture.control=\"stepped\"` runs through load steps"
            raise LigamentError(f"the run has no further load step that could take a load factor; {hint}", hint=hint)


def begin(case: Source, /, **changes: Any) -> Rows:
    """Begins the run of a case, which then goes on row by row, and writes nothing.

    >>> steps = begin({
    ...     "lattice": {"cells": [20, 10], "spacing": 0.01, "set": {"left": {"left": 2}, "right": {"right": 2}}},
    ...     "material": {"young": 30e9, "poisson": 0.2, "tensile_strength": 3e6},
    ...     "model": {"law": "nhpd", "horizon_factor": 3.0},
    ...     "support": [{"group": "left", "displacement": {"x": 0.0, "y": 0.0}}],
    ...     "load": [{"group": "right", "displacement": {"x": 1e-4}}],
    ...     "fracture": {"steps": 10},
    ... })
    >>> for row in steps:
    ...     if row["broken_bonds"] > 0:
    ...         break
    >>> steps.termination is None
    True
    """
    meant = case_of(case, changes)
    if meant._native.is_modal:
        hint = "`ligament.modal` finds them"
        raise LigamentError(f"the case asks for natural modes; {hint}", key="analysis", hint=hint)
    return Rows(_native.Rows(meant._native))
