//! Lists over all points and bonds of a body in a checkpoint, which several ranks write and read in parts: the bytes are those of one
//! process, and no rank receives or keeps more than a slice. The ranks are threads.
#![allow(clippy::unwrap_used)]

use std::fmt::Debug;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

use ligament_analysis::lists_of_all::{read_by_index, write_by_index, write_rows};
use ligament_analysis::serial::{SLICE, Serial, write_values};
use ligament_model::communicator::Communicator;
use ligament_model::subdomain::{Partition, Subdomain};
use verification::threads_as_ranks::on_ranks;

const RANKS: usize = 3;

/// Points with three values each, so that a list has four slices, the last of which is not full.
const POINTS: usize = 9 * SLICE / 8;

/// A communicator that records the largest number of values that this rank received at a time.
#[derive(Debug)]
struct Recording<C> {
    inner: C,
    largest: Arc<AtomicUsize>,
}

impl<C> Recording<C> {
    fn noted(&self, received: Vec<f64>) -> Vec<f64> {
        self.largest.fetch_max(received.len(), Ordering::Relaxed);
        received
    }
}

impl<C: AsRef<dyn Communicator> + Debug + Send + Sync> Communicator for Recording<C> {
    fn rank(&self) -> usize {
        self.inner.as_ref().rank()
    }

    fn size(&self) -> usize {
        self.inner.as_ref().size()
    }

    fn all_reduce_max(&self, values: &mut [f64]) {
        self.inner.as_ref().all_reduce_max(values);
    }

    fn all_gather(&self, own: &[f64], counts: &[usize]) -> Vec<f64> {
        self.noted(self.inner.as_ref().all_gather(own, counts))
    }

    fn all_to_all(&self, own: &[f64], to: &[usize], from: &[usize]) -> Vec<f64> {
        self.noted(self.inner.as_ref().all_to_all(own, to, from))
    }

    fn broadcast(&self, bytes: &mut Vec<u8>) {
        self.inner.as_ref().broadcast(bytes);
    }

    fn transfer(&self, from: usize, to: usize, bytes: &mut Vec<u8>) {
        self.inner.as_ref().transfer(from, to, bytes);
    }
}

/// The subdomain of a rank; owners alternate in blocks of a few points, so that each slice has values of all.
fn subdomain(communicator: Arc<dyn Communicator>) -> Subdomain {
    let by_block = |points: &mut [u32]| points.sort_by_key(|it| (it / 7) % RANKS as u32);
    Subdomain::new(Partition::new(POINTS, RANKS, &by_block), communicator)
}

/// A value of the list: a third are zero, and no two others are the same.
fn value(index: usize) -> f64 {
    (index % 3) as f64 * (index as f64 + 0.5)
}

/// Work of each rank with its subdomain, and the largest number of values that it received at a time.
fn received<T: Send>(work: impl Fn(&Subdomain) -> T + Sync) -> Vec<(T, usize)> {
    on_ranks(RANKS, |ranks| {
        let largest = Arc::new(AtomicUsize::new(0));
        let inner: Arc<dyn Communicator> = ranks;
        let recording = Recording {
            inner,
            largest: largest.clone(),
        };
        let done = work(&subdomain(Arc::new(recording)));
        (done, largest.load(Ordering::Relaxed))
    })
}

/// Each value comes with its index, so that a slice is received as twice as many numbers.
#[test]
fn a_list_by_index_goes_through_rank_zero_in_slices() {
    let whole: Vec<f64> = (0..3 * POINTS).map(value).collect();
    let mut expected = Vec::new();
    whole.len().write(&mut expected);
    write_values(&whole, &0.0, &mut expected);
    let of_ranks = received(|subdomain| {
        let points = subdomain.owned().map(|it| subdomain.number(it) as usize);
        let own = points.flat_map(|point| 3 * point..3 * point + 3);
        let sent = own.clone().filter(|&it| value(it) != 0.0);
        let mut bytes = Vec::new();
        let numbered = sent.map(|it| (it, value(it)));
        write_by_index(subdomain, 3 * POINTS, numbered, 0.0, &mut bytes);
        (own.collect::<Vec<usize>>(), bytes)
    });
    assert!(of_ranks[0].0.1 == expected, "the bytes of one process");
    for ((own, _), largest) in &of_ranks {
        assert!(*largest <= 2 * SLICE, "{largest} values at a time");
        let mut bytes = expected.as_slice();
        let count = usize::read(&mut bytes).unwrap();
        let read: Vec<f64> = read_by_index(count, &0.0, own.iter().copied(), &mut bytes).unwrap();
        assert!(read.iter().zip(own).all(|(it, &index)| *it == value(index)));
        assert!(read.len() == own.len() && bytes.is_empty());
    }
    assert!(of_ranks[0].1 > SLICE, "slices are full");
}

/// Rows stay in the order of the ranks, each of which has more than a slice of them.
#[test]
fn rows_go_through_rank_zero_in_slices() {
    let number_of = |rank: usize, it: usize| 10 * it + rank;
    let of_ranks = received(|subdomain| {
        let rank = subdomain.communicator().rank();
        let own = (0..SLICE + 10 * rank + 1).map(|it| number_of(rank, it));
        let mut bytes = Vec::new();
        write_rows(subdomain, own.map(|it| (it, value(it))), &mut bytes);
        bytes
    });
    let ranks = (0..RANKS).map(|rank| (rank, SLICE + 10 * rank + 1));
    let numbers = ranks.flat_map(|(rank, count)| (0..count).map(move |it| number_of(rank, it)));
    let rows: Vec<(u32, [f64; 1])> = numbers.map(|it| (it as u32, [value(it)])).collect();
    let mut expected = Vec::new();
    rows.write(&mut expected);
    assert!(of_ranks[0].0 == expected);
    assert!(of_ranks.iter().all(|(_, largest)| *largest <= 2 * SLICE));
}
