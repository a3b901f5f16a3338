//! Columns of numbers as short texts, which a browser decodes without a library.
//!
//! A step of a column is rounded to whole multiples of a power of ten, so that its largest value has a given number of digits. Each
//! multiple is predicted from the steps before it, and from the number before it in the column; the residual is small where a body is
//! loaded in equal steps and neighbours are adjacent. The residuals' bytes are stored plane by plane, several steps together, compressed by
//! raw deflate and written in base64.

use base64::Engine as _;
use base64::prelude::BASE64_STANDARD;
use miniz_oxide::deflate::compress_to_vec;

/// Number of steps that are compressed and decoded together.
pub(crate) const GROUP: usize = 8;

/// Compression level: higher ones take several times as long and save a hundredth.
const LEVEL: u8 = 6;

/// Codes for NaN and infinity, larger than all other multiples.
const NOT_A_NUMBER: i32 = 1 << 30;
const INFINITY: i32 = NOT_A_NUMBER + 1;

/// Digits of a column.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Digits {
    /// Number of digits of the largest value of each step.
    OfLargest(u32),
    /// All digits of whole numbers.
    Whole,
}

/// A column as text.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Column {
    /// Base64 of the groups of steps.
    pub(crate) groups: Vec<String>,
    /// Exponents of the powers of ten whose multiples are the values of each step.
    pub(crate) exponents: Vec<i32>,
}

impl Column {
    /// The column of a single step.
    pub(crate) fn single(values: &[f64], digits: Digits) -> Self {
        let mut encoder = Encoder::new(digits);
        encoder.append(values);
        encoder.finish()
    }

    /// The column of whole numbers of a single step.
    pub(crate) fn whole(values: impl IntoIterator<Item = i64>) -> Self {
        let values: Vec<f64> = values.into_iter().map(|it| it as f64).collect();
        Self::single(&values, Digits::Whole)
    }

    /// Number of characters in a page.
    pub(crate) fn letters(&self) -> usize {
        self.groups.iter().map(String::len).sum()
    }
}

/// Encoder of a column, step by step.
#[derive(Debug)]
pub(crate) struct Encoder {
    digits: Digits,
    /// Rounded values of the two steps before in the group, the later one first.
    before: [Vec<f64>; 2],
    in_group: usize,
    bytes: Vec<u8>,
    column: Column,
}

impl Encoder {
    /// A column without steps.
    pub(crate) fn new(digits: Digits) -> Self {
        Self {
            digits,
            before: [Vec::new(), Vec::new()],
            in_group: 0,
            bytes: Vec::new(),
            column: Column {
                groups: Vec::new(),
                exponents: Vec::new(),
            },
        }
    }

    /// Appends a step; all steps have as many values.
    pub(crate) fn append(&mut self, values: &[f64]) {
        if self.in_group == GROUP {
            self.close_group();
        }
        let exponent = exponent(values, self.digits);
        let unit = power_of_ten(exponent);
        let multiples: Vec<i32> = values.iter().map(|&it| multiple(it, unit)).collect();
        let order = self.in_group.min(2);
        let choices = (0..=order as u8).flat_map(|time| [(time, false), (time, true)]);
        let left = choices.map(|(time, along)| {
            let left = self.left(&multiples, unit, time, along);
            (bits(&left), time, along, left)
        });
        if let Some((_, time, along, left)) = left.min_by_key(|it| it.0) {
            self.bytes.push(2 * time + u8::from(along));
            write_planes(&mut self.bytes, &left);
        }
        let rounded = multiples.iter().map(|&it| value(it, unit)).collect();
        let [last, _] = std::mem::take(&mut self.before);
        self.before = [rounded, last];
        self.in_group += 1;
        self.column.exponents.push(exponent);
    }

    /// Completes the column.
    pub(crate) fn finish(mut self) -> Column {
        self.close_group();
        self.column
    }

    /// Residuals of a prediction of order `time` over the steps, and from the number before where `along`.
    fn left(&self, multiples: &[i32], unit: f64, time: u8, along: bool) -> Vec<i32> {
        let [last, before] = &self.before;
        let mut previous = 0_i32;
        let of_value = |(place, &multiple): (usize, &i32)| {
            let predicted = match time {
                0 => 0.0,
                1 => last[place],
                _ => 2.0 * last[place] - before[place],
            };
            let left = multiple.wrapping_sub(nearest(predicted / unit));
            let stored = if along {
                left.wrapping_sub(previous)
            } else {
                left
            };
            previous = left;
            stored
        };
        multiples.iter().enumerate().map(of_value).collect()
    }

    fn close_group(&mut self) {
        if self.in_group > 0 {
            let compressed = compress_to_vec(&self.bytes, LEVEL);
            self.column.groups.push(BASE64_STANDARD.encode(compressed));
        }
        self.bytes.clear();
        self.before = [Vec::new(), Vec::new()];
        self.in_group = 0;
    }
}

/// Exponent of the power of ten to whose multiples values are rounded.
fn exponent(values: &[f64], digits: Digits) -> i32 {
    let finite = values.iter().filter(|it| it.is_finite());
    let largest = finite.fold(0.0_f64, |largest, it| largest.max(it.abs()));
    match digits {
        Digits::OfLargest(digits) if largest > 0.0 => {
            largest.log10().floor() as i32 + 1 - digits as i32
        }
        _ => 0,
    }
}

/// Power of ten, rounded as a parsed decimal number, equal in this program and a browser.
fn power_of_ten(exponent: i32) -> f64 {
    format!("1e{exponent}").parse().unwrap_or(1.0)
}

