"""Between which values the results of a case lie as its points become finer."""

from __future__ import annotations

import json
import os
import sys
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from ligament import _native
from ligament._case import Source, case_of
from ligament._home import Home
from ligament._result import Result
from ligament._stored import table


@dataclass(frozen=True)
class Interval:
    """The interval of convergence of a result, in its unit, or the reason why it has none.

    `at_h` and `at_2h` are the means of the runs at both sizes, and `deviation` is the standard deviation of runs of one size. `mesher` is the
    difference of the meshers at h and `families` the change with 4/3 of the horizon factor at the same horizon, both relative to `at_h`.
    """

    name: str
    label: str
    unit: str
    lower: float | None
    upper: float | None
    at_h: float | None
    at_2h: float | None
    deviation: float | None
    mesher: float | None
    families: float | None
    refused: str | None

    def __contains__(self, value: float) -> bool:
        return self.lower is not None and self.upper is not None and self.lower <= value <= self.upper


class Convergence(Mapping[str, Interval]):
    """Intervals by the names of the results, in the folder of the command ``ligament converge``, which has the same table and plots."""

    def __init__(self, folder: str | os.PathLike[str], home: Home | None = None) -> None:
        self.folder = Path(folder)
        self._home = home
        self._document: dict[str, Any] = json.loads((self.folder / "convergence.json").read_text(encoding="utf-8"))
        self._intervals = {result["name"]: _interval(result) for result in self._document["results"]}

    def __getitem__(self, name: str) -> Interval:
        return self._intervals[name]

    def __iter__(self) -> Any:
        return iter(self._intervals)

    def __len__(self) -> int:
        return len(self._intervals)

    @property
    def table(self) -> Any:
        """A row a result, with the columns of `Interval`."""
        columns = list(Interval.__dataclass_fields__)
        return table({column: [getattr(it, column) for it in self._intervals.values()] for column in columns})

    @property
    def results(self) -> dict[str, Result]:
        """The runs by their names, such as ``h Delaunay``."""
        return {run["label"]: Result(Path(run["folder"]), run["label"], self._home) for run in self._document["runs"]}


def _interval(result: dict[str, Any]) -> Interval:
    interval = result["interval"] or {}
    return Interval(
        result["name"],
        result["label"],
        result["unit"],
        interval.get("lower"),
        interval.get("upper"),
        interval.get("fine"),
        interval.get("coarse"),
        interval.get("deviation"),
        result["mesher"],
        result["families"],
        result["refused"],
    )


def converge(
    case: Source,
    /,
    *,
    of: Sequence[str] = (),
    folder: str | os.PathLike[str] | None = None,
    geometry: str | os.PathLike[str] | None = None,
    numbers: Mapping[str, float] | None = None,
    split: bool = False,
    families: bool = False,
    fixed_horizon: bool = False,
    jobs: int | None = None,
    gmsh: str | os.PathLike[str] = "gmsh",
    **changes: Any,
) -> Convergence:
    """Runs a case at h, the spacing of its points, and at 2h with two meshes each, and gives an interval for each result.

    `of` are names of results such as ``peak.reaction``, by default those that the runs have. The meshes come from the `geometry` of the
    mesh with its `numbers`, made by the program `gmsh`, or with `split` from the cells of the mesh. `families` also runs the finer bodies
    with 4/3 of the horizon factor, and `fixed_horizon` keeps the horizon of h. `jobs` runs go on at once.
    """
    meant = case_of(case, changes)
    home = None if folder is not None else Home()
    place = Path(folder) if folder is not None else home.path / "converge"  # type: ignore[union-attr]
    options = {
        "of": list(of),
        "geometry": None if geometry is None else os.fspath(geometry),
        "numbers": list((numbers or {}).items()),
        "split": split,
        "families": families,
        "fixed_horizon": fixed_horizon,
        "jobs": jobs,
        "gmsh": os.fspath(gmsh),
    }
    _native.compute_convergence(meant._native, place, options, [sys.executable, "-m", "ligament"])
    return Convergence(place, home)
