//! Messages about failure criteria.

use ligament_analysis::Message;
use ligament_model::ElementKind;
use ligament_model::failure::{Choice, Criteria, Kind, Measure, Property, strength};

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

/// Horizon factor up to which families have few bonds under a criterion of stress.
const FEW_BONDS: f64 = 2.0;

/// Message about a criterion that compares a stress or a strain with a strength, at a horizon factor at which a family has few bonds.
pub fn few_bonds<'a>(
    criteria: impl IntoIterator<Item = &'a Choice>,
    factor: f64,
) -> Option<Message> {
    let mut kinds = criteria.into_iter().map(|it| it.kind);
    let kind = kinds.find(is_by_stress).filter(|_| factor <= FEW_BONDS)?;
    let factor = (1e3 * factor).round() / 1e3;
    let text = format!(
        "criterion \"{}\" with a horizon of {factor} times the distance of points: the family of a point has so few bonds that single ones fail \
         early, and the strength depends on the mesh (`bond-rankine` on six meshes of the Brazilian disk: first breakage at .15 to 1.11 of the \
         exact load, peak at .90 to 1.10; with 3, 1.01 to 1.02 and 1.00 to 1.01)",
        kind.word
    );
    let advice = "model.horizon_factor = 3 is usual";
    Some(Message::new("few-bonds", text).with_advice(advice))
}

/// Whether limits of a kind are those of a strength of the material. Those of `strength` grow with the factor and are calibrated for each.
fn is_by_stress(kind: &Kind) -> bool {
    let of_strength = |it: &Property| it.key.ends_with("_strength");
    kind.word != strength::STRENGTH.word && kind.takes.iter().any(of_strength)
}
