//! Interface of matrices whose rows are distributed over processes.

use std::fmt::Debug;
use std::ops::Deref;
use std::sync::Arc;

pub use ligament_model::communicator::{Communicator, SingleProcess};

/// Communicator of the processes of a run, with distributed matrices.
pub trait MatrixCommunicator: Communicator {
    /// Whether equations are solved with distributed matrices; a run without an MPI launcher has its own solvers.
    fn has_matrices(&self) -> bool;

    /// Creates a matrix without values, with rows distributed over the processes; none where there are no such matrices.
    fn matrix(&self, rows: &Rows<'_>) -> Option<Box<dyn DistributedMatrix>>;
}

/// Processes of a run, as one of them sees them. Equal ones have the same rank among as many processes.
#[derive(Debug, Clone)]
pub struct Processes(pub Arc<dyn MatrixCommunicator>);

impl PartialEq for Processes {
    fn eq(&self, other: &Self) -> bool {
        [self.rank(), self.size()] == [other.rank(), other.size()]
    }
}

impl Deref for Processes {
    type Target = dyn MatrixCommunicator;

    fn deref(&self) -> &Self::Target {
        &*self.0
    }
}

impl MatrixCommunicator for SingleProcess {
    fn has_matrices(&self) -> bool {
        false
    }

    fn matrix(&self, _: &Rows<'_>) -> Option<Box<dyn DistributedMatrix>> {
        None
    }
}

/// Structure of a matrix of blocks, one for each two coupled points; each rank stores the rows of its owned points. Points
/// are numbered from 0 on, rank by rank.
#[derive(Debug, Clone, Copy)]
pub struct Rows<'a> {
    /// Number of components of the motion of a point, the size of a block.
    pub n_components: usize,
    /// Number of points of all ranks.
    pub n_all: usize,
    /// Numbers of blocks in the rows of each owned point: in columns of owned points, including itself, and of others; shape
    /// (n_own).
    pub couplings: &'a [[usize; 2]],
}

/// A symmetric matrix whose rows are distributed over ranks.
pub trait DistributedMatrix: Debug {
    /// Replaces the blocks in the rows of an owned point and the columns of some points, shape (n_components, n, n_components). Not
    /// collective.
    fn set(&mut self, row: usize, columns: &[usize], blocks: &[f64]);

    /// Assembles the values set by all ranks; collective.
    fn assemble(&mut self);

    /// Builds a preconditioner of the present matrix, which is kept while the matrix changes. `motions` have next to no energy,
    /// shape (n, degrees of freedom of the owned points). The matrix is a sum of positive semidefinite parts, each of which couples
    /// at most `n_coupled` points.
    fn precondition(&mut self, motions: &[Vec<f64>], n_coupled: usize);

    /// Computes a factor L D L^T of the present matrix.
    fn factorise(&mut self) -> Pivots;

    /// Solves for forces at the degrees of freedom of the owned points, with the last preconditioner or factor.
    fn solve(&mut self, force: &[f64], left: Tolerated<'_>) -> Solved;
}

/// Numbers of pivots by sign.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Pivots {
    /// Number of negative pivots.
    pub negative: usize,
    /// Number of vanishing pivots.
    pub vanishing: usize,
    /// Number of positive pivots.
    pub positive: usize,
}

/// Residual force allowed in an iterative solution.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Tolerated<'a> {
    /// Norm over all degrees of freedom.
    Norm(f64),
    /// Largest sizes at the degrees of freedom of the owned points.
    Sizes(&'a [f64]),
}

/// Result of a solution.
#[derive(Debug, Clone, PartialEq)]
pub struct Solved {
    /// Motions at the degrees of freedom of the owned points; for an indefinite matrix a motion without stiffness.
    pub motions: Vec<f64>,
    /// Number of iterations.
    pub iterations: usize,
    /// Decades by which the norm of the residual force fell.
    pub decades: f64,
    /// Whether no motion without stiffness was found.
    pub is_definite: bool,
}
