//! Implementation of [`Bonds`] for a bond system.

use super::contact::Moved;
use super::{BondSystem, ElementSystem, UnbrokenBonds};
use crate::change::ChangedElements;
use crate::contact::{ClosedPair, ContactPair, Overlap};
use crate::deformation::{Deformation, Deformations};
use crate::element::{BondDeformation, Element, Rigidities, StiffnessFactors, Term};
use crate::failure::hooke::{Moduli, StressAcross};
use crate::failure::starting::Starting;
use crate::interface::{
    Bonds, CentralMotions, FreeShapes, PointStiffness, StressReading, Stresses,
};
use crate::layout::Component;
use crate::product::NearLimits;
use crate::rigid_motions::{self, FreeMotion, RigidMotions, Turn};
use crate::stress::carried::StrainReading;
use crate::stress::domain_integral::DomainIntegral;
use crate::stress::growing_tip::GrowingTip;
use crate::stress::point_strain::Motion;
use crate::stress::stored::StoredMotions;
use crate::stress::traction;
use crate::sweep::BondSweep;
use crate::tensor::SymTensor;
use crate::thermal::ThermalStrain;
use crate::topology::Topology;
use crate::volumetric::CellPatch;

impl<const D: usize, const M: usize, E: Element<D, M>> Bonds for ElementSystem<D, M, E> {
    fn topology(&self) -> &Topology {
        &self.topology
    }

    fn rigidities(&self) -> &Rigidities {
        &self.system.rigidities
    }

    fn extent(&self) -> f64 {
        self.system.cloud.extent()
    }

    fn halve(&self, points: &mut [u32]) {
        self.system.cloud.halve(points);
    }

    fn point_stiffness(&self) -> Vec<PointStiffness> {
        let BondSystem {
            rigidities, bonds, ..
        } = &self.system;
        let mut all = PointStiffness::of_bonds(rigidities, bonds, &self.topology.subdomain);
        if let Some(far) = &self.system.far {
            for (point, of_point) in (0..).zip(&mut all) {
                of_point.force += far.stiffness_at(point);
            }
        }
        if let Some(terms) = &self.system.volumetric {
            for (point, of_point) in (0..).zip(&mut all) {
                of_point.force += terms.stiffness_at(point);
            }
        }
        all
    }

    fn holds(
        &self,
        points: &[u32],
        is_fixed: &dyn Fn(usize) -> bool,
        can_hold: &dyn Fn(usize) -> bool,
    ) -> Vec<usize> {
        let part = self.free_part(points, is_fixed, can_hold);
        part.map_or_else(Vec::new, |it| it.holds())
    }

    fn free_shapes(
        &self,
        points: &[u32],
        is_fixed: &dyn Fn(usize) -> bool,
        can_hold: &dyn Fn(usize) -> bool,
    ) -> FreeShapes {
        let part = self.free_part(points, is_fixed, &|dof| can_hold(dof) && !is_fixed(dof));
        part.map_or_else(FreeShapes::default, |it| it.shapes())
    }

    fn free_motions(
        &self,
        points: &[u32],
        is_fixed: &dyn Fn(usize) -> bool,
        force: &dyn Fn(usize) -> f64,
    ) -> Vec<FreeMotion> {
        self.part_with_forces(points, is_fixed, force)
            .free_motions()
    }

    fn rigid_shapes(&self, points: &[u32]) -> Vec<Vec<f64>> {
        let (layout, positions) = (self.topology.layout, &self.system.cloud.positions);
        RigidMotions::new(layout, positions, points, Turn::OfPointsAlong).shapes(points)
    }

    fn rigid_shapes_of_body(&self) -> Vec<Vec<f64>> {
        self.shapes_of_body()
    }

