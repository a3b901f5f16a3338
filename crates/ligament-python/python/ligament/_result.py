"""Results in memory: tables, arrays, pictures."""

from __future__ import annotations

import html
import importlib.util
import json
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ligament import _native
from ligament._errors import LigamentError
from ligament._picture import Picture

Floats = NDArray[np.float64]

# Widths of pictures, mm: alone, and two beside each other.
WIDTH = 140.0
HALF = 100.0


@dataclass(frozen=True)
class CrackLine:
    """A crack as a line: its places (n, 2) in m, what each end is (a tip, the outline, ...), and its length in m."""

    points: Floats
    ends: tuple[str, str]
    length: float


def table(columns: Mapping[str, Any]) -> Any:
    """Columns as a table of pandas or polars, whichever is installed, else as a dictionary of arrays."""
    if importlib.util.find_spec("pandas"):
        import pandas

        return pandas.DataFrame(dict(columns), copy=False)
    if importlib.util.find_spec("polars"):
        import polars

        return polars.DataFrame(dict(columns))
    return dict(columns)


class Result:
    """What a run gave: history, points, bonds and fields as arrays, pictures and cracks.

    Arrays are those that the run filled, and none is copied on its way here; those of a result belong to it.
    """

    def __init__(self, run: _native.Run, title: str) -> None:
        self._run = run
        self._summary: dict[str, Any] = json.loads(run.summary)
        self.title = title

    @property
    def columns(self) -> dict[str, Any]:
        """The history as arrays by the names of their columns: a row a load step, or an event of the exact path."""
        return self._run.history

    @property
    def history(self) -> Any:
        """The history as a table of pandas or polars, whichever is installed, else as a dictionary of arrays."""
        return table(self._run.history)

    @property
    def breaks(self) -> Any:
        """The bonds that broke, in their order, as a table like the history."""
        return table(self._run.breaks)

    @property
    def points(self) -> dict[str, NDArray[Any]]:
        """Arrays over the points that never change: position (n, 2) or (n, 3), volume, horizon and others."""
        return self._run.points

    @property
    def is_solid(self) -> bool:
        """Whether the body is a solid."""
        return bool(self._run.points["position"].shape[1] == 3)

    @property
    def bonds(self) -> dict[str, NDArray[Any]]:
        """Arrays over the bonds: ends (n, 2), length, horizon, whether each is intact at the end, and the step in which it broke."""
        return self._run.bonds

    @property
    def summary(self) -> dict[str, Any]:
        """The run in numbers, as `summary.json` has them."""
        return self._summary

    @property
    def warnings(self) -> list[str]:
        """What one should know of the run."""
        return list(self._summary["warnings"])

    @property
    def termination(self) -> str:
        """Why the run ended, as a short name; `summary["termination_message"]` says it in words."""
        return str(self._summary["termination"])

    @property
    def steps(self) -> list[int]:
        """Steps of which there are fields."""
        return list(self._run.fields)

    @property
    def field_names(self) -> list[str]:
        """Names of the fields of the points."""
        return list(self._run.fields[self.steps[-1]])

    def number(self, name: str) -> float:
        """A number of the summary by its dotted name, such as ``first_peak.reaction``."""
        return _native.numbers(self._run.summary, name)[name]

    def field(self, name: str, step: int | None = None) -> NDArray[Any]:
        """The values of a field over the points in a step, the last one where none is said; the same array each time.

        ``stress`` is the stress of each point (``output__stress=["material"]``), without a value where its bonds do not span the space.
        ``stress_virial`` at single points of an irregular mesh is off by a tenth to a quarter inside the body and by a third and more
        at its edges; its mean over many points is right.
        """
        of_step = self._run.fields[self._with_fields(step)]
        if name not in of_step:
            raise LigamentError(f"there is no field `{name}`; fields: {', '.join(of_step)}", hint=f"fields: {', '.join(of_step)}")
        return of_step[name]

    def _with_fields(self, step: int | None) -> int:
        if step is None:
            return self.steps[-1]
        if step not in self._run.fields:
            listed = ", ".join(map(str, self.steps))
            hint = "`output__fields_every=1` keeps those of every step"
            raise LigamentError(f"there are no fields of step {step}, but of {listed}; {hint}", hint=hint)
        return step

    def crack_path(self, step: int | None = None) -> list[CrackLine]:
        """The cracks in a step as lines, the last step where none is said."""
        last = int(self._run.history["step"][-1])
        lines = self._run.cracks(last if step is None else step)
        return [CrackLine(points, (ends[0], ends[1]), length) for points, ends, length in lines]

    def plot(self, field: str | None = None, step: int | None = None, *, width: float = WIDTH) -> Picture:
        """A picture of a field on the deformed body; of a vector its length, or ``displacement_x`` and ``stress.xx`` for components.

        Without a field the damage, of bonds that soften by the way in which they fail, or the displacement where no bond failed. The
        width is in mm.
        """
        step = self._with_fields(step)
        if field is None:
            field = self._run.first_field
        values, name = self._scalar(field, step)
        if not np.any(np.isfinite(values)):
            raise LigamentError(f"the field `{field}` has no value in step {step}")
        words = field.replace("_", " ")
        drawing = self._run.draw(
            (words, name, f"step {step}"),
            np.ascontiguousarray(values, dtype=np.float64),
            self.field("displacement", step),
            width,
        )
        return Picture(drawing, f"{words} in step {step}")

    def _scalar(self, field: str, step: int) -> tuple[NDArray[Any], str]:
        """Values of a field or of a component of one, and the name of the field."""
        stem, _, component = field.rpartition("_")
        if field not in self._run.fields[step] and component in ("x", "y", "z") and stem in self._run.fields[step]:
            return self.field(stem, step)[:, "xyz".index(component)], stem
        stem, _, component = field.rpartition(".")
        names = _native.component_names(stem, self.is_solid)
        if component in names and stem in self._run.fields[step]:
            return self.field(stem, step)[:, names.index(component)], stem
        values = self.field(field, step)
        return (np.linalg.norm(values, axis=1), field) if values.ndim == 2 else (values, field)

    def curve(self, *, width: float = WIDTH) -> Picture:
        """A picture of force over displacement of the control load; the width is in mm."""
        return curves([self], [""], width)

    def to_pyvista(self, step: int | None = None) -> Any:
        """The body in a step as a grid of PyVista, with all fields; it shares the memory of the result."""
        import pyvista

        of_step = self._run.fields[self._with_fields(step)]
        cells = self._run.cells
        if "corners" in cells:
            corners = cells["corners"]
            of_one, kind = (8, pyvista.CellType.HEXAHEDRON) if self.is_solid else (4, pyvista.CellType.QUAD)
            n = len(corners) // of_one
            grid = pyvista.UnstructuredGrid({kind: np.arange(of_one * n).reshape(n, of_one)}, _in_space(corners))
            data = grid.cell_data
            grid.point_data["displacement"] = np.repeat(of_step["displacement"], of_one, axis=0)
        else:
            types = {
                "triangles": pyvista.CellType.TRIANGLE, "quadrangles": pyvista.CellType.QUAD, "tetrahedra": pyvista.CellType.TETRA,
                "pyramids": pyvista.CellType.PYRAMID, "prisms": pyvista.CellType.WEDGE, "hexahedra": pyvista.CellType.HEXAHEDRON,
            }
            filled = {types[name]: corners for name, corners in cells.items() if len(corners)}
            grid = pyvista.UnstructuredGrid(filled, _in_space(self.points["position"]))
            data = grid.point_data
        for name, values in of_step.items():
            data[name] = values
        return grid

    def __repr__(self) -> str:
        summary = self._summary
        return f"<ligament.Result {self.title!r}: {summary['broken_bonds']} bonds broken, {self.termination}>"

    def _repr_html_(self) -> str:
        rows = "".join(f"<tr><td>{html.escape(name)}</td><td>{html.escape(value)}</td></tr>" for name, value in self._told())
        pictures = [] if self.is_solid else [self.plot(width=HALF).to_html()]
        if len(self.columns["step"]) > 2:
            pictures.insert(0, self.curve(width=HALF).to_html())
        return f"<div><b>{html.escape(self.title)}</b><table>{rows}</table>{''.join(pictures)}</div>"

    def _told(self) -> list[tuple[str, str]]:
        summary = self._summary
        units = summary["units"]
        told = [("points, bonds", f"{summary['points']}, {summary['bonds']}")]
        for name, words in (("first_peak", "first peak"), ("peak", "largest load")):
            point = summary.get(name)
            if point:
                force, along = units["force"], units["displacement"]
                told.append((words, f"{point['reaction']:.4g} {force} at {point['displacement']:.4g} {along}"))
        told.append(("broken bonds", str(summary["broken_bonds"])))
        told.append(("ended because", summary["termination_message"]))
        return told + [("warning", words) for words in self.warnings]


def _in_space(positions: NDArray[Any]) -> Floats:
    return positions if positions.shape[1] == 3 else np.column_stack([positions, np.zeros(len(positions))])


def curves(results: list[Result], labels: list[str], width: float = WIDTH) -> Picture:
    """A picture of force over displacement of several results."""
    drawn = []
    for result, label in zip(results, labels, strict=True):
        columns = result.columns
        rests = np.asarray(columns["at_rest"], dtype=bool)
        drawn.append((label, columns["displacement"][rests], columns["reaction"][rests]))
    units = results[0].summary["units"]
    axes = ("displacement", units["displacement"]), ("force", units["force"])
    return Picture(_native.draw_curves(drawn, *axes, "", width), "force over displacement")


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
