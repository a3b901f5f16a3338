//! What processes that share a body out tell each other: neighbours what is near cuts, and all of them nothing of the size of the body when
//! a bond breaks. The processes are threads here.
#![allow(clippy::unwrap_used, clippy::print_stdout)]

use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

use ligament::run::follow;
use ligament_analysis::Termination;
use ligament_analysis::distributed_matrix::{
    Communicator, DistributedMatrix, MatrixCommunicator, Rows,
};
use ligament_analysis::history::{Observer, ObserverError, StepRecord, View};
use ligament_model::connected::first_points;
use ligament_model::ghosts::Ghosts;
use ligament_model::prefix_sums::exclusive_prefix_sums;
use ligament_model::subdomain::{Partition, Subdomain};
use verification::bench::Bench;
use verification::threads_as_ranks::on_ranks;

const RANKS: usize = 3;

/// Points in a row, of which each sees the two on either side: values come from the ranks that have them, and stay as they are elsewhere.
#[test]
fn values_of_ghosts_are_those_of_their_ranks() {
    const POINTS: usize = 20;
    on_ranks(RANKS, |ranks| {
        let halve = |points: &mut [u32]| points.sort_unstable();
        let subdomain = Subdomain::new(Partition::new(POINTS, RANKS, &halve), ranks.clone());
        let near = |point: u32| point.saturating_sub(2)..(point + 3).min(POINTS as u32);
        let ghosts = Ghosts::new(&subdomain, subdomain.owned().flat_map(near));
        let value = |point: u32| [f64::from(point), f64::from(ranks.rank() as u32)];
        let mut values: Vec<[f64; 2]> = (0..POINTS as u32).map(value).collect();
        ghosts.update(values.as_flattened_mut(), 2);
        let first = subdomain.owned().next().unwrap();
        let last = first + subdomain.owned().len() as u32 - 1;
        for (point, told) in (0..).zip(values) {
            let is_seen = (first.saturating_sub(2)..last + 3).contains(&point);
            let from = if is_seen {
                subdomain.rank(point)
            } else {
                ranks.rank()
            };
            assert_eq!(told, [f64::from(point), from as f64], "{point}");
        }
        assert_eq!(ghosts.points().len(), if ranks.rank() == 1 { 4 } else { 2 });
    });
}

/// A rank with every third point and two others: sums over all points of smaller numbers in the body, values of points by their numbers, and
/// parts of a chain with a gap, by their first points.
#[test]
fn local_points_are_those_of_the_body() {
    const POINTS: u32 = 20;
    on_ranks(RANKS, |ranks| {
        let halve = |points: &mut [u32]| points.sort_unstable_by_key(|it| (it % 3, *it));
        let whole = Subdomain::new(Partition::new(POINTS as usize, RANKS, &halve), ranks);
        let read = [3, 17];
        let points: Vec<u32> = (0..POINTS)
            .filter(|it| whole.owns(*it) || read.contains(it))
            .collect();
        let subdomain = whole.part(&points);
        assert_eq!(subdomain.n_points(), points.len());
        assert_eq!(subdomain.n_all(), POINTS as usize);
        for (point, &number) in (0..).zip(&points) {
            assert_eq!(subdomain.number(point), number);
            assert_eq!(subdomain.point(number), Some(point));
            assert_eq!(subdomain.owns(point), whole.owns(number));
            assert_eq!(subdomain.place(point), whole.place(number));
        }
        let squares: Vec<f64> = subdomain
            .owned()
            .map(|point| f64::from(subdomain.number(point).pow(2)))
            .collect();
        let sums = exclusive_prefix_sums(&subdomain, &squares);
        for (point, sum) in subdomain.owned().zip(sums) {
            let before = 0..subdomain.number(point);
            assert_eq!(sum, f64::from(before.map(|it| it * it).sum::<u32>()));
        }
        let mut values: Vec<f64> = points.iter().map(|_| f64::NAN).collect();
        for point in subdomain.owned() {
            values[point as usize] = f64::from(subdomain.number(point));
        }
        Ghosts::all(&subdomain).update(&mut values, 1);
        let numbers: Vec<f64> = points.iter().map(|it| f64::from(*it)).collect();
        assert_eq!(values, numbers);
    });
}

/// A chain of points over several ranks with a gap falls into two parts, whose first points all ranks know.
#[test]
fn parts_have_their_first_points() {
    const POINTS: u32 = 20;
    on_ranks(RANKS, |ranks| {
        let halve = |points: &mut [u32]| points.sort_unstable();
        let subdomain = Subdomain::new(Partition::new(POINTS as usize, RANKS, &halve), ranks);
        let pairs = (0..POINTS - 1).filter(|it| *it != 8).map(|it| [it, it + 1]);
        let pairs = pairs.filter(|ends| subdomain.contains_bond(*ends));
        let firsts = first_points(&subdomain, pairs);
        let expected: Vec<u32> = (0..POINTS).map(|it| if it > 8 { 9 } else { 0 }).collect();
        assert_eq!(firsts, expected);
    });
}

