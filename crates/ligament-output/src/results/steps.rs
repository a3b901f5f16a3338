//! Steps of a stored run by number or event.

use std::cmp::Ordering;
use std::fmt;
use std::path::{Path, PathBuf};
use std::str::FromStr;

use super::columns::{TIME, is_in_time};
use super::stored_state::StoredState;
use crate::Error;
use crate::csv::read::CsvTable;
use crate::remedy::Remedy;

/// Selection of a load step, of an event of the exact path, or of a time of a motion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum StepName {
    /// The step in which the first bond broke or softened.
    First,
    /// The step without pending breakages that has the largest reaction.
    Peak,
    /// The last step.
    Last,
    /// This state: the end of a step, or one between its breakages.
    State(StoredState),
    /// The step at this place from the end: 1 is the last, 2 the one before.
    FromEnd(usize),
    /// The stored step nearest to this time of a motion, s.
    At(f64),
}

/// Words for a selection that cannot be read.
const EXPECTED: &str = "expected the number of a step, -1 for the last, -2 for the one before, first (breakage), peak, last or all, 45:120 for \
    step 45 after 120 breakages, 45: for all states of step 45, or a time of a motion in s such as t=4e-5";

/// Selection of stored steps by a word.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum StepChoice {
    /// All stored states.
    All,
    /// All stored states of a step: between its breakages, and at its end.
    Step(usize),
    /// The one step that a name selects.
    One(StepName),
}

/// A stored state with the event that selected it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct NamedStep {
    /// The stored state.
    pub state: StoredState,
    /// Event that selected the state, and its step. Where the end of that step is not stored, the state is the next one, or the last.
    pub happened: Option<(&'static str, usize)>,
}

/// Error of a step that does not exist.
#[derive(Debug, thiserror::Error)]
pub enum StepError {
    /// The history cannot be used.
    #[error(transparent)]
    Results(#[from] Error),
    /// A missing or empty history, so that events are unknown.
    #[error(
        "{path} has no history.csv with steps, so that none is known as `{name}`; give a number"
    )]
    NoHistory {
        /// Folder of the results.
        path: PathBuf,
        /// Requested name.
        name: StepName,
    },
    /// A time was given for a run in statics.
    #[error("{path} has no times: it is no motion; choose steps by number, first, peak or last")]
    NoTimes {
        /// Folder of the results.
        path: PathBuf,
    },
    /// The run ended before the event.
    #[error(
        "{path} has no step `{name}`: {}",
        match name {
            StepName::First => "no bond broke or softened; `last` and numbers are there",
            _ => "no step under load is at rest; `last` and numbers are there",
        }
    )]
    DidNotHappen {
        /// Folder of the results.
        path: PathBuf,
        /// Requested name.
        name: StepName,
    },
    /// A step counted from the end, where fewer steps are stored.
    #[error("{path} has no step -{back}: there is output of {n_stored} steps")]
    TooFewSteps {
        /// Folder of the results.
        path: PathBuf,
        /// Place from the end, from 1.
        back: usize,
        /// Number of the stored steps.
        n_stored: usize,
    },
    /// The state is not stored.
    #[error("{path} has no output of step {state}; there are {}", listed(stored))]
    NotStored {
        /// Folder of the results.
        path: PathBuf,
        /// Requested state.
        state: StoredState,
        /// The stored states.
        stored: Vec<StoredState>,
        /// Remedy for the user.
        #[source]
        remedy: Remedy,
    },
}

impl fmt::Display for StepName {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::First => f.write_str("first"),
            Self::Peak => f.write_str("peak"),
            Self::Last => f.write_str("last"),
            Self::State(state) => write!(f, "{state}"),
            Self::FromEnd(number) => write!(f, "-{number}"),
            Self::At(time) => write!(f, "t={time:?}"),
        }
    }
}

impl FromStr for StepChoice {
    type Err = String;

