"""Results live on: folders that are saved and opened, copies in other processes, explanations, reports."""

import _thread
import copy
import pickle
import subprocess
import sys
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context
from pathlib import Path
from typing import Any

import ligament
import numpy as np
import pytest


def program(*arguments: str) -> "subprocess.CompletedProcess[str]":
    return subprocess.run([sys.executable, "-m", "ligament", *arguments], text=True, capture_output=True)


def assert_same(one: Any, other: Any) -> None:
    """Two results with the same bits."""
    for name, column in one.columns.items():
        np.testing.assert_array_equal(column, other.columns[name], err_msg=name)
    assert one.steps == other.steps and one.field_names == other.field_names and one.title == other.title
    for step in one.steps:
        for name in one.field_names:
            np.testing.assert_array_equal(one.field(name, step), other.field(name, step), err_msg=name)
    for arrays in ("points", "bonds"):
        for name, values in getattr(one, arrays).items():
            np.testing.assert_array_equal(values, getattr(other, arrays)[name], err_msg=name)


def test_a_result_is_saved_and_opened(result: Any, tmp_path: Path) -> None:
    saved = result.save(tmp_path / "kept")
    opened = ligament.open(saved)
    assert_same(result, opened)
    assert opened.summary == result.summary and opened.folder == saved
    with pytest.raises(ligament.LigamentError, match="results"):
        result.save(saved)
    assert result.save(saved, replace=True) == saved
    with pytest.raises(ligament.LigamentError, match="there is no such folder"):
        ligament.open(tmp_path / "nowhere")


def test_a_folder_goes_with_its_result(plate: dict[str, Any], tmp_path: Path) -> None:
    result = ligament.run(plate, progress=False)
    folder = result.folder
    assert folder.is_dir()
    del result
    assert not folder.exists()
    kept = ligament.run(plate, progress=False, folder=tmp_path / "kept")
    del kept
    assert ligament.open(tmp_path / "kept").termination
    with pytest.raises(ligament.SolutionError, match="kept"):
        ligament.run(plate, progress=False, folder=tmp_path / "kept")
    ligament.run(plate, progress=False, folder=tmp_path / "kept", replace=True)


def test_the_program_takes_what_was_saved(plate: dict[str, Any], tmp_path: Path) -> None:
    saved = str(ligament.run(plate, progress=False).save(tmp_path / "kept"))
    for command in (["plot"], ["crack"], ["report"], ["explain", "--point", "30"], ["repeat"]):
        done = program(command[0], saved, *command[1:])
        assert done.returncode == 0, (command, done.stderr)


def test_results_of_the_program_are_opened(plate: dict[str, Any], result: Any, tmp_path: Path) -> None:
    case = tmp_path / "case.toml"
    case.write_text(ligament.Case(plate).to_toml())
    assert program("run", str(case), "--out", str(tmp_path / "out"), "--quiet").returncode == 0
    assert_same(result, ligament.open(tmp_path / "out"))


def bodies() -> dict[str, ligament.Setup]:
    x, y = (it.ravel() for it in np.meshgrid(0.005 + 0.01 * np.arange(12), 0.005 + 0.01 * np.arange(6)))
    sections: Any = {
        "material": {"young": 210e9, "poisson": 0.25}, "model": {"law": "nhpd", "horizon_factor": 3.0},
        "correction": {"surface": "volume"},
        "support": [{"group": "left", "displacement": {"x": 0.0, "y": 0.0}}],
        "load": [{"group": "right", "force": {"x": 1e3}, "profile": lambda x, y: 1.0 + 5.0 * y}],
        "temperature": [{"change": lambda x, y: 10.0 if x < 0.06 else 20.0}],
    }
    sections["material"]["thermal_expansion"] = 1e-5
    at, groups = np.column_stack([x, y]), {"left": x < 0.02, "right": x > 0.1}
    n = np.arange(72).reshape(6, 12)
    cells = np.stack([n[:-1, :-1], n[:-1, 1:], n[1:, 1:], n[1:, :-1]], axis=-1).reshape(-1, 4)
    edge = lambda column: np.column_stack([n[:-1, column], n[1:, column]])  # noqa: E731
    return {
        "points": ligament.Setup(positions=at, areas=1e-4, thickness=0.1, groups=groups, **sections),
        "cells": ligament.Setup(
            positions=at, cells={"quad": cells}, thickness=0.1, faces={"left": edge(0), "right": edge(-1)}, **sections),
    }


@pytest.mark.parametrize("kind", ["points", "cells"])
def test_bodies_and_functions_in_memory_are_kept_with_the_results(kind: str, tmp_path: Path) -> None:
    setup = bodies()[kind]
    result = ligament.run(setup, progress=False)
    warm = result.field("temperature_change")
    np.testing.assert_array_equal(warm, np.where(result.points["position"][:, 0] < 0.06, 10.0, 20.0))
    saved = result.save(tmp_path / "kept")
    del setup, result
    moved = saved.rename(tmp_path / "moved")
    repeated = program("repeat", str(moved))
    assert repeated.returncode == 0 and "the same to the last bit" in repeated.stdout, repeated.stderr
    assert program("explain", str(moved), "--at", "0.05,0.02").returncode == 0
    assert program("plot", str(moved), "--field", "displacement.x").returncode == 0


