//! What bodies in the plane and solids give to a page: texts of columns and pictures, and what there is room for.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use ligament_output::results::outputs::OutputKind;
use serde_json::{Value, json};

use crate::columns::Column;

/// What a page takes of a run.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Choice {
    /// Digits of the largest value of a field in each step.
    pub(crate) digits: u32,
    /// Steps at most; None: as many as suit the body.
    pub(crate) steps: Option<usize>,
    /// Letters that its body, fields and bonds may take.
    pub(crate) letters: usize,
}

/// Texts of columns, which the description of a run names by number.
#[derive(Debug, Default)]
pub(crate) struct Texts(pub(crate) Vec<String>);

impl Texts {
    /// Adds a text, and gives its number.
    pub(crate) fn push(&mut self, text: String) -> usize {
        self.0.push(text);
        self.0.len() - 1
    }

    /// Letters of all texts.
    pub(crate) fn letters(&self) -> usize {
        self.0.iter().map(String::len).sum()
    }

    /// Adds a column, and gives what the description says of it.
    pub(crate) fn add(&mut self, column: Column) -> Value {
        let first = self.0.len();
        self.0.extend(column.groups);
        json!({"texts": [first, self.0.len()], "exponents": column.exponents})
    }
}

/// The outputs of a run that a page has.
pub(crate) struct Stored<'a> {
    /// The folder.
    pub(crate) folder: &'a Path,
    /// The files of the steps, or modes.
    pub(crate) files: &'a BTreeMap<usize, PathBuf>,
    /// What they are.
    pub(crate) kind: OutputKind,
}

/// What a page draws of a run.
pub(crate) struct Drawn {
    /// Parts of the description that belong to the body.
    pub(crate) parts: Value,
    /// Points of the body.
    pub(crate) points: usize,
    /// Names of what there was no room for.
    pub(crate) left_out: Vec<String>,
}

/// Letters that are left for columns.
pub(crate) struct Budget {
    letters: usize,
    /// Names of what there was no room for.
    pub(crate) left_out: Vec<String>,
}

impl Budget {
    pub(crate) fn new(letters: usize) -> Self {
        Self {
            letters,
            left_out: Vec::new(),
        }
    }

    /// Whether there is room for so many letters, which are then taken.
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
