//! What the samples of a folder are of.

use std::path::Path;

use anyhow::Context;
use ligament::ensemble::{Ensemble, SampledPath};
use ligament_case::case::CaseFile;
use ligament_output::read_text;
use ligament_run::inputs::{Contents, Inputs};
use serde::{Deserialize, Serialize};

use super::grid::Grid;
use crate::sweep::folder::StudyFolder;

/// File that marks the folder of an ensemble.
pub(super) const MARKER: &str = "ensemble.json";

/// What the samples of a folder are of, with the path of the body without random factors.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct Identity {
    title: String,
    case: String,
    version: String,
    /// Seed of the ensemble.
    pub(super) seed: u64,
    /// Displacements at which curves are compared.
    pub(super) grid: Grid,
    /// Largest load of the body without random factors.
    pub(super) sound_peak: Option<f64>,
    /// Loads of the body without random factors at the displacements of the grid.
    pub(super) sound: Vec<Option<f64>>,
    /// Inputs of the case but the seed of its first random property.
    inputs: String,
}

impl Identity {
    /// The identity of an ensemble, whose body without random factors has a path.
    pub(super) fn new(
        case: &CaseFile,
        seed: u64,
        grid: Grid,
        sound: &SampledPath,
    ) -> anyhow::Result<Self> {
        let loads = grid.loads(&sound.outcome).into_iter();
        Ok(Self {
            title: case.case.title.clone(),
            case: case.source.path.to_string_lossy().into_owned(),
            version: env!("CARGO_PKG_VERSION").to_owned(),
            seed,
            grid,
            sound_peak: sound.outcome.peak().map(|it| it.reaction),
            sound: loads.collect(),
            inputs: inputs(case)?,
        })
    }

    /// The identity of a folder.
    ///
    /// # Errors
    ///
    /// If the file cannot be read.
    pub(super) fn of_folder(folder: &StudyFolder) -> anyhow::Result<Self> {
        Self::of_file(&folder.path().join(MARKER))
    }

    fn of_file(path: &Path) -> anyhow::Result<Self> {
        let read = serde_json::from_str(&read_text(path)?);
        read.with_context(|| format!("cannot read {}", path.display()))
    }

    /// Text of the file.
    pub(super) fn text(&self) -> anyhow::Result<String> {
        Ok(serde_json::to_string_pretty(self)? + "\n")
    }

    /// Refuses samples of another case, seed or grid in a folder: they cannot be counted together.
    pub(super) fn require(&self, wanted: &Wanted<'_>, folder: &Path) -> anyhow::Result<()> {
        let other = |what: &str| {
            anyhow::anyhow!(
                "{} has samples of another {what}; name another folder by --out, or begin anew by --force",
                folder.display()
            )
        };
        if self.seed != wanted.seed {
            return Err(other(&format!("seed, {}", self.seed)));
        }
        let (n, end) = wanted.grid;
        if n != self.grid.n || end.is_some_and(|it| it != self.grid.end) {
            return Err(other("grid"));
        }
        let inputs = inputs(wanted.case)?;
        if inputs != self.inputs {
            let changed = inputs.lines().find(|line| !self.inputs.contains(line));
            let changed = changed.map_or(String::new(), |line| format!(" (now {line})"));
            return Err(other(&format!("case{changed}")));
        }
        Ok(())
    }

    /// Whether samples of two folders can be counted together.
    pub(super) fn is_of_same(&self, other: &Self) -> bool {
        self.seed == other.seed && self.grid == other.grid && self.inputs == other.inputs
    }
}

/// What is asked for: a case, a seed, and the number of displacements with the largest one, if it is given.
#[derive(Debug, Clone, Copy)]
pub(super) struct Wanted<'a> {
    pub(super) case: &'a CaseFile,
    pub(super) seed: u64,
    pub(super) grid: (usize, Option<f64>),
}

impl Wanted<'_> {
    /// The identity of a new folder.
    pub(super) fn begun(&self, ensemble: &Ensemble) -> anyhow::Result<Identity> {
        let sound = ensemble.sound().map_err(|it| self.case.explained(it))?;
        let (n, end) = self.grid;
        let grid = Grid::new(n, end, &sound.outcome);
        anyhow::ensure!(
            grid.end > 0.0,
            "without random factors the body does not move: give the largest displacement of the curves by --to"
        );
        Identity::new(self.case, self.seed, grid, &sound)
    }
}

/// Inputs of a case but those that change no sample: the seed of its first random property and its output.
fn inputs(case: &CaseFile) -> anyhow::Result<String> {
    let mut plain = case.clone();
    let fracture = plain.case.fracture.as_mut();
    let scatter = fracture.and_then(|it| it.scatter.as_mut());
    if let Some(first) = scatter.and_then(|it| it.0.first_mut()) {
        first.seed = Some(0);
    }
    plain.case.output = Default::default();
    let inputs = Inputs::from_case(&plain, None, &mut Contents::default());
    let inputs = inputs.map_err(|(path, error)| {
        anyhow::Error::new(error).context(format!("cannot read {}", path.display()))
    })?;
    Ok(inputs.text().to_owned())
}
