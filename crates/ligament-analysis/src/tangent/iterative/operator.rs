//! Product with the tangent stiffness of a state, of bonds, restraints and closed pairs, without a matrix.

use ligament_model::element::Term;
use ligament_model::parallel;
use ligament_model::{Bonds, UnbrokenBonds};

use crate::unknowns::Unknowns;
use crate::vectors::CHUNK;

/// Tangent stiffness between free degrees of freedom.
pub(super) struct Operator<'a> {
    pub(super) system: &'a dyn Bonds,
    pub(super) unknowns: &'a Unknowns,
    /// Intact bonds and their remaining stiffness.
    pub(super) bonds: UnbrokenBonds<'a>,
    /// Whether each degree of freedom is free, shape (n_degrees_of_freedom).
    pub(super) free: &'a [bool],
    /// Additional terms at free degrees of freedom, other than bonds and restraints.
    pub(super) beside: &'a [Term],
}

impl Operator<'_> {
    /// Product with motions, both of shape (n_degrees_of_freedom) and zero where not free.
    pub(super) fn multiply(&self, motions: &[f64], forces: &mut [f64]) {
        self.system.multiply(self.bonds, motions, forces);
        self.unknowns.restraints().add_forces(motions, forces);
        for (weight, entries) in self.beside {
            let moved: f64 = entries.iter().map(|(dof, it)| it * motions[*dof]).sum();
            for (dof, value) in entries {
                forces[*dof] += weight * moved * value;
            }
        }
        let chunks = forces.chunks_mut(CHUNK).zip(self.free.chunks(CHUNK));
        parallel::for_each(chunks, |(forces, free)| {
            for (force, free) in forces.iter_mut().zip(free) {
                if !free {
                    *force = 0.0;
                }
            }
        });
    }

    /// Points of smaller number that are coupled with a point, ascending.
    pub(super) fn lower_points(&self, point: u32) -> Vec<u32> {
        let coupled = &self.system.coupled_points;
        let (restraints, layout) = (self.unknowns.restraints(), self.unknowns.layout());
        restraints.lower_points(layout, coupled, point as usize)
    }

    /// Adds the blocks in the columns of a point, in the rows of its `lower` points and of itself, without the additional terms,
    /// shape (n_lower + 1, n_components, n_components); including degrees of freedom that are not free.
    pub(super) fn add_blocks(&self, point: u32, lower: &[u32], blocks: &mut [f64]) {
        self.system.add_blocks(self.bonds, point, lower, blocks);
        let (restraints, layout) = (self.unknowns.restraints(), self.unknowns.layout());
        restraints.add_blocks(layout, point, lower, blocks);
    }

    /// Number of components of the motion of a point.
    pub(super) fn n_components(&self) -> usize {
        self.unknowns.layout().components.len()
    }
}
