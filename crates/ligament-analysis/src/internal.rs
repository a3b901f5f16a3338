//! Deformations, internal forces and energies of the bonds.

use ligament_model::BondSystem;
use ligament_model::element::beam::BondDeformation;
use rayon::prelude::*;

use crate::unknowns::COMPONENTS;

/// Points whose bonds one task sweeps over; fixed, so that the order of summation is fixed too.
const BLOCK: usize = 256;

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

/// What one task of a sweep gives besides the deformations and forces.
#[derive(Clone, Copy, Default)]
struct BlockSums {
    energy: f64,
    size: [f64; COMPONENTS],
}

/// Deformations, forces and energy in one pass.
///
/// The forces at a point are gathered over its bonds in their order by one thread, so that every bond is looked at from
/// both its ends and nothing depends on the number of threads.
pub fn sweep(system: &BondSystem, intact: &[bool], displacement: &[f64]) -> BondSweep {
    let n_points = system.cloud.len();
    let mut deformations = vec![BondDeformation::default(); system.bonds.len()];
    let mut forces = vec![0.0; COMPONENTS * n_points];
    let mut sums = vec![BlockSums::default(); n_points.div_ceil(BLOCK)];
    blocks_of_first_ends(system, &mut deformations)
        .into_par_iter()
        .zip(forces.par_chunks_mut(COMPONENTS * BLOCK))
        .zip(&mut sums)
        .enumerate()
        .for_each(|(block, (((first_bond, deformations), forces), sums))| {
            for (index, force) in forces.chunks_exact_mut(COMPONENTS).enumerate() {
                let point = (BLOCK * block + index) as u32;
                let mut size = [0.0; COMPONENTS];
                for &bond in system.bonds.incidence.of(point) {
                    let bond = bond as usize;
                    let element = system.element(bond);
                    let deformation = system.deformation(bond, displacement);
                    let is_first_end = system.bonds.ends[bond][0] == point;
                    if is_first_end {
                        deformations[bond - first_bond] = deformation;
                    }
                    if !intact[bond] {
                        continue;
                    }
                    if is_first_end {
                        sums.energy += element.energy(&deformation);
                    }
                    let end_force = element.end_forces(&deformation)[usize::from(!is_first_end)];
                    for component in 0..COMPONENTS {
                        force[component] += end_force[component];
                        size[component] += end_force[component].abs();
                    }
                }
                sums.size = [0, 1, 2].map(|component| sums.size[component].max(size[component]));
            }
        });
    let largest = |component: usize| {
        sums.iter()
            .map(|block| block.size[component])
            .fold(0.0, f64::max)
    };
    BondSweep {
        internal: InternalForces {
            force_scale: largest(0).max(largest(1)),
            moment_scale: largest(2),
            values: forces,
        },
        stored_energy: sums.iter().map(|block| block.energy).sum(),
        deformations,
    }
}

/// The values over the bonds (n_bonds) in parts, one for the bonds whose first ends lie in a block of points, each with
/// the number of its first bond.
fn blocks_of_first_ends<'a, T>(
    system: &BondSystem,
    values: &'a mut [T],
) -> Vec<(usize, &'a mut [T])> {
    let mut rest = values;
    let mut taken = 0;
    (BLOCK..system.cloud.len() + BLOCK)
        .step_by(BLOCK)
        .map(|next_point| {
            let ends = &system.bonds.ends;
            let end = ends.partition_point(|ends| (ends[0] as usize) < next_point);
            let (block, others) = std::mem::take(&mut rest).split_at_mut(end - taken);
            let first_bond = taken;
            (rest, taken) = (others, end);
            (first_bond, block)
        })
        .collect()
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
