"""The compiled part of the package."""

from collections.abc import Callable, Mapping, Sequence
from os import PathLike
from typing import Any

import numpy as np
from numpy.typing import NDArray

VERSION: str

Floats = NDArray[np.float64]
Column = NDArray[Any] | list[str]

class Body:
    @staticmethod
    def of_points(positions: Floats, sizes: Floats, groups: Sequence[tuple[str, Sequence[int]]]) -> Body: ...
    @staticmethod
    def of_mesh(
        tags: NDArray[np.uint64],
        positions: Floats,
        elements: Sequence[tuple[int, NDArray[np.uint64], str | None]],
    ) -> Body: ...
    @property
    def n_points(self) -> int: ...
    @property
    def groups(self) -> list[str]: ...
    @property
    def is_solid(self) -> bool: ...

class Case:
    @staticmethod
    def load(path: str | PathLike[str], changes: Mapping[str, Any]) -> Case: ...
    @staticmethod
    def parse(text: str, path: str | PathLike[str], changes: Mapping[str, Any]) -> Case: ...
    @staticmethod
    def of_sections(
        sections: Mapping[str, Any], path: str | PathLike[str], changes: Mapping[str, Any], body: Body | None
    ) -> Case: ...
    def changed(self, changes: Mapping[str, Any]) -> Case: ...
    @property
    def title(self) -> str: ...
    @property
    def name(self) -> str: ...
    @property
    def is_modal(self) -> bool: ...
    def number(self, key: str) -> float | None: ...
    def to_toml(self) -> str: ...

class Run:
    history: dict[str, Column]
    breaks: dict[str, Column]
    points: dict[str, NDArray[Any]]
    bonds: dict[str, NDArray[Any]]
    fields: dict[int, dict[str, NDArray[Any]]]
    cells: dict[str, NDArray[Any]]
    summary: str
    tagged: str
    def cracks(self, step: int) -> list[tuple[Floats, list[str], float]]: ...
    def draw(
        self, named: tuple[str, str, str], values: Floats, displacement: Floats, width: float
    ) -> Drawing: ...

class Drawing:
    def __init__(self, text: str) -> None: ...
    def svg(self, title: str) -> str: ...
    def png(self, dpi: float) -> bytes: ...
    def pdf(self, title: str) -> bytes: ...

def run(case: Case, report: Callable[[int, float, float, float, int], object] | None) -> tuple[Run, bool]: ...
def modes(case: Case) -> dict[str, Any]: ...
def draw_curves(
    curves: Sequence[tuple[str, Floats, Floats]],
    x: tuple[str, str],
    y: tuple[str, str],
    title: str,
    width: float,
) -> Drawing: ...
def next_trial(
    trials: Sequence[tuple[float, float]],
    start: float,
    limits: tuple[float | None, float | None],
    aim: tuple[float, float],
    most_trials: int,
) -> tuple[str, float | None]: ...
def numbers(summary: str, name: str | None) -> dict[str, float]: ...
def execute(arguments: Sequence[str], itself: Sequence[str]) -> int: ...
