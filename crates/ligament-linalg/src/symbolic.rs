//! Symbolic analysis: fill-reducing ordering and the structure of the factor.

use std::sync::Arc;

use faer::Side;
use faer::sparse::linalg::SupernodalThreshold;
use faer::sparse::linalg::cholesky::supernodal::SupernodalLltRef;
use faer::sparse::linalg::cholesky::{
    CholeskySymbolicParams, SymbolicCholesky, SymbolicCholeskyRaw, SymmetricOrdering,
    factorize_symbolic_cholesky,
};
use faer::sparse::{FaerError, SparseColMatRef, SymbolicSparseColMatRef};

use crate::factorisation::FactorError;
use crate::matrix::{Pattern, SymmetricMatrix};

/// The structure of the factor of every matrix over one pattern.
///
/// The ordering is approximate minimum degree; the factor is always supernodal, so that small and large systems take
/// the same path.
#[derive(Debug)]
pub struct Symbolic {
    pattern: Arc<Pattern>,
    pub(crate) cholesky: SymbolicCholesky<usize>,
}

impl Symbolic {
    /// Analyses a pattern.
    pub fn analyse(pattern: Arc<Pattern>) -> Result<Self, FactorError> {
        let parameters = CholeskySymbolicParams {
            supernodal_flop_ratio_threshold: SupernodalThreshold::FORCE_SUPERNODAL,
            ..Default::default()
        };
        let cholesky = factorize_symbolic_cholesky(
            symbolic_view(&pattern),
            Side::Upper,
            SymmetricOrdering::Amd,
            parameters,
        )
        .map_err(|error| match error {
            FaerError::IndexOverflow => FactorError::IndexOverflow,
            _ => FactorError::OutOfMemory {
                bytes: size_of::<usize>() * pattern.n_entries(),
            },
        })?;
        Ok(Self { pattern, cholesky })
    }

    /// The pattern that was analysed.
    pub fn pattern(&self) -> &Arc<Pattern> {
        &self.pattern
    }

    /// Number of values that the factor stores.
    pub fn n_factor_values(&self) -> usize {
        self.cholesky.len_val()
    }

    /// The matrix as faer sees it.
    pub(crate) fn view<'a>(&self, matrix: &'a SymmetricMatrix) -> SparseColMatRef<'a, usize, f64> {
        debug_assert_eq!(matrix.pattern(), &self.pattern);
        SparseColMatRef::new(symbolic_view(matrix.pattern()), &matrix.values)
    }

    /// Index in the matrix of a row of the factor.
    pub(crate) fn unknown_of_row(&self, row: usize) -> usize {
        self.cholesky
            .perm()
            .map_or(row, |permutation| permutation.arrays().0[row])
    }

    /// Diagonal of the factor's values in the order of the matrix, shape (n).
    pub(crate) fn diagonal(&self, values: &[f64]) -> Vec<f64> {
        let mut diagonal = vec![0.0; self.pattern.dimension()];
        if let SymbolicCholeskyRaw::Supernodal(structure) = self.cholesky.raw() {
            let factor = SupernodalLltRef::new(structure, values);
            for supernode in (0..structure.n_supernodes()).map(|s| factor.supernode(s)) {
                for column in 0..supernode.val().ncols() {
                    diagonal[self.unknown_of_row(supernode.start() + column)] =
                        supernode.val()[(column, column)];
                }
            }
        }
        diagonal
    }
}

fn symbolic_view(pattern: &Pattern) -> SymbolicSparseColMatRef<'_, usize> {
    let n = pattern.dimension();
    SymbolicSparseColMatRef::new_checked(n, n, pattern.column_starts(), None, pattern.rows())
}
