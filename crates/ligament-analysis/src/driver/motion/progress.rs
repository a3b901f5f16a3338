//! Progress of a motion.

use super::clock::Clock;
use crate::driver::recorder::Energies;
use crate::history::{InMotion, LargestOverlap, StepRecord};
use crate::motion::MotionProblem;
use crate::serial;
use crate::serial::{Serial, Sink};

/// First byte of the checkpoint of an explicit motion; those of statics begin with 0 or 1.
pub(super) const EXPLICIT: u8 = 2;

/// First byte of the checkpoint of an implicit motion.
pub(super) const IMPLICIT: u8 = 3;

/// Progress of a motion.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Progress {
    pub(super) clock: Clock,
    /// Energies and number of time steps.
    pub(super) motion: InMotion,
    /// Forces of damping at the time (n_degrees_of_freedom), N and N m; empty where nothing damps.
    pub(super) damping_forces: Vec<f64>,
    /// Energy stored in faces of cracks that stick, J.
    pub(super) sticking: f64,
    /// Time at which the body last lost its balance, s, with the number of bonds broken before.
    pub(super) moving_since: (f64, usize),
    pub(super) history: Vec<StepRecord>,
    /// Largest overlap of crack faces so far.
    pub(super) overlap: Option<LargestOverlap>,
    /// Whether a part has turned beyond small angles.
    pub(super) has_turned: bool,
}

serial!(Progress {
    clock,
    motion,
    damping_forces,
    sticking,
    moving_since,
    history,
    overlap,
    has_turned,
});

impl Progress {
    pub(super) fn at_start(clock: Clock) -> Self {
        Self {
            clock,
            motion: InMotion::default(),
            damping_forces: Vec::new(),
            sticking: 0.0,
            moving_since: (0.0, 0),
            history: Vec::new(),
            overlap: None,
            has_turned: false,
        }
    }

    /// Appends the bytes of a motion under a scheme, from which it continues with the same bits; `write` appends its state.
    pub(super) fn write_all(
        &self,
        energies: &Energies,
        scheme: u8,
        write: &dyn Fn(&mut dyn Sink),
        out: &mut dyn Sink,
    ) {
        scheme.write(out);
        self.write(out);
        write(out);
        energies.write(out);
    }
}

/// A motion that continues from a checkpoint, with its state under a scheme.
pub(super) struct Resumed<K> {
    pub(super) problem: MotionProblem,
    pub(super) energies: Energies,
    pub(super) progress: Progress,
    pub(super) kept: K,
}
