//! Deformations, internal forces and energies of the bonds.

use std::ops::Range;

use crate::deformation::{Deformation, Deformations};
use crate::element::Element;
use crate::layout::Layout;
use crate::parallel;
use crate::point_sums::{BondForces, GROUPS, PointSum, group};
use crate::subdomain::{Share, Subdomain, Whole};
use crate::surface::Vector;
use crate::system::{ElementSystem, UnbrokenBonds};
use crate::thermal::ThermalStrain;
use crate::volumetric::VolumetricTerms;

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
    /// Force of the points on each rigid body, N; empty without contact.
    pub on_rigid_bodies: Vec<Vector>,
}

impl<const D: usize, const M: usize, E: Element<D, M>> ElementSystem<D, M, E> {
    /// Deformation of every bond less its thermal deformation, broken or not, shape (n_bonds).
    pub(crate) fn deformations(
        &self,
        intact: &[bool],
        displacement: &[f64],
        expansion: ThermalStrain<'_>,
    ) -> Deformations {
        assert_eq!(displacement.len(), M * self.system.cloud.len());
        let ends = &self.system.bonds.ends;
        let of_task = |(task, deformations): (usize, &mut [E::Deformation])| {
            for (bond, deformation) in (task * TASK..).zip(deformations) {
                let element = self.whole_element(intact, bond);
                *deformation = element.deformation(displacement);
                if !expansion.is_none() {
                    let thermal = expansion.of_bond(ends[bond]);
                    *deformation = deformation.less(&element.deformation_in(&thermal));
                }
            }
        };
        let of_bonds = Deformation::written(&self.system.room, ends.len(), |all| {
            parallel::for_each(all.chunks_mut(TASK).enumerate(), of_task);
        });
        let of_bonds = match self.system.far {
            Some(_) => of_bonds.with_motions(displacement.to_vec()),
            None => of_bonds,
        };
        match &self.system.volumetric {
            Some(terms) => {
                of_bonds.with_volume_changes(terms.volume_changes((displacement, M), expansion))
            }
            None => of_bonds,
        }
    }

    /// Forces and energy of bonds with given deformations (n_bonds).
    pub(crate) fn forces(
        &self,
        bonds: UnbrokenBonds<'_>,
        deformations: Deformations,
        expansion: ThermalStrain<'_>,
    ) -> BondSweep {
        let subdomain = &self.system.cloud.subdomain;
        let of_bonds: &[E::Deformation] = Deformation::of_bonds(&deformations);
        let (mut at_points, energies) = match subdomain.is_whole() {
            true => self.sums(Whole, bonds, of_bonds),
            false => self.sums(subdomain, bonds, of_bonds),
        };
        let n_bonds = of_bonds.len();
        let of_group = |number: usize| {
            let group = group(number, n_bonds);
            let [thermal, of_expansion] = match expansion.is_none() {
                true => [0.0; 2],
                false => self.expansion_energies(bonds, of_bonds, expansion, group.clone()),
            };
            let stored = energies[group].iter().fold(0.0, |sum, energy| sum + energy);
            [thermal, stored, of_expansion]
        };
        let of_groups = parallel::map(0..GROUPS, of_group);
        let mut energies: [f64; 3] =
            std::array::from_fn(|place| of_groups.iter().map(|it| it[place]).sum());
        energies[1] += self.add_far_field(deformations.motions(), &mut at_points);
        if let Some(terms) = &self.system.volumetric {
            let changes = deformations.volume_changes();
            let of_cells = add_volumetric(terms, bonds, (changes, expansion), &mut at_points);
            (energies.iter_mut().zip(of_cells)).for_each(|(sum, energy)| *sum += energy);
        }
        subdomain.all_reduce_sum(&mut energies);
        BondSweep::new(
            &at_points,
            self.topology.layout,
            energies,
            deformations,
            subdomain,
        )
    }

    /// Sums of the forces at the points of a share, and the energies (n_bonds) of its bonds.
    fn sums(
        &self,
        share: impl Share,
        bonds: UnbrokenBonds<'_>,
        deformations: &[E::Deformation],
    ) -> (Vec<PointForces<M>>, Vec<f64>) {
        let deformed = DeformedBonds {
            typed: self,
            share,
            bonds,
            deformations,
        };
        let n_owned = self.system.cloud.subdomain.n_owned();
        let mut sums = vec![PointForces::NONE; n_owned];
        let energies = self.reach().sum(share, &deformed, &mut sums).concat();
        (sums, energies)
    }

    /// Adds the forces of the elements of the far field at all points; returns their energy 1/2 u^T K u, J. A translation of all points makes no
    /// force: displacements are relative to the displacement of the first point, so that a large one costs no digits.
    fn add_far_field(&self, motions: &[f64], sums: &mut [PointForces<M>]) -> f64 {
        let Some(far) = &self.system.far else {
            return 0.0;
        };
        let forces = far.forces::<M>(sums.len(), motions);
        add_forces(&forces, sums);
        let energy = |(force, moved): (&[f64; D], &[f64])| {
            let work = (0..D).map(|axis| force[axis] * (moved[axis] - motions[axis]));
            0.5 * work.sum::<f64>()
        };
        forces.iter().zip(motions.chunks(M)).map(energy).sum()
    }

