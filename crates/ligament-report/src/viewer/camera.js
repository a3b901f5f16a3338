// The view of the body: from where it is seen, without perspective. A body in the plane is seen from above it.

const MARGIN = 0.92;
const MOST_ZOOM = 200;
// Distance of the corners of bodies of the same size, over their diagonal: a mesh ends at its outermost nodes.
const ALIKE = 0.02;
const FROM_ABOVE = { azimuth: -90, elevation: 90 };
const OBLIQUE = { azimuth: -60, elevation: 28 };
// The views along the axes, by their names.
const VIEWS = { x: { azimuth: 0, elevation: 0 }, y: { azimuth: -90, elevation: 0 }, z: FROM_ABOVE, oblique: OBLIQUE };

class Camera {
  constructor() {
    this.width = 1;
    this.height = 1;
    this.show({ low: [0, 0, 0], high: [1, 1, 0] }, FROM_ABOVE);
  }

  // Looks at a body between two corners of a box; what is seen stays where a body of the same size was seen before.
  show(box, view) {
    const isNear = (end) => this.box[end].every((it, axis) => Math.abs(it - box[end][axis]) < ALIKE * this.diagonal);
    if (view === this.home && isNear("low") && isNear("high")) return;
    this.box = box;
    this.home = view;
    this.reset();
  }

  // The whole body again, as it was seen first or from another side.
  reset(view = this.home) {
    this.look(view.azimuth, view.elevation);
    this.zoom = 1;
    const { low, high } = this.box;
    this.centre = low.map((it, axis) => (it + high[axis]) / 2);
    const extent = (axis) => low.reduce((sum, it, k) => sum + Math.abs(axis[k]) * (high[k] - it), 0);
    this.extent = [extent(this.right), extent(this.up)].map((it) => Math.max(it, 1e-300));
    this.diagonal = Math.max(Math.hypot(...low.map((it, axis) => high[axis] - it)), 1e-300);
  }

  // Angles of the eye about z from x, and above the plane of x and y, degrees.
  look(azimuth, elevation) {
    Object.assign(this, { azimuth, elevation: Math.min(Math.max(elevation, -90), 90) });
    const [a, e] = [azimuth, this.elevation].map((it) => (it * Math.PI) / 180);
    const exact = (value) => (Math.abs(value) < 1e-15 ? 0 : value);
    const [sinA, cosA, sinE, cosE] = [Math.sin(a), Math.cos(a), Math.sin(e), Math.cos(e)].map(exact);
    this.right = [-sinA, cosA, 0];
    this.up = [-sinE * cosA, -sinE * sinA, cosE];
    this.toEye = [cosE * cosA, cosE * sinA, sinE];
  }

  turnBy(dx, dy) {
    this.look(this.azimuth - 0.4 * dx, this.elevation + 0.4 * dy);
  }

  resize(width, height) {
    this.width = Math.max(width, 1);
    this.height = Math.max(height, 1);
  }

  // Pixels a metre.
  get scale() {
    return this.zoom * MARGIN * Math.min(this.width / this.extent[0], this.height / this.extent[1]);
  }

  // Pixels of a place, and how near it is to the eye, m.
  toScreen(x, y, z) {
    const { right, up, toEye, centre: [cx, cy, cz], scale } = this;
    const [dx, dy, dz] = [x - cx, y - cy, z - cz];
    return [
      this.width / 2 + (right[0] * dx + right[1] * dy + right[2] * dz) * scale,
      this.height / 2 - (up[0] * dx + up[1] * dy + up[2] * dz) * scale,
      toEye[0] * dx + toEye[1] * dy + toEye[2] * dz,
    ];
  }

  // Larger or smaller by a factor, while what is under a pixel stays there.
  zoomBy(factor, px = this.width / 2, py = this.height / 2) {
    const before = this.scale;
    this.zoom = Math.min(Math.max(this.zoom * factor, 0.5), MOST_ZOOM);
    const share = 1 / before - 1 / this.scale;
    this.shift((px - this.width / 2) * share, (this.height / 2 - py) * share);
  }

  moveBy(dx, dy) {
    this.shift(-dx / this.scale, dy / this.scale);
  }

  // Moves the middle of the view to the right and up, m.
  shift(right, up) {
    this.centre = this.centre.map((it, axis) => it + right * this.right[axis] + up * this.up[axis]);
  }
}
