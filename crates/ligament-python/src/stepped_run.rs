//! A run that advances row by row, on a thread of its own.

use std::sync::Mutex;
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, channel};
use std::thread;
use std::time::Duration;

use ligament::analysis::driver::{Problem, Stop, Way};
use ligament::analysis::fields::damage;
use ligament::analysis::history::{ObserverError, StepRecord, View};
use ligament::analysis::{Observer, State};
use ligament::run::{Posed, begin, on_threads};
use ligament_case::case::CaseFile;
use ligament_output::csv::Value;
use ligament_output::results::{history_columns, history_row};
use ligament_run::model::{build_model, loading};
use ligament_run::progress::{Progress, ProgressMode};
use ligament_run::stages::Stages;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::arrays::{array, rows};
use crate::case::Case;
use crate::errors::{Failure, request_error};

/// Time between two checks for a signal.
const LOOK: Duration = Duration::from_millis(50);

/// A value of a row of the history.
enum RowEntry {
    Count(i64),
    Number(f64),
    Word(String),
    Nothing,
}

/// Request from Python to the run.
enum RowRequest {
    Advance,
    NextLoadFactor(f64),
    Displacement,
    Damage,
}

/// Answer of the run to a request.
enum RowAnswer {
    /// The rows since the last one, and the word and the sentence of the end, if the run ended.
    SteppedRun(Vec<Vec<RowEntry>>, Option<[String; 2]>),
    /// Whether the run takes load factors.
    Takes(bool),
    /// Values at the points, in the order of the body's file.
    Values(Vec<f64>),
    Failed(Failure),
}

/// A run that goes on row by row.
#[pyclass(frozen, name = "Rows", module = "ligament._native")]
pub(crate) struct SteppedRun {
    columns: Vec<String>,
    n_components: usize,
    request_sender: Sender<RowRequest>,
    answers: Mutex<Receiver<RowAnswer>>,
}

/// Observer that passes on the rows of the history.
struct RowCollector {
    rows: Sender<Vec<RowEntry>>,
}

impl Observer for RowCollector {
    fn step(&mut self, record: &StepRecord, view: &View<'_>) -> Result<(), ObserverError> {
        let entries = history_row(record, view)
            .into_iter()
            .map(|value| match value {
                Value::Integer(it) => RowEntry::Count(it),
                Value::Count(it) => RowEntry::Count(it as i64),
                Value::Float(it) => RowEntry::Number(it),
                Value::Text(it) => RowEntry::Word(it.to_owned()),
                Value::Missing => RowEntry::Nothing,
            });
        // Without a receiver nobody asks for rows.
        let _ = self.rows.send(entries.collect());
        Ok(())
    }
}

/// Rows as dictionaries, and the word and the sentence of the end, if the run ended.
type AdvancedRows<'py> = (Vec<Bound<'py, PyDict>>, Option<[String; 2]>);

/// Names of the columns of the history, and the number of components of a displacement.
type RunStart = (Vec<String>, usize);

/// Begins the run of a case, reports the columns of its rows, and answers requests until there are no more.
fn answer(
    file: &CaseFile,
    begun: &Sender<Result<RunStart, Failure>>,
    (request_sender, answers): (&Receiver<RowRequest>, &Sender<RowAnswer>),
) -> anyhow::Result<()> {
    let progress = Progress::new(ProgressMode::Quiet);
    let model = build_model(file, &mut Stages::default(), &progress)?;
    let loading = loading(file, &model)?;
    let problem = loading.problem(&model);
    let motion = loading.motion(&problem);
    let posed = Posed::new(&problem, motion.as_ref());
    let (sender, collected) = channel();
    let mut observer = RowCollector { rows: sender };
    let begin = begin(posed, &model.setup.analysis, &mut observer);
    let mut way = begin?;
    let _ = begun.send(Ok((history_columns(&problem), n_components(&problem))));
    for request in request_sender {
        let answer = match request {
            RowRequest::Advance => advance(&mut *way, &collected),
            RowRequest::NextLoadFactor(it) => RowAnswer::Takes(way.set_next_load_factor(it)),
            RowRequest::Displacement => RowAnswer::Values(displacement(&problem, way.state())),
            RowRequest::Damage => {
                let damage = damage(&*problem.system, &way.state().intact);
                RowAnswer::Values(problem.system.numbering.to_file(damage))
            }
        };
        if answers.send(answer).is_err() {
            break;
        }
    }
    Ok(())
}

/// Advances by a row; returns the rows recorded meanwhile.
fn advance(way: &mut dyn Way, collected: &Receiver<Vec<RowEntry>>) -> RowAnswer {
    let end = match way.advance() {
        Ok(()) => None,
        Err(Stop::End(end)) => Some([end.name().to_owned(), end.to_string()]),
        Err(Stop::Failed(error)) => return RowAnswer::Failed(Failure::Other(error.into())),
    };
    RowAnswer::SteppedRun(collected.try_iter().collect(), end)
}

