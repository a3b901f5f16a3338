//! Formatted quantities: four significant digits, and a unit with a suitable prefix.
//!
//! Files keep all digits in SI units; terminals and pictures show quantities in this form.

/// Unit in which the values of a quantity are shown.
#[derive(Debug, Clone, PartialEq)]
pub struct PrefixedUnit {
    /// Factor of values in SI units.
    pub factor: f64,
    /// Prefix of the unit: `k`; `u` for a millionth.
    pub prefix: &'static str,
    /// SI unit without the prefix: `J/m^2`; empty for a number without a unit.
    pub unit: String,
    /// Power of ten behind the number, where the unit has no prefix; 0 for none.
    pub power: i32,
}

/// Prefixes of the powers of ten, in steps of three from 10^-12.
const PREFIXES: [&str; 9] = ["p", "n", "u", "m", "", "k", "M", "G", "T"];

impl PrefixedUnit {
    /// The unit for values of a size, in an SI unit such as `J/m^3`; `-` is no unit.
    pub fn new(unit: &str, size: f64) -> Self {
        let exact = if size > 0.0 && size.is_finite() {
            size.log10()
        } else {
            0.0
        };
        let symbol = if unit == "-" { "" } else { unit };
        match unit {
            // Long times are shown in s, not ks.
            "s" if exact >= 3.0 => return Self::plain(symbol),
            "m^2" => return Self::with_length_prefix(symbol, exact, 2),
            "m^3" => return Self::with_length_prefix(symbol, exact, 3),
            _ => {}
        }
        // Lengths are shown as 0.1 to 100, all other quantities as 1 to 1000.
        let shift = if unit == "m" { 1.0 } else { 0.0 };
        let thousands = ((exact + shift) / 3.0 + 1e-9).floor() as i32;
        let first = ["Pa", "Hz", "N", "J", "rad"];
        let takes_prefix =
            ["m", "s"].contains(&unit) || first.iter().any(|it| unit.starts_with(it));
        let prefix = usize::try_from(thousands + 4)
            .ok()
            .and_then(|it| PREFIXES.get(it));
        let (prefix, power) = match prefix {
            Some(prefix) if takes_prefix => (*prefix, 0),
            _ if (-3.0..5.0).contains(&exact) => return Self::plain(symbol),
            _ => ("", 3 * thousands),
        };
        Self {
            factor: 10f64.powi(-3 * thousands),
            prefix,
            power,
            ..Self::plain(symbol)
        }
    }

    /// The unit without a prefix.
    fn plain(symbol: &str) -> Self {
        Self {
            factor: 1.0,
            prefix: "",
            unit: symbol.to_owned(),
            power: 0,
        }
    }

    /// Unit of areas and volumes: square or cubic millimetres below a hundredth of a square or a thousandth of a cubic metre, and
    /// micrometres for smaller values.
    fn with_length_prefix(symbol: &str, exact: f64, dimensions: i32) -> Self {
        let prefix = match exact {
            exact if exact >= -f64::from(dimensions) => return Self::plain(symbol),
            exact if exact >= -3.0 - 3.0 * f64::from(dimensions) => ("m", 3),
            _ => ("u", 6),
        };
        Self {
            factor: 10f64.powi(prefix.1 * dimensions),
            prefix: prefix.0,
            ..Self::plain(symbol)
        }
    }

    /// The unit with its prefix.
    pub fn symbol(&self) -> String {
        format!("{}{}", self.prefix, self.unit)
    }

    /// A value in this unit, to four digits, without the unit.
    pub fn number(&self, value: f64) -> String {
        let number = four_digits(value * self.factor);
        match self.power {
            0 => number,
            power => format!("{number}e{power}"),
        }
    }

    /// A value with this unit, to four digits.
    pub fn value(&self, value: f64) -> String {
        format!("{} {}", self.number(value), self.symbol())
            .trim_end()
            .to_owned()
    }
}

/// Size below which a value in an SI unit is shown as zero, as the rounding error of a sum: 10^-20 for most units, for lengths far less
/// than an atom.
fn least(unit: &str) -> f64 {
    match unit {
        "m" => 1e-15,
        "m^2" => 1e-24,
        "m^3" => 1e-36,
        _ => 1e-20,
    }
}

/// Share of the largest value of a column or curve below which a value is only rounding.
const NOTHING: f64 = 1e-12;

/// A value, or 0 where it is only rounding compared with the largest value of its column or curve.
pub fn zero_if_rounding(value: f64, largest: f64) -> f64 {
    if value.abs() < NOTHING * largest.abs() {
        0.0
    } else {
        value
    }
}

/// A value in an SI unit: 0 where it is so small that it is only rounding.
pub fn without_rounding(value: f64, unit: &str) -> f64 {
    if value.abs() < least(unit) {
        0.0
    } else {
        value
    }
}

