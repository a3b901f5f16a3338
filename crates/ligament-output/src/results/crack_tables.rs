//! The cracks of a stored run as files.
//!
//! | file | holds |
//! |---|---|
//! | `crack.csv`, `crack.vtu` | the lines of a step |
//! | `crack_tips.csv` | the tips in every record of the history in which cracks grew |
//! | `crack_growth.csv` | length and area of all cracks there, and energies over the new area |

use std::path::Path;

use ligament_analysis::energy_release::{GrowthState, ReleaseRates, release_rates};
use ligament_model::raised;
use ligament_post::crack::CrackLine;

use super::cracks::{CrackRecord, StoredCracks};
use crate::Error;
use crate::atomic::remove_file;
use crate::csv::{Table, Value};
use crate::vtu::{self, Cell, Field, UnstructuredGrid};

/// Files that are written beside the results of a run.
pub const CRACK_FILES: [&str; 4] = [
    "crack.csv",
    "crack.vtu",
    "crack_tips.csv",
    "crack_growth.csv",
];

/// Columns of `crack.csv`, of `crack_tips.csv` and of `crack_growth.csv`.
pub const CRACK_COLUMNS: [&[&str]; 3] = [
    &["step", "line", "x", "y", "along", "end"],
    &["step", "load_factor", "displacement", "line", "x", "y"],
    &[
        "step",
        "load_factor",
        "displacement",
        "reaction",
        "lines",
        "tips",
        "length",
        "area",
        "release_rate_compliance",
        "release_rate_energy",
        "dissipated_per_area",
    ],
];

/// A record of the history with its cracks.
struct CrackSize<'a> {
    record: &'a CrackRecord,
    lines: Vec<CrackLine>,
}

/// Writes the cracks of a step as lines, and how they grew over all steps; gives the lines of the step and the area of all, m^2.
///
/// # Errors
///
/// If a file cannot be written.
pub fn write_cracks(
    folder: &Path,
    cracks: &StoredCracks,
    step: usize,
) -> Result<Vec<CrackLine>, Error> {
    let lines = cracks.lines(step);
    write_lines(&folder.join(CRACK_FILES[0]), step, &lines)?;
    write_grid(&folder.join(CRACK_FILES[1]), &lines)?;
    let grown: Vec<CrackSize<'_>> = (cracks.grown_records().into_iter())
        .map(|record| CrackSize {
            lines: cracks.lines_at(record),
            record,
        })
        .collect();
    write_tips(&folder.join(CRACK_FILES[2]), &grown)?;
    write_growth(&folder.join(CRACK_FILES[3]), cracks, &grown)?;
    Ok(lines)
}

fn write_lines(path: &Path, step: usize, lines: &[CrackLine]) -> Result<(), Error> {
    let mut table = Table::create(path, CRACK_COLUMNS[0])?;
    for (number, line) in (1_u32..).zip(lines) {
        let last = line.places.len() - 1;
        for (place, (&[x, y], along)) in line.places.iter().zip(line.along()).enumerate() {
            let end = match place {
                0 => Value::Text(line.ends[0].word()),
                _ if place == last => Value::Text(line.ends[1].word()),
                _ => Value::Missing,
            };
            table.append(&[
                step.into(),
                number.into(),
                x.into(),
                y.into(),
                along.into(),
                end,
            ])?;
        }
    }
    Ok(())
}

/// Writes the lines as line cells between their places; no file without lines, which readers would refuse.
fn write_grid(path: &Path, lines: &[CrackLine]) -> Result<(), Error> {
    if lines.is_empty() {
        return remove_file(path);
    }
    let (mut points, mut cells) = (Vec::new(), Vec::new());
    let (mut numbers, mut along) = (Vec::new(), Vec::new());
    for (number, line) in (1_i64..).zip(lines) {
        let first = points.len() as u32;
        let segments = 0..line.places.len() as u32 - 1;
        numbers.extend(segments.clone().map(|_| number));
        cells.extend(segments.map(|it| Cell::Line([first + it, first + it + 1])));
        points.extend(raised(&line.places));
        along.extend(line.along());
    }
    let grid = UnstructuredGrid {
        points: &points,
        cells: &cells,
        point_fields: &[Field::scalar("along", &along)],
        cell_fields: &[Field::integer("line", &numbers)],
    };
    vtu::write_vtu(path, &grid)
}

fn write_tips(path: &Path, grown: &[CrackSize<'_>]) -> Result<(), Error> {
    let mut table = Table::create(path, CRACK_COLUMNS[1])?;
    for CrackSize { record, lines } in grown {
        for (number, line) in (1_u32..).zip(lines) {
            for [x, y] in line.tips() {
                table.append(&[
                    record.step.into(),
                    record.load_factor.into(),
                    record.displacement.into(),
                    number.into(),
                    x.into(),
                    y.into(),
                ])?;
            }
        }
    }
    Ok(())
}

fn write_growth(path: &Path, cracks: &StoredCracks, grown: &[CrackSize<'_>]) -> Result<(), Error> {
    let mut table = Table::create(path, CRACK_COLUMNS[2])?;
    // A sum of nothing would be -0.0.
    let length = |it: &CrackSize<'_>| (it.lines.iter()).fold(0.0, |sum, line| sum + line.length());
    let state = |it: &CrackSize<'_>| GrowthState {
        area: cracks.thickness * length(it),
        displacement: it.record.displacement,
        reaction: it.record.reaction,
        released_energy: it.record.released_energy,
        dissipated_energy: it.record.dissipated_energy,
    };
    let states: Vec<GrowthState> = grown.iter().map(state).collect();
    let rates = release_rates(&states, cracks.thickness * cracks.mean_horizon());
    for ((it, state), rates) in grown.iter().zip(&states).zip(rates) {
        let tips = it.lines.iter().flat_map(CrackLine::tips).count();
        let rate = |of: fn(&ReleaseRates) -> f64| {
            rates.as_ref().map_or(Value::Missing, |it| of(it).into())
        };
        table.append(&[
            it.record.step.into(),
            it.record.load_factor.into(),
            it.record.displacement.into(),
            it.record.reaction.into(),
            it.lines.len().into(),
            tips.into(),
            length(it).into(),
            state.area.into(),
            rate(|it| it.by_compliance),
            rate(|it| it.by_energy),
            rate(|it| it.dissipated),
        ])?;
    }
    Ok(())
}
