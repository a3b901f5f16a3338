"""Results: the same numbers as the files of the program, arrays that are not copied, pictures."""

import copy
import csv
import importlib.util
import json
import pickle
import re
import subprocess
import sys
import xml.etree.ElementTree as ElementTree
from pathlib import Path
from typing import Any

import ligament
import numpy as np
import pytest


def test_history_is_that_of_the_program_to_the_last_bit(plate: dict[str, Any], result: Any, tmp_path: Path) -> None:
    case = tmp_path / "case.toml"
    case.write_text(ligament.Case(plate).to_toml())
    command = [sys.executable, "-m", "ligament", "run", str(case), "--out", str(tmp_path / "out"), "--quiet"]
    subprocess.run(command, check=True, capture_output=True)
    with open(tmp_path / "out" / "history.csv", newline="") as file:
        rows = list(csv.DictReader(file))
    assert list(rows[0]) == list(result.columns)
    for name, column in result.columns.items():
        written = np.array([float(row[name]) for row in rows])
        np.testing.assert_array_equal(written, np.asarray(column, dtype=float), err_msg=name)
    # Times, memory and the record of files are of a run, not of what it found.
    summary = json.loads((tmp_path / "out" / "summary.json").read_text())
    for of_run in ("provenance", "stages", "solver"):
        summary.pop(of_run)
    assert summary == {name: value for name, value in result.summary.items() if name in summary}


def test_bonds_break_and_agree_with_each_other(result: Any) -> None:
    broken = result.summary["broken_bonds"]
    assert broken > 50
    assert np.count_nonzero(~result.bonds["intact"]) == broken == len(result.breaks)
    assert np.count_nonzero(result.bonds["step_of_breaking"] >= 0) == broken
    ends, at = result.bonds["ends"], result.points["position"]
    length = np.linalg.norm(at[ends[:, 1]] - at[ends[:, 0]], axis=1)
    # Positions of bonds are relative to the middle of the body: the last digits differ.
    np.testing.assert_allclose(length, result.bonds["length"], rtol=1e-12)
    assert result.points["volume"].sum() == pytest.approx(24 * 36 * 0.0025**2 * 0.01)


def address(array: np.ndarray) -> int:
    return int(array.__array_interface__["data"][0])


def test_arrays_are_those_that_the_run_filled(result: Any) -> None:
    for name in ("damage", "displacement", "fragment"):
        array = result.field(name)
        assert address(array) == address(result.field(name)), "one array, whenever it is asked for"
        # NumPy did not allocate the memory: it holds what holds the memory of the run.
        base = getattr(array.base, "base", array.base)
        assert not array.flags.owndata and type(base).__name__ == "PySliceContainer"
    assert not result.points["horizon"].flags.owndata and not result.bonds["ends"].flags.owndata


def test_arrays_are_read_only(result: Any) -> None:
    arrays = [result.field("displacement"), result.field("damage"), result.points["position"], result.points["volume"]]
    arrays += [result.bonds["ends"], result.bonds["intact"], result.columns["reaction"], result.crack_path()[0].points]
    for array in arrays:
        before = array.copy()
        with pytest.raises(ValueError, match="read-only"):
            array[:] = 0
        with pytest.raises(ValueError, match="WRITEABLE"):
            array.reshape(-1).setflags(write=True)
        np.testing.assert_array_equal(array, before)


def test_history_as_a_table_shares_the_arrays(result: Any) -> None:
    pandas = pytest.importorskip("pandas")
    table = result.history
    assert isinstance(table, pandas.DataFrame) and len(table) == len(result.columns["step"])
    assert np.shares_memory(table["reaction"].to_numpy(), result.columns["reaction"])


@pytest.mark.parametrize("there", ["polars", None])
def test_history_without_pandas(result: Any, there: str | None, monkeypatch: pytest.MonkeyPatch) -> None:
    if there:
        pytest.importorskip(there)
    find = importlib.util.find_spec
    monkeypatch.setattr(importlib.util, "find_spec", lambda name: find(name) if name == there else None)
    table = result.history
    assert isinstance(table, dict) if there is None else type(table).__module__.startswith(there)
    assert list(table["reaction"]) == list(result.columns["reaction"])


