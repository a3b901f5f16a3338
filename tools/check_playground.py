#!/usr/bin/env python3
"""Checks the playground in Chromium: check_playground.py PROGRAM, after `tools/playground`.

The disk splits, and bonds break in the order of the program itself; so do those of the panel. A run is stopped and its memory freed. A wrong
case shows its line and a hint, sliders and case go together, a mesh gets a case, results are saved. The page fits a phone, is dark where
the system is, and asks nothing of a network.
"""

import argparse
import base64
import csv
import io
import json
import subprocess
import tempfile
import time
import zipfile
from pathlib import Path

import browser

ROOT = Path(__file__).resolve().parent.parent
PAGE = ROOT / "target" / "playground" / "index.html"
BODIES = ROOT / "tools" / "playground-files" / "bodies"
DATA = "document.documentElement.dataset"
OPENED = "document.documentElement?.dataset.started > 0"
# Largest difference of utilisations and displacements: sums have another order on another machine, and each of the some thousand breakages
# begins from the rounding of those before it.
ROUNDING = 1e-6
# Of a machine that does other things as well, s.
PATIENCE = 240
PICTURE = "document.getElementById('body').toDataURL()"
CASE = "document.getElementById('case').value"
ENCODED = "window.kept.arrayBuffer().then((it) => btoa(Array.from(new Uint8Array(it), (byte) => String.fromCharCode(byte)).join('')))"


def until(page, condition, seconds=PATIENCE):
    end = time.monotonic() + seconds
    while not page.value(condition):
        if time.monotonic() > end:
            raise TimeoutError(condition, page.value(f"JSON.stringify({{...{DATA}}}) + document.getElementById('status').textContent"))
        time.sleep(0.05)


def edit(page, change):
    """Changes the text of the case as a hand does."""
    page.value(f"{{ const it = document.getElementById('case'); it.value = it.value{change}; it.dispatchEvent(new Event('input')); }}")


def ended(page):
    until(page, f"['done', 'refused'].includes({DATA}.state)")
    assert page.value(f"{DATA}.state") == "done", page.value("document.getElementById('wrong').textContent")


def saved(page, button):
    """The bytes that a button saves."""
    page.value("window.kept = null; window.made ??= URL.createObjectURL; URL.createObjectURL = (it) => { window.kept = it; return window.made.call(URL, it); }")
    page.value(f"document.getElementById('{button}').click()")
    until(page, "window.kept !== null")
    return base64.b64decode(page.value(ENCODED))


def results(page):
    """The saved results as texts by their names."""
    with zipfile.ZipFile(io.BytesIO(saved(page, "save-results"))) as archive:
        assert archive.testzip() is None
        return {name: archive.read(name) for name in archive.namelist()}


def check_order(program, page, name, folder):
    """Bonds broken by the page and by the program: the same ones in the same order, with the same numbers but for rounding."""
    out = folder / name
    subprocess.run([program, "run", BODIES / f"{name}.toml", "--out", out, "--quiet"], check=True, stdout=subprocess.DEVNULL)
    files = results(page)
    assert {"case.toml", "results/history.csv", "results/summary.json", "results/fields.pvd"} <= set(files), sorted(files)
    own = list(csv.DictReader((out / "breaks.csv").open()))
    theirs = list(csv.DictReader(io.StringIO(files["results/breaks.csv"].decode())))
    assert len(own) > 50, len(own)
    exact = [key for key in own[0] if key in ("order", "step", "round", "node_a", "node_b", "criterion")]
    for one, other in zip(own, theirs, strict=True):
        assert [one[key] for key in exact] == [other[key] for key in exact], (one, other)
        for key in ("utilisation", "displacement"):
            assert abs(float(one[key]) - float(other[key])) <= ROUNDING * abs(float(one[key])), (key, one, other)
    return len(own)


def check_disk(page):
    """It runs when the page opens: bonds are drawn as they break, the field at the end, with curve, steps and summary."""
    page.open(PAGE, OPENED)
    until(page, f"{DATA}.cracked > 0")
    assert page.value(f"{DATA}.state") == "running"
    assert page.value("document.getElementById('cracks').value") == "bonds"
    before = page.value(PICTURE)
    until(page, f"{PICTURE} !== {json.dumps(before)}")
    ended(page)
    times = {name: float(page.value(f"{DATA}.{name}")) for name in ("started", "shown", "cracked", "seconds")}
    assert page.value("document.querySelector('#curve .curve')?.getAttribute('d').length") > 200
    assert page.value("Number(document.getElementById('step').max)") > 5
    assert page.value("document.getElementById('cracks').value") == "open"
    assert "Results" in page.value("document.getElementById('summaries').textContent")
    assert b"Content-Security-Policy" in saved(page, "save-page")
    return times


