//! Sparse symmetric systems: pattern, values, factorisations and eigenvalues. No points, no bonds, no time.
//!
//! The pattern of a matrix is made once ([`Pattern`]), analysed once for an order of elimination ([`Symbolic`]), and then
//! factorised as often as its values change ([`FactorKind::factorise`]). Where a change is a sum of few terms of rank one
//! ([`RankOne`]), the factor is changed in place ([`Factorisation::change`]), for a fraction of the cost. With the products of
//! a factor [`largest_eigenpairs`] finds the lowest modes. Everything runs on one thread in a fixed order, so that the same
//! matrix gives the same bits.

mod cholesky;
mod eigen;
mod factor_error;
mod factor_kind;
mod factorisation;
mod general;
mod ldlt;
mod llt;
mod lu;
mod matrix;
mod modification;
mod panels;
mod rank_one;
mod substitution;
mod supernodes;
mod symbolic;

pub use eigen::{Eigenpairs, Search, largest_eigenpairs};
pub use factor_error::FactorError;
pub use factorisation::{Factorisation, HalfSolved, Inertia};
pub use general::GeneralMatrix;
pub use lu::Lu;
pub use matrix::{Pattern, PatternError, SymmetricMatrix};
pub use modification::VANISHING_PIVOT;
pub use panels::FactorKind;
pub use rank_one::RankOne;
pub use symbolic::{Elimination, Symbolic};
