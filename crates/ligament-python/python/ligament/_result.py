"""Results of runs: tables, arrays, pictures, cracks."""

from __future__ import annotations

import difflib
import functools
import html
import json
import os
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal, NewType, overload

import numpy as np
from numpy.typing import NDArray

from ligament import _native
from ligament._curves import WIDTH, curves
from ligament._errors import LigamentError
from ligament._home import Home
from ligament._modes import Modes
from ligament._picture import Picture
from ligament._stored import Floats, Stored, read_only, table

# A state with fields by its name, as `states` has them: "45" is the end of step 45, "45:120" the step after 120 breakages.
State = NewType("State", str)

# A step by its number, from the end (-1 is the last state), by what happened in it, the first breakage or softening or the largest load, or a state.
# In a motion a step is a row of the history, and a time in s means the nearest one.
Step = int | Literal["first", "peak", "last"] | State

# Width of one of two pictures beside each other, mm.
HALF = 100.0

# Components by which vectors and their norm are named.
VECTOR = ["x", "y", "z"]
NORM = "magnitude"


@dataclass(frozen=True)
class CrackLine:
    """A crack as a line: its places (n, 2) in m, what each end is (a tip, the outline, ...), and its length in m."""

    points: Floats
    ends: tuple[str, str]
    length: float


@dataclass(frozen=True)
class CrackOpening:
    """How far a straight crack opens along a line.

    At the distances `along` (n) from its start `opening` and `sliding` (n) are the displacement of its left side less that of its right one,
    along the normal to the left and along the line, all in m; not a number where a side has too few points.
    """

    along: Floats
    opening: Floats
    sliding: Floats


@dataclass(frozen=True)
class CrackSurface:
    """The crack of a solid as triangles.

    `places` (n, 3) in m are in the body without load, `triangles` (m, 3) are indices of places. At the places `opening` and `sliding` (n)
    in m are the jumps of the displacement along the normal and in the surface. Of the triangles `part` (m) numbers what is connected, the
    largest from 1, and `is_precrack` (m) tells pre-cracks. `area` in m² is that without pre-cracks.
    """

    places: Floats
    triangles: NDArray[np.int64]
    opening: Floats
    sliding: Floats
    part: NDArray[np.int64]
    is_precrack: NDArray[np.bool_]
    area: float


class Text(str):
    """A text that notebooks and consoles show as it is, without quotes."""

    def __repr__(self) -> str:
        return str(self)


