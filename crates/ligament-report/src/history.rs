//! The table of the steps of a run, and the convergence of its iterations.

use std::path::Path;

use ligament_output::Error;
use ligament_output::csv::read::CsvTable;
use ligament_output::quantity::zero_if_rounding;
use ligament_plot::picture::units::AxisUnit;
use ligament_plot::stored_loading::StoredLoading;
use serde_json::{Value, json};

/// Digits of the numbers of the history.
const DIGITS: i32 = 7;

/// The columns of the history with their units, and for each row the number of iterations and the last residual.
///
/// # Errors
///
/// If a table cannot be used.
pub(crate) fn read(folder: &Path, loading: &StoredLoading) -> Result<Value, Error> {
    let path = folder.join("history.csv");
    if !path.is_file() {
        return Ok(json!([]));
    }
    let sheet = CsvTable::read(path)?;
    let mut columns = Vec::new();
    for (place, name) in sheet.columns().iter().enumerate() {
        // The name of a load may equal the name of an earlier column.
        if sheet.columns()[..place].contains(name) {
            continue;
        }
        let Ok(values) = sheet.values::<f64>(name) else {
            // The column has names of stages.
            continue;
        };
        let mut described = column(name, loading.unit_of(name), &values);
        described["isProbe"] = json!(loading.probes.contains_key(name));
        columns.push(described);
    }
    let steps = sheet.values::<usize>("step")?;
    columns.extend(iterations(folder, &steps)?);
    Ok(Value::Array(columns))
}

/// A column with its unit for display; values negligible beside the largest are zero.
pub(crate) fn column(name: &str, unit: &str, values: &[f64]) -> Value {
    let finite = values.iter().filter(|it| it.is_finite());
    let largest = finite.fold(0.0_f64, |largest, it| largest.max(it.abs()));
    let shown = shown(unit, largest);
    let rounded: Vec<f64> = (values.iter())
        .map(|it| rounded(zero_if_rounding(*it, largest)))
        .collect();
    json!({"name": name, "si": unit, "unit": shown.0, "shift": shown.1, "values": rounded})
}

/// A unit with its prefix, and the exponent of the power of ten that converts values from SI units.
pub(crate) fn shown(unit: &str, size: f64) -> (String, i32) {
    let shown = AxisUnit::new(unit, size);
    let shift = shown.factor.log10().round() as i32;
    (shown.unit, shift)
}

/// A number with the digits of the history.
fn rounded(value: f64) -> f64 {
    let digits = (DIGITS - 1) as usize;
    format!("{value:.digits$e}").parse().unwrap_or(value)
}

/// Columns over the rows of the history: number of iterations, and last residual.
fn iterations(folder: &Path, steps: &[usize]) -> Result<Vec<Value>, Error> {
    let path = folder.join("iterations.csv");
    if !path.is_file() {
        return Ok(Vec::new());
    }
    let rows = CsvTable::read(path)?.numbers(["step", "residual"])?;
    let mut counts = vec![0.0; steps.len()];
    let mut residuals = vec![0.0; steps.len()];
    let mut place = 0;
    for [step, residual] in rows {
        while steps.get(place).is_some_and(|it| (*it as f64) < step) {
            place += 1;
        }
        if steps.get(place).is_some_and(|it| *it as f64 == step) {
            counts[place] += 1.0;
            residuals[place] = residual;
        }
    }
    Ok(vec![
        column("iterations", "-", &counts),
        column("residual", "-", &residuals),
    ])
}
