//! The processes that a run is one of, where the program is built for several and a launcher of MPI started it.

pub(crate) use processes::{abort, is_not_root, join, part};

#[cfg(feature = "petsc")]
mod processes {
    use std::env;
    use std::sync::OnceLock;

    use anyhow::Context;
    use ligament_analysis::ranks::{Exchange, Together};
    use ligament_petsc::Processes;
    use rayon::ThreadPoolBuilder;

    /// Variables by which launchers tell a process that it is one of several.
    const LAUNCHED: [&str; 4] = ["OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "PMIX_RANK", "PMI_RANK"];

    /// Time for which a process that failed waits for the others: those that met the same error are there at once.
    const PATIENCE: f64 = 5.0;

    static PROCESSES: OnceLock<Processes> = OnceLock::new();

    /// Joins the processes that a launcher of MPI started; none where nothing did. A process has one thread unless its case says
    /// otherwise: there is one process for each processor.
    ///
    /// # Errors
    ///
    /// If MPI was started before, or threads cannot be started.
    pub(crate) fn join() -> anyhow::Result<Option<Together>> {
        if !LAUNCHED.iter().any(|name| env::var_os(name).is_some()) {
            return Ok(None);
        }
        let pool = ThreadPoolBuilder::new().num_threads(1).build_global();
        pool.context("the threads were started before the processes")?;
        let started = Processes::start()?;
        Ok(Some(Together(PROCESSES.get_or_init(|| started))))
    }

    /// Whether this process is one of several and not their first, which alone tells and writes.
    pub(crate) fn is_not_root() -> bool {
        PROCESSES.get().is_some_and(|it| it.rank() > 0)
    }

    /// Waits for the others at the end, not for long after an error; tells whether all came.
    pub(crate) fn part(has_failed: bool) -> bool {
        let Some(processes) = PROCESSES.get() else {
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
        if let Some(processes) = PROCESSES.get() {
            processes.abort(1);
        }
    }
}

#[cfg(not(feature = "petsc"))]
mod processes {
    use std::env;

    use anyhow::ensure;
    use ligament_analysis::ranks::Together;

    /// The variable by which Open MPI tells how many processes it has started.
    const LAUNCHED: &str = "OMPI_COMM_WORLD_SIZE";

    /// None: this program is one process.
    ///
    /// # Errors
    ///
    /// If several were started together: all of them would do the same, into the same folder.
    pub(crate) fn join() -> anyhow::Result<Option<Together>> {
        let started = env::var(LAUNCHED).ok().and_then(|it| it.parse().ok());
        let started: usize = started.unwrap_or(1);
        ensure!(
            started == 1,
            "{started} processes were started together, and this program was built to be one: build it with `cargo build --release \
             --features petsc`, or start it without mpirun"
        );
        Ok(None)
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
