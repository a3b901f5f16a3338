// The curves of the page, all linked to the step that is seen.

const ENERGIES = ["external_work", "stored_energy", "released_energy", "dissipated_energy", "kinetic_energy", "damping_energy", "contact_energy", "friction_energy", "initial_energy"];

// Share of the largest energy of a motion below which none is seen beside it.
const SEEN = 1e-3;

class Charts {
  // `go` is called with the number of a run and the place of a step.
  constructor(runs, measured, go) {
    this.runs = runs;
    this.go = go;
    this.run = runs[0];
    this.measured = [];
    // Numbers of the runs whose curves are shown.
    this.shownRuns = [];
    const chart = (id, title) => new Chart(document.getElementById(id), title);
    this.curve = chart("curve", "Force over displacement");
    this.size = chart("size", "Size of the cracks");
    this.speed = chart("speed", "Growth of the cracks over the time");
    this.probes = chart("probes", "Probes over the steps");
    this.spent = chart("spent", "Energy spent on the cracks");
    this.energies = chart("energies", "Energies over the steps");
    this.broken = chart("broken", "Broken bonds over the steps");
    this.convergence = chart("convergence", "Last residual of each step");
    this.iterations = chart("iterations", "Iterations over the steps");
    this.probed = document.getElementById("probed");
    this.probed.addEventListener("change", () => this.showProbes(this.run));
    this.over = document.getElementById("over");
    this.over.addEventListener("change", () => this.showCurve());
    this.offer();
    for (const curve of measured) this.add(() => measuredCurve(curve));
    this.listen();
    this.showCurve();
  }

  // What the force can be drawn over: the time of a motion, the displacement, and motions that were probed.
  offer() {
    const [first] = this.runs;
    const time = first.time ? [first.time] : [];
    const columns = [...time, ...[...first.history.values()].filter((it) => it.name === "displacement" || it.isProbe)];
    this.columns = columns.map((it) => ({ ...it, words: columnInWords(it) }));
    options(this.over, this.columns.map((it) => [it.name, it.words]));
    document.getElementById("over-label").hidden = this.columns.length < 2;
  }

  // Adds a measured curve, or tells what is wrong with it; shows what it was measured over.
  add(read) {
    const note = document.getElementById("measured-note");
    try {
      const curve = read();
      this.measured.push(curve);
      const column = this.columns.find((it) => isOfColumn(curve.x, it, this.columns));
      note.hidden = Boolean(column);
      note.textContent = `${curve.label}: ${curve.x.name} is none of ${this.columns.map((it) => it.name).join(", ")}, and has the unit of none of them.`;
      if (column) this.over.value = column.name;
    } catch (error) {
      note.hidden = false;
      note.textContent = error.message;
    }
  }

  // Files that are chosen, or dropped on the curve.
  listen() {
    const card = document.getElementById("curve-card");
    const take = async (files) => {
      for (const file of files) {
        const text = await file.text();
        this.add(() => parsedCurve(file.name.replace(/\.[^.]*$/, ""), text));
      }
      this.showCurve();
    };
    const input = document.getElementById("measured");
    input.addEventListener("change", () => take(input.files));
    card.addEventListener("dragover", (event) => event.preventDefault());
    card.addEventListener("drop", (event) => {
      event.preventDefault();
      take(event.dataTransfer.files);
    });
  }

  showCurve() {
    const [first] = this.runs;
    const [x, y] = first.isModes ? ["step", "frequency"] : [this.over.value, "reaction"];
    document.getElementById("curve-title").textContent = "Frequencies";
    document.querySelector("#curve-card .controls").hidden = first.isModes;
    const shown = first.history.get(x);
    const force = first.history.get(y);
    if (!shown || !force) return this.curve.show({ series: [] });
    const [along, up] = [columnInWords(shown), first.isModes ? y : columnInWords(force)];
    if (!first.isModes) document.getElementById("curve-title").textContent = `${up[0].toUpperCase()}${up.slice(1)} over ${along}`;
    // Curves of all results have the units of the first.
    const series = this.runs.filter((run) => run.history.has(x)).map((run) => {
      const number = this.runs.indexOf(run);
      return {
        label: run.label,
        colour: (number % 7) + 1,
        x: valuesIn(run.history.get(x), shown.shift),
        y: valuesIn(run.history.get(y), force.shift),
        steps: run.rows,
        style: run.description.beforeBreakages ? "thin" : null,
        dots: run.isModes,
        number,
      };
    });
    // The path between breakages is drawn thin, and over it what a test with a growing displacement measures.
    const envelopes = series.filter((it) => it.style === "thin").map((it) => ({ ...envelope(it), label: `${it.label}, envelope`, colour: it.colour }));
    const column = this.columns.find((it) => it.name === x);
    const measured = this.measured.filter((it) => isOfColumn(it.x, column, this.columns)).map((it) => ({
      label: it.label,
      colour: 8,
      x: it.x.values.map((value) => value * 10 ** shown.shift),
      y: it.y.values.map((value) => value * 10 ** force.shift),
      style: "dashed",
    }));
    this.shownRuns = series.map((it) => it.number);
    this.curve.show({
      series: [...series, ...envelopes, ...measured],
      xLabel: first.isModes ? "mode" : labelWithUnit(along, shown.unit),
      yLabel: labelWithUnit(up, force.unit),
      pick: (number, place) => this.go(this.shownRuns[number], this.runs[this.shownRuns[number]].rows.indexOf(place)),
    });
    if (this.marked) this.mark(...this.marked);
  }

