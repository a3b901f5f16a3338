//! Loads with a factor of their own each.

use std::sync::Arc;

use super::{BoundaryGroup, Control, LoadProgram, ProportionalLoading};
use crate::restraints::Restraints;
use crate::unknowns::Layout;

/// Loads, each by itself at factor 1 with all supports and all groups of the history, shape (n_loads).
#[derive(Debug, Clone)]
pub(super) struct Separate(pub(super) Arc<[ProportionalLoading]>);

impl Separate {
    pub(super) fn layout(&self) -> Layout {
        self.0[0].layout
    }

    pub(super) fn is_prescribed(&self, degree_of_freedom: usize) -> bool {
        let mut loads = self.0.iter();
        loads.any(|it| it.prescribed[degree_of_freedom].is_some())
    }

    pub(super) fn restraints(&self) -> &Arc<Restraints> {
        &self.0[0].restraints
    }

    pub(super) fn loaded_degrees_of_freedom(&self) -> Vec<u32> {
        let loads = self.0.iter();
        let mut loaded: Vec<u32> = loads
            .flat_map(LoadProgram::loaded_degrees_of_freedom)
            .collect();
        loaded.sort_unstable();
        loaded.dedup();
        loaded
    }

    pub(super) fn groups(&self) -> &[BoundaryGroup] {
        &self.0[0].groups
    }

    /// Resultants of the given forces through the groups for factors of the loads (n_loads).
    pub(super) fn given_resultants(&self, factors: &[f64]) -> Vec<Vec<f64>> {
        let mut sums: Vec<Vec<f64>> = (self.groups().iter())
            .map(|group| vec![0.0; group.force.len()])
            .collect();
        for (load, factor) in self.0.iter().zip(factors) {
            for (sum, group) in sums.iter_mut().zip(&load.groups) {
                for (sum, force) in sum.iter_mut().zip(&group.force) {
                    *sum += factor * force;
                }
            }
        }
        sums
    }

    pub(super) fn control(&self) -> &Control {
        &self.0[0].control
    }
}
