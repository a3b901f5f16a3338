//! Lumped masses of the points.

use crate::cloud::PointCloud;

/// Masses and rotational inertias of the points.
#[derive(Debug, Clone, PartialEq)]
pub struct LumpedMass {
    /// Mass M_i = rho_i V_i, with the volume-weighted mean density where materials meet, shape (n_points), kg.
    pub mass: Vec<f64>,
    /// Rotational inertia J_i = M_i r_i with the squared radius of gyration r_i, shape (n_points), kg m^2.
    pub inertia: Vec<f64>,
}

impl LumpedMass {
    /// Masses from the densities of the materials (n_materials), kg/m^3 (MPPD eq. 66).
    pub fn new<const D: usize>(cloud: &PointCloud<D>, densities: &[f64]) -> Self {
        let mass: Vec<f64> = (0..cloud.len())
            .map(|point| cloud.mean_property(point, densities) * cloud.volumes[point])
            .collect();
        let inertia = (mass.iter().enumerate())
            .map(|(point, mass)| mass * cloud.squared_gyration(point as u32))
            .collect();
        Self { mass, inertia }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A cube of side a has M a^2/6 about any axis through its middle; on a lattice of cubes both rules are the same.
    #[test]
    fn a_point_turns_like_a_cube() {
        let cloud = PointCloud::<3>::from_points(
            &[[0.0; 3], [2.0, 0.0, 0.0]],
            &[8.0, 1.0],
            1.0,
            &[0, 0],
            1,
        );
        let mass = LumpedMass::new(&cloud, &[3.0]);
        assert_eq!(mass.mass, [24.0, 3.0]);
        let expected = [24.0 * 4.0 / 6.0, 3.0 / 6.0];
        let close = |(one, other): (&f64, f64)| (one / other - 1.0).abs() < 1e-15;
        assert!(mass.inertia.iter().zip(expected).all(close));
        let lattice = PointCloud {
            lattice_cell: Some([2.0; 3]),
            ..cloud
        };
        let of_lattice = LumpedMass::new(&lattice, &[3.0]).inertia[0];
        assert!((of_lattice / expected[0] - 1.0).abs() < 1e-15);
    }
}
