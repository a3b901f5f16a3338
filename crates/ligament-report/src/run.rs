//! The results of a run as data of a page.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use ligament_output::csv::read::Sheet;
use ligament_output::folder::RESOLVED_CASE;
use ligament_output::results::cracks::StoredCracks;
use ligament_output::results::fields::DISPLACEMENT;
use ligament_output::results::outputs::{OutputKind, Outputs};
use ligament_output::results::solid_cracks::has_solid;
use ligament_output::results::stored::StoredRun;
use ligament_output::vtu::read::VtuFile;
use ligament_output::{Error, read_text};
use ligament_plot::picture::stored_precracks;
use ligament_plot::stored_loading::stored_loading;
use serde_json::{Value, json};

use crate::body::Body;
use crate::bonds::Bonds;
use crate::columns::{Column, Digits};
use crate::error::ReportError;
use crate::fields::{self, Field};
use crate::history::{self, shown};
use crate::parts::{Budget, Choice, Drawn, Stored, Texts};
use crate::{solid, summary};

/// Digits of positions, relative to the largest coordinate.
const PLACES: u32 = 6;

/// Default number of steps of a body in the plane, which the page draws.
const DRAWN: usize = 60;

/// Default number of steps of a solid, with a picture for each step, view and field.
const PICTURED: usize = 12;

/// A run in a page.
#[derive(Debug)]
pub(crate) struct PageRun {
    /// Data for the viewer.
    pub(crate) description: Value,
    /// Summary, warnings and case as HTML.
    pub(crate) html: String,
    /// Title of the case.
    pub(crate) title: String,
    /// Number of points of the body.
    pub(crate) points: usize,
    /// Number of steps, or modes.
    pub(crate) steps: usize,
    /// Names of fields and properties of bonds that are not in the page.
    pub(crate) left_out: Vec<String>,
}

impl PageRun {
    /// Reads the results in a folder.
    ///
    /// # Errors
    ///
    /// If there are no results, or a file cannot be used.
    pub(crate) fn read(
        folder: &Path,
        label: &str,
        choice: Choice,
        texts: &mut Texts,
    ) -> Result<Self, ReportError> {
        let outputs = Outputs::list(folder)?;
        let is_solid = has_solid(folder)?;
        let usual = if is_solid { PICTURED } else { DRAWN };
        let files = chosen(&outputs, choice.steps.unwrap_or(usual))?;
        let words = summary::in_words(folder, outputs.kind)?;
        let case = read_text(&folder.join(RESOLVED_CASE))?;
        let steps: Vec<usize> = files.keys().copied().collect();
        let first = VtuFile::open(first(&files, folder)?)?;
        let of = Stored {
            folder,
            files: &files,
            kind: outputs.kind,
        };
        let drawn = match is_solid {
            true => solid::drawn(&of, &first, choice, texts)?,
            false => drawn(&of, &first, choice, texts)?,
        };
        let is_modes = outputs.kind == OutputKind::Modes;
        let history = match is_modes {
            true => modes(folder)?,
            false => history::read(folder)?,
        };
        let title = words.title.unwrap_or_else(|| label.to_owned());
        let follows_path = stored_loading(folder)?.follows_path;
        let mut description = json!({
            "label": label,
            "title": title,
            "kind": if is_modes { "modes" } else { "steps" },
            "steps": steps,
            "beforeBreakages": follows_path,
            "history": history,
        });
        if let (Value::Object(all), Value::Object(parts)) = (&mut description, drawn.parts) {
            all.extend(parts);
        }
        Ok(Self {
            html: words.html + &summary::case_html(&case),
            points: drawn.points,
            steps: steps.len(),
            left_out: drawn.left_out,
            description,
            title,
        })
    }
}

/// Contents for a body in the plane, which the page draws: fields, bonds and cracks.
fn drawn(
    of: &Stored<'_>,
    first: &VtuFile,
    choice: Choice,
    texts: &mut Texts,
) -> Result<Drawn, ReportError> {
    let body = Body::read(first)?;
    let bonds = stored(of.folder)?.map(|run| Bonds::new(&run, &body));
    let fields = fields::read(of.files, &body, choice.digits)?;
    let moved = fields.iter().find(|it| it.name == DISPLACEMENT.name);
    let before = texts.letters();
    let described = describe_body(&body, moved.map_or(0.0, |it| it.usual), texts);
    let of_body = texts.letters() - before;
    let mut budget = Budget::new(choice.letters.saturating_sub(of_body));
    let fields: Vec<Value> = (fields.into_iter())
        .filter(|it| budget.takes(&it.name, it.letters()))
        .map(|it| describe_field(it, of.kind, texts))
        .collect();
    let bonds = bonds
        .filter(|it| budget.takes("bonds", it.letters()))
        .map_or(Value::Null, |it| describe_bonds(it, texts, &mut budget));
    let steps: Vec<usize> = of.files.keys().copied().collect();
    let cracks = match of.kind {
        OutputKind::Modes => Value::Null,
        OutputKind::Steps => cracks(of.folder, &steps)?,
    };
    let precracks = stored_precracks(of.folder)?;
    let precracks: Vec<&[f64]> = precracks.iter().map(|it| it.as_flattened()).collect();
    Ok(Drawn {
        parts: json!({
            "body": described,
            "fields": fields,
            "bonds": bonds,
            "cracks": cracks,
            "precracks": precracks,
            "pictures": Value::Null,
        }),
        points: body.tags.len(),
        left_out: budget.left_out,
    })
}

