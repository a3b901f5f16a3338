// Measured curves, which the page has of the program or of a file that is dropped on it: two columns of numbers with a header of names and
// units, as in `opening (mm),force (kN)`.

const UNIT_PREFIXES = { "": 1, p: 1e-12, n: 1e-9, u: 1e-6, µ: 1e-6, μ: 1e-6, m: 1e-3, c: 1e-2, k: 1e3, M: 1e6, G: 1e9 };
const UNITS = ["m", "s", "N", "Pa", "rad", "J", "K", "N m", "J/K", "m^3", "mm^3"];

// The SI unit of a unit with a prefix, and the factor to it; null of an unknown one.
function siUnit(text) {
  const unit = text.trim().replace("³", "^3");
  if (unit === "") return { unit: "", factor: 1 };
  if (unit === "mm^3") return { unit: "m^3", factor: 1e-9 };
  for (const base of UNITS) {
    const prefix = unit.endsWith(base) ? unit.slice(0, unit.length - base.length) : null;
    if (prefix !== null && Object.hasOwn(UNIT_PREFIXES, prefix)) return { unit: base, factor: UNIT_PREFIXES[prefix] };
  }
  return null;
}

// A curve in SI units from its header and columns. Throws what is wrong with it.
function measuredCurve({ label, names, values }) {
  const columns = names.map((text, place) => {
    const [, name, , unit] = /^\s*(.*?)\s*([([]\s*(.*?)\s*[)\]])?\s*$/.exec(text);
    const si = siUnit(unit ?? "");
    if (!si) throw new Error(`${label}: the unit ${unit} of ${name} is not known; write one such as mm, um, N or kN`);
    return { name, unit: si.unit, values: values[place].map((it) => it * si.factor) };
  });
  return { label, x: columns[0], y: columns[1] };
}

// The curve in a text.
function parsedCurve(label, text) {
  const rows = text.split(/\r?\n/).filter((it) => it.trim()).map((line) => line.split(line.includes(";") ? ";" : /[,\t]/).map((it) => it.trim().replaceAll('"', "")));
  const [names, ...numbers] = rows;
  if (names?.length !== 2) throw new Error(`${label}: a measured curve has two columns, and a header that names them with their units: opening (mm),force (kN)`);
  const values = [0, 1].map((place) => numbers.map((row) => Number(row[place])));
  if (numbers.length === 0 || values.flat().some(Number.isNaN)) throw new Error(`${label}: below its header, a measured curve has numbers only, with decimal points`);
  return measuredCurve({ label, names, values });
}

// Whether a measured column is a column of the history: by its name, or by its unit where it has the name of none.
function isOfColumn({ name, unit }, column, columns) {
  const plain = (text) => text.toLowerCase().replace(/[^a-z0-9]/g, "");
  const named = columns.find((it) => plain(it.name) === plain(name) || plain(it.words ?? "") === plain(name));
  return named ? named === column : unit === "" || unit === column.si;
}
