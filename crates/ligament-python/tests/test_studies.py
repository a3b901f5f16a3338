"""Many runs, calibration, natural modes."""

from typing import Any

import ligament
import numpy as np
import pytest


def test_a_sweep_has_a_run_for_each_combination(plate: dict[str, Any]) -> None:
    plate["lattice"]["cells"] = [12, 18]
    plate["lattice"]["spacing"] = 0.005
    axes = {"model.horizon_factor": [2.0, 3.0], "material__tensile_strength": [3e6, 4e6]}
    one, two = (ligament.sweep(plate, axes, jobs=jobs) for jobs in (1, 2))
    assert len(one) == 4 and list(one.settings[1].values()) == [2.0, 4e6]
    peaks = one.numbers("first_peak.reaction")
    # Brittle bonds: loads grow in proportion to the strength, up to where the steps lie.
    assert peaks[1] > peaks[0] and peaks[3] > peaks[2]
    assert peaks == two.numbers("first_peak.reaction"), "runs at once have the same bits"
    table = one.table
    assert list(table["model.horizon_factor"]) == [2.0, 2.0, 3.0, 3.0]
    assert list(table["first_peak.reaction"]) == peaks
    assert "horizon_factor 3" in one.curves().svg
    with pytest.raises(ligament.CaseError):
        ligament.sweep(plate, {"model.horizon_factor": [2.0, "three"]})


def test_a_strength_is_calibrated(plate: dict[str, Any]) -> None:
    plate["lattice"]["cells"] = [12, 18]
    plate["lattice"]["spacing"] = 0.005
    plate["fracture"] = {"control": "event", "stop": {"bonds": 5}}
    # Along the exact path loads are in proportion to the strength, so that two runs suffice.
    before = ligament.run(plate, progress=False).number("first_break.reaction")
    found = ligament.calibrate(plate, "material.tensile_strength", 2 * before, of="first_break.reaction", within=1e-6)
    assert found.value == pytest.approx(2 * 3.81e6, rel=1e-6) and len(found.trials) == 2
    with pytest.raises(ligament.NotCalibrated, match="out-of-reach"):
        ligament.calibrate(plate, "material.tensile_strength", 9 * before, of="first_break.reaction", limits=(3e6, 4e6))
    with pytest.raises(ligament.LigamentError, match="did you mean `first_peak.reaction`"):
        ligament.calibrate(plate, "material.tensile_strength", 1.0, of="first_peak.reacton")


def test_modes_of_a_free_plate(plate: dict[str, Any]) -> None:
    for section in ("fracture", "no_fail", "precrack", "load", "support", "output"):
        plate.pop(section)
    plate["material"]["density"] = 2700.0
    found = ligament.modal({**plate, "analysis": "modal", "modal": {"modes": 5}})
    assert found.kind == ["rigid"] * 3 + ["elastic"] * 2
    assert found.mass == pytest.approx(2700 * 24 * 36 * 0.0025**2 * 0.01)
    assert found.shape(3).shape == (24 * 36, 3) and np.all(np.diff(found.frequency) >= 0)
    assert list(found.table["kind"]) == found.kind
    with pytest.raises(ligament.LigamentError, match="modal"):
        ligament.run({**plate, "analysis": "modal"})


def test_a_sample_of_an_ensemble_is_the_run_of_its_seed(plate: dict[str, Any]) -> None:
    plate["lattice"]["cells"] = [12, 18]
    plate["lattice"]["spacing"] = 0.005
    plate["material"]["fracture_energy"] = 20.0
    strength, energy = {"of": "strength", "modulus": 12.0}, {"of": "fracture-energy", "modulus": 9.0}
    criteria = [{"kind": "tension"}, {"kind": "critical-stretch"}]
    plate["fracture"] = {"control": "event", "stop": {"bonds": 5}, "scatter": [strength, energy], "criterion": criteria}
    found = ligament.ensemble(plate, samples=3, seed=7)
    assert len(found) == 3 and len(set(found.seeds)) == 3
    assert found.first_break.sum() > 0.0 and np.all(found.damaged >= found.first_break)
    alone = ligament.run(plate, progress=False, fracture__scatter__0__seed=int(found.seeds[2]))
    # Of the summary `first_break` is foretold from the elastic solution; the history has the event itself.
    assert found.first[2] == alone.history["reaction"].iloc[1], "the same bits"


def test_results_have_intervals_of_convergence(plate: dict[str, Any]) -> None:
    found = ligament.converge(plate, of=["elastic_stiffness", "peak.reaction"])
    stiffness, peak = found["elastic_stiffness"], found["peak.reaction"]
    assert stiffness.lower is not None and stiffness.upper is not None and stiffness.at_h is not None
    assert stiffness.lower < stiffness.at_h < stiffness.upper and stiffness.at_h in stiffness
    assert stiffness.unit == "N/m" and stiffness.refused is None
    # Bonds that break at once by a strength at the tip of the crack.
    assert peak.lower is None and "pre-crack" in (peak.refused or "")
    assert list(found.table["name"]) == ["elastic_stiffness", "peak.reaction"]
    at_h = found.results["h lattice"].number("elastic_stiffness")
    assert at_h == pytest.approx(stiffness.at_h, rel=0.1)
    with pytest.raises(ligament.LigamentError, match="even numbers"):
        ligament.converge(plate, lattice__cells=[25, 36])
