//! What a bond system in space answers to the equations: one dispatch to the type of its bonds a call.

use super::change::terms;
use super::element::{BeamBond, SolidElement, SolidKinematics, SpringBond};
use super::stress;
use super::system::{SolidSystem, Typed};
use ligament_mesh::Numbering;

use crate::bonds::Incidence;
use crate::change::ChangedElements;
use crate::contact::{ClosedPair, ContactPair, Overlap};
use crate::deformation::{Deformations, SpaceDeformation};
use crate::element::{BondDeformation, Remaining, Term};
use crate::failure::{Criteria, Criterion};
use crate::interface::{
    Bonds, CentralMotions, CoupledPoints, PointStiffness, StressReading, Stresses,
};
use crate::layout::Component;
use crate::portion::{Portion, any};
use crate::rigid_motions::FreeMotion;
use crate::sweep::BondSweep;
use crate::system::BondsLeft;
use crate::thermal::ThermalStrain;

/// Evaluates an expression with the bonds of a system as a type.
macro_rules! typed {
    ($system:expr, $typed:ident => $value:expr) => {{
        let system: &SolidSystem = $system;
        match system.element {
            SolidElement::Beam => {
                let $typed = Typed::<BeamBond, 6>::new(system);
                $value
            }
            SolidElement::Spring => {
                let $typed = Typed::<SpringBond, 3>::new(system);
                $value
            }
        }
    }};
}

impl Bonds for SolidSystem {
    fn n_points(&self) -> usize {
        self.cloud.len()
    }

    fn numbering(&self) -> &Numbering {
        &self.cloud.numbering
    }

    fn portion(&self) -> Option<&Portion> {
        self.cloud.portion.as_ref()
    }

