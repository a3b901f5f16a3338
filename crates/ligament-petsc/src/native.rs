//! Bindings to the functions of `petsc.c`, which documents each of them: the only unsafe code.
#![allow(
    unsafe_code,
    reason = "another language is called here and nowhere else"
)]

use std::ffi::{c_int, c_uchar, c_void};
use std::ptr;
use std::sync::{Mutex, MutexGuard, PoisonError};

unsafe extern "C" {
    safe fn ligament_start();
    safe fn ligament_rank() -> c_int;
    safe fn ligament_size() -> c_int;
    safe fn ligament_size_here() -> c_int;
    safe fn ligament_meet(seconds: f64) -> c_int;
    safe fn ligament_end();
    safe fn ligament_abort(code: c_int);
    fn ligament_all_reduce_max(values: *mut f64, n: i64);
    fn ligament_all_gather(own: *const f64, counts: *const i64, all: *mut f64);
    fn ligament_all_to_all(own: *const f64, to: *const i64, from: *const i64, received: *mut f64);
    fn ligament_broadcast(bytes: *mut c_uchar, n: i64);
    fn ligament_transfer(bytes: *mut c_uchar, n: i64, from: c_int, to: c_int);
    fn ligament_matrix_new(
        block_size: i64,
        n_own: i64,
        n_all: i64,
        own_blocks: *const i64,
        other_blocks: *const i64,
    ) -> *mut c_void;
    fn ligament_matrix_free(matrix: *mut c_void);
    fn ligament_matrix_set(
        matrix: *mut c_void,
        row: i64,
        columns: *const i64,
        n: i64,
        values: *const f64,
    );
    fn ligament_matrix_assemble(matrix: *mut c_void);
    fn ligament_matrix_precondition(
        matrix: *mut c_void,
        motions: *const f64,
        n: i64,
        n_coupled: i64,
    );
    fn ligament_matrix_factorise(matrix: *mut c_void, inertia: *mut i64);
    fn ligament_matrix_solve(
        matrix: *mut c_void,
        force: *const f64,
        limits: *const f64,
        norm: f64,
        motions: *mut f64,
        iterations: *mut i64,
        norms: *mut f64,
    ) -> c_int;
}

/// Locked during each call: MPI was started for calls from several threads, one at a time.
static CALLS: Mutex<()> = Mutex::new(());

fn alone() -> MutexGuard<'static, ()> {
    CALLS.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Codes for the end of an iteration, as in `petsc.c`.
pub(crate) const INDEFINITE: i32 = 2;

/// Starts MPI and PETSc; to be called once.
pub(crate) fn start() {
    let _alone = alone();
    ligament_start();
}

pub(crate) fn rank() -> usize {
    ligament_rank() as usize
}

pub(crate) fn size() -> usize {
    ligament_size() as usize
}

pub(crate) fn size_here() -> usize {
    let _alone = alone();
    ligament_size_here() as usize
}

pub(crate) fn meet(seconds: f64) -> bool {
    let _alone = alone();
    ligament_meet(seconds) != 0
}

pub(crate) fn end() {
    let _alone = alone();
    ligament_end();
}

pub(crate) fn abort(code: i32) {
    ligament_abort(code);
}

pub(crate) fn all_reduce_max(values: &mut [f64]) {
    let _alone = alone();
    // SAFETY: exactly as many values are read and written as the slice has.
    unsafe { ligament_all_reduce_max(values.as_mut_ptr(), values.len() as i64) }
}

/// The values of all ranks; `own` has as many values as `counts` gives for this rank.
pub(crate) fn all_gather(own: &[f64], counts: &[i64]) -> Vec<f64> {
    assert_eq!(counts.len(), size(), "a number of values for each rank");
    assert_eq!(counts[rank()], own.len() as i64, "the values of this rank");
    let mut all = vec![0.0; counts.iter().sum::<i64>() as usize];
    let _alone = alone();
    // SAFETY: one count per rank, as many own values as this rank's count, and room for the values of all ranks.
    unsafe { ligament_all_gather(own.as_ptr(), counts.as_ptr(), all.as_mut_ptr()) }
    all
}

/// Exchanges values between all ranks: `to` has the number of values of `own` for each rank, `from` the number of values from each rank.
pub(crate) fn all_to_all(own: &[f64], to: &[i64], from: &[i64]) -> Vec<f64> {
    assert_eq!([to.len(), from.len()], [size(); 2], "a number a rank");
    assert_eq!(to.iter().sum::<i64>(), own.len() as i64, "values to send");
    let mut received = vec![0.0; from.iter().sum::<i64>() as usize];
    let _alone = alone();
    // SAFETY: two counts per rank, as many own values as the counts `to` add up to, and room for the sum of the counts `from`.
    unsafe {
        ligament_all_to_all(
            own.as_ptr(),
            to.as_ptr(),
            from.as_ptr(),
            received.as_mut_ptr(),
        )
    }
    received
}

