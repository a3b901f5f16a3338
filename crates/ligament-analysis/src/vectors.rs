//! Arithmetic on long arrays whose bits depend on nothing but the arrays: sums go in a fixed order, whatever the number of threads.

use ligament_model::subdomain::Subdomain;
use rayon::prelude::*;

/// Entries that are added up by one thread in one go.
pub(crate) const CHUNK: usize = 4096;

/// The scalar product of two arrays of the same shape, by sums of every eighth product: one after the other, additions would wait for each
/// other.
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

/// The scalar product of two arrays of the same shape, each distributed over the processes.
pub(crate) fn dot_of_all(subdomain: &Subdomain, one: &[f64], other: &[f64]) -> f64 {
    subdomain.sum(dot(one, other))
}

/// The scalar product of two arrays of the same shape, of chunks on all threads.
pub(crate) fn dot_of_chunks(one: &[f64], other: &[f64]) -> f64 {
    let chunks = one.par_chunks(CHUNK).zip(other.par_chunks(CHUNK));
    let sums: Vec<f64> = chunks.map(|(one, other)| dot(one, other)).collect();
    sums.iter().sum()
}

/// The sum of w_i a_i^2 over an array a with weights w of the same shape, of chunks on all threads.
pub(crate) fn weighted_square(weights: &[f64], values: &[f64]) -> f64 {
    let chunks = weights.par_chunks(CHUNK).zip(values.par_chunks(CHUNK));
    let of_chunk = |(weights, values): (&[f64], &[f64])| -> f64 {
        let pairs = weights.iter().zip(values);
        pairs.map(|(weight, value)| weight * value * value).sum()
    };
    let sums: Vec<f64> = chunks.map(of_chunk).collect();
    sums.iter().sum()
}
