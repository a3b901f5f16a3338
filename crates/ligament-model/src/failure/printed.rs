//! The criteria of MBB-PD as printed: a critical stretch of normal bonds and a critical angle of shear bonds (section 3.3, appendix C).
//!
//! | kind | critical stretch s_c of a point | critical angle of a bond | fracture energy |
//! |---|---|---|---|
//! | [`OPENING`] | eq. C.4 | s_c sin(theta) (C.3) | G_Ic |
//! | [`SLIDING`] | eq. C.7 | s_c (C.6) | G_IIc |
//! | [`MIXED`] | eqs 23, C.9 | s_c (+-1 +- sin(theta)) (24, C.10) | G_M (21) with the energies of both modes at the point (22) |
//!
//! Bonds along x fail by S_xx, bonds along y by S_yy, all others by their angle. For the angle C.10 refers to the differences of the ends
//! (A.5), whose shear strain is the third row of (A.6), S_xy + S_xx cot(theta) + S_yy tan(theta). The strain S_xy of the rectangle
//! (eq. 15) in its place is zero on the line of a crack that opens: no shear bond would ever break there.
//!
//! The printed sums are for a crack along x; bonds along x have the same s_c. A bond breaks by the smaller s_c of its ends.

use std::sync::Arc;

use super::basis::Basis;
use super::crack_at_points::{CrackAtPoints, Mode};
use super::criterion::Surroundings;
use super::kind::{FRACTURE_ENERGY, Kind, Limits, PerSpace};
use super::measure::Measure;
use super::mixed_mode;

/// Opening (mode I).
pub static OPENING: Kind = Kind {
    source: "MBB-PD eqs C.3, C.4",
    takes: &[FRACTURE_ENERGY],
    brittle_because: mixed_mode::MIXED_MODE.brittle_because,
    ..Kind::new(
        "printed-opening",
        "Critical stretch and angle of the bonds of `mbb-pd` in mode I as printed, from the fracture energy and the bonds left.",
        &[Measure::PrintedOpening],
        PerSpace::in_plane(|_, basis| Ok(limits(Mode::Opening, basis))),
    )
};

/// Sliding (mode II).
pub static SLIDING: Kind = Kind {
    source: "MBB-PD eqs C.6, C.7",
    takes: &[FRACTURE_ENERGY],
    brittle_because: mixed_mode::MIXED_MODE.brittle_because,
    ..Kind::new(
        "printed-sliding",
        "Critical stretch and angle of the bonds of `mbb-pd` in mode II as printed, from the fracture energy and the bonds left.",
        &[Measure::PrintedSliding],
        PerSpace::in_plane(|_, basis| Ok(limits(Mode::Sliding, basis))),
    )
};

/// Opening and sliding together.
pub static MIXED: Kind = Kind {
    source: "MBB-PD eqs 21 to 24, C.9, C.10",
    takes: &[FRACTURE_ENERGY],
    brittle_because: mixed_mode::MIXED_MODE.brittle_because,
    suits: mixed_mode::suits,
    ..Kind::new(
        "printed-mixed",
        "Critical stretch and angle of the bonds of `mbb-pd` in both modes as printed, from the fracture energies and the bonds left.",
        &[Measure::PrintedMixed],
        PerSpace::in_plane(|_, basis| Ok(limits(Mode::Mixed, basis))),
    )
};

/// Limits of the bonds of the body before it is loaded; the coefficient is the tangent of the angle of a bond to x, with its sign.
fn limits(mode: Mode, basis: &Basis<'_>) -> Vec<Limits> {
    let system = basis.system;
    let crack = CrackAtPoints::new(mode, basis);
    let unbreakable = basis.weakest(&vec![0.0; basis.materials.len()]);
    let whole = vec![true; system.bonds.len()];
    let tangent = |&[x, y]: &[f64; 2]| y / x;
    vec![Limits {
        limit: crack.limits(&unbreakable, &whole, &[]),
        coefficient: system.bonds.direction.iter().map(tangent).collect(),
        surroundings: Some(Arc::new(Surroundings::CrackAtPoints(crack))),
        is_brittle: false,
        name: None,
    }]
}
