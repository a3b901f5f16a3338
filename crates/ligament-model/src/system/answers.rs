//! What a bond system answers to the equations: one dispatch to the type of its elements a call.

use super::{BondSystem, BondsLeft, Kinematics, Typed};
use ligament_mesh::Numbering;

use crate::bonds::Incidence;
use crate::change::ChangedElements;
use crate::contact::{ClosedPair, ContactPair, Overlap};
use crate::deformation::Deformations;
use crate::element::{BondDeformation, Element, Elements, Remaining, Term};
use crate::failure::{Criteria, Criterion};
use crate::interface::{
    Bonds, CentralMotions, CoupledPoints, PointStiffness, StressReading, Stresses,
};
use crate::layout::Component;
use crate::portion::{Portion, any};
use crate::rigid_motions::{FreeMotion, RigidMotions, Turn};
use crate::sweep::BondSweep;
use crate::thermal::ThermalStrain;

/// Evaluates an expression with the elements of a bond system as a type.
macro_rules! typed {
    ($system:expr, $typed:ident => $value:expr) => {{
        let system: &BondSystem = $system;
        match &system.kinematics {
            Kinematics::Beam(elements) => {
                let $typed = Typed::new(system, elements);
                $value
            }
            Kinematics::Spring(elements) => {
                let $typed = Typed::new(system, elements);
                $value
            }
            Kinematics::Imaginary(elements) => {
                let $typed = Typed::new(system, elements);
                $value
            }
            Kinematics::TrueStrain(elements) => {
                let $typed = Typed::new(system, elements);
                $value
            }
            Kinematics::Pairwise(elements) => {
                let $typed = Typed::new(system, elements);
                $value
            }
        }
    }};
}

