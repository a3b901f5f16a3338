//! Rigid motions that the bonds of a system do not resist.

use super::{BondSystem, ElementSystem};
use crate::element::Elements;
use crate::interface::BondTopology;
use crate::rigid_motions::{RigidMotions, Turn};

impl<const D: usize, const M: usize, E: Elements<D, M>> ElementSystem<D, M, E> {
    /// Whether a fixed degree of freedom holds its point: the rotation of a point of the far field alone has no effect.
    pub(super) fn resisting<'a>(
        &'a self,
        is_fixed: &'a dyn Fn(usize) -> bool,
    ) -> impl Fn(usize) -> bool + use<'a, D, M, E> {
        let layout = self.layout();
        let has_bonds = move |dof| !self.system.bonds.incidence.at(layout.point(dof)).is_empty();
        let has_effect = move |dof| {
            self.system.far.is_none() || !layout.component(dof).is_rotation() || has_bonds(dof)
        };
        move |dof| is_fixed(dof) && has_effect(dof)
    }

    /// Rigid motions of some points that their bonds do not resist.
    pub(super) fn rigid_motions(&self, points: &[u32]) -> RigidMotions<'_, D> {
        let BondSystem {
            bonds, rigidities, ..
        } = &self.system;
        let mut bonds = (points.iter()).flat_map(|&point| bonds.incidence.at(point));
        let resist = bonds.any(|&bond| rigidities.resist_rotations(bond as usize));
        let resist = self.subdomain().any(resist);
        let turn_points = E::COMPONENTS.iter().any(|it| it.is_rotation());
        let turn = match (resist, self.elements.rotates_freely()) {
            (true, true) if turn_points => Turn::OfPointsAlong,
            (true, false) => Turn::Costly,
            (false, _) | (true, true) => Turn::OfPositions,
        };
        let positions = &self.system.cloud.positions;
        RigidMotions::new(self.layout(), positions, points, turn)
    }
}
