//! Coarse equations solved by conjugate gradients, with the blocks of the aggregates and a coarser space as preconditioner.
//!
//! The factor of E takes the time of n^2 and the memory of n^(4/3) for n aggregates in space (George 1973), more than all else from some
//! thousands on. The preconditioner of the works w is B^-1 w + S (S^T E S)^-1 S^T w, with the blocks B of the aggregates on the diagonal of E
//! and the rigid motions S of clusters (a coarse space, Nicolaides 1987), which are so few that their factor costs nothing.

use ligament_linalg::{FactorError, RankOne};
use ligament_model::parallel;

use super::clusters::Clusters;
use super::coarse_factor::CoarseFactor;
use super::coarse_stiffness::{CoarseEquations, CoarseStiffness};
use super::point_blocks::invert_without_vanishing;
use crate::vectors::{add, dot_of_chunks, turn};

/// Residual of the coarse equations in the norm of the preconditioner, relative to the works: the first level takes as many iterations as
/// with a factor, and a tenth more with 1e-1.
const TOLERANCE: f64 = 1e-2;

/// Largest number of iterations.
const ITERATION_LIMIT: usize = 200;

/// Least number of aggregates of a parallel task.
const TASK: usize = 64;

/// Coarse equations by conjugate gradients.
pub(super) struct CoarseIteration {
    n_motions: usize,
    /// Beginning of each block row of E in `columns`, shape (n_aggregates + 1).
    starts: Vec<usize>,
    /// Aggregates of the columns of the blocks of a row, ascending.
    columns: Vec<u32>,
    /// Blocks of E, of both triangles, in single precision, shape (n_blocks, n_motions, n_motions).
    blocks: Vec<f32>,
    /// Inverse of the block of each aggregate, zero for motions without stiffness, shape (n_aggregates, n_motions, n_motions).
    inverses: Vec<f64>,
    clusters: Clusters,
    coarsest: CoarseFactor,
}

impl CoarseIteration {
    /// Equations of a coarse space with the clusters of its aggregates.
    ///
    /// # Errors
    ///
    /// If the factor of the clusters does not fit into memory.
    pub(super) fn new(
        stiffness: &CoarseStiffness,
        clusters: Clusters,
    ) -> Result<Self, FactorError> {
        let coarsest = CoarseFactor::new(&clusters.stiffness(stiffness))?;
        let n = stiffness.n_motions;
        let mut places: Vec<Vec<u32>> = vec![Vec::new(); stiffness.blocks.len()];
        for ([first, second], _) in stiffness.blocks.iter().flatten() {
            places[*first as usize].push(*second);
            places[*second as usize].push(*first);
        }
        let (mut starts, mut columns) = (vec![0], Vec::new());
        for (aggregate, mut of_row) in places.into_iter().enumerate() {
            of_row.push(aggregate as u32);
            of_row.sort_unstable();
            of_row.dedup();
            columns.extend(of_row);
            starts.push(columns.len());
        }
        let mut equations = Self {
            n_motions: n,
            blocks: vec![0.0; columns.len() * n * n],
            inverses: vec![0.0; stiffness.blocks.len() * n * n],
            starts,
            columns,
            clusters,
            coarsest,
        };
        for ([first, second], block) in stiffness.blocks.iter().flatten() {
            equations.add([*first, *second], |row, column| block[row * n + column]);
        }
        for aggregate in 0..stiffness.blocks.len() {
            equations.invert(aggregate);
        }
        Ok(equations)
    }

    /// Place of the block of two aggregates, if E has one.
    fn place(&self, row: u32, column: u32) -> Option<usize> {
        let start = self.starts[row as usize];
        let of_row = &self.columns[start..self.starts[row as usize + 1]];
        Some(start + of_row.binary_search(&column).ok()?)
    }

    /// Adds values by motions of two aggregates to their block and its transpose. Returns whether E has such blocks.
    fn add(&mut self, [first, second]: [u32; 2], value: impl Fn(usize, usize) -> f64) -> bool {
        let n = self.n_motions;
        let Some(place) = self.place(first, second) else {
            return false;
        };
        let block = &mut self.blocks[n * n * place..n * n * (place + 1)];
        for (place, sum) in block.iter_mut().enumerate() {
            *sum = (f64::from(*sum) + value(place / n, place % n)) as f32;
        }
        match self.place(second, first) {
            Some(transposed) if first != second => {
                let block = &mut self.blocks[n * n * transposed..n * n * (transposed + 1)];
                for (place, sum) in block.iter_mut().enumerate() {
                    *sum = (f64::from(*sum) + value(place % n, place / n)) as f32;
                }
                true
            }
            transposed => transposed.is_some(),
        }
    }

    /// Inverts the block of an aggregate.
    fn invert(&mut self, aggregate: usize) {
        let size = self.n_motions * self.n_motions;
        let Some(place) = self.place(aggregate as u32, aggregate as u32) else {
            return;
        };
        let block = &self.blocks[size * place..size * (place + 1)];
        let block: Vec<f64> = block.iter().map(|it| f64::from(*it)).collect();
        let inverse = &mut self.inverses[size * aggregate..size * (aggregate + 1)];
        invert_without_vanishing(self.n_motions, &block, inverse);
    }

