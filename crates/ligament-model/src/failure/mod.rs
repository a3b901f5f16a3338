//! Failure criteria: the stretch at which each bond breaks.

pub mod strength;
