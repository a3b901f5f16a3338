//! Time and memory of the stages of a run.

use std::time::Instant;

use ligament_output::summary::Stage;

/// Stages completed so far, with time and memory.
#[derive(Debug, Default)]
pub struct Stages {
    done: Vec<Stage>,
    start: Option<Instant>,
}

impl Stages {
    /// Runs a stage and records its time and memory.
    pub fn time<T>(&mut self, name: &'static str, stage: impl FnOnce() -> T) -> T {
        self.begin();
        let result = stage();
        self.end(name);
        result
    }

    /// Begins a stage.
    pub(crate) fn begin(&mut self) {
        self.start = Some(Instant::now());
    }

    /// Ends the current stage and records its time and memory.
    pub(crate) fn end(&mut self, name: &'static str) {
        let start = self.start.take();
        self.done.push(Stage {
            name: name.into(),
            seconds: start.map_or(0.0, |start| start.elapsed().as_secs_f64()),
            peak_bytes: peak_memory(),
        });
    }

    /// Completed stages in their order.
    pub fn done(&self) -> &[Stage] {
        &self.done
    }
}

/// Peak resident memory of this process, bytes, where known (Linux).
fn peak_memory() -> Option<u64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status
        .lines()
        .find_map(|line| line.strip_prefix("VmHWM:"))?;
    let kibibytes: u64 = line.trim().strip_suffix("kB")?.trim().parse().ok()?;
    Some(1024 * kibibytes)
}
