"""Runs that go on row by row."""

from typing import Any

import numpy as np
import pytest

import ligament

PLATE: dict[str, Any] = {
    "lattice": {
        "cells": [24, 12], "spacing": 0.0025, "thickness": 0.01, "set": {"left": {"left": 2}, "right": {"right": 2}},
    },
    "material": {"young": 15e9, "poisson": 0.21, "tensile_strength": 3.81e6},
    "model": {"law": "nhpd", "horizon_factor": 3.0},
    "support": [{"group": "left", "displacement": {"x": 0.0, "y": 0.0}}],
    "precrack": [{"points": [[0.03, -0.001], [0.03, 0.0101]]}],
    "load": [{"group": "right", "displacement": {"x": 2e-5}}],
    "probe": [{"name": "end", "between": [[0.001, 0.015], [0.059, 0.015]], "component": "x"}],
    "fracture": {"steps": 10},
}


EVENTS: dict[str, Any] = {"fracture__control": "event", "fracture__steps": None, "fracture__stop": {"bonds": 40}}
MOTION: dict[str, Any] = {
    "analysis": "motion", "fracture__steps": None, "material__density": 2400.0, "motion": {"duration": 4e-5, "rows": 20},
    "load": [{"group": "right", "velocity": {"x": 1.0}, "amplitude": {"shape": "smooth-ramp", "duration": 1e-5}}],
}
IMPLICIT: dict[str, Any] = {**MOTION, "motion": {"duration": 4e-5, "rows": 20, "scheme": "auto", "step": 1e-6}}


@pytest.mark.parametrize("changes", [{}, EVENTS, MOTION, IMPLICIT])
def test_rows_have_the_bits_of_a_run(changes: dict[str, Any]) -> None:
    rows = ligament.begin(PLATE, **changes)
    found = list(rows)
    result = ligament.run(PLATE, progress=False, **changes)
    assert rows.termination == result.termination
    assert rows.termination_message
    history = result.history
    assert len(found) == len(history["step"]) > 3
    for name in ["step", "load_factor", "reaction", "stored_energy", "broken_bonds", "end"]:
        assert [row[name] for row in found] == list(history[name]), name


def test_the_body_is_that_of_its_row() -> None:
    result = ligament.run(PLATE, progress=False, output__fields_every=1)
    rows = ligament.begin(PLATE)
    for row in rows:
        if row["broken_bonds"] > 0:
            break
    assert row["broken_bonds"] > 0
    assert np.array_equal(rows.displacement, result.field("displacement", row["step"])[:, :2])
    assert np.array_equal(rows.damage, result.field("damage", row["step"]))


def test_a_run_takes_another_load_and_is_left() -> None:
    rows = ligament.begin(PLATE)
    first = next(rows)
    assert first["load_factor"] == 0.0
    rows.set_next_load_factor(0.25)
    second = next(rows)
    assert second["load_factor"] == 0.25
    assert rows.displacement.shape == (288, 2)
    assert rows.displacement[:, 0].max() == pytest.approx(0.25 * 2e-5)
    assert rows.damage.max() == 0.0
    assert rows.termination is None


def test_what_cannot_be_is_told() -> None:
    events = ligament.begin(PLATE, fracture__control="event", fracture__steps=None)
    next(events)
    with pytest.raises(ligament.LigamentError, match="load step") as caught:
        events.set_next_load_factor(0.5)
    assert caught.value.hint is not None
    with pytest.raises(ligament.CaseError):
        ligament.begin(PLATE, model__law="nhp")
    with pytest.raises(ligament.LigamentError, match="nowhere"):
        ligament.begin(PLATE, load__0__group="nowhere")
