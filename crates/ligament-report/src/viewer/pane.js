// A picture of a result in a step, on a canvas of its own. Panes beside one another have one camera.

class Pane {
  // `changed` is called when what was drawn was lost, or can be drawn again.
  constructor(element, camera, changed) {
    this.element = element;
    const [canvas, stage, caption, marker, printed] = [".picture", ".stage", ".caption", ".marker", ".printed"].map((it) => element.querySelector(it));
    Object.assign(this, { canvas, stage, caption, marker, printed, circles: [...element.querySelectorAll(".horizon")] });
    this.scene = new Scene(canvas, camera, changed);
    this.hadGraphics = Boolean(this.scene.drawing);
    this.lines = new Lines(this.scene);
    this.symbols = new Symbols(this.scene);
    this.run = null;
    this.letGo();
  }

  // Another result with its body and the horizons of its points, without a state so far.
  show(run, body, horizons) {
    Object.assign(this, { run, body, horizons, values: null, finder: null });
    this.letGo();
    this.scene.show(body);
    this.lines.show(run, body);
    this.symbols.show(run);
  }

  // Without bonds of a point.
  letGo() {
    this.family = [];
    this.chosenBond = null;
  }

  // What is seen in a step: a field in the unit of `choice`, which may be that of another result, and cracks in a mode.
  async read(step, choice, mode) {
    const { run } = this;
    const own = run.choices.find((it) => it.id === choice.id);
    const [fields, displacement, broken, cut, reaction] = await Promise.all([
      own ? run.parts(own, step, choice.field.shift) : [new Float64Array(run.nPoints).fill(NaN)],
      run.vector("displacement", step), this.readBroken(step, mode), run.cut(step), run.isModes ? null : run.vector("reaction", step),
    ]);
    // Of the last digit of the field, in the unit of the choice.
    const exponent = own ? run.exponent(own, step) + choice.field.shift : 0;
    return { step, choice: own, exponent, fields, values: lengths(fields), displacement, broken, cut, reaction };
  }

  // The ends of broken bonds in the state of a step.
  async readBroken(step, mode) {
    const { run } = this;
    if (mode !== "bonds" || !run.bonds) return null;
    const [ends, breaks, count] = await Promise.all([run.bonds.ends(), run.bonds.breaks(), run.bonds.countAt(step)]);
    return Array.from(breaks.bond.subarray(0, count), (bond) => [ends.a[bond], ends.b[bond]]);
  }

  // The deformed body, cut and opened.
  place({ factor, mode, section }) {
    const { rigid } = this.run.description;
    const moved = rigid && { ...rigid, displacement: rigid.displacements[this.step] };
    this.scene.place({ displacement: this.displacement, factor, cut: this.cut, mode, section, rigid: moved });
  }

  colour(values, range, bytes) {
    this.scene.colour(values, range, bytes);
    this.scene.upload();
  }

  draw({ mode, isOverRed, withForces, withSymbols, finer }) {
    if (!this.values || !this.scene.vertices) return;
    this.scene.draw(this.lines.layers({
      step: this.step,
      mode,
      broken: this.broken,
      family: this.family,
      chosen: this.chosenBond,
      reaction: withForces ? this.reaction : null,
      symbols: withSymbols ? this.symbols : null,
      isOverRed,
      finer,
    }));
  }

  // Marks a place, as `seen` gives it, with circles of horizons around it; null marks nothing.
  mark(seen, horizons) {
    const { marker, circles, scene: { camera } } = this;
    marker.hidden = !seen;
    circles.forEach((it, place) => { it.hidden = !seen || !horizons[place]; });
    if (!seen) return;
    const [px, py] = camera.toScreen(...seen.at);
    marker.hidden = px < 0 || py < 0 || px > camera.width || py > camera.height;
    marker.style.transform = `translate(${px}px, ${py}px)`;
    circles.forEach((it, place) => {
      // As large as the horizon in the body before its displacement.
      const radius = horizons[place] * camera.scale;
      Object.assign(it.style, { width: `${2 * radius}px`, height: `${2 * radius}px`, transform: `translate(${px - radius}px, ${py - radius}px)` });
    });
  }

  // A point of the pane and its deformed place.
  seen(point) {
    return { point, at: this.scene.placeOf(point), value: this.values?.[point] };
  }

  // A place in the plane before its displacement: the nearest point, where the place moves and the value there; null outside of the body.
  seenAt(x, y) {
    const weights = this.values && this.weights(x, y);
    if (!weights) return null;
    const [ux, uy] = interpolated(this.displacement, weights);
    const { factor } = this.scene;
    return { point: this.nearest(x, y), at: [x + factor * ux, y + factor * uy, 0], value: lengths(interpolated(this.fields, weights).map((it) => [it]))[0] };
  }

  // Points and shares at a place of the plane; null outside of the body.
  weights(x, y) {
    this.finder ??= new Interpolation(this.body);
    return this.finder.weights(x, y);
  }

  nearest(x, y) {
    const distances = this.body.x.map((it, point) => Math.hypot(it - x, this.body.y[point] - y));
    return distances.reduce((nearest, it, point) => (it < distances[nearest] ? point : nearest), 0);
  }

  // A picture in place of the canvas, which not every browser prints.
  print(isBefore) {
    const isDrawn = isBefore && Boolean(this.scene.drawing);
    if (isDrawn) this.printed.src = this.canvas.toDataURL("image/png");
    this.printed.hidden = !isDrawn;
    this.canvas.hidden = isDrawn;
  }
}

// Values of a choice of a field from its components: of a vector its length.
function lengths(parts) {
  return parts.length === 1 ? parts[0] : parts[0].map((_, point) => Math.hypot(...parts.map((it) => it[point])));
}
