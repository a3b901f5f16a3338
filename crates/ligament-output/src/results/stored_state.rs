//! Stored states of a run: their numbers, in the names of files and in the words of users.

use std::fmt;
use std::str::FromStr;

use serde::{Deserialize, Serialize};

use crate::vtu;

/// Beginnings of the names of the files of a state: its fields, its bonds, and its rigid bodies.
pub(super) const FIELDS: &str = "fields";
pub(super) const BONDS: &str = "bonds";
pub(super) const RIGID: &str = "rigid";

/// A state of a run, in the order of the states: `45` is the end of load step 45 (or an event, a row of a motion, a mode), `45:120` the
/// equilibrium of that step after 120 of its breakages.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
pub struct StoredState {
    /// Number of the step.
    pub step: usize,
    /// What of the step the state has behind it.
    pub reached: Reached,
}

/// What of its step a state has behind it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
pub enum Reached {
    /// So many breakages of bonds, with others to follow.
    Breakages(usize),
    /// All of the step.
    End,
}

impl StoredState {
    /// The state at the end of a step.
    pub const fn end(step: usize) -> Self {
        Self {
            step,
            reached: Reached::End,
        }
    }

    /// The state of a step after some of its breakages, with others to follow.
    pub const fn between(step: usize, breakages: usize) -> Self {
        Self {
            step,
            reached: Reached::Breakages(breakages),
        }
    }

    /// Number of breakages of its step before the state; none at the end of the step.
    pub fn breakages(self) -> Option<usize> {
        match self.reached {
            Reached::Breakages(breakages) => Some(breakages),
            Reached::End => None,
        }
    }

    /// The state in the name of a file: `0045`, or `0045_0120` after 120 breakages.
    pub fn in_file_name(self) -> String {
        match self.reached {
            Reached::Breakages(breakages) => format!("{:04}_{breakages:04}", self.step),
            Reached::End => format!("{:04}", self.step),
        }
    }

    /// The state of a file `STEM_0045.vtu` or `STEM_0045_0120.vtu`, including pieces; `None` for other files.
    pub(super) fn of_file(name: &str, stem: &str) -> Option<Self> {
        let number = vtu::stem(name)?.strip_prefix(stem)?.strip_prefix('_')?;
        Self::read(number, '_')
    }

    fn read(text: &str, separator: char) -> Option<Self> {
        Some(match text.split_once(separator) {
            Some((step, breakages)) => Self::between(step.parse().ok()?, breakages.parse().ok()?),
            None => Self::end(text.parse().ok()?),
        })
    }
}

impl From<usize> for StoredState {
    /// The state at the end of the step of this number.
    fn from(step: usize) -> Self {
        Self::end(step)
    }
}

impl fmt::Display for StoredState {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.reached {
            Reached::Breakages(breakages) => write!(f, "{}:{breakages}", self.step),
            Reached::End => write!(f, "{}", self.step),
        }
    }
}

impl FromStr for StoredState {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let wrong = "expected the number of a step, or 45:120 for step 45 after 120 breakages";
        Self::read(text, ':').ok_or_else(|| wrong.to_owned())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn states_of_a_step_precede_its_end() {
        let ordered = [
            StoredState::end(44),
            StoredState::between(45, 5),
            StoredState::between(45, 120),
            StoredState::end(45),
            StoredState::between(46, 1),
        ];
        assert!(ordered.is_sorted());
    }

    #[test]
    fn states_are_read_as_they_are_written() {
        for state in [StoredState::end(7), StoredState::between(45, 12_345)] {
            assert_eq!(state.to_string().parse(), Ok(state));
            for ending in ["vtu", "pvtu", "piece_3.vtu"] {
                let name = format!("fields_{}.{ending}", state.in_file_name());
                assert_eq!(StoredState::of_file(&name, "fields"), Some(state), "{name}");
            }
        }
        assert_eq!(StoredState::between(45, 120).in_file_name(), "0045_0120");
        for other in [
            "fields_0045_.vtu",
            "fields_a.vtu",
            "bonds_0045.vtu",
            "fields_0001_2_3.vtu",
        ] {
            assert_eq!(StoredState::of_file(other, "fields"), None, "{other}");
        }
        assert!("45:".parse::<StoredState>().is_err());
    }
}
