//! The results of a run as data of a page.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use ligament_output::csv::read::CsvTable;
use ligament_output::folder::RESOLVED_CASE;
use ligament_output::results::fields::DISPLACEMENT;
use ligament_output::results::outputs::{OutputKind, Outputs};
use ligament_output::results::stored::StoredRun;
use ligament_output::results::{StoredState, first_field_of, stored_rigid_bodies};
use ligament_output::vtu::read::VtuFile;
use ligament_output::{Error, read_text};
use ligament_plot::picture::stored_precracks;
use ligament_plot::stored_loading::stored_loading;
use serde_json::{Value, json};

use crate::body::Body;
use crate::bonds::Bonds;
use crate::columns::{Column, Digits};
use crate::fields::{self, Field};
use crate::history::{self, shown};
use crate::inputs::Inputs;
use crate::parts::{Budget, Choice, ColumnTexts};
use crate::{crack, sketch, summary};

/// Digits of positions, relative to the largest coordinate.
const PLACES: u32 = 6;

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
        texts: &mut ColumnTexts,
    ) -> Result<Self, Error> {
        let outputs = Outputs::list(folder)?;
        let peak = peak(&outputs)?;
        let files = chosen(&outputs, choice.steps, peak);
        let words = summary::run_summary(folder, outputs.kind)?;
        let case = read_text(&folder.join(RESOLVED_CASE))?;
        let loading = stored_loading(folder)?;
        let inputs = Inputs::read(folder, choice.unit_of)?;
        let states: Vec<StoredState> = files.keys().copied().collect();
        let steps: Vec<usize> = states.iter().map(|it| it.step).collect();
        let first = VtuFile::open(first_file(&files, folder)?)?;
        let body = Body::read(&first)?;
        let mut budget = Budget::new(choice.letters);
        let of = DrawnOutputs {
            outputs: &outputs,
            files: &files,
            body: &body,
            case: inputs.case(),
        };
        let mut description = of.describe(choice.digits, texts, &mut budget)?;
        let is_modes = outputs.kind == OutputKind::Modes;
        let history = match is_modes {
            true => modes(folder)?,
            false => history::read(folder, &loading)?,
        };
        let title = words.title.unwrap_or_else(|| label.to_owned());
        let own = json!({
            "label": label,
            "title": title,
            "kind": if is_modes { "modes" } else { "steps" },
            "steps": steps,
            "between": between_breakages(&files)?,
            "opensAt": match loading.in_time {
                true => steps.len().saturating_sub(1),
                false => states.iter().position(|it| Some(*it) == peak).unwrap_or(0),
            },
            "inTime": loading.in_time,
            "beforeBreakages": loading.follows_path,
            "history": history,
            "firstField": first_field_of(&outputs)?.name,
            "fractureEnergy": inputs.fracture_energy(),
        });
        if let (Value::Object(all), Value::Object(own)) = (&mut description, own) {
            all.extend(own);
        }
        Ok(Self {
            html: words.html + &inputs.html() + &summary::case_html(&case),
            points: body.tags.len(),
            steps: steps.len(),
            left_out: budget.left_out,
            description,
            title,
        })
    }
}

/// The drawn outputs of a run.
struct DrawnOutputs<'a> {
    outputs: &'a Outputs,
    /// Files of the states, or modes, of the page.
    files: &'a BTreeMap<StoredState, PathBuf>,
    body: &'a Body,
    /// The resolved case.
    case: &'a toml::Table,
}

