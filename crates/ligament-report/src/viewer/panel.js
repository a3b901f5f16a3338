// What is known of the point under the pointer, of its bonds, and how its field went over the steps.

const ABSENT = ["", "none: cut by a pre-crack", "none: a hole or notch lies between"];

class Panel {
  constructor() {
    this.values = document.getElementById("point-values");
    this.compared = document.getElementById("compared-values");
    this.bondValues = document.getElementById("bond-values");
    this.history = new Chart(document.getElementById("point-history"), "The field at the point over the steps");
    this.asked = 0;
    this.clear();
  }

  clear() {
    this.asked++;
    this.values.replaceChildren(note("Point at the body, or press Enter on it for the point in the middle."));
    this.history.parent.replaceChildren();
    this.showCompared([]);
    this.bondValues.replaceChildren();
  }

  // Fields of a point in a step. What is not read yet follows.
  async showPoint(run, body, point, step, choice) {
    const asked = ++this.asked;
    const fields = [choice.field, ...run.fields.filter((it) => it !== choice.field)];
    const isMain = (field) => field === choice.field || field.isMain;
    const write = () => {
      const rows = (chosen) => chosen.flatMap((field) => rowsOfField(field, point, step));
      const more = document.createElement("details");
      more.open = this.isOpen ?? false;
      more.addEventListener("toggle", () => { this.isOpen = more.open; });
      const summary = document.createElement("summary");
      summary.textContent = "More of this point";
      more.append(summary, table(rows(fields.filter((it) => !isMain(it)))));
      this.values.replaceChildren(table([pointRow(body, point), ...rows(fields.filter(isMain))]), more);
    };
    write();
    await this.showHistory(run, point, step, choice, asked);
    // A pointer that moves on asks for the next point before everything is read.
    await new Promise((done) => { setTimeout(done, 120); });
    if (asked !== this.asked) return;
    await Promise.all(fields.flatMap((field) => field.columns.map((column) => column.multiples(step))));
    if (asked !== this.asked) return;
    write();
    this.values.dataset.whole = `${point} ${step}`;
  }

  // Values of two results at a place: rows of texts under their heads; without rows nothing.
  showCompared([heads, ...rows]) {
    this.compared.replaceChildren();
    if (!heads) return;
    const list = document.createElement("table");
    const add = (body, kinds, texts) => {
      const row = body.insertRow();
      texts.forEach((it, place) => row.append(cell(kinds[place], it)));
    };
    add(list.createTHead(), heads.map(() => "th"), heads);
    const body = list.createTBody();
    for (const row of rows) add(body, ["th", "td", "td"], row);
    this.compared.append(list);
  }

  async showHistory(run, point, step, choice, asked) {
    if (run.steps.length < 2) return;
    const y = await run.valuesOfPoint(choice, point);
    if (asked !== this.asked) return;
    const { ofSteps: x, label: xLabel } = run.axis;
    const series = [{ label: choice.label, colour: 1, x, y, steps: [...run.steps.keys()] }];
    this.history.show({ series, xLabel, yLabel: labelWithUnit(choice.label, choice.field.unit) });
    this.history.markAt(step);
  }

  // The bonds of a point in a table, those that broke first in their order, then those nearest to breaking.
  async showBonds(run, body, point, family, chosen, choose) {
    const columns = new Map(run.bonds.columns.map(({ name, column }) => [name, column]));
    await Promise.all([...columns.values()].map((column) => column.multiples(0)));
    const breaks = await run.bonds.breaks();
    const text = (name, bond, shift = 0) => {
      const column = columns.get(name);
      return column ? exactText(column.ready(0)[bond], column.exponents[0], shift) : "–";
    };
    const value = (name, bond) => columns.get(name)?.ready(0)[bond] ?? 0;
    const order = ({ bond }) => (breaks.order[bond] < 0 ? Infinity : breaks.order[bond]);
    const sorted = family.toSorted((one, other) => (order(one) - order(other) || 0)
      || value("utilisation", other.bond) - value("utilisation", one.bond));
    const list = document.createElement("table");
    list.className = "bonds";
    const head = list.createTHead().insertRow();
    for (const name of [`to ${body.tagged}`, "length (mm)", "largest", run.time ? "in row" : "in step", "fate"]) head.append(cell("th", name));
    const rows = list.createTBody();
    for (const { bond, other, length } of sorted) {
      const row = rows.insertRow();
      const fate = fateOf(breaks, bond, value("absent", bond));
      const cells = [body.tags[other], shortText(1e3 * length), text("utilisation", bond), text("step_of_largest", bond), fate];
      cells.forEach((it) => row.append(cell("td", it)));
      row.tabIndex = 0;
      row.dataset.bond = bond;
      row.classList.toggle("chosen", bond === chosen);
      for (const event of ["focus", "pointerenter"]) row.addEventListener(event, () => choose(bond));
    }
    const scroll = document.createElement("div");
    scroll.className = "scroll";
    scroll.append(list);
    this.bond = document.createElement("div");
    this.bond.id = "bond";
    const heading = document.createElement("h3");
    heading.textContent = `Bonds of ${body.tagged} ${body.tags[point]}`;
    this.bondValues.replaceChildren(heading, this.bond, scroll);
  }

