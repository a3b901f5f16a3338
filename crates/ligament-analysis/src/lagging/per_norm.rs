//! Largest ratios of measure to limit of bonds in a motion of a given energy.

use ligament_model::element::{BondDeformation, StiffnessFactors};
use ligament_model::failure::Criterion;
use ligament_model::parallel;
use ligament_model::stress::point_strain::StrainAround;

use super::division::Division;
use crate::problem::Problem;

/// Largest ratio kappa of the bonds of each part and of its descendants, shape (n_parts), J^(-1/2).
pub(super) fn of_parts(division: &Division, of_bond: impl Fn(u32) -> f64 + Sync) -> Vec<f64> {
    let largest = |part: usize| {
        let bonds = division.bonds(part);
        parallel::largest(bonds.len(), |place| of_bond(bonds[place]))
    };
    let mut per_norm: Vec<f64> = (0..division.parts.len()).map(largest).collect();
    for part in (1..division.parts.len()).rev() {
        if let Some(above) = division.parts[part].above {
            per_norm[above] = per_norm[above].max(per_norm[part]);
        }
    }
    per_norm
}

/// Largest ratio of measure to limit of a bond in a motion with an energy of 1/2 J of the bonds on which it depends, J^(-1/2), with the
/// largest strains `around` it in such a motion.
///
/// A measure of stretch, shear and rotation is at most the sum of the measures of each alone, |s| m_s + ..., and that sum at most
/// the root of (m_s^2/k_s + ...) for k_s s^2 + ... = 1 (Cauchy and Schwarz). A measure of stress is at most its value for the stretch
/// alone plus its value for the strains around the bond alone.
pub(super) fn of_bond(
    problem: &Problem,
    whole: &[bool],
    bond: usize,
    around: Option<StrainAround>,
) -> f64 {
    let unit = |place: usize, size: f64| {
        let mut strains = BondDeformation::default().strains();
        strains[place] = size;
        BondDeformation::new(strains)
    };
    let stiffness = |place: usize| {
        let (system, remaining) = (&problem.system, &StiffnessFactors::WHOLE);
        2.0 * system.stored_energy(whole, bond, remaining, &unit(place, 1.0))
    };
    let of_criterion = |criterion: &Criterion| {
        let limit = criterion.break_limit(bond);
        if criterion.follows_stress() {
            let of_stretch = criterion.largest_of_stress(
                bond,
                stiffness(0).sqrt().recip(),
                around.map(|_| StrainAround::default()),
            );
            let of_strain =
                around.map_or(0.0, |it| criterion.largest_of_stress(bond, 0.0, Some(it)));
            return (of_stretch + of_strain) / limit;
        }
        let of_strain = |place: usize| {
            let either = [1.0, -1.0].map(|size| criterion.measure(bond, &unit(place, size)));
            let measure = either[0].max(either[1]);
            if measure <= 0.0 {
                return 0.0;
            }
            measure.powi(2) / stiffness(place)
        };
        let n_strains = BondDeformation::default().strains().len();
        let squares: f64 = (0..n_strains).map(of_strain).sum();
        squares.sqrt() / limit
    };
    let ratios = problem.criteria.list.iter().map(of_criterion);
    ratios.fold(0.0, f64::max)
}
