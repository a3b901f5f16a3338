//! Strains from the forces that the bonds of a point carry.
//!
//! A bond with the direction n, the slope g = du/l and the factors phi_n and phi_t that are left of its axial and its shear rigidity carries
//! what a sound bond carries at the slope
//!
//! c = phi_n (n . e) n + phi_t (e - (n . e) n), e = g - omega x n - eps_T n,
//!
//! with the rotation omega about the point and its strain eps_T by temperature. A broken bond has c = 0, or that of the force f/(k l) where
//! the faces of the crack press with the force f and the stiffness k ([`crate::contact`]). The gradient G = eps + W whose sound bonds carry
//! these forces best has the least
//!
//! sum w [(n . G n - n . c)^2 + r |(1 - n (x) n)(G n - c)|^2], r = k_t/k_n, w as in [`super::point_strain`],
//!
//! over all bonds that the point had at the start, so that each component of a slope counts with its energy: a motion across a bond without
//! shear rigidity says nothing of the stress. Then C : eps is the mean of the forces along the bonds as in the virial stress, without its
//! faults at edges: an affine motion of sound bonds gives its own strain.
//!
//! That is the strain at which the sound material carries the stress of the damaged one (Lemaitre and Chaboche 1990,
//! section 7.2: there 1 - D is one factor for all directions, here each bond has its own). A sound point has its strain by
//! `point_strain`, a point that lost all its bonds none. omega is the rotation that leaves the bonds the least shear,
//! sum w phi_t |(e - (n . e) n)|^2; bonds without shear rigidity have no part in it, so that points that fly apart do not matter.

use nalgebra::{DMatrix, DVector, Matrix3, Vector3};

use super::point_strain::{Fit, Motion, Neighbour};
use crate::contact::ClosedPair;
use crate::element::StiffnessFactors;
use crate::layout::Layout;
use crate::system::BondSystem;
use crate::tensor::{SymTensor, cross, dot};

/// Fraction of the spread of the bonds that is added to it where they lie along one line and leave the rotation about it undetermined.
const ALONG_A_LINE: f64 = 1e-12;

/// Least share r of the stiffness along a bond that counts across it, by which W is determined where no bond resists shear: its part in eps
/// is of the same order, and what rounding leaves of W is not in eps.
const LEAST_SHEAR: f64 = 1e-9;

/// Motion of a body with the forces that its bonds and crack faces carry.
#[derive(Debug, Clone, Copy)]
pub struct Carried<'a> {
    /// Motion of the unbroken bonds, softening ones included.
    pub motion: Motion<'a>,
    /// Remaining stiffness of each bond, shape (n_bonds); empty where it is whole.
    pub remaining: &'a [StiffnessFactors],
    /// Closed pairs of crack faces, ascending by their numbers.
    pub closed: &'a [ClosedPair],
}

/// Choice of the strain from which the stress of a point follows.
#[derive(Debug, Clone, Copy)]
pub enum StrainReading<'a> {
    /// Strain of the unbroken bonds, which gives the effective stress of damage mechanics.
    Effective(Motion<'a>),
    /// Strain at which undamaged bonds would carry the same forces.
    Carried(Carried<'a>),
}

impl<'a> StrainReading<'a> {
    /// Motion of the points.
    pub(crate) fn motion(&self) -> Motion<'a> {
        match self {
            Self::Effective(motion) => *motion,
            Self::Carried(carried) => carried.motion,
        }
    }
}

impl Carried<'_> {
    /// Remaining stiffness factors of a bond; zero for a broken bond.
    fn factors(&self, bond: usize) -> StiffnessFactors {
        match self.motion.intact[bond] {
            false => StiffnessFactors::NOTHING,
            true => (self.remaining.get(bond).copied()).unwrap_or(StiffnessFactors::WHOLE),
        }
    }

    /// Relative displacement of the ends of a broken bond at which an undamaged bond would carry the contact force of its closed faces, m.
    fn displacement_of_contact<const D: usize>(&self, bond: u32) -> Option<[f64; D]> {
        let place = (self.closed).binary_search_by_key(&bond, |it| it.pair.number);
        let closed = &self.closed[place.ok()?];
        let along = closed.friction.map_or([0.0; 3], |it| it.force);
        let of_axis = |axis: usize| {
            closed.gap * closed.pair.normal[axis] + along[axis] / closed.pair.stiffness
        };
        Some(std::array::from_fn(of_axis))
    }
}

impl<const D: usize> BondSystem<D> {
    /// Strain of a point by a reading; None where its bonds do not span the space.
    pub(crate) fn strain_by(
        &self,
        layout: Layout,
        reading: StrainReading<'_>,
        point: u32,
    ) -> Option<SymTensor<D>> {
        match reading {
            StrainReading::Effective(motion) => self.point_strain(layout, motion, point),
            StrainReading::Carried(carried) => self.carried_strain(layout, carried, point),
        }
    }

