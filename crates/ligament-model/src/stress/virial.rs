//! The virial stress: the mean of the force dyads of a point's bonds.

use rayon::prelude::*;

use crate::element::{BondDeformation, Element, Elements};
use crate::system::{BondsLeft, Typed};

/// Stresses xx, yy and xy, Pa.
pub type SymmetricStress = [f64; 3];

impl<const M: usize, E: Elements<M>> Typed<'_, E, M> {
    /// Virial stress of every point, shape (n_points).
    pub(crate) fn virial_stresses(
        self,
        bonds: BondsLeft<'_>,
        deformations: &[BondDeformation],
    ) -> Vec<SymmetricStress> {
        (0..self.system.cloud.len() as u32)
            .into_par_iter()
            .map(|point| self.virial_stress(bonds, deformations, point))
            .collect()
    }

    /// Virial stress of one point, Pa: sigma_i = 1/(2 V_i) sum_j f_ij (x) xi_ij over its intact bonds, with the force f_ij that
    /// point j exerts on i and xi_ij = X_j - X_i.
    ///
    /// Factor and sign follow from equilibrium. For forces F_i on a body, V \<sigma\> = sum_i F_i (x) X_i (the mean stress theorem);
    /// with F_i = -sum_j f_ij and f_ji = -f_ij a bond gives f_ij (x) xi_ij once, half of it to each end as of its energy. So
    /// sum_i V_i sigma_i is the mean stress of any body in equilibrium, exactly. The derivative of the point's energy density for
    /// a uniform strain is the same, so that the stress is as good as the energies of the correction are.
    ///
    /// A bond with a shear force has f and xi in different directions. The couples at its ends balance that: the symmetric part
    /// is given, sigma_xy = (f_x xi_y + f_y xi_x)/2. At the outline half of the neighbours is missing; that a correction makes up
    /// for the energy does not make the stress on a free side zero.
    pub(crate) fn virial_stress(
        self,
        bonds: BondsLeft<'_>,
        deformations: &[BondDeformation],
        point: u32,
    ) -> SymmetricStress {
        let system = self.system;
        let mut sum = [0.0; 3];
        for &bond in system.bonds.incidence.at(point) {
            let Some(element) = self.left(bonds, bond as usize) else {
                continue;
            };
            let share = self.elements.share(&system.bonds, bond, point);
            let dyad = element.dyad(&deformations[bond as usize]);
            for (sum, part) in sum.iter_mut().zip(dyad) {
                *sum += share * part;
            }
        }
        sum.map(|value| value / system.cloud.volumes[point as usize])
    }
}
