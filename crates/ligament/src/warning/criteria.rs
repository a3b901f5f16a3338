//! Messages about failure criteria.

use ligament_analysis::Message;
use ligament_model::ElementKind;
use ligament_model::failure::{Criteria, Measure};

use crate::setup::{Setup, Surface};

/// Message about a criterion of shear between points without rotations, where the shear of a bond includes the rotation of the body.
pub(super) fn rotation_as_sliding(setup: &Setup) -> Option<Message> {
    let law = &setup.law;
    if law.element() != ElementKind::Spring {
        return None;
    }
    // Bonds without a shear stiffness have no energy of shear.
    let counts = |it: &Measure| !(it.needs_shear_stiffness() && law.row.fixes_poisson);
    let sees_rotations = |it: &Measure| it.takes_sliding() && counts(it);
    let mut kinds = setup.criteria.iter().map(|it| it.kind);
    let kind = kinds.find(|it| it.measures.iter().any(sees_rotations));
    kind.map(|kind| {
        let text = format!(
            "criterion \"{}\": under law = \"{}\" points have no rotations, so a rotation of the body counts as sliding of the bonds",
            kind.word,
            law.name()
        );
        let advice = "take \"mppd\", which separates the two";
        Message::new("rotation-as-sliding", text).with_advice(advice)
    })
}

/// Message about a criterion of stress, where a uniform stress is no equilibrium.
pub(super) fn stress_without_patch(setup: &Setup) -> Option<Message> {
    let mut kinds = setup.criteria.iter().map(|it| it.kind);
    let kind = kinds.find(|it| it.measures.iter().any(|it| it.takes_stress()))?;
    let is_patch = matches!(setup.correction.surface, Surface::Patch(_));
    (!is_patch).then(|| {
        let text = format!(
            "criterion \"{}\": without correction.surface = \"patch\" the bonds are not in equilibrium under a uniform stress, and the first one \
             fails at about half of the strength",
            kind.word
        );
        Message::new("stress-without-patch", text)
    })
}

/// Share of the bonds that break below the strength at which others begin to soften, and the smallest stress at which one does over the
/// strength; None where none does.
pub(super) fn below_strength(criteria: &Criteria) -> Option<[f64; 2]> {
    let shares = criteria.below_strength();
    let n_bonds = criteria.list.first()?.limit.len();
    let least = shares.iter().copied().reduce(f64::min)?;
    Some([shares.len() as f64 / n_bonds as f64, least])
}
