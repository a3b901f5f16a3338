//! The table of the runs of a study, under sweeps and ensembles: its [`folder`] with marker, locks and shards, the display of its
//! `progress`, and the files of its results. The kind of study determines its rows, which run comes next, and the evaluation. A
//! calibration, whose runs depend on each other, has one process and so neither shards nor parts.

pub mod folder;
pub(crate) mod progress;

use std::path::Path;

use ligament_output::csv::{Value, line};
use ligament_output::replace_file;
use ligament_plot::drawing::Drawing;

/// Width of a plot, mm.
pub(crate) const WIDTH: f64 = 160.0;

/// Dots per inch of a plot's PNG.
const DPI: f64 = 300.0;

/// Writes a plot as SVG and PNG.
pub(crate) fn write_plot(folder: &Path, name: &str, drawing: &Drawing) -> anyhow::Result<()> {
    let file = |ending| folder.join(format!("{name}.{ending}"));
    replace_file(&file("svg"), drawing.to_svg(name).as_bytes())?;
    replace_file(&file("png"), &drawing.to_png(DPI)?)?;
    Ok(())
}

/// Text of a table in CSV of the columns of a header such as `x,y`.
pub(crate) fn table<'a>(header: &str, rows: impl IntoIterator<Item = Vec<Value<'a>>>) -> String {
    let lines = rows.into_iter().map(|row| line(&row));
    format!("{header}\n{}", lines.collect::<String>())
}

/// A number of a table, or an empty field.
pub(crate) fn number<'a>(value: Option<f64>) -> Value<'a> {
    value.map_or(Value::Missing, Value::Float)
}
