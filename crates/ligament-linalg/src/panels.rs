//! The values of a factor, panel by panel.

use crate::supernodes::Supernodes;

/// The two ways in which a factor stores its pivots.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Form {
    /// L L^T, with the square root of the pivot on the diagonal.
    Llt,
    /// L D L^T, with the pivot on the diagonal of a unit L.
    Ldlt,
}

/// A factor as its panels.
#[derive(Clone, Copy)]
pub(crate) struct Panels<'a> {
    pub(crate) form: Form,
    pub(crate) supernodes: Supernodes<'a>,
    pub(crate) values: &'a [f64],
}
