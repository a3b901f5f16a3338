//! Units with the prefix that gives short numbers, and numbers as they are printed in pictures.

use ligament_output::quantity::{self, four_digits};

/// A unit in which values of a quantity are shown.
#[derive(Debug, Clone, PartialEq)]
pub struct AxisUnit {
    /// Factor on a value in SI units.
    pub factor: f64,
    /// The unit with its prefix or power of ten; empty for a number without unit.
    pub unit: String,
}

impl AxisUnit {
    /// The unit for values of a size in an SI unit such as `J/m^3`; `-` is none.
    pub fn new(unit: &str, size: f64) -> Self {
        let shown = quantity::PrefixedUnit::new(unit, size);
        let symbol = shown.unit.replace("^2", "²").replace("^3", "³");
        let prefix = shown.prefix.replace('u', "µ");
        let power = match shown.power {
            0 => String::new(),
            power => power_of_ten(power),
        };
        Self {
            factor: shown.factor,
            unit: format!("{power} {prefix}{symbol}").trim().to_owned(),
        }
    }

    /// A quantity with this unit, for labels.
    pub fn label(&self, quantity: &str) -> String {
        if self.unit.is_empty() {
            quantity.to_owned()
        } else {
            format!("{quantity} ({})", self.unit)
        }
    }

    /// A value with this unit, to four digits.
    pub fn value(&self, value: f64) -> String {
        let number = four_digits(value * self.factor);
        match self.unit.as_str() {
            "" => number,
            unit if unit.starts_with("10") => format!("{number} × {unit}"),
            unit => format!("{number} {unit}"),
        }
    }
}

fn power_of_ten(exponent: i32) -> String {
    let raised = |letter: char| match letter {
        '-' => '⁻',
        '1' => '¹',
        '2' => '²',
        '3' => '³',
        digit => char::from_u32('⁰' as u32 + digit as u32 - '0' as u32).unwrap_or(digit),
    };
    let exponent: String = exponent.to_string().chars().map(raised).collect();
    format!("10{exponent}")
}

/// Numbers with as many decimals as the widest of them needs to show `step`.
pub(crate) fn text_with_decimals_of(value: f64, step: f64) -> String {
    let needs = |decimals: usize| {
        let scaled = step * 10f64.powi(decimals as i32);
        (scaled - scaled.round()).abs() < 1e-6 * scaled.abs().max(1e-300)
    };
    let first = (-step.abs().max(1e-12).log10().floor()).max(0.0) as usize;
    let decimals = (first..first + 3)
        .find(|it| needs(*it))
        .unwrap_or(first + 2);
    let text = format!("{value:.decimals$}");
    let is_zero = text.chars().all(|letter| matches!(letter, '-' | '0' | '.'));
    if is_zero { text.replace('-', "") } else { text }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_get_the_prefix_that_makes_them_short() {
        for (unit, size, expected) in [
            ("m", 1.8e-4, "mm"),
            ("m", 0.05, "mm"),
            ("m", 2e-7, "µm"),
            ("N", 6.4e5, "kN"),
            ("J/m^3", 3.2e3, "kJ/m³"),
            ("Pa", 4e6, "MPa"),
            ("-", 0.4, ""),
            ("-", 3e-5, "10⁻⁶"),
            ("m^3", 2e-6, "mm³"),
            ("Pa/m^3", 2e-13, "10⁻¹⁵ Pa/m³"),
            ("K", 120.0, "K"),
            ("m", 0.0, "m"),
        ] {
            assert_eq!(AxisUnit::new(unit, size).unit, expected, "{size} {unit}");
        }
        assert_eq!(AxisUnit::new("m", 1.8e-4).value(1.8e-4), "0.1800 mm");
        assert_eq!(AxisUnit::new("N", 6.4e5).value(644_761.3), "644.8 kN");
        assert_eq!(AxisUnit::new("m^3", 2e-6).value(2e-6), "2000 mm³");
        assert_eq!(AxisUnit::new("1/K", 2e-6).value(2e-6), "2.000 × 10⁻⁶ 1/K");
        assert_eq!(AxisUnit::new("-", 0.4).label("damage"), "damage");
    }

    #[test]
    fn labels_have_the_decimals_of_their_step() {
        assert_eq!(text_with_decimals_of(0.30000000000000004, 0.1), "0.3");
        assert_eq!(text_with_decimals_of(0.25, 0.25), "0.25");
        assert_eq!(text_with_decimals_of(200.0, 100.0), "200");
        assert_eq!(text_with_decimals_of(-1e-18, 0.5), "0.0");
    }
}
