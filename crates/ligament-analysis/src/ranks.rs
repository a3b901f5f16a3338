//! Processes that solve the equations of a body together, and what the equations ask of them.
//!
//! Each process, a rank, runs the same program and calls the same functions here in the same order; what comes back is the same to the
//! bit on all of them, so that all go the same way. How they reach each other is the business of who implements the interface.

use std::fmt::Debug;

pub use ligament_model::portion::Exchange;

/// Processes that solve equations together; what is said of [`Exchange`] holds here as well.
pub trait Ranks: Exchange {
    /// A matrix without values, whose rows are shared out among the ranks.
    fn matrix(&self, rows: &Rows<'_>) -> Box<dyn RankMatrix>;
}

/// A matrix of blocks, one for each two points that are coupled, of which each rank has the rows of its own points. Points have numbers
/// from 0 on, and those of a rank follow on those of the rank before.
#[derive(Debug, Clone, Copy)]
pub struct Rows<'a> {
    /// Components of the motion of a point: rows and columns of a block.
    pub n_components: usize,
    /// Number of the points of all ranks.
    pub n_all: usize,
    /// Numbers of the blocks in the rows of each own point: in columns of own points, itself included, and of others; shape (n_own).
    pub couplings: &'a [[usize; 2]],
}

/// A symmetric matrix whose rows are shared out among ranks.
pub trait RankMatrix: Debug {
    /// Takes the blocks in the rows of an own point and the columns of some points, shape (components, n, components), in the place of
    /// what was there. For each rank by itself.
    fn set(&mut self, row: usize, columns: &[usize], blocks: &[f64]);

    /// Makes what all ranks have set the matrix.
    fn assemble(&mut self);

    /// Makes a preconditioner of the matrix as it is, which is kept while the matrix changes. `motions` cost next to no energy, shape
    /// (n, degrees of freedom of the own points). The matrix is a sum of parts that are not negative, none of which couples more points
    /// than `n_coupled`.
    fn precondition(&mut self, motions: &[Vec<f64>], n_coupled: usize);

    /// Makes a factor L D L^T of the matrix as it is.
    fn factorise(&mut self) -> Pivots;

    /// Solves for forces at the degrees of freedom of the own points, with the preconditioner or the factor that was made last.
    fn solve(&mut self, force: &[f64], left: Tolerated<'_>) -> Solved;
}

/// Numbers of pivots by sign.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Pivots {
    /// Negative ones.
    pub negative: usize,
    /// Vanishing ones.
    pub vanishing: usize,
    /// Positive ones.
    pub positive: usize,
}

/// The force that an iteration may leave out of balance.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Tolerated<'a> {
    /// Norm over all degrees of freedom.
    Norm(f64),
    /// Sizes at the degrees of freedom of the own points.
    Sizes(&'a [f64]),
}

/// What was found for some forces.
#[derive(Debug, Clone, PartialEq)]
pub struct Solved {
    /// Motions at the degrees of freedom of the own points; of a matrix that is not definite one that it does not resist.
    pub motions: Vec<f64>,
    /// Iterations it took.
    pub iterations: usize,
    /// Powers of ten by which the norm of the force out of balance became smaller.
    pub decades: f64,
    /// Whether no motion was met that costs no energy.
    pub is_definite: bool,
}

/// The processes that a run is one of. A copy is of the same ones, and two are equal if they are the same ones.
#[derive(Debug, Clone, Copy)]
pub struct Together(pub &'static dyn Ranks);

impl PartialEq for Together {
    fn eq(&self, other: &Self) -> bool {
        std::ptr::addr_eq(self.0, other.0)
    }
}
