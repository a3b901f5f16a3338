//! Symmetric systems that are sums of known rank-one terms, so that every changed matrix can be made anew.

use std::collections::BTreeSet;
use std::sync::Arc;

use ligament_linalg::{
    Elimination, FactorKind, Factorisation, Pattern, RankOne, Symbolic, SymmetricMatrix,
};
use nalgebra::{DMatrix, DVector};

/// Seeded random numbers (SplitMix64, Steele, Lea & Flood, OOPSLA 2014).
pub(crate) struct Random(pub u64);

impl Random {
    pub(crate) fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// Uniform between -1 and 1.
    pub(crate) fn signed(&mut self) -> f64 {
        2.0 * (self.bits() >> 11) as f64 / (1_u64 << 53) as f64 - 1.0
    }

    pub(crate) fn below(&mut self, bound: usize) -> usize {
        (self.bits() % bound as u64) as usize
    }

    pub(crate) fn vector(&mut self, n: usize) -> Vec<f64> {
        (0..n).map(|_| self.signed()).collect()
    }

    pub(crate) fn permutation(&mut self, n: usize) -> Vec<usize> {
        let mut order: Vec<usize> = (0..n).collect();
        for k in (1..n).rev() {
            order.swap(k, self.below(k + 1));
        }
        order
    }
}

/// Points and the pairs of them that are coupled.
#[derive(Debug, Clone)]
pub(crate) struct Graph {
    pub(crate) n_points: usize,
    pub(crate) pairs: BTreeSet<(usize, usize)>,
}

impl Graph {
    pub(crate) fn new(n_points: usize, pairs: impl IntoIterator<Item = (usize, usize)>) -> Self {
        let pairs = pairs.into_iter().map(|(a, b)| (a.min(b), a.max(b)));
        Self {
            n_points,
            pairs: pairs.filter(|(a, b)| a != b).collect(),
        }
    }

    /// Points one after another.
    pub(crate) fn chain(n_points: usize) -> Self {
        Self::new(n_points, (1..n_points).map(|b| (b - 1, b)))
    }

    /// All points with all others.
    pub(crate) fn complete(n_points: usize) -> Self {
        let pairs = (0..n_points).flat_map(|b| (0..b).map(move |a| (a, b)));
        Self::new(n_points, pairs)
    }

    /// A square lattice, bonded within a distance in spacings.
    pub(crate) fn lattice(side: usize, reach: f64) -> Self {
        let distance = |a: usize, b: usize| {
            let dx = (a % side) as f64 - (b % side) as f64;
            let dy = (a / side) as f64 - (b / side) as f64;
            dx.hypot(dy)
        };
        let first = |b: usize| b.saturating_sub(reach as usize * (side + 1));
        let pairs = (0..side * side).flat_map(|b| (first(b)..b).map(move |a| (a, b)));
        Self::new(side * side, pairs.filter(|&(a, b)| distance(a, b) <= reach))
    }

    /// Some pairs at random, `per_point` for each point.
    pub(crate) fn random(n_points: usize, per_point: f64, random: &mut Random) -> Self {
        let n_pairs = (per_point * n_points as f64) as usize;
        let pair = |_| (random.below(n_points), random.below(n_points));
        Self::new(n_points, (0..n_pairs).map(pair).collect::<Vec<_>>())
    }

    /// Two graphs side by side.
    pub(crate) fn beside(&self, other: &Self) -> Self {
        let moved = other
            .pairs
            .iter()
            .map(|&(a, b)| (a + self.n_points, b + self.n_points));
        Self::new(
            self.n_points + other.n_points,
            self.pairs.iter().copied().chain(moved),
        )
    }
}

/// What every unknown is held with: the smallest eigenvalue is not below it.
pub(crate) const GROUND: f64 = 0.5;

/// A matrix as the sum of `terms`: one on the diagonal of each unknown, then as many for each pair as a point has unknowns.
#[derive(Debug, Clone)]
pub(crate) struct System {
    pub(crate) pattern: Arc<Pattern>,
    pub(crate) terms: Vec<RankOne>,
    pub(crate) components: usize,
}

impl System {
    pub(crate) fn new(graph: &Graph, components: usize, random: &mut Random) -> Self {
        let n = graph.n_points * components;
        let mut neighbours = vec![BTreeSet::new(); graph.n_points];
        for &(a, b) in &graph.pairs {
            neighbours[b].insert(a);
        }
        let (mut column_starts, mut rows) = (vec![0], Vec::new());
        for column in 0..n {
            let point = column / components;
            for &before in &neighbours[point] {
                rows.extend(before * components..(before + 1) * components);
            }
            rows.extend(point * components..=column);
            column_starts.push(rows.len());
        }
        let ground = (0..n).map(|unknown| RankOne {
            weight: GROUND,
            entries: vec![(unknown, 1.0)],
        });
        let mut terms: Vec<RankOne> = ground.collect();
        for &(a, b) in &graph.pairs {
            for _ in 0..components {
                let unknowns = (a * components..(a + 1) * components)
                    .chain(b * components..(b + 1) * components);
                terms.push(RankOne {
                    weight: 1.0 + 0.5 * random.signed(),
                    entries: unknowns.map(|unknown| (unknown, random.signed())).collect(),
                });
            }
        }
        Self {
            pattern: Arc::new(Pattern::new(column_starts, rows).unwrap()),
            terms,
            components,
        }
    }

    pub(crate) fn n(&self) -> usize {
        self.pattern.dimension()
    }

