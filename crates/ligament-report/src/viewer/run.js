// A result: its body, its fields and bonds, read from the page as they are asked for.

class Run {
  constructor(description) {
    this.description = description;
    this.label = description.label;
    this.steps = description.steps;
    this.isModes = description.kind === "modes";
    const { body } = description;
    this.nPoints = body.count;
    this.isSolid = body.dimension === 3;
    this.fields = description.fields.map((field) => ({
      ...field,
      columns: field.columns.map((column) => new Column(column, body.count, field.magnitude)),
    }));
    this.choices = this.fields.flatMap(choicesOfField);
    this.history = new Map(description.history.map((column) => [column.name, column]));
    const rows = this.history.get("step")?.values ?? [];
    // Breakages of its step before each state of the page that lies between them, with its load, by the place of the state.
    this.between = description.between;
    // The row of the history of each step of the page; -1 between breakages.
    this.rows = this.steps.map((step, place) => (this.between[place] ? -1 : rows.indexOf(step)));
    // The time of each row of a motion; null in statics.
    this.time = description.inTime ? this.history.get("time") : null;
    // Size and area of the cracks over the steps of the page.
    const { cracks } = description;
    this.size = cracks?.size ?? null;
    this.area = cracks?.area ?? null;
    this.bonds = description.bonds ? new Bonds(description.bonds, this) : null;
  }

  // What curves of the run are drawn over: places of all rows, and of the steps of the page, with their label.
  get axis() {
    const [steps, broken] = ["step", "broken_in_step"].map((name) => this.history.get(name)?.values ?? []);
    const x = this.time ? valuesIn(this.time, this.time.shift) : steps;
    const label = this.time ? labelWithUnit("time", this.time.unit) : this.isModes ? "mode" : "step";
    // Between the breakages of a step their share leads from the step before to its end.
    const ofStep = (step, place) => (this.between[place] ? step - 1 + this.between[place].breakages / broken[steps.indexOf(step)] : step);
    return { x, ofSteps: this.time ? this.rows.map((row) => x[row]) : this.steps.map(ofStep), label };
  }

  // Displacement or reaction in a state of the page, or another column of the history at the end of a step, SI units.
  valueAt(name, place) {
    return this.between[place]?.[name] ?? this.history.get(name)?.values[this.rows[place]];
  }

  // Force of each step of the page over the largest, and its step; null where no force grows and falls.
  get loads() {
    const column = this.history.get("reaction");
    if (!column || this.time || this.isModes) return null;
    const forces = this.rows.map((_, place) => this.valueAt("reaction", place) ?? 0);
    const largest = Math.max(...forces);
    return largest > 0 ? { shares: forces.map((it) => it / largest), peak: forces.indexOf(largest) } : null;
  }

  // The step of another result with the same share of its largest force, before or behind it; without forces the same step.
  stepAlike(step, other) {
    const [own, others] = [this.loads, other.loads];
    if (!own || !others) return Math.min(step, other.steps.length - 1);
    const isBehind = step > own.peak;
    const distances = others.shares.map((share, place) => {
      const isThere = isBehind ? place >= others.peak : place <= others.peak;
      return isThere ? Math.abs(share - own.shares[step]) : Infinity;
    });
    return distances.indexOf(Math.min(...distances));
  }

  // The number of a step, or the time of a motion, in words.
  when(number) {
    const row = this.time ? this.history.get("step").values.indexOf(number) : -1;
    if (row < 0) return `${this.isModes ? "mode" : "step"} ${number}`;
    return `t = ${withUnit(shortText(this.time.values[row] * 10 ** this.time.shift), this.time.unit)}`;
  }

  // A state of the page in words.
  whenAt(place) {
    const between = this.between[place];
    return this.when(this.steps[place]) + (between ? ` after ${between.breakages} breakages` : "");
  }

  // The number of a state of the page.
  numberAt(place) {
    const between = this.between[place];
    return between ? `${this.steps[place]}:${between.breakages}` : `${this.steps[place]}`;
  }

  // Positions, tags and triangles; read once.
  body() {
    this.bodyPromise ??= this.readBody();
    return this.bodyPromise;
  }

  async readBody() {
    const { body } = this.description;
    const numbers = (columns) => Promise.all(columns.map((it) => new Column(it, body.count).values(0)));
    const none = new Float64Array(body.count);
    const positionColumns = body.position.map((it) => new Column(it, body.count));
    const [[x, y, z = none], half, tags, simplices] = await Promise.all([
      Promise.all(positionColumns.map((column) => column.values(0))),
      body.half && numbers(body.half),
      new Column(body.tags, body.count).multiples(0),
      new Column(body.simplices, body.nCorners).multiples(0),
    ]);
    if (half?.length === 2) half.push(none);
    return { x, y, z, tags, simplices, half, positionColumns, dimension: body.dimension, tagged: body.tagged };
  }

  // Triangles or tetrahedra that cracks pass through at some time: of a mesh their numbers, of a lattice nodes that follow points; read once.
  cracked() {
    this.crackedPromise ??= this.readCracked();
    return this.crackedPromise;
  }

  async readCracked() {
    const { cracks } = this.description;
    const count = cracks?.simplices ?? 0;
    if (count === 0) return null;
    const whole = (column, length) => new Column(column, length).multiples(0);
    const sides = new Column(cracks.sides, count);
    if (cracks.of) return { sides, of: await whole(cracks.of, count) };
    const [points, corners, ...position] = await Promise.all([
      whole(cracks.points, cracks.nNodes), whole(cracks.corners, 4 * count),
      ...cracks.position.map((it) => new Column(it, cracks.nNodes).values(0)),
    ]);
    return { sides, nodes: { points, corners, position } };
  }

