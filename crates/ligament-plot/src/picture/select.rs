//! Selection of the outputs of a folder to draw.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use ligament_output::csv::read::CsvTable;
use ligament_output::remedy::Remedy;
use ligament_output::results::StoredState;
use ligament_output::results::outputs::{OutputKind, Outputs};
use ligament_output::results::steps::{NamedStep, StepChoice, StepName};
use ligament_output::vtu::read::VtuFile;

use super::PictureError;

/// Modes that are drawn when none are named.
const FIRST_MODES: usize = 6;

/// A choice of outputs to draw.
#[derive(Debug, Clone, PartialEq)]
pub enum Choice {
    /// The last one; for modes the first six.
    Default,
    /// Outputs with these names.
    Steps(Vec<StepChoice>),
    /// This number of outputs, evenly spread over all.
    Strip(usize),
    /// Outputs nearest to these displacements of the load.
    Displacements(Vec<f64>),
}

/// The load of a state, as in the row of the history of its step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct HistoryRow {
    /// Load factor; in a motion the time, s.
    pub(super) load_factor: f64,
    /// Displacement of the first load.
    pub(super) displacement: f64,
    /// Force of the first load.
    pub(super) reaction: f64,
    /// Whether no bond was left to break there.
    pub(super) at_rest: bool,
}

/// The rows of a history by their steps; none where there is no history.
pub(super) fn history_rows(folder: &Path) -> Result<BTreeMap<usize, HistoryRow>, PictureError> {
    let path = folder.join("history.csv");
    if !path.is_file() {
        return Ok(BTreeMap::new());
    }
    let rows = CsvTable::read(path)?.rows(|row| {
        let displacement = row.value("displacement")?;
        let reaction = row.value("reaction")?;
        let history_row = HistoryRow {
            // A history without load factors has NaN.
            load_factor: row.number("load_factor").unwrap_or(f64::NAN),
            displacement,
            reaction,
            at_rest: row.value::<u8>("at_rest").map_or(true, |it| it != 0),
        };
        Ok((row.value("step")?, history_row))
    })?;
    Ok(rows.into_iter().collect())
}

/// Load of a state between breakages, by the field data of its file.
fn load_between_breakages(path: &Path) -> Result<HistoryRow, PictureError> {
    let file = VtuFile::open(path)?;
    let values = file.field_data()?;
    let value = |name: &str| {
        let found = values.iter().find(|it| it.0 == name);
        found.map_or(f64::NAN, |it| it.1)
    };
    Ok(HistoryRow {
        load_factor: value("load_factor"),
        displacement: value("load_displacement"),
        reaction: value("load_reaction"),
        at_rest: true,
    })
}

/// An output to draw.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct SelectedOutput {
    /// State, or number of the mode.
    pub(super) state: StoredState,
    /// File of the output.
    pub(super) path: PathBuf,
    /// Long and short description of the event that selected the step, if any.
    pub(super) happened: Option<[String; 2]>,
    /// Load of the state, where it is known.
    pub(super) load: Option<HistoryRow>,
}

impl SelectedOutput {
    fn new(
        outputs: &Outputs,
        rows: &BTreeMap<usize, HistoryRow>,
        (state, happened): (StoredState, Option<[String; 2]>),
    ) -> Result<Self, PictureError> {
        let path = outputs.files[&state].clone();
        let load = match state.breakages() {
            Some(_) => Some(load_between_breakages(&path)?),
            None => rows.get(&state.step).copied(),
        };
        Ok(Self {
            state,
            path,
            happened,
            load,
        })
    }
}

/// The chosen outputs, in the order of the choice.
pub(super) fn selected_outputs(
    outputs: &Outputs,
    choice: &Choice,
    rows: &BTreeMap<usize, HistoryRow>,
) -> Result<Vec<SelectedOutput>, PictureError> {
    let all = outputs.states();
    let last = all.len() - 1;
    let states = match choice {
        Choice::Default if outputs.kind == OutputKind::Modes => {
            all.iter().copied().take(FIRST_MODES).collect()
        }
        Choice::Default | Choice::Strip(1) => vec![all[last]],
        Choice::Steps(steps) => return outputs_by_name(outputs, steps, (&all, rows)),
        Choice::Strip(count) => {
            let count = (*count).min(all.len());
            let place = |it: usize| (2 * it * last + count - 1) / (2 * (count - 1)).max(1);
            (0..count).map(|it| all[place(it).min(last)]).collect()
        }
        Choice::Displacements(displacements) => {
            let of_outputs = || {
                let ends = all.iter().filter(|it| it.breakages().is_none());
                let rows = ends.map(|it| Some((*it, rows.get(&it.step)?)));
                rows.flatten()
            };
            let nearest = |wanted: &f64| {
                let away =
                    |(_, row): &(StoredState, &HistoryRow)| (row.displacement - wanted).abs();
                let nearest = of_outputs().min_by(|a, b| away(a).total_cmp(&away(b)));
                nearest.map(|(state, _)| state)
            };
            let found: Option<Vec<StoredState>> = displacements.iter().map(nearest).collect();
            found.ok_or_else(|| PictureError::NoHistory(outputs.folder.clone()))?
        }
    };
    let output = |state| SelectedOutput::new(outputs, rows, (state, None));
    states.into_iter().map(output).collect()
}

