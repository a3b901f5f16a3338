//! The processes that MPI started together.

use std::sync::atomic::{AtomicBool, Ordering};

use ligament_analysis::distributed_matrix::{
    Communicator, DistributedMatrix, MatrixCommunicator, Rows,
};
use thiserror::Error;

use crate::matrix::Matrix;
use crate::native;

/// Whether MPI was started: it can be started once in the life of a process.
static STARTED: AtomicBool = AtomicBool::new(false);

/// Reason why the processes could not be started.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
pub enum StartError {
    /// MPI starts once in the life of a process.
    #[error("MPI was started before in this process, and can be started once")]
    Twice,
}

/// The processes that MPI started together; each runs the same program.
#[derive(Debug)]
pub struct Processes(());

impl Processes {
    /// Starts MPI and PETSc in this process.
    ///
    /// # Errors
    ///
    /// If they were started before.
    pub fn start() -> Result<Self, StartError> {
        if STARTED.swap(true, Ordering::SeqCst) {
            return Err(StartError::Twice);
        }
        native::start();
        Ok(Self(()))
    }

    /// The processes of this program, where they were started.
    pub fn started() -> Option<Self> {
        STARTED.load(Ordering::SeqCst).then_some(Self(()))
    }

    /// Number of processes on the machine of this process.
    pub fn size_here(&self) -> usize {
        native::size_here()
    }

    /// Waits until all processes have called this function, for a number of seconds or, without one, for ever; returns whether all did.
    pub fn meet(&self, seconds: Option<f64>) -> bool {
        native::meet(seconds.unwrap_or(-1.0))
    }

    /// Ends PETSc and MPI in order, after all processes met.
    pub fn end(&self) {
        native::end();
    }

    /// Ends all processes with an exit code, wherever they are.
    pub fn abort(&self, code: u8) {
        native::abort(i32::from(code));
    }
}

impl Communicator for Processes {
    fn rank(&self) -> usize {
        native::rank()
    }

    fn size(&self) -> usize {
        native::size()
    }

    fn all_reduce_max(&self, values: &mut [f64]) {
        native::all_reduce_max(values);
    }

    fn all_gather(&self, own: &[f64], counts: &[usize]) -> Vec<f64> {
        let counts: Vec<i64> = counts.iter().map(|&it| it as i64).collect();
        native::all_gather(own, &counts)
    }

    fn all_to_all(&self, own: &[f64], to: &[usize], from: &[usize]) -> Vec<f64> {
        let [to, from] = [to, from].map(|it| it.iter().map(|&count| count as i64).collect());
        let (to, from): (Vec<i64>, Vec<i64>) = (to, from);
        native::all_to_all(own, &to, &from)
    }

    fn broadcast(&self, bytes: &mut Vec<u8>) {
        let mut length = (bytes.len() as u64).to_le_bytes();
        native::broadcast(&mut length);
        bytes.resize(u64::from_le_bytes(length) as usize, 0);
        native::broadcast(bytes);
    }

    fn transfer(&self, from: usize, to: usize, bytes: &mut Vec<u8>) {
        if from == to {
            return;
        }
        let mut length = (bytes.len() as u64).to_le_bytes();
        native::transfer(from, to, &mut length);
        bytes.resize(u64::from_le_bytes(length) as usize, 0);
        native::transfer(from, to, bytes);
    }
}

impl MatrixCommunicator for Processes {
    fn has_matrices(&self) -> bool {
        true
    }

    fn matrix(&self, rows: &Rows<'_>) -> Option<Box<dyn DistributedMatrix>> {
        Some(Box::new(Matrix::new(rows)))
    }
}