fn multiple(value: f64, unit: f64) -> i32 {
    if value.is_nan() {
        NOT_A_NUMBER
    } else if value.is_infinite() {
        INFINITY
    } else {
        nearest(value / unit)
    }
}

/// The value of a multiple for predictions, 0 for NaN and infinity.
fn value(multiple: i32, unit: f64) -> f64 {
    if multiple >= NOT_A_NUMBER {
        0.0
    } else {
        f64::from(multiple) * unit
    }
}

/// The nearest whole number, rounded as `Math.floor(x + 0.5)` does in a browser.
fn nearest(value: f64) -> i32 {
    (value + 0.5).floor() as i32
}

/// Zigzag code, with the sign in the lowest bit, so that small numbers of both signs have few bits.
fn zigzag(value: i32) -> u32 {
    ((value << 1) ^ (value >> 31)) as u32
}

/// Number of significant bits of numbers, a measure for their compressed size.
fn bits(values: &[i32]) -> u64 {
    let of_value = |it: &i32| u64::from(32 - zigzag(*it).leading_zeros());
    values.iter().map(of_value).sum()
}

/// Writes the number of bytes of the largest number, then the bytes of all numbers, the lowest ones first.
fn write_planes(bytes: &mut Vec<u8>, values: &[i32]) {
    let folded: Vec<u32> = values.iter().map(|&it| zigzag(it)).collect();
    let all = folded.iter().fold(0, |all, it| all | it);
    let planes = (32 - all.leading_zeros()).div_ceil(8);
    bytes.push(planes as u8);
    for plane in 0..planes {
        bytes.extend(folded.iter().map(|it| (it >> (8 * plane)) as u8));
    }
}

#[cfg(test)]
mod tests {
    use miniz_oxide::inflate::decompress_to_vec;

    use super::*;

    /// Reads a column back as the page does.
    fn read(column: &Column, count: usize) -> Vec<Vec<f64>> {
        let mut steps: Vec<Vec<f64>> = Vec::new();
        let mut exponents = column.exponents.iter();
        for group in &column.groups {
            let bytes = decompress_to_vec(&BASE64_STANDARD.decode(group).unwrap()).unwrap();
            let mut at = 0;
            let mut before: Vec<Vec<f64>> = Vec::new();
            while at < bytes.len() {
                let (mode, planes) = (bytes[at], usize::from(bytes[at + 1]));
                at += 2;
                let unit = power_of_ten(*exponents.next().unwrap());
                let mut previous = 0_i32;
                let mut step = Vec::new();
                for place in 0..count {
                    let folded = (0..planes).fold(0_u32, |sum, plane| {
                        sum | u32::from(bytes[at + plane * count + place]) << (8 * plane)
                    });
                    let mut left = (folded >> 1) as i32 ^ -((folded & 1) as i32);
                    if mode & 1 == 1 {
                        left = left.wrapping_add(previous);
                    }
                    previous = left;
                    let k = before.len();
                    let predicted = match mode >> 1 {
                        0 => 0.0,
                        1 => before[k - 1][place],
                        _ => 2.0 * before[k - 1][place] - before[k - 2][place],
                    };
                    step.push(left.wrapping_add(nearest(predicted / unit)));
                }
                at += planes * count;
                before.push(step.iter().map(|&it| value(it, unit)).collect());
                let shown = step.iter().map(|&it| match it {
                    NOT_A_NUMBER => f64::NAN,
                    INFINITY => f64::INFINITY,
                    it => f64::from(it) * unit,
                });
                steps.push(shown.collect());
            }
        }
        steps
    }

    /// Twenty steps of growing waves, with values that are no numbers: each is right to half a unit of its fifth digit.
    #[test]
    fn columns_read_back_to_their_digits() {
        let step = |step: usize| -> Vec<f64> {
            let wave = |it: usize| (it as f64 * 0.1).sin() * step as f64 * 1.7e-7;
            let mut values: Vec<f64> = (0..100).map(wave).collect();
            values[7] = f64::NAN;
            values[8] = if step > 3 { f64::INFINITY } else { -1e-9 };
            values
        };
        let mut encoder = Encoder::new(Digits::OfLargest(5));
        (0..20).for_each(|it| encoder.append(&step(it)));
        let column = encoder.finish();
        assert_eq!((column.groups.len(), column.exponents.len()), (3, 20));
        for (place, read) in read(&column, 100).iter().enumerate() {
            let unit = power_of_ten(column.exponents[place]);
            let largest = step(place)
                .iter()
                .filter(|it| it.is_finite())
                .fold(0.0, |a: f64, b| a.max(b.abs()));
            assert!(place == 0 || (1e4..1e5).contains(&(largest / unit)));
            for (read, value) in read.iter().zip(step(place)) {
                let same = read.is_nan() && value.is_nan() || *read == value;
                assert!(
                    same || (read - value).abs() <= 0.5000001 * unit,
                    "{read} {value}"
                );
            }
        }
    }

    #[test]
    fn whole_numbers_stay_as_they_are() {
        let tags = [1, 5, 70_000, 3, -12];
        let column = Column::whole(tags);
        assert_eq!(read(&column, 5)[0], tags.map(|it| it as f64));
        assert_eq!(column.exponents, [0]);
    }

    /// Equal load steps of an elastic body leave nothing to store after the second.
    #[test]
    fn equal_steps_cost_next_to_nothing() {
        let mut encoder = Encoder::new(Digits::OfLargest(5));
        for step in 1..=8 {
            let values: Vec<f64> = (0..5000)
                .map(|it| f64::from((it * 7919 % 5000) * step) * 2e-5)
                .collect();
            encoder.append(&values);
        }
        let letters = encoder.finish().letters();
        assert!(letters < 40_000, "{letters}");
    }
}
