"""Cases and setups: what to compute."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from numpy.typing import ArrayLike

from ligament import _body, _native
from ligament._errors import LigamentError

Section = Mapping[str, Any]

# Where a case in memory would be: paths in it are relative to the current folder.
IN_MEMORY = "case in memory"


class Case:
    """A case: a body, its material and bonds, supports and loads, and how bonds break.

    The sections and keys are those of a case file. A case never changes: `with_changes` gives another one.

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

    def __init__(self, sections: Section, /, **changes: Any) -> None:
        self._native = _native.Case.of_sections(dict(sections), IN_MEMORY, dotted(changes), None)

    @classmethod
    def _of(cls, native: _native.Case) -> Case:
        case = cls.__new__(cls)
        case._native = native
        return case

    @classmethod
    def from_toml(cls, source: str | os.PathLike[str], /, **changes: Any) -> Case:
        """The case in a file, or in a text with more than one line."""
        if isinstance(source, str) and "\n" in source:
            return cls._of(_native.Case.parse(source, IN_MEMORY, dotted(changes)))
        return cls._of(_native.Case.load(Path(source), dotted(changes)))

    @classmethod
    def from_dict(cls, sections: Section, /, **changes: Any) -> Case:
        """The case of a dictionary of sections, with the keys of a case file."""
        return cls(sections, **changes)

    def with_changes(self, **changes: Any) -> Case:
        """The case with some keys changed, and those taken away whose value is None.

        Keys are written with two underscores for a dot, ``model__horizon_factor=4``, or as they are in a dictionary:
        ``**{"model.horizon_factor": 4}``. Entries of lists count from 0: ``load__0__displacement__y``.
        """
        return self._of(self._native.changed(dotted(changes)))

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
    are those of a body in the plane. `sections` are those of a case file, but for ``mesh`` and lattices.

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
        **sections: Section | Sequence[Section] | str,
    ) -> None:
        if mesh is not None:
            self._body = _body.of_mesh(mesh, groups)
        elif positions is not None and cells is not None:
            self._body = _body.of_cells(positions, cells, faces, groups)
        elif positions is not None and not (areas is None and volumes is None):
            self._body = _body.of_points(positions, areas, volumes, groups)
        else:
            raise LigamentError("a setup needs a `mesh`, or `positions` with `cells`, or `positions` and `areas` (`volumes` of a solid)")
        # The body of the section is the one in memory: no such file is read.
        on_body = {"mesh": {"file": "body in memory", "thickness": thickness, "plane": plane}, **sections}
        self._native = _native.Case.of_sections(on_body, IN_MEMORY, {}, self._body)

    @property
    def n_points(self) -> int:
        """Number of points of the body."""
        return self._body.n_points

    @property
    def groups(self) -> list[str]:
        """Names of the groups of the body."""
        return self._body.groups

    @property
    def is_solid(self) -> bool:
        """Whether the body is a solid."""
        return self._body.is_solid


def dotted(changes: Mapping[str, Any]) -> dict[str, Any]:
    """Changes by keys with dots."""
    return {key if "." in key else key.replace("__", "."): value for key, value in changes.items()}


def case_of(source: Case | Section | str | os.PathLike[str], changes: Mapping[str, Any]) -> Case:
    """The case that is meant, with changes."""
    if isinstance(source, Case):
        return source.with_changes(**changes) if changes else source
    if isinstance(source, Mapping):
        return Case.from_dict(source, **changes)
    return Case.from_toml(source, **changes)
