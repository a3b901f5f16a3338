"""What a newcomer does first with the Python package: a run, a picture, the command. Usage: first_picture.py PICTURE.svg"""

import subprocess
import sys
from pathlib import Path

import ligament

result = ligament.run({
    "lattice": {
        "cells": [24, 36], "spacing": 0.0025, "corner": [0.0, -0.045], "thickness": 0.01,
        "set": {"bottom": {"bottom": 3}, "top": {"top": 3}},
    },
    "material": {"young": 15e9, "poisson": 0.21, "tensile_strength": 3.81e6},
    "model": {"law": "nhpd", "horizon_factor": 3.0},
    "precrack": [{"points": [[-0.01, 0.0], [0.0201, 0.0]]}],
    "support": [{"group": "bottom", "displacement": {"x": 0.0, "y": 0.0}}],
    "load": [{"group": "top", "displacement": {"x": 0.0, "y": 4e-5}}],
    "fracture": {"steps": 20},
})
picture = result.plot().save(sys.argv[1])
command = Path(sys.executable).with_name("ligament")
version = subprocess.run([command, "--version"], check=True, capture_output=True, text=True).stdout.strip()
# Without pandas and polars the history is arrays.
print(f"{version}: {result.summary['broken_bonds']} bonds broken in {len(result.history['step'])} states, {picture}")
