//! `ligament explain`: the history of a bond, or of all bonds of a point, from the results of a run.
//!
//! The steps with fields are restored from `model.vtu`, `breaks.csv`, `softening.csv` and the fields; deformations, stresses, limits and
//! utilisations are what the functions of the analysis read from them, as in the run.

mod bond_history;
mod files;
mod report;
mod words;

use std::io::Write;
use std::path::PathBuf;

use ligament_output::remedy::Remedy;
use ligament_output::results::stored::StoredRun;
use ligament_output::{check_file, write_file};
use thiserror::Error;

use self::bond_history::BondHistories;
use ligament_plot::stored_loading::stored_loading;

/// Bond or family to be explained.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Subject {
    /// The family of the point with this tag.
    Point(i64),
    /// The bond between two points with these tags.
    Bond([i64; 2]),
    /// The family of the point nearest to a position (coordinates of the case), m.
    At(Position),
}

/// A position in the coordinates of the case, m.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Position {
    /// Along x and y.
    InPlane([f64; 2]),
    /// Along x, y and z.
    InSpace([f64; 3]),
}

/// Request to `ligament explain`.
#[derive(Debug, Clone, PartialEq)]
pub struct Request {
    /// Folder with the results of a run.
    pub folder: PathBuf,
    /// Bond or family to be explained.
    pub subject: Subject,
    /// Path of a table with one row per bond and step.
    pub csv: Option<PathBuf>,
    /// Path of a JSON file with all data.
    pub json: Option<PathBuf>,
    /// Whether existing files may be replaced.
    pub force: bool,
}

/// Error of a request to `ligament explain`.
#[derive(Debug, Error)]
pub enum ExplainError {
    /// No point has the tag.
    #[error("there is no {tagged} {tag}: the tags go from {} to {}, and the nearest {}", .range[0], .range[1], nearest_words(.nearest))]
    UnknownTag {
        /// Kind of the tags, `node` or `cell`.
        tagged: &'static str,
        /// The tag.
        tag: i64,
        /// First and last tag.
        range: [i64; 2],
        /// Existing tags before and after the given one.
        nearest: Vec<i64>,
    },
    /// A position in the plane for a solid.
    #[error("the body is a solid, and a place in it has three coordinates")]
    InSpace(#[source] Remedy),
    /// A position in space for a body in the plane.
    #[error("the body lies in the plane, and a place in it has two coordinates")]
    InPlane(#[source] Remedy),
    /// A bond from a point to itself.
    #[error("a bond has two ends, and both are {tagged} {tag}")]
    OneEnd {
        /// Kind of the tags, `node` or `cell`.
        tagged: &'static str,
        /// The tag.
        tag: i64,
        /// The family in the place of a bond.
        #[source]
        remedy: Remedy,
    },
}

fn nearest_words(nearest: &[i64]) -> String {
    let tags: Vec<String> = nearest.iter().map(i64::to_string).collect();
    let verb = if tags.len() == 1 { "is" } else { "are" };
    format!("{verb} {}", tags.join(" and "))
}

/// Explains a bond or a family: prints its history, and writes the requested files.
///
/// # Errors
///
/// If the folder has no suitable results, there is no such point, or a file cannot be written.
pub fn explain(request: &Request, out: &mut dyn Write) -> anyhow::Result<()> {
    for path in request.csv.iter().chain(&request.json) {
        check_file(path, request.force)?;
    }
    let run = StoredRun::open(&request.folder)?;
    let loading = stored_loading(&request.folder)?;
    let family = |out: &mut dyn Write, point: u32, sought: Option<[f64; 3]>| {
        let lives = BondHistories::read(
            &run,
            |ends| ends.contains(&point),
            Some(point),
            loading.clone(),
        )?;
        report::family(out, &run, point, sought, &lives)?;
        anyhow::Ok(lives)
    };
    let lives = match request.subject {
        Subject::Point(tag) => family(out, point_of(&run, tag)?, None)?,
        Subject::At(position) => {
            let position = position_of(&run, position)?;
            family(out, nearest_point(&run, position), Some(position))?
        }
        Subject::Bond(tags) => {
            let [a, b] = [point_of(&run, tags[0])?, point_of(&run, tags[1])?];
            if a == b {
                let (tagged, tag) = (run.model.tagged, tags[0]);
                let remedy = Remedy::GiveNumber {
                    option: "point",
                    value: tag,
                };
                return Err(ExplainError::OneEnd {
                    tagged,
                    tag,
                    remedy,
                }
                .into());
            }
            let ends = [a.min(b), a.max(b)];
            let lives = BondHistories::read(&run, |it| *it == ends, None, loading)?;
            report::bond(out, &run, ends, &lives)?;
            lives
        }
    };
    if let Some(path) = &request.csv {
        write_file(path, files::csv(&run, &lives).as_bytes(), request.force)?;
        writeln!(out, "\ntable in {}", path.display())?;
    }
    if let Some(path) = &request.json {
        write_file(path, files::json(&run, &lives)?.as_bytes(), request.force)?;
        writeln!(out, "\neverything in {}", path.display())?;
    }
    Ok(())
}

/// The point with a tag.
fn point_of(run: &StoredRun, tag: i64) -> Result<u32, ExplainError> {
    let tags = || run.model.tags.iter().copied();
    if let Some(point) = tags().position(|it| it == tag) {
        return Ok(point as u32);
    }
    let below = tags().filter(|it| *it < tag).max();
    let above = tags().filter(|it| *it > tag).min();
    Err(ExplainError::UnknownTag {
        tagged: run.model.tagged,
        tag,
        range: [tags().min(), tags().max()].map(Option::unwrap_or_default),
        nearest: below.into_iter().chain(above).collect(),
    })
}

/// A position with z = 0 in the plane; refuses one in another dimension than the body's.
fn position_of(run: &StoredRun, position: Position) -> Result<[f64; 3], ExplainError> {
    match (run.model.in_space, position) {
        (true, Position::InSpace(position)) => Ok(position),
        (false, Position::InPlane([x, y])) => Ok([x, y, 0.0]),
        (true, Position::InPlane(_)) => Err(ExplainError::InSpace(give("at", "X,Y,Z"))),
        (false, Position::InSpace(_)) => Err(ExplainError::InPlane(give("at", "X,Y"))),
    }
}

fn give(option: &'static str, value: &'static str) -> Remedy {
    Remedy::Give { option, value }
}

/// The point nearest to a position, the first of several.
fn nearest_point(run: &StoredRun, position: [f64; 3]) -> u32 {
    let distance = |p: &[f64; 3]| words::distance(position, *p);
    let positions = run.model.positions.iter().enumerate();
    let nearest = positions.min_by(|(_, p), (_, q)| distance(p).total_cmp(&distance(q)));
    nearest.map_or(0, |(point, _)| point as u32)
}
