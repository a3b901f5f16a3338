//! A matrix whose rows are distributed over ranks.

use ligament_analysis::distributed_matrix::{DistributedMatrix, Pivots, Rows, Solved, Tolerated};

use crate::native::{self, Handle};

/// A matrix of PETSc.
#[derive(Debug)]
pub(crate) struct Matrix {
    handle: Handle,
    /// Column numbers of the row that is set.
    columns: Vec<i64>,
}

impl Matrix {
    pub(crate) fn new(rows: &Rows<'_>) -> Self {
        let count = |of: fn(&[usize; 2]) -> usize| -> Vec<i64> {
            rows.couplings.iter().map(|it| of(it) as i64).collect()
        };
        let [own, other] = [count(|it| it[0]), count(|it| it[1])];
        Self {
            handle: Handle::new(rows.n_components, rows.n_all, [&own, &other]),
            columns: Vec::new(),
        }
    }
}

impl DistributedMatrix for Matrix {
    fn set(&mut self, row: usize, columns: &[usize], blocks: &[f64]) {
        self.columns.clear();
        self.columns.extend(columns.iter().map(|&it| it as i64));
        self.handle.set(row, &self.columns, blocks);
    }

    fn assemble(&mut self) {
        self.handle.assemble();
    }

    fn precondition(&mut self, motions: &[Vec<f64>], n_coupled: usize) {
        let n = motions.len();
        self.handle.precondition(&motions.concat(), n, n_coupled);
    }

    fn factorise(&mut self) -> Pivots {
        let [negative, vanishing, positive] = self.handle.factorise().map(|it| it as usize);
        Pivots {
            negative,
            vanishing,
            positive,
        }
    }

    fn solve(&mut self, force: &[f64], left: Tolerated<'_>) -> Solved {
        let (limits, norm) = match left {
            Tolerated::Norm(norm) => (None, norm),
            Tolerated::Sizes(sizes) => (Some(sizes), 0.0),
        };
        let (motions, end, iterations, norms) = self.handle.solve(force, limits, norm);
        Solved {
            motions,
            iterations: iterations as usize,
            decades: (norms[0] / norms[1]).log10(),
            is_definite: end != native::INDEFINITE,
        }
    }
}