  // Pairs of each triangle or tetrahedron that the crack cuts in a step and the sides of its corners, with a key that tells such lists apart.
  async cut(step) {
    const cracked = await this.cracked();
    if (!cracked) return { list: [], key: "" };
    const codes = await cracked.sides.multiples(step);
    const list = [];
    codes.forEach((code, place) => {
      const sides = sidesOf(code);
      if (sides) list.push([cracked.of ? cracked.of[place] : place, sides]);
    });
    return { list, key: codes.join(), nodes: cracked.nodes };
  }

  field(name) {
    return this.fields.find((it) => it.name === name);
  }

  choice(id) {
    return this.choices.find((it) => it.id === id) ?? this.choices[0];
  }

  // Components of a choice in its display unit, or in that of another shift.
  async parts({ field, place }, step, shift = field.shift) {
    return Promise.all(columnsOf(field, place).map((column) => column.values(step, 10 ** shift)));
  }

  // The power of ten of the last digit of a choice in a step, SI units.
  exponent({ field, place }, step) {
    return Math.max(...columnsOf(field, place).map((column) => column.exponents[step]));
  }

  // The range of a choice over the steps, in the display unit of a shift.
  range({ field, place }, shift = field.shift) {
    return (place === null ? [0, field.magnitude] : field.ranges[place]).map((it) => it * 10 ** shift);
  }

  // Components of a vector field in a step, in SI units; null without it.
  async vector(name, step) {
    const field = this.field(name);
    return field ? Promise.all(field.columns.map((column) => column.values(step))) : null;
  }

  // Values of a choice at a point over the steps, in the display unit.
  async valuesOfPoint({ field, place }, point) {
    const columns = columnsOf(field, place);
    const of = async (column, step) => {
      const multiples = await column.multiples(step);
      return valueOf(multiples[point], column.units[step] * 10 ** field.shift);
    };
    const ofStep = async (_, step) => {
      const values = await Promise.all(columns.map((column) => of(column, step)));
      return values.length > 1 ? Math.hypot(...values) : values[0];
    };
    return Promise.all(this.steps.map(ofStep));
  }

  // Frees the memory of all fields but the one shown, those that all views need apart.
  keepOnly(shown) {
    for (const field of this.fields) {
      if (field !== shown && field.name !== "displacement") field.columns.forEach((it) => it.forget());
    }
  }
}

// The columns of a choice: of one component, or of all.
function columnsOf({ columns }, place) {
  return place === null ? columns : [columns[place]];
}

// What can be shown of a field: itself, or its components; of a vector its length too.
function choicesOfField(field) {
  const words = inWords(field.name);
  if (field.components.length === 0) return [{ id: field.name, label: words, field, place: 0 }];
  const parts = field.components.map((name, place) => ({
    id: `${field.name}.${name}`, label: inWords(`${field.name}.${name}`), field, place,
  }));
  const isVector = field.components.join().startsWith("x,y");
  return isVector ? [{ id: field.name, label: words, field, place: null }, ...parts] : parts;
}

// Bonds: ends, properties, and the order in which they broke.
class Bonds {
  constructor(description, run) {
    this.description = description;
    this.run = run;
    this.criteria = description.criteria;
    this.columns = Object.entries(description.columns).map(([name, column]) => ({
      name, column: new Column(column, description.count),
    }));
  }

  // Ends and the bonds of each point; read once.
  ends() {
    this.endsPromise ??= this.readEnds();
    return this.endsPromise;
  }

  async readEnds() {
    const { count, ends } = this.description;
    const [a, b] = await Promise.all(ends.map((it) => new Column(it, count).multiples(0)));
    const { nPoints } = this.run;
    const first = new Uint32Array(nPoints + 1);
    for (let bond = 0; bond < count; bond++) {
      first[a[bond] + 1]++;
      first[b[bond] + 1]++;
    }
    for (let point = 0; point < nPoints; point++) first[point + 1] += first[point];
    const next = first.slice();
    const ofPoints = new Uint32Array(2 * count);
    for (let bond = 0; bond < count; bond++) {
      ofPoints[next[a[bond]]++] = bond;
      ofPoints[next[b[bond]]++] = bond;
    }
    return { a, b, first, ofPoints };
  }

  // Broken bonds in the order of breaking, and the place of each bond in it (-1: intact).
  breaks() {
    this.breaksPromise ??= this.readBreaks();
    return this.breaksPromise;
  }

  async readBreaks() {
    const { count, ...columns } = this.description.breaks;
    const column = (name) => new Column(columns[name], count);
    const [bond, step, round, criterion] = await Promise.all(
      ["bond", "step", "round", "criterion"].map((name) => column(name).multiples(0)),
    );
    const utilisation = await column("utilisation").values(0);
    const order = new Int32Array(this.description.count).fill(-1);
    bond.forEach((it, place) => { order[it] = place; });
    return { bond, step, round, criterion, utilisation, order };
  }

  // How many of the broken bonds have broken in a state of the page: on the exact path it is that before the breakages of its step.
  async countAt(place) {
    const { step } = await this.breaks();
    const { run } = this;
    const between = run.between[place];
    const isBefore = run.description.beforeBreakages || between;
    let count = 0;
    while (count < step.length && (isBefore ? step[count] < run.steps[place] : step[count] <= run.steps[place])) count++;
    return count + (between?.breakages ?? 0);
  }

  // Texts of the properties of a bond by name.
  async properties(bond) {
    const texts = new Map();
    await Promise.all(this.columns.map(async ({ name, column }) => {
      const multiple = (await column.multiples(0))[bond];
      texts.set(name, { multiple, exponent: column.exponents[0] });
    }));
    return texts;
  }
}
