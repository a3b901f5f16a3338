//! Arithmetic on long arrays with reproducible bits: sums are taken in a fixed order for any number of threads.

use std::ops::Range;

use ligament_model::parallel;
use ligament_model::subdomain::Subdomain;

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
    sum_of_chunks(one.len(), |it| dot(&one[it.clone()], &other[it]))
}

/// Sum of w_i a_i^2 over an array a with weights w of the same shape, by chunks on all threads.
pub(crate) fn weighted_square(weights: &[f64], values: &[f64]) -> f64 {
    sum_of_chunks(weights.len(), |it| {
        let pairs = weights[it.clone()].iter().zip(&values[it]);
        pairs.map(|(weight, value)| weight * value * value).sum()
    })
}

/// Sum of the values of a function for ranges of n indices, by chunks on all threads.
pub(crate) fn sum_of_chunks(n: usize, of: impl Fn(Range<usize>) -> f64 + Sync) -> f64 {
    let firsts = (0..n).step_by(CHUNK);
    let sums: Vec<f64> = parallel::map(firsts, |first| of(first..n.min(first + CHUNK)));
    sums.iter().sum()
}

/// Turns a direction into `conditioned` plus its share times the direction.
pub(crate) fn turn(way: &mut [f64], share: f64, conditioned: &[f64]) {
    let chunks = way.chunks_mut(CHUNK).zip(conditioned.chunks(CHUNK));
    parallel::for_each(chunks, |(way, conditioned)| {
        for (way, value) in way.iter_mut().zip(conditioned) {
            *way = value + share * *way;
        }
    });
}

/// Adds a multiple of an array to another.
pub(crate) fn add(factor: f64, of: &[f64], to: &mut [f64]) {
    parallel::for_each(to.chunks_mut(CHUNK).zip(of.chunks(CHUNK)), |(to, of)| {
        for (sum, value) in to.iter_mut().zip(of) {
            *sum += factor * value;
        }
    });
}
