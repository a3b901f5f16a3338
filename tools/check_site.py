#!/usr/bin/env python3
"""Checks in Chromium the site that `tools/site` made, from its folder.

The search finds a page, formulas are set, a button of a tutorial leads to its body in the playground, the pages of live results open, nothing comes
from elsewhere. A site without the playground opens at the overview.
"""

import time
from pathlib import Path

import browser

SITE = Path(__file__).resolve().parent.parent / "target" / "site"
LOADED = "document.readyState === 'complete'"
FOUND = "[...document.querySelectorAll('.md-search-result__link')].map((it) => it.href)"
TYPE = """{
    document.querySelector('label[for=__search]').click();
    const field = document.querySelector('.md-search__input');
    field.focus();
    field.value = 'snap-back';
    field.dispatchEvent(new Event('input', { bubbles: true }));
    field.dispatchEvent(new Event('keyup', { bubbles: true }));
}"""
FONT = "document.fonts.ready.then(() => [...document.fonts].some((it) => it.family.includes('STIX') && it.status === 'loaded'))"


def main():
    if browser.program() is None:
        print("there is no Chromium: the site was not looked at")
        return
    began = time.monotonic()
    has_playground = "data-mesh" in (SITE / "index.html").read_text()
    live = sorted((SITE / "docs" / "guide" / "live-results").glob("*.html"))
    with browser.Browser() as page:
        page.open(SITE / ("overview.html" if has_playground else "index.html"), LOADED)
        assert page.value("document.querySelector('article h1').innerText").startswith("Ligament")
        page.value(TYPE)
        page.until(f"{FOUND}.length > 0")
        found = page.value(FOUND)
        assert any("docs/exact-path.html" in address for address in found), found
        assert page.value("document.querySelectorAll('.highlight code span[class]').length") > 0, "no code is highlighted"
        page.open(SITE / "docs" / "method.html", f"{LOADED} && location.href.includes('method')")
        assert (count := page.value("document.querySelectorAll('article math').length")) > 20, count
        assert page.value(FONT), "the font of the formulas is not loaded"
        page.until("document.querySelector('article') && !document.querySelector('article').innerText.includes('$')")
        if has_playground:
            page.open(SITE / "docs" / "guide" / "l-panel.html", f"{LOADED} && location.href.includes('l-panel')")
            page.value("document.querySelector('article .md-button').click()")
            page.until("document.querySelector('.choice[aria-pressed=true]')?.dataset.body === 'l-panel'")
            assert page.value("document.querySelectorAll('header nav a').length") > 5
        for result in live:
            page.open(result, f"location.href.includes('{result.name}') && document.documentElement?.dataset.ready === 'true'")
        assert not (complaints := page.complaints()), complaints
    print(f"the site in a browser: {len(found)} results of a search, {count} formulas, {len(live)} live results, {time.monotonic() - began:.1f} s")


if __name__ == "__main__":
    main()
