//! Files of the cracks of a stored run in the plane.
//!
//! | file | holds |
//! |---|---|
//! | `crack.csv`, `crack.vtu` | the lines of a step |
//! | `opened.vtu` | the cells of a mesh, opened along the lines, with the displacement and the damage of the step |
//! | `crack_tips.csv` | the tips in every record of the history in which cracks grew; in a motion their speeds |
//! | `crack_growth.csv` | length and area of all cracks in these records, and energies over the new area |

use std::path::Path;

use ligament_model::raised;
use ligament_post::crack::CrackLine;

use super::columns::{CRACK, CRACK_TIPS, TIP_SPEED, names};
use super::crack_growth::{CrackSize, ROWS, write_growth};
use super::cracks::{CrackRecord, StoredCracks};
use super::opened_files::{OPENED, write_opened_plane_cells};
use super::surface_files::fields_until;
use crate::Error;
use crate::atomic::remove_file;
use crate::csv::{Table, Value};
use crate::vtu::{self, Cell, Cells, Field, UnstructuredGrid};

/// Names of the files of cracks beside the results of a run.
pub const CRACK_FILES: [&str; 5] = [
    "crack.csv",
    "crack.vtu",
    "crack_tips.csv",
    "crack_growth.csv",
    OPENED,
];

/// A record of the history with its cracks.
struct RecordWithLines<'a> {
    record: &'a CrackRecord,
    lines: Vec<CrackLine>,
}

/// Writes the cracks of a step as lines, and their growth over all steps; returns the lines of the step.
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
    let opened = folder.join(CRACK_FILES[4]);
    let has_cells = match fields_until(folder, step)? {
        Some(fields) => write_opened_plane_cells(&opened, cracks, step, &fields)?,
        None => false,
    };
    if !has_cells {
        remove_file(&opened)?;
    }
    let grown: Vec<RecordWithLines<'_>> = (cracks.records_with_growth().into_iter())
        .map(|record| RecordWithLines {
            lines: cracks.lines_at(record),
            record,
        })
        .collect();
    write_tips(&folder.join(CRACK_FILES[2]), cracks, &grown)?;
    let least = cracks.thickness * cracks.mean_horizon();
    write_growth(
        &folder.join(CRACK_FILES[3]),
        [false, cracks.in_time],
        &sizes(cracks, &grown),
        least,
    )?;
    Ok(lines)
}

fn write_lines(path: &Path, step: usize, lines: &[CrackLine]) -> Result<(), Error> {
    let mut table = Table::create(path, &names(CRACK, false))?;
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

/// Writes the lines as line cells between their vertices; no file without lines, since readers refuse empty grids.
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
        cells: Cells::Mixed(&cells),
        point_fields: &[Field::scalar("along", &along)],
        cell_fields: &[Field::integer("line", &numbers)],
        field_data: &[],
    };
    vtu::write_vtu(path, &grid)
}

fn write_tips(
    path: &Path,
    cracks: &StoredCracks,
    grown: &[RecordWithLines<'_>],
) -> Result<(), Error> {
    let mut columns = names(CRACK_TIPS, false);
    if cracks.in_time {
        columns.extend(names(TIP_SPEED, false));
    }
    let mut table = Table::create(path, &columns)?;
    let reach = cracks.mean_horizon();
    let mut earlier: Vec<[f64; 2]> = Vec::new();
    // Times (s) and ways (m) of each earlier tip over the last rows.
    let mut courses: Vec<Vec<[f64; 2]>> = Vec::new();
    for RecordWithLines { record, lines } in grown {
        let tips: Vec<[f64; 2]> = lines.iter().flat_map(CrackLine::tips).collect();
        let mut new_courses = Vec::new();
        for (number, line) in (1_u32..).zip(lines) {
            let ways = line.advances_of_tips(&earlier, reach);
            for ([x, y], way) in line.tips().zip(ways) {
                let course = continued(&courses, way, record.load_factor);
                let speed = speed(&course);
                new_courses.push(course);
                let mut row = vec![
                    record.step.into(),
                    record.load_factor.into(),
                    record.displacement.into(),
                    number.into(),
                    x.into(),
                    y.into(),
                    record.load_factor.into(),
                    speed.map_or(Value::Missing, Value::from),
                ];
                row.truncate(columns.len());
                table.append(&row)?;
            }
        }
        (earlier, courses) = (tips, new_courses);
    }
    Ok(())
}

/// The course of a tip at a time (s): that of an earlier tip, given by its index, with a way (m) more; of a new tip its beginning.
fn continued(courses: &[Vec<[f64; 2]>], way: Option<(usize, f64)>, time: f64) -> Vec<[f64; 2]> {
    let (before, way) = match way {
        Some((tip, way)) => (courses[tip].as_slice(), way),
        None => (&[][..], 0.0),
    };
    let so_far = before.last().map_or(0.0, |it| it[1]);
    let kept = before.len().saturating_sub(ROWS);
    let with_now = before[kept..].iter().copied();
    with_now.chain([[time, so_far + way]]).collect()
}

/// Mean speed of a tip over its course, m/s; none at its beginning.
fn speed(course: &[[f64; 2]]) -> Option<f64> {
    let [first, .., last] = course else {
        return None;
    };
    Some((last[1] - first[1]) / (last[0] - first[0]))
}

/// Sizes of the cracks at the records.
fn sizes<'a>(cracks: &StoredCracks, records: &[RecordWithLines<'a>]) -> Vec<CrackSize<'a>> {
    let size = |RecordWithLines { record, lines }: &RecordWithLines<'a>| {
        // The sum of an empty iterator would be -0.0.
        let length = lines.iter().fold(0.0, |sum, line| sum + line.length());
        let tips = lines.iter().flat_map(CrackLine::tips).count();
        CrackSize {
            record,
            area: cracks.thickness * length,
            counts: vec![lines.len().into(), tips.into(), length.into()],
            length: Some(length),
        }
    };
    records.iter().map(size).collect()
}
