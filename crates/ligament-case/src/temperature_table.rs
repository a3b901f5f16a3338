//! Temperatures from a table of comma-separated values.

use std::path::Path;

use ligament::setup::Sample;

use crate::input_file;

/// Reads the rows of a file, each with its line number; as the error a description of the fault.
pub(crate) fn rows_of(path: &Path, dimensions: usize) -> Result<Vec<(usize, Sample)>, String> {
    let text = input_file::read_text(path)
        .map_err(|source| format!("cannot read {}: {source}", path.display()))?;
    rows(&text, dimensions).map_err(|(line, reason)| format!("{}:{line}: {reason}", path.display()))
}

/// Parses the rows below the header; blank lines and lines that begin with # are ignored.
fn rows(text: &str, dimensions: usize) -> Result<Vec<(usize, Sample)>, (usize, String)> {
    // Spreadsheets write a byte order mark at the beginning of a file.
    let lines = text.trim_start_matches('\u{feff}').lines();
    let mut lines = (1..)
        .zip(lines.map(str::trim))
        .filter(|(_, text)| !text.is_empty() && !text.starts_with('#'));
    let axes = &["x", "y", "z"][..dimensions];
    let names: Vec<String> = axes.iter().map(|axis| format!("`{axis}`")).collect();
    let expected = format!(
        "the first row must name the columns {} (m) and `change` (K)",
        names.join(", ")
    );
    let Some((line, header)) = lines.next() else {
        return Err((1, format!("the file is empty: {expected}")));
    };
    let names: Vec<&str> = header.split(',').map(name_of).collect();
    let column = |wanted: &str| {
        let place = names.iter().position(|&name| name == wanted);
        place.ok_or_else(|| (line, format!("there is no column `{wanted}`: {expected}")))
    };
    let along: Vec<usize> = axes
        .iter()
        .map(|axis| column(axis))
        .collect::<Result<_, _>>()?;
    let of_change = column("change")?;
    let row = |(line, text): (usize, &str)| {
        let values: Vec<&str> = text.split(',').map(str::trim).collect();
        if values.len() != names.len() {
            let reason = format!(
                "{} values, but the header names {} columns",
                values.len(),
                names.len()
            );
            return Err((line, reason));
        }
        let value = |column: usize| {
            let number = values[column].parse::<f64>().ok();
            number
                .filter(|number| number.is_finite())
                .ok_or_else(|| (line, format!("`{:.40}` is no number", values[column])))
        };
        let mut position = [0.0; 3];
        for (coordinate, &column) in position.iter_mut().zip(&along) {
            *coordinate = value(column)?;
        }
        let sample = Sample {
            position,
            change: value(of_change)?,
        };
        Ok((line, sample))
    };
    lines.map(row).collect()
}

fn name_of(text: &str) -> &str {
    text.trim().trim_matches('"')
}
