"""Keys of a case: listed by the package, and as types for editors and mypy."""

import importlib.util
import subprocess
import sys
from pathlib import Path

import ligament
import pytest

SCRIPT = """
import numpy as np
import ligament

setup = ligament.Setup(
    positions=np.zeros((4, 2)), areas=1e-4, groups={"left": [0]},
    material={"young": 210e9, "poisson": 0.25, "tensile_strength": 3e6},
    model={"law": "nhpd", "horizon_factor": 3.0},
    support=[{"group": "left", "displacement": {"x": 0.0, "y": 0.0}}],
    load=[{"at": [0.0, 1.0], "force": {"x": 1e3}, "profile": lambda x, y: x}],
    probe=[{"name": "cmod", "between": [[0.0, 0.0], [0.1, 0.0]], "component": "x"}],
    fracture={"steps": 10, "criterion": [{"kind": "tension"}]},
)
result = ligament.run(setup, model__horizon_factor=2.0)
result = ligament.run({
    "lattice": {"cells": [30, 10], "spacing": 0.01, "set": {"left": {"left": 2}, "right": {"right": 2}}},
    "material": {"concrete": {"young": 30e9, "poisson": 0.2}},
    "model": {"law": "nhpd", "horizon_factor": 3},
    "support": [{"group": "left", "displacement": {"x": 0.0}}],
    "load": [{"group": "right", "displacement": {"x": 1e-4}}],
})
peak: float = result.number("peak.reaction")
damage = result.field("damage", "peak")
ligament.open("folder").plot("displacement.y", -1).save("a.png")
"""

WRONG = {
    '"young": 210e9': '"yung": 210e9',
    '"law": "nhpd", "horizon_factor": 3.0': '"law": "nhbd", "horizon_factor": 3.0',
    '"spacing": 0.01': '"spacings": 0.01',
    'fracture={"steps": 10': 'fractures={"steps": 10',
    '"between": [[0.0, 0.0]': '"beetween": [[0.0, 0.0]',
    'support=[{"group": "left", "displacement": {"x": 0.0, "y": 0.0}}]': 'support={"group": "left", "displacement": {"x": 0.0}}',
    '"peak")': '"paek")',
}


def checked(checker: str, script: str, folder: Path) -> "subprocess.CompletedProcess[str]":
    file = folder / "script.py"
    file.write_text(script)
    of_checker = {"pyright": ["--pythonpath", sys.executable]}.get(checker, [])
    command = [sys.executable, "-m", checker, *of_checker, str(file)]
    return subprocess.run(command, text=True, capture_output=True, cwd=folder)


@pytest.mark.parametrize("checker", ["mypy", "pyright"])
def test_types_find_wrong_keys(checker: str, tmp_path: Path) -> None:
    if importlib.util.find_spec(checker) is None:
        pytest.skip(f"{checker} is not installed")
    if checker == "pyright" and subprocess.run([sys.executable, "-m", "pyright", "--version"], capture_output=True).returncode != 0:
        pytest.skip("pyright does not run here")
    right = checked(checker, SCRIPT, tmp_path)
    assert right.returncode == 0, right.stdout + right.stderr
    for good, bad in WRONG.items():
        assert good in SCRIPT
        wrong = checked(checker, SCRIPT.replace(good, bad), tmp_path)
        assert wrong.returncode == 1 and "error" in wrong.stdout, (bad, wrong.stdout)


def test_keys_are_listed_with_units_defaults_and_words() -> None:
    criterion = {it.path.rpartition(".")[2]: it for it in ligament.keys("fracture.criterion")}
    assert "tension" in criterion["kind"].words and "bond-energy" in criterion["kind"].meaning
    assert criterion["limit"].kind == "number"
    [young] = ligament.keys("material.young")
    assert (young.unit, young.kind, young.path) == ("Pa", "number", "material.young")
    assert ligament.keys("load.0.displacement.y")[0].unit == ligament.keys("load__displacement__y")[0].unit == "m"
    assert {"material", "load", "fracture"} <= {it.path for it in ligament.keys()}
    assert "material.young: number, in Pa" in repr(ligament.keys("material")) and "<table>" in ligament.keys("material")._repr_html_()
    [steps] = ligament.keys("fracture.steps")
    assert "whole number or list (number)" in repr(steps)
    assert ligament.keys("material.concrete.young")[0].unit == "Pa"
    with pytest.raises(ligament.LigamentError, match="mesh has no key `fil`; did you mean `file`"):
        ligament.keys("mesh.fil")