  // The curves of one run.
  showRun(run) {
    this.run = run;
    const number = this.runs.indexOf(run);
    const { x, label: xLabel } = run.axis;
    const pick = (_, place) => this.go(number, run.rows.indexOf(place));
    const over = (names, shift) => names.filter((name) => run.history.has(name)).map((name, place) => ({
      label: inWords(name),
      colour: (place % 8) + 1,
      x,
      y: valuesIn(run.history.get(name), shift ?? run.history.get(name).shift),
      steps: run.rows,
    }));
    const energy = run.history.get(ENERGIES[0]);
    const isStatic = x.length < 2 || run.isModes;
    const sizes = new Map(ENERGIES.map((it) => [it, Math.max(0, ...(run.history.get(it)?.values ?? []).map(Math.abs))]));
    const least = run.time ? SEEN * Math.max(...sizes.values()) : 0;
    const energies = isStatic ? [] : over(ENERGIES.filter((it) => sizes.get(it) > least), energy?.shift);
    this.energies.show({ series: energies, xLabel, yLabel: labelWithUnit("energy", energy?.unit), pick });
    // A motion may have nothing that breaks and nothing that iterates.
    const told = (names) => names.filter((it) => !run.time || run.history.get(it)?.values.some((value) => value > 0));
    const broken = isStatic ? [] : over(told(["broken_bonds", "broken_in_step"]));
    this.broken.show({ series: broken, xLabel, yLabel: "bonds", pick });
    const residuals = isStatic ? [] : over(told(["residual"]), 0);
    this.convergence.show({ series: residuals, xLabel, yLabel: "last residual", logarithmic: true, pick });
    const iterations = isStatic ? [] : over(told(["iterations", "rounds"]));
    this.iterations.show({ series: iterations, xLabel, yLabel: "in a step", pick });
    const probes = isStatic ? [] : [...run.history.values()].filter((it) => it.isProbe);
    const units = [...new Set(probes.map((it) => it.si))];
    options(this.probed, units.map((unit) => [unit, probes.filter((it) => it.si === unit).map((it) => inWords(it.name)).join(", ")]));
    document.getElementById("probed-label").hidden = units.length < 2;
    this.showProbes(run);
    this.showSize(run, number);
    this.showSpeed(run, number);
    this.showSpent(run, number);
    for (const chart of [...this.ofSteps, ...this.ofCracks]) chart.parent.closest("section").hidden = chart.series.length === 0;
    document.getElementById("numerics").hidden = this.convergence.series.length + this.iterations.series.length === 0;
  }

  // Probes of one unit over the time.
  showProbes(run) {
    const probes = [...run.history.values()].filter((it) => it.isProbe && it.si === this.probed.value);
    const largest = Math.min(...probes.map((it) => it.shift));
    const { unit } = probes.find((it) => it.shift === largest) ?? {};
    const { x, label: xLabel } = run.axis;
    const series = probes.map((it, place) => ({ label: inWords(it.name), colour: (place % 8) + 1, x, y: valuesIn(it, largest), steps: run.rows }));
    this.probes.show({
      series, xLabel, yLabel: series.length === 1 ? labelWithUnit(series[0].label, unit) : unit ?? "",
      pick: (_, place) => this.go(this.runs.indexOf(run), run.rows.indexOf(place)),
    });
    if (this.marked) this.probes.markAt(this.marked[0].rows[this.marked[1]]);
  }

