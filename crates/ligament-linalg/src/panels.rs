//! Values of a factor by panels.

use std::ops::Range;

use crate::branches::Branch;
use crate::supernodes::Supernodes;

/// The kinds of factorisation, which store their pivots in different ways.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FactorKind {
    /// L L^T, for positive definite matrices, with the square root of the pivot on the diagonal.
    Llt,
    /// L D L^T without pivoting, for matrices that may be indefinite, with the pivot on the diagonal of a unit L.
    Ldlt,
}

/// A factor as dense panels, one per supernode.
#[derive(Clone, Copy)]
pub(crate) struct Panels<'a> {
    pub(crate) kind: FactorKind,
    pub(crate) supernodes: Supernodes<'a>,
    pub(crate) values: &'a [f64],
}

impl Panels<'_> {
    /// Rows of the factor that are columns of a range of supernodes.
    pub(crate) fn rows(self, supernodes: Range<usize>) -> Range<usize> {
        let [start, end] =
            [supernodes.start, supernodes.end].map(|it| self.supernodes.columns_before(it));
        start..end
    }

    /// Divides vectors into the rows of each of some consecutive branches; the vectors begin with the rows of the first.
    pub(crate) fn split<'a, const N: usize>(
        self,
        branches: &[Branch],
        vectors: [&'a mut [f64]; N],
    ) -> Vec<[&'a mut [f64]; N]> {
        let mut rest = vectors;
        let mut split = |branch: &Branch| {
            let n_rows = self.rows(branch.supernodes()).len();
            let rows = rest.each_mut();
            rows.map(|it| it.split_off_mut(..n_rows).unwrap_or_default())
        };
        branches.iter().map(&mut split).collect()
    }
}
