//! The results of a run in its folder, as arrays, pictures and words.

use std::fs;
use std::path::{Path, PathBuf};

use ligament_case::case::key_path::KeyPath;
use ligament_case::case::keys::unit_of;
use ligament_cli::explain::{self, Position, Subject};
use ligament_output::Error;
use ligament_output::csv::read::CsvTable;
use ligament_output::folder::{REPORT, copy_results};
use ligament_output::results::bond_arrays::{BondArrays, positions_of_fields};
use ligament_output::results::columns::is_count;
use ligament_output::results::cracks::{StoredCracks, stored_openings};
use ligament_output::results::fields::{self, FieldReading, ResultField};
use ligament_output::results::location;
use ligament_output::results::outputs::{OutputKind, Outputs, kind_of, require_results};
use ligament_output::results::solid_cracks::{SolidCracks, has_solid};
use ligament_output::results::steps::StepChoice;
use ligament_output::results::{StoredState, stored_jumps};
use ligament_output::vtu::read::{TAG_NOUNS, VtuFile};
use ligament_plot::stored_loading::stored_loading;
use ligament_report::{DIGITS, MEGABYTE, SIZE, STEPS, write_report};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::arrays::{array, rows};
use crate::errors;

/// A folder with the results of a run.
#[pyclass(frozen, module = "ligament._native")]
pub(crate) struct Folder {
    /// Path of the folder.
    #[pyo3(get)]
    pub(crate) path: PathBuf,
    /// Whether the results are natural modes.
    #[pyo3(get)]
    is_modal: bool,
}

