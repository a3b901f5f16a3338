//! Lists over the points, unknowns or bonds of a body in a checkpoint; each process has some of their values.
//!
//! Rank 0 receives the values in slices and writes each slice before the next arrives; a reader keeps only its own values. So no process
//! has a list over the whole body.

use std::io::Read;
use std::iter;

use ligament_model::communicator::Wire;
use ligament_model::subdomain::Subdomain;

use crate::serial::{Damaged, SLICE, Serial, Sink, read_values, write_values};

/// Appends a list of `n_all` values, each with its index from the process that owns it (ascending on each), and `usual` where no process has
/// one. Rank 0 alone appends bytes; collective.
pub fn write_by_index<T, const N: usize>(
    subdomain: &Subdomain,
    n_all: usize,
    own: impl Iterator<Item = (usize, T)>,
    usual: T,
    out: &mut dyn Sink,
) where
    T: Serial + Wire<N> + Copy,
{
    n_all.write(out);
    let mut own = own.peekable();
    for begin in (0..n_all).step_by(SLICE) {
        let end = n_all.min(begin + SLICE);
        let here = iter::from_fn(|| own.next_if(|(index, _)| *index < end));
        let rows = on_root(subdomain, here);
        if subdomain.communicator().is_root() {
            let mut slice = vec![usual; end - begin];
            rows.for_each(|(index, value)| slice[index - begin] = value);
            write_values(&slice, &usual, out);
        }
    }
}

/// Reads a list of `count` values with a usual value, and returns the values with some indices (ascending).
///
/// # Errors
///
/// If the bytes are damaged.
pub fn read_by_index<T: Serial + Clone>(
    count: usize,
    usual: &T,
    indices: impl Iterator<Item = usize>,
    from: &mut dyn Read,
) -> Result<Vec<T>, Damaged> {
    let mut kept = Vec::new();
    let (mut next, mut index) = (indices.peekable(), 0);
    read_values(count, usual, from, |value| {
        if next.next_if_eq(&index).is_some() {
            kept.push(value);
        }
        index += 1;
    })?;
    Ok(kept)
}

/// Appends the number of rows of all processes and the rows, a number and a value each, in the order of the ranks. Rank 0 alone appends bytes;
/// collective.
pub fn write_rows<T, const N: usize>(
    subdomain: &Subdomain,
    own: impl Iterator<Item = (usize, T)> + Clone,
    out: &mut dyn Sink,
) where
    T: Serial + Wire<N>,
{
    let n_own = own.clone().count() as f64;
    let counts: Vec<f64> = subdomain.all_gather_list(vec![n_own]);
    let counts = counts.into_iter().map(|it| it as usize);
    counts.clone().sum::<usize>().write(out);
    let mut own = own;
    for (rank, count) in counts.enumerate() {
        let is_own = rank == subdomain.communicator().rank();
        for _ in 0..count.div_ceil(SLICE) {
            let here = own.by_ref().take(if is_own { SLICE } else { 0 });
            for (number, value) in on_root(subdomain, here) {
                (number as u32).write(out);
                value.write(out);
            }
        }
    }
}

/// Numbered values of all processes on rank 0, in the order of their ranks, and none on other ranks; collective.
fn on_root<T: Wire<N>, const N: usize>(
    subdomain: &Subdomain,
    numbered: impl Iterator<Item = (usize, T)>,
) -> impl Iterator<Item = (usize, T)> {
    let rows = numbered.flat_map(|(number, value)| {
        let number = [number as f64];
        number.into_iter().chain(value.numbers())
    });
    let mut received = subdomain
        .gather_list(rows.collect::<Vec<f64>>())
        .into_iter();
    iter::from_fn(move || {
        let number = received.next()? as usize;
        let mut numbers = [0.0; N];
        numbers
            .iter_mut()
            .zip(&mut received)
            .for_each(|(to, it)| *to = it);
        Some((number, T::from_numbers(numbers)))
    })
}
