"""Pictures of columns of histories over each other."""

from __future__ import annotations

import difflib
from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from ligament import _native
from ligament._errors import LigamentError
from ligament._picture import Picture

if TYPE_CHECKING:
    from ligament._result import Result

# Width of a picture alone, mm.
WIDTH = 140.0

# Energies of a motion or of a run in statics, in the order of their ledger.
ENERGIES = [
    "external_work", "kinetic_energy", "stored_energy", "released_energy", "damping_energy", "contact_energy", "friction_energy",
    "initial_energy", "dissipated_energy",
]

# Share of the largest energy below which none is seen beside it.
SEEN = 1e-3


def _columns(result: Result, name: str) -> list[str]:
    """The columns of the history that a name means."""
    if name in result.columns:
        return [name]
    if name == "energies":
        sizes = {it: float(np.abs(result.columns[it]).max()) for it in ENERGIES if it in result.columns}
        return [it for it, size in sizes.items() if size > SEEN * max(sizes.values())]
    if name == "probes" and result.probes:
        return list(result.probes)
    near = difflib.get_close_matches(name, result.columns, 1)
    hint = (f"did you mean `{near[0]}`? " if near else "") + f"columns: {', '.join(result.columns)}"
    raise LigamentError(f"the history has no column `{name}`; {hint}", hint=hint)


def curves(
    results: list[Result], labels: list[str], axes: tuple[str | None, str | Sequence[str]] = (None, "reaction"), width: float = WIDTH
) -> Picture:
    """A picture of columns of the histories of several results over another column, over the time of motions where none is said, else over the
    displacement."""
    first, units = results[0], results[0].units
    [x] = _columns(first, axes[0] or ("time" if first.is_motion else "displacement"))
    asked = [axes[1]] if isinstance(axes[1], str) else axes[1]
    names = [name for it in asked for name in _columns(first, it)]
    other = next((it for it in names if units[it] != units[names[0]]), None)
    if other:
        hint = "draw them separately"
        raise LigamentError(f"`{names[0]}` is in {units[names[0]]} and `{other}` in {units[other]}; {hint}", hint=hint)

    def words(name: str) -> str:
        return {"reaction": "force"}.get(name, name.replace("_", " "))

    drawn = []
    for result, label in zip(results, labels, strict=True):
        rests = np.asarray(result.columns["at_rest"], dtype=bool)
        for name in names:
            values = (np.asarray(result.columns[it], dtype=np.float64)[rests] for it in (x, name))
            parts = [label] * (len(names) == 1 or len(results) > 1) + [words(name)] * (len(names) > 1)
            drawn.append((", ".join(parts), *values))
    y = words(names[0]) if len(names) == 1 else {"J": "energy"}.get(units[names[0]], "value")
    return Picture(_native.draw_curves(drawn, (words(x), units[x]), (y, units[names[0]]), "", width), f"{y} over {words(x)}")
