//! PETSc over MPI: matrices whose rows are distributed over processes, their multigrid and their factors.
//!
//! Runs use it through the interface of [`ligament_analysis::distributed_matrix`]. All code depends on the feature `petsc`, which needs the
//! libraries of the system; without it the crate is empty.
#![cfg(feature = "petsc")]

mod matrix;
mod native;
mod processes;

pub use processes::{Processes, StartError};
