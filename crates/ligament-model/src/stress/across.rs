//! Stresses on the planes across the bonds.

use rayon::prelude::*;

use super::point_strain::{Motion, StrainAround, mean_strain};
use crate::element::BondDeformation;
use crate::failure::hooke::{Moduli, StressAcross};
use crate::layout::Layout;
use crate::system::BondSystem;

impl<const D: usize> BondSystem<D> {
    /// Stress across each bond, with the means of the strains of its ends as far as these are known, shape (n_bonds).
    pub(crate) fn stresses_across(
        &self,
        layout: Layout,
        motion: Motion<'_>,
        deformations: &[BondDeformation],
        moduli: impl Fn(usize) -> Moduli + Sync,
    ) -> Vec<StressAcross> {
        let of_points = self.point_strains(layout, motion);
        let bonds = &self.bonds;
        let of_bond = |(bond, deformation): (usize, &BondDeformation)| {
            let [a, b] = bonds.ends[bond].map(|end| end as usize);
            let mean = mean_strain([of_points[a], of_points[b]]);
            let around = mean.map(|it| StrainAround::new(&it, bonds.direction[bond]));
            moduli(bond).stress_across(deformation.stretch(), around)
        };
        deformations.par_iter().enumerate().map(of_bond).collect()
    }
}
