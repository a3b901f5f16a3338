"""Solids: bodies from arrays, meshio and Gmsh, and their results along three axes."""

import copy
from pathlib import Path
from typing import Any

import ligament
import numpy as np
import pytest

MESHES = Path(__file__).parents[3] / "meshes" / "solids"

# Pulled along x and free to contract: the left end slides in its plane, and lines and points keep the body in its place.
PULLED: dict[str, Any] = {
    "material": {"young": 200e9, "poisson": 0.2},
    "model": {"law": "nhpd", "horizon_factor": 2.5},
    "correction": {"surface": "patch"},
    "support": [
        {"group": "left", "displacement": {"x": 0.0}},
        {"group": "origin", "displacement": {"y": 0.0, "z": 0.0}},
        {"group": "above", "displacement": {"y": 0.0}},
    ],
    "load": [{"group": "right", "displacement": {"x": 2e-6}}],
}
SIDES = (0.2, 0.1, 0.1)


def block(kind: str, n: tuple[int, int, int] = (8, 4, 4)) -> tuple[np.ndarray, dict[str, np.ndarray], dict[str, np.ndarray]]:
    """Nodes of a block, its cells of a kind, and the faces of its left and right end (quadrangles, or halves of them)."""
    along = [np.linspace(0.0, side, count + 1) for side, count in zip(SIDES, n, strict=True)]
    points = np.stack(np.meshgrid(*along, indexing="ij"), axis=-1).reshape(-1, 3)
    number = np.arange(len(points)).reshape(*(count + 1 for count in n))
    corner = {(i, j, k): number[i : n[0] + i, j : n[1] + j, k : n[2] + k].ravel() for i in (0, 1) for j in (0, 1) for k in (0, 1)}
    order = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)]
    hexahedra = np.column_stack([corner[it] for it in order])
    # Every split has its diagonals along (1, 1, 0), (0, 1, 1) and (1, 0, 1), so that neighbours fit.
    parts = {
        "hexahedron": [(0, 1, 2, 3, 4, 5, 6, 7)],
        "wedge": [(0, 1, 2, 4, 5, 6), (0, 2, 3, 4, 6, 7)],
        "tetra": [(0, 1, 2, 6), (0, 2, 3, 6), (0, 3, 7, 6), (0, 7, 4, 6), (0, 4, 5, 6), (0, 5, 1, 6)],
    }[kind]
    cells = np.concatenate([hexahedra[:, part] for part in parts])
    ends = {"left": hexahedra[hexahedra[:, 0] < (n[1] + 1) * (n[2] + 1)][:, [0, 4, 7, 3]]}
    ends["right"] = hexahedra[points[hexahedra[:, 1], 0] == SIDES[0]][:, [1, 2, 6, 5]]
    if kind == "tetra":
        # Both splits of a face have its first and third corner.
        ends = {name: np.concatenate([quads[:, :3], quads[:, [0, 2, 3]]]) for name, quads in ends.items()}
    return points, {kind: cells}, ends


def pins(points: np.ndarray) -> dict[str, np.ndarray]:
    middle = (points[:, 0] == 0) & np.isclose(points[:, 1], SIDES[1] / 2)
    return {"origin": middle & np.isclose(points[:, 2], SIDES[2] / 2), "above": middle & np.isclose(points[:, 2], SIDES[2])}


@pytest.mark.parametrize("kind", ["hexahedron", "wedge", "tetra"])
def test_a_solid_of_cells_pulls_as_stiff_as_its_material(kind: str) -> None:
    points, cells, ends = block(kind)
    setup = ligament.Setup(positions=points, cells=cells, faces=ends, groups=pins(points), **PULLED)
    assert setup.is_solid and setup.n_points == 9 * 5 * 5
    assert set(setup.groups) == {"left", "right", "origin", "above"}
    result = ligament.run(setup, progress=False)
    # F = E A u/L; the patch correction is exact but for its tolerance, which leaves tenths of a percent.
    assert result.columns["reaction"][-1] == pytest.approx(200e9 * 0.1 * 0.1 * 2e-6 / 0.2, rel=5e-3)
    assert result.points["position"].shape == (225, 3) and result.is_solid
    assert result.points["volume"].sum() == pytest.approx(0.2 * 0.1 * 0.1, rel=1e-12)
    moved = result.field("displacement")
    # Contraction by nu in both directions across.
    at = result.points["position"]
    for axis in (1, 2):
        slope = np.polyfit(at[:, axis], moved[:, axis], 1)[0]
        assert slope == pytest.approx(-0.2 * 1e-5, rel=0.03)


def twisted() -> dict[str, Any]:
    sections = copy.deepcopy(PULLED)
    sections["support"] = [{"group": "left", "displacement": dict.fromkeys(
        ("x", "y", "z", "rotation_x", "rotation_y", "rotation_z"), 0.0)}]
    sections["load"] = [
        {"name": "along-y", "group": "right", "displacement": {"y": -1e-5}, "profile": {"along": "z", "zero": 0.05, "one": 0.1}},
        {"name": "along-z", "group": "right", "displacement": {"z": 1e-5}, "profile": {"along": "y", "zero": 0.05, "one": 0.1}},
    ]
    return sections


