"""Natural modes as arrays."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from ligament._result import Floats, table


class Modes:
    """Natural modes: arrays over the modes, lowest first, and a shape over the points for each."""

    def __init__(self, found: Mapping[str, Any], title: str) -> None:
        self._found = found
        self.title = title

    @property
    def frequency(self) -> Floats:
        """Frequencies in Hz, 0 for rigid motions."""
        frequency: Floats = self._found["frequency"]
        return frequency

    @property
    def kind(self) -> list[str]:
        """Whether each mode is `rigid` or `elastic`."""
        return list(self._found["kind"])

    @property
    def participation(self) -> Floats:
        """Participation of each mode in motions along x, along y and about the centre (n, 3); of a solid along and about x, y and z (n, 6)."""
        participation: Floats = self._found["participation"]
        return participation

    @property
    def mass(self) -> float:
        """Mass of the body, kg."""
        return float(self._found["mass"])

    @property
    def warnings(self) -> list[str]:
        """What one should know of the modes."""
        return list(self._found["warnings"])

    @property
    def position(self) -> Floats:
        """Positions of the points (n, 2) or (n, 3), m."""
        position: Floats = self._found["position"]
        return position

    def shape(self, mode: int) -> Floats:
        """Displacements of the points (n, 3) in a mode, counted from 0."""
        shape: Floats = self._found["shapes"][mode]["displacement"]
        return shape

    @property
    def table(self) -> Any:
        """Number, kind, frequency and residual of each mode as a table."""
        n = len(self.frequency)
        columns = {"mode": np.arange(n), "kind": self.kind}
        return table({**columns, "frequency": self.frequency, "residual": self._found["residual"]})

    def __len__(self) -> int:
        return len(self.frequency)

    def __repr__(self) -> str:
        return f"<ligament.Modes {self.title!r}: {len(self)} modes>"
