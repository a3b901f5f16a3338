//! Signals: the wish of a user, or of the system, that a run stop, and files that grow beyond a limit.

use std::io;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use signal_hook::consts::{SIGINT, SIGTERM};
use signal_hook::flag;

/// Signals that ask a program to stop: the keyboard's, the system's, and that of a terminal which goes away.
#[cfg(unix)]
const SIGNALS: [i32; 3] = [SIGINT, SIGTERM, signal_hook::consts::SIGHUP];
#[cfg(not(unix))]
const SIGNALS: [i32; 2] = [SIGINT, SIGTERM];

/// What a shell reports of a program that a signal ended, less the number of the signal.
const ENDED_BY_SIGNAL: i32 = 128;

/// Whether a signal came that asks the program to stop; by default none is awaited, and any ends the program.
#[derive(Debug, Clone, Default)]
pub(crate) struct StopSignal(Arc<AtomicBool>);

impl StopSignal {
    /// The signals, awaited from here on: the first is kept to be asked for, the second ends the program.
    ///
    /// # Errors
    ///
    /// If the system does not let it.
    pub(crate) fn awaited() -> io::Result<Self> {
        let stop = Self::default();
        for signal in SIGNALS {
            // In this order: the first signal finds nothing to end yet.
            flag::register_conditional_shutdown(signal, ENDED_BY_SIGNAL + signal, stop.0.clone())?;
            flag::register(signal, stop.0.clone())?;
        }
        Ok(stop)
    }

    /// Whether one came.
    pub(crate) fn came(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }
}

/// Lets a write fail with an error, which names the file, where a limit such as that of `ulimit -f` is exceeded; by default the signal
/// of that ends the program without a word.
///
/// # Errors
///
/// If the system does not let it.
#[cfg(unix)]
pub(crate) fn report_large_files() -> io::Result<()> {
    // A handler, unlike a signal that is ignored, does not pass on to programs that this one calls.
    let signal = signal_hook::consts::signal::SIGXFSZ;
    flag::register(signal, Arc::new(AtomicBool::new(false))).map(|_| ())
}

/// Systems without the signal report it anyway.
#[cfg(not(unix))]
pub(crate) fn report_large_files() -> io::Result<()> {
    Ok(())
}
