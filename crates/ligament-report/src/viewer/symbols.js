// Supports and loads as symbols at some of their points, in the plane of the screen: triangles that hold, springs, arrows and turns.

const SUPPORT = [0.35, 0.38, 0.42, 1];
const LOAD = [0.48, 0.25, 0.71, 1];
// Size of a symbol over the size of the body.
const SYMBOL = 0.028;
// Places of the strokes under a triangle that holds in all directions.
const STROKES = [-0.6, -0.2, 0.2, 0.6];

class Symbols {
  constructor(scene) {
    this.scene = scene;
    this.entries = [];
  }

  show(run) {
    this.entries = run.description.sketch ?? [];
    this.size = SYMBOL * run.description.body.size;
    this.dimension = run.isSolid ? 3 : 2;
  }

  get isEmpty() {
    return this.entries.length === 0;
  }

  layers() {
    const [held, loaded] = [[], []];
    for (const entry of this.entries) {
      for (const [number, point] of entry.points.entries()) {
        if (!this.scene.isSeen(point)) continue;
        this.at = this.scene.relative(this.scene.placeOf(point));
        held.push(...this.holding(entry));
        if (!entry.isSupport) loaded.push(...this.loading(entry, number));
      }
    }
    return [lineLayer(held, SUPPORT, 1.6), lineLayer(loaded, LOAD, 2)];
  }

  // What holds the point.
  holding({ held, turning, springs = [], normal, isNormalSpring }) {
    const segments = [];
    const isWhole = held.length === this.dimension;
    const axes = isWhole ? [this.outermost(held)] : held;
    for (const axis of axes) segments.push(...this.triangle(this.inwards(unit3(axis)), isWhole, turning));
    if (turning && held.length === 0) segments.push(...this.square());
    if (normal && !isNormalSpring) segments.push(...this.triangle(this.inwards(normal), false, false));
    for (const axis of springs) segments.push(...this.spring(this.inwards(unit3(axis))));
    if (normal && isNormalSpring) segments.push(...this.spring(this.inwards(normal)));
    return segments;
  }

  // What loads or moves the point of a number.
  loading({ motion, force, turn, pressures, isPush }, number) {
    const segments = [];
    const push = (vector, isMotion, presses) => {
      if (vector && Math.hypot(...vector) > 0) segments.push(...this.push(vector, isMotion, presses));
    };
    const isInwards = (vector) => vector && dot3(vector, this.at) < 0;
    push(motion, true, isInwards(motion));
    push(force, false, isInwards(force));
    if (pressures) push(pressures[number], false, isPush);
    turn?.forEach((size, axis) => {
      if (size !== 0) segments.push(...this.turned(axis, Math.sign(size)));
    });
    return segments;
  }

  // A place from the point: `along` a direction and `across` it on the screen, in sizes of the symbol.
  frame(direction) {
    const along = scaled(direction, this.size);
    const { camera } = this.scene;
    const seen = cross(along, camera.toEye);
    const across = Math.hypot(...seen) > 1e-6 * this.size ? scaled(seen, this.size) : scaled(camera.right, this.size);
    return (a, b) => this.at.map((it, axis) => it + a * along[axis] + b * across[axis]);
  }

  // A triangle below the point: with strokes it holds in all directions, over two lines only along `inwards`.
  triangle(inwards, isWhole, turning) {
    const place = this.frame(inwards);
    const line = (a, b, c, d) => [place(a, b), place(c, d)];
    const strokes = (at) => STROKES.map((it) => line(at, it, at - 0.35, it - 0.3));
    if (turning) return [line(0, -0.8, 0, 0.8), ...strokes(0)];
    const sides = [line(0, 0, -1, -0.6), line(0, 0, -1, 0.6), line(-1, -0.8, -1, 0.8)];
    return [...sides, ...(isWhole ? strokes(-1) : [line(-1.3, -0.8, -1.3, 0.8)])];
  }

  // A square around a point that cannot turn.
  square() {
    const place = this.frame([0, 1, 0]);
    const corners = [[-1, -1], [-1, 1], [1, 1], [1, -1]].map((it) => place(...it.map((side) => 0.4 * side)));
    return corners.map((it, corner) => [it, corners[(corner + 1) % 4]]);
  }

  spring(inwards) {
    const place = this.frame(inwards);
    const places = [[0, 0], [-0.3, 0], [-0.5, 0.35], [-0.9, -0.35], [-1.3, 0.35], [-1.7, -0.35], [-1.9, 0], [-2.2, 0]].map((it) => place(...it));
    const pieces = places.slice(1).map((it, piece) => [places[piece], it]);
    return [...pieces, [place(-2.2, -0.8), place(-2.2, 0.8)]];
  }

  // An arrow, towards the point where it presses; with a bar at the tail of a motion.
  push(vector, isMotion, presses) {
    const place = this.frame(vector);
    const tail = presses ? -2.6 : 0;
    const bar = isMotion ? [[place(tail, -0.5), place(tail, 0.5)]] : [];
    return [...arrow(place(tail, 0), place(tail + 2.6, 0), this.scene.camera), ...bar];
  }

  // Three quarters of a circle about an axis, right-handed where the sign is 1.
  turned(axis, sign) {
    const [one, other] = [(axis + 1) % 3, (axis + 2) % 3];
    const place = (piece) => {
      const angle = sign * (piece / 12) * 1.5 * Math.PI;
      return this.at.map((it, k) => it + 1.2 * this.size * ((k === one) * Math.cos(angle) + (k === other) * Math.sin(angle)));
    };
    const pieces = Array.from({ length: 12 }, (_, piece) => [place(piece), place(piece + 1)]);
    return [...pieces, ...arrow(this.towards(place(12), place(11), 0.8), place(12), this.scene.camera).slice(1)];
  }

  // The place before a tip from which an arrow of a length comes.
  towards(tip, before, length) {
    const back = scaled(minus3(before, tip), length * this.size);
    return tip.map((it, axis) => it + back[axis]);
  }

  // A direction or its opposite: from outside into the body.
  inwards(direction) {
    return dot3(direction, this.at) > 0 ? direction.map((it) => -it) : direction;
  }

  // The axis along which the point is nearest to the outside of the body; at corners the last one, along which bodies stand.
  outermost(axes) {
    const { low, high } = this.scene.box;
    const share = (axis) => Math.abs(this.at[axis]) / Math.max(high[axis] - low[axis], 1e-300);
    return axes.reduce((most, it) => (share(it) > share(most) - 0.02 ? it : most));
  }
}

function unit3(axis) {
  return [0, 1, 2].map((it) => (it === axis ? 1 : 0));
}

// A vector of one or more components with another length.
function scaled(vector, length) {
  const size = Math.hypot(...vector) || 1;
  return [0, 1, 2].map((axis) => ((vector[axis] ?? 0) / size) * length);
}
