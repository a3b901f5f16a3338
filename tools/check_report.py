#!/usr/bin/env python3
"""Checks in Chromium the page that `ligament report` makes of result folders: check_report.py PROGRAM FOLDER...

The last of the folders in the plane must have broken bonds and several steps, and so must solids; one in the plane must be a mesh that breaks.
Values under the pointer must be those of the VTU files to half of the last digit shown, bonds those of model.vtu and breaks.csv. Meshes open along
their cracks. Solids turn and are cut. Of two studies, which it runs itself, two results are compared: their panes and their difference, against an
interpolation of the VTU files. Nothing may be asked of a network or complained of in the console.
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
ROOT = Path(__file__).resolve().parents[1]
# How far outside of a triangle a place still belongs to it, over its height, and the share of the differences within the ends of the colours.
OUTSIDE, WITHIN = 0.1, 0.98
# Studies whose results are compared: the case, its settings and the axis, a result of few points first. The tall plate has not all of the others;
# `same` is the first once more.
STUDIES = {
    "meshes": (
        "plate-tension",
        "probe = []",
        f"key = 'mesh.file'\nvalues = {[str(ROOT / 'meshes' / it) for it in ('plate-coarse.msh', 'plate.msh', 'plate-tall.msh', '../meshes/plate-coarse.msh')]}\n"
        "labels = ['coarse', 'fine', 'tall', 'same']",
    ),
    "lattices": (
        "lattice-plate",
        "'fracture.stop.bonds' = 5",
        "keys = ['lattice.cells', 'lattice.spacing']\nvalues = [[[16, 24], 5e-3], [[40, 60], 2e-3]]\nlabels = ['coarse', 'fine']",
    ),
}
# Colours of crack lines over a difference: of the coarser result and of the finer one.
CRACK_COLOURS = (0, 140, 64), (13, 13, 13)
# Fields that are compared: of a value, of a vector, and of large values.
COMPARED = ("damage", "displacement", "strain_energy_density")
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
        assert page.value("document.getElementById('compared').offsetHeight") == 0, "beside a solid alone it is compared with nothing"
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


def run_study(program, name, place):
    """Runs a study; returns its page and the folders of its runs by label."""
    case, settings, axis = STUDIES[name]
    study = place / f"{name}.toml"
    study.write_text(f"title = '{name}'\ncase = '{ROOT}/cases/{case}/case.toml'\n[set]\n{settings}\n[[axis]]\n{axis}\n")
    folder, report = place / name, place / f"{name}.html"
    for words in (["sweep", study, "--out", folder], ["report", folder, "--digits", "6", "--out", report]):
        subprocess.run([program, *words], check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    return report, {it.name.partition("=")[2]: it for it in (folder / "runs").iterdir()}


def triangles_of(folder):
    """The triangles of the mesh of a run in the plane."""
    return np.concatenate([it.data for it in meshio.read(min(folder.glob("fields_*.vtu"))).cells if it.type == "triangle"])


def mesh_values(values, places, triangles, at):
    """Values at a place inside of a mesh, linear in the triangle in which it is deepest; None outside."""
    a, b, c = (places[triangles[:, it], :2] for it in range(3))
    shares = np.linalg.solve(np.stack([b - a, c - a], axis=2), (at - a)[:, :, None])[:, :, 0]
    shares = np.column_stack([1.0 - shares.sum(axis=1), shares])
    deepest = shares.min(axis=1).argmax()
    if shares[deepest].min() < -OUTSIDE:
        return None
    own = np.maximum(shares[deepest], 0.0)
    return own / own.sum() @ values[triangles[deepest]]


def lattice_values(values, places, spacing, at):
    """Values at a place between centres of the cells of a lattice, linear along each axis; None where one of the four cells is not there."""
    shares = np.maximum(1.0 - np.abs(places[:, :2] - at) / spacing, 0.0).prod(axis=1)
    return shares @ values if shares.sum() > 1.0 - 1e-4 else None


def differences(own, there):
    """Values at the points of the coarser result, of the finer one there (NaN outside), and their difference; of vectors their lengths."""
    size = (lambda it: np.linalg.norm(it, axis=1)) if own.shape[1] > 1 else (lambda it: it[:, 0])
    difference = size(there) - size(own)
    # Shares of points sum to one but for rounding.
    difference[np.abs(difference) < 1e-12 * np.abs(size(own)).max()] = 0.0
    return size(own), size(there), difference


def exact_comparison(runs, folders, labels, steps):
    """Factors to the unit of each field, values and differences by field, and points by tag, of the files of two results, the coarser first."""
    coarse, fine = (fields(folders[label], step) for label, step in zip(labels, steps, strict=True))
    # Positions are rounded in the page, and between them a field may change by more than its last digit.
    for stored, label in zip((coarse, fine), labels, strict=True):
        stored["places"] = np.round(stored["places"], -runs[label]["body"]["position"][0]["exponents"][0])
    body = runs[labels[0]]["body"]
    exact = {"points": {int(tag): point for point, tag in enumerate(coarse[body["tagged"]].ravel())}, "horizon": coarse["horizon"].ravel()}
    triangles = None if body["half"] else triangles_of(folders[labels[1]])
    for field in COMPARED:
        values = fine[field].reshape(len(fine["places"]), -1)
        own = coarse[field].reshape(len(coarse["places"]), -1)
        there = np.full(own.shape, np.nan)
        for point, at in enumerate(coarse["places"][:, :2]):
            if body["half"]:
                found = lattice_values(values, fine["places"], fine["nearest_distance"].min(), at)
            else:
                found = mesh_values(values, fine["places"], triangles, at)
            there[point] = np.nan if found is None else found
        factor = 10.0 ** next(it["shift"] for it in runs[labels[0]]["fields"] if it["name"] == field)
        exact[field] = [factor * it for it in differences(own, there)]
    return exact


def compared_rows(page):
    """Numbers of the table of two compared results with half of their last digits, the name of each row, and its horizon, mm."""
    rows = page.value("[...document.querySelectorAll('#compared-values tbody tr')].map((row) => [...row.cells].map((it) => it.textContent))")
    return [(name, number(value) if re.search(r"\d", value) else value, float(horizon or "nan")) for name, value, horizon in rows]


def point_at(page, selector, across, down):
    left, top, width, height = page.box(selector)
    page.mouse("mouseMoved", 2, 2)
    page.mouse("mouseMoved", left + across * width, top + down * height)
    return not page.value("document.querySelector('#first .marker').hidden")


def check_circles(page, rows, scale_of):
    """Circles at the same place in both panes, with radii of one scale."""
    circles = "[...document.querySelectorAll('.pane .horizon:not([hidden])')].map((it) => [it.offsetWidth, it.style.transform])"
    centres = []
    for (_, _, horizon), (width, transform) in zip(rows, page.value(circles), strict=False):
        centres.append([float(it) + 0.5 * width for it in re.findall(r"-?[\d.]+(?=px)", transform)])
        scale_of.append(0.5 * width / horizon)
    assert len(centres) == 2, centres
    # Widths are whole pixels.
    assert np.abs(np.subtract(*centres)).max() < 1.5, centres


def check_two_panes(page, exact, field):
    """Two panes have one camera and the values of both results; returns how many values it compared."""
    second = "document.querySelector('#second .picture').toDataURL()"
    before = page.value(second)
    page.value("document.getElementById('zoom-in').click(); 0")
    assert page.value(second) != before, "both panes are larger"
    page.value("document.getElementById('zoom-fit').click(); 0")
    assert page.value(second) == before
    scales, count = [], 0
    for across, down in [(0.5, 0.45), (0.4, 0.48), (0.45, 0.6), (0.35, 0.65), (0.25, 0.72), (0.2, 0.6)]:
        if not point_at(page, "#first .picture", across, down):
            continue
        rows = compared_rows(page)
        point = exact["points"][int(rows[0][0].split()[-1])]
        if np.isnan(exact[field][1][point]):
            continue
        for (name, (shown, half), _), value in zip(rows, exact[field], strict=True):
            # The page has rounded both components of both results: with the last digit shown that is 1.9 units of it.
            assert abs(shown - value[point]) <= 5 * half, (name, shown, value[point])
            count += 1
        assert abs(rows[0][2] - 1e3 * exact["horizon"][point]) <= 0.01 * rows[0][2], rows
        check_circles(page, rows, scales)
    assert count >= 6, "the pointer was over the bodies"
    assert np.ptp(scales) < 0.1 * np.mean(scales), scales
    return count


def check_difference(page, exact, field, is_known):
    """The difference is seen at the points of the coarser result alone, with an even scale; returns how many are outside of the finer body.

    The page tells this number, which is compared where it is known exactly: of meshes.
    """
    page.value("document.activeElement.blur(); 0")
    page.key("d", "d")
    page.until("document.documentElement.dataset.compared.endsWith('difference')")
    assert page.value("document.querySelectorAll('.pane:not([hidden])').length") == 1
    values = exact[field][2]
    sizes = np.sort(np.abs(values[np.abs(values) > 0]))
    low, high = (number(page.value(f"document.getElementById('legend-{it}').textContent")) for it in ("low", "high"))
    assert low[0] == -high[0]
    # Values that are zero in one place and rounding in another move the quantile by a point.
    near = sizes[[max(int(np.ceil(WITHIN * len(sizes))) + it, 0) for it in (-2, -1)]] if len(sizes) else [1.0, 1.0]
    assert near[0] - 2e-3 * near[1] <= high[0] <= near[1] * 1.002, (high, near)
    said = re.search(r"grey: (\d+) of (\d+)", page.value("document.getElementById('legend-note').textContent"))
    outside = int(np.isnan(values).sum())
    assert (int(said[1]) if said else 0) == outside or not is_known, (said, outside)
    page.key("d", "d")
    page.until("document.documentElement.dataset.compared.endsWith('both')")
    return outside


def check_crack_lines(page, runs, labels, steps):
    """Over the difference are the crack lines of both results: those of the finer one black, of the coarser one green."""
    choose(page, "cracks", "open" if "open" in page.value("[...document.getElementById('cracks').options].map((it) => it.value)") else "lines")
    page.key("d", "d")
    page.until("document.documentElement.dataset.compared.endsWith('difference')")
    for label, step, colour in zip(labels, steps, CRACK_COLOURS, strict=True):
        lines = [it for it in runs[label]["cracks"]["lines"][: runs[label]["steps"].index(step) + 1] if it is not None][-1]
        seen = pixels(page, colour)
        assert (len(seen) > 5) == bool(lines), (label, len(seen), lines)
    page.key("d", "d")
    page.until("document.documentElement.dataset.compared.endsWith('both')")


def check_pair(page, runs, folders, other):
    """Compares the coarse result with another; returns how many values it compared, and how many points are outside of the other body."""
    labels = ["coarse", other]
    choose(page, "compared", list(runs).index(other))
    page.until(f"document.documentElement.dataset.compared.startsWith({json.dumps(runs[other]['label'])})")
    said = [page.value(f"document.documentElement.dataset.{it}") for it in ("drawn", "compared")]
    steps = [int(it.removeprefix(runs[label]["label"]).split()[0]) for it, label in zip(said, labels, strict=True)]
    exact = exact_comparison(runs, folders, labels, steps)
    count = 0
    for field in COMPARED:
        choose(page, "field", field)
        drawn(page, field)
        count += check_two_panes(page, exact, field)
        outside = check_difference(page, exact, field, is_known=not runs[other]["body"]["half"])
    if other == "same":
        assert not any(np.any(exact[field][2]) for field in COMPARED), "a result has no difference from itself"
        assert page.value("document.querySelector('#compared-values tbody tr:last-of-type').cells[1].textContent") == "0"
    check_crack_lines(page, runs, labels, steps)
    return count, outside


def check_compared(program, place):
    """Results of studies side by side and their difference; returns how many values it compared."""
    count = 0
    for name, others in {"meshes": ["fine", "tall", "same"], "lattices": ["fine"]}.items():
        report, folders = run_study(program, name, place)
        with browser.Browser() as page:
            page.open(report, READY)
            runs = {it["label"].partition(" = ")[2]: it for it in described(page)["runs"]}
            choose(page, "run", list(runs).index("coarse"))
            drawn(page, "coarse")
            assert page.value("document.getElementById('compared').offsetHeight") > 0, "several results can be compared"
            # Bodies before their displacements lie at the same places.
            choose(page, "magnification", 0)
            for other in others:
                more, outside = check_pair(page, runs, folders, other)
                count += more
                assert (outside > 0) == (other == "tall") or name == "lattices", (other, outside)
            choose(page, "compared", "")
            page.until("document.getElementById('second').hidden && !document.documentElement.dataset.compared")
            assert not page.complaints(), page.complaints()
        with browser.Browser(width=390, height=844, mobile=True) as page:
            page.open(report, READY)
            choose(page, "compared", 1)
            page.until("document.documentElement.dataset.compared")
            assert page.value("document.documentElement.scrollWidth") <= 390
            first, second = page.box("#first"), page.box("#second")
            assert second[1] >= first[1] + first[3], "panes are below one another"
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
        n_compared = check_compared(program, Path(place))
        for solid in solids:
            more_values, more_bonds = check_solid(program, solid, folders[-1], Path(place))
            n_values, n_bonds = n_values + more_values, n_bonds + more_bonds
        if solids:
            check_layouts(Path(place) / "solid.html")
    print(f"report: {n_values} values under the pointer, {n_compared} compared ones and {n_bonds} bonds as in the files, first picture after {seconds:.1f} s")


main(*sys.argv[1:])
