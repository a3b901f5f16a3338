#!/usr/bin/env python3
"""Checks in Chromium the page that `ligament report` makes of result folders: check_report.py PROGRAM FOLDER...

The last of the folders in the plane must have broken bonds and several steps, and so must solids, whose pages have pictures: each must be
the one that `ligament plot` draws. Values under the pointer must be those of the VTU files to half of
the last digit shown, bonds those of model.vtu and breaks.csv. Nothing may be asked of a network or complained of in the console.
"""

import base64
import csv
import json
import re
import shutil
import subprocess
import sys
import tempfile
import time
import zlib
from pathlib import Path

import meshio
import numpy as np

import browser

READY = "document.documentElement?.dataset.ready === 'true'"
PICTURE = "document.getElementById('body').toDataURL()"
STEP = "Number(document.getElementById('step').value)"
TITLE = "A title with <script>throw 1</script> & \"quotes\""


def fields(folder, step):
    """Fields of the points of a step by name, with their tags and positions."""
    file = meshio.read(folder / f"fields_{step:04}.vtu")
    if "node" in file.point_data:
        return dict(file.point_data) | {"places": file.points}
    cells = {name: np.concatenate(blocks) for name, blocks in file.cell_data.items()}
    corners = np.concatenate([block.data for block in file.cells])
    return cells | {"places": file.points[corners].mean(axis=1)}


def number(text):
    """A shown number with half of its last digit."""
    written = re.match(r"[−-]?[\d.]+", text)[0].replace("−", "-")
    decimals = len(written.partition(".")[2])
    return float(written), 0.5 * 10.0**-decimals


def check_value(text, value, factor, name):
    shown, half = number(text)
    # A value between two numbers may go either way by the rounding of the unit.
    assert abs(shown - value * factor) <= half * 1.001 + 1e-12, (name, text, value * factor)


def go(page, step):
    page.value(f"{{ const it = document.getElementById('step'); it.value = {step}; it.dispatchEvent(new Event('input')); }}")


def drawn(page, number):
    page.until(f"document.documentElement.dataset.drawn.split(' ').includes('{number}')")


def described(page):
    return json.loads(page.value("document.getElementById('description').textContent"))


def panel(page):
    """Rows of the panel of the point by the name of their field."""
    rows = "[...document.querySelectorAll('#point-values tr[data-key]')].map((it) => [it.dataset.key, it.cells[0].textContent, it.cells[1].textContent])"
    return {key: (name, text) for key, name, text in page.value(rows)}


