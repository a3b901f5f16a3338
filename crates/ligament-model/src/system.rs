//! The bond system: everything the equations are made of.

use rayon::prelude::*;

use crate::bonds::BondSet;
use crate::cloud::PointCloud;
use crate::element::beam::BeamBond;
use crate::element::spring::SpringBond;
use crate::element::{BondDeformation, BondElement, Element, ElementKind, UNKNOWNS};
use crate::law::BondStiffness;

/// Points and bonds with their rigidities; it never changes after construction.
#[derive(Debug, Clone)]
pub struct BondSystem {
    /// The points.
    pub cloud: PointCloud,
    /// The bonds (without those that pre-cracks cut).
    pub bonds: BondSet,
    /// Kinematics of the bonds.
    pub element: ElementKind,
    /// Omega alpha of each bond: its weight in the damage of its ends, shape (n_bonds).
    pub weight: Vec<f64>,
    /// Omega alpha V_A V_B k_n l, shape (n_bonds), J.
    pub axial_rigidity: Vec<f64>,
    /// Omega alpha V_A V_B k_t l, shape (n_bonds), J.
    pub shear_rigidity: Vec<f64>,
    /// Omega alpha V_A V_B k_theta, shape (n_bonds), J.
    pub rotational_rigidity: Vec<f64>,
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
        let BondStiffness {
            mut axial,
            mut shear,
            mut rotational,
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
        Self {
            axial_rigidity: axial,
            shear_rigidity: shear,
            rotational_rigidity: rotational,
            weight,
            element,
            bonds,
            cloud,
        }
    }

    /// Whether some bond has a negative axial or shear stiffness, so that the stiffness of the body may be indefinite.
    pub fn has_negative_stiffness(&self) -> bool {
        let mut rigidities = self.axial_rigidity.iter().chain(&self.shear_rigidity);
        rigidities.any(|&rigidity| rigidity < 0.0)
    }

    /// The element of a bond.
    pub fn element(&self, bond: usize) -> BondElement {
        match self.element {
            ElementKind::Beam => BondElement::Beam(BeamBond::of(self, bond)),
            ElementKind::Spring => BondElement::Spring(SpringBond::of(self, bond)),
        }
    }

    /// Deformation of a bond for the unknowns of all points, shape (3 n_points).
    pub fn deformation(&self, bond: usize, unknowns: &[f64]) -> BondDeformation {
        let [a, b] = self.bonds.ends[bond].map(|end| UNKNOWNS * end as usize);
        self.element(bond)
            .deformation(&unknowns[a..a + UNKNOWNS], &unknowns[b..b + UNKNOWNS])
    }
}