    /// Parses `first`, `peak`, `last`, `all`, `45:` for all states of step 45, a number, where -1 is the last state and -2 the one before, `45:120` for step 45 after 120 breakages, or
    /// a time in s such as `t=4e-5`.
    fn from_str(text: &str) -> Result<Self, String> {
        Ok(Self::One(match text.trim() {
            "all" => return Ok(Self::All),
            step if step.ends_with(':') => {
                let step = step[..step.len() - 1].parse();
                return step.map(Self::Step).map_err(|_| EXPECTED.to_owned());
            }
            "first" => StepName::First,
            "peak" => StepName::Peak,
            "last" => StepName::Last,
            time if time.starts_with("t=") => {
                let time = time[2..].parse().ok().filter(|it: &f64| it.is_finite());
                StepName::At(time.ok_or("expected a time in s, such as t=4e-5")?)
            }
            number => {
                let found = match number.strip_prefix('-') {
                    Some(back) => back
                        .parse()
                        .ok()
                        .filter(|it| *it > 0)
                        .map(StepName::FromEnd),
                    None => number.parse().ok().map(StepName::State),
                };
                found.ok_or(EXPECTED)?
            }
        }))
    }
}

impl StepChoice {
    /// Selects from the states `stored` in a folder, ascending.
    ///
    /// # Errors
    ///
    /// If no such event happened, a state given by its number is not stored, or there is no history.
    pub fn steps(self, folder: &Path, stored: &[StoredState]) -> Result<Vec<NamedStep>, StepError> {
        let numbered = |state| NamedStep {
            state,
            happened: None,
        };
        let not_stored = |state: StoredState| {
            let [key, value] = match state.breakages() {
                None => ["output.fields_every", "1"],
                Some(_) => ["output.during_breakage", "50"],
            };
            StepError::NotStored {
                path: folder.to_path_buf(),
                state,
                stored: stored.to_vec(),
                remedy: Remedy::RunAgain { key, value },
            }
        };
        let last = *stored
            .last()
            .ok_or_else(|| not_stored(StoredState::end(0)))?;
        Ok(match self {
            Self::All => stored.iter().copied().map(numbered).collect(),
            Self::Step(step) => {
                let of_step = stored.iter().filter(|it| it.step == step);
                let found: Vec<NamedStep> = of_step.copied().map(numbered).collect();
                match found.is_empty() {
                    true => return Err(not_stored(StoredState::end(step))),
                    false => found,
                }
            }
            Self::One(StepName::Last) => vec![numbered(last)],
            Self::One(StepName::FromEnd(back)) => {
                let place = stored.len().checked_sub(back);
                vec![numbered(
                    stored[place.ok_or_else(|| StepError::TooFewSteps {
                        path: folder.to_path_buf(),
                        back,
                        n_stored: stored.len(),
                    })?],
                )]
            }
            Self::One(StepName::At(time)) => vec![numbered(nearest(time, folder, stored)?)],
            Self::One(StepName::State(state)) if stored.contains(&state) => vec![numbered(state)],
            Self::One(StepName::State(state)) => return Err(not_stored(state)),
            Self::One(name @ (StepName::First | StepName::Peak)) => {
                let happened = event(name, folder)?;
                let at = StoredState::end(happened.1);
                let state = stored.iter().copied().find(|it| *it >= at);
                vec![NamedStep {
                    state: state.unwrap_or(last),
                    happened: Some(happened),
                }]
            }
        })
    }
}

impl NamedStep {
    /// Long and short description of the step's event: the first breakage or the peak, or the stored step nearest to it; `None` without an
    /// event.
    pub fn words(&self) -> Option<[String; 2]> {
        let (what, step) = self.happened?;
        let [stored, short] = match self.state.cmp(&StoredState::end(step)) {
            Ordering::Equal => return Some([what.to_owned(), what.to_owned()]),
            Ordering::Greater => ["next stored after", "after"],
            Ordering::Less => ["last stored before", "before"],
        };
        Some([
            format!("{stored} the {what} in step {step}"),
            format!("{short} the {what}"),
        ])
    }
}

/// The stored state nearest to a time of a motion, the earlier of two.
fn nearest(time: f64, folder: &Path, stored: &[StoredState]) -> Result<StoredState, StepError> {
    let no_times = || StepError::NoTimes {
        path: folder.to_path_buf(),
    };
    let path = folder.join("history.csv");
    let sheet = CsvTable::read(path)?;
    if !is_in_time(sheet.columns()) {
        return Err(no_times());
    }
    let rows = sheet.numbers(["step", TIME])?.into_iter();
    let rows = rows.map(|[step, at]| (StoredState::end(step as usize), (at - time).abs()));
    let rows = rows.filter(|(state, _)| stored.contains(state));
    let nearest = rows.min_by(|one, other| one.1.total_cmp(&other.1));
    nearest.map(|it| it.0).ok_or_else(no_times)
}

