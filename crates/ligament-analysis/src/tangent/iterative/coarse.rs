//! The coarse space, its forces and its equations, updated while bonds break.

use ligament_linalg::{FactorError, RankOne};

use super::clusters::Clusters;
use super::coarse_basis::CoarseBasis;
use super::coarse_factor::CoarseFactor;
use super::coarse_iteration::CoarseIteration;
use super::coarse_stiffness::{CoarseEquations, CoarseStiffness};
use super::operator::Operator;
use super::resistance::Resistance;
use crate::solver::IterativeChoice;

/// Coarse space Z, forces K Z and equations of E = Z^T K Z.
pub(super) struct Coarse {
    space: CoarseBasis,
    resistance: Resistance,
    equations: Box<dyn CoarseEquations>,
}

impl Coarse {
    /// Coarse space of the bonds of an operator, from the diagonal of K (n_degrees_of_freedom).
    ///
    /// # Errors
    ///
    /// If E does not fit into memory.
    pub(super) fn new(
        operator: &Operator<'_>,
        diagonal: &[f64],
        choice: &IterativeChoice,
    ) -> Result<Self, FactorError> {
        let space = CoarseBasis::new(operator, diagonal, choice.aggregate);
        let (resistance, blocks) = Resistance::new(operator, &space, diagonal);
        let stiffness = CoarseStiffness::new(operator, &space, blocks);
        let equations: Box<dyn CoarseEquations> = match choice.cluster {
            None => Box::new(CoarseFactor::new(&stiffness)?),
            Some(largest) => {
                let clusters = Clusters::new(operator, &space, diagonal, largest);
                Box::new(CoarseIteration::new(&stiffness, clusters)?)
            }
        };
        Ok(Self {
            space,
            resistance,
            equations,
        })
    }

    /// Coarse space Z.
    pub(super) fn space(&self) -> &CoarseBasis {
        &self.space
    }

    /// Updates K Z and E by terms, those that add stiffness first. Returns whether that succeeded; if not, the coarse space must be
    /// rebuilt.
    #[must_use]
    pub(super) fn change(&mut self, terms: &[RankOne]) -> bool {
        let mut in_space = Vec::new();
        for term in terms {
            let works = self.space.works(&term.entries);
            self.resistance.add(&self.space, term, &works);
            in_space.push(RankOne {
                weight: term.weight,
                entries: works,
            });
        }
        self.equations.change(&in_space)
    }

    /// Amounts E^-1 Z^T f of the coarse motions for forces f (n_degrees_of_freedom), shape (n_aggregates, n_motions).
    pub(super) fn amounts(&mut self, forces: &[f64]) -> Vec<f64> {
        let mut works = self.space.works_of_all(forces);
        self.equations.solve(&mut works);
        works
    }

    /// Amounts E^-1 Z^T (f - K y) for forces f and motions y (n_degrees_of_freedom), shape (n_aggregates, n_motions).
    pub(super) fn amounts_after(
        &mut self,
        operator: &Operator<'_>,
        forces: &[f64],
        motions: &[f64],
    ) -> Vec<f64> {
        let mut works = self.space.works_of_all(forces);
        self.resistance
            .subtract_works(&self.space, motions, &mut works);
        for (weight, entries) in operator.beside {
            let moved: f64 = entries.iter().map(|(dof, it)| it * motions[*dof]).sum();
            for (unknown, work) in self.space.works(entries) {
                works[unknown] -= weight * moved * work;
            }
        }
        self.equations.solve(&mut works);
        works
    }
}
