//! The bond system: everything the equations are made of.

use rayon::prelude::*;

use crate::bonds::BondSet;
use crate::cloud::PointCloud;
use crate::element::ElementKind;
use crate::element::imaginary::{ImaginaryElements, StrainStiffness};
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
    /// What imaginary elements have besides; there if these are the elements.
    pub imaginary: Option<ImaginaryElements>,
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
            strain,
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
        let imaginary = element.has_strains().then(|| {
            let of_bond = |(bond, density): (usize, StrainStiffness)| {
                let [a, b] = bonds.ends[bond].map(|end| cloud.volumes[end as usize]);
                let factor = weight[bond] * a * b * bonds.length[bond];
                StrainStiffness {
                    entries: density.entries.map(|entry| factor * entry),
                    ..density
                }
            };
            let stiffness = strain.into_iter().enumerate().map(of_bond).collect();
            ImaginaryElements::new(&bonds, cloud.positions.clone(), stiffness)
        });
        Self {
            axial_rigidity: axial,
            shear_rigidity: shear,
            rotational_rigidity: rotational,
            weight,
            imaginary,
            element,
            bonds,
            cloud,
        }
    }

    /// Whether some bond has a negative axial or shear stiffness, or an indefinite one of its strains, so that the stiffness of the
    /// body may be indefinite.
    pub fn has_negative_stiffness(&self) -> bool {
        if let Some(elements) = &self.imaginary {
            return elements.some_indefinite();
        }
        let mut rigidities = self.axial_rigidity.iter().chain(&self.shear_rigidity);
        rigidities.any(|&rigidity| rigidity < 0.0)
    }

    /// Share of the energy of a bond that belongs to one of its ends: a half, but for imaginary elements.
    #[inline]
    pub fn share(&self, bond: u32, point: u32) -> f64 {
        match &self.imaginary {
            None => 0.5,
            Some(elements) => {
                let first_share = elements.stiffness[bond as usize].first_share;
                if self.bonds.ends[bond as usize][0] == point {
                    first_share
                } else {
                    1.0 - first_share
                }
            }
        }
    }

    /// The other points that elements couple with a point, ascending.
    pub fn coupled_points(&self, point: u32) -> impl Iterator<Item = u32> + '_ {
        // Of a pair a bond holds the other end, of other elements the list holds it as it is.
        let (entries, are_bonds) = match &self.imaginary {
            None => (self.bonds.incidence.at(point), true),
            Some(elements) => (elements.neighbours.at(point), false),
        };
        entries.iter().map(move |&entry| {
            if are_bonds {
                self.bonds.neighbour(entry, point)
            } else {
                entry
            }
        })
    }

    /// The bonds whose elements couple a point, ascending; with imaginary elements more than those that end there.
    pub fn elements_of(&self, point: u32) -> &[u32] {
        match &self.imaginary {
            None => self.bonds.incidence.at(point),
            Some(elements) => elements.couplings.at(point),
        }
    }
}