/// Description and step of the event of a name, from the history.
fn event(name: StepName, folder: &Path) -> Result<(&'static str, usize), StepError> {
    let path = folder.join("history.csv");
    if !path.is_file() {
        return Err(StepError::NoHistory {
            path: folder.to_path_buf(),
            name,
        });
    }
    let sheet = CsvTable::read(&path)?;
    let found = match name {
        StepName::First => {
            let rows = sheet.numbers(["step", "broken_in_step", "dissipated_energy"])?;
            let first = rows.into_iter().find(|row| row[1] > 0.0 || row[2] > 0.0);
            first.map(|[step, broken, _]| match broken > 0.0 {
                true => ("first breakage", step),
                false => ("first softening", step),
            })
        }
        _ => {
            let rows = sheet.numbers(["step", "reaction", "at_rest"])?;
            let answers = rows.iter().filter(|row| row[2] > 0.0 && row[0] > 0.0);
            let peak = answers.reduce(|best, row| if row[1] > best[1] { row } else { best });
            peak.map(|row| ("peak", row[0]))
        }
    };
    let found = found.map(|(what, step)| (what, step as usize));
    found.ok_or_else(|| StepError::DidNotHappen {
        path: folder.to_path_buf(),
        name,
    })
}

/// Time of a step of a motion, s; none in statics.
///
/// # Errors
///
/// If the history cannot be used.
pub fn time_of(folder: &Path, step: usize) -> Result<Option<f64>, Error> {
    let sheet = CsvTable::read(folder.join("history.csv"))?;
    if !is_in_time(sheet.columns()) {
        return Ok(None);
    }
    let rows = sheet.numbers(["step", TIME])?;
    let row = rows.into_iter().find(|it| it[0] == step as f64);
    Ok(row.map(|it| it[1]))
}

