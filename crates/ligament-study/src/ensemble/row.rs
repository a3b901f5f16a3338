//! A sample as a row of a table.

use ligament::body::Body;
use ligament::ensemble::Sample;
use ligament_analysis::driver::LoadPoint;
use ligament_output::Error;
use ligament_output::csv::Value;
use ligament_output::csv::read::{self, StringRecord};
use ligament_run::summary::LOAD_DROP;

/// Columns of a sample.
pub(super) const COLUMNS: [&str; 15] = [
    "sample",
    "seed",
    "first_load",
    "first_displacement",
    "point_a",
    "point_b",
    "x",
    "y",
    "z",
    "peak_load",
    "peak_displacement",
    "first_peak_load",
    "first_peak_displacement",
    "broken_bonds",
    "termination",
];

/// The values of the [`COLUMNS`] for a sample of a body whose points have tags (n_points).
pub(super) fn values<'a>(sample: &Sample, body: &dyn Body, tags: &[i64]) -> Vec<Value<'a>> {
    let outcome = &sample.path.outcome;
    let mut values = vec![Value::Count(sample.number), Value::Count(sample.seed)];
    match sample.path.first.first() {
        Some(first) => {
            // The first bond in the order of the file, and its middle.
            let ends = body.numbering().ordered(first.ends);
            let [a, b] = ends.map(|end| body.position(end));
            let mut middle = [0.0; 3];
            for (value, (a, b)) in middle.iter_mut().zip(a.iter().zip(b)) {
                *value = 0.5 * (a + b);
            }
            values.extend([first.reaction, first.displacement].map(Value::Float));
            values.extend(ends.map(|end| Value::Integer(tags[end as usize])));
            values.extend(middle.map(Value::Float));
        }
        None => values.extend([Value::Missing; 7]),
    }
    // Without an equilibrium under load there is no peak.
    let loaded = |it: &LoadPoint| it.load_factor != 0.0;
    for point in [outcome.peak(), outcome.first_peak(LOAD_DROP)] {
        values.extend(match point.filter(loaded) {
            Some(it) => [it.reaction, it.displacement].map(Value::Float),
            None => [Value::Missing; 2],
        });
    }
    values.push(Value::from(outcome.broken_bonds));
    values.push(Value::Text(outcome.termination.name()));
    values
}

/// A stored sample.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Row {
    /// Number of the sample.
    pub(super) sample: u64,
    /// Texts of the [`COLUMNS`], then loads at the displacements of the grid.
    cells: StringRecord,
}

impl Row {
    /// Reads a row back.
    pub(super) fn read(row: read::Row<'_>) -> Result<Self, Error> {
        Ok(Self {
            sample: row.value("sample")?,
            cells: row.cells().clone(),
        })
    }

    /// The row as a line of a table of the [`COLUMNS`]; none of their texts needs quotes.
    pub(super) fn line(&self) -> String {
        let cells: Vec<&str> = self.cells.iter().take(COLUMNS.len()).collect();
        cells.join(",") + "\n"
    }

    /// The number in a column; none where the sample has none.
    pub(super) fn number(&self, column: &str) -> Option<f64> {
        let place = COLUMNS.iter().position(|it| *it == column)?;
        let number = self.cells[place].parse().ok();
        number.filter(|it: &f64| it.is_finite())
    }

    /// Load at a displacement of the grid; none where it is unknown.
    pub(super) fn load(&self, displacement: usize) -> Option<f64> {
        self.cells[COLUMNS.len() + displacement].parse().ok()
    }
}
