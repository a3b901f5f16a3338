//! Element of MBB-PD with true strains: differences of displacements over differences of the deformed positions (eqs 12 to 15 with Y; eq.
//! 6).
//!
//! The true strain of a quotient is eps/(1 + eps) of the small one eps. The small-strain element gives the forces for the stresses of the true strains, so that they do work on differences over the distances before the deformation, as the printed force densities do with the
//! volumes before it. A row under the stress sigma then has eps/(1 + eps) = sigma/E: it is longer by 1/(1 - sigma/E) than with small
//! strains.
//!
//! The forces are not linear in the displacements. The stiffness of small strains is used in all iterations: each reduces the error by about
//! a factor of the strain.

use std::sync::Arc;

use super::imaginary::{Axis, ImaginaryElement, ImaginaryElements, Quotients};
use super::{Block, BondDeformation, Element, Rigidities, StiffnessFactors, Term};
use crate::bonds::{BondSet, Incidence};
use crate::tensor::SymTensor;

/// The true-strain element of one bond with its remaining surroundings.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TrueStrainElement {
    small: ImaginaryElement,
    quotients: Quotients,
    /// Distance of each quotient before the deformation, m.
    distances: [f64; 4],
}

impl Element<2, 2> for TrueStrainElement {
    type Deformation = BondDeformation;

    type Lattice = ImaginaryElements;

    #[inline]
    fn new(
        lattice: &ImaginaryElements,
        bonds: &BondSet,
        rigidities: &Rigidities,
        intact: &[bool],
        bond: usize,
    ) -> Self {
        let quotients = Quotients::for_bond(bonds, &lattice.surroundings, intact, bond);
        let mut distances = [0.0; 4];
        for (distance, quotient) in distances.iter_mut().zip(quotients.iter()) {
            *distance = quotient.distance(&lattice.positions);
        }
        Self {
            small: ImaginaryElement::new(lattice, bonds, rigidities, intact, bond),
            quotients,
            distances,
        }
    }

    fn couplings(lattice: &ImaginaryElements) -> Option<[&Arc<Incidence>; 2]> {
        ImaginaryElement::couplings(lattice)
    }

    fn dependent_bonds(lattice: &ImaginaryElements, bonds: &[u32]) -> Vec<u32> {
        ImaginaryElement::dependent_bonds(lattice, bonds)
    }

    #[inline]
    fn weakened(self, remaining: &StiffnessFactors) -> Self {
        Self {
            small: self.small.weakened(remaining),
            ..self
        }
    }

    #[inline]
    fn deformation(&self, motions: &[f64]) -> BondDeformation {
        let mut strain = [0.0; 3];
        for (quotient, distance) in self.quotients.iter().zip(self.distances) {
            let [from, to] = quotient.ends.map(|end| 2 * end as usize);
            let [u, v] =
                [0, 1].map(|component| motions[to + component] - motions[from + component]);
            match quotient.axis {
                Axis::X => {
                    strain[0] += quotient.weight * u / (distance + u);
                    strain[2] += quotient.weight * v / (distance + u);
                }
                Axis::Y => {
                    strain[1] += quotient.weight * v / (distance + v);
                    strain[2] += quotient.weight * u / (distance + v);
                }
            }
        }
        BondDeformation::of_strain(strain)
    }

    #[inline]
    fn deformation_in(&self, strain: &SymTensor<2>) -> BondDeformation {
        self.small.deformation_in(strain)
    }

    #[inline]
    fn mutual_energy(&self, one: &BondDeformation, other: &BondDeformation) -> f64 {
        self.small.mutual_energy(one, other)
    }

    #[inline]
    fn forces(&self, deformation: &BondDeformation, add: impl FnMut(u32, [f64; 2])) {
        self.small.forces(deformation, add);
    }

    fn dyad(&self, deformation: &BondDeformation) -> SymTensor<2> {
        self.small.dyad(deformation)
    }

    /// Terms of the small-strain stiffness.
    fn terms(&self) -> Vec<Term> {
        self.small.terms()
    }

    /// Blocks of the small-strain stiffness.
    fn upper_blocks(&self, point: u32, add: impl FnMut(u32, Block<2>)) {
        self.small.upper_blocks(point, add);
    }
}
