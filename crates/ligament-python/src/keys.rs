//! The keys of a case.

use pyo3::prelude::*;

/// The JSON schema of a case file, from which keys, units and defaults are told.
#[pyfunction]
pub(crate) fn schema() -> String {
    ligament_case::case::schema().to_string()
}
