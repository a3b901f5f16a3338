// The page: what is seen (result, step, field, place), and what the reader does.

// Pixels from the pointer to a bond that it points at.
const REACH = 7;
// Share of the body that the usual displacement is drawn with; of a mode twice as much.
const DRAWN_SHARE = 0.05;

const element = (id) => document.getElementById(id);

class Page {
  constructor(description) {
    this.runs = description.runs.map((it) => new Run(it));
    this.run = this.runs[0];
    this.step = this.run.description.opensAt;
    this.camera = new Camera();
    this.first = this.newPane("first");
    // One beside the first as soon as results are compared.
    this.second = null;
    this.panes = [this.first];
    this.comparison = new Comparison(this.runs);
    this.panel = new Panel();
    this.charts = new Charts(this.runs, description.measured, (number, step) => this.go(step, this.runs[number]));
    this.asked = 0;
    this.askedBodies = 0;
    this.pinned = null;
    this.hovered = null;
    this.listen();
  }

  newPane(id) {
    const pane = new Pane(element(id), this.camera, () => {
      this.tellGraphics();
      this.redraw();
    });
    new ResizeObserver(() => this.redraw()).observe(pane.canvas);
    listenToPointers(pane, this);
    return pane;
  }

  async start() {
    options(element("run"), this.runs.map((run, number) => [number, run.label]));
    element("run").closest("label").hidden = this.runs.length < 2;
    element("runs").max = this.runs.length - 1;
    this.tellGraphics();
    await this.showRun(this.run);
    document.documentElement.dataset.ready = "true";
  }

  // Says why the body is not drawn, where it is not.
  tellGraphics() {
    const without = this.panes.filter((it) => !it.scene.drawing);
    const isLost = without.some((it) => it.hadGraphics);
    element("no-view").hidden = without.length === 0;
    element("no-view").textContent = isLost
      ? "The browser took the graphics away; the body is drawn again as soon as it gives them back."
      : "This browser has no WebGL 2, so the body is not drawn; numbers and curves are here.";
  }

  // Another result: its fields, steps, curves and summary.
  async showRun(run) {
    if (run !== this.run) this.step = Math.min(this.step, run.steps.length - 1);
    this.run = run;
    Object.assign(element("step"), { max: run.steps.length - 1, value: this.step });
    element("step").closest(".steps").hidden = run.steps.length < 2;
    element("run").value = element("runs").value = this.runs.indexOf(run);
    for (const summary of document.querySelectorAll(".summary")) summary.hidden = Number(summary.dataset.run) !== this.runs.indexOf(run);
    this.charts.showRun(run);
    document.body.classList.toggle("solid", run.isSolid);
    await this.showBodies();
  }

  // The shown result, and the one that it is compared with.
  get wanted() {
    return [this.run, this.comparison.beside(this.run)].filter(Boolean);
  }

  // Compares with another result, or with none.
  async compare(run) {
    this.comparison.choose(run);
    await this.showBodies();
  }

  // The bodies of the results, and what can be seen of them.
  async showBodies() {
    const { wanted, run } = this;
    const asked = ++this.askedBodies;
    this.comparison.offer(run);
    const bodies = await Promise.all(wanted.map((it) => Promise.all([it.body(), it.vector("horizon", 0)])));
    if (asked !== this.askedBodies) return;
    if (wanted.length > 1) this.second ??= this.newPane("second");
    if (this.first.run !== run) this.offer(run);
    this.offerCracks(wanted);
    this.panes = [this.first, this.second].slice(0, wanted.length);
    this.panes.forEach((pane, place) => {
      const [body, horizons] = bodies[place];
      if (pane.run !== wanted[place]) pane.show(wanted[place], body, horizons?.[0]);
    });
    element("symbols").closest("label").hidden = this.panes.every((it) => it.symbols.isEmpty);
    this.letGo();
    this.hovered = null;
    this.panel.clear();
    this.camera.show(this.box, run.isSolid ? OBLIQUE : FROM_ABOVE);
    this.allowTouch();
    this.tellGraphics();
    await this.showStep();
  }

  // Two corners of the box around the bodies.
  get box() {
    const of = (end, outermost) => [0, 1, 2].map((axis) => outermost(...this.panes.map((it) => it.scene.box[end][axis])));
    return { low: of("low", Math.min), high: of("high", Math.max) };
  }

