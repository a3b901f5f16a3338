// Numbers as texts.

const MOST_DECIMALS = 12;

// A rounded value in its display unit, with the decimals that it has and no others.
function exactText(multiple, exponent, shift) {
  if (multiple >= NOT_A_NUMBER) return multiple === NOT_A_NUMBER ? "–" : "∞";
  const power = exponent + shift;
  const decimals = Math.min(Math.max(-power, 0), MOST_DECIMALS);
  const text = Number(`${multiple}e${power}`).toFixed(decimals);
  return Number(text) === 0 ? "0" : minus(text);
}

// A value to a power of ten.
function textTo(value, exponent) {
  return Number.isFinite(value) ? exactText(Math.round(value / 10 ** exponent), exponent, 0) : shortText(value);
}

// A value with four digits, in the display unit.
function shortText(value, digits = 4) {
  if (!Number.isFinite(value)) return Number.isNaN(value) ? "–" : "∞";
  const size = Math.abs(value);
  // What is left of sums that cancel is nothing in any unit.
  if (size < 1e-20) return "0";
  if (size >= 1e6 || size < 1e-4) return minus(value.toExponential(digits - 1).replace("e+", "e"));
  const decimals = Math.max(0, digits - 1 - Math.floor(Math.log10(size)));
  return minus(value.toFixed(decimals));
}

function minus(text) {
  return text.replace("-", "−");
}

function withUnit(text, unit) {
  return unit ? `${text} ${unit}` : text;
}

function labelWithUnit(name, unit) {
  return unit ? `${name} (${unit})` : name;
}

// The name of a column or field in words. Virial stresses are not those of the continuum at single points of a mesh.
function inWords(name) {
  const words = name.replaceAll("_", " ").replaceAll(".", " ").replace("stress principal", "principal stress");
  return name.startsWith("stress_virial") ? `${words}, right in the mean` : words;
}

// The name of a column of the history in words: a temperature alone is a load whose size is its change.
function columnInWords({ name, si }) {
  if (name === "reaction") return si === "J/K" ? "work of the thermal forces per kelvin" : "force";
  return name === "displacement" && si === "K" ? "temperature change" : inWords(name);
}

// Round numbers from low to high, about so many.
function ticks(low, high, count) {
  const rough = (high - low) / Math.max(count, 1);
  if (!(rough > 0)) return [low];
  const power = 10 ** Math.floor(Math.log10(rough));
  const step = [1, 2, 5, 10].map((it) => it * power).find((it) => it >= rough * 0.999);
  const found = [];
  for (let place = Math.ceil(low / step - 1e-9); place * step <= high + 1e-9 * step; place++) {
    // A product has rounding of its own that a label must not show.
    found.push(Number((place * step).toPrecision(12)));
  }
  return found;
}
