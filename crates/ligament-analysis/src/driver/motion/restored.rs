//! A motion restored from a checkpoint.

use std::io::Read;

use super::explicit_kept::ExplicitKept;
use super::implicit_kept::ImplicitKept;
use super::progress::{EXPLICIT, IMPLICIT, Progress};
use crate::checkpoint::CheckpointError;
use crate::driver::recorder::Energies;
use crate::error::SetupError;
use crate::motion::{MotionProblem, MotionSettings};
use crate::serial::{Serial, require_end};

/// Motion restored from a checkpoint, at a row of its history.
pub struct Restored {
    pub(super) problem: MotionProblem,
    pub(super) energies: Energies,
    pub(super) progress: Progress,
    pub(super) kept: Kept,
}

/// State of a motion under each scheme.
pub(super) enum Kept {
    Explicit(Box<ExplicitKept>),
    Implicit(Box<ImplicitKept>),
}

impl Restored {
    /// Time of the restored state, s.
    pub fn time(&self) -> f64 {
        match &self.kept {
            Kept::Explicit(it) => it.body.state.load_factor,
            Kept::Implicit(it) => it.here.state.load_factor,
        }
    }

    /// Number of bonds broken up to the restored state.
    pub fn broken_bonds(&self) -> usize {
        match &self.kept {
            Kept::Explicit(it) => it.body.broken,
            Kept::Implicit(it) => it.here.broken,
        }
    }

    /// Restores the motion of a checkpoint.
    pub(super) fn read(
        problem: &MotionProblem,
        settings: &MotionSettings,
        from: &mut dyn Read,
    ) -> Result<Self, SetupError> {
        let damaged = CheckpointError::Damaged;
        let scheme = u8::read(from).map_err(damaged)?;
        if !matches!(scheme, EXPLICIT | IMPLICIT) {
            return Err(CheckpointError::OtherDriver.into());
        }
        let progress: Progress = Serial::read(from).map_err(damaged)?;
        let kept = match (scheme, settings.is_explicit()) {
            (EXPLICIT, true) => Kept::Explicit(Box::new(ExplicitKept::read(problem, from)?)),
            (IMPLICIT, false) => {
                let kept = ImplicitKept::read(problem, settings, &progress.clock, from)?;
                Kept::Implicit(Box::new(kept))
            }
            _ => return Err(CheckpointError::OtherDriver.into()),
        };
        let (state, balanced) = match &kept {
            Kept::Explicit(it) => (&it.body.state, &it.body.balanced),
            Kept::Implicit(it) => (&it.here.state, &it.here.balanced),
        };
        let energies = Energies::read(&problem.problem, state, balanced, from)?;
        require_end(from).map_err(damaged)?;
        Ok(Self {
            problem: problem.clone(),
            energies,
            progress,
            kept,
        })
    }
}