    /// Strain at which the undamaged bonds of a point would carry its forces; None where its initial bonds do not span the space.
    fn carried_strain(
        &self,
        layout: Layout,
        carried: Carried<'_>,
        point: u32,
    ) -> Option<SymTensor<D>> {
        let (motion, family) = (carried.motion, self.bonds.incidence.at(point));
        let is_whole = |&bond: &u32| carried.factors(bond as usize) == StiffnessFactors::WHOLE;
        if family.iter().all(is_whole) {
            return self.point_strain(layout, motion, point);
        }
        let of_bond = |&bond: &u32| {
            let seen = self.neighbour(layout, motion, point, bond);
            let factors = carried.factors(bond as usize);
            (seen, factors, self.shear_ratio(bond as usize))
        };
        let elements = self.neighbours_by_elements(layout, motion, point);
        let of_elements = elements.map(|seen| (seen, StiffnessFactors::WHOLE, 1.0));
        let all: Vec<_> = (family.iter().map(of_bond)).chain(of_elements).collect();
        let omega = rotation_of_least_shear(&all);
        let free = motion.expansion.in_body::<D>(point);
        let mut fit = EnergyFit::default();
        for (seen, factors, ratio) in &all {
            let (turned, free) = (cross(omega, in_space(seen.n)), free.times(seen.n));
            let strain: [f64; D] = std::array::from_fn(|axis| {
                seen.moved[axis] - seen.length * (turned[axis] + free[axis])
            });
            let shear = factors.shear * ratio;
            let along = (factors.axial - shear) * dot(seen.n, strain);
            let force = std::array::from_fn(|axis| shear * strain[axis] + along * seen.n[axis]);
            fit.add(seen, *ratio);
            fit.add_force(seen, force);
        }
        for &bond in family {
            let Some(pressed) = carried.displacement_of_contact(bond) else {
                continue;
            };
            let seen = self.neighbour(layout, motion, point, bond);
            let is_first = self.bonds.ends[bond as usize][0] == point;
            let sign = if is_first { 1.0 } else { -1.0 };
            fit.add_force(&seen, pressed.map(|it| sign * it));
        }
        fit.strain()
    }

    /// Ratio k_t/k_n of the stiffness across an undamaged bond to the stiffness along it, between the ratio of a spring and of a point that resists
    /// all motions alike.
    fn shear_ratio(&self, bond: usize) -> f64 {
        let [axial, shear] = [&self.rigidities.axial, &self.rigidities.shear].map(|it| it[bond]);
        if axial > 0.0 {
            (shear / axial).clamp(LEAST_SHEAR, 1.0)
        } else {
            1.0
        }
    }
}

/// Sums over the bonds of a point that determine the strain at which undamaged bonds carry its forces.
struct EnergyFit<const D: usize> {
    /// Sums of [`Fit`], which show whether the bonds span the space.
    spread: Fit<D>,
    /// sum w N (x) n (x) n over the components of G, row by row, with N = n (x) n + r (1 - n (x) n), shape (D^2, D^2).
    stiffness: DMatrix<f64>,
    /// sum w N c (x) n, shape (D^2).
    forces: DVector<f64>,
}

impl<const D: usize> Default for EnergyFit<D> {
    fn default() -> Self {
        Self {
            spread: Fit::default(),
            stiffness: DMatrix::zeros(D * D, D * D),
            forces: DVector::zeros(D * D),
        }
    }
}

impl<const D: usize> EnergyFit<D> {
    /// Adds a sound bond with the ratio r of its stiffnesses.
    fn add(&mut self, seen: &Neighbour<D>, ratio: f64) {
        let n = seen.n;
        (self.spread).add(n, [0.0; D], seen.length, seen.weight_per_length);
        let weight = seen.length * seen.weight_per_length;
        let across = |row: usize, column: usize| if row == column { ratio } else { 0.0 };
        for row in 0..D * D {
            for column in 0..D * D {
                let [(i, k), (j, l)] = [row, column].map(|it| (it / D, it % D));
                let both = across(i, j) + (1.0 - ratio) * n[i] * n[j];
                self.stiffness[(row, column)] += weight * both * (n[k] * n[l]);
            }
        }
    }

    /// Adds the force of a bond over the stiffness k_n of a sound one, m.
    fn add_force(&mut self, seen: &Neighbour<D>, force: [f64; D]) {
        for row in 0..D * D {
            self.forces[row] += seen.weight_per_length * (force[row / D] * seen.n[row % D]);
        }
    }

    /// The strain; None where the bonds do not span the space.
    fn strain(self) -> Option<SymTensor<D>> {
        self.spread.span()?;
        let gradient = self.stiffness.cholesky()?.solve(&self.forces);
        Some(SymTensor::from_fn(|row, column| {
            0.5 * (gradient[D * row + column] + gradient[D * column + row])
        }))
    }
}

/// Rotation of a point about x, y and z that leaves its bonds with their remaining stiffness the least shear, rad:
/// (sum w phi_t (1 - n (x) n)) omega = sum w phi_t n x g.
fn rotation_of_least_shear<const D: usize>(
    bonds: &[(Neighbour<D>, StiffnessFactors, f64)],
) -> [f64; 3] {
    let (mut spread, mut moments) = (Matrix3::zeros(), Vector3::zeros());
    for (seen, factors, _) in bonds {
        let weight_per_length = factors.shear * seen.weight_per_length;
        let n = in_space(seen.n);
        let weight = weight_per_length * seen.length;
        let along = Vector3::from(n);
        spread += (Matrix3::identity() - along * along.transpose()) * weight;
        moments += Vector3::from(cross(n, in_space(seen.moved))) * weight_per_length;
    }
    let open = Matrix3::identity() * (ALONG_A_LINE * spread.trace());
    let solved = (spread + open).cholesky().map(|it| it.solve(&moments));
    solved.map_or([0.0; 3], Into::into)
}

/// A vector of a body in the plane or in space, with three components.
fn in_space<const D: usize>(vector: [f64; D]) -> [f64; 3] {
    std::array::from_fn(|axis| vector.get(axis).copied().unwrap_or(0.0))
}

#[cfg(test)]
mod tests;
