//! First yield of the bonds of a point.

use std::f64::consts::PI;

use ligament_model::element::BondDeformation;
use ligament_model::failure::{Criteria, CriteriaInState, Criterion};
use ligament_model::system::BondSystem;

use super::PrincipalStretches;
use super::theory::critical_deformation;

/// Number of orientations with which the search for the worst one begins: one in two degrees.
const FIRST_ORIENTATIONS: usize = 90;

/// Accuracy of the smallest utilisation, relative to the theoretical utilisation.
const LEAST_UTILISATION_TOLERANCE: f64 = 1e-9;

/// Largest number of orientations in the search; only families in which a single bond decides over a wide range come near it.
const MOST_ORIENTATIONS: usize = 1_000_000;

/// Utilisation over the theoretical one below which a bond counts as unused: the rounding in a bond across the strain.
const UNUSED: f64 = 1e-12;

/// Bonds of a point: their directions and their failure criteria.
#[derive(Debug, Clone)]
pub struct Family<'a> {
    criteria: CriteriaInState<'a>,
    bonds: Vec<Bond>,
}

#[derive(Debug, Clone, Copy)]
struct Bond {
    /// Number of the bond in the criteria.
    number: usize,
    /// Cosine and sine of twice the angle to the x axis, which are equal for a bond and its opposite.
    twice: [f64; 2],
}

/// The orientation of a strain at which a family yields last.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WorstOrientation {
    /// Angle from the x axis to the first principal axis, rad.
    pub orientation: f64,
    /// Error e at the orientation, infinite where no load makes a bond yield.
    pub error: f64,
}

impl<'a> Family<'a> {
    /// The family of bonds at the angles `directions` to the x axis (n_bonds, rad), with the limits of the bonds 0, 1, ... of the
    /// criteria.
    pub fn from_directions(directions: &[f64], criteria: &'a Criteria) -> Self {
        let bond = |(number, direction): (usize, &f64)| Bond {
            number,
            twice: [(2.0 * direction).cos(), (2.0 * direction).sin()],
        };
        Self {
            criteria: criteria.without_state(),
            bonds: directions.iter().enumerate().map(bond).collect(),
        }
    }

    /// The family of a point of a body, with the criteria of the body's bonds.
    pub fn at_point(system: &BondSystem, criteria: &'a Criteria, point: u32) -> Self {
        let bond = |&number: &u32| {
            let [a, b] = system.bonds.direction[number as usize];
            Bond {
                number: number as usize,
                twice: [a * a - b * b, 2.0 * a * b],
            }
        };
        Self {
            criteria: criteria.without_state(),
            bonds: system.bonds.incidence.at(point).iter().map(bond).collect(),
        }
    }

    /// Number of bonds.
    pub fn len(&self) -> usize {
        self.bonds.len()
    }

    /// Whether there is no bond.
    pub fn is_empty(&self) -> bool {
        self.bonds.is_empty()
    }

    /// Largest utilisation U of the bonds under a strain whose first axis is at the angle `orientation` to the x axis (rad).
    pub fn utilisation(&self, strains: PrincipalStretches, orientation: f64) -> f64 {
        let (sine, cosine) = (2.0 * orientation).sin_cos();
        let of_bond = |bond: &Bond| {
            let [c, s] = bond.twice;
            let deformation = strains.along([c * cosine + s * sine, s * cosine - c * sine]);
            self.criteria.utilisation(bond.number, &deformation)
        };
        self.bonds.iter().map(of_bond).fold(0.0, f64::max)
    }

    /// Theoretical utilisation U_th of a strain, for each bond in its worst direction.
    pub fn theoretical_utilisation(&self, strains: PrincipalStretches) -> f64 {
        self.critical(strains).1
    }

    /// Deformation with the largest utilisation of its bond in the worst direction, with its criterion and the utilisation U_th; the first
    /// of several.
    pub(super) fn critical(
        &self,
        strains: PrincipalStretches,
    ) -> (Option<(usize, BondDeformation)>, f64) {
        let mut worst = (None, 0.0);
        let list = &self.criteria.criteria().list;
        for (place, criterion) in list.iter().enumerate() {
            for bond in &self.bonds {
                let deformation = critical_of(criterion, bond.number, strains);
                let utilisation = self
                    .criteria
                    .utilisation_by(place, bond.number, &deformation);
                if utilisation > worst.1 {
                    worst = (Some((place, deformation)), utilisation);
                }
            }
        }
        worst
    }

    /// Largest utilisation over all bonds of the family for a given deformation.
    pub fn utilisation_by(&self, deformation: &BondDeformation) -> f64 {
        (self.bonds.iter())
            .map(|bond| self.criteria.utilisation(bond.number, deformation))
            .fold(0.0, f64::max)
    }

