//! Reasons why a run cannot continue from a checkpoint.

use thiserror::Error;

use crate::serial::Damaged;

/// Reason why a run cannot continue from a checkpoint.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
pub enum CheckpointError {
    /// The bytes are no checkpoint.
    #[error(transparent)]
    Damaged(#[from] Damaged),
    /// Points, bonds or unknowns differ from those of the problem.
    #[error("it is of another model: points, bonds or what holds them differ")]
    OtherModel,
    /// The run belongs to another driver.
    #[error(
        "it is of a run along the exact path where this one takes load steps, or the other way round"
    )]
    OtherDriver,
    /// The loading up to the checkpoint differs.
    #[error(
        "load step {step} was at load factor {was}: the load steps that were done must stay as they are, others may only follow"
    )]
    OtherLoading {
        /// First step that differs.
        step: usize,
        /// Load factor of the step in the checkpoint.
        was: f64,
    },
    /// One process wrote the checkpoint, and several are to continue.
    #[error(
        "one process wrote it: go on with one, or begin the run anew with several; what several wrote any number can go on with"
    )]
    OfOneProcess,
    /// The checkpoint was written with a direct solver and the present one is iterative, or the reverse.
    #[error(
        "the equations were solved by the other method when it was written: where solver.method is open the memory that there is \
         decides, so go on where there is as much, or begin the run anew"
    )]
    OtherMethod,
    /// Restored numbers differ in their bits.
    #[error(
        "this machine, or this version of the program, does not compute the same bits as the one that wrote it; go on there, or begin \
         the run anew"
    )]
    OtherArithmetic,
    /// The analysis breaks no bonds.
    #[error("the analysis breaks no bonds: it has nothing to go on with")]
    NoFracture,
}