    fn components(&self) -> &'static [Component] {
        match self.element {
            SolidElement::Beam => &BeamBond::COMPONENTS,
            SolidElement::Spring => &SpringBond::COMPONENTS,
        }
    }

    fn strain_names(&self) -> &'static [&'static str] {
        &["stretch", "shear", "rotation"]
    }

    fn ends(&self) -> &[[u32; 2]] {
        &self.bonds.ends
    }

    fn incidence(&self) -> &Incidence {
        &self.bonds.incidence
    }

    fn elements_at_points(&self) -> &Incidence {
        &self.bonds.incidence
    }

    fn coupled_points(&self) -> CoupledPoints<'_> {
        CoupledPoints {
            lists: &self.bonds.incidence,
            ends: Some(&self.bonds.ends),
        }
    }

    fn volumes(&self) -> &[f64] {
        &self.cloud.volumes
    }

    fn spacing(&self) -> &[f64] {
        &self.cloud.spacing
    }

    fn horizons(&self) -> &[f64] {
        &self.bonds.horizon
    }

    fn weights(&self) -> &[f64] {
        &self.weight
    }

    fn share(&self, _bond: u32, _point: u32) -> f64 {
        0.5
    }

    fn is_linear(&self) -> bool {
        true
    }

    fn has_energy(&self) -> bool {
        true
    }

    fn all_positive(&self) -> bool {
        let mut of_springs = self.rigidities.of_springs();
        !any(self.portion(), !of_springs.all(|&rigidity| rigidity > 0.0))
    }

    fn some_negative(&self) -> bool {
        let mut of_springs = self.rigidities.of_springs();
        any(self.portion(), of_springs.any(|&rigidity| rigidity < 0.0))
    }

    fn some_negative_shear(&self) -> bool {
        let mut shear = self.rigidities.shear.iter();
        any(self.portion(), shear.any(|&rigidity| rigidity < 0.0))
    }

    fn resisted(&self) -> Vec<bool> {
        let (layout, portion) = (self.layout(), self.portion());
        self.rigidities.resisted(&self.bonds.ends, layout, portion)
    }

    fn point_stiffness(&self) -> Vec<PointStiffness> {
        PointStiffness::of_bonds(&self.rigidities, &self.bonds, self.portion())
    }

    fn extent(&self) -> f64 {
        self.cloud.extent()
    }

    fn halve(&self, points: &mut [u32]) {
        self.cloud.halve(points);
    }

    fn holds(
        &self,
        points: &[u32],
        is_fixed: &dyn Fn(usize) -> bool,
        can_hold: &dyn Fn(usize) -> bool,
    ) -> Vec<usize> {
        let in_file = self.cloud.numbering.sorted(points);
        self.rigid_motions(&in_file)
            .holds(&in_file, is_fixed, can_hold)
    }

    fn free_shapes(&self, points: &[u32], is_fixed: &dyn Fn(usize) -> bool) -> Vec<Vec<f64>> {
        self.rigid_motions(points).free_shapes(points, is_fixed)
    }

    fn free_motions(
        &self,
        points: &[u32],
        is_fixed: &dyn Fn(usize) -> bool,
        force: &dyn Fn(usize) -> f64,
    ) -> Vec<FreeMotion> {
        let motions = self.rigid_motions(points);
        motions.free_motions(points, is_fixed, force)
    }

    fn rigid_shapes(&self, points: &[u32]) -> Vec<Vec<f64>> {
        self.all_motions(points).shapes(points)
    }

    fn motions_about_centre(&self, masses: &[f64]) -> CentralMotions {
        self.central_motions(masses)
    }

    fn motions_of_strain(&self) -> Vec<Vec<f64>> {
        self.cloud.motions_of_strain(self.components().len())
    }

    fn deformations(
        &self,
        _intact: &[bool],
        displacement: &[f64],
        expansion: ThermalStrain<'_>,
    ) -> Deformations {
        typed!(self, it => it.deformations(displacement, expansion))
    }

    fn measured(
        &self,
        _intact: &[bool],
        displacement: &[f64],
        bonds: &[u32],
    ) -> Vec<BondDeformation> {
        let bonds = bonds.iter().map(|&bond| bond as usize);
        typed!(self, it => bonds.map(|bond| it.deformation(bond, displacement).measured()).collect())
    }

    fn forces(
        &self,
        bonds: BondsLeft<'_>,
        deformations: Deformations,
        expansion: ThermalStrain<'_>,
    ) -> BondSweep {
        typed!(self, it => it.forces(bonds, deformations, expansion))
    }

    fn mutual_energy(
        &self,
        _intact: &[bool],
        bond: usize,
        remaining: &Remaining,
        [one, other]: [&Deformations; 2],
    ) -> f64 {
        let both = [&one.vectors()[bond], &other.vectors()[bond]];
        typed!(self, it => it.whole(bond).weakened(remaining).mutual_energy(both[0], both[1]))
    }

    fn stored_energy(
        &self,
        _intact: &[bool],
        bond: usize,
        remaining: &Remaining,
        measured: &BondDeformation,
    ) -> f64 {
        // The energy sees the sizes of shear and rotation, not their directions.
        let deformation = SpaceDeformation {
            stretch: measured.stretch(),
            shear: [measured.shear(), 0.0, 0.0],
            rotation: [measured.rotation(), 0.0, 0.0],
        };
        let both = [&deformation; 2];
        typed!(self, it => it.whole(bond).weakened(remaining).mutual_energy(both[0], both[1]))
    }

    fn energy_density(&self, bonds: BondsLeft<'_>, deformations: &Deformations, point: u32) -> f64 {
        typed!(self, it => it.energy_density(bonds, deformations.vectors(), point))
    }

    fn stress(&self, bonds: BondsLeft<'_>, deformations: &Deformations, point: u32) -> Vec<f64> {
        typed!(self, it => it.virial_stress(bonds, deformations.vectors(), point).to_vec())
    }

    fn stress_readings(&self) -> &'static [StressReading] {
        &[StressReading::Virial]
    }

    /// Virial stresses, whatever reading is asked for: there is no other one in space.
    fn stresses(
        &self,
        _reading: StressReading,
        bonds: BondsLeft<'_>,
        deformations: &Deformations,
    ) -> Stresses {
        let values = typed!(self, it => it.virial_stresses(bonds, deformations.vectors()));
        Stresses {
            names: stress::COMPONENTS,
            values: values.into_flattened(),
        }
    }

    fn force_through(
        &self,
        bonds: BondsLeft<'_>,
        deformations: &Deformations,
        crossing: &[(u32, bool)],
        component: Component,
    ) -> f64 {
        let all = deformations.vectors();
        typed!(self, it => it.force_through(bonds, all, crossing, component))
    }

    fn faces_close(&self) -> bool {
        false
    }

    fn contact_pairs(&self, _intact: &[bool]) -> Vec<ContactPair> {
        Vec::new()
    }

    fn overlap(
        &self,
        _intact: &[bool],
        _displacement: &[f64],
        _expansion: ThermalStrain<'_>,
        _beyond: f64,
        _asked: &[bool],
    ) -> Option<Overlap> {
        None
    }

    fn add_contact_stresses(
        &self,
        _reading: StressReading,
        _closed: &[ClosedPair],
        _stresses: &mut Stresses,
    ) {
    }

    fn unknown_along_lines<'c>(&self, criteria: &'c Criteria) -> Option<&'c Criterion> {
        criteria.unknown_along_lines_in_space()
    }

    fn energy_at_limit(&self, criterion: &Criterion, bond: usize) -> f64 {
        criterion.energy_at_limit(&self.rigidities, bond)
    }

    fn terms(&self, _intact: &[bool], bond: usize, remaining: &Remaining) -> Vec<Term> {
        let ends = self.bonds.ends[bond];
        typed!(self, it => terms(&it.whole(bond).weakened(remaining), ends))
    }

    fn add_blocks(&self, bonds: BondsLeft<'_>, point: u32, lower: &[u32], blocks: &mut [f64]) {
        typed!(self, it => it.add_blocks(bonds, point, lower, blocks));
    }

    fn multiply(&self, bonds: BondsLeft<'_>, motions: &[f64], forces: &mut [f64]) {
        typed!(self, it => it.multiply(bonds, motions, forces));
    }

    fn add_derivatives(&self, _intact: &[bool], add: &mut dyn FnMut(usize, usize, f64)) {
        for bond in 0..self.bonds.len() {
            let ends = self.bonds.ends[bond];
            for (rigidity, entries) in typed!(self, it => terms(&it.whole(bond), ends)) {
                for (row, one) in &entries {
                    for (column, other) in &entries {
                        add(*row, *column, rigidity * one * other);
                    }
                }
            }
        }
    }

    fn changed(
        &self,
        left: BondsLeft<'_>,
        displacement: &[f64],
        expansion: ThermalStrain<'_>,
        bonds: &[u32],
    ) -> Box<dyn ChangedElements> {
        typed!(self, it => it.changed(left, displacement, expansion, bonds))
    }
}

