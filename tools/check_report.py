#!/usr/bin/env python3
"""Checks in Chromium the page that `ligament report` makes of result folders: check_report.py PROGRAM FOLDER...

The last of the folders in the plane must have broken bonds and several steps, and so must solids; one in the plane must be a mesh that breaks.
Values under the pointer must be those of the VTU files to half of the last digit shown, bonds those of model.vtu and breaks.csv. Meshes open along
their cracks. Solids turn and are cut. Nothing may be asked of a network or complained of in the console.
"""

import base64
import csv
import io
import json
import re
import shutil
import subprocess
import sys
import tempfile
import time
import tomllib
from pathlib import Path

import meshio
import numpy as np
from PIL import Image

import browser

READY = "document.documentElement?.dataset.ready === 'true'"
PICTURE = "document.getElementById('body').toDataURL()"
STEP = "Number(document.getElementById('step').value)"
# Colours of the symbols of supports, and of loads.
SKETCHED = {"support": (89, 97, 107), "load": (122, 64, 181)}
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


def choose(page, control, value, event="change"):
    page.value(f"{{ const it = document.getElementById('{control}'); it.value = {json.dumps(value)}; it.dispatchEvent(new Event('{event}')); }}")


def check_value(text, value, factor, name, rounded_to=0.0):
    """Compares a shown number with a value that the page has in whole multiples of `rounded_to`, in the unit of the value."""
    shown, half = number(text)
    half = max(half, 0.5 * rounded_to * factor)
    # A value between two numbers may go either way by the rounding of the unit.
    assert abs(shown - value * factor) <= half * 1.001 + 1e-12, (name, text, value * factor)


def go(page, step):
    choose(page, "step", step, "input")


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
                field = next(it for it in run["fields"] if it["name"] == name)
                index = field["components"].index(component) if component else 0
                exponents = field["columns"][index]["exponents"]
                exponent = exponents[place] if len(exponents) == len(steps) else exponents[0]
                value = np.atleast_1d(stored[name][point])[index]
                check_value(text, value, 10.0 ** shifts[name], key, 10.0**exponent)
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
    choose(page, "field", "displacement.y")
    drawn(page, "displacement.y")
    assert page.value(PICTURE) != before, "the field changes the picture"


def pixels(page, colour):
    """Places of the pixels of a colour in the picture of the body, from its middle, y upwards; those within 2 of 255 levels."""
    answer = page.value(PICTURE).partition(",")[2]
    picture = np.asarray(Image.open(io.BytesIO(base64.b64decode(answer))).convert("RGB")).astype(int)
    down, across = np.nonzero(np.abs(picture - np.array(colour)).max(axis=2) <= 2)
    return np.column_stack([across - picture.shape[1] / 2, picture.shape[0] / 2 - down])


def check_sketch(page, folder, run):
    """Symbols stand at the points of the supports and loads, and go and come; a force from one to the other points where theirs lie."""
    model = meshio.read(folder / "model.vtu")
    groups = {name: set(np.flatnonzero(of)) for name, of in model.point_data.items() if name.startswith("group.")}
    entries = run["sketch"]
    assert entries and all(it["points"] for it in entries), entries
    page.value("document.getElementById('forces').click(); 0")
    shown = {name: pixels(page, colour) for name, colour in SKETCHED.items()}
    for is_support, name in ((True, "support"), (False, "load")):
        assert (len(shown[name]) > 0) == any(it["isSupport"] == is_support for it in entries), name
    with open(folder / "case.resolved.toml", "rb") as file:
        case = tomllib.load(file)
    if run["body"]["dimension"] == 2 and all(it.get("group") for it in [*case.get("support", []), *case["load"]]):
        at = [np.mean([model.points[list(groups[f"group.{it['group']}"])].mean(axis=0) for it in case[key]], axis=0) for key in ("support", "load")]
        along, seen = (at[1] - at[0])[:2], shown["load"].mean(axis=0) - shown["support"].mean(axis=0)
        # The sample of the points, and the length of the symbols, are small beside the distance.
        assert along @ seen > 0.9 * np.linalg.norm(along) * np.linalg.norm(seen), (along, seen)
    page.value("document.getElementById('symbols').click(); 0")
    assert not any(len(pixels(page, colour)) for colour in SKETCHED.values())
    for control in ("symbols", "forces"):
        page.value(f"document.getElementById('{control}').click(); 0")


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
        tops = [page.box(it)[1] for it in ("#body", "#curve", "#point", "#energies", ".summary", "#numerics")]
        assert tops == sorted(tops), tops
        assert not page.complaints(), page.complaints()


