// A second result beside the shown one in the plane, and the difference of both at the points of the coarser one.

// Share of the differences that are within the ends of the colours.
const WITHIN = 0.98;

class Comparison {
  constructor(runs) {
    this.runs = runs;
    // The compared result, and the one before it was taken away.
    this.chosen = null;
    this.before = null;
    this.isDifference = false;
    this.found = {};
  }

  // Whether two results can be compared: both in the plane, and both of steps or of modes.
  isAlike(one, other) {
    return !one.isSolid && !other.isSolid && one.isModes === other.isModes;
  }

  // The compared result beside a shown one, or null.
  beside(run) {
    return this.chosen && this.isAlike(run, this.chosen) ? this.chosen : null;
  }

  // The controls beside a shown result.
  offer(run) {
    const alike = this.runs.filter((it) => this.isAlike(run, it));
    const isOffered = alike.length > 1;
    const select = element("compared");
    options(select, [["", "none"], ...alike.map((it) => [this.runs.indexOf(it), it.label])]);
    for (const option of select.options) option.disabled = option.value === String(this.runs.indexOf(run));
    select.value = this.beside(run) ? this.runs.indexOf(this.chosen) : "";
    select.closest("label").hidden = !isOffered;
    element("comparing-keys").hidden = !isOffered;
    // The sign of a mode is arbitrary.
    element("view").closest("label").hidden = !this.beside(run) || run.isModes;
    if (run.isModes) this.isDifference = false;
    element("view").value = this.isDifference ? "difference" : "both";
  }

  choose(run) {
    this.before = this.chosen ?? this.before;
    this.chosen = run;
  }

  // The result to compare with when none is named: the one of before, or the next.
  usual(run) {
    const alike = this.runs.filter((it) => it !== run && this.isAlike(run, it));
    return alike.find((it) => it === this.before) ?? alike.find((it) => this.runs.indexOf(it) > this.runs.indexOf(run)) ?? alike[0] ?? null;
  }

  // Two panes, the one with fewer points first; of as many points the first result of the page.
  coarserFirst([one, other]) {
    const isFirst = one.run.nPoints - other.run.nPoints || this.runs.indexOf(one.run) - this.runs.indexOf(other.run);
    return isFirst <= 0 ? [one, other] : [other, one];
  }

  // The field of the finer pane less that of the coarser one at the points of the coarser, NaN outside of the finer body; how many are outside.
  difference(panes) {
    const [coarse, fine] = this.coarserFirst(panes);
    if (this.found.coarse !== coarse.body || this.found.fine !== fine.body) {
      const weights = Array.from(coarse.body.x, (x, point) => fine.weights(x, coarse.body.y[point]));
      this.found = { coarse: coarse.body, fine: fine.body, weights, outside: weights.filter((it) => !it).length };
    }
    const { weights, outside } = this.found;
    const fields = fine.fields.map(() => new Float64Array(coarse.run.nPoints).fill(NaN));
    weights.forEach((own, point) => interpolated(fine.fields, own)?.forEach((value, place) => { fields[place][point] = value; }));
    const values = lengths(fields).map((it, point) => it - coarse.values[point]);
    return { values, outside, coarse };
  }

  // The values of two panes at a pointed place as a table: rows of a name, a value and a horizon.
  rows(panes, seen, pointed) {
    const names = panes.map((pane) => {
      const { tags, tagged } = pane.body;
      return `${pane.run.label}, ${pane === pointed.pane ? `${tagged} ${tags[pointed.point]}` : "same place"}`;
    });
    const rows = panes.map((pane, place) => {
      const horizon = seen[place] && pane.horizons ? shortText(1e3 * pane.horizons[seen[place].point], 3) : "";
      return [names[place], seen[place] ? textTo(seen[place].value, pane.exponent) : "outside", horizon];
    });
    const [coarse, fine] = this.coarserFirst(panes).map((pane) => seen[panes.indexOf(pane)]);
    if (coarse && fine && !panes[0].run.isModes) rows.push(["finer less coarser", textTo(fine.value - coarse.value, Math.max(...panes.map((it) => it.exponent))), ""]);
    return rows;
  }
}

// The range of colours of differences: even about zero, with all but few of those that are not zero.
function differenceRange(values) {
  const sizes = Float64Array.from(values, Math.abs).filter((it) => it > 0 && Number.isFinite(it)).sort();
  const size = sizes[Math.ceil(WITHIN * sizes.length) - 1] ?? 1;
  return { low: -size, high: size, map: "diverging" };
}

// The state of a result in words, with the share of its largest force.
function stateText(run, step) {
  const words = run.whenAt(step);
  if (!run.loads) return words;
  const forces = run.history.get("reaction").values;
  const largest = Math.max(...forces);
  const isAfter = run.axis.ofSteps[step] > run.history.get("step").values[forces.indexOf(largest)];
  return `${words}, ${Math.round((100 * run.valueAt("reaction", step)) / largest)} % of its largest force${isAfter ? ", after it" : ""}`;
}
