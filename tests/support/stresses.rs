//! Strains and stresses of points as arrays of components.

use ligament_model::deformation::Deformations;
use ligament_model::interface::StressReading;
use ligament_model::thermal::FreeStrains;
use ligament_model::{Bonds, BondsLeft};

/// Virial stresses of all points, shape (n_points, N), Pa.
pub fn virial<const N: usize>(
    system: &dyn Bonds,
    bonds: BondsLeft<'_>,
    deformations: &Deformations,
) -> Vec<[f64; N]> {
    let stresses = system.stresses(StressReading::Virial, bonds, deformations);
    stresses.values.as_chunks().0.to_vec()
}

/// Tractions of all points, shape (n_points, N), Pa.
pub fn tractions<const N: usize>(
    system: &dyn Bonds,
    bonds: BondsLeft<'_>,
    deformations: &Deformations,
) -> Vec<[f64; N]> {
    let stresses = system.stresses(StressReading::Traction, bonds, deformations);
    stresses.values.as_chunks().0.to_vec()
}

/// Strains (eps_xx, eps_yy, gamma_xy) of all points that they would have without stress, shape (n_points, 3).
pub fn free(strains: &FreeStrains) -> Vec<[f64; 3]> {
    let of_points = strains.of_points().iter();
    let engineering = of_points.map(|it| it.resized::<2>().engineering().collect::<Vec<f64>>());
    engineering.map(|it| [it[0], it[1], it[2]]).collect()
}