def check_values(page, folder, run):
    """Moves the pointer over the body in several steps and compares all values; returns how many."""
    count = 0
    left, top, width, height = page.box("#body")
    shifts = {field["name"]: field["shift"] for field in run["fields"]}
    steps = run["steps"]
    factor = float(page.value("document.getElementById('magnification').value"))
    for place in sorted({0, len(steps) // 2, len(steps) - 1}):
        go(page, place)
        drawn(page, steps[place])
        stored = fields(folder, steps[place])
        tagged = run["body"]["tagged"]
        points = {int(tag): point for point, tag in enumerate(stored[tagged].ravel())}
        seen = []
        for across, down in [(0.5, 0.5), (0.47, 0.3), (0.55, 0.62), (0.44, 0.7), (0.52, 0.41)]:
            x, y = left + across * width, top + down * height
            page.mouse("mouseMoved", 2, 2)
            page.value("delete document.getElementById('point-values').dataset.whole; 0")
            page.mouse("mouseMoved", x, y)
            page.until("document.getElementById('point-values').dataset.whole || document.getElementById('marker').hidden")
            rows = panel(page)
            if "tag" not in rows:
                continue
            point = points[int(rows.pop("tag")[0].split()[1])]
            moved = stored["places"][point][:2] + factor * np.asarray(stored["displacement"][point])[:2]
            seen.append((moved, page.value("document.getElementById('marker').style.transform")))
            for key, (_, text) in rows.items():
                name, _, component = key.partition(".")
                parts = next(it["components"] for it in run["fields"] if it["name"] == name)
                value = np.atleast_1d(stored[name][point])[parts.index(component) if component else 0]
                check_value(text, value, 10.0 ** shifts[name], key)
                count += 1
        check_marks(seen)
    return count


def check_marks(seen):
    """The marks lie where the deformed points are: an even scale along both axes takes one to the other."""
    assert len(seen) >= 3, "the pointer was over the body"
    moved = np.array([it[0] for it in seen])
    pixels = np.array([[float(it) for it in re.findall(r"-?[\d.]+(?=px)", text)] for _, text in seen])
    scale = np.ptp(pixels, axis=0).max() / np.ptp(moved, axis=0).max()
    for axis, sign in ((0, 1.0), (1, -1.0)):
        left = pixels[:, axis] - sign * scale * moved[:, axis]
        assert np.ptp(left) < 2.0, left


def check_bonds(page, folder, run):
    """Pins a point with broken bonds and compares its bonds with the files; returns how many."""
    left, top, width, height = page.box("#body")
    go(page, len(run["steps"]) - 1)
    drawn(page, run["steps"][-1])
    page.click(left + 0.5 * width, top + 0.5 * height)
    page.until("document.querySelectorAll('#bond-values tbody tr[data-bond]').length > 0")
    tag = int(panel(page)["tag"][0].split()[1])
    rows = page.value("[...document.querySelectorAll('#bond-values tbody tr[data-bond]')].map((row) => [...row.cells].map((it) => it.textContent))")
    model = meshio.read(folder / "model.vtu")
    tagged = run["body"]["tagged"]
    tags = model.point_data[tagged].ravel()
    ends = tags[np.concatenate([it.data for it in model.cells])]
    largest = np.concatenate(model.cell_data["largest_utilisation"])
    own = {int(pair[0] + pair[1] - tag): bond for bond, pair in enumerate(ends) if tag in pair}
    assert {int(row[0]) for row in rows} == own.keys(), (tag, rows)
    with open(folder / "breaks.csv", newline="", encoding="utf-8") as file:
        breaks = {frozenset((int(it[f"{tagged}_a"]), int(it[f"{tagged}_b"]))): it for it in csv.DictReader(file)}
    for other, _, utilisation, _, fate in rows:
        broke = breaks.get(frozenset((tag, int(other))))
        assert (broke is not None) == fate.startswith("broke"), (tag, other, fate)
        if broke:
            assert fate == f"broke, number {broke['order']}", fate
        if not np.isnan(largest[own[int(other)]]):
            check_value(utilisation, largest[own[int(other)]], 1.0, "utilisation")
    page.value("document.querySelector('#bond-values tbody tr[data-bond]').focus(); 0")
    page.until("document.querySelectorAll('#bond tr').length > 3")
    page.key("Escape")
    return len(rows)


def check_controls(page, run):
    """Slider, keys, curve and fields change what is seen."""
    steps = run["steps"]
    last = len(steps) - 1
    go(page, last)
    drawn(page, steps[last])
    before = page.value(PICTURE)
    go(page, 0)
    drawn(page, steps[0])
    assert page.value(PICTURE) != before, "the slider changes the picture"
    page.value("document.getElementById('body').focus(); 0")
    page.key("ArrowRight")
    drawn(page, steps[1])
    assert page.value(STEP) == 1, "an arrow goes to the next step"
    before = page.value(PICTURE)
    page.key("+", "+")
    page.until(f"{PICTURE} !== {json.dumps(before)}")
    page.key("0", "0")
    page.until(f"{PICTURE} === {json.dumps(before)}")
    page.key("Enter")
    page.until("document.querySelector('#point-values tr[data-key=tag]') !== null")
    page.key("Escape")
    mark = "document.querySelector('#curve .mark circle').getAttribute('cx')"
    first = page.value(mark)
    left, top, width, height = page.box("#curve .dot:last-of-type")
    page.click(left + width / 2, top + height / 2)
    page.until(f"{STEP} === {last}")
    drawn(page, steps[last])
    assert page.value(mark) != first, "the mark on the curve follows"
    before = page.value(PICTURE)
    page.value("{ const it = document.getElementById('field'); it.value = 'displacement.y'; it.dispatchEvent(new Event('change')); }")
    drawn(page, "displacement.y")
    assert page.value(PICTURE) != before, "the field changes the picture"


def check_layouts(report):
    """A dark page is dark, and a phone needs no scrolling aside."""
    background = "getComputedStyle(document.body).backgroundColor.match(/\\d+/g).map(Number).reduce((a, b) => a + b)"
    with browser.Browser(dark=True) as page:
        page.open(report, READY)
        assert page.value(background) < 150
        page.value("document.getElementById('theme').click(); 0")
        assert page.value(background) > 600
        assert page.pdf().startswith(b"%PDF")
        assert page.value("document.getElementById('printed').hidden && !document.getElementById('body').hidden")
        assert not page.complaints(), page.complaints()
    with browser.Browser(width=390, height=844, mobile=True) as page:
        page.open(report, READY)
        assert page.value("document.documentElement.scrollWidth") <= 390
        assert not page.complaints(), page.complaints()


def is_solid(folder):
    """Whether the body of a folder of results is a solid."""
    kinds = {block.type for block in meshio.read(min(Path(folder).glob("fields_*.vtu"))).cells}
    return bool(kinds & {"tetra", "hexahedron", "wedge", "pyramid"})


def drawn_by_plot(program, folder, field, options, place):
    """The pictures of all steps that `ligament plot` draws."""
    words = [program, "plot", folder, "--field", field, "--step", "all", "--width", "100", *options, "--force", "--out", place / "plotted.svg"]
    said = subprocess.run(words, check=True, capture_output=True, text=True).stdout
    return [Path(line).read_text() for line in said.splitlines()]


def check_pictures(page, program, folder, run, place):
    """Compares pictures of the page with those of `ligament plot`, and shows each series; returns how many pictures it has."""
    texts = page.value("Object.fromEntries([...document.querySelectorAll('script[id^=t]')].map((it) => [it.id, it.textContent]))")
    options = {"outside": ["--view", "iso", "--crack"], "behind": ["--view", "120,28", "--crack"], "crack": ["--crack=lines"]}
    series = run["pictures"]["series"]
    compared = set()
    for it in series:
        view, field = it["view"], it["field"]
        assert len(it["texts"]) == len(run["steps"]), it
        if view in options and view not in compared:
            compared.add(view)
            unpacked = [zlib.decompress(base64.b64decode(texts[f"t{number}"]), -15).decode() for number in it["texts"]]
            assert unpacked == drawn_by_plot(program, folder, field, options[view], place), (view, field)
        page.value(
            f"{{ const view = document.getElementById('view'); view.value = '{view}'; view.dispatchEvent(new Event('change'));"
            f" const it = document.getElementById('solid-field'); it.value = '{field}'; it.dispatchEvent(new Event('change')); }}"
        )
        page.until(f"document.documentElement.dataset.drawn.endsWith(' {view} {field}')")
        width, height = page.value("(({ naturalWidth, naturalHeight }) => [naturalWidth, naturalHeight])(document.getElementById('picture'))")
        assert width > 200 and height > 50, (view, field, width, height)
    assert compared == options.keys(), compared
    return sum(len(it["texts"]) for it in series)


def check_solid(program, folder, plane, place):
    """The page of a solid beside a body in the plane; returns how many pictures it has."""
    report = place / "solid.html"
    subprocess.run([program, "report", folder, plane, "--force", "--out", report], check=True, stdout=subprocess.DEVNULL)
    shown = "({ picture: document.getElementById('picture').offsetHeight, body: document.getElementById('body').offsetHeight })"
    with browser.Browser() as page:
        page.open(report, READY)
        run = described(page)["runs"][0]
        count = check_pictures(page, program, folder, run, place)
        heights = page.value(shown)
        assert heights["picture"] > 100 and heights["body"] == 0, heights
        last = len(run["steps"]) - 1
        go(page, last)
        drawn(page, run["steps"][last])
        source = "document.getElementById('picture').src"
        before = page.value(source)
        go(page, 0)
        page.until(f"{source} !== {json.dumps(before)}")
        page.key("ArrowRight")
        drawn(page, run["steps"][1])
        assert page.value(STEP) == 1, "an arrow goes to the next step"
        choose = "{{ const it = document.getElementById('run'); it.value = {}; it.dispatchEvent(new Event('change')); }}"
        page.value(choose.format(1))
        drawn(page, Path(plane).name)
        heights = page.value(shown)
        assert heights["picture"] == 0 and heights["body"] > 100, heights
        page.value(choose.format(0))
        drawn(page, Path(folder).name)
        assert page.value(shown)["body"] == 0
        assert page.pdf().startswith(b"%PDF")
        assert not page.complaints(), page.complaints()
    with browser.Browser(width=390, height=844, mobile=True) as page:
        page.open(report, READY)
        assert page.value("document.documentElement.scrollWidth") <= 390
        assert not page.complaints(), page.complaints()
    return count


def main(program, *folders):
    if browser.program() is None:
        print("skipped: the page of `ligament report` is looked at in Chromium, which is not here (apt-get install chromium)")
        return
    solids = [folder for folder in folders if is_solid(folder)]
    folders = [folder for folder in folders if folder not in solids]
    with tempfile.TemporaryDirectory() as place:
        copy = Path(place) / "titled"
        shutil.copytree(folders[-1], copy)
        summary = json.loads((copy / "summary.json").read_text())
        (copy / "summary.json").write_text(json.dumps(summary | {"title": TITLE}))
        report = Path(place) / "report.html"
        results = [copy, *map(Path, folders)]
        subprocess.run([program, "report", *results, "--force", "--out", report], check=True, stdout=subprocess.DEVNULL)
        with browser.Browser() as page:
            begun = time.monotonic()
            page.open(report, READY)
            seconds = time.monotonic() - begun
            assert TITLE in page.value("document.querySelector('h1').textContent")
            run = described(page)["runs"][0]
            n_values = check_values(page, copy, run)
            n_bonds = check_bonds(page, copy, run)
            check_controls(page, run)
            page.value("{ const it = document.getElementById('run'); it.value = 1; it.dispatchEvent(new Event('change')); }")
            drawn(page, Path(folders[0]).name)
            assert page.value("document.querySelectorAll('#curve .curve').length") == len(results)
            assert not page.complaints(), page.complaints()
        check_layouts(report)
        n_pictures = sum(check_solid(program, solid, folders[-1], Path(place)) for solid in solids)
    print(f"report: {n_values} values under the pointer and {n_bonds} bonds as in the files, first picture after {seconds:.1f} s")
    print(f"report: {n_pictures} pictures of {len(solids)} solid(s)")


main(*sys.argv[1:])
