// The playground: bodies, sliders, case, and what is done with them.

const USUAL_BODY = BODIES[0];
// A pause in typing after which the case is checked, ms.
const PAUSE = 900;
const CASE = "case.toml";
const PROGRESS = /step (\d+) of (\d+)/g;
const PLACE_OF_ERROR = /^error: (?:\S*?\/)?case\.toml:(\d+):(\d+): ([\s\S]*)/m;

class Playground {
  constructor() {
    this.cases = JSON.parse(element("cases").textContent);
    this.program = new Program();
    this.editor = new Editor(element("case"), () => this.edited());
    this.task = null;
    this.order = 0;
    this.meshes = new Map();
    this.page = null;
    this.listen();
    this.offerBodies();
    const asked = new URLSearchParams(location.search).get("body") ?? location.hash.slice(1);
    this.choose(BODIES.find((it) => it.id === asked) ?? USUAL_BODY);
  }

  async start() {
    const begun = performance.now();
    try {
      await this.program.compile();
    } catch (error) {
      this.tell(`This browser cannot run the program: ${error.message}`);
      return;
    }
    document.documentElement.dataset.compiled = Math.round(performance.now() - begun);
    element("start").disabled = false;
    document.documentElement.dataset.started = Math.round(performance.now());
    await this.run();
  }

  listen() {
    element("start").addEventListener("click", () => this.run());
    element("stop").addEventListener("click", () => this.stop());
    element("check").addEventListener("click", () => this.check());
    element("restore").addEventListener("click", () => this.choose(this.body));
    element("mesh").addEventListener("change", (event) => this.take(event.target.files[0]));
    element("save-case").addEventListener("click", () => this.save(new Blob([this.editor.text], { type: "application/toml" }), CASE));
    element("save-page").addEventListener("click", () => this.save(new Blob([this.ended.page], { type: "text/html" }), "report.html"));
    element("save-results").addEventListener("click", async () => this.save(await archive(await this.allFiles()), "results.zip"));
    this.listenToDrops();
  }

  listenToDrops() {
    const isFile = (event) => event.dataTransfer?.types.includes("Files") && !event.target.closest?.("#curve-card");
    window.addEventListener("dragover", (event) => {
      if (!isFile(event)) return;
      event.preventDefault();
      element("drop").hidden = false;
    });
    window.addEventListener("dragleave", (event) => { element("drop").hidden ||= event.relatedTarget === null; });
    window.addEventListener("drop", (event) => {
      element("drop").hidden = true;
      if (!isFile(event)) return;
      event.preventDefault();
      this.take(event.dataTransfer.files[0]);
    });
  }

  offerBodies() {
    const buttons = BODIES.map((body) => {
      const button = document.createElement("button");
      Object.assign(button, { type: "button", className: "choice", innerHTML: `<svg viewBox="0 0 48 48" aria-hidden="true">${body.picture}</svg><span>${body.name}</span>` });
      button.dataset.body = body.id;
      button.addEventListener("click", () => {
        this.choose(body);
        this.run();
      });
      return button;
    });
    document.querySelector(".bodies").replaceChildren(...buttons);
  }

  // Shows the case of a body.
  choose(body) {
    this.body = body;
    for (const button of document.querySelectorAll(".choice")) button.setAttribute("aria-pressed", button.dataset.body === body?.id);
    if (!body) return;
    // So that the address leads here again.
    location.replace(`#${body.id}`);
    element("about").textContent = body.about;
    this.editor.text = this.cases[body.id].text;
    this.edited(false);
  }

  // Sliders follow the case, and it is checked after a pause.
  edited(checks = true) {
    this.showError(null);
    this.offerSliders();
    clearTimeout(this.pause);
    if (checks && !this.task) this.pause = setTimeout(() => this.check(), PAUSE);
  }

  offerSliders() {
    const sliders = (this.body ?? USUAL_BODY).sliders.map((it) => ({ ...it, place: placeOfKey(this.editor.text, it.key) }));
    element("sliders").replaceChildren(...sliders.filter((it) => it.place).map((it) => this.slider(it)));
  }