    /// Work -force . thermal deformation, J, and energy of the thermal deformation, J, of a group of bonds at load factor 1.
    fn expansion_energies(
        &self,
        bonds: UnbrokenBonds<'_>,
        deformations: &[E::Deformation],
        expansion: ThermalStrain<'_>,
        group: Range<usize>,
    ) -> [f64; 2] {
        let at_full_load = expansion.at_full_load();
        let subdomain = &self.system.cloud.subdomain;
        let [mut work, mut energy] = [0.0; 2];
        for bond in group {
            let ends = self.system.bonds.ends[bond];
            let element = self
                .remaining_element(bonds, bond)
                .filter(|_| subdomain.owns_bond(ends));
            let Some(element) = element else {
                continue;
            };
            let thermal = element.deformation_in(&at_full_load.of_bond(ends));
            work -= 2.0 * element.mutual_energy(&deformations[bond], &thermal);
            energy += element.mutual_energy(&thermal, &thermal);
        }
        [work, energy]
    }
}

/// Adds forces, shape (n_points, D), to sums of as many points.
pub(crate) fn add_forces<const D: usize, const M: usize>(
    forces: &[[f64; D]],
    sums: &mut [impl PointSum<M>],
) {
    for (sum, force) in sums.iter_mut().zip(forces) {
        let mut of_point = [0.0; M];
        of_point[..D].copy_from_slice(force);
        sum.add(of_point);
    }
}

/// Adds the forces of cells with a volumetric stiffness at all points, from the changes of their volumes (n_cells, m^3); returns their work
/// -force . thermal dilatation, their energy and that of the thermal dilatation at load factor 1, J.
fn add_volumetric<const D: usize, const M: usize>(
    terms: &VolumetricTerms<D>,
    bonds: UnbrokenBonds<'_>,
    (changes, expansion): (&[f64], ThermalStrain<'_>),
    sums: &mut [PointForces<M>],
) -> [f64; 3] {
    let shares = terms.shares(bonds);
    let dilatations = terms.dilatations(&shares, changes);
    let pressures = terms.pressures(&shares, &dilatations);
    add_forces(&terms.forces(sums.len(), &pressures), sums);
    let stored = 0.5 * terms.work(&dilatations, &dilatations);
    if expansion.is_none() {
        return [0.0, stored, 0.0];
    }
    let thermal = terms.thermal_changes(expansion.at_full_load());
    let thermal = terms.dilatations(&shares, &thermal);
    let work = -terms.work(&dilatations, &thermal);
    [work, stored, 0.5 * terms.work(&thermal, &thermal)]
}

impl BondSweep {
    /// The sweep with the sums of the forces at the owned points, and with the thermal work, stored and
    /// expansion energies of the whole body, J.
    fn new<const M: usize>(
        at_points: &[PointForces<M>],
        layout: Layout,
        energies: [f64; 3],
        deformations: Deformations,
        subdomain: &Subdomain,
    ) -> Self {
        let collected = |of_point: fn(&PointForces<M>) -> [f64; M]| {
            subdomain.from_owned(at_points.iter().map(of_point).collect())
        };
        let (values, sizes) = (
            collected(|forces| forces.sum),
            collected(|forces| forces.size),
        );
        let largest = |of_rotations: bool| {
            let is_one = |place: &usize| layout.components[*place].is_rotation() == of_rotations;
            let places = (0..M).filter(is_one);
            let sizes = places.flat_map(|place| sizes.iter().skip(place).step_by(M).copied());
            sizes.fold(0.0, f64::max)
        };
        let mut scales = [largest(false), largest(true)];
        subdomain.all_reduce_max(&mut scales);
        let [force_scale, moment_scale] = scales;
        let [thermal, stored_energy, expansion_energy] = energies;
        Self {
            internal: InternalForces {
                force_scale,
                moment_scale,
                values,
                thermal,
                on_rigid_bodies: Vec::new(),
            },
            sizes,
            stored_energy,
            expansion_energy,
            deformations,
        }
    }
}

/// Sum of the end forces at a point.
#[derive(Debug, Clone, Copy)]
struct PointForces<const M: usize> {
    sum: [f64; M],
    /// Sum of the absolute end forces.
    size: [f64; M],
}

impl<const M: usize> PointSum<M> for PointForces<M> {
    const NONE: Self = Self {
        sum: [0.0; M],
        size: [0.0; M],
    };

    #[inline(always)]
    fn add(&mut self, end_force: [f64; M]) {
        for (component, value) in end_force.into_iter().enumerate() {
            self.sum[component] += value;
            self.size[component] += value.abs();
        }
    }

    #[inline(always)]
    fn plus(self, other: Self) -> Self {
        Self {
            sum: self.sum.plus(other.sum),
            size: self.size.plus(other.size),
        }
    }
}

/// Unbroken bonds with their deformations (n_bonds), for sums over a share of them.
struct DeformedBonds<'a, const D: usize, const M: usize, E: Element<D, M>, S> {
    typed: &'a ElementSystem<D, M, E>,
    share: S,
    bonds: UnbrokenBonds<'a>,
    deformations: &'a [E::Deformation],
}

impl<const D: usize, const M: usize, E: Element<D, M>, S: Share> BondForces<M>
    for DeformedBonds<'_, D, M, E, S>
{
    /// Energy of each bond, J; zero for bonds of other processes.
    type Found = Vec<f64>;

    #[inline(always)]
    fn add(&self, bond: usize, energies: Option<&mut Vec<f64>>, add: impl FnMut(u32, [f64; M])) {
        let element = self.typed.remaining_element(self.bonds, bond);
        let deformation = &self.deformations[bond];
        if let Some(energies) = energies {
            let ends = self.typed.system.bonds.ends[bond];
            let owned = element.as_ref().filter(|_| self.share.owns_bond(ends));
            let energy = owned.map(|it| it.mutual_energy(deformation, deformation));
            energies.push(energy.unwrap_or(0.0));
        }
        if let Some(element) = element {
            element.forces(deformation, add);
        }
    }
}
