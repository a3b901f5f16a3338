"""How far a run is, for people."""

from __future__ import annotations

import sys
import time
from collections.abc import Callable
from typing import Any

Report = Callable[[int, float, float, float, int], object]

# Time between two words, s: a display that changes faster is not read and takes time.
BETWEEN = 0.1


def report_of(progress: bool | Report | None, in_time: bool = False) -> Report | None:
    """What is called for each record: what the caller gave, or words in a notebook or a terminal; `in_time` is that of a motion."""
    if callable(progress):
        return progress
    if progress is False:
        return None
    show = _in_notebook() or (_in_terminal() if progress or sys.stderr.isatty() else None)
    return None if show is None else _Words(show, in_time)


def _words(step: int, load_factor: float, broken_bonds: int, in_time: bool) -> str:
    at = f"row {step}, {load_factor:.4g} s" if in_time else f"step {step}, load factor {load_factor:.4g}"
    return f"{at}, {broken_bonds} bonds broken"


class _Words:
    """Shows words about the last record, not too often."""

    def __init__(self, show: Callable[[str], object], in_time: bool) -> None:
        self._show = show
        self._in_time = in_time
        self._last = 0.0

    def __call__(self, step: int, load_factor: float, displacement: float, reaction: float, broken_bonds: int) -> None:
        now = time.monotonic()
        if now - self._last >= BETWEEN:
            self._last = now
            self._show(_words(step, load_factor, broken_bonds, self._in_time))

    def close(self) -> None:
        """Takes the words away."""
        if self._last:
            self._show("")


def close(report: Report | None) -> None:
    """Ends a display, if it is one of this package."""
    if isinstance(report, _Words):
        report.close()


def _in_notebook() -> Callable[[str], object] | None:
    if "IPython" not in sys.modules:
        return None
    ipython: Any = sys.modules["IPython"]
    shell = ipython.get_ipython()
    if shell is None or not hasattr(shell, "kernel"):
        return None
    display: Any = sys.modules["IPython.display"]
    handle = display.display({"text/plain": ""}, raw=True, display_id=True)
    return lambda words: handle.update({"text/plain": words}, raw=True)


def _in_terminal() -> Callable[[str], object]:
    def show(words: str) -> None:
        sys.stderr.write(f"\r\x1b[K{words}")
        sys.stderr.flush()

    return show