    /// Terms of pairs, as a range of `terms`.
    pub(crate) fn terms_of_pairs(&self) -> std::ops::Range<usize> {
        self.n()..self.terms.len()
    }

    pub(crate) fn matrix(&self) -> SymmetricMatrix {
        let mut matrix = SymmetricMatrix::zero(self.pattern.clone());
        for term in &self.terms {
            for (k, &(i, v)) in term.entries.iter().enumerate() {
                for &(j, w) in &term.entries[k..] {
                    let (row, column) = (i.min(j), i.max(j));
                    let start = self.pattern.column_starts()[column];
                    let end = self.pattern.column_starts()[column + 1];
                    let place = self.pattern.rows()[start..end].binary_search(&row).unwrap();
                    matrix.values[start + place] += term.weight * v * w;
                }
            }
        }
        matrix
    }

    /// Adds to the weight of a term; gives the change.
    pub(crate) fn add(&mut self, term: usize, weight: f64) -> RankOne {
        self.terms[term].weight += weight;
        RankOne {
            weight,
            entries: self.terms[term].entries.clone(),
        }
    }

    pub(crate) fn symbolic(&self, elimination: Elimination) -> Arc<Symbolic> {
        Arc::new(Symbolic::analyse(self.pattern.clone(), elimination).unwrap())
    }

    pub(crate) fn factor(
        &self,
        kind: FactorKind,
        symbolic: &Arc<Symbolic>,
    ) -> Box<dyn Factorisation> {
        kind.factorise(symbolic, &self.matrix()).unwrap()
    }

    pub(crate) fn dense(&self) -> DMatrix<f64> {
        dense(&self.matrix())
    }

    /// Bound of the condition number as long as no weight is negative and the ground stays.
    pub(crate) fn condition(&self) -> f64 {
        norm(&self.matrix()) / GROUND
    }
}

pub(crate) const KINDS: [FactorKind; 2] = [FactorKind::Llt, FactorKind::Ldlt];

/// All ways of ordering; the given one is random.
pub(crate) fn orders(n: usize, random: &mut Random) -> [Elimination; 3] {
    [
        Elimination::MinimumDegree,
        Elimination::NestedDissection,
        Elimination::Given(random.permutation(n)),
    ]
}

pub(crate) fn entries(matrix: &SymmetricMatrix) -> impl Iterator<Item = (usize, usize, f64)> + '_ {
    let pattern = matrix.pattern();
    (0..pattern.dimension()).flat_map(move |column| {
        let places = pattern.column_starts()[column]..pattern.column_starts()[column + 1];
        places.map(move |place| (pattern.rows()[place], column, matrix.values[place]))
    })
}

pub(crate) fn dense(matrix: &SymmetricMatrix) -> DMatrix<f64> {
    let n = matrix.pattern().dimension();
    let mut dense = DMatrix::zeros(n, n);
    for (row, column, value) in entries(matrix) {
        dense[(row, column)] = value;
        dense[(column, row)] = value;
    }
    dense
}

/// Largest sum of absolute values in a row: not below the largest eigenvalue.
pub(crate) fn norm(matrix: &SymmetricMatrix) -> f64 {
    let mut sums = vec![0.0; matrix.pattern().dimension()];
    for (row, column, value) in entries(matrix) {
        sums[row] += value.abs();
        if row != column {
            sums[column] += value.abs();
        }
    }
    largest(sums)
}

/// Largest absolute value, or NaN if there is one.
pub(crate) fn largest(values: impl IntoIterator<Item = f64>) -> f64 {
    values.into_iter().fold(0.0, |largest: f64, value| {
        if value.abs() <= largest {
            largest
        } else {
            value.abs()
        }
    })
}

/// |A x - b| over |A| |x| + |b|, in the maximum norm: the smallest relative change of A and b that makes x exact (Rigal &
/// Gaches; Higham, Accuracy and Stability, theorem 7.1).
pub(crate) fn backward_error(matrix: &SymmetricMatrix, x: &[f64], b: &[f64]) -> f64 {
    let mut residual: Vec<f64> = b.to_vec();
    for (row, column, value) in entries(matrix) {
        residual[row] -= value * x[column];
        if row != column {
            residual[column] -= value * x[row];
        }
    }
    let scale = norm(matrix) * largest(x.iter().copied()) + largest(b.iter().copied());
    largest(residual) / scale
}

/// Largest difference over largest value.
pub(crate) fn difference(a: &[f64], b: &[f64]) -> f64 {
    assert_eq!(a.len(), b.len());
    largest(a.iter().zip(b).map(|(a, b)| a - b)) / largest(b.iter().copied())
}

pub(crate) fn solve_dense(matrix: DMatrix<f64>, b: &[f64]) -> Vec<f64> {
    let b = DVector::from_column_slice(b);
    matrix.full_piv_lu().solve(&b).unwrap().as_slice().to_vec()
}

pub(crate) fn solve(factor: &mut dyn Factorisation, b: &[f64]) -> Vec<f64> {
    let mut x = b.to_vec();
    factor.solve_in_place(&mut x);
    x
}

/// A right-hand side as `change` takes it.
pub(crate) fn listed(b: &[f64]) -> Vec<(usize, f64)> {
    b.iter().copied().enumerate().collect()
}

pub(crate) fn bits(values: &[f64]) -> Vec<u64> {
    values.iter().map(|value| value.to_bits()).collect()
}
