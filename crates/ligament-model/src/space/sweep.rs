//! Deformations, internal forces and energies of bonds in space.

use std::ops::Range;

use rayon::prelude::*;

use super::element::SolidKinematics;
use super::system::Typed;
use crate::deformation::{Deformations, SpaceDeformation};
use crate::portion::{counts, row};
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
        let parts: Vec<Part<M>> = (0..PARTS)
            .into_par_iter()
            .map(|part| {
                let of_part = part * n_bonds / PARTS..(part + 1) * n_bonds / PARTS;
                self.part(bonds, deformations.vectors(), expansion, of_part)
            })
            .collect();
        let portion = self.system.cloud.portion.as_ref();
        BondSweep::of_parts(&parts, &B::COMPONENTS, deformations, portion)
    }

    fn part(
        self,
        bonds: BondsLeft<'_>,
        deformations: &[SpaceDeformation],
        expansion: ThermalStrain<'_>,
        of_part: Range<usize>,
    ) -> Part<M> {
        let mut part = Part::new(&self.system.cloud);
        let portion = self.system.cloud.portion.as_ref();
        for bond in of_part.clone() {
            let Some(element) = self.left(bonds, bond) else {
                continue;
            };
            let deformation = &deformations[bond];
            let ends = self.system.bonds.ends[bond];
            if counts(portion, ends) {
                part.energy += element.mutual_energy(deformation, deformation);
            }
            for (point, force) in ends.into_iter().zip(element.end_forces(deformation)) {
                if let Some(row) = row(portion, point) {
                    part.forces[row].add(force);
                }
            }
        }
        if expansion.is_none() {
            return part;
        }
        let at_full_load = expansion.at_full_load();
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
        part
    }
}
