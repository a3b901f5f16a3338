//! The next trial value of a key for a result to meet its target.

use ligament_study::calibrate::RESOLUTION;
use ligament_study::calibrate::search::{Next, Search, Trial, Verdict};
use ligament_study::quantities::Quantities;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::errors;

/// Next action after trials, pairs of a value and its result, for an aim of a target and a relative tolerance: `("try", value)`, or the end
/// of the search, `("met", value)`, `("jump", value)`, `("out-of-reach", None)`, `("out-of-trials", None)`.
#[pyfunction]
pub(crate) fn next_trial(
    trials: Vec<(f64, f64)>,
    start: f64,
    limits: [Option<f64>; 2],
    aim: (f64, f64),
    most_trials: usize,
) -> (&'static str, Option<f64>) {
    let (target, within) = aim;
    let search = Search {
        start,
        limits: [
            limits[0].unwrap_or(f64::NEG_INFINITY),
            limits[1].unwrap_or(f64::INFINITY),
        ],
        target,
        tolerance: within * target.abs(),
        resolution: RESOLUTION,
        most_trials,
    };
    let trials = trials
        .into_iter()
        .map(|(key, result)| Trial { key, result });
    match search.next(&trials.collect::<Vec<_>>()) {
        Next::Try(value) => ("try", Some(value)),
        Next::Stop(Verdict::Met(trial)) => ("met", Some(trial.key)),
        Next::Stop(Verdict::Jump([below, _])) => ("jump", Some(below.key)),
        Next::Stop(Verdict::OutOfReach) => ("out-of-reach", None),
        Next::Stop(Verdict::OutOfTrials) => ("out-of-trials", None),
    }
}

/// The numbers of a summary in JSON by their dotted names, or only the number of a given name.
///
/// # Errors
///
/// If there is no number of that name, with the most similar name.
#[pyfunction]
pub(crate) fn numbers<'py>(
    py: Python<'py>,
    summary: &str,
    name: Option<&str>,
) -> PyResult<Bound<'py, PyDict>> {
    let fault = |error: String| errors::request_error(py, &error);
    let summary: serde_json::Value =
        serde_json::from_str(summary).map_err(|it| fault(it.to_string()))?;
    let all = Quantities::from_summary(&summary);
    let found = PyDict::new(py);
    if let Some(name) = name {
        let number = all.number(name).map_err(|it| fault(it.to_string()))?;
        found.set_item(name, number)?;
        return Ok(found);
    }
    for (name, value) in all.iter() {
        if let Some(number) = value.as_f64() {
            found.set_item(name, number)?;
        }
    }
    Ok(found)
}
