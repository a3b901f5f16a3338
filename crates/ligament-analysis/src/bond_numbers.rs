//! Global numbers of the bonds on a process.
//!
//! Observers and checkpoints refer to a bond by its global number, as on one process alone: bonds are in the order of their ends. A
//! process that stores some of the bonds has local numbers for them.

use std::borrow::Cow;
use std::io::Read;

use ligament_model::Bonds;
use ligament_model::communicator::Wire;
use ligament_model::prefix_sums::exclusive_prefix_sums;
use ligament_model::subdomain::Subdomain;
use thiserror::Error;

use crate::checkpoint::CheckpointError;
use crate::lists_of_all::{read_by_index, write_by_index, write_rows};
use crate::serial::{Damaged, Serial, Sink, read_values, write_values};

/// Bit that marks a list of several processes in a checkpoint, beside the number of bonds of the body.
const SPARSE: u64 = 1 << 63;

/// Error of a divided body without any bond on one of the processes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
#[error("there are more processes than the body has parts with bonds: start fewer of them")]
pub struct WithoutBonds;

/// Global numbers of the bonds on a process; equal to the local numbers where one process stores all bonds.
#[derive(Debug, Clone)]
pub struct BondNumbers {
    subdomain: Subdomain,
    held: StoredBonds,
}

/// Bonds stored by a process.
#[derive(Debug, Clone)]
enum StoredBonds {
    /// All bonds of the body, with their number.
    All(usize),
    /// Bonds at owned points.
    Some(LocalBonds),
}

#[derive(Debug, Clone)]
struct LocalBonds {
    /// Global number of each bond, ascending, shape (n_bonds).
    numbers: Vec<u32>,
    /// Whether the process owns each bond, shape (n_bonds).
    is_owned: Vec<bool>,
    /// Number of bonds of the body.
    n_all: usize,
}

impl BondNumbers {
    /// Numbers of the bonds of a body of `n_points` points on one process, whose values no checkpoint has.
    pub fn whole(n_points: usize) -> Self {
        Self {
            subdomain: Subdomain::whole(n_points),
            held: StoredBonds::All(0),
        }
    }

    /// Numbers the bonds of a body; collective.
    ///
    /// # Errors
    ///
    /// If a process stores no bond of a divided body.
    pub(crate) fn new(system: &dyn Bonds) -> Result<Self, WithoutBonds> {
        let (subdomain, ends) = (&system.subdomain, &system.ends);
        let held = if subdomain.is_whole() {
            StoredBonds::All(ends.len())
        } else if subdomain.any(ends.is_empty()) {
            return Err(WithoutBonds);
        } else {
            StoredBonds::Some(LocalBonds::new(subdomain, ends))
        };
        Ok(Self {
            subdomain: subdomain.clone(),
            held,
        })
    }

    /// Points and bonds of the body on this process.
    pub(crate) fn subdomain(&self) -> &Subdomain {
        &self.subdomain
    }

    /// Global number of a local bond.
    pub(crate) fn number(&self, bond: u32) -> u32 {
        match &self.held {
            StoredBonds::All(_) => bond,
            StoredBonds::Some(it) => it.numbers[bond as usize],
        }
    }

    /// Whether this process owns a local bond.
    pub(crate) fn owns(&self, bond: usize) -> bool {
        match &self.held {
            StoredBonds::All(_) => true,
            StoredBonds::Some(it) => it.is_owned[bond],
        }
    }

    /// Local bond with a global number, if this process stores it.
    pub(crate) fn local(&self, number: u32) -> Option<usize> {
        match &self.held {
            StoredBonds::All(_) => Some(number as usize),
            StoredBonds::Some(it) => it.numbers.binary_search(&number).ok(),
        }
    }

