//! Principal and equivalent stresses of a point, and the stresses around a bond at which it begins to soften.

use super::point_strain::{Motion, StrainAround, mean_strain};
use crate::element::BondDeformation;
use crate::failure::hooke::Moduli;
use crate::failure::starting::{SHARE, Starting, Surface};
use crate::layout::Layout;
use crate::parallel;
use crate::system::BondSystem;
use crate::tensor::{SymTensor, dot, minus};

impl<const D: usize> BondSystem<D> {
    /// Stress around each bond over the strength at which it begins to soften, shape (n_bonds); 0 where tension pulls the bond across by less
    /// than [`SHARE`] of it.
    ///
    /// The strain is that of the ends, with what the bond itself has in the place of theirs along it: its stretch, and for tension, where points have
    /// rotations, also its shear deformation, g = s n + gamma,
    ///
    /// eps = eps_m + d (x) n + n (x) d - (n . d) n (x) n, d = g - eps_m n, sigma_i = 2 mu eps_i + lambda tr(eps),
    ///
    /// so that eps n = g; where neither end has a strain sigma_1 = E s of a bar. Where a crack opens, bonds at an angle to it are sheared more than
    /// the points around them: with the shear of the points such bonds begin later than bonds across it, at up to twice the deformation, and a
    /// notched beam carries too much (docs/decisions.md). Under pressure the shear of single bonds scatters by more than the strains of their ends.
    pub(crate) fn utilisations(
        &self,
        layout: Layout,
        motion: Motion<'_>,
        deformations: &[BondDeformation],
        starting: &Starting,
    ) -> Vec<f64> {
        let of_points = self.point_strains(layout, motion);
        let of_cells = self.cell_stresses(layout, motion);
        let of_bond = |bond: usize| {
            let deformation = &deformations[bond];
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
            let of_cells = of_cells.mean_at_ends(self.bonds.ends[bond]) / moduli.along;
            let principal = |slope: [f64; D]| {
                let more = stretch - dot(n, slope);
                let own = std::array::from_fn(|axis| slope[axis] + more * n[axis]);
                principal(&with_own(&mean, own, n), moduli).map(|it| it + of_cells)
            };
            match &starting.surface {
                Surface::Tension => {
                    let around = StrainAround::new(&mean, n);
                    let normal = moduli.stress_across(stretch, Some(around)).normal + of_cells;
                    if normal <= 0.0 {
                        return 0.0;
                    }
                    let [largest, _] = principal(self.own_slope(layout, motion, bond, &mean));
                    match normal >= SHARE * largest {
                        true => largest / strength,
                        false => 0.0,
                    }
                }
                Surface::Shear { slope } => {
                    let slope = slope[bond];
                    let [largest, smallest] = principal(mean.times(n));
                    let (mean, radius) = (0.5 * (largest + smallest), 0.5 * (largest - smallest));
                    let worst = radius * slope.hypot(1.0) + mean * slope;
                    (worst / strength).max(0.0)
                }
            }
        };
        parallel::values(deformations.len(), 0.0, of_bond)
    }

    /// Slope of a bond: the mean slope at its ends, or without rotations the slope by the strain of its ends.
    fn own_slope(
        &self,
        layout: Layout,
        motion: Motion<'_>,
        bond: usize,
        mean: &SymTensor<D>,
    ) -> [f64; D] {
        if !layout.components.iter().any(|it| it.is_rotation()) {
            return mean.times(self.bonds.direction[bond]);
        }
        let [a, b] = self.slopes_of(layout, motion.displacement, bond);
        std::array::from_fn(|axis| 0.5 * (a[axis] + b[axis]))
    }
}

/// The mean strain of the ends of a bond, changed so that eps n = g for the direction n and the slope g of the bond.
fn with_own<const D: usize>(mean: &SymTensor<D>, own: [f64; D], n: [f64; D]) -> SymTensor<D> {
    let less = minus(own, mean.times(n));
    let along = dot(n, less);
    SymTensor::from_fn(|row, column| {
        let across = less[row] * n[column] + n[row] * less[column];
        mean.at(row, column) + across - along * n[row] * n[column]
    })
}

