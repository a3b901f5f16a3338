//! Numbers of the bonds of a body that processes share out, among all of its bonds.
//!
//! Each process has numbers of its own for the bonds that it knows. What is said of bonds to all of them, to observers and in checkpoints is
//! said by the number that one process alone would give the bond: bonds are in the order of their ends.

use ligament_model::Bonds;
use ligament_model::element::StiffnessFactors;
use ligament_model::portion::{Portion, counts};
use thiserror::Error;

use crate::checkpoint::CheckpointError;
use crate::serial::Serial;

/// A body has no bonds for one of the processes that share it out.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
#[error("there are more processes than the body has parts with bonds: start fewer of them")]
pub struct WithoutBonds;

/// Numbers of the bonds that a process knows among all bonds of the body.
#[derive(Debug, Clone)]
pub(crate) struct BondNumbers {
    portion: Portion,
    /// Number of each bond that is known here, ascending, shape (n_bonds).
    numbers: Vec<u32>,
    /// Whether each bond is counted here, shape (n_bonds).
    counted: Vec<bool>,
    n_all: usize,
}

impl BondNumbers {
    /// The numbers of the bonds of a body; none where one process has all of it.
    ///
    /// # Errors
    ///
    /// If a process knows no bond at all.
    pub(crate) fn new(system: &dyn Bonds) -> Result<Option<Self>, WithoutBonds> {
        let Some(portion) = system.portion() else {
            return Ok(None);
        };
        let ends = system.ends();
        if portion.any(ends.is_empty()) {
            return Err(WithoutBonds);
        }
        let counted: Vec<bool> = ends.iter().map(|&it| portion.counts(it)).collect();
        let mut of_points = vec![0.0; system.n_points()];
        for ([first, _], _) in ends.iter().zip(&counted).filter(|it| *it.1) {
            of_points[*first as usize] += 1.0;
        }
        portion.complete(&mut of_points, 1);
        let mut n_all = 0;
        let starts = of_points.into_iter().map(|count| {
            n_all += count as usize;
            n_all - count as usize
        });
        let mut next: Vec<usize> = starts.collect();
        let numbered = ends.iter().zip(&counted).map(|(&[first, _], &counted)| {
            let next = &mut next[first as usize];
            *next += usize::from(counted);
            counted.then(|| (*next - 1) as u32)
        });
        let mut numbers: Vec<Option<u32>> = numbered.collect();
        let mut told = told(portion, ends, &numbers);
        told.sort_unstable();
        for (number, ends) in numbers.iter_mut().zip(ends) {
            if number.is_none() {
                let place = told.binary_search_by(|it| it.0.cmp(ends));
                *number = place.ok().map(|place| told[place].1);
            }
        }
        let known: Vec<u32> = numbers.iter().filter_map(|it| *it).collect();
        debug_assert_eq!(known.len(), ends.len());
        Ok(Some(Self {
            portion: portion.clone(),
            numbers: known,
            counted,
            n_all,
        }))
    }

    /// The part of this process in the body.
    pub(crate) fn portion(&self) -> &Portion {
        &self.portion
    }

    /// Number of a bond that is known here.
    pub(crate) fn number(&self, bond: usize) -> u32 {
        self.numbers[bond]
    }

    /// Whether a bond that is known here is counted here.
    pub(crate) fn counts(&self, bond: usize) -> bool {
        self.counted[bond]
    }

    /// The bond with a number, if it is known here.
    pub(crate) fn known(&self, number: u32) -> Option<usize> {
        self.numbers.binary_search(&number).ok()
    }

    /// The bonds that are known here of those with some numbers.
    pub(crate) fn all_known(&self, numbers: &[u32]) -> Vec<u32> {
        let known = numbers.iter().filter_map(|&number| self.known(number));
        known.map(|bond| bond as u32).collect()
    }

    /// Marks of the bonds that are counted here among marked ones, shape (n_bonds) both.
    pub(crate) fn counted_of(&self, marked: &[bool]) -> Vec<bool> {
        let both = marked.iter().zip(&self.counted);
        both.map(|(marked, counted)| *marked && *counted).collect()
    }

    /// Reads the values of the bonds that are known here from those of all bonds of the body, without keeping these; none of none.
    ///
    /// # Errors
    ///
    /// If the bytes are damaged, or of a body with another number of bonds.
    pub(crate) fn read<T: Serial>(&self, from: &mut &[u8]) -> Result<Vec<T>, CheckpointError> {
        let count = usize::read(from)?;
        if count == 0 {
            return Ok(Vec::new());
        }
        if count != self.n_all {
            return Err(CheckpointError::OtherModel);
        }
        let mut known = Vec::with_capacity(self.numbers.len());
        let mut next = self.numbers.iter().peekable();
        let mut number = 0;
        T::read_each(count, from, |value| {
            if next.next_if_eq(&&number).is_some() {
                known.push(value);
            }
            number += 1;
        })?;
        Ok(known)
    }

