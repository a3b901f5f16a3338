//! The forces K Z that resist the motions of a coarse space.
//!
//! With them the work of the force K y of a motion y on the coarse space, Z^T K y = (K Z)^T y, needs no further product with K. The
//! share of a broken bond is subtracted.

use std::collections::BTreeMap;

use ligament_linalg::RankOne;
use ligament_model::parallel;

use super::coarse_basis::CoarseBasis;
use super::operator::Operator;

/// Force, relative to the stiffness of a point, that counts as rounding: an aggregate that moves rigidly with all neighbours of a
/// point does not strain its bonds.
const ROUNDING: f64 = 1e-12;

/// Least number of aggregates of a parallel task.
const TASK: usize = 16;

/// Forces W = K Z, zero at degrees of freedom that are not free.
pub(super) struct Resistance {
    /// Blocks of W by aggregate of their columns.
    columns: Vec<Columns>,
    /// Whether each degree of freedom was free, shape (n_degrees_of_freedom).
    free: Vec<bool>,
}

/// Columns of W of an aggregate, in single precision, which suffices for a preconditioner.
#[derive(Default)]
struct Columns {
    /// Points that resist motions of the aggregate, ascending.
    points: Vec<u32>,
    /// Blocks at the points, shape (n_points, n_components, n_motions).
    blocks: Vec<f32>,
}

/// A block of E = Z^T K Z: its aggregates, the first not above the second, and its values (n_motions, n_motions).
pub(super) type Block = ([u32; 2], Vec<f64>);

/// Contributions to W of the couplings of the points of an aggregate with points of smaller number.
struct Share {
    /// Points of blocks in columns of this aggregate, ascending.
    own: Vec<u32>,
    blocks_of_own: Vec<f64>,
    /// Aggregate and point of blocks in columns of other aggregates.
    others: Vec<[u32; 2]>,
    /// Blocks in columns of other aggregates, as in [`Columns`].
    blocks_of_others: Vec<f64>,
}

impl Resistance {
    /// Forces W of the bonds and restraints of an operator, without its additional terms, from the diagonal of K
    /// (n_degrees_of_freedom); and the blocks of E by aggregate of their columns.
    pub(super) fn new(
        operator: &Operator<'_>,
        space: &CoarseBasis,
        diagonal: &[f64],
    ) -> (Self, Vec<Vec<Block>>) {
        let making = ResistanceBuilder {
            operator,
            space,
            diagonal,
        };
        let aggregates = 0..space.aggregates.len() as u32;
        let shares: Vec<Share> = parallel::map(aggregates, |it| making.share(it));
        let mut of_others: Vec<Vec<(u32, &[f64])>> = vec![Vec::new(); shares.len()];
        for share in &shares {
            let blocks = share.blocks_of_others.chunks_exact(making.size());
            for ([aggregate, point], block) in share.others.iter().zip(blocks) {
                of_others[*aggregate as usize].push((*point, block));
            }
        }
        let of_others = of_others.into_iter().enumerate();
        let joined = parallel::map(of_others, |(aggregate, others)| {
            making.joined(aggregate as u32, &shares[aggregate], others)
        });
        let (columns, blocks) = joined.into_iter().unzip();
        let free = operator.free.to_vec();
        (Self { columns, free }, blocks)
    }

    /// Subtracts the work W^T y of motions y (n_degrees_of_freedom) from works (n_aggregates, n_motions).
    pub(super) fn subtract_works(&self, space: &CoarseBasis, motions: &[f64], works: &mut [f64]) {
        match (
            motions.len() / space.aggregates.of_point.len(),
            space.n_motions,
        ) {
            (2, 3) => self.subtract_works_of::<2, 3>(motions, works),
            (3, 3) => self.subtract_works_of::<3, 3>(motions, works),
            (3, 6) => self.subtract_works_of::<3, 6>(motions, works),
            (6, 6) => self.subtract_works_of::<6, 6>(motions, works),
            (components, motions) => {
                unreachable!("no point has {components} components in {motions} rigid motions")
            }
        }
    }

