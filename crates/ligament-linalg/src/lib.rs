//! Sparse symmetric systems: pattern, values, factorisations and eigenvalues, without points, bonds or time.
//!
//! The pattern of a matrix is made once ([`Pattern`]), analysed once for an order of elimination ([`Symbolic`]), and the matrix is
//! factorised whenever its values change ([`FactorKind::factorise`]). A change that is a sum of few terms of rank one ([`RankOne`]) updates
//! the factor in place ([`Factorisation::change`]), for a fraction of the cost. With the products of a factor [`largest_eigenpairs`] finds
//! the lowest modes. Sums are taken in an order that the matrix alone gives, so that the results have the same bits on any number of
//! threads; work runs in the caller's rayon pool.

mod branches;
mod cholesky;
mod dense;
mod digest;
mod dissection;
mod eigen;
mod factor_kind;
mod factorisation;
mod general;
mod left_looking;
mod lu;
mod matrix;
mod modification;
mod panels;
mod parts;
mod sources;
mod substitution;
mod subtraction;
mod supernodes;
mod symbolic;

pub use digest::digest;
pub use eigen::{Eigenpairs, LargestEigenvalue, Search, largest_eigenpairs, largest_eigenvalue};
pub use factorisation::{FactorError, Factorisation, ForwardSubstituted, Inertia, RankOne};
pub use general::GeneralMatrix;
pub use lu::Lu;
pub use matrix::{Pattern, PatternError, SymmetricMatrix};
pub use modification::VANISHING_PIVOT;
pub use panels::FactorKind;
pub use parts::Part;
pub use symbolic::{Elimination, Symbolic};
