//! A bench: a case, its model, its supports and loads, and what happens when it is run.

use std::path::Path;
use std::sync::{Arc, OnceLock};

use ligament::loading::contact_problem;
use ligament::run::{NoObserver, Solution, follow, on_pool};
use ligament::setup::ELASTIC_ENERGY_TOLERANCE;
use ligament::{Loading, Message};
use ligament_analysis::distributed_matrix::{MatrixCommunicator, SingleProcess};
use ligament_analysis::driver::{self, Outcome, Problem};
use ligament_analysis::history::{BreakRecord, Observer, ObserverError, StepRecord, View};
use ligament_analysis::probe::Probe;
use ligament_analysis::{ProportionalLoading, State};
use ligament_case::case::CaseFile;
use ligament_mesh::Mesh;
use ligament_model::correction::{CorrectionReport, DomainReport};
use ligament_output::summary::{Build, Summary};
use ligament_run::model::{Model, build_model_on};
use ligament_run::progress::{Progress, ProgressMode};
use ligament_run::run::{self, Report};
use ligament_run::stages::Stages;
use ligament_run::{repeat, resume};
use tempfile::TempDir;

use crate::meshes;

/// Everything about a case up to its first solution.
pub struct Bench {
    /// The case.
    pub case: CaseFile,
    /// Its model.
    pub model: Model,
    /// Its supports and loads.
    pub boundary: ProportionalLoading,
    probes: Arc<[Probe]>,
    positions: OnceLock<Vec<[f64; 2]>>,
    _folder: Option<TempDir>,
}

/// What a run gave.
pub struct Run {
    /// The outcome of the driver.
    pub outcome: Outcome,
    /// Bonds in the order in which they broke.
    pub breaks: Vec<BreakRecord>,
    /// Messages.
    pub messages: Vec<Message>,
    /// Number of unknowns held because nothing else would hold them, at the end of each load step.
    pub held: Vec<usize>,
    /// Largest residual (relative) of a load step.
    pub largest_residual: f64,
    /// Points in the smallest connected part, at the end of each load step.
    pub smallest_part: Vec<usize>,
}

/// Reads a case that lies in `tests/`; `settings` are `key=value` each, as with `--set`.
pub fn case(text: &str, settings: &[&str]) -> CaseFile {
    let path = crate::repository().join("tests/case.toml");
    let settings: Vec<String> = settings.iter().map(|&setting| setting.to_owned()).collect();
    match CaseFile::parse(&path, text.to_owned(), &settings) {
        Ok(case) => case,
        Err(error) => panic!("{error}"),
    }
}

/// Solution of a case that lies in `tests/`; `settings` are `key=value` each.
pub fn solved(text: &str, settings: &[&str]) -> Solution {
    let setup = case(text, settings).setup(&mut ()).unwrap();
    setup.solve(&mut NoObserver).unwrap()
}

/// The error of a case that lies in `tests/` and cannot be read, prepared or solved; `settings` are `key=value` each.
pub fn error_of(text: &str, settings: &[&str]) -> String {
    let path = crate::repository().join("tests/case.toml");
    let settings: Vec<String> = settings.iter().map(|&it| it.to_owned()).collect();
    let solved = CaseFile::parse(&path, text.to_owned(), &settings)
        .map_err(|it| it.to_string())
        .and_then(|it| it.setup(&mut ()).map_err(|it| it.to_string()))
        .and_then(|it| it.solve(&mut NoObserver).map_err(|it| it.to_string()));
    solved.expect_err("the case is wrong")
}

/// Whether a stored run is repeated to the bit on two threads.
pub fn is_repeated(folder: &Path) -> bool {
    let repeat = repeat::Request {
        folder,
        out: None,
        mesh: None,
        threads: Some(2),
        build: Build::default(),
        is_stopped: &|| false,
    };
    repeat.repeat(ProgressMode::Quiet).unwrap().is_same()
}

/// Resumes a stopped run up to its end.
pub fn resume_run(folder: &Path) {
    let resume = resume::Request {
        folder,
        mesh: None,
        settings: &[],
        threads: None,
        build: Build::default(),
        is_stopped: &|| false,
        communicator: Arc::new(SingleProcess),
    };
    resume.resume(ProgressMode::Quiet).unwrap();
}

