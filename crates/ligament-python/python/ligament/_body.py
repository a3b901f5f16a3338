"""Bodies from arrays, from meshio and from a live Gmsh model."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ligament import _native
from ligament._errors import BodyError

if TYPE_CHECKING:
    Elements = list[tuple[NDArray[np.uint64], str | None]]

# Corners of the kinds of cells that a planar mesh has, by the names of meshio without the number of further nodes.
CORNERS = {"vertex": 1, "line": 2, "triangle": 3, "quad": 4}

# Of Gmsh's numbers of types of elements, those of low order and the usual ones of high order.
GMSH_CORNERS = {15: 1, 1: 2, 8: 2, 26: 2, 2: 3, 9: 3, 21: 3, 3: 4, 10: 4, 16: 4, 36: 4}


def of_points(positions: ArrayLike, areas: ArrayLike, groups: Mapping[str, ArrayLike] | None = None) -> _native.Body:
    """The body of points (n, 2) with the area that each stands for (n, or one for all), and groups by indices or masks."""
    at = np.ascontiguousarray(positions, dtype=np.float64)
    if at.ndim != 2:
        raise BodyError(f"positions have the shape (n, 2), found {at.shape}")
    each = np.ascontiguousarray(np.broadcast_to(np.asarray(areas, dtype=np.float64), at.shape[:1]))
    return _native.Body.of_points(at, each, [(name, _indices(name, it, len(at))) for name, it in (groups or {}).items()])


def _indices(name: str, group: ArrayLike, n_points: int) -> list[int]:
    chosen = np.asarray(group)
    if chosen.dtype == bool:
        if chosen.shape != (n_points,):
            raise BodyError(f"group `{name}`: a mask has the shape ({n_points},), found {chosen.shape}")
        chosen = np.flatnonzero(chosen)
    if chosen.size and (chosen.min() < 0 or chosen.max() >= n_points):
        raise BodyError(f"group `{name}` has an index outside of 0 to {n_points - 1}")
    return [int(index) for index in chosen]


def of_mesh(mesh: Any, groups: Mapping[str, ArrayLike] | None = None) -> _native.Body:
    """The body of a meshio mesh, or of the current model of the module gmsh, with further groups of nodes by their indices."""
    if hasattr(mesh, "cells") and hasattr(mesh, "points"):
        tags, positions, elements = _of_meshio(mesh)
    elif hasattr(mesh, "model") and hasattr(mesh, "isInitialized"):
        tags, positions, elements = _of_gmsh(mesh)
    else:
        kind = type(mesh).__name__
        raise BodyError(f"expected a mesh of meshio or the module gmsh, found {kind}; arrays go to `positions` and `areas`")
    for name, group in (groups or {}).items():
        chosen = tags[_indices(name, group, len(tags))]
        elements.append((np.ascontiguousarray(chosen[:, None]), name))
    return _native.Body.of_mesh(tags, _planar(positions), elements)


def _planar(positions: NDArray[Any]) -> NDArray[np.float64]:
    at = np.asarray(positions, dtype=np.float64)
    if at.ndim == 2 and at.shape[1] == 3:
        if len(at) and np.ptp(at[:, 2]) > 1e-9 * max(float(np.ptp(at[:, :2])), 1e-300):
            raise BodyError("the nodes do not lie in one plane of constant z; the body is planar, in x and y")
        at = at[:, :2]
    return np.ascontiguousarray(at)


def _of_meshio(mesh: Any) -> tuple[NDArray[np.uint64], NDArray[Any], Elements]:
    tags = np.arange(1, len(mesh.points) + 1, dtype=np.uint64)
    elements: Elements = []
    names = {(int(dimension), int(number)): name for name, (number, dimension) in mesh.field_data.items()}
    physical = mesh.cell_data.get("gmsh:physical")
    for place, block in enumerate(mesh.cells):
        n = CORNERS.get(block.type.rstrip("0123456789"))
        if n is None:
            raise BodyError(f"cells of the kind `{block.type}` are in no planar mesh; triangles and quadrangles are")
        corners = np.ascontiguousarray(tags[np.asarray(block.data)[:, :n]])
        in_group = np.zeros(len(corners), dtype=bool)
        # A reader of Gmsh's files gives the same group as a set and by its number.
        sets = {name: sets[place] for name, sets in mesh.cell_sets.items() if not name.startswith("gmsh:")}
        if physical is not None:
            sets.update(_by_number(physical[place], min(n - 1, 2), names))
        for name, chosen in sets.items():
            if chosen is not None and len(chosen):
                chosen = np.asarray(chosen, dtype=np.int64)
                in_group[chosen] = True
                elements.append((corners[chosen], name))
        if not in_group.all() and n > 2:
            elements.append((corners[~in_group], None))
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
        raise BodyError("the model of gmsh has no mesh; call gmsh.model.mesh.generate(2)")
    elements: Elements = []
    in_group: set[tuple[int, int]] = set()
    for dimension, number in model.getPhysicalGroups():
        name = model.getPhysicalName(dimension, number) or str(number)
        for entity in model.getEntitiesForPhysicalGroup(dimension, number):
            in_group.add((dimension, int(entity)))
            elements += _of_entity(model, dimension, entity, name)
    for dimension, entity in model.getEntities(2):
        if (dimension, int(entity)) not in in_group:
            elements += _of_entity(model, dimension, entity, None)
    return np.asarray(tags, dtype=np.uint64), np.asarray(coordinates).reshape(-1, 3), elements


def _of_entity(model: Any, dimension: int, entity: int, name: str | None) -> Iterable[tuple[NDArray[np.uint64], str | None]]:
    kinds, of_kind, nodes = model.mesh.getElements(dimension, entity)
    for kind, elements, corners in zip(kinds, of_kind, nodes, strict=True):
        n = GMSH_CORNERS.get(int(kind))
        if n is None:
            raise BodyError(f"elements of Gmsh's type {kind} are in no planar mesh; triangles and quadrangles are")
        rows = np.asarray(corners, dtype=np.uint64).reshape(len(elements), -1)
        yield np.ascontiguousarray(rows[:, :n]), name