    /// Error e = U_th/U - 1 at an orientation (rad): infinite where no bond yields however large the strain is, `None` where no bond yields
    /// in theory either.
    pub fn error(&self, strains: PrincipalStretches, orientation: f64) -> Option<f64> {
        let theory = self.theoretical_utilisation(strains);
        (theory > 0.0).then(|| error_of(theory, self.utilisation(strains, orientation)))
    }

    /// The worst of some orientations (rad), the first of several.
    pub fn worst_of(
        &self,
        strains: PrincipalStretches,
        orientations: impl Iterator<Item = f64>,
    ) -> Option<WorstOrientation> {
        let theory = self.theoretical_utilisation(strains);
        let sampled = orientations.map(|angle| (angle, self.utilisation(strains, angle)));
        let least = sampled.reduce(|best, next| if next.1 < best.1 { next } else { best })?;
        (theory > 0.0).then(|| WorstOrientation {
            orientation: least.0,
            error: error_of(theory, least.1),
        })
    }

    /// The worst of all orientations.
    ///
    /// The slope of U is bounded by the slope of its steepest criterion, which bounds U from below between two orientations; an interval is
    /// bisected where the bound is not above the smallest U so far. The result is the smallest U to 1e-9 U_th.
    pub fn worst(&self, strains: PrincipalStretches) -> Option<WorstOrientation> {
        let theory = self.theoretical_utilisation(strains);
        if theory <= 0.0 {
            return None;
        }
        let slope = self.steepest_slope() * strains.deviator();
        let tolerance = LEAST_UTILISATION_TOLERANCE * theory;
        let step = PI / FIRST_ORIENTATIONS as f64;
        let sampled: Vec<(f64, f64)> = (0..=FIRST_ORIENTATIONS)
            .map(|k| k as f64 * step)
            .map(|angle| (angle, self.utilisation(strains, angle)))
            .collect();
        let mut least = sampled[0];
        for &it in &sampled {
            if it.1 < least.1 {
                least = it;
            }
        }
        let mut open: Vec<[(f64, f64); 2]> = (sampled.windows(2).rev())
            .map(|pair| [pair[0], pair[1]])
            .collect();
        let mut looked_at = sampled.len();
        while let Some([from, to]) = open.pop() {
            let bound = 0.5 * (from.1 + to.1 - slope * (to.0 - from.0));
            if bound >= least.1 - tolerance || looked_at >= MOST_ORIENTATIONS {
                continue;
            }
            looked_at += 1;
            let middle = 0.5 * (from.0 + to.0);
            let middle = (middle, self.utilisation(strains, middle));
            if middle.1 < least.1 {
                least = middle;
            }
            open.push([middle, to]);
            open.push([from, middle]);
        }
        Some(WorstOrientation {
            orientation: least.0 % PI,
            error: error_of(theory, least.1),
        })
    }

    /// Largest slope of a utilisation over the orientation, per radian and unit of s_d.
    fn steepest_slope(&self) -> f64 {
        let of = |criterion: &Criterion, bond: &Bond| {
            let coefficient = coefficient_of(criterion, bond.number);
            criterion.measure.steepest_slope(coefficient) / criterion.limit[bond.number]
        };
        (self.criteria.criteria().list.iter())
            .flat_map(|criterion| self.bonds.iter().map(move |bond| of(criterion, bond)))
            .fold(0.0, f64::max)
    }
}

/// Error U_th/U - 1 of a utilisation.
fn error_of(theory: f64, utilisation: f64) -> f64 {
    if utilisation > UNUSED * theory {
        theory / utilisation - 1.0
    } else {
        f64::INFINITY
    }
}

fn critical_of(criterion: &Criterion, bond: usize, strains: PrincipalStretches) -> BondDeformation {
    critical_deformation(criterion.measure, coefficient_of(criterion, bond), strains)
}

