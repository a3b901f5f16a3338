"""Sets the formulas of pages, `$...$` and `$$...$$`, as MathML, which browsers show without a script and without fonts of its own."""

import html
import re

import latex2mathml.converter

FORMULA = re.compile(r'<(span|div) class="arithmatex">(?:\\\(|\\\[)(.*?)(?:\\\)|\\\])</\1>', re.DOTALL)


def on_page_content(text, **_):
    """The text of a page with its formulas set; MkDocs calls this."""

    def mathml(found):
        display = "block" if found[1] == "div" else "inline"
        return latex2mathml.converter.convert(html.unescape(found[2].strip()), display=display)

    return FORMULA.sub(mathml, text)
