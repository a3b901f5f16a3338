//! Contact and friction at rest and in slow motions, against closed forms and fracture mechanics.

pub(super) mod flaw;
pub(super) mod hertz;
pub(super) mod sliding;
