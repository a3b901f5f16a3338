//! `summary.json` of a modal analysis, and the table that a user sees at its end.

use std::io::{self, Write};

use ligament_analysis::modal::{ModalOutcome, Mode, Rotations};
use ligament_analysis::solver::SolverChoice;
use ligament_output::quantity::{four_digits, quantity};
use serde::Serialize;

use crate::provenance::Provenance;
use crate::stages::Stage;
use crate::summary::{ModelSummary, SolverSummary, StabilitySummary, heading};
use ligament::Model;
use ligament_case::case::CaseFile;

/// All numbers of a modal analysis.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ModalSummary {
    /// The model.
    #[serde(flatten)]
    pub model: ModelSummary,
    /// Mass of the body, kg.
    pub mass: f64,
    /// Centre of the mass, m.
    pub centre_of_mass: Vec<f64>,
    /// Mass that can move along the axes, kg, and inertia about the centre, kg m^2; of a solid about each axis through it.
    pub moving: Vec<f64>,
    /// What becomes of the rotations of the points: `inertia` or `massless`.
    pub rotations: &'static str,
    /// Rigid motions that supports and connectivity leave.
    pub rigid_motions: usize,
    /// Whether a count of the eigenvalues confirmed that no mode below the highest is missing.
    pub complete: Option<bool>,
    /// The modes, lowest first.
    pub modes: Vec<ModeSummary>,
    /// Share of the modes together in the mass that can move along the axes, and in its inertia.
    pub effective_shares: Vec<f64>,
    /// Negative eigenvalues of the stiffness, and how many its rotations explain, where Poisson's ratio is large.
    pub stability: Option<StabilitySummary>,
    /// The solver and its work.
    pub solver: SolverSummary,
    /// What the results came from.
    pub provenance: Provenance,
    /// Wall time and peak memory of the stages.
    pub stages: Vec<Stage>,
    /// What the user should know.
    pub warnings: Vec<String>,
}

/// A mode in numbers.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ModeSummary {
    /// Number, from 1.
    pub mode: usize,
    /// `rigid` or `elastic`.
    pub kind: &'static str,
    /// Frequency, Hz.
    pub frequency: f64,
    /// Largest |K phi - omega^2 M phi| over the forces that meet at a point.
    pub residual: f64,
    /// Shares of its effective masses along the axes and of its inertia in what can move.
    pub effective_shares: Vec<f64>,
}

impl ModalSummary {
    /// Collects the numbers.
    pub fn new(
        case: &CaseFile,
        model: &Model,
        outcome: &ModalOutcome,
        provenance: Provenance,
        stages: &[Stage],
    ) -> Self {
        let moving = &outcome.moving;
        let summary = |(index, mode): (usize, &Mode)| ModeSummary {
            mode: index + 1,
            kind: mode.kind.name(),
            frequency: mode.frequency(),
            residual: mode.residual,
            effective_shares: moving.shares(&mode.participation),
        };
        let modes: Vec<ModeSummary> = outcome.modes.iter().enumerate().map(summary).collect();
        let mut warnings: Vec<String> = model.warnings.iter().map(ToString::to_string).collect();
        warnings.extend(outcome.notices.iter().map(ToString::to_string));
        Self {
            model: ModelSummary::new(case, model),
            mass: moving.total,
            centre_of_mass: moving.centre.clone(),
            moving: moving.free.clone(),
            rotations: match outcome.rotations {
                Rotations::Inertia => "inertia",
                Rotations::Massless => "massless",
            },
            rigid_motions: outcome.rigid_motions,
            complete: outcome.complete,
            effective_shares: (0..moving.free.len())
                .map(|k| modes.iter().map(|mode| mode.effective_shares[k]).sum())
                .collect(),
            modes,
            stability: outcome.stability.map(StabilitySummary::from),
            solver: SolverSummary::new(&outcome.costs, &SolverChoice::Direct(outcome.solver)),
            provenance,
            stages: stages.to_vec(),
            warnings,
        }
    }

    /// The lines that a user sees at the end of a run.
    pub fn write(&self, out: &mut dyn Write) -> io::Result<()> {
        let ModelSummary {
            title,
            formulation,
            points,
            bonds,
            ..
        } = &self.model;
        writeln!(out, "{}", heading(title))?;
        writeln!(out, "  {formulation}")?;
        writeln!(
            out,
            "  points {points}, bonds {bonds}, mass {}, rotations: {}",
            quantity(self.mass, "kg"),
            self.rotations
        )?;
        let of_inertia = match self.moving.len() {
            3 => "x, y, inertia",
            _ => "x, y, z, inertias",
        };
        writeln!(
            out,
            "  mode  kind     frequency, Hz   effective mass {of_inertia}, %   residual"
        )?;
        for mode in &self.modes {
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
            percentages(&self.effective_shares)
        )?;
        if self.complete == Some(true) {
            writeln!(
                out,
                "  counted            no mode below the highest is missing"
            )?;
        }
        for warning in &self.warnings {
            writeln!(out, "  warning: {warning}")?;
        }
        Ok(())
    }
}

/// Shares as percentages in columns.
fn percentages(shares: &[f64]) -> String {
    let widths = match shares.len() {
        3 => [12, 7, 11].as_slice(),
        _ => &[8; 6],
    };
    let columns = shares.iter().zip(widths);
    let columns = columns.map(|(share, width)| format!("{:>width$.3}", 100.0 * share));
    columns.collect::<Vec<_>>().join(" ")
}
