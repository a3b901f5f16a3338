// Colours of values: maps that any colour vision can tell apart, as in pictures of `ligament plot`.

const MAPS = {
  cividis: "00224e 123570 3b496c 575d6d 707173 8a8678 a59c74 c3b369 e1cc55 fee838",
  viridis: "440154 482475 414487 355f8d 2a788e 21918c 22a884 44bf70 7ad151 bddf26 fde725",
  // Light grey where nothing is damaged.
  damage: "e3e3e3 fde0b8 fdbb84 fc8d59 e34a33 b30000 6b0000",
  diverging: "053061 2166ac 4393c3 92c5de d1e5f0 f7f7f7 fddbc7 f4a582 d6604d b2182b 67001f",
};
const COLOURS = 256;

// The bytes of 256 colours, red, green, blue and opacity.
function colourTable(name) {
  const stops = MAPS[name].split(" ").map((it) => [0, 2, 4].map((at) => parseInt(it.slice(at, at + 2), 16)));
  const bytes = new Uint8Array(4 * COLOURS).fill(255);
  for (let place = 0; place < COLOURS; place++) {
    const at = (place / (COLOURS - 1)) * (stops.length - 1);
    const from = Math.min(Math.floor(at), stops.length - 2);
    for (let channel = 0; channel < 3; channel++) {
      const [low, high] = [stops[from][channel], stops[from + 1][channel]];
      bytes[4 * place + channel] = Math.round(low + (at - from) * (high - low));
    }
  }
  return bytes;
}

// The map for a field without values of both signs.
function mapOf(name) {
  return /^(damage|dissipated|precrack)/.test(name) ? "damage" : "cividis";
}

// The range of colours for values: with values of both signs it is even about zero, which is white then.
function colourRange(low, high, map) {
  if (!(low <= high)) return { low: 0, high: 1, map };
  if (low < 0 && high > 0) {
    const size = Math.max(-low, high);
    return { low: -size, high: size, map: "diverging" };
  }
  if (low === high) return low === 0 ? { low: 0, high: 1, map } : { low: low - Math.abs(low) / 2, high: high + Math.abs(high) / 2, map };
  return { low: map === "damage" && low < 0.2 * high ? 0 : low, high, map };
}

// Smallest and largest value, without a share at either end.
function rangeOfValues(values, share) {
  const sorted = Float64Array.from(values).filter(Number.isFinite).sort();
  if (sorted.length === 0) return [0, 0];
  const skipped = Math.floor(share * (sorted.length - 1));
  return [sorted[skipped], sorted[sorted.length - 1 - skipped]];
}
