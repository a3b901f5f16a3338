//! Processors that other programs leave to this one.

use std::fs;
use std::thread;

/// Tasks of all programs that run or wait for a processor at this moment, the one that asks left out; 0 where the system does not tell.
pub(crate) fn tasks_of_others() -> usize {
    let load = fs::read_to_string("/proc/loadavg").unwrap_or_default();
    runnable(&load).unwrap_or(1).saturating_sub(1)
}

/// How many of so many threads find a processor for themselves beside the tasks of others; one at least.
pub(crate) fn free_threads(tasks: usize, threads: usize) -> usize {
    let processors = thread::available_parallelism().map_or(threads, usize::from);
    processors.saturating_sub(tasks).clamp(1, threads)
}

/// The tasks that run or wait, the first number of the fourth field.
fn runnable(load: &str) -> Option<usize> {
    let (runnable, _) = load.split_whitespace().nth(3)?.split_once('/')?;
    runnable.parse().ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn runnable_tasks_are_read() {
        assert_eq!(runnable("2.05 2.01 1.96 3/512 40871\n"), Some(3));
        assert_eq!(runnable("2.05 2.01 1.96"), None);
        assert_eq!(runnable(""), None);
    }

    #[test]
    fn threads_share_the_processors_with_others() {
        let processors = thread::available_parallelism().unwrap().get();
        assert_eq!(free_threads(0, processors), processors);
        assert_eq!(free_threads(0, 1), 1);
        assert_eq!(free_threads(processors, processors), 1);
        assert_eq!(free_threads(usize::MAX, 4), 1);
        assert_eq!(free_threads(1, processors), (processors - 1).max(1));
    }
}