    fn subtract_works_of<const M: usize, const N: usize>(
        &self,
        motions: &[f64],
        works: &mut [f64],
    ) {
        let motions = motions.as_chunks::<M>().0;
        let tasks = works.as_chunks_mut::<N>().0.chunks_mut(TASK);
        parallel::for_each(tasks.zip(self.columns.chunks(TASK)), |(works, columns)| {
            for (works, columns) in works.iter_mut().zip(columns) {
                let blocks = columns.blocks.as_chunks::<N>().0.as_chunks::<M>().0;
                let mut sums = [0.0; N];
                for (&point, block) in columns.points.iter().zip(blocks) {
                    for (motion, row) in motions[point as usize].iter().zip(block) {
                        for (sum, value) in sums.iter_mut().zip(row) {
                            *sum += motion * f64::from(*value);
                        }
                    }
                }
                for (work, sum) in works.iter_mut().zip(sums) {
                    *work -= sum;
                }
            }
        });
    }

    /// Adds c w (Z^T w)^T for a term c w w^T, with the works Z^T w by coarse unknown, ascending.
    pub(super) fn add(&mut self, space: &CoarseBasis, term: &RankOne, works: &[(usize, f64)]) {
        let n = space.n_motions;
        let n_components = self.free.len() / space.aggregates.of_point.len();
        for &(unknown, work) in works {
            let columns = &mut self.columns[unknown / n];
            let free = term.entries.iter().filter(|(dof, _)| self.free[*dof]);
            for &(dof, value) in free {
                let (point, component) = ((dof / n_components) as u32, dof % n_components);
                // Points that an aggregate does not strain have no block, and their work is rounding.
                if let Ok(place) = columns.points.binary_search(&point) {
                    let row = (place * n_components + component) * n;
                    columns.blocks[row + unknown % n] += (term.weight * value * work) as f32;
                }
            }
        }
    }
}

/// Data from which W is computed.
struct ResistanceBuilder<'a> {
    operator: &'a Operator<'a>,
    space: &'a CoarseBasis,
    diagonal: &'a [f64],
}