  // Whether the difference of two results is seen, in the pane of the coarser one.
  get isDifference() {
    return this.panes.length > 1 && this.comparison.isDifference;
  }

  // The panes that are seen.
  get shown() {
    return this.isDifference ? this.comparison.coarserFirst(this.panes).slice(0, 1) : this.panes;
  }

  // Controls of a result.
  offer(run) {
    const choice = this.first.run ? element("field").value : run.description.firstField;
    options(element("field"), run.choices.map((it) => [it.id, it.label]));
    element("field").value = run.choice(choice).id;
    this.offerMagnifications();
    element("forces").closest("label").hidden = run.isModes || !run.field("reaction");
    element("section").value = "";
    if (run.isModes) element("scale").value = "inner";
  }

  offerMagnifications() {
    const { size, usualDisplacement: usual } = this.run.description.body;
    const share = this.run.isModes ? 2 * DRAWN_SHARE : DRAWN_SHARE;
    const auto = usual > 0 ? roundedDown((share * size) / usual) : 1;
    const factors = [...new Set([0, 1, auto, 2 * auto, 5 * auto])].sort((one, other) => one - other);
    options(element("magnification"), factors.map((it) => [it, it === 0 ? "not drawn" : `× ${shortText(it, 1)}`]));
    // Fragments of a motion are where they have flown to.
    element("magnification").value = this.run.time ? 1 : auto;
  }

  // What cracks can be shown as in the panes of some results.
  offerCracks(runs) {
    const choices = [];
    const isAny = (of) => runs.some((it) => of(it.description));
    const isHalf = isAny(({ body }) => body.half);
    const isOpen = isAny(({ cracks }) => cracks?.simplices > 0);
    if (isOpen) choices.push(["open", isHalf ? "between cells" : "open"]);
    if (isAny(({ cracks }) => cracks?.lines)) choices.push(["lines", "lines"]);
    if (isOpen && this.run.isSolid) choices.push(["surface", "surface, by its opening"]);
    if (runs.some((it) => it.bonds)) choices.push(["bonds", "broken bonds"]);
    element("cracks").closest("label").hidden = choices.length === 0;
    // Cells of a cracked lattice are apart in any case.
    if (!(isOpen && isHalf)) choices.push(["none", "none"]);
    const before = this.first.run === this.run ? element("cracks").value : "";
    options(element("cracks"), choices);
    if (choices.some(([id]) => id === before)) element("cracks").value = before;
  }

  // How cracks are drawn: over a difference as the lines of both results, in place of opened bodies.
  get mode() {
    const chosen = element("cracks").value;
    return this.isDifference && chosen === "open" && this.panes.some((it) => it.run.description.cracks?.lines) ? "lines" : chosen;
  }

  get choice() {
    return this.run.choice(element("field").value);
  }

  // Goes to a step, perhaps of another result.
  async go(step, run = this.run) {
    if (!(step >= 0) || step >= run.steps.length) return;
    this.step = step;
    element("step").value = step;
    if (run === this.run) await this.showStep();
    else await this.showRun(run);
  }

  // Goes to another result, to the step at the same share of its largest force.
  async goToRun(number) {
    const run = this.runs[number];
    if (run && run !== this.run) await this.go(this.run.stepAlike(this.step, run), run);
  }

  // Reads and draws the step. Of several asked for in a row only the last is drawn.
  async showStep() {
    const { run, step, choice, panes, wanted } = this;
    this.tellStep();
    // Bodies that are still read are drawn with the step as soon as they are there.
    if (wanted.length !== panes.length || wanted.some((it, place) => it !== panes[place].run)) return;
    const asked = ++this.asked;
    const { mode } = this;
    const states = await Promise.all(panes.map((pane) => pane.read(run === pane.run ? step : run.stepAlike(step, pane.run), choice, mode)));
    // One picture a frame: a slow machine would pile them up.
    await new Promise(requestAnimationFrame);
    if (asked !== this.asked || panes !== this.panes) return;
    panes.forEach((pane, place) => Object.assign(pane, states[place]));
    this.showPanes();
    this.place();
    this.charts.mark(run, step);
    this.showPoint();
    Object.assign(document.documentElement.dataset, {
      drawn: `${run.label} ${run.numberAt(step)} ${choice.id}`,
      compared: panes.slice(1).map((pane) => `${pane.run.label} ${pane.run.numberAt(pane.step)} ${this.isDifference ? "difference" : "both"}`).join(),
    });
  }