fn coefficient_of(criterion: &Criterion, bond: usize) -> f64 {
    criterion.coefficient.get(bond).copied().unwrap_or(0.0)
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use ligament_model::failure::Measure;

    use super::*;
    use crate::yielding::lattice::{directions, worst_misalignment};
    use crate::yielding::printed_orientations;

    const RATIOS: [f64; 5] = [2.0, 3.0, 3.2, 4.0, 5.0];

    fn criteria(measures: &[(Measure, f64)], n_bonds: usize) -> Criteria {
        let list = measures
            .iter()
            .map(|&(measure, limit)| Criterion::brittle("test", measure, vec![limit; n_bonds]));
        Criteria {
            list: list.collect(),
        }
    }

    fn close(found: f64, expected: f64, tolerance: f64) {
        assert!((found - expected).abs() <= tolerance, "{found} {expected}");
    }

    /// A bond at the misalignment phi has max(s_1, s_2) no more: e = max/(s_m + s_d cos 2phi) - 1; sliding is largest
    /// at 45 degrees to the bond, and the lattice has the same gaps there: e = 1/cos 2phi - 1. To the tolerance of
    /// the search.
    #[test]
    fn errors_of_lattices_in_closed_form() {
        for ratio in RATIOS {
            let directions = directions(ratio);
            let twice = 2.0 * worst_misalignment(&directions);
            let stretch = criteria(&[(Measure::Tension, 0.7)], directions.len());
            let sliding = criteria(&[(Measure::Sliding, 0.2)], directions.len());
            for (first, second) in [
                (0.0, 1.0),
                (1.0, 0.5),
                (-1.0, 1.0),
                (-2.0, 1.0),
                (1.0, -0.3),
            ] {
                let strains = PrincipalStretches::new(first, second);
                let worst =
                    |criteria| Family::from_directions(&directions, criteria).worst(strains);
                let tension =
                    first.max(second) / (strains.mean() + strains.deviator() * twice.cos());
                let tolerance = 2e-9 * tension * tension;
                close(worst(&stretch).unwrap().error, tension - 1.0, tolerance);
                close(
                    worst(&sliding).unwrap().error,
                    1.0 / twice.cos() - 1.0,
                    8e-9,
                );
            }
        }
    }

    /// The criterion that is met first decides: MPPD Table 7 has both limits, here (0, 1) and (-3, 0) with s_0c = -3 s_0t; per
    /// cent, printed to 2 decimals, at the 101 orientations of the paper.
    #[test]
    fn limits_in_tension_and_in_compression() {
        let directions = directions(2.0);
        let both = criteria(
            &[(Measure::Tension, 1.0), (Measure::Compression, 3.0)],
            directions.len(),
        );
        let family = Family::from_directions(&directions, &both);
        for (first, second, printed) in [(0.0, 1.0, 17.16), (-3.0, 0.0, 17.16), (-3.0, 1.0, 24.26)]
        {
            let strains = PrincipalStretches::new(first, second);
            let worst = family.worst_of(strains, printed_orientations()).unwrap();
            close(100.0 * worst.error, printed, 0.005);
        }
        let spherical = PrincipalStretches::new(1.0, 1.0);
        assert_eq!(family.worst(spherical).unwrap().error, 0.0);
    }

    /// An irregular family with limits of its own for each bond, against 200,000 orientations: their distance of
    /// 1.6e-5 rad times the slope, 2 s_d/limit < 9, bounds their error of the least utilisation.
    #[test]
    fn the_worst_orientation_of_an_irregular_family() {
        let directions = [0.03, 0.31, 0.42, 0.97, 1.5, 1.52, 2.2, 2.41, 2.9];
        let limit = vec![1.0, 1.3, 0.9, 1.1, 1.0, 0.8, 1.4, 0.5, 1.0];
        let energy = Criterion {
            coefficient: vec![0.4; 9].into(),
            ..Criterion::brittle("energy", Measure::Energy, limit.clone())
        };
        let friction = Criterion {
            coefficient: vec![0.6; 9].into(),
            ..Criterion::brittle("friction", Measure::Friction, limit.clone())
        };
        let tension = Criterion::brittle("tension", Measure::Tension, limit);
        for list in [
            vec![energy],
            vec![friction.clone()],
            vec![tension, friction],
        ] {
            let criteria = Criteria { list };
            let family = Family::from_directions(&directions, &criteria);
            for (first, second) in [(1.0, 0.0), (1.0, -1.0), (-0.2, 0.9)] {
                let strains = PrincipalStretches::new(first, second);
                let theory = family.theoretical_utilisation(strains);
                let worst = family.worst(strains).unwrap();
                let sampled = (0..200_000).map(|k| PI * f64::from(k) / 200_000.0);
                let sampled = family.worst_of(strains, sampled).unwrap();
                let least = |worst: WorstOrientation| theory / (1.0 + worst.error);
                let excess = least(sampled) - least(worst);
                assert!((-1e-9..1.5e-4).contains(&excess), "{excess}");
                let there = family.error(strains, worst.orientation).unwrap();
                close(there, worst.error, 1e-12 * (1.0 + there));
            }
        }
    }

    #[test]
    fn what_never_yields_has_no_error() {
        let tension = criteria(&[(Measure::Tension, 1.0)], 1);
        let family = Family::from_directions(&[0.0], &tension);
        let pressed = PrincipalStretches::new(-1.0, -0.5);
        assert_eq!(family.worst(pressed), None);
        assert_eq!(family.error(pressed, 0.0), None);
        // A single bond across a bar is never stretched.
        let pulled = PrincipalStretches::new(1.0, -0.5);
        assert_eq!(family.error(pulled, 0.5 * PI), Some(f64::INFINITY));
        assert_eq!(family.worst(pulled).unwrap().error, f64::INFINITY);
        // Stretched to 6e-17 by rounding.
        let sheared = PrincipalStretches::new(1.0, -1.0);
        assert_eq!(family.error(sheared, 0.25 * PI), Some(f64::INFINITY));
    }
}
