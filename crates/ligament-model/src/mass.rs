//! Lumped masses of the points.

use crate::cloud::PointCloud;

/// Masses and rotational inertias of the points.
#[derive(Debug, Clone, PartialEq)]
pub struct LumpedMass {
    /// Mass M_i = rho_i V_i, with the mean density by volume where materials meet, shape (n_points), kg.
    pub mass: Vec<f64>,
    /// Rotational inertia J_i = M_i r_i with the squared radius of gyration r_i, shape (n_points), kg m^2.
    pub inertia: Vec<f64>,
}

impl LumpedMass {
    /// Masses from the densities of the materials (n_materials), kg/m^3 (MPPD eq. 66).
    pub fn new(cloud: &PointCloud, densities: &[f64]) -> Self {
        let mass: Vec<f64> = (0..cloud.len())
            .map(|point| cloud.mean_property(point, densities) * cloud.volumes[point])
            .collect();
        let inertia = (mass.iter().enumerate())
            .map(|(point, mass)| mass * cloud.squared_gyration(point as u32))
            .collect();
        Self { mass, inertia }
    }
}
