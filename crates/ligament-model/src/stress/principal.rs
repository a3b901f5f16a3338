//! Principal stresses: of a point, and the largest one around a bond.

use rayon::prelude::*;

use super::point_strain::{Motion, mean_strain};
use crate::element::BondDeformation;
use crate::failure::starting::{SHARE, Starting};
use crate::layout::Layout;
use crate::system::BondSystem;
use crate::tensor::{SymTensor, dot};

impl<const D: usize> BondSystem<D> {
    /// Largest principal stress around each bond over the strength, shape (n_bonds); 0 where the bond is pulled across by less than
    /// [`SHARE`] of it or of the strength.
    ///
    /// The strain is that of the ends, with the bond's own stretch in the place of theirs along it,
    ///
    /// eps = eps_m + (s - n . eps_m n) n (x) n, sigma_1 = 2 mu eps_1 + lambda tr(eps),
    ///
    /// where neither end has a strain sigma_1 = E s of a bar.
    pub(crate) fn principal_stresses(
        &self,
        layout: Layout,
        motion: Motion<'_>,
        deformations: &[BondDeformation],
        starting: &Starting,
    ) -> Vec<f64> {
        let of_points = self.point_strains(layout, motion);
        let of_bond = |(bond, deformation): (usize, &BondDeformation)| {
            let (strength, moduli) = starting.surface(bond);
            let stretch = deformation.stretch();
            let ends = self.bonds.ends[bond].map(|end| of_points[end as usize]);
            let Some(mean) = mean_strain(ends) else {
                return (moduli.bar * stretch / strength).max(0.0);
            };
            let n = self.bonds.direction[bond];
            let along = dot(n, mean.times(n));
            let trace = stretch - along + (0..D).map(|axis| mean.at(axis, axis)).sum::<f64>();
            let normal = stretch + moduli.lateral * (trace - stretch);
            if normal < SHARE * strength {
                return 0.0;
            }
            let strain = SymTensor::<D>::from_fn(|row, column| {
                mean.at(row, column) + (stretch - along) * n[row] * n[column]
            });
            let principal = moduli.shear * strain.principal_values()[0] + moduli.lateral * trace;
            match normal >= SHARE * principal {
                true => principal / strength,
                false => 0.0,
            }
        };
        deformations.par_iter().enumerate().map(of_bond).collect()
    }
}

/// Principal values of a stress with these components, the largest first: two in the plane, three in space.
pub fn values(stress: &[f64]) -> Vec<f64> {
    match stress.len() == SymTensor::<2>::COMPONENTS.len() {
        true => SymTensor::<2>::from_components(stress)
            .principal_values()
            .to_vec(),
        false => SymTensor::<3>::from_components(stress)
            .principal_values()
            .to_vec(),
    }
}

/// Unit vector (x, y, z) along the largest principal stress of a stress with these components.
pub fn direction_of_largest(stress: &[f64]) -> Vec<f64> {
    match stress.len() == SymTensor::<2>::COMPONENTS.len() {
        true => {
            let [x, y] = SymTensor::<2>::from_components(stress).principal_direction();
            vec![x, y, 0.0]
        }
        false => SymTensor::<3>::from_components(stress)
            .principal_direction()
            .to_vec(),
    }
}
