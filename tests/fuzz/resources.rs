//! Time and memory that an input takes.

use std::fs;
use std::time::{Duration, Instant};

/// Longest time for an input, on a machine that is busy with other things: what hangs takes for ever.
const LONGEST: Duration = Duration::from_secs(20);

/// Bytes that any input may take, ...
const ANY: u64 = 100_000_000;

/// ... and for each of its own bytes.
const EACH: u64 = 1000;

/// Memory and time from a moment on.
pub(crate) struct Watch {
    begun: Instant,
    resident: Option<u64>,
}

impl Watch {
    /// Begins; the peak of the process is that of now, where the system can do that (Linux).
    pub(crate) fn begin() -> Self {
        let is_reset = fs::write("/proc/self/clear_refs", "5").is_ok();
        Self {
            begun: Instant::now(),
            resident: kibibytes("VmRSS:").filter(|_| is_reset),
        }
    }

    /// What an input of so many bytes took too much of.
    pub(crate) fn excess(&self, length: usize) -> Option<String> {
        let time = self.begun.elapsed();
        if time > LONGEST {
            return Some(format!("it takes {time:.0?}"));
        }
        let taken = kibibytes("VmHWM:")?.saturating_sub(self.resident?);
        (taken > ANY + EACH * length as u64).then(|| format!("it takes {} MB", taken / 1_000_000))
    }
}

fn kibibytes(name: &str) -> Option<u64> {
    let status = fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix(name))?;
    let number: u64 = line.trim().strip_suffix("kB")?.trim().parse().ok()?;
    Some(1024 * number)
}
