"""Pictures in memory."""

from __future__ import annotations

import base64
import os
from pathlib import Path

from ligament import _native
from ligament._errors import LigamentError

# Endings of the files that pictures are written as, and of some that are not: any other ending is a part of a name, as in `at 2.75`.
KINDS = ("svg", "png", "pdf")
OTHER_KINDS = ("bmp", "eps", "gif", "jpeg", "jpg", "ps", "tif", "tiff", "webp")


class Picture:
    """A picture, which notebooks show as SVG."""

    def __init__(self, drawing: _native.Drawing, words: str) -> None:
        self._drawing = drawing
        self.svg = drawing.svg(words)
        self.words = words

    def save(self, path: str | os.PathLike[str], *, dpi: float = 300.0) -> Path:
        """Writes the picture into a file, and gives its path: SVG, PNG or PDF as the name ends, SVG with `.svg` behind any other name.

        A file that is there is replaced. The dots per inch are those of a PNG.
        """
        written = Path(path)
        kind = written.suffix.lower().removeprefix(".")
        if kind in OTHER_KINDS:
            raise LigamentError(f"{written}: pictures are written as .svg, .png or .pdf", hint="name it .svg, .png or .pdf")
        if kind not in KINDS:
            written, kind = written.with_name(written.name + ".svg"), "svg"
        match kind:
            case "png":
                written.write_bytes(self._drawing.png(dpi))
            case "pdf":
                written.write_bytes(self._drawing.pdf(self.words))
            case _:
                written.write_text(self.svg, encoding="utf-8", newline="")
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
