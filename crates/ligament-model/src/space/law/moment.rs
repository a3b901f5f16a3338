//! Moments of families whose bonds count by a factor alpha of their length.
//!
//! The constants of the laws come from M = 4 pi integral_0^H alpha l^3 dl, which is pi H^4 for alpha = 1: k_n = 6 E/((1 - 2 nu) M) and the
//! constant k_t = 6 E (1 - 4 nu)/((1 + nu)(1 - 2 nu) M) are right for any alpha.

use crate::law::BondStiffness;

/// Intervals of Simpson's rule; its error is of the fourth order of their width.
const INTERVALS: u32 = 2000;

/// M/(pi H^4) = 4 integral_0^1 alpha(x) x^3 dx of a factor alpha of x = l/H.
pub fn relative_moment(alpha: impl Fn(f64) -> f64) -> f64 {
    let width = 1.0 / f64::from(INTERVALS);
    let at = |place: f64| 4.0 * alpha(place) * place.powi(3);
    let of_interval = |number: u32| {
        let start = f64::from(number) * width;
        at(start) + 4.0 * at(start + 0.5 * width) + at(start + width)
    };
    (0..INTERVALS).map(of_interval).sum::<f64>() * width / 6.0
}

/// The densities of a law for families with a relative moment: all of them over it.
///
/// That is right for constant shear stiffnesses; a shear stiffness 12 d/l^2 would have another moment, of alpha l.
pub fn over_moment(mut stiffness: BondStiffness, relative_moment: f64) -> BondStiffness {
    for densities in [
        &mut stiffness.axial,
        &mut stiffness.shear,
        &mut stiffness.rotational,
    ] {
        densities.iter_mut().for_each(|it| *it /= relative_moment);
    }
    stiffness
}
