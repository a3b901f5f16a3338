// The body on a canvas, by WebGL 2: triangles coloured by values, and lines of a width over them.

const SURFACE = [`#version 300 es
in vec3 place;
in float value;
in float along;
uniform mat3 turn;
uniform vec3 centre;
uniform vec3 scale;
uniform vec2 offset;
out float share;
out float beyond;
out vec3 seen;
void main() {
  seen = turn * (place - centre);
  gl_Position = vec4(seen.xy * scale.xy, -seen.z * scale.z, 1.0);
  share = value;
  beyond = offset.y * (along - offset.x);
}`, `#version 300 es
precision highp float;
in float share;
in float beyond;
in vec3 seen;
uniform sampler2D map;
uniform float shade;
uniform float opacity;
out vec4 colour;
void main() {
  if (beyond > 0.0) discard;
  // A value that is no number is no colour of the map.
  bool known = share >= -1e30 && share <= 1e30;
  float at = clamp(share, 0.0, 1.0) * 255.0 / 256.0 + 0.5 / 256.0;
  vec3 own = known ? texture(map, vec2(at, 0.5)).rgb : vec3(0.5);
  // Light from the eye and a little from above, on either side of a face.
  vec3 normal = normalize(cross(dFdx(seen), dFdy(seen)));
  float light = 0.7 + 0.34 * abs(dot(normal, normalize(vec3(0.25, 0.45, 0.86))));
  colour = vec4(own * mix(1.0, light, shade) * opacity, opacity);
}`];

// A segment is an instance of a rectangle of four corners.
const LINES = [`#version 300 es
in vec3 start;
in vec3 end;
in vec4 tint;
uniform mat3 turn;
uniform vec3 centre;
uniform vec3 scale;
uniform vec2 pixels;
uniform float width;
out vec4 passed;
void main() {
  vec2 a = (turn * (start - centre)).xy * scale.xy;
  vec2 b = (turn * (end - centre)).xy * scale.xy;
  vec2 along = (b - a) * pixels;
  vec2 direction = along / max(length(along), 1e-6);
  vec2 across = vec2(-direction.y, direction.x);
  vec2 at = (gl_VertexID & 1) == 0 ? a - direction * width / pixels * 0.5 : b + direction * width / pixels * 0.5;
  float side = gl_VertexID < 2 ? -1.0 : 1.0;
  gl_Position = vec4(at + across * side * width / pixels, 0.0, 1.0);
  passed = tint;
}`, `#version 300 es
precision highp float;
in vec4 passed;
out vec4 colour;
void main() { colour = vec4(passed.rgb * passed.a, passed.a); }`];

// Depth that is seen, in diagonals of the body.
const DEPTH = 6;

class Drawing {
  // Null where the browser has no WebGL 2.
  static on(canvas) {
    const gl = canvas.getContext("webgl2", { antialias: true, preserveDrawingBuffer: true });
    return gl && !gl.isContextLost() ? new Drawing(canvas, gl) : null;
  }