    /// Number of marked bonds over all processes, of marks (n_bonds).
    pub(crate) fn count(&self, marked: impl Iterator<Item = bool>) -> usize {
        let counted = marked.zip(&self.counted);
        let here = counted.filter(|(marked, counted)| *marked && **counted);
        let mut sum = [here.count() as f64];
        self.portion.sum(&mut sum);
        sum[0] as usize
    }

    /// The values of all bonds of the body on rank 0, from those of the bonds that are known here; nothing elsewhere. Values that are the
    /// `usual` one are not told.
    pub(crate) fn of_all<T: Told<N>, const N: usize>(&self, here: &[T], usual: T) -> Vec<T> {
        let other = here.iter().enumerate();
        let other = other.filter(|(bond, value)| self.counts(*bond) && **value != usual);
        let rows = |(bond, value): (usize, &T)| {
            let number = [f64::from(self.number(bond))];
            number.into_iter().chain(value.numbers())
        };
        let rows: Vec<f64> = other.flat_map(rows).collect();
        let mut counts = vec![0.0; self.portion.exchange().n_ranks()];
        counts[self.portion.exchange().rank()] = rows.len() as f64;
        self.portion.largest(&mut counts);
        let counts: Vec<usize> = counts.into_iter().map(|it| it as usize).collect();
        let told = self.portion.exchange().gather(&rows, &counts);
        if self.portion.exchange().rank() > 0 {
            return Vec::new();
        }
        let mut all = vec![usual; self.n_all];
        for row in told.chunks_exact(1 + N) {
            let mut numbers = [0.0; N];
            numbers.copy_from_slice(&row[1..]);
            all[row[0] as usize] = T::from_numbers(numbers);
        }
        all
    }
}

/// Ends and numbers of the bonds of other ranks that end here.
fn told(portion: &Portion, ends: &[[u32; 2]], numbers: &[Option<u32>]) -> Vec<([u32; 2], u32)> {
    let numbered = ends.iter().zip(numbers);
    let across = numbered.filter_map(|(&[a, b], number)| {
        let number = number.filter(|_| !portion.is_own(b))?;
        Some([a, b, number].map(f64::from))
    });
    let across: Vec<_> = across.collect();
    let of_ranks = portion.concatenated(&across).into_iter();
    let of_ranks = of_ranks.map(|[a, b, number]| ([a as u32, b as u32], number as u32));
    let rest = of_ranks.filter(|&(ends, _)| portion.knows(ends) && !portion.counts(ends));
    rest.collect()
}

/// A value of a bond as numbers that processes exchange.
pub(crate) trait Told<const N: usize>: Copy + PartialEq {
    /// The numbers.
    fn numbers(&self) -> [f64; N];

    /// The value of some numbers.
    fn from_numbers(numbers: [f64; N]) -> Self;
}

impl Told<1> for bool {
    fn numbers(&self) -> [f64; 1] {
        [f64::from(u8::from(*self))]
    }

    fn from_numbers([number]: [f64; 1]) -> Self {
        number != 0.0
    }
}

impl Told<1> for f64 {
    fn numbers(&self) -> [f64; 1] {
        [*self]
    }

    fn from_numbers([number]: [f64; 1]) -> Self {
        number
    }
}

impl Told<1> for Option<u8> {
    fn numbers(&self) -> [f64; 1] {
        [self.map_or(-1.0, f64::from)]
    }

    fn from_numbers([number]: [f64; 1]) -> Self {
        (number >= 0.0).then_some(number as u8)
    }
}

/// Numbers that say what is left of a bond.
const OF_REMAINING: usize = 3;

impl Told<OF_REMAINING> for StiffnessFactors {
    fn numbers(&self) -> [f64; OF_REMAINING] {
        [self.axial, self.shear, self.rotational]
    }

    fn from_numbers([axial, shear, rotational]: [f64; OF_REMAINING]) -> Self {
        Self {
            axial,
            shear,
            rotational,
        }
    }
}

/// The sum of values of the bonds of a body, over all processes that share it out.
pub(crate) fn sum_over_bonds(system: &dyn Bonds, values: impl Iterator<Item = f64>) -> f64 {
    let Some(portion) = system.portion() else {
        return values.sum();
    };
    let with_ends = values.zip(system.ends());
    let counted = with_ends.filter(|(_, ends)| counts(Some(portion), **ends));
    let mut sum = [counted.map(|it| it.0).sum()];
    portion.sum(&mut sum);
    sum[0]
}
