//! The bond system of a body in space: everything the equations are made of.

use std::marker::PhantomData;

use rayon::prelude::*;

use super::element::{SolidElement, SolidKinematics};
use crate::bonds::BondSet;
use crate::cloud::PointCloud;
use crate::deformation::Room;
use crate::element::{Remaining, Rigidities};
use crate::law::BondStiffness;
use crate::system::BondsLeft;

/// Points and bonds in space with their rigidities; it never changes after construction.
#[derive(Debug, Clone)]
pub struct SolidSystem {
    /// The points.
    pub cloud: PointCloud<3>,
    /// The bonds (without those that pre-cracks cut).
    pub bonds: BondSet<3>,
    /// Omega alpha of each bond: its weight in the damage of its ends, shape (n_bonds).
    pub weight: Vec<f64>,
    /// Rigidities of the bonds.
    pub rigidities: Rigidities,
    /// Kinematics of the bonds.
    pub element: SolidElement,
    /// The part of the rigidities of each bond that corrections know nothing of ([`BondStiffness`] at interfaces), shape (n_bonds); empty
    /// where there is none.
    pub beyond_correction: Vec<Remaining>,
    /// Memory of deformations.
    pub room: Room,
}

impl SolidSystem {
    /// Puts the results of the earlier stages together: factors alpha and Omega and densities of all `bonds`.
    pub fn new(
        cloud: PointCloud<3>,
        bonds: BondSet<3>,
        element: SolidElement,
        stiffness: BondStiffness,
        length_factor: Vec<f64>,
        domain_factor: &[f64],
    ) -> Self {
        // The arrays of densities become those of rigidities: at this point of a run memory is scarce.
        let mut weight = length_factor;
        let (stiffness, beyond_correction) = stiffness.joined::<3>(element == SolidElement::Beam);
        let BondStiffness {
            mut axial,
            mut shear,
            mut rotational,
            ..
        } = stiffness;
        (
            (&bonds.ends, &bonds.length, domain_factor).into_par_iter(),
            (&mut weight, &mut axial, &mut shear, &mut rotational).into_par_iter(),
        )
            .into_par_iter()
            .for_each(|((ends, l, omega), (weight, axial, shear, rotational))| {
                let [a, b] = ends.map(|end| cloud.volumes[end as usize]);
                *weight *= omega;
                let factor = *weight * a * b;
                *axial *= factor * l;
                *shear *= factor * l;
                *rotational *= factor;
            });
        Self {
            rigidities: Rigidities {
                axial,
                shear,
                rotational,
            },
            cloud,
            bonds,
            weight,
            element,
            beyond_correction,
            room: Room::default(),
        }
    }
}

/// A bond system in space whose bonds, between points with M components, are known as a type, so that loops over them ask for it once.
pub(super) struct Typed<'a, B, const M: usize> {
    pub(super) system: &'a SolidSystem,
    bond: PhantomData<B>,
}

impl<B, const M: usize> Clone for Typed<'_, B, M> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<B, const M: usize> Copy for Typed<'_, B, M> {}

impl<'a, const M: usize, B: SolidKinematics<M>> Typed<'a, B, M> {
    pub(super) fn new(system: &'a SolidSystem) -> Self {
        Self {
            system,
            bond: PhantomData,
        }
    }

    /// A bond with all of its stiffness.
    #[inline(always)]
    pub(super) fn whole(self, bond: usize) -> B {
        B::new(&self.system.bonds, &self.system.rigidities, bond)
    }

    /// A bond with what is left of it; None if it is broken.
    #[inline(always)]
    pub(super) fn left(self, bonds: BondsLeft<'_>, bond: usize) -> Option<B> {
        if !bonds.intact[bond] {
            return None;
        }
        let whole = self.whole(bond);
        Some(match bonds.remaining.get(bond) {
            None => whole,
            Some(remaining) => whole.weakened(remaining),
        })
    }

    /// Deformation of a bond for the motions of all points, shape (M n_points), m and rad.
    #[inline(always)]
    pub(super) fn deformation(self, bond: usize, motions: &[f64]) -> crate::SpaceDeformation {
        let [a, b] = self.system.bonds.ends[bond].map(|end| M * end as usize);
        self.whole(bond)
            .deformation(&motions[a..a + M], &motions[b..b + M])
    }
}