/// Largest of what the ledger of energy misses in a history, over the largest work.
pub fn missing_energy(outcome: &Outcome) -> f64 {
    let largest = |of: &dyn Fn(&StepRecord) -> f64| {
        let values = outcome.history.iter().map(|it| of(it).abs());
        values.fold(0.0, f64::max)
    };
    largest(&|it| it.missing_energy()) / largest(&|it| it.external_work)
}

/// Writes a mesh into a folder and returns the setting that makes a case use it.
pub fn mesh_setting(mesh: &Mesh, folder: &Path) -> String {
    let path = folder.join("mesh.msh");
    std::fs::write(&path, meshes::to_gmsh(mesh)).unwrap();
    format!("mesh.file={}", path.display())
}

/// Runs the whole program on a case; its files are in `out`.
pub fn run_program(case: &CaseFile, out: &Path) -> Summary {
    match run::run(case, out, false, ProgressMode::Quiet).unwrap() {
        Report::Loading(summary) => *summary,
        Report::Modes(_) | Report::OfRankZero => panic!("this case has no loads"),
    }
}

/// Report on the domain correction of a model that has one.
pub fn domain(model: &Model) -> &DomainReport {
    let report = model.correction.as_ref().and_then(CorrectionReport::domain);
    report.expect("a domain correction")
}

impl Bench {
    /// A bench for a case on a mesh of the repository (named relative to `tests/`).
    pub fn new(text: &str, settings: &[&str]) -> Self {
        Self::from_case(case(text, settings), None, Arc::new(SingleProcess))
    }

    /// A bench of one of several ranks, which share the body out.
    pub fn on_ranks(text: &str, settings: &[&str], ranks: Arc<dyn MatrixCommunicator>) -> Self {
        Self::from_case(case(text, settings), None, ranks)
    }

    /// A bench for a case on another mesh than its own.
    pub fn on(mesh: &Mesh, text: &str, settings: &[&str]) -> Self {
        let folder = TempDir::new().unwrap();
        let file = mesh_setting(mesh, folder.path());
        let settings: Vec<&str> = settings.iter().copied().chain([file.as_str()]).collect();
        Self::from_case(case(text, &settings), Some(folder), Arc::new(SingleProcess))
    }

    fn from_case(
        case: CaseFile,
        folder: Option<TempDir>,
        ranks: Arc<dyn MatrixCommunicator>,
    ) -> Self {
        let progress = Progress::new(ProgressMode::Quiet);
        let model = build_model_on(&case, ranks, &mut Stages::default(), &progress).unwrap();
        let Loading {
            boundary, probes, ..
        } = Loading::new(&model).unwrap();
        Self {
            case,
            model,
            boundary: Arc::unwrap_or_clone(boundary),
            probes,
            positions: OnceLock::new(),
            _folder: folder,
        }
    }

    /// The problem of the bench.
    pub fn problem(&self) -> Problem {
        Problem {
            system: self.model.system.to_bonds(),
            criteria: self.model.criteria.clone(),
            loads: Arc::new(self.boundary.clone()),
            solver: self.model.setup.solver.clone(),
            probes: self.probes.clone(),
            notches: self.model.notches.clone(),
            face_friction: self.model.setup.closing_friction,
            contact: contact_problem(&self.model).unwrap(),
        }
    }

    /// Solves the linear problem at load factor 1; no bond breaks.
    pub fn solve(&self) -> Run {
        self.watched(|watch| {
            driver::elastic::run(&self.problem(), ELASTIC_ENERGY_TOLERANCE, watch).unwrap()
        })
    }

    /// Follows the loading as the fracture section says.
    pub fn break_up(&self) -> Run {
        let analysis = &self.model.setup.analysis;
        assert!(analysis.is_fracture());
        self.watched(|watch| follow(&self.problem(), analysis, watch).unwrap())
    }

    fn watched(&self, run: impl FnOnce(&mut dyn Observer) -> Outcome + Send) -> Run {
        let mut watch = Watch::default();
        let communicator = &*self.model.setup.solver.communicator;
        let outcome = on_pool(communicator, || run(&mut watch));
        Run {
            outcome,
            breaks: watch.breaks,
            messages: watch.messages,
            held: watch.held,
            largest_residual: watch.largest_residual,
            smallest_part: watch.smallest_part,
        }
    }

    /// Limits of the first criterion, shape (n_bonds).
    pub fn limits(&self) -> &[f64] {
        &self.model.criteria.list[0].limit
    }

    /// Number of points.
    pub fn points(&self) -> usize {
        self.model.system.n_points()
    }