  // Shows the panes that are seen, each with a line of words where there are two.
  showPanes() {
    const { panes, shown } = this;
    element("panes").classList.toggle("two", shown.length > 1);
    for (const pane of [this.first, this.second]) if (pane) pane.element.hidden = !shown.includes(pane);
    // Beside the picture, whichever it is.
    const { stage } = shown.at(-1);
    if (!stage.contains(element("zoom"))) stage.append(element("zoom"), element("no-view"));
    const [coarse, fine] = panes.length > 1 ? this.comparison.coarserFirst(panes) : [];
    for (const pane of shown) {
      pane.caption.hidden = panes.length < 2;
      const state = (it) => `${it.run.label}: ${stateText(it.run, it.step)}`;
      pane.caption.textContent = this.isDifference ? `${state(fine)}; less ${state(coarse)}` : panes.length > 1 ? state(pane) : "";
    }
  }

  tellStep() {
    const { run, step } = this;
    const row = run.rows[step];
    const words = [run.whenAt(step)];
    const told = run.isModes ? ["frequency"] : ["displacement", "reaction"];
    for (const name of run.time ? [] : told) {
      const column = run.history.get(name);
      const value = run.valueAt(name, step);
      if (value !== undefined) words.push(withUnit(shortText(value * 10 ** column.shift), column.unit));
    }
    const atRest = run.history.get("at_rest")?.values[row];
    if (atRest === 0) words.push("not converged");
    element("step-text").textContent = words.join(", ");
  }

  // The deformed bodies, cut and opened as it is asked for.
  place() {
    if (this.panes.some((it) => !it.values)) return;
    const axis = element("section").value;
    const isCut = axis !== "" && this.run.isSolid;
    element("cut-label").hidden = !isCut;
    const { low, high } = this.first.scene.box;
    const at = isCut ? low[axis] + Number(element("cut").value) * (high[axis] - low[axis]) : 0;
    // Beside the points, which lie in planes of many meshes.
    const section = isCut ? { axis: Number(axis), at: at + 1e-6 * (high[axis] - low[axis]) } : null;
    element("cut-text").textContent = isCut ? `${"xyz"[axis]} = ${shortText(1e3 * at)} mm` : "";
    for (const pane of this.panes) pane.place({ factor: Number(element("magnification").value), mode: this.mode, section });
    this.colour();
  }

  colour() {
    if (this.panes.some((it) => !it.values)) return;
    const { choice, isDifference } = this;
    element("scale").closest("label").hidden = isDifference;
    const shown = { label: choice.label, unit: choice.field.unit, map: mapOf(choice.field.name), note: "" };
    if (isDifference) this.colourDifference(shown);
    else this.colourValues(shown);
    this.redraw();
  }

  // The colours of the values in all panes.
  colourValues(shown) {
    const { choice, first } = this;
    const scale = element("scale").value;
    const { shift } = choice.field;
    let values = this.panes.map((it) => it.values);
    let range = scale === "all" ? this.rangeOfSteps(shift) : rangeOfValues(values.flatMap((it) => Array.from(it)), scale === "inner" ? 0.01 : 0);
    if (first.scene.isSurface) {
      const { unit, shift: power } = this.run.field("displacement");
      values = [first.scene.crack.values.map((it) => it * 10 ** power)];
      Object.assign(shown, { label: "crack opening", unit, map: "damage" });
      range = [0, rangeOfValues(values[0], 0.01)[1]];
    }
    const without = this.panes.filter((it) => !it.choice).map((it) => it.run.label);
    if (without.length > 0) shown.note = `grey, without this field: ${without.join(", ")}`;
    this.range = colourRange(...range, shown.map);
    const bytes = colourTable(this.range.map);
    this.panes.forEach((pane, place) => pane.colour(values[place], this.range, bytes));
    this.showLegend(bytes, shown);
  }

  // The range of the field over the steps of all panes.
  rangeOfSteps(shift) {
    const ranges = this.panes.filter((it) => it.choice).map((it) => it.run.range(it.choice, shift));
    return [Math.min(...ranges.map(([low]) => low)), Math.max(...ranges.map(([, high]) => high))];
  }

