//! Loops on all threads, divided into tasks before they start. Only `run` knows rayon, and it knows a task as a function behind a reference:
//! rayon's functions are compiled once, instead of once for each loop.

use std::ops::Range;
use std::sync::{Mutex, PoisonError};

use rayon::prelude::*;

/// Number of values in a task of a loop over arrays.
pub const CHUNK: usize = 4096;

/// Largest number of tasks of a loop over numbers, for each thread: so many that threads finish together.
const TASKS: usize = 16;

/// Least number of numbers of a task.
const LEAST: usize = 16;

/// Values of a function of items, in their order. Each item is a task.
pub fn map<T: Send, R: Send>(
    items: impl IntoIterator<Item = T>,
    value: impl Fn(T) -> R + Sync,
) -> Vec<R> {
    let items = items.into_iter();
    complete(
        items.map(|it| Mutex::new((Some(it), None))).collect(),
        &value,
    )
}

/// Calls a function with each item. Each item is a task.
pub fn for_each<T: Send>(items: impl IntoIterator<Item = T>, visit: impl Fn(T) + Sync) {
    map(items, visit);
}

/// Values of a function of the numbers 0..n, shape (n), written over as many copies of any value: zeros take no time.
pub fn values<T: Clone + Send>(n: usize, any: T, value: impl Fn(usize) -> T + Sync) -> Vec<T> {
    let mut values = vec![any; n];
    let size = task_size(n);
    let tasks = values.chunks_mut(size).enumerate();
    for_each(tasks, |(task, values)| {
        for (number, to) in (size * task..).zip(values) {
            *to = value(number);
        }
    });
    values
}

/// Values of a function of ranges of the numbers 0..n, in their order.
pub fn of_ranges<R: Send>(n: usize, value: impl Fn(Range<usize>) -> R + Sync) -> Vec<R> {
    let size = task_size(n);
    let first = (0..n).step_by(size);
    map(first, |first| value(first..n.min(first + size)))
}

/// All values of a function of the numbers 0..n that has any number of values for each, in their order.
pub fn flat_map<I: IntoIterator<Item: Send>>(
    n: usize,
    values: impl Fn(usize) -> I + Sync,
) -> Vec<I::Item> {
    let of_range = |range: Range<usize>| range.flat_map(&values).collect::<Vec<_>>();
    let of_ranges = of_ranges(n, of_range);
    let mut all = Vec::with_capacity(of_ranges.iter().map(Vec::len).sum());
    of_ranges.into_iter().for_each(|it| all.extend(it));
    all
}

/// Largest value of a function of the numbers 0..n, and at least 0.
pub fn largest(n: usize, value: impl Fn(usize) -> f64 + Sync) -> f64 {
    let of_range = |range: Range<usize>| range.map(&value).fold(0.0, f64::max);
    of_ranges(n, of_range).into_iter().fold(0.0, f64::max)
}

fn task_size(n: usize) -> usize {
    n.div_ceil(TASKS * rayon::current_num_threads()).max(LEAST)
}

/// An item until its task runs, and then its value.
type Task<T, R> = Mutex<(Option<T>, Option<R>)>;

fn complete<T: Send, R: Send>(tasks: Vec<Task<T, R>>, value: &(dyn Fn(T) -> R + Sync)) -> Vec<R> {
    run(tasks.len(), &|number| {
        let mut task = tasks[number].lock().unwrap_or_else(PoisonError::into_inner);
        task.1 = task.0.take().map(value);
    });
    let tasks = tasks.into_iter();
    let values = tasks.map(|it| it.into_inner().unwrap_or_else(PoisonError::into_inner).1);
    values.flatten().collect()
}

#[inline(never)]
fn run(n_tasks: usize, task: &(dyn Fn(usize) + Sync)) {
    (0..n_tasks).into_par_iter().with_max_len(1).for_each(task);
}

#[cfg(test)]
mod tests {
    use super::*;

    const SIZES: [usize; 5] = [0, 1, LEAST, TASKS * LEAST + 1, 10_007];

    #[test]
    fn values_are_in_the_order_of_the_numbers() {
        for n in SIZES {
            let squares: Vec<usize> = (0..n).map(|it| it * it).collect();
            assert_eq!(values(n, 0, |it| it * it), squares);
            let odd: Vec<usize> = (0..n).filter(|it| it % 2 == 1).collect();
            assert_eq!(flat_map(n, |it| (it % 2 == 1).then_some(it)), odd);
            assert_eq!(largest(n, |it| it as f64), n.saturating_sub(1) as f64);
            let covered: Vec<usize> = of_ranges(n, |it| it).into_iter().flatten().collect();
            assert_eq!(covered, (0..n).collect::<Vec<_>>());
        }
    }

    #[test]
    fn a_task_may_change_its_item_and_start_a_loop() {
        let mut numbers: Vec<usize> = (0..1000).collect();
        let sums = map(numbers.chunks_mut(64), |chunk| {
            chunk.iter_mut().for_each(|it| *it *= 2);
            values(chunk.len(), 0, |place| chunk[place])
                .iter()
                .sum::<usize>()
        });
        assert_eq!(sums.iter().sum::<usize>(), 999_000);
        assert_eq!(numbers[999], 1998);
    }
}