/// Ranks that count the numbers that go to all of them.
#[derive(Debug)]
struct Counting {
    ranks: Arc<dyn MatrixCommunicator>,
    to_all: AtomicUsize,
}

impl Counting {
    fn count(&self, numbers: usize) {
        self.to_all.fetch_add(numbers, Ordering::Relaxed);
    }
}

impl Communicator for Counting {
    fn rank(&self) -> usize {
        self.ranks.rank()
    }

    fn size(&self) -> usize {
        self.ranks.size()
    }

    fn all_reduce_max(&self, values: &mut [f64]) {
        self.count(values.len());
        self.ranks.all_reduce_max(values);
    }

    fn all_gather(&self, own: &[f64], counts: &[usize]) -> Vec<f64> {
        self.count(counts.iter().sum());
        self.ranks.all_gather(own, counts)
    }

    fn all_to_all(&self, own: &[f64], to: &[usize], from: &[usize]) -> Vec<f64> {
        self.ranks.all_to_all(own, to, from)
    }

    fn broadcast(&self, bytes: &mut Vec<u8>) {
        self.ranks.broadcast(bytes);
    }

    fn transfer(&self, from: usize, to: usize, bytes: &mut Vec<u8>) {
        self.ranks.transfer(from, to, bytes);
    }

    fn poison(&self) -> f64 {
        self.ranks.poison()
    }
}

impl MatrixCommunicator for Counting {
    fn has_matrices(&self) -> bool {
        true
    }

    fn matrix(&self, rows: &Rows<'_>) -> Option<Box<dyn DistributedMatrix>> {
        self.ranks.matrix(rows)
    }
}

/// Strip that breaks in the middle, which is far from its ends.
fn strip(cells: usize, bonds: usize) -> String {
    format!(
        r#"
lattice = {{ cells = [{cells}, 6], spacing = 0.002, set = {{ left = {{ left = 1 }}, right = {{ right = 1 }} }} }}
material = {{ young = 30e9, poisson = 0.2, tensile_strength = 3e6 }}
model = {{ law = "nhpd", horizon_factor = 3.0 }}
precrack = [{{ points = [[{middle}, -0.001], [{middle}, 0.003]] }}]
support = [{{ group = "left", displacement = {{ x = 0.0, y = 0.0 }} }}]
load = [{{ group = "right", displacement = {{ x = 1e-4 }} }}]
fracture = {{ control = "event", tie_tolerance = 1e-6, stop = {{ bonds = {bonds} }} }}
"#,
        middle = 0.001 * cells as f64 + 1e-4
    )
}

/// Asks for no checkpoint, which is one of the whole body.
struct Unasking;

impl Observer for Unasking {
    fn asks(&mut self, _: Option<&Termination>) -> Result<bool, ObserverError> {
        Ok(false)
    }

    fn step(&mut self, _: &StepRecord, _: &View<'_>) -> Result<(), ObserverError> {
        Ok(())
    }
}

/// Numbers that go to all ranks in a run, and its states.
fn told(cells: usize, bonds: usize) -> [f64; 2] {
    let told = on_ranks(RANKS, |ranks| {
        let counting = Arc::new(Counting {
            ranks,
            to_all: AtomicUsize::new(0),
        });
        let bench = Bench::on_ranks(&strip(cells, bonds), &[], counting.clone());
        let before = counting.to_all.load(Ordering::Relaxed);
        let outcome = follow(&bench.problem(), &bench.model.setup.analysis, &mut Unasking).unwrap();
        assert!(outcome.broken_bonds >= bonds);
        let all = counting.to_all.load(Ordering::Relaxed) - before;
        [all as f64, outcome.history.len() as f64]
    });
    told[0]
}

/// A body twice as long tells all ranks as much in a breakage: what they know at its ends and at the crack is no more.
#[test]
fn breakages_tell_all_ranks_nothing_of_the_size_of_the_body() {
    let [short, long] = [24, 48].map(|cells| {
        let [few, many] = [6, 24].map(|bonds| told(cells, bonds));
        let a_state = (many[0] - few[0]) / (many[1] - few[1]);
        println!("{cells} cells: {few:?} and {many:?}, {a_state:.0} numbers a state");
        a_state
    });
    // What one more solution in some state tells.
    let chance = 1.1;
    assert!(long < chance * short, "{short:.0} and {long:.0} numbers");
}
