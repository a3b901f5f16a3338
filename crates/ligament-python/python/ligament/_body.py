"""Bodies from arrays, from meshio and from a live Gmsh model, written as files that a case reads."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ligament import _native
from ligament._errors import BodyError

if TYPE_CHECKING:
    Elements = list[tuple[int, NDArray[np.uint64], str | None]]

# Dimensions and corners of the kinds of cells, by the names of meshio without the number of further nodes.
SHAPES = {
    "vertex": (0, 1), "line": (1, 2), "triangle": (2, 3), "quad": (2, 4), "tetra": (3, 4), "pyramid": (3, 5), "wedge": (3, 6),
    "hexahedron": (3, 8),
}

# Of Gmsh's numbers of types of elements, those of low order and the usual ones of high order: dimensions and corners.
GMSH_SHAPES = {
    15: (0, 1), 1: (1, 2), 8: (1, 2), 26: (1, 2), 2: (2, 3), 9: (2, 3), 21: (2, 3), 3: (2, 4), 10: (2, 4), 16: (2, 4), 36: (2, 4),
    4: (3, 4), 11: (3, 4), 29: (3, 4), 5: (3, 8), 12: (3, 8), 17: (3, 8), 92: (3, 8), 6: (3, 6), 13: (3, 6), 18: (3, 6),
    7: (3, 5), 14: (3, 5), 19: (3, 5),
}

UNREAD = "is none of points, lines, triangles, quadrangles, tetrahedra, hexahedra, prisms and pyramids"


def write_points(
    folder: Path, positions: ArrayLike, areas: ArrayLike | None, volumes: ArrayLike | None, groups: Mapping[str, ArrayLike] | None = None
) -> Path:
    """Writes the body of points (n, 2) with the area or (n, 3) with the volume that each stands for (n, or one for all)."""
    at = np.ascontiguousarray(positions, dtype=np.float64)
    if at.ndim != 2 or at.shape[1] not in (2, 3):
        raise BodyError(f"positions have the shape (n, 2), or of a solid (n, 3), found {at.shape}")
    needed, sizes, other = ("areas", areas, volumes) if at.shape[1] == 2 else ("volumes", volumes, areas)
    if sizes is None or other is not None:
        raise BodyError(f"points at positions of the shape {at.shape} stand for `{needed}` each: give these, and these alone")
    each = np.ascontiguousarray(np.broadcast_to(np.asarray(sizes, dtype=np.float64), at.shape[:1]))
    path = folder / "points.csv"
    _native.write_points(path, at, each, [(name, _indices(name, it, len(at))) for name, it in (groups or {}).items()])
    return path


def _indices(name: str, group: ArrayLike, n_points: int) -> list[int]:
    chosen = _array(name, group)
    if chosen.dtype == bool:
        if chosen.shape != (n_points,):
            raise BodyError(f"group `{name}`: a mask has the shape ({n_points},), found {chosen.shape}")
        chosen = np.flatnonzero(chosen)
    if chosen.ndim != 1:
        raise BodyError(f"group `{name}`: indices have the shape (n,), found {chosen.shape}")
    chosen = _whole(f"group `{name}`: indices", chosen)
    # Three places or more among the first two: a mask, whose ones would be read as the second point.
    if chosen.size > 2 and chosen.min() >= 0 and chosen.max() <= 1:
        raise BodyError(f"group `{name}` has nothing but 0 and 1; a mask has truth values: give `mask.astype(bool)`")
    if chosen.size and (chosen.min() < 0 or chosen.max() >= n_points):
        raise BodyError(f"group `{name}` has an index outside of 0 to {n_points - 1}")
    return [int(index) for index in chosen]


def _array(name: str, values: ArrayLike) -> NDArray[Any]:
    if np.ma.is_masked(values):
        raise BodyError(f"`{name}` is an array with masked values, which stand for nothing: give `array.compressed()`, or fill them")
    try:
        array = np.asarray(values)
        # Beside numbers a truth value would be read as 0 or 1.
        each = np.asarray(values, dtype=object).flat if array.dtype.kind in "iuf" and isinstance(values, list | tuple) else ()
    except (ValueError, RecursionError) as error:
        raise BodyError(f"`{name}` is no array: {error}") from error
    if any(isinstance(it, bool | np.bool_) for it in each):
        raise BodyError(f"`{name}` has truth values among numbers: give a mask of truth values alone, or indices alone")
    return array


def _whole(what: str, values: NDArray[Any]) -> NDArray[np.int64]:
    """Whole numbers, which are not made of others by cutting off what stands behind the point."""
    if values.size and values.dtype.kind not in "iu":
        raise BodyError(f"{what} are whole numbers (int), found {values.dtype}; `np.flatnonzero(condition)` gives the indices of points")
    return values.astype(np.int64)


def write_mesh(folder: Path, mesh: Any, groups: Mapping[str, ArrayLike] | None = None) -> Path:
    """Writes the body of a meshio mesh, or of the current model of the module gmsh, with further groups of nodes by their indices."""
    if hasattr(mesh, "cells") and hasattr(mesh, "points"):
        tags, positions, elements = _of_meshio(mesh)
    elif hasattr(mesh, "model") and hasattr(mesh, "isInitialized"):
        tags, positions, elements = _of_gmsh(mesh)
    else:
        kind = type(mesh).__name__
        raise BodyError(f"expected a mesh of meshio or the module gmsh, found {kind}; arrays go to `positions` with `cells` or `areas`")
    return _meshed(folder, tags, positions, elements, groups)


def write_cells(
    folder: Path,
    positions: ArrayLike,
    cells: Mapping[str, ArrayLike],
    faces: Mapping[str, ArrayLike] | None = None,
    groups: Mapping[str, ArrayLike] | None = None,
) -> Path:
    """Writes the body of nodes (n, 2) or (n, 3), cells of some kinds by their nodes, named faces or edges, and groups of nodes by indices."""
    at = np.asarray(positions, dtype=np.float64)
    if at.ndim != 2 or at.shape[1] not in (2, 3):
        raise BodyError(f"positions have the shape (n, 2), or of a solid (n, 3), found {at.shape}")
    tags = np.arange(1, len(at) + 1, dtype=np.uint64)
    elements: Elements = []
    for kind, rows in cells.items():
        if kind not in SHAPES:
            raise BodyError(f"cells of the kind `{kind}` are not known; there are {', '.join(SHAPES)}")
        dimension, n = SHAPES[kind]
        elements.append((dimension, _corners(kind, rows, (n,), tags), None))
    top = max((dimension for dimension, _, _ in elements), default=2)
    for name, rows in (faces or {}).items():
        elements.append((top - 1, _corners(name, rows, (2,) if top == 2 else (3, 4), tags), name))
    return _meshed(folder, tags, at, elements, groups)


def _corners(name: str, rows: ArrayLike, sizes: tuple[int, ...], tags: NDArray[np.uint64]) -> NDArray[np.uint64]:
    corners = _whole(f"the nodes of `{name}`", _array(name, rows))
    if corners.ndim != 2 or corners.shape[1] not in sizes:
        shape = " or ".join(f"(n, {size})" for size in sizes)
        raise BodyError(f"the nodes of `{name}` have the shape {shape}, found {corners.shape}")
    if corners.size and (corners.min() < 0 or corners.max() >= len(tags)):
        raise BodyError(f"`{name}` has a node outside of 0 to {len(tags) - 1}")
    return np.ascontiguousarray(tags[corners])


def _meshed(
    folder: Path, tags: NDArray[np.uint64], positions: NDArray[Any], elements: Elements, groups: Mapping[str, ArrayLike] | None
) -> Path:
    for name, group in (groups or {}).items():
        chosen = tags[_indices(name, group, len(tags))]
        elements.append((0, np.ascontiguousarray(chosen[:, None]), name))
    is_solid = any(dimension == 3 for dimension, _, _ in elements)
    path = folder / "mesh.msh"
    _native.write_mesh(path, tags, _in_space(positions, is_solid), elements)
    return path


def _in_space(positions: NDArray[Any], is_solid: bool) -> NDArray[np.float64]:
    """Positions with three coordinates, the last of which is zero in the plane."""
    at = np.asarray(positions, dtype=np.float64)
    if at.ndim != 2 or at.shape[1] not in (2, 3) or (is_solid and at.shape[1] == 2):
        raise BodyError(f"the nodes have the shape (n, {3 if is_solid else 2}), found {at.shape}")
    if is_solid:
        return np.ascontiguousarray(at)
    if at.shape[1] == 3 and len(at) and np.ptp(at[:, 2]) > 1e-9 * max(float(np.ptp(at[:, :2])), 1e-300):
        raise BodyError("the mesh has no solid cells, and its nodes do not lie in one plane of constant z; of a solid give the cells, too")
    return np.column_stack([at[:, :2], np.zeros(len(at))])


def _of_meshio(mesh: Any) -> tuple[NDArray[np.uint64], NDArray[Any], Elements]:
    tags = np.arange(1, len(mesh.points) + 1, dtype=np.uint64)
    elements: Elements = []
    names = {(int(dimension), int(number)): name for name, (number, dimension) in mesh.field_data.items()}
    physical = mesh.cell_data.get("gmsh:physical")
    for place, block in enumerate(mesh.cells):
        shape = SHAPES.get(block.type.rstrip("0123456789"))
        if shape is None:
            raise BodyError(f"the kind of cells `{block.type}` {UNREAD}")
        dimension, n = shape
        nodes = _whole(f"the nodes of `{block.type}`", np.asarray(block.data))
        corners = np.ascontiguousarray(tags[nodes[:, :n]])
        in_group = np.zeros(len(corners), dtype=bool)
        # A reader of Gmsh's files gives the same group as a set and by its number.
        sets = {name: sets[place] for name, sets in mesh.cell_sets.items() if not name.startswith("gmsh:")}
        if physical is not None:
            sets.update(_by_number(physical[place], dimension, names))
        for name, chosen in sets.items():
            if chosen is not None and len(chosen):
                chosen = _whole(f"cell set `{name}`: indices", np.asarray(chosen))
                in_group[chosen] = True
                elements.append((dimension, corners[chosen], name))
        if not in_group.all() and dimension > 1:
            elements.append((dimension, corners[~in_group], None))
    return tags, np.asarray(mesh.points), elements


def _by_number(
    numbers: ArrayLike, dimension: int, names: Mapping[tuple[int, int], str]
) -> Iterator[tuple[str, NDArray[np.int64]]]:
    numbers = np.asarray(numbers)
    for number in np.unique(numbers):
        if number > 0:
            yield names.get((dimension, int(number)), str(number)), np.flatnonzero(numbers == number)


def _of_gmsh(gmsh: Any) -> tuple[NDArray[np.uint64], NDArray[Any], Elements]:
    if not gmsh.isInitialized():
        raise BodyError("gmsh has no model; call gmsh.initialize() and mesh one")
    model = gmsh.model
    tags, coordinates, _ = model.mesh.getNodes()
    if not len(tags):
        raise BodyError("the model of gmsh has no mesh; call gmsh.model.mesh.generate(2), or of a solid generate(3)")
    elements: Elements = []
    in_group: set[tuple[int, int]] = set()
    for dimension, number in model.getPhysicalGroups():
        name = model.getPhysicalName(dimension, number) or str(number)
        for entity in model.getEntitiesForPhysicalGroup(dimension, number):
            in_group.add((dimension, int(entity)))
            elements += _of_entity(model, dimension, entity, name)
    for top in (2, 3):
        for dimension, entity in model.getEntities(top):
            if (dimension, int(entity)) not in in_group:
                elements += _of_entity(model, dimension, entity, None)
    return np.asarray(tags, dtype=np.uint64), np.asarray(coordinates).reshape(-1, 3), elements


def _of_entity(model: Any, dimension: int, entity: int, name: str | None) -> Elements:
    kinds, of_kind, nodes = model.mesh.getElements(dimension, entity)
    elements_of_all: Elements = []
    for kind, elements, corners in zip(kinds, of_kind, nodes, strict=True):
        if int(kind) not in GMSH_SHAPES:
            raise BodyError(f"Gmsh's type {kind} of elements {UNREAD}")
        of_shape, n = GMSH_SHAPES[int(kind)]
        rows = np.asarray(corners, dtype=np.uint64).reshape(len(elements), -1)
        elements_of_all.append((of_shape, np.ascontiguousarray(rows[:, :n]), name))
    return elements_of_all
