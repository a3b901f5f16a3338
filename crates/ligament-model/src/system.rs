//! The bond system: everything the equations are made of.

mod answers;
mod contact;
mod crack_axis;
pub mod elements;

use rayon::prelude::*;

use crate::bonds::BondSet;
use crate::cloud::PointCloud;
use crate::contact::Faces;
use crate::deformation::DeformationPool;
use crate::element::strain_stiffness::StrainStiffness;
use crate::element::{Element, ElementKind, Elements, Rigidities, StiffnessFactors};
use crate::law::BondStiffness;

/// Points and bonds in D dimensions with their rigidities; it never changes after construction.
#[derive(Debug, Clone)]
pub struct BondSystem<const D: usize = 2> {
    /// The points.
    pub cloud: PointCloud<D>,
    /// The bonds (without those that pre-cracks cut).
    pub bonds: BondSet<D>,
    /// Omega alpha of each bond: its weight in the damage of its ends, shape (n_bonds).
    pub weight: Vec<f64>,
    /// Rigidities of the bonds.
    pub rigidities: Rigidities,
    /// Kinematics of the bonds.
    pub element: ElementKind,
    /// The part of the rigidities of each bond that corrections know nothing of ([`BondStiffness`] at interfaces), shape (n_bonds); empty
    /// where there is none.
    pub beyond_correction: Vec<StiffnessFactors>,
    /// Faces of the cracks.
    pub faces: Faces<D>,
    /// Memory of deformations.
    pub room: DeformationPool,
}

impl<const D: usize> BondSystem<D> {
    /// Puts the results of the earlier stages together: factors alpha and Omega and densities of all `bonds`.
    pub fn new(
        cloud: PointCloud<D>,
        bonds: BondSet<D>,
        element: ElementKind,
        stiffness: BondStiffness,
        length_factor: Vec<f64>,
        domain_factor: &[f64],
    ) -> Self {
        // The arrays of densities become those of rigidities: at this point of a run memory is scarce.
        let mut weight = length_factor;
        let (stiffness, beyond_correction) = stiffness.joined::<D>(element == ElementKind::Beam);
        let BondStiffness {
            mut axial,
            mut shear,
            mut rotational,
            strain,
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
                *axial = factor * *axial * l;
                *shear = factor * *shear * l;
                *rotational *= factor;
            });
        let of_bond = |(bond, density): (usize, StrainStiffness)| {
            let [a, b] = bonds.ends[bond].map(|end| cloud.volumes[end as usize]);
            let factor = weight[bond] * a * b * bonds.length[bond];
            StrainStiffness {
                entries: density.entries.map(|entry| factor * entry),
                ..density
            }
        };
        let rigidities = Rigidities {
            strain: strain.into_iter().enumerate().map(of_bond).collect(),
            axial,
            shear,
            rotational,
        };
        Self {
            rigidities,
            weight,
            element,
            beyond_correction,
            bonds,
            cloud,
            faces: Faces::default(),
            room: DeformationPool::default(),
        }
    }

    /// The system with faces of cracks.
    pub fn with_faces(self, faces: Faces<D>) -> Self {
        Self { faces, ..self }
    }
}

/// A bond system whose elements, between points with M components, are known as a type, so that loops over its bonds ask for it once.
#[derive(Debug, Clone)]
pub(crate) struct ElementSystem<const D: usize, const M: usize, E> {
    pub(crate) system: BondSystem<D>,
    pub(crate) elements: E,
}

/// The bonds that are left, with their remaining stiffness.
#[derive(Debug, Clone, Copy)]
pub struct UnbrokenBonds<'a> {
    /// For each bond, whether it is unbroken, shape (n_bonds).
    pub intact: &'a [bool],
    /// Remaining stiffness, shape (n_bonds); empty where it is whole.
    pub remaining: &'a [StiffnessFactors],
}

impl<'a> UnbrokenBonds<'a> {
    /// Unbroken bonds (n_bonds) with all of their stiffness.
    pub fn whole(intact: &'a [bool]) -> Self {
        Self {
            intact,
            remaining: &[],
        }
    }
}

// The sweeps over all bonds are these functions: the compiler left some as calls, which cost them a fifth more time.
impl<const D: usize, const M: usize, E: Elements<D, M>> ElementSystem<D, M, E> {
    /// The element of a bond with all of its stiffness, while the bonds marked in `intact` (n_bonds) are unbroken.
    #[inline(always)]
    pub(crate) fn whole(&self, intact: &[bool], bond: usize) -> E::Element {
        let BondSystem {
            bonds, rigidities, ..
        } = &self.system;
        self.elements.element(bonds, rigidities, intact, bond)
    }

    /// The element of a bond with what is left of it; None if it is broken.
    #[inline(always)]
    pub(crate) fn left(&self, bonds: UnbrokenBonds<'_>, bond: usize) -> Option<E::Element> {
        if !bonds.intact[bond] {
            return None;
        }
        let whole = self.whole(bonds.intact, bond);
        Some(match bonds.remaining.get(bond) {
            None => whole,
            Some(remaining) => whole.weakened(remaining),
        })
    }
}
