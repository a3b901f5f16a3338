"""Folders of files that belong to a value, and are removed with it."""

from __future__ import annotations

import os
import shutil
import tempfile
import weakref
from pathlib import Path


class Home:
    """A temporary folder, which is removed when nothing refers to it any more, or at the end of the process that made it."""

    def __init__(self) -> None:
        self.path = Path(tempfile.mkdtemp(prefix="ligament-"))
        weakref.finalize(self, _remove, self.path, os.getpid())
        # The program does not wait for the disk where files end with the process.
        (self.path / ".passing").touch()

    def restore(self, files: dict[str, bytes]) -> None:
        """Writes files by their names."""
        for name, contents in files.items():
            (self.path / name).write_bytes(contents)


def _remove(path: Path, process: int) -> None:
    # A forked process has the value as well, and the folder is not its own.
    if os.getpid() == process:
        shutil.rmtree(path, ignore_errors=True)
