//! A case of the repository, run in memory with changed settings.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use anyhow::Context;
use ligament::run::{NoObserver, Solution};
use ligament::{Model, Setup};
use ligament_analysis::history::BreakRecord;
use ligament_analysis::modal::Mode;
use ligament_analysis::{Component, Observer, Termination};

use ligament_case::case::CaseFile;

use super::crack_path::Breakages;
use super::places::repository;

/// A number of an experiment by its name, such as the radius of a disk. Entries share the values read from one run, so a number that differs between
/// entries must be part of the name of a quantity.
pub(super) type Number<'a> = &'a dyn Fn(&str) -> anyhow::Result<f64>;

/// A case with settings (`key=value`, as with `--set`) for a run.
#[derive(Clone)]
pub(super) struct CaseRun {
    /// Path of the case in the repository.
    path: String,
    text: String,
    settings: Vec<String>,
    mesh_file: Option<PathBuf>,
}

impl CaseRun {
    /// A run of a case file, given by the path from the root of the repository, without settings.
    pub(super) fn from_file(path: &str) -> anyhow::Result<Self> {
        let text = std::fs::read_to_string(repository().join(path));
        Ok(Self {
            path: path.to_owned(),
            text: text.with_context(|| path.to_owned())?,
            settings: Vec::new(),
            mesh_file: None,
        })
    }

    /// The case run with one more setting.
    pub(super) fn set(mut self, key: &str, value: impl std::fmt::Debug) -> Self {
        self.settings.push(format!("{key}={value:?}"));
        self
    }

    /// The case run with a setting whose value is a text in TOML, such as an array of tables.
    pub(super) fn set_toml(mut self, key: &str, value: &str) -> Self {
        self.settings.push(format!("{key}={value}"));
        self
    }

    /// The case run on a mesh file.
    pub(super) fn on_mesh_file(self, path: PathBuf) -> Self {
        Self {
            mesh_file: Some(path.clone()),
            ..self.set("mesh.file", path)
        }
    }

    /// The mesh file that was set.
    pub(super) fn mesh_file(&self) -> Option<&Path> {
        self.mesh_file.as_deref()
    }

    /// Runs the case, as `ligament run` does.
    pub(super) fn solve(&self) -> anyhow::Result<Solution> {
        self.solve_with_observer(&mut NoObserver)
    }

    /// Runs the case with an observer.
    pub(super) fn solve_with_observer(
        &self,
        observer: &mut (dyn Observer + Send),
    ) -> anyhow::Result<Solution> {
        self.with_setup(|case, setup| run(case, setup, observer))
    }

    /// Runs the case until no equilibrium exists.
    pub(super) fn solve_to_the_end(&self) -> anyhow::Result<Solution> {
        self.with_setup(|case, setup| {
            let solution = setup.solve(&mut NoObserver);
            solution.map_err(|error| case.error_in_case_terms(error))
        })
    }

    /// Runs the case, and returns all breakages in their order.
    pub(super) fn solve_with_breakages(&self) -> anyhow::Result<(Solution, Vec<BreakRecord>)> {
        let mut breakages = Breakages::default();
        let solution = self.solve_with_observer(&mut breakages)?;
        Ok((solution, breakages.records))
    }

    /// The discrete model of the case, as `ligament run` builds it.
    pub(super) fn model(&self) -> anyhow::Result<Model> {
        self.model_with(|_| {})
    }

    /// The discrete model of the case after a change of its setup.
    pub(super) fn model_with(&self, change: impl FnOnce(&mut Setup)) -> anyhow::Result<Model> {
        self.with_setup(|case, mut setup| {
            change(&mut setup);
            Ok(Model::build(setup, &mut ()).map_err(|error| case.error_at_key(error))?)
        })
    }

