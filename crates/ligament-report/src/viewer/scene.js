// The body in a step as it is seen: its shape, section and crack, the pixels of its points, and what a pixel shows.

// Opacity of a body around the surface of its crack.
const GHOST = 0.16;
const NO_CUT = { list: [], key: "" };

class Scene {
  // `changed` is called when what was drawn was lost, or can be drawn again.
  constructor(canvas, camera, changed) {
    this.canvas = canvas;
    this.camera = camera;
    this.drawing = Drawing.on(canvas);
    canvas.addEventListener("webglcontextlost", (event) => {
      event.preventDefault();
      this.drawing = null;
      changed();
    });
    canvas.addEventListener("webglcontextrestored", () => {
      this.drawing = Drawing.on(canvas);
      this.upload();
      changed();
    });
  }

  // Another body.
  show(body) {
    this.body = body;
    this.isSolid = body.dimension === 3;
    this.key = null;
    this.vertices = null;
    const coordinates = [body.x, body.y, body.z];
    const bound = (sign) => coordinates.map((along, axis) => along.reduce((most, it, point) => {
      const outer = sign * it + (body.half ? body.half[axis][point] : 0);
      return outer > most ? outer : most;
    }, -Infinity) * sign);
    this.box = { low: bound(-1), high: bound(1) };
    this.origin = this.box.low.map((it, axis) => (it + this.box.high[axis]) / 2);
  }

  // The state of a step. `cut`: where the crack is; `mode`: how it is drawn; `section`: axis and coordinate of a plane, or null; `rigid`:
  // places, displacements and triangles of rigid bodies, or null.
  place({ displacement, factor, cut, mode, section, rigid }) {
    const { body } = this;
    this.rigid = rigid && { triangles: rigid.triangles, vertices: rigid.places.map((it, at) => it + factor * rigid.displacement[at]) };
    Object.assign(this, { displacement, factor, section, isSurface: mode === "surface" && Boolean(cut.list.length) });
    const shown = mode === "open" ? cut : NO_CUT;
    const key = body.half ? `cells ${mode === "surface"}` : `${shown.key}/${Boolean(section)}`;
    if (key !== this.key) {
      this.key = key;
      // Inner faces beside the crack may be seen.
      this.shape = body.half ? shapeOfCells(body, new Set(mode === "surface" ? [] : cut.nodes?.points)) : shapeOfMesh(body, shown.list, Boolean(section));
    }
    this.vertices = this.shape.moved(displacement, factor);
    this.triangles = Uint32Array.from([...this.shape.outside, ...this.shape.crackTriangles()]);
    this.crack = null;
    if (this.isSurface) {
      const shape = shapeOfCrack(cut.nodes ?? nodesOf(body), cut.list);
      this.crack = openingOf(shape, body, displacement);
      this.crack.vertices = inSection(this.crack, shape.moved(displacement, factor), 3);
    }
    this.plane = null;
    if (section) {
      this.plane = sectionOf(this.shape, section.axis, section.at);
      this.plane.vertices = inSection(this.plane, this.vertices, 3);
      this.plane.points = pointsOfSection(this.plane, this.shape);
    }
  }

  // Values of the points, or of the crack where its surface is drawn, in a range of colours.
  colour(values, range, map) {
    Object.assign(this, { values, range, map });
  }

  // Everything to the graphics, also after it was lost.
  upload() {
    if (!this.drawing || !this.shape || !this.range) return;
    const { low, high } = this.range;
    const size = Math.max(high - low, 1e-300);
    const places = (vertices) => Float32Array.from(vertices, (it, place) => it - this.origin[place % 3]);
    // From 0 to 1, so that single precision serves values of any size.
    const shares = (values) => Float32Array.from(values, (it) => (it - low) / size);
    const none = (vertices) => new Float32Array(vertices.length / 3).fill(NaN);
    this.drawing.setMap(this.map);
    const atVertices = this.isSurface ? null : this.shape.atVertices(this.values);
    this.drawing.setMesh("body", {
      places: places(this.vertices),
      values: atVertices ? shares(atVertices) : none(this.vertices),
      along: this.section ? Float32Array.from({ length: this.shape.count }, (_, vertex) => this.shape.reference[3 * vertex + this.section.axis] - this.section.at) : new Float32Array(1),
      triangles: Uint32Array.from(this.triangles),
    });
    if (this.plane) {
      this.drawing.setMesh("section", {
        places: places(this.plane.vertices),
        values: atVertices ? shares(inSection(this.plane, atVertices, 1)) : none(this.plane.vertices),
        triangles: this.plane.triangles,
      });
    }
    if (this.rigid) {
      const { vertices, triangles } = this.rigid;
      this.drawing.setMesh("rigid", { places: places(vertices), values: none(vertices), triangles: Uint32Array.from(triangles) });
    }
    if (this.crack) this.drawing.setMesh("crack", { places: places(this.crack.vertices), values: shares(this.values), triangles: this.crack.triangles });
  }

