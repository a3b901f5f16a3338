//! Warnings about failure criteria.

use ligament_model::ElementKind;
use ligament_model::failure::{Criteria, Measure};

use super::Warning;
use crate::setup::{Setup, Surface};

/// Warning about criteria of shear between points without rotations, where the shear of a bond includes the rotation of the body.
pub(super) fn rotation_as_sliding(setup: &Setup) -> Option<Warning> {
    let law = &setup.law;
    if law.element() != ElementKind::Spring {
        return None;
    }
    // Bonds without a shear stiffness have no energy of shear.
    let counts = |it: &Measure| !(it.needs_shear_stiffness() && law.row.fixes_poisson);
    let sees_rotations = |it: &Measure| it.takes_sliding() && counts(it);
    let mut kinds = setup.criteria.iter().map(|it| it.kind);
    let kind = kinds.find(|it| it.measures.iter().any(sees_rotations));
    kind.map(|kind| Warning::RotationAsSliding {
        criterion: kind.word,
        law: law.name(),
    })
}

/// Warning about criteria of stress where a uniform stress is no equilibrium.
pub(super) fn stress_without_patch(setup: &Setup) -> Option<Warning> {
    let mut kinds = setup.criteria.iter().map(|it| it.kind);
    let kind = kinds.find(|it| it.measures.iter().any(|it| it.takes_stress()))?;
    let is_patch = matches!(setup.correction.surface, Surface::Patch(_));
    (!is_patch).then_some(Warning::StressWithoutPatch {
        criterion: kind.word,
    })
}

/// Warning about bonds that break below the strength at which others begin to soften.
pub(crate) fn of_criteria(criteria: &Criteria) -> Option<Warning> {
    let shares = criteria.below_strength();
    let n_bonds = criteria.list.first()?.limit.len();
    let least = shares.iter().copied().reduce(f64::min)?;
    let share = shares.len() as f64 / n_bonds as f64;
    Some(Warning::BelowStrength { share, least })
}
