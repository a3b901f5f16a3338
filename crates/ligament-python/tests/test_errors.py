"""Exceptions carry the key, the line and the hint; Ctrl-C keeps what was found."""

import os
import signal
import threading
import time
from pathlib import Path
from typing import Any

import ligament
import pytest


def fault(**expected: Any) -> Any:
    return pytest.raises(ligament.CaseError, check=lambda it: all(getattr(it, k) == v for k, v in expected.items()))


def test_a_key_is_found_in_its_file(plate: dict[str, Any], tmp_path: Path) -> None:
    text = ligament.Case(plate).to_toml().replace("horizon_factor", "horizon_facto")
    line = 1 + text[: text.index("horizon_facto")].count("\n")
    file = tmp_path / "case.toml"
    file.write_text(text)
    with fault(key="model.horizon_facto", line=line, path=str(file)) as found:
        ligament.run(file)
    assert "did you mean `horizon_factor`?" in found.value.hint
    with fault(line=1, path="case in memory"):
        ligament.Case.from_toml("young = 15 GPa\n")


def test_sections_in_memory_have_keys_and_no_lines(plate: dict[str, Any]) -> None:
    plate["material"]["young"] = "15 GPa"
    with fault(key="material.young", line=None):
        ligament.run(plate)
    with fault(key="model.horizon_factor"):
        ligament.run({**plate, "material": {"young": 1e9, "poisson": 0.2, "tensile_strength": 1e6}}, model__horizon_factor=0.5)
    with fault(key="material.young"):
        ligament.run({**plate, "material": {"young": object()}})


def test_what_holds_itself_is_no_case(plate: dict[str, Any]) -> None:
    loop: list[Any] = []
    loop.append(loop)
    ring: dict[str, Any] = {}
    ring["ring"] = ring
    deep: list[Any] = []
    for _ in range(20_000):
        deep = [deep]
    wide: list[Any] = [1.0]
    for _ in range(30):
        wide = [wide, wide]

    class Itself:
        def tolist(self) -> Any:
            return self

    for value, words in [(loop, "hold themselves"), (ring, "hold themselves"), (deep, "nested more than 32 deep"), (Itself(), "nested"),
                         (wide, "values at most")]:
        with pytest.raises(ligament.CaseError, match=words) as found:
            ligament.run({**plate, "load": value})
        assert found.value.key.startswith("load") and len(str(found.value)) < 300
        with pytest.raises(ligament.CaseError, match=words):
            ligament.Case(plate).with_changes(load=value)


def test_a_group_that_is_not_there_is_told_with_those_that_are(plate: dict[str, Any]) -> None:
    plate["load"][0]["group"] = "topp"
    with fault(key="load.0.group") as found:
        ligament.run(plate, progress=False)
    assert "`top`" in found.value.hint


def test_errors_speak_python(plate: dict[str, Any]) -> None:
    with pytest.raises(ligament.CaseError, match=r"^model__horizon_facto=4: .*did you mean `horizon_factor`"):
        ligament.run(plate, model__horizon_facto=4)
    with pytest.raises(ligament.CaseError, match=r"so it is a list; write load=\[\{"):
        ligament.run({**plate, "load": plate["load"][0]})
    with pytest.raises(ligament.CaseError, match=r"did you mean `material.young`"):
        ligament.run({**plate, "young": 1e9})


def test_remedies_speak_python(result: Any, tmp_path: Path) -> None:
    result.save(tmp_path / "saved")
    with pytest.raises(ligament.LigamentError, match=r"saved already holds .*, or replace it with replace=True$"):
        result.save(tmp_path / "saved")
    with pytest.raises(ligament.CaseError, match=r"^model__lw=None: "):
        ligament.Case.from_toml(result.folder / "case.resolved.toml").with_changes(model__lw=None)


def test_a_number_that_is_not_there_is_told_with_those_that_are(result: Any) -> None:
    with pytest.raises(ligament.LigamentError, match="no result `peek`.*`peak.displacement`, `peak.reaction`"):
        result.number("peek")


def test_a_case_that_is_not_there() -> None:
    with fault(path="nowhere/case.toml"):
        ligament.run("nowhere/case.toml")


def test_errors_are_those_of_python_too(plate: dict[str, Any]) -> None:
    assert issubclass(ligament.CaseError, ValueError) and issubclass(ligament.Interrupted, KeyboardInterrupt)
    with pytest.raises(ValueError):
        ligament.run({**plate, "stage": 3})


@pytest.mark.usefixtures("interruptible")
def test_ctrl_c_ends_a_run_with_what_it_has(plate: dict[str, Any]) -> None:
    plate["fracture"]["steps"] = 2000
    told = []

    def interrupt() -> None:
        while len(told) < 3:
            time.sleep(0.01)
        os.kill(os.getpid(), signal.SIGINT)

    killer = threading.Thread(target=interrupt)
    killer.start()
    begun = time.monotonic()
    with pytest.raises(ligament.Interrupted) as stopped:
        ligament.run(plate, progress=lambda *of: told.append(of))
    killer.join()
    result = stopped.value.result
    assert result.termination == "stopped" and 3 <= len(result.columns["step"]) < 2000
    # Other threads went on meanwhile, and the run ended at its next step.
    assert time.monotonic() - begun < 30
    steps = [step for step, *_ in told]
    assert steps == sorted(steps)


def test_a_failure_of_progress_reaches_the_caller(plate: dict[str, Any]) -> None:
    def fail(*_: object) -> None:
        raise RuntimeError("no room on the screen")

    with pytest.raises(RuntimeError, match="no room"):
        ligament.run(plate, progress=fail)