  slider({ key, name, low, high, step, factor, unit, place }) {
    const label = document.createElement("label");
    label.className = "slider";
    const value = place.value / factor;
    const shown = (number) => `${Number(number.toPrecision(3))} ${unit}`;
    const range = Object.assign(document.createElement("input"), { type: "range", min: Math.min(low, value), max: Math.max(high, value), step, value });
    const text = document.createElement("output");
    text.textContent = shown(value);
    label.append(Object.assign(document.createElement("span"), { textContent: name }), text, range);
    range.dataset.key = key;
    range.addEventListener("input", () => {
      text.textContent = shown(range.valueAsNumber);
      this.setKey(key, range.valueAsNumber * factor);
    });
    return label;
  }

  // Writes a value into the case.
  setKey(key, value) {
    const { text } = this.editor;
    const place = placeOfKey(text, key);
    if (!place) return;
    this.editor.text = text.slice(0, place.from) + numberOfCase(value) + text.slice(place.to);
    this.showError(null);
  }

  // The files of a case: itself, and the meshes it may name.
  async files() {
    const files = [{ path: CASE, bytes: new TextEncoder().encode(this.editor.text) }];
    for (const script of document.querySelectorAll("script[data-mesh]")) {
      if (this.editor.text.includes(script.dataset.mesh)) files.push({ path: script.dataset.mesh, bytes: await unzipped(bytesOf(script.id)) });
    }
    for (const [path, bytes] of this.meshes) files.push({ path, bytes });
    return files;
  }

  // Begins a task once the one before it has stopped.
  async begin(task, tells) {
    this.stop();
    clearTimeout(this.pause);
    const { order } = this;
    const files = await this.files();
    if (order !== this.order) return null;
    const begun = this.program.begin({ ...task, files }, tells);
    this.task = begun;
    const ended = await begun.ended.catch((error) => ({ code: 70, said: `error: ${error.message}` }));
    if (this.task !== begun) return null;
    this.task = null;
    return ended;
  }

  // Also of a task that has not begun yet.
  stop() {
    this.order++;
    this.task?.stop();
  }

  async run() {
    const { dataset } = document.documentElement;
    dataset.state = "running";
    Object.assign(this, { said: "", ended: null, begun: performance.now(), isFirst: true });
    element("results").hidden = true;
    this.showError(null);
    this.tell("The bonds are searched …");
    element("progress").hidden = false;
    element("progress").removeAttribute("value");
    this.page?.begin();
    this.taking = Promise.resolve();
    this.rows = "";
    const { begun } = this;
    element("stop").hidden = false;
    const ended = await this.begin({ path: CASE }, (told) => this.hear(told));
    // Another run may have begun.
    if (begun !== this.begun) return;
    element("stop").hidden = true;
    element("progress").hidden = true;
    if (ended) {
      await this.finish(ended);
      return;
    }
    this.tell(`Stopped after ${this.seconds()} s. What is shown is what was found so far.`);
    dataset.state = "stopped";
  }

  seconds() {
    return ((performance.now() - this.begun) / 1000).toFixed(1);
  }

  // What a run tells while it is under way.
  hear({ said, broken, page }) {
    if (said) this.follow(said);
    if (broken && this.isFirst) {
      // The first row has the names of the columns.
      this.isFirst = broken.trimEnd().split("\n").length < 2 && !this.rows;
      if (!this.isFirst) document.documentElement.dataset.cracked = Math.round(performance.now() - this.begun);
    }
    if (broken) {
      this.rows += broken;
      this.page?.break(broken);
    }
    if (page) this.show(page, false);
  }

  // Progress, from what the program says of it.
  follow(said) {
    this.said += said;
    const last = [...said.matchAll(PROGRESS)].pop();
    if (last) element("progress").value = Number(last[1]) / Number(last[2]);
    this.tell(`${this.seconds()} s: ${this.said.trimEnd().split("\n").pop()}`);
  }

