//! Sums of the forces of bonds at points, in tasks of adjacent points.
//!
//! A task makes the sums at its points over all bonds that reach them, and writes nothing else. A bond that reaches points of two tasks is
//! evaluated in both. The forces at a point are added in an order that the bonds alone determine: those of a group of bonds in the order of
//! the bonds, then the groups. The sums therefore have the same bits for any number of tasks and of threads.

use std::ops::Range;

use crate::bonds::Incidence;
use crate::parallel;
use crate::subdomain::Share;
use crate::vector_registers::clear_upper_halves;

/// Number of groups of bonds.
pub(crate) const GROUPS: usize = 4;

/// Number of bonds that make a task worth while.
const TASK: usize = 4096;

/// Bonds of a group.
pub(crate) fn group(number: usize, n_bonds: usize) -> Range<usize> {
    number * n_bonds / GROUPS..(number + 1) * n_bonds / GROUPS
}

/// Sum of forces with M components at a point.
pub(crate) trait PointSum<const M: usize>: Copy + Send + Sync {
    /// Sum of no forces.
    const NONE: Self;

    /// Adds a force.
    fn add(&mut self, force: [f64; M]);

    /// Sum of two sums.
    fn plus(self, other: Self) -> Self;
}

impl<const M: usize> PointSum<M> for [f64; M] {
    const NONE: Self = [0.0; M];

    #[inline(always)]
    fn add(&mut self, force: [f64; M]) {
        *self = self.plus(force);
    }

    #[inline(always)]
    fn plus(self, other: Self) -> Self {
        std::array::from_fn(|place| self[place] + other[place])
    }
}

/// Forces of bonds.
pub(crate) trait BondForces<const M: usize>: Sync {
    /// Result of each bond beside its forces, collected once.
    type Found: Default + Send;

    /// Adds the forces of a bond at the points that the bond reaches. The task of the first end of the bond gives `found`.
    fn add(&self, bond: usize, found: Option<&mut Self::Found>, add: impl FnMut(u32, [f64; M]));
}

/// Bonds with the points that their elements reach.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Reach<'a> {
    /// Ends of the bonds, shape (n_bonds), by their first ends.
    pub(crate) ends: &'a [[u32; 2]],
    /// Bonds that reach each point, ascending.
    pub(crate) bonds: &'a Incidence,
}

