//! Matrices whose rows are distributed over processes, and what the equations ask of them.

use std::fmt::Debug;

pub use ligament_model::communicator::{Communicator, Solo};

/// The processes of a run with the matrices that they share.
pub trait MatrixCommunicator: Communicator {
    /// Whether equations are solved with distributed matrices; a run without a launcher of MPI has its own solvers.
    fn has_matrices(&self) -> bool;

    /// A matrix without values, whose rows are distributed over the processes; none where there are no such matrices.
    fn matrix(&self, rows: &Rows<'_>) -> Option<Box<dyn DistributedMatrix>>;
}

impl MatrixCommunicator for Solo {
    fn has_matrices(&self) -> bool {
        false
    }

    fn matrix(&self, _: &Rows<'_>) -> Option<Box<dyn DistributedMatrix>> {
        None
    }
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

/// A symmetric matrix whose rows are distributed over ranks.
pub trait DistributedMatrix: Debug {
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
