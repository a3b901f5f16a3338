//! Strains and stresses of points as arrays of components.

use ligament_analysis::{LoadProgram, State};
use ligament_model::deformation::Deformations;
use ligament_model::interface::StressReading;
use ligament_model::stress::carried::StrainReading;
use ligament_model::stress::point_strain::Motion;
use ligament_model::tensor::SymTensor;
use ligament_model::thermal::StressFreeStrains;
use ligament_model::{Bonds, UnbrokenBonds};

/// Stresses of all points in a reading, shape (n_points, N), Pa.
pub fn of_reading<const N: usize>(
    reading: StressReading,
    system: &dyn Bonds,
    bonds: UnbrokenBonds<'_>,
    deformations: &Deformations,
) -> Vec<[f64; N]> {
    let stresses = system.stresses(reading, bonds, deformations);
    stresses.values.as_chunks().0.to_vec()
}

/// Effective stresses (xx, yy, xy) of all points by the laws of their materials, in a state under loads, Pa.
pub fn by_material(system: &dyn Bonds, state: &State, loads: &dyn LoadProgram) -> Vec<[f64; 3]> {
    let stresses = system.stresses_by_material(StrainReading::Effective(Motion {
        intact: &state.softening.sound(&state.intact),
        displacement: &state.displacement,
        expansion: loads.thermal_strain(state.load_factor),
    }));
    stresses.values.as_chunks().0.to_vec()
}

/// Strains (eps_xx, eps_yy, gamma_xy) of all points that they would have without stress, shape (n_points, 3).
pub fn free(strains: &StressFreeStrains) -> Vec<[f64; 3]> {
    let of_point = |strain: &SymTensor<3>| {
        let plane = strain.resized::<2>();
        let mut strains = plane.engineering();
        std::array::from_fn(|_| strains.next().unwrap())
    };
    strains.of_points().iter().map(of_point).collect()
}