def test_a_load_follows_its_function() -> None:
    sections: Any = {
        "lattice": {"cells": [10, 10], "spacing": 0.01, "set": {"left": {"left": 1}, "right": {"right": 1}}},
        "material": {"young": 1e9, "poisson": 0.2}, "model": {"law": "nhpd", "horizon_factor": 3.0},
        "support": [{"group": "left", "displacement": {"x": 0.0, "y": 0.0}}],
    }
    moved = {"group": "right", "displacement": {"x": 1e-5}}
    linear = ligament.run({**sections, "load": [{**moved, "profile": {"along": "y", "zero": 0.0, "one": 0.1}}]}, progress=False)
    given = ligament.run({**sections, "load": [{**moved, "profile": lambda x, y: y / 0.1}]}, progress=False)
    np.testing.assert_allclose(given.field("displacement"), linear.field("displacement"), rtol=1e-12, atol=1e-20)
    with pytest.raises(ligament.CaseError, match="no finite value at"):
        ligament.run({**sections, "load": [{**moved, "profile": lambda x, y: np.inf * y}]}, progress=False)


def summed(setup: Any, young: float) -> Any:
    return ligament.run(setup.with_changes(material__young=young), progress=False)


@pytest.mark.parametrize("kind", ["points", "cells"])
def test_setups_and_results_go_to_other_processes(kind: str) -> None:
    setup = bodies()[kind]
    again = pickle.loads(pickle.dumps(setup))
    assert type(again) is ligament.Setup and again.groups == setup.groups and again.n_points == setup.n_points
    assert copy.deepcopy(setup).n_points == setup.n_points
    with ProcessPoolExecutor(2, mp_context=get_context("spawn")) as pool:
        results = list(pool.map(summed, [setup, setup], [1e9, 2e9]))
    assert_same(results[1], summed(setup, 2e9))
    assert_same(copy.deepcopy(results[0]), pickle.loads(pickle.dumps(results[0])))


@pytest.mark.usefixtures("interruptible")
def test_a_run_that_was_stopped_goes_on(plate: dict[str, Any], tmp_path: Path) -> None:
    plate["fracture"]["steps"] = 400
    whole = ligament.run(plate, progress=False)
    with pytest.raises(ligament.Interrupted) as stopped:
        ligament.run(plate, progress=lambda step, *_: _thread.interrupt_main() if step == 3 else None)
    result = stopped.value.result
    assert result.termination == "stopped" and 3 <= result.columns["step"][-1] < whole.columns["step"][-1]
    saved = result.save(tmp_path / "kept")
    assert program("resume", str(saved)).returncode == 0
    resumed = ligament.open(saved)
    assert resumed.termination == whole.termination
    np.testing.assert_array_equal(resumed.columns["reaction"], whole.columns["reaction"])


def test_a_run_under_way_is_opened(result: Any, tmp_path: Path) -> None:
    saved = result.save(tmp_path / "kept")
    # What a run has written in its midst: no summary yet, and a row that is just being written.
    (saved / "summary.json").unlink()
    history = (saved / "history.csv").read_text().splitlines()
    (saved / "history.csv").write_text("\n".join(history[:6]) + "\n" + history[6][:20])
    (saved / "fields_0010.vtu").unlink(), (saved / "fields_0011.vtu").unlink()
    opened = ligament.open(saved)
    assert not opened.is_finished and opened.termination == "unfinished" and "unfinished" in repr(opened)
    assert opened.steps == [0, 5] and list(opened.columns["step"]) == [0, 1, 2, 3, 4]
    assert opened.field("damage", 5).max() == result.field("damage", 5).max()
    assert "has not come to its end" in opened._repr_html_()
    with pytest.raises(ligament.LigamentError, match="ligament resume"):
        opened.number("peak.reaction")


def test_explanations_and_reports(result: Any, tmp_path: Path) -> None:
    words = result.explain(at=(0.022, 0.001))
    assert "bonds" in words and repr(words) == str(words)
    ends = result.bonds["ends"][~result.bonds["intact"]][0]
    pair = tuple(int(result.points["cell"][it]) for it in ends)
    assert "broke" in result.explain(bond=pair)
    assert f"cell {pair[0]}" in result.explain(pair[0])
    with pytest.raises(ligament.LigamentError, match="one of `point`"):
        result.explain()
    page = result.report(tmp_path / "report.html")
    assert page.read_text().lstrip().lower().startswith("<!doctype html") and result.title in page.read_text()
    assert result.report(page) == page
    assert result.report(tmp_path / "small.html", digits=2, steps=2).stat().st_size < page.stat().st_size
    with pytest.raises(ligament.LigamentError, match="2 to 8 digits"):
        result.report(page, digits=9)
    assert ligament.report([result, result], tmp_path / "both.html").stat().st_size > page.stat().st_size


