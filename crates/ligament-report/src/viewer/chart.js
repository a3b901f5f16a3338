// A chart of curves as SVG, with a mark at the step that is seen.

const SVG = "http://www.w3.org/2000/svg";
const CHART = { width: 460, height: 270, left: 72, right: 14, top: 10, bottom: 42 };

function svgElement(name, attributes = {}, text = null) {
  const element = document.createElementNS(SVG, name);
  for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
  if (text !== null) element.textContent = text;
  return element;
}

// Series: { label, x, y, colour (1 to 8), style (`thin`, `dashed` or none), steps (places of steps by point, or none) }. `pick` is called with
// the place of a point.
class Chart {
  constructor(parent, title) {
    this.parent = parent;
    this.title = title;
    this.series = [];
  }

  show({ series, xLabel, yLabel, logarithmic = false, pick = null }) {
    Object.assign(this, { series, xLabel, yLabel, logarithmic, pick });
    const points = series.flatMap((it) => it.x.map((x, place) => [x, it.y[place]]));
    const drawn = points.filter(([x, y]) => Number.isFinite(x) && Number.isFinite(y) && (!logarithmic || y > 0));
    this.parent.replaceChildren();
    this.mark = null;
    if (drawn.length === 0) {
      const none = document.createElement("p");
      none.className = "note";
      none.textContent = "Nothing to draw.";
      this.parent.append(none);
      return;
    }
    this.range = {
      x: wider(drawn.map((it) => it[0])),
      y: wider(drawn.map((it) => (logarithmic ? Math.log10(it[1]) : it[1]))),
    };
    this.draw();
  }

  get area() {
    const { width, height, left, right, top, bottom } = CHART;
    return { left, top, width: width - left - right, height: height - top - bottom };
  }

  x(value) {
    const [low, high] = this.range.x;
    return this.area.left + ((value - low) / (high - low)) * this.area.width;
  }

  y(value) {
    const [low, high] = this.range.y;
    const shown = this.logarithmic ? Math.log10(value) : value;
    return this.area.top + (1 - (shown - low) / (high - low)) * this.area.height;
  }

  draw() {
    const { width, height } = CHART;
    this.svg = svgElement("svg", { viewBox: `0 0 ${width} ${height}`, role: "img", "aria-label": this.title, class: "chart" });
    this.drawAxes();
    for (const series of this.series) this.drawSeries(series);
    this.mark = svgElement("g", { class: "mark", visibility: "hidden" });
    this.mark.append(
      svgElement("line", { y1: this.area.top, y2: this.area.top + this.area.height }),
      svgElement("circle", { r: 5 }),
    );
    this.svg.append(this.mark);
    this.parent.append(this.svg);
    if (this.series.length > 1) this.parent.append(this.legend());
    this.parent.append(this.exports());
    if (this.pick) this.listen();
  }

  drawAxes() {
    const { left, top, width, height } = this.area;
    const bottom = top + height;
    for (const value of ticks(...this.range.x, 5)) {
      const x = this.x(value);
      this.svg.append(svgElement("line", { class: "grid", x1: x, x2: x, y1: top, y2: bottom }));
      this.svg.append(svgElement("text", { x, y: bottom + 15, "text-anchor": "middle" }, tickText(value)));
    }
    for (const value of this.logarithmic ? logarithmicTicks(...this.range.y) : ticks(...this.range.y, 5)) {
      const y = this.y(value);
      this.svg.append(svgElement("line", { class: "grid", x1: left, x2: left + width, y1: y, y2: y }));
      this.svg.append(svgElement("text", { x: left - 6, y: y + 4, "text-anchor": "end" }, tickText(value)));
    }
    this.svg.append(svgElement("rect", { class: "frame", x: left, y: top, width, height }));
    this.svg.append(svgElement("text", { class: "label", x: left + width / 2, y: bottom + 35, "text-anchor": "middle" }, this.xLabel));
    const middle = top + height / 2;
    this.svg.append(svgElement("text", { class: "label", x: 14, y: middle, "text-anchor": "middle", transform: `rotate(-90 14 ${middle})` }, this.yLabel));
  }

