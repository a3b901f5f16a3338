//! Strains by the forces that the bonds of a point carry.
//!
//! A bond with the direction n, the slope g = du/l and the factors phi_n and phi_t that are left of its axial and its shear rigidity carries
//! what a sound bond carries at the slope
//!
//! c = phi_n (n . e) n + phi_t (e - (n . e) n), e = g - omega x n - eps_T n,
//!
//! with the rotation omega about the point and its strain eps_T by temperature. A broken bond has c = 0, or c = f/(k l) where the faces of
//! the crack press with the force f and the stiffness k ([`crate::contact`]). Least squares as in [`super::point_strain`], over all bonds
//! that the point had at the start, give
//!
//! eps = sym(sum w c (x) n K^-1), K = sum w n (x) n.
//!
//! That is the strain at which the sound material carries the stress of the damaged one (Lemaitre and Chaboche 1990,
//! section 7.2: there 1 - D is one factor for all directions, here each bond has its own). A sound point has its strain by
//! `point_strain`, a point that lost all its bonds none. omega is the rotation that leaves the bonds the least shear,
//! sum w phi_t |(e - (n . e) n)|^2; bonds without shear rigidity have no part in it, so that points that fly apart do not matter.

use nalgebra::{Matrix3, Vector3};

use super::point_strain::{Fit, Motion, Neighbour};
use crate::contact::ClosedPair;
use crate::element::StiffnessFactors;
use crate::layout::Layout;
use crate::system::BondSystem;
use crate::tensor::{SymTensor, cross, dot};

/// Share of the spread of the bonds that is added to it where they lie along one line, about which they leave the rotation open.
const ALONG_A_LINE: f64 = 1e-12;

/// Motion of a body with the forces that its bonds and crack faces carry.
#[derive(Debug, Clone, Copy)]
pub struct Carried<'a> {
    /// Motion of the unbroken bonds, also of those that soften.
    pub motion: Motion<'a>,
    /// Remaining stiffness of each bond, shape (n_bonds); empty where it is whole.
    pub remaining: &'a [StiffnessFactors],
    /// Closed pairs of crack faces, ascending by their numbers.
    pub closed: &'a [ClosedPair],
}

/// Strain from which the stress of a point follows.
#[derive(Debug, Clone, Copy)]
pub enum StrainReading<'a> {
    /// Strain of the bonds that a motion has left, which gives the effective stress of damage mechanics.
    Effective(Motion<'a>),
    /// Strain at which sound bonds would carry the forces.
    Carried(Carried<'a>),
}

impl Carried<'_> {
    /// Remaining stiffness of a bond; none of a broken one.
    fn factors(&self, bond: usize) -> StiffnessFactors {
        match self.motion.intact[bond] {
            false => StiffnessFactors::NOTHING,
            true => (self.remaining.get(bond).copied()).unwrap_or(StiffnessFactors::WHOLE),
        }
    }

    /// Motion of the second end of a broken bond against the first at which a sound bond would carry the force of its closed faces, m.
    fn pressed<const D: usize>(&self, bond: u32) -> Option<[f64; D]> {
        let place = (self.closed).binary_search_by_key(&bond, |it| it.pair.number);
        let closed = &self.closed[place.ok()?];
        let along = closed.rubbing.map_or([0.0; 3], |it| it.force);
        let of_axis = |axis: usize| {
            closed.gap * closed.pair.normal[axis] + along[axis] / closed.pair.stiffness
        };
        Some(std::array::from_fn(of_axis))
    }
}

impl<const D: usize> BondSystem<D> {
    /// Strain of a point for its stress; None where its bonds do not span the space.
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

    /// Strain at which the sound bonds of a point would carry its forces; None where the bonds of the start do not span the space.
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
            (seen, carried.factors(bond as usize))
        };
        let elements = self.neighbours_by_elements(layout, motion, point);
        let of_elements = elements.map(|seen| (seen, StiffnessFactors::WHOLE));
        let all: Vec<_> = (family.iter().map(of_bond)).chain(of_elements).collect();
        let omega = rotation_of_least_shear(&all);
        let free = match motion.expansion.is_none() {
            true => SymTensor::ZERO,
            false => motion.expansion.of_point(point as usize).resized(),
        };
        let mut fit = Fit::default();
        for (seen, factors) in &all {
            let (turned, free) = (cross(omega, in_space(seen.n)), free.times(seen.n));
            let strain: [f64; D] = std::array::from_fn(|axis| {
                seen.moved[axis] - seen.length * (turned[axis] + free[axis])
            });
            let along = (factors.axial - factors.shear) * dot(seen.n, strain);
            let moved =
                std::array::from_fn(|axis| factors.shear * strain[axis] + along * seen.n[axis]);
            fit.add(seen.n, moved, seen.length, seen.weight_per_length);
        }
        for &bond in family {
            let Some(pressed) = carried.pressed(bond) else {
                continue;
            };
            let seen = self.neighbour(layout, motion, point, bond);
            let sign = if self.bonds.ends[bond as usize][0] == point {
                1.0
            } else {
                -1.0
            };
            fit.add_slope(seen.n, pressed.map(|it| sign * it), seen.weight_per_length);
        }
        fit.strain()
    }
}

/// Rotation of a point about x, y and z that leaves its bonds with their remaining stiffness the least shear, rad:
/// (sum w phi_t (1 - n (x) n)) omega = sum w phi_t n x g.
fn rotation_of_least_shear<const D: usize>(bonds: &[(Neighbour<D>, StiffnessFactors)]) -> [f64; 3] {
    let (mut spread, mut moments) = (Matrix3::zeros(), Vector3::zeros());
    for (seen, factors) in bonds {
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
