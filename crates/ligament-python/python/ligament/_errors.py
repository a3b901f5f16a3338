"""Exceptions of the package."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from ligament._result import Result


class LigamentError(Exception):
    """Something that keeps Ligament from doing what it is asked.

    ``key`` is the key of the case that is at fault, such as ``"load.0.group"``, ``path``, ``line`` and ``column`` say where it
    stands in a file, and ``hint`` says what to do about it. Each is ``None`` where it is not known.
    """

    key: str | None
    path: str | None
    line: int | None
    column: int | None
    hint: str | None

    def __init__(
        self,
        message: str,
        *,
        key: str | None = None,
        path: str | None = None,
        line: int | None = None,
        column: int | None = None,
        hint: str | None = None,
    ) -> None:
        super().__init__(message)
        self.key = key
        self.path = path
        self.line = line
        self.column = column
        self.hint = hint


class CaseError(LigamentError, ValueError):
    """A key or a value of a case is wrong."""


class BodyError(LigamentError, ValueError):
    """Arrays or a mesh that are no body."""


class SolutionError(LigamentError, RuntimeError):
    """A computation that cannot begin or go on; how one ended that could is in its result."""


class NotCalibrated(LigamentError, RuntimeError):
    """No value of the key was found with which the result meets its target."""


class Interrupted(KeyboardInterrupt):
    """A run that Ctrl-C stopped; ``result`` is what it had found by then."""

    result: Result

    def __init__(self, result: Result) -> None:
        super().__init__("the run was stopped; `result` of this exception holds what it had found")
        self.result = result
