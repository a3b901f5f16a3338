//! Printed numbers, and tolerances for the comparison with them.

use std::fmt;

/// A number with its printed digits.
#[derive(Debug, Clone, PartialEq)]
pub struct PrintedNumber {
    text: String,
    value: f64,
}

/// Allowed difference of a computed value from the known one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Tolerance {
    /// Half a unit of the last printed digit.
    Digits,
    /// Tolerance relative to the known value.
    Relative(f64),
    /// Tolerance in the unit of the table.
    Absolute(f64),
    /// Smallest and largest difference in the unit of the table.
    Between(f64, f64),
    /// Any difference: the value is shown and not judged.
    Any,
}

/// Difference of two values.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Difference {
    /// Difference in the unit of the table.
    Amount(f64),
    /// Difference relative to the known value.
    Share(f64),
}

impl PrintedNumber {
    /// Parses a printed number, with or without an exponent; `None` if the text is not a finite number.
    pub(super) fn parse(text: &str) -> Option<Self> {
        let value = text.parse().ok().filter(|value: &f64| value.is_finite())?;
        let text = text.to_owned();
        Some(Self { text, value })
    }

    /// Value of the number.
    pub(super) fn value(&self) -> f64 {
        self.value
    }

    /// Unit of the last printed digit.
    pub(super) fn last_digit(&self) -> f64 {
        let (digits, exponent) = self
            .text
            .split_once(['e', 'E'])
            .unwrap_or((&self.text, "0"));
        let decimals = digits
            .split_once('.')
            .map_or(0, |(_, decimals)| decimals.len());
        10f64.powi(exponent.parse().unwrap_or(0) - decimals as i32)
    }

    /// Text of another number with one digit more than this one, at least four.
    pub(super) fn like(&self, value: f64) -> String {
        let digits = 1 - self.last_digit().log10().round() as i32;
        let decimals = match self.value.abs() {
            0.0 => digits,
            size => digits.max(3 - size.log10().floor() as i32),
        };
        let text = format!("{value:.*}", decimals.clamp(0, 12) as usize);
        match text.strip_prefix('-') {
            Some(digits) if digits.chars().all(|digit| matches!(digit, '0' | '.')) => {
                digits.to_owned()
            }
            _ => text,
        }
    }

    /// Whether this is `value`, rounded to the printed digits.
    pub(super) fn is_rounded_from(&self, value: f64) -> bool {
        (value - self.value).abs() <= 0.5 * self.last_digit() * (1.0 + ROUNDING)
    }

    /// Whether this is `value`, truncated after the printed digits.
    pub(super) fn is_truncated_from(&self, value: f64) -> bool {
        let rest = (value - self.value) * if self.value < 0.0 { -1.0 } else { 1.0 };
        (-ROUNDING..1.0 + ROUNDING).contains(&(rest / self.last_digit()))
    }
}

/// Tolerance of a comparison of digits for rounding errors, over the last digit.
const ROUNDING: f64 = 1e-6;

impl Tolerance {
    /// Whether a computed value is within the tolerance of a known one.
    pub(super) fn admits(self, known: &PrintedNumber, computed: f64) -> bool {
        let distance = (computed - known.value).abs();
        match self {
            Self::Digits => known.is_rounded_from(computed),
            Self::Relative(share) => distance <= share * known.value.abs(),
            Self::Absolute(amount) => distance <= amount,
            Self::Between(least, most) => (least..=most).contains(&(computed - known.value)),
            Self::Any => true,
        }
    }
}

impl Difference {
    /// Text of the difference with its sign; an amount has one digit more than the known value.
    pub(super) fn words(self, known: &PrintedNumber) -> String {
        let (digits, unit) = match self {
            Self::Share(share) => (format!("{:.2}", 100.0 * share), " %"),
            Self::Amount(amount) => (known.like(amount), ""),
        };
        let is_zero = digits.chars().all(|digit| matches!(digit, '-' | '.' | '0'));
        let digits = if is_zero {
            digits.trim_start_matches('-')
        } else {
            &digits
        };
        let sign = if is_zero || digits.starts_with('-') {
            ""
        } else {
            "+"
        };
        format!("{sign}{digits}{unit}")
    }
}

impl fmt::Display for PrintedNumber {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.text)
    }
}

impl fmt::Display for Tolerance {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Digits => f.write_str("digits"),
            Self::Relative(share) => write!(f, "{} %", (1e8 * share).round() / 1e6),
            Self::Absolute(amount) => write!(f, "{amount}"),
            Self::Between(least, most) => write!(f, "{least} to {most:+}"),
            Self::Any => f.write_str("-"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_last_digit_is_that_of_the_text() {
        for (text, digit) in [
            ("2294.9", 0.1),
            ("0.02150", 1e-5),
            ("70", 1.0),
            ("7.0e10", 1e9),
            ("-3e-2", 0.01),
        ] {
            let found = PrintedNumber::parse(text).unwrap().last_digit();
            assert!((found / digit - 1.0).abs() < 1e-12, "{text}: {found}");
        }
        for text in ["", "n/a", "nan", "inf", "1,5"] {
            assert_eq!(PrintedNumber::parse(text), None, "{text}");
        }
    }

    #[test]
    fn computed_values_are_shown_with_a_digit_more() {
        for (known, computed, shown) in [
            ("2294.9", 2294.861, "2294.86"),
            ("0.02142", 0.0214237, "0.021424"),
            ("0.00000", -1e-12, "0.000000"),
            ("70", 69.98, "69.98"),
            ("2053", 2053.16, "2053.2"),
        ] {
            assert_eq!(PrintedNumber::parse(known).unwrap().like(computed), shown);
        }
    }

    #[test]
    fn tolerances_and_differences_in_words() {
        assert_eq!(Tolerance::Relative(0.03).to_string(), "3 %");
        assert_eq!(Tolerance::Relative(0.003).to_string(), "0.3 %");
        assert_eq!(Tolerance::Relative(0.001).to_string(), "0.1 %");
        assert_eq!(Tolerance::Absolute(0.04).to_string(), "0.04");
        assert_eq!(
            Tolerance::Between(-0.02, 0.005).to_string(),
            "-0.02 to +0.005"
        );
        let known = PrintedNumber::parse("0.3800").unwrap();
        assert_eq!(Difference::Share(-0.01234).words(&known), "-1.23 %");
        assert_eq!(Difference::Share(-1e-6).words(&known), "0.00 %");
        assert_eq!(Difference::Amount(-1e-6).words(&known), "0.00000");
        assert_eq!(Difference::Amount(0.0191).words(&known), "+0.01910");
        assert_eq!(Difference::Amount(-0.0191).words(&known), "-0.01910");
    }
}
