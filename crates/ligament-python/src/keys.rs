//! The keys of a case.

use pyo3::prelude::*;

/// The JSON schema of a case file, with its keys, their units and their defaults.
#[pyfunction]
pub(crate) fn schema() -> String {
    ligament_case::case::schema().to_string()
}
