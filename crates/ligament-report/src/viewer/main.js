// The page: what is seen (result, step, field, place), and what the reader does.

const CRACK = [0.9, 0.15, 0.16, 1];
const CRACK_OVER_RED = [0.05, 0.05, 0.05, 1];
const PRECRACK = [0.7, 0.7, 0.7, 1];
const INTACT = [0.1, 0.45, 0.85, 0.9];
const BROKEN = [0.9, 0.15, 0.16, 0.9];
const CHOSEN = [1, 0.75, 0, 1];
// Pixels from the pointer to a bond that it points at.
const REACH = 7;
// Share of the body that the usual displacement is drawn with; of a mode twice as much.
const DRAWN_SHARE = 0.05;

const element = (id) => document.getElementById(id);

class Page {
  constructor(description) {
    this.runs = description.runs.map((it) => new Run(it));
    this.run = this.runs[0];
    this.step = this.run.isModes ? 0 : this.run.steps.length - 1;
    this.camera = new Camera();
    this.canvas = element("body");
    this.drawing = Drawing.on(this.canvas);
    this.panel = new Panel();
    this.pictures = new Pictures(() => this.showStep());
    this.charts = new Charts(this.runs, (number, step) => this.go(step, this.runs[number]));
    this.asked = 0;
    this.pinned = null;
    this.family = [];
    this.chosenBond = null;
    this.listen();
  }

  async start() {
    options(element("run"), this.runs.map((run, number) => [number, run.label]));
    element("run").closest("label").hidden = this.runs.length < 2;
    if (!this.drawing) {
      element("no-view").hidden = false;
      element("no-view").textContent = "This browser has no WebGL 2, so the body is not drawn; numbers and curves are here.";
    }
    await this.showRun(this.run);
    document.documentElement.dataset.ready = "true";
  }

  // Another result: its fields, steps, curves and summary.
  async showRun(run) {
    const isOther = run !== this.run;
    this.run = run;
    if (isOther) this.step = Math.min(this.step, run.steps.length - 1);
    Object.assign(element("step"), { max: run.steps.length - 1, value: this.step });
    element("step").closest(".steps").hidden = run.steps.length < 2;
    element("run").value = this.runs.indexOf(run);
    for (const summary of document.querySelectorAll(".summary")) summary.hidden = Number(summary.dataset.run) !== this.runs.indexOf(run);
    this.charts.showRun(run);
    document.body.classList.toggle("solid", run.isSolid);
    if (run.isSolid) this.pictures.offer(run);
    else await this.showBody(run, isOther);
    await this.showStep();
  }