  // The side of the section that is not drawn: the one before the eye.
  get hiddenSide() {
    return this.section ? Math.sign(this.camera.toEye[this.section.axis]) || 1 : 0;
  }

  // Draws it with layers of lines, whose places are those of the body.
  draw(layers) {
    const { clientWidth, clientHeight } = this.canvas;
    this.camera.resize(clientWidth, clientHeight);
    const shade = this.isSolid ? 1 : 0;
    const opacity = this.isSurface ? GHOST : 1;
    const body = { name: "body", shade, side: this.hiddenSide, opacity };
    const meshes = this.isSurface ? [{ name: "crack", shade }, body] : [body];
    if (this.plane) meshes.push({ name: "section", shade: 0, opacity });
    if (this.rigid) meshes.unshift({ name: "rigid", shade, opacity });
    this.drawing?.draw(this.camera, this.origin, meshes, layers);
  }

  // Whether a point is on the side of the section that is drawn.
  isSeen(point) {
    if (!this.section) return true;
    const { axis, at } = this.section;
    return this.hiddenSide * ([this.body.x, this.body.y, this.body.z][axis][point] - at) <= 0;
  }

  // The deformed place of a point.
  placeOf(point) {
    const { x, y, z } = this.body;
    return [x[point], y[point], z[point]].map((it, axis) => it + this.factor * (this.displacement[axis]?.[point] ?? 0));
  }

  // A place as lines are drawn, relative to the origin.
  relative(place) {
    return place.map((it, axis) => it - this.origin[axis]);
  }

  pixelOf(point) {
    return this.camera.toScreen(...this.placeOf(point));
  }

  // The point that is seen at a pixel: the nearest corner of the foremost triangle there, or a vertex near by; null away from the body.
  pointAt(px, py) {
    if (!this.vertices) return null;
    const { shape, plane } = this;
    const ofVertex = (vertex) => shape.points[shape.first[vertex]];
    const found = this.foremost(this.vertices, this.triangles, [px, py], (vertex) => this.isSeen(ofVertex(vertex)));
    const inPlane = plane && this.foremost(plane.vertices, plane.triangles, [px, py], () => true);
    if (inPlane?.vertex >= 0 && inPlane.depth >= found.depth) return plane.points[inPlane.vertex];
    return found.vertex >= 0 ? ofVertex(found.vertex) : null;
  }

  foremost(vertices, triangles, [px, py], isSeen) {
    const count = vertices.length / 3;
    const [sx, sy, depth] = [0, 1, 2].map(() => new Float64Array(count));
    let near = { distance: TOUCH, vertex: -1 };
    for (let vertex = 0; vertex < count; vertex++) {
      [sx[vertex], sy[vertex], depth[vertex]] = this.camera.toScreen(vertices[3 * vertex], vertices[3 * vertex + 1], vertices[3 * vertex + 2]);
      const distance = Math.hypot(sx[vertex] - px, sy[vertex] - py);
      if (distance < near.distance && isSeen(vertex)) near = { distance, vertex };
    }
    let best = { depth: -Infinity, vertex: -1 };
    for (let place = 0; place < triangles.length; place += 3) {
      const [a, b, c] = [triangles[place], triangles[place + 1], triangles[place + 2]];
      const [wa, wb, wc] = [area(sx, sy, b, c, px, py), area(sx, sy, c, a, px, py), area(sx, sy, a, b, px, py)];
      const sum = wa + wb + wc;
      if (sum === 0 || wa * sum < 0 || wb * sum < 0 || wc * sum < 0) continue;
      const here = (wa * depth[a] + wb * depth[b] + wc * depth[c]) / sum;
      const [of] = [[wa, a], [wb, b], [wc, c]].reduce(([most, size], [weight, vertex]) => (weight / sum > size ? [vertex, weight / sum] : [most, size]), [a, -1]);
      if (here > best.depth && isSeen(of)) best = { depth: here, vertex: of };
    }
    return best.vertex >= 0 ? best : { depth: -Infinity, vertex: near.vertex };
  }
}

// Pixels from a vertex that belong to it where there is no triangle.
const TOUCH = 12;

// Twice the area of a triangle of two vertices and a pixel.
function area(sx, sy, b, c, px, py) {
  return (sx[b] - px) * (sy[c] - py) - (sx[c] - px) * (sy[b] - py);
}
