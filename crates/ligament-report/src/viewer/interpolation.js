// Values of one body in the plane at places of another, as probes read them: linear in triangles, bilinear between centres of a lattice's cells.

// How far outside of a triangle or cell a place still belongs to it, over its height: a node on a round rim lies outside of straight sides.
const OUTSIDE = 0.1;
// Share below which a point is left out: it is rounding.
const NO_SHARE = 1e-9;

// Weights of the points of a body at places.
class Interpolation {
  constructor(body) {
    this.cells = body.half ? new LatticeCells(body) : new Triangles(body);
  }

  // Points with their shares, which sum to one; null outside of the body.
  weights(x, y) {
    const shares = this.cells.shares(x, y)?.filter(([, share]) => share > NO_SHARE);
    if (!shares?.length) return null;
    const sum = shares.reduce((all, [, share]) => all + share, 0);
    return shares.map(([point, share]) => [point, share / sum]);
  }
}

// The values of some fields by weights; null without weights.
function interpolated(fields, weights) {
  return weights && fields.map((values) => weights.reduce((sum, [point, share]) => sum + share * values[point], 0));
}

// The triangles of a mesh, with those that are at each square of a raster.
class Triangles {
  constructor({ x, y, simplices }) {
    Object.assign(this, { x, y, simplices, raster: new Places(x, y) });
    this.first = new Uint32Array(this.raster.columns * this.raster.rows + 1);
    this.each((square) => { this.first[square + 1]++; });
    for (let square = 1; square < this.first.length; square++) this.first[square] += this.first[square - 1];
    const next = this.first.slice();
    this.triangles = new Uint32Array(this.first.at(-1));
    this.each((square, triangle) => { this.triangles[next[square]++] = triangle; });
  }

  // Visits the squares at which each triangle is, with what belongs to it outside.
  each(visit) {
    const { x, y, simplices, raster } = this;
    for (let triangle = 0; 3 * triangle < simplices.length; triangle++) {
      const nodes = simplices.subarray(3 * triangle, 3 * triangle + 3);
      const [left, right, bottom, top] = [x, y].flatMap((along) => {
        const ends = [Math.min(...Array.from(nodes, (it) => along[it])), Math.max(...Array.from(nodes, (it) => along[it]))];
        const slack = OUTSIDE * (ends[1] - ends[0]);
        return [ends[0] - slack, ends[1] + slack];
      });
      for (let row = raster.row(bottom); row <= raster.row(top); row++) {
        for (let column = raster.column(left); column <= raster.column(right); column++) visit(row * raster.columns + column, triangle);
      }
    }
  }

  // Nodes and shares of the triangle in which a place is deepest, the first of several; null outside of all.
  shares(px, py) {
    const { x, y, simplices, raster } = this;
    const square = raster.square(px, py);
    let best = { depth: -OUTSIDE, shares: null };
    for (let at = this.first[square]; at < this.first[square + 1]; at++) {
      const [a, b, c] = simplices.subarray(3 * this.triangles[at], 3 * this.triangles[at] + 3);
      const [wa, wb, wc] = [area(x, y, b, c, px, py), area(x, y, c, a, px, py), area(x, y, a, b, px, py)];
      const sum = wa + wb + wc;
      if (sum === 0) continue;
      const depth = Math.min(wa / sum, wb / sum, wc / sum);
      if (depth >= best.depth && !(depth === best.depth && best.shares)) best = { depth, shares: [[a, wa / sum], [b, wb / sum], [c, wc / sum]] };
    }
    return best.shares;
  }
}

// The cells of a lattice by column and row.
class LatticeCells {
  constructor({ x, y, half: [hx, hy] }) {
    const { left, bottom } = boundsOf(x, y);
    Object.assign(this, { low: [left, bottom], spacing: [2 * hx[0], 2 * hy[0]], points: new Map() });
    x.forEach((_, point) => this.points.set(this.along(x[point], y[point]).map(Math.round).join(), point));
  }

  // A place in cells from the centre of the first column and row.
  along(x, y) {
    return [x, y].map((it, axis) => (it - this.low[axis]) / this.spacing[axis]);
  }

  // Centres around a place and their shares, without those of cells that are not there; null where none of the cells has the place.
  shares(x, y) {
    const at = this.along(x, y);
    const near = [];
    let isInside = false;
    for (let corner = 0; corner < 4; corner++) {
      const cell = at.map((it, axis) => Math.floor(it) + (corner >> axis & 1));
      const point = this.points.get(cell.join());
      if (point === undefined) continue;
      const distances = at.map((it, axis) => Math.abs(it - cell[axis]));
      isInside ||= distances.every((it) => it <= 0.5 + OUTSIDE);
      near.push([point, (1 - distances[0]) * (1 - distances[1])]);
    }
    return isInside ? near : null;
  }
}
