//! Stiffness of bonds over their direction (OMPPD eqs 58, 59) under the law of a setup, and the stiffness of the continuum.

use ligament_model::bonds::star::star;
use ligament_model::{Elasticity, Horizons};

use crate::formulation::Formulation;
use crate::setup::{Calibration, Setup};

/// Stiffness of a bond, and of the continuum, in one direction.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct InDirection {
    /// Angle of the direction to the x axis, rad.
    pub angle: f64,
    /// Axial stiffness k_n, N/m^6.
    pub axial: f64,
    /// Shear stiffness k_t, N/m^6.
    pub shear: f64,
    /// Rotational stiffness k_theta, N/m^5.
    pub rotational: f64,
    /// Off-axis modulus C_xx of the continuum (OMPPD eq. 29), Pa.
    pub normal_modulus: f64,
    /// Off-axis modulus C_ss of the continuum (OMPPD eq. 30), Pa.
    pub shear_modulus: f64,
}

/// Stiffness of bonds of a material with a length (m) and a horizon (m) at some angles to the x axis (rad), by the integrals over a full
/// circle, without what the cells carry; None for bonds that have strains of their own and no such stiffness (`mbb-pd`).
pub fn over_direction(
    setup: &Setup,
    material: usize,
    [length, horizon]: [f64; 2],
    angles: &[f64],
) -> Option<Vec<InDirection>> {
    if setup.law.row.has_own_strains() {
        return None;
    }
    let elasticity = setup.materials[material].material.elasticity;
    let mut setup = setup.of_bonds().unwrap_or_else(|| setup.clone());
    if let Some(calibration) = &mut setup.law.options.calibration {
        *calibration = Calibration::Integral;
    }
    let of = (material, setup.materials.len());
    let (cloud, bonds) = star(angles, [length, horizon], setup.thickness(), of);
    let horizons = Horizons::unified(horizon, cloud.len());
    let formulation = Formulation::new(&setup, &cloud, &horizons, &[]);
    let stiffness = formulation.stiffness(&bonds, &vec![1.0; bonds.len()]);
    let in_direction = |(place, &angle): (usize, &f64)| {
        let [normal_modulus, shear_modulus] = off_axis_moduli(&setup, &elasticity, angle);
        InDirection {
            angle,
            axial: stiffness.axial[place],
            shear: stiffness.shear[place],
            rotational: stiffness.rotational[place],
            normal_modulus,
            shear_modulus,
        }
    };
    Some(angles.iter().enumerate().map(in_direction).collect())
}

/// Moduli C_xx and C_ss (Pa) of axes at an angle to x: the stresses under a unit strain along, and a unit shear between, the turned axes.
fn off_axis_moduli(setup: &Setup, elasticity: &Elasticity, angle: f64) -> [f64; 2] {
    let stiffness = elasticity.plane_stiffness(setup.plane());
    let (sin, cos) = angle.sin_cos();
    let stretch = [cos * cos, sin * sin, 2.0 * sin * cos];
    let shear = [-sin * cos, sin * cos, cos * cos - sin * sin];
    [stretch, shear].map(|strain| {
        let of_row = |i: usize| {
            (0..3)
                .map(|j| strain[i] * stiffness[(i, j)] * strain[j])
                .sum::<f64>()
        };
        (0..3).map(of_row).sum()
    })
}