  // The colours of the difference, in the pane of the coarser result.
  colourDifference(shown) {
    const { values, outside, coarse } = this.comparison.difference(this.panes);
    this.range = differenceRange(values);
    const bytes = colourTable(this.range.map);
    coarse.colour(values, this.range, bytes);
    const missing = this.panes.find((it) => !it.choice);
    const cracks = this.mode === "lines" ? "; cracks: finer black, coarser green" : "";
    const grey = outside > 0 ? `; grey: ${outside} of ${values.length} points outside of the finer body` : "";
    const note = missing ? `grey: without this field in ${missing.run.label}` : `at the points of the coarser result, 98 % within these ends${grey}${cracks}`;
    this.showLegend(bytes, { ...shown, label: `finer less coarser: ${shown.label}`, note });
  }

  showLegend(bytes, { label, unit, note }) {
    const bar = element("legend-bar");
    const picture = new ImageData(new Uint8ClampedArray(bytes), bar.width, 1);
    bar.getContext("2d").putImageData(picture, 0, 0);
    element("legend-low").textContent = shortText(this.range.low);
    element("legend-high").textContent = shortText(this.range.high);
    element("legend-name").textContent = labelWithUnit(label, unit);
    element("legend-note").hidden = !note;
    element("legend-note").textContent = note;
  }

  redraw() {
    const finer = this.isDifference ? this.comparison.coarserFirst(this.panes)[1] : null;
    for (const pane of this.shown) {
      pane.draw({
        mode: this.mode,
        isOverRed: this.range?.map !== "cividis",
        withForces: element("forces").checked,
        withSymbols: element("symbols").checked,
        finer,
      });
    }
    if (this.run.isSolid) drawAxes(element("axes"), this.camera);
    this.mark();
  }

  // The point that is kept or under the pointer, with its pane.
  get pointed() {
    return this.pinned ?? this.hovered;
  }

  // What each pane has at the place of the pointed point.
  get seen() {
    const { pointed } = this;
    return this.panes.map((pane) => {
      if (!pointed || !pane.values) return null;
      if (pane === pointed.pane) return pane.seen(pointed.point);
      const { x, y } = pointed.pane.body;
      return pane.seenAt(x[pointed.point], y[pointed.point]);
    });
  }

  mark() {
    const { seen } = this;
    const horizons = this.panes.map((pane, place) => (seen[place] && pane.horizons ? pane.horizons[seen[place].point] : 0));
    // One pane has the circles of both results.
    this.panes.forEach((pane, place) => pane.mark(seen[place], [horizons[place], this.isDifference ? horizons[1 - place] : 0]));
  }

  // The values of the pointed point, and beside them those of the compared result.
  showPoint() {
    const { pointed, panes } = this;
    if (!pointed) return;
    const { pane, point } = pointed;
    this.panel.showPoint(pane.run, pane.body, point, pane.step, pane.choice ?? pane.run.choice(""));
    const { label, field } = this.choice;
    const heads = ["", labelWithUnit(label, field.unit), "horizon (mm)"];
    this.panel.showCompared(panes.length > 1 ? [heads, ...this.comparison.rows(panes, this.seen, pointed)] : []);
  }

  hover(pane, px, py) {
    if (this.pinned !== null) {
      if (pane !== this.pinned.pane) return;
      const pixels = (point) => pane.scene.pixelOf(point).slice(0, 2);
      const distances = pane.family.map((it) => distanceToSegment(px, py, it.ends.flatMap(pixels)));
      const nearest = distances.indexOf(Math.min(...distances));
      if (distances[nearest] <= REACH) this.chooseBond(pane.family[nearest].bond);
      return;
    }
    const point = pane.scene.pointAt(px, py);
    if (point === (this.hovered?.point ?? null) && (point === null || pane === this.hovered.pane)) return;
    this.hovered = point === null ? null : { pane, point };
    this.mark();
    this.showPoint();
  }

  letGo() {
    this.pinned = null;
    for (const pane of this.panes) pane.letGo();
  }

  // Keeps a point of a pane and shows its bonds; without one lets go.
  async pin(pane, point) {
    this.letGo();
    const pinned = point === null ? null : { pane, point };
    this.pinned = pinned;
    this.hovered = pinned;
    if (point === null) this.panel.bondValues.replaceChildren();
    this.redraw();
    if (point === null) return;
    this.showPoint();
    const { run, body } = pane;
    if (!run.bonds) return;
    const family = await this.familyOf(pane, point);
    if (this.pinned !== pinned) return;
    pane.family = family;
    this.redraw();
    await this.panel.showBonds(run, body, point, family, null, (bond) => this.chooseBond(bond));
  }