  // What the cracks grew from step to step of a motion, over the time between.
  showSpeed(run, number) {
    const isThere = run.size?.values.some((it) => it > 0) && run.time;
    const times = isThere ? run.rows.map((row) => run.time.values[row]) : [];
    const sizes = [...(run.size?.values ?? [])];
    // A broken bond stays broken: what later steps no longer have was no crack.
    for (let place = sizes.length - 1; place > 0; place--) sizes[place - 1] = Math.min(sizes[place - 1], sizes[place]);
    const y = times.map((time, place) => (place ? (sizes[place] - sizes[place - 1]) / (time - times[place - 1]) : NaN));
    const series = isThere ? [{ label: run.label, colour: 1, x: run.axis.ofSteps, y, steps: [...y.keys()] }] : [];
    this.speed.show({ series, xLabel: run.axis.label, yLabel: run.isSolid ? "area rate (m²/s)" : "speed (m/s)", pick: (_, place) => this.go(number, place) });
  }

  // Length or area of the cracks over the displacement, or the time of a motion.
  showSize(run, number) {
    const along = run.time ?? run.history.get("displacement");
    const isThere = run.size?.values.some((it) => it > 0) && along;
    const x = isThere && run.rows.map((_, place) => run.valueAt(along.name, place) * 10 ** along.shift);
    const series = isThere ? [{ label: run.label, colour: 1, x, y: valuesIn(run.size, run.size.shift), steps: [...x.keys()] }] : [];
    this.size.show({
      series, xLabel: labelWithUnit(inWords(along?.name ?? ""), along?.unit), yLabel: labelWithUnit(run.size?.name ?? "", run.size?.unit),
      pick: (_, place) => this.go(number, place),
    });
  }

  // Dissipated energy over the area of the cracks, and what the fracture energy makes of it.
  showSpent(run, number) {
    const energy = run.history.get("dissipated_energy");
    const areas = run.area?.values ?? [];
    const last = run.rows.findLastIndex((row) => row >= 0);
    const isThere = areas[last] > 0 && energy;
    const given = run.description.fractureEnergy;
    const text = document.getElementById("spent-note");
    text.textContent = "";
    const series = [];
    if (isThere) {
      const x = valuesIn(run.area, run.area.shift);
      const spent = run.rows.map((row) => energy.values[row]);
      series.push({ label: "spent by the bonds", colour: 1, x, y: spent.map((it) => it * 10 ** energy.shift), steps: [...x.keys()] });
      if (given) series.push({ label: "fracture energy × area", colour: 2, style: "dashed", x: [0, x[last]], y: [0, given * areas[last] * 10 ** energy.shift] });
      text.textContent = `At the end ${shortText(spent[last] / areas[last])} J/m² of new crack${given ? `; the fracture energy is ${shortText(given)} J/m²` : ""}.`;
      if (run.field("damage_tension") && run.description.firstField !== "damage") text.textContent += " Bonds that soften spend energy before the crack is open at them.";
    }
    this.spent.show({
      series, xLabel: labelWithUnit("crack area", run.area?.unit), yLabel: labelWithUnit("energy", energy?.unit), pick: (_, place) => this.go(number, place),
    });
  }

  get ofSteps() {
    return [this.energies, this.broken, this.probes, this.convergence, this.iterations];
  }

  get ofCracks() {
    return [this.size, this.speed, this.spent];
  }

  mark(run, step) {
    this.marked = [run, step];
    const row = run.rows[step];
    this.curve.markAt(row, this.shownRuns.indexOf(this.runs.indexOf(run)));
    for (const chart of this.ofSteps) chart.markAt(row);
    for (const chart of this.ofCracks) chart.markAt(step);
  }
}

// What a test measures whose displacement only grows: where the path turns back, the load drops to where the path comes by again.
function envelope({ x, y }) {
  const found = { x: [], y: [] };
  const add = (px, py) => {
    found.x.push(px);
    found.y.push(py);
  };
  let most = -Infinity;
  x.forEach((value, place) => {
    if (!(value >= most)) return;
    const before = place - 1;
    if (before >= 0 && x[before] < most) add(most, y[before] + ((most - x[before]) / (value - x[before])) * (y[place] - y[before]));
    add(value, y[place]);
    most = value;
  });
  return found;
}

// Values of a column of the history, in a unit that is 10^-shift of the SI unit.
function valuesIn(column, shift) {
  return (column?.values ?? []).map((value) => value * 10 ** shift);
}
