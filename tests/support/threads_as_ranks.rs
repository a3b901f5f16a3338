//! Threads in the place of processes: ranks that share their rows through memory and solve with a dense factor.

use std::collections::{BTreeMap, VecDeque};
use std::fmt::{self, Debug, Formatter};
use std::sync::{Arc, Barrier, Condvar, Mutex};

use ligament_analysis::distributed_matrix::{
    Communicator, DistributedMatrix, MatrixCommunicator, Pivots, Rows, Solved, Tolerated,
};
use ligament_model::subdomain::Subdomain;
use nalgebra::{DMatrix, DVector, Dyn, LU};

/// What all threads see.
struct Table {
    barrier: Barrier,
    slots: Mutex<Vec<Vec<f64>>>,
    /// Bytes on their way between two threads.
    letters: Mutex<BTreeMap<[usize; 2], VecDeque<Vec<u8>>>>,
    arrived: Condvar,
}

/// One of several threads.
#[derive(Clone)]
struct Thread {
    rank: usize,
    table: Arc<Table>,
}

/// A dense matrix of which a thread sets some rows.
struct Dense {
    thread: Thread,
    n_components: usize,
    n_all: usize,
    first: usize,
    own: Vec<f64>,
    couplings: Vec<[usize; 2]>,
    whole: DMatrix<f64>,
    /// Factors of the matrix, on the first rank alone, from the first solution with it on.
    factors: Option<LU<f64, Dyn, Dyn>>,
}

/// Work that several ranks do at the same time, each a thread; gives what each of them makes of it, in their order.
pub fn on_ranks<T: Send>(
    n_ranks: usize,
    work: impl Fn(Arc<dyn MatrixCommunicator>) -> T + Sync,
) -> Vec<T> {
    let table = Arc::new(Table {
        barrier: Barrier::new(n_ranks),
        slots: Mutex::new(vec![Vec::new(); n_ranks]),
        letters: Mutex::default(),
        arrived: Condvar::new(),
    });
    std::thread::scope(|scope| {
        let start = |rank| {
            let thread = Thread {
                rank,
                table: table.clone(),
            };
            let work = &work;
            scope.spawn(move || work(Arc::new(thread)))
        };
        let started: Vec<_> = (0..n_ranks).map(start).collect();
        let ended = started.into_iter().map(|thread| thread.join().unwrap());
        ended.collect()
    })
}

/// Values at the points of a body, as many per point as `n_values`, from those at the points of each rank.
pub fn joined<T: Copy>(of_ranks: &[(Subdomain, Vec<T>)], n_values: usize, usual: T) -> Vec<T> {
    let mut all = vec![usual; n_values * of_ranks[0].0.n_all()];
    for (subdomain, values) in of_ranks {
        let owned = (0..values.len()).filter(|it| subdomain.owns((it / n_values) as u32));
        owned.for_each(|it| all[subdomain.index_in_body(it, n_values)] = values[it]);
    }
    all
}

impl Thread {
    /// The values of all threads.
    fn exchange(&self, own: &[f64]) -> Vec<Vec<f64>> {
        self.table.slots.lock().unwrap()[self.rank] = own.to_vec();
        self.table.barrier.wait();
        let all = self.table.slots.lock().unwrap().clone();
        self.table.barrier.wait();
        all
    }
}

impl Debug for Thread {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write!(f, "rank {}", self.rank)
    }
}

impl Debug for Dense {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write!(f, "rows of {:?}", self.thread)
    }
}

impl Communicator for Thread {
    fn rank(&self) -> usize {
        self.rank
    }

    fn size(&self) -> usize {
        self.table.slots.lock().unwrap().len()
    }

    fn all_reduce_max(&self, values: &mut [f64]) {
        for of_one in self.exchange(values) {
            for (value, other) in values.iter_mut().zip(of_one) {
                *value = value.max(other);
            }
        }
    }

    fn all_gather(&self, own: &[f64], counts: &[usize]) -> Vec<f64> {
        let all = self.exchange(own);
        let lengths: Vec<usize> = all.iter().map(Vec::len).collect();
        assert_eq!(lengths, counts);
        all.concat()
    }

    fn all_to_all(&self, own: &[f64], to: &[usize], from: &[usize]) -> Vec<f64> {
        assert_eq!([to.len(), from.len()], [self.size(); 2]);
        assert_eq!(to.iter().sum::<usize>(), own.len());
        let counts = to.iter().map(|&count| count as f64);
        let told: Vec<f64> = counts.chain(own.iter().copied()).collect();
        let all = self.exchange(&told).into_iter().zip(from);
        let to_here = all.map(|(told, &count)| {
            let (counts, values) = told.split_at(from.len());
            let start = counts[..self.rank].iter().sum::<f64>() as usize;
            assert_eq!(counts[self.rank], count as f64);
            values[start..start + count].to_vec()
        });
        to_here.collect::<Vec<_>>().concat()
    }

    fn poison(&self) -> f64 {
        f64::NAN
    }

    fn broadcast(&self, bytes: &mut Vec<u8>) {
        let own: Vec<f64> = bytes.iter().map(|&it| f64::from(it)).collect();
        *bytes = self.exchange(&own)[0].iter().map(|&it| it as u8).collect();
    }

