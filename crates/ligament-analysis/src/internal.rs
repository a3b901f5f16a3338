//! Deformations, internal forces and energies of the bonds.

use ligament_model::element::beam::BondDeformation;
use ligament_model::{BondSystem, ordered_sum};
use rayon::prelude::*;

use crate::unknowns::COMPONENTS;

/// Deformation of every bond, broken or not, shape (n_bonds).
pub fn deformations(system: &BondSystem, displacement: &[f64]) -> Vec<BondDeformation> {
    (0..system.bonds.len())
        .into_par_iter()
        .map(|bond| system.deformation(bond, displacement))
        .collect()
}

/// Internal forces and the sizes that their residual is compared with.
#[derive(Debug, Clone, PartialEq)]
pub struct InternalForces {
    /// Sum of the bonds' end forces K u at each degree of freedom, shape (3 n_points), N and N m.
    pub values: Vec<f64>,
    /// Largest sum of |end forces| that meet at a point along one axis, N.
    pub force_scale: f64,
    /// Largest sum of |end moments| that meet at a point, N m.
    pub moment_scale: f64,
}

/// Internal forces of the intact bonds: gathered at each point over its bonds in their order.
pub fn internal_forces(
    system: &BondSystem,
    intact: &[bool],
    deformations: &[BondDeformation],
) -> InternalForces {
    let of_points: Vec<([f64; COMPONENTS], [f64; COMPONENTS])> = (0..system.cloud.len() as u32)
        .into_par_iter()
        .map(|point| {
            let mut sum = [0.0; COMPONENTS];
            let mut size = [0.0; COMPONENTS];
            for &bond in system.bonds.incidence.of(point) {
                let bond = bond as usize;
                if intact[bond] {
                    let end = usize::from(system.bonds.ends[bond][1] == point);
                    let force = system.element(bond).end_forces(&deformations[bond])[end];
                    for component in 0..COMPONENTS {
                        sum[component] += force[component];
                        size[component] += force[component].abs();
                    }
                }
            }
            (sum, size)
        })
        .collect();
    let largest = |component: usize| {
        of_points
            .iter()
            .map(|(_, size)| size[component])
            .fold(0.0, f64::max)
    };
    InternalForces {
        force_scale: largest(0).max(largest(1)),
        moment_scale: largest(2),
        values: of_points.iter().flat_map(|(sum, _)| *sum).collect(),
    }
}

/// Energy stored in the intact bonds, J (the E of NHPD's convergence rule, eq. 21).
pub fn stored_energy(
    system: &BondSystem,
    intact: &[bool],
    deformations: &[BondDeformation],
) -> f64 {
    ordered_sum(system.bonds.len(), |bond| {
        if intact[bond] {
            system.element(bond).energy(&deformations[bond])
        } else {
            0.0
        }
    })
}

/// Largest |external - internal force| over the given degrees of freedom, relative to the forces that meet at a point.
pub fn relative_residual(
    residual: &[f64],
    degrees_of_freedom: &[u32],
    internal: &InternalForces,
) -> f64 {
    let largest = |rotational: bool| {
        residual
            .iter()
            .zip(degrees_of_freedom)
            .filter(|&(_, &dof)| (dof as usize % COMPONENTS == COMPONENTS - 1) == rotational)
            // `f64::max` would pass over a NaN, and with it over a failed solve.
            .map(|(value, _)| {
                if value.is_nan() {
                    f64::INFINITY
                } else {
                    value.abs()
                }
            })
            .fold(0.0, f64::max)
    };
    let relative = |value: f64, scale: f64| if value == 0.0 { 0.0 } else { value / scale };
    relative(largest(false), internal.force_scale)
        .max(relative(largest(true), internal.moment_scale))
}
