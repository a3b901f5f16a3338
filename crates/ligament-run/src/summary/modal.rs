//! `summary.json` of a modal analysis, and the table for the user at its end.

use std::io::{self, Write};

use ligament_analysis::modal::{ModalOutcome, Mode};
use ligament_analysis::solver::SolverChoice;
use ligament_output::quantity::{four_digits, quantity};
use ligament_output::summary::{
    ModalSummary, ModeSummary, ModelSummary, Provenance, StabilitySummary, Stage,
};

use crate::messages::merged_messages;

use super::model::{PointStatistics, heading, model_summary};
use super::solver::solver_summary;
use crate::stability;
use ligament::Model;
use ligament_case::case::{CaseFile, word_of};

/// Summary of an analysis of natural modes.
pub fn modal_summary(
    case: &CaseFile,
    model: &Model,
    outcome: &ModalOutcome,
    provenance: Provenance,
    stages: &[Stage],
) -> ModalSummary {
    let moving = &outcome.moving;
    let is_unstable = outcome.stability.is_some_and(|it| it.is_unstable());
    let summary = |(index, mode): (usize, &Mode)| ModeSummary {
        mode: index + 1,
        kind: mode.kind.name().into(),
        frequency: mode.frequency(),
        residual: mode.residual,
        effective_shares: moving.shares(&mode.participation),
    };
    let modes: Vec<ModeSummary> = outcome.modes.iter().enumerate().map(summary).collect();
    let warnings = merged_messages(model.warnings.iter().chain(&outcome.messages).cloned());
    ModalSummary {
        model: model_summary(case, model, PointStatistics::new(model)),
        mass: moving.total,
        centre_of_mass: moving.centre.clone(),
        moving: moving.free.clone(),
        rotations: word_of(&outcome.rotations).into(),
        rigid_motions: outcome.rigid_motions,
        complete: outcome.complete,
        effective_shares: (0..moving.free.len())
            .map(|k| modes.iter().map(|mode| mode.effective_shares[k]).sum())
            .collect(),
        modes,
        unstable: is_unstable && !model.setup.solver.allows_unstable,
        stability: outcome.stability.map(StabilitySummary::from),
        solver: solver_summary(&outcome.costs, &SolverChoice::Direct(outcome.solver)),
        provenance: Some(provenance),
        stages: stages.to_vec(),
        warnings,
    }
}
/// Writes the report of an analysis of natural modes for the user.
pub fn write_modal(summary: &ModalSummary, out: &mut dyn Write) -> io::Result<()> {
    let ModelSummary {
        title,
        analysis,
        formulation,
        points,
        bonds,
        ..
    } = &summary.model;
    writeln!(out, "{}", heading(title))?;
    writeln!(out, "{analysis}")?;
    writeln!(out, "  {formulation}")?;
    writeln!(
        out,
        "  points {points}, bonds {bonds}, mass {}, rotations: {}",
        quantity(summary.mass, "kg"),
        summary.rotations
    )?;
    let of_inertia = match summary.moving.len() {
        3 => "x, y, inertia",
        _ => "x, y, z, inertias",
    };
    writeln!(
        out,
        "  mode  kind     frequency, Hz   effective mass {of_inertia}, %   residual"
    )?;
    for mode in &summary.modes {
        writeln!(
            out,
            "  {:>4}  {:<8} {:>13}   {}     {:>6.1e}",
            mode.mode,
            mode.kind,
            four_digits(mode.frequency),
            percentages(&mode.effective_shares),
            mode.residual
        )?;
    }
    writeln!(
        out,
        "  together                        {}",
        percentages(&summary.effective_shares)
    )?;
    if summary.complete == Some(true) {
        writeln!(
            out,
            "  counted            no mode below the highest is missing"
        )?;
    }
    if summary.unstable {
        let remedy = stability::remedy(None);
        writeln!(out, "  NOT TO BE TRUSTED  the model is unstable; {remedy}")?;
    }
    for warning in &summary.warnings {
        writeln!(out, "  warning: {warning}")?;
    }
    Ok(())
}

/// Shares as text, in columns of percentages.
fn percentages(shares: &[f64]) -> String {
    let widths = match shares.len() {
        3 => [12, 7, 11].as_slice(),
        _ => &[8; 6],
    };
    let columns = shares.iter().zip(widths);
    let columns = columns.map(|(share, width)| format!("{:>width$.3}", 100.0 * share));
    columns.collect::<Vec<_>>().join(" ")
}
