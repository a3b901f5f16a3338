//! Texts of columns and the budget of a page's size.

use serde_json::{Value, json};

use crate::columns::Column;

/// Function from the path of a key of a case, such as `material.young`, to its SI unit, if it has one.
pub type UnitOf = fn(&str) -> Option<&'static str>;

/// Choice of a run's contents in a page.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Choice {
    /// Digits of the largest value of a field in each step.
    pub(crate) digits: u32,
    /// Largest number of steps.
    pub(crate) steps: usize,
    /// Largest number of characters of body, fields and bonds.
    pub(crate) letters: usize,
    /// Units of the keys of cases.
    pub(crate) unit_of: UnitOf,
}

/// Texts of columns, referenced by index from the description of a run.
#[derive(Debug, Default)]
pub(crate) struct ColumnTexts(pub(crate) Vec<String>);

impl ColumnTexts {
    /// Number of characters of all texts.
    pub(crate) fn n_characters(&self) -> usize {
        self.0.iter().map(String::len).sum()
    }

    /// Adds a column, and returns its entry for the description.
    pub(crate) fn add(&mut self, column: Column) -> Value {
        let first = self.0.len();
        self.0.extend(column.groups);
        json!({"texts": [first, self.0.len()], "exponents": column.exponents})
    }

    /// Adds a column of whole numbers of a single step.
    pub(crate) fn add_whole<T: Into<i64>>(&mut self, values: impl IntoIterator<Item = T>) -> Value {
        self.add(Column::whole_numbers(values.into_iter().map(Into::into)))
    }
}

/// Remaining number of characters for columns.
pub(crate) struct Budget {
    letters: usize,
    /// Names of the contents that were left out for their size.
    pub(crate) left_out: Vec<String>,
}

impl Budget {
    pub(crate) fn new(letters: usize) -> Self {
        Self {
            letters,
            left_out: Vec::new(),
        }
    }

    /// Takes a number of characters from the budget; returns whether they fit.
    pub(crate) fn try_take(&mut self, name: &str, letters: usize) -> bool {
        match self.letters.checked_sub(letters) {
            Some(left) => {
                self.letters = left;
                true
            }
            None => {
                self.left_out.push(name.to_owned());
                false
            }
        }
    }
}
