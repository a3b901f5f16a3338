// Where points are: the nearest ones to a place, by a raster of about two points a square.

class Places {
  constructor(x, y) {
    this.x = x;
    this.y = y;
    const bounds = boundsOf(x, y);
    this.low = [bounds.left, bounds.bottom];
    const width = Math.max(bounds.right - bounds.left, 1e-300);
    const height = Math.max(bounds.top - bounds.bottom, 1e-300);
    this.size = Math.max(Math.sqrt((2 * width * height) / x.length), Math.max(width, height) / 2000);
    this.columns = Math.floor(width / this.size) + 1;
    this.rows = Math.floor(height / this.size) + 1;
    this.first = new Uint32Array(this.columns * this.rows + 1);
    const squares = new Uint32Array(x.length);
    for (let point = 0; point < x.length; point++) {
      squares[point] = this.square(x[point], y[point]);
      this.first[squares[point] + 1]++;
    }
    for (let square = 0; square < this.columns * this.rows; square++) this.first[square + 1] += this.first[square];
    const next = this.first.slice();
    this.points = new Uint32Array(x.length);
    for (let point = 0; point < x.length; point++) this.points[next[squares[point]]++] = point;
  }

  column(x) {
    return Math.min(Math.max(Math.floor((x - this.low[0]) / this.size), 0), this.columns - 1);
  }

  row(y) {
    return Math.min(Math.max(Math.floor((y - this.low[1]) / this.size), 0), this.rows - 1);
  }

  square(x, y) {
    return this.row(y) * this.columns + this.column(x);
  }

  // The nearest points to a place within a distance, nearest first.
  nearest(x, y, count, reach) {
    const found = [];
    const [fromColumn, toColumn] = [this.column(x - reach), this.column(x + reach)];
    const [fromRow, toRow] = [this.row(y - reach), this.row(y + reach)];
    for (let row = fromRow; row <= toRow; row++) {
      const start = this.first[row * this.columns + fromColumn];
      const end = this.first[row * this.columns + toColumn + 1];
      for (let place = start; place < end; place++) {
        const point = this.points[place];
        const distance = Math.hypot(this.x[point] - x, this.y[point] - y);
        if (distance <= reach) found.push({ point, distance });
      }
    }
    found.sort((one, other) => one.distance - other.distance || one.point - other.point);
    return found.slice(0, count);
  }
}

function boundsOf(x, y) {
  const bounds = { left: Infinity, right: -Infinity, bottom: Infinity, top: -Infinity };
  for (let point = 0; point < x.length; point++) {
    if (x[point] < bounds.left) bounds.left = x[point];
    if (x[point] > bounds.right) bounds.right = x[point];
    if (y[point] < bounds.bottom) bounds.bottom = y[point];
    if (y[point] > bounds.top) bounds.top = y[point];
  }
  return bounds;
}

// The distance of a place from a segment.
function distanceToSegment(x, y, [ax, ay, bx, by]) {
  const [dx, dy] = [bx - ax, by - ay];
  const share = ((x - ax) * dx + (y - ay) * dy) / Math.max(dx * dx + dy * dy, 1e-300);
  const at = Math.min(Math.max(share, 0), 1);
  return Math.hypot(x - ax - at * dx, y - ay - at * dy);
}