    /// The natural modes of the case, as `ligament run` finds them.
    pub(super) fn modes(&self) -> anyhow::Result<Vec<Mode>> {
        self.with_setup(|case, setup| {
            let found = setup
                .modes()
                .map_err(|error| case.error_in_case_terms(error))?;
            match found.messages.first() {
                Some(message) => Err(anyhow::anyhow!("{message}")),
                None => Ok(found.modes),
            }
        })
    }

    /// Result of `work` on the setup of the case; errors include the command.
    fn with_setup<T>(
        &self,
        work: impl FnOnce(&CaseFile, Setup) -> anyhow::Result<T>,
    ) -> anyhow::Result<T> {
        let attempt = || {
            let path = repository().join(&self.path);
            let case = CaseFile::parse(&path, self.text.clone(), &self.settings)?;
            let setup = case.setup(&mut ())?;
            work(&case, setup)
        };
        attempt().with_context(|| self.command())
    }

    /// The command that runs the same case.
    pub(super) fn command(&self) -> String {
        let settings = self.settings.iter();
        let words: Vec<String> = settings
            .map(|setting| format!(" --set {setting}"))
            .collect();
        format!("ligament run {}{}", self.path, words.concat())
    }
}

/// Solves a setup; a run that ends without equilibrium or during breakage is an error.
fn run(
    case: &CaseFile,
    setup: Setup,
    observer: &mut (dyn Observer + Send),
) -> anyhow::Result<Solution> {
    let solution = setup.solve(observer);
    let solution = solution.map_err(|error| case.error_in_case_terms(error))?;
    match &solution.outcome.termination {
        Termination::NoEquilibrium { .. } | Termination::NotAtRest { .. } => {
            Err(anyhow::anyhow!("{}", solution.outcome.termination))
        }
        _ => Ok(solution),
    }
}

/// The displacement of the point nearest to a position, in the last state of a run, m.
pub(super) fn displacement_at(solution: &Solution, place: [f64; 2]) -> [f64; 2] {
    let point = solution.model.plane().cloud.nearest_point(place);
    displacement(solution, point)
}

/// The displacements of all points in the last state of a run, m.
pub(super) fn displacements(solution: &Solution) -> impl Iterator<Item = [f64; 2]> + '_ {
    let points = 0..solution.model.plane().cloud.len() as u32;
    points.map(|point| displacement(solution, point))
}

fn displacement(solution: &Solution, point: u32) -> [f64; 2] {
    let (layout, motions) = (
        solution.model.plane().topology().layout,
        &solution.outcome.state.displacement,
    );
    [Component::X, Component::Y].map(|component| layout.value(point, component, motions))
}

/// The largest |u_x| and |u_y| of all points in the last state of a run, m.
pub(super) fn largest_displacements(solution: &Solution) -> anyhow::Result<[f64; 2]> {
    Ok(displacements(solution).fold([0.0, 0.0], |[x, y], [u, v]| {
        [u.abs().max(x), v.abs().max(y)]
    }))
}

/// Cached results of runs that several entries share, by the commands of the runs.
#[derive(Debug)]
pub(super) struct ResultCache<T>(BTreeMap<String, T>);

impl<T: Clone> ResultCache<T> {
    /// The result of a run, computed on its first use.
    pub(super) fn result(
        &mut self,
        command: String,
        run: impl FnOnce() -> anyhow::Result<T>,
    ) -> anyhow::Result<T> {
        if let Some(result) = self.0.get(&command) {
            return Ok(result.clone());
        }
        let result = run()?;
        self.0.insert(command, result.clone());
        Ok(result)
    }

    /// The reading from a case run, computed on its first use.
    pub(super) fn reading(
        &mut self,
        case_run: &CaseRun,
        read: impl FnOnce(&Solution) -> anyhow::Result<T>,
    ) -> anyhow::Result<T> {
        self.result(case_run.command(), || read(&case_run.solve()?))
    }
}

impl<T> Default for ResultCache<T> {
    fn default() -> Self {
        Self(BTreeMap::new())
    }
}