/// Outputs selected by name.
fn outputs_by_name(
    outputs: &Outputs,
    names: &[StepChoice],
    (all, rows): (&[StoredState], &BTreeMap<usize, HistoryRow>),
) -> Result<Vec<SelectedOutput>, PictureError> {
    let mut found: Vec<NamedStep> = Vec::new();
    for name in names {
        if outputs.kind == OutputKind::Modes {
            require_mode(outputs, *name, all)?;
        }
        found.extend(name.steps(&outputs.folder, all)?);
    }
    let output = |it: &NamedStep| SelectedOutput::new(outputs, rows, (it.state, it.words()));
    found.iter().map(output).collect()
}

/// Checks that a mode is requested by number and exists.
fn require_mode(
    outputs: &Outputs,
    name: StepChoice,
    all: &[StoredState],
) -> Result<(), PictureError> {
    let path = outputs.folder.clone();
    match name {
        StepChoice::One(StepName::State(mode)) if !all.contains(&mode) => {
            let known = all.to_vec();
            Err(PictureError::NoSuchMode { path, mode, known })
        }
        StepChoice::One(
            StepName::First | StepName::Peak | StepName::FromEnd(_) | StepName::At(_),
        ) => Err(PictureError::Modes {
            path,
            what: "first breakage and no peak",
            remedy: Remedy::OmitOption("step"),
        }),
        StepChoice::All
        | StepChoice::Step(_)
        | StepChoice::One(StepName::Last | StepName::State(_)) => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn outputs(kind: OutputKind, steps: &[usize]) -> Outputs {
        Outputs {
            folder: PathBuf::from("results"),
            kind,
            files: steps
                .iter()
                .map(|&it| (StoredState::end(it), PathBuf::from(it.to_string())))
                .collect(),
        }
    }

    fn steps(choice: &Choice) -> Vec<usize> {
        let outputs = outputs(OutputKind::Steps, &[0, 5, 10, 15, 20, 25, 27]);
        let rows =
            [(0, 0.0), (5, 1.0), (10, 2.0), (20, 4.0), (27, 1.1)].map(|(step, displacement)| {
                (
                    step,
                    HistoryRow {
                        load_factor: 0.0,
                        displacement,
                        reaction: 0.0,
                        at_rest: true,
                    },
                )
            });
        let found = selected_outputs(&outputs, choice, &BTreeMap::from(rows));
        found.unwrap().into_iter().map(|it| it.state.step).collect()
    }

    #[test]
    fn strips_are_spread_from_the_first_to_the_last_output() {
        assert_eq!(steps(&Choice::Strip(2)), [0, 27]);
        assert_eq!(steps(&Choice::Strip(3)), [0, 15, 27]);
        assert_eq!(steps(&Choice::Strip(4)), [0, 10, 20, 27]);
        assert_eq!(steps(&Choice::Strip(7)), [0, 5, 10, 15, 20, 25, 27]);
        assert_eq!(steps(&Choice::Strip(50)).len(), 7);
        assert_eq!(steps(&Choice::Strip(1)), [27]);
    }

    #[test]
    fn outputs_are_named_or_nearest_to_a_displacement() {
        assert_eq!(steps(&Choice::Default), [27]);
        let numbers = |numbers: &[usize]| {
            let names = numbers
                .iter()
                .map(|it| StepChoice::One(StepName::State((*it).into())));
            Choice::Steps(names.collect())
        };
        assert_eq!(steps(&numbers(&[20, 5])), [20, 5]);
        assert_eq!(steps(&Choice::Steps(vec![StepChoice::All])).len(), 7);
        assert_eq!(
            steps(&Choice::Displacements(vec![1.04, 3.5, -1.0])),
            [5, 20, 0]
        );
        let few = outputs(OutputKind::Steps, &[0, 100]);
        let error = selected_outputs(&few, &numbers(&[50]), &BTreeMap::new()).unwrap_err();
        assert!(
            error
                .to_string()
                .contains("no output of step 50; there are 0, 100"),
            "{error}"
        );
        let error = selected_outputs(&few, &Choice::Displacements(vec![1.0]), &BTreeMap::new());
        assert!(matches!(error, Err(PictureError::NoHistory(_))));
    }

    #[test]
    fn the_first_modes_are_drawn() {
        let modes = outputs(OutputKind::Modes, &[1, 2, 3, 4, 5, 6, 7, 8]);
        let found = selected_outputs(&modes, &Choice::Default, &BTreeMap::new()).unwrap();
        assert_eq!(found.len(), 6);
    }
}