    fn motions_about_centre(&self, masses: &[f64]) -> CentralMotions {
        let cloud = &self.system.cloud;
        let total: f64 = masses.iter().sum();
        let middle: [f64; D] = std::array::from_fn(|axis| {
            let weighted = masses.iter().zip(&cloud.positions);
            weighted.map(|(mass, p)| mass * p[axis]).sum::<f64>() / total
        });
        CentralMotions {
            centre: (middle.iter().zip(cloud.origin))
                .map(|(middle, origin)| middle + origin)
                .collect(),
            motions: rigid_motions::columns(self.topology.layout, &cloud.positions, middle),
        }
    }

    fn motions_of_strain(&self) -> Vec<Vec<f64>> {
        self.system.cloud.motions_of_strain(M)
    }

    fn deformations(
        &self,
        intact: &[bool],
        displacement: &[f64],
        expansion: ThermalStrain<'_>,
    ) -> Deformations {
        self.deformations(intact, displacement, expansion)
    }

    fn measured(
        &self,
        intact: &[bool],
        displacement: &[f64],
        bonds: &[u32],
    ) -> Vec<BondDeformation> {
        let of_bond = |&bond: &u32| {
            let element = self.whole_element(intact, bond as usize);
            element.deformation(displacement).measured()
        };
        bonds.iter().map(of_bond).collect()
    }

    fn forces(
        &self,
        bonds: UnbrokenBonds<'_>,
        deformations: Deformations,
        expansion: ThermalStrain<'_>,
    ) -> BondSweep {
        self.forces(bonds, deformations, expansion)
    }

    fn terms(&self, intact: &[bool], bond: usize, remaining: &StiffnessFactors) -> Vec<Term> {
        self.whole_element(intact, bond).weakened(remaining).terms()
    }

    fn add_blocks(&self, bonds: UnbrokenBonds<'_>, point: u32, lower: &[u32], blocks: &mut [f64]) {
        for &bond in self.topology.elements_at_points.at(point) {
            let Some(element) = self.remaining_element(bonds, bond as usize) else {
                continue;
            };
            element.upper_blocks(point, |other, block| {
                let place = if other == point {
                    Ok(lower.len())
                } else {
                    lower.binary_search(&other)
                };
                if let Ok(place) = place {
                    let values = block.as_flattened();
                    let sums = &mut blocks[place * values.len()..];
                    for (sum, value) in sums.iter_mut().zip(values) {
                        *sum += value;
                    }
                }
            });
        }
        if let Some(far) = &self.system.far {
            far.add_blocks::<M>(point, lower, blocks);
        }
        if let Some(terms) = &self.system.volumetric {
            terms.add_blocks::<M>(bonds, point, lower, blocks);
        }
    }

    fn multiply(&self, bonds: UnbrokenBonds<'_>, motions: &[f64], forces: &mut [f64]) {
        self.multiply(bonds, motions, forces);
    }

    fn forces_near_limits(
        &self,
        bonds: UnbrokenBonds<'_>,
        motions: &[f64],
        limits: NearLimits<'_>,
        forces: &mut [f64],
    ) -> Vec<u32> {
        self.forces_near_limits(bonds, motions, limits, forces)
    }

    fn add_derivatives(&self, intact: &[bool], add: &mut dyn FnMut(usize, usize, f64)) {
        for bond in 0..self.system.bonds.len() {
            self.whole_element(intact, bond).derivatives(&mut *add);
        }
    }

    fn changed(
        &self,
        left: UnbrokenBonds<'_>,
        displacement: &[f64],
        expansion: ThermalStrain<'_>,
        bonds: &[u32],
    ) -> Box<dyn ChangedElements> {
        self.changed(left, displacement, expansion, bonds)
    }

    fn mutual_energy(
        &self,
        intact: &[bool],
        bond: usize,
        remaining: &StiffnessFactors,
        [one, other]: [&Deformations; 2],
    ) -> f64 {
        let element = self.whole_element(intact, bond).weakened(remaining);
        element.mutual_energy(&of_bonds(one)[bond], &of_bonds(other)[bond])
    }

    fn cell_patches(&self) -> Vec<CellPatch> {
        let terms = self.system.volumetric.as_ref();
        terms.map_or_else(Vec::new, |it| it.whole_patches())
    }

