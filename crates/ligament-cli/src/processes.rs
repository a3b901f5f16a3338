//! The processes of a run, if an MPI launcher started several and the program is built for them.

#[cfg(feature = "petsc")]
pub(crate) use mpi::{abort, finish, is_not_root, join};
#[cfg(not(feature = "petsc"))]
pub(crate) use serial::{abort, finish, is_not_root, join};

#[cfg(feature = "petsc")]
mod mpi {
    use std::env;
    use std::sync::Arc;

    use anyhow::Context;
    use ligament_analysis::distributed_matrix::{Communicator, MatrixCommunicator, SingleProcess};
    use ligament_petsc::Processes;
    use rayon::ThreadPoolBuilder;

    /// Environment variables that MPI launchers set.
    const LAUNCHED: [&str; 4] = ["OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "PMIX_RANK", "PMI_RANK"];

    /// Time for which a failed process waits for the others, s: processes with the same error arrive at once.
    const PATIENCE: f64 = 5.0;

    /// The processes started by an MPI launcher, or this process alone. Each process has one thread unless its case sets another number.
    ///
    /// # Errors
    ///
    /// If MPI was started before, or threads cannot be started.
    pub(crate) fn join() -> anyhow::Result<Arc<dyn MatrixCommunicator>> {
        if !LAUNCHED.iter().any(|name| env::var_os(name).is_some()) {
            return Ok(Arc::new(SingleProcess));
        }
        let pool = ThreadPoolBuilder::new().num_threads(1).build_global();
        pool.context("the threads were started before the processes")?;
        Ok(Arc::new(Processes::start()?))
    }

    /// Whether this process is a rank other than 0; only rank 0 prints and writes.
    pub(crate) fn is_not_root() -> bool {
        Processes::started().is_some_and(|it| !it.is_root())
    }

    /// Waits for the other processes at the end, after an error for a limited time; returns whether all arrived.
    pub(crate) fn finish(has_failed: bool) -> bool {
        let Some(processes) = Processes::started() else {
            return true;
        };
        let all_came = processes.meet(has_failed.then_some(PATIENCE));
        if all_came {
            processes.end();
        }
        all_came
    }

    /// Ends all processes.
    pub(crate) fn abort() {
        if let Some(processes) = Processes::started() {
            processes.abort(1);
        }
    }
}

#[cfg(not(feature = "petsc"))]
mod serial {
    use std::env;
    use std::sync::Arc;

    use anyhow::ensure;
    use ligament_analysis::distributed_matrix::{MatrixCommunicator, SingleProcess};

    /// Environment variable with the number of processes started by Open MPI.
    const LAUNCHED: &str = "OMPI_COMM_WORLD_SIZE";

    /// This process alone, as the program is built without MPI.
    ///
    /// # Errors
    ///
    /// If several processes were started together, which would all write to the same folder.
    pub(crate) fn join() -> anyhow::Result<Arc<dyn MatrixCommunicator>> {
        let started = env::var(LAUNCHED).ok().and_then(|it| it.parse().ok());
        let started: usize = started.unwrap_or(1);
        ensure!(
            started == 1,
            "{started} processes were started together, and this program was built to be one: build it with `cargo build --release \
             --features petsc`, or start it without mpirun"
        );
        Ok(Arc::new(SingleProcess))
    }

    /// Returns false: this process is rank 0.
    pub(crate) fn is_not_root() -> bool {
        false
    }

    /// Returns true: there is one process.
    pub(crate) fn finish(_has_failed: bool) -> bool {
        true
    }

    /// Does nothing: there are no other processes.
    pub(crate) fn abort() {}
}
