//! PETSc over MPI: matrices whose rows are shared out among processes, multigrid and factors of them.
//!
//! What a run asks for is the interface of [`ligament_analysis::distributed_matrix`]. Everything here is behind the feature `petsc`, which needs the
//! libraries of the system; without it the crate is empty.
#![cfg(feature = "petsc")]

mod matrix;
mod native;
mod processes;

pub use processes::{Processes, StartError};