    fn force_of_cells(&self, intact: &[bool], displacement: &[f64], point: u32) -> Vec<f64> {
        let bonds = UnbrokenBonds::whole(intact);
        let terms = self.system.volumetric.as_ref();
        let force = terms.map(|it| it.force_in_motions(bonds, (displacement, M), point));
        force.map_or_else(Vec::new, |it| it.to_vec())
    }

    fn points_of_breakage(&self, bonds: &[u32]) -> Vec<u32> {
        let ends = bonds
            .iter()
            .flat_map(|&bond| self.topology.ends[bond as usize]);
        let terms = self.system.volumetric.iter();
        let of_cells = terms.flat_map(|it| it.points_of_patches(bonds));
        let mut points: Vec<u32> = ends.chain(of_cells).collect();
        points.sort_unstable();
        points.dedup();
        points
    }

    fn energy_lost_by_cells(
        &self,
        intact: &[bool],
        remaining: [&[StiffnessFactors]; 2],
        deformations: [&Deformations; 2],
    ) -> f64 {
        let Some(terms) = &self.system.volumetric else {
            return 0.0;
        };
        let [before, after] = remaining.map(|remaining| {
            let shares = terms.shares(UnbrokenBonds { intact, remaining });
            let found = deformations.map(|it| terms.dilatations(&shares, it.volume_changes()));
            0.5 * terms.work(&found[0], &found[1])
        });
        before - after
    }

    fn stored_energy(
        &self,
        intact: &[bool],
        bond: usize,
        remaining: &StiffnessFactors,
        measured: &BondDeformation,
    ) -> f64 {
        let deformation = Deformation::with_measures(measured);
        let element = self.whole_element(intact, bond).weakened(remaining);
        element.mutual_energy(&deformation, &deformation)
    }

    fn energy_density(
        &self,
        bonds: UnbrokenBonds<'_>,
        deformations: &Deformations,
        point: u32,
    ) -> f64 {
        let elements = self
            .system
            .elements_at(self.topology.layout, deformations, point);
        let of_elements = elements.map_or(0.0, |it| it.energy());
        let changes = deformations.volume_changes();
        let volumetric = self.system.volumetric.as_ref();
        let of_cells = volumetric.map_or(0.0, |it| it.energy_at(bonds, changes, point));
        let deformations: &[E::Deformation] = of_bonds(deformations);
        let family = self.system.bonds.incidence.at(point).iter();
        let shares = family.filter_map(|&bond| {
            let element = self.remaining_element(bonds, bond as usize)?;
            let deformation = &deformations[bond as usize];
            let energy = element.mutual_energy(deformation, deformation);
            let is_first = self.topology.ends[bond as usize][0] == point;
            Some(self.system.rigidities.share(bond, is_first) * energy)
        });
        (shares.sum::<f64>() + of_elements + of_cells) / self.system.cloud.volumes[point as usize]
    }

    fn stress(
        &self,
        bonds: UnbrokenBonds<'_>,
        deformations: &Deformations,
        point: u32,
    ) -> Vec<f64> {
        let stress = self.virial_stress(bonds, deformations, point);
        stress.components().collect()
    }

    fn stresses(
        &self,
        reading: StressReading,
        bonds: UnbrokenBonds<'_>,
        deformations: &Deformations,
    ) -> Stresses {
        match reading {
            StressReading::Virial => {
                let stresses = self.virial_stresses(bonds, deformations);
                Stresses {
                    names: SymTensor::<D>::NAMES,
                    values: stresses.iter().flat_map(SymTensor::components).collect(),
                }
            }
            StressReading::Traction => Stresses {
                names: traction::names::<D>(),
                values: self.tractions(bonds, deformations),
            },
        }
    }

    fn stresses_by_material(&self, reading: StrainReading<'_>) -> Stresses {
        self.system
            .stresses_by_material(self.topology.layout, reading)
    }

