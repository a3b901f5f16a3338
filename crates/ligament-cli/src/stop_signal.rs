//! Signals that stop a run, and the signal of files beyond a size limit.

use std::io;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

#[cfg(not(target_family = "wasm"))]
use signal_hook::{
    consts::{SIGINT, SIGTERM},
    flag,
};

/// Signals that stop a program: of the keyboard, of the system, and of a closed terminal.
#[cfg(unix)]
const SIGNALS: [i32; 3] = [SIGINT, SIGTERM, signal_hook::consts::SIGHUP];
#[cfg(windows)]
const SIGNALS: [i32; 2] = [SIGINT, SIGTERM];

/// Exit code of a program ended by a signal, minus the number of the signal.
#[cfg(not(target_family = "wasm"))]
const ENDED_BY_SIGNAL: i32 = 128;

/// Flag that is set by a signal to stop; by default no signal is handled, and any ends the program.
#[derive(Debug, Clone, Default)]
pub(crate) struct StopSignal(Arc<AtomicBool>);

impl StopSignal {
    /// Handles the signals from now on: the first sets the flag, the second ends the program. WebAssembly has no signals.
    ///
    /// # Errors
    ///
    /// If the system refuses the handlers.
    pub(crate) fn install() -> io::Result<Self> {
        let stop = Self::default();
        #[cfg(not(target_family = "wasm"))]
        for signal in SIGNALS {
            // The order matters: at the first signal the flag is not yet set.
            flag::register_conditional_shutdown(signal, ENDED_BY_SIGNAL + signal, stop.0.clone())?;
            flag::register(signal, stop.0.clone())?;
        }
        Ok(stop)
    }

    /// Whether a signal to stop was received.
    pub(crate) fn is_received(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }
}

/// Makes writes beyond a limit such as `ulimit -f` fail with an error; by default the signal ends the program without a message.
///
/// # Errors
///
/// If the system refuses the handlers.
#[cfg(unix)]
pub(crate) fn report_large_files() -> io::Result<()> {
    // A handler, unlike an ignored signal, is not inherited by child processes.
    let signal = signal_hook::consts::signal::SIGXFSZ;
    flag::register(signal, Arc::new(AtomicBool::new(false))).map(|_| ())
}

/// Does nothing: systems without the signal report the error by default.
#[cfg(not(unix))]
pub(crate) fn report_large_files() -> io::Result<()> {
    Ok(())
}
