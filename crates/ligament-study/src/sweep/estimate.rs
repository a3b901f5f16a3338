//! Estimates of the memory of runs.

use std::collections::BTreeMap;

use ligament::run::on_threads;
use ligament::setup::{Analysis, ELASTIC_ENERGY_TOLERANCE, Surface};
use ligament::{Loading, Vibration};
use ligament_analysis::Equilibrium;
use ligament_analysis::modal::ModalAnalysis;

use ligament_case::case::{CaseFile, Word};
use ligament_run::memory;
use ligament_run::model::build_model;
use ligament_run::progress::{Progress, ProgressMode};
use ligament_run::stages::Stages;

/// Memory estimates so far; runs with the same body, horizons and supports share one.
#[derive(Debug, Default)]
pub(super) struct Estimates(BTreeMap<String, Option<u64>>);

impl Estimates {
    /// Upper estimate of a case's memory, bytes; `None` where its model cannot be built, which its run will report.
    pub(super) fn bytes(&mut self, case: &CaseFile) -> Option<u64> {
        let given = &case.case;
        let key = serde_json::to_string(&(
            &given.mesh,
            &given.lattice,
            &given.model,
            &given.precracks,
            &given.supports,
            given.solver.ordering,
            given.solver.method,
        ));
        // A case that cannot be serialised gets an estimate of its own.
        let Ok(key) = key else {
            return estimate(case).ok();
        };
        *self.0.entry(key).or_insert_with(|| estimate(case).ok())
    }
}

/// Estimates the memory of a case, bytes, from its model without the domain correction, which changes no sizes, and the analysis of the
/// equations.
fn estimate(case: &CaseFile) -> anyhow::Result<u64> {
    let mut plain = case.clone();
    plain.case.solver.threads = Some(1);
    let surface = &mut plain.case.correction.surface;
    *surface = surface.map(|it| match it.0 {
        Surface::Domain(_) => Word(Surface::None),
        _ => it,
    });
    let bytes = on_threads(plain.threads(), || equations(&plain))??;
    Ok(memory::run_bytes(bytes))
}

fn equations(case: &CaseFile) -> anyhow::Result<usize> {
    let quiet = Progress::new(ProgressMode::Quiet);
    let model = build_model(case, &mut Stages::default(), &quiet)?;
    let system = &model.system;
    Ok(match model.setup.analysis {
        Analysis::Modal(settings) => {
            let vibration = Vibration::new(&model)?;
            let analysis = ModalAnalysis::new(&vibration.problem(&model), settings)?;
            memory::equation_bytes(&**system, Some(analysis.stiffness()))
        }
        Analysis::Motion(_) => memory::equation_bytes(&**system, None),
        Analysis::Elastic { .. } | Analysis::Stepped(_) | Analysis::Event(_) => {
            let loading = Loading::new(&model)?;
            let problem = loading.problem(&model);
            let equilibrium = Equilibrium::new(&problem, ELASTIC_ENERGY_TOLERANCE)?;
            memory::equation_bytes(&**system, equilibrium.stiffness())
        }
    })
}

/// Whether the mesh of a case, if it has one, exists.
pub(super) fn has_mesh(case: &CaseFile) -> bool {
    let mesh = case.case.mesh.as_ref();
    mesh.is_none_or(|section| section.file.is_file())
}
