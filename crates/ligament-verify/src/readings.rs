//! Interpretations of details that MPPD leaves open: the number of its micropolar values that each one meets (Tables 1 to 6).

use anyhow::ensure;
use ligament::run::Solution;

use super::case_run::{CaseRun, ResultCache, displacement_at, largest_displacements};
use super::experiment::{Compute, Experiment, Findings};
use super::named_modes::Frequencies;
use super::published::known_table;
use super::square_elements::SquareLoad;
use super::table::{Extent, Labels, Row, Table};

/// Experiment that compares the readings of the tables.
pub(super) const EXPERIMENT: Experiment = Experiment {
    name: "readings",
    title: "Readings of the micropolar tables",
    source: "Diana and Casolo (MPPD), Tables 1 to 6",
    setup: "The plates of `statics` and `frequencies` with the micropolar model, nu = -0.5, 0, 0.1 and 0.25 (at 1/3 k_t is \
            0, and PDS the same). Readings: k_t constant or of beams, constants from integrals or from sums over each \
            point's family, k_theta over that of the law, the surface correction, the 10 MPa spread over so many rows \
            of points or so many rows held, and displacements that are the largest of all points or those in the \
            middles of the sides. A reading is judged by the printed values it meets to the digits, and by the median \
            and the largest difference from them.",
    cases: &[TRACTION, SHEAR, BENDING, MODES],
    compute: Compute::Code(compute),
};

pub(super) const TRACTION: &str = "cases/verification/square-traction.toml";
pub(super) const SHEAR: &str = "cases/verification/square-shear.toml";
pub(super) const BENDING: &str = "cases/verification/square-bending.toml";
const MODES: &str = "cases/verification/square-modes.toml";

/// Axis of the plate of the modes, which is supported at its base: y.
const ALONG: usize = 1;

/// Number of points along a side of the static plates.
const POINTS: u32 = 61;

/// Spacing of the points, and half-width of the plate including the cells of its outermost points, m.
const SPACING: f64 = 0.01;
const HALF_WIDTH: f64 = 0.305;

/// Half-width between the outermost points, m.
const MIDDLE: f64 = 0.3;

/// Force on a point under a load on one row, N.
const FORCE: f64 = 100.0;

fn compute(extent: Extent) -> anyhow::Result<Findings> {
    let mut cache = ResultCache::default();
    let statics = known_table("mppd-readings-statics")?.judge(extent, |labels| {
        score(labels, &mut cache, || static_tables(labels))
    })?;
    let mut cache = ResultCache::default();
    let frequencies = known_table("mppd-readings-frequencies")?.judge(extent, |labels| {
        score(labels, &mut cache, || modal_tables(labels))
    })?;
    Ok(Findings {
        tables: vec![statics, frequencies],
        plots: Vec::new(),
        ..Findings::default()
    })
}

/// Displacements of a run for the tables, m.
#[derive(Debug, Clone, Copy)]
struct Reading {
    /// Largest |u_x| and |u_y| of all points.
    largest: [f64; 2],
    /// Values |u_x| and |u_y| in the middles of the right and the upper side.
    middle: [f64; 2],
    /// Mean of u_x at the middle of the upper side and u_y at the middle of the right side, independent of a rigid rotation, in both entries.
    mean_of_sides: [f64; 2],
}

impl Reading {
    fn from_solution(solution: &Solution) -> anyhow::Result<Self> {
        let at = |x, y| displacement_at(solution, [x, y]);
        Ok(Self {
            largest: largest_displacements(solution)?,
            middle: [at(MIDDLE, 0.0)[0].abs(), at(0.0, MIDDLE)[1].abs()],
            mean_of_sides: [0.5 * (at(0.0, MIDDLE)[0] + at(MIDDLE, 0.0)[1]); 2],
        })
    }
}

/// The case with a load.
pub(super) fn case_path(load: SquareLoad) -> &'static str {
    match load {
        SquareLoad::Traction => TRACTION,
        SquareLoad::Shear => SHEAR,
        SquareLoad::Bending => BENDING,
    }
}

/// Agreement of an interpretation with the printed values.
#[derive(Debug, Clone, Copy)]
struct Score {
    /// Number of values met to the printed digits.
    met: usize,
    /// Median and largest difference, %.
    median: f64,
    largest: f64,
}

/// The statistic of an entry (label `of`), for the tables under its interpretation.
fn score(
    labels: Labels<'_>,
    cache: &mut ResultCache<Score>,
    tables: impl FnOnce() -> anyhow::Result<Vec<Table>>,
) -> anyhow::Result<f64> {
    let of = labels.text("of")?;
    let shown = labels.to_string();
    let reading = shown.trim_end_matches(of).to_owned();
    let score = cache.result(reading, || Score::from_tables(&tables()?))?;
    Ok(match of {
        "met" => score.met as f64,
        "median" => score.median,
        _ => score.largest,
    })
}

