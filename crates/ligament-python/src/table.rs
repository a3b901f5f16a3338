//! Tables that grow by rows and become columns.

use ligament_output::csv::Value;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::arrays;

/// A table of named columns.
#[derive(Debug, Default)]
pub(crate) struct Table {
    names: Vec<String>,
    columns: Vec<Column>,
}

#[derive(Debug)]
enum Column {
    Integers(Vec<i64>),
    Numbers(Vec<f64>),
    Texts(Vec<String>),
}

impl Table {
    /// An empty table.
    pub(crate) fn new(names: Vec<String>) -> Self {
        Self {
            names,
            columns: Vec::new(),
        }
    }

    /// Adds a row; the first row determines the types of the columns.
    pub(crate) fn append(&mut self, row: &[Value<'_>]) {
        if self.columns.is_empty() {
            self.columns = row.iter().map(Column::for_values_like).collect();
        }
        for (column, value) in self.columns.iter_mut().zip(row) {
            column.push(value);
        }
    }

    /// The columns by their names, as arrays or lists of texts.
    pub(crate) fn into_columns(self, py: Python<'_>) -> PyResult<Bound<'_, PyDict>> {
        let columns = PyDict::new(py);
        let mut filled = self.columns.into_iter();
        for name in self.names {
            let values = match filled.next() {
                Some(Column::Integers(values)) => arrays::array(py, values),
                Some(Column::Numbers(values)) => arrays::array(py, values),
                Some(Column::Texts(values)) => values.into_pyobject(py)?.into_any(),
                None => arrays::array(py, Vec::<f64>::new()),
            };
            columns.set_item(name, values)?;
        }
        Ok(columns)
    }
}

impl Column {
    fn for_values_like(value: &Value<'_>) -> Self {
        match value {
            Value::Integer(_) | Value::Count(_) => Self::Integers(Vec::new()),
            Value::Float(_) | Value::Missing => Self::Numbers(Vec::new()),
            Value::Text(_) => Self::Texts(Vec::new()),
        }
    }

    fn push(&mut self, value: &Value<'_>) {
        match (self, *value) {
            (Self::Integers(values), Value::Integer(value)) => values.push(value),
            (Self::Integers(values), Value::Count(value)) => values.push(value as i64),
            (Self::Numbers(values), Value::Float(value)) => values.push(value),
            (Self::Numbers(values), _) => values.push(f64::NAN),
            (Self::Texts(values), Value::Text(text)) => values.push(text.to_owned()),
            (Self::Integers(values), _) => values.push(0),
            (Self::Texts(values), _) => values.push(String::new()),
        }
    }
}
