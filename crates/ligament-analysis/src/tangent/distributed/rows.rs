//! Rows of the tangent stiffness on a rank.
//!
//! The blocks in the columns of a point are computed from its bonds for rows of smaller number; the blocks above the diagonal follow by
//! symmetry. A rank computes the columns of its owned points and of points of larger number coupled with them, and stores its own
//! rows.

use ligament_model::parallel;
use ligament_model::subdomain::Subdomain;
use ligament_model::{Bonds, UnbrokenBonds};

use crate::distributed_matrix::{DistributedMatrix, Rows};
use crate::tangent::iterative::vanishing_of_block;
use crate::unknowns::Unknowns;

/// Largest number of columns whose blocks are stored at the same time.
const TASK: usize = 1024;

/// Rows of the owned points of a rank.
pub(super) struct OwnRows<'a> {
    pub(super) system: &'a dyn Bonds,
    pub(super) unknowns: &'a Unknowns,
    pub(super) subdomain: &'a Subdomain,
}

/// Bonds, and whether each degree of freedom is free (n_degrees_of_freedom); the others are decoupled, with only a diagonal entry.
#[derive(Clone, Copy)]
pub(super) struct Taken<'a> {
    pub(super) bonds: UnbrokenBonds<'a>,
    pub(super) free: &'a [bool],
}

/// Blocks in the columns of a point, in the rows of the `lower` points and of the point itself.
struct Column {
    point: u32,
    lower: Vec<u32>,
    blocks: Vec<f64>,
}

impl OwnRows<'_> {
    fn n_components(&self) -> usize {
        self.unknowns.layout().components.len()
    }

    fn lower(&self, point: u32) -> Vec<u32> {
        let (restraints, layout) = (self.unknowns.restraints(), self.unknowns.layout());
        restraints.lower_points(layout, &self.system.coupled_points, point as usize)
    }

    pub(super) fn is_own(&self, point: u32) -> bool {
        self.subdomain.owns(point)
    }

    /// Points whose columns have entries in owned rows, ascending.
    pub(super) fn columns(&self) -> Vec<u32> {
        let is_seen = |&point: &u32| {
            self.is_own(point) || self.lower(point).into_iter().any(|it| self.is_own(it))
        };
        let seen = |point| Some(point as u32).filter(is_seen);
        parallel::flat_map(self.system.n_points(), seen)
    }

    /// Numbers of blocks in the rows of each owned point, in owned columns and in others, shape (n_own).
    pub(super) fn couplings(&self, columns: &[u32]) -> Vec<[usize; 2]> {
        let mut couplings = vec![[0, 0]; self.subdomain.n_owned()];
        let mut count = |row: u32, column: u32| {
            if let Some(place) = self.subdomain.row(row) {
                couplings[place][usize::from(!self.is_own(column))] += 1;
            }
        };
        for &point in columns {
            count(point, point);
            for other in self.lower(point) {
                count(other, point);
                count(point, other);
            }
        }
        couplings
    }

    /// Largest number of points coupled by an element or a restraint, as far as known on this rank.
    pub(super) fn most_coupled(&self) -> usize {
        let elements = &self.system.elements_at_points;
        let mut n_points = vec![0; self.system.ends.len()];
        for point in 0..self.system.n_points() as u32 {
            for &element in elements.at(point) {
                n_points[element as usize] += 1;
            }
        }
        let of_elements = n_points.into_iter().max().unwrap_or(0);
        let restraints = self.unknowns.restraints();
        of_elements.max(restraints.most_coupled(self.unknowns.layout()))
    }

    /// Structure of a matrix without values.
    pub(super) fn rows<'a>(&self, couplings: &'a [[usize; 2]]) -> Rows<'a> {
        Rows {
            n_components: self.n_components(),
            n_all: self.subdomain.n_all(),
            couplings,
        }
    }

    /// Sets the entries in owned rows and in the columns of some points, and their transposes; returns owned degrees of freedom
    /// without stiffness.
    pub(super) fn set(
        &self,
        columns: &[u32],
        taken: Taken<'_>,
        matrix: &mut dyn DistributedMatrix,
    ) -> Vec<usize> {
        let mut loose = Vec::new();
        for points in columns.chunks(TASK) {
            for column in parallel::map(points, |&point| self.column(point, taken)) {
                self.set_column(&column, matrix);
                if self.is_own(column.point) {
                    loose.extend(self.loose(&column, taken));
                }
            }
        }
        loose
    }

    fn column(&self, point: u32, taken: Taken<'_>) -> Column {
        let n = self.n_components();
        let (restraints, layout) = (self.unknowns.restraints(), self.unknowns.layout());
        let lower = self.lower(point);
        let mut blocks = vec![0.0; (lower.len() + 1) * n * n];
        self.system
            .add_blocks(taken.bonds, point, &lower, &mut blocks);
        restraints.add_blocks(layout, point, &lower, &mut blocks);
        let at = |point: u32| &taken.free[layout.range(point)];
        let free = at(point);
        for (place, block) in blocks.chunks_exact_mut(n * n).enumerate() {
            let is_own = place == lower.len();
            let rows = lower.get(place).map_or(free, |&other| at(other));
            for (entry, value) in block.iter_mut().enumerate() {
                let (r, c) = (entry / n, entry % n);
                if rows[r] && free[c] {
                    continue;
                }
                // A decoupled equation may have any positive diagonal entry: a fixed point may have lost all its bonds.
                *value = match *value {
                    _ if !is_own || r != c => 0.0,
                    0.0 => 1.0,
                    value => value.abs(),
                };
            }
        }
        Column {
            point,
            lower,
            blocks,
        }
    }

    fn set_column(&self, column: &Column, matrix: &mut dyn DistributedMatrix) {
        let n = self.n_components();
        let Column {
            point,
            lower,
            blocks,
        } = column;
        let place = self.subdomain.place(*point);
        for (&other, block) in lower.iter().zip(blocks.chunks_exact(n * n)) {
            if self.is_own(other) {
                matrix.set(self.subdomain.place(other), &[place], block);
            }
        }
        if !self.is_own(*point) {
            return;
        }
        let all = lower.iter().chain([point]);
        let places: Vec<usize> = all.map(|&it| self.subdomain.place(it)).collect();
        let mut row = vec![0.0; blocks.len()];
        for (k, block) in blocks.chunks_exact(n * n).enumerate() {
            for r in 0..n {
                for c in 0..n {
                    row[(r * places.len() + k) * n + c] = block[c * n + r];
                }
            }
        }
        matrix.set(place, &places, &row);
    }

    /// First degree of freedom without stiffness at the point of a column.
    fn loose(&self, column: &Column, taken: Taken<'_>) -> Option<usize> {
        let n = self.n_components();
        let dofs = self.unknowns.layout().range(column.point);
        let free: Vec<usize> = (0..n).filter(|k| taken.free[dofs.start + k]).collect();
        let own = &column.blocks[column.lower.len() * n * n..];
        vanishing_of_block(&free, n, own).map(|it| dofs.start + it)
    }
}
