// What is drawn of a body: vertices that follow points, triangles between them, and tetrahedra that planes cut.
//
// A vertex follows the mean of one point or more. Cells of a lattice have vertices of their own, so that cracks open between them. A crack
// passes through triangles or tetrahedra of a mesh: the corners of each lie on sides of it, which the page has for each step. It is cut at the
// middles of edges, faces and of itself, where a vertex of each side follows the corners of that side: the crack opens there.

// Edges of a tetrahedron: its ends, and the other two corners.
const EDGES = [[0, 1, 2, 3], [0, 2, 3, 1], [0, 3, 1, 2], [1, 2, 0, 3], [1, 3, 2, 0], [2, 3, 0, 1]];
// Corners of the faces of a tetrahedron, each with the corner opposite to it.
const FACES = [[0, 2, 1, 3], [0, 1, 3, 2], [0, 3, 2, 1], [1, 2, 3, 0]];
// Corners of the faces of a box, whose bits are the sides along x, y and z, and of its tetrahedra about a diagonal.
const BOX_FACES = [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];
const BOX_TETRAHEDRA = [[0, 1, 3, 7], [0, 5, 1, 7], [0, 3, 2, 7], [0, 2, 6, 7], [0, 4, 5, 7], [0, 6, 4, 7]];
const SQUARE = [0, 1, 3, 2];

class Shape {
  constructor() {
    this.reference = [];
    // Points that vertices follow, those of vertex v from first[v] on.
    this.first = [0];
    this.points = [];
    // Corners of the triangles of the outside, of the quadrangles of the crack on one side and on the other, and of the tetrahedra inside.
    this.outside = [];
    this.crack = [[], []];
    this.tetrahedra = [];
  }

  get count() {
    return this.first.length - 1;
  }

  // A new vertex at a place, which follows points.
  add(place, points) {
    this.reference.push(...place);
    this.points.push(...points);
    return this.first.push(this.points.length) - 2;
  }

  // Means of values of the points at the vertices.
  atVertices(values) {
    const { first, points, count } = this;
    const means = new Float64Array(count);
    for (let vertex = 0; vertex < count; vertex++) {
      let sum = 0;
      for (let place = first[vertex]; place < first[vertex + 1]; place++) sum += values[points[place]];
      means[vertex] = sum / (first[vertex + 1] - first[vertex]);
    }
    return means;
  }

  // Places of the vertices with a multiple of the displacement.
  moved(displacement, factor) {
    const places = Float64Array.from(this.reference);
    displacement.forEach((along, axis) => {
      const means = this.atVertices(along);
      for (let vertex = 0; vertex < means.length; vertex++) places[3 * vertex + axis] += factor * means[vertex];
    });
    return places;
  }

  // Triangles of both sides of the crack.
  crackTriangles() {
    const triangles = [];
    for (const side of this.crack) {
      for (let place = 0; place < side.length; place += 4) quadrangle(triangles, side.slice(place, place + 4));
    }
    return triangles;
  }

  // Once all vertices are there.
  finished() {
    this.first = Uint32Array.from(this.first);
    this.points = Uint32Array.from(this.points);
    this.outside = Uint32Array.from(this.outside);
    return this;
  }
}

// The shape of a body whose cells lie around its points; faces that others hide are only there beside a crack.
function shapeOfCells(body, beside) {
  const shape = new Shape();
  const [hx, hy, hz] = body.half;
  const isSolid = body.dimension === 3;
  const nCorners = isSolid ? 8 : 4;
  const signs = (corner) => [0, 1, 2].map((axis) => (corner >> axis & 1 ? 1 : -1));
  for (let point = 0; point < body.x.length; point++) {
    const [middle, half] = [[body.x[point], body.y[point], body.z[point]], [hx[point], hy[point], hz[point]]];
    for (let corner = 0; corner < nCorners; corner++) shape.add(signs(corner).map((sign, axis) => middle[axis] + sign * half[axis]), [point]);
  }
  if (!isSolid) {
    for (let point = 0; point < body.x.length; point++) quadrangle(shape.outside, SQUARE.map((it) => 4 * point + it));
    return shape.finished();
  }
  const shared = new Map();
  const key = (point, face) => {
    const axis = face >> 1;
    const half = [hx[point], hy[point], hz[point]];
    const place = [body.x[point], body.y[point], body.z[point]].map((it, k) => (it + (k === axis ? (face & 1 ? 1 : -1) * half[k] : 0)) / (2 * half[k]));
    return `${axis} ${place.map((it) => Math.round(2 * it)).join(" ")}`;
  };
  const each = (visit) => {
    for (let point = 0; point < body.x.length; point++) BOX_FACES.forEach((corners, face) => visit(point, corners, key(point, face)));
  };
  each((point, _, place) => shared.set(place, (shared.get(place) ?? 0) + 1));
  each((point, corners, place) => {
    if (shared.get(place) === 1 || beside.has(point)) quadrangle(shape.outside, corners.map((it) => 8 * point + it));
  });
  for (let point = 0; point < body.x.length; point++) {
    for (const tetrahedron of BOX_TETRAHEDRA) shape.tetrahedra.push(...tetrahedron.map((it) => 8 * point + it));
  }
  return shape.finished();
}