  drawSeries({ x, y, colour, style, steps, dots }) {
    let path = "";
    let pen = "M";
    x.forEach((value, place) => {
      const isDrawn = Number.isFinite(value) && Number.isFinite(y[place]) && (!this.logarithmic || y[place] > 0);
      if (isDrawn) path += `${pen}${this.x(value).toFixed(2)} ${this.y(y[place]).toFixed(2)}`;
      pen = isDrawn ? "L" : "M";
    });
    this.svg.append(svgElement("path", { class: `curve colour-${colour} ${style ?? ""}`, d: path }));
    const few = steps && steps.length <= 80;
    if (!few && !dots) return;
    for (const place of steps ?? x.keys()) {
      if (!(place >= 0) || !Number.isFinite(y[place]) || (this.logarithmic && !(y[place] > 0))) continue;
      this.svg.append(svgElement("circle", { class: `dot colour-${colour}`, cx: this.x(x[place]), cy: this.y(y[place]), r: 2.2 }));
    }
  }

  legend() {
    const list = document.createElement("p");
    list.className = "series";
    for (const { label, colour, style } of this.series) {
      const item = document.createElement("span");
      item.className = `colour-${colour} ${style ?? ""}`;
      item.textContent = label;
      list.append(item);
    }
    return list;
  }

  // Buttons that save the chart as a picture, or its numbers.
  exports() {
    const row = document.createElement("p");
    row.className = "exports";
    const name = this.title.toLowerCase().replaceAll(" ", "-");
    const kinds = {
      SVG: () => save(this.picture(), `${name}.svg`),
      PNG: () => this.savePixels(`${name}.png`),
      CSV: () => save(`data:text/csv;charset=utf-8,${encodeURIComponent(this.table())}`, `${name}.csv`),
    };
    for (const [kind, saves] of Object.entries(kinds)) {
      const button = document.createElement("button");
      Object.assign(button, { type: "button", textContent: kind, title: `Save: ${this.title} (${kind})` });
      button.addEventListener("click", saves);
      row.append(button);
    }
    return row;
  }

  // The chart as an address of an SVG file with its colours, and names of its curves below.
  picture() {
    const copy = this.svg.cloneNode(true);
    const shapes = [...this.svg.querySelectorAll("*")];
    const kept = ["fill", "stroke", "stroke-width", "stroke-dasharray", "stroke-opacity", "font-size", "visibility"];
    [...copy.querySelectorAll("*")].forEach((it, place) => {
      const style = getComputedStyle(shapes[place]);
      it.setAttribute("style", kept.map((key) => `${key}:${style.getPropertyValue(key)}`).join(";"));
    });
    copy.querySelector(".mark")?.remove();
    const names = this.series.length > 1 ? this.series : [];
    const height = CHART.height + 16 * names.length;
    names.forEach(({ label, colour }, place) => {
      const y = CHART.height + 16 * place + 6;
      const stroke = getComputedStyle(document.documentElement).getPropertyValue(`--c${colour}`);
      copy.append(svgElement("line", { x1: CHART.left, x2: CHART.left + 18, y1: y - 4, y2: y - 4, style: `stroke:${resolved(stroke)};stroke-width:2` }));
      copy.append(svgElement("text", { x: CHART.left + 24, y, style: `fill:${getComputedStyle(this.svg).color};font-size:11.5px` }, label));
    });
    const paper = getComputedStyle(this.parent.closest(".card")).backgroundColor;
    copy.prepend(svgElement("rect", { width: CHART.width, height, style: `fill:${paper}` }));
    const sizes = { xmlns: SVG, viewBox: `0 0 ${CHART.width} ${height}`, width: 2 * CHART.width, height: 2 * height, "font-family": "sans-serif" };
    for (const [key, value] of Object.entries(sizes)) copy.setAttribute(key, value);
    return `data:image/svg+xml;charset=utf-8,${encodeURIComponent(copy.outerHTML)}`;
  }