impl Reach<'_> {
    /// Sums the forces at the points of a share. Overwrites `sums` (n_rows); returns what each task found, in the order of the bonds.
    pub(crate) fn sum<const M: usize, S: PointSum<M>, F: BondForces<M>>(
        self,
        share: impl Share,
        forces: &F,
        sums: &mut [S],
    ) -> Vec<F::Found> {
        let n_tasks = rayon::current_num_threads()
            .min(self.ends.len() / TASK)
            .max(1);
        self.sum_in(n_tasks, share, forces, sums)
    }

    /// Sums the forces in a number of tasks.
    fn sum_in<const M: usize, S: PointSum<M>, F: BondForces<M>>(
        self,
        n_tasks: usize,
        share: impl Share,
        forces: &F,
        sums: &mut [S],
    ) -> Vec<F::Found> {
        let mut tasks = Vec::new();
        let mut left = sums;
        for borders in self.borders(n_tasks).windows(2) {
            let points = borders[0]..borders[1];
            let n_rows = share.rows_before(points.end) - share.rows_before(points.start);
            let (sums, others) = left.split_at_mut(n_rows);
            left = others;
            tasks.push((points, sums));
        }
        let run = |(points, sums)| {
            clear_upper_halves();
            self.task(share, forces, points, sums)
        };
        parallel::map(tasks, run)
    }

    /// First points of the tasks, and the number of points: about as many bonds begin in each task.
    fn borders(&self, n_tasks: usize) -> Vec<u32> {
        let (n_points, n_bonds) = (self.bonds.n_points(), self.ends.len());
        let inner = (1..n_tasks).map(|task| self.ends[task * n_bonds / n_tasks][0]);
        let mut borders: Vec<u32> = std::iter::once(0).chain(inner).collect();
        borders.push(n_points as u32);
        borders.dedup();
        borders
    }

    /// Number of bonds that begin at points before a point.
    fn bonds_before(&self, point: u32) -> usize {
        self.ends.partition_point(|[first, _]| *first < point)
    }

    /// Bonds of other tasks that reach the points of a task, before and after its `own` bonds, ascending.
    fn bonds_of_other_tasks(
        &self,
        share: impl Share,
        points: &Range<u32>,
        own: &Range<usize>,
    ) -> [Vec<u32>; 2] {
        let [mut before, mut after] = [Vec::new(), Vec::new()];
        for point in points.clone().filter(|it| share.row(*it).is_some()) {
            // Most points have bonds of their task alone: the first and the last one of a point show that.
            let bonds = self.bonds.at(point);
            if bonds.first().is_some_and(|it| (*it as usize) < own.start) {
                before.extend(numbers_in(bonds, &(0..own.start)));
            }
            if bonds.last().is_some_and(|it| *it as usize >= own.end) {
                after.extend(numbers_in(bonds, &(own.end..self.ends.len())));
            }
        }
        [before, after].map(|mut bonds| {
            bonds.sort_unstable();
            bonds.dedup();
            bonds
        })
    }

    /// Sums the forces at points; `sums` has a row for each point of the share.
    fn task<const M: usize, S: PointSum<M>, F: BondForces<M>>(
        self,
        share: impl Share,
        forces: &F,
        points: Range<u32>,
        sums: &mut [S],
    ) -> F::Found {
        let own = self.bonds_before(points.start)..self.bonds_before(points.end);
        let [before, after] = self.bonds_of_other_tasks(share, &points, &own);
        let first_row = share.rows_before(points.start);
        let mut found = F::Found::default();
        let mut of_group = Vec::new();
        sums.fill(S::NONE);
        for number in 0..GROUPS {
            let group = group(number, self.ends.len());
            // Sums of the first group are the sums so far.
            let sums_of_group = match number {
                0 => &mut *sums,
                _ => {
                    of_group.clear();
                    of_group.resize(sums.len(), S::NONE);
                    &mut *of_group
                }
            };
            let mut add = |bond: usize, found: Option<&mut F::Found>| {
                forces.add(bond, found, |point, force| {
                    if points.contains(&point)
                        && let Some(row) = share.row(point)
                    {
                        sums_of_group[row - first_row].add(force);
                    }
                });
            };
            for bond in numbers_in(&before, &group) {
                add(*bond as usize, None);
            }
            for bond in group.start.max(own.start)..group.end.min(own.end) {
                add(bond, Some(&mut found));
            }
            for bond in numbers_in(&after, &group) {
                add(*bond as usize, None);
            }
            if number > 0 {
                for (sum, of_group) in sums.iter_mut().zip(&of_group) {
                    *sum = sum.plus(*of_group);
                }
            }
        }
        found
    }
}

