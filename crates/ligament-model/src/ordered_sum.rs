//! Sums whose rounding does not depend on the number of threads.

use rayon::prelude::*;

/// Terms a block; fixed, so that the order of summation is fixed too.
const BLOCK: usize = 4096;

/// Sum of `term(0) + ... + term(count - 1)`, in parallel blocks of fixed size that are added up in order.
///
/// The result has the same bits for any number of threads.
pub fn ordered_sum(count: usize, term: impl Fn(usize) -> f64 + Sync) -> f64 {
    let blocks: Vec<f64> = (0..count.div_ceil(BLOCK))
        .into_par_iter()
        .map(|block| {
            let end = ((block + 1) * BLOCK).min(count);
            (block * BLOCK..end).map(&term).sum()
        })
        .collect();
    blocks.into_iter().sum()
}

#[cfg(test)]
mod tests {
    use super::ordered_sum;

    /// 1 + 1/2 + ... + 1/n is about ln n + 0.5772...; the blocks must not drop or repeat a term.
    #[test]
    fn harmonic_number_over_several_blocks() {
        let n = 3 * super::BLOCK + 17;
        let expected = (n as f64).ln() + 0.577_215_664_901_532_9 + 0.5 / n as f64;
        let sum = ordered_sum(n, |i| 1.0 / (i + 1) as f64);
        // The next term of the expansion is 1/(12 n^2) < 1e-9.
        assert!((sum - expected).abs() < 1e-9);
        assert_eq!(ordered_sum(0, |_| 1.0), 0.0);
    }

    #[test]
    fn same_bits_for_one_and_three_threads() {
        let sum_with = |threads| {
            let pool = rayon::ThreadPoolBuilder::new()
                .num_threads(threads)
                .build()
                .expect("pool");
            pool.install(|| ordered_sum(50_000, |i| (i as f64 * 0.37).sin()))
        };
        assert_eq!(sum_with(1).to_bits(), sum_with(3).to_bits());
    }
}