impl ResistanceBuilder<'_> {
    /// Number of values of a block.
    fn size(&self) -> usize {
        self.operator.n_components() * self.space.n_motions
    }

    /// Contributions to W of the columns of the points of an aggregate.
    fn share(&self, aggregate: u32) -> Share {
        let n = self.space.n_motions;
        let k = self.operator.n_components();
        let of_point = &self.space.aggregates.of_point;
        let points = &self.space.aggregates.points[aggregate as usize];
        let lower: Vec<Vec<u32>> = (points.iter())
            .map(|&point| self.operator.lower_points(point))
            .collect();
        let mut own: Vec<u32> = lower.iter().flatten().chain(points).copied().collect();
        own.sort_unstable();
        own.dedup();
        let mut sums = vec![0.0; own.len() * self.size()];
        let (mut others, mut blocks_of_others) = (Vec::<[u32; 2]>::new(), Vec::<f64>::new());
        let place_of = |point: u32| self.size() * own.partition_point(|it| *it < point);
        let mut blocks = Vec::new();
        for (&point, lower) in points.iter().zip(&lower) {
            blocks.clear();
            blocks.resize((lower.len() + 1) * k * k, 0.0);
            self.operator.add_blocks(point, lower, &mut blocks);
            let of_row = others.len();
            for (&other, block) in lower.iter().chain([&point]).zip(blocks.chunks_exact(k * k)) {
                // Blocks across a crack are zero.
                if block.iter().all(|value| *value == 0.0) {
                    continue;
                }
                let place = place_of(other);
                add_product(block, self.space.rows_of(point, k), n, &mut sums[place..]);
                if other == point {
                    continue;
                }
                let of_other = of_point[other as usize];
                let sum = if of_other == aggregate {
                    &mut sums[place_of(point)..]
                } else {
                    let row = others[of_row..].iter().position(|it| it[0] == of_other);
                    let place = of_row + row.unwrap_or(others.len() - of_row);
                    if place == others.len() {
                        others.push([of_other, point]);
                        blocks_of_others.resize(others.len() * self.size(), 0.0);
                    }
                    &mut blocks_of_others[place * self.size()..]
                };
                add_transposed_product(block, self.space.rows_of(other, k), n, sum);
            }
        }
        Share {
            own,
            blocks_of_own: sums,
            others,
            blocks_of_others,
        }
    }

    /// Columns of W of an aggregate, from its own and other contributions at points, and its blocks of E.
    fn joined<'b>(
        &self,
        aggregate: u32,
        share: &'b Share,
        mut others: Vec<(u32, &'b [f64])>,
    ) -> (Columns, Vec<Block>) {
        let blocks = share.blocks_of_own.chunks_exact(self.size());
        others.extend(share.own.iter().copied().zip(blocks));
        others.sort_by_key(|(point, _)| *point);
        let (n, k) = (self.space.n_motions, self.operator.n_components());
        let mut columns = Columns::default();
        let mut works: BTreeMap<u32, Vec<f64>> = BTreeMap::new();
        for of_point in others.chunk_by(|one, other| one.0 == other.0) {
            let point = of_point[0].0;
            let Some(block) = self.block(aggregate, of_point) else {
                continue;
            };
            columns.points.push(point);
            columns
                .blocks
                .extend(block.iter().map(|value| *value as f32));
            let of = self.space.aggregates.of_point[point as usize];
            if of <= aggregate {
                let sum = works.entry(of).or_insert_with(|| vec![0.0; n * n]);
                add_works(self.space.rows_of(point, k), &block, n, sum);
            }
        }
        let works = works.into_iter();
        let blocks = works.map(|(of, sum)| ([of, aggregate], sum)).collect();
        (columns, blocks)
    }

    /// Sum of the contributions of a point to the columns of an aggregate, at free degrees of freedom; none where it is rounding.
    fn block(&self, aggregate: u32, shares: &[(u32, &[f64])]) -> Option<Vec<f64>> {
        let (n, k) = (self.space.n_motions, self.operator.n_components());
        let mut sum = vec![0.0; self.size()];
        for (_, block) in shares {
            for (sum, value) in sum.iter_mut().zip(*block) {
                *sum += value;
            }
        }
        let point = shares[0].0;
        let first = k * point as usize;
        for (row, dof) in sum.chunks_exact_mut(n).zip(first..) {
            if !self.operator.free[dof] {
                row.fill(0.0);
            }
        }
        let mut rounding = 0.0;
        if self.space.aggregates.of_point[point as usize] == aggregate {
            let rows = self.space.rows_of(point, k).chunks_exact(n);
            let sizes = rows.zip(&self.diagonal[first..]).map(|(row, own)| {
                own * row
                    .iter()
                    .fold(0.0, |most: f64, value| most.max(value.abs()))
            });
            rounding = ROUNDING * sizes.fold(0.0, f64::max);
        }
        sum.iter()
            .any(|value| value.abs() > rounding)
            .then_some(sum)
    }
}

/// Adds the product of a block (k, k) with rows (k, n) to a sum.
fn add_product(block: &[f64], rows: &[f64], n: usize, sum: &mut [f64]) {
    let k = rows.len() / n;
    for (of_block, sums) in block.chunks_exact(k).zip(sum.chunks_exact_mut(n)) {
        for (factor, row) in of_block.iter().zip(rows.chunks_exact(n)) {
            for (sum, value) in sums.iter_mut().zip(row) {
                *sum += factor * value;
            }
        }
    }
}

/// Adds the product of the transpose of a block (k, k) with rows (k, n) to a sum.
fn add_transposed_product(block: &[f64], rows: &[f64], n: usize, sum: &mut [f64]) {
    let k = rows.len() / n;
    for (of_block, row) in block.chunks_exact(k).zip(rows.chunks_exact(n)) {
        for (factor, sums) in of_block.iter().zip(sum.chunks_exact_mut(n)) {
            for (sum, value) in sums.iter_mut().zip(row) {
                *sum += factor * value;
            }
        }
    }
}

/// Adds A^T B of rows A and B (k, n) to a block (n, n).
fn add_works(one: &[f64], other: &[f64], n: usize, sum: &mut [f64]) {
    for (one, other) in one.chunks_exact(n).zip(other.chunks_exact(n)) {
        for (factor, sums) in one.iter().zip(sum.chunks_exact_mut(n)) {
            for (sum, value) in sums.iter_mut().zip(other) {
                *sum += factor * value;
            }
        }
    }
}
