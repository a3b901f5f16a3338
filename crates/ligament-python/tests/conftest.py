"""What the tests share: a plate that a crack runs through, quick to compute."""

import copy
import signal
from collections.abc import Iterator
from typing import Any

import pytest

PLATE: dict[str, Any] = {
    "title": "Edge crack in a plate",
    "lattice": {
        "cells": [24, 36],
        "spacing": 0.0025,
        "corner": [0.0, -0.045],
        "thickness": 0.01,
        "set": {"bottom": {"bottom": 2}, "top": {"top": 2}},
    },
    "material": {"young": 15e9, "poisson": 0.21, "tensile_strength": 3.81e6},
    "model": {"law": "nhpd", "horizon_factor": 3.0},
    "precrack": [{"points": [[-0.01, 0.0], [0.0201, 0.0]]}],
    "support": [{"group": "bottom", "displacement": {"x": 0.0, "y": 0.0}}],
    "load": [{"group": "top", "displacement": {"x": 0.0, "y": 4.0e-5}}],
    "no_fail": [{"group": "bottom"}, {"group": "top"}],
    "fracture": {"steps": 20},
    "output": {"fields_every": 5},
}


@pytest.fixture
def plate() -> dict[str, Any]:
    return copy.deepcopy(PLATE)


@pytest.fixture(scope="session")
def result() -> Any:
    import ligament

    return ligament.run(PLATE, progress=False)


@pytest.fixture
def interruptible() -> Iterator[None]:
    """Ctrl-C as at a terminal: what a shell starts in the background has it ignored."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)
