"""Results in folders of the program, and how their tables and arrays are given."""

from __future__ import annotations

import importlib.util
import os
import tomllib
from collections.abc import Mapping
from pathlib import Path
from typing import Any, Self

import numpy as np
from numpy.typing import NDArray

from ligament import _native
from ligament._home import Home

Floats = NDArray[np.float64]


class Stored:
    """Results in a folder of the program, which is that of the command line."""

    def __init__(self, folder: str | os.PathLike[str], title: str | None = None, home: Home | None = None) -> None:
        self._run = _native.Folder(Path(folder))
        # Who has the folder: it lives as long as this.
        self._home = home
        self.title = title if title is not None else self._own_title()

    def _own_title(self) -> str:
        case = tomllib.loads((self.folder / "case.resolved.toml").read_text(encoding="utf-8"))
        return str(case.get("title") or self.folder.name)

    @property
    def folder(self) -> Path:
        """The folder of the results."""
        return Path(self._run.path)

    def save(self, folder: str | os.PathLike[str], *, replace: bool = False) -> Path:
        """Copies the results into a folder that is new or empty, and gives its path; `ligament.open` and the command line read it.

        The files that the case reads come along, so that the folder can be moved, repeated and, where the run was stopped, resumed.
        `replace` puts it in the place of earlier results.
        """
        self._run.copy_to(Path(folder), replace)
        return Path(folder)

    def __reduce__(self) -> Any:
        files = {it.name: it.read_bytes() for it in sorted(self.folder.iterdir()) if it.is_file() and not it.name.startswith(".")}
        return _restored, (type(self), files, self.title)

    def __deepcopy__(self, _: object) -> Self:
        # It never changes.
        return self


def _restored(kind: type[Stored], files: dict[str, bytes], title: str) -> Stored:
    """The results of files, in a folder of their own."""
    home = Home()
    home.restore(files)
    return kind(home.path, title, home)


def table(columns: Mapping[str, Any], units: Mapping[str, str] | None = None) -> Any:
    """Columns as a table of pandas, whose ``attrs["units"]`` has their units, or of polars, whichever is installed, else as a dictionary."""
    if importlib.util.find_spec("pandas"):
        import pandas

        frame = pandas.DataFrame(dict(columns), copy=False)
        if units is not None:
            frame.attrs["units"] = dict(units)
        return frame
    if importlib.util.find_spec("polars"):
        import polars

        return polars.DataFrame(dict(columns))
    return dict(columns)


def read_only(values: NDArray[Any]) -> NDArray[Any]:
    """An array that cannot be made writable: a view of one that is read only."""
    values.setflags(write=False)
    return values.view()
