//! Largest stretch of the outermost fibre of a bond (MPPD eq. 28, OMPPD eq. 13).
//!
//! The papers print s = (u_n^B - u_n^A + kappa theta_rel)/l, where kappa "regulates how much bending is considered in the bond stretch
//! measure", and set kappa to zero. Bending as it is printed has a sign that depends on which end comes first, and on the side from
//! which the plane is seen, so that it can be no part of an energy. It is what its sources take it for, a measure of failure: a section
//! that bends by theta_rel over the length l stretches a fibre at the distance kappa from its axis by kappa theta_rel/l more on one
//! side, and by as much less on the other.
//!
//! In space theta_rel is a vector, across the axis of the bond where it bends and along the axis where it is twisted. A bond has one
//! stiffness against both and no section of its own, so that the measure takes the length of the whole vector: the rotation by which
//! pure bending would store the same energy. Where nothing twists the bond that is the stretch of the fibre; a bond that is twisted
//! as well comes to its limit earlier than its fibre does.

use super::basis::Basis;
use super::kind::{Choice, Kind, Limits, PerSpace, TENSILE_STRENGTH};
use super::measure::Measure;
use super::stretch;
use super::unfit::{NoLimit, Unfit};

/// Stretch of the outermost fibre, from the tensile strength.
pub static FIBRE: Kind = Kind {
    source: "MPPD eq. 28; OMPPD eq. 13",
    takes: &[TENSILE_STRENGTH],
    keys: &["limit", "fibre_distance"],
    check,
    ..Kind::new(
        "fibre",
        "Stretch of the outermost fibre of a bond that bends, from the `tensile_strength` or a `limit`; with a `fibre_distance`.",
        &[Measure::Fibre],
        PerSpace::new(limits, limits),
    )
};

fn check(choice: &Choice) -> Result<(), Unfit> {
    match choice.fibre_distance {
        None => Err(Unfit::Missing {
            field: "fibre_distance",
            reason: "(in m) by the criterion \"fibre\": it is how far the outermost fibre lies from the axis of the bond"
                .into(),
        }),
        Some(found) if !(found >= 0.0 && found.is_finite()) => Err(Unfit::OutOfRange {
            field: "fibre_distance",
            expected: "at least 0".to_owned(),
            found,
        }),
        Some(_) => Ok(()),
    }
}

/// Limits of [`stretch::TENSION`], with the coefficient kappa/l.
fn limits<const D: usize>(choice: &Choice, basis: &Basis<'_, D>) -> Result<Vec<Limits>, NoLimit> {
    let limit = stretch::limits_from_strength(choice, basis, stretch::limit);
    let distance = choice.fibre_distance.unwrap_or_default();
    let lengths = basis.system.bonds.length.iter();
    let coefficient = lengths.map(|length| distance / length).collect();
    Ok(vec![Limits::new(limit, coefficient)])
}