impl Bonds for BondSystem {
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
        typed!(self, it => it.components())
    }

    fn strain_names(&self) -> &'static [&'static str] {
        self.kinematics.kind().strain_names()
    }

    fn ends(&self) -> &[[u32; 2]] {
        &self.bonds.ends
    }

    fn incidence(&self) -> &Incidence {
        &self.bonds.incidence
    }

    fn elements_at_points(&self) -> &Incidence {
        let couplings = typed!(self, it => it.elements.couplings());
        couplings.map_or(&self.bonds.incidence, |[elements, _]| elements)
    }

    fn coupled_points(&self) -> CoupledPoints<'_> {
        let of_elements = typed!(self, it => it.elements.couplings()).map(|[_, points]| points);
        match of_elements.or(self.faces.coupled()) {
            Some(points) => CoupledPoints {
                lists: points,
                ends: None,
            },
            None => CoupledPoints {
                lists: &self.bonds.incidence,
                ends: Some(&self.bonds.ends),
            },
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

    fn share(&self, bond: u32, point: u32) -> f64 {
        typed!(self, it => it.elements.share(&self.bonds, bond, point))
    }

    fn is_linear(&self) -> bool {
        typed!(self, it => it.elements.is_linear())
    }

    fn has_energy(&self) -> bool {
        typed!(self, it => it.elements.has_energy())
    }

    fn all_positive(&self) -> bool {
        let mut of_springs = self.rigidities.of_springs();
        !any(self.portion(), !of_springs.all(|&rigidity| rigidity > 0.0))
    }

    fn some_negative(&self) -> bool {
        let here = typed!(self, it => it.elements.some_negative(&self.rigidities));
        any(self.portion(), here)
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
        let (layout, positions) = (self.layout(), &self.cloud.positions);
        RigidMotions::in_plane(layout, positions, points, Turn::OfPointsAlong).shapes(points)
    }

    fn motions_about_centre(&self, masses: &[f64]) -> CentralMotions {
        let total: f64 = masses.iter().sum();
        let middle = [0, 1].map(|axis| {
            let weighted = masses.iter().zip(&self.cloud.positions);
            weighted.map(|(mass, p)| mass * p[axis]).sum::<f64>() / total
        });
        let motion = |of_point: &dyn Fn([f64; 2]) -> [f64; 3]| -> Vec<f64> {
            let from_middle = |p: &[f64; 2]| [p[0] - middle[0], p[1] - middle[1]];
            let components = self.components();
            let positions = self.cloud.positions.iter();
            let moved = positions.map(|p| of_point(from_middle(p)));
            moved
                .flat_map(|motion| components.iter().map(move |it| motion[*it as usize]))
                .collect()
        };
        CentralMotions {
            centre: [0, 1]
                .map(|axis| middle[axis] + self.cloud.origin[axis])
                .to_vec(),
            motions: vec![
                motion(&|_| [1.0, 0.0, 0.0]),
                motion(&|_| [0.0, 1.0, 0.0]),
                motion(&|[x, y]| [-y, x, 1.0]),
            ],
        }
    }

    fn motions_of_strain(&self) -> Vec<Vec<f64>> {
        self.cloud.motions_of_strain(self.components().len())
    }

    fn deformations(
        &self,
        intact: &[bool],
        displacement: &[f64],
        expansion: ThermalStrain<'_>,
    ) -> Deformations {
        typed!(self, it => it.deformations(intact, displacement, expansion))
    }

    fn measured(
        &self,
        intact: &[bool],
        displacement: &[f64],
        bonds: &[u32],
    ) -> Vec<BondDeformation> {
        let bonds = bonds.iter().map(|&bond| bond as usize);
        typed!(self, it => bonds.map(|bond| it.whole(intact, bond).deformation(displacement)).collect())
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
        intact: &[bool],
        bond: usize,
        remaining: &Remaining,
        [one, other]: [&Deformations; 2],
    ) -> f64 {
        typed!(self, it => it.whole(intact, bond).weakened(remaining).mutual_energy(&one[bond], &other[bond]))
    }

    fn stored_energy(
        &self,
        intact: &[bool],
        bond: usize,
        remaining: &Remaining,
        measured: &BondDeformation,
    ) -> f64 {
        typed!(self, it => it.whole(intact, bond).weakened(remaining).mutual_energy(measured, measured))
    }

    fn energy_density(&self, bonds: BondsLeft<'_>, deformations: &Deformations, point: u32) -> f64 {
        typed!(self, it => it.energy_density(bonds, deformations, point))
    }

    fn stress(&self, bonds: BondsLeft<'_>, deformations: &Deformations, point: u32) -> Vec<f64> {
        typed!(self, it => it.virial_stress(bonds, deformations, point).to_vec())
    }

    fn stresses(
        &self,
        reading: StressReading,
        bonds: BondsLeft<'_>,
        deformations: &Deformations,
    ) -> Stresses {
        match reading {
            StressReading::Virial => Stresses {
                names: &["xx", "yy", "xy"],
                values: self.virial_stresses(bonds, deformations).into_flattened(),
            },
            StressReading::Traction => Stresses {
                names: &["xx", "yx", "yy", "xy"],
                values: self.tractions(bonds, deformations).into_flattened(),
            },
        }
    }

    fn force_through(
        &self,
        bonds: BondsLeft<'_>,
        deformations: &Deformations,
        crossing: &[(u32, bool)],
        component: Component,
    ) -> f64 {
        typed!(self, it => it.force_through(bonds, deformations, crossing, component))
    }

    fn faces_close(&self) -> bool {
        self.faces.close()
    }

    fn contact_pairs(&self, intact: &[bool]) -> Vec<ContactPair> {
        BondSystem::contact_pairs(self, intact)
    }

    fn overlap(
        &self,
        intact: &[bool],
        displacement: &[f64],
        expansion: ThermalStrain<'_>,
        beyond: f64,
        asked: &[bool],
    ) -> Option<Overlap> {
        if self.faces_close() {
            return None;
        }
        self.largest_overlap(intact, displacement, expansion, beyond, asked)
    }

    fn add_contact_stresses(
        &self,
        reading: StressReading,
        closed: &[ClosedPair],
        stresses: &mut Stresses,
    ) {
        self.add_stresses_of_contact(reading, closed, &mut stresses.values);
    }

    fn unknown_along_lines<'c>(&self, criteria: &'c Criteria) -> Option<&'c Criterion> {
        criteria.unknown_along_lines()
    }

    fn energy_at_limit(&self, criterion: &Criterion, bond: usize) -> f64 {
        criterion.energy_at_limit(&self.rigidities, bond)
    }

    fn terms(&self, intact: &[bool], bond: usize, remaining: &Remaining) -> Vec<Term> {
        typed!(self, it => it.whole(intact, bond).weakened(remaining).terms().to_vec())
    }

    fn add_blocks(&self, bonds: BondsLeft<'_>, point: u32, lower: &[u32], blocks: &mut [f64]) {
        typed!(self, it => it.add_blocks(bonds, point, lower, blocks));
    }

    fn multiply(&self, bonds: BondsLeft<'_>, motions: &[f64], forces: &mut [f64]) {
        typed!(self, it => it.multiply(bonds, motions, forces));
    }

    fn add_derivatives(&self, intact: &[bool], add: &mut dyn FnMut(usize, usize, f64)) {
        typed!(self, it => {
            for bond in 0..self.bonds.len() {
                it.whole(intact, bond).derivatives(&mut *add);
            }
        });
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

impl BondSystem {
    /// The rigid motions of some points that their bonds let be free.
    fn rigid_motions(&self, points: &[u32]) -> RigidMotions<'_, 2, 3> {
        let mut bonds = points
            .iter()
            .flat_map(|&point| self.bonds.incidence.at(point));
        let resist = bonds.any(|&bond| self.rigidities.resist_rotations(bond as usize));
        let resist = any(self.portion(), resist);
        let turn_points = self.components().contains(&Component::Rotation);
        let turn = match (resist, typed!(self, it => it.elements.turns_freely())) {
            (true, true) if turn_points => Turn::OfPointsAlong,
            (true, false) => Turn::Costly,
            (false, _) | (true, true) => Turn::OfPositions,
        };
        RigidMotions::in_plane(self.layout(), &self.cloud.positions, points, turn)
    }

    /// Virial stress of every point, xx, yy and xy, shape (n_points), Pa.
    pub fn virial_stresses(
        &self,
        bonds: BondsLeft<'_>,
        deformations: &[BondDeformation],
    ) -> Vec<crate::stress::virial::SymmetricStress> {
        typed!(self, it => it.virial_stresses(bonds, deformations))
    }

    /// Traction at every point on the planes with normal x and with normal y, shape (n_points), Pa.
    pub fn tractions(
        &self,
        bonds: BondsLeft<'_>,
        deformations: &[BondDeformation],
    ) -> Vec<crate::stress::traction::Tractions> {
        typed!(self, it => it.tractions(bonds, deformations))
    }
}