def test_fields_are_there_for_the_steps_that_are_kept(result: Any) -> None:
    # Every fifth, and the last, in which the plate is split.
    assert result.steps == [0, 5, 10, 11]
    assert result.field("displacement", 0).max() == 0.0
    with pytest.raises(ligament.LigamentError, match="no output of step 3.*output__fields_every=1"):
        result.field("damage", 3)
    with pytest.raises(ligament.LigamentError, match="no field `damages`; did you mean `damage`"):
        result.field("damages")


def test_states_between_breakages_are_read_by_their_names(plate: dict[str, Any], result: Any) -> None:
    seen = ligament.run(plate, output__during_breakage=4, progress=False)
    assert seen.steps == result.steps
    between = [it for it in seen.states if ":" in it]
    assert [it for it in seen.states if ":" not in it] == [str(it) for it in result.steps]
    assert between and seen.states.index(between[-1]) == len(seen.states) - 2
    for state in between:
        step, breakages = map(int, state.split(":"))
        before = int(seen.columns["broken_bonds"][step]) - int(seen.columns["broken_in_step"][step])
        # The ends of the bonds that broke until then are damaged, and no other point is.
        ends = np.concatenate([np.asarray(seen.breaks[name])[: before + breakages] for name in ("cell_a", "cell_b")])
        assert np.count_nonzero(seen.field("damage", state)) == len(np.unique(ends))
        assert seen.plot(step=state).svg
    np.testing.assert_array_equal(seen.columns["reaction"], result.columns["reaction"])


def test_components_and_steps_have_the_names_of_the_command_line(result: Any) -> None:
    whole = result.field("displacement", 10)
    np.testing.assert_array_equal(result.field("displacement.y", 10), whole[:, 1])
    np.testing.assert_array_equal(result.field("displacement.magnitude", 10), np.linalg.norm(whole, axis=1))
    assert np.shares_memory(result.field("displacement.y", 10), whole)
    peak = int(np.argmax(np.where(result.columns["at_rest"], result.columns["reaction"], -np.inf)))
    after = next(step for step in result.steps if step >= result.columns["step"][peak])
    assert result.field("damage", "peak") is result.field("damage", after)
    assert result.field("damage", -1) is result.field("damage", "last") is result.field("damage")
    assert result.field("damage", -2) is result.field("damage", 10)
    for wrong, words in [("displacement_y", "did you mean `displacement.y`"), ("displacement.q", "displacement.x, displacement.y")]:
        for ask in (result.field, result.plot):
            with pytest.raises(ligament.LigamentError, match=words):
                ask(wrong)
    with pytest.raises(ligament.LigamentError, match="step `paek`: expected the number of a step"):
        result.plot(step="paek")
    assert "displacement.y" in result.plot("displacement.y", "peak").svg
    assert len(result.crack_path("last")) == len(result.crack_path(-1)) == len(result.crack_path())


def test_the_history_has_units(result: Any, plate: dict[str, Any]) -> None:
    pytest.importorskip("pandas")
    units = result.history.attrs["units"]
    assert (units["reaction"], units["displacement"], units["stored_energy"], units["step"]) == ("N", "m", "J", "-")
    assert units["top.force_y"] == "N" and result.units is not units and result.units == units
    with pytest.raises(ligament.LigamentError, match="no column `reacton`; did you mean `reaction`"):
        result.curve("displacement", "reacton")
    assert "stored energy" in result.curve("step", "stored_energy").svg


def test_fields_over_steps_and_points_with_units(result: Any) -> None:
    pytest.importorskip("xarray")
    data = result.to_xarray()
    assert dict(data.sizes) == {"step": 4, "point": 24 * 36, "axis": 3}
    assert data["damage"].attrs["units"] == "-" and data["displacement"].attrs["units"] == "m"
    np.testing.assert_array_equal(data["displacement"].sel(step=10, axis="y"), result.field("displacement.y", 10))
    assert data["x"].dims == ("point",) and data["volume"].dims == ("point",)
    last = result.columns["reaction"][-1]
    assert float(data["load_reaction"].sel(step=11)) == last


