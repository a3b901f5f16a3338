//! Reasons why a run cannot continue from a checkpoint.

use thiserror::Error;

use crate::serial::Damaged;

/// Reason why a run cannot continue from a checkpoint.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
pub enum CheckpointError {
    /// The bytes are no checkpoint.
    #[error(transparent)]
    Damaged(#[from] Damaged),
    /// Points, bonds or unknowns differ from the problem.
    #[error("it belongs to another model: points, bonds or supports differ")]
    OtherModel,
    /// The run belongs to another driver.
    #[error("the two runs differ in kind: the exact path, load steps or motion in time")]
    OtherDriver,
    /// The loading up to the checkpoint differs.
    #[error(
        "load step {step} was at load factor {was}: completed load steps cannot change, new ones can only follow"
    )]
    OtherLoading {
        /// First step that differs.
        step: usize,
        /// Load factor of the step in the checkpoint.
        was: f64,
    },
    /// The times of a motion differ.
    #[error(
        "the duration of the motion, its rows or its time step differ from those of the checkpoint"
    )]
    OtherTimes,
    /// One process wrote the checkpoint, and several are to continue.
    #[error(
        "one process wrote it: resume with one process, or start anew with several; any number of processes can resume what \
         several wrote"
    )]
    OfOneProcess,
    /// The checkpoint was written with a direct solver and the present one is iterative, or the reverse.
    #[error(
        "the other solver method was in use when it was written: without solver.method the available memory decides, so resume on a \
         machine with as much memory, or start anew"
    )]
    OtherMethod,
    /// Restored numbers differ in their bits.
    #[error(
        "this machine or version of the program does not compute the same bits as the one that wrote it; resume there, or start anew"
    )]
    OtherArithmetic,
    /// The analysis breaks no bonds.
    #[error("the analysis breaks no bonds, so there is nothing to resume")]
    NoFracture,
}