impl Score {
    /// The score of tables; entries that are not computed do not count.
    fn from_tables(tables: &[Table]) -> anyhow::Result<Self> {
        let counts = |row: &&Row| row.computed.is_finite() && row.entry.known.value() != 0.0;
        let rows = || tables.iter().flat_map(|table| &table.rows).filter(counts);
        let off = |row: &Row| 100.0 * (row.computed / row.entry.known.value() - 1.0).abs();
        let mut differences: Vec<f64> = rows().map(off).collect();
        differences.sort_by(f64::total_cmp);
        ensure!(!differences.is_empty(), "no printed value counts");
        Ok(Self {
            met: rows()
                .filter(|row| row.entry.known.is_rounded_from(row.computed))
                .count(),
            median: differences[differences.len() / 2],
            largest: differences[differences.len() - 1],
        })
    }
}

/// Whether an entry of the paper's tables is of the micropolar lattice with a nonzero k_t.
fn is_micropolar(printed: Labels<'_>) -> anyhow::Result<bool> {
    Ok(printed.text("model")? == "MPPD" && printed.text("nu")? != "1/3")
}

/// Tables 1 to 3 under an interpretation.
fn static_tables(reading: Labels<'_>) -> anyhow::Result<Vec<Table>> {
    let rows: u32 = reading.text("rows")?.parse()?;
    let is_largest = reading.text("point")? == "largest";
    let mut cache = ResultCache::default();
    let mut table = |table: &str, load: SquareLoad| {
        known_table(table)?.judge(Extent::Full, |printed| {
            if !is_micropolar(printed)? {
                return Ok(f64::NAN);
            }
            let case_run = loaded_on(CaseRun::from_file(case_path(load))?, load, rows);
            let case_run =
                with_law(case_run, reading)?.set("material.poisson", printed.number("nu")?);
            let found = cache.reading(&case_run, Reading::from_solution)?;
            let [x, y] = match load {
                SquareLoad::Shear => found.mean_of_sides,
                SquareLoad::Traction if !is_largest => found.middle,
                SquareLoad::Traction | SquareLoad::Bending => found.largest,
            };
            Ok(1e3
                * if printed.text("component")? == "u_x" {
                    x
                } else {
                    y
                })
        })
    };
    Ok(vec![
        table("mppd-table-1", SquareLoad::Traction)?,
        table("mppd-table-2", SquareLoad::Shear)?,
        table("mppd-table-3", SquareLoad::Bending)?,
    ])
}

/// Tables 4 to 6 under an interpretation.
fn modal_tables(reading: Labels<'_>) -> anyhow::Result<Vec<Table>> {
    let rows: u32 = reading.text("rows")?.parse()?;
    let mut cache = ResultCache::default();
    let mut table = |table: &str, mode: &str| {
        known_table(table)?.judge(Extent::Full, |printed| {
            if !is_micropolar(printed)? || printed.text("of")? != "lattice" {
                return Ok(f64::NAN);
            }
            let case_run = with_law(CaseRun::from_file(MODES)?, reading)?
                .set("lattice.set.base.bottom", rows)
                .set("material.poisson", printed.number("nu")?);
            let found = cache.result(case_run.command(), || {
                Frequencies::from_case_run(&case_run, ALONG)
            });
            found?.named(mode)
        })
    };
    Ok(vec![
        table("mppd-table-4", "flexural")?,
        table("mppd-table-5", "axial")?,
        table("mppd-table-6", "second_flexural")?,
    ])
}

/// A case run with the model of an interpretation.
fn with_law(case_run: CaseRun, reading: Labels<'_>) -> anyhow::Result<CaseRun> {
    Ok(case_run
        .set("model.law", reading.text("law")?)
        .set("model.calibration", reading.text("calibration")?)
        .set("model.rotational_factor", reading.number("k_theta")?)
        .set("correction.surface", reading.text("surface")?))
}

/// A case run with the load on the outermost `rows` rows of points.
fn loaded_on(case_run: CaseRun, load: SquareLoad, rows: u32) -> CaseRun {
    match load {
        SquareLoad::Traction => case_run
            .set("lattice.set.top.top", rows)
            .set("lattice.set.bottom.bottom", rows),
        SquareLoad::Bending => case_run
            .set("lattice.set.left.left", rows)
            .set("lattice.set.right.right", rows),
        SquareLoad::Shear => {
            let (far, near) = (HALF_WIDTH, HALF_WIDTH - SPACING * f64::from(rows));
            let total = FORCE * f64::from(POINTS - 2 * rows);
            case_run
                .set("lattice.set.top.box", [[-near, near], [near, far]])
                .set("lattice.set.bottom.box", [[-near, -far], [near, -near]])
                .set("lattice.set.left.box", [[-far, -near], [-near, near]])
                .set("lattice.set.right.box", [[near, -near], [far, near]])
                .set("load.0.force.x", total)
                .set("load.1.force.x", -total)
                .set("load.2.force.y", total)
                .set("load.3.force.y", -total)
        }
    }
}
