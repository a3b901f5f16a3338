// The section of a body by a plane across an axis: what tetrahedra have in it, on edges between their corners.

// The section of a shape at a coordinate along an axis: ends of the cut edges, the share from the first to the second, and triangles.
function sectionOf(shape, axis, coordinate) {
  const { reference, tetrahedra } = shape;
  const [from, to, shares, triangles] = [[], [], [], []];
  const found = new Map();
  const count = shape.count;
  const above = (vertex) => reference[3 * vertex + axis] > coordinate;
  const cut = (a, b) => {
    const [low, high] = a < b ? [a, b] : [b, a];
    const key = low * count + high;
    if (!found.has(key)) {
      const [start, end] = [reference[3 * low + axis], reference[3 * high + axis]];
      found.set(key, from.length);
      from.push(low);
      to.push(high);
      shares.push((coordinate - start) / (end - start));
    }
    return found.get(key);
  };
  for (let place = 0; place < tetrahedra.length; place += 4) {
    const corners = [0, 1, 2, 3].map((it) => tetrahedra[place + it]);
    const over = corners.filter(above);
    if (over.length === 0 || over.length === 4) continue;
    const under = corners.filter((it) => !above(it));
    if (over.length === 2) {
      const [[a, b], [c, d]] = [over, under];
      quadrangle(triangles, [cut(a, c), cut(a, d), cut(b, d), cut(b, c)]);
    } else {
      const [[single], three] = over.length === 1 ? [over, under] : [under, over];
      triangles.push(...three.map((it) => cut(single, it)));
    }
  }
  return { from: Uint32Array.from(from), to: Uint32Array.from(to), shares: Float64Array.from(shares), triangles: Uint32Array.from(triangles) };
}

// Values of the vertices of a section, so many numbers at each, from those of the shape.
function inSection({ from, to, shares }, values, size) {
  const found = new Float64Array(size * from.length);
  for (let vertex = 0; vertex < from.length; vertex++) {
    for (let part = 0; part < size; part++) {
      const [one, other] = [values[size * from[vertex] + part], values[size * to[vertex] + part]];
      found[size * vertex + part] = one + shares[vertex] * (other - one);
    }
  }
  return found;
}

// The point that each vertex of a section is nearest to.
function pointsOfSection({ from, to, shares }, shape) {
  return Uint32Array.from(from, (it, vertex) => shape.points[shape.first[shares[vertex] < 0.5 ? it : to[vertex]]]);
}
