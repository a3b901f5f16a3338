//! Rigid motions that the bonds of a system do not resist.

use super::{BondSystem, ElementSystem};
use crate::element::Element;
use crate::rigid_motions::{RigidMotions, Turn};

impl<const D: usize, const M: usize, E: Element<D, M>> ElementSystem<D, M, E> {
    /// Whether a fixed degree of freedom holds its point: the rotation of a point of the far field alone has no effect.
    pub(super) fn resisting<'a>(
        &'a self,
        is_fixed: &'a dyn Fn(usize) -> bool,
    ) -> impl Fn(usize) -> bool + use<'a, D, M, E> {
        let layout = self.topology.layout;
        let has_bonds = move |dof| !self.system.bonds.incidence.at(layout.point(dof)).is_empty();
        let has_effect = move |dof| {
            self.system.far.is_none() || !layout.component(dof).is_rotation() || has_bonds(dof)
        };
        move |dof| is_fixed(dof) && has_effect(dof)
    }

    /// Shapes of the rigid motions of the body at the points of this process; collective.
    pub(super) fn shapes_of_body(&self) -> Vec<Vec<f64>> {
        let cloud = &self.system.cloud;
        let owned: Vec<u32> = cloud.subdomain.owned().collect();
        let all: Vec<u32> = (0..cloud.len() as u32).collect();
        let (layout, subdomain) = (self.topology.layout, &cloud.subdomain);
        RigidMotions::of_body(layout, &cloud.positions, &owned, subdomain).shapes(&all)
    }

    /// Cost and effect of rotating a part of the body, with some of its points on this process; collective.
    pub(super) fn turn(&self, points: &[u32]) -> Turn {
        let BondSystem {
            bonds, rigidities, ..
        } = &self.system;
        let mut bonds = (points.iter()).flat_map(|&point| bonds.incidence.at(point));
        let resist = bonds.any(|&bond| rigidities.resist_rotations(bond as usize));
        let resist = self.topology.subdomain.any(resist);
        match (resist, self.topology.element.rotates_freely()) {
            (true, true) if M > D => Turn::OfPointsAlong,
            (true, false) => Turn::Costly,
            (false, _) | (true, true) => Turn::OfPositions,
        }
    }
}