def test_points_turn_about_three_axes() -> None:
    points, cells, ends = block("hexahedron")
    result = ligament.run(ligament.Setup(positions=points, cells=cells, faces=ends, **twisted()), progress=False)
    turned = result.field("rotation")
    assert turned.shape == (len(points), 3)
    # The right end turns by 1e-5/0.05 about x, and sections between it and the left one by their share.
    at = result.points["position"]
    middle = np.isclose(at[:, 0], 0.1) & np.isclose(at[:, 1], 0.05) & np.isclose(at[:, 2], 0.05)
    assert turned[middle, 0] == pytest.approx(0.5 * 1e-5 / 0.05, rel=0.05)
    assert np.abs(turned[middle, 1:]).max() < 0.02 * turned[middle, 0].max()
    moved = result.field("displacement")
    assert moved.shape == (len(points), 3) and np.abs(moved[:, 2]).max() == pytest.approx(1e-5, rel=1e-9)


def test_points_with_volumes_are_those_of_the_lattice() -> None:
    h, n = 0.01, (12, 5, 5)
    along = [h * (0.5 + np.arange(count)) for count in n]
    # In the order of the lattice: x runs fastest.
    at = np.stack(np.meshgrid(*along[::-1], indexing="ij"), axis=-1).reshape(-1, 3)[:, ::-1]
    sections: dict[str, Any] = {
        "material": {"young": 200e9, "poisson": 0.2},
        "model": {"law": "nhpd", "horizon_factor": 3.0},
        "correction": {"surface": "volume"},
        "support": [{"group": "left", "displacement": {"x": 0.0, "y": 0.0, "z": 0.0}}],
        "load": [{"group": "right", "displacement": {"x": 1e-5}}],
    }
    x = at[:, 0]
    setup = ligament.Setup(positions=at, volumes=h**3, groups={"left": x < 2 * h, "right": x > 10 * h}, **sections)
    lattice = {
        **sections,
        "solid_lattice": {"cells": list(n), "spacing": [h, h, h], "set": {"left": {"left": 2}, "right": {"right": 2}}},
    }
    a, b = (ligament.run(case, progress=False) for case in (setup, lattice))
    np.testing.assert_allclose(a.points["position"], b.points["position"], atol=1e-15)
    assert a.columns["reaction"][-1] == pytest.approx(b.columns["reaction"][-1], rel=1e-9)
    np.testing.assert_allclose(a.field("displacement"), b.field("displacement"), atol=1e-9 * 1e-5)


def test_a_mesh_of_meshio_and_its_file_are_one_body(tmp_path: Path) -> None:
    meshio = pytest.importorskip("meshio")
    path = MESHES / "extruded-plate.msh"
    setup = ligament.Setup(meshio.read(path), **PULLED)
    case = ligament.Case({**PULLED, "mesh": {"file": str(path)}})
    assert setup.is_solid
    volumes = []
    for source in (setup, case):
        changed = source.with_changes(
            support=[{"group": "left", "displacement": {"x": 0.0, "y": 0.0, "z": 0.0}}], correction__surface="domain")
        result = ligament.run(changed, progress=False)
        volumes.append(result.points["volume"].sum())
    assert volumes[0] == pytest.approx(volumes[1], rel=1e-12)


def test_the_live_model_of_gmsh_is_a_solid() -> None:
    try:
        import gmsh
    except (ImportError, OSError) as error:
        pytest.skip(f"gmsh cannot be used here: {error}")
    gmsh.initialize(interruptible=False)
    try:
        gmsh.option.setNumber("General.Terminal", 0)
        gmsh.model.occ.addBox(0, 0, 0, *SIDES)
        gmsh.model.occ.synchronize()
        gmsh.model.addPhysicalGroup(2, [1], name="left")
        gmsh.model.addPhysicalGroup(2, [2], name="right")
        gmsh.option.setNumber("Mesh.MeshSizeMax", 0.03)
        gmsh.model.mesh.generate(3)
        sections = {**PULLED, "support": [{"group": "left", "displacement": {"x": 0.0, "y": 0.0, "z": 0.0}}]}
        setup = ligament.Setup(gmsh, **sections)
    finally:
        gmsh.finalize()
    assert setup.is_solid and sorted(setup.groups) == ["left", "right"]
    result = ligament.run(setup, progress=False)
    # Held at the left end in all directions: stiffer than E A/L, by less than a tenth in a block twice as long as wide.
    assert 1.0 < result.columns["reaction"][-1] / (200e9 * 0.1 * 0.1 * 2e-6 / 0.2) < 1.1


