//! Loci of first yield: limit strains along paths of loading from zero.

use std::f64::consts::PI;

use ligament_model::element::BondDeformation;
use ligament_model::parallel;

use super::{Family, PrincipalStretches};

/// Distance from zero, relative to the nearest point, beyond which a locus counts as open; parallel lines give larger values in spite of
/// rounding.
const OPEN: f64 = 1e6;

/// First yield along a straight path of loading.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LocusPoint {
    /// Angle chi of the path in the plane of s_1 and s_2, rad.
    pub path: f64,
    /// Strains at yield in theory, with a bond in the worst direction.
    pub theoretical: PrincipalStretches,
    /// Strains at yield in the worst orientation of the strain: the theoretical ones times 1 + e_max (MPPD Figs 36 to 38).
    pub effective: PrincipalStretches,
    /// Number of the decisive criterion in theory.
    pub criterion: usize,
    /// Deformation of the yielding bond in theory: the point of the locus in the plane of s and gamma.
    pub bond: BondDeformation,
    /// Error e_max along the path.
    pub error: f64,
}

/// Points of the locus in the plane of the principal stretches, at `count` paths evenly around it from s_2 = 0, s_1 > 0. Paths without yield
/// in theory have no point; the effective strains are infinite where a family has an orientation without yield.
///
/// In the plane of a bond's stretch and sliding the effective limit is the bond's deformation at theoretical yield times 1 + e_max of its
/// path: the limits of an isotropic material that would yield as late as the worst orientation. For stretch these are two points, as bonds
/// without sliding yield first.
pub fn principal_locus(family: &Family<'_>, count: u32) -> Vec<LocusPoint> {
    let point = |k: u32| {
        let path = 2.0 * PI * f64::from(k) / f64::from(count);
        let strains = PrincipalStretches::new(path.cos(), path.sin());
        let (critical, utilisation) = family.critical(strains);
        let (criterion, bond) = critical?;
        let error = family.worst(strains)?.error;
        let theoretical = strains.scaled(1.0 / utilisation);
        Some(LocusPoint {
            path,
            theoretical,
            effective: theoretical.scaled(1.0 + error),
            criterion,
            bond: BondDeformation::new([
                bond.stretch() / utilisation,
                bond.shear() / utilisation,
                0.0,
            ]),
            error,
        })
    };
    let points = parallel::flat_map(count as usize, |k| point(k as u32));
    let size = |it: &LocusPoint| it.theoretical.first.hypot(it.theoretical.second);
    closed_points(points, size)
}

/// Points at which the locus is not open.
fn closed_points<T>(mut points: Vec<T>, size: impl Fn(&T) -> f64) -> Vec<T> {
    let nearest = points.iter().map(&size).fold(f64::INFINITY, f64::min);
    points.retain(|point| size(point) <= OPEN * nearest);
    points
}

/// Limits (s, gamma) of the weakest bond, at `count` angles evenly around the plane of stretch and sliding from gamma = 0, s > 0, without
/// the angles at which it never yields.
pub fn bond_locus(family: &Family<'_>, count: u32) -> Vec<[f64; 2]> {
    let point = |k: u32| {
        let angle = 2.0 * PI * f64::from(k) / f64::from(count);
        let deformation = BondDeformation::new([angle.cos(), angle.sin(), 0.0]);
        let utilisation = family.utilisation_by(&deformation);
        (utilisation > 0.0).then(|| [angle.cos(), angle.sin()].map(|part| part / utilisation))
    };
    closed_points((0..count).filter_map(point).collect(), |point| {
        point[0].hypot(point[1])
    })
}

#[cfg(test)]
mod tests {
    use ligament_model::failure::frictional::Friction;
    use ligament_model::failure::{Criteria, Criterion, Measure};

    use super::*;
    use crate::yielding::lattice::directions;

    fn uniform(list: &[(Measure, f64, f64)], n_bonds: usize) -> Criteria {
        let criterion = |&(measure, limit, q): &(Measure, f64, f64)| Criterion {
            coefficient: vec![q; n_bonds].into(),
            ..Criterion::brittle("test", measure, vec![limit; n_bonds])
        };
        Criteria {
            list: list.iter().map(criterion).collect(),
        }
    }

    /// MPPD Figs 8 to 10 at nu = 0 in units of s_0t: the square with the corners (1, 1) and (-3, -3), the strip
    /// |s_1 - s_2| <= 1, and |s_1 - s_2|/(2 cos beta) + (s_1 + s_2)/2 tan(beta) <= a with beta = 30 degrees, a = 0.8660. To rounding.
    #[test]
    fn theoretical_loci_are_those_of_the_figures() {
        let directions = directions(3.0);
        let on = |list: &[(Measure, f64, f64)]| {
            let criteria = uniform(list, directions.len());
            principal_locus(&Family::from_directions(&directions, &criteria), 360)
        };
        let square = on(&[
            (Measure::Tension, 1.0, 0.0),
            (Measure::Compression, 3.0, 0.0),
        ]);
        assert_eq!(square.len(), 360);
        for PrincipalStretches { first, second } in square.iter().map(|limit| limit.theoretical) {
            let (high, low) = (first.max(second), first.min(second));
            assert!((high - 1.0).abs().min((low + 3.0).abs()) < 1e-12);
            assert!(high < 1.0 + 1e-12 && low > -3.0 - 1e-12);
        }
        let strip = on(&[(Measure::Sliding, 0.5, 0.0)]);
        assert_eq!(strip.len(), 358, "open along s_1 = s_2");
        for it in &strip {
            assert!((it.theoretical.deviator() - 0.5).abs() < 1e-12);
        }
        let (sine, cosine) = (PI / 6.0).sin_cos();
        let friction = Friction {
            cohesion: 0.75f64.sqrt(),
            slope: sine / cosine,
        };
        let cone = on(&[(Measure::Friction, friction.cohesion, friction.slope)]);
        assert!(cone.len() > 270 && cone.len() < 360, "open in compression");
        for it in &cone {
            let strains = it.theoretical;
            let value = strains.deviator() / cosine + strains.mean() * friction.slope;
            assert!((value - friction.cohesion).abs() < 1e-12 * strains.mean().abs().max(1.0));
            let limit = it.bond.shear() + it.bond.stretch() * friction.slope;
            assert!((limit - friction.cohesion).abs() < 1e-12 * strains.mean().abs().max(1.0));
        }
    }

    /// Sliding: the effective strip is 1/cos 2phi as wide for any path (m = 2: phi = 22.5 degrees), the limit
    /// in the plane of stretch and sliding likewise. To the tolerance of the search.
    #[test]
    fn effective_loci_are_the_theoretical_ones_times_the_error() {
        let directions = directions(2.0);
        let criteria = uniform(&[(Measure::Sliding, 0.5, 0.0)], directions.len());
        let family = Family::from_directions(&directions, &criteria);
        for it in principal_locus(&family, 40) {
            assert!((it.effective.deviator() - 0.5 * 2f64.sqrt()).abs() < 1e-8);
            assert!((it.bond.shear() - 0.5).abs() < 1e-12);
        }
        for [_, shear] in bond_locus(&family, 40) {
            assert!((shear.abs() - 0.5).abs() < 1e-12);
        }
    }
}
