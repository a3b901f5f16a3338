"""Setups on bodies in memory."""

from typing import Any

import ligament
import numpy as np
import pytest

ELASTIC: dict[str, Any] = {
    "material": {"young": 210e9, "poisson": 0.25},
    "model": {"law": "nhpd", "horizon_factor": 3.0},
    "support": [{"group": "left", "displacement": {"x": 0.0, "y": 0.0}}],
    "load": [{"group": "right", "displacement": {"x": 1e-5}}],
}


def grid(columns: int = 30, rows: int = 10, h: float = 0.01) -> np.ndarray:
    x, y = np.meshgrid(h * (0.5 + np.arange(columns)), h * (0.5 + np.arange(rows)))
    return np.column_stack([x.ravel(), y.ravel()])


def test_points_from_arrays_are_those_of_the_lattice() -> None:
    at = grid()
    x = at[:, 0]
    points = ligament.Setup(
        positions=at, areas=1e-4, thickness=0.1, groups={"left": x < 0.02, "right": np.flatnonzero(x > 0.28)},
        correction={"surface": "volume"}, **ELASTIC,
    )
    assert (points.n_points, points.groups) == (300, ["left", "right"])
    lattice = {
        **ELASTIC,
        "lattice": {
            "cells": [30, 10], "spacing": 0.01, "thickness": 0.1,
            "set": {"left": {"left": 2}, "right": {"right": 2}},
        },
        "correction": {"surface": "volume"},
    }
    a, b = (ligament.run(case, progress=False) for case in (points, lattice))
    # The same points in the same order; sums along other curves through them differ in the last digits.
    assert a.columns["reaction"][-1] == pytest.approx(b.columns["reaction"][-1], rel=1e-9)
    np.testing.assert_allclose(a.field("displacement"), b.field("displacement"), atol=1e-9 * 1e-5)


def square_mesh(n: int = 12) -> Any:
    meshio = pytest.importorskip("meshio")
    t = np.linspace(0.0, 0.1, n + 1)
    points = np.column_stack([*(it.ravel() for it in np.meshgrid(t, t)), np.zeros((n + 1) ** 2)])
    first = np.add.outer((n + 1) * np.arange(n), np.arange(n)).ravel()
    quads = np.column_stack([first, first + 1, first + n + 2, first + n + 1])
    edge = (n + 1) * np.arange(n)
    lines = np.column_stack([edge, edge + n + 1])
    return meshio.Mesh(
        points,
        [("quad", quads), ("line", lines), ("line", lines + n)],
        cell_sets={"left": [None, np.arange(n), None], "right": [None, None, np.arange(n)]},
    )


def test_a_mesh_of_meshio_pulls_as_stiff_as_its_material() -> None:
    setup = ligament.Setup(square_mesh(), thickness=0.01, groups={"corner": [0]}, **ELASTIC)
    assert sorted(setup.groups) == ["corner", "left", "right"]
    free = setup.with_changes(**{"support.0.displacement": {"x": 0.0}})
    result = ligament.run(free, progress=False, model__horizon_factor=3.0, correction__surface="patch")
    # F = E A u/L of a square that is free to contract; the patch correction is exact but for its tolerance.
    assert result.columns["reaction"][-1] == pytest.approx(210e9 * 0.1 * 0.01 * 1e-5 / 0.1, rel=1e-3)


def test_physical_groups_of_meshio_are_found() -> None:
    mesh = square_mesh()
    mesh.cell_sets = {}
    n = len(mesh.cells[0].data)
    mesh.cell_data = {"gmsh:physical": [np.full(n, 1), np.full(12, 7), np.full(12, 8)]}
    mesh.field_data = {"body": np.array([1, 2]), "left": np.array([7, 1])}
    assert sorted(ligament.Setup(mesh, load=[{"group": "8", "displacement": {"x": 1e-5}}],
                                 **{k: v for k, v in ELASTIC.items() if k != "load"}).groups) == ["8", "body", "left"]


def test_the_live_model_of_gmsh_is_a_body() -> None:
    try:
        import gmsh
    except (ImportError, OSError) as error:
        pytest.skip(f"gmsh cannot be used here: {error}")
    gmsh.initialize(interruptible=False)
    try:
        gmsh.option.setNumber("General.Terminal", 0)
        occ = gmsh.model.occ
        plate = occ.addRectangle(0, 0, 0, 0.1, 0.05)
        occ.synchronize()
        for name, side in (("left", 4), ("right", 2)):
            gmsh.model.addPhysicalGroup(1, [side], name=name)
        gmsh.model.addPhysicalGroup(2, [plate], name="plate")
        gmsh.option.setNumber("Mesh.MeshSizeMax", 0.01)
        gmsh.model.mesh.generate(2)
        setup = ligament.Setup(gmsh, **ELASTIC)
    finally:
        gmsh.finalize()
    assert sorted(setup.groups) == ["left", "plate", "right"]
    assert ligament.run(setup, progress=False).columns["reaction"][-1] > 0


def test_groups_are_indices_or_masks_and_nothing_between() -> None:
    at = grid()
    is_left = at[:, 0] < 0.02

    def groups(left: Any) -> list[str]:
        return ligament.Setup(positions=at, areas=1e-4, groups={"left": left, "right": at[:, 0] > 0.28}, **ELASTIC).groups

    for left in (is_left, np.flatnonzero(is_left), [0, 1], list(is_left), np.arange(20, dtype=np.uint8), np.ma.masked_array([0, 1])):
        assert groups(left) == ["left", "right"]
    for left, words in [
        # The ones of a mask of whole numbers are no second point.
        (is_left.astype(int), "mask has truth values"),
        (is_left.astype(float), "whole numbers"),
        ([0.9, 12.7], "whole numbers"),
        (["0", "1"], "whole numbers"),
        ([True, 5], "truth values among numbers"),
        (np.ma.masked_array(np.arange(5), mask=[0, 1, 0, 0, 0]), "masked values"),
        (is_left[:-1], "shape"),
        ([[0, 1]], "shape"),
        (3, "shape"),
    ]:
        with pytest.raises(ligament.BodyError, match=words):
            groups(left)
    nested: list[Any] = []
    nested.append(nested)
    with pytest.raises(ligament.BodyError):
        groups(nested)


def test_nodes_of_cells_are_whole_numbers() -> None:
    at = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])
    with pytest.raises(ligament.BodyError, match="`quad` are whole numbers"):
        ligament.Setup(positions=at, cells={"quad": [[0, 1, 2, 3.5]]}, **ELASTIC)
    mesh = square_mesh(2)
    mesh.cell_sets["left"][1] = np.array([0.5, 1.5])
    with pytest.raises(ligament.BodyError, match="cell set `left`: indices are whole numbers"):
        ligament.Setup(mesh, **ELASTIC)


def test_bodies_that_are_none_are_refused() -> None:
    at = grid()
    for arguments, words in [
        ({"positions": at}, "`positions` and `areas`"),
        ({"positions": at[:, 0], "areas": 1.0}, "shape"),
        ({"positions": at, "areas": -1.0}, "greater than 0"),
        ({"positions": at, "areas": 1e-4, "groups": {"left": [300]}}, "outside of 0 to 299"),
        ({"mesh": 3}, "expected a mesh of meshio"),
    ]:
        with pytest.raises(ligament.LigamentError, match=words):
            ligament.Setup(**arguments, **ELASTIC)
    mesh = square_mesh(2)
    mesh.points[4, 2] = 0.01
    with pytest.raises(ligament.BodyError, match="one plane"):
        ligament.Setup(mesh, **ELASTIC)