  // Results so far, or all of them. Of several that come while one is being read only the last is shown.
  show(html, end) {
    this.latest = { html, end, begun: this.begun };
    this.taking = this.taking.then(async () => {
      const latest = this.latest;
      this.latest = null;
      if (!latest || latest.begun !== this.begun) return;
      const { description, summary } = readPage(latest.html);
      if (!this.page) {
        element("waiting").hidden = true;
        element("result").classList.add("shown");
        this.page = new LivePage(description);
        this.page.break(this.rows);
        await this.page.start();
      }
      await this.page.take(description, latest.end);
      document.documentElement.dataset.shown ??= Math.round(performance.now());
      if (!latest.end) return;
      element("summaries").replaceChildren(...(summary ? [document.importNode(summary, true)] : []));
    }).catch((error) => console.error(error));
    return this.taking;
  }

  async finish(ended) {
    const { dataset } = document.documentElement;
    this.ended = ended;
    element("said").textContent = ended.said;
    this.showError(ended.said);
    const isError = ended.code === 1 || ended.code === 2 || ended.code > 6;
    if (ended.page) {
      await this.show(ended.page, true);
      element("results").hidden = false;
      element("save-page").hidden = false;
    }
    const because = /ended because +(.*)/.exec(ended.said)?.[1];
    if (isError) this.tell("Not run: see the error.");
    else this.tell(`${ended.seconds.toFixed(1)} s${because ? `: ${because}` : ""}.`);
    dataset.state = isError ? "refused" : "done";
    dataset.seconds = ended.seconds;
  }

  // Tells what the program finds wrong in the case.
  async check() {
    if (document.documentElement.dataset.state === "running") return;
    document.documentElement.dataset.checked = "";
    const ended = await this.begin({ words: ["check", CASE] });
    if (!ended) return;
    this.showError(ended.said);
    if (ended.code === 0) element("said").textContent = ended.said;
    document.documentElement.dataset.checked = ended.code;
  }

  // The first error that the program words, with the line of the case.
  showError(said) {
    const box = element("wrong");
    const found = said && /^error: .*/m.exec(said);
    box.hidden = !found;
    if (!found) return this.editor.mark(null);
    const place = PLACE_OF_ERROR.exec(said);
    if (!place) {
      box.textContent = said.slice(found.index + "error: ".length).trim();
      return this.editor.mark(null);
    }
    const where = Object.assign(document.createElement("b"), { textContent: `Line ${place[1]}: ` });
    box.replaceChildren(where, place[3].trim());
    return this.editor.mark(Number(place[1]), Number(place[2]));
  }

  // A mesh of the reader: the program writes a case for it.
  async take(file) {
    if (!file) return;
    const name = file.name.replaceAll(/[^\w.-]+/g, "-");
    this.stop();
    this.meshes = new Map([[name, new Uint8Array(await file.arrayBuffer())]]);
    const ended = await this.begin({ words: ["new", name, "--force"], asks: CASE });
    if (!ended) return;
    if (ended.code !== 0) {
      this.meshes.clear();
      this.showError(ended.said);
      return;
    }
    this.choose(null);
    element("about").textContent = `${file.name}: ${ended.said.trim().split("\n")[0].replace(/^wrote case\.toml: /, "")}. Material and load are examples.`;
    this.editor.text = ended.written;
    this.edited(false);
    await this.run();
  }

  async allFiles() {
    const inputs = (await this.files()).map(({ path, bytes }) => ({ name: path, bytes }));
    return [...inputs, ...this.ended.results.map(({ name, bytes }) => ({ name: `results/${name}`, bytes }))];
  }

  save(blob, name) {
    const address = URL.createObjectURL(blob);
    save(address, name);
    setTimeout(() => URL.revokeObjectURL(address), 10000);
  }

  tell(text) {
    element("status").textContent = text;
  }
}

// A number as a case has it: a fraction or an exponent, since a whole number is no length.
function numberOfCase(value) {
  const rounded = Number(value.toPrecision(6));
  const size = Math.abs(rounded);
  const text = size !== 0 && (size >= 1e4 || size < 1e-2) ? rounded.toExponential().replace("e+", "e") : String(rounded);
  return /[.e]/.test(text) ? text : `${text}.0`;
}

const playground = new Playground();
document.addEventListener("DOMContentLoaded", () => playground.start());
