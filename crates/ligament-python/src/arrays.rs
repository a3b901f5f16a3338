//! Arrays of NumPy: moved there, not copied.

use numpy::{Element, IntoPyArray, PyArrayMethods};
use pyo3::prelude::*;

/// An array that takes over the memory of a vector, shape (n).
pub(crate) fn array<T: Element>(py: Python<'_>, values: Vec<T>) -> Bound<'_, PyAny> {
    values.into_pyarray(py).into_any()
}

/// An array that takes over the memory of a vector, shape (n, columns).
pub(crate) fn rows<T: Element>(
    py: Python<'_>,
    values: Vec<T>,
    columns: usize,
) -> PyResult<Bound<'_, PyAny>> {
    let n = values.len() / columns.max(1);
    Ok(values.into_pyarray(py).reshape([n, columns])?.into_any())
}
