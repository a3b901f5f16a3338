//! Symbolic analysis: fill-reducing ordering and the structure of the factor.

use std::sync::Arc;

use faer::Side;
use faer::perm::Perm;
use faer::sparse::linalg::SupernodalThreshold;
use faer::sparse::linalg::cholesky::{
    CholeskySymbolicParams, SymbolicCholesky, SymmetricOrdering, factorize_symbolic_cholesky,
};
use faer::sparse::{FaerError, SymbolicSparseColMatRef};

use crate::branches::Branch;
use crate::dissection::nested_dissection;
use crate::factorisation::FactorError;
use crate::matrix::Pattern;
use crate::parts::Part;
use crate::sources::{Sources, UpdatingSupernodes};
use crate::supernodes::Supernodes;

/// Operations per entry of the factor above which supernodes are formed. faer's own `FORCE_SUPERNODAL` is zero, which a diagonal matrix does
/// not exceed.
const ALWAYS_SUPERNODAL: SupernodalThreshold = SupernodalThreshold(-1.0);

/// Order in which the unknowns are eliminated.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Elimination {
    /// Approximate minimum degree.
    MinimumDegree,
    /// Nested dissection of the graph of the matrix.
    NestedDissection,
    /// Given order: a permutation of the unknowns.
    Given(Vec<usize>),
}

/// The structure of the factor of every matrix over one pattern.
///
/// The factor is always supernodal, so that small and large systems take the same path.
#[derive(Debug)]
pub struct Symbolic {
    pattern: Arc<Pattern>,
    pub(crate) cholesky: SymbolicCholesky<usize>,
    branch: Branch,
    sources: Sources,
    updating_supernodes: UpdatingSupernodes,
}

impl Symbolic {
    /// Analyses a pattern for an order of elimination.
    ///
    /// # Panics
    ///
    /// Panics if a given order is no permutation of the unknowns.
    pub fn analyse(pattern: Arc<Pattern>, elimination: Elimination) -> Result<Self, FactorError> {
        let parameters = CholeskySymbolicParams {
            supernodal_flop_ratio_threshold: ALWAYS_SUPERNODAL,
            ..Default::default()
        };
        let analyse = |ordering| {
            factorize_symbolic_cholesky(symbolic_view(&pattern), Side::Upper, ordering, parameters)
                .map_err(|error| match error {
                    FaerError::IndexOverflow => FactorError::IndexOverflow,
                    _ => FactorError::OutOfMemory {
                        bytes: size_of::<usize>() * pattern.n_entries(),
                    },
                })
        };
        let order = match elimination {
            Elimination::MinimumDegree => None,
            Elimination::NestedDissection => Some(nested_dissection(&pattern)),
            Elimination::Given(order) => Some(order),
        };
        let (cholesky, sources) = match order {
            None => {
                let cholesky = analyse(SymmetricOrdering::Amd)?;
                let sources = Sources::new(&pattern, permutation(&cholesky).1)?;
                (cholesky, sources)
            }
            Some(order) => {
                let places = inverse(&order);
                let checked =
                    Perm::new_checked(order.into(), places.clone().into(), pattern.dimension());
                let ordering = SymmetricOrdering::Custom(checked.as_ref());
                let (cholesky, sources) =
                    rayon::join(|| analyse(ordering), || Sources::new(&pattern, &places));
                (cholesky?, sources?)
            }
        };
        let supernodes = Supernodes::from_analysis(&cholesky);
        Ok(Self {
            branch: Branch::from_supernodes(supernodes),
            updating_supernodes: UpdatingSupernodes::new(supernodes),
            sources,
            pattern,
            cholesky,
        })
    }

    /// The pattern that was analysed.
    pub fn pattern(&self) -> &Arc<Pattern> {
        &self.pattern
    }

    /// Number of values that the factor stores.
    pub fn n_factor_values(&self) -> usize {
        self.cholesky.len_val()
    }

    /// Multiplications (and as many additions) of a factorisation: the sum over the columns of c (c + 1)/2, with c
    /// entries below the diagonal.
    pub fn n_multiplications(&self) -> f64 {
        let supernodes = self.supernodes();
        (0..supernodes.len())
            .map(|supernode| {
                let below = supernodes.rows_below(supernode).len();
                let columns = supernodes.columns(supernode).len();
                (below..below + columns)
                    .map(|count| (count * (count + 1) / 2) as f64)
                    .sum::<f64>()
            })
            .sum()
    }

    /// Parts of the factor for backward substitution part by part, each after its parent; every part that has children has at least `least`
    /// values together with its descendants.
    pub fn parts(&self, least: usize) -> Vec<Part> {
        Part::from_supernodes(self.supernodes(), least)
    }

    /// The panels of the factor.
    pub(crate) fn supernodes(&self) -> Supernodes<'_> {
        Supernodes::from_analysis(&self.cholesky)
    }

    /// Branches of the elimination tree that are independent of each other.
    pub(crate) fn branch(&self) -> &Branch {
        &self.branch
    }

    /// Entries of the matrix by columns of the factor.
    pub(crate) fn sources(&self) -> &Sources {
        &self.sources
    }

    /// Supernodes that update each supernode, all of them before it.
    pub(crate) fn updating_supernodes(&self) -> &UpdatingSupernodes {
        &self.updating_supernodes
    }

    /// Index in the matrix of each row of the factor, shape (n).
    pub fn unknown_of_row(&self) -> &[usize] {
        permutation(&self.cholesky).0
    }

    /// Row of the factor for each index in the matrix, shape (n).
    pub(crate) fn row_of_unknown(&self) -> &[usize] {
        permutation(&self.cholesky).1
    }

    /// Diagonal of the factor's values in the order of elimination, shape (n).
    pub(crate) fn diagonal(&self, values: &[f64]) -> Vec<f64> {
        let supernodes = self.supernodes();
        let mut diagonal = Vec::with_capacity(self.pattern.dimension());
        for supernode in 0..supernodes.len() {
            let panel = &values[supernodes.panel(supernode)];
            let columns = supernodes.columns(supernode).len();
            let height = columns + supernodes.rows_below(supernode).len();
            diagonal.extend((0..columns).map(|column| panel[column * height + column]));
        }
        diagonal
    }
}

/// Index in the matrix of each row of the factor, and row of the factor for each index, shape (n) each.
fn permutation(cholesky: &SymbolicCholesky<usize>) -> (&[usize], &[usize]) {
    match cholesky.perm() {
        Some(permutation) => permutation.arrays(),
        None => unreachable!("both ways of ordering permute"),
    }
}

/// Inverse of a permutation.
fn inverse(order: &[usize]) -> Vec<usize> {
    let mut places = vec![usize::MAX; order.len()];
    for (place, &unknown) in order.iter().enumerate() {
        places[unknown] = place;
    }
    places
}

fn symbolic_view(pattern: &Pattern) -> SymbolicSparseColMatRef<'_, usize> {
    let n = pattern.dimension();
    SymbolicSparseColMatRef::new_checked(n, n, pattern.column_starts(), None, pattern.rows())
}