  async savePixels(name) {
    const image = new Image();
    image.src = this.picture();
    await image.decode();
    const canvas = Object.assign(document.createElement("canvas"), { width: 2 * image.width, height: 2 * image.height });
    canvas.getContext("2d").drawImage(image, 0, 0, canvas.width, canvas.height);
    save(canvas.toDataURL("image/png"), name);
  }

  // The numbers of all curves, with a header.
  table() {
    const quoted = (text) => `"${text.replaceAll('"', '""')}"`;
    const header = ["curve", this.xLabel, this.yLabel].map(quoted).join(",");
    const rows = this.series.flatMap(({ label, x, y }) => Array.from(x, (it, place) => `${quoted(label)},${it},${y[place]}`));
    return `${[header, ...rows].join("\n")}\n`;
  }

  // Moves the mark to a point of a series.
  markAt(place, series = 0) {
    if (!this.mark) return;
    const of = this.series[series];
    const [x, y] = [of?.x[place], of?.y[place]];
    const isThere = Number.isFinite(x) && Number.isFinite(y) && (!this.logarithmic || y > 0);
    this.mark.setAttribute("visibility", isThere ? "visible" : "hidden");
    if (!isThere) return;
    const [line, circle] = this.mark.children;
    line.setAttribute("x1", this.x(x));
    line.setAttribute("x2", this.x(x));
    circle.setAttribute("cx", this.x(x));
    circle.setAttribute("cy", this.y(y));
  }

  // A press, or a drag, picks the nearest point of the curves that has a step.
  listen() {
    const picked = (event) => {
      const box = this.svg.getBoundingClientRect();
      const [px, py] = [
        ((event.clientX - box.left) / box.width) * CHART.width,
        ((event.clientY - box.top) / box.height) * CHART.height,
      ];
      let nearest = { distance: Infinity };
      this.series.forEach((series, number) => {
        for (const place of series.steps ?? []) {
          const distance = Math.hypot(this.x(series.x[place]) - px, this.y(series.y[place]) - py);
          if (distance < nearest.distance) nearest = { distance, place, number };
        }
      });
      if (nearest.distance < Infinity) this.pick(nearest.number, nearest.place);
    };
    this.svg.classList.add("pickable");
    this.svg.addEventListener("pointerdown", picked);
    this.svg.addEventListener("pointermove", (event) => event.buttons === 1 && picked(event));
  }
}

// Gives a file to the reader.
function save(address, name) {
  const link = document.createElement("a");
  Object.assign(link, { href: address, download: name.replaceAll(/[^\w.-]+/g, "-") });
  link.click();
  document.documentElement.dataset.saved = link.download;
}

// A colour of the style as the browser computes it.
function resolved(colour) {
  const probe = document.createElement("span");
  probe.style.color = colour;
  document.body.append(probe);
  const found = getComputedStyle(probe).color;
  probe.remove();
  return found;
}

// Powers of ten between powers of ten; of few also twice and five times them.
function logarithmicTicks(low, high) {
  const decades = ticks(Math.ceil(low), Math.floor(high), 5).filter((it) => Number.isInteger(it) && it >= low && it <= high);
  if (decades.length > 2) return decades.map((it) => Number(`1e${it}`));
  const found = [];
  for (let decade = Math.floor(low); decade <= high; decade++) {
    for (const digit of [1, 2, 5]) found.push(Number(`${digit}e${decade}`));
  }
  return found.filter((it) => Math.log10(it) >= low && Math.log10(it) <= high);
}

function tickText(value) {
  const size = Math.abs(value);
  if (size !== 0 && (size >= 1e5 || size < 1e-3)) return minus(value.toExponential().replace("e+", "e"));
  return minus(String(value));
}

// The range of values, a little wider; of one value a range about it.
function wider(values) {
  let [low, high] = [Infinity, -Infinity];
  for (const value of values) {
    if (value < low) low = value;
    if (value > high) high = value;
  }
  if (low === high) return low === 0 ? [-1, 1] : [Math.min(0, 1.1 * low), Math.max(0, 1.1 * high)];
  const margin = 0.04 * (high - low);
  // A curve from nothing starts on the axis.
  return [low === 0 ? 0 : low - margin, high + margin];
}
