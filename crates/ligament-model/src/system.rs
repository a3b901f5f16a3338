//! The bond system: everything the equations are made of.

mod answers;
mod contact;

use rayon::prelude::*;

use crate::bonds::BondSet;
use crate::cloud::PointCloud;
use crate::contact::Faces;
use crate::deformation::Room;
use crate::element::beam::BeamBond;
use crate::element::imaginary::{ImaginaryElements, StrainStiffness};
use crate::element::pair::Pairs;
use crate::element::pairwise::PairwiseElements;
use crate::element::spring::SpringBond;
use crate::element::true_strain::TrueStrainElements;
use crate::element::{Element, ElementKind, Elements, Remaining, Rigidities};
use crate::law::{BondStiffness, mbb_pd};

/// Points and bonds with their rigidities; it never changes after construction.
#[derive(Debug, Clone)]
pub struct BondSystem {
    /// The points.
    pub cloud: PointCloud,
    /// The bonds (without those that pre-cracks cut).
    pub bonds: BondSet,
    /// Omega alpha of each bond: its weight in the damage of its ends, shape (n_bonds).
    pub weight: Vec<f64>,
    /// Rigidities of the bonds.
    pub rigidities: Rigidities,
    /// Kinematics of the bonds.
    pub kinematics: Kinematics,
    /// The part of the rigidities of each bond that corrections know nothing of ([`BondStiffness`] at interfaces), shape (n_bonds); empty
    /// where there is none.
    pub beyond_correction: Vec<Remaining>,
    /// Faces of the cracks.
    pub faces: Faces,
    /// Memory of deformations.
    pub room: Room,
}

/// The kinematics of the bonds of a body.
#[derive(Debug, Clone)]
pub enum Kinematics {
    /// Pairs of points that turn.
    Beam(Pairs<BeamBond>),
    /// Pairs of points that do not.
    Spring(Pairs<SpringBond>),
    /// The imaginary lattice.
    Imaginary(ImaginaryElements),
    /// The imaginary lattice with true strains.
    TrueStrain(TrueStrainElements),
    /// The imaginary lattice with the printed forces.
    Pairwise(PairwiseElements),
}

impl Kinematics {
    /// Kinematics of `bonds` between the points of a cloud, with their weights (n_bonds) and, on a lattice, the densities
    /// of their stiffness over the strains (n_bonds).
    fn new(
        kind: ElementKind,
        cloud: &PointCloud,
        bonds: &BondSet,
        weight: &[f64],
        densities: Vec<StrainStiffness>,
    ) -> Self {
        let lattice = || {
            let of_bond = |(bond, density): (usize, StrainStiffness)| {
                let [a, b] = bonds.ends[bond].map(|end| cloud.volumes[end as usize]);
                let factor = weight[bond] * a * b * bonds.length[bond];
                StrainStiffness {
                    entries: density.entries.map(|entry| factor * entry),
                    ..density
                }
            };
            let stiffness = densities.into_iter().enumerate().map(of_bond).collect();
            ImaginaryElements::new(bonds, cloud.positions.clone(), stiffness)
        };
        match kind {
            ElementKind::Beam => Kinematics::Beam(Pairs::default()),
            ElementKind::Spring => Kinematics::Spring(Pairs::default()),
            ElementKind::Imaginary => Kinematics::Imaginary(lattice()),
            ElementKind::TrueStrain => {
                Kinematics::TrueStrain(TrueStrainElements { lattice: lattice() })
            }
            ElementKind::Pairwise => Kinematics::Pairwise(PairwiseElements {
                lattice: lattice(),
                row_factors: mbb_pd::pairwise::row_factors(bonds, cloud),
                spacing: cloud.cell_size(0),
            }),
        }
    }

    /// Kind of the bonds' elements.
    pub fn kind(&self) -> ElementKind {
        match self {
            Self::Beam(_) => ElementKind::Beam,
            Self::Spring(_) => ElementKind::Spring,
            Self::Imaginary(_) => ElementKind::Imaginary,
            Self::TrueStrain(_) => ElementKind::TrueStrain,
            Self::Pairwise(_) => ElementKind::Pairwise,
        }
    }

    /// The imaginary lattice, where the bonds are of one.
    pub fn lattice(&self) -> Option<&ImaginaryElements> {
        match self {
            Self::Beam(_) | Self::Spring(_) => None,
            Self::Imaginary(lattice) => Some(lattice),
            Self::TrueStrain(elements) => Some(&elements.lattice),
            Self::Pairwise(elements) => Some(&elements.lattice),
        }
    }
}

impl BondSystem {
    /// Puts the results of the earlier stages together: factors alpha and Omega and densities of all `bonds`.
    pub fn new(
        cloud: PointCloud,
        bonds: BondSet,
        element: ElementKind,
        stiffness: BondStiffness,
        length_factor: Vec<f64>,
        domain_factor: &[f64],
    ) -> Self {
        // The arrays of densities become those of rigidities: at this point of a run memory is scarce.
        let mut weight = length_factor;
        let (stiffness, beyond_correction) = stiffness.joined::<2>(element == ElementKind::Beam);
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
        let rigidities = Rigidities {
            axial,
            shear,
            rotational,
        };
        let kinematics = Kinematics::new(element, &cloud, &bonds, &weight, strain);
        Self {
            rigidities,
            weight,
            kinematics,
            beyond_correction,
            bonds,
            cloud,
            faces: Faces::default(),
            room: Room::default(),
        }
    }

    /// The system with faces of cracks.
    pub fn with_faces(self, faces: Faces) -> Self {
        Self { faces, ..self }
    }
}

/// The bonds that are left, with their remaining stiffness.
#[derive(Debug, Clone, Copy)]
pub struct BondsLeft<'a> {
    /// For each bond, whether it is unbroken, shape (n_bonds).
    pub intact: &'a [bool],
    /// Remaining stiffness, shape (n_bonds); empty where it is whole.
    pub remaining: &'a [Remaining],
}

impl<'a> BondsLeft<'a> {
    /// Unbroken bonds (n_bonds) with all of their stiffness.
    pub fn whole(intact: &'a [bool]) -> Self {
        Self {
            intact,
            remaining: &[],
        }
    }
}

/// A bond system whose elements, between points with M components, are known as a type, so that loops over its bonds ask for it once.
pub(crate) struct Typed<'a, E, const M: usize> {
    pub(crate) system: &'a BondSystem,
    pub(crate) elements: &'a E,
}

impl<E, const M: usize> Clone for Typed<'_, E, M> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<E, const M: usize> Copy for Typed<'_, E, M> {}

// The sweeps over all bonds are these functions: the compiler left some as calls, which cost them a fifth more time.
impl<'a, const M: usize, E: Elements<M>> Typed<'a, E, M> {
    pub(crate) fn new(system: &'a BondSystem, elements: &'a E) -> Self {
        Self { system, elements }
    }

    /// The element of a bond with all of its stiffness, while the bonds marked in `intact` (n_bonds) are unbroken.
    #[inline(always)]
    pub(crate) fn whole(self, intact: &[bool], bond: usize) -> E::Element {
        let BondSystem {
            bonds, rigidities, ..
        } = self.system;
        self.elements.element(bonds, rigidities, intact, bond)
    }

    /// The element of a bond with what is left of it; None if it is broken.
    #[inline(always)]
    pub(crate) fn left(self, bonds: BondsLeft<'_>, bond: usize) -> Option<E::Element> {
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
