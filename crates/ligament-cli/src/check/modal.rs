//! What `ligament check` tells of a modal case.

use std::io::Write;

use ligament_analysis::modal::{ModalAnalysis, Rotations};

use super::{Extent, equations, write_group, write_model};
use ligament_case::case::{self, CaseFile, Modal};
use ligament_case::model::Model;
use ligament_case::resolve::{self, Vibration};
use ligament_case::stages::Stages;

/// Checks supports, masses and equations.
pub(super) fn check(
    case: &CaseFile,
    modal: &Modal,
    extent: Extent,
    model: &Model,
    stages: &mut Stages,
    out: &mut dyn Write,
) -> anyhow::Result<()> {
    let vibration = Vibration::of(case, &*model.body, &model.system.cloud)?;
    let problem = vibration.problem(&model.system);
    let analysis = match extent {
        Extent::Model => None,
        Extent::Matrix => Some(stages.time("analysis", || {
            ModalAnalysis::new(&problem, resolve::modal(modal))
        })?),
    };
    write_model(out, case, model)?;
    writeln!(out, "supports")?;
    for group in &vibration.supports.groups {
        write_group(out, &*model.body, &group.name, &group.points)?;
    }
    if vibration.supports.groups.is_empty() {
        writeln!(out, "  none: the body is free")?;
    }
    writeln!(out, "modes")?;
    writeln!(out, "  wanted                {}", modal.modes)?;
    if let Some(analysis) = &analysis {
        let why = match modal.rotations {
            case::Rotations::Inertia | case::Rotations::Massless => "as the case says",
            case::Rotations::Auto if analysis.rotations() == Rotations::Massless => {
                "because bonds have a negative shear stiffness"
            }
            case::Rotations::Auto => "because no bond has a negative shear stiffness",
        };
        let what = match analysis.rotations() {
            Rotations::Inertia => "with inertia",
            Rotations::Massless => "without inertia",
        };
        writeln!(out, "  rotations             {what}, {why}")?;
        equations::write(out, case, model, analysis.stiffness())?;
    }
    Ok(())
}