    /// Values of the points, so many a point, in the order of the mesh file.
    pub fn in_file(&self, values: &[f64]) -> Vec<f64> {
        self.model.body().numbering().to_file(values.to_vec())
    }

    /// Bonds in the order of their ends in the mesh file.
    pub fn bonds_in_file(&self) -> Vec<u32> {
        let ends = &self.model.system.ends;
        let order = self.model.body().numbering().bonds_in_file(ends);
        order.unwrap_or_else(|| (0..ends.len() as u32).collect())
    }

    /// Values of the bonds in that order.
    pub fn of_bonds(&self, values: &[f64]) -> Vec<f64> {
        let bonds = self.bonds_in_file().into_iter();
        bonds.map(|bond| values[bond as usize]).collect()
    }

    /// Nodes of the ends of a bond in the mesh file, ascending.
    pub fn nodes_of_bond(&self, bond: u32) -> [u32; 2] {
        let ends = self.model.system.ends[bond as usize];
        self.model.body().numbering().ends_in_file(ends)
    }

    /// Positions of the nodes of the mesh, or of the centres of the cells, in the order of the points.
    pub fn positions(&self) -> &[[f64; 2]] {
        let body = self.model.setup.body.geometry();
        self.positions.get_or_init(|| body.positions().into_owned())
    }

    /// Points of a group.
    pub fn group(&self, name: &str) -> Vec<u32> {
        self.model.body().points_of(name).unwrap()
    }

    /// Tags of the ends of a bond, the smaller first.
    pub fn tags_of_bond(&self, bond: usize) -> [u64; 2] {
        let [a, b] = self.model.system.ends[bond].map(|end| self.model.body().tag(end));
        [a.min(b), a.max(b)]
    }
}

impl Run {
    /// Whether a message of a kind was told.
    pub fn told(&self, kind: &str) -> bool {
        self.messages.iter().any(|it| it.kind == kind)
    }

    /// Displacements and rotations of the last state, shape (n_degrees_of_freedom).
    pub fn displacement(&self) -> &[f64] {
        &self.outcome.state.displacement
    }

    /// The last load step.
    pub fn last(&self) -> &StepRecord {
        self.outcome.history.last().unwrap()
    }

    /// The last state.
    pub fn state(&self) -> &State {
        &self.outcome.state
    }

    /// Force along x and y and moments of the points of a group at the last load step.
    pub fn group_force(&self, bench: &Bench, name: &str) -> [f64; 3] {
        let groups = &bench.boundary.groups;
        let place = groups.iter().position(|group| group.name == name).unwrap();
        let layout = bench.model.system.layout;
        let components = layout.of_body();
        [0, 1, 2].map(|it| layout.value(0, components[it], &self.last().group_forces[place]))
    }
}

/// Keeps what a run tells.
#[derive(Default)]
pub struct Watch {
    /// Bonds in the order in which they broke.
    pub breaks: Vec<BreakRecord>,
    /// Displacements at the end of each load step, where they are wanted.
    pub displacements: Option<Vec<Vec<f64>>>,
    /// Messages.
    pub messages: Vec<Message>,
    /// Number of unknowns held because nothing else would hold them, at the end of each load step.
    pub held: Vec<usize>,
    /// Largest residual (relative) of a load step.
    pub largest_residual: f64,
    /// Points in the smallest connected part, at the end of each load step.
    pub smallest_part: Vec<usize>,
}

impl Observer for Watch {
    fn broke(&mut self, records: &[BreakRecord]) -> Result<(), ObserverError> {
        self.breaks.extend_from_slice(records);
        Ok(())
    }

    fn message(&mut self, message: Message) -> Result<(), ObserverError> {
        self.messages.push(message);
        Ok(())
    }

    fn step(&mut self, _: &StepRecord, view: &View<'_>) -> Result<(), ObserverError> {
        let (subdomain, layout) = (&view.system.subdomain, view.system.layout);
        let is_held = |dof: &usize| view.state.held[*dof];
        let dofs = subdomain.owned().flat_map(|point| layout.range(point));
        self.held
            .push(subdomain.count(dofs.filter(is_held).count()));
        self.largest_residual = self.largest_residual.max(view.balanced.residual);
        let parts = view.fragments.points.iter().map(Vec::len);
        self.smallest_part.push(parts.min().unwrap_or(0));
        if let Some(displacements) = &mut self.displacements {
            displacements.push(view.state.displacement.clone());
        }
        Ok(())
    }
}
