"""Pictures in memory."""

from __future__ import annotations

import base64
import os
from pathlib import Path


class Picture:
    """A picture as SVG, which notebooks show."""

    def __init__(self, svg: str, words: str) -> None:
        self.svg = svg
        self.words = words

    def save(self, path: str | os.PathLike[str]) -> Path:
        """Writes the picture into a file of SVG, and gives its path."""
        written = Path(path).with_suffix(".svg")
        written.write_text(self.svg, encoding="utf-8")
        return written

    def to_html(self) -> str:
        """The picture as an element of HTML, which shares no names with the page around it."""
        # An image of its own: names inside of one picture do not reach another.
        coded = base64.b64encode(self.svg.encode()).decode()
        return f'<img alt="{self.words}" src="data:image/svg+xml;base64,{coded}" style="max-width:100%;background:white">'

    def _repr_svg_(self) -> str:
        return self.svg

    def __repr__(self) -> str:
        return f"<ligament picture: {self.words}>"