function quadrangle(triangles, [a, b, c, d]) {
  triangles.push(a, b, c, a, c, d);
}

// The shape of a body with triangles, or tetrahedra, between its points; `cut` are pairs of one of them with the sides of a crack at its
// corners. Only a section needs the inside.
function shapeOfMesh(body, cut, withInside) {
  const shape = new Shape();
  for (let point = 0; point < body.x.length; point++) shape.add([body.x[point], body.y[point], body.z[point]], [point]);
  const { simplices } = body;
  const size = body.dimension + 1;
  const corners = (simplex) => simplices.subarray(size * simplex, size * simplex + size);
  const cutting = new Cutting(shape, (node) => [shape.reference[3 * node], shape.reference[3 * node + 1], shape.reference[3 * node + 2]], (node) => node);
  const sidesAt = new Map(cut);
  const show = (simplex, [a, b, c]) => {
    const sides = sidesAt.get(simplex);
    if (sides) cutting.face(corners(simplex), sides, [a, b, c]);
    else shape.outside.push(...[a, b, c].map((it) => corners(simplex)[it]));
  };
  if (body.dimension === 2) {
    for (let triangle = 0; size * triangle < simplices.length; triangle++) show(triangle, [0, 1, 2]);
    return shape.finished();
  }
  if (withInside) {
    for (let tetrahedron = 0; size * tetrahedron < simplices.length; tetrahedron++) {
      const sides = sidesAt.get(tetrahedron);
      if (sides) cutting.fill(corners(tetrahedron), sides);
      else shape.tetrahedra.push(...corners(tetrahedron));
    }
  }
  body.outside ??= outsideOf(simplices);
  for (const [tetrahedron, face] of body.outside) show(tetrahedron, FACES[face]);
  for (const [tetrahedron, sides] of cut) cutting.crack(corners(tetrahedron), sides);
  return shape.finished();
}

// The nodes of a mesh, which are its points.
function nodesOf({ x, y, z, simplices }) {
  return { position: [x, y, z], points: x.map((_, point) => point), corners: simplices };
}

// The crack as a shape of its own, between nodes that follow points.
function shapeOfCrack(nodes, cut) {
  const shape = new Shape();
  const [x, y, z] = nodes.position;
  nodes.points.forEach((point, node) => shape.add([x[node], y[node], z[node]], [point]));
  const cutting = new Cutting(shape, (node) => [x[node], y[node], z[node]], (node) => nodes.points[node]);
  for (const [tetrahedron, sides] of cut) cutting.crack(nodes.corners.subarray(4 * tetrahedron, 4 * tetrahedron + 4), sides);
  return shape.finished();
}

// The crack surface of a shape, half way between its sides, with the opening along its normal for the displacements of the points.
function openingOf(shape, body, displacement) {
  const [from, to] = shape.crack.map((it) => Uint32Array.from(it));
  const triangles = [];
  const values = new Float64Array(from.length);
  const moved = displacement.map((it) => shape.atVertices(it));
  const { reference, first, points } = shape;
  const place = (vertex) => [0, 1, 2].map((axis) => reference[3 * vertex + axis]);
  for (let corner = 0; corner < from.length; corner += 4) {
    const at = [0, 1, 2, 3].map((it) => corner + it);
    quadrangle(triangles, at);
    const [a, b, c, d] = at.map((it) => place(from[it]));
    let normal = cross(minus3(c, a), minus3(d, b));
    const length = Math.hypot(...normal) || 1;
    // From the side of the first to that of the second.
    const [start, end] = [from, to].map((it) => points[first[it[corner]]]).map((it) => [body.x[it], body.y[it], body.z[it]]);
    const sign = dot3(normal, minus3(end, start)) < 0 ? -1 : 1;
    normal = normal.map((it) => (sign * it) / length);
    for (const it of at) values[it] = moved.reduce((sum, along, axis) => sum + (along[to[it]] - along[from[it]]) * normal[axis], 0);
  }
  return { from, to, shares: new Float64Array(from.length).fill(0.5), triangles: Uint32Array.from(triangles), values };
}