/// A line of a crack: vertices (n, 2), m, kinds of the ends, and length, m.
type Line<'py> = (Bound<'py, PyAny>, [&'static str; 2], f64);

/// Digits of the largest value of a field, largest number of steps, and size (MB) of a page; the usual ones where they are not given.
type Limits = (Option<u32>, Option<u32>, Option<f64>);

/// The exception of a fault in a folder.
fn folder_error(py: Python<'_>) -> impl Fn(Error) -> PyErr {
    move |error| errors::program_error(py, &error)
}

/// The state of a name, `45` or `45:120`.
fn stored_state(py: Python<'_>, name: &str) -> PyResult<StoredState> {
    name.parse()
        .map_err(|error: String| errors::request_error(py, &error))
}

#[pymethods]
impl Folder {
    /// The folder at a path.
    #[new]
    fn new(py: Python<'_>, path: PathBuf) -> PyResult<Self> {
        require_results(&path).map_err(folder_error(py))?;
        let is_modal = kind_of(&path) == OutputKind::Modes;
        let path = std::path::absolute(&path).unwrap_or(path);
        Ok(Self { path, is_modal })
    }

    /// The summary as JSON; `None` where the run has not ended.
    fn summary(&self) -> Option<String> {
        fs::read_to_string(self.path.join("summary.json")).ok()
    }

    /// The columns of a table by their names: arrays, and lists of texts.
    fn table<'py>(&self, py: Python<'py>, name: &str) -> PyResult<Bound<'py, PyDict>> {
        let sheet = CsvTable::read(self.path.join(name)).map_err(folder_error(py))?;
        let columns = PyDict::new(py);
        for column in sheet.columns() {
            columns.set_item(column, column_of(py, &sheet, name, column)?)?;
        }
        Ok(columns)
    }

    /// SI units of the columns of the history, `-` where there is none or it is not known.
    fn units<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let sheet = CsvTable::read(self.path.join("history.csv")).map_err(folder_error(py))?;
        let loading = stored_loading(&self.path).map_err(folder_error(py))?;
        let units = PyDict::new(py);
        for column in sheet.columns() {
            units.set_item(column, loading.unit_of(column))?;
        }
        Ok(units)
    }

    /// Names of the probes.
    fn probes(&self, py: Python<'_>) -> PyResult<Vec<String>> {
        let loading = stored_loading(&self.path).map_err(folder_error(py))?;
        Ok(loading.probes.into_keys().collect())
    }

    /// Steps with fields at their ends; of natural modes the numbers of the modes.
    fn steps(&self, py: Python<'_>) -> PyResult<Vec<usize>> {
        let states = self.outputs(py)?.states().into_iter();
        let ends = states.filter(|it| it.breakages().is_none());
        Ok(ends.map(|it| it.step).collect())
    }

    /// Names of all states with fields: `45` is the end of a step, `45:120` the step after 120 breakages.
    fn states(&self, py: Python<'_>) -> PyResult<Vec<String>> {
        let states = self.outputs(py)?.states();
        Ok(states.iter().map(StoredState::to_string).collect())
    }

    /// Name of the state that a name or a number means, among those with fields or also among all of the history.
    fn state(&self, py: Python<'_>, name: &str, of_fields: bool) -> PyResult<String> {
        let fault = |error: String| errors::request_error(py, &error);
        let mut all = self.outputs(py)?.states();
        if !of_fields {
            let history =
                CsvTable::read(self.path.join("history.csv")).map_err(folder_error(py))?;
            let steps: Vec<usize> = history.values("step").map_err(folder_error(py))?;
            all.extend(steps.into_iter().map(StoredState::end));
            all.sort_unstable();
            all.dedup();
        }
        let choice: StepChoice = name
            .parse()
            .map_err(|it| fault(format!("step `{name}`: {it}")))?;
        let steps = choice.steps(&self.path, &all);
        match steps
            .map_err(|it| errors::program_error(py, &it))?
            .as_slice()
        {
            [one] => Ok(one.state.to_string()),
            _ => Err(fault(format!(
                "`{name}` means several steps; name one of them"
            ))),
        }
    }

    /// The file with the fields of a state.
    fn file(&self, py: Python<'_>, state: &str) -> PyResult<PathBuf> {
        let mut outputs = self.outputs(py)?;
        let file = outputs.files.remove(&stored_state(py, state)?);
        file.ok_or_else(|| {
            errors::request_error(py, &format!("there are no fields of step {state}"))
        })
    }

    /// Names of the fields in a state, each with the names of its components and whether it stays as it is in all states.
    fn fields<'py>(&self, py: Python<'py>, state: &str) -> PyResult<Bound<'py, PyDict>> {
        let file = VtuFile::open(self.file(py, state)?).map_err(folder_error(py))?;
        let location = location(&file);
        let named = PyDict::new(py);
        for name in file.fields(location) {
            let row = ResultField::named(name).map(|it| it.reading);
            let is_fixed = TAG_NOUNS.contains(&name)
                || matches!(
                    row,
                    Some(
                        FieldReading::Model(_)
                            | FieldReading::EnergyRatios
                            | FieldReading::ScatterFactors
                    )
                );
            let components = file.component_names(location, name);
            named.set_item(name, (components, is_fixed, fields::unit_of(name)))?;
        }
        Ok(named)
    }

    /// A field of a state, shape (n_points) or (n_points, n_components).
    fn field<'py>(&self, py: Python<'py>, state: &str, name: &str) -> PyResult<Bound<'py, PyAny>> {
        let path = self.file(py, state)?;
        let read = py.detach(|| Values::read(&path, name));
        read.map_err(folder_error(py))?.array(py)
    }

    /// Positions of the points by a file of fields, shape (n_points, 3), m.
    fn positions<'py>(&self, py: Python<'py>, state: &str) -> PyResult<Bound<'py, PyAny>> {
        let path = self.file(py, state)?;
        let read = py.detach(|| VtuFile::open(path).and_then(|it| positions_of_fields(&it)));
        rows(py, read.map_err(folder_error(py))?.into_flattened(), 3)
    }

    /// Positions of the points, and arrays over the bonds; `None` where the run wrote no model.
    fn bonds<'py>(
        &self,
        py: Python<'py>,
    ) -> PyResult<Option<(Bound<'py, PyAny>, Bound<'py, PyDict>)>> {
        let read = py.detach(|| BondArrays::read(&self.path));
        let Some(read) = read.map_err(folder_error(py))? else {
            return Ok(None);
        };
        let bonds = PyDict::new(py);
        let intact = read.step_of_breaking.iter().map(|step| *step < 0).collect();
        bonds.set_item("intact", array::<bool>(py, intact))?;
        bonds.set_item("step_of_breaking", array(py, read.step_of_breaking))?;
        if let Some(dissipated) = read.dissipated_energy {
            bonds.set_item("dissipated_energy", array(py, dissipated))?;
        }
        bonds.set_item("ends", rows(py, read.ends.into_flattened(), 2)?)?;
        bonds.set_item("horizon", array(py, read.horizon))?;
        bonds.set_item("weight", array(py, read.weight))?;
        Ok(Some((rows(py, read.positions.into_flattened(), 3)?, bonds)))
    }

    /// Whether the body is a solid.
    fn is_solid(&self, py: Python<'_>) -> PyResult<bool> {
        has_solid(&self.path).map_err(folder_error(py))
    }

    /// The cracks in a state, as lines.
    fn cracks<'py>(&self, py: Python<'py>, state: &str) -> PyResult<Vec<Line<'py>>> {
        let state = stored_state(py, state)?;
        let lines = py.detach(|| StoredCracks::open(&self.path).map(|it| it.lines(state)));
        let lines = lines.map_err(folder_error(py))?.into_iter();
        lines
            .map(|line| {
                let (length, ends) = (line.length(), line.ends.map(|end| end.word()));
                Ok((rows(py, line.places.into_flattened(), 2)?, ends, length))
            })
            .collect()
    }

    /// Openings along a line in a state: distances from its start, openings and slidings, not a number where a side has too few points.
    fn openings<'py>(
        &self,
        py: Python<'py>,
        state: &str,
        ends: [[f64; 2]; 2],
        samples: usize,
    ) -> PyResult<Bound<'py, PyDict>> {
        let state = stored_state(py, state)?;
        let found = py.detach(|| stored_openings(&self.path, state, ends, samples));
        let found = found.map_err(folder_error(py))?;
        let jump = |axis: usize| {
            found
                .iter()
                .map(move |it| it.jump.map_or(f64::NAN, |it| it[axis]))
        };
        let named = PyDict::new(py);
        let along = found.iter().map(|it| it.along).collect();
        named.set_item("along", array::<f64>(py, along))?;
        named.set_item("opening", array::<f64>(py, jump(0).collect()))?;
        named.set_item("sliding", array::<f64>(py, jump(1).collect()))?;
        Ok(named)
    }

    /// The crack surface of a solid in a state.
    fn surface<'py>(&self, py: Python<'py>, state: &str) -> PyResult<Bound<'py, PyDict>> {
        let state = stored_state(py, state)?;
        let read = py.detach(|| {
            let cracks = SolidCracks::open(&self.path)?;
            let surface = cracks.surface(state);
            let jumps = stored_jumps(&self.path, &cracks, &surface, state)?;
            Ok::<_, Error>((surface, jumps))
        });
        let (surface, jumps) = read.map_err(folder_error(py))?;
        let [opening, sliding] = [0, 1].map(|place| jumps.iter().map(|it| it[place]).collect());
        let named = PyDict::new(py);
        named.set_item("area", surface.area())?;
        named.set_item("opening", array::<f64>(py, opening))?;
        named.set_item("sliding", array::<f64>(py, sliding))?;
        let part: Vec<i64> = surface.part.iter().map(|it| i64::from(*it) + 1).collect();
        named.set_item("part", array(py, part))?;
        named.set_item("is_precrack", array(py, surface.is_precrack.clone()))?;
        let triangles = surface
            .triangles
            .as_flattened()
            .iter()
            .map(|it| i64::from(*it));
        named.set_item("triangles", rows(py, triangles.collect(), 3)?)?;
        named.set_item("places", rows(py, surface.places.into_flattened(), 3)?)?;
        Ok(named)
    }

    /// What the command `explain` says of a point or a bond by tags, or of the point nearest to a position.
    fn explain(&self, py: Python<'_>, tags: Vec<i64>, at: Vec<f64>) -> PyResult<String> {
        let subject = match (tags.as_slice(), at.as_slice()) {
            (&[tag], []) => Subject::Point(tag),
            (&[a, b], []) => Subject::Bond([a, b]),
            ([], &[x, y]) => Subject::At(Position::InPlane([x, y])),
            ([], &[x, y, z]) => Subject::At(Position::InSpace([x, y, z])),
            _ => {
                let fault = "give one of `point` (a tag), `bond` (two tags) and `at` (a position)";
                return Err(errors::request_error(py, fault));
            }
        };
        let request = explain::Request {
            folder: self.path.clone(),
            subject,
            csv: None,
            json: None,
            force: false,
        };
        let mut words = Vec::new();
        let explained = py.detach(|| explain::explain(&request, &mut words));
        explained.map_err(|error| errors::program_error(py, error.as_ref()))?;
        Ok(String::from_utf8_lossy(&words).into_owned())
    }

    /// Copies the results into another folder, where earlier results are replaced if `replace` is set.
    fn copy_to(&self, py: Python<'_>, folder: PathBuf, replace: bool) -> PyResult<()> {
        py.detach(|| copy_results(&self.path, &folder, replace))
            .map_err(folder_error(py))
    }
}