    /// Local bonds among those with some global numbers.
    pub(crate) fn all_local<'a>(&self, numbers: &'a [u32]) -> Cow<'a, [u32]> {
        match &self.held {
            StoredBonds::All(_) => Cow::Borrowed(numbers),
            StoredBonds::Some(_) => {
                let local = numbers.iter().filter_map(|&number| self.local(number));
                local.map(|bond| bond as u32).collect()
            }
        }
    }

    /// Marks of the owned bonds among marked ones, both of shape (n_bonds).
    pub(crate) fn owned_of<'a>(&self, marked: &'a [bool]) -> Cow<'a, [bool]> {
        match &self.held {
            StoredBonds::All(_) => Cow::Borrowed(marked),
            StoredBonds::Some(it) => {
                let both = marked.iter().zip(&it.is_owned);
                both.map(|(marked, is_owned)| *marked && *is_owned)
                    .collect()
            }
        }
    }

    /// Number of marked bonds over all processes, from marks (n_bonds).
    pub(crate) fn count(&self, marked: impl Iterator<Item = bool>) -> usize {
        let owned = marked.enumerate().filter(|(bond, _)| self.owns(*bond));
        self.subdomain.count(owned.filter(|it| it.1).count())
    }

    /// Reads the values of all bonds of the body, and returns the values of the local bonds (n_bonds). A `usual` value takes one bit; an
    /// empty list stays empty.
    ///
    /// # Errors
    ///
    /// If the bytes are damaged, or belong to a body with another number of bonds.
    pub(crate) fn read<T: Serial + Clone>(
        &self,
        usual: T,
        from: &mut dyn Read,
    ) -> Result<Vec<T>, CheckpointError> {
        let header = u64::read(from)?;
        if header >= SPARSE {
            return self.read_sparse(header - SPARSE, usual, from);
        }
        let count = usize::try_from(header).map_err(|_| Damaged)?;
        match &self.held {
            StoredBonds::Some(it) if count > 0 => {
                if count != it.n_all {
                    return Err(CheckpointError::OtherModel);
                }
                let numbers = it.numbers.iter().map(|&number| number as usize);
                Ok(read_by_index(count, &usual, numbers, from)?)
            }
            StoredBonds::All(_) | StoredBonds::Some(_) => Ok(all(count, &usual, from)?),
        }
    }

    /// Reads a list of several processes, which has the unusual values with the numbers of their bonds.
    fn read_sparse<T: Serial + Clone>(
        &self,
        count: u64,
        usual: T,
        from: &mut dyn Read,
    ) -> Result<Vec<T>, CheckpointError> {
        let rows = usize::read(from)?;
        let (n_all, n_bonds) = match &self.held {
            StoredBonds::All(n_bonds) => (*n_bonds, *n_bonds),
            StoredBonds::Some(it) => (it.n_all, it.numbers.len()),
        };
        if count != n_all as u64 {
            return Err(CheckpointError::OtherModel);
        }
        let mut local = vec![usual; n_bonds];
        for _ in 0..rows {
            let (number, value) = (u32::read(from)?, T::read(from)?);
            let own = self.local(number).and_then(|it| local.get_mut(it));
            own.into_iter().for_each(|it| *it = value.clone());
        }
        Ok(local)
    }

    /// Reads values at all points of the body, as many per point as `n_values`, and returns the values of the local points.
    ///
    /// # Errors
    ///
    /// If the bytes are damaged, or belong to a body with another number of points.
    pub(crate) fn read_points<T: Serial + Clone>(
        &self,
        n_values: usize,
        usual: T,
        from: &mut dyn Read,
    ) -> Result<Vec<T>, CheckpointError> {
        let subdomain = &self.subdomain;
        let count = usize::read(from)?;
        if subdomain.is_whole() {
            return Ok(all(count, &usual, from)?);
        }
        if count != n_values * subdomain.n_all() {
            return Err(CheckpointError::OtherModel);
        }
        let local = 0..n_values * subdomain.n_points();
        let indices = local.map(|index| subdomain.index_in_body(index, n_values));
        Ok(read_by_index(count, &usual, indices, from)?)
    }

    /// Appends values at all points of the body, as many per point as `n_values`, from the values at the local points; on a divided body
    /// rank 0 writes them and the others an empty list. Values equal to `usual` are not sent. Collective.
    pub(crate) fn write_points<T, const N: usize>(
        &self,
        (local, n_values): (&[T], usize),
        usual: T,
        out: &mut dyn Sink,
    ) where
        T: Serial + Wire<N> + Copy + PartialEq,
    {
        let subdomain = &self.subdomain;
        if subdomain.is_whole() {
            return write_all(local, &usual, out);
        }
        let of_point = |point: u32| n_values * point as usize..n_values * (point as usize + 1);
        let owned = subdomain.owned().flat_map(of_point);
        let numbered = owned
            .filter(|&index| local[index] != usual)
            .map(|index| (subdomain.index_in_body(index, n_values), local[index]));
        write_by_index(
            subdomain,
            n_values * subdomain.n_all(),
            numbered,
            usual,
            out,
        );
    }

    /// Appends the values of all bonds of the body, from the values of the local bonds (n_bonds); on a divided body rank 0 writes the
    /// values that are not `usual`, with the numbers of their bonds. Collective.
    pub(crate) fn write<T, const N: usize>(&self, local: &[T], usual: T, out: &mut dyn Sink)
    where
        T: Serial + Wire<N> + Copy + PartialEq,
    {
        match &self.held {
            StoredBonds::Some(it) if !local.is_empty() => {
                let bonds = 0..local.len();
                let unusual = bonds.filter(|&bond| it.is_owned[bond] && local[bond] != usual);
                let rows = unusual.map(|bond| (it.numbers[bond] as usize, local[bond]));
                (SPARSE + it.n_all as u64).write(out);
                write_rows(&self.subdomain, rows, out);
            }
            StoredBonds::All(_) | StoredBonds::Some(_) => write_all(local, &usual, out),
        }
    }
}

