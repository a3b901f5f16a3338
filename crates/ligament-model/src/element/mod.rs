//! Elements: the kinematics of bonds.

pub mod beam;