class Result(Stored):
    """The results of a run in a folder: history, points, bonds and fields as arrays, pictures, cracks, explanations.

    The folder is that of the command line, so that its commands take it too. Arrays are read when they are asked for, and then kept; they
    are read only. The folder of ``ligament.run`` without ``folder`` is removed with its result: `save` keeps it.
    """

    def __init__(self, folder: str | os.PathLike[str], title: str | None = None, home: Home | None = None) -> None:
        super().__init__(folder, title, home)
        self._fields: dict[tuple[str, str], NDArray[Any]] = {}
        self._infos: dict[str, dict[str, tuple[list[str], bool, str]]] = {}

    @functools.cached_property
    def columns(self) -> dict[str, Any]:
        """The history as arrays by the names of their columns: a row a load step, or an event of the exact path."""
        return self._run.table("history.csv")

    @functools.cached_property
    def units(self) -> dict[str, str]:
        """SI units of the columns of the history; `-` for counts, numbers without a unit, and where it is not known."""
        return self._run.units()

    @property
    def history(self) -> Any:
        """The history as a table of pandas, with ``attrs["units"]``, or of polars, whichever is installed, else as a dictionary."""
        return table(self.columns, self.units)

    @property
    def is_motion(self) -> bool:
        """Whether the run is a motion in time, whose history has the column `time` in s."""
        return {"time", "time_steps"} <= self.columns.keys()

    @property
    def duration(self) -> float | None:
        """The time that a motion reached, s; `None` in statics."""
        return float(self.columns["time"][-1]) if self.is_motion else None

    @property
    def times(self) -> Floats | None:
        """The times of `steps` in a motion, s; `None` in statics."""
        return np.asarray(self.columns["time"])[self._rows] if self.is_motion else None

    @functools.cached_property
    def probes(self) -> dict[str, Any]:
        """The probes over the rows of the history, as arrays by their names; `units` has their units."""
        return {name: self.columns[name] for name in self._run.probes() if name in self.columns}

    @functools.cached_property
    def _breaks(self) -> dict[str, Any]:
        return self._run.table("breaks.csv")

    @property
    def breaks(self) -> Any:
        """The bonds that broke, in their order, as a table like the history."""
        return table(self._breaks)

    @functools.cached_property
    def points(self) -> dict[str, NDArray[Any]]:
        """Arrays over the points that never change: position (n, 2) or (n, 3), volume, horizon and others."""
        first = self.states[0]
        fixed = [name for name, (_, stays, _) in self._info(first).items() if stays]
        position = self._positions if self.is_solid else read_only(self._positions[:, :2].copy())
        return {"position": position, **{name: self._whole(name, first) for name in fixed}}

    @functools.cached_property
    def _model(self) -> tuple[Floats, dict[str, NDArray[Any]]] | None:
        return self._run.bonds()

    @property
    def _positions(self) -> Floats:
        return self._model[0] if self._model else self._run.positions(self.states[0])

    @functools.cached_property
    def is_solid(self) -> bool:
        """Whether the body is a solid."""
        return self._run.is_solid()

    @functools.cached_property
    def bonds(self) -> dict[str, NDArray[Any]]:
        """Arrays over the bonds: ends (n, 2), length, horizon and weight (with seven digits), whether each is intact at the end, the step in
        which it broke, and the energy in J that it dissipated."""
        if self._model is None:
            hint = "`output__model=True` keeps them"
            raise LigamentError(f"the run wrote no bonds; {hint}", hint=hint)
        positions, bonds = self._model
        ends = bonds["ends"]
        length = np.linalg.norm(positions[ends[:, 1]] - positions[ends[:, 0]], axis=1)
        taken = {} if "dissipated_energy" in bonds or not self.is_finished else {"dissipated_energy": read_only(np.zeros(len(ends)))}
        return {**bonds, "length": read_only(length), **taken}

    @functools.cached_property
    def _summary_text(self) -> str:
        summary = self._run.summary()
        if summary is None:
            hint = "`ligament resume` goes on with a run that was killed; `ligament.open` it again when a run is over"
            raise LigamentError(f"{self.folder}: the run has not come to its end, and has no summary; {hint}", hint=hint)
        return summary

    @functools.cached_property
    def summary(self) -> dict[str, Any]:
        """The run in numbers, as `summary.json` has them; there is none before the run has ended."""
        summary: dict[str, Any] = json.loads(self._summary_text)
        return summary

    @property
    def is_finished(self) -> bool:
        """Whether the run had ended, or was stopped, when it was asked first."""
        return "summary" in self.__dict__ or self._run.summary() is not None

    @property
    def warnings(self) -> list[str]:
        """What one should know of the run."""
        return list(self.summary["warnings"])

    @property
    def termination(self) -> str:
        """Why the run ended, as a short name; `summary["termination_message"]` says it in words. `unfinished` before the end."""
        return str(self.summary["termination"]) if self.is_finished else "unfinished"

    @functools.cached_property
    def steps(self) -> list[int]:
        """Steps of which there are fields."""
        return self._run.steps()

    @functools.cached_property
    def states(self) -> list[State]:
        """All states of which there are fields, in their order, as `step` takes them: ``"45"`` is the end of step 45, and ``"45:120"`` the step
        after 120 breakages (``output__during_breakage``)."""
        return [State(name) for name in self._run.states()]

    @property
    def _rows(self) -> list[int]:
        """The rows of the history of the steps of which there are fields."""
        return [int(np.flatnonzero(self.columns["step"] == step)[0]) for step in self.steps]

    @property
    def field_names(self) -> list[str]:
        """Names of the fields of the points that change with the steps."""
        return [name for name, (_, stays, _) in self._info(self.states[-1]).items() if not stays]

    def number(self, name: str) -> float:
        """A number of the summary by its dotted name, such as ``first_peak.reaction``."""
        return _native.numbers(self._summary_text, name)[name]

    def field(self, name: str, step: Step | None = None, *, time: float | None = None) -> NDArray[Any]:
        """The values of a field over the points, or of a component of it, in a step, the last one where none is said.

        Of a motion also at a `time` in s: in the step with fields that is nearest to it.

        Components are named as on the command line: ``displacement.y``, ``displacement.magnitude``, ``stress.xx``. A step is a number, -1
        for the last, or ``"first"`` (breakage or softening), ``"peak"`` or ``"last"``; where fields of a named step were not kept, those of
        the next one are taken; or one of `states`. The same array is returned each time.

        ``stress`` is the stress that the material of each point carries (``output__stress=["material"]``). ``stress_effective``
        (``"effective"``) is that of sound material at the strain of the bonds left, without a value where these do not span the space.
        ``stress_virial`` at single points of an irregular mesh is off by a tenth to a quarter inside the body and by a third and more
        at its edges; its mean over many points is right.
        """
        at = self._state(step, time)
        base, part = self._named(name, at)
        values = self._whole(base, at)
        if part is None:
            return values
        if part == NORM:
            return self._fields.setdefault((at, name), read_only(np.linalg.norm(values, axis=1)))
        return values[:, self._info(at)[base][0].index(part)]

    def _state(self, step: Step | None, time: float | None = None) -> str:
        """The state with fields that is meant."""
        return self._run.state(_meant(step, time), True)

    def _info(self, state: str) -> dict[str, tuple[list[str], bool, str]]:
        if state not in self._infos:
            self._infos[state] = self._run.fields(state)
        return self._infos[state]

    def _whole(self, name: str, state: str) -> NDArray[Any]:
        if (state, name) not in self._fields:
            self._fields[state, name] = self._run.field(state, name)
        return self._fields[state, name]

    def _named(self, name: str, state: str) -> tuple[str, str | None]:
        """The field and the component, if any, that a name means."""
        fields = self._info(state)
        if name in fields:
            return name, None
        parts = {base: components + [NORM] * (components == VECTOR) for base, (components, _, _) in fields.items()}
        base, _, part = name.rpartition(".")
        if part in parts.get(base, ()):
            return base, part
        known = [*fields, *(f"{base}.{part}" for base, all_parts in parts.items() for part in all_parts)]
        near = difflib.get_close_matches(name.replace("_", "."), [it.replace("_", ".") for it in known], 1, 0.7)
        meant = [it for it in known if near and it.replace("_", ".") == near[0]]
        below = [it for it in known if base and it.startswith(f"{base}.")]
        hint = (f"did you mean `{meant[0]}`? " if meant else "") + f"fields: {', '.join(below or fields)}"
        raise LigamentError(f"there is no field `{name}`; {hint}", hint=hint)

    def crack_path(self, step: Step | None = None, *, time: float | None = None) -> list[CrackLine]:
        """The cracks of a body in the plane in a step, or at a time of a motion, as lines, the last step where none is said."""
        if self.is_solid:
            hint = "`crack_surface` has its crack as triangles"
            raise LigamentError(f"lines of cracks are those of a body in the plane, and this one is a solid; {hint}", hint=hint)
        lines = self._run.cracks(self._run.state(_meant(step, time), False))
        return [CrackLine(points, (ends[0], ends[1]), length) for points, ends, length in lines]

    def crack_opening(
        self,
        start: tuple[float, float],
        end: tuple[float, float],
        step: Step | None = None,
        *,
        time: float | None = None,
        samples: int = 101,
    ) -> CrackOpening:
        """How far a straight crack of a body in the plane opens along a line between two places in m, in a step with fields.

        The displacement of a side is that of its points within a horizon of the place.
        """
        if samples < 2:
            raise LigamentError(f"a line has two samples or more, not {samples}")
        return CrackOpening(**self._run.openings(self._state(step, time), [list(start), list(end)], samples))

    def crack_surface(self, step: Step | None = None, *, time: float | None = None) -> CrackSurface:
        """The crack of a solid in a step, or at a time of a motion, as a surface, the last step where none is said.

        Openings are those of the step's fields, or of the last fields before it.
        """
        if not self.is_solid:
            hint = "`crack_path` has its cracks as lines"
            raise LigamentError(f"a crack surface is that of a solid, and this body lies in the plane; {hint}", hint=hint)
        return CrackSurface(**self._run.surface(self._run.state(_meant(step, time), False)))

    def plot(
        self,
        field: str | None = None,
        step: Step | None = None,
        *,
        time: float | None = None,
        width: float = WIDTH,
        scale: float | None = None,
        crack: Literal["bonds", "lines"] | None = None,
        view: str | tuple[float, float] | None = None,
        section: str | None = None,
        level: float | None = None,
    ) -> Picture:
        """A picture of a field on the deformed body, as the command ``ligament plot`` draws it.

        A field is named as in `field`: of a vector its norm, or ``displacement.y`` and ``stress.xx``; ``"none"`` draws the body alone. Without
        a field the damage, or the displacement where no bond broke. The width is in mm, `scale` is the factor on the displacement.

        `crack` draws the broken bonds or the crack as lines; of a solid the cells opened along the crack, or its surface by the opening. A
        solid is seen from ``"x"``, ``"y"``, ``"z"``, ``"iso"`` or an azimuth and an elevation in degrees; `section` is a plane such as
        ``"z=0.05"``, and `level` draws the surface on which the field has this value.
        """
        at = self._state(step, time)
        if field not in (None, "none"):
            self._named(str(field), at)
        seen = view if view is None or isinstance(view, str) else f"{view[0]},{view[1]}"
        wanted = {
            "label": self.title, "field": field, "scale": scale, "crack": crack, "view": seen, "section": section, "level": level,
            "width": width,
        }
        return Picture(*_native.draw_fields(self.folder, _meant(step, time), wanted))

    def curve(self, x: str | None = None, y: str | Sequence[str] = "reaction", *, width: float = WIDTH) -> Picture:
        """A picture of a column of the history over another, at first of the force over the displacement, of a motion over the time.

        `y` may be several columns of one unit; ``"energies"`` and ``"probes"`` are all of these.
        """
        return curves([self], [self.title], (x, y), width)

    def explain(
        self, point: int | None = None, *, bond: tuple[int, int] | None = None, at: tuple[float, ...] | None = None
    ) -> Text:
        """What the command ``ligament explain`` says of the bonds of a point by its tag, of the bond between two points, or of the point nearest
        to a position in m: limits, largest utilisations, when and why they broke."""
        tags = [*([] if point is None else [int(point)]), *map(int, bond or ())]
        return Text(self._run.explain(tags, [float(it) for it in at or ()]))

    def report(
        self,
        path: str | os.PathLike[str],
        measured: Sequence[str | os.PathLike[str]] = (),
        *,
        digits: int | None = None,
        steps: int | None = None,
        size: float | None = None,
    ) -> Path:
        """Writes the page of the results for a browser, one file, with tables of measured curves, and gives its path; a file that is there
        is replaced.

        `digits` are those of the largest value of a field in a step, at first 4; `steps` and the `size` in MB are limits, at first 60 and 15.
        """
        return report([self], path, measured, digits=digits, steps=steps, size=size)

    def to_pyvista(self, step: Step | None = None, *, time: float | None = None) -> Any:
        """The body in a step, or at a time of a motion, as a grid of PyVista, with all fields."""
        import pyvista

        return pyvista.read(self._run.file(self._state(step, time)))

    def to_xarray(self) -> Any:
        """The fields over the steps and points as a data set of xarray, with units and, at each step, displacement and force of the load, and
        in a motion the time."""
        import xarray

        coordinates: dict[str, Any] = {"step": self.steps}
        for name in ("load_factor", "displacement", "reaction"):
            of_steps = np.asarray(self.columns[name])[self._rows]
            coordinates[f"load_{name}" if name != "load_factor" else name] = ("step", of_steps, {"units": self.units[name]})
        if self.is_motion:
            coordinates["time"] = coordinates.pop("load_factor")[:2] + ({"units": "s"},)
        for axis, values in zip(VECTOR, self.points["position"].T, strict=False):
            coordinates[axis] = ("point", values, {"units": "m"})
        fields: dict[str, Any] = {}
        last = str(self.steps[-1])
        for name, (components, stays, unit) in self._info(last).items():
            dimensions = ["step", "point"]
            if components:
                dimensions.append("axis" if components == VECTOR else f"{name}_component")
                coordinates[dimensions[-1]] = components
            if stays:
                fields[name] = (dimensions[1:], self._whole(name, last), {"units": unit})
            else:
                fields[name] = (dimensions, np.stack([self._whole(name, str(step)) for step in self.steps]), {"units": unit})
        return xarray.Dataset(fields, coordinates, {"title": self.title})

    def __repr__(self) -> str:
        if not self.is_finished:
            return f"<ligament.Result {self.title!r}: unfinished>"
        return f"<ligament.Result {self.title!r}: {self.summary['broken_bonds']} bonds broken, {self.termination}>"

    def _repr_html_(self) -> str:
        rows = "".join(f"<tr><td>{html.escape(name)}</td><td>{html.escape(value)}</td></tr>" for name, value in self._told())
        pictures = [self.plot(width=HALF).to_html()]
        if len(self.columns["step"]) > 2:
            pictures.insert(0, self.curve(width=HALF).to_html())
        return f"<div><b>{html.escape(self.title)}</b><table>{rows}</table>{''.join(pictures)}</div>"

    def _told(self) -> list[tuple[str, str]]:
        if not self.is_finished:
            return [("the run", "has not come to its end"), ("steps so far", str(int(self.columns["step"][-1])))]
        summary = self.summary
        units = summary["units"]
        told = [("points, bonds", f"{summary['points']}, {summary['bonds']}")]
        for name, words in (("first_peak", "first peak"), ("peak", "largest load")):
            point = summary.get(name)
            if point:
                force, along = units["force"], units["displacement"]
                at = f"{point['load_factor']:.4g} s" if self.is_motion else f"{point['displacement']:.4g} {along}"
                told.append((words, f"{point['reaction']:.4g} {force} at {at}"))
        told.append(("broken bonds", str(summary["broken_bonds"])))
        told.append(("ended because", summary["termination_message"]))
        return told + [("warning", words) for words in self.warnings]


