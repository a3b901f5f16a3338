//! What failure criteria are warned of.

use ligament_model::ElementKind;
use ligament_model::failure::{Criteria, Measure};

use crate::setup::{Setup, Surface};

/// The criterion of shear between points without rotations, and the law, where the shear of a bond includes the rotation of the body.
pub(super) fn rotation_as_sliding(setup: &Setup) -> Option<[&'static str; 2]> {
    let law = &setup.law;
    if law.element() != ElementKind::Spring {
        return None;
    }
    // Bonds without a shear stiffness have no energy of shear.
    let counts = |it: &Measure| !(it.needs_shear_stiffness() && law.row.fixes_poisson);
    let sees_rotations = |it: &Measure| it.takes_sliding() && counts(it);
    let mut kinds = setup.criteria.iter().map(|it| it.kind);
    let kind = kinds.find(|it| it.measures.iter().any(sees_rotations));
    kind.map(|kind| [kind.word, law.name()])
}

/// The criterion of stress, where a uniform stress is no equilibrium.
pub(super) fn stress_without_patch(setup: &Setup) -> Option<&'static str> {
    let mut kinds = setup.criteria.iter().map(|it| it.kind);
    let kind = kinds.find(|it| it.measures.iter().any(|it| it.takes_stress()))?;
    let is_patch = matches!(setup.correction.surface, Surface::Patch(_));
    (!is_patch).then_some(kind.word)
}

/// Share of the bonds that break below the strength at which others begin to soften, and the smallest stress at which one does over the
/// strength; None where none does.
pub(super) fn below_strength(criteria: &Criteria) -> Option<[f64; 2]> {
    let shares = criteria.below_strength();
    let n_bonds = criteria.list.first()?.limit.len();
    let least = shares.iter().copied().reduce(f64::min)?;
    Some([shares.len() as f64 / n_bonds as f64, least])
}
