"""Runs, alone and many of them."""

from __future__ import annotations

import itertools
import os
from collections.abc import Callable, Iterable, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from ligament import _native, _progress
from ligament._case import Case, Source, case_of
from ligament._curves import curves
from ligament._errors import Interrupted, LigamentError, NotCalibrated
from ligament._home import Home
from ligament._modes import Modes
from ligament._picture import Picture
from ligament._progress import Report
from ligament._result import Result
from ligament._stored import table


def run(
    case: Source,
    /,
    *,
    folder: str | os.PathLike[str] | None = None,
    replace: bool = False,
    progress: bool | Report | None = None,
    **changes: Any,
) -> Result:
    """Runs a case: a `Case` or `Setup`, a dictionary of sections, the path of a case file or its text.

    The results are written into `folder`, or into a temporary one that is removed with the result; `replace` takes the place of earlier
    results there.

    Changes are keys with two underscores for a dot: ``run("case.toml", model__horizon_factor=4)``. `progress` shows how far the run
    is, by default in a notebook or a terminal; a function is called after each step with its number, load factor (the time of a motion, s), displacement, force and
    the number of broken bonds. Other threads go on meanwhile, and Ctrl-C ends the run at the end of its step by `Interrupted`, which has the
    result so far.
    """
    return _run(case_of(case, changes), progress, folder, replace)


def _run(
    case: Case, progress: bool | Report | None, folder: str | os.PathLike[str] | None = None, replace: bool = False
) -> Result:
    if case._native.is_modal:
        raise LigamentError("the case asks for natural modes; `ligament.modal` finds them", hint="`ligament.modal` finds them")
    place, home = _place(folder)
    report = _progress.report_of(progress, case._native.is_motion)
    try:
        stopped = _native.run(case._native, place, replace, report)
    finally:
        _progress.close(report)
    result = Result(place, case.title or case.name, home)
    if stopped:
        raise Interrupted(result)
    return result


def modal(
    case: Source, /, *, folder: str | os.PathLike[str] | None = None, replace: bool = False, **changes: Any
) -> Modes:
    """Finds the natural modes of a case with ``analysis = "modal"``; they are written into `folder` as the results of `run` are."""
    meant = case_of(case, changes)
    if not meant._native.is_modal:
        hint = "`analysis=\"modal\"` asks for them, and `ligament.run` runs the case under its loads"
        raise LigamentError(f"the case does not ask for natural modes; {hint}", key="analysis", hint=hint)
    place, home = _place(folder)
    if _native.run(meant._native, place, replace, None):
        raise KeyboardInterrupt
    return Modes(place, meant.title or meant.name, home)


def _place(folder: str | os.PathLike[str] | None) -> tuple[Path, Home | None]:
    """The folder for results, where none is given a temporary one."""
    if folder is not None:
        return Path(folder), None
    home = Home()
    return home.path, home


@dataclass(frozen=True)
class Sweep:
    """Runs of a case over all combinations of some settings, in the order of the axes, the last of them fastest."""

    axes: dict[str, list[Any]]
    settings: list[dict[str, Any]]
    results: list[Result]

    @property
    def table(self) -> Any:
        """A row a run: its settings and all numbers of its summary."""
        numbers = [_native.numbers(result._summary_text, None) for result in self.results]
        names = list(dict.fromkeys(name for of_run in numbers for name in of_run))
        columns: dict[str, Any] = {key: [setting[key] for setting in self.settings] for key in self.axes}
        columns.update({name: [of_run.get(name) for of_run in numbers] for name in names})
        return table(columns)

    def numbers(self, name: str) -> list[float]:
        """A number of each run by its dotted name, such as ``first_peak.reaction``."""
        return [result.number(name) for result in self.results]

    def curves(self) -> Picture:
        """A picture of force over displacement of all runs."""
        labels = [", ".join(f"{key.rpartition('.')[2]} {value}" for key, value in setting.items()) for setting in self.settings]
        return curves(self.results, labels)

    def __len__(self) -> int:
        return len(self.results)


def sweep(
    case: Source,
    axes: Mapping[str, Iterable[Any]],
    /,
    *,
    jobs: int = 1,
    progress: Callable[[int, int], object] | None = None,
    **changes: Any,
) -> Sweep:
    """Runs a case over all combinations of the values of some keys: ``sweep(case, {"model.horizon_factor": [2, 3, 4]})``.

    `jobs` runs go on at once, each on all processors or so many threads as ``solver.threads`` says. A function for `progress` is called
    with the number of runs done and of all. Large studies that are to survive a crash are for the command ``ligament sweep``.
    """
    base = case_of(case, changes)
    listed = {key.replace("__", "."): list(values) for key, values in axes.items()}
    settings = [dict(zip(listed, values, strict=True)) for values in itertools.product(*listed.values())]
    # A fault of any setting comes before the first run.
    cases = [base.with_changes(**setting) for setting in settings]
    results: list[Result] = []
    for done, result in enumerate(_all(cases, jobs), start=1):
        results.append(result)
        if progress is not None:
            progress(done, len(cases))
    return Sweep(listed, settings, results)


def _all(cases: Sequence[Case], jobs: int) -> Iterable[Result]:
    if jobs == 1:
        yield from (_run(case, False) for case in cases)
        return
    with ThreadPoolExecutor(jobs) as pool:
        yield from pool.map(lambda case: _run(case, False), cases)


@dataclass(frozen=True)
class Calibration:
    """The value of a key with which a result meets its target, and what was tried on the way: pairs of a value and its result."""

    key: str
    value: float
    of: str
    trials: list[tuple[float, float]]
    result: Result


def calibrate(
    case: Source,
    key: str,
    target: float,
    /,
    *,
    of: str = "first_peak.reaction",
    within: float = 0.01,
    limits: tuple[float | None, float | None] = (None, None),
    most_runs: int = 30,
    **changes: Any,
) -> Calibration:
    """Finds the value of a key, such as ``material.tensile_strength``, with which a number of the summary meets a target.

    The search is that of the command ``ligament calibrate``: `within` is the largest difference from the target, relative to it, and
    `limits` are the smallest and the largest value that may be tried.
    """
    base = case_of(case, changes)
    start = base.number(key) or (sum(limits) / 2 if None not in limits else None)  # type: ignore[arg-type]
    if not start:
        hint = f"give `{key}` a value, or `limits`"
        raise LigamentError(f"the case has no number other than 0 at `{key}` to begin with; {hint}", key=key, hint=hint)
    trials: list[tuple[float, float]] = []
    results: dict[float, Result] = {}
    while True:
        verdict, value = _native.next_trial(trials, start, limits, (target, within), most_runs)
        if verdict != "try" or value is None:
            break
        results[value] = _run(base.with_changes(**{key: value}), False)
        trials.append((value, results[value].number(of)))
    if verdict == "met" and value is not None:
        return Calibration(key, value, of, trials, results[value])
    tried = ", ".join(f"{result:.6g} at {value:.6g}" for value, result in trials)
    raise NotCalibrated(f"no value of `{key}` gives {of} = {target:g} ({verdict}): {tried}", key=key)
