//! Columns of numbers as short texts, which a browser decodes without a library.
//!
//! A step of a column is rounded to whole multiples of a power of ten, so that its largest value has a given number of digits. The multiples
//! of several steps together are stored as whole numbers of four bytes, lowest byte first, compressed by raw deflate and written in base64.

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
    pub(crate) fn whole_numbers(values: impl IntoIterator<Item = i64>) -> Self {
        let values: Vec<f64> = values.into_iter().map(|it| it as f64).collect();
        Self::single(&values, Digits::Whole)
    }

    /// Number of characters in a page.
    pub(crate) fn n_characters(&self) -> usize {
        self.groups.iter().map(String::len).sum()
    }
}

/// Encoder of a column, step by step.
#[derive(Debug)]
pub(crate) struct Encoder {
    digits: Digits,
    /// Multiples of the steps of a group.
    bytes: Vec<u8>,
    column: Column,
}

impl Encoder {
    /// A column without steps.
    pub(crate) fn new(digits: Digits) -> Self {
        Self {
            digits,
            bytes: Vec::new(),
            column: Column {
                groups: Vec::new(),
                exponents: Vec::new(),
            },
        }
    }

    /// Appends a step; all steps have as many values.
    pub(crate) fn append(&mut self, values: &[f64]) {
        let exponent = exponent(values, self.digits);
        let unit = power_of_ten(exponent);
        let multiples = values.iter().map(|&it| multiple(it, unit));
        self.bytes.extend(multiples.flat_map(i32::to_le_bytes));
        self.column.exponents.push(exponent);
        if self.column.exponents.len().is_multiple_of(GROUP) {
            self.close_group();
        }
    }

    /// Completes the column.
    pub(crate) fn finish(mut self) -> Column {
        if !self.column.exponents.len().is_multiple_of(GROUP) {
            self.close_group();
        }
        self.column
    }

    fn close_group(&mut self) {
        let compressed = compress_to_vec(&self.bytes, LEVEL);
        self.column.groups.push(BASE64_STANDARD.encode(compressed));
        self.bytes.clear();
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
        (value / unit).round() as i32
    }
}

#[cfg(test)]
mod tests {
    use miniz_oxide::inflate::decompress_to_vec;

    use super::*;

    /// Reads a column back as the page does.
    fn read(column: &Column, count: usize) -> Vec<Vec<f64>> {
        let mut exponents = column.exponents.iter();
        let mut steps: Vec<Vec<f64>> = Vec::new();
        for group in &column.groups {
            let bytes = decompress_to_vec(&BASE64_STANDARD.decode(group).unwrap()).unwrap();
            for step in bytes.chunks(4 * count) {
                let unit = power_of_ten(*exponents.next().unwrap());
                let multiples = step.as_chunks().0.iter().map(|it| i32::from_le_bytes(*it));
                let values = multiples.map(|it| match it {
                    NOT_A_NUMBER => f64::NAN,
                    INFINITY => f64::INFINITY,
                    it => f64::from(it) * unit,
                });
                steps.push(values.collect());
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
        let column = Column::whole_numbers(tags);
        assert_eq!(read(&column, 5)[0], tags.map(|it| it as f64));
        assert_eq!(column.exponents, [0]);
    }
}
