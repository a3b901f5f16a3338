//! Arrays of NumPy: moved there, not copied, and read only, as they are what a result has.

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
    // Made so before it gets its shape: a view of what cannot be written cannot be made writable.
    let array = values.into_pyarray(py);
    array.readwrite().make_nonwriteable();
    Ok(array.reshape([n, columns])?.into_any())
}