const minus3 = (a, b) => a.map((it, axis) => it - b[axis]);
const dot3 = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];

// Faces that belong to one tetrahedron alone, as pairs of tetrahedron and face.
function outsideOf(simplices) {
  const found = new Map();
  const count = simplices.reduce((most, it) => Math.max(most, it), 0) + 1;
  for (let tetrahedron = 0; 4 * tetrahedron < simplices.length; tetrahedron++) {
    FACES.forEach((corners, face) => {
      const [a, b, c] = corners.slice(0, 3).map((it) => simplices[4 * tetrahedron + it]).sort((one, other) => one - other);
      // As long as it is exact: 200,000 points.
      const key = (a * count + b) * count + c;
      if (found.has(key)) found.set(key, null);
      else found.set(key, [tetrahedron, face]);
    });
  }
  return [...found.values()].filter(Boolean);
}

// Cuts triangles and tetrahedra at the middles of their edges, faces and of themselves, with a vertex for each side of the crack.
class Cutting {
  // `placeOf` and `pointOf` give the place of a node, and the point that it follows.
  constructor(shape, placeOf, pointOf) {
    Object.assign(this, { shape, placeOf, pointOf });
    this.found = new Map();
  }

  // The vertex on the side of a corner in the middle of some corners: in the mean of the middles of cut edges between them.
  vertex(nodes, sides, among, corner) {
    const own = among.filter((it) => sides[it] === sides[corner]);
    if (own.length === among.length && among.length === 1) return this.single(nodes[corner]);
    const name = (all) => Array.from(all, (it) => nodes[it]).sort((one, other) => one - other).join(" ");
    const cutEdges = EDGES.filter(([a, b]) => among.includes(a) && among.includes(b) && sides[a] !== sides[b]);
    const edges = cutEdges.length > 0 ? cutEdges : EDGES.filter(([a, b]) => among.includes(a) && among.includes(b));
    const key = `${name(among)}/${name(own)}/${cutEdges.length}`;
    if (!this.found.has(key)) {
      const ends = edges.flatMap(([a, b]) => [a, b]).map((it) => this.placeOf(nodes[it]));
      const place = [0, 1, 2].map((axis) => ends.reduce((sum, it) => sum + it[axis], 0) / ends.length);
      this.found.set(key, this.shape.add(place, own.map((it) => this.pointOf(nodes[it]))));
    }
    return this.found.get(key);
  }

  // The vertex of a node: of a mesh the nodes are the first vertices.
  single(node) {
    return node;
  }

  // Small tetrahedra between a corner and the middles of an edge, a face and the tetrahedron.
  fill(nodes, sides) {
    const all = [0, 1, 2, 3];
    for (const [one, other, ...rest] of EDGES) {
      for (const corner of [one, other]) {
        for (const third of rest) {
          const at = (among) => this.vertex(nodes, sides, among, corner);
          this.shape.tetrahedra.push(at([corner]), at([one, other]), at([one, other, third]), at(all));
        }
      }
    }
  }

  // A triangle in the plane or at the outside of a solid: each side has the parts of its edges, up to the middle of the triangle. Other edges
  // stay whole, as they are in the triangle beside them.
  face(nodes, sides, corners) {
    const isCut = corners.some((it) => sides[it] !== sides[corners[0]]);
    if (!isCut) {
      this.shape.outside.push(...corners.map((it) => nodes[it]));
      return;
    }
    corners.forEach((one, place) => {
      const other = corners[(place + 1) % 3];
      const at = (corner, among) => this.vertex(nodes, sides, among, corner);
      const middle = (corner) => [at(corner, [one, other]), at(corner, corners)];
      if (sides[one] === sides[other]) this.shape.outside.push(nodes[one], nodes[other], at(one, corners));
      else this.shape.outside.push(nodes[one], ...middle(one), ...middle(other), nodes[other]);
    });
  }

  // The quadrangles of the crack between corners on different sides, one for each side.
  crack(nodes, sides) {
    for (const [one, other, third, fourth] of EDGES) {
      if (sides[one] === sides[other]) continue;
      const between = [[one, other], [one, other, third], [0, 1, 2, 3], [one, other, fourth]];
      [one, other].forEach((corner, side) => {
        this.shape.crack[side].push(...between.map((among) => this.vertex(nodes, sides, among, corner)));
      });
    }
  }
}

// Sides of the corners of a triangle or tetrahedron from their code; null where it is not cut.
function sidesOf(code) {
  return code === 0 ? null : [0, code & 1, code >> 1 & 3, code >> 3];
}