/// Numbers of an ascending list within a range.
fn numbers_in<'a>(list: &'a [u32], range: &Range<usize>) -> &'a [u32] {
    let first = list.partition_point(|it| (*it as usize) < range.start);
    let length = list[first..].partition_point(|it| (*it as usize) < range.end);
    &list[first..first + length]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::communicator::SingleProcess;
    use crate::subdomain::{Partition, Subdomain, Whole};
    use std::collections::BTreeSet;
    use std::sync::Arc;
    use std::sync::atomic::{AtomicUsize, Ordering};

    /// Forces of one component that rounding tells apart, at up to six points of each bond.
    struct Forces {
        points: Vec<Vec<u32>>,
        evaluations: AtomicUsize,
    }

    impl BondForces<1> for Forces {
        type Found = Vec<usize>;

        fn add(
            &self,
            bond: usize,
            found: Option<&mut Vec<usize>>,
            mut add: impl FnMut(u32, [f64; 1]),
        ) {
            self.evaluations.fetch_add(1, Ordering::Relaxed);
            if let Some(found) = found {
                found.push(bond);
            }
            for (place, point) in self.points[bond].iter().enumerate() {
                add(*point, [1.0 / (1.0 + (7 * bond + place) as f64)]);
            }
        }
    }

    /// Bonds between points whose numbers differ by at most nine, some of which reach points beyond their ends.
    fn bonds(n_points: u32) -> (Vec<[u32; 2]>, Forces) {
        let ends: Vec<[u32; 2]> = (0..n_points)
            .flat_map(|a| (a + 1..n_points.min(a + 10)).map(move |b| [a, b]))
            .collect();
        let reached = |(bond, [a, b]): (usize, &[u32; 2])| match bond % 3 {
            0 => vec![*a, *b],
            _ => vec![*b, *a, (a + 40) % n_points, a / 2],
        };
        let points = ends.iter().enumerate().map(reached).collect();
        let evaluations = AtomicUsize::new(0);
        (
            ends,
            Forces {
                points,
                evaluations,
            },
        )
    }

    fn reaching(forces: &Forces, n_points: usize) -> Incidence {
        let of_bonds = forces.points.iter().enumerate().flat_map(|(bond, points)| {
            let mut points = points.clone();
            points.sort_unstable();
            points.dedup();
            points.into_iter().map(move |point| (point, bond as u32))
        });
        Incidence::from_pairs(of_bonds.collect::<Vec<_>>().into_iter(), n_points)
    }

    #[test]
    fn sums_have_the_bits_of_groups_summed_bond_by_bond_in_any_number_of_tasks() {
        let n_points = 97;
        let (ends, forces) = bonds(n_points as u32);
        let bonds = reaching(&forces, n_points);
        let mut expected = vec![0.0; n_points];
        for number in 0..GROUPS {
            let mut of_group = vec![0.0; n_points];
            for bond in group(number, ends.len()) {
                forces.add(bond, None, |point, [force]| {
                    of_group[point as usize] += force
                });
            }
            for (sum, of_group) in expected.iter_mut().zip(of_group) {
                *sum += of_group;
            }
        }
        let reach = Reach {
            ends: &ends,
            bonds: &bonds,
        };
        for n_tasks in [1, 2, 3, 7, 30, 500] {
            let mut sums = vec![[f64::NAN]; n_points];
            let found = reach.sum_in(n_tasks, Whole, &forces, &mut sums).concat();
            assert_eq!(sums.as_flattened(), expected, "{n_tasks} tasks");
            assert_eq!(
                found,
                (0..ends.len()).collect::<Vec<_>>(),
                "{n_tasks} tasks"
            );
        }
    }

    #[test]
    fn a_task_evaluates_each_bond_that_reaches_it_once() {
        let n_points = 97;
        let (ends, forces) = bonds(n_points as u32);
        let bonds = reaching(&forces, n_points);
        let reach = Reach {
            ends: &ends,
            bonds: &bonds,
        };
        for n_tasks in [1, 2, 7] {
            let borders = reach.borders(n_tasks);
            let task = |point: &u32| borders.partition_point(|border| border <= point);
            let of_bond = |points: &Vec<u32>| points.iter().map(task).collect::<BTreeSet<_>>();
            let expected: usize = forces.points.iter().map(|it| of_bond(it).len()).sum();
            forces.evaluations.store(0, Ordering::Relaxed);
            reach.sum_in(n_tasks, Whole, &forces, &mut vec![[0.0]; n_points]);
            let evaluations = forces.evaluations.load(Ordering::Relaxed);
            assert_eq!(evaluations, expected, "{n_tasks} tasks");
        }
    }

    #[test]
    fn a_share_has_the_sums_at_its_own_points() {
        let n_points = 60;
        let (ends, forces) = bonds(n_points as u32);
        let bonds = reaching(&forces, n_points);
        let reach = Reach {
            ends: &ends,
            bonds: &bonds,
        };
        let mut all = vec![[0.0]; n_points];
        reach.sum_in(1, Whole, &forces, &mut all);
        // Every second point belongs to the first of two processes.
        let even_first = |points: &mut [u32]| points.sort_unstable_by_key(|it| (it % 2, *it));
        let partition = Partition::new(n_points, 2, &even_first);
        let subdomain = Subdomain::new(partition, Arc::new(SingleProcess));
        let owned: Vec<u32> = subdomain.owned().collect();
        assert_eq!(owned.len(), n_points / 2);
        for n_tasks in [1, 4, 11] {
            let mut sums = vec![[f64::NAN]; owned.len()];
            reach.sum_in(n_tasks, &subdomain, &forces, &mut sums);
            let expected: Vec<[f64; 1]> = owned.iter().map(|it| all[*it as usize]).collect();
            assert_eq!(sums, expected, "{n_tasks} tasks");
        }
    }
}
