//! The processes of a run, where a launcher of MPI started them and the program is built for several.

#[cfg(feature = "petsc")]
pub(crate) use mpi::{abort, is_not_root, join, part};
#[cfg(not(feature = "petsc"))]
pub(crate) use serial::{abort, is_not_root, join, part};

#[cfg(feature = "petsc")]
mod mpi {
    use std::env;
    use std::sync::Arc;

    use anyhow::Context;
    use ligament_analysis::distributed_matrix::{Communicator, MatrixCommunicator, Solo};
    use ligament_petsc::Processes;
    use rayon::ThreadPoolBuilder;

    /// Variables by which launchers tell a process that it is one of several.
    const LAUNCHED: [&str; 4] = ["OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "PMIX_RANK", "PMI_RANK"];

    /// Time for which a process that failed waits for the others: those that met the same error are there at once.
    const PATIENCE: f64 = 5.0;

    /// The processes that a launcher of MPI started; this one alone where nothing did. A process has one thread unless its case says
    /// otherwise: there is one process for each processor.
    ///
    /// # Errors
    ///
    /// If MPI was started before, or threads cannot be started.
    pub(crate) fn join() -> anyhow::Result<Arc<dyn MatrixCommunicator>> {
        if !LAUNCHED.iter().any(|name| env::var_os(name).is_some()) {
            return Ok(Arc::new(Solo));
        }
        let pool = ThreadPoolBuilder::new().num_threads(1).build_global();
        pool.context("the threads were started before the processes")?;
        Ok(Arc::new(Processes::start()?))
    }

    /// Whether this process is one of several and not rank 0, which alone prints and writes.
    pub(crate) fn is_not_root() -> bool {
        Processes::started().is_some_and(|it| !it.is_root())
    }

    /// Waits for the others at the end, not for long after an error; tells whether all came.
    pub(crate) fn part(has_failed: bool) -> bool {
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
    use ligament_analysis::distributed_matrix::{MatrixCommunicator, Solo};

    /// The variable by which Open MPI tells how many processes it has started.
    const LAUNCHED: &str = "OMPI_COMM_WORLD_SIZE";

    /// This process alone: the program is built for one.
    ///
    /// # Errors
    ///
    /// If several were started together: all of them would do the same, into the same folder.
    pub(crate) fn join() -> anyhow::Result<Arc<dyn MatrixCommunicator>> {
        let started = env::var(LAUNCHED).ok().and_then(|it| it.parse().ok());
        let started: usize = started.unwrap_or(1);
        ensure!(
            started == 1,
            "{started} processes were started together, and this program was built to be one: build it with `cargo build --release \
             --features petsc`, or start it without mpirun"
        );
        Ok(Arc::new(Solo))
    }

    /// This process is the first.
    pub(crate) fn is_not_root() -> bool {
        false
    }

    /// All came: there is one.
    pub(crate) fn part(_has_failed: bool) -> bool {
        true
    }

    /// Nothing is left to end.
    pub(crate) fn abort() {}
}
