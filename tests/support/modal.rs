//! A modal bench: a case with its model, supports and masses, and its modes.

use std::sync::Arc;

use ligament::Vibration;
use ligament::setup::Analysis;
use ligament_analysis::modal::{ModalAnalysis, ModalOutcome, ModalProblem, Rotations};
use ligament_analysis::{Component, Supports, Unknowns};
use ligament_case::case::CaseFile;
use ligament_mesh::Mesh;
use ligament_model::LumpedMass;
use ligament_run::model::{Model, build_model};
use ligament_run::progress::{Progress, ProgressMode};
use ligament_run::stages::Stages;
use tempfile::TempDir;

use crate::bench::{case, mesh_setting};

/// Everything about a modal case up to its modes.
pub struct ModalBench {
    /// The case.
    pub case: CaseFile,
    /// Its model.
    pub model: Model,
    /// Its supports.
    pub supports: Arc<Supports>,
    /// The masses of its points.
    pub mass: Arc<LumpedMass>,
}

impl ModalBench {
    /// A bench for a case on a mesh of the repository (named relative to `tests/`).
    pub fn new(text: &str, settings: &[&str]) -> Self {
        Self::from_case(case(text, settings))
    }

    /// A bench for a case on another mesh than its own.
    pub fn on(mesh: &Mesh, text: &str, settings: &[&str]) -> Self {
        let folder = TempDir::new().unwrap();
        let file = mesh_setting(mesh, folder.path());
        let settings: Vec<&str> = settings.iter().copied().chain([file.as_str()]).collect();
        Self::new(text, &settings)
    }

    fn from_case(case: CaseFile) -> Self {
        let progress = Progress::new(ProgressMode::Quiet);
        let model = build_model(&case, &mut Stages::default(), &progress).unwrap();
        let vibration = Vibration::new(&model).unwrap();
        Self {
            supports: vibration.supports,
            mass: vibration.mass,
            model,
            case,
        }
    }

    /// Finds its modes.
    pub fn find(&self) -> ModalOutcome {
        let problem = ModalProblem {
            system: self.model.system.to_bonds(),
            mass: self.mass.clone(),
            supports: self.supports.clone(),
            solver: self.model.setup.solver.clone(),
        };
        let Analysis::Modal(settings) = self.model.setup.analysis else {
            panic!("this case is not modal");
        };
        ModalAnalysis::new(&problem, settings)
            .unwrap()
            .find()
            .unwrap()
    }

    /// The degrees of freedom that are unknown, and their masses.
    pub fn unknown_masses(&self, rotations: Rotations) -> Vec<(usize, f64)> {
        let unknowns = Unknowns::all_but(&*self.model.system, |dof| self.supports.held[dof]);
        let layout = unknowns.layout();
        let mass_of = |dof: usize| match (layout.component(dof), rotations) {
            (Component::Rotation, Rotations::Massless) => 0.0,
            (Component::Rotation, Rotations::Inertia) => {
                self.mass.inertia[layout.point(dof) as usize]
            }
            _ => self.mass.mass[layout.point(dof) as usize],
        };
        let dofs = unknowns.degrees_of_freedom().iter();
        dofs.map(|&dof| (dof as usize, mass_of(dof as usize)))
            .collect()
    }
}