    fn stress_by_material(&self, reading: StrainReading<'_>, point: u32) -> Vec<f64> {
        let layout = self.topology.layout;
        let strain = self.system.strain_by(layout, reading, point);
        self.system
            .stress_components(layout, reading, point, strain)
    }

    fn whole_strain(&self, motion: Motion<'_>, point: u32) -> Vec<f64> {
        let fit = self
            .system
            .fit_of_motion(self.topology.layout, motion, point);
        match fit.strain() {
            Some(strain) => strain.engineering().collect(),
            None => vec![f64::NAN; SymTensor::<D>::COMPONENTS.len()],
        }
    }

    fn domain_integral(
        &self,
        integral: &DomainIntegral,
        reading: StrainReading<'_>,
        forces: &[f64],
    ) -> f64 {
        let layout = self.topology.layout;
        self.system
            .domain_integral(layout, integral, reading, forces)
    }

    fn at_growing_tip(&self, tip: &GrowingTip, intact: &[bool]) -> (f64, Option<DomainIntegral>) {
        self.system.at_growing_tip(tip, intact)
    }

    fn stresses_across(
        &self,
        motion: Motion<'_>,
        deformations: &[BondDeformation],
        moduli: &(dyn Fn(usize) -> Moduli + Sync),
    ) -> Vec<StressAcross> {
        let (system, layout) = (&self.system, self.topology.layout);
        system.stresses_across(layout, motion, deformations, moduli)
    }

    fn stored_motions(&self) -> Option<Box<dyn StoredMotions + '_>> {
        self.system.stored_motions(self.topology.layout)
    }

    fn utilisations(
        &self,
        motion: Motion<'_>,
        deformations: &[BondDeformation],
        starting: &Starting,
    ) -> Vec<f64> {
        let (system, layout) = (&self.system, self.topology.layout);
        system.utilisations(layout, motion, deformations, starting)
    }

    fn force_through(
        &self,
        bonds: UnbrokenBonds<'_>,
        deformations: &Deformations,
        crossing: &[(u32, bool)],
        component: Component,
    ) -> f64 {
        let deformations: &[E::Deformation] = of_bonds(deformations);
        let Some(place) = self
            .topology
            .layout
            .components
            .iter()
            .position(|it| *it == component)
        else {
            return 0.0;
        };
        let pulls = crossing.iter().filter_map(|&(bond, first_is_near)| {
            let element = self.remaining_element(bonds, bond as usize)?;
            let forces = element.end_forces(&deformations[bond as usize])?;
            // The end force keeps the end in place against the bond, whose pull is opposite.
            Some(-forces[usize::from(!first_is_near)][place])
        });
        pulls.sum()
    }

    fn contact_pairs(&self, intact: &[bool]) -> Vec<ContactPair> {
        self.system.contact_pairs(self.topology.layout, intact)
    }

    fn changed_pairs(&self, intact: &[bool], broken: &[u32]) -> Vec<(u32, Option<ContactPair>)> {
        self.system
            .changed_pairs(self.topology.layout, intact, broken)
    }

    fn overlap(
        &self,
        intact: &[bool],
        displacement: &[f64],
        expansion: ThermalStrain<'_>,
        beyond: f64,
        asked: &[bool],
    ) -> Option<Overlap> {
        if self.topology.faces_close {
            return None;
        }
        let moved = Moved {
            layout: self.topology.layout,
            motions: displacement,
            expansion,
        };
        self.system.largest_overlap(intact, moved, beyond, asked)
    }

    fn add_contact_stresses(
        &self,
        reading: StressReading,
        closed: &[ClosedPair],
        stresses: &mut Stresses,
    ) {
        self.system
            .add_stresses_of_contact(reading, closed, &mut stresses.values);
    }
}

/// Deformations of all bonds in the type of their elements, shape (n_bonds).
fn of_bonds<B: Deformation>(deformations: &Deformations) -> &[B] {
    B::of_bonds(deformations)
}
