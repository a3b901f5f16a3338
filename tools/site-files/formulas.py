"""Sets the formulas of pages, `$...$` and `$$...$$`, as MathML, which browsers show without a script."""

import html
import re

import latex2mathml.converter

FORMULA = re.compile(r'<(span|div) class="arithmatex">(?:\\\(|\\\[)(.*?)(?:\\\)|\\\])</\1>', re.DOTALL)
# The converter leaves spaces as browsers guess them: bars and slashes get none, a minus after a bracket is a sign, functions stand apart.
SPACES = [
    (re.compile(r"<mo>(&#x0007C;|&#x0002F;)</mo>"), r'<mo lspace="0" rspace="0">\1</mo>'),
    (re.compile(r"(&#x00028;</mo>)<mo>(&#x02212;)"), r'\1<mo form="prefix">\2'),
    (re.compile(r"<m[io]>(sin|cos|tan|cot|exp|max|tr)</m[io]>(?=<mo)"), r'<mspace width="0.17em"/><mi>\1</mi>'),
    (re.compile(r"<m[io]>(sin|cos|tan|cot|tr)</m[io]>(?=<m[^o])"), r'<mspace width="0.17em"/><mi>\1</mi><mspace width="0.17em"/>'),
    (re.compile(r"<msup>(<mi>[^<]*</mi>)<mi>(&#x02032;)</mi></msup>"), r'<mrow>\1<mo lspace="0" rspace="0">\2</mo></mrow>'),
]


def mathml(tex, display):
    """A formula as MathML."""
    text = latex2mathml.converter.convert(html.unescape(tex.strip()), display=display)
    for pattern, spaced in SPACES:
        text = pattern.sub(spaced, text)
    return text


def on_page_content(text, **_):
    """The text of a page with its formulas set; MkDocs calls this."""
    return FORMULA.sub(lambda it: mathml(it[2], "block" if it[1] == "div" else "inline"), text)