  // What is known of a bond.
  async showBond(run, body, { bond, ends, length, along }) {
    if (!this.bond) return;
    const [breaks, properties] = await Promise.all([run.bonds.breaks(), run.bonds.properties(bond)]);
    const { tags, tagged } = body;
    const rows = [
      ["bond", `${tagged} ${tags[ends[0]]} to ${tagged} ${tags[ends[1]]}`],
      ["length", `${shortText(1e3 * length)} mm, ${directionOf(along, length, body.dimension)}`],
    ];
    const { criteria } = run.bonds;
    for (const [name, { multiple, exponent }] of properties) {
      if (name === "absent" || name === "utilisation" || name.endsWith("_of_largest")) continue;
      rows.push([inWords(name), exactText(multiple, exponent, 0)]);
    }
    const seen = properties.get("step_of_largest");
    const by = criteria[properties.get("criterion_of_largest")?.multiple];
    const largest = properties.get("utilisation");
    if (largest?.multiple > 0) rows.push(["largest utilisation", `${exactText(largest.multiple, largest.exponent, 0)} ${run.time ? "at" : "in"} ${run.when(seen?.multiple)}, by ${by}`]);
    rows.push(["fate", fateOf(breaks, bond, properties.get("absent")?.multiple ?? 0)]);
    const order = breaks.order[bond];
    if (order >= 0) {
      const [step, round] = [breaks.step[order], breaks.round[order]];
      const limit = `${shortText(breaks.utilisation[order], 5)} of the limit at which it breaks`;
      const when = run.time ? `by ${run.when(step)}, in time step ${round}` : `in step ${step}, round ${round}`;
      rows.push(["broke", `${when}, by ${criteria[breaks.criterion[order]]}, at ${limit}; ${breaks.step.length} broke in all`]);
    }
    this.bond.replaceChildren(table(rows));
    for (const row of this.bondValues.querySelectorAll("tbody tr[data-bond]")) row.classList.toggle("chosen", Number(row.dataset.bond) === bond);
  }
}

// The direction of a bond: its angle in the plane, or a unit vector.
function directionOf(along, length, dimension) {
  if (dimension === 2) return `${((Math.atan2(along[1], along[0]) * 180) / Math.PI).toFixed(2)}° from x`;
  return `along (${along.map((it) => minus((it / length).toFixed(3))).join(", ")})`;
}

// What became of a bond, in a few words.
function fateOf(breaks, bond, absent) {
  if (absent > 0) return ABSENT[absent] ?? "none";
  const order = breaks.order[bond];
  return order < 0 ? "intact" : `broke, number ${order + 1}`;
}

// The components of a field at a point; dots where they are not read yet.
function rowsOfField(field, point, step) {
  return field.columns.map((column, place) => {
    const name = [field.name, field.components[place]].filter(Boolean).join(".");
    const multiples = column.ready(step);
    const text = multiples ? exactText(multiples[point], column.exponents[step], field.shift) : "…";
    return [inWords(name), withUnit(text, field.unit), name];
  });
}

function pointRow(body, point) {
  const mm = (column) => exactText(column.ready(0)[point], column.exponents[0], 3);
  return [`${body.tagged} ${body.tags[point]}`, `(${body.positionColumns.map(mm).join(", ")}) mm`, "tag"];
}

// A table of names with what they are; the third of a row names it for programs.
function table(rows) {
  const element = document.createElement("table");
  element.className = "facts";
  for (const [name, text, key] of rows) {
    const row = element.insertRow();
    row.append(cell("th", name), cell("td", text));
    row.firstChild.scope = "row";
    if (key) row.dataset.key = key;
  }
  return element;
}

function cell(kind, text) {
  const element = document.createElement(kind);
  element.textContent = text;
  return element;
}

function note(text) {
  const element = document.createElement("p");
  element.className = "note";
  element.textContent = text;
  return element;
}
