// The part of the plane that is seen.

const MARGIN = 0.92;
const MOST_ZOOM = 200;

class Camera {
  constructor() {
    this.width = 1;
    this.height = 1;
    this.bounds = { left: 0, right: 1, bottom: 0, top: 1 };
    this.reset();
  }

  // The whole body again.
  reset() {
    this.zoom = 1;
    this.centre = [(this.bounds.left + this.bounds.right) / 2, (this.bounds.bottom + this.bounds.top) / 2];
  }

  resize(width, height) {
    this.width = Math.max(width, 1);
    this.height = Math.max(height, 1);
  }

  // Pixels a metre.
  get scale() {
    const width = Math.max(this.bounds.right - this.bounds.left, 1e-300);
    const height = Math.max(this.bounds.top - this.bounds.bottom, 1e-300);
    return this.zoom * MARGIN * Math.min(this.width / width, this.height / height);
  }

  toWorld(px, py) {
    return [
      this.centre[0] + (px - this.width / 2) / this.scale,
      this.centre[1] - (py - this.height / 2) / this.scale,
    ];
  }

  toScreen(x, y) {
    return [
      this.width / 2 + (x - this.centre[0]) * this.scale,
      this.height / 2 - (y - this.centre[1]) * this.scale,
    ];
  }

  // Larger or smaller by a factor, while the place under a pixel stays there.
  zoomBy(factor, px = this.width / 2, py = this.height / 2) {
    const before = this.toWorld(px, py);
    this.zoom = Math.min(Math.max(this.zoom * factor, 0.5), MOST_ZOOM);
    const after = this.toWorld(px, py);
    this.centre = this.centre.map((it, axis) => it + before[axis] - after[axis]);
  }

  moveBy(dx, dy) {
    this.centre = [this.centre[0] - dx / this.scale, this.centre[1] + dy / this.scale];
  }
}