/// Writes the page of results of some folders with their labels within limits, and returns its path.
#[pyfunction]
pub(crate) fn report(
    py: Python<'_>,
    folders: Vec<PathBuf>,
    labels: Vec<String>,
    path: PathBuf,
    measured: Vec<PathBuf>,
    limits: Limits,
) -> PyResult<PathBuf> {
    let (digits, steps, size) = limits;
    let path = match path.is_dir() {
        true => path.join(REPORT),
        false => path,
    };
    let request = ligament_report::Request {
        study: None,
        folders,
        labels,
        output: Some(path),
        force: true,
        digits: digits.unwrap_or(DIGITS),
        steps: steps.unwrap_or(STEPS) as usize,
        size: (size.unwrap_or(SIZE) * MEGABYTE) as usize,
        measured,
        unit_of: |key| KeyPath::parse(key).and_then(|key| unit_of(&key)),
    };
    let written = py.detach(|| write_report(&request));
    let written = written.map_err(|error| errors::program_error(py, &error))?;
    Ok(written.path)
}

impl Folder {
    fn outputs(&self, py: Python<'_>) -> PyResult<Outputs> {
        Outputs::list(&self.path).map_err(folder_error(py))
    }
}

/// A column of a table as an array of integers or numbers, or as a list of texts.
fn column_of<'py>(
    py: Python<'py>,
    sheet: &CsvTable,
    table: &str,
    column: &str,
) -> PyResult<Bound<'py, PyAny>> {
    let texts: Vec<&str> = sheet.texts(column).into_iter().flatten().collect();
    if is_count(table, column) {
        let integers: Result<Vec<i64>, _> = texts.iter().map(|it| it.parse()).collect();
        if let Ok(integers) = integers {
            return Ok(array(py, integers));
        }
    }
    let number = |text: &&str| match *text {
        "" => Ok(f64::NAN),
        text => text.parse(),
    };
    let numbers: Result<Vec<f64>, _> = texts.iter().map(number).collect();
    match numbers {
        Ok(numbers) => Ok(array(py, numbers)),
        Err(_) => texts.into_pyobject(py),
    }
}

/// Values of a field with the number of components.
enum Values {
    Integers(Vec<i64>),
    Numbers(Vec<f64>, usize),
}

impl Values {
    fn read(path: &Path, name: &str) -> Result<Self, Error> {
        let file = VtuFile::open(path)?;
        let location = location(&file);
        if let Ok(Some(integers)) = file.integers(location, name) {
            return Ok(Self::Integers(integers));
        }
        let count = file.components(location, name).map_or(1, |it| it.0);
        Ok(Self::Numbers(file.required_numbers(location, name)?, count))
    }

    fn array(self, py: Python<'_>) -> PyResult<Bound<'_, PyAny>> {
        match self {
            Self::Integers(values) => Ok(array(py, values)),
            Self::Numbers(values, 1) => Ok(array(py, values)),
            Self::Numbers(values, count) => rows(py, values, count),
        }
    }
}
