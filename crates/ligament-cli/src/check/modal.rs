//! Report of `ligament check` on a modal case.

use ligament::Vibration;
use ligament_analysis::modal::{ModalAnalysis, ModalSettings, Rotations};

use super::body::write_group;
use super::report::CheckExtent;
use super::report::Report;
use super::{equations, model};
use ligament_case::case::CaseFile;
use ligament_run::model::Model;
use ligament_run::stages::Stages;

/// Checks supports, masses and equations.
pub(super) fn check(
    case: &CaseFile,
    settings: ModalSettings,
    extent: CheckExtent,
    model: &Model,
    stages: &mut Stages,
    report: &mut Report<'_>,
) -> anyhow::Result<()> {
    let vibration = Vibration::new(model);
    let vibration = vibration.map_err(|error| case.error_at_key(error))?;
    let problem = vibration.problem(model);
    let analysis = match extent {
        CheckExtent::Model => None,
        CheckExtent::Matrix | CheckExtent::PatchTest => {
            Some(stages.time("analysis", || ModalAnalysis::new(&problem, settings))?)
        }
    };
    model::write(report, case, model)?;
    report.head("supports");
    for group in &vibration.supports.groups {
        write_group(report, model.body(), &group.name, &group.points)?;
    }
    if vibration.supports.groups.is_empty() {
        report.words("none: the body is free")?;
    }
    report.head("modes");
    report.entry("wanted", settings.modes)?;
    if let Some(analysis) = &analysis {
        let why = match settings.rotations {
            Some(_) => "set in the case",
            None if analysis.rotations() == Rotations::Massless => {
                "because bonds have a negative shear stiffness"
            }
            None => "because no bond has a negative shear stiffness",
        };
        let what = match analysis.rotations() {
            Rotations::Inertia => "with inertia",
            Rotations::Massless => "without inertia",
        };
        report.detail("rotations", format!("{what}, {why}"))?;
        let stiffness = analysis.stiffness();
        equations::write_with_matrix(report, case, model, stiffness)?;
    }
    Ok(())
}
