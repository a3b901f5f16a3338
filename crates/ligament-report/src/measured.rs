//! Measured curves that a page draws over the curves of its runs.

use std::path::Path;

use ligament_output::csv::read::Sheet;
use serde_json::{Value, json};

use crate::error::ReportError;

/// A measured curve: a table of two columns of numbers, whose header names them with their units, as in `opening (mm),force (kN)`.
///
/// # Errors
///
/// If the table cannot be read, or has other than two columns of numbers.
pub(crate) fn read(path: &Path) -> Result<Value, ReportError> {
    let sheet = Sheet::read(path)?;
    let names = sheet.columns();
    let [x, y] = names else {
        return Err(ReportError::Measured {
            path: path.to_path_buf(),
            found: names.len(),
        });
    };
    let label = path.file_stem().unwrap_or_default().to_string_lossy();
    Ok(json!({
        "label": label,
        "names": [x.trim(), y.trim()],
        "values": [sheet.values::<f64>(x)?, sheet.values::<f64>(y)?],
    }))
}