/// List of numbers for a message, abbreviated if long.
pub fn listed<N: ToString>(numbers: &[N]) -> String {
    const MOST: usize = 24;
    let words: Vec<String> = numbers.iter().map(N::to_string).collect();
    match words.as_slice() {
        [first @ .., last] if words.len() > MOST => {
            format!("{}, ..., {last}", first[..MOST - 2].join(", "))
        }
        all => all.join(", "),
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    const HISTORY: &str = "step,reaction,at_rest,broken_in_step,dissipated_energy\n0,0,1,0,0\n1,2,1,0,0\n2,5,1,0,1e-9\n\
        3,4,1,3,1e-6\n4,9,0,8,2e-6\n";

    fn folder(history: &str) -> tempfile::TempDir {
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join("history.csv"), history).unwrap();
        folder
    }

    fn ends(steps: &[usize]) -> Vec<StoredState> {
        steps.iter().copied().map(StoredState::end).collect()
    }

    fn found(word: &str, stored: &[usize]) -> Vec<NamedStep> {
        let choice: StepChoice = word.parse().unwrap();
        choice.steps(folder(HISTORY).path(), &ends(stored)).unwrap()
    }

    /// At the peak, step 2, the first bond softens; step 4 has a larger reaction, but its bonds were still breaking.
    #[test]
    fn names_lead_to_the_steps_in_which_something_happened() {
        let steps = |word| {
            found(word, &[0, 1, 2, 3, 4])
                .iter()
                .map(|it| it.state.step)
                .collect::<Vec<_>>()
        };
        assert_eq!(steps("first"), [2]);
        assert_eq!(steps("peak"), [2]);
        assert_eq!(steps("last"), [4]);
        assert_eq!(steps(" 3"), [3]);
        assert_eq!([steps("-1"), steps("-5")], [[4], [0]]);
        assert_eq!(steps("all"), [0, 1, 2, 3, 4]);
        let brittle = HISTORY.replace("1e-9", "0");
        let choice = StepChoice::One(StepName::First);
        let first = choice.steps(folder(&brittle).path(), &ends(&[3])).unwrap()[0];
        assert_eq!(first.words().unwrap()[0], "first breakage");
    }

    #[test]
    fn a_time_leads_to_the_nearest_stored_step_of_a_motion() {
        let columns = "step,time,time_steps,kinetic_energy,damping_energy,contact_energy,friction_energy,initial_energy";
        let row = |step: usize| format!("{step},{step}e-6,1,0,0,0,0,0");
        let rows: Vec<String> = (0..5).map(row).collect();
        let motion = folder(&format!("{columns}\n{}\n", rows.join("\n")));
        let step = |text: &str| {
            let choice: StepChoice = text.parse().unwrap();
            choice.steps(motion.path(), &ends(&[0, 2, 4])).unwrap()[0]
                .state
                .step
        };
        assert_eq!(["t=0", "t=1.2e-6", "t=1"].map(step), [0, 2, 4]);
        assert!("t=soon".parse::<StepChoice>().is_err());
        let choice: StepChoice = "t=1e-6".parse().unwrap();
        let error = choice
            .steps(folder(HISTORY).path(), &ends(&[0]))
            .unwrap_err();
        assert!(error.to_string().contains("it is no motion"), "{error}");
        assert_eq!(time_of(motion.path(), 3).unwrap(), Some(3e-6));
        assert_eq!(time_of(folder(HISTORY).path(), 3).unwrap(), None);
    }

    #[test]
    fn the_next_stored_step_stands_in_and_says_so() {
        let peak = found("peak", &[0, 3, 4])[0];
        assert_eq!((peak.state.step, peak.happened), (3, Some(("peak", 2))));
        let words = peak.words().unwrap();
        assert_eq!(
            words,
            ["next stored after the peak in step 2", "after the peak"]
        );
        // A run that was killed has no fields of its last steps.
        let before = found("first", &[0, 1])[0];
        assert_eq!(before.state.step, 1);
        let words = before.words().unwrap();
        assert_eq!(words[0], "last stored before the first softening in step 2");
        assert_eq!(
            found("first", &[2])[0].words().unwrap()[0],
            "first softening"
        );
        assert_eq!(found("last", &[0, 1])[0].words(), None);
    }

    #[test]
    fn states_between_breakages_have_names_of_their_own() {
        let stored = [
            StoredState::end(2),
            StoredState::between(3, 1),
            StoredState::between(3, 2),
            StoredState::end(3),
        ];
        let of = |word: &str| {
            let choice: StepChoice = word.parse().unwrap();
            let steps = choice.steps(folder(HISTORY).path(), &stored);
            steps.map(|all| {
                all.iter()
                    .map(|it| it.state.to_string())
                    .collect::<Vec<_>>()
            })
        };
        assert_eq!(of("3:2").unwrap(), ["3:2"]);
        assert_eq!(of("3").unwrap(), ["3"]);
        assert_eq!(of("3:").unwrap(), ["3:1", "3:2", "3"]);
        assert!(of("4:").is_err());
        assert_eq!(of("-2").unwrap(), ["3:2"]);
        assert_eq!(of("all").unwrap(), ["2", "3:1", "3:2", "3"]);
        let error = of("3:7").unwrap_err().to_string();
        assert!(
            error.ends_with("no output of step 3:7; there are 2, 3:1, 3:2, 3"),
            "{error}"
        );
    }

    #[test]
    fn what_is_not_there_is_told() {
        let error = |word: &str, history: &str| {
            let choice: StepChoice = word.parse().unwrap();
            choice
                .steps(folder(history).path(), &ends(&[0, 1]))
                .unwrap_err()
                .to_string()
        };
        assert!(error("-3", HISTORY).contains("no step -3: there is output of 2 steps"));
        assert!(error("7", HISTORY).ends_with("no output of step 7; there are 0, 1"));
        let intact = HISTORY.lines().take(2).collect::<Vec<_>>().join("\n") + "\n";
        assert!(error("first", &intact).contains("no bond broke or softened"));
        assert!(error("peak", &intact).contains("no step under load is at rest"));
        let empty = tempfile::tempdir().unwrap();
        let none = StepChoice::One(StepName::Peak)
            .steps(empty.path(), &ends(&[0]))
            .unwrap_err();
        assert!(none.to_string().contains("no history.csv"), "{none}");
        assert!(
            "paek"
                .parse::<StepChoice>()
                .is_err_and(|it| it.contains("peak, last or all"))
        );
        assert!(
            ["-0", "--1", "-x"]
                .iter()
                .all(|it| it.parse::<StepChoice>().is_err())
        );
    }
}
