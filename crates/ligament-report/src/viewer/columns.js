// Columns of numbers, as the program wrote them (columns.rs): groups of steps in base64 of raw deflate, read back when first needed.

const NOT_A_NUMBER = 2 ** 30;
const STEPS_OF_A_GROUP = 8;

// The text of a group of steps: `texts` are the numbers of the first text of the page and of the one after the last, or the texts themselves.
function textOfGroup(texts, group) {
  return typeof texts[0] === "string" ? texts[group] : document.getElementById(`t${texts[0] + group}`).textContent;
}

// What a text of a column packs.
async function bytesOfText(text) {
  const binary = atob(text);
  const bytes = new Uint8Array(binary.length);
  for (let place = 0; place < bytes.length; place++) bytes[place] = binary.charCodeAt(place);
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate-raw"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

// The steps of a group, each as whole multiples of its unit, which are stored lowest byte first.
function stepsOfGroup(bytes, count, steps) {
  const view = new DataView(bytes.buffer);
  const multiples = (step) => Int32Array.from({ length: count }, (_, place) => view.getInt32(4 * (step * count + place), true));
  return Array.from({ length: steps }, (_, step) => multiples(step));
}

// Share of the largest value of all steps below which a whole step is nothing but rounding.
const NOTHING = 1e-12;

class Column {
  // `largest` is the largest value of all steps, where it is known.
  constructor(description, count, largest = 0) {
    this.least = NOTHING * largest;
    this.texts = description.texts;
    this.exponents = description.exponents;
    this.units = this.exponents.map((exponent) => Number(`1e${exponent}`));
    this.count = count;
    this.promises = new Map();
    this.groups = new Map();
  }

  // Multiples of a step, once they are read.
  async multiples(step) {
    const group = Math.floor(step / STEPS_OF_A_GROUP);
    if (!this.promises.has(group)) this.promises.set(group, this.read(group));
    return (await this.promises.get(group))[step % STEPS_OF_A_GROUP];
  }

  // Multiples of a step if they have been read.
  ready(step) {
    return this.groups.get(Math.floor(step / STEPS_OF_A_GROUP))?.[step % STEPS_OF_A_GROUP];
  }

  async read(group) {
    const from = group * STEPS_OF_A_GROUP;
    const units = this.units.slice(from, from + STEPS_OF_A_GROUP);
    const steps = stepsOfGroup(await bytesOfText(textOfGroup(this.texts, group)), this.count, units.length);
    steps.forEach((multiples, place) => {
      const isNothing = (multiple) => multiple >= NOT_A_NUMBER || Math.abs(multiple * units[place]) < this.least;
      if (this.least > 0 && multiples.every(isNothing)) multiples.forEach((it, at) => { if (it < NOT_A_NUMBER) multiples[at] = 0; });
    });
    this.groups.set(group, steps);
    return steps;
  }

  // Values of a step: SI units times a factor.
  async values(step, factor = 1) {
    const multiples = await this.multiples(step);
    const unit = this.units[step] * factor;
    const values = new Float64Array(multiples.length);
    for (let place = 0; place < values.length; place++) values[place] = valueOf(multiples[place], unit);
    return values;
  }

  // Forgets what was read of it.
  forget() {
    this.promises.clear();
    this.groups.clear();
  }
}

function valueOf(multiple, unit) {
  if (multiple < NOT_A_NUMBER) return multiple * unit;
  return multiple === NOT_A_NUMBER ? NaN : Infinity;
}
