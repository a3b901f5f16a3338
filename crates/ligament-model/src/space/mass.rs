//! Lumped masses of points in space.

use crate::cloud::PointCloud;
use crate::mass::LumpedMass;

impl LumpedMass {
    /// Masses in space from the densities of the materials (n_materials), kg/m^3.
    ///
    /// The rotational inertia J_i = M_i r_i is that of the cell of a point, in the mean over the axes: of a cube of the point's volume on a
    /// mesh, with the squared radius of gyration r_i = V_i^(2/3)/6, and (dx^2 + dy^2 + dz^2)/18 on a lattice.
    pub fn in_space(cloud: &PointCloud<3>, densities: &[f64]) -> Self {
        let mass: Vec<f64> = (0..cloud.len())
            .map(|point| cloud.mean_property(point, densities) * cloud.volumes[point])
            .collect();
        let squared_gyration = |point: usize| match cloud.lattice_cell {
            Some(sides) => sides.iter().map(|side| side * side).sum::<f64>() / 18.0,
            None => cloud.volumes[point].powf(2.0 / 3.0) / 6.0,
        };
        let inertia = (mass.iter().enumerate())
            .map(|(point, mass)| mass * squared_gyration(point))
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
        let mass = LumpedMass::in_space(&cloud, &[3.0]);
        assert_eq!(mass.mass, [24.0, 3.0]);
        let expected = [24.0 * 4.0 / 6.0, 3.0 / 6.0];
        let close = |(one, other): (&f64, f64)| (one / other - 1.0).abs() < 1e-15;
        assert!(mass.inertia.iter().zip(expected).all(close));
        let lattice = PointCloud {
            lattice_cell: Some([2.0; 3]),
            ..cloud
        };
        let of_lattice = LumpedMass::in_space(&lattice, &[3.0]).inertia[0];
        assert!((of_lattice / expected[0] - 1.0).abs() < 1e-15);
    }
}