  // A body in the plane, which is drawn here.
  async showBody(run, isOther) {
    const choice = isOther ? element("field").value : run.firstChoice;
    options(element("field"), run.choices.map((it) => [it.id, it.label]));
    element("field").value = run.choice(choice).id;
    this.offerMagnifications();
    this.offerCracks();
    if (run.isModes) element("scale").value = "inner";
    this.pinned = null;
    this.family = [];
    this.panel.clear();
    this.body = await run.body();
    this.origin = [this.body.x[0], this.body.y[0]];
    this.camera.bounds = boundsOf(...(this.body.corners ?? [this.body.x, this.body.y]));
    this.camera.reset();
    this.reference = new Places(this.body.x, this.body.y);
    this.drawing?.setTriangles(this.body.corners ? cornersOfSquares(this.run.nPoints) : this.body.triangles);
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
    if (this.run.description.cracks) choices.push(["lines", "lines"]);
    if (this.run.bonds) choices.push(["bonds", "broken bonds"]);
    options(element("cracks"), [...choices, ["none", "none"]]);
    element("cracks").closest("label").hidden = choices.length === 0;
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

  // Reads and draws the step. Of several asked for in a row only the last is drawn.
  async showStep() {
    const asked = ++this.asked;
    const { run, step, choice } = this;
    this.tellStep();
    if (run.isSolid) {
      this.values = null;
      if (await this.pictures.show(step)) document.documentElement.dataset.drawn = `${run.label} ${run.steps[step]} ${this.pictures.view.value} ${this.pictures.field.value}`;
      this.charts.mark(run, this.step);
      return;
    }
    const [values, displacement, inner] = await Promise.all([
      run.values(choice, step), run.displacement(step), this.readLayers(),
    ]);
    // One picture a frame: a slow machine would pile them up.
    await new Promise(requestAnimationFrame);
    if (asked !== this.asked) return;
    this.values = values;
    this.displacement = displacement;
    this.layers = inner;
    this.place();
    this.colour();
    this.redraw();
    this.charts.mark(run, step);
    const point = this.pinned ?? this.hovered;
    if (point !== undefined && point !== null) this.panel.showPoint(run, this.body, point, step, choice);
    document.documentElement.dataset.drawn = `${run.label} ${run.steps[step]} ${choice.id}`;
  }

  tellStep() {
    const { run, step } = this;
    const row = run.rows[step];
    const words = [`${run.isModes ? "mode" : "step"} ${run.steps[step]}`];
    for (const name of run.isModes ? ["frequency"] : ["displacement", "reaction"]) {
      const column = run.history.get(name);
      if (column && row >= 0) words.push(withUnit(shortText(column.values[row] * 10 ** column.shift), column.unit));
    }
    const atRest = run.history.get("at_rest")?.values[row];
    if (atRest === 0) words.push("not converged");
    element("step-text").textContent = words.join(", ");
  }

  // Deformed positions of points and corners.
  place() {
    const { body, displacement: [ux, uy] } = this;
    const factor = Number(element("magnification").value);
    this.x = body.x.map((x, point) => x + factor * ux[point]);
    this.y = body.y.map((y, point) => y + factor * uy[point]);
    this.deformed = null;
    const [cx, cy] = body.corners ?? [this.x, this.y];
    const places = new Float32Array(2 * cx.length);
    for (let corner = 0; corner < cx.length; corner++) {
      const point = body.corners ? corner >> 2 : -1;
      places[2 * corner] = cx[corner] - this.origin[0] + (point < 0 ? 0 : factor * ux[point]);
      places[2 * corner + 1] = cy[corner] - this.origin[1] + (point < 0 ? 0 : factor * uy[point]);
    }
    this.drawing?.setPlaces(places);
  }

  colour() {
    const { values, body, choice } = this;
    const scale = element("scale").value;
    const ofSteps = choice.place === null ? [0, choice.field.magnitude] : choice.field.ranges[choice.place];
    const shift = 10 ** choice.field.shift;
    const range = scale === "all" ? ofSteps.map((it) => it * shift) : rangeOfValues(values, scale === "inner" ? 0.01 : 0);
    this.range = colourRange(...range);
    const bytes = colourTable(this.range.map);
    this.drawing?.setMap(bytes);
    const size = Math.max(this.range.high - this.range.low, 1e-300);
    // From 0 to 1, so that single precision serves values of any size.
    const shares = body.corners
      ? Float32Array.from({ length: 4 * values.length }, (_, corner) => (values[corner >> 2] - this.range.low) / size)
      : Float32Array.from(values, (value) => (value - this.range.low) / size);
    this.drawing?.setValues(shares);
    this.showLegend(bytes);
  }

  showLegend(bytes) {
    const bar = element("legend-bar");
    const picture = new ImageData(new Uint8ClampedArray(bytes), bar.width, 1);
    bar.getContext("2d").putImageData(picture, 0, 0);
    element("legend-low").textContent = shortText(this.range.low);
    element("legend-high").textContent = shortText(this.range.high);
    element("legend-name").textContent = labelWithUnit(this.choice.label, this.choice.field.unit);
  }

  // The ends of broken bonds in the state of the step; crack lines come with the description.
  async readLayers() {
    const { run, step } = this;
    if (element("cracks").value !== "bonds" || !run.bonds) return null;
    const [ends, breaks, count] = await Promise.all([run.bonds.ends(), run.bonds.breaks(), run.bonds.countAt(run.steps[step])]);
    return Array.from(breaks.bond.subarray(0, count), (bond) => [ends.a[bond], ends.b[bond]]);
  }

  // Crack lines of the step, on the deformed body.
  crackSegments() {
    const { cracks } = this.run.description;
    if (element("cracks").value !== "lines" || !cracks) return [];
    let at = this.step;
    while (at > 0 && cracks[at] === null) at--;
    const segments = [];
    for (const line of cracks[at] ?? []) {
      let before = null;
      for (let place = 0; place < line.length; place += 2) {
        const now = this.moved(line[place], line[place + 1]);
        if (before) segments.push(...before, ...now);
        before = now;
      }
    }
    return segments;
  }

  // Pre-cracks, in pieces that follow the deformed body; what lies outside of it is not drawn.
  precrackSegments() {
    if (element("cracks").value === "none") return [];
    const segments = [];
    const isInside = (x, y) => this.reference.nearest(x, y, 1, 2 * this.reference.size).length > 0;
    for (const line of this.run.description.precracks) {
      for (let place = 0; place + 3 < line.length; place += 2) {
        const [ax, ay, bx, by] = line.slice(place, place + 4);
        const count = Math.ceil(Math.hypot(bx - ax, by - ay) / this.reference.size);
        const at = (piece) => [ax + (piece / count) * (bx - ax), ay + (piece / count) * (by - ay)];
        for (let piece = 0; piece < count; piece++) {
          const ends = [at(piece), at(piece + 1)];
          if (ends.every((it) => isInside(...it))) segments.push(...ends.flatMap((it) => this.moved(...it)));
        }
      }
    }
    return segments;
  }

  // A place that moves with the points about it.
  moved(x, y) {
    const near = this.reference.nearest(x, y, 4, 3 * this.reference.size);
    const factor = Number(element("magnification").value) / Math.max(near.length, 1);
    const [ux, uy] = this.displacement;
    return near.reduce(([px, py], { point }) => [px + factor * ux[point], py + factor * uy[point]], [x, y])
      .map((it, axis) => it - this.origin[axis]);
  }

  segmentOf([a, b]) {
    const [ox, oy] = this.origin;
    return [this.x[a] - ox, this.y[a] - oy, this.x[b] - ox, this.y[b] - oy];
  }

  redraw() {
    if (!this.values) return;
    const { clientWidth, clientHeight } = this.canvas;
    this.camera.resize(clientWidth, clientHeight);
    const crack = this.range.map === "diverging" ? CRACK_OVER_RED : CRACK;
    const layers = [
      lineLayer((this.layers ?? []).flatMap((ends) => this.segmentOf(ends)), [...crack.slice(0, 3), 0.6], 1),
      lineLayer(this.precrackSegments(), PRECRACK, 3),
      lineLayer(this.crackSegments(), crack, 3),
    ];
    for (const [colour, kind] of [[INTACT, false], [BROKEN, true]]) {
      const bonds = this.family.filter((it) => it.isBroken === kind);
      layers.push(lineLayer(bonds.flatMap((it) => this.segmentOf(it.ends)), colour, 1.5));
    }
    const chosen = this.family.filter((it) => it.bond === this.chosenBond);
    layers.push(lineLayer(chosen.flatMap((it) => this.segmentOf(it.ends)), CHOSEN, 4));
    this.drawing?.draw(this.camera, this.origin, { low: 0, high: 1 }, layers);
    this.mark();
  }

  mark() {
    const point = this.pinned ?? this.hovered;
    const marker = element("marker");
    marker.hidden = point === undefined || point === null;
    if (marker.hidden) return;
    const [px, py] = this.camera.toScreen(this.x[point], this.y[point]);
    marker.hidden = px < 0 || py < 0 || px > this.camera.width || py > this.camera.height;
    marker.style.transform = `translate(${px}px, ${py}px)`;
  }

  // The point nearest to a pixel, or none away from the body.
  pointAt(px, py) {
    if (!this.x) return null;
    this.deformed ??= new Places(this.x, this.y);
    const [x, y] = this.camera.toWorld(px, py);
    const reach = Math.max(2.5 * this.reference.size, 12 / this.camera.scale);
    return this.deformed.nearest(x, y, 1, reach)[0]?.point ?? null;
  }

  hover(px, py) {
    if (this.pinned !== null) {
      const [x, y] = this.camera.toWorld(px, py).map((it, axis) => it - this.origin[axis]);
      const distances = this.family.map((it) => distanceToSegment(x, y, this.segmentOf(it.ends)) * this.camera.scale);
      const nearest = distances.indexOf(Math.min(...distances));
      if (distances[nearest] <= REACH) this.chooseBond(this.family[nearest].bond);
      return;
    }
    const point = this.pointAt(px, py);
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
    const { x, y } = this.body;
    const absent = await this.run.bonds.columns.find((it) => it.name === "absent")?.column.multiples(0);
    const bonds = Array.from(ends.ofPoints.subarray(ends.first[point], ends.first[point + 1]));
    return bonds.map((bond) => {
      const [a, b] = [ends.a[bond], ends.b[bond]];
      const [dx, dy] = [x[b] - x[a], y[b] - y[a]];
      return {
        bond, ends: [a, b], other: a === point ? b : a, length: Math.hypot(dx, dy),
        angle: (Math.atan2(dy, dx) * 180) / Math.PI,
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
    element("run").addEventListener("change", (event) => this.go(Math.min(this.step, this.runs[event.target.value].steps.length - 1), this.runs[event.target.value]));
    element("field").addEventListener("change", () => {
      this.run.keepOnly(this.choice.field);
      this.showStep();
    });
    element("scale").addEventListener("change", () => { this.colour(); this.redraw(); });
    element("magnification").addEventListener("change", () => { this.place(); this.redraw(); });
    element("cracks").addEventListener("change", () => this.showStep());
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
    if (factor === 0) this.camera.reset();
    else this.camera.zoomBy(factor, px, py);
    // A finger scrolls the page over the whole body, and moves the body once it is larger.
    this.canvas.style.touchAction = this.camera.zoom > 1.01 ? "none" : "pan-y";
    this.redraw();
  }

  key(event) {
    const isOnBody = event.target === this.canvas || event.target === this.pictures.image;
    const isElsewhere = event.target !== document.body && !isOnBody;
    if (isElsewhere || event.ctrlKey || event.metaKey || event.altKey) return;
    const moves = { ArrowLeft: [40, 0], ArrowRight: [-40, 0], ArrowUp: [0, 40], ArrowDown: [0, -40] };
    if (event.shiftKey && moves[event.key]) {
      this.camera.moveBy(...moves[event.key]);
      this.redraw();
    } else if (event.key === "ArrowLeft") this.go(this.step - 1);
    else if (event.key === "ArrowRight") this.go(this.step + 1);
    else if (event.key === "Home" && isOnBody) this.go(0);
    else if (event.key === "End" && isOnBody) this.go(this.run.steps.length - 1);
    else if (event.key === "+" || event.key === "=") this.zoom(1.25);
    else if (event.key === "-") this.zoom(1 / 1.25);
    else if (event.key === "0") this.zoom(0);
    else if (event.key === "Enter" && isOnBody && !this.run.isSolid) this.pin(this.pointAt(this.camera.width / 2, this.camera.height / 2));
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
    if (this.run.isSolid) return;
    const picture = element("printed");
    if (isBefore && this.drawing) picture.src = this.canvas.toDataURL("image/png");
    picture.hidden = !(isBefore && this.drawing);
    this.canvas.hidden = isBefore && Boolean(this.drawing);
    if (!isBefore) this.redraw();
  }
}

// Pointers on the body: hover, click, drag and wheel, and two fingers.
function listenToPointers(canvas, page) {
  const pointers = new Map();
  let moved = 0;
  const place = (event) => {
    const box = canvas.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  };
  const spread = () => {
    const [one, other] = [...pointers.values()];
    return Math.hypot(one[0] - other[0], one[1] - other[1]);
  };
  canvas.addEventListener("pointerdown", (event) => {
    pointers.set(event.pointerId, place(event));
    canvas.setPointerCapture(event.pointerId);
    moved = 0;
  });
  canvas.addEventListener("pointermove", (event) => {
    const now = place(event);
    const before = pointers.get(event.pointerId);
    if (!before) {
      page.hover(...now);
      return;
    }
    const distance = pointers.size === 2 ? spread() : 0;
    pointers.set(event.pointerId, now);
    moved += Math.hypot(now[0] - before[0], now[1] - before[1]);
    if (pointers.size === 2) page.zoom(spread() / Math.max(distance, 1), ...now);
    else if (moved > 4) {
      page.camera.moveBy(now[0] - before[0], now[1] - before[1]);
      page.redraw();
    }
  });
  canvas.addEventListener("pointerup", (event) => {
    const isClick = pointers.size === 1 && moved <= 4;
    pointers.delete(event.pointerId);
    if (!isClick) return;
    const point = page.pointAt(...place(event));
    page.pin(point === page.pinned ? null : point);
  });
  canvas.addEventListener("pointercancel", (event) => pointers.delete(event.pointerId));
  canvas.addEventListener("wheel", (event) => {
    event.preventDefault();
    page.zoom(1.0015 ** -event.deltaY, ...place(event));
  }, { passive: false });
}

// Two triangles for each square of four corners.
function cornersOfSquares(count) {
  const corners = new Uint32Array(6 * count);
  for (let square = 0; square < count; square++) {
    corners.set([0, 1, 2, 0, 2, 3].map((it) => 4 * square + it), 6 * square);
  }
  return corners;
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

new Page(JSON.parse(element("description").textContent)).start();