def test_natural_modes_are_kept_and_opened_as_results_are(tmp_path: Path) -> None:
    case = Path(__file__).resolve().parents[3] / "cases/modal-plate/case.toml"
    assert program("run", str(case), "--out", str(tmp_path / "out")).returncode == 0
    opened, found = ligament.open(tmp_path / "out"), ligament.modal(case, folder=tmp_path / "found")
    assert isinstance(opened, ligament.Modes) and found.folder == tmp_path / "found"
    opened = ligament.open(tmp_path / "out", ligament.Modes)
    with pytest.raises(ligament.LigamentError, match="has natural modes; `ligament.open"):
        ligament.open(tmp_path / "out", ligament.Result)
    same_modes(opened, found)
    for copied in (pickle.loads(pickle.dumps(found)), copy.deepcopy(found), ligament.open(found.save(tmp_path / "kept"))):
        same_modes(copied, found)
    with pytest.raises(ligament.LigamentError, match="replace=True"):
        found.save(tmp_path / "kept")
    with pytest.raises(ligament.LigamentError, match="counted from 0"):
        found.shape(len(found))
    assert "case.resolved.toml" in {it.name for it in found.save(tmp_path / "kept", replace=True).iterdir()}


def same_modes(one: Any, other: Any) -> None:
    assert len(one) == len(other) > 3 and one.title == other.title and one.mass == other.mass
    assert np.array_equal(one.frequency, other.frequency) and np.array_equal(one.participation, other.participation)
    assert all(np.array_equal(one.shape(mode), other.shape(mode)) for mode in range(len(one)))


def test_errors_name_what_python_takes(result: Any) -> None:
    for asked, words in (
        (lambda: result.explain(at=(0.0, 0.0, 0.0)), r"two coordinates; give `at=\(X, Y\)`"),
        (lambda: result.plot(view="x"), "leave out `view`"),
        (lambda: result.plot(level=0.1), "leave out `level`"),
        (lambda: result.explain(bond=(5, 5)), "give `point=5`"),
    ):
        with pytest.raises(ligament.LigamentError, match=words) as error:
            asked()
        assert "--" not in str(error.value)


SPLIT: Any = {
    "title": "A bar that is pulled apart",
    "solid_lattice": {"cells": [12, 5, 5], "spacing": [0.01] * 3, "set": {"left": {"left": 2}, "right": {"right": 2}}},
    "material": {"young": 30e9, "poisson": 0.2, "tensile_strength": 3e6},
    "model": {"law": "nhpd", "horizon_factor": 2.5},
    "support": [{"group": "left", "displacement": {"x": 0.0, "y": 0.0, "z": 0.0}}],
    "load": [{"group": "right", "displacement": {"x": 3e-5}}],
    "no_fail": [{"group": "left"}, {"group": "right"}],
    "fracture": {"steps": 6},
}


def test_the_crack_of_a_solid_is_a_surface(tmp_path: Path) -> None:
    result = ligament.run(SPLIT, progress=False)
    assert result.summary["broken_bonds"] > 0
    surface = result.crack_surface()
    # Split across: about the section of 5 by 5 cells, or two of them.
    assert 0.5 * 25e-4 < surface.area < 4 * 25e-4
    assert surface.triangles.shape[1] == 3 and surface.places.shape == (len(surface.opening), 3)
    assert surface.triangles.max() < len(surface.places) and surface.opening.max() > 0
    assert len(surface.part) == len(surface.is_precrack) == len(surface.triangles) and not surface.is_precrack.any()
    corners = surface.places[surface.triangles]
    areas = 0.5 * np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1)
    assert areas.sum() == pytest.approx(surface.area, rel=1e-12)
    assert len(result.crack_surface(0).triangles) == 0
    saved = result.save(tmp_path / "kept")
    assert program("crack", str(saved)).returncode == 0
    for picture in (result.plot(), result.plot("displacement.x", crack="bonds", view="x"), result.plot(section="z=0.02")):
        assert len(picture.svg) > 1000
    assert "bonds" in result.explain(at=(0.05, 0.02, 0.02))
    assert result.report(tmp_path / "solid.html").stat().st_size > 10_000


def test_a_refined_case_has_its_passes_and_its_last_mesh() -> None:
    case = Path(__file__).parents[3] / "cases" / "verification" / "refined-edge-crack.toml"
    result = ligament.run(case, refine__levels=1, refine__passes=2, progress=False)
    first, last = result.summary["refinement"]["passes"]
    assert last["points"] == result.summary["points"] > first["points"]
    assert result.summary["refinement"]["last"] in ("all-passes", "same-mesh")
    assert (result.folder / "mesh.msh").is_file() and (result.folder / "places.csv").is_file()
    repeated = program("repeat", str(result.folder))
    assert repeated.returncode == 0, repeated.stderr
