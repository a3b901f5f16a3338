//! Deformations, internal forces and energies of the bonds.

use std::ops::Range;

use rayon::prelude::*;

use crate::cloud::PointCloud;
use crate::deformation::{Deformation, Deformations};
use crate::element::{DeformationOf, Element, Elements};
use crate::layout::Component;
use crate::subdomain::{Share, Subdomain, Whole};
use crate::system::{ElementSystem, UnbrokenBonds};
use crate::thermal::ThermalStrain;

/// Number of parts into which the bonds are divided for the sum of their forces; fixed, so that the order of summation is fixed. Each part
/// has forces of its own at all points, so more parts cost memory.
const PARTS: usize = 4;

/// Number of bonds that make a task worth while.
const TASK: usize = 2048;

/// Results of a sweep over all bonds.
#[derive(Debug, Clone, PartialEq)]
pub struct BondSweep {
    /// Deformation of every bond less its thermal deformation, broken or not, shape (n_bonds).
    pub deformations: Deformations,
    /// Internal forces of the intact bonds.
    pub internal: InternalForces,
    /// Sum of the absolute end forces at each degree of freedom, shape (n_degrees_of_freedom), N and N m; at owned points.
    pub sizes: Vec<f64>,
    /// Energy stored in the intact bonds, J (the E of NHPD's convergence rule, eq. 21).
    pub stored_energy: f64,
    /// Energy that the intact bonds would store with their thermal deformation at load factor 1, J.
    pub expansion_energy: f64,
}

impl BondSweep {
    /// Energy 1/2 u^T K u of the motions of the points alone at a load factor lambda, J: with the deformations beyond the expansion, B u -
    /// lambda e, the stored energy is 1/2 (B u - lambda e) C (B u - lambda e).
    ///
    /// This energy is positive for a stable body. The stored energy need not be: where bonds have negative stiffnesses, incompatible
    /// expansions may store negative energy.
    pub fn energy_of_motion(&self, load_factor: f64) -> f64 {
        self.stored_energy
            + load_factor * (load_factor * self.expansion_energy - self.internal.thermal)
    }
}

/// Internal forces and the scales of their residual.
#[derive(Debug, Clone, PartialEq)]
pub struct InternalForces {
    /// Sum of the end forces K u of the bonds at each degree of freedom, shape (n_degrees_of_freedom), N and N m; at owned points where the
    /// body is divided between processes.
    pub values: Vec<f64>,
    /// Largest sum of absolute end forces at a point along one axis, N.
    pub force_scale: f64,
    /// Largest sum of absolute end moments at a point, N m.
    pub moment_scale: f64,
    /// Work -sum over the bonds of force . thermal deformation at load factor 1, J: the rate at which a growing expansion does work.
    pub thermal: f64,
}

impl<const D: usize, const M: usize, E: Elements<D, M>> ElementSystem<D, M, E> {
    /// Deformation of every bond less its thermal deformation, broken or not, shape (n_bonds).
    pub(crate) fn deformations(
        &self,
        intact: &[bool],
        displacement: &[f64],
        expansion: ThermalStrain<'_>,
    ) -> Deformations {
        assert_eq!(displacement.len(), M * self.system.cloud.len());
        let ends = &self.system.bonds.ends;
        let of_task = |(task, deformations): (usize, &mut [DeformationOf<D, M, E>])| {
            for (bond, deformation) in (task * TASK..).zip(deformations) {
                let element = self.whole(intact, bond);
                *deformation = element.deformation(displacement);
                if !expansion.is_none() {
                    let thermal = expansion.of_bond(ends[bond]);
                    *deformation = deformation.less(&element.deformation_in(&thermal));
                }
            }
        };
        // Written in place: a closure that returns a deformation to be collected would be called bond by bond, which costs more.
        Deformation::written(&self.system.room, ends.len(), |all| {
            all.par_chunks_mut(TASK).enumerate().for_each(of_task);
        })
    }

    /// Forces and energy of bonds with given deformations (n_bonds).
    /// The result does not depend on the number of threads: the bonds of a part are summed by one thread in their order, and the parts one
    /// after another.
    pub(crate) fn forces(
        &self,
        bonds: UnbrokenBonds<'_>,
        deformations: Deformations,
        expansion: ThermalStrain<'_>,
    ) -> BondSweep {
        let n_bonds = deformations.len();
        let subdomain = &self.system.cloud.subdomain;
        let of_bonds: &[DeformationOf<D, M, E>] = Deformation::of_bonds(&deformations);
        let made = |number: usize| {
            let of_part = || number * n_bonds / PARTS..(number + 1) * n_bonds / PARTS;
            let mut part = match subdomain.is_whole() {
                true => Part::of_bonds(self, Whole, bonds, of_bonds, of_part()),
                false => Part::of_bonds(self, subdomain, bonds, of_bonds, of_part()),
            };
            if !expansion.is_none() {
                part.add_expansion(self, bonds, of_bonds, expansion, of_part());
            }
            part
        };
        let parts: Vec<Part<M>> = (0..PARTS).into_par_iter().map(made).collect();
        BondSweep::of_parts(&parts, &E::COMPONENTS, deformations, subdomain)
    }
}

