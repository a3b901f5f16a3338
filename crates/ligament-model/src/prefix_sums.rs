//! Sums over the points of a body before each point, in the order of their numbers.

use crate::subdomain::Subdomain;

/// Sums of the values at owned points (n_owned) over all points of the body of smaller number, for each owned point; collective.
///
/// Each rank adds up the values of a range of numbers, so that no process needs the values of all points.
pub fn exclusive_prefix_sums(subdomain: &Subdomain, values: &[f64]) -> Vec<f64> {
    let (n_all, n_ranks) = (subdomain.n_all(), subdomain.n_ranks());
    let communicator = subdomain.communicator();
    let first = |rank: usize| rank * n_all / n_ranks;
    let numbers = subdomain.owned().map(|point| subdomain.number(point));
    let numbers: Vec<u32> = numbers.collect();
    let before = |rank| numbers.partition_point(|&it| (it as usize) < first(rank));
    let to: Vec<usize> = (0..n_ranks)
        .map(|rank| before(rank + 1) - before(rank))
        .collect();
    let one = vec![1; n_ranks];
    let counts: Vec<f64> = to.iter().map(|&count| count as f64).collect();
    let from = communicator.all_to_all(&counts, &one, &one).into_iter();
    let from: Vec<usize> = from.map(|count| count as usize).collect();
    let twice = |counts: &[usize]| counts.iter().map(|it| 2 * it).collect::<Vec<_>>();
    let rows = numbers.iter().zip(values);
    let rows: Vec<f64> = rows
        .flat_map(|(&number, &value)| [f64::from(number), value])
        .collect();
    let received = communicator.all_to_all(&rows, &twice(&to), &twice(&from));
    let rank = communicator.rank();
    let mut sums = vec![0.0; first(rank + 1) - first(rank) + 1];
    let place = |number: f64| number as usize - first(rank);
    for [number, value] in received.as_chunks().0 {
        sums[place(*number) + 1] = *value;
    }
    for place in 1..sums.len() {
        sums[place] += sums[place - 1];
    }
    let total = sums.last().copied().unwrap_or_default();
    let totals = subdomain.all_gather_list(vec![total]);
    let before: f64 = totals[..rank].iter().sum();
    let answers = received.as_chunks::<2>().0.iter();
    let answers: Vec<f64> = answers
        .map(|[number, _]| before + sums[place(*number)])
        .collect();
    communicator.all_to_all(&answers, &from, &to)
}
