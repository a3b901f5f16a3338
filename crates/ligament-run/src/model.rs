//! The discrete model of a case, with the stages of its preparation timed and shown.

use std::sync::Arc;

pub use ligament::Model;
use ligament::run::{on_pool, on_threads};
use ligament::stage::{Finding, StageWatcher};
use ligament::warning::of_virial_stress;
use ligament_analysis::distributed_matrix::{MatrixCommunicator, SingleProcess};
use rayon::ThreadPoolBuildError;

use crate::memory;
use crate::processors::{free_threads, tasks_of_others};
use crate::progress::Progress;
use crate::run_time_estimate;
use crate::stages::Stages;
use crate::summary;

pub use crate::processes::loading;
use ligament_case::case::{CaseFile, StressField};

/// Watcher that times the stages of a case and shows their results.
struct Preparation<'a> {
    stages: &'a mut Stages,
    progress: &'a Progress,
}

impl StageWatcher for Preparation<'_> {
    fn begins(&mut self, _: &'static str) {
        self.stages.begin();
    }

    fn ends(&mut self, stage: &'static str) {
        self.stages.end(stage);
    }

    fn found(&mut self, finding: &Finding<'_>) {
        self.progress.stage(&match finding {
            Finding::Bonds {
                points,
                bonds,
                across_voids: 0,
            } => format!("{points} points, {bonds} bonds"),
            Finding::Bonds {
                points,
                bonds,
                across_voids,
            } => {
                format!(
                    "{points} points, {bonds} bonds, {across_voids} pairs across voids of the body"
                )
            }
            Finding::Correction(correction, report) => {
                summary::correction_line(correction, *report)
            }
        });
    }
}

/// Reads the body of a case and builds its model.
///
/// # Errors
///
/// If a file cannot be read, or the case contradicts its body.
pub fn build_model(
    case: &CaseFile,
    stages: &mut Stages,
    progress: &Progress,
) -> anyhow::Result<Model> {
    build_model_on(case, Arc::new(SingleProcess), stages, progress)
}

/// Reads the body of a case in the plane and builds its model.
///
/// # Errors
///
/// As for [`build_model`], and if the body is a solid.
pub fn build_model_in_plane(
    case: &CaseFile,
    stages: &mut Stages,
    progress: &Progress,
) -> anyhow::Result<Model> {
    case.require_plane()?;
    build_model(case, stages, progress)
}

/// Reads the body of a case and builds its model, divided between processes.
///
/// # Errors
///
/// As for [`build_model`].
pub fn build_model_on(
    case: &CaseFile,
    communicator: Arc<dyn MatrixCommunicator>,
    stages: &mut Stages,
    progress: &Progress,
) -> anyhow::Result<Model> {
    if let Some(lattice) = &case.case.lattice {
        memory::check_lattice_memory(case, lattice, communicator.size())?;
    }
    let mut preparation = Preparation { stages, progress };
    let tasks_before = tasks_of_others();
    let setup = case.setup_on_processes(communicator.clone(), &mut preparation)?;
    memory::check_model_memory(case, &setup)?;
    if let Some(words) =
        run_time_estimate::preparation_announcement(memory::estimated_bonds(&setup))
    {
        progress.stage(&words);
    }
    let tasks = tasks_before.min(tasks_of_others());
    let build = || on_free_processors(tasks, || Model::build(setup, &mut preparation));
    let model = on_pool(&*communicator, build)?;
    let mut model = model.map_err(|error| case.error_at_key(error))?;
    if case.case.output.stress.contains(&StressField::Virial) {
        let message = of_virial_stress(&model.body().origin());
        let news = message.filter(|it| !model.warnings.contains(it));
        model.warnings.extend(news);
    }
    Ok(model)
}

/// Runs successive short loops on as many threads as there are processors beside the tasks of other programs.
///
/// At the end of each loop all threads wait for the last one. A thread that shares its processor is suspended for longer than a loop, so
/// that several threads may take longer than one.
fn on_free_processors<T: Send>(
    tasks: usize,
    work: impl FnOnce() -> T + Send,
) -> Result<T, ThreadPoolBuildError> {
    let threads = rayon::current_num_threads();
    let free = free_threads(tasks, threads);
    on_threads((free < threads).then_some(free), work)
}
