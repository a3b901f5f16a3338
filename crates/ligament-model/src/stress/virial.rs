//! The virial stress: the mean of the force dyads of a point's bonds.

use crate::deformation::{Deformation, Deformations};
use crate::element::Element;
use crate::parallel;
use crate::system::{ElementSystem, UnbrokenBonds};
use crate::tensor::SymTensor;

impl<const D: usize, const M: usize, E: Element<D, M>> ElementSystem<D, M, E> {
    /// Virial stress of every point, shape (n_points), Pa.
    ///
    /// One thread sums over the bonds of a point in their order: the bits do not depend on the number of threads.
    pub(crate) fn virial_stresses(
        &self,
        bonds: UnbrokenBonds<'_>,
        deformations: &Deformations,
    ) -> Vec<SymTensor<D>> {
        parallel::values(self.system.cloud.len(), SymTensor::ZERO, |point| {
            self.virial_stress(bonds, deformations, point as u32)
        })
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
        &self,
        bonds: UnbrokenBonds<'_>,
        deformations: &Deformations,
        point: u32,
    ) -> SymTensor<D> {
        let elements = self
            .system
            .elements_at(self.topology.layout, deformations, point);
        let mut sum = elements.map_or(SymTensor::ZERO, |it| it.stress.scaled(it.volume));
        if let Some(terms) = &self.system.volumetric {
            let found = terms.stress_from_changes(bonds, deformations.volume_changes(), point);
            sum = sum.plus(&SymTensor::isotropic(found.stress_volume));
        }
        let deformations: &[E::Deformation] = Deformation::of_bonds(deformations);
        for &bond in self.system.bonds.incidence.at(point) {
            let Some(element) = self.remaining_element(bonds, bond as usize) else {
                continue;
            };
            let dyad = element.dyad(&deformations[bond as usize]);
            let is_first = self.topology.ends[bond as usize][0] == point;
            sum = sum.plus(&dyad.scaled(self.system.rigidities.share(bond, is_first)));
        }
        let volume = self.system.cloud.volumes[point as usize];
        sum.map(|value| value / volume)
    }
}
