//! Strains and stresses of points as arrays of components.

use ligament_analysis::{LoadProgram, State};
use ligament_model::deformation::Deformations;
use ligament_model::interface::{StressReading, Stresses};
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
    let stresses = all_by_material(system, state, loads);
    let of_points = stresses.values.chunks_exact(stresses.names.len());
    of_points.map(|it| [it[0], it[1], it[2]]).collect()
}

/// Effective stresses zz of all points across the plane, of isotropic materials in plane strain, Pa.
pub fn across_plane(system: &dyn Bonds, state: &State, loads: &dyn LoadProgram) -> Vec<f64> {
    let stresses = all_by_material(system, state, loads);
    assert_eq!(stresses.names, ["xx", "yy", "xy", "zz"]);
    let of_points = stresses.values.as_chunks::<4>().0.iter();
    of_points.map(|[.., zz]| *zz).collect()
}

fn all_by_material(system: &dyn Bonds, state: &State, loads: &dyn LoadProgram) -> Stresses {
    system.stresses_by_material(StrainReading::Effective(Motion {
        intact: &state.softening.sound(&state.intact),
        displacement: &state.displacement,
        expansion: loads.thermal_strain(state.load_factor),
    }))
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