impl BondSweep {
    /// Sums the sweeps over the parts of the bonds, between points with given components, and over the processes.
    fn of_parts<const M: usize>(
        parts: &[Part<M>],
        components: &[Component; M],
        deformations: Deformations,
        subdomain: &Subdomain,
    ) -> Self {
        let sums: Vec<PointForces<M>> = (0..parts[0].forces.len())
            .into_par_iter()
            .with_min_len(TASK)
            .map(|point| {
                let of_parts = parts.iter().map(|part| part.forces[point]);
                of_parts.fold(PointForces::NONE, PointForces::plus)
            })
            .collect();
        let collected = |of_point: fn(&PointForces<M>) -> [f64; M]| {
            let of_points: Vec<[f64; M]> = sums.iter().map(of_point).collect();
            subdomain.from_owned(of_points)
        };
        let (values, sizes) = (
            collected(|forces| forces.sum),
            collected(|forces| forces.size),
        );
        let largest = |of_rotations: bool| {
            let places = (0..M).filter(|&place| components[place].is_rotation() == of_rotations);
            let sizes = places.flat_map(|place| sizes.iter().skip(place).step_by(M).copied());
            sizes.fold(0.0, f64::max)
        };
        let of_parts = |of: fn(&Part<M>) -> f64| parts.iter().map(of).sum();
        let mut scales = [largest(false), largest(true)];
        let mut over_bonds: [f64; 3] = [
            of_parts(|part| part.thermal),
            of_parts(|part| part.energy),
            of_parts(|part| part.expansion_energy),
        ];
        subdomain.all_reduce_sum(&mut over_bonds);
        subdomain.all_reduce_max(&mut scales);
        let [force_scale, moment_scale] = scales;
        let [thermal, stored_energy, expansion_energy] = over_bonds;
        Self {
            internal: InternalForces {
                force_scale,
                moment_scale,
                values,
                thermal,
            },
            sizes,
            stored_energy,
            expansion_energy,
            deformations,
        }
    }
}

/// Sums over the bonds of one part.
struct Part<const M: usize> {
    /// Forces at the owned points.
    forces: Vec<PointForces<M>>,
    energy: f64,
    thermal: f64,
    expansion_energy: f64,
}

/// Sum of the end forces at a point.
#[derive(Debug, Clone, Copy)]
struct PointForces<const M: usize> {
    sum: [f64; M],
    /// Sum of their absolute values.
    size: [f64; M],
}

impl<const M: usize> PointForces<M> {
    const NONE: Self = Self {
        sum: [0.0; M],
        size: [0.0; M],
    };

    #[inline]
    fn add(&mut self, end_force: [f64; M]) {
        for (component, value) in end_force.into_iter().enumerate() {
            self.sum[component] += value;
            self.size[component] += value.abs();
        }
    }

    fn plus(self, other: Self) -> Self {
        Self {
            sum: std::array::from_fn(|place| self.sum[place] + other.sum[place]),
            size: std::array::from_fn(|place| self.size[place] + other.size[place]),
        }
    }
}

impl<const M: usize> Part<M> {
    /// A part without bonds, for the owned points of a cloud.
    fn new<const D: usize>(cloud: &PointCloud<D>) -> Self {
        Self {
            forces: vec![PointForces::NONE; cloud.subdomain.owned().len()],
            energy: 0.0,
            thermal: 0.0,
            expansion_energy: 0.0,
        }
    }

    fn of_bonds<const D: usize, E: Elements<D, M>>(
        typed: &ElementSystem<D, M, E>,
        share: impl Share,
        bonds: UnbrokenBonds<'_>,
        deformations: &[DeformationOf<D, M, E>],
        of_part: Range<usize>,
    ) -> Self {
        let Self {
            mut forces,
            mut energy,
            ..
        } = Self::new(&typed.system.cloud);
        for bond in of_part {
            let Some(element) = typed.left(bonds, bond) else {
                continue;
            };
            let deformation = &deformations[bond];
            if share.owns_bond(typed.system.bonds.ends[bond]) {
                energy += element.mutual_energy(deformation, deformation);
            }
            element.forces(deformation, |point, force| {
                if let Some(row) = share.row(point) {
                    forces[row].add(force);
                }
            });
        }
        Self {
            forces,
            energy,
            thermal: 0.0,
            expansion_energy: 0.0,
        }
    }

    /// Adds the thermal work and energy of the bonds of the part.
    fn add_expansion<const D: usize, E: Elements<D, M>>(
        &mut self,
        typed: &ElementSystem<D, M, E>,
        bonds: UnbrokenBonds<'_>,
        deformations: &[DeformationOf<D, M, E>],
        expansion: ThermalStrain<'_>,
        of_part: Range<usize>,
    ) {
        let at_full_load = expansion.at_full_load();
        let subdomain = &typed.system.cloud.subdomain;
        for bond in of_part {
            let ends = typed.system.bonds.ends[bond];
            let element = typed
                .left(bonds, bond)
                .filter(|_| subdomain.owns_bond(ends));
            let Some(element) = element else {
                continue;
            };
            let thermal = element.deformation_in(&at_full_load.of_bond(ends));
            self.thermal -= 2.0 * element.mutual_energy(&deformations[bond], &thermal);
            self.expansion_energy += element.mutual_energy(&thermal, &thermal);
        }
    }
}