def is_solid(folder):
    """Whether the body of a folder of results is a solid."""
    kinds = {block.type for block in meshio.read(min(Path(folder).glob("fields_*.vtu"))).cells}
    return bool(kinds & {"tetra", "hexahedron", "wedge", "pyramid"})


def check_opened_at_peak(page, folder, run):
    """The page shows first the step with fields under the largest load that the body carries."""
    with open(folder / "history.csv", newline="", encoding="utf-8") as file:
        load = {int(row["step"]): (row["at_rest"], abs(float(row["reaction"]))) for row in csv.DictReader(file)}
    assert run["steps"][page.value(STEP)] == max(run["steps"], key=lambda step: load[step])


def check_lost_graphics(page):
    """Graphics that the browser takes away come back with the same picture."""
    before = page.value(PICTURE)
    page.value("window.taken = document.getElementById('body').getContext('webgl2').getExtension('WEBGL_lose_context'); window.taken.loseContext()")
    page.until("!document.getElementById('no-view').hidden")
    page.value("window.taken.restoreContext()")
    page.until("document.getElementById('no-view').hidden")
    page.until(f"{PICTURE} === {json.dumps(before)}")


def picked(page, stored, run, x, y):
    """The position of the point that is seen at a place of the window."""
    page.mouse("mouseMoved", 2, 2)
    page.mouse("mouseMoved", x, y)
    page.until("document.querySelector('#point-values tr[data-key=tag]') !== null")
    tag = int(panel(page)["tag"][0].split()[1])
    return stored["places"][stored[run["body"]["tagged"]].ravel().tolist().index(tag)]


def check_turning(page, folder, run):
    """A drag turns a solid; seen along y, its front is under the pointer, and in a section the plane."""
    before = page.value(PICTURE)
    left, top, width, height = page.box("#body")
    x, y = left + 0.45 * width, top + 0.5 * height
    page.mouse("mouseMoved", x, y)
    page.mouse("mousePressed", x, y)
    for place in range(1, 9):
        page.call("Input.dispatchMouseEvent", type="mouseMoved", x=x + 10 * place, y=y + 4 * place, button="left", buttons=1)
    page.mouse("mouseReleased", x + 80, y + 32)
    assert page.value(PICTURE) != before, "a drag turns the body"
    page.value("document.getElementById('body').focus(); 0")
    page.key("y", "y")
    stored = fields(folder, run["steps"][0])
    along = stored["places"][:, 1]
    spacing = 1.5 * np.median(stored["nearest_distance"])
    go(page, 0)
    drawn(page, run["steps"][0])
    front = picked(page, stored, run, x, y)
    assert front[1] <= along.min() + spacing, front
    before = page.value(PICTURE)
    choose(page, "section", "1")
    page.until("!document.getElementById('cut-label').hidden")
    assert page.value(PICTURE) != before, "a section changes the picture"
    half = 0.5 * (along.min() + along.max())
    inside = picked(page, stored, run, x + 3, y + 3)
    assert abs(inside[1] - half) <= spacing, (inside, half)
    page.value("document.getElementById('zoom-fit').click(); 0")
    before = page.value(PICTURE)
    choose(page, "cut", 0.8, "input")
    assert page.value(PICTURE) != before, "the slider moves the section"
    choose(page, "section", "")


def check_opening(page, run):
    """The body opens along its crack, and the crack is shown as lines or, of a solid, as a surface."""
    go(page, len(run["steps"]) - 1)
    drawn(page, run["steps"][-1])
    modes = page.value("[...document.getElementById('cracks').options].map((it) => it.value)")
    body = run["body"]
    assert {"surface" if body["dimension"] == 3 else "lines", "bonds"} <= set(modes), modes
    assert modes[0] == "open" == page.value("document.getElementById('cracks').value"), modes
    assert (modes[-1] == "none") == (not body.get("half")), modes
    # From one to the next, and of a mesh at the end from the closed body to the opened one.
    for mode in [*modes[1:], modes[0]]:
        before = page.value(PICTURE)
        choose(page, "cracks", mode)
        page.until(f"{PICTURE} !== {json.dumps(before)}")
        said = page.value("document.getElementById('legend-name').textContent")
        assert ("crack opening" in said) == (mode == "surface"), (mode, said)


