//! The measure of MPPD Tables 8 and 9.
//!
//! It is no scaling of the load: the sliding that a bond could bear at its own stretch is divided by the sliding that it has, and
//! that sliding is the angle atan(gamma) at the finite strains of s_0t = 0.1, while the limit stays as it is. The tables were
//! reproduced with exactly this reading (34 of 35 entries of Table 9 at s_0t = 0.100, 20 at 0.099): the dependence of
//! Table 9 on the path of loading comes from the angle alone. At first yield, which is what a model does, the error of frictional
//! sliding depends on the path strongly ([`Family::error`](super::Family::error)).

use super::PrincipalStretches;
use crate::element::BondDeformation;
use crate::failure::frictional::Friction;

/// The strain s_0t of the paper's tables; the measure depends on it.
pub const PAPER_STRAIN: f64 = 0.1;

/// What counts as no room for sliding, over the cohesion: at the apex of the criterion rounding leaves so much.
const NO_ROOM: f64 = 1e-12;

/// The error of one orientation (rad) for bonds at `directions` (rad) and strains on the theoretical locus:
///
/// e = min over the bonds of (a - s tan(beta))/atan|gamma| - 1,
///
/// with tan(beta) = 0 for sliding without friction. A bond without sliding decides only where it has no room for any, at the
/// apex, and e = 0 there.
pub fn error(
    directions: &[f64],
    friction: Friction,
    strains: PrincipalStretches,
    orientation: f64,
) -> f64 {
    let margin = |&direction: &f64| {
        let twice = 2.0 * (direction - orientation);
        let BondDeformation { stretch, shear, .. } = strains.along([twice.cos(), twice.sin()]);
        let room = friction.cohesion - stretch * friction.slope;
        if shear != 0.0 {
            room / shear.abs().atan()
        } else if room <= NO_ROOM * friction.cohesion {
            1.0
        } else {
            f64::INFINITY
        }
    };
    directions.iter().map(margin).fold(f64::INFINITY, f64::min) - 1.0
}
