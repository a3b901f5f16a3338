"""Natural modes as arrays."""

from __future__ import annotations

import functools
import json
import os
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ligament._errors import LigamentError
from ligament._home import Home
from ligament._stored import Floats, Stored, read_only, table

# What the columns of the table of modes begin with that have the participation.
PARTICIPATION = "participation_"


class Modes(Stored):
    """The results of a modal analysis in a folder: arrays over the modes, lowest first, and a shape over the points for each.

    The folder of ``ligament.modal`` without ``folder`` is removed with its modes: `save` keeps it.
    """

    def __init__(self, folder: str | os.PathLike[str], title: str | None = None, home: Home | None = None) -> None:
        super().__init__(folder, title, home)
        self._shapes: dict[tuple[int, str], Floats] = {}

    @functools.cached_property
    def columns(self) -> dict[str, Any]:
        """The table of the modes, `modes.csv`, as arrays by the names of its columns."""
        return self._run.table("modes.csv")

    @property
    def frequency(self) -> Floats:
        """Frequencies in Hz, 0 for rigid motions."""
        frequency: Floats = self.columns["frequency_hz"]
        return frequency

    @property
    def kind(self) -> list[str]:
        """Whether each mode is `rigid` or `elastic`."""
        return list(self.columns["kind"])

    @functools.cached_property
    def participation(self) -> Floats:
        """Participation of each mode in motions along x, along y and about the centre (n, 3); of a solid along and about x, y and z (n, 6)."""
        return read_only(np.stack([it for name, it in self.columns.items() if name.startswith(PARTICIPATION)], axis=1))

    @functools.cached_property
    def summary(self) -> dict[str, Any]:
        """The modes in numbers, as `summary.json` has them."""
        summary: dict[str, Any] = json.loads(self._run.summary() or "{}")
        return summary

    @property
    def mass(self) -> float:
        """Mass of the body, kg."""
        return float(self.summary["mass"])

    @property
    def warnings(self) -> list[str]:
        """What one should know of the modes."""
        return list(self.summary["warnings"])

    @functools.cached_property
    def position(self) -> Floats:
        """Positions of the points (n, 2) or (n, 3), m."""
        positions = self._run.positions("1")
        return positions if self._run.is_solid() else read_only(positions[:, :2].copy())

    def shape(self, mode: int, field: str = "displacement") -> NDArray[Any]:
        """The shape of a mode, counted from 0: displacements of the points (n, 3), or their ``rotation`` or ``strain_energy_density``."""
        if not -len(self) <= mode < len(self):
            hint = f"modes are counted from 0 to {len(self) - 1}"
            raise LigamentError(f"there is no mode {mode}; {hint}", hint=hint)
        at = mode % len(self) + 1
        if (at, field) not in self._shapes:
            self._shapes[at, field] = self._run.field(str(at), field)
        return self._shapes[at, field]

    @property
    def table(self) -> Any:
        """Number, kind, frequency and residual of each mode as a table."""
        columns = {"mode": np.arange(len(self)), "kind": self.kind}
        return table({**columns, "frequency": self.frequency, "residual": self.columns["residual"]})

    def __len__(self) -> int:
        return len(self.frequency)

    def __repr__(self) -> str:
        return f"<ligament.Modes {self.title!r}: {len(self)} modes>"
