//! Number of processors that other programs leave free.

use std::fs;
use std::thread;
use std::time::Duration;

/// Number of samples of the tasks of other programs, a millisecond apart, because some tasks, such as tasks of the system that write files,
/// run for a moment only.
const LOOKS: usize = 5;

/// Least number of tasks of all programs that run or wait for a processor in some milliseconds, without the calling one; 0 where unknown.
pub(crate) fn tasks_of_others() -> usize {
    let mut least = usize::MAX;
    for _ in 0..LOOKS {
        let load = fs::read_to_string("/proc/loadavg").unwrap_or_default();
        least = least.min(runnable(&load).unwrap_or(1).saturating_sub(1));
        if least == 0 {
            break;
        }
        thread::sleep(Duration::from_millis(1));
    }
    least
}

/// Number of `threads` with a processor of their own beside `tasks` of other programs, at least one.
pub(crate) fn free_threads(tasks: usize, threads: usize) -> usize {
    let processors = thread::available_parallelism().map_or(threads, usize::from);
    processors.saturating_sub(tasks).clamp(1, threads)
}

/// Number of tasks that run or wait, the first number of the fourth field of `/proc/loadavg`.
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