    /// Product E a of amounts a (n_aggregates, n_motions).
    fn product(&self, amounts: &[f64]) -> Vec<f64> {
        match self.n_motions {
            3 => self.product_of::<3>(amounts),
            6 => self.product_of::<6>(amounts),
            n => unreachable!("no body has {n} rigid motions"),
        }
    }

    fn product_of<const N: usize>(&self, amounts: &[f64]) -> Vec<f64> {
        let blocks = self.blocks.as_chunks::<N>().0.as_chunks::<N>().0;
        let amounts = amounts.as_chunks::<N>().0;
        let mut product = vec![0.0; N * amounts.len()];
        let tasks = product.as_chunks_mut::<N>().0.chunks_mut(TASK).enumerate();
        parallel::for_each(tasks, |(task, of_task)| {
            for (aggregate, works) in (task * TASK..).zip(of_task) {
                let range = self.starts[aggregate]..self.starts[aggregate + 1];
                for (&column, block) in self.columns[range.clone()].iter().zip(&blocks[range]) {
                    let amounts = &amounts[column as usize];
                    for (row, work) in works.iter_mut().enumerate() {
                        for (value, amount) in block[row].iter().zip(amounts) {
                            *work += f64::from(*value) * amount;
                        }
                    }
                }
            }
        });
        product
    }

    /// Sum of the solutions of the blocks of the aggregates and of the clusters for works (n_aggregates, n_motions).
    fn conditioned(&mut self, works: &[f64]) -> Vec<f64> {
        let n = self.n_motions;
        let mut of_clusters = self.clusters.works(works);
        self.coarsest.solve(&mut of_clusters);
        let mut amounts = vec![0.0; works.len()];
        parallel::for_each(
            amounts.chunks_mut(TASK * n).enumerate(),
            |(task, of_task)| {
                for (aggregate, amounts) in (task * TASK..).zip(of_task.chunks_mut(n)) {
                    let works = &works[n * aggregate..][..n];
                    let inverse = &self.inverses[n * n * aggregate..][..n * n];
                    for (amount, row) in amounts.iter_mut().zip(inverse.chunks_exact(n)) {
                        *amount = row.iter().zip(works).map(|(a, b)| a * b).sum();
                    }
                    self.clusters.add_amounts(aggregate, &of_clusters, amounts);
                }
            },
        );
        amounts
    }
}

impl CoarseEquations for CoarseIteration {
    fn solve(&mut self, works: &mut Vec<f64>) {
        let mut amounts = vec![0.0; works.len()];
        let mut way = self.conditioned(works);
        let mut left = dot_of_chunks(&way, works);
        let limit = TOLERANCE * TOLERANCE * left;
        for _ in 0..ITERATION_LIMIT {
            let pushed = self.product(&way);
            let curvature = dot_of_chunks(&way, &pushed);
            // Also where the works, and with them the way, are zero.
            if curvature.is_nan() || curvature <= 0.0 {
                break;
            }
            let step = left / curvature;
            add(step, &way, &mut amounts);
            add(-step, &pushed, works);
            let conditioned = self.conditioned(works);
            let next = dot_of_chunks(&conditioned, works);
            if next.is_nan() || next <= limit {
                break;
            }
            let share = next / left;
            left = next;
            turn(&mut way, share, &conditioned);
        }
        *works = amounts;
    }

    fn change(&mut self, terms: &[RankOne]) -> bool {
        let n = self.n_motions;
        let mut changed = Vec::new();
        for term in terms {
            let of_aggregates: Vec<_> = (term.entries)
                .chunk_by(|a, b| a.0 / n == b.0 / n)
                .map(|entries| {
                    let mut works = vec![0.0; n];
                    entries.iter().for_each(|(it, work)| works[it % n] = *work);
                    ((entries[0].0 / n) as u32, works)
                })
                .collect();
            for (place, (second, other)) in of_aggregates.iter().enumerate() {
                for (first, one) in &of_aggregates[..=place] {
                    let value = |row: usize, column: usize| term.weight * one[row] * other[column];
                    if !self.add([*first, *second], value) {
                        return false;
                    }
                }
                changed.push(*second);
            }
        }
        changed.sort_unstable();
        changed.dedup();
        changed.into_iter().for_each(|it| self.invert(it as usize));
        let of_clusters: Vec<RankOne> = terms.iter().map(|it| self.clusters.term(it)).collect();
        self.coarsest.change(&of_clusters)
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]
mod tests {
    use super::*;

    const AGGREGATES: usize = 60;
    const MOTIONS: usize = 3;