pub(crate) fn broadcast(bytes: &mut [u8]) {
    let _alone = alone();
    // SAFETY: exactly as many bytes are read or written as the slice has.
    unsafe { ligament_broadcast(bytes.as_mut_ptr(), bytes.len() as i64) }
}

/// Sends bytes from one rank to another; this process is one of the two.
pub(crate) fn transfer(from: usize, to: usize, bytes: &mut [u8]) {
    assert_ne!([from, to].map(|it| it == rank()), [false; 2], "an end");
    let [from, to] = [from, to].map(|it| it as c_int);
    let _alone = alone();
    // SAFETY: exactly as many bytes are read or written as the slice has.
    unsafe { ligament_transfer(bytes.as_mut_ptr(), bytes.len() as i64, from, to) }
}

/// The rows of a PETSc matrix on this rank.
#[derive(Debug)]
pub(crate) struct Handle {
    matrix: *mut c_void,
    n_own: usize,
    n_components: usize,
}

impl Handle {
    pub(crate) fn new(n_components: usize, n_all: usize, blocks: [&[i64]; 2]) -> Self {
        let [own, other] = blocks;
        assert_eq!(own.len(), other.len(), "blocks of each own point");
        let _alone = alone();
        // SAFETY: two lists with one number for each own point.
        let matrix = unsafe {
            ligament_matrix_new(
                n_components as i64,
                own.len() as i64,
                n_all as i64,
                own.as_ptr(),
                other.as_ptr(),
            )
        };
        Self {
            matrix,
            n_own: own.len(),
            n_components,
        }
    }

    fn n_own_values(&self) -> usize {
        self.n_own * self.n_components
    }

    pub(crate) fn set(&mut self, row: usize, columns: &[i64], values: &[f64]) {
        let size = self.n_components * self.n_components;
        assert_eq!(
            values.len(),
            columns.len() * size,
            "a block for each column"
        );
        let _alone = alone();
        // SAFETY: the matrix lives as long as its handle; one block of values for each column.
        unsafe {
            ligament_matrix_set(
                self.matrix,
                row as i64,
                columns.as_ptr(),
                columns.len() as i64,
                values.as_ptr(),
            );
        }
    }

    pub(crate) fn assemble(&mut self) {
        let _alone = alone();
        // SAFETY: the matrix lives as long as its handle.
        unsafe { ligament_matrix_assemble(self.matrix) }
    }

    pub(crate) fn precondition(&mut self, motions: &[f64], n: usize, n_coupled: usize) {
        assert_eq!(motions.len(), n * self.n_own_values(), "whole motions");
        let _alone = alone();
        // SAFETY: the matrix lives as long as its handle; `n` motions, each at all own degrees of freedom.
        unsafe {
            ligament_matrix_precondition(self.matrix, motions.as_ptr(), n as i64, n_coupled as i64);
        }
    }

    /// Factorises the matrix; returns the numbers of negative, vanishing and positive pivots.
    pub(crate) fn factorise(&mut self) -> [i64; 3] {
        let mut inertia = [0; 3];
        let _alone = alone();
        // SAFETY: the matrix lives as long as its handle; room for three numbers.
        unsafe { ligament_matrix_factorise(self.matrix, inertia.as_mut_ptr()) }
        inertia
    }

    /// Solves for the motions at the own degrees of freedom; returns them with the code of the end of the iteration, the number of
    /// iterations, and the norms of the first and the last residual.
    pub(crate) fn solve(
        &mut self,
        force: &[f64],
        limits: Option<&[f64]>,
        norm: f64,
    ) -> (Vec<f64>, i32, i64, [f64; 2]) {
        let n = self.n_own_values();
        assert_eq!(force.len(), n, "a force for each own degree of freedom");
        assert!(limits.is_none_or(|it| it.len() == n), "as many limits");
        let (mut motions, mut iterations, mut norms) = (vec![0.0; n], 0, [0.0; 2]);
        let _alone = alone();
        // SAFETY: the matrix lives as long as its handle; all arrays cover its own degrees of freedom, `limits` may be null.
        let end = unsafe {
            ligament_matrix_solve(
                self.matrix,
                force.as_ptr(),
                limits.map_or(ptr::null(), <[f64]>::as_ptr),
                norm,
                motions.as_mut_ptr(),
                &raw mut iterations,
                norms.as_mut_ptr(),
            )
        };
        (motions, end, iterations, norms)
    }
}

impl Drop for Handle {
    fn drop(&mut self) {
        let _alone = alone();
        // SAFETY: the matrix lives as long as its handle, and is not used after it.
        unsafe { ligament_matrix_free(self.matrix) }
    }
}
