//! Names of results that a summary can have, to refuse a wrong name before the first run.

use std::collections::BTreeMap;

use ligament_output::summary::{
    BondEvent, CertificateSummary, CorrectionSummary, IterationSummary, ModalSummary, ModeSummary,
    ModelSummary, MotionSummary, OverlapSummary, PathPoint, ScatterSummary, SolverSummary, Spread,
    StabilitySummary, Summary, UnitsSummary,
};
use serde::Serialize;

use crate::quantities::{Quantities, QuantityError};

/// Result whose parts are names of groups.
const BY_GROUP: &str = "reactions_at_peak.";

/// Refuses the name of a result that no run of this kind has as a number.
pub(super) fn check(name: &str, is_modal: bool) -> Result<(), QuantityError> {
    if name.starts_with(BY_GROUP) && !is_modal {
        return Ok(());
    }
    let complete = match is_modal {
        true => quantities(&complete_modal_summary()),
        false => quantities(&complete_summary()),
    };
    // Lists of the sample have one entry.
    let is_index = |part: &str| part.bytes().all(|it| it.is_ascii_digit());
    let parts: Vec<&str> = name.split('.').collect();
    let parts = parts
        .into_iter()
        .map(|it| if is_index(it) { "0" } else { it });
    let sample = parts.collect::<Vec<_>>().join(".");
    complete.number(&sample).map(drop)
}

fn quantities(summary: &impl Serialize) -> Quantities {
    let value = serde_json::to_value(summary).unwrap_or_default();
    Quantities::of_summary(&value)
}

/// A summary with every result. It names all fields, so that the compiler finds one that is missing.
fn complete_summary() -> Summary {
    let point = PathPoint {
        displacement: 0.0,
        reaction: 0.0,
        load_factor: 0.0,
    };
    let bond = BondEvent {
        ends: [0; 2],
        place: vec![0.0],
        step: 0,
        load_factor: 0.0,
        displacement: 0.0,
        reaction: 0.0,
        criterion: String::new(),
        tagged: "",
    };
    Summary {
        model: complete_model(),
        temperature_change: Some(Spread::default()),
        units: UnitsSummary::default(),
        elastic_stiffness: Some(0.0),
        first_break: Some(point),
        first_softened_bond: Some(bond.clone()),
        first_broken_bond: Some(bond),
        peak: Some(point),
        reactions_at_peak: BTreeMap::new(),
        first_peak: Some(point),
        broken_bonds: 0,
        softened_bonds: Some(0),
        steps: 0,
        exact_path: false,
        motion: Some(MotionSummary {
            critical_step: Some(0.0),
            limited_by: Some("".into()),
            ..MotionSummary::default()
        }),
        termination: "".into(),
        termination_message: String::new(),
        without_equilibrium: false,
        last_state_not_at_rest: false,
        energy_balance_error: 0.0,
        certificate: Some(CertificateSummary {
            crack_area: Some(0.0),
            dissipated_per_area: Some(0.0),
            fracture_energy: Some(0.0),
            largest_residual: Some(0.0),
            ..CertificateSummary::default()
        }),
        overlap: Some(OverlapSummary {
            depth: 0.0,
            step: 0,
            between: [String::new(), String::new()],
        }),
        stability: Some(stability()),
        solver: complete_solver(),
        provenance: None,
        stages: Vec::new(),
        warnings: Vec::new(),
    }
}

fn complete_modal_summary() -> ModalSummary {
    let mode = ModeSummary {
        mode: 0,
        kind: "".into(),
        frequency: 0.0,
        residual: 0.0,
        effective_shares: vec![0.0],
    };
    ModalSummary {
        model: complete_model(),
        mass: 0.0,
        centre_of_mass: vec![0.0],
        moving: vec![0.0],
        rotations: "".into(),
        rigid_motions: 0,
        complete: None,
        modes: vec![mode],
        effective_shares: vec![0.0],
        unstable: false,
        stability: Some(stability()),
        solver: complete_solver(),
        provenance: None,
        stages: Vec::new(),
        warnings: Vec::new(),
    }
}

fn complete_model() -> ModelSummary {
    let correction = CorrectionSummary {
        alpha: "".into(),
        surface: "".into(),
        sweeps: Some(0),
        converged: None,
        last_change: Some(0.0),
        factor_min: 0.0,
        factor_max: 0.0,
        largest_residual: Some(0.0),
        newton_steps: Some(0),
        left: Some(0.0),
        energy_ratios: vec![Spread::default()],
    };
    ModelSummary {
        correction,
        scatter: Some(ScatterSummary {
            of: "".into(),
            seed: 0,
            factor: Spread::default(),
            deviation: 0.0,
            beside: Vec::new(),
        }),
        ..ModelSummary::default()
    }
}

fn complete_solver() -> SolverSummary {
    SolverSummary {
        iteration: Some(IterationSummary {
            tolerance: 0.0,
            aggregate: Some(0),
            iterations: 0,
        }),
        ranks: Some(0),
        ..SolverSummary::default()
    }
}

fn stability() -> StabilitySummary {
    StabilitySummary {
        negative: 0,
        expected: 0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_known_before_the_first_run() {
        for name in [
            "first_peak.reaction",
            "first_break.load_factor",
            "first_broken_bond.place.1",
            "elastic_stiffness",
            "softened_bonds",
            "correction.energy_ratios.2.mean",
            "seconds",
            "reactions_at_peak.top.force_x",
        ] {
            assert!(check(name, false).is_ok(), "{name}");
        }
        assert!(check("modes.3.frequency", true).is_ok());
    }

    #[test]
    fn wrong_names_are_refused_with_the_nearest() {
        let error = |name, is_modal| check(name, is_modal).unwrap_err().to_string();
        assert!(error("peak.force", false).contains("no result `peak.force`"));
        assert!(error("first_pek.reaction", false).contains("`first_peak.reaction`"));
        assert!(error("title", false).contains("no number"));
        assert!(error("first_peak.reaction", true).contains("no result"));
        assert!(error("modes.0.frequncy", true).contains("`modes.0.frequency`"));
    }
}
