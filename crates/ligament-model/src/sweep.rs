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

/// Parts into which the bonds are divided when their forces are added up; fixed, so that the order of summation is fixed
/// too. Each part adds to forces of its own at all points, so more parts cost memory.
const PARTS: usize = 4;

/// Bonds that make a task worth while.
const TASK: usize = 2048;

/// What a sweep over all bonds gives.
#[derive(Debug, Clone, PartialEq)]
pub struct BondSweep {
    /// Deformation of every bond without what its temperature gives it, broken or not, shape (n_bonds).
    pub deformations: Deformations,
    /// Internal forces of the intact bonds.
    pub internal: InternalForces,
    /// Sum of the sizes of the end forces that meet at each degree of freedom, shape (n_degrees_of_freedom), N and N m; of own points.
    pub sizes: Vec<f64>,
    /// Energy stored in the intact bonds, J (the E of NHPD's convergence rule, eq. 21).
    pub stored_energy: f64,
    /// What they would store if what the temperature gives them at load factor 1 were their deformation, J.
    pub expansion_energy: f64,
}

impl BondSweep {
    /// Energy 1/2 u^T K u that the motions of the points alone would store at a load factor lambda, J: with the deformations
    /// beyond the expansion, B u - lambda e, the stored energy is 1/2 (B u - lambda e) C (B u - lambda e).
    ///
    /// A stable body has a positive one. Its stored energy need not be: where bonds have negative stiffnesses, expansions that
    /// do not fit together may store less than nothing.
    pub fn energy_of_motion(&self, load_factor: f64) -> f64 {
        self.stored_energy
            + load_factor * (load_factor * self.expansion_energy - self.internal.thermal)
    }
}

/// Internal forces and the sizes that their residual is compared with.
#[derive(Debug, Clone, PartialEq)]
pub struct InternalForces {
    /// Sum of the bonds' end forces K u at each degree of freedom, shape (n_degrees_of_freedom), N and N m; where processes share the body
    /// out, at own points.
    pub values: Vec<f64>,
    /// Largest sum of |end forces| that meet at a point along one axis, N.
    pub force_scale: f64,
    /// Largest sum of |end moments| that meet at a point, N m.
    pub moment_scale: f64,
    /// -sum over the bonds of force . thermal deformation, for the one at load factor 1: what does work while it grows, J.
    pub thermal: f64,
}

impl<const D: usize, const M: usize, E: Elements<D, M>> ElementSystem<D, M, E> {
    /// Deformation of every bond without what its temperature gives it, broken or not, shape (n_bonds).
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
        // Written in place: a closure that gives a deformation to be collected is called bond by bond, which costs more.
        Deformation::written(&self.system.room, ends.len(), |all| {
            all.par_chunks_mut(TASK).enumerate().for_each(of_task);
        })
    }

    /// Forces and energy of bonds with given deformations (n_bonds).
    ///
    /// Nothing depends on the number of threads: the bonds of a part are added up by one thread in their order, and the parts
    /// after each other.
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
    /// The sweep over the bonds of some parts, between points with these components; summed over the processes.
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

/// What the bonds of one part give.
struct Part<const M: usize> {
    /// At the owned points.
    forces: Vec<PointForces<M>>,
    energy: f64,
    thermal: f64,
    expansion_energy: f64,
}

/// The end forces that meet at a point.
#[derive(Debug, Clone, Copy)]
struct PointForces<const M: usize> {
    sum: [f64; M],
    /// Sum of their sizes.
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

    /// Adds what the temperature does to the bonds of the part.
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
