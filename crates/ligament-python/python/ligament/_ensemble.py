"""Many samples of a case whose strength or fracture energy varies at random."""

from __future__ import annotations

import csv
import os
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ligament import _native
from ligament._case import Source, case_of
from ligament._home import Home
from ligament._stored import Floats, read_only, table


@dataclass(frozen=True)
class Weibull:
    """Weibull's distribution fitted to loads, each with its bounds of 90 %."""

    modulus: float
    modulus_bounds: tuple[float, float]
    scale: float
    scale_bounds: tuple[float, float]
    samples: int


class Ensemble:
    """Samples of a case, in the folder of the command ``ligament ensemble``, which has the same tables, plots and fields."""

    def __init__(self, folder: str | os.PathLike[str], home: Home | None = None) -> None:
        self.folder = Path(folder)
        self._home = home
        self._samples = self._read("samples.csv")
        self._points = self._read("points.csv")

    def _read(self, name: str) -> Mapping[str, NDArray[Any]]:
        with (self.folder / name).open(encoding="utf-8", newline="") as file:
            head, *rows = csv.reader(file)
        return {column: read_only(_values([row[place] for row in rows])) for place, column in enumerate(head)}

    @property
    def samples(self) -> Any:
        """A row a sample: seed, load and place of its first breakage, largest load, first peak, why it ended."""
        return table(self._samples)

    @property
    def curves(self) -> Any:
        """Quantiles and mean of the load over the displacement, beside the body without random factors."""
        return table(self._read("curves.csv"))

    @property
    def seeds(self) -> NDArray[Any]:
        """Seed of each sample: ``ligament.run(case, fracture__scatter__seed=seed)`` is that sample, to the same bits.

        With two random properties it is the seed of the first, ``fracture__scatter__0__seed``."""
        return self._samples["seed"]

    @property
    def first(self) -> Floats:
        """Load at the first breakage of each sample; nan where no bond broke."""
        return self._samples["first_load"]

    @property
    def peak(self) -> Floats:
        """Largest load of each sample."""
        return self._samples["peak_load"]

    @property
    def positions(self) -> Floats:
        """Positions of the points in the order of the file, shape (n_points, 3), m."""
        return read_only(np.stack([self._points[axis] for axis in "xyz"], axis=1))

    @property
    def first_break(self) -> Floats:
        """Share of the samples in which a bond of each point is among the first to break, shape (n_points)."""
        return self._points["first_break_share"]

    @property
    def damaged(self) -> Floats:
        """Share of the samples in which a bond of each point is broken in the end, shape (n_points)."""
        return self._points["damaged_share"]

    @property
    def weibull(self) -> dict[str, Weibull]:
        """Weibull's distribution of the loads at the ``first`` breakage, the ``first_peak`` and the ``peak``, where they have one."""
        found = self._read("weibull.csv")
        rows = [{name: found[name][row] for name in found} for row in range(len(found["load"]))]
        return {
            str(it["load"]): Weibull(
                float(it["modulus"]),
                (float(it["modulus_low"]), float(it["modulus_high"])),
                float(it["scale"]),
                (float(it["scale_low"]), float(it["scale_high"])),
                int(it["samples"]),
            )
            for it in rows
            if it["modulus"] == it["modulus"]
        }

    def __len__(self) -> int:
        return len(self.seeds)


def _values(texts: list[str]) -> NDArray[Any]:
    """Texts as whole numbers, else as numbers with nan for none, else as they are."""
    for kind in (np.int64, np.float64):
        try:
            return np.array([text or "nan" for text in texts], dtype=kind)
        except ValueError:
            continue
    return np.array(texts)


def ensemble(
    case: Source,
    /,
    samples: int = 1000,
    seed: int = 0,
    *,
    folder: str | os.PathLike[str] | None = None,
    points: int = 101,
    **changes: Any,
) -> Ensemble:
    """Runs many samples of a case with a ``fracture.scatter``; sample k depends on `seed` and k alone.

    Samples are kept in `folder`, where only those that are missing are computed, or in a temporary one. Curves are compared at `points`
    displacements. Ctrl-C stops it; the same call with the same folder goes on.
    """
    meant = case_of(case, changes)
    home = None
    if folder is None:
        home = Home()
        folder = home.path / "ensemble"
    place = Path(folder)
    if _native.compute_ensemble(meant._native, (samples, seed, points), place):
        raise KeyboardInterrupt
    return Ensemble(place, home)
