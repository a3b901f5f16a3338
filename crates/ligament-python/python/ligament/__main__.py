"""The program `ligament`: `python -m ligament`, and the command that the package installs."""

from __future__ import annotations

import os
import signal
import sys

from ligament import _native


def main() -> int:
    """Does what the command line asks for, and gives the exit code."""
    # The program has ways of its own to stop in order; Python's would only be asked when it has ended.
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    # Meshes of other programs are read by packages of this Python.
    os.environ.setdefault("LIGAMENT_PYTHON", sys.executable)
    itself = [sys.executable, "-m", "ligament"]
    return _native.execute(["ligament", *sys.argv[1:]], itself)


if __name__ == "__main__":
    sys.exit(main())
