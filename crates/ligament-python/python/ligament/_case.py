"""Cases and setups: what to compute."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, Self, TypeAlias, Unpack, cast

from numpy.typing import ArrayLike

from ligament import _body, _functions, _native
from ligament._errors import LigamentError
from ligament._functions import Function
from ligament._home import Home
from ligament._native import Case as NativeCase

if TYPE_CHECKING:
    # A thousand lines of types are read by checkers and editors alone.
    from ligament._sections import Sections, SectionsOnBody

Section = Mapping[str, Any]

# Where a case in memory would be: paths in it are relative to the current folder.
IN_MEMORY = "case in memory"


class Case:
    """A case: a body, its material and bonds, supports and loads, and how bonds break.

    The sections and keys are those of a case file, which ``ligament.keys`` lists. A case never changes: `with_changes` gives another one.

    >>> case = Case.from_toml('''
    ... [lattice]
    ... cells = [20, 10]
    ... spacing = 0.01
    ... set = { left = { left = 2 }, right = { right = 2 } }
    ... [material]
    ... young = 30e9
    ... poisson = 0.2
    ... [model]
    ... law = "nhpd"
    ... horizon_factor = 3.0
    ... [[support]]
    ... group = "left"
    ... displacement = { x = 0.0, y = 0.0 }
    ... [[load]]
    ... group = "right"
    ... displacement = { x = 1e-5 }
    ... ''')
    >>> case.number("material.young")
    30000000000.0
    >>> case.with_changes(material__young=15e9).number("material.young")
    15000000000.0
    """

    _native: NativeCase
    # Files of the body and of tables that are in memory, by their keys, and the folder that holds them.
    _files: dict[str, Path]
    _home: Home | None

    def __init__(self, sections: Sections, /, **changes: Any) -> None:
        self._make(dict(sections), dotted(changes))

    def _make(self, sections: dict[str, Any], changes: dict[str, Any]) -> None:
        """Reads sections, whose functions become tables at the points of the body."""
        self._files, self._home = {}, None
        plain, functions = _functions.taken_out(sections)
        self._native = _native.Case.of_sections(plain, IN_MEMORY, changes)
        if functions:
            self._tabulate(plain, functions, changes)

    def _tabulate(self, plain: dict[str, Any], functions: Sequence[tuple[str, int, Function]], changes: dict[str, Any]) -> None:
        self._home = self._home or Home()
        positions = self._native.positions()
        for section, index, function in functions:
            key = f"{section}.{index}.file" if section == "temperature" else f"{section}.{index}.profile.file"
            file = self._files[key] = self._home.path / f"{section}-{index}.csv"
            values = _functions.values(function, positions, key.removesuffix(".file"))
            _native.write_samples(file, _functions.column(section), positions, values)
            plain[section][index] = _functions.with_table(plain[section][index], section, str(file))
        self._native = _native.Case.of_sections(plain, IN_MEMORY, changes)

    @classmethod
    def _of(cls, native: NativeCase, files: dict[str, Path] | None = None, home: Home | None = None) -> Self:
        case = cls.__new__(cls)
        case._native, case._files, case._home = native, files or {}, home
        return case

    def __reduce__(self) -> Any:
        files = {key: (file.name, file.read_bytes()) for key, file in self._files.items()}
        return _restored, (type(self), self._native.source(), str(self._native.path), files)

    def __deepcopy__(self, _: object) -> Self:
        # It never changes.
        return self

    @classmethod
    def from_toml(cls, source: str | os.PathLike[str], /, **changes: Any) -> Case:
        """The case in a file, or in a text with more than one line."""
        if isinstance(source, str) and "\n" in source:
            return cls._of(_native.Case.parse(source, IN_MEMORY, dotted(changes)))
        return cls._of(_native.Case.load(Path(source), dotted(changes)))

    @classmethod
    def from_dict(cls, sections: Section, /, **changes: Any) -> Case:
        """The case of a dictionary of sections whose type is not known; editors check the keys of `Case` itself."""
        return cls(cast("Sections", sections), **changes)

    def with_changes(self, **changes: Any) -> Self:
        """The case with some keys changed, and those taken away whose value is None.

        Keys are written with two underscores for a dot, ``model__horizon_factor=4``, or as they are in a dictionary:
        ``**{"model.horizon_factor": 4}``. Entries of lists count from 0: ``load__0__displacement__y``.
        """
        return self._of(self._native.changed(dotted(changes)), self._files, self._home)

    @property
    def title(self) -> str:
        """Title of the case."""
        return self._native.title

    @property
    def name(self) -> str:
        """Name of the case, by its file."""
        return self._native.name

    def number(self, key: str) -> float | None:
        """The number at a key such as ``material.young``: as given or by default."""
        return self._native.number(key)

    @property
    def n_points(self) -> int:
        """Number of points of the body."""
        return self._native.n_points

    @property
    def groups(self) -> list[str]:
        """Names of the groups of the body."""
        return self._native.groups

    @property
    def is_solid(self) -> bool:
        """Whether the body is a solid."""
        return self._native.is_solid

    def to_toml(self) -> str:
        """The case as a text in TOML with every default filled in."""
        return self._native.to_toml()

    def __repr__(self) -> str:
        return f"<ligament.Case {self.title or self.name!r}>"


class Setup(Case):
    """A case on a body in memory: points or cells from arrays, a mesh of meshio, or the live model of gmsh.

    Points take `positions` (n, 2) in m, `areas` that each of them stands for (n, or one for all) in m², and `groups` by indices or
    masks (n). A solid takes `positions` (n, 3) and `volumes` in m³. With `cells` the positions are nodes of a mesh: arrays of node
    indices by the kind of cell, as meshio calls them (``triangle``, ``quad``, ``tetra``, ``hexahedron``, ``wedge``, ``pyramid``), and
    `faces` are named sides of cells: edges (n, 2), in a solid faces (n, 3) or (n, 4). A `mesh` is an object of meshio or the module
    gmsh itself; its groups are its physical groups or cell sets, and `groups` adds further ones of its nodes. `thickness` and `plane`
    are those of a body in the plane. `sections` are those of a case file, but for ``mesh`` and lattices; the ``change`` of a temperature and
    the ``profile`` of a load may be functions of x and y, in a solid of x, y and z.

    >>> import numpy as np
    >>> x, y = np.meshgrid(0.01 * np.arange(30), 0.01 * np.arange(10))
    >>> setup = Setup(
    ...     positions=np.column_stack([x.ravel(), y.ravel()]), areas=1e-4,
    ...     groups={"left": x.ravel() == 0, "right": x.ravel() == x.max()},
    ...     material={"young": 210e9, "poisson": 0.25},
    ...     model={"law": "nhpd", "horizon_factor": 3.0},
    ...     support=[{"group": "left", "displacement": {"x": 0.0, "y": 0.0}}],
    ...     load=[{"group": "right", "force": {"x": 1e3}}],
    ... )
    >>> setup.n_points, setup.groups
    (300, ['left', 'right'])
    """

    def __init__(
        self,
        mesh: Any = None,
        *,
        positions: ArrayLike | None = None,
        areas: ArrayLike | None = None,
        volumes: ArrayLike | None = None,
        cells: Mapping[str, ArrayLike] | None = None,
        faces: Mapping[str, ArrayLike] | None = None,
        groups: Mapping[str, ArrayLike] | None = None,
        thickness: float | None = None,
        plane: str | None = None,
        **sections: Unpack[SectionsOnBody],
    ) -> None:
        home = Home()
        if mesh is not None:
            file = _body.write_mesh(home.path, mesh, groups)
        elif positions is not None and cells is not None:
            file = _body.write_cells(home.path, positions, cells, faces, groups)
        elif positions is not None and not (areas is None and volumes is None):
            file = _body.write_points(home.path, positions, areas, volumes, groups)
        else:
            raise LigamentError("a setup needs a `mesh`, or `positions` with `cells`, or `positions` and `areas` (`volumes` of a solid)")
        plain, functions = _functions.taken_out(sections)
        on_body = {"mesh": {"file": str(file), "thickness": thickness, "plane": plane}, **plain}
        self._files, self._home = {"mesh.file": file}, home
        self._native = _native.Case.of_sections(on_body, IN_MEMORY, {})
        if functions:
            self._tabulate(on_body, functions, {})


def _restored(kind: type[Case], source: str, path: str, files: dict[str, tuple[str, bytes]]) -> Case:
    """The case of a text, with files of its own."""
    home = Home() if files else None
    paths: dict[str, Path] = {}
    for key, (name, contents) in files.items():
        assert home is not None
        home.restore({name: contents})
        paths[key] = home.path / name
    changes = {key: str(file) for key, file in paths.items()}
    return kind._of(_native.Case.parse(source, path, changes), paths, home)


# What a case is given as.
Source: TypeAlias = "Case | Sections | str | os.PathLike[str]"


def dotted(changes: Mapping[str, Any]) -> dict[str, Any]:
    """Changes by keys with dots."""
    return {key if "." in key else key.replace("__", "."): value for key, value in changes.items()}


def case_of(source: Source, changes: Mapping[str, Any]) -> Case:
    """The case that is meant, with changes."""
    if isinstance(source, Case):
        return source.with_changes(**changes) if changes else source
    if isinstance(source, Mapping):
        return Case.from_dict(source, **changes)
    return Case.from_toml(source, **changes)