def test_pyvista_has_the_cells() -> None:
    pyvista = pytest.importorskip("pyvista")
    for kind in ("hexahedron", "tetra", "wedge"):
        points, cells, ends = block(kind, (4, 2, 2))
        setup = ligament.Setup(positions=points, cells=cells, faces=ends, groups=pins(points), **PULLED)
        result = ligament.run(setup, progress=False, correction__surface="volume")
        grid = result.to_pyvista()
        assert grid.n_cells == len(cells[kind])
        assert grid.volume == pytest.approx(0.2 * 0.1 * 0.1, rel=1e-9)
        assert grid.point_data["displacement"].shape == (len(points), 3)
    lattice = {k: v for k, v in PULLED.items() if k not in ("correction", "support")}
    result = ligament.run({
        **lattice,
        "solid_lattice": {"cells": [6, 4, 4], "spacing": [0.01] * 3, "set": {"left": {"left": 1}, "right": {"right": 1}}},
        "support": [{"group": "left", "displacement": {"x": 0.0, "y": 0.0, "z": 0.0}}],
    }, progress=False)
    grid = result.to_pyvista()
    assert isinstance(grid, pyvista.UnstructuredGrid) and grid.n_cells == 96
    assert grid.volume == pytest.approx(96e-6, rel=1e-9)


def test_modes_of_a_solid_move_along_z() -> None:
    points, cells, _ = block("hexahedron", (4, 3, 3))
    setup = ligament.Setup(
        positions=points, cells=cells, analysis="modal", modal={"modes": 8},
        material={"young": 200e9, "poisson": 0.2, "density": 7800.0}, model={"law": "nhpd", "horizon_factor": 3.0},
    )
    modes = ligament.modal(setup)
    assert modes.kind[:6] == ["rigid"] * 6 and modes.kind[6] == "elastic"
    assert modes.participation.shape[1] == 6 and modes.position.shape == (len(points), 3)
    assert modes.mass == pytest.approx(7800.0 * 0.2 * 0.1 * 0.1)
    assert any(np.abs(modes.shape(mode)[:, 2]).max() > 0 for mode in range(8))


def test_what_is_of_the_plane_alone_is_refused() -> None:
    points, cells, ends = block("hexahedron", (4, 2, 2))
    body = {"positions": points, "cells": cells, "faces": ends, "groups": pins(points)}
    with pytest.raises(ligament.CaseError, match="thickness.*solid") as error:
        ligament.Setup(**body, thickness=0.1, **PULLED)
    assert error.value.key == "mesh.thickness"
    with pytest.raises(ligament.CaseError, match="three coordinates"):
        ligament.Setup(**body, **{**PULLED, "load": [{"box": [[0.1, 0], [0.3, 1]], "displacement": {"x": 1e-6}}]})
    result = ligament.run(ligament.Setup(**body, **PULLED), progress=False, correction__surface="volume")
    with pytest.raises(ligament.LigamentError, match="a solid; `crack_surface`"):
        result.crack_path()
    assert "<table>" in result._repr_html_()


def test_arrays_that_are_no_solid_are_refused() -> None:
    points, cells, ends = block("tetra", (2, 2, 2))
    flat = np.array([[0.0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]])
    inside = points.copy()
    inside[13] = [-0.3, 0.05, 0.05]
    for arguments, words in [
        ({"positions": points, "volumes": 1.0, "areas": 1.0}, "`volumes`"),
        ({"positions": points, "areas": 1.0}, "`volumes`"),
        ({"positions": points, "volumes": -1.0}, "volumes greater than 0"),
        ({"positions": points[:, :2], "cells": cells}, r"\(n, 3\)"),
        ({"positions": points, "cells": {"tetrahedron": cells["tetra"]}}, "there are vertex"),
        ({"positions": points, "cells": {"tetra": cells["tetra"][:, :3]}}, r"\(n, 4\)"),
        ({"positions": points, "cells": {"tetra": cells["tetra"] + 20}}, "outside of 0 to 26"),
        ({"positions": points, "cells": cells, "faces": {"left": [[0, 1, 26]]}}, "face of no solid cell"),
        ({"positions": flat, "cells": {"tetra": [[0, 1, 2, 3]]}}, "is flat"),
        ({"positions": inside, "cells": cells}, "overlaps"),
        ({"positions": points, "cells": {"triangle": ends["left"], "quad": [[0, 1, 2, 26]]}}, "no solid cells"),
    ]:
        with pytest.raises(ligament.LigamentError, match=words):
            ligament.Setup(**arguments, **PULLED)


def test_tetrahedra_that_are_turned_over_are_turned_back() -> None:
    points, cells, ends = block("tetra", (4, 2, 2))
    turned = {"tetra": cells["tetra"][:, [1, 0, 2, 3]]}
    forces = []
    for body in (cells, turned):
        setup = ligament.Setup(positions=points, cells=body, faces=ends, groups=pins(points), **PULLED)
        forces.append(ligament.run(setup, progress=False, correction__surface="volume").columns["reaction"][-1])
    assert forces[0] == pytest.approx(forces[1], rel=1e-12)
