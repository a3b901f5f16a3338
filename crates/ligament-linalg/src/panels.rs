//! The values of a factor, panel by panel.

use crate::supernodes::Supernodes;

/// The factorisations to choose from, which store their pivots in different ways.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FactorKind {
    /// L L^T, for positive definite matrices, with the square root of the pivot on the diagonal.
    Llt,
    /// L D L^T without pivoting, for matrices that may be indefinite, with the pivot on the diagonal of a unit L.
    Ldlt,
}

/// A factor as its panels.
#[derive(Clone, Copy)]
pub(crate) struct Panels<'a> {
    pub(crate) kind: FactorKind,
    pub(crate) supernodes: Supernodes<'a>,
    pub(crate) values: &'a [f64],
}
