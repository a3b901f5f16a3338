//! Linear equations in two factors a bond, and their sums over the bonds.

use super::pairs::Pairs;

/// A number for each equation of some points, by index.
pub(crate) type Multipliers<const N: usize> = Vec<[f64; N]>;

/// Linear equations G q = f in two factors a bond, N a point. Points are given by their indices, bonds by pairs.
pub(crate) trait Equations<const N: usize>: Sync {
    /// Number of the equations of forces, in which the ends of a bond have opposite terms; the equations of moments after them have equal
    /// terms at both ends.
    const FORCES: usize;

    /// Pairs of points with bonds.
    fn pairs(&self) -> &Pairs<'_>;

    /// Stiffnesses of the pairs, which multiply both factors.
    fn stiffness(&self) -> &[[f64; 2]];

    /// Uncorrected factors q_0 of the pairs.
    fn start(&self) -> &[f64];

    /// Right-hand sides f, shape (n_own, N).
    fn right_hand_sides(&self) -> &[[f64; N]];

    /// Scales d of the equations of an own point.
    fn scale(&self, index: usize) -> [f64; N];

    /// Terms of a pair in the equations of its other end, for given products of factors and stiffness.
    fn forces(&self, pair: usize, products: [f64; 2]) -> [f64; N];

    /// Both entries of G^T mu over the stiffness of a pair, from the sum of the multipliers of its ends with the signs of its terms there: the
    /// transpose of [`forces`](Self::forces).
    fn strains(&self, pair: usize, sum: &[f64; N]) -> [f64; 2];

    /// Terms of a pair at its own point, from those at its other end.
    #[inline(always)]
    fn at_own(mut terms: [f64; N]) -> [f64; N] {
        terms[..Self::FORCES].iter_mut().for_each(|it| *it = -*it);
        terms
    }

    /// Terms of a pair at its other end, for a function of G^T mu; `own` has the multipliers of its point with their signs.
    #[inline(always)]
    fn terms(
        &self,
        pair: usize,
        own: [f64; N],
        mu: &[[f64; N]],
        products: &mut impl FnMut(usize, [f64; 2]) -> [f64; 2],
    ) -> [f64; N] {
        let other = mu[self.pairs().other[pair] as usize];
        let sum = std::array::from_fn(|k| other[k] + own[k]);
        self.forces(pair, products(pair, self.strains(pair, &sum)))
    }

    /// Adds G times a function of G^T mu to the sums of a block of points, pair by pair; both are over the stiffness.
    #[inline(always)]
    fn add(
        &self,
        block: usize,
        mu: &[[f64; N]],
        sums: &mut [[f64; N]],
        mut products: impl FnMut(usize, [f64; 2]) -> [f64; 2],
    ) {
        let pairs = self.pairs();
        let indices = pairs.indices(block);
        let first = indices.start;
        for index in indices {
            let own = Self::at_own(mu[index]);
            let mut own_sum = sums[index - first];
            for pair in pairs.inner(index) {
                let terms = self.terms(pair, own, mu, &mut products);
                add(&mut own_sum, Self::at_own(terms));
                add(&mut sums[pairs.other[pair] as usize - first], terms);
            }
            for pair in pairs.outer(index) {
                add(
                    &mut own_sum,
                    Self::at_own(self.terms(pair, own, mu, &mut products)),
                );
            }
            sums[index - first] = own_sum;
        }
    }
}

#[inline(always)]
fn add<const N: usize>(sums: &mut [f64; N], terms: [f64; N]) {
    for (sum, term) in sums.iter_mut().zip(terms) {
        *sum += term;
    }
}