/// Appends a list with its length. The value `usual`, which most entries have, takes one bit.
fn write_all<T: Serial>(values: &[T], usual: &T, out: &mut dyn Sink) {
    values.len().write(out);
    write_values(values, usual, out);
}

/// Reads a list of `count` values, as [`write_values`] wrote it.
fn all<T: Serial + Clone>(count: usize, usual: &T, from: &mut dyn Read) -> Result<Vec<T>, Damaged> {
    let mut values = Vec::new();
    read_values(count, usual, from, |value| values.push(value))?;
    Ok(values)
}

impl LocalBonds {
    /// Numbers the local bonds in the order of all ends; collective.
    fn new(subdomain: &Subdomain, ends: &[[u32; 2]]) -> Self {
        let is_owned: Vec<bool> = ends.iter().map(|&it| subdomain.owns_bond(it)).collect();
        let mut of_points = vec![0.0; subdomain.n_owned()];
        let first_rows = ends.iter().filter_map(|[first, _]| subdomain.row(*first));
        first_rows.for_each(|row| of_points[row] += 1.0);
        let starts = exclusive_prefix_sums(subdomain, &of_points);
        let n_all = subdomain.sum(of_points.iter().sum()) as usize;
        let mut next: Vec<usize> = starts.into_iter().map(|it| it as usize).collect();
        let numbered = ends.iter().map(|&[first, _]| {
            let next = &mut next[subdomain.row(first)?];
            *next += 1;
            Some((*next - 1) as u32)
        });
        let mut numbers: Vec<Option<u32>> = numbered.collect();
        let mut received = received(subdomain, ends, &numbers);
        received.sort_unstable();
        for (number, ends) in numbers.iter_mut().zip(ends) {
            if number.is_none() {
                let place = received.binary_search_by(|[a, b, _]| [*a, *b].cmp(ends));
                *number = place.ok().map(|place| received[place][2]);
            }
        }
        let numbers: Vec<u32> = numbers.iter().filter_map(|it| *it).collect();
        debug_assert_eq!(numbers.len(), ends.len());
        Self {
            numbers,
            is_owned,
            n_all,
        }
    }
}

/// Ends and global numbers of local bonds that other ranks own, from their owners.
fn received(subdomain: &Subdomain, ends: &[[u32; 2]], numbers: &[Option<u32>]) -> Vec<[u32; 3]> {
    let numbered = ends.iter().zip(numbers);
    let across = numbered.filter_map(|(&[a, b], number)| {
        let number = number.filter(|_| !subdomain.owns(b))?;
        let [a, b_in_body] = subdomain.numbers([a, b]);
        Some((subdomain.rank(b), [a, b_in_body, number]))
    });
    let received = subdomain.send(across.collect()).into_iter();
    let local = |[a, b, number]: [u32; 3]| {
        let [a, b] = [a, b].map(|end| subdomain.point(end));
        Some([a?, b?, number])
    };
    received.filter_map(local).collect()
}

/// Sum of values of the bonds of a body (n_bonds), over all processes.
pub(crate) fn sum_over_bonds(system: &dyn Bonds, values: impl Iterator<Item = f64>) -> f64 {
    let subdomain = &system.subdomain;
    let with_ends = values.zip(system.ends.iter());
    let owned = with_ends.filter(|(_, ends)| subdomain.owns_bond(**ends));
    subdomain.sum(owned.map(|it| it.0).sum())
}

/// Adds values of the bonds of a body (n_bonds) to a sum, over all processes; on one process one by one.
pub(crate) fn add_over_bonds(system: &dyn Bonds, sum: &mut f64, values: impl Iterator<Item = f64>) {
    match system.subdomain.is_whole() {
        true => values.for_each(|value| *sum += value),
        false => *sum += sum_over_bonds(system, values),
    }
}