impl DrawnOutputs<'_> {
    /// Body, cracks, fields and bonds, as far as the budget allows.
    fn describe(
        &self,
        digits: u32,
        texts: &mut ColumnTexts,
        budget: &mut Budget,
    ) -> Result<Value, Error> {
        let (folder, body) = (&self.outputs.folder, self.body);
        let run = stored_run(folder)?;
        let sketch = run.as_ref();
        let sketch = sketch.map(|run| sketch::describe(self.case, &run.model, body));
        let bonds = run.map(|run| Bonds::new(&run, body));
        let fields = fields::read(self.files, body, digits)?;
        let moved = fields.iter().find(|it| it.name == DISPLACEMENT.name);
        let before = texts.n_characters();
        let described = describe_body(body, moved.map_or(0.0, |it| it.usual), texts);
        let states: Vec<StoredState> = self.files.keys().copied().collect();
        let cracks = match self.outputs.kind {
            OutputKind::Modes => Value::Null,
            OutputKind::Steps => crack::describe(folder, &states, body, texts)?,
        };
        budget.try_take("body", texts.n_characters() - before);
        let fields: Vec<Value> = (fields.into_iter())
            .filter(|it| budget.try_take(&it.name, it.n_characters()))
            .map(|it| describe_field(it, self.outputs.kind, texts))
            .collect();
        let bonds = bonds
            .filter(|it| budget.try_take("bonds", it.n_characters()))
            .map_or(Value::Null, |it| describe_bonds(it, texts, budget));
        let precracks = match body.dimension {
            2 => stored_precracks(folder)?,
            _ => Vec::new(),
        };
        let precracks: Vec<&[f64]> = precracks.iter().map(|it| it.as_flattened()).collect();
        Ok(json!({
            "body": described,
            "fields": fields,
            "bonds": bonds,
            "cracks": cracks,
            "precracks": precracks,
            "rigid": rigid_bodies(self.files)?,
            "interfaces": {
                "points": body.interfaces.0,
                "places": body.interfaces.1.as_flattened(),
            },
            "sketch": sketch,
        }))
    }
}

/// Rigid bodies of a run: places and triangles, and the displacements of the places in each step of the page; null where it has none.
fn rigid_bodies(files: &BTreeMap<StoredState, PathBuf>) -> Result<Value, Error> {
    let mut ways = Vec::new();
    let mut first = None;
    for path in files.values() {
        let Some(rigid) = stored_rigid_bodies(path)? else {
            return Ok(Value::Null);
        };
        ways.push(rounded(&rigid.displacement));
        first.get_or_insert(rigid);
    }
    let bodies = first.unwrap_or_default();
    Ok(json!({
        "places": rounded(&bodies.places),
        "triangles": bodies.triangles.as_flattened(),
        "displacements": ways,
    }))
}

/// Breakages of its step before each state between them, with its load, by the place of the state in the page.
fn between_breakages(files: &BTreeMap<StoredState, PathBuf>) -> Result<Value, Error> {
    let mut between = serde_json::Map::new();
    for (place, (state, path)) in files.iter().enumerate() {
        if let Some(breakages) = state.breakages() {
            let file = VtuFile::open(path)?;
            let values = file.field_data()?;
            let value = |name: &str| values.iter().find(|it| it.0 == name).map(|it| it.1);
            let described = json!({
                "breakages": breakages,
                "displacement": value("load_displacement"),
                "reaction": value("load_reaction"),
            });
            between.insert(place.to_string(), described);
        }
    }
    Ok(Value::Object(between))
}

/// Coordinates of places one after the other in single precision.
fn rounded(places: &[[f64; 3]]) -> Vec<f32> {
    places.iter().flatten().map(|it| *it as f32).collect()
}

/// The step with fields under the largest load that the body carries; none for modes and for a run without a history.
fn peak(outputs: &Outputs) -> Result<Option<StoredState>, Error> {
    let history = outputs.folder.join("history.csv");
    if outputs.kind == OutputKind::Modes || !history.is_file() {
        return Ok(None);
    }
    let rows = CsvTable::read(history)?.numbers(["step", "reaction", "at_rest"])?;
    let state = |row: &[f64; 3]| StoredState::end(row[0] as usize);
    let stored = rows
        .into_iter()
        .filter(|it| outputs.files.contains_key(&state(it)));
    // States at rest come first: a state in which bonds were still breaking is not in equilibrium.
    let size = |[_, reaction, at_rest]: &[f64; 3]| (*at_rest, reaction.abs());
    let largest = stored.reduce(|largest, it| {
        if size(&it) > size(&largest) {
            it
        } else {
            largest
        }
    });
    Ok(largest.as_ref().map(state))
}

