//! Collective communication between the processes of a run, in the words of MPI.

use std::fmt::Debug;

/// Numbers, of all processes together, that are summed at a time.
const PIECE: usize = 1 << 18;

/// The processes of a run. Every function but [`rank`](Self::rank), [`size`](Self::size), [`poison`](Self::poison) and
/// [`transfer`](Self::transfer) is collective: all processes call it in the same order, from one thread each. The results of a reduction, an all-gather or a broadcast are the same to the
/// bit on all processes. A failure on one process ends all.
pub trait Communicator: Debug + Send + Sync {
    /// Rank of this process, from 0.
    fn rank(&self) -> usize;

    /// Number of processes.
    fn size(&self) -> usize;

    /// Replaces each value by its largest over all processes.
    fn all_reduce_max(&self, values: &mut [f64]);

    /// The values of all processes in the order of their ranks, for the number of values of each process, `counts`.
    fn all_gather(&self, own: &[f64], counts: &[usize]) -> Vec<f64>;

    /// Sends `to` values to each process, those for rank 0 first, and returns the `from` values received from each. Processes without values
    /// exchange no message.
    fn all_to_all(&self, own: &[f64], to: &[usize], from: &[usize]) -> Vec<f64>;

    /// Replaces the bytes on every process by the bytes of rank 0.
    fn broadcast(&self, bytes: &mut Vec<u8>);

    /// Moves bytes from one process to another, where they replace those that it has. These two processes alone call it.
    fn transfer(&self, from: usize, to: usize, bytes: &mut Vec<u8>);

    /// Value at points without a known value on a process; NaN in tests, so that a read of one shows.
    fn poison(&self) -> f64 {
        0.0
    }

    /// Replaces each value by its sum over all processes, in the order of their ranks.
    fn all_reduce_sum(&self, values: &mut [f64]) {
        // One piece at a time bounds the memory of the gathered values.
        for piece in values.chunks_mut((PIECE / self.size()).max(1)) {
            let all = self.all_gather(piece, &vec![piece.len(); self.size()]);
            piece.fill(0.0);
            for of_rank in all.chunks_exact(piece.len()) {
                for (sum, value) in piece.iter_mut().zip(of_rank) {
                    *sum += value;
                }
            }
        }
    }

    /// Whether this process is rank 0, which writes tables, checkpoints and messages.
    fn is_root(&self) -> bool {
        self.rank() == 0
    }
}

/// A value that processes exchange as N numbers.
pub trait Wire<const N: usize>: Sized {
    /// Returns the value as numbers.
    fn numbers(&self) -> [f64; N];

    /// Returns the value of some numbers.
    fn from_numbers(numbers: [f64; N]) -> Self;
}

impl<const N: usize> Wire<N> for [f64; N] {
    fn numbers(&self) -> [f64; N] {
        *self
    }

    fn from_numbers(numbers: [f64; N]) -> Self {
        numbers
    }
}

impl Wire<1> for f64 {
    fn numbers(&self) -> [f64; 1] {
        [*self]
    }

    fn from_numbers([number]: [f64; 1]) -> Self {
        number
    }
}

impl Wire<1> for bool {
    fn numbers(&self) -> [f64; 1] {
        [f64::from(u8::from(*self))]
    }

    fn from_numbers([number]: [f64; 1]) -> Self {
        number != 0.0
    }
}

impl Wire<1> for Option<u8> {
    fn numbers(&self) -> [f64; 1] {
        [self.map_or(-1.0, f64::from)]
    }

    fn from_numbers([number]: [f64; 1]) -> Self {
        (number >= 0.0).then_some(number as u8)
    }
}

impl<const N: usize> Wire<N> for [u32; N] {
    fn numbers(&self) -> [f64; N] {
        self.map(f64::from)
    }

    fn from_numbers(numbers: [f64; N]) -> Self {
        numbers.map(|it| it as u32)
    }
}

impl dyn Communicator + '_ {
    /// Concatenates the lists of all processes in the order of their ranks; each process needs the length of its own list only.
    pub fn all_gather_list<T: Wire<N>, const N: usize>(&self, own: Vec<T>) -> Vec<T> {
        if self.size() == 1 {
            return own;
        }
        let own: Vec<f64> = own.iter().flat_map(Wire::numbers).collect();
        let mut counts = vec![0.0; self.size()];
        counts[self.rank()] = own.len() as f64;
        self.all_reduce_max(&mut counts);
        let counts: Vec<usize> = counts.into_iter().map(|it| it as usize).collect();
        let all = self.all_gather(&own, &counts);
        let all = all.as_chunks().0.iter();
        all.map(|numbers| T::from_numbers(*numbers)).collect()
    }

    /// Whether a condition holds on some process.
    pub fn any(&self, local: bool) -> bool {
        let mut some = [f64::from(u8::from(local))];
        self.all_reduce_max(&mut some);
        some[0] > 0.0
    }
}

/// A run of one process, whose exchanges return their arguments.
#[derive(Debug, Clone, Copy, Default)]
pub struct SingleProcess;

impl Communicator for SingleProcess {
    fn rank(&self) -> usize {
        0
    }

    fn size(&self) -> usize {
        1
    }

    fn all_reduce_max(&self, _: &mut [f64]) {}

    fn all_gather(&self, own: &[f64], _: &[usize]) -> Vec<f64> {
        own.to_vec()
    }

    fn all_to_all(&self, own: &[f64], _: &[usize], _: &[usize]) -> Vec<f64> {
        own.to_vec()
    }

    fn broadcast(&self, _: &mut Vec<u8>) {}

    fn transfer(&self, _: usize, _: usize, _: &mut Vec<u8>) {}

    fn all_reduce_sum(&self, _: &mut [f64]) {}
}