/// Formats a value in an SI unit: `quantity(6.4e5, "N")` is `640.0 kN`; `-` is no unit.
pub fn quantity(value: f64, unit: &str) -> String {
    let value = without_rounding(value, unit);
    PrefixedUnit::new(unit, value.abs()).value(value)
}

/// Formats a smallest and a largest value in one unit: `1.113 to 2.264 mm`; one value where both are formatted alike.
pub fn between([min, max]: [f64; 2], unit: &str) -> String {
    let shown = PrefixedUnit::new(unit, min.abs().max(max.abs()));
    let [low, high] = [min, max].map(|value| shown.number(value));
    if low == high {
        shown.value(max)
    } else {
        format!("{low} to {}", shown.value(max))
    }
}

/// Formats a position: `(12.50, -3.000) mm`.
pub fn place(position: &[f64]) -> String {
    let largest = position.iter().map(|it| it.abs()).fold(0.0, f64::max);
    let shown = PrefixedUnit::new("m", largest);
    let coordinates: Vec<String> = position.iter().map(|&it| shown.number(it)).collect();
    format!("({}) {}", coordinates.join(", "), shown.symbol())
}

/// Formats a number with four significant digits.
pub fn four_digits(value: f64) -> String {
    if !value.is_finite() {
        return format!("{}", value.abs());
    }
    // A value below nine decimals is negligible in the unit, such as a rounding error of a force in kN.
    if value.abs() < 5e-10 {
        return "0".to_owned();
    }
    // The power of ten after rounding: 999.96 has four digits as 1000.
    let rounded = format!("{value:.3e}");
    let power = rounded.split_once('e').and_then(|(_, it)| it.parse().ok());
    let decimals = (3 - power.unwrap_or(0)).clamp(0, 9);
    format!("{value:.*}", decimals as usize)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantities_have_four_digits_and_the_prefix_that_makes_them_short() {
        for (unit, value, expected) in [
            ("m", 1.8e-4, "0.1800 mm"),
            ("m", -0.05, "-50.00 mm"),
            ("m", 2e-7, "0.2000 um"),
            ("m", 0.0, "0 m"),
            // Remainders of sums that cancel.
            ("N", -9.737e-27, "0 N"),
            ("m", 2.776e-17, "0 m"),
            ("J", 1e-19, "100.0e-21 J"),
            ("m", 0.25, "0.2500 m"),
            ("N", 644_761.3, "644.8 kN"),
            ("N", 999.96, "1000 N"),
            ("N/m", 2.89e10, "28.90 GN/m"),
            ("N m", 0.012, "12.00 mN m"),
            ("Pa", 4e6, "4.000 MPa"),
            ("J/m^2", 104.25, "104.2 J/m^2"),
            ("J/m^3", 3.2e3, "3.200 kJ/m^3"),
            ("m^2", 7.852e-3, "7852 mm^2"),
            ("m^2", 0.1875, "0.1875 m^2"),
            ("m^2", 1e-11, "10.00 um^2"),
            ("m^3", 7.852e-3, "0.007852 m^3"),
            ("m^3", 2e-6, "2000 mm^3"),
            ("s", 7.25e-5, "72.50 us"),
            ("s", 0.25, "250.0 ms"),
            ("s", 3600.0, "3600 s"),
            ("m/s", 1250.0, "1250 m/s"),
            ("K", 120.0, "120.0 K"),
            ("1/K", 1.1e-5, "11.00e-6 1/K"),
            ("-", 0.4, "0.4000"),
            ("-", 2.54e-4, "254.0e-6"),
            ("-", 190.06, "190.1"),
        ] {
            assert_eq!(quantity(value, unit), expected, "{value} {unit}");
        }
    }

    #[test]
    fn what_is_nothing_beside_the_largest_is_zero() {
        assert_eq!(zero_if_rounding(2.093e-31, 5.0), 0.0);
        assert_eq!(zero_if_rounding(-3e-12, 2.0), -3e-12);
        assert_eq!(zero_if_rounding(0.0, 0.0), 0.0);
    }

    #[test]
    fn ranges_and_places_have_one_unit() {
        assert_eq!(between([1.1131e-3, 2.2642e-3], "m"), "1.113 to 2.264 mm");
        assert_eq!(between([3e-3, 3.0000001e-3], "m"), "3.000 mm");
        assert_eq!(between([-1.0, 2e4], "N"), "-0.001000 to 20.00 kN");
        assert_eq!(between([1e-4, 2e-4], "-"), "100.0e-6 to 200.0e-6");
        assert_eq!(between([7e-28, 6155.0], "N"), "0 to 6.155 kN");
        assert_eq!(place(&[0.0125, -3e-3]), "(12.50, -3.000) mm");
    }
}
