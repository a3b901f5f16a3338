"""Loads and temperatures as functions of the position, which become tables that a case reads."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ligament._errors import CaseError

Function = Callable[..., Any]

# Where a function may stand, in each entry of a list: the section, the key, the column of its table.
PLACES = (("temperature", "change", "change"), ("load", "profile", "factor"))


def taken_out(sections: Mapping[str, Any]) -> tuple[dict[str, Any], list[tuple[str, int, Function]]]:
    """Sections without their functions, and these with the section and the index of the entry that each was in."""
    plain = dict(sections)
    functions: list[tuple[str, int, Function]] = []
    for section, key, _ in PLACES:
        entries = sections.get(section)
        if not isinstance(entries, list | tuple):
            continue
        plain[section] = list(entries)
        for index, entry in enumerate(entries):
            if isinstance(entry, Mapping) and callable(entry.get(key)):
                functions.append((section, index, entry[key]))
                # A temperature without a change is none; any number will do until its table is there.
                plain[section][index] = {**entry, key: 0.0 if key == "change" else None}
    return plain, functions


def with_table(entry: Mapping[str, Any], section: str, file: str) -> dict[str, Any]:
    """An entry that reads a table where its function stood."""
    if section == "temperature":
        return {**entry, "change": None, "file": file}
    return {**entry, "profile": {"file": file}}


def column(section: str) -> str:
    """Name of the column of values in the table of a section."""
    return next(column for name, _, column in PLACES if name == section)


def values(function: Function, positions: NDArray[Any], key: str) -> NDArray[np.float64]:
    """The values of a function at positions (n, 2) or (n, 3); one that takes no arrays is called for each position."""
    axes = positions.T
    try:
        found = np.broadcast_to(np.asarray(function(*axes), dtype=np.float64), len(positions))
    except (TypeError, ValueError):
        found = np.array([float(function(*map(float, at))) for at in positions])
    if not np.all(np.isfinite(found)):
        at = tuple(float(it) for it in positions[int(np.flatnonzero(~np.isfinite(found))[0])])
        raise CaseError(f"{key}: the function has no finite value at {at}", key=key, hint="give a value for every point of the body")
    return np.ascontiguousarray(found)