def check_opened_meshes(page):
    """The meshes in the plane that break open along their cracks."""
    runs = enumerate(described(page)["runs"])
    broken = [(number, run) for number, run in runs if run["cracks"].get("simplices")]
    assert broken, "a mesh in the plane breaks"
    for number, run in broken:
        choose(page, "run", number)
        drawn(page, run["label"])
        check_opening(page, run)


def check_solid(program, folder, plane, place):
    """The page of a solid beside a body in the plane; returns how many values and bonds it compared."""
    report = place / "solid.html"
    subprocess.run([program, "report", folder, plane, "--force", "--out", report], check=True, stdout=subprocess.DEVNULL)
    folder = Path(folder)
    with browser.Browser() as page:
        page.open(report, READY)
        run = described(page)["runs"][0]
        check_opened_at_peak(page, folder, run)
        check_sketch(page, folder, run)
        check_turning(page, folder, run)
        # Seen from above, x and y lie as they do in the plane.
        page.value("document.getElementById('body').focus(); 0")
        page.key("z", "z")
        counts = check_values(page, folder, run), check_bonds(page, folder, run)
        check_opening(page, run)
        check_lost_graphics(page)
        choose(page, "run", 1)
        drawn(page, Path(plane).name)
        assert page.value("document.getElementById('section').offsetHeight") == 0, "a body in the plane has no sections"
        assert page.pdf().startswith(b"%PDF")
        assert not page.complaints(), page.complaints()
    return counts


def check_measured(page):
    """Measured curves of the command and of a file are drawn, and charts are saved."""
    count = "document.querySelectorAll('#curve .curve.dashed').length"
    assert page.value(count) == 1
    page.value(
        "{ const files = new DataTransfer(); files.items.add(new File(['displacement (um);force (N)\\n0;0\\n1;2\\n'], 'other.csv'));"
        " const it = document.getElementById('measured'); it.files = files.files; it.dispatchEvent(new Event('change')); }"
    )
    page.until(f"{count} === 2")
    page.value(
        "{ const files = new DataTransfer(); files.items.add(new File(['a,b,c\\n0,0,0\\n'], 'wrong.csv'));"
        " document.getElementById('curve-card').dispatchEvent(new DragEvent('drop', { dataTransfer: files })); }"
    )
    page.until("document.getElementById('measured-note').textContent.includes('two columns')")
    for kind in ("svg", "png", "csv"):
        page.value(f"[...document.querySelectorAll('#curve .exports button')].find((it) => it.textContent === '{kind.upper()}').click()")
        page.until(f"document.documentElement.dataset.saved === 'force-over-displacement.{kind}'")


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
        measured = Path(place) / "measured.csv"
        measured.write_text("displacement (mm),force (kN)\n0,0\n0.001,0.5\n")
        words = [program, "report", *results, "--measured", measured, "--force", "--out", report]
        subprocess.run(words, check=True, stdout=subprocess.DEVNULL)
        with browser.Browser() as page:
            begun = time.monotonic()
            page.open(report, READY)
            seconds = time.monotonic() - begun
            assert TITLE in page.value("document.querySelector('h1').textContent")
            run = described(page)["runs"][0]
            check_opened_at_peak(page, copy, run)
            check_sketch(page, copy, run)
            check_lost_graphics(page)
            n_values = check_values(page, copy, run)
            n_bonds = check_bonds(page, copy, run)
            check_controls(page, run)
            choose(page, "run", 1)
            drawn(page, Path(folders[0]).name)
            names = page.value("[...document.querySelectorAll('#curve .series span')].map((it) => it.textContent)")
            assert {it.name for it in results} <= set(names), names
            check_measured(page)
            check_opened_meshes(page)
            assert not page.complaints(), page.complaints()
        check_layouts(report)
        for solid in solids:
            more_values, more_bonds = check_solid(program, solid, folders[-1], Path(place))
            n_values, n_bonds = n_values + more_values, n_bonds + more_bonds
        if solids:
            check_layouts(Path(place) / "solid.html")
    print(f"report: {n_values} values under the pointer and {n_bonds} bonds as in the files, first picture after {seconds:.1f} s")


main(*sys.argv[1:])