  async familyOf({ run, body: { x, y, z } }, point) {
    const [ends, breaks] = await Promise.all([run.bonds.ends(), run.bonds.breaks()]);
    const absent = await run.bonds.columns.find((it) => it.name === "absent")?.column.multiples(0);
    const bonds = Array.from(ends.ofPoints.subarray(ends.first[point], ends.first[point + 1]));
    return bonds.map((bond) => {
      const [a, b] = [ends.a[bond], ends.b[bond]];
      const along = [x[b] - x[a], y[b] - y[a], z[b] - z[a]];
      return {
        bond, ends: [a, b], other: a === point ? b : a, length: Math.hypot(...along), along,
        isBroken: breaks.order[bond] >= 0 || absent?.[bond] > 0,
      };
    });
  }

  chooseBond(bond) {
    const pane = this.pinned?.pane;
    if (!pane || bond === pane.chosenBond) return;
    pane.chosenBond = bond;
    const found = pane.family.find((it) => it.bond === bond);
    if (found) this.panel.showBond(pane.run, pane.body, found);
    this.redraw();
  }

  listen() {
    element("run").addEventListener("change", (event) => this.goToRun(Number(event.target.value)));
    element("runs").addEventListener("input", (event) => this.goToRun(Number(event.target.value)));
    element("field").addEventListener("change", () => {
      for (const { run } of this.panes) run.keepOnly(run.field(this.choice.field.name));
      this.showStep();
    });
    element("compared").addEventListener("change", (event) => this.compare(this.runs[event.target.value] ?? null));
    element("view").addEventListener("change", (event) => this.showDifference(event.target.value === "difference"));
    element("scale").addEventListener("change", () => this.colour());
    element("magnification").addEventListener("change", () => this.place());
    element("cracks").addEventListener("change", () => this.showStep());
    element("section").addEventListener("change", () => this.place());
    element("cut").addEventListener("input", () => this.place());
    for (const id of ["forces", "symbols"]) element(id).addEventListener("change", () => this.redraw());
    element("save-body").addEventListener("click", () => this.saveBody());
    for (const button of document.querySelectorAll("[data-view]")) button.addEventListener("click", () => this.look(button.dataset.view));
    element("step").addEventListener("input", (event) => this.go(Number(event.target.value)));
    element("play").addEventListener("click", () => this.play());
    for (const [id, factor] of [["zoom-in", 1.5], ["zoom-out", 1 / 1.5], ["zoom-fit", 0]]) {
      element(id).addEventListener("click", () => this.zoom(factor));
    }
    element("theme").addEventListener("click", switchTheme);
    document.addEventListener("keydown", (event) => this.key(event));
    window.addEventListener("beforeprint", () => this.print(true));
    window.addEventListener("afterprint", () => this.print(false));
  }

  // The picture of the body, or the pictures of both beside one another.
  saveBody() {
    const [first, ...others] = this.shown.map((it) => it.canvas);
    const names = [...this.wanted.map((it) => it.label), this.isDifference ? "difference" : "", this.choice.id, this.run.numberAt(this.step)];
    let whole = first;
    if (others.length > 0) {
      whole = Object.assign(document.createElement("canvas"), { width: first.width + others[0].width, height: first.height });
      [first, ...others].forEach((it, place) => whole.getContext("2d").drawImage(it, place * first.width, 0));
    }
    save(whole.toDataURL("image/png"), `${names.filter((it) => it !== "").join("-")}.png`);
  }

  // Shows the difference of the compared results in place of both.
  async showDifference(isDifference) {
    this.comparison.isDifference = isDifference;
    this.comparison.offer(this.run);
    await this.showStep();
  }

  zoom(factor, px, py) {
    if (factor === 0) this.camera.reset();
    else this.camera.zoomBy(factor, px, py);
    this.allowTouch();
    this.redraw();
  }

  move(dx, dy) {
    this.camera.moveBy(dx, dy);
    this.redraw();
  }

  drag(dx, dy, moves) {
    if (this.run.isSolid && !moves) {
      this.camera.turnBy(dx, dy);
      this.redraw();
    } else this.move(dx, dy);
  }

  look(view) {
    this.camera.reset(VIEWS[view]);
    this.allowTouch();
    this.redraw();
  }

