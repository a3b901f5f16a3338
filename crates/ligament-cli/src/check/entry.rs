//! Lines of the report of a check.

use std::fmt::Display;
use std::io::{self, Write};

use ligament_output::quantity::{between, quantity};
use ligament_output::summary::Spread;

use crate::lines;

/// Writes a line with a name and its value.
pub(super) fn entry(out: &mut dyn Write, name: &str, value: impl Display) -> io::Result<()> {
    lines::entry(out, 21, name, value)
}

/// Writes a line with the smallest, largest and mean value of a quantity in an SI unit, `-` for none.
pub(super) fn spread(
    out: &mut dyn Write,
    name: &str,
    Spread { min, mean, max }: Spread,
    unit: &str,
) -> io::Result<()> {
    let values = between([min, max], unit);
    let mean = quantity(mean, unit);
    if values == mean {
        entry(out, name, values)
    } else {
        entry(out, name, format!("{values}, mean {mean}"))
    }
}

/// Text of a size in bytes, to a tenth of a megabyte.
pub(super) fn megabytes(bytes: f64) -> String {
    format!("{:.1} MB", bytes / 1e6)
}
