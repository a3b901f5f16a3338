//! Arithmetic on long arrays with reproducible bits: sums are taken in a fixed order for any number of threads.

use std::ops::Range;

use ligament_model::subdomain::Subdomain;
use rayon::prelude::*;

/// Number of entries summed by one thread at a time.
pub(crate) const CHUNK: usize = 4096;

/// Scalar product of two arrays of the same shape, by sums of every eighth product, because successive additions to one sum would
/// wait for each other.
pub(crate) fn dot(one: &[f64], other: &[f64]) -> f64 {
    let ((ones, rest), (others, of_rest)) = (one.as_chunks::<8>(), other.as_chunks::<8>());
    let mut sums = [0.0; 8];
    for (one, other) in ones.iter().zip(others) {
        for ((sum, a), b) in sums.iter_mut().zip(one).zip(other) {
            *sum += a * b;
        }
    }
    let rest = rest.iter().zip(of_rest).map(|(a, b)| a * b);
    sums.into_iter().chain(rest).sum()
}

/// Scalar product of two arrays of the same shape, each distributed over the processes.
pub(crate) fn dot_of_all(subdomain: &Subdomain, one: &[f64], other: &[f64]) -> f64 {
    subdomain.sum(dot(one, other))
}

/// Scalar product of two arrays of the same shape, by chunks on all threads.
pub(crate) fn dot_of_chunks(one: &[f64], other: &[f64]) -> f64 {
    let chunks = one.par_chunks(CHUNK).zip(other.par_chunks(CHUNK));
    let sums: Vec<f64> = chunks.map(|(one, other)| dot(one, other)).collect();
    sums.iter().sum()
}

/// Sum of w_i a_i^2 over an array a with weights w of the same shape, by chunks on all threads.
pub(crate) fn weighted_square(weights: &[f64], values: &[f64]) -> f64 {
    let chunks = weights.par_chunks(CHUNK).zip(values.par_chunks(CHUNK));
    let of_chunk = |(weights, values): (&[f64], &[f64])| -> f64 {
        let pairs = weights.iter().zip(values);
        pairs.map(|(weight, value)| weight * value * value).sum()
    };
    let sums: Vec<f64> = chunks.map(of_chunk).collect();
    sums.iter().sum()
}

/// Sum of the values of a function for ranges of n indices, by chunks on all threads.
pub(crate) fn sum_of_chunks(n: usize, of: impl Fn(Range<usize>) -> f64 + Sync) -> f64 {
    let chunks = (0..n.div_ceil(CHUNK)).into_par_iter();
    let sums: Vec<f64> = chunks
        .map(|chunk| of(chunk * CHUNK..n.min((chunk + 1) * CHUNK)))
        .collect();
    sums.iter().sum()
}
