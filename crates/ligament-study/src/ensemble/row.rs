//! A sample as a row of a table.

use ligament::body::Body;
use ligament::ensemble::Sample;
use ligament_analysis::driver::LoadPoint;
use ligament_output::Error;
use ligament_output::csv::Value;
use ligament_output::csv::read;
use ligament_run::summary::DROP;

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

/// A sample as a row of a table.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Row {
    /// Number of the sample.
    pub(super) sample: u64,
    seed: u64,
    /// First breakage; none where no bond broke.
    first: Option<First>,
    /// Largest load and its displacement; none without an equilibrium under load.
    peak: Option<[f64; 2]>,
    /// Largest load before the load first fell, and its displacement.
    first_peak: Option<[f64; 2]>,
    broken_bonds: u64,
    termination: String,
}

/// Load, displacement and place of the first breakage.
#[derive(Debug, Clone, Copy, PartialEq)]
struct First {
    at: [f64; 2],
    /// Tags of the ends of the first bond in the order of the file.
    ends: [i64; 2],
    /// Middle of this bond, m.
    middle: [f64; 3],
}

impl Row {
    /// The row of a sample of a body whose points have tags (n_points).
    pub(super) fn new(sample: &Sample, body: &dyn Body, tags: &[i64]) -> Self {
        let path = &sample.path;
        let first = path.first.first().map(|it| {
            let ends = body.numbering().ordered(it.ends);
            let [a, b] = ends.map(|end| body.position(end));
            let mut middle = [0.0; 3];
            for (value, (a, b)) in middle.iter_mut().zip(a.iter().zip(b)) {
                *value = 0.5 * (a + b);
            }
            First {
                at: [it.reaction, it.displacement],
                ends: ends.map(|end| tags[end as usize]),
                middle,
            }
        });
        let load = |it: LoadPoint| [it.reaction, it.displacement];
        let loaded = |it: &LoadPoint| it.load_factor != 0.0;
        Self {
            sample: sample.number,
            seed: sample.seed,
            first,
            peak: path.outcome.peak().filter(loaded).map(load),
            first_peak: path.outcome.first_peak(DROP).filter(loaded).map(load),
            broken_bonds: path.outcome.broken_bonds as u64,
            termination: path.outcome.termination.name().to_owned(),
        }
    }

    /// The values of the [`COLUMNS`].
    pub(super) fn values(&self) -> Vec<Value<'_>> {
        let mut values = vec![Value::Count(self.sample), Value::Count(self.seed)];
        match &self.first {
            Some(First { at, ends, middle }) => {
                values.extend(at.map(Value::Float));
                values.extend(ends.map(Value::Integer));
                values.extend(middle.map(Value::Float));
            }
            None => values.extend([Value::Missing; 7]),
        }
        for point in [self.peak, self.first_peak] {
            values.extend(point.map_or([Value::Missing; 2], |it| it.map(Value::Float)));
        }
        values.push(Value::Count(self.broken_bonds));
        values.push(Value::Text(&self.termination));
        values
    }

    /// Reads a row back.
    pub(super) fn read(row: read::Row<'_>) -> Result<Self, Error> {
        let is_given = |column: &str| Ok::<_, Error>(!row.value::<String>(column)?.is_empty());
        let pair = |columns: [&str; 2]| {
            let [one, other] = columns;
            Ok::<_, Error>(match is_given(one)? {
                true => Some([row.number(one)?, row.number(other)?]),
                false => None,
            })
        };
        let first = match pair(["first_load", "first_displacement"])? {
            None => None,
            Some(at) => Some(First {
                at,
                ends: [row.value("point_a")?, row.value("point_b")?],
                middle: [row.number("x")?, row.number("y")?, row.number("z")?],
            }),
        };
        Ok(Self {
            sample: row.value("sample")?,
            seed: row.value("seed")?,
            first,
            peak: pair(["peak_load", "peak_displacement"])?,
            first_peak: pair(["first_peak_load", "first_peak_displacement"])?,
            broken_bonds: row.value("broken_bonds")?,
            termination: row.value("termination")?,
        })
    }

    /// Load at the first breakage.
    pub(super) fn first_load(&self) -> Option<f64> {
        self.first.map(|it| it.at[0])
    }

    /// Largest load.
    pub(super) fn peak_load(&self) -> Option<f64> {
        self.peak.map(|it| it[0])
    }

    /// Largest load before the load first fell.
    pub(super) fn first_peak_load(&self) -> Option<f64> {
        self.first_peak.map(|it| it[0])
    }
}
