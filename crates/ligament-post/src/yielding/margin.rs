//! Error measure of MPPD Tables 8 and 9.
//!
//! The measure does not scale the load: the sliding limit of a bond at its own stretch is divided by its sliding, and that sliding is the
//! angle atan(gamma) at the finite strains of s_0t = 0.1, while the limit is unchanged. The tables were reproduced with exactly this measure
//! (34 of 35 entries of Table 9 at s_0t = 0.100, 20 at 0.099): the dependence of Table 9 on the path of loading comes from the angle alone.
//! At first yield, as in a model, the error of frictional sliding depends strongly on the path ([`Family::error`](super::Family::error)).

use ligament_model::failure::frictional::Friction;

use super::{PrincipalStretches, WorstOrientation, printed_orientations};

/// Strain s_0t of the paper's tables, on which the measure depends.
pub const PAPER_STRAIN: f64 = 0.1;

/// Sliding limit over the cohesion that counts as zero: the rounding at the apex of the criterion.
const NO_ROOM: f64 = 1e-12;

/// The worst of the printed orientations for a friction law and strains on its theoretical locus, both in units of s_0t.
pub fn worst(
    directions: &[f64],
    friction: Friction,
    strains: PrincipalStretches,
) -> WorstOrientation {
    let friction = Friction {
        cohesion: PAPER_STRAIN * friction.cohesion,
        ..friction
    };
    let strains = strains.scaled(PAPER_STRAIN);
    let none = WorstOrientation {
        orientation: 0.0,
        error: f64::NEG_INFINITY,
    };
    printed_orientations().fold(none, |worst, orientation| {
        let error = error(directions, friction, strains, orientation);
        if error > worst.error {
            WorstOrientation { orientation, error }
        } else {
            worst
        }
    })
}

/// The error of one orientation (rad) for bonds at `directions` (rad) and strains on the theoretical locus:
///
/// e = min over the bonds of (a - s tan(beta))/atan|gamma| - 1,
///
/// with tan(beta) = 0 for sliding without friction. A bond without sliding is decisive only where its limit is zero, at the apex, and e = 0
/// there.
pub fn error(
    directions: &[f64],
    friction: Friction,
    strains: PrincipalStretches,
    orientation: f64,
) -> f64 {
    let margin = |&direction: &f64| {
        let twice = 2.0 * (direction - orientation);
        let bond = strains.along([twice.cos(), twice.sin()]);
        let (stretch, shear) = (bond.stretch(), bond.shear());
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::yielding::lattice::directions;

    /// MPPD Tables 8 and 9, per cent, printed to 2 decimals, at nu = 0 and F_c = 3 F_t; strains in units of s_0t.
    #[test]
    fn entries_of_the_tables() {
        let sliding = Friction {
            cohesion: 0.5,
            slope: 0.0,
        };
        let frictional = Friction {
            cohesion: 0.75f64.sqrt(),
            slope: (1.0f64 / 3.0).sqrt(),
        };
        for (friction, ratio, first, second, printed) in [
            (sliding, 2.0, 0.0, 1.0, 41.48),
            (sliding, 5.0, -0.5, 0.5, 3.0),
            (frictional, 3.0, 1.5, 1.5, 0.0),
            (frictional, 2.0, 0.6, 1.2, 15.5),
            (frictional, 3.2, -1.5, 0.5, 5.74),
            (frictional, 4.0, -3.0, 0.0, 3.02),
        ] {
            let strains = PrincipalStretches::new(first, second);
            let found = 100.0 * worst(&directions(ratio), friction, strains).error;
            assert!((found - printed).abs() < 0.005, "{first} {second}: {found}");
        }
    }

    /// Without the angle and between the sampled orientations it would be 1/cos 2phi - 1; here one bond at 20 degrees
    /// to the worst direction of the sliding, |gamma| = 0.05 cos 40.
    #[test]
    fn sliding_is_taken_as_an_angle() {
        let sliding = Friction {
            cohesion: 0.05,
            slope: 0.0,
        };
        let strains = PrincipalStretches::new(0.1, 0.0);
        let found = error(&[25f64.to_radians()], sliding, strains, 0.0);
        let expected = 0.05 / (0.05 * 40f64.to_radians().cos()).atan() - 1.0;
        assert!((found - expected).abs() < 1e-14, "{found}");
    }
}
