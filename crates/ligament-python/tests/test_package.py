"""The package as a whole: the command, types, examples in texts, notebooks."""

import doctest
import functools
import importlib
import json
import os
import re
import signal
import subprocess
import sys
import time
from pathlib import Path

import ligament
import pytest

CRATE = Path(__file__).resolve().parents[1]
REPOSITORY = CRATE.parents[1]
COMMAND = str(Path(sys.executable).with_name("ligament"))


def program(*arguments: str, **options: object) -> "subprocess.CompletedProcess[str]":
    return subprocess.run([COMMAND, *arguments], text=True, capture_output=True, **options)  # type: ignore[call-overload]


def test_the_command_is_the_program(tmp_path: Path) -> None:
    assert program("--version").stdout.strip() .startswith(f"ligament {ligament.__version__}")
    assert program("run").returncode == 2
    missing = program("run", "nowhere.toml")
    assert missing.returncode == 1 and "cannot read the case file nowhere.toml" in missing.stderr
    case = REPOSITORY / "cases/plate-tension/case.toml"
    done = program("run", str(case), "--out", str(tmp_path / "out"))
    assert done.returncode == 0 and "results in" in done.stdout
    assert program("plot", str(tmp_path / "out")).returncode == 0


def test_the_command_starts_itself_for_a_sweep(tmp_path: Path) -> None:
    study = tmp_path / "study.toml"
    case = REPOSITORY / "cases/plate-tension/case.toml"
    study.write_text(f'case = "{case}"\n[[axis]]\nkey = "model.horizon_factor"\nvalues = [2.0, 3.0]\n')
    done = program("sweep", str(study), "--out", str(tmp_path / "out"))
    assert done.returncode == 0, done.stderr
    assert len((tmp_path / "out" / "table.csv").read_text().splitlines()) == 3


@pytest.mark.skipif(os.name == "nt", reason="signals are those of Unix")
def test_the_command_stops_in_order(plate: dict[str, object], tmp_path: Path) -> None:
    plate["fracture"] = {"steps": 20000}
    case = tmp_path / "case.toml"
    case.write_text(ligament.Case(plate).to_toml())
    out = tmp_path / "out"
    # Shells let what they start in the background ignore the signal.
    heed = functools.partial(signal.signal, signal.SIGINT, signal.SIG_DFL)
    running = subprocess.Popen([COMMAND, "run", str(case), "--out", str(out)], stdout=subprocess.PIPE, text=True, preexec_fn=heed)
    # Longer than a busy machine takes to the first solution, before which there is nothing to go on from.
    until = time.monotonic() + 120.0
    while not (out / "history.csv").is_file():
        assert running.poll() is None and time.monotonic() < until, "the run has not begun"
        time.sleep(0.01)
    running.send_signal(signal.SIGINT)
    told, _ = running.communicate(timeout=60)
    assert running.returncode == 4 and "ligament resume" in told


def test_types_are_right() -> None:
    checked = subprocess.run(
        [sys.executable, "-m", "mypy", "--config-file", str(CRATE / "pyproject.toml"), str(CRATE / "python/ligament")],
        text=True, capture_output=True, cwd=CRATE,
    )
    assert checked.returncode == 0, checked.stdout + checked.stderr


def test_stubs_are_those_of_the_module() -> None:
    native = importlib.import_module("ligament._native")
    stub = (CRATE / "python/ligament/_native.pyi").read_text()
    told = set(re.findall(r"^(?:def|class) (\w+)", stub, re.M)) | {"VERSION"}
    assert told == {name for name in dir(native) if not name.startswith("__")}
    for name in ("Case", "Folder"):
        body = re.search(rf"^class {name}:\n((?:    .*\n)+)", stub, re.M)
        assert body
        members = set(re.findall(r"^    (?:def )?(\w+)[:(]", body[1], re.M)) - {"__init__"}
        assert members == {it for it in vars(getattr(native, name)) if not it.startswith("__")}, name


def test_examples_of_the_documentation() -> None:
    failed = 0
    for name in ("ligament", "ligament._case", "ligament._keys", "ligament.examples"):
        failed += doctest.testmod(importlib.import_module(name)).failed
    assert failed == 0


def test_snippets_of_the_page_of_the_package() -> None:
    snippets = re.findall(r"^```python\n(.*?)^```", (CRATE / "README.md").read_text(), re.M | re.S)
    assert snippets
    for snippet in snippets:
        exec(compile(snippet, "README.md", "exec"), {})


@pytest.mark.parametrize("notebook", sorted((CRATE / "notebooks").glob("*.ipynb")), ids=lambda it: it.stem)
def test_notebooks_run(notebook: Path) -> None:
    nbformat = pytest.importorskip("nbformat")
    nbclient = pytest.importorskip("nbclient")
    # Outputs are made anew by whoever runs it.
    cells = json.loads(notebook.read_text())["cells"]
    assert all(not cell.get("outputs") for cell in cells)
    opened = nbformat.read(notebook, as_version=4)
    nbclient.NotebookClient(opened, timeout=300, kernel_name="python3").execute()
    shown = [data for cell in opened.cells for output in cell.get("outputs", ()) for data in output.get("data", ())]
    assert {"text/html", "image/svg+xml"} & set(shown)
