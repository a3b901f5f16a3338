//! Deformations, internal forces and energies of the bonds.

use ligament_model::BondSystem;
use ligament_model::element::beam::{BondDeformation, BondResponse};
use rayon::prelude::*;

use crate::unknowns::COMPONENTS;

/// Bonds, or points, of one task; fixed for the points, so that the order of summation is fixed too.
const BLOCK: usize = 2048;

/// What a sweep over all bonds gives.
#[derive(Debug, Clone, PartialEq)]
pub struct BondSweep {
    /// Deformation of every bond, broken or not, shape (n_bonds).
    pub deformations: Vec<BondDeformation>,
    /// Internal forces of the intact bonds.
    pub internal: InternalForces,
    /// Energy stored in the intact bonds, J (the E of NHPD's convergence rule, eq. 21).
    pub stored_energy: f64,
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

/// Deformations, forces and energy: once over the bonds, and once over the points to gather the forces.
///
/// The forces at a point are added by one thread over its bonds in their order, so that nothing depends on the number of
/// threads.
pub fn sweep(system: &BondSystem, intact: &[bool], displacement: &[f64]) -> BondSweep {
    let (mut deformations, mut responses) = (Vec::new(), Vec::new());
    (0..system.bonds.len())
        .into_par_iter()
        .with_min_len(BLOCK)
        .map(|bond| {
            let deformation = system.deformation(bond, displacement);
            let response = if intact[bond] {
                system.element(bond).response(&deformation)
            } else {
                BondResponse::default()
            };
            (deformation, response)
        })
        .unzip_into_vecs(&mut deformations, &mut responses);
    let mut values = vec![0.0; COMPONENTS * system.cloud.len()];
    let sums: Vec<Gathered> = values
        .par_chunks_mut(COMPONENTS * BLOCK)
        .enumerate()
        .map(|(block, values)| gather(system, &responses, BLOCK * block, values))
        .collect();
    let largest = |component: usize| {
        sums.iter()
            .map(|block| block.largest[component])
            .fold(0.0, f64::max)
    };
    BondSweep {
        internal: InternalForces {
            force_scale: largest(0).max(largest(1)),
            moment_scale: largest(2),
            values,
        },
        stored_energy: sums.iter().map(|block| block.energy).sum(),
        deformations,
    }
}

/// What a block of points gives besides its forces.
#[derive(Default)]
struct Gathered {
    /// Energy of the bonds whose first ends are in the block.
    energy: f64,
    /// Largest sum of the sizes of the forces at a point, for each component.
    largest: [f64; COMPONENTS],
}

/// Adds up the forces of the bonds at the points from `first_point` on.
fn gather(
    system: &BondSystem,
    responses: &[BondResponse],
    first_point: usize,
    values: &mut [f64],
) -> Gathered {
    let mut gathered = Gathered::default();
    for (index, sum) in values.chunks_exact_mut(COMPONENTS).enumerate() {
        let point = (first_point + index) as u32;
        let mut size = [0.0; COMPONENTS];
        for &bond in system.bonds.incidence.of(point) {
            let response = &responses[bond as usize];
            let end = usize::from(system.bonds.ends[bond as usize][1] == point);
            if end == 0 {
                gathered.energy += response.energy;
            }
            let force = response.at_end(end);
            for component in 0..COMPONENTS {
                sum[component] += force[component];
                size[component] += force[component].abs();
            }
        }
        gathered.largest =
            [0, 1, 2].map(|component| gathered.largest[component].max(size[component]));
    }
    gathered
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
