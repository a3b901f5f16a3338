//! Identity of an ensemble: the inputs that all samples of a folder share.

use ligament::ensemble::Ensemble;
use ligament_case::case::CaseFile;
use ligament_output::{Error, read_json};
use ligament_run::inputs::{FileIdentities, Inputs, unreadable_file};
use serde::{Deserialize, Serialize};

use super::grid::Grid;
use super::request::Request;
use crate::run_table::folder::StudyFolder;

/// File that marks the folder of an ensemble.
pub(super) const MARKER: &str = "ensemble.json";

/// Identity of an ensemble, with the path of the body without random factors.
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
    /// Inputs of the case except the seed of its first random property.
    inputs: String,
}

impl Identity {
    /// The identity of a new folder for a request, by the path of the body without random factors.
    pub(super) fn new(request: &Request<'_>, ensemble: &Ensemble) -> anyhow::Result<Self> {
        let case = request.case;
        let sound = ensemble
            .sound()
            .map_err(|it| case.error_in_case_terms(it))?
            .outcome;
        let grid = Grid::new(request.points, request.displacement, &sound);
        anyhow::ensure!(
            grid.end > 0.0,
            "without random factors the body does not move: give the largest displacement of the curves by --to"
        );
        Ok(Self {
            title: case.case.title.clone(),
            case: case.source.path.to_string_lossy().into_owned(),
            version: env!("CARGO_PKG_VERSION").to_owned(),
            seed: request.seed,
            grid,
            sound_peak: sound.peak().map(|it| it.reaction),
            sound: grid.loads(&sound),
            inputs: inputs(case)?,
        })
    }

    /// The identity of a folder.
    ///
    /// # Errors
    ///
    /// If the file cannot be read.
    pub(super) fn from_folder(folder: &StudyFolder) -> Result<Self, Error> {
        read_json(&folder.path().join(MARKER))
    }

    /// The identity of a folder for the samples of a request.
    ///
    /// # Errors
    ///
    /// If the samples in the folder are of another case, seed or grid: they cannot be counted together.
    pub(super) fn for_request(folder: &StudyFolder, request: &Request<'_>) -> anyhow::Result<Self> {
        let found = Self::from_folder(folder)?;
        let other = |what: &str| {
            Err(anyhow::anyhow!(
                "{} has samples of another {what}; name another folder by --out, or begin anew by --force",
                folder.path().display()
            ))
        };
        if found.seed != request.seed {
            return other(&format!("seed, {}", found.seed));
        }
        let end = request.displacement.unwrap_or(found.grid.end);
        if found.grid.n != request.points || found.grid.end != end {
            return other("grid");
        }
        let inputs = inputs(request.case)?;
        if inputs != found.inputs {
            let changed = inputs.lines().find(|line| !found.inputs.contains(line));
            let changed = changed.map_or(String::new(), |line| format!(" (now {line})"));
            return other(&format!("case{changed}"));
        }
        Ok(found)
    }

    /// Text of the file.
    pub(super) fn text(&self) -> anyhow::Result<String> {
        Ok(serde_json::to_string_pretty(self)? + "\n")
    }

    /// Whether samples of two folders can be counted together.
    pub(super) fn has_same_samples(&self, other: &Self) -> bool {
        self.seed == other.seed && self.grid == other.grid && self.inputs == other.inputs
    }
}

/// Inputs of a case that affect samples: all but the seed of its first random property and its output.
fn inputs(case: &CaseFile) -> anyhow::Result<String> {
    let mut plain = case.clone();
    let fracture = plain.case.fracture.as_mut();
    let scatter = fracture.and_then(|it| it.scatter.as_mut());
    if let Some(first) = scatter.and_then(|it| it.0.first_mut()) {
        first.seed = Some(0);
    }
    plain.case.output = Default::default();
    let inputs =
        Inputs::from_case(&plain, None, &mut FileIdentities::default()).map_err(unreadable_file)?;
    Ok(inputs.text().to_owned())
}
