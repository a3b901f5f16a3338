//! The coarse space, its forces and the factor of its stiffness, updated while bonds break.

use std::collections::BTreeSet;
use std::sync::Arc;

use ligament_linalg::{FactorError, Factorisation, Pattern, RankOne};

use super::coarse_basis::CoarseBasis;
use super::coarse_stiffness::{CoarseStiffness, Factored};
use super::operator::Operator;
use super::resistance::Resistance;

/// Coarse space Z, forces K Z and factor of E = Z^T K Z.
pub(super) struct Coarse {
    space: CoarseBasis,
    resistance: Resistance,
    factor: Box<dyn Factorisation>,
    pattern: Arc<Pattern>,
    /// Coarse unknowns decoupled from the others in the factor.
    left_out: BTreeSet<usize>,
}

impl Coarse {
    /// Coarse space of the bonds of an operator, from aggregates of at most `largest` points and the diagonal of K
    /// (n_degrees_of_freedom).
    ///
    /// # Errors
    ///
    /// If E does not fit into memory.
    pub(super) fn new(
        operator: &Operator<'_>,
        diagonal: &[f64],
        largest: usize,
    ) -> Result<Self, FactorError> {
        let space = CoarseBasis::new(operator, diagonal, largest);
        let (resistance, blocks) = Resistance::new(operator, &space, diagonal);
        let stiffness = CoarseStiffness {
            operator,
            space: &space,
            blocks,
        };
        let matrix = stiffness.matrix()?;
        let pattern = matrix.pattern().clone();
        let Factored { factor, left_out } = Factored::new(matrix)?;
        Ok(Self {
            space,
            resistance,
            factor,
            pattern,
            left_out,
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
            if !self.couples(&works) {
                return false;
            }
            self.resistance.add(&self.space, term, &works);
            let entries = works.into_iter();
            in_space.push(RankOne {
                weight: term.weight,
                entries: entries
                    .filter(|(unknown, _)| !self.left_out.contains(unknown))
                    .collect(),
            });
        }
        self.factor.change(&in_space, &[]).is_ok()
    }

    /// Whether the pattern of the factor contains the product of any two of the works.
    fn couples(&self, works: &[(usize, f64)]) -> bool {
        let (starts, rows) = (self.pattern.column_starts(), self.pattern.rows());
        works.iter().enumerate().all(|(place, &(column, _))| {
            let of_column = &rows[starts[column]..starts[column + 1]];
            let mut above = works[..place].iter();
            above.all(|(row, _)| of_column.binary_search(row).is_ok())
        })
    }

    /// Amounts E^-1 Z^T f of the coarse motions for forces f (n_degrees_of_freedom), shape (n_aggregates, n_motions).
    pub(super) fn amounts(&mut self, forces: &[f64]) -> Vec<f64> {
        let mut works = self.space.works_of_all(forces);
        self.factor.solve_in_place(&mut works);
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
        self.factor.solve_in_place(&mut works);
        works
    }
}
