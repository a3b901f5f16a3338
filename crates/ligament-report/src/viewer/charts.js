// The curves of the page, all linked to the step that is seen.

const ENERGIES = ["external_work", "stored_energy", "released_energy", "dissipated_energy"];

class Charts {
  // `go` is called with the number of a run and the place of a step.
  constructor(runs, go) {
    this.runs = runs;
    this.go = go;
    const chart = (id, title) => new Chart(document.getElementById(id), title);
    this.curve = chart("curve", "Force over displacement");
    this.energies = chart("energies", "Energies over the steps");
    this.broken = chart("broken", "Broken bonds over the steps");
    this.convergence = chart("convergence", "Last residual of each step");
    this.iterations = chart("iterations", "Iterations over the steps");
    this.showCurve();
  }

  showCurve() {
    const [first] = this.runs;
    const [x, y] = first.isModes ? ["step", "frequency"] : ["displacement", "reaction"];
    if (first.isModes) document.getElementById("curve-title").textContent = "Frequencies";
    const shown = first.history.get(x);
    const force = first.history.get(y);
    if (!shown || !force) return this.curve.show({ series: [] });
    // Curves of all results have the units of the first.
    const series = this.runs.map((run, number) => ({
      label: run.label,
      colour: (number % 8) + 1,
      x: valuesIn(run.history.get(x), shown.shift),
      y: valuesIn(run.history.get(y), force.shift),
      steps: run.rows,
      dots: run.isModes,
    }));
    return this.curve.show({
      series,
      xLabel: first.isModes ? "mode" : labelWithUnit(inWords(x), shown.unit),
      yLabel: labelWithUnit(first.isModes ? y : "force", force.unit),
      pick: (number, place) => this.go(number, this.runs[number].rows.indexOf(place)),
    });
  }

  // The curves of one run.
  showRun(run) {
    const number = this.runs.indexOf(run);
    const steps = run.history.get("step")?.values ?? [];
    const pick = (_, place) => this.go(number, run.rows.indexOf(place));
    const over = (names, shift) => names.filter((name) => run.history.has(name)).map((name, place) => ({
      label: inWords(name),
      colour: place + 1,
      x: steps,
      y: valuesIn(run.history.get(name), shift ?? run.history.get(name).shift),
      steps: run.rows,
    }));
    const xLabel = "step";
    const energy = run.history.get(ENERGIES[0]);
    const isStatic = steps.length < 2 || run.isModes;
    const energies = isStatic ? [] : over(ENERGIES.filter((it) => run.history.get(it)?.values.some((value) => value !== 0)), energy?.shift);
    this.energies.show({ series: energies, xLabel, yLabel: labelWithUnit("energy", energy?.unit), pick });
    const broken = isStatic ? [] : over(["broken_bonds", "broken_in_step"]);
    this.broken.show({ series: broken, xLabel, yLabel: "bonds", pick });
    const residuals = isStatic ? [] : over(["residual"], 0);
    this.convergence.show({ series: residuals, xLabel, yLabel: "last residual", logarithmic: true, pick });
    const iterations = isStatic ? [] : over(["iterations", "rounds"]);
    this.iterations.show({ series: iterations, xLabel, yLabel: "in a step", pick });
    for (const chart of this.ofSteps) chart.parent.closest("section").hidden = chart.series.length === 0;
  }

  get ofSteps() {
    return [this.energies, this.broken, this.convergence, this.iterations];
  }

  mark(run, step) {
    const row = run.rows[step];
    this.curve.markAt(row, this.runs.indexOf(run));
    for (const chart of this.ofSteps) chart.markAt(row);
  }
}

// Values of a column of the history, in a unit that is 10^-shift of the SI unit.
function valuesIn(column, shift) {
  return (column?.values ?? []).map((value) => value * 10 ** shift);
}
