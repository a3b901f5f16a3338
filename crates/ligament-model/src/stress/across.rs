//! Stresses on the planes across the bonds.

use super::point_strain::{Motion, StrainAround, mean_strain};
use crate::element::BondDeformation;
use crate::failure::hooke::{Moduli, StressAcross};
use crate::layout::Layout;
use crate::parallel;
use crate::system::{BondSystem, UnbrokenBonds};
use crate::volumetric::VolumetricStress;

impl<const D: usize> BondSystem<D> {
    /// Stress across each bond from the mean of the known strains of its ends, shape (n_bonds).
    pub(crate) fn stresses_across(
        &self,
        layout: Layout,
        motion: Motion<'_>,
        deformations: &[BondDeformation],
        moduli: impl Fn(usize) -> Moduli + Sync,
    ) -> Vec<StressAcross> {
        let of_points = self.point_strains(layout, motion);
        let of_cells = self.cell_stresses(layout, motion);
        let bonds = &self.bonds;
        parallel::values(deformations.len(), StressAcross::default(), |bond| {
            let [a, b] = bonds.ends[bond].map(|end| end as usize);
            let mean = mean_strain([of_points[a], of_points[b]]);
            let around = mean.map(|it| StrainAround::new(&it, bonds.direction[bond]));
            let moduli = moduli(bond);
            let mut stress = moduli.stress_across(deformations[bond].stretch(), around);
            stress.normal += of_cells.mean_at_ends(bonds.ends[bond]) / moduli.along;
            stress
        })
    }

    /// Volumetric stresses of the cells at the points in a motion.
    pub(super) fn cell_stresses(&self, layout: Layout, motion: Motion<'_>) -> CellStresses {
        let bonds = UnbrokenBonds::whole(motion.intact);
        let motions = (motion.displacement, layout.components.len());
        let terms = self.volumetric.as_ref();
        CellStresses(terms.map(|it| it.stresses(bonds, motions, motion.expansion)))
    }
}

/// Volumetric stresses of the cells at the points (n_points); none where bonds have the whole stiffness of the materials.
pub(super) struct CellStresses(Option<Vec<VolumetricStress>>);

impl CellStresses {
    /// Mean of the volumetric stresses at those ends of a bond that have living cells, Pa; 0 if neither has any.
    pub(super) fn mean_at_ends(&self, ends: [u32; 2]) -> f64 {
        let Some(of_points) = &self.0 else {
            return 0.0;
        };
        match ends.map(|end| of_points[end as usize].mean_over_living()) {
            [Some(a), Some(b)] => 0.5 * (a + b),
            [one, other] => one.or(other).unwrap_or(0.0),
        }
    }
}