def test_stresses_of_points_have_components_and_principal_values(plate: dict[str, Any]) -> None:
    del plate["fracture"]
    del plate["precrack"]
    plate["output"] = {"stress": ["material"]}
    plate["probe"] = [{"name": "middle", "at": [0.03125, 0.00125], "field": "stress_principal.1"}]
    result = ligament.run(plate, progress=False)
    stress, principal, direction = (result.field(name) for name in ("stress", "stress_principal", "stress_direction"))
    assert (stress.shape, principal.shape, direction.shape) == ((864, 6), (864, 2), (864, 3))
    # What leaves the trace and the largest component along the direction alone is the same stress.
    np.testing.assert_allclose(principal.sum(axis=1), stress[:, 0] + stress[:, 1], rtol=1e-9, atol=1.0)
    x, y = direction[:, 0], direction[:, 1]
    along = stress[:, 0] * x**2 + stress[:, 1] * y**2 + 2 * stress[:, 3] * x * y
    np.testing.assert_allclose(along, principal[:, 0], rtol=1e-9, atol=1.0)
    place = np.argmin(np.linalg.norm(result.points["position"] - [0.03125, 0.00125], axis=1))
    assert result.columns["middle"][-1] == principal[place, 0]
    # Plane stress.
    assert not stress[:, [2, 4, 5]].any()
    assert "stress.xx" in result.plot("stress.xx").svg
    with pytest.raises(ligament.LigamentError, match="no field `stress.xw`"):
        result.plot("stress.xw")


def test_the_crack_goes_straight_on_from_the_notch(result: Any) -> None:
    lines = result.crack_path()
    assert lines and result.crack_path(0) == []
    longest = max(lines, key=lambda line: line.length)
    # Mode I: along the row of the notch, within a horizon.
    assert np.abs(longest.points[:, 1]).max() < 3 * 0.0025
    assert longest.points[:, 0].min() < 0.0201 + 3 * 0.0025
    assert "pre-crack" in longest.ends


def test_pictures_are_svg(result: Any, tmp_path: Path) -> None:
    for picture in (result.plot(), result.plot("displacement.y", 10), result.curve()):
        root = ElementTree.fromstring(picture.svg)
        parts = list(root.iter())
        corners = sum(len(re.findall(r"[MLml]", it.get("d", ""))) for it in parts)
        assert root.tag.endswith("svg") and len(parts) > 10 and corners > 10, (len(parts), corners)
        for copied in (pickle.loads(pickle.dumps(picture)), copy.deepcopy(picture)):
            assert copied.svg == picture.svg
            first, second = (it.save(tmp_path / "copied.png").read_bytes() for it in (picture, copied))
            assert first == second
    assert result.plot().save(tmp_path / "damage").read_text().startswith("<svg")
    names = ["lambda2.5", "lambda2.75", "a.png", "a.pdf", "a.svg", "no-ending"]
    saved = [result.plot().save(tmp_path / name) for name in names]
    assert [it.name for it in saved] == ["lambda2.5.svg", "lambda2.75.svg", "a.png", "a.pdf", "a.svg", "no-ending.svg"]
    beginnings = [it.read_bytes()[:4] for it in saved]
    assert beginnings == [b"<svg", b"<svg", b"\x89PNG", b"%PDF", b"<svg", b"<svg"]
    with pytest.raises(ligament.LigamentError, match=r"written as \.svg, \.png or \.pdf"):
        result.plot().save(tmp_path / "a.jpg")
    shown = result._repr_html_()
    assert shown.count("<img") == 2 and "broken bonds" in shown


def test_pyvista_has_the_fields(result: Any) -> None:
    pytest.importorskip("pyvista")
    grid = result.to_pyvista(10)
    assert grid.n_cells == 24 * 36
    np.testing.assert_array_equal(grid.cell_data["damage"], result.field("damage", 10))
    np.testing.assert_array_equal(grid.cell_data["displacement"], result.field("displacement", 10))


def test_static_cases_have_a_result(plate: dict[str, Any]) -> None:
    plate.pop("fracture"), plate.pop("no_fail"), plate.pop("output")
    result = ligament.run(plate, progress=False)
    assert result.summary["broken_bonds"] == 0
    assert result.plot().words.startswith("displacement") and result._repr_html_().count("<img") == 1
