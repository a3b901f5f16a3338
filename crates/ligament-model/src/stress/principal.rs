//! Principal stresses: of a point, and those around a bond at which it begins to soften.

use rayon::prelude::*;

use super::point_strain::{Motion, StrainAround, mean_strain};
use crate::element::BondDeformation;
use crate::failure::hooke::Moduli;
use crate::failure::starting::{SHARE, Starting, Surface};
use crate::layout::Layout;
use crate::system::BondSystem;
use crate::tensor::{SymTensor, dot};

impl<const D: usize> BondSystem<D> {
    /// Stress around each bond over the strength at which it begins to soften, shape (n_bonds); 0 where tension pulls the bond across by less
    /// than [`SHARE`] of it.
    ///
    /// The strain is that of the ends, with the bond's own stretch in the place of theirs along it,
    ///
    /// eps = eps_m + (s - n . eps_m n) n (x) n, sigma_i = 2 mu eps_i + lambda tr(eps),
    ///
    /// where neither end has a strain sigma_1 = E s of a bar.
    pub(crate) fn utilisations(
        &self,
        layout: Layout,
        motion: Motion<'_>,
        deformations: &[BondDeformation],
        starting: &Starting,
    ) -> Vec<f64> {
        let of_points = self.point_strains(layout, motion);
        let of_cells = self.cell_stresses(layout, motion);
        let of_bond = |(bond, deformation): (usize, &BondDeformation)| {
            let (strength, moduli) = starting.strength(bond);
            let stretch = deformation.stretch();
            let [a, b] = self.bonds.ends[bond].map(|end| end as usize);
            let Some(mean) = mean_strain([of_points[a], of_points[b]]) else {
                return match starting.surface {
                    Surface::Tension => (moduli.bar * stretch / strength).max(0.0),
                    Surface::Shear { .. } => 0.0,
                };
            };
            let n = self.bonds.direction[bond];
            let of_cells = of_cells.around(self.bonds.ends[bond]) / moduli.along;
            let principal =
                || principal(&own_strain(&mean, stretch, n), moduli).map(|it| it + of_cells);
            match &starting.surface {
                Surface::Tension => {
                    let around = StrainAround::new(&mean, n);
                    let normal = moduli.stress_across(stretch, Some(around)).normal + of_cells;
                    if normal <= 0.0 {
                        return 0.0;
                    }
                    let [largest, _] = principal();
                    match normal >= SHARE * largest {
                        true => largest / strength,
                        false => 0.0,
                    }
                }
                Surface::Shear { slope } => {
                    let slope = slope[bond];
                    let [largest, smallest] = principal();
                    let (mean, radius) = (0.5 * (largest + smallest), 0.5 * (largest - smallest));
                    let worst = radius * slope.hypot(1.0) + mean * slope;
                    (worst / strength).max(0.0)
                }
            }
        };
        deformations.par_iter().enumerate().map(of_bond).collect()
    }
}

/// Strain around a bond with the direction n, from that of its ends and its own stretch.
fn own_strain<const D: usize>(mean: &SymTensor<D>, stretch: f64, n: [f64; D]) -> SymTensor<D> {
    let along = dot(n, mean.times(n));
    SymTensor::from_fn(|row, column| mean.at(row, column) + (stretch - along) * n[row] * n[column])
}

/// The largest and the smallest principal stress of a strain over E'.
fn principal<const D: usize>(strain: &SymTensor<D>, moduli: &Moduli) -> [f64; 2] {
    let trace = strain.trace();
    let values = strain.principal_values();
    [values[0], values[D - 1]].map(|it| moduli.shear * it + moduli.lateral * trace)
}

/// Principal values of a stress with these components, the largest first: two in the plane, three in space.
pub fn values(stress: &[f64]) -> Vec<f64> {
    match in_plane(stress) {
        Some(stress) => stress.principal_values().to_vec(),
        None => SymTensor::<3>::from_components(stress)
            .principal_values()
            .to_vec(),
    }
}

/// Stress in the plane of components in the plane, with or without one across it; None for components in space.
fn in_plane(stress: &[f64]) -> Option<SymTensor<2>> {
    let in_space = SymTensor::<3>::COMPONENTS.len();
    let count = SymTensor::<2>::COMPONENTS.len();
    (stress.len() < in_space).then(|| SymTensor::from_components(&stress[..count]))
}

/// Unit vector (x, y, z) along the largest principal stress of a stress with these components.
pub fn direction_of_largest(stress: &[f64]) -> Vec<f64> {
    match in_plane(stress) {
        Some(stress) => {
            let [x, y] = stress.principal_direction();
            vec![x, y, 0.0]
        }
        None => SymTensor::<3>::from_components(stress)
            .principal_direction()
            .to_vec(),
    }
}