def check_case(page):
    """Sliders write the case, the case moves the sliders, and what is wrong is told with its line."""
    slider = "document.querySelector('#sliders input[data-key=\"material.tensile_strength\"]')"
    page.value(f"{{ const it = {slider}; it.value = 2.5; it.dispatchEvent(new Event('input')); }}")
    assert "tensile_strength = 2.5e6" in page.value(CASE)
    edit(page, ".replace('2.5e6', '4.5e6')")
    assert page.value(f"{slider}.valueAsNumber") == 4.5
    edit(page, ".replace('young', 'yung')")
    until(page, f"{DATA}.checked === '1'")
    line = page.value(CASE).splitlines().index("yung = 15e9 # Pa") + 1
    words = page.value("document.getElementById('wrong').textContent")
    assert words.startswith(f"Line {line}: ") and "did you mean `young`?" in words, words
    assert page.value("document.querySelector('.numbers .wrong').textContent") == str(line)
    edit(page, ".replace('yung = 15e9', 'young = ')")
    until(page, f"document.getElementById('wrong').textContent.startsWith('Line {line}: not valid TOML')")
    page.value("document.getElementById('start').click()")
    until(page, f"{DATA}.state === 'refused'")
    assert page.value("document.getElementById('wrong').textContent").startswith(f"Line {line}: ")
    page.value("document.getElementById('restore').click()")
    assert page.value("document.getElementById('wrong').hidden")


def check_stop(page):
    """A run ends at once when it is stopped, with its worker; the next one is as the first."""
    page.value("document.querySelector('[data-body=block]').click()")
    until(page, "document.getElementById('status').textContent.includes('bonds')")
    page.value("document.getElementById('stop').click()")
    until(page, f"{DATA}.state === 'stopped'", 5)
    assert page.value("document.getElementById('stop').hidden")
    targets = [it for it in page.call("Target.getTargets")["targetInfos"] if it["type"] == "worker"]
    assert not targets, targets


def check_mesh(page):
    """A dropped mesh gets a case that runs."""
    text = (ROOT / "meshes" / "plate-coarse.msh").read_text()
    page.value(
        f"{{ const files = new DataTransfer(); files.items.add(new File([{json.dumps(text)}], 'my plate.msh'));"
        " document.body.dispatchEvent(new DragEvent('drop', { dataTransfer: files, bubbles: true, cancelable: true })); }"
    )
    until(page, f"{CASE}.includes('my-plate.msh')")
    ended(page)
    assert "my-plate.msh" in results(page)


def check_layouts():
    """On a phone nothing is wider than the page; where the system is dark the page is."""
    with browser.Browser(width=390, height=844, dark=True, mobile=True) as page:
        page.open(f"{PAGE}", OPENED)
        page.value("document.querySelector('[data-body=l-panel]').click()")
        ended(page)
        assert (width := page.value("document.documentElement.scrollWidth")) <= 390, width
        light = "getComputedStyle(document.body).backgroundColor.match(/\\d+/g).reduce((sum, it) => sum + Number(it), 0)"
        assert page.value(light) < 200
        top = page.box("#body")[1] + page.value("scrollY")
        assert top < 1500, top
        assert not page.complaints(), page.complaints()


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("program", type=Path)
    program = arguments.parse_args().program
    if browser.program() is None:
        print("skipped: the playground is looked at in Chromium, which is not here (apt-get install chromium)")
        return
    with tempfile.TemporaryDirectory() as place, browser.Browser() as page:
        times = check_disk(page)
        n_bonds = check_order(program, page, "disk", Path(place))
        check_case(page)
        check_stop(page)
        page.value("document.querySelector('[data-body=l-panel]').click()")
        ended(page)
        n_bonds += check_order(program, page, "l-panel", Path(place))
        check_mesh(page)
        assert not page.complaints(), page.complaints()
    check_layouts()
    print(
        f"playground: ready after {times['started'] / 1e3:.1f} s, the body after {times['shown'] / 1e3:.1f} s, the first crack {times['cracked'] / 1e3:.1f} s"
        f" after the start of the run, the disk in {times['seconds']:.1f} s; {n_bonds} bonds in the order of the program"
    )


if __name__ == "__main__":
    main()
