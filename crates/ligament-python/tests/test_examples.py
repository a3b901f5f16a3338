"""The cases that come with the package."""

from pathlib import Path

import ligament
import pytest

CASES = Path(__file__).resolve().parents[3] / "cases"
# Where an example is called otherwise than its case.
SOURCES = {"notched-beam": "petersson-beam/opening.toml"}


@pytest.mark.parametrize("name", ligament.examples.names())
def test_an_example_is_the_case_of_the_repository(name: str) -> None:
    path = ligament.examples.path(name)
    assert path.read_text() == (CASES / SOURCES.get(name, f"{name}/case.toml")).read_text()
    # Its mesh is found beside it.
    assert ligament.Case.from_toml(path).title


def test_the_first_lines_of_the_documentation(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.chdir(tmp_path)
    result = ligament.run(ligament.examples.path("brazilian-disk"), fracture__stop__bonds=10, progress=False)
    assert result.summary["broken_bonds"] >= 10
    assert result.summary["points"] == 2998


def test_a_solid_runs(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.chdir(tmp_path)
    result = ligament.run(ligament.examples.path("split-block"), fracture__stop__bonds=5, progress=False)
    assert result.summary["points"] > 1000


def test_an_unknown_example_is_refused_with_the_nearest() -> None:
    with pytest.raises(ligament.LigamentError, match="did you mean 'brazilian-disk'"):
        ligament.examples.path("brasilian-disk")