  // A finger turns a solid; over the whole body in the plane it scrolls the page, and moves the body once it is larger.
  allowTouch() {
    for (const { canvas } of this.panes) canvas.style.touchAction = this.run.isSolid || this.camera.zoom > 1.01 ? "none" : "pan-y";
  }

  key(event) {
    const pane = this.shown.find((it) => it.canvas === event.target);
    const isOnBody = Boolean(pane);
    const isElsewhere = event.target !== document.body && !isOnBody;
    if (isElsewhere || event.ctrlKey || event.metaKey || event.altKey) return;
    const moves = { ArrowLeft: [40, 0], ArrowRight: [-40, 0], ArrowUp: [0, 40], ArrowDown: [0, -40] };
    if (event.shiftKey && moves[event.key]) this.move(...moves[event.key]);
    else if (this.run.isSolid && isOnBody && VIEWS[event.key]) this.look(event.key);
    else if (event.key === "ArrowLeft") this.go(this.step - 1);
    else if (event.key === "ArrowRight") this.go(this.step + 1);
    else if (event.key === "PageUp" && this.runs.length > 1) this.goToRun(this.runs.indexOf(this.run) - 1);
    else if (event.key === "PageDown" && this.runs.length > 1) this.goToRun(this.runs.indexOf(this.run) + 1);
    else if (event.key === "Home" && isOnBody) this.go(0);
    else if (event.key === "End" && isOnBody) this.go(this.run.steps.length - 1);
    else if (event.key === "+" || event.key === "=") this.zoom(1.25);
    else if (event.key === "-") this.zoom(1 / 1.25);
    else if (event.key === "0") this.zoom(0);
    else if (event.key === "c" && !element("compared").closest("label").hidden) this.compare(this.wanted[1] ? null : this.comparison.usual(this.run));
    else if (event.key === "d" && !element("view").closest("label").hidden) this.showDifference(!this.isDifference);
    else if (event.key === "Enter" && isOnBody) this.pin(pane, pane.scene.pointAt(this.camera.width / 2, this.camera.height / 2));
    else if (event.key === "Escape") this.pin(null, null);
    else return;
    event.preventDefault();
  }

  // Goes through the steps until the last, or until it is asked to stop.
  async play() {
    const button = element("play");
    this.isPlaying = !this.isPlaying;
    button.textContent = this.isPlaying ? "⏸" : "▶";
    if (this.isPlaying && this.step === this.run.steps.length - 1) await this.go(0);
    while (this.isPlaying && this.step < this.run.steps.length - 1) {
      await new Promise((done) => { setTimeout(done, 100); });
      if (this.isPlaying) await this.go(this.step + 1);
    }
    this.isPlaying = false;
    button.textContent = "▶";
  }

  // What is seen, for paper.
  print(isBefore) {
    for (const pane of this.shown) pane.print(isBefore);
    if (!isBefore) this.redraw();
  }
}

// The directions of the axes, as seen.
function drawAxes(canvas, camera) {
  const pen = canvas.getContext("2d");
  const middle = canvas.width / 2;
  const colour = getComputedStyle(canvas).color;
  pen.clearRect(0, 0, canvas.width, canvas.height);
  Object.assign(pen, { font: "13px sans-serif", textAlign: "center", textBaseline: "middle", strokeStyle: colour, fillStyle: colour, lineWidth: 1.5 });
  ["x", "y", "z"].forEach((name, axis) => {
    const [dx, dy] = [camera.right[axis], -camera.up[axis]];
    if (Math.hypot(dx, dy) < 0.05) return;
    pen.beginPath();
    pen.moveTo(middle, middle);
    pen.lineTo(middle + 22 * dx, middle + 22 * dy);
    pen.stroke();
    pen.fillText(name, middle + 30 * dx, middle + 30 * dy);
  });
}

// 1, 2 or 5 times a power of ten, at most a value.
function roundedDown(value) {
  const power = 10 ** Math.floor(Math.log10(value));
  return [5, 2, 1].map((it) => it * power).find((it) => it <= value * (1 + 1e-9)) ?? power;
}

function options(select, choices) {
  select.replaceChildren(...choices.map(([value, text]) => new Option(text, value)));
}

function switchTheme() {
  const { dataset } = document.documentElement;
  const isDark = dataset.theme ? dataset.theme === "dark" : window.matchMedia("(prefers-color-scheme: dark)").matches;
  dataset.theme = isDark ? "light" : "dark";
}