    fn transfer(&self, from: usize, to: usize, bytes: &mut Vec<u8>) {
        let mut letters = self.table.letters.lock().unwrap();
        if self.rank == from {
            let queue = letters.entry([from, to]).or_default();
            queue.push_back(bytes.clone());
            self.table.arrived.notify_all();
        }
        if self.rank == to {
            *bytes = loop {
                let queue = letters.entry([from, to]).or_default();
                match queue.pop_front() {
                    Some(letter) => break letter,
                    None => letters = self.table.arrived.wait(letters).unwrap(),
                }
            };
        }
    }
}

impl MatrixCommunicator for Thread {
    fn has_matrices(&self) -> bool {
        true
    }

    fn matrix(&self, rows: &Rows<'_>) -> Option<Box<dyn DistributedMatrix>> {
        let counts = self.exchange(&[rows.couplings.len() as f64]);
        let own = rows.couplings.len() * rows.n_all * rows.n_components.pow(2);
        Some(Box::new(Dense {
            thread: self.clone(),
            n_components: rows.n_components,
            n_all: rows.n_all,
            first: counts[..self.rank].concat().iter().sum::<f64>() as usize,
            own: vec![0.0; own],
            couplings: rows.couplings.to_vec(),
            whole: DMatrix::zeros(0, 0),
            factors: None,
        }))
    }
}

impl Dense {
    fn size(&self) -> usize {
        self.n_all * self.n_components
    }

    /// No more blocks are filled than were announced.
    fn assert_room(&self) {
        let (n, size) = (self.n_components, self.size());
        for (row, couplings) in self.couplings.iter().enumerate() {
            let blocks = (0..self.n_all).filter(|&column| {
                let entry = |k: usize| self.own[(row * n + k / n) * size + column * n + k % n];
                (0..n * n).any(|k| entry(k) != 0.0)
            });
            assert!(blocks.count() <= couplings.iter().sum());
        }
    }
}

impl DistributedMatrix for Dense {
    fn set(&mut self, row: usize, columns: &[usize], blocks: &[f64]) {
        let (n, size) = (self.n_components, self.size());
        let own = row.checked_sub(self.first).unwrap();
        assert!(own < self.couplings.len(), "a row of another rank");
        for (r, values) in blocks.chunks_exact(columns.len() * n).enumerate() {
            for (&column, block) in columns.iter().zip(values.chunks_exact(n)) {
                let from = (own * n + r) * size + column * n;
                self.own[from..from + n].copy_from_slice(block);
            }
        }
    }

    fn assemble(&mut self) {
        self.assert_room();
        let size = self.size();
        let rows = self.thread.exchange(&self.own).concat();
        self.factors = None;
        let mut off = Vec::new();
        if self.thread.rank == 0 {
            self.whole = DMatrix::from_row_slice(size, size, &rows);
            let skew = (&self.whole - self.whole.transpose()).amax();
            off.push(skew / self.whole.amax());
        }
        let off = self.thread.exchange(&off)[0][0];
        // Blocks beside the diagonal come from the same numbers; those on it are symmetric up to rounding.
        assert!(
            off <= 1e-15,
            "the rows of the ranks do not fit together: {off:e} of the largest entry"
        );
    }

    fn precondition(&mut self, motions: &[Vec<f64>], n_coupled: usize) {
        let own = self.couplings.len() * self.n_components;
        assert!(motions.len() >= 3 && motions.iter().all(|it| it.len() == own));
        assert!(n_coupled >= 2);
    }

    fn factorise(&mut self) -> Pivots {
        let eigenvalues = match self.thread.rank {
            0 => self.whole.symmetric_eigenvalues().as_slice().to_vec(),
            _ => Vec::new(),
        };
        let eigenvalues = &self.thread.exchange(&eigenvalues)[0];
        let small = 1e-12 * eigenvalues.iter().fold(0.0, |a: f64, it| a.max(it.abs()));
        let count = |of: &dyn Fn(f64) -> bool| eigenvalues.iter().filter(|it| of(**it)).count();
        Pivots {
            negative: count(&|it| it < -small),
            vanishing: count(&|it| it.abs() <= small),
            positive: count(&|it| it > small),
        }
    }

    fn solve(&mut self, force: &[f64], _: Tolerated<'_>) -> Solved {
        let force = DVector::from_vec(self.thread.exchange(force).concat());
        let motions = match self.thread.rank {
            0 => {
                let factors = (self.factors).get_or_insert_with(|| self.whole.clone().lu());
                let motions = factors.solve(&force);
                motions.map_or(Vec::new(), |it| it.as_slice().to_vec())
            }
            _ => Vec::new(),
        };
        let motions = &self.thread.exchange(&motions)[0];
        assert_eq!(motions.len(), self.size(), "the matrix is singular");
        let from = self.first * self.n_components;
        let own = from..from + self.couplings.len() * self.n_components;
        Solved {
            motions: motions[own].to_vec(),
            iterations: 1,
            decades: 12.0,
            is_definite: true,
        }
    }
}
