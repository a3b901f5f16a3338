//! Energy of a straight crack: the energy that the bonds across it dissipate until the opening has broken each of them.
//!
//! The halves of the body are rigid and move apart by w along the normal n of the crack. A bond of the length l whose direction has the
//! angle phi to n is stretched by s = w cos(phi)/l and slides by gamma = w sin(phi)/l. It breaks by the criterion that it meets first, at
//! a deformation at which it has taken the energy
//!
//! W = (R_n s_0^2 + R_t gamma_0^2)/2 times the area under its law of softening (1 for a brittle bond),
//!
//! where s_0 and gamma_0 are those at its limit, and R_n and R_t its rigidities. A crack anywhere in a volume V meets a bond with the
//! vector xi with the probability abs(xi . n) over the length of V along n, so that the crack spends per area
//!
//! G = sum_b W_b abs(xi_b . n)/V
//!
//! (Silling and Askari 2005, eq. 26, as a sum over the bonds that there are, with their shear and with any criterion).
//!
//! A bond that lies nearly along the crack reaches its limit of stretch only when the crack is wide open, w = s_0 l/cos(phi), and would have
//! taken R_t s_0^2 tan(phi)^2/2 in shear until then: the sum over all directions has no limit, and one bond along a row of points could outweigh
//! all others. No crack opens across such a bond. Its ends lie side by side, and a crack passes both of them on the same side. So bonds count
//! whose ends are apart across the crack by a quarter of the distance of points at least (`PASSED`), the others as never broken.

use super::criterion::{Criteria, Criterion};
use super::measure::Weakened;
use super::starting::Surface;
use crate::element::BondDeformation;
use crate::system::BondSystem;

/// Distance of the ends of a bond across a crack over the spacing of the points, below which the crack bypasses the bond.
///
/// On irregular meshes the energies hardly depend on it between 0.1 and 0.45 (2.51 to 2.49 and 2.92 to 2.90 J/m^2 in a plate of 1,544 points by
/// `tension` at a Poisson's ratio of 0.2), and of lattices it takes no bond away.
const PASSED: f64 = 0.25;

/// Energy dissipated by straight cracks with one normal.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CrackEnergy {
    /// Energy per area of the crack G, J/m^2.
    pub per_area: f64,
    /// Fraction of the bonds across a crack that no opening breaks or that a crack bypasses.
    pub unbroken: f64,
}

impl CrackEnergy {
    /// The energy of cracks with a unit normal among the points marked in `among` (n_points). A bond counts one half at each of its ends. None
    /// without such points, and for imaginary elements, whose strains do not follow from the opening.
    pub fn for_normal(
        system: &BondSystem,
        criteria: &Criteria,
        among: &[bool],
        normal: [f64; 2],
    ) -> Option<Self> {
        if system.element.has_strains() {
            return None;
        }
        let (mut energy, mut across, mut unbroken) = (0.0, 0.0, 0.0);
        for (bond, &ends) in system.bonds.ends.iter().enumerate() {
            let marked = ends.iter().filter(|&&end| among[end as usize]).count();
            let length = system.bonds.length[bond];
            let [x, y] = system.bonds.direction[bond];
            let cosine = (x * normal[0] + y * normal[1]).abs();
            let sine = (x * normal[1] - y * normal[0]).abs();
            let met = 0.5 * marked as f64 * length * cosine;
            across += met;
            let opened = BondDeformation::new([cosine / length, sine / length, 0.0]);
            let spacing = ends.map(|end| system.cloud.spacing[end as usize]);
            let is_passed = length * cosine < PASSED * spacing[0].min(spacing[1]);
            let taken = (!is_passed).then(|| dissipated_energy(system, criteria, bond, &opened));
            match taken.flatten() {
                Some(taken) => energy += met * taken,
                None => unbroken += met,
            }
        }
        let marked = among.iter().zip(&*system.cloud.volumes);
        let volume: f64 = marked
            .filter(|(is, _)| **is)
            .map(|(_, volume)| volume)
            .sum();
        (across > 0.0).then(|| Self {
            per_area: energy / volume,
            unbroken: unbroken / across,
        })
    }
}

/// Energy that a bond dissipates until it breaks under a proportional growth of a deformation, J; None if it never breaks.
fn dissipated_energy(
    system: &BondSystem,
    criteria: &Criteria,
    bond: usize,
    growing: &BondDeformation,
) -> Option<f64> {
    let ends = criteria.list.iter().filter_map(|criterion| {
        let measure = criterion.measure(bond, growing);
        let limit = match criterion.starting() {
            // An opening is a tension, which does not reach the shear condition.
            Some(starting) if starting.surface != Surface::Tension => f64::INFINITY,
            // Wherever the bond begins to soften, it dissipates as much as a brittle bond with its fracture energy.
            Some(starting) => starting.critical[bond],
            None => criterion.break_limit(bond),
        };
        let end = limit / measure;
        (measure > 0.0 && end.is_finite()).then_some((end, criterion))
    });
    let (end, first) = ends.min_by(|(one, _), (other, _)| one.total_cmp(other))?;
    Some(by_criterion(system, first, bond, &growing.scaled(end)))
}

/// Energy of a bond that breaks by a criterion at a deformation, J.
fn by_criterion(
    system: &BondSystem,
    criterion: &Criterion,
    bond: usize,
    last: &BondDeformation,
) -> f64 {
    let rigidities = &system.rigidities;
    let squares = [
        rigidities.axial[bond] * last.stretch().powi(2),
        rigidities.shear[bond] * last.shear().powi(2),
    ];
    if criterion.starting().is_some() {
        return 0.5 * (squares[0] + squares[1]);
    }
    let after = &criterion.after;
    // Of the elastic energy at the end of the law, that at the limit is 1/end^2, of which the law takes `total` times.
    let softened = after.total_dissipated(bond) / after.end(bond).powi(2);
    let [axial, shear] = match criterion.measure.weakens() {
        Weakened::Opening | Weakened::Crushing | Weakened::Whole => [softened; 2],
        Weakened::Sliding => [1.0, softened],
    };
    0.5 * (axial * squares[0] + shear * squares[1])
}
