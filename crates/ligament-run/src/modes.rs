//! A modal analysis, from the model to modes on disk.

use ligament::Vibration;
use ligament_analysis::modal::{ModalAnalysis, ModalSettings};
use ligament_output::folder::ResultFolder;
use ligament_output::results::write_modes;
use ligament_output::summary::{self, ModalSummary, Provenance};

use crate::destination::make_results;
use crate::memory;
use crate::stages::Stages;
use crate::summary::modal_summary;
use ligament::Model;
use ligament_case::case::CaseFile;

/// Finds the modes of a model and writes them into a new folder; `inputs` are the case, and whether the folder gets copies of its files.
pub(crate) fn find_modes(
    inputs: (&CaseFile, bool),
    settings: ModalSettings,
    (model, provenance): (&Model, Provenance),
    create: impl FnOnce() -> Result<ResultFolder, ligament_output::Error>,
    mut stages: Stages,
) -> anyhow::Result<ModalSummary> {
    let case = inputs.0;
    let vibration = Vibration::new(model);
    let vibration = vibration.map_err(|error| case.located(error))?;
    let problem = vibration.problem(model);
    let analysis = stages.time("analysis", || ModalAnalysis::new(&problem, settings))?;
    memory::foresee(case, &*model.system, Some(analysis.stiffness()))?;

    let outcome = stages.time("modes", || analysis.find())?;

    // Nothing is written or replaced before the modes are found.
    make_results(inputs, create, |folder, case| {
        stages.time("output", || {
            let grid = model.body().grid();
            write_modes(folder, &grid, &*model.system, &model.fixed, &outcome)
        })?;
        let summary = modal_summary(case, model, &outcome, provenance, stages.done());
        summary::write(folder, &summary)?;
        Ok((summary, true))
    })
}
