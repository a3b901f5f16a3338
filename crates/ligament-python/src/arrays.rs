//! Arrays of NumPy: moved, not copied, and read only, because they are results.

use numpy::{Element, IntoPyArray, PyArrayMethods};
use pyo3::prelude::*;

/// An array that takes over the memory of a vector, shape (n).
pub(crate) fn array<T: Element>(py: Python<'_>, values: Vec<T>) -> Bound<'_, PyAny> {
    let array = values.into_pyarray(py);
    array.readwrite().make_nonwriteable();
    array.into_any()
}

/// An array that takes over the memory of a vector, shape (n, columns).
pub(crate) fn rows<T: Element>(
    py: Python<'_>,
    values: Vec<T>,
    columns: usize,
) -> PyResult<Bound<'_, PyAny>> {
    let n = values.len() / columns.max(1);
    // Read only before it is reshaped: a view of a read-only array cannot be made writable.
    let array = values.into_pyarray(py);
    array.readwrite().make_nonwriteable();
    Ok(array.reshape([n, columns])?.into_any())
}