/// Displacements of the points in the order of the body's file, shape (n_points, n_components), m.
fn displacement(problem: &Problem, state: &State) -> Vec<f64> {
    let layout = problem.system.layout;
    let n_components = n_components(problem);
    let of_point = |point: u32| {
        let mut values = [0.0; 3];
        let dofs = layout
            .range(point)
            .filter(|&dof| !layout.component(dof).is_rotation());
        for (value, dof) in values.iter_mut().zip(dofs) {
            *value = state.displacement[dof];
        }
        values
    };
    let of_points = (0..layout.n_points as u32).map(of_point).collect();
    let in_file = problem.system.numbering.to_file(of_points);
    let values = in_file.iter().flat_map(|it| &it[..n_components]);
    values.copied().collect()
}

/// Number of components of a displacement.
fn n_components(problem: &Problem) -> usize {
    let layout = problem.system.layout;
    let components = layout.components.iter();
    components.filter(|it| !it.is_rotation()).count()
}

#[pymethods]
impl SteppedRun {
    /// Begins the run of a case.
    #[new]
    fn begin(py: Python<'_>, case: &Bound<'_, Case>) -> PyResult<Self> {
        let file = case.get().file.clone();
        let (begun, first) = channel();
        let (request_sender, requests) = channel();
        let (answer_sender, answers) = channel();
        thread::spawn(move || {
            let (threads, failing) = (file.threads(), begun.clone());
            let run = move || answer(&file, &begun, (&requests, &answer_sender));
            let failed = match on_threads(threads, run) {
                Ok(Ok(())) => return,
                Ok(Err(error)) => error,
                Err(error) => error.into(),
            };
            // Nothing fails here once the run has begun.
            let _ = failing.send(Err(Failure::Other(failed)));
        });
        let (columns, n_components) =
            next_value(py, &first)?.map_err(|failure| failure.exception(py))?;
        Ok(Self {
            columns,
            n_components,
            request_sender,
            answers: Mutex::new(answers),
        })
    }

    /// Goes on by a row; the rows that were recorded meanwhile.
    fn advance<'py>(&self, py: Python<'py>) -> PyResult<AdvancedRows<'py>> {
        let RowAnswer::SteppedRun(rows, end) = self.ask(py, RowRequest::Advance)? else {
            return Err(wrong_answer_error(py));
        };
        let rows: PyResult<Vec<_>> = rows.iter().map(|row| self.dictionary(py, row)).collect();
        Ok((rows?, end))
    }

    /// Gives the next row another load factor; whether the run takes one.
    fn set_next_load_factor(&self, py: Python<'_>, load_factor: f64) -> PyResult<bool> {
        match self.ask(py, RowRequest::NextLoadFactor(load_factor))? {
            RowAnswer::Takes(takes) => Ok(takes),
            _ => Err(wrong_answer_error(py)),
        }
    }

    /// Displacements of the points, in the order of the body's file: (n, 2) or (n, 3), m.
    fn displacement<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let values = self.values(py, RowRequest::Displacement)?;
        rows(py, values, self.n_components)
    }

    /// Damage of the points, in the order of the body's file: (n).
    fn damage<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        Ok(array(py, self.values(py, RowRequest::Damage)?))
    }
}

impl SteppedRun {
    fn ask(&self, py: Python<'_>, request: RowRequest) -> PyResult<RowAnswer> {
        let over = || request_error(py, "the run is over; begin another one");
        self.request_sender.send(request).map_err(|_| over())?;
        let answers = self.answers.lock().map_err(|_| over())?;
        match next_value(py, &answers)? {
            RowAnswer::Failed(failure) => Err(failure.exception(py)),
            answer => Ok(answer),
        }
    }

    fn values(&self, py: Python<'_>, request: RowRequest) -> PyResult<Vec<f64>> {
        match self.ask(py, request)? {
            RowAnswer::Values(values) => Ok(values),
            _ => Err(wrong_answer_error(py)),
        }
    }

    fn dictionary<'py>(&self, py: Python<'py>, row: &[RowEntry]) -> PyResult<Bound<'py, PyDict>> {
        let dictionary = PyDict::new(py);
        for (name, entry) in self.columns.iter().zip(row) {
            match entry {
                RowEntry::Count(it) => dictionary.set_item(name, it),
                RowEntry::Number(it) => dictionary.set_item(name, it),
                RowEntry::Word(it) => dictionary.set_item(name, it),
                RowEntry::Nothing => dictionary.set_item(name, py.None()),
            }?;
        }
        Ok(dictionary)
    }
}

/// Waits for the next value from another thread, and checks for signals meanwhile.
fn next_value<T: Send>(py: Python<'_>, from: &Receiver<T>) -> PyResult<T> {
    loop {
        py.check_signals()?;
        match from.recv_timeout(LOOK) {
            Ok(value) => return Ok(value),
            Err(RecvTimeoutError::Timeout) => {}
            Err(RecvTimeoutError::Disconnected) => {
                return Err(request_error(py, "the run is over; begin another one"));
            }
        }
    }
}

/// The exception for an answer to another request, which may remain after Ctrl-C.
fn wrong_answer_error(py: Python<'_>) -> PyErr {
    request_error(
        py,
        "the run was interrupted between two rows; begin another one",
    )
}
