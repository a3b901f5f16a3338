// Lines over the body: cracks in the plane, bonds, and the forces of supports and loads.

const CRACK = [0.9, 0.15, 0.16, 1];
const CRACK_OVER_RED = [0.05, 0.05, 0.05, 1];
// Of the coarser of two results, over their difference.
const COARSER_CRACK = [0, 0.55, 0.25, 1];
const PRECRACK = [0.55, 0.55, 0.55, 1];
const INTERFACE = [0.15, 0.15, 0.15, 0.8];
const INTACT = [0.1, 0.45, 0.85, 0.9];
const BROKEN = [0.9, 0.15, 0.16, 0.9];
const CHOSEN = [1, 0.75, 0, 1];
const FORCE = [0.1, 0.5, 0.25, 0.95];
// Largest length of a force, over the size of the body, and the number of forces that are drawn.
const FORCE_LENGTH = 0.13;
const MOST_FORCES = 60;
// Length of a piece of a crack line over the one at the start, from which on its ends are on different fragments.
const TORN = 3;

class Lines {
  constructor(scene) {
    this.scene = scene;
  }

  // Crack lines and pre-cracks of a body in the plane need the points about a place.
  show(run, body) {
    Object.assign(this, { run, body });
    this.reference = body.dimension === 2 ? new Places(body.x, body.y) : null;
  }

  // A place in the plane that moves with the points about it, as a scene draws it.
  moved(x, y, over = this.scene) {
    const near = this.reference.nearest(x, y, 4, 3 * this.reference.size);
    const { factor, displacement: [ux, uy] } = this.scene;
    const share = factor / Math.max(near.length, 1);
    const [px, py] = near.reduce(([px, py], { point }) => [px + share * ux[point], py + share * uy[point]], [x, y]);
    return over.relative([px, py, 0]);
  }

  // Crack lines of a step, on the deformed body, as a scene draws them.
  cracks(step, over = this.scene) {
    const lines = this.run.description.cracks?.lines;
    if (!lines) return [];
    let at = step;
    while (at > 0 && lines[at] === null) at--;
    const segments = [];
    for (const line of lines[at] ?? []) {
      let before = null;
      for (let place = 0; place < line.length; place += 2) {
        const now = this.moved(line[place], line[place + 1], over);
        // A piece between fragments that have parted is no longer anywhere.
        if (before && Math.hypot(...minus3(now, before)) < TORN * Math.hypot(line[place] - line[place - 2], line[place + 1] - line[place - 1])) {
          segments.push([before, now]);
        }
        before = now;
      }
    }
    return segments;
  }

  // Pre-cracks, in pieces that follow the deformed body; what lies outside of it is not drawn.
  precracks() {
    const segments = [];
    if (!this.reference) return segments;
    const isInside = (x, y) => this.reference.nearest(x, y, 1, 2 * this.reference.size).length > 0;
    for (const line of this.run.description.precracks) {
      for (let place = 0; place + 3 < line.length; place += 2) {
        const [ax, ay, bx, by] = line.slice(place, place + 4);
        const count = Math.ceil(Math.hypot(bx - ax, by - ay) / this.reference.size);
        const at = (piece) => [ax + (piece / count) * (bx - ax), ay + (piece / count) * (by - ay)];
        for (let piece = 0; piece < count; piece++) {
          const ends = [at(piece), at(piece + 1)];
          if (ends.every((it) => isInside(...it))) segments.push(ends.map((it) => this.moved(...it)));
        }
      }
    }
    return segments;
  }

  // Sides of cells between two materials.
  interfaces() {
    const { points, places } = this.run.description.interfaces;
    const { factor, displacement: [ux, uy] } = this.scene;
    const at = (end) => this.scene.relative([places[2 * end] + factor * ux[points[end]], places[2 * end + 1] + factor * uy[points[end]], 0]);
    return Array.from({ length: points.length / 2 }, (_, side) => [at(2 * side), at(2 * side + 1)]);
  }

  bond(ends) {
    return ends.map((it) => this.scene.relative(this.scene.placeOf(it)));
  }

  // Arrows of forces at the points, towards the body where they press.
  forces(reaction) {
    if (!reaction) return [];
    const { scene } = this;
    const at = (point) => [0, 1, 2].map((axis) => reaction[axis]?.[point] ?? 0);
    const size = (point) => Math.hypot(...at(point));
    let largest = 0;
    for (let point = 0; point < this.run.nPoints; point++) largest = Math.max(largest, size(point));
    if (!(largest > 0)) return [];
    const points = [];
    for (let point = 0; point < this.run.nPoints; point++) if (size(point) > 0.02 * largest && scene.isSeen(point)) points.push(point);
    const every = Math.ceil(points.length / MOST_FORCES);
    const segments = [];
    for (const point of points.filter((_, place) => place % every === 0)) {
      const force = at(point).map((it) => (it / largest) * FORCE_LENGTH * this.run.description.body.size);
      const place = scene.relative(scene.placeOf(point));
      const presses = dot3(force, place) < 0;
      const [tail, tip] = presses ? [minus3(place, force), place] : [place, minus3(place, force.map((it) => -it))];
      segments.push(...arrow(tail, tip, scene.camera));
    }
    return segments;
  }

  // All layers over the body of a step; `finer` is the pane whose cracks are seen as well.
  layers({ step, mode, broken, family, chosen, reaction, symbols, isOverRed, finer }) {
    const crack = isOverRed ? CRACK_OVER_RED : CRACK;
    const isLines = mode === "lines";
    const layers = [
      lineLayer(this.interfaces(), INTERFACE, 1.2),
      lineLayer((broken ?? []).map((it) => this.bond(it)), [...crack.slice(0, 3), 0.6], 1),
      // Pre-cracks open as well.
      lineLayer(["none", "open"].includes(mode) ? [] : this.precracks(), PRECRACK, 3),
      lineLayer(isLines ? this.cracks(step) : [], finer ? COARSER_CRACK : crack, 3),
      lineLayer(isLines && finer ? finer.lines.cracks(finer.step, this.scene) : [], crack, 3),
      ...(symbols ? symbols.layers() : []),
      lineLayer(this.forces(reaction), FORCE, 2),
    ];
    for (const [colour, kind] of [[INTACT, false], [BROKEN, true]]) {
      layers.push(lineLayer(family.filter((it) => it.isBroken === kind).map((it) => this.bond(it.ends)), colour, 1.5));
    }
    layers.push(lineLayer(family.filter((it) => it.bond === chosen).map((it) => this.bond(it.ends)), CHOSEN, 4));
    return layers;
  }
}

// An arrow, whose two strokes at the tip lie in the plane of the screen.
function arrow(tail, tip, { toEye }) {
  const along = minus3(tip, tail);
  const across = cross(along, toEye);
  const length = Math.hypot(...along) || 1;
  const width = (0.13 * length) / (Math.hypot(...across) || 1);
  const head = [1, -1].map((side) => [tip, tip.map((it, axis) => it - 0.28 * along[axis] + side * width * across[axis])]);
  return [[tail, tip], ...head];
}
