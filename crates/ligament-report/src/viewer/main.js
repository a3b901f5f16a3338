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
    this.canvas = element("body");
    this.scene = new Scene(this.canvas, () => {
      this.tellGraphics();
      this.redraw();
    });
    this.lines = new Lines(this.scene);
    this.symbols = new Symbols(this.scene);
    this.panel = new Panel();
    this.charts = new Charts(this.runs, description.measured, (number, step) => this.go(step, this.runs[number]));
    this.asked = 0;
    this.pinned = null;
    this.family = [];
    this.chosenBond = null;
    this.listen();
  }

  async start() {
    options(element("run"), this.runs.map((run, number) => [number, run.label]));
    element("run").closest("label").hidden = this.runs.length < 2;
    element("runs").max = this.runs.length - 1;
    this.hadGraphics = Boolean(this.scene.drawing);
    this.tellGraphics();
    await this.showRun(this.run);
    document.documentElement.dataset.ready = "true";
  }

  // Says why the body is not drawn, where it is not.
  tellGraphics() {
    const isLost = this.hadGraphics && !this.scene.drawing;
    element("no-view").hidden = Boolean(this.scene.drawing);
    element("no-view").textContent = isLost
      ? "The browser took the graphics away; the body is drawn again as soon as it gives them back."
      : "This browser has no WebGL 2, so the body is not drawn; numbers and curves are here.";
  }

  // Another result: its fields, steps, curves and summary.
  async showRun(run) {
    const isOther = run !== this.run;
    this.run = run;
    if (isOther) this.step = Math.min(this.step, run.steps.length - 1);
    Object.assign(element("step"), { max: run.steps.length - 1, value: this.step });
    element("step").closest(".steps").hidden = run.steps.length < 2;
    element("run").value = element("runs").value = this.runs.indexOf(run);
    for (const summary of document.querySelectorAll(".summary")) summary.hidden = Number(summary.dataset.run) !== this.runs.indexOf(run);
    this.charts.showRun(run);
    document.body.classList.toggle("solid", run.isSolid);
    await this.showBody(run, isOther);
    await this.showStep();
  }

  // The body of a result, and what can be seen of it.
  async showBody(run, isOther) {
    const choice = isOther ? element("field").value : run.description.firstField;
    options(element("field"), run.choices.map((it) => [it.id, it.label]));
    element("field").value = run.choice(choice).id;
    this.offerMagnifications();
    this.offerCracks();
    element("forces").closest("label").hidden = run.isModes || !run.field("reaction");
    element("section").value = "";
    if (run.isModes) element("scale").value = "inner";
    this.pinned = null;
    this.hovered = null;
    this.family = [];
    this.panel.clear();
    this.body = await run.body();
    this.horizons = (await run.vector("horizon", 0))?.[0];
    this.scene.show(this.body);
    this.lines.show(run, this.body);
    this.symbols.show(run);
    element("symbols").closest("label").hidden = this.symbols.isEmpty;
    this.allowTouch();
  }

  offerMagnifications() {
    const { size, usualDisplacement: usual } = this.run.description.body;
    const share = this.run.isModes ? 2 * DRAWN_SHARE : DRAWN_SHARE;
    const auto = usual > 0 ? roundedDown((share * size) / usual) : 1;
    const factors = [...new Set([0, 1, auto, 2 * auto, 5 * auto])].sort((one, other) => one - other);
    options(element("magnification"), factors.map((it) => [it, it === 0 ? "not drawn" : `× ${shortText(it, 1)}`]));
    element("magnification").value = auto;
  }

  offerCracks() {
    const choices = [];
    const { cracks, body } = this.run.description;
    if (cracks?.simplices > 0) choices.push(["open", body.half ? "between cells" : "open"]);
    if (cracks?.lines) choices.push(["lines", "lines"]);
    if (cracks?.simplices > 0 && this.run.isSolid) choices.push(["surface", "surface, by its opening"]);
    if (this.run.bonds) choices.push(["bonds", "broken bonds"]);
    element("cracks").closest("label").hidden = choices.length === 0;
    // Cells of a cracked lattice are apart in any case.
    if (!(cracks?.simplices > 0 && body.half)) choices.push(["none", "none"]);
    options(element("cracks"), choices);
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
    const asked = ++this.asked;
    const { run, step, choice } = this;
    this.tellStep();
    const [values, displacement, broken, cut, reaction] = await Promise.all([
      run.values(choice, step), run.vector("displacement", step), this.readBroken(), run.cut(step), run.isModes ? null : run.vector("reaction", step),
    ]);
    // One picture a frame: a slow machine would pile them up.
    await new Promise(requestAnimationFrame);
    if (asked !== this.asked) return;
    Object.assign(this, { values, displacement, broken, cut, reaction });
    this.place();
    this.charts.mark(run, step);
    const point = this.pinned ?? this.hovered;
    if (point !== undefined && point !== null) this.panel.showPoint(run, this.body, point, step, choice);
    document.documentElement.dataset.drawn = `${run.label} ${run.steps[step]} ${choice.id}`;
  }

  tellStep() {
    const { run, step } = this;
    const row = run.rows[step];
    const words = [run.when(run.steps[step])];
    const told = run.isModes ? ["frequency"] : ["displacement", "reaction"];
    for (const name of run.time ? [] : told) {
      const column = run.history.get(name);
      if (column && row >= 0) words.push(withUnit(shortText(column.values[row] * 10 ** column.shift), column.unit));
    }
    const atRest = run.history.get("at_rest")?.values[row];
    if (atRest === 0) words.push("not converged");
    element("step-text").textContent = words.join(", ");
  }

  // The deformed body, cut and opened as it is asked for.
  place() {
    const axis = element("section").value;
    const isCut = axis !== "" && this.run.isSolid;
    element("cut-label").hidden = !isCut;
    const { low, high } = this.scene.box;
    const at = isCut ? low[axis] + Number(element("cut").value) * (high[axis] - low[axis]) : 0;
    // Beside the points, which lie in planes of many meshes.
    const section = isCut ? { axis: Number(axis), at: at + 1e-6 * (high[axis] - low[axis]) } : null;
    element("cut-text").textContent = isCut ? `${"xyz"[axis]} = ${shortText(1e3 * at)} mm` : "";
    this.scene.place({
      displacement: this.displacement, factor: Number(element("magnification").value), cut: this.cut, mode: element("cracks").value, section,
    });
    this.colour();
  }

  colour() {
    const { choice, run, scene } = this;
    const scale = element("scale").value;
    const shown = { values: this.values, label: choice.label, unit: choice.field.unit, map: mapOf(choice.field.name) };
    const ofSteps = choice.place === null ? [0, choice.field.magnitude] : choice.field.ranges[choice.place];
    const shift = 10 ** choice.field.shift;
    let range = scale === "all" ? ofSteps.map((it) => it * shift) : rangeOfValues(this.values, scale === "inner" ? 0.01 : 0);
    if (scene.isSurface) {
      const { unit, shift: power } = run.field("displacement");
      Object.assign(shown, { values: scene.crack.values.map((it) => it * 10 ** power), label: "crack opening", unit, map: "damage" });
      range = [0, rangeOfValues(shown.values, 0.01)[1]];
    }
    this.range = colourRange(...range, shown.map);
    const bytes = colourTable(this.range.map);
    scene.colour(shown.values, this.range, bytes);
    scene.upload();
    this.showLegend(bytes, shown);
    this.redraw();
  }

  showLegend(bytes, { label, unit }) {
    const bar = element("legend-bar");
    const picture = new ImageData(new Uint8ClampedArray(bytes), bar.width, 1);
    bar.getContext("2d").putImageData(picture, 0, 0);
    element("legend-low").textContent = shortText(this.range.low);
    element("legend-high").textContent = shortText(this.range.high);
    element("legend-name").textContent = labelWithUnit(label, unit);
  }

  // The ends of broken bonds in the state of the step.
  async readBroken() {
    const { run, step } = this;
    if (element("cracks").value !== "bonds" || !run.bonds) return null;
    const [ends, breaks, count] = await Promise.all([run.bonds.ends(), run.bonds.breaks(), run.bonds.countAt(run.steps[step])]);
    return Array.from(breaks.bond.subarray(0, count), (bond) => [ends.a[bond], ends.b[bond]]);
  }

  redraw() {
    if (!this.values || !this.scene.vertices) return;
    this.scene.draw(this.lines.layers({
      step: this.step,
      mode: element("cracks").value,
      broken: this.broken,
      family: this.family,
      chosen: this.chosenBond,
      reaction: element("forces").checked ? this.reaction : null,
      symbols: element("symbols").checked ? this.symbols : null,
      isOverRed: this.range.map !== "cividis",
    }));
    if (this.run.isSolid) drawAxes(element("axes"), this.scene.camera);
    this.mark();
  }

  mark() {
    const point = this.pinned ?? this.hovered;
    const [marker, horizon] = ["marker", "horizon"].map(element);
    marker.hidden = point === undefined || point === null;
    horizon.hidden = marker.hidden || !this.horizons;
    if (marker.hidden) return;
    const { camera } = this.scene;
    const [px, py] = this.scene.pixelOf(point);
    marker.hidden = px < 0 || py < 0 || px > camera.width || py > camera.height;
    marker.style.transform = `translate(${px}px, ${py}px)`;
    if (!this.horizons) return;
    // A circle as large as the horizon of the point in the body before its displacement.
    const radius = this.horizons[point] * camera.scale;
    Object.assign(horizon.style, { width: `${2 * radius}px`, height: `${2 * radius}px`, transform: `translate(${px - radius}px, ${py - radius}px)` });
  }

  hover(px, py) {
    if (this.pinned !== null) {
      const pixels = (point) => this.scene.pixelOf(point).slice(0, 2);
      const distances = this.family.map((it) => distanceToSegment(px, py, it.ends.flatMap(pixels)));
      const nearest = distances.indexOf(Math.min(...distances));
      if (distances[nearest] <= REACH) this.chooseBond(this.family[nearest].bond);
      return;
    }
    const point = this.scene.pointAt(px, py);
    if (point === this.hovered) return;
    this.hovered = point;
    this.mark();
    if (point !== null) this.panel.showPoint(this.run, this.body, point, this.step, this.choice);
  }

  // Keeps a point and shows its bonds; without one lets go.
  async pin(point) {
    this.pinned = point;
    this.hovered = point;
    this.family = [];
    this.chosenBond = null;
    if (point === null) this.panel.bondValues.replaceChildren();
    this.redraw();
    if (point === null) return;
    this.panel.showPoint(this.run, this.body, point, this.step, this.choice);
    if (!this.run.bonds) return;
    const family = await this.familyOf(point);
    if (this.pinned !== point) return;
    this.family = family;
    this.redraw();
    await this.panel.showBonds(this.run, this.body, point, this.family, null, (bond) => this.chooseBond(bond));
  }

  async familyOf(point) {
    const [ends, breaks] = await Promise.all([this.run.bonds.ends(), this.run.bonds.breaks()]);
    const { x, y, z } = this.body;
    const absent = await this.run.bonds.columns.find((it) => it.name === "absent")?.column.multiples(0);
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
    if (bond === this.chosenBond) return;
    this.chosenBond = bond;
    const found = this.family.find((it) => it.bond === bond);
    if (found) this.panel.showBond(this.run, this.body, found);
    this.redraw();
  }

  listen() {
    element("run").addEventListener("change", (event) => this.goToRun(Number(event.target.value)));
    element("runs").addEventListener("input", (event) => this.goToRun(Number(event.target.value)));
    element("field").addEventListener("change", () => {
      this.run.keepOnly(this.choice.field);
      this.showStep();
    });
    element("scale").addEventListener("change", () => this.colour());
    element("magnification").addEventListener("change", () => this.place());
    element("cracks").addEventListener("change", () => this.showStep());
    element("section").addEventListener("change", () => this.place());
    element("cut").addEventListener("input", () => this.place());
    for (const id of ["forces", "symbols"]) element(id).addEventListener("change", () => this.redraw());
    element("save-body").addEventListener("click", () => save(this.canvas.toDataURL("image/png"), `${this.run.label}-${this.choice.id}-${this.run.steps[this.step]}.png`));
    for (const button of document.querySelectorAll("[data-view]")) button.addEventListener("click", () => this.look(button.dataset.view));
    element("step").addEventListener("input", (event) => this.go(Number(event.target.value)));
    element("play").addEventListener("click", () => this.play());
    for (const [id, factor] of [["zoom-in", 1.5], ["zoom-out", 1 / 1.5], ["zoom-fit", 0]]) {
      element(id).addEventListener("click", () => this.zoom(factor));
    }
    element("theme").addEventListener("click", switchTheme);
    new ResizeObserver(() => this.redraw()).observe(this.canvas);
    listenToPointers(this.canvas, this);
    document.addEventListener("keydown", (event) => this.key(event));
    window.addEventListener("beforeprint", () => this.print(true));
    window.addEventListener("afterprint", () => this.print(false));
  }

  zoom(factor, px, py) {
    if (factor === 0) this.scene.camera.reset();
    else this.scene.camera.zoomBy(factor, px, py);
    this.allowTouch();
    this.redraw();
  }

  move(dx, dy) {
    this.scene.camera.moveBy(dx, dy);
    this.redraw();
  }

  drag(dx, dy, moves) {
    if (this.run.isSolid && !moves) {
      this.scene.camera.turnBy(dx, dy);
      this.redraw();
    } else this.move(dx, dy);
  }

  look(view) {
    this.scene.camera.reset(VIEWS[view]);
    this.allowTouch();
    this.redraw();
  }

  // A finger turns a solid; over the whole body in the plane it scrolls the page, and moves the body once it is larger.
  allowTouch() {
    this.canvas.style.touchAction = this.run.isSolid || this.scene.camera.zoom > 1.01 ? "none" : "pan-y";
  }

  key(event) {
    const isOnBody = event.target === this.canvas;
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
    else if (event.key === "Enter" && isOnBody) this.pin(this.scene.pointAt(this.scene.camera.width / 2, this.scene.camera.height / 2));
    else if (event.key === "Escape") this.pin(null);
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

  // A picture in place of the canvas, which not every browser prints.
  print(isBefore) {
    const picture = element("printed");
    const isDrawn = isBefore && Boolean(this.scene.drawing);
    if (isDrawn) picture.src = this.canvas.toDataURL("image/png");
    picture.hidden = !isDrawn;
    this.canvas.hidden = isDrawn;
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