impl<const M: usize, E: Elements<M>> Typed<'_, E, M> {
    fn components(self) -> &'static [Component] {
        &E::COMPONENTS
    }

    fn energy_density(
        self,
        bonds: BondsLeft<'_>,
        deformations: &[BondDeformation],
        point: u32,
    ) -> f64 {
        let family = self.system.bonds.incidence.at(point).iter();
        let shares = family.filter_map(|&bond| {
            let element = self.left(bonds, bond as usize)?;
            let deformation = &deformations[bond as usize];
            let energy = element.mutual_energy(deformation, deformation);
            Some(self.elements.share(&self.system.bonds, bond, point) * energy)
        });
        shares.sum::<f64>() / self.system.cloud.volumes[point as usize]
    }

    fn force_through(
        self,
        bonds: BondsLeft<'_>,
        deformations: &[BondDeformation],
        crossing: &[(u32, bool)],
        component: Component,
    ) -> f64 {
        let pulls = crossing.iter().filter_map(|&(bond, first_is_near)| {
            let element = self.left(bonds, bond as usize)?;
            let forces = element.end_forces(&deformations[bond as usize])?;
            // The end force is what holds the end in place against the bond: the bond pulls the other way.
            let place = E::COMPONENTS.iter().position(|it| *it == component)?;
            Some(-forces[usize::from(!first_is_near)][place])
        });
        pulls.sum()
    }

    fn add_blocks(self, bonds: BondsLeft<'_>, point: u32, lower: &[u32], blocks: &mut [f64]) {
        let elements = self.elements.couplings().map(|[elements, _]| elements);
        let elements = elements.unwrap_or(&self.system.bonds.incidence);
        for &bond in elements.at(point) {
            let Some(element) = self.left(bonds, bond as usize) else {
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
    }
}
