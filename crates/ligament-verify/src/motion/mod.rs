//! Motions in time: waves, vibrations, collisions and fast cracks against closed forms, tests and the results of others.

pub(super) mod branching;
pub(super) mod contact;
pub(super) mod disk;
mod fast_crack;
pub(super) mod kalthoff;
pub(super) mod lamb;
pub(super) mod record;
pub(super) mod schemes;
pub(super) mod splitting;
pub(super) mod stretching;
pub(super) mod vibration;
pub(super) mod waves;