    /// Terms of a chain of aggregates, whose ends are held, with couplings of neighbours and of their neighbours.
    fn terms() -> Vec<RankOne> {
        let term = |weight: f64, entries: &[(usize, f64)]| RankOne {
            weight,
            entries: entries.to_vec(),
        };
        let mut terms = Vec::new();
        for motion in 0..MOTIONS {
            for end in [0, AGGREGATES - 1] {
                terms.push(term(1.0, &[(MOTIONS * end + motion, 1.0)]));
            }
        }
        for reach in [1, 2] {
            for first in 0..AGGREGATES - reach {
                let [a, b] = [first, first + reach].map(|it| MOTIONS * it);
                terms.push(term(2.0, &[(a, 1.0), (b, -1.0)]));
                terms.push(term(
                    1.5,
                    &[(a + 1, 1.0), (a + 2, 0.3), (b + 1, -1.0), (b + 2, -0.3)],
                ));
                terms.push(term(
                    1.0,
                    &[(a, 0.1), (a + 2, 1.0), (b, -0.1), (b + 2, -1.0)],
                ));
            }
        }
        terms
    }

    /// Every seventh of the terms, or all others.
    fn every_seventh(is_seventh: bool) -> Vec<RankOne> {
        let terms = terms().into_iter().enumerate();
        let chosen = terms.filter(|(number, _)| (number % 7 == 6) == is_seventh);
        chosen.map(|(_, term)| term).collect()
    }

    /// Stiffness of terms.
    fn stiffness(terms: &[RankOne]) -> CoarseStiffness {
        let n = MOTIONS;
        let mut blocks = vec![Vec::new(); AGGREGATES];
        for term in terms {
            for &(column, one) in &term.entries {
                for &(row, other) in &term.entries {
                    let [first, second] = [row / n, column / n];
                    if first <= second {
                        let mut block = vec![0.0; n * n];
                        block[row % n * n + column % n] = term.weight * one * other;
                        blocks[second].push(([first as u32, second as u32], block));
                    }
                }
            }
        }
        CoarseStiffness {
            n_motions: n,
            blocks,
        }
    }

    /// Clusters of ten aggregates each, which move together.
    fn clusters() -> Clusters {
        let mut unit = [0.0; MOTIONS * MOTIONS];
        (0..MOTIONS).for_each(|motion| unit[motion * (MOTIONS + 1)] = 1.0);
        let of_aggregate: Vec<u32> = (0..AGGREGATES as u32).map(|it| it / 10).collect();
        let aggregates = (0..AGGREGATES as u32).collect::<Vec<u32>>();
        Clusters {
            n_motions: MOTIONS,
            aggregates: aggregates.chunks(10).map(<[u32]>::to_vec).collect(),
            of_aggregate,
            shapes: unit.repeat(AGGREGATES),
        }
    }

    fn solution(equations: &mut dyn CoarseEquations) -> Vec<f64> {
        let mut works: Vec<f64> = (0..MOTIONS * AGGREGATES)
            .map(|it| (it as f64 * 0.7).sin() + 1.0)
            .collect();
        equations.solve(&mut works);
        works
    }

    /// Equations that lose some terms, by conjugate gradients and by the factor, and equations made without these terms: the solutions
    /// agree to the tolerance of conjugate gradients, and the changed equations are the new ones to the rounding of single precision.
    #[test]
    fn changed_equations_are_those_without_the_terms() {
        let kept: Vec<RankOne> = every_seventh(false);
        let minus: Vec<RankOne> = (every_seventh(true).into_iter())
            .map(|term| RankOne {
                weight: -term.weight,
                ..term
            })
            .collect();
        let whole = stiffness(&terms());
        let mut factor = CoarseFactor::new(&whole).unwrap();
        let mut changed = CoarseIteration::new(&whole, clusters()).unwrap();
        let before = solution(&mut changed);
        assert!(factor.change(&minus) && changed.change(&minus));
        let mut anew = CoarseIteration::new(&stiffness(&kept), clusters()).unwrap();
        let [exact, by_change, by_new] = [
            &mut factor as &mut dyn CoarseEquations,
            &mut changed,
            &mut anew,
        ]
        .map(solution);
        let size = |values: &[f64]| dot_of_chunks(values, values).sqrt();
        let off = |one: &[f64], other: &[f64]| {
            let difference: Vec<f64> = one.iter().zip(other).map(|(a, b)| a - b).collect();
            size(&difference) / size(other)
        };
        assert!(off(&before, &exact) > 0.1);
        assert!(off(&by_change, &exact) < 2.0 * TOLERANCE);
        assert!(off(&by_change, &by_new) < 1e-4);
    }

    /// A term between aggregates that nothing couples has no place in the equations.
    #[test]
    fn terms_without_a_block_are_refused() {
        let mut equations = CoarseIteration::new(&stiffness(&terms()), clusters()).unwrap();
        let far = RankOne {
            weight: 1.0,
            entries: vec![(0, 1.0), (MOTIONS * (AGGREGATES - 1), -1.0)],
        };
        assert!(!equations.change(&[far]));
    }
}
