//! Plane waves in an elastic material.

use nalgebra::DMatrix;

use super::{Elasticity, Plane};
use crate::tensor::SymTensor;

/// Plane waves that travel along a direction n: the eigenvectors of the acoustic tensor Q_ik = C_ijkl n_j n_l, Pa (Christoffel's equation).
///
/// In an isotropic material one is longitudinal with rho c^2 = M (lambda + 2 mu; in plane stress E/(1 - nu^2)), the others are transverse with
/// rho c^2 = G.
#[derive(Debug, Clone, PartialEq)]
pub struct PlaneWaves<const D: usize> {
    /// Speeds c, fastest first, m/s.
    pub speeds: [f64; D],
    /// Directions of motion, of unit length, shape (n_waves, n_dimensions).
    pub polarisations: [[f64; D]; D],
    density: f64,
}

impl<const D: usize> PlaneWaves<D> {
    /// Waves along a direction of unit length in a material with a density, kg/m^3; `None` in space for a material that is given in the plane
    /// only.
    pub fn new(
        elasticity: &Elasticity,
        plane: Plane,
        density: f64,
        direction: [f64; D],
    ) -> Option<Self> {
        let stiffness = elasticity.stiffness::<D>(plane)?;
        let places = SymTensor::<D>::COMPONENTS;
        let place = |i: usize, j: usize| {
            let is_same = |it: &[usize; 2]| *it == [i, j] || *it == [j, i];
            places.iter().position(is_same)
        };
        let tensor = DMatrix::from_fn(D, D, |i, k| {
            let mut sum = 0.0;
            for (j, along_j) in direction.iter().enumerate() {
                for (l, along_l) in direction.iter().enumerate() {
                    if let (Some(row), Some(column)) = (place(i, j), place(k, l)) {
                        sum += stiffness[(row, column)] * along_j * along_l;
                    }
                }
            }
            sum
        });
        let eigen = tensor.symmetric_eigen();
        let mut order: [usize; D] = std::array::from_fn(|it| it);
        order.sort_by(|a, b| eigen.eigenvalues[*b].total_cmp(&eigen.eigenvalues[*a]));
        Some(Self {
            speeds: order.map(|it| (eigen.eigenvalues[it] / density).sqrt()),
            polarisations: order
                .map(|it| std::array::from_fn(|axis| eigen.eigenvectors[(axis, it)])),
            density,
        })
    }

    /// Impedance rho sum_k c_k p_k p_k^T over the waves, Pa s/m: the traction on a plane across the direction is minus the impedance times the
    /// velocity of a wave that passes (Lysmer and Kuhlemeyer 1969).
    pub fn impedance(&self) -> [[f64; D]; D] {
        let waves = || self.speeds.iter().zip(&self.polarisations);
        let entry = |i: usize, j: usize| {
            let terms = waves().map(|(speed, along)| self.density * speed * along[i] * along[j]);
            terms.sum()
        };
        std::array::from_fn(|i| std::array::from_fn(|j| entry(i, j)))
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]
mod tests {
    use super::*;
    use crate::material::{Isotropic, Orthotropic};

    const STEEL: Isotropic = Isotropic {
        young: 210e9,
        poisson: 0.25,
    };
    const DENSITY: f64 = 7850.0;

    fn assert_close<const N: usize>(found: [f64; N], expected: [f64; N]) {
        let scale = expected.iter().fold(0.0f64, |most, it| most.max(it.abs()));
        let close = |(a, b): (f64, f64)| (a - b).abs() < 1e-12 * scale;
        assert!(
            found.into_iter().zip(expected).all(close),
            "{found:?} {expected:?}"
        );
    }

    /// lambda = mu = E/2.5 for nu = 1/4: M is 3 mu in space and in plane strain, E/(1 - nu^2) in plane stress.
    #[test]
    fn an_isotropic_material_has_a_longitudinal_wave_and_shear_waves() {
        let shear = STEEL.young / 2.5;
        let speed = |modulus: f64| (modulus / DENSITY).sqrt();
        let slanted = [0.6, 0.8];
        for (plane, modulus) in [
            (Plane::Stress, STEEL.young / (1.0 - 0.0625)),
            (Plane::Strain, 3.0 * shear),
        ] {
            let waves = PlaneWaves::new(&STEEL.into(), plane, DENSITY, slanted).unwrap();
            assert_close(waves.speeds, [modulus, shear].map(speed));
            let [longitudinal, _] = waves.polarisations;
            assert_close(
                [longitudinal[0] * 0.8 - longitudinal[1] * 0.6, 1.0],
                [0.0, 1.0],
            );
        }
        let direction = [2.0 / 3.0, -1.0 / 3.0, 2.0 / 3.0];
        let waves = PlaneWaves::new(&STEEL.into(), Plane::Strain, DENSITY, direction).unwrap();
        assert_close(waves.speeds, [3.0 * shear, shear, shear].map(speed));
        let impedance = waves.impedance();
        for (i, row) in impedance.into_iter().enumerate() {
            let expected = std::array::from_fn(|j| {
                let along = direction[i] * direction[j];
                let across = if i == j { 1.0 } else { 0.0 } - along;
                DENSITY * (waves.speeds[0] * along + waves.speeds[1] * across)
            });
            assert_close(row, expected);
        }
    }

    /// Along its axes an orthotropic sheet in plane stress has rho c^2 = E_1/(1 - nu_12^2 E_2/E_1), or with 2 in the place of 1, and G_12.
    #[test]
    fn an_orthotropic_material_has_speeds_of_its_axes() {
        let sheet = Elasticity::Orthotropic(Orthotropic {
            young: [40e9, 10e9],
            poisson: 0.2,
            shear_modulus: 5e9,
            out_of_plane: None,
            angle: 0.0,
        });
        let coupling = 1.0 - 0.04 * 0.25;
        for (direction, young) in [([1.0, 0.0], 40e9), ([0.0, 1.0], 10e9)] {
            let waves = PlaneWaves::new(&sheet, Plane::Stress, 1600.0, direction).unwrap();
            let expected = [young / coupling, 5e9].map(|it: f64| (it / 1600.0).sqrt());
            assert_close(waves.speeds, expected);
        }
    }
}
