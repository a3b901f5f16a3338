//! Common parts of a page for bodies in the plane and solids: texts of columns and pictures, and the budget of size.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use ligament_output::results::outputs::OutputKind;
use serde_json::{Value, json};

use crate::columns::Column;

/// Choice of a run's contents in a page.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Choice {
    /// Digits of the largest value of a field in each step.
    pub(crate) digits: u32,
    /// Largest number of steps; by default that of the body's kind.
    pub(crate) steps: Option<usize>,
    /// Largest number of characters of body, fields and bonds.
    pub(crate) letters: usize,
}

/// Texts of columns, referenced by index from the description of a run.
#[derive(Debug, Default)]
pub(crate) struct Texts(pub(crate) Vec<String>);

impl Texts {
    /// Adds a text, and returns its index.
    pub(crate) fn push(&mut self, text: String) -> usize {
        self.0.push(text);
        self.0.len() - 1
    }

    /// Number of characters of all texts.
    pub(crate) fn letters(&self) -> usize {
        self.0.iter().map(String::len).sum()
    }

    /// Adds a column, and returns its entry for the description.
    pub(crate) fn add(&mut self, column: Column) -> Value {
        let first = self.0.len();
        self.0.extend(column.groups);
        json!({"texts": [first, self.0.len()], "exponents": column.exponents})
    }
}

/// The outputs of a run in a page.
pub(crate) struct Stored<'a> {
    /// Folder of the results.
    pub(crate) folder: &'a Path,
    /// Files of the steps, or modes.
    pub(crate) files: &'a BTreeMap<usize, PathBuf>,
    /// Kind of the outputs.
    pub(crate) kind: OutputKind,
}

/// Drawn contents of a run.
pub(crate) struct Drawn {
    /// Parts of the description that belong to the body.
    pub(crate) parts: Value,
    /// Number of points of the body.
    pub(crate) points: usize,
    /// Names of the contents that were left out for their size.
    pub(crate) left_out: Vec<String>,
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
    pub(crate) fn takes(&mut self, name: &str, letters: usize) -> bool {
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
