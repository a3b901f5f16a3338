//! Coarse equations solved by a factor of their matrix.

use std::collections::BTreeSet;
use std::sync::Arc;

use ligament_linalg::{
    Elimination, FactorError, FactorKind, Factorisation, Pattern, RankOne, Symbolic,
    SymmetricMatrix, VANISHING_PIVOT,
};

use super::coarse_stiffness::{CoarseEquations, CoarseStiffness};

/// Factor of E, updated while bonds break.
pub(super) struct CoarseFactor {
    factor: Box<dyn Factorisation>,
    pattern: Arc<Pattern>,
    /// Motions without stiffness that is independent of the motions before them, as in mechanisms; decoupled in the factor.
    left_out: BTreeSet<usize>,
}

impl CoarseFactor {
    /// Factorises E.
    ///
    /// # Errors
    ///
    /// If the factor does not fit into memory.
    pub(super) fn new(stiffness: &CoarseStiffness) -> Result<Self, FactorError> {
        let mut matrix = stiffness.matrix()?;
        let pattern = matrix.pattern().clone();
        let symbolic = Symbolic::analyse(pattern.clone(), Elimination::MinimumDegree)?;
        let symbolic = Arc::new(symbolic);
        let mut left_out = BTreeSet::new();
        loop {
            let without = match FactorKind::Llt.factorise(&symbolic, &matrix) {
                Ok(factor) => {
                    let pivots = factor.pivots().into_iter().enumerate();
                    let vanishes =
                        |(i, pivot): &(usize, f64)| *pivot < VANISHING_PIVOT * matrix.diagonal(*i);
                    let vanishing: Vec<usize> = pivots.filter(vanishes).map(|it| it.0).collect();
                    if vanishing.is_empty() {
                        return Ok(Self {
                            factor,
                            pattern,
                            left_out,
                        });
                    }
                    vanishing
                }
                Err(
                    FactorError::NotPositiveDefinite { unknown }
                    | FactorError::ZeroPivot { unknown },
                ) => vec![unknown],
                Err(other) => return Err(other),
            };
            left_out.extend(without);
            cut_off(&mut matrix, &left_out);
        }
    }

    /// Whether the pattern of the factor contains the product of any two entries of a term.
    fn couples(&self, entries: &[(usize, f64)]) -> bool {
        let (starts, rows) = (self.pattern.column_starts(), self.pattern.rows());
        entries.iter().enumerate().all(|(place, &(column, _))| {
            let of_column = &rows[starts[column]..starts[column + 1]];
            let mut above = entries[..place].iter();
            above.all(|(row, _)| of_column.binary_search(row).is_ok())
        })
    }
}

impl CoarseEquations for CoarseFactor {
    fn solve(&mut self, works: &mut Vec<f64>) {
        self.factor.solve_in_place(works);
    }

    fn change(&mut self, terms: &[RankOne]) -> bool {
        if !terms.iter().all(|it| self.couples(&it.entries)) {
            return false;
        }
        let without = |term: &RankOne| RankOne {
            weight: term.weight,
            entries: (term.entries.iter().copied())
                .filter(|(unknown, _)| !self.left_out.contains(unknown))
                .collect(),
        };
        let terms: Vec<RankOne> = terms.iter().map(without).collect();
        self.factor.change(&terms, &[]).is_ok()
    }
}

/// Decouples unknowns from the others, with a unit on the diagonal.
fn cut_off(matrix: &mut SymmetricMatrix, unknowns: &BTreeSet<usize>) {
    let pattern = matrix.pattern().clone();
    for column in 0..pattern.dimension() {
        let range = pattern.column_starts()[column]..pattern.column_starts()[column + 1];
        let is_out = unknowns.contains(&column);
        for (&row, value) in pattern.rows()[range.clone()]
            .iter()
            .zip(&mut matrix.values[range])
        {
            if is_out || unknowns.contains(&row) {
                *value = f64::from(u8::from(row == column));
            }
        }
    }
}
