//! Inputs made of others: the same from the same seed.

/// Seeded random numbers (SplitMix64, Steele, Lea & Flood, OOPSLA 2014).
pub(crate) struct Random(pub(crate) u64);

impl Random {
    pub(crate) fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// A number below a bound, which is not 0.
    pub(crate) fn below(&mut self, bound: usize) -> usize {
        (self.bits() % bound as u64) as usize
    }

    pub(crate) fn one_of<'a, T: ?Sized>(&mut self, of: &[&'a T]) -> &'a T {
        of[self.below(of.len())]
    }
}

/// Numbers that readers stumble over.
const NUMBERS: [&str; 24] = [
    "0",
    "-1",
    "1",
    "2",
    "-0.0",
    "0.5",
    "1e308",
    "-1e308",
    "1e-320",
    "1e400",
    "nan",
    "inf",
    "127",
    "256",
    "65536",
    "2147483647",
    "-2147483648",
    "4294967295",
    "4294967296",
    "9223372036854775807",
    "18446744073709551615",
    "1000000000000000000",
    "1e18",
    "",
];

/// Bytes of numbers that binary readers stumble over.
const BYTES: [u64; 8] = [
    0,
    1,
    u64::MAX,
    i64::MAX as u64,
    u32::MAX as u64,
    i32::MAX as u64,
    0x7ff0_0000_0000_0000,
    1 << 60,
];

/// Longest input, bytes: what is longer is cut.
const LONGEST: usize = 200_000;

/// One of the seeds with some changes.
pub(crate) fn mutated(seeds: &[Vec<u8>], words: &[&str], random: &mut Random) -> Vec<u8> {
    let mut input = seeds[random.below(seeds.len())].clone();
    for _ in 0..1 + random.below(6) {
        change(&mut input, seeds, words, random);
    }
    input.truncate(LONGEST);
    input
}

fn change(input: &mut Vec<u8>, seeds: &[Vec<u8>], words: &[&str], random: &mut Random) {
    if input.is_empty() {
        input.push(random.bits() as u8);
    }
    let at = random.below(input.len());
    let to = (at + 1 + random.below(64)).min(input.len());
    match random.below(12) {
        0 => input[at] ^= 1 << random.below(8),
        1 => input[at] = random.bits() as u8,
        2 => drop(input.drain(at..to)),
        3 => {
            let part = input[at..to].to_vec();
            let place = random.below(input.len());
            for _ in 0..1 + random.below(3) {
                input.splice(place..place, part.iter().copied());
            }
        }
        4 => input.truncate(at),
        5 => {
            let other = &seeds[random.below(seeds.len())];
            let from = random.below(other.len().max(1));
            let end = (from + 1 + random.below(400)).min(other.len());
            input.splice(at..to, other[from.min(end)..end].iter().copied());
        }
        6..=8 => replace_number(input, at, random),
        9 => {
            let value = BYTES[random.below(BYTES.len())].to_le_bytes();
            let width = [1, 2, 4, 8][random.below(4)].min(input.len() - at);
            input[at..at + width].copy_from_slice(&value[..width]);
        }
        10 => swap_lines(input, random),
        _ if words.is_empty() => input[at] = b'\n',
        _ => {
            let word = random.one_of(words);
            input.splice(at..at, word.bytes());
        }
    }
}

/// Puts another number in the place of the first one behind a place.
fn replace_number(input: &mut Vec<u8>, at: usize, random: &mut Random) {
    let is_part = |byte: &u8| byte.is_ascii_digit() || b"+-.eE".contains(byte);
    let Some(start) = input[at..].iter().position(u8::is_ascii_digit) else {
        return;
    };
    let start = at + start;
    let length = input[start..]
        .iter()
        .take_while(|byte| is_part(byte))
        .count();
    input.splice(start..start + length, random.one_of(&NUMBERS).bytes());
}

fn swap_lines(input: &mut Vec<u8>, random: &mut Random) {
    let mut lines: Vec<&[u8]> = input.split(|byte| *byte == b'\n').collect();
    let [a, b] = [0, 1].map(|_| random.below(lines.len()));
    lines.swap(a, b);
    *input = lines.join(&b'\n');
}