impl<const M: usize, B: SolidKinematics<M>> Typed<'_, B, M> {
    fn energy_density(
        self,
        bonds: BondsLeft<'_>,
        deformations: &[SpaceDeformation],
        point: u32,
    ) -> f64 {
        let family = self.system.bonds.incidence.at(point).iter();
        let shares = family.filter_map(|&bond| {
            let element = self.left(bonds, bond as usize)?;
            let deformation = &deformations[bond as usize];
            Some(0.5 * element.mutual_energy(deformation, deformation))
        });
        shares.sum::<f64>() / self.system.cloud.volumes[point as usize]
    }

    fn force_through(
        self,
        bonds: BondsLeft<'_>,
        deformations: &[SpaceDeformation],
        crossing: &[(u32, bool)],
        component: Component,
    ) -> f64 {
        let Some(place) = B::COMPONENTS.iter().position(|it| *it == component) else {
            return 0.0;
        };
        let pulls = crossing.iter().filter_map(|&(bond, first_is_near)| {
            let element = self.left(bonds, bond as usize)?;
            let forces = element.end_forces(&deformations[bond as usize]);
            // The end force is what holds the end in place against the bond: the bond pulls the other way.
            Some(-forces[usize::from(!first_is_near)][place])
        });
        pulls.sum()
    }

    fn add_blocks(self, bonds: BondsLeft<'_>, point: u32, lower: &[u32], blocks: &mut [f64]) {
        let mut add = |place: usize, block: [[f64; M]; M]| {
            let sums = &mut blocks[place * M * M..];
            for (sum, value) in sums.iter_mut().zip(block.as_flattened()) {
                *sum += value;
            }
        };
        for &bond in self.system.bonds.incidence.at(point) {
            let Some(element) = self.left(bonds, bond as usize) else {
                continue;
            };
            let [a, _] = self.system.bonds.ends[bond as usize];
            if a == point {
                let [own, _] = element.blocks();
                add(lower.len(), own);
                continue;
            }
            // The point is the second end: the first one has the smaller number.
            if let Ok(place) = lower.binary_search(&a) {
                let [_, coupling] = element.blocks();
                add(place, coupling);
            }
            add(lower.len(), element.far_block());
        }
    }
}