/// The files of the states of a page: all, or an even selection with the first state, the peak and the last state.
fn chosen(
    outputs: &Outputs,
    most: usize,
    peak: Option<StoredState>,
) -> BTreeMap<StoredState, PathBuf> {
    let count = outputs.files.len();
    if count <= most || outputs.kind == OutputKind::Modes {
        return outputs.files.clone();
    }
    let last = most.max(2) - 1;
    let places: Vec<usize> = (0..=last).map(|it| it * (count - 1) / last).collect();
    let numbered = outputs.files.iter().enumerate();
    let of_choice = numbered
        .filter(|(place, (state, _))| places.binary_search(place).is_ok() || Some(**state) == peak);
    of_choice
        .map(|(_, (state, path))| (*state, path.clone()))
        .collect()
}

/// First file of the states of a page; an error where no state was chosen.
fn first_file<'a>(
    files: &'a BTreeMap<StoredState, PathBuf>,
    folder: &Path,
) -> Result<&'a Path, Error> {
    let first = files.values().next().map(PathBuf::as_path);
    first.ok_or_else(|| Error::NoResults {
        path: folder.to_path_buf(),
        reason: "no step of it was chosen".to_owned(),
    })
}

/// The stored run with its bonds, if the run wrote its model.
fn stored_run(folder: &Path) -> Result<Option<StoredRun>, Error> {
    let is_there = folder.join("model.vtu").is_file() && folder.join("history.csv").is_file();
    is_there.then(|| StoredRun::open(folder)).transpose()
}

/// Data of the body; `usual` is the displacement that few points exceed, m.
fn describe_body(body: &Body, usual: f64, texts: &mut ColumnTexts) -> Value {
    let mut columns = |vectors: &[[f64; 3]]| -> Vec<Value> {
        let along = |axis: usize| -> Vec<f64> { vectors.iter().map(|it| it[axis]).collect() };
        (0..body.dimension)
            .map(|axis| texts.add(Column::single(&along(axis), Digits::OfLargest(PLACES))))
            .collect()
    };
    let position = columns(&body.positions);
    let half = match body.halves.is_empty() {
        true => Value::Null,
        false => json!(columns(&body.halves)),
    };
    json!({
        "dimension": body.dimension,
        "tagged": body.tagged,
        "size": body.size(),
        "usualDisplacement": finite(usual),
        "count": body.tags.len(),
        "position": position,
        "half": half,
        "nCorners": body.simplices.len(),
        "simplices": texts.add_whole(body.simplices.iter().copied()),
        "tags": texts.add_whole(body.tags.iter().copied()),
    })
}

fn describe_field(field: Field, kind: OutputKind, texts: &mut ColumnTexts) -> Value {
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

fn describe_bonds(bonds: Bonds, texts: &mut ColumnTexts, budget: &mut Budget) -> Value {
    let ends = bonds.ends.map(|it| texts.add(it));
    let mut columns = serde_json::Map::new();
    for (name, column) in bonds.columns {
        if budget.try_take(&format!("{name} of bonds"), column.n_characters()) {
            columns.insert(name, texts.add(column));
        }
    }
    let n_broken = bonds.utilisation_at_break.len();
    let [bond, step, round, criterion] = bonds.breaks.map(|it| texts.add_whole(it));
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
    let rows = CsvTable::read(folder.join("modes.csv"))?.numbers(["mode", "frequency_hz"])?;
    let [mode, frequency] = [0, 1].map(|it| rows.iter().map(|row| row[it]).collect::<Vec<f64>>());
    Ok(json!([
        history::column("step", "-", &mode),
        history::column("frequency", "Hz", &frequency),
    ]))
}
