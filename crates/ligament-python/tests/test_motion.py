"""Motions in time: setups of their sections, results over the time."""

from typing import Any

import ligament
import numpy as np
import pytest

SPEED = 2.0
BAR: dict[str, Any] = {
    "title": "A wave in a short bar",
    "lattice": {"cells": [60, 4], "spacing": 5e-4, "thickness": 2e-3, "set": {"left": {"left": 1}, "right": {"right": 1}}},
    "material": {"young": 210e9, "poisson": 0.25, "density": 7850.0},
    "model": {"law": "nhpd", "horizon_factor": 3.0},
    "motion": {"duration": 8e-6, "rows": 80},
    "load": [{"group": "left", "velocity": {"x": SPEED}, "amplitude": {"shape": "sine", "duration": 2e-6}}],
    "quiet": [{"group": "right"}],
    "probe": [{"name": "middle", "at": [0.015, 0.001], "field": "velocity.x"}],
    "output": {"fields_every": 20},
}


@pytest.fixture(scope="module")
def wave() -> Any:
    return ligament.run(BAR, progress=False)


def test_the_history_and_its_fields_are_over_the_time(wave: Any) -> None:
    assert wave.is_motion and wave.duration == pytest.approx(8e-6)
    time = np.asarray(wave.history["time"])
    np.testing.assert_allclose(time, np.linspace(0.0, 8e-6, 81), rtol=1e-12, atol=1e-18)
    assert wave.units["time"] == "s" and wave.units["middle"] == "m/s"
    np.testing.assert_allclose(wave.times, [0.0, 2e-6, 4e-6, 6e-6, 8e-6], rtol=1e-12, atol=1e-18)
    assert (wave.field("velocity.x", time=4.9e-6) == wave.field("velocity.x", 40)).all()
    assert (wave.field("velocity.x", "t=0.9e-6") == wave.field("velocity.x", 0)).all()
    with pytest.raises(ligament.LigamentError, match="`step` and `time`"):
        wave.field("velocity.x", 20, time=4e-6)


def test_probes_are_series_over_the_time(wave: Any) -> None:
    assert list(wave.probes) == ["middle"]
    seismogram = np.asarray(wave.probes["middle"])
    assert len(seismogram) == 81
    # The wave is there after 15 mm at sqrt(E/rho) = 5172 m/s and half a microsecond up to its crest.
    crest = wave.history["time"][int(np.argmax(seismogram))]
    assert crest == pytest.approx(0.015 / 5172.2 + 0.5e-6, abs=0.3e-6)
    assert 0.5 * SPEED < seismogram.max() < 1.5 * SPEED


def test_pictures_are_over_the_time(wave: Any) -> None:
    assert "time (µs)" in wave.curve().svg
    energies = wave.curve(y="energies").svg
    assert "kinetic energy" in energies and "damping energy" in energies and "friction" not in energies
    assert "middle (m/s)" in wave.curve(y="probes").svg
    with pytest.raises(ligament.LigamentError, match="draw them separately"):
        wave.curve(y=["middle", "reaction"])
    assert "t = 4.000 µs" in wave.plot("velocity.x", time=4e-6).svg


def test_fields_over_times_and_points(wave: Any) -> None:
    pytest.importorskip("xarray")
    data = wave.to_xarray()
    np.testing.assert_array_equal(data.time, wave.times)
    assert data.time.attrs["units"] == "s" and "load_factor" not in data.coords
    assert data.velocity.dims == ("step", "point", "axis")


def test_statics_have_no_times(result: Any) -> None:
    assert not result.is_motion and result.duration is None and result.times is None
    with pytest.raises(ligament.LigamentError, match="it is no motion"):
        result.field("damage", time=1e-6)


def test_sections_of_motions_are_those_of_a_case() -> None:
    case = {
        **BAR,
        "motion": {"duration": 2e-6, "rows": 4},
        "quiet": None,
        "load": None,
        "initial_velocity": [{"velocity": {"x": -5.0}}],
        "rigid": [{"name": "stop", "shape": "wall", "centre": [-1e-6, 0.0], "normal": [1.0, 0.0], "friction": 0.2}],
    }
    flies = ligament.run({name: it for name, it in case.items() if it is not None}, progress=False)
    assert flies.columns["initial_energy"][0] == pytest.approx(0.5 * 7850.0 * 0.03 * 2e-3 * 2e-3 * 25.0, rel=1e-9)
    sections = ligament.Sections.__annotations__
    for name in ("motion", "initial_velocity", "quiet", "contact", "rigid"):
        assert name in sections and ligament.keys(name), name
    for key in ("load.velocity", "load.amplitude", "load.base_acceleration"):
        assert ligament.keys(key), key
