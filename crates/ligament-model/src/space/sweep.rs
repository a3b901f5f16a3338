//! Deformations, internal forces and energies of bonds in space.

use std::ops::Range;

use rayon::prelude::*;

use super::element::SolidKinematics;
use super::system::Typed;
use crate::deformation::{Deformations, SpaceDeformation};
use crate::portion::{Share, Whole, counts};
use crate::sweep::{BondSweep, PARTS, Part, TASK};
use crate::system::BondsLeft;
use crate::thermal::ThermalStrain;

impl<const M: usize, B: SolidKinematics<M>> Typed<'_, B, M> {
    /// Deformation of every bond without what its temperature gives it, broken or not, shape (n_bonds).
    pub(super) fn deformations(
        self,
        displacement: &[f64],
        expansion: ThermalStrain<'_>,
    ) -> Deformations {
        assert_eq!(displacement.len(), M * self.system.cloud.len());
        let ends = &self.system.bonds.ends;
        let of_task = |(task, deformations): (usize, &mut [SpaceDeformation])| {
            for (bond, deformation) in (task * TASK..).zip(deformations) {
                *deformation = self.deformation(bond, displacement);
                if !expansion.is_none() {
                    let thermal = expansion.of_bond_in_space(ends[bond]);
                    let free = self.whole(bond).deformation_in(thermal);
                    *deformation = deformation.less(&free);
                }
            }
        };
        self.system.room.in_space(ends.len(), |all| {
            all.par_chunks_mut(TASK).enumerate().for_each(of_task);
        })
    }

    /// Forces and energy of bonds with given deformations (n_bonds); they are added up in parts as those in the plane.
    pub(super) fn forces(
        self,
        bonds: BondsLeft<'_>,
        deformations: Deformations,
        expansion: ThermalStrain<'_>,
    ) -> BondSweep {
        let n_bonds = self.system.bonds.len();
        let portion = self.system.cloud.portion.as_ref();
        let vectors = deformations.vectors();
        let made = |number: usize| {
            let of_part = || number * n_bonds / PARTS..(number + 1) * n_bonds / PARTS;
            let mut part = match portion {
                None => self.part(Whole, bonds, vectors, of_part()),
                Some(portion) => self.part(portion, bonds, vectors, of_part()),
            };
            if !expansion.is_none() {
                self.add_expansion(&mut part, bonds, vectors, expansion, of_part());
            }
            part
        };
        let parts: Vec<Part<M>> = (0..PARTS).into_par_iter().map(made).collect();
        BondSweep::of_parts(&parts, &B::COMPONENTS, deformations, portion)
    }

    fn part(
        self,
        share: impl Share,
        bonds: BondsLeft<'_>,
        deformations: &[SpaceDeformation],
        of_part: Range<usize>,
    ) -> Part<M> {
        let mut part = Part::new(&self.system.cloud);
        for bond in of_part {
            let Some(element) = self.left(bonds, bond) else {
                continue;
            };
            let deformation = &deformations[bond];
            let ends = self.system.bonds.ends[bond];
            if share.counts(ends) {
                part.energy += element.mutual_energy(deformation, deformation);
            }
            for (point, force) in ends.into_iter().zip(element.end_forces(deformation)) {
                if let Some(row) = share.row(point) {
                    part.forces[row].add(force);
                }
            }
        }
        part
    }

    /// Adds what the temperature does to the bonds of a part.
    fn add_expansion(
        self,
        part: &mut Part<M>,
        bonds: BondsLeft<'_>,
        deformations: &[SpaceDeformation],
        expansion: ThermalStrain<'_>,
        of_part: Range<usize>,
    ) {
        let at_full_load = expansion.at_full_load();
        let portion = self.system.cloud.portion.as_ref();
        for bond in of_part {
            let ends = self.system.bonds.ends[bond];
            let element = self.left(bonds, bond).filter(|_| counts(portion, ends));
            let Some(element) = element else {
                continue;
            };
            let thermal = element.deformation_in(at_full_load.of_bond_in_space(ends));
            part.thermal -= 2.0 * element.mutual_energy(&deformations[bond], &thermal);
            part.expansion_energy += element.mutual_energy(&thermal, &thermal);
        }
    }
}
