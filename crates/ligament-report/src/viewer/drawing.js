// The body on a canvas, by WebGL 2: triangles coloured by values, and lines of a width over them.

const SURFACE = [`#version 300 es
in vec2 place;
in float value;
uniform vec4 view;
out float share;
uniform vec2 range;
void main() {
  gl_Position = vec4((place - view.xy) * view.zw, 0.0, 1.0);
  share = (value - range.x) / (range.y - range.x);
}`, `#version 300 es
precision highp float;
in float share;
uniform sampler2D map;
out vec4 colour;
void main() {
  // A value that is no number is no colour of the map.
  bool known = share >= -1e30 && share <= 1e30;
  float at = clamp(share, 0.0, 1.0) * 255.0 / 256.0 + 0.5 / 256.0;
  colour = known ? texture(map, vec2(at, 0.5)) : vec4(0.5, 0.5, 0.5, 1.0);
}`];

// A segment is an instance of a rectangle of four corners.
const LINES = [`#version 300 es
in vec4 segment;
in vec4 tint;
uniform vec4 view;
uniform vec2 pixels;
uniform float width;
out vec4 passed;
void main() {
  vec2 a = (segment.xy - view.xy) * view.zw;
  vec2 b = (segment.zw - view.xy) * view.zw;
  vec2 along = (b - a) * pixels;
  vec2 direction = along / max(length(along), 1e-6);
  vec2 across = vec2(-direction.y, direction.x);
  vec2 end = (gl_VertexID & 1) == 0 ? a - direction * width / pixels * 0.5 : b + direction * width / pixels * 0.5;
  float side = gl_VertexID < 2 ? -1.0 : 1.0;
  gl_Position = vec4(end + across * side * width / pixels, 0.0, 1.0);
  passed = tint;
}`, `#version 300 es
precision highp float;
in vec4 passed;
out vec4 colour;
void main() { colour = vec4(passed.rgb * passed.a, passed.a); }`];

class Drawing {
  // Null where the browser has no WebGL 2.
  static on(canvas) {
    const gl = canvas.getContext("webgl2", { antialias: true, preserveDrawingBuffer: true });
    return gl && new Drawing(canvas, gl);
  }

  constructor(canvas, gl) {
    this.canvas = canvas;
    this.gl = gl;
    this.surface = program(gl, SURFACE);
    this.lines = program(gl, LINES);
    this.places = gl.createBuffer();
    this.values = gl.createBuffer();
    this.corners = gl.createBuffer();
    this.segments = gl.createBuffer();
    this.tints = gl.createBuffer();
    this.nCorners = 0;
    this.map = gl.createTexture();
    gl.bindTexture(gl.TEXTURE_2D, this.map);
    for (const edge of [gl.TEXTURE_WRAP_S, gl.TEXTURE_WRAP_T]) gl.texParameteri(gl.TEXTURE_2D, edge, gl.CLAMP_TO_EDGE);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.LINEAR);
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
  }

  setTriangles(corners) {
    const { gl } = this;
    this.nCorners = corners.length;
    gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, this.corners);
    gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, corners, gl.STATIC_DRAW);
  }

  // Places are relative to `origin`, because single precision does not tell near points of a far body apart.
  setPlaces(places) {
    this.upload(this.places, places);
  }

  setValues(values) {
    this.upload(this.values, values);
  }

  setMap(bytes) {
    const { gl } = this;
    gl.bindTexture(gl.TEXTURE_2D, this.map);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA, bytes.length / 4, 1, 0, gl.RGBA, gl.UNSIGNED_BYTE, bytes);
  }

  upload(buffer, numbers) {
    const { gl } = this;
    gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
    gl.bufferData(gl.ARRAY_BUFFER, numbers, gl.DYNAMIC_DRAW);
  }

  // Draws the body and layers of lines over it.
  draw(camera, origin, range, layers) {
    const { gl, canvas } = this;
    const ratio = window.devicePixelRatio || 1;
    const [width, height] = [camera.width, camera.height].map((it) => Math.round(it * ratio));
    if (canvas.width !== width || canvas.height !== height) Object.assign(canvas, { width, height });
    gl.viewport(0, 0, width, height);
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT);
    const view = [
      camera.centre[0] - origin[0], camera.centre[1] - origin[1],
      (2 * camera.scale) / camera.width, (2 * camera.scale) / camera.height,
    ];
    gl.useProgram(this.surface.program);
    gl.uniform4fv(this.surface.uniform("view"), view);
    gl.uniform2f(this.surface.uniform("range"), range.low, range.high);
    this.attribute(this.surface, "place", this.places, 2, 0);
    this.attribute(this.surface, "value", this.values, 1, 0);
    gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, this.corners);
    gl.drawElements(gl.TRIANGLES, this.nCorners, gl.UNSIGNED_INT, 0);
    gl.useProgram(this.lines.program);
    gl.uniform4fv(this.lines.uniform("view"), view);
    gl.uniform2f(this.lines.uniform("pixels"), width / 2, height / 2);
    for (const layer of layers) this.drawLayer(layer, ratio);
  }

  drawLayer({ segments, tints, width }, ratio) {
    const { gl } = this;
    if (segments.length === 0) return;
    this.upload(this.segments, segments);
    this.upload(this.tints, tints);
    gl.uniform1f(this.lines.uniform("width"), (width * ratio) / 2);
    this.attribute(this.lines, "segment", this.segments, 4, 1);
    this.attribute(this.lines, "tint", this.tints, 4, 1);
    gl.drawArraysInstanced(gl.TRIANGLE_STRIP, 0, 4, segments.length / 4);
    for (const name of ["segment", "tint"]) gl.vertexAttribDivisor(this.lines.attribute(name), 0);
  }

  attribute(of, name, buffer, size, divisor) {
    const { gl } = this;
    const place = of.attribute(name);
    gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
    gl.enableVertexAttribArray(place);
    gl.vertexAttribPointer(place, size, gl.FLOAT, false, 0, 0);
    gl.vertexAttribDivisor(place, divisor);
  }
}

function program(gl, [vertex, fragment]) {
  const made = gl.createProgram();
  for (const [kind, source] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]]) {
    const shader = gl.createShader(kind);
    gl.shaderSource(shader, source);
    gl.compileShader(shader);
    gl.attachShader(made, shader);
  }
  gl.linkProgram(made);
  if (!gl.getProgramParameter(made, gl.LINK_STATUS)) throw new Error(gl.getProgramInfoLog(made));
  const [uniforms, attributes] = [new Map(), new Map()];
  const remembered = (places, name, find) => {
    if (!places.has(name)) places.set(name, find());
    return places.get(name);
  };
  return {
    program: made,
    uniform: (name) => remembered(uniforms, name, () => gl.getUniformLocation(made, name)),
    attribute: (name) => remembered(attributes, name, () => gl.getAttribLocation(made, name)),
  };
}

// Lines of one colour: red, green, blue and opacity from 0 to 1.
function lineLayer(segments, colour, width) {
  const tints = new Float32Array(segments.length);
  for (let place = 0; place < tints.length; place++) tints[place] = colour[place % 4];
  return { segments: Float32Array.from(segments), tints, width };
}
