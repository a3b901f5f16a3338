//! Summary of a motion in time, and its lines in the report for the user.

use std::io::{self, Write};

use ligament::setup::Analysis;
use ligament_analysis::driver::Outcome;
use ligament_analysis::solver::SolverChoice;
use ligament_output::quantity::quantity;
use ligament_output::summary::{EnergiesSummary, MotionSummary};

use super::solver::limited_by;

/// Summary of the motion of an analysis; none for an analysis in statics.
pub(super) fn motion_summary(analysis: &Analysis, outcome: &Outcome) -> Option<MotionSummary> {
    let Analysis::Motion(settings) = analysis else {
        return None;
    };
    let last = outcome.at_rest().next_back()?;
    let motion = last.motion?;
    let (time, time_steps) = (last.load_factor, motion.time_steps);
    let explicit = match &outcome.solver {
        SolverChoice::Explicit(it) => Some(it),
        SolverChoice::Direct(_) | SolverChoice::Iterative(_) | SolverChoice::Distributed(_) => None,
    };
    Some(MotionSummary {
        duration: settings.duration,
        time,
        time_steps,
        time_step: explicit.map_or_else(|| time / time_steps.max(1) as f64, |it| it.step),
        critical_step: explicit.map(|it| it.critical.step),
        limited_by: explicit.map(|it| limited_by(&it.critical).into()),
        energies: EnergiesSummary {
            external_work: last.external_work,
            initial_energy: motion.initial_energy,
            kinetic_energy: motion.kinetic_energy,
            stored_energy: last.stored_energy,
            released_energy: last.released_energy,
            damping_energy: motion.damping_energy,
            contact_energy: motion.contact_energy,
            friction_energy: motion.friction_energy,
        },
    })
}

/// Writes the lines about time steps and energies.
pub(super) fn write_motion(motion: &MotionSummary, out: &mut dyn Write) -> io::Result<()> {
    let [time, step] = [motion.time, motion.time_step].map(|it| quantity(it, "s"));
    let steps = motion.time_steps;
    writeln!(
        out,
        "  motion             {time} in {steps} time steps of {step}"
    )?;
    if let (Some(critical), Some(by)) = (motion.critical_step, &motion.limited_by) {
        let critical = quantity(critical, "s");
        writeln!(out, "  critical step      {critical}, limited by {by}")?;
    }
    let energies = motion.energies.named().into_iter();
    let energies = energies.filter(|it| it.1 != 0.0);
    let energies: Vec<String> = energies
        .map(|(name, energy)| format!("{name} {}", quantity(energy, "J")))
        .collect();
    if energies.is_empty() {
        return Ok(());
    }
    writeln!(out, "  energies           {}", energies.join(", "))
}