/// The files of the steps of a page: all, or an even selection with the first step, the peak and the last step.
fn chosen(outputs: &Outputs, most: usize) -> Result<BTreeMap<usize, PathBuf>, Error> {
    let count = outputs.files.len();
    if count <= most || outputs.kind == OutputKind::Modes {
        return Ok(outputs.files.clone());
    }
    let history = outputs.folder.join("history.csv");
    let peak = match history.is_file() {
        true => {
            let rows = Sheet::read(history)?.numbers(["step", "reaction"])?;
            let largest = rows.into_iter().max_by(|a, b| a[1].total_cmp(&b[1]));
            largest.map(|it| it[0] as usize)
        }
        false => None,
    };
    let last = most.max(2) - 1;
    let places: Vec<usize> = (0..=last).map(|it| it * (count - 1) / last).collect();
    let numbered = outputs.files.iter().enumerate();
    let of_choice = numbered
        .filter(|(place, (step, _))| places.binary_search(place).is_ok() || Some(**step) == peak);
    Ok(of_choice
        .map(|(_, (step, path))| (*step, path.clone()))
        .collect())
}

/// The first file.
fn first<'a>(files: &'a BTreeMap<usize, PathBuf>, folder: &Path) -> Result<&'a Path, Error> {
    let first = files.values().next().map(PathBuf::as_path);
    first.ok_or_else(|| Error::NoResults {
        path: folder.to_path_buf(),
        reason: "no step of it was chosen".to_owned(),
    })
}

/// The stored run with its bonds, if the run wrote its model.
fn stored(folder: &Path) -> Result<Option<StoredRun>, Error> {
    let is_there = folder.join("model.vtu").is_file() && folder.join("history.csv").is_file();
    is_there.then(|| StoredRun::open(folder)).transpose()
}

/// Data of the body; `usual` is the displacement that few points exceed, m.
fn describe_body(body: &Body, usual: f64, texts: &mut Texts) -> Value {
    let mut places = |positions: &[[f64; 2]]| {
        [0, 1].map(|axis| {
            let along: Vec<f64> = positions.iter().map(|it| it[axis]).collect();
            texts.add(Column::single(&along, Digits::OfLargest(PLACES)))
        })
    };
    let position = places(&body.positions);
    let corner = match body.corners.is_empty() {
        true => Value::Null,
        false => json!(places(&body.corners)),
    };
    let corners_of_triangles = body.triangles.as_flattened();
    json!({
        "tagged": body.tagged,
        "size": body.size(),
        "usualDisplacement": finite(usual),
        "count": body.tags.len(),
        "position": position,
        "corner": corner,
        "nTriangles": body.triangles.len(),
        "triangles": texts.add(Column::whole(corners_of_triangles.iter().map(|&it| i64::from(it)))),
        "tags": texts.add(Column::whole(body.tags.iter().copied())),
    })
}

fn describe_field(field: Field, kind: OutputKind, texts: &mut Texts) -> Value {
    // The amplitude of a mode is arbitrary.
    let unit = match kind {
        OutputKind::Steps => field.unit,
        OutputKind::Modes => "-",
    };
    let (unit, shift) = shown(unit, field.magnitude);
    json!({
        "name": field.name,
        "isMain": field.is_main(),
        "unit": unit,
        "shift": shift,
        "components": field.components,
        "ranges": field.ranges.iter().map(|it| it.map(finite)).collect::<Vec<_>>(),
        "magnitude": finite(field.magnitude),
        "columns": field.columns.into_iter().map(|it| texts.add(it)).collect::<Vec<_>>(),
    })
}

/// A finite number for JSON; 0 for NaN and infinity.
fn finite(value: f64) -> f64 {
    if value.is_finite() { value } else { 0.0 }
}

fn describe_bonds(bonds: Bonds, texts: &mut Texts, budget: &mut Budget) -> Value {
    let ends = bonds.ends.map(|it| texts.add(it));
    let mut columns = serde_json::Map::new();
    for (name, column) in bonds.columns {
        if budget.takes(&format!("{name} of bonds"), column.letters()) {
            columns.insert(name, texts.add(column));
        }
    }
    let n_broken = bonds.utilisation_at_break.len();
    let [bond, step, round, criterion] = bonds.breaks.map(|it| texts.add(Column::whole(it)));
    let utilisation = Column::single(&bonds.utilisation_at_break, Digits::OfLargest(5));
    json!({
        "count": bonds.count,
        "ends": ends,
        "columns": columns,
        "criteria": bonds.criteria,
        "breaks": {
            "count": n_broken,
            "bond": bond,
            "step": step,
            "round": round,
            "criterion": criterion,
            "utilisation": texts.add(utilisation),
        },
    })
}

/// Frequencies of the modes, as a table of one row per mode.
fn modes(folder: &Path) -> Result<Value, Error> {
    let rows = Sheet::read(folder.join("modes.csv"))?.numbers(["mode", "frequency_hz"])?;
    let [mode, frequency] = [0, 1].map(|it| rows.iter().map(|row| row[it]).collect::<Vec<f64>>());
    Ok(json!([
        history::column("step", "-", &mode),
        history::column("frequency", "Hz", &frequency),
    ]))
}

/// The crack lines of the steps, each a list of lines of coordinates x, y; `null` where unchanged from the step before.
fn cracks(folder: &Path, steps: &[usize]) -> Result<Value, Error> {
    let cracks = StoredCracks::open(folder)?;
    let mut before = Value::Null;
    let mut of_steps = Vec::new();
    for &step in steps {
        let lines = cracks.lines(step).into_iter();
        let coordinate = |it: &f64| (it * 1e7).round() / 1e7;
        let now: Value = lines
            .map(|line| {
                line.places
                    .as_flattened()
                    .iter()
                    .map(coordinate)
                    .collect::<Vec<f64>>()
            })
            .collect();
        of_steps.push(if now == before {
            Value::Null
        } else {
            now.clone()
        });
        before = now;
    }
    Ok(Value::Array(of_steps))
}