  constructor(canvas, gl) {
    this.canvas = canvas;
    this.gl = gl;
    this.surface = program(gl, SURFACE);
    this.lines = program(gl, LINES);
    this.buffers = new Map();
    this.meshes = new Map();
    this.map = gl.createTexture();
    gl.bindTexture(gl.TEXTURE_2D, this.map);
    for (const edge of [gl.TEXTURE_WRAP_S, gl.TEXTURE_WRAP_T]) gl.texParameteri(gl.TEXTURE_2D, edge, gl.CLAMP_TO_EDGE);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.LINEAR);
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
    gl.depthFunc(gl.LEQUAL);
  }

  // A mesh by its name: places of vertices, three numbers each, relative to an origin, because single precision does not tell near points of a
  // far body apart; values from 0 to 1; coordinates along the normal of a section; corners of triangles. What is not given stays.
  setMesh(name, parts) {
    const { gl } = this;
    const mesh = this.meshes.get(name) ?? {};
    this.meshes.set(name, mesh);
    for (const [part, numbers] of Object.entries(parts)) {
      mesh[part] ??= gl.createBuffer();
      const target = part === "triangles" ? gl.ELEMENT_ARRAY_BUFFER : gl.ARRAY_BUFFER;
      gl.bindBuffer(target, mesh[part]);
      gl.bufferData(target, numbers, gl.DYNAMIC_DRAW);
      if (part === "triangles") mesh.nCorners = numbers.length;
    }
  }

  setMap(bytes) {
    const { gl } = this;
    gl.bindTexture(gl.TEXTURE_2D, this.map);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA, bytes.length / 4, 1, 0, gl.RGBA, gl.UNSIGNED_BYTE, bytes);
  }

  // Draws meshes in their order, and layers of lines over them. A mesh is { name, shade, opacity, offset, side }: nothing of it is drawn on
  // that side of the offset of a section.
  draw(camera, origin, meshes, layers) {
    const { gl, canvas } = this;
    const ratio = window.devicePixelRatio || 1;
    const [width, height] = [camera.width, camera.height].map((it) => Math.round(it * ratio));
    if (canvas.width !== width || canvas.height !== height) Object.assign(canvas, { width, height });
    gl.viewport(0, 0, width, height);
    gl.clearColor(0, 0, 0, 0);
    gl.depthMask(true);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    gl.enable(gl.DEPTH_TEST);
    for (const of of [this.surface, this.lines]) {
      gl.useProgram(of.program);
      // The columns of a matrix come first.
      gl.uniformMatrix3fv(of.uniform("turn"), true, [...camera.right, ...camera.up, ...camera.toEye]);
      gl.uniform3fv(of.uniform("centre"), camera.centre.map((it, axis) => it - origin[axis]));
      gl.uniform3f(of.uniform("scale"), (2 * camera.scale) / camera.width, (2 * camera.scale) / camera.height, 1 / (DEPTH * camera.diagonal));
    }
    for (const mesh of meshes) this.drawMesh(mesh);
    gl.disable(gl.DEPTH_TEST);
    gl.useProgram(this.lines.program);
    gl.uniform2f(this.lines.uniform("pixels"), width / 2, height / 2);
    for (const layer of layers) this.drawLayer(layer, ratio);
  }

  drawMesh({ name, shade, opacity = 1, offset = 0, side = 0 }) {
    const { gl, surface } = this;
    const mesh = this.meshes.get(name);
    if (!mesh?.nCorners) return;
    gl.useProgram(surface.program);
    gl.uniform1f(surface.uniform("shade"), shade);
    gl.uniform1f(surface.uniform("opacity"), opacity);
    gl.uniform2f(surface.uniform("offset"), offset, side);
    gl.depthMask(opacity === 1);
    this.attribute(surface, "place", mesh.places, 3, 0);
    this.attribute(surface, "value", mesh.values, 1, 0);
    const along = surface.attribute("along");
    if (side !== 0) this.attribute(surface, "along", mesh.along, 1, 0);
    else gl.disableVertexAttribArray(along);
    gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, mesh.triangles);
    gl.drawElements(gl.TRIANGLES, mesh.nCorners, gl.UNSIGNED_INT, 0);
  }

  drawLayer({ starts, ends, tints, width }, ratio) {
    const { gl } = this;
    if (starts.length === 0) return;
    gl.uniform1f(this.lines.uniform("width"), (width * ratio) / 2);
    for (const [name, numbers, size] of [["start", starts, 3], ["end", ends, 3], ["tint", tints, 4]]) {
      if (!this.buffers.has(name)) this.buffers.set(name, gl.createBuffer());
      gl.bindBuffer(gl.ARRAY_BUFFER, this.buffers.get(name));
      gl.bufferData(gl.ARRAY_BUFFER, numbers, gl.DYNAMIC_DRAW);
      this.attribute(this.lines, name, this.buffers.get(name), size, 1);
    }
    gl.drawArraysInstanced(gl.TRIANGLE_STRIP, 0, 4, starts.length / 3);
    for (const name of ["start", "end", "tint"]) gl.vertexAttribDivisor(this.lines.attribute(name), 0);
  }

  attribute(of, name, buffer, size, divisor) {
    const { gl } = this;
    const place = of.attribute(name);
    // Optimised away where nothing depends on it.
    if (place < 0) return;
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

// Lines of one colour, red, green, blue and opacity from 0 to 1; segments are pairs of places.
function lineLayer(segments, colour, width) {
  const [starts, ends] = [0, 1].map((end) => Float32Array.from(segments.flatMap((it) => it[end])));
  const tints = new Float32Array(4 * segments.length);
  for (let place = 0; place < tints.length; place++) tints[place] = colour[place % 4];
  return { starts, ends, tints, width };
}