def _meant(step: Step | None, time: float | None) -> str:
    """The name of a step or of a time."""
    if time is None:
        return "last" if step is None else str(step)
    if step is not None:
        hint = "give one of them"
        raise LigamentError(f"`step` and `time` both mean a step; {hint}", hint=hint)
    return f"t={float(time)!r}"


@overload
def open(folder: str | os.PathLike[str]) -> Result: ...
@overload
def open(folder: str | os.PathLike[str], kind: type[Result]) -> Result: ...
@overload
def open(folder: str | os.PathLike[str], kind: type[Modes]) -> Modes: ...
def open(folder: str | os.PathLike[str], kind: type[Result] | type[Modes] | None = None) -> Result | Modes:
    """The results in a folder: of ``ligament run``, of `Result.save`, or of a run that is under way, of which it has what is there so far; of a
    modal analysis its `Modes`.

    `kind`, ``ligament.Modes`` or ``ligament.Result``, tells type checkers what it is, and refuses the other.
    """
    found: type[Result] | type[Modes] = Modes if _native.Folder(folder).is_modal else Result
    if kind not in (None, found):
        what = "natural modes" if found is Modes else "the results of loads"
        hint = f"`ligament.open(folder, ligament.{found.__name__})` opens them"
        raise LigamentError(f"{folder} has {what}; {hint}", hint=hint)
    return found(folder)


def report(
    results: list[Result],
    path: str | os.PathLike[str],
    measured: Sequence[str | os.PathLike[str]] = (),
    *,
    digits: int | None = None,
    steps: int | None = None,
    size: float | None = None,
) -> Path:
    """Writes one page for a browser with several results, and gives its path; a file that is there is replaced. The others are those of
    `Result.report`."""
    if digits is not None and not 2 <= digits <= 8:
        raise LigamentError(f"a page has from 2 to 8 digits, and not {digits}", hint="2 to 8 digits")
    if (steps is not None and steps < 2) or (size is not None and not size > 0):
        raise LigamentError("a page has 2 steps or more, and a size above 0", hint="2 steps or more, and a size above 0")
    folders, titles = [it.folder for it in results], [it.title for it in results]
    return _native.report(folders, titles, Path(path), [Path(it) for it in measured], (digits, steps, size))
