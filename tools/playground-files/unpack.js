// Bytes that were packed by LZMA, alone and without a mark of their end (as in Igor Pavlov's specification of the format). A browser unpacks no
// format by itself in which the program is as small: by deflate it is half as large again.

// The state after a literal; states count the literals since the last match.
const AFTER_LITERAL = [0, 0, 0, 0, 1, 2, 3, 4, 5, 6, 4, 5];

// Decodes bits by their probabilities, which follow what came.
class Bits {
  constructor(bytes, at) {
    this.bytes = bytes;
    this.range = 0xffffffff;
    this.code = 0;
    this.at = at;
    for (let place = 0; place < 5; place++) this.code = ((this.code << 8) | bytes[this.at++]) >>> 0;
  }

  shift() {
    if (this.range >= 0x1000000) return;
    this.range = (this.range << 8) >>> 0;
    this.code = ((this.code << 8) | this.bytes[this.at++]) >>> 0;
  }

  next(chances, place) {
    const chance = chances[place];
    const bound = (this.range >>> 11) * chance;
    const bit = this.code < bound ? 0 : 1;
    if (bit === 0) {
      this.range = bound;
      chances[place] = chance + ((2048 - chance) >> 5);
    } else {
      this.range -= bound;
      this.code -= bound;
      chances[place] = chance - (chance >> 5);
    }
    this.shift();
    return bit;
  }

  // A number of bits that are as likely 0 as 1.
  plain(count) {
    let number = 0;
    for (; count > 0; count--) {
      this.range >>>= 1;
      const bit = this.code >= this.range ? 1 : 0;
      if (bit) this.code -= this.range;
      this.shift();
      number = number * 2 + bit;
    }
    return number;
  }

  // A number through a tree of chances from a place on, highest bit first.
  tree(chances, from, count) {
    let node = 1;
    for (let bit = 0; bit < count; bit++) node = (node << 1) | this.next(chances, from + node);
    return node - (1 << count);
  }

  // The same, lowest bit first.
  reversed(chances, from, count) {
    let node = 1;
    let number = 0;
    for (let place = 0; place < count; place++) {
      const bit = this.next(chances, from + node);
      node = (node << 1) | bit;
      number |= bit << place;
    }
    return number;
  }
}

const even = (count) => new Uint16Array(count).fill(1024);

// Lengths of repeated bytes.
class Lengths {
  constructor() {
    Object.assign(this, { choice: even(2), low: even(16 << 3), middle: even(16 << 3), high: even(256) });
  }

  next(bits, position) {
    if (bits.next(this.choice, 0) === 0) return 2 + bits.tree(this.low, position << 3, 3);
    if (bits.next(this.choice, 1) === 0) return 10 + bits.tree(this.middle, position << 3, 3);
    return 18 + bits.tree(this.high, 0, 8);
  }
}

class Distances {
  constructor() {
    Object.assign(this, { slots: even(4 << 6), special: even(128), aligned: even(16) });
  }

  next(bits, length) {
    const slot = bits.tree(this.slots, Math.min(length - 2, 3) << 6, 6);
    if (slot < 4) return slot;
    const count = (slot >> 1) - 1;
    const base = (2 | (slot & 1)) << count;
    if (slot < 14) return base + bits.reversed(this.special, base - slot, count);
    return base + bits.plain(count - 4) * 16 + bits.reversed(this.aligned, 0, 4);
  }
}

function literal(bits, chances, from, isAfterMatch, matched) {
  let node = 1;
  if (isAfterMatch) {
    // The byte that would have followed is a guess, as long as its bits are right.
    while (node < 0x100) {
      const guess = (matched >> 7) & 1;
      matched <<= 1;
      const bit = bits.next(chances, from + ((1 + guess) << 8) + node);
      node = (node << 1) | bit;
      if (bit !== guess) break;
    }
  }
  while (node < 0x100) node = (node << 1) | bits.next(chances, from + node);
  return node & 0xff;
}

// The header has the parameters and, from its byte 5 on, the length of what was packed.
function unpacked(bytes) {
  const [lc, lp, pb] = [bytes[0] % 9, Math.floor(bytes[0] / 9) % 5, Math.floor(bytes[0] / 45)];
  const out = new Uint8Array(new DataView(bytes.buffer).getUint32(5, true));
  const bits = new Bits(bytes, 13);
  const chances = { literals: even(0x300 << (lc + lp)), match: even(12 << 4), repeats: even(12), first: even(12), second: even(12), third: even(12), single: even(12 << 4) };
  const [lengths, repeated, distances] = [new Lengths(), new Lengths(), new Distances()];
  let [d0, d1, d2, d3] = [0, 0, 0, 0];
  let state = 0;
  let at = 0;
  while (at < out.length) {
    const position = at & ((1 << pb) - 1);
    if (bits.next(chances.match, (state << 4) + position) === 0) {
      const before = at > 0 ? out[at - 1] : 0;
      const from = 0x300 * (((at & ((1 << lp) - 1)) << lc) + (before >> (8 - lc)));
      out[at] = literal(bits, chances.literals, from, state >= 7, out[at - d0 - 1]);
      at++;
      state = AFTER_LITERAL[state];
      continue;
    }
    let length = 0;
    if (bits.next(chances.repeats, state) === 0) {
      [d3, d2, d1] = [d2, d1, d0];
      length = lengths.next(bits, position);
      d0 = distances.next(bits, length);
      state = state < 7 ? 7 : 10;
    } else {
      // One of the last four distances again.
      if (bits.next(chances.first, state) === 0) {
        if (bits.next(chances.single, (state << 4) + position) === 0) length = 1;
      } else if (bits.next(chances.second, state) === 0) {
        [d0, d1] = [d1, d0];
      } else if (bits.next(chances.third, state) === 0) {
        [d0, d1, d2] = [d2, d0, d1];
      } else {
        [d0, d1, d2, d3] = [d3, d0, d1, d2];
      }
      state = state < 7 ? (length ? 9 : 8) : 11;
      length ||= repeated.next(bits, position);
    }
    for (; length > 0; length--, at++) out[at] = out[at - d0 - 1];
  }
  return out;
}