/// The largest and the smallest principal stress of a strain over E'.
fn principal<const D: usize>(strain: &SymTensor<D>, moduli: &Moduli) -> [f64; 2] {
    let trace = strain.trace();
    let values = strain.principal_values();
    [values[0], values[D - 1]].map(|it| moduli.shear * it + moduli.lateral * trace)
}

/// Principal values of a stress given by components, the largest first: two in the plane, three in space.
pub fn values(stress: &[f64]) -> Vec<f64> {
    match in_plane(stress) {
        Some(stress) => stress.principal_values().to_vec(),
        None => SymTensor::<3>::from_components(stress)
            .principal_values()
            .to_vec(),
    }
}

/// Stress in the plane from its components, with or without the one across it; None for components in space.
fn in_plane(stress: &[f64]) -> Option<SymTensor<2>> {
    let in_space = SymTensor::<3>::COMPONENTS.len();
    let count = SymTensor::<2>::COMPONENTS.len();
    (stress.len() < in_space).then(|| SymTensor::from_components(&stress[..count]))
}

/// Unit vector (x, y, z) along the largest principal stress, for a stress given by components.
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

/// Equivalent stress of von Mises (1913), Pa, of a stress with these components, in the plane with the stress across it, by the principal values:
///
/// sigma_v = sqrt(((sigma_1 - sigma_2)^2 + (sigma_2 - sigma_3)^2 + (sigma_3 - sigma_1)^2)/2).
pub fn von_mises(stress: &[f64]) -> Vec<f64> {
    let [one, two, three] = in_space(stress);
    let squares = [one - two, two - three, three - one].map(|it| it * it);
    vec![(0.5 * squares.iter().sum::<f64>()).sqrt()]
}

/// Equivalent stress of Tresca (1864), Pa, of a stress with these components, in the plane with the stress across it: twice the largest shear stress,
/// sigma_1 - sigma_3.
pub fn tresca(stress: &[f64]) -> Vec<f64> {
    let [largest, _, least] = in_space(stress);
    vec![largest - least]
}

/// The three principal values, the largest first; NaN if a component is NaN.
fn in_space(stress: &[f64]) -> [f64; 3] {
    match stress.iter().any(|it| it.is_nan()) {
        true => [f64::NAN; 3],
        false => SymTensor::<3>::from_first_components(stress).principal_values(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Textbook states of stress, Pa: a bar, a plane in pure shear (tau sqrt 3 and 2 tau), pressure from all sides (none), plane strain of an
    /// incompressible material (sigma_zz is the mean of the others), and an axle with sigma = 80, tau = 30 (sqrt(80^2 + 3 30^2), sqrt(80^2 + 4
    /// 30^2)).
    #[test]
    fn equivalent_stresses_are_those_of_textbooks() {
        let cases: [(&[f64], [f64; 2]); 6] = [
            (&[-100.0, 0.0, 0.0, 0.0], [100.0, 100.0]),
            (&[0.0, 0.0, 40.0, 0.0], [40.0 * 3.0_f64.sqrt(), 80.0]),
            (&[-7.0, -7.0, 0.0, -7.0, 0.0, 0.0], [0.0, 0.0]),
            (&[100.0, 0.0, 0.0, 50.0], [50.0 * 3.0_f64.sqrt(), 100.0]),
            (
                &[0.0, 0.0, 0.0, 80.0, 0.0, 30.0],
                [9100.0_f64.sqrt(), 100.0],
            ),
            (&[80.0, 0.0, 30.0, 0.0], [9100.0_f64.sqrt(), 100.0]),
        ];
        for (stress, expected) in cases {
            let found = [von_mises(stress)[0], tresca(stress)[0]];
            for (found, expected) in found.into_iter().zip(expected) {
                assert!(
                    (found - expected).abs() < 1e-12,
                    "{stress:?}: {found} {expected}"
                );
            }
        }
        assert!(von_mises(&[1.0, 2.0, 3.0, f64::NAN])[0].is_nan());
    }
}
